!> Cholesky factors of small band matrices, many of them: column by column, so that the inner loops
!> run over neighbouring numbers, without the cost of a call of LAPACK; and of matrices of one shape
!> some at once, which lie number beside number, so that every operation is one of a whole register
module axijoint_linalg_band_cholesky
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: factor_band, solve_band, n_lanes, factor_bands, solve_bands, solve_with_one

   !> Matrices that are worked on at once
   integer, parameter :: n_lanes = 8

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

   !> Factor some matrices of one shape: the same numbers as by `factor_band` one by one
   pure subroutine factor_bands(n, width, a, failed)
      !> Order, and half-bandwidth
      integer, intent(in) :: n, width
      !> Lower triangles: a(:, i - j, j) are the entries of row i and column j; then the factors
      real(wp), intent(inout) :: a(n_lanes, 0:width, n)
      !> Whether a pivot is not positive
      logical, intent(out) :: failed

      real(wp) :: v(n_lanes)
      integer :: i, j, k, last

      failed = .false.
      do j = 1, n
         if (.not. all(a(:, 0, j) > 0.0_wp)) then
            failed = .true.
            return
         end if
         v = sqrt(a(:, 0, j))
         a(:, 0, j) = v
         last = min(width, n - j)
         do i = 1, last
            a(:, i, j) = a(:, i, j)/v
         end do
         do k = 1, last
            v = a(:, k, j)
            do i = k, last
               a(:, i - k, j + k) = a(:, i - k, j + k) - v*a(:, i, j)
            end do
         end do
      end do
   end subroutine factor_bands

   !> Solve with some factors of one shape: the same numbers as by `solve_band` one by one
   pure subroutine solve_bands(n, width, a, b)
      !> Order, and half-bandwidth
      integer, intent(in) :: n, width
      !> The factors
      real(wp), intent(in) :: a(n_lanes, 0:width, n)
      !> Right-hand sides, then solutions
      real(wp), intent(inout) :: b(n_lanes, n)

      real(wp) :: v(n_lanes)
      integer :: i, j, last

      do j = 1, n
         last = min(width, n - j)
         v = b(:, j)/a(:, 0, j)
         b(:, j) = v
         do i = 1, last
            b(:, j + i) = b(:, j + i) - v*a(:, i, j)
         end do
      end do
      do j = n, 1, -1
         last = min(width, n - j)
         v = 0.0_wp
         do i = 1, last
            v = v + a(:, i, j)*b(:, j + i)
         end do
         b(:, j) = (b(:, j) - v)/a(:, 0, j)
      end do
   end subroutine solve_bands

   !> Solve some systems with one factor: the same numbers as by `solve_band` one by one
   pure subroutine solve_with_one(n, width, a, b)
      !> Order, and half-bandwidth
      integer, intent(in) :: n, width
      !> The factor
      real(wp), intent(in) :: a(0:width, n)
      !> Right-hand sides, then solutions
      real(wp), intent(inout) :: b(n_lanes, n)

      real(wp) :: v(n_lanes)
      integer :: i, j, last

      do j = 1, n
         last = min(width, n - j)
         v = b(:, j)/a(0, j)
         b(:, j) = v
         do i = 1, last
            b(:, j + i) = b(:, j + i) - v*a(i, j)
         end do
      end do
      do j = n, 1, -1
         last = min(width, n - j)
         v = 0.0_wp
         do i = 1, last
            v = v + a(i, j)*b(:, j + i)
         end do
         b(:, j) = (b(:, j) - v)/a(0, j)
      end do
   end subroutine solve_with_one

end module axijoint_linalg_band_cholesky
