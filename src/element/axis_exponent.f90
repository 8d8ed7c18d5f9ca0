!> How singular stress is at the axis: displacements go like r^lambda, stresses like r^(lambda - 1). With moduli that differ in the
!> plane across the axis, lambda is below 1 where the solid is softer round the circle than along r (Lekhnitskii)
module axijoint_element_axis_exponent
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: axis_exponent

   !> Exponents are looked for between these, by steps
   real(wp), parameter :: least = 0.01_wp, most = 0.99_wp, step = 0.01_wp
   !> Times that a step is halved
   integer, parameter :: halves = 40

contains

   !> lambda of a harmonic; 1 if stress is not singular
   pure function axis_exponent(d, harmonic) result(lambda)
      !> Elasticity in the order r, z, theta, rz, r-theta, z-theta
      real(wp), intent(in) :: d(6, 6)
      !> Harmonic
      integer, intent(in) :: harmonic
      !> lambda
      real(wp) :: lambda

      real(wp) :: low, high
      integer :: k

      lambda = 1.0_wp
      low = least
      do while (low < most)
         high = low + step
         if (out_of_balance(d, harmonic, low)*out_of_balance(d, harmonic, high) <= 0.0_wp) exit
         low = high
      end do
      if (.not. low < most) return
      do k = 1, halves
         lambda = 0.5_wp*(low + high)
         if (out_of_balance(d, harmonic, low)*out_of_balance(d, harmonic, lambda) <= 0.0_wp) then
            high = lambda
         else
            low = lambda
         end if
      end do
   end function axis_exponent

   !> Determinant of the forces r^(lambda - 2) that displacements r^lambda leave out of balance along r, z and theta; along z
   !> they do not change. Harmonic 0 has no torsion here, whose lambda is 1
   pure real(wp) function out_of_balance(d, m, lambda) result(determinant)
      !> Elasticity
      real(wp), intent(in) :: d(6, 6)
      !> Harmonic
      integer, intent(in) :: m
      !> lambda
      real(wp), intent(in) :: lambda

      real(wp) :: strain(6, 3), stress(6, 3), f(3, 3)

      strain = 0.0_wp
      strain([1, 3, 5], 1) = [lambda, 1.0_wp, -real(m, wp)]
      strain([4, 6], 2) = [lambda, -real(m, wp)]
      strain([3, 5], 3) = [real(m, wp), lambda - 1.0_wp]
      stress = matmul(d, strain)
      f(1, :) = lambda*stress(1, :) + m*stress(5, :) - stress(3, :)
      f(2, :) = lambda*stress(4, :) + m*stress(6, :)
      f(3, :) = (lambda + 1.0_wp)*stress(5, :) - m*stress(3, :)
      if (m == 0) then
         determinant = f(1, 1)*f(2, 2) - f(1, 2)*f(2, 1)
      else
         determinant = f(1, 1)*(f(2, 2)*f(3, 3) - f(2, 3)*f(3, 2)) - f(1, 2)*(f(2, 1)*f(3, 3) - f(2, 3)*f(3, 1)) &
                       + f(1, 3)*(f(2, 1)*f(3, 2) - f(2, 2)*f(3, 1))
      end if
   end function out_of_balance

end module axijoint_element_axis_exponent
