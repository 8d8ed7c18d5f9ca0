!> What no displacements of the nodes can make good: the exact displacements u minus their
!> interpolant u_I between the nodes, from polynomials of a higher degree fitted to the
!> displacements of the nodes round each element. The solution u_h minimizes the energy of the
!> error, so that its nodes are off by u_I - u_h, which solves
!>
!>    K (u_I - u_h) = - integral of B^T D strain(u - u_I)
!>
!> Where the elements take the volumetric strain as its mean, or the reduced rule, K is not the
!> integral of B^T D B; what it leaves of B^T D strain(u) then belongs to the right side, too.
!> A solution with the same factor thus gives the errors of displacements and of joints.
module axijoint_analysis_interpolation_error
   use axijoint_analysis_patch_recovery, only : patches_type, patch_work_type, find_patch, &
                                                frame_type, new_frame, in_frame, weight_of
   use axijoint_analysis_polynomial_fit, only : n_complete, max_functions, polynomials, slopes, &
                                                fit_polynomial
   use axijoint_base_kinds, only : wp
   use axijoint_element_solid, only : solid_point_type, solid_points, add_solid_force, &
                                      dilatation_type, new_dilatation
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type, new_reference
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_material, only : elasticity
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_elements, n_nodes
   use axijoint_model_model, only : model_type, element_references
   implicit none
   private
   public :: interpolation_type, new_interpolation, interpolation_force

   !> Functions that all elements interpolate exactly: 1 and two coordinates
   integer, parameter :: n_exact = 3

   !> One element
   type :: piece_type
      !> Nodes of its patch
      integer, allocatable :: nodes(:)
      !> Coefficients of the functions from the displacements of these nodes, shape
      !> (functions, nodes)
      real(wp), allocatable :: coefficient(:, :)
      !> Functions minus their interpolants at the integration points: derivatives by r and z,
      !> value over r, shape (3, functions, points)
      real(wp), allocatable :: error(:, :, :)
      !> The functions themselves, at the integration points and at those of the full rule;
      !> allocated where K is not the integral of B^T D B
      real(wp), allocatable :: own(:, :, :), full(:, :, :)
   end type piece_type

   !> All elements
   type :: interpolation_type
      !> One an element
      type(piece_type), allocatable :: pieces(:)
   end type interpolation_type

