!> What every solver of symmetric positive definite systems offers
module axijoint_solver_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   implicit none
   private
   public :: solver_type, factor_type, pivot_report_type, judge_pivots

   !> A pivot below this share of the diagonal entry that it started from is
   !> rounding, so the matrix is singular to working precision. Cholesky
   !> loses about one unit of rounding a pivot; the limit lies above that and
   !> below the 1e-14 that a condition number of 1e14 may leave
   real(wp), parameter :: pivot_limit = 8.0_wp*epsilon(1.0_wp)

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
   end type solver_type

   !> Factor of one matrix
   type, abstract :: factor_type
   contains
      !> Solve for a block of right-hand sides
      procedure(solve_interface), deferred :: solve
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
      subroutine factorize_interface(self, matrix, factor, pivots, error)
         import :: solver_type, symmetric_matrix_type, factor_type, pivot_report_type, error_type
         !> The plan
         class(solver_type), intent(in) :: self
         !> Matrix of the pattern analysed
         type(symmetric_matrix_type), intent(in) :: matrix
         !> Its factor; of use only if no pivot failed
         class(factor_type), allocatable, intent(out) :: factor
         !> Pivots; a failed one is for the caller to put into words
         type(pivot_report_type), intent(out) :: pivots
         !> Out of memory
         type(error_type), allocatable, intent(out) :: error
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
