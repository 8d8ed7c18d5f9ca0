!> Exact solutions of rings in plane strain under cos(m theta): power solutions
!> r^lambda of Navier's equations, which Michell's stress function gives too
module axijoint_test_rings
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: ring_type, new_ring, ring_displacement, ring_stress, ring_all_stresses, ring_unbalance
   public :: solve_joined_rings

   interface
      !> LAPACK: solution of a general system
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv
   end interface

   !> Sum of power solutions u = c_k U_k r^lambda_k, w = c_k W_k r^lambda_k
   type :: ring_type
      !> Harmonic m
      integer :: harmonic = 0
      !> Lame's constants
      real(wp) :: lame = 0.0_wp, shear = 0.0_wp
      !> Exponents
      integer, allocatable :: exponent(:)
      !> U and W of each, shape (2, exponents)
      real(wp), allocatable :: shape(:, :)
      !> Factors
      real(wp), allocatable :: factor(:)
   end type ring_type

contains

   !> Power solutions of harmonic m; for m = 1 without those of a net force,
   !> for m = 0 without torsion
   function new_ring(harmonic, young, poisson) result(ring)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Elastic constants
      real(wp), intent(in) :: young, poisson
      !> The ring, factors zero
      type(ring_type) :: ring

      integer :: k
      real(wp) :: a, b

      ring%harmonic = harmonic
      ring%lame = young*poisson/((1.0_wp + poisson)*(1.0_wp - 2.0_wp*poisson))
      ring%shear = 0.5_wp*young/(1.0_wp + poisson)
      select case (harmonic)
      case (0)
         ring%exponent = [1, -1]
      case (1)
         ring%exponent = [2, -2, 0]
      case default
         ring%exponent = [harmonic + 1, harmonic - 1, 1 - harmonic, -harmonic - 1]
      end select
      allocate (ring%shape(2, size(ring%exponent)), ring%factor(size(ring%exponent)))
      ring%factor = 0.0_wp
      do k = 1, size(ring%exponent)
         if (harmonic == 0) then
            ring%shape(:, k) = [1.0_wp, 0.0_wp]
         else  ! a U + b W = 0 keeps the balance of forces along theta
            a = theta_balance(ring, ring%exponent(k), [1.0_wp, 0.0_wp])
            b = theta_balance(ring, ring%exponent(k), [0.0_wp, 1.0_wp])
            ring%shape(:, k) = [-b, a]/hypot(a, b)
         end if
      end do
   end function new_ring

   !> Stress factors of u = U r^lambda, w = W r^lambda, to be multiplied by
   !> r^(lambda - 1): sigma_r, sigma_theta, tau
   pure function power_stress(ring, lambda, uw) result(stress)
      !> The ring
      type(ring_type), intent(in) :: ring
      !> Exponent
      integer, intent(in) :: lambda
      !> U and W
      real(wp), intent(in) :: uw(2)
      !> The factors
      real(wp) :: stress(3)

      real(wp) :: er, et, g

      er = lambda*uw(1)
      et = uw(1) + ring%harmonic*uw(2)
      g = -ring%harmonic*uw(1) + (lambda - 1)*uw(2)
      stress = [ring%lame*(er + et) + 2.0_wp*ring%shear*er, &
                ring%lame*(er + et) + 2.0_wp*ring%shear*et, ring%shear*g]
   end function power_stress

   !> Balance of forces along theta: (lambda + 1) tau - m sigma_theta
   pure function theta_balance(ring, lambda, uw) result(balance)
      !> The ring
      type(ring_type), intent(in) :: ring
      !> Exponent
      integer, intent(in) :: lambda
      !> U and W
      real(wp), intent(in) :: uw(2)
      !> What is out of balance
      real(wp) :: balance

      real(wp) :: stress(3)

      stress = power_stress(ring, lambda, uw)
      balance = (lambda + 1)*stress(3) - ring%harmonic*stress(2)
   end function theta_balance

   !> Largest unbalance of the power solutions, along r and theta, over the
   !> stresses: zero if they are exact
   pure function ring_unbalance(ring) result(unbalance)
      !> The ring
      type(ring_type), intent(in) :: ring
      !> The unbalance
      real(wp) :: unbalance

      real(wp) :: stress(3), scale
      integer :: k

      unbalance = 0.0_wp
      scale = ring%lame + ring%shear
      do k = 1, size(ring%exponent)
         stress = power_stress(ring, ring%exponent(k), ring%shape(:, k))
         unbalance = max(unbalance, &
                         abs(ring%exponent(k)*stress(1) + ring%harmonic*stress(3) - stress(2)), &
                         abs(theta_balance(ring, ring%exponent(k), ring%shape(:, k))))
      end do
      unbalance = unbalance/scale
   end function ring_unbalance

   !> u and w of each power solution at r, shape (2, exponents)
   pure function displacement_terms(ring, r) result(terms)
      !> The ring
      type(ring_type), intent(in) :: ring
      !> Radius
      real(wp), intent(in) :: r
      !> The terms
      real(wp) :: terms(2, size(ring%exponent))

      terms = ring%shape*spread(r**ring%exponent, 1, 2)
   end function displacement_terms

   !> sigma_r and tau of each power solution at r, shape (2, exponents)
   pure function stress_terms(ring, r) result(terms)
      !> The ring
      type(ring_type), intent(in) :: ring
      !> Radius
      real(wp), intent(in) :: r
      !> The terms
      real(wp) :: terms(2, size(ring%exponent))

      real(wp) :: stress(3)
      integer :: k

      do k = 1, size(ring%exponent)
         stress = power_stress(ring, ring%exponent(k), ring%shape(:, k))
         terms(:, k) = stress([1, 3])*r**(ring%exponent(k) - 1)
      end do
   end function stress_terms

   !> Amplitudes of u and w
   pure function ring_displacement(ring, r) result(uw)
      !> The ring
      type(ring_type), intent(in) :: ring
      !> Radius
      real(wp), intent(in) :: r
      !> u and w
      real(wp) :: uw(2)

      uw = matmul(displacement_terms(ring, r), ring%factor)
   end function ring_displacement

   !> Amplitudes of sigma_r and tau
   pure function ring_stress(ring, r) result(stress)
      !> The ring
      type(ring_type), intent(in) :: ring
      !> Radius
      real(wp), intent(in) :: r
      !> sigma_r and tau
      real(wp) :: stress(2)

      stress = matmul(stress_terms(ring, r), ring%factor)
   end function ring_stress

   !> Amplitudes of all six stresses r, z, theta, rz, r-theta, z-theta
   pure function ring_all_stresses(ring, r) result(stress)
      !> The ring
      type(ring_type), intent(in) :: ring
      !> Radius
      real(wp), intent(in) :: r
      !> The stresses
      real(wp) :: stress(6)

      integer :: k

      stress = 0.0_wp
      do k = 1, size(ring%exponent)
         stress([1, 3, 5]) = stress([1, 3, 5]) + ring%factor(k)*r**(ring%exponent(k) - 1) &
                             *power_stress(ring, ring%exponent(k), ring%shape(:, k))
      end do
      stress(2) = 0.5_wp*ring%lame/(ring%lame + ring%shear)*(stress(1) + stress(3))
   end function ring_all_stresses

   !> Two rings a < r < c and c < r < b joined at c by springs, free at a, with
   !> sigma_r = p (for m = 1 also tau = p, so that no net force acts) at b.
   !> For m = 1, w = 0 at a.
   subroutine solve_joined_rings(inner, outer, a, c, b, normal_stiffness, shear_stiffness, p)
      !> The rings; factors on return
      type(ring_type), intent(inout) :: inner, outer
      !> Radii
      real(wp), intent(in) :: a, c, b
      !> Stiffness per unit area; infinite if not positive
      real(wp), intent(in) :: normal_stiffness, shear_stiffness
      !> Amplitude of the radial traction at b
      real(wp), intent(in) :: p

      real(wp), allocatable :: matrix(:, :), x(:)
      real(wp) :: flexibility(2)
      integer :: n, m

      n = size(inner%exponent)
      m = inner%harmonic
      allocate (matrix(2*n, 2*n), x(2*n), source=0.0_wp)
      flexibility = 1.0_wp/[normal_stiffness, shear_stiffness]
      ! displacement differs by stress times flexibility, the stress does not differ
      associate (jump => displacement_terms(outer, c), stress => stress_terms(outer, c))
         select case (m)
         case (0)
            matrix(1, :n) = first(stress_terms(inner, a))
            matrix(2, n + 1:) = first(stress_terms(outer, b))
            matrix(3, :) = [-first(displacement_terms(inner, c)), &
                            first(jump) - flexibility(1)*first(stress)]
            matrix(4, :) = [first(stress_terms(inner, c)), -first(stress)]
            x(2) = p
         case (1)  ! sigma_r = tau everywhere: one condition each
            matrix(1, :n) = first(stress_terms(inner, a))
            matrix(2, n + 1:) = first(stress_terms(outer, b))
            matrix(3:4, :n) = -displacement_terms(inner, c)
            matrix(3:4, n + 1:) = jump - spread(flexibility, 2, n)*stress
            matrix(5, :) = [first(stress_terms(inner, c)), -first(stress)]
            matrix(6, :n) = second(displacement_terms(inner, a))
            x(2) = p
         case default
            matrix(1:2, :n) = stress_terms(inner, a)
            matrix(3:4, n + 1:) = stress_terms(outer, b)
            matrix(5:6, :n) = -displacement_terms(inner, c)
            matrix(5:6, n + 1:) = jump - spread(flexibility, 2, n)*stress
            matrix(7:8, :n) = stress_terms(inner, c)
            matrix(7:8, n + 1:) = -stress
            x(3) = p
         end select
      end associate
      call solve_dense(matrix, x)
      inner%factor = x(:n)
      outer%factor = x(n + 1:)
   end subroutine solve_joined_rings

   !> First row
   pure function first(terms)
      !> Terms, shape (2, n)
      real(wp), intent(in) :: terms(:, :)
      !> The row
      real(wp) :: first(size(terms, 2))

      first = terms(1, :)
   end function first

   !> Second row
   pure function second(terms)
      !> Terms, shape (2, n)
      real(wp), intent(in) :: terms(:, :)
      !> The row
      real(wp) :: second(size(terms, 2))

      second = terms(2, :)
   end function second

   !> Solve a small general system, its rows scaled to the same size first
   subroutine solve_dense(matrix, x)
      !> The matrix; destroyed
      real(wp), intent(inout) :: matrix(:, :)
      !> Right-hand side, then solution
      real(wp), intent(inout) :: x(:)

      integer :: pivot(size(x)), info, i
      real(wp) :: scale

      do i = 1, size(x)
         scale = maxval(abs(matrix(i, :)))
         matrix(i, :) = matrix(i, :)/scale
         x(i) = x(i)/scale
      end do
      call dgesv(size(x), 1, matrix, size(x), pivot, x, size(x), info)
      if (info /= 0) error stop 'singular system of an exact solution'
   end subroutine solve_dense

end module axijoint_test_rings
