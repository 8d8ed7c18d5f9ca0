!> Rounds of refinement of a job that has an error target
module axijoint_driver_goal
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_goal, only : goal_error, refine_further
   use axijoint_analysis_results, only : results_type, round_type
   use axijoint_analysis_static, only : analyse_combination
   use axijoint_analysis_structure, only : structure_type, build_structure
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type, phase_read
   use axijoint_cli, only : command_type
   use axijoint_deck_diagnostics, only : diagnostics_type, render
   use axijoint_deck_reader, only : read_deck
   use axijoint_deck_source, only : source_type
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : refinement_type
   use axijoint_output_totals, only : n_unknowns
   implicit none
   private
   public :: refine_to_goal

   !> Unknowns grow at most so in a round: the limit is looked at before it
   real(wp), parameter :: growth = 4.0_wp

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

      type(refinement_type) :: refinement
      type(round_type) :: round
      real(wp) :: start
      integer :: worst
      logical :: changed

      allocate (rounds(0))
      do
         start = omp_get_wtime()
         call solve_round(model, structure, results, worst, timer, progress, error)
         if (allocated(error)) return
         round = round_type(refinement%mesh, model%max_harmonic, model%n_planes, n_unknowns(results(worst)), &
                            -1.0_wp, omp_get_wtime() - start)
         if (results(worst)%converged) round%error = goal_error(results(worst)%budget, model%error_goal)
         rounds = [rounds, round]
         if (.not. results(worst)%converged) return
         if (round%error >= 0.0_wp .and. round%error <= model%error_goal%target) return
         if (size(rounds) >= model%error_goal%most_rounds) return
         if (growth*round%n_unknowns > model%error_goal%most_unknowns) return
         call refine_further(model, results(worst)%budget, refinement, changed)
         if (.not. changed) return
         call show_progress(progress, 'round '//to_text(size(rounds) + 1)//' of refinement')
         call timer%push(phase_read)
         call read_deck(deck, source, model, diagnostics, refinement)
         call timer%pop()
         if (diagnostics%n_errors > 0) then
            call fatal_error(error, exit_deck, 'the refined job (elements of BLOCKS times '// &
                             to_text(refinement%mesh)//') has faults:'//new_line('a')//render(diagnostics, source))
            return
         end if
         if (command%solver >= 0) model%solver = command%solver
         model%memory_limit = command%memory_limit
      end do
   end subroutine refine_to_goal

   !> Solve all combinations
   subroutine solve_round(model, structure, results, worst, timer, progress, error)
      !> The job
      type(model_type), intent(in), target :: model
      !> Its structure
      type(structure_type), intent(inout), target :: structure
      !> Results of its combinations
      type(results_type), allocatable, intent(out) :: results(:)
      !> The combination with the largest error, or the first that did not converge
      integer, intent(out) :: worst
      !> Times of the run
      type(timer_type), intent(inout) :: timer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: largest, found
      integer :: k

      worst = 1
      largest = -1.0_wp
      allocate (results(size(model%combinations)))
      call build_structure(model, structure, timer, progress, error)
      do k = 1, size(results)
         if (allocated(error)) return
         call analyse_combination(model, structure, model%combinations(k), results(k), timer, progress, error)
         if (allocated(error)) return
         found = huge(1.0_wp)
         if (results(k)%converged) found = goal_error(results(k)%budget, model%error_goal)
         if (found > largest) worst = k
         largest = max(largest, found)
      end do
   end subroutine solve_round

end module axijoint_driver_goal
