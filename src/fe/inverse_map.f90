!> Natural coordinates of a point of an element
module axijoint_fe_inverse_map
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : shape_element, n_corners
   implicit none
   private
   public :: find_natural

   !> Points this far outside in natural coordinates count as inside: coordinates
   !> on cards have few digits
   real(wp), parameter :: margin = 1.0e-6_wp
   !> Most Newton steps, the largest one, and the one that ends them
   integer, parameter :: max_steps = 30
   real(wp), parameter :: longest_step = 1.0_wp, last_step = 1.0e-10_wp

contains

   !> Find the natural coordinates of a point, by Newton's method: from the middle
   !> of the element and, if that fails or ends outside, from four points around
   pure subroutine find_natural(coordinates, position, natural, inside)
      !> r and z of the nodes, shape (2, nodes)
      real(wp), intent(in) :: coordinates(:, :)
      !> r and z of the point
      real(wp), intent(in) :: position(2)
      !> Natural coordinates; within the element if `inside`
      real(wp), intent(out) :: natural(2)
      !> Whether the point is in the element
      logical, intent(out) :: inside

      real(wp), parameter :: square(2, 5) = reshape([0.0_wp, 0.0_wp, -0.6_wp, -0.6_wp, &
         0.6_wp, -0.6_wp, 0.6_wp, 0.6_wp, -0.6_wp, 0.6_wp], [2, 5])
      real(wp), parameter :: triangle(2, 4) = reshape([1.0_wp/3.0_wp, 1.0_wp/3.0_wp, &
         0.1_wp, 0.1_wp, 0.8_wp, 0.1_wp, 0.1_wp, 0.8_wp], [2, 4])
      integer :: k
      logical :: found

      inside = .false.
      do k = 1, merge(4, 5, is_triangle(coordinates))
         if (is_triangle(coordinates)) then
            natural = triangle(:, k)
         else
            natural = square(:, k)
         end if
         call approach(coordinates, position, natural, found)
         if (found) call put_inside(is_triangle(coordinates), natural, inside)
         if (inside) return
      end do
   end subroutine find_natural

   !> Whether an element is a triangle
   pure logical function is_triangle(coordinates)
      !> r and z of the nodes, shape (2, nodes)
      real(wp), intent(in) :: coordinates(:, :)

      is_triangle = n_corners(size(coordinates, 2)) == 3
   end function is_triangle

   !> Newton's method from a start
   pure subroutine approach(coordinates, position, natural, found)
      !> r and z of the nodes, shape (2, nodes)
      real(wp), intent(in) :: coordinates(:, :)
      !> r and z of the point
      real(wp), intent(in) :: position(2)
      !> Natural coordinates: a start, then the point
      real(wp), intent(inout) :: natural(2)
      !> Whether they were found, inside or outside
      logical, intent(out) :: found

      real(wp), dimension(size(coordinates, 2)) :: shape
      real(wp) :: derivative(2, size(coordinates, 2)), gap(2), jacobian(2, 2), determinant, step(2)
      integer :: k

      found = .false.
      do k = 1, max_steps
         call shape_element(size(shape), natural(1), natural(2), shape, derivative)
         gap = position - matmul(coordinates, shape)
         jacobian = matmul(coordinates, transpose(derivative))
         determinant = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
         if (.not. abs(determinant) > epsilon(1.0_wp)*maxval(abs(jacobian))**2) return
         step = [jacobian(2, 2)*gap(1) - jacobian(1, 2)*gap(2), &
                 jacobian(1, 1)*gap(2) - jacobian(2, 1)*gap(1)]/determinant
         natural = natural + step*min(1.0_wp, longest_step/max(maxval(abs(step)), longest_step))
         found = maxval(abs(step)) < last_step
         if (found) return
      end do
   end subroutine approach

   !> Tell whether natural coordinates are in the element, and move those that are
   !> outside by rounding to its edge
   pure subroutine put_inside(triangle, natural, inside)
      !> Whether the element is a triangle
      logical, intent(in) :: triangle
      !> The coordinates
      real(wp), intent(inout) :: natural(2)
      !> Whether they are in the element
      logical, intent(out) :: inside

      if (triangle) then
         inside = minval([natural, 1.0_wp - sum(natural)]) >= -margin
         if (.not. inside) return
         natural = max(0.0_wp, natural)
         natural = natural/max(1.0_wp, sum(natural))
      else
         inside = maxval(abs(natural)) <= 1.0_wp + margin
         if (inside) natural = max(-1.0_wp, min(1.0_wp, natural))
      end if
   end subroutine put_inside

end module axijoint_fe_inverse_map
