!> Meshes of Abaqus and CalculiX: nodes, axisymmetric elements, sets, surfaces
module axijoint_legacy_abaqus_mesh
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_sort, only : ascending_order
   use axijoint_base_text, only : to_text, upper
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_legacy_abaqus_lines, only : line_type, is_data, parameter_of, has_parameter, &
      field_text, name_in, integer_of, real_of, fault_of
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : list_type, set_type, add, open_set, find_set
   implicit none
   private
   public :: abaqus_type, surface_type, read_nodes, read_elements, read_set, gather_nodes, read_surface, &
      members, find_surface, side_nodes, is_side, n_side_nodes, find_inside, is_inside, &
      index_of, root_of, tie, number_at, most_sides

   !> Sides of an element
   integer, parameter :: most_sides = 4

   !> Sides of elements with a name
   type :: surface_type
      !> The name
      character(len=:), allocatable :: name
      !> Elements (indices) and their sides
      type(list_type) :: elements, sides
      !> Whether it is in contact with another one, and whether a pressure acts on it
      logical :: in_contact = .false., pressed = .false.
   end type surface_type

   !> What is read
   type :: abaqus_type
      !> Nodes by number: numbers and places
      type(number_map_type) :: node_map
      integer, allocatable :: node(:)
      real(wp), allocatable :: position(:, :)
      integer :: n_nodes = 0
      !> Whether elements have a node; node that it is tied to, itself if none
      logical, allocatable :: used(:)
      integer, allocatable :: tied_to(:)
      !> Sides that ties have made those of two elements, shape (sides, elements); not allocated without ties
      logical, allocatable :: inside(:, :)
      !> Elements by number: numbers, nodes as on the lines, how many; whether the rule is reduced
      type(number_map_type) :: element_map
      integer, allocatable :: element(:), nodes(:, :), size(:), material(:)
      logical, allocatable :: reduced(:)
      integer :: n_elements = 0
      !> Sets, and surfaces
      type(set_type), allocatable :: node_sets(:), element_sets(:)
      type(surface_type), allocatable :: surfaces(:)
   end type abaqus_type

