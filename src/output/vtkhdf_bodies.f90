!> The bodies swept through theta, with displacements and stresses: NAME.vtkhdf
module axijoint_output_vtkhdf_bodies
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_analysis_increment_fields, only : solve_increment
   use axijoint_analysis_results, only : results_type, nodal_stress_type
   use axijoint_analysis_structure, only : structure_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_element_principal, only : principal_stresses
   use axijoint_fe_shape, only : shape_element
   use axijoint_model_mesh, only : n_elements
   use axijoint_model_model, only : model_type, on_axis
   use axijoint_output_hdf5_file, only : hdf5_file_type, kind_real, kind_long
   use axijoint_output_hdf5_series, only : hdf5_series_type
   use axijoint_output_run, only : run_type
   use axijoint_output_swept_mesh, only : swept_mesh_type, new_swept_mesh, add_solid, n_points
   use axijoint_output_totals, only : circle_type, new_circle
   use axijoint_output_vtkhdf, only : sweep_planes, is_circle, write_frame, write_steps, &
      write_cell_labels, point_group
   implicit none
   private
   public :: write_bodies

   !> Names of the fields of one component: displacements, stresses, principal stresses
   character(len=*), parameter :: scalars(12) = [character(len=11) :: 'u', 'v', 'w', &
      'sigma_r', 'sigma_z', 'sigma_theta', 'tau_rz', 'tau_rtheta', 'tau_ztheta', &
      'sigma_1', 'sigma_2', 'sigma_3']
   !> Triangles and quadrilaterals that elements of 6, 8 and 9 nodes are divided into
   integer, parameter :: parts_of_six(3, 4) = reshape([1, 4, 6, 4, 2, 5, 6, 5, 3, 4, 5, 6], [3, 4])
   integer, parameter :: parts_of_nine(4, 4) = reshape([1, 5, 9, 8, 5, 2, 6, 9, 9, 6, 3, 7, 8, 9, 7, 4], &
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

   !> Write the file
   subroutine write_bodies(file, run, model, structure, results, mesh, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> Results at the end
      type(results_type), intent(in) :: results
      !> What was written
      type(swept_mesh_type), intent(out) :: mesh
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(section_type) :: section

      call make_section(model, results, section, mesh)
      call write_frame(file, run, model, results, mesh)
      associate (owner => mesh%owner(:mesh%n_cells))
         call write_cell_labels(file, mesh, "body", model%mesh%element_body(owner), "Body")
         call write_cell_labels(file, mesh, "material", &
            (model%materials(model%mesh%element_material(owner))%label), "Material")
         call write_cell_labels(file, mesh, "element", model%mesh%element_label(owner), "Element")
      end associate
      call write_node_labels(file, model, section, mesh)
      if (.not. allocated(error)) call write_fields(file, model, structure, results, section, mesh, error)
      call write_steps(file, mesh, results%states, [character(len=12) :: 'displacement', 'stress', scalars], &
                       [character(len=1) ::], ['node'], [character(len=8) :: 'body', 'material', 'element'])
   end subroutine write_bodies

   !> Divide the meridional plane into triangles and quadrilaterals of three and four nodes
   pure subroutine make_section(model, results, section, mesh)
      !> The job
      type(model_type), intent(in) :: model
      !> Results, for their points
      type(results_type), intent(in) :: results
      !> The points
      type(section_type), intent(out) :: section
      !> The mesh
      type(swept_mesh_type), intent(out) :: mesh

      real(wp) :: derivative(2, 8)
      real(wp), allocatable :: position(:, :)
      logical, allocatable :: pole(:), axis(:)
      integer :: element, k, n_values, points(9)

      call shape_element(8, 0.0_wp, 0.0_wp, section%shape, derivative)
      section%centred = pack([(element, element=1, n_elements(model%mesh))], model%mesh%element_size == 8)
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

   !> Numbers of the nodes
   subroutine write_node_labels(file, model, section, mesh)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> The points
      type(section_type), intent(in) :: section
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh

      type(hdf5_series_type) :: series
      integer(i8) :: label(0:size(model%mesh%node_label))
      integer :: j

      label(0) = 0
      label(1:) = model%mesh%node_label
      call file%begin(series, point_group//"node", kind_long, [n_points(mesh)], &
                      "Node, 0 at the centre of an element of 8 nodes; (point)")
      call file%append(series, (label(pack(section%node, mesh%axis))))
      do j = 1, size(mesh%angle)
         call file%append(series, (label(pack(section%node, .not. mesh%axis))))
      end do
      call file%end(series)
   end subroutine write_node_labels

   !> Displacements and stresses, step by step, plane by plane
   subroutine write_fields(file, model, structure, results, section, mesh, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The points
      type(section_type), intent(in) :: section
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(hdf5_series_type) :: displacement, stress, scalar(size(scalars))
      type(results_type) :: earlier
      integer :: i, k

      associate (n => size(results%states)*n_points(mesh))
         call file%begin(displacement, point_group//"displacement", kind_real, [3_i8, n], &
                         "x, y, z; (3, point) [length]")
         call file%begin(stress, point_group//"stress", kind_real, [6_i8, n], &
                         "xx, yy, zz, xy, yz, xz; (6, point) [stress]")
         do k = 1, size(scalars)
            call file%begin(scalar(k), point_group//trim(scalars(k)), kind_real, [n], &
                            "Of displacement or stress; (point) [length or stress]")
         end do
      end associate
      do i = 1, size(results%states) - 1
         call solve_increment(model, structure, results%states(i), results, earlier, error)
         if (allocated(error)) exit
         call put_step(earlier)
      end do
      if (.not. allocated(error)) call put_step(results)
      call file%end(displacement)
      call file%end(stress)
      do k = 1, size(scalars)
         call file%end(scalar(k))
      end do

   contains

      !> One step: points on the axis, then those of each plane
      subroutine put_step(now)
         !> Results of the step
         type(results_type), intent(in) :: now

         integer :: j

         call put_plane(plane_fields(section, now, new_circle(now%modes, mesh%angle(1))), mesh%axis)
         do j = 1, size(mesh%angle)
            call put_plane(plane_fields(section, now, new_circle(now%modes, mesh%angle(j))), &
                           .not. mesh%axis)
         end do
      end subroutine put_step

      !> Some points of a plane
      subroutine put_plane(plane, some)
         !> The fields
         type(plane_type), intent(in) :: plane
         !> Which points
         logical, intent(in) :: some(:)

         integer, allocatable :: points(:)
         integer :: n

         points = pack([(n, n=1, size(some))], some)
         call file%append(displacement, (plane%displacement(:, points)))
         call file%append(stress, (plane%stress(:, points)))
         do n = 1, size(scalars)
            call file%append(scalar(n), (plane%scalar(points, n)))
         end do
      end subroutine put_plane

   end subroutine write_fields

   !> Sums of the harmonics at all points of a plane
   pure function plane_fields(section, results, circle) result(plane)
      !> The points
      type(section_type), intent(in) :: section
      !> Results
      type(results_type), intent(in) :: results
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
         if (all(ieee_is_finite(s(:, k)))) plane%scalar(k, 10:12) = principal_stresses(plane%stress(:, k))
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

end module axijoint_output_vtkhdf_bodies
