!> What harmonics above 2 M, which are not looked at, add to the change of joint stress by those above M
module axijoint_joints_harmonics_tail
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : xi, eta, theta, state_slip
   use axijoint_fe_mode, only : family_symmetric
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_planes, only : analyse
   use axijoint_joints_scene, only : scene_type
   implicit none
   private
   public :: beyond_twice

contains

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

end module axijoint_joints_harmonics_tail
