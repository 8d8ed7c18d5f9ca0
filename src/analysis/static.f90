!> One static analysis, told in order
module axijoint_analysis_static
   use axijoint_analysis_recovery, only : recover
   use axijoint_analysis_results, only : results_type, ordering_type, remark_type
   use axijoint_assembly_equations, only : equations_type, plan_equations, assemble_equations, &
                                           factorize_equations, solve_harmonic, backward_error, &
                                           refine_harmonic, condition_estimate, &
                                           worth_threads
   use axijoint_assembly_force, only : applied_force, joint_force, joint_jump
   use axijoint_assembly_mechanism, only : check_mechanism
   use axijoint_assembly_pattern, only : node_graph
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_memory, only : require_memory
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type, phase_assemble, phase_factor, phase_joints, &
                                   phase_recover
   use axijoint_joints_field, only : joint_field_type, new_joint_field, elastic_stress, n_across_gaps
   use axijoint_joints_planes, only : planes_type, new_planes, new_view, synthesize
   use axijoint_joints_transfer, only : transfer_loop
   use axijoint_model_joint_points, only : model_joint_point_type, new_joint_points
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, can_yield
   use axijoint_order_graph, only : bandwidth, profile
   use axijoint_solver_choice, only : orders_type, new_orders
   implicit none
   private
   public :: analyse_model, used_harmonics

   !> Largest residual-force ratio of a linear job
   real(wp), parameter :: linear_tolerance = 1.0e-8_wp
   !> Tolerances above this deserve a word
   real(wp), parameter :: coarse_tolerance = 1.0e-3_wp

