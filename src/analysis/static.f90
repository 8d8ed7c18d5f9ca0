!> Static analysis of a structure under its loads, told in order
module axijoint_analysis_static
   use axijoint_analysis_cuts, only : cut_resultants
   use axijoint_analysis_nodal_stress, only : smooth_stress
   use axijoint_analysis_recovery, only : recover
   use axijoint_analysis_results, only : results_type, remark_type
   use axijoint_analysis_structure, only : structure_type, build_structure
   use axijoint_assembly_equations, only : equations_type, solve_mode, refine_mode, &
                                           backward_error, condition_estimate, worth_threads
   use axijoint_assembly_force, only : joint_force, joint_jump
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type, phase_assemble, phase_joints, phase_recover
   use axijoint_joints_field, only : joint_field_type, new_joint_field, elastic_stress, n_across_gaps
   use axijoint_joints_planes, only : planes_type, new_planes, new_view, synthesize
   use axijoint_joints_transfer, only : transfer_loop
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type, can_yield
   implicit none
   private
   public :: analyse_model, analyse_combination

   !> Largest residual-force ratio of a linear job, whose residual is rounding: the default tolerance
   !> of an increment. Of a ring with nu = 0.499999, whose large mean stresses cancel, it is 2e-8
   real(wp), parameter :: linear_tolerance = 1.0e-6_wp
   !> Tolerances above this deserve a word
   real(wp), parameter :: coarse_tolerance = 1.0e-3_wp

