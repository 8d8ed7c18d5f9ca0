!> Sums of harmonics at an angle, and the extreme values of a run
module axijoint_analysis_core_totals
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_analysis_core_fields, only : peak_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp, pi
   use axijoint_fe_mode, only : mode_type, meridional, circumferential, family_symmetric
   implicit none
   private
   public :: circle_type, new_circle, total_displacement, total_stress, n_unknowns
   public :: peak_type, of_length, of_pressure, of_shear, of_component, measure, largest, largest_displacement, &
      largest_vector, extremes_round, count_states

   !> What of three components the largest is looked for of: the length of all; the second, turned round; the length of the
   !> two others; any of them, without its sign
   integer, parameter :: of_length = 1, of_pressure = 2, of_shear = 3, of_component = 4

   !> Intervals of the circle in the search for it: at least so many, and in a wave of the highest harmonic
   integer, parameter :: least_intervals = 72, intervals_of_wave = 8
   !> A value that beats another by less is the same: the first of them stays
   real(wp), parameter :: same = 1.0e-9_wp

   !> Factors of all modes at one angle
   type :: circle_type
      !> The angle [radian]
      real(wp) :: angle = 0.0_wp
      !> Of r and z components, and of theta components, in the order of the results
      real(wp), allocatable :: meridional(:), circumferential(:)
   end type circle_type

