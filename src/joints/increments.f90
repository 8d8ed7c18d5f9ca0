!> Load increments one after the other, each to equilibrium at the joints
module axijoint_joints_increments
   use omp_lib, only : omp_get_wtime
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_factors, only : report_failure
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_stop, only : check_stop
   use axijoint_element_joint_law, only : memory_type, cuts_back
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, commit_field, judge_states, &
      set_initial_stress, is_homogeneous, scale_field
   use axijoint_joints_history, only : history_type, new_history, new_state, &
      keep_state, note_failure, forget_failure, &
                                       note_residual
   use axijoint_joints_keeper, only : keeper_type
   use axijoint_joints_load_steps, only : step_type
   use axijoint_joints_loads, only : put_loads, answer_type, case_answer_type, is_known, learn_case, put_sum
   use axijoint_joints_mechanism, only : drives_on
   use axijoint_joints_method, only : method_type, control_type, verdict_type
   use axijoint_joints_methods, only : other_loop, second_opinion, is_newton
   use axijoint_joints_passes, only : keep_standing
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_residual, only : load_norm, ratio, set_reference
   use axijoint_joints_scene, only : elastic_stress, rounded_stress
   use axijoint_joints_stage, only : stage_type, apply_increments
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type, increment_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: run_increments, compare_loops, balance_again

   !> A mechanism under loads so many times farther off than those of the smallest step counts as that of the step
   real(wp), parameter :: near = 8.01_wp

   !> What the increments of joints act on
   type, extends(stage_type) :: joint_stage_type
      !> The last answer of the elastic structure to loads, if it is kept
      type(answer_type), pointer :: answer => null()
      !> What load cases do, if fewer of them act than there are increments, shape (cases)
      type(case_answer_type), allocatable :: cases(:)
   contains
      !> Put the loads of a step on and iterate
      procedure :: try => try_step
      !> Smaller steps are not tried, or got nowhere
      procedure :: give_up
      !> The loads of the increment are reached
      procedure :: end_increment
   end type joint_stage_type

