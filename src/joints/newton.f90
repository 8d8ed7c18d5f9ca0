!> Semi-smooth Newton iteration for the joint stress of all modes together, on
!> the condensed structure.
!>
!> The unknowns are the amplitudes e of the excess stress and the stress P on the
!> planes. They are the solution if P is what the law admits of P + gamma (t - P),
!> with the elastic stress t = k d of the jumps d, and e the amplitudes of t - P.
!> The solution is the same for every gamma in (0, 1], the way to it is not: a
!> point that slips and comes back by a small jump must stick before it slips
!> the other way, but a stiff joint makes much stress of a small jump. So
!> gamma k is about the stiffness of the bodies (the parameter of an augmented
!> Lagrangian: Alart and Curnier, Comput. Methods Appl. Mech. Eng. 92, 1991).
module axijoint_joints_newton
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : admit
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, seen_by_law
   use axijoint_joints_newton_system, only : linear_type, gathering_type, solve
   use axijoint_joints_planes, only : synthesize, analyse
   use axijoint_joints_scene, only : scene_type, views
   use axijoint_model_joint_points, only : in_structure
   implicit none
   private
   public :: newton_type, step_bounds_type, see, linearize, newton_step, at_points, newton_view, bold, most_damping

   !> Stiffness k h/E of joints that the laws see at most at a time
   real(wp), parameter :: newton_view = 10.0_wp
   !> Share of the largest stress that is rounding
   real(wp), parameter :: rounding = 1.0e-14_wp
   !> Values on the planes from which on threads are worth their start
   integer, parameter :: worth_threads = 5000
   !> Shortest part of a step, and how fast the radius of steps grows
   real(wp), parameter :: shortest = 1.0_wp/8.0_wp, widening = 4.0_wp
   !> Part of a linear solution that is not on its way to a state: next to nothing resists it
   real(wp), parameter :: astray = 1.0e-8_wp
   !> How many times as much may be missing after a step on the way
   real(wp), parameter :: bold = 2.0_wp
   !> Residual ratio below which an iterate is near to equilibrium, and the springs that damp a step
   !> there first, in parts of the stiffness of the bodies
   real(wp), parameter :: near = 0.1_wp, damping = 0.1_wp
   !> Springs that damp all steps of an attempt, at first and at most, in the same parts
   real(wp), parameter :: strong_damping = 0.5_wp
   !> What a step leaves over what was missing before: more than the first is farther off; between the
   !> two nothing resists the motion, or next to nothing
   real(wp), parameter :: no_more = 1.001_wp, no_less = 0.98_wp

   !> Laws of all points, linear about an iterate: the excess stress k d - P changes by the slopes of the linear
   !> system times the change of the jumps, and by -`rest`; the right side of the system is what is not transferred of
   !> k d - P - `rest`
   type, extends(linear_type) :: newton_type
      !> Change of P at the same jumps, shape (3, points, planes)
      real(wp), allocatable :: rest(:, :, :)
      !> Size of what is missing to the solution, in P and in e
      real(wp) :: merit = huge(1.0_wp)
      !> What linear solutions gather of the flexibilities
      type(gathering_type) :: gathering
   end type newton_type

   !> What a step changes of the state of the joints
   type :: iterate_type
      !> As in the state
      real(wp), allocatable :: excess(:, :, :), carried(:, :, :), jump(:, :, :)
   end type iterate_type

   !> What bounds a step
   type :: step_bounds_type
      !> Residual ratio of the iterate
      real(wp) :: far = 0.0_wp
      !> Tolerance of the linear solution
      real(wp) :: tolerance = 0.0_wp
      !> Jumps beyond which there is no state
      real(wp) :: largest = huge(1.0_wp)
      !> How many times as much may be missing after a step
      real(wp) :: more = bold
      !> Change of the jumps beyond which a step is shortened, and which grows then
      real(wp) :: radius = huge(1.0_wp)
      !> Springs that damp a step, as a share of the joints' stiffness; they weaken while that helps
      real(wp) :: damping = 0.0_wp
      !> Whether all steps are damped, by less the less is missing
      logical :: damps_all = .false.
      !> Steps in a row that were next to nothing of their linear solutions
      integer :: n_astray = 0
   end type step_bounds_type

