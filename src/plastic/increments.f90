!> Load increments of bodies that yield one after the other, each to equilibrium of bodies and joints
module axijoint_plastic_increments
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : fatal_error, exit_state
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_stop, only : check_stop
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, set_initial_stress, count_state, judge_states
   use axijoint_joints_history, only : history_type, state_of
   use axijoint_joints_keeper, only : keeper_type
   use axijoint_joints_load_steps, only : step_type
   use axijoint_joints_method, only : control_type
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_scene, only : stand_where_they_are
   use axijoint_joints_stage, only : apply_increments
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type, body_lbfgs, body_transfer
   use axijoint_plastic_bodies, only : bodies_type, new_bodies
   use axijoint_plastic_elastic, only : to_nodes, elastic_response
   use axijoint_plastic_field, only : commit
   use axijoint_plastic_joint_side, only : commit_joints, find_joint_motion
   use axijoint_plastic_methods, only : body_control_type, balance_bodies
   use axijoint_plastic_problem, only : problem_type
   use axijoint_plastic_record, only : snapshot, bytes_of, read_bytes
   use axijoint_plastic_stage, only : body_stage_type, body_history_type, begin_history, put, &
      steer_to, put_found
   implicit none
   private
   public :: run_body_increments

   !> Joints are brought to equilibrium to this share of the tolerance of the bodies
   real(wp), parameter :: joint_share = 1.0e-2_wp
   !> and bodies to this share of it: displacements found again from their plastic strain leave what is rounding of that strain
   real(wp), parameter :: body_share = 0.9_wp

   !> What the increments of bodies that yield act on
   type, extends(body_stage_type) :: body_increments_type
   contains
      !> The history was brought to where an earlier run was
      procedure :: go_on
      !> An increment begins
      procedure :: begin_increment
      !> Put the loads of a step on and iterate
      procedure :: try => try_step
      !> Smaller steps got nowhere
      procedure :: give_up
      !> The loads of the increment are reached
      procedure :: end_increment
      !> A keeper is about to be told of a step in equilibrium
      procedure :: remember
   end type body_increments_type

