!> TEMPERATURES: temperatures of bodies, linear in r and z
module axijoint_deck_section_temperatures
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, check_body
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : any_body, harmonic, family, shape_number
   use axijoint_deck_job_modes, only : read_shares, check_torsion
   use axijoint_deck_load_lists, only : add_temperatures
   use axijoint_deck_load_shares, only : share_type
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, is_sound, &
      field_fault
   use axijoint_deck_text_field, only : real_field, described
   use axijoint_deck_text_section, only : needs_expansion
   implicit none
   private
   public :: temperatures_section

   !> The keyword
   character(len=*), parameter :: keyword_temperatures = 'TEMPERATURES'
   !> Fields: the body; constant, growth along r and along z
   integer, parameter :: field_body = 1, field_0 = 3, field_r = 4, field_z = 5

contains

   !> TEMPERATURES
   function temperatures_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_temperatures
      section%purpose = 'changes of temperature of bodies, linear in r and z'
      section%is_load = .true.
      section%needs = needs_expansion
      section%stage = stage_loads
      section%read => read_temperatures
      section%fields = &
         [any_body(1), harmonic(6), &
          described([real_field('T0', 11, default=0.0_wp), &
          real_field('dT/dr', 21, default=0.0_wp), &
                     real_field('dT/dz', 31, default=0.0_wp)], &
                    'T0, dT/dr, dT/dz: T = T0 + r dT/dr + z dT/dz', &
                    limits='one at least must be given'), &
          family(41), shape_number(46)]
   end function temperatures_section

   !> Add the temperatures
   subroutine read_temperatures(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_temperatures)
      do while (next_card(card))
         call read_temperature(card)
      end do
   end subroutine read_temperatures

   !> Temperature that is linear in r and z
   subroutine read_temperature(card)
      !> A card of TEMPERATURES
      type(card_type), intent(in) :: card

      type(share_type), allocatable :: shares(:)
      integer :: k, field

      if (is_good(card) .and. &
          .not. any([(is_given(card, field), field=field_0, field_z)])) then
         call field_fault(card, field_0, 'the card gives no temperature', &
                          allowed='T0, dT/dr, dT/dz: one at least')
      end if
      call check_body(card, field_body)
      call check_torsion(card, 'temperature')
      call read_shares(card, shares)
      if (.not. is_sound(card)) return
      associate (x => card%deck%draft%position(:, :card%deck%draft%n_nodes))
         call add_temperatures(card%deck%loads, card%case, shares, integer_of(card, field_body), &
                               [(k, k=1, card%deck%draft%n_nodes)], &
                               real_of(card, field_0) + real_of(card, field_r)*x(1, :) &
                               + real_of(card, field_z)*x(2, :))
      end associate
   end subroutine read_temperature

end module axijoint_deck_section_temperatures
