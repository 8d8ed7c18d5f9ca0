!> SWEEP: the range of theta that the bodies are swept through
module axijoint_deck_section_sweep
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_text_common_fields, only : largest_division
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, card_fault, &
      field_fault
   use axijoint_deck_text_field, only : integer_field, real_field, described
   use axijoint_deck_text_section, only : section_named
   implicit none
   private
   public :: sweep_section

   !> The keyword
   character(len=*), parameter :: keyword_sweep = 'SWEEP'
   !> Fields: first and last angle, number of sectors
   integer, parameter :: field_from = 1, field_to = 2, field_sectors = 3
   !> Widest sector [degree]: wider ones are flat or nearly so
   real(wp), parameter :: widest = 120.0_wp

contains

   !> SWEEP
   function sweep_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_sweep
      section%purpose = 'files for ParaView: bodies and joints swept through θ; alone, the '// &
         'whole circle'
      section%once = .true.
      section%alone = .true.
      section%stage = stage_requests
      section%read => read_sweep
      section%fields = &
         [described(real_field('the first angle', 1, from=-360.0_wp, to=360.0_wp, default=0.0_wp, &
                               symbol='theta'), 'first angle θ [degree]'), &
          described(real_field('the last angle', 11, from=-360.0_wp, to=360.0_wp, &
          default=360.0_wp, &
                               symbol='theta'), 'last angle', &
                               limits='above the first by 360 at most'), &
          described(integer_field('the number of sectors', 21, 25, 1, largest_division, &
          default=0), &
                    'number of sectors', &
                    blank='16 for each wave of the highest harmonic solved, at least 36 for '// &
                    'the circle', &
                    limits='at least one for 120 degrees')]
   end function sweep_section

   !> Read the range. The keyword alone asks for the whole circle
   subroutine read_sweep(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      real(wp) :: width
      integer :: least

      card = cards_of(deck, keyword_sweep)
      associate (sweep => deck%model%sweep, source => deck%source)
         sweep%wanted = &
            any(source%cards(:source%n_cards)%keyword == section_named(source%sections, &
            keyword_sweep))
         if (card%table%n == 0) return
         if (card%table%n > 1) then
            card%entry = 2
            call card_fault(card, 'a second card of SWEEP', allowed='one card')
         end if
         card%entry = 1
         if (.not. is_good(card)) return
         width = real_of(card, field_to) - real_of(card, field_from)
         sweep%from = degree*real_of(card, field_from)
         sweep%to = degree*real_of(card, field_to)
         sweep%n_sectors = integer_of(card, field_sectors)
         if (width <= 0.0_wp .or. width > 360.0_wp) then
            call card_fault(card, 'the last angle is not above the first by 360 degrees at most', &
                            found=to_text(width)//' degrees from the first to the last', &
                            allowed='above 0, up to 360')
            return
         end if
         least = ceiling(width/widest)
         if (.not. is_given(card, field_sectors) .or. sweep%n_sectors >= least) return
         call field_fault(card, field_sectors, 'there are too few sectors', &
                          allowed='at least '//to_text(least)//' for '//to_text(width)// &
                          ' degrees', &
                          mend='leave the field blank: then the highest harmonic tells')
      end associate
   end subroutine read_sweep

end module axijoint_deck_section_sweep
