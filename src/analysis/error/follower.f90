!> The way that loads took before the last increment, with more harmonics: gone behind who follows it as it was
module axijoint_analysis_error_follower
   use omp_lib, only : omp_get_wtime, omp_init_lock, omp_set_lock, omp_unset_lock, omp_destroy_lock, omp_lock_kind
   use axijoint_analysis_core_footprint, only : waiting_numbers
   use axijoint_base_kinds, only : wp, i8
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_joint_errors, only : can_follow_harmonics, follow_harmonics
   use axijoint_joints_scene, only : scene_type
   use axijoint_joints_way, only : station_type, lag_type
   implicit none
   private
   public :: follower_type, new_follower, pass_state, end_way, follow_behind

   !> Who goes behind
   type :: follower_type
      private
      !> By what joints lag after the last state, with the time that it took to find all; not known if the planes are too few for more
      !> harmonics, or a state was not found
      type(lag_type), public :: lag
      !> States that wait for another thread
      type(station_type), allocatable :: waiting(:)
      !> Gates, closed until a state waits, the last until the way ends; none if there is no other thread
      integer(omp_lock_kind), allocatable :: gates(:)
      !> States that have been passed by who goes before
      integer :: n_passed = 0
      !> Time so far [second]
      real(wp) :: seconds = 0.0_wp
   end type follower_type

contains

   !> Begin
   subroutine new_follower(scene, n_jumps, n_states, apart, follower)
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> Jumps on all planes, and states on the way at most
      integer, intent(in) :: n_jumps, n_states
      !> Whether another thread goes behind
      logical, intent(in) :: apart
      !> The follower
      type(follower_type), intent(out) :: follower

      integer :: k, n

      n = 0
      if (apart .and. can_follow_harmonics(scene) .and. waiting_numbers(int(n_jumps, i8), n_states) > 0) n = n_states
      allocate (follower%waiting(n), follower%gates(merge(n + 1, 0, apart)))
      do k = 1, size(follower%gates)
         call omp_init_lock(follower%gates(k))
         call omp_set_lock(follower%gates(k))
      end do
   end subroutine new_follower

   !> Who goes before has passed a state
   subroutine pass_state(condensed, scene, station, follower)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> The state
      type(station_type), intent(in) :: station
      !> The follower
      type(follower_type), intent(inout) :: follower

      follower%n_passed = follower%n_passed + 1
      associate (k => follower%n_passed)
         if (k > size(follower%waiting)) then
            call follow_to(condensed, scene, k, station, follower)
         else
            follower%waiting(k) = station
            call omp_unset_lock(follower%gates(k))
         end if
      end associate
   end subroutine pass_state

   !> Who goes before is at the end of the way
   subroutine end_way(follower)
      !> The follower
      type(follower_type), intent(inout) :: follower

      integer :: k

      do k = min(follower%n_passed, size(follower%waiting)) + 1, size(follower%gates)
         call omp_unset_lock(follower%gates(k))
      end do
   end subroutine end_way

   !> Go behind to the end of the way, in another thread
   subroutine follow_behind(condensed, scene, follower)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> The follower
      type(follower_type), intent(inout) :: follower

      integer :: k

      do k = 1, size(follower%gates)
         call omp_set_lock(follower%gates(k))
         call omp_unset_lock(follower%gates(k))
         call omp_destroy_lock(follower%gates(k))
         if (k > size(follower%waiting)) exit
         if (.not. allocated(follower%waiting(k)%field%jump)) cycle  ! the way has ended before
         call follow_to(condensed, scene, k, follower%waiting(k), follower)
         follower%waiting(k) = station_type()
      end do
   end subroutine follow_behind

   !> Follow to a state through all increments, as where points slip and where they hold hangs on the number of harmonics from the
   !> first; not if one before it was not found
   subroutine follow_to(condensed, scene, k, station, follower)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws and planes
      type(scene_type), intent(in) :: scene
      !> Place of the state on the way
      integer, intent(in) :: k
      !> The state
      type(station_type), intent(in) :: station
      !> The follower
      type(follower_type), intent(inout) :: follower

      real(wp) :: began

      if (.not. can_follow_harmonics(scene)) return
      if (k > 1 .and. .not. follower%lag%known) return
      began = omp_get_wtime()
      call follow_harmonics(condensed, scene, station, follower%lag)
      follower%seconds = follower%seconds + omp_get_wtime() - began
      follower%lag%seconds = follower%seconds
   end subroutine follow_to

end module axijoint_analysis_error_follower
