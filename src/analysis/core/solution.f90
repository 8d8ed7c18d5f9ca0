!> Displacements of the whole body, harmonic by harmonic
module axijoint_analysis_core_solution
   use omp_lib, only : omp_get_max_threads, omp_get_wtime
   use axijoint_analysis_core_results, only : mode_solve_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_fine_difference, only : difference_type, room_type, &
      find_difference, share_difference
   use axijoint_analysis_fine_level, only : fine_load_type, new_fine_load, share_stiffness
   use axijoint_assembly_equations, only : equations_type, own_modes, solve_system, correct_system, &
                                           expand_mode, find_unbalanced, worth_threads
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, factor_together, hold_factor, &
                                         release_factor, report_failure
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: solve_displacements, solve_states, solved_state_type

   !> Part of the time of a system that its factorization takes where it is solved once
   real(wp), parameter :: factoring = 0.5_wp

   !> A state whose displacements are looked for, with its joints known
   type :: solved_state_type
      !> Its loads
      type(loading_type) :: loading
      !> Excess stress of the joint points that yield, shape (3, points, modes); none if not allocated
      real(wp), allocatable :: excess(:, :, :)
      !> Amplitudes, shape (3, nodes, modes); their extents are there before
      real(wp), allocatable :: displacement(:, :, :)
   end type solved_state_type

   !> Loads, and where their displacements go
   type :: task_type
      !> Loads; none if not associated: then the displacements are a small change of others, and not refined
      type(loading_type), pointer :: loading => null()
      !> Excess stress of the joint points that yield, shape (3, points, modes), of no points if there is none
      real(wp), allocatable :: acting(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), pointer :: displacement(:, :, :) => null()
   end type task_type

