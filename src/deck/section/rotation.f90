!> ROTATION: rotation about the axis
module axijoint_deck_section_rotation
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_modes, only : needs_harmonic
   use axijoint_deck_load_lists, only : add_body_load
   use axijoint_deck_text_entry, only : real_of, is_sound, field_fault
   use axijoint_deck_text_field, only : real_field, described
   use axijoint_deck_text_section, only : needs_density
   use axijoint_fe_mode, only : mode_type, family_symmetric
   use axijoint_model_load, only : body_load_type
   implicit none
   private
   public :: rotation_section

   !> The keyword
   character(len=*), parameter :: keyword_rotation = 'ROTATION'
   !> Field
   integer, parameter :: field_velocity = 1

contains

   !> ROTATION
   function rotation_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_rotation
      section%purpose = 'centrifugal forces of what has a density'
      section%is_load = .true.
      section%needs = needs_density
      section%stage = stage_loads
      section%read => read_rotation
      section%fields = &
         [described(real_field('the angular velocity', 1), &
                    'angular velocity ω about the axis [radian/time]', &
                    limits='any')]
   end function rotation_section

   !> Add the rotations
   subroutine read_rotation(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_rotation)
      do while (next_card(card))
         call read_spin(card)
      end do
   end subroutine read_rotation

   !> Rotation about the axis
   subroutine read_spin(card)
      !> A card of ROTATION
      type(card_type), intent(in) :: card

      call needs_harmonic(card, 0, 'rotation')
      if (any(card%deck%loads%body_loads%case == card%case &
              .and. card%deck%loads%body_loads%spin_squared > 0.0_wp)) then
         call field_fault(card, field_velocity, 'the load case has a rotation already', &
                          allowed='one angular velocity in a load case', &
                          mend='centrifugal forces go with its square: they do not add up')
      end if
      if (.not. is_sound(card)) return
      call add_body_load(card%deck%loads, body_load_type(mode_type(0, family_symmetric), &
         card%case, &
                                                         spin_squared=real_of(card, &
                                                         field_velocity)**2))
   end subroutine read_spin

end module axijoint_deck_section_rotation
