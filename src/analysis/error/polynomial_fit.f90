!> Polynomials of two coordinates fitted to scattered values
module axijoint_analysis_error_polynomial_fit
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: max_functions, n_complete, polynomials, slopes, fit_polynomial

   !> Most functions: a complete polynomial of degree 4
   integer, parameter :: max_functions = 15
   !> Powers of x and y in the functions, ascending by degree
   integer, parameter :: powers(2, max_functions) = reshape([0, 0, 1, 0, 0, 1, 2, 0, 1, 1, 0, 2, &
                                                             3, 0, 2, 1, 1, 2, 0, 3, &
                                                             4, 0, 3, 1, 2, 2, 1, 3, 0, 4], &
                                                             [2, max_functions])
   !> A function whose part that is new to the points is a smaller projection of it is left out:
   !> a patch two points wide knows nothing of curvature across
   real(wp), parameter :: least_share = 0.1_wp

contains

   !> Number of functions of a complete polynomial
   elemental integer function n_complete(degree)
      !> Its degree
      integer, intent(in) :: degree

      n_complete = (degree + 1)*(degree + 2)/2
   end function n_complete

   !> The functions at a point
   pure function polynomials(n, x) result(values)
      !> Number of functions
      integer, intent(in) :: n
      !> The point
      real(wp), intent(in) :: x(2)
      !> The values
      real(wp) :: values(n)

      real(wp) :: power(2, 0:4)
      integer :: j

      ! those that are not asked for might overflow, where a patch is a point
      power(:, 0) = 1.0_wp
      if (n > n_complete(0)) power(:, 1) = x
      if (n > n_complete(1)) power(:, 2) = x*x
      if (n > n_complete(2)) power(:, 3) = x*power(:, 2)
      if (n > n_complete(3)) power(:, 4) = power(:, 2)*power(:, 2)
      do j = 1, n
         values(j) = power(1, powers(1, j))*power(2, powers(2, j))
      end do
   end function polynomials

   !> Derivatives of the functions at a point by its coordinates
   pure function slopes(n, x) result(values)
      !> Number of functions
      integer, intent(in) :: n
      !> The point
      real(wp), intent(in) :: x(2)
      !> The derivatives, shape (2, functions)
      real(wp) :: values(2, n)

      integer :: j

      values = 0.0_wp
      do j = 1, n
         associate (p => powers(1, j), q => powers(2, j))
            if (p > 0) values(1, j) = p*x(1)**(p - 1)*x(2)**q
            if (q > 0) values(2, j) = q*x(1)**p*x(2)**(q - 1)
         end associate
      end do
   end function slopes

   !> Coefficients of the polynomial of least weighted squares, by functions that are orthonormal
   !> on the points; functions that the points do not determine get none
   pure subroutine fit_polynomial(x, weight, coefficient)
      !> The points, about within -1 and 1, shape (2, points), and their weights
      real(wp), intent(in) :: x(:, :), weight(:)
      !> Coefficients from the values at the points, shape (functions, points)
      real(wp), intent(out) :: coefficient(:, :)

      !> Functions at the points, shape (functions, points)
      real(wp) :: basis(size(coefficient, 1), size(x, 2))
      !> Functions that are orthonormal, in terms of the others, by columns
      real(wp) :: combination(size(coefficient, 1), size(coefficient, 1))
      real(wp) :: before(size(coefficient, 1)), projection(size(coefficient, 1)), root(size(weight)), rest
      integer :: i, j, s, n

      n = size(basis, 1)
      root = sqrt(weight)
      before = 0.0_wp
      do s = 1, size(x, 2)
         basis(:, s) = root(s)*polynomials(n, x(:, s))
         before = before + basis(:, s)**2
      end do
      combination = 0.0_wp
      do j = 1, n
         combination(j, j) = 1.0_wp
      end do
      coefficient = 0.0_wp
      do i = 1, n
         rest = sum(basis(i, :)**2)
         if (rest <= least_share**2*before(i)) cycle
         basis(i, :) = basis(i, :)/sqrt(rest)
         combination(:i, i) = combination(:i, i)/sqrt(rest)
         ! taken from all functions behind it at once: sums side by side, none of which waits for another
         projection = 0.0_wp
         do s = 1, size(x, 2)
            projection(i + 1:) = projection(i + 1:) + basis(i, s)*basis(i + 1:, s)
         end do
         do s = 1, size(x, 2)
            basis(i + 1:, s) = basis(i + 1:, s) - projection(i + 1:)*basis(i, s)
            coefficient(:i, s) = coefficient(:i, s) + combination(:i, i)*(basis(i, s)*root(s))
         end do
         do j = i + 1, n
            combination(:i, j) = combination(:i, j) - projection(j)*combination(:i, i)
         end do
      end do
   end subroutine fit_polynomial

end module axijoint_analysis_error_polynomial_fit
