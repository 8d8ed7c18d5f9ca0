!> Quadrilateral rings: strain, stiffness and stress of one harmonic
module axijoint_element_solid
   use axijoint_base_kinds, only : wp
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_quadrilateral
   implicit none
   private
   public :: solid_point_type, solid_points, isotropic_elasticity
   public :: strain_matrices, solid_stiffness, solid_stress, solid_force

   !> What the integrals over an element need at one Gauss point
   type :: solid_point_type
      !> r and z
      real(wp) :: position(2) = 0.0_wp
      !> Weight of the point times the Jacobian times r
      real(wp) :: weight = 0.0_wp
      !> Shape functions, the first n of which are in use
      real(wp) :: shape(9) = 0.0_wp
      !> Their derivatives by r and z
      real(wp) :: gradient(2, 9) = 0.0_wp
   end type solid_point_type

contains

   !> Gauss points of an element
   pure subroutine solid_points(coordinates, n_gauss, points)
      !> r and z of the nodes, shape (2, 4 | 8 | 9)
      real(wp), intent(in) :: coordinates(:, :)
      !> Gauss points in each direction
      integer, intent(in) :: n_gauss
      !> The points, shape (n_gauss**2)
      type(solid_point_type), intent(out) :: points(:)

      real(wp) :: x(3), w(3), local(2, 9), jacobian(2, 2), determinant
      integer :: i, j, k, n

      n = size(coordinates, 2)
      call gauss_rule(n_gauss, x, w)
      k = 0
      do j = 1, n_gauss
         do i = 1, n_gauss
            k = k + 1
            associate (p => points(k))
               call shape_quadrilateral(n, x(i), x(j), p%shape(:n), local(:, :n))
               jacobian = matmul(local(:, :n), transpose(coordinates))
               determinant = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
               p%gradient(1, :n) = (jacobian(2, 2)*local(1, :n) &
                                    - jacobian(1, 2)*local(2, :n))/determinant
               p%gradient(2, :n) = (jacobian(1, 1)*local(2, :n) &
                                    - jacobian(2, 1)*local(1, :n))/determinant
               p%position = matmul(coordinates, p%shape(:n))
               p%weight = w(i)*w(j)*determinant*p%position(1)
            end associate
         end do
      end do
   end subroutine solid_points

   !> Elasticity matrix of an isotropic solid; strains r, z, theta, rz, r-theta, z-theta
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

   !> The strain matrix is linear in the harmonic: B_m = B0 + m B1 (Eq. 4)
   pure subroutine strain_matrices(point, n, b0, b1)
      !> Where
      type(solid_point_type), intent(in) :: point
      !> Number of nodes
      integer, intent(in) :: n
      !> The two parts for the unknowns u1, v1, w1, u2, ..., shape (6, 3n)
      real(wp), intent(out) :: b0(:, :), b1(:, :)

      real(wp) :: dr, dz, nr
      integer :: i, u, v, w

      b0 = 0.0_wp
      b1 = 0.0_wp
      do i = 1, n
         u = 3*i - 2
         v = 3*i - 1
         w = 3*i
         dr = point%gradient(1, i)
         dz = point%gradient(2, i)
         nr = point%shape(i)/point%position(1)
         b0(1, u) = dr
         b0(2, v) = dz
         b0(3, u) = nr
         b0(4, u) = dz
         b0(4, v) = dr
         b0(5, w) = dr - nr
         b0(6, w) = dz
         b1(3, w) = nr
         b1(5, u) = -nr
         b1(6, v) = -nr
      end do
   end subroutine strain_matrices

   !> The parts of the stiffness of an element, free of the harmonic:
   !> K_m = c_m (A + m S + m^2 C), c_0 = 2 pi, c_m = pi (Eq. 5)
   pure subroutine solid_stiffness(points, n, d, a, s, c)
      !> Gauss points of the element
      type(solid_point_type), intent(in) :: points(:)
      !> Number of nodes
      integer, intent(in) :: n
      !> Elasticity matrix
      real(wp), intent(in) :: d(6, 6)
      !> The parts, shape (3n, 3n)
      real(wp), intent(out) :: a(:, :), s(:, :), c(:, :)

      real(wp), dimension(6, 3*n) :: b0, b1, db0, db1
      real(wp) :: cross(3*n, 3*n)
      integer :: k

      a = 0.0_wp
      s = 0.0_wp
      c = 0.0_wp
      do k = 1, size(points)
         call strain_matrices(points(k), n, b0, b1)
         db0 = points(k)%weight*matmul(d, b0)
         db1 = points(k)%weight*matmul(d, b1)
         cross = matmul(transpose(b0), db1)
         a = a + matmul(transpose(b0), db0)
         s = s + cross + transpose(cross)
         c = c + matmul(transpose(b1), db1)
      end do
   end subroutine solid_stiffness

   !> Stress amplitudes of one harmonic at a point
   pure function solid_stress(point, n, d, harmonic, displacement) result(stress)
      !> Where
      type(solid_point_type), intent(in) :: point
      !> Number of nodes
      integer, intent(in) :: n
      !> Elasticity matrix
      real(wp), intent(in) :: d(6, 6)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Amplitudes u1, v1, w1, u2, ..., shape (3n)
      real(wp), intent(in) :: displacement(:)
      !> Amplitudes of r, z, theta, rz, r-theta, z-theta
      real(wp) :: stress(6)

      real(wp), dimension(6, 3*n) :: b0, b1

      call strain_matrices(point, n, b0, b1)
      stress = matmul(d, matmul(b0 + harmonic*b1, displacement))
   end function solid_stress

   !> Nodal forces that balance a stress of one harmonic at a point, to be
   !> multiplied by c_m: weight B_m^T stress
   pure function solid_force(point, n, harmonic, stress) result(force)
      !> Where
      type(solid_point_type), intent(in) :: point
      !> Number of nodes
      integer, intent(in) :: n
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Stress amplitudes
      real(wp), intent(in) :: stress(6)
      !> Generalized nodal forces u1, v1, w1, u2, ..., shape (3n)
      real(wp) :: force(3*n)

      real(wp), dimension(6, 3*n) :: b0, b1

      call strain_matrices(point, n, b0, b1)
      force = point%weight*matmul(stress, b0 + harmonic*b1)
   end function solid_force

end module axijoint_element_solid
