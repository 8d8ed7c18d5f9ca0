!> Stiffness of all harmonics in blocks of two nodes (`block_parts`), every node with its three components: no
!> factor will be made of it, only products, so nothing is said about which components are held
module axijoint_assembly_node_blocks
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use axijoint_assembly_block_parts, only : block_size, add_block, harmonic_factors
   use axijoint_assembly_element_stiffness, only : integrands_type, new_integrands, element_blocks, max_unknowns, max_blocks
   use axijoint_assembly_support, only : support_point_type, support_stiffness
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_large_pages, only : zero_large_pages
   use axijoint_base_ranges, only : range_end
   use axijoint_element_blocks, only : pack_blocks
   use axijoint_element_joint, only : joint_stiffness
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: node_blocks_type, new_node_blocks, clear_blocks, assemble_rows, block_product

   !> Most ranges of rows, rows of a range at least, and the part of the blocks that may couple different ranges,
   !> which one thread sees to alone
   integer, parameter :: most_ranges = 16, least_rows = 2048
   real(wp), parameter :: most_coupling = 0.02_wp

   !> Lower triangle by rows of blocks. Those that couple nodes of one cluster lie together: clusters are also solved for
   !> by themselves, and would otherwise be picked from all over the memory
   type :: node_blocks_type
      !> First block of each row that couples it with another cluster, and first that does with its own, shape (nodes + 1, 2)
      integer(i8), allocatable :: start(:, :)
      !> Column of each block, ascending in either part of a row, the diagonal last in the second
      integer, allocatable :: column(:)
      !> The blocks, shape (block_size, blocks)
      real(wp), allocatable :: parts(:, :)
      !> Ranges of rows that products are shared by among threads that have nothing else to do
      integer :: n_ranges = 1
   end type node_blocks_type

   interface
      !> The rows of a range of y = K_m x without what they add to rows before it, or that; so many numbers at once at most
      pure subroutine c_product(most, coupling, from, to, outer, inner, column, parts, factors, x, y) &
         bind(c, name="axijoint_block_product")
         import :: c_int, c_int64_t, c_double
         integer(c_int), value :: most, coupling, from, to
         integer(c_int64_t), intent(in) :: outer(*), inner(*)
         integer(c_int), intent(in) :: column(*)
         real(c_double), intent(in) :: parts(*), factors(*), x(*)
         real(c_double), intent(inout) :: y(*)
      end subroutine c_product
   end interface

