!> Lines and elements split at a height
module axijoint_analysis_core_split
   use axijoint_base_kinds, only : wp
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_line, n_corners
   implicit none
   private
   public :: line_split_type, split_line, area_split_type, split_element

   !> Gauss points of each piece of a line
   integer, parameter :: n_gauss = 3
   !> Most points along a line: three pieces
   integer, parameter :: most_points = 3*n_gauss

   !> Integration points along a line, piece by piece
   type :: line_split_type
      !> Number of points
      integer :: n = 0
      !> Natural coordinates and weights, the first n of which are in use
      real(wp) :: x(most_points) = 0.0_wp, w(most_points) = 0.0_wp
      !> 1 for points above the height, 2 for points below it
      integer :: side(most_points) = 0
   end type line_split_type

   !> Integration points of an area
   type :: area_split_type
      !> Number of points
      integer :: n = 0
      !> r and height, shape (2, room for points), and weights
      real(wp), allocatable :: position(:, :), weight(:)
      !> 1 for points above the height, 2 for points below it
      integer, allocatable :: side(:)
   end type area_split_type

contains

   !> Integration points of a line that is split where its height is zero. The height
   !> is linear or quadratic, so there are three pieces at most
   pure function split_line(height) result(split)
      !> Height of the first, last and, on a quadratic line, middle node
      real(wp), intent(in) :: height(:)
      !> The points
      type(line_split_type) :: split

      real(wp) :: bounds(4), x(n_gauss), w(n_gauss), middle, half
      integer :: k, n, side

      bounds(1) = -1.0_wp
      n = 1
      call add_zeros(height, bounds, n)
      n = n + 1
      bounds(n) = 1.0_wp
      call gauss_rule(n_gauss, x, w)
      do k = 1, n - 1
         middle = 0.5_wp*(bounds(k) + bounds(k + 1))
         half = 0.5_wp*(bounds(k + 1) - bounds(k))
         side = merge(1, 2, height_at(height, middle) > 0.0_wp)
         associate (from => split%n + 1, to => split%n + n_gauss)
            split%x(from:to) = middle + half*x
            split%w(from:to) = half*w
            split%side(from:to) = side
         end associate
         split%n = split%n + n_gauss
      end do
   end function split_line

   !> Height of a point of a line
   pure real(wp) function height_at(height, x)
      !> Height of the nodes
      real(wp), intent(in) :: height(:)
      !> Natural coordinate
      real(wp), intent(in) :: x

      real(wp) :: shape(3), derivative(3)

      call shape_line(size(height), x, shape(:size(height)), derivative(:size(height)))
      height_at = dot_product(shape(:size(height)), height)
   end function height_at

   !> Add the zeros of a height between -1 and 1, ascending
   pure subroutine add_zeros(height, zeros, n)
      !> Height of the nodes
      real(wp), intent(in) :: height(:)
      !> The zeros behind others
      real(wp), intent(inout) :: zeros(:)
      !> Number of them
      integer, intent(inout) :: n

      real(wp) :: a, b, c, root, found(2)
      integer :: k

      ! a x^2 + b x + c
      b = 0.5_wp*(height(2) - height(1))
      a = 0.0_wp
      c = 0.5_wp*(height(1) + height(2))
      if (size(height) == 3) then
         a = c - height(3)
         c = height(3)
      end if
      found = 2.0_wp  ! nowhere
      if (abs(a) <= 16.0_wp*epsilon(a)*maxval(abs(height))) then
         if (abs(b) > 0.0_wp) found(1) = -c/b
      else if (b**2 - 4.0_wp*a*c > 0.0_wp) then
         root = -0.5_wp*(b + sign(sqrt(b**2 - 4.0_wp*a*c), b))
         found(1) = root/a
         if (abs(root) > 0.0_wp) found(2) = c/root
         if (found(1) > found(2)) found = found([2, 1])
      end if
      do k = 1, 2
         if (.not. abs(found(k)) < 1.0_wp) cycle
         n = n + 1
         zeros(n) = found(k)
      end do
   end subroutine add_zeros

   !> Integration points of the parts of an element above and below. The integral of f
   !> over an area is that of F dz round it (Green), where F is the integral of f from
   !> r = 0 on: the cut itself, on which z does not change, has no share. The points
   !> lie along lines z = const, those of a side that goes down have negative weights.
   !> Exact to degree 2 in r and z, times r, on straight sides
   pure function split_element(coordinates) result(split)
      !> r and height of the nodes, shape (2, nodes)
      real(wp), intent(in) :: coordinates(:, :)
      !> The points
      type(area_split_type) :: split

      type(line_split_type) :: line
      real(wp) :: shape(3), derivative(3), x(n_gauss), w(n_gauss), position(2)
      integer :: side, corners, n, i, k, nodes(3)

      corners = n_corners(size(coordinates, 2))
      n = merge(3, 2, size(coordinates, 2) > corners)
      allocate (split%position(2, corners*most_points*n_gauss))
      allocate (split%weight(size(split%position, 2)), split%side(size(split%position, 2)))
      call gauss_rule(n_gauss, x, w)
      do side = 1, corners
         nodes = [side, mod(side, corners) + 1, side + corners]
         line = split_line(coordinates(2, nodes(:n)))
         do i = 1, line%n
            call shape_line(n, line%x(i), shape(:n), derivative(:n))
            position = matmul(coordinates(:, nodes(:n)), shape(:n))
            do k = 1, n_gauss
               split%n = split%n + 1
               split%position(:, split%n) = [0.5_wp*(1.0_wp + x(k))*position(1), position(2)]
               split%weight(split%n) = 0.5_wp*position(1)*w(k)*line%w(i) &
                                       *dot_product(coordinates(2, nodes(:n)), derivative(:n))
               split%side(split%n) = line%side(i)
            end do
         end do
      end do
   end function split_element

end module axijoint_analysis_core_split
