!> The equations of all harmonics: matrices, factors, solution
module axijoint_assembly_equations
   use axijoint_assembly_dofs, only : gather, expand, collect, forces_between
   use axijoint_assembly_harmonic, only : harmonic_product
   use axijoint_assembly_mode_classes, only : mode_classes
   use axijoint_assembly_stiffness, only : stiffness_type, number_unknowns, find_sparsity, assemble_parts
   use axijoint_assembly_support, only : support_point_type
   use axijoint_assembly_unit_loads, only : unit_loads_type, new_unit_loads
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_team, only : team_type, take_team, equal_shares
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   use axijoint_order_graph, only : graph_type
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_inverse_norm, only : first_side, second_sides, inverse_norm
   use axijoint_solver_registry, only : chosen_solver
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type
   implicit none
   private
   public :: equations_type, system_type, plan_equations, assemble_equations
   public :: solve_mode, solve_system, find_unbalanced, on_equations
   public :: own_modes, worth_threads, planned_seconds, factoring_operations, condensing_operations, &
      correct_system, expand_mode

   !> With fewer equations in all, threads cost more than they save
   integer, parameter :: least_equations = 1500
   !> All that a system takes grows like this power of its equations. Factorization and solutions with all that
   !> follows them take about the same
   real(wp), parameter, public :: growth = 1.25_wp

   !> K_m of one harmonic: both families of it share the matrix unless restraints tell them apart;
   !> m = 0 has one for the symmetric family and one for torsion
   type :: system_type
      !> Harmonic m
      integer :: harmonic = 0
      !> Class: its place in `classes` and `plans`
      integer :: class = 0
      !> Places of the modes that are solved with it
      integer, allocatable :: modes(:)
      !> Largest sum of absolute values in a row of K_m
      real(wp) :: norm = 0.0_wp
      !> Factor while it is there, and pivots once it was
      class(factor_type), allocatable :: factor
      type(pivot_report_type) :: pivots
      !> Estimate of the condition number in the 1-norm, once the system is solved and corrected; negative before
      real(wp) :: condition = -1.0_wp
      !> Solution of the first pass for the estimate, until the second
      real(wp), allocatable :: probe(:)
      !> Whether it cannot be factored, and the words if a pivot is not the reason
      logical :: failed = .false.
      type(error_type), allocatable :: failure
   end type system_type

   !> Plan of one class
   type :: plan_slot_type
      !> The plan
      class(solver_type), allocatable :: solver
   end type plan_slot_type

   !> How the analysis of a class ended
   type :: outcome_type
      !> What went wrong, if anything did
      type(error_type), allocatable :: error
   end type outcome_type

   !> Equations of the modes in use
   type :: equations_type
      !> Modes, ascending
      type(mode_type), allocatable :: modes(:)
      !> System of each mode
      integer, allocatable :: system(:)
      !> Systems of equations
      type(system_type), allocatable :: systems(:)
      !> The solver, and its order of the nodes: order(k) is the k-th node
      type(solver_entry_type) :: solver
      integer, allocatable :: order(:)
      !> Unknowns, sparsity and stiffness of the classes
      type(stiffness_type), allocatable :: classes(:)
      !> Plans of the solver, one a class
      type(plan_slot_type), allocatable :: plans(:)
      !> Forces of masses and of in-situ stress under a factor of one
      type(unit_loads_type) :: unit_loads
      !> So many systems, the first ones of this rank, keep their factors
      integer :: n_kept = 0
      !> Systems that are worked on at once
      integer :: n_workers = 1
      !> Processes that share the work
      class(team_type), allocatable :: team
      !> Last system and last mode of each rank, shape (0:ranks)
      integer, allocatable :: last_system(:), last_mode(:)
      !> Systems of this rank: first and last
      integer :: first = 1, last = 0
      !> The rank whose systems take least time
      integer :: least_busy = 0
   end type equations_type

