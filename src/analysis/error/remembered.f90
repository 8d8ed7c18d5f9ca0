!> What the mesh left wrong under loads that acted before: in what joints that slipped then, and hold now, remember
module axijoint_analysis_error_remembered
   use axijoint_analysis_core_increment_fields, only : solve_increments
   use axijoint_analysis_core_solution, only : solved_state_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type, opening_bond
   use axijoint_joints_field, only : joint_field_type, commit_field
   use axijoint_joints_history, only : history_type, new_state, turning_places, most_turns
   use axijoint_joints_loads, only : joint_loads_type, put_loads
   use axijoint_joints_planes, only : synthesize
   use axijoint_joints_scene, only : scene_type, motion_of
   use axijoint_joints_settle, only : find_again
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: way_type, lag_type, look_back, find_remembered, shift, add_slip

   !> Increments that the way is followed through at most
   integer, parameter :: most_increments = 100
   !> Stress that may be missing, over the stress, where the way is followed as it was
   real(wp), parameter :: few_digits = 1.0e-6_wp

   !> Where loads turn, and what the mesh leaves there
   type :: turn_type
      !> Factors of the load cases, and the loads as joints see them
      real(wp), allocatable :: case_factor(:)
      type(joint_loads_type) :: loads
      !> Joints before their slip was added to what they remember
      type(joint_field_type) :: field
      !> Errors of the jumps of joints that yield while their stress is held, amplitudes, shape (3, points, modes)
      real(wp), allocatable :: error(:, :, :)
   end type turn_type

   !> What joints would be without the errors of the mesh, less what they are
   type :: lag_type
      !> Whether it was found
      logical :: known = .false.
      !> Slip that they remember, shape (3, points, planes)
      real(wp), allocatable :: slip(:, :, :)
      !> Excess stress, amplitudes, shape (3, points, modes), and multiples of the floating motions
      real(wp), allocatable :: excess(:, :, :), offset(:)
   end type lag_type

   !> The way that loads took
   type :: way_type
      !> Whether it is known
      logical :: known = .false.
      !> Places of the states after which loads turned, and their displacements
      integer, allocatable :: places(:)
      type(solved_state_type), allocatable :: solved(:)
      !> Loads there, and at the end
      type(turn_type), allocatable :: turns(:)
      !> What joints remember before the last increment, shape (points, planes)
      type(memory_type), allocatable :: memory(:, :)
   end type way_type

