!> What a change of the excess stress of joints does to the displacements
module axijoint_analysis_error_excess_effect
   use axijoint_assembly_equations, only : equations_type, solve_mode
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, &
      release_factor
   use axijoint_assembly_force, only : joint_force
   use axijoint_base_kinds, only : wp, i8
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: add_excess_effect

contains

   !> Add the displacements from excess joint stress
   subroutine add_excess_effect(equations, points, excess, displacement, found)
      !> The equations, factored
      type(equations_type), intent(inout) :: equations
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: excess(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(inout) :: displacement(:, :, :)
      !> Whether all are there: a factor that is not kept may lack the memory to be formed again
      logical, intent(out) :: found

      type(workspace_type), allocatable :: spaces(:)
      real(wp), allocatable :: part(:, :), force(:, :)  ! threads have small stacks
      integer :: s, i, k

      found = .true.
      if (.not. any(abs(excess) > 0.0_wp)) return
      call new_workspaces(equations, spaces)
      !$omp parallel do schedule(dynamic) private(i, k, part, force) num_threads(size(spaces)) &
      !$omp reduction(.and.: found)
      do s = equations%first, equations%last
         call hold_factor(equations, s, spaces(own()))
         found = found .and. .not. equations%systems(s)%failed
         if (equations%systems(s)%failed) cycle
         do i = 1, size(equations%systems(s)%modes)
            k = equations%systems(s)%modes(i)
            force = joint_force(points, equations%modes(k)%harmonic, excess(:, :, k), &
               size(displacement, 2))
            part = force  ! for its shape
            call solve_mode(equations, k, force, part)
            displacement(:, :, k) = displacement(:, :, k) + part
         end do
         call release_factor(equations, s, spaces(own()))
      end do
      !$omp end parallel do
      found = equations%team%all_of(found)
      call equations%team%gather(displacement, size(displacement, kind=i8), equations%last_mode)
   end subroutine add_excess_effect

end module axijoint_analysis_error_excess_effect
