!> What the iteration leaves of the error of a job whose joints yield, by the state in which they are wholly balanced
module axijoint_analysis_error_iteration_left
   use axijoint_analysis_core_results, only : results_type, error_share_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_analysis_error_excess_bound, only : bound_excess_effect
   use axijoint_analysis_error_excess_effect, only : find_effects
   use axijoint_analysis_error_joint_shares, only : take_share, nothing_is_left, displacement_scale, elastic_points, &
      yielding_scale, least_changes
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_change, only : joint_change_type, settled_change
   use axijoint_joints_residual, only : ratio
   use axijoint_joints_settle, only : settle_wholly
   implicit none
   private
   public :: iteration_left_type, find_left, iteration_error

   !> What was found on the way, which estimates need not find again
   type :: iteration_left_type
      !> The state wholly balanced; not allocated if it was not looked for
      type(joint_field_type), allocatable :: balanced
      !> The change to that, and what it does to displacements but for rigid motions of floating parts, amplitudes, shape (3,
      !> nodes, modes, 1); not allocated where a bound was enough
      type(joint_change_type) :: change(1)
      real(wp), allocatable :: effect(:, :, :, :)
   end type iteration_left_type

contains

   !> Find the state wholly balanced, and the change to it
   subroutine find_left(structure, history, left)
      !> The structure, condensed
      type(structure_type), intent(in) :: structure
      !> What the increments came to by a method on total jumps
      type(history_type), intent(in) :: history
      !> Takes state and change
      type(iteration_left_type), intent(out) :: left

      allocate (left%balanced, source=history%field)
      left%balanced%memory = history%memory
      call settle_wholly(structure%condensed, history%scene, left%balanced)
      left%change(1) = settled_change(structure%condensed, history%scene, history%field, left%balanced, &
         least_changes(structure, history))
   end subroutine find_left

   !> What the iteration left: a bound where that is within what is wanted, unless its effect is there
   subroutine iteration_error(structure, history, results, wanted, share, left)
      !> The structure, condensed
      type(structure_type), intent(inout) :: structure
      !> What the increments came to by a method on total jumps
      type(history_type), intent(in) :: history
      !> Results with displacements
      type(results_type), intent(in) :: results
      !> Displacement and joint stress that the error need not be below
      type(error_share_type), intent(in) :: wanted
      !> The error
      type(error_share_type), intent(out) :: share
      !> What is known of it; takes what was found on the way
      type(iteration_left_type), intent(inout) :: left

      real(wp), allocatable :: displacement(:, :, :), effect(:, :, :, :)
      real(wp) :: largest

      if (nothing_is_left(structure, history, results)) then
         left = iteration_left_type()
         return
      end if
      associate (condensed => structure%condensed, change => left%change(1))
         if (.not. allocated(left%balanced)) call find_left(structure, history, left)
         displacement = results%displacement
         call add_motions(condensed%floating, history%field%offset, displacement)
         largest = largest_vector(results%modes, displacement)
         if (.not. allocated(left%effect)) then
            if (change%known .and. .not. condensed%shared) then
               call bound_share(structure, history, largest, change, share)
               ! each rank has a bound by the factors that it has
               if (condensed%team%all_of(share%displacement <= wanted%displacement .and. &
                                         share%joint_stress <= wanted%joint_stress)) return
            end if
            if (.not. change%known) return
            call find_effects(structure%equations, condensed%points, size(displacement, 2), left%change, effect)
            call move_alloc(effect, left%effect)
         end if
         change%seconds = 0.0_wp  ! the claim of the tolerance takes it, whether errors are estimated or not
         call take_share(structure, history, results, largest, change, left%effect(:, :, :, 1), share)
      end associate
   end subroutine iteration_error

   !> A bound of an error in relative numbers, found without a solution
   subroutine bound_share(structure, history, largest, change, share)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Largest displacement
      real(wp), intent(in) :: largest
      !> The change of the joints
      type(joint_change_type), intent(in) :: change
      !> Takes stress and displacement
      type(error_share_type), intent(out) :: share

      real(wp) :: displacement, stress
      integer :: k

      call bound_excess_effect(structure, history%scene, change%excess, elastic_points(structure), &
         displacement, stress)
      do k = 1, size(change%offset)
         displacement = displacement + abs(change%offset(k)) &
            *sqrt(3.0_wp)*maxval(abs(structure%condensed%floating(k)%displacement))
      end do
      share%displacement = ratio(displacement + change%beyond, &
         displacement_scale(history, largest))
      share%joint_stress = huge(1.0_wp)  ! parts that move stress elastic joints by what only a solution tells
      if (any(abs(change%offset) > 0.0_wp)) return
      share%joint_stress = ratio(max(change%stress, stress), &
         yielding_scale(structure, history))
   end subroutine bound_share

end module axijoint_analysis_error_iteration_left
