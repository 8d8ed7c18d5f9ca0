!> What the joint iterations of all methods share: the condensed structure, and
!> the stress that an iterate leaves without equilibrium
module axijoint_joints_scene
   use axijoint_assembly_equations, only : equations_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type, admit_jump, admit_trial
   use axijoint_joints_planes, only : planes_type, synthesize, analyse
   use axijoint_joints_response, only : response_type, jumps
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type, method_newton, method_transfer
   implicit none
   private
   public :: scene_type, evaluate

   !> All that an iteration needs to know and does not change
   type :: scene_type
      !> The job
      type(model_type), pointer :: model => null()
      !> Joint points that can yield
      type(model_joint_point_type), allocatable :: points(:)
      !> Equations of all modes, factored
      type(equations_type), pointer :: equations => null()
      !> Flexibilities, and jumps from the loads
      type(response_type) :: response
      !> Planes of the joint checks
      type(planes_type) :: planes
      !> How joints are brought to equilibrium, one of the `method_` parameters
      integer :: method = method_newton
      !> Stiffness of the joints in proportion to the bodies, k h/E
      real(wp) :: proportion = 0.0_wp
      !> Share of the joint stiffness that the laws see first
      real(wp) :: first_share = 1.0_wp
   end type scene_type

contains

   !> Excess stress that is not yet transferred, from the jumps that loads and
   !> transferred stress give
   subroutine evaluate(scene, field, residual)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> State of the joints; jumps and stresses follow its excess stress
      type(joint_field_type), intent(inout) :: field
      !> The amplitudes, shape (3, points, modes)
      real(wp), intent(out) :: residual(:, :, :)

      real(wp), allocatable :: total(:, :, :), excess(:, :, :)

      total = synthesize(scene%planes, jumps(scene%response, field%excess, free=.true.))
      if (scene%method == method_transfer) then
         call accumulate(scene, total, field, residual)
      else
         excess = total  ! for its shape
         call admit_jump(scene%model, scene%points, total, field, excess)
         residual = analyse(scene%planes, excess) - field%excess
      end if
   end subroutine evaluate

   !> Steps 2 to 4 of the paper: the stress is accumulated over the iterations,
   !> and what the law cuts off goes to the next residual
   subroutine accumulate(scene, total, field, residual)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Jumps on the planes
      real(wp), intent(in) :: total(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> What was cut off, amplitudes
      real(wp), intent(out) :: residual(:, :, :)

      real(wp), allocatable :: trial(:, :, :)
      integer :: k

      trial = field%stress
      do k = 1, size(scene%points)
         associate (law => scene%model%joint_materials(scene%points(k)%material)%law)
            trial(:, k, :) = trial(:, k, :) + spread(law%stiffness, 2, size(total, 3)) &
               *(total(:, k, :) - field%jump(:, k, :))
         end associate
      end do
      field%jump = total
      call admit_trial(scene%model, scene%points, trial, field)
      residual = analyse(scene%planes, trial - field%stress)
   end subroutine accumulate

end module axijoint_joints_scene
