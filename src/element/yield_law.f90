!> Solids that yield: the criteria by name, and the constants of one
module axijoint_element_yield_law
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: yield_law_type
   public :: yield_none, yield_tresca, yield_mises, yield_mohr, yield_drucker, criterion_names

   !> Solid that stays elastic
   integer, parameter :: yield_none = 0
   !> The difference of the largest and the smallest principal stress
   integer, parameter :: yield_tresca = 1
   !> The second invariant of the deviator
   integer, parameter :: yield_mises = 2
   !> Mohr and Coulomb: the same difference, with the pressure
   integer, parameter :: yield_mohr = 3
   !> Drucker and Prager: the same invariant, with the pressure
   integer, parameter :: yield_drucker = 4
   !> Their names on cards and in the listing
   character(len=7), parameter :: criterion_names(0:4) = &
      [character(len=7) :: 'ELASTIC', 'TRESCA', 'MISES', 'MOHR', 'DRUCKER']

   !> Constants of a solid that yields; its elasticity is isotropic
   type :: yield_law_type
      !> Which criterion, one of the `yield_` parameters
      integer :: criterion = yield_none
      !> Shear modulus G and bulk modulus K [stress]
      real(wp) :: shear = 0.0_wp, bulk = 0.0_wp
      !> Strength before it hardens [stress]: of TRESCA and MISES the uniaxial yield stress, of MOHR
      !> and DRUCKER the cohesion
      real(wp) :: strength = 0.0_wp
      !> What the strength gains by a plastic strain of one, H' >= 0 [stress]
      real(wp) :: hardening = 0.0_wp
      !> Angles of friction and of dilation of MOHR and DRUCKER [radian]
      real(wp) :: friction = 0.0_wp, dilation = 0.0_wp
      !> Tension that is borne at most [stress]: of TRESCA and MOHR the largest principal stress, of
      !> MISES and DRUCKER the mean stress
      real(wp) :: tension = huge(1.0_wp)
   end type yield_law_type

end module axijoint_element_yield_law
