!> Bodies that yield: the increments, then the displacements of the whole at the last equilibrium
module axijoint_analysis_core_yielding_bodies
   use axijoint_analysis_core_increment_fields, only : load_plastic_strain, stress_plastic_strain
   use axijoint_analysis_core_motion, only : motion_text
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_solution, only : solve_displacements
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_stop, only : check_stop
   use axijoint_base_text, only : to_text
   use axijoint_joints_history, only : history_type
   use axijoint_joints_keeper, only : keeper_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type
   use axijoint_plastic_field, only : body_field_type
   use axijoint_plastic_increments, only : run_body_increments
   use axijoint_plastic_stage, only : body_history_type
   implicit none
   private
   public :: solve_bodies

   !> Smaller multiples, and larger ones, are not told
   real(wp), parameter :: least_told = 2.0_wp, most_told = 1.0e6_wp
   !> Multiple from which on bodies give way. Where psi < phi iterations may come to no equilibrium far below that
   real(wp), parameter :: gives_way = 50.0_wp

contains

   !> Run the increments of bodies that yield, with joints or without
   subroutine solve_bodies(model, structure, combination, history, results, progress, error, keeper)
      !> The job
      type(model_type), intent(in), target :: model
      !> The structure, factored and condensed
      type(structure_type), intent(inout), target :: structure
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> Takes the loads, and what the increments came to at the joints
      type(history_type), intent(out) :: history
      !> Results that take displacements and convergence
      type(results_type), intent(inout) :: results
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Who keeps what the increments come to
      class(keeper_type), intent(inout), optional :: keeper

      type(body_history_type) :: bodies
      real(wp), allocatable :: planes(:)

      if (structure%equations%team%size > 1) then
         call fatal_error(error, exit_deck, 'bodies that yield are not shared by several '// &
            'processes'//new_line('a')//'mend: run one process, which uses all processors as '// &
            'threads')
         return
      end if
      call run_body_increments(model, structure%equations, structure%condensed, &
         structure%joint_points, structure%support_points, combination, history, bodies, planes, &
         progress, keeper)
      if (allocated(history%failure)) then
         error = history%failure
         return
      end if
      results%converged = history%verdict%converged
      results%tolerance = model%increments(size(model%increments))%tolerance
      results%path = history%path
      results%states = history%states
      allocate (results%residuals(0), results%residual_part_node(0))
      allocate (results%displacement, mold=history%loading%right)
      associate (state => results%states(size(results%states)))
         call load_plastic_strain(model, structure, state, history%loading)
         ! where no joint yields there is no excess stress
         call solve_displacements(structure, model, history%loading, results%displacement, &
            results%solves, error, state%excess)
         if (allocated(error)) return
         call stress_plastic_strain(model, state, history%loading)
      end associate
      allocate (results%yield_errors)
      results%yield_errors%softness = softness_of(bodies%field)
      results%plane_angles = model%output_angles
      if (size(structure%yielding) > 0) results%plane_angles = structure%planes%angle
      call check_stop(error)
      if (allocated(error) .or. results%converged) return
      results%failing = bodies%failing
      results%tried = bodies%tried
      if (.not. bodies%verdict%exhausted) results%mechanism = failure_text(model, history, bodies, results)
   end subroutine solve_bodies

   !> Growth of the displacement in the last step over that of the load, both over what they came to:
   !> 1 of elastic bodies. Displacements count by the work of what the step added to the loads
   pure real(wp) function softness_of(field) result(softness)
      !> State of the bodies at the last equilibrium
      type(body_field_type), intent(in) :: field

      real(wp) :: load, displacement

      softness = -1.0_wp
      load = dot_product(field%pushed, field%right)
      displacement = dot_product(field%pushed, field%begun)
      if (.not. load*displacement > 0.0_wp) return
      softness = dot_product(field%pushed, field%moved)/displacement &
         *load/dot_product(field%pushed, field%pushed)
   end function softness_of

   !> Why the increments ended, in words: how far the load went and what moves. That there is no equilibrium beyond is not said:
   !> another method may find one a little farther
   function failure_text(model, history, bodies, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> What the increments came to, and in the bodies
      type(history_type), intent(in) :: history
      type(body_history_type), intent(in) :: bodies
      !> Results with the displacements that failed
      type(results_type), intent(in) :: results
      !> The sentence
      character(len=:), allocatable :: text

      text = 'no equilibrium was found beyond the load factor '//to_text(history%reached)// &
         ': '//motion_text(model%mesh, results%modes, results%failing)
      if (bodies%growth >= least_told) then
         text = text//'; at the load factor '//to_text(bodies%tried)//' the last step moved it '// &
            times_text(bodies%growth)//' as far as if all were elastic'
      else
         text = text//'; the last step was to the load factor '//to_text(bodies%tried)
      end if
      if (bodies%growth < gives_way .and. any(model%materials%yield%dilation < model%materials%yield%friction)) text = text// &
         '; with psi < phi that need not be the limit load: psi = phi with c and tan phi times '// &
         'cos psi cos phi/(1 - sin psi sin phi) tells where it is (Davis)'
      if (bodies%verdict%joints_failed) text = text//', and joints came to no equilibrium'
      text = text//'; results are those at '//to_text(history%reached)
   end function failure_text

   !> A multiple in words
   function times_text(growth) result(text)
      !> The multiple
      real(wp), intent(in) :: growth
      !> Such as '120 times'
      character(len=:), allocatable :: text

      text = to_text(nint(min(growth, most_told)))//' times'
      if (growth > most_told) text = 'more than '//text
   end function times_text

end module axijoint_analysis_core_yielding_bodies
