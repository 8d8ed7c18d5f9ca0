!> Nodes and elements of the mesh file
module axijoint_deck_gmsh_solids
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_gmsh_checks, only : check_positions, check_numbers
   use axijoint_deck_gmsh_import, only : gmsh_import_type, copy_label, mesh_line_text, use_body
   use axijoint_deck_gmsh_shared, only : check_shared
   use axijoint_deck_mesh_draft, only : draft_type, add_node, add_element
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_warning
   use axijoint_deck_text_entry, only : entry_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type
   use axijoint_fe_shape, only : n_corners
   use axijoint_gmsh_mesh, only : nodes_of_type, dimension_of_type, group_text
   implicit none
   private
   public :: draft_gmsh

contains

   !> Add the nodes and elements of the mesh file
   subroutine draft_gmsh(cards, source, import, draft, diagnostics)
      !> The cards of GROUPS
      class(entry_type), intent(in) :: cards
      !> The deck; lines of the file at fault become cards
      type(source_type), intent(inout) :: source
      !> The mesh
      type(gmsh_import_type), intent(inout) :: import
      !> The mesh of the deck
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: use_of(:)
      integer :: errors_before

      if (.not. import%given) return
      errors_before = diagnostics%n_errors
      if (import%sound) then
         call find_uses(source, import, use_of, diagnostics)
         call copy_nodes(import, use_of, draft)
         call check_positions(source, import, diagnostics)
         call check_numbers(source, import, use_of, draft, diagnostics)
         call check_shared(cards%table, import, use_of, diagnostics)
      end if
      import%sound = import%sound .and. diagnostics%n_errors == errors_before
      if (import%sound) then
         call add_nodes(source, import, draft)
         call add_elements(cards%table, import, use_of, draft)
      else
         draft%nodes_complete = .false.
         draft%elements_complete = .false.
         draft%faces_complete = .false.
      end if
   end subroutine draft_gmsh

   !> The BODY card of each element, and a warning of elements without one
   subroutine find_uses(source, import, use_of, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> Place among the uses of groups; 0 for lines, and elements that are left out
      integer, allocatable, intent(out) :: use_of(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: use_of_set(:)
      integer :: use, set, element, first, n
      character(len=:), allocatable :: found

      associate (mesh => import%mesh)
         allocate (use_of_set(0:size(mesh%sets)), use_of(mesh%n_elements), source=0)
         do use = 1, size(import%uses)
            if (import%uses(use)%kind /= use_body) cycle
            do set = 1, size(mesh%sets)
               if (any(abs(mesh%sets(set)%groups) == import%uses(use)%group)) use_of_set(set) = use
            end do
         end do
         first = 0
         n = 0
         do element = 1, mesh%n_elements
            if (dimension_of_type(mesh%element_type(element)) /= 2) cycle
            use_of(element) = use_of_set(mesh%element_set(element))
            if (use_of(element) > 0) cycle
            n = n + 1
            if (first == 0) first = element
         end do
         if (n == 0) return
         found = 'the first is element '//to_text(mesh%element_tag(first))//', '// &
                 mesh_line_text(source, mesh%element_line(first))
         set = mesh%element_set(first)
         if (set > 0) found = found//', of '//group_text(mesh%groups(abs(mesh%sets(set)%groups(1))))
         call add_warning(diagnostics, source%mesh_card, 0, 0, count_of(n, 'element')// &
                          ' of the mesh file in no group of a BODY card: left out', found=found, &
                          mend='add a BODY card to GROUPS, or save the mesh without them')
      end associate
   end subroutine find_uses

   !> Note the bodies of each node, and number copies for all of them but one
   subroutine copy_nodes(import, use_of, draft)
      !> The mesh
      type(gmsh_import_type), intent(inout) :: import
      !> BODY card of each element; 0 for none
      integer, intent(in) :: use_of(:)
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft

      integer :: element, i, node, body, label

      associate (mesh => import%mesh)
         allocate (import%first_body(mesh%n_nodes), import%first_copy(mesh%n_nodes), source=0)
         allocate (import%next_copy(0), import%copy_body(0), import%copy_number(0))
         do element = 1, mesh%n_elements
            if (use_of(element) == 0) cycle
            body = import%uses(use_of(element))%number
            do i = 1, nodes_of_type(mesh%element_type(element))
               associate (first => import%first_body(mesh%element_nodes(i, element)))
                  if (first == 0 .or. body < first) first = body
               end associate
            end do
         end do
         label = maxval([0, mesh%node_tag(:mesh%n_nodes), draft%node_label(:draft%n_nodes)])
         do element = 1, mesh%n_elements
            if (use_of(element) == 0) cycle
            body = import%uses(use_of(element))%number
            do i = 1, nodes_of_type(mesh%element_type(element))
               node = mesh%element_nodes(i, element)
               if (import%first_body(node) == body) cycle
               if (copy_label(import, node, body) == 0) call add_copy(import, node, body, label)
            end do
         end do
      end associate
   end subroutine copy_nodes

   !> Add a copy of a node for a further body
   pure subroutine add_copy(import, node, body, label)
      !> The mesh
      type(gmsh_import_type), intent(inout) :: import
      !> Node of the file, and body
      integer, intent(in) :: node, body
      !> Largest number of a node so far
      integer, intent(inout) :: label

      integer :: n, room
      integer, allocatable :: larger(:)

      n = import%n_copies + 1
      room = size(import%copy_body)
      if (n > room) then
         allocate (larger(max(64, room)), source=0)
         import%copy_body = [import%copy_body, larger]
         import%copy_number = [import%copy_number, larger]
         import%next_copy = [import%next_copy, larger]
      end if
      label = label + 1
      import%n_copies = n
      import%copy_body(n) = body
      import%copy_number(n) = label
      import%next_copy(n) = import%first_copy(node)
      import%first_copy(node) = n
   end subroutine add_copy

   !> Add the nodes that elements use
   subroutine add_nodes(source, import, draft)
      !> The deck
      type(source_type), intent(in) :: source
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> The mesh of the deck
      type(draft_type), intent(inout) :: draft

      integer :: node, copy

      associate (mesh => import%mesh)
         do node = 1, mesh%n_nodes
            if (import%first_body(node) == 0) cycle
            call add_node(draft, mesh%node_tag(node), source%mesh_card, mesh%position(:2, node), &
               .true.)
            draft%node_body(draft%n_nodes) = import%first_body(node)
         end do
         do node = 1, mesh%n_nodes
            copy = import%first_copy(node)
            do while (copy > 0)
               call add_node(draft, import%copy_number(copy), source%mesh_card, &
                  mesh%position(:2, node), .true.)
               draft%node_body(draft%n_nodes) = import%copy_body(copy)
               copy = import%next_copy(copy)
            end do
         end do
      end associate
   end subroutine add_nodes

   !> Add the elements of bodies, counterclockwise
   subroutine add_elements(table, import, use_of, draft)
      !> GROUPS
      type(table_type), intent(in) :: table
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> BODY card of each element; 0 for none
      integer, intent(in) :: use_of(:)
      !> The mesh of the deck
      type(draft_type), intent(inout) :: draft

      integer, allocatable :: nodes(:)
      integer :: element, i

      associate (mesh => import%mesh)
         do element = 1, mesh%n_elements
            if (use_of(element) == 0) cycle
            associate (use => import%uses(use_of(element)))
               nodes = mesh%element_nodes(:nodes_of_type(mesh%element_type(element)), element)
               if (is_clockwise(mesh%position, nodes)) nodes = nodes(turned(size(nodes)))
               nodes = [(find_number(draft%node_of, copy_label(import, nodes(i), use%number)), &
                         i=1, size(nodes))]
               call add_element(draft, mesh%element_tag(element), table%cards(1, use%entry), &
                                use%material, use%number, nodes)
            end associate
         end do
      end associate
   end subroutine add_elements

   !> Whether the corners of an element go round clockwise
   pure logical function is_clockwise(position, nodes)
      !> Coordinates, shape (3, nodes)
      real(wp), intent(in) :: position(:, :)
      !> Nodes of the element
      integer, intent(in) :: nodes(:)

      real(wp) :: area
      integer :: i, n

      n = n_corners(size(nodes))
      area = 0.0_wp
      do i = 1, n
         associate (a => position(:, nodes(i)), b => position(:, nodes(mod(i, n) + 1)), &
                    o => position(:, nodes(1)))
            area = area + (a(1) - o(1))*(b(2) - o(2)) - (a(2) - o(2))*(b(1) - o(1))
         end associate
      end do
      is_clockwise = area < 0.0_wp
   end function is_clockwise

   !> Order of the nodes of an element that goes round the other way from the same corner
   pure function turned(n) result(order)
      !> Number of nodes
      integer, intent(in) :: n
      !> The order: corners, middles of sides, centre
      integer :: order(n)

      integer, parameter :: triangle(6) = [1, 3, 2, 6, 5, 4], &
         quadrilateral(9) = [1, 4, 3, 2, 8, 7, 6, 5, 9]

      if (n_corners(n) == 3) then
         order = triangle(:n)
      else
         order = quadrilateral(:n)
      end if
   end function turned

end module axijoint_deck_gmsh_solids
