!> SWEEP: the range of theta that the bodies are swept through
module axijoint_deck_request_sweep
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_layout, only : section_sweep
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, entry_error, field_error
   use axijoint_model_request, only : sweep_type
   implicit none
   private
   public :: read_sweep

   !> Fields of SWEEP: first and last angle, number of sectors
   integer, parameter :: field_from = 1, field_to = 2, field_sectors = 3
   !> Widest sector [degree]: wider ones are flat or nearly so
   real(wp), parameter :: widest = 120.0_wp

contains

   !> Read SWEEP. The keyword alone asks for the whole circle
   subroutine read_sweep(source, table, sweep, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SWEEP
      type(table_type), intent(in) :: table
      !> The range
      type(sweep_type), intent(out) :: sweep
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: width
      integer :: least

      sweep%wanted = any(source%cards(:source%n_cards)%keyword == section_sweep)
      if (table%n == 0) return
      if (table%n > 1) then
         call entry_error(diagnostics, table, 2, 'a second card of SWEEP', allowed='one card')
      end if
      if (.not. table%good(1)) return
      associate (from => table%values(field_from, 1), to => table%values(field_to, 1))
         width = to - from
         sweep%from = degree*from
         sweep%to = degree*to
      end associate
      sweep%n_sectors = integer_value(table, field_sectors, 1)
      if (width <= 0.0_wp .or. width > 360.0_wp) then
         call entry_error(diagnostics, table, 1, 'the last angle is not above the first by 360 degrees at most', &
                          found=to_text(width)//' degrees from the first to the last', &
                          allowed='above 0, up to 360')
         return
      end if
      least = ceiling(width/widest)
      if (.not. table%given(field_sectors, 1) .or. sweep%n_sectors >= least) return
      call field_error(diagnostics, source, table, 1, field_sectors, 'there are too few sectors', &
                       allowed='at least '//to_text(least)//' for '//to_text(width)//' degrees', &
                       mend='leave the field blank: then the highest harmonic tells')
   end subroutine read_sweep

end module axijoint_deck_request_sweep
