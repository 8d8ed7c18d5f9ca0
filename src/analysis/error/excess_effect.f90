!> What changes of the excess stress of joints do to the displacements
module axijoint_analysis_error_excess_effect
   use omp_lib, only : omp_get_wtime
   use axijoint_assembly_equations, only : equations_type, on_equations, expand_mode
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, &
      release_factor
   use axijoint_assembly_force, only : joint_force
   use axijoint_base_kinds, only : wp, i8
   use axijoint_joints_joint_change, only : joint_change_type
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: add_excess_effect, find_effects

   !> Of one change, or of several, for which each factor is read once
   interface add_excess_effect
      module procedure add_effect_of_one, add_effects
   end interface add_excess_effect

contains

   !> Add the displacements from excess joint stress
   subroutine add_effect_of_one(equations, points, excess, displacement, found)
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

      real(wp), allocatable :: effect(:, :, :, :)

      effect = reshape(displacement, [shape(displacement), 1])
      call add_effects(equations, points, reshape(excess, [shape(excess), 1]), effect, found)
      displacement = effect(:, :, :, 1)
   end subroutine add_effect_of_one

   !> The same of several changes
   subroutine add_effects(equations, points, excess, displacement, found)
      !> The equations, factored
      type(equations_type), intent(inout) :: equations
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Amplitudes, shape (3, points, modes, changes)
      real(wp), intent(in) :: excess(:, :, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes, changes)
      real(wp), intent(inout) :: displacement(:, :, :, :)
      !> Whether all are there: a factor that is not kept may lack the memory to be formed again
      logical, intent(out) :: found

      type(workspace_type), allocatable :: spaces(:)
      real(wp), allocatable :: b(:, :)  ! threads have small stacks
      integer, allocatable :: change(:)
      integer :: c, i, j, k, s

      found = .true.
      allocate (change(0))
      do c = 1, size(excess, 4)  ! all ranks decide alike
         if (.not. equations%team%all_of(.not. any(abs(excess(:, :, :, c)) > 0.0_wp))) change = [change, c]
      end do
      if (size(change) == 0) return
      call new_workspaces(equations, spaces)
      !$omp parallel do schedule(dynamic) private(b, c, i, j, k) num_threads(size(spaces)) &
      !$omp reduction(.and.: found)
      do s = equations%first, equations%last
         call hold_factor(equations, s, spaces(own()))
         associate (system => equations%systems(s), n => equations%classes(equations%systems(s)%class)%dofs%n_equations)
            found = found .and. .not. system%failed
            if (system%failed) cycle
            allocate (b(n, size(system%modes)*size(change)))
            j = 0
            do c = 1, size(change)
               do i = 1, size(system%modes)
                  j = j + 1
                  k = system%modes(i)
                  b(:, j) = on_equations(equations, k, joint_force(points, equations%modes(k)%harmonic, &
                     excess(:, :, k, change(c)), size(displacement, 2)))
               end do
            end do
            call system%factor%solve_apart(b)
            j = 0
            do c = 1, size(change)
               do i = 1, size(system%modes)
                  j = j + 1
                  k = system%modes(i)
                  displacement(:, :, k, change(c)) = displacement(:, :, k, change(c)) + expand_mode(equations, k, b(:, j))
               end do
            end do
            deallocate (b)
         end associate
         call release_factor(equations, s, spaces(own()))
      end do
      !$omp end parallel do
      found = equations%team%all_of(found)
      do c = 1, size(change)
         call equations%team%gather(displacement(:, :, :, change(c)), size(displacement(:, :, :, 1), kind=i8), &
            equations%last_mode)
      end do
   end subroutine add_effects

   !> What changes of the joints do to the displacements, each without rigid motions of floating parts
   subroutine find_effects(equations, points, n_nodes, changes, effect)
      !> The equations, factored
      type(equations_type), intent(inout) :: equations
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Nodes
      integer, intent(in) :: n_nodes
      !> The changes; those whose effect is not found are not known, and each took its part of the time
      type(joint_change_type), intent(inout) :: changes(:)
      !> Amplitudes, shape (3, nodes, modes, changes)
      real(wp), allocatable, intent(out) :: effect(:, :, :, :)

      real(wp), allocatable :: excess(:, :, :, :)
      real(wp) :: start
      integer :: k
      logical :: found

      start = omp_get_wtime()
      allocate (excess(3, size(points), size(equations%modes), size(changes)), source=0.0_wp)
      do k = 1, size(changes)
         if (changes(k)%known) excess(:, :, :, k) = changes(k)%excess
      end do
      allocate (effect(3, n_nodes, size(equations%modes), size(changes)), source=0.0_wp)
      call add_effects(equations, points, excess, effect, found)
      do k = 1, size(changes)
         changes(k)%known = changes(k)%known .and. found
         changes(k)%seconds = changes(k)%seconds + (omp_get_wtime() - start)/size(changes)
      end do
   end subroutine find_effects

end module axijoint_analysis_error_excess_effect
