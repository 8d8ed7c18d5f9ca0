!> How far a stress is from yield: the share of the strength, at its pressure, that it does not use;
!> and what of a criterion bears a stress
module axijoint_element_yield_margin
   use axijoint_base_kinds, only : wp
   use axijoint_element_principal, only : principal_stresses
   use axijoint_element_yield_law, only : yield_law_type, yield_tresca, yield_mises, yield_mohr, &
      yield_drucker
   use axijoint_element_yield_planes, only : yield_planes_type, most_planes
   use axijoint_element_yield_stress, only : criterion_planes, root_j2, cartesian
   implicit none
   private
   public :: yield_margin, bearing, bearing_names

   !> What bears: nothing, one plane, two at an edge, the tension cut-off, the apex
   character(len=7), parameter :: bearing_names(0:4) = &
      [character(len=7) :: 'nothing', 'plane', 'edge', 'tension', 'apex']
   integer, parameter :: on_plane = 1, on_edge = 2, in_tension = 3, at_apex = 4
   !> Share of the stress below which a plane bears
   real(wp), parameter :: near = 1.0e-6_wp

contains

   !> 1 without shear stress, 0 at yield and beyond. Of criteria with friction it is one less the
   !> share by which cohesion and friction could be lessened; a tension cut-off counts as well
   pure real(wp) function yield_margin(law, gained, stress) result(margin)
      !> Constants of the solid
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened it
      real(wp), intent(in) :: gained
      !> r, z, theta, rz, r-theta, z-theta
      real(wp), intent(in) :: stress(6)

      type(yield_planes_type) :: planes
      real(wp) :: principal(3), friction, shear, strength, tension

      planes = criterion_planes(law, gained)
      select case (law%criterion)
      case (yield_tresca, yield_mohr)
         principal = principal_stresses(stress(cartesian))
         friction = 0.5_wp*(planes%normal(1, 1) + planes%normal(3, 1))
         shear = principal(1) - principal(3)
         strength = planes%limit(1) - friction*(principal(1) + principal(3))
         tension = principal(1)
      case (yield_mises, yield_drucker)
         tension = sum(stress(1:3))/3.0_wp
         shear = root_j2(stress)
         strength = planes%limit(1) - planes%normal(2, 1)*tension
      case default
         margin = 1.0_wp
         return
      end select
      margin = 0.0_wp
      if (strength > 0.0_wp) margin = max(0.0_wp, 1.0_wp - shear/strength)
      if (law%tension < huge(1.0_wp) .and. tension > 0.0_wp) &
         margin = min(margin, max(0.0_wp, 1.0_wp - tension/max(law%tension, tiny(1.0_wp))))
   end function yield_margin

   !> What of the criterion bears a stress: the place of its name among `bearing_names`
   pure integer function bearing(law, gained, stress)
      !> Constants of the solid
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened it
      real(wp), intent(in) :: gained
      !> r, z, theta, rz, r-theta, z-theta
      real(wp), intent(in) :: stress(6)

      type(yield_planes_type) :: planes
      real(wp) :: numbers(3), scale
      logical :: bears(most_planes)
      integer :: k

      bearing = 0
      planes = criterion_planes(law, gained)
      select case (law%criterion)
      case (yield_tresca, yield_mohr)
         numbers = principal_stresses(stress(cartesian))
      case (yield_mises, yield_drucker)
         numbers = [root_j2(stress), sum(stress(1:3))/3.0_wp, 0.0_wp]
      case default
         return
      end select
      scale = near*max(maxval(abs(numbers)), maxval(abs(planes%limit(:planes%n))))
      do k = 1, planes%n
         bears(k) = dot_product(planes%normal(:, k), numbers) >= planes%limit(k) - scale
      end do
      associate (of_criterion => planes%share(:planes%n) > 0.0_wp, here => bears(:planes%n))
         select case (count(here .and. of_criterion))
         case (1)
            bearing = on_plane
         case (2:)
            bearing = on_edge
         end select
         if (any(here .and. .not. of_criterion)) bearing = in_tension
      end associate
      if (bearing == 0 .or. .not. planes%has_apex) return
      if (abs(dot_product(planes%mean, numbers) - planes%apex*planes%strength) <= scale &
         .and. root_j2(stress) <= scale) bearing = at_apex
   end function bearing

end module axijoint_element_yield_margin
