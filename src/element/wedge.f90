!> How singular stress is at the tip of a wedge: displacements go like r^lambda, stresses like
!> r^(lambda - 1) (Williams, J. Appl. Mech. 19, 1952). In a meridional plane all is as in plane
!> strain, and in antiplane strain, close enough to the tip. A wedge may have sectors of several
!> materials, bonded
module axijoint_element_wedge
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: wedge_type, wedge_exponent

   !> A wedge
   type :: wedge_type
      !> Angles of the rays between the sectors, ascending, one more than there are sectors [radian]
      real(wp), allocatable :: ray(:)
      !> Young's modulus and Poisson's ratio of the sectors
      real(wp), allocatable :: young(:), poisson(:)
      !> Whether the first and the last ray are held along r, z and theta; else they are free
      logical :: held(3, 2) = .false.
      !> Whether it is closed: the last ray is the first again
      logical :: closed = .false.
   end type wedge_type

   !> Exponents are looked for between these, by steps
   real(wp), parameter :: least = 0.02_wp, most = 0.98_wp, step = 0.02_wp
   !> Most steps to a root, and what is exact enough of a complex and of a real one
   integer, parameter :: most_steps = 40
   real(wp), parameter :: exact = 1.0e-9_wp, root_exact = 1.0e-13_wp

