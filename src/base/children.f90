!> Processes that this one starts: the same program again, with other words
module axijoint_base_children
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   implicit none
   private
   public :: child_type, start_child, look_at_child, ask_to_end, pause_a_moment

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
      if (child%id <= 0) child%code = 127
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

   !> Leave the processor to others for a twentieth of a second
   subroutine pause_a_moment()
      call c_pause(50_c_int)
   end subroutine pause_a_moment

end module axijoint_base_children
