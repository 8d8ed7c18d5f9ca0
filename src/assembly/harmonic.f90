!> The stiffness K_m of one harmonic, from parts that are free of the harmonic
module axijoint_assembly_harmonic
   use axijoint_assembly_stiffness, only : stiffness_type, any_harmonic
   use axijoint_base_kinds, only : wp, i8
   use axijoint_fe_fourier, only : circle_integral
   implicit none
   private
   public :: harmonic_values, harmonic_product

contains

   !> Values of K_m = c_m (A + m S + m^2 C) for the pattern of its class
   pure subroutine harmonic_values(stiffness, harmonic, value)
      !> Stiffness of the class
      type(stiffness_type), intent(in) :: stiffness
      !> Harmonic m of that class
      integer, intent(in) :: harmonic
      !> The values, shape (entries)
      real(wp), intent(inout), contiguous :: value(:)

      integer :: i

      do i = 1, stiffness%pattern%n
         associate (from => stiffness%pattern%row_start(i), to => stiffness%pattern%row_start(i + 1) - 1)
            call row_values(stiffness, harmonic, i, value(from:to))
         end associate
      end do
   end subroutine harmonic_values

   !> Values of one row
   pure subroutine row_values(stiffness, harmonic, row, value)
      !> Stiffness of the class
      type(stiffness_type), intent(in) :: stiffness
      !> Harmonic m of that class
      integer, intent(in) :: harmonic
      !> The row
      integer, intent(in) :: row
      !> Its values
      real(wp), intent(inout), contiguous :: value(:)

      real(wp) :: first(0:1), second
      integer(i8) :: start
      integer :: k

      start = stiffness%pattern%row_start(row) - 1
      if (stiffness%harmonic /= any_harmonic) then
         value = circle_integral(harmonic)*stiffness%parts(1, start + 1:start + size(value))
         return
      end if
      first = circle_integral(harmonic)  ! but m S where w meets u or v
      first(1 - stiffness%is_w(row)) = circle_integral(harmonic)*harmonic
      second = circle_integral(harmonic)*real(harmonic, wp)**2
      do k = 1, size(value)
         value(k) = first(stiffness%is_w(stiffness%pattern%column(start + k))) &
            *stiffness%parts(1, start + k) + second*stiffness%parts(2, start + k)
      end do
   end subroutine row_values

   !> K_m x
   pure function harmonic_product(stiffness, harmonic, x) result(y)
      !> Stiffness of the class
      type(stiffness_type), intent(in) :: stiffness
      !> Harmonic m of that class
      integer, intent(in) :: harmonic
      !> x, shape (n)
      real(wp), intent(in) :: x(:)
      !> y, shape (n)
      real(wp), allocatable :: y(:)

      real(wp), allocatable :: value(:)
      real(wp) :: row_sum
      integer :: i, j, k, n

      associate (pattern => stiffness%pattern)
         allocate (y(pattern%n), source=0.0_wp)
         allocate (value(maxval([0_i8, pattern%row_start(2:) - pattern%row_start(:pattern%n)])))
         do i = 1, pattern%n
            n = int(pattern%row_start(i + 1) - pattern%row_start(i))
            call row_values(stiffness, harmonic, i, value(:n))
            row_sum = value(n)*x(i)
            do k = 1, n - 1
               j = pattern%column(pattern%row_start(i) + k - 1)
               row_sum = row_sum + value(k)*x(j)
               y(j) = y(j) + value(k)*x(i)
            end do
            y(i) = y(i) + row_sum
         end do
      end associate
   end function harmonic_product

end module axijoint_assembly_harmonic
