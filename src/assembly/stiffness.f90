!> Stiffness of the whole structure: parts free of the harmonic, then K_m
module axijoint_assembly_stiffness
   use axijoint_assembly_dofs, only : dofs_type, new_dofs
   use axijoint_assembly_pattern, only : new_pattern, element_cliques
   use axijoint_assembly_support, only : support_point_type, support_stiffness
   use axijoint_base_kinds, only : wp, i8
   use axijoint_element_joint, only : joint_stiffness
   use axijoint_element_solid, only : solid_point_type, solid_points, solid_stiffness, &
                                      stiffness_kernel_type, new_stiffness_kernel, dilatation_type, new_dilatation
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : mode_type
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type, entry_position
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_material, only : elasticity
   use axijoint_model_mesh, only : max_element_nodes, n_nodes
   use axijoint_model_model, only : model_type, element_references, on_axis
   use axijoint_order_coloring, only : color_cliques
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: stiffness_type, new_stiffness, assemble_parts, harmonic_matrix

   !> Fewer elements are not worth waking the threads for
   integer, parameter :: least_elements = 1000
   !> Unknowns of the largest element
   integer, parameter :: max_unknowns = 3*max_element_nodes

   !> Stiffness of one class of modes
   type :: stiffness_type
      !> The unknowns
      type(dofs_type) :: dofs
      !> Sparsity, shared by all harmonics of the class
      type(symmetric_matrix_type) :: pattern
      !> K_m = c_m (A + m S + m^2 C): A, S, C of each entry, shape (3, entries)
      real(wp), allocatable :: parts(:, :)
   end type stiffness_type

contains

   !> Unknowns and sparsity of the class that a mode belongs to
   subroutine new_stiffness(stiffness, model, mode, graph, order)
      !> The stiffness, parts zero
      type(stiffness_type), intent(out) :: stiffness
      !> The job
      type(model_type), intent(in) :: model
      !> Any mode of the class
      type(mode_type), intent(in) :: mode
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node to be numbered
      integer, intent(in) :: order(:)

      call new_dofs(stiffness%dofs, mode, on_axis(model%mesh), model%fixed, order)
      call new_pattern(stiffness%pattern, graph, stiffness%dofs, order)
      allocate (stiffness%parts(3, size(stiffness%pattern%column)), source=0.0_wp)
   end subroutine new_stiffness

   !> Integrate every element and joint once, for all classes. Elements of one
   !> colour share no node, so threads never meet; sums do not depend on the
   !> number of threads.
   subroutine assemble_parts(classes, model, joint_points, support_points)
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: support_points(:)

      type(stiffness_kernel_type) :: kernels(size(model%materials))
      type(reference_type) :: references(3:9)
      integer, allocatable :: start(:), member(:), color_start(:), colored(:)
      integer :: color, k

      references = element_references(model)
      do k = 1, size(kernels)
         kernels(k) = new_stiffness_kernel(elasticity(model%materials(k)))
      end do
      call element_cliques(model%mesh, start, member)
      call color_cliques(n_nodes(model%mesh), start, member, color_start, colored)
      do color = 1, size(color_start) - 1
         !$omp parallel do schedule(static) if (size(colored) > least_elements)
         do k = color_start(color), color_start(color + 1) - 1
            call add_element(model, references, kernels, colored(k), classes)
         end do
         !$omp end parallel do
      end do
      do k = 1, size(joint_points)
         call add_joint_point(model, joint_points(k), classes)
      end do
      do k = 1, size(support_points)
         call add_support_point(support_points(k), classes)
      end do
   end subroutine assemble_parts

   !> Add the parts of one element
   subroutine add_element(model, references, kernels, element, classes)
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
            call scatter(classes(i), nodes, parts, 3)
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
         call scatter(classes(i), point%nodes(:n), parts, 1)
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
         call scatter(classes(i), point%nodes(:n), parts, 1)
      end do
   end subroutine add_support_point

   !> Add the parts of an element matrix. The equations of a node follow each
   !> other, and the rows of a node have the same columns up to the node itself:
   !> one search finds the place of the block of two nodes.
   pure subroutine scatter(stiffness, nodes, parts, n_parts)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> Nodes of the element, shape (n)
      integer, intent(in) :: nodes(:)
      !> A, or A, S and C, for u1, v1, w1, u2, ..., the first 3n rows and columns
      real(wp), intent(in) :: parts(:, :, :)
      !> How many parts: 1 or 3
      integer, intent(in) :: n_parts

      integer :: first(size(nodes)), a, b, i, j
      integer(i8) :: offset, k

      associate (dofs => stiffness%dofs, pattern => stiffness%pattern)
         do a = 1, size(nodes)
            first(a) = first_equation(dofs%equation(:, nodes(a)))
         end do
         do b = 1, size(nodes)
            if (first(b) == 0) cycle
            do a = 1, size(nodes)
               if (first(a) < first(b)) cycle  ! none, or the upper triangle
               offset = entry_position(pattern, first(a), first(b)) &
                  - pattern%row_start(first(a)) - first(b)
               do j = 1, 3
                  associate (column => dofs%equation(j, nodes(b)))
                     if (column == 0) cycle
                     do i = 1, 3
                        associate (row => dofs%equation(i, nodes(a)))
                           if (row < column) cycle
                           k = pattern%row_start(row) + offset + column
                           stiffness%parts(:n_parts, k) = stiffness%parts(:n_parts, k) &
                              + dofs%factor(i, nodes(a))*dofs%factor(j, nodes(b)) &
                              *parts(3*a - 3 + i, 3*b - 3 + j, :n_parts)
                        end associate
                     end do
                  end associate
               end do
            end do
         end do
      end associate
   end subroutine scatter

   !> First equation of a node; zero if it has none
   pure integer function first_equation(equation)
      !> Equations of its components
      integer, intent(in) :: equation(3)

      first_equation = minval(equation, mask=equation > 0)
      if (all(equation == 0)) first_equation = 0
   end function first_equation

   !> K_m = c_m (A + m S + m^2 C)
   subroutine harmonic_matrix(stiffness, harmonic, matrix)
      !> Stiffness of the class
      type(stiffness_type), intent(in) :: stiffness
      !> Harmonic m of that class
      integer, intent(in) :: harmonic
      !> The matrix
      type(symmetric_matrix_type), intent(out) :: matrix

      real(wp) :: m

      m = real(harmonic, wp)
      matrix = stiffness%pattern
      associate (a => stiffness%parts(1, :), s => stiffness%parts(2, :), c => stiffness%parts(3, :))
         matrix%value = circle_integral(harmonic)*(a + m*(s + m*c))
      end associate
   end subroutine harmonic_matrix

end module axijoint_assembly_stiffness
