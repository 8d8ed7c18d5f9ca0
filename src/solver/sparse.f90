!> Supernodal sparse Cholesky solver by SuiteSparse's CHOLMOD
module axijoint_solver_sparse
   use, intrinsic :: iso_c_binding, only : c_ptr, c_null_ptr, c_associated, c_int, c_int32_t, &
                                           c_int64_t, c_double
   use axijoint_base_error, only : error_type, fatal_error, exit_memory
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_text, only : to_text
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type, judge_pivots
   implicit none
   private
   public :: sparse_solver_type

   !> Plan: supernodes of the order that the matrix comes in, postordered
   type, extends(solver_type) :: sparse_solver_type
      !> Handle of the symbolic factor
      type(c_ptr), private :: handle = c_null_ptr
   contains
      procedure :: analyse
      procedure :: factorize
      final :: free_solver
   end type sparse_solver_type

   !> Supernodal factor
   type, extends(factor_type) :: sparse_factor_type
      !> Handle of the numeric factor
      type(c_ptr), private :: handle = c_null_ptr
   contains
      procedure :: solve
      final :: free_factor
   end type sparse_factor_type

   interface
      !> Plan for a pattern
      function cholmod_analyse(n, start, column, entries, operations, bytes) result(handle) &
         bind(c, name='axijoint_cholmod_analyse')
         import :: c_ptr, c_int32_t, c_int64_t, c_double
         integer(c_int64_t), value :: n
         integer(c_int64_t), intent(in) :: start(*)
         integer(c_int32_t), intent(in) :: column(*)
         real(c_double), intent(out) :: entries, operations
         integer(c_int64_t), intent(out) :: bytes
         type(c_ptr) :: handle
      end function cholmod_analyse
      !> Factor of a matrix
      function cholmod_factorize(plan, start, column, value, diagonal, failed) result(handle) &
         bind(c, name='axijoint_cholmod_factorize')
         import :: c_ptr, c_int32_t, c_int64_t, c_double
         type(c_ptr), value :: plan
         integer(c_int64_t), intent(in) :: start(*)
         integer(c_int32_t), intent(in) :: column(*)
         real(c_double), intent(in) :: value(*)
         real(c_double), intent(out) :: diagonal(*)
         integer(c_int64_t), intent(out) :: failed
         type(c_ptr) :: handle
      end function cholmod_factorize
      !> Solve in place
      function cholmod_solve(handle, n_rhs, b) result(code) bind(c, name='axijoint_cholmod_solve')
         import :: c_ptr, c_int, c_int64_t, c_double
         type(c_ptr), value :: handle
         integer(c_int64_t), value :: n_rhs
         real(c_double), intent(inout) :: b(*)
         integer(c_int) :: code
      end function cholmod_solve
      !> Free a plan or a factor
      subroutine cholmod_free(handle) bind(c, name='axijoint_cholmod_free')
         import :: c_ptr
         type(c_ptr), value :: handle
      end subroutine cholmod_free
   end interface

contains

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
                                    entries, operations, self%factor_bytes)
      self%factor_entries = int(entries, i8)
      self%operations = operations
      if (c_associated(self%handle)) return
      call fatal_error(error, exit_memory, 'out of memory: analysis of a sparse matrix with '// &
                       to_text(pattern%n)//' equations')
   end subroutine analyse

   !> Factor a matrix
   subroutine factorize(self, matrix, factor, pivots, error)
      !> The plan
      class(sparse_solver_type), intent(in) :: self
      !> The matrix
      type(symmetric_matrix_type), intent(in) :: matrix
      !> Its factor
      class(factor_type), allocatable, intent(out) :: factor
      !> Pivots
      type(pivot_report_type), intent(out) :: pivots
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(sparse_factor_type), allocatable :: new
      real(wp) :: root(self%n)
      integer(c_int64_t) :: failed

      allocate (new)
      new%handle = cholmod_factorize(self%handle, matrix%row_start, matrix%column, matrix%value, &
                                     root, failed)
      pivots%equation = int(failed)
      if (c_associated(new%handle)) then
         if (failed == 0) call judge_pivots(matrix%value(matrix%row_start(2:) - 1), root, pivots)
         call move_alloc(new, factor)
      else
         call fatal_error(error, exit_memory, 'out of memory: a sparse factor needs '// &
                          to_text(int(self%factor_bytes/2**20))//' MiB')
      end if
   end subroutine factorize

   !> Solve for a block of right-hand sides
   subroutine solve(self, b)
      !> The factor
      class(sparse_factor_type), intent(in) :: self
      !> Right-hand sides, then solutions, shape (n, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      if (cholmod_solve(self%handle, size(b, 2, c_int64_t), b) /= 0) then
         error stop 'out of memory: solution with a sparse factor'
      end if
   end subroutine solve

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
