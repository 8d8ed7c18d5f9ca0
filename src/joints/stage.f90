!> What load increments act on, and the increments one after the other: what brings a step to
!> equilibrium, joints or bodies that yield with them, extends the stage
module axijoint_joints_stage
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_stop, only : check_stop
   use axijoint_base_text, only : to_text
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_history, only : history_type, target_type
   use axijoint_joints_keeper, only : keeper_type
   use axijoint_joints_load_steps, only : step_type, first_step, next_step, halfway, on_the_way
   use axijoint_joints_methods, only : is_newton
   use axijoint_joints_residual, only : load_norm
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: stage_type, apply_increments

   !> A step that finds no equilibrium is halved so many times at most
   integer, parameter :: most_halvings = 6
   !> One that is no more than a help is halved less often
   integer, parameter :: few_halvings = 1
   !> Share of the loads that NEWTON takes away first where all go and joints alone hold a part: without load it would
   !> stand anywhere, so the last bit of the load says where. Other methods find that bit slowly, if at all
   real(wp), parameter :: most_of_it = 0.999_wp

   !> What the increments of a job act on
   type, abstract :: stage_type
      !> The job, and the factors of its load cases
      type(model_type), pointer :: model => null()
      type(combination_type), pointer :: combination => null()
      !> Equations of all modes, and the condensed structure; it is empty if no joint can yield
      type(equations_type), pointer :: equations => null()
      type(condensed_type), pointer :: condensed => null()
      !> Points of all joints, and of all springs
      type(model_joint_point_type), pointer :: joint_points(:) => null()
      type(support_point_type), pointer :: supports(:) => null()
   contains
      !> Loads on the nodes
      procedure :: put_on_nodes
      !> The history was brought to where an earlier run was
      procedure :: go_on
      !> An increment begins
      procedure :: begin_increment
      !> Put the loads of a step on and iterate
      procedure(try_step), deferred :: try
      !> Smaller steps are not tried, or got nowhere
      procedure(leave_step), deferred :: give_up
      !> The loads of the increment are reached
      procedure(note_history), deferred :: end_increment
      !> A keeper is about to be told of a step in equilibrium
      procedure :: remember
   end type stage_type

   abstract interface
      !> Put the loads of a step on and iterate. If that is equilibrium, the verdict of the history
      !> says so, and the next step starts there
      subroutine try_step(self, step, history, halvable)
         import :: stage_type, step_type, history_type
         !> What the increments act on
         class(stage_type), intent(inout) :: self
         !> The loads; those found, if a displacement is given instead
         type(step_type), intent(inout) :: step
         !> The history
         type(history_type), intent(inout) :: history
         !> Whether smaller steps may get there if this one did not
         logical, intent(out) :: halvable
      end subroutine try_step

      !> Smaller steps are not tried, or got nowhere: another way to equilibrium, or what is shown
      subroutine leave_step(self, step, before, history)
         import :: stage_type, step_type, joint_field_type, history_type
         !> What the increments act on
         class(stage_type), intent(inout) :: self
         !> The loads
         type(step_type), intent(in) :: step
         !> Joints before the step
         type(joint_field_type), intent(in) :: before
         !> The history
         type(history_type), intent(inout) :: history
      end subroutine leave_step

      !> The loads of the increment are reached
      subroutine note_history(self, history)
         import :: stage_type, history_type
         !> What the increments act on
         class(stage_type), intent(inout) :: self
         !> The history
         type(history_type), intent(inout) :: history
      end subroutine note_history
   end interface

