!> Reverse Cuthill-McKee ordering
module axijoint_order_rcm
   use axijoint_base_sort, only : sort_short
   use axijoint_order_graph, only : graph_type, degree
   use axijoint_order_levels, only : find_ends
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

      !> Negative for the nodes that are not numbered yet
      integer, allocatable :: mark(:)
      !> Nodes of a component by distance
      integer, allocatable :: list(:)
      !> Number of neighbours of each node
      integer, allocatable :: degrees(:)
      integer :: seed, first, last, start, finish

      allocate (order(graph%n), mark(graph%n), list(graph%n))
      mark = -1
      degrees = [(degree(graph, seed), seed=1, graph%n)]
      last = 0
      do seed = 1, graph%n
         if (mark(seed) >= 0) cycle
         first = last + 1
         call find_ends(graph, seed, mark, list, start, finish)
         call cuthill_mckee(graph, degrees, start, mark, order, last)
         order(first:last) = order(last:first:-1)
      end do
   end subroutine reverse_cuthill_mckee

   !> Cuthill-McKee order of the component of a node
   subroutine cuthill_mckee(graph, degrees, root, mark, order, last)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Number of neighbours of each node
      integer, intent(in) :: degrees(:)
      !> First node
      integer, intent(in) :: root
      !> Negative for the nodes that are not numbered yet
      integer, intent(inout) :: mark(:)
      !> Order of the nodes; filled on from `last`
      integer, intent(inout) :: order(:)
      !> Number of nodes in `order`
      integer, intent(inout) :: last

      integer :: head, node, k, first

      last = last + 1
      order(last) = root
      mark(root) = 0
      head = last
      do while (head <= last)
         node = order(head)
         first = last + 1
         do k = graph%start(node), graph%start(node + 1) - 1
            associate (next => graph%neighbour(k))
               if (mark(next) >= 0) cycle
               mark(next) = 0
               last = last + 1
               order(last) = next
            end associate
         end do
         call sort_short(order(first:last), degrees)
         head = head + 1
      end do
   end subroutine cuthill_mckee

end module axijoint_order_rcm
