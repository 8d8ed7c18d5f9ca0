!> What the approximations leave of the error of a job whose joints yield: the iteration, planes,
!> harmonics and the mesh, each by a state found again without it
module axijoint_analysis_error_yielding_errors
   use omp_lib, only : omp_get_max_threads, omp_get_num_threads, omp_get_wtime
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_path, only : keeps_slip, slide_together
   use axijoint_analysis_core_results, only : results_type, error_share_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_analysis_core_watched_lines, only : largest_on_lines
   use axijoint_analysis_error_cut_errors, only : change_on_cuts, find_held_on_cuts, sizes_on_cuts
   use axijoint_analysis_error_excess_effect, only : find_effects
   use axijoint_analysis_error_follower, only : follower_type, new_follower, follow_behind
   use axijoint_analysis_error_held_error, only : judged_state_type, held_errors_type, error_of_held, &
      find_of_system, find_of_systems, end_by_law
   use axijoint_analysis_error_iteration_left, only : iteration_left_type
   use axijoint_analysis_error_line_errors, only : change_on_lines, find_held_on_lines, stress_beyond
   use axijoint_analysis_error_joint_shares, only : take_share, nothing_is_left, has_moved, unloaded, least_changes
   use axijoint_analysis_error_joints_mesh_error, only : begin_held_errors, find_answer, add_answer
   use axijoint_analysis_error_remembered, only : solved_way_type, look_back, follow_way, leaves_rest
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_errors, only : joint_change_type, joint_changes_type, search_type, new_search, &
      find_planes, find_harmonics, settled_change
   use axijoint_joints_settle, only : settle_wholly
   use axijoint_joints_way, only : lag_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: estimate_yielding_errors

