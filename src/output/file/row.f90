!> A row of a long table, put together column by column in place
module axijoint_output_file_row
   use axijoint_base_digits, only : put_digits
   use axijoint_base_kinds, only : wp, i8
   use axijoint_output_file_columns, only : put_columns
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: row_type

   !> Characters that a row has room for
   integer, parameter :: longest = 256

   !> The row: `begin`, any number of columns, `put`; or some more columns behind those that are
   !> the same in the rows before: `cut`
   type :: row_type
      private
      !> Characters, of which so many are in use
      character(len=longest) :: text
      integer :: used = 0
   contains
      !> Nothing stands in it
      procedure :: begin
      !> Integers, right-justified
      procedure :: integers
      !> Reals, as `columns` shows them
      procedure :: reals
      !> Any text
      procedure :: words
      !> Number of characters in use, and these
      procedure :: length
      procedure :: all => all_characters
      !> Drop what stands behind so many characters
      procedure :: cut
      !> Write it as a line of a file
      procedure :: put => put_row
   end type row_type

contains

   !> Nothing stands in it
   pure subroutine begin(self)
      !> The row
      class(row_type), intent(inout) :: self

      self%used = 0
   end subroutine begin

   !> Add integers, right-justified as by Fortran's format I: stars where one has no room
   pure subroutine integers(self, values, width)
      !> The row
      class(row_type), intent(inout) :: self
      !> The integers
      integer, intent(in) :: values(:)
      !> Columns of each
      integer, intent(in) :: width

      integer :: i

      do i = 1, size(values)
         call put_integer(values(i), self%text(self%used + 1:self%used + width))
         self%used = self%used + width
      end do
   end subroutine integers

   !> Add reals
   pure subroutine reals(self, values, width)
      !> The row
      class(row_type), intent(inout) :: self
      !> The numbers
      real(wp), intent(in) :: values(:)
      !> Columns of each, from 11 to 24
      integer, intent(in) :: width

      integer :: before

      before = self%used
      self%used = before + size(values)*width
      call put_columns(values, width, self%text(before + 1:self%used))
   end subroutine reals

   !> Add a text
   pure subroutine words(self, text)
      !> The row
      class(row_type), intent(inout) :: self
      !> The text
      character(len=*), intent(in) :: text

      self%text(self%used + 1:self%used + len(text)) = text
      self%used = self%used + len(text)
   end subroutine words

   !> Characters in use
   pure integer function length(self)
      !> The row
      class(row_type), intent(in) :: self

      length = self%used
   end function length

   !> The characters in use
   pure function all_characters(self) result(text)
      !> The row
      class(row_type), intent(in) :: self
      !> The characters
      character(len=self%used) :: text

      text = self%text(:self%used)
   end function all_characters

   !> Drop what stands behind so many characters
   pure subroutine cut(self, n)
      !> The row
      class(row_type), intent(inout) :: self
      !> Characters that stay
      integer, intent(in) :: n

      self%used = min(self%used, n)
   end subroutine cut

   !> Write it as a line of a file
   subroutine put_row(self, file)
      !> The row
      class(row_type), intent(in) :: self
      !> The file
      class(text_file_type), intent(inout) :: file

      call file%put(self%text(:self%used))
   end subroutine put_row

   !> Write an integer
   pure subroutine put_integer(value, text)
      !> The integer
      integer, intent(in) :: value
      !> Takes it, right-justified
      character(len=*), intent(out) :: text

      integer(i8) :: left
      integer :: first

      text = ''
      left = abs(int(value, i8))
      first = len(text)
      do while (left > 9_i8)
         left = left/10_i8
         first = first - 1
      end do
      if (first < merge(2, 1, value < 0)) then
         text = repeat('*', len(text))
         return
      end if
      call put_digits(abs(int(value, i8)), text(first:))
      if (value < 0) text(first - 1:first - 1) = '-'
   end subroutine put_integer

end module axijoint_output_file_row
