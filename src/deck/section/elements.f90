!> ELEMENTS: elements one by one, and the mid-side and centre nodes that they imply
module axijoint_deck_section_elements
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_elements
   use axijoint_deck_mesh_draft, only : draft_type, add_node, add_element
   use axijoint_deck_property_properties, only : find_material
   use axijoint_deck_text_common_fields, only : number, nodes_field => nodes, body_field => body
   use axijoint_deck_text_entry, only : integer_of, is_good, &
      field_fault, lack_fault, card_fault, first_card
   use axijoint_deck_text_field, only : described
   use axijoint_deck_text_labels, only : check_label
   use axijoint_deck_text_source, only : card_position
   use axijoint_fe_shape, only : n_corners
   implicit none
   private
   public :: elements_section

   !> The keyword
   character(len=*), parameter :: keyword_elements = 'ELEMENTS'
   !> Fields; nodes from `field_node` on
   integer, parameter :: field_label = 1, field_material = 2, field_body = 3, field_node = 4
   !> Largest distance of two middles of one side, in lengths of the side
   real(wp), parameter :: middle_tolerance = 1.0e-6_wp

contains

   !> ELEMENTS
   function elements_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_elements
      section%purpose = 'elements one by one'
      section%numbered = .true.
      section%stage = stage_elements
      section%read => read_elements
      section%fields = [number('the element', 1), &
                        described(number('the material', 6), 'material', &
                                  limits='of MATERIALS or ORTHOTROPIC'), &
                        body_field(11), described(nodes_field('node', 9, 3, 16), 'nodes', &
                        limits='3, 4, 6, 8 or 9')]
   end function elements_section

   !> Add the elements
   subroutine read_elements(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(number_map_type) :: seen
      integer :: material, n, n_given, nodes(9), errors_before

      n_given = deck%draft%n_nodes
      card = cards_of(deck, keyword_elements)
      do while (next_card(card))
         call check_label(card, field_label, 'element', seen)
         call find_material(card, field_material, deck%properties, material)
         n = count_nodes(card)
         if (is_good(card) .and. n == 0) then
            call card_fault(card, 'the number of nodes is not 3, 4, 6, 8 or 9', &
                            found=to_text(count(card%table%given(field_node:, card%entry)))// &
                            ' nodes', &
                            allowed='3, 4, 6, 8 or 9 nodes without blanks between them')
         end if
         errors_before = deck%diagnostics%n_errors
         if (is_good(card)) call check_distinct(card, n)
         if (.not. is_good(card) .or. n == 0 .or. deck%diagnostics%n_errors > errors_before) then
            deck%draft%elements_complete = .false.
            cycle
         end if
         call find_nodes(card, n, n_given, deck%draft, nodes(:n))
         call add_element(deck%draft, integer_of(card, field_label), first_card(card), material, &
                          integer_of(card, field_body), nodes(:n))
         call claim_nodes(card, nodes(:n), deck%draft)
      end do
   end subroutine read_elements

   !> Number of nodes of an element: 3, 4, 6, 8 or 9; 0 if it is another or there are gaps
   pure integer function count_nodes(card) result(n)
      !> The card
      type(card_type), intent(in) :: card

      n = count(card%table%given(field_node:, card%entry))
      if (all(n /= [3, 4, 6, 8, 9])) n = 0
      if (.not. all(card%table%given(field_node:field_node + n - 1, card%entry))) n = 0
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
   subroutine check_distinct(card, n)
      !> The card
      type(card_type), intent(in) :: card
      !> And its number of nodes
      integer, intent(in) :: n

      integer :: i, label

      do i = 1, n - 1
         label = integer_of(card, field_node + i)
         if (any(nint(card%table%values(field_node:field_node + i - 1, card%entry)) == label)) then
            call field_fault(card, field_node + i, &
                             'the element has node '//to_text(label)//' twice', &
                             allowed='different nodes')
         end if
      end do
   end subroutine check_distinct

   !> Find or make the nodes of an element
   subroutine find_nodes(card, n, n_given, draft, nodes)
      !> The card
      type(card_type), intent(in) :: card
      !> Its number of nodes, and the number of nodes given by cards
      integer, intent(in) :: n, n_given
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> The nodes in the model's order; 0 if unknown
      integer, intent(out) :: nodes(:)

      integer :: i, field, label

      nodes = 0
      do i = 1, n
         field = field_node - 1 + place_on_card(n, i)
         label = integer_of(card, field)
         nodes(i) = find_number(draft%node_of, label)
         if (nodes(i) > 0 .and. nodes(i) <= n_given) cycle
         if (i > n_corners(n)) then
            call make_node(card, field, i, draft, nodes)
         else
            nodes(i) = 0
            if (.not. draft%nodes_complete) cycle
            call lack_fault(card, field, &
                            'node '//to_text(label)//' is not defined', &
                            allowed='a node of a NODES or LINES card; only mid-side and centre ' &
                               //'nodes are generated')
         end if
      end do
   end subroutine find_nodes

   !> Make a mid-side or centre node, or check that it was made at the same place
   subroutine make_node(card, field, i, draft, nodes)
      !> The card
      type(card_type), intent(in) :: card
      !> And the node's field
      integer, intent(in) :: field
      !> Place of the node in the model's order, behind the corners
      integer, intent(in) :: i
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> The nodes of the element; the first i - 1 are known, the i-th is set
      integer, intent(inout) :: nodes(:)

      real(wp) :: middle(2), length
      integer :: label
      logical :: good

      label = integer_of(card, field)
      call find_middle(draft, nodes, i, middle, length, good)
      if (nodes(i) == 0) then
         call add_node(draft, label, first_card(card), middle, good)
         nodes(i) = draft%n_nodes
      else if (good .and. draft%node_good(nodes(i))) then
         if (norm2(draft%position(:, nodes(i)) - middle) <= middle_tolerance*length) return
         draft%elements_complete = .false.
         call field_fault(card, field, &
                          'node '//to_text(label)//' is the middle of two different sides', &
                          mend='number the middles differently, or give the node on a NODES '// &
                          'card; ' &
                             //'it was made first by '// &
                          card_position(card%source, draft%node_card(nodes(i)), first_card(card)))
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
   subroutine claim_nodes(card, nodes, draft)
      !> The card
      type(card_type), intent(in) :: card
      !> Its nodes; 0 if unknown
      integer, intent(in) :: nodes(:)
      !> The mesh
      type(draft_type), intent(inout) :: draft

      integer :: i, body, other
      logical :: reported

      body = integer_of(card, field_body)
      reported = .false.
      do i = 1, size(nodes)
         if (nodes(i) == 0) cycle
         other = draft%node_body(nodes(i))
         if (other == 0) draft%node_body(nodes(i)) = body
         if (other == 0 .or. other == body .or. reported) cycle
         reported = .true.
         draft%elements_complete = .false.
         call card_fault(card, &
                          'node '//to_text(draft%node_label(nodes(i)))//' belongs to body '// &
                          to_text(other)//' and to body '//to_text(body), &
                          allowed='bodies share no nodes: they meet in joints', &
                          mend='give the elements one body, or the bodies nodes of their own')
      end do
   end subroutine claim_nodes

end module axijoint_deck_section_elements