contains

   !> Number the unknowns of all classes, and analyse the patterns of those that this rank solves; nothing is assembled
   !> yet. Threads that have nothing else to do take some
   subroutine plan_equations(equations, model, modes, graph, error)
      !> The equations, planned
      type(equations_type), allocatable, intent(out) :: equations
      !> The job
      type(model_type), intent(in) :: model
      !> Modes, ascending
      type(mode_type), intent(in) :: modes(:)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(outcome_type), allocatable :: outcomes(:)
      logical, allocatable :: own(:)
      integer :: k, n_classes

      allocate (equations)
      equations%solver = chosen_solver(model%solver)
      call equations%solver%order(graph, equations%order, error)
      if (allocated(error)) return
      equations%modes = modes
      call divide_modes(modes, mode_classes(model, modes), equations%system, equations%systems)
      n_classes = maxval([0, equations%systems%class])
      allocate (equations%classes(n_classes), equations%plans(n_classes))
      do k = 1, n_classes
         associate (first => equations%systems(findloc(equations%systems%class, k, 1))%modes(1))
            call number_unknowns(equations%classes(k), model, modes(first), equations%order)
         end associate
      end do
      call take_team(model%team, equations%team)
      call share_systems(equations)
      own = [(any(equations%systems(equations%first:equations%last)%class == k), k=1, n_classes)]
      allocate (outcomes(n_classes))
      !$omp taskgroup
      do k = 1, n_classes
         if (.not. own(k)) cycle
         !$omp task default(shared) firstprivate(k) if(equations%solver%concurrent)
         call equations%solver%new_plan(equations%plans(k)%solver)
         call find_sparsity(equations%classes(k), graph, equations%order)
         call equations%plans(k)%solver%analyse(equations%classes(k)%pattern, outcomes(k)%error)
         !$omp end task
      end do
      !$omp end taskgroup
      do k = 1, n_classes
         if (allocated(outcomes(k)%error) .and. .not. allocated(error)) call move_alloc(outcomes(k)%error, error)
      end do
   end subroutine plan_equations

   !> Operations that factoring all systems once takes. All of them are of this rank
   pure real(wp) function factoring_operations(equations) result(n)
      !> The equations, planned
      type(equations_type), intent(in) :: equations

      integer :: s

      n = 0.0_wp
      do s = 1, size(equations%systems)
         n = n + equations%plans(equations%systems(s)%class)%solver%operations
      end do
   end function factoring_operations

   !> Operations that condensing all systems to some pairs of nodes takes. All of them are of this rank
   real(wp) function condensing_operations(equations, pairs) result(n)
      !> The equations, planned
      type(equations_type), intent(in) :: equations
      !> Both nodes of each pair, shape (2, pairs)
      integer, intent(in) :: pairs(:, :)

      real(wp) :: operations(size(equations%plans))
      integer, allocatable :: equation(:, :)
      real(wp), allocatable :: factor(:, :)
      integer :: k

      operations = 0.0_wp
      do k = 1, size(operations)
         if (equations%classes(k)%dofs%n_equations == 0) cycle
         call forces_between(equations%classes(k)%dofs, pairs, equation, factor)
         operations(k) = equations%plans(k)%solver%flexibility_operations(equation, factor)
      end do
      n = sum(operations(equations%systems%class))
   end function condensing_operations

   !> Give each rank a range of systems, of costs as equal as may be
   subroutine share_systems(equations)
      !> The equations, unknowns numbered
      type(equations_type), intent(inout) :: equations

      real(wp) :: cost(size(equations%systems)), share(0:equations%team%size - 1)
      integer :: s, rank

      do s = 1, size(cost)
         associate (system => equations%systems(s))
            cost(s) = real(equations%classes(system%class)%dofs%n_equations, wp)**growth &
               *(1 + size(system%modes))
         end associate
      end do
      associate (team => equations%team)
         allocate (equations%last_system(0:team%size), equations%last_mode(0:team%size))
         equations%last_system(:) = equal_shares(cost, team%size)
         do rank = 0, team%size
            equations%last_mode(rank) = count(equations%system <= equations%last_system(rank))
         end do
         share = [(sum(cost(equations%last_system(rank) + 1:equations%last_system(rank + 1))), rank=0, team%size - 1)]
         equations%least_busy = minloc(share, 1) - 1
         equations%first = equations%last_system(team%rank) + 1
         equations%last = equations%last_system(team%rank + 1)
      end associate
   end subroutine share_systems

   !> First and last mode of this rank
   pure function own_modes(equations) result(places)
      !> The equations, planned
      type(equations_type), intent(in) :: equations
      !> Places of the modes
      integer :: places(2)

      associate (rank => equations%team%rank)
         places = equations%last_mode(rank:rank + 1) + [1, 0]
      end associate
   end function own_modes

   !> Divide the modes into systems
   subroutine divide_modes(modes, class, system, systems)
      !> Modes, ascending
      type(mode_type), intent(in) :: modes(:)
      !> Class of each
      integer, intent(in) :: class(:)
      !> System of each mode
      integer, allocatable, intent(out) :: system(:)
      !> Systems, without matrices
      type(system_type), allocatable, intent(out) :: systems(:)

      integer :: k, s
      logical :: first(size(modes))

      first = .true.
      do k = 2, size(modes)
         first(k) = modes(k)%harmonic /= modes(k - 1)%harmonic .or. class(k) /= class(k - 1)
      end do
      system = [(count(first(:k)), k=1, size(modes))]
      allocate (systems(count(first)))
      do s = 1, size(systems)
         systems(s)%modes = pack([(k, k=1, size(modes))], system == s)
         k = systems(s)%modes(1)
         systems(s)%harmonic = modes(k)%harmonic
         systems(s)%class = class(k)
      end do
   end subroutine divide_modes

   !> Whether the harmonics are large enough to wake the threads for
   pure logical function worth_threads(equations)
      !> The equations, planned
      type(equations_type), intent(in) :: equations

      worth_threads = &
         sum(equations%classes(equations%systems%class)%dofs%n_equations) > least_equations
   end function worth_threads

   !> Expected time of all factorizations, one after the other. All systems are of this rank
   pure function planned_seconds(equations, kept, rate) result(seconds)
      !> The equations, planned
      type(equations_type), intent(in) :: equations
      !> Whether factors are kept
      logical, intent(in) :: kept
      !> Operations a second of a large matrix product
      real(wp), intent(in) :: rate
      !> The time
      real(wp) :: seconds

      integer :: k

      seconds = 0.0_wp
      do k = 1, size(equations%systems)
         seconds = seconds + system_seconds(equations, k, kept, rate)
      end do
   end function planned_seconds

   !> Expected time of the factorization of one system
   pure real(wp) function system_seconds(equations, s, kept, rate) result(seconds)
      !> The equations, planned
      type(equations_type), intent(in) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> Whether factors are kept
      logical, intent(in) :: kept
      !> Operations a second of a large matrix product
      real(wp), intent(in) :: rate

      seconds = equations%solver%seconds(equations%plans(equations%systems(s)%class)%solver, &
                                         rate, kept)
   end function system_seconds

   !> Assemble the stiffness of all classes
   subroutine assemble_equations(equations, model, joint_points, support_points)
      !> The equations, planned
      type(equations_type), intent(inout) :: equations
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: support_points(:)

      call assemble_parts(equations%classes, model, joint_points, support_points)
      call new_unit_loads(model, joint_points, equations%unit_loads)
   end subroutine assemble_equations

   !> Displacement of one mode under nodal forces
   subroutine solve_mode(equations, k, force, displacement)
      !> The equations, factored
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(out) :: displacement(:, :)

      real(wp), allocatable :: b(:, :)

      associate (dofs => equations%classes(equations%systems(equations%system(k))%class)%dofs)
         allocate (b(dofs%n_equations, 1))
         b(:, 1) = gather(dofs, force)
         call equations%systems(equations%system(k))%factor%solve(b)
         displacement = expand(dofs, b(:, 1))
      end associate
   end subroutine solve_mode

   !> Displacements of all modes of one system under nodal forces, found together, with the first pass for an estimate
   !> of its condition number if that is not known yet
   subroutine solve_system(equations, s, force, displacement)
      !> The equations, factored
      type(equations_type), intent(inout) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> Forces on components, shape (3, nodes, modes of the system)
      real(wp), intent(in) :: force(:, :, :)
      !> Displacement amplitudes, same shape
      real(wp), intent(out) :: displacement(:, :, :)

      real(wp), allocatable :: b(:, :)
      integer :: i, n

      associate (system => equations%systems(s), dofs => equations%classes(equations%systems(s)%class)%dofs)
         n = size(force, 3)
         allocate (b(dofs%n_equations, n + merge(1, 0, system%condition < 0.0_wp)))
         do i = 1, n
            b(:, i) = gather(dofs, force(:, :, i))
         end do
         if (system%condition < 0.0_wp) b(:, n + 1) = first_side(dofs%n_equations)
         call system%factor%solve_apart(b)
         if (system%condition < 0.0_wp) system%probe = b(:, n + 1)
         do i = 1, n
            displacement(:, :, i) = expand(dofs, b(:, i))
         end do
      end associate
   end subroutine solve_system

   !> Solutions for forces that displacements of a system leave: a step of iterative refinement, with the second pass for
   !> the estimate of its condition number in the 1-norm if that is not known yet
   subroutine correct_system(equations, s, correction)
      !> The equations, factored; the system has been solved
      type(equations_type), intent(inout) :: equations
      !> Place of the system; its condition is zero without equations
      integer, intent(in) :: s
      !> Forces on equations, then the corrections of the unknowns, shape (n_equations, any)
      real(wp), intent(inout), contiguous :: correction(:, :)

      real(wp), allocatable :: b(:, :)
      integer :: n

      associate (system => equations%systems(s))
         if (system%condition >= 0.0_wp) then
            call system%factor%solve_apart(correction)
            return
         end if
         n = size(correction, 2)
         allocate (b(size(correction, 1), n + 2))
         b(:, :n) = correction
         b(:, n + 1:) = second_sides(system%probe)
         call system%factor%solve_apart(b)
         correction = b(:, :n)
         system%condition = system%norm*inverse_norm(system%probe, b(:, n + 1:))
         deallocate (system%probe)
      end associate
   end subroutine correct_system

   !> Components of one mode from its unknowns
   function expand_mode(equations, k, unknowns) result(displacement)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> The unknowns, shape (n_equations)
      real(wp), intent(in) :: unknowns(:)
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), allocatable :: displacement(:, :)

      displacement = expand(equations%classes(equations%systems(equations%system(k))%class)%dofs, unknowns)
   end function expand_mode

   !> Forces on the equations of one mode, from forces on components
   function on_equations(equations, k, force) result(vector)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Forces on equations
      real(wp), allocatable :: vector(:)

      vector = gather(equations%classes(equations%systems(equations%system(k))%class)%dofs, force)
   end function on_equations

   !> Forces K_m u of the elastic structure, joints sticking, on the equations
   function elastic_force(equations, k, displacement) result(force)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Forces, shape (n_equations)
      real(wp), allocatable :: force(:)

      associate (system => equations%systems(equations%system(k)))
         force = harmonic_product(equations%classes(system%class), system%harmonic, &
                                  collect(equations%classes(system%class)%dofs, displacement))
      end associate
   end function elastic_force

   !> Forces b - K u that displacements of one mode leave, and their backward error
   !> |b - K u| / (|K| |u| + |b|), maximum norms
   subroutine find_unbalanced(equations, k, force, displacement, unbalanced, backward_error)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Forces on equations
      real(wp), allocatable, intent(out) :: unbalanced(:)
      !> Backward error; zero without loads
      real(wp), intent(out) :: backward_error

      real(wp) :: scale

      unbalanced = on_equations(equations, k, force)
      scale = equations%systems(equations%system(k))%norm*maxval(abs(displacement)) &
         + maxval([0.0_wp, abs(unbalanced)])
      unbalanced = unbalanced - elastic_force(equations, k, displacement)
      backward_error = 0.0_wp
      if (scale > 0.0_wp) backward_error = maxval([0.0_wp, abs(unbalanced)])/scale
   end subroutine find_unbalanced

end module axijoint_assembly_equations
