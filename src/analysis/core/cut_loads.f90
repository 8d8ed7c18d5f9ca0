!> Distributed loads on elements that a cut passes through. Nodal forces put such a
!> load on nodes above and below the cut, whatever part of it acts above
module axijoint_analysis_core_cut_loads
   use axijoint_analysis_core_cut_planes, only : plane_type, new_planes_of_cuts, from_cut, is_above
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
   use axijoint_model_mesh, only : max_element_nodes, element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: loaded_plane_type, new_loaded_planes, edge_load_excess, spring_excess, joint_excess, mass_excess, &
      resultants_above

   !> A cut, with resultants of what nodal forces of loads count above it too much, which no displacement changes
   type, extends(plane_type) :: loaded_plane_type
      !> Of loads on edges with a factor of one, shape (n_resultants, edges that it passes through)
      real(wp), allocatable :: edge_excess(:, :)
      !> Of forces on the mass of unit density with a factor of one, shape (n_resultants, elements that it passes through,
      !> body loads)
      real(wp), allocatable :: mass_excess(:, :, :)
   end type loaded_plane_type

contains

   !> Cuts of a job, ready for any state of it
   function new_loaded_planes(model) result(loaded)
      !> The job
      type(model_type), intent(in) :: model
      !> One a cut
      type(loaded_plane_type), allocatable :: loaded(:)

      type(reference_type), allocatable :: references(:)
      type(plane_type), allocatable :: planes(:)
      integer :: c, i, k

      planes = new_planes_of_cuts(model)
      references = element_references(model%mesh)
      allocate (loaded(size(planes)))
      do c = 1, size(planes)
         associate (plane => loaded(c))
            plane%plane_type = planes(c)
            allocate (plane%edge_excess(n_resultants, size(plane%edges)))
            do i = 1, size(plane%edges)
               plane%edge_excess(:, i) = unit_edge_excess(model, plane%plane_type, model%edge_loads(plane%edges(i)))
            end do
            allocate (plane%mass_excess(n_resultants, size(plane%massive), size(model%body_loads)))
            do k = 1, size(model%body_loads)
               do i = 1, size(plane%massive)
                  plane%mass_excess(:, i, k) = element_mass_excess(model, plane%plane_type, model%body_loads(k), &
                     references(model%mesh%element_kind(plane%massive(i))), plane%massive(i))
               end do
            end do
         end associate
      end do
   end function new_loaded_planes

   !> Resultants of edge loads on nodes above the cut, less those of what acts there
   pure function edge_load_excess(model, plane, mode, case_factor) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(loaded_plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Factor of each load case
      real(wp), intent(in) :: case_factor(:)
      !> The resultants
      real(wp) :: excess(n_resultants)

      integer :: i

      excess = 0.0_wp
      do i = 1, size(plane%edges)
         associate (load => model%edge_loads(plane%edges(i)))
            if (same_mode(load%mode, mode)) excess = excess + case_factor(load%case)*plane%edge_excess(:, i)
         end associate
      end do
   end function edge_load_excess

   !> The same of one load with a factor of one
   pure function unit_edge_excess(model, plane, load) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The load
      type(edge_load_type), intent(in) :: load
      !> The resultants
      real(wp) :: excess(n_resultants)

      type(line_split_type) :: split
      real(wp) :: x(3), w(3), whole(3, 3), part(3, 3, 2), position(2, 3)
      integer :: i, n

      n = count(load%nodes > 0)
      position(:, :n) = from_cut(plane, model%mesh, load%nodes(:n))
      call gauss_rule(3, x, w)
      split = split_line(position(2, :n))
      whole = 0.0_wp
      part = 0.0_wp
      do i = 1, 3
         whole = whole + point_force(load, position(:, :n), x(i), w(i))
      end do
      do i = 1, split%n
         associate (side => split%side(i))
            part(:, :, side) = part(:, :, side) + point_force(load, position(:, :n), split%x(i), split%w(i))
         end associate
      end do
      excess = excess_of(plane, load%mode, position(:, :n), whole(:, :n), part(:, :n, :), share_above(split))
   end function unit_edge_excess

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

   !> The same of springs, mode by mode
   pure function spring_excess(model, plane, modes, displacement) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The resultants, shape (n_resultants, modes)
      real(wp) :: excess(n_resultants, size(modes))

      type(line_split_type) :: split
      real(wp), dimension(3, 3, size(modes)) :: whole, above, below
      real(wp) :: x(3), w(3), position(2, 3)
      integer :: s, i, n

      excess = 0.0_wp
      do s = 1, size(plane%springs)
         associate (support => model%edge_supports(plane%springs(s)))
            n = count(support%nodes > 0)
            position(:, :n) = from_cut(plane, model%mesh, support%nodes(:n))
            split = split_line(position(2, :n))
            call gauss_rule(n, x, w)
            whole = 0.0_wp
            above = 0.0_wp
            below = 0.0_wp
            do i = 1, n
               call add_spring_force(support, position(:, :n), x(i), w(i), modes, displacement, whole)
            end do
            do i = 1, split%n
               if (split%side(i) == 1) then
                  call add_spring_force(support, position(:, :n), split%x(i), split%w(i), modes, displacement, above)
               else
                  call add_spring_force(support, position(:, :n), split%x(i), split%w(i), modes, displacement, below)
               end if
            end do
         end associate
         call add_excess(plane, modes, position(:, :n), whole, above, below, share_above(split), excess)
      end do
   end function spring_excess

   !> Add the nodal forces of springs on the body at one point of an edge
   pure subroutine add_spring_force(support, coordinates, x, w, modes, displacement, force)
      !> The springs
      type(edge_support_type), intent(in) :: support
      !> r and height of the nodes
      real(wp), intent(in) :: coordinates(:, :)
      !> Natural coordinate and weight of the point
      real(wp), intent(in) :: x, w
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Forces, shape (3, nodes of an edge, modes)
      real(wp), intent(inout) :: force(:, :, :)

      type(support_point_type) :: point
      real(wp) :: stiffness(3*size(coordinates, 2), 3*size(coordinates, 2)), moved(3*size(coordinates, 2))
      integer :: i, k, n

      n = size(coordinates, 2)
      point%joint_point_type = new_joint_point(coordinates, x, w)
      point%stiffness = support%stiffness([2, 1, 3])
      call support_stiffness(point, stiffness)
      do k = 1, size(modes)
         do i = 1, n
            moved(3*i - 2:3*i) = displacement(:, support%nodes(i), k)
         end do
         force(:, :n, k) = force(:, :n, k) - circle_integral(modes(k)%harmonic)*reshape(matmul(stiffness, moved), [3, n])
      end do
   end subroutine add_spring_force

   !> The same of joints between what is cut and what is not, mode by mode
   pure function joint_excess(model, plane, modes, first, stress) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> First point of each joint
      integer, intent(in) :: first(:)
      !> Amplitudes of tau_xi, sigma, tau_theta at the joint points, shape (3, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> The resultants, shape (n_resultants, modes)
      real(wp) :: excess(n_resultants, size(modes))

      type(line_split_type) :: split
      real(wp), dimension(3, 3, size(modes)) :: whole, above, below
      real(wp) :: x(3), w(3), position(2, 3), share(3)
      integer :: i, j, n, n_points, side_node(3)

      excess = 0.0_wp
      do j = 1, size(plane%joints)
         associate (joint => plane%joints(j))
            n = model%mesh%joint_size(joint)/2
            call joint_rule(model%joint_materials(model%mesh%joint_material(joint))%rule, n, &
               n_points, x, w)
            side_node = merge(upper_node, lower_node, plane%upper(j))
            position(:, :n) = from_cut(plane, model%mesh, model%mesh%joint_nodes(side_node(:n), joint))
            split = split_line(position(2, :n))
            whole = 0.0_wp
            above = 0.0_wp
            below = 0.0_wp
            associate (at_points => stress(:, first(joint):first(joint) + n_points - 1, :))
               do i = 1, n_points
                  call add_side_force(position(:, :n), x(i), w(i), side_node(:n), modes, at_points(:, i:i, :), [1.0_wp], whole)
               end do
               do i = 1, split%n
                  call interpolate(x(:n_points), split%x(i), share(:n_points))
                  if (split%side(i) == 1) then
                     call add_side_force(position(:, :n), split%x(i), split%w(i), side_node(:n), modes, at_points, &
                        share(:n_points), above)
                  else
                     call add_side_force(position(:, :n), split%x(i), split%w(i), side_node(:n), modes, at_points, &
                        share(:n_points), below)
                  end if
               end do
            end associate
         end associate
         call add_excess(plane, modes, position(:, :n), whole, above, below, share_above(split), excess)
      end do
   end function joint_excess

   !> Add the nodal forces of a joint on one of its sides at one point
   pure subroutine add_side_force(coordinates, x, w, side_node, modes, stress, share, force)
      !> r and height of the nodes of the side
      real(wp), intent(in) :: coordinates(:, :)
      !> Natural coordinate and weight of the point
      real(wp), intent(in) :: x, w
      !> Numbers of the nodes of the side within the joint
      integer, intent(in) :: side_node(:)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes of tau_xi, sigma, tau_theta, shape (3, points, modes), and the share of each point
      real(wp), intent(in) :: stress(:, :, :), share(:)
      !> Forces, shape (3, nodes of an edge, modes)
      real(wp), intent(inout) :: force(:, :, :)

      type(joint_point_type) :: point
      real(wp) :: matrix(3, 18), here(3), weight
      integer :: i, j, k, last

      point = new_joint_point(coordinates, x, w)
      call jump_matrix(point, matrix(:, :6*size(side_node)))
      do k = 1, size(modes)
         weight = circle_integral(modes(k)%harmonic)*point%weight
         here = 0.0_wp
         do i = 1, size(share)
            here = here + share(i)*stress(:, i, k)
         end do
         do i = 1, size(side_node)
            last = 3*side_node(i) - 3
            do j = 1, 3
               force(j, i, k) = force(j, i, k) &
                  - weight*(here(1)*matrix(1, last + j) + here(2)*matrix(2, last + j) + here(3)*matrix(3, last + j))
            end do
         end do
      end do
   end subroutine add_side_force

   !> Shares of the values at points along a line in that of the polynomial through them
   pure subroutine interpolate(at, x, share)
      !> Natural coordinates of the points
      real(wp), intent(in) :: at(:)
      !> Where
      real(wp), intent(in) :: x
      !> The shares
      real(wp), intent(out) :: share(:)

      integer :: i, k

      do i = 1, size(at)
         share(i) = 1.0_wp
         do k = 1, size(at)
            if (k /= i) share(i) = share(i)*(x - at(k))/(at(i) - at(k))
         end do
      end do
   end subroutine interpolate

   !> The same of forces on the mass
   pure function mass_excess(model, plane, mode, case_factor) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(loaded_plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Factor of each load case
      real(wp), intent(in) :: case_factor(:)
      !> The resultants
      real(wp) :: excess(n_resultants)

      integer :: i, k

      excess = 0.0_wp
      do k = 1, size(model%body_loads)
         associate (load => model%body_loads(k))
            if (.not. same_mode(load%mode, mode)) cycle
            do i = 1, size(plane%massive)
               excess = excess + case_factor(load%case) &
                  *model%materials(model%mesh%element_material(plane%massive(i)))%density*plane%mass_excess(:, i, k)
            end do
         end associate
      end do
   end function mass_excess

   !> The same of one element of unit density
   pure function element_mass_excess(model, plane, load, reference, element) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The load
      type(body_load_type), intent(in) :: load
      !> The element in natural coordinates
      type(reference_type), intent(in) :: reference
      !> The element
      integer, intent(in) :: element
      !> The resultants
      real(wp) :: excess(n_resultants)

      type(solid_point_type) :: points(max_element_points)
      type(area_split_type) :: split
      real(wp) :: whole(3, max_element_nodes), part(n_resultants, 2), area(2), of_all(n_resultants)
      real(wp) :: weight, place(2, max_element_nodes)
      integer :: i, k, n

      n = reference%n_nodes
      place(:, :n) = from_cut(plane, model%mesh, model%mesh%element_nodes(:n, element))
      call solid_points(place(:, :n), reference, points(:reference%n_points))
      whole = 0.0_wp
      do k = 1, reference%n_points
         do i = 1, n
            whole(:, i) = whole(:, i) + circle_integral(load%mode%harmonic)*points(k)%weight &
                          *points(k)%shape(i)*acceleration(load, points(k)%position(1))
         end do
      end do
      split = split_element(place(:, :n))
      part = 0.0_wp
      area = 0.0_wp
      do k = 1, split%n
         associate (position => split%position(:, k), side => split%side(k))
            weight = circle_integral(load%mode%harmonic)*split%weight(k)*position(1)
            area(side) = area(side) + split%weight(k)
            part(:, side) = part(:, side) + rigid_resultants(split%position(:, k:k), load%mode, &
               weight*reshape(acceleration(load, position(1)), [3, 1]))
         end associate
      end do
      of_all = rigid_resultants(place(:, :n), load%mode, whole(:, :n))
      excess = resultants_above(plane, load%mode, place(:, :n), whole(:, :n)) &
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

   !> Share of a line that is above
   pure real(wp) function share_above(split)
      !> The line
      type(line_split_type), intent(in) :: split

      share_above = 0.5_wp*sum(split%w(:split%n), mask=split%side(:split%n) == 1)
   end function share_above

   !> Add the resultants of nodal forces above the cut, less those of what acts there, mode by mode
   pure subroutine add_excess(plane, modes, position, whole, above, below, share, excess)
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> r of the nodes that the load acts on and their height over the cut
      real(wp), intent(in) :: position(:, :)
      !> Their forces, those of what acts above and of what acts below, shape (3, nodes of an edge, modes)
      real(wp), intent(in), dimension(:, :, :) :: whole, above, below
      !> Share of the difference that goes to what is above
      real(wp), intent(in) :: share
      !> The resultants, shape (n_resultants, modes)
      real(wp), intent(inout) :: excess(:, :)

      real(wp) :: part(3, size(position, 2), 2)
      integer :: k

      do k = 1, size(modes)
         part(:, :, 1) = above(:, :size(position, 2), k)
         part(:, :, 2) = below(:, :size(position, 2), k)
         excess(:, k) = excess(:, k) + excess_of(plane, modes(k), position, whole(:, :size(position, 2), k), part, share)
      end do
   end subroutine add_excess

   !> Resultants of nodal forces above the cut, less those of what acts there. If the
   !> forces come from a rule that does not integrate the load exactly, the difference
   !> is shared by both sides, so that no load is lost
   pure function excess_of(plane, mode, position, whole, part, share) result(excess)
      !> The cut
      type(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> r of the nodes that the load acts on and their height over the cut, shape (2, nodes)
      real(wp), intent(in) :: position(:, :)
      !> Their forces, shape (3, nodes)
      real(wp), intent(in) :: whole(:, :)
      !> Forces of what acts above and of what acts below, shape (3, nodes, 2)
      real(wp), intent(in) :: part(:, :, :)
      !> Share of the difference that goes to what is above
      real(wp), intent(in) :: share
      !> The resultants
      real(wp) :: excess(n_resultants)

      excess = resultants_above(plane, mode, position, whole) &
               - rigid_resultants(position, mode, part(:, :, 1) + share*(whole - sum(part, 3)))
   end function excess_of

   !> Resultants of forces on those of some nodes that are above the cut
   pure function resultants_above(plane, mode, position, force) result(resultant)
      !> The cut
      class(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> r of the nodes and their height over the cut, shape (2, nodes)
      real(wp), intent(in) :: position(:, :)
      !> Forces on them, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> The resultants
      real(wp) :: resultant(n_resultants)

      real(wp) :: counted(3, size(force, 2))
      integer :: i

      do i = 1, size(force, 2)
         counted(:, i) = merge(force(:, i), 0.0_wp, is_above(plane, position(2, i)))
      end do
      resultant = rigid_resultants(position, mode, counted)
   end function resultants_above

end module axijoint_analysis_core_cut_loads
