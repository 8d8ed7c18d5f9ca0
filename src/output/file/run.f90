!> What a run is called, the same in all its files
module axijoint_output_file_run
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_error, only : exit_ok, exit_not_converged, exit_singular
   use axijoint_base_system, only : process_id
   implicit none
   private
   public :: run_type, new_run, status_name, status_error, exit_code_of

   !> Status of a run that ended with an error
   character(len=*), parameter :: status_error = "error"

   !> Name tags of a run
   type :: run_type
      !> Path of the deck as the user gave it
      character(len=:), allocatable :: deck
      !> Date and time of the output, such as 2026-11-21 02:20:11 +0000
      character(len=:), allocatable :: date
      !> Date, time and process: files with the same stamp are of one run
      character(len=:), allocatable :: stamp
      !> Exit code of the program
      integer :: exit_code = 0
   end type run_type

contains

   !> Tags of the run that writes its files now
   function new_run(deck, exit_code) result(run)
      !> Path of the deck
      character(len=*), intent(in) :: deck
      !> Exit code of the program
      integer, intent(in) :: exit_code
      !> The tags
      type(run_type) :: run

      character(len=8) :: day
      character(len=10) :: clock
      character(len=5) :: zone
      character(len=12) :: process

      call date_and_time(day, clock, zone)
      write (process, '(i0)') process_id()
      run%deck = deck
      run%date = day(:4)//"-"//day(5:6)//"-"//day(7:)//" "// &
         clock(:2)//":"//clock(3:4)//":"//clock(5:6)//" "//zone
      run%stamp = day//"T"//clock//"-"//trim(process)
      run%exit_code = exit_code
   end function new_run

   !> Exit code of a finished run
   pure integer function exit_code_of(results) result(code)
      !> Results
      type(results_type), intent(in) :: results

      code = merge(exit_ok, exit_not_converged, results%converged)
      if (allocated(results%mechanism)) code = exit_singular
   end function exit_code_of

   !> Status of a finished run
   pure function status_name(results) result(name)
      !> Results
      type(results_type), intent(in) :: results
      !> converged, also for a linear job, or not_converged
      character(len=:), allocatable :: name

      name = "not_converged"
      if (results%converged) name = "converged"
   end function status_name

end module axijoint_output_file_run
