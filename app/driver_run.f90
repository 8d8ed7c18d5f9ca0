!> `axijoint run`: decks to results
module axijoint_driver_run
   use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
   use axijoint_analysis_core_remarks, only : remark_on_goal
   use axijoint_analysis_core_results, only : results_type, remark_type, round_type
   use axijoint_analysis_core_structure, only : structure_type, build_structure
   use axijoint_analysis_static, only : analyse_combination
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_deck, exit_not_converged, exit_singular
   use axijoint_base_progress, only : progress_type, show_progress, clear_progress
   use axijoint_base_system, only : error_output_is_terminal
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type, phase_read, phase_write
   use axijoint_cli, only : command_type, word_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render, warning_texts
   use axijoint_deck_text_source, only : source_type
   use axijoint_driver_goal, only : refine_to_goal, take_options
   use axijoint_job_reader, only : read_job
   use axijoint_model_model, only : model_type
   use axijoint_output_brief, only : brief_text
   use axijoint_output_output, only : check_output, write_output, write_error_summary
   use omp_lib, only : omp_set_num_threads
   implicit none
   private
   public :: run_decks, print_error

contains

   !> Run decks one after the other; one that fails does not stop the rest
   subroutine run_decks(command, exit_code)
      !> Decks and options
      type(command_type), intent(in) :: command
      !> Largest exit code of all decks
      integer, intent(out) :: exit_code

      type(error_type), allocatable :: error
      integer :: k, code

      exit_code = exit_ok
      if (command%threads > 0) call omp_set_num_threads(command%threads)
      call check_names(command%decks, error)
      if (allocated(error)) then
         call print_error('', error)
         exit_code = error%code
         return
      end if
      do k = 1, size(command%decks)
         associate (deck => command%decks(k)%text)
            call run_deck(deck, command, code, error)
            if (allocated(error)) then
               call print_error(deck, error)
               if (len(job_name(deck)) > 0) then
                  call write_error_summary(command%directory, job_name(deck), deck, error%code, &
                                           [error%message])
               end if
               code = error%code
            end if
         end associate
         exit_code = max(exit_code, code)
      end do
   end subroutine run_decks

   !> One deck, told in order
   subroutine run_deck(deck, command, exit_code, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Directory for results and other options
      type(command_type), intent(in) :: command
      !> 0, or 3 if the results are not converged
      integer, intent(out) :: exit_code
      !> Anything else that went wrong
      type(error_type), allocatable, intent(out) :: error

      type(source_type) :: source
      type(model_type), target :: model
      type(diagnostics_type) :: diagnostics
      type(structure_type), target :: structure
      type(timer_type) :: timer
      type(progress_type) :: progress
      integer :: k, code

      exit_code = exit_ok
      progress%enabled = error_output_is_terminal()
      call timer%start()
      call timer%push(phase_read)
      call show_progress(progress, 'reading '//deck)
      call read_job(deck, source, model, diagnostics)
      call timer%pop()
      call clear_progress(progress)
      if (diagnostics%n_errors > 0) then
         call fatal_error(error, exit_deck, render(diagnostics, source))
         return
      end if
      if (diagnostics%n_warnings > 0) write (error_unit, '(a)') render(diagnostics, source)

      call take_options(command, model)
      do k = 1, size(model%combinations)
         call check_output(command%directory, result_name(deck, model, k), source, model, error)
         if (allocated(error)) return
      end do
      if (model%error_goal%wanted) then
         call run_to_goal(deck, command, model, structure, source, diagnostics, timer, progress, exit_code, error)
         call clear_progress(progress)
         return
      end if
      call build_structure(model, structure, timer, progress, error)
      do k = 1, size(model%combinations)
         if (allocated(error)) exit
         call run_combination(deck, command, model, structure, k, source, &
                              warning_texts(diagnostics, source), timer, progress, code, error)
         exit_code = max(exit_code, code)
      end do
      call clear_progress(progress)
   end subroutine run_deck

   !> Solve one combination and write its results, before the next is begun
   subroutine run_combination(deck, command, model, structure, k, source, warnings, timer, progress, &
                              exit_code, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Directory for results and other options
      type(command_type), intent(in) :: command
      !> The job
      type(model_type), intent(in), target :: model
      !> Its structure, factored
      type(structure_type), intent(inout), target :: structure
      !> Place of the combination
      integer, intent(in) :: k
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> Warnings about the deck
      character(len=*), intent(in) :: warnings(:)
      !> Times of the run
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> 0, or 3 if the results are not converged
      integer, intent(out) :: exit_code
      !> Singular stiffness, out of memory; the results cannot be written
      type(error_type), allocatable, intent(out) :: error

      type(results_type) :: results

      call analyse_combination(model, structure, model%combinations(k), results, timer, progress, error)
      call clear_progress(progress)
      exit_code = exit_ok
      if (allocated(error)) return
      call write_combination(deck, command, model, structure, k, source, warnings, results, timer, exit_code, error)
   end subroutine run_combination

   !> Write the results of a combination
   subroutine write_combination(deck, command, model, structure, k, source, warnings, results, timer, &
                                exit_code, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Directory for results and other options
      type(command_type), intent(in) :: command
      !> The job
      type(model_type), intent(in), target :: model
      !> Its structure, factored
      type(structure_type), intent(inout), target :: structure
      !> Place of the combination
      integer, intent(in) :: k
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> Warnings about the deck
      character(len=*), intent(in) :: warnings(:)
      !> The results
      type(results_type), intent(inout) :: results
      !> Times of the run
      type(timer_type), intent(inout) :: timer
      !> 0, 3 if the results are not converged, 4 if they end in a mechanism
      integer, intent(out) :: exit_code
      !> The results cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name

      name = result_name(deck, model, k)
      if (size(model%combinations) > 1) results%combination = model%combinations(k)%label
      exit_code = merge(exit_ok, exit_not_converged, results%converged)
      if (allocated(results%mechanism)) exit_code = exit_singular
      call timer%push(phase_write)
      call write_output(command%directory, name, source, all_warnings(warnings, results%remarks), &
                        model, structure, results, timer, exit_code, error)
      call timer%pop()
      if (allocated(error)) return
      write (output_unit, '(a)') brief_text(command%directory, name, deck, model, results, timer)
   end subroutine write_combination

   !> Solve a job again and again, refined, until its error is below its target; write
   !> the results of the last round
   subroutine run_to_goal(deck, command, model, structure, source, diagnostics, timer, progress, exit_code, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Directory for results and other options
      type(command_type), intent(in) :: command
      !> The job; refined on return
      type(model_type), intent(inout), target :: model
      !> Takes its structure
      type(structure_type), intent(inout), target :: structure
      !> Cards of the deck, and warnings about them
      type(source_type), intent(inout) :: source
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Times of the run
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Largest of the combinations
      integer, intent(out) :: exit_code
      !> Anything that went wrong
      type(error_type), allocatable, intent(out) :: error

      type(results_type), allocatable :: results(:)
      type(round_type), allocatable :: rounds(:)
      integer :: k, code

      exit_code = exit_ok
      call refine_to_goal(deck, command, model, structure, results, rounds, source, diagnostics, timer, progress, &
                          error)
      if (allocated(error)) return
      do k = 1, size(model%combinations)
         results(k)%rounds = rounds
         call remark_on_goal(model, results(k))
         call write_combination(deck, command, model, structure, k, source, warning_texts(diagnostics, source), &
                                results(k), timer, code, error)
         exit_code = max(exit_code, code)
         if (allocated(error)) return
      end do
   end subroutine run_to_goal

   !> Name of the result files: that of the deck, with the number of the
   !> combination if there are several
   function result_name(deck, model, k) result(name)
      !> Path of the deck
      character(len=*), intent(in) :: deck
      !> The job
      type(model_type), intent(in) :: model
      !> Place of the combination
      integer, intent(in) :: k
      !> The name
      character(len=:), allocatable :: name

      name = job_name(deck)
      if (size(model%combinations) > 1) name = name//'.'//to_text(model%combinations(k)%label)
   end function result_name

   !> Warnings about the deck and remarks on the results
   function all_warnings(warnings, remarks) result(texts)
      !> Warnings about the deck
      character(len=*), intent(in) :: warnings(:)
      !> Remarks on the results
      type(remark_type), intent(in) :: remarks(:)
      !> All of them
      character(len=:), allocatable :: texts(:)

      integer :: k, length

      length = len(warnings)
      do k = 1, size(remarks)
         length = max(length, len(remarks(k)%text))
      end do
      allocate (character(len=length) :: texts(size(warnings) + size(remarks)))
      texts(:size(warnings)) = warnings
      do k = 1, size(remarks)
         texts(size(warnings) + k) = remarks(k)%text
      end do
   end function all_warnings

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

   !> Name of a deck without directories and ending
   pure function job_name(deck) result(name)
      !> Path of the deck
      character(len=*), intent(in) :: deck
      !> The name
      character(len=:), allocatable :: name

      integer :: dot

      name = deck(index(deck, '/', back=.true.) + 1:)
      dot = index(name, '.', back=.true.)
      if (dot > 1) name = name(:dot - 1)
   end function job_name

   !> Print an error where errors go
   subroutine print_error(deck, error)
      !> Deck; empty if the error belongs to none
      character(len=*), intent(in) :: deck
      !> The error
      type(error_type), intent(in) :: error

      if (error%code == exit_deck .and. len(deck) > 0) then
         write (error_unit, '(a)') error%message  ! names file and line itself
      else if (len(deck) > 0) then
         write (error_unit, '(a)') 'axijoint: '//deck//': '//error%message
      else
         write (error_unit, '(a)') 'axijoint: '//error%message
      end if
   end subroutine print_error

end module axijoint_driver_run