contains

   !> Data of *NODE: number, r, z
   subroutine read_nodes(cards, keyword, at, mesh)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line *NODE
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> Takes them
      type(abaqus_type), intent(inout) :: mesh

      type(line_type) :: line
      integer :: number, set

      set = 0
      if (parameter_of(keyword, 'NSET') /= '') &
         call open_set(mesh%node_sets, parameter_of(keyword, 'NSET'), keyword%card, set)
      do while (is_data(cards, at, line))
         number = integer_of(cards, line, 1)
         if (number < 1) then
            call fault_of(cards, line, 1, 'this is no number of a node', '1, 2, ...')
            cycle
         end if
         if (find_number(mesh%node_map, number) > 0) &
            call fault_of(cards, line, 1, 'the node is there already')
         mesh%n_nodes = mesh%n_nodes + 1
         call insert_number(mesh%node_map, number, mesh%n_nodes)
         mesh%node(mesh%n_nodes) = number
         mesh%position(:, mesh%n_nodes) = [real_of(cards, line, 2), real_of(cards, line, 3)]
         if (abs(real_of(cards, line, 4)) > 0.0_wp) call fault_of(cards, line, 4, &
            'the third coordinate of an axisymmetric mesh is not zero', '0 or blank')
         if (set > 0) call add(mesh%node_sets(set)%list, number)
      end do
   end subroutine read_nodes

   !> Data of *ELEMENT: number and nodes, corners first; a line may go on in the next
   subroutine read_elements(cards, keyword, at, mesh)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line *ELEMENT
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> Takes them
      type(abaqus_type), intent(inout) :: mesh

      type(line_type) :: line
      character(len=:), allocatable :: kind, name
      integer :: values(9), set, n, k, m, digit
      logical :: reduced

      kind = parameter_of(keyword, 'TYPE')
      name = parameter_of(keyword, 'ELSET')
      digit = scan(kind, '3468')
      n = 0
      if (digit > 0) then
         if (any(kind(:digit - 1) == [character(len=4) :: 'CAX', 'CGAX'])) read (kind(digit:digit), *) n
      end if
      if (n == 0) then
         call fault_of(cards, keyword, 0, 'elements of type '//kind//' are no axisymmetric solids', &
            'CAX3, CAX4, CAX6, CAX8, and their variants; what CAXA adds to them are harmonics, which CONTROL has here')
         do while (is_data(cards, at, line))
         end do
         return
      end if
      reduced = n > 4 .and. index(kind(digit + 1:), 'R') == 1
      if (kind(digit + 1:) /= trim(merge('R', ' ', reduced))) call add_warning(cards%diagnostics, keyword%card, 0, 0, &
         kind//' is taken as element of '//to_text(n)//' nodes with the '//trim(merge('reduced', 'full   ', reduced))//' rule')
      set = 0
      if (name /= '') call open_set(mesh%element_sets, name, keyword%card, set)
      do while (is_data(cards, at, line))
         k = 0
         do
            do m = 1, size(line%place, 2)
               if (k > n) exit
               if (len(field_text(line, m)) == 0) cycle
               k = k + 1
               values(k) = integer_of(cards, line, m)
            end do
            if (k > n) exit
            if (.not. is_data(cards, at, line)) exit
         end do
         if (k <= n) then
            call fault_of(cards, keyword, 0, 'an element has too few nodes')
            return
         end if
         call add_element(cards, line, values(:n + 1), reduced, mesh)
         if (set > 0) call add(mesh%element_sets(set)%list, values(1))
      end do
   end subroutine read_elements

   !> Add an element
   subroutine add_element(cards, line, values, reduced, mesh)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> Its last line
      type(line_type), intent(in) :: line
      !> Number and nodes
      integer, intent(in) :: values(:)
      !> Whether the rule is reduced
      logical, intent(in) :: reduced
      !> Takes it
      type(abaqus_type), intent(inout) :: mesh

      integer :: k

      if (values(1) < 1) then
         call fault_of(cards, line, 1, 'this is no number of an element', '1, 2, ...')
         return
      end if
      if (find_number(mesh%element_map, values(1)) > 0) &
         call fault_of(cards, line, 1, 'the element is there already')
      do k = 2, size(values)
         if (find_number(mesh%node_map, values(k)) == 0) call fault_of(cards, line, 0, &
            'there is no node '//to_text(values(k)), 'nodes of *NODE above')
      end do
      mesh%n_elements = mesh%n_elements + 1
      call insert_number(mesh%element_map, values(1), mesh%n_elements)
      mesh%element(mesh%n_elements) = values(1)
      mesh%size(mesh%n_elements) = size(values) - 1
      mesh%nodes(:size(values) - 1, mesh%n_elements) = values(2:)
      mesh%reduced(mesh%n_elements) = reduced
   end subroutine add_element

   !> Data of *NSET and *ELSET: numbers, names of sets, or with GENERATE first, last, step
   subroutine read_set(cards, keyword, at, name, there, sets)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> Name of the parameter that names the set
      character(len=*), intent(in) :: name
      !> Numbers of all nodes or elements
      integer, intent(in) :: there(:)
      !> Takes it
      type(set_type), allocatable, intent(inout) :: sets(:)

      type(line_type) :: line
      type(list_type) :: list
      integer :: set, k, i

      if (parameter_of(keyword, name) == '') then
         call fault_of(cards, keyword, 0, 'the set has no name', name//'=')
         return
      end if
      call open_set(sets, parameter_of(keyword, name), keyword%card, set)
      do while (is_data(cards, at, line))
         if (has_parameter(keyword, 'GENERATE')) then
            call generate(cards, line, there, sets(set)%list)
            cycle
         end if
         do k = 1, size(line%place, 2)
            if (len(field_text(line, k)) == 0) cycle
            list = members(cards, line, k, sets)
            do i = 1, list%n
               call add(sets(set)%list, list%value(i))
            end do
         end do
      end do
   end subroutine read_set

   !> Numbers from a first to a last one in steps, as far as they are there, in ascending order
   subroutine generate(cards, line, there, list)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line: first, last, step
      type(line_type), intent(in) :: line
      !> Numbers of all nodes or elements
      integer, intent(in) :: there(:)
      !> Takes them
      type(list_type), intent(inout) :: list

      integer, allocatable :: found(:)
      integer :: first, last, step, k

      first = integer_of(cards, line, 1)
      last = integer_of(cards, line, 2)
      step = integer_of(cards, line, 3)
      if (step == 0) step = 1
      if (first < 1 .or. first > last .or. step < 1) then
         call fault_of(cards, line, 0, 'GENERATE has no numbers from '//to_text(first)//' to '// &
            to_text(last)//' in steps of '//to_text(step), 'first, last, step: the last not below '// &
            'the first, the step 1 or above')
         return
      end if
      found = pack(there, there >= first .and. there <= last .and. modulo(there - first, step) == 0)
      if (size(found) == 0) call fault_of(cards, line, 0, 'none of these numbers is there', &
         'numbers of *NODE for *NSET, of *ELEMENT for *ELSET')
      found = found(ascending_order(real(found, wp)))
      do k = 1, size(found)
         call add(list, found(k))
      end do
   end subroutine generate

   !> *NSET, ELSET=: the nodes of a set of elements, each once
   subroutine gather_nodes(cards, keyword, mesh)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Takes the set
      type(abaqus_type), intent(inout) :: mesh

      logical :: taken(mesh%n_nodes)
      integer :: from, set, k, element, node

      if (parameter_of(keyword, 'NSET') == '') then
         call fault_of(cards, keyword, 0, 'the set has no name', 'NSET=')
         return
      end if
      from = find_set(mesh%element_sets, parameter_of(keyword, 'ELSET'))
      if (from == 0) then
         call fault_of(cards, keyword, 0, 'there is no set '//parameter_of(keyword, 'ELSET'), &
            'sets of elements that are above')
         return
      end if
      call open_set(mesh%node_sets, parameter_of(keyword, 'NSET'), keyword%card, set)
      taken = .false.
      do k = 1, mesh%element_sets(from)%list%n
         element = find_number(mesh%element_map, mesh%element_sets(from)%list%value(k))
         if (element == 0) cycle
         do node = 1, mesh%size(element)
            taken(find_number(mesh%node_map, mesh%nodes(node, element))) = .true.
         end do
      end do
      do k = 1, mesh%n_nodes
         if (taken(k)) call add(mesh%node_sets(set)%list, mesh%node(k))
      end do
   end subroutine gather_nodes

   !> What a field means: a number, or the members of a set
   function members(cards, line, field, sets) result(list)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line, and the field
      type(line_type), intent(in) :: line
      integer, intent(in) :: field
      !> Sets by name
      type(set_type), intent(in), allocatable :: sets(:)
      !> The numbers
      type(list_type) :: list

      integer :: set

      if (verify(field_text(line, field), '0123456789') == 0) then
         call add(list, integer_of(cards, line, field))
         return
      end if
      set = find_set(sets, name_in(line, field))
      if (set > 0) then
         list = sets(set)%list
         if (.not. allocated(list%value)) allocate (list%value(0))
      else
         call fault_of(cards, line, field, 'there is no set of this name', 'sets that are above')
         allocate (list%value(0))
      end if
   end function members

   !> Data of *SURFACE: elements or sets of them, and a side
   subroutine read_surface(cards, keyword, at, mesh)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> Takes it
      type(abaqus_type), intent(inout) :: mesh

      type(line_type) :: line
      type(surface_type) :: surface
      type(surface_type), allocatable :: more(:)
      type(list_type) :: list
      character(len=:), allocatable :: text
      integer :: k, side, element

      surface%name = parameter_of(keyword, 'NAME')
      allocate (surface%elements%value(0), surface%sides%value(0))
      do while (is_data(cards, at, line))
         list = members(cards, line, 1, mesh%element_sets)
         side = 0
         text = upper(field_text(line, 2))
         if (len(text) == 2 .and. index(text, 'S') == 1) side = index('1234', text(len(text):))
         if (side == 0) then
            call fault_of(cards, line, 2, 'this is no side', 'S1 to S4')
            cycle
         end if
         do k = 1, list%n
            element = find_number(mesh%element_map, list%value(k))
            if (element == 0) then
               call fault_of(cards, line, 1, 'there is no element '//to_text(list%value(k)))
               exit
            end if
            if (.not. is_side(cards, line, mesh, element, side)) exit
            call push(surface%elements, element)
            call push(surface%sides, side)
         end do
      end do
      if (.not. allocated(mesh%surfaces)) allocate (mesh%surfaces(0))
      allocate (more(size(mesh%surfaces) + 1))
      do k = 1, size(mesh%surfaces)
         more(k) = mesh%surfaces(k)
      end do
      more(size(more)) = surface
      call move_alloc(more, mesh%surfaces)

   contains

      !> Add to a list that may have no room at all
      subroutine push(list, value)
         !> The list
         type(list_type), intent(inout) :: list
         !> The integer
         integer, intent(in) :: value

         if (size(list%value) == 0) deallocate (list%value)
         call add(list, value)
      end subroutine push

   end subroutine read_surface

   !> Index of a node, or of that which it is tied to; 0, and an error, if it is not there
   integer function index_of(cards, line, mesh, number) result(node)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line that names it, or a set that has it, in its first field
      type(line_type), intent(in) :: line
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Number of the node
      integer, intent(in) :: number

      node = find_number(mesh%node_map, number)
      if (node == 0) then
         call fault_of(cards, line, 1, 'there is no node '//to_text(number), 'nodes of *NODE')
      else
         node = root_of(mesh, node)
      end if
   end function index_of

   !> Node that a node is tied to in the end
   pure integer function root_of(mesh, node) result(root)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The node (index)
      integer, intent(in) :: node

      root = node
      do while (mesh%tied_to(root) /= root)
         root = mesh%tied_to(root)
      end do
   end function root_of

   !> Number of the node that a node of this number is tied to in the end
   pure integer function number_at(mesh, number) result(there)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Number of a node
      integer, intent(in) :: number

      integer :: node

      node = find_number(mesh%node_map, number)
      there = number
      if (node > 0) there = mesh%node(root_of(mesh, node))
   end function number_at

   !> Tie a node to another
   subroutine tie(mesh, node, to)
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh
      !> Indices of both
      integer, intent(in) :: node, to

      mesh%tied_to(root_of(mesh, node)) = root_of(mesh, to)
   end subroutine tie

   !> Place of a surface among all; 0, and an error, if there is none of the name in a field
   integer function find_surface(cards, line, field, mesh) result(found)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line, and the field
      type(line_type), intent(in) :: line
      integer, intent(in) :: field
      !> The mesh
      type(abaqus_type), intent(in) :: mesh

      do found = size(mesh%surfaces), 1, -1
         if (mesh%surfaces(found)%name == name_in(line, field)) return
      end do
      found = 0
      call fault_of(cards, line, field, 'there is no surface of this name', 'surfaces of sides of elements that are above')
   end function find_surface

   !> Whether an element has a side; an error if not
   logical function is_side(cards, line, mesh, element, side)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line that names the side in its second field
      type(line_type), intent(in) :: line
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Element (index) and side, from 1
      integer, intent(in) :: element, side

      is_side = side <= corners_of(mesh, element)
      if (.not. is_side) call fault_of(cards, line, 2, 'element '//to_text(mesh%element(element))// &
         ' is a triangle and has no such side', 'sides 1 to 3')
   end function is_side

   !> Corners of an element
   pure integer function corners_of(mesh, element) result(corners)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Element (index)
      integer, intent(in) :: element

      corners = merge(3, 4, any(mesh%size(element) == [3, 6]))
   end function corners_of

   !> Find sides that ties have made those of two elements: no face runs there
   subroutine find_inside(mesh)
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh

      logical :: tied(mesh%n_nodes)
      integer, allocatable :: sides(:, :), nodes(:)
      integer :: k, s, other

      tied = [(mesh%tied_to(k) /= k, k=1, mesh%n_nodes)]
      do k = 1, mesh%n_nodes
         if (tied(k)) tied(root_of(mesh, k)) = .true.
      end do
      allocate (sides(4, 0))  ! element, side, corners in ascending order
      do k = 1, mesh%n_elements
         do s = 1, corners_of(mesh, k)
            nodes = side_nodes(mesh, k, s)
            if (any(.not. tied([(find_number(mesh%node_map, nodes(other)), other=1, 2)]))) cycle
            sides = reshape([sides, k, s, minval(nodes(:2)), maxval(nodes(:2))], [4, size(sides, 2) + 1])
         end do
      end do
      if (.not. allocated(mesh%inside)) allocate (mesh%inside(most_sides, mesh%n_elements), source=.false.)
      do k = 2, size(sides, 2)
         do other = 1, k - 1
            if (any(sides(3:, other) /= sides(3:, k))) cycle
            mesh%inside(sides(2, k), sides(1, k)) = .true.
            mesh%inside(sides(2, other), sides(1, other)) = .true.
         end do
      end do
   end subroutine find_inside

   !> Whether ties have made a side one of two elements
   pure logical function is_inside(mesh, element, side) result(inside)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Element (index) and side
      integer, intent(in) :: element, side

      inside = .false.
      if (allocated(mesh%inside)) inside = mesh%inside(side, element)
   end function is_inside

   !> Nodes of a side: two corners, and one between them of quadratic elements
   pure integer function n_side_nodes(mesh, element)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Element (index)
      integer, intent(in) :: element

      n_side_nodes = merge(2, 3, mesh%size(element) <= 4)
   end function n_side_nodes

   !> Nodes of a side of an element: its corners, in the order of the element, and the node between them
   pure function side_nodes(mesh, element, side) result(nodes)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Element (index) and side, from 1
      integer, intent(in) :: element, side
      !> Numbers of the nodes, or of those that they are tied to
      integer :: nodes(n_side_nodes(mesh, element))

      integer :: i, corners

      corners = corners_of(mesh, element)
      nodes(:2) = mesh%nodes([side, mod(side, corners) + 1], element)
      if (size(nodes) == 3) nodes(3) = mesh%nodes(corners + side, element)
      do i = 1, size(nodes)
         nodes(i) = number_at(mesh, nodes(i))
      end do
   end function side_nodes

end module axijoint_legacy_abaqus_mesh
