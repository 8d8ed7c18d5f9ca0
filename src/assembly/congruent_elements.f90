!> Stiffness of elements that lie above others of the same shape, element by element (Hughes, Levit and Winget, Comput.
!> Methods Appl. Mech. Eng. 36, 1983): it is kept once for all elements of a shape, and never assembled
module axijoint_assembly_congruent_elements
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use axijoint_assembly_block_parts, only : block_size, add_block, harmonic_factors
   use axijoint_assembly_element_stiffness, only : integrands_type, new_integrands, element_blocks, max_blocks
   use axijoint_assembly_repeated_elements, only : shapes_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_base_ranges, only : range_end
   use axijoint_base_sort, only : refine_order
   use axijoint_element_blocks, only : n_blocks
   use axijoint_model_mesh, only : mesh_type, max_element_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: congruent_type, new_congruent, reserve_parts, integrate_shapes, add_products

   !> Most ranges of elements that products are shared by, elements of a range at least, and elements that are ordered by
   !> shape at once: what they read and write of the vectors stays in a processor's second cache
   integer, parameter :: most_ranges = 16, least_elements = 512, at_hand = 2048
   !> Part of the rows that may belong to different ranges
   real(wp), parameter :: most_coupling = 0.1_wp

   !> The elements, in the order in which products take them
   type :: congruent_type
      !> Rows of their nodes, shape (max_element_nodes, elements), zeros beyond the last
      integer(c_int), allocatable :: row(:, :)
      !> Where a product adds to: these rows, or, for a row that an earlier range adds to, a sum beyond them, same shape
      integer(c_int), allocatable :: goal(:, :)
      !> Number of nodes, and first block of the shape, shape (elements)
      integer(c_int), allocatable :: n_nodes(:)
      integer(i8), allocatable :: start(:)
      !> The ranges: element before the first of each, shape (ranges + 1)
      integer, allocatable :: before(:)
      !> Rows of the sums beyond the rows
      integer, allocatable :: shared_row(:)
      !> An element of each shape, and the block before its first, with the last of all behind them, shapes (shapes) and (shapes + 1)
      integer, allocatable :: sample(:)
      integer(i8), allocatable :: before_shape(:)
      !> Blocks of the shapes, of the nodes i >= j column by column, shape (block_size, blocks)
      real(wp), allocatable :: parts(:, :)
   end type congruent_type

   interface
      !> What elements add to y = K_m x; so many numbers at once at most
      pure subroutine c_product(most, from, to, row, goal, n_nodes, start, parts, factors, n, x, y, sums) &
         bind(c, name="axijoint_congruent_product")
         import :: c_int, c_int64_t, c_double
         integer(c_int), value :: most, from, to, n
         integer(c_int), intent(in) :: row(*), goal(*), n_nodes(*)
         integer(c_int64_t), intent(in) :: start(*)
         real(c_double), intent(in) :: parts(*), factors(*), x(*)
         real(c_double), intent(inout) :: y(*), sums(*)
      end subroutine c_product
   end interface

