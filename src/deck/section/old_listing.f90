!> OLDLISTING: how much the listing in an old layout shows of increments
module axijoint_deck_section_old_listing
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_text_entry, only : is_given, integer_of, is_good, field_fault
   use axijoint_deck_text_field, only : integer_field, described, largest_number
   use axijoint_model_request, only : most_output
   implicit none
   private
   public :: old_listing_section

   !> The keyword
   character(len=*), parameter :: keyword = 'OLDLISTING'
   !> Fields: the amount, the first increment and the last
   integer, parameter :: field_amount = 1, field_first = 2, field_last = 3

contains

   !> OLDLISTING
   function old_listing_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword
      section%purpose = 'what the listing of --listing owen-hinton shows of increments; without '// &
         'the section all of all'
      section%stage = stage_requests
      section%read => read_old_listing
      section%fields = &
         [described(integer_field('the amount', 1, 5, 0, most_output), &
                    'NOUTP: 0 nothing, 1 displacements, 2 reactions, too, 3 stresses, too'), &
          described(integer_field('the first increment', 6, 10, 1, largest_number, default=1), &
                    'first increment', limits='increments of the deck'), &
          described(integer_field('the last increment', 11, 15, 1, largest_number, default=0), &
                    'last increment', blank='the first; of all, if that is blank, too', &
                    limits='increments from the first on')]
   end function old_listing_section

   !> Read the amounts; a later card stands above an earlier one
   subroutine read_old_listing(deck)
      !> The deck, its increments read
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: first, last, n

      n = size(deck%model%increments)
      card = cards_of(deck, keyword)
      do while (next_card(card))
         if (.not. is_good(card)) cycle
         first = integer_of(card, field_first)
         last = merge(first, n, is_given(card, field_first))
         if (is_given(card, field_last)) last = integer_of(card, field_last)
         if (first > n) then
            call field_fault(card, field_first, 'there is no increment '//to_text(first), &
                             allowed='1 to '//to_text(n))
         else if (last < first .or. last > n) then
            call field_fault(card, field_last, 'there is no such increment', &
                             allowed=to_text(first)//' to '//to_text(n))
         else
            if (.not. allocated(deck%model%old_output)) &
               allocate (deck%model%old_output(n), source=most_output)
            deck%model%old_output(first:last) = integer_of(card, field_amount)
         end if
      end do
   end subroutine read_old_listing

end module axijoint_deck_section_old_listing
