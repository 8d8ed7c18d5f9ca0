!> The mesh while it is being made: like the model's mesh, with the card that
!> each thing came from and what is known to be wrong with it
module axijoint_deck_mesh_draft
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_fe_element_kind, only : element_kind_type
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_interface, only : interface_type
   implicit none
   private
   public :: draft_type, edge_type, face_type, add_node, add_element, add_joint, new_draft
   public :: most_nodes, place_text, corners_known

   !> Most nodes, and most elements, of a deck: beyond, a number on a generation
   !> card is taken for a slip
   integer, parameter :: most_nodes = 20000000

   !> One element edge of a face
   type :: edge_type
      !> First and last node in the direction of the face; middle node or 0
      integer :: nodes(3) = 0
      !> Element
      integer :: element = 0
      !> Whether the element lies on the left of the direction first to last
      logical :: body_on_left = .false.
   end type edge_type

   !> A face of a body
   type :: face_type
      !> The user's number
      integer :: label = 0
      !> Card that defines it
      integer :: card = 0
      !> Its body
      integer :: body = 0
      !> Whether it is a chain of nodes; otherwise a straight line
      logical :: is_chain = .false.
      !> False if something is wrong with it
      logical :: good = .false.
      !> Its edges, one after another
      type(edge_type), allocatable :: edges(:)
   end type face_type

   !> The mesh in the making. Arrays may be longer than the counts
   type :: draft_type
      !> Number of nodes
      integer :: n_nodes = 0
      !> Number, card and body of each node; body 0 if no element uses it
      integer, allocatable :: node_label(:), node_card(:), node_body(:)
      !> r and z
      real(wp), allocatable :: position(:, :)
      !> Whether its position is known
      logical, allocatable :: node_good(:)
      !> Nodes by number
      type(number_map_type) :: node_of
      !> False if cards that make nodes are at fault
      logical :: nodes_complete = .true.
      !> Number of elements
      integer :: n_elements = 0
      !> Number, card, material (index), body and size of each element
      integer, allocatable :: element_label(:), element_card(:), element_material(:), &
         element_body(:), element_size(:)
      !> Nodes of each element in the model's order, shape (9, elements); 0
      !> where the node is not known
      integer, allocatable :: element_nodes(:, :)
      !> Kinds of elements, and place of each element's kind among them; chosen when all elements
      !> are there
      type(element_kind_type), allocatable :: kinds(:)
      integer, allocatable :: element_kind(:)
      !> Whether its shape is sound
      logical, allocatable :: element_good(:)
      !> False if cards that make elements are at fault
      logical :: elements_complete = .true.
      !> Number of joints
      integer :: n_joints = 0
      !> Number, card, law (index) and size of each joint
      integer, allocatable :: joint_label(:), joint_card(:), joint_law(:), joint_size(:)
      !> Entry of JOINTS, 0 for a joint of an interface; interface (index), 0 for one of JOINTS
      integer, allocatable :: joint_entry(:), joint_interface(:)
      !> Nodes of each joint, shape (6, joints); 0 where the node is not known
      integer, allocatable :: joint_nodes(:, :)
      !> Interfaces
      type(interface_type), allocatable :: interfaces(:)
      !> A node, itself or one before it, that each node becomes one with; unallocated if nothing
      !> is bonded
      integer, allocatable :: bonded_to(:)
      !> Numbers of nodes that have become one, the one in the tables first, shape (2, pairs)
      integer, allocatable :: bonded_labels(:, :)
      !> Faces
      type(face_type), allocatable :: faces(:)
      !> Faces by number
      type(number_map_type) :: face_of
      !> False if a card of FACES or CHAINS is at fault
      logical :: faces_complete = .true.
      !> Larger side of the rectangle around all nodes
      real(wp) :: extent = 0.0_wp
   end type draft_type