contains

   !> Order the elements, and see who adds to which row
   subroutine new_congruent(mesh, shapes, congruent, place, elements)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Shapes of its elements
      type(shapes_type), intent(in) :: shapes
      !> Which elements have others of their shape
      logical, intent(in) :: congruent(:)
      !> Row of each node
      integer, intent(in) :: place(:)
      !> Those that are congruent to others, without their stiffness
      type(congruent_type), intent(out) :: elements

      integer, allocatable :: order(:)
      integer(i8) :: before(size(shapes%first))
      integer :: k, n, shape

      order = pack([(k, k=1, size(congruent))], congruent)
      n = max(1, min(most_ranges, size(order)/least_elements))
      elements%before = [(range_end(size(order), k, n), k=0, n)]
      call order_by_shape(shapes, elements%before, order)
      before = -1
      allocate (elements%row(max_element_nodes, size(order)), source=0)
      allocate (elements%start(size(order)))
      elements%n_nodes = mesh%element_size(order)
      call list_shapes(mesh, shapes, order, before, elements)
      do k = 1, size(order)
         shape = shapes%number(order(k))
         elements%start(k) = before(shape) + 1
         elements%row(:elements%n_nodes(k), k) = place(mesh%element_nodes(:elements%n_nodes(k), order(k)))
      end do
      call find_goals(size(place), elements)
      if (size(elements%shared_row) <= most_coupling*size(place)) return
      elements%before = [0, size(order)]
      call find_goals(size(place), elements)
   end subroutine new_congruent

   !> Order the elements by their shape, not too many of a range at once
   pure subroutine order_by_shape(shapes, before, order)
      !> Shapes of the elements
      type(shapes_type), intent(in) :: shapes
      !> Element before the first of each range
      integer, intent(in) :: before(:)
      !> The elements
      integer, intent(inout) :: order(:)

      integer :: batch(size(shapes%number)), range, k, n

      batch = 0
      n = 0
      do range = 1, size(before) - 1
         do k = before(range) + 1, before(range + 1), at_hand
            n = n + 1
            batch(order(k:min(k + at_hand - 1, before(range + 1)))) = n
         end do
      end do
      call refine_order(order, shapes%number)
      call refine_order(order, batch)
   end subroutine order_by_shape

   !> List the shapes in the order in which they are met
   pure subroutine list_shapes(mesh, shapes, order, before, elements)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Shapes of its elements
      type(shapes_type), intent(in) :: shapes
      !> The elements that count, in their order
      integer, intent(in) :: order(:)
      !> Takes the block before the first of each shape
      integer(i8), intent(inout) :: before(:)
      !> Takes the shapes
      type(congruent_type), intent(inout) :: elements

      integer(i8) :: first(size(shapes%first) + 1)
      integer :: sample(size(shapes%first)), k, n

      n = 0
      first(1) = 0
      do k = 1, size(order)
         associate (shape => shapes%number(order(k)))
            if (before(shape) >= 0) cycle
            n = n + 1
            sample(n) = shapes%first(shape)
            before(shape) = first(n)
            first(n + 1) = first(n) + n_blocks(mesh%element_size(order(k)))
         end associate
      end do
      elements%sample = sample(:n)
      elements%before_shape = first(:n + 1)
   end subroutine list_shapes

   !> See which rows more than one range adds to: those that come later do so to sums of their own
   pure subroutine find_goals(n, elements)
      !> Rows
      integer, intent(in) :: n
      !> The elements; takes their goals
      type(congruent_type), intent(inout) :: elements

      integer :: range(n), goal(n), k, l, i, n_sums
      integer, allocatable :: shared_row(:)

      elements%goal = elements%row
      allocate (shared_row(n))
      range = 0
      n_sums = 0
      do k = 1, size(elements%before) - 1
         do l = elements%before(k) + 1, elements%before(k + 1)
            do i = 1, elements%n_nodes(l)
               associate (row => elements%row(i, l))
                  if (range(row) == 0) goal(row) = row
                  if (range(row) > 0 .and. range(row) < k) then
                     n_sums = n_sums + 1
                     if (n_sums > size(shared_row)) shared_row = [shared_row, 0*shared_row]
                     shared_row(n_sums) = row
                     goal(row) = n + n_sums
                  end if
                  range(row) = k
                  elements%goal(i, l) = goal(row)
               end associate
            end do
         end do
      end do
      elements%shared_row = shared_row(:n_sums)
   end subroutine find_goals

   !> Allocate the blocks
   subroutine reserve_parts(elements)
      !> The elements
      type(congruent_type), intent(inout) :: elements

      allocate (elements%parts(block_size, elements%before_shape(size(elements%before_shape))))
      call use_large_pages(elements%parts)
   end subroutine reserve_parts

   !> Integrate some shapes
   subroutine integrate_shapes(model, from, to, elements)
      !> The job
      type(model_type), intent(in) :: model
      !> First and last shape
      integer, intent(in) :: from, to
      !> Takes their blocks
      type(congruent_type), intent(inout) :: elements

      type(integrands_type) :: integrands
      real(wp) :: blocks(2, 3, 3, max_blocks)
      integer :: k, p

      integrands = new_integrands(model)
      do k = from, to
         call element_blocks(model, integrands, elements%sample(k), blocks)
         associate (parts => elements%parts(:, elements%before_shape(k) + 1:elements%before_shape(k + 1)))
            parts = 0.0_wp
            do p = 1, size(parts, 2)
               call add_block(blocks(:, :, :, p), .false., parts(:, p))
            end do
         end associate
      end do
   end subroutine integrate_shapes

   !> Add K_m x to y. Ranges of elements are shared among threads that have nothing else to do; where two add to one row,
   !> the later has a sum of its own, which is added afterwards: the sums are the same whoever makes them
   subroutine add_products(elements, harmonic, x, y, at_once)
      !> The elements
      type(congruent_type), intent(in) :: elements
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> x, by rows, shape (3, nodes)
      real(wp), intent(in), contiguous :: x(:, :)
      !> y, same shape
      real(wp), intent(inout), contiguous :: y(:, :)
      !> Numbers that are taken at once at most
      integer, intent(in) :: at_once

      real(wp), allocatable :: sums(:, :)
      integer :: k, n

      n = size(elements%before) - 1
      allocate (sums(3, size(elements%shared_row)), source=0.0_wp)
      do k = 1, n
         !$omp task default(shared) firstprivate(k) if (n > 1)
         call c_product(at_once, elements%before(k) + 1, elements%before(k + 1), elements%row, elements%goal, elements%n_nodes, &
            elements%start, elements%parts, harmonic_factors(harmonic), size(y, 2), x, y, sums)
         !$omp end task
      end do
      !$omp taskwait
      do k = 1, size(sums, 2)
         associate (row => y(:, elements%shared_row(k)))
            row = row + sums(:, k)
         end associate
      end do
   end subroutine add_products

end module axijoint_assembly_congruent_elements
