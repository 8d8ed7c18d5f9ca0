!> Harmonics summed on planes theta, and back (steps 3 and 4 of the paper)
module axijoint_joints_planes
   use axijoint_base_kinds, only : wp, pi
   use axijoint_fe_fourier, only : cosine_of_fraction, sine_of_fraction
   use axijoint_fe_mode, only : mode_type, family_symmetric, meridional, circumferential
   implicit none
   private
   public :: planes_type, new_planes, new_view, synthesize, analyse

   !> Planes and the matrices between them and the modes
   type :: planes_type
      !> Angles theta [radian]
      real(wp), allocatable :: angle(:)
      !> Factors of xi and eta, and of theta components, in each mode on each
      !> plane, shape (modes, planes)
      real(wp), allocatable :: meridional(:, :), circumferential(:, :)
      !> Fourier coefficients from values on the planes, shape (planes, modes)
      real(wp), allocatable :: meridional_back(:, :), circumferential_back(:, :)
   end type planes_type

contains

   !> Planes at equal angles: from 0 to pi with the trapezium rule between if all
   !> modes are symmetric, else round the whole circle. Exact for products of
   !> harmonics up to n - 1 together below 2 (n - 1). At the sampling limit
   !> m = n - 1, cos^2(m theta) is 1 on every plane and sums to 2 pi instead of
   !> pi, so its weight is halved; sin(m theta) is zero on every plane, so
   !> nothing comes back from it.
   pure function new_planes(n, modes) result(planes)
      !> Number of planes from 0 to pi, > maximum harmonic
      integer, intent(in) :: n
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> The planes
      type(planes_type) :: planes

      real(wp) :: weight
      logical :: half
      integer :: j, k, count

      half = all(modes%family == family_symmetric)
      count = merge(n, 2*(n - 1), half)
      planes%angle = [(pi*j/(n - 1), j = 0, count - 1)]
      allocate (planes%meridional(size(modes), count), planes%circumferential(size(modes), count))
      do j = 1, count
         associate (p => modes%harmonic*(j - 1))
            planes%meridional(:, j) = merge(cosine_of_fraction(p, n - 1), &
               sine_of_fraction(p, n - 1), modes%family == family_symmetric)
            planes%circumferential(:, j) = merge(sine_of_fraction(p, n - 1), &
               -cosine_of_fraction(p, n - 1), modes%family == family_symmetric)
         end associate
      end do
      allocate (planes%meridional_back(count, size(modes)))
      allocate (planes%circumferential_back(count, size(modes)))
      do k = 1, size(modes)
         do j = 1, count
            weight = merge(2.0_wp, 1.0_wp, half)/(n - 1)
            if (half .and. (j == 1 .or. j == n)) weight = 0.5_wp*weight
            if (modes(k)%harmonic == 0 .or. modes(k)%harmonic == n - 1) weight = 0.5_wp*weight
            planes%meridional_back(j, k) = weight*planes%meridional(k, j)
            planes%circumferential_back(j, k) = weight*planes%circumferential(k, j)
         end do
      end do
   end function new_planes

   !> Planes at any angles, to look at sums but not to go back
   pure function new_view(angles, modes) result(planes)
      !> Angles theta [radian]
      real(wp), intent(in) :: angles(:)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> The planes
      type(planes_type) :: planes

      integer :: j

      planes%angle = angles
      allocate (planes%meridional(size(modes), size(angles)))
      allocate (planes%circumferential(size(modes), size(angles)))
      do j = 1, size(angles)
         planes%meridional(:, j) = meridional(modes, angles(j))
         planes%circumferential(:, j) = circumferential(modes, angles(j))
      end do
   end function new_view

   !> Sum of the modes of joint quantities on every plane
   pure function synthesize(planes, amplitude) result(total)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Amplitudes xi, eta, theta, shape (3, points, modes)
      real(wp), intent(in) :: amplitude(:, :, :)
      !> Sums, shape (3, points, planes)
      real(wp) :: total(3, size(amplitude, 2), size(planes%angle))

      total(1, :, :) = matmul(amplitude(1, :, :), planes%meridional)
      total(2, :, :) = matmul(amplitude(2, :, :), planes%meridional)
      total(3, :, :) = matmul(amplitude(3, :, :), planes%circumferential)
   end function synthesize

   !> Amplitudes of joint quantities known on the planes
   pure function analyse(planes, total) result(amplitude)
      !> The planes, made by `new_planes`
      type(planes_type), intent(in) :: planes
      !> Values xi, eta, theta, shape (3, points, planes)
      real(wp), intent(in) :: total(:, :, :)
      !> Amplitudes, shape (3, points, modes)
      real(wp) :: amplitude(3, size(total, 2), size(planes%meridional, 1))

      amplitude(1, :, :) = matmul(total(1, :, :), planes%meridional_back)
      amplitude(2, :, :) = matmul(total(2, :, :), planes%meridional_back)
      amplitude(3, :, :) = matmul(total(3, :, :), planes%circumferential_back)
   end function analyse

end module axijoint_joints_planes
