!> What joints out of proportion to the bodies do to the results: the change that ten times their
!> stiffness would make
module axijoint_analysis_error_stiffer_joints
   use axijoint_analysis_core_results, only : results_type, stiffer_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_error_joint_shares, only : displacement_scale, yielding_scale
   use axijoint_analysis_error_rounding, only : rounding_stress
   use axijoint_analysis_error_stiffer_state, only : stiffer_state_type, state_of_stiffer, &
      state_anew
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_progress, only : progress_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_history, only : history_type
   use axijoint_joints_planes, only : planes_type, new_view, synthesize
   use axijoint_model_joint_proportion, only : joint_proportions, side_of, side_soft, side_stiff
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: compare_stiffer

   !> How many times as stiff
   real(wp), parameter :: times = 10.0_wp
   !> Angles at which displacements are compared [degrees]
   integer, parameter :: step = 5

contains

   !> Find the laws out of proportion, and what stiffer joints would change
   subroutine compare_stiffer(model, structure, combination, history, field, results, progress)
      !> The job
      type(model_type), intent(in), target :: model
      !> The structure, factored and condensed
      type(structure_type), intent(inout), target :: structure
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> State of all joints
      type(joint_field_type), intent(in) :: field
      !> Results; take the changes
      type(results_type), intent(inout) :: results
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(stiffer_type) :: stiffer
      integer :: side

      allocate (results%stiffer(0))
      do side = side_soft, side_stiff, side_stiff - side_soft
         stiffer = stiffer_type(laws_on(model, side))
         if (size(stiffer%laws) == 0) cycle
         if (results%converged) &
            call find_change(model, structure, combination, history, field, results, stiffer, &
            progress)
         results%stiffer = [results%stiffer, stiffer]
      end do
   end subroutine compare_stiffer

   !> Laws on one side of what is sensible
   pure function laws_on(model, side) result(laws)
      !> The job
      type(model_type), intent(in) :: model
      !> One of the `side_` parameters
      integer, intent(in) :: side
      !> Their indices
      integer, allocatable :: laws(:)

      integer :: i

      associate (proportions => joint_proportions(model))
         laws = pack([(i, i=1, size(proportions))], &
                     [(side_of(model%joint_materials(i)%law, proportions(i)) == side, i=1, &
                     size(proportions))])
      end associate
   end function laws_on

   !> The change that ten times the stiffness of some laws makes. If these are the laws that yield,
   !> the condensed structure tells; else the job is solved anew
   subroutine find_change(model, structure, combination, history, field, results, stiffer, progress)
      !> The job
      type(model_type), intent(in), target :: model
      !> The structure, factored and condensed
      type(structure_type), intent(inout), target :: structure
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> State of all joints
      type(joint_field_type), intent(in) :: field
      !> Results
      type(results_type), intent(in) :: results
      !> The laws; takes the changes
      type(stiffer_type), intent(inout) :: stiffer
      !> Where to show progress
      type(progress_type), intent(inout) :: progress

      type(stiffer_state_type) :: state
      type(planes_type) :: planes
      real(wp) :: least(2)
      integer :: i

      if (same_set(stiffer%laws, &
         model%mesh%joint_material(structure%joint_points(structure%yielding)%joint))) then
         call state_of_stiffer(model, structure, history, field, results, times, state)
      else
         call state_anew(model, combination, stiffer%laws, times, results, state, progress)
      end if
      stiffer%known = state%found
      least = least_scales(structure, history, maxval(abs(results%displacement)))
      if (stiffer%known) then
         planes = new_view([(i*step*degree, i=0, 360/step)], results%modes)
         call changes(lengths(results%displacement, planes), lengths(state%displacement, planes), &
                      lengths(state%displacement - results%displacement, planes), least(1), &
                      stiffer%displacement, stiffer%displacement_anywhere, stiffer%known)
      end if
      if (stiffer%known) then
         call changes(maxval(abs(results%joint_stress)), maxval(abs(state%stress)), &
                      maxval(abs(state%stress - results%joint_stress)), least(2), &
                      stiffer%joint_stress, stiffer%joint_stress_anywhere, stiffer%known)
      end if
   end subroutine find_change

   !> Whether some numbers are the same set, each once or more
   pure logical function same_set(a, b)
      !> The numbers
      integer, intent(in) :: a(:), b(:)

      integer :: i

      same_set = size(b) > 0 .and. all([(any(a == b(i)), i=1, size(b))]) &
         .and. all([(any(b == a(i)), i=1, size(a))])
   end function same_set

   !> Largest length of the displacement vectors on some planes
   function lengths(displacement, planes) result(largest)
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The largest length
      real(wp) :: largest

      integer, parameter :: block = 256
      integer :: first

      largest = 0.0_wp
      do first = 1, size(displacement, 2), block
         associate (last => min(size(displacement, 2), first + block - 1))
            largest = max(largest, maxval(sum(synthesize(planes, &
               displacement(:, first:last, :))**2, 1)))
         end associate
      end do
      largest = sqrt(largest)
   end function lengths

   !> Displacement and joint stress that changes are measured by at least: what errors of joints that yield are, and rounding of
   !> joints that carry nothing
   function least_scales(structure, history, moved) result(least)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> Largest displacement
      real(wp), intent(in) :: moved
      !> The two
      real(wp) :: least(2)

      least(1) = 0.0_wp
      least(2) = maxval(rounding_stress(structure%joint_points, moved, size(history%loading%right, 2)))
      if (size(structure%yielding) == 0) return
      least(1) = displacement_scale(history, 0.0_wp)
      least(2) = max(least(2), yielding_scale(structure, history))
   end function least_scales

   !> Changes over the largest value
   subroutine changes(before, after, difference, least, of_largest, anywhere, known)
      !> Largest values before and after, and the largest difference
      real(wp), intent(in) :: before, after, difference
      !> What they are measured by at least
      real(wp), intent(in) :: least
      !> Change of the largest, and largest change, over the largest before
      real(wp), intent(out) :: of_largest, anywhere
      !> Whether there was anything
      logical, intent(out) :: known

      known = before > 0.0_wp
      of_largest = 0.0_wp
      anywhere = 0.0_wp
      if (.not. known) return
      of_largest = (after - before)/max(before, least)
      anywhere = difference/max(before, least)
   end subroutine changes

end module axijoint_analysis_error_stiffer_joints
