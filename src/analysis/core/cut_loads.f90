!> Distributed loads on elements that a cut passes through. Nodal forces put such a
!> load on nodes above and below the cut, whatever part of it acts above
module axijoint_analysis_core_cut_loads
   use axijoint_analysis_core_fields, only : n_resultants
   use axijoint_analysis_core_rigid, only : rigid_resultants
   use axijoint_analysis_core_split, only : line_split_type, split_line, area_split_type, &
      split_element
   use axijoint_assembly_support, only : support_point_type, support_stiffness
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : joint_point_type, new_joint_point, jump_matrix, lower_node, &
                                      upper_node
   use axijoint_element_solid_point, only : solid_point_type, solid_points
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_fe_quadrature, only : gauss_rule, max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_fe_shape, only : shape_line
   use axijoint_model_joint_points, only : joint_rule
   use axijoint_model_load, only : edge_load_type, edge_support_type, body_load_type
   use axijoint_model_mesh, only : n_elements, n_joints, max_element_nodes, element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: plane_type, edge_load_excess, spring_excess, joint_excess, mass_excess, resultants_above

   !> A cut and the nodes on both sides of it
   type :: plane_type
      !> r of each node and its height above the cut, shape (2, nodes)
      real(wp), allocatable :: position(:, :)
      !> Whether each node is above the cut, and whether it belongs to what is cut
      logical, allocatable :: above(:), cut(:)
      !> Elements of what is cut that the cut passes through
      integer, allocatable :: crossed(:)
   end type plane_type

