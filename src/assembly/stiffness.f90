!> Stiffness of the whole structure: parts free of the harmonic, then K_m
module axijoint_assembly_stiffness
   use omp_lib, only : omp_get_max_threads
   use axijoint_assembly_dofs, only : dofs_type, new_dofs
   use axijoint_assembly_pattern, only : new_pattern
   use axijoint_assembly_support, only : support_point_type, support_stiffness
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_sort, only : refine_order
   use axijoint_element_joint, only : joint_stiffness
   use axijoint_element_solid, only : solid_point_type, solid_points, solid_stiffness, &
                                      stiffness_kernel_type, new_stiffness_kernel, &
                                      dilatation_type, new_dilatation
   use axijoint_fe_mode, only : mode_type
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type, entry_position
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_material, only : elasticity
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_nodes, n_elements
   use axijoint_model_model, only : model_type, element_references, on_axis
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: stiffness_type, new_stiffness, assemble_parts, any_harmonic, n_parts

   !> Fewer elements are not worth waking the threads for
   integer, parameter :: least_elements = 1000
   !> Unknowns of the largest element
   integer, parameter :: max_unknowns = 3*max_element_nodes
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
      !> Place of each node in the order
      integer, allocatable :: place(:)
   end type stiffness_type

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

      logical :: at_axis(size(order))
      integer :: k

      at_axis = on_axis(model%mesh)
      call new_dofs(stiffness%dofs, mode, at_axis, model%fixed, order)
      call new_pattern(stiffness%pattern, graph, stiffness%dofs, order)
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
   end subroutine new_stiffness

   !> Numbers stored for each entry
   pure integer function n_parts(stiffness)
      !> The stiffness
      type(stiffness_type), intent(in) :: stiffness

      n_parts = merge(2, 1, stiffness%harmonic == any_harmonic)
   end function n_parts

   !> Integrate every element and joint once, for all classes. Every thread adds
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

      type(stiffness_kernel_type) :: kernels(size(model%materials))
      type(reference_type) :: references(3:9)
      integer, allocatable :: elements(:), lowest(:), highest(:)
      integer :: k, n_ranges, n

      if (size(classes) == 0) return
      references = element_references(model)
      do k = 1, size(kernels)
         kernels(k) = new_stiffness_kernel(elasticity(model%materials(k)))
      end do
      call order_elements(model%mesh, classes(1)%place, elements, lowest, highest)
      do k = 1, size(classes)
         associate (class => classes(k))
            allocate (class%parts(n_parts(class), size(class%pattern%column)))
         end associate
      end do
      n = n_nodes(model%mesh)
      n_ranges = merge(omp_get_max_threads(), 1, size(elements) > least_elements)
      !$omp parallel do schedule(static, 1) if (n_ranges > 1)
      do k = 1, n_ranges
         call assemble_range(classes, model, references, kernels, elements, lowest, highest, &
                             1 + share(n, k - 1, n_ranges), share(n, k, n_ranges))
      end do
      !$omp end parallel do
      do k = 1, size(joint_points)
         call add_joint_point(model, joint_points(k), classes)
      end do
      do k = 1, size(support_points)
         call add_support_point(support_points(k), classes)
      end do
   end subroutine assemble_parts

   !> The first k of n_ranges equal shares of n
   pure integer function share(n, k, n_ranges)
      !> Whole, number of shares taken and of all shares
      integer, intent(in) :: n, k, n_ranges

      share = int(int(n, i8)*k/n_ranges)
   end function share

   !> Elements in the order of their first nodes, so that neighbouring rows are
   !> added to together
   subroutine order_elements(mesh, place, elements, lowest, highest)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Place of each node in the order
      integer, intent(in) :: place(:)
      !> The elements in their order
      integer, allocatable, intent(out) :: elements(:)
      !> First and last place of the nodes of each element
      integer, allocatable, intent(out) :: lowest(:), highest(:)

      integer :: k

      allocate (lowest(n_elements(mesh)), highest(n_elements(mesh)))
      do k = 1, size(lowest)
         associate (places => place(mesh%element_nodes(:mesh%element_size(k), k)))
            lowest(k) = minval(places)
            highest(k) = maxval(places)
         end associate
      end do
      elements = [(k, k=1, size(lowest))]
      call refine_order(elements, lowest)
   end subroutine order_elements

   !> Assemble the rows of a range of nodes
   subroutine assemble_range(classes, model, references, kernels, elements, lowest, highest, &
                             from, to)
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)
      !> The job
      type(model_type), intent(in) :: model
      !> Kinds of elements, by number of nodes
      type(reference_type), intent(in) :: references(3:)
      !> Kernels of the materials
      type(stiffness_kernel_type), intent(in) :: kernels(:)
      !> Elements in the order of the nodes
      integer, intent(in) :: elements(:)
      !> First and last place of the nodes of each element
      integer, intent(in) :: lowest(:), highest(:)
      !> First and last place of the range
      integer, intent(in) :: from, to

      integer :: k

      do k = 1, size(classes)
         call clear_rows(classes(k), from, to)
      end do
      do k = 1, size(elements)
         if (lowest(elements(k)) > to .or. highest(elements(k)) < from) cycle
         call add_element(model, references, kernels, elements(k), classes, from, to)
      end do
   end subroutine assemble_range

   !> Zeros in the rows of a range of nodes
   pure subroutine clear_rows(stiffness, from, to)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> First and last place of the range
      integer, intent(in) :: from, to

      integer :: row, k

      associate (dofs => stiffness%dofs, pattern => stiffness%pattern)
         do k = 1, size(stiffness%place)
            if (stiffness%place(k) < from .or. stiffness%place(k) > to) cycle
            row = first_equation(dofs%equation(:, k))
            if (row == 0) cycle
            associate (last => maxval(dofs%equation(:, k)))
               stiffness%parts(:, pattern%row_start(row):pattern%row_start(last + 1) - 1) = 0.0_wp
            end associate
         end do
      end associate
   end subroutine clear_rows

   !> Add the parts of one element
   subroutine add_element(model, references, kernels, element, classes, from, to)
      !> The job
      type(model_type), intent(in) :: model
      !> Kinds of elements, by number of nodes
      type(reference_type), intent(in) :: references(3:)
      !> Kernels of the materials
      type(stiffness_kernel_type), intent(in) :: kernels(:)
      !> Element
      integer, intent(in) :: element
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)
      !> First and last place of the nodes whose rows are added to
      integer, intent(in) :: from, to

      type(solid_point_type) :: points(max_element_points)
      type(dilatation_type) :: dilatation
      real(wp) :: parts(max_unknowns, max_unknowns, 3)
      integer :: n, n_points, i

      n = model%mesh%element_size(element)
      n_points = references(n)%n_points
      associate (nodes => model%mesh%element_nodes(:n, element))
         call solid_points(model%mesh%coordinates(:, nodes), references(n), points(:n_points))
         call new_dilatation(points(:n_points), references(n), dilatation)
         call solid_stiffness(points(:n_points), n, &
                              kernels(model%mesh%element_material(element)), &
                              parts(:3*n, :3*n, 1), parts(:3*n, :3*n, 2), parts(:3*n, :3*n, 3), &
                              dilatation)
         do i = 1, size(classes)
            call scatter(classes(i), nodes, parts, from, to)
         end do
      end associate
   end subroutine add_element

   !> Add one point of a joint; its stiffness is free of the harmonic: part A
   subroutine add_joint_point(model, point, classes)
      !> The job
      type(model_type), intent(in) :: model
      !> The point
      type(model_joint_point_type), intent(in) :: point
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)

      real(wp) :: parts(max_unknowns, max_unknowns, 1)
      integer :: n, i

      n = 2*point%n_pairs
      call joint_stiffness(point%joint_point_type, &
                           model%joint_materials(point%material)%law%stiffness, &
                           parts(:3*n, :3*n, 1))
      do i = 1, size(classes)
         call scatter(classes(i), point%nodes(:n), parts)
      end do
   end subroutine add_joint_point

   !> Add one point of a spring; free of the harmonic, too
   subroutine add_support_point(point, classes)
      !> The point
      type(support_point_type), intent(in) :: point
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)

      real(wp) :: parts(max_unknowns, max_unknowns, 1)
      integer :: n, i

      n = point%n_pairs
      call support_stiffness(point, parts(:3*n, :3*n, 1))
      do i = 1, size(classes)
         call scatter(classes(i), point%nodes(:n), parts)
      end do
   end subroutine add_support_point

   !> Add the parts of an element matrix. The equations of a node follow each
   !> other, and the rows of a node have the same columns up to the node itself:
   !> one search finds the place of the block of two nodes.
   pure subroutine scatter(stiffness, nodes, parts, from, to)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> Nodes of the element, shape (n)
      integer, intent(in) :: nodes(:)
      !> A, or A, S and C, for u1, v1, w1, u2, ..., the first 3n rows and columns
      real(wp), intent(in) :: parts(:, :, :)
      !> First and last place of the nodes whose rows are added to; else all
      integer, intent(in), optional :: from, to

      real(wp) :: block(2, 3, 3)  ! part, component of b, component of a
      logical :: whole(size(nodes))
      integer :: first(size(nodes)), a, b, i
      integer(i8) :: offset, k

      associate (dofs => stiffness%dofs, pattern => stiffness%pattern)
         do a = 1, size(nodes)
            first(a) = first_equation(dofs%equation(:, nodes(a)))
            whole(a) = first(a) > 0 .and. all(dofs%equation(:, nodes(a)) == first(a) + [0, 1, 2])
         end do
         do a = 1, size(nodes)
            if (first(a) == 0) cycle
            if (present(from)) then
               if (stiffness%place(nodes(a)) < from .or. stiffness%place(nodes(a)) > to) cycle
            end if
            do b = 1, size(nodes)
               if (first(b) == 0 .or. first(b) > first(a)) cycle  ! none, or the upper triangle
               offset = entry_position(pattern, first(a), first(b)) &
                  - pattern%row_start(first(a))
               call reduce_block(stiffness%harmonic, parts(3*a - 2:3*a, 3*b - 2:3*b, :), block)
               if (whole(a) .and. whole(b)) then
                  do i = 1, 3
                     k = pattern%row_start(first(a) + i - 1) + offset
                     call add_row(merge(i, 3, a == b), block(:, :, i), stiffness%parts(:, k:))
                  end do
               else
                  call add_block(stiffness, dofs%equation(:, nodes(a)), dofs%equation(:, nodes(b)), &
                                 offset - first(b), dofs%factor(:, nodes(a)), &
                                 dofs%factor(:, nodes(b)), block)
               end if
            end do
         end do
      end associate
   end subroutine scatter

   !> The numbers to store for the block of two nodes
   pure subroutine reduce_block(harmonic, parts, block)
      !> The only harmonic of the class, or `any_harmonic`
      integer, intent(in) :: harmonic
      !> A, or A, S and C
      real(wp), intent(in) :: parts(:, :, :)
      !> What is stored: part, column, row
      real(wp), intent(out) :: block(2, 3, 3)

      real(wp) :: m

      block(1, :, :) = transpose(parts(:, :, 1))
      block(2, :, :) = 0.0_wp
      if (size(parts, 3) == 1) return
      if (harmonic == any_harmonic) then
         block(2, :, :) = transpose(parts(:, :, 3))
         block(:, 3, 1:2) = 0.0_wp
         block(:, 1:2, 3) = 0.0_wp
         block(1, 3, 1:2) = parts(1:2, 3, 2)
         block(1, 1:2, 3) = parts(3, 1:2, 2)
      else
         m = real(harmonic, wp)
         block(1, :, :) = block(1, :, :) + m*transpose(parts(:, :, 2) + m*parts(:, :, 3))
      end if
   end subroutine reduce_block

   !> Add the first entries of a row of a block
   pure subroutine add_row(n, row, parts)
      !> How many
      integer, intent(in) :: n
      !> The row
      real(wp), intent(in) :: row(2, 3)
      !> Where the row begins, shape (1 | 2, any)
      real(wp), intent(inout), contiguous :: parts(:, :)

      integer :: j

      if (size(parts, 1) == 1) then
         do j = 1, n
            parts(1, j) = parts(1, j) + row(1, j)
         end do
      else
         do j = 1, n
            parts(1, j) = parts(1, j) + row(1, j)
            parts(2, j) = parts(2, j) + row(2, j)
         end do
      end if
   end subroutine add_row

   !> Add a block of two nodes one of which lacks equations or has tied ones
   pure subroutine add_block(stiffness, rows, columns, offset, row_factor, column_factor, block)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> Equations of the two nodes; zero where there is none
      integer, intent(in) :: rows(3), columns(3)
      !> Position of an entry in its row, without its column
      integer(i8), intent(in) :: offset
      !> Factors of the components
      real(wp), intent(in) :: row_factor(3), column_factor(3)
      !> The block: part, column, row
      real(wp), intent(in) :: block(2, 3, 3)

      integer(i8) :: k
      integer :: i, j

      do i = 1, 3
         do j = 1, 3
            if (columns(j) == 0 .or. rows(i) < columns(j)) cycle
            k = stiffness%pattern%row_start(rows(i)) + offset + columns(j)
            associate (entry => stiffness%parts(:, k))
               entry = entry + row_factor(i)*column_factor(j)*block(:size(entry), j, i)
            end associate
         end do
      end do
   end subroutine add_block

   !> First equation of a node; zero if it has none
   pure integer function first_equation(equation)
      !> Equations of its components
      integer, intent(in) :: equation(3)

      first_equation = minval(equation, mask=equation > 0)
      if (all(equation == 0)) first_equation = 0
   end function first_equation

end module axijoint_assembly_stiffness
