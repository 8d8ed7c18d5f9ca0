!> What the mesh leaves of the error of a job whose joints yield: with their stress held, then with what they answer
module axijoint_analysis_error_joints_mesh_error
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_error_joint_shares, only : least_changes
   use axijoint_analysis_fine_difference, only : difference_type, room_type, most_steps, new_difference, find_difference, &
      share_difference
   use axijoint_analysis_fine_joints, only : fine_excess
   use axijoint_analysis_fine_level, only : fine_load_type, new_fine_load
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type, new_mesh_error
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, release_factor
   use axijoint_assembly_force, only : joint_jump
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_errors, only : joint_change_type, change_between, offset_between
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, idle_part
   use axijoint_joints_scene, only : scene_type
   use axijoint_joints_settle, only : find_again
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: mesh_error_of_held, mesh_error_of_balanced, add_answer

contains

   !> Errors of the mesh while the stress of the joints is what it is
   subroutine mesh_error_of_held(structure, history, field, displacement, error)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The errors
      type(mesh_error_type), intent(out) :: error

      real(wp) :: start

      start = omp_get_wtime()
      call all_differences(structure, history, structure%fine%coarse_points(structure%yielding), &
         field%excess, &
                           displacement, error)
      call leave_out_idle(structure, history%scene, field, error)
      error%seconds = omp_get_wtime() - start
   end subroutine mesh_error_of_held

   !> Errors of the mesh while the stress of the joints is held, as the law gives it along the fine joints; and what joints
   !> answer, whose effect on the displacements is for `add_answer`
   subroutine mesh_error_of_balanced(structure, history, balanced, displacement, error, answer)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of the joints, balanced
      type(joint_field_type), intent(in) :: balanced
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The errors
      type(mesh_error_type), intent(out) :: error
      !> The change of the joints by these; not known if no state was found
      type(joint_change_type), intent(out) :: answer

      type(model_joint_point_type), allocatable :: points(:)
      type(joint_field_type), allocatable :: after
      type(scene_type) :: corrected
      real(wp), allocatable :: excess(:, :, :)
      real(wp) :: start
      logical :: found

      start = omp_get_wtime()
      associate (condensed => structure%condensed, scene => history%scene)
         call fine_excess(condensed, scene, structure%fine, balanced, displacement, &
            history%loading%case_factor, points, excess)
         call all_differences(structure, history, points, excess, displacement, error)
         call leave_out_idle(structure, scene, balanced, error)
         allocate (after, source=balanced)
         corrected = scene
         corrected%loads%free = scene%loads%free + error%jump(:, structure%yielding, :)
         call find_again(condensed, corrected, history%start, after, found)
         if (found) then
            answer = change_between(scene, balanced, after, least_changes(structure, history))
            error%joint_stress = answer%stress
            answer%offset = offset_between(condensed, scene, balanced, corrected, after, least_changes(structure, history))
         end if
      end associate
      error%seconds = omp_get_wtime() - start
   end subroutine mesh_error_of_balanced

   !> Leave motions out of the errors that nothing resists and no load acts on: their size is of no meaning. The errors have
   !> them, as joints of the fine mesh integrate the same stress by other points, which leaves a force along such a motion;
   !> and joints that are to answer that force would find no equilibrium
   subroutine leave_out_idle(structure, scene, field, error)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The errors
      type(mesh_error_type), intent(inout) :: error

      type(mechanism_type) :: mechanism
      real(wp), allocatable :: multiple(:), motion(:, :, :)
      integer :: k

      associate (condensed => structure%condensed)
         call find_mechanism(condensed, scene, field, .false., mechanism)
         if (size(mechanism%idle, 2) == 0) return
         multiple = -idle_part(condensed, scene, mechanism, error%jump(:, structure%yielding, :))
         allocate (motion, mold=error%displacement)
         motion = 0.0_wp
         call add_motions(condensed%floating, multiple, motion)
         error%displacement = error%displacement + motion
         do k = 1, size(motion, 3)
            error%jump(:, :, k) = error%jump(:, :, k) + joint_jump(structure%joint_points, motion(:, :, k))
         end do
      end associate
   end subroutine leave_out_idle

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

   !> Errors of all modes while the stress of the joints is held
   subroutine all_differences(structure, history, points, excess, displacement, error)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Joint points with excess stress, and its amplitudes, shape (3, points, modes)
      type(model_joint_point_type), intent(in) :: points(:)
      real(wp), intent(in) :: excess(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Takes the errors
      type(mesh_error_type), intent(out) :: error

      type(workspace_type), allocatable :: spaces(:)
      type(room_type), allocatable :: rooms(:)
      type(difference_type) :: difference
      type(fine_load_type) :: load
      integer :: steps(size(structure%modes)), s

      call new_difference(size(displacement, 2), size(structure%joint_points), &
         size(displacement, 3), difference)
      load = new_fine_load(structure%fine, structure%modes, history%loading)
      steps = steps_of(history, excess)
      associate (equations => structure%equations)
         call new_workspaces(equations, spaces)
         allocate (rooms(size(spaces)))
         !$omp parallel do schedule(dynamic) num_threads(size(spaces))
         do s = equations%first, equations%last
            if (all(steps(equations%systems(s)%modes) == 0)) cycle
            call hold_factor(equations, s, spaces(own()))
            if (.not. equations%systems(s)%failed) then
               call find_difference(structure%fine, equations, s, load, displacement, points, &
                  excess, rooms(own()), difference, steps)
            end if
            call release_factor(equations, s, spaces(own()))
         end do
         !$omp end parallel do
         call share_difference(equations, difference)
         call new_mesh_error(difference, error)
         error%known = equations%team%all_of(error%known .and. .not. any(equations%systems%failed))
      end associate
   end subroutine all_differences

   !> Steps to go in each mode: few where nothing acts in it but little excess stress, for its part in the error is as small.
   !> All harmonics in which none is gone had 5 % of the jumps' errors in a pile of M = 8
   pure function steps_of(history, excess) result(steps)
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Excess stress, amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: excess(:, :, :)
      !> Steps at most, shape (modes)
      integer :: steps(size(excess, 3))

      !> Parts of the largest excess stress below which no step is gone, and one
      real(wp), parameter :: little = 0.05_wp, less = 0.25_wp
      real(wp) :: largest
      integer :: k

      largest = maxval(abs(excess))
      do k = 1, size(steps)
         steps(k) = most_steps
         if (any(abs(history%loading%right(:, :, k)) > 0.0_wp)) cycle
         if (maxval(abs(excess(:, :, k))) <= less*largest) steps(k) = 1
         if (maxval(abs(excess(:, :, k))) <= little*largest) steps(k) = 0
      end do
   end function steps_of

end module axijoint_analysis_error_joints_mesh_error
