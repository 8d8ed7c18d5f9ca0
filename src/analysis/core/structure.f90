!> What all load combinations of a job share: modes, joints, factored equations
module axijoint_analysis_core_structure
   use axijoint_analysis_core_cut_loads, only : loaded_plane_type, new_loaded_planes
   use axijoint_analysis_core_cut_motion, only : cut_sections
   use axijoint_analysis_core_footprint, only : footprint_type, data_footprint
   use axijoint_analysis_core_results, only : ordering_type
   use axijoint_analysis_core_watched_lines, only : watched_lines_type, new_watched_lines
   use axijoint_analysis_fine_level, only : fine_level_type, lay_out_level, is_laid_out, bytes_to_come, form_stiffness, &
      form_by_one, take_conditions, take_fine_model
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, new_fine_mesh
   use axijoint_analysis_fine_singular_places, only : singular_place_type, find_singular_places, &
      judged_points, decide_what_is_judged
   use axijoint_assembly_equations, only : equations_type, plan_equations, assemble_equations
   use axijoint_assembly_factors, only : plan_factors, factorize_equations
   use axijoint_assembly_mechanism, only : check_mechanism
   use axijoint_assembly_pattern, only : node_graph
   use axijoint_assembly_stiffness, only : least_elements
   use axijoint_assembly_support, only : support_point_type, new_support_points
   use axijoint_assembly_unit_loads, only : new_unit_loads
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_memory, only : require_memory, free_memory
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_text, only : to_text
   use axijoint_base_stop, only : check_stop
   use axijoint_base_timer, only : timer_type, phase_assemble, phase_factor, phase_joints
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_condensed, only : condensed_type, new_condensed
   use axijoint_joints_loads, only : answer_type
   use axijoint_joints_planes, only : planes_type, new_planes
   use axijoint_linalg_blas_buffers, only : reserve_blas_buffers
   use axijoint_model_joint_points, only : model_joint_point_type, new_joint_points
   use axijoint_model_model, only : model_type, can_yield, can_yield_at, bodies_yield
   use axijoint_model_modes, only : used_modes
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements
   use axijoint_model_request, only : line_type, print_orders, rows_expected
   use axijoint_order_graph, only : graph_type, bandwidth, profile, fill
   use axijoint_order_metis, only : nested_dissection
   use axijoint_order_rcm, only : reverse_cuthill_mckee
   use axijoint_order_sloan, only : sloan
   use omp_lib, only : omp_get_max_threads, omp_get_wtime
   implicit none
   private
   public :: structure_type, build_structure, build_equations, expect_estimates, plan_structure, take_loads_of, &
      reuses_factors

   !> A structure ready to be loaded
   type :: structure_type
      !> Modes to solve
      type(mode_type), allocatable :: modes(:)
      !> Points of all joints, and of all springs
      type(model_joint_point_type), allocatable :: joint_points(:)
      type(support_point_type), allocatable :: support_points(:)
      !> Equations of all modes, factored
      type(equations_type), allocatable :: equations
      !> Joints that can yield, condensed; empty if none can
      type(condensed_type) :: condensed
      !> Their places among all joint points
      integer, allocatable :: yielding(:)
      !> Planes that joint results are shown on: all, while the iterations leave out those
      !> that are like others
      type(planes_type) :: planes
      !> Whether errors of states will be estimated by the fine level, which is there then
      logical :: estimated = .true.
      !> Whether what helps to judge results is told: singular places, orders of the nodes
      logical :: listed = .true.
      !> The same on a mesh of elements half as large, for estimates of errors
      type(fine_level_type) :: fine
      !> Where stresses are infinite, and whether the stress of a joint point, far enough from
      !> there, is judged
      type(singular_place_type), allocatable :: singular(:)
      logical, allocatable :: judged(:)
      !> Cuts of the job, and sections there
      type(loaded_plane_type), allocatable :: cuts(:)
      type(line_type), allocatable :: sections(:)
      !> What is watched of the stresses along lines; not allocated if errors are not estimated, or there are none
      type(watched_lines_type), allocatable :: watched
      !> Orders of the nodes side by side
      type(ordering_type), allocatable :: orderings(:)
      !> What rounding may leave of displacements, over the largest, without a step of refinement:
      !> nothing unless who builds the structure says so
      real(wp) :: negligible = -1.0_wp
      !> The last answer of the elastic structure to loads, if many states are expected to have the same
      type(answer_type), allocatable :: answer
   end type structure_type

