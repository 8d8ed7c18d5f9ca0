!> Nodes, elements and joints in the order of their numbers
module axijoint_deck_mesh_arrange
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : insert_number
   use axijoint_base_sort, only : ascending_order
   use axijoint_deck_mesh_draft, only : draft_type
   implicit none
   private
   public :: sort_nodes_and_elements, sort_joints

contains

   !> Put nodes and elements in the order of their numbers
   pure subroutine sort_nodes_and_elements(draft)
      !> The mesh
      type(draft_type), intent(inout) :: draft

      integer, allocatable :: order(:), place(:)
      integer :: i, n, m

      n = draft%n_nodes
      m = draft%n_elements
      order = ascending_order(real(draft%node_label(:n), wp))
      allocate (place(0:n), source=0)
      place(order) = [(i, i=1, n)]
      draft%node_label(:n) = draft%node_label(order)
      draft%node_card(:n) = draft%node_card(order)
      draft%node_body(:n) = draft%node_body(order)
      draft%node_good(:n) = draft%node_good(order)
      draft%position(:, :n) = draft%position(:, order)
      do i = 1, n
         call insert_number(draft%node_of, draft%node_label(i), i)
      end do
      do i = 1, m
         draft%element_nodes(:, i) = place(draft%element_nodes(:, i))
      end do
      order = ascending_order(real(draft%element_label(:m), wp))
      draft%element_label(:m) = draft%element_label(order)
      draft%element_card(:m) = draft%element_card(order)
      draft%element_material(:m) = draft%element_material(order)
      draft%element_body(:m) = draft%element_body(order)
      draft%element_size(:m) = draft%element_size(order)
      draft%element_good(:m) = draft%element_good(order)
      draft%element_nodes(:, :m) = draft%element_nodes(:, order)
   end subroutine sort_nodes_and_elements

   !> Put the joints in the order of their numbers
   pure subroutine sort_joints(draft)
      !> The mesh
      type(draft_type), intent(inout) :: draft

      integer, allocatable :: order(:)
      integer :: n

      n = draft%n_joints
      order = ascending_order(real(draft%joint_label(:n), wp))
      draft%joint_label(:n) = draft%joint_label(order)
      draft%joint_card(:n) = draft%joint_card(order)
      draft%joint_entry(:n) = draft%joint_entry(order)
      draft%joint_interface(:n) = draft%joint_interface(order)
      draft%joint_law(:n) = draft%joint_law(order)
      draft%joint_size(:n) = draft%joint_size(order)
      draft%joint_nodes(:, :n) = draft%joint_nodes(:, order)
   end subroutine sort_joints

end module axijoint_deck_mesh_arrange
