!> Numbers as text, letter case, words that resemble each other, names of files
module axijoint_base_text
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: to_text, utf8_length, put_integer, percent_text, fine_percent, lower, upper, count_of, edit_distance, nearest_word, &
      did_you_mean, name_of, list_of

   !> A number as text without blanks
   interface to_text
      module procedure integer_text
      module procedure long_text
      module procedure real_text
   end interface to_text

   !> Distance between capital and small letters in the ASCII table
   integer, parameter :: case_shift = iachar('a') - iachar('A')

contains

   ! Functions here call none that give a text of any length: gfortran keeps that length in one place for all threads, and
   ! two of them write the listing and the arrays at the same time

   !> An integer in as many characters as it has
   pure function integer_text(value) result(text)
      !> The integer
      integer, intent(in) :: value
      !> Its digits and sign
      character(len=:), allocatable :: text

      call put_integer(int(value, i8), text)
   end function integer_text

   !> A long integer in as many characters as it has
   pure function long_text(value) result(text)
      !> The integer
      integer(i8), intent(in) :: value
      !> Its digits and sign
      character(len=:), allocatable :: text

      call put_integer(value, text)
   end function long_text

   !> The same as a subroutine, for what several threads may say at once
   pure subroutine put_integer(value, text)
      !> The integer
      integer(i8), intent(in) :: value
      !> Its digits and sign
      character(len=:), allocatable, intent(out) :: text

      character(len=20) :: buffer

      write (buffer, '(i0)') value
      text = trim(buffer)
   end subroutine put_integer

   !> A real with six significant digits, trailing zeros dropped: 0.5, 20000,
   !> 1.25E-5
   pure function real_text(value) result(text)
      !> The real
      real(wp), intent(in) :: value
      !> Its text
      character(len=:), allocatable :: text

      call put_real(value, text)
   end function real_text

   !> The same as a subroutine
   pure subroutine put_real(value, text)
      !> The real
      real(wp), intent(in) :: value
      !> Its text
      character(len=:), allocatable, intent(out) :: text

      integer, parameter :: n_digits = 6
      character(len=16) :: buffer
      character(len=n_digits) :: digits
      character(len=:), allocatable :: power
      integer :: exponent, last

      if (.not. ieee_is_finite(value)) then
         text = 'not finite'
         return
      else if (.not. abs(value) > 0.0_wp) then
         text = '0'
         return
      end if
      write (buffer, '(es14.5e4)') abs(value)
      buffer = adjustl(buffer)
      digits = buffer(1:1)//buffer(3:7)
      read (buffer(9:13), '(i5)') exponent
      last = max(1, verify(digits, '0', back=.true.))
      if (exponent < -4 .or. exponent > n_digits) then
         call put_integer(int(exponent, i8), power)
         text = digits(1:1)
         if (last > 1) text = text//'.'//digits(2:last)
         text = text//'E'//power
      else if (exponent < 0) then
         text = '0.'//repeat('0', -exponent - 1)//digits(:last)
      else if (last <= exponent + 1) then
         text = digits(:last)//repeat('0', exponent + 1 - last)
      else
         text = digits(:exponent + 1)//'.'//digits(exponent + 2:last)
      end if
      if (value < 0.0_wp) text = '-'//text
   end subroutine put_real

   !> A share in per cent with three significant digits: 12.3 %
   pure function percent_text(share) result(text)
      !> The share
      real(wp), intent(in) :: share
      !> Its text
      character(len=:), allocatable :: text

      character(len=16) :: buffer
      real(wp) :: rounded

      rounded = 100.0_wp*share
      if (ieee_is_finite(rounded)) then
         write (buffer, '(es16.2e4)') rounded
         read (buffer, '(es16.2e4)') rounded
      end if
      call put_real(rounded, text)
      text = text//' %'
   end function percent_text

   !> Small letters
   pure function lower(text)
      !> Any text
      character(len=*), intent(in) :: text
      !> The text with ASCII capitals made small
      character(len=len(text)) :: lower

      integer :: i

      lower = text
      do i = 1, len(text)
         if (text(i:i) >= 'A' .and. text(i:i) <= 'Z') then
            lower(i:i) = achar(iachar(text(i:i)) + case_shift)
         end if
      end do
   end function lower

   !> Capital letters
   pure function upper(text)
      !> Any text
      character(len=*), intent(in) :: text
      !> The text with small ASCII letters made capital
      character(len=len(text)) :: upper

      integer :: i

      upper = text
      do i = 1, len(text)
         if (text(i:i) >= 'a' .and. text(i:i) <= 'z') then
            upper(i:i) = achar(iachar(text(i:i)) - case_shift)
         end if
      end do
   end function upper

   !> A number and its noun: "1 node", "2 nodes"
   pure function count_of(number, noun) result(text)
      !> How many
      integer, intent(in) :: number
      !> Noun in the singular; its plural ends in s, or in ies instead of y
      character(len=*), intent(in) :: noun
      !> Number and noun
      character(len=:), allocatable :: text

      call put_integer(int(number, i8), text)
      text = text//' '//noun
      if (number == 1) return
      text = text//'s'
      if (noun(len(noun):) == 'y') text = text(:len(text) - 2)//'ies'
   end function count_of

   !> Numbers with commas between them, the first few if there are more
   pure function list_of(numbers, most) result(text)
      !> The numbers, and how many are named
      integer, intent(in) :: numbers(:), most
      !> The list
      character(len=:), allocatable :: text

      character(len=:), allocatable :: number
      integer :: k

      text = ''
      do k = 1, min(size(numbers), most)
         call put_integer(int(numbers(k), i8), number)
         if (k > 1) text = text//', '
         text = text//number
      end do
      if (size(numbers) > most) text = text//', ...'
   end function list_of

   !> Fewest insertions, deletions, replacements and exchanges of neighbours
   !> that turn one word into another (optimal string alignment)
   pure integer function edit_distance(a, b)
      !> The words
      character(len=*), intent(in) :: a, b

      integer :: d(0:len(a), 0:len(b)), i, j, cost

      d(:, 0) = [(i, i=0, len(a))]
      d(0, :) = [(j, j=0, len(b))]
      do j = 1, len(b)
         do i = 1, len(a)
            cost = merge(0, 1, a(i:i) == b(j:j))
            d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, d(i - 1, j - 1) + cost)
            if (exchanged(a(:i), b(:j))) d(i, j) = min(d(i, j), d(max(i - 2, 0), max(j - 2, 0)) + 1)
         end do
      end do
      edit_distance = d(len(a), len(b))
   end function edit_distance

   !> Whether two words end in the same two letters in opposite order
   pure logical function exchanged(a, b)
      !> The words
      character(len=*), intent(in) :: a, b

      exchanged = len(a) > 1 .and. len(b) > 1
      if (exchanged) exchanged = a(len(a):) == b(len(b) - 1:len(b) - 1) &
                                 .and. a(len(a) - 1:len(a) - 1) == b(len(b):)
   end function exchanged

   !> Index of the choice that a misspelt word most likely means: at most one slip in three
   !> letters, or else the only one that begins with the word; 0 if none resembles it. Letter case
   !> is ignored
   pure integer function nearest_word(word, choices)
      !> The word
      character(len=*), intent(in) :: word
      !> Correct words
      character(len=*), intent(in) :: choices(:)

      integer, parameter :: shortest_beginning = 3
      integer :: i, distance, least
      logical :: begins(size(choices))

      nearest_word = 0
      least = max(1, len_trim(word)/3) + 1
      do i = 1, size(choices)
         begins(i) = index(upper(choices(i)), upper(trim(word))) == 1
         distance = edit_distance(upper(trim(word)), upper(trim(choices(i))))
         if (distance < least .and. distance < len_trim(choices(i))) then
            least = distance
            nearest_word = i
         end if
      end do
      if (nearest_word > 0 .or. len_trim(word) < shortest_beginning) return
      if (count(begins) == 1) nearest_word = findloc(begins, .true., 1)
   end function nearest_word

   !> A question for a misspelt word; empty if no choice resembles it
   pure function did_you_mean(word, choices) result(question)
      !> The word
      character(len=*), intent(in) :: word
      !> Correct words
      character(len=*), intent(in) :: choices(:)
      !> The question
      character(len=:), allocatable :: question

      integer :: nearest

      question = ''
      nearest = nearest_word(word, choices)
      if (nearest > 0) question = 'did you mean '//trim(choices(nearest))//'?'
   end function did_you_mean

   !> A small share in per cent, two digits
   pure function fine_percent(value) result(text)
      !> The share
      real(wp), intent(in) :: value
      !> Such as 0.12 %
      character(len=:), allocatable :: text

      character(len=12) :: number

      write (number, '(es8.1)') 100.0_wp*value
      if (100.0_wp*value >= 0.01_wp .and. value < 10.0_wp) write (number, '(f12.2)') 100.0_wp*value
      text = trim(adjustl(number))//" %"
   end function fine_percent

   !> A path without its folders
   pure function name_of(path) result(name)
      !> The path
      character(len=*), intent(in) :: path
      !> Name of the file
      character(len=:), allocatable :: name

      name = path(index(path, '/', back=.true.) + 1:)
   end function name_of

   !> Bytes of the UTF-8 character that a text begins with; 0 if it is none
   !> (Unicode standard, table 3-7)
   pure integer function utf8_length(text) result(length)
      !> At least one byte
      character(len=*), intent(in) :: text

      integer :: first, second, i

      first = ichar(text(1:1))
      length = 0
      select case (first)
      case (0:127)
         length = 1
      case (194:223)
         length = 2
      case (224:239)
         length = 3
      case (240:244)
         length = 4
      end select
      if (length <= 1) return
      if (length > len(text)) then
         length = 0
         return
      end if
      second = ichar(text(2:2))
      if (first == 224 .and. second < 160) length = 0
      if (first == 237 .and. second > 159) length = 0
      if (first == 240 .and. second < 144) length = 0
      if (first == 244 .and. second > 143) length = 0
      do i = 2, length
         if (iand(ichar(text(i:i)), 192) /= 128) then
            length = 0
            return
         end if
      end do
   end function utf8_length

end module axijoint_base_text
