!> HARMONICS: which harmonics are used
module axijoint_deck_load_harmonics
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error
   implicit none
   private
   public :: read_harmonics

   !> Fields of HARMONICS
   integer, parameter :: field_first = 1, field_last = 2, field_step = 3

contains

   !> The harmonics in use: those of the cards, or all from 0 to M if there are none. If a
   !> card is at fault they are all, too: no load is to blame for it
   subroutine read_harmonics(source, table, highest, harmonics, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> HARMONICS
      type(table_type), intent(in) :: table
      !> Highest harmonic of the job; negative if it is not known
      integer, intent(in) :: highest
      !> The harmonics, ascending
      integer, allocatable, intent(out) :: harmonics(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      logical, allocatable :: used(:)
      integer :: entry, first, last, step, m, errors_before

      errors_before = diagnostics%n_errors
      allocate (used(0:max(0, highest)), source=table%n == 0)
      do entry = 1, table%n
         if (.not. table%good(entry) .or. highest < 0) cycle
         call read_range(source, table, entry, highest, first, last, step, diagnostics)
         used(first:last:step) = .true.
      end do
      if (diagnostics%n_errors > errors_before .or. .not. all(table%good(:table%n))) used = .true.
      harmonics = pack([(m, m=0, max(0, highest))], used)
   end subroutine read_harmonics

   !> Read and check one card
   subroutine read_range(source, table, entry, highest, first, last, step, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> HARMONICS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Highest harmonic of the job
      integer, intent(in) :: highest
      !> First, last and step; none at all if something is wrong
      integer, intent(out) :: first, last, step
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: errors_before, field

      errors_before = diagnostics%n_errors
      first = integer_value(table, field_first, entry)
      last = first
      if (table%given(field_last, entry)) last = integer_value(table, field_last, entry)
      step = integer_value(table, field_step, entry)
      do field = field_first, field_last
         if (integer_value(table, field, entry) <= highest) cycle
         call field_error(diagnostics, source, table, entry, field, &
                          'harmonic '//to_text(integer_value(table, field, entry))// &
                          ' is above the highest, M = '//to_text(highest), &
                          allowed='0 to '//to_text(highest), mend='raise M on the CONTROL card')
      end do
      if (last < first) then
         call field_error(diagnostics, source, table, entry, field_last, &
                          'the last harmonic is below the first', allowed=to_text(first)//' or more')
      else if (mod(last - first, step) /= 0) then
         call field_error(diagnostics, source, table, entry, &
                          merge(field_step, field_last, table%given(field_step, entry)), &
                          'the step does not lead from harmonic '//to_text(first)//' to harmonic '// &
                          to_text(last), allowed='a divisor of '//to_text(last - first))
      end if
      if (diagnostics%n_errors == errors_before) return
      first = 1
      last = 0
      step = 1
   end subroutine read_range

end module axijoint_deck_load_harmonics
