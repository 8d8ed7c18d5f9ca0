!> Elasticity and thermal expansion of solids in the axes r, z, theta.
!> Strains and stresses are ordered r, z, theta, rz, r-theta, z-theta (Eq. 3)
module axijoint_element_elasticity
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: isotropic_elasticity, orthotropic_elasticity, directional_expansion, stable_ratios

   !> Least determinant of the compliance, scaled to a diagonal of ones, that is
   !> told from zero
   real(wp), parameter :: least_determinant = 1.0e-12_wp

contains

   !> Elasticity matrix of an isotropic solid
   pure function isotropic_elasticity(young, poisson) result(d)
      !> Young's modulus
      real(wp), intent(in) :: young
      !> Poisson's ratio
      real(wp), intent(in) :: poisson
      !> Stress = d strain
      real(wp) :: d(6, 6)

      real(wp) :: lame, shear
      integer :: i

      lame = young*poisson/((1.0_wp + poisson)*(1.0_wp - 2.0_wp*poisson))
      shear = 0.5_wp*young/(1.0_wp + poisson)
      d = 0.0_wp
      d(1:3, 1:3) = lame
      do i = 1, 3
         d(i, i) = lame + 2.0_wp*shear
         d(i + 3, i + 3) = shear
      end do
   end function isotropic_elasticity

   !> Elasticity matrix of an orthotropic solid; directions 1 and 2 lie in the
   !> meridional plane, 3 is theta
   pure function orthotropic_elasticity(moduli, ratios, shears, angle) result(d)
      !> E_1, E_2, E_3
      real(wp), intent(in) :: moduli(3)
      !> nu_12, nu_23, nu_13
      real(wp), intent(in) :: ratios(3)
      !> G_12, G_23, G_13
      real(wp), intent(in) :: shears(3)
      !> Angle from r to direction 1, counterclockwise in the (r, z) plane [radian]
      real(wp), intent(in) :: angle
      !> Stress = d strain
      real(wp) :: d(6, 6)

      real(wp) :: along(6, 6), turn(6, 6), root(3), a(3)

      root = sqrt(moduli)
      a = scaled_ratios(moduli, ratios)
      along = 0.0_wp  ! in the order 11, 22, 33, 12, 13, 23
      along(1:3, 1) = root(1)*root*[1.0_wp - a(2)**2, a(1) + a(2)*a(3), a(3) + a(1)*a(2)]
      along(1:3, 2) = root(2)*root*[a(1) + a(2)*a(3), 1.0_wp - a(3)**2, a(2) + a(1)*a(3)]
      along(1:3, 3) = root(3)*root*[a(3) + a(1)*a(2), a(2) + a(1)*a(3), 1.0_wp - a(1)**2]
      along(1:3, 1:3) = along(1:3, 1:3)/scaled_determinant(a)
      along(4, 4) = shears(1)
      along(5, 5) = shears(3)
      along(6, 6) = shears(2)
      turn = strain_rotation(angle)
      d = matmul(transpose(turn), matmul(along, turn))
      d = 0.5_wp*(d + transpose(d))
   end function orthotropic_elasticity

   !> Strain per degree of temperature
   pure function directional_expansion(expansion, angle) result(strain)
      !> Thermal expansion along 1, 2, 3
      real(wp), intent(in) :: expansion(3)
      !> Angle from r to direction 1 [radian]
      real(wp), intent(in) :: angle
      !> Strains r, z, theta, rz, r-theta, z-theta
      real(wp) :: strain(6)

      real(wp) :: along(6), turn(6, 6)

      ! Back to r and z is a rotation by the negative angle.
      turn = strain_rotation(-angle)
      along = 0.0_wp
      along(:3) = expansion
      strain = matmul(turn, along)
   end function directional_expansion

   !> Whether Poisson's ratios leave the elasticity positive definite: no
   !> state of stress may give energy. All moduli must be positive
   pure logical function stable_ratios(moduli, ratios)
      !> E_1, E_2, E_3
      real(wp), intent(in) :: moduli(3)
      !> nu_12, nu_23, nu_13
      real(wp), intent(in) :: ratios(3)

      real(wp) :: a(3)

      a = scaled_ratios(moduli, ratios)
      stable_ratios = all(abs(a) < 1.0_wp)
      if (stable_ratios) stable_ratios = scaled_determinant(a) > least_determinant
   end function stable_ratios

   !> Ratios of the compliance scaled to a diagonal of ones: nu_ij sqrt(E_j/E_i),
   !> the same for ij and ji
   pure function scaled_ratios(moduli, ratios) result(a)
      !> E_1, E_2, E_3
      real(wp), intent(in) :: moduli(3)
      !> nu_12, nu_23, nu_13
      real(wp), intent(in) :: ratios(3)
      !> Ratios 12, 23, 13
      real(wp) :: a(3)

      a = ratios*sqrt(moduli([2, 3, 3])/moduli([1, 2, 1]))
   end function scaled_ratios

   !> Determinant of the scaled compliance, with ones on its diagonal and the
   !> negative ratios beside it
   pure real(wp) function scaled_determinant(a) result(determinant)
      !> Scaled ratios
      real(wp), intent(in) :: a(3)

      determinant = 1.0_wp - sum(a**2) - 2.0_wp*product(a)
   end function scaled_determinant

   !> Strains 11, 22, 33, 12, 13, 23 from r, z, theta, rz, r-theta, z-theta, all
   !> shear strains being engineering strains
   pure function strain_rotation(angle) result(turn)
      !> Angle from r to direction 1 [radian]
      real(wp), intent(in) :: angle
      !> The rotation
      real(wp) :: turn(6, 6)

      real(wp) :: c, s

      c = cos(angle)
      s = sin(angle)
      turn = 0.0_wp
      turn(1, [1, 2, 4]) = [c*c, s*s, c*s]
      turn(2, [1, 2, 4]) = [s*s, c*c, -c*s]
      turn(3, 3) = 1.0_wp
      turn(4, [1, 2, 4]) = [-2.0_wp*c*s, 2.0_wp*c*s, c*c - s*s]
      turn(5, 5:6) = [c, s]
      turn(6, 5:6) = [-s, c]
   end function strain_rotation

end module axijoint_element_elasticity
