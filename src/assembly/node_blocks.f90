!> Stiffness of all harmonics in blocks of two nodes, every node with its three components: no
!> factor will be made of it, only products, so nothing is said about which components are held
!>
!> A block has the numbers of `element/blocks` that are not zero for all: A or S of each pair of components
!> of K_m = c_m (A + m S + m^2 C), then C of those that A couples.
module axijoint_assembly_node_blocks
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use omp_lib, only : omp_get_max_threads, omp_get_num_threads, omp_in_parallel
   use axijoint_assembly_support, only : support_point_type, support_stiffness
   use axijoint_assembly_element_stiffness, only : integrands_type, new_integrands, max_unknowns, max_blocks
   use axijoint_assembly_repeated_elements, only : shapes_type, find_shapes, integrated_type, new_integrated, find_blocks
   use axijoint_assembly_stiffness, only : least_elements
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_large_pages, only : use_large_pages, zero_large_pages
   use axijoint_base_ranges, only : range_end
   use axijoint_base_team, only : team_type
   use axijoint_element_blocks, only : pack_blocks
   use axijoint_element_joint, only : joint_stiffness
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_elements
   use axijoint_model_model, only : model_type
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: node_blocks_type, new_node_blocks, assemble_blocks, tell_blocks, block_product, harmonic_factors, evaluate, block_size

   !> Numbers of a block
   integer, parameter :: block_size = 14

   !> Most ranges of rows, rows of a range at least, and the part of the blocks that may couple different ranges,
   !> which one thread sees to alone
   integer, parameter :: most_ranges = 16, least_rows = 2048
   real(wp), parameter :: most_coupling = 0.02_wp

   !> Lower triangle by rows of blocks. Those that couple nodes of one cluster lie together: clusters are also solved for
   !> by themselves, and would otherwise be picked from all over the memory
   type :: node_blocks_type
      !> Place of each node in the order of the rows
      integer, allocatable :: place(:)
      !> First block of each row that couples it with another cluster, and first that does with its own, shape (nodes + 1, 2)
      integer(i8), allocatable :: start(:, :)
      !> Column of each block, ascending in either part of a row, the diagonal last in the second
      integer, allocatable :: column(:)
      !> The blocks, shape (block_size, blocks): A or S, component of the column by component of the
      !> row, nine numbers, then C of the pairs (u, u), (v, u), (u, v), (v, v), (w, w)
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
   subroutine new_node_blocks(blocks, graph, order, cluster)
      !> The blocks, without numbers
      type(node_blocks_type), intent(out) :: blocks
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)
      !> Cluster of each node; nodes of one follow each other in the order
      integer, intent(in) :: cluster(:)

      integer(i8), allocatable :: next(:, :)
      integer :: k, l, row, n(2)

      allocate (blocks%place(graph%n), blocks%start(graph%n + 1, 2))
      allocate (blocks%column(graph%n + size(graph%neighbour, kind=i8)/2))
      blocks%place(order) = [(k, k=1, graph%n)]
      blocks%start(1, :) = 1
      do k = 1, graph%n
         associate (neighbours => graph%neighbour(graph%start(order(k)):graph%start(order(k) + 1) - 1))
            n(2) = count(blocks%place(neighbours) < k .and. cluster(neighbours) == cluster(order(k)))
            n(1) = count(blocks%place(neighbours) < k) - n(2)
         end associate
         blocks%start(k + 1, :) = blocks%start(k, :) + n + [0, 1]
      end do
      blocks%start(:, 2) = blocks%start(:, 2) + blocks%start(graph%n + 1, 1) - 1
      next = blocks%start(:graph%n, :)
      do k = 1, graph%n  ! column after column, so that those of a row ascend
         do l = graph%start(order(k)), graph%start(order(k) + 1) - 1
            row = blocks%place(graph%neighbour(l))
            if (row > k) call put(row, merge(2, 1, cluster(graph%neighbour(l)) == cluster(order(k))))
         end do
         call put(k, 2)
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

      n = size(blocks%place)
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

   !> Integrate all elements, joints and springs. Every thread adds to rows of its own, element by
   !> element, so that sums do not depend on the number of threads
   subroutine assemble_blocks(blocks, model, joint_points, support_points)
      !> The blocks
      type(node_blocks_type), intent(inout) :: blocks
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: support_points(:)

      type(shapes_type) :: shapes
      integer :: n, n_ranges
      logical :: within

      within = omp_in_parallel()
      allocate (blocks%parts(block_size, size(blocks%column, kind=i8)))
      call zero_large_pages(blocks%parts)
      call find_shapes(model%mesh, shapes)
      n = size(blocks%place)
      n_ranges = 1
      if (n_elements(model%mesh) > least_elements) n_ranges = merge(omp_get_num_threads(), omp_get_max_threads(), within)
      if (within) then  ! others of the team may have nothing else to do
         call share_rows()
         return
      end if
      !$omp parallel if (n_ranges > 1)
      !$omp single
      call share_rows()
      !$omp end single
      !$omp end parallel

   contains

      !> Add to all rows, in ranges
      subroutine share_rows()
         integer :: k

         do k = 1, n_ranges
            !$omp task default(shared) firstprivate(k) if (n_ranges > 1)
            call assemble_rows(blocks, model, shapes, joint_points, support_points, 1 + range_end(n, k - 1, n_ranges), &
               range_end(n, k, n_ranges))
            !$omp end task
         end do
         !$omp taskwait
      end subroutine share_rows

   end subroutine assemble_blocks

   !> Let all ranks know the blocks that one has assembled
   subroutine tell_blocks(blocks, team, rank)
      !> The blocks, with their pattern
      type(node_blocks_type), intent(inout) :: blocks
      !> The ranks
      class(team_type), intent(in) :: team
      !> The one
      integer, intent(in) :: rank

      if (.not. allocated(blocks%parts)) then
         allocate (blocks%parts(block_size, size(blocks%column, kind=i8)))
         call use_large_pages(blocks%parts)
      end if
      call team%broadcast(blocks%parts, size(blocks%parts, kind=i8), rank)
   end subroutine tell_blocks

   !> Add to a range of rows
   subroutine assemble_rows(blocks, model, shapes, joint_points, support_points, from, to)
      !> The blocks
      type(node_blocks_type), intent(inout) :: blocks
      !> The job
      type(model_type), intent(in) :: model
      !> Shapes of its elements
      type(shapes_type), intent(in) :: shapes
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: support_points(:)
      !> First and last row
      integer, intent(in) :: from, to

      type(integrands_type) :: integrands
      type(integrated_type) :: integrated
      real(wp) :: local(2, 3, 3, max_blocks), matrix(max_unknowns, max_unknowns)
      integer :: k, n, place

      integrands = new_integrands(model)
      call new_integrated(shapes, integrated)
      do k = 1, n_elements(model%mesh)
         n = model%mesh%element_size(k)
         associate (nodes => model%mesh%element_nodes(:n, k))
            if (.not. any(blocks%place(nodes) >= from .and. blocks%place(nodes) <= to)) cycle
            call find_blocks(model, integrands, shapes, k, integrated, place)
            call scatter(blocks, nodes, integrated%blocks(:, :, :, :, place), from, to)
         end associate
      end do
      do k = 1, size(joint_points)
         associate (point => joint_points(k))
            n = 2*point%n_pairs
            call joint_stiffness(point%joint_point_type, point%base, &
                                 matrix(:3*n, :3*n))
            call pack_blocks(n, matrix, blocks=local)
            call scatter(blocks, point%nodes(:n), local, from, to)
         end associate
      end do
      do k = 1, size(support_points)
         associate (point => support_points(k))
            n = point%n_pairs
            call support_stiffness(point, matrix(:3*n, :3*n))
            call pack_blocks(n, matrix, blocks=local)
            call scatter(blocks, point%nodes(:n), local, from, to)
         end associate
      end do
   end subroutine assemble_rows

   !> Add the blocks of an element
   pure subroutine scatter(blocks, nodes, local, from, to)
      !> The blocks
      type(node_blocks_type), intent(inout) :: blocks
      !> Nodes of the element
      integer, intent(in) :: nodes(:)
      !> Its blocks, of the nodes i >= j column by column
      real(wp), intent(in) :: local(2, 3, 3, max_blocks)
      !> First and last row that are added to
      integer, intent(in) :: from, to

      integer(i8) :: k
      integer :: place(size(nodes)), i, j, p

      place = blocks%place(nodes)
      p = 0
      do j = 1, size(nodes)
         do i = j, size(nodes)
            p = p + 1
            if (max(place(i), place(j)) < from .or. max(place(i), place(j)) > to) cycle
            k = block_at(blocks, max(place(i), place(j)), min(place(i), place(j)))
            call add_block(local(:, :, :, p), place(i) < place(j), blocks%parts(:, k))
            ! tip of a slit: one node on both sides of a joint
            if (i /= j .and. place(i) == place(j)) call add_block(local(:, :, :, p), .true., blocks%parts(:, k))
         end do
      end do
   end subroutine scatter

   !> Add a block
   pure subroutine add_block(block, turned, parts)
      !> A or S, and C, by component of the column and component of the row
      real(wp), intent(in) :: block(2, 3, 3)
      !> Whether row and column change places
      logical, intent(in) :: turned
      !> The numbers that are added to
      real(wp), intent(inout) :: parts(block_size)

      integer :: i, j

      if (turned) then
         do j = 1, 3
            do i = 1, 3
               parts(3*(i - 1) + j) = parts(3*(i - 1) + j) + block(1, i, j)
            end do
         end do
         parts(11) = parts(11) + block(2, 1, 2)
         parts(12) = parts(12) + block(2, 2, 1)
      else
         do j = 1, 3
            do i = 1, 3
               parts(3*(j - 1) + i) = parts(3*(j - 1) + i) + block(1, i, j)
            end do
         end do
         parts(11) = parts(11) + block(2, 2, 1)
         parts(12) = parts(12) + block(2, 1, 2)
      end if
      parts(10) = parts(10) + block(2, 1, 1)
      parts(13) = parts(13) + block(2, 2, 2)
      parts(14) = parts(14) + block(2, 3, 3)
   end subroutine add_block

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

   !> Factors of A, S and C in K_m
   pure function harmonic_factors(harmonic) result(factors)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> The factors
      real(wp) :: factors(3)

      factors = circle_integral(harmonic)*[1, harmonic, harmonic**2]
   end function harmonic_factors

   !> A block of K_m from its parts
   pure subroutine evaluate(factors, parts, block)
      !> Factors of A, S and C
      real(wp), intent(in) :: factors(3)
      !> The parts
      real(wp), intent(in) :: parts(block_size)
      !> Its values, shape (component of the column, component of the row)
      real(wp), intent(out) :: block(3, 3)

      block(1, 1) = factors(1)*parts(1) + factors(3)*parts(10)
      block(2, 1) = factors(1)*parts(2) + factors(3)*parts(11)
      block(3, 1) = factors(2)*parts(3)
      block(1, 2) = factors(1)*parts(4) + factors(3)*parts(12)
      block(2, 2) = factors(1)*parts(5) + factors(3)*parts(13)
      block(3, 2) = factors(2)*parts(6)
      block(1, 3) = factors(2)*parts(7)
      block(2, 3) = factors(2)*parts(8)
      block(3, 3) = factors(1)*parts(9) + factors(3)*parts(14)
   end subroutine evaluate

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
      !> Numbers that are taken at once at most; as many as the processor takes if absent
      integer, intent(in), optional :: at_once

      integer :: k, most

      most = huge(most)
      if (present(at_once)) most = at_once
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

         call c_product(most, merge(1, 0, coupling), first_row(blocks, range), first_row(blocks, range + 1) - 1, blocks%start, &
            blocks%start(1, 2), blocks%column, blocks%parts, harmonic_factors(harmonic), x, y)
      end subroutine find

   end subroutine block_product

   !> First row of a range
   pure integer function first_row(blocks, range)
      !> The blocks
      type(node_blocks_type), intent(in) :: blocks
      !> The range
      integer, intent(in) :: range

      first_row = 1 + range_end(size(blocks%place), range - 1, blocks%n_ranges)
   end function first_row

end module axijoint_assembly_node_blocks