contains

   !> Fit polynomials round all elements
   subroutine new_interpolation(model, patches, interpolation)
      !> The job
      type(model_type), intent(in) :: model
      !> Which elements lie round a node
      type(patches_type), intent(in) :: patches
      !> The fits
      type(interpolation_type), intent(out) :: interpolation

      type(reference_type) :: references(3:9), full(3:9)
      type(patch_work_type), allocatable :: work  ! threads have small stacks
      integer, allocatable :: seen(:)
      integer :: element

      references = element_references(model)
      full = full_references()
      allocate (interpolation%pieces(n_elements(model%mesh)))
      !$omp parallel private(work, seen)
      allocate (work)
      allocate (seen(n_nodes(model%mesh)), source=0)
      !$omp do schedule(dynamic, 16)
      do element = 1, n_elements(model%mesh)
         call find_patch(model%mesh, patches, 1, element, work)
         call fit_piece(model%mesh, references(model%mesh%element_size(element)), &
                        full(model%mesh%element_size(element)), element, &
                        patch_nodes(model%mesh, work%elements(:work%n), element, seen), &
                        interpolation%pieces(element))
      end do
      !$omp end do
      !$omp end parallel
   end subroutine new_interpolation

   !> Nodes of the elements of a patch, each once
   function patch_nodes(mesh, elements, number, seen) result(nodes)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The elements
      integer, intent(in) :: elements(:)
      !> Number of the patch
      integer, intent(in) :: number
      !> Last patch in which each node was seen
      integer, intent(inout) :: seen(:)
      !> The nodes
      integer, allocatable :: nodes(:)

      integer :: k, i, n

      allocate (nodes(sum(mesh%element_size(elements))))
      n = 0
      do k = 1, size(elements)
         do i = 1, mesh%element_size(elements(k))
            associate (node => mesh%element_nodes(i, elements(k)))
               if (seen(node) == number) cycle
               seen(node) = number
               n = n + 1
               nodes(n) = node
            end associate
         end do
      end do
      nodes = nodes(:n)
   end function patch_nodes

   !> Degree of the polynomial round an element: two above its own in quadrilaterals. The strains
   !> of u - u_I of the first degree have no mean in elements of one shape, so that those of the
   !> second count as much. The errors of nodes of triangles change from node to node; a higher
   !> polynomial would follow them
   pure integer function degree(n_nodes)
      !> Nodes of the element
      integer, intent(in) :: n_nodes

      degree = merge(1, 2, n_nodes <= 4) + merge(1, 2, n_corners(n_nodes) == 3)
   end function degree

   !> Fit a polynomial to the displacements round an element
   subroutine fit_piece(mesh, reference, full, element, nodes, piece)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The kind of element, with its own rule and with the full one
      type(reference_type), intent(in) :: reference, full
      !> The element
      integer, intent(in) :: element
      !> Nodes of its patch
      integer, intent(in) :: nodes(:)
      !> Takes the fit
      type(piece_type), intent(out) :: piece

      type(frame_type) :: frame
      real(wp), allocatable :: place(:, :), weight(:), coefficient(:, :)
      integer :: i, n

      n = n_complete(degree(reference%n_nodes))
      frame = new_frame(mesh, element, mesh%coordinates(:, nodes))
      allocate (place(2, size(nodes)), weight(size(nodes)), coefficient(n, size(nodes)))
      do i = 1, size(nodes)
         place(:, i) = in_frame(frame, mesh%coordinates(:, nodes(i)))
         weight(i) = weight_of(frame, mesh%coordinates(:, nodes(i)))
      end do
      call fit_polynomial(place, weight, coefficient)
      allocate (piece%nodes, source=nodes)
      call move_alloc(coefficient, piece%coefficient)
      allocate (piece%error(3, n, reference%n_points))
      call place_functions(mesh, reference, element, frame, piece%error, less_interpolant=.true.)
      if (.not. reference%mean_dilatation .and. reference%n_points == full%n_points) return
      allocate (piece%own(3, n, reference%n_points), piece%full(3, n, full%n_points))
      call place_functions(mesh, reference, element, frame, piece%own, less_interpolant=.false.)
      call place_functions(mesh, full, element, frame, piece%full, less_interpolant=.false.)
   end subroutine fit_piece

   !> The elements with the rules that stand for exact integrals
   pure function full_references() result(references)
      !> The elements of 3, 4, 6, 8 and 9 nodes
      type(reference_type) :: references(3:9)

      references(3) = new_reference(3, 2)
      references(4) = new_reference(4, 2)
      references(6) = new_reference(6, 3)
      references(8) = new_reference(8, 3)
      references(9) = new_reference(9, 3)
   end function full_references

   !> Functions at the integration points, on demand less what the element interpolates
   pure subroutine place_functions(mesh, reference, element, frame, values, less_interpolant)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The kind of element
      type(reference_type), intent(in) :: reference
      !> The element
      integer, intent(in) :: element
      !> Coordinates of its patch
      type(frame_type), intent(in) :: frame
      !> Derivatives by r and z, value over r, shape (3, functions, points)
      real(wp), intent(out) :: values(:, :, :)
      !> Whether to take the interpolants off
      logical, intent(in) :: less_interpolant

      type(solid_point_type) :: points(max_element_points)
      real(wp) :: at_nodes(size(values, 2), max_element_nodes), x(2), slope(2, size(values, 2))
      integer :: i, n

      n = size(values, 2)
      at_nodes = 0.0_wp
      associate (nodes => mesh%element_nodes(:reference%n_nodes, element), m => reference%n_nodes)
         if (less_interpolant) then
            do i = 1, m
               at_nodes(:, i) = polynomials(n, in_frame(frame, mesh%coordinates(:, nodes(i))))
            end do
         end if
         call solid_points(mesh%coordinates(:, nodes), reference, points(:reference%n_points))
         do i = 1, reference%n_points
            x = in_frame(frame, points(i)%position)
            slope = slopes(n, x)
            slope(1, :) = slope(1, :)/frame%half(1)
            slope(2, :) = slope(2, :)/frame%half(2)
            values(1:2, :, i) = matmul(transpose(frame%turn), slope) &
               - matmul(points(i)%gradient(:, :m), transpose(at_nodes(:, :m)))
            values(3, :, i) = (polynomials(n, x) - matmul(at_nodes(:, :m), points(i)%shape(:m))) &
               /points(i)%position(1)
         end do
      end associate
      if (less_interpolant) values(:, :n_exact, :) = 0.0_wp
   end subroutine place_functions

   !> Nodal forces whose solution is the error of the nodes, u_I - u_h, in one mode
   function interpolation_force(model, interpolation, harmonic, displacement) result(force)
      !> The job
      type(model_type), intent(in) :: model
      !> The fits
      type(interpolation_type), intent(in) :: interpolation
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Forces on components, shape (3, nodes)
      real(wp), allocatable :: force(:, :)

      type(reference_type) :: references(3:9), full(3:9)
      type(dilatation_type) :: plain
      real(wp) :: factor(max_functions, 3), element_force(3, max_element_nodes), d(6, 6)
      integer :: element, n

      references = element_references(model)
      full = full_references()
      allocate (force(3, n_nodes(model%mesh)), source=0.0_wp)
      do element = 1, n_elements(model%mesh)
         n = model%mesh%element_size(element)
         associate (nodes => model%mesh%element_nodes(:n, element), piece => interpolation%pieces(element))
            d = elasticity(model%materials(model%mesh%element_material(element)))
            call find_factors(piece, displacement, factor)
            element_force = 0.0_wp
            call add_work(references(n), piece%error, -1.0_wp)
            if (allocated(piece%own)) then
               call add_work(references(n), piece%own, 1.0_wp)
               call add_work(full(n), piece%full, -1.0_wp)
            end if
            force(:, nodes) = force(:, nodes) + circle_integral(harmonic)*element_force(:, :n)
         end associate
      end do

   contains

      !> Add the nodal forces of the stresses that functions make
      subroutine add_work(reference, functions, sign)
         !> The kind of element
         type(reference_type), intent(in) :: reference
         !> Functions at its points, shape (3, functions, points)
         real(wp), intent(in) :: functions(:, :, :)
         !> Factor on the forces
         real(wp), intent(in) :: sign

         type(solid_point_type) :: points(max_element_points)
         type(dilatation_type) :: dilatation
         real(wp) :: strain(6, max_element_points), g(3, 3)
         integer :: i, j, l

         associate (m => reference%n_points)
            call solid_points(model%mesh%coordinates(:, model%mesh%element_nodes(:n, element)), &
                              reference, points(:m))
            dilatation = plain
            call new_dilatation(points(:m), reference, dilatation)
            do i = 1, m
               g = 0.0_wp
               do l = 1, 3
                  do j = 1, size(functions, 2)
                     g(:, l) = g(:, l) + functions(:, j, i)*factor(j, l)
                  end do
               end do
               strain(:, i) = strain_of(g, harmonic)
            end do
            if (dilatation%averaged) call average_volume(points(:m), strain(:, :m))
            do i = 1, m
               call add_solid_force(points(i), n, harmonic, sign*matmul(d, strain(:, i)), element_force, &
                                    dilatation)
            end do
         end associate
      end subroutine add_work

   end function interpolation_force

   !> Factors of the functions of an element in u, v, w
   pure subroutine find_factors(piece, displacement, factor)
      !> The element
      type(piece_type), intent(in) :: piece
      !> Displacement amplitudes of all nodes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> The factors, shape (max_functions, 3)
      real(wp), intent(out) :: factor(:, :)

      integer :: i, j, n

      n = size(piece%coefficient, 1)
      factor = 0.0_wp
      do j = 1, size(piece%nodes)
         do i = 1, 3
            factor(:n, i) = factor(:n, i) + piece%coefficient(:, j)*displacement(i, piece%nodes(j))
         end do
      end do
   end subroutine find_factors

   !> Strains of one harmonic
   pure function strain_of(g, m) result(strain)
      !> Derivatives by r, by z, and values over r, of u, v, w by columns
      real(wp), intent(in) :: g(3, 3)
      !> Harmonic
      integer, intent(in) :: m
      !> Amplitudes of r, z, theta, rz, r-theta, z-theta
      real(wp) :: strain(6)

      strain = [g(1, 1), g(2, 2), g(3, 1) + m*g(3, 3), g(2, 1) + g(1, 2), &
                g(1, 3) - g(3, 3) - m*g(3, 1), g(2, 3) - m*g(3, 2)]
   end function strain_of

   !> Take the volumetric strain as its mean
   pure subroutine average_volume(points, strain)
      !> Integration points
      type(solid_point_type), intent(in) :: points(:)
      !> Strains, shape (6, points)
      real(wp), intent(inout) :: strain(:, :)

      real(wp) :: mean
      integer :: i

      mean = dot_product(points%weight, sum(strain(:3, :), 1))/sum(points%weight)
      do i = 1, size(points)
         strain(:3, i) = strain(:3, i) + (mean - sum(strain(:3, i)))/3.0_wp
      end do
   end subroutine average_volume

end module axijoint_analysis_interpolation_error
