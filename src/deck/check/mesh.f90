!> The mesh as a whole: nodes without elements, nodes too near to each other,
!> nodes on foreign edges, bodies that touch
module axijoint_deck_check_mesh
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : refine_order
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_mesh_draft, only : draft_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type, on_outer_edges
   use axijoint_deck_mesh_places, only : point_tree_type, new_point_tree, points_near, axis_tolerance, same_place
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_fe_shape, only : n_corners
   implicit none
   private
   public :: snap_to_axis, check_used, put_bodies_together, check_coincident, check_near, check_hanging, check_touching

   !> Least distance of two nodes of a body, in lengths of their shortest edge
   real(wp), parameter :: least_distance = 1.0e-3_wp
   !> A node that hangs on an edge is nearer to it than this, in lengths of the shortest
   !> edge of its elements
   real(wp), parameter :: hanging_distance = 1.0e-3_wp
   !> Nodes of two bodies that are nearer to each other than the first are put at one place; up to the second they are said to
   !> stand apart. In lengths of the shortest edge there
   real(wp), parameter :: one_place = 1.0e-6_wp, close_by = 1.0e-3_wp
   !> Room for neighbours of a point
   integer, parameter :: most_near = 64

contains

   !> Put nodes on the axis that only rounding keeps off it
   subroutine snap_to_axis(draft, diagnostics)
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: node

      do node = 1, draft%n_nodes
         associate (r => draft%position(1, node))
            if (.not. r > 0.0_wp .or. r > axis_tolerance*draft%extent) cycle
            call add_warning(diagnostics, draft%node_card(node), 0, 0, &
                             'node '//to_text(draft%node_label(node))//' is put on the axis', &
                             found='r = '//to_text(r), mend='write r = 0')
            r = 0.0_wp
         end associate
      end do
   end subroutine snap_to_axis

   !> Report nodes that no element uses
   subroutine check_used(draft, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      logical, allocatable :: used(:)
      integer :: node, element

      if (.not. draft%elements_complete) return
      allocate (used(0:draft%n_nodes), source=.false.)
      do element = 1, draft%n_elements
         used(draft%element_nodes(:, element)) = .true.
      end do
      do node = 1, draft%n_nodes
         if (used(node) .or. .not. draft%node_good(node)) cycle
         call add_error(diagnostics, draft%node_card(node), 0, 0, &
                        'node '//to_text(draft%node_label(node))//' is used by no element', &
                        found=place_text(draft%position(:, node)), &
                        mend='remove it, or correct the elements')
      end do
   end subroutine check_used

   !> Put nodes of bodies that rounding keeps apart at one place, and warn of bodies that stand apart by next to nothing: joints
   !> are laid where nodes are at one place
   subroutine put_bodies_together(draft, edges, diagnostics)
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Edges
      type(edge_table_type), intent(in) :: edges
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(point_tree_type) :: tree
      real(wp), allocatable :: shortest(:), farthest(:)
      integer, allocatable :: outer(:), pairs(:, :), order(:)
      integer :: i, k, n_found, found(most_near), kind, other
      real(wp) :: distance

      associate (body => draft%node_body(:draft%n_nodes))
         if (draft%n_nodes == 0) return
         if (all(body == body(1))) return
         call shortest_edges(draft, edges, shortest)
         outer = pack([(i, i=1, draft%n_nodes)], on_outer_edges(edges, draft%n_nodes))
         tree = new_point_tree(draft%position(:, outer))
         allocate (pairs(4, 0), farthest(0))  ! bodies, 1 of nodes put at one place and 2 of others, nodes
         order = [(i, i=1, size(outer))]
         call refine_order(order, body(outer))
         do i = 1, size(outer)
            associate (node => outer(order(i)))
               call points_near(tree, draft%position(:, node), close_by*shortest(node), found, n_found)
               other = nearest_of_others(found(:n_found))
               if (other == 0) cycle
               ! who is at one place with a body stands apart from none behind it; of two bodies the later one moves
               if (.not. distance > same_place*draft%extent .or. body(other) > body(node)) cycle
               kind = merge(1, 2, distance <= one_place*shortest(node))
               call note([body(other), body(node), kind])
               if (kind == 1) draft%position(:, node) = draft%position(:, other)
            end associate
         end do
      end associate
      do k = 1, size(farthest)
         if (pairs(3, k) == 1) then
            call add_warning(diagnostics, 0, 0, 0, count_of(pairs(4, k), 'node')//' of body '//to_text(pairs(2, k))// &
                             ' put where those of body '//to_text(pairs(1, k))//' are', &
                             found='distances of up to '//to_text(farthest(k)))
         else
            call add_warning(diagnostics, 0, 0, 0, 'bodies '//to_text(pairs(1, k))//' and '//to_text(pairs(2, k))// &
                             ' stand apart by next to nothing at '//count_of(pairs(4, k), 'node')// &
                             ': they do not feel each other there', found='distances of up to '//to_text(farthest(k)), &
                             mend='put the nodes of both at one place, lay joints there, and give their law the gap '// &
                             '(LAWDETAILS)')
         end if
      end do

   contains

      !> Nearest node of another body, at `distance`; 0 if there is none
      integer function nearest_of_others(near) result(nearest)
         !> Nodes near by, by their places among the outer ones
         integer, intent(in) :: near(:)

         real(wp) :: length
         integer :: l

         nearest = 0
         distance = huge(1.0_wp)
         associate (node => outer(order(i)))
            do l = 1, size(near)
               associate (other => outer(near(l)))
                  if (draft%node_body(other) == draft%node_body(node) .or. draft%node_body(other) == 0) cycle
                  length = norm2(draft%position(:, other) - draft%position(:, node))
                  if (length >= distance) cycle
                  distance = length
                  nearest = other
               end associate
            end do
         end associate
      end function nearest_of_others

      !> Count a node of a pair of bodies
      subroutine note(pair)
         !> The bodies, and what becomes of it
         integer, intent(in) :: pair(3)

         integer :: n, l

         n = 0
         do l = 1, size(farthest)
            if (all(pairs(:3, l) == pair)) n = l
         end do
         if (n == 0) then
            pairs = reshape([pairs, pair, 0], [4, size(pairs, 2) + 1])
            farthest = [farthest, 0.0_wp]
            n = size(farthest)
         end if
         pairs(4, n) = pairs(4, n) + 1
         farthest(n) = max(farthest(n), distance)
      end subroutine note

   end subroutine put_bodies_together

   !> Report nodes of one body at the same place
   subroutine check_coincident(draft, group, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: order(:)
      integer :: i, first

      call order_by_place(draft, group, order)
      first = 1
      do i = 2, size(order)
         associate (a => order(first), b => order(i))
            if (group(a) /= group(b) .or. draft%node_body(a) /= draft%node_body(b)) then
               first = i
            else if (draft%node_body(a) > 0 .and. all(draft%node_good([a, b]))) then
               call add_error(diagnostics, draft%node_card(b), 0, 0, &
                              'nodes '//to_text(draft%node_label(a))//' and '// &
                              to_text(draft%node_label(b))//' of body '// &
                              to_text(draft%node_body(a))// &
                              ' are at the same place', found=place_text(draft%position(:, b)), &
                              allowed='nodes at one place in different bodies only', &
                              mend='use one node, or give the elements on one side another body')
            end if
         end associate
      end do
   end subroutine check_coincident

   !> Nodes by place, then body, then number
   pure subroutine order_by_place(draft, group, order)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> The nodes
      integer, allocatable, intent(out) :: order(:)

      integer :: i

      order = [(i, i=1, draft%n_nodes)]
      call refine_order(order, draft%node_body(:draft%n_nodes))
      call refine_order(order, group)
   end subroutine order_by_place

   !> Report nodes of one body that nearly coincide: of any node one that lies on an outer edge, and of nodes of the same or of
   !> neighbouring elements. A node elsewhere is surrounded by its elements, and where others cover these, one of the two has
   !> outer edges there
   subroutine check_near(draft, group, edges, tree, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> Edges
      type(edge_table_type), intent(in) :: edges
      !> All nodes
      type(point_tree_type), intent(in) :: tree
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp), allocatable :: shortest(:)
      logical, allocatable :: outer(:)
      integer :: node, k, n_found, found(most_near)

      call shortest_edges(draft, edges, shortest)
      outer = on_outer_edges(edges, draft%n_nodes)
      do node = 1, draft%n_nodes
         if (.not. outer(node)) cycle
         call points_near(tree, draft%position(:, node), least_distance*shortest(node), found, n_found)
         do k = 1, n_found
            if (found(k) == node .or. (outer(found(k)) .and. found(k) > node)) cycle
            call compare_nodes(draft, group, found(k), node, shortest(node), diagnostics)
         end do
      end do
      call check_slivers_inside(draft, group, edges, outer, shortest, diagnostics)
   end subroutine check_near

   !> The same of nodes inside a body: across an element, and across an edge of two
   subroutine check_slivers_inside(draft, group, edges, outer, shortest, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> Edges
      type(edge_table_type), intent(in) :: edges
      !> Whether a node lies on an outer edge: these are looked at already
      logical, intent(in) :: outer(:)
      !> Shortest edge of the elements at each node
      real(wp), intent(in) :: shortest(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, k, l, corners(2)

      do i = 1, draft%n_elements
         if (n_corners(draft%element_size(i)) < 4) cycle
         do k = 1, 2
            call compare_across(draft%element_nodes(k, i), draft%element_nodes(k + 2, i))
         end do
      end do
      do i = 1, edges%n
         if (edges%twin(i) <= i) cycle
         associate (one => edges%element(i), other => edges%element(edges%twin(i)))
            corners = [n_corners(draft%element_size(one)), n_corners(draft%element_size(other))]
            do k = 1, corners(1)
               if (any(edges%nodes(:2, i) == draft%element_nodes(k, one))) cycle
               do l = 1, corners(2)
                  if (any(edges%nodes(:2, i) == draft%element_nodes(l, other))) cycle
                  call compare_across(draft%element_nodes(k, one), draft%element_nodes(l, other))
               end do
            end do
         end associate
      end do

   contains

      !> Look at two nodes
      subroutine compare_across(a, b)
         integer, intent(in) :: a, b

         if (a == 0 .or. b == 0 .or. a == b) return
         if (outer(a) .or. outer(b)) return
         if (any(abs(draft%position(:, b) - draft%position(:, a)) > least_distance*min(shortest(a), shortest(b)))) return
         call compare_nodes(draft, group, min(a, b), max(a, b), shortest(max(a, b)), diagnostics)
      end subroutine compare_across

   end subroutine check_slivers_inside

   !> Report two nodes of one body that lie nearer to each other than their elements allow
   subroutine compare_nodes(draft, group, other, node, shortest, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> The nodes; the card of the second is named
      integer, intent(in) :: other, node
      !> Shortest edge there
      real(wp), intent(in) :: shortest
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      if (group(other) == group(node) .or. .not. all(draft%node_good([other, node]))) return
      if (draft%node_body(other) /= draft%node_body(node)) return
      call add_error(diagnostics, draft%node_card(node), 0, 0, &
                     'nodes '//to_text(draft%node_label(other))//' and '// &
                     to_text(draft%node_label(node))//' of body '// &
                     to_text(draft%node_body(node))// &
                     ' nearly coincide', &
                     found='a distance of '// &
                     to_text(norm2(draft%position(:, node) - draft%position(:, other)))// &
                     ', '//place_text(draft%position(:, node)), &
                     allowed='at least 0.001 of the shortest edge there, '// &
                     to_text(shortest))
   end subroutine compare_nodes

   !> Length of the shortest edge of the elements at each node, those across from it
   !> included (thin elements are no error); huge where there is none
   pure subroutine shortest_edges(draft, edges, shortest)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges
      type(edge_table_type), intent(in) :: edges
      !> Lengths, shape (nodes)
      real(wp), allocatable, intent(out) :: shortest(:)

      real(wp), allocatable :: shortest_of(:)
      integer :: i, k

      allocate (shortest(draft%n_nodes), source=huge(1.0_wp))
      allocate (shortest_of(draft%n_elements), source=huge(1.0_wp))
      do i = 1, edges%n
         associate (nodes => edges%nodes(:, i), least => shortest_of(edges%element(i)))
            least = min(least, norm2(draft%position(:, nodes(2)) - draft%position(:, nodes(1))))
         end associate
      end do
      do i = 1, edges%n
         associate (nodes => edges%nodes(:, i))
            do k = 1, count(nodes > 0)
               shortest(nodes(k)) = min(shortest(nodes(k)), shortest_of(edges%element(i)))
            end do
         end associate
      end do
   end subroutine shortest_edges

   !> Report nodes that lie on an outer edge of their body without being its nodes:
   !> the mesh would gape there
   subroutine check_hanging(draft, group, edges, tree, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> Edges
      type(edge_table_type), intent(in) :: edges
      !> All nodes
      type(point_tree_type), intent(in) :: tree
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp), allocatable :: shortest(:)
      logical, allocatable :: corner(:)
      real(wp) :: a(2), side(2), offset(2), length
      integer :: i, k, n_found, found(most_near)

      call shortest_edges(draft, edges, shortest)
      corner = are_corners(edges, draft%n_nodes)
      do i = 1, edges%n
         associate (nodes => edges%nodes(:, i))
            if (edges%twin(i) /= 0 .or. .not. all(draft%node_good(nodes(:2)))) cycle
            if (is_corner(nodes(3))) then
               call add_error(diagnostics, draft%element_card(edges%element(i)), 0, 0, &
                              'node '//to_text(draft%node_label(nodes(3)))//' is in the middle of a side of element '// &
                              to_text(draft%element_label(edges%element(i)))//', and a corner of another element', &
                              found=place_text(draft%position(:, nodes(3))), &
                              allowed='neighbours in one body with the same nodes along their common side', &
                              mend='give both sides elements of one order, or make them two bodies')
               cycle
            end if
            a = draft%position(:, nodes(1))
            side = draft%position(:, nodes(2)) - a
            length = norm2(side)
            if (.not. length > 0.0_wp) cycle
            call points_near(tree, a + 0.5_wp*side, 0.499_wp*length, found, n_found)
            do k = 1, n_found
               ! its own, misplaced
               if (any(draft%element_nodes(:, edges%element(i)) == found(k))) cycle
               if (.not. draft%node_good(found(k))) cycle
               if (draft%node_body(found(k)) /= draft%node_body(nodes(1))) cycle
               offset = (draft%position(:, found(k)) - a)/length
               if (abs(offset(1)*side(2) - &
                  offset(2)*side(1)) > hanging_distance*shortest(nodes(1))) cycle
               if (nodes(3) > 0) then
                  if (group(nodes(3)) == group(found(k))) cycle  ! reported as coincident
               end if
               call add_error(diagnostics, draft%element_card(edges%element(i)), 0, 0, &
                              'node '//to_text(draft%node_label(found(k)))//' lies on the edge '// &
                              to_text(draft%node_label(nodes(1)))//'-'// &
                              to_text(draft%node_label(nodes(2)))//' of element '// &
                              to_text(draft%element_label(edges%element(i)))// &
                              ' but is no node of it', &
                              found=place_text(draft%position(:, found(k))), &
                              allowed='neighbours in one body with the same nodes along their '// &
                              'common side', &
                              mend='divide both sides alike, or make them two bodies')
               exit
            end do
         end associate
      end do

   contains

      !> Whether a node is there, and a corner of an element
      pure logical function is_corner(node)
         !> The node, 0 for none
         integer, intent(in) :: node

         is_corner = .false.
         if (node > 0) is_corner = corner(node)
      end function is_corner

   end subroutine check_hanging

   !> Whether nodes are corners of elements
   pure function are_corners(edges, n_nodes) result(corner)
      !> Edges
      type(edge_table_type), intent(in) :: edges
      !> Nodes
      integer, intent(in) :: n_nodes
      !> One a node
      logical, allocatable :: corner(:)

      integer :: i

      allocate (corner(n_nodes), source=.false.)
      do i = 1, edges%n
         corner(edges%nodes(:2, i)) = .true.
      end do
   end function are_corners

   !> Warn of bodies that touch in nodes without a joint between them
   subroutine check_touching(draft, group, diagnostics)
      !> The mesh, joints included
      type(draft_type), intent(in) :: draft
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      logical, allocatable :: joined(:)
      integer, allocatable :: order(:), pairs(:, :)
      integer :: i, k, n

      allocate (joined(0:draft%n_nodes), source=.false.)
      do i = 1, draft%n_joints
         joined(draft%joint_nodes(:, i)) = .true.
      end do
      call order_by_place(draft, group, order)
      allocate (pairs(3, 0))
      do i = 2, size(order)
         associate (a => order(i - 1), b => order(i))
            if (group(a) /= group(b) .or. draft%node_body(a) == draft%node_body(b)) cycle
            if (draft%node_body(a) == 0 .or. all(joined([a, b]))) cycle
            n = 0
            do k = 1, size(pairs, 2)
               if (all(pairs(:2, k) == draft%node_body([a, b]))) n = k
            end do
            if (n == 0) then
               pairs = reshape([pairs, draft%node_body([a, b]), 0], [3, size(pairs, 2) + 1])
               n = size(pairs, 2)
            end if
            pairs(3, n) = pairs(3, n) + 1
         end associate
      end do
      do k = 1, size(pairs, 2)
         call add_warning(diagnostics, 0, 0, 0, &
                          'bodies '//to_text(pairs(1, k))//' and '//to_text(pairs(2, k))// &
                          ' touch at '// &
                          count_of(pairs(3, k), 'node')// &
                          ' without a joint: they are not connected there', &
                          mend='lay joints there or bond them by INTERFACES, or make them one '// &
                          'body')
      end do
   end subroutine check_touching

end module axijoint_deck_check_mesh
