!> The stress transfer method of Kobori and Chikata (1985), steps (1) to (5) of their procedure,
!> with the initial stiffness throughout
module axijoint_joints_transfer
   use axijoint_base_kinds, only : wp
   use axijoint_base_stop, only : stop_wished
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, admit_trial
   use axijoint_joints_method, only : method_type, control_type, verdict_type
   use axijoint_joints_passes, only : pass_on
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_planes, only : synthesize, analyse
   use axijoint_joints_scene, only : scene_type, jumps, motion_of
   use axijoint_joints_watch, only : watch_type, new_watch, note, end_watch
   implicit none
   private
   public :: transfer_type, new_transfer

   !> The method
   type, extends(method_type) :: transfer_type
   contains
      procedure :: evaluate => solve_and_check
      procedure :: balance
   end type transfer_type

contains

   !> The method
   pure function new_transfer() result(method)
      !> The method
      type(transfer_type) :: method

      method%accumulates = .true.
   end function new_transfer

   !> Iterate a load step to equilibrium
   subroutine balance(self, condensed, scene, control, field, path, verdict)
      !> The method
      class(transfer_type), intent(in) :: self
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> When to end
      type(control_type), intent(in) :: control
      !> State of the joints: of the last step, then of this one
      type(joint_field_type), intent(inout) :: field
      !> Convergence path, to be continued
      type(iteration_type), allocatable, intent(inout) :: path(:)
      !> How it ended
      type(verdict_type), intent(out) :: verdict

      type(watch_type) :: watch
      real(wp), allocatable :: residual(:, :, :)
      logical :: again

      allocate (residual, mold=field%excess)
      call self%evaluate(condensed, scene, field, residual)  ! steps 1 to 4
      watch = new_watch(condensed, scene, field, residual)
      do
         ! step 5, Eq. 17
         call note(watch, condensed, scene, control%now, self%accumulates, residual, field, verdict)
         call condensed%team%share_wish()
         if (stop_wished()) exit  ! nobody uses what was reached
         if (verdict%ran_away) exit
         call pass_on(self, condensed, scene, control%tolerance, field, residual, verdict, again)
         if (verdict%converged .or. verdict%mechanism%loaded .or. watch%k >= control%most) exit
         if (again) call self%evaluate(condensed, scene, field, residual)
         field%carried = field%stress
         field%excess = field%excess + residual  ! transferred to the structure
         call self%evaluate(condensed, scene, field, residual)  ! steps 1 to 4
      end do
      call end_watch(watch, residual, field, path, verdict)
   end subroutine balance

   !> Steps 1 to 4: solve the harmonics, sum them on planes, add to the stress of the iteration
   !> before, and reduce what the law does not admit
   subroutine solve_and_check(self, condensed, scene, field, residual, judged)
      !> The method
      class(transfer_type), intent(in) :: self
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints; its stress is that of the iteration before, then that admitted
      type(joint_field_type), intent(inout) :: field
      !> What was cut off, amplitudes, shape (3, points, modes)
      real(wp), intent(out) :: residual(:, :, :)
      !> Of no meaning here: the law sees all of the trial stress
      logical, intent(in), optional :: judged

      real(wp), allocatable :: jump(:, :, :), trial(:, :, :)
      integer :: j, k

      associate (unused => self, also => present(judged))
      end associate
      ! (1) the harmonics, each on its own
      jump = jumps(condensed, scene, field%excess, free=.true.)
      ! (2), (3) combined on meridional planes, stresses added to those of the iteration before (Eq.
      ! 13)
      jump = synthesize(scene%planes, jump)
      if (any(abs(field%offset) > 0.0_wp)) then
         field%moved = synthesize(scene%planes, motion_of(condensed, scene, field%offset))
         jump = jump + field%moved
      end if
      trial = field%stress
      do j = 1, size(jump, 3)
         do k = 1, size(scene%laws)
            trial(:, k, j) = trial(:, k, j) + scene%laws(k)%stiffness*(jump(:, k, j) - field%jump(:, k, j))
         end do
      end do
      field%jump = jump
      ! (4) debonding and slip (Eq. 15, 16); what is reduced goes back to the harmonics
      call admit_trial(scene%laws, trial, field)
      residual = analyse(scene%planes, trial - field%stress)
   end subroutine solve_and_check

end module axijoint_joints_transfer
