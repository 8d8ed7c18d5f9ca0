!> States of the joints on so many times more planes: each interval between planes is divided alike
module axijoint_joints_more_planes
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type
   use axijoint_joints_field, only : joint_field_type
   implicit none
   private
   public :: on_planes, on_planes_memory, slip_on_planes

contains

   !> A state with so many times more planes
   pure function on_planes(field, step, count) result(state)
      !> The state
      type(joint_field_type), intent(in) :: field
      !> How many times, and the number of planes then
      integer, intent(in) :: step, count
      !> The state there; its stresses are those of the plane before
      type(joint_field_type) :: state

      integer :: j, place(count)

      place = [((j - 1)/step + 1, j=1, count)]
      state = field
      state%memory = on_planes_memory(field%memory, step, count)
      state%jump = field%jump(:, :, place)
      state%stress = field%stress(:, :, place)
      state%carried = field%carried(:, :, place)
      state%moved = field%moved(:, :, place)
      state%state = field%state(:, place)
   end function on_planes

   !> What is remembered on so many times more planes: of slip what lies between the neighbours of a
   !> new plane, else what the plane before it does
   pure function on_planes_memory(memory, step, count) result(finer)
      !> Memory, shape (points, planes)
      type(memory_type), intent(in) :: memory(:, :)
      !> How many times, and the number of planes then
      integer, intent(in) :: step, count
      !> Memory on the planes
      type(memory_type) :: finer(size(memory, 1), count)

      real(wp) :: slip(3, size(memory, 1), size(memory, 2)), more_slip(3, size(memory, 1), count)
      integer :: i, j

      do i = 1, 3
         slip(i, :, :) = memory%slip(i)
      end do
      more_slip = slip_on_planes(slip, step, count)
      finer = memory(:, [((j - 1)/step + 1, j=1, count)])
      do i = 1, 3
         finer%slip(i) = more_slip(i, :, :)
      end do
   end function on_planes_memory

   !> Slip on so many times more planes: what lies between the neighbours of a new plane
   pure function slip_on_planes(slip, step, count) result(finer)
      !> Slip, shape (3, points, planes)
      real(wp), intent(in) :: slip(:, :, :)
      !> How many times, and the number of planes then
      integer, intent(in) :: step, count
      !> Slip on the planes
      real(wp) :: finer(3, size(slip, 2), count)

      real(wp) :: fraction
      integer :: j, place, next

      do j = 1, count
         place = (j - 1)/step + 1
         next = 1 + mod(place, size(slip, 3))
         fraction = real(mod(j - 1, step), wp)/step
         finer(:, :, j) = (1.0_wp - fraction)*slip(:, :, place) + fraction*slip(:, :, next)
      end do
   end function slip_on_planes

end module axijoint_joints_more_planes
