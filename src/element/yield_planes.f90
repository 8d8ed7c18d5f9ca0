!> Return of a trial stress to a criterion that consists of planes: of the principal stresses, or of
!> the two invariants that a cone has. With linear hardening all that is linear once it is known
!> which planes bear, so stress and derivatives are exact
module axijoint_element_yield_planes
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: yield_planes_type, add_plane, add_tension, return_to_planes, most_planes

   !> Planes at most
   integer, parameter :: most_planes = 6
   !> Sets of planes that may bear together at most
   integer, parameter :: most_sets = 10
   !> Share of the stress below which a plane is not passed, and a plastic flow not negative
   real(wp), parameter :: rounding = 1.0e-13_wp
   !> The same where there is an apex that the stress may belong to instead
   real(wp), parameter :: surely_passed = 1.0e-11_wp

   !> A criterion in the space of three numbers (two for a cone, the third is idle)
   type :: yield_planes_type
      !> Number of planes
      integer :: n = 0
      !> Plane k is not passed while normal . stress <= limit; its plastic strain is along the flow,
      !> shape (3, planes)
      real(wp) :: normal(3, most_planes) = 0.0_wp, flow(3, most_planes) = 0.0_wp
      !> The limits, and what they gain with the strength
      real(wp) :: limit(most_planes) = 0.0_wp, share(most_planes) = 0.0_wp
      !> Sets of planes that may bear together, zero for none, in the order in which they are tried
      integer :: n_sets = 0
      integer :: sets(3, most_sets) = 0
      !> Elasticity: stress = moduli . strain, shape (3, 3)
      real(wp) :: moduli(3, 3) = 0.0_wp
      !> What the strength is, what it gains by plastic strain (H')
      real(wp) :: strength = 0.0_wp, hardening = 0.0_wp
      !> Whether the planes end in an apex, a mean stress of `apex` times the strength
      logical :: has_apex = .false.
      real(wp) :: apex = 0.0_wp
      !> Plastic strain of volume there that hardens like a plastic strain of one
      real(wp) :: dilation = 0.0_wp
      !> Bulk modulus
      real(wp) :: bulk = 0.0_wp
      !> What the mean stress is of the three numbers, and what they are for a mean stress of one
      real(wp) :: mean(3) = 0.0_wp, hydrostatic(3) = 0.0_wp
   end type yield_planes_type

contains

   !> Add a plane
   pure subroutine add_plane(planes, normal, flow, share)
      !> The criterion
      type(yield_planes_type), intent(inout) :: planes
      !> Normal, and direction of plastic strain
      real(wp), intent(in) :: normal(3), flow(3)
      !> Limit for a strength of one
      real(wp), intent(in) :: share

      planes%n = planes%n + 1
      planes%normal(:, planes%n) = normal
      planes%flow(:, planes%n) = flow
      planes%share(planes%n) = share
      planes%limit(planes%n) = share*planes%strength
   end subroutine add_plane

   !> Add a plane that ends tension
   pure subroutine add_tension(planes, normal, tension)
      !> The criterion
      type(yield_planes_type), intent(inout) :: planes
      !> Normal and direction of plastic strain
      real(wp), intent(in) :: normal(3)
      !> Tension that is borne
      real(wp), intent(in) :: tension

      call add_plane(planes, normal, normal, 0.0_wp)
      planes%limit(planes%n) = tension
   end subroutine add_tension

   !> Return a trial stress. The set of planes that bears is the first whose plastic flow is not
   !> negative and whose stress passes no plane, but for rounding; what none returns goes to the
   !> apex
   pure subroutine return_to_planes(planes, trial, stress, derivative, growth)
      !> The criterion
      type(yield_planes_type), intent(in) :: planes
      !> Trial stress
      real(wp), intent(in) :: trial(3)
      !> Stress that is borne, and its derivatives by the trial stress
      real(wp), intent(out) :: stress(3), derivative(3, 3)
      !> Plastic strain that hardens
      real(wp), intent(out) :: growth

      real(wp) :: candidate(3), slope(3, 3), gained, violation, least
      integer :: s

      stress = trial
      derivative = identity()
      growth = 0.0_wp
      if (.not. excess(planes, trial, 0.0_wp) > 0.0_wp) return
      least = huge(1.0_wp)
      do s = 1, planes%n_sets
         call return_to_set(planes, planes%sets(:, s), trial, candidate, slope, gained, violation)
         if (violation >= least) cycle
         least = violation
         stress = candidate
         derivative = slope
         growth = gained
         if (least <= rounding) return
      end do
      if (planes%has_apex .and. least > surely_passed) &
         call return_to_apex(planes, trial, stress, derivative, growth)
   end subroutine return_to_planes

   !> Return a trial stress to some planes: flow g >= 0 of each so that normal . stress = limit
   !> where stress = trial - D (sum of flow g), limits growing with the share times H' (share . g)
   pure subroutine return_to_set(planes, set, trial, stress, derivative, growth, violation)
      !> The criterion
      type(yield_planes_type), intent(in) :: planes
      !> The planes; zero for none, behind the others
      integer, intent(in) :: set(3)
      !> Trial stress
      real(wp), intent(in) :: trial(3)
      !> Stress on these planes, and its derivatives
      real(wp), intent(out) :: stress(3), derivative(3, 3)
      !> Plastic strain that hardens
      real(wp), intent(out) :: growth
      !> How far it is from a solution, as a share of the stress
      real(wp), intent(out) :: violation

      ! of fixed sizes: this is done for every point on every plane in every iteration
      real(wp) :: relaxed(3, 3), matrix(3, 3), right(3, 4), scale
      integer :: n, i, j, k
      logical :: singular

      n = count(set > 0)
      do j = 1, n
         do i = 1, 3
            relaxed(i, j) = dot_product(planes%moduli(:, i), planes%flow(:, set(j)))
         end do
      end do
      do j = 1, n
         do i = 1, n
            matrix(i, j) = dot_product(planes%normal(:, set(i)), relaxed(:, j)) &
               + planes%hardening*planes%share(set(i))*planes%share(set(j))
         end do
         right(j, :3) = planes%normal(:, set(j))
         right(j, 4) = dot_product(planes%normal(:, set(j)), trial) - planes%limit(set(j))
      end do
      scale = size_of(planes, trial)
      violation = huge(1.0_wp)
      stress = trial
      derivative = identity()
      growth = 0.0_wp
      call eliminate(n, matrix, right, singular)
      if (singular) return
      violation = 0.0_wp
      do j = 1, n
         stress = stress - right(j, 4)*relaxed(:, j)
         do k = 1, 3
            derivative(:, k) = derivative(:, k) - right(j, k)*relaxed(:, j)
         end do
         growth = growth + planes%share(set(j))*right(j, 4)
         violation = max(violation, -right(j, 4)*maxval(abs(relaxed(:, j)))/scale)
      end do
      violation = max(violation, excess(planes, stress, growth)/scale)
   end subroutine return_to_set

   !> Return a trial stress to the apex. A plastic strain of volume lowers the mean stress, and
   !> raises the apex if the solid dilates; one that does not is let dilate there alone
   pure subroutine return_to_apex(planes, trial, stress, derivative, growth)
      !> The criterion
      type(yield_planes_type), intent(in) :: planes
      !> Trial stress
      real(wp), intent(in) :: trial(3)
      !> Stress at the apex, and its derivatives
      real(wp), intent(out) :: stress(3), derivative(3, 3)
      !> Plastic strain that hardens
      real(wp), intent(out) :: growth

      real(wp) :: resistance, rise
      integer :: i

      resistance = planes%bulk*planes%dilation + planes%apex*planes%hardening
      rise = 0.0_wp
      growth = 0.0_wp
      if (resistance > 0.0_wp) then
         growth = (dot_product(planes%mean, trial) - planes%apex*planes%strength)/resistance
         rise = planes%apex*planes%hardening/resistance
      end if
      stress = planes%apex*(planes%strength + planes%hardening*growth)*planes%hydrostatic
      do i = 1, 3
         derivative(:, i) = rise*planes%mean(i)*planes%hydrostatic
      end do
   end subroutine return_to_apex

   !> How far a stress lies beyond the planes
   pure real(wp) function excess(planes, stress, growth)
      !> The criterion
      type(yield_planes_type), intent(in) :: planes
      !> The stress
      real(wp), intent(in) :: stress(3)
      !> Plastic strain by which it has hardened
      real(wp), intent(in) :: growth

      integer :: k

      excess = -huge(1.0_wp)
      do k = 1, planes%n
         excess = max(excess, dot_product(planes%normal(:, k), stress) - planes%limit(k) &
            - planes%share(k)*planes%hardening*growth)
      end do
   end function excess

   !> Stress that others are small beside
   pure real(wp) function size_of(planes, trial)
      !> The criterion
      type(yield_planes_type), intent(in) :: planes
      !> Trial stress
      real(wp), intent(in) :: trial(3)

      size_of = max(maxval(abs(trial)), maxval(abs(planes%limit(:planes%n))), tiny(1.0_wp))
   end function size_of

   !> Unit matrix
   pure function identity() result(one)
      !> The matrix
      real(wp) :: one(3, 3)

      one = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], &
         [3, 3])
   end function identity

   !> Solve a small system by elimination, rows exchanged
   pure subroutine eliminate(n, matrix, right, singular)
      !> Number of equations
      integer, intent(in) :: n
      !> The matrix; destroyed
      real(wp), intent(inout) :: matrix(3, 3)
      !> Right sides, then solutions
      real(wp), intent(inout) :: right(3, 4)
      !> Whether there is none
      logical, intent(out) :: singular

      real(wp) :: row(3), other(4), factor, least
      integer :: i, k, pivot

      least = 1.0e-13_wp*maxval(abs(matrix(:n, :n)))
      singular = .false.
      do k = 1, n
         pivot = k - 1 + maxloc(abs(matrix(k:n, k)), 1)
         singular = .not. abs(matrix(pivot, k)) > least
         if (singular) return
         row(:n) = matrix(k, :n)
         matrix(k, :n) = matrix(pivot, :n)
         matrix(pivot, :n) = row(:n)
         other = right(k, :)
         right(k, :) = right(pivot, :)
         right(pivot, :) = other
         do i = 1, n
            if (i == k) cycle
            factor = matrix(i, k)/matrix(k, k)
            matrix(i, :n) = matrix(i, :n) - factor*matrix(k, :n)
            right(i, :) = right(i, :) - factor*right(k, :)
         end do
      end do
      do k = 1, n
         right(k, :) = right(k, :)/matrix(k, k)
      end do
   end subroutine eliminate

end module axijoint_element_yield_planes
