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
   pure function followers(graph) result(follows)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Shape (n)
      logical :: follows(graph%n)

      follows = .false.
      if (allocated(graph%between)) follows = any(graph%between > 0, dim=1)
   end function followers

   !> Put followers just before the first of those that they lie between: centres before sides, as their
   !> neighbours are all neighbours of each other
   function with_followers(graph, leaders) result(order)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Nodes that follow none, in their order
      integer, intent(in) :: leaders(:)
      !> All nodes in their order
      integer, allocatable :: order(:)

      logical :: waiting(graph%n)
      integer :: k, n

      waiting = .true.
      waiting(leaders) = .false.
      if (.not. any(waiting)) then
         order = leaders
         return
      end if
      allocate (order(graph%n))
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
