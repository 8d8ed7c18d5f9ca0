!> A wish that the program ends before its time, at the next place from which it can be gone on:
!> SIGTERM, SIGINT, SIGUSR1, SIGUSR2, SIGHUP or SIGXCPU, or a file that somebody makes. It stays once it is there, so that
!> whoever leaves a loop for it can count on those above to see it, too. Processes that work together
!> would leave their loops at different places: a wish that one of them knows of counts when it is
!> shared.
module axijoint_base_stop
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use axijoint_base_error, only : error_type, fatal_error, exit_stopped
   implicit none
   private
   public :: heed_signals, heed_file, stop_wished, check_stop, own_wish, agree_wish

   interface
      !> Take note of signals; stop_shim.c
      subroutine c_heed_signals(with_others) bind(c, name='axijoint_heed_signals')
         import :: c_int
         integer(c_int), value :: with_others
      end subroutine c_heed_signals

      !> Take note of a file; stop_shim.c
      subroutine c_heed_file(path) bind(c, name='axijoint_heed_file')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_heed_file

      !> What was noted; stop_shim.c
      function c_own_wish() bind(c, name='axijoint_own_wish')
         import :: c_int
         integer(c_int) :: c_own_wish
      end function c_own_wish

      !> What counts; stop_shim.c
      function c_stop_wish() bind(c, name='axijoint_stop_wish')
         import :: c_int
         integer(c_int) :: c_stop_wish
      end function c_stop_wish

      !> Let a wish count; stop_shim.c
      subroutine c_agree_wish(number) bind(c, name='axijoint_agree_wish')
         import :: c_int
         integer(c_int), value :: number
      end subroutine c_agree_wish
   end interface

contains

   !> From now on these signals are wishes; a second SIGINT ends the program at once
   subroutine heed_signals(with_others)
      !> Whether several processes work together: what counts is what they agree on
      logical, intent(in) :: with_others

      call c_heed_signals(merge(1_c_int, 0_c_int, with_others))
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

   !> The wish that this process knows of, as a number; 0 for none
   integer function own_wish()
      own_wish = int(c_own_wish())
   end function own_wish

   !> Let a wish of one process count in this one
   subroutine agree_wish(wish)
      !> Number of the wish; 0 for none
      integer, intent(in) :: wish

      call c_agree_wish(int(wish, c_int))
   end subroutine agree_wish

   !> Where the wish came from, such as SIGTERM
   function stop_cause() result(cause)
      !> The cause
      character(len=:), allocatable :: cause

      character(len=*), parameter :: names(0:7) = [character(len=11) :: &
         'nobody', 'SIGTERM', 'SIGINT', 'SIGUSR1', 'SIGUSR2', 'SIGHUP', 'SIGXCPU', &
         'a STOP file']

      cause = trim(names(c_stop_wish()))
   end function stop_cause

   !> Make the wish an error, which ends what is under way; nothing is wrong
   subroutine check_stop(error)
      !> The error, unless there is no wish or another one already
      type(error_type), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (stop_wished()) call fatal_error(error, exit_stopped, 'stopped by '//stop_cause())
   end subroutine check_stop

end module axijoint_base_stop
