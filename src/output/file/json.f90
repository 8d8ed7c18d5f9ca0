!> Values of JSON (RFC 8259)
module axijoint_output_file_json
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, utf8_length
   implicit none
   private
   public :: json_string, json_number, known_number, json_integers, json_strings

   !> Decimal digits that bring back the same real
   character(len=*), parameter :: format_real = '(es24.16e3)'
   !> UTF-8 of the replacement character U+FFFD
   character(len=3), parameter :: replacement = char(239)//char(191)//char(189)

   !> A number
   interface json_number
      module procedure json_real, json_integer
   end interface json_number

contains

   !> A text in quotes. Control characters, quotes and backslashes are escaped;
   !> bytes that are not UTF-8 become the replacement character.
   pure function json_string(text) result(json)
      !> Any bytes
      character(len=*), intent(in) :: text
      !> The JSON string
      character(len=:), allocatable :: json

      character(len=6*len(text) + 2) :: buffer
      integer :: i, length, used

      buffer(1:1) = '"'
      used = 1
      i = 1
      do while (i <= len(text))
         length = utf8_length(text(i:))
         if (length == 0) then
            call append(buffer, used, replacement)
         else if (length == 1) then
            call append(buffer, used, escaped(text(i:i)))
         else
            call append(buffer, used, text(i:i + length - 1))
         end if
         i = i + max(length, 1)
      end do
      json = buffer(:used)//'"'
   end function json_string

   !> A real; null for what JSON has no word for
   pure function json_real(value) result(json)
      !> The number
      real(wp), intent(in) :: value
      !> The JSON number
      character(len=:), allocatable :: json

      character(len=24) :: buffer

      json = "null"
      if (.not. ieee_is_finite(value)) return
      write (buffer, format_real) value
      json = trim(adjustl(buffer))
   end function json_real

   !> A number that is null if it is not known
   pure function known_number(value) result(json)
      !> The number, negative if not known
      real(wp), intent(in) :: value
      !> The JSON number
      character(len=:), allocatable :: json

      json = "null"
      if (value >= 0.0_wp) json = json_number(value)
   end function known_number

   !> An integer
   pure function json_integer(value) result(json)
      !> The number
      integer, intent(in) :: value
      !> The JSON number
      character(len=:), allocatable :: json

      json = to_text(value)
   end function json_integer

   !> A list of integers
   pure function json_integers(values) result(json)
      !> The numbers
      integer, intent(in) :: values(:)
      !> The JSON array
      character(len=:), allocatable :: json

      integer :: i

      json = "["
      do i = 1, size(values)
         if (i > 1) json = json//", "
         json = json//json_integer(values(i))
      end do
      json = json//"]"
   end function json_integers

   !> A list of texts, trailing blanks cut
   pure function json_strings(texts) result(json)
      !> The texts
      character(len=*), intent(in) :: texts(:)
      !> The JSON array
      character(len=:), allocatable :: json

      integer :: i

      json = "["
      do i = 1, size(texts)
         if (i > 1) json = json//", "
         json = json//json_string(trim(texts(i)))
      end do
      json = json//"]"
   end function json_strings

   !> Add characters to a buffer
   pure subroutine append(buffer, used, text)
      !> The buffer, long enough
      character(len=*), intent(inout) :: buffer
      !> Characters used so far
      integer, intent(inout) :: used
      !> What to add
      character(len=*), intent(in) :: text

      buffer(used + 1:used + len(text)) = text
      used = used + len(text)
   end subroutine append

   !> An ASCII character as it stands in a JSON string
   pure function escaped(character) result(json)
      !> The character
      character(len=1), intent(in) :: character
      !> Itself or its escape
      character(len=:), allocatable :: json

      character(len=2) :: code

      select case (ichar(character))
      case (34, 92)
         json = achar(92)//character
      case (10)
         json = achar(92)//"n"
      case (0:9, 11:31, 127)
         write (code, '(z2.2)') ichar(character)
         json = achar(92)//"u00"//code
      case default
         json = character
      end select
   end function escaped

end module axijoint_output_file_json
