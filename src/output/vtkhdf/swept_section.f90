!> The meridional plane of the swept bodies: its points, the triangles and quadrilaterals
!> between them, and the sums of the harmonics there
module axijoint_output_vtkhdf_swept_section
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_analysis_core_fields, only : fields_type, nodal_stress_type
   use axijoint_analysis_core_totals, only : circle_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_principal, only : principal_stresses
   use axijoint_fe_shape, only : shape_element
   use axijoint_model_mesh, only : n_elements
   use axijoint_model_model, only : model_type, on_axis
   use axijoint_output_vtkhdf_grid, only : sweep_planes, is_circle
   use axijoint_output_vtkhdf_swept_mesh, only : swept_mesh_type, new_swept_mesh, add_solid
   implicit none
   private
   public :: section_type, plane_type, make_section, plane_fields, cartesian_vector, scalars

   !> Names of the fields of one component: displacements, stresses, principal stresses
   character(len=*), parameter :: scalars(12) = [character(len=11) :: 'u', 'v', 'w', &
      'sigma_r', 'sigma_z', 'sigma_theta', 'tau_rz', 'tau_rtheta', 'tau_ztheta', &
      'sigma_1', 'sigma_2', 'sigma_3']
   !> Triangles and quadrilaterals that elements of 6, 8 and 9 nodes are divided into
   integer, parameter :: parts_of_six(3, 4) = reshape([1, 4, 6, 4, 2, 5, 6, 5, 3, 4, 5, 6], [3, 4])
   integer, parameter :: parts_of_nine(4, 4) = &
      reshape([1, 5, 9, 8, 5, 2, 6, 9, 9, 6, 3, 7, 8, 9, 7, 4], &
                                                       [4, 4])

   !> Points of the meridional plane: the nodes, once for each material that they
   !> touch, then the centres of elements of 8 nodes
   type :: section_type
      !> Node of each point; 0 at a centre
      integer, allocatable :: node(:)
      !> Elements of the centres
      integer, allocatable :: centred(:)
      !> Shape functions of an element of 8 nodes at its centre
      real(wp) :: shape(8) = 0.0_wp
   end type section_type

   !> Fields of a plane: cartesian vectors and tensors, and the scalars
   type :: plane_type
      real(wp), allocatable :: displacement(:, :), stress(:, :), scalar(:, :)
   end type plane_type