contains

   !> Apply the increments. Each starts from the last state in equilibrium, whose
   !> slip is kept; one that finds none is halved (not if stress is accumulated, which
   !> is all the memory then).
   subroutine run_increments(model, equations, condensed, joint_points, supports, combination, &
      history, progress, keeper, answer)
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
      !> The last answer of the elastic structure to loads; becomes the next
      type(answer_type), intent(inout), target, optional :: answer

      type(joint_stage_type) :: stage
      real(wp) :: began

      stage%model => model
      stage%equations => equations
      stage%condensed => condensed
      stage%joint_points => joint_points
      stage%supports => supports
      stage%combination => combination
      if (present(answer)) stage%answer => answer
      if (count(abs(combination%factor) > 0.0_wp) < size(model%increments)) &
         allocate (stage%cases(size(combination%factor)))
      call new_history(model, condensed, history)
      if (history%method%accumulates .and. .not. all(cuts_back(history%scene%laws))) then
         call fatal_error(history%failure, exit_deck, &
            'the loop of TRANSFER accumulates stress, which the law of a joint'// &
                          ' does not follow from: METHOD may be NEWTON, ANDERSON or TOTAL')
         return
      end if
      began = omp_get_wtime()
      call apply_increments(stage, history, progress, keeper)
      history%seconds = omp_get_wtime() - began
   end subroutine run_increments

   !> Put the loads of a step on and iterate
   subroutine try_step(self, step, history, halvable)
      !> What the increments act on
      class(joint_stage_type), intent(inout) :: self
      !> The loads
      type(step_type), intent(inout) :: step
      !> The history
      type(history_type), intent(inout) :: history
      !> Whether smaller steps may get there if this one did not
      logical, intent(out) :: halvable

      call put(self, step, history)
      if (scales_with_load(history, step)) &
         call scale_field(step%load_factor/history%at%load_factor, history%field)
      call balance(self, history%method, step, history)
      halvable = .not. ends(history) .and. .not. history%method%accumulates
      if (.not. ends(history)) call note_failure(self%condensed, step, history)
   end subroutine try_step

   !> A step is left without equilibrium: another method is asked. If it knows no better and nothing resists, or iterations
   !> ran away, the state before is shown, for an iterate says nothing. Sweeps do not go on from what Newton's method finds,
   !> for they would run away again and again: the user is told
   subroutine give_up(self, step, before, history)
      !> What the increments act on
      class(joint_stage_type), intent(inout) :: self
      !> The loads
      type(step_type), intent(in) :: step
      !> Joints before the step
      type(joint_field_type), intent(in) :: before
      !> The history
      type(history_type), intent(inout) :: history

      class(method_type), allocatable :: second
      type(history_type), allocatable :: asked
      logical :: nothing_resists

      if (allocated(history%failure)) return
      ! what much larger steps came to says nothing of this one
      if (history%failed_share - history%at%share > near*(step%share - history%at%share)) call forget_failure(history)
      nothing_resists = allocated(history%motion)
      if (.not. (nothing_resists .or. history%verdict%ran_away .or. is_newton(history%method))) return
      if (.not. ends(history)) call second_opinion(history%method, second)
      if (allocated(second)) then
         allocate (asked, source=history)
         asked%field = before
         call put(self, step, asked)
         call balance(self, second, step, asked)
         if (allocated(asked%failure) .or. asked%verdict%converged .and. is_newton(history%method)) then
            history = asked
            return
         end if
         history%newton_finds = asked%verdict%converged
         if (history%newton_finds) call forget_failure(history)
         ! where iterations were used up, nothing is known of what resists
         if (.not. (nothing_resists .or. history%newton_finds) .and. (history%verdict%stalled .or. history%verdict%ran_away)) &
            call take_motion(self, step, asked, history)
         nothing_resists = allocated(history%motion)
      end if
      history%strayed = .not. nothing_resists .and. (history%newton_finds .or. history%verdict%ran_away)
      if (.not. (nothing_resists .or. history%strayed)) return
      history%field = before  ! what ran away is no state to show
      call put(self, history%at, history)
      call judge_states(history%scene%laws, history%field)  ! none was, before the first load
   end subroutine give_up

   !> Where iterations go round in circles: the motion that another method came to, or else one that a load drives on from
   !> where they are now
   subroutine take_motion(self, step, asked, history)
      !> What the increments act on
      class(joint_stage_type), intent(in) :: self
      !> The loads
      type(step_type), intent(in) :: step
      !> The same loads by another method, without equilibrium
      type(history_type), intent(inout) :: asked
      !> The history; takes the motion
      type(history_type), intent(inout) :: history

      real(wp), allocatable :: motion(:)
      logical :: driven

      call note_failure(self%condensed, step, asked)
      if (allocated(asked%motion)) call move_alloc(asked%motion, history%motion)
      if (allocated(history%motion)) return
      call drives_on(self%condensed, history%scene, history%field, driven, motion)
      if (driven) call move_alloc(motion, history%motion)
   end subroutine take_motion

   !> The loads of the increment are reached
   subroutine end_increment(self, history)
      !> What the increments act on
      class(joint_stage_type), intent(inout) :: self
      !> The history
      type(history_type), intent(inout) :: history

      real(wp), allocatable :: factor(:)

      call forget_failure(history)
      if (history%increment == size(self%model%increments)) return
      factor = history%at%case_factor
      call keep_state(self%condensed, history%increment, history%at%load_factor, factor, history)
   end subroutine end_increment

   !> Iterate the step to the loads that were put on
   subroutine balance(stage, method, step, history)
      !> What the increments act on
      type(joint_stage_type), intent(in) :: stage
      !> How joints are brought to equilibrium
      class(method_type), intent(in) :: method
      !> The loads
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(inout) :: history

      call balance_step(stage%condensed, stage%model%increments(history%increment), &
         history%increment, step%load_factor, method, history)
      ! the iterations may have ended for it
      if (.not. history%verdict%converged) call check_stop(history%failure)
   end subroutine balance

   !> Load the structure
   subroutine put(stage, step, history)
      !> What the increments act on
      type(joint_stage_type), intent(inout) :: stage
      !> Loads
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(inout) :: history

      call stage%put_on_nodes(step%case_factor, history%loading)
      if (allocated(stage%cases)) then
         call learn_cases(stage, step)
         call put_sum(stage%condensed, stage%cases, history%loading, history%scene%loads)
      else if (associated(stage%answer)) then
         call put_loads(stage%equations, stage%condensed, history%loading, history%scene%loads, &
            stage%answer)
      else
         call put_loads(stage%equations, stage%condensed, history%loading, history%scene%loads)
      end if
      history%largest_elastic = maxval([history%largest_elastic, history%scene%loads%largest])
      history%load_norm = load_norm(stage%equations, history%loading)
      call report_failure(stage%equations, stage%model, history%failure)
      call set_initial_stress(stage%model, stage%condensed%points, step%case_factor, history%field)
   end subroutine put

   !> Learn what the load cases of a step do, as far as that is not known
   subroutine learn_cases(stage, step)
      !> What the increments act on
      type(joint_stage_type), intent(inout) :: stage
      !> Loads
      type(step_type), intent(in) :: step

      type(loading_type) :: loading
      real(wp) :: factor(size(step%case_factor))
      integer :: k

      do k = 1, size(factor)
         if (is_known(stage%cases(k)) .or. .not. abs(step%case_factor(k)) > 0.0_wp) cycle
         factor = 0.0_wp
         factor(k) = 1.0_wp
         call stage%put_on_nodes(factor, loading)
         call learn_case(stage%equations, stage%condensed, loading, stage%cases(k))
      end do
   end subroutine learn_cases

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

   !> Whether the state before a step is one of it, too, times the loads of both: a smaller part of the first loads
   !> acted alone, and no law has a stress or a width of its own
   pure logical function scales_with_load(history, step) result(scales)
      !> The history, loaded with the step
      type(history_type), intent(in) :: history
      !> The step
      type(step_type), intent(in) :: step

      scales = history%increment == 1 .and. abs(history%at%load_factor) > 0.0_wp .and. .not. allocated(step%steered)
      if (scales) scales = is_homogeneous(history%scene%laws, history%field)
   end function scales_with_load

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
      real(wp), allocatable :: stress(:, :, :), change(:, :, :), begun(:, :, :)

      history%verdict%converged = .false.
      if (allocated(history%failure)) return
      start = history%field%memory
      begun = history%field%jump
      if (history%load_norm >= history%peak_norm) then
         history%peak_norm = history%load_norm
         history%peak = history%loading
      end if
      stress = elastic_stress(condensed, history%scene, history%field)
      change = stress - history%balanced
      call set_reference(condensed%measure, history%peak_norm, change, history%balanced, &
         rounded_stress(condensed, history%scene), increment%tolerance, history%scene%loads%reference)
      history%control = control_type(increment%tolerance, increment%max_iterations, &
                                     iteration_type(increment=number, load_factor=load_factor), &
                                     damps=history%thorough)
      if (size(history%path) > 0) then
         associate (last => history%path(size(history%path)))
            if (last%increment == number) history%control%now%iteration = last%iteration
         end associate
      end if
      history%exchanged = history%exchanged - condensed%team%exchanged()
      call method%balance(condensed, history%scene, history%control, history%field, history%path, &
         history%verdict)
      history%exchanged = history%exchanged + condensed%team%exchanged()
      if (history%verdict%converged) call keep_standing(method, condensed, history%scene, increment%tolerance, begun, change, &
         history%verdict%mechanism, history%field)
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
      real(wp), allocatable :: begun(:, :, :)
      logical :: stood

      begun = history%field%jump
      stood = .true.
      if (allocated(history%verdict%mechanism%stands)) stood = all(history%verdict%mechanism%stands)
      control = history%control
      control%warm = .true.
      control%damps = .true.
      control%now = history%path(size(history%path))
      if (present(tolerance)) control%tolerance = tolerance
      history%field%memory = history%memory
      call history%method%balance(condensed, history%scene, control, history%field, history%path, &
         history%verdict)
      if (history%verdict%converged) call keep_standing(history%method, condensed, history%scene, control%tolerance, begun, &
         0.0_wp*history%field%excess, history%verdict%mechanism, history%field)
      ! where they stood a moment ago may not be where the step began
      if (allocated(history%verdict%mechanism%stands)) &
         history%verdict%mechanism%stands = history%verdict%mechanism%stands .and. stood
      history%noted = .false.  ! in the place of the last
      call note_residual(condensed, control%now%increment, control%now%load_factor, history)
      history%memory = history%field%memory
      if (history%verdict%converged) call commit_field(history%scene%laws, history%field)
   end subroutine balance_again

   !> Largest difference of joint stress that the other kind of loop leaves, over the
   !> largest joint stress: of the paper's loop at its tolerance of 3 % for the
   !> methods on total jumps, and of Newton's method for the paper's loop. For a
   !> job of one increment; negative if that loop does not get there in a few sweeps, or no joint
   !> carries anything.
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
         ! where no joint carries anything there is nothing that the difference is a part of
         if (any(abs(history%field%stress) > 0.0_wp)) difference = ratio(maxval(abs(other%stress - history%field%stress)), &
            maxval(abs(history%field%stress)))
      else
         deallocate (other)
      end if
   end subroutine compare_loops

end module axijoint_joints_increments
