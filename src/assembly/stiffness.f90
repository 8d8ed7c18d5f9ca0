!> Stiffness of the whole structure: parts free of the harmonic, then K_m
module axijoint_assembly_stiffness
   use axijoint_assembly_dofs, only : dofs_type, new_dofs
   use axijoint_assembly_pattern, only : new_pattern
   use axijoint_base_kinds, only : wp, i8
   use axijoint_element_joint, only : joint_stiffness
   use axijoint_element_solid, only : solid_point_type, solid_points, solid_stiffness, &
                                      isotropic_elasticity
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type, entry_position
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : max_element_nodes, n_elements
   use axijoint_model_model, only : model_type, gauss_order, on_axis
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: stiffness_type, new_stiffness, assemble_parts, harmonic_matrix

   !> Unknowns of the largest element
   integer, parameter :: max_unknowns = 3*max_element_nodes

   !> Stiffness of one class of harmonics
   type :: stiffness_type
      !> The unknowns
      type(dofs_type) :: dofs
      !> Sparsity, shared by all harmonics of the class
      type(symmetric_matrix_type) :: pattern
      !> K_m = c_m (A + m S + m^2 C): A, S, C of each entry, shape (3, entries)
      real(wp), allocatable :: parts(:, :)
   end type stiffness_type

contains

   !> Unknowns and sparsity of the class that a harmonic belongs to
   subroutine new_stiffness(stiffness, model, harmonic, graph, order)
      !> The stiffness, parts zero
      type(stiffness_type), intent(out) :: stiffness
      !> The job
      type(model_type), intent(in) :: model
      !> Any harmonic of the class
      integer, intent(in) :: harmonic
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node to be numbered
      integer, intent(in) :: order(:)

      call new_dofs(stiffness%dofs, harmonic, on_axis(model%mesh), model%fixed, order)
      call new_pattern(stiffness%pattern, graph, stiffness%dofs, order)
      allocate (stiffness%parts(3, size(stiffness%pattern%column)), source=0.0_wp)
   end subroutine new_stiffness

   !> Integrate every element and joint once, for all classes
   subroutine assemble_parts(classes, model, joint_points)
      !> The classes in use
      type(stiffness_type), intent(inout) :: classes(:)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: joint_points(:)

      real(wp) :: parts(max_unknowns, max_unknowns, 3)
      type(solid_point_type) :: points(9)
      integer :: element, n, n_gauss, k, i

      do element = 1, n_elements(model%mesh)
         n = model%mesh%element_size(element)
         n_gauss = gauss_order(model, n)
         associate (nodes => model%mesh%element_nodes(:n, element), &
                    material => model%materials(model%mesh%element_material(element)))
            call solid_points(model%mesh%coordinates(:, nodes), n_gauss, points(:n_gauss**2))
            call solid_stiffness(points(:n_gauss**2), n, &
                                 isotropic_elasticity(material%young, material%poisson), &
                                 parts(:3*n, :3*n, 1), parts(:3*n, :3*n, 2), parts(:3*n, :3*n, 3))
            do i = 1, size(classes)
               call scatter(classes(i), nodes, parts(:3*n, :3*n, :))
            end do
         end associate
      end do
      do k = 1, size(joint_points)  ! a joint's stiffness is free of the harmonic: part A
         n = 2*joint_points(k)%n_pairs
         call joint_stiffness(joint_points(k)%joint_point_type, &
                              model%joint_materials(joint_points(k)%material)%law%stiffness, &
                              parts(:3*n, :3*n, 1))
         do i = 1, size(classes)
            call scatter(classes(i), joint_points(k)%nodes(:n), parts(:3*n, :3*n, 1:1))
         end do
      end do
   end subroutine assemble_parts

   !> Add the parts of an element matrix
   pure subroutine scatter(stiffness, nodes, parts)
      !> The stiffness
      type(stiffness_type), intent(inout) :: stiffness
      !> Nodes of the element, shape (n)
      integer, intent(in) :: nodes(:)
      !> A, or A, S and C, for u1, v1, w1, u2, ..., shape (3n, 3n, 1 | 3)
      real(wp), intent(in) :: parts(:, :, :)

      integer :: equation(size(parts, 1)), i, j, n_parts
      real(wp) :: factor(size(parts, 1))
      integer(i8) :: k

      n_parts = size(parts, 3)
      equation = reshape(stiffness%dofs%equation(:, nodes), [size(equation)])
      factor = reshape(stiffness%dofs%factor(:, nodes), [size(factor)])
      do j = 1, size(equation)
         if (equation(j) == 0) cycle
         do i = 1, size(equation)
            if (equation(i) < equation(j)) cycle  ! none, or the upper triangle
            k = entry_position(stiffness%pattern, equation(i), equation(j))
            stiffness%parts(:n_parts, k) = stiffness%parts(:n_parts, k) &
               + factor(i)*factor(j)*parts(i, j, :)
         end do
      end do
   end subroutine scatter

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
