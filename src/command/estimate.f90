!> `axijoint estimate`: what decks would cost
module axijoint_command_estimate
   use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_error, only : error_type, exit_ok, exit_deck
   use axijoint_command_estimate_table, only : print_forecast, print_counts
   use axijoint_command_job_lines, only : needs_type, add_needs, print_job_lines
   use axijoint_command_line, only : command_type
   use axijoint_command_run, only : print_error
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_estimate_forecast, only : forecast_type, plan_run, forecast_run
   use axijoint_estimate_machine, only : machine_type, this_machine
   use axijoint_job_job, only : job_type
   use axijoint_job_read, only : read_job
   use omp_lib, only : omp_set_num_threads
   implicit none
   private
   public :: estimate_decks

contains

   !> Print what a run of each deck would take, or the lines of a job script for the largest
   subroutine estimate_decks(command, exit_code)
      !> Decks and options
      type(command_type), intent(in) :: command
      !> Largest exit code of all decks
      integer, intent(out) :: exit_code

      type(machine_type) :: machine
      type(needs_type) :: needs
      type(error_type), allocatable :: error
      integer :: k

      exit_code = exit_ok
      if (command%threads > 0) call omp_set_num_threads(command%threads)
      machine = this_machine()
      do k = 1, size(command%decks)
         call estimate_deck(command%decks(k)%text, command, machine, needs, error)
         if (.not. allocated(error)) cycle
         call print_error(command%decks(k)%text, error)
         exit_code = max(exit_code, error%code)
      end do
      if (command%job_lines .and. exit_code == exit_ok) call print_job_lines(command, needs)
   end subroutine estimate_decks

   !> What a run of one deck would take
   subroutine estimate_deck(deck, command, machine, needs, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Options
      type(command_type), intent(in) :: command
      !> The machine
      type(machine_type), intent(in) :: machine
      !> Takes the largest of all decks
      type(needs_type), intent(inout) :: needs
      !> A wrong deck; a mechanism
      type(error_type), allocatable, intent(out) :: error

      type(job_type) :: job
      type(structure_type) :: structure
      type(diagnostics_type) :: diagnostics
      type(forecast_type) :: forecast

      job%options = command%options
      call job%timer%start()
      call read_job(deck, job, diagnostics)
      if (diagnostics%n_errors > 0) then
         error = error_type(exit_deck, render(diagnostics, job%source))
         return
      end if
      call plan_run(job%model, job%timer, structure, error)
      if (allocated(error)) return
      forecast = forecast_run(job%model, job%source, structure, job%timer, machine, &
                              command%iterations)
      call add_needs(deck, forecast, machine, needs)
      if (command%counts) then
         call print_counts(forecast, machine)
      else if (.not. command%job_lines) then
         call print_forecast(deck, job%model, structure, forecast, machine, command%iterations)
      end if
   end subroutine estimate_deck

end module axijoint_command_estimate
