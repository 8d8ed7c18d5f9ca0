!> Functions of theta that loads follow round the circle, and their Fourier series
module axijoint_fe_circle_function
   use axijoint_base_kinds, only : wp, pi, degree
   use axijoint_fe_fourier, only : cosine_of_degrees, sine_of_degrees
   implicit none
   private
   public :: circle_function_type, new_patch, new_cosine, new_table
   public :: fourier_coefficients, mean_square, value_at, share_left_out, are_alike

   !> A function that is linear piece by piece, plus one cosine; zero outside the
   !> pieces. Either part may be lacking
   type :: circle_function_type
      !> Pieces: first and last angle [degree], shape (pieces)
      real(wp), allocatable :: from(:), to(:)
      !> Values at these ends
      real(wp), allocatable :: first(:), last(:)
      !> Harmonic of the cosine; negative if there is none
      integer :: harmonic = -1
      !> Angle of its maximum [degree]
      real(wp) :: angle = 0.0_wp
   end type circle_function_type

   !> Argument below which j1 is summed as a series
   real(wp), parameter :: series_limit = 1.0_wp
   !> Terms of the series: the first one left out is below 4E-18 of the sum
   integer, parameter :: n_terms = 9

contains

   !> 1 between two angles, 0 elsewhere
   pure function new_patch(from, to) result(f)
      !> First angle, and last angle counterclockwise from it [degree]; the width is
      !> above 0 and at most 360
      real(wp), intent(in) :: from, to
      !> The function
      type(circle_function_type) :: f

      f%from = [from]
      f%to = [to]
      f%first = [1.0_wp]
      f%last = [1.0_wp]
   end function new_patch

   !> cos m(theta - theta0)
   pure function new_cosine(harmonic, angle) result(f)
      !> m
      integer, intent(in) :: harmonic
      !> theta0 [degree]
      real(wp), intent(in) :: angle
      !> The function
      type(circle_function_type) :: f

      allocate (f%from(0), f%to(0), f%first(0), f%last(0))
      f%harmonic = harmonic
      f%angle = angle
   end function new_cosine

   !> Linear between given values, and from the last one on to the first one
   pure function new_table(angles, values) result(f)
      !> Angles, ascending, the last at most 360 above the first [degree]
      real(wp), intent(in) :: angles(:)
      !> Values there
      real(wp), intent(in) :: values(:)
      !> The function
      type(circle_function_type) :: f

      f%from = angles
      f%to = [angles(2:), angles(1) + 360.0_wp]
      f%first = values
      f%last = [values(2:), values(1)]
   end function new_table

   !> Mean and coefficients of a harmonic: f = a_0 + sum of a_m cos(m theta)
   !> + b_m sin(m theta). With y = m times the half width of a piece, its centre c, its
   !> mean value p and half its rise q, the integrals of f cos and f sin over the piece
   !> are width (p j0(y) cos(mc) - q j1(y) sin(mc)) and width (p j0(y) sin(mc)
   !> + q j1(y) cos(mc)), with the spherical Bessel functions j0 and j1: nothing
   !> cancels, however narrow the piece and however high the harmonic
   pure subroutine fourier_coefficients(f, harmonic, a, b)
      !> The function
      type(circle_function_type), intent(in) :: f
      !> m
      integer, intent(in) :: harmonic
      !> Factors of cos(m theta) and sin(m theta); b is 0 for m = 0
      real(wp), intent(out) :: a, b

      real(wp) :: even, odd, cosine, sine, width
      integer :: i

      a = 0.0_wp
      b = 0.0_wp
      do i = 1, size(f%from)
         width = f%to(i) - f%from(i)
         even = 0.5_wp*(f%first(i) + f%last(i))*bessel_0(0.5_wp*harmonic*width)
         odd = 0.5_wp*(f%last(i) - f%first(i))*bessel_1(0.5_wp*harmonic*width)
         cosine = cosine_of_degrees(0.5_wp*harmonic*(f%from(i) + f%to(i)))
         sine = sine_of_degrees(0.5_wp*harmonic*(f%from(i) + f%to(i)))
         a = a + width*(even*cosine - odd*sine)
         b = b + width*(even*sine + odd*cosine)
      end do
      a = a/merge(360.0_wp, 180.0_wp, harmonic == 0)
      b = b/180.0_wp
      if (harmonic == 0) b = 0.0_wp
      if (harmonic /= f%harmonic) return
      a = a + cosine_of_degrees(harmonic*f%angle)
      b = b + sine_of_degrees(harmonic*f%angle)
   end subroutine fourier_coefficients

   !> sin(y)/y
   pure real(wp) function bessel_0(y_degrees)
      !> y [degree], not negative
      real(wp), intent(in) :: y_degrees

      bessel_0 = 1.0_wp
      if (y_degrees > 0.0_wp) bessel_0 = sine_of_degrees(y_degrees)/(degree*y_degrees)
   end function bessel_0

   !> (sin(y)/y - cos(y))/y; for small y, where the difference cancels, its series
   !> y/3 (1 - y**2/(2 5) + y**4/(2 4 5 7) - ...) (Abramowitz and Stegun 10.1.2)
   pure real(wp) function bessel_1(y_degrees)
      !> y [degree], not negative
      real(wp), intent(in) :: y_degrees

      real(wp) :: y, term
      integer :: k

      y = degree*y_degrees
      if (y > series_limit) then
         bessel_1 = (bessel_0(y_degrees) - cosine_of_degrees(y_degrees))/y
         return
      end if
      term = y/3.0_wp
      bessel_1 = 0.0_wp
      do k = 1, n_terms
         bessel_1 = bessel_1 + term
         term = -term*y**2/real(2*k*(2*k + 3), wp)
      end do
   end function bessel_1

   !> Mean of f**2 over the circle
   pure real(wp) function mean_square(f)
      !> The function: pieces or a cosine, not both
      type(circle_function_type), intent(in) :: f

      ! The mean of (p + q x)**2 for x from -1 to 1 is p**2 + q**2/3.
      mean_square = sum((f%to - f%from)/360.0_wp*(0.25_wp*(f%first + f%last)**2 &
                                                  + (f%last - f%first)**2/12.0_wp))
      if (f%harmonic == 0) mean_square = mean_square + 1.0_wp
      if (f%harmonic > 0) mean_square = mean_square + 0.5_wp
   end function mean_square

   !> The value at an angle; the mean of both sides is not taken at jumps
   pure real(wp) function value_at(f, angle) result(value)
      !> The function
      type(circle_function_type), intent(in) :: f
      !> theta [degree]
      real(wp), intent(in) :: angle

      real(wp) :: along
      integer :: i

      value = 0.0_wp
      do i = 1, size(f%from)
         if (.not. f%to(i) > f%from(i)) cycle
         along = modulo(angle - f%from(i), 360.0_wp)/(f%to(i) - f%from(i))
         if (along < 1.0_wp) value = value + f%first(i) + along*(f%last(i) - f%first(i))
      end do
      if (f%harmonic >= 0) value = value + cosine_of_degrees(f%harmonic*(angle - f%angle))
   end function value_at

   !> Whether two functions are the same
   pure logical function are_alike(f, g)
      !> The functions
      type(circle_function_type), intent(in) :: f, g

      are_alike = f%harmonic == g%harmonic .and. abs(f%angle - g%angle) <= 0.0_wp .and. size(f%from) == size(g%from)
      if (are_alike) are_alike = all(abs(f%from - g%from) + abs(f%to - g%to) + abs(f%first - g%first) &
         + abs(f%last - g%last) <= 0.0_wp)
   end function are_alike

   !> Root mean square of what some harmonics leave of a function, over that of the
   !> function (Parseval). Below the square root of the rounding errors it is 0
   pure real(wp) function share_left_out(f, harmonics) result(share)
      !> The function
      type(circle_function_type), intent(in) :: f
      !> The harmonics, each once
      integer, intent(in) :: harmonics(:)

      real(wp) :: a, b, captured, total
      integer :: i

      share = 0.0_wp
      total = mean_square(f)
      if (.not. total > 0.0_wp) return
      captured = 0.0_wp
      do i = 1, size(harmonics)
         call fourier_coefficients(f, harmonics(i), a, b)
         captured = captured + merge(1.0_wp, 0.5_wp, harmonics(i) == 0)*(a**2 + b**2)
      end do
      share = 1.0_wp - captured/total
      if (share < real(size(harmonics) + 4, wp)*epsilon(1.0_wp)) share = 0.0_wp
      share = sqrt(share)
   end function share_left_out

end module axijoint_fe_circle_function