contains

   !> Factors of all modes at an angle. What is zero but for rounding, as
   !> cos(pi/2), is zero.
   pure function new_circle(modes, angle) result(circle)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Angle [radian]
      real(wp), intent(in) :: angle
      !> The factors
      type(circle_type) :: circle

      circle%angle = angle
      circle%meridional = without_rounding(meridional(modes, angle), modes%harmonic)
      circle%circumferential = without_rounding(circumferential(modes, angle), modes%harmonic)
   end function new_circle

   !> Zero for what lies within the rounding of the angle m theta
   elemental real(wp) function without_rounding(value, harmonic) result(clean)
      !> Cosine or sine
      real(wp), intent(in) :: value
      !> Harmonic m
      integer, intent(in) :: harmonic

      clean = value
      if (abs(value) < 4.0_wp*real(max(1, harmonic), wp)*epsilon(1.0_wp)) clean = 0.0_wp
   end function without_rounding

   !> Displacement u, v, w at an angle (Eq. 1)
   pure function total_displacement(amplitude, circle) result(total)
      !> Amplitudes, shape (3, modes)
      real(wp), intent(in) :: amplitude(:, :)
      !> The angle
      type(circle_type), intent(in) :: circle
      !> u, v, w
      real(wp) :: total(3)

      total(1:2) = matmul(amplitude(1:2, :), circle%meridional)
      total(3) = dot_product(amplitude(3, :), circle%circumferential)
   end function total_displacement

   !> Stress r, z, theta, rz, r-theta, z-theta at an angle
   pure function total_stress(amplitude, circle) result(total)
      !> Amplitudes, shape (6, modes)
      real(wp), intent(in) :: amplitude(:, :)
      !> The angle
      type(circle_type), intent(in) :: circle
      !> Six stresses
      real(wp) :: total(6)

      total(1:4) = matmul(amplitude(1:4, :), circle%meridional)
      total(5:6) = matmul(amplitude(5:6, :), circle%circumferential)
   end function total_stress

   !> Number of unknowns of all modes together
   pure integer function n_unknowns(results)
      !> Results
      type(results_type), intent(in) :: results
      n_unknowns = sum(results%solves%n_equations)
   end function n_unknowns

   !> Largest length of the displacement vector, at the first node that has it
   pure function largest_displacement(modes, displacement) result(peak)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Length, node, angle
      type(peak_type) :: peak

      peak = largest(modes, displacement, of_length)
   end function largest_displacement

   !> The largest of sums of harmonics round the circle, at the first place that has it. The modes of a place together
   !> cannot give more than the sum of their amplitudes, by which most places need not be looked at
   pure function largest(modes, amplitude, what) result(peak)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes of two components that are even in a symmetric mode and one that is odd, shape (3, places, modes)
      real(wp), intent(in) :: amplitude(:, :, :)
      !> One of the `of_` parameters
      integer, intent(in) :: what
      !> Value, place, angle
      type(peak_type) :: peak

      real(wp), parameter :: rounding = 1.0e-12_wp
      type(circle_type), allocatable :: circles(:)
      type(peak_type) :: likely
      real(wp), allocatable :: total(:, :)
      real(wp) :: most(size(amplitude, 2)), step, curved
      integer :: place, i, k, n, last

      if (size(most) == 0 .or. size(modes) == 0) return
      n = max(least_intervals, intervals_of_wave*maxval(modes%harmonic))
      step = 2.0_wp*pi/real(n, wp)
      ! part by which a wave between three angles may differ from a parabola through them: a multiple of the square of what it rises
      curved = 4.0_wp*(1.0_wp - cos(0.5_wp*maxval(modes%harmonic)*step))**2
      last = n
      if (all(modes%family == family_symmetric)) last = n/2
      allocate (circles(0:last))
      do i = 0, last
         circles(i) = new_circle(modes, 2.0_wp*pi*real(i, wp)/real(n, wp))
      end do
      total = abs(amplitude(:, :, 1))
      do k = 2, size(modes)
         total = total + abs(amplitude(:, :, k))
      end do
      do place = 1, size(most)
         most(place) = (1.0_wp + rounding)*abs(measure(what, total(:, place)))
      end do
      call look(maxloc(most, 1, mask=ieee_is_finite(most)), likely)
      do place = 1, size(most)
         if (ieee_is_finite(most(place)) .and. most(place) >= likely%value .and. most(place) > peak%value) &
            call look(place, peak)
      end do

   contains

      !> Look round a place
      pure subroutine look(place, peak)
         !> The place; 0 if there is none
         integer, intent(in) :: place
         !> The largest so far
         type(peak_type), intent(inout) :: peak

         type(peak_type) :: here
         real(wp) :: value(0:last), beside(2), bend, vertex
         integer :: i, at

         if (place == 0) return
         do i = 0, last
            value(i) = measure(what, total_displacement(amplitude(:, place, :), circles(i)))
            if (.not. value(i) > here%value + same*abs(here%value)) cycle  ! on the axis all angles are alike
            here = peak_type(value(i), place, circles(i)%angle)
            at = i
         end do
         if (here%place == 0) return
         beside = value([max(at - 1, 0), min(at + 1, last)])
         if (at == 0) beside(1) = value(merge(1, last - 1, last < n))
         if (at == last) beside(2) = value(merge(last - 1, 1, last < n))
         bend = 2.0_wp*here%value - beside(1) - beside(2)
         vertex = here%value
         if (bend > 0.0_wp) vertex = vertex + (beside(2) - beside(1))**2/(8.0_wp*bend)
         if (vertex + curved*abs(vertex) >= max(peak%value, likely%value)) &
            call climb(modes, amplitude(:, place, :), what, step, here)
         if (here%value > peak%value + same*abs(peak%value)) peak = here
      end subroutine look

   end function largest

   !> Find the largest of a place between the angles beside one, by golden sections
   pure subroutine climb(modes, amplitude, what, step, peak)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes of the place, shape (3, modes)
      real(wp), intent(in) :: amplitude(:, :)
      !> One of the `of_` parameters
      integer, intent(in) :: what
      !> How far the angles beside it are [radian]
      real(wp), intent(in) :: step
      !> The largest of the angles; takes what is larger between them
      type(peak_type), intent(inout) :: peak

      real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)
      integer, parameter :: sections = 36  ! to 3e-8 of the step: the value to rounding
      real(wp) :: from, to, a, b, at_a, at_b
      integer :: i

      from = peak%angle - step
      to = peak%angle + step
      a = to - golden*(to - from)
      b = from + golden*(to - from)
      at_a = value_at(a)
      at_b = value_at(b)
      do i = 1, sections
         if (at_a > at_b) then
            to = b
            b = a
            at_b = at_a
            a = to - golden*(to - from)
            at_a = value_at(a)
         else
            from = a
            a = b
            at_a = at_b
            b = from + golden*(to - from)
            at_b = value_at(b)
         end if
      end do
      if (max(at_a, at_b) <= peak%value + same*abs(peak%value)) return
      peak%angle = modulo(merge(a, b, at_a > at_b), 2.0_wp*pi)
      peak%value = max(at_a, at_b)

   contains

      !> The value at an angle
      pure real(wp) function value_at(angle)
         !> The angle [radian]
         real(wp), intent(in) :: angle

         value_at = measure(what, total_displacement(amplitude, new_circle(modes, angle)))
      end function value_at

   end subroutine climb

   !> What is looked for of three components
   pure real(wp) function measure(what, x)
      !> One of the `of_` parameters
      integer, intent(in) :: what
      !> The components
      real(wp), intent(in) :: x(3)

      select case (what)
      case (of_length)
         measure = norm2(x)
      case (of_pressure)
         measure = -x(2)
      case (of_shear)
         measure = hypot(x(1), x(3))
      case default
         measure = maxval(abs(x))
      end select
   end function measure

   !> Least and largest of a component round the circle, each at the first place that has it. Harmonics above 0 add no more than
   !> the sum of their amplitudes, by which most places need not be looked at
   pure subroutine extremes_round(modes, amplitude, along, extremes)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes, shape (places, modes)
      real(wp), intent(in) :: amplitude(:, :)
      !> Whether the component goes with theta components
      logical, intent(in) :: along
      !> The least and the largest; no place if there are no places
      type(peak_type), intent(out) :: extremes(2)

      real(wp), allocatable :: factor(:, :)
      type(peak_type) :: likely, peak
      real(wp) :: most(size(amplitude, 1)), sign, step
      integer :: i, k, last, n, place

      if (size(most) == 0 .or. size(modes) == 0) return
      n = max(least_intervals, intervals_of_wave*maxval(modes%harmonic))
      last = n - 1
      if (all(modes%family == family_symmetric) .and. .not. along) last = n/2
      step = 2.0_wp*pi/real(n, wp)
      allocate (factor(0:last, size(modes)))
      do i = 0, last
         factor(i, :) = factors(step*real(i, wp))
      end do
      do k = 1, 2
         sign = merge(-1.0_wp, 1.0_wp, k == 1)
         most = 0.0_wp
         do i = 1, size(modes)
            if (modes(i)%harmonic == 0) then
               most = most + sign*factor(0, i)*amplitude(:, i)
            else
               most = most + abs(amplitude(:, i))
            end if
         end do
         likely = peak_type()
         peak = peak_type()
         call look(maxloc(most, 1, mask=ieee_is_finite(most)), likely)
         do place = 1, size(most)
            if (.not. ieee_is_finite(most(place))) cycle
            if (most(place) >= likely%value - same*abs(likely%value)) call look(place, peak)
         end do
         extremes(k) = peak
         extremes(k)%value = sign*peak%value
      end do

   contains

      !> Factors of all modes at an angle
      pure function factors(angle)
         !> The angle [radian]
         real(wp), intent(in) :: angle
         !> Shape (modes)
         real(wp) :: factors(size(modes))

         type(circle_type) :: circle

         circle = new_circle(modes, angle)
         factors = circle%meridional
         if (along) factors = circle%circumferential
      end function factors

      !> Look round a place: at all angles, then between those beside the best
      pure subroutine look(place, peak)
         !> The place; 0 if there is none
         integer, intent(in) :: place
         !> The largest so far, times the sign
         type(peak_type), intent(inout) :: peak

         real(wp) :: value(0:last), least, half, most, other, angle
         integer :: at, i

         if (place == 0) return
         value = sign*matmul(factor, amplitude(place, :))
         at = maxloc(value, 1) - 1
         angle = step*real(at, wp)
         most = value(at)
         half = 0.5_wp*step
         if (peak%place > 0) then  ! a wave rises no more between the angles than a part of what there is of waves
            associate (rise => 1.0_wp - cos(half*real(maxval(modes%harmonic), wp)))
               if (most + rise*sum(abs(amplitude(place, :))) < peak%value) return
            end associate
         end if
         least = same*step
         do while (half > least)  ! the middle of three, ever nearer
            do i = -1, 1, 2
               other = sign*dot_product(factors(angle + i*half), amplitude(place, :))
               if (.not. other > most) cycle
               most = other
               angle = angle + i*half
               exit
            end do
            half = 0.5_wp*half
         end do
         if (peak%place > 0 .and. .not. most > peak%value + same*abs(peak%value)) return
         peak = peak_type(most, place, modulo(angle, 2.0_wp*pi))
      end subroutine look

   end subroutine extremes_round

   !> Its length alone; zero if there is none
   pure real(wp) function largest_vector(modes, displacement) result(largest)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)

      type(peak_type) :: peak

      peak = largest_displacement(modes, displacement)
      largest = max(0.0_wp, peak%value)
   end function largest_vector

   !> Number of joint points times planes in a state
   pure integer function count_states(results, state)
      !> Results
      type(results_type), intent(in) :: results
      !> One of the `state_` parameters
      integer, intent(in) :: state
      count_states = count(results%joint_state == state)
   end function count_states

end module axijoint_analysis_core_totals
