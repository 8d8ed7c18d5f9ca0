!> Errors of joint stresses that follow from errors of the displacements of nodes
module axijoint_analysis_joint_error
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_interpolation_error, only : interpolation_type, new_interpolation
   use axijoint_analysis_joint_quadrature, only : missed_stress
   use axijoint_analysis_patch_recovery, only : patches_type, new_patches, new_samplings
   use axijoint_assembly_equations, only : solve_mode
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, release_factor
   use axijoint_assembly_force, only : joint_force, joint_jump, elastic_joint_stress
   use axijoint_base_kinds, only : wp
   use axijoint_joints_balance, only : verdict_type, balance_step
   use axijoint_joints_field, only : joint_field_type, iteration_type, new_joint_field, set_initial_stress
   use axijoint_joints_increments, only : history_type
   use axijoint_joints_newton, only : newton_type, new_newton, newton_step
   use axijoint_joints_planes, only : planes_type, synthesize
   use axijoint_joints_response, only : jumps
   use axijoint_joints_scene, only : scene_type, evaluate
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, element_references, method_newton, method_transfer
   implicit none
   private
   public :: nodal_error_type, new_nodal_error, elastic_joint_error, answer_of_joints

   !> What may be missing to a state, squared, over what the changed jumps make miss; most steps
   !> of Newton's method towards it, and the tolerance of their linear solutions
   real(wp), parameter :: goal_share = 1.0e-4_wp
   integer, parameter :: most_steps = 8
   real(wp), parameter :: linear_tolerance = 1.0e-2_wp
   !> The paper's loop: tolerance of the state by Newton's method, and most iterations
   real(wp), parameter :: strict = 1.0e-10_wp
   integer, parameter :: most_iterations = 40

   !> Errors of the displacements of nodes, and of joint stresses from these
   type :: nodal_error_type
      !> What elements cannot interpolate
      type(interpolation_type) :: interpolation
      !> Errors of displacement amplitudes, shape (3, nodes, modes)
      real(wp), allocatable :: displacement(:, :, :)
      !> Largest error of a joint stress; negative if not known [stress]
      real(wp) :: joint_stress = -1.0_wp
      !> Time that they took so far [second]
      real(wp) :: seconds = 0.0_wp
   end type nodal_error_type

