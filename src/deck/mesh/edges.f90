!> Edges of the elements, and which of them are outer edges
module axijoint_deck_mesh_edges
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, edge_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_fe_shape, only : n_corners
   implicit none
   private
   public :: edge_table_type, new_edge_table, check_edges, find_edge, outer_edge, on_outer_edges

   !> Edges of all elements; an edge inside a body is there once for each element
   type :: edge_table_type
      !> Number of edges
      integer :: n = 0
      !> First, last and middle node (0 on a straight edge) as they follow
      !> round the element, shape (3, edges)
      integer, allocatable :: nodes(:, :)
      !> Element
      integer, allocatable :: element(:)
      !> The same edge in the neighbour; 0 on an outer edge; `shared` if more
      !> than two elements have it
      integer, allocatable :: twin(:)
      !> Edges by the lesser number of their corner nodes: those of node i are
      !> listed from start(i) to start(i + 1) - 1
      integer, allocatable :: start(:), list(:)
   end type edge_table_type

   !> Mark of an edge of more than two elements
   integer, parameter :: shared = -1

contains

   !> Find the edges of all elements whose nodes are known
   pure function new_edge_table(draft) result(table)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The edges
      type(edge_table_type) :: table

      integer :: element, side

      allocate (table%nodes(3, 4*draft%n_elements), table%element(4*draft%n_elements))
      do element = 1, draft%n_elements
         associate (nodes => draft%element_nodes(:, element), n => draft%element_size(element))
            if (any(nodes(:n) == 0)) cycle
            do side = 1, n_corners(n)
               table%n = table%n + 1
               table%nodes(:, table%n) = [nodes(side), nodes(mod(side, n_corners(n)) + 1), 0]
               if (n > 4) table%nodes(3, table%n) = nodes(n_corners(n) + side)
               table%element(table%n) = element
            end do
         end associate
      end do
      call list_by_node(table, draft%n_nodes)
      call find_twins(table)
   end function new_edge_table

   !> List the edges by the lesser of their corner nodes
   pure subroutine list_by_node(table, n_nodes)
      !> The edges
      type(edge_table_type), intent(inout) :: table
      !> Number of nodes
      integer, intent(in) :: n_nodes

      integer :: i, node
      integer, allocatable :: next(:)

      allocate (table%start(n_nodes + 1), source=0)
      do i = 1, table%n
         node = minval(table%nodes(:2, i))
         table%start(node + 1) = table%start(node + 1) + 1
      end do
      table%start(1) = 1
      do node = 1, n_nodes
         table%start(node + 1) = table%start(node + 1) + table%start(node)
      end do
      next = table%start
      allocate (table%list(table%n))
      do i = 1, table%n
         node = minval(table%nodes(:2, i))
         table%list(next(node)) = i
         next(node) = next(node) + 1
      end do
   end subroutine list_by_node

   !> Find the second element of each edge
   pure subroutine find_twins(table)
      !> The edges
      type(edge_table_type), intent(inout) :: table

      integer :: i, k, other, n_same, node

      allocate (table%twin(table%n), source=0)
      do i = 1, table%n
         node = minval(table%nodes(:2, i))
         n_same = 0
         do k = table%start(node), table%start(node + 1) - 1
            other = table%list(k)
            if (other == i .or. maxval(table%nodes(:2, other)) /= maxval(table%nodes(:2, i))) cycle
            n_same = n_same + 1
            table%twin(i) = other
         end do
         if (n_same > 1) table%twin(i) = shared
      end do
   end subroutine find_twins

   !> The edge between two nodes, one that has it if two elements do; 0 if there is none
   pure integer function find_edge(table, a, b) result(edge)
      !> The edges
      type(edge_table_type), intent(in) :: table
      !> The nodes
      integer, intent(in) :: a, b

      integer :: k

      do k = table%start(min(a, b)), table%start(min(a, b) + 1) - 1
         edge = table%list(k)
         if (maxval(table%nodes(:2, edge)) == max(a, b)) return
      end do
      edge = 0
   end function find_edge

   !> Whether nodes lie on outer edges
   pure function on_outer_edges(table, n_nodes) result(outer)
      !> The edges
      type(edge_table_type), intent(in) :: table
      !> Number of nodes
      integer, intent(in) :: n_nodes
      !> One a node
      logical, allocatable :: outer(:)

      integer :: i, k

      allocate (outer(n_nodes), source=.false.)
      do i = 1, table%n
         if (table%twin(i) /= 0) cycle
         do k = 1, 3
            if (table%nodes(k, i) > 0) outer(table%nodes(k, i)) = .true.
         end do
      end do
   end function on_outer_edges

   !> An edge in the direction in which a face runs
   pure function outer_edge(draft, table, edge, first) result(directed)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The edges
      type(edge_table_type), intent(in) :: table
      !> The edge
      integer, intent(in) :: edge
      !> Its first node in the direction of the face
      integer, intent(in) :: first
      !> The edge
      type(edge_type) :: directed

      real(wp) :: along(2), across(2)

      directed%nodes = table%nodes(:, edge)
      if (directed%nodes(1) /= first) directed%nodes(:2) = directed%nodes([2, 1])
      directed%element = table%element(edge)
      ! The side is taken from the element's place, not from its sense: a clockwise
      ! element is an error of its own.
      associate (x => draft%position(:, directed%nodes(:2)), &
                 n => n_corners(draft%element_size(directed%element)))
         associate (corners => draft%position(:, draft%element_nodes(:n, directed%element)))
            along = x(:, 2) - x(:, 1)
            across = sum(corners, 2)/n - 0.5_wp*(x(:, 1) + x(:, 2))
            directed%body_on_left = along(1)*across(2) - along(2)*across(1) > 0.0_wp
         end associate
      end associate
   end function outer_edge

   !> Check that neighbours fit together along their edges
   subroutine check_edges(draft, table, diagnostics)
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> The edges
      type(edge_table_type), intent(in) :: table
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: fault
      integer :: i, twin

      do i = 1, table%n
         twin = table%twin(i)
         if (twin == 0 .or. twin > i) cycle  ! told once, at the later of both elements
         fault = ''
         if (twin == shared) then
            fault = 'belongs to more than two elements'
         else if (table%nodes(3, i) /= table%nodes(3, twin)) then
            fault = 'has another middle node in element '// &
                    to_text(draft%element_label(table%element(twin)))
            if (any(table%nodes(3, [i, twin]) == 0)) &
               fault = 'has a middle node in only one of elements '// &
               to_text(draft%element_label(table%element(twin)))//' and '// &
               to_text(draft%element_label(table%element(i)))
         else if (table%nodes(1, i) == table%nodes(1, twin) .and. &
                  all(draft%element_good(table%element([i, twin])))) then
            fault = 'has elements '//to_text(draft%element_label(table%element(twin)))//' and '// &
                    to_text(draft%element_label(table%element(i)))// &
                    ' on the same side: they overlap'
         end if
         if (len(fault) == 0) cycle
         call add_error(diagnostics, draft%element_card(table%element(i)), 0, 0, &
                        'the edge '//to_text(draft%node_label(table%nodes(1, i)))//'-'// &
                        to_text(draft%node_label(table%nodes(2, i)))//' of element '// &
                        to_text(draft%element_label(table%element(i)))//' '//fault)
         draft%element_good(table%element(i)) = .false.
      end do
   end subroutine check_edges

end module axijoint_deck_mesh_edges
