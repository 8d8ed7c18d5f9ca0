!> Which solver: its name, its order of the nodes, and what it is expected to cost
module axijoint_solver_choice
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_order_graph, only : graph_type, profile
   use axijoint_order_metis, only : nested_dissection
   use axijoint_order_rcm, only : reverse_cuthill_mckee
   use axijoint_order_sloan, only : sloan
   use axijoint_solver_band, only : band_solver_type
   use axijoint_solver_skyline, only : skyline_solver_type
   use axijoint_solver_sparse, only : sparse_solver_type
   use axijoint_solver_type, only : solver_type
   implicit none
   private
   public :: solver_auto, solver_band, solver_sparse, solver_names
   public :: orders_type, new_orders, order_for, new_solver, order_name, expected_seconds

   !> The solver with the least expected time
   integer, parameter :: solver_auto = 0
   !> LAPACK band Cholesky on a reverse Cuthill-McKee order
   integer, parameter :: solver_band = 1
   !> Skyline Cholesky on Sloan's order, or reverse Cuthill-McKee if smaller
   integer, parameter :: solver_skyline = 2
   !> Supernodal Cholesky on a nested dissection order
   integer, parameter :: solver_sparse = 3
   !> Names on cards and the command line, by number
   character(len=*), parameter :: solver_names(0:3) = ['AUTO   ', 'BAND   ', 'SKYLINE', 'SPARSE ']

   !> The nodes in different orders: order(k) is the k-th node
   type :: orders_type
      !> Graph of the nodes
      type(graph_type) :: graph
      !> Reverse Cuthill-McKee, Sloan, nested dissection
      integer, allocatable :: cuthill_mckee(:), sloan(:), dissection(:)
   end type orders_type

contains

   !> An empty plan of a kind
   subroutine new_solver(solver, kind)
      !> The plan
      class(solver_type), allocatable, intent(out) :: solver
      !> One of the `solver_` parameters, not auto
      integer, intent(in) :: kind

      select case (kind)
      case (solver_band)
         allocate (band_solver_type :: solver)
      case (solver_skyline)
         allocate (skyline_solver_type :: solver)
      case default
         allocate (sparse_solver_type :: solver)
      end select
   end subroutine new_solver

   !> Order the nodes in every way
   subroutine new_orders(orders, graph, last, error)
      !> The orders
      type(orders_type), intent(out) :: orders
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Nodes whose flexibility is wanted: nested dissection orders them behind
      !> all others, so that the factor holds their Schur complement
      logical, intent(in), optional :: last(:)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      orders%graph = graph
      call reverse_cuthill_mckee(graph, orders%cuthill_mckee)
      call sloan(graph, orders%sloan)
      if (present(last)) then
         associate (k => orders%cuthill_mckee)
            call nested_dissection(graph, orders%dissection, pack(k, last(k)), error)
         end associate
      else
         call nested_dissection(graph, orders%dissection, error=error)
      end if
   end subroutine new_orders

   !> Order of the nodes that suits a solver
   pure function order_for(orders, kind) result(order)
      !> All orders
      type(orders_type), intent(in) :: orders
      !> One of the `solver_` parameters, not auto
      integer, intent(in) :: kind
      !> order(k) is the k-th node
      integer, allocatable :: order(:)

      select case (kind)
      case (solver_band)
         order = orders%cuthill_mckee
      case (solver_skyline)
         order = orders%sloan
         if (profile(orders%graph, orders%cuthill_mckee) < profile(orders%graph, order)) then
            order = orders%cuthill_mckee
         end if
      case default
         order = orders%dissection
      end select
   end function order_for

   !> Name of the order that suits a solver
   pure function order_name(kind) result(name)
      !> One of the `solver_` parameters, not auto
      integer, intent(in) :: kind
      !> The name
      character(len=:), allocatable :: name

      select case (kind)
      case (solver_band)
         name = 'reverse Cuthill-McKee'
      case (solver_skyline)
         name = 'Sloan, or reverse Cuthill-McKee if smaller'
      case default
         name = 'nested dissection (METIS)'
      end select
   end function order_name

   !> Time of forming and factoring one matrix at a given rate of matrix products:
   !> operations at a share of that rate, a time for each entry of the factor, which
   !> is memory taken, filled and written whatever the rate, and a time for each
   !> equation, whose row is formed and ordered anew. The constants are fitted to
   !> runs of decks; see doc/benchmarks.md.
   pure function expected_seconds(solver, kind, rate, kept) result(seconds)
      !> The plan, analysed
      class(solver_type), intent(in) :: solver
      !> Its kind
      integer, intent(in) :: kind
      !> Operations a second of a large matrix product
      real(wp), intent(in) :: rate
      !> Whether the factor is kept, so that it takes memory of its own
      logical, intent(in) :: kept
      !> The time
      real(wp) :: seconds

      real(wp) :: share, entry_seconds, equation_seconds

      select case (kind)
      case (solver_band)
         share = 0.83_wp
         entry_seconds = merge(5.7e-9_wp, 3.0e-9_wp, kept)
         equation_seconds = 3.0e-7_wp
      case (solver_skyline)
         share = 0.14_wp
         entry_seconds = 0.0_wp
         equation_seconds = 3.0e-7_wp
      case default
         share = 0.76_wp
         entry_seconds = merge(9.0e-9_wp, 7.0e-9_wp, kept)
         equation_seconds = 2.0e-7_wp
      end select
      seconds = solver%operations/(share*rate) + entry_seconds*real(solver%factor_entries, wp) &
         + equation_seconds*solver%n
   end function expected_seconds

end module axijoint_solver_choice
