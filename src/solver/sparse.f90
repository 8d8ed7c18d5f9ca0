!> Supernodal sparse Cholesky solver by SuiteSparse's CHOLMOD
module axijoint_solver_sparse
   use, intrinsic :: iso_c_binding, only : c_ptr, c_null_ptr, c_associated, c_int, c_int32_t, &
                                           c_int64_t, c_double
   use axijoint_base_error, only : error_type, memory_error
   use axijoint_base_kinds, only : wp, i8
   use axijoint_linalg_symmetric_half, only : symmetric_half_type, put_in_order
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_order_orders, only : least_fill
   use axijoint_solver_entry, only : solver_entry_type, cost_type
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type, judge_pivots, &
                                    new_flexibility, flexibility_by_loads
   implicit none
   private
   public :: sparse_solver_type, sparse_entry

   !> Plan: supernodes of the order that the matrix comes in, postordered
   type, extends(solver_type) :: sparse_solver_type
      !> Handle of the symbolic factor
      type(c_ptr), private :: handle = c_null_ptr
   contains
      procedure :: analyse
      procedure :: factorize
      procedure :: flexibility_operations
      final :: free_solver
   end type sparse_solver_type

   !> Supernodal factor
   type, extends(factor_type) :: sparse_factor_type
      !> Handle of the numeric factor
      type(c_ptr), private :: handle = c_null_ptr
   contains
      procedure :: solve
      procedure :: flexibility
      final :: free_factor
   end type sparse_factor_type

   interface
      !> Plan for a pattern
      function cholmod_analyse(n, start, column, entries, operations, plan_bytes, bytes, work_bytes) result(handle) &
         bind(c, name='axijoint_cholmod_analyse')
         import :: c_ptr, c_int32_t, c_int64_t, c_double
         integer(c_int64_t), value :: n
         integer(c_int64_t), intent(in) :: start(*)
         integer(c_int32_t), intent(in) :: column(*)
         real(c_double), intent(out) :: entries, operations
         integer(c_int64_t), intent(out) :: plan_bytes, bytes, work_bytes
         type(c_ptr) :: handle
      end function cholmod_analyse
      !> Factor of a matrix, in the memory of an old one if that is not null, or in new memory,
      !> in large pages if `large` is not zero
      function cholmod_factorize(plan, old, large, value, diagonal, failed) result(handle) &
         bind(c, name='axijoint_cholmod_factorize')
         import :: c_ptr, c_int, c_int64_t, c_double
         type(c_ptr), value :: plan, old
         integer(c_int), value :: large
         real(c_double), intent(in) :: value(*)
         real(c_double), intent(out) :: diagonal(*)
         integer(c_int64_t), intent(out) :: failed
         type(c_ptr) :: handle
      end function cholmod_factorize
      !> Solve in place
      subroutine cholmod_solve(handle, n_rhs, b) bind(c, name='axijoint_cholmod_solve')
         import :: c_ptr, c_int64_t, c_double
         type(c_ptr), value :: handle
         integer(c_int64_t), value :: n_rhs
         real(c_double), intent(inout) :: b(*)
      end subroutine cholmod_solve
      !> The flexibility under loads on two equations, half of which is kept
      function cholmod_flexibility(handle, n_loads, equation, factor, half, place) result(code) &
         bind(c, name='axijoint_cholmod_flexibility')
         import :: c_ptr, c_int, c_int32_t, c_int64_t, c_double
         type(c_ptr), value :: handle
         integer(c_int64_t), value :: n_loads
         integer(c_int32_t), intent(in) :: equation(*)
         real(c_double), intent(in) :: factor(*)
         real(c_double), intent(inout) :: half(*)
         integer(c_int32_t), intent(out) :: place(*)
         integer(c_int) :: code
      end function cholmod_flexibility
      !> Operations that this takes
      function cholmod_flexibility_operations(handle, n_loads, equation, factor) result(operations) &
         bind(c, name='axijoint_cholmod_flexibility_operations')
         import :: c_ptr, c_int32_t, c_int64_t, c_double
         type(c_ptr), value :: handle
         integer(c_int64_t), value :: n_loads
         integer(c_int32_t), intent(in) :: equation(*)
         real(c_double), intent(in) :: factor(*)
         real(c_double) :: operations
      end function cholmod_flexibility_operations
      !> Free a plan or a factor
      subroutine cholmod_free(handle) bind(c, name='axijoint_cholmod_free')
         import :: c_ptr
         type(c_ptr), value :: handle
      end subroutine cholmod_free
   end interface

