!> Rounds of refinement of a job that has an error target
module axijoint_job_goal
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_remarks, only : remark_on_goal
   use axijoint_analysis_core_results, only : results_type, round_type, error_share_type, source_iteration, source_harmonics
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_error_goal, only : goal_error, unknown_source, refine_further, room_for, mesh_misses
   use axijoint_base_error, only : error_type, fatal_error, exit_deck, exit_state, exit_stopped
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : show_progress
   use axijoint_base_text, only : to_text, name_of
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_job_combination, only : solve_combination
   use axijoint_job_job, only : job_type
   use axijoint_job_read, only : read_job
   use axijoint_job_remesh, only : remake_mesh, check_mesh_file
   use axijoint_job_round_record, only : round_bytes, restore_round
   use axijoint_model_model, only : model_type, method_newton
   use axijoint_model_request, only : refinement_type
   implicit none
   private
   public :: refine_to_goal

contains

   !> Solve a job, and again as it is refined, until its error is below its target
   subroutine refine_to_goal(job, results, error)
      !> The job; refined on return
      type(job_type), intent(inout), target :: job
      !> Results of its combinations, of the last round
      type(results_type), allocatable, intent(out) :: results(:)
      !> Errors of the refined job
      type(error_type), allocatable, intent(out) :: error

      type(round_type), allocatable :: rounds(:)
      type(refinement_type) :: refinement
      character(len=:), allocatable :: note
      integer :: k

      call run_rounds(job, results, rounds, refinement, note, error)
      if (allocated(error)) return
      do k = 1, size(results)
         results(k)%rounds = rounds
         call remark_on_goal(job%model, refinement, note, unknown_source(job%model, results(k)), results(k))
      end do
   end subroutine refine_to_goal

   !> Solve all combinations, and again with a refined job, until the largest error is below
   !> the target or a limit is met
   subroutine run_rounds(job, results, rounds, refinement, note, error)
      !> The job; refined on return
      type(job_type), intent(inout), target :: job
      !> Results of its combinations
      type(results_type), allocatable, intent(out) :: results(:)
      !> What each round came to
      type(round_type), allocatable, intent(out) :: rounds(:)
      !> How the job was refined in the round that the results are of
      type(refinement_type), intent(out) :: refinement
      !> Why its mesh is not made anew; empty if there is nothing to say
      character(len=:), allocatable, intent(out) :: note
      !> Errors of the refined job
      type(error_type), allocatable, intent(out) :: error

      type(refinement_type) :: before
      type(structure_type), allocatable :: solved
      integer :: worst
      logical :: changed, back

      allocate (rounds(0))
      note = ''
      back = .false.
      if (allocated(job%checkpoint%round)) &
         call restore_round(job%checkpoint%round, rounds, refinement, before, back)
      call check_mesh_file(refinement, error)
      if (allocated(error)) return
      if (size(rounds) > 0) call read_refined(job, refinement, error)
      if (allocated(error)) return
      do
         call job%checkpoint%begin_round(round_bytes(rounds, refinement, before, back))
         call solve_round(job, refinement, results, rounds, worst, error)
         if (allocated(error)) then
            if (any(error%code == [exit_stopped, exit_state])) return
         end if
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
               if (last%error <= job%model%error_goal%target .and. .not. more_would_tell(job%model, results)) &
                  return  ! met, or not known
               if (size(rounds) >= job%model%error_goal%most_rounds) return
               before = refinement
            end if
         end associate
         call show_progress(job%progress, 'round '//to_text(size(rounds) + 1)//' of refinement')
         call move_alloc(job%structure, solved)
         if (back) then
            call read_refined(job, refinement, error)
         else
            call refine_job(job, results(worst)%budget, element_errors(results), size(rounds) + 1, &
               refinement, changed, note, error)
            if (.not. (allocated(error) .or. changed)) then
               refinement = before
               call move_alloc(solved, job%structure)  ! the results are of this round
               return
            end if
         end if
         if (allocated(error)) return
         if (allocated(solved)) deallocate (solved)
      end do
   end subroutine run_rounds

   !> Whether the error would be known if the iteration were Newton's, or with harmonics above 1
   pure logical function more_would_tell(model, results) result(would)
      !> The job
      type(model_type), intent(in) :: model
      !> Results of its combinations
      type(results_type), intent(in) :: results(:)

      integer :: unknown(size(results)), k

      unknown = [(unknown_source(model, results(k)), k=1, size(results))]
      would = model%method /= method_newton .and. any(unknown == source_iteration) &
         .or. model%max_harmonic <= 1 .and. any(unknown == source_harmonics)
   end function more_would_tell

   !> Refine the job, as far as unknowns are allowed. Harmonics and intervals come in whole numbers:
   !> what has more unknowns than there was room for is refined again with less
   subroutine refine_job(job, budget, element_error, round, refinement, changed, note, error)
      !> The job as it was solved; refined on return
      type(job_type), intent(inout) :: job
      !> What its approximations leave
      type(error_share_type), intent(in) :: budget(:)
      !> Energy of the error of each element; empty if not known
      real(wp), intent(in) :: element_error(:)
      !> Number of the next round
      integer, intent(in) :: round
      !> How it is refined
      type(refinement_type), intent(inout) :: refinement
      !> Whether it was refined
      logical, intent(out) :: changed
      !> Why its mesh is not made anew; empty if there is nothing to say
      character(len=:), allocatable, intent(out) :: note
      !> Errors of the refined job
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: most_attempts = 4
      type(refinement_type) :: before
      real(wp) :: room
      integer :: attempt
      logical :: made

      note = ''
      before = refinement
      room = room_for(job%model)
      do attempt = 1, most_attempts
         call refine_further(job%model, budget, element_error, room, refinement, changed)
         if (allocated(refinement%sizes)) then
            call remake_mesh(job, round, refinement, made, note, error)
            if (allocated(error)) return
            deallocate (refinement%sizes)
            if (.not. made) refinement%mesh = before%mesh
            changed = made .or. (changed .and. .not. mesh_misses(job%model, budget))
         end if
         if (.not. changed) return
         call read_refined(job, refinement, error)
         if (allocated(error) .and. allocated(refinement%mesh_file)) then
            if (error%code /= exit_deck) return
            note = 'the deck does not fit '//name_of(refinement%mesh_file)//', which Gmsh made: '//first_fault(error%message)
            deallocate (error)
            refinement = before
            call read_refined(job, refinement, error)
            changed = .false.
            return
         end if
         if (allocated(error)) return
         if (room_for(job%model) >= 1.0_wp) return
         room = room*room_for(job%model)
         refinement = before
         call read_refined(job, refinement, error)
         if (allocated(error)) return
      end do
      changed = .false.
   end subroutine refine_job

   !> The first of the faults of a refined job
   pure function first_fault(message) result(fault)
      !> A line of its own, then the faults
      character(len=*), intent(in) :: message
      !> Without what is said more of it
      character(len=:), allocatable :: fault

      fault = message(index(message, new_line('a')) + 1:)
      fault = fault(:index(fault//new_line('a'), new_line('a')) - 1)
   end function first_fault

   !> Energy of the error of each element, of all combinations: each over the energy of its
   !> solution
   function element_errors(results) result(errors)
      !> Results of the combinations
      type(results_type), intent(in) :: results(:)
      !> Shape (elements); empty if not known
      real(wp), allocatable :: errors(:)

      integer :: k

      allocate (errors(0))
      do k = 1, size(results)
         if (.not. allocated(results(k)%discretization%element)) then
            errors = [real(wp) ::]
            return
         end if
         if (k == 1) then
            errors = results(k)%discretization%element
         else
            errors = errors + results(k)%discretization%element
         end if
      end do
   end function element_errors

   !> Read the job as it is refined
   subroutine read_refined(job, refinement, error)
      !> The job
      type(job_type), intent(inout) :: job
      !> How it is refined
      type(refinement_type), intent(inout) :: refinement
      !> Errors of the refined job
      type(error_type), allocatable, intent(out) :: error

      type(diagnostics_type) :: diagnostics

      call read_job(job%deck, job, diagnostics, refinement)
      if (diagnostics%n_errors > 0 .and. .not. allocated(refinement%mesh_file) .and. &
          (allocated(refinement%strips) .or. &
           abs(refinement%mesh - anint(refinement%mesh)) > 0.0_wp)) then
         ! an edge that faces two others keeps facing them if all are divided by the same integer
         if (allocated(refinement%strips)) deallocate (refinement%strips)
         refinement%mesh = ceiling(refinement%mesh)
         call read_job(job%deck, job, diagnostics, refinement)
      end if
      if (diagnostics%n_errors > 0) &
         call fatal_error(error, exit_deck, 'the refined job (elements of BLOCKS times '// &
                          to_text(refinement%mesh)//') has faults:'//new_line('a')// &
                          render(diagnostics, job%source))
      if (allocated(job%options%team)) call job%options%team%agree(error)
   end subroutine read_refined

   !> Solve all combinations, and note what the round came to
   subroutine solve_round(job, refinement, results, rounds, worst, error)
      !> The job
      type(job_type), intent(inout), target :: job
      !> How it was refined
      type(refinement_type), intent(in) :: refinement
      !> Results of its combinations
      type(results_type), allocatable, intent(out) :: results(:)
      !> One more round
      type(round_type), allocatable, intent(inout) :: rounds(:)
      !> The combination with the largest error, or the first that did not converge
      integer, intent(out) :: worst
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      type(round_type) :: round
      real(wp) :: errors(size(job%model%combinations)), start
      integer :: k

      start = omp_get_wtime()
      worst = 1
      allocate (results(size(job%model%combinations)))
      do k = 1, size(results)
         call solve_combination(job, k, results(k), error)
         if (allocated(error)) exit
         if (results(k)%converged) cycle
         if (.not. allocated(round%failure)) worst = k
         round%failure = 'did not converge'//reason_of(results(k))
      end do
      if (allocated(error)) then
         round%failure = 'could not be solved ('//error%message//')'
      else if (.not. allocated(round%failure)) then
         errors = [(goal_error(job%model, results(k)), k=1, size(results))]
         worst = maxloc(errors, 1)
         round%error = errors(worst)
      end if
      round%mesh = refinement%mesh
      round%nodes = maxval(job%model%mesh%element_size)
      round%harmonic = job%model%max_harmonic
      round%planes = job%model%n_planes
      if (allocated(results(worst)%solves)) &
         round%n_unknowns = sum(results(worst)%solves%n_equations)
      round%seconds = omp_get_wtime() - start
      rounds = [rounds, round]
   end subroutine solve_round

   !> Why a state is no equilibrium, in brackets; nothing if nobody knows
   pure function reason_of(results) result(text)
      !> Results that have not converged
      type(results_type), intent(in) :: results
      !> The words
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      if (.not. allocated(results%remarks)) return
      do k = 1, size(results%remarks)
         if (.not. results%remarks(k)%says_why) cycle
         text = ' ('//results%remarks(k)%text//')'
         return
      end do
   end function reason_of

end module axijoint_job_goal
