!> Bulk data of NASTRAN: entries of small, large and free fields with their continuations
module axijoint_legacy_nastran_cards
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, upper
   use axijoint_deck_text_diagnostics, only : add_error
   use axijoint_deck_text_source, only : card_text
   use axijoint_deck_text_token, only : read_integer, read_real, token_good
   use axijoint_legacy_cards, only : cards_type
   implicit none
   private
   public :: entry_type, next_entry, integer_in, real_in, is_in, fault_in

   !> Fields of an entry with its continuations that are kept
   integer, parameter :: most_fields = 80

   !> An entry
   type :: entry_type
      !> Its name, in capital letters; empty if there is none any more
      character(len=:), allocatable :: name
      !> Cards, the first and the last
      integer :: first = 0, last = 0
      !> What is in its fields 2, 3, ..., where that stands: card, columns
      character(len=32) :: text(most_fields) = ''
      integer :: place(3, most_fields) = 0
      !> Fields
      integer :: n = 0
   end type entry_type

contains

   !> The next entry from a card on
   subroutine next_entry(cards, at, entry)
      !> The deck
      type(cards_type), intent(in) :: cards
      !> The last card that was read; that of the entry on return
      integer, intent(inout) :: at
      !> The entry
      type(entry_type), intent(out) :: entry

      character(len=:), allocatable :: line, name

      entry%name = ''
      do while (at < cards%source%n_cards)
         line = plain(card_text(cards%source, at + 1))
         if (len_trim(line) == 0) then
            at = at + 1
            cycle
         end if
         name = name_of(line)
         if (entry%first == 0) then
            entry%name = name
            if (index(name, '*') > 0) entry%name = name(:index(name, '*') - 1)
            entry%first = at + 1
         else if (.not. is_continuation(name)) then
            return
         end if
         at = at + 1
         entry%last = at
         call cut(line, at, index(name, '*') > 0, entry)
      end do
   end subroutine next_entry

   !> A line without its comment and tabs
   pure function plain(line) result(text)
      !> The line
      character(len=*), intent(in) :: line
      !> The rest
      character(len=:), allocatable :: text

      integer :: k

      text = line
      k = index(text, '$')
      if (k > 0) text = text(:k - 1)
      do k = 1, len(text)
         if (text(k:k) == achar(9)) text(k:k) = ' '
      end do
   end function plain

   !> Name in the first field
   pure function name_of(line) result(name)
      !> The line
      character(len=*), intent(in) :: line
      !> The name, in capital letters
      character(len=:), allocatable :: name

      integer :: comma

      comma = index(line, ',')
      if (comma > 0) then
         name = upper(trim(adjustl(line(:comma - 1))))
      else
         name = upper(trim(adjustl(line(:min(8, len(line))))))
      end if
   end function name_of

   !> Whether a first field continues an entry
   pure logical function is_continuation(name)
      !> What is in it
      character(len=*), intent(in) :: name

      is_continuation = len(name) == 0
      if (.not. is_continuation) is_continuation = scan(name(1:1), '+*') > 0
   end function is_continuation

   !> Cut a line into its fields
   subroutine cut(line, card, large, entry)
      !> The line
      character(len=*), intent(in) :: line
      !> Its card
      integer, intent(in) :: card
      !> Whether fields have 16 columns
      logical, intent(in) :: large
      !> Takes the fields
      type(entry_type), intent(inout) :: entry

      integer :: first, last, k, n, width

      n = merge(4, 8, large)
      if (index(line, ',') > 0) then
         first = index(line, ',') + 1
         do k = 1, n
            if (first > len(line) + 1) then
               call keep(len(line) + 1, len(line))
               cycle
            end if
            last = index(line(first:)//',', ',') + first - 2
            call keep(first, last)
            first = last + 2
         end do
      else
         width = merge(16, 8, large)
         do k = 1, n
            call keep(9 + (k - 1)*width, min(8 + k*width, len(line)))
         end do
      end if

   contains

      !> Keep a field
      subroutine keep(first, last)
         !> Its columns
         integer, intent(in) :: first, last

         integer :: from

         if (entry%n == most_fields) return
         entry%n = entry%n + 1
         entry%place(:, entry%n) = [card, 0, 0]
         if (first > last) return
         from = verify(line(first:last), ' ')
         if (from == 0) return
         entry%text(entry%n) = upper(adjustl(line(first:last)))
         from = first + from - 1
         entry%place(2:, entry%n) = [from, from + len_trim(line(from:last)) - 1]
      end subroutine keep

   end subroutine cut

   !> Whether anything is in a field
   pure logical function is_in(entry, field)
      !> The entry
      type(entry_type), intent(in) :: entry
      !> The field, from 2
      integer, intent(in) :: field

      is_in = .false.
      if (field - 1 <= entry%n) is_in = len_trim(entry%text(field - 1)) > 0
   end function is_in

   !> An integer; a blank field is the default
   integer function integer_in(cards, entry, field, default) result(value)
      !> The deck, for messages
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> The field, from 2
      integer, intent(in) :: field
      !> Of a blank field
      integer, intent(in) :: default

      integer :: fault

      value = default
      if (.not. is_in(entry, field)) return
      call read_integer(trim(entry%text(field - 1)), value, fault)
      if (fault /= token_good) call fault_in(cards, entry, field, 'this is no integer')
   end function integer_in

   !> A real, whose exponent may have no letter; a blank field is the default
   real(wp) function real_in(cards, entry, field, default) result(value)
      !> The deck, for messages
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> The field, from 2
      integer, intent(in) :: field
      !> Of a blank field
      real(wp), intent(in) :: default

      character(len=:), allocatable :: token
      integer :: fault, k

      value = default
      if (.not. is_in(entry, field)) return
      token = trim(entry%text(field - 1))
      k = scan(token, 'D')
      if (k > 0) token(k:k) = 'E'
      k = scan(token(2:), '+-') + 1
      if (k > 1 .and. index(token, 'E') == 0) token = token(:k - 1)//'E'//token(k:)
      call read_real(token, value, fault)
      if (fault /= token_good) call fault_in(cards, entry, field, 'this is no number')
   end function real_in

   !> Report an error about a field
   subroutine fault_in(cards, entry, field, text, allowed)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> The field, from 2; 0 for the whole entry
      integer, intent(in) :: field
      !> What is wrong, what is allowed
      character(len=*), intent(in) :: text
      character(len=*), intent(in), optional :: allowed

      if (field < 2 .or. field - 1 > entry%n) then
         call add_error(cards%diagnostics, entry%first, 0, 0, text, allowed=allowed)
      else
         associate (place => entry%place(:, field - 1))
            call add_error(cards%diagnostics, place(1), place(2), place(3), entry%name// &
               ', field '//to_text(field)//': '//text, found=trim(entry%text(field - 1)), &
               allowed=allowed)
         end associate
      end if
   end subroutine fault_in

end module axijoint_legacy_nastran_cards
