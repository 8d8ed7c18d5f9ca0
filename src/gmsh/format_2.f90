!> Nodes and elements in format 2.2
module axijoint_gmsh_format_2
   use axijoint_gmsh_mesh, only : gmsh_mesh_type, dimension_of_type, group_index, set_index
   use axijoint_gmsh_parts, only : make_node_room, add_tag, read_position, make_element_room, &
      check_type, read_element
   use axijoint_gmsh_scanner, only : scanner_type, fault_type, read_integer, end_line, largest_tag
   use axijoint_gmsh_section, only : data_line, end_section, read_count
   implicit none
   private
   public :: read_nodes_2, read_elements_2

contains

   !> Read $Nodes: number, x, y, z; or $ParametricNodes: these, then the entity and coordinates on it, which are
   !> passed over
   pure subroutine read_nodes_2(scanner, section, mesh, fault)
      !> The scanner, on the line that opens the section
      type(scanner_type), intent(inout) :: scanner
      !> Name of the section
      character(len=*), intent(in) :: section
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: i, n

      call data_line(scanner, section, 'lines', 0, 1, fault)
      call read_count(scanner, 'the number of nodes', n, fault)
      call end_line(scanner, 'the number of nodes', fault)
      call make_node_room(mesh, n)
      do i = 1, n
         call data_line(scanner, section, 'nodes', i - 1, n, fault)
         call add_tag(scanner, mesh, fault)
         call read_position(scanner, mesh%position(:, i), fault)
         if (section == 'Nodes') call end_line(scanner, 'the number of the node, x, y, z', fault)
         if (allocated(fault)) return
      end do
      call end_section(scanner, section, fault)
   end subroutine read_nodes_2

   !> Read $Elements: number, type, number of tags, tags (the first is the physical group), nodes
   pure subroutine read_elements_2(scanner, mesh, fault)
      !> The scanner, on the line $Elements
      type(scanner_type), intent(inout) :: scanner
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: i, k, n, n_tags, tag, type, physical, passed, group, set
      integer :: last_physical, last_dimension, last_set

      call data_line(scanner, 'Elements', 'lines', 0, 1, fault)
      call read_count(scanner, 'the number of elements', n, fault)
      call end_line(scanner, 'the number of elements', fault)
      call make_element_room(mesh, n)
      last_physical = 0
      last_dimension = 0
      last_set = 0
      do i = 1, n
         call data_line(scanner, 'Elements', 'elements', i - 1, n, fault)
         call read_integer(scanner, 'the number of the element', 1, largest_tag, tag, fault)
         call read_integer(scanner, 'the type', 1, largest_tag, type, fault)
         call check_type(scanner, type, fault)
         call read_integer(scanner, 'the number of tags', 0, largest_tag, n_tags, fault)
         physical = 0
         do k = 1, n_tags
            call read_integer(scanner, 'a tag', -largest_tag, largest_tag, passed, fault)
            if (allocated(fault)) return
            if (k == 1) physical = passed
         end do
         if (allocated(fault)) return
         if (physical == 0) then
            set = 0
         else if (physical /= last_physical .or. dimension_of_type(type) /= last_dimension) then
            last_physical = physical
            last_dimension = dimension_of_type(type)
            call group_index(mesh, last_dimension, physical, group)
            call set_index(mesh, [group], last_set)
         end if
         if (physical /= 0) set = last_set
         call read_element(scanner, mesh, tag, type, set, fault)
         if (allocated(fault)) return
      end do
      call end_section(scanner, 'Elements', fault)
   end subroutine read_elements_2

end module axijoint_gmsh_format_2
