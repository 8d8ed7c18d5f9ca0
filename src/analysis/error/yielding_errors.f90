!> What the approximations leave of the error of a job whose joints yield: the iteration, planes,
!> harmonics and the mesh, each by a state found again without it
module axijoint_analysis_error_yielding_errors
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_path, only : keeps_slip, slide_together
   use axijoint_analysis_core_results, only : results_type, error_share_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_analysis_core_watched_lines, only : largest_on_lines
   use axijoint_analysis_error_cut_errors, only : change_on_cuts, sizes_on_cuts
   use axijoint_analysis_error_excess_effect, only : find_effects
   use axijoint_analysis_error_held_error, only : judged_state_type, error_of_held
   use axijoint_analysis_error_iteration_left, only : iteration_left_type
   use axijoint_analysis_error_line_errors, only : change_on_lines, stress_beyond
   use axijoint_analysis_error_joint_shares, only : take_share, nothing_is_left, has_moved, unloaded, least_changes
   use axijoint_analysis_error_other_changes, only : find_other_changes
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_change, only : joint_change_type, settled_change
   use axijoint_joints_joint_errors, only : joint_changes_type
   use axijoint_joints_settle, only : settle_wholly
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

end module axijoint_analysis_error_yielding_errors
