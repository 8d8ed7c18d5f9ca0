!> What of a state of the joints hangs on the way to it
module axijoint_analysis_core_path
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : xi, theta, state_stick, state_slip, state_open, opening_bond
   use axijoint_fe_mode, only : is_torsion
   use axijoint_joints_history, only : history_type
   implicit none
   private
   public :: keeps_slip, slide_together, is_torn, is_soft_in_part, turns_slip

   !> Components of slip
   integer, parameter :: along(2) = [xi, theta]

contains

   !> Whether joints slipped in earlier increments that hold now, or slipped back or aside since, or with next to all others slip
   !> still, so that little but their earlier slip tells where bodies stand that joints alone hold: it is as wrong as mesh, planes
   !> and harmonics were then, of which estimates of the last increment know nothing
   pure logical function keeps_slip(structure, history, largest)
      !> Its joint points
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Largest displacement [length]
      real(wp), intent(in) :: largest

      !> Part of the largest displacement that such slip is worth a word from: if a tenth of it is wrong, a thousandth of that
      real(wp), parameter :: worth = 0.01_wp
      logical :: resists(size(history%field%state, 1)), slides
      integer :: i, j

      keeps_slip = .false.
      if (size(history%states) == 0) return
      resists = are_rough(history)
      slides = slide_together(structure, history)
      associate (state => history%field%state)
         do j = 1, size(state, 2)
            do i = 1, size(state, 1)
               if (.not. resists(i)) cycle
               keeps_slip = lasting_slip(structure, history, i, j, slides .or. state(i, j) == state_stick) > worth*largest
               if (keeps_slip) return
            end do
         end do
      end associate
   end function keeps_slip

   !> Whether next to all joints slip, so that little but their slip tells where parts stand that they alone hold
   pure logical function slide_together(structure, history) result(slide)
      !> Its joint points
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history

      !> Part of the points that hold up to which they hold next to nothing
      real(wp), parameter :: few = 0.2_wp

      associate (state => history%field%state, of => spread(are_rough(history), 2, size(history%field%state, 2)))
         slide = size(structure%condensed%floating) > 0 .and. &
            count(of .and. state == state_stick) <= few*count(of .and. state /= state_open)
      end associate
   end function slide_together

   !> Whether points resist slip; others slip freely
   pure function are_rough(history) result(rough)
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Shape (points)
      logical, allocatable :: rough(:)

      rough = max(history%scene%laws%cohesion, history%scene%laws%friction) > 0.0_wp
   end function are_rough

   !> How much longer the slip of a point was on its way than where that led; and all of it from before the last increment, if that
   !> stays. A point that stood open begins anew
   pure real(wp) function lasting_slip(structure, history, i, j, stays) result(lasting)
      !> Its joint points
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Point and plane
      integer, intent(in) :: i, j
      !> Whether that stays
      logical, intent(in) :: stays

      real(wp) :: begun(2), before(2), now(2), way
      logical :: closed, was_closed
      integer :: k

      closed = .true.
      begun = 0.0_wp
      now = 0.0_wp
      way = 0.0_wp
      before = 0.0_wp
      lasting = 0.0_wp
      associate (states => history%states, last => history%field)
         do k = 1, size(states) + 1
            was_closed = closed
            before = now
            if (k <= size(states)) then
               closed = states(k)%state(i, j) /= state_open
               now = slip_of(structure, i, states(k)%jump(:, i, j), states(k)%stress(:, i, j) - states(k)%initial(:, i))
            else
               closed = last%state(i, j) /= state_open
               now = slip_of(structure, i, last%jump(:, i, j), last%stress(:, i, j) - last%initial(:, i))
            end if
            if (was_closed .and. closed) then
               way = way + norm2(now - before)
            else
               way = 0.0_wp
               begun = now
               before = now
            end if
         end do
      end associate
      if (.not. closed) return
      lasting = way - norm2(now - begun)
      if (stays) lasting = max(lasting, norm2(before - begun))
   end function lasting_slip

   !> What of a relative displacement along a joint its stiffness does not take
   pure function slip_of(structure, i, jump, stress) result(slip)
      !> Joint points
      type(structure_type), intent(in) :: structure
      !> The point
      integer, intent(in) :: i
      !> The displacement, and the stress that it has beyond that before loading
      real(wp), intent(in) :: jump(3), stress(3)
      !> Along the meridian and round the axis
      real(wp) :: slip(2)

      slip = jump(along)
      associate (stiffness => structure%joint_points(structure%yielding(i))%stiffness(along))
         where (stiffness > 0.0_wp) slip = slip - stress(along)/stiffness
      end associate
   end function slip_of

   !> Whether some bonds broke and others hold
   pure logical function is_torn(history)
      !> What the increments came to
      type(history_type), intent(in) :: history

      is_torn = in_part((history%field%memory%broken), &
         history%scene%laws%opening == opening_bond .and. history%scene%laws%cohesion > 0.0_wp)
   end function is_torn

   !> Whether some points softened as they slipped and others of their laws did not
   pure logical function is_soft_in_part(history)
      !> What the increments came to
      type(history_type), intent(in) :: history

      is_soft_in_part = in_part((history%field%memory%softened), (history%scene%laws%softens))
   end function is_soft_in_part

   !> Whether something happened to some points that it can happen to, and not to others
   pure logical function in_part(happened, can)
      !> Whether it did, shape (points, planes), and whether it can, shape (points)
      logical, intent(in) :: happened(:, :), can(:)

      associate (of => spread(can, 2, size(happened, 2)))
         in_part = any(happened .and. of) .and. any(.not. happened .and. of)
      end associate
   end function in_part

   !> Whether slip turns from one direction to another within an increment, as where torque slides joints that other loads slide,
   !> too, or a lateral load follows an axial one. The state at its end is that of a way there which is straight: twice as many
   !> increments on a pile pushed down and twisted, near its limit, change more than meshes do
   pure logical function turns_slip(structure, history)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history

      !> Increments that make a way there, of torque and other loads at once
      integer, parameter :: many = 40
      integer :: k

      turns_slip = .false.
      if (any(is_torsion(structure%modes)) .and. size(history%states) + 1 < many) turns_slip = goes_both_ways(structure, history)
      associate (states => history%states, last => history%field)
         do k = 2, size(states)
            if (turns_slip) return
            turns_slip = turns(structure, states(k - 1)%state, states(k - 1)%stress, states(k)%state, states(k)%stress)
         end do
         k = size(states)
         if (k == 0 .or. turns_slip) return
         turns_slip = turns(structure, states(k)%state, states(k)%stress, last%state, last%stress)
      end associate
   end function turns_slip

   !> Whether shear stress slides joints both along and round the bodies
   pure logical function goes_both_ways(structure, history)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history

      !> Shares of the shear that slides joints that are worth a word: round the bodies on the whole, and along them anywhere
      real(wp), parameter :: much = 0.1_wp, little = 0.01_wp
      real(wp) :: shear, round, meridional, force(3)
      integer :: i, j

      shear = 0.0_wp
      round = 0.0_wp
      meridional = 0.0_wp
      do j = 1, size(history%field%stress, 3)
         do i = 1, size(history%field%stress, 2)
            if (history%field%state(i, j) /= state_slip) cycle
            force = structure%joint_points(structure%yielding(i))%weight*history%field%stress(:, i, j)
            shear = shear + norm2(force(along))
            round = round + force(theta)
            meridional = meridional + abs(force(xi))
         end do
      end do
      goes_both_ways = abs(round) > much*shear .and. meridional > little*shear
   end function goes_both_ways

   !> Whether shear stress that slides joints before and after an increment has turned aside; what goes back has not
   pure logical function turns(structure, before, stress_before, after, stress_after)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Stick, slip or open, shape (points, planes), and stress, shape (3, points, planes), at its beginning and its end
      integer, intent(in) :: before(:, :), after(:, :)
      real(wp), intent(in) :: stress_before(:, :, :), stress_after(:, :, :)

      !> Part of the shear that slides joints which is worth a word; the cosine of 20 degrees
      real(wp), parameter :: much = 0.1_wp, straight = 0.94_wp
      real(wp) :: shear, aside, cosine
      integer :: i, j

      shear = 0.0_wp
      aside = 0.0_wp
      do j = 1, size(after, 2)
         do i = 1, size(after, 1)
            if (after(i, j) /= state_slip) cycle
            associate (from => stress_before(along, i, j), to => stress_after(along, i, j), &
                       weight => structure%joint_points(structure%yielding(i))%weight)
               shear = shear + weight*norm2(to)
               if (before(i, j) /= state_slip .or. .not. min(norm2(from), norm2(to)) > 0.0_wp) cycle
               cosine = dot_product(from, to)/(norm2(from)*norm2(to))
               if (abs(cosine) < straight) aside = aside + weight*norm2(to)
            end associate
         end do
      end do
      turns = aside > much*shear
   end function turns

end module axijoint_analysis_core_path
