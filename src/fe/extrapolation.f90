!> From the integration points of an element to its nodes
module axijoint_fe_extrapolation
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : n_corners, natural_positions
   implicit none
   private
   public :: extrapolation_matrix, projection_matrix

   !> Most functions of a fit: 1, x, y, x y
   integer, parameter :: max_functions = 4

contains

   !> Matrix that takes values at the points to values at the nodes: the smooth
   !> function of least weighted squares, bilinear in quadrilaterals (Hinton and
   !> Campbell, Int. J. Numer. Meth. Eng. 8, 1974), linear in triangles, constant
   !> where the points are too few. On the 3 x 3 Gauss points of a quadratic element
   !> it gives what the 2 x 2 points give, where the stresses are best: the weighted
   !> squares leave out the quadratic error, which vanishes there.
   pure function extrapolation_matrix(n_nodes, position, weight) result(matrix)
      !> Number of nodes of the element
      integer, intent(in) :: n_nodes
      !> Natural coordinates of the points, shape (2, points)
      real(wp), intent(in) :: position(:, :)
      !> Weights of the points
      real(wp), intent(in) :: weight(:)
      !> The matrix, shape (nodes, points)
      real(wp) :: matrix(n_nodes, size(weight))

      matrix = projection_matrix(n_functions(n_nodes, size(weight)), position, weight, &
                                 natural_positions(n_nodes))
   end function extrapolation_matrix

   !> Matrix that takes values at the points to values at other places: the function of least
   !> weighted squares
   pure function projection_matrix(n, position, weight, places) result(matrix)
      !> Number of functions: 1 (constant), 3 (linear) or 4 (bilinear)
      integer, intent(in) :: n
      !> Natural coordinates of the points, shape (2, points)
      real(wp), intent(in) :: position(:, :)
      !> Weights of the points
      real(wp), intent(in) :: weight(:)
      !> Natural coordinates of the places, shape (2, places)
      real(wp), intent(in) :: places(:, :)
      !> The matrix, shape (places, points)
      real(wp) :: matrix(size(places, 2), size(weight))

      real(wp) :: at_points(size(weight), max_functions), at_places(size(places, 2), max_functions)
      integer :: i, j

      at_points = fit_functions(position)
      at_places = fit_functions(places)
      matrix = 0.0_wp
      do j = 1, n  ! functions orthonormal on the points
         do i = 1, j - 1
            associate (projection => sum(weight*at_points(:, i)*at_points(:, j)))
               at_places(:, j) = at_places(:, j) - projection*at_places(:, i)
               at_points(:, j) = at_points(:, j) - projection*at_points(:, i)
            end associate
         end do
         associate (length => sqrt(sum(weight*at_points(:, j)**2)))
            at_places(:, j) = at_places(:, j)/length
            at_points(:, j) = at_points(:, j)/length
         end associate
         do i = 1, size(weight)
            matrix(:, i) = matrix(:, i) + at_places(:, j)*weight(i)*at_points(i, j)
         end do
      end do
   end function projection_matrix

   !> Functions that the points of an element determine
   pure integer function n_functions(n_nodes, n_points)
      !> Numbers of nodes and of points
      integer, intent(in) :: n_nodes, n_points

      n_functions = merge(n_corners(n_nodes), 1, n_points >= n_corners(n_nodes))
   end function n_functions

   !> The functions at some points
   pure function fit_functions(position) result(values)
      !> Natural coordinates, shape (2, points)
      real(wp), intent(in) :: position(:, :)
      !> The values, shape (points, max_functions)
      real(wp) :: values(size(position, 2), max_functions)

      values(:, 1) = 1.0_wp
      values(:, 2:3) = transpose(position)
      values(:, 4) = position(1, :)*position(2, :)
   end function fit_functions

end module axijoint_fe_extrapolation
