!> Nodes, solid elements and joints of the meridional plane
module axijoint_model_mesh
   use axijoint_base_kinds, only : wp
   use axijoint_fe_element_kind, only : element_kind_type, kind_choice_type, chosen_kind, find_kind
   use axijoint_fe_reference, only : reference_type, new_reference
   use axijoint_fe_shape, only : n_corners
   implicit none
   private
   public :: mesh_type, edge_nodes, n_nodes, n_elements, n_joints, set_kinds, element_references
   public :: max_element_nodes

   !> Nodes of the largest solid element
   integer, parameter :: max_element_nodes = 9
   !> Nodes of the largest joint
   integer, parameter :: max_joint_nodes = 6

   !> The mesh. Nodes, elements and joints are numbered from 1 without gaps;
   !> labels are the numbers that the user gave or that generation gave.
   type :: mesh_type
      !> r and z of each node, shape (2, nodes) [length]
      real(wp), allocatable :: coordinates(:, :)
      !> The user's number of each node
      integer, allocatable :: node_label(:)
      !> Further numbers of nodes that bodies share: number in `node_label`, further number; shape
      !> (2, further numbers)
      integer, allocatable :: shared_label(:, :)
      !> The user's number of each solid element
      integer, allocatable :: element_label(:)
      !> Index of each element's material in the model
      integer, allocatable :: element_material(:)
      !> Body that each element belongs to; bodies meet in joints, and share nodes if bonded
      integer, allocatable :: element_body(:)
      !> Number of nodes of each element: 3 or 6 of a triangle, 4, 8 or 9 of a quadrilateral
      integer, allocatable :: element_size(:)
      !> Kind of each element: place among `kinds`, which have its number of nodes, too
      integer, allocatable :: element_kind(:)
      !> The kinds of elements: nodes, rule, formulation
      type(element_kind_type), allocatable :: kinds(:)
      !> Nodes of each element, shape (max_element_nodes, elements): corners
      !> counterclockwise in the (r, z) plane, mid-side nodes in the same
      !> sense beginning between corners 1 and 2, centre; zeros beyond
      integer, allocatable :: element_nodes(:, :)
      !> The user's number of each joint
      integer, allocatable :: joint_label(:)
      !> Index of each joint's material in the model
      integer, allocatable :: joint_material(:)
      !> Number of nodes of each joint: 4 or 6
      integer, allocatable :: joint_size(:)
      !> Nodes of each joint, shape (max_joint_nodes, joints), as in Fig. 2 of
      !> the paper: 1-2 along one side, 4-3 opposite (4 faces 1, 3 faces 2);
      !> 5 and 6 are the mid-side nodes of 1-2 and 4-3; zeros beyond
      integer, allocatable :: joint_nodes(:, :)
      !> Interface (index) of the model that each joint belongs to; 0 if to none
      integer, allocatable :: joint_interface(:)
   end type mesh_type

contains

   !> Number of nodes
   pure integer function n_nodes(mesh)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      n_nodes = size(mesh%node_label)
   end function n_nodes

   !> Number of solid elements
   pure integer function n_elements(mesh)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      n_elements = size(mesh%element_label)
   end function n_elements

   !> Number of joints
   pure integer function n_joints(mesh)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      n_joints = size(mesh%joint_label)
   end function n_joints

   !> Give all elements the kinds of one choice
   pure subroutine set_kinds(mesh, choice)
      !> The mesh; the sizes of its elements are known
      type(mesh_type), intent(inout) :: mesh
      !> Rules and formulation
      type(kind_choice_type), intent(in) :: choice

      integer :: element

      mesh%kinds = [element_kind_type ::]
      mesh%element_kind = mesh%element_size
      do element = 1, n_elements(mesh)
         call find_kind(mesh%kinds, chosen_kind(choice, mesh%element_size(element)), &
            mesh%element_kind(element))
      end do
   end subroutine set_kinds

   !> The kinds of elements with their integration points: the one place that tells how many points
   !> an element has, and where
   pure function element_references(mesh) result(references)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> One a kind; that of an element is references(mesh%element_kind(element))
      type(reference_type), allocatable :: references(:)

      references = new_reference(mesh%kinds)
   end function element_references

   !> Nodes of a side of an element: first and last as they follow round the element, and the
   !> middle one of a quadratic element
   pure function edge_nodes(mesh, element, side) result(nodes)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Element and side
      integer, intent(in) :: element, side
      !> Two or three nodes
      integer, allocatable :: nodes(:)

      associate (n => mesh%element_size(element), all_nodes => mesh%element_nodes(:, element))
         nodes = all_nodes([side, mod(side, n_corners(n)) + 1])
         if (n > 4) nodes = [nodes, all_nodes(n_corners(n) + side)]
      end associate
   end function edge_nodes

end module axijoint_model_mesh
