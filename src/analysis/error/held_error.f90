!> What the mesh leaves of the error of a job whose joints yield while the stress of these is held
module axijoint_analysis_error_held_error
   use omp_lib, only : omp_get_wtime, omp_in_parallel
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_fine_difference, only : difference_type, room_type, most_steps, new_difference, find_difference, &
      share_difference
   use axijoint_analysis_fine_joints, only : fine_excess
   use axijoint_analysis_fine_level, only : fine_load_type, new_fine_load
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type, new_mesh_error
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, release_factor
   use axijoint_assembly_force, only : joint_jump
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, idle_part
   use axijoint_joints_scene, only : scene_type
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: judged_state_type, error_of_held, errors_by_law

   !> A state whose errors are wanted
   type :: judged_state_type
      !> Loads
      type(loading_type), pointer :: loading => null()
      !> Joints that yield, balanced, their slip not yet added to what they remember
      type(joint_field_type), pointer :: field => null()
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), pointer :: displacement(:, :, :) => null()
   end type judged_state_type

   !> The same on the fine level
   type :: held_state_type
      !> Loads
      type(fine_load_type) :: load
      !> Excess stress of joints, amplitudes, shape (3, points, modes)
      real(wp), allocatable :: excess(:, :, :)
      !> Steps at most, shape (modes)
      integer, allocatable :: steps(:)
      !> Takes the difference
      type(difference_type) :: difference
   end type held_state_type

contains

   !> Errors of a state while the stress of the joints is what it is
   subroutine error_of_held(structure, scene, state, error)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> The state
      type(judged_state_type), intent(in) :: state
      !> The errors
      type(mesh_error_type), intent(out) :: error

      type(held_state_type) :: held(1)
      real(wp) :: began

      began = omp_get_wtime()
      held(1)%excess = state%field%excess
      call find_differences(structure, structure%fine%coarse_points(structure%yielding), [state], held)
      call take_error(structure, scene, state%field, held(1)%difference, error)
      error%seconds = omp_get_wtime() - began
   end subroutine error_of_held

   !> Errors of states while it is what the law gives along the fine joints
   subroutine errors_by_law(structure, scene, states, errors)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> The states
      type(judged_state_type), intent(in) :: states(:)
      !> The errors
      type(mesh_error_type), intent(out) :: errors(:)

      type(held_state_type) :: held(size(states))
      type(model_joint_point_type), allocatable :: points(:)
      integer :: i

      do i = 1, size(states)
         associate (state => states(i))
            call fine_excess(structure%condensed, scene, structure%fine, state%field, state%displacement, &
               state%loading%case_factor, points, held(i)%excess)
         end associate
      end do
      call find_differences(structure, points, states, held)
      do i = 1, size(states)
         call take_error(structure, scene, states(i)%field, held(i)%difference, errors(i))
      end do
   end subroutine errors_by_law

   !> Take the difference for the error
   subroutine take_error(structure, scene, field, difference, error)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The difference
      type(difference_type), intent(in) :: difference
      !> The error
      type(mesh_error_type), intent(out) :: error

      call new_mesh_error(difference, error)
      associate (equations => structure%equations)
         error%known = equations%team%all_of(error%known .and. .not. any(equations%systems%failed))
      end associate
      call leave_out_idle(structure, scene, field, error)
   end subroutine take_error

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

   !> Differences of all modes while the stress of the joints is held. Factors are read, and those of blocks formed, once for all
   !> states. Within a region of threads each system is a task of its own, for whoever has nothing else to do
   subroutine find_differences(structure, points, states, held)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Joint points with excess stress
      type(model_joint_point_type), intent(in) :: points(:)
      !> The states
      type(judged_state_type), intent(in) :: states(:)
      !> The same with their excess stress; take the differences
      type(held_state_type), intent(inout) :: held(:)

      type(workspace_type), allocatable :: spaces(:)
      type(room_type), allocatable :: rooms(:)
      integer :: i, s

      do i = 1, size(states)
         associate (one => held(i), n => size(structure%modes))
            call new_difference(size(states(i)%displacement, 2), size(structure%joint_points), n, one%difference)
            one%load = new_fine_load(structure%fine, structure%modes, states(i)%loading)
            one%steps = steps_of(states(i)%loading, one%excess)
         end associate
      end do
      associate (equations => structure%equations)
         call new_workspaces(equations, spaces)
         allocate (rooms(size(spaces)))
         if (omp_in_parallel()) then
            !$omp taskgroup  ! who waits here takes parts of systems that others are at
            do s = equations%first, equations%last
               !$omp task default(shared) firstprivate(s)
               call find_of_system(s)
               !$omp end task
            end do
            !$omp end taskgroup
         else
            !$omp parallel do schedule(dynamic) num_threads(size(spaces))
            do s = equations%first, equations%last
               call find_of_system(s)
            end do
            !$omp end parallel do
         end if
         do i = 1, size(held)
            call share_difference(equations, held(i)%difference)
         end do
      end associate

   contains

      !> Differences of the modes of a system
      subroutine find_of_system(s)
         !> The system
         integer, intent(in) :: s

         integer :: i
         logical :: again

         associate (equations => structure%equations, modes => structure%equations%systems(s)%modes)
            if (.not. any([(any(held(i)%steps(modes) > 0), i=1, size(held))])) return
            call hold_factor(equations, s, spaces(own()))
            again = .false.
            do i = 1, size(held)
               if (equations%systems(s)%failed) exit
               if (all(held(i)%steps(modes) == 0)) cycle
               call find_difference(structure%fine, equations, s, held(i)%load, states(i)%displacement, points, held(i)%excess, &
                  rooms(own()), held(i)%difference, held(i)%steps, again)
               again = all(held(i)%difference%known(modes))
            end do
            call release_factor(equations, s, spaces(own()))
         end associate
      end subroutine find_of_system

   end subroutine find_differences

   !> Steps to go in each mode: few where nothing acts in it but little excess stress, for its part in the error is as small.
   !> All harmonics in which none is gone had 5 % of the jumps' errors in a pile of M = 8
   pure function steps_of(loading, excess) result(steps)
      !> The loads
      type(loading_type), intent(in) :: loading
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
         if (any(abs(loading%right(:, :, k)) > 0.0_wp)) cycle
         if (maxval(abs(excess(:, :, k))) <= less*largest) steps(k) = 1
         if (maxval(abs(excess(:, :, k))) <= little*largest) steps(k) = 0
      end do
   end function steps_of

end module axijoint_analysis_error_held_error
