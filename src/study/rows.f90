!> The rows of a study, solved one after the other: those that share a structure share one
!> condensation
module axijoint_study_rows
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_increment_fields, only : solve_increment
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_same_structure, only : same_structure
   use axijoint_analysis_core_series, only : series_type, new_series, append_increment
   use axijoint_analysis_core_structure, only : structure_type, build_structure, take_loads_of
   use axijoint_analysis_static, only : analyse_combination
   use axijoint_base_error, only : error_type, exit_deck, exit_internal, exit_stopped
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_sort, only : lexical_order
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type
   use axijoint_base_progress, only : progress_type
   use axijoint_deck_job_deck, only : reader_type, stage_properties, stage_loads, &
      stage_requests
   use axijoint_deck_reader, only : make_model, kept_mesh_type
   use axijoint_deck_registry, only : all_readers
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render, warning_texts
   use axijoint_deck_text_field, only : kind_real
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_job_in_situ_messages, only : judge_in_situ
   use axijoint_job_job, only : options_type, take_options
   use axijoint_job_yield_messages, only : judge_in_situ_yield
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : keep_type, keep_series
   use axijoint_output_listing_solution, only : convergence_text
   use axijoint_output_file_run, only : exit_code_of
   use axijoint_study_quantities, only : quantity_values
   use axijoint_study_table, only : study_table_type, change_entries
   implicit none
   private
   public :: rows_type, row_type, new_rows, make_row, solve_row, row_order

   !> What rounding may leave of the displacements of a row, over the largest, without a step of
   !> refinement: much less than the tolerance of an increment claims, and what is printed shows
   real(wp), parameter :: negligible = 1.0e-10_wp

   !> What is shared by the rows that are solved
   type :: rows_type
      !> The deck's cards, and what they say
      type(source_type) :: source
      type(sections_type) :: entries
      !> What is asked for beside the deck
      type(options_type) :: options
      !> Columns that leave the mesh alone, and those that leave the structure alone
      logical, allocatable :: keeps_mesh(:), keeps_structure(:)
      !> The deck's mesh, for rows that leave it alone
      type(kept_mesh_type) :: mesh
      !> The job that the structure is built for, and the structure
      type(model_type), allocatable :: built_for
      type(structure_type), allocatable :: structure
      !> Structures that were built
      integer :: n_structures = 0
      !> Whether errors are estimated
      logical :: estimated = .false.
      !> Times of the phases, and where progress is shown
      type(timer_type) :: timer
      type(progress_type) :: progress
   end type rows_type

   !> What came of a row
   type :: row_type
      !> Its number
      integer :: number = 0
      !> Exit code that its job ends with
      integer :: code = exit_internal
      !> Time [second]
      real(wp) :: seconds = 0.0_wp
      !> Quantities, shape (quantities, increments); none if it could not be solved
      real(wp), allocatable :: values(:, :)
      !> What is to be said, a line each: why it ended as it did, warnings of its deck, remarks on its results; empty if
      !> nothing
      character(len=:), allocatable :: message
   end type row_type

