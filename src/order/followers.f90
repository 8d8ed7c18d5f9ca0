!> Nodes that need not be thought of when others are ordered
!>
!> The middle of a side belongs to the elements that share the side, and its two ends belong to all of these; likewise
!> the centre of an element and its corners. Where corners separate two parts of a mesh, so do they together with
!> the middles of sides between two of them, and any other middle lies on the side of its end. So corners alone
!> are ordered, a quarter of the nodes of quadratic elements, and each of the others follows the first
!> of its ends: it is eliminated just before it, when all its neighbours are still there or close to it.
module axijoint_order_followers
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: followers, with_followers

contains

   !> Which nodes follow another one
   pure function followers(graph, free) result(follows)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Nodes that are ordered; who lies between others alone follows none, shape (n)
      logical, intent(in) :: free(:)
      !> Shape (n)
      logical :: follows(size(free))

      integer :: node

      follows = .false.
      if (.not. allocated(graph%between)) return
      do node = 1, graph%n
         follows(node) = any(free(pack(graph%between(:, node), graph%between(:, node) > 0)))
      end do
      follows = follows .and. free
   end function followers

   !> Put followers just before the first of those that they lie between: centres before sides, as their
   !> neighbours are all neighbours of each other
   function with_followers(graph, free, leaders) result(order)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Nodes that are ordered, shape (n)
      logical, intent(in) :: free(:)
      !> Those of them that follow none, in their order
      integer, intent(in) :: leaders(:)
      !> All of them in their order
      integer, allocatable :: order(:)

      logical :: waiting(size(free))
      integer :: k, n

      waiting = free
      waiting(leaders) = .false.
      if (.not. any(waiting)) then
         order = leaders
         return
      end if
      allocate (order(count(free)))
      n = 0
      do k = 1, size(leaders)
         call place_around(leaders(k), centres=.true.)
         call place_around(leaders(k), centres=.false.)
         n = n + 1
         order(n) = leaders(k)
      end do

   contains

      !> Place the followers of a node that wait
      subroutine place_around(node, centres)
         !> The node
         integer, intent(in) :: node
         !> Whether those that lie between more than two others, or the rest
         logical, intent(in) :: centres

         integer :: l

         do l = graph%start(node), graph%start(node + 1) - 1
            associate (other => graph%neighbour(l))
               if (.not. waiting(other)) cycle
               if (centres .neqv. graph%between(3, other) > 0) cycle
               if (.not. any(graph%between(:, other) == node)) cycle
               waiting(other) = .false.
               n = n + 1
               order(n) = other
            end associate
         end do
      end subroutine place_around

   end function with_followers

end module axijoint_order_followers
