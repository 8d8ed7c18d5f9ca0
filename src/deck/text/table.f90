!> The entries of one section as numbers, each with the cards it came from
module axijoint_deck_text_table
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, upper, did_you_mean
   use axijoint_deck_text_card, only : slot_type, divide_card
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_deck_text_field, only : field_type, allowed_text, in_range, kind_integer, &
      kind_real, &
      kind_word, kind_code, kind_text, smallest_real, largest_real
   use axijoint_deck_text_source, only : source_type, card_content
   use axijoint_deck_text_token, only : read_integer, read_real, token_good, token_is_real, &
      token_too_large, token_too_small, token_not_finite, token_asterisks
   implicit none
   private
   public :: table_type, new_table, read_entry, card_faults, read_value, integer_value, text_value, &
      entry_error, field_error, field_warning

   !> Entries of a section
   type :: table_type
      !> Fields of an entry: those of the section itself, for they are large
      type(field_type), pointer :: fields(:) => null()
      !> Number of entries
      integer :: n = 0
      !> Cards of each entry, shape (cards, entries)
      integer, allocatable :: cards(:, :)
      !> Value of each field of each entry; the default where it is blank
      real(wp), allocatable :: values(:, :)
      !> Whether a field was given, and validly, same shape
      logical, allocatable :: given(:, :)
      !> Whether an entry is without a fault, shape (entries)
      logical, allocatable :: good(:)
   end type table_type

