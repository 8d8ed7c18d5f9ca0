!> MOVEDFACES: given displacements of faces, linear along them
module axijoint_deck_section_moved_faces
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_any_face
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : sole_harmonic, sole_family, held_in, displacements
   use axijoint_deck_job_modes, only : read_shares, check_components
   use axijoint_deck_job_moves, only : check_given, move_node, component_name
   use axijoint_deck_load_shares, only : share_type
   use axijoint_deck_mesh_face_geometry, only : linear_along
   use axijoint_deck_text_common_fields, only : face_field => face
   use axijoint_deck_text_entry, only : is_given, reals_of, is_good, is_sound, field_fault
   use axijoint_deck_text_field, only : described
   implicit none
   private
   public :: moved_faces_section

   !> The keyword
   character(len=*), parameter :: keyword_moved_faces = 'MOVEDFACES'
   !> The face; first components of its first and of its last point
   integer, parameter :: field_face = 1, field_first = 3, field_last = 6

contains

   !> MOVEDFACES
   function moved_faces_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_moved_faces
      section%purpose = 'given displacements of faces, linear along them'
      section%is_load = .true.
      section%is_support = .true.
      section%stage = stage_loads
      section%read => read_moved_faces
      section%fields = &
         [face_field(1), sole_harmonic(6), &
          described(displacements(' at the first point', 11), &
                    'u v w [length] at the first point of the face', &
                    blank='not held by this card', limits='one at least must be given'), &
          described(displacements(' at the last point', 41), 'the same at its last point', &
                    blank='as at the first'), &
          sole_family(71), held_in(76)]
   end function moved_faces_section

   !> Note the displacements
   subroutine read_moved_faces(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_moved_faces)
      do while (next_card(card))
         call read_face(card)
      end do
   end subroutine read_moved_faces

   !> Displacements that vary linearly with the arc length along a face
   subroutine read_face(card)
      !> A card of MOVEDFACES
      type(card_type), intent(in) :: card

      type(share_type), allocatable :: shares(:)
      real(wp), allocatable :: values(:, :, :)
      real(wp) :: last(3)
      logical :: given(3), given_last(3)
      integer :: face, i, k

      given = [(is_given(card, field_first + i), i=0, 2)]
      given_last = [(is_given(card, field_last + i), i=0, 2)]
      do i = 1, 3
         if (given(i) .or. .not. given_last(i) .or. .not. is_good(card)) cycle
         call field_fault(card, field_first - 1 + i, component_name(i)// &
                          ' at the first point is blank', &
                          allowed='values at both points, or at the first alone')
      end do
      call check_given(card, field_first, given .or. given_last)
      call check_components(card, 'displacement', field_first, 6)
      call read_shares(card, shares)
      call find_any_face(card, field_face, face)
      if (face == 0 .or. .not. is_sound(card)) return
      last = merge(reals_of(card, field_last, 3), reals_of(card, field_first, 3), given_last)
      associate (edges => card%deck%draft%faces(face)%edges)
         values = linear_along(card%deck%draft, edges, reals_of(card, field_first, 3), last)
         do i = 1, size(edges)
            do k = 1, count(edges(i)%nodes > 0)
               call move_node(card, field_first, edges(i)%nodes(k), given, values(:, k, i))
            end do
         end do
      end associate
   end subroutine read_face

end module axijoint_deck_section_moved_faces
