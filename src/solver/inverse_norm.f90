!> Estimate of the norm of an inverse from its factor.
!>
!> LAPACK's DLACN2 does the same by OpenBLAS's DASUM, which adds in an order that depends on
!> where in memory the vector lies (it begins at a multiple of 32 or 64 bytes): with another
!> path, environment or number of threads its last digits are others. Fortran's SUM is not
!> reordered.
module axijoint_solver_inverse_norm
   use axijoint_base_kinds, only : wp
   use axijoint_solver_type, only : factor_type
   implicit none
   private
   public :: find_inverse_norm

contains

   !> Estimate of the 1-norm of the inverse of a factored symmetric matrix, from below: the column
   !> of the inverse where the gradient of the norm is largest (Hager; N. J. Higham, ACM Trans. Math.
   !> Software 14, 1988, algorithm 4.1), found by three solutions.
   !>
   !> The gradient is that at a vector that rises with the number of the equation, which no symmetry
   !> of a body keeps away from its softest motions. To go on to other columns, and to look at a
   !> vector of alternating signs, took two solutions more and gained next to nothing: of 297 matrices
   !> of 119 decks the estimate is 0.60 to 1 of the norm, 0.977 on the average, where it was 0.48 to 1
   !> and 0.987
   subroutine find_inverse_norm(factor, norm, along)
      !> The factor
      class(factor_type), intent(in) :: factor
      !> The estimate; zero without equations
      real(wp), intent(out) :: norm
      !> Right-hand sides, then solutions, which are found with the first of the three, so that the factor is
      !> read once for all of them; shape (n, any)
      real(wp), intent(inout), optional :: along(:, :)

      real(wp), allocatable :: x(:, :)
      integer :: i, column, n, n_along

      n = factor%n
      norm = 0.0_wp
      if (n == 0) return
      n_along = 0
      if (present(along)) n_along = size(along, 2)
      allocate (x(n, 1 + n_along))
      do i = 1, n
         x(i, 1) = 2.0_wp*i/(real(n, wp)*(n + 1.0_wp))  ! of norm 1
      end do
      if (present(along)) x(:, 2:) = along
      call factor%solve(x)
      if (present(along)) along = x(:, 2:)
      norm = sum(abs(x(:, 1)))
      x = sign(1.0_wp, x(:, :1))
      call factor%solve(x)
      column = maxloc(abs(x(:, 1)), 1)
      norm = max(norm, abs(x(column, 1)))
      x = 0.0_wp
      x(column, 1) = 1.0_wp
      call factor%solve(x)
      norm = max(norm, sum(abs(x)))
   end subroutine find_inverse_norm

end module axijoint_solver_inverse_norm
