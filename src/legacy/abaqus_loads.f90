!> What acts on a mesh of Abaqus or CalculiX: forces, pressures, gravity
module axijoint_legacy_abaqus_loads
   use axijoint_base_kinds, only : wp, pi
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text, upper
   use axijoint_legacy_abaqus_bodies, only : body_loads_type, add_body_gravity, add_body_rotation
   use axijoint_legacy_abaqus_lines, only : line_type, is_data, field_text, name_in, integer_of, real_of, fault_of
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, members, find_surface, side_nodes, is_side, is_inside, index_of
   use axijoint_legacy_abaqus_parameters, only : reserve
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : list_type
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_chains, part_pressures, part_ring_loads
   use axijoint_legacy_words, only : put, exact
   implicit none
   private
   public :: add_ring_force, add_distributed, add_faces

   !> Faces of pressures on single elements have numbers from here on
   integer, parameter :: first_side = 50001

contains

   !> *CLOAD: node or set, component, force of the whole circle
   subroutine add_ring_force(cards, keyword, at, mesh, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: line
      type(list_type) :: list
      real(wp) :: force, radius
      integer :: component, k, node

      do while (is_data(cards, at, line))
         list = members(cards, line, 1, mesh%node_sets)
         component = integer_of(cards, line, 2)
         force = real_of(cards, line, 3)
         if (all(component /= [1, 2]) .or. len(reserve(keyword)) > 0) then
            call leave_out(sketch, line%card, '*CLOAD of component '//to_text(component)// &
               reserve(keyword))
            cycle
         end if
         do k = 1, list%n
            node = index_of(cards, line, mesh, list%value(k))
            if (node == 0) exit
            if (.not. mesh%used(node)) then
               call leave_out(sketch, line%card, '*CLOAD on nodes that no element has')
               cycle
            end if
            radius = mesh%position(1, node)
            if (radius > 0.0_wp) then
               call put(sketch%parts(part_ring_loads), to_text(mesh%node(node))//', 0, '// &
                  repeat(', ', component - 1)//exact(force/(2.0_wp*pi*radius)))
            else if (component == 2) then
               call put(sketch%parts(part_ring_loads), to_text(mesh%node(node))//', 0, , '// &
                  exact(force))
            else if (abs(force) > 0.0_wp) then
               call leave_out(sketch, line%card, '*CLOAD of component 1 on the axis, where '// &
                  'nothing moves along r')
            end if
         end do
      end do
   end subroutine add_ring_force

   !> *DLOAD: elements or a set, P1 to P4, GRAV, CENTRIF; *DSLOAD: a surface, P
   subroutine add_distributed(cards, keyword, at, mesh, bodies, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh
      !> Takes what acts on masses
      type(body_loads_type), intent(inout) :: bodies
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: line
      character(len=:), allocatable :: kind

      do while (is_data(cards, at, line))
         kind = upper(field_text(line, 2))
         if (len(reserve(keyword)) > 0) then
            call leave_out(sketch, line%card, '*'//keyword%keyword//' of kind '//kind// &
               reserve(keyword))
         else if (keyword%keyword == 'DSLOAD' .and. kind == 'P') then
            call press_surface(cards, line, mesh, sketch)
         else if (keyword%keyword == 'DLOAD' .and. len(kind) == 2 .and. index(kind, 'P') == 1 .and. &
                  verify(kind(len(kind):), '1234') == 0) then
            call press_sides(cards, line, mesh, sketch)
         else if (kind == 'GRAV') then
            call add_body_gravity(cards, line, keyword%keyword, mesh, bodies, sketch)
         else if (kind == 'CENTRIF') then
            call add_body_rotation(cards, line, keyword%keyword, mesh, bodies, sketch)
         else
            call leave_out(sketch, line%card, '*'//keyword%keyword//' of kind '//kind)
         end if
      end do
   end subroutine add_distributed

   !> Pressure on a surface
   subroutine press_surface(cards, line, mesh, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line
      type(line_type), intent(in) :: line
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      integer :: k, i, face

      k = find_surface(cards, line, 1, mesh)
      if (k == 0) return
      face = sum([(mesh%surfaces(i)%elements%n, i=1, k - 1)])
      associate (surface => mesh%surfaces(k))
         surface%pressed = .true.
         do i = 1, surface%elements%n
            if (is_inside(mesh, surface%elements%value(i), surface%sides%value(i))) then
               call leave_out(sketch, line%card, '*DSLOAD on sides that are tied to others')
            else
               call put(sketch%parts(part_pressures), to_text(face + i)//', 0, '//exact(real_of(cards, line, 3)))
            end if
         end do
      end associate
   end subroutine press_surface

   !> Pressure on a side of elements: a face each
   subroutine press_sides(cards, line, mesh, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line
      type(line_type), intent(in) :: line
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      character(len=:), allocatable :: kind
      type(list_type) :: list
      integer, allocatable :: nodes(:)
      integer :: k, side, element, face

      list = members(cards, line, 1, mesh%element_sets)
      kind = field_text(line, 2)
      side = index('1234', kind(2:2))
      do k = 1, list%n
         element = find_number(mesh%element_map, list%value(k))
         if (element == 0) then
            call fault_of(cards, line, 1, 'there is no element '//to_text(list%value(k)))
            return
         end if
         if (.not. is_side(cards, line, mesh, element, side)) return
         nodes = side_nodes(mesh, element, side)
         sketch%n_sides = sketch%n_sides + 1
         face = first_side + sketch%n_sides - 1
         call put(sketch%parts(part_chains), to_text(face)//', '//to_text(nodes(1))//', '// &
            to_text(nodes(2)))
         call put(sketch%parts(part_pressures), to_text(face)//', 0, '// &
            exact(real_of(cards, line, 3)))
      end do
   end subroutine press_sides

   !> Faces of the surfaces: a chain for each side, in their order
   subroutine add_faces(mesh, sketch)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      integer, allocatable :: nodes(:)
      integer :: k, i, face

      face = 0
      do k = 1, size(mesh%surfaces)
         associate (surface => mesh%surfaces(k))
            if (surface%elements%n > 0 .and. (surface%pressed .or. .not. surface%in_contact)) then
               call put(sketch%parts(part_chains), '! surface '//surface%name//': faces '// &
                  to_text(face + 1)//' to '//to_text(face + surface%elements%n))
               do i = 1, surface%elements%n
                  if (is_inside(mesh, surface%elements%value(i), surface%sides%value(i))) cycle
                  nodes = side_nodes(mesh, surface%elements%value(i), surface%sides%value(i))
                  call put(sketch%parts(part_chains), to_text(face + i)//', '//to_text(nodes(1))//', '//to_text(nodes(2)))
               end do
            end if
            face = face + surface%elements%n
         end associate
      end do
   end subroutine add_faces

end module axijoint_legacy_abaqus_loads
