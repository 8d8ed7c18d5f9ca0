!> What the mesh leaves of the error of a job whose joints yield, and what these answer
module axijoint_analysis_error_joints_mesh_error
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_error_held_error, only : judged_state_type, held_errors_type, begin_by_law
   use axijoint_analysis_error_joint_shares, only : least_changes
   use axijoint_analysis_error_remembered, only : solved_way_type, find_remembered
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type
   use axijoint_assembly_force, only : joint_jump
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_change, only : joint_change_type, change_between, offset_between
   use axijoint_joints_scene, only : scene_type
   use axijoint_joints_settle, only : find_again
   use axijoint_joints_way, only : lag_type, shift, add_slip
   implicit none
   private
   public :: begin_held_errors, find_answer, add_answer

contains

   !> Begin errors of the mesh while the stress of the joints is held, as the law gives it along the fine joints: where loads turned on
   !> the way, if it is known, and in the end, which is the last
   subroutine begin_held_errors(structure, history, balanced, displacement, way, under_way)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in), target :: history
      !> State of the joints, balanced
      type(joint_field_type), intent(in), target :: balanced
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in), target :: displacement(:, :, :)
      !> The way that loads took, if it is known, and slip that came about on it lasts
      type(solved_way_type), intent(in), target :: way
      !> The errors
      type(held_errors_type), intent(out) :: under_way

      type(judged_state_type), allocatable :: states(:)
      integer :: i, n

      n = 0
      if (way%known) n = size(way%places)
      allocate (states(n + 1))
      do i = 1, n
         states(i) = judged_state_type(way%solved(i)%loading, way%stations(i)%field, way%solved(i)%displacement)
      end do
      states(n + 1) = judged_state_type(history%loading, balanced, displacement)
      call begin_by_law(structure, history%scene, states, under_way)
   end subroutine begin_held_errors

   !> What joints answer to these errors, and to what the mesh left before of slip that lasts; the effect on the displacements is
   !> for `add_answer`
   subroutine find_answer(structure, history, balanced, errors, way, error, answer)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of the joints, balanced
      type(joint_field_type), intent(in) :: balanced
      !> The errors while the stress of the joints is held
      type(mesh_error_type), intent(in) :: errors(:)
      !> The way that loads took
      type(solved_way_type), intent(in) :: way
      !> The errors of the mesh in the end
      type(mesh_error_type), intent(out) :: error
      !> The change of the joints by these; not known if no state was found
      type(joint_change_type), intent(out) :: answer

      type(memory_type), allocatable :: start(:, :)
      type(joint_field_type), allocatable :: after
      type(scene_type) :: corrected
      type(lag_type) :: lag
      real(wp) :: began, largest
      logical :: found

      began = omp_get_wtime()
      error = errors(size(errors))
      associate (condensed => structure%condensed, scene => history%scene)
         allocate (after, source=balanced)
         corrected = scene
         corrected%loads%free = scene%loads%free + error%jump(:, structure%yielding, :)
         call find_again(condensed, corrected, history%start, after, found)
         if (found) then
            answer = change_by(corrected, after)
            if (way%known) call find_remembered(structure, history, errors, way, lag)
         end if
         if (lag%known) then
            start = history%start
            call add_slip(lag, start)
            call shift(condensed, scene, lag, after)
            call find_again(condensed, corrected, start, after, error%follows_slip)
         end if
         if (error%follows_slip) then
            largest = answer%stress
            answer = change_by(corrected, after)
            answer%stress = max(answer%stress, largest)  ! in single points the two may take each other away
         end if
         if (found) error%joint_stress = answer%stress
      end associate
      error%seconds = error%seconds + omp_get_wtime() - began

   contains

      !> Change to a state under changed loads
      function change_by(scene, after) result(change)
         !> The loads
         type(scene_type), intent(in) :: scene
         !> The state
         type(joint_field_type), intent(in) :: after
         !> The change
         type(joint_change_type) :: change

         associate (rounding => least_changes(structure, history))
            change = change_between(history%scene, balanced, after, rounding)
            change%offset = offset_between(structure%condensed, history%scene, balanced, scene, after, rounding)
         end associate
      end function change_by

   end subroutine find_answer

   !> Add what the joints answer to the errors of displacements and jumps
   subroutine add_answer(structure, answer, effect, error)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> The change of the joints
      type(joint_change_type), intent(in) :: answer
      !> What it does to displacements but for rigid motions of floating parts, amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: effect(:, :, :)
      !> The errors
      type(mesh_error_type), intent(inout) :: error

      real(wp), allocatable :: change(:, :, :)
      integer :: k

      change = effect
      call add_motions(structure%condensed%floating, answer%offset, change)
      error%displacement = error%displacement + change
      do k = 1, size(change, 3)
         error%jump(:, :, k) = error%jump(:, :, k) + joint_jump(structure%joint_points, change(:, :, k))
      end do
   end subroutine add_answer

end module axijoint_analysis_error_joints_mesh_error
