!> Graph of the nodes: who shares an element or a joint with whom
module axijoint_order_graph
   use axijoint_base_kinds, only : i8
   implicit none
   private
   public :: graph_type, new_graph, subgraph, degree, bandwidth, profile, fill, max_ends

   !> Nodes that a node lies between at most: the corners of a quadrilateral, of its centre
   integer, parameter :: max_ends = 4

   !> Neighbours of each node, the node itself left out
   type :: graph_type
      !> Number of nodes
      integer :: n = 0
      !> First neighbour of each node in `neighbour`, shape (n + 1)
      integer, allocatable :: start(:)
      !> The neighbours, ascending for each node
      integer, allocatable :: neighbour(:)
      !> Nodes that each node lies between, as the middle of a side between its ends: every clique that
      !> holds the node holds them, too. Shape (max_ends, n), zeros behind the last; not allocated if unknown
      integer, allocatable :: between(:, :)
   end type graph_type

contains

   !> Graph of cliques: all members of a clique are neighbours
   subroutine new_graph(graph, n, clique_start, member)
      !> The graph
      type(graph_type), intent(out) :: graph
      !> Number of nodes
      integer, intent(in) :: n
      !> First member of each clique in `member`, shape (cliques + 1)
      integer, intent(in) :: clique_start(:)
      !> Nodes of the cliques
      integer, intent(in) :: member(:)

      integer, allocatable :: touch_start(:), touch(:), found(:), next(:)
      integer :: pass, node, k, l, clique

      call invert(n, clique_start, member, touch_start, touch)
      graph%n = n
      allocate (graph%start(n + 1), found(n), next(n))
      next = 0
      do pass = 1, 2  ! count the neighbours, then store each node with all of them: their lists ascend
         found = 0
         do node = 1, n
            found(node) = node
            do k = touch_start(node), touch_start(node + 1) - 1
               clique = touch(k)
               do l = clique_start(clique), clique_start(clique + 1) - 1
                  associate (other => member(l))
                     if (found(other) == node) cycle
                     found(other) = node
                     if (pass == 2) graph%neighbour(next(other)) = node
                     next(other) = next(other) + 1
                  end associate
               end do
            end do
         end do
         if (pass == 2) exit
         graph%start(1) = 1
         do node = 1, n
            graph%start(node + 1) = graph%start(node) + next(node)
         end do
         allocate (graph%neighbour(graph%start(n + 1) - 1))
         next = graph%start(:n)
      end do
   end subroutine new_graph

   !> Graph of some of the nodes
   pure function subgraph(graph, nodes) result(part)
      !> Graph of all nodes
      type(graph_type), intent(in) :: graph
      !> Nodes of the part, ascending: its node k is nodes(k)
      integer, intent(in) :: nodes(:)
      !> The graph of the part
      type(graph_type) :: part

      integer :: place(graph%n), k, l, count

      place = 0
      place(nodes) = [(k, k=1, size(nodes))]
      part%n = size(nodes)
      allocate (part%start(part%n + 1), part%neighbour(size(graph%neighbour)))
      count = 0
      do k = 1, part%n
         part%start(k) = count + 1
         do l = graph%start(nodes(k)), graph%start(nodes(k) + 1) - 1
            if (place(graph%neighbour(l)) == 0) cycle
            count = count + 1
            part%neighbour(count) = place(graph%neighbour(l))
         end do
      end do
      part%start(part%n + 1) = count + 1
      part%neighbour = part%neighbour(:count)
   end function subgraph

   !> Cliques that each node belongs to
   subroutine invert(n, clique_start, member, touch_start, touch)
      !> Number of nodes
      integer, intent(in) :: n
      !> First member of each clique in `member`
      integer, intent(in) :: clique_start(:)
      !> Nodes of the cliques
      integer, intent(in) :: member(:)
      !> First clique of each node in `touch`, shape (n + 1)
      integer, allocatable, intent(out) :: touch_start(:)
      !> Cliques of the nodes
      integer, allocatable, intent(out) :: touch(:)

      integer :: clique, k, node

      allocate (touch_start(n + 2), touch(size(member)))
      touch_start = 0
      do k = 1, size(member)
         touch_start(member(k) + 2) = touch_start(member(k) + 2) + 1
      end do
      touch_start(1:2) = 1
      do node = 2, n + 1
         touch_start(node + 1) = touch_start(node + 1) + touch_start(node)
      end do
      do clique = 1, size(clique_start) - 1
         do k = clique_start(clique), clique_start(clique + 1) - 1
            node = member(k)
            touch(touch_start(node + 1)) = clique
            touch_start(node + 1) = touch_start(node + 1) + 1
         end do
      end do
   end subroutine invert

   !> Number of neighbours
   pure integer function degree(graph, node)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Node
      integer, intent(in) :: node

      degree = graph%start(node + 1) - graph%start(node)
   end function degree

   !> Half-bandwidth of an order: the largest distance of neighbours
   pure integer function bandwidth(graph, order)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)

      bandwidth = maxval([0, reach(graph, order)])
   end function bandwidth

   !> Profile of an order: the sum over the nodes of the distance to the first
   !> neighbour
   pure function profile(graph, order)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)
      !> The profile
      integer(i8) :: profile

      profile = sum(int(reach(graph, order), i8))
   end function profile

   !> Entries of the Cholesky factor of an order, the diagonal among them, on the
   !> graph of the nodes. Row k has the places on the ways from its neighbours up
   !> the elimination tree (Liu, SIAM J. Matrix Anal. Appl. 11, 1990)
   pure function fill(graph, order)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)
      !> The entries
      integer(i8) :: fill

      integer, allocatable :: place(:), parent(:), seen(:)
      integer :: k, l, way

      allocate (place(graph%n), parent(graph%n), seen(graph%n), source=0)
      place(order) = [(k, k=1, size(order))]
      fill = size(order)
      do k = 1, size(order)
         seen(k) = k
         do l = graph%start(order(k)), graph%start(order(k) + 1) - 1
            way = place(graph%neighbour(l))
            do while (way < k)
               if (seen(way) == k) exit
               seen(way) = k
               fill = fill + 1
               if (parent(way) == 0) parent(way) = k
               way = parent(way)
            end do
         end do
      end do
   end function fill

   !> Distance of each place in an order back to its first neighbour
   pure function reach(graph, order)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)
      !> The distances
      integer :: reach(size(order))

      integer :: place(size(order)), k

      place(order) = [(k, k=1, size(order))]
      do k = 1, size(order)
         associate (neighbours => graph%neighbour(graph%start(order(k)):graph%start(order(k) + &
            1) - 1))
            reach(k) = k - minval([k, place(neighbours)])
         end associate
      end do
   end function reach

end module axijoint_order_graph
