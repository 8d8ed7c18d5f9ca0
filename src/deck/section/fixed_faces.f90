!> FIXEDFACES: fixed displacements of faces
module axijoint_deck_section_fixed_faces
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_holds, only : code, hold
   use axijoint_deck_job_load_fields, only : harmonic_range
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_mesh_faces, only : find_face
   use axijoint_deck_text_common_fields, only : face_field => face
   implicit none
   private
   public :: fixed_faces_section

   !> The keyword
   character(len=*), parameter :: keyword_fixed_faces = 'FIXEDFACES'
   !> Field of the face
   integer, parameter :: field_face = 1

contains

   !> FIXEDFACES
   function fixed_faces_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_fixed_faces
      section%purpose = 'fixed displacements of faces'
      section%is_support = .true.
      section%stage = stage_loads
      section%read => read_fixed_faces
      section%fields = [face_field(1), code(6), harmonic_range(11)]
   end function fixed_faces_section

   !> Hold the faces
   subroutine read_fixed_faces(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: face

      card = cards_of(deck, keyword_fixed_faces)
      do while (next_card(card))
         call find_face(card, field_face, deck%draft, face)
         call hold(card, nodes_of_face(deck%draft, face))
      end do
   end subroutine read_fixed_faces

   !> Nodes of a face; none if it is at fault itself
   pure function nodes_of_face(draft, face) result(nodes)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face; 0 for none
      integer, intent(in) :: face
      !> Its nodes, some of them twice
      integer, allocatable :: nodes(:)

      integer :: i

      allocate (nodes(0))
      if (face == 0) return
      if (.not. draft%faces(face)%good) return
      associate (edges => draft%faces(face)%edges)
         nodes = [(edges(i)%nodes, i=1, size(edges))]
      end associate
      nodes = pack(nodes, nodes > 0)
   end function nodes_of_face

end module axijoint_deck_section_fixed_faces
