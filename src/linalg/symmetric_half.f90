!> Full symmetric matrices of which half is kept: columns from the first row to the diagonal, in panels that have the rows of their
!> last column. Small ones are a panel, and kept as they are
module axijoint_linalg_symmetric_half
   use axijoint_base_kinds, only : wp, i8
   use axijoint_linalg_lapack, only : dgemm, dgemv, dsyrk, dsymv
   implicit none
   private
   public :: symmetric_half_type, new_half, half_numbers, entry, put_entry, before_column, whole_matrix, &
      add_squares, put_in_order, half_product, half_sparse_product

   !> Columns of a matrix up to which it is one panel, which is multiplied faster, and whose size does not count; columns of
   !> a panel of a larger one
   integer, parameter, public :: one_panel = 1536, panel_width = 256
   !> Rows of a panel that the cache holds while they are multiplied both ways
   integer, parameter :: rows_at_hand = 256
   !> Rows and columns that are brought to their places together
   integer, parameter :: tile = 16

   !> The matrix
   type :: symmetric_half_type
      !> Rows and columns
      integer :: n = 0
      !> Its panels, each with the rows of its last column; of the lower triangle at their ends nothing is read
      real(wp), allocatable :: values(:)
   end type symmetric_half_type

contains

   !> A matrix of zeros
   subroutine new_half(n, matrix, stat)
      !> Rows and columns
      integer, intent(in) :: n
      !> The matrix; its memory is taken again if it has the size
      type(symmetric_half_type), intent(inout) :: matrix
      !> Not 0 if there is no memory; that ends the program if absent
      integer, intent(out), optional :: stat

      if (present(stat)) stat = 0
      if (allocated(matrix%values)) then
         if (size(matrix%values, kind=i8) /= half_numbers(n)) deallocate (matrix%values)
      end if
      matrix%n = n
      if (.not. allocated(matrix%values)) then
         if (present(stat)) then
            allocate (matrix%values(half_numbers(n)), stat=stat)
            if (stat /= 0) return
         else
            allocate (matrix%values(half_numbers(n)))
         end if
      end if
      matrix%values = 0.0_wp
   end subroutine new_half

   !> Numbers that are kept of a matrix
   pure integer(i8) function half_numbers(n)
      !> Rows and columns
      integer, intent(in) :: n

      half_numbers = 0
      if (n > 0) half_numbers = before_column(n, n) + n
   end function half_numbers

   !> Columns before the panel of one
   pure integer function before_panel(n, j)
      !> Rows and columns of the matrix, and the column
      integer, intent(in) :: n, j

      before_panel = 0
      if (n > one_panel) before_panel = (j - 1)/panel_width*panel_width
   end function before_panel

   !> Columns up to the end of the panel of one
   pure integer function end_of_panel(n, j)
      !> Rows and columns of the matrix, and the column
      integer, intent(in) :: n, j

      end_of_panel = n
      if (n > one_panel) end_of_panel = min(n, before_panel(n, j) + panel_width)
   end function end_of_panel

   !> Numbers before a column
   pure integer(i8) function before_column(n, j)
      !> Rows and columns of the matrix, and the column
      integer, intent(in) :: n, j

      associate (before => int(before_panel(n, j), i8))
         before_column = before*(before + panel_width)/2 + (j - 1 - before)*end_of_panel(n, j)
      end associate
   end function before_column

   !> A number of the matrix
   pure real(wp) function entry(matrix, i, j)
      !> The matrix
      type(symmetric_half_type), intent(in) :: matrix
      !> Row and column, or the other way round
      integer, intent(in) :: i, j

      entry = matrix%values(before_column(matrix%n, max(i, j)) + min(i, j))
   end function entry

   !> Put a number into the matrix
   pure subroutine put_entry(matrix, i, j, value)
      !> The matrix
      type(symmetric_half_type), intent(inout) :: matrix
      !> Row and column, or the other way round
      integer, intent(in) :: i, j
      !> The number
      real(wp), intent(in) :: value

      matrix%values(before_column(matrix%n, max(i, j)) + min(i, j)) = value
   end subroutine put_entry

   !> All of a matrix
   pure function whole_matrix(matrix) result(whole)
      !> The matrix
      type(symmetric_half_type), intent(in) :: matrix
      !> The same, shape (n, n)
      real(wp), allocatable :: whole(:, :)

      integer :: i, j

      allocate (whole(matrix%n, matrix%n))
      do j = 1, matrix%n
         do i = 1, j
            whole(i, j) = entry(matrix, i, j)
            whole(j, i) = whole(i, j)
         end do
      end do
   end function whole_matrix

   !> Add what some vectors are multiplied by each other, x^T x, to neighbouring rows and columns
   subroutine add_squares(n, values, first, height, width, n_vectors, x)
      !> Rows and columns of the matrix, and its numbers
      integer, intent(in) :: n
      real(wp), intent(inout) :: values(*)
      !> The first of the rows and columns; numbers from one vector to the next, of each vector that count, and vectors
      integer, intent(in) :: first, height, width, n_vectors
      !> The vectors
      real(wp), intent(in) :: x(height, n_vectors)

      integer :: from, to, rows

      from = first
      do while (from < first + n_vectors)
         rows = end_of_panel(n, from)
         to = min(rows, first + n_vectors - 1)
         associate (column => before_column(n, from))
            if (from > first) call dgemm('T', 'N', from - first, to - from + 1, width, 1.0_wp, x, height, &
               x(1, from - first + 1), height, 1.0_wp, values(column + first), rows)
            call dsyrk('U', 'T', to - from + 1, width, 1.0_wp, x(1, from - first + 1), height, 1.0_wp, &
               values(column + from), rows)
         end associate
         from = to + 1
      end do
   end subroutine add_squares

   !> The same matrix in another order, tile by tile, which the cache holds
   subroutine put_in_order(matrix, place, ordered)
      !> The matrix
      type(symmetric_half_type), intent(in) :: matrix
      !> Place of each of its rows and columns in the other
      integer, intent(in) :: place(:)
      !> The other, with room
      type(symmetric_half_type), intent(inout) :: ordered

      integer(i8) :: before(size(place)), to
      integer :: from(size(place)), i, j, first, row

      from(place) = [(i, i=1, size(place))]
      before = [(before_column(matrix%n, j), j=1, size(place))]
      do first = 1, size(place), tile
         do row = 1, first, tile
            do j = first, min(first + tile - 1, size(place))
               to = before(j)
               do i = row, min(row + tile - 1, j)
                  ordered%values(to + i) = matrix%values(before(max(from(i), from(j))) + min(from(i), from(j)))
               end do
            end do
         end do
      end do
   end subroutine put_in_order

   !> Product with a vector: each number is read once
   subroutine half_product(matrix, x, y)
      !> The matrix
      type(symmetric_half_type), intent(in) :: matrix
      !> The vector and the product, n values in any shape
      real(wp), intent(in) :: x(*)
      real(wp), intent(inout) :: y(*)

      integer :: first, last, row, n_rows

      y(:matrix%n) = 0.0_wp
      first = 1
      do while (first <= matrix%n)
         last = end_of_panel(matrix%n, first)
         associate (column => before_column(matrix%n, first), width => last - first + 1)
            do row = 1, first - 1, rows_at_hand
               n_rows = min(rows_at_hand, first - row)
               call dgemv('N', n_rows, width, 1.0_wp, matrix%values(column + row), last, x(first), 1, 1.0_wp, y(row), 1)
               call dgemv('T', n_rows, width, 1.0_wp, matrix%values(column + row), last, x(row), 1, 1.0_wp, y(first), 1)
            end do
            call dsymv('U', width, 1.0_wp, matrix%values(column + first), last, x(first), 1, 1.0_wp, y(first), 1)
         end associate
         first = last + 1
      end do
   end subroutine half_product

   !> Product with a vector with long runs of zeros, whose rows and columns are not read
   subroutine half_sparse_product(matrix, x, y)
      !> The matrix
      type(symmetric_half_type), intent(in) :: matrix
      !> The vector, n values in any shape
      real(wp), intent(in) :: x(matrix%n)
      !> The product, the same
      real(wp), intent(inout) :: y(*)

      !> Zeros that end a run of others
      integer, parameter :: enough = 6
      integer :: first, last, next

      y(:matrix%n) = 0.0_wp
      first = next_one(1)
      do while (first <= size(x))
         last = first
         do
            next = next_one(last + 1)
            if (next > min(end_of_panel(matrix%n, first), last + enough)) exit
            last = next
         end do
         call add_run(matrix, first, last, x(first:last), y)
         first = next
      end do

   contains

      !> Place of the next value that is none, from a place on; beyond the end if there is none
      integer function next_one(from) result(place)
         !> The place
         integer, intent(in) :: from

         do place = from, size(x)
            if (abs(x(place)) > 0.0_wp) return
         end do
      end function next_one

   end subroutine half_sparse_product

   !> Add what neighbouring columns of one panel give to a product, and rows as far
   subroutine add_run(matrix, first, last, x, y)
      !> The matrix
      type(symmetric_half_type), intent(in) :: matrix
      !> The first and the last of the columns
      integer, intent(in) :: first, last
      !> Their values, and the product
      real(wp), intent(in) :: x(*)
      real(wp), intent(inout) :: y(*)

      integer :: from, to

      associate (n => matrix%n, width => last - first + 1, stride => end_of_panel(matrix%n, first), &
                 column => before_column(matrix%n, first))
         if (first > 1) call dgemv('N', first - 1, width, 1.0_wp, matrix%values(column + 1), stride, x, 1, 1.0_wp, y, 1)
         call dsymv('U', width, 1.0_wp, matrix%values(column + first), stride, x, 1, 1.0_wp, y(first), 1)
         from = last + 1
         do while (from <= n)
            to = end_of_panel(n, from)
            call dgemv('T', width, to - from + 1, 1.0_wp, matrix%values(before_column(n, from) + first), to, x, 1, 1.0_wp, &
               y(from), 1)
            from = to + 1
         end do
      end associate
   end subroutine add_run

end module axijoint_linalg_symmetric_half
