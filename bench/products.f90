!> What products with flexibilities cost: nine symmetric matrices in single precision and a vector each, by
!> `linalg/symmetric_single.f90` and by the library's `ssymv`. Writes one line of comma-separated values an order
!>
!> Usage: products
program products
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_kinds, only : wp, sp
   use axijoint_base_text, only : to_text
   use axijoint_bench_measure, only : seconds
   use axijoint_linalg_lapack, only : use_one_blas_thread
   use axijoint_linalg_symmetric_single, only : symmetric_single_type, make_room, put_column, symmetric_product
   implicit none

   interface
      !> y = alpha a x + beta y with a symmetric matrix
      subroutine ssymv(uplo, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: sp
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda, incx, incy
         real(sp), intent(in) :: alpha, beta, a(lda, *), x(*)
         real(sp), intent(inout) :: y(*)
      end subroutine ssymv
   end interface

   !> Harmonics, orders, and how often all products are made; the least time counts
   integer, parameter :: n_matrices = 9, orders(*) = [45, 105, 150, 297, 450, 600, 900], n_times = 300
   integer :: i

   call use_one_blas_thread()
   write (output_unit, '(a)') 'order,microseconds,ssymv_microseconds,ratio,largest_difference'
   do i = 1, size(orders)
      call measure(orders(i))
   end do

contains

   !> Both ways at one order
   subroutine measure(n)
      !> The order
      integer, intent(in) :: n

      type(symmetric_single_type) :: matrices(n_matrices)
      real(sp), allocatable :: a(:, :, :)
      real(sp) :: x(n), y(n, n_matrices), other(n, n_matrices)
      real(wp) :: ours, library, start
      integer :: j, k, time

      allocate (a(n, n, n_matrices))
      call random_number(a)
      call random_number(x)
      do k = 1, n_matrices
         call make_room(matrices(k), n)
         do j = 1, n
            call put_column(matrices(k), j, a(:j, j, k))
         end do
      end do
      ours = huge(ours)
      do time = 1, n_times
         start = seconds()
         do k = 1, n_matrices
            call symmetric_product(matrices(k), x, y(:, k))
         end do
         ours = min(ours, seconds() - start)
      end do
      library = huge(library)
      other = 0.0_sp
      do time = 1, n_times
         start = seconds()
         do k = 1, n_matrices
            call ssymv('U', n, 1.0_sp, a(:, :, k), n, x, 1, 0.0_sp, other(:, k), 1)
         end do
         library = min(library, seconds() - start)
      end do
      write (output_unit, '(a)') to_text(n)//','//to_text(1.0e6_wp*ours)//','//to_text(1.0e6_wp*library)//','// &
         to_text(ours/library)//','//to_text(real(maxval(abs(y - other))/maxval(abs(other)), wp))
   end subroutine measure

end program products
