!> What iteration, planes and harmonics leave of the error of joints: the state is found again on
!> the condensed structure, wholly balanced, on more planes, with more harmonics
module axijoint_joints_joint_errors
   use omp_lib, only : omp_get_wtime
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type, lost_at_opening, xi, eta, theta, state_slip
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, trial_of, commit_field
   use axijoint_joints_history, only : history_type
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, hold_nothing, settle
   use axijoint_joints_planes, only : new_planes, synthesize, analyse
   use axijoint_joints_scene, only : scene_type, jumps, jumps_of_mode
   use axijoint_joints_settle, only : find_again
   use axijoint_joints_way, only : station_type, way_type, lag_type, go_again, remembered, shift, add_slip
   use axijoint_model_joint_points, only : stiffest_sliding
   implicit none
   private
   public :: joint_change_type, joint_changes_type, search_type, new_search, can_follow_harmonics, &
      follow_harmonics, find_planes, find_harmonics, change_between, settled_change, offset_between, largest_change

   !> Intervals between planes are divided by this
   integer, parameter :: finer = 4

   !> Powers of the harmonic that the stiffness of bodies may grow
   !> like, and that which is told by harmonic 1, in which bodies move without strain
   real(wp), parameter :: least_power = 0.5_wp, most_power = 3.0_wp, rigid_power = 2.0_wp

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

   !> What all harmonics change of the stress of points over what those up to 2 M do: 1 where they fall as fast as usual. Where slip
   !> turns round from one plane to the next, pressure has a peak there to which each doubling of M adds as much again, and no number of
   !> them is enough: then so much more as a geometric series would add, four times at most
   function beyond_twice(scene, field, m, slides) result(factor)
      !> Planes and modes up to 2 M
      type(scene_type), intent(in) :: scene
      !> The state with all of them
      type(joint_field_type), intent(in) :: field
      !> Number of modes up to M
      integer, intent(in) :: m
      !> Whether points are soft enough to slide, shape (points)
      logical, intent(in) :: slides(:)
      !> The factors, shape (points)
      real(wp) :: factor(size(slides))

      !> Least M of which two octaves are known; part of the octave before that one has, at most, where nothing is added; the factor where
      !> there is one harmonic besides 0, so that nothing tells how they fall, and most
      integer, parameter :: least = 4
      real(wp), parameter :: usual = 0.5_wp, of_one = 2.5_wp, most = 4.0_wp
      real(wp) :: above, middle
      real(wp), allocatable :: stress(:, :, :)
      real(wp) :: amplitude(size(scene%modes))
      integer :: harmonic(size(scene%modes))
      logical :: single
      integer :: k, highest

      factor = 1.0_wp
      harmonic = scene%modes%harmonic
      highest = maxval(harmonic(:m))
      single = count(harmonic(:m) > 0 .and. scene%modes(:m)%family == scene%modes(m)%family) == 1
      if (highest < least .and. .not. single) return
      stress = analyse(scene%planes, field%stress)
      do k = 1, size(stress, 2)
         amplitude = abs(stress(eta, k, :))
         call find_octaves(harmonic, amplitude, highest, middle, above)
         if (.not. slides(k) .or. .not. (single .or. above > usual*middle) .or. .not. &
             turns_round(all(scene%modes%family == family_symmetric), field%state(k, :), field%stress(:, k, :))) cycle
         factor(k) = merge(of_one, most, single)
         if (.not. single .and. above < middle) factor(k) = min(most, (1.0_wp - usual)/(1.0_wp - above/middle))
      end do
   end function beyond_twice

   !> Sums of amplitudes of the harmonics up to M that are above M/2, and of those above M up to 2 M, as if the ones that have any
   !> were as many in each as they are on the whole: of harmonics 2, 6, 10, 14, ... there is one up to 6, one up to 12, three up to 24
   pure subroutine find_octaves(harmonic, amplitude, highest, middle, above)
      !> Harmonics, and their amplitudes
      integer, intent(in) :: harmonic(:)
      real(wp), intent(in) :: amplitude(:)
      !> M
      integer, intent(in) :: highest
      !> The sums
      real(wp), intent(out) :: middle, above

      !> Part of the largest of an octave below which a harmonic has none
      real(wp), parameter :: none = 0.25_wp
      logical, dimension(size(harmonic)) :: lower, upper
      integer :: n

      lower = 2*harmonic > highest .and. harmonic <= highest
      upper = harmonic > highest .and. harmonic <= 2*highest
      middle = sum(amplitude, mask=lower)
      above = sum(amplitude, mask=upper)
      lower = lower .and. amplitude > none*maxval(amplitude, mask=lower)
      upper = upper .and. amplitude > none*maxval(amplitude, mask=upper)
      n = count(lower .or. upper)
      if (.not. any(lower) .or. .not. any(upper)) return
      associate (distance => real(maxval(harmonic, mask=upper) - minval(harmonic, mask=lower), wp)/(n - 1))
         middle = middle*highest/(2.0_wp*distance*count(lower))
         above = above*highest/(distance*count(upper))
      end associate
   end subroutine find_octaves

   !> Whether slip round the bodies turns round from one plane to the next
   pure logical function turns_round(half, state, stress)
      !> Whether the planes are those of half of what is symmetric, the ends between two that mirror each other
      logical, intent(in) :: half
      !> Stick, slip or open, shape (planes), and stress, shape (3, planes)
      integer, intent(in) :: state(:)
      real(wp), intent(in) :: stress(:, :)

      !> Part of the shear stress that is round the bodies
      real(wp), parameter :: round = 0.7_wp
      logical :: slides(size(state))
      integer :: n

      n = size(state)
      slides = state == state_slip .and. abs(stress(theta, :)) > round*hypot(stress(xi, :), stress(theta, :))
      turns_round = any(slides(:n - 1) .and. slides(2:) .and. stress(theta, :n - 1)*stress(theta, 2:) < 0.0_wp)
      if (half) then
         turns_round = turns_round .or. any(slides([min(2, n), max(1, n - 1)]))
      else
         turns_round = turns_round .or. (slides(1) .and. slides(n) .and. stress(theta, 1)*stress(theta, n) < 0.0_wp)
      end if
   end function turns_round

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

   !> A state with so many times more planes
   pure function on_planes(field, step, count) result(state)
      !> The state
      type(joint_field_type), intent(in) :: field
      !> How many times, and the number of planes then
      integer, intent(in) :: step, count
      !> The state there; its stresses are those of the plane before
      type(joint_field_type) :: state

      integer :: j, place(count)

      place = [((j - 1)/step + 1, j=1, count)]
      state = field
      state%memory = on_planes_memory(field%memory, step, count)
      state%jump = field%jump(:, :, place)
      state%stress = field%stress(:, :, place)
      state%carried = field%carried(:, :, place)
      state%moved = field%moved(:, :, place)
      state%state = field%state(:, place)
   end function on_planes

   !> What is remembered on so many times more planes: of slip what lies between the neighbours of a
   !> new plane, else what the plane before it does
   pure function on_planes_memory(memory, step, count) result(finer)
      !> Memory, shape (points, planes)
      type(memory_type), intent(in) :: memory(:, :)
      !> How many times, and the number of planes then
      integer, intent(in) :: step, count
      !> Memory on the planes
      type(memory_type) :: finer(size(memory, 1), count)

      real(wp) :: slip(3, size(memory, 1), size(memory, 2)), more_slip(3, size(memory, 1), count)
      integer :: i, j

      do i = 1, 3
         slip(i, :, :) = memory%slip(i)
      end do
      more_slip = slip_on_planes(slip, step, count)
      finer = memory(:, [((j - 1)/step + 1, j=1, count)])
      do i = 1, 3
         finer%slip(i) = more_slip(i, :, :)
      end do
   end function on_planes_memory

   !> Slip on so many times more planes: what lies between the neighbours of a new plane
   pure function slip_on_planes(slip, step, count) result(finer)
      !> Slip, shape (3, points, planes)
      real(wp), intent(in) :: slip(:, :, :)
      !> How many times, and the number of planes then
      integer, intent(in) :: step, count
      !> Slip on the planes
      real(wp) :: finer(3, size(slip, 2), count)

      real(wp) :: fraction
      integer :: j, place, next

      do j = 1, count
         place = (j - 1)/step + 1
         next = 1 + mod(place, size(slip, 3))
         fraction = real(mod(j - 1, step), wp)/step
         finer(:, :, j) = (1.0_wp - fraction)*slip(:, :, place) + fraction*slip(:, :, next)
      end do
   end function slip_on_planes

   !> The scene with harmonics up to 2 M
   subroutine add_harmonics(condensed, scene, field, extended, with_more)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The scene
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The scene with more harmonics
      type(scene_type), intent(out) :: extended
      !> The same state, nothing yet in these harmonics; not allocated if there are none
      type(joint_field_type), allocatable, intent(out) :: with_more

      type(mode_type), allocatable :: above(:)
      integer :: n, last

      above = modes_above(scene%modes)
      if (size(above) == 0) return
      n = size(scene%modes)
      last = maxloc(scene%modes%harmonic, 1)
      extended = scene
      extended%modes = [scene%modes, above]
      extended%system = [scene%system, spread(scene%system(last), 1, size(above))]
      extended%scale = shares_above(condensed, scene, extended%modes, last, field)
      extended%planes = new_planes(scene%planes%n, extended%modes, whole=scene%planes%folds == 1)
      deallocate (extended%loads%free)
      allocate (extended%loads%free(3, size(condensed%points), n + size(above)), source=0.0_wp)
      extended%loads%free(:, :, :n) = scene%loads%free
      if (allocated(scene%loads%reference%forces)) then  ! nothing loads the modes above
         associate (forces => scene%loads%reference%forces)
            extended%loads%reference%forces = reshape([forces, spread(maxval(forces, 2), 2, size(above))], &
               [size(forces, 1), n + size(above)])
         end associate
      end if
      allocate (with_more, source=field)
      with_more%excess = 0.0_wp*extended%loads%free
      with_more%excess(:, :, :n) = field%excess
      with_more%pending = 0.0_wp*with_more%excess
   end subroutine add_harmonics

   !> Modes that follow those of a job, up to 2 M, and to three times the lowest: friction answers a harmonic in that first
   pure function modes_above(modes) result(above)
      !> Modes of the job
      type(mode_type), intent(in) :: modes(:)
      !> The next: as many, but for two that follow one
      type(mode_type), allocatable :: above(:)

      integer :: step, last, m, family

      allocate (above(0))
      last = maxval(modes%harmonic)
      if (last == 0) return
      step = minval(modes%harmonic, mask=modes%harmonic > 0)
      do m = last + step, max(2*last, 3*step), step
         do family = family_symmetric, family_antisymmetric
            if (any(modes%family == family .and. modes%harmonic > 0)) &
               above = [above, mode_type(m, family)]
         end do
      end do
   end function modes_above

   !> Flexibilities of harmonics that were not computed, over that of the highest. A joint of the
   !> stiffness k before bodies of the stiffness K takes up the share k/(k + K) of a stress; K of
   !> the bodies grows like a power of m, which the two highest harmonics tell
   function shares_above(condensed, scene, modes, last, field) result(scale)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The modes, those of the scene first
      type(mode_type), intent(in) :: modes(:)
      !> The highest of the scene
      integer, intent(in) :: last
      !> State of the joints, for the excess stress that is looked at
      type(joint_field_type), intent(in) :: field
      !> The factors, 1 for those of the scene
      real(wp), allocatable :: scale(:)

      real(wp) :: stiffness(2), power
      integer :: k, m(2)

      m(2) = modes(last)%harmonic
      stiffness(2) = body_stiffness(condensed, scene, last, field%excess(:, :, last))
      power = 1.0_wp
      m(1) = maxval([0, scene%modes%harmonic], mask=[0, scene%modes%harmonic] < m(2))
      if (m(1) > 0) then
         stiffness(1) = body_stiffness(condensed, scene, findloc(scene%modes%harmonic, m(1), 1), field%excess(:, :, last))
         power = log(stiffness(2)/stiffness(1))/log(real(m(2), wp)/m(1))
         power = min(merge(rigid_power, most_power, m(1) == 1), max(least_power, power))
      end if
      allocate (scale(size(modes)), source=1.0_wp)
      do k = size(scene%modes) + 1, size(modes)
         scale(k) = (1.0_wp + stiffness(2))/(1.0_wp + &
            stiffness(2)*(real(modes(k)%harmonic, wp)/m(2))**power)
      end do
   end function shares_above

   !> Stiffness of the bodies over that of the joints, for a distribution of excess stress
   function body_stiffness(condensed, scene, place, excess) result(stiffness)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Place of the mode
      integer, intent(in) :: place
      !> The stress, shape (3, points)
      real(wp), intent(in), contiguous :: excess(:, :)
      !> The ratio
      real(wp) :: stiffness

      real(wp) :: jump(3, size(excess, 2)), work(2)
      integer :: k

      jump = jumps_of_mode(condensed, scene, place, excess)
      work = tiny(1.0_wp)
      do k = 1, size(excess, 2)
         associate (point => condensed%points(k))
            work = work + point%weight*[sum(excess(:, k)**2), &
               sum(excess(:, k)*point%base*jump(:, k))]
         end associate
      end do
      stiffness = max(epsilon(1.0_wp), work(1)/work(2) - 1.0_wp)
   end function body_stiffness

end module axijoint_joints_joint_errors
