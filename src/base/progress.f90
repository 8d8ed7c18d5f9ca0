!> What a run is doing: one line on a terminal, or lines in a log
module axijoint_base_progress
   use, intrinsic :: iso_fortran_env, only : error_unit
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : note_stage
   implicit none
   private
   public :: progress_type, show_progress, clear_progress, tell_below

   !> Widest line; shorter ones are padded so that nothing of an older one stays
   integer, parameter :: width = 78

   !> Where progress is shown
   type :: progress_type
      !> Whether it is shown in one line that is written over again and again: only on a terminal,
      !> as this takes control characters
      logical :: enabled = .false.
      !> Whether it is told in lines of text
      logical :: logged = .false.
      !> Unit of both
      integer :: unit = error_unit
      !> Lines about one stage are at least so far apart [second]
      real(wp) :: apart = 60.0_wp
      !> Whether a line stands on the terminal
      logical, private :: shown = .false.
      !> Stage of the last line in the log; clock when the first and the last were written
      character(len=width), private :: stage = ''
      integer(i8), private :: start = 0, last = 0
   end type progress_type

   !> Whether a line of progress stands on the terminal, whoever shows it
   logical, save :: line_stands = .false.

contains

   !> Show a text in place of the last one, or below it in a log
   subroutine show_progress(progress, text)
      !> Where
      type(progress_type), intent(inout) :: progress
      !> What, its first word being the stage
      character(len=*), intent(in) :: text

      character(len=width) :: line

      call note_stage(text)
      if (progress%logged) call add_line(progress, text)
      if (.not. progress%enabled) return
      line = text
      write (progress%unit, '(2a)', advance='no') achar(13), line
      flush (progress%unit)
      progress%shown = .true.
      line_stands = .true.
   end subroutine show_progress

   !> Add a line to a log, if it is of another stage than the last, or the last is old
   subroutine add_line(progress, text)
      !> Where
      type(progress_type), intent(inout) :: progress
      !> What
      character(len=*), intent(in) :: text

      integer(i8) :: now, rate, seconds

      call system_clock(now, rate)
      if (progress%stage == '') progress%start = now
      if (text(:index(text//' ', ' ') - 1) == progress%stage .and. &
          real(now - progress%last, wp) < progress%apart*real(rate, wp)) return
      progress%stage = text(:index(text//' ', ' ') - 1)
      progress%last = now
      seconds = (now - progress%start)/rate
      write (progress%unit, '(a, i0, 2(":", i2.2), 2a)') 'axijoint: ', seconds/3600, &
         mod(seconds/60, 60_i8), mod(seconds, 60_i8), ' ', text
      flush (progress%unit)
   end subroutine add_line

   !> Wipe the line
   subroutine clear_progress(progress)
      !> Where
      type(progress_type), intent(inout) :: progress

      if (.not. progress%shown) return
      write (progress%unit, '(3a)', advance='no') achar(13), repeat(' ', width), achar(13)
      flush (progress%unit)
      progress%shown = .false.
      line_stands = .false.
   end subroutine clear_progress

   !> Tell a line that stays, for those that do not know where progress is shown: what is shown there
   !> is wiped first
   subroutine tell_below(text)
      !> The line
      character(len=*), intent(in) :: text

      if (line_stands) write (error_unit, '(3a)', advance='no') achar(13), repeat(' ', width), achar(13)
      line_stands = .false.
      write (error_unit, '(a)') text
      flush (error_unit)
   end subroutine tell_below

end module axijoint_base_progress
