!> One line of progress on a terminal
module axijoint_base_progress
   use, intrinsic :: iso_fortran_env, only : error_unit
   implicit none
   private
   public :: progress_type, show_progress, clear_progress

   !> Widest line; shorter ones are padded so that nothing of an older one stays
   integer, parameter :: width = 78

   !> Where progress is shown
   type :: progress_type
      !> Whether it is shown: only on a terminal, never in a log
      logical :: enabled = .false.
      !> Whether a line stands on the terminal
      logical, private :: shown = .false.
   end type progress_type

contains

   !> Show a text in place of the last one
   subroutine show_progress(progress, text)
      !> Where
      type(progress_type), intent(inout) :: progress
      !> What
      character(len=*), intent(in) :: text

      character(len=width) :: line

      if (.not. progress%enabled) return
      line = text
      write (error_unit, '(2a)', advance='no') achar(13), line
      flush (error_unit)
      progress%shown = .true.
   end subroutine show_progress

   !> Wipe the line
   subroutine clear_progress(progress)
      !> Where
      type(progress_type), intent(inout) :: progress

      if (.not. progress%shown) return
      write (error_unit, '(3a)', advance='no') achar(13), repeat(' ', width), achar(13)
      flush (error_unit)
      progress%shown = .false.
   end subroutine clear_progress

end module axijoint_base_progress
