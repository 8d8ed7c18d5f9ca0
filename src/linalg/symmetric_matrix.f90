!> Symmetric sparse matrix, its lower triangle kept by rows
module axijoint_linalg_symmetric_matrix
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: symmetric_matrix_type, multiply, infinity_norm

   !> Lower triangle by rows (the upper triangle by columns); the columns of a
   !> row ascend, so that the diagonal is the last entry of each row
   type :: symmetric_matrix_type
      !> Order
      integer :: n = 0
      !> Position of the first entry of each row, shape (n + 1)
      integer(i8), allocatable :: row_start(:)
      !> Column of each entry
      integer, allocatable :: column(:)
      !> Value of each entry; not allocated for a pattern
      real(wp), allocatable :: value(:)
   end type symmetric_matrix_type

contains

   !> y = A x
   pure function multiply(matrix, x) result(y)
      !> A
      type(symmetric_matrix_type), intent(in) :: matrix
      !> x, shape (n)
      real(wp), intent(in) :: x(:)
      !> y, shape (n)
      real(wp) :: y(size(x))

      real(wp) :: row_sum
      integer(i8) :: k
      integer :: i, j

      y = 0.0_wp
      do i = 1, matrix%n
         row_sum = 0.0_wp
         do k = matrix%row_start(i), matrix%row_start(i + 1) - 2
            j = matrix%column(k)
            row_sum = row_sum + matrix%value(k)*x(j)
            y(j) = y(j) + matrix%value(k)*x(i)
         end do
         k = matrix%row_start(i + 1) - 1
         y(i) = y(i) + row_sum + matrix%value(k)*x(i)
      end do
   end function multiply

   !> Largest sum of absolute values in a row of the whole matrix
   pure function infinity_norm(pattern, value) result(norm)
      !> The pattern
      type(symmetric_matrix_type), intent(in) :: pattern
      !> Values of the entries
      real(wp), intent(in) :: value(:)
      !> The norm
      real(wp) :: norm

      real(wp), allocatable :: row_sum(:)
      integer(i8) :: k
      integer :: i

      allocate (row_sum(pattern%n), source=0.0_wp)
      do i = 1, pattern%n
         do k = pattern%row_start(i), pattern%row_start(i + 1) - 2
            row_sum(i) = row_sum(i) + abs(value(k))
            row_sum(pattern%column(k)) = row_sum(pattern%column(k)) + abs(value(k))
         end do
         row_sum(i) = row_sum(i) + abs(value(pattern%row_start(i + 1) - 1))
      end do
      norm = maxval([0.0_wp, row_sum])
   end function infinity_norm

end module axijoint_linalg_symmetric_matrix
