!> What planes, harmonics and the mesh leave of the error of a job whose joints yield: searches that share threads and factors
module axijoint_analysis_error_other_changes
   use omp_lib, only : omp_get_max_threads, omp_get_num_threads, omp_get_wtime
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_error_cut_errors, only : change_on_cuts, find_held_on_cuts
   use axijoint_analysis_error_excess_effect, only : find_effects
   use axijoint_analysis_error_follower, only : follower_type, new_follower, follow_behind
   use axijoint_analysis_error_held_error, only : held_errors_type, find_of_system, find_of_systems, end_by_law
   use axijoint_analysis_error_line_errors, only : change_on_lines, find_held_on_lines
   use axijoint_analysis_error_joint_shares, only : least_changes
   use axijoint_analysis_error_joints_mesh_error, only : begin_held_errors, find_answer, add_answer
   use axijoint_analysis_error_remembered, only : solved_way_type, look_back, follow_way, leaves_rest
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_change, only : joint_change_type
   use axijoint_joints_joint_errors, only : joint_changes_type, search_type, new_search, find_planes, find_harmonics
   use axijoint_joints_way, only : lag_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: find_other_changes

contains

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
      !> When the search began, and the time to look back on the way [second]
      real(wp) :: began, looked_back
      !> Whether threads see to different things
      logical :: apart

      began = omp_get_wtime()
      allocate (way%stations(0))
      if (lasts) call look_back(model, structure, history, earlier, way)
      search = new_search(history%scene)
      rounding = least_changes(structure, history)
      apart = .false.
      if (are_for_one_thread(structure%condensed, size(balanced%jump)) .and. are_at_hand(structure%equations)) then
         call see_by_threads()
      else
         call see_in_order()
      end if
      call find_their_effects(model, structure, history%loading, displacement, answer, changes, mesh_error, effect)
      mesh_error%seconds = mesh_error%seconds + answer%seconds + looked_back
      call share_time(omp_get_wtime() - began, mesh_error%seconds, changes%planes%seconds, changes%harmonics%seconds)

   contains

      !> All at once, a thread each, if there are threads. Who sees in order with many threads must not do so from this region: regions
      !> within one begin with new threads
      subroutine see_by_threads()
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
      end subroutine see_by_threads

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
         looked_back = omp_get_wtime() - began
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

end module axijoint_analysis_error_other_changes
