!> A study before anything is solved: its deck and its table, read and judged
module axijoint_study_open
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_deck_reader, only : open_deck, make_model
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render, add_error
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_job_job, only : job_name, options_type, take_options
   use axijoint_model_model, only : model_type
   use axijoint_study_rows, only : rows_type, new_rows
   use axijoint_study_table, only : study_table_type, read_study_table
   implicit none
   private
   public :: open_study, deck_beside

contains

   !> The deck of a table for which none is given: of the same name, beside it
   pure function deck_beside(path) result(deck)
      !> The table
      character(len=*), intent(in) :: path
      !> The deck
      character(len=:), allocatable :: deck

      deck = path(:index(path, '/', back=.true.))//job_name(path)//'.dat'
   end function deck_beside

   !> Read deck and table
   subroutine open_study(path, deck, options, estimated, table, rows, model, error)
      !> The table, and the deck
      character(len=*), intent(in) :: path, deck
      !> What is asked for beside the deck
      type(options_type), intent(in) :: options
      !> Whether errors are estimated
      logical, intent(in) :: estimated
      !> What varies
      type(study_table_type), intent(out) :: table
      !> What its rows share
      type(rows_type), intent(out) :: rows
      !> The job of the deck as it stands
      type(model_type), intent(out), target :: model
      !> Errors of the deck or the table
      type(error_type), allocatable, intent(out) :: error

      type(source_type), target :: source
      type(sections_type) :: entries
      type(diagnostics_type), target :: diagnostics, faults

      call open_deck(deck, source, entries, diagnostics)
      if (source%n_cards > 0 .and. entries%complete) &
         call make_model(source, entries, model, diagnostics, rows%mesh)
      if (diagnostics%n_errors == 0) then
         if (size(model%combinations) > 1) call add_error(diagnostics, 0, 0, 0, &
            'the deck of a study has one combination of load cases', &
            mend='let the table vary factors: COMBINE 1 FACTOR 1')
         if (model%error_goal%wanted) call add_error(diagnostics, 0, 0, 0, &
            'the deck of a study has no section ERROR', &
            mend='refine the deck first, with axijoint run; --estimates gives estimates of rows')
      end if
      if (diagnostics%n_errors > 0) then
         call fatal_error(error, exit_deck, render(diagnostics, source))
         return
      end if
      call read_study_table(path, source, entries, table, faults)
      if (faults%n_errors > 0) then
         call fatal_error(error, exit_deck, render(faults, table%source))
         return
      end if
      call take_options(options, model)
      call new_rows(source, entries, options, table, estimated, rows)
   end subroutine open_study

end module axijoint_study_open
