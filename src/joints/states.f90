!> States of the joints that are kept, one an increment
module axijoint_joints_states
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: increment_state_type

   !> The end of an increment: what is needed to find all fields again. The arrays of joints are of
   !> those that can yield, and not allocated if there are none
   type :: increment_state_type
      !> Increment
      integer :: increment = 0
      !> Sum of the load factors
      real(wp) :: load_factor = 0.0_wp
      !> Factor of each load case
      real(wp), allocatable :: case_factor(:)
      !> Relative displacement and stress, shape (3, points, planes)
      real(wp), allocatable :: jump(:, :, :), stress(:, :, :)
      !> Stick, slip or open, shape (points, planes)
      integer, allocatable :: state(:, :)
      !> Amplitudes of the stress that was not admitted, and of what the last iteration changed of
      !> it, shape (3, points, modes)
      real(wp), allocatable :: excess(:, :, :), pending(:, :, :)
      !> Where the parts stand from which displacements count: multiples of the floating motions
      real(wp), allocatable :: offset(:)
   end type increment_state_type

end module axijoint_joints_states
