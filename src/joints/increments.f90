!> Load increments one after the other, each to equilibrium at the joints
module axijoint_joints_increments
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_factors, only : report_failure
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_stop, only : check_stop
   use axijoint_base_text, only : to_text
   use axijoint_element_joint_law, only : memory_type, cuts_back
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, commit_field, judge_states, &
      set_initial_stress
   use axijoint_joints_history, only : history_type, target_type, new_history, new_state, &
      keep_state, note_failure, forget_failure, &
                                       note_residual
   use axijoint_joints_keeper, only : keeper_type
   use axijoint_joints_load_steps, only : step_type, first_step, next_step, halfway
   use axijoint_joints_loads, only : put_loads
   use axijoint_joints_method, only : method_type, control_type, verdict_type
   use axijoint_joints_methods, only : other_loop, second_opinion
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_residual, only : load_norm, ratio, set_reference
   use axijoint_joints_scene, only : elastic_stress
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type, increment_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: run_increments, compare_loops, balance_again

   !> A step that finds no equilibrium is halved so many times at most
   integer, parameter :: most_halvings = 6

   !> What the increments of a job act on
   type :: stage_type
      !> The job, and the factors of its load cases
      type(model_type), pointer :: model => null()
      type(combination_type), pointer :: combination => null()
      !> Equations of all modes, and the condensed structure
      type(equations_type), pointer :: equations => null()
      type(condensed_type), pointer :: condensed => null()
      !> Points of all joints, and of all springs
      type(model_joint_point_type), pointer :: joint_points(:) => null()
      type(support_point_type), pointer :: supports(:) => null()
   end type stage_type

