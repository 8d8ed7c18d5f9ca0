!> Symmetric matrices in single precision that are multiplied with many vectors: half of one is kept, laid out for
!> that
module axijoint_linalg_symmetric_single
   use, intrinsic :: iso_c_binding, only : c_float, c_int, c_intptr_t, c_loc
   use axijoint_base_kinds, only : sp, i8
   implicit none
   private
   public :: symmetric_single_type, make_room, put_column, symmetric_product

   !> Rows are a multiple of these and columns of those; bytes that what is read at once begins at a multiple of
   integer, parameter :: rows_together = 16, columns_together = 8
   integer(c_intptr_t), parameter :: alignment = 64

   !> The matrix
   type :: symmetric_single_type
      private
      !> Its size, and where its first column begins
      integer :: n = 0
      integer(i8) :: first = 1
      !> Columns to the diagonal, that halved, and zeros, in groups of so many as are taken together
      real(sp), allocatable :: values(:)
   end type symmetric_single_type

   interface
      !> What some columns and what mirrors them give to y = a x, by so many rows at once at most
      pure subroutine c_product(most, from, to, a, x, y) bind(c, name="axijoint_symmetric_product")
         import :: c_int, c_float
         integer(c_int), value :: most, from, to
         real(c_float), intent(in) :: a(*), x(*)
         real(c_float), intent(inout) :: y(*)
      end subroutine c_product
   end interface

contains

   !> Room for a matrix, all columns of which are to be put; that of a matrix before it, if it is large enough
   subroutine make_room(matrix, n)
      !> The matrix
      type(symmetric_single_type), intent(inout), target :: matrix
      !> Its size
      integer, intent(in) :: n

      integer(i8) :: needed
      integer :: j, n_columns

      matrix%n = n
      n_columns = multiple(n, columns_together)
      needed = start(n_columns + 1) + alignment
      if (allocated(matrix%values)) then
         if (size(matrix%values, kind=i8) < needed) deallocate (matrix%values)
      end if
      if (.not. allocated(matrix%values)) allocate (matrix%values(needed))
      matrix%first = 1 + modulo(-transfer(c_loc(matrix%values), 0_c_intptr_t), alignment)/(storage_size(0.0_sp)/8)
      do j = n + 1, n_columns
         associate (from => matrix%first + start(j))
            matrix%values(from:from + rows_of(j) - 1) = 0.0_sp
         end associate
      end do
   end subroutine make_room

   !> Put a column
   pure subroutine put_column(matrix, j, values)
      !> The matrix, with room
      type(symmetric_single_type), intent(inout) :: matrix
      !> Place of the column
      integer, intent(in) :: j
      !> Its numbers from the first row to the diagonal
      real(sp), intent(in) :: values(:)

      associate (from => matrix%first + start(j))
         matrix%values(from:from + j - 2) = values(:j - 1)
         matrix%values(from + j - 1) = 0.5_sp*values(j)
         matrix%values(from + j:from + rows_of(j) - 1) = 0.0_sp
      end associate
   end subroutine put_column

   !> Product with a vector, or one of two parts of it that take as long as each other and whose sum it is
   pure subroutine symmetric_product(matrix, x, y, at_once, part)
      !> The matrix
      type(symmetric_single_type), intent(in) :: matrix
      !> The vector, and the product
      real(sp), intent(in) :: x(:)
      real(sp), intent(out) :: y(:)
      !> Rows that are taken at once at most; as many as the processor takes if absent
      integer, intent(in), optional :: at_once
      !> 1 or 2
      integer, intent(in), optional :: part

      integer :: most, from, to
      real(sp), dimension(multiple(matrix%n, rows_together)) :: whole_x, whole_y

      most = rows_together
      if (present(at_once)) most = at_once
      from = 0
      to = matrix%n
      if (present(part)) then
         associate (middle => nint(sqrt(0.5)*matrix%n)/rows_together*rows_together)
            if (part == 1) to = middle
            if (part == 2) from = middle
         end associate
      end if
      whole_x(:matrix%n) = x
      whole_x(matrix%n + 1:) = 0.0_sp
      call c_product(most, from, to, matrix%values(matrix%first + start(from + 1):), whole_x, whole_y)
      y(:to) = whole_y(:to)
      y(to + 1:) = 0.0_sp
   end subroutine symmetric_product

   !> Numbers before a column
   pure integer(i8) function start(j)
      !> Its place
      integer, intent(in) :: j

      integer(i8) :: twos, groups

      ! groups of eight columns have 16, 16, 32, 32, 48, ... rows
      groups = (j - 1)/columns_together
      twos = groups/2
      start = columns_together*rows_together*(twos + 1)*(twos + modulo(groups, 2_i8)) &
         + modulo(j - 1, columns_together)*int(rows_of(j), i8)
   end function start

   !> Rows of a column: zeros are put from its diagonal on
   pure integer function rows_of(j)
      !> Its place
      integer, intent(in) :: j

      rows_of = multiple(multiple(j, columns_together), rows_together)
   end function rows_of

   !> The next multiple
   pure integer function multiple(n, of)
      !> Any number, and what it is to be a multiple of
      integer, intent(in) :: n, of

      multiple = (n + of - 1)/of*of
   end function multiple

end module axijoint_linalg_symmetric_single
