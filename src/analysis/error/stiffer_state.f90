!> State of a job whose joints are stiffer, found in two ways: on the condensed structure that is at
!> hand, or anew
module axijoint_analysis_error_stiffer_state
   use axijoint_analysis_core_increment_fields, only : elastic_field
   use axijoint_analysis_core_results, only : results_type, mode_solve_type
   use axijoint_analysis_core_solution, only : solve_displacements
   use axijoint_analysis_core_structure, only : structure_type, build_structure
   use axijoint_assembly_equations, only : solve_mode
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, release_factor
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_timer, only : timer_type
   use axijoint_joints_balance, only : verdict_type, balance_step
   use axijoint_joints_field, only : joint_field_type, iteration_type, new_joint_field, set_initial_stress
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_increments, only : history_type, run_increments, final_factors
   use axijoint_joints_planes, only : planes_type, new_view, on_all
   use axijoint_joints_scene, only : scene_type, evaluate
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type, method_newton
   implicit none
   private
   public :: state_of_stiffer, state_anew

   !> Tolerance on the residual ratio, and most iterations: of a change three digits are enough
   real(wp), parameter :: tolerance = 1.0e-6_wp
   integer, parameter :: most = 60

contains

   !> Let the laws see a multiple of the joints' stiffness. The excess stress is what the stiffness that
   !> the structure was condensed with gives, less what the laws admit, so
   !> the structure stays as it is and Newton's method goes on from the state that was found:
   !> within the last increment, with the slip of those before it
   subroutine state_of_stiffer(model, structure, history, field, results, times, displacement, stress, found)
      !> The job
      type(model_type), intent(in), target :: model
      !> The structure, factored and condensed; the loads are in its response
      type(structure_type), intent(inout), target :: structure
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> State of all joints
      type(joint_field_type), intent(in) :: field
      !> Results
      type(results_type), intent(in) :: results
      !> How many times as stiff
      real(wp), intent(in) :: times
      !> Displacement amplitudes, and stress of all joints on the planes
      real(wp), allocatable, intent(out) :: displacement(:, :, :), stress(:, :, :)
      !> Whether it was found
      logical, intent(out) :: found

      type(joint_field_type) :: now, stiffer
      real(wp), allocatable :: residual(:, :, :)
      integer :: method

      associate (scene => structure%scene, yielding => structure%yielding)
         method = scene%method
         scene%method = method_newton
         now = new_joint_field(size(scene%points), size(scene%planes%angle), size(scene%equations%modes), &
                              size(scene%floating))
         call set_initial_stress(model, scene%points, history%loading%case_factor, now)
         now%excess = field%excess(:, yielding, :)
         now%offset = field%offset
         now%memory = history%memory
         allocate (residual, mold=now%excess)
         call evaluate(scene, now, residual)
         now%carried = now%stress
         call balance(scene, now, found)  ! no more than a look, but after the paper's loop
         stiffer = now
         stiffer%share = times
         if (found) call balance(scene, stiffer, found)
         scene%method = method
         if (.not. found) return
         displacement = results%displacement
         call add_effect(structure, stiffer%excess - now%excess, displacement)
         call add_motions(scene%floating, stiffer%offset - now%offset, displacement)
         call take_stress(model, structure, history%loading%case_factor, displacement, stiffer, stress)
      end associate
   end subroutine state_of_stiffer

   !> Balance the joints by Newton's method
   subroutine balance(scene, field, found)
      !> What does not change; residuals are held against the reference of the last increment
      type(scene_type), intent(inout) :: scene
      !> State of the joints that yield
      type(joint_field_type), intent(inout) :: field
      !> Whether they came to equilibrium
      logical, intent(out) :: found

      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict

      allocate (path(0))
      call balance_step(scene, tolerance, most, iteration_type(), field, path, verdict, warm=.true.)
      found = verdict%converged
   end subroutine balance

   !> Add the displacements that a change of the excess stress makes
   subroutine add_effect(structure, change, displacement)
      !> The structure, factored
      type(structure_type), intent(inout) :: structure
      !> Change of the excess stress, shape (3, points, modes)
      real(wp), intent(in) :: change(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(inout) :: displacement(:, :, :)

      type(workspace_type), allocatable :: spaces(:)
      real(wp), allocatable :: force(:, :), effect(:, :)  ! threads have small stacks
      integer :: s, i, k

      associate (equations => structure%equations)
         call new_workspaces(equations, spaces)
         !$omp parallel do schedule(dynamic) private(i, k, force, effect) num_threads(size(spaces))
         do s = 1, size(equations%systems)
            call hold_factor(equations, s, spaces(own()))
            if (equations%systems(s)%failed) cycle
            do i = 1, size(equations%systems(s)%modes)
               k = equations%systems(s)%modes(i)
               force = joint_force(structure%scene%points, equations%modes(k)%harmonic, change(:, :, k), &
                                   size(displacement, 2))
               effect = force
               call solve_mode(equations, k, force, effect)
               displacement(:, :, k) = displacement(:, :, k) + effect
            end do
            call release_factor(equations, s, spaces(own()))
         end do
         !$omp end parallel do
      end associate
   end subroutine add_effect

   !> Solve the job anew, some of its laws stiffer
   subroutine state_anew(model, combination, laws, times, results, displacement, stress, found, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The laws (indices), and how many times as stiff
      integer, intent(in) :: laws(:)
      real(wp), intent(in) :: times
      !> Results
      type(results_type), intent(in) :: results
      !> Displacement amplitudes, and stress of all joints on the planes of the results
      real(wp), allocatable, intent(out) :: displacement(:, :, :), stress(:, :, :)
      !> Whether it was found
      logical, intent(out) :: found
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(model_type), target :: stiffer
      type(structure_type), target :: structure
      type(history_type) :: history
      type(joint_field_type) :: yielding
      type(mode_solve_type), allocatable :: solves(:)
      type(timer_type) :: timer
      type(error_type), allocatable :: error
      integer :: i

      found = .false.
      stiffer = model
      do i = 1, size(laws)
         associate (law => stiffer%joint_materials(laws(i))%law)
            law%stiffness = times*law%stiffness
         end associate
      end do
      call timer%start()
      call build_structure(stiffer, structure, timer, progress, error)
      if (allocated(error)) return
      if (size(structure%yielding) > 0) then
         structure%scene%model => stiffer
         structure%scene%equations => structure%equations
         structure%scene%method = stiffer%method
         call run_increments(structure%scene, structure%joint_points, structure%support_points, combination, &
                             yielding, history, progress)
         if (allocated(history%failure) .or. .not. history%verdict%converged) return
      else
         call new_loading(stiffer, structure%joint_points, structure%support_points, structure%modes, &
                          combination_type(combination%label, final_factors(stiffer, combination)), history%loading)
         structure%scene%points = structure%joint_points(:0)
         allocate (yielding%excess(3, 0, size(structure%modes)))
      end if
      allocate (displacement, mold=results%displacement)
      call solve_displacements(structure, stiffer, history%loading, displacement, solves, error, yielding%excess)
      found = .not. allocated(error)
      if (.not. found) return
      if (size(structure%yielding) > 0) call add_motions(structure%scene%floating, yielding%offset, displacement)
      call take_stress(stiffer, structure, history%loading%case_factor, displacement, yielding, stress, results%plane_angles)
   end subroutine state_anew

   !> Stress of all joints on the planes of the results
   subroutine take_stress(model, structure, case_factor, displacement, yielding, stress, angles)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Factors of the load cases
      real(wp), intent(in) :: case_factor(:)
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
      call elastic_field(model, structure, planes, case_factor, displacement, field)
      stress = field%stress
      if (size(structure%yielding) == 0) return
      stress(:, structure%yielding, :) = on_all(structure%scene%planes, yielding%stress)
   end subroutine take_stress

end module axijoint_analysis_error_stiffer_state
