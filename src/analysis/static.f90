!> Static analysis of a structure under its loads, told in order
module axijoint_analysis_static
   use axijoint_analysis_core_cuts, only : n_with_resultants
   use axijoint_analysis_core_in_situ_balance, only : in_situ_balance
   use axijoint_analysis_core_fields_beside, only : run_and_find
   use axijoint_analysis_core_increment_fields, only : field_of_state, recover_fields, &
      move_bodies
   use axijoint_analysis_core_joint_edges, only : pressure_at_edges
   use axijoint_analysis_core_left_out, only : what_was_left_out
   use axijoint_analysis_core_motion, only : motion_text
   use axijoint_analysis_core_named_points, only : largest_at_points
   use axijoint_analysis_core_path, only : is_torn, is_soft_in_part, turns_slip
   use axijoint_analysis_core_plastic_fields, only : plastic_fields
   use axijoint_analysis_core_remarks, only : remarks_on, mechanism_text
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_solution, only : solve_displacements
   use axijoint_analysis_core_structure, only : structure_type, build_structure
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_analysis_core_yielding_bodies, only : solve_bodies
   use axijoint_analysis_error_budget, only : new_budget
   use axijoint_analysis_error_corrections, only : correct_rounding, keep_claim, judge_solver
   use axijoint_analysis_error_discretization, only : estimate_discretization
   use axijoint_analysis_error_iteration_left, only : iteration_left_type, find_left
   use axijoint_analysis_error_joint_shares, only : displacement_scale, yielding_scale, unloaded
   use axijoint_analysis_error_plastic_errors, only : estimate_plastic_errors
   use axijoint_analysis_error_stiffer_joints, only : compare_stiffer
   use axijoint_analysis_error_yielding_errors, only : estimate_yielding_errors
   use axijoint_analysis_error_cut_errors, only : find_held_on_cuts
   use axijoint_analysis_error_line_errors, only : find_held_on_lines
   use axijoint_analysis_fine_difference, only : difference_type, new_difference
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type, new_mesh_error
   use axijoint_assembly_loading, only : new_loading
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_stop, only : check_stop
   use axijoint_base_timer, only : timer_type, phase_factor, phase_joints, phase_recover
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type, state_of
   use axijoint_joints_increments, only : compare_loops
   use axijoint_joints_keeper, only : keeper_type
   use axijoint_joints_load_steps, only : final_factors, loads_of_increments
   use axijoint_joints_residual, only : balance_each_other
   use axijoint_joints_scene, only : stand_where_they_are
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_locking, only : elements_lock, has_nearly_incompressible
   use axijoint_model_model, only : model_type, bodies_yield
   implicit none
   private
   public :: analyse_model, analyse_combination

   !> Largest residual-force ratio of a linear job, whose residual is rounding, and told of where it shows
   !> (`core/remarks.f90`): stresses are off by 0.5 to 1.3 times it, displacements by less (`scripts/verify limits`); of slender tubes
   !> it is up to 1e-4. Forces see little of mean stresses that cancel in nearly incompressible elements, which were off by 1.6e4
   !> times it: there it is to be less. Of a ring with nu = 0.499999 it is 2e-8
   real(wp), parameter :: linear_tolerance = 1.0e-4_wp, nearly_incompressible_tolerance = 1.0e-6_wp

