!> One entry of a section with the deck around it, so that those who read it need not hand
!> these on piece by piece
module axijoint_deck_text_entry
   use axijoint_base_kinds, only : wp
   use axijoint_deck_text_diagnostics, only : diagnostics_type, count_again
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, text_value, field_error, &
      field_warning, entry_error
   implicit none
   private
   public :: entry_type, next_entry
   public :: is_given, integer_of, real_of, reals_of, text_of, first_card, field_named
   public :: field_fault, lack_fault, field_doubt, card_fault, is_good, is_sound

   !> One entry of a section
   type :: entry_type
      !> The deck, the section, messages
      type(source_type), pointer :: source => null()
      type(table_type), pointer :: table => null()
      type(diagnostics_type), pointer :: diagnostics => null()
      !> The entry, and how many errors there were before it
      integer :: entry = 0
      integer :: errors_before = 0
   end type entry_type

contains

   !> Go on to the next entry of the section
   logical function next_entry(card) result(there_is_one)
      !> The entry
      class(entry_type), intent(inout) :: card

      card%entry = card%entry + 1
      card%errors_before = card%diagnostics%n_errors
      there_is_one = card%entry <= card%table%n
   end function next_entry

   !> Whether a field has a valid value
   pure logical function is_given(card, field)
      !> The entry
      class(entry_type), intent(in) :: card
      !> The field; 0 for one that the section lacks
      integer, intent(in) :: field

      is_given = .false.
      if (field > 0) is_given = card%table%given(field, card%entry)
   end function is_given

   !> Value of a field as an integer
   pure integer function integer_of(card, field)
      !> The entry
      class(entry_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field

      integer_of = integer_value(card%table, field, card%entry)
   end function integer_of

   !> Value of a field
   pure real(wp) function real_of(card, field)
      !> The entry
      class(entry_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field

      real_of = card%table%values(field, card%entry)
   end function real_of

   !> Values of fields one after another
   pure function reals_of(card, field, n)
      !> The entry
      class(entry_type), intent(in) :: card
      !> The first field, and how many
      integer, intent(in) :: field, n
      !> Their values
      real(wp) :: reals_of(n)

      reals_of = card%table%values(field:field + n - 1, card%entry)
   end function reals_of

   !> The text in a field
   function text_of(card, field) result(text)
      !> The entry
      class(entry_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field
      !> What stands there
      character(len=:), allocatable :: text

      text = text_value(card%source, card%table, card%entry, field)
   end function text_of

   !> The first card of the entry
   pure integer function first_card(card)
      !> The entry
      class(entry_type), intent(in) :: card

      first_card = card%table%cards(1, card%entry)
   end function first_card

   !> Place of a field among those of its section; 0 if the section has none of this name
   pure integer function field_named(card, name)
      !> The entry
      class(entry_type), intent(in) :: card
      !> Name of the field
      character(len=*), intent(in) :: name

      do field_named = size(card%table%fields), 1, -1
         if (card%table%fields(field_named)%name == name) return
      end do
   end function field_named

   !> Report a fault of a field
   subroutine field_fault(card, field, text, allowed, mend)
      !> The entry
      class(entry_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What is allowed, how to mend it
      character(len=*), intent(in), optional :: allowed, mend

      call field_error(card%diagnostics, card%source, card%table, card%entry, field, text, &
                       allowed, mend)
   end subroutine field_fault

   !> Report that a field names what the deck lacks. Many cards may name it: it is told at the
   !> first. A card with another fault may not be meant as it stands: that fault is told alone
   subroutine lack_fault(card, field, text, allowed)
      !> The entry
      class(entry_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field
      !> What is lacking
      character(len=*), intent(in) :: text
      !> What is allowed
      character(len=*), intent(in), optional :: allowed

      logical :: told

      if (.not. is_good(card)) return
      call count_again(card%diagnostics, text, told)
      if (.not. told) call field_fault(card, field, text, allowed)
   end subroutine lack_fault

   !> Warn of the value of a field
   subroutine field_doubt(card, field, text, mend)
      !> The entry
      class(entry_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field
      !> What is doubtful, how to mend it
      character(len=*), intent(in) :: text, mend

      call field_warning(card%diagnostics, card%source, card%table, card%entry, field, text, mend)
   end subroutine field_doubt

   !> Report a fault of the entry as a whole
   subroutine card_fault(card, text, found, allowed, mend)
      !> The entry
      class(entry_type), intent(in) :: card
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What was found, what is allowed, how to mend it
      character(len=*), intent(in), optional :: found, allowed, mend

      call entry_error(card%diagnostics, card%table, card%entry, text, found, allowed, mend)
   end subroutine card_fault

   !> Whether every field of the entry could be read
   pure logical function is_good(card)
      !> The entry
      class(entry_type), intent(in) :: card

      is_good = card%table%good(card%entry)
   end function is_good

   !> Whether nothing was found wrong with the entry
   pure logical function is_sound(card)
      !> The entry
      class(entry_type), intent(in) :: card

      is_sound = is_good(card) .and. card%diagnostics%n_errors == card%errors_before
   end function is_sound

end module axijoint_deck_text_entry
