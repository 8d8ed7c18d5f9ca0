!> Solids that yield: the criteria by name, and the constants of one
module axijoint_element_yield_law
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: yield_law_type, law_at, elastic_strain
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
      !> What the strength gains by a unit of depth below a level z_s [stress/length], and that level
      !> [length]
      real(wp) :: gradient = 0.0_wp, level = 0.0_wp
   end type yield_law_type

contains

   !> Constants at a height: the strength grows with the depth below its level
   elemental function law_at(law, z) result(here)
      !> Constants of the solid
      type(yield_law_type), intent(in) :: law
      !> The height [length]
      real(wp), intent(in) :: z
      !> Those of a point there
      type(yield_law_type) :: here

      here = law
      here%strength = law%strength + law%gradient*max(0.0_wp, law%level - z)
   end function law_at

   !> Strain that a stress gives the solid while it is elastic: of stress that plastic strain takes,
   !> that strain
   pure function elastic_strain(law, stress) result(strain)
      !> Constants of the solid
      type(yield_law_type), intent(in) :: law
      !> r, z, theta, rz, r-theta, z-theta
      real(wp), intent(in) :: stress(6)
      !> The same; shear strains as in engineering
      real(wp) :: strain(6)

      real(wp) :: mean

      mean = sum(stress(1:3))/3.0_wp
      strain(1:3) = (stress(1:3) - mean)/(2.0_wp*law%shear) + mean/(3.0_wp*law%bulk)
      strain(4:6) = stress(4:6)/law%shear
   end function elastic_strain

end module axijoint_element_yield_law
