!> Lines that are recognised by their words
module axijoint_compare_read_pattern
   implicit none
   private
   public :: captures_type, match_pattern, find_capture, next_word

   !> Most parameters that are kept
   integer, parameter :: most = 32

   !> Parameters found in headings
   type :: captures_type
      !> Number of parameters
      integer :: n = 0
      !> Their names
      character(len=32) :: name(most) = ''
      !> Their texts
      character(len=32) :: text(most) = ''
   end type captures_type

contains

   !> Whether a line begins with the words of a pattern; how many blanks are between them does not
   !> matter. {name} in a word stands for any text. A pattern that begins with ... may stand
   !> anywhere in the line
   pure subroutine match_pattern(line, pattern, captures, found)
      !> The line
      character(len=*), intent(in) :: line
      !> The pattern
      character(len=*), intent(in) :: pattern
      !> Parameters, added to those that are there
      type(captures_type), intent(inout) :: captures
      !> Whether it matches
      logical, intent(out) :: found

      type(captures_type) :: trial
      integer :: start, first, last

      found = .false.
      start = 1
      call next_word(line, start, first, last)
      if (first == 0 .or. len(pattern) == 0) return
      if (scan(pattern(1:1), '.{'//line(first:first)) == 0) return  ! most lines end here
      trial = captures
      if (index(pattern, '...') /= 1) then
         call match_words(line, pattern, trial, found)
      else
         do
            call next_word(line, start, first, last)
            found = .false.
            if (first == 0) return
            trial = captures
            call match_words(line(first:), pattern(4:), trial, found)
            if (found) exit
            start = last + 1
         end do
      end if
      if (found) captures = trial
   end subroutine match_pattern

   !> Whether the first words of a line are those of a pattern
   pure subroutine match_words(line, pattern, captures, found)
      !> The line and the pattern
      character(len=*), intent(in) :: line, pattern
      !> Parameters
      type(captures_type), intent(inout) :: captures
      !> Whether they are
      logical, intent(out) :: found

      integer :: i, j, first, last, first_word, last_word

      i = 1
      j = 1
      found = .true.
      do
         call next_word(pattern, i, first, last)
         if (first == 0) return
         call next_word(line, j, first_word, last_word)
         found = first_word > 0
         if (found) &
            call match_word(line(first_word:last_word), pattern(first:last), captures, found)
         if (.not. found) return
         i = last + 1
         j = last_word + 1
      end do
   end subroutine match_words

   !> Whether a word is as a pattern says
   pure subroutine match_word(word, pattern, captures, found)
      !> The word and the pattern
      character(len=*), intent(in) :: word, pattern
      !> Parameters
      type(captures_type), intent(inout) :: captures
      !> Whether it is
      logical, intent(out) :: found

      integer :: i, j, closing, n

      i = 1
      j = 1
      found = .false.
      do while (j <= len(pattern))
         closing = 0
         if (pattern(j:j) == '{') closing = index(pattern(j:), '}')
         if (closing > 0) then
            closing = j + closing - 1
            n = len(word) - i + 1
            if (closing < len(pattern)) n = index(word(i:), pattern(closing + 1:closing + 1)) - 1
            if (n < 1) return
            call capture(captures, pattern(j + 1:closing - 1), word(i:i + n - 1))
            i = i + n
            j = closing + 1
         else
            if (i > len(word)) return
            if (word(i:i) /= pattern(j:j)) return
            i = i + 1
            j = j + 1
         end if
      end do
      found = i > len(word)
   end subroutine match_word

   !> Keep a parameter; a new value replaces an old one
   pure subroutine capture(captures, name, text)
      !> Parameters
      type(captures_type), intent(inout) :: captures
      !> Name and text
      character(len=*), intent(in) :: name, text

      integer :: k

      k = find_capture(captures, name)
      if (k == 0) then
         if (captures%n == most) return
         captures%n = captures%n + 1
         k = captures%n
      end if
      captures%name(k) = name
      captures%text(k) = text
   end subroutine capture

   !> Index of a parameter; 0 if it is not there
   pure integer function find_capture(captures, name) result(found)
      !> Parameters
      type(captures_type), intent(in) :: captures
      !> Name
      character(len=*), intent(in) :: name

      do found = captures%n, 1, -1
         if (captures%name(found) == name) return
      end do
   end function find_capture

   !> Columns of the next word of a text; 0, 0 if there is none
   pure subroutine next_word(text, start, first, last)
      !> The text
      character(len=*), intent(in) :: text
      !> Where to begin
      integer, intent(in) :: start
      !> The word
      integer, intent(out) :: first, last

      character(len=*), parameter :: blanks = ' '//achar(9)

      first = 0
      last = 0
      if (start > len(text)) return
      first = verify(text(start:), blanks)
      if (first == 0) return
      first = start + first - 1
      last = scan(text(first:), blanks)
      last = merge(len(text), first + last - 2, last == 0)
   end subroutine next_word

end module axijoint_compare_read_pattern
