!> Displacements of the whole body, harmonic by harmonic
module axijoint_analysis_core_solution
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_results, only : mode_solve_type
   use axijoint_analysis_fine_difference, only : difference_type, find_difference
   use axijoint_analysis_fine_level, only : fine_level_type, fine_load_type
   use axijoint_assembly_equations, only : equations_type, solve_mode, refine_mode, &
                                           backward_error, condition_estimate
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, &
                                         release_factor, report_failure
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: solve_displacements

contains

   !> Displacements under loads and excess joint stress, a step of refinement in them. A factor
   !> that is not kept is made, used for all that needs it, and given up.
   subroutine solve_displacements(equations, model, loading, points, excess, displacement, solves, &
                                  factor_share, error, level, load, difference)
      !> Equations of all modes, assembled
      type(equations_type), intent(inout) :: equations
      !> The job, for the words of an error
      type(model_type), intent(in) :: model
      !> The loads
      type(loading_type), intent(in) :: loading
      !> Joint points with excess stress, and its amplitudes, shape (3, points, modes)
      type(model_joint_point_type), intent(in) :: points(:)
      real(wp), intent(in) :: excess(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(out) :: displacement(:, :, :)
      !> How well each mode was solved
      type(mode_solve_type), allocatable, intent(out) :: solves(:)
      !> Share of the time that went into factorizations
      real(wp), intent(out) :: factor_share
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error
      !> The fine level and its loads, which take the differences to the solution there: of linear jobs
      type(fine_level_type), intent(in), optional :: level
      type(fine_load_type), intent(in), optional :: load
      type(difference_type), intent(inout), optional :: difference

      type(workspace_type), allocatable :: spaces(:)
      real(wp), allocatable :: force(:, :)  ! threads have small stacks
      real(wp) :: times(4, size(equations%systems))
      real(wp) :: before_errors
      integer :: s, i, k

      allocate (solves(size(equations%modes)))
      call new_workspaces(equations, spaces)
      times = 0.0_wp
      !$omp parallel do schedule(dynamic) private(i, k, force, before_errors) num_threads(size(spaces))
      do s = 1, size(equations%systems)
         times(1, s) = omp_get_wtime()
         call hold_factor(equations, s, spaces(own()))
         times(2, s) = omp_get_wtime()
         if (.not. equations%systems(s)%failed) then
            associate (modes => equations%systems(s)%modes)
               solves(modes)%condition = condition_estimate(equations, s)
               do i = 1, size(modes)
                  k = modes(i)
                  force = loading%right(:, :, k) + joint_force(points, equations%modes(k)%harmonic, &
                                                               excess(:, :, k), size(displacement, 2))
                  call solve_mode(equations, k, force, displacement(:, :, k))
                  call refine_mode(equations, k, force, displacement(:, :, k), solves(k)%correction)
                  call report_solve(equations, k, force, displacement(:, :, k), solves(k))
                  if (allocated(loading%held)) then
                     displacement(:, :, k) = displacement(:, :, k) + loading%held(:, :, k)
                  end if
               end do
               before_errors = omp_get_wtime()
               if (present(difference)) then
                  call find_difference(level, equations, s, load, displacement, points, excess, difference)
               end if
               times(3, s) = omp_get_wtime() - before_errors
            end associate
            call release_factor(equations, s, spaces(own()))
         end if
         times(4, s) = omp_get_wtime()
      end do
      !$omp end parallel do
      factor_share = sum(times(2, :) - times(1, :))/max(tiny(1.0_wp), sum(times(4, :) - times(1, :)))
      if (present(difference)) difference%seconds = sum(times(3, :))/size(spaces)
      call report_failure(equations, model, error)
   end subroutine solve_displacements

   !> How well the equations of one mode are solved
   subroutine report_solve(equations, k, force, displacement, report)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> The report; its condition number is there
      type(mode_solve_type), intent(inout) :: report

      associate (system => equations%systems(equations%system(k)))
         report%mode = equations%modes(k)
         report%n_equations = equations%classes(system%class)%dofs%n_equations
         report%factor_entries = equations%plans(system%class)%solver%factor_entries
         report%smallest_pivot = system%pivots%smallest
         report%backward_error = backward_error(equations, k, force, displacement)
      end associate
   end subroutine report_solve

end module axijoint_analysis_core_solution
