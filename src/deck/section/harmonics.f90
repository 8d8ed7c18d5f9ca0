!> HARMONICS: which harmonics are used
module axijoint_deck_section_harmonics
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, list_of
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_text_common_fields, only : step_field => step, largest_harmonic
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_entry, only : is_given, integer_of, is_good, is_sound, field_fault, first_card
   use axijoint_deck_text_field, only : integer_field, described
   use axijoint_model_model, only : left_out_harmonics
   implicit none
   private
   public :: harmonics_section, warn_of_left_out

   !> The keyword
   character(len=*), parameter :: keyword_harmonics = 'HARMONICS'
   !> Fields
   integer, parameter :: field_first = 1, field_last = 2, field_step = 3
   !> Most harmonics that a message names
   integer, parameter :: most_named = 8

contains

   !> HARMONICS
   function harmonics_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_harmonics
      section%purpose = 'harmonics in use; without the section all from 0 to M'
      section%stage = stage_loads
      section%read => read_harmonics
      section%fields = &
         [described(integer_field('the first harmonic', 1, 5, 0, largest_harmonic), &
         'first harmonic', &
                    limits='0 … M'), &
          described(integer_field('the last harmonic', 6, 10, 0, largest_harmonic, default=0), &
                    'last harmonic', &
                    blank='the first', limits='first … M'), &
          step_field(11)]
   end function harmonics_section

   !> The harmonics in use: those of the cards, or all from 0 to M if there are none. If a
   !> card is at fault they are all, too: no load is to blame for it
   subroutine read_harmonics(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      logical, allocatable :: used(:)
      integer :: first, last, step, m, errors_before

      card = cards_of(deck, keyword_harmonics)
      errors_before = deck%diagnostics%n_errors
      allocate (used(0:max(0, deck%highest)), source=card%table%n == 0)
      do while (next_card(card))
         if (.not. is_good(card) .or. deck%highest < 0) cycle
         call read_range(card, deck%highest, first, last, step)
         used(first:last:step) = .true.
      end do
      if (deck%diagnostics%n_errors > errors_before &
         .or. .not. all(card%table%good(:card%table%n))) used = .true.
      deck%harmonics = pack([(m, m=0, max(0, deck%highest))], used)
      deck%model%harmonics = deck%harmonics
   end subroutine read_harmonics

   !> Warn of harmonics up to M that are not in use, though loads have a part in them, once these are read
   subroutine warn_of_left_out(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer, allocatable :: harmonics(:)
      logical :: acts(size(deck%cases%cases))
      integer :: k

      if (deck%diagnostics%n_errors > 0) return
      acts = .false.
      do k = 1, size(deck%model%combinations)
         acts = acts .or. abs(deck%model%combinations(k)%factor) > 0.0_wp
      end do
      harmonics = left_out_harmonics(deck%model, acts)
      if (size(harmonics) == 0) return
      card = cards_of(deck, keyword_harmonics)
      if (.not. next_card(card)) return
      call add_warning(deck%diagnostics, first_card(card), 0, 0, &
                       'loads have parts in harmonics that are not in use: '//list_of(harmonics, most_named), &
                       mend='add these to HARMONICS, or leave the section out: what their parts do is in no result')
   end subroutine warn_of_left_out

   !> Read and check one card
   subroutine read_range(card, highest, first, last, step)
      !> The card
      type(card_type), intent(in) :: card
      !> Highest harmonic of the job
      integer, intent(in) :: highest
      !> First, last and step; none at all if something is wrong
      integer, intent(out) :: first, last, step

      integer :: field

      first = integer_of(card, field_first)
      last = first
      if (is_given(card, field_last)) last = integer_of(card, field_last)
      step = integer_of(card, field_step)
      do field = field_first, field_last
         if (integer_of(card, field) <= highest) cycle
         call field_fault(card, field, 'harmonic '//to_text(integer_of(card, field))// &
                          ' is above the highest, M = '//to_text(highest), &
                          allowed='0 to '//to_text(highest), mend='raise M on the CONTROL card')
      end do
      if (last < first) then
         call field_fault(card, field_last, 'the last harmonic is below the first', &
                          allowed=to_text(first)//' or more')
      else if (mod(last - first, step) /= 0) then
         call field_fault(card, merge(field_step, field_last, is_given(card, field_step)), &
                          'the step does not lead from harmonic '//to_text(first)// &
                          ' to harmonic '// &
                          to_text(last), allowed='a divisor of '//to_text(last - first))
      end if
      if (is_sound(card)) return
      first = 1
      last = 0
      step = 1
   end subroutine read_range

end module axijoint_deck_section_harmonics
