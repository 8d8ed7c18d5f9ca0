!> The orders of the nodes that solvers choose from
module axijoint_order_orders
   use axijoint_base_error, only : error_type
   use axijoint_order_graph, only : graph_type, profile
   use axijoint_order_metis, only : nested_dissection
   use axijoint_order_rcm, only : reverse_cuthill_mckee
   use axijoint_order_sloan, only : sloan
   implicit none
   private
   public :: orders_type, new_orders, order_by_profile, dissect, least_bandwidth, least_profile, least_fill

   !> The nodes in different orders: order(k) is the k-th node
   type :: orders_type
      !> Graph of the nodes
      type(graph_type) :: graph
      !> Reverse Cuthill-McKee, Sloan, nested dissection; Sloan's may be left out
      integer, allocatable :: cuthill_mckee(:), sloan(:), dissection(:)
   end type orders_type

contains

   !> Order the nodes in every way
   subroutine new_orders(orders, graph, error, by_sloan)
      !> The orders
      type(orders_type), intent(out) :: orders
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Whether Sloan's order is wanted; true if absent
      logical, intent(in), optional :: by_sloan

      call order_by_profile(orders, graph, by_sloan)
      call dissect(orders, error)
   end subroutine new_orders

   !> Order the nodes for a band and a skyline
   subroutine order_by_profile(orders, graph, by_sloan)
      !> The orders, without nested dissection
      type(orders_type), intent(out) :: orders
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Whether Sloan's order is wanted; true if absent
      logical, intent(in), optional :: by_sloan

      logical :: wanted

      wanted = .true.
      if (present(by_sloan)) wanted = by_sloan
      orders%graph = graph
      call reverse_cuthill_mckee(graph, orders%cuthill_mckee)
      if (wanted) call sloan(graph, orders%sloan)
   end subroutine order_by_profile

   !> Order the nodes by nested dissection, which takes longest
   subroutine dissect(orders, error)
      !> The orders, those by profile there
      type(orders_type), intent(inout) :: orders
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      call nested_dissection(orders%graph, orders%dissection, error)
   end subroutine dissect

   !> The order for factors in a band: reverse Cuthill-McKee
   pure function least_bandwidth(orders) result(order)
      !> All orders
      type(orders_type), intent(in) :: orders
      !> order(k) is the k-th node
      integer, allocatable :: order(:)

      order = orders%cuthill_mckee
   end function least_bandwidth

   !> The order for factors below a skyline: Sloan, or reverse Cuthill-McKee if its profile is
   !> smaller
   pure function least_profile(orders) result(order)
      !> All orders
      type(orders_type), intent(in) :: orders
      !> order(k) is the k-th node
      integer, allocatable :: order(:)

      order = orders%sloan
      if (profile(orders%graph, orders%cuthill_mckee) < profile(orders%graph, order)) &
         order = orders%cuthill_mckee
   end function least_profile

   !> The order for sparse factors: nested dissection
   pure function least_fill(orders) result(order)
      !> All orders
      type(orders_type), intent(in) :: orders
      !> order(k) is the k-th node
      integer, allocatable :: order(:)

      order = orders%dissection
   end function least_fill

end module axijoint_order_orders
