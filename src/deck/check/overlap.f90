!> Elements that cover each other. Where some do, a piece of the outline of a body - edges that one
!> element alone has - lies inside another element: the area of the elements is then larger than
!> the area that the outline encloses. Points of the outline are looked up in the elements
module axijoint_deck_check_overlap
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_fe_shape, only : shape_line, n_corners
   implicit none
   private
   public :: check_overlap

   !> Natural coordinates of the points of an outer edge: ends of pieces of a curved side, so that
   !> two bodies with the same nodes along a curve do not seem to overlap
   real(wp), parameter :: sample_place(5) = [-0.75_wp, -0.5_wp, 0.0_wp, 0.5_wp, 0.75_wp]
   !> A point is inside an element if it is farther from its sides than this part of area over
   !> perimeter, a quarter of the side of a square: bodies that touch along curves overlap a little
   real(wp), parameter :: depth_limit = 0.04_wp
   !> Straight pieces that stand for a curved side
   integer, parameter :: n_pieces = 8
   !> Most cells
   integer, parameter :: most_cells = 1000000

   !> Points of the outlines, sorted into cells of a rectangle around the mesh
   type :: cells_type
      !> r and z of the points, shape (2, points); element of each
      real(wp), allocatable :: position(:, :)
      integer, allocatable :: element(:)
      !> Lower corner of the rectangle, and the size of a cell
      real(wp) :: corner(2) = 0.0_wp, width(2) = 1.0_wp
      !> Cells along r and along z
      integer :: n(2) = 1
      !> Points by cell: those of cell i are listed from start(i) to start(i + 1) - 1
      integer, allocatable :: start(:), list(:)
   end type cells_type

