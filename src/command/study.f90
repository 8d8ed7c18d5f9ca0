!> `axijoint study`: many states of a deck, as a table says
module axijoint_command_study
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_deck, exit_singular, exit_not_converged, &
      exit_memory, exit_stopped
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_memory, only : give_back_memory
   use axijoint_base_progress, only : show_progress, clear_progress, tell_below
   use axijoint_base_stop, only : heed_signals, check_stop
   use axijoint_base_system, only : error_output_is_terminal
   use axijoint_base_team, only : team_type
   use axijoint_base_text, only : to_text, count_of
   use axijoint_base_version, only : program_version
   use axijoint_command_line, only : command_type
   use axijoint_command_run, only : print_error, speaks
   use axijoint_command_study_processes, only : solve_in_processes, &
      worth_processes
   use axijoint_deck_text_field, only : kind_word, kind_code
   use axijoint_job_job, only : job_name
   use axijoint_model_model, only : model_type
   use axijoint_output_state, only : hash_of_files
   use axijoint_study_files, only : write_study
   use axijoint_study_journal, only : journal_type, open_journal, read_journal, append_row, &
      close_journal
   use axijoint_study_open, only : open_study, deck_beside
   use axijoint_study_parts, only : part_type, whole, part_name, journal_path, first_row, last_row, &
      gather_parts, remove_parts
   use axijoint_study_quantities, only : quantity_names, name_length
   use axijoint_study_rows, only : rows_type, row_type, solve_row, row_order
   use axijoint_study_statistics, only : new_statistics
   use axijoint_study_table, only : study_table_type, value_text
   use axijoint_study_undertaking, only : undertaking_type, begin_undertaking, end_undertaking
   use omp_lib, only : omp_set_num_threads
   implicit none
   private
   public :: run_study

   !> Messages of rows that are shown
   integer, parameter :: most_messages = 10

   !> A study
   type :: study_type
      !> The table
      type(study_table_type) :: table
      !> What its rows share
      type(rows_type) :: rows
      !> Names of the quantities
      character(len=name_length), allocatable :: names(:)
      !> Name of its files without ending, and what tells it from others
      character(len=:), allocatable :: name, key
      !> What holds that name
      type(undertaking_type) :: undertaking
   end type study_type

   !> What others have done of a study that is gathered
   type :: others_type
      !> Rows that they solved just now, how many they are, and the clock when they began
      integer :: n_rows = 0, n_processes = 0
      integer(i8) :: start = 0
   end type others_type

