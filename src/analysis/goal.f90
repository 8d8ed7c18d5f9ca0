!> Refinement of a job until its error budget is below a target
module axijoint_analysis_goal
   use axijoint_analysis_results, only : error_share_type
   use axijoint_base_kinds, only : wp
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : error_goal_type, refinement_type, goal_joints, goal_energy
   implicit none
   private
   public :: goal_error, refine_further

   !> Estimates may be half of the error: the target is compared with this many times their sum
   real(wp), parameter :: safety = 2.0_wp
   !> A share that is to fall gets this part of the target
   real(wp), parameter :: part = 0.15_wp
   !> Most that a number is raised by in a round
   real(wp), parameter :: most = 2.0_wp

contains

   !> The error that a target is compared with, on the safe side: twice the sum of the shares of
   !> the quantity that it is about; negative if a share that there must be is not known
   pure real(wp) function goal_error(budget, goal) result(error)
      !> The budget
      type(error_share_type), intent(in) :: budget(:)
      !> The goal
      type(error_goal_type), intent(in) :: goal

      integer :: i

      error = 0.0_wp
      do i = 1, size(budget)
         associate (value => share_of(budget(i), goal))
            if (budget(i)%source == 'discretization' .and. value < 0.0_wp) then
               error = -1.0_wp
               return
            end if
            error = error + safety*max(0.0_wp, value)
         end associate
      end do
   end function goal_error

   !> A share of the quantity that the goal is about
   pure real(wp) function share_of(share, goal)
      !> The share
      type(error_share_type), intent(in) :: share
      !> The goal
      type(error_goal_type), intent(in) :: goal

      select case (goal%quantity)
      case (goal_joints)
         share_of = share%joint_stress
      case (goal_energy)
         share_of = max(share%energy, share%displacement)
         if (share%energy >= 0.0_wp) share_of = share%energy
      case default
         share_of = share%displacement
      end select
      share_of = max(share_of, share%load)
   end function share_of

   !> Raise what leaves more than its part of the target, and in any case what leaves most
   pure subroutine refine_further(model, budget, refinement, changed)
      !> The job as it was solved, and its goal
      type(model_type), intent(in) :: model
      !> What its approximations leave
      type(error_share_type), intent(in) :: budget(:)
      !> How it was refined; further on return
      type(refinement_type), intent(inout) :: refinement
      !> Whether anything could be raised
      logical, intent(out) :: changed

      real(wp) :: share(size(budget)), ratio
      integer :: i, order

      changed = .false.
      share = [(share_of(budget(i), model%error_goal), i=1, size(budget))]
      order = merge(1, 2, model%error_goal%quantity == goal_energy .and. &
                    any(model%mesh%element_size < 5))
      do i = 1, size(budget)
         if (share(i) <= part*model%error_goal%target .and. i /= maxloc(share, 1)) cycle
         ratio = max(1.25_wp, share(i)/(part*model%error_goal%target))
         select case (budget(i)%source)
         case ('discretization')
            if (.not. model%error_goal%mesh_too) cycle
            refinement%mesh = max(refinement%mesh + 1, ceiling(refinement%mesh*min(most, ratio**(1.0_wp/order))))
         case ('harmonics')
            refinement%harmonic = max(model%max_harmonic + 1, ceiling(model%max_harmonic*min(most, sqrt(ratio))))
         case ('planes')
            refinement%planes = 1 + ceiling((model%n_planes - 1)*min(most, sqrt(ratio)))
         case ('iteration')
            refinement%tolerance = 0.5_wp*refinement%tolerance/ratio
         case default
            cycle
         end select
         changed = .true.
      end do
      if (refinement%harmonic > 0) refinement%planes = &
         max(refinement%planes, model%n_planes, 2*refinement%harmonic + 1)
   end subroutine refine_further

end module axijoint_analysis_goal
