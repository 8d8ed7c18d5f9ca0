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

   !> Estimate of the 1-norm of the inverse of a factored symmetric matrix, from below, as Hager's (N. J. Higham,
   !> ACM Trans. Math. Software 14, 1988, algorithm 4.1), but with two passes of the factor in place of three. The
   !> first solves for a vector that rises with the number of the equation, which no symmetry of a body keeps away
   !> from its softest motions. The second solves for the gradient of the norm there, none of whose parts is above
   !> one, so that the largest of its solution is a bound, too: the matrix is symmetric; and for the unknown that the
   !> first moved most, a column of the inverse.
   !> Hager's column is that of the largest part of the gradient's solution.
   subroutine find_inverse_norm(factor, norm, along)
      !> The factor
      class(factor_type), intent(in) :: factor
      !> The estimate; zero without equations
      real(wp), intent(out) :: norm
      !> Right-hand sides, then solutions, which are found in the first pass, so that the factor is
      !> read once for all of them; shape (n, any)
      real(wp), intent(inout), optional :: along(:, :)

      real(wp), allocatable :: x(:, :)
      integer :: i, moved, n, n_along

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
      moved = maxloc(abs(x(:, 1)), 1)
      x = reshape([sign(1.0_wp, x(:, 1)), (0.0_wp, i=1, n)], [n, 2])
      x(moved, 2) = 1.0_wp
      call factor%solve(x)
      norm = max(norm, maxval(abs(x(:, 1))), sum(abs(x(:, 2))))
   end subroutine find_inverse_norm

end module axijoint_solver_inverse_norm
