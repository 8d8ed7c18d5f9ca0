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
   public :: inverse_norm

   !> Most columns of the inverse that are looked at
   integer, parameter :: most_columns = 4

contains

   !> Estimate of the 1-norm of the inverse of a factored symmetric matrix, from below:
   !> columns of the inverse, each where the gradient of the norm is largest (Hager), and a vector
   !> of alternating signs (N. J. Higham, ACM Trans. Math. Software 14, 1988, algorithm 4.1)
   function inverse_norm(factor) result(norm)
      !> The factor
      class(factor_type), intent(in) :: factor
      !> The estimate; zero without equations
      real(wp) :: norm

      real(wp), allocatable :: x(:, :), signs(:)
      real(wp) :: before
      integer :: i, column, last, n

      n = factor%n
      norm = 0.0_wp
      if (n == 0) return
      allocate (x(n, 1), source=1.0_wp/n)
      call factor%solve(x)
      norm = sum(abs(x))
      if (n == 1) return
      column = 0
      do i = 1, most_columns
         signs = sign(1.0_wp, x(:, 1))
         x(:, 1) = signs
         call factor%solve(x)
         last = column
         column = maxloc(abs(x(:, 1)), 1)
         if (last > 0) then
            if (abs(x(last, 1)) >= abs(x(column, 1))) exit
         end if
         x = 0.0_wp
         x(column, 1) = 1.0_wp
         call factor%solve(x)
         before = norm
         norm = max(before, sum(abs(x)))
         if (norm <= before .or. all(x(:, 1)*signs >= 0.0_wp)) exit
      end do
      x(:, 1) = [((1.0_wp + real(i - 1, wp)/(n - 1))*merge(1, -1, mod(i, 2) == 1), i=1, n)]
      call factor%solve(x)
      norm = max(norm, 2.0_wp*sum(abs(x))/(3.0_wp*n))
   end function inverse_norm

end module axijoint_solver_inverse_norm
