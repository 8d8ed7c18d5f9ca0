!> What becomes of a state that the iterations found, before it counts: rounding of stiff joints is
!> corrected, and the iterations go on until the errors that they leave are what the tolerance
!> claims
module axijoint_analysis_error_corrections
   use axijoint_analysis_core_results, only : results_type, error_share_type
   use axijoint_analysis_core_solution, only : solve_displacements
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_error_budget, only : solver_error
   use axijoint_analysis_error_iteration_left, only : iteration_left_type, iteration_error
   use axijoint_analysis_error_joint_shares, only : held_share
   use axijoint_assembly_force, only : elastic_joint_stress
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_history, only : history_type
   use axijoint_joints_increments, only : balance_again
   use axijoint_joints_residual, only : strictest_type, strictest, residual_record_type
   use axijoint_joints_scene, only : mismatch_of
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: correct_rounding, keep_claim, judge_solver

   !> A tolerance claims that displacements and joint stresses are as near to equilibrium as so many
   !> times it, over the largest
   real(wp), parameter :: claimed = 10.0_wp
   !> k h/E above which it claims balanced forces: how they are distributed over the points of an
   !> element is not determined by them, and displacements are by so much less certain as joints are
   !> stiffer
   real(wp), parameter :: stiff = 1.0e2_wp

   !> A state in equilibrium, before it is balanced further
   type :: balanced_type
      !> State of the joints, and what their points remembered before its slip was added
      type(joint_field_type) :: field
      type(memory_type), allocatable :: memory(:, :)
      !> What it left out of balance, and whether the last entry is of it
      type(residual_record_type), allocatable :: residuals(:)
      logical :: noted = .true.
      !> Jumps by the loads if joints are elastic, shape (3, points, modes)
      real(wp), allocatable :: free(:, :, :)
   end type balanced_type

