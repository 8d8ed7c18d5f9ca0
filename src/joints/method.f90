!> How joints are brought to equilibrium in a load step: the abstract method, what it is told, how
!> it ends
module axijoint_joints_method
   use axijoint_base_kinds, only : wp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_mechanism, only : mechanism_type
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_residual, only : strictest_type
   use axijoint_joints_scene, only : scene_type, evaluate
   implicit none
   private
   public :: method_type, control_type, verdict_type

   !> When the iterations of a load step end
   type :: control_type
      !> Tolerance on the residual ratio
      real(wp) :: tolerance = 0.0_wp
      !> Most iterations
      integer :: most = 0
      !> Increment, iterations made in it so far, load factor
      type(iteration_type) :: now
      !> Whether the state is about in equilibrium already, so that the laws see the whole stiffness
      !> at once
      logical :: warm = .false.
      !> Whether to damp steps where plain ones do not get there
      logical :: damps = .true.
      !> Iterations after which Newton's method gives up if the residual of the whole structure to the loads is larger than
      !> one could hope for then
      integer :: trial = huge(1)
      real(wp) :: hope = huge(1.0_wp)
   end type control_type

   !> How a load step ended
   type :: verdict_type
      !> Whether it reached equilibrium
      logical :: converged = .false.
      !> Whether the residual stopped falling, whether it is down to rounding then,
      !> and whether the jumps ran away
      logical :: stalled = .false., at_rounding = .false., ran_away = .false.
      !> Rigid motions that the joints do not resist at the end
      type(mechanism_type) :: mechanism
      !> Points times planes that changed their state among the last iterations,
      !> shape (points, planes); allocated if not converged
      logical, allocatable :: restless(:, :)
      !> Passes in which bonds broke or points softened
      integer :: n_passes = 0
      !> The largest ratio of residual forces at the end
      type(strictest_type) :: residual
   end type verdict_type

   !> A method
   type, abstract :: method_type
      !> Whether stress is accumulated over the iterations, as in the paper, instead of following
      !> from total jumps. Then states claim no more than the residual ratio of Eq. 17, and there is
      !> no memory to start halves of a step from
      logical :: accumulates = .false.
   contains
      !> What an iterate leaves without equilibrium
      procedure :: evaluate => evaluate_total
      !> Iterate a load step to equilibrium
      procedure(balance_procedure), deferred :: balance
   end type method_type

   abstract interface
      !> Iterate a load step to equilibrium
      subroutine balance_procedure(self, condensed, scene, control, field, path, verdict)
         import :: method_type, condensed_type, scene_type, control_type, joint_field_type, &
            iteration_type, verdict_type
         !> The method
         class(method_type), intent(in) :: self
         !> The condensed structure
         type(condensed_type), intent(in) :: condensed
         !> Laws, planes and loads; residuals are held against the reference of its loads
         type(scene_type), intent(in) :: scene
         !> When to end
         type(control_type), intent(in) :: control
         !> State of the joints: of the last step, then of this one
         type(joint_field_type), intent(inout) :: field
         !> Convergence path, to be continued
         type(iteration_type), allocatable, intent(inout) :: path(:)
         !> How it ended
         type(verdict_type), intent(out) :: verdict
      end subroutine balance_procedure
   end interface

contains

   !> Excess stress that is not yet transferred, from total jumps
   subroutine evaluate_total(self, condensed, scene, field, residual, judged)
      !> The method
      class(method_type), intent(in) :: self
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints; jumps and stresses follow its excess stress
      type(joint_field_type), intent(inout) :: field
      !> The amplitudes, shape (3, points, modes)
      real(wp), intent(out) :: residual(:, :, :)
      !> Whether the laws see the jumps as a state is judged; false if absent
      logical, intent(in), optional :: judged

      associate (unused => self)
      end associate
      call evaluate(condensed, scene, field, residual, judged)
   end subroutine evaluate_total

end module axijoint_joints_method