contains

   !> Report elements of one body that overlap, and warn of bodies that do; one message for each
   !> body and each pair of bodies
   subroutine check_overlap(draft, edges, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the elements, those of each element one after another
      type(edge_table_type), intent(in) :: edges
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(cells_type) :: cells
      real(wp), allocatable :: polygon(:, :)
      integer, allocatable :: told(:, :)
      integer :: first, last, point

      if (edges%n == 0) return
      cells = new_cells(draft, edges)
      allocate (told(2, 0))
      first = 1
      do while (first <= edges%n)
         last = first
         do while (last < edges%n)
            if (edges%element(last + 1) /= edges%element(first)) exit
            last = last + 1
         end do
         if (are_near(cells, draft, edges, first, last)) then
            polygon = outline_of(draft, edges, first, last)
            point = point_inside(cells, polygon, edges%element(first))
            if (point > 0) call report(draft, cells%element(point), edges%element(first), &
                                       cells%position(:, point), told, diagnostics)
         end if
         first = last + 1
      end do
   end subroutine check_overlap

   !> Points of all outer edges by cell
   pure function new_cells(draft, edges) result(cells)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The cells
      type(cells_type) :: cells

      integer, allocatable :: next(:), cell(:)
      integer :: i, k, m, n, place(2)

      m = size(sample_place)*count(edges%twin(:edges%n) == 0)
      allocate (cells%position(2, m), cells%element(m), cells%list(m), cell(m))
      m = 0
      do i = 1, edges%n
         if (edges%twin(i) /= 0) cycle
         n = count(edges%nodes(:, i) > 0)
         do k = 1, size(sample_place)
            m = m + 1
            cells%position(:, m) = place_on(draft, edges%nodes(:n, i), sample_place(k))
            cells%element(m) = edges%element(i)
         end do
      end do
      cells%n = divisions(draft)
      cells%corner = minval(draft%position(:, :draft%n_nodes), 2)
      cells%width = (maxval(draft%position(:, :draft%n_nodes), 2) - cells%corner)/cells%n
      where (.not. cells%width > 0.0_wp) cells%width = 1.0_wp
      allocate (cells%start(product(cells%n) + 1), source=0)
      do i = 1, m
         place = place_of(cells, cells%position(:, i))
         cell(i) = place(1) + (place(2) - 1)*cells%n(1)
         cells%start(cell(i) + 1) = cells%start(cell(i) + 1) + 1
      end do
      cells%start(1) = 1
      do i = 2, size(cells%start)
         cells%start(i) = cells%start(i) + cells%start(i - 1)
      end do
      next = cells%start
      do i = 1, m
         cells%list(next(cell(i))) = i
         next(cell(i)) = next(cell(i)) + 1
      end do
   end function new_cells

   !> A point of an edge
   pure function place_on(draft, nodes, along) result(position)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Nodes of the edge: two ends, and its middle if it may be curved
      integer, intent(in) :: nodes(:)
      !> Natural coordinate
      real(wp), intent(in) :: along
      !> r and z
      real(wp) :: position(2)

      real(wp) :: shape(3), derivative(3)
      integer :: i

      call shape_line(size(nodes), along, shape(:size(nodes)), derivative(:size(nodes)))
      position = 0.0_wp
      do i = 1, size(nodes)
         position = position + draft%position(:, nodes(i))*shape(i)
      end do
   end function place_on

   !> Cells along r and along z that are about as wide and as high as an element is in the mean:
   !> a narrow body has few in one direction and many in the other. Not more cells than elements
   pure function divisions(draft) result(n)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Cells along r, along z
      integer :: n(2)

      real(wp) :: extent, mean, wanted(2), least, largest
      integer :: axis, element, i

      do axis = 1, 2
         mean = 0.0_wp
         do element = 1, draft%n_elements
            least = huge(least)
            largest = -huge(largest)
            do i = 1, n_corners(draft%element_size(element))
               least = min(least, draft%position(axis, draft%element_nodes(i, element)))
               largest = max(largest, draft%position(axis, draft%element_nodes(i, element)))
            end do
            mean = mean + (largest - least)/draft%n_elements
         end do
         associate (x => draft%position(axis, :draft%n_nodes))
            extent = maxval(x) - minval(x)
         end associate
         wanted(axis) = 1.0_wp
         if (mean > 0.0_wp) wanted(axis) = max(1.0_wp, extent/mean)
      end do
      associate (most => real(min(most_cells, draft%n_elements), wp))
         if (product(wanted) > most) wanted = wanted*sqrt(most/product(wanted))
         n = max(1, int(min(wanted, most)))
      end associate
   end function divisions

   !> Column and row of the cell of a point
   pure function place_of(cells, position) result(place)
      !> The cells
      type(cells_type), intent(in) :: cells
      !> r and z
      real(wp), intent(in) :: position(2)
      !> From 1 to n; a point outside is given to the nearest cell
      integer :: place(2)

      place = 1 + int(min(real(cells%n - 1, wp), &
         max(0.0_wp, (position - cells%corner)/cells%width)))
   end function place_of

   !> Whether there are points in the cells of an element, as there are none of most inside a body
   pure logical function are_near(cells, draft, edges, first, last)
      !> Points of the outlines
      type(cells_type), intent(in) :: cells
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> Edges of the element
      integer, intent(in) :: first, last

      real(wp) :: corner(2), least(2), largest(2)
      integer :: low(2), high(2), i, row

      least = huge(least)
      largest = -huge(largest)
      do i = first, last
         associate (x => draft%position, nodes => edges%nodes(:, i))
            least = min(least, x(:, nodes(1)))
            largest = max(largest, x(:, nodes(1)))
            if (nodes(3) == 0) cycle
            ! a parabola lies in the triangle of its ends and the point where its tangents there meet
            corner = 2.0_wp*x(:, nodes(3)) - 0.5_wp*(x(:, nodes(1)) + x(:, nodes(2)))
            least = min(least, corner)
            largest = max(largest, corner)
         end associate
      end do
      low = place_of(cells, least)
      high = place_of(cells, largest)
      are_near = .false.
      do row = low(2), high(2)
         associate (before => (row - 1)*cells%n(1))
            are_near = are_near .or. cells%start(before + high(1) + 1) > cells%start(before + low(1))
         end associate
      end do
   end function are_near

   !> Corners of the polygon that stands for an element
   pure function outline_of(draft, edges, first, last) result(polygon)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> Edges of the element
      integer, intent(in) :: first, last
      !> r and z, shape (2, corners)
      real(wp), allocatable :: polygon(:, :)

      integer :: i, k, m, n, pieces

      allocate (polygon(2, n_pieces*(last - first + 1)))
      m = 0
      do i = first, last
         n = count(edges%nodes(:, i) > 0)
         pieces = merge(n_pieces, 1, n == 3)
         do k = 0, pieces - 1
            m = m + 1
            polygon(:, m) = place_on(draft, edges%nodes(:n, i), -1.0_wp + 2.0_wp*k/pieces)
         end do
      end do
      polygon = polygon(:, :m)
   end function outline_of

   !> A point of the outline of another element that lies inside a polygon; 0 if there is none
   pure integer function point_inside(cells, polygon, element) result(point)
      !> Points of the outlines
      type(cells_type), intent(in) :: cells
      !> Corners, shape (2, corners)
      real(wp), intent(in) :: polygon(:, :)
      !> Element that the polygon stands for
      integer, intent(in) :: element

      integer :: low(2), high(2), column, row, k
      real(wp) :: least(2), largest(2), depth

      least = minval(polygon, 2)
      largest = maxval(polygon, 2)
      low = place_of(cells, least)
      high = place_of(cells, largest)
      depth = least_depth(polygon)
      do row = low(2), high(2)
         do column = low(1), high(1)
            associate (cell => column + (row - 1)*cells%n(1))
               do k = cells%start(cell), cells%start(cell + 1) - 1
                  point = cells%list(k)
                  if (cells%element(point) == element) cycle
                  if (any(cells%position(:, point) < least .or. cells%position(:, point) > largest)) cycle
                  if (is_inside(polygon, cells%position(:, point), depth)) return
               end do
            end associate
         end do
      end do
      point = 0
   end function point_inside

   !> Distance from its sides at which a point counts as inside a polygon
   pure real(wp) function least_depth(polygon)
      !> Corners, shape (2, corners)
      real(wp), intent(in) :: polygon(:, :)

      real(wp) :: area, perimeter
      integer :: i, next

      area = 0.0_wp
      perimeter = 0.0_wp
      do i = 1, size(polygon, 2)
         next = mod(i, size(polygon, 2)) + 1
         associate (a => polygon(:, i) - polygon(:, 1), b => polygon(:, next) - polygon(:, 1))
            area = area + 0.5_wp*(a(1)*b(2) - a(2)*b(1))
            perimeter = perimeter + norm2(b - a)
         end associate
      end do
      least_depth = depth_limit*abs(area)/perimeter
   end function least_depth

   !> Whether a point is inside a polygon and farther from its sides than a distance
   pure logical function is_inside(polygon, position, depth)
      !> Corners, shape (2, corners)
      real(wp), intent(in) :: polygon(:, :)
      !> r and z of the point
      real(wp), intent(in) :: position(2)
      !> The distance
      real(wp), intent(in) :: depth

      real(wp) :: a(2), b(2), side(2), along
      integer :: i, next

      is_inside = .false.
      do i = 1, size(polygon, 2)
         next = mod(i, size(polygon, 2)) + 1
         a = polygon(:, i) - position
         b = polygon(:, next) - position
         side = b - a
         if (dot_product(side, side) > 0.0_wp) then
            along = min(1.0_wp, max(0.0_wp, -dot_product(a, side)/dot_product(side, side)))
            if (norm2(a + along*side) <= depth) then
               is_inside = .false.
               return
            end if
         end if
         ! A ray along r crosses the side if its ends are above and below, and its place is beyond
         if ((a(2) > 0.0_wp) .eqv. (b(2) > 0.0_wp)) cycle
         if (a(1) - a(2)*side(1)/side(2) > 0.0_wp) is_inside = .not. is_inside
      end do
   end function is_inside

   !> Report two elements that overlap, unless another pair of their bodies was told before
   subroutine report(draft, outer, inner, position, told, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Element whose outline lies inside, and the element that it lies in
      integer, intent(in) :: outer, inner
      !> Where
      real(wp), intent(in) :: position(2)
      !> Pairs of bodies that were told, shape (2, pairs); grows by one
      integer, allocatable, intent(inout) :: told(:, :)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: found
      integer :: bodies(2)

      bodies = [minval(draft%element_body([outer, inner])), &
         maxval(draft%element_body([outer, inner]))]
      if (any(told(1, :) == bodies(1) .and. told(2, :) == bodies(2))) return
      told = reshape([told, bodies], [2, size(told, 2) + 1])
      found = 'a side of element '//to_text(draft%element_label(outer))//' inside element '// &
              to_text(draft%element_label(inner))//', '//place_text(position)
      if (bodies(1) == bodies(2)) then
         call add_error(diagnostics, draft%element_card(max(outer, inner)), 0, 0, &
                        'elements of body '//to_text(bodies(1))//' overlap', found=found, &
                        allowed='elements whose area is the area that the outline of the body '// &
                        'encloses', &
                        mend='correct the nodes, or remove what is there twice')
      else if (diagnostics%n_errors == 0) then  ! else the interface between them may be at fault
         call add_warning(diagnostics, draft%element_card(max(outer, inner)), 0, 0, &
                          'bodies '//to_text(bodies(1))//' and '//to_text(bodies(2))//' overlap', &
                          found=found, mend='move one of them, unless they are meant to')
      end if
   end subroutine report

end module axijoint_deck_check_overlap
