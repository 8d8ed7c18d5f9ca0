!> Nested dissection by METIS
module axijoint_order_metis
   use, intrinsic :: iso_c_binding, only : c_int, c_int32_t, c_ptr, c_null_ptr
   use axijoint_base_error, only : error_type, fatal_error, exit_internal, memory_error
   use axijoint_order_followers, only : followers, with_followers
   use axijoint_order_graph, only : graph_type, subgraph
   implicit none
   private
   public :: nested_dissection

   !> METIS_OK
   integer(c_int32_t), parameter :: ok = 1
   !> METIS_ERROR_MEMORY
   integer(c_int32_t), parameter :: no_memory = -3
   !> Number of options
   integer, parameter :: n_options = 40
   !> Place of METIS_OPTION_NUMBERING, counted from one
   integer, parameter :: numbering = 18

   interface
      !> Fill the options with defaults
      function METIS_SetDefaultOptions(options) bind(c, name='METIS_SetDefaultOptions') result(code)
         import :: c_int32_t
         integer(c_int32_t), intent(out) :: options(*)
         integer(c_int32_t) :: code
      end function METIS_SetDefaultOptions
      !> Nested dissection ordering
      function METIS_NodeND(n, start, neighbour, weight, options, order, place) &
         bind(c, name='METIS_NodeND') result(code)
         import :: c_int32_t, c_ptr
         integer(c_int32_t), intent(in) :: n, start(*), neighbour(*), options(*)
         type(c_ptr), value :: weight
         integer(c_int32_t), intent(out) :: order(*), place(*)
         integer(c_int32_t) :: code
      end function METIS_NodeND
      !> Let a signal wait that METIS would take for an error of its own; metis_shim.c
      subroutine hold_termination(hold) bind(c, name='axijoint_hold_termination')
         import :: c_int
         integer(c_int), value :: hold
      end subroutine hold_termination
   end interface

contains

   !> Order of the nodes with little fill: separators last (Karypis and Kumar,
   !> SIAM J. Sci. Comput. 20, 1998)
   subroutine nested_dissection(graph, order, error)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node, shape (n)
      integer, allocatable, intent(out) :: order(:)
      !> Out of memory, or an error inside METIS
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: leaders(:)
      integer :: k

      leaders = pack([(k, k=1, graph%n)], .not. followers(graph))
      if (size(leaders) == graph%n) then
         call dissect(graph, order, error)
      else
         call dissect(subgraph(graph, leaders), order, error)
      end if
      if (allocated(error)) return
      order = with_followers(graph, leaders(order))
   end subroutine nested_dissection

   !> Order all nodes
   subroutine dissect(graph, order, error)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> order(k) is the k-th node, shape (n)
      integer, allocatable, intent(out) :: order(:)
      !> Out of memory, or an error inside METIS
      type(error_type), allocatable, intent(out) :: error

      integer(c_int32_t) :: options(n_options), place(graph%n), code

      allocate (order(graph%n))
      if (graph%n == 0) return
      code = METIS_SetDefaultOptions(options)
      options(numbering) = 1
      call hold_termination(1_c_int)
      code = METIS_NodeND(int(graph%n, c_int32_t), graph%start, graph%neighbour, c_null_ptr, &
                          options, order, place)
      call hold_termination(0_c_int)
      if (code == no_memory) then
         call memory_error(error, 'ordering by METIS')
      else if (code /= ok) then
         call fatal_error(error, exit_internal, 'METIS could not order the nodes')
      end if
   end subroutine dissect

end module axijoint_order_metis
