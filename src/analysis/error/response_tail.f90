!> What harmonics above M would add to the response to loads that are functions of theta, from the
!> course of the harmonics up to M
module axijoint_analysis_error_response_tail
   use axijoint_base_kinds, only : wp, pi
   use axijoint_fe_circle_function, only : circle_function_type, fourier_coefficients
   use axijoint_model_modes, only : greatest_divisor
   implicit none
   private
   public :: response_tail, tail_of_points, stress_tail, is_cancelled

   !> The sums over the octaves of harmonics fall at least by this factor, about 1/sqrt(2): that of
   !> amplitudes that fall with m^(-3/2), between a load that jumps and the response to it
   real(wp), parameter :: slowest = 0.7_wp
   !> Bounds of the power of m with which the response to a load of harmonic m falls; the first, which is taken if the response
   !> does not tell it, is that of a half-space. Tubes bend with a higher power than the second, up to 4, until waves are as
   !> short as their wall is thick; which of the two M has seen it does not know
   real(wp), parameter :: bounds_of_power(2) = [1.0_wp, 1.75_wp]
   !> The bounds under forces at points: near them all bodies answer alike, whatever they do as a whole, as a tube that bends,
   !> until harmonics are as short as elements
   real(wp), parameter :: near_points(2) = [1.5_wp, 2.0_wp]
   !> Rounding of the harmonics of a load
   real(wp), parameter :: none = 1.0e-12_wp
   !> Stresses are as displacements times m: what the powers are less by
   real(wp), parameter :: of_stress = 1.0_wp