contains

   !> A draft without nodes, elements, joints and faces
   pure function new_draft() result(draft)
      !> The empty draft
      type(draft_type) :: draft

      integer, parameter :: room = 16

      call resize_nodes(draft, room)
      call resize_elements(draft, room)
      call resize_joints(draft, room)
      allocate (draft%faces(0), draft%interfaces(0), draft%bonded_labels(2, 0))
   end function new_draft

   !> Add a node
   pure subroutine add_node(draft, label, card, position, good)
      !> The draft
      type(draft_type), intent(inout) :: draft
      !> Number and card
      integer, intent(in) :: label, card
      !> r and z
      real(wp), intent(in) :: position(2)
      !> Whether the position is known
      logical, intent(in) :: good

      integer :: n

      n = draft%n_nodes + 1
      if (n > size(draft%node_label)) call resize_nodes(draft, 2*n)
      draft%node_label(n) = label
      draft%node_card(n) = card
      draft%node_body(n) = 0
      draft%position(:, n) = position
      draft%node_good(n) = good
      draft%n_nodes = n
      call insert_number(draft%node_of, label, n)
   end subroutine add_node

   !> Add an element
   pure subroutine add_element(draft, label, card, material, body, nodes)
      !> The draft
      type(draft_type), intent(inout) :: draft
      !> Number, card, material (index) and body
      integer, intent(in) :: label, card, material, body
      !> Nodes in the model's order; 0 where one is not known
      integer, intent(in) :: nodes(:)

      integer :: n

      n = draft%n_elements + 1
      if (n > size(draft%element_label)) call resize_elements(draft, 2*n)
      draft%element_label(n) = label
      draft%element_card(n) = card
      draft%element_material(n) = material
      draft%element_body(n) = body
      draft%element_size(n) = size(nodes)
      draft%element_nodes(:, n) = 0
      draft%element_nodes(:size(nodes), n) = nodes
      draft%element_good(n) = all(nodes > 0)
      draft%n_elements = n
   end subroutine add_element

   !> Add a joint
   pure subroutine add_joint(draft, label, card, law, nodes, entry, interface)
      !> The draft
      type(draft_type), intent(inout) :: draft
      !> Number, card and law (index)
      integer, intent(in) :: label, card, law
      !> Nodes; 0 where one is not known
      integer, intent(in) :: nodes(:)
      !> Entry of JOINTS, or interface (index) that it belongs to
      integer, intent(in), optional :: entry, interface

      integer :: n

      n = draft%n_joints + 1
      if (n > size(draft%joint_label)) call resize_joints(draft, 2*n)
      draft%joint_label(n) = label
      draft%joint_card(n) = card
      if (present(entry)) draft%joint_entry(n) = entry
      if (present(interface)) draft%joint_interface(n) = interface
      draft%joint_law(n) = law
      draft%joint_size(n) = size(nodes)
      draft%joint_nodes(:, n) = 0
      draft%joint_nodes(:size(nodes), n) = nodes
      draft%n_joints = n
   end subroutine add_joint

   !> Whether the corners of all elements are known
   pure logical function corners_known(draft)
      !> The draft
      type(draft_type), intent(in) :: draft

      integer :: element

      corners_known = .true.
      do element = 1, draft%n_elements
         associate (n => n_corners(draft%element_size(element)))
            if (any(draft%element_nodes(:n, element) == 0)) corners_known = .false.
         end associate
      end do
   end function corners_known

   !> Change the room for nodes
   pure subroutine resize_nodes(draft, room)
      !> The draft
      type(draft_type), intent(inout) :: draft
      !> Room for so many
      integer, intent(in) :: room

      real(wp), allocatable :: position(:, :)
      logical, allocatable :: good(:)

      call resize(draft%node_label, draft%n_nodes, room)
      call resize(draft%node_card, draft%n_nodes, room)
      call resize(draft%node_body, draft%n_nodes, room)
      allocate (position(2, room), source=0.0_wp)
      allocate (good(room), source=.false.)
      if (draft%n_nodes > 0) then
         position(:, :draft%n_nodes) = draft%position(:, :draft%n_nodes)
         good(:draft%n_nodes) = draft%node_good(:draft%n_nodes)
      end if
      call move_alloc(position, draft%position)
      call move_alloc(good, draft%node_good)
   end subroutine resize_nodes

   !> Change the room for elements
   pure subroutine resize_elements(draft, room)
      !> The draft
      type(draft_type), intent(inout) :: draft
      !> Room for so many
      integer, intent(in) :: room

      integer, allocatable :: nodes(:, :)
      logical, allocatable :: good(:)

      call resize(draft%element_label, draft%n_elements, room)
      call resize(draft%element_card, draft%n_elements, room)
      call resize(draft%element_material, draft%n_elements, room)
      call resize(draft%element_body, draft%n_elements, room)
      call resize(draft%element_size, draft%n_elements, room)
      allocate (nodes(9, room), source=0)
      allocate (good(room), source=.false.)
      if (draft%n_elements > 0) then
         nodes(:, :draft%n_elements) = draft%element_nodes(:, :draft%n_elements)
         good(:draft%n_elements) = draft%element_good(:draft%n_elements)
      end if
      call move_alloc(nodes, draft%element_nodes)
      call move_alloc(good, draft%element_good)
   end subroutine resize_elements

   !> Change the room for joints
   pure subroutine resize_joints(draft, room)
      !> The draft
      type(draft_type), intent(inout) :: draft
      !> Room for so many
      integer, intent(in) :: room

      integer, allocatable :: nodes(:, :)

      call resize(draft%joint_label, draft%n_joints, room)
      call resize(draft%joint_card, draft%n_joints, room)
      call resize(draft%joint_entry, draft%n_joints, room)
      call resize(draft%joint_interface, draft%n_joints, room)
      call resize(draft%joint_law, draft%n_joints, room)
      call resize(draft%joint_size, draft%n_joints, room)
      allocate (nodes(6, room), source=0)
      if (draft%n_joints > 0) nodes(:, :draft%n_joints) = draft%joint_nodes(:, :draft%n_joints)
      call move_alloc(nodes, draft%joint_nodes)
   end subroutine resize_joints

   !> Change the room of an array of integers
   pure subroutine resize(values, n, room)
      !> The array
      integer, allocatable, intent(inout) :: values(:)
      !> Values in use, and room for so many
      integer, intent(in) :: n, room

      integer, allocatable :: larger(:)

      allocate (larger(room), source=0)
      if (n > 0) larger(:n) = values(:n)
      call move_alloc(larger, values)
   end subroutine resize

   !> A place for messages: "r = 0.5, z = 1"
   pure function place_text(position) result(text)
      !> r and z
      real(wp), intent(in) :: position(2)
      !> The text
      character(len=:), allocatable :: text

      text = 'r = '//to_text(position(1))//', z = '//to_text(position(2))
   end function place_text

end module axijoint_deck_mesh_draft
