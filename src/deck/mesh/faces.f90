!> Faces: outer edges of a body on a straight line, or along a chain of nodes
module axijoint_deck_mesh_faces
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, face_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type, find_edge, outer_edge
   use axijoint_deck_mesh_straight_face, only : outer_edges, lay_straight_face
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_labels, only : repeated_label
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error
   implicit none
   private
   public :: number_faces, lay_faces, find_face

   !> Fields of FACES and of CHAINS
   integer, parameter :: field_label = 1, field_body = 2, field_node = 2

contains

   !> Note the numbers of all faces
   subroutine number_faces(source, straight, chains, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> FACES and CHAINS
      type(table_type), intent(in) :: straight, chains
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, n

      allocate (draft%faces(straight%n + chains%n))
      n = 0
      do entry = 1, straight%n
         call number_face(source, straight, entry, .false., n, draft, diagnostics)
      end do
      do entry = 1, chains%n
         call number_face(source, chains, entry, .true., n, draft, diagnostics)
      end do
      draft%faces = draft%faces(:n)
   end subroutine number_faces

   !> Note the number of one face
   subroutine number_face(source, table, entry, is_chain, n, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> FACES or CHAINS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Whether it is a chain, which may go on on a further card
      logical, intent(in) :: is_chain
      !> Number of faces
      integer, intent(inout) :: n
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: label, known

      if (.not. table%given(field_label, entry)) then
         draft%faces_complete = .false.
         return
      end if
      label = integer_value(table, field_label, entry)
      known = find_number(draft%face_of, label)
      if (known == 0) then
         n = n + 1
         call insert_number(draft%face_of, label, n)
         draft%faces(n)%label = label
         draft%faces(n)%card = table%cards(1, entry)
         draft%faces(n)%good = table%good(entry)
         draft%faces(n)%is_chain = is_chain
         if (.not. is_chain) draft%faces(n)%body = integer_value(table, field_body, entry)
         allocate (draft%faces(n)%edges(0))
      else if (is_chain .and. draft%faces(known)%is_chain) then
         draft%faces(known)%good = draft%faces(known)%good .and. table%good(entry)
      else
         call repeated_label(source, table, entry, field_label, 'face', draft%faces(known)%card, diagnostics)
      end if
   end subroutine number_face

   !> Find the face that a field names, or report it
   subroutine find_face(source, table, entry, field, draft, face, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section that refers to it
      type(table_type), intent(in) :: table
      !> Entry and field
      integer, intent(in) :: entry, field
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Its index; 0 if there is none
      integer, intent(out) :: face
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      face = 0
      if (.not. table%given(field, entry)) return
      face = find_number(draft%face_of, integer_value(table, field, entry))
      if (face > 0 .or. .not. draft%faces_complete) return
      call field_error(diagnostics, source, table, entry, field, &
                       'face '//to_text(integer_value(table, field, entry))//' is not defined', &
                       allowed='a face of a FACES or CHAINS card, or a FACE of GROUPS')
   end subroutine find_face

   !> Find the edges of all faces
   subroutine lay_faces(source, straight, chains, edges, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> FACES and CHAINS
      type(table_type), intent(in) :: straight, chains
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: outer(:), last_node(:)
      integer :: entry, face

      outer = outer_edges(edges)
      allocate (last_node(size(draft%faces)), source=0)
      do entry = 1, straight%n
         face = find_number(draft%face_of, integer_value(straight, field_label, entry))
         if (face == 0) cycle
         if (draft%faces(face)%card /= straight%cards(1, entry) .or. .not. draft%faces(face)%good) cycle
         call lay_straight_face(source, straight, entry, edges, outer, draft, draft%faces(face), diagnostics)
      end do
      do entry = 1, chains%n
         face = find_number(draft%face_of, integer_value(chains, field_label, entry))
         if (face == 0) cycle
         if (.not. (draft%faces(face)%is_chain .and. draft%faces(face)%good)) cycle
         call lay_chain(source, chains, entry, edges, draft, draft%faces(face), last_node(face), &
                        diagnostics)
      end do
   end subroutine lay_faces

   !> Add the edges of one CHAINS card to its face
   subroutine lay_chain(source, table, entry, edges, draft, face, last_node, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> CHAINS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face
      type(face_type), intent(inout) :: face
      !> Node where the card before ended, 0 if there is none; where this one ends
      integer, intent(inout) :: last_node
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, n, node, errors_before, edge

      errors_before = diagnostics%n_errors
      n = count(table%given(field_node:, entry))
      do i = 1, n
         node = find_number(draft%node_of, integer_value(table, field_node + i - 1, entry))
         if (.not. table%given(field_node + i - 1, entry)) then
            call field_error(diagnostics, source, table, entry, field_node + i - 1, &
                             'a node is lacking inside the chain')
         else if (node == 0) then
            call field_error(diagnostics, source, table, entry, field_node + i - 1, 'node '// &
                             to_text(integer_value(table, field_node + i - 1, entry))//' is not defined')
         else if (i == 1) then
            if (all(last_node /= [0, node])) then
               call field_error(diagnostics, source, table, entry, field_node, &
                                'the chain of face '//to_text(face%label)//' breaks off', &
                                allowed='the node where the card before ends, ' &
                                //to_text(draft%node_label(last_node)))
            end if
         else
            call check_link(source, table, entry, field_node + i - 1, edges, draft, face, &
                            last_node, node, edge, diagnostics)
            if (edge > 0) face%edges = [face%edges, outer_edge(draft, edges, edge, last_node)]
         end if
         if (diagnostics%n_errors > errors_before) exit
         last_node = node
      end do
      if (diagnostics%n_errors > errors_before) face%good = .false.
   end subroutine lay_chain

   !> Find the outer edge from one node of a chain to the next
   subroutine check_link(source, table, entry, field, edges, draft, face, from, to, edge, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> CHAINS
      type(table_type), intent(in) :: table
      !> Entry, and field of the second node
      integer, intent(in) :: entry, field
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face; the first edge gives it its body
      type(face_type), intent(inout) :: face
      !> The nodes
      integer, intent(in) :: from, to
      !> The edge; 0 if there is none
      integer, intent(out) :: edge
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: name

      edge = find_edge(edges, from, to)
      name = to_text(draft%node_label(from))//'-'//to_text(draft%node_label(to))
      if (edge == 0) then
         call field_error(diagnostics, source, table, entry, field, 'no element has the edge '//name, &
                          allowed='corner nodes, one after another along outer edges of one body', &
                          mend='from '//place_text(draft%position(:, from))//' the card goes to ' &
                          //place_text(draft%position(:, to)))
      else if (edges%twin(edge) /= 0) then
         call field_error(diagnostics, source, table, entry, field, &
                          'the edge '//name//' is inside a body', allowed='outer edges')
         edge = 0
      else
         face%body = draft%element_body(edges%element(edge))
      end if
   end subroutine check_link

end module axijoint_deck_mesh_faces
