!> Cards of an old deck one after the other, and the values on them by place
module axijoint_legacy_cards
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_deck_text_file_bytes, only : line_end, next_line
   use axijoint_deck_text_source, only : source_type, add_file, add_card, card_text
   use axijoint_deck_text_token, only : read_integer, read_real, token_good
   use axijoint_legacy_layout, only : place_type, dialect_type, places_of
   implicit none
   private
   public :: cards_type, open_cards, next_card, integer_at, real_at, complain, warn

   !> What to do about a value that is none
   character(len=*), parameter :: misplaced = 'see that values stand in their columns; another '// &
      'dialect is described by --format'

   !> A deck that is being read
   type :: cards_type
      !> Its lines
      type(source_type) :: source
      !> Messages
      type(diagnostics_type) :: diagnostics
      !> Where the values stand
      type(dialect_type) :: dialect
      !> The card that was read last, and places of its values
      integer :: at = 0
      type(place_type), allocatable :: places(:)
      !> Whether it was said that a format has too few of them
      logical :: told_lack = .false.
      !> Whether the deck ended before its time
      logical :: ended = .false.
   end type cards_type

contains

   !> Begin before the first card
   subroutine open_cards(path, bytes, dialect, cards)
      !> The deck, for messages, and what it says
      character(len=*), intent(in) :: path, bytes
      !> Where values stand
      type(dialect_type), intent(in) :: dialect
      !> Its cards
      type(cards_type), intent(out) :: cards

      character(len=:), allocatable :: copy
      integer :: first, last, line

      cards%dialect = dialect
      allocate (cards%source%sections(0), cards%places(0))
      copy = bytes
      call add_file(cards%source, path, copy, 0)
      first = 1
      line = 0
      do while (first <= len(bytes))
         last = line_end(bytes, first)
         line = line + 1
         call add_card(cards%source, 1, line, first, last)
         first = next_line(bytes, last)
      end do
   end subroutine open_cards

   !> The next card of a kind
   subroutine next_card(cards, kind, what)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> Kind of the card, for its places; 0 for a text
      integer, intent(in) :: kind
      !> What it is, for the message if it is not there
      character(len=*), intent(in) :: what

      character(len=:), allocatable :: fault

      if (cards%ended) return
      if (cards%at == cards%source%n_cards) then
         cards%ended = .true.
         call add_error(cards%diagnostics, cards%source%n_cards, 0, 0, &
            'the deck ends here; '//what//' should follow', &
            mend='see which counts on the cards above ask for more cards than there are')
         return
      end if
      cards%at = cards%at + 1
      deallocate (cards%places)
      if (kind == 0) then
         allocate (cards%places(0))
      else
         call places_of(cards%dialect%formats(kind), cards%places, fault)
      end if
   end subroutine next_card

   !> What stands at a place, without blanks before and after; and its columns
   subroutine token_at(cards, n, token, first, last)
      !> The deck
      type(cards_type), intent(in) :: cards
      !> Place of the value
      integer, intent(in) :: n
      !> What is there; empty if nothing is
      character(len=:), allocatable, intent(out) :: token
      !> Columns of it, or of the field
      integer, intent(out) :: first, last

      character(len=:), allocatable :: text

      token = ''
      first = 0
      last = 0
      if (cards%ended .or. n > size(cards%places)) return
      text = card_text(cards%source, cards%at)
      first = cards%places(n)%first
      last = cards%places(n)%last
      if (first > len(text)) return
      text = text(first:min(last, len(text)))
      token = trim(adjustl(text))
      if (len(token) == 0) return
      first = first + verify(text, ' ') - 1
      last = first + len(token) - 1
   end subroutine token_at

   !> Whether the format of a card that is there has no place for a value; the first time it is an error
   logical function lacks(cards, n, name)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> Place of the value
      integer, intent(in) :: n
      !> Its name
      character(len=*), intent(in) :: name

      lacks = .not. cards%ended .and. n > size(cards%places)
      if (lacks .and. .not. cards%told_lack) call add_error(cards%diagnostics, cards%at, 0, 0, &
         'the format of this card has no place for '//name, found=to_text(size(cards%places))//' values', &
         allowed=to_text(n)//' values or more', mend='see the file of --format')
      cards%told_lack = cards%told_lack .or. lacks
   end function lacks

   !> An integer; a blank field is zero
   integer function integer_at(cards, n, name) result(value)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> Place of the value
      integer, intent(in) :: n
      !> Its name
      character(len=*), intent(in) :: name

      character(len=:), allocatable :: token
      integer :: first, last, fault

      value = 0
      if (lacks(cards, n, name)) return
      call token_at(cards, n, token, first, last)
      if (len(token) == 0) return
      call read_integer(token, value, fault)
      if (fault /= token_good) call add_error(cards%diagnostics, cards%at, first, last, &
         name//' is no integer', found=token, &
         allowed='an integer in columns '//columns(cards, n), mend=misplaced)
   end function integer_at

   !> A real; a blank field is zero. Without a point it has the decimals of its format
   real(wp) function real_at(cards, n, name) result(value)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> Place of the value
      integer, intent(in) :: n
      !> Its name
      character(len=*), intent(in) :: name

      character(len=:), allocatable :: token, shown
      integer :: first, last, fault, digits

      value = 0.0_wp
      if (lacks(cards, n, name)) return
      call token_at(cards, n, token, first, last)
      if (len(token) == 0) return
      digits = max(0, cards%places(n)%decimals)
      if (index(token, '.') > 0) digits = 0
      shown = token
      token = with_letter(token)
      call read_real(token, value, fault)
      if (digits > 0 .and. fault == token_good .and. abs(value) > 0.0_wp) then
         call read_real(with_decimals(token, digits), value, fault)
         call add_warning(cards%diagnostics, cards%at, first, last, name//' has no decimal point: its last '// &
            to_text(digits)//' digits are decimals, as its format says', found=shown//', read as '//to_text(value), &
            mend='write the point')
      end if
      if (fault /= token_good) call add_error(cards%diagnostics, cards%at, first, last, &
         name//' is no number', found=shown, &
         allowed='a number in columns '//columns(cards, n), mend=misplaced)
   end function real_at

   !> A real whose exponent may be a sign and digits alone, as Fortran allows, with the letter
   pure function with_letter(token) result(number)
      !> It
      character(len=*), intent(in) :: token
      !> The same with an E
      character(len=:), allocatable :: number

      integer :: sign

      number = token
      if (scan(token, 'EeDd') > 0) return
      sign = scan(token, '+-', back=.true.)
      if (sign > 1) number = token(:sign - 1)//'E'//token(sign:)
   end function with_letter

   !> A real without a point, so many of whose digits before an exponent are decimals
   function with_decimals(token, decimals) result(number)
      !> It
      character(len=*), intent(in) :: token
      !> Decimals
      integer, intent(in) :: decimals
      !> The same with an exponent that says so
      character(len=:), allocatable :: number

      integer :: letter, power, fault

      letter = scan(token, 'EeDd')
      if (letter == 0) then
         number = token//'E-'//to_text(decimals)
      else
         call read_integer(token(letter + 1:), power, fault)
         number = token(:letter - 1)//'E'//to_text(power - decimals)
      end if
   end function with_decimals

   !> Report an error about a value of the last card
   subroutine complain(cards, n, number, text, allowed, card)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> Place of the value; 0 for the whole card
      integer, intent(in) :: n
      !> Number of the error in the old program; 0 if it had none
      integer, intent(in) :: number
      !> What is wrong, and what is allowed
      character(len=*), intent(in) :: text
      character(len=*), intent(in), optional :: allowed
      !> The card, if it is not the last
      integer, intent(in), optional :: card

      character(len=:), allocatable :: token, said
      integer :: first, last, at

      at = cards%at
      first = 0
      last = 0
      token = ''
      if (present(card)) at = card
      if (n > 0 .and. .not. present(card)) call token_at(cards, n, token, first, last)
      said = text
      if (number > 0) said = text//' (error '//to_text(number)//' of the old program)'
      call add_error(cards%diagnostics, at, first, last, said, found=token, allowed=allowed)
   end subroutine complain

   !> Tell how a value of the last card is understood
   subroutine warn(cards, n, text)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> Place of the value; 0 for the whole card
      integer, intent(in) :: n
      !> The words
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: token
      integer :: first, last

      first = 0
      last = 0
      if (n > 0) call token_at(cards, n, token, first, last)
      call add_warning(cards%diagnostics, cards%at, first, last, text)
   end subroutine warn

   !> Columns of a value
   pure function columns(cards, n) result(text)
      !> The deck
      type(cards_type), intent(in) :: cards
      !> Place of the value
      integer, intent(in) :: n
      !> First and last
      character(len=:), allocatable :: text

      text = to_text(cards%places(n)%first)//' to '//to_text(cards%places(n)%last)
   end function columns

end module axijoint_legacy_cards
