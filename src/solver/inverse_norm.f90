!> Estimate of the norm of an inverse from its factor.
!>
!> LAPACK's DLACN2 does the same by OpenBLAS's DASUM, which adds in an order that depends on
!> where in memory the vector lies (it begins at a multiple of 32 or 64 bytes): with another
!> path, environment or number of threads its last digits are others. Fortran's SUM is not
!> reordered.
module axijoint_solver_inverse_norm
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: first_side, second_sides, inverse_norm

contains

   !> Right-hand side of the first of two solutions from which the 1-norm of the inverse of a symmetric matrix is
   !> estimated, from below, as by Hager (N. J. Higham, ACM Trans. Math. Software 14, 1988, algorithm 4.1), but with two
   !> passes of the factor in place of three, each of which may serve other right-hand sides, too. It rises with the
   !> number of the equation: no symmetry of a body keeps such a vector away from its softest motions
   pure function first_side(n) result(x)
      !> Number of equations
      integer, intent(in) :: n
      !> The vector, of norm 1
      real(wp) :: x(n)

      integer :: i

      x = [(2.0_wp*i/(real(n, wp)*(n + 1.0_wp)), i=1, n)]
   end function first_side

   !> Right-hand sides of the second: the gradient of the norm there, none of whose parts is above one, so that the
   !> largest part of its solution is a bound, too: the matrix is symmetric; and the unknown that the first moved most,
   !> which gives a column of the inverse. Hager's column is that of the largest part of the gradient's solution
   pure function second_sides(first) result(x)
      !> Solution for the first
      real(wp), intent(in) :: first(:)
      !> The vectors
      real(wp) :: x(size(first), 2)

      x(:, 1) = sign(1.0_wp, first)
      x(:, 2) = 0.0_wp
      if (size(first) > 0) x(maxloc(abs(first), 1), 2) = 1.0_wp
   end function second_sides

   !> The estimate
   pure real(wp) function inverse_norm(first, second)
      !> Solution for the first side, and those for the second
      real(wp), intent(in) :: first(:), second(:, :)

      inverse_norm = max(sum(abs(first)), maxval([0.0_wp, abs(second(:, 1))]), sum(abs(second(:, 2))))
   end function inverse_norm

end module axijoint_solver_inverse_norm
