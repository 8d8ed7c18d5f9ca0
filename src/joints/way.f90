!> The way that loads took before the last increment, for what joints that slipped on it remember
module axijoint_joints_way
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : joint_law_type, memory_type
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, commit_field
   use axijoint_joints_history, only : history_type
   use axijoint_joints_loads, only : joint_loads_type
   use axijoint_joints_planes, only : synthesize
   use axijoint_joints_scene, only : scene_type, motion_of
   use axijoint_joints_settle, only : find_again, roughly
   use axijoint_joints_states, only : increment_state_type
   implicit none
   private
   public :: turn_type, station_type, way_type, lag_type, take_up, go_again, remembered, shift, add_slip

   !> Stress that may be missing, over the stress, where the way is followed as it was; and how far jumps may be from those that were
   !> kept, over these
   real(wp), parameter :: few_digits = 1.0e-6_wp, little = 1.0e-3_wp

   !> Where loads turn
   type :: turn_type
      !> Factors of the load cases, and the loads as joints see them
      real(wp), allocatable :: case_factor(:)
      type(joint_loads_type) :: loads
   end type turn_type

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

   !> The way that loads took
   type :: way_type
      !> Whether it is known, and slip that came about on it lasts
      logical :: known = .false.
      !> Places of the states after which loads turned
      integer, allocatable :: places(:)
      !> Loads there, and at the end
      type(turn_type), allocatable :: turns(:)
      !> States there, and the last before the last increment; none if the way is not known, in any case allocated
      type(station_type), allocatable :: stations(:)
   end type way_type

   !> What joints would be without an approximation, less what they are
   type :: lag_type
      !> Whether it was found
      logical :: known = .false.
      !> Slip that they remember, shape (3, points, planes)
      real(wp), allocatable :: slip(:, :, :)
      !> Excess stress, amplitudes, shape (3, points, modes), and multiples of the floating motions
      real(wp), allocatable :: excess(:, :, :), offset(:)
      !> Time that it took to find [second]
      real(wp) :: seconds = 0.0_wp
   end type lag_type

contains

   !> Take up a state as it was kept, after the increments before it
   subroutine take_up(condensed, history, turns, k, station, scene, field, found)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Where loads turn, and the end
      type(turn_type), intent(in) :: turns(:)
      !> Which state
      integer, intent(in) :: k
      !> The station on the way to the next turn; takes the part of the way
      type(station_type), intent(inout) :: station
      !> Takes the loads
      type(scene_type), intent(inout) :: scene
      !> What joints remember from before; takes the state
      type(joint_field_type), intent(inout) :: field
      !> Whether it was found, and is the one that was kept: from the beginning of an increment that was halved another may be found,
      !> and what is told of that is of no meaning
      logical, intent(out) :: found

      type(memory_type), allocatable :: start(:, :)

      call begin(condensed, history, history%states(k), field)
      call set_loads(turns, history%states(k)%case_factor, station, scene)
      start = field%memory
      call find_again(condensed, scene, start, field, found, enough=few_digits)
      if (found) found = maxval(abs(field%jump(:, :, history%scene%planes%place) - history%states(k)%jump)) &
         <= little*maxval(abs(field%jump))
   end subroutine take_up

   !> Begin from a state as it was kept
   subroutine begin(condensed, history, state, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> What the increments came to, for the planes
      type(history_type), intent(in) :: history
      !> The state
      type(increment_state_type), intent(in) :: state
      !> Takes it, but for what it remembers
      type(joint_field_type), intent(inout) :: field

      field%initial = state%initial
      associate (place => history%scene%planes%place)
         field%jump(:, :, place) = state%jump
         field%stress(:, :, place) = state%stress
         field%state(:, place) = state%state
      end associate
      field%carried = field%stress
      field%excess = state%excess
      field%pending = state%pending
      field%offset = state%offset
      field%moved = synthesize(history%scene%planes, motion_of(condensed, history%scene, field%offset))
   end subroutine begin

   !> Loads on the way to a turn, in proportion
   subroutine set_loads(turns, case_factor, station, scene)
      !> The turns
      type(turn_type), intent(in) :: turns(:)
      !> Factors of the load cases
      real(wp), intent(in) :: case_factor(:)
      !> The station, with the next turn; takes the part of the way
      type(station_type), intent(inout) :: station
      !> Takes the loads
      type(scene_type), intent(inout) :: scene

      real(wp) :: from(size(case_factor))

      from = 0.0_wp
      if (station%next > 1) from = turns(station%next - 1)%case_factor
      associate (way => turns(station%next)%case_factor - from, to => turns(station%next), part => station%part)
         part = 0.0_wp
         if (norm2(way) > 0.0_wp) part = dot_product(case_factor - from, way)/dot_product(way, way)
         scene%loads%free = part*to%loads%free
         scene%loads%largest = to%loads%largest
         scene%loads%work = part*to%loads%work
         if (station%next == 1) return
         associate (last => turns(station%next - 1))
            scene%loads%free = scene%loads%free + (1.0_wp - part)*last%loads%free
            scene%loads%work = scene%loads%work + (1.0_wp - part)*last%loads%work
         end associate
      end associate
   end subroutine set_loads

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

   !> Find a state again without an approximation: it begins where it would be by what it lagged before
   subroutine go_again(condensed, scene, memory, before, field, lag)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes, modes and loads without the approximation
      type(scene_type), intent(in) :: scene
      !> What joints remember after the state as it was, on these planes, shape (points, planes)
      type(memory_type), intent(in) :: memory(:, :)
      !> That state
      type(joint_field_type), intent(in) :: before
      !> The same in this scene; takes the one that is found
      type(joint_field_type), intent(inout) :: field
      !> By what it lagged before, if that is known; takes by what it lags now, not known if no state was found
      type(lag_type), intent(inout) :: lag

      type(memory_type), allocatable :: start(:, :)
      logical :: found

      call shift(condensed, scene, lag, field)
      start = field%memory
      call find_again(condensed, scene, start, field, found, share=roughly)
      if (found) call find_lag(memory, before, scene%laws, field, lag)
      lag%known = found
   end subroutine go_again

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
