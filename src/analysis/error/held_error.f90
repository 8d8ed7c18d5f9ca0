!> What the mesh leaves of the error of a job whose joints yield while the stress of these is held
module axijoint_analysis_error_held_error
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_cuts, only : n_with_resultants
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_fine_conditions, only : held_part
   use axijoint_analysis_fine_difference, only : difference_type, room_type, most_steps, new_difference, find_difference, &
      share_difference
   use axijoint_analysis_fine_joints, only : fine_excess
   use axijoint_analysis_fine_level, only : fine_load_type, new_fine_load
   use axijoint_analysis_fine_mesh, only : restrict
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type, new_mesh_error, error_over_difference
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, release_factor
   use axijoint_assembly_force, only : joint_jump, joint_force
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, idle_part
   use axijoint_joints_scene, only : scene_type
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: judged_state_type, held_errors_type, error_of_held, begin_by_law, find_of_system, find_of_systems, end_by_law

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

   !> Errors of states under way: `begin_by_law`, `find_of_system` for each system in any order, by any thread, `end_by_law`
   type :: held_errors_type
      private
      !> The states, and the same on the fine level
      type(judged_state_type), allocatable :: states(:)
      type(held_state_type), allocatable :: held(:)
      !> Joint points with excess stress
      type(model_joint_point_type), allocatable :: points(:)
      !> Memory of each thread
      type(workspace_type), allocatable :: spaces(:)
      type(room_type), allocatable :: rooms(:)
      !> When they were begun [second]
      real(wp) :: began = 0.0_wp
   end type held_errors_type

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

      type(held_errors_type) :: under_way

      under_way%began = omp_get_wtime()
      under_way%states = [state]
      allocate (under_way%held(1))
      under_way%held(1)%excess = state%field%excess
      under_way%points = structure%fine%coarse_points(structure%yielding)
      call begin(structure, under_way)
      call find_of_systems(structure, under_way)
      call share_difference(structure%equations, under_way%held(1)%difference)
      call take_error(structure, scene, state%field, under_way%held(1)%difference, error)
      error%seconds = omp_get_wtime() - under_way%began
   end subroutine error_of_held

   !> Begin errors of states while it is what the law gives along the fine joints
   subroutine begin_by_law(structure, scene, states, under_way)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> The states
      type(judged_state_type), intent(in) :: states(:)
      !> The errors
      type(held_errors_type), intent(out) :: under_way

      integer :: i

      under_way%began = omp_get_wtime()
      allocate (under_way%states, source=states)
      allocate (under_way%held(size(states)))
      do i = 1, size(states)
         associate (state => states(i))
            call fine_excess(structure%condensed, scene, structure%fine, state%field, state%displacement, &
               state%loading%case_factor, under_way%points, under_way%held(i)%excess)
         end associate
      end do
      call begin(structure, under_way)
   end subroutine begin_by_law

   !> End them, all systems being found
   subroutine end_by_law(structure, scene, under_way, errors)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> What was found
      type(held_errors_type), intent(inout) :: under_way
      !> The errors, one a state; the last has the time since they were begun
      type(mesh_error_type), allocatable, intent(out) :: errors(:)

      integer :: i

      allocate (errors(size(under_way%held)))
      do i = 1, size(errors)
         associate (difference => under_way%held(i)%difference)
            call share_difference(structure%equations, difference)
            call take_error(structure, scene, under_way%states(i)%field, difference, errors(i))
            call add_integrated(structure, under_way%points, under_way%held(i)%excess, under_way%states(i)%field%excess, errors(i))
         end associate
      end do
      deallocate (under_way%spaces, under_way%rooms)
      errors(size(errors))%seconds = omp_get_wtime() - under_way%began
   end subroutine end_by_law

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

   !> Add to the forces on nodes what the excess stress along fine joints gives more than that of the coarse ones. The reactions of
   !> nodes that are held have theirs
   subroutine add_integrated(structure, points, fine, coarse, error)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Points of fine joints with excess stress
      type(model_joint_point_type), intent(in) :: points(:)
      !> Excess stress there and at the points of the coarse joints, amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: fine(:, :, :), coarse(:, :, :)
      !> Takes the forces, if they are asked for
      type(mesh_error_type), intent(inout) :: error

      real(wp), allocatable :: force(:, :), by_node(:, :), shared(:, :)
      integer :: k, node

      if (.not. allocated(error%acting)) return
      allocate (shared(3, size(error%acting, 2)))
      do k = 1, size(error%acting, 3)
         associate (m => structure%modes(k)%harmonic, equations => structure%equations)
            by_node = joint_force(points, m, fine(:, :, k), size(structure%fine%stiffness%place))
            force = by_node
            force(:, structure%fine%stiffness%place) = by_node
            call restrict(structure%fine%parents, force, shared)
            shared = shared - joint_force(structure%condensed%points, m, coarse(:, :, k), size(shared, 2))
            associate (conditions => structure%fine%conditions(equations%systems(equations%system(k))%class))
               do node = 1, size(shared, 2)
                  shared(:, node) = shared(:, node) - held_part(conditions, structure%fine%stiffness%place(node), shared(:, node))
               end do
            end associate
            error%acting(:, :, k) = error%acting(:, :, k) + error_over_difference*shared
         end associate
      end do
   end subroutine add_integrated

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

   !> Begin, the excess stress being known
   subroutine begin(structure, under_way)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> The states with their excess stress; takes the rest
      type(held_errors_type), intent(inout) :: under_way

      integer :: i

      do i = 1, size(under_way%held)
         associate (held => under_way%held(i), state => under_way%states(i))
            call new_difference(size(state%displacement, 2), size(structure%joint_points), &
               size(structure%fine%near_lines), size(structure%modes), n_with_resultants(structure), held%difference)
            held%load = new_fine_load(structure%fine, structure%modes, state%loading)
            held%steps = steps_of(state%loading, held%excess)
         end associate
      end do
      call new_workspaces(structure%equations, under_way%spaces)
      allocate (under_way%rooms(size(under_way%spaces)))
   end subroutine begin

   !> Differences of all modes, a system a thread
   subroutine find_of_systems(structure, under_way)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What is found
      type(held_errors_type), intent(inout) :: under_way

      integer :: s

      !$omp parallel do schedule(dynamic) num_threads(size(under_way%spaces))
      do s = structure%equations%first, structure%equations%last
         call find_of_system(structure, s, under_way)
      end do
      !$omp end parallel do
   end subroutine find_of_systems

   !> Differences of the modes of a system while the stress of the joints is held. Its factor is read, and those of blocks are formed,
   !> once for all states
   subroutine find_of_system(structure, s, under_way)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> The system
      integer, intent(in) :: s
      !> What is found
      type(held_errors_type), intent(inout) :: under_way

      integer :: i
      logical :: again

      associate (equations => structure%equations, modes => structure%equations%systems(s)%modes, held => under_way%held, &
                 space => under_way%spaces(own()), room => under_way%rooms(own()))
         if (.not. any([(any(held(i)%steps(modes) > 0), i=1, size(held))])) return
         call hold_factor(equations, s, space)
         again = .false.
         do i = 1, size(held)
            if (equations%systems(s)%failed) exit
            if (all(held(i)%steps(modes) == 0)) cycle
            call find_difference(structure%fine, equations, s, held(i)%load, under_way%states(i)%displacement, under_way%points, &
               held(i)%excess, room, held(i)%difference, held(i)%steps, again)
            again = all(held(i)%difference%known(modes))
         end do
         call release_factor(equations, s, space)
      end associate
   end subroutine find_of_system

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