contains

   !> See how far the relative displacements of the bodies are from those that the laws saw;
   !> where that matters, correct the response by the difference and balance the joints again
   subroutine correct_rounding(model, structure, history, results, left, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, condensed
      type(structure_type), intent(inout) :: structure
      !> What the increments came to; takes further iterations and their state
      type(history_type), intent(inout) :: history
      !> Results with displacements; take those of the corrected state, and the mismatch
      type(results_type), intent(inout) :: results
      !> What is known of what the iteration left: nothing any more of a corrected state
      type(iteration_left_type), intent(inout) :: left
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: most_corrections = 4
      !> Part of the tolerance that is no matter, and of a mismatch that a correction leaves of it if it is worth another
      real(wp), parameter :: negligible = 0.1_wp, falling = 0.5_wp
      real(wp), allocatable :: jump(:, :, :), displacement(:, :, :)
      real(wp) :: earlier
      type(balanced_type) :: before
      type(strictest_type) :: found
      integer :: k

      earlier = huge(1.0_wp)
      associate (condensed => structure%condensed, scene => history%scene)
         do k = 0, most_corrections
            jump = mismatch_of(condensed, scene, history%field, results%displacement)
            found = strictest(condensed%measure, scene%loads%reference, elastic_stress(jump), &
                              paper=history%method%accumulates)
            results%mismatch = found%ratio
            if (.not. results%converged .or. history%method%accumulates) return
            if (results%mismatch <= negligible*results%tolerance) return
            ! what corrections leave as it is are roundings of the bodies: one of two states in a row that is near enough will do
            if (results%mismatch > falling*earlier .and. min(results%mismatch, earlier) <= results%tolerance) then
               if (results%mismatch <= results%tolerance) return
               call go_back(before, history)
               results%displacement = displacement
               results%mismatch = earlier
               return
            end if
            if (k == most_corrections) return
            earlier = results%mismatch
            displacement = results%displacement
            before = balanced_state(history)
            scene%loads%free = scene%loads%free + jump
            left = iteration_left_type()
            call balance_again(condensed, history)
            results%converged = history%verdict%converged
            results%path = history%path
            if (.not. results%converged) then
               call go_back(before, history)
               results%converged = results%mismatch <= results%tolerance
               return
            end if
            call solve_displacements(structure, model, history%loading, results%displacement, &
               results%solves, &
                                     error, history%field%excess)
            if (allocated(error)) return
         end do
      end associate

   contains

      !> Stress of the jumps in the elastic structure
      function elastic_stress(jump) result(stress)
         !> Amplitudes, shape (3, points, modes)
         real(wp), intent(in) :: jump(:, :, :)
         !> Amplitudes, same shape
         real(wp) :: stress(3, size(jump, 2), size(jump, 3))

         integer :: m

         do m = 1, size(jump, 3)
            stress(:, :, m) = elastic_joint_stress(structure%condensed%points, jump(:, :, m))
         end do
      end function elastic_stress

   end subroutine correct_rounding

   !> What further iterations change of a history
   function balanced_state(history) result(state)
      !> The history
      type(history_type), intent(in) :: history
      !> Its last state
      type(balanced_type) :: state

      state%field = history%field
      state%memory = history%memory
      state%residuals = history%residuals
      state%free = history%scene%loads%free
      state%noted = history%noted
   end function balanced_state

   !> Back to a state in equilibrium from one that is none; the path, and how iterations ended, stay
   subroutine go_back(state, history)
      !> The state
      type(balanced_type), intent(inout) :: state
      !> The history after the iterations
      type(history_type), intent(inout) :: history

      history%field = state%field
      call move_alloc(state%memory, history%memory)
      call move_alloc(state%residuals, history%residuals)
      call move_alloc(state%free, history%scene%loads%free)
      history%noted = state%noted
   end subroutine go_back

   !> Iterate on until the errors that iterations leave are what the tolerance claims. What does not
   !> come there has not converged. (The paper's loop claims no more than its residual ratio.)
   subroutine keep_claim(model, structure, history, results, left, error)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, condensed
      type(structure_type), intent(inout), target :: structure
      !> What the increments came to; takes further iterations and their state
      type(history_type), intent(inout) :: history
      !> Results with displacements; take those of the state
      type(results_type), intent(inout) :: results
      !> What is known of what they leave; takes what was found of it
      type(iteration_left_type), intent(inout) :: left
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: most_attempts = 3
      !> Part of the tolerance that would do if errors fell with it, and the least that numbers may reach
      real(wp), parameter :: ample = 0.3_wp, least_tolerance = 1.0e-15_wp
      !> Joint stresses are not claimed better than as if the largest were this part of what joints would
      !> carry if they held: balanced forces do not say more of joints that are about to close
      real(wp), parameter :: slight = 1.0e-2_wp
      type(error_share_type) :: share, wanted
      type(balanced_type) :: before
      real(wp) :: tolerance, excess
      integer :: k

      associate (condensed => structure%condensed, scene => history%scene)
         if (.not. results%converged .or. history%method%accumulates) return
         tolerance = results%tolerance
         wanted%displacement = claim(condensed, results%tolerance)
         wanted%joint_stress = huge(1.0_wp)
         if (condensed%proportion <= stiff) wanted%joint_stress = &
            wanted%displacement*max(1.0_wp, slight*held_share(structure, history))
         do k = 0, most_attempts
            call iteration_error(structure, history, results, wanted, share, left)
            excess = share%displacement/wanted%displacement
            if (condensed%proportion <= stiff) &
               excess = max(excess, share%joint_stress/wanted%joint_stress)
            if (excess <= 1.0_wp) return
            if (k == most_attempts) exit
            tolerance = max(ample*tolerance/excess, least_tolerance)
            before = balanced_state(history)
            left = iteration_left_type()
            call balance_again(condensed, history, tolerance)
            results%path = history%path
            if (.not. history%verdict%converged) then
               call go_back(before, history)
               exit
            end if
            call solve_displacements(structure, model, history%loading, results%displacement, &
               results%solves, &
                                     error, history%field%excess)
            if (allocated(error)) return
         end do
         results%converged = .false.
         results%unsettled = share%displacement
         if (condensed%proportion <= stiff) results%unsettled = max(share%displacement, share%joint_stress)
      end associate
   end subroutine keep_claim

   !> Error that a tolerance claims
   pure real(wp) function claim(condensed, tolerance)
      !> The condensed structure, with the proportion of its joints
      type(condensed_type), intent(in) :: condensed
      !> The tolerance
      real(wp), intent(in) :: tolerance

      claim = claimed*tolerance*max(1.0_wp, condensed%proportion/stiff)
   end function claim

   !> Nothing is converged where the solver leaves more error than the tolerance claims
   pure subroutine judge_solver(results)
      !> Results with their largest displacement
      type(results_type), intent(inout) :: results

      results%converged = solver_error(results) <= claimed*results%tolerance
      if (.not. results%converged) results%uncertain = solver_error(results)
   end subroutine judge_solver

end module axijoint_analysis_error_corrections
