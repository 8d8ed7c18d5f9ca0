!> Semi-analytical finite element analysis of axisymmetric bodies with joints
program axijoint
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_error, only : error_type, exit_ok
   use axijoint_base_system, only : return_freed_memory
   use axijoint_base_version, only : program_name, program_version
   use axijoint_cli, only : command_type, read_command, help_text, command_run, command_check, &
                            command_estimate, command_compare, command_help, command_help_card
   use axijoint_driver_check, only : check_decks
   use axijoint_driver_compare, only : compare_files
   use axijoint_driver_estimate, only : estimate_decks
   use axijoint_driver_run, only : run_decks, print_error
   implicit none

   type(command_type) :: command
   type(error_type), allocatable :: error
   integer :: exit_code

   exit_code = exit_ok
   call return_freed_memory()
   call read_command(command, error)
   if (allocated(error)) then
      call print_error('', error)
      exit_code = error%code
   else
      select case (command%command)
      case (command_run)
         call run_decks(command, exit_code)
      case (command_check)
         call check_decks(command%decks, exit_code)
      case (command_estimate)
         call estimate_decks(command, exit_code)
      case (command_compare)
         call compare_files(command%decks, exit_code)
      case (command_help)
         write (output_unit, '(a)') help_text(command%topic)
      case (command_help_card)
         write (output_unit, '(a)') command%card_help
      case default
         write (output_unit, '(a)') program_name//' '//program_version
      end select
   end if
   stop exit_code, quiet=.true.
end program axijoint
