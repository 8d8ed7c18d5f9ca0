!> `axijoint estimate`: what decks would cost
module axijoint_command_estimate
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_deck, exit_memory
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_command_estimate_table, only : print_forecast, print_counts, &
      deck_text, study_text
   use axijoint_command_job_lines, only : needs_type, add_needs, print_job_lines
   use axijoint_command_line, only : command_type
   use axijoint_command_run, only : print_error, without_goal
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_estimate_forecast, only : forecast_type, plan_run, forecast_run
   use axijoint_estimate_machine, only : machine_type, this_machine
   use axijoint_estimate_study, only : study_size_type, forecast_study
   use axijoint_estimate_terms, only : reading
   use axijoint_job_job, only : job_type, deck_name
   use axijoint_job_read, only : read_job
   use axijoint_model_model, only : model_type
   use axijoint_study_open, only : open_study, deck_beside
   use axijoint_study_rows, only : rows_type
   use axijoint_study_table, only : study_table_type
   use omp_lib, only : omp_set_num_threads
   implicit none
   private
   public :: estimate_decks

contains

   !> Print what a run of each deck, or a study, would take, or the lines of a job script for the
   !> largest
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
      if (allocated(command%table)) then
         call estimate_study(command, machine, needs, error)
         call judge(command%table)
      else
         do k = 1, size(command%decks)
            call estimate_deck(command%decks(k)%text, command, machine, needs, error)
            call judge(command%decks(k)%text)
         end do
      end if
      if (command%job_lines .and. exit_code == exit_ok) call print_job_lines(command, needs)

   contains

      !> Tell an error
      subroutine judge(path)
         !> The deck or table
         character(len=*), intent(in) :: path

         if (.not. allocated(error)) return
         call print_error(path, error)
         exit_code = max(exit_code, error%code)
      end subroutine judge

   end subroutine estimate_decks

   !> What a study would take
   subroutine estimate_study(command, machine, needs, error)
      !> Table, deck and options
      type(command_type), intent(in) :: command
      !> The machine
      type(machine_type), intent(in) :: machine
      !> Takes what it needs
      type(needs_type), intent(inout) :: needs
      !> A wrong deck or table; a mechanism
      type(error_type), allocatable, intent(out) :: error

      type(study_table_type) :: table
      type(rows_type), target :: rows
      type(model_type), target :: model
      type(forecast_type) :: forecast
      type(study_size_type) :: extent
      character(len=:), allocatable :: deck
      real(wp) :: start, finish

      deck = deck_beside(command%table)
      if (size(command%decks) > 0) deck = command%decks(1)%text
      call cpu_time(start)
      call open_study(command%table, deck, command%options, command%estimates, table, rows, model, &
         error)
      if (allocated(error)) return
      call cpu_time(finish)
      call forecast_study(table, rows, command%part, machine, command%iterations, forecast, &
         extent, error)
      if (allocated(error)) return
      forecast%work(reading) = forecast%work(reading) + finish - start
      call add_needs(command%table, forecast, machine, needs)
      call show(command, study_text(command%table, extent), model, forecast, machine)
   end subroutine estimate_study

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

      type(error_type), allocatable :: no_room
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
      if (job%model%error_goal%wanted .and. .not. command%options%estimated) then
         call fatal_error(error, exit_deck, without_goal)
         return
      end if
      call plan_run(job%model, job%timer, structure, error, command%options%estimated, no_room, &
         listed=.true.)
      if (allocated(error)) return
      forecast = forecast_run(job%model, job%source, structure, job%timer, machine, &
                              command%iterations, command%options%estimated)
      call add_needs(deck, forecast, machine, needs)
      call show(command, deck_text(deck, job%model, structure), job%model, forecast, machine)
      if (allocated(no_room) .and. .not. command%counts) call tell_no_room(deck, command, no_room)
   end subroutine estimate_deck

   !> Say that a run here and now would end for want of memory
   subroutine tell_no_room(deck, command, no_room)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Options
      type(command_type), intent(in) :: command
      !> How it would end
      type(error_type), intent(in) :: no_room

      character(len=:), allocatable :: text

      text = 'a run here and now would end with exit code '//to_text(exit_memory)//':'
      if (command%job_lines) then  ! what is printed becomes a script, for several decks maybe
         write (error_unit, '(a)') deck_name(deck)//': '//text, no_room%message
      else
         write (output_unit, '(a)') '  '//text, no_room%message
      end if
   end subroutine tell_no_room

   !> Print a forecast as it is wanted
   subroutine show(command, heading, model, forecast, machine)
      !> Options
      type(command_type), intent(in) :: command
      !> First line
      character(len=*), intent(in) :: heading
      !> The job
      type(model_type), intent(in) :: model
      !> What it takes
      type(forecast_type), intent(in) :: forecast
      !> The machine
      type(machine_type), intent(in) :: machine

      if (command%counts) then
         call print_counts(forecast, machine)
      else if (.not. command%job_lines) then
         write (output_unit, '(a)') heading
         call print_forecast(model, forecast, machine, command%iterations)
      end if
   end subroutine show

end module axijoint_command_estimate
