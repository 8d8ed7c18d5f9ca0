!> The stress transfer method on total jumps: the stress follows from the jumps of the whole load,
!> and what the laws do not admit of it is transferred; sweep by sweep as it is, or mixed with that
!> of earlier sweeps (Anderson)
module axijoint_joints_total
   use axijoint_base_kinds, only : wp
   use axijoint_base_stop, only : stop_wished
   use axijoint_element_joint_law, only : opening_bond
   use axijoint_joints_anderson, only : anderson_type, new_anderson, anderson_step
   use axijoint_joints_approach, only : approach
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_mechanism, only : balance_motions
   use axijoint_joints_method, only : method_type, control_type, verdict_type
   use axijoint_joints_newton_method, only : newton_method_type, stiff
   use axijoint_joints_passes, only : pass_on
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_scene, only : scene_type
   use axijoint_joints_watch, only : watch_type, new_watch, note, end_watch
   implicit none
   private
   public :: total_type

   !> The loop no longer balances rigid motions after so many sweeps without a better residual
   integer, parameter :: most_moves = 25

   !> The method
   type, extends(method_type) :: total_type
      !> Sweeps that Anderson's mix remembers; none for the loop as it is
      integer :: depth = 0
   contains
      procedure :: balance
   end type total_type

contains

   !> Iterate a load step to equilibrium
   subroutine balance(self, condensed, scene, control, field, path, verdict)
      !> The method
      class(total_type), intent(in) :: self
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> When to end
      type(control_type), intent(in) :: control
      !> State of the joints: of the last step, then of this one
      type(joint_field_type), intent(inout) :: field
      !> Convergence path, to be continued
      type(iteration_type), allocatable, intent(inout) :: path(:)
      !> How it ended
      type(verdict_type), intent(out) :: verdict

      type(watch_type) :: watch
      type(anderson_type) :: memory
      real(wp), allocatable :: residual(:, :, :), begun(:, :, :)
      logical :: again, moved, moves

      allocate (residual, mold=field%excess)
      field%view_limit = huge(1.0_wp)
      if (condensed%proportion > stiff) call break_as_newton(condensed, scene, control, field)
      begun = field%jump
      call self%evaluate(condensed, scene, field, residual)
      call approach(condensed, scene, .true., begun, field, residual, moved)
      watch = new_watch(condensed, scene, field, residual)
      memory = new_anderson(size(residual), self%depth)
      moves = self%depth == 0
      do
         call note(watch, condensed, scene, control%now, self%accumulates, residual, field, verdict)
         call condensed%team%share_wish()
         if (stop_wished()) exit  ! nobody uses what was reached
         if (verdict%ran_away) exit
         moves = moves .and. watch%k <= watch%best_at + most_moves
         call pass_on(self, condensed, scene, control%tolerance, field, residual, verdict, again)
         if (verdict%converged .or. verdict%mechanism%loaded .or. watch%k >= control%most) exit
         if (again) then
            watch%best = huge(1.0_wp)
            memory = new_anderson(size(residual), self%depth)
            call self%evaluate(condensed, scene, field, residual)
         end if
         field%carried = field%stress
         if (self%depth > 0) then
            call mix(memory, residual, field%excess)
         else
            field%excess = field%excess + residual
            call self%evaluate(condensed, scene, field, residual)
            call approach(condensed, scene, .true., begun, field, residual, moved)
            ! motions and excess stress may go on against each other without end: then the loop goes
            ! on alone
            if (moves) call balance_motions(condensed, scene, field)
         end if
         call self%evaluate(condensed, scene, field, residual)
      end do
      call end_watch(watch, residual, field, path, verdict)
   end subroutine balance

   !> The next excess stress by Anderson's mix
   subroutine mix(memory, residual, excess)
      !> Sweeps before
      type(anderson_type), intent(inout) :: memory
      !> Excess stress not transferred, shape (3, points, modes)
      real(wp), intent(in) :: residual(:, :, :)
      !> Excess stress, same shape
      real(wp), intent(inout) :: excess(:, :, :)

      real(wp), allocatable :: x(:)

      x = reshape(excess, [size(excess)])
      call anderson_step(memory, x, reshape(residual, [size(x)]))
      excess = reshape(x, shape(excess))
   end subroutine mix

   !> Break the bonds that Newton's iteration breaks. In loosely balanced states the order
   !> of breaking belongs to the iterates; so all methods on total jumps take it from
   !> Newton's, and end in the same state.
   subroutine break_as_newton(condensed, scene, control, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> When to end
      type(control_type), intent(in) :: control
      !> State of the joints; its bonds break
      type(joint_field_type), intent(inout) :: field

      type(newton_method_type) :: newton
      type(joint_field_type), allocatable :: torn
      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict

      if (all(scene%laws%opening /= opening_bond)) return
      allocate (torn, source=field)
      allocate (path(0))
      call newton%balance(condensed, scene, control_type(control%tolerance, control%most), torn, &
         path, verdict)
      if (verdict%converged) field%memory%broken = torn%memory%broken
   end subroutine break_as_newton

end module axijoint_joints_total
