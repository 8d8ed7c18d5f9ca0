!> Numbers by which entries are known: each is given once
module axijoint_deck_text_labels
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_entry, only : entry_type, is_given, integer_of, field_fault, first_card
   use axijoint_deck_text_source, only : card_position
   implicit none
   private
   public :: check_label, repeated_label

contains

   !> Report the number of an entry that an earlier entry of the section has
   subroutine check_label(card, field, noun, seen, allowed)
      !> The entry
      class(entry_type), intent(in) :: card
      !> Field of the number
      integer, intent(in) :: field
      !> What is numbered
      character(len=*), intent(in) :: noun
      !> Entries by number; this one is added
      type(number_map_type), intent(inout) :: seen
      !> What is allowed
      character(len=*), intent(in), optional :: allowed

      integer :: label, known

      if (.not. is_given(card, field)) return
      label = integer_of(card, field)
      known = find_number(seen, label)
      if (known > 0) then
         call repeated_label(card, field, noun, card%table%cards(1, known), allowed)
      else
         call insert_number(seen, label, card%entry)
      end if
   end subroutine check_label

   !> Report a number that is given twice
   subroutine repeated_label(card, field, noun, first, allowed, mend)
      !> The entry that has the number again, and the field where it stands
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> What is numbered
      character(len=*), intent(in) :: noun
      !> Card that has the number first
      integer, intent(in) :: first
      !> What is allowed, how to mend it
      character(len=*), intent(in), optional :: allowed, mend

      call field_fault(card, field, noun//' '//to_text(integer_of(card, field))// &
                       ' is given twice, first on '// &
                       card_position(card%source, first, first_card(card)), allowed=allowed, &
                       mend=mend)
   end subroutine repeated_label

end module axijoint_deck_text_labels
