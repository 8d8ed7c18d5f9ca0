!> States of the joints, and of bodies that yield, that are kept, one an increment
module axijoint_joints_states
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: increment_state_type, plastic_state_type, append_state

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
      !> Stress before loading that the joints had, shape (3, points)
      real(wp), allocatable :: initial(:, :)
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

contains

   !> Append a state to others. What these hold is moved, not copied: of long histories it is most of the memory
   subroutine append_state(states, state)
      !> The others
      type(increment_state_type), allocatable, intent(inout) :: states(:)
      !> The state
      type(increment_state_type), intent(in) :: state

      type(increment_state_type), allocatable :: longer(:)
      integer :: k

      allocate (longer(size(states) + 1))
      do k = 1, size(states)
         call move_state(states(k), longer(k))
      end do
      longer(size(longer)) = state
      call move_alloc(longer, states)
   end subroutine append_state

   !> Move a state: all that the type has, as history_record.f90 writes it
   subroutine move_state(from, to)
      !> From there; empty on return
      type(increment_state_type), intent(inout) :: from
      !> There
      type(increment_state_type), intent(inout) :: to

      to%increment = from%increment
      to%load_factor = from%load_factor
      call move_alloc(from%case_factor, to%case_factor)
      call move_alloc(from%peak_factor, to%peak_factor)
      call move_alloc(from%jump, to%jump)
      call move_alloc(from%stress, to%stress)
      call move_alloc(from%initial, to%initial)
      call move_alloc(from%state, to%state)
      call move_alloc(from%excess, to%excess)
      call move_alloc(from%pending, to%pending)
      call move_alloc(from%offset, to%offset)
      call move_bodies(from%bodies, to%bodies)
   end subroutine move_state

   !> Move what bodies that yield have, all of the type, too
   subroutine move_bodies(from, to)
      !> From there; empty on return
      type(plastic_state_type), intent(inout) :: from
      !> There
      type(plastic_state_type), intent(inout) :: to

      call move_alloc(from%place, to%place)
      call move_alloc(from%taken, to%taken)
      call move_alloc(from%gained, to%gained)
      call move_alloc(from%amplitude, to%amplitude)
      call move_alloc(from%carried, to%carried)
      call move_alloc(from%dissipation, to%dissipation)
      to%dissipated = from%dissipated
      to%iterations = from%iterations
      to%solutions = from%solutions
      to%on_planes = from%on_planes
      to%n_yielding = from%n_yielding
   end subroutine move_bodies

end module axijoint_joints_states
