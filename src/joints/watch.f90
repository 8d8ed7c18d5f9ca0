!> What is remembered from iterate to iterate, whatever the method: the path, the best residual, who
!> changed when
module axijoint_joints_watch
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, judge_states, count_state
   use axijoint_joints_method, only : verdict_type
   use axijoint_joints_path, only : iteration_type, append
   use axijoint_joints_residual, only : strictest
   use axijoint_joints_scene, only : scene_type, jumps
   implicit none
   private
   public :: watch_type, new_watch, note, end_watch, runaway

   !> Iterations in which a point that changes its state counts as restless
   integer, parameter :: recent = 12
   !> Jumps so many times larger than the displacements with elastic joints, and than those by what these joints do not
   !> carry, are no state. (The jumps of an elastic joint are no measure: they vanish if it is stiff.)
   real(wp), parameter :: runaway = 1.0e5_wp
   !> A residual ratio counts as better below this part of the best so far: iterations that creep have stalled
   real(wp), parameter :: better = 0.9_wp

   !> What is remembered
   type :: watch_type
      !> Iterates seen, and the line of each
      integer :: k = 0
      type(iteration_type), allocatable :: steps(:)
      !> Jumps beyond which there is no state
      real(wp) :: largest = 0.0_wp
      !> Best residual ratio since the task changed, and its iterate
      real(wp) :: best = huge(1.0_wp)
      integer :: best_at = 0
      !> States of the last iterate, and the iterate that changed them last, shape (points, planes)
      integer, allocatable :: before(:, :), changed(:, :)
   end type watch_type

contains

   !> Nothing seen yet
   function new_watch(condensed, scene, field, residual) result(watch)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Excess stress that is not transferred yet, shape (3, points, modes): what it moves is as large as a state, too, where
      !> loads alone move nothing, as weight does in ground whose stress balances it
      real(wp), intent(in), contiguous :: residual(:, :, :)
      !> The watch
      type(watch_type) :: watch

      allocate (watch%steps(0))
      watch%largest = runaway*maxval([tiny(1.0_wp), scene%loads%largest, abs(scene%loads%free), &
         abs(field%jump), abs(jumps(condensed, scene, residual, free=.false.))])
      watch%before = field%state
      watch%changed = 0*field%state
   end function new_watch

   !> Take note of an iterate: its line of the path, what changed, whether it ran away
   subroutine note(watch, condensed, scene, now, accumulates, residual, field, verdict)
      !> The watch
      type(watch_type), intent(inout) :: watch
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Increment, iterations made in it before the first of these, load factor
      type(iteration_type), intent(in) :: now
      !> Whether the method accumulates stress
      logical, intent(in) :: accumulates
      !> Excess stress that is not transferred, shape (3, points, modes)
      real(wp), intent(in) :: residual(:, :, :)
      !> State of the joints; takes the states of its points
      type(joint_field_type), intent(inout) :: field
      !> Takes the residual ratio and `ran_away`
      type(verdict_type), intent(inout) :: verdict

      watch%k = watch%k + 1
      call append(watch%steps, watch%k, now)
      verdict%residual = strictest(condensed%measure, scene%loads%reference, residual, &
         paper=accumulates)
      call judge_states(scene%laws, field)
      associate (step => watch%steps(watch%k))
         step%iteration = now%iteration + watch%k
         step%ratio = verdict%residual%ratio
         call count_state(field, scene%planes%place, step%n_slip, step%n_open)
         where (field%state /= watch%before) watch%changed = watch%k
         watch%before = field%state
         verdict%ran_away = .not. ieee_is_finite(step%ratio)
         if (verdict%ran_away) return
         verdict%ran_away = maxval(abs(field%jump)) > watch%largest
         if (step%ratio < better*watch%best) then
            watch%best = step%ratio
            watch%best_at = watch%k
         end if
      end associate
   end subroutine note

   !> End the iterations: the path goes on, and the state keeps what it left out of balance
   subroutine end_watch(watch, residual, field, path, verdict)
      !> The watch
      type(watch_type), intent(in) :: watch
      !> Excess stress that is not transferred, shape (3, points, modes)
      real(wp), intent(in) :: residual(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Convergence path
      type(iteration_type), allocatable, intent(inout) :: path(:)
      !> How they ended; takes the restless points
      type(verdict_type), intent(inout) :: verdict

      field%pending = residual
      path = [path, watch%steps(:watch%k)]
      if (.not. verdict%converged) verdict%restless = watch%changed > watch%k - recent
   end subroutine end_watch

end module axijoint_joints_watch
