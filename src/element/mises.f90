!> The criterion of von Mises: sqrt(3 J2) is the yield stress at most
module axijoint_element_mises
   use axijoint_base_kinds, only : wp
   use axijoint_element_drucker, only : cone_planes
   use axijoint_element_yield_law, only : yield_law_type
   use axijoint_element_yield_planes, only : yield_planes_type
   implicit none
   private
   public :: mises_planes

contains

   !> The lines that bound sqrt(J2) and p: a cone without slope
   pure function mises_planes(law, gained) result(planes)
      !> Constants
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened the solid
      real(wp), intent(in) :: gained
      !> The criterion
      type(yield_planes_type) :: planes

      planes = cone_planes(law, gained, 0.0_wp, 0.0_wp, 1.0_wp/sqrt(3.0_wp))
   end function mises_planes

end module axijoint_element_mises
