!> Scalars, vectors and matrices as one list of values, and values as text
module axijoint_test_values
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: flat, to_text, index_text, trimmed, conformable

   !> All values of an array of rank 0, 1 or 2 in the order of storage
   interface flat
      module procedure :: flat_real, flat_integer, flat_long, flat_logical
   end interface flat

   !> A value as text that shows all its digits
   interface to_text
      module procedure :: real_text, integer_text, long_text, logical_text
   end interface to_text

contains

   !> Values of a real array
   function flat_real(array) result(values)
      !> Rank 0, 1 or 2
      real(wp), intent(in) :: array(..)
      !> The values
      real(wp), allocatable :: values(:)

      select rank (array)
      rank (0)
         values = [array]
      rank (1)
         values = array
      rank (2)
         values = reshape(array, [size(array)])
      rank default
         error stop 'assertions take arrays of rank 0, 1 and 2'
      end select
   end function flat_real

   !> Values of an integer array
   function flat_integer(array) result(values)
      !> Rank 0, 1 or 2
      integer, intent(in) :: array(..)
      !> The values
      integer(i8), allocatable :: values(:)

      select rank (array)
      rank (0)
         values = [int(array, i8)]
      rank (1)
         values = int(array, i8)
      rank (2)
         values = int(reshape(array, [size(array)]), i8)
      rank default
         error stop 'assertions take arrays of rank 0, 1 and 2'
      end select
   end function flat_integer

   !> Values of an array of long integers
   function flat_long(array) result(values)
      !> Rank 0, 1 or 2
      integer(i8), intent(in) :: array(..)
      !> The values
      integer(i8), allocatable :: values(:)

      select rank (array)
      rank (0)
         values = [array]
      rank (1)
         values = array
      rank (2)
         values = reshape(array, [size(array)])
      rank default
         error stop 'assertions take arrays of rank 0, 1 and 2'
      end select
   end function flat_long

   !> Values of a logical array
   function flat_logical(array) result(values)
      !> Rank 0, 1 or 2
      logical, intent(in) :: array(..)
      !> The values
      logical, allocatable :: values(:)

      select rank (array)
      rank (0)
         values = [array]
      rank (1)
         values = array
      rank (2)
         values = reshape(array, [size(array)])
      rank default
         error stop 'assertions take arrays of rank 0, 1 and 2'
      end select
   end function flat_logical

   !> A real with its 17 digits
   function real_text(value) result(text)
      !> Any real, NaN and infinities too
      real(wp), intent(in) :: value
      !> Its text
      character(len=:), allocatable :: text
      character(len=32) :: buffer

      write (buffer, '(es25.16e3)') value
      text = trim(adjustl(buffer))
   end function real_text

   !> An integer
   function integer_text(value) result(text)
      !> Any integer
      integer, intent(in) :: value
      !> Its text
      character(len=:), allocatable :: text

      text = long_text(int(value, i8))
   end function integer_text

   !> A long integer
   function long_text(value) result(text)
      !> Any long integer
      integer(i8), intent(in) :: value
      !> Its text
      character(len=:), allocatable :: text
      character(len=24) :: buffer

      write (buffer, '(i0)') value
      text = trim(buffer)
   end function long_text

   !> A truth value
   function logical_text(value) result(text)
      !> Any truth value
      logical, intent(in) :: value
      !> Its text
      character(len=:), allocatable :: text

      text = merge('true ', 'false', value)
      text = trim(text)
   end function logical_text

   !> The subscripts of a value in the list, as ` at (2,1)`; nothing for a scalar
   function index_text(position, extents) result(text)
      !> Place in the list of all values, from one
      integer, intent(in) :: position
      !> Shape of the array
      integer, intent(in) :: extents(:)
      !> The subscripts
      character(len=:), allocatable :: text

      text = ''
      select case (size(extents))
      case (1)
         text = ' at ('//to_text(position)//')'
      case (2)
         text = ' at ('//to_text(mod(position - 1, extents(1)) + 1)//',' &
            //to_text((position - 1)/extents(1) + 1)//')'
      end select
   end function index_text

   !> May an array of this shape be compared with one of that shape? A scalar always may.
   pure function conformable(expected, actual) result(fits)
      !> Shape of what is expected
      integer, intent(in) :: expected(:)
      !> Shape of what was found
      integer, intent(in) :: actual(:)
      !> True if so
      logical :: fits

      fits = size(expected) == 0
      if (.not. fits .and. size(expected) == size(actual)) fits = all(expected == actual)
   end function conformable

   !> A text without the blanks and tabs at its two ends
   pure function trimmed(text) result(core)
      !> Any text
      character(len=*), intent(in) :: text
      !> The part between the first and the last visible character
      character(len=:), allocatable :: core
      character(len=*), parameter :: white = ' '//achar(9)

      core = text(max(1, verify(text, white)):verify(text, white, back=.true.))
   end function trimmed

end module axijoint_test_values