contains

   !> Nothing is solved
   subroutine new_rows(source, entries, options, table, estimated, rows)
      !> The deck's cards
      type(source_type), intent(in) :: source
      !> What they say
      type(sections_type), intent(in) :: entries
      !> What is asked for beside the deck
      type(options_type), intent(in) :: options
      !> The table
      type(study_table_type), intent(in) :: table
      !> Whether errors are estimated
      logical, intent(in) :: estimated
      !> What rows share; it may have the mesh of the deck
      type(rows_type), intent(inout) :: rows

      rows%source = source
      rows%entries = entries
      rows%options = options
      rows%estimated = estimated
      call free_columns(table, source, rows%keeps_mesh, rows%keeps_structure)
      call rows%timer%start()
   end subroutine new_rows

   !> Which columns leave the mesh alone: numbers of materials and laws, and what is read when the
   !> mesh is there; and which leave the structure alone, as far as their cards tell: so rows are
   !> put in order. What a row shares is found by looking at it
   subroutine free_columns(table, source, keeps_mesh, keeps_structure)
      !> The table
      type(study_table_type), intent(in) :: table
      !> The deck
      type(source_type), intent(in) :: source
      !> Shape (columns)
      logical, allocatable, intent(out) :: keeps_mesh(:), keeps_structure(:)

      type(reader_type), pointer :: readers(:)
      integer :: k, stage

      allocate (keeps_mesh(size(table%columns)), keeps_structure(size(table%columns)))
      readers => all_readers()
      do k = 1, size(table%columns)
         associate (column => table%columns(k))
            stage = readers(column%section)%stage
            keeps_mesh(k) = any(stage == [stage_loads, stage_requests]) .or. &
               source%sections(column%section)%name == 'INCREMENTS' .or. &  ! not CONTROL, which has rules of elements
               (stage == stage_properties .and. column%kind%kind == kind_real)
            select case (source%sections(column%section)%name)
            case ('MATERIALS')
               keeps_structure(k) = index(column%kind%name, 'modulus') == 0 .and. &
                  index(column%kind%name, 'ratio') == 0
            case ('LAWS')
               keeps_structure(k) = index(column%kind%name, 'k_') == 0
            case ('ORTHOTROPIC', 'SPRINGS')
               keeps_structure(k) = .false.
            case default
               keeps_structure(k) = .true.
            end select
            keeps_structure(k) = keeps_structure(k) .and. keeps_mesh(k)
         end associate
      end do
   end subroutine free_columns

   !> Order of the rows: those that may share a structure follow each other, else as in the table. What the deck says
   !> is no value of the table: it stands apart from all of them
   pure function row_order(table, keeps_structure) result(order)
      !> The table
      type(study_table_type), intent(in) :: table
      !> Columns that leave the structure alone
      logical, intent(in) :: keeps_structure(:)
      !> Numbers of the rows
      integer, allocatable :: order(:)

      real(wp), allocatable :: keys(:, :)
      integer, allocatable :: columns(:)
      integer :: k

      columns = pack([(k, k=1, size(keeps_structure))], .not. keeps_structure)
      allocate (keys(2*size(columns), size(table%values, 2)))
      keys(1::2, :) = merge(1.0_wp, 0.0_wp, table%given(columns, :))
      keys(2::2, :) = table%values(columns, :)
      order = lexical_order(keys)
   end function row_order

   !> Solve a row
   subroutine solve_row(table, number, rows, row, stopped)
      !> The table
      type(study_table_type), intent(in) :: table
      !> Number of the row
      integer, intent(in) :: number
      !> What rows share
      type(rows_type), intent(inout), target :: rows
      !> What came of it; nothing if the program is to end
      type(row_type), intent(out) :: row
      !> The wish that the program ends
      type(error_type), allocatable, intent(out) :: stopped

      type(model_type), target :: model
      type(error_type), allocatable :: error
      character(len=:), allocatable :: warnings(:)
      integer(i8) :: start, now, rate

      call system_clock(start, rate)
      row%number = number
      row%message = ''
      allocate (row%values(0, 0))
      call make_row(table, number, rows, model, row, warnings)
      if (len(row%message) == 0) then
         call find_structure(model, rows, error)
         if (.not. allocated(error)) call solve_state(model, warnings, rows, row, error)
         if (allocated(error)) then
            if (error%code == exit_stopped) then
               call move_alloc(error, stopped)
               row%number = 0
               return
            end if
            row%code = error%code
            row%message = error%message
         end if
      end if
      call system_clock(now)
      row%seconds = real(now - start, wp)/rate
   end subroutine solve_row

   !> The job of a row
   subroutine make_row(table, number, rows, model, row, warnings)
      !> The table
      type(study_table_type), intent(in) :: table
      !> Number of the row
      integer, intent(in) :: number
      !> What rows share
      type(rows_type), intent(inout), target :: rows
      !> The job
      type(model_type), intent(out), target :: model
      !> Takes the message if the deck is wrong with these values
      type(row_type), intent(inout) :: row
      !> Warnings of the deck with these values, one line each
      character(len=:), allocatable, intent(out), optional :: warnings(:)

      type(sections_type), target :: entries
      type(diagnostics_type), target :: diagnostics

      entries = rows%entries
      call change_entries(table, number, entries)
      if (all(rows%keeps_mesh .or. .not. table%given(:, number))) then
         call make_model(rows%source, entries, model, diagnostics, rows%mesh)
      else
         call make_model(rows%source, entries, model, diagnostics)
      end if
      if (diagnostics%n_errors == 0) then
         if (size(model%initial_stresses) > 0) then
            call judge_in_situ(model, diagnostics)
            call judge_in_situ_yield(model, diagnostics)
         end if
      end if
      if (diagnostics%n_errors > 0) then
         row%code = exit_deck
         row%message = render(diagnostics, rows%source)
         return
      end if
      if (present(warnings)) warnings = warning_texts(diagnostics, rows%source)
      call take_options(rows%options, model)
      model%keep(keep_series) = keep_type()  ! a row follows all increments
   end subroutine make_row

   !> See that there is the structure of a job
   subroutine find_structure(model, rows, error)
      !> The job
      type(model_type), intent(in) :: model
      !> What rows share
      type(rows_type), intent(inout) :: rows
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      if (allocated(rows%structure)) then
         if (same_structure(model, rows%built_for, rows%structure)) then
            call take_loads_of(model, rows%structure)
            return
         end if
         deallocate (rows%structure, rows%built_for)
      end if
      allocate (rows%structure)
      call build_structure(model, rows%structure, rows%timer, rows%progress, error, rows%estimated)
      if (allocated(error)) then
         deallocate (rows%structure)
         return
      end if
      if (.not. rows%estimated) rows%structure%negligible = negligible
      allocate (rows%structure%answer)
      rows%built_for = model
      rows%n_structures = rows%n_structures + 1
   end subroutine find_structure

   !> Solve the job of a row, and take its quantities
   subroutine solve_state(model, warnings, rows, row, error)
      !> The job
      type(model_type), intent(in), target :: model
      !> Warnings of its deck
      character(len=*), intent(in) :: warnings(:)
      !> What rows share
      type(rows_type), intent(inout), target :: rows
      !> Takes what comes of it
      type(row_type), intent(inout) :: row
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(results_type) :: results
      type(fields_type) :: earlier
      type(series_type) :: series
      integer :: i

      call analyse_combination(model, rows%structure, model%combinations(1), results, rows%timer, &
         rows%progress, error, rows%estimated)
      if (allocated(error)) return
      row%code = exit_code_of(results)
      row%message = said_of(results, warnings)
      series = new_series(model, results, size(results%states))
      do i = 1, size(results%states) - 1
         call solve_increment(model, rows%structure, i, results%states, results%plane_angles, earlier, error)
         if (allocated(error)) return
         call append_increment(model, rows%structure, results, i, earlier, series)
      end do
      call append_increment(model, rows%structure, results, size(results%states), results, series)
      row%values = quantity_values(series, results)
   end subroutine solve_state

   !> What a run would say of a state: why it ended as it did, if not well, warnings of the deck, remarks
   function said_of(results, warnings) result(lines)
      !> What was found
      type(results_type), intent(in) :: results
      !> Warnings of the deck
      character(len=*), intent(in) :: warnings(:)
      !> The lines
      character(len=:), allocatable :: lines

      integer :: k

      lines = ''
      if (allocated(results%mechanism)) then
         lines = results%mechanism
      else if (.not. results%converged) then
         lines = convergence_text(results)
      end if
      do k = 1, size(warnings)
         call add_line(trim(warnings(k)))
      end do
      do k = 1, size(results%remarks)
         if (allocated(results%mechanism)) then
            if (results%remarks(k)%text == results%mechanism) cycle
         end if
         call add_line(results%remarks(k)%text)
      end do

   contains

      !> Add a line
      subroutine add_line(text)
         !> The line
         character(len=*), intent(in) :: text

         if (len(lines) > 0) lines = lines//new_line('a')
         lines = lines//text
      end subroutine add_line

   end function said_of

end module axijoint_study_rows
