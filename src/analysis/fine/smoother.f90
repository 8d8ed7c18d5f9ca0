!> Blocks of unknowns of the fine mesh that are solved for together: what a cheap part of the error
!> can be found with, while the coarse mesh finds the rest
module axijoint_analysis_fine_smoother
   use axijoint_analysis_fine_conditions, only : conditions_type
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, find_edge
   use axijoint_assembly_node_blocks, only : node_blocks_type, harmonic_block
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_fe_shape, only : n_corners
   use axijoint_fe_subdivision, only : n_children
   use axijoint_linalg_band_cholesky, only : factor_band, solve_band
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, n_joints
   use axijoint_order_graph, only : graph_type
   use axijoint_order_rcm, only : reverse_cuthill_mckee
   implicit none
   private
   public :: smoother_type, new_blocks, order_by_blocks, new_smoother, factor_blocks, solve_blocks, &
      is_slender

   !> An element longer than this times its width is strongly coupled to its neighbours across its
   !> long sides
   real(wp), parameter :: slender = 2.0_wp

   !> Blocks of nodes that follow each other
   type :: smoother_type
      !> First node of each block, shape (blocks + 1), and how far apart neighbours in it are
      integer, allocatable :: first(:), width(:)
      !> Where the factor of each block begins, shape (blocks + 1)
      integer(i8), allocatable :: start(:)
   end type smoother_type

