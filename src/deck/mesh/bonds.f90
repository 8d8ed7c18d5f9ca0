!> Nodes of bonded interfaces, merged so that bodies share them
module axijoint_deck_mesh_bonds
   use axijoint_base_number_map, only : insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, edge_type, place_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_model_interface, only : interface_type
   implicit none
   private
   public :: bond_edges, merge_bonded, check_bonded_joints

contains

   !> Note that the nodes of edges that match become one
   pure subroutine bond_edges(interface, a, b, draft)
      !> The interface; its bodies are found here
      type(interface_type), intent(in) :: interface
      !> Edges of both faces
      type(edge_type), intent(in) :: a(:), b(:)
      !> The mesh
      type(draft_type), intent(inout) :: draft

      integer :: i, k, n

      draft%interfaces = [draft%interfaces, interface]
      n = size(draft%interfaces)
      draft%interfaces(n)%bodies = draft%element_body([a(1)%element, b(1)%element])
      if (.not. allocated(draft%bonded_to)) draft%bonded_to = [(i, i=1, draft%n_nodes)]
      do i = 1, size(a)
         do k = 1, count(a(i)%nodes > 0)
            call unite(draft%bonded_to, a(i)%nodes(k), b(i)%nodes(k))
         end do
      end do
   end subroutine bond_edges

   !> Let two nodes, and all that are bonded to them, be one: the first of them
   pure subroutine unite(bonded_to, a, b)
      !> A node that each is bonded to, itself if none comes before it
      integer, intent(inout) :: bonded_to(:)
      !> The nodes
      integer, intent(in) :: a, b

      integer :: first(2)

      first = [first_of(bonded_to, a), first_of(bonded_to, b)]
      bonded_to(maxval(first)) = minval(first)
   end subroutine unite

   !> The first of the nodes that a node is one with
   pure integer function first_of(bonded_to, node) result(first)
      !> A node that each is bonded to
      integer, intent(in) :: bonded_to(:)
      !> The node
      integer, intent(in) :: node

      first = node
      do while (bonded_to(first) /= first)
         first = bonded_to(first)
      end do
   end function first_of

   !> Report joints with both ends bonded: they lie on edges that both bodies share
   subroutine check_bonded_joints(draft, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: joint, told_card

      if (.not. allocated(draft%bonded_to)) return
      told_card = 0
      do joint = 1, draft%n_joints
         associate (nodes => draft%joint_nodes(:4, joint), card => draft%joint_card(joint))
            if (any(nodes == 0) .or. card == told_card) cycle
            if (.not. (one(nodes(1), nodes(4)) .and. one(nodes(2), nodes(3)))) cycle
            told_card = card
            call add_error(diagnostics, card, 0, 0, 'joint '// &
                           to_text(draft%joint_label(joint))//' lies where the bodies are bonded', &
                           found='from '//place_text(draft%position(:, nodes(1)))//' to '// &
                           place_text(draft%position(:, nodes(2)))//', both bonded', &
                           allowed='one bonded end of a joint: the tip of a slit', &
                           mend='let the faces of the joints end where those of BONDED begin; '// &
                           'a slit between two tips needs two edges at least')
         end associate
      end do

   contains

      !> Whether two nodes are bonded
      pure logical function one(a, b)
         !> The nodes
         integer, intent(in) :: a, b

         one = first_of(draft%bonded_to, a) == first_of(draft%bonded_to, b)
      end function one
   end subroutine check_bonded_joints

   !> Merge the nodes that are bonded. Each keeps all of its numbers: they find the one node
   pure subroutine merge_bonded(draft, group)
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Number of each node's place
      integer, allocatable, intent(inout) :: group(:)

      integer, allocatable :: new(:), kept(:)
      integer :: i, k, n

      if (.not. allocated(draft%bonded_to)) return
      n = draft%n_nodes
      kept = pack([(i, i=1, n)], draft%bonded_to == [(i, i=1, n)])
      allocate (new(0:n), source=0)
      new(kept) = [(i, i=1, size(kept))]
      draft%bonded_labels = reshape([integer ::], [2, 0])
      do i = 1, n
         k = first_of(draft%bonded_to, i)
         new(i) = new(k)
         call insert_number(draft%node_of, draft%node_label(i), new(i))
         if (k == i) cycle
         draft%bonded_labels = reshape([draft%bonded_labels, draft%node_label([k, i])], &
                                       [2, size(draft%bonded_labels, 2) + 1])
      end do
      call keep_nodes(draft, kept)
      group = group(kept)
      do i = 1, draft%n_elements
         draft%element_nodes(:, i) = new(draft%element_nodes(:, i))
      end do
      do i = 1, draft%n_joints
         draft%joint_nodes(:, i) = new(draft%joint_nodes(:, i))
      end do
      do i = 1, size(draft%faces)
         do k = 1, size(draft%faces(i)%edges)
            draft%faces(i)%edges(k)%nodes = new(draft%faces(i)%edges(k)%nodes)
         end do
      end do
   end subroutine merge_bonded

   !> Keep some of the nodes
   pure subroutine keep_nodes(draft, kept)
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> The nodes, ascending
      integer, intent(in) :: kept(:)

      integer :: n

      n = size(kept)
      draft%node_label(:n) = draft%node_label(kept)
      draft%node_card(:n) = draft%node_card(kept)
      draft%node_body(:n) = draft%node_body(kept)
      draft%position(:, :n) = draft%position(:, kept)
      draft%node_good(:n) = draft%node_good(kept)
      draft%n_nodes = n
   end subroutine keep_nodes

end module axijoint_deck_mesh_bonds
