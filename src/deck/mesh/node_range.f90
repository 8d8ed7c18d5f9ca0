!> Nodes first, first + step, ..., last of a card
module axijoint_deck_mesh_node_range
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error
   implicit none
   private
   public :: find_nodes

contains

   !> Find the nodes of a card, or report those that do not exist
   subroutine find_nodes(source, table, entry, field_last, field_step, draft, nodes, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section; its first field is the first node
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Fields of the last node, which may be blank, and of the step
      integer, intent(in) :: field_last, field_step
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The nodes (indices); none if something is wrong
      integer, allocatable, intent(out) :: nodes(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: first, last, step, i

      allocate (nodes(0))
      if (.not. table%good(entry)) return
      first = integer_value(table, 1, entry)
      last = first
      if (table%given(field_last, entry)) last = integer_value(table, field_last, entry)
      step = integer_value(table, field_step, entry)
      if (mod(abs(last - first), step) /= 0) then
         call field_error(diagnostics, source, table, entry, &
                          merge(field_step, field_last, table%given(field_step, entry)), &
                          'the step does not lead from node '//to_text(first)//' to node '// &
                          to_text(last), allowed='a divisor of '//to_text(abs(last - first)))
         return
      end if
      step = sign(step, last - first)
      if (abs(last - first)/abs(step) >= draft%n_nodes) last = first + draft%n_nodes*step  ! one lacks
      nodes = [(find_number(draft%node_of, first + i*step), i=0, (last - first)/step)]
      i = findloc(nodes, 0, 1)
      if (i == 0) return
      if (draft%nodes_complete) then
         call field_error(diagnostics, source, table, entry, merge(field_last, 1, i > 1), &
                          'node '//to_text(first + (i - 1)*step)//' is not defined', &
                          allowed='nodes first, first + step, ..., last must all exist')
      end if
      nodes = [integer ::]
   end subroutine find_nodes

end module axijoint_deck_mesh_node_range