contains

   !> Assemble and factor the equations of all modes. Ranks of a team wait for each other if factors are kept; otherwise
   !> an error of one is told to the others where they agree next
   subroutine build_structure(model, structure, timer, progress, error, estimated, listed)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(out) :: structure
      !> Times of the phases
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Whether errors will be estimated, which takes the fine level; true if absent
      logical, intent(in), optional :: estimated
      !> Whether a listing will show it; as errors are estimated if absent
      logical, intent(in), optional :: listed

      call expect_estimates(model, structure, estimated)
      if (present(listed)) structure%listed = listed
      call timer%push(phase_assemble)
      call plan_levels(model, structure, progress, error)
      if (.not. allocated(error)) call assemble_equations(structure%equations, model, structure%joint_points, &
         structure%support_points)
      call timer%pop()
      if (allocated(model%team) .and. (allocated(error) .or. reuses_factors(model))) call model%team%agree(error)
      if (allocated(error)) return
      if (reuses_factors(model)) then
         call timer%push(phase_factor)
         if (structure%equations%n_kept > 0) then
            call show_progress(progress, 'factoring '//to_text(structure%equations%n_kept)// &
               ' harmonics')
         end if
         call factorize_equations(structure%equations, model, error)
         call timer%pop()
         if (allocated(error)) return
      end if
      call timer%push(phase_assemble)
      if (structure%estimated) call form_fine_level(model, structure)
      if (allocated(structure%singular)) call judge_points(model%mesh, structure)
      call watch_lines(model, structure)
      call timer%pop()
      call timer%push(phase_joints)
      call condense(model, structure, progress, error)
      call timer%pop()
   end subroutine build_structure

   !> Say whether errors of states will be estimated by the fine level: none that holds with plastic strain
   pure subroutine expect_estimates(model, structure, estimated)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Whether they are wanted; true if absent
      logical, intent(in), optional :: estimated

      if (present(estimated)) structure%listed = estimated
      structure%estimated = structure%listed .and. .not. bodies_yield(model)
   end subroutine expect_estimates

   !> Plan the equations, lay out what estimates of errors need, and find the sections at the cuts: none waits for the
   !> others. Orders and analysis are for one thread; another integrates the fine level meanwhile if that takes little of the
   !> memory that is shared out after the planning
   subroutine plan_levels(model, structure, progress, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> A mechanism, or out of memory
      type(error_type), allocatable, intent(out) :: error

      !> Part of the memory
      real(wp), parameter :: small_part = 0.1_wp
      real(wp) :: start
      integer :: n_threads

      n_threads = merge(min(2, omp_get_max_threads()), 1, n_elements(model%mesh) > least_elements)
      !$omp parallel num_threads(n_threads)
      !$omp master
      ! the iterations of joints end by the stress of points that are judged, far from singular places
      if (structure%estimated .or. can_yield(model) .or. bodies_yield(model)) then
         !$omp task default(shared) private(start)
         start = omp_get_wtime()
         if (structure%estimated) call lay_out_level(model, structure%fine)
         call find_singular(model, structure)
         structure%fine%seconds = (omp_get_wtime() - start)/n_threads
         ! last: the thread that is here may see to a class of equations before
         !$omp task default(shared) private(start) if(n_threads > 1)
         start = omp_get_wtime()
         if (n_threads > 1 .and. structure%estimated .and. .not. allocated(model%team)) then
            if (bytes_to_come(structure%fine) <= small_part*free_memory(model%memory_limit)) call form_stiffness(structure%fine)
         end if
         structure%fine%seconds = structure%fine%seconds + (omp_get_wtime() - start)/n_threads
         !$omp end task
         !$omp end task
      end if
      !$omp task default(shared)
      structure%cuts = new_loaded_planes(model)
      structure%sections = cut_sections(model%mesh, model%cuts)
      !$omp end task
      call plan_systems(model, structure, progress, error)
      !$omp end master
      !$omp end parallel
      if (.not. allocated(error)) call plan_memory(model, structure, error)
   end subroutine plan_levels

   !> Find singular places on the mesh of elements half as large, which stays only if it serves estimates; those that nothing
   !> follows from are left out
   subroutine find_singular(model, structure)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, its fine level laid out if errors are estimated
      type(structure_type), intent(inout) :: structure

      type(fine_mesh_type) :: mesh
      logical :: wanted

      wanted = structure%listed
      if (.not. wanted) wanted = decide_what_is_judged(model)
      if (structure%estimated) then
         structure%singular = find_singular_places(model, structure%fine%mesh)
      else if (wanted) then
         call new_fine_mesh(model%mesh, mesh)
         structure%singular = find_singular_places(model, mesh)
      else
         allocate (structure%singular(0))
      end if
   end subroutine find_singular

   !> Find which joint points are judged
   subroutine judge_points(mesh, structure)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The structure, its singular places known
      type(structure_type), intent(inout) :: structure

      integer :: k

      associate (points => structure%joint_points)
         structure%judged = judged_points(mesh, structure%singular, &
            reshape([(points(k)%position, k=1, size(points))], [2, size(points)]))
      end associate
   end subroutine judge_points

   !> Integrate the fine level, unless it is already, and take what the equations say of it
   subroutine form_fine_level(model, structure)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(inout) :: structure

      real(wp) :: start

      start = omp_get_wtime()
      associate (team => structure%equations%team)
         if (team%size > 1 .and. team%sharers == team%size .and. .not. reuses_factors(model)) then
            ! telling it takes less than forming it where memory is shared
            call form_by_one(team, structure%fine, structure%equations%least_busy)
         else if (bytes_to_come(structure%fine) > 0) then
            call form_stiffness(structure%fine)
         end if
      end associate
      call take_conditions(structure%equations, structure%fine)
      structure%fine%seconds = structure%fine%seconds + omp_get_wtime() - start
   end subroutine form_fine_level

   !> Assemble, factor and condense the equations of all modes and no more: no estimate of errors can
   !> be made of it
   subroutine build_equations(model, structure, progress, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(out) :: structure
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      structure%estimated = .false.
      structure%listed = .false.
      call assemble(model, structure, progress, error)
      if (allocated(error)) return
      call factorize_equations(structure%equations, model, error)
      if (allocated(error)) return
      call condense(model, structure, progress, error)
   end subroutine build_equations

   !> Condense the structure to the joints that can yield
   subroutine condense(model, structure, progress, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, factored
      type(structure_type), intent(inout) :: structure
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      structure%yielding = pack([(k, k=1, size(structure%joint_points))], &
                                can_yield_at(model, structure%joint_points%material))
      if (size(structure%yielding) > 0) then
         call show_progress(progress, 'condensing to '//to_text(size(structure%yielding))// &
            ' joint points')
         structure%planes = new_planes(model%n_planes, structure%modes, whole=.true.)
         call new_condensed(model, structure%joint_points, structure%support_points, &
            structure%equations, structure%condensed, error)
      else
         allocate (structure%condensed%points(0), structure%condensed%floating(0))
      end if
   end subroutine condense

   !> Let a structure serve another job that has the same: the fine level knows its loads and laws, and
   !> cuts and lines may be elsewhere
   subroutine take_loads_of(model, structure)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure

      call new_unit_loads(model, structure%joint_points, structure%equations%unit_loads)
      if (structure%estimated) call take_fine_model(model, structure%fine)
      structure%cuts = new_loaded_planes(model)
      structure%sections = cut_sections(model%mesh, model%cuts)
      call watch_lines(model, structure)
   end subroutine take_loads_of

   !> Watch the stresses along lines, if their errors are estimated
   subroutine watch_lines(model, structure)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, its singular places known
      type(structure_type), intent(inout) :: structure

      if (allocated(structure%watched)) deallocate (structure%watched)
      if (.not. structure%estimated .or. size(model%lines) == 0) return
      structure%watched = new_watched_lines(model, structure%fine%model%mesh, (structure%singular%node))
   end subroutine watch_lines

   !> Assemble the equations of all modes
   subroutine assemble(model, structure, progress, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> A mechanism, or out of memory
      type(error_type), allocatable, intent(out) :: error

      call plan_structure(model, structure, progress, error)
      if (allocated(error)) return
      call assemble_equations(structure%equations, model, structure%joint_points, &
                              structure%support_points)
   end subroutine assemble

   !> Find modes, joint points, unknowns, orders and patterns of the equations, and how many factors
   !> are there at once; nothing is assembled yet
   subroutine plan_structure(model, structure, progress, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> A mechanism, or out of memory: the factors are planned then all the same
      type(error_type), allocatable, intent(out) :: error

      call plan_systems(model, structure, progress, error)
      if (.not. allocated(error)) call plan_memory(model, structure, error)
   end subroutine plan_structure

   !> Find modes, joint points, unknowns, orders and patterns of the equations
   subroutine plan_systems(model, structure, progress, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> A mechanism, or out of memory
      type(error_type), allocatable, intent(out) :: error

      type(graph_type) :: graph

      structure%joint_points = new_joint_points(model)
      structure%support_points = new_support_points(model)
      structure%modes = used_modes(model)
      call reserve_blas_buffers(omp_get_max_threads())
      call require_memory(0_i8, 'the solvers', model%memory_limit, error)
      if (.not. allocated(error)) call check_mechanism(model, structure%joint_points, &
         structure%support_points, structure%modes, error)
      if (allocated(error)) return
      call show_progress(progress, 'assembling '//to_text(size(structure%modes))//' modes')
      graph = node_graph(model%mesh)
      call plan_equations(structure%equations, model, structure%modes, graph, error)
      if (allocated(error)) return
      if (.not. structure%listed) then
         allocate (structure%orderings(0))
      else if (rows_expected(model%print, print_orders, real(n_nodes(model%mesh), wp)) > 0.0_wp) then
         call compare_orders(graph, structure%orderings, error)
         if (allocated(error)) return
      else
         structure%orderings = [measured(structure%equations%solver%order_name, graph, structure%equations%order)]
      end if
      call check_stop(error)
   end subroutine plan_systems

   !> Find how many factors are there at once, by the memory that is free now
   subroutine plan_memory(model, structure, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, its systems planned; the fine level may be laid out
      type(structure_type), intent(inout) :: structure
      !> Out of memory: the factors are planned all the same
      type(error_type), allocatable, intent(out) :: error

      type(footprint_type) :: others

      others = data_footprint(model, size(structure%modes), &
         structure%equations%last - structure%equations%first + 1, structure%joint_points, structure%estimated)
      if (is_laid_out(structure%fine)) others%fine = bytes_to_come(structure%fine)
      call plan_factors(structure%equations, reuses_factors(model), others%staying(), &
                        others%of_a_thread(), others%later(), model%memory_limit, error)
   end subroutine plan_memory

   !> Whether the factors are needed more than once: by several load combinations, by bodies that
   !> yield, or by joints, which take flexibilities, then displacements, or to show earlier increments
   pure logical function reuses_factors(model)
      !> The job
      type(model_type), intent(in) :: model

      reuses_factors = size(model%combinations) > 1 .or. can_yield(model) &
         .or. bodies_yield(model) .or. size(model%increments) > 1
   end function reuses_factors

   !> Bandwidth, profile and fill of the orders side by side
   subroutine compare_orders(graph, orderings, error)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Reverse Cuthill-McKee, Sloan, nested dissection
      type(ordering_type), allocatable, intent(out) :: orderings(:)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: by_band(:), by_profile(:), by_fill(:)

      call reverse_cuthill_mckee(graph, by_band)
      call sloan(graph, by_profile)
      call nested_dissection(graph, by_fill, error)
      if (allocated(error)) return
      orderings = [measured('reverse Cuthill-McKee', graph, by_band), measured('Sloan', graph, by_profile), &
                   measured('nested dissection', graph, by_fill)]
   end subroutine compare_orders

   !> Bandwidth, profile and fill of an order
   pure function measured(name, graph, order) result(ordering)
      !> Its name
      character(len=*), intent(in) :: name
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)
      !> The figures
      type(ordering_type) :: ordering

      ordering = ordering_type(name(:scan(name//'(', '(,') - 1), bandwidth(graph, order), profile(graph, order), &
         fill(graph, order))
   end function measured

end module axijoint_analysis_core_structure
