!> Quadrature rules on [-1, 1], on the square and on the triangle
module axijoint_fe_quadrature
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: gauss_rule, lobatto_rule, square_rule, triangle_rule, max_element_points

   !> Most integration points of an element
   integer, parameter :: max_element_points = 9

contains

   !> Gauss rule of one to three points, exact to degree 2n - 1
   pure subroutine gauss_rule(n, x, w)
      !> Number of points: 1, 2 or 3
      integer, intent(in) :: n
      !> Points, shape (n)
      real(wp), intent(out) :: x(:)
      !> Weights, shape (n)
      real(wp), intent(out) :: w(:)

      select case (n)
      case (1)
         x(1) = 0.0_wp
         w(1) = 2.0_wp
      case (2)
         x(1:2) = [-1.0_wp, 1.0_wp]/sqrt(3.0_wp)
         w(1:2) = 1.0_wp
      case default
         x(1:3) = [-1.0_wp, 0.0_wp, 1.0_wp]*sqrt(0.6_wp)
         w(1:3) = [5.0_wp, 8.0_wp, 5.0_wp]/9.0_wp
      end select
   end subroutine gauss_rule

   !> Product of two Gauss rules on [-1, 1] x [-1, 1]; the first coordinate runs first
   pure subroutine square_rule(order, n, x, w)
      !> Points in each direction
      integer, intent(in) :: order
      !> Number of points
      integer, intent(out) :: n
      !> Points, shape (2, max_element_points), and weights; the first n are in use
      real(wp), intent(out) :: x(:, :), w(:)

      real(wp) :: line(3), weight(3)
      integer :: i, j

      call gauss_rule(order, line, weight)
      n = order**2
      do j = 1, order
         do i = 1, order
            x(:, i + (j - 1)*order) = [line(i), line(j)]
            w(i + (j - 1)*order) = weight(i)*weight(j)
         end do
      end do
   end subroutine square_rule

   !> Rules on the triangle with the corners (0, 0), (1, 0), (0, 1); all points are
   !> inside. Order 2: three points, exact to degree 2; order 3: seven points, exact
   !> to degree 5 (Radon 1948)
   pure subroutine triangle_rule(order, n, x, w)
      !> 2 or 3
      integer, intent(in) :: order
      !> Number of points
      integer, intent(out) :: n
      !> Points, shape (2, max_element_points), and weights, whose sum is 1/2; the
      !> first n are in use
      real(wp), intent(out) :: x(:, :), w(:)

      real(wp), parameter :: root = sqrt(15.0_wp)

      if (order == 2) then
         n = 3
         x(:, 1:3) = orbit(1.0_wp/6.0_wp)
         w(1:3) = 1.0_wp/6.0_wp
      else
         n = 7
         x(:, 1:3) = orbit((6.0_wp - root)/21.0_wp)
         w(1:3) = (155.0_wp - root)/2400.0_wp
         x(:, 4:6) = orbit((6.0_wp + root)/21.0_wp)
         w(4:6) = (155.0_wp + root)/2400.0_wp
         x(:, 7) = 1.0_wp/3.0_wp
         w(7) = 9.0_wp/80.0_wp
      end if
   end subroutine triangle_rule

   !> Three points of a triangle of which two area coordinates are the same
   pure function orbit(area) result(points)
      !> The area coordinate
      real(wp), intent(in) :: area
      !> The points
      real(wp) :: points(2, 3)

      associate (rest => 1.0_wp - 2.0_wp*area)
         points = reshape([area, area, rest, area, area, rest], [2, 3])
      end associate
   end function orbit

   !> Lobatto rule of two or three points: trapezium and Simpson
   pure subroutine lobatto_rule(n, x, w)
      !> Number of points: 2 or 3
      integer, intent(in) :: n
      !> Points, shape (n)
      real(wp), intent(out) :: x(:)
      !> Weights, shape (n)
      real(wp), intent(out) :: w(:)

      if (n == 2) then
         x(1:2) = [-1.0_wp, 1.0_wp]
         w(1:2) = 1.0_wp
      else
         x(1:3) = [-1.0_wp, 0.0_wp, 1.0_wp]
         w(1:3) = [1.0_wp, 4.0_wp, 1.0_wp]/3.0_wp
      end if
   end subroutine lobatto_rule

end module axijoint_fe_quadrature
