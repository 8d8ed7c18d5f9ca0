!> CHAINS: faces along chains of nodes
module axijoint_deck_section_chains
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_faces
   use axijoint_deck_mesh_draft, only : draft_type, face_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type, find_edge, outer_edge
   use axijoint_deck_mesh_faces, only : number_face
   use axijoint_deck_text_common_fields, only : number, nodes
   use axijoint_deck_text_entry, only : is_given, integer_of, is_good, field_fault, lack_fault
   use axijoint_deck_text_field, only : described
   implicit none
   private
   public :: chains_section, lay_chains

   !> The keyword
   character(len=*), parameter :: keyword_chains = 'CHAINS'
   !> Fields; nodes from `field_node` on
   integer, parameter :: field_label = 1, field_node = 2

contains

   !> CHAINS
   function chains_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_chains
      section%purpose = 'faces along chains of corner nodes'
      section%numbered = .true.
      section%stage = stage_faces
      section%read => read_chains
      section%fields = [number('the face', 1), &
                        described(nodes('node', 15, 2, 6), 'corner nodes, two at least')]
   end function chains_section

   !> Note the numbers of the faces
   subroutine read_chains(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(face_type) :: face

      card = cards_of(deck, keyword_chains)
      do while (next_card(card))
         face%good = is_good(card)
         face%is_chain = .true.
         call number_face(card, field_label, face, deck%draft)
      end do
   end subroutine read_chains

   !> Find the edges of the faces
   subroutine lay_chains(deck)
      !> The deck with the edges of its elements
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer, allocatable :: last_node(:)
      integer :: face

      allocate (last_node(size(deck%draft%faces)), source=0)
      card = cards_of(deck, keyword_chains)
      do while (next_card(card))
         face = find_number(deck%draft%face_of, integer_of(card, field_label))
         if (face == 0) cycle
         associate (draft => deck%draft)
            if (.not. (draft%faces(face)%is_chain .and. draft%faces(face)%good)) cycle
            call lay_chain(card, deck%edges, draft, draft%faces(face), last_node(face))
         end associate
      end do
   end subroutine lay_chains

   !> Add the edges of one card to its face
   subroutine lay_chain(card, edges, draft, face, last_node)
      !> The card
      type(card_type), intent(in) :: card
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face
      type(face_type), intent(inout) :: face
      !> Node where the card before ended, 0 if there is none; where this one ends
      integer, intent(inout) :: last_node

      integer :: field, node, errors_before, edge

      errors_before = card%diagnostics%n_errors
      do field = field_node, field_node - 1 + count(card%table%given(field_node:, card%entry))
         node = find_number(draft%node_of, integer_of(card, field))
         if (.not. is_given(card, field)) then
            call field_fault(card, field, 'a node is lacking inside the chain')
         else if (node == 0) then
            call lack_fault(card, field, 'node '//to_text(integer_of(card, field))// &
               ' is not defined')
         else if (field == field_node) then
            if (all(last_node /= [0, node])) then
               call field_fault(card, field, 'the chain of face '//to_text(face%label)// &
                  ' breaks off', &
                                allowed='the node where the card before ends, ' &
                                //to_text(draft%node_label(last_node)))
            end if
         else
            call find_link(card, field, [last_node, node], edges, draft, edge)
            if (edge > 0) then
               face%body = draft%element_body(edges%element(edge))
               face%edges = [face%edges, outer_edge(draft, edges, edge, last_node)]
            end if
         end if
         if (card%diagnostics%n_errors > errors_before) exit
         last_node = node
      end do
      if (card%diagnostics%n_errors > errors_before) face%good = .false.
   end subroutine lay_chain

   !> Find the outer edge from one node of a chain to the next
   subroutine find_link(card, field, ends, edges, draft, edge)
      !> The card, and its field of the second node
      type(card_type), intent(in) :: card
      integer, intent(in) :: field
      !> The nodes
      integer, intent(in) :: ends(2)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The edge; 0 if there is none
      integer, intent(out) :: edge

      character(len=:), allocatable :: name

      edge = find_edge(edges, ends(1), ends(2))
      name = to_text(draft%node_label(ends(1)))//'-'//to_text(draft%node_label(ends(2)))
      if (edge == 0) then
         call field_fault(card, field, 'no element has the edge '//name, &
                          allowed='corner nodes, one after another along outer edges of one body', &
                          mend='from '//place_text(draft%position(:, ends(1)))// &
                          ' the card goes to ' &
                          //place_text(draft%position(:, ends(2))))
      else if (edges%twin(edge) /= 0) then
         call field_fault(card, field, 'the edge '//name//' is inside a body', &
            allowed='outer edges')
         edge = 0
      end if
   end subroutine find_link

end module axijoint_deck_section_chains
