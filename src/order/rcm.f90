!> Reverse Cuthill-McKee ordering
module axijoint_order_rcm
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: reverse_cuthill_mckee

contains

   !> Order of the nodes that keeps neighbours close: levels of breadth from a
   !> node at the rim, each level by degree, then all reversed (George and Liu,
   !> Computer Solution of Large Sparse Positive Definite Systems, 1981, ch. 4)
   subroutine reverse_cuthill_mckee(graph, order)
      !> Graph of the nodes; may have several components
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node, shape (n)
      integer, allocatable, intent(out) :: order(:)

      logical, allocatable :: taken(:)
      integer :: seed, first, last

      allocate (order(graph%n), taken(graph%n))
      taken = .false.
      last = 0
      do seed = 1, graph%n
         if (taken(seed)) cycle
         first = last + 1
         call cuthill_mckee(graph, rim_node(graph, seed, taken), taken, order, last)
         order(first:last) = order(last:first:-1)
      end do
   end subroutine reverse_cuthill_mckee

   !> A node at the end of a long path (pseudo-peripheral): go to a node of
   !> least degree in the last level as long as that adds levels
   function rim_node(graph, seed, taken) result(node)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Node of the component
      integer, intent(in) :: seed
      !> Nodes of finished components
      logical, intent(in) :: taken(:)
      !> Node at the rim
      integer :: node

      integer, allocatable :: list(:), level(:)
      logical, allocatable :: seen(:)
      integer :: depth, candidate, k, last

      allocate (list(graph%n), level(graph%n))
      node = seed
      depth = -1
      do
         seen = taken
         last = 0
         call cuthill_mckee(graph, node, seen, list, last, level)
         if (level(list(last)) <= depth) exit
         depth = level(list(last))
         candidate = list(last)
         do k = last, 1, -1
            if (level(list(k)) < depth) exit
            if (degree(graph, list(k)) < degree(graph, candidate)) candidate = list(k)
         end do
         if (candidate == node) exit
         node = candidate
      end do
   end function rim_node

   !> Cuthill-McKee order of the component of a node
   subroutine cuthill_mckee(graph, root, taken, order, last, level)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> First node
      integer, intent(in) :: root
      !> Nodes that have been numbered
      logical, intent(inout) :: taken(:)
      !> Order of the nodes; filled on from `last`
      integer, intent(inout) :: order(:)
      !> Number of nodes in `order`
      integer, intent(inout) :: last
      !> Distance of each node of the component from the root
      integer, intent(inout), optional :: level(:)

      integer :: head, node, k, first

      last = last + 1
      order(last) = root
      taken(root) = .true.
      if (present(level)) level(root) = 0
      head = last
      do while (head <= last)
         node = order(head)
         first = last + 1
         do k = graph%start(node), graph%start(node + 1) - 1
            associate (next => graph%neighbour(k))
               if (taken(next)) cycle
               taken(next) = .true.
               if (present(level)) level(next) = level(node) + 1
               last = last + 1
               order(last) = next
            end associate
         end do
         call sort_by_degree(graph, order(first:last))
         head = head + 1
      end do
   end subroutine cuthill_mckee

   !> Sort a short list of nodes by degree; equals keep their order
   pure subroutine sort_by_degree(graph, list)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> The nodes
      integer, intent(inout) :: list(:)

      integer :: i, j, key

      do i = 2, size(list)
         key = list(i)
         j = i - 1
         do while (j >= 1)
            if (degree(graph, list(j)) <= degree(graph, key)) exit
            list(j + 1) = list(j)
            j = j - 1
         end do
         list(j + 1) = key
      end do
   end subroutine sort_by_degree

   !> Number of neighbours
   pure integer function degree(graph, node)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Node
      integer, intent(in) :: node

      degree = graph%start(node + 1) - graph%start(node)
   end function degree

end module axijoint_order_rcm
