!> The paper's loop: stress transfer with the initial stiffness (steps 1 to 5)
module axijoint_joints_transfer
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_assembly_equations, only : equations_type, solve_mode, worth_threads
   use axijoint_assembly_force, only : joint_force, joint_jump
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_text, only : to_text
   use axijoint_joints_field, only : joint_field_type, iteration_type, new_joint_field, &
                                     elastic_stress, admit, judge_states, count_state
   use axijoint_joints_planes, only : planes_type, synthesize, analyse
   use axijoint_joints_residual, only : residual_norm, load_norm, ratio
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: transfer_loop

contains

   !> Apply the increments one after the other, each until equilibrium. The
   !> stress of a joint point is accumulated over the iterations (step 3). An
   !> increment that does not reach its tolerance ends the loop with the last
   !> state and `converged` false.
   subroutine transfer_loop(model, points, equations, planes, loading, displacement, field, &
                            path, converged, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Equations of all modes, factored
      type(equations_type), intent(in) :: equations
      !> Planes of the joint checks
      type(planes_type), intent(in) :: planes
      !> Loads for a factor of one
      type(loading_type), intent(in) :: loading
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(out) :: displacement(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(out) :: field
      !> Convergence path
      type(iteration_type), allocatable, intent(out) :: path(:)
      !> Whether all increments reached their tolerances
      logical, intent(out) :: converged
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      real(wp) :: factor, largest_factor
      integer :: i

      allocate (path(0))
      displacement = 0.0_wp
      field = new_joint_field(size(points), size(planes%angle), size(equations%modes))
      factor = 0.0_wp
      largest_factor = 0.0_wp
      converged = .true.
      do i = 1, size(model%increments)
         factor = factor + model%increments(i)%factor
         largest_factor = max(largest_factor, abs(factor))  ! after unloading Psi_f would be zero
         call balance_increment(model, points, equations, planes, i, factor, loading, &
                                largest_factor*load_norm(equations, loading), displacement, field, &
                                path, converged, progress)
         if (.not. converged) return
      end do
   end subroutine transfer_loop

   !> Iterate one increment to equilibrium
   subroutine balance_increment(model, points, equations, planes, increment, factor, loading, &
                                norm, displacement, field, path, converged, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Equations of all modes, factored
      type(equations_type), intent(in) :: equations
      !> Planes of the joint checks
      type(planes_type), intent(in) :: planes
      !> Number of the increment
      integer, intent(in) :: increment
      !> Sum of the load factors
      real(wp), intent(in) :: factor
      !> Loads for a factor of one
      type(loading_type), intent(in) :: loading
      !> Norm of the largest load so far (Psi_f)
      real(wp), intent(in) :: norm
      !> Displacement amplitudes
      real(wp), intent(inout) :: displacement(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Convergence path
      type(iteration_type), allocatable, intent(inout) :: path(:)
      !> Whether the tolerance was reached
      logical, intent(out) :: converged
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(iteration_type) :: steps(model%increments(increment)%max_iterations)
      integer :: iteration

      converged = .false.
      do iteration = 1, size(steps)
         call transfer_stress(model, points, equations, planes, factor, loading, displacement, field)
         associate (now => steps(iteration))
            now = iteration_type(increment=increment, iteration=iteration, load_factor=factor)
            now%ratio = ratio(residual_norm(equations, points, factor*loading%right, &
                                            displacement, field%excess), norm)
            call judge_states(model, points, field)
            call count_state(field, now%n_slip, now%n_open)
            call show_progress(progress, 'increment '//to_text(increment)//' iteration '// &
                               to_text(iteration)//' residual '//to_text(now%ratio))
            if (.not. ieee_is_finite(now%ratio)) exit
            converged = now%ratio <= model%increments(increment)%tolerance
         end associate
         if (converged) exit
      end do
      path = [path, steps(:min(iteration, size(steps)))]
   end subroutine balance_increment

   !> One sweep: solve for the residual forces (1), add the joint stress that
   !> follows on every plane (2, 3), cut it by the law, and keep what was cut
   !> off as harmonics for the next residual (4)
   subroutine transfer_stress(model, points, equations, planes, factor, loading, displacement, &
                              field)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Equations of all modes, factored
      type(equations_type), intent(in) :: equations
      !> Planes of the joint checks
      type(planes_type), intent(in) :: planes
      !> Load factor, and loads for a factor of one
      real(wp), intent(in) :: factor
      type(loading_type), intent(in) :: loading
      !> Displacement amplitudes
      real(wp), intent(inout) :: displacement(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(inout) :: field

      real(wp), allocatable :: jump(:, :, :), jump_change(:, :, :), trial(:, :, :)
      real(wp), allocatable :: total(:, :)  ! threads have small stacks
      integer :: s, i, k

      allocate (jump(3, size(points), size(equations%modes)))
      !$omp parallel do schedule(dynamic) private(total, i, k) if (worth_threads(equations))
      do s = 1, size(equations%systems)
         do i = 1, size(equations%systems(s)%modes)
            k = equations%systems(s)%modes(i)
            ! K is constant, so solving for the residual forces and adding is the
            ! same as solving for all forces: no rounding piles up
            total = factor*loading%right(:, :, k) + joint_force(points, &
               equations%modes(k)%harmonic, field%excess(:, :, k), size(displacement, 2))
            call solve_mode(equations, k, total, displacement(:, :, k))
            if (allocated(loading%held)) then
               displacement(:, :, k) = displacement(:, :, k) + factor*loading%held(:, :, k)
            end if
            jump(:, :, k) = joint_jump(points, displacement(:, :, k))
         end do
      end do
      !$omp end parallel do
      jump_change = synthesize(planes, jump) - field%jump
      trial = field%stress + elastic_stress(model, points, jump_change)
      field%jump = field%jump + jump_change
      call admit(model, points, trial, field)
      field%excess = field%excess + analyse(planes, trial - field%stress)
   end subroutine transfer_stress

end module axijoint_joints_transfer
