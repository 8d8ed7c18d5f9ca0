!> A wish that the program ends before its time, at the next place from which it can be gone on:
!> SIGTERM, SIGINT or SIGUSR1, or a file that somebody makes. It stays once it is there, so that
!> whoever leaves a loop for it can count on those above to see it, too.
module axijoint_base_stop
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use axijoint_base_error, only : error_type, fatal_error, exit_stopped
   implicit none
   private
   public :: heed_signals, heed_file, stop_wished, stop_cause, check_stop

   interface
      !> Take note of signals; stop_shim.c
      subroutine c_heed_signals() bind(c, name='axijoint_heed_signals')
      end subroutine c_heed_signals

      !> Take note of a file; stop_shim.c
      subroutine c_heed_file(path) bind(c, name='axijoint_heed_file')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_heed_file

      !> What was noted; stop_shim.c
      function c_stop_wish() bind(c, name='axijoint_stop_wish')
         import :: c_int
         integer(c_int) :: c_stop_wish
      end function c_stop_wish

      !> Which signal that is; stop_shim.c
      function c_signal_name(number) bind(c, name='axijoint_signal_name')
         import :: c_int
         integer(c_int), value :: number
         integer(c_int) :: c_signal_name
      end function c_signal_name
   end interface

contains

   !> From now on SIGTERM, SIGINT and SIGUSR1 are wishes; a second SIGINT ends the program at once,
   !> and SIGPIPE, of an output that nobody reads any more, does not
   subroutine heed_signals()
      call c_heed_signals()
   end subroutine heed_signals

   !> From now on a file of some name is a wish, too
   subroutine heed_file(path)
      !> The file; empty for none
      character(len=*), intent(in) :: path

      call c_heed_file(path//c_null_char)
   end subroutine heed_file

   !> Whether the program shall end
   logical function stop_wished()
      stop_wished = c_stop_wish() /= 0_c_int
   end function stop_wished

   !> Where the wish came from, such as SIGTERM
   function stop_cause() result(cause)
      !> The cause
      character(len=:), allocatable :: cause

      character(len=16), parameter :: names(0:3) = [character(len=16) :: &
         'a signal', 'SIGTERM', 'SIGINT', 'SIGUSR1']
      integer(c_int) :: wish

      wish = c_stop_wish()
      cause = 'a STOP file'
      if (wish > 0) cause = trim(names(c_signal_name(wish)))
   end function stop_cause

   !> Make the wish an error, which ends what is under way; nothing is wrong
   subroutine check_stop(error)
      !> The error, unless there is no wish or another one already
      type(error_type), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (stop_wished()) call fatal_error(error, exit_stopped, 'stopped by '//stop_cause())
   end subroutine check_stop

end module axijoint_base_stop
