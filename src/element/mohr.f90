!> The criterion of Mohr and Coulomb in the principal stresses, the largest first:
!> (1 + sin phi) s1 - (1 - sin phi) s3 <= 2 c cos phi, with its edges, its apex, a tension cut-off
module axijoint_element_mohr
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_law, only : yield_law_type
   use axijoint_element_yield_planes, only : yield_planes_type, add_plane, add_tension
   implicit none
   private
   public :: mohr_planes, principal_planes

contains

   !> The planes that bound sorted principal stresses
   pure function mohr_planes(law, gained) result(planes)
      !> Constants
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened the solid
      real(wp), intent(in) :: gained
      !> The criterion
      type(yield_planes_type) :: planes

      planes = principal_planes(law, gained, sin(law%friction), sin(law%dilation), &
                                2.0_wp*cos(law%friction))
   end function mohr_planes

   !> Planes of two principal stresses each, (1 + f) sa - (1 - f) sb <= share times strength. Those
   !> of 1 and 2, and of 2 and 3, bear at the edges, where two of the stresses are equal
   pure function principal_planes(law, gained, friction, dilation, share) result(planes)
      !> Constants
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened the solid
      real(wp), intent(in) :: gained
      !> Sines of the angles of friction and of dilation
      real(wp), intent(in) :: friction, dilation
      !> Limit for a strength of one
      real(wp), intent(in) :: share
      !> The criterion
      type(yield_planes_type) :: planes

      integer, parameter :: pairs(2, 3) = reshape([1, 3, 1, 2, 2, 3], [2, 3])
      real(wp) :: normal(3), flow(3)
      integer :: i
      logical :: cut_off

      planes%strength = law%strength + law%hardening*gained
      planes%hardening = law%hardening
      planes%bulk = law%bulk
      planes%moduli = law%bulk - 2.0_wp*law%shear/3.0_wp
      do i = 1, 3
         planes%moduli(i, i) = planes%moduli(i, i) + 2.0_wp*law%shear
         normal = 0.0_wp
         flow = 0.0_wp
         normal(pairs(:, i)) = [1.0_wp + friction, friction - 1.0_wp]
         flow(pairs(:, i)) = [1.0_wp + dilation, dilation - 1.0_wp]
         call add_plane(planes, normal, flow, share)
      end do
      planes%n_sets = 3
      planes%sets(:, :3) = reshape([1, 0, 0, 1, 2, 0, 1, 3, 0], [3, 3])
      cut_off = law%tension < huge(1.0_wp)
      if (friction > 0.0_wp) cut_off = law%tension < 0.5_wp*share*planes%strength/friction
      if (cut_off) then
         call cut_tension(planes, law%tension)
      else if (friction > 0.0_wp) then
         planes%has_apex = .true.
         planes%apex = 0.5_wp*share/friction
         planes%dilation = 2.0_wp*dilation/share
         planes%mean = 1.0_wp/3.0_wp
         planes%hydrostatic = 1.0_wp
      end if
   end function principal_planes

   !> No principal stress above the tension borne: planes 4 to 6
   pure subroutine cut_tension(planes, tension)
      !> The criterion
      type(yield_planes_type), intent(inout) :: planes
      !> Tension that is borne
      real(wp), intent(in) :: tension

      call add_tension(planes, [1.0_wp, 0.0_wp, 0.0_wp], tension)
      call add_tension(planes, [0.0_wp, 1.0_wp, 0.0_wp], tension)
      call add_tension(planes, [0.0_wp, 0.0_wp, 1.0_wp], tension)
      planes%n_sets = 10
      planes%sets(:, 4:) = reshape([4, 0, 0, 4, 5, 0, 4, 5, 6, 1, 4, 0, 1, 2, 4, 1, 3, 4, &
                                    1, 4, 5], [3, 7])
   end subroutine cut_tension

end module axijoint_element_mohr
