!> The criterion of Drucker and Prager in two invariants, the root of J2 and the mean stress p:
!> sqrt(J2) + a p <= b c, the cone through the edges of Mohr and Coulomb in triaxial compression,
!> with its apex and a tension cut-off
module axijoint_element_drucker
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_law, only : yield_law_type
   use axijoint_element_yield_planes, only : yield_planes_type, add_plane, add_tension
   implicit none
   private
   public :: drucker_planes, cone_planes

contains

   !> The lines that bound sqrt(J2) and p
   pure function drucker_planes(law, gained) result(planes)
      !> Constants
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened the solid
      real(wp), intent(in) :: gained
      !> The criterion
      type(yield_planes_type) :: planes

      planes = cone_planes(law, gained, slope(law%friction), slope(law%dilation), &
                           2.0_wp*sqrt(3.0_wp)*cos(law%friction)/(3.0_wp - sin(law%friction)))
   end function drucker_planes

   !> Slope of the cone of an angle
   pure real(wp) function slope(angle)
      !> The angle [radian]
      real(wp), intent(in) :: angle

      slope = 2.0_wp*sqrt(3.0_wp)*sin(angle)/(3.0_wp - sin(angle))
   end function slope

   !> A cone: sqrt(J2) + friction p <= share times strength
   pure function cone_planes(law, gained, friction, dilation, share) result(planes)
      !> Constants
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened the solid
      real(wp), intent(in) :: gained
      !> Slopes of the cone, and of that along which plastic strain is normal
      real(wp), intent(in) :: friction, dilation
      !> Limit for a strength of one
      real(wp), intent(in) :: share
      !> The criterion in sqrt(J2), p and an idle number
      type(yield_planes_type) :: planes

      logical :: cut_off

      planes%strength = law%strength + law%hardening*gained
      planes%hardening = law%hardening
      planes%bulk = law%bulk
      planes%moduli(1, 1) = law%shear
      planes%moduli(2, 2) = law%bulk
      call add_plane(planes, [1.0_wp, friction, 0.0_wp], [1.0_wp, dilation, 0.0_wp], share)
      call add_plane(planes, [-1.0_wp, 0.0_wp, 0.0_wp], [-1.0_wp, 0.0_wp, 0.0_wp], 0.0_wp)
      planes%n_sets = 1
      planes%sets(1, 1) = 1
      cut_off = law%tension < huge(1.0_wp)
      if (friction > 0.0_wp) cut_off = law%tension < share*planes%strength/friction
      if (cut_off) then
         call add_tension(planes, [0.0_wp, 1.0_wp, 0.0_wp], law%tension)
         planes%n_sets = 3
         planes%sets(:, 2:3) = reshape([3, 0, 0, 1, 3, 0], [3, 2])
      else if (friction > 0.0_wp) then
         planes%has_apex = .true.
         planes%apex = share/friction
         planes%dilation = dilation/share
         planes%mean(2) = 1.0_wp
         planes%hydrostatic(2) = 1.0_wp
      end if
   end function cone_planes

end module axijoint_element_drucker
