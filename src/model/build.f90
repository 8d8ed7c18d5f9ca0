!> Bodies, joints, supports and loads of a job, added one after the other
module axijoint_model_build
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_element_joint_law, only : joint_law_type
   use axijoint_fe_element_kind, only : kind_choice_type, chosen_kind, find_kind
   use axijoint_fe_mode, only : mode_type
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_interface, only : interface_type
   use axijoint_model_load, only : edge_load_type
   use axijoint_model_material, only : solid_material_type, joint_material_type, rule_gauss
   use axijoint_model_mesh, only : max_element_nodes, edge_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: add_material, add_law, add_block, add_rectangle, add_interface, hold_edges, &
      add_traction
   public :: node_at, place_function, traction_function

   !> Two nodes nearer than this, relative to the extent of the mesh, are at the same place
   real(wp), parameter :: same_place = 1.0e-10_wp

   abstract interface
      !> Image of a point of the unit square
      function place_function(x, y) result(place)
         import :: wp
         !> Point of the unit square
         real(wp), intent(in) :: x, y
         !> r and z
         real(wp) :: place(2)
      end function place_function

      !> Traction at a place
      function traction_function(position) result(traction)
         import :: wp
         !> r and z
         real(wp), intent(in) :: position(2)
         !> Amplitudes of t_r, t_z, t_theta
         real(wp) :: traction(3)
      end function traction_function
   end interface

   !> Put a traction on the outer edges along a straight line
   interface add_traction
      module procedure add_uniform_traction
      module procedure add_varying_traction
   end interface add_traction

