!> What the flexibility of a line of nodes costs: two neighbouring lines of nodes
!> over half the height of a square mesh of 9-node elements, as many unknowns as a
!> joint there has. One call measures one mesh and writes one line of
!> comma-separated values a solver.
!>
!> Usage: flexibility NODES
program flexibility
   use, intrinsic :: iso_fortran_env, only : output_unit
   use omp_lib, only : omp_set_num_threads
   use axijoint_assembly_harmonic, only : harmonic_values
   use axijoint_assembly_pattern, only : node_graph
   use axijoint_assembly_stiffness, only : stiffness_type, new_stiffness, assemble_parts
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, lower
   use axijoint_bench_measure, only : product_rate, seconds, stop_on, fail
   use axijoint_bench_square, only : square
   use axijoint_fe_mode, only : mode_type
   use axijoint_linalg_lapack, only : use_one_blas_thread
   use axijoint_linalg_symmetric_half, only : symmetric_half_type
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   use axijoint_order_graph, only : graph_type
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_registry, only : known_solvers
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type
   implicit none

   !> The harmonic that is measured
   integer, parameter :: harmonic = 2
   !> Longer factorizations are left out [second]
   real(wp), parameter :: limit = 30.0_wp

   type(model_type) :: model
   logical, allocatable :: wanted(:)
   character(len=32) :: word
   type(solver_entry_type), allocatable :: solvers(:)
   integer :: n_side, stat, i, k
   real(wp) :: rate

   call get_command_argument(1, word)
   read (word, *, iostat=stat) n_side
   if (stat /= 0) call fail('the argument is the number of nodes along a side')
   call use_one_blas_thread()
   call omp_set_num_threads(1)
   rate = product_rate()
   model = square(n_side, harmonic)
   associate (middle => n_side/2)
      wanted = [(any(mod(k - 1, n_side) == [middle, middle + 1]) .and. (k - 1)/n_side >= middle, &
                 k=1, n_side**2)]
   end associate
   write (output_unit, '(a)') 'nodes_per_side,unknowns,set,solver,factor_entries,'// &
      'factorization_s,inverse_s,operations'
   solvers = known_solvers()
   do i = 1, size(solvers)
      call measure(solvers(i))
   end do

contains

   !> Factorization and flexibility with one solver
   subroutine measure(entry)
      !> The solver
      type(solver_entry_type), intent(in) :: entry

      type(graph_type) :: graph
      type(stiffness_type) :: stiffness(1)
      type(symmetric_matrix_type) :: matrix
      class(solver_type), allocatable :: solver
      class(factor_type), allocatable :: factor
      type(pivot_report_type) :: pivots
      type(error_type), allocatable :: error
      integer, allocatable :: set(:), order(:)
      type(symmetric_half_type) :: room
      type(symmetric_half_type), allocatable :: inverse
      real(wp) :: start, factorization, inversion

      graph = node_graph(model%mesh)
      call entry%order(graph, order, error)
      call stop_on(error)
      call new_stiffness(stiffness(1), model, mode_type(harmonic), graph, order)
      call entry%new_plan(solver)
      call solver%analyse(stiffness(1)%pattern, error)
      call stop_on(error)
      if (entry%seconds(solver, rate, kept=.true.) > limit) return
      call assemble_parts(stiffness, model, [model_joint_point_type ::], [support_point_type ::])
      matrix = stiffness(1)%pattern
      allocate (matrix%value(size(matrix%column)))
      call harmonic_values(stiffness(1), harmonic, matrix%value)
      associate (equation => stiffness(1)%dofs%equation)
         set = pack(equation, spread(wanted, 1, 3) .and. equation > 0)
      end associate
      call solver%factorize(matrix, matrix%value, factor, pivots, error)  ! the first wakes the libraries
      deallocate (factor)
      start = seconds()
      call solver%factorize(matrix, matrix%value, factor, pivots, error)
      call stop_on(error)
      factorization = seconds() - start
      start = seconds()
      call factor%flexibility(spread(set, 1, 2), spread([1.0_wp, 0.0_wp], 2, size(set)), room, inverse, error)
      call stop_on(error)
      inversion = seconds() - start
      write (output_unit, '(a)') to_text(n_side)//','//to_text(matrix%n)//','//to_text(size(set))// &
         ','//trim(lower(entry%name))//','// &
         to_text(real(solver%factor_entries, wp))//','//to_text(factorization)//','// &
         to_text(inversion)//','//to_text(solver%operations)
   end subroutine measure

end program flexibility
