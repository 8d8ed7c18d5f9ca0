!> Shape functions of quadrilaterals, triangles and lines
module axijoint_fe_shape
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: shape_element, shape_line, lagrange, n_corners, natural_positions

   !> Natural coordinates of the nine nodes of a quadrilateral, shape (2, 9):
   !> corners counterclockwise, mid-sides, centre
   real(wp), parameter :: node_position(2, 9) = reshape([ &
      -1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp, &
      0.0_wp, -1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, -1.0_wp, 0.0_wp, &
      0.0_wp, 0.0_wp], [2, 9])
   !> The same of the six nodes of a triangle, whose corners are the origin and the
   !> ends of both axes
   real(wp), parameter :: triangle_position(2, 6) = reshape([ &
      0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, &
      0.5_wp, 0.0_wp, 0.5_wp, 0.5_wp, 0.0_wp, 0.5_wp], [2, 6])
   !> Derivatives by x and y of the area coordinates 1 - x - y, x, y of a triangle
   real(wp), parameter :: corner_derivative(2, 3) = reshape([ &
      -1.0_wp, -1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 3])

contains

   !> Corners of an element: 3 or 4. Its sides run from one to the next, and the
   !> mid-side nodes follow the corners in the same order
   elemental integer function n_corners(n)
      !> Number of nodes: 3, 4, 6, 8 or 9
      integer, intent(in) :: n

      n_corners = merge(3, 4, n == 3 .or. n == 6)
   end function n_corners

   !> Natural coordinates of the nodes of an element
   pure function natural_positions(n) result(positions)
      !> Number of nodes: 3, 4, 6, 8 or 9
      integer, intent(in) :: n
      !> The coordinates, shape (2, n)
      real(wp) :: positions(2, n)

      if (n_corners(n) == 3) then
         positions = triangle_position(:, :n)
      else
         positions = node_position(:, :n)
      end if
   end function natural_positions

   !> Shape functions of an element; its number of nodes tells its kind
   pure subroutine shape_element(n, x, y, shape, derivative)
      !> Number of nodes: 3, 4, 6, 8 or 9
      integer, intent(in) :: n
      !> Natural coordinates: in [-1, 1] in a quadrilateral; not negative, of a sum
      !> not above 1 in a triangle
      real(wp), intent(in) :: x, y
      !> Shape functions, shape (n)
      real(wp), intent(out) :: shape(:)
      !> Derivatives by x and y, shape (2, n)
      real(wp), intent(out) :: derivative(:, :)

      select case (n)
      case (3)
         shape(1:3) = [1.0_wp - x - y, x, y]
         derivative(:, 1:3) = corner_derivative
      case (6)
         call quadratic_triangle(x, y, shape, derivative)
      case (4)
         call bilinear(x, y, shape, derivative)
      case (8)
         call serendipity(x, y, shape, derivative)
      case default
         call biquadratic(x, y, shape, derivative)
      end select
   end subroutine shape_element

   !> Quadratic functions of the corners and mid-sides of a triangle
   pure subroutine quadratic_triangle(x, y, shape, derivative)
      !> Natural coordinates
      real(wp), intent(in) :: x, y
      !> Shape functions
      real(wp), intent(out) :: shape(:)
      !> Derivatives by x and y
      real(wp), intent(out) :: derivative(:, :)

      real(wp) :: area(3)
      integer :: i, j

      area = [1.0_wp - x - y, x, y]
      do i = 1, 3
         j = mod(i, 3) + 1
         shape(i) = area(i)*(2.0_wp*area(i) - 1.0_wp)
         derivative(:, i) = (4.0_wp*area(i) - 1.0_wp)*corner_derivative(:, i)
         shape(3 + i) = 4.0_wp*area(i)*area(j)
         derivative(:, 3 + i) = 4.0_wp*(area(i)*corner_derivative(:, j) &
                                        + area(j)*corner_derivative(:, i))
      end do
   end subroutine quadratic_triangle

   !> Shape functions of the 2- or 3-node line
   pure subroutine shape_line(n, x, shape, derivative)
      !> Number of nodes: 2 or 3 (first, last, middle)
      integer, intent(in) :: n
      !> Natural coordinate in [-1, 1]
      real(wp), intent(in) :: x
      !> Shape functions, shape (n)
      real(wp), intent(out) :: shape(:)
      !> Derivatives by x, shape (n)
      real(wp), intent(out) :: derivative(:)

      if (n == 2) then
         shape(1:2) = 0.5_wp*[1.0_wp - x, 1.0_wp + x]
         derivative(1:2) = [-0.5_wp, 0.5_wp]
      else
         shape(1:3) = [0.5_wp*x*(x - 1.0_wp), 0.5_wp*x*(x + 1.0_wp), 1.0_wp - x**2]
         derivative(1:3) = [x - 0.5_wp, x + 0.5_wp, -2.0_wp*x]
      end if
   end subroutine shape_line

   !> The polynomials that are one at one place and zero at the others
   pure function lagrange(places, x) result(values)
      !> The places
      real(wp), intent(in) :: places(:)
      !> Where
      real(wp), intent(in) :: x
      !> The values, one a place
      real(wp) :: values(size(places))

      integer :: i, j

      values = 1.0_wp
      do i = 1, size(places)
         do j = 1, size(places)
            if (j /= i) values(i) = values(i)*(x - places(j))/(places(i) - places(j))
         end do
      end do
   end function lagrange

   !> Bilinear functions of the four corners
   pure subroutine bilinear(x, y, shape, derivative)
      !> Natural coordinates
      real(wp), intent(in) :: x, y
      !> Shape functions
      real(wp), intent(out) :: shape(:)
      !> Derivatives by x and y
      real(wp), intent(out) :: derivative(:, :)

      integer :: i

      do i = 1, 4
         associate (a => node_position(1, i), b => node_position(2, i))
            shape(i) = 0.25_wp*(1.0_wp + a*x)*(1.0_wp + b*y)
            derivative(1, i) = 0.25_wp*a*(1.0_wp + b*y)
            derivative(2, i) = 0.25_wp*b*(1.0_wp + a*x)
         end associate
      end do
   end subroutine bilinear

   !> Serendipity functions: bilinear corners and quadratic sides
   pure subroutine serendipity(x, y, shape, derivative)
      !> Natural coordinates
      real(wp), intent(in) :: x, y
      !> Shape functions
      real(wp), intent(out) :: shape(:)
      !> Derivatives by x and y
      real(wp), intent(out) :: derivative(:, :)

      integer :: i

      do i = 1, 8
         associate (a => node_position(1, i), b => node_position(2, i))
            if (i <= 4) then
               shape(i) = 0.25_wp*(1.0_wp + a*x)*(1.0_wp + b*y)*(a*x + b*y - 1.0_wp)
               derivative(1, i) = 0.25_wp*a*(1.0_wp + b*y)*(2.0_wp*a*x + b*y)
               derivative(2, i) = 0.25_wp*b*(1.0_wp + a*x)*(a*x + 2.0_wp*b*y)
            else if (mod(i, 2) == 1) then  ! sides y = -1 and y = 1
               shape(i) = 0.5_wp*(1.0_wp - x**2)*(1.0_wp + b*y)
               derivative(1, i) = -x*(1.0_wp + b*y)
               derivative(2, i) = 0.5_wp*b*(1.0_wp - x**2)
            else  ! sides x = 1 and x = -1
               shape(i) = 0.5_wp*(1.0_wp + a*x)*(1.0_wp - y**2)
               derivative(1, i) = 0.5_wp*a*(1.0_wp - y**2)
               derivative(2, i) = -y*(1.0_wp + a*x)
            end if
         end associate
      end do
   end subroutine serendipity

   !> Lagrange functions of nine nodes, products of quadratic line functions
   pure subroutine biquadratic(x, y, shape, derivative)
      !> Natural coordinates
      real(wp), intent(in) :: x, y
      !> Shape functions
      real(wp), intent(out) :: shape(:)
      !> Derivatives by x and y
      real(wp), intent(out) :: derivative(:, :)

      real(wp), dimension(3) :: fx, fy, dx, dy
      integer :: i, j, k

      call shape_line(3, x, fx, dx)
      call shape_line(3, y, fy, dy)
      do k = 1, 9
         i = line_node(node_position(1, k))
         j = line_node(node_position(2, k))
         shape(k) = fx(i)*fy(j)
         derivative(1, k) = dx(i)*fy(j)
         derivative(2, k) = fx(i)*dy(j)
      end do
   end subroutine biquadratic

   !> Number of the node of a quadratic line at a natural coordinate
   pure integer function line_node(x)
      !> -1, 0 or 1
      real(wp), intent(in) :: x
      integer, parameter :: number(-1:1) = [1, 3, 2]

      line_node = number(nint(x))
   end function line_node

end module axijoint_fe_shape
