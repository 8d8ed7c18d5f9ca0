!> What planes and harmonics leave of the error of joints: the state is found again on
!> the condensed structure, on more planes, with more harmonics
module axijoint_joints_joint_errors
   use omp_lib, only : omp_get_wtime
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_harmonics_tail, only : beyond_twice
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_change, only : joint_change_type, no_change, offset_between, largest_change, changes_of_points
   use axijoint_joints_more_harmonics, only : add_harmonics
   use axijoint_joints_more_planes, only : on_planes, on_planes_memory, slip_on_planes
   use axijoint_joints_planes, only : new_planes, synthesize
   use axijoint_joints_scene, only : scene_type, jumps
   use axijoint_joints_settle, only : find_again
   use axijoint_joints_way, only : station_type, way_type, lag_type, go_again, remembered, shift, add_slip
   use axijoint_model_joint_points, only : stiffest_sliding
   implicit none
   private
   public :: joint_changes_type, search_type, new_search, can_follow_harmonics, follow_harmonics, find_planes, find_harmonics

   !> Intervals between planes are divided by this
   integer, parameter :: finer = 4

   !> The changes by what makes them
   type :: joint_changes_type
      type(joint_change_type) :: iteration, planes, harmonics
      !> Whether what planes and harmonics had wrong before the last increment is among theirs
      logical :: follow_slip = .false.
   end type joint_changes_type

   !> The search for what planes change, and from the state on these, what harmonics do
   type :: search_type
      private
      !> Laws, loads and planes, so many times more of them
      type(scene_type) :: finer
      integer :: step = 1
      !> By what joints lag for few planes before the last increment
      type(lag_type) :: lag
      !> The state on these planes, and what joints remember
      type(joint_field_type), allocatable :: on_more
      type(memory_type), allocatable :: memory(:, :)
   end type search_type

