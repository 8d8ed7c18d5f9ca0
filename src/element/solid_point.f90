!> Integration points of quadrilateral and triangular rings, and the strain of one harmonic there
module axijoint_element_solid_point
   use axijoint_base_kinds, only : wp
   use axijoint_fe_reference, only : reference_type
   implicit none
   private
   public :: solid_point_type, solid_points, strain_matrices

   !> What the integrals over an element need at one integration point
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

   !> Integration points of an element
   pure subroutine solid_points(coordinates, reference, points)
      !> r and z of the nodes, shape (2, nodes)
      real(wp), intent(in) :: coordinates(:, :)
      !> The element in natural coordinates
      type(reference_type), intent(in) :: reference
      !> The points, shape (reference%n_points)
      type(solid_point_type), intent(out) :: points(:)

      real(wp) :: jacobian(2, 2), determinant
      integer :: i, k, n

      n = reference%n_nodes
      do k = 1, reference%n_points
         associate (p => points(k), local => reference%derivative(:, :, k))
            jacobian = 0.0_wp
            p%position = 0.0_wp
            do i = 1, n
               p%shape(i) = reference%shape(i, k)
               p%position = p%position + p%shape(i)*coordinates(:, i)
               jacobian(:, 1) = jacobian(:, 1) + local(1, i)*coordinates(:, i)
               jacobian(:, 2) = jacobian(:, 2) + local(2, i)*coordinates(:, i)
            end do
            determinant = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
            do i = 1, n
               p%gradient(1, i) = (jacobian(2, 2)*local(1, i) - &
                  jacobian(2, 1)*local(2, i))/determinant
               p%gradient(2, i) = (jacobian(1, 1)*local(2, i) - &
                  jacobian(1, 2)*local(1, i))/determinant
            end do
            p%weight = reference%weight(k)*determinant*p%position(1)
         end associate
      end do
   end subroutine solid_points

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

end module axijoint_element_solid_point
