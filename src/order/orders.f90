!> The orders of the nodes that solvers take, each found where it is wanted
module axijoint_order_orders
   use axijoint_base_error, only : error_type
   use axijoint_order_graph, only : graph_type, profile
   use axijoint_order_metis, only : nested_dissection
   use axijoint_order_rcm, only : reverse_cuthill_mckee
   use axijoint_order_sloan, only : sloan
   implicit none
   private
   public :: order_interface, least_bandwidth, least_profile, least_fill

   abstract interface
      !> An order of the nodes
      subroutine order_interface(graph, order, error)
         import :: graph_type, error_type
         !> Graph of the nodes
         type(graph_type), intent(in) :: graph
         !> order(k) is the k-th node
         integer, allocatable, intent(out) :: order(:)
         !> Out of memory
         type(error_type), allocatable, intent(out) :: error
      end subroutine order_interface
   end interface

contains

   !> The order for factors in a band: reverse Cuthill-McKee
   subroutine least_bandwidth(graph, order, error)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, allocatable, intent(out) :: order(:)
      !> None
      type(error_type), allocatable, intent(out) :: error

      call reverse_cuthill_mckee(graph, order)
   end subroutine least_bandwidth

   !> The order for factors below a skyline: Sloan, or reverse Cuthill-McKee if its profile is
   !> smaller
   subroutine least_profile(graph, order, error)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, allocatable, intent(out) :: order(:)
      !> None
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: other(:)

      call sloan(graph, order)
      call reverse_cuthill_mckee(graph, other)
      if (profile(graph, other) < profile(graph, order)) call move_alloc(other, order)
   end subroutine least_profile

   !> The order for sparse factors: nested dissection
   subroutine least_fill(graph, order, error)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node
      integer, allocatable, intent(out) :: order(:)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      call nested_dissection(graph, order, error)
   end subroutine least_fill

end module axijoint_order_orders
