!> Bodies that stand free move under their load until joints touch, before anything deforms: contact
!> by contact, as rigid bodies
module axijoint_joints_approach
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : xi, eta, theta
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, trial_of
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism
   use axijoint_joints_planes, only : synthesize, analyse
   use axijoint_joints_scene, only : scene_type, evaluate, elastic_stress, motion_of, &
      multiples_of_motions
   implicit none
   private
   public :: approach

   !> Pressure at the points that touch, as a share of the joint stress that the load would give if
   !> all joints held
   real(wp), parameter :: touch = 1.0e-3_wp
   !> Contacts that are followed at most: so many for each motion. A gap round a body closes point by point, and where that ends
   !> is where friction begins
   integer, parameter :: most_contacts = 40
   !> Jumps that are rounding of a motion along the joint, over the largest: they close nothing
   real(wp), parameter :: rounding = 1.0e-10_wp

contains

   !> Move the parts that joints do not hold under load until they do
   subroutine approach(condensed, scene, sticking, before, field, residual, moved)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Whether points with any friction or cohesion count as sticking where they touch
      logical, intent(in) :: sticking
      !> Jumps of the state that the load step begins with, shape (3, points, planes)
      real(wp), intent(in) :: before(:, :, :)
      !> State of the joints, its stresses evaluated; points that touch or stand open carry no shear
      !> where they stand
      type(joint_field_type), intent(inout) :: field
      !> Excess stress that is not transferred
      real(wp), intent(inout) :: residual(:, :, :)
      !> Whether anything moved
      logical, intent(out) :: moved

      type(mechanism_type) :: mechanism
      real(wp), allocatable :: jump(:, :, :)
      real(wp) :: way
      integer :: contact

      moved = .false.
      do contact = 0, most_contacts*size(condensed%floating)
         call find_mechanism(condensed, scene, field, sticking, mechanism)
         if (.not. mechanism%loaded) return
         jump = synthesize(scene%planes, motion_of(condensed, scene, mechanism%motion))
         way = way_to_contact(condensed, scene, field, jump)
         if (.not. way < huge(way)) return
         moved = .true.
         field%offset = field%offset + way*mechanism%motion
         call stand_free(condensed, scene, way*jump, before, field)
         call evaluate(condensed, scene, field, residual)
      end do
   end subroutine approach

   !> How far a motion goes until a point that stands open is pressed a little; the largest number
   !> if none is
   function way_to_contact(condensed, scene, field, jump) result(way)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Jumps of the motion, shape (3, points, planes)
      real(wp), intent(in) :: jump(:, :, :)
      !> In units of the motion
      real(wp) :: way

      real(wp) :: pressure, trial(3), stiffness, least
      integer :: j, k

      way = huge(way)
      least = rounding*maxval(abs(jump))
      pressure = touch*maxval(abs(elastic_stress(condensed, scene, field)))
      do j = 1, size(jump, 3)
         do k = 1, size(jump, 2)
            if (.not. jump(eta, k, j) < -least) cycle
            stiffness = field%share(k)*scene%laws(k)%stiffness(eta)
            trial = trial_of(scene%laws(k), k, j, field%jump(:, k, j), field)
            if (trial(eta) > 0.0_wp) &
               way = min(way, (trial(eta) + pressure)/(-stiffness*jump(eta, k, j)))
         end do
      end do
   end function way_to_contact

   !> Points that stood open when the load step began start without shear where rigid motions bring
   !> them: what the bodies would deform if all joints held has not happened when they touch. Those
   !> that touched then keep where they stuck, though they are open on the way
   subroutine stand_free(condensed, scene, jump, before, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Jumps of the motion, and of the state that the load step begins with, shape (3, points,
      !> planes)
      real(wp), intent(in) :: jump(:, :, :), before(:, :, :)
      !> State of the joints before the motion
      type(joint_field_type), intent(inout) :: field

      real(wp), allocatable :: place(:, :, :)
      real(wp) :: trial(3)
      integer :: i, j, k

      place = analyse(scene%planes, field%jump - before)
      place = before + jump + synthesize(scene%planes, &
         motion_of(condensed, scene, multiples_of_motions(condensed, scene, place)))
      do j = 1, size(jump, 3)
         do k = 1, size(jump, 2)
            if (any(abs(field%stress(:, k, j)) > 0.0_wp)) cycle
            trial = trial_of(scene%laws(k), k, j, before(:, k, j), field)
            if (.not. trial(eta) > 0.0_wp) cycle
            do i = xi, theta, theta - xi
               field%memory(k, j)%slip(i) = place(i, k, j)
            end do
         end do
      end do
      field%carried = field%stress
   end subroutine stand_free

end module axijoint_joints_approach
