!> The program: words of the command line to a command and an exit code
module axijoint_command_program
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_deck, exit_io
   use axijoint_base_last_words, only : heed_faults, lost_output
   use axijoint_base_memory, only : no_limit
   use axijoint_base_system, only : return_freed_memory, keep_freed_memory, error_text
   use axijoint_base_team, only : team_type
   use axijoint_command_check, only : check_decks
   use axijoint_command_compare, only : compare_files
   use axijoint_command_envelope, only : run_envelope
   use axijoint_command_convert, only : convert_old
   use axijoint_command_estimate, only : estimate_decks
   use axijoint_command_line, only : command_type, read_command
   use axijoint_command_study, only : run_study
   use axijoint_command_run, only : run_decks, print_error
   use axijoint_solver_entry, only : solver_entry_type
   implicit none
   private
   public :: run_program

   !> Freed memory that is kept by a run that is given no limit, and by the rows of a study [MiB]
   integer, parameter :: kept_by_run = 16, kept_by_rows = 1024

contains

   !> Do what the command line says, and see that what it says is read
   subroutine run_program(solvers, exit_code, team)
      !> Solvers that there are
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Exit code of the process
      integer, intent(out) :: exit_code
      !> Processes that share the work; this one alone if absent
      class(team_type), intent(in), optional :: team

      type(error_type), allocatable :: error

      call heed_faults()
      call return_freed_memory()
      call run_command(solvers, exit_code, team)
      if (lost_output() == 0) return
      call fatal_error(error, exit_io, 'the output for the screen could not be written: '// &
         error_text(lost_output())//new_line('a')// &
         'mend: make room where it goes; files of results are not touched by this')
      call print_error('', error)
      exit_code = max(exit_code, error%code)
   end subroutine run_program

   !> Do what the command line says
   subroutine run_command(solvers, exit_code, team)
      !> Solvers that there are
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Exit code of the process
      integer, intent(out) :: exit_code
      !> Processes that share the work; this one alone if absent
      class(team_type), intent(in), optional :: team

      type(command_type) :: command
      type(error_type), allocatable :: error

      exit_code = exit_ok
      call read_command(command, solvers, error)
      if (allocated(error)) then
         call print_error('', error)
         exit_code = error%code
         return
      end if
      if (present(team)) then
         allocate (command%options%team, source=team)
         if (team%size > 1 .and. .not. any(command%name == [character(len=5) :: 'run', 'study', 'print'])) then
            call fatal_error(error, exit_deck, 'only `run` and `study` work in several processes'// &
                             new_line('a')//'mend: one process for `'//command%name//'`')
            call print_error('', error)
            exit_code = error%code
            return
         end if
      end if
      select case (command%name)
      case ('run')
         if (command%options%memory_limit == no_limit) call keep_freed_memory(kept_by_run)
         call run_decks(command, exit_code)
      case ('check')
         call check_decks(command, exit_code)
      case ('estimate')
         call estimate_decks(command, exit_code)
      case ('envelope')
         call keep_freed_memory(kept_by_rows)
         call run_envelope(command, exit_code)
      case ('study')
         call keep_freed_memory(kept_by_rows)
         call run_study(command, exit_code)
      case ('convert')
         call convert_old(command, exit_code)
      case ('compare')
         call compare_files(command%decks, exit_code)
      case default
         write (output_unit, '(a)') command%text
      end select
   end subroutine run_command

end module axijoint_command_program
