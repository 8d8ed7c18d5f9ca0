!> Graph of the nodes and sparsity of the stiffness
module axijoint_assembly_pattern
   use axijoint_assembly_dofs, only : dofs_type, first_equation
   use axijoint_base_kinds, only : i8
   use axijoint_base_sort, only : sort_short
   use axijoint_fe_shape, only : n_corners
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_model_mesh, only : mesh_type, n_nodes
   use axijoint_order_graph, only : graph_type, new_graph, max_ends
   implicit none
   private
   public :: node_graph, new_pattern

contains

   !> Graph of the nodes: elements and joints are its cliques
   function node_graph(mesh) result(graph)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The graph
      type(graph_type) :: graph

      integer, allocatable :: start(:), member(:), joint_start(:), joint_member(:)

      call list_nodes(mesh%element_size, mesh%element_nodes, start, member)
      call list_nodes(mesh%joint_size, mesh%joint_nodes, joint_start, joint_member)
      call new_graph(graph, n_nodes(mesh), [start, joint_start(2:) + size(member)], &
                     [member, joint_member])
      graph%between = nodes_between(mesh)
   end function node_graph

   !> Nodes that each node lies between: middles of sides and centres of elements, if they are that and no more to all
   !> elements and joints that they belong to
   function nodes_between(mesh) result(between)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Shape (max_ends, nodes), zeros behind the last
      integer, allocatable :: between(:, :)

      logical :: is_end(n_nodes(mesh))
      integer :: k, i, n

      allocate (between(max_ends, n_nodes(mesh)), source=0)
      is_end = .false.
      do k = 1, size(mesh%element_size)
         n = n_corners(mesh%element_size(k))
         associate (nodes => mesh%element_nodes(:mesh%element_size(k), k))
            is_end(nodes(:n)) = .true.
            do i = 1, min(n, size(nodes) - n)
               call place_between(nodes(n + i), [nodes(i), nodes(mod(i, n) + 1), 0, 0])
            end do
            if (size(nodes) > 2*n) call place_between(nodes(2*n + 1), nodes(:n))
         end associate
      end do
      do k = 1, size(mesh%joint_size)
         associate (nodes => mesh%joint_nodes(:mesh%joint_size(k), k))
            is_end(nodes(:4)) = .true.
            if (size(nodes) == 4) cycle
            call place_between(nodes(5), [nodes(1), nodes(2), 0, 0])
            call place_between(nodes(6), [nodes(4), nodes(3), 0, 0])
         end associate
      end do
      do k = 1, size(is_end)
         if (is_end(k)) between(:, k) = 0
      end do

   contains

      !> Place a node between others
      subroutine place_between(node, ends)
         !> The node
         integer, intent(in) :: node
         !> The others
         integer, intent(in) :: ends(max_ends)

         integer :: j

         if (between(1, node) == 0) between(:, node) = ends
         do j = 1, max_ends
            is_end(node) = is_end(node) .or. .not. any(between(:, node) == ends(j))
         end do
      end subroutine place_between

   end function nodes_between

   !> Node lists of different lengths one behind the other
   pure subroutine list_nodes(sizes, nodes, start, member)
      !> Number of nodes of each list
      integer, intent(in) :: sizes(:)
      !> The nodes, shape (any, lists); only the first of each list are in use
      integer, intent(in) :: nodes(:, :)
      !> First node of each list in `member`, shape (lists + 1)
      integer, allocatable, intent(out) :: start(:)
      !> The nodes
      integer, allocatable, intent(out) :: member(:)

      integer :: i

      allocate (start(size(sizes) + 1), member(sum(sizes)))
      start(1) = 1
      do i = 1, size(sizes)
         start(i + 1) = start(i) + sizes(i)
         member(start(i):start(i + 1) - 1) = nodes(:sizes(i), i)
      end do
   end subroutine list_nodes

   !> Sparsity of the stiffness, lower triangle
   subroutine new_pattern(pattern, graph, dofs, order)
      !> The pattern, without values
      type(symmetric_matrix_type), intent(out) :: pattern
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> The unknowns, numbered in the same order
      type(dofs_type), intent(in) :: dofs
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)

      integer, allocatable :: columns(:), first(:)
      integer(i8) :: count
      integer :: k, i, j, node, row, n_columns

      allocate (first(graph%n))
      do node = 1, graph%n
         first(node) = first_equation(dofs%equation(:, node))
      end do
      allocate (pattern%row_start(dofs%n_equations + 1), pattern%column(n_entries(graph, dofs, first)))
      allocate (columns(3*(1 + maxval([0, graph%start(2:) - graph%start(:graph%n)]))))
      pattern%n = dofs%n_equations
      count = 0
      row = 0
      do k = 1, size(order)
         node = order(k)
         if (first(node) == 0) cycle
         call coupled_equations(node, graph, dofs, first, columns, n_columns)
         do i = 1, 3
            if (dofs%equation(i, node) /= row + 1) cycle  ! none, or that of another component
            row = row + 1
            pattern%row_start(row) = count + 1
            do j = 1, n_columns
               if (columns(j) > row) exit
               count = count + 1
               pattern%column(count) = columns(j)
            end do
         end do
      end do
      pattern%row_start(pattern%n + 1) = count + 1
   end subroutine new_pattern

   !> Entries of the lower triangle: each equation of a node with those of the neighbours before it, and with those
   !> of its own up to itself
   pure integer(i8) function n_entries(graph, dofs, first)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> The unknowns
      type(dofs_type), intent(in) :: dofs
      !> First equation of each node, or zero
      integer, intent(in) :: first(:)

      integer :: own(graph%n), node, l
      integer(i8) :: before

      do node = 1, graph%n
         associate (equation => dofs%equation(:, node))
            own(node) = count(equation > 0)
            if (equation(3) > 0 .and. equation(3) == equation(1)) own(node) = own(node) - 1  ! w tied to u
         end associate
      end do
      n_entries = 0
      do node = 1, graph%n
         if (own(node) == 0) cycle
         before = 0
         do l = graph%start(node), graph%start(node + 1) - 1
            associate (other => graph%neighbour(l))
               if (first(other) < first(node)) before = before + own(other)  ! without equations it adds nothing
            end associate
         end do
         n_entries = n_entries + own(node)*before + (own(node)*(own(node) + 1))/2
      end do
   end function n_entries

   !> Equations of a node and of its neighbours before it, ascending: those of a node follow each other
   subroutine coupled_equations(node, graph, dofs, first, columns, n_columns)
      !> Node
      integer, intent(in) :: node
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> The unknowns
      type(dofs_type), intent(in) :: dofs
      !> First equation of each node, or zero
      integer, intent(in) :: first(:)
      !> The equations, the first n_columns
      integer, intent(inout) :: columns(:)
      !> How many
      integer, intent(out) :: n_columns

      integer :: nodes(1 + graph%start(node + 1) - graph%start(node)), n, l, i

      n = 0
      do l = graph%start(node), graph%start(node + 1) - 1
         if (first(graph%neighbour(l)) == 0 .or. first(graph%neighbour(l)) > first(node)) cycle
         n = n + 1
         nodes(n) = graph%neighbour(l)
      end do
      call sort_short(nodes(:n), first)
      n = n + 1
      nodes(n) = node
      n_columns = 0
      do l = 1, n
         associate (equation => dofs%equation(:, nodes(l)))
            do i = 1, 3
               if (equation(i) == 0) cycle
               if (i == 3 .and. equation(3) == equation(1)) cycle  ! w tied to u
               n_columns = n_columns + 1
               columns(n_columns) = equation(i)
            end do
         end associate
      end do
   end subroutine coupled_equations

end module axijoint_assembly_pattern