contains

   !> Supernodal Cholesky on a nested dissection order
   pure function sparse_entry() result(entry)
      !> The solver
      type(solver_entry_type) :: entry

      entry%name = 'SPARSE'
      entry%new_plan => new_plan
      entry%order => least_fill
      entry%order_name = 'nested dissection (METIS)'
      entry%cost = cost_type(share=0.47_wp, kept_entry=2.3e-9_wp, passing_entry=1.8e-9_wp, &
         equation=2.0e-7_wp)
      entry%library_bytes = 2500000_i8  ! measured
   end function sparse_entry

   !> An empty plan
   subroutine new_plan(plan)
      !> The plan
      class(solver_type), allocatable, intent(out) :: plan

      allocate (sparse_solver_type :: plan)
   end subroutine new_plan

   !> Find the supernodes
   subroutine analyse(self, pattern, error)
      !> The plan
      class(sparse_solver_type), intent(inout) :: self
      !> Pattern of the lower triangle
      type(symmetric_matrix_type), intent(in) :: pattern
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      real(c_double) :: entries, operations

      call free_solver(self)
      self%n = pattern%n
      self%handle = cholmod_analyse(int(pattern%n, c_int64_t), pattern%row_start, pattern%column, &
                                    entries, operations, self%plan_bytes, self%factor_bytes, &
                                    self%work_bytes)
      self%factor_entries = int(entries, i8)
      self%operations = operations
      if (c_associated(self%handle)) return
      call memory_error(error, 'analysis of a sparse matrix with', int(pattern%n, i8), 'equations')
   end subroutine analyse

   !> Factor a matrix
   subroutine factorize(self, pattern, value, factor, pivots, error, passing)
      !> The plan
      class(sparse_solver_type), intent(in) :: self
      !> The pattern analysed
      type(symmetric_matrix_type), intent(in) :: pattern
      !> Values of the matrix
      real(wp), intent(in), contiguous :: value(:)
      !> Its factor; one of this plan that is given is overwritten
      class(factor_type), allocatable, intent(inout) :: factor
      !> Pivots
      type(pivot_report_type), intent(out) :: pivots
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Whether other factors will follow in the memory of this one
      logical, intent(in), optional :: passing

      type(sparse_factor_type), allocatable :: new
      real(wp) :: root(self%n)
      integer(c_int64_t) :: failed
      integer(c_int) :: large

      large = 0
      if (present(passing)) large = merge(1_c_int, 0_c_int, passing)
      allocate (new)
      new%n = self%n
      if (allocated(factor)) call take_memory(factor, new)
      new%handle = cholmod_factorize(self%handle, new%handle, large, value, root, failed)
      pivots%equation = int(failed)
      if (c_associated(new%handle)) then
         if (failed == 0) call judge_pivots(value(pattern%row_start(2:) - 1), root, pivots)
         call move_alloc(new, factor)
      else
         call memory_error(error, 'a sparse factor needs', self%factor_bytes, 'bytes')
      end if
   end subroutine factorize

   !> Take the memory of a factor that is no longer needed
   subroutine take_memory(old, new)
      !> The factor, of the same plan; deallocated
      class(factor_type), allocatable, intent(inout) :: old
      !> Takes its handle
      type(sparse_factor_type), intent(inout) :: new

      select type (old)
      type is (sparse_factor_type)
         new%handle = old%handle
         old%handle = c_null_ptr
      end select
      deallocate (old)
   end subroutine take_memory

   !> Solve for a block of right-hand sides
   subroutine solve(self, b)
      !> The factor
      class(sparse_factor_type), intent(in) :: self
      !> Right-hand sides, then solutions, shape (n, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      call cholmod_solve(self%handle, size(b, 2, c_int64_t), b)
   end subroutine solve

   !> Operations of finding the flexibility up the elimination tree
   real(wp) function flexibility_operations(self, equation, factor) result(operations)
      !> The plan, analysed
      class(sparse_solver_type), intent(in) :: self
      !> Both equations of each load, and what acts on them, shape (2, loads)
      integer, intent(in) :: equation(:, :)
      real(wp), intent(in) :: factor(:, :)

      operations = cholmod_flexibility_operations(self%handle, size(equation, 2, c_int64_t), equation, factor)
      if (operations < 0.0_wp) operations = huge(1.0_wp)  ! no memory for it
   end function flexibility_operations

   !> E^T K^-1 E of loads E, up the elimination tree; by solutions if the matrix does not couple two equations of a load
   subroutine flexibility(self, equation, factor, room, matrix, error)
      !> The factor
      class(sparse_factor_type), intent(in) :: self
      !> The two equations that each load acts on, and what acts there, shape (2, loads)
      integer, intent(in) :: equation(:, :)
      real(wp), intent(in) :: factor(:, :)
      !> Memory that one after the other takes: for the flexibility in the order of the tree
      type(symmetric_half_type), intent(inout) :: room
      !> One row a load
      type(symmetric_half_type), allocatable, intent(out) :: matrix
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: place(size(equation, 2))

      call new_flexibility(room, size(place), error)
      if (allocated(error)) return
      select case (cholmod_flexibility(self%handle, size(place, kind=c_int64_t), equation, factor, room%values, place))
      case (0)
         allocate (matrix)
         call new_flexibility(matrix, size(place), error)
         if (.not. allocated(error)) call put_in_order(room, place, matrix)
      case (1)
         call memory_error(error, 'the flexibility under', size(place, kind=i8), 'loads')
      case default
         call flexibility_by_loads(self, equation, factor, room, matrix, error)
      end select
   end subroutine flexibility

   !> Free the symbolic factor
   subroutine free_solver(self)
      !> The plan
      type(sparse_solver_type), intent(inout) :: self

      call cholmod_free(self%handle)
      self%handle = c_null_ptr
   end subroutine free_solver

   !> Free the numeric factor
   subroutine free_factor(self)
      !> The factor
      type(sparse_factor_type), intent(inout) :: self

      call cholmod_free(self%handle)
      self%handle = c_null_ptr
   end subroutine free_factor

end module axijoint_solver_sparse
