!> `axijoint run`: decks to results
module axijoint_command_run
   use, intrinsic :: iso_fortran_env, only : output_unit, compiler_options
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_deck, exit_io, &
      exit_in_use, exit_state, exit_stopped
   use axijoint_base_kinds, only : wp
   use axijoint_base_memory, only : give_back_memory
   use axijoint_base_progress, only : show_progress, clear_progress, tell_below
   use axijoint_base_stop, only : heed_signals, check_stop
   use axijoint_base_system, only : error_output_is_terminal, target_kind, path_file, peak_memory_mb, forget_peak_memory
   use axijoint_base_sha256, only : sha256
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : phase_write
   use axijoint_command_line, only : command_type, word_type
   use axijoint_command_run_processes, only : run_in_processes, are_apart
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_job_combination, only : solve_combination, combination_label
   use axijoint_job_goal, only : refine_to_goal
   use axijoint_job_job, only : job_type, job_name, deck_name, result_name, standard_input
   use axijoint_job_read, only : read_job
   use axijoint_output_brief, only : brief_text, status_text, reason_text
   use axijoint_output_claim, only : claim_type, claim_output, release_output
   use axijoint_output_done, only : earlier_exit_code
   use axijoint_output_file_echo, only : deck_text
   use axijoint_output_file_hdf5, only : start_library
   use axijoint_output_file_run, only : exit_code_of
   use axijoint_output_other_results, only : other_results_text
   use axijoint_output_output, only : check_output, write_output, write_error_summary, remove_error_summary
   use axijoint_output_state, only : begin_state, end_state, stopped_text, note_written, is_written
   use omp_lib, only : omp_get_max_threads, omp_get_thread_num, omp_set_num_threads
   implicit none
   private
   public :: run_decks, print_error, speaks, without_goal

   !> What is wrong with an error target, but no estimates
   character(len=*), parameter :: without_goal = 'ERROR of the deck asks for a bound of errors, which --no-estimates leaves out'// &
      new_line('a')//'mend: leave out one of them'

