!> Words and numbers of a text file, line by line, with their places
module axijoint_gmsh_scanner
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_text, only : to_text, lower
   use axijoint_gmsh_decimal, only : divide_real
   implicit none
   private
   public :: scanner_type, fault_type, new_scanner, next_line, next_token, read_integer, &
      read_real, &
      end_line, line_fault, token_fault, line_bounds, token_text, largest_tag

   !> What is wrong with a file: the first fault ends the reading
   type :: fault_type
      !> Line; 0 for the file as a whole
      integer :: line = 0
      !> Columns of the text at fault; 0 for the whole line
      integer :: first = 0, last = 0
      !> What is wrong, what is allowed, how to mend it; the last two may be empty
      character(len=:), allocatable :: text, allowed, mend
   end type fault_type

   !> A file and the place that has been reached
   type :: scanner_type
      !> All bytes
      character(len=:), allocatable :: bytes
      !> Number of the current line; 0 before the first
      integer :: line = 0
      !> First and last byte of the line, without its end
      integer :: first = 1, last = 0
      !> First and last byte of the last word; none if to < from
      integer :: from = 1, to = 0
      !> First byte of the next line
      integer :: next = 1
   end type scanner_type

   !> Largest number of a node or an element
   integer, parameter :: largest_tag = 999999999
   !> Coordinates of larger magnitude are refused
   real(wp), parameter :: largest_real = 1.0e30_wp
   !> Ends of a line, and blanks
   character(len=1), parameter :: carriage_return = achar(13), line_feed = achar(10), tab = achar(9)
   !> Powers of ten that a real of 64 bits holds exactly, and digits that it always holds
   integer, parameter :: exact_power = 22, exact_digits = 15

