!> LINES: nodes on straight lines between others
module axijoint_deck_section_lines
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_elements
   use axijoint_deck_mesh_draft, only : draft_type, add_node, most_nodes
   use axijoint_deck_mesh_grading, only : graded_fraction, between
   use axijoint_deck_text_common_fields, only : node, step, ratio
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, is_sound, &
      field_fault, lack_fault, card_fault, first_card
   use axijoint_deck_text_field, only : described
   use axijoint_deck_text_source, only : card_position
   implicit none
   private
   public :: lines_section

   !> The keyword
   character(len=*), parameter :: keyword_lines = 'LINES'
   !> Fields
   integer, parameter :: field_first = 1, field_last = 2, field_step = 3, field_ratio = 4

contains

   !> LINES
   function lines_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_lines
      section%purpose = 'nodes first + step, first + 2 step, … on the straight line between '// &
         'two nodes'
      section%stage = stage_elements
      section%read => read_lines
      section%fields = &
         [described(node('the first node', 1), 'first node', &
                    limits='of a NODES card or an earlier LINES card'), &
          described(node('the last node', 6), 'last node; may be less than the first', &
                    limits='the same'), &
          described(step(11), 'step', limits='divides the difference of the numbers'), &
          described(ratio('the ratio', 16), &
                    'ratio of the last to the first interval (geometric progression)')]
   end function lines_section

   !> Add the nodes of the lines, in the order of the deck
   subroutine read_lines(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: ends(2)

      card = cards_of(deck, keyword_lines)
      do while (next_card(card))
         if (is_good(card)) then
            call check_line(card, deck%draft, ends)
            if (is_sound(card) .and. all(ends > 0)) call draft_line(card, ends, deck%draft)
         end if
         if (.not. is_sound(card)) deck%draft%nodes_complete = .false.
      end do
   end subroutine read_lines

   !> Check a card and find the ends of its line
   subroutine check_line(card, draft, ends)
      !> The card
      type(card_type), intent(in) :: card
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> First and last node; 0 if unknown
      integer, intent(out) :: ends(2)

      integer :: i, labels(2), distance

      do i = 1, 2
         associate (field => merge(field_first, field_last, i == 1))
            labels(i) = integer_of(card, field)
            ends(i) = find_number(draft%node_of, labels(i))
            if (ends(i) > 0 .or. .not. draft%nodes_complete) cycle
            call lack_fault(card, field, 'node '//to_text(labels(i))//' is not defined', &
                            allowed='a node of a NODES card or of an earlier LINES card')
         end associate
      end do
      if (any(ends == 0)) draft%nodes_complete = .false.
      distance = abs(labels(2) - labels(1))
      if (distance == 0) then
         call field_fault(card, field_last, 'the line ends where it begins', &
                          allowed='two different nodes')
      else if (mod(distance, integer_of(card, field_step)) /= 0) then
         call field_fault(card, merge(field_step, field_last, is_given(card, field_step)), &
                          'the step does not lead from node '//to_text(labels(1))//' to node ' &
                          //to_text(labels(2)), allowed='a divisor of '//to_text(distance))
      else if (distance/integer_of(card, field_step) > most_nodes - draft%n_nodes) then
         call card_fault(card, 'the line would make more nodes than a deck may have', &
                         allowed='at most '//to_text(most_nodes)//' nodes in all')
      end if
   end subroutine check_line

   !> Add the nodes of one line
   subroutine draft_line(card, ends, draft)
      !> The card
      type(card_type), intent(in) :: card
      !> First and last node
      integer, intent(in) :: ends(2)
      !> The mesh
      type(draft_type), intent(inout) :: draft

      integer :: i, n, step, label, known

      associate (first => draft%node_label(ends(1)), last => draft%node_label(ends(2)))
         step = sign(integer_of(card, field_step), last - first)
         n = (last - first)/step
      end associate
      do i = 1, n - 1
         label = draft%node_label(ends(1)) + i*step
         known = find_number(draft%node_of, label)
         if (known > 0) then
            call card_fault(card, 'node '//to_text(label)//' of this line is given already on '// &
                            card_position(card%source, draft%node_card(known), first_card(card)))
            return
         end if
         call add_node(draft, label, first_card(card), &
                       between(draft%position(:, ends(1)), draft%position(:, ends(2)), &
                               graded_fraction(i, n, real_of(card, field_ratio))), &
                       all(draft%node_good(ends)))
      end do
   end subroutine draft_line

end module axijoint_deck_section_lines
