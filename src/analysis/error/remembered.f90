!> What the mesh left wrong under loads that acted before: in what joints that slipped then, and hold now, remember
module axijoint_analysis_error_remembered
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_increment_fields, only : solve_increments
   use axijoint_analysis_core_solution, only : solved_state_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_error_follower, only : follower_type, pass_state, end_way
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : opening_bond
   use axijoint_joints_field, only : joint_field_type, commit_field
   use axijoint_joints_history, only : history_type, new_state, turning_places, most_turns
   use axijoint_joints_loads, only : put_loads
   use axijoint_joints_scene, only : scene_type
   use axijoint_joints_way, only : station_type, way_type, lag_type, take_up, go_again, remembered
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: solved_way_type, look_back, follow_way, leaves_rest, find_remembered

   !> Increments that the way is followed through at most
   integer, parameter :: most_increments = 100

   !> The way that loads took
   type, extends(way_type) :: solved_way_type
      !> Loads and displacements where these turned
      type(solved_state_type), allocatable :: solved(:)
   end type solved_way_type

contains

   !> Look back on the way that loads took: where they turned, and displacements there
   subroutine look_back(model, structure, history, earlier, way)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Fields at their ends that are known
      type(fields_type), intent(in), optional :: earlier(:)
      !> Takes the way
      type(solved_way_type), intent(inout) :: way

      if (size(history%states) == 0) return
      if (any(history%scene%laws%opening == opening_bond .or. history%scene%laws%softens)) return
      way%places = turning_places(history)
      if (size(way%places) > most_turns .or. size(history%states) > most_increments) return
      call load_turns(model, structure, history, earlier, way)
   end subroutine look_back

   !> Find loads where they turn, and what they do
   subroutine load_turns(model, structure, history, earlier, way)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Fields at their ends that are known
      type(fields_type), intent(in), optional :: earlier(:)
      !> The way; takes loads and displacements, and whether they were found
      type(solved_way_type), intent(inout) :: way

      type(error_type), allocatable :: error
      integer :: i, n

      n = size(way%places)
      allocate (way%solved(n), way%turns(n + 1))
      call solve_increments(model, structure, history%states, way%places, way%solved, error, earlier)
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

   !> Follow the way, if it is known, to its stations
   subroutine follow_way(structure, history, way, follower)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The way; takes the stations. Not known any more if a state was not found as it was kept
      type(solved_way_type), intent(inout) :: way
      !> Follows behind with more harmonics; what it finds is of no meaning if the way is not known
      type(follower_type), intent(inout) :: follower

      if (way%known) call follow(structure, history, way, follower)
      if (.not. way%known) way%stations = [station_type ::]
      call end_way(follower)
   end subroutine follow_way

   !> Follow the increments but the last, as they were
   subroutine follow(structure, history, way, follower)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The way; takes the stations, and whether all states were found as they were kept
      type(solved_way_type), intent(inout) :: way
      !> Follows behind
      type(follower_type), intent(inout) :: follower

      type(joint_field_type) :: field
      type(scene_type) :: scene
      type(station_type) :: station
      integer :: k

      field = new_state(structure%condensed, history%scene)
      scene = history%scene
      do k = 1, size(history%states)
         call take_up(structure%condensed, history, way%turns, k, station, scene, field, way%known)
         if (.not. way%known) return
         station%loads = scene%loads
         station%field = field
         if (any(way%places == k) .or. k == size(history%states)) way%stations = [way%stations, station]
         call pass_state(structure%condensed, history%scene, station, follower)
         if (any(way%places == k)) station%next = station%next + 1
         call commit_field(scene%laws, field)
      end do
   end subroutine follow

   !> Whether more than half of a load case, or of the loads of a mode, was taken away: what is left of displacements, and of their
   !> errors, is the rest of larger ones, and known less well
   pure logical function leaves_rest(way)
      !> The way, known
      type(solved_way_type), intent(in) :: way

      !> Part up to which most of the loads is gone, a little less than half, as who lets go half means that; and part of all loads
      !> from which those of a mode count
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
      type(solved_way_type), intent(in) :: way
      !> The difference
      type(lag_type), intent(out) :: lag

      type(joint_field_type) :: field
      type(scene_type) :: scene
      integer :: i

      if (.not. all(errors%known)) return
      scene = history%scene
      do i = 1, size(way%stations)
         associate (station => way%stations(i), yielding => structure%yielding)
            field = station%field
            scene%loads = station%loads
            scene%loads%free = scene%loads%free + station%part*errors(station%next)%jump(:, yielding, :)
            if (station%next > 1) scene%loads%free = scene%loads%free &
               + (1.0_wp - station%part)*errors(station%next - 1)%jump(:, yielding, :)
            call go_again(structure%condensed, scene, remembered(scene%laws, station%field), station%field, field, lag)
         end associate
         if (.not. lag%known) return
      end do
   end subroutine find_remembered

end module axijoint_analysis_error_remembered
