!> What is known of a solver before it is used
module axijoint_solver_entry
   use axijoint_base_kinds, only : wp, i8
   use axijoint_order_orders, only : order_interface
   use axijoint_solver_type, only : solver_type
   implicit none
   private
   public :: solver_entry_type, cost_type, name_length

   !> Letters of the longest name: columns of its field on a card
   integer, parameter :: name_length = 10

   !> Time of forming and factoring one matrix at a given rate of matrix products:
   !> operations at a share of that rate, a time for each entry of the factor, which
   !> is memory taken, filled and written whatever the rate, and a time for each
   !> equation, whose row is ordered anew. The constants are fitted to factors of squares and
   !> runs of decks; see doc/benchmarks.md.
   type :: cost_type
      !> Share of the rate of large matrix products
      real(wp) :: share = 1.0_wp
      !> Time for each entry of a factor that is kept, so that it takes memory of its own, and of
      !> one in the memory of another [second]
      real(wp) :: kept_entry = 0.0_wp, passing_entry = 0.0_wp
      !> Time for each equation [second]
      real(wp) :: equation = 0.0_wp
   end type cost_type

   !> A solver that can be chosen
   type :: solver_entry_type
      !> Name on cards and the command line, in capitals
      character(len=name_length) :: name = ''
      !> Makes an empty plan
      procedure(plan_interface), pointer, nopass :: new_plan => null()
      !> The order of the nodes that suits it, and that order in words
      procedure(order_interface), pointer, nopass :: order => null()
      character(len=48) :: order_name = ''
      !> Expected time
      type(cost_type) :: cost
      !> Whether several threads may factor and solve at once
      logical :: concurrent = .true.
      !> Bytes that its library takes once it is used
      integer(i8) :: library_bytes = 0
      !> What its user should know, such as a licence, for listing and estimate; may be empty
      character(len=120) :: note = ''
   contains
      !> Expected time of one factorization
      procedure :: seconds
   end type solver_entry_type

   abstract interface
      !> An empty plan
      subroutine plan_interface(plan)
         import :: solver_type
         !> The plan
         class(solver_type), allocatable, intent(out) :: plan
      end subroutine plan_interface
   end interface

contains

   !> Time of forming and factoring one matrix
   pure real(wp) function seconds(self, plan, rate, kept)
      !> The solver
      class(solver_entry_type), intent(in) :: self
      !> Its plan, analysed
      class(solver_type), intent(in) :: plan
      !> Operations a second of a large matrix product
      real(wp), intent(in) :: rate
      !> Whether the factor is kept
      logical, intent(in) :: kept

      seconds = plan%operations/(self%cost%share*rate) &
         + merge(self%cost%kept_entry, self%cost%passing_entry, kept)*real(plan%factor_entries, &
         wp) &
         + self%cost%equation*plan%n
   end function seconds

end module axijoint_solver_entry
