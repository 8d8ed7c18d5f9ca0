!> Elements given by cards, and the mid-side and centre nodes that they imply
module axijoint_deck_mesh_elements
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, add_node, add_element
   use axijoint_deck_property_properties, only : properties_type, find_property
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_labels, only : check_label
   use axijoint_deck_text_source, only : source_type, card_position
   use axijoint_deck_text_table, only : table_type, integer_value, field_error, entry_error
   use axijoint_fe_shape, only : n_corners
   implicit none
   private
   public :: draft_elements

   !> Fields of ELEMENTS
   integer, parameter :: field_label = 1, field_material = 2, field_body = 3, field_node = 4
   !> Largest distance of two middles of one side, in lengths of the side
   real(wp), parameter :: middle_tolerance = 1.0e-6_wp

contains

   !> Add the elements of the ELEMENTS cards
   subroutine draft_elements(source, table, properties, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> ELEMENTS
      type(table_type), intent(in) :: table
      !> Materials
      type(properties_type), intent(in) :: properties
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(number_map_type) :: seen
      integer :: entry, material, n, n_given, nodes(9), errors_before

      n_given = draft%n_nodes
      do entry = 1, table%n
         call check_label(source, table, entry, 'element', seen, diagnostics)
         call find_property(source, table, entry, field_material, properties%material_of, &
                            properties%materials_complete, 'material', material, diagnostics)
         n = count_nodes(table, entry)
         if (table%good(entry) .and. n == 0) then
            call entry_error(diagnostics, table, entry, 'the number of nodes is not 3, 4, 6, 8 or 9', &
                             found=to_text(count(table%given(field_node:, entry)))//' nodes', &
                             allowed='3, 4, 6, 8 or 9 nodes without blanks between them')
         end if
         errors_before = diagnostics%n_errors
         if (table%good(entry)) call check_distinct(source, table, entry, n, diagnostics)
         if (.not. table%good(entry) .or. n == 0 .or. diagnostics%n_errors > errors_before) then
            draft%elements_complete = .false.
            cycle
         end if
         call find_nodes(source, table, entry, n, n_given, draft, nodes(:n), diagnostics)
         call add_element(draft, integer_value(table, field_label, entry), table%cards(1, entry), &
                          material, integer_value(table, field_body, entry), nodes(:n))
         call claim_nodes(table, entry, nodes(:n), draft, diagnostics)
      end do
   end subroutine draft_elements

   !> Number of nodes of an element: 3, 4, 6, 8 or 9; 0 if it is another or there are gaps
   pure integer function count_nodes(table, entry) result(n)
      !> ELEMENTS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry

      n = count(table%given(field_node:, entry))
      if (all(n /= [3, 4, 6, 8, 9])) n = 0
      if (.not. all(table%given(field_node:field_node + n - 1, entry))) n = 0
   end function count_nodes

   !> Place on the card of a node of the model: the card goes round the perimeter,
   !> the model takes corners, mid-sides, centre
   pure integer function place_on_card(n, i) result(place)
      !> Number of nodes of the element
      integer, intent(in) :: n
      !> Place in the model's order
      integer, intent(in) :: i

      place = i
      if (n <= 4 .or. i == 9) return
      associate (c => n_corners(n))
         if (i <= c) place = 2*i - 1
         if (i > c) place = 2*(i - c)
      end associate
   end function place_on_card

   !> Report a node that an element has twice
   subroutine check_distinct(source, table, entry, n, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> ELEMENTS
      type(table_type), intent(in) :: table
      !> The entry, and its number of nodes
      integer, intent(in) :: entry, n
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, label

      do i = 1, n - 1
         label = integer_value(table, field_node + i, entry)
         if (any(nint(table%values(field_node:field_node + i - 1, entry)) == label)) then
            call field_error(diagnostics, source, table, entry, field_node + i, &
                             'the element has node '//to_text(label)//' twice', &
                             allowed='different nodes')
         end if
      end do
   end subroutine check_distinct

   !> Find or make the nodes of an element
   subroutine find_nodes(source, table, entry, n, n_given, draft, nodes, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> ELEMENTS
      type(table_type), intent(in) :: table
      !> The entry, its number of nodes, and the number of nodes given by cards
      integer, intent(in) :: entry, n, n_given
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> The nodes in the model's order; 0 if unknown
      integer, intent(out) :: nodes(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, field, label

      nodes = 0
      do i = 1, n
         field = field_node - 1 + place_on_card(n, i)
         label = integer_value(table, field, entry)
         nodes(i) = find_number(draft%node_of, label)
         if (nodes(i) > 0 .and. nodes(i) <= n_given) cycle
         if (i > n_corners(n)) then
            call make_node(source, table, entry, field, i, draft, nodes, diagnostics)
         else
            nodes(i) = 0
            if (.not. draft%nodes_complete) cycle
            call field_error(diagnostics, source, table, entry, field, &
                             'node '//to_text(label)//' is not defined', &
                             allowed='a node of a NODES or LINES card; only mid-side and centre ' &
                                //'nodes are generated')
         end if
      end do
   end subroutine find_nodes

   !> Make a mid-side or centre node, or check that it was made at the same place
   subroutine make_node(source, table, entry, field, i, draft, nodes, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> ELEMENTS
      type(table_type), intent(in) :: table
      !> The entry, and the node's field
      integer, intent(in) :: entry, field
      !> Place of the node in the model's order, behind the corners
      integer, intent(in) :: i
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> The nodes of the element; the first i - 1 are known, the i-th is set
      integer, intent(inout) :: nodes(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: middle(2), length
      integer :: label
      logical :: good

      label = integer_value(table, field, entry)
      call find_middle(draft, nodes, i, middle, length, good)
      if (nodes(i) == 0) then
         call add_node(draft, label, table%cards(1, entry), middle, good)
         nodes(i) = draft%n_nodes
      else if (good .and. draft%node_good(nodes(i))) then
         if (norm2(draft%position(:, nodes(i)) - middle) <= middle_tolerance*length) return
         draft%elements_complete = .false.
         call field_error(diagnostics, source, table, entry, field, &
                          'node '//to_text(label)//' is the middle of two different sides', &
                          mend='number the middles differently, or give the node on a NODES card; ' &
                             //'it was made first by '// &
                          card_position(source, draft%node_card(nodes(i)), table%cards(1, entry)))
      end if
   end subroutine make_node

   !> Middle of a side, or centre of an element from its other eight nodes
   pure subroutine find_middle(draft, nodes, i, middle, length, good)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The nodes of the element; the first i - 1 are known
      integer, intent(in) :: nodes(:)
      !> Place in the model's order, behind the corners
      integer, intent(in) :: i
      !> r and z
      real(wp), intent(out) :: middle(2)
      !> Length of the side, or of a diagonal
      real(wp), intent(out) :: length
      !> Whether the nodes that it depends on are known
      logical, intent(out) :: good

      integer, allocatable :: needed(:)

      middle = 0.0_wp
      length = 0.0_wp
      associate (c => n_corners(size(nodes)))
         if (i < 9) needed = nodes([i - c, mod(i - c, c) + 1])
         if (i == 9) needed = nodes([1, 3, 2, 4, 5, 6, 7, 8])
      end associate
      good = all(needed > 0)
      if (good) good = all(draft%node_good(needed))
      if (.not. good) return
      associate (x => draft%position(:, needed))
         length = norm2(x(:, 2) - x(:, 1))
         middle = 0.5_wp*(x(:, 1) + x(:, 2))
         ! The serendipity functions at the centre: -1/4 of the corners, 1/2 of the middles.
         if (i == 9) middle = 0.5_wp*sum(x(:, 5:8), 2) - 0.25_wp*sum(x(:, 1:4), 2)
      end associate
   end subroutine find_middle

   !> Note the body of an element's nodes; a node has one body only
   subroutine claim_nodes(table, entry, nodes, draft, diagnostics)
      !> ELEMENTS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Its nodes; 0 if unknown
      integer, intent(in) :: nodes(:)
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, body, other
      logical :: reported

      body = integer_value(table, field_body, entry)
      reported = .false.
      do i = 1, size(nodes)
         if (nodes(i) == 0) cycle
         other = draft%node_body(nodes(i))
         if (other == 0) draft%node_body(nodes(i)) = body
         if (other == 0 .or. other == body .or. reported) cycle
         reported = .true.
         draft%elements_complete = .false.
         call entry_error(diagnostics, table, entry, &
                          'node '//to_text(draft%node_label(nodes(i)))//' belongs to body '// &
                          to_text(other)//' and to body '//to_text(body), &
                          allowed='bodies share no nodes: they meet in joints', &
                          mend='give the elements one body, or the bodies nodes of their own')
      end do
   end subroutine claim_nodes

end module axijoint_deck_mesh_elements
