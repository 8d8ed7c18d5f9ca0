!> Cholesky factors of small band matrices, many of them: column by column, so that the inner loops
!> run over neighbouring numbers, without the cost of a call of LAPACK
module axijoint_linalg_band_cholesky
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: factor_band, solve_band

contains

   !> Factor a matrix
   pure subroutine factor_band(n, width, a, info)
      !> Order, and half-bandwidth
      integer, intent(in) :: n, width
      !> Lower triangle: a(i - j, j) is the entry of row i and column j; then the factor
      real(wp), intent(inout) :: a(0:width, n)
      !> Zero, or the row whose pivot is not positive
      integer, intent(out) :: info

      integer :: j, k, last

      do info = 1, n
         j = info
         if (.not. a(0, j) > 0.0_wp) return
         a(0, j) = sqrt(a(0, j))
         last = min(width, n - j)
         a(1:last, j) = a(1:last, j)/a(0, j)
         do k = 1, last
            a(0:last - k, j + k) = a(0:last - k, j + k) - a(k, j)*a(k:last, j)
         end do
      end do
      info = 0
   end subroutine factor_band

   !> Solve
   pure subroutine solve_band(n, width, a, b)
      !> Order, and half-bandwidth
      integer, intent(in) :: n, width
      !> The factor
      real(wp), intent(in) :: a(0:width, n)
      !> Right-hand side, then solution
      real(wp), intent(inout) :: b(n)

      integer :: j, last

      do j = 1, n
         last = min(width, n - j)
         b(j) = b(j)/a(0, j)
         b(j + 1:j + last) = b(j + 1:j + last) - b(j)*a(1:last, j)
      end do
      do j = n, 1, -1
         last = min(width, n - j)
         b(j) = (b(j) - dot_product(a(1:last, j), b(j + 1:j + last)))/a(0, j)
      end do
   end subroutine solve_band

end module axijoint_linalg_band_cholesky
