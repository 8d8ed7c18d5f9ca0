!> FACES: faces on straight lines
module axijoint_deck_section_faces
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_faces
   use axijoint_deck_mesh_draft, only : draft_type, face_type
   use axijoint_deck_mesh_edges, only : edge_table_type
   use axijoint_deck_mesh_faces, only : number_face
   use axijoint_deck_mesh_straight_face, only : line_type, line_between, outer_edges, &
      lay_straight_face
   use axijoint_deck_text_common_fields, only : number, body, length
   use axijoint_deck_text_entry, only : integer_of, reals_of, is_good, &
      field_fault, lack_fault, first_card
   use axijoint_deck_text_field, only : described, with_symbol
   implicit none
   private
   public :: faces_section, lay_faces, face_ends

   !> The keyword
   character(len=*), parameter :: keyword_faces = 'FACES'
   !> Fields: number, body, r and z of both points
   integer, parameter :: field_label = 1, field_body = 2, field_first = 3, field_last = 5

contains

   !> FACES
   function faces_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_faces
      section%purpose = 'faces of all outer edges of a body on a straight line'
      section%numbered = .true.
      section%stage = stage_faces
      section%read => read_faces
      section%fields = [number('the face', 1), body(6), &
                        described([with_symbol(length('r of the first point', 11, 0.0_wp), 'r1'), &
                                   with_symbol(length('z of the first point', 21), 'z1')], &
                                  'r1 z1: first point', limits='r ≥ 0'), &
                        described([with_symbol(length('r of the last point', 31, 0.0_wp), 'r2'), &
                                   with_symbol(length('z of the last point', 41), 'z2')], &
                                  'r2 z2: last point', limits='r ≥ 0')]
   end function faces_section

   !> Note the numbers of the faces
   subroutine read_faces(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(face_type) :: face

      card = cards_of(deck, keyword_faces)
      do while (next_card(card))
         face%good = is_good(card)
         face%body = integer_of(card, field_body)
         call number_face(card, field_label, face, deck%draft)
      end do
   end subroutine read_faces

   !> Ends of all faces whose cards are sound
   function face_ends(deck) result(ends)
      !> The deck
      type(deck_type), intent(in), target :: deck
      !> r and z, shape (2, any)
      real(wp), allocatable :: ends(:, :)

      type(card_type) :: card
      integer :: n

      card = cards_of(deck, keyword_faces)
      allocate (ends(2, 2*card%table%n))
      n = 0
      do while (next_card(card))
         if (.not. is_good(card)) cycle
         ends(:, n + 1) = reals_of(card, field_first, 2)
         ends(:, n + 2) = reals_of(card, field_last, 2)
         n = n + 2
      end do
      ends = ends(:, :n)
   end function face_ends

   !> Find the edges of the faces
   subroutine lay_faces(deck)
      !> The deck with the edges of its elements
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer, allocatable :: outer(:)
      integer :: face

      outer = outer_edges(deck%edges)
      card = cards_of(deck, keyword_faces)
      do while (next_card(card))
         face = find_number(deck%draft%face_of, integer_of(card, field_label))
         if (face == 0) cycle
         associate (draft => deck%draft)
            if (draft%faces(face)%card /= first_card(card) .or. .not. draft%faces(face)%good) cycle
            call lay_face(card, deck%edges, outer, draft, draft%faces(face))
         end associate
      end do
   end subroutine lay_faces

   !> Find the edges of a face
   subroutine lay_face(card, edges, outer, draft, face)
      !> The card
      type(card_type), intent(in) :: card
      !> Edges of the elements, and which are outer edges
      type(edge_table_type), intent(in) :: edges
      integer, intent(in) :: outer(:)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face
      type(face_type), intent(inout) :: face

      type(line_type) :: line

      line = line_between(reals_of(card, field_first, 2), reals_of(card, field_last, 2), &
         draft%extent)
      if (.not. line%length > 0.0_wp) then
         face%good = .false.
         call field_fault(card, field_last, 'the face has no length', &
            allowed='two different points')
      else if (.not. any(draft%element_body(:draft%n_elements) == face%body)) then
         face%good = .false.
         call lack_fault(card, field_body, 'there is no body '//to_text(face%body), &
                         allowed='the body of an ELEMENTS or BLOCKS card (1 if blank there)')
      else
         call lay_straight_face(card, line, edges, outer, draft, face)
      end if
   end subroutine lay_face

end module axijoint_deck_section_faces
