!> Harmonics round the circle: exact values at fractions of pi and at multiples of
!> 90 degrees, integrals
module axijoint_fe_fourier
   use axijoint_base_kinds, only : wp, pi, degree
   implicit none
   private
   public :: circle_integral, cosine_of_fraction, sine_of_fraction, cosine_of_degrees, &
      sine_of_degrees

contains

   !> Integral over the circle of cos^2(m theta) or sin^2(m theta): 2 pi for
   !> m = 0, pi otherwise
   elemental function circle_integral(harmonic) result(integral)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> The integral
      real(wp) :: integral

      integral = merge(2.0_wp*pi, pi, harmonic == 0)
   end function circle_integral

   !> cos(pi p/q), with exact zeros and ones and exactly symmetric about them. A
   !> joint stress that must vanish on a plane then does: rounding of cos(pi/2)
   !> would make it tension or pressure by chance
   elemental function cosine_of_fraction(p, q) result(cosine)
      !> Numerator and denominator, q > 0
      integer, intent(in) :: p, q
      !> The cosine
      real(wp) :: cosine

      integer :: k

      k = modulo(p, 2*q)
      if (k > q) k = 2*q - k  ! 0 <= k <= q: half a turn
      if (2*k == q) then
         cosine = 0.0_wp
      else if (2*k > q) then
         cosine = -cos(pi*(q - k)/q)
      else
         cosine = cos(pi*k/q)
      end if
   end function cosine_of_fraction

   !> sin(pi p/q), with exact zeros and ones and exactly symmetric about them
   elemental function sine_of_fraction(p, q) result(sine)
      !> Numerator and denominator, q > 0
      integer, intent(in) :: p, q
      !> The sine
      real(wp) :: sine

      sine = cosine_of_fraction(2*p - q, 2*q)  ! sin x = cos(x - pi/2)
   end function sine_of_fraction

   !> Cosine of an angle in degrees, with exact zeros and ones: a load along theta = 90
   !> has no symmetric part, not one of rounding
   elemental function cosine_of_degrees(angle) result(cosine)
      !> The angle [degree]
      real(wp), intent(in) :: angle
      !> The cosine
      real(wp) :: cosine

      cosine = sine_of_degrees(90.0_wp - abs(modulo_360(angle)))
   end function cosine_of_degrees

   !> Sine of an angle in degrees, with exact zeros and ones
   elemental function sine_of_degrees(angle) result(sine)
      !> The angle [degree]
      real(wp), intent(in) :: angle
      !> The sine
      real(wp) :: sine

      real(wp) :: x

      x = modulo_360(angle)
      if (abs(x) > 90.0_wp) x = sign(180.0_wp, x) - x
      sine = sin(degree*x)
      if (abs(x) > 45.0_wp) sine = sign(cos(degree*(90.0_wp - abs(x))), x)
   end function sine_of_degrees

   !> An angle less full turns, -180 to 180; without rounding
   elemental function modulo_360(angle) result(turned)
      !> The angle [degree]
      real(wp), intent(in) :: angle
      !> The same direction
      real(wp) :: turned

      turned = mod(angle, 360.0_wp)
      if (abs(turned) > 180.0_wp) turned = turned - sign(360.0_wp, turned)
   end function modulo_360

end module axijoint_fe_fourier