contains

   !> Run decks one after the other, or some at once; one that fails does not stop the rest
   subroutine run_decks(command, exit_code)
      !> Decks and options
      type(command_type), intent(in) :: command
      !> Largest exit code of all decks
      integer, intent(out) :: exit_code

      type(error_type), allocatable :: error
      integer :: n_begun, codes(size(command%decks))

      exit_code = exit_ok
      call warn_if_slow()
      if (command%threads > 0) call omp_set_num_threads(command%threads)
      call heed_signals(with_others=allocated(command%options%team))
      call check_names(command%decks, error)
      if (command%n_processes > 1 .and. allocated(command%options%team)) call fatal_error(error, exit_deck, &
         'option --processes is not for several processes by MPI, which share each deck')
      if (allocated(error)) then
         call print_error('', error)
         exit_code = error%code
         return
      end if
      if (command%n_processes > 1 .and. size(codes) > 1 .and. are_apart(command)) then
         call run_in_processes(command, codes, n_begun)
      else
         call run_in_order(command, codes, n_begun)
      end if
      exit_code = maxval(codes)
      if (any(codes == exit_stopped)) exit_code = exit_stopped  ! a run that goes on is to follow, even if a process was killed
      if (speaks(command)) call tell(failed_decks(command%decks, codes, n_begun))
   end subroutine run_decks

   !> Run decks one after the other
   subroutine run_in_order(command, codes, n_begun)
      !> Decks and options
      type(command_type), intent(in) :: command
      !> Exit codes
      integer, intent(out) :: codes(:)
      !> Decks that were begun
      integer, intent(out) :: n_begun

      type(error_type), allocatable :: error
      type(claim_type) :: claim
      integer :: k

      codes = exit_ok
      do k = 1, size(codes)
         n_begun = k
         if (k > 1) call begin_anew()
         associate (deck => command%decks(k)%text)
            call run_deck(deck, command, claim, codes(k), error)
            if (allocated(error)) then
               call print_error(deck, error)
               if (speaks(command)) &
                  call leave_summary(deck, command%options%directory, claim, error)
               codes(k) = error%code
            end if
         end associate
         call release_output(claim)
         if (codes(k) == exit_stopped) exit
      end do
   end subroutine run_in_order


   !> What a deck before has taken, and given back, is no memory of the next one
   subroutine begin_anew()
      !> Less is kept for the next one, which is faster so [MiB]
      real(wp), parameter :: worth_giving_back = 128.0_wp

      if (peak_memory_mb() > worth_giving_back) call give_back_memory()
      call forget_peak_memory()
   end subroutine begin_anew

   !> Which of several decks did not end well, so that nobody has to look for them in what was said of all
   pure function failed_decks(decks, codes, n) result(text)
      !> The decks
      type(word_type), intent(in) :: decks(:)
      !> Their exit codes, and how many were begun
      integer, intent(in) :: codes(:), n
      !> A line; empty if there is nothing to say
      character(len=:), allocatable :: text

      integer, parameter :: most = 20
      integer :: k, named

      text = ''
      if (size(decks) == 1 .or. all(codes == exit_ok)) return
      if (all(codes(:n) == exit_ok)) then
         text = 'axijoint: '//to_text(size(decks) - n)//' of '//to_text(size(decks))//' decks were not begun'
         return
      end if
      text = 'axijoint: '//to_text(count(codes(:n) /= exit_ok))//' of '//to_text(size(decks))//' decks did not end well:'
      named = 0
      do k = 1, n
         if (codes(k) == exit_ok) cycle
         named = named + 1
         if (named <= most) text = text//' '//deck_name(decks(k)%text)//' ('//to_text(codes(k))//'),'
      end do
      if (named > most) text = text//' and more,'
      text = text(:len(text) - 1)
      if (n < size(decks)) text = text//'; '//to_text(size(decks) - n)//' were not begun'
   end function failed_decks

   !> A summary of an error, unless the deck is not there – a name that was mistyped leaves
   !> nothing – or another run writes these files
   subroutine leave_summary(deck, directory, claim, error)
      !> The deck, and the directory for results
      character(len=*), intent(in) :: deck, directory
      !> Names that this run holds
      type(claim_type), intent(in) :: claim
      !> The error
      type(error_type), intent(in) :: error

      logical :: there

      there = target_kind(deck) == path_file
      if (any(error%code == [exit_in_use, exit_state, exit_stopped])) return
      if (.not. (there .or. deck == standard_input)) return
      call write_error_summary(directory, job_name(deck), deck_name(deck), error%code, &
         [error%message], claim%held())
   end subroutine leave_summary

   !> One deck, told in order
   subroutine run_deck(deck, command, claim, exit_code, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Directory for results and other options
      type(command_type), intent(in) :: command
      !> Takes the names of its results
      type(claim_type), intent(out) :: claim
      !> 0, 3 if the results are not converged, 4 if they end in a mechanism
      integer, intent(out) :: exit_code
      !> Anything else that went wrong
      type(error_type), allocatable, intent(out) :: error

      type(job_type), target :: job
      character(len=:), allocatable :: beside, notes

      exit_code = exit_ok
      beside = ''
      call begin(deck, command, job, error)
      if (.not. allocated(error) .and. job%model%error_goal%wanted .and. .not. job%options%estimated) &
         call fatal_error(error, exit_deck, without_goal)
      if (.not. allocated(error)) call check_results(job, command%decks, error)
      call check_stop(error)
      if (.not. allocated(error) .and. speaks(command)) then
         call check_output(job, error)
         if (.not. allocated(error)) then
            call claim_output(job, claim, notes, error)
            if (.not. allocated(error)) beside = claim%beside
            call tell(notes)
         end if
      end if
      if (allocated(job%options%team)) call agree_on_deck(job, error)
      if (command%resume .and. .not. allocated(error)) then
         exit_code = earlier_exit_code(job)
         if (exit_code >= exit_ok) then
            call clear_progress(job%progress)
            if (.not. speaks(command)) return
            call tell('axijoint: '//deck_name(deck)//': its results are there already, with exit code '//to_text(exit_code)// &
               '; a run without --resume makes them anew')
            call remove_error_summary(job)
            return
         end if
         exit_code = exit_ok
      end if
      if (.not. allocated(error)) then
         call begin_state(job, command%interval, command%resume, notes, error)
         call tell(notes)
      end if
      if (.not. allocated(error)) call solve_and_write(job, beside, command%quiet, exit_code, error)
      call clear_progress(job%progress)
      if (.not. speaks(command)) return
      if (.not. allocated(error)) then
         call end_state(job)
         call remove_error_summary(job)
      else if (error%code == exit_stopped) then
         error%message = stopped_text(job, error%message)
      end if
   end subroutine run_deck

   !> Solve a job and write its results, those of each combination before the next is begun
   subroutine solve_and_write(job, beside, quiet, exit_code, error)
      !> The job
      type(job_type), intent(inout), target :: job
      !> Files that were in the folder before, each followed by a line feed
      character(len=*), intent(in) :: beside
      !> Whether the screen is to stay empty
      logical, intent(in) :: quiet
      !> Largest of the combinations
      integer, intent(inout) :: exit_code
      !> What went wrong
      type(error_type), allocatable, intent(out) :: error

      type(results_type), allocatable :: results(:)
      integer :: k

      if (job%model%error_goal%wanted) then
         call refine_to_goal(job, results, error)
         if (.not. allocated(error)) call warn_of_target(deck_name(job%deck), results)
         do k = 1, size(job%model%combinations)
            if (allocated(error)) exit
            call write_combination(job, results(k), quiet, exit_code, error)
         end do
         if (.not. allocated(error)) call tell(other_results_text(job, beside))
         return
      end if
      allocate (results(1))
      do k = 1, size(job%model%combinations)
         if (is_written(job, k)) then
            exit_code = max(exit_code, job%checkpoint%parts(k)%exit_code)
            call tell('axijoint: the results of combination '// &
               to_text(combination_label(job, k))//' are written already')
            cycle
         end if
         call solve_combination(job, k, results(1), error)
         if (.not. allocated(error)) &
            call write_combination(job, results(1), quiet, exit_code, error)
         if (allocated(error)) exit
         call note_written(job, k, exit_code_of(results(1)))
      end do
      if (.not. allocated(error)) call tell(other_results_text(job, beside))
   end subroutine solve_and_write

   !> Warn that the rounds of refinement did not meet the target of the error: all combinations have
   !> the same
   subroutine warn_of_target(deck, results)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Results of the combinations
      type(results_type), intent(in) :: results(:)

      integer :: k

      do k = 1, size(results)
         if (.not. allocated(results(k)%missed)) cycle
         call tell(deck//': warning: '//results(k)%missed)
         return
      end do
   end subroutine warn_of_target

   !> Tell what is no result
   subroutine tell(notes)
      !> Lines, or nothing
      character(len=*), intent(in) :: notes

      if (len(notes) > 0) call tell_below(notes)
   end subroutine tell

   !> Make sure that all processes that share the work read the same deck without errors
   subroutine agree_on_deck(job, error)
      !> The job, read
      type(job_type), intent(in) :: job
      !> Error of one, then of all
      type(error_type), allocatable, intent(inout) :: error

      character(len=:), allocatable :: here, there

      call job%options%team%agree(error)
      if (allocated(error)) return
      here = sha256(deck_text(job%source))
      there = here
      call job%options%team%tell(there)
      if (here /= there) call fatal_error(error, exit_io, 'process '// &
         to_text(job%options%team%rank)//' reads another deck under this name than the first'// &
         new_line('a')//'mend: put the deck where all machines see the same file')
      call job%options%team%agree(error)
   end subroutine agree_on_deck

   !> Whether this process writes and tells: one of those that share the work does
   pure logical function speaks(command)
      !> The command
      type(command_type), intent(in) :: command

      speaks = .true.
      if (allocated(command%options%team)) speaks = command%options%team%rank == 0
   end function speaks

   !> Read the deck, and tell what is wrong with it. Another thread starts the library that writes results meanwhile
   subroutine begin(deck, command, job, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Options
      type(command_type), intent(in) :: command
      !> The job
      type(job_type), intent(out) :: job
      !> Errors of the deck
      type(error_type), allocatable, intent(out) :: error

      type(diagnostics_type) :: diagnostics
      logical :: started  ! if not, who creates the file will say so

      job%options = command%options
      job%progress%logged = command%verbose
      job%progress%enabled = error_output_is_terminal() .and. &
                             .not. (command%quiet .or. command%verbose)
      call job%timer%start()
      call show_progress(job%progress, 'reading '//deck_name(deck))
      !$omp parallel num_threads(min(2, omp_get_max_threads()))
      if (omp_get_thread_num() == 1 .and. speaks(command)) call start_library(started)
      !$omp master
      call read_job(deck, job, diagnostics)
      !$omp end master
      !$omp end parallel
      call clear_progress(job%progress)
      if (allocated(job%conversion)) call tell_below(job%conversion)
      if (diagnostics%n_errors > 0) then
         call fatal_error(error, exit_deck, render(diagnostics, job%source))
      else if (diagnostics%n_warnings > 0) then
         call tell_below(render(diagnostics, job%source))
      end if
   end subroutine begin

   !> Write the results of a combination, and the lines on the screen
   subroutine write_combination(job, results, quiet, exit_code, error)
      !> The job, solved
      type(job_type), intent(inout), target :: job
      !> The results
      type(results_type), intent(in) :: results
      !> Whether the screen is to stay empty
      logical, intent(in) :: quiet
      !> Largest of the combinations
      integer, intent(inout) :: exit_code
      !> The results cannot be written
      type(error_type), allocatable, intent(out) :: error

      call clear_progress(job%progress)
      exit_code = max(exit_code, exit_code_of(results))
      call job%timer%push(phase_write)
      call write_output(job, results, error)
      call job%timer%pop()
      if (allocated(error)) return
      if (.not. quiet) then
         write (output_unit, '(a)') brief_text(job, results)
         flush (output_unit)
      else if (exit_code_of(results) /= exit_ok) then
         call tell_below('axijoint: '//deck_name(job%deck)//': '//status_text(results))
         if (len(reason_text(results)) > 0) call tell_below(reason_text(results))
      end if
   end subroutine write_combination

   !> Say that the program was built for debugging: fpm does so unless it is told otherwise
   subroutine warn_if_slow()
      if (index(compiler_options(), ' -O') > 0 .and. index(compiler_options(), ' -O0') == 0) return
      call tell_below('axijoint: built without optimization, several times slower '// &
         'than need be; `fpm @install` '// &
         'or `fpm @release` builds it with')
   end subroutine warn_if_slow

   !> Two decks of one name would write the same files
   subroutine check_names(decks, error)
      !> The decks
      type(word_type), intent(in) :: decks(:)
      !> The clash
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j

      do i = 2, size(decks)
         do j = 1, i - 1
            if (job_name(decks(i)%text) /= job_name(decks(j)%text)) cycle
            call fatal_error(error, exit_deck, decks(j)%text//' and '//decks(i)%text// &
                             ' would write the same result files'//new_line('a')// &
                             'mend: run them one after the other with different -o, or rename one')
            return
         end do
      end do
   end subroutine check_names

   !> Results of combinations, of joints swept round the axis and listings of other programs have longer names than the
   !> deck, which may be those of another
   subroutine check_results(job, decks, error)
      !> The job
      type(job_type), intent(in) :: job
      !> All decks of this call
      type(word_type), intent(in) :: decks(:)
      !> The clash
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name
      integer :: i, k

      do i = 1, size(decks)
         if (job_name(decks(i)%text) == job_name(job%deck)) cycle
         do k = 1, size(job%model%combinations)
            name = result_name(job, combination_label(job, k))
            if (.not. (job_name(decks(i)%text) == name .or. &
                       (job%model%sweep%wanted .and. job_name(decks(i)%text) == name//'.joints') .or. &
                       (job%model%old_listing .and. job_name(decks(i)%text) == name//'.owen-hinton'))) cycle
            call fatal_error(error, exit_deck, 'results would be written to files of '//decks(i)%text//', '// &
                             job_name(decks(i)%text)//'.*'//new_line('a')// &
                             'mend: run them one after the other with different -o, or rename one')
            return
         end do
      end do
   end subroutine check_results

   !> Print an error where errors go
   subroutine print_error(deck, error)
      !> Deck; empty if the error belongs to none
      character(len=*), intent(in) :: deck
      !> The error
      type(error_type), intent(in) :: error

      if (error%code == exit_deck .and. len(deck) > 0 .and. index(error%message, ': error: ') > 0) then
         call tell_below(error%message)  ! names file and line itself
      else if (len(deck) > 0) then
         call tell_below('axijoint: '//deck_name(deck)//': '//error%message)
      else
         call tell_below('axijoint: '//error%message)
      end if
   end subroutine print_error

end module axijoint_command_run
