!> What sums of harmonics on planes and back cost: by N log N operations and by products of matrices, in single precision with
!> slopes in between (`joints/plane_product.f90`), and in double precision by themselves (`joints/planes.f90`). Writes one line of
!> comma-separated values a number of harmonics
!>
!> Usage: sums
program sums
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_kinds, only : wp, sp
   use axijoint_base_text, only : to_text
   use axijoint_bench_measure, only : seconds
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_circle_sums, only : new_circle_sums
   use axijoint_joints_plane_product, only : plane_product_type, put_slopes, multiply_group, n_groups
   use axijoint_joints_planes, only : planes_type, new_planes, synthesize, analyse
   use axijoint_linalg_lapack, only : use_one_blas_thread
   implicit none

   !> Highest harmonics, joint points, and how often all is summed; the least time counts
   integer, parameter :: highest(*) = [8, 12, 16, 20, 24, 32, 48, 64, 96, 128, 256], n_points = 64, n_times = 100
   integer :: i

   call use_one_blas_thread()
   write (output_unit, '(a)') 'M,planes,microseconds_single,by_matrices,ratio,difference,'// &
      'microseconds_double,by_matrices,ratio,difference'
   do i = 1, size(highest)
      call measure(highest(i))
   end do

contains

   !> Both ways up to a harmonic, on 4 M + 1 planes
   subroutine measure(top)
      !> The harmonic
      integer, intent(in) :: top

      type(planes_type) :: planes(2)
      real(sp), allocatable :: excess(:, :, :, :)
      real(wp), allocatable :: amplitude(:, :, :, :)
      real(wp) :: single(2), double(2)
      integer :: m, way

      planes = new_planes(4*top + 1, [(mode_type(m), m=0, top)])
      planes(1)%circle = new_circle_sums([(m, m=0, top)], [(.true., m=0, top)], 4*top, 4*top + 1)
      if (allocated(planes(2)%circle)) deallocate (planes(2)%circle)
      allocate (excess(n_points, 3, top + 1, 2), amplitude(3, n_points, top + 1, 2))
      do way = 1, 2
         call time_product(planes(way), excess(:, :, :, way), single(way))
         call time_sums(planes(way), amplitude(:, :, :, way), double(way))
      end do
      write (output_unit, '(a)') to_text(top)//','//to_text(4*top + 1)//','//text_of(single, real(excess, wp))//','// &
         text_of(double, amplitude)
   end subroutine measure

   !> Times, their ratio, and how far results are apart over the largest
   function text_of(time, found) result(text)
      !> Seconds of both ways
      real(wp), intent(in) :: time(2)
      !> What they found; the last place is the way
      real(wp), intent(in) :: found(:, :, :, :)
      !> Microseconds, ratio, difference
      character(len=:), allocatable :: text

      text = to_text(1.0e6_wp*time(1))//','//to_text(1.0e6_wp*time(2))//','//to_text(time(1)/time(2))//','// &
         to_text(maxval(abs(found(:, :, :, 1) - found(:, :, :, 2)))/maxval(abs(found)))
   end function text_of

   !> Excess stress that slopes make of jumps
   subroutine time_product(planes, excess, best)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Takes the stress, shape (points, 3, modes)
      real(sp), intent(out) :: excess(:, :, :)
      !> Least seconds
      real(wp), intent(out) :: best

      type(plane_product_type) :: product
      real(wp), allocatable :: slope(:, :, :, :)
      real(wp) :: largest, start
      integer :: i, k, time

      slope = reshape([(cos(0.1_wp*i), i=1, 9*n_points*size(planes%angle))], [n_points, 3, 3, size(planes%angle)])
      call put_slopes(product, planes, slope, largest)
      product%jump = reshape([(real(sin(0.1_wp*i), sp), i=1, size(product%jump))], shape(product%jump))
      best = huge(best)
      do time = 1, n_times
         start = seconds()
         do k = 1, n_groups(n_points)
            call multiply_group(product, k)
         end do
         best = min(best, seconds() - start)
      end do
      excess = product%excess(:n_points, :, :)
   end subroutine time_product

   !> Amplitudes summed on all planes, and found again
   subroutine time_sums(planes, amplitude, best)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Takes the amplitudes, shape (3, points, modes)
      real(wp), intent(out) :: amplitude(:, :, :)
      !> Least seconds
      real(wp), intent(out) :: best

      real(wp), allocatable :: given(:, :, :), total(:, :, :)
      real(wp) :: start
      integer :: i, time

      given = reshape([(sin(0.1_wp*i), i=1, size(amplitude))], shape(amplitude))
      best = huge(best)
      do time = 1, n_times
         start = seconds()
         total = synthesize(planes, given)
         amplitude = analyse(planes, total)
         best = min(best, seconds() - start)
      end do
   end subroutine time_sums

end program sums
