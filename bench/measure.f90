!> Clock, machine rate and messages of the benchmarks
module axijoint_bench_measure
   use, intrinsic :: iso_fortran_env, only : error_unit
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_linalg_lapack, only : dgemm
   implicit none
   private
   public :: product_rate, seconds, stop_on, fail

   !> Unknowns of the products that the machine's rate is measured with
   integer, parameter :: product_size = 2000

contains

   !> Operations a second of a large matrix product: the machine's rate
   function product_rate() result(rate)
      !> The rate, the median of five
      real(wp) :: rate

      real(wp), allocatable :: a(:, :), b(:, :), c(:, :)
      real(wp) :: times(5), start
      integer :: k

      allocate (a(product_size, product_size), b(product_size, product_size))
      allocate (c(product_size, product_size), source=0.0_wp)
      call random_number(a)
      call random_number(b)
      do k = 0, size(times)  ! the first is not counted
         start = seconds()
         call dgemm('N', 'N', product_size, product_size, product_size, 1.0_wp, a, product_size, &
                    b, product_size, 0.0_wp, c, product_size)
         if (k > 0) times(k) = seconds() - start
      end do
      rate = 2.0_wp*real(product_size, wp)**3/median(times)
   end function product_rate


   !> Median
   pure function median(values)
      !> The values
      real(wp), intent(in) :: values(:)
      !> Their median
      real(wp) :: median

      integer :: k, less

      median = values(1)
      do k = 1, size(values)  ! short lists: the value with half of the others below it
         less = count(values < values(k)) + count(.not. abs(values(:k - 1) - values(k)) > 0.0_wp)
         if (less == (size(values) - 1)/2) median = values(k)
      end do
   end function median


   !> Wall clock [second]
   function seconds()
      !> The reading
      real(wp) :: seconds

      integer(i8) :: count, rate

      call system_clock(count, rate)
      seconds = real(count, wp)/real(rate, wp)
   end function seconds


   !> End with the message of an error
   subroutine stop_on(error)
      !> The error, if any
      type(error_type), allocatable, intent(in) :: error

      if (allocated(error)) call fail(error%message)
   end subroutine stop_on


   !> End with a message
   subroutine fail(message)
      !> The message
      character(len=*), intent(in) :: message

      write (error_unit, '(2a)') 'bench: ', message
      error stop 2, quiet=.true.
   end subroutine fail


end module axijoint_bench_measure