contains

   !> Solve a job: equations of all harmonics, joints, recovery
   subroutine analyse_model(model, results, timer, progress, error)
      !> The job
      type(model_type), intent(in) :: model
      !> What was found
      type(results_type), intent(out) :: results
      !> Times of the phases
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      type(model_joint_point_type), allocatable :: points(:)
      type(equations_type), allocatable :: equations
      type(joint_field_type) :: field
      type(orders_type) :: orders
      real(wp), allocatable :: load(:, :, :)
      real(wp) :: factor, largest_factor
      integer :: k

      call timer%push(phase_assemble)
      points = new_joint_points(model)
      results%harmonics = used_harmonics(model)
      call require_memory(0_i8, 'the solvers', error)
      if (allocated(error)) return
      call check_mechanism(model, points, results%harmonics, error)
      if (allocated(error)) return
      call show_progress(progress, 'assembling '//to_text(size(results%harmonics))//' harmonics')
      call new_orders(orders, node_graph(model%mesh), error)
      if (allocated(error)) return
      results%orderings = compare_orders(orders)
      call plan_equations(equations, model, results%harmonics, orders, error)
      if (allocated(error)) return
      call assemble_equations(equations, model, points, error)
      allocate (load(3, n_nodes(model%mesh), size(results%harmonics)))
      do k = 1, size(results%harmonics)
         load(:, :, k) = applied_force(model, results%harmonics(k))
      end do
      call timer%pop()
      if (allocated(error)) return

      call timer%push(phase_factor)
      call show_progress(progress, 'factoring '//to_text(size(results%harmonics))//' harmonics')
      call factorize_equations(equations, model, error)
      call timer%pop()
      if (allocated(error)) return

      call timer%push(phase_joints)
      call solve(model, points, equations, load, field, results, progress)
      call timer%pop()

      call timer%push(phase_recover)
      call report_load_factors(model, results, factor, largest_factor)
      call recover(model, points, equations, load, factor, largest_factor, field, results)
      call report_solves(points, equations, factor*load, field, results)
      results%converged = results%converged .and. results%residual_ratio <= results%tolerance
      results%remarks = remarks_on(model, field, results)
      call timer%pop()
   end subroutine analyse_model

   !> Bandwidth and profile of the orders side by side
   pure function compare_orders(orders) result(orderings)
      !> The orders
      type(orders_type), intent(in) :: orders
      !> Reverse Cuthill-McKee, Sloan, nested dissection
      type(ordering_type) :: orderings(3)

      associate (graph => orders%graph)
         orderings = [ordering_type('reverse Cuthill-McKee', &
                                    bandwidth(graph, orders%cuthill_mckee), &
                                    profile(graph, orders%cuthill_mckee)), &
                      ordering_type('Sloan', bandwidth(graph, orders%sloan), &
                                    profile(graph, orders%sloan)), &
                      ordering_type('nested dissection', bandwidth(graph, orders%dissection), &
                                    profile(graph, orders%dissection))]
      end associate
   end function compare_orders

   !> Harmonics to solve: only the loaded ones of a linear job; otherwise all up
   !> to M, since opening and slip couple them
   pure function used_harmonics(model) result(harmonics)
      !> The job
      type(model_type), intent(in) :: model
      !> Harmonics m, ascending; at least one
      integer, allocatable :: harmonics(:)

      integer :: m

      harmonics = [(m, m = 0, model%max_harmonic)]
      if (can_yield(model)) return
      harmonics = pack(harmonics, [(any(model%edge_loads%mode%harmonic == m) &
                                    .or. any(model%ring_loads%mode%harmonic == m), &
                                    m = 0, model%max_harmonic)])
      if (size(harmonics) == 0) harmonics = [0]
   end function used_harmonics

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
   subroutine solve(model, points, equations, load, field, results, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Equations of all harmonics, factored
      type(equations_type), intent(in) :: equations
      !> Loads for a factor of one, shape (3, nodes, harmonics)
      real(wp), intent(in) :: load(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(out) :: field
      !> Results that take displacements, joint results and convergence path
      type(results_type), intent(inout) :: results
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(planes_type) :: planes
      real(wp) :: factor
      integer :: k

      allocate (results%displacement, mold=load)
      if (can_yield(model)) then
         results%tolerance = model%increments(size(model%increments))%tolerance
         planes = new_planes(model%n_planes, equations%harmonics)
         call transfer_loop(model, points, equations, planes, load, results%displacement, field, &
                            results%path, results%converged, progress)
      else
         planes = new_view(model%output_angles, equations%harmonics)
         allocate (results%path(0))
         factor = sum(model%increments%factor)
         !$omp parallel do schedule(dynamic) if (worth_threads(equations))
         do k = 1, size(equations%harmonics)
            call solve_harmonic(equations, k, factor*load(:, :, k), results%displacement(:, :, k))
            call refine_harmonic(equations, k, factor*load(:, :, k), results%displacement(:, :, k))
         end do
         !$omp end parallel do
         results%converged = .true.  ! if the residual says so, too
         results%tolerance = linear_tolerance
         call elastic_field(model, points, planes, results%displacement, field)
      end if
      results%plane_angles = planes%angle
      results%joint_point_joint = points%joint
      allocate (results%joint_point_position(2, size(points)))
      do k = 1, size(points)
         results%joint_point_position(:, k) = points(k)%position
      end do
      results%joint_jump = field%jump
      results%joint_stress = field%stress
      results%joint_state = field%state
   end subroutine solve

   !> Joints of a linear job
   subroutine elastic_field(model, points, planes, displacement, field)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Planes to look at
      type(planes_type), intent(in) :: planes
      !> Displacement amplitudes, shape (3, nodes, harmonics)
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

   !> How well the equations of each harmonic are solved: the backward error of
   !> one more solution, for the forces that act at the end
   subroutine report_solves(points, equations, applied, field, results)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Equations of all harmonics
      type(equations_type), intent(in) :: equations
      !> Applied forces, shape (3, nodes, harmonics)
      real(wp), intent(in) :: applied(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Results that take the report
      type(results_type), intent(inout) :: results

      real(wp), allocatable :: force(:, :), displacement(:, :)  ! threads have small stacks
      integer :: k, m

      results%solver = equations%solver
      allocate (results%solves(size(equations%harmonics)))
      !$omp parallel do schedule(dynamic) private(m, force, displacement) &
      !$omp if (worth_threads(equations))
      do k = 1, size(equations%harmonics)
         m = equations%harmonics(k)
         force = applied(:, :, k) &
            + joint_force(points, m, field%excess(:, :, k), size(applied, 2))
         displacement = force  ! for its shape
         call solve_harmonic(equations, k, force, displacement)
         call refine_harmonic(equations, k, force, displacement)
         associate (report => results%solves(k))
            report%harmonic = m
            report%n_equations = equations%matrices(k)%n
            report%factor_entries = equations%plans(equations%class(k))%solver%factor_entries
            report%condition = condition_estimate(equations, k)
            report%smallest_pivot = equations%pivots(k)%smallest
            report%backward_error = backward_error(equations, k, force, displacement)
         end associate
      end do
      !$omp end parallel do
   end subroutine report_solves

end module axijoint_analysis_static
