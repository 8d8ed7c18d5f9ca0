!> Numbers computed in all the ways that depend on the processor: by the kernels of OpenBLAS, of the compiler's library,
!> of the mathematical library and of axijoint. Processes whose numbers differ in any bit would not decide alike
module axijoint_mpi_trial
   use axijoint_base_kinds, only : wp, sp, i8
   use axijoint_linalg_lapack, only : dgemm, dgemv, dsyrk, dtrsm, dpotrf, ddot
   use axijoint_linalg_symmetric_half, only : symmetric_half_type, new_half, add_squares, half_product
   use axijoint_linalg_symmetric_single, only : symmetric_single_type, make_room, put_column, symmetric_product
   use axijoint_solver_panel, only : beyond, most_at_once, rows_at_once, panel_forward, panel_backward
   implicit none
   private
   public :: trial_numbers

   !> Order of small matrices, and of one that libraries work on block by block; sums so long that kernels make them of parts
   integer, parameter :: n = 61, large = 301, long = 1500

contains

   !> The numbers
   subroutine trial_numbers(numbers)
      !> They
      real(wp), allocatable, intent(out) :: numbers(:)

      real(wp), allocatable :: a(:, :), c(:, :), square(:, :), x(:), y(:), t(:)
      real(wp) :: z(large)
      real(sp) :: single(n)
      type(symmetric_single_type) :: half
      type(symmetric_half_type) :: panels
      integer :: i, info

      a = reshape([(fraction_of(i), i=1, n*long)], [n, long])
      x = a(:, 1)
      numbers = [sin(x), cos(x), tan(x), exp(x), log(x), atan(x), sqrt(x), x**x, hypot(x, a(:, 2)), atan2(x, a(:, 2)), norm2(a, 1)]
      allocate (square(n, n), c(n, n), y(n))
      call dgemm('N', 'T', n, n, long, 1.0_wp, a, n, a, n, 0.0_wp, c, n)
      call add(c)
      c = matmul(a, transpose(a))
      call add(c)
      numbers = [numbers, matmul(a, a(1, :)), matmul(a(:, :n), x)]
      square = 0.0_wp
      call dsyrk('L', 'N', n, long, 1.0_wp, a, n, 0.0_wp, square, n)
      call dpotrf('L', n, square, n, info)
      call add(square)
      c = a(:, :n)
      call dtrsm('R', 'L', 'T', 'N', n, n, 1.0_wp, square, n, c, n)
      call add(c)
      call dgemv('N', n, long, 1.0_wp, a, n, a(1, 1), 1, 0.0_wp, y, 1)
      numbers = [numbers, y, ddot(n*long - 1, a, 1, a(2, 1), 1)]
      call new_half(large, panels)
      call add_squares(large, panels%values, 1, 2, 2, large, a)
      call half_product(panels, a, z)
      numbers = [numbers, z]
      call make_room(half, n)
      do i = 1, n
         call put_column(half, i, real(a(:i, i), sp))
      end do
      call symmetric_product(half, real(x, sp), single)
      numbers = [numbers, real(single, wp)]
      associate (at_once => rows_at_once(most_at_once), width => n - 20)  ! columns behind the panel are read, too
         t = [x, spread(0.0_wp, 1, beyond)]
         call panel_forward(at_once, n, width, square, t)
         call panel_backward(at_once, n, width, square, t)
      end associate
      numbers = [numbers, t(:n)]
      call add_blocked()

   contains

      !> Add what is made block by block
      subroutine add_blocked()
         real(wp), allocatable :: b(:, :), whole(:, :), x(:, :)
         integer :: j

         b = reshape(a(:, :(large*n + n - 1)/n), [large, n])
         allocate (whole(large, large), source=0.0_wp)
         call dsyrk('L', 'N', large, n, 1.0_wp, b, large, 0.0_wp, whole, large)
         do j = 1, large
            whole(j, j) = whole(j, j) + large
         end do
         call dpotrf('L', large, whole, large, info)
         x = b
         call dtrsm('L', 'L', 'N', 'N', large, n, 1.0_wp, whole, large, x, large)
         numbers = [numbers, whole(:, large/2), whole(large, :), x(:, n)]
         call dsyrk('L', 'T', n, large, 1.0_wp, x, large, 0.0_wp, c, n)
         call add(c)
         call dgemm('T', 'N', n, n, large, 1.0_wp, x, large, b, large, 0.0_wp, c, n)
         call add(c)
      end subroutine add_blocked

      !> Add the lower triangle of a matrix
      subroutine add(matrix)
         !> The matrix
         real(wp), intent(in) :: matrix(:, :)

         integer :: j

         do j = 1, n
            numbers = [numbers, matrix(j:, j)]
         end do
      end subroutine add

   end subroutine trial_numbers

   !> A number between 0 and 1 that looks like chance
   pure real(wp) function fraction_of(i)
      !> Which
      integer, intent(in) :: i

      fraction_of = (modulo(int(i, i8)*7368787_i8, 104729_i8) + 1.0_wp)/104730.0_wp
   end function fraction_of

end module axijoint_mpi_trial