contains

   !> Sum of the amplitudes above M. If it is known how the load goes round the circle, those of its harmonics times a power of
   !> m that the response up to M tells; else the sums over (M, 2M], (2M, 4M] ... are taken to fall on by the
   !> factor from (M/4, M/2] to (M/2, M]. Negative if it is not known, as up to M = 1: harmonics 0 and 1, which move parts as
   !> rigid, tell nothing of those above
   pure real(wp) function response_tail(harmonic, amplitude, course, without) result(tail)
      !> Harmonic of each mode, and its amplitude, shape (modes)
      integer, intent(in) :: harmonic(:)
      real(wp), intent(in) :: amplitude(:)
      !> The load
      type(circle_function_type), intent(in), optional :: course
      !> Harmonics up to M that are not among the modes, though the load has them; none if absent
      integer, intent(in), optional :: without(:)

      real(wp) :: upper, lower, factor
      integer :: m

      tail = -1.0_wp
      m = maxval(harmonic)
      if (m <= 1) return
      upper = sum(amplitude, mask=harmonic > m/2)
      lower = sum(amplitude, mask=harmonic > m/4 .and. harmonic <= m/2)
      factor = slowest
      if (upper < slowest*lower) factor = upper/lower
      tail = upper*factor/(1.0_wp - factor)
      if (present(course)) call follow_load(course, m, step_of(harmonic, amplitude), upper, lower, tail, without)
   end function response_tail

   !> The same under forces at points, whose harmonics are all alike. Negative if no harmonic in (M/2, M] answers
   pure real(wp) function tail_of_points(harmonic, amplitude, lower_by) result(tail)
      !> Harmonic of each mode, and its amplitude, shape (modes)
      integer, intent(in) :: harmonic(:)
      real(wp), intent(in) :: amplitude(:)
      !> What the power of m is less by than that of displacements; nothing if absent
      real(wp), intent(in), optional :: lower_by

      real(wp), allocatable :: load(:)
      real(wp) :: upper, lower, bounds(2)
      integer :: m, step

      tail = -1.0_wp
      m = maxval(harmonic)
      upper = sum(amplitude, mask=harmonic > m/2)
      lower = sum(amplitude, mask=harmonic > m/4 .and. harmonic <= m/2)
      if (m <= 1 .or. .not. upper > 0.0_wp) return
      allocate (load(4*m), source=0.0_wp)
      step = step_of(harmonic, amplitude)
      load(step::step) = 1.0_wp
      bounds = near_points
      if (present(lower_by)) bounds = near_points - lower_by
      call follow(load, m, upper, lower, bounds, tail)
   end function tail_of_points

   !> Largest sum round the circle of a stress in harmonics above M, where those of the load are known or act at a point: beside a load
   !> that jumps these do not die out, and their amplitudes have no sum, but they take each other away but for half of the jump.
   !> Negative if it is not known
   pure real(wp) function stress_tail(harmonic, amplitude, course, without) result(tail)
      !> Harmonic of each mode, and its amplitude, shape (modes)
      integer, intent(in) :: harmonic(:)
      real(wp), intent(in) :: amplitude(:)
      !> The load; a force at a point if absent
      type(circle_function_type), intent(in), optional :: course
      !> Harmonics up to M that are not among the modes, though the load has them; none if absent
      integer, intent(in), optional :: without(:)

      !> Harmonics that are looked at, over M, and angles from one wave of the highest to the next
      integer, parameter :: octaves = 8, of_wave = 4
      complex(wp), allocatable :: wave(:), load(:)
      real(wp), allocatable :: sizes(:)
      real(wp) :: upper, lower, power, a, b
      integer :: j, k, m, n, step

      if (.not. present(course)) then
         tail = tail_of_points(harmonic, amplitude, of_stress)
         return
      end if
      tail = response_tail(harmonic, amplitude)
      m = maxval(harmonic)
      step = step_of(harmonic, amplitude)
      allocate (load(octaves*m), source=(0.0_wp, 0.0_wp))
      do k = step, size(load), step
         call fourier_coefficients(course, k, a, b)
         load(k) = cmplx(a, -b, wp)
         if (.not. present(without)) cycle
         if (any(without == k)) load(k) = 0.0_wp
      end do
      sizes = abs(load(:4*m))
      upper = sum(amplitude, mask=harmonic > m/2)
      lower = sum(amplitude, mask=harmonic > m/4 .and. harmonic <= m/2)
      if (.not. tells(sizes, m)) return
      power = told_power(sizes, m, upper, lower, bounds_of_power - of_stress)
      load = load*[(real(k, wp)**(-power), k=1, size(load))]
      n = of_wave*size(load)
      wave = [(exp(cmplx(0.0_wp, 2.0_wp*pi*j/n, wp)), j=0, n - 1)]
      tail = 0.0_wp
      do j = 0, n - 1
         tail = max(tail, abs(sum([(real(load(k)*wave(1 + modulo(j*k, n))), k=m + 1, size(load))])))
      end do
      tail = upper/sum(abs(load(m/2 + 1:m)))*tail
   end function stress_tail

   !> Whether loads cancel each other in all harmonics of (M/2, M], as equal ones at equal angles do: what they do above M is
   !> not known then
   pure logical function is_cancelled(harmonic, amplitude)
      !> Harmonic of each mode, and its amplitude, shape (modes)
      integer, intent(in) :: harmonic(:)
      real(wp), intent(in) :: amplitude(:)

      !> Rounding of the response, less than what a load has in the harmonics above M/2
      real(wp), parameter :: slight = 1.0e-13_wp

      is_cancelled = .not. maxval(amplitude, mask=2*harmonic > maxval(harmonic)) > slight*maxval(amplitude)
   end function is_cancelled

   !> The number that all harmonics of the response are multiples of: loads may cancel each other in others
   pure integer function step_of(harmonic, amplitude) result(step)
      !> Harmonic of each mode, and its amplitude, shape (modes)
      integer, intent(in) :: harmonic(:)
      real(wp), intent(in) :: amplitude(:)

      !> Rounding of the response
      real(wp), parameter :: slight = 1.0e-9_wp
      integer :: k

      step = 0
      do k = 1, size(harmonic)
         if (amplitude(k) > slight*maxval(amplitude)) step = greatest_divisor(step, harmonic(k))
      end do
      step = max(1, step)
   end function step_of

   !> The same from the harmonics of the load
   pure subroutine follow_load(course, m, step, upper, lower, tail, without)
      !> The load
      type(circle_function_type), intent(in) :: course
      !> M, and the number that all harmonics of the response are multiples of
      integer, intent(in) :: m, step
      !> Amplitudes of the response in (M/2, M], and in (M/4, M/2]
      real(wp), intent(in) :: upper, lower
      !> Takes the sum
      real(wp), intent(inout) :: tail
      !> Harmonics up to M that do not count; none if absent
      integer, intent(in), optional :: without(:)

      real(wp), allocatable :: load(:)  ! threads have small stacks
      real(wp) :: a, b
      integer :: k

      allocate (load(4*m), source=0.0_wp)
      do k = step, 4*m, step
         call fourier_coefficients(course, k, a, b)
         load(k) = hypot(a, b)
         if (.not. present(without)) cycle
         if (any(without == k)) load(k) = 0.0_wp
      end do
      call follow(load, m, upper, lower, bounds_of_power, tail)
   end subroutine follow_load

   !> The same from the harmonics of a load, if it has any in (M/2, M]
   pure subroutine follow(load, m, upper, lower, bounds, tail)
      !> Its harmonics from 1 to 4 M
      real(wp), intent(inout) :: load(:)
      !> M
      integer, intent(in) :: m
      !> Amplitudes of the response in (M/2, M], and in (M/4, M/2]; bounds of the power of m with which it falls
      real(wp), intent(in) :: upper, lower, bounds(2)
      !> Takes the sum
      real(wp), intent(inout) :: tail

      real(wp) :: power, factor
      integer :: k

      if (.not. tells(load, m)) return
      power = told_power(load, m, upper, lower, bounds)
      load = load*[(real(k, wp)**(-power), k=1, 4*m)]
      associate (next => sum(load(m + 1:2*m)), last => sum(load(2*m + 1:)))
         factor = slowest
         if (last < slowest*next) factor = last/next
         tail = upper*(next + last/(1.0_wp - factor))/sum(load(m/2 + 1:m))
      end associate
   end subroutine follow

   !> Whether harmonics of a load in (M/2, M] are more than rounding
   pure logical function tells(load, m)
      !> Its harmonics from 1 to 4 M, and M
      real(wp), intent(in) :: load(:)
      integer, intent(in) :: m

      tells = sum(load(m/2 + 1:m)) > none*maxval(load)
   end function tells

   !> Power of m with which the response to harmonics of a load falls, as far as M tells it
   pure real(wp) function told_power(load, m, upper, lower, bounds) result(power)
      !> Harmonics of the load from 1 to 4 M, and M
      real(wp), intent(in) :: load(:)
      integer, intent(in) :: m
      !> Amplitudes of the response in (M/2, M], and in (M/4, M/2]; bounds of the power, the first if it is not told
      real(wp), intent(in) :: upper, lower, bounds(2)

      power = bounds(1)
      ! harmonics 0 and 1 move parts as rigid
      if (m > 3 .and. upper > 0.0_wp .and. lower > 0.0_wp .and. sum(load(m/4 + 1:m/2)) > none*maxval(load)) &
         power = power_of(load, m, upper/lower, bounds)
   end function told_power

   !> Power of m that harmonics of a load are divided by to fall from (M/4, M/2] to (M/2, M] as the response does
   pure real(wp) function power_of(load, m, fall, bounds) result(power)
      !> Harmonics of the load from 1 on, some in both octaves, and M
      real(wp), intent(in) :: load(:)
      integer, intent(in) :: m
      !> Sum over the second octave, over that of the first
      real(wp), intent(in) :: fall
      !> Bounds of the power
      real(wp), intent(in) :: bounds(2)

      real(wp) :: least, most
      integer :: i, k

      least = bounds(1)
      most = bounds(2)
      do i = 1, 20  ! halves of what is open; the sums fall apart with the power
         power = 0.5_wp*(least + most)
         if (sum(load(m/2 + 1:m)*[(real(k, wp)**(-power), k=m/2 + 1, m)]) &
             > fall*sum(load(m/4 + 1:m/2)*[(real(k, wp)**(-power), k=m/4 + 1, m/2)])) then
            least = power
         else
            most = power
         end if
      end do
   end function power_of

end module axijoint_analysis_error_response_tail