contains

   !> A table without entries
   function new_table(fields, most) result(table)
      !> Fields of an entry, which live as long as the table
      type(field_type), intent(in), target :: fields(:)
      !> Most entries
      integer, intent(in) :: most
      !> The table
      type(table_type) :: table

      table%fields => fields
      allocate (table%cards(max(1, maxval(fields%card)), most), source=0)
      allocate (table%values(size(fields), most), source=0.0_wp)
      allocate (table%given(size(fields), most), source=.false.)
      allocate (table%good(most), source=.false.)
   end function new_table

   !> Value of a field as an integer
   pure integer function integer_value(table, field, entry) result(value)
      !> The section
      type(table_type), intent(in) :: table
      !> Field and entry
      integer, intent(in) :: field, entry

      value = nint(table%values(field, entry))
   end function integer_value

   !> Read the cards of the next entry
   subroutine read_entry(table, source, cards, diagnostics)
      !> The section
      type(table_type), intent(inout) :: table
      !> The deck
      type(source_type), intent(in) :: source
      !> The entry's cards
      integer, intent(in) :: cards(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: k, errors_before

      errors_before = diagnostics%n_errors
      table%n = table%n + 1
      table%cards(:, table%n) = cards
      do k = 1, size(cards)
         call read_card(table, source, cards(k), k, diagnostics)
      end do
      table%good(table%n) = diagnostics%n_errors == errors_before
   end subroutine read_entry

   !> Number of faults of a card, read as a card of an entry
   integer function card_faults(source, card, fields, k)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card
      !> Fields of the entry
      type(field_type), intent(in), target :: fields(:)
      !> Which of the entry's cards it is
      integer, intent(in) :: k

      type(table_type) :: table
      type(diagnostics_type) :: faults

      table = new_table(fields, 1)
      table%n = 1
      call read_card(table, source, card, k, faults)
      card_faults = faults%n_errors
   end function card_faults

   !> Read one card of the last entry
   subroutine read_card(table, source, card, k, diagnostics)
      !> The section
      type(table_type), intent(inout) :: table
      !> The deck
      type(source_type), intent(in) :: source
      !> The card, and which of the entry's cards it is
      integer, intent(in) :: card, k
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(slot_type) :: slots(size(table%fields))
      character(len=:), allocatable :: content
      integer :: i, first, last

      first = count(table%fields%card < k) + 1
      last = count(table%fields%card <= k)
      call divide_card(source, card, table%fields(first:last), slots(first:last), diagnostics)
      content = card_content(source, card)
      do i = first, last
         call read_field(table%fields(i), content, card, slots(i), table%values(i, table%n), &
                         table%given(i, table%n), diagnostics)
      end do
   end subroutine read_card

   !> Read one field
   subroutine read_field(field, content, card, slot, value, given, diagnostics)
      !> The field
      type(field_type), intent(in) :: field
      !> The card without its comment, and its index
      character(len=*), intent(in) :: content
      integer, intent(in) :: card
      !> Place of the value
      type(slot_type), intent(in) :: slot
      !> Its value, or the default
      real(wp), intent(out) :: value
      !> Whether there is a valid value
      logical, intent(out) :: given
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: token, fault, mend

      value = field%default
      given = .false.
      if (.not. slot%whole) return
      token = content(slot%from:slot%to)
      mend = ''
      if (len(token) == 0) then
         if (.not. field%required) return
         fault = 'is blank'
      else
         call read_value(field, token, value, fault, mend)
      end if
      given = len(fault) == 0
      if (given) return
      value = field%default
      call add_error(diagnostics, card, slot%first, slot%last, trim(field%name)//' '//fault, &
                     found=token, allowed=allowed_text(field), mend=mend)
   end subroutine read_field

   !> From a text to the value of a field
   pure subroutine read_value(field, token, value, fault, mend)
      !> The field
      type(field_type), intent(in) :: field
      !> The text
      character(len=*), intent(in) :: token
      !> The value; undefined if there is a fault
      real(wp), intent(out) :: value
      !> What is wrong with the text; empty if nothing is
      character(len=:), allocatable, intent(out) :: fault
      !> How to mend it; may be empty
      character(len=:), allocatable, intent(out) :: mend

      integer :: code, number

      fault = ''
      mend = ''
      select case (field%kind)
      case (kind_integer)
         call read_integer(token, number, code)
         value = real(number, wp)
         call explain(field, code, fault, mend)
      case (kind_real)
         call read_real(token, value, code)
         if (code == token_good .and. abs(value) > largest_real) code = token_too_large
         if (code == token_good .and. abs(value) > 0.0_wp .and. abs(value) < smallest_real) then
            code = token_too_small
         end if
         call explain(field, code, fault, mend)
      case (kind_word)
         value = real(findloc(field%words, upper(token), 1), wp)
         if (value < 1.0_wp) then
            fault = 'is unknown'
            mend = did_you_mean(token, field%words)
         end if
         return
      case (kind_code)
         value = 0.0_wp
         if (len(token) /= 3 .or. verify(token, '01') /= 0) then
            fault = 'is not three digits 0 or 1'
         else if (token == '000') then
            fault = 'fixes nothing'
         else
            read (token, '(b3)') number
            value = real(number, wp)
         end if
         return
      case (kind_text)
         value = 0.0_wp
         return
      end select
      if (len(fault) == 0 .and. .not. in_range(field, value)) then
         call explain_range(field, value, fault, mend)
      end if
   end subroutine read_value

   !> Words for a text that is not the number wanted
   pure subroutine explain(field, code, fault, mend)
      !> The field
      type(field_type), intent(in) :: field
      !> One of the `token_` parameters
      integer, intent(in) :: code
      !> What is wrong; empty if nothing is
      character(len=:), allocatable, intent(out) :: fault
      !> How to mend it; may be empty
      character(len=:), allocatable, intent(out) :: mend

      mend = ''
      select case (code)
      case (token_good)
         fault = ''
      case (token_is_real)
         fault = 'is a real, not an integer'
         mend = 'write it without point and exponent'
      case (token_too_large)
         fault = 'is too large'
         if (field%kind == kind_real) mend = 'magnitudes go up to 1E30; choose other units'
      case (token_too_small)
         fault = 'is too near to zero'
         mend = 'write 0, or choose other units: magnitudes begin at 1E-30'
      case (token_not_finite)
         fault = 'is not a finite number'
      case (token_asterisks)
         fault = 'is filled with asterisks'
         mend = 'the program that wrote the card had too few columns: put the number in'
      case default
         fault = 'is not a number'
         if (field%kind == kind_integer) fault = 'is not an integer'
      end select
   end subroutine explain

   !> Words for a number out of its range
   pure subroutine explain_range(field, value, fault, mend)
      !> The field
      type(field_type), intent(in) :: field
      !> The number
      real(wp), intent(in) :: value
      !> What is wrong
      character(len=:), allocatable, intent(out) :: fault
      !> How to mend it; may be empty
      character(len=:), allocatable, intent(out) :: mend

      mend = ''
      if (field%name == 'Poisson''s ratio') mend = 'write a ratio below 0.5, e.g. 0.49'
      if (value < 0.0_wp .and. .not. field%low < 0.0_wp) then
         fault = 'is negative'
         if (field%name == 'Poisson''s ratio') mend = 'write a ratio of 0 or more'
      else if (value < field%low) then
         fault = 'is too small'
      else if (field%above_low .and. .not. value > field%low) then
         fault = 'is zero'
      else if (field%below_high) then
         fault = 'is not below '//to_text(field%high)
      else
         fault = 'is too large'
      end if
   end subroutine explain_range

   !> Where the value of a field stands; a text is pointed at itself, not at its wide field
   subroutine find_slot(source, table, entry, field, card, slot)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> Entry and field
      integer, intent(in) :: entry, field
      !> Its card
      integer, intent(out) :: card
      !> Its place
      type(slot_type), intent(out) :: slot

      type(slot_type) :: slots(size(table%fields))
      type(diagnostics_type) :: told_before
      integer :: first, last

      associate (card_of => table%fields%card)
         card = table%cards(card_of(field), entry)
         first = count(card_of < card_of(field)) + 1
         last = count(card_of <= card_of(field))
      end associate
      call divide_card(source, card, table%fields(first:last), slots(first:last), told_before)
      slot = slots(field)
      if (table%fields(field)%kind /= kind_text .or. slot%to < slot%from) return
      slot%first = slot%from
      slot%last = slot%to
   end subroutine find_slot

   !> The text in a field
   function text_value(source, table, entry, field) result(text)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> Entry and field
      integer, intent(in) :: entry, field
      !> What stands there
      character(len=:), allocatable :: text

      type(slot_type) :: slot
      integer :: card

      call find_slot(source, table, entry, field, card, slot)
      text = card_content(source, card)
      text = text(slot%from:slot%to)
   end function text_value

   !> Report an error in the value of a field
   subroutine field_error(diagnostics, source, table, entry, field, text, allowed, mend)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> Entry and field
      integer, intent(in) :: entry, field
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What is allowed, how to mend it
      character(len=*), intent(in), optional :: allowed, mend

      type(slot_type) :: slot
      integer :: card

      call find_slot(source, table, entry, field, card, slot)
      call add_error(diagnostics, card, slot%first, slot%last, text, &
                     text_value(source, table, entry, field), allowed, mend)
   end subroutine field_error

   !> Warn of the value of a field
   subroutine field_warning(diagnostics, source, table, entry, field, text, mend)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> Entry and field
      integer, intent(in) :: entry, field
      !> What is doubtful, how to mend it
      character(len=*), intent(in) :: text, mend

      type(slot_type) :: slot
      integer :: card

      call find_slot(source, table, entry, field, card, slot)
      call add_warning(diagnostics, card, slot%first, slot%last, text, mend=mend)
   end subroutine field_warning

   !> Report an error of an entry as a whole
   subroutine entry_error(diagnostics, table, entry, text, found, allowed, mend)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> The section
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What was found, what is allowed, how to mend it
      character(len=*), intent(in), optional :: found, allowed, mend

      call add_error(diagnostics, table%cards(1, entry), 0, 0, text, found, allowed, mend)
   end subroutine entry_error

end module axijoint_deck_text_table
