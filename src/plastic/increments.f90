!> Load increments of bodies that yield one after the other, each to equilibrium of bodies and joints
module axijoint_plastic_increments
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : fatal_error, exit_state
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_stop, only : check_stop
   use axijoint_base_text, only : to_text
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, set_initial_stress, count_state, judge_states
   use axijoint_joints_history, only : history_type, target_type, state_of
   use axijoint_joints_keeper, only : keeper_type
   use axijoint_joints_load_steps, only : step_type, next_step, halfway
   use axijoint_joints_method, only : control_type
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_scene, only : stand_where_they_are
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type
   use axijoint_plastic_bodies, only : bodies_type, new_bodies
   use axijoint_plastic_elastic, only : to_nodes, elastic_response
   use axijoint_plastic_field, only : commit
   use axijoint_plastic_joint_side, only : commit_joints
   use axijoint_plastic_methods, only : body_control_type, balance_bodies
   use axijoint_plastic_problem, only : problem_type
   use axijoint_plastic_record, only : snapshot, bytes_of, read_bytes
   use axijoint_plastic_stage, only : stage_type, body_history_type, begin_history, put, put_on_nodes
   implicit none
   private
   public :: run_body_increments

   !> A step that finds no equilibrium is halved so many times at most
   integer, parameter :: most_halvings = 6
   !> Joints are brought to equilibrium to this share of the tolerance of the bodies
   real(wp), parameter :: joint_share = 1.0e-2_wp

