!> A mesh as a Gmsh file has it: nodes, elements, physical groups
module axijoint_gmsh_mesh
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type
   use axijoint_base_text, only : to_text
   implicit none
   private
   public :: gmsh_mesh_type, nodes_of_type, dimension_of_type, type_name, &
      find_group, group_index, set_index, group_text, most_nodes

   !> Most nodes of an element that can be used
   integer, parameter :: most_nodes = 9

   !> Types of elements that can be used, by the numbers of Gmsh, with their
   !> numbers of nodes and their dimensions: lines, triangles, quadrangles, points
   integer, parameter :: type_number(8) = [1, 8, 2, 9, 3, 16, 10, 15]
   integer, parameter :: type_nodes(8) = [2, 3, 3, 6, 4, 8, 9, 1]
   integer, parameter :: type_dimension(8) = [1, 1, 2, 2, 2, 2, 2, 0]

   !> A physical group
   type :: gmsh_group_type
      !> 0 point, 1 curve, 2 surface, 3 volume
      integer :: dimension = 0
      !> Its number
      integer :: tag = 0
      !> Its name; may be empty
      character(len=:), allocatable :: name
   end type gmsh_group_type

   !> Groups that an element belongs to
   type :: gmsh_set_type
      !> Their indices; negative if the element runs against the group's direction
      integer, allocatable :: groups(:)
   end type gmsh_set_type

   !> A mesh. Arrays may be longer than the counts
   type :: gmsh_mesh_type
      !> Number of nodes
      integer :: n_nodes = 0
      !> Number and line of each node in the file
      integer, allocatable :: node_tag(:), node_line(:)
      !> x, y, z, shape (3, nodes)
      real(wp), allocatable :: position(:, :)
      !> Nodes by number
      type(number_map_type) :: node_of
      !> Number of elements: lines, triangles and quadrangles
      integer :: n_elements = 0
      !> Number, type and line of each element in the file
      integer, allocatable :: element_tag(:), element_type(:), element_line(:)
      !> Set of groups of each element; 0 if it is in no group
      integer, allocatable :: element_set(:)
      !> Nodes (indices) in the order of Gmsh: corners, middles of sides, centre; shape (9,
      !> elements)
      integer, allocatable :: element_nodes(:, :)
      !> Physical groups
      type(gmsh_group_type), allocatable :: groups(:)
      !> Sets of groups
      type(gmsh_set_type), allocatable :: sets(:)
   end type gmsh_mesh_type

contains

   !> Number of nodes of a type of element; 0 if it cannot be used
   pure integer function nodes_of_type(number) result(n)
      !> Gmsh's number of the type
      integer, intent(in) :: number

      integer :: i

      i = findloc(type_number, number, 1)
      n = 0
      if (i > 0) n = type_nodes(i)
   end function nodes_of_type

   !> Dimension of a type of element that can be used
   pure integer function dimension_of_type(number) result(dimension)
      !> Gmsh's number of the type
      integer, intent(in) :: number
      dimension = type_dimension(findloc(type_number, number, 1))
   end function dimension_of_type

   !> Name of a type that cannot be used, for messages
   pure function type_name(number) result(name)
      !> Gmsh's number of the type
      integer, intent(in) :: number
      !> Its name
      character(len=:), allocatable :: name

      select case (number)
      case (4, 11, 29:31)
         name = 'a tetrahedron'
      case (5, 12, 17)
         name = 'a hexahedron'
      case (6, 13, 18)
         name = 'a prism'
      case (7, 14, 19)
         name = 'a pyramid'
      case (20:25)
         name = 'a triangle of order 3 or more'
      case (26:28)
         name = 'a line of order 3 or more'
      case (36:39)
         name = 'a quadrangle of order 3 or more'
      case default
         name = 'of another kind'
      end select
   end function type_name

   !> Index of a group; 0 if there is none
   pure integer function find_group(mesh, dimension, tag) result(group)
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> Dimension and number
      integer, intent(in) :: dimension, tag

      do group = 1, size(mesh%groups)
         if (mesh%groups(group)%tag == tag .and. mesh%groups(group)%dimension == dimension) return
      end do
      group = 0
   end function find_group

   !> Index of a group, which is added if it is new; with the sign of the number
   pure subroutine group_index(mesh, dimension, tag, group)
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> Dimension and number; negative against the direction of the group
      integer, intent(in) :: dimension, tag
      !> Index with its sign
      integer, intent(out) :: group

      group = find_group(mesh, dimension, abs(tag))
      if (group == 0) then
         mesh%groups = [mesh%groups, gmsh_group_type(dimension, abs(tag), '')]
         group = size(mesh%groups)
      end if
      group = sign(group, tag)
   end subroutine group_index

   !> Index of a set of groups, which is added if it is new; 0 for no group
   pure subroutine set_index(mesh, groups, set)
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> Indices of the groups with their signs
      integer, intent(in) :: groups(:)
      !> Index
      integer, intent(out) :: set

      set = 0
      if (size(groups) == 0) return
      do set = 1, size(mesh%sets)
         if (size(mesh%sets(set)%groups) /= size(groups)) cycle
         if (all(mesh%sets(set)%groups == groups)) return
      end do
      mesh%sets = [mesh%sets, gmsh_set_type(groups)]
   end subroutine set_index

   !> A group in words: physical curve "shaft"
   pure function group_text(group) result(text)
      !> The group
      type(gmsh_group_type), intent(in) :: group
      !> The text
      character(len=:), allocatable :: text

      character(len=7), parameter :: nouns(0:3) = ['point  ', 'curve  ', 'surface', 'volume ']

      text = 'physical '//trim(nouns(group%dimension))//' '
      if (len(group%name) > 0) then
         text = text//'"'//group%name//'"'
      else
         text = text//to_text(group%tag)
      end if
   end function group_text

end module axijoint_gmsh_mesh
