!> The criterion of Tresca: the largest principal stress less the smallest is at most the yield
!> stress
module axijoint_element_tresca
   use axijoint_base_kinds, only : wp
   use axijoint_element_mohr, only : principal_planes
   use axijoint_element_yield_law, only : yield_law_type
   use axijoint_element_yield_planes, only : yield_planes_type
   implicit none
   private
   public :: tresca_planes

contains

   !> The planes that bound sorted principal stresses: those of Mohr and Coulomb without friction
   pure function tresca_planes(law, gained) result(planes)
      !> Constants
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened the solid
      real(wp), intent(in) :: gained
      !> The criterion
      type(yield_planes_type) :: planes

      planes = principal_planes(law, gained, 0.0_wp, 0.0_wp, 1.0_wp)
   end function tresca_planes

end module axijoint_element_tresca
