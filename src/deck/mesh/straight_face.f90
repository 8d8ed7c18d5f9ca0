!> The outer edges of a body on a straight line
module axijoint_deck_mesh_straight_face
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : ascending_order
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, face_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type, outer_edge
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, field_error, entry_error
   implicit none
   private
   public :: outer_edges, lay_straight_face

   !> Fields of FACES
   integer, parameter :: field_body = 2, field_first = 3, field_last = 5
   !> Distance of an edge from the line of its face, in extents of the model: the
   !> ends of the line are typed with few digits
   real(wp), parameter :: line_tolerance = 1.0e-6_wp

   !> A line
   type :: line_type
      !> First and last point
      real(wp) :: first(2) = 0.0_wp, last(2) = 0.0_wp
      !> Unit vector from first to last, and their distance
      real(wp) :: direction(2) = 0.0_wp, length = 0.0_wp
      !> Distance at which a point counts as on the line
      real(wp) :: tolerance = 0.0_wp
   end type line_type

contains

   !> Indices of the edges that one element has
   pure function outer_edges(edges) result(outer)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> Indices
      integer, allocatable :: outer(:)

      integer :: i, n

      allocate (outer(count(edges%twin == 0)))
      n = 0
      do i = 1, edges%n
         if (edges%twin(i) /= 0) cycle
         n = n + 1
         outer(n) = i
      end do
   end function outer_edges

   !> Find the edges of a straight face
   subroutine lay_straight_face(source, table, entry, edges, outer, draft, face, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> FACES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Edges of the elements, and which are outer edges
      type(edge_table_type), intent(in) :: edges
      integer, intent(in) :: outer(:)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face
      type(face_type), intent(inout) :: face
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(line_type) :: line
      integer, allocatable :: found(:)
      integer :: i, first
      real(wp), allocatable :: start(:)

      line%first = table%values(field_first:field_first + 1, entry)
      line%last = table%values(field_last:field_last + 1, entry)
      line%length = norm2(line%last - line%first)
      line%tolerance = line_tolerance*draft%extent
      face%good = .false.
      if (line%length <= 2.0_wp*line%tolerance) then
         call field_error(diagnostics, source, table, entry, field_last, 'the face has no length', &
                          allowed='two different points')
         return
      end if
      line%direction = (line%last - line%first)/line%length
      call edges_on_line(line, face%body, edges, outer, draft, found)
      if (size(found) == 0) then
         call report_no_edges(source, table, entry, line, edges, outer, draft, diagnostics)
         return
      end if
      start = [(minval(distances(line, draft, edges%nodes(:, found(i)))), i=1, size(found))]
      found = found(ascending_order(start))
      deallocate (face%edges)
      allocate (face%edges(size(found)))
      do i = 1, size(found)
         associate (nodes => edges%nodes(:, found(i)))
            first = nodes(minloc(distances(line, draft, nodes), 1))
         end associate
         face%edges(i) = outer_edge(draft, edges, found(i), first)
      end do
      call check_cover(table, entry, line, draft, face, diagnostics)
   end subroutine lay_straight_face

   !> Distances of an edge's corner nodes from the first point, along the line
   pure function distances(line, draft, nodes)
      !> The line
      type(line_type), intent(in) :: line
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Nodes of the edge
      integer, intent(in) :: nodes(:)
      !> Distances
      real(wp) :: distances(2)

      distances = [dot_product(draft%position(:, nodes(1)) - line%first, line%direction), &
                   dot_product(draft%position(:, nodes(2)) - line%first, line%direction)]
   end function distances

   !> Outer edges of a body between the ends of a line
   pure subroutine edges_on_line(line, body, edges, outer, draft, found)
      !> The line
      type(line_type), intent(in) :: line
      !> The body; 0 for any
      integer, intent(in) :: body
      !> Edges of the elements, and which are outer edges
      type(edge_table_type), intent(in) :: edges
      integer, intent(in) :: outer(:)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Indices of the edges
      integer, allocatable, intent(out) :: found(:)

      logical, allocatable :: on_line(:)
      integer :: i

      allocate (on_line(size(outer)))
      do i = 1, size(outer)
         on_line(i) = body == 0 .or. draft%element_body(edges%element(outer(i))) == body
         if (on_line(i)) on_line(i) = is_on_line(line, draft, edges%nodes(:, outer(i)))
      end do
      found = pack(outer, on_line)
   end subroutine edges_on_line

   !> Whether all nodes of an edge are on a line, between its ends
   pure logical function is_on_line(line, draft, nodes)
      !> The line
      type(line_type), intent(in) :: line
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Nodes of the edge
      integer, intent(in) :: nodes(:)

      real(wp) :: offset(2), along, across
      integer :: i

      is_on_line = .true.
      do i = 1, count(nodes > 0)
         offset = draft%position(:, nodes(i)) - line%first
         along = dot_product(offset, line%direction)
         across = offset(1)*line%direction(2) - offset(2)*line%direction(1)
         is_on_line = is_on_line .and. abs(across) <= line%tolerance .and. &
                      along >= -line%tolerance .and. along <= line%length + line%tolerance
      end do
   end function is_on_line

   !> Report a line without outer edges of the body
   subroutine report_no_edges(source, table, entry, line, edges, outer, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> FACES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The line
      type(line_type), intent(in) :: line
      !> Edges of the elements, and which are outer edges
      type(edge_table_type), intent(in) :: edges
      integer, intent(in) :: outer(:)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: found(:)
      integer :: body

      body = nint(table%values(field_body, entry))
      if (.not. any(draft%element_body(:draft%n_elements) == body)) then
         call field_error(diagnostics, source, table, entry, field_body, &
                          'there is no body '//to_text(body), &
                          allowed='the body of an ELEMENTS or BLOCKS card (1 if blank there)')
         return
      end if
      call edges_on_line(line, 0, edges, outer, draft, found)
      if (size(found) > 0) then
         call entry_error(diagnostics, table, entry, 'body '//to_text(body)//' has no outer edge on this line', &
                          mend='body '//to_text(draft%element_body(edges%element(found(1))))//' has')
      else
         call entry_error(diagnostics, table, entry, 'body '//to_text(body)//' has no outer edge on this line', &
                          allowed='a line from node to node along the outside of the body')
      end if
   end subroutine report_no_edges

   !> Check that the edges of a face follow each other from end to end
   subroutine check_cover(table, entry, line, draft, face, diagnostics)
      !> FACES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The line
      type(line_type), intent(in) :: line
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face
      type(face_type), intent(inout) :: face
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: reached(2), next(2)
      integer :: i, n

      n = size(face%edges)
      reached = line%first
      do i = 1, n + 1
         next = line%last
         if (i <= n) next = draft%position(:, face%edges(i)%nodes(1))
         if (norm2(next - reached) > 2.0_wp*line%tolerance) then
            call entry_error(diagnostics, table, entry, 'face '//to_text(face%label)// &
                             ' is not covered by outer edges of body '//to_text(face%body), &
                             found='no edge from '//place_text(reached)//' to '//place_text(next), &
                             mend='end the face at nodes; use several faces where the outline bends')
            return
         end if
         if (i <= n) reached = draft%position(:, face%edges(i)%nodes(2))
      end do
      face%good = .true.
   end subroutine check_cover

end module axijoint_deck_mesh_straight_face
