!> PRESSURES: pressures on faces, linear along them
module axijoint_deck_section_pressures
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_loaded_face
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : harmonic, family, shape_number
   use axijoint_deck_job_modes, only : read_shares, check_torsion
   use axijoint_deck_load_lists, only : add_tractions
   use axijoint_deck_load_shares, only : share_type
   use axijoint_deck_mesh_face_geometry, only : linear_along, inward_normals
   use axijoint_deck_text_common_fields, only : face_field => face
   use axijoint_deck_text_entry, only : is_given, real_of, is_sound
   use axijoint_deck_text_field, only : real_field, described
   implicit none
   private
   public :: pressures_section

   !> The keyword
   character(len=*), parameter :: keyword_pressures = 'PRESSURES'
   !> Fields: the face, pressures at its first and at its last point
   integer, parameter :: field_face = 1, field_first = 3, field_last = 4

contains

   !> PRESSURES
   function pressures_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_pressures
      section%purpose = 'pressures on faces, linear along them'
      section%is_load = .true.
      section%stage = stage_loads
      section%read => read_pressures
      section%fields = &
         [face_field(1), harmonic(6), &
          described(real_field('p at the first point', 11), &
                    'p [stress] at the first point of the face, positive into the body', &
                    limits='any'), &
          described(real_field('p at the last point', 21, default=0.0_wp), 'p at its last point', &
                    blank='as at the first', limits='any'), &
          family(31), shape_number(36)]
   end function pressures_section

   !> Add the pressures
   subroutine read_pressures(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_pressures)
      do while (next_card(card))
         call read_pressure(card)
      end do
   end subroutine read_pressures

   !> Pressure that varies linearly with the arc length, along the normals at the nodes
   subroutine read_pressure(card)
      !> A card of PRESSURES
      type(card_type), intent(in) :: card

      type(share_type), allocatable :: shares(:)
      real(wp), allocatable :: pressure(:, :, :), normal(:, :, :), traction(:, :, :)
      real(wp) :: last
      integer :: face

      call check_torsion(card, 'pressure')
      call find_loaded_face(card, field_face, face)
      call read_shares(card, shares)
      if (face == 0 .or. .not. is_sound(card)) return
      last = real_of(card, merge(field_last, field_first, is_given(card, field_last)))
      associate (edges => card%deck%draft%faces(face)%edges)
         allocate (traction(3, 3, size(edges)), source=0.0_wp)
         pressure = linear_along(card%deck%draft, edges, [real_of(card, field_first)], [last])
         normal = inward_normals(card%deck%draft, edges)
         traction(1, :, :) = pressure(1, :, :)*normal(1, :, :)
         traction(2, :, :) = pressure(1, :, :)*normal(2, :, :)
         call add_tractions(card%deck%loads, card%case, edges, traction, shares)
      end associate
   end subroutine read_pressure

end module axijoint_deck_section_pressures
