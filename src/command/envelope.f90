!> `axijoint envelope`: what loads joints can carry, direction by direction
module axijoint_command_envelope
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_analysis_core_structure, only : structure_type, build_structure
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_deck, exit_singular, &
      exit_not_converged
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : show_progress, clear_progress, tell_below
   use axijoint_base_stop, only : heed_signals, check_stop
   use axijoint_base_system, only : error_output_is_terminal
   use axijoint_base_text, only : to_text, count_of
   use axijoint_base_version, only : program_version
   use axijoint_command_line, only : command_type
   use axijoint_command_run, only : print_error
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_deck_text_token, only : read_integer, token_good
   use axijoint_job_job, only : job_type, job_name
   use axijoint_job_read, only : read_job
   use axijoint_model_load, only : increment_type, combination_type
   use axijoint_model_model, only : model_type, can_yield, bodies_yield
   use axijoint_output_state, only : hash_of_files
   use axijoint_study_directions, only : spread_directions
   use axijoint_study_envelope, only : capacity_type, search_direction
   use axijoint_study_envelope_files, only : write_envelope
   use axijoint_study_journal, only : journal_type, open_journal, append_row, close_journal
   use axijoint_study_rows, only : row_type
   use axijoint_study_undertaking, only : undertaking_type, begin_undertaking, end_undertaking
   use omp_lib, only : omp_set_num_threads
   implicit none
   private
   public :: run_envelope

   !> What the journal keeps of a direction: factor, the least without equilibrium, increments
   integer, parameter :: n_kept = 3

