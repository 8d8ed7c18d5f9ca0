!> Load increments one after the other, each to equilibrium at the joints
module axijoint_joints_increments
   use axijoint_assembly_factors, only : report_failure
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_text, only : to_text
   use axijoint_element_joint_law, only : memory_type
   use axijoint_joints_balance, only : verdict_type, balance_step
   use axijoint_joints_field, only : joint_field_type, iteration_type, new_joint_field, commit_field, judge_states, &
                                     set_initial_stress
   use axijoint_joints_floating, only : new_loads_on, put_loads_on
   use axijoint_joints_planes, only : on_all
   use axijoint_joints_residual, only : load_norm, ratio, set_reference, residual_record_type, ratios_of
   use axijoint_joints_response, only : load_response
   use axijoint_joints_scene, only : scene_type, elastic_stress
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type, increment_type
   use axijoint_model_model, only : model_type, method_newton, method_anderson, method_transfer
   implicit none
   private
   public :: history_type, run_increments, final_factors, loads_of_increments, compare_loops, balance_again

   !> A step that finds no equilibrium is halved so many times at most
   integer, parameter :: most_halvings = 6

   !> What the increments came to
   type :: history_type
      !> How the last step ended
      type(verdict_type) :: verdict
      !> Loads at the end: of the one that failed, or of the last in equilibrium
      !> if joints ran away beyond it
      type(loading_type) :: loading
      !> The largest loads on the way, by their norm (Psi_f)
      type(loading_type) :: peak
      !> Excess stress of joints that ran away, shape (3, points, modes), and the motion that
      !> nothing resists, in shares of the floating motions; one is allocated if the joints came to a mechanism
      real(wp), allocatable :: runaway(:, :, :), motion(:)
      !> Sum of the load factors of the last step in equilibrium
      real(wp) :: reached = 0.0_wp
      !> Largest displacement that the loads of a step would give if all joints held
      real(wp) :: largest_elastic = 0.0_wp
      !> Largest joint stress at the end of a step, of each point: what errors are measured by, for joints
      !> that were unloaded have none at the end
      real(wp), allocatable :: largest_stress(:)
      !> States at the ends of the increments before the last; none unless the job
      !> wants its bodies swept
      type(increment_state_type), allocatable :: states(:)
      !> What the points remembered in the last step, before its slip was added, shape
      !> (points, planes)
      type(memory_type), allocatable :: memory(:, :)
      !> What they remembered at its beginning, before bonds broke and points softened in it
      type(memory_type), allocatable :: start(:, :)
      !> Convergence path
      type(iteration_type), allocatable :: path(:)
      !> What the iterations left out of balance, one entry a step in equilibrium, and the last if it failed
      type(residual_record_type), allocatable :: residuals(:)
      !> Whether the last of them is of a step in equilibrium
      logical :: noted = .true.
      !> What ended the increments before their time: too little memory
      type(error_type), allocatable :: failure
   end type history_type

   !> Loads of a step
   type :: step_type
      !> Sum of the load factors
      real(wp) :: load_factor = 0.0_wp
      !> Factor of each load case
      real(wp), allocatable :: case_factor(:)
   end type step_type

