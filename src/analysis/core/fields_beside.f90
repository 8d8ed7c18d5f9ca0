!> Fields at the ends of increments, found by threads beside the iterations: these share too little for more than one
module axijoint_analysis_core_fields_beside
   use omp_lib, only : omp_get_max_threads, omp_set_num_threads
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_footprint, only : held_numbers
   use axijoint_analysis_core_increment_fields, only : solve_increments, recover_state
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_solution, only : solved_state_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_error, only : error_type
   use axijoint_base_progress, only : progress_type
   use axijoint_joints_history, only : history_type
   use axijoint_joints_increments, only : run_increments
   use axijoint_joints_keeper, only : keeper_type
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type, is_shown, shows_stress
   implicit none
   private
   public :: run_and_find

   !> States whose displacements are found at once, at most
   integer, parameter :: at_once = 4

   !> The ends of a history's increments
   type :: ends_type
      !> The job, and the structure, whose factors are kept
      type(model_type), pointer :: model => null()
      type(structure_type), pointer :: structure => null()
      !> The increments whose fields are wanted, as far as these are not found; number 0 elsewhere
      type(increment_state_type), allocatable :: asked(:)
      !> The fields, none yet where displacements are not allocated
      type(fields_type), allocatable :: found(:)
      !> Whether a thread is at it
      logical :: busy = .false.
   end type ends_type

   !> Who asks for them, and tells another keeper of every step
   type, extends(keeper_type) :: asking_type
      class(keeper_type), pointer :: other => null()
      type(ends_type), pointer :: ends => null()
   contains
      procedure :: restore
      procedure :: keep
   end type asking_type

contains

   !> Run the increments; if threads can, find the fields at their ends beside that. No bit of either depends on it
   subroutine run_and_find(model, structure, combination, history, results, progress, keeper)
      !> The job
      type(model_type), intent(in), target :: model
      !> The structure, factored and condensed
      type(structure_type), intent(inout), target :: structure
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> What the increments came to
      type(history_type), intent(out) :: history
      !> Takes the fields, of as many increments as they were found of
      type(results_type), intent(inout) :: results
      !> Where to show progress
      type(progress_type), intent(inout) :: progress
      !> Who keeps what the increments come to
      class(keeper_type), intent(inout), optional, target :: keeper

      type(ends_type), target :: ends
      type(asking_type) :: asking
      integer :: n_threads

      if (.not. beside(model, structure, present(keeper))) then
         call run(keeper)
         return
      end if
      ends%model => model
      ends%structure => structure
      allocate (ends%asked(size(model%increments)), ends%found(size(model%increments)))
      asking%other => keeper
      asking%ends => ends
      n_threads = omp_get_max_threads()
      !$omp parallel  ! of all threads: a smaller team would end the others
      !$omp master
      call omp_set_num_threads(1)
      call run(asking)
      call omp_set_num_threads(n_threads)
      !$omp end master
      !$omp end parallel
      call move_alloc(ends%found, results%earlier)

   contains

      !> Run the increments
      subroutine run(keeper)
         !> Who is told of every step
         class(keeper_type), intent(inout), optional :: keeper

         call run_increments(model, structure%equations, structure%condensed, structure%joint_points, &
                             structure%support_points, combination, history, progress, keeper, structure%answer)
      end subroutine run

   end subroutine run_and_find

   !> Whether fields are found beside the iterations: where those of more increments than the last will be shown, threads and
   !> joint points are few, and this process keeps all factors
   logical function beside(model, structure, shown)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Whether fields will be shown
      logical, intent(in) :: shown

      beside = .false.
      if (.not. shown) return
      beside = held_numbers(model, size(structure%modes), size(structure%condensed%points)) > 0
      associate (equations => structure%equations)
         beside = beside .and. equations%team%size == 1 .and. equations%solver%concurrent &
            .and. equations%n_kept == size(equations%systems)
      end associate
   end function beside

   !> Bring a history to where it was kept
   subroutine restore(self, history, restored, error)
      !> Who asks
      class(asking_type), intent(inout) :: self
      !> The history, new
      type(history_type), intent(inout) :: history
      !> Whether there was something to restore
      logical, intent(out) :: restored
      !> What was kept is of another structure
      type(error_type), allocatable, intent(out) :: error

      call self%other%restore(history, restored, error)
   end subroutine restore

   !> A step came to equilibrium. At the end of an increment its fields are asked for
   subroutine keep(self, history)
      !> Who asks
      class(asking_type), intent(inout) :: self
      !> The history
      type(history_type), intent(in) :: history

      type(ends_type), pointer :: ends
      integer :: k

      call self%other%keep(history)
      ends => self%ends
      k = history%increment
      if (size(history%ahead) > 0 .or. k == size(ends%found)) return
      if (.not. is_shown(ends%model, k, size(ends%found))) return
      !$omp critical (axijoint_fields_beside)
      ends%asked(k) = history%states(size(history%states))
      !$omp end critical (axijoint_fields_beside)
      ! for a thread of the team that waits for the end of the increments: no iteration waits for tasks of this one
      !$omp task default(shared) firstprivate(ends)
      call find(ends)
      !$omp end task
   end subroutine keep

   !> Find the fields that are asked for, unless another thread is at it, which will then take these, too
   subroutine find(ends)
      !> The ends
      type(ends_type), intent(inout) :: ends

      type(increment_state_type), allocatable :: states(:)
      integer, allocatable :: places(:)
      integer :: k

      do
         !$omp critical (axijoint_fields_beside)
         places = pack([(k, k=1, size(ends%asked))], ends%asked%increment > 0 .and. .not. ends%busy)
         places = places(:min(at_once, size(places)))
         ends%busy = ends%busy .or. size(places) > 0
         states = ends%asked(places)
         ends%asked(places) = increment_state_type()
         !$omp end critical (axijoint_fields_beside)
         if (size(places) == 0) return
         call find_states(ends, states)
         !$omp critical (axijoint_fields_beside)
         ends%busy = .false.
         !$omp end critical (axijoint_fields_beside)
      end do
   end subroutine find

   !> Find the fields of states
   subroutine find_states(ends, states)
      !> The ends
      type(ends_type), intent(inout) :: ends
      !> The states
      type(increment_state_type), intent(in) :: states(:)

      type(solved_state_type), allocatable :: solved(:)
      type(error_type), allocatable :: error
      integer :: i

      allocate (solved(size(states)))
      call solve_increments(ends%model, ends%structure, states, [(i, i=1, size(states))], solved, error)
      if (allocated(error)) return  ! who shows them will know
      do i = 1, size(states)
         !$omp task default(shared) firstprivate(i)
         call recover_end(ends, states(i), solved(i))
         !$omp end task
      end do
      !$omp taskwait
   end subroutine find_states

   !> Find the fields of a state from its displacements; what no file shows of them is not held
   subroutine recover_end(ends, state, solved)
      !> The ends; take the fields
      type(ends_type), intent(inout) :: ends
      !> The state
      type(increment_state_type), intent(in) :: state
      !> Its displacements
      type(solved_state_type), intent(inout) :: solved

      logical :: smoothed

      smoothed = shows_stress(ends%model, state%increment, size(ends%found))
      associate (fields => ends%found(state%increment))
         call recover_state(ends%model, ends%structure, state, ends%structure%planes%angle, solved, fields, smoothed)
         if (.not. smoothed) deallocate (fields%stress, fields%point_element, fields%point_position)
      end associate
   end subroutine recover_end

end module axijoint_analysis_core_fields_beside