contains

   !> Solve a job of one combination of load cases
   subroutine analyse_model(model, results, timer, progress, error)
      !> The job; its first combination is solved
      type(model_type), intent(in), target :: model
      !> What was found
      type(results_type), intent(out) :: results
      !> Times of the phases
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      type(structure_type), target :: structure

      call build_structure(model, structure, timer, progress, error)
      if (allocated(error)) return
      call analyse_combination(model, structure, model%combinations(1), results, timer, progress, &
         error)
   end subroutine analyse_model

   !> Solve one combination of load cases: displacements and joints, recovery
   subroutine analyse_combination(model, structure, combination, results, timer, progress, error, &
      estimated, keeper)
      !> The job
      type(model_type), intent(in), target :: model
      !> The structure, assembled
      type(structure_type), intent(inout), target :: structure
      !> The combination
      type(combination_type), intent(in) :: combination
      !> What was found
      type(results_type), intent(out) :: results
      !> Times of the phases
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Whether errors are estimated; true if absent. Remarks that need no estimates are made in any case
      logical, intent(in), optional :: estimated
      !> Who keeps what the increments come to
      class(keeper_type), intent(inout), optional, target :: keeper

      type(joint_field_type) :: field
      type(history_type) :: history
      type(mesh_error_type) :: mesh_error
      real(wp) :: yielding_stress, elastic_displacement
      logical :: wanted, estimates, shown

      wanted = .true.
      if (present(estimated)) wanted = estimated
      shown = wanted .or. present(keeper)  ! no row of a study
      estimates = wanted .and. .not. bodies_yield(model)  ! none that holds with plastic strain
      results%modes = structure%modes
      results%orderings = structure%orderings
      results%left_out = what_was_left_out(model, structure)
      results%solver = structure%equations%solver
      if (allocated(structure%singular)) results%singular = structure%singular
      if (allocated(structure%judged)) results%judged = structure%judged
      results%in_situ = in_situ_balance(model, combination)
      call timer%push(phase_joints)
      if (bodies_yield(model)) then
         call solve_bodies(model, structure, combination, history, results, progress, error, keeper)
         if (.not. allocated(error)) call name_idle_motions(model, structure, history, results)
      else if (size(structure%yielding) > 0) then
         call solve_joints(model, structure, combination, estimates, history, mesh_error, results, &
            progress, error, keeper)
      else
         call solve_linear(model, structure, combination, estimates, history, mesh_error, results, &
            timer, error)
      end if
      if (allocated(error)) then
         call timer%pop()
         return
      end if
      associate (state => results%states(size(results%states)))
         call field_of_state(model, structure, state, results%plane_angles, results%displacement, &
            field)
      end associate
      call timer%pop()

      call timer%push(phase_recover)
      call recover_fields(model, structure, history%loading, history%peak, field, results, &
         smoothed=shown)
      if (shown) results%edge_pressure = pressure_at_edges(model%mesh, structure, field, results)
      associate (state => results%states(size(results%states)))
         results%plastic = plastic_fields(model, results%modes, results%stress, &
            state%bodies)
      end associate
      yielding_stress = 0.0_wp
      elastic_displacement = 0.0_wp
      if (estimates .and. size(structure%yielding) > 0) then
         yielding_stress = yielding_scale(structure, history)
         elastic_displacement = displacement_scale(history, 0.0_wp)
      end if
      results%at_rest = is_at_rest(structure, history, field)
      if (estimates) &
         call estimate_discretization(model, structure, history%loading, field, &
            yielding_stress, elastic_displacement, mesh_error, results)
      if (wanted .and. bodies_yield(model)) &
         call estimate_plastic_errors(model, structure, combination, results, progress)
      call move_bodies(model, structure, results%states(size(results%states)), results)
      if (.not. estimates) results%discretization%largest_displacement = &
         largest_vector(results%modes, results%displacement)
      results%locks = elements_lock(model)
      if (estimates) then
         results%bends_unseen = structure%fine%bends_unseen
         results%edges_unseen = structure%fine%edges_unseen
         results%stress_in_part = structure%fine%stress_in_part
      end if
      results%converged = results%converged .and. max(results%residual_ratio, results%mismatch) &
         <= results%tolerance
      if (results%converged) then
         results%point_size = largest_at_points(model%points, results%modes, results%displacement)
         if (estimates) results%budget = new_budget(model, history%loading%case_factor, results)
         call judge_solver(results)
      end if
      call check_stop(error)
      if (estimates .and. .not. allocated(error)) then
         call timer%push(phase_joints)
         call compare_stiffer(model, structure, combination, history, field, results, progress)
         call timer%pop()
         call check_stop(error)
      end if
      if (.not. allocated(error)) results%remarks = remarks_on(model, structure, history, field, results)
      results%exchanged(2) = structure%equations%team%exchanged()
      call timer%pop()
   end subroutine analyse_combination

   !> Whether loads balance each other before anything moves, and joints hold
   logical function is_at_rest(structure, history, field) result(rests)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> The loads
      type(history_type), intent(in) :: history
      !> State of the joints that can yield
      type(joint_field_type), intent(in) :: field

      !> Stress that joints do not admit below this part of the largest is rounding
      real(wp), parameter :: none = 1.0e-9_wp

      rests = balance_each_other(structure%equations, history%loading)
      if (rests .and. size(structure%yielding) > 0) &
         rests = maxval(abs(field%excess)) <= none*maxval(abs(field%stress))
   end function is_at_rest

   !> Joints that yield: the increments on the condensed structure, then the
   !> displacements of the whole
   subroutine solve_joints(model, structure, combination, estimates, history, mesh_error, results, &
      progress, error, keeper)
      !> The job
      type(model_type), intent(in), target :: model
      !> The structure, factored and condensed
      type(structure_type), intent(inout), target :: structure
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> Whether errors are estimated
      logical, intent(in) :: estimates
      !> How the increments ended
      type(history_type), intent(out) :: history
      !> Takes what the mesh leaves of the error
      type(mesh_error_type), intent(out) :: mesh_error
      !> Results that take displacements and convergence
      type(results_type), intent(inout) :: results
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Who keeps what the increments come to
      class(keeper_type), intent(inout), optional, target :: keeper

      type(joint_field_type), allocatable :: other
      type(iteration_left_type) :: left

      call run_and_find(model, structure, combination, history, results, progress, keeper)
      if (allocated(history%failure)) then
         error = history%failure
         return
      end if
      results%converged = history%verdict%converged
      results%accumulated = history%method%accumulates
      call stand_where_they_are(structure%condensed, history%scene, history%field)
      if (estimates) &
         call compare_loops(model, structure%condensed, history, results%other_loop, other)
      results%path = history%path
      results%strayed = history%strayed
      results%reached = history%reached
      results%exchanged(1) = history%exchanged
      results%increment_seconds = history%seconds
      results%tolerance = model%increments(size(model%increments))%tolerance
      allocate (results%displacement, mold=history%loading%right)
      if (allocated(history%motion)) then
         results%displacement = 0.0_wp
         call add_motions(structure%condensed%floating, history%motion, results%displacement)
         results%mechanism = mechanism_text(model, history%reached, history%loading%case_factor, results)
      end if
      if (estimates .and. results%converged .and. .not. (history%method%accumulates .or. unloaded(history))) &
         call find_left(structure, history, left)
      call solve_displacements(structure, model, history%loading, results%displacement, results%solves, error, &
         history%field%excess, left=left%change(1)%excess, effect=left%effect)
      if (allocated(error)) return
      call correct_rounding(model, structure, history, results, left, error)
      if (allocated(error)) return
      call keep_claim(model, structure, history, results, left, error)
      call check_stop(error)  ! iterations may have ended for it
      if (allocated(error)) return
      associate (n => size(history%states))
         allocate (results%states(n + 1))  ! [..., f()] would never give back what f() allocated
         results%states(:n) = history%states
         results%states(n + 1) = last_state(history)
      end associate
      results%residuals = history%residuals
      results%residual_part_node = model%mesh%node_label(structure%condensed%measure%part_node)
      call name_idle_motions(model, structure, history, results)
      results%torn = results%converged .and. is_torn(history)
      results%soft_in_part = results%converged .and. is_soft_in_part(history)
      results%turns_slip = results%converged .and. turns_slip(structure, history)
      if (estimates) call estimate_yielding_errors(model, structure, history, other, left, results, mesh_error)
      results%plane_angles = structure%planes%angle
   end subroutine solve_joints

   !> Name the motions that nothing resists and no load acts on
   subroutine name_idle_motions(model, structure, history, results)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Takes the names
      type(results_type), intent(inout) :: results

      real(wp), allocatable :: motion(:, :, :)
      integer :: k, n

      n = 0
      if (results%converged .and. allocated(history%verdict%mechanism%idle)) &
         n = size(history%verdict%mechanism%idle, 2)
      allocate (results%idle(n), results%stands(n))
      if (n == 0) return
      allocate (motion, mold=results%displacement)
      do k = 1, n
         results%stands(k) = history%verdict%mechanism%stands(k)
         motion = 0.0_wp
         call add_motions(structure%condensed%floating, history%verdict%mechanism%idle(:, k), &
            motion)
         results%idle(k) = motion_text(model%mesh, results%modes, motion)
      end do
   end subroutine name_idle_motions

   !> Joints that stay elastic: one solution
   subroutine solve_linear(model, structure, combination, estimates, history, mesh_error, results, &
      timer, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> Whether errors are estimated
      logical, intent(in) :: estimates
      !> Takes the loads
      type(history_type), intent(out) :: history
      !> Takes what the mesh leaves of the error
      type(mesh_error_type), intent(out) :: mesh_error
      !> Results that take displacements and convergence
      type(results_type), intent(inout) :: results
      !> Times of the phases
      type(timer_type), intent(inout) :: timer
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      type(difference_type) :: difference

      call new_loading(model, structure%joint_points, structure%support_points, structure%modes, &
                       structure%equations%unit_loads, combination_type(combination%label, final_factors(model, combination)), &
                       history%loading)
      history%peak = history%loading
      allocate (results%displacement, mold=history%loading%right)
      allocate (results%path(0), results%residuals(0), results%residual_part_node(0))
      results%states = loads_of_increments(model, combination)
      call timer%push(phase_joints)
      if (estimates) then
         call new_difference(size(results%displacement, 2), size(structure%joint_points), &
            size(structure%fine%near_lines), size(structure%modes), n_with_resultants(structure), difference)
         call solve_displacements(structure, model, history%loading, results%displacement, &
            results%solves, error, difference=difference)
         call new_mesh_error(difference, mesh_error)
         call find_held_on_cuts(model, structure, history%loading, results%displacement, mesh_error)
         call find_held_on_lines(model, structure, history%loading, results%displacement, mesh_error)
         call timer%pop(phase_factor, difference%factor_share)
      else
         call solve_displacements(structure, model, history%loading, results%displacement, &
            results%solves, error)
         call timer%pop()
      end if
      if (allocated(error)) return
      results%converged = .true.  ! if the residual says so, too
      results%tolerance = merge(nearly_incompressible_tolerance, linear_tolerance, has_nearly_incompressible(model))
      results%plane_angles = model%output_angles
   end subroutine solve_linear

   !> State at the end of the increments: of the last one, or of the one that failed
   pure function last_state(history) result(state)
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The state
      type(increment_state_type) :: state

      associate (last => history%path(size(history%path)))
         state = state_of(history, history%field, last%increment, last%load_factor, &
                          history%loading%case_factor)
      end associate
      if (allocated(history%motion) .or. history%strayed) &
         state%load_factor = history%reached
   end function last_state

end module axijoint_analysis_static
