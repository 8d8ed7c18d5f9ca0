!> The way that loads took before the last increment, for what joints that slipped on it remember
module axijoint_joints_way
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : joint_law_type, memory_type
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, commit_field
   use axijoint_joints_loads, only : joint_loads_type
   use axijoint_joints_planes, only : synthesize
   use axijoint_joints_scene, only : scene_type, motion_of
   implicit none
   private
   public :: station_type, lag_type, remembered, find_lag, shift, add_slip

   !> A state on the way: where loads turned, or the last before the last increment
   type :: station_type
      !> Loads as joints see them
      type(joint_loads_type) :: loads
      !> Joints before their slip was added to what they remember
      type(joint_field_type) :: field
      !> The turn that it is on the way to, or the end after the last, and the part of the way to it from the turn before
      integer :: next = 1
      real(wp) :: part = 1.0_wp
   end type station_type

   !> What joints would be without an approximation, less what they are
   type :: lag_type
      !> Whether it was found
      logical :: known = .false.
      !> Slip that they remember, shape (3, points, planes)
      real(wp), allocatable :: slip(:, :, :)
      !> Excess stress, amplitudes, shape (3, points, modes), and multiples of the floating motions
      real(wp), allocatable :: excess(:, :, :), offset(:)
   end type lag_type

contains

   !> What joints remember after a state
   pure function remembered(laws, field) result(memory)
      !> The laws
      type(joint_law_type), intent(in) :: laws(:)
      !> The state
      type(joint_field_type), intent(in) :: field
      !> What they remember, shape (points, planes)
      type(memory_type), allocatable :: memory(:, :)

      type(joint_field_type) :: after

      after = field
      call commit_field(laws, after)
      call move_alloc(after%memory, memory)
   end function remembered

   !> The difference between a state and one that was found without an approximation, perhaps with more modes
   pure subroutine find_lag(memory, before, laws, after, lag)
      !> What joints remember after the first state, shape (points, planes)
      type(memory_type), intent(in) :: memory(:, :)
      !> The first state
      type(joint_field_type), intent(in) :: before
      !> The laws
      type(joint_law_type), intent(in) :: laws(:)
      !> The other state
      type(joint_field_type), intent(in) :: after
      !> The difference
      type(lag_type), intent(out) :: lag

      type(memory_type), allocatable :: better(:, :)
      integer :: i

      lag%known = .true.
      better = remembered(laws, after)
      allocate (lag%slip(3, size(memory, 1), size(memory, 2)))
      do i = 1, 3
         lag%slip(i, :, :) = better%slip(i) - memory%slip(i)
      end do
      lag%excess = after%excess
      associate (m => size(before%excess, 3))
         lag%excess(:, :, :m) = lag%excess(:, :, :m) - before%excess
      end associate
      lag%offset = after%offset - before%offset
   end subroutine find_lag

   !> Let a state begin where it would be: where nothing but slip on the way tells where parts stand, it stays there
   subroutine shift(condensed, scene, lag, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Planes
      type(scene_type), intent(in) :: scene
      !> By what it lags; nothing if not known
      type(lag_type), intent(in) :: lag
      !> The state
      type(joint_field_type), intent(inout) :: field

      if (.not. lag%known) return
      call add_slip(lag, field%memory)
      field%excess = field%excess + lag%excess
      field%offset = field%offset + lag%offset
      field%moved = synthesize(scene%planes, motion_of(condensed, scene, field%offset))
   end subroutine shift

   !> Add the slip to what points remember
   pure subroutine add_slip(lag, memory)
      !> By what they lag; nothing if not known
      type(lag_type), intent(in) :: lag
      !> What they remember, shape (points, planes)
      type(memory_type), intent(inout) :: memory(:, :)

      integer :: i

      if (.not. lag%known) return
      do i = 1, 3
         memory%slip(i) = memory%slip(i) + lag%slip(i, :, :)
      end do
   end subroutine add_slip

end module axijoint_joints_way
