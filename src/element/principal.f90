!> Principal stresses and their axes
module axijoint_element_principal
   use axijoint_base_kinds, only : wp, degree
   implicit none
   private
   public :: principal_stresses, principal_axes, plane_principal

   !> Rotations in turn at most; three to five suffice
   integer, parameter :: most_sweeps = 12

contains

   !> Principal stresses by Jacobi's rotations, the largest first
   pure function principal_stresses(stress) result(principal)
      !> xx, yy, zz, xy, yz, xz, in any cartesian axes
      real(wp), intent(in) :: stress(6)
      !> The stresses
      real(wp) :: principal(3)

      real(wp) :: a(3, 3)
      integer :: sweep

      a = reshape(stress([1, 4, 6, 4, 2, 5, 6, 5, 3]), [3, 3])
      do sweep = 1, most_sweeps
         if (.not. abs(a(1, 2)) + abs(a(2, 3)) + abs(a(1, 3)) > tiny(1.0_wp)) exit
         call rotate(a, 1, 2)
         call rotate(a, 2, 3)
         call rotate(a, 1, 3)
      end do
      principal = [maxval([a(1, 1), a(2, 2), a(3, 3)]), 0.0_wp, minval([a(1, 1), a(2, 2), a(3, 3)])]
      principal(2) = max(min(a(1, 1), a(2, 2)), min(max(a(1, 1), a(2, 2)), a(3, 3)))
   end function principal_stresses

   !> Largest and smallest stress in the meridional plane, and the angle from r to the nearer of their
   !> directions [degree], from -45 to 45
   pure function plane_principal(stress) result(values)
      !> r, z, rz
      real(wp), intent(in) :: stress(3)
      !> Largest, smallest, angle
      real(wp) :: values(3)

      real(wp) :: middle, half, radius

      middle = 0.5_wp*(stress(1) + stress(2))
      half = 0.5_wp*(stress(1) - stress(2))
      radius = hypot(half, stress(3))
      values(1:2) = [middle + radius, middle - radius]
      if (abs(half) > 0.0_wp) then
         values(3) = 0.5_wp*atan(stress(3)/half)/degree
      else
         values(3) = 0.0_wp
         if (abs(stress(3)) > 0.0_wp) values(3) = sign(45.0_wp, stress(3))
      end if
   end function plane_principal

   !> Principal stresses, the largest first, and their axes, which are at right angles to each other
   !> even where stresses are equal
   pure subroutine principal_axes(stress, principal, axes)
      !> xx, yy, zz, xy, yz, xz, in any cartesian axes
      real(wp), intent(in) :: stress(6)
      !> The stresses, and a unit vector along each, shape (3, 3)
      real(wp), intent(out) :: principal(3), axes(3, 3)

      real(wp) :: a(3, 3), unsorted(3, 3), left(3)
      integer :: sweep, i, k

      a = reshape(stress([1, 4, 6, 4, 2, 5, 6, 5, 3]), [3, 3])
      unsorted = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], &
         [3, 3])
      do sweep = 1, most_sweeps
         if (.not. abs(a(1, 2)) + abs(a(2, 3)) + abs(a(1, 3)) > tiny(1.0_wp)) exit
         call rotate(a, 1, 2, unsorted)
         call rotate(a, 2, 3, unsorted)
         call rotate(a, 1, 3, unsorted)
      end do
      left = [a(1, 1), a(2, 2), a(3, 3)]
      do i = 1, 3
         k = maxloc(left, 1)
         principal(i) = left(k)
         axes(:, i) = unsorted(:, k)
         left(k) = -huge(1.0_wp)
      end do
   end subroutine principal_axes

   !> Turn the axes p and q so that the shear stress between them vanishes (Golub and
   !> Van Loan, Matrix Computations, 8.5)
   pure subroutine rotate(a, p, q, axes)
      !> The stress
      real(wp), intent(inout) :: a(3, 3)
      !> The axes
      integer, intent(in) :: p, q
      !> Unit vectors along all axes, shape (3, 3)
      real(wp), intent(inout), optional :: axes(3, 3)

      real(wp) :: tau, t, c, s, row_p(3), row_q(3)

      if (.not. abs(a(p, q)) > epsilon(1.0_wp)*1.0e-3_wp*(abs(a(p, p)) + abs(a(q, q)))) then
         a(p, q) = 0.0_wp
         a(q, p) = 0.0_wp
         return
      end if
      tau = (a(q, q) - a(p, p))/(2.0_wp*a(p, q))
      t = sign(1.0_wp, tau)/(abs(tau) + sqrt(1.0_wp + tau**2))
      c = 1.0_wp/sqrt(1.0_wp + t**2)
      s = t*c
      row_p = a(p, :)
      row_q = a(q, :)
      a(p, :) = c*row_p - s*row_q
      a(q, :) = s*row_p + c*row_q
      row_p = a(:, p)
      row_q = a(:, q)
      a(:, p) = c*row_p - s*row_q
      a(:, q) = s*row_p + c*row_q
      a(p, q) = 0.0_wp
      a(q, p) = 0.0_wp
      if (.not. present(axes)) return
      row_p = axes(:, p)
      row_q = axes(:, q)
      axes(:, p) = c*row_p - s*row_q
      axes(:, q) = s*row_p + c*row_q
   end subroutine rotate

end module axijoint_element_principal
