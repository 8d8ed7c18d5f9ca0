!> An entry of a section with the deck that it is read into; what cards refer to
module axijoint_deck_job_card
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_deck, only : deck_type
   use axijoint_deck_load_cases, only : case_of_card
   use axijoint_deck_mesh_face_geometry, only : moment_of_radius
   use axijoint_deck_mesh_faces, only : find_face
   use axijoint_deck_mesh_node_range, only : find_nodes
   use axijoint_deck_text_entry, only : entry_type, next_entry, is_given, integer_of, &
      field_fault, lack_fault, &
      first_card
   use axijoint_deck_text_sections, only : table_of
   implicit none
   private
   public :: card_type, cards_of, next_card
   public :: find_loaded_face, find_any_face, find_node, find_row, check_body

   !> One entry of a section, and the deck around it
   type, extends(entry_type) :: card_type
      !> The deck
      type(deck_type), pointer :: deck => null()
      !> The section
      character(len=12) :: keyword = ''
      !> Load case that the entry belongs to (index)
      integer :: case = 1
   end type card_type

contains

   !> The entries of a section; `next_card` goes to the first
   function cards_of(deck, keyword) result(card)
      !> The deck
      type(deck_type), intent(in), target :: deck
      !> Keyword of the section
      character(len=*), intent(in) :: keyword
      !> Place 0 among them
      type(card_type) :: card

      card%deck => deck
      card%keyword = keyword
      card%source => deck%source
      card%diagnostics => deck%diagnostics
      card%table => table_of(deck%sections, keyword)
      card%errors_before = deck%diagnostics%n_errors
   end function cards_of

   !> Go on to the next entry of the section
   logical function next_card(card) result(there_is_one)
      !> The entry
      type(card_type), intent(inout) :: card

      there_is_one = next_entry(card)
      if (there_is_one .and. allocated(card%deck%cases%cards)) &
         card%case = case_of_card(card%deck%cases, first_card(card))
   end function next_card

   !> Find the face that a field names, or report it
   subroutine find_any_face(card, field, face)
      !> The card, and its field
      type(card_type), intent(in) :: card
      integer, intent(in) :: field
      !> Its index; 0 if there is none, or if it is at fault itself
      integer, intent(out) :: face

      call find_face(card, field, card%deck%draft, face)
      if (face == 0) return
      if (.not. card%deck%draft%faces(face)%good) face = 0
   end subroutine find_any_face

   !> Find the face that a field names, and check that it has an area
   subroutine find_loaded_face(card, field, face)
      !> The card, and its field
      type(card_type), intent(in) :: card
      integer, intent(in) :: field
      !> Its index; 0 if there is none, or if it is at fault itself
      integer, intent(out) :: face

      call find_any_face(card, field, face)
      if (face == 0) return
      associate (draft => card%deck%draft)
         if (moment_of_radius(draft, draft%faces(face)%edges, 1) > 0.0_wp) return
      end associate
      call field_fault(card, field, 'the loaded face lies on the axis: it has no area', &
                       allowed='a face with r > 0')
      face = 0
   end subroutine find_loaded_face

   !> Find the node that a field names, or report it
   subroutine find_node(card, field, node)
      !> The card, and its field
      type(card_type), intent(in) :: card
      integer, intent(in) :: field
      !> Its index; 0 if there is none, or if it is at fault itself
      integer, intent(out) :: node

      node = 0
      if (.not. is_given(card, field)) return
      node = find_number(card%deck%draft%node_of, integer_of(card, field))
      if (node > 0) then
         if (.not. card%deck%draft%node_good(node)) node = 0
      else if (card%deck%draft%nodes_complete) then
         call lack_fault(card, field, 'node '//to_text(integer_of(card, field))//' is not defined')
      end if
   end subroutine find_node

   !> Find the nodes first, first + step, ..., last, or report those that do not exist
   subroutine find_row(card, nodes)
      !> The card
      type(card_type), intent(in) :: card
      !> Their indices; none if one is at fault
      integer, allocatable, intent(out) :: nodes(:)

      call find_nodes(card, card%deck%draft, nodes)
      if (.not. all(card%deck%draft%node_good(nodes))) nodes = [integer ::]
   end subroutine find_row

   !> Check that the body of a field, if it is given, has elements
   subroutine check_body(card, field)
      !> The card, and its field
      type(card_type), intent(in) :: card
      integer, intent(in) :: field

      associate (draft => card%deck%draft)
         if (.not. is_given(card, field) .or. .not. draft%elements_complete) return
         if (any(draft%element_body(:draft%n_elements) == integer_of(card, field))) return
      end associate
      call lack_fault(card, field, 'there is no body '//to_text(integer_of(card, field)), &
                      allowed='the body of an ELEMENTS or BLOCKS card (1 if blank there)')
   end subroutine check_body

end module axijoint_deck_job_card
