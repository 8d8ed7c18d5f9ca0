!> A text file as one string of bytes
module axijoint_deck_text_file_bytes
   use axijoint_base_system, only : path_kind, target_kind, path_absent, path_directory, &
      path_other, read_standard_input, error_text
   use axijoint_base_text, only : to_text
   use axijoint_base_whole_file, only : file_size, read_whole_file
   implicit none
   private
   public :: read_bytes, read_input_bytes, line_end, next_line, control_byte

   !> Ends of a line
   character(len=1), parameter :: carriage_return = achar(13), line_feed = achar(10)
   !> The bytes EF BB BF with which some editors begin a UTF-8 file
   character(len=3), parameter :: byte_order_mark = char(239)//char(187)//char(191)

contains

   !> Read a file whole; a byte order mark is left out
   subroutine read_bytes(path, bytes, failure)
      !> The file
      character(len=*), intent(in) :: path
      !> Its bytes; empty if it could not be read
      character(len=:), allocatable, intent(out) :: bytes
      !> What is wrong, empty if nothing
      character(len=:), allocatable, intent(out) :: failure

      integer :: errno

      bytes = ''
      failure = path_failure(path)
      if (len(failure) > 0) return
      if (file_size(path) > huge(0)) &
         failure = 'the file is larger than '//to_text(huge(0))//' bytes'
      if (len(failure) > 0) return
      call read_whole_file(path, bytes, errno)
      if (errno /= 0) failure = 'the file cannot be read: '//error_text(errno)
      if (len(failure) == 0 .and. index(bytes, byte_order_mark) == 1) bytes = bytes(4:)
      if (len(failure) == 0 .and. len(bytes) == 0) failure = 'the file is empty'
   end subroutine read_bytes

   !> Read the standard input to its end
   subroutine read_input_bytes(bytes, failure)
      !> Its bytes without a byte order mark; empty if it could not be read
      character(len=:), allocatable, intent(out) :: bytes
      !> What is wrong, empty if nothing
      character(len=:), allocatable, intent(out) :: failure

      integer :: errno

      failure = ''
      call read_standard_input(bytes, errno)
      if (errno /= 0) then
         failure = 'the standard input cannot be read: '//error_text(errno)
         bytes = ''
      else if (len(bytes) == 0) then
         failure = 'nothing came from the standard input'
      else if (index(bytes, byte_order_mark) == 1) then
         bytes = bytes(4:)
      end if
   end subroutine read_input_bytes

   !> What keeps a path from being read as a file; empty if nothing does
   function path_failure(path) result(failure)
      !> The path
      character(len=*), intent(in) :: path
      !> What is wrong
      character(len=:), allocatable :: failure

      failure = ''
      if (len_trim(path) == 0) then
         failure = 'the path is empty'
      else if (path_kind(path) == path_absent) then
         failure = 'there is no such file'
      else if (target_kind(path) == path_absent) then
         failure = 'this is a link that leads to no file'
      else if (target_kind(path) == path_directory) then
         failure = 'this is a directory, not a file'
      else if (target_kind(path) == path_other) then
         failure = 'this is not a regular file'
      end if
   end function path_failure

   !> Last byte of the line that begins at a place, without its end
   pure integer function line_end(bytes, first) result(last)
      !> The file
      character(len=*), intent(in) :: bytes
      !> First byte of the line
      integer, intent(in) :: first

      last = scan(bytes(first:), carriage_return//line_feed)
      if (last == 0) then
         last = len(bytes)
      else
         last = first + last - 2
      end if
   end function line_end

   !> First byte of the line after one; CR, LF and CR LF end a line
   pure integer function next_line(bytes, last) result(first)
      !> The file
      character(len=*), intent(in) :: bytes
      !> Last byte of the line
      integer, intent(in) :: last

      first = last + 2
      if (first > len(bytes)) return
      if (bytes(last + 1:first) == carriage_return//line_feed) first = first + 1
   end function next_line

   !> Place of the first byte that no text has: a control character other than
   !> tab and line ends; 0 if there is none
   pure integer function control_byte(bytes) result(place)
      !> The file
      character(len=*), intent(in) :: bytes

      integer :: code

      do place = 1, len(bytes)
         code = iachar(bytes(place:place))
         if (code == 127 .or. (code < 32 .and. code /= 9 .and. code /= 10 .and. code /= 13)) return
      end do
      place = 0
   end function control_byte

end module axijoint_deck_text_file_bytes
