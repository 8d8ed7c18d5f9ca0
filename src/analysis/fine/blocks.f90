!> Which nodes of the fine mesh are solved for together
module axijoint_analysis_fine_blocks
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, find_edge
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : n_corners
   use axijoint_fe_subdivision, only : n_children
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, n_joints
   use axijoint_model_neighbours, only : neighbours_type, element_at_edge
   use axijoint_order_graph, only : graph_type, new_graph
   use axijoint_order_rcm, only : reverse_cuthill_mckee
   implicit none
   private
   public :: new_blocks, graph_of_blocks, order_by_blocks, is_slender, may_be_wall, elements_across

   !> An element longer than this times its width is strongly coupled to its neighbours across its
   !> long sides
   real(wp), parameter :: slender = 2.0_wp*(1.0_wp + 1.0e-9_wp)  ! rounding, of units, does not decide
   !> A wall of elements longer than this times sqrt(r t), the length over which a tube of radius r bends where it is
   !> loaded or held, or than this times its thickness t, is strongly coupled along itself: what bends it within an element
   !> moves its neighbours. With lines across it alone estimates were up to 4 times too small from 1.2 sqrt(r t) on at
   !> t = r/300, 10 times from 0.6 on at r/3000: from 20 t on, with triangles from 15 t on
   real(wp), parameter :: bending = 2.0_wp, long_beside_wall = 10.0_wp
   !> Elements from one surface of such a wall to the other at most, of which two triangles are one: more make its block wide
   integer, parameter :: most_across = 4