contains

   !> Products of the matrices of all points and planes with their vectors
   pure function at_points(matrix, vector) result(product)
      !> Matrices, shape (3, 3, points, planes), and vectors, shape (3, points, planes)
      real(wp), intent(in) :: matrix(:, :, :, :), vector(:, :, :)
      !> Products, same shape
      real(wp) :: product(3, size(vector, 2), size(vector, 3))

      integer :: j, k

      do j = 1, size(vector, 3)
         do k = 1, size(vector, 2)
            product(:, k, j) = matmul(matrix(:, :, k, j), vector(:, k, j))
         end do
      end do
   end function at_points

   !> Change of P that linear laws make of that of the jumps: k d less the excess stress, and what they miss already
   subroutine change_of_stress(condensed, newton, jump, change)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws
      type(newton_type), intent(in) :: newton
      !> Changes of the jumps, shape (3, points, planes)
      real(wp), intent(in) :: jump(:, :, :)
      !> The change, same shape
      real(wp), intent(out) :: change(:, :, :)

      real(wp) :: base(3, size(jump, 2))
      integer :: j, k

      do k = 1, size(jump, 2)
         base(:, k) = condensed%points(k)%base
      end do
      !$omp parallel do private(k) if (size(jump) >= worth_threads)
      do j = 1, size(jump, 3)
         do k = 1, size(jump, 2)
            associate (slope => newton%slope(:, :, k, j), d => jump(:, k, j))
               change(:, k, j) = newton%rest(:, k, j) + base(:, k)*d &
                  - slope(:, 1)*d(1) - slope(:, 2)*d(2) - slope(:, 3)*d(3)
            end associate
         end do
      end do
      !$omp end parallel do
   end subroutine change_of_stress

   !> Values a part of a change away from others
   subroutine go(from, length, change, to)
      !> The others, shape (3, points, planes)
      real(wp), intent(in) :: from(:, :, :)
      !> The part
      real(wp), intent(in) :: length
      !> The change, same shape
      real(wp), intent(in) :: change(:, :, :)
      !> The values, same shape
      real(wp), intent(out) :: to(:, :, :)

      integer :: j

      !$omp parallel do if (size(to) >= worth_threads)
      do j = 1, size(to, 3)
         to(:, :, j) = from(:, :, j) + length*change(:, :, j)
      end do
      !$omp end parallel do
   end subroutine go

   !> Let the laws see the jumps of an iterate, and linearize them there
   subroutine see(condensed, scene, far, field, residual, newton)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The residual ratio of the iterate
      real(wp), intent(in) :: far
      !> The iterate with its jumps; takes the stress that is admitted
      type(joint_field_type), intent(inout) :: field
      !> Excess stress that is not transferred, shape (3, points, modes)
      real(wp), intent(out) :: residual(:, :, :)
      !> The laws about it
      type(newton_type), intent(inout) :: newton

      real(wp), allocatable :: admitted(:, :, :)

      allocate (admitted, mold=field%stress)
      call linearize(condensed, scene, far, field, newton, admitted, residual)
      call move_alloc(admitted, field%stress)
   end subroutine see

   !> Linearize the laws at the jumps of an iterate
   subroutine linearize(condensed, scene, far, field, newton, stress, residual)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The residual ratio of the iterate
      real(wp), intent(in) :: far
      !> The iterate with its jumps
      type(joint_field_type), intent(in) :: field
      !> The laws about it
      type(newton_type), intent(inout) :: newton
      !> Stress that the laws admit on the planes, shape (3, points, planes), and the excess stress
      !> that it leaves to transfer, shape (3, points, modes)
      real(wp), intent(out), optional :: stress(:, :, :), residual(:, :, :)

      real(wp) :: admitted(3), tangent(3, 3)
      real(wp) :: view(size(condensed%points)), limit(size(condensed%points))
      real(wp), allocatable :: left(:, :, :), missing(:, :, :)
      integer :: j, k

      view = views(condensed, scene, field)
      limit = [(min(1.0_wp, steepest(far)/max(tiny(1.0_wp), &
         field%share(k)*condensed%points(k)%proportion)), k=1, size(limit))]
      newton%stiff = [(any(field%share(k)*scene%laws(k)%stiffness &
                           > condensed%points(k)%base), k=1, size(condensed%points))]
      if (.not. allocated(newton%slope)) then
         allocate (newton%slope(3, 3, size(field%jump, 2), size(field%jump, 3)))
         allocate (newton%rest, mold=field%jump)
      end if
      allocate (left, missing, mold=field%jump)
      !$omp parallel do private(k, admitted, tangent) if (size(field%jump) >= worth_threads)
      do j = 1, size(field%jump, 3)
         do k = 1, size(field%jump, 2)
            associate (base => condensed%points(k)%base, law => scene%laws(k))
               call admit(law, field%memory(k, j), seen_by_law(law, k, j, view(k), field), &
                  admitted, tangent, view(k)*field%fading)
               if (present(stress)) stress(:, k, j) = admitted
               missing(:, k, j) = admitted - field%carried(:, k, j)
               call see_at_once(view(k)/limit(k), missing(:, k, j), tangent, newton%rest(:, k, j))
               call find_slope(base, limit(k)*field%share(k)*law%stiffness, tangent, newton%slope(:, :, k, j))
               left(:, k, j) = base*(field%jump(:, k, j) - field%moved(:, k, j)) + field%initial(:, k) - admitted
            end associate
         end do
      end do
      !$omp end parallel do
      newton%residual = analyse(scene%planes, left) - field%excess
      if (present(residual)) residual = newton%residual
      newton%merit = merit_of(condensed, newton%residual + analyse(scene%planes, missing), missing)
      if (any(abs(view - limit) > 0.0_wp)) newton%residual = newton%residual &
         + analyse(scene%planes, missing - newton%rest)
      if (present(stress)) then
         newton%rounding = rounding*maxval(abs(stress))
      else
         newton%rounding = rounding*maxval(abs(field%stress))
      end if
   end subroutine linearize

   !> What a law that sees a part of the way from the stress carried to that of the jump makes of all that it is to see
   !> at once: with its tangent T and the part v, (I - (1 - v) T)^-1 times what is missing, and v (I - (1 - v) T)^-1 T
   pure subroutine see_at_once(part, missing, tangent, rest)
      !> The part, over that which is to be seen
      real(wp), intent(in) :: part
      !> What is missing
      real(wp), intent(in) :: missing(3)
      !> The tangent
      real(wp), intent(inout) :: tangent(3, 3)
      !> What comes of that which is missing
      real(wp), intent(out) :: rest(3)

      real(wp) :: matrix(3, 3), inverse(3, 3)
      integer :: i

      rest = missing
      if (.not. abs(part - 1.0_wp) > 0.0_wp) return
      if (tangent(1, 1) + tangent(2, 2) + tangent(3, 3) >= 3.0_wp) then  ! the point holds: T = I
         rest = missing/part
         return
      end if
      if (.not. any(abs(tangent) > 0.0_wp)) return  ! it is open
      matrix = -(1.0_wp - part)*tangent
      do i = 1, 3
         matrix(i, i) = matrix(i, i) + 1.0_wp
      end do
      inverse = inverse_of(matrix)
      rest = inverse(:, 1)*missing(1) + inverse(:, 2)*missing(2) + inverse(:, 3)*missing(3)
      matrix = tangent
      do i = 1, 3
         tangent(:, i) = part*(inverse(:, 1)*matrix(1, i) + inverse(:, 2)*matrix(2, i) + inverse(:, 3)*matrix(3, i))
      end do
   end subroutine see_at_once

   !> Derivatives of the excess stress k d - P by the jumps
   pure subroutine find_slope(base, stiffness, tangent, slope)
      !> k, and the stiffness of the law as far as it is seen
      real(wp), intent(in) :: base(3), stiffness(3)
      !> Derivatives of P by what the law makes of the jumps
      real(wp), intent(in) :: tangent(3, 3)
      !> The derivatives
      real(wp), intent(out) :: slope(3, 3)

      integer :: i

      do i = 1, 3
         slope(:, i) = -stiffness(i)*tangent(:, i)
         slope(i, i) = slope(i, i) + base(i)
      end do
   end subroutine find_slope

   !> Stiffness k h/E above which laws are linearized as if they had no more: far from equilibrium a
   !> stiff law predicts stresses that the next iterate does not see; near to it, what such a
   !> linearization leaves falls slowly
   pure real(wp) function steepest(ratio)
      !> Residual ratio
      real(wp), intent(in) :: ratio

      if (ratio > 0.3_wp) then
         steepest = 1.0e2_wp
      else if (ratio > 1.0e-3_wp) then
         steepest = 1.0e4_wp
      else
         steepest = 1.0e5_wp
      end if
   end function steepest

   !> Inverse of a matrix, by its adjugate
   pure function inverse_of(matrix) result(inverse)
      !> The matrix
      real(wp), intent(in) :: matrix(3, 3)
      !> Its inverse
      real(wp) :: inverse(3, 3)

      associate (a => matrix)
         inverse(1, :) = [a(2, 2)*a(3, 3) - a(3, 2)*a(2, 3), a(3, 2)*a(1, 3) - a(1, 2)*a(3, 3), a(1, 2)*a(2, 3) - a(2, 2)*a(1, 3)]
         inverse(2, :) = [a(2, 3)*a(3, 1) - a(3, 3)*a(2, 1), a(3, 3)*a(1, 1) - a(1, 3)*a(3, 1), a(1, 3)*a(2, 1) - a(2, 3)*a(1, 1)]
         inverse(3, :) = [a(2, 1)*a(3, 2) - a(3, 1)*a(2, 2), a(3, 1)*a(1, 2) - a(1, 1)*a(3, 2), a(1, 1)*a(2, 2) - a(2, 1)*a(1, 2)]
         inverse = inverse/(a(1, 1)*inverse(1, 1) + a(2, 1)*inverse(1, 2) + a(3, 1)*inverse(1, 3))
      end associate
   end function inverse_of

   !> Size of what is missing, by the areas of the points
   pure real(wp) function merit_of(condensed, residual, missing) result(merit)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> In e: amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: residual(:, :, :)
      !> In P: shape (3, points, planes)
      real(wp), intent(in) :: missing(:, :, :)

      integer :: k

      merit = 0.0_wp
      do k = 1, size(condensed%points)
         merit = merit + condensed%points(k)%weight*(sum(residual(:, k, :)**2) &
                                                 + sum(missing(:, k, :)**2)/size(missing, 3))
      end do
   end function merit_of

   !> Springs that damp all steps of an attempt, at first and at most, as a share of the joints' stiffness in the structure
   pure real(wp) function most_damping(condensed)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed

      most_damping = strong_damping*share_of_bodies(condensed)
   end function most_damping

   !> Springs for the next step where all are damped: as much less as less is missing, so that the last steps are
   !> Newton's; stronger where more is missing than before; weaker where what is missing stays, so that a motion
   !> that nothing resists comes to the next contact, or runs away, in few steps
   pure real(wp) function next_damping(damping, left) result(next)
      !> Springs of the last step
      real(wp), intent(in) :: damping
      !> What is missing after it, over what was before
      real(wp), intent(in) :: left

      next = left*damping
      if (left > no_more) then
         next = widening*next
      else if (left > no_less) then
         next = next/widening
      end if
   end function next_damping

   !> Stiffness of the bodies, as a share of that which joints have in the structure, 1 at most
   pure real(wp) function share_of_bodies(condensed) result(share)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed

      share = 1.0_wp/maxval([1.0_wp, in_structure(condensed%points%proportion)])
   end function share_of_bodies

   !> One step. Near to equilibrium, where all points are about to slip, next to nothing may resist a
   !> motion, or less than nothing, for friction has no potential. A step along it goes too far, or
   !> against the force; one that springs damp goes along with the force, farther and farther.
   subroutine newton_step(condensed, scene, bounds, newton, field, residual, made)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> What bounds the step
      type(step_bounds_type), intent(inout) :: bounds
      !> Laws about the iterate; about the new one on return
      type(newton_type), intent(inout) :: newton
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress not transferred
      real(wp), intent(inout) :: residual(:, :, :)
      !> Whether a step was made; otherwise nothing changed
      logical, intent(out) :: made

      type(iterate_type) :: start, reached
      real(wp) :: least
      logical :: falls

      start = iterate_type(field%excess, field%carried, field%jump)
      least = newton%merit
      call step_along(condensed, scene, bounds, start, newton, field, residual, made, falls)
      if (bounds%damps_all) then
         bounds%damping = min(most_damping(condensed), &
            next_damping(bounds%damping, sqrt(newton%merit/max(tiny(least), least))))
      else if (bounds%damping > 0.0_wp) then
         bounds%damping = merge(bounds%damping/widening, 0.0_wp, made .and. falls)
      else if (made .and. .not. falls .and. bounds%far < near) then
         reached = iterate_type(field%excess, field%carried, field%jump)
         least = newton%merit
         call go_to(start)
         bounds%damping = damping*share_of_bodies(condensed)
         call step_along(condensed, scene, bounds, start, newton, field, residual, made, falls)
         if (.not. (made .and. newton%merit < least)) then
            bounds%damping = 0.0_wp
            call go_to(reached)
            made = .true.
         end if
      end if
      if (.not. made) call go_to(start)

   contains

      !> Back to an iterate
      subroutine go_to(iterate)
         !> The iterate
         type(iterate_type), intent(in) :: iterate

         field%excess = iterate%excess
         field%carried = iterate%carried
         field%jump = iterate%jump
         call see(condensed, scene, bounds%far, field, residual, newton)
      end subroutine go_to

   end subroutine newton_step

   !> One step by a linear solution, shortened until what is missing is not much more, but not below
   !> a part of it
   subroutine step_along(condensed, scene, bounds, start, newton, field, residual, made, falls)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> What bounds the step
      type(step_bounds_type), intent(inout) :: bounds
      !> The iterate
      type(iterate_type), intent(in) :: start
      !> Laws about the iterate; about the new one on return
      type(newton_type), intent(inout) :: newton
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress not transferred
      real(wp), intent(inout) :: residual(:, :, :)
      !> Whether the jumps are a state, and whether not much more is missing than before
      logical, intent(out) :: made, falls

      real(wp), allocatable :: change(:, :, :), amplitude(:, :, :), change_carried(:, :, :), jump(:, :, :)
      real(wp) :: length, before, least

      newton%kept = 1.0_wp - bounds%damping
      call solve(condensed, scene, newton%linear_type, bounds%tolerance, change, amplitude, &
         newton%gathering)
      jump = synthesize(scene%planes, amplitude)
      allocate (change_carried, mold=jump)
      call change_of_stress(condensed, newton, jump, change_carried)
      before = newton%merit
      length = 1.0_wp
      if (maxval(abs(jump)) > bounds%radius) then
         length = bounds%radius/maxval(abs(jump))
         bounds%radius = widening*bounds%radius
      end if
      bounds%n_astray = merge(bounds%n_astray + 1, 0, length < astray)
      least = shortest*length
      do
         field%excess = start%excess + length*change
         call go(start%carried, length, change_carried, field%carried)
         call go(start%jump, length, jump, field%jump)
         call see(condensed, scene, bounds%far, field, residual, newton)
         made = maxval(abs(field%jump)) <= bounds%largest
         falls = newton%merit < merge(bold, bounds%more, bounds%damping > 0.0_wp)*before
         if (made .and. falls .or. length <= least) exit
         length = 0.5_wp*length
      end do
   end subroutine step_along

end module axijoint_joints_newton
