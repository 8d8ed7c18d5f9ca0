!> Fourier modes: a harmonic of one of the two families
module axijoint_fe_mode
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   implicit none
   private
   public :: mode_type, family_symmetric, family_antisymmetric
   public :: same_mode, is_torsion, meridional, circumferential, mode_integral, mode_name

   !> Symmetric to theta = 0: u, v ~ cos(m theta), w ~ sin(m theta)
   integer, parameter :: family_symmetric = 1
   !> Antisymmetric to theta = 0: u, v ~ sin(m theta), w ~ -cos(m theta). With that
   !> sign of w both families have the same stiffness
   integer, parameter :: family_antisymmetric = 2

   !> A harmonic of one family
   type :: mode_type
      !> Harmonic m
      integer :: harmonic = 0
      !> One of the `family_` parameters
      integer :: family = family_symmetric
   end type mode_type

contains

   !> Whether two modes are the same
   elemental logical function same_mode(a, b)
      !> The modes
      type(mode_type), intent(in) :: a, b

      same_mode = a%harmonic == b%harmonic .and. a%family == b%family
   end function same_mode

   !> Whether a mode is torsion: antisymmetric of harmonic 0, which has w only
   elemental logical function is_torsion(mode)
      !> The mode
      type(mode_type), intent(in) :: mode

      is_torsion = mode%harmonic == 0 .and. mode%family == family_antisymmetric
   end function is_torsion

   !> What r and z components are multiplied by at an angle: cos or sin(m theta)
   elemental function meridional(mode, angle) result(factor)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> theta [radian]
      real(wp), intent(in) :: angle
      !> The factor
      real(wp) :: factor

      if (mode%family == family_symmetric) then
         factor = cos(mode%harmonic*angle)
      else
         factor = sin(mode%harmonic*angle)
      end if
   end function meridional

   !> What theta components are multiplied by at an angle: sin or -cos(m theta)
   elemental function circumferential(mode, angle) result(factor)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> theta [radian]
      real(wp), intent(in) :: angle
      !> The factor
      real(wp) :: factor

      if (mode%family == family_symmetric) then
         factor = sin(mode%harmonic*angle)
      else
         factor = -cos(mode%harmonic*angle)
      end if
   end function circumferential

   !> c_m: integral over the circle of the squared factors, 2 pi for m = 0, else pi
   elemental function mode_integral(mode) result(integral)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The integral
      real(wp) :: integral

      integral = circle_integral(mode%harmonic)
   end function mode_integral

   !> A mode in words: "2 symmetric"
   pure function mode_name(mode) result(name)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The words
      character(len=:), allocatable :: name

      character(len=12) :: number

      write (number, '(i0)') mode%harmonic
      name = trim(number)//merge(' symmetric    ', ' antisymmetric', &
         mode%family == family_symmetric)
      name = trim(name)
   end function mode_name

end module axijoint_fe_mode