contains

   !> Block of each fine node. Blocks are the new nodes inside an element, those on an edge, a
   !> coarse node at a corner; united are an outer edge and its element, the two sides of a joint,
   !> the long sides of a slender element and its inside: lines across slender elements; and all of a thin wall
   function new_blocks(coarse, fine) result(block)
      !> The coarse mesh
      type(mesh_type), intent(in) :: coarse
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> The blocks, shape (fine nodes)
      integer, allocatable :: block(:)

      integer :: root(n_nodes(coarse) + size(fine%edges) + n_elements(coarse))
      logical :: thin(n_elements(coarse)), apart(size(fine%edges))
      integer :: k, i, side, before_edges, before_elements

      before_edges = n_nodes(coarse)
      before_elements = before_edges + size(fine%edges)
      root = [(k, k=1, size(root))]
      thin = in_thin_walls(coarse, fine)
      apart = beside_walls(coarse, fine, thin)
      do k = 1, size(fine%edges)
         if (fine%edges(k)%elements(2) > 0 .or. apart(k)) cycle
         call unite(root, before_edges + k, before_elements + fine%edges(k)%elements(1))
      end do
      do k = 1, n_joints(coarse)
         associate (nodes => coarse%joint_nodes(:, k))
            call unite(root, nodes(1), nodes(4))
            call unite(root, nodes(2), nodes(3))
            call unite(root, before_edges + find_edge(fine, nodes(1), nodes(2)), &
                       before_edges + find_edge(fine, nodes(4), nodes(3)))
         end associate
      end do
      do k = 1, n_elements(coarse)
         associate (joined => long_sides(coarse, k) .or. thin(k))
            do side = 1, n_corners(coarse%element_size(k))
               if (joined(side) .and. .not. apart(fine%element_edges(side, k))) &
                  call unite(root, before_elements + k, before_edges + fine%element_edges(side, k))
               if (thin(k)) call unite(root, before_elements + k, coarse%element_nodes(side, k))
            end do
         end associate
      end do
      allocate (block(n_nodes(fine%mesh)))
      call find_roots(root)
      block(:before_edges) = root(:before_edges)
      do k = 1, size(fine%edges)
         associate (edge => fine%edges(k))
            i = root(before_edges + k)
            if (edge%nodes(3) > 0) block([edge%nodes(3), edge%new]) = i
            if (edge%nodes(3) == 0) block(edge%new(1)) = i
         end associate
      end do
      do k = 1, n_elements(coarse)
         i = root(before_elements + k)
         block(fine%inside(k):fine%inside(k + 1) - 1) = i
         if (coarse%element_size(k) == 9) block(coarse%element_nodes(9, k)) = i
      end do
   end function new_blocks

   !> Which elements are parts of a thin wall that is solved as a whole: from one surface of a body to the other, along long
   !> sides, there are slender elements only, few of them, and these are longer than its thickness; in bodies with such elements
   !> that couple it along itself
   function in_thin_walls(coarse, fine) result(thin)
      !> The coarse mesh
      type(mesh_type), intent(in) :: coarse
      !> The fine mesh, for the edges
      type(fine_mesh_type), intent(in) :: fine
      !> Shape (elements)
      logical :: thin(n_elements(coarse))

      integer, dimension(n_elements(coarse)) :: root, surfaces, halves
      real(wp), dimension(n_elements(coarse)) :: thickness, length, radius
      logical :: long(4, n_elements(coarse)), bends(n_elements(coarse))
      integer :: k, side, i

      root = [(k, k=1, size(root))]
      do k = 1, size(root)
         long(:, k) = long_sides(coarse, k)
      end do
      do k = 1, size(root)
         do side = 1, n_corners(coarse%element_size(k))
            if (.not. long(side, k)) cycle
            associate (other => fine%edges(fine%element_edges(side, k))%elements(2))
               if (other > 0) call unite(root, fine%edges(fine%element_edges(side, k))%elements(1), other)
            end associate
         end do
      end do
      call find_roots(root)
      surfaces = 0
      halves = 0
      thickness = 0.0_wp
      radius = 0.0_wp
      length = huge(1.0_wp)
      do k = 1, size(root)
         i = root(k)
         if (.not. any(long(:, k))) then
            length(i) = 0.0_wp
            cycle
         end if
         associate (n => n_corners(coarse%element_size(k)), sides => side_lengths(coarse, k))
            thickness(i) = thickness(i) + minval(sides(:n))*merge(0.5_wp, 1.0_wp, n == 3)
            length(i) = min(length(i), maxval(sides(:n)))
            radius(i) = max(radius(i), maxval(coarse%coordinates(1, coarse%element_nodes(:n, k))))
            surfaces(i) = surfaces(i) + count(long(:n, k) .and. fine%edges(fine%element_edges(:n, k))%elements(2) == 0)
            halves(i) = halves(i) + n - 2
         end associate
      end do
      do k = 1, size(root)
         i = root(k)
         thin(k) = surfaces(i) == 2 .and. halves(i) <= 2*most_across .and. length(i) > slender*thickness(i)
         bends(k) = thin(k) .and. length(i) > longest_free(radius(i), thickness(i))
      end do
      do i = 1, maxval(coarse%element_body)
         if (.not. any(bends .and. coarse%element_body == i)) where (coarse%element_body == i) thin = .false.
      end do
   end function in_thin_walls

   !> Length of the elements of a wall from which on they couple it along itself
   pure real(wp) function longest_free(radius, thickness)
      !> Of the wall
      real(wp), intent(in) :: radius, thickness

      longest_free = min(long_beside_wall*thickness, bending*sqrt(radius*thickness))
   end function longest_free

   !> Which edges lie across a joint from a thin wall: these are solved with it, the elements behind them, and lines that
   !> end there, are not
   function beside_walls(coarse, fine, thin) result(apart)
      !> The coarse mesh
      type(mesh_type), intent(in) :: coarse
      !> The fine mesh, for the edges
      type(fine_mesh_type), intent(in) :: fine
      !> Whether elements are parts of thin walls
      logical, intent(in) :: thin(:)
      !> Shape (edges)
      logical :: apart(size(fine%edges))

      integer :: k, edges(2), side

      apart = .false.
      do k = 1, n_joints(coarse)
         associate (nodes => coarse%joint_nodes(:, k))
            edges = [find_edge(fine, nodes(1), nodes(2)), find_edge(fine, nodes(4), nodes(3))]
         end associate
         do side = 1, 2
            if (thin(fine%edges(edges(3 - side))%elements(1))) &
               apart(edges(side)) = .not. thin(fine%edges(edges(side))%elements(1))
         end do
      end do
   end function beside_walls

   !> Unite two blocks
   pure subroutine unite(root, a, b)
      !> Parent of each piece
      integer, intent(inout) :: root(:)
      !> The pieces
      integer, intent(in) :: a, b

      integer :: from, to

      from = a
      to = b
      call climb(root, from)
      call climb(root, to)
      root(from) = to
   end subroutine unite

   !> Let the parent of each piece be the one that stands for all of its block
   pure subroutine find_roots(root)
      !> Parent of each piece
      integer, intent(inout) :: root(:)

      integer :: k, top

      do k = 1, size(root)
         top = k
         call climb(root, top)
         root(k) = top
      end do
   end subroutine find_roots

   !> Go up to the piece that stands for all of its block; the way there is half as long afterwards
   pure subroutine climb(root, piece)
      !> Parent of each piece
      integer, intent(inout) :: root(:)
      !> A piece; that one on return
      integer, intent(inout) :: piece

      do while (root(piece) /= piece)
         root(piece) = root(root(piece))
         piece = root(piece)
      end do
   end subroutine climb

   !> Which sides of an element are long ones; none if it is not slender
   pure function long_sides(mesh, element) result(long)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> Whether a side is long
      logical :: long(4)

      real(wp) :: length(4)

      associate (n => n_corners(mesh%element_size(element)))
         length = side_lengths(mesh, element)
         long = .false.
         long(:n) = length(:n) > slender*minval(length(:n))
      end associate
   end function long_sides

   !> Lengths of the sides of an element, of four sides the means of opposite ones
   pure function side_lengths(mesh, element) result(length)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> Lengths; that of a fourth side of a triangle is zero
      real(wp) :: length(4)

      integer :: i, n

      n = n_corners(mesh%element_size(element))
      length = 0.0_wp
      associate (x => mesh%coordinates(:, mesh%element_nodes(:n, element)))
         length(:n) = [(norm2(x(:, mod(i, n) + 1) - x(:, i)), i=1, n)]
      end associate
      if (n == 3) return
      length(1::2) = 0.5_wp*sum(length(1::2))
      length(2::2) = 0.5_wp*sum(length(2::2))
   end function side_lengths

   !> Whether an element is strongly coupled to its neighbours across its long sides
   pure logical function is_slender(mesh, element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element

      is_slender = any(long_sides(mesh, element))
   end function is_slender

   !> Whether an element is so long that it may be part of a thin wall that is solved as a whole
   pure logical function may_be_wall(mesh, element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element

      associate (n => n_corners(mesh%element_size(element)), sides => side_lengths(mesh, element))
         associate (r => mesh%coordinates(1, mesh%element_nodes(:n, element)), narrow => minval(sides(:n)))
            may_be_wall = maxval(sides) > max(slender*narrow, longest_free(maxval(r), narrow))
         end associate
      end associate
   end function may_be_wall

   !> Elements from one surface to the other of a wall that a slender element is part of, of which two triangles are one; zero if
   !> it is of none that is solved as a whole
   pure real(wp) function elements_across(mesh, neighbours, element) result(across)
      !> The mesh, and its elements by nodes
      type(mesh_type), intent(in) :: mesh
      type(neighbours_type), intent(in) :: neighbours
      !> The element
      integer, intent(in) :: element

      logical :: long(4)
      integer :: side, way, here, next, nodes(2), halves

      across = 0.0_wp
      halves = n_corners(mesh%element_size(element)) - 2
      long = long_sides(mesh, element)
      if (count(long) /= 2) return
      do side = 1, 4
         if (.not. long(side)) cycle
         here = element
         way = side
         do
            nodes = ends_of(here, way)
            next = element_at_edge(mesh, neighbours, nodes(1), nodes(2), here)
            if (next == 0) exit
            halves = halves + n_corners(mesh%element_size(next)) - 2
            if (halves > 2*most_across .or. count(long_sides(mesh, next)) /= 2) return
            way = other_side(next, nodes)
            if (way == 0) return
            here = next
         end do
      end do
      across = 0.5_wp*halves

   contains

      !> Corner nodes of a side
      pure function ends_of(element, side) result(nodes)
         !> The element, and its side
         integer, intent(in) :: element, side
         !> The nodes
         integer :: nodes(2)

         nodes = mesh%element_nodes([side, mod(side, n_corners(mesh%element_size(element))) + 1], element)
      end function ends_of

      !> The long side beside that with two nodes; zero if that is none
      pure integer function other_side(element, nodes) result(other)
         !> The element, and the nodes
         integer, intent(in) :: element, nodes(2)

         logical :: sides(4)
         integer :: side, entered

         other = 0
         entered = 0
         sides = long_sides(mesh, element)
         do side = 1, 4
            if (.not. sides(side)) cycle
            associate (ends => ends_of(element, side))
               if (minval(ends) == minval(nodes) .and. maxval(ends) == maxval(nodes)) then
                  entered = side
               else
                  other = side
               end if
            end associate
         end do
         if (entered == 0) other = 0
      end function other_side

   end function elements_across

   !> Graph of nodes that share an element, or a joint, and a block
   function graph_of_blocks(mesh, block) result(graph)
      !> The fine mesh
      type(mesh_type), intent(in) :: mesh
      !> Block of each node
      integer, intent(in) :: block(:)
      !> The graph
      type(graph_type) :: graph

      integer, allocatable :: start(:), member(:)
      integer :: k, n

      associate (n_members => sum(mesh%element_size) + sum(mesh%joint_size))
         allocate (member(n_members), start(n_members/2 + 1))
      end associate
      start(1) = 1
      n = 0
      do k = 1, n_elements(mesh)
         call add_cliques(mesh%element_nodes(:mesh%element_size(k), k))
      end do
      do k = 1, n_joints(mesh)
         call add_cliques(mesh%joint_nodes(:mesh%joint_size(k), k))
      end do
      call new_graph(graph, size(block), start(:n + 1), member(:start(n + 1) - 1))

   contains

      !> Add those of some nodes that are of one block, block by block
      subroutine add_cliques(nodes)
         !> The nodes
         integer, intent(in) :: nodes(:)

         integer :: i, j, next

         do i = 1, size(nodes)
            if (any(block(nodes(:i - 1)) == block(nodes(i)))) cycle
            next = start(n + 1)
            do j = i, size(nodes)
               if (block(nodes(j)) /= block(nodes(i))) cycle
               member(next) = nodes(j)
               next = next + 1
            end do
            if (next == start(n + 1) + 1) cycle  ! one alone
            n = n + 1
            start(n + 1) = next
         end do
      end subroutine add_cliques

   end function graph_of_blocks

   !> Order of the fine nodes, block by block and neighbours close in each; blocks of one coarse
   !> element are close, too
   subroutine order_by_blocks(coarse, fine, graph, block, order)
      !> The coarse mesh
      type(mesh_type), intent(in) :: coarse
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Graph of the fine nodes of the blocks
      type(graph_type), intent(in) :: graph
      !> Block of each node
      integer, intent(in) :: block(:)
      !> order(k) is the k-th node
      integer, allocatable, intent(out) :: order(:)

      integer, allocatable :: close(:), start(:)
      integer :: k, n, element, i

      call reverse_cuthill_mckee(graph, close)
      allocate (start(maxval(block)), source=0)
      do k = graph%n, 1, -1
         start(block(close(k))) = k
      end do
      allocate (order(graph%n))
      n = 0
      do element = 1, n_elements(coarse)
         do k = n_children*(element - 1) + 1, n_children*element
            do i = 1, fine%mesh%element_size(k)
               call place_block(block(fine%mesh%element_nodes(i, k)))
            end do
         end do
      end do

   contains

      !> Place all nodes of a block, once
      subroutine place_block(b)
         !> The block
         integer, intent(in) :: b

         integer :: from

         if (start(b) == 0) return
         from = start(b)
         start(b) = 0
         do while (from <= size(close))
            if (block(close(from)) /= b) exit
            n = n + 1
            order(n) = close(from)
            from = from + 1
         end do
      end subroutine place_block

   end subroutine order_by_blocks

end module axijoint_analysis_fine_blocks
