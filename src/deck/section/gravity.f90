!> GRAVITY: weight along z and sideways
module axijoint_deck_section_gravity
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_modes, only : needs_harmonic
   use axijoint_deck_load_lists, only : add_body_load
   use axijoint_deck_load_shares, only : share_type, directed_shares
   use axijoint_deck_text_common_fields, only : angle
   use axijoint_deck_text_entry, only : real_of, is_good, is_sound, field_fault
   use axijoint_deck_text_field, only : real_field, described
   use axijoint_deck_text_section, only : needs_density
   use axijoint_fe_mode, only : mode_type, family_symmetric
   use axijoint_model_load, only : body_load_type
   implicit none
   private
   public :: gravity_section

   !> The keyword
   character(len=*), parameter :: keyword_gravity = 'GRAVITY'
   !> Fields
   integer, parameter :: field_z = 1, field_lateral = 2, field_direction = 3

contains

   !> GRAVITY
   function gravity_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_gravity
      section%purpose = 'weight along z and sideways, of what has a density'
      section%is_load = .true.
      section%needs = needs_density
      section%stage = stage_loads
      section%read => read_gravity
      section%fields = &
         [described(real_field('g_z', 1, default=0.0_wp), &
                    'g_z [length/time²], positive upwards: usually negative', &
                    limits='one of both must not be 0'), &
          described(real_field('the lateral g', 11, default=0.0_wp), 'lateral g'), &
          described(angle('theta0', 21), 'its direction θ0 [degree]')]
   end function gravity_section

   !> Add the weights
   subroutine read_gravity(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_gravity)
      do while (next_card(card))
         call read_weight(card)
      end do
   end subroutine read_gravity

   !> Gravity along z, and lateral gravity: a_r = g cos(theta - theta0), a_theta = -g sin(..)
   subroutine read_weight(card)
      !> A card of GRAVITY
      type(card_type), intent(in) :: card

      type(share_type) :: shares(2)
      logical :: along_z, lateral
      integer :: k

      along_z = abs(real_of(card, field_z)) > 0.0_wp
      lateral = abs(real_of(card, field_lateral)) > 0.0_wp
      if (.not. (along_z .or. lateral) .and. is_good(card)) then
         call field_fault(card, field_z, 'the card gives no load', &
            allowed='g_z, lateral g, or both')
      end if
      if (along_z) call needs_harmonic(card, 0, 'gravity along z')
      if (lateral) call needs_harmonic(card, 1, 'lateral gravity')
      if (.not. is_sound(card)) return
      if (along_z) &
         call add_body_load(card%deck%loads, body_load_type(mode_type(0, family_symmetric), &
         card%case, [0.0_wp, real_of(card, field_z), 0.0_wp]))
      shares = directed_shares(real_of(card, field_direction))
      do k = 1, 2
         associate (g => shares(k)%factor*real_of(card, field_lateral))
            if (.not. any(abs(g) > 0.0_wp)) cycle
            call add_body_load(card%deck%loads, &
                               body_load_type(shares(k)%mode, card%case, [g(1), 0.0_wp, -g(3)]))
         end associate
      end do
   end subroutine read_weight

end module axijoint_deck_section_gravity