contains

   !> Run a study
   subroutine run_study(command, exit_code)
      !> Table, deck and options
      type(command_type), intent(in) :: command
      !> Largest exit code of all rows
      integer, intent(out) :: exit_code

      type(error_type), allocatable :: error

      if (command%threads > 0) call omp_set_num_threads(command%threads)
      if (.not. allocated(command%options%team)) then
         call run_part(command, exit_code, error)
      else if (command%part%n == 0 .or. command%options%team%size == 1) then
         call run_by_groups(command, exit_code, error)
      else
         call fatal_error(error, exit_deck, 'option --part is not for several processes by MPI, which share all rows'// &
            new_line('a')//'mend: one process for a part, or no --part')
      end if
      if (.not. allocated(error)) return
      exit_code = error%code
      ! who started a part has words of his own when all are told to end
      if (error%code == exit_stopped .and. command%quiet .and. command%part%number > 0) return
      call print_error(command%decks(1)%text, error)
   end subroutine run_study

   !> Run a study, or a part of it, by this process and its team
   subroutine run_part(command, exit_code, error, n_solved, others)
      !> Table, deck and options
      type(command_type), intent(in) :: command
      !> Largest exit code of all rows
      integer, intent(out) :: exit_code
      !> Errors of deck, table or files; the program is to end
      type(error_type), allocatable, intent(out) :: error
      !> Rows solved, as far as this process knows
      integer, intent(out), optional :: n_solved
      !> What others have done just before, for the words at the end
      type(others_type), intent(in), optional :: others

      type(study_type), target :: study
      type(row_type), allocatable :: done(:)
      character(len=:), allocatable :: notes
      integer :: n_new

      exit_code = exit_ok
      n_new = 0
      call heed_signals(with_others=allocated(command%options%team))
      call begin_study(command, study, error)
      if (.not. allocated(error)) then
         if (speaks(command)) then
            call begin_undertaking(command%options%directory, study%name, &
               claimed_names(study%name, command%part), 'study '//command%decks(1)%text, &
               study%rows%source, study%undertaking, notes, error, study%table%source)
            if (len(notes) > 0) call tell_below(notes)
         end if
         call agree(command, error)
         if (.not. allocated(error)) call solve_rows(command, study, done, n_new, error, others)
         if (speaks(command)) call end_undertaking(study%undertaking, error)
      end if
      call clear_progress(study%rows%progress)
      if (present(n_solved)) n_solved = n_new
      if (.not. allocated(error)) &
         exit_code = max(exit_ok, maxval(done%code, mask=done%number > 0))
   end subroutine run_part

   !> Run a study by groups of ranks, each a part; the first rank gathers them
   subroutine run_by_groups(command, exit_code, error)
      !> Table, deck and options; `n_processes` groups, or every rank by itself
      type(command_type), intent(in) :: command
      !> Largest exit code of all rows
      integer, intent(out) :: exit_code
      !> Errors of deck, table or files; the program is to end; on the first rank only
      type(error_type), allocatable, intent(out) :: error

      type(command_type) :: own
      class(team_type), allocatable :: group
      type(others_type) :: others
      real(wp), allocatable :: solved(:)
      real(wp) :: code(1)
      integer :: n, n_solved, k

      exit_code = exit_ok
      call system_clock(others%start)
      associate (team => command%options%team)
         n = team%size
         if (command%n_processes > 1) n = min(n, command%n_processes)
         call team%split(team%rank*n/team%size, group)
         own = command
         own%n_processes = 1
         own%quiet = own%quiet .or. n > 1
         if (own%part%n == 0) own%part = part_type(team%rank*n/team%size + 1, n)
         deallocate (own%options%team)
         ! a rank by itself is a team, too, which knows who shares the memory of its machine
         allocate (own%options%team, source=group)
         call run_part(own, exit_code, error, n_solved)
         call team%agree(error)
         allocate (solved(team%size), source=0.0_wp)
         if (group%rank == 0) solved(team%rank + 1) = n_solved
         call team%gather(solved, size(solved, kind=i8), [(k, k=0, team%size)])
         if (.not. allocated(error) .and. team%rank == 0 .and. command%part%n == 0) then
            own = command
            own%n_processes = 1
            own%part = part_type(0, n)
            deallocate (own%options%team)
            others%n_rows = nint(sum(solved))
            others%n_processes = team%size
            call run_part(own, exit_code, error, others=others)
         end if
         call team%agree(error)
         if (allocated(error)) exit_code = error%code
         code = real(exit_code, wp)
         call team%broadcast(code, size(code, kind=i8), 0)
         exit_code = nint(code(1))
         if (team%rank > 0 .and. allocated(error)) deallocate (error)  ! the first rank says why
      end associate
   end subroutine run_by_groups

   !> Agree on an error, if there is a team
   subroutine agree(command, error)
      !> Options
      type(command_type), intent(in) :: command
      !> Error of this rank; then of all
      type(error_type), allocatable, intent(inout) :: error

      if (allocated(command%options%team)) call command%options%team%agree(error)
   end subroutine agree

   !> Names that a study, or a part of it, must have for itself: who gathers parts waits for none
   !> that is under way
   pure function claimed_names(name, part) result(names)
      !> Name of the study
      character(len=*), intent(in) :: name
      !> The part
      type(part_type), intent(in) :: part
      !> The names
      character(len=:), allocatable :: names(:)

      integer :: k, n

      n = 0
      if (part%number == 0) n = part%n
      allocate (character(len=len(name) + 24) :: names(1 + n))
      names(1) = part_name(name, part)
      do k = 1, n
         names(1 + k) = part_name(name, part_type(k, n))
      end do
   end function claimed_names

   !> Read deck and table
   subroutine begin_study(command, study, error)
      !> Table, deck and options
      type(command_type), intent(in) :: command
      !> The study
      type(study_type), intent(out), target :: study
      !> Errors of the deck or the table
      type(error_type), allocatable, intent(out) :: error

      type(model_type), target :: model
      character(len=:), allocatable :: path, deck

      path = command%decks(1)%text
      deck = deck_beside(path)
      if (size(command%decks) > 1) deck = command%decks(2)%text
      call open_study(path, deck, command%options, command%estimates, study%table, study%rows, &
         model, error)
      if (allocated(error)) return
      study%names = quantity_names(model)
      study%name = job_name(path)//'.study'
      study%key = program_version//new_line('a')//hash_of_files(study%rows%source)//new_line('a')// &
         hash_of_files(study%table%source)//merge('estimates', '         ', command%estimates)
      if (command%options%solver_given) study%key = study%key//command%options%solver%name
      study%rows%progress%logged = command%verbose .and. speaks(command)
      study%rows%progress%enabled = error_output_is_terminal() .and. speaks(command) .and. &
                                    .not. (command%quiet .or. command%verbose)
   end subroutine begin_study

   !> Solve the rows that are not done, and write the files
   subroutine solve_rows(command, study, done, n_new, error, others)
      !> Options
      type(command_type), intent(in) :: command
      !> The study
      type(study_type), intent(inout), target :: study
      !> What came of each row
      type(row_type), allocatable, intent(out) :: done(:)
      !> Rows solved that were not done before; of one without memory nobody knows what comes of it elsewhere
      integer, intent(out) :: n_new
      !> A file cannot be written, or the program is to end
      type(error_type), allocatable, intent(out) :: error
      !> What others have done just before
      type(others_type), intent(in), optional :: others

      type(journal_type) :: journal
      logical, allocatable :: before(:)
      integer, allocatable :: order(:)
      integer(i8) :: start, now, rate
      integer :: n_before, n_processes

      n_new = 0
      call system_clock(start, rate)
      if (present(others)) start = others%start
      order = row_order(study%table, study%rows%keeps_structure)
      allocate (done(size(order)))
      if (speaks(command)) call find_done(command, study, order, journal, done, n_before, error)
      call agree(command, error)
      if (allocated(error)) return
      if (allocated(command%options%team)) call share_done(command%options%team, done)
      before = done%number > 0
      call solve_left(command, study, order, journal, done, n_processes, error)
      if (allocated(error)) return
      n_new = count(done%number > 0 .and. done%code /= exit_memory .and. .not. before)
      call system_clock(now)
      if (command%part%number == 0) then
         call write_study(study%undertaking, study%rows%source, study%table, study%names, done, &
            new_statistics(done, size(study%names)), error)
         if (allocated(error)) return
         call close_journal(journal)
         call remove_parts(study%undertaking%directory, study%undertaking%name, study%key, &
            size(study%names), command%part%n)
      end if
      call clear_progress(study%rows%progress)
      if (present(others)) then
         n_before = n_before - others%n_rows
         n_processes = others%n_processes
      end if
      if (.not. command%quiet .and. speaks(command)) &
         call tell_end(command, n_processes, study, done, n_before, real(now - start, wp)/rate)
   end subroutine solve_rows

   !> Solve the rows that are not done: by several processes if that is wished, or if nothing is said
   !> of it and the first rows show that it pays
   subroutine solve_left(command, study, order, journal, done, n_processes, error)
      !> Options
      type(command_type), intent(in) :: command
      !> The study
      type(study_type), intent(inout) :: study
      !> Numbers of the rows in their order
      integer, intent(in) :: order(:)
      !> The journal
      type(journal_type), intent(inout) :: journal
      !> Rows by number; takes those that are done
      type(row_type), intent(inout) :: done(:)
      !> Processes that solved most of the rows
      integer, intent(out) :: n_processes
      !> A file cannot be written, or the program is to end
      type(error_type), allocatable, intent(inout) :: error

      real(wp), allocatable :: seconds(:)
      logical :: undecided, shared
      integer :: i, last, n_shown

      last = last_row(command%part, size(order))
      n_shown = 0
      n_processes = max(1, command%n_processes)
      undecided = command%n_processes == 0 .and. command%part%n == 0 &
         .and. .not. allocated(command%options%team)
      shared = .false.
      allocate (seconds(0))
      do i = first_row(command%part, size(order)), last
         if (done(order(i))%number > 0) cycle
         if (undecided) n_processes = worth_processes(seconds, count(done%number == 0), &
            command%options%memory_limit)
         if (n_processes > 1 .and. .not. shared) then
            shared = .true.
            undecided = .false.
            call share_rows(command, n_processes, study, order, done, n_shown, error)
            if (allocated(error)) return
            if (done(order(i))%number > 0) cycle
         end if
         call show_progress(study%rows%progress, 'row '//to_text(i)//' of '//to_text(last))
         call check_stop(error)
         if (.not. allocated(error)) &
            call solve_row(study%table, order(i), study%rows, done(order(i)), error)
         if (.not. allocated(error) .and. speaks(command)) &
            call append_row(journal, done(order(i)), error)
         call agree(command, error)
         if (allocated(error)) return
         seconds = [seconds, done(order(i))%seconds]
         if (.not. command%quiet .and. speaks(command)) &
            call tell_row(study, done(order(i)), n_shown)
      end do
   end subroutine solve_left

   !> Let processes solve the rows that are not done, and tell what there is to say of them
   subroutine share_rows(command, n_processes, study, order, done, n_shown, error)
      !> Options
      type(command_type), intent(in) :: command
      !> Number of processes
      integer, intent(in) :: n_processes
      !> The study; forgets its structure, so that the processes have its memory
      type(study_type), intent(inout) :: study
      !> Numbers of the rows in their order
      integer, intent(in) :: order(:)
      !> Rows by number; takes those that are done
      type(row_type), intent(inout) :: done(:)
      !> Rows of which something was told
      integer, intent(inout) :: n_shown
      !> The program is to end
      type(error_type), allocatable, intent(out) :: error

      logical :: before(size(done))
      integer :: i

      if (allocated(study%rows%structure)) deallocate (study%rows%structure, study%rows%built_for)
      call give_back_memory()
      before = done%number > 0
      call solve_in_processes(command, n_processes, study%undertaking, study%key, &
         size(study%names), order, done, study%rows%progress, error)
      if (allocated(error) .or. command%quiet) return
      do i = 1, size(order)
         if (done(order(i))%number > 0 .and. .not. before(order(i))) &
            call tell_row(study, done(order(i)), n_shown)
      end do
   end subroutine share_rows

   !> Let all ranks know which rows are done
   subroutine share_done(team, done)
      !> The team
      class(team_type), intent(in) :: team
      !> Rows by number; those that are done are there on the first rank
      type(row_type), intent(inout) :: done(:)

      real(wp) :: known(2, size(done))
      integer :: k

      do k = 1, size(done)
         known(:, k) = [real(done(k)%number, wp), real(done(k)%code, wp)]
      end do
      call team%broadcast(known, size(known, kind=i8), 0)
      done%number = nint(known(1, :))
      done%code = nint(known(2, :))
   end subroutine share_done

   !> Find the rows that are done already, and say so
   subroutine find_done(command, study, order, journal, done, n_before, error)
      !> Options
      type(command_type), intent(in) :: command
      !> The study
      type(study_type), intent(in) :: study
      !> Numbers of the rows in their order
      integer, intent(in) :: order(:)
      !> The journal, open
      type(journal_type), intent(out) :: journal
      !> Rows by number; takes those that are done
      type(row_type), intent(inout) :: done(:)
      !> How many these are
      integer, intent(out) :: n_before
      !> The journal cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: put_aside
      logical :: there, ours, torn
      integer :: n_others

      associate (stem => study%undertaking%stem, part => command%part)
         call open_journal(journal_path(stem, part), study%key, size(study%names), journal, done, &
            put_aside, error)
         if (allocated(error)) return
         if (part%number == 0) then
            call gather_parts(study%undertaking%directory, study%undertaking%name, study%key, &
               size(study%names), done, n_others)
            if (n_others > 0) call tell_below('axijoint: rows of '//count_of(n_others, 'part')//' of another study of this '// &
               'name, deck, table or options changed, are left as they are')
         else
            call read_journal(journal_path(stem, whole), study%key, size(study%names), done, there, &
               ours, torn)
            ! of parts that are as many as now, each has rows of its own
            call gather_parts(study%undertaking%directory, study%undertaking%name, study%key, &
               size(study%names), done, n_others, n_beside=part%n)
            done(order(:first_row(part, size(order)) - 1)) = row_type()
            done(order(last_row(part, size(order)) + 1:)) = row_type()
         end if
         n_before = count(done%number > 0)
         if (len(put_aside) > 0) &
            call tell_below('axijoint: the rows of another study '// &
               'of this name, deck, table or options changed, are '//put_aside//' now')
         ! rows of parts are no surprise to who gathers them
         if (n_before > 0 .and. .not. (command%quiet .or. part%n > 0 .and. part%number == 0)) &
            call tell_below('axijoint: '//count_of(n_before, 'row')//' of '//to_text(size(done))//' were done before')
      end associate
   end subroutine find_done

   !> Tell what there is to say of a row that was not solved, if not too many had something
   subroutine tell_row(study, row, n_shown)
      !> The study
      type(study_type), intent(inout) :: study
      !> The row
      type(row_type), intent(in) :: row
      !> Rows of which something was told
      integer, intent(inout) :: n_shown

      if (len(row%message) == 0 .or. size(row%values) > 0) return
      n_shown = n_shown + 1
      if (n_shown > most_messages) return
      call clear_progress(study%rows%progress)
      call tell_below('axijoint: row '//to_text(row%number)//' ('// &
         varied(study%table, row%number)//'):'//new_line('a')//row%message)
      if (n_shown == most_messages) call tell_below('axijoint: messages of further rows '// &
         'stand in the table of results')
   end subroutine tell_row

   !> What a row varies
   function varied(table, number) result(text)
      !> The table
      type(study_table_type), intent(in) :: table
      !> Number of the row
      integer, intent(in) :: number
      !> In words
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(table%columns)
         if (.not. table%given(k, number)) cycle
         if (len(text) > 0) text = text//', '
         text = text//trim(table%columns(k)%name)//' = '
         if (any(table%columns(k)%kind%kind == [kind_word, kind_code])) then
            text = text//value_text(table, k, number)
         else
            text = text//to_text(table%values(k, number))
         end if
      end do
   end function varied

   !> Tell what was done
   subroutine tell_end(command, n_processes, study, done, n_before, seconds)
      !> Options
      type(command_type), intent(in) :: command
      !> Processes that solved most of the rows
      integer, intent(in) :: n_processes
      !> The study
      type(study_type), intent(in) :: study
      !> The rows
      type(row_type), intent(in) :: done(:)
      !> Rows that were done before
      integer, intent(in) :: n_before
      !> Time of the others
      real(wp), intent(in) :: seconds

      character(len=:), allocatable :: means
      integer :: k, n

      n = count(done%number > 0)
      if (n_processes > 1) then
         means = to_text(n_processes)//' processes'
      else
         means = count_of(study%rows%n_structures, 'structure')
         if (command%part%number == 0 .and. command%part%n > 0) &
            means = means//', '//to_text(n_before)//' done before'
      end if
      write (output_unit, '(a)') 'study                 '//count_of(n, 'row')//', '// &
         to_text(n - n_before)//' solved now with '//means, &
         'status                '//to_text(ended(exit_ok))//' converged, '// &
         to_text(ended(exit_not_converged))//' not converged, '// &
         to_text(ended(exit_singular))//' mechanisms, '//to_text(n - ended(exit_ok) - &
         ended(exit_not_converged) - ended(exit_singular))//' with errors', &
         'time                  '//to_text(seconds)//' s'
      if (n > n_before) write (output_unit, '(a)') 'time of a row         '// &
         to_text(seconds/(n - n_before))//' s'
      n = count([(said(k), k=1, size(done))])
      if (n > 0) write (output_unit, '(a)') 'remarks               '//count_of(n, 'converged row')//' with warnings or '// &
         'remarks: column message'
      if (command%part%number > 0) then
         write (output_unit, '(a)') 'file                  '// &
            journal_path(study%undertaking%stem, command%part)
      else
         write (output_unit, '(a)') 'files                 '//study%undertaking%stem//'.csv .h5'
      end if

   contains

      !> Whether there is something to say of a row that converged
      logical function said(k)
         !> Its number
         integer, intent(in) :: k

         said = .false.
         if (done(k)%number > 0 .and. done(k)%code == exit_ok) said = len(done(k)%message) > 0
      end function said

      !> Rows that ended with an exit code
      integer function ended(code)
         !> The code
         integer, intent(in) :: code

         ended = count(done%number > 0 .and. done%code == code)
      end function ended

   end subroutine tell_end

end module axijoint_command_study
