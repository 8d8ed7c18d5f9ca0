!> Sloan's ordering for a small profile
module axijoint_order_sloan
   use axijoint_order_graph, only : graph_type, degree
   use axijoint_order_levels, only : breadth_first, find_ends
   implicit none
   private
   public :: sloan

   !> Weight of the distance from the end, and of the growth of the front
   !> (Sloan, Int. J. Numer. Meth. Engng. 23, 1986, p. 239-251)
   integer, parameter :: weight_distance = 1, weight_front = 2

   !> Far from the front; next to the front; in the front; numbered
   integer, parameter :: inactive = 0, preactive = 1, active = 2, numbered = 3

   !> State of the numbering
   type :: front_type
      !> One of the states above for each node
      integer, allocatable :: state(:)
      !> The higher, the sooner a node is numbered
      integer, allocatable :: priority(:)
      !> Nodes that are preactive or active, the first n_queue
      integer, allocatable :: queue(:)
      !> Their number
      integer :: n_queue = 0
   end type front_type

contains

   !> Order of the nodes with a small profile: from one end of the graph to the
   !> other, those first that widen the front least
   subroutine sloan(graph, order)
      !> Graph of the nodes; may have several components
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node, shape (n)
      integer, allocatable, intent(out) :: order(:)

      type(front_type) :: front
      integer, allocatable :: distance(:), list(:)
      integer :: seed, start, finish, n_list, last, k

      allocate (order(graph%n), list(graph%n), front%queue(graph%n))
      allocate (front%state(graph%n), source=inactive)
      allocate (front%priority(graph%n), source=0)
      allocate (distance(graph%n), source=-1)
      last = 0
      do seed = 1, graph%n
         if (front%state(seed) == numbered) cycle
         call find_ends(graph, seed, distance, list, start, finish)
         call breadth_first(graph, finish, distance, list, n_list)
         do k = 1, n_list
            front%priority(list(k)) = weight_distance*distance(list(k)) &
               - weight_front*(degree(graph, list(k)) + 1)
         end do
         call number_component(graph, start, front, order, last)
      end do
   end subroutine sloan

   !> Number the component of a node
   subroutine number_component(graph, start, front, order, last)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> First node
      integer, intent(in) :: start
      !> State of the numbering
      type(front_type), intent(inout) :: front
      !> Order of the nodes; filled on from `last`
      integer, intent(inout) :: order(:)
      !> Number of nodes in `order`
      integer, intent(inout) :: last

      integer :: place, node, k, l

      call enqueue(front, start)
      do while (front%n_queue > 0)
         place = maxloc(front%priority(front%queue(:front%n_queue)), 1)
         node = front%queue(place)
         front%queue(place) = front%queue(front%n_queue)
         front%n_queue = front%n_queue - 1
         if (front%state(node) == preactive) then
            do k = graph%start(node), graph%start(node + 1) - 1
               call raise(front, graph%neighbour(k))
            end do
         end if
         last = last + 1
         order(last) = node
         front%state(node) = numbered
         do k = graph%start(node), graph%start(node + 1) - 1
            associate (next => graph%neighbour(k))
               if (front%state(next) /= preactive) cycle
               front%state(next) = active
               front%priority(next) = front%priority(next) + weight_front
               do l = graph%start(next), graph%start(next + 1) - 1
                  call raise(front, graph%neighbour(l))
               end do
            end associate
         end do
      end do
   end subroutine number_component

   !> A neighbour of the node came into the front: number it sooner
   subroutine raise(front, node)
      !> State of the numbering
      type(front_type), intent(inout) :: front
      !> The node
      integer, intent(in) :: node

      if (front%state(node) == numbered) return
      front%priority(node) = front%priority(node) + weight_front
      if (front%state(node) == inactive) call enqueue(front, node)
   end subroutine raise

   !> Put a node next to the front
   subroutine enqueue(front, node)
      !> State of the numbering
      type(front_type), intent(inout) :: front
      !> The node
      integer, intent(in) :: node

      front%state(node) = preactive
      front%n_queue = front%n_queue + 1
      front%queue(front%n_queue) = node
   end subroutine enqueue

end module axijoint_order_sloan