contains

   !> Displacements under loads and excess joint stress, and what is asked besides
   subroutine solve_displacements(structure, model, loading, displacement, solves, error, excess, difference, left, effect)
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> The job, for the words of an error
      type(model_type), intent(in) :: model
      !> The loads
      type(loading_type), intent(in), target :: loading
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(out), target :: displacement(:, :, :)
      !> How well each mode was solved
      type(mode_solve_type), allocatable, intent(out) :: solves(:)
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Excess stress of the joint points that yield, shape (3, points, modes); none if left out
      real(wp), intent(in), optional :: excess(:, :, :)
      !> Takes the difference to the solution on the fine level, and times: of linear jobs
      type(difference_type), intent(inout), optional :: difference
      !> A small change of the excess stress, same shape; none if absent or not allocated. Its effect on displacements, amplitudes,
      !> shape (3, nodes, modes, 1), for which no factor is read again
      real(wp), intent(in), optional :: left(:, :, :)
      real(wp), allocatable, intent(out), target, optional :: effect(:, :, :, :)

      type(task_type) :: tasks(2)

      tasks(1)%loading => loading
      tasks(1)%displacement => displacement
      allocate (tasks(1)%acting(3, 0, size(structure%modes)))
      if (present(excess)) tasks(1)%acting = excess
      if (present(left)) then
         allocate (effect(3, size(displacement, 2), size(displacement, 3), 1))
         tasks(2)%displacement => effect(:, :, :, 1)
         tasks(2)%acting = left
      end if
      call solve_tasks(structure, model, tasks(:merge(2, 1, present(left))), solves, error, difference)
   end subroutine solve_displacements

   !> Displacements of several states, for which each factor is read once. No bit of one depends on the others
   subroutine solve_states(structure, model, states, error)
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> The job, for the words of an error
      type(model_type), intent(in) :: model
      !> The states
      type(solved_state_type), intent(inout), target :: states(:)
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      type(mode_solve_type), allocatable :: solves(:)
      type(task_type) :: tasks(size(states))
      integer :: t

      do t = 1, size(states)
         tasks(t)%loading => states(t)%loading
         tasks(t)%displacement => states(t)%displacement
         allocate (tasks(t)%acting(3, 0, size(structure%modes)))
         if (allocated(states(t)%excess)) tasks(t)%acting = states(t)%excess
      end do
      call solve_tasks(structure, model, tasks, solves, error)
   end subroutine solve_states

   !> Displacements of tasks, those of loads first, a step of refinement in these unless the structure takes what rounding
   !> leaves without it. A factor that is not kept is made, used for all that needs it, and given up.
   !> Each rank solves its systems, and learns the rest. The stiffness of the fine level, which one rank forms for all,
   !> is told when all have solved their first system: none waits for it long.
   subroutine solve_tasks(structure, model, tasks, solves, error, difference)
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> The job, for the words of an error
      type(model_type), intent(in) :: model
      !> Loads and their displacements
      type(task_type), intent(inout) :: tasks(:)
      !> How well each mode was solved, for the first of them
      type(mode_solve_type), allocatable, intent(out) :: solves(:)
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Takes the difference to the solution on the fine level, of the first of them, and times
      type(difference_type), intent(inout), optional :: difference

      type(fine_load_type) :: load
      type(workspace_type), allocatable :: spaces(:)
      type(room_type), allocatable :: rooms(:)
      real(wp) :: times(4, size(structure%equations%systems)), together  ! that of all threads
      integer :: t

      allocate (solves(size(structure%modes)))
      if (present(difference)) load = new_fine_load(structure%fine, structure%modes, tasks(1)%loading)
      call new_workspaces(structure%equations, spaces)
      allocate (rooms(size(spaces)))
      times = 0.0_wp
      together = 0.0_wp
      associate (equations => structure%equations)
         if (present(difference) .and. (size(spaces) > 1 .or. equations%last < equations%first)) &
            call share_stiffness(structure%fine, equations%team, error)
         if (allocated(error)) return
         if (size(spaces) == 1) then
            call solve_in_order()
         else
            call solve_by_threads()
         end if
         if (present(difference)) then
            difference%seconds = sum(times(3, :))/size(spaces)
            difference%factor_share = (together + sum(times(2, :) - times(1, :)))/max(tiny(1.0_wp), &
               together + sum(times(4, :) - times(1, :)))
         end if
         if (.not. allocated(error)) call report_failure(equations, model, error)
         if (allocated(error)) return
         do t = 1, size(tasks)
            call equations%team%gather(tasks(t)%displacement, size(tasks(t)%displacement, kind=i8), equations%last_mode)
         end do
         call share_solves(equations, solves)
         if (present(difference)) call share_difference(equations, difference)
      end associate

   contains

      !> Solve one system after the other; other threads take the tasks that it leaves
      subroutine solve_in_order()
         integer :: n_threads, s

         n_threads = merge(omp_get_max_threads(), 1, worth_threads(structure%equations))
         !$omp parallel num_threads(n_threads)
         !$omp master
         do s = structure%equations%first, structure%equations%last
            if (.not. allocated(error)) call solve_one(s)
         end do
         !$omp end master
         !$omp end parallel
      end subroutine solve_in_order

      !> Solve as many at once as there are threads. One that all have factored together comes first, as each thread holds one factor
      subroutine solve_by_threads()
         integer :: i, s
         logical :: made

         associate (first => structure%equations%first, last => structure%equations%last)
            together = omp_get_wtime()
            call factor_together(structure%equations, last, factoring, spaces(1), size(spaces), made)
            together = merge(size(spaces)*(omp_get_wtime() - together), 0.0_wp, made)
            !$omp parallel do schedule(dynamic) num_threads(size(spaces)) private(s)
            do i = first, last
               s = i
               if (made) s = merge(last, i - 1, i == first)
               call solve_one(s)
            end do
            !$omp end parallel do
         end associate
      end subroutine solve_by_threads

      !> Solve one system
      subroutine solve_one(s)
         !> Its place
         integer, intent(in) :: s

         real(wp), allocatable :: force(:, :, :), found(:, :, :)  ! threads have small stacks
         type(mode_solve_type), allocatable :: reports(:)
         real(wp) :: before_errors
         integer :: n

         times(1, s) = omp_get_wtime()
         call hold_factor(structure%equations, s, spaces(own()))
         times(2, s) = omp_get_wtime()
         associate (equations => structure%equations)
            if (.not. equations%systems(s)%failed) then
               allocate (force(3, size(tasks(1)%displacement, 2), size(equations%systems(s)%modes)*size(tasks)))
               allocate (found, mold=force)
               n = size(equations%systems(s)%modes)*count([(associated(tasks(t)%loading), t=1, size(tasks))])
               allocate (reports(n))
               call load_system(structure, tasks, s, force)
               call solve_system(equations, s, force, found)
               call refine_solutions(equations, s, force(:, :, :n), structure%negligible, found(:, :, :n), reports)
               call take_solution(structure, tasks, s, found)
               solves(equations%systems(s)%modes) = reports(:size(equations%systems(s)%modes))
               deallocate (force, found)
            end if
            if (present(difference) .and. size(spaces) == 1) call share_stiffness(structure%fine, equations%team, error)
            if (.not. (equations%systems(s)%failed .or. allocated(error))) then
               before_errors = omp_get_wtime()
               if (present(difference)) then
                  call find_difference(structure%fine, equations, s, load, tasks(1)%displacement, &
                     structure%condensed%points(:size(tasks(1)%acting, 2)), tasks(1)%acting, rooms(own()), difference)
               end if
               times(3, s) = omp_get_wtime() - before_errors
               call release_factor(equations, s, spaces(own()))
            end if
         end associate
         times(4, s) = omp_get_wtime()
      end subroutine solve_one

   end subroutine solve_tasks

   !> Forces of all tasks, mode by mode
   subroutine load_system(structure, tasks, s, force)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Loads
      type(task_type), intent(in) :: tasks(:)
      !> Place of the system
      integer, intent(in) :: s
      !> Forces on components, shape (3, nodes, modes of the system times tasks)
      real(wp), intent(out) :: force(:, :, :)

      integer :: i, j, k, t

      associate (modes => structure%equations%systems(s)%modes)
         j = 0
         do t = 1, size(tasks)
            associate (points => structure%condensed%points(:size(tasks(t)%acting, 2)))
               do i = 1, size(modes)
                  j = j + 1
                  k = modes(i)
                  force(:, :, j) = joint_force(points, structure%equations%modes(k)%harmonic, tasks(t)%acting(:, :, k), &
                     size(force, 2))
                  if (associated(tasks(t)%loading)) force(:, :, j) = tasks(t)%loading%right(:, :, k) + force(:, :, j)
               end do
            end associate
         end do
      end associate
   end subroutine load_system

   !> Displacements of all tasks from those of the unknowns
   subroutine take_solution(structure, tasks, s, found)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Takes the displacements
      type(task_type), intent(inout) :: tasks(:)
      !> Place of the system
      integer, intent(in) :: s
      !> The displacements without those of held components, shape (3, nodes, modes of the system times tasks)
      real(wp), intent(in) :: found(:, :, :)

      integer :: i, j, k, t

      associate (modes => structure%equations%systems(s)%modes)
         j = 0
         do t = 1, size(tasks)
            associate (displacement => tasks(t)%displacement)
               do i = 1, size(modes)
                  j = j + 1
                  k = modes(i)
                  displacement(:, :, k) = found(:, :, j)
                  if (.not. associated(tasks(t)%loading)) cycle
                  if (allocated(tasks(t)%loading%held)) displacement(:, :, k) = displacement(:, :, k) &
                     + tasks(t)%loading%held(:, :, k)
               end do
            end associate
         end do
      end associate
   end subroutine take_solution

   !> Let all ranks know how well all modes were solved
   subroutine share_solves(equations, solves)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The reports; those of the modes of this rank are there
      type(mode_solve_type), intent(inout) :: solves(:)

      real(wp) :: found(5, size(solves))
      integer :: k, own(2)

      found = 0.0_wp
      own = own_modes(equations)
      do k = own(1), own(2)
         associate (class => equations%systems(equations%system(k))%class)
            found(:, k) = [solves(k)%smallest_pivot, solves(k)%backward_error, solves(k)%correction, &
                           solves(k)%condition, real(equations%plans(class)%solver%factor_entries, wp)]
         end associate
      end do
      call equations%team%gather(found, size(found, kind=i8), equations%last_mode)
      do k = 1, size(solves)
         associate (class => equations%systems(equations%system(k))%class)
            solves(k) = mode_solve_type(equations%modes(k), &
               equations%classes(class)%dofs%n_equations, nint(found(5, k), i8), found(1, k), &
               found(2, k), found(3, k), found(4, k))
         end associate
      end do
   end subroutine share_solves

   !> Refine solutions of a system, and see how well its equations are solved. A backward error is
   !> a relative change of the data, which the condition number passes on at most: where that is
   !> negligible, it stands for the correction that is not made
   subroutine refine_solutions(equations, s, force, negligible, displacement, reports)
      !> The equations
      type(equations_type), intent(inout) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> Forces on components: of the modes of the system, once or some times. Shape (3, nodes, any)
      real(wp), intent(in) :: force(:, :, :)
      !> What rounding may leave without refinement, over the largest displacement
      real(wp), intent(in) :: negligible
      !> Displacement amplitudes, same shape
      real(wp), intent(inout) :: displacement(:, :, :)
      !> The reports, one a solution; after the first of each mode, the backward error is that before the correction
      type(mode_solve_type), intent(out) :: reports(:)

      real(wp), allocatable :: unbalanced(:), correction(:, :)
      real(wp) :: left
      integer :: i

      associate (system => equations%systems(s))
         associate (mode => [(system%modes(modulo(i - 1, size(system%modes)) + 1), i=1, size(reports))])
            do i = 1, size(reports)
               call find_unbalanced(equations, mode(i), force(:, :, i), displacement(:, :, i), unbalanced, &
                  reports(i)%backward_error)
               if (i == 1) allocate (correction(size(unbalanced), size(reports)))
               correction(:, i) = unbalanced
            end do
            if (system%condition < 0.0_wp .or. any(reports%backward_error*system%condition > negligible)) &
               call correct_system(equations, s, correction)
            do i = 1, size(reports)
               reports(i)%smallest_pivot = system%pivots%smallest
               reports(i)%condition = system%condition
               left = reports(i)%backward_error*system%condition
               if (left <= negligible) then
                  reports(i)%correction = left*maxval(abs(displacement(:, :, i)))
               else
                  reports(i)%correction = maxval([0.0_wp, abs(correction(:, i))])
                  displacement(:, :, i) = displacement(:, :, i) + expand_mode(equations, mode(i), correction(:, i))
                  if (i <= size(system%modes)) call find_unbalanced(equations, mode(i), force(:, :, i), &
                     displacement(:, :, i), unbalanced, reports(i)%backward_error)
               end if
            end do
         end associate
      end associate
   end subroutine refine_solutions

end module axijoint_analysis_core_solution
