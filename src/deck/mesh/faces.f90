!> Faces by number: outer edges of a body on a straight line, or along a chain of nodes
module axijoint_deck_mesh_faces
   use axijoint_base_number_map, only : find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, face_type
   use axijoint_deck_text_entry, only : entry_type, is_given, integer_of, lack_fault, first_card
   use axijoint_deck_text_labels, only : repeated_label
   implicit none
   private
   public :: number_face, find_face

contains

   !> Note the number of a face, and report it if another face has it
   subroutine number_face(card, field, face, draft)
      !> The card that makes it, and the field of its number
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> The face without its edges. A chain may go on on a further card of the same number
      type(face_type), intent(in) :: face
      !> The mesh
      type(draft_type), intent(inout) :: draft

      integer :: known, n

      if (.not. is_given(card, field)) then
         draft%faces_complete = .false.
         return
      end if
      known = find_number(draft%face_of, integer_of(card, field))
      if (known == 0) then
         n = size(draft%faces) + 1
         draft%faces = [draft%faces, face]
         draft%faces(n)%label = integer_of(card, field)
         draft%faces(n)%card = first_card(card)
         allocate (draft%faces(n)%edges(0))
         call insert_number(draft%face_of, draft%faces(n)%label, n)
      else if (face%is_chain .and. draft%faces(known)%is_chain) then
         draft%faces(known)%good = draft%faces(known)%good .and. face%good
      else
         call repeated_label(card, field, 'face', draft%faces(known)%card)
      end if
   end subroutine number_face

   !> Find the face that a field names, or report it
   subroutine find_face(card, field, draft, face)
      !> The card that refers to it, and the field
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Its index; 0 if there is none
      integer, intent(out) :: face

      face = 0
      if (.not. is_given(card, field)) return
      face = find_number(draft%face_of, integer_of(card, field))
      if (face > 0 .or. .not. draft%faces_complete) return
      call lack_fault(card, field, 'face '//to_text(integer_of(card, field))//' is not defined', &
                      allowed='a face of a FACES or CHAINS card, or a FACE of GROUPS')
   end subroutine find_face

end module axijoint_deck_mesh_faces