contains

   !> Block of each fine node. Blocks are the new nodes inside an element, those on an edge, a
   !> coarse node at a corner; united are an outer edge and its element, the two sides of a joint,
   !> and the long sides of a slender element and its inside: lines across slender elements
   function new_blocks(coarse, fine) result(block)
      !> The coarse mesh
      type(mesh_type), intent(in) :: coarse
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> The blocks, shape (fine nodes)
      integer, allocatable :: block(:)

      integer :: root(n_nodes(coarse) + size(fine%edges) + n_elements(coarse))
      integer :: k, i, side, before_edges, before_elements

      before_edges = n_nodes(coarse)
      before_elements = before_edges + size(fine%edges)
      root = [(k, k=1, size(root))]
      do k = 1, size(fine%edges)
         if (fine%edges(k)%elements(2) > 0) cycle
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
         associate (long => long_sides(coarse, k))
            do side = 1, n_corners(coarse%element_size(k))
               if (long(side)) &
                  call unite(root, before_elements + k, before_edges + fine%element_edges(side, k))
            end do
         end associate
      end do
      allocate (block(n_nodes(fine%mesh)))
      block(:before_edges) = [(root_of(root, k), k=1, before_edges)]
      do k = 1, size(fine%edges)
         associate (edge => fine%edges(k))
            i = root_of(root, before_edges + k)
            if (edge%nodes(3) > 0) block([edge%nodes(3), edge%new]) = i
            if (edge%nodes(3) == 0) block(edge%new(1)) = i
         end associate
      end do
      do k = 1, n_elements(coarse)
         i = root_of(root, before_elements + k)
         block(fine%inside(k):fine%inside(k + 1) - 1) = i
         if (coarse%element_size(k) == 9) block(coarse%element_nodes(9, k)) = i
      end do
   end function new_blocks

   !> Unite two blocks
   pure subroutine unite(root, a, b)
      !> Parent of each piece
      integer, intent(inout) :: root(:)
      !> The pieces
      integer, intent(in) :: a, b

      root(root_of(root, a)) = root_of(root, b)
   end subroutine unite

   !> The piece that stands for all of its block
   pure integer function root_of(root, piece)
      !> Parent of each piece
      integer, intent(in) :: root(:)
      !> The piece
      integer, intent(in) :: piece

      root_of = piece
      do while (root(root_of) /= root_of)
         root_of = root(root_of)
      end do
   end function root_of

   !> Which sides of an element are long ones; none if it is not slender
   pure function long_sides(mesh, element) result(long)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> Whether a side is long
      logical :: long(4)

      real(wp) :: length(4)
      integer :: i, n

      n = n_corners(mesh%element_size(element))
      associate (x => mesh%coordinates(:, mesh%element_nodes(:n, element)))
         length(:n) = [(norm2(x(:, mod(i, n) + 1) - x(:, i)), i=1, n)]
      end associate
      long = .false.
      if (n == 4) then
         length(1::2) = 0.5_wp*sum(length(1::2))
         length(2::2) = 0.5_wp*sum(length(2::2))
         long = length > slender*minval(length)
      else
         long(:n) = length(:n) > slender*minval(length(:n))
      end if
   end function long_sides

   !> Whether an element is strongly coupled to its neighbours across its long sides
   pure logical function is_slender(mesh, element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element

      is_slender = any(long_sides(mesh, element))
   end function is_slender

   !> Order of the fine nodes, block by block and neighbours close in each; blocks of one coarse
   !> element are close, too
   subroutine order_by_blocks(coarse, fine, graph, block, order)
      !> The coarse mesh
      type(mesh_type), intent(in) :: coarse
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Graph of the fine nodes
      type(graph_type), intent(in) :: graph
      !> Block of each node
      integer, intent(in) :: block(:)
      !> order(k) is the k-th node
      integer, allocatable, intent(out) :: order(:)

      type(graph_type) :: within
      integer, allocatable :: close(:), start(:)
      integer :: node, k, n, element, i

      within%n = graph%n
      allocate (within%start(graph%n + 1), within%neighbour(size(graph%neighbour)))
      n = 0
      do node = 1, graph%n
         within%start(node) = n + 1
         do k = graph%start(node), graph%start(node + 1) - 1
            if (block(graph%neighbour(k)) /= block(node)) cycle
            n = n + 1
            within%neighbour(n) = graph%neighbour(k)
         end do
      end do
      within%start(graph%n + 1) = n + 1
      call reverse_cuthill_mckee(within, close)
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

   !> Where blocks begin, and how wide they are
   subroutine new_smoother(smoother, stiffness, block, order)
      !> The blocks
      type(smoother_type), intent(out) :: smoother
      !> Pattern of the stiffness
      type(node_blocks_type), intent(in) :: stiffness
      !> Block of each node
      integer, intent(in) :: block(:)
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)

      integer(i8) :: l
      integer :: k, b

      associate (begins => [.true., block(order(2:)) /= block(order(:size(order) - 1))])
         smoother%first = [pack([(k, k=1, size(order))], begins), size(order) + 1]
      end associate
      associate (n => size(smoother%first) - 1)
         allocate (smoother%width(n), source=0)
         allocate (smoother%start(n + 1))
      end associate
      smoother%start(1) = 1
      do b = 1, size(smoother%width)
         do k = smoother%first(b), smoother%first(b + 1) - 1
            do l = stiffness%row_start(k), stiffness%row_start(k + 1) - 1
               if (stiffness%column(l) < smoother%first(b)) cycle
               smoother%width(b) = max(smoother%width(b), k - stiffness%column(l))
               exit  ! columns ascend
            end do
         end do
         smoother%start(b + 1) = smoother%start(b) &
            + 9_i8*(smoother%width(b) + 1)*(smoother%first(b + 1) - smoother%first(b))
      end do
   end subroutine new_smoother

   !> Factor the blocks of a harmonic
   subroutine factor_blocks(smoother, stiffness, harmonic, conditions, factor, failed)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
      !> The stiffness
      type(node_blocks_type), intent(in) :: stiffness
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Components that are free
      type(conditions_type), intent(in) :: conditions
      !> The factors
      real(wp), allocatable, intent(inout) :: factor(:)
      !> Whether one of them is singular
      logical, intent(out) :: failed

      integer :: b, info

      associate (n => smoother%start(size(smoother%start)) - 1)
         if (.not. allocated(factor)) then
            allocate (factor(n))
            call use_large_pages(factor)
         end if
      end associate
      failed = .false.
      do b = 1, size(smoother%width)
         associate (from => smoother%start(b), nodes => smoother%first(b + 1) - smoother%first(b), &
                    width => 3*smoother%width(b) + 2)
            call fill_block(stiffness, harmonic, conditions, smoother%first(b), nodes, width, &
               factor(from))
            call factor_band(3*nodes, width, factor(from), info)
         end associate
         failed = failed .or. info > 0
      end do
   end subroutine factor_blocks

   !> Copy a block into a band matrix; what is held has an equation of its own
   pure subroutine fill_block(stiffness, harmonic, conditions, first, n, width, a)
      !> The stiffness
      type(node_blocks_type), intent(in) :: stiffness
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Components that are free
      type(conditions_type), intent(in) :: conditions
      !> First node, number of nodes, half-bandwidth
      integer, intent(in) :: first, n, width
      !> Lower triangle
      real(wp), intent(inout) :: a(0:width, 3*n)

      real(wp) :: block(3, 3)
      integer(i8) :: l
      integer :: i, j, row, column

      a = 0.0_wp
      do i = first, first + n - 1
         do l = stiffness%row_start(i + 1) - 1, stiffness%row_start(i), -1
            j = stiffness%column(l)
            if (j < first) exit
            block = harmonic_block(stiffness, l, harmonic)
            if (conditions%tied(j)) block(1, :) = block(1, :) - block(3, :)
            if (conditions%tied(i)) block(:, 1) = block(:, 1) - block(:, 3)
            do row = 1, 3
               do column = 1, merge(row, 3, i == j)
                  if (.not. (conditions%free(row, i) .and. conditions%free(column, j))) cycle
                  a(3*(i - j) + row - column, 3*(j - first) + column) = block(column, row)
               end do
            end do
         end do
         do row = 1, 3
            if (.not. conditions%free(row, i)) a(0, 3*(i - first) + row) = 1.0_wp
         end do
      end do
   end subroutine fill_block

   !> Solve for every block
   subroutine solve_blocks(smoother, factor, x)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
      !> Their factors
      real(wp), intent(in) :: factor(*)
      !> Forces, then displacements, shape (3, nodes)
      real(wp), intent(inout) :: x(3, *)

      integer :: b

      do b = 1, size(smoother%width)
         call solve_band(3*(smoother%first(b + 1) - smoother%first(b)), 3*smoother%width(b) + 2, &
                         factor(smoother%start(b)), x(1, smoother%first(b)))
      end do
   end subroutine solve_blocks

end module axijoint_analysis_fine_smoother
