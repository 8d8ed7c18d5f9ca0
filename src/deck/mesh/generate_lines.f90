!> Nodes given by cards, and nodes on lines between them
module axijoint_deck_mesh_generate_lines
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, add_node, most_nodes
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_labels, only : repeated_label
   use axijoint_deck_text_source, only : source_type, card_position
   use axijoint_deck_text_table, only : table_type, integer_value, field_error, entry_error
   implicit none
   private
   public :: draft_nodes, draft_lines, graded_fraction, between

   !> Fields of LINES
   integer, parameter :: line_first = 1, line_last = 2, line_step = 3, line_ratio = 4

contains

   !> Add the nodes of the NODES cards
   subroutine draft_nodes(source, table, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> NODES
      type(table_type), intent(in) :: table
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, label, known

      do entry = 1, table%n
         if (.not. table%given(1, entry)) then
            draft%nodes_complete = .false.
            cycle
         end if
         label = integer_value(table, 1, entry)
         known = find_number(draft%node_of, label)
         if (known > 0) then
            call repeated_label(source, table, entry, 1, 'node', draft%node_card(known), diagnostics)
         else
            call add_node(draft, label, table%cards(1, entry), table%values(2:3, entry), &
                          table%good(entry))
         end if
      end do
   end subroutine draft_nodes

   !> Add the nodes of the LINES cards, in the order of the deck
   subroutine draft_lines(source, table, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> LINES
      type(table_type), intent(in) :: table
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, ends(2), errors_before

      do entry = 1, table%n
         errors_before = diagnostics%n_errors
         if (table%good(entry)) then
            call check_line(source, table, entry, draft, ends, diagnostics)
            if (diagnostics%n_errors == errors_before .and. all(ends > 0)) then
               call draft_line(source, table, entry, ends, draft, diagnostics)
            end if
         end if
         if (.not. table%good(entry) .or. diagnostics%n_errors > errors_before) &
            draft%nodes_complete = .false.
      end do
   end subroutine draft_lines

   !> Check a LINES card and find its ends
   subroutine check_line(source, table, entry, draft, ends, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> LINES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> First and last node; 0 if unknown
      integer, intent(out) :: ends(2)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, labels(2), distance

      labels = [integer_value(table, line_first, entry), integer_value(table, line_last, entry)]
      do i = 1, 2
         ends(i) = find_number(draft%node_of, labels(i))
         if (ends(i) > 0 .or. .not. draft%nodes_complete) cycle
         call field_error(diagnostics, source, table, entry, i, &
                          'node '//to_text(labels(i))//' is not defined', &
                          allowed='a node of a NODES card or of an earlier LINES card')
      end do
      if (any(ends == 0)) draft%nodes_complete = .false.
      distance = abs(labels(2) - labels(1))
      if (distance == 0) then
         call field_error(diagnostics, source, table, entry, line_last, &
                          'the line ends where it begins', allowed='two different nodes')
      else if (mod(distance, integer_value(table, line_step, entry)) /= 0) then
         call field_error(diagnostics, source, table, entry, &
                          merge(line_step, line_last, table%given(line_step, entry)), &
                          'the step does not lead from node '//to_text(labels(1))//' to node ' &
                          //to_text(labels(2)), allowed='a divisor of '//to_text(distance))
      else if (distance/integer_value(table, line_step, entry) > most_nodes - draft%n_nodes) then
         call entry_error(diagnostics, table, entry, 'the line would make more nodes than a deck may have', &
                          allowed='at most '//to_text(most_nodes)//' nodes in all')
      end if
   end subroutine check_line

   !> Add the nodes of one line
   subroutine draft_line(source, table, entry, ends, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> LINES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> First and last node
      integer, intent(in) :: ends(2)
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, n, step, label, known

      associate (first => draft%node_label(ends(1)), last => draft%node_label(ends(2)))
         step = sign(integer_value(table, line_step, entry), last - first)
         n = (last - first)/step
      end associate
      do i = 1, n - 1
         label = draft%node_label(ends(1)) + i*step
         known = find_number(draft%node_of, label)
         if (known > 0) then
            call entry_error(diagnostics, table, entry, &
                             'node '//to_text(label)//' of this line is given already on '// &
                             card_position(source, draft%node_card(known), table%cards(1, entry)))
            return
         end if
         call add_node(draft, label, table%cards(1, entry), &
                       between(draft%position(:, ends(1)), draft%position(:, ends(2)), &
                               graded_fraction(i, n, table%values(line_ratio, entry))), &
                       all(draft%node_good(ends)))
      end do
   end subroutine draft_line

   !> Where the i-th of n intervals ends, on [0, 1]: intervals in geometric
   !> progression with a given ratio of the last to the first
   pure real(wp) function graded_fraction(i, n, ratio) result(fraction)
      !> Interval, 0 to n, and number of intervals
      integer, intent(in) :: i, n
      !> Last to first interval
      real(wp), intent(in) :: ratio

      real(wp) :: half

      fraction = real(i, wp)/real(n, wp)
      if (n == 1 .or. i == 0 .or. i == n) return
      half = 0.5_wp*log(ratio)/real(n - 1, wp)  ! half the logarithm of the ratio of neighbours
      if (abs(half) > 0.0_wp) then
         ! (q**i - 1)/(q**n - 1), written so that q near 1 loses no digits
         fraction = exp(real(i - n, wp)*half)*sinh(real(i, wp)*half)/sinh(real(n, wp)*half)
      end if
   end function graded_fraction

   !> Point between two points; exact at both, and exact in a coordinate that both share
   pure elemental real(wp) function between(a, b, fraction)
      !> The points
      real(wp), intent(in) :: a, b
      !> 0 at a, 1 at b
      real(wp), intent(in) :: fraction

      if (fraction < 0.5_wp) then
         between = a + fraction*(b - a)
      else
         between = b - (1.0_wp - fraction)*(b - a)
      end if
   end function between

end module axijoint_deck_mesh_generate_lines