contains

   !> Solve a job of one combination of load cases
   subroutine analyse_model(model, results, timer, progress, error)
      !> The job; its first combination is solved
      type(model_type), intent(in) :: model
      !> What was found
      type(results_type), intent(out) :: results
      !> Times of the phases
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      type(structure_type) :: structure

      call build_structure(model, structure, timer, progress, error)
      if (allocated(error)) return
      call analyse_combination(model, structure, model%combinations(1), results, timer, progress)
   end subroutine analyse_model

   !> Solve one combination of load cases: displacements and joints, recovery
   subroutine analyse_combination(model, structure, combination, results, timer, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, factored
      type(structure_type), intent(in) :: structure
      !> The combination
      type(combination_type), intent(in) :: combination
      !> What was found
      type(results_type), intent(out) :: results
      !> Times of the phases
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(loading_type) :: loading
      type(joint_field_type) :: field
      real(wp) :: factor, largest_factor

      results%modes = structure%modes
      results%orderings = structure%orderings
      call timer%push(phase_assemble)
      call new_loading(model, structure%joint_points, structure%support_points, structure%modes, &
                       combination, loading)
      call timer%pop()
      call timer%push(phase_joints)
      call solve(model, structure, loading, field, results, progress)
      call timer%pop()

      call timer%push(phase_recover)
      call report_load_factors(model, results, factor, largest_factor)
      call recover(model, structure, loading, factor, largest_factor, field, results)
      call smooth_stress(model, results)
      call cut_resultants(model, structure, loading, combination, factor, field, results)
      call report_solves(structure, factor*loading%right, field, results)
      results%converged = results%converged .and. results%residual_ratio <= results%tolerance
      results%remarks = remarks_on(model, field, results)
      call timer%pop()
   end subroutine analyse_combination

   !> Load factor that the run ended with, and the largest on its way
   pure subroutine report_load_factors(model, results, factor, largest)
      !> The job
      type(model_type), intent(in) :: model
      !> Results with their convergence path
      type(results_type), intent(in) :: results
      !> The factors
      real(wp), intent(out) :: factor, largest

      if (size(results%path) > 0) then
         factor = results%path(size(results%path))%load_factor
         largest = maxval(abs(results%path%load_factor))
      else
         factor = sum(model%increments%factor)
         largest = abs(factor)
      end if
   end subroutine report_load_factors

   !> What the user should know about the results
   function remarks_on(model, field, results) result(remarks)
      !> The job
      type(model_type), intent(in) :: model
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences
      type(remark_type), allocatable :: remarks(:)

      real(wp) :: widest
      integer :: n

      allocate (remarks(0))
      if (size(results%path) == 0) then
         if (.not. results%converged) then
            call add('the equations are ill-conditioned (condition number '// &
                     to_text(maxval(results%solves%condition))//', residual '// &
                     to_text(results%residual_ratio)//'): stiffnesses out of all proportion?')
         end if
         return
      end if
      call n_across_gaps(field, n, widest)
      if (n > 0) call add('pressure across an open gap at '//to_text(n)//' joint points on planes '// &
                          '(widest '//to_text(widest)//'): stress accumulated, as in the paper')
      if (results%tolerance > coarse_tolerance) then
         call add('a tolerance of '//to_text(results%tolerance)// &
                  ' leaves joint stresses several per cent wrong (default 1E-6)')
      end if
      if (results%part_error > max(results%tolerance, coarse_tolerance)) then
         call add('forces of '//to_text(results%part_error)//' of the load are not balanced on '// &
                  'some part: see EQUILIBRIUM')
      end if
      if (model%max_harmonic + 1 == model%n_planes) then
         call add('w of the highest harmonic vanishes on all planes: nothing of it is '// &
                  'transferred (M + 2 planes avoid that)')
      end if

   contains

      !> Add a sentence
      subroutine add(text)
         !> The sentence; fits a line of the listing
         character(len=*), intent(in) :: text

         remarks = [remarks, remark_type(text)]
      end subroutine add

   end function remarks_on

   !> Displacements and joint state: at once if no joint can yield, else by the
   !> paper's loop
   subroutine solve(model, structure, loading, field, results, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, factored
      type(structure_type), intent(in) :: structure
      !> Loads for a factor of one
      type(loading_type), intent(in) :: loading
      !> State of the joints
      type(joint_field_type), intent(out) :: field
      !> Results that take displacements, joint results and convergence path
      type(results_type), intent(inout) :: results
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(planes_type) :: planes
      integer :: k

      allocate (results%displacement, mold=loading%right)
      associate (points => structure%joint_points)
         if (can_yield(model)) then
            results%tolerance = model%increments(size(model%increments))%tolerance
            planes = new_planes(model%n_planes, structure%modes)
            call transfer_loop(model, points, structure%equations, planes, loading, &
                               results%displacement, field, results%path, results%converged, progress)
         else
            planes = new_view(model%output_angles, structure%modes)
            allocate (results%path(0))
            call solve_linear(structure%equations, sum(model%increments%factor), loading, &
                              results%displacement)
            results%converged = .true.  ! if the residual says so, too
            results%tolerance = linear_tolerance
            call elastic_field(model, points, planes, results%displacement, field)
         end if
         results%joint_point_joint = points%joint
         allocate (results%joint_point_position(2, size(points)))
         do k = 1, size(points)
            results%joint_point_position(:, k) = points(k)%position
         end do
      end associate
      results%plane_angles = planes%angle
      results%joint_jump = field%jump
      results%joint_stress = field%stress
      results%joint_state = field%state
   end subroutine solve

   !> Displacements of a linear job, a step of refinement in them
   subroutine solve_linear(equations, factor, loading, displacement)
      !> Equations of all modes, factored
      type(equations_type), intent(in) :: equations
      !> Load factor, and loads for a factor of one
      real(wp), intent(in) :: factor
      type(loading_type), intent(in) :: loading
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(out) :: displacement(:, :, :)

      integer :: s, i, k

      !$omp parallel do schedule(dynamic) private(i, k) if (worth_threads(equations))
      do s = 1, size(equations%systems)
         do i = 1, size(equations%systems(s)%modes)
            k = equations%systems(s)%modes(i)
            call solve_mode(equations, k, factor*loading%right(:, :, k), displacement(:, :, k))
            call refine_mode(equations, k, factor*loading%right(:, :, k), displacement(:, :, k))
         end do
      end do
      !$omp end parallel do
      if (allocated(loading%held)) displacement = displacement + factor*loading%held
   end subroutine solve_linear

   !> Joints of a linear job
   subroutine elastic_field(model, points, planes, displacement, field)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Planes to look at
      type(planes_type), intent(in) :: planes
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(out) :: field

      real(wp) :: jump(3, size(points), size(displacement, 3))
      integer :: k

      field = new_joint_field(size(points), size(planes%angle), size(displacement, 3))
      do k = 1, size(displacement, 3)
         jump(:, :, k) = joint_jump(points, displacement(:, :, k))
      end do
      field%jump = synthesize(planes, jump)
      field%stress = elastic_stress(model, points, field%jump)
   end subroutine elastic_field

   !> How well the equations of each mode are solved: the backward error of one
   !> more solution, for the forces that act at the end
   subroutine report_solves(structure, applied, field, results)
      !> The structure, factored
      type(structure_type), intent(in) :: structure
      !> Forces on the unknowns, shape (3, nodes, modes)
      real(wp), intent(in) :: applied(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Results that take the report
      type(results_type), intent(inout) :: results

      real(wp), allocatable :: force(:, :), displacement(:, :)  ! threads have small stacks
      real(wp) :: condition
      integer :: s, i, k

      associate (equations => structure%equations)
         results%solver = equations%solver
         allocate (results%solves(size(equations%modes)))
         !$omp parallel do schedule(dynamic) private(i, k, condition, force, displacement) &
         !$omp if (worth_threads(equations))
         do s = 1, size(equations%systems)
            condition = condition_estimate(equations, s)
            do i = 1, size(equations%systems(s)%modes)
               k = equations%systems(s)%modes(i)
               force = applied(:, :, k) + joint_force(structure%joint_points, &
                  equations%modes(k)%harmonic, field%excess(:, :, k), size(applied, 2))
               displacement = force  ! for its shape
               call solve_mode(equations, k, force, displacement)
               call refine_mode(equations, k, force, displacement)
               associate (report => results%solves(k), system => equations%systems(s))
                  report%mode = equations%modes(k)
                  report%n_equations = equations%classes(system%class)%dofs%n_equations
                  report%factor_entries = equations%plans(system%class)%solver%factor_entries
                  report%condition = condition
                  report%smallest_pivot = system%pivots%smallest
                  report%backward_error = backward_error(equations, k, force, displacement)
               end associate
            end do
         end do
         !$omp end parallel do
      end associate
   end subroutine report_solves

end module axijoint_analysis_static