contains

   !> Divide the meridional plane into triangles and quadrilaterals of three and four nodes
   pure subroutine make_section(model, results, section, mesh)
      !> The job
      type(model_type), intent(in) :: model
      !> Results, for their points
      class(fields_type), intent(in) :: results
      !> The points
      type(section_type), intent(out) :: section
      !> The mesh
      type(swept_mesh_type), intent(out) :: mesh

      real(wp) :: derivative(2, 8)
      real(wp), allocatable :: position(:, :)
      logical, allocatable :: pole(:), axis(:)
      integer :: element, k, n_values, points(9)

      call shape_element(8, 0.0_wp, 0.0_wp, section%shape, derivative)
      section%centred = pack([(element, element=1, n_elements(model%mesh))], &
         model%mesh%element_size == 8)
      n_values = size(results%nodal%node)
      section%node = [results%nodal%node, (0, k=1, size(section%centred))]
      pole = on_axis(model%mesh)
      axis = [pole(results%nodal%node), (.false., k=1, size(section%centred))]
      allocate (position(2, size(axis)))
      position(:, :n_values) = model%mesh%coordinates(:, results%nodal%node)
      call fill_centres(section, results%nodal, position)
      mesh = new_swept_mesh(sweep_planes(model%sweep, results%modes), is_circle(model%sweep), &
                            position, axis, 8*n_elements(model%mesh))
      k = n_values
      do element = 1, n_elements(model%mesh)
         points = results%nodal%value_of(:, element)
         if (model%mesh%element_size(element) == 8) then
            k = k + 1
            points(9) = k
         end if
         call add_element(mesh, element, model%mesh%element_size(element), points)
      end do
   end subroutine make_section

   !> Sweep an element, divided if it is quadratic
   pure subroutine add_element(mesh, element, n, points)
      !> The mesh
      type(swept_mesh_type), intent(inout) :: mesh
      !> The element, and its number of nodes
      integer, intent(in) :: element, n
      !> Its points
      integer, intent(in) :: points(9)

      integer :: k

      select case (n)
      case (3, 4)
         call add_solid(mesh, element, points(:n))
      case (6)
         do k = 1, size(parts_of_six, 2)
            call add_solid(mesh, element, points(parts_of_six(:, k)))
         end do
      case default
         do k = 1, size(parts_of_nine, 2)
            call add_solid(mesh, element, points(parts_of_nine(:, k)))
         end do
      end select
   end subroutine add_element

   !> Interpolate at the centres of elements of 8 nodes
   pure subroutine fill_centres(section, nodal, values)
      !> The points
      type(section_type), intent(in) :: section
      !> For the points of the elements
      type(nodal_stress_type), intent(in) :: nodal
      !> Values at all points, shape (any, points); those of the nodes are there
      real(wp), intent(inout) :: values(:, :)

      integer :: k, n

      n = size(nodal%node)
      do k = 1, size(section%centred)
         values(:, n + k) = matmul(values(:, nodal%value_of(:8, section%centred(k))), section%shape)
      end do
   end subroutine fill_centres

   !> Sums of the harmonics at all points of a plane
   pure function plane_fields(section, results, circle) result(plane)
      !> The points
      type(section_type), intent(in) :: section
      !> Results
      class(fields_type), intent(in) :: results
      !> The angle
      type(circle_type), intent(in) :: circle
      !> The fields
      type(plane_type) :: plane

      real(wp), allocatable :: nodes(:, :), u(:, :), s(:, :)
      integer :: k, n_values

      n_values = size(results%nodal%node)
      allocate (nodes(3, size(results%displacement, 2)), source=0.0_wp)
      allocate (u(3, size(section%node)), s(6, size(section%node)), source=0.0_wp)
      do k = 1, size(results%modes)
         associate (a => circle%meridional(k), b => circle%circumferential(k))
            nodes = nodes + spread([a, a, b], 2, size(nodes, 2))*results%displacement(:, :, k)
            s(:, :n_values) = s(:, :n_values) &
               + spread([a, a, a, a, b, b], 2, n_values)*results%nodal%amplitude(:, :, k)
         end associate
      end do
      u(:, :n_values) = nodes(:, results%nodal%node)
      call fill_centres(section, results%nodal, u)
      call fill_centres(section, results%nodal, s)
      allocate (plane%displacement(3, size(u, 2)), plane%stress(6, size(u, 2)))
      allocate (plane%scalar(size(u, 2), size(scalars)))
      do k = 1, size(u, 2)
         plane%displacement(:, k) = cartesian_vector(u(:, k), circle%angle)
         plane%stress(:, k) = cartesian_tensor(s(:, k), circle%angle)
         plane%scalar(k, 1:3) = u(:, k)
         plane%scalar(k, 4:9) = s(:, k)
         plane%scalar(k, 10:12) = s(1, k)
         if (all(ieee_is_finite(s(:, k)))) &
            plane%scalar(k, 10:12) = principal_stresses(plane%stress(:, k))
      end do
   end function plane_fields

   !> x, y, z of a vector r, z, theta
   pure function cartesian_vector(u, angle) result(x)
      !> Components
      real(wp), intent(in) :: u(3)
      !> Angle [radian]
      real(wp), intent(in) :: angle
      !> Cartesian components
      real(wp) :: x(3)

      x = [u(1)*cos(angle) - u(3)*sin(angle), u(1)*sin(angle) + u(3)*cos(angle), u(2)]
   end function cartesian_vector

   !> xx, yy, zz, xy, yz, xz of a tensor r, z, theta, rz, r-theta, z-theta
   pure function cartesian_tensor(s, angle) result(x)
      !> Components
      real(wp), intent(in) :: s(6)
      !> Angle [radian]
      real(wp), intent(in) :: angle
      !> Cartesian components
      real(wp) :: x(6)

      real(wp) :: c, d

      c = cos(angle)
      d = sin(angle)
      x(1) = s(1)*c**2 + s(3)*d**2 - 2.0_wp*s(5)*c*d
      x(2) = s(1)*d**2 + s(3)*c**2 + 2.0_wp*s(5)*c*d
      x(3) = s(2)
      x(4) = (s(1) - s(3))*c*d + s(5)*(c**2 - d**2)
      x(5) = s(4)*d + s(6)*c
      x(6) = s(4)*c - s(6)*d
   end function cartesian_tensor

end module axijoint_output_vtkhdf_swept_section
