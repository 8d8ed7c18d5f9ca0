!> Which nodes of the fine mesh are solved for together
module axijoint_analysis_fine_blocks
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, find_edge
   use axijoint_analysis_fine_walls, only : long_sides
   use axijoint_base_union_find, only : unite, find_roots
   use axijoint_fe_shape, only : n_corners
   use axijoint_fe_subdivision, only : n_children
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, n_joints
   use axijoint_order_graph, only : graph_type, new_graph
   use axijoint_order_rcm, only : reverse_cuthill_mckee
   implicit none
   private
   public :: new_blocks, graph_of_blocks, order_by_blocks

contains

   !> Block of each fine node. Blocks are the new nodes inside an element, those on an edge, a
   !> coarse node at a corner; united are an outer edge and its element, the two sides of a joint,
   !> the long sides of a slender element and its inside: lines across slender elements; and all of a thin wall
   function new_blocks(coarse, fine, thin) result(block)
      !> The coarse mesh
      type(mesh_type), intent(in) :: coarse
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Which coarse elements are parts of thin walls
      logical, intent(in) :: thin(:)
      !> The blocks, shape (fine nodes)
      integer, allocatable :: block(:)

      integer :: root(n_nodes(coarse) + size(fine%edges) + n_elements(coarse))
      logical :: apart(size(fine%edges))
      integer :: k, i, side, before_edges, before_elements

      before_edges = n_nodes(coarse)
      before_elements = before_edges + size(fine%edges)
      root = [(k, k=1, size(root))]
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
