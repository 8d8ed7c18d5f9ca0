!> Joints along physical curves of the mesh file
module axijoint_deck_gmsh_joints
   use axijoint_base_sort, only : refine_order
   use axijoint_base_text, only : to_text
   use axijoint_deck_gmsh_faces, only : lines_of_group, copies
   use axijoint_deck_gmsh_import, only : gmsh_import_type, use_joint, name_number, name_group
   use axijoint_deck_mesh_draft, only : draft_type, edge_type, place_text
   use axijoint_deck_mesh_edges, only : edge_table_type, find_edge, outer_edge
   use axijoint_deck_mesh_joint_layer, only : check_layer, lay_joints
   use axijoint_deck_property_properties, only : properties_type
   use axijoint_deck_text_entry, only : entry_type, field_fault, first_card, field_named, text_of
   use axijoint_model_interface, only : interface_type
   implicit none
   private
   public :: lay_group_joints

   !> Which nodes are at one place
   type :: places_type
      !> Number of each node's place, and the nodes in the order of these numbers
      integer, allocatable :: group(:), order(:)
   end type places_type

contains

   !> Add the joints of GROUPS, numbered on from the highest number
   subroutine lay_group_joints(cards, import, properties, group, edges, draft)
      !> The cards of GROUPS
      class(entry_type), intent(in) :: cards
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> Laws
      type(properties_type), intent(in) :: properties
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh of the deck
      type(draft_type), intent(inout) :: draft

      class(entry_type), allocatable :: card
      type(places_type) :: places
      type(edge_type), allocatable :: a(:), b(:)
      integer :: i, errors_before

      if (.not. import%sound) return
      card = cards
      places%group = group
      places%order = [(i, i=1, draft%n_nodes)]
      call refine_order(places%order, group)
      do i = 1, size(import%uses)
         associate (use => import%uses(i))
            if (use%kind /= use_joint .or. use%number == 0) cycle
            card%entry = use%entry
            errors_before = card%diagnostics%n_errors
            call find_sides(card, import, lines_of_group(import, use%group), places, edges, draft, &
               a, b)
            if (card%diagnostics%n_errors > errors_before) cycle
            call check_layer(card, [field_named(card, name_number), &
               field_named(card, name_group)], &
                             properties%laws(use%number)%rule, draft, a, b)
            if (card%diagnostics%n_errors > errors_before) cycle
            call lay_joints(first_card(card), &
                            interface_type(name=group_name(card), law=use%number), a, b, draft)
         end associate
      end do
   end subroutine lay_group_joints

   !> Name of the group as the card has it, without quotes
   function group_name(card) result(name)
      !> The card of GROUPS
      class(entry_type), intent(in) :: card
      !> The name
      character(len=:), allocatable :: name

      name = text_of(card, field_named(card, name_group))
      if (len(name) > 2 .and. name(1:1) == '"') name = name(2:len(name) - 1)
   end function group_name

   !> The edges of two bodies along each line of a group; where the group has the lines of both
   !> bodies, once. The first line without two bodies is reported
   subroutine find_sides(card, import, lines, places, edges, draft, a, b)
      !> The card of GROUPS
      class(entry_type), intent(in) :: card
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> Nodes of the file, shape (2, lines)
      integer, intent(in) :: lines(:, :)
      !> Which nodes are at one place
      type(places_type), intent(in) :: places
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft
      !> Edges of the body of the lesser number, and of the other, in the direction of the lines
      type(edge_type), allocatable, intent(out) :: a(:), b(:)

      type(edge_type), allocatable :: sides(:)
      logical, allocatable :: laid(:)
      integer :: line, n, ends(2), first

      allocate (a(size(lines, 2)), b(size(lines, 2)))
      allocate (laid(edges%n), source=.false.)
      n = 0
      do line = 1, size(lines, 2)
         ends = [place_of(lines(1, line)), place_of(lines(2, line))]
         allocate (sides(0))
         if (all(ends > 0)) sides = edges_between(ends, places, edges, draft)
         if (.not. good_sides(draft, places%group, sides)) then
            call report_sides(card, place_text(import%mesh%position(:2, lines(1, line))), sides, &
               draft)
            return
         end if
         first = find_edge(edges, sides(1)%nodes(1), sides(1)%nodes(2))
         if (.not. laid(first)) then
            n = n + 1
            a(n) = sides(1)
            b(n) = sides(2)
         end if
         laid(first) = .true.
         deallocate (sides)
      end do
      a = a(:n)
      b = b(:n)

   contains

      !> Number of the place of a node of the file; 0 if no element uses it
      pure integer function place_of(node)
         !> The node
         integer, intent(in) :: node

         integer, allocatable :: nodes(:)

         nodes = copies(import, node, draft)
         place_of = 0
         if (size(nodes) > 0) place_of = places%group(nodes(1))
      end function place_of
   end subroutine find_sides

   !> Edges of elements between two places, by body; both elements' if the edge is inside a body
   pure function edges_between(ends, places, edges, draft) result(sides)
      !> Numbers of the places
      integer, intent(in) :: ends(2)
      !> Which nodes are at one place
      type(places_type), intent(in) :: places
      !> Edges of the elements
      type(edge_table_type), intent(in) :: edges
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft
      !> The edges from the first place to the second
      type(edge_type), allocatable :: sides(:)

      integer :: i, k, edge, twin, first(2)

      allocate (sides(0))
      first = [first_at(ends(1)), first_at(ends(2))]
      do i = first(1), size(places%order)
         if (places%group(places%order(i)) /= ends(1)) exit
         do k = first(2), size(places%order)
            if (places%group(places%order(k)) /= ends(2)) exit
            edge = find_edge(edges, places%order(i), places%order(k))
            if (edge == 0) cycle
            sides = [sides, outer_edge(draft, edges, edge, places%order(i))]
            twin = edges%twin(edge)
            if (twin > 0) sides = [sides, outer_edge(draft, edges, twin, places%order(i))]
         end do
      end do
      if (size(sides) /= 2) return
      if (draft%element_body(sides(1)%element) > draft%element_body(sides(2)%element)) &
         sides = sides([2, 1])

   contains

      !> First node at a place, by halving
      pure integer function first_at(place) result(low)
         !> Number of the place
         integer, intent(in) :: place

         integer :: high, middle

         low = 1
         high = size(places%order)
         do while (low < high)
            middle = (low + high)/2
            if (places%group(places%order(middle)) < place) then
               low = middle + 1
            else
               high = middle
            end if
         end do
      end function first_at
   end function edges_between

   !> Whether a joint fits between edges: two of two bodies, with middle nodes at one place or none
   pure logical function good_sides(draft, group, sides)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> The edges
      type(edge_type), intent(in) :: sides(:)

      good_sides = size(sides) == 2
      if (.not. good_sides) return
      good_sides = draft%element_body(sides(1)%element) /= draft%element_body(sides(2)%element) &
                   .and. (sides(1)%nodes(3) > 0 .eqv. sides(2)%nodes(3) > 0)
      if (good_sides .and. sides(1)%nodes(3) > 0) then
         good_sides = group(sides(1)%nodes(3)) == group(sides(2)%nodes(3))
      end if
   end function good_sides

   !> Report a line along which no joint can lie
   subroutine report_sides(card, place, sides, draft)
      !> The card of GROUPS
      class(entry_type), intent(in) :: card
      !> Where the line begins
      character(len=*), intent(in) :: place
      !> Edges along it
      type(edge_type), intent(in) :: sides(:)
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft

      character(len=:), allocatable :: text, mend

      mend = ''
      select case (size(sides))
      case (0)
         text = 'no body has an edge along the curve at '//place
      case (1)
         text = 'only body '//to_text(draft%element_body(sides(1)%element))// &
                ' has an edge along the curve at '//place
         mend = 'mesh both bodies with the same nodes along the curve'
      case (2)
         text = 'the elements on both sides of the curve at '//place//' belong to body '// &
                to_text(draft%element_body(sides(1)%element))
         mend = 'give the groups on both sides bodies of their own'
         if (draft%element_body(sides(1)%element) /= draft%element_body(sides(2)%element)) then
            text = 'the elements on both sides of the curve at '//place// &
               ' have different middle nodes'
            mend = 'mesh both bodies alike: elements of the same order, the same nodes'
         end if
      case default
         text = 'more than two elements have an edge along the curve at '//place
      end select
      call field_fault(card, field_named(card, name_group), text, &
                       allowed='a curve between two bodies', mend=mend)
   end subroutine report_sides

end module axijoint_deck_gmsh_joints
