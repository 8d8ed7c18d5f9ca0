!> Joints given by cards
module axijoint_deck_mesh_joints
   use axijoint_base_number_map, only : number_map_type, find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, add_joint
   use axijoint_deck_property_properties, only : properties_type, find_property
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_labels, only : check_label
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error, entry_error
   implicit none
   private
   public :: draft_joints

   !> Fields of JOINTS
   integer, parameter :: field_label = 1, field_law = 2, field_node = 3

contains

   !> Add the joints of the JOINTS cards
   subroutine draft_joints(source, table, properties, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> JOINTS
      type(table_type), intent(in) :: table
      !> Laws
      type(properties_type), intent(in) :: properties
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(number_map_type) :: seen
      integer :: entry, law, n, nodes(6)

      do entry = 1, table%n
         call check_label(source, table, entry, 'joint', seen, diagnostics)
         call find_property(source, table, entry, field_law, properties%law_of, &
                            properties%laws_complete, 'law', law, diagnostics)
         if (.not. table%good(entry)) cycle
         n = count(table%given(field_node:, entry))
         if (all(n /= [4, 6]) .or. .not. all(table%given(field_node:field_node + n - 1, entry))) then
            call entry_error(diagnostics, table, entry, 'the number of nodes is not 4 or 6', &
                             found=to_text(n)//' nodes', &
                             allowed='1 2 3 4; with middle nodes also 5 (of 1-2) and 6 (of 4-3)')
            cycle
         end if
         call find_joint_nodes(source, table, entry, n, draft, nodes(:n), diagnostics)
         call add_joint(draft, integer_value(table, field_label, entry), table%cards(1, entry), entry, &
                        law, nodes(:n))
      end do
   end subroutine draft_joints

   !> Find the nodes of a joint; a node that is not defined or repeated is reported
   subroutine find_joint_nodes(source, table, entry, n, draft, nodes, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> JOINTS
      type(table_type), intent(in) :: table
      !> The entry, and its number of nodes
      integer, intent(in) :: entry, n
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The nodes; 0 where unknown
      integer, intent(out) :: nodes(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, label

      do i = 1, n
         label = integer_value(table, field_node + i - 1, entry)
         nodes(i) = find_number(draft%node_of, label)
         if (nodes(i) == 0 .and. draft%nodes_complete) then
            call field_error(diagnostics, source, table, entry, field_node + i - 1, &
                             'node '//to_text(label)//' is not defined')
         else if (nodes(i) > 0 .and. any(nodes(:i - 1) == nodes(i))) then
            call field_error(diagnostics, source, table, entry, field_node + i - 1, &
                             'the joint has node '//to_text(label)//' twice', &
                             allowed='different nodes: each side has nodes of its own body')
            nodes(i) = 0
         end if
      end do
   end subroutine find_joint_nodes

end module axijoint_deck_mesh_joints
