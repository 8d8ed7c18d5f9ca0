!> Stiffness of the whole structure: parts free of the harmonic, then K_m
module axijoint_assembly_stiffness
   use omp_lib, only : omp_get_max_threads
   use axijoint_assembly_dofs, only : dofs_type, new_dofs, first_equation
   use axijoint_assembly_element_stiffness, only : integrands_type, new_integrands, element_blocks, max_unknowns, max_blocks
   use axijoint_assembly_pattern, only : new_pattern
   use axijoint_assembly_support, only : support_point_type, support_stiffness
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_large_pages, only : zero_large_pages
   use axijoint_base_ranges, only : range_end
   use axijoint_base_sort, only : refine_order
   use axijoint_element_blocks, only : pack_blocks
   use axijoint_element_joint, only : joint_stiffness
   use axijoint_fe_mode, only : mode_type
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements
   use axijoint_model_model, only : model_type, held_components, on_axis
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: stiffness_type, new_stiffness, number_unknowns, find_sparsity, has_sparsity
   public :: assemble_parts, any_harmonic, n_parts, least_elements

   !> Fewer elements are not worth waking the threads for
   integer, parameter :: least_elements = 50
   !> A class of more than one harmonic
   integer, parameter :: any_harmonic = -1

   !> Stiffness of one class of modes, free of the harmonic. In the sums
   !> K_m = c_m (A + m S + m^2 C) S couples w with u and v, and A and C couple all
   !> others, so two numbers an entry are enough.
   type :: stiffness_type
      !> The unknowns
      type(dofs_type) :: dofs
      !> Sparsity, shared by all harmonics of the class
      type(symmetric_matrix_type) :: pattern
      !> The only harmonic of the class; `any_harmonic` if there may be more
      integer :: harmonic = any_harmonic
      !> A and C, or S and zero, of each entry; for a class of one harmonic its
      !> A + m S + m^2 C. Shape (2 | 1, entries)
      real(wp), allocatable :: parts(:, :)
      !> 1 for the equations of w, 0 for those of u and v
      integer, allocatable :: is_w(:)
      !> Whether the columns of a row are u, v, w of one node after the other
      logical, allocatable :: regular(:)
      !> Place of each node in the order
      integer, allocatable :: place(:)
   end type stiffness_type

   !> Elements in the order of their first nodes, so that neighbouring rows are added to together
   type :: element_order_type
      !> The elements
      integer, allocatable :: elements(:)
      !> First and last place of the nodes of each element
      integer, allocatable :: lowest(:), highest(:)
   end type element_order_type

