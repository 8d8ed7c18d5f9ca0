!> Entities, nodes and elements in format 4.1
module axijoint_gmsh_format_4
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_gmsh_mesh, only : gmsh_mesh_type, dimension_of_type, nodes_of_type, group_index, &
      set_index
   use axijoint_gmsh_parts, only : make_node_room, add_tag, read_position, make_element_room, &
      check_type, read_element
   use axijoint_gmsh_scanner, only : scanner_type, fault_type, read_integer, read_real, end_line, &
      token_fault, largest_tag
   use axijoint_gmsh_section, only : data_line, end_section, read_count, count_fault
   implicit none
   private
   public :: entities_type, read_entities, read_nodes_4, read_elements_4

   !> Sets of groups of the points, curves, surfaces and volumes of the geometry
   type :: entities_type
      !> Place of each entity in `set` by its number, for each dimension
      type(number_map_type) :: place_of(0:3)
      !> Sets
      integer, allocatable :: set(:)
   end type entities_type

contains

   !> Read $Entities: points, curves, surfaces and volumes with their physical groups
   pure subroutine read_entities(scanner, mesh, entities, fault)
      !> The scanner, on the line $Entities
      type(scanner_type), intent(inout) :: scanner
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> The entities
      type(entities_type), intent(out) :: entities
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: i, n(0:3), dimension, total, tag, set

      call data_line(scanner, 'Entities', 'lines', 0, 1, fault)
      do dimension = 0, 3
         call read_count(scanner, 'the number of entities', n(dimension), fault)
      end do
      call end_line(scanner, 'the numbers of points, curves, surfaces and volumes', fault)
      allocate (entities%set(0))
      if (allocated(fault)) return
      total = 0
      do dimension = 0, 3
         do i = 1, n(dimension)
            call data_line(scanner, 'Entities', 'entities', total, sum(n), fault)
            call read_entity(scanner, dimension, mesh, tag, set, fault)
            if (allocated(fault)) return
            total = total + 1
            if (tag == 0) cycle
            entities%set = [entities%set, set]
            call insert_number(entities%place_of(dimension), tag, size(entities%set))
         end do
      end do
      call end_section(scanner, 'Entities', fault)
   end subroutine read_entities

   !> Read one entity: number, corners of its box, physical groups, boundary
   pure subroutine read_entity(scanner, dimension, mesh, tag, set, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> Dimension
      integer, intent(in) :: dimension
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> Number
      integer, intent(out) :: tag
      !> Set of its groups; 0 if it is in none
      integer, intent(out) :: set
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: i, n, physical
      integer, allocatable :: groups(:)
      real(wp) :: passed

      call read_integer(scanner, 'the number of the entity', -largest_tag, largest_tag, tag, fault)
      do i = 1, merge(3, 6, dimension == 0)
         call read_real(scanner, 'a coordinate of the entity', passed, fault)
      end do
      call read_count(scanner, 'the number of physical groups', n, fault)
      set = 0
      if (allocated(fault)) return
      allocate (groups(n))
      do i = 1, n
         call read_integer(scanner, 'the number of a physical group', -largest_tag, largest_tag, &
                           physical, fault)
         if (.not. allocated(fault) .and. physical == 0) then
            fault = token_fault(scanner, 'a physical group has the number 0')
         end if
         if (allocated(fault)) return
         call group_index(mesh, dimension, physical, groups(i))
      end do
      call set_index(mesh, groups, set)
   end subroutine read_entity

   !> Read $Nodes: blocks of numbers, then coordinates
   pure subroutine read_nodes_4(scanner, mesh, fault)
      !> The scanner, on the line $Nodes
      type(scanner_type), intent(inout) :: scanner
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: block, n_blocks, n, n_block, dimension, passed, parametric, i, before

      call read_head(scanner, 'Nodes', 'nodes', n_blocks, n, fault)
      call make_node_room(mesh, n)
      do block = 1, n_blocks
         before = mesh%n_nodes
         call data_line(scanner, 'Nodes', 'blocks', block - 1, n_blocks, fault)
         call read_integer(scanner, 'the dimension', 0, 3, dimension, fault)
         call read_integer(scanner, 'the number of the entity', -largest_tag, largest_tag, passed, &
            fault)
         call read_integer(scanner, 'the mark of parameters', 0, 1, parametric, fault)
         call read_integer(scanner, 'the number of nodes', 0, n - before, n_block, fault)
         call end_line(scanner, 'dimension and number of the entity, 0 or 1, number of nodes', &
            fault)
         do i = 1, n_block
            call data_line(scanner, 'Nodes', 'nodes', before, n, fault)
            call add_tag(scanner, mesh, fault)
            call end_line(scanner, 'the number of one node', fault)
            if (allocated(fault)) return
         end do
         do i = before + 1, before + n_block
            call data_line(scanner, 'Nodes', 'nodes', i - 1, n, fault)
            call read_position(scanner, mesh%position(:, i), fault)
            if (parametric == 0) call end_line(scanner, 'x, y, z', fault)
            if (allocated(fault)) return
            mesh%node_line(i) = scanner%line
         end do
         if (allocated(fault)) return
      end do
      call count_fault(scanner, 'Nodes', 'nodes', mesh%n_nodes, n, fault)
      call end_section(scanner, 'Nodes', fault)
   end subroutine read_nodes_4

   !> Read the first line of $Nodes or $Elements: numbers of blocks and of things, and the least and
   !> the largest number of a thing
   pure subroutine read_head(scanner, section, noun, n_blocks, n, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> Name of the section, and what it counts
      character(len=*), intent(in) :: section, noun
      !> Numbers of blocks and of things
      integer, intent(out) :: n_blocks, n
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: passed

      call data_line(scanner, section, 'lines', 0, 1, fault)
      call read_count(scanner, 'the number of blocks', n_blocks, fault)
      call read_count(scanner, 'the number of '//noun, n, fault)
      call read_integer(scanner, 'the least number', 0, largest_tag, passed, fault)
      call read_integer(scanner, 'the largest number', 0, largest_tag, passed, fault)
      call end_line(scanner, 'four numbers: blocks, '//noun//', least and largest number', fault)
   end subroutine read_head

   !> Read $Elements: blocks of elements of one entity and type
   pure subroutine read_elements_4(scanner, entities, mesh, fault)
      !> The scanner, on the line $Elements
      type(scanner_type), intent(inout) :: scanner
      !> Entities of the geometry
      type(entities_type), intent(in) :: entities
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer :: block, n_blocks, n, n_block, n_read, entity, dimension, type, set, tag, i

      call read_head(scanner, 'Elements', 'elements', n_blocks, n, fault)
      call make_element_room(mesh, n)
      n_read = 0
      do block = 1, n_blocks
         call data_line(scanner, 'Elements', 'blocks', block - 1, n_blocks, fault)
         call read_integer(scanner, 'the dimension', 0, 3, dimension, fault)
         call read_integer(scanner, 'the number of the entity', -largest_tag, largest_tag, entity, &
            fault)
         call read_integer(scanner, 'the type', 1, largest_tag, type, fault)
         call check_type(scanner, type, fault)
         call check_dimension(scanner, dimension, type, fault)
         call read_integer(scanner, 'the number of elements', 0, n - n_read, n_block, fault)
         call end_line(scanner, 'dimension and number of the entity, type, number of elements', &
            fault)
         if (allocated(fault)) return
         set = set_of(entities, dimension, entity)
         do i = 1, n_block
            call data_line(scanner, 'Elements', 'elements', n_read, n, fault)
            call read_integer(scanner, 'the number of the element', 1, largest_tag, tag, fault)
            call read_element(scanner, mesh, tag, type, set, fault)
            if (allocated(fault)) return
            n_read = n_read + 1
         end do
      end do
      call count_fault(scanner, 'Elements', 'elements', n_read, n, fault)
      call end_section(scanner, 'Elements', fault)
   end subroutine read_elements_4

   !> See that elements fit their entity. Nothing is done after a fault
   pure subroutine check_dimension(scanner, dimension, type, fault)
      !> The scanner, behind the type
      type(scanner_type), intent(in) :: scanner
      !> Dimension of the entity, and type of the elements
      integer, intent(in) :: dimension, type
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      if (allocated(fault)) return
      if (dimension_of_type(type) == dimension) return
      fault = token_fault(scanner, 'elements of type '//to_text(type)// &
         ' do not fit an entity of dimension ' &
                          //to_text(dimension))
   end subroutine check_dimension

   !> Set of groups of an entity; 0 if it is in none
   pure integer function set_of(entities, dimension, tag) result(set)
      !> The entities
      type(entities_type), intent(in) :: entities
      !> Dimension and number of the entity
      integer, intent(in) :: dimension, tag

      integer :: place

      set = 0
      place = find_number(entities%place_of(dimension), tag)
      if (place > 0) set = entities%set(place)
   end function set_of

end module axijoint_gmsh_format_4
