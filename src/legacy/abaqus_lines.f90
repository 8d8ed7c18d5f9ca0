!> Lines of an input file of Abaqus or CalculiX: keywords with parameters, data with commas
module axijoint_legacy_abaqus_lines
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, upper
   use axijoint_deck_text_diagnostics, only : add_error
   use axijoint_deck_text_source, only : card_text
   use axijoint_deck_text_token, only : read_integer, read_real, token_good
   use axijoint_legacy_cards, only : cards_type
   implicit none
   private
   public :: line_type, next_line, is_data, parameter_of, has_parameter, field_of, field_text, name_in, integer_of, real_of, &
      fault_of
   public :: line_keyword, line_data, line_end

   !> A keyword, data, no line any more
   integer, parameter :: line_keyword = 1, line_data = 2, line_end = 3

   !> A line
   type :: line_type
      !> One of the parameters above
      integer :: kind = line_end
      !> Its card
      integer :: card = 0
      !> What it says; of a keyword in capital letters without the asterisk and without parameters
      character(len=:), allocatable :: text, keyword
      !> Fields between commas: columns of the text, shape (2, fields); their cards, and the columns before the text of
      !> these, shape (2, fields)
      integer, allocatable :: place(:, :), home(:, :)
   end type line_type

contains

   !> The next line that is no comment. One of a keyword with a comma at its end goes on in the next that has a
   !> parameter; one of data that does is left to those who read it
   subroutine next_line(cards, at, line)
      !> The file
      type(cards_type), intent(in) :: cards
      !> The card before it; its last one on return
      integer, intent(inout) :: at
      !> The line
      type(line_type), intent(out) :: line

      character(len=:), allocatable :: text
      integer :: next

      call next_card(cards, at)
      if (at > cards%source%n_cards) return
      line%card = at
      line%kind = line_data
      line%text = ''
      allocate (line%place(2, 0), line%home(2, 0))
      call append(line, card_text(cards%source, at), at)
      if (index(adjustl(line%text), '*') /= 1) return
      line%kind = line_keyword
      line%keyword = upper(field_text(line, 1))
      line%keyword = trim(adjustl(line%keyword(2:)))
      do while (ends_with_comma(line%text))
         next = at
         call next_card(cards, next)
         if (next > cards%source%n_cards) exit
         text = card_text(cards%source, next)
         if (index(text, '=') == 0) exit  ! data after a comma too many
         call append(line, text, next)
         at = next
      end do
   end subroutine next_line

   !> The next card that is no comment and not empty; the one after the last if there is none
   pure subroutine next_card(cards, at)
      !> The file
      type(cards_type), intent(in) :: cards
      !> The card before it
      integer, intent(inout) :: at

      character(len=:), allocatable :: text

      do
         at = at + 1
         if (at > cards%source%n_cards) return
         text = card_text(cards%source, at)
         if (len_trim(text) > 0 .and. index(adjustl(text), '**') /= 1) return
      end do
   end subroutine next_card

   !> Whether a line ends with a comma
   pure logical function ends_with_comma(text)
      !> The line
      character(len=*), intent(in) :: text

      integer :: last

      last = verify(text, ' '//achar(9), back=.true.)
      ends_with_comma = .false.
      if (last > 0) ends_with_comma = text(last:last) == ','
   end function ends_with_comma

   !> Append the fields of a card
   pure subroutine append(line, text, card)
      !> The line
      type(line_type), intent(inout) :: line
      !> The card and its number
      character(len=*), intent(in) :: text
      integer, intent(in) :: card

      integer :: k, from, to, before

      before = len(line%text)
      from = 1
      do while (from <= len_trim(text))
         to = index(text(from:)//',', ',') + from - 2
         k = verify(text(from:to)//'x', ' '//achar(9)) - 1
         line%place = reshape([line%place, before + from + k, before + max(from + k - 1, &
            from - 1 + len_trim(text(from:to)))], [2, size(line%place, 2) + 1])
         line%home = reshape([line%home, card, before], [2, size(line%home, 2) + 1])
         from = to + 2
      end do
      line%text = line%text//text
   end subroutine append

   !> The next line, if it is one of data
   logical function is_data(cards, at, line)
      !> The file
      type(cards_type), intent(in) :: cards
      !> The card before it; its own on return if it is
      integer, intent(inout) :: at
      !> The line
      type(line_type), intent(out) :: line

      integer :: next

      next = at
      call next_line(cards, next, line)
      is_data = line%kind == line_data
      if (is_data) at = next
   end function is_data

   !> What is in a field; empty if nothing
   pure function field_text(line, n) result(text)
      !> The line
      type(line_type), intent(in) :: line
      !> The field
      integer, intent(in) :: n
      !> Its text
      character(len=:), allocatable :: text

      text = ''
      if (n <= size(line%place, 2)) text = trim(line%text(line%place(1, n):line%place(2, n)))
   end function field_text

   !> Field of a parameter of a keyword; 0 if it is not there
   pure integer function field_of(line, name) result(field)
      !> The line
      type(line_type), intent(in) :: line
      !> Name of the parameter
      character(len=*), intent(in) :: name

      character(len=:), allocatable :: text

      do field = size(line%place, 2), 2, -1
         text = upper(field_text(line, field))
         if (text(:index(text//'=', '=') - 1) == name) return
      end do
      field = 0
   end function field_of

   !> Value of a parameter of a keyword, in capital letters, without quotes; empty if it is not there, or has none
   pure function parameter_of(line, name) result(value)
      !> The line
      type(line_type), intent(in) :: line
      !> Its name
      character(len=*), intent(in) :: name
      !> The value
      character(len=:), allocatable :: value

      character(len=:), allocatable :: text

      value = ''
      if (field_of(line, name) == 0) return
      text = upper(field_text(line, field_of(line, name)))
      if (index(text, '=') > 0) value = without_quotes(trim(adjustl(text(index(text, '=') + 1:))))
   end function parameter_of

   !> A name in a field, in capital letters, without quotes
   pure function name_in(line, n) result(name)
      !> The line
      type(line_type), intent(in) :: line
      !> The field
      integer, intent(in) :: n
      !> The name
      character(len=:), allocatable :: name

      name = without_quotes(upper(field_text(line, n)))
   end function name_in

   !> A name without quotes about it
   pure function without_quotes(text) result(name)
      !> The name, perhaps with quotes
      character(len=*), intent(in) :: text
      !> What is between them
      character(len=:), allocatable :: name

      name = text
      if (len(text) < 2) return
      if (text(1:1) == '"' .and. text(len(text):) == '"') name = text(2:len(text) - 1)
   end function without_quotes

   !> Whether a keyword has a parameter without a value
   pure logical function has_parameter(line, name)
      !> The line
      type(line_type), intent(in) :: line
      !> Its name
      character(len=*), intent(in) :: name

      integer :: k

      has_parameter = .false.
      do k = 2, size(line%place, 2)
         has_parameter = has_parameter .or. upper(field_text(line, k)) == name
      end do
   end function has_parameter

   !> An integer; a blank field is zero
   integer function integer_of(cards, line, n) result(value)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line, and the field
      type(line_type), intent(in) :: line
      integer, intent(in) :: n

      integer :: fault

      value = 0
      if (len(field_text(line, n)) == 0) return
      call read_integer(field_text(line, n), value, fault)
      if (fault /= token_good) call fault_of(cards, line, n, 'this is no integer')
   end function integer_of

   !> A real; a blank field is zero
   real(wp) function real_of(cards, line, n) result(value)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line, and the field
      type(line_type), intent(in) :: line
      integer, intent(in) :: n

      character(len=:), allocatable :: token
      integer :: fault

      value = 0.0_wp
      token = upper(field_text(line, n))
      if (len(token) == 0) return
      if (scan(token, 'D') > 0) token(scan(token, 'D'):scan(token, 'D')) = 'E'
      call read_real(token, value, fault)
      if (fault /= token_good) call fault_of(cards, line, n, 'this is no number')
   end function real_of

   !> Report an error about a field
   subroutine fault_of(cards, line, n, text, allowed)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line, and the field; 0 for the whole line
      type(line_type), intent(in) :: line
      integer, intent(in) :: n
      !> What is wrong, what is allowed
      character(len=*), intent(in) :: text
      character(len=*), intent(in), optional :: allowed

      if (n < 1 .or. n > size(line%place, 2)) then
         call add_error(cards%diagnostics, line%card, 0, 0, text, allowed=allowed)
      else
         associate (card => line%home(1, n), column => line%place(:, n) - line%home(2, n))
            call add_error(cards%diagnostics, card, column(1), column(2), text, found=field_text(line, n), allowed=allowed)
         end associate
      end if
   end subroutine fault_of

end module axijoint_legacy_abaqus_lines
