!> What is said and removed when the program cannot go on, from wherever it is; and what of its words was lost
!>
!> A request for memory that fails inside a library, or for a temporary array of the compiler, comes back to nobody who
!> could make an `error_type` of it. The program hears of it (app/failing_calls.c) and ends in order, with what is noted
!> here: what it was doing, and which files it must not leave.
module axijoint_base_last_words
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
   implicit none
   private
   public :: note_stage, note_reading, note_lock, forget_lock, let_fail, heed_faults, lost_output

   interface
      !> Note what is done; last_words_shim.c
      subroutine c_note_stage(text) bind(c, name='axijoint_note_stage')
         import :: c_char
         character(kind=c_char), intent(in) :: text(*)
      end subroutine c_note_stage

      !> Note what a library reads; last_words_shim.c
      subroutine c_note_reading(path) bind(c, name='axijoint_note_reading')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_note_reading

      !> Note a lock; last_words_shim.c
      subroutine c_note_lock(path, host, process) bind(c, name='axijoint_note_lock')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*), host(*)
         integer(c_int), value :: process
      end subroutine c_note_lock

      !> The lock is given back; last_words_shim.c
      subroutine c_forget_lock(path) bind(c, name='axijoint_forget_lock')
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_forget_lock

      !> Let requests for memory fail; last_words_shim.c
      subroutine c_let_fail(change) bind(c, name='axijoint_let_fail')
         import :: c_int
         integer(c_int), value :: change
      end subroutine c_let_fail

      !> Signals of faults end in words; last_words_shim.c
      subroutine c_heed_faults() bind(c, name='axijoint_heed_faults')
      end subroutine c_heed_faults

      !> Error of the screen output; last_words_shim.c
      function c_lost_output() bind(c, name='axijoint_lost_output')
         import :: c_int
         integer(c_int) :: c_lost_output
      end function c_lost_output
   end interface

contains

   !> Note what the program does from now on
   subroutine note_stage(text)
      !> What, as in "while reading the deck"
      character(len=*), intent(in) :: text

      call c_note_stage(trim(text)//c_null_char)
   end subroutine note_stage

   !> Note which file a library reads from now on that trusts what it finds there: a fault on the way is the file's
   subroutine note_reading(path)
      !> The file; empty when the library is left
      character(len=*), intent(in) :: path

      call c_note_reading(path//c_null_char)
   end subroutine note_reading

   !> Note that a lock is going to be taken, by a process that the lock then names
   subroutine note_lock(path, host, process)
      !> The lock, NAME.lock, or a file that becomes one
      character(len=*), intent(in) :: path
      !> This host, and the number of this process
      character(len=*), intent(in) :: host
      integer, intent(in) :: process

      call c_note_lock(path//c_null_char, host//c_null_char, int(process, c_int))
   end subroutine note_lock

   !> Note that a lock was given back, or not got
   subroutine forget_lock(path)
      !> The lock
      character(len=*), intent(in) :: path

      call c_forget_lock(path//c_null_char)
   end subroutine forget_lock

   !> Whether requests of this thread for memory may fail from here on: where `stat=` is looked at, and the way out
   !> is in order. Every time `.true.` is followed by `.false.`
   subroutine let_fail(may)
      !> Whether they may
      logical, intent(in) :: may

      call c_let_fail(merge(1_c_int, -1_c_int, may))
   end subroutine let_fail

   !> From now on signals that only faults of the program raise end it in words
   subroutine heed_faults()
      call c_heed_faults()
   end subroutine heed_faults

   !> The system's error of what could not be written to the screen so far; zero if all is there
   integer function lost_output()
      flush (output_unit)
      flush (error_unit)
      lost_output = int(c_lost_output())
   end function lost_output

end module axijoint_base_last_words