contains

   !> Apply the increments. Each starts from the last state in equilibrium; one that finds none is
   !> halved. Where halves find none either, the history ends
   subroutine apply_increments(stage, history, progress, keeper)
      !> What they act on
      class(stage_type), intent(inout) :: stage
      !> What they come to; new
      type(history_type), intent(inout) :: history
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Who may know how far an earlier run came, and is told of every step in equilibrium
      class(keeper_type), intent(inout), optional :: keeper

      history%at = first_step(stage%combination)
      if (present(keeper)) call go_on_from(stage, keeper, history)
      do while (history%increment < size(stage%model%increments) .or. size(history%ahead) > 0)
         call stage%equations%team%share_wish()
         call check_stop(history%failure)
         if (allocated(history%failure)) return
         if (size(history%ahead) == 0) call go_ahead(stage, history, progress)
         call reach_next(stage, history)
         if (allocated(history%failure)) return
         if (.not. history%verdict%converged) then
            if (size(history%ahead) == 0) return
            cycle  ! in smaller steps
         end if
         if (size(history%ahead) == 0) call stage%end_increment(history)
         if (.not. present(keeper)) cycle
         call stage%remember(history)
         call keeper%keep(history)
      end do
   end subroutine apply_increments

   !> Go on from where an earlier run was
   subroutine go_on_from(stage, keeper, history)
      !> What the increments act on
      class(stage_type), intent(inout) :: stage
      !> Who knows
      class(keeper_type), intent(inout) :: keeper
      !> The history, new
      type(history_type), intent(inout) :: history

      real(wp), allocatable :: factor(:)
      logical :: restored

      call keeper%restore(history, restored, history%failure)
      if (.not. restored) return
      factor = history%loading%case_factor
      call stage%put_on_nodes(factor, history%loading)
      factor = history%peak%case_factor
      call stage%put_on_nodes(factor, history%peak)
      call stage%go_on(history)
   end subroutine go_on_from

   !> The loads of the next increment lie ahead
   subroutine go_ahead(stage, history, progress)
      !> What the increments act on
      class(stage_type), intent(inout) :: stage
      !> The history
      type(history_type), intent(inout) :: history
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(step_type) :: next

      history%increment = history%increment + 1
      history%at%share = 0.0_wp
      associate (increments => stage%model%increments, n => history%increment)
         next = next_step(history%at, increments(n), stage%combination)
         history%ahead = [target_type(next, most_halvings)]
         if (size(stage%condensed%floating) > 0 .and. is_newton(history%method)) then
            if (takes_loads_away(stage, next, history)) history%ahead = [history%ahead, &
               target_type(on_the_way(history%at, next, most_of_it), few_halvings, helps=.true.)]
         end if
         call show_progress(progress, 'increment '//to_text(n)//' of '//to_text(size(increments)))
      end associate
      call stage%begin_increment()
   end subroutine go_ahead

   !> Whether a step takes all loads away, of whichever load cases they are
   logical function takes_loads_away(stage, step, history) result(all_go)
      !> What the increments act on
      class(stage_type), intent(in) :: stage
      !> The step
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(in) :: history

      !> Loads that are no more than this part of those before are rounding
      real(wp), parameter :: rounding = 1.0e-12_wp
      type(loading_type) :: loading

      all_go = .false.
      if (allocated(step%steered) .or. .not. history%load_norm > 0.0_wp) return
      call stage%put_on_nodes(step%case_factor, loading)
      all_go = load_norm(stage%equations, loading) <= rounding*history%load_norm
   end function takes_loads_away

   !> Go to the loads that lie ahead next. If that finds no equilibrium, half the way there lies ahead then, or, where
   !> the loads were no more than a help, those behind them, or nothing any more: the history has ended
   subroutine reach_next(stage, history)
      !> What the increments act on
      class(stage_type), intent(inout) :: stage
      !> The history
      type(history_type), intent(inout) :: history

      type(target_type) :: target
      type(joint_field_type), allocatable :: before
      logical :: halvable

      target = history%ahead(size(history%ahead))
      before = history%field
      history%thorough = target%halvings == merge(few_halvings, most_halvings, target%helps) .or. target%halvings == 0
      history%smallest = target%halvings == 0
      call stage%try(target%step, history, halvable)
      if (allocated(history%failure)) return
      if (.not. history%verdict%converged .and. halvable .and. target%halvings > 0) then
         history%field = before
         target%halvings = target%halvings - 1
         history%ahead = [history%ahead(:size(history%ahead) - 1), target, &
            target_type(halfway(history%at, target%step), target%halvings, target%helps)]
         return
      end if
      if (.not. history%verdict%converged .and. target%helps) then
         history%field = before
         history%ahead = history%ahead(:1)  ! what it was to help with
         return
      end if
      if (.not. history%verdict%converged) call stage%give_up(target%step, before, history)
      if (history%verdict%converged) then
         history%at = target%step
         history%ahead = history%ahead(:size(history%ahead) - 1)
      else
         history%ahead = history%ahead(:0)
      end if
   end subroutine reach_next

   !> Loads on the nodes
   subroutine put_on_nodes(self, case_factor, loading)
      !> What the increments act on
      class(stage_type), intent(in) :: self
      !> Factor of each load case
      real(wp), intent(in) :: case_factor(:)
      !> The loads
      type(loading_type), intent(out) :: loading

      call new_loading(self%model, self%joint_points, self%supports, self%equations%modes, self%equations%unit_loads, &
                       combination_type(self%combination%label, case_factor), loading)
   end subroutine put_on_nodes

   !> The history was brought to where an earlier run was: joints know nothing else
   subroutine go_on(self, history)
      !> What the increments act on
      class(stage_type), intent(inout) :: self
      !> The history
      type(history_type), intent(inout) :: history

      associate (unused => self, same => history)
      end associate
   end subroutine go_on

   !> An increment begins: joints need no word of it
   subroutine begin_increment(self)
      !> What the increments act on
      class(stage_type), intent(inout) :: self

      associate (unused => self)
      end associate
   end subroutine begin_increment

   !> A keeper is about to be told of a step in equilibrium: of joints the history has all
   subroutine remember(self, history)
      !> What the increments act on
      class(stage_type), intent(inout) :: self
      !> The history
      type(history_type), intent(inout) :: history

      associate (unused => self, same => history)
      end associate
   end subroutine remember

end module axijoint_joints_stage
