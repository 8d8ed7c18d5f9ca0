!> Faces along physical curves of the mesh file
module axijoint_deck_gmsh_faces
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_gmsh_import, only : gmsh_import_type, use_face, name_number, name_group
   use axijoint_deck_mesh_draft, only : draft_type, face_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type, find_edge, outer_edge
   use axijoint_deck_text_entry, only : entry_type, is_given, field_fault, first_card, field_named
   use axijoint_deck_text_labels, only : repeated_label
   use axijoint_gmsh_mesh, only : dimension_of_type
   implicit none
   private
   public :: number_group_faces, lay_group_faces, lines_of_group, copies

contains

   !> Note the numbers of the faces of GROUPS
   subroutine number_group_faces(cards, import, draft)
      !> The cards of GROUPS
      class(entry_type), intent(in) :: cards
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> The mesh of the deck
      type(draft_type), intent(inout) :: draft

      class(entry_type), allocatable :: card
      type(face_type) :: face
      integer :: use, known, field

      card = cards
      field = field_named(card, name_number)
      do use = 1, size(import%uses)
         if (import%uses(use)%kind /= use_face) cycle
         card%entry = import%uses(use)%entry
         if (.not. is_given(card, field)) cycle
         associate (label => import%uses(use)%number)
            known = find_number(draft%face_of, label)
            if (known > 0) then
               call repeated_label(card, field, 'face', draft%faces(known)%card)
               cycle
            end if
            face = face_type(label=label, card=first_card(card), is_chain=.true., good=import%sound)
            allocate (face%edges(0))
            draft%faces = [draft%faces, face]
            call insert_number(draft%face_of, label, size(draft%faces))
         end associate
      end do
   end subroutine number_group_faces

   !> Find the edges of the faces of GROUPS
   subroutine lay_group_faces(cards, import, edges, draft)
      !> The cards of GROUPS
      class(entry_type), intent(in) :: cards
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh of the deck
      type(draft_type), intent(inout) :: draft

      class(entry_type), allocatable :: card
      integer, allocatable :: lines(:, :), ends(:, :)
      integer :: use, face

      if (.not. import%sound) return
      card = cards
      do use = 1, size(import%uses)
         if (import%uses(use)%kind /= use_face) cycle
         card%entry = import%uses(use)%entry
         face = find_number(draft%face_of, import%uses(use)%number)
         if (face == 0) cycle
         if (draft%faces(face)%card /= first_card(card)) cycle
         lines = lines_of_group(import, import%uses(use)%group)
         call find_ends(card, import, lines, edges, draft, ends)
         draft%faces(face)%good = size(ends, 2) == size(lines, 2)
         if (.not. draft%faces(face)%good) cycle
         call chain(card, ends, edges, draft, draft%faces(face))
      end do
   end subroutine lay_group_faces

   !> Lines of a group as pairs of nodes of the file, in the direction of the group
   pure function lines_of_group(import, group) result(lines)
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> The group
      integer, intent(in) :: group
      !> Nodes, shape (2, lines)
      integer, allocatable :: lines(:, :)

      integer, allocatable :: direction(:)
      integer :: set, element, n

      associate (mesh => import%mesh)
         allocate (direction(0:size(mesh%sets)), source=0)
         do set = 1, size(mesh%sets)
            if (any(mesh%sets(set)%groups == group)) direction(set) = 1
            if (any(mesh%sets(set)%groups == -group)) direction(set) = -1
         end do
         n = count(direction(mesh%element_set(:mesh%n_elements)) /= 0)
         allocate (lines(2, n))
         n = 0
         do element = 1, mesh%n_elements
            if (direction(mesh%element_set(element)) == 0) cycle
            if (dimension_of_type(mesh%element_type(element)) /= 1) cycle
            n = n + 1
            lines(:, n) = mesh%element_nodes([1, 2], element)
            if (direction(mesh%element_set(element)) < 0) lines(:, n) = lines([2, 1], n)
         end do
         lines = lines(:, :n)
      end associate
   end function lines_of_group

   !> Ends of the outer edge along each line, as nodes of the deck's mesh; the first line without
   !> one is reported
   subroutine find_ends(card, import, lines, edges, draft, ends)
      !> The card of GROUPS
      class(entry_type), intent(in) :: card
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> Nodes of the file, shape (2, lines)
      integer, intent(in) :: lines(:, :)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft
      !> Nodes of the deck's mesh, shape (2, lines up to the first at fault)
      integer, allocatable, intent(out) :: ends(:, :)

      integer, allocatable :: a(:), b(:), found(:, :)
      integer :: line, i, k

      allocate (ends(2, size(lines, 2)), source=0)
      do line = 1, size(lines, 2)
         a = copies(import, lines(1, line), draft)
         b = copies(import, lines(2, line), draft)
         allocate (found(2, 0))
         do i = 1, size(a)
            do k = 1, size(b)
               if (find_edge(edges, a(i), b(k)) == 0) cycle
               found = reshape([found, a(i), b(k)], [2, size(found, 2) + 1])
            end do
         end do
         if (size(found, 2) == 1) then
            ends(:, line) = found(:, 1)
            if (edges%twin(find_edge(edges, found(1, 1), found(2, 1))) /= 0) exit
         else
            exit
         end if
         deallocate (found)
      end do
      if (line > size(lines, 2)) return
      ends = ends(:, :line - 1)
      call report_line(card, place_text(import%mesh%position(:2, lines(1, line))), found, draft)
   end subroutine find_ends

   !> Nodes of the deck's mesh that a node of the file has become
   pure function copies(import, node, draft) result(nodes)
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> Node of the file
      integer, intent(in) :: node
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft
      !> Its nodes
      integer, allocatable :: nodes(:)

      integer :: copy

      allocate (nodes(0))
      if (import%first_body(node) > 0) &
         nodes = [find_number(draft%node_of, import%mesh%node_tag(node))]
      copy = import%first_copy(node)
      do while (copy > 0)
         nodes = [nodes, find_number(draft%node_of, import%copy_number(copy))]
         copy = import%next_copy(copy)
      end do
   end function copies

   !> Report a line along which no face can run
   subroutine report_line(card, place, found, draft)
      !> The card of GROUPS
      class(entry_type), intent(in) :: card
      !> Where the line begins
      character(len=*), intent(in) :: place
      !> Ends of the edges along it, shape (2, edges)
      integer, intent(in) :: found(:, :)
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft

      character(len=:), allocatable :: text, mend

      mend = ''
      select case (size(found, 2))
      case (0)
         text = 'no body has an edge along the curve at '//place
      case (1)
         text = 'the curve runs inside body '//to_text(draft%node_body(found(1, 1)))//' at '//place
      case default
         text = 'bodies '//to_text(draft%node_body(found(1, 1)))//' and '// &
                to_text(draft%node_body(found(1, 2)))//' both have an edge along the curve at '// &
                place
         mend = 'give the face on a FACES or CHAINS card, which names its body'
      end select
      call field_fault(card, field_named(card, name_group), text, &
                       allowed='a curve along outer edges of one body', mend=mend)
   end subroutine report_line

   !> Report a curve in several pieces
   subroutine report_pieces(card, first, other, draft)
      !> The card of GROUPS
      class(entry_type), intent(in) :: card
      !> Where a piece begins, and where one more does
      integer, intent(in) :: first, other
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft

      character(len=:), allocatable :: text, mend

      associate (body => draft%node_body)
         if (body(first) /= body(other)) then
            text = 'the curve runs along bodies '//to_text(body(first))//' and '//to_text(body(other))
            mend = 'make a physical curve for each body: that of the second begins at '
         else
            text = 'the curve is in several pieces'
            mend = 'make a physical curve of each piece: one more begins at '
         end if
      end associate
      call field_fault(card, field_named(card, name_group), text, allowed='one line along one body, open or closed', &
                       mend=mend//place_text(draft%position(:, other)))
   end subroutine report_pieces

   !> Put the edges of a face one after another, in the direction of the first line
   subroutine chain(card, ends, edges, draft, face)
      !> The card of GROUPS
      class(entry_type), intent(in) :: card
      !> Nodes of the lines, shape (2, lines)
      integer, intent(in) :: ends(:, :)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft
      !> The face
      type(face_type), intent(inout) :: face

      type(number_map_type) :: place_of
      integer, allocatable :: lines_at(:, :), nodes(:)
      logical, allocatable :: passed(:)
      integer :: i, k, place, n

      n = size(ends, 2)
      allocate (lines_at(2, 2*n), source=0)
      allocate (passed(n), source=.false.)
      do i = 1, n
         do k = 1, 2
            place = find_number(place_of, ends(k, i))
            if (place == 0) then
               place = 2*i + k - 2
               call insert_number(place_of, ends(k, i), place)
            end if
            if (all(lines_at(:, place) > 0)) then
               face%good = .false.
               call field_fault(card, field_named(card, name_group), 'the curve branches at '// &
                                place_text(draft%position(:, ends(k, i))), &
                                allowed='one line, open or closed')
               return
            end if
            lines_at(count(lines_at(:, place) > 0) + 1, place) = i
         end do
      end do
      passed(1) = .true.
      nodes = [walk(ends(1, 1)), ends(:, 1)]
      if (nodes(1) == nodes(size(nodes))) then
         nodes = [ends(1, 1), nodes(:size(nodes) - 1)]  ! closed: begin with the first line
      else
         nodes = [nodes, reversed(walk(ends(2, 1)))]
      end if
      if (.not. all(passed)) then
         face%good = .false.
         call report_pieces(card, ends(1, 1), ends(1, findloc(passed, .false., 1)), draft)
         return
      end if
      face%edges = [(outer_edge(draft, edges, find_edge(edges, nodes(i), nodes(i + 1)), nodes(i)), &
                     i=1, size(nodes) - 1)]
      face%body = draft%element_body(face%edges(1)%element)

   contains

      !> Nodes from the far end of the curve up to, and without, a node
      function walk(from) result(path)
         !> The node
         integer, intent(in) :: from
         !> The nodes
         integer, allocatable :: path(:)

         integer :: node, line, step

         allocate (path(n))
         node = from
         do step = 1, n
            associate (at => lines_at(:, find_number(place_of, node)))
               line = 0
               if (at(2) > 0) line = merge(at(2), at(1), passed(at(1)))
            end associate
            if (line == 0) exit
            if (passed(line)) exit
            passed(line) = .true.
            node = sum(ends(:, line)) - node
            path(n + 1 - step) = node
         end do
         path = path(n + 2 - step:)
      end function walk

      !> The same in the opposite order
      pure function reversed(path) result(other)
         !> Nodes
         integer, intent(in) :: path(:)
         !> Nodes from last to first
         integer, allocatable :: other(:)
         other = path(size(path):1:-1)
      end function reversed
   end subroutine chain

end module axijoint_deck_gmsh_faces
