!> Processes that this one starts: the same program again, with other words
module axijoint_base_children
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use axijoint_base_error, only : exit_stopped
   use axijoint_base_text, only : to_text
   implicit none
   private
   public :: child_type, add_word, start_child, look_at_child, ask_to_end, how_it_ended, pause_a_moment, no_program

   !> Exit code of a process that could not be started; those from here on are of signals, less their number
   integer, parameter :: no_program = 127, of_signal = 128

   !> A process
   type :: child_type
      !> Its number; not positive if it could not be started
      integer :: id = 0
      !> Its exit code, 128 and the number of a signal that ended it; negative while it runs
      integer :: code = -1
   end type child_type

   interface
      !> Start this program again; children_shim.c
      function c_start_child(words, n) bind(c, name='axijoint_start_child')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: words(*)
         integer(c_int), value :: n
         integer(c_int) :: c_start_child
      end function c_start_child

      !> How a child ended; children_shim.c
      function c_child_ended(child) bind(c, name='axijoint_child_ended')
         import :: c_int
         integer(c_int), value :: child
         integer(c_int) :: c_child_ended
      end function c_child_ended

      !> Ask a child to end; children_shim.c
      subroutine c_end_child(child) bind(c, name='axijoint_end_child')
         import :: c_int
         integer(c_int), value :: child
      end subroutine c_end_child

      !> Do nothing; process_shim.c
      subroutine c_pause(milliseconds) bind(c, name='axijoint_pause')
         import :: c_int
         integer(c_int), value :: milliseconds
      end subroutine c_pause
   end interface

contains

   !> Add a word to those of a process
   subroutine add_word(words, word)
      !> The words, each ended by a zero byte
      character(len=:), allocatable, intent(inout) :: words
      !> One more
      character(len=*), intent(in) :: word

      words = words//word//c_null_char
   end subroutine add_word

   !> Start this program once more, as `axijoint WORDS`. It is asked to end when this process ends
   function start_child(words) result(child)
      !> The words, each ended by a zero byte
      character(len=*), intent(in) :: words
      !> The process
      type(child_type) :: child

      integer :: k, n

      n = 0
      do k = 1, len(words)
         if (words(k:k) == c_null_char) n = n + 1
      end do
      child%id = int(c_start_child(words//c_null_char, int(n, c_int)))
      if (child%id <= 0) child%code = no_program
   end function start_child

   !> See whether a child has ended
   subroutine look_at_child(child)
      !> The process
      type(child_type), intent(inout) :: child

      if (child%code < 0) child%code = int(c_child_ended(int(child%id, c_int)))
   end subroutine look_at_child

   !> Ask a child that runs to end at the next safe point
   subroutine ask_to_end(child)
      !> The process
      type(child_type), intent(in) :: child

      if (child%code < 0) call c_end_child(int(child%id, c_int))
   end subroutine ask_to_end

   !> How a process ended, in words
   function how_it_ended(code) result(text)
      !> Exit code, or 128 and the number of a signal
      integer, intent(in) :: code
      !> The words
      character(len=:), allocatable :: text

      if (code == exit_stopped) then
         text = 'was told to end'
      else if (code > of_signal) then
         text = 'was ended by signal '//to_text(code - of_signal)
      else if (code == no_program) then
         text = 'could not be started'
      else
         text = 'ended with exit code '//to_text(code)
      end if
   end function how_it_ended

   !> Leave the processor to others for a while
   subroutine pause_a_moment(milliseconds)
      !> How long; a twentieth of a second if absent
      integer, intent(in), optional :: milliseconds

      if (present(milliseconds)) then
         call c_pause(int(milliseconds, c_int))
      else
         call c_pause(50_c_int)
      end if
   end subroutine pause_a_moment

end module axijoint_base_children
