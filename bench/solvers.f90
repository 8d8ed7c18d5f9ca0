!> What the solvers cost against the number of unknowns, on square meshes of
!> 9-node elements. One call measures one mesh and writes one line of
!> comma-separated values a solver and number of threads; scripts/bench makes
!> table and figure of them.
!>
!> Usage: solvers NODES [--harmonics M] [--limit SECONDS] [--solvers NAMES] [--dump FILE]
program solvers
   use, intrinsic :: iso_fortran_env, only : output_unit
   use omp_lib, only : omp_set_num_threads, omp_get_num_procs
   use axijoint_assembly_equations, only : equations_type, plan_equations, assemble_equations
   use axijoint_assembly_factors, only : plan_factors, standing_bytes, parts_bytes, kept_bytes, &
                                         passing_bytes, workspace_type, new_workspaces, own, &
                                         hold_factor, release_factor, report_failure
   use axijoint_assembly_harmonic, only : harmonic_values
   use axijoint_assembly_pattern, only : node_graph
   use axijoint_assembly_stiffness, only : stiffness_type, new_stiffness, assemble_parts
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_base_memory, only : available_memory, no_limit
   use axijoint_base_text, only : to_text, lower
   use axijoint_bench_measure, only : product_rate, seconds, stop_on, fail
   use axijoint_bench_square, only : square
   use axijoint_fe_mode, only : mode_type
   use axijoint_linalg_lapack, only : use_one_blas_thread
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type, multiply, infinity_norm
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   use axijoint_order_graph, only : graph_type
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_registry, only : known_solvers
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type
   implicit none

   !> The harmonic that is measured alone
   integer, parameter :: harmonic = 2
   !> Measurements of short times go on for this long, and are at least three
   real(wp), parameter :: least_seconds = 0.3_wp
   !> Share of the limit after which a measurement is not repeated
   real(wp), parameter :: patience = 0.5_wp

   !> What the command line asks for
   type :: config_type
      !> Nodes along a side of the mesh
      integer :: n_side = 0
      !> Harmonics of the runs on several threads; none: no such runs
      integer :: n_harmonics = 0
      !> Expected time of a factorization from which on it is left out [second]
      real(wp) :: limit = 60.0_wp
      !> Names of the solvers, in any letters
      character(len=:), allocatable :: solvers
      !> File for the matrix as the sparse solver gets it; empty: none
      character(len=:), allocatable :: dump
   end type config_type

   !> One line of the table; times in seconds, negative where nothing was
   !> measured
   type :: record_type
      integer :: n_side = 0, n_unknowns = 0, n_threads = 1, n_harmonics = 1
      real(wp) :: order = -1.0_wp, analysis = -1.0_wp, parts = -1.0_wp, matrix = -1.0_wp
      real(wp) :: factorization = -1.0_wp, repeated = -1.0_wp, shared = -1.0_wp, solution = -1.0_wp, operations = 0.0_wp
      real(wp) :: rate = 0.0_wp, bytes = 0.0_wp, entries = 0.0_wp
      real(wp) :: backward_error = -1.0_wp, lapack_ratio = -1.0_wp, expected = 0.0_wp, share = -1.0_wp
      character(len=:), allocatable :: solver, note
   end type record_type

   type(config_type) :: config
   type(model_type) :: model
   real(wp) :: rate
   type(solver_entry_type), allocatable :: entries(:)
   integer :: k

   call read_arguments(config)
   call use_one_blas_thread()
   rate = product_rate()
   model = square(config%n_side, config%n_harmonics)
   call print_header()
   entries = known_solvers()
   do k = 1, size(entries)
      if (index(config%solvers, trim(lower(entries(k)%name))) == 0) cycle
      call measure_solver(entries(k))
   end do