contains

   !> Estimate all errors. The paper's loop is another approximation: its errors are the difference
   !> to equilibrium on total jumps, if that was found, and the errors of that
   subroutine estimate_yielding_errors(model, structure, history, other, left, results, mesh_error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, condensed
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in), target :: history
      !> State of Newton's method where the paper's loop was used
      type(joint_field_type), allocatable, intent(in) :: other
      !> What the iteration left, as far as it was found
      type(iteration_left_type), intent(inout) :: left
      !> Results with displacements; take the errors
      type(results_type), intent(inout), target :: results
      !> Takes those of the mesh
      type(mesh_error_type), intent(out) :: mesh_error

      type(joint_changes_type) :: changes
      real(wp), allocatable :: displacement(:, :, :), others(:, :, :, :)
      real(wp) :: largest
      logical :: judged, rests

      judged = results%converged
      if (judged) judged = .not. nothing_is_left(structure, history, results)
      if (.not. judged .or. (history%method%accumulates .and. .not. allocated(other))) then
         call error_of_held(structure, history%scene, judged_state_type(history%loading, history%field, results%displacement), &
            mesh_error)
         if (results%converged .and. .not. judged) &
            mesh_error%known = mesh_error%known .and. .not. has_moved(structure, history)
         return
      end if
      call balance(structure, history, other, size(results%displacement, 2), left)
      changes%iteration = left%change(1)
      displacement = results%displacement
      call add_motions(structure%condensed%floating, history%field%offset, displacement)
      largest = largest_vector(results%modes, displacement)
      displacement = results%displacement + left%effect(:, :, :, 1)
      results%keeps_slip = keeps_slip(structure, history, largest)
      call find_other_changes(model, structure, history, results%earlier, left%balanced, displacement, &
         results%keeps_slip .or. unloaded(history), changes, others, mesh_error, rests)
      results%follows_slip = mesh_error%follows_slip
      results%follows_all_slip = results%follows_slip .and. changes%follow_slip
      if (results%follows_all_slip) results%keeps_slip = results%keeps_slip .and. &
         (rests .or. slide_together(structure, history))
      associate (shares => results%joint_errors)
         call take_share(structure, history, results, largest, changes%iteration, left%effect(:, :, :, 1), shares(1), model%points)
         call take_share(structure, history, results, largest, changes%planes, others(:, :, :, 1), shares(2), model%points)
         call take_share(structure, history, results, largest, changes%harmonics, others(:, :, :, 2), shares(3), model%points)
         call take_cuts_and_lines(changes%iteration, left%effect(:, :, :, 1), shares(1))
         call take_cuts_and_lines(changes%planes, others(:, :, :, 1), shares(2))
         call take_cuts_and_lines(changes%harmonics, others(:, :, :, 2), shares(3))
         if (allocated(shares(3)%on_lines)) shares(3)%on_lines = shares(3)%on_lines + stress_beyond(model, structure, &
            history%scene%planes, left%balanced%stress, displacement)
      end associate
      ! what slip has left is as wrong as the mesh was under the loads that are gone
      if (unloaded(history) .and. .not. mesh_error%follows_slip) mesh_error%known = .false.

   contains

      !> Errors of the resultants on cuts, and of the stresses along lines
      subroutine take_cuts_and_lines(change, effect, share)
         !> A change of the joints, and the displacements that follow from it, shape (3, nodes, modes)
         type(joint_change_type), intent(in) :: change
         real(wp), intent(in) :: effect(:, :, :)
         !> Takes the errors, if they are known
         type(error_share_type), intent(inout) :: share

         if (.not. change%known) return
         if (size(model%cuts) > 0) share%on_cuts = sizes_on_cuts(change_on_cuts(model, structure, change, effect))
         if (allocated(structure%watched)) share%on_lines = largest_on_lines(structure%watched, structure%modes, &
            change_on_lines(model, structure, effect))
      end subroutine take_cuts_and_lines

   end subroutine estimate_yielding_errors

   !> Find the state in which the joints are wholly balanced, the change to that and its effect, unless they are there
   subroutine balance(structure, history, other, n_nodes, left)
      !> The structure, condensed
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of Newton's method where the paper's loop was used
      type(joint_field_type), allocatable, intent(in) :: other
      !> Nodes
      integer, intent(in) :: n_nodes
      !> What the iteration left
      type(iteration_left_type), intent(inout) :: left

      real(wp) :: start

      if (allocated(left%effect)) return
      start = omp_get_wtime()
      associate (condensed => structure%condensed, scene => history%scene)
         if (.not. allocated(left%balanced)) then
            if (history%method%accumulates) then
               allocate (left%balanced, source=other)
            else
               allocate (left%balanced, source=history%field)
               left%balanced%memory = history%memory
            end if
            call settle_wholly(condensed, scene, left%balanced)
         end if
         left%change(1) = settled_change(condensed, scene, history%field, left%balanced, least_changes(structure, history))
         left%change(1)%seconds = omp_get_wtime() - start
         call find_effects(structure%equations, condensed%points, n_nodes, left%change, left%effect)
      end associate
   end subroutine balance

   !> What planes, harmonics and the mesh leave. What joints answer to these is found at once where threads have little to share in
   !> each and all factors are at hand; and each factor is read once for what that does to the displacements
   subroutine find_other_changes(model, structure, history, earlier, balanced, displacement, lasts, changes, effect, mesh_error, &
      rests)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in), target :: history
      !> Fields at the ends of earlier increments that are known
      type(fields_type), intent(in), optional :: earlier(:)
      !> State of the joints, balanced
      type(joint_field_type), intent(in), target :: balanced
      !> Displacement amplitudes of that state, shape (3, nodes, modes)
      real(wp), intent(in), target :: displacement(:, :, :)
      !> Whether slip of earlier increments lasts, or is all that is left
      logical, intent(in) :: lasts
      !> Takes the changes by planes and harmonics
      type(joint_changes_type), intent(inout) :: changes
      !> What they, and the answer of the joints to the errors of the mesh, do to the displacements, shape (3, nodes, modes, 3)
      real(wp), allocatable, intent(out) :: effect(:, :, :, :)
      !> Takes what the mesh leaves
      type(mesh_error_type), intent(out) :: mesh_error
      !> Whether displacements and errors are rests of larger ones on the way, as far as that is known
      logical, intent(out) :: rests

      type(joint_change_type) :: answer
      type(solved_way_type), target :: way
      type(search_type) :: search
      type(follower_type) :: follower
      type(held_errors_type) :: held
      type(mesh_error_type), allocatable :: errors(:)
      real(wp), allocatable :: rounding(:)
      real(wp) :: seconds, looked_back
      logical :: at_once, apart

      seconds = omp_get_wtime()
      allocate (way%stations(0))
      if (lasts) call look_back(model, structure, history, earlier, way)
      search = new_search(history%scene)
      rounding = least_changes(structure, history)
      at_once = are_for_one_thread(structure%condensed, size(balanced%jump)) .and. are_at_hand(structure%equations)
      apart = .false.
      if (at_once) then
         !$omp parallel  ! of all threads: a smaller team would end the others
         !$omp single
         apart = omp_get_num_threads() > 1
         if (apart) then
            call see_all_at_once()
         else
            call see_in_order()
         end if
         !$omp end single
         !$omp end parallel
      else  ! not in a region of one thread, in which other regions would begin with new threads
         call see_in_order()
      end if
      call find_their_effects(model, structure, history%loading, displacement, answer, changes, mesh_error, effect)
      mesh_error%seconds = mesh_error%seconds + answer%seconds + looked_back
      call share_time(omp_get_wtime() - seconds, mesh_error%seconds, changes%planes%seconds, changes%harmonics%seconds)

   contains

      !> One after the other, each by all threads
      subroutine see_in_order()
         call new_follower(history%scene, size(balanced%jump), size(history%states), .false., follower)
         call see_way()
         call begin_held()
         call find_of_systems(structure, held)
         call see_answer()
         call see_planes()
         call see_harmonics()
      end subroutine see_in_order

      !> Each by a thread, but for the errors of the mesh, whose systems are for whoever has nothing else to do. No task
      !> waits for these, so that no thread is bound to do so
      subroutine see_all_at_once()
         integer :: s

         call new_follower(history%scene, size(balanced%jump), merge(size(history%states), 0, way%known), .true., follower)
         !$omp task default(shared) depend(out: search)
         call follow_behind(structure%condensed, history%scene, follower)
         call see_planes()
         !$omp end task
         !$omp task default(shared) depend(out: way)  ! not by this task: where one waits for its own, it may begin with the first
         call see_way()
         !$omp end task
         !$omp task default(shared) depend(in: way) depend(out: held)
         call begin_held()
         !$omp end task
         do s = structure%equations%first, structure%equations%last
            !$omp task default(shared) firstprivate(s) depend(in: held)
            call find_of_system(structure, s, held)
            !$omp end task
         end do
         !$omp task default(shared) depend(in: way) depend(inout: search)
         call see_harmonics()
         !$omp end task
         !$omp task default(shared) depend(in: way) depend(inout: held)
         call see_answer()
         !$omp end task
      end subroutine see_all_at_once

      !> The way that loads took, if it is known
      subroutine see_way()
         call follow_way(structure, history, way, follower)
         rests = .false.
         if (way%known) rests = leaves_rest(way)
         looked_back = omp_get_wtime() - seconds
         if (.not. apart) looked_back = looked_back - follower%lag%seconds
      end subroutine see_way

      !> What the mesh leaves while the stress of the joints is held
      subroutine begin_held()
         call begin_held_errors(structure, history, balanced, displacement, way, held)
      end subroutine begin_held

      !> What joints answer to that, all systems being found
      subroutine see_answer()
         call end_by_law(structure, history%scene, held, errors)
         call find_answer(structure, history, balanced, errors, way, mesh_error, answer)
      end subroutine see_answer

      !> What planes leave
      subroutine see_planes()
         call find_planes(structure%condensed, balanced, history, way%way_type, rounding, search, changes%planes)
      end subroutine see_planes

      !> What harmonics leave, after these
      subroutine see_harmonics()
         if (.not. way%known) follower%lag = lag_type()
         call find_harmonics(structure%condensed, balanced, history, follower%lag, rounding, search, changes)
      end subroutine see_harmonics

   end subroutine find_other_changes

   !> What planes, harmonics and the answer of the joints to the mesh do to the displacements, each factor read once for all three
   subroutine find_their_effects(model, structure, loading, displacement, answer, changes, mesh_error, effect)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> The loads
      type(loading_type), intent(in) :: loading
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Change of the joints that answers the errors of the mesh
      type(joint_change_type), intent(inout) :: answer
      !> The changes by planes and harmonics
      type(joint_changes_type), intent(inout) :: changes
      !> What the mesh leaves; takes what the answer adds
      type(mesh_error_type), intent(inout) :: mesh_error
      !> The effects, shape (3, nodes, modes, 3)
      real(wp), allocatable, intent(out) :: effect(:, :, :, :)

      type(joint_change_type) :: all(3)
      logical :: answered

      answered = answer%known
      all(1) = changes%planes
      all(2) = changes%harmonics
      all(3) = answer
      call find_effects(structure%equations, structure%condensed%points, size(displacement, 2), all, effect)
      changes%planes = all(1)
      changes%harmonics = all(2)
      answer = all(3)
      call find_held_on_cuts(model, structure, loading, displacement, mesh_error)
      if (.not. answer%known .and. allocated(mesh_error%on_cuts)) deallocate (mesh_error%on_cuts)
      call find_held_on_lines(model, structure, loading, displacement, mesh_error)
      if (.not. answer%known .and. allocated(mesh_error%on_lines)) deallocate (mesh_error%on_lines)
      if (.not. answered) return
      if (allocated(mesh_error%on_cuts)) mesh_error%on_cuts = mesh_error%on_cuts &
         + change_on_cuts(model, structure, answer, effect(:, :, :, 3))
      if (allocated(mesh_error%on_lines)) mesh_error%on_lines = mesh_error%on_lines &
         + change_on_lines(model, structure, effect(:, :, :, 3))
      mesh_error%known = mesh_error%known .and. answer%known
      call add_answer(structure, answer, effect(:, :, :, 3), mesh_error)
   end subroutine find_their_effects

   !> Times of what threads did beside each other, made parts of the time that all took
   pure subroutine share_time(whole, mesh, planes, harmonics)
      !> The time that all took
      real(wp), intent(in) :: whole
      !> The times
      real(wp), intent(inout) :: mesh, planes, harmonics

      real(wp) :: share

      share = whole/max(tiny(1.0_wp), mesh + planes + harmonics)
      mesh = share*mesh
      planes = share*planes
      harmonics = share*harmonics
   end subroutine share_time

   !> Whether threads can see to a system each, all factors being kept by this process alone
   pure logical function are_at_hand(equations)
      !> The equations
      type(equations_type), intent(in) :: equations

      are_at_hand = equations%solver%concurrent .and. equations%team%size == 1 .and. equations%n_kept == size(equations%systems)
   end function are_at_hand

   !> Whether threads gain less where they share the products and sums of one state of the joints than where each finds a state: as
   !> long as there are few of them, or little to share
   logical function are_for_one_thread(condensed, n_numbers)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Jumps on all planes
      integer, intent(in) :: n_numbers

      !> Threads at most, and jumps
      integer, parameter :: few_threads = 4, few = 5000

      integer :: n_threads

      n_threads = omp_get_max_threads()
      are_for_one_thread = n_threads > 1 .and. (n_threads <= few_threads .or. n_numbers <= few) .and. .not. condensed%shared
   end function are_for_one_thread

end module axijoint_analysis_error_yielding_errors
