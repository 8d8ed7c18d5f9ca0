!> JOINTS: joints one by one
module axijoint_deck_section_joints
   use axijoint_base_number_map, only : number_map_type, find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_joints
   use axijoint_deck_mesh_draft, only : draft_type, add_joint
   use axijoint_deck_property_properties, only : find_law
   use axijoint_deck_text_common_fields, only : number, nodes_field => nodes
   use axijoint_deck_text_entry, only : integer_of, is_good, &
      field_fault, lack_fault, card_fault, first_card
   use axijoint_deck_text_field, only : described
   use axijoint_deck_text_labels, only : check_label
   implicit none
   private
   public :: joints_section, keyword_joints

   !> The keyword
   character(len=*), parameter :: keyword_joints = 'JOINTS'
   !> Fields; nodes from `field_node` on
   integer, parameter :: field_label = 1, field_law = 2, field_node = 3

contains

   !> JOINTS
   function joints_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_joints
      section%purpose = 'joints one by one'
      section%numbered = .true.
      section%stage = stage_joints
      section%read => read_joints
      section%fields = [number('the joint', 1), &
                        described(number('the law', 6), 'law', limits='of LAWS'), &
                        described(nodes_field('node', 6, 4, 11), 'nodes 1 2 3 4, or 1 2 3 4 5 6')]
   end function joints_section

   !> Add the joints
   subroutine read_joints(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(number_map_type) :: seen
      integer :: law, n, nodes(6)

      card = cards_of(deck, keyword_joints)
      do while (next_card(card))
         call check_label(card, field_label, 'joint', seen)
         call find_law(card, field_law, deck%properties, law)
         if (.not. is_good(card)) cycle
         associate (given => card%table%given(field_node:, card%entry))
            n = count(given)
            if (all(n /= [4, 6]) .or. .not. all(given(:n))) then
               call card_fault(card, 'the number of nodes is not 4 or 6', found=to_text(n)// &
                  ' nodes', &
                               allowed='1 2 3 4; with middle nodes also 5 (of 1-2) and 6 (of 4-3)')
               cycle
            end if
         end associate
         call find_joint_nodes(card, n, deck%draft, nodes(:n))
         call add_joint(deck%draft, integer_of(card, field_label), first_card(card), law, &
                        nodes(:n), entry=card%entry)
      end do
   end subroutine read_joints

   !> Find the nodes of a joint; a node that is not defined or repeated is reported
   subroutine find_joint_nodes(card, n, draft, nodes)
      !> The card
      type(card_type), intent(in) :: card
      !> And its number of nodes
      integer, intent(in) :: n
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The nodes; 0 where unknown
      integer, intent(out) :: nodes(:)

      integer :: i, label

      do i = 1, n
         label = integer_of(card, field_node + i - 1)
         nodes(i) = find_number(draft%node_of, label)
         if (nodes(i) == 0 .and. draft%nodes_complete) then
            call lack_fault(card, field_node + i - 1, &
                            'node '//to_text(label)//' is not defined')
         else if (nodes(i) > 0 .and. any(nodes(:i - 1) == nodes(i))) then
            call field_fault(card, field_node + i - 1, &
                             'the joint has node '//to_text(label)//' twice', &
                             allowed='different nodes: each side has nodes of its own body')
            nodes(i) = 0
         end if
      end do
   end subroutine find_joint_nodes

end module axijoint_deck_section_joints
