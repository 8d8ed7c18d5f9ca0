!> The outer edges of a body on a straight line
module axijoint_deck_mesh_straight_face
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : ascending_order
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, face_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type, outer_edge
   use axijoint_deck_text_entry, only : entry_type, card_fault
   implicit none
   private
   public :: line_type, line_between, outer_edges, lay_straight_face

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

   !> The line between two points
   pure function line_between(first, last, extent) result(line)
      !> First and last point
      real(wp), intent(in) :: first(2), last(2)
      !> Extent of the model
      real(wp), intent(in) :: extent
      !> The line; without direction if it has no length
      type(line_type) :: line

      line%first = first
      line%last = last
      line%length = norm2(last - first)
      line%tolerance = line_tolerance*extent
      if (line%length <= 2.0_wp*line%tolerance) line%length = 0.0_wp
      if (line%length > 0.0_wp) line%direction = (last - first)/line%length
   end function line_between

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
   subroutine lay_straight_face(card, line, edges, outer, draft, face)
      !> The card of the face
      class(entry_type), intent(in) :: card
      !> The line, which has a length
      type(line_type), intent(in) :: line
      !> Edges of the elements, and which are outer edges
      type(edge_table_type), intent(in) :: edges
      integer, intent(in) :: outer(:)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face; good if its edges cover the line
      type(face_type), intent(inout) :: face

      integer, allocatable :: found(:)
      integer :: i, first
      real(wp), allocatable :: start(:)

      face%good = .false.
      call edges_on_line(line, face%body, edges, outer, draft, found)
      if (size(found) == 0) then
         call report_no_edges(card, line, face%body, edges, outer, draft)
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
      call check_cover(card, line, draft, face)
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
   subroutine report_no_edges(card, line, body, edges, outer, draft)
      !> The card of the face
      class(entry_type), intent(in) :: card
      !> The line
      type(line_type), intent(in) :: line
      !> The body, which has elements
      integer, intent(in) :: body
      !> Edges of the elements, and which are outer edges
      type(edge_table_type), intent(in) :: edges
      integer, intent(in) :: outer(:)
      !> The mesh
      type(draft_type), intent(in) :: draft

      integer, allocatable :: found(:)

      call edges_on_line(line, 0, edges, outer, draft, found)
      if (size(found) > 0) then
         call card_fault(card, 'body '//to_text(body)//' has no outer edge on this line', &
                          mend='body '//to_text(draft%element_body(edges%element(found(1))))// &
                          ' has')
      else
         call card_fault(card, 'body '//to_text(body)//' has no outer edge on this line', &
                          allowed='a line from node to node along the outside of the body')
      end if
   end subroutine report_no_edges

   !> Check that the edges of a face follow each other from end to end
   subroutine check_cover(card, line, draft, face)
      !> The card of the face
      class(entry_type), intent(in) :: card
      !> The line
      type(line_type), intent(in) :: line
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face
      type(face_type), intent(inout) :: face

      real(wp) :: reached(2), next(2)
      integer :: i, n

      n = size(face%edges)
      reached = line%first
      do i = 1, n + 1
         next = line%last
         if (i <= n) next = draft%position(:, face%edges(i)%nodes(1))
         if (norm2(next - reached) > 2.0_wp*line%tolerance) then
            call card_fault(card, 'face '//to_text(face%label)// &
                             ' is not covered by outer edges of body '//to_text(face%body), &
                             found='no edge from '//place_text(reached)//' to '//place_text(next), &
                             mend='end the face at nodes; use several faces where the outline '// &
                             'bends')
            return
         end if
         if (i <= n) reached = draft%position(:, face%edges(i)%nodes(2))
      end do
      face%good = .true.
   end subroutine check_cover

end module axijoint_deck_mesh_straight_face
