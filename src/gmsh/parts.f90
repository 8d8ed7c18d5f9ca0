!> Nodes, elements and names of groups, which both formats write alike
module axijoint_gmsh_parts
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_gmsh_mesh, only : gmsh_mesh_type, most_nodes, nodes_of_type, dimension_of_type, &
      type_name, find_group, group_index, group_text
   use axijoint_gmsh_scanner, only : scanner_type, fault_type, read_integer, read_real, end_line, &
      line_fault, token_fault, next_token, token_text, largest_tag
   use axijoint_gmsh_section, only : data_line, end_section, read_count
   implicit none
   private
   public :: make_node_room, add_tag, read_position, make_element_room, check_type, read_element, &
      read_names

contains

   !> Read $PhysicalNames: a line for each group, dimension, number, "name"
   pure subroutine read_names(scanner, mesh, fault)
      !> The scanner, on the line $PhysicalNames
      type(scanner_type), intent(inout) :: scanner
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: i, n, dimension, tag, group

      call data_line(scanner, 'PhysicalNames', 'lines', 0, 1, fault)
      call read_count(scanner, 'the number of names', n, fault)
      do i = 1, n
         call data_line(scanner, 'PhysicalNames', 'names', i - 1, n, fault)
         call read_integer(scanner, 'the dimension', 0, 3, dimension, fault)
         call read_integer(scanner, 'the number of the group', 1, largest_tag, tag, fault)
         if (allocated(fault)) return
         if (find_group(mesh, dimension, tag) > 0) then
            fault = token_fault(scanner, group_text(mesh%groups(find_group(mesh, dimension, tag))) &
                                //' is named twice')
            return
         end if
         call group_index(mesh, dimension, tag, group)
         call read_name(scanner, mesh%groups(group)%name, fault)
      end do
      call end_section(scanner, 'PhysicalNames', fault)
   end subroutine read_names

   !> Read a name between quotation marks, to the end of the line
   pure subroutine read_name(scanner, name, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> The name without its marks
      character(len=:), allocatable, intent(out) :: name
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: first, last

      name = ''
      associate (rest => scanner%bytes(scanner%to + 1:scanner%last))
         first = index(rest, '"')
         last = index(rest, '"', back=.true.)
         if (last > first) then
            name = trim(adjustl(rest(first + 1:last - 1)))
         else
            fault = line_fault(scanner, 'the name of the group is not between quotation marks', &
                               allowed='dimension, number, "name"')
         end if
      end associate
   end subroutine read_name

   !> Room for nodes
   pure subroutine make_node_room(mesh, n)
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> How many
      integer, intent(in) :: n

      allocate (mesh%node_tag(n), mesh%node_line(n), source=0)
      allocate (mesh%position(3, n), source=0.0_wp)
   end subroutine make_node_room

   !> Read the number of a new node. Nothing is done after a fault
   pure subroutine add_tag(scanner, mesh, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: tag, known

      call read_integer(scanner, 'the number of the node', 1, largest_tag, tag, fault)
      if (allocated(fault)) return
      known = find_number(mesh%node_of, tag)
      if (known > 0) then
         fault = token_fault(scanner, 'node '//to_text(tag)//' is given twice, first on line '// &
                             to_text(mesh%node_line(known)))
         return
      end if
      mesh%n_nodes = mesh%n_nodes + 1
      mesh%node_tag(mesh%n_nodes) = tag
      mesh%node_line(mesh%n_nodes) = scanner%line
      call insert_number(mesh%node_of, tag, mesh%n_nodes)
   end subroutine add_tag

   !> Read the coordinates of a node. Nothing is done after a fault
   pure subroutine read_position(scanner, position, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> x, y, z
      real(wp), intent(out) :: position(3)
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      call read_real(scanner, 'x', position(1), fault)
      call read_real(scanner, 'y', position(2), fault)
      call read_real(scanner, 'z', position(3), fault)
   end subroutine read_position

   !> Room for elements
   pure subroutine make_element_room(mesh, n)
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> How many
      integer, intent(in) :: n

      allocate (mesh%element_tag(n), mesh%element_type(n), mesh%element_line(n), &
         mesh%element_set(n), &
                source=0)
      allocate (mesh%element_nodes(most_nodes, n), source=0)
   end subroutine make_element_room

   !> Refuse types of elements that cannot be used. Nothing is done after a fault
   pure subroutine check_type(scanner, number, fault)
      !> The scanner, behind the number of the type
      type(scanner_type), intent(in) :: scanner
      !> Gmsh's number of the type
      integer, intent(in) :: number
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      character(len=:), allocatable :: mend

      if (allocated(fault)) return
      if (nodes_of_type(number) > 0) return
      mend = 'set Mesh.ElementOrder to 1 or 2'
      if (any(number == [4, 5, 6, 7, 11, 12, 13, 14, 17, 18, 19, 29, 30, 31])) then
         mend = 'mesh plane surfaces only: gmsh -2'
      end if
      fault = token_fault(scanner, 'an element of type '//to_text(number)//' ('//type_name(number) &
                          //') cannot be used', &
                          allowed='triangles of 3 or 6, quadrangles of 4, 8 or 9, lines of 2 '// &
                          'or 3 nodes; ' &
                          //'points', &
                          mend=mend)
   end subroutine check_type

   !> Read the nodes of an element and add it; points are passed over. Nothing is done after a fault
   pure subroutine read_element(scanner, mesh, tag, type, set, fault)
      !> The scanner, before the nodes
      type(scanner_type), intent(inout) :: scanner
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> Number and type
      integer, intent(in) :: tag, type
      !> Set of groups, 0 if there is none
      integer, intent(in) :: set
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: i, label, n, nodes(most_nodes)

      if (allocated(fault)) return
      n = nodes_of_type(type)
      nodes = 0
      do i = 1, n
         call read_integer(scanner, 'a node', 1, largest_tag, label, fault)
         if (allocated(fault)) return
         nodes(i) = find_number(mesh%node_of, label)
         if (nodes(i) == 0) then
            fault = token_fault(scanner, 'node '//to_text(label)//' is not in $Nodes')
         else if (any(nodes(:i - 1) == nodes(i))) then
            fault = token_fault(scanner, 'the element has node '//to_text(label)//' twice')
         end if
      end do
      call end_line(scanner, to_text(n)//' nodes at the end of the line', fault)
      if (allocated(fault) .or. dimension_of_type(type) == 0) return
      n = mesh%n_elements + 1
      mesh%n_elements = n
      mesh%element_tag(n) = tag
      mesh%element_type(n) = type
      mesh%element_line(n) = scanner%line
      mesh%element_set(n) = set
      mesh%element_nodes(:, n) = nodes
   end subroutine read_element

end module axijoint_gmsh_parts