contains

   !> Add a material of solids; materials are numbered from 1
   subroutine add_material(model, material)
      !> The job
      type(model_type), intent(inout) :: model
      !> The material; its number is given here
      type(solid_material_type), intent(in) :: material

      model%materials = [model%materials, material]
      model%materials(size(model%materials))%label = size(model%materials)
   end subroutine add_material

   !> Add a law of joints; laws are numbered from 1
   subroutine add_law(model, law, rule)
      !> The job
      type(model_type), intent(inout) :: model
      !> The law
      type(joint_law_type), intent(in) :: law
      !> Integration rule, one of the `rule_` parameters; Gauss if left out
      integer, intent(in), optional :: rule

      type(joint_material_type) :: material

      material = joint_material_type(size(model%joint_materials) + 1, rule_gauss, law)
      if (present(rule)) material%rule = rule
      model%joint_materials = [model%joint_materials, material]
   end subroutine add_law

   !> Add a rectangle as a body of its own
   subroutine add_rectangle(model, material, n_nodes, divisions, from, to, choice)
      !> The job
      type(model_type), intent(inout) :: model
      !> Material, by its number
      integer, intent(in) :: material
      !> Nodes of an element: 3, 4, 6, 8 or 9; cells along r and z
      integer, intent(in) :: n_nodes, divisions(2)
      !> Opposite corners, r and z
      real(wp), intent(in) :: from(2), to(2)
      !> Rules and formulation of the elements; the usual ones if left out
      type(kind_choice_type), intent(in), optional :: choice

      real(wp) :: places(2, 0:2*divisions(1), 0:2*divisions(2))
      integer :: i, j

      do j = 0, 2*divisions(2)
         do i = 0, 2*divisions(1)
            places(:, i, j) = from + 0.5_wp*[i, j]/divisions*(to - from)
         end do
      end do
      call add_grid(model, material, n_nodes, places, choice)
   end subroutine add_rectangle

   !> Add the image of a grid on the unit square as a body of its own
   subroutine add_block(model, material, n_nodes, divisions, place, choice)
      !> The job
      type(model_type), intent(inout) :: model
      !> Material, by its number
      integer, intent(in) :: material
      !> Nodes of an element: 3, 4, 6, 8 or 9; cells in each direction
      integer, intent(in) :: n_nodes, divisions(2)
      !> Image of a point of the unit square: r and z
      procedure(place_function) :: place
      !> Rules and formulation of the elements; the usual ones if left out
      type(kind_choice_type), intent(in), optional :: choice

      real(wp) :: places(2, 0:2*divisions(1), 0:2*divisions(2))
      integer :: i, j

      do j = 0, 2*divisions(2)
         do i = 0, 2*divisions(1)
            places(:, i, j) = place(0.5_wp*i/divisions(1), 0.5_wp*j/divisions(2))
         end do
      end do
      call add_grid(model, material, n_nodes, places, choice)
   end subroutine add_block

   !> Add a grid of elements as a body of its own; two triangles fill a cell, cut by turns one way
   !> and the other
   subroutine add_grid(model, material, n_nodes, places, choice)
      !> The job
      type(model_type), intent(inout) :: model
      !> Material, by its number, and nodes of an element
      integer, intent(in) :: material, n_nodes
      !> Corners, middles of sides and centres of the cells
      real(wp), intent(in) :: places(:, 0:, 0:)
      !> Rules and formulation of the elements; the usual ones if left out
      type(kind_choice_type), intent(in), optional :: choice

      integer, allocatable :: number(:, :)
      real(wp), allocatable :: coordinates(:, :)
      integer :: i, j, n

      allocate (number(0:ubound(places, 2), 0:ubound(places, 3)), source=0)
      allocate (coordinates(2, size(number)))
      n = 0
      do j = 0, ubound(number, 2)
         do i = 0, ubound(number, 1)
            if (n_nodes <= 4 .and. (mod(i, 2) == 1 .or. mod(j, 2) == 1)) cycle
            if (n_nodes == 8 .and. mod(i, 2) == 1 .and. mod(j, 2) == 1) cycle
            n = n + 1
            number(i, j) = size(model%mesh%node_label) + n
            coordinates(:, n) = places(:, i, j)
         end do
      end do
      call take_nodes(model, coordinates(:, :n))
      call take_elements(model, material, n_nodes, cells(n_nodes, number), choice)
   end subroutine add_grid

   !> Elements of a grid of nodes
   pure function cells(n_nodes, number) result(elements)
      !> Nodes of an element
      integer, intent(in) :: n_nodes
      !> Node at each corner, middle of a side and centre of the cells, from 0
      integer, intent(in) :: number(0:, 0:)
      !> Nodes of each element
      integer, allocatable :: elements(:, :)

      !> Places of the nodes of a cell, and which of them each triangle has
      integer, parameter :: di(9) = [0, 2, 2, 0, 1, 2, 1, 0, 1], dj(9) = [0, 0, 2, 2, 0, 1, 2, 1, 1]
      integer, parameter :: halves(6, 2, 0:1) = reshape([1, 2, 3, 5, 6, 9, 1, 3, 4, 9, 7, 8, &
                                                         1, 2, 4, 5, 9, 8, 2, 3, 4, 6, 7, 9], &
                                                         [6, 2, 2])
      integer :: i, j, n, k, cell(9)

      allocate (elements(max_element_nodes, size(number)/merge(4, 2, n_corners(n_nodes) == 4)), &
         source=0)
      n = 0
      do j = 1, ubound(number, 2)/2
         do i = 1, ubound(number, 1)/2
            cell = [(number(2*i - 2 + di(k), 2*j - 2 + dj(k)), k=1, 9)]
            if (n_corners(n_nodes) == 4) then
               n = n + 1
               elements(:n_nodes, n) = cell(:n_nodes)
            else
               do k = 1, 2
                  elements(:n_nodes, n + k) = cell(halves(:n_nodes, k, mod(i + j, 2)))
               end do
               n = n + 2
            end if
         end do
      end do
      elements = elements(:, :n)
   end function cells

   !> Add nodes, free
   subroutine take_nodes(model, coordinates)
      !> The job
      type(model_type), intent(inout) :: model
      !> r and z of each
      real(wp), intent(in) :: coordinates(:, :)

      integer :: k, n

      n = size(model%mesh%node_label) + size(coordinates, 2)
      model%mesh%coordinates = reshape([model%mesh%coordinates, coordinates], [2, n])
      model%mesh%node_label = [(k, k=1, n)]
      model%fixed = reshape([model%fixed, spread(.false., 1, 3*size(coordinates, 2))], [3, n])
   end subroutine take_nodes

   !> Add elements as a body of their own
   subroutine take_elements(model, material, n_nodes, elements, choice)
      !> The job
      type(model_type), intent(inout) :: model
      !> Their material, and number of nodes of each
      integer, intent(in) :: material, n_nodes
      !> Their nodes
      integer, intent(in) :: elements(:, :)
      !> Rules and formulation of the elements; the usual ones if left out
      type(kind_choice_type), intent(in), optional :: choice

      type(kind_choice_type) :: chosen
      integer :: k, body, kind

      if (present(choice)) chosen = choice
      associate (mesh => model%mesh, n => size(elements, 2))
         body = maxval([0, mesh%element_body]) + 1
         mesh%element_nodes = reshape([mesh%element_nodes, elements], &
                                      [max_element_nodes, size(mesh%element_label) + n])
         mesh%element_material = [mesh%element_material, spread(material, 1, n)]
         mesh%element_body = [mesh%element_body, spread(body, 1, n)]
         mesh%element_size = [mesh%element_size, spread(n_nodes, 1, n)]
         call find_kind(mesh%kinds, chosen_kind(chosen, n_nodes), kind)
         mesh%element_kind = [mesh%element_kind, spread(kind, 1, n)]
         mesh%element_label = [(k, k=1, size(mesh%element_material))]
      end associate
   end subroutine take_elements

   !> Join two bodies along a straight line: side 1-2 of the joints on the first, side 4-3 on the
   !> second; eta points out of the first body
   subroutine add_interface(model, law, bodies, from, to, error)
      !> The job
      type(model_type), intent(inout) :: model
      !> Law of the joints, by its number
      integer, intent(in) :: law
      !> The bodies, numbered in the order in which they were added
      integer, intent(in) :: bodies(2)
      !> Ends of the line, r and z
      real(wp), intent(in) :: from(2), to(2)
      !> No edge of the first body lies there, or a node has no other one opposite
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: edges(:, :)
      integer :: k, i, n, one(3), other(3), joint(6)

      edges = edges_along(model, from, to, bodies(1))
      if (size(edges, 2) == 0) call refuse(from, to, error)
      model%interfaces = [model%interfaces, interface_type(law=law, bodies=bodies)]
      do k = 1, size(edges, 2)
         one = edges([2, 1, 3], k)  ! eta points out of the first body: it lies on the right
         n = count(one > 0)
         other = 0
         other(:n) = [(node_at(model, model%mesh%coordinates(:, one(i)), bodies(2)), i=1, n)]
         if (any(other(:n) == 0)) then
            call fatal_error(error, exit_deck, 'nodes of body '//to_text(bodies(1))// &
               ' have no opposite ones of body '// &
                             to_text(bodies(2))//' between '//place_text(from)//' and '// &
                             place_text(to))
            return
         end if
         joint = [one(1), one(2), other(2), other(1), one(3), other(3)]
         associate (mesh => model%mesh)
            mesh%joint_label = [mesh%joint_label, size(mesh%joint_label) + 1]
            mesh%joint_material = [mesh%joint_material, law]
            mesh%joint_size = [mesh%joint_size, 2*n]
            mesh%joint_interface = [mesh%joint_interface, size(model%interfaces)]
            mesh%joint_nodes = reshape([mesh%joint_nodes, joint], [6, size(mesh%joint_label)])
         end associate
      end do
   end subroutine add_interface

   !> Hold components of the nodes along a straight line in all modes
   subroutine hold_edges(model, from, to, held, error)
      !> The job
      type(model_type), intent(inout) :: model
      !> Ends of the line, r and z
      real(wp), intent(in) :: from(2), to(2)
      !> Whether u, v, w are held
      logical, intent(in) :: held(3)
      !> No edge lies there
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: edges(:, :)
      integer :: k

      edges = edges_along(model, from, to)
      if (size(edges, 2) == 0) call refuse(from, to, error)
      do k = 1, 3
         model%fixed(k, pack(edges, edges > 0)) = model%fixed(k, pack(edges, edges > 0)) &
            .or. held(k)
      end do
   end subroutine hold_edges

   !> Put the same traction on all edges along a straight line
   subroutine add_uniform_traction(model, mode, from, to, traction, error)
      !> The job
      type(model_type), intent(inout) :: model
      !> Harmonic and family
      type(mode_type), intent(in) :: mode
      !> Ends of the line, r and z
      real(wp), intent(in) :: from(2), to(2)
      !> Amplitudes of t_r, t_z, t_theta
      real(wp), intent(in) :: traction(3)
      !> No edge lies there
      type(error_type), allocatable, intent(out) :: error

      type(edge_load_type) :: load
      integer, allocatable :: edges(:, :)
      integer :: k

      edges = edges_along(model, from, to)
      if (size(edges, 2) == 0) call refuse(from, to, error)
      load%mode = mode
      load%traction = spread(traction, 2, 3)
      do k = 1, size(edges, 2)
         load%nodes = edges(:, k)
         model%edge_loads = [model%edge_loads, load]
      end do
   end subroutine add_uniform_traction

   !> Put a traction that varies on all edges along a straight line
   subroutine add_varying_traction(model, mode, from, to, traction, error)
      !> The job
      type(model_type), intent(inout) :: model
      !> Harmonic and family
      type(mode_type), intent(in) :: mode
      !> Ends of the line, r and z
      real(wp), intent(in) :: from(2), to(2)
      !> Amplitudes at a place
      procedure(traction_function) :: traction
      !> No edge lies there
      type(error_type), allocatable, intent(out) :: error

      type(edge_load_type) :: load
      integer, allocatable :: edges(:, :)
      integer :: k, i

      edges = edges_along(model, from, to)
      if (size(edges, 2) == 0) call refuse(from, to, error)
      load%mode = mode
      do k = 1, size(edges, 2)
         load%nodes = edges(:, k)
         do i = 1, count(load%nodes > 0)
            load%traction(:, i) = traction(model%mesh%coordinates(:, load%nodes(i)))
         end do
         model%edge_loads = [model%edge_loads, load]
      end do
   end subroutine add_varying_traction

   !> Edges of elements along a straight line: first, last and middle node, in the sense of their
   !> elements
   function edges_along(model, from, to, body) result(edges)
      !> The job
      type(model_type), intent(in) :: model
      !> Ends of the line, r and z
      real(wp), intent(in) :: from(2), to(2)
      !> Body that the elements belong to; any if left out
      integer, intent(in), optional :: body
      !> The edges; no middle node is zero
      integer, allocatable :: edges(:, :)

      integer :: element, k, nodes(3)

      allocate (edges(3, 0))
      associate (mesh => model%mesh)
         do element = 1, size(mesh%element_label)
            if (present(body)) then
               if (mesh%element_body(element) /= body) cycle
            end if
            do k = 1, n_corners(mesh%element_size(element))
               nodes = 0
               associate (edge => edge_nodes(mesh, element, k))
                  nodes(:size(edge)) = edge
               end associate
               if (.not. on_segment(mesh%coordinates(:, nodes(1)), from, to)) cycle
               if (.not. on_segment(mesh%coordinates(:, nodes(2)), from, to)) cycle
               edges = reshape([edges, nodes], [3, size(edges, 2) + 1])
            end do
         end do
      end associate
   end function edges_along

   !> Whether a point lies between two others on a straight line
   pure logical function on_segment(point, from, to)
      !> r and z of the point and of the ends
      real(wp), intent(in) :: point(2), from(2), to(2)

      associate (a => to - from, b => point - from)
         on_segment = abs(a(1)*b(2) - a(2)*b(1)) <= same_place*norm2(a)*(norm2(a) + norm2(b)) &
            .and. abs(dot_product(a, b) - 0.5_wp*dot_product(a, a)) &
               <= (0.5_wp + same_place)*dot_product(a, a)
      end associate
   end function on_segment

   !> Node of a body at a place; zero if there is none
   pure integer function node_at(model, position, body)
      !> The job
      type(model_type), intent(in) :: model
      !> r and z
      real(wp), intent(in) :: position(2)
      !> Body; any if left out
      integer, intent(in), optional :: body

      real(wp) :: extent
      integer :: element, k

      node_at = 0
      extent = maxval(abs(model%mesh%coordinates))
      do element = 1, size(model%mesh%element_label)
         if (present(body)) then
            if (model%mesh%element_body(element) /= body) cycle
         end if
         do k = 1, model%mesh%element_size(element)
            associate (node => model%mesh%element_nodes(k, element))
               if (norm2(model%mesh%coordinates(:, node) - position) < same_place*extent) &
                  node_at = node
            end associate
         end do
         if (node_at > 0) return
      end do
   end function node_at

   !> No edge lies along a line
   subroutine refuse(from, to, error)
      !> Ends of the line
      real(wp), intent(in) :: from(2), to(2)
      !> The error
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, exit_deck, 'no edge of an element lies between '//place_text(from)// &
         ' and '//place_text(to))
   end subroutine refuse

   !> A place in words
   function place_text(position) result(text)
      !> r and z
      real(wp), intent(in) :: position(2)
      !> Such as (0.5, 1)
      character(len=:), allocatable :: text

      text = '('//to_text(position(1))//', '//to_text(position(2))//')'
   end function place_text

end module axijoint_model_build
