!> Harmonics summed on planes theta, and back (steps 3 and 4 of the paper)
module axijoint_joints_planes
   use axijoint_base_kinds, only : wp, pi
   use axijoint_fe_fourier, only : cosine_of_fraction, sine_of_fraction
   implicit none
   private
   public :: planes_type, new_planes, new_view, synthesize, analyse

   !> Planes and the matrices between them and the harmonics
   type :: planes_type
      !> Angles theta [radian]
      real(wp), allocatable :: angle(:)
      !> cos(m theta) and sin(m theta), shape (harmonics, planes)
      real(wp), allocatable :: cosine(:, :), sine(:, :)
      !> Fourier coefficients from values on the planes, shape (planes, harmonics)
      real(wp), allocatable :: cosine_back(:, :), sine_back(:, :)
   end type planes_type

contains

   !> Planes at equal angles from 0 to pi, trapezium rule between (exact for
   !> products of harmonics up to n - 1, since the functions are periodic).
   !> At the sampling limit m = n - 1, cos^2(m theta) is 1 on every plane and
   !> sums to pi instead of pi/2, so its weight is halved; sin(m theta) is zero
   !> on every plane, so nothing comes back from it.
   pure function new_planes(n, harmonics) result(planes)
      !> Number of planes, > maximum harmonic
      integer, intent(in) :: n
      !> Harmonics m
      integer, intent(in) :: harmonics(:)
      !> The planes
      type(planes_type) :: planes

      real(wp) :: weight
      integer :: j, k

      planes%angle = [(pi*j/(n - 1), j = 0, n - 1)]
      allocate (planes%cosine(size(harmonics), n), planes%sine(size(harmonics), n))
      do j = 1, n
         planes%cosine(:, j) = cosine_of_fraction(harmonics*(j - 1), n - 1)
         planes%sine(:, j) = sine_of_fraction(harmonics*(j - 1), n - 1)
      end do
      allocate (planes%cosine_back(n, size(harmonics)), planes%sine_back(n, size(harmonics)))
      do k = 1, size(harmonics)
         do j = 1, n
            weight = 2.0_wp/(n - 1)
            if (j == 1 .or. j == n) weight = 0.5_wp*weight
            planes%sine_back(j, k) = weight*planes%sine(k, j)
            if (harmonics(k) == 0 .or. harmonics(k) == n - 1) weight = 0.5_wp*weight
            planes%cosine_back(j, k) = weight*planes%cosine(k, j)
         end do
      end do
   end function new_planes

   !> Planes at any angles, to look at sums but not to go back
   pure function new_view(angles, harmonics) result(planes)
      !> Angles theta [radian]
      real(wp), intent(in) :: angles(:)
      !> Harmonics m
      integer, intent(in) :: harmonics(:)
      !> The planes
      type(planes_type) :: planes

      integer :: j

      planes%angle = angles
      allocate (planes%cosine(size(harmonics), size(angles)))
      allocate (planes%sine(size(harmonics), size(angles)))
      do j = 1, size(angles)
         planes%cosine(:, j) = cos(harmonics*angles(j))
         planes%sine(:, j) = sin(harmonics*angles(j))
      end do
   end function new_view

   !> Sum of the harmonics of joint quantities on every plane
   pure function synthesize(planes, amplitude) result(total)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Amplitudes xi, eta ~ cos, theta ~ sin, shape (3, points, harmonics)
      real(wp), intent(in) :: amplitude(:, :, :)
      !> Sums, shape (3, points, planes)
      real(wp) :: total(3, size(amplitude, 2), size(planes%angle))

      total(1, :, :) = matmul(amplitude(1, :, :), planes%cosine)
      total(2, :, :) = matmul(amplitude(2, :, :), planes%cosine)
      total(3, :, :) = matmul(amplitude(3, :, :), planes%sine)
   end function synthesize

   !> Amplitudes of joint quantities known on the planes
   pure function analyse(planes, total) result(amplitude)
      !> The planes, made by `new_planes`
      type(planes_type), intent(in) :: planes
      !> Values xi, eta, theta, shape (3, points, planes)
      real(wp), intent(in) :: total(:, :, :)
      !> Amplitudes, shape (3, points, harmonics)
      real(wp) :: amplitude(3, size(total, 2), size(planes%cosine, 1))

      amplitude(1, :, :) = matmul(total(1, :, :), planes%cosine_back)
      amplitude(2, :, :) = matmul(total(2, :, :), planes%cosine_back)
      amplitude(3, :, :) = matmul(total(3, :, :), planes%sine_back)
   end function analyse

end module axijoint_joints_planes