contains

   !> Apply the increments. Each starts from the last state in equilibrium; one that finds none is
   !> halved. Where halves find none either, the history ends at the last equilibrium
   subroutine run_body_increments(model, equations, condensed, joint_points, supports, &
      combination, history, bodies, planes, progress, keeper)
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
      type(history_type), intent(out) :: history
      !> What it came to in the bodies
      type(body_history_type), intent(out) :: bodies
      !> Angles of the planes that bodies were looked at [radian]
      real(wp), allocatable, intent(out) :: planes(:)
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Who may know how far an earlier run came, and is told of every step in equilibrium
      class(keeper_type), intent(inout), optional :: keeper

      type(bodies_type), target :: points
      type(body_increments_type) :: stage

      stage%model => model
      stage%equations => equations
      stage%condensed => condensed
      stage%joint_points => joint_points
      stage%supports => supports
      stage%combination => combination
      call new_bodies(model, (model%materials%yield), points)
      call begin_history(stage, points, history)
      planes = stage%problem%planes%angle
      call apply_increments(stage, history, progress, keeper)
      if (.not. allocated(history%failure) .and. .not. history%verdict%converged) &
         call show_last_equilibrium(stage, history)
      bodies = stage%bodies
   end subroutine run_body_increments

   !> The history was brought to where an earlier run was: so are bodies and joints
   subroutine go_on(self, history)
      !> What the increments act on
      class(body_increments_type), intent(inout) :: self
      !> The history
      type(history_type), intent(inout) :: history

      logical :: restored

      call read_bytes(history%beside, self%bodies%field, self%bodies%counts, restored)
      if (.not. restored) then
         call fatal_error(history%failure, exit_state, 'the state is of other bodies that '// &
            'yield than this deck describes'//new_line('a')//'mend: run without --resume')
         return
      end if
      history%verdict%converged = .true.
      if (.not. allocated(self%problem%joints)) return
      associate (side => self%problem%joints)
         side%before = history%field
         side%field = history%field
         side%balanced = history%balanced
         side%scene%loads = history%scene%loads
      end associate
   end subroutine go_on

   !> An increment begins
   subroutine begin_increment(self)
      !> What the increments act on
      class(body_increments_type), intent(inout) :: self

      self%bodies%counts = 0
      self%bodies%field%begins = .true.
   end subroutine begin_increment

   !> Put the loads of a step on and iterate
   subroutine try_step(self, step, history, halvable)
      !> What the increments act on
      class(body_increments_type), intent(inout) :: self
      !> The loads; those found, if a displacement is given instead
      type(step_type), intent(inout) :: step
      !> The history
      type(history_type), intent(inout) :: history
      !> Whether smaller steps may get there if this one did not: always
      logical, intent(out) :: halvable

      halvable = .true.
      call begin_step()
      if (allocated(history%failure)) return
      call balance(self, step, history)
      if (allocated(history%failure)) return
      if (.not. self%bodies%verdict%converged .and. history%smallest .and. may_go_down(self)) then
         self%bodies%field%goes_down = .true.
         call begin_step()
         if (allocated(history%failure)) return
         call balance(self, step, history)
         if (allocated(history%failure)) return
         self%bodies%field%goes_down = self%bodies%verdict%converged
      end if
      if (allocated(step%steered)) call put_found(self, step, history)
      if (self%bodies%verdict%converged) call commit_step(self, step, history)
      history%verdict%converged = self%bodies%verdict%converged

   contains

      !> Put the loads on, or the displacement that is given instead
      subroutine begin_step()
         if (allocated(step%steered)) then
            call steer_to(self, step, history)
         else
            call put(self, step, history)
         end if
      end subroutine begin_step

   end subroutine try_step

   !> Whether a step that found no equilibrium may yet go down a potential
   pure logical function may_go_down(stage)
      !> What the increments act on
      type(body_increments_type), intent(in) :: stage

      may_go_down = stage%problem%has_potential .and. .not. stage%bodies%field%goes_down &
         .and. all(stage%model%body_method /= [body_lbfgs, body_transfer])
   end function may_go_down

   !> Iterate the step to the loads that were put on
   subroutine balance(stage, step, history)
      !> What the increments act on
      type(body_increments_type), intent(inout) :: stage
      !> The loads
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(inout) :: history

      real(wp), allocatable :: ratios(:)
      type(body_control_type) :: control

      associate (bodies => stage%bodies, increment => stage%model%increments(history%increment))
         control%method = merge(body_lbfgs, stage%model%body_method, bodies%field%goes_down)
         control%tolerance = body_share*increment%tolerance
         control%most = increment%max_iterations
         if (allocated(stage%problem%joints)) then
            control%most = 2*control%most  ! elastic solutions, two an iteration
            stage%problem%joints%control = control_type(joint_share*increment%tolerance, &
                                                        increment%max_iterations)
         end if
         call balance_bodies(stage%problem, control, bodies%field, bodies%verdict, ratios)
         call check_stop(history%failure)
         call follow(stage%problem, history%increment, step%load_factor, bodies%counts(1), ratios, &
            history)
         bodies%counts = bodies%counts + [size(ratios), bodies%verdict%solutions]
      end associate
   end subroutine balance

   !> Append the iterations of a step to the path
   subroutine follow(problem, increment, load_factor, before, ratios, history)
      !> Bodies and joints
      type(problem_type), intent(in) :: problem
      !> The increment, the sum of the load factors, iterations in it so far
      integer, intent(in) :: increment
      real(wp), intent(in) :: load_factor
      integer, intent(in) :: before
      !> Ratio of the residual forces of each iterate
      real(wp), intent(in) :: ratios(:)
      !> The history
      type(history_type), intent(inout) :: history

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
      history%path = [history%path, steps]
   end subroutine follow

   !> Keep plastic strain and slip of a step in equilibrium
   subroutine commit_step(stage, step, history)
      !> What the increments act on
      type(body_increments_type), intent(inout) :: stage
      !> The loads
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(inout) :: history

      associate (problem => stage%problem)
         call commit(problem%bodies, problem%planes, problem%load, stage%bodies%field)
         history%reached = step%load_factor
         if (.not. allocated(problem%joints)) return
         associate (side => problem%joints)
            associate (largest => maxval(abs(side%field%stress), 3), loads => side%scene%loads)
               loads%stress = max(loads%stress, largest)
               history%largest_stress = max(history%largest_stress, maxval(largest, 1))
            end associate
            if (side%field%fading > 0.0_wp) history%n_faded = history%n_faded + 1
            history%memory = side%field%memory
            history%verdict = side%verdict
            call commit_joints(side)
            history%field = side%before
            history%balanced = side%balanced
            history%scene%loads = side%scene%loads
         end associate
      end associate
   end subroutine commit_step

   !> Smaller steps got nowhere: note where the step ran to
   subroutine give_up(self, step, before, history)
      !> What the increments act on
      class(body_increments_type), intent(inout) :: self
      !> Its loads
      type(step_type), intent(in) :: step
      !> Joints before the step
      type(joint_field_type), intent(in) :: before
      !> The history
      type(history_type), intent(inout) :: history

      real(wp) :: elastic(size(self%bodies%field%unknowns))
      integer :: k

      history%field = before
      associate (bodies => self%bodies, field => self%bodies%field)
         bodies%tried = step%load_factor
         if (allocated(bodies%failing)) deallocate (bodies%failing)
         allocate (bodies%failing, mold=history%loading%external)
         do k = 1, size(bodies%failing, 3)
            bodies%failing(:, :, k) = to_nodes(self%equations, field%unknowns - field%begun, k)
         end do
         ! where joints ran away, what the bodies did meanwhile does not tell the motion
         if (allocated(self%problem%joints)) then
            if (self%problem%joints%verdict%ran_away .or. self%problem%joints%verdict%mechanism%loaded) &
               call find_joint_motion(self%problem%joints, self%equations, bodies%failing)
         end if
         call elastic_response(self%equations, self%problem%load%right - field%right, elastic)
         if (maxval(abs(elastic)) > 0.0_wp) bodies%growth = &
            maxval(abs(field%unknowns - field%begun))/maxval(abs(elastic))
      end associate
   end subroutine give_up

   !> The loads of the increment are reached: append its state
   subroutine end_increment(self, history)
      !> What the increments act on
      class(body_increments_type), intent(inout) :: self
      !> The history
      type(history_type), intent(inout) :: history

      type(increment_state_type), allocatable :: longer(:)

      associate (states => history%states)
         allocate (longer(size(states) + 1))
         longer(:size(states)) = states
         call keep_state(self, history, longer(size(longer)))
      end associate
      call move_alloc(longer, history%states)
   end subroutine end_increment

   !> A keeper is about to be told of a step in equilibrium
   subroutine remember(self, history)
      !> What the increments act on
      class(body_increments_type), intent(inout) :: self
      !> The history
      type(history_type), intent(inout) :: history

      history%beside = bytes_of(self%bodies%field, self%bodies%counts)
   end subroutine remember

   !> The state of the last equilibrium
   subroutine keep_state(stage, history, state)
      !> What the increments act on
      type(body_increments_type), intent(in) :: stage
      !> The history
      type(history_type), intent(in) :: history
      !> The state
      type(increment_state_type), intent(out) :: state

      type(joint_field_type) :: joints

      if (allocated(stage%problem%joints)) then
         joints = history%field
         call stand_where_they_are(stage%condensed, history%scene, joints)
         state = state_of(history, joints, history%increment, history%at%load_factor, &
                          history%at%case_factor)
      else
         state%increment = history%increment
         state%load_factor = history%at%load_factor
         state%case_factor = history%at%case_factor
         state%peak_factor = history%peak%case_factor
      end if
      associate (bodies => stage%bodies)
         state%bodies = snapshot(stage%problem%bodies, stage%problem%planes, bodies%field)
         state%bodies%iterations = bodies%counts(1)
         state%bodies%solutions = bodies%counts(2)
         state%bodies%on_planes = bodies%verdict%on_planes
         state%bodies%n_yielding = count(any(any(abs(state%bodies%taken) > 0.0_wp, 3), 1))
      end associate
   end subroutine keep_state

   !> The history ended before its time: its last state is that of the last equilibrium
   subroutine show_last_equilibrium(stage, history)
      !> What the increments act on
      type(body_increments_type), intent(inout) :: stage
      !> The history
      type(history_type), intent(inout) :: history

      call stage%put_on_nodes(history%at%case_factor, history%loading)
      if (allocated(stage%problem%joints)) then
         call set_initial_stress(stage%model, stage%condensed%points, history%at%case_factor, &
            history%field)
         call judge_states(history%scene%laws, history%field)
      end if
      call stage%end_increment(history)
   end subroutine show_last_equilibrium

end module axijoint_plastic_increments
