!> Stresses of the integration points smoothed to the nodes
module axijoint_analysis_core_nodal_stress
   use axijoint_analysis_core_fields, only : fields_type, nodal_stress_type
   use axijoint_assembly_equations, only : equations_type, own_modes, worth_threads
   use axijoint_base_kinds, only : wp, i8
   use axijoint_fe_extrapolation, only : extrapolation_matrix
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_elements, n_nodes, &
      element_references
   use axijoint_model_model, only : model_type, on_axis
   implicit none
   private
   public :: smooth_stress, stress_at_node, pole_stress, number_values, area

contains

   !> Fill the stresses at the nodes: a smooth function fitted to the integration
   !> points of each element; its values at a node averaged over the elements of
   !> one material. An element counts by the inverse of its area: on a rectangular
   !> grid that interpolates between the middles of the elements.
   subroutine smooth_stress(model, equations, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Its equations, for the modes of each rank
      type(equations_type), intent(in) :: equations
      !> Results; stresses at the integration points are there already
      class(fields_type), intent(inout) :: results

      real(wp), allocatable :: weight(:), weight_sum(:)
      integer :: element, k, n, own(2)

      call number_values(model%mesh, results%nodal)
      associate (mesh => model%mesh, nodal => results%nodal)
         allocate (weight(n_elements(mesh)), weight_sum(size(nodal%node)))
         weight_sum = 0.0_wp
         do element = 1, n_elements(mesh)
            n = mesh%element_size(element)
            weight(element) = 1.0_wp/area(mesh, element)
            associate (values => nodal%value_of(:n, element))
               weight_sum(values) = weight_sum(values) + weight(element)
            end associate
         end do
         allocate (nodal%amplitude(6, size(nodal%node), size(results%modes)))
         own = own_modes(equations)
         !$omp parallel do schedule(dynamic) if (worth_threads(equations))
         do k = own(1), own(2)
            call smooth_mode(model, results, k, weight, weight_sum, nodal%amplitude(:, :, k))
         end do
         !$omp end parallel do
         call equations%team%gather(nodal%amplitude, size(nodal%amplitude, kind=i8), &
                                    equations%last_mode)
      end associate
   end subroutine smooth_stress

   !> Stresses of one mode at the nodes
   subroutine smooth_mode(model, results, k, weight, weight_sum, amplitude)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      class(fields_type), intent(in) :: results
      !> Place of the mode
      integer, intent(in) :: k
      !> Weight of each element, and their sum for each value
      real(wp), intent(in) :: weight(:), weight_sum(:)
      !> Amplitudes, shape (6, values)
      real(wp), intent(out) :: amplitude(:, :)

      type(reference_type), allocatable :: references(:)
      real(wp) :: matrix(max_element_nodes, max_element_points)
      logical, allocatable :: pole(:)
      integer :: element, n, n_points, last, i, kind, before

      references = element_references(model%mesh)
      amplitude = 0.0_wp
      allocate (pole, source=on_axis(model%mesh))
      last = 0
      before = 0
      do element = 1, n_elements(model%mesh)
         n = model%mesh%element_size(element)
         kind = model%mesh%element_kind(element)
         n_points = references(kind)%n_points
         if (kind /= before) matrix(:n, :n_points) = extrapolation_matrix(n, &
            references(kind)%position(:, :n_points), references(kind)%weight(:n_points))
         before = kind
         associate (values => results%nodal%value_of(:n, element), &
                    nodes => model%mesh%element_nodes(:n, element))
            do i = 1, n
               amplitude(:, values(i)) = amplitude(:, values(i)) &
                  + weight(element)/weight_sum(values(i))*stress_at_node(matrix(i, :n_points), &
                  results%stress(:, last + 1:last + n_points, k), results%modes(k)%harmonic, pole(nodes(i)))
            end do
         end associate
         last = last + n_points
      end do
   end subroutine smooth_mode

   !> Stress of an element at one of its nodes, by a smooth function fitted to that at its points
   pure function stress_at_node(factor, stress, harmonic, pole) result(at_node)
      !> What it takes of each point
      real(wp), intent(in) :: factor(:)
      !> Amplitudes at the points, shape (6, points)
      real(wp), intent(in) :: stress(:, :)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Whether the node is on the axis
      logical, intent(in) :: pole
      !> Amplitudes
      real(wp) :: at_node(6)

      integer :: p

      at_node = 0.0_wp
      do p = 1, size(factor)
         at_node = at_node + factor(p)*stress(:, p)
      end do
      if (pole) at_node = pole_stress(harmonic, at_node)
   end function stress_at_node

   !> Stress on the axis that is nearest to a given one and has one value there,
   !> whatever the angle: a scalar sigma_r = sigma_theta and sigma_z in harmonic 0,
   !> a vector (tau_rz, tau_ztheta) in harmonic 1, a plane tensor of zero trace in
   !> harmonic 2, nothing in higher ones
   pure function pole_stress(harmonic, stress) result(at_pole)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Amplitudes of r, z, theta, rz, r-theta, z-theta
      real(wp), intent(in) :: stress(6)
      !> The same on the axis
      real(wp) :: at_pole(6)

      at_pole = 0.0_wp
      select case (harmonic)
      case (0)
         at_pole([1, 3]) = 0.5_wp*(stress(1) + stress(3))
         at_pole(2) = stress(2)
      case (1)
         at_pole([4, 6]) = 0.5_wp*(stress(4) - stress(6))*[1.0_wp, -1.0_wp]
      case (2)
         at_pole([1, 3, 5]) = 0.25_wp*(stress(1) - stress(3) - 2.0_wp*stress(5)) &
                              *[1.0_wp, -1.0_wp, -1.0_wp]
      end select
   end function pole_stress

   !> Give each pair of a node and a material that meet in an element a number
   subroutine number_values(mesh, nodal)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Takes nodes and materials of the values, and the values of the elements
      type(nodal_stress_type), intent(out) :: nodal

      integer, allocatable :: first(:), next(:), material(:), number(:)
      integer :: element, node, i, n, value, count

      n = sum(mesh%element_size)
      allocate (first(n_nodes(mesh)), next(n), material(n), source=0)
      allocate (nodal%value_of(max_element_nodes, n_elements(mesh)), source=0)
      count = 0
      do element = 1, n_elements(mesh)
         do i = 1, mesh%element_size(element)
            call find(first(mesh%element_nodes(i, element)), mesh%element_material(element))
            nodal%value_of(i, element) = value
         end do
      end do
      allocate (number(0:count), nodal%node(count), nodal%material(count), source=0)
      n = 0
      do node = 1, size(first)
         value = first(node)
         do while (value > 0)
            n = n + 1
            number(value) = n
            nodal%node(n) = node
            nodal%material(n) = material(value)
            value = next(value)
         end do
      end do
      do element = 1, n_elements(mesh)
         nodal%value_of(:, element) = number(nodal%value_of(:, element))
      end do

   contains

      !> Set `value` to that of a material in the list of a node, ascending by
      !> materials; make it if it is not there
      recursive subroutine find(start, wanted)
         !> Value that the rest of the list begins with; 0 at its end
         integer, intent(inout) :: start
         !> The material
         integer, intent(in) :: wanted

         if (start > 0) then
            if (material(start) == wanted) then
               value = start
               return
            else if (material(start) < wanted) then
               call find(next(start), wanted)
               return
            end if
         end if
         count = count + 1
         next(count) = start
         material(count) = wanted
         start = count
         value = count
      end subroutine find

   end subroutine number_values

   !> Area of an element between straight lines from corner to corner
   pure function area(mesh, element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> The area
      real(wp) :: area

      integer :: i, n

      n = n_corners(mesh%element_size(element))
      area = 0.0_wp
      associate (x => mesh%coordinates(:, mesh%element_nodes(:n, element)))
         do i = 2, n - 1
            area = area + 0.5_wp*((x(1, i) - x(1, 1))*(x(2, i + 1) - x(2, 1)) &
                                  - (x(1, i + 1) - x(1, 1))*(x(2, i) - x(2, 1)))
         end do
      end associate
   end function area

end module axijoint_analysis_core_nodal_stress