contains

   !> Find an envelope
   subroutine run_envelope(command, exit_code)
      !> Deck and options
      type(command_type), intent(in) :: command
      !> See the manual
      integer, intent(out) :: exit_code

      type(job_type), target :: job
      type(diagnostics_type) :: diagnostics
      type(error_type), allocatable :: error
      integer, allocatable :: cases(:)
      logical, allocatable :: positive(:)
      type(capacity_type), allocatable :: found(:)
      real(wp), allocatable :: directions(:, :)
      type(increment_type) :: control
      character(len=:), allocatable :: notes, name
      type(undertaking_type) :: undertaking

      exit_code = exit_ok
      call heed_signals(with_others=.false.)
      if (command%threads > 0) call omp_set_num_threads(command%threads)
      job%options = command%options
      call read_job(command%decks(1)%text, job, diagnostics)
      if (diagnostics%n_errors > 0) then
         call fatal_error(error, exit_deck, render(diagnostics, job%source))
      else
         call read_cases(command%cases, job%model, cases, positive, error)
      end if
      if (.not. allocated(error) .and. bodies_yield(job%model)) call fatal_error(error, exit_deck, &
         'envelopes are of joints that open or slip: bodies that yield are not searched'// &
         new_line('a')//'mend: a study, whose rows end where there is no equilibrium')
      if (.not. allocated(error) .and. .not. can_yield(job%model)) call fatal_error(error, &
         exit_deck, 'no joint can open or slip: there is equilibrium at any load')
      if (.not. allocated(error)) call prepare(job%model, cases, control, error)
      if (.not. allocated(error)) then
         directions = spread_directions(positive, command%n_directions)
         job%progress%logged = command%verbose
         job%progress%enabled = error_output_is_terminal() .and. &
                                .not. (command%quiet .or. command%verbose)
         call job%timer%start()
         name = job_name(command%decks(1)%text)//'.envelope'
         call begin_undertaking(command%options%directory, name, [name], &
            'envelope '//command%decks(1)%text, job%source, undertaking, notes, error)
         if (len(notes) > 0) call tell_below(notes)
         if (.not. allocated(error)) &
            call search_all(command, job, control, cases, directions, undertaking, found, error)
         call end_undertaking(undertaking, error)
         call clear_progress(job%progress)
      end if
      if (allocated(error)) then
         call print_error(command%decks(1)%text, error)
         exit_code = error%code
         return
      end if
      if (any(found%code == exit_not_converged)) exit_code = exit_not_converged
   end subroutine run_envelope

   !> Load cases that an envelope is found for
   subroutine read_cases(text, model, cases, positive, error)
      !> Numbers divided by commas, those of positive factors alone with a plus
      character(len=*), intent(in) :: text
      !> The job
      type(model_type), intent(in) :: model
      !> The cases (indices), and whether their factors are positive
      integer, allocatable, intent(out) :: cases(:)
      logical, allocatable, intent(out) :: positive(:)
      !> A case that the deck does not have
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: word, known
      integer :: first, last, label, code, k

      allocate (cases(0), positive(0))
      known = ''
      do k = 1, size(model%load_cases)
         if (k > 1) known = known//', '
         known = known//to_text(model%load_cases(k)%label)
      end do
      first = 1
      do while (first <= len(text) + 1)
         last = index(text(first:)//',', ',') + first - 2
         word = trim(adjustl(text(first:last)))
         first = last + 2
         positive = [positive, index(word, '+') > 0]
         if (index(word, '+') > 0) word = word(:index(word, '+') - 1)
         label = 0
         code = token_good + 1
         if (len(word) > 0) call read_integer(word, label, code)
         k = findloc(model%load_cases%label, label, 1)
         if (code /= token_good .or. k == 0 .or. any(cases == k)) then
            call fatal_error(error, exit_deck, "option --cases: found '"//text// &
               "', allowed are load cases of the deck, each once: "//known)
            return
         end if
         cases = [cases, k]
      end do
   end subroutine read_cases

   !> Leave of the increments those that come first, of other load cases
   subroutine prepare(model, cases, control, error)
      !> The job; has one combination then, in which the cases that come first have the factors that the deck combines
      !> them with
      type(model_type), intent(inout) :: model
      !> Load cases of the envelope
      integer, intent(in) :: cases(:)
      !> Tolerance and iterations for the load that grows: those of the last increment
      type(increment_type), intent(out) :: control
      !> The deck does not say with which factor a case comes first
      type(error_type), allocatable, intent(out) :: error

      type(combination_type) :: combined
      type(increment_type), allocatable :: first(:)
      integer :: k, n

      n = size(model%increments)
      control%tolerance = model%increments(n)%tolerance
      control%max_iterations = model%increments(n)%max_iterations
      n = 0
      allocate (first(count([(comes_first(k), k=1, size(model%increments))])))
      do k = 1, size(model%increments)
         if (.not. comes_first(k)) cycle
         n = n + 1
         first(n) = model%increments(k)
      end do
      allocate (combined%factor(size(model%load_cases)), source=0.0_wp)
      do k = 1, size(combined%factor)
         if (.not. any(first%case == k)) cycle
         call find_factor(model, k, combined%factor(k), error)
         if (allocated(error)) return
      end do
      call move_alloc(first, model%increments)
      model%combinations = [combined]

   contains

      !> Whether an increment is of another load case
      logical function comes_first(k)
         !> Its place
         integer, intent(in) :: k

         comes_first = model%increments(k)%case > 0 .and. &
            .not. any(cases == model%increments(k)%case)
      end function comes_first

   end subroutine prepare

   !> Factor that combinations give to a load case: as `run` applies it, beside any of the others
   subroutine find_factor(model, case, factor, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The load case (index)
      integer, intent(in) :: case
      !> The factor
      real(wp), intent(out) :: factor
      !> There is none, or combinations give several
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: what
      integer :: k

      factor = 0.0_wp
      what = 'load case '//to_text(model%load_cases(case)%label)//' comes first, and '
      do k = 1, size(model%combinations)
         associate (other => model%combinations(k)%factor(case))
            if (.not. abs(other) > 0.0_wp) cycle
            if (abs(factor) > 0.0_wp .and. abs(other - factor) > 0.0_wp) call fatal_error(error, exit_deck, what// &
               'combinations give it the factors '//to_text(factor)//' and '//to_text(other)//new_line('a')// &
               'mend: leave one combination of COMBINE')
            if (allocated(error)) return
            factor = other
         end associate
      end do
      if (.not. abs(factor) > 0.0_wp) call fatal_error(error, exit_deck, what//'no combination has it'//new_line('a')// &
         'mend: give it a factor on COMBINE, or take its increment out')
   end subroutine find_factor

   !> Search all directions
   subroutine search_all(command, job, control, cases, directions, undertaking, found, error)
      !> Options
      type(command_type), intent(in) :: command
      !> The job
      type(job_type), intent(inout), target :: job
      !> Tolerance and iterations for the load that grows
      type(increment_type), intent(in) :: control
      !> Load cases (indices)
      integer, intent(in) :: cases(:)
      !> Unit vectors, shape (cases, directions)
      real(wp), intent(in), contiguous :: directions(:, :)
      !> What holds the name of the files
      type(undertaking_type), intent(in) :: undertaking
      !> What is found
      type(capacity_type), allocatable, intent(out) :: found(:)
      !> Singular stiffness, out of memory, a file that cannot be written
      type(error_type), allocatable, intent(out) :: error

      type(journal_type) :: journal
      type(row_type), allocatable :: rows(:)
      character(len=:), allocatable :: put_aside
      integer :: labels(size(cases))
      real(wp) :: direction(size(job%model%load_cases)), first
      integer :: k, n_before

      allocate (rows(size(directions, 2)))
      call open_journal(undertaking%stem//'.rows', program_version//hash_of_files(job%source)// &
         command%cases//' '//to_text(command%n_directions)//' '//to_text(command%tolerance), &
         n_kept, journal, rows, put_aside, error)
      if (allocated(error)) return
      if (len(put_aside) > 0) call tell_below('axijoint: the directions of another '// &
         'envelope of this name, deck or options changed, are '//put_aside//' now')
      n_before = count(rows%number > 0)
      if (n_before > 0 .and. .not. command%quiet) call tell_below('axijoint: '// &
         count_of(n_before, 'direction')//' of '//to_text(size(rows))//' were found before')
      allocate (job%structure)
      call build_structure(job%model, job%structure, job%timer, job%progress, error, estimated=.false.)
      if (allocated(error)) return
      allocate (found(size(rows)))
      do k = 1, size(rows)
         if (rows(k)%number == 0) then
            call check_stop(error)
            if (allocated(error)) return
            call show_progress(job%progress, 'direction '//to_text(k)//' of '// &
               to_text(size(rows)))
            direction = 0.0_wp
            direction(cases) = directions(:, k)
            ! begins far below, so that a direction does not depend on others
            first = 2.0_wp**(-10)
            call search_direction(job%model, job%structure, control, direction, first, &
               command%tolerance, job%timer, job%progress, found(k), error)
            if (allocated(error)) then
               if (all(rows%number == 0)) call close_journal(journal)  ! it holds nothing
               return
            end if
            rows(k)%number = k
            rows(k)%code = found(k)%code
            rows(k)%seconds = found(k)%seconds
            rows(k)%message = found(k)%message
            rows(k)%values = reshape([found(k)%factor, found(k)%without, &
                                      real(found(k)%n_increments, wp)], [n_kept, 1])
            call append_row(journal, rows(k), error)
            if (allocated(error)) return
         else
            found(k)%code = rows(k)%code
            found(k)%seconds = rows(k)%seconds
            found(k)%message = rows(k)%message
            found(k)%factor = rows(k)%values(1, 1)
            found(k)%without = rows(k)%values(2, 1)
            found(k)%n_increments = nint(rows(k)%values(3, 1))
         end if
      end do
      labels = job%model%load_cases(cases)%label
      call write_envelope(undertaking, labels, directions, found, error)
      if (allocated(error)) return
      call close_journal(journal)
      call clear_progress(job%progress)
      if (command%quiet) return
      write (output_unit, '(a)') 'envelope              '//count_of(size(found), 'direction')// &
         ', '//to_text(sum(found%n_increments))//' increments', &
         'status                '//to_text(count(found%code == exit_singular))//' mechanisms, '// &
         to_text(count(found%code == exit_ok))//' without end, '// &
         to_text(count(found%code == exit_not_converged))//' without equilibrium found', &
         'time                  '//to_text(sum(found%seconds))//' s', &
         'files                 '//undertaking%stem//'.csv .h5'
   end subroutine search_all

end module axijoint_command_envelope
