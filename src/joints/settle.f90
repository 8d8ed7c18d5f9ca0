!> Joints that are near to a state of equilibrium, brought to it by Newton's method
module axijoint_joints_settle
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type, opening_bond
   use axijoint_joints_balance, only : verdict_type, balance_step
   use axijoint_joints_field, only : joint_field_type, iteration_type
   use axijoint_joints_newton, only : newton_type, new_newton, newton_step
   use axijoint_joints_scene, only : scene_type, evaluate
   use axijoint_model_model, only : method_newton
   implicit none
   private
   public :: settle, settle_wholly, find_again

   !> Stress that may be missing, over what is missing at first: of an error one digit is enough; over the
   !> stress, where nothing is to be left
   real(wp), parameter :: part = 0.003_wp, strict = 1.0e-10_wp
   !> Tolerance of the linear solutions, and most steps
   real(wp), parameter :: linear_tolerance = 0.01_wp, strict_tolerance = 1.0e-2_wp
   integer, parameter :: most_steps = 12
   !> From the beginning of the increment: residual over the loads, and most iterations
   real(wp), parameter :: pass_tolerance = 1.0e-5_wp, near = 0.03_wp
   integer, parameter :: most_iterations = 100

contains

   !> Find the state of a changed scene. Which bonds break and which points soften is found from the beginning
   !> of the increment, and so is what Newton's method does not reach by itself
   subroutine find_again(scene, start, field, found)
      !> The scene
      type(scene_type), intent(inout) :: scene
      !> What the points remembered at the beginning, shape (points, planes)
      type(memory_type), intent(in) :: start(:, :)
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Whether a state was found
      logical, intent(out) :: found

      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict
      integer :: k, method

      associate (laws => scene%model%joint_materials(scene%points%material)%law)
         if (all([(laws(k)%opening /= opening_bond .and. .not. laws(k)%softens, k=1, size(laws))])) then
            call settle(scene, field, found)
            if (found) return
         end if
      end associate
      field%memory = start
      allocate (path(0))
      method = scene%method
      scene%method = method_newton
      call balance_step(scene, pass_tolerance, most_iterations, iteration_type(), field, path, verdict)
      scene%method = method
      ! a law that jumps may have no state; an iterate that is so near tells by how much stresses change
      found = verdict%converged .or. (verdict%residual%whole <= near .and. .not. verdict%ran_away)
   end subroutine find_again

   !> Go so far that what is missing is a small part of what is missing at first
   subroutine settle(scene, field, found)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Whether a state was found
      logical, intent(out) :: found

      call go_on(scene, part, linear_tolerance, field, found)
   end subroutine settle

   !> Go as far as numbers do
   subroutine settle_wholly(scene, field)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field

      logical :: found

      call go_on(scene, 0.0_wp, strict_tolerance, field, found)
   end subroutine settle_wholly

   !> Steps of Newton's method
   subroutine go_on(scene, share, tolerance, field, found)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> What may be missing, over what is missing at first
      real(wp), intent(in) :: share
      !> Tolerance of the linear solutions
      real(wp), intent(in) :: tolerance
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Whether it was found
      logical, intent(out) :: found

      type(newton_type) :: newton
      real(wp), allocatable :: residual(:, :, :)
      real(wp) :: enough
      logical :: made
      integer :: k

      field%share = 1.0_wp
      allocate (residual, mold=field%excess)
      call evaluate(scene, field, residual)
      field%carried = field%stress
      newton = new_newton(scene, field)
      enough = max(share**2*newton%merit, rounding(scene, field))  ! squares
      made = .true.
      do k = 1, most_steps
         if (newton%merit <= enough .or. .not. made) exit
         call newton_step(scene, 0.0_wp, tolerance, huge(1.0_wp), newton, field, residual, made)
      end do
      found = newton%merit <= enough
   end subroutine go_on

   !> What rounding may leave missing, squared
   pure real(wp) function rounding(scene, field)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field

      integer :: k

      rounding = 0.0_wp
      do k = 1, size(scene%points)
         rounding = rounding + strict**2*scene%points(k)%weight*sum(field%stress(:, k, :)**2)/size(field%stress, 3)
      end do
   end function rounding

end module axijoint_joints_settle
