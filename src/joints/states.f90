!> States of the joints, and of bodies that yield, that are kept, one an increment
module axijoint_joints_states
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: increment_state_type, plastic_state_type

   !> Bodies that yield at the end of an increment
   type :: plastic_state_type
      !> Places of the points that have yielded among the Gauss points of all elements; not
      !> allocated if no body can yield
      integer, allocatable :: place(:)
      !> Elastic stress that plastic strain takes of them, shape (6, points, planes), and plastic
      !> strain by which they have hardened, shape (points, planes)
      real(wp), allocatable :: taken(:, :, :), gained(:, :)
      !> Amplitudes of that stress, and of that which the displacements follow from, shape
      !> (6, points, modes)
      real(wp), allocatable :: amplitude(:, :, :), carried(:, :, :)
      !> Work that plastic strain has dissipated so far [force length]
      real(wp) :: dissipated = 0.0_wp
      !> The same per volume in this increment, or in the last before it that had any step in
      !> equilibrium, shape (points, planes) [stress]
      real(wp), allocatable :: dissipation(:, :)
      !> Iterations and elastic solutions of the increment, share of the points of these bodies that
      !> planes were needed for, and how many yield on any plane at its end
      integer :: iterations = 0, solutions = 0
      real(wp) :: on_planes = 0.0_wp
      integer :: n_yielding = 0
   end type plastic_state_type

   !> The end of an increment: what is needed to find all fields again. The arrays of joints are of
   !> those that can yield, and not allocated if there are none
   type :: increment_state_type
      !> Increment
      integer :: increment = 0
      !> Sum of the load factors
      real(wp) :: load_factor = 0.0_wp
      !> Factor of each load case, and those of the largest loads so far, which residuals are held against
      real(wp), allocatable :: case_factor(:), peak_factor(:)
      !> Relative displacement and stress, shape (3, points, planes)
      real(wp), allocatable :: jump(:, :, :), stress(:, :, :)
      !> Stick, slip or open, shape (points, planes)
      integer, allocatable :: state(:, :)
      !> Amplitudes of the stress that was not admitted, and of what the last iteration changed of
      !> it, shape (3, points, modes)
      real(wp), allocatable :: excess(:, :, :), pending(:, :, :)
      !> Where the parts stand from which displacements count: multiples of the floating motions
      real(wp), allocatable :: offset(:)
      !> Bodies that yield
      type(plastic_state_type) :: bodies
   end type increment_state_type

end module axijoint_joints_states
