!> Joints that are near to a state of equilibrium, brought to it by Newton's method
module axijoint_joints_settle
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type, opening_bond
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, mend
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, take_idle_away => settle, total_jumps
   use axijoint_joints_method, only : control_type, verdict_type
   use axijoint_joints_newton, only : newton_type, step_bounds_type, linearize, newton_step, &
      newton_view
   use axijoint_joints_newton_method, only : newton_method_type
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_scene, only : scene_type, evaluate
   implicit none
   private
   public :: settle_wholly, find_again, roughly

   !> Stress that may be missing, over what is missing at first: of an error one digit is enough, of states on the way to it less;
   !> over the stress, where nothing is to be left; and over the excess stress, of which points that
   !> stand open have rounding alone: a step would follow that
   real(wp), parameter :: one_digit = 0.003_wp, roughly = 0.03_wp, strict = 1.0e-10_wp, noise = 1.0e-13_wp
   !> Tolerance of the linear solutions, and most steps
   real(wp), parameter :: linear_tolerance = 0.01_wp, strict_tolerance = 1.0e-2_wp
   integer, parameter :: most_steps = 12
   !> From the beginning of the increment: residual over the loads, most iterations, and those after which the residual is
   !> a tenth of the loads if more of them are worth it: where they came to an end, it was 0.02 or less
   real(wp), parameter :: pass_tolerance = 1.0e-5_wp, near = 0.03_wp, hopeful = 0.1_wp
   integer, parameter :: most_iterations = 100, first_iterations = 20
   !> Jumps so many times larger than those before, and than what loads do where joints hold, are no answer to a small change: a
   !> part that nothing holds in the end has flown off
   real(wp), parameter :: far = 1.0e2_wp

contains

   !> Find the state of a changed scene. Which bonds break and which points soften is found from the
   !> beginning of the increment, and so is what Newton's method does not reach by itself
   subroutine find_again(condensed, scene, start, field, found, share, enough)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> What the points remembered at the beginning, shape (points, planes)
      type(memory_type), intent(in) :: start(:, :)
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Whether a state was found
      logical, intent(out) :: found
      !> Stress that may be missing over what is missing at first, if more than one digit leaves; and over the stress, if more than
      !> rounding leaves: where the state is one that was found before
      real(wp), intent(in), optional :: share, enough

      type(joint_field_type), allocatable :: before
      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict
      type(newton_method_type) :: newton
      real(wp) :: farthest, of_change, of_stress

      farthest = far*maxval([abs(scene%loads%largest), maxval(abs(scene%loads%free)), maxval(abs(field%jump))])
      if (all(scene%laws%opening /= opening_bond .and. .not. scene%laws%softens)) then
         allocate (before, source=field)
         of_change = one_digit
         of_stress = strict
         if (present(share)) of_change = share
         if (present(enough)) of_stress = enough
         call go_on(condensed, scene, of_change, of_stress, linear_tolerance, field, found)
         if (found) found = is_near(condensed, scene, field, farthest)
         if (found) return
         field = before
      end if
      call mend(start, field%memory)
      allocate (path(0))
      call newton%balance(condensed, scene, control_type(pass_tolerance, most_iterations, trial=first_iterations, hope=hopeful), &
         field, path, verdict)
      ! a law that jumps may have no state; an iterate that is so near tells by how much stresses
      ! change
      found = verdict%converged .or. (verdict%residual%whole <= near .and. .not. verdict%ran_away)
      if (found) found = is_near(condensed, scene, field, farthest)
   end subroutine find_again

   !> Whether jumps are not too large, but for motions that nothing resists and no load acts on
   logical function is_near(condensed, scene, field, farthest)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Jumps that are too large
      real(wp), intent(in) :: farthest

      type(joint_field_type), allocatable :: rest
      type(mechanism_type) :: mechanism

      is_near = maxval(abs(field%jump)) <= farthest
      if (is_near) return
      call find_mechanism(condensed, scene, field, .false., mechanism)
      allocate (rest, source=field)
      call take_idle_away(condensed, scene, mechanism, rest)
      is_near = maxval(abs(total_jumps(condensed, scene, rest))) <= farthest
   end function is_near

   !> Go as far as numbers do
   subroutine settle_wholly(condensed, scene, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field

      logical :: found

      call go_on(condensed, scene, 0.0_wp, strict, strict_tolerance, field, found)
   end subroutine settle_wholly

   !> Steps of Newton's method
   subroutine go_on(condensed, scene, share, least, tolerance, field, found)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> What may be missing, over what is missing at first, and over the stress
      real(wp), intent(in) :: share, least
      !> Tolerance of the linear solutions
      real(wp), intent(in) :: tolerance
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Whether it was found
      logical, intent(out) :: found

      type(newton_type) :: newton
      type(step_bounds_type) :: bounds
      real(wp), allocatable :: residual(:, :, :)
      real(wp) :: enough
      logical :: made
      integer :: k

      field%share = 1.0_wp
      field%view_limit = newton_view
      bounds%tolerance = tolerance
      allocate (residual, mold=field%excess)
      call evaluate(condensed, scene, field, residual)
      field%carried = field%stress
      call linearize(condensed, scene, 0.0_wp, field, newton)
      enough = max(share**2*newton%merit, rounding(condensed, field, least))  ! squares
      made = .true.
      do k = 1, most_steps
         if (newton%merit <= enough .or. .not. made) exit
         call newton_step(condensed, scene, bounds, newton, field, residual, made)
      end do
      found = newton%merit <= enough
   end subroutine go_on

   !> What may be missing of the stress, and rounding of the excess stress, squared
   pure real(wp) function rounding(condensed, field, least)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Stress over all of it
      real(wp), intent(in) :: least

      integer :: k

      rounding = 0.0_wp
      do k = 1, size(condensed%points)
         rounding = rounding + condensed%points(k)%weight*(least**2*sum(field%stress(:, k, :)**2) &
            /size(field%stress, 3) + noise**2*sum(field%excess(:, k, :)**2))
      end do
   end function rounding

end module axijoint_joints_settle