contains

   !> Read the command line
   subroutine read_arguments(config)
      !> What it asks for
      type(config_type), intent(out) :: config

      character(len=1024) :: word
      integer :: k, stat

      config%solvers = 'band,skyline,sparse'
      config%dump = ''
      call get_command_argument(1, word)
      read (word, *, iostat=stat) config%n_side
      if (stat /= 0 .or. config%n_side < 3 .or. mod(config%n_side, 2) == 0) then
         call fail('the first argument is the number of nodes along a side: odd, from 3 on')
      end if
      do k = 2, command_argument_count() - 1, 2
         call get_command_argument(k, word)
         select case (word)
         case ('--harmonics')
            call get_command_argument(k + 1, word)
            read (word, *) config%n_harmonics
         case ('--limit')
            call get_command_argument(k + 1, word)
            read (word, *) config%limit
         case ('--solvers')
            call get_command_argument(k + 1, word)
            config%solvers = lower(trim(word))
         case ('--dump')
            call get_command_argument(k + 1, word)
            config%dump = trim(word)
         case default
            call fail('unknown option '//trim(word))
         end select
      end do
   end subroutine read_arguments

   !> Measure one solver, first on one harmonic, then on several with one thread
   !> and with all
   subroutine measure_solver(entry)
      !> The solver
      type(solver_entry_type), intent(in) :: entry

      type(record_type) :: record
      integer :: n_threads

      call measure_harmonic(entry, record)
      call print_record(record)
      if (config%n_harmonics == 0 .or. record%factorization < 0.0_wp) return
      if (record%factorization*config%n_harmonics > patience*config%limit) return
      n_threads = 1
      do
         call measure_threads(entry, n_threads, record)
         call print_record(record)
         if (n_threads == min(2, omp_get_num_procs())) exit
         n_threads = 2
      end do
   end subroutine measure_solver

   !> All steps of one solver for one harmonic on one thread
   subroutine measure_harmonic(entry, record)
      !> The solver
      type(solver_entry_type), intent(in) :: entry
      !> What was measured
      type(record_type), intent(out) :: record

      type(graph_type) :: graph
      type(stiffness_type) :: stiffness(1)
      type(symmetric_matrix_type) :: matrix
      class(solver_type), allocatable :: solver
      type(error_type), allocatable :: error
      integer, allocatable :: order(:)
      real(wp) :: start

      call omp_set_num_threads(1)
      start = seconds()
      graph = node_graph(model%mesh)
      call entry%order(graph, order, error)
      call stop_on(error)
      record%order = seconds() - start
      start = seconds()
      call new_stiffness(stiffness(1), model, mode_type(harmonic), graph, order)
      call entry%new_plan(solver)
      call solver%analyse(stiffness(1)%pattern, error)
      call stop_on(error)
      record%analysis = seconds() - start
      call describe(record, entry, solver)
      if (.not. feasible(record)) return
      start = clock(1)
      call assemble_parts(stiffness, model, [model_joint_point_type ::], [support_point_type ::])
      record%parts = clock(1) - start
      start = clock(1)
      matrix = stiffness(1)%pattern
      allocate (matrix%value(size(matrix%column)))
      call harmonic_values(stiffness(1), harmonic, matrix%value)
      record%matrix = clock(1) - start
      deallocate (stiffness(1)%parts)
      if (entry%name == 'SPARSE' .and. len(config%dump) > 0) call dump_matrix(matrix, config%dump)
      call measure_factor(solver, matrix, record)
   end subroutine measure_harmonic

   !> What is known of a factorization before it
   subroutine describe(record, entry, solver)
      !> The line of the table
      type(record_type), intent(inout) :: record
      !> The solver
      type(solver_entry_type), intent(in) :: entry
      !> The plan
      class(solver_type), intent(in) :: solver

      record%n_side = config%n_side
      record%n_unknowns = solver%n
      record%solver = trim(lower(entry%name))
      record%rate = rate
      record%operations = solver%operations
      record%entries = real(solver%factor_entries, wp)
      record%bytes = real(solver%factor_bytes, wp)
      record%expected = entry%seconds(solver, rate, kept=.false.)
      record%note = ''
   end subroutine describe

   !> Whether a factorization is expected to end in time and to fit in memory
   logical function feasible(record)
      !> The line of the table; the reason is put in its note
      type(record_type), intent(inout) :: record

      feasible = .false.
      if (record%expected > config%limit) then
         record%note = 'left out: '//to_text(nint(record%expected))//' s expected'
      else if (record%bytes > 0.8_wp*real(available_memory(), wp)) then
         record%note = 'left out: '//to_text(nint(record%bytes/2.0_wp**20))//' MiB needed'
      else
         feasible = .true.
      end if
   end function feasible

   !> Factorization, solution and errors
   subroutine measure_factor(solver, matrix, record)
      !> The plan
      class(solver_type), intent(in) :: solver
      !> The matrix
      type(symmetric_matrix_type), intent(in) :: matrix
      !> The line of the table
      type(record_type), intent(inout) :: record

      class(factor_type), allocatable :: factor
      real(wp), allocatable :: times(:), b(:), x(:, :), correction(:, :)
      real(wp) :: start, processor, processor_end, norm

      start = seconds()
      call cpu_time(processor)
      allocate (x(matrix%n, 1), correction(matrix%n, 1))
      call repeat_factorization(solver, matrix, .true., 1, factor, times)
      call cpu_time(processor_end)
      record%share = (processor_end - processor)/(seconds() - start)
      record%factorization = minval(times)
      if (sum(times) < patience*config%limit) then
         call repeat_factorization(solver, matrix, .false., 1, factor, times)
         record%repeated = minval(times)
         if (omp_get_num_procs() > 1) then
            call repeat_factorization(solver, matrix, .false., 2, factor, times)
            record%shared = minval(times)
         end if
      end if
      allocate (b(matrix%n), source=1.0_wp)
      deallocate (times)
      allocate (times(0))
      do
         x(:, 1) = b
         call cpu_time(start)
         call factor%solve(x)
         call cpu_time(processor_end)
         times = [times, processor_end - start]
         if (size(times) >= 3 .and. sum(times) > 0.3_wp*least_seconds) exit
      end do
      record%solution = minval(times)
      norm = infinity_norm(matrix, matrix%value)
      correction(:, 1) = b - multiply(matrix, x(:, 1))
      record%lapack_ratio = maxval(abs(correction))/(norm*maxval(abs(x))*matrix%n*epsilon(norm))
      call factor%solve(correction)
      x = x + correction
      record%backward_error = maxval(abs(b - multiply(matrix, x(:, 1)))) &
         /(norm*maxval(abs(x)) + maxval(abs(b)))
   end subroutine measure_factor

   !> Factor a few times
   subroutine repeat_factorization(solver, matrix, fresh, n_threads, factor, times)
      !> The plan
      class(solver_type), intent(in) :: solver
      !> The matrix
      type(symmetric_matrix_type), intent(in) :: matrix
      !> Whether each factor takes memory of its own, or that of the one before
      logical, intent(in) :: fresh
      !> Threads that share a factorization
      integer, intent(in) :: n_threads
      !> The factor
      class(factor_type), allocatable, intent(inout) :: factor
      !> Times: of the processor on one thread, which is what the wall clock says but for what others do
      real(wp), allocatable, intent(out) :: times(:)

      type(pivot_report_type) :: pivots
      type(error_type), allocatable :: error
      real(wp) :: start, now

      allocate (times(0))
      call omp_set_num_threads(n_threads)
      do
         if (fresh .and. allocated(factor)) deallocate (factor)
         start = clock(n_threads)
         call solver%factorize(matrix, matrix%value, factor, pivots, error, passing=.true.)
         call stop_on(error)
         now = clock(n_threads)
         times = [times, now - start]
         if (pivots%equation > 0) call fail('a pivot is not positive')
         if (size(times) >= 3 .and. sum(times) > least_seconds) exit
         if (sum(times) > patience*config%limit) exit
      end do
      call omp_set_num_threads(1)
   end subroutine repeat_factorization

   !> Factorizations of harmonics 1, 2, ... as in a run of axijoint
   subroutine measure_threads(entry, n_threads, record)
      !> The solver
      type(solver_entry_type), intent(in) :: entry
      !> Harmonics factored at once
      integer, intent(in) :: n_threads
      !> What was measured
      type(record_type), intent(out) :: record

      type(equations_type), allocatable :: equations
      type(error_type), allocatable :: error
      real(wp) :: start, processor, processor_end, time
      integer :: m

      call omp_set_num_threads(n_threads)
      model%solver = entry
      start = seconds()
      call plan_equations(equations, model, [(mode_type(m), m=1, config%n_harmonics)], node_graph(model%mesh), error)
      call stop_on(error)
      record%analysis = seconds() - start
      call describe(record, entry, equations%plans(1)%solver)
      record%n_threads = n_threads
      record%n_harmonics = config%n_harmonics
      record%operations = record%operations*config%n_harmonics
      record%expected = record%expected*config%n_harmonics
      call plan_factors(equations, .false., 0_i8, 0_i8, 0_i8, no_limit, error)
      call stop_on(error)
      record%bytes = real(standing_bytes(equations) + parts_bytes(equations) &
                          + kept_bytes(equations) + passing_bytes(equations), wp)
      if (.not. feasible(record)) return
      start = clock(n_threads)
      call assemble_equations(equations, model, [model_joint_point_type ::], &
                              [support_point_type ::])
      record%parts = clock(n_threads) - start
      start = clock(n_threads)
      call form_matrices(equations)
      record%matrix = clock(n_threads) - start
      ! twice: the first time some memory is new to the process, with two threads more than with one
      do m = 1, 2
         call cpu_time(processor)
         start = clock(n_threads)
         call factorize_in_turn(equations)
         call report_failure(equations, model, error)
         call stop_on(error)
         time = clock(n_threads) - start
         call cpu_time(processor_end)
         if (m == 2 .and. time > record%factorization) exit
         record%factorization = time
         record%share = (processor_end - processor)/time
      end do
   end subroutine measure_threads

   !> Processor time on one thread, which other jobs do not disturb; else the wall clock [second]
   real(wp) function clock(n_threads)
      !> Number of threads
      integer, intent(in) :: n_threads

      clock = seconds()
      if (n_threads == 1) call cpu_time(clock)
   end function clock

   !> Factor all harmonics, each thread one after the other in the same memory, as a linear job
   subroutine factorize_in_turn(equations)
      !> The equations, assembled
      type(equations_type), intent(inout) :: equations

      type(workspace_type), allocatable :: spaces(:)
      integer :: s

      call new_workspaces(equations, spaces)
      !$omp parallel do schedule(dynamic) num_threads(size(spaces))
      do s = 1, size(equations%systems)
         call hold_factor(equations, s, spaces(own()))
         call release_factor(equations, s, spaces(own()))
      end do
      !$omp end parallel do
   end subroutine factorize_in_turn

   !> Form the matrices of all harmonics, for the time that it takes: the
   !> factorizations form theirs themselves
   subroutine form_matrices(equations)
      !> The equations, assembled
      type(equations_type), intent(in) :: equations

      real(wp), allocatable :: value(:)
      integer :: k

      !$omp parallel private(value)
      allocate (value(size(equations%classes(1)%pattern%column)))
      call use_large_pages(value)
      !$omp do schedule(dynamic)
      do k = 1, size(equations%systems)
         call harmonic_values(equations%classes(1), equations%systems(k)%harmonic, value)
      end do
      !$omp end do
      deallocate (value)
      !$omp end parallel
   end subroutine form_matrices

   !> Write a matrix for other solvers: order and entries (8 bytes), starts of
   !> the rows (8 bytes), columns (4 bytes) and values of the lower triangle by
   !> rows, counted from one
   subroutine dump_matrix(matrix, path)
      !> The matrix
      type(symmetric_matrix_type), intent(in) :: matrix
      !> The file
      character(len=*), intent(in) :: path

      integer :: unit, stat

      open (newunit=unit, file=path, access='stream', form='unformatted', status='replace', &
            action='write', iostat=stat)
      if (stat /= 0) call fail('cannot write '//path)
      write (unit) int(matrix%n, i8), size(matrix%column, kind=i8), matrix%row_start, &
         matrix%column, matrix%value
      close (unit)
   end subroutine dump_matrix

   !> Names of the columns
   subroutine print_header()
      write (output_unit, '(a)') 'nodes_per_side,unknowns,solver,threads,harmonics,order_s,'// &
         'analysis_s,assembly_parts_s,assembly_matrix_s,factorization_s,repeated_s,shared_s,solve_s,operations,'// &
         'gflops,dgemm_gflops,dgemm_fraction,factor_mb,factor_entries,backward_error,'// &
         'lapack_ratio,expected_s,processor_share,note'
   end subroutine print_header

   !> One line; what was not measured is empty
   subroutine print_record(record)
      !> The line
      type(record_type), intent(in) :: record

      character(len=:), allocatable :: line
      real(wp) :: speed

      speed = -1.0_wp
      if (record%factorization > 0.0_wp) speed = record%operations/record%factorization
      line = to_text(record%n_side)//','//to_text(record%n_unknowns)//','// &
             record%solver//','//to_text(record%n_threads)//','// &
             to_text(record%n_harmonics)//','//cell(record%order)//','//cell(record%analysis)//','// &
             cell(record%parts)//','//cell(record%matrix)//','//cell(record%factorization)//','// &
             cell(record%repeated)//','//cell(record%shared)//','// &
             cell(record%solution)//','//cell(record%operations)//','//cell(speed/1.0e9_wp)//','// &
             cell(record%rate/1.0e9_wp)//','//cell(speed/record%rate)//','// &
             cell(record%bytes/2.0_wp**20)//','//cell(record%entries)//','// &
             cell(record%backward_error)//','//cell(record%lapack_ratio)//','// &
             cell(record%expected)//','//cell(record%share)//','//record%note
      write (output_unit, '(a)') line
      flush (output_unit)
   end subroutine print_record

   !> A number that is not negative, or nothing
   function cell(value) result(text)
      !> The number
      real(wp), intent(in) :: value
      !> Its text
      character(len=:), allocatable :: text

      text = ''
      if (value >= 0.0_wp) text = to_text(value)
   end function cell

end program solvers
