!> What of a state of the joints hangs on the way to it
module axijoint_analysis_core_path
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : xi, theta, state_slip, opening_bond
   use axijoint_fe_mode, only : is_torsion
   use axijoint_joints_history, only : history_type
   implicit none
   private
   public :: keeps_slip, is_torn, turns_slip

contains

   !> Whether joints slipped before the last step, and a load was larger at the end of an increment than it is now, or acted
   !> the other way. The slip is as wrong as mesh, planes and harmonics were then
   pure logical function keeps_slip(history)
      !> What the increments came to
      type(history_type), intent(in) :: history

      !> Rounding of factors, and of slip over the largest jump
      real(wp), parameter :: rounding = 1.0e-9_wp
      real(wp) :: largest
      logical :: was_larger
      integer :: j, k

      was_larger = .false.
      associate (now => history%loading%case_factor)
         do k = 1, size(history%states)
            associate (before => history%states(k)%case_factor)
               was_larger = was_larger .or. any(abs(before) > (1.0_wp + rounding)*abs(now) .or. before*now < 0.0_wp)
            end associate
         end do
      end associate
      keeps_slip = .false.
      if (.not. was_larger) return
      largest = maxval(abs(history%field%jump))
      do k = 1, size(history%memory, 1)
         if (.not. max(history%scene%laws(k)%cohesion, history%scene%laws(k)%friction) > 0.0_wp) cycle  ! what slips freely counts not
         do j = 1, size(history%memory, 2)
            keeps_slip = keeps_slip .or. maxval(abs(history%memory(k, j)%slip)) > rounding*largest
         end do
      end do
   end function keeps_slip

   !> Whether some bonds broke and others hold
   pure logical function is_torn(history)
      !> What the increments came to
      type(history_type), intent(in) :: history

      logical :: bonds(size(history%field%memory, 1))

      bonds = history%scene%laws%opening == opening_bond .and. history%scene%laws%cohesion > 0.0_wp
      associate (broken => history%field%memory%broken, of => spread(bonds, 2, size(history%field%memory, 2)))
         is_torn = any(broken .and. of) .and. any(.not. broken .and. of)
      end associate
   end function is_torn

   !> Whether torque slides joints that other loads slide, too. Where slip turns from the one direction to the other within an
   !> increment, the state at its end is that of a way there which is straight: twice as many increments on a pile pushed down
   !> and twisted, near its limit, change more than meshes do
   pure logical function turns_slip(structure, history)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history

      !> Increments that make a way there; shares of the shear that slides joints that are worth a word: round the bodies on
      !> the whole, and along them anywhere
      integer, parameter :: many = 40
      real(wp), parameter :: much = 0.1_wp, little = 0.01_wp
      real(wp) :: shear, round, along, force(3)
      integer :: i, j

      turns_slip = .false.
      if (.not. any(is_torsion(structure%modes)) .or. size(history%states) + 1 >= many) return
      shear = 0.0_wp
      round = 0.0_wp
      along = 0.0_wp
      do j = 1, size(history%field%stress, 3)
         do i = 1, size(history%field%stress, 2)
            if (history%field%state(i, j) /= state_slip) cycle
            force = structure%joint_points(structure%yielding(i))%weight*history%field%stress(:, i, j)
            shear = shear + hypot(force(xi), force(theta))
            round = round + force(theta)
            along = along + abs(force(xi))
         end do
      end do
      turns_slip = abs(round) > much*shear .and. along > little*shear
   end function turns_slip

end module axijoint_analysis_core_path
