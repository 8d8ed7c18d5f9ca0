!> What every solver of symmetric positive definite systems offers
module axijoint_solver_type
   use axijoint_base_error, only : error_type, memory_error
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : let_fail
   use axijoint_linalg_symmetric_half, only : symmetric_half_type, new_half, put_entry, half_numbers
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   implicit none
   private
   public :: solver_type, factor_type, pivot_report_type, judge_pivots
   public :: new_block, new_flexibility, flexibility_by_loads

   !> A pivot below this share of the diagonal entry that it started from is
   !> rounding, so the matrix is singular to working precision. Cholesky
   !> loses about one unit of rounding a pivot; the limit lies above that and
   !> below the 1e-14 that a condition number of 1e14 may leave
   real(wp), parameter :: pivot_limit = 8.0_wp*epsilon(1.0_wp)

   !> Right-hand sides solved at once for a flexibility
   integer, parameter :: block_size = 64
   !> Right-hand sides of which each has the same bits as if it were alone, whatever the solver
   integer, parameter :: few = 4
   !> Solutions for unit loads run at a lower rate than other matrix products: an operation counts as so many
   real(wp), parameter :: for_unit_loads = 1.75_wp

   !> Where a factorization broke down, and how near it came to that
   type :: pivot_report_type
      !> Zero, or the equation whose pivot is not positive
      integer :: equation = 0
      !> Smallest ratio of a pivot to its diagonal entry
      real(wp) :: smallest = huge(1.0_wp)
   end type pivot_report_type

   !> Plan for all matrices of one sparsity pattern
   type, abstract :: solver_type
      !> Order of the matrices
      integer :: n = 0
      !> Bytes of the plan itself, for as long as it lives
      integer(i8) :: plan_bytes = 0
      !> Bytes that a factorization takes besides, and gives back
      integer(i8) :: work_bytes = 0
      !> Bytes that one factor takes
      integer(i8) :: factor_bytes = 0
      !> Entries of one factor, zeros stored among them left out
      integer(i8) :: factor_entries = 0
      !> Floating-point operations of one factorization
      real(wp) :: operations = 0.0_wp
   contains
      !> Plan for a pattern
      procedure(analyse_interface), deferred :: analyse
      !> Factor a matrix of that pattern
      procedure(factorize_interface), deferred :: factorize
      !> Operations of finding the flexibility under some loads
      procedure :: flexibility_operations => operations_by_loads
   end type solver_type

   !> Factor of one matrix
   type, abstract :: factor_type
      !> Order of the matrix
      integer :: n = 0
   contains
      !> Solve for a block of right-hand sides
      procedure(solve_interface), deferred :: solve
      !> The same, but a few at once: no bit of one depends on the others
      procedure :: solve_apart
      !> What loads on one or two equations do to each other
      procedure :: flexibility => flexibility_by_loads
   end type factor_type

   abstract interface
      !> Plan for a pattern
      subroutine analyse_interface(self, pattern, error)
         import :: solver_type, symmetric_matrix_type, error_type
         !> The plan
         class(solver_type), intent(inout) :: self
         !> Pattern of the lower triangle; values are not read
         type(symmetric_matrix_type), intent(in) :: pattern
         !> Out of memory
         type(error_type), allocatable, intent(out) :: error
      end subroutine analyse_interface

      !> Factor a matrix
      subroutine factorize_interface(self, pattern, value, factor, pivots, error, passing)
         import :: solver_type, symmetric_matrix_type, factor_type, pivot_report_type, error_type, &
            wp
         !> The plan
         class(solver_type), intent(in) :: self
         !> The pattern analysed; its own values are not read
         type(symmetric_matrix_type), intent(in) :: pattern
         !> Values of the matrix at the entries of the pattern
         real(wp), intent(in), contiguous :: value(:)
         !> Its factor; of use only if no pivot failed. A factor of this plan that is given
         !> is overwritten: its memory is used again
         class(factor_type), allocatable, intent(inout) :: factor
         !> Pivots; a failed one is for the caller to put into words
         type(pivot_report_type), intent(out) :: pivots
         !> Out of memory
         type(error_type), allocatable, intent(out) :: error
         !> Whether other factors will follow in the memory of this one. Large pages pay
         !> for such memory; for that of many factors at once they were measured to cost time
         logical, intent(in), optional :: passing
      end subroutine factorize_interface

      !> Solve
      subroutine solve_interface(self, b)
         import :: factor_type, wp
         !> The factor
         class(factor_type), intent(in) :: self
         !> Right-hand sides, then solutions, shape (n, any)
         real(wp), intent(inout), contiguous :: b(:, :)
      end subroutine solve_interface
   end interface

