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

      real(wp), allocatable :: first(:, :)
      real(wp) :: second
      integer(i8) :: from, to
      integer :: i

      call harmonic_factors(stiffness, harmonic, first, second)
      do i = 1, stiffness%pattern%n
         from = stiffness%pattern%row_start(i)
         to = stiffness%pattern%row_start(i + 1) - 1
         call row_values(stiffness, i, first, second, value(from:to))
      end do
   end subroutine harmonic_values

   !> Factors of the two numbers of an entry. S stands where w meets u or v. Of most
   !> rows the columns are u, v, w of one node after the other, so the factors of
   !> the first number are laid out for a row of them.
   pure subroutine harmonic_factors(stiffness, harmonic, first, second)
      !> Stiffness of the class
      type(stiffness_type), intent(in) :: stiffness
      !> Harmonic m of that class
      integer, intent(in) :: harmonic
      !> Factors of the first number in a row of u or v, and in one of w, shape
      !> (longest row, 0:1); at least for the columns u, v, w
      real(wp), allocatable, intent(out) :: first(:, :)
      !> Factor of the second number
      real(wp), intent(out) :: second

      integer :: n

      associate (start => stiffness%pattern%row_start)
         n = max(3, int(maxval([0_i8, start(2:) - start(:stiffness%pattern%n)])))
      end associate
      allocate (first(n, 0:1), source=circle_integral(harmonic))
      second = circle_integral(harmonic)*real(harmonic, wp)**2
      if (stiffness%harmonic /= any_harmonic) return
      first(3::3, 0) = circle_integral(harmonic)*harmonic
      first(1::3, 1) = circle_integral(harmonic)*harmonic
      first(2::3, 1) = circle_integral(harmonic)*harmonic
   end subroutine harmonic_factors

   !> Values of one row
   pure subroutine row_values(stiffness, row, first, second, value)
      !> Stiffness of the class
      type(stiffness_type), intent(in) :: stiffness
      !> The row
      integer, intent(in) :: row
      !> Factors of the numbers of an entry
      real(wp), intent(in), contiguous :: first(:, 0:)
      real(wp), intent(in) :: second
      !> Values of the row
      real(wp), intent(inout), contiguous :: value(:)

      integer(i8) :: start
      integer :: k, w

      start = stiffness%pattern%row_start(row) - 1
      w = stiffness%is_w(row)
      if (stiffness%harmonic /= any_harmonic) then
         value = first(1, 0)*stiffness%parts(1, start + 1:start + size(value))
      else if (stiffness%regular(row)) then
         do k = 1, size(value)
            value(k) = first(k, w)*stiffness%parts(1, start + k) + &
               second*stiffness%parts(2, start + k)
         end do
      else
         do k = 1, size(value)
            value(k) = first(1 + 2*stiffness%is_w(stiffness%pattern%column(start + k)), w) &
               *stiffness%parts(1, start + k) + second*stiffness%parts(2, start + k)
         end do
      end if
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

      real(wp), allocatable :: value(:), first(:, :)
      real(wp) :: row_sum, second, v
      integer(i8) :: start
      integer :: i, j, k, n, w

      call harmonic_factors(stiffness, harmonic, first, second)
      allocate (value(size(first, 1)))
      associate (pattern => stiffness%pattern)
         allocate (y(pattern%n), source=0.0_wp)
         do i = 1, pattern%n
            start = pattern%row_start(i) - 1
            n = int(pattern%row_start(i + 1) - start) - 1
            row_sum = 0.0_wp
            if (stiffness%harmonic == any_harmonic .and. stiffness%regular(i)) then
               w = stiffness%is_w(i)
               do k = 1, n - 1  ! most rows: as `row_values`, without keeping them
                  v = first(k, w)*stiffness%parts(1, start + k) + second*stiffness%parts(2, start + k)
                  j = pattern%column(start + k)
                  row_sum = row_sum + v*x(j)
                  y(j) = y(j) + v*x(i)
               end do
               v = first(n, w)*stiffness%parts(1, start + n) + second*stiffness%parts(2, start + n)
            else
               call row_values(stiffness, i, first, second, value(:n))
               do k = 1, n - 1
                  j = pattern%column(start + k)
                  row_sum = row_sum + value(k)*x(j)
                  y(j) = y(j) + value(k)*x(i)
               end do
               v = value(n)
            end if
            y(i) = y(i) + row_sum + v*x(i)
         end do
      end associate
   end function harmonic_product

end module axijoint_assembly_harmonic
