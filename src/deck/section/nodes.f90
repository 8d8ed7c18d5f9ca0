!> NODES: nodes one by one
module axijoint_deck_section_nodes
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_elements
   use axijoint_deck_mesh_draft, only : add_node
   use axijoint_deck_text_common_fields, only : node, length, name_node
   use axijoint_deck_text_entry, only : is_given, integer_of, reals_of, is_good, first_card
   use axijoint_deck_text_field, only : described
   use axijoint_deck_text_labels, only : repeated_label
   implicit none
   private
   public :: nodes_section

   !> The keyword
   character(len=*), parameter :: keyword_nodes = 'NODES'
   !> Fields: number, r, z
   integer, parameter :: field_label = 1, field_position = 2

contains

   !> NODES
   function nodes_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_nodes
      section%purpose = 'nodes one by one'
      section%numbered = .true.
      section%stage = stage_elements
      section%read => read_nodes
      section%fields = [node(name_node, 1), described(length('r', 6, 0.0_wp), 'r [length]'), &
                        described(length('z', 16), 'z [length]', limits='any')]
   end function nodes_section

   !> Add the nodes
   subroutine read_nodes(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: label, known

      card = cards_of(deck, keyword_nodes)
      do while (next_card(card))
         if (.not. is_given(card, field_label)) then
            deck%draft%nodes_complete = .false.
            cycle
         end if
         label = integer_of(card, field_label)
         known = find_number(deck%draft%node_of, label)
         if (known > 0) then
            call repeated_label(card, field_label, 'node', deck%draft%node_card(known))
         else
            call add_node(deck%draft, label, first_card(card), reals_of(card, field_position, 2), &
                          is_good(card))
         end if
      end do
   end subroutine read_nodes

end module axijoint_deck_section_nodes
