!> What the approximations leave of the error of a job whose bodies yield. Its last state is found
!> again without its history, all loads in a single step: as it is, on more planes, with more
!> harmonics, on a finer mesh. Loads are compared at the same displacement, which says something at
!> the limit load, too
module axijoint_analysis_error_plastic_errors
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type, build_equations
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_analysis_core_yield_errors, only : yield_errors_type, yield_share_type, sum_of_yield_shares, &
      loses_displacement, yield_mesh, yield_harmonics, yield_planes, yield_iteration
   use axijoint_analysis_error_plastic_variants, only : take_more_planes, take_more_harmonics, &
      take_fewer_harmonics, mesh_harmonics
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, prolong
   use axijoint_analysis_fine_whole_model, only : new_whole_model
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_base_error, only : error_type, exit_memory
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_joints_load_steps, only : loads_of_increments
   use axijoint_joints_residual, only : ratio
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, can_yield
   use axijoint_model_modes, only : highest_loaded
   use axijoint_plastic_single_step, only : single_load_type, single_state_type, single_step
   implicit none
   private
   public :: estimate_plastic_errors, turns_back

   !> The error over the change: of limit loads, which converge like the size of the elements, what
   !> half of it changes is half of the error; of harmonics, whose error goes like 1/M^2, what twice
   !> as many change is 3/4 of it
   real(wp), parameter :: error_over_change(3) = [2.0_wp, 4.0_wp/3.0_wp, 1.0_wp]
   !> Least error of a mesh that is told: states on two meshes may agree by chance, as zones that yield do not grow steadily
   !> from mesh to mesh, and states are found no better
   real(wp), parameter :: least_told = 5.0e-4_wp
   !> Cosine of the angle between two loads below which one takes back what the other did
   real(wp), parameter :: against = -0.5_wp
   !> What was on before, over what is on then, that is worth no word if it is taken back
   real(wp), parameter :: slight = 0.05_wp
   !> Load, over that of the state, by which one found in one step may be off without a word
   real(wp), parameter :: least_other_way = 0.02_wp

