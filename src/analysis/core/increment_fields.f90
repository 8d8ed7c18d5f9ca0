!> Fields of the joints and, found again, those at the ends of earlier increments
module axijoint_analysis_core_increment_fields
   use axijoint_analysis_core_nodal_stress, only : smooth_stress
   use axijoint_analysis_core_results, only : results_type, mode_solve_type
   use axijoint_analysis_core_solution, only : solve_displacements
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_equations, only : worth_threads
   use axijoint_assembly_force, only : joint_jump, elastic_joint_stress
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_assembly_solid_force, only : solid_force
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type, new_joint_field, set_initial_stress
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_planes, only : planes_type, synthesize
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: elastic_field, solve_increment, view_joints

contains

   !> State of all joints, as if none yielded
   subroutine elastic_field(model, structure, planes, case_factor, displacement, field)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> Planes
      type(planes_type), intent(in) :: planes
      !> Factors of the load cases, for the in-situ stress
      real(wp), intent(in) :: case_factor(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(out) :: field

      real(wp), allocatable :: jump(:, :, :)
      integer :: j, k

      associate (points => structure%joint_points)
         field = new_joint_field(size(points), size(planes%angle), size(displacement, 3), 0)
         call set_initial_stress(model, points, case_factor, field)
         allocate (jump(3, size(points), size(displacement, 3)))
         do k = 1, size(displacement, 3)
            jump(:, :, k) = joint_jump(points, displacement(:, :, k))
         end do
         field%jump = synthesize(planes, jump)
         do j = 1, size(planes%angle)
            field%stress(:, :, j) = elastic_joint_stress(points, field%jump(:, :, j)) + &
               field%initial
         end do
      end associate
   end subroutine elastic_field

   !> Find the displacements of an increment again, and the stresses at the nodes: one
   !> solution a mode
   subroutine solve_increment(model, structure, state, final, results, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure; its factors are made again where they are not kept
      type(structure_type), intent(inout) :: structure
      !> What was kept of the increment
      type(increment_state_type), intent(in) :: state
      !> Results at the end of the run, for their extents
      type(results_type), intent(in) :: final
      !> Modes, displacements and stresses of the increment; nothing else
      type(results_type), intent(out) :: results
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(loading_type) :: loading
      type(mode_solve_type), allocatable :: solves(:)
      real(wp), allocatable :: force(:, :)
      integer :: k

      results%modes = final%modes
      allocate (results%displacement, mold=final%displacement)
      allocate (results%stress, mold=final%stress)
      call new_loading(model, structure%joint_points, structure%support_points, structure%modes, &
                       combination_type(0, state%case_factor), loading)
      ! where no joint yields there is no excess stress
      call solve_displacements(structure, model, loading, results%displacement, solves, error, &
         state%excess)
      if (allocated(error)) return
      !$omp parallel do schedule(dynamic) private(force) if (worth_threads(structure%equations))
      do k = 1, size(results%modes)
         allocate (force, mold=results%displacement(:, :, k))
         call solid_force(model, loading%initial, k, results%modes(k), &
                          results%displacement(:, :, k), force, results%stress(:, :, k))
         deallocate (force)
      end do
      !$omp end parallel do
      call smooth_stress(model, results)
      if (allocated(state%offset)) &
         call add_motions(structure%condensed%floating, state%offset, results%displacement)
   end subroutine solve_increment

   !> Relative displacements, stresses and states of all joints on planes: those of
   !> the joint law where joints can yield, else any
   subroutine view_joints(model, structure, state, planes, displacement, field)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> What was kept of the increment
      type(increment_state_type), intent(in) :: state
      !> Planes
      type(planes_type), intent(in) :: planes
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> State of all joints
      type(joint_field_type), intent(out) :: field

      call elastic_field(model, structure, planes, state%case_factor, displacement, field)
      if (.not. allocated(state%jump)) return
      field%jump(:, structure%yielding, :) = state%jump
      field%stress(:, structure%yielding, :) = state%stress
      field%state(structure%yielding, :) = state%state
   end subroutine view_joints

end module axijoint_analysis_core_increment_fields
