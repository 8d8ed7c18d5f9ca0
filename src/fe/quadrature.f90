!> Quadrature rules on [-1, 1]
module axijoint_fe_quadrature
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: gauss_rule, lobatto_rule

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
