!> KEEP: of which increments what is kept in the results file
module axijoint_deck_section_keep
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_text_entry, only : is_given, integer_of, is_good, field_fault
   use axijoint_deck_text_field, only : integer_field, word_field, described, largest_number
   use axijoint_model_request, only : keep_type, default_keep, keep_names, which_names, &
      which_every, which_only
   implicit none
   private
   public :: keep_section

   !> The keyword
   character(len=*), parameter :: keyword_keep = 'KEEP'
   !> Fields: what, of which increments, numbers
   integer, parameter :: field_what = 1, field_which = 2, field_first = 3, most_numbers = 8

contains

   !> KEEP
   function keep_section() result(section)
      !> The section
      type(read_section_type) :: section

      integer :: i

      section%name = keyword_keep
      section%purpose = 'of which increments results are kept; without the section all but '// &
         'stresses'
      section%stage = stage_requests
      section%read => read_keep
      section%fields = &
         [described(word_field('what is kept', 1, 10, keep_names), &
                    'what: SERIES resultants, energies, named points; DISPLACE displacements; '// &
                    'JOINTS stresses, relative displacements and states of joints; STRESSES of '// &
                    'solids'), &
          described(word_field('the increments', 11, 20, which_names), &
                    'of which increments; always of the last, too', &
                    limits='ALL, EVERY n-th, LAST alone, ONLY those that follow'), &
          described([(integer_field('increment '//to_text(i), 16 + 5*i, 20 + 5*i, 1, &
                                    largest_number, default=0), i=1, most_numbers)], &
                    'n of EVERY, or increments of ONLY; several cards of ONLY add up', &
                    blank='none', limits='increments of the deck')]
   end function keep_section

   !> Read what is kept
   subroutine read_keep(deck)
      !> The deck, its increments read
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: i, n, what, which

      deck%model%keep = default_keep()
      card = cards_of(deck, keyword_keep)
      do while (next_card(card))
         if (.not. is_good(card)) cycle
         what = integer_of(card, field_what)
         which = integer_of(card, field_which)
         n = size(deck%model%increments)
         associate (keep => deck%model%keep(what))
            if (which /= which_only .or. .not. allocated(keep%named)) keep = keep_type(which)
            if (which == which_only .and. .not. allocated(keep%named)) allocate (keep%named(0))
            do i = field_first, field_first + most_numbers - 1
               if (.not. is_given(card, i)) cycle
               if (which == which_only) then
                  if (integer_of(card, i) > n) then
                     call field_fault(card, i, 'there is no increment '// &
                                      to_text(integer_of(card, i)), allowed='1 to '//to_text(n))
                  else
                     keep%named = [keep%named, integer_of(card, i)]
                  end if
               else if (which == which_every .and. i == field_first) then
                  keep%every = integer_of(card, i)
               else
                  call field_fault(card, i, trim(which_names(which))//' takes '// &
                                   trim(merge('one number', 'no number ', which == which_every)), &
                                   mend='leave the field blank, or say ONLY')
               end if
            end do
            if (which == which_every .and. .not. is_given(card, field_first)) &
               call field_fault(card, field_first, 'EVERY needs a number', &
                                allowed='n: every n-th increment')
         end associate
      end do
   end subroutine read_keep

end module axijoint_deck_section_keep
