!> Solution of a system with a supernodal Cholesky factor, for one or a few right-hand sides
!>
!> Most supernodes of a plane mesh are small, and calls of the BLAS for them cost more than what they
!> compute: columns are taken a few at a time in loops of our own, and only what is left of large
!> panels is a product of the BLAS. A panel serves all right-hand sides while it is in the cache, and
!> each of them takes the same operations as if it were alone: not a bit of it depends on the others.
module axijoint_solver_supernodal_solve
   use, intrinsic :: iso_c_binding, only : c_ptr, c_f_pointer, c_double, c_int64_t
   use axijoint_base_kinds, only : wp, i8
   use axijoint_linalg_lapack, only : dgemv
   use axijoint_solver_supernodal, only : supernodal_structure_type
   implicit none
   private
   public :: supernodal_solve

   !> Columns of a panel that are eliminated before the rows below take them all at once
   integer, parameter :: block_size = 32
   !> Numbers below a block from which on a call is worth its price
   integer, parameter :: worth_a_call = 256

contains

   !> Solve L L^T x = b in the order of the factor
   subroutine supernodal_solve(structure, l, n_sides, x, work) bind(c, name='axijoint_supernodal_solve')
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> The factor, panel by panel
      real(c_double), intent(in) :: l(0:*)
      !> Right-hand sides
      integer(c_int64_t), value :: n_sides
      !> Right-hand sides, then solutions
      real(c_double), intent(inout) :: x(0:structure%n - 1, n_sides)
      !> As many numbers as the longest panel has rows
      real(c_double), intent(inout) :: work(0:*)

      integer(c_int64_t), pointer, contiguous :: column(:), first_row(:), first_number(:), row(:)
      integer(i8) :: n, s, k

      n = structure%n_supernodes
      call c_f_pointer(structure%column, column, [n + 1])
      call c_f_pointer(structure%first_row, first_row, [n + 1])
      call c_f_pointer(structure%first_number, first_number, [n + 1])
      call c_f_pointer(structure%row, row, [first_row(n + 1)])
      do s = 1, n
         do k = 1, n_sides
            ! Loads on few nodes, as those of joints, touch few panels up to the root; NaN is not skipped
            if (all(abs(x(column(s):column(s + 1) - 1, k)) <= 0.0_wp)) cycle
            call forward(int(first_row(s + 1) - first_row(s)), int(column(s + 1) - column(s)), &
               l(first_number(s)), row(first_row(s) + 1:first_row(s + 1)), x(:, k), work)
         end do
      end do
      do s = n, 1, -1
         do k = 1, n_sides
            call backward(int(first_row(s + 1) - first_row(s)), int(column(s + 1) - column(s)), &
               l(first_number(s)), row(first_row(s) + 1:first_row(s + 1)), x(:, k), work)
         end do
      end do
   end subroutine supernodal_solve

   !> Eliminate the unknowns of a panel
   subroutine forward(height, width, panel, row, x, t)
      !> Rows and columns
      integer, intent(in) :: height, width
      !> The panel, its first rows a lower triangle
      real(wp), intent(in) :: panel(height, width)
      !> Its rows, counted from zero
      integer(c_int64_t), intent(in) :: row(height)
      !> The unknowns
      real(wp), intent(inout) :: x(0:*)
      !> Those of its rows
      real(wp), intent(inout) :: t(height)

      integer :: first, last, below, i, k
      real(wp) :: a(4)

      t(:width) = x(row(1):row(1) + width - 1)
      t(width + 1:) = 0.0_wp
      do first = 1, width, block_size
         last = min(width, first + block_size - 1)
         below = last
         if (is_small(height - last, last - first + 1)) below = height
         do k = first, last - 3, 4
            a(1) = t(k)/panel(k, k)
            a(2) = (t(k + 1) - panel(k + 1, k)*a(1))/panel(k + 1, k + 1)
            a(3) = (t(k + 2) - panel(k + 2, k)*a(1) - panel(k + 2, k + 1)*a(2)) &
               /panel(k + 2, k + 2)
            a(4) = (t(k + 3) - panel(k + 3, k)*a(1) - panel(k + 3, k + 1)*a(2) &
               - panel(k + 3, k + 2)*a(3))/panel(k + 3, k + 3)
            t(k:k + 3) = a
            do i = k + 4, below
               t(i) = t(i) - panel(i, k)*a(1) - panel(i, k + 1)*a(2) - panel(i, k + 2)*a(3) &
                  - panel(i, k + 3)*a(4)
            end do
         end do
         do k = k, last
            a(1) = t(k)/panel(k, k)
            t(k) = a(1)
            do i = k + 1, below
               t(i) = t(i) - panel(i, k)*a(1)
            end do
         end do
         if (below < height) call dgemv('N', height - last, last - first + 1, -1.0_wp, &
            panel(last + 1, first), height, t(first), 1, 1.0_wp, t(last + 1), 1)
      end do
      x(row(1):row(1) + width - 1) = t(:width)
      do k = width + 1, height
         x(row(k)) = x(row(k)) + t(k)
      end do
   end subroutine forward

   !> Find the unknowns of a panel
   subroutine backward(height, width, panel, row, x, t)
      !> Rows and columns
      integer, intent(in) :: height, width
      !> The panel, its first rows a lower triangle
      real(wp), intent(in) :: panel(height, width)
      !> Its rows, counted from zero
      integer(c_int64_t), intent(in) :: row(height)
      !> The unknowns
      real(wp), intent(inout) :: x(0:*)
      !> Those of its rows
      real(wp), intent(inout) :: t(height)

      integer :: first, last, below, i, k
      real(wp) :: a, b, c, d

      t(:width) = x(row(1):row(1) + width - 1)
      do k = width + 1, height
         t(k) = x(row(k))
      end do
      do first = 1 + block_size*((width - 1)/block_size), 1, -block_size
         last = min(width, first + block_size - 1)
         below = last
         if (is_small(height - last, last - first + 1)) below = height
         if (below < height) call dgemv('T', height - last, last - first + 1, -1.0_wp, &
            panel(last + 1, first), height, t(last + 1), 1, 1.0_wp, t(first), 1)
         do k = last, last - mod(last - first + 1, 4) + 1, -1
            a = 0.0_wp
            !$omp simd reduction(+:a)
            do i = k + 1, below
               a = a + panel(i, k)*t(i)
            end do
            t(k) = (t(k) - a)/panel(k, k)
         end do
         do k = k - 3, first, -4
            a = 0.0_wp
            b = 0.0_wp
            c = 0.0_wp
            d = 0.0_wp
            !$omp simd reduction(+:a, b, c, d)
            do i = k + 4, below
               a = a + panel(i, k)*t(i)
               b = b + panel(i, k + 1)*t(i)
               c = c + panel(i, k + 2)*t(i)
               d = d + panel(i, k + 3)*t(i)
            end do
            t(k + 3) = (t(k + 3) - d)/panel(k + 3, k + 3)
            t(k + 2) = (t(k + 2) - c - panel(k + 3, k + 2)*t(k + 3))/panel(k + 2, k + 2)
            t(k + 1) = (t(k + 1) - b - panel(k + 3, k + 1)*t(k + 3) - panel(k + 2, k + 1)*t(k + 2)) &
               /panel(k + 1, k + 1)
            t(k) = (t(k) - a - panel(k + 3, k)*t(k + 3) - panel(k + 2, k)*t(k + 2) &
               - panel(k + 1, k)*t(k + 1))/panel(k, k)
         end do
      end do
      x(row(1):row(1) + width - 1) = t(:width)
   end subroutine backward

   !> Whether the numbers below a block of columns are few
   pure logical function is_small(rows, columns)
      !> Rows below, and columns
      integer, intent(in) :: rows, columns

      is_small = rows*columns < worth_a_call
   end function is_small

end module axijoint_solver_supernodal_solve
