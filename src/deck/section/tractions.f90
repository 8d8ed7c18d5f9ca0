!> TRACTIONS: tractions on faces, linear along them
module axijoint_deck_section_tractions
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_loaded_face
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : harmonic, family, shape_number
   use axijoint_deck_job_modes, only : read_shares, check_components
   use axijoint_deck_load_lists, only : add_tractions
   use axijoint_deck_load_shares, only : share_type
   use axijoint_deck_mesh_face_geometry, only : linear_along
   use axijoint_deck_text_common_fields, only : face_field => face, components
   use axijoint_deck_text_entry, only : is_given, reals_of, is_good, is_sound, field_fault
   use axijoint_deck_text_field, only : described
   implicit none
   private
   public :: tractions_section

   !> The keyword
   character(len=*), parameter :: keyword_tractions = 'TRACTIONS'
   !> Fields: the face, three amplitudes at its first and at its last point
   integer, parameter :: field_face = 1, field_first = 3, field_last = 6

contains

   !> TRACTIONS
   function tractions_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_tractions
      section%purpose = 'tractions on faces, linear along them'
      section%is_load = .true.
      section%stage = stage_loads
      section%read => read_tractions
      section%fields = &
         [face_field(1), harmonic(6), &
          described(components('t', ' at the first point', 11), &
                    't_r t_z t_θ [stress] at the first point of the face', &
                    limits='one at least of all six must be given'), &
          described(components('t', ' at the last point', 41), 'the same at its last point', &
                    blank='each as at the first point'), &
          family(71), shape_number(76)]
   end function tractions_section

   !> Add the tractions
   subroutine read_tractions(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_tractions)
      do while (next_card(card))
         call read_traction(card)
      end do
   end subroutine read_tractions

   !> Tractions that vary linearly with the arc length between the ends of a face
   subroutine read_traction(card)
      !> A card of TRACTIONS
      type(card_type), intent(in) :: card

      type(share_type), allocatable :: shares(:)
      real(wp) :: last(3)
      integer :: face, i

      if (is_good(card) .and. &
          .not. any([(is_given(card, field_first + i), i=0, 5)])) then
         call field_fault(card, field_first, 'the card gives no load', &
                          allowed='at least one amplitude; blank ones are 0')
      end if
      call check_components(card, 'load', field_first, 6)
      call find_loaded_face(card, field_face, face)
      call read_shares(card, shares)
      if (face == 0 .or. .not. is_sound(card)) return
      last = merge(reals_of(card, field_last, 3), reals_of(card, field_first, 3), &
                   [(is_given(card, field_last + i), i=0, 2)])
      associate (edges => card%deck%draft%faces(face)%edges)
         call add_tractions(card%deck%loads, card%case, edges, &
                            linear_along(card%deck%draft, edges, reals_of(card, field_first, 3), &
                            last), shares)
      end associate
   end subroutine read_traction

end module axijoint_deck_section_tractions