contains

   !> Estimate all errors
   subroutine estimate_plastic_errors(model, structure, combination, results, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> Results with displacements of the last equilibrium; takes the errors
      type(results_type), intent(inout) :: results
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(single_load_type) :: loads
      type(single_state_type) :: base, planes
      real(wp) :: start

      start = omp_get_wtime()
      associate (errors => results%yield_errors, shares => results%yield_errors%shares)
         call last_loads(model, results%states, loads)
         errors%loaded = allocated(loads%steered)
         shares(yield_iteration)%load = results%residual_ratio
         associate (last => results%states(size(results%states))%increment)
            errors%turned_back = turns_back(model, combination, last)
            if (.not. errors%turned_back) errors%turned_back = opposed(model, structure, combination, last)
         end associate
         errors%at_limit = .not. (results%converged .or. allocated(loads%moved) .or. errors%loaded)
         if (errors%turned_back .or. errors%at_limit) return
         call show_progress(progress, 'estimating errors of bodies that yield')
         call find(model, structure, loads, results%displacement, base)
         if (base%found) then
            call by_planes(model, structure, loads, base, planes, shares(yield_planes))
            call by_harmonics(model, structure, loads, planes, shares(yield_harmonics), progress)
            call by_mesh(model, structure, loads, base, shares(yield_mesh), progress)
         end if
         if (base%found .and. errors%loaded) call judge_way(loads, base, errors)
         if (errors%loaded .and. .not. loses_displacement(errors)) &
            call find_moved(errors%softness, shares)
         errors%seconds = omp_get_wtime() - start
      end associate
   end subroutine estimate_plastic_errors

   !> Forget what is known of the errors if the state is another one than that found in one step by more than these: the order of
   !> the loads made it, of which a single step knows nothing
   pure subroutine judge_way(loads, base, errors)
      !> The loads, steered
      type(single_load_type), intent(in) :: loads
      !> The state found in one step
      type(single_state_type), intent(in) :: base
      !> The errors
      type(yield_errors_type), intent(inout) :: errors

      type(yield_share_type) :: total

      total = sum_of_yield_shares(errors)
      errors%other_way = ratio(abs(base%value - loads%factor), abs(loads%factor))
      if (errors%other_way <= max(least_other_way, total%load)) then
         errors%other_way = 0.0_wp
         return
      end if
      errors%shares(:yield_iteration - 1)%load = -1.0_wp
      errors%shares(:yield_iteration - 1)%displacement = -1.0_wp
   end subroutine judge_way

   !> Whether loads of an increment are against those before it, if not those of the same load case: forces on the nodes together,
   !> or displacements that are given
   logical function opposed(model, structure, combination, last)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Factors of its load cases
      type(combination_type), intent(in) :: combination
      !> Increments that were begun
      integer, intent(in) :: last

      type(increment_state_type) :: steps(size(model%increments))
      type(loading_type) :: before, added
      integer :: i

      opposed = .false.
      if (size(model%load_cases) == 1) return
      steps = loads_of_increments(model, combination)
      do i = 2, last
         associate (change => steps(i)%case_factor - steps(i - 1)%case_factor)
            if (.not. any(abs(change) > 0.0_wp)) cycle
            before = loads_of(steps(i - 1)%case_factor)
            added = loads_of(change)
         end associate
         if (norm2(before%right) > slight*norm2(before%right + added%right)) &
            opposed = opposed .or. cosine(before%right, added%right) < against
         if (allocated(before%held)) opposed = opposed .or. any(before%held*added%held < 0.0_wp)
      end do

   contains

      !> Loads of some factors of the load cases
      function loads_of(factor) result(loading)
         !> The factors
         real(wp), intent(in) :: factor(:)
         !> The loads
         type(loading_type) :: loading

         call new_loading(model, structure%joint_points, structure%support_points, structure%modes, &
            structure%equations%unit_loads, combination_type(0, factor), loading)
      end function loads_of

   end function opposed

   !> Cosine of the angle between two sets of forces; zero if there are none
   pure real(wp) function cosine(a, b)
      !> The forces, shape (3, nodes, modes)
      real(wp), intent(in) :: a(:, :, :), b(:, :, :)

      cosine = sum(a*b)
      if (abs(cosine) > 0.0_wp) cosine = cosine/(norm2(a)*norm2(b))
   end function cosine

   !> What the displacement of the loads changes if these are kept the same
   pure subroutine find_moved(softness, shares)
      !> Growth of the displacement with the load, over that of both so far
      real(wp), intent(in) :: softness
      !> Errors while the displacement is the same
      type(yield_share_type), intent(inout) :: shares(:)

      where (shares%load >= 0.0_wp) shares%displacement = softness*shares%load
   end subroutine find_moved

   !> Whether loads are taken back on the way: what stays then of plastic strain no single step knows
   pure logical function turns_back(model, combination, last)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of its load cases
      type(combination_type), intent(in) :: combination
      !> Increments that were begun; all if absent
      integer, intent(in), optional :: last

      type(increment_state_type) :: steps(size(model%increments))
      integer :: i, n

      steps = loads_of_increments(model, combination)
      n = size(steps)
      if (present(last)) n = last
      turns_back = .false.
      do i = 2, n
         associate (now => steps(i)%case_factor, before => steps(i - 1)%case_factor)
            turns_back = turns_back .or. any(now*before < 0.0_wp .or. abs(now) < abs(before))
         end associate
      end do
   end function turns_back

   !> What the last state is under, and what of it the last increment changed
   pure subroutine last_loads(model, states, loads)
      !> The job
      type(model_type), intent(in) :: model
      !> States at the ends of the increments
      type(increment_state_type), intent(in) :: states(:)
      !> Takes the loads
      type(single_load_type), intent(out) :: loads

      real(wp), allocatable :: change(:)
      logical, allocatable :: changes(:)
      integer :: n

      associate (total => states(size(states))%case_factor)
         change = total
         do n = size(states) - 1, 1, -1
            if (.not. any(abs(total - states(n)%case_factor) > 0.0_wp)) cycle
            change = total - states(n)%case_factor
            exit
         end do
         loads%given = total
         changes = abs(change) > 0.0_wp
         if (any(changes(model%prescribed%case))) then
            loads%moved = change
         else if (.not. any([changes(model%thermal_loads%case), &
                             changes(model%initial_stresses%case)]) .and. any(changes) &
            .and. .not. can_yield(model)) then  ! load factors are not found beside joints
            loads%steered = change
            loads%factor = dot_product(total, change)/dot_product(change, change)
            loads%given = total - loads%factor*change
         end if
      end associate
   end subroutine last_loads

   !> Find the state on a structure
   subroutine find(model, structure, loads, start, state, beside)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(inout), target :: structure
      !> Its loads
      type(single_load_type), intent(in) :: loads
      !> Displacements to begin with, shape (3, nodes, modes)
      real(wp), intent(in) :: start(:, :, :)
      !> The state
      type(single_state_type), intent(out) :: state
      !> The state that it is compared with, whose displacements it begins with, if there is one
      type(single_state_type), intent(in), optional :: beside

      real(wp), allocatable :: reference

      if (present(beside)) then
         reference = 0.0_wp  ! of what changed of the displacements
         if (allocated(loads%moved) .or. allocated(loads%steered)) reference = beside%value
      end if
      call single_step(model, structure%equations, structure%condensed, structure%joint_points, &
         structure%support_points, loads, start, state, reference)
   end subroutine find

   !> Twice as many intervals between planes
   subroutine by_planes(model, structure, loads, base, finer, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(inout) :: structure
      !> Its loads
      type(single_load_type), intent(in) :: loads
      !> That on the planes of the job, and on more
      type(single_state_type), intent(in) :: base
      type(single_state_type), intent(out) :: finer
      !> Takes the error
      type(yield_share_type), intent(inout) :: error

      type(model_type) :: denser
      call take_more_planes(model, denser)
      if (.not. base%found) return
      call find(denser, structure, loads, base%displacement, finer, base)
      call compare(loads, structure%modes, base, finer, finer%displacement - base%displacement, &
         error_over_change(yield_planes), error)
   end subroutine by_planes

   !> Twice as many harmonics and one more
   subroutine by_harmonics(model, structure, loads, base, error, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(in) :: structure
      !> Its loads
      type(single_load_type), intent(in) :: loads
      !> That with the harmonics of the job, on more planes
      type(single_state_type), intent(in) :: base
      !> Takes the error
      type(yield_share_type), intent(inout) :: error
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(model_type) :: richer
      type(structure_type) :: larger
      type(single_state_type) :: state
      type(error_type), allocatable :: failure

      if (highest_loaded(model) == 0) then
         error%load = 0.0_wp
         if (.not. (allocated(loads%moved) .or. allocated(loads%steered))) error%displacement = 0.0_wp
         return
      end if
      if (.not. base%found) return
      call take_more_harmonics(model, richer)
      call build_equations(richer, larger, progress, failure)
      if (left_out(failure, error)) return
      call find(richer, larger, loads, in_modes(base%displacement, structure%modes, larger%modes), &
         state, base)
      call compare(loads, larger%modes, base, state, &
         state%displacement - in_modes(base%displacement, structure%modes, larger%modes), &
         error_over_change(yield_harmonics), error)
   end subroutine by_harmonics

   !> Elements half as large, with a few harmonics
   subroutine by_mesh(model, structure, loads, base, error, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(in) :: structure
      !> Its loads
      type(single_load_type), intent(in) :: loads
      !> That on the mesh of the job
      type(single_state_type), intent(in) :: base
      !> Takes the error
      type(yield_share_type), intent(inout) :: error
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      integer :: first, second

      call mesh_harmonics(model, allocated(loads%moved) .or. allocated(loads%steered), first, second)
      call compare_meshes(model, structure, loads, base, first, error, progress)
      if (max(error%load, error%displacement) < 0.0_wp .and. first /= second) &
         call compare_meshes(model, structure, loads, base, second, error, progress)
      if (error%load >= 0.0_wp) error%load = max(error%load, least_told)
      if (error%displacement >= 0.0_wp) error%displacement = max(error%displacement, least_told)
   end subroutine by_mesh

   !> Elements half as large, with harmonics up to some
   subroutine compare_meshes(model, structure, loads, base, highest, error, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(in) :: structure
      !> Its loads
      type(single_load_type), intent(in) :: loads
      !> That on the mesh of the job
      type(single_state_type), intent(in) :: base
      !> Highest harmonic
      integer, intent(in) :: highest
      !> Takes the error
      type(yield_share_type), intent(inout) :: error
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(model_type) :: plain, finer
      type(structure_type) :: fine
      type(fine_mesh_type) :: mesh
      type(single_state_type) :: before, after
      type(error_type), allocatable :: failure

      call take_fewer_harmonics(model, highest, plain)
      if (model%max_harmonic > highest) then
         call find_plain(plain, structure, loads, base, before, failure, progress)
         if (left_out(failure, error)) return
      else
         before = base
      end if
      if (.not. before%found) return
      call new_whole_model(plain, mesh, finer)
      call build_equations(finer, fine, progress, failure)
      if (left_out(failure, error)) return
      call find(finer, fine, loads, on_fine(mesh, before%displacement), after, before)
      associate (n => size(before%displacement, 2))  ! between nodes shape functions differ, too
         call compare(loads, fine%modes, before, after, &
            after%displacement(:, :n, :) - before%displacement, &
            error_over_change(yield_mesh), error)
      end associate
   end subroutine compare_meshes

   !> The state on the mesh of the job with fewer harmonics
   subroutine find_plain(plain, structure, loads, base, state, failure, progress)
      !> The job with fewer harmonics
      type(model_type), intent(in) :: plain
      !> The structure of the job
      type(structure_type), intent(in) :: structure
      !> Its loads
      type(single_load_type), intent(in) :: loads
      !> The state with all harmonics
      type(single_state_type), intent(in) :: base
      !> The state
      type(single_state_type), intent(out) :: state
      !> Out of memory
      type(error_type), allocatable, intent(out) :: failure
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(structure_type) :: coarse

      call build_equations(plain, coarse, progress, failure)
      if (allocated(failure)) return
      call find(plain, coarse, loads, in_modes(base%displacement, structure%modes, coarse%modes), &
         state)
   end subroutine find_plain

   !> Whether a source is left out because its equations could not be made; notes a lack of memory
   logical function left_out(failure, error)
      !> Why, if they could not
      type(error_type), allocatable, intent(in) :: failure
      !> The error; takes the reason
      type(yield_share_type), intent(inout) :: error

      left_out = allocated(failure)
      if (left_out) error%no_memory = failure%code == exit_memory
   end function left_out

   !> Displacements in other modes
   pure function in_modes(displacement, modes, others) result(moved)
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Their modes, and those wanted
      type(mode_type), intent(in) :: modes(:), others(:)
      !> Amplitudes, shape (3, nodes, others); zero in modes that there are none of
      real(wp), allocatable :: moved(:, :, :)

      integer :: i, k

      allocate (moved(3, size(displacement, 2), size(others)), source=0.0_wp)
      do k = 1, size(others)
         do i = 1, size(modes)
            if (same_mode(modes(i), others(k))) moved(:, :, k) = displacement(:, :, i)
         end do
      end do
   end function in_modes

   !> Displacements on the fine mesh
   pure function on_fine(mesh, displacement) result(fine)
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: mesh
      !> Amplitudes on the coarse one, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> On the fine one
      real(wp), allocatable :: fine(:, :, :)

      integer :: k

      allocate (fine(3, n_nodes(mesh%mesh), size(displacement, 3)))
      do k = 1, size(displacement, 3)
         call prolong(mesh%parents, displacement(:, :, k), fine(:, :, k))
      end do
   end function on_fine

   !> The error from two states
   subroutine compare(loads, modes, before, after, change, times, error)
      !> What was found
      type(single_load_type), intent(in) :: loads
      !> Modes of the change
      type(mode_type), intent(in) :: modes(:)
      !> The states
      type(single_state_type), intent(in) :: before, after
      !> Change of the displacements, shape (3, nodes, modes)
      real(wp), intent(in) :: change(:, :, :)
      !> The error over the change
      real(wp), intent(in) :: times
      !> The error
      type(yield_share_type), intent(inout) :: error

      if (.not. (before%found .and. after%found)) return
      if (allocated(loads%moved) .or. allocated(loads%steered)) then
         error%load = times*ratio(abs(after%value - before%value), abs(after%value))
      else
         error%displacement = times*ratio(largest_vector(modes, change), &
            largest_vector(modes, after%displacement))
      end if
   end subroutine compare

end module axijoint_analysis_error_plastic_errors