contains

   !> A scanner before the first line of a file
   pure function new_scanner(bytes) result(scanner)
      !> The file
      character(len=*), intent(in) :: bytes
      !> The scanner
      type(scanner_type) :: scanner

      scanner%bytes = bytes
   end function new_scanner

   !> Go to the next line that is not blank
   pure subroutine next_line(scanner, found)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> False at the end of the file; then the last line stays
      logical, intent(out) :: found

      integer :: first, last, line, next

      next = scanner%next
      line = scanner%line
      found = .false.
      do while (next <= len(scanner%bytes))
         first = next
         line = line + 1
         call end_of_line(scanner%bytes, first, last, next)
         if (verify(scanner%bytes(first:last), ' '//tab) == 0) cycle
         scanner%line = line
         scanner%first = first
         scanner%last = last
         scanner%to = first - 1
         scanner%from = first
         found = .true.
         exit
      end do
      scanner%next = next
   end subroutine next_line

   !> End of a line, and beginning of the next one; CR, LF and CR LF end a line
   pure subroutine end_of_line(bytes, first, last, next)
      !> The file
      character(len=*), intent(in) :: bytes
      !> First byte of the line
      integer, intent(in) :: first
      !> Its last byte, and the first of the next line
      integer, intent(out) :: last, next

      last = scan(bytes(first:), carriage_return//line_feed)
      if (last == 0) last = len(bytes) - first + 2
      last = first + last - 2
      next = last + 2
      if (next > len(bytes)) return
      if (bytes(last + 1:next) == carriage_return//line_feed) next = next + 1
   end subroutine end_of_line

   !> First and last byte of a line
   pure subroutine line_bounds(bytes, line, first, last)
      !> The file
      character(len=*), intent(in) :: bytes
      !> Number of the line
      integer, intent(in) :: line
      !> Bytes; last < first if the file has no such line
      integer, intent(out) :: first, last

      integer :: i, next

      first = 1
      last = 0
      next = 1
      do i = 1, line
         if (next > len(bytes)) then
            last = first - 1
            return
         end if
         first = next
         call end_of_line(bytes, first, last, next)
      end do
   end subroutine line_bounds

   !> Go to the next word of the line
   pure subroutine next_token(scanner)
      !> The scanner; to < from if the line has no more words
      type(scanner_type), intent(inout) :: scanner

      scanner%from = scanner%to + 1
      do while (scanner%from <= scanner%last)
         if (.not. is_blank(scanner%bytes(scanner%from:scanner%from))) exit
         scanner%from = scanner%from + 1
      end do
      scanner%to = scanner%from - 1
      do while (scanner%to < scanner%last)
         if (is_blank(scanner%bytes(scanner%to + 1:scanner%to + 1))) exit
         scanner%to = scanner%to + 1
      end do
   end subroutine next_token

   !> Whether a character separates words
   pure logical function is_blank(character)
      !> The character
      character(len=1), intent(in) :: character
      is_blank = character == ' ' .or. character == tab
   end function is_blank

   !> The last word
   pure function token_text(scanner) result(text)
      !> The scanner
      type(scanner_type), intent(in) :: scanner
      !> The word
      character(len=:), allocatable :: text
      text = scanner%bytes(scanner%from:scanner%to)
   end function token_text

   !> Read the next word of the line as an integer. Nothing is done after a fault
   pure subroutine read_integer(scanner, name, low, high, value, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> What is read, for messages
      character(len=*), intent(in) :: name
      !> Range
      integer, intent(in) :: low, high
      !> The value; `low` if there is a fault
      integer, intent(out) :: value
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer(i8) :: number
      integer :: i, digits, first

      value = low
      if (allocated(fault)) return
      call next_token(scanner)
      if (scanner%to < scanner%from) then
         fault = line_fault(scanner, name//' is lacking at the end of the line')
         return
      end if
      first = scanner%from
      if (scan(scanner%bytes(first:first), '+-') == 1) first = first + 1
      number = 0
      do i = first, scanner%to
         digits = iachar(scanner%bytes(i:i)) - iachar('0')
         if (digits < 0 .or. digits > 9) exit
         if (number <= largest_tag) number = 10*number + digits
      end do
      if (i <= scanner%to .or. first > scanner%to) then
         fault = token_fault(scanner, name//' is not an integer')
         return
      end if
      if (scanner%bytes(scanner%from:scanner%from) == '-') number = -number
      if (number < low .or. number > high) then
         fault = token_fault(scanner, name//' is out of range', &
                             allowed='an integer, '//to_text(low)//' to '//to_text(high))
         return
      end if
      value = int(number)
   end subroutine read_integer

   !> Read the next word of the line as a real. Nothing is done after a fault
   pure subroutine read_real(scanner, name, value, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> What is read, for messages
      character(len=*), intent(in) :: name
      !> The value; 0 if there is a fault
      real(wp), intent(out) :: value
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer(i8) :: mantissa
      integer :: digits, exponent, status
      logical :: good

      value = 0.0_wp
      if (allocated(fault)) return
      call next_token(scanner)
      if (scanner%to < scanner%from) then
         fault = line_fault(scanner, name//' is lacking at the end of the line')
         return
      end if
      associate (token => scanner%bytes(scanner%from:scanner%to))
         call divide_real(token, mantissa, digits, exponent, good)
         if (.not. good) then
            fault = token_fault(scanner, name//' is not a number')
            if (any(lower(token(max(1, verify(token, '+-')):)) == ['nan     ', 'inf     ', &
               'infinity'])) then
               fault%text = name//' is not a finite number'
            end if
         else if (mantissa == 0) then
            return
         else if (digits + exponent > range(value)) then
            fault = token_fault(scanner, name//' is too large', allowed='magnitudes up to 1E30')
         else if (digits + exponent < -range(value)) then
            return  ! nearer to zero than a real can be
         else if (digits <= exact_digits .and. abs(exponent) <= exact_power) then
            ! Both numbers are exact, so that one operation rounds once.
            if (exponent < 0) value = real(mantissa, wp)/10.0_wp**(-exponent)
            if (exponent >= 0) value = real(mantissa, wp)*10.0_wp**exponent
            if (token(1:1) == '-') value = -value
         else
            read (token, *, iostat=status) value
         end if
      end associate
      if (allocated(fault)) return
      if (abs(value) > largest_real) then
         fault = token_fault(scanner, name//' is too large', allowed='magnitudes up to 1E30')
      end if
   end subroutine read_real

   !> See that the line has no more words. Nothing is done after a fault
   pure subroutine end_line(scanner, allowed, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> What the line should hold
      character(len=*), intent(in) :: allowed
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      if (allocated(fault)) return
      call next_token(scanner)
      if (scanner%to < scanner%from) return
      fault = token_fault(scanner, 'the line has too many values', allowed=allowed)
   end subroutine end_line

   !> A fault of the current line
   pure function line_fault(scanner, text, allowed, mend) result(fault)
      !> The scanner
      type(scanner_type), intent(in) :: scanner
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What is allowed, how to mend it
      character(len=*), intent(in), optional :: allowed, mend
      !> The fault
      type(fault_type) :: fault

      fault%line = scanner%line
      fault%text = text
      fault%allowed = ''
      fault%mend = ''
      if (present(allowed)) fault%allowed = allowed
      if (present(mend)) fault%mend = mend
   end function line_fault

   !> A fault of the last word
   pure function token_fault(scanner, text, allowed, mend) result(fault)
      !> The scanner
      type(scanner_type), intent(in) :: scanner
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What is allowed, how to mend it
      character(len=*), intent(in), optional :: allowed, mend
      !> The fault
      type(fault_type) :: fault

      fault = line_fault(scanner, text, allowed, mend)
      fault%first = scanner%from - scanner%first + 1
      fault%last = scanner%to - scanner%first + 1
   end function token_fault

end module axijoint_gmsh_scanner