contains

   !> Apply the increments. Each starts from the last state in equilibrium; one that finds none is
   !> halved. Where halves find none either, the history ends at the last equilibrium
   subroutine run_body_increments(model, equations, condensed, joint_points, supports, &
      combination, history, planes, progress, keeper)
      !> The job
      type(model_type), intent(in), target :: model
      !> Equations of all modes, assembled
      type(equations_type), intent(inout), target :: equations
      !> The condensed structure; empty if no joint can yield
      type(condensed_type), intent(in), target :: condensed
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in), target :: joint_points(:)
      type(support_point_type), intent(in), target :: supports(:)
      !> Factors of the load cases
      type(combination_type), intent(in), target :: combination
      !> What it came to; the last state is that of the last equilibrium
      type(body_history_type), intent(out) :: history
      !> Angles of the planes that bodies were looked at [radian]
      real(wp), allocatable, intent(out) :: planes(:)
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Who may know how far an earlier run came, and is told of every step in equilibrium
      class(keeper_type), intent(inout), optional :: keeper

      type(bodies_type), target :: bodies
      type(stage_type) :: stage

      stage%model => model
      stage%equations => equations
      stage%condensed => condensed
      stage%joint_points => joint_points
      stage%supports => supports
      stage%combination => combination
      call new_bodies(model, (model%materials%yield), bodies)
      call begin_history(stage, bodies, history)
      planes = stage%problem%planes%angle
      associate (common => history%joints)
         if (present(keeper)) call go_on_from(stage, keeper, history)
         do while (common%increment < size(model%increments) .or. size(common%ahead) > 0)
            call check_stop(common%failure)
            if (allocated(common%failure)) return
            if (size(common%ahead) == 0) call begin_increment(stage, history, progress)
            call reach_next(stage, history)
            if (allocated(common%failure)) return
            if (.not. history%verdict%converged) then
               if (size(common%ahead) == 0) exit
               cycle  ! in smaller steps
            end if
            if (size(common%ahead) == 0) call keep_increment(stage, bodies, history)
            if (.not. present(keeper)) cycle
            common%beside = bytes_of(history%field, history%counts)
            call keeper%keep(common)
         end do
         common%verdict%converged = history%verdict%converged
         if (.not. history%verdict%converged) call show_last_equilibrium(stage, bodies, history)
      end associate
   end subroutine run_body_increments

   !> Go on from where an earlier run was
   subroutine go_on_from(stage, keeper, history)
      !> What the increments act on
      type(stage_type), intent(inout) :: stage
      !> Who knows
      class(keeper_type), intent(inout) :: keeper
      !> The history, new
      type(body_history_type), intent(inout) :: history

      real(wp), allocatable :: factor(:)
      logical :: restored

      associate (common => history%joints)
         call keeper%restore(common, restored, common%failure)
         if (.not. restored) return
         call read_bytes(common%beside, history%field, history%counts, restored)
         if (.not. restored) then
            call fatal_error(common%failure, exit_state, 'the state is of other bodies that '// &
               'yield than this deck describes'//new_line('a')//'mend: run without --resume')
            return
         end if
         history%verdict%converged = .true.
         factor = common%loading%case_factor
         call put_on_nodes(stage, factor, common%loading)
         factor = common%peak%case_factor
         call put_on_nodes(stage, factor, common%peak)
         if (.not. allocated(stage%problem%joints)) return
         associate (side => stage%problem%joints)
            side%before = common%field
            side%field = common%field
            side%balanced = common%balanced
            side%scene%loads = common%scene%loads
         end associate
      end associate
   end subroutine go_on_from

   !> The loads of the next increment lie ahead
   subroutine begin_increment(stage, history, progress)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> The history
      type(body_history_type), intent(inout) :: history
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      associate (common => history%joints, increments => stage%model%increments)
         common%increment = common%increment + 1
         associate (n => common%increment)
            common%ahead = [target_type(next_step(common%at, increments(n), stage%combination), &
                                        most_halvings)]
            call show_progress(progress, 'increment '//to_text(n)//' of '// &
               to_text(size(increments)))
         end associate
      end associate
      history%counts = 0
   end subroutine begin_increment

   !> Go to the loads that lie ahead next. If that finds no equilibrium, half the way there lies
   !> ahead then, or nothing any more: the history has ended
   subroutine reach_next(stage, history)
      !> What the increments act on
      type(stage_type), intent(inout) :: stage
      !> The history
      type(body_history_type), intent(inout) :: history

      type(target_type) :: target

      associate (common => history%joints)
         target = common%ahead(size(common%ahead))
         call put(stage, target%step, history)
         if (allocated(common%failure)) return
         call balance(stage, target%step, history)
         if (allocated(common%failure)) return
         common%ahead = common%ahead(:size(common%ahead) - 1)
         if (history%verdict%converged) then
            call commit_step(stage, target%step, history)
         else if (target%halvings > 0) then
            target%halvings = target%halvings - 1
            common%ahead = [common%ahead, target, &
                            target_type(halfway(common%at, target%step), target%halvings)]
         else
            call note_failure(stage, target%step, history)
            common%ahead = common%ahead(:0)
         end if
      end associate
   end subroutine reach_next

   !> Iterate the step to the loads that were put on
   subroutine balance(stage, step, history)
      !> What the increments act on
      type(stage_type), intent(inout) :: stage
      !> The loads
      type(step_type), intent(in) :: step
      !> The history
      type(body_history_type), intent(inout) :: history

      real(wp), allocatable :: ratios(:)
      type(body_control_type) :: control

      associate (common => history%joints, &
                 increment => stage%model%increments(history%joints%increment))
         control%tolerance = increment%tolerance
         control%most = increment%max_iterations
         if (allocated(stage%problem%joints)) then
            control%most = 2*control%most  ! elastic solutions, two an iteration
            stage%problem%joints%control = control_type(joint_share*increment%tolerance, &
                                                        increment%max_iterations)
         end if
         call balance_bodies(stage%problem, control, history%field, history%verdict, ratios)
         call check_stop(common%failure)
         call follow(stage%problem, common%increment, step%load_factor, history%counts(1), &
            ratios, common)
         history%counts = history%counts + [size(ratios), history%verdict%solutions]
      end associate
   end subroutine balance

   !> Append the iterations of a step to the path
   subroutine follow(problem, increment, load_factor, before, ratios, common)
      !> Bodies and joints
      type(problem_type), intent(in) :: problem
      !> The increment, the sum of the load factors, iterations in it so far
      integer, intent(in) :: increment
      real(wp), intent(in) :: load_factor
      integer, intent(in) :: before
      !> Ratio of the residual forces of each iterate
      real(wp), intent(in) :: ratios(:)
      !> The history
      type(history_type), intent(inout) :: common

      type(iteration_type) :: steps(size(ratios))
      integer :: i, n_slip, n_open

      do i = 1, size(ratios)
         steps(i) = iteration_type(increment, before + i, load_factor, ratios(i), 0, 0)
      end do
      if (allocated(problem%joints)) then
         associate (side => problem%joints)
            call count_state(side%field, side%scene%planes%place, n_slip, n_open)
         end associate
         steps%n_slip = n_slip
         steps%n_open = n_open
      end if
      common%path = [common%path, steps]
   end subroutine follow

   !> Keep plastic strain and slip of a step in equilibrium
   subroutine commit_step(stage, step, history)
      !> What the increments act on
      type(stage_type), intent(inout) :: stage
      !> The loads
      type(step_type), intent(in) :: step
      !> The history
      type(body_history_type), intent(inout) :: history

      associate (common => history%joints, problem => stage%problem)
         call commit(problem%bodies, problem%planes, problem%load, history%field)
         common%at = step
         common%reached = step%load_factor
         if (.not. allocated(problem%joints)) return
         associate (side => problem%joints)
            associate (largest => maxval(abs(side%field%stress), 3), loads => side%scene%loads)
               loads%stress = max(loads%stress, largest)
               common%largest_stress = max(common%largest_stress, maxval(largest, 1))
            end associate
            if (side%field%fading > 0.0_wp) common%n_faded = common%n_faded + 1
            common%memory = side%field%memory
            common%verdict = side%verdict
            call commit_joints(side)
            common%field = side%before
            common%balanced = side%balanced
            common%scene%loads = side%scene%loads
         end associate
      end associate
   end subroutine commit_step

   !> Note where a step ran to that found no equilibrium
   subroutine note_failure(stage, step, history)
      !> What the increments act on
      type(stage_type), intent(inout) :: stage
      !> Its loads
      type(step_type), intent(in) :: step
      !> The history
      type(body_history_type), intent(inout) :: history

      real(wp) :: elastic(size(history%field%unknowns))
      integer :: k

      history%tried = step%load_factor
      if (allocated(history%failing)) deallocate (history%failing)
      allocate (history%failing, mold=history%joints%loading%external)
      associate (field => history%field)
         do k = 1, size(history%failing, 3)
            history%failing(:, :, k) = to_nodes(stage%equations, field%unknowns - field%begun, k)
         end do
         call elastic_response(stage%equations, stage%problem%load%right - field%right, elastic)
         if (maxval(abs(elastic)) > 0.0_wp) history%growth = &
            maxval(abs(field%unknowns - field%begun))/maxval(abs(elastic))
      end associate
   end subroutine note_failure

   !> Append the state at the end of an increment
   subroutine keep_increment(stage, bodies, history)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The history
      type(body_history_type), intent(inout) :: history

      type(increment_state_type), allocatable :: longer(:)

      associate (states => history%joints%states)
         allocate (longer(size(states) + 1))
         longer(:size(states)) = states
         call keep_state(stage, bodies, history, longer(size(longer)))
      end associate
      call move_alloc(longer, history%joints%states)
   end subroutine keep_increment

   !> The state of the last equilibrium
   subroutine keep_state(stage, bodies, history, state)
      !> What the increments act on
      type(stage_type), intent(in) :: stage
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The history
      type(body_history_type), intent(inout) :: history
      !> The state
      type(increment_state_type), intent(out) :: state

      type(joint_field_type) :: joints

      associate (common => history%joints, field => history%field)
         if (allocated(stage%problem%joints)) then
            joints = common%field
            call stand_where_they_are(stage%condensed, common%scene, joints)
            state = state_of(common, joints, common%increment, common%at%load_factor, &
                             common%at%case_factor)
         else
            state%increment = common%increment
            state%load_factor = common%at%load_factor
            state%case_factor = common%at%case_factor
         end if
         state%bodies = snapshot(bodies, stage%problem%planes, field)
         state%bodies%iterations = history%counts(1)
         state%bodies%solutions = history%counts(2)
         state%bodies%on_planes = history%verdict%on_planes
         state%bodies%n_yielding = count(any(any(abs(state%bodies%taken) > 0.0_wp, 3), 1))
      end associate
   end subroutine keep_state

   !> The history ended before its time: its last state is that of the last equilibrium
   subroutine show_last_equilibrium(stage, bodies, history)
      !> What the increments act on
      type(stage_type), intent(inout) :: stage
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The history
      type(body_history_type), intent(inout) :: history

      associate (common => history%joints)
         call put_on_nodes(stage, common%at%case_factor, common%loading)
         if (allocated(stage%problem%joints)) then
            call set_initial_stress(stage%model, stage%condensed%points, common%at%case_factor, &
               common%field)
            call judge_states(common%scene%laws, common%field)
         end if
      end associate
      call keep_increment(stage, bodies, history)
   end subroutine show_last_equilibrium

end module axijoint_plastic_increments
