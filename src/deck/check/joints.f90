!> Whether joints fit the edges of the elements on their two sides
module axijoint_deck_check_joints
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, edge_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type, find_edge, outer_edge
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_entry, only : entry_type, field_named, field_fault, card_fault
   use axijoint_model_material, only : joint_material_type, rule_centroid
   implicit none
   private
   public :: check_joints, check_joint_edges

contains

   !> Check the joints of the JOINTS cards
   subroutine check_joints(cards, laws, group, edges, draft)
      !> The cards of JOINTS
      class(entry_type), intent(in) :: cards
      !> Laws
      type(joint_material_type), intent(in) :: laws(:)
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft

      class(entry_type), allocatable :: card
      integer :: joint, n, errors_before

      card = cards
      do joint = 1, draft%n_joints
         card%entry = draft%joint_entry(joint)
         n = draft%joint_size(joint)
         if (card%entry == 0) cycle
         associate (nodes => draft%joint_nodes(:n, joint), law => draft%joint_law(joint))
            if (law > 0 .and. n == 6) then
               if (laws(law)%rule == rule_centroid) then
                  call field_fault(card, field_named(card, 'the law'), &
                                   'the rule CENTROID is for joints of four nodes; this one '// &
                                   'has six', &
                                   mend='choose the rule GAUSS or LOBATTO in LAWS')
               end if
            end if
            if (any(nodes == 0)) cycle
            if (.not. all(draft%node_good(nodes))) cycle
            errors_before = card%diagnostics%n_errors
            call check_pairs(card, nodes, group, draft)
            if (card%diagnostics%n_errors > errors_before) cycle
            call check_sides(card, nodes, edges, draft)
            if (card%diagnostics%n_errors > errors_before) cycle
            call check_orientation(card, nodes, edges, draft)
         end associate
      end do
   end subroutine check_joints

   !> Check that the nodes of a joint coincide in pairs
   subroutine check_pairs(card, nodes, group, draft)
      !> The card
      class(entry_type), intent(in) :: card
      !> Nodes of the joint
      integer, intent(in) :: nodes(:)
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> The mesh
      type(draft_type), intent(in) :: draft

      integer, parameter :: lower(3) = [1, 2, 5], upper(3) = [4, 3, 6]
      character(len=:), allocatable :: mend
      integer :: i

      mend = ''
      if (group(nodes(1)) == group(nodes(3)) .and. group(nodes(2)) == group(nodes(4))) then
         mend = 'exchange the third and the fourth node'
      end if
      do i = 1, size(nodes)/2
         associate (a => nodes(lower(i)), b => nodes(upper(i)))
            if (group(a) == group(b)) cycle
            call card_fault(card, &
                             'nodes '//to_text(draft%node_label(a))//' and '// &
                             to_text(draft%node_label(b))// &
                             ' do not coincide', &
                             found=place_text(draft%position(:, a))//'; '// &
                             place_text(draft%position(:, b)), &
                             allowed='4 at the place of 1, 3 at the place of 2, 6 at the place '// &
                             'of 5', mend=mend)
            if (len(mend) > 0) return
         end associate
      end do
      if (group(nodes(1)) == group(nodes(2))) then
         call card_fault(card, 'the joint has no length', &
                          found='both ends at '//place_text(draft%position(:, nodes(1))))
      else if (.not. any(draft%position(1, nodes(:2)) > 0.0_wp)) then
         call card_fault(card, 'the joint lies on the axis, where it has no area', &
                          allowed='r > 0 at one end at least')
      end if
   end subroutine check_pairs

   !> Check that each side of a joint is an outer edge of matching order
   subroutine check_sides(card, nodes, edges, draft)
      !> The card
      class(entry_type), intent(in) :: card
      !> Nodes of the joint
      integer, intent(in) :: nodes(:)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft

      integer :: wanted(2)

      wanted = 0
      if (size(nodes) == 6) wanted = nodes(5:6)
      call check_side(card, [nodes(1), nodes(2), wanted(1)], edges, draft)
      call check_side(card, [nodes(4), nodes(3), wanted(2)], edges, draft)
   end subroutine check_sides

   !> Check one side of a joint
   subroutine check_side(card, nodes, edges, draft)
      !> The card
      class(entry_type), intent(in) :: card
      !> First, last and middle node of the side; middle 0 in a 4-node joint
      integer, intent(in) :: nodes(3)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft

      character(len=:), allocatable :: fault, mend
      integer :: edge

      edge = find_edge(edges, nodes(1), nodes(2))
      mend = ''
      if (edge == 0) then
         fault = 'is the edge of no element'
      else if (edges%twin(edge) /= 0) then
         fault = 'is inside a body'
      else if (edges%nodes(3, edge) > 0 .and. nodes(3) == 0) then
         fault = 'belongs to an element with middle nodes'
         mend = 'give the joint six nodes'
      else if (edges%nodes(3, edge) == 0 .and. nodes(3) > 0) then
         fault = 'belongs to an element without middle nodes'
         mend = 'give the joint four nodes'
      else if (edges%nodes(3, edge) /= nodes(3)) then
         fault = 'has the middle node '//to_text(draft%node_label(edges%nodes(3, edge)))
      else
         return
      end if
      call card_fault(card, 'side '//to_text(draft%node_label(nodes(1)))//'-'// &
                       to_text(draft%node_label(nodes(2)))//' of the joint '//fault, &
                       allowed='outer edges of elements with the same nodes as the joint', &
                       mend=mend)
   end subroutine check_side

   !> Check that the body of side 4-3 lies on the left of the direction from 1 to 2,
   !> where eta points, and the other on the right
   subroutine check_orientation(card, nodes, edges, draft)
      !> The card
      class(entry_type), intent(in) :: card
      !> Nodes of the joint
      integer, intent(in) :: nodes(:)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft

      type(edge_type) :: lower, upper
      character(len=:), allocatable :: turned
      integer :: i
      integer, parameter :: order(6) = [2, 1, 4, 3, 5, 6]

      lower = outer_edge(draft, edges, find_edge(edges, nodes(1), nodes(2)), nodes(1))
      upper = outer_edge(draft, edges, find_edge(edges, nodes(4), nodes(3)), nodes(4))
      if (upper%body_on_left .and. .not. lower%body_on_left) return
      if (upper%body_on_left .eqv. lower%body_on_left) then
         call card_fault(card, 'the elements on both sides of the joint overlap', &
                          allowed='elements on opposite sides')
         return
      end if
      turned = ''
      do i = 1, size(nodes)
         turned = turned//' '//to_text(draft%node_label(nodes(order(i))))
      end do
      call card_fault(card, 'the joint is reversed: its opening would count as contact', &
                       allowed='the element of side 4-3 on the left of the direction from node '// &
                       '1 to node 2', &
                       mend='write the nodes as'//turned)
   end subroutine check_orientation

   !> Report edges with more than one joint
   subroutine check_joint_edges(edges, draft, diagnostics)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: joint_on(:)
      integer :: joint, side, edge, told_card
      integer, parameter :: first(2) = [1, 4], last(2) = [2, 3]

      allocate (joint_on(edges%n), source=0)
      told_card = 0
      do joint = 1, draft%n_joints
         associate (nodes => draft%joint_nodes(:, joint))
            if (any(nodes(:4) == 0)) cycle
            do side = 1, 2
               edge = find_edge(edges, nodes(first(side)), nodes(last(side)))
               if (edge == 0) cycle
               if (joint_on(edge) > 0 .and. draft%joint_card(joint) /= told_card) then
                  told_card = draft%joint_card(joint)
                  call add_error(diagnostics, told_card, 0, 0, 'joints '// &
                                 to_text(draft%joint_label(joint_on(edge)))//' and '// &
                                 to_text(draft%joint_label(joint))//' lie on the same edge '// &
                                 to_text(draft%node_label(nodes(first(side))))//'-'// &
                                 to_text(draft%node_label(nodes(last(side)))), &
                                 allowed='one joint on an edge')
               end if
               joint_on(edge) = joint
            end do
         end associate
      end do
   end subroutine check_joint_edges

end module axijoint_deck_check_joints
