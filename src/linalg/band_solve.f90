!> Solution of many systems at once with a band Cholesky factor
module axijoint_linalg_band_solve
   use axijoint_base_kinds, only : wp
   use axijoint_linalg_lapack, only : dpbtrs, dtrsm, dgemm
   implicit none
   private
   public :: band_cholesky_solve

   !> Columns of the factor in a block
   integer, parameter :: block_size = 64
   !> Narrower bands, and fewer right-hand sides, gain nothing from blocks
   integer, parameter :: least_bandwidth = 16, least_right_hand_sides = 5

contains

   !> Solve with the factor of `band_cholesky`. LAPACK's dpbtrs takes one
   !> right-hand side after the other and reads the factor again for each; here
   !> every block of columns is read once and applied to all as matrix products.
   subroutine band_cholesky_solve(band, b)
      !> L(i, j) in band(1 + i - j, j), shape (1 + half-bandwidth, n)
      real(wp), intent(in), contiguous :: band(:, :)
      !> Right-hand sides, then solutions, shape (n, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      real(wp), allocatable :: below(:, :)
      integer :: first, n, width, block, info

      if (size(b) == 0) return
      n = size(band, 2)
      width = size(band, 1) - 1
      if (min(width, n) < least_bandwidth .or. size(b, 2) < least_right_hand_sides) then
         call dpbtrs('L', n, width, size(b, 2), band, width + 1, b, n, info)
         return
      end if
      block = min(block_size, width)
      allocate (below(width, block))
      do first = 1, n, block
         call eliminate(n, width, size(b, 2), band, first, min(block, n - first + 1), below, b)
      end do
      do first = first - block, 1, -block
         call substitute(n, width, size(b, 2), band, first, min(block, n - first + 1), below, b)
      end do
   end subroutine band_cholesky_solve

   !> Forward elimination of one block: b1 = L11^-1 b1, b2 = b2 - L21 b1. With one
   !> row less as its leading dimension, the band is a matrix with upright columns.
   subroutine eliminate(n, width, n_sides, band, first, columns, below, b)
      !> Order, half-bandwidth and number of right-hand sides
      integer, intent(in) :: n, width, n_sides
      !> The factor
      real(wp), intent(in) :: band(width + 1, n)
      !> First column of the block, and number of columns
      integer, intent(in) :: first, columns
      !> Work space
      real(wp), intent(inout), contiguous :: below(:, :)
      !> Right-hand sides
      real(wp), intent(inout) :: b(n, n_sides)

      integer :: rows

      call dtrsm('L', 'L', 'N', 'N', columns, n_sides, 1.0_wp, band(1, first), &
                 width, b(first, 1), n)
      call copy_below(band, first, columns, below, rows)
      if (rows > 0) then
         call dgemm('N', 'N', rows, n_sides, columns, -1.0_wp, below, width, &
                    b(first, 1), n, 1.0_wp, b(first + columns, 1), n)
      end if
   end subroutine eliminate

   !> Back substitution of one block: b1 = L11^-T (b1 - L21^T b2)
   subroutine substitute(n, width, n_sides, band, first, columns, below, b)
      !> Order, half-bandwidth and number of right-hand sides
      integer, intent(in) :: n, width, n_sides
      !> The factor
      real(wp), intent(in) :: band(width + 1, n)
      !> First column of the block, and number of columns
      integer, intent(in) :: first, columns
      !> Work space
      real(wp), intent(inout), contiguous :: below(:, :)
      !> Right-hand sides
      real(wp), intent(inout) :: b(n, n_sides)

      integer :: rows

      call copy_below(band, first, columns, below, rows)
      if (rows > 0) then
         call dgemm('T', 'N', columns, n_sides, rows, -1.0_wp, below, width, &
                    b(first + columns, 1), n, 1.0_wp, b(first, 1), n)
      end if
      call dtrsm('L', 'L', 'T', 'N', columns, n_sides, 1.0_wp, band(1, first), &
                 width, b(first, 1), n)
   end subroutine substitute

   !> The rows of a block of columns below its triangle, as a full matrix
   pure subroutine copy_below(band, first, columns, below, rows)
      !> The factor
      real(wp), intent(in), contiguous :: band(:, :)
      !> First column of the block, and number of columns
      integer, intent(in) :: first, columns
      !> The rows, shape (half-bandwidth, columns); zero outside the band
      real(wp), intent(inout), contiguous :: below(:, :)
      !> How many rows
      integer, intent(out) :: rows

      integer :: j, filled, width

      width = size(band, 1) - 1
      rows = min(width, size(band, 2) - first - columns + 1)
      do j = 1, columns
         filled = min(rows, width - columns + j)  ! column j ends there
         below(:filled, j) = band(columns - j + 2:columns - j + 1 + filled, first + j - 1)
         below(filled + 1:rows, j) = 0.0_wp
      end do
   end subroutine copy_below

end module axijoint_linalg_band_solve