contains

   !> Resultants of edge loads on nodes above the cut, less those of what acts there
   pure function edge_load_excess(model, plane, mode, case_factor) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Factor of each load case
      real(wp), intent(in) :: case_factor(:)
      !> The resultants
      real(wp) :: excess(n_resultants)

      type(line_split_type) :: split
      real(wp) :: x(3), w(3), whole(3, 3), part(3, 3, 2)
      integer :: k, i, n

      excess = 0.0_wp
      call gauss_rule(3, x, w)
      do k = 1, size(model%edge_loads)
         associate (load => model%edge_loads(k))
            if (.not. same_mode(load%mode, mode)) cycle
            n = count(load%nodes > 0)
            associate (nodes => load%nodes(:n))
               if (.not. is_cut(plane, nodes)) cycle
               split = split_line(plane%position(2, nodes))
               whole = 0.0_wp
               part = 0.0_wp
               do i = 1, 3
                  whole = whole + point_force(load, plane%position(:, nodes), x(i), w(i))
               end do
               do i = 1, split%n
                  associate (side => split%side(i))
                     part(:, :, side) = part(:, :, side) &
                        + point_force(load, plane%position(:, nodes), split%x(i), split%w(i))
                  end associate
               end do
               excess = excess + case_factor(load%case) &
                  *excess_of(plane, mode, nodes, whole(:, :n), part(:, :n, :), share_above(split))
            end associate
         end associate
      end do
   end function edge_load_excess

   !> Nodal forces of the traction at one point of an edge
   pure function point_force(load, coordinates, x, w) result(force)
      !> The load
      type(edge_load_type), intent(in) :: load
      !> r and height of its nodes
      real(wp), intent(in) :: coordinates(:, :)
      !> Natural coordinate and weight of the point
      real(wp), intent(in) :: x, w
      !> Forces, shape (3, 3)
      real(wp) :: force(3, 3)

      real(wp), dimension(size(coordinates, 2)) :: shape, derivative
      real(wp) :: weight
      integer :: n, i

      n = size(shape)
      call shape_line(n, x, shape, derivative)
      weight = w*circle_integral(load%mode%harmonic)*dot_product(coordinates(1, :), shape) &
               *norm2(matmul(coordinates, derivative))
      force = 0.0_wp
      do i = 1, n
         force(:, i) = weight*shape(i)*matmul(load%traction(:, :n), shape)
      end do
   end function point_force

   !> The same of springs
   pure function spring_excess(model, plane, mode, displacement) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> The resultants
      real(wp) :: excess(n_resultants)

      type(line_split_type) :: split
      real(wp) :: x(3), w(3), whole(3, 3), part(3, 3, 2)
      integer :: k, i, n

      excess = 0.0_wp
      do k = 1, size(model%edge_supports)
         associate (support => model%edge_supports(k))
            n = count(support%nodes > 0)
            associate (nodes => support%nodes(:n))
               if (.not. is_cut(plane, nodes)) cycle
               split = split_line(plane%position(2, nodes))
               call gauss_rule(n, x, w)
               whole = 0.0_wp
               part = 0.0_wp
               do i = 1, n
                  whole(:, :n) = whole(:, :n) + spring_force(support, plane%position(:, nodes), &
                     x(i), w(i), mode, displacement(:, nodes))
               end do
               do i = 1, split%n
                  associate (side => split%side(i))
                     part(:, :n, side) = part(:, :n, side) + spring_force(support, &
                        plane%position(:, nodes), split%x(i), split%w(i), mode, &
                        displacement(:, nodes))
                  end associate
               end do
               excess = excess &
                  + excess_of(plane, mode, nodes, whole(:, :n), part(:, :n, :), share_above(split))
            end associate
         end associate
      end do
   end function spring_excess

   !> Nodal forces of springs on the body at one point of an edge
   pure function spring_force(support, coordinates, x, w, mode, displacement) result(force)
      !> The springs
      type(edge_support_type), intent(in) :: support
      !> r and height of the nodes
      real(wp), intent(in) :: coordinates(:, :)
      !> Natural coordinate and weight of the point
      real(wp), intent(in) :: x, w
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Displacement amplitudes of the nodes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Forces, same shape
      real(wp) :: force(3, size(displacement, 2))

      type(support_point_type) :: point
      real(wp), dimension(size(displacement), size(displacement)) :: stiffness

      point%joint_point_type = new_joint_point(coordinates, x, w)
      point%stiffness = support%stiffness([2, 1, 3])
      call support_stiffness(point, stiffness)
      force = -circle_integral(mode%harmonic) &
              *reshape(matmul(stiffness, reshape(displacement, [size(displacement)])), shape(force))
   end function spring_force

   !> The same of joints between what is cut and what is not
   pure function joint_excess(model, plane, mode, stress) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Amplitudes of tau_xi, sigma, tau_theta at the joint points, shape (3, points)
      real(wp), intent(in) :: stress(:, :)
      !> The resultants
      real(wp) :: excess(n_resultants)

      type(line_split_type) :: split
      real(wp) :: x(3), w(3), whole(3, 3), part(3, 3, 2)
      integer :: joint, i, n, n_points, last, side_node(3), nodes(3)
      logical :: upper_cut

      excess = 0.0_wp
      last = 0
      do joint = 1, n_joints(model%mesh)
         n = model%mesh%joint_size(joint)/2
         call joint_rule(model%joint_materials(model%mesh%joint_material(joint))%rule, n, &
            n_points, x, w)
         last = last + n_points
         associate (all_nodes => model%mesh%joint_nodes(:, joint), &
                    at_points => stress(:, last - n_points + 1:last))
            upper_cut = all(plane%cut(all_nodes([4, 3])))
            if (all(plane%cut(all_nodes([1, 2]))) .eqv. upper_cut) cycle  ! the sides cancel
            side_node = merge(upper_node, lower_node, upper_cut)
            nodes(:n) = all_nodes(side_node(:n))
            if (.not. is_cut(plane, nodes(:n))) cycle
            split = split_line(plane%position(2, nodes(:n)))
            whole = 0.0_wp
            part = 0.0_wp
            do i = 1, n_points
               whole(:, :n) = whole(:, :n) + joint_side_force(plane%position(:, nodes(:n)), x(i), &
                  w(i), side_node(:n), mode, at_points(:, i))
            end do
            do i = 1, split%n
               associate (side => split%side(i))
                  part(:, :n, side) = part(:, :n, side) + joint_side_force( &
                     plane%position(:, nodes(:n)), split%x(i), split%w(i), side_node(:n), mode, &
                     interpolated(at_points, x(:n_points), split%x(i)))
               end associate
            end do
         end associate
         excess = excess &
            + excess_of(plane, mode, nodes(:n), whole(:, :n), part(:, :n, :), share_above(split))
      end do
   end function joint_excess

   !> Nodal forces of a joint on one of its sides at one point
   pure function joint_side_force(coordinates, x, w, side_node, mode, stress) result(force)
      !> r and height of the nodes of the side
      real(wp), intent(in) :: coordinates(:, :)
      !> Natural coordinate and weight of the point
      real(wp), intent(in) :: x, w
      !> Numbers of the nodes of the side within the joint
      integer, intent(in) :: side_node(:)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Amplitudes of tau_xi, sigma, tau_theta
      real(wp), intent(in) :: stress(3)
      !> Forces, shape (3, nodes of the side)
      real(wp) :: force(3, size(side_node))

      type(joint_point_type) :: point
      real(wp) :: matrix(3, 18)
      integer :: i

      point = new_joint_point(coordinates, x, w)
      call jump_matrix(point, matrix(:, :6*size(side_node)))
      do i = 1, size(side_node)
         associate (columns => matrix(:, 3*side_node(i) - 2:3*side_node(i)))
            force(:, i) = -circle_integral(mode%harmonic)*point%weight*matmul(stress, columns)
         end associate
      end do
   end function joint_side_force

   !> Values at points along a line, interpolated by the polynomial through them
   pure function interpolated(values, at, x) result(value)
      !> The values, shape (3, points)
      real(wp), intent(in) :: values(:, :)
      !> Natural coordinates of the points
      real(wp), intent(in) :: at(:)
      !> Where
      real(wp), intent(in) :: x
      !> The value
      real(wp) :: value(3)

      real(wp) :: factor
      integer :: i, k

      value = 0.0_wp
      do i = 1, size(at)
         factor = 1.0_wp
         do k = 1, size(at)
            if (k /= i) factor = factor*(x - at(k))/(at(i) - at(k))
         end do
         value = value + factor*values(:, i)
      end do
   end function interpolated

   !> The same of forces on the mass
   pure function mass_excess(model, plane, mode, case_factor) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Factor of each load case
      real(wp), intent(in) :: case_factor(:)
      !> The resultants
      real(wp) :: excess(n_resultants)

      type(reference_type), allocatable :: references(:)
      integer :: k, element, n

      excess = 0.0_wp
      references = element_references(model%mesh)
      do k = 1, size(model%body_loads)
         associate (load => model%body_loads(k))
            if (.not. same_mode(load%mode, mode)) cycle
            do element = 1, n_elements(model%mesh)
               n = model%mesh%element_size(element)
               associate (nodes => model%mesh%element_nodes(:n, element), &
                          density => model%materials(model%mesh%element_material(element))%density)
                  if (.not. is_cut(plane, nodes)) cycle
                  excess = excess + case_factor(load%case)*density &
                     *element_mass_excess(plane, mode, load, &
                     references(model%mesh%element_kind(element)), nodes)
               end associate
            end do
         end associate
      end do
   end function mass_excess

   !> The same of one element of unit density
   pure function element_mass_excess(plane, mode, load, reference, nodes) result(excess)
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The load
      type(body_load_type), intent(in) :: load
      !> The element in natural coordinates
      type(reference_type), intent(in) :: reference
      !> Its nodes
      integer, intent(in) :: nodes(:)
      !> The resultants
      real(wp) :: excess(n_resultants)

      type(solid_point_type) :: points(max_element_points)
      type(area_split_type) :: split
      real(wp) :: whole(3, max_element_nodes), part(n_resultants, 2), area(2), of_all(n_resultants)
      real(wp) :: weight
      integer :: i, k

      call solid_points(plane%position(:, nodes), reference, points(:reference%n_points))
      whole = 0.0_wp
      do k = 1, reference%n_points
         do i = 1, size(nodes)
            whole(:, i) = whole(:, i) + circle_integral(mode%harmonic)*points(k)%weight &
                          *points(k)%shape(i)*acceleration(load, points(k)%position(1))
         end do
      end do
      split = split_element(plane%position(:, nodes))
      part = 0.0_wp
      area = 0.0_wp
      do k = 1, split%n
         associate (position => split%position(:, k), side => split%side(k))
            weight = circle_integral(mode%harmonic)*split%weight(k)*position(1)
            area(side) = area(side) + split%weight(k)
            part(:, side) = part(:, side) + rigid_resultants(split%position(:, k:k), mode, &
               weight*reshape(acceleration(load, position(1)), [3, 1]))
         end associate
      end do
      of_all = rigid_resultants(plane%position(:, nodes), mode, whole(:, :size(nodes)))
      excess = resultants_above(plane, mode, nodes, whole(:, :size(nodes))) &
               - (part(:, 1) + area(1)/sum(area)*(of_all - sum(part, 2)))
   end function element_mass_excess

   !> Acceleration of a load at a radius
   pure function acceleration(load, r)
      !> The load
      type(body_load_type), intent(in) :: load
      !> r
      real(wp), intent(in) :: r
      !> Amplitudes along r, z, theta
      real(wp) :: acceleration(3)

      acceleration = load%acceleration
      acceleration(1) = acceleration(1) + load%spin_squared*r
   end function acceleration

   !> Whether a cut passes between some nodes that belong to what is cut
   pure logical function is_cut(plane, nodes)
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The nodes
      integer, intent(in) :: nodes(:)

      is_cut = all(plane%cut(nodes)) .and. any(plane%above(nodes)) &
         .and. .not. all(plane%above(nodes))
   end function is_cut

   !> Share of a line that is above
   pure real(wp) function share_above(split)
      !> The line
      type(line_split_type), intent(in) :: split

      share_above = 0.5_wp*sum(split%w(:split%n), mask=split%side(:split%n) == 1)
   end function share_above

   !> Resultants of nodal forces above the cut, less those of what acts there. If the
   !> forces come from a rule that does not integrate the load exactly, the difference
   !> is shared by both sides, so that no load is lost
   pure function excess_of(plane, mode, nodes, whole, part, share) result(excess)
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Nodes that the load acts on
      integer, intent(in) :: nodes(:)
      !> Their forces, shape (3, nodes)
      real(wp), intent(in) :: whole(:, :)
      !> Forces of what acts above and of what acts below, shape (3, nodes, 2)
      real(wp), intent(in) :: part(:, :, :)
      !> Share of the difference that goes to what is above
      real(wp), intent(in) :: share
      !> The resultants
      real(wp) :: excess(n_resultants)

      excess = resultants_above(plane, mode, nodes, whole) &
               - rigid_resultants(plane%position(:, nodes), mode, &
                                  part(:, :, 1) + share*(whole - sum(part, 3)))
   end function excess_of

   !> Resultants of forces on those of some nodes that are above the cut
   pure function resultants_above(plane, mode, nodes, force) result(resultant)
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The nodes
      integer, intent(in) :: nodes(:)
      !> Forces on them, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> The resultants
      real(wp) :: resultant(n_resultants)

      resultant = rigid_resultants(plane%position(:, nodes), mode, &
                                   merge(force, 0.0_wp, spread(plane%above(nodes), 1, 3)))
   end function resultants_above

end module axijoint_analysis_core_cut_loads
