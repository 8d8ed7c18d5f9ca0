!> State of a job whose joints are stiffer, found in two ways: on the condensed structure that is at
!> hand, or anew
module axijoint_analysis_error_stiffer_state
   use axijoint_analysis_core_increment_fields, only : elastic_field
   use axijoint_analysis_core_results, only : results_type, mode_solve_type
   use axijoint_analysis_core_solution, only : solve_displacements
   use axijoint_analysis_core_structure, only : structure_type, build_structure
   use axijoint_analysis_error_excess_effect, only : add_excess_effect
   use axijoint_assembly_loading, only : new_loading
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_timer, only : timer_type
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, set_initial_stress
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type, new_state
   use axijoint_joints_increments, only : run_increments
   use axijoint_joints_load_steps, only : final_factors
   use axijoint_joints_method, only : control_type, verdict_type
   use axijoint_joints_newton, only : newton_view
   use axijoint_joints_newton_method, only : newton_method_type
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_planes, only : planes_type, new_view, on_all
   use axijoint_joints_scene, only : scene_type, evaluate
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: stiffer_state_type, state_of_stiffer, state_anew

   !> Tolerance on the residual ratio, and most iterations: of a change three digits are enough
   real(wp), parameter :: tolerance = 1.0e-6_wp
   integer, parameter :: most = 60

   !> A state
   type :: stiffer_state_type
      !> Whether it was found
      logical :: found = .false.
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), allocatable :: displacement(:, :, :)
      !> Stress of all joints on the planes of the results, shape (3, points, planes)
      real(wp), allocatable :: stress(:, :, :)
   end type stiffer_state_type

contains

   !> Let the laws see a multiple of the joints' stiffness. The excess stress is what the stiffness
   !> that the structure was condensed with gives, less what the laws admit, so the structure stays
   !> as it is and Newton's method goes on from the state that was found: within the last increment,
   !> with the slip of those before it
   subroutine state_of_stiffer(model, structure, history, field, results, times, state)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, factored and condensed
      type(structure_type), intent(inout) :: structure
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> State of all joints
      type(joint_field_type), intent(in) :: field
      !> Results
      type(results_type), intent(in) :: results
      !> How many times as stiff
      real(wp), intent(in) :: times
      !> The state
      type(stiffer_state_type), intent(out) :: state

      type(joint_field_type) :: now, stiffer
      real(wp), allocatable :: residual(:, :, :)

      associate (condensed => structure%condensed, scene => history%scene, &
         yielding => structure%yielding)
         now = new_state(condensed, scene)
         call set_initial_stress(model, condensed%points, history%loading%case_factor, now)
         now%excess = field%excess(:, yielding, :)
         now%offset = field%offset
         now%memory = history%memory
         now%view_limit = newton_view
         allocate (residual, mold=now%excess)
         call evaluate(condensed, scene, now, residual)
         now%carried = now%stress
         ! no more than a look, but after the paper's loop
         call balance(condensed, scene, now, state%found)
         stiffer = now
         stiffer%share = times
         if (state%found) call balance(condensed, scene, stiffer, state%found)
         if (.not. state%found) return
         state%displacement = results%displacement
         call add_excess_effect(structure%equations, condensed%points, &
            stiffer%excess - now%excess, state%displacement, &
                                state%found)
         call add_motions(condensed%floating, stiffer%offset - now%offset, state%displacement)
         call take_stress(model, structure, history, state%displacement, stiffer, state%stress)
      end associate
   end subroutine state_of_stiffer

   !> Balance the joints by Newton's method
   subroutine balance(condensed, scene, field, found)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads; residuals are held against the reference of the last increment
      type(scene_type), intent(in) :: scene
      !> State of the joints that yield
      type(joint_field_type), intent(inout) :: field
      !> Whether they came to equilibrium
      logical, intent(out) :: found

      type(newton_method_type) :: newton
      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict

      allocate (path(0))
      call newton%balance(condensed, scene, control_type(tolerance, most, warm=.true.), field, &
         path, verdict)
      found = verdict%converged
   end subroutine balance

   !> Solve the job anew, some of its laws stiffer
   subroutine state_anew(model, combination, laws, times, results, state, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The laws (indices), and how many times as stiff
      integer, intent(in) :: laws(:)
      real(wp), intent(in) :: times
      !> Results
      type(results_type), intent(in) :: results
      !> The state
      type(stiffer_state_type), intent(out) :: state
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(model_type) :: stiffer
      type(structure_type) :: structure
      type(history_type) :: history
      type(mode_solve_type), allocatable :: solves(:)
      type(timer_type) :: timer
      type(error_type), allocatable :: error
      integer :: i

      stiffer = model
      do i = 1, size(laws)
         associate (material => stiffer%joint_materials(laws(i)))
            material%law%stiffness = times*material%law%stiffness
            material%rigid = times*material%rigid
         end associate
      end do
      call timer%start()
      call build_structure(stiffer, structure, timer, progress, error, estimated=.false.)
      if (allocated(error)) return
      if (size(structure%yielding) > 0) then
         call run_increments(stiffer, structure%equations, structure%condensed, &
            structure%joint_points, &
                             structure%support_points, combination, history, progress)
         if (allocated(history%failure) .or. .not. history%verdict%converged) return
      else
         call new_loading(stiffer, structure%joint_points, structure%support_points, &
            structure%modes, structure%equations%unit_loads, &
                          combination_type(combination%label, &
                          final_factors(stiffer, combination)), history%loading)
         allocate (history%field%excess(3, 0, size(structure%modes)))
      end if
      allocate (state%displacement, mold=results%displacement)
      call solve_displacements(structure, stiffer, history%loading, state%displacement, solves, &
         error, history%field%excess)
      state%found = .not. allocated(error)
      if (.not. state%found) return
      if (size(structure%yielding) > 0) then
         call add_motions(structure%condensed%floating, history%field%offset, state%displacement)
      end if
      call take_stress(stiffer, structure, history, state%displacement, history%field, &
         state%stress, &
                       results%plane_angles)
   end subroutine state_anew

   !> Stress of all joints on the planes of the results
   subroutine take_stress(model, structure, history, displacement, yielding, stress, angles)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Loads and planes
      type(history_type), intent(in) :: history
      !> Displacement amplitudes
      real(wp), intent(in) :: displacement(:, :, :)
      !> State of the joints that yield, if any do
      type(joint_field_type), intent(in) :: yielding
      !> Stress of all joints, shape (3, points, planes)
      real(wp), allocatable, intent(out) :: stress(:, :, :)
      !> Angles at which a linear job shows its joints [radian]
      real(wp), intent(in), optional :: angles(:)

      type(joint_field_type) :: field
      type(planes_type) :: planes

      planes = structure%planes
      if (size(structure%yielding) == 0) planes = new_view(angles, structure%modes)
      call elastic_field(model, structure, planes, history%loading%case_factor, displacement, field)
      stress = field%stress
      if (size(structure%yielding) == 0) return
      stress(:, structure%yielding, :) = on_all(history%scene%planes, yielding%stress)
   end subroutine take_stress

end module axijoint_analysis_error_stiffer_state