contains

   !> Look back on the way that loads took: where they turned
   subroutine look_back(model, structure, history, way)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Takes the way
      type(way_type), intent(out) :: way

      type(memory_type), allocatable :: memory(:, :)
      logical :: found

      if (any(history%scene%laws%opening == opening_bond .or. history%scene%laws%softens)) return
      way%places = turning_places(history)
      if (size(way%places) > most_turns .or. size(history%states) > most_increments) return
      call load_turns(model, structure, history, way, found)
      if (found) call follow(structure, history, way, memory, found)
      way%known = found
      if (found) call move_alloc(memory, way%memory)
   end subroutine look_back

   !> What joints would be before the last increment without the errors of the mesh, less what they are: the way is gone again with
   !> the errors where loads turned, and between in proportion to the loads
   subroutine find_remembered(structure, history, errors, way, lag)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Errors where loads turned and at the end, while the stress of the joints is held
      type(mesh_error_type), intent(in) :: errors(:)
      !> The way, known
      type(way_type), intent(inout) :: way
      !> The difference
      type(lag_type), intent(out) :: lag

      type(memory_type), allocatable :: better(:, :)
      logical :: found
      integer :: i

      if (.not. all(errors%known)) return
      do i = 1, size(errors)
         way%turns(i)%error = errors(i)%jump(:, structure%yielding, :)
      end do
      call follow(structure, history, way, better, found, lag)
      lag%known = found
      if (.not. found) return
      allocate (lag%slip(3, size(better, 1), size(better, 2)))
      do i = 1, 3
         lag%slip(i, :, :) = better%slip(i) - way%memory%slip(i)
      end do
   end subroutine find_remembered

   !> Find loads where they turn, and what they do
   subroutine load_turns(model, structure, history, way, found)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The way; takes loads and displacements
      type(way_type), intent(inout) :: way
      !> Whether they were found
      logical, intent(out) :: found

      type(error_type), allocatable :: error
      integer :: i, n

      n = size(way%places)
      allocate (way%solved(n), way%turns(n + 1))
      call solve_increments(model, structure, history%states, way%places, way%solved, error)
      found = .not. allocated(error)
      if (.not. found) return
      do i = 1, n
         way%turns(i)%case_factor = history%states(way%places(i))%case_factor
         way%turns(i)%loads = history%scene%loads
         call put_loads(structure%equations, structure%condensed, way%solved(i)%loading, way%turns(i)%loads)
      end do
      way%turns(n + 1)%case_factor = history%loading%case_factor
      way%turns(n + 1)%loads = history%scene%loads
   end subroutine load_turns

   !> Follow the increments but the last
   subroutine follow(structure, history, way, memory, found, lag)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The way; takes the states where loads turn if no errors act
      type(way_type), intent(inout) :: way
      !> What joints remember in the end, shape (points, planes)
      type(memory_type), allocatable, intent(inout) :: memory(:, :)
      !> Whether all states were found
      logical, intent(out) :: found
      !> Lets the errors of the mesh act, and takes by what the states differ from those that were kept then: where nothing but slip on
      !> the way tells where parts stand, the next begins there
      type(lag_type), intent(inout), optional :: lag

      type(joint_field_type) :: field
      type(scene_type) :: scene
      type(memory_type), allocatable :: start(:, :)
      integer :: k, t

      found = .true.
      field = new_state(structure%condensed, history%scene)
      scene = history%scene
      t = 1
      do k = 1, size(history%states)
         call begin(structure, history, history%states(k), field)
         if (present(lag)) call shift(structure, history%scene, lag, field)
         call set_loads(way%turns, t, history%states(k)%case_factor, present(lag), scene)
         start = field%memory
         if (present(lag)) then
            call find_again(structure%condensed, scene, start, field, found)
         else
            call find_again(structure%condensed, scene, start, field, found, enough=few_digits)
         end if
         if (.not. found) return
         if (any(way%places == k)) then
            if (.not. present(lag)) way%turns(t)%field = field
            t = t + 1
         end if
         if (present(lag)) then
            lag%excess = field%excess - history%states(k)%excess
            lag%offset = field%offset - history%states(k)%offset
         end if
         call commit_field(scene%laws, field)
      end do
      memory = field%memory
   end subroutine follow

   !> Begin from a state as it was kept
   subroutine begin(structure, history, state, field)
      !> The structure
      type(structure_type), intent(in) :: structure
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
      field%moved = synthesize(history%scene%planes, motion_of(structure%condensed, history%scene, field%offset))
   end subroutine begin

   !> Let a state begin where it would be
   subroutine shift(structure, scene, lag, field)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Planes
      type(scene_type), intent(in) :: scene
      !> By what it lags; nothing if not allocated
      type(lag_type), intent(in) :: lag
      !> The state
      type(joint_field_type), intent(inout) :: field

      if (allocated(lag%slip)) call add_slip(lag%slip, field%memory)
      if (.not. allocated(lag%excess)) return
      field%excess = field%excess + lag%excess
      field%offset = field%offset + lag%offset
      field%moved = synthesize(scene%planes, motion_of(structure%condensed, scene, field%offset))
   end subroutine shift

   !> Add slip to what points remember
   pure subroutine add_slip(slip, memory)
      !> The slip, shape (3, points, planes)
      real(wp), intent(in) :: slip(:, :, :)
      !> What they remember, shape (points, planes)
      type(memory_type), intent(inout) :: memory(:, :)

      integer :: i

      do i = 1, 3
         memory%slip(i) = memory%slip(i) + slip(i, :, :)
      end do
   end subroutine add_slip

   !> Loads on the way to a turn
   subroutine set_loads(turns, t, case_factor, with_errors, scene)
      !> The turns, and the next
      type(turn_type), intent(in) :: turns(:)
      integer, intent(in) :: t
      !> Factors of the load cases
      real(wp), intent(in) :: case_factor(:)
      !> Whether the errors of the mesh act, too
      logical, intent(in) :: with_errors
      !> Takes the loads
      type(scene_type), intent(inout) :: scene

      real(wp) :: share, from(size(case_factor))

      from = 0.0_wp
      if (t > 1) from = turns(t - 1)%case_factor
      associate (way => turns(t)%case_factor - from, to => turns(t))
         share = 0.0_wp
         if (norm2(way) > 0.0_wp) share = dot_product(case_factor - from, way)/dot_product(way, way)
         scene%loads%free = share*to%loads%free
         scene%loads%largest = to%loads%largest
         scene%loads%work = share*to%loads%work
         if (with_errors) scene%loads%free = scene%loads%free + share*to%error
         if (t == 1) return
         associate (last => turns(t - 1))
            scene%loads%free = scene%loads%free + (1.0_wp - share)*last%loads%free
            scene%loads%work = scene%loads%work + (1.0_wp - share)*last%loads%work
            if (with_errors) scene%loads%free = scene%loads%free + (1.0_wp - share)*last%error
         end associate
      end associate
   end subroutine set_loads

end module axijoint_analysis_error_remembered