contains

   !> Begin the search
   function new_search(scene) result(search)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> The search
      type(search_type) :: search

      integer :: n

      search%finer = scene
      if (scene%planes%folds == 0) return  ! harmonic 0 alone: all planes are alike
      n = scene%planes%n - 1
      ! for products of harmonics up to 2 M
      search%step = max(finer, (4*maxval(scene%modes%harmonic) + n - 1)/n)
      search%finer%planes = new_planes(search%step*n + 1, scene%modes, whole=scene%planes%folds == 1)
   end function new_search

   !> Whether slip may have kept something of harmonics up to 2 M that can be found on the planes of the job
   pure logical function can_follow_harmonics(scene) result(can)
      !> The scene
      type(scene_type), intent(in) :: scene

      ! where harmonic 0 is alone there are no more
      can = scene%planes%folds > 0 .and. scene%planes%n - 1 >= 4*maxval(scene%modes%harmonic)
   end function can_follow_harmonics

   !> By what joints lag after a state on the way for few harmonics: it is found again with harmonics up to 2 M, from what they lagged
   !> by before it
   subroutine follow_harmonics(condensed, scene, station, lag)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> The state
      type(station_type), intent(in) :: station
      !> What harmonics leave
      type(lag_type), intent(inout) :: lag

      type(scene_type) :: there, extended
      type(joint_field_type), allocatable :: with_more

      there = scene
      there%loads = station%loads
      call add_harmonics(condensed, there, station%field, extended, with_more)
      call go_again(condensed, extended, remembered(scene%laws, station%field), station%field, with_more, lag)
   end subroutine follow_harmonics

   !> The change by more planes, but for motions that nothing resists and no load acts on; and by what these change of the slip of
   !> earlier increments, if the way is known and states are found
   subroutine find_planes(condensed, balanced, history, way, rounding, search, change)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The state of the joints, balanced, with the memory of the beginning of its increment
      type(joint_field_type), intent(in) :: balanced
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The way there; not known if nothing of it lasts
      type(way_type), intent(in) :: way
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)
      !> The search
      type(search_type), intent(inout) :: search
      !> Takes the change
      type(joint_change_type), intent(out) :: change

      real(wp) :: clock

      change = no_change(balanced)
      if (history%scene%planes%folds == 0) return
      clock = omp_get_wtime()
      if (way%known) call follow_planes(condensed, history%scene, search%finer, search%step, way%stations, search%lag)
      call change_by_planes(condensed, balanced, history, rounding, search, change)
      change%seconds = omp_get_wtime() - clock
   end subroutine find_planes

   !> The change by more harmonics, on more planes. Where states are not found with what slip has kept, both changes are found
   !> without it
   subroutine find_harmonics(condensed, balanced, history, followed, rounding, search, changes)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The state of the joints, balanced, with the memory of the beginning of its increment
      type(joint_field_type), intent(in) :: balanced
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> By what joints lag for few harmonics, on the planes of the job
      type(lag_type), intent(in) :: followed
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)
      !> The search
      type(search_type), intent(inout) :: search
      !> Takes the changes; those by planes are there
      type(joint_changes_type), intent(inout) :: changes

      type(lag_type) :: lag
      real(wp) :: clock

      changes%follow_slip = history%scene%planes%folds == 0
      changes%harmonics = no_change(balanced)
      if (changes%follow_slip) return
      clock = omp_get_wtime()
      lag = followed
      if (lag%known) lag%slip = slip_on_planes(lag%slip, search%step, size(search%finer%planes%angle))
      call change_by_harmonics(condensed, history%scene, lag, rounding, changes%planes%known, search, changes%harmonics)
      changes%follow_slip = search%lag%known .and. lag%known
      if ((search%lag%known .or. lag%known) .and. .not. (changes%planes%known .and. changes%harmonics%known)) then
         changes%follow_slip = .false.
         search%lag = lag_type()
         call change_by_planes(condensed, balanced, history, rounding, search, changes%planes)
         call change_by_harmonics(condensed, history%scene, lag_type(), rounding, changes%planes%known, search, changes%harmonics)
      end if
      changes%harmonics%seconds = omp_get_wtime() - clock + followed%seconds
   end subroutine find_harmonics

   !> The change by more planes, where joints remember so much more slip as they lag by
   subroutine change_by_planes(condensed, balanced, history, rounding, search, change)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The state of the joints, balanced, with the memory of the beginning of its increment
      type(joint_field_type), intent(in) :: balanced
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)
      !> The search; takes the state
      type(search_type), intent(inout) :: search
      !> Takes the change
      type(joint_change_type), intent(inout) :: change

      associate (scene => search%finer, count => size(search%finer%planes%angle))
         search%on_more = on_planes(balanced, search%step, count)
         search%memory = on_planes_memory(history%start, search%step, count)
         call add_slip(search%lag, search%memory)
         call shift(condensed, scene, search%lag, search%on_more)
         call find_again(condensed, scene, search%memory, search%on_more, change%known)
         change%stress = largest_change(history%scene, balanced, search%on_more, search%step, rounding)
         change%excess = search%on_more%excess - balanced%excess
         change%offset = offset_between(condensed, history%scene, balanced, scene, search%on_more, rounding)
      end associate
   end subroutine change_by_planes

   !> The same by more harmonics
   subroutine change_by_harmonics(condensed, scene, lag, rounding, begins, search, change)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes of the job, and loads
      type(scene_type), intent(in) :: scene
      !> By what joints lag for few harmonics, on more planes
      type(lag_type), intent(in) :: lag
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)
      !> Whether there is a state on more planes to begin from
      logical, intent(in) :: begins
      !> The search
      type(search_type), intent(inout) :: search
      !> Takes the change; none where there are no more harmonics
      type(joint_change_type), intent(inout) :: change

      type(scene_type) :: extended
      type(joint_field_type), allocatable :: with_more

      change%known = begins
      if (.not. begins) return
      associate (on_more => search%on_more, m => size(scene%modes))
         call add_harmonics(condensed, search%finer, on_more, extended, with_more)
         if (.not. allocated(with_more)) return
         call add_slip(lag, search%memory)
         call shift(condensed, extended, lag, with_more)
         call find_again(condensed, extended, search%memory, with_more, change%known)
         change%stress = maxval([0.0_wp, changes_of_points(scene, on_more, with_more, 1, rounding)* &
            beyond_twice(extended, with_more, m, condensed%points%proportion <= stiffest_sliding)])
         change%excess = with_more%excess(:, :, :m) - on_more%excess
         change%offset = offset_between(condensed, search%finer, on_more, extended, with_more, rounding)
         with_more%excess(:, :, :m) = 0.0_wp
         associate (jump => jumps(condensed, extended, with_more%excess, free=.false.))
            change%beyond = sqrt(maxval(sum(synthesize(extended%planes, jump)**2, 1)))
         end associate
      end associate
   end subroutine change_by_harmonics

   !> By what joints lag before the last increment for few planes: the way is gone again from station to station on more
   subroutine follow_planes(condensed, scene, finer_scene, step, stations, lag)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws and planes, and the same with so many times more planes
      type(scene_type), intent(in) :: scene, finer_scene
      integer, intent(in) :: step
      !> The stations
      type(station_type), intent(in) :: stations(:)
      !> What planes leave; not known if a state was not found
      type(lag_type), intent(out) :: lag

      type(scene_type) :: there
      type(joint_field_type) :: field
      integer :: i

      there = finer_scene
      do i = 1, size(stations)
         there%loads = stations(i)%loads
         associate (count => size(there%planes%angle))
            field = on_planes(stations(i)%field, step, count)
            call go_again(condensed, there, on_planes_memory(remembered(scene%laws, stations(i)%field), step, count), &
               stations(i)%field, field, lag)
         end associate
         if (.not. lag%known) return
      end do
   end subroutine follow_planes

end module axijoint_joints_joint_errors
