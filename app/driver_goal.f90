!> Rounds of refinement of a job that has an error target
module axijoint_driver_goal
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_results, only : results_type, round_type
   use axijoint_analysis_core_structure, only : structure_type, build_structure
   use axijoint_analysis_error_goal, only : goal_error, refine_further, too_large
   use axijoint_analysis_static, only : analyse_combination
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type, phase_read
   use axijoint_cli, only : command_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_deck_text_source, only : source_type
   use axijoint_job_reader, only : read_job
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : refinement_type
   use axijoint_output_file_totals, only : n_unknowns
   implicit none
   private
   public :: refine_to_goal, take_options

contains

   !> Solve all combinations, and again with a refined job, until the largest error is below
   !> the target or a limit is met
   subroutine refine_to_goal(deck, command, model, structure, results, rounds, source, diagnostics, timer, &
                             progress, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Options
      type(command_type), intent(in) :: command
      !> The job; refined on return
      type(model_type), intent(inout), target :: model
      !> Takes the structure of the last round
      type(structure_type), intent(inout), target :: structure
      !> Results of its combinations
      type(results_type), allocatable, intent(out) :: results(:)
      !> What each round came to
      type(round_type), allocatable, intent(out) :: rounds(:)
      !> Cards of the deck, and warnings about them
      type(source_type), intent(inout) :: source
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Times of the run
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Errors of the refined job
      type(error_type), allocatable, intent(out) :: error

      type(refinement_type) :: refinement, before
      integer :: worst
      logical :: changed, back

      allocate (rounds(0))
      back = .false.
      do
         call solve_round(refinement, model, structure, results, rounds, worst, timer, progress, error)
         if (back) then
            rounds = rounds(:size(rounds) - 1)  ! this one stands there already
            return
         end if
         associate (last => rounds(size(rounds)))
            back = allocated(last%failure) .and. size(rounds) > 1
            if (back) then
               refinement = before
               if (allocated(error)) deallocate (error)
            else
               if (allocated(error) .or. allocated(last%failure)) return
               if (last%error <= model%error_goal%target) return  ! met, or not known
               if (size(rounds) >= model%error_goal%most_rounds) return
               before = refinement
               call refine_further(model, results(worst)%budget, last%n_unknowns, refinement, changed)
               if (.not. changed) return
            end if
         end associate
         call show_progress(progress, 'round '//to_text(size(rounds) + 1)//' of refinement')
         call read_refined(deck, command, refinement, model, source, diagnostics, timer, error)
         if (allocated(error)) return
         if (too_large(model) .and. .not. back) then
            call read_refined(deck, command, before, model, source, diagnostics, timer, error)
            return
         end if
      end do
   end subroutine refine_to_goal

   !> Read the job as it is refined
   subroutine read_refined(deck, command, refinement, model, source, diagnostics, timer, error)
      !> The deck
      character(len=*), intent(in) :: deck
      !> Options
      type(command_type), intent(in) :: command
      !> How it is refined
      type(refinement_type), intent(inout) :: refinement
      !> The job
      type(model_type), intent(inout) :: model
      !> Cards of the deck, and warnings about them
      type(source_type), intent(inout) :: source
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Times of the run
      type(timer_type), intent(inout) :: timer
      !> Errors of the refined job
      type(error_type), allocatable, intent(out) :: error

      call timer%push(phase_read)
      call read_job(deck, source, model, diagnostics, refinement)
      if (diagnostics%n_errors > 0 .and. abs(refinement%mesh - anint(refinement%mesh)) > 0.0_wp) then
         ! an edge that faces two others keeps facing them if all are divided by the same integer
         refinement%mesh = ceiling(refinement%mesh)
         call read_job(deck, source, model, diagnostics, refinement)
      end if
      call timer%pop()
      if (diagnostics%n_errors > 0) then
         call fatal_error(error, exit_deck, 'the refined job (elements of BLOCKS times '// &
                          to_text(refinement%mesh)//') has faults:'//new_line('a')//render(diagnostics, source))
         return
      end if
      call take_options(command, model)
   end subroutine read_refined

   !> What the command line says of a job
   subroutine take_options(command, model)
      !> Options
      type(command_type), intent(in) :: command
      !> The job
      type(model_type), intent(inout) :: model

      if (command%solver_given) then
         if (allocated(model%solver)) deallocate (model%solver)
         if (allocated(command%solver)) model%solver = command%solver
      end if
      model%memory_limit = command%memory_limit
      model%sweep%wanted = model%sweep%wanted .or. command%swept
   end subroutine take_options

   !> Solve all combinations, and note what the round came to
   subroutine solve_round(refinement, model, structure, results, rounds, worst, timer, progress, error)
      !> How the job was refined
      type(refinement_type), intent(in) :: refinement
      !> The job
      type(model_type), intent(in), target :: model
      !> Its structure
      type(structure_type), intent(inout), target :: structure
      !> Results of its combinations
      type(results_type), allocatable, intent(out) :: results(:)
      !> One more round
      type(round_type), allocatable, intent(inout) :: rounds(:)
      !> The combination with the largest error, or the first that did not converge
      integer, intent(out) :: worst
      !> Times of the run
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      type(round_type) :: round
      real(wp) :: errors(size(model%combinations)), start
      integer :: k

      start = omp_get_wtime()
      worst = 1
      allocate (results(size(model%combinations)))
      call build_structure(model, structure, timer, progress, error)
      do k = 1, size(results)
         if (allocated(error)) exit
         call analyse_combination(model, structure, model%combinations(k), results(k), timer, progress, error)
         if (allocated(error) .or. results(k)%converged) cycle
         if (.not. allocated(round%failure)) worst = k
         round%failure = 'did not converge'
      end do
      if (allocated(error)) then
         round%failure = 'could not be solved ('//error%message//')'
      else if (.not. allocated(round%failure)) then
         errors = [(goal_error(model, results(k)), k=1, size(results))]
         worst = maxloc(errors, 1)
         round%error = errors(worst)
      end if
      round%mesh = refinement%mesh
      round%nodes = maxval(model%mesh%element_size)
      round%harmonic = model%max_harmonic
      round%planes = model%n_planes
      if (allocated(results(worst)%solves)) round%n_unknowns = n_unknowns(results(worst))
      round%seconds = omp_get_wtime() - start
      rounds = [rounds, round]
   end subroutine solve_round

end module axijoint_driver_goal