contains

   !> The least real part of lambda, of plane and antiplane strain; 1 if stress is not singular
   function wedge_exponent(wedge) result(lambda)
      !> The wedge
      type(wedge_type), intent(in) :: wedge
      !> lambda
      real(wp) :: lambda

      lambda = min(least_root(wedge, plane=.true.), least_root(wedge, plane=.false.))
   end function wedge_exponent

   !> The least root of a determinant: a change of sign, or a complex one near to where it is small
   function least_root(wedge, plane) result(lambda)
      !> The wedge
      type(wedge_type), intent(in) :: wedge
      !> Plane strain, else antiplane
      logical, intent(in) :: plane
      !> Its real part; 1 if there is none
      real(wp) :: lambda

      real(wp) :: x, value(3)
      complex(wp) :: root
      integer :: k

      lambda = 1.0_wp
      do k = 0, nint((most - least)/step)
         x = least + k*step
         value = [value(2:3), determinant_at(x)]
         if (k < 1) cycle
         if (value(2)*value(3) <= 0.0_wp) then
            lambda = root_between(x - step, x, value(2), value(3))
            return
         end if
         if (k < 2) cycle
         if (abs(value(2)) > min(abs(value(1)), abs(value(3)))) cycle
         call improve(cmplx(x - step, 0.5_wp*step, wp), root)
         if (abs(real(root) - x) < 5.0_wp*step .and. abs(aimag(root)) < 1.0_wp) then
            lambda = real(root)
            return
         end if
      end do

   contains

      !> The determinant at a real exponent
      real(wp) function determinant_at(x)
         !> lambda
         real(wp), intent(in) :: x

         determinant_at = real(determinant(wedge, plane, cmplx(x, 0.0_wp, wp)))
      end function determinant_at

      !> A root between two exponents: chords, of which an end that stays counts half the next time (Illinois)
      real(wp) function root_between(a, b, at_a, at_b) result(root)
         !> The exponents
         real(wp), intent(in) :: a, b
         !> The determinants there, of which one is not positive, the other not negative
         real(wp), intent(in) :: at_a, at_b

         real(wp) :: ends(2), at_ends(2), value
         integer :: i, moved

         ends = [a, b]
         at_ends = [at_a, at_b]
         root = a
         if (.not. abs(at_a) > 0.0_wp) return
         moved = 0
         do i = 1, most_steps
            root = (ends(1)*at_ends(2) - ends(2)*at_ends(1))/(at_ends(2) - at_ends(1))
            value = determinant_at(root)
            associate (this => merge(1, 2, value*at_ends(1) > 0.0_wp))
               if (abs(root - ends(this)) < root_exact .or. .not. abs(value) > 0.0_wp) return
               if (this == moved) at_ends(3 - this) = 0.5_wp*at_ends(3 - this)
               ends(this) = root
               at_ends(this) = value
               moved = this
            end associate
         end do
      end function root_between

      !> A complex root by the secant method; somewhere else if it is none
      subroutine improve(start, root)
         !> Where to begin
         complex(wp), intent(in) :: start
         !> The root
         complex(wp), intent(out) :: root

         complex(wp) :: before, f, f_before, change
         integer :: i

         before = start
         root = start + cmplx(0.0_wp, 0.5_wp*step, wp)
         f_before = determinant(wedge, plane, before)
         do i = 1, most_steps
            f = determinant(wedge, plane, root)
            if (.not. abs(f - f_before) > 0.0_wp) exit
            change = -f*(root - before)/(f - f_before)
            before = root
            f_before = f
            root = root + change
            if (.not. abs(root - start) < 1.0_wp) exit
            if (abs(change) < exact) return
         end do
         root = cmplx(huge(1.0_wp), 0.0_wp, wp)
      end subroutine improve

   end function least_root

   !> Constants of a sector, which are as many as displacements and tractions on a ray
   pure integer function constants(plane)
      !> Plane strain, else antiplane
      logical, intent(in) :: plane

      constants = merge(4, 2, plane)
   end function constants

   !> Determinant of the conditions on the rays, for the constants of the sectors
   function determinant(wedge, plane, lambda) result(value)
      !> The wedge
      type(wedge_type), intent(in) :: wedge
      !> Plane strain, else antiplane
      logical, intent(in) :: plane
      !> The exponent
      complex(wp), intent(in) :: lambda
      !> The determinant, of rows that are scaled to one
      complex(wp) :: value

      complex(wp), dimension(constants(plane), constants(plane)) :: first, last
      complex(wp) :: a(constants(plane)*size(wedge%young), constants(plane)*size(wedge%young))
      integer :: n, m, k, row

      m = constants(plane)
      n = size(wedge%young)
      a = 0.0_wp
      row = 0
      do k = 1, n
         first = fields(wedge, plane, lambda, k, wedge%ray(k))
         last = fields(wedge, plane, lambda, k, wedge%ray(k + 1))
         associate (own => m*(k - 1), next => m*mod(k, n))
            if (k == 1 .and. .not. wedge%closed) then
               a(:m/2, own + 1:own + m) = on_face(first, 1)
               row = m/2
            end if
            if (k < n .or. wedge%closed) then
               a(row + 1:row + m, own + 1:own + m) = last
               first = fields(wedge, plane, lambda, mod(k, n) + 1, wedge%ray(mod(k, n) + 1))
               a(row + 1:row + m, next + 1:next + m) = a(row + 1:row + m, next + 1:next + m) - first
               row = row + m
            else
               a(row + 1:row + m/2, own + 1:own + m) = on_face(last, 2)
            end if
         end associate
      end do
      value = determinant_of(a)

   contains

      !> What must vanish on a face: displacements where it is held, else stresses
      function on_face(field, face) result(rows)
         !> Displacements and stresses there, shape (m, m)
         complex(wp), intent(in) :: field(:, :)
         !> First or last
         integer, intent(in) :: face
         !> Rows, shape (m/2, m)
         complex(wp) :: rows(size(field, 1)/2, size(field, 1))

         integer :: i

         do i = 1, size(rows, 1)
            rows(i, :) = field(i + merge(0, size(rows, 1), wedge%held(merge(i, 3, plane), face)), :)
         end do
      end function on_face

   end function determinant

   !> Displacements along r and z, and tractions along r and z on a ray, of the constants of a
   !> sector; in antiplane strain that along theta, and its traction
   function fields(wedge, plane, lambda, sector, angle) result(field)
      !> The wedge
      type(wedge_type), intent(in) :: wedge
      !> Plane strain, else antiplane
      logical, intent(in) :: plane
      !> The exponent
      complex(wp), intent(in) :: lambda
      !> The sector
      integer, intent(in) :: sector
      !> The ray
      real(wp), intent(in) :: angle
      !> Shape (4, 4) or (2, 2)
      complex(wp) :: field(constants(plane), constants(plane))

      complex(wp) :: polar(4, 4), c(2), s(2)
      real(wp) :: turn(2, 2), shear, kolosov

      shear = wedge%young(sector)/(2.0_wp + 2.0_wp*wedge%poisson(sector))/maxval(wedge%young)
      if (.not. plane) then
         c(1) = cos(lambda*angle)
         s(1) = sin(lambda*angle)
         field(1, :) = [c(1), s(1)]
         field(2, :) = shear*lambda*[-s(1), c(1)]
         return
      end if
      c = [cos((lambda + 1.0_wp)*angle), cos((lambda - 1.0_wp)*angle)]
      s = [sin((lambda + 1.0_wp)*angle), sin((lambda - 1.0_wp)*angle)]
      kolosov = 3.0_wp - 4.0_wp*wedge%poisson(sector)
      associate (plus => lambda + 1.0_wp, minus => lambda - 1.0_wp)
         polar(1, :) = [-plus*c(1), -plus*s(1), (kolosov - lambda)*c(2), &
            (kolosov - lambda)*s(2)]/(2.0_wp*shear)
         polar(2, :) = [plus*s(1), -plus*c(1), (kolosov + lambda)*s(2), &
            -(kolosov + lambda)*c(2)]/(2.0_wp*shear)
         polar(3, :) = lambda*[plus*s(1), -plus*c(1), minus*s(2), -minus*c(2)]  ! shear stress
         polar(4, :) = lambda*[plus*c(1), plus*s(1), plus*c(2), plus*s(2)]  ! normal stress
      end associate
      turn = reshape([cos(angle), sin(angle), -sin(angle), cos(angle)], [2, 2])
      field(:2, :) = matmul(turn, polar(:2, :))
      field(3:, :) = matmul(turn, polar(3:, :))
   end function fields

   !> Determinant by elimination with row exchanges, rows scaled to one
   function determinant_of(matrix) result(value)
      !> The matrix
      complex(wp), intent(in) :: matrix(:, :)
      !> Its determinant
      complex(wp) :: value

      complex(wp) :: a(size(matrix, 1), size(matrix, 1))
      integer :: i, j, p

      a = matrix
      do i = 1, size(a, 1)
         a(i, :) = a(i, :)/max(tiny(1.0_wp), maxval(abs(a(i, :))))
      end do
      value = 1.0_wp
      do i = 1, size(a, 1)
         p = i - 1 + maxloc(abs(a(i:, i)), 1)
         if (p /= i) then
            a([i, p], :) = a([p, i], :)
            value = -value
         end if
         value = value*a(i, i)
         if (.not. abs(a(i, i)) > 0.0_wp) return
         do j = i + 1, size(a, 1)
            a(j, i:) = a(j, i:) - a(j, i)/a(i, i)*a(i, i:)
         end do
      end do
   end function determinant_of

end module axijoint_element_wedge
