!> What the approximations leave of the error of a job whose bodies yield. Its last state is found
!> again without its history, all loads in a single step: as it is, on more planes, with more
!> harmonics, on a finer mesh. Loads are compared at the same displacement, which says something at
!> the limit load, too
module axijoint_analysis_error_plastic_errors
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type, build_equations
   use axijoint_analysis_core_yield_errors, only : yield_share_type, loses_displacement, &
      yield_mesh, yield_harmonics, yield_planes, yield_iteration
   use axijoint_analysis_error_largest_values, only : largest_vector
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, prolong
   use axijoint_analysis_fine_whole_model, only : new_whole_model
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type, show_progress
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_joints_load_steps, only : loads_of_increments
   use axijoint_joints_residual, only : ratio
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, can_yield
   use axijoint_model_modes, only : used_modes, highest_loaded
   use axijoint_plastic_methods, only : body_control_type
   use axijoint_plastic_single_step, only : single_load_type, single_state_type, single_step
   implicit none
   private
   public :: estimate_plastic_errors, turns_back, few

   !> The error over the change: of limit loads, which converge like the size of the elements, what
   !> half of it changes is half of the error; of harmonics, whose error goes like 1/M^2, what twice
   !> as many change is 3/4 of it
   real(wp), parameter :: error_over_change(3) = [2.0_wp, 4.0_wp/3.0_wp, 1.0_wp]
   !> Residual ratio of the states that are compared, what does if they come no nearer, and most
   !> elastic solutions of each
   real(wp), parameter :: tolerance = 1.0e-4_wp, loose = 1.0e-3_wp
   integer, parameter :: most = 1500
   !> Harmonics that are enough to see what the mesh leaves
   integer, parameter :: few = 3

   !> The state that is found again
   type :: case_type
      !> Loads
      type(single_load_type) :: loads
      !> Whether displacements are given: forces are what holds them then
      logical :: held = .false.
   end type case_type

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

      type(case_type) :: job
      type(single_state_type) :: base, planes
      real(wp) :: start

      start = omp_get_wtime()
      associate (errors => results%yield_errors, shares => results%yield_errors%shares)
         call last_loads(model, results%states, job)
         errors%loaded = allocated(job%loads%steered)
         shares(yield_iteration)%load = results%residual_ratio
         errors%turned_back = turns_back(model, combination)
         if (errors%turned_back) return
         call show_progress(progress, 'estimating errors of bodies that yield')
         call find(model, structure, job, results%displacement, base)
         if (base%balanced) then
            call by_planes(model, structure, job, base, planes, shares(yield_planes))
            call by_harmonics(model, structure, job, planes, shares(yield_harmonics), progress)
            call by_mesh(model, structure, job, base, shares(yield_mesh), progress)
         end if
         if (errors%loaded .and. .not. loses_displacement(errors)) &
            call find_moved(errors%softness, shares)
         errors%seconds = omp_get_wtime() - start
      end associate
   end subroutine estimate_plastic_errors

   !> What the displacement of the loads changes if these are kept the same
   pure subroutine find_moved(softness, shares)
      !> Growth of the displacement with the load, over that of both so far
      real(wp), intent(in) :: softness
      !> Errors while the displacement is the same
      type(yield_share_type), intent(inout) :: shares(:)

      where (shares%load >= 0.0_wp) shares%displacement = softness*shares%load
   end subroutine find_moved

   !> Whether loads are taken back on the way: what stays then of plastic strain no single step knows
   pure logical function turns_back(model, combination)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of its load cases
      type(combination_type), intent(in) :: combination

      type(increment_state_type) :: steps(size(model%increments))
      integer :: i

      steps = loads_of_increments(model, combination)
      turns_back = .false.
      do i = 2, size(steps)
         associate (now => steps(i)%case_factor, before => steps(i - 1)%case_factor)
            turns_back = turns_back .or. any(now*before < 0.0_wp .or. abs(now) < abs(before))
         end associate
      end do
   end function turns_back

   !> What the last state is under, and what of it the last increment changed
   pure subroutine last_loads(model, states, job)
      !> The job
      type(model_type), intent(in) :: model
      !> States at the ends of the increments
      type(increment_state_type), intent(in) :: states(:)
      !> Takes the loads
      type(case_type), intent(out) :: job

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
         job%loads%given = total
         changes = abs(change) > 0.0_wp
         if (any(changes(model%prescribed%case))) then
            job%held = .true.
         else if (.not. any([changes(model%thermal_loads%case), &
                             changes(model%initial_stresses%case)]) .and. any(changes) &
            .and. .not. can_yield(model)) then  ! load factors are not found beside joints
            job%loads%steered = change
            job%loads%factor = dot_product(total, change)/dot_product(change, change)
            job%loads%given = total - job%loads%factor*change
         end if
      end associate
   end subroutine last_loads

   !> Find the state on a structure
   subroutine find(model, structure, job, start, state)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(inout), target :: structure
      !> The state that is found again
      type(case_type), intent(in) :: job
      !> Displacements to begin with, shape (3, nodes, modes)
      real(wp), intent(in) :: start(:, :, :)
      !> The state
      type(single_state_type), intent(out) :: state

      call single_step(model, structure%equations, structure%condensed, structure%joint_points, &
         structure%support_points, job%loads, body_control_type(model%body_method, tolerance, most), &
         start, state)
      state%balanced = state%balanced .or. state%ratio <= loose
   end subroutine find

   !> Twice as many intervals between planes
   subroutine by_planes(model, structure, job, base, finer, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(inout) :: structure
      !> The state that is found again
      type(case_type), intent(in) :: job
      !> That on the planes of the job, and on more
      type(single_state_type), intent(in) :: base
      type(single_state_type), intent(out) :: finer
      !> Takes the error
      type(yield_share_type), intent(inout) :: error

      type(model_type) :: denser
      denser = model
      denser%n_body_planes = more_planes(model%max_harmonic, model%n_body_planes)
      if (.not. base%balanced) return
      call find(denser, structure, job, base%displacement, finer)
      call compare(job, structure%modes, base, finer, finer%displacement - base%displacement, &
         error_over_change(yield_planes), error)
   end subroutine by_planes

   !> Twice as many intervals, or the usual planes of twice as many harmonics and one more
   pure integer function more_planes(harmonic, n)
      !> Highest harmonic, and number of planes; 0 for the usual
      integer, intent(in) :: harmonic, n

      more_planes = 4*max(2, harmonic) + 3
      if (n > 0) more_planes = max(more_planes, 2*n - 1)
   end function more_planes

   !> Twice as many harmonics and one more
   subroutine by_harmonics(model, structure, job, base, error, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(in) :: structure
      !> The state that is found again
      type(case_type), intent(in) :: job
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
         if (.not. (job%held .or. allocated(job%loads%steered))) error%displacement = 0.0_wp
         return
      end if
      if (.not. base%balanced) return
      richer = with_harmonics(model, 2*model%max_harmonic + 1)
      if (size(used_modes(richer)) == size(structure%modes)) &  ! odd multiples alone
         richer = with_harmonics(model, 3*model%max_harmonic)
      richer%n_body_planes = more_planes(model%max_harmonic, model%n_body_planes)
      call build_equations(richer, larger, progress, failure)
      if (allocated(failure)) return  ! not known
      call find(richer, larger, job, in_modes(base%displacement, structure%modes, larger%modes), &
         state)
      call compare(job, larger%modes, base, state, &
         state%displacement - in_modes(base%displacement, structure%modes, larger%modes), &
         error_over_change(yield_harmonics), error)
   end subroutine by_harmonics

   !> Elements half as large. What they change hardly depends on the harmonics: a few are taken, or,
   !> if these come to no equilibrium, no more than the loads have
   subroutine by_mesh(model, structure, job, base, error, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(in) :: structure
      !> The state that is found again
      type(case_type), intent(in) :: job
      !> That on the mesh of the job
      type(single_state_type), intent(in) :: base
      !> Takes the error
      type(yield_share_type), intent(inout) :: error
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      integer :: least, highest

      least = min(model%max_harmonic, max(1, highest_loaded(model)))
      highest = min(model%max_harmonic, max(few, least))
      call compare_meshes(model, structure, job, base, highest, error, progress)
      if (max(error%load, error%displacement) < 0.0_wp .and. least < highest) &
         call compare_meshes(model, structure, job, base, least, error, progress)
   end subroutine by_mesh

   !> Elements half as large, with harmonics up to some
   subroutine compare_meshes(model, structure, job, base, highest, error, progress)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(in) :: structure
      !> The state that is found again
      type(case_type), intent(in) :: job
      !> That on the mesh of the job
      type(single_state_type), intent(in) :: base
      !> Highest harmonic
      integer, intent(in) :: highest
      !> Takes the error
      type(yield_share_type), intent(inout) :: error
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(model_type) :: plain, finer
      type(structure_type) :: coarse, fine
      type(fine_mesh_type) :: mesh
      type(single_state_type) :: before, after
      type(error_type), allocatable :: failure

      plain = model
      before = base
      if (model%max_harmonic > highest) then
         plain = with_harmonics(model, highest)
         plain%n_body_planes = 0
         call build_equations(plain, coarse, progress, failure)
         if (allocated(failure)) return  ! not known
         call find(plain, coarse, job, in_modes(base%displacement, structure%modes, coarse%modes), &
            before)
         if (.not. before%balanced) return
      end if
      call new_whole_model(plain, mesh, finer)
      call build_equations(finer, fine, progress, failure)
      if (allocated(failure)) return
      call find(finer, fine, job, on_fine(mesh, before%displacement), after)
      associate (n => size(before%displacement, 2))  ! between nodes shape functions differ, too
         call compare(job, fine%modes, before, after, &
            after%displacement(:, :n, :) - before%displacement, &
            error_over_change(yield_mesh), error)
      end associate
   end subroutine compare_meshes

   !> A job with other harmonics
   function with_harmonics(model, highest) result(other)
      !> The job
      type(model_type), intent(in) :: model
      !> Highest harmonic
      integer, intent(in) :: highest
      !> The other
      type(model_type) :: other

      integer :: m

      other = model
      other%max_harmonic = highest
      other%harmonics = [(m, m=0, highest)]
   end function with_harmonics

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
   subroutine compare(job, modes, before, after, change, times, error)
      !> What was found
      type(case_type), intent(in) :: job
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

      if (.not. (before%balanced .and. after%balanced)) return
      if (job%held) then
         error%load = times*ratio(abs(after%held_work - before%held_work), abs(after%held_work))
      else if (allocated(job%loads%steered)) then
         error%load = times*ratio(abs(after%factor - before%factor), abs(after%factor))
      else
         error%displacement = times*ratio(largest_vector(modes, change), &
            largest_vector(modes, after%displacement))
      end if
   end subroutine compare

end module axijoint_analysis_error_plastic_errors
