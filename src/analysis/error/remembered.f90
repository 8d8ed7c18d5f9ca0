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
   use axijoint_joints_settle, only : find_again, roughly
   use axijoint_joints_states, only : increment_state_type
   use axijoint_joints_way, only : station_type, lag_type, remembered, find_lag, shift
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: way_type, look_back, leaves_rest, find_remembered

   !> Increments that the way is followed through at most
   integer, parameter :: most_increments = 100
   !> Stress that may be missing, over the stress, where the way is followed as it was; and what of jumps the iteration may have left
   !> then, over these: of that no more is told
   real(wp), parameter :: few_digits = 1.0e-6_wp, little_slip = 1.0e-3_wp

   !> Where loads turn
   type :: turn_type
      !> Factors of the load cases, and the loads as joints see them
      real(wp), allocatable :: case_factor(:)
      type(joint_loads_type) :: loads
   end type turn_type

   !> The way that loads took
   type :: way_type
      !> Whether it is known
      logical :: known = .false.
      !> Places of the states after which loads turned, and their displacements
      integer, allocatable :: places(:)
      type(solved_state_type), allocatable :: solved(:)
      !> Loads there, and at the end
      type(turn_type), allocatable :: turns(:)
      !> States there, and the last before the last increment; none if the way is not known, in any case allocated
      type(station_type), allocatable :: stations(:)
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
      type(way_type), intent(inout) :: way

      if (size(history%states) == 0) return
      if (any(history%scene%laws%opening == opening_bond .or. history%scene%laws%softens)) return
      way%places = turning_places(history)
      if (size(way%places) > most_turns .or. size(history%states) > most_increments) return
      call load_turns(model, structure, history, way)
      if (way%known) call follow(structure, history, way)
      if (.not. way%known) way%stations = [station_type ::]
   end subroutine look_back

   !> Find loads where they turn, and what they do
   subroutine load_turns(model, structure, history, way)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The way; takes loads and displacements, and whether they were found
      type(way_type), intent(inout) :: way

      type(error_type), allocatable :: error
      integer :: i, n

      n = size(way%places)
      allocate (way%solved(n), way%turns(n + 1))
      call solve_increments(model, structure, history%states, way%places, way%solved, error)
      way%known = .not. allocated(error)
      if (.not. way%known) return
      do i = 1, n
         way%turns(i)%case_factor = history%states(way%places(i))%case_factor
         way%turns(i)%loads = history%scene%loads
         call put_loads(structure%equations, structure%condensed, way%solved(i)%loading, way%turns(i)%loads)
      end do
      way%turns(n + 1)%case_factor = history%loading%case_factor
      way%turns(n + 1)%loads = history%scene%loads
   end subroutine load_turns

   !> Follow the increments but the last, as they were
   subroutine follow(structure, history, way)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The way; takes the stations, and whether all states were found as they were kept
      type(way_type), intent(inout) :: way

      type(joint_field_type) :: field
      type(scene_type) :: scene
      type(station_type) :: station
      type(memory_type), allocatable :: start(:, :)
      real(wp) :: off
      integer :: k

      field = new_state(structure%condensed, history%scene)
      scene = history%scene
      station%next = 1
      do k = 1, size(history%states)
         call begin(structure, history, history%states(k), field)
         call set_loads(way%turns, history%states(k)%case_factor, station, scene)
         start = field%memory
         call find_again(structure%condensed, scene, start, field, way%known, enough=few_digits)
         off = maxval(abs(field%jump(:, :, history%scene%planes%place) - history%states(k)%jump))
         way%known = way%known .and. off <= little_slip*maxval(abs(field%jump))
         if (.not. way%known) return
         if (any(way%places == k) .or. k == size(history%states)) then
            station%loads = scene%loads
            station%field = field
            way%stations = [way%stations, station]
            if (any(way%places == k)) station%next = station%next + 1
         end if
         call commit_field(scene%laws, field)
      end do
   end subroutine follow

   !> Whether more than half of a load case, or of the loads of a mode, was taken away: what is left of displacements, and of their
   !> errors, is the rest of larger ones, and known less well
   pure logical function leaves_rest(way)
      !> The way, known
      type(way_type), intent(in) :: way

      !> Part up to which most of the loads is gone: in piles that were let go half, what harmonics left was told as 0.5 to 1.9 times
      !> what it was, with 0.3 of the load as 0.3 to 1.4 times; and part of all loads from which those of a mode count
      real(wp), parameter :: little = 0.49_wp, counts = 0.01_wp
      real(wp) :: loads(size(way%turns), size(way%turns(1)%loads%free, 3)), &
         factors(size(way%turns), size(way%turns(1)%case_factor))
      integer :: i, last

      last = size(way%turns)
      do i = 1, last
         loads(i, :) = maxval(maxval(abs(way%turns(i)%loads%free), 1), 1)
         factors(i, :) = abs(way%turns(i)%case_factor)
      end do
      leaves_rest = any(factors(last, :) < little*maxval(factors, 1)) .or. &
         any(loads(last, :) < little*maxval(loads, 1) .and. maxval(loads, 1) > counts*maxval(loads))
   end function leaves_rest

   !> What joints would be before the last increment without the errors of the mesh, less what they are. The way is gone again from
   !> one turn to the next while the errors act: joints that slip on the way to a turn slip there, and where they have come to is told
   !> by their jumps, so that increments between leave little of their own
   subroutine find_remembered(structure, history, errors, way, lag)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Errors where loads turned and at the end, while the stress of the joints is held
      type(mesh_error_type), intent(in) :: errors(:)
      !> The way, known
      type(way_type), intent(in) :: way
      !> The difference
      type(lag_type), intent(out) :: lag

      type(joint_field_type) :: field
      type(scene_type) :: scene
      type(memory_type), allocatable :: start(:, :)
      logical :: found
      integer :: i

      if (.not. all(errors%known)) return
      scene = history%scene
      do i = 1, size(way%stations)
         associate (station => way%stations(i), yielding => structure%yielding)
            field = station%field
            call shift(structure%condensed, scene, lag, field)
            scene%loads = station%loads
            scene%loads%free = scene%loads%free + station%part*errors(station%next)%jump(:, yielding, :)
            if (station%next > 1) scene%loads%free = scene%loads%free &
               + (1.0_wp - station%part)*errors(station%next - 1)%jump(:, yielding, :)
            start = field%memory
            call find_again(structure%condensed, scene, start, field, found, share=roughly)
            if (found) call find_lag(remembered(scene%laws, station%field), station%field, scene%laws, field, lag)
            lag%known = found
            if (.not. found) return
         end associate
      end do
   end subroutine find_remembered

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

end module axijoint_analysis_error_remembered