contains

   !> Apply the increments. Each starts from the last state in equilibrium, whose
   !> slip is kept; one that finds none is halved (not if stress is accumulated, which
   !> is all the memory then).
   subroutine run_increments(model, equations, condensed, joint_points, supports, combination, &
      history, progress, keeper)
      !> The job
      type(model_type), intent(in), target :: model
      !> Equations of all modes, assembled
      type(equations_type), intent(inout), target :: equations
      !> The condensed structure
      type(condensed_type), intent(in), target :: condensed
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in), target :: joint_points(:)
      type(support_point_type), intent(in), target :: supports(:)
      !> Factors of the load cases
      type(combination_type), intent(in), target :: combination
      !> What it came to
      type(history_type), intent(out) :: history
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Who may know how far an earlier run came, and is told of every step in equilibrium
      class(keeper_type), intent(inout), optional :: keeper

      type(stage_type) :: stage

      stage%model => model
      stage%equations => equations
      stage%condensed => condensed
      stage%joint_points => joint_points
      stage%supports => supports
      stage%combination => combination
      call new_history(model, condensed, history)
      if (history%method%accumulates .and. .not. all(cuts_back(history%scene%laws))) then
         call fatal_error(history%failure, exit_deck, &
            'the loop of TRANSFER accumulates stress, which the law of a joint'// &
                          ' does not follow from: METHOD may be NEWTON, ANDERSON or TOTAL')
         return
      end if
      history%at = first_step(combination)
      if (present(keeper)) call go_on_from(stage, keeper, history)
      do while (history%increment < size(model%increments) .or. size(history%ahead) > 0)
         call check_stop(history%failure)
         if (allocated(history%failure)) return
         if (size(history%ahead) == 0) call begin_increment(stage, history, progress)
         call reach_next(stage, history)
         if (.not. history%verdict%converged) then
            if (size(history%ahead) == 0 .or. allocated(history%failure)) return
            cycle  ! in smaller steps
         end if
         if (size(history%ahead) == 0) call end_increment(stage, history)
         if (present(keeper)) call keeper%keep(history)
      end do
   end subroutine run_increments

   !> Go on from where an earlier run was
   subroutine go_on_from(stage, keeper, history)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> Who knows
      class(keeper_type), intent(inout) :: keeper
      !> The history, new
      type(history_type), intent(inout) :: history

      real(wp), allocatable :: factor(:)
      logical :: restored

      call keeper%restore(history, restored, history%failure)
      if (.not. restored) return
      factor = history%loading%case_factor
      call put_on_nodes(stage, factor, history%loading)
      factor = history%peak%case_factor
      call put_on_nodes(stage, factor, history%peak)
   end subroutine go_on_from

   !> The loads of the next increment lie ahead
   subroutine begin_increment(stage, history, progress)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> The history
      type(history_type), intent(inout) :: history
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      history%increment = history%increment + 1
      associate (increments => stage%model%increments, n => history%increment)
         history%ahead = [target_type(next_step(history%at, increments(n), stage%combination), &
                                      most_halvings)]
         call show_progress(progress, 'increment '//to_text(n)//' of '//to_text(size(increments)))
      end associate
   end subroutine begin_increment

   !> The loads of the increment are reached
   subroutine end_increment(stage, history)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> The history
      type(history_type), intent(inout) :: history

      real(wp), allocatable :: factor(:)

      call forget_failure(history)
      if (history%increment == size(stage%model%increments)) return
      factor = history%at%case_factor
      call keep_state(stage%condensed, history%increment, history%at%load_factor, factor, history)
   end subroutine end_increment

   !> Go to the loads that lie ahead next. If that finds no equilibrium, half the way there lies
   !> ahead then, or nothing any more: the history has ended
   subroutine reach_next(stage, history)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> The history
      type(history_type), intent(inout) :: history

      type(target_type) :: target
      type(joint_field_type), allocatable :: before
      class(method_type), allocatable :: second

      target = history%ahead(size(history%ahead))
      before = history%field
      call put(stage, target%step, history)
      call balance(stage, history%method, target%step, history)
      if (history%verdict%converged) return
      if (ends(history)) then
         history%ahead = history%ahead(:0)
         return
      end if
      call note_failure(history)
      if (target%halvings > 0 .and. .not. history%method%accumulates) then
         history%field = before
         target%halvings = target%halvings - 1
         history%ahead = [history%ahead(:size(history%ahead) - 1), target, &
            target_type(halfway(history%at, target%step), target%halvings)]
         return
      end if
      if (allocated(history%runaway) .or. allocated(history%motion)) then
         if (.not. history%verdict%mechanism%loaded) &
            call second_opinion(history%method, second)
         if (allocated(second)) then
            history%field = before
            call put(stage, target%step, history)
            call balance(stage, second, target%step, history)
            if (history%verdict%converged .or. allocated(history%failure)) return
         end if
         history%field = before  ! what ran away is no state to show
         call put(stage, history%at, history)
         call judge_states(history%scene%laws, history%field)  ! none was, before the first load
      end if
      history%ahead = history%ahead(:0)
   end subroutine reach_next

   !> Iterate the step to the loads that were put on. If it is in equilibrium, they lie behind
   subroutine balance(stage, method, step, history)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> How joints are brought to equilibrium
      class(method_type), intent(in) :: method
      !> The loads
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(inout) :: history

      call balance_step(stage%condensed, stage%model%increments(history%increment), &
         history%increment, step%load_factor, method, history)
      if (.not. history%verdict%converged) then
         call check_stop(history%failure)  ! the iterations may have ended for it
         return
      end if
      history%at = step
      history%ahead = history%ahead(:size(history%ahead) - 1)
   end subroutine balance

   !> Load the structure
   subroutine put(stage, step, history)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> Loads
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(inout) :: history

      call put_on_nodes(stage, step%case_factor, history%loading)
      call put_loads(stage%equations, stage%condensed, history%loading, history%scene%loads)
      history%largest_elastic = maxval([history%largest_elastic, history%scene%loads%largest])
      history%load_norm = load_norm(stage%equations, history%loading)
      call report_failure(stage%equations, stage%model, history%failure)
      call set_initial_stress(stage%model, stage%condensed%points, step%case_factor, history%field)
   end subroutine put

   !> Loads on the nodes
   subroutine put_on_nodes(stage, case_factor, loading)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> Factor of each load case
      real(wp), intent(in) :: case_factor(:)
      !> The loads
      type(loading_type), intent(out) :: loading

      call new_loading(stage%model, stage%joint_points, stage%supports, stage%equations%modes, &
                       combination_type(stage%combination%label, case_factor), loading)
   end subroutine put_on_nodes

   !> Whether there is nothing to try about the last step: it is in equilibrium, or as near as
   !> numbers go, or ended for another reason, or was of a loop that does no more than end
   pure logical function ends(history)
      !> The history
      type(history_type), intent(in) :: history

      associate (verdict => history%verdict)
         ends = allocated(history%failure) .or. verdict%converged .or. verdict%at_rounding &
            .or. (history%method%accumulates .and. .not. verdict%mechanism%loaded)
      end associate
   end function ends

   !> Iterate a step of an increment, and keep what it came to
   subroutine balance_step(condensed, increment, number, load_factor, method, history)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The increment, and its number
      type(increment_type), intent(in) :: increment
      integer, intent(in) :: number
      !> Sum of the load factors
      real(wp), intent(in) :: load_factor
      !> How joints are brought to equilibrium
      class(method_type), intent(in) :: method
      !> The history, loaded
      type(history_type), intent(inout) :: history

      type(memory_type), allocatable :: start(:, :)
      real(wp), allocatable :: stress(:, :, :)

      history%verdict%converged = .false.
      if (allocated(history%failure)) return
      start = history%field%memory
      if (history%load_norm >= history%peak_norm) then
         history%peak_norm = history%load_norm
         history%peak = history%loading
      end if
      stress = elastic_stress(condensed, history%scene, history%field)
      call set_reference(condensed%measure, history%peak_norm, stress - history%balanced, &
         increment%tolerance, &
                         history%scene%loads%reference)
      history%control = control_type(increment%tolerance, increment%max_iterations, &
                                     iteration_type(increment=number, load_factor=load_factor))
      if (size(history%path) > 0) then
         associate (last => history%path(size(history%path)))
            if (last%increment == number) history%control%now%iteration = last%iteration
         end associate
      end if
      history%exchanged = history%exchanged - condensed%team%exchanged()
      call method%balance(condensed, history%scene, history%control, history%field, history%path, &
         history%verdict)
      history%exchanged = history%exchanged + condensed%team%exchanged()
      call note_residual(condensed, number, load_factor, history)
      if (.not. history%verdict%converged) return
      if (history%field%fading > 0.0_wp) history%n_faded = history%n_faded + 1
      call move_alloc(stress, history%balanced)
      call move_alloc(start, history%start)
      history%reached = load_factor
      associate (largest => maxval(abs(history%field%stress), 3), loads => history%scene%loads)
         loads%stress = max(loads%stress, largest)
         history%largest_stress = max(history%largest_stress, maxval(largest, 1))
      end associate
      history%memory = history%field%memory
      if (.not. method%accumulates) call commit_field(history%scene%laws, history%field)
   end subroutine balance_step

   !> Balance the last step again, after the response of the structure was corrected
   subroutine balance_again(condensed, history, tolerance)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> What the increments came to; its path goes on
      type(history_type), intent(inout) :: history
      !> Tolerance on the residual ratio; that of the increment if absent
      real(wp), intent(in), optional :: tolerance

      type(control_type) :: control

      control = history%control
      control%warm = .true.
      control%now = history%path(size(history%path))
      if (present(tolerance)) control%tolerance = tolerance
      history%field%memory = history%memory
      call history%method%balance(condensed, history%scene, control, history%field, history%path, &
         history%verdict)
      history%noted = .false.  ! in the place of the last
      call note_residual(condensed, control%now%increment, control%now%load_factor, history)
      history%memory = history%field%memory
      if (history%verdict%converged) call commit_field(history%scene%laws, history%field)
   end subroutine balance_again

   !> Largest difference of joint stress that the other kind of loop leaves, over the
   !> largest joint stress: of the paper's loop at its tolerance of 3 % for the
   !> methods on total jumps, and of Newton's method for the paper's loop. For a
   !> job of one increment; negative if that loop does not get there in a few sweeps.
   subroutine compare_loops(model, condensed, history, difference, other)
      !> The job
      type(model_type), intent(in) :: model
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The difference
      real(wp), intent(out) :: difference
      !> The state of the other loop; allocated if it got there
      type(joint_field_type), allocatable, intent(out) :: other

      real(wp), parameter :: paper_tolerance = 0.03_wp, strict = 1.0e-8_wp
      integer, parameter :: most_sweeps = 40
      class(method_type), allocatable :: method
      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict

      difference = -1.0_wp
      if (.not. history%verdict%converged .or. size(model%increments) > 1) return
      if (any(model%joint_materials%law%gap > 0.0_wp)) return  ! the paper's loop knows none
      method = other_loop(history%method)
      allocate (path(0))
      allocate (other, source=new_state(condensed, history%scene))
      call set_initial_stress(model, condensed%points, history%loading%case_factor, other)
      call method%balance(condensed, history%scene, &
         control_type(merge(paper_tolerance, strict, method%accumulates), &
                                                                 most_sweeps), other, path, verdict)
      if (verdict%converged) then
         difference = ratio(maxval(abs(other%stress - history%field%stress)), &
            maxval(abs(history%field%stress)))
      else
         deallocate (other)
      end if
   end subroutine compare_loops

end module axijoint_joints_increments