contains

   !> Solve for right-hand sides, a few at once, so that no bit of one depends on the others
   subroutine solve_apart(self, b)
      !> The factor
      class(factor_type), intent(in) :: self
      !> Right-hand sides, then solutions, shape (n, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      integer :: k

      do k = 1, size(b, 2), few
         call self%solve(b(:, k:min(k + few - 1, size(b, 2))))
      end do
   end subroutine solve_apart

   !> Operations of finding the flexibility by solutions
   real(wp) function operations_by_loads(self, equation, factor) result(operations)
      !> The plan, analysed
      class(solver_type), intent(in) :: self
      !> Both equations of each load, and what acts on them, as below
      integer, intent(in) :: equation(:, :)
      real(wp), intent(in) :: factor(:, :)

      associate (unused => factor)
      end associate
      operations = for_unit_loads*2.0_wp*size(equation, 2)*real(self%factor_entries, wp)
   end function operations_by_loads

   !> E^T K^-1 E of loads E by solutions. Solvers that know where loads are felt do better
   subroutine flexibility_by_loads(self, equation, factor, room, matrix, error)
      !> The factor
      class(factor_type), intent(in) :: self
      !> The two equations that each load acts on, and what acts there, shape (2, loads). A load on one equation has a factor of
      !> zero on any other
      integer, intent(in) :: equation(:, :)
      real(wp), intent(in) :: factor(:, :)
      !> Memory that one after the other may take
      type(symmetric_half_type), intent(inout) :: room
      !> One row a load
      type(symmetric_half_type), allocatable, intent(out) :: matrix
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: b(:, :)
      integer :: i, j, k, last

      associate (unused => room)
      end associate
      allocate (matrix)
      call new_flexibility(matrix, size(equation, 2), error)
      if (allocated(error)) return
      do k = 1, size(equation, 2), block_size
         last = min(k + block_size - 1, size(equation, 2))
         call new_block(b, self%n, last - k + 1, error)
         if (allocated(error)) return
         do j = k, last
            do i = 1, 2
               b(equation(i, j), j - k + 1) = b(equation(i, j), j - k + 1) + factor(i, j)
            end do
         end do
         call self%solve(b)
         do j = k, last
            do i = 1, j
               call put_entry(matrix, i, j, sum(factor(:, i)*b(equation(:, i), j - k + 1)))
            end do
         end do
      end do
   end subroutine flexibility_by_loads

   !> A flexibility of zeros, or words for an error
   subroutine new_flexibility(matrix, n, error)
      !> The flexibility; its memory is taken again if it has the size
      type(symmetric_half_type), intent(inout) :: matrix
      !> Loads
      integer, intent(in) :: n
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: stat

      call let_fail(.true.)
      call new_half(n, matrix, stat)
      call let_fail(.false.)
      if (stat /= 0) call memory_error(error, 'the flexibility of', half_numbers(n), 'numbers')
   end subroutine new_flexibility

   !> A block of zeros, or words for an error
   subroutine new_block(block, rows, columns, error)
      !> The block, shape (rows, columns)
      real(wp), allocatable, intent(out) :: block(:, :)
      !> Its shape
      integer, intent(in) :: rows, columns
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: stat

      call let_fail(.true.)
      allocate (block(rows, columns), stat=stat)
      call let_fail(.false.)
      if (stat == 0) then
         block = 0.0_wp
      else
         call memory_error(error, 'a block of', int(rows, i8)*columns, 'numbers')
      end if
   end subroutine new_block

   !> Compare each pivot with the diagonal entry that it started from
   pure subroutine judge_pivots(diagonal, root, pivots)
      !> Diagonal of the matrix
      real(wp), intent(in) :: diagonal(:)
      !> Diagonal of the factor: the roots of the pivots
      real(wp), intent(in) :: root(:)
      !> The verdict
      type(pivot_report_type), intent(inout) :: pivots

      integer :: i

      do i = 1, size(diagonal)
         associate (ratio => root(i)**2/diagonal(i))
            pivots%smallest = min(pivots%smallest, ratio)
            if (pivots%equation == 0 .and. .not. ratio > pivot_limit) pivots%equation = i
         end associate
      end do
   end subroutine judge_pivots

end module axijoint_solver_type