contains

   !> Pattern of the blocks
   subroutine new_node_blocks(blocks, graph, order, place, cluster)
      !> The blocks, without numbers
      type(node_blocks_type), intent(out) :: blocks
      !> Graph of the nodes; one without neighbours has no block
      type(graph_type), intent(in) :: graph
      !> order(k) is the node of row k, and place(node) the row of a node
      integer, intent(in) :: order(:), place(:)
      !> Cluster of each node; nodes of one follow each other in the order
      integer, intent(in) :: cluster(:)

      integer(i8), allocatable :: next(:, :)
      integer :: k, l, row, n(2)

      allocate (blocks%start(graph%n + 1, 2))
      allocate (blocks%column(count(graph%start(2:) > graph%start(:graph%n)) + size(graph%neighbour, kind=i8)/2))
      blocks%start(1, :) = 1
      do k = 1, graph%n
         associate (neighbours => graph%neighbour(graph%start(order(k)):graph%start(order(k) + 1) - 1))
            n(2) = count(place(neighbours) < k .and. cluster(neighbours) == cluster(order(k)))
            n(1) = count(place(neighbours) < k) - n(2)
            blocks%start(k + 1, :) = blocks%start(k, :) + n + [0, min(1, size(neighbours))]
         end associate
      end do
      blocks%start(:, 2) = blocks%start(:, 2) + blocks%start(graph%n + 1, 1) - 1
      next = blocks%start(:graph%n, :)
      do k = 1, graph%n  ! column after column, so that those of a row ascend
         do l = graph%start(order(k)), graph%start(order(k) + 1) - 1
            row = place(graph%neighbour(l))
            if (row > k) call put(row, merge(2, 1, cluster(graph%neighbour(l)) == cluster(order(k))))
         end do
         if (graph%start(order(k) + 1) > graph%start(order(k))) call put(k, 2)
      end do
      call find_ranges(blocks)

   contains

      !> Put a block of this column into a part of a row
      subroutine put(row, part)
         !> The row, and the part
         integer, intent(in) :: row, part

         blocks%column(next(row, part)) = k
         next(row, part) = next(row, part) + 1
      end subroutine put

   end subroutine new_node_blocks

   !> See whether ranges of rows couple so little that products can be shared by them
   pure subroutine find_ranges(blocks)
      !> The blocks, with their pattern
      type(node_blocks_type), intent(inout) :: blocks

      integer(i8) :: coupling
      integer :: k, n

      n = n_rows(blocks)
      blocks%n_ranges = max(1, min(most_ranges, n/least_rows))
      coupling = 0
      do k = 1, blocks%n_ranges
         coupling = coupling + coupling_before(blocks, first_row(blocks, k), first_row(blocks, k + 1) - 1)
      end do
      if (coupling > most_coupling*size(blocks%column)) blocks%n_ranges = 1
   end subroutine find_ranges

   !> Blocks that couple a range of rows with rows before it
   pure integer(i8) function coupling_before(blocks, from, to)
      !> The blocks
      type(node_blocks_type), intent(in) :: blocks
      !> First and last row
      integer, intent(in) :: from, to

      integer :: i, part

      coupling_before = 0
      do part = 1, 2
         do i = from, to
            coupling_before = coupling_before &
               + count(blocks%column(blocks%start(i, part):blocks%start(i + 1, part) - 1) < from)
         end do
      end do
   end function coupling_before

   !> Allocate the blocks, nothing in them
   subroutine clear_blocks(blocks)
      !> The blocks
      type(node_blocks_type), intent(inout) :: blocks

      allocate (blocks%parts(block_size, size(blocks%column, kind=i8)))
      call zero_large_pages(blocks%parts)
   end subroutine clear_blocks

   !> Integrate elements, joints and springs, and add them to a range of rows: element by element, so that sums do not
   !> depend on the ranges
   subroutine assemble_rows(blocks, place, model, elements, joint_points, support_points, from, to)
      !> The blocks
      type(node_blocks_type), intent(inout) :: blocks
      !> Row of each node
      integer, intent(in) :: place(:)
      !> The job
      type(model_type), intent(in) :: model
      !> The elements
      integer, intent(in) :: elements(:)
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: support_points(:)
      !> First and last row
      integer, intent(in) :: from, to

      type(integrands_type) :: integrands
      real(wp) :: local(2, 3, 3, max_blocks), matrix(max_unknowns, max_unknowns)
      integer :: k, n

      integrands = new_integrands(model)
      do k = 1, size(elements)
         n = model%mesh%element_size(elements(k))
         associate (nodes => model%mesh%element_nodes(:n, elements(k)))
            if (.not. any(place(nodes) >= from .and. place(nodes) <= to)) cycle
            call element_blocks(model, integrands, elements(k), local)
            call scatter(blocks, place(nodes), local, from, to)
         end associate
      end do
      do k = 1, size(joint_points)
         associate (point => joint_points(k))
            n = 2*point%n_pairs
            call joint_stiffness(point%joint_point_type, point%base, &
                                 matrix(:3*n, :3*n))
            call pack_blocks(n, matrix, blocks=local)
            call scatter(blocks, place(point%nodes(:n)), local, from, to)
         end associate
      end do
      do k = 1, size(support_points)
         associate (point => support_points(k))
            n = point%n_pairs
            call support_stiffness(point, matrix(:3*n, :3*n))
            call pack_blocks(n, matrix, blocks=local)
            call scatter(blocks, place(point%nodes(:n)), local, from, to)
         end associate
      end do
   end subroutine assemble_rows

   !> Add the blocks of an element
   pure subroutine scatter(blocks, place, local, from, to)
      !> The blocks
      type(node_blocks_type), intent(inout) :: blocks
      !> Rows of the nodes of the element
      integer, intent(in) :: place(:)
      !> Its blocks, of the nodes i >= j column by column
      real(wp), intent(in) :: local(2, 3, 3, max_blocks)
      !> First and last row that are added to
      integer, intent(in) :: from, to

      integer(i8) :: k
      integer :: i, j, p

      p = 0
      do j = 1, size(place)
         do i = j, size(place)
            p = p + 1
            if (max(place(i), place(j)) < from .or. max(place(i), place(j)) > to) cycle
            k = block_at(blocks, max(place(i), place(j)), min(place(i), place(j)))
            call add_block(local(:, :, :, p), place(i) < place(j), blocks%parts(:, k))
            ! tip of a slit: one node on both sides of a joint
            if (i /= j .and. place(i) == place(j)) call add_block(local(:, :, :, p), .true., blocks%parts(:, k))
         end do
      end do
   end subroutine scatter

   !> Place of a block
   pure integer(i8) function block_at(blocks, row, column)
      !> The blocks
      type(node_blocks_type), intent(in) :: blocks
      !> Row and column
      integer, intent(in) :: row, column

      integer :: part

      part = merge(2, 1, column >= blocks%column(blocks%start(row, 2)))
      block_at = blocks%start(row + 1, part) - 1
      do while (blocks%column(block_at) > column)
         block_at = block_at - 1
      end do
   end function block_at

   !> y = K_m x, in the order of the rows. Ranges of rows are shared among threads that have nothing else to do;
   !> what a range adds to the rows of another is added afterwards, which is where it belongs in the order of
   !> the rows: the sums are the same whoever makes them
   subroutine block_product(blocks, harmonic, x, y, at_once)
      !> The blocks
      type(node_blocks_type), intent(in) :: blocks
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> x, shape (3, nodes)
      real(wp), intent(in), contiguous :: x(:, :)
      !> y, same shape
      real(wp), intent(out), contiguous :: y(:, :)
      !> Numbers that are taken at once at most
      integer, intent(in) :: at_once

      integer :: k

      do k = 1, blocks%n_ranges
         !$omp task default(shared) firstprivate(k) if (blocks%n_ranges > 1)
         call find(.false., k)
         !$omp end task
      end do
      !$omp taskwait
      do k = 2, blocks%n_ranges
         call find(.true., k)
      end do

   contains

      !> The rows of a range without what it adds to rows before it, or that
      subroutine find(coupling, range)
         !> Whether it is that
         logical, intent(in) :: coupling
         !> The range
         integer, intent(in) :: range

         call c_product(at_once, merge(1, 0, coupling), first_row(blocks, range), first_row(blocks, range + 1) - 1, blocks%start, &
            blocks%start(1, 2), blocks%column, blocks%parts, harmonic_factors(harmonic), x, y)
      end subroutine find

   end subroutine block_product

   !> Number of rows
   pure integer function n_rows(blocks)
      !> The blocks
      type(node_blocks_type), intent(in) :: blocks

      n_rows = size(blocks%start, 1) - 1
   end function n_rows

   !> First row of a range
   pure integer function first_row(blocks, range)
      !> The blocks
      type(node_blocks_type), intent(in) :: blocks
      !> The range
      integer, intent(in) :: range

      first_row = 1 + range_end(n_rows(blocks), range - 1, blocks%n_ranges)
   end function first_row

end module axijoint_assembly_node_blocks
