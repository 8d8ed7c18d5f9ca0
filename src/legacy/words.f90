!> Cards of a new deck: lines that grow, values with commas
module axijoint_legacy_words
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   implicit none
   private
   public :: text_type, put, list, integers, exact

   !> Text that grows
   type :: text_type
      !> Its letters, and how many are used
      character(len=:), allocatable :: letters
      integer :: used = 0
   end type text_type

contains

   !> A number of a thing, and its values, with commas
   function list(values, number) result(text)
      !> The values
      real(wp), intent(in) :: values(:)
      !> The number
      integer, intent(in) :: number
      !> The words
      character(len=:), allocatable :: text

      integer :: k

      text = to_text(number)
      do k = 1, size(values)
         text = text//', '//exact(values(k))
      end do
   end function list

   !> Integers, each after a comma
   function integers(values) result(text)
      !> The values
      integer, intent(in) :: values(:)
      !> The words
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(values)
         text = text//', '//to_text(values(k))
      end do
   end function integers

   !> As few digits of a number as are read as the same number
   function exact(value) result(text)
      !> The number
      real(wp), intent(in) :: value
      !> Its digits
      character(len=:), allocatable :: text

      character(len=32) :: form, digits
      real(wp) :: again
      integer :: n, status

      do n = 1, 17
         write (form, '(a, i0, a)') '(es32.', n, 'e3)'
         write (digits, form) value + 0.0_wp  ! no negative zero
         read (digits, *, iostat=status) again
         if (status == 0 .and. .not. abs(again - value) > 0.0_wp) exit
      end do
      text = trim(adjustl(digits))
      n = index(text, 'E+000')
      if (n > 0) text = text(:n - 1)
   end function exact

   !> Add a line
   subroutine put(text, line)
      !> The text
      type(text_type), intent(inout) :: text
      !> The line
      character(len=*), intent(in) :: line

      character(len=:), allocatable :: larger

      if (.not. allocated(text%letters)) allocate (character(len=65536) :: text%letters)
      do while (text%used + len(line) + 1 > len(text%letters))
         allocate (character(len=2*len(text%letters)) :: larger)
         larger(:text%used) = text%letters(:text%used)
         call move_alloc(larger, text%letters)
      end do
      text%letters(text%used + 1:text%used + len(line) + 1) = line//new_line('a')
      text%used = text%used + len(line) + 1
   end subroutine put

end module axijoint_legacy_words