contains

   !> Unknowns and sparsity of the class that a mode belongs to
   subroutine new_stiffness(stiffness, model, mode, graph, order)
      !> The stiffness, without parts
      type(stiffness_type), intent(out) :: stiffness
      !> The job
      type(model_type), intent(in) :: model
      !> Any mode of the class
      type(mode_type), intent(in) :: mode
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node to be numbered
      integer, intent(in) :: order(:)

      call number_unknowns(stiffness, model, mode, order)
      call find_sparsity(stiffness, graph, order)
   end subroutine new_stiffness

   !> Unknowns of the class that a mode belongs to: all that is known of a class that others solve
   subroutine number_unknowns(stiffness, model, mode, order)
      !> The stiffness, without sparsity
      type(stiffness_type), intent(out) :: stiffness
      !> The job
      type(model_type), intent(in) :: model
      !> Any mode of the class
      type(mode_type), intent(in) :: mode
      !> order(k) is the k-th node to be numbered
      integer, intent(in) :: order(:)

      logical :: at_axis(size(order))
      integer :: k

      at_axis = on_axis(model%mesh)
      call new_dofs(stiffness%dofs, mode, at_axis, held_components(model, mode), order)
      ! with nodes on the axis harmonic 1 has equations of its own
      if (mode%harmonic == 0 .or. (mode%harmonic == 1 .and. any(at_axis))) then
         stiffness%harmonic = mode%harmonic
      end if
      allocate (stiffness%place(size(order)))
      stiffness%place(order) = [(k, k=1, size(order))]
      allocate (stiffness%is_w(stiffness%dofs%n_equations), source=0)
      associate (w => stiffness%dofs%equation(3, :))
         stiffness%is_w(pack(w, w > 0)) = 1
      end associate
   end subroutine number_unknowns

   !> Sparsity of a class whose unknowns are numbered
   subroutine find_sparsity(stiffness, graph, order)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node to be numbered
      integer, intent(in) :: order(:)

      call new_pattern(stiffness%pattern, graph, stiffness%dofs, order)
      stiffness%regular = regular_rows(stiffness%dofs, stiffness%pattern)
   end subroutine find_sparsity

   !> Whether a class has its sparsity; others are solved by other ranks
   elemental logical function has_sparsity(stiffness)
      !> The class
      type(stiffness_type), intent(in) :: stiffness

      has_sparsity = allocated(stiffness%pattern%column)
   end function has_sparsity

   !> Whether the columns of each row are u, v, w of one node after the other
   pure function regular_rows(dofs, pattern) result(regular)
      !> The unknowns
      type(dofs_type), intent(in) :: dofs
      !> The pattern
      type(symmetric_matrix_type), intent(in) :: pattern
      !> The answer for each row
      logical, allocatable :: regular(:)

      integer, allocatable :: component(:)  ! of each equation; zero if its node is not whole
      integer(i8) :: k
      integer :: node, i, next

      allocate (component(pattern%n), source=0)
      do node = 1, size(dofs%equation, 2)
         if (is_whole(dofs%equation(:, node))) component(dofs%equation(:, node)) = [1, 2, 3]
      end do
      allocate (regular(pattern%n))
      do i = 1, pattern%n
         next = 1
         do k = pattern%row_start(i), pattern%row_start(i + 1) - 1
            if (component(pattern%column(k)) /= next) exit
            next = merge(1, next + 1, next == 3)
         end do
         regular(i) = k == pattern%row_start(i + 1)
      end do
   end function regular_rows

   !> Whether a node has three equations of its own
   pure logical function is_whole(equation)
      !> Equations of its components
      integer, intent(in) :: equation(3)

      is_whole = all(equation > 0) .and. equation(3) - equation(1) == 2
   end function is_whole

   !> Equations of a node that blocks are added to at once: u, v, w, or u and v where there is harmonic 0 alone; zero
   !> if it has others, or ties
   pure integer function n_at_once(stiffness, node) result(n)
      !> The stiffness
      type(stiffness_type), intent(in) :: stiffness
      !> The node
      integer, intent(in) :: node

      n = 0
      associate (equation => stiffness%dofs%equation(:, node))
         if (stiffness%harmonic == any_harmonic) then
            if (is_whole(equation)) n = 3
         else if (stiffness%harmonic == 0) then
            if (equation(1) > 0 .and. equation(2) > 0 .and. equation(3) == 0) n = 2
         end if
      end associate
   end function n_at_once

   !> Numbers stored for each entry
   pure integer function n_parts(stiffness)
      !> The stiffness
      type(stiffness_type), intent(in) :: stiffness

      n_parts = merge(2, 1, stiffness%harmonic == any_harmonic)
   end function n_parts

   !> Integrate every element and joint once, for all classes that have a sparsity. Elements that are alike are not
   !> integrated once for all of them: what rounding leaves of stiffness against rigid motions would be the same in each,
   !> and add up. Every thread adds
   !> to rows of its own, always element by element in the order of the nodes, so
   !> that sums do not depend on the number of threads; few elements have rows of
   !> two threads.
   subroutine assemble_parts(classes, model, joint_points, support_points)
      !> The classes in use, all in the same order of the nodes
      type(stiffness_type), intent(inout) :: classes(:)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: support_points(:)

      type(integrands_type) :: integrands
      type(element_order_type) :: order
      integer :: k, n_ranges, n

      if (size(classes) == 0) return
      integrands = new_integrands(model)
      call order_elements(model%mesh, classes(1)%place, order)
      do k = 1, size(classes)
         associate (class => classes(k))
            if (.not. has_sparsity(class)) cycle
            allocate (class%parts(n_parts(class), size(class%pattern%column)))
            call zero_large_pages(class%parts)
         end associate
      end do
      n = n_nodes(model%mesh)
      n_ranges = merge(omp_get_max_threads(), 1, n_elements(model%mesh) > least_elements)
      !$omp parallel do schedule(static, 1) if (n_ranges > 1)
      do k = 1, n_ranges
         call assemble_range(classes, model, integrands, order, 1 + range_end(n, k - 1, n_ranges), &
                             range_end(n, k, n_ranges))
      end do
      !$omp end parallel do
      do k = 1, size(joint_points)
         call add_joint_point(joint_points(k), classes)
      end do
      do k = 1, size(support_points)
         call add_support_point(support_points(k), classes)
      end do
   end subroutine assemble_parts

   !> Put the elements in the order of their first nodes
   subroutine order_elements(mesh, place, order)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Place of each node in the order
      integer, intent(in) :: place(:)
      !> The elements in their order
      type(element_order_type), intent(out) :: order

      integer :: k

      allocate (order%lowest(n_elements(mesh)), order%highest(n_elements(mesh)))
      do k = 1, n_elements(mesh)
         associate (places => place(mesh%element_nodes(:mesh%element_size(k), k)))
            order%lowest(k) = minval(places)
            order%highest(k) = maxval(places)
         end associate
      end do
      order%elements = [(k, k=1, n_elements(mesh))]
      call refine_order(order%elements, order%lowest)
   end subroutine order_elements

   !> Assemble the rows of a range of nodes
   subroutine assemble_range(classes, model, integrands, order, from, to)
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)
      !> The job
      type(model_type), intent(in) :: model
      !> Kinds of elements, and kernels of the materials
      type(integrands_type), intent(in) :: integrands
      !> Elements in the order of the nodes
      type(element_order_type), intent(in) :: order
      !> First and last place of the range
      integer, intent(in) :: from, to

      real(wp) :: blocks(2, 3, 3, max_blocks)
      integer :: k, i

      do k = 1, size(order%elements)
         associate (element => order%elements(k))
            if (order%lowest(element) > to .or. order%highest(element) < from) cycle
            call element_blocks(model, integrands, element, blocks)
            do i = 1, size(classes)
               call scatter(classes(i), model%mesh%element_nodes(:model%mesh%element_size(element), element), &
                  blocks, from, to)
            end do
         end associate
      end do
   end subroutine assemble_range

   !> Add one point of a joint; its stiffness is free of the harmonic: part A
   subroutine add_joint_point(point, classes)
      !> The point
      type(model_joint_point_type), intent(in) :: point
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)

      real(wp) :: parts(max_unknowns, max_unknowns), blocks(2, 3, 3, max_blocks)
      integer :: n, i

      n = 2*point%n_pairs
      call joint_stiffness(point%joint_point_type, point%base, parts(:3*n, :3*n))
      call pack_blocks(n, parts, blocks=blocks)
      do i = 1, size(classes)
         call scatter(classes(i), point%nodes(:n), blocks, 1, huge(1))
      end do
   end subroutine add_joint_point

   !> Add one point of a spring; free of the harmonic, too
   subroutine add_support_point(point, classes)
      !> The point
      type(support_point_type), intent(in) :: point
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)

      real(wp) :: parts(max_unknowns, max_unknowns), blocks(2, 3, 3, max_blocks)
      integer :: n, i

      n = point%n_pairs
      call support_stiffness(point, parts(:3*n, :3*n))
      call pack_blocks(n, parts, blocks=blocks)
      do i = 1, size(classes)
         call scatter(classes(i), point%nodes(:n), blocks, 1, huge(1))
      end do
   end subroutine add_support_point

   !> Add the blocks of an element. The equations of a node follow each other, and
   !> the rows of a node have the same columns up to the node itself: one search
   !> finds the place of a block.
   pure subroutine scatter(stiffness, nodes, blocks, from, to)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> Nodes of the element, shape (n)
      integer, intent(in) :: nodes(:)
      !> Its blocks
      real(wp), intent(in) :: blocks(2, 3, 3, max_blocks)
      !> First and last place of the nodes whose rows are added to
      integer, intent(in) :: from, to

      logical :: mine(size(nodes))
      integer :: first(size(nodes)), n(size(nodes)), i, j, p

      if (.not. has_sparsity(stiffness)) return
      do i = 1, size(nodes)
         first(i) = first_equation(stiffness%dofs%equation(:, nodes(i)))
         n(i) = n_at_once(stiffness, nodes(i))
         mine(i) = first(i) > 0 .and. stiffness%place(nodes(i)) >= from &
            .and. stiffness%place(nodes(i)) <= to
      end do
      p = 0
      do j = 1, size(nodes)
         do i = j, size(nodes)
            p = p + 1
            if (first(i) == 0 .or. first(j) == 0) cycle
            if (i /= j .and. first(i) == first(j)) then  ! tip of a slit: one node on both sides
               if (mine(i)) call add_block(stiffness, nodes(i), nodes(j), first(i), first(j), n(i), &
                                           blocks(:, :, :, p) + transposed(blocks(:, :, :, p)))
            else if (first(i) >= first(j)) then
               if (mine(i)) call add_block(stiffness, nodes(i), nodes(j), first(i), first(j), min(n(i), n(j)), &
                                           blocks(:, :, :, p))
            else
               if (mine(j)) call add_block(stiffness, nodes(j), nodes(i), first(j), first(i), min(n(i), n(j)), &
                                           transposed(blocks(:, :, :, p)))
            end if
         end do
      end do
   end subroutine scatter

   !> A block with its nodes exchanged
   pure function transposed(block)
      !> The block
      real(wp), intent(in) :: block(2, 3, 3)
      !> The other
      real(wp) :: transposed(2, 3, 3)

      integer :: i

      do i = 1, 3
         transposed(:, i, :) = block(:, :, i)
      end do
   end function transposed

   !> Add the block of two nodes
   pure subroutine add_block(stiffness, row_node, column_node, row, column, n, block)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> The nodes, and their first equations, row >= column
      integer, intent(in) :: row_node, column_node, row, column
      !> Equations of both that are added to at once, or zero
      integer, intent(in) :: n
      !> The block
      real(wp), intent(in) :: block(2, 3, 3)

      real(wp) :: reduced(2, 3, 3)
      integer(i8) :: offset, k
      integer :: i

      offset = block_offset(stiffness%pattern%column(stiffness%pattern%row_start(row): &
                                                     stiffness%pattern%row_start(row + 1) - 1), &
                            column, merge(3, 1, stiffness%regular(row)))
      if (n == 3) then
         do i = 1, 3
            k = stiffness%pattern%row_start(row + i - 1) + offset
            call add_row(merge(i, 3, row == column), block(1, 1, i), stiffness%parts(1, k))
         end do
      else if (n == 2) then
         k = stiffness%pattern%row_start(row) + offset
         stiffness%parts(1, k) = stiffness%parts(1, k) + block(1, 1, 1)
         if (row /= column) stiffness%parts(1, k + 1) = stiffness%parts(1, k + 1) + block(1, 2, 1)
         k = stiffness%pattern%row_start(row + 1) + offset
         stiffness%parts(1, k:k + 1) = stiffness%parts(1, k:k + 1) + block(1, 1:2, 2)
      else
         reduced = block
         if (stiffness%harmonic /= any_harmonic) &
            call evaluate(real(stiffness%harmonic, wp), reduced)
         call add_part_block(stiffness, row_node, column_node, offset - column, reduced)
      end if
   end subroutine add_block

   !> Add the first entries of a row of a block
   pure subroutine add_row(n, row, parts)
      !> How many: 1 to 3
      integer, intent(in) :: n
      !> The row
      real(wp), intent(in) :: row(6)
      !> Where the row begins
      real(wp), intent(inout) :: parts(*)

      integer :: k

      if (n == 3) then  ! most often: a fixed number is added at once
         do k = 1, 6
            parts(k) = parts(k) + row(k)
         end do
      else
         do k = 1, 2*n
            parts(k) = parts(k) + row(k)
         end do
      end if
   end subroutine add_row

   !> Entries of a row before a block, by bisection
   pure integer function block_offset(columns, column, stride)
      !> Columns of the row
      integer, intent(in), contiguous :: columns(:)
      !> First column of the block
      integer, intent(in) :: column
      !> Columns of a block where all have as many
      integer, intent(in) :: stride

      integer :: low, length, half

      low = 0
      length = size(columns)/stride + merge(0, 1, mod(size(columns), stride) == 0)
      do while (length > 1)
         half = length/2
         if (columns(1 + stride*(low + half)) <= column) low = low + half
         length = length - half
      end do
      block_offset = stride*low
   end function block_offset

   !> A + m S + m^2 C of a block
   pure subroutine evaluate(m, block)
      !> The harmonic
      real(wp), intent(in) :: m
      !> The block; the sum is its first number
      real(wp), intent(inout) :: block(2, 3, 3)

      block(1, 3, 1:2) = m*block(1, 3, 1:2)
      block(1, 1:2, 3) = m*block(1, 1:2, 3)
      block(1, :, :) = block(1, :, :) + m**2*block(2, :, :)
   end subroutine evaluate

   !> Add the block of two nodes one of which may lack equations or have tied ones
   pure subroutine add_part_block(stiffness, row_node, column_node, offset, block)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> The nodes
      integer, intent(in) :: row_node, column_node
      !> Position of an entry in its row, without its column
      integer(i8), intent(in) :: offset
      !> The block
      real(wp), intent(in) :: block(2, 3, 3)

      integer(i8) :: k
      integer :: i, j

      associate (rows => stiffness%dofs%equation(:, row_node), &
                 columns => stiffness%dofs%equation(:, column_node), &
                 row_factor => stiffness%dofs%factor(:, row_node), &
                 column_factor => stiffness%dofs%factor(:, column_node))
         do i = 1, 3
            do j = 1, 3
               if (columns(j) == 0 .or. rows(i) < columns(j)) cycle
               k = stiffness%pattern%row_start(rows(i)) + offset + columns(j)
               associate (entry => stiffness%parts(:, k))
                  entry = entry + row_factor(i)*column_factor(j)*block(:size(entry), j, i)
               end associate
            end do
         end do
      end associate
   end subroutine add_part_block

end module axijoint_assembly_stiffness
