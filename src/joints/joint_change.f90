!> The change from one state of the joints to another, which tells what an approximation leaves
module axijoint_joints_joint_change
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : lost_at_opening, eta
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, trial_of
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, hold_nothing, settle
   use axijoint_joints_scene, only : scene_type
   implicit none
   private
   public :: joint_change_type, no_change, change_between, settled_change, offset_between, largest_change, changes_of_points

   !> What an approximation changes of the joints
   type :: joint_change_type
      !> Whether a state was found without it
      logical :: known = .false.
      !> Largest change of a joint stress on the planes of the job [stress]
      real(wp) :: stress = 0.0_wp
      !> Change of the excess stress, amplitudes, shape (3, points, modes), and of the floating
      !> motions
      real(wp), allocatable :: excess(:, :, :), offset(:)
      !> Largest jump in harmonics above M [length]
      real(wp) :: beyond = 0.0_wp
      !> Time that the estimate took [second]
      real(wp) :: seconds = 0.0_wp
   end type joint_change_type

contains

   !> No change of a state
   pure function no_change(field) result(change)
      !> The state
      type(joint_field_type), intent(in) :: field
      !> The change
      type(joint_change_type) :: change

      change%known = .true.
      change%excess = 0.0_wp*field%excess
      change%offset = 0.0_wp*field%offset
   end function no_change

   !> The change from one state to another on the same planes
   function change_between(scene, before, after, rounding) result(change)
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The states
      type(joint_field_type), intent(in) :: before, after
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)
      !> The change
      type(joint_change_type) :: change

      change%known = .true.
      change%stress = largest_change(scene, before, after, 1, rounding)
      change%excess = after%excess - before%excess
      change%offset = after%offset - before%offset
   end function change_between

   !> The same, but for motions that nothing resists and no load acts on in either
   function settled_change(condensed, scene, before, after, rounding) result(change)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The states
      type(joint_field_type), intent(in) :: before, after
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)
      !> The change
      type(joint_change_type) :: change

      change = change_between(scene, before, after, rounding)
      change%offset = offset_between(condensed, scene, before, scene, after, rounding)
   end function settled_change

   !> Largest change of a stress between two states, the second perhaps on so many times more planes
   pure real(wp) function largest_change(scene, before, after, step, rounding) result(largest)
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The states
      type(joint_field_type), intent(in) :: before, after
      !> Intervals of the second between planes of the first
      integer, intent(in) :: step
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)

      largest = maxval([0.0_wp, changes_of_points(scene, before, after, step, rounding)])
   end function largest_change

   !> The same of each point. A point that is nearer to its opening than a few times the change of its normal stress
   !> may open or close: then its cohesion counts, too
   pure function changes_of_points(scene, before, after, step, rounding) result(largest)
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The states
      type(joint_field_type), intent(in) :: before, after
      !> Intervals of the second between planes of the first
      integer, intent(in) :: step
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)
      !> Shape (points)
      real(wp) :: largest(size(rounding))

      !> So many times, and the part of the largest stress up to which a normal stress does not change
      real(wp), parameter :: reach = 2.0_wp, slight = 1.0e-12_wp
      real(wp) :: trial(3), earlier(3), least, change
      integer :: k, j, l

      largest = 0.0_wp
      if (carry_nothing(before, after, rounding)) return
      least = slight*maxval(abs(before%stress))
      do j = 1, size(before%stress, 3)
         l = 1 + step*(j - 1)
         do k = 1, size(rounding)
            change = maxval(abs(after%stress(:, k, l) - before%stress(:, k, j)))
            if (change > rounding(k)) largest(k) = max(largest(k), change)
            earlier = trial_of(scene%laws(k), k, l, before%jump(:, k, j), after)
            trial = trial_of(scene%laws(k), k, l, after%jump(:, k, l), after)
            ! dilation presses a point that slips
            if (before%stress(eta, k, j) < 0.0_wp) earlier(eta) = before%stress(eta, k, j)
            if (after%stress(eta, k, l) < 0.0_wp) trial(eta) = after%stress(eta, k, l)
            change = abs(trial(eta) - earlier(eta))
            if (change <= least .or. abs(trial(eta)) > reach*change) cycle
            change = lost_at_opening(scene%laws(k), after%memory(k, l), trial)
            if (change > rounding(k)) largest(k) = max(largest(k), change)
         end do
      end do
   end function changes_of_points

   !> Whether joints carry nothing but rounding in two states: then which of them touch, and what they would lose if they
   !> opened, is of no meaning, and nothing holds the parts
   pure logical function carry_nothing(before, after, rounding)
      !> The states
      type(joint_field_type), intent(in) :: before, after
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)

      integer :: k

      carry_nothing = any(rounding < huge(1.0_wp))  ! others are not judged
      do k = 1, size(rounding)
         carry_nothing = carry_nothing .and. max(maxval(abs(before%stress(:, k, :))), maxval(abs(after%stress(:, k, :)))) &
            <= rounding(k)
      end do
   end function carry_nothing

   !> Change of the floating motions from one state to another, but for motions that nothing resists and no load acts on in
   !> either
   function offset_between(condensed, scene, before, other_scene, after, rounding) result(change)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads of the first state, and of the second
      type(scene_type), intent(in) :: scene, other_scene
      !> The states
      type(joint_field_type), intent(in) :: before, after
      !> Changes of stress up to this are none, shape (points)
      real(wp), intent(in) :: rounding(:)
      !> One a motion
      real(wp), allocatable :: change(:)

      type(joint_field_type), allocatable :: first, second
      type(mechanism_type) :: mechanism

      allocate (first, source=before)
      allocate (second, source=after)
      call find_mechanism(condensed, scene, before, .false., mechanism)
      if (carry_nothing(before, after, rounding)) call hold_nothing(condensed, scene, before, mechanism)
      call settle(condensed, scene, mechanism, first)
      call settle(condensed, other_scene, mechanism, second)
      call find_mechanism(condensed, other_scene, after, .false., mechanism)
      call settle(condensed, scene, mechanism, first)
      call settle(condensed, other_scene, mechanism, second)
      change = second%offset - first%offset
   end function offset_between

end module axijoint_joints_joint_change