contains

   !> Apply the increments. Each starts from the last state in equilibrium, whose
   !> slip is kept; one that finds none is halved (not for the paper's loop, which
   !> has no memory but its accumulated stress).
   subroutine run_increments(scene, all_points, supports, combination, field, history, progress)
      !> Joint points that can yield, their response, planes
      type(scene_type), intent(inout) :: scene
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: all_points(:)
      type(support_point_type), intent(in) :: supports(:)
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> State of the joints that can yield
      type(joint_field_type), intent(out) :: field
      !> What it came to
      type(history_type), intent(out) :: history
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(step_type) :: start, goal
      real(wp), allocatable :: balanced(:, :, :)
      real(wp) :: peak_norm
      integer :: i

      allocate (history%path(0), history%states(0), history%residuals(0))
      allocate (history%largest_stress(size(scene%points)), source=0.0_wp)
      field = new_joint_field(size(scene%points), size(scene%planes%angle), size(scene%equations%modes), &
                              size(scene%floating))
      scene%loads = new_loads_on(scene%floating, size(scene%points))
      goal = first_step(combination)
      peak_norm = 0.0_wp
      allocate (balanced, source=field%excess)  ! zero: elastic stress of the loads in equilibrium
      do i = 1, size(scene%model%increments)
         start = goal
         goal = next_step(goal, scene%model%increments(i), combination)
         call show_progress(progress, 'increment '//to_text(i)//' of '//to_text(size(scene%model%increments)))
         call reach(i, start, goal, most_halvings)
         if (.not. history%verdict%converged) return
         if (allocated(history%runaway)) deallocate (history%runaway)  ! smaller steps got there
         if (allocated(history%motion)) deallocate (history%motion)
         if (scene%model%sweep%wanted .and. i < size(scene%model%increments)) call keep_state(i, goal)
      end do

   contains

      !> Go from one load to another, by halves if need be
      recursive subroutine reach(increment, from, to, halvings)
         !> Increment
         integer, intent(in) :: increment
         !> Loads in equilibrium, and loads to reach
         type(step_type), intent(in) :: from, to
         !> Halvings that are left
         integer, intent(in) :: halvings

         type(joint_field_type), allocatable :: before
         type(step_type) :: middle

         before = field
         call try_step(increment, to)
         if (allocated(history%failure)) return
         if (history%verdict%converged .or. history%verdict%at_rounding) return
         if (history%verdict%mechanism%loaded) history%motion = history%verdict%mechanism%motion
         if (scene%method == method_transfer .and. .not. history%verdict%mechanism%loaded) return
         if (history%verdict%ran_away) history%runaway = field%excess
         if (halvings == 0 .or. scene%method == method_transfer) then
            if (.not. (allocated(history%runaway) .or. allocated(history%motion))) return
            if (scene%method == method_newton .and. .not. history%verdict%mechanism%loaded) then
               ! Newton may run away where there is a state: no mechanism if the mix finds one
               field = before
               scene%method = method_anderson
               call try_step(increment, to)
               scene%method = method_newton
               if (history%verdict%converged .or. allocated(history%failure)) return
            end if
            field = before  ! what ran away is no state to show
            call put_loads(from)
            call judge_states(scene%model, scene%points, field)  ! none was, before the first load
            return
         end if
         field = before
         deallocate (before)
         middle = step_type(0.5_wp*(from%load_factor + to%load_factor), &
                            0.5_wp*(from%case_factor + to%case_factor))
         call reach(increment, from, middle, halvings - 1)
         if (.not. history%verdict%converged) return
         call reach(increment, middle, to, halvings - 1)
      end subroutine reach

      !> Keep a state at the end of an increment
      subroutine keep_state(increment, step)
         !> Increment
         integer, intent(in) :: increment
         !> Loads in equilibrium
         type(step_type), intent(in) :: step

         type(increment_state_type) :: state

         state%increment = increment
         state%load_factor = step%load_factor
         state%case_factor = step%case_factor
         state%jump = on_all(scene%planes, field%jump)
         state%stress = on_all(scene%planes, field%stress)
         state%state = field%state(:, scene%planes%place)
         state%excess = field%excess
         state%offset = field%offset
         history%states = [history%states, state]
      end subroutine keep_state

      !> Iterate one step
      subroutine try_step(increment, step)
         !> Increment
         integer, intent(in) :: increment
         !> Loads
         type(step_type), intent(in) :: step

         type(iteration_type) :: now
         type(memory_type), allocatable :: start(:, :)
         real(wp), allocatable :: stress(:, :, :)
         real(wp) :: norm

         start = field%memory
         associate (control => scene%model%increments(increment))
            call put_loads(step)
            history%verdict%converged = .false.
            if (allocated(history%failure)) return
            norm = load_norm(scene%equations, history%loading)
            if (norm >= peak_norm) then
               peak_norm = norm
               history%peak = history%loading
            end if
            stress = elastic_stress(scene, field)
            call set_reference(scene%measure, peak_norm, stress - balanced, control%tolerance)
            now%increment = increment
            now%load_factor = step%load_factor
            if (size(history%path) > 0) then
               associate (last => history%path(size(history%path)))
                  if (last%increment == increment) now%iteration = last%iteration
               end associate
            end if
            call balance_step(scene, control%tolerance, control%max_iterations, now, field, &
                              history%path, history%verdict)
            call note_residual(scene, field, increment, step%load_factor, history)
            if (.not. history%verdict%converged) return
            balanced = stress
            scene%loads%stress = max(scene%loads%stress, maxval(abs(field%stress), 3))
            history%memory = field%memory
            call move_alloc(start, history%start)
            if (scene%method /= method_transfer) then
               call commit_field(scene%model, scene%points, field)
            end if
            history%reached = step%load_factor
            history%largest_stress = max(history%largest_stress, maxval(maxval(abs(field%stress), 3), 1))
         end associate
      end subroutine try_step

      !> Load the structure
      subroutine put_loads(step)
         !> Loads
         type(step_type), intent(in) :: step

         call new_loading(scene%model, all_points, supports, scene%equations%modes, &
                          combination_type(combination%label, step%case_factor), history%loading)
         call load_response(scene%equations, scene%points, history%loading, scene%response)
         history%largest_elastic = maxval([history%largest_elastic, scene%response%largest])
         call put_loads_on(scene%floating, history%loading%external, scene%loads)
         call report_failure(scene%equations, scene%model, history%failure)
         call set_initial_stress(scene%model, scene%points, step%case_factor, field)
      end subroutine put_loads

   end subroutine run_increments

   !> Note what a step left out of balance; one that failed is forgotten at the next
   subroutine note_residual(scene, field, increment, load_factor, history)
      !> What residuals are measured by
      type(scene_type), intent(in) :: scene
      !> The state, with what is not transferred
      type(joint_field_type), intent(in) :: field
      !> Increment, and sum of the load factors
      integer, intent(in) :: increment
      real(wp), intent(in) :: load_factor
      !> Takes the entry
      type(history_type), intent(inout) :: history

      type(residual_record_type) :: record

      record = ratios_of(scene%measure, field%pending)
      record%increment = increment
      record%load_factor = load_factor
      if (size(history%residuals) > 0 .and. .not. history%noted) then
         history%residuals = history%residuals(:size(history%residuals) - 1)
      end if
      history%residuals = [history%residuals, record]
      history%noted = history%verdict%converged
   end subroutine note_residual

   !> Balance the last step again, after the response of the structure was corrected
   subroutine balance_again(scene, field, history, tolerance)
      !> Joint points, their corrected response, planes
      type(scene_type), intent(inout) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> What the increments came to; its path goes on
      type(history_type), intent(inout) :: history
      !> Tolerance on the residual ratio; that of the increment if absent
      real(wp), intent(in), optional :: tolerance

      real(wp) :: allowed

      field%memory = history%memory
      associate (last => history%path(size(history%path)), &
                 control => scene%model%increments(size(scene%model%increments)))
         allowed = control%tolerance
         if (present(tolerance)) allowed = tolerance
         call balance_step(scene, allowed, control%max_iterations, last, field, history%path, &
                           history%verdict, warm=.true.)
      end associate
      history%noted = .false.  ! in the place of the last
      associate (last => history%path(size(history%path)))
         call note_residual(scene, field, last%increment, last%load_factor, history)
      end associate
      history%memory = field%memory
      if (history%verdict%converged) call commit_field(scene%model, scene%points, field)
   end subroutine balance_again

   !> Largest difference of joint stress that the other kind of loop leaves, over the
   !> largest joint stress: of the paper's loop at its tolerance of 3 % for the
   !> methods on total jumps, and of Newton's method for the paper's loop. For a
   !> job of one increment; negative if that loop does not get there in a few sweeps.
   subroutine compare_loops(scene, history, field, difference, other)
      !> What does not change; the loads of the job are in its response
      type(scene_type), intent(inout) :: scene
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The difference
      real(wp), intent(out) :: difference
      !> The state of the other loop; allocated if it got there
      type(joint_field_type), allocatable, intent(out) :: other

      real(wp), parameter :: paper_tolerance = 0.03_wp, strict = 1.0e-8_wp
      integer, parameter :: most_sweeps = 40
      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict
      integer :: method

      difference = -1.0_wp
      if (.not. history%verdict%converged .or. size(scene%model%increments) > 1) return
      if (any(scene%model%joint_materials%law%gap > 0.0_wp)) return  ! the paper's loop knows none
      allocate (path(0))
      allocate (other)
      other = new_joint_field(size(scene%points), size(scene%planes%angle), size(scene%equations%modes), &
                              size(scene%floating))
      call set_initial_stress(scene%model, scene%points, history%loading%case_factor, other)
      method = scene%method
      scene%method = merge(method_newton, method_transfer, method == method_transfer)
      call balance_step(scene, merge(strict, paper_tolerance, method == method_transfer), most_sweeps, &
                        iteration_type(), other, path, verdict)
      scene%method = method
      if (.not. verdict%converged) then
         deallocate (other)
         return
      end if
      difference = ratio(maxval(abs(other%stress - field%stress)), maxval(abs(field%stress)))
   end subroutine compare_loops

   !> No load
   pure function first_step(combination) result(step)
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The step
      type(step_type) :: step

      allocate (step%case_factor(size(combination%factor)), source=0.0_wp)
   end function first_step

   !> Loads after one more increment
   pure function next_step(step, increment, combination) result(next)
      !> Loads before
      type(step_type), intent(in) :: step
      !> The increment
      type(increment_type), intent(in) :: increment
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> Loads after it
      type(step_type) :: next

      next = step
      next%load_factor = step%load_factor + increment%factor
      if (increment%case == 0) then
         next%case_factor = step%case_factor + increment%factor*combination%factor
      else
         associate (case => increment%case)
            next%case_factor(case) = step%case_factor(case) + increment%factor*combination%factor(case)
         end associate
      end if
   end function next_step

   !> Loads after each increment, without states of joints
   pure function loads_of_increments(model, combination) result(states)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> One an increment
      type(increment_state_type) :: states(size(model%increments))

      type(step_type) :: step
      integer :: i

      step = first_step(combination)
      do i = 1, size(states)
         step = next_step(step, model%increments(i), combination)
         states(i)%increment = i
         states(i)%load_factor = step%load_factor
         states(i)%case_factor = step%case_factor
      end do
   end function loads_of_increments

   !> Factors of the load cases after all increments
   pure function final_factors(model, combination) result(factor)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The factors, shape (cases)
      real(wp), allocatable :: factor(:)

      type(step_type) :: step
      integer :: i

      step = first_step(combination)
      do i = 1, size(model%increments)
         step = next_step(step, model%increments(i), combination)
      end do
      factor = step%case_factor
   end function final_factors

end module axijoint_joints_increments