contains

   !> Make ready what the solutions need
   subroutine new_nodal_error(model, n_modes, nodal)
      !> The job
      type(model_type), intent(in) :: model
      !> Number of modes
      integer, intent(in) :: n_modes
      !> Takes it
      type(nodal_error_type), intent(out) :: nodal

      type(patches_type) :: patches
      real(wp) :: start

      start = omp_get_wtime()
      call new_patches(model%mesh, new_samplings(element_references(model)), patches)
      call new_interpolation(model, patches, nodal%interpolation)
      allocate (nodal%displacement(3, n_nodes(model%mesh), n_modes), source=0.0_wp)
      nodal%seconds = omp_get_wtime() - start
   end subroutine new_nodal_error

   !> Largest change of an elastic joint stress by changes of displacements
   function elastic_joint_error(points, planes, change) result(largest)
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Planes
      type(planes_type), intent(in) :: planes
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: change(:, :, :)
      !> The change [stress]
      real(wp) :: largest

      real(wp), allocatable :: jump(:, :, :)
      integer :: j, k

      allocate (jump(3, size(points), size(change, 3)))
      do k = 1, size(change, 3)
         jump(:, :, k) = joint_jump(points, change(:, :, k))
      end do
      jump = synthesize(planes, jump)
      largest = 0.0_wp
      do j = 1, size(jump, 3)
         largest = max(largest, maxval(abs(elastic_joint_stress(points, jump(:, :, j)))))
      end do
   end function elastic_joint_error

   !> The answer of joints that yield to a change of displacements at fixed stress of theirs:
   !> the state that they find under the changed jumps, and with what their rule misses. Changes the displacements with it.
   !> Negative if a state is not found, or the paper's loop went on over several increments
   subroutine answer_of_joints(scene, history, field, change, largest)
      !> Joint points that can yield; the jumps from the loads are in its response
      type(scene_type), intent(inout) :: scene
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of these joints
      type(joint_field_type), intent(in) :: field
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(inout) :: change(:, :, :)
      !> Largest change of their stress
      real(wp), intent(out) :: largest

      type(joint_field_type), allocatable :: before, after
      real(wp), allocatable :: free(:, :, :), changed(:, :, :), missed(:, :, :)
      real(wp) :: goal
      logical :: found, moved
      integer :: k, method

      largest = -1.0_wp
      if (.not. history%verdict%converged) return
      method = scene%method
      if (method == method_transfer .and. size(scene%model%increments) > 1) return
      scene%method = method_newton
      allocate (before, source=field)
      found = .true.
      if (method == method_transfer) call start_again(scene, history, before, found)
      if (found) then
         before%carried = before%stress
         allocate (after, source=before)
         allocate (free, source=scene%response%free)
         goal = huge(goal)
         before%share = 1.0_wp
         missed = missed_stress(scene, before)
         scene%response%free = free - jumps(scene%response, missed, free=.false.)
         do k = 1, size(change, 3)
            scene%response%free(:, :, k) = scene%response%free(:, :, k) &
               + joint_jump(scene%points, change(:, :, k))
         end do
         call find_state(scene, goal, after, found)
         call move_alloc(scene%response%free, changed)
         scene%response%free = free
         if (found) call find_state(scene, goal, before, found, moved)
         if (found .and. moved) then  ! it was not balanced as well
            after = before
            scene%response%free = changed
            call find_state(scene, goal, after, found)
            scene%response%free = free
         end if
      end if
      scene%method = method
      if (.not. found) return
      largest = maxval(abs(after%stress - before%stress))
      call add_excess(scene, after%excess - before%excess - missed, change)
   end subroutine answer_of_joints

   !> The state by Newton's method, from nothing: the paper's loop keeps no slip to go on from
   subroutine start_again(scene, history, field, found)
      !> The scene
      type(scene_type), intent(inout) :: scene
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Takes the state of the joints
      type(joint_field_type), intent(out) :: field
      !> Whether it was found
      logical, intent(out) :: found

      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict

      field = new_joint_field(size(scene%points), size(scene%planes%angle), size(scene%equations%modes), &
                              size(scene%floating))
      call set_initial_stress(scene%model, scene%points, history%loading%case_factor, field)
      allocate (path(0))
      call balance_step(scene, strict, most_iterations, iteration_type(), field, path, verdict)
      found = verdict%converged .or. verdict%at_rounding
   end subroutine start_again

   !> Bring the joints to equilibrium by Newton's method
   subroutine find_state(scene, goal, field, found, moved)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> What may be missing, squared; the largest number only sets it, in proportion to what is
      !> missing at first
      real(wp), intent(inout) :: goal
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Whether it was found
      logical, intent(out) :: found
      !> Whether steps were made
      logical, intent(out), optional :: moved

      type(newton_type) :: newton
      real(wp), allocatable :: residual(:, :, :)
      logical :: made
      integer :: k

      field%share = 1.0_wp
      allocate (residual, mold=field%excess)
      call evaluate(scene, field, residual)
      newton = new_newton(scene, field)
      if (goal >= huge(goal)) goal = max(goal_share*newton%merit, rounding(scene, field))
      made = .true.
      do k = 1, most_steps
         if (newton%merit <= goal .or. .not. made) exit
         call newton_step(scene, 0.0_wp, linear_tolerance, huge(1.0_wp), newton, field, residual, made)
      end do
      found = newton%merit <= goal
      if (present(moved)) moved = k > 1
   end subroutine find_state

   !> What rounding may leave missing, squared
   pure real(wp) function rounding(scene, field)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field

      integer :: k

      rounding = 0.0_wp
      do k = 1, size(scene%points)
         rounding = rounding + strict**2*scene%points(k)%weight*sum(field%stress(:, k, :)**2)/size(field%stress, 3)
      end do
   end function rounding

   !> Add the displacements from excess joint stress
   subroutine add_excess(scene, excess, change)
      !> The scene
      type(scene_type), intent(inout) :: scene
      !> Amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: excess(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(inout) :: change(:, :, :)

      type(workspace_type), allocatable :: spaces(:)
      real(wp), allocatable :: part(:, :), force(:, :)  ! threads have small stacks
      integer :: s, i, k

      call new_workspaces(scene%equations, spaces)
      !$omp parallel do schedule(dynamic) private(i, k, part, force) num_threads(size(spaces))
      do s = 1, size(scene%equations%systems)
         call hold_factor(scene%equations, s, spaces(own()))
         if (scene%equations%systems(s)%failed) cycle
         do i = 1, size(scene%equations%systems(s)%modes)
            k = scene%equations%systems(s)%modes(i)
            force = joint_force(scene%points, scene%equations%modes(k)%harmonic, excess(:, :, k), &
                                size(change, 2))
            part = force  ! for its shape
            call solve_mode(scene%equations, k, force, part)
            change(:, :, k) = change(:, :, k) + part
         end do
         call release_factor(scene%equations, s, spaces(own()))
      end do
      !$omp end parallel do
   end subroutine add_excess

end module axijoint_analysis_joint_error
