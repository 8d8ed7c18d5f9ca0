!> Nodes first, first + step, ..., last of a card
module axijoint_deck_mesh_node_range
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_text_common_fields, only : name_node, name_last, name_step
   use axijoint_deck_text_entry, only : entry_type, is_given, integer_of, is_good, &
      field_fault, lack_fault, &
      field_named
   implicit none
   private
   public :: find_nodes

contains

   !> Find the nodes of a card, or report those that do not exist
   subroutine find_nodes(card, draft, nodes)
      !> The card; its section has fields of a node, the last node and the step
      class(entry_type), intent(in) :: card
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The nodes (indices); none if something is wrong
      integer, allocatable, intent(out) :: nodes(:)

      integer :: field_first, field_last, field_step, first, last, step, i

      allocate (nodes(0))
      if (.not. is_good(card)) return
      field_first = field_named(card, name_node)
      field_last = field_named(card, name_last)
      field_step = field_named(card, name_step)
      first = integer_of(card, field_first)
      last = first
      if (is_given(card, field_last)) last = integer_of(card, field_last)
      step = integer_of(card, field_step)
      if (mod(abs(last - first), step) /= 0) then
         call field_fault(card, merge(field_step, field_last, is_given(card, field_step)), &
                          'the step does not lead from node '//to_text(first)//' to node '// &
                          to_text(last), allowed='a divisor of '//to_text(abs(last - first)))
         return
      end if
      step = sign(step, last - first)
      ! one lacks
      if (abs(last - first)/abs(step) >= draft%n_nodes) last = first + draft%n_nodes*step
      nodes = [(find_number(draft%node_of, first + i*step), i=0, (last - first)/step)]
      i = findloc(nodes, 0, 1)
      if (i == 0) return
      if (draft%nodes_complete) then
         call lack_fault(card, merge(field_last, field_first, i > 1), &
                         'node '//to_text(first + (i - 1)*step)//' is not defined', &
                         allowed='nodes first, first + step, ..., last must all exist')
      end if
      nodes = [integer ::]
   end subroutine find_nodes

end module axijoint_deck_mesh_node_range
