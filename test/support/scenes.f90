!> Small models built in memory, for tests against exact solutions
module axijoint_test_scenes
   use axijoint_base_kinds, only : wp, pi
   use axijoint_element_joint_law, only : joint_law_type, law_elastic
   use axijoint_fe_element_kind, only : element_kind_type, kind_choice_type, chosen_kind, find_kind
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_load, only : edge_load_type, ring_load_type, increment_type, combination_type, &
      load_case_type
   use axijoint_model_material, only : solid_material_type, joint_material_type
   use axijoint_model_model, only : model_type, method_transfer
   implicit none
   private
   public :: new_scene, add_block, add_interface, add_edge_traction, set_elastic, node_at

   !> Two nodes nearer than this are at the same place
   real(wp), parameter :: tolerance = 1.0e-10_wp

contains

   !> Empty model with one material and one elastic joint material
   function new_scene(young, poisson, max_harmonic) result(model)
      !> Elastic constants
      real(wp), intent(in) :: young, poisson
      !> Highest harmonic
      integer, intent(in) :: max_harmonic
      !> The model
      type(model_type) :: model

      integer :: m

      model%title = 'scene'
      model%materials = [solid_material_type(label=1, young=young, poisson=poisson)]
      allocate (model%joint_materials(1))
      model%max_harmonic = max_harmonic
      model%n_planes = 4*max_harmonic + 2
      model%method = method_transfer
      model%output_angles = [0.0_wp, 0.5_wp*pi, pi]
      model%increments = [increment_type()]
      allocate (model%edge_loads(0), model%ring_loads(0), model%fixed(3, 0))
      allocate (model%body_loads(0), model%thermal_loads(0), model%prescribed(0))
      allocate (model%initial_stresses(0), model%edge_supports(0), model%truncations(0))
      allocate (model%lines(0), model%cuts(0), model%supported_faces(0))
      model%load_cases = [load_case_type(label=1, name='')]
      model%combinations = [combination_type(label=1, factor=[1.0_wp])]
      model%harmonics = [(m, m=0, max_harmonic)]
      associate (mesh => model%mesh)
         allocate (mesh%coordinates(2, 0), mesh%node_label(0), mesh%element_label(0))
         allocate (mesh%element_material(0), mesh%element_body(0), mesh%element_size(0))
         allocate (mesh%element_kind(0), mesh%kinds(0))
         allocate (mesh%element_nodes(9, 0), mesh%joint_label(0), mesh%joint_material(0))
         allocate (mesh%joint_size(0), mesh%joint_nodes(6, 0))
      end associate
   end function new_scene

   !> Add a grid of elements whose corners are the image of a grid on the unit
   !> square; two triangles fill a cell, cut by turns one way and the other. The nodes are new, so that blocks are bodies of their own
   subroutine add_block(model, n_nodes, n1, n2, place, choice)
      !> The model
      type(model_type), intent(inout) :: model
      !> Nodes of an element: 3, 4, 6, 8 or 9
      integer, intent(in) :: n_nodes
      !> Cells in each direction
      integer, intent(in) :: n1, n2
      !> Image of a point of the unit square: r and z
      interface
         function place(x, y)
            import :: wp
            !> Point of the unit square
            real(wp), intent(in) :: x, y
            !> r and z
            real(wp) :: place(2)
         end function place
      end interface
      !> Rules and formulation, if not the usual ones
      type(kind_choice_type), intent(in), optional :: choice

      type(kind_choice_type) :: chosen
      integer, parameter :: di(9) = [0, 2, 2, 0, 1, 2, 1, 0, 1], dj(9) = [0, 0, 2, 2, 0, 1, 2, 1, 1]
      integer, parameter :: halves(6, 2, 0:1) = reshape([1, 2, 3, 5, 6, 9, 1, 3, 4, 9, 7, 8, &
                                                         1, 2, 4, 5, 9, 8, 2, 3, 4, 6, 7, 9], [6, 2, 2])
      integer, allocatable :: number(:, :), elements(:, :)
      real(wp), allocatable :: coordinates(:, :)
      integer :: i, j, k, count, first, body, cell(9), n, kind

      first = size(model%mesh%node_label)
      allocate (number(0:2*n1, 0:2*n2), source=0)
      allocate (coordinates(2, (2*n1 + 1)*(2*n2 + 1)), elements(9, 2*n1*n2))
      elements = 0
      n = 0
      count = 0
      do j = 0, 2*n2
         do i = 0, 2*n1
            if (n_nodes <= 4 .and. (mod(i, 2) == 1 .or. mod(j, 2) == 1)) cycle
            if (n_nodes == 8 .and. mod(i, 2) == 1 .and. mod(j, 2) == 1) cycle
            count = count + 1
            number(i, j) = first + count
            coordinates(:, count) = place(0.5_wp*i/n1, 0.5_wp*j/n2)
         end do
      end do
      do j = 1, n2
         do i = 1, n1
            cell = [(number(2*i - 2 + di(k), 2*j - 2 + dj(k)), k=1, 9)]
            if (n_corners(n_nodes) == 4) then
               n = n + 1
               elements(:n_nodes, n) = cell(:n_nodes)
            else
               do k = 1, 2
                  n = n + 1
                  elements(:n_nodes, n) = cell(halves(:n_nodes, k, mod(i + j, 2)))
               end do
            end if
         end do
      end do
      associate (mesh => model%mesh)
         body = maxval([0, mesh%element_body]) + 1
         mesh%coordinates = reshape([mesh%coordinates, coordinates(:, :count)], [2, first + count])
         mesh%node_label = [(i, i=1, first + count)]
         mesh%element_nodes = reshape([mesh%element_nodes, elements(:, :n)], &
                                      [9, size(mesh%element_label) + n])
         mesh%element_material = [mesh%element_material, spread(1, 1, n)]
         mesh%element_body = [mesh%element_body, spread(body, 1, n)]
         mesh%element_size = [mesh%element_size, spread(n_nodes, 1, n)]
         mesh%element_label = [(i, i=1, size(mesh%element_material))]
         if (present(choice)) chosen = choice
         call find_kind(mesh%kinds, chosen_kind(chosen, n_nodes), kind)
         mesh%element_kind = [mesh%element_kind, spread(kind, 1, n)]
      end associate
      model%fixed = reshape([model%fixed, spread(.false., 1, 3*count)], [3, first + count])
   end subroutine add_block

   !> Stiffness and rule of the elastic joint material
   subroutine set_elastic(model, stiffness, rule)
      !> The model
      type(model_type), intent(inout) :: model
      !> Stiffness per unit area along xi, eta, theta
      real(wp), intent(in) :: stiffness(3)
      !> Integration rule
      integer, intent(in) :: rule

      model%joint_materials(1) = joint_material_type(1, rule, joint_law_type(law_elastic, stiffness))
   end subroutine set_elastic

   !> Join the edges of two bodies along a straight line: side 1-2 on the lower
   !> body, side 4-3 on the upper
   subroutine add_interface(model, lower_body, upper_body, from, to)
      !> The model
      type(model_type), intent(inout) :: model
      !> Bodies on sides 1-2 and 4-3
      integer, intent(in) :: lower_body, upper_body
      !> Ends of the line
      real(wp), intent(in) :: from(2), to(2)

      integer :: lower(3), upper(3), element, n, k, i, joint(6)

      n = merge(2, 3, model%mesh%element_size(1) <= 4)
      do element = 1, size(model%mesh%element_label)
         if (model%mesh%element_body(element) /= lower_body) cycle
         do k = 1, n_corners(model%mesh%element_size(element))
            lower = edge_of(model, element, k)
            if (.not. along(lower)) cycle
            lower(1:2) = lower([2, 1])  ! eta points out of the lower body: it lies on the right
            upper(1:n) = [(node_at(model, model%mesh%coordinates(:, lower(i)), upper_body), &
                           i = 1, n)]
            joint = 0
            joint(1:4) = [lower(1), lower(2), upper(2), upper(1)]
            if (n == 3) joint(5:6) = [lower(3), upper(3)]
            associate (mesh => model%mesh)
               mesh%joint_label = [mesh%joint_label, size(mesh%joint_label) + 1]
               mesh%joint_material = [mesh%joint_material, 1]
               mesh%joint_size = [mesh%joint_size, 2*n]
               mesh%joint_nodes = reshape([mesh%joint_nodes, joint], [6, size(mesh%joint_label)])
            end associate
            exit
         end do
      end do

   contains

      !> Whether an edge lies on the line
      logical function along(nodes)
         !> First and last node
         integer, intent(in) :: nodes(3)

         along = on_segment(model%mesh%coordinates(:, nodes(1)), from, to) &
            .and. on_segment(model%mesh%coordinates(:, nodes(2)), from, to)
      end function along

   end subroutine add_interface

   !> Put a traction on all outer edges along a straight line
   subroutine add_edge_traction(model, harmonic, from, to, traction)
      !> The model
      type(model_type), intent(inout) :: model
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Ends of the line
      real(wp), intent(in) :: from(2), to(2)
      !> Amplitudes t_r, t_z, t_theta at r and z
      interface
         function traction(position)
            import :: wp
            !> r and z
            real(wp), intent(in) :: position(2)
            !> The amplitudes
            real(wp) :: traction(3)
         end function traction
      end interface

      type(edge_load_type) :: load
      integer :: element, k, i, nodes(3)

      do element = 1, size(model%mesh%element_label)
         do k = 1, n_corners(model%mesh%element_size(element))
            nodes = edge_of(model, element, k)
            if (.not. on_segment(model%mesh%coordinates(:, nodes(1)), from, to)) cycle
            if (.not. on_segment(model%mesh%coordinates(:, nodes(2)), from, to)) cycle
            load%mode%harmonic = harmonic
            load%nodes = nodes
            do i = 1, count(nodes > 0)
               load%traction(:, i) = traction(model%mesh%coordinates(:, nodes(i)))
            end do
            model%edge_loads = [model%edge_loads, load]
         end do
      end do
   end subroutine add_edge_traction

   !> First, last and middle node of an edge of an element, counterclockwise
   function edge_of(model, element, k) result(nodes)
      !> The model
      type(model_type), intent(in) :: model
      !> Element
      integer, intent(in) :: element
      !> Number of the edge, from corner k to k + 1
      integer, intent(in) :: k
      !> The nodes; no middle node is zero
      integer :: nodes(3)

      associate (list => model%mesh%element_nodes(:, element), &
                 c => n_corners(model%mesh%element_size(element)))
         nodes = [list(k), list(mod(k, c) + 1), 0]
         if (model%mesh%element_size(element) > 4) nodes(3) = list(k + c)
      end associate
   end function edge_of

   !> Whether a point lies between two others on a straight line
   pure logical function on_segment(point, from, to)
      !> r and z of the point and of the ends
      real(wp), intent(in) :: point(2), from(2), to(2)

      associate (a => to - from, b => point - from)
         on_segment = abs(a(1)*b(2) - a(2)*b(1)) <= tolerance*norm2(a) &
            .and. abs(dot_product(a, b) - 0.5_wp*dot_product(a, a)) &
               <= (0.5_wp + tolerance)*dot_product(a, a)
      end associate
   end function on_segment

   !> Node of a body at a place; zero if there is none
   pure integer function node_at(model, position, body)
      !> The model
      type(model_type), intent(in) :: model
      !> r and z
      real(wp), intent(in) :: position(2)
      !> Body; any if left out
      integer, intent(in), optional :: body

      integer :: element, k

      node_at = 0
      do element = 1, size(model%mesh%element_label)
         if (present(body)) then
            if (model%mesh%element_body(element) /= body) cycle
         end if
         do k = 1, model%mesh%element_size(element)
            associate (node => model%mesh%element_nodes(k, element))
               if (norm2(model%mesh%coordinates(:, node) - position) < tolerance) node_at = node
            end associate
         end do
         if (node_at > 0) return
      end do
   end function node_at

end module axijoint_test_scenes
