!> Numbers by which cards are known: each is given once
module axijoint_deck_text_labels
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type, card_position
   use axijoint_deck_text_table, only : table_type, integer_value, field_error
   implicit none
   private
   public :: check_label, repeated_label

   !> Field of the number
   integer, parameter :: field_label = 1

contains

   !> Report the number of an entry that an earlier entry of the section has
   subroutine check_label(source, table, entry, noun, seen, diagnostics, allowed)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> What is numbered
      character(len=*), intent(in) :: noun
      !> Entries by number; this one is added
      type(number_map_type), intent(inout) :: seen
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> What is allowed
      character(len=*), intent(in), optional :: allowed

      integer :: label, known

      if (.not. table%given(field_label, entry)) return
      label = integer_value(table, field_label, entry)
      known = find_number(seen, label)
      if (known > 0) then
         call repeated_label(source, table, entry, field_label, noun, table%cards(1, known), &
                             diagnostics, allowed)
      else
         call insert_number(seen, label, entry)
      end if
   end subroutine check_label

   !> Report a number that is given twice
   subroutine repeated_label(source, table, entry, field, noun, first, diagnostics, allowed, mend)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> The entry that has the number again, and the field where it stands
      integer, intent(in) :: entry, field
      !> What is numbered
      character(len=*), intent(in) :: noun
      !> Card that has the number first
      integer, intent(in) :: first
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> What is allowed, how to mend it
      character(len=*), intent(in), optional :: allowed, mend

      call field_error(diagnostics, source, table, entry, field, &
                       noun//' '//to_text(integer_value(table, field, entry))//' is given twice, first on '// &
                       card_position(source, first, table%cards(1, entry)), allowed=allowed, mend=mend)
   end subroutine repeated_label

end module axijoint_deck_text_labels
