!> `axijoint estimate`: what decks would cost
module axijoint_command_estimate
   use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
   use axijoint_analysis_core_estimate, only : estimate_type, estimate_job
   use axijoint_assembly_pattern, only : node_graph
   use axijoint_base_error, only : error_type, exit_ok, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_command_line, only : command_type
   use axijoint_command_run, only : print_error
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_job_job, only : job_type, deck_name
   use axijoint_job_read, only : read_job
   use axijoint_linalg_lapack, only : product_rate
   use axijoint_model_model, only : model_type, yielding_nodes
   use axijoint_order_orders, only : orders_type, new_orders
   use axijoint_solver_entry, only : solver_entry_type
   use omp_lib, only : omp_set_num_threads
   implicit none
   private
   public :: estimate_decks

   !> Solver, equations, entries, operations, factors, memory, time
   character(len=*), parameter :: format_row = '(2x, a10, i12, es16.3, es16.3, i9, f13.1, f15.4)'

contains

   !> Print the costs of each deck with each solver
   subroutine estimate_decks(command, exit_code)
      !> Decks and options
      type(command_type), intent(in) :: command
      !> Largest exit code of all decks
      integer, intent(out) :: exit_code

      type(job_type) :: job
      type(diagnostics_type) :: diagnostics
      type(error_type), allocatable :: error
      real(wp) :: rate
      integer :: k

      exit_code = exit_ok
      if (command%threads > 0) call omp_set_num_threads(command%threads)
      rate = product_rate()
      job%options = command%options
      do k = 1, size(command%decks)
         call read_job(command%decks(k)%text, job, diagnostics)
         if (diagnostics%n_errors > 0) then
            write (error_unit, '(a)') render(diagnostics, job%source)
            exit_code = max(exit_code, exit_deck)
            cycle
         end if
         call estimate_deck(deck_name(command%decks(k)%text), job%model, command%solvers, rate, &
                            error)
         if (allocated(error)) then
            call print_error(command%decks(k)%text, error)
            exit_code = max(exit_code, error%code)
         end if
      end do
   end subroutine estimate_decks

   !> Print the costs of one deck
   subroutine estimate_deck(deck, model, solvers, rate, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> The job
      type(model_type), intent(in) :: model
      !> The solvers
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Rate of large matrix products [operations/second]
      real(wp), intent(in) :: rate
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(estimate_type) :: estimate
      type(orders_type) :: orders
      integer :: k

      call new_orders(orders, node_graph(model%mesh), yielding_nodes(model), error)
      if (allocated(error)) return
      do k = 1, size(solvers)
         call estimate_job(model, orders, solvers(k), rate, estimate, error)
         if (allocated(error)) return
         if (k == 1) then
            write (output_unit, '(a, i0, a, f0.1, a)') deck//': ', estimate%n_harmonics, &
               ' harmonics; matrix products at ', rate/1.0e9_wp, ' GFLOP/s in one thread'
            write (output_unit, '(a)') '  solver       equations  factor entries      '// &
               'operations'// &
               '  at once  memory [MB]  factoring [s]'
         end if
         write (output_unit, format_row) solvers(k)%name, estimate%n_equations, &
            real(estimate%factor_entries, wp), estimate%operations, estimate%n_factors, &
            real(estimate%bytes, wp)/2.0_wp**20, estimate%seconds
      end do
      do k = 1, size(solvers)
         if (solvers(k)%note /= '') write (output_unit, '(2x, a)') trim(solvers(k)%note)
      end do
   end subroutine estimate_deck

end module axijoint_command_estimate
