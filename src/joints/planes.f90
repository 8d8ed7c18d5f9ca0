!> Harmonics summed on planes theta, and back (steps 3 and 4 of the paper)
module axijoint_joints_planes
   use omp_lib, only : omp_get_level
   use axijoint_base_kinds, only : wp, sp, pi
   use axijoint_fe_fourier, only : cosine_of_fraction, sine_of_fraction
   use axijoint_fe_mode, only : mode_type, family_symmetric, meridional, circumferential
   use axijoint_joints_circle_sums, only : circle_sums_type, new_circle_sums, are_worth_it, room_on_circle, sum_on_circle, &
      find_on_circle
   use axijoint_linalg_lapack, only : dgemm
   use axijoint_model_modes, only : greatest_divisor
   implicit none
   private
   public :: planes_type, new_planes, new_view, synthesize, analyse, sum_modes, find_modes, on_all, part_intervals, &
      plane_weights, mode_on_planes, mode_from_planes

   !> Planes and the matrices between them and the modes
   type :: planes_type
      !> Number of planes from 0 to pi, with those that were left out
      integer :: n = 0
      !> Angles theta [radian]
      real(wp), allocatable :: angle(:)
      !> Factors of xi and eta, and of theta components, in each mode on each
      !> plane, shape (modes, planes)
      real(wp), allocatable :: meridional(:, :), circumferential(:, :)
      !> Fourier coefficients from values on the planes, shape (planes, modes)
      real(wp), allocatable :: meridional_back(:, :), circumferential_back(:, :)
      !> How often all repeats round the circle, so that one such part is enough; 1 if
      !> none was left out, 0 if there is harmonic 0 alone
      integer :: folds = 1
      !> For all planes, those that were left out too: the plane that is like it, and
      !> the sign of theta components there
      integer, allocatable :: place(:), sign(:)
      !> Whether a component is odd in theta in a symmetric mode, shape (components): those of
      !> joints are xi, eta, theta
      logical, allocatable :: odd(:)
      !> Sums by few operations, where there are enough modes and planes; otherwise not allocated
      type(circle_sums_type), allocatable :: circle
   end type planes_type

   !> Components of joints
   logical, parameter :: joint_components(3) = [.false., .false., .true.]
   !> Points that are summed at a time by few operations, and numbers of sums from which on threads are worth
   !> their start
   integer, parameter :: points_at_a_time = 32, worth_threads = 15000

contains

   !> Planes at equal angles: from 0 to pi with the trapezium rule between if all
   !> modes are symmetric, else round the whole circle. Exact for products of
   !> harmonics up to n - 1 together below 2 (n - 1). At the sampling limit
   !> m = n - 1, cos^2(m theta) is 1 on every plane and sums to 2 pi instead of
   !> pi, so its weight is halved; sin(m theta) is zero on every plane, so
   !> nothing comes back from it. What repeats g times round the circle needs one
   !> g-th of the planes: those of harmonics m/g on an interval of theta/g.
   pure function new_planes(n, modes, whole, odd) result(planes)
      !> Number of planes from 0 to pi, > maximum harmonic
      integer, intent(in) :: n
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Whether no plane is left out; false if absent
      logical, intent(in), optional :: whole
      !> Components that are odd in theta in a symmetric mode; those of joints if absent
      logical, intent(in), optional :: odd(:)
      !> The planes
      type(planes_type) :: planes

      real(wp) :: weight
      logical :: half
      integer :: intervals, m(size(modes)), j, k, count

      planes%n = n
      planes%odd = joint_components
      if (present(odd)) planes%odd = odd
      half = all(modes%family == family_symmetric)
      intervals = n - 1
      m = modes%harmonic
      if (present(whole)) then
         if (.not. whole) call fold((modes%harmonic), intervals, m, planes%folds)
      else
         call fold((modes%harmonic), intervals, m, planes%folds)
      end if
      count = merge(intervals + 1, 2*intervals, half)
      planes%angle = [(pi*j/(intervals*max(1, planes%folds)), j = 0, count - 1)]
      allocate (planes%meridional(size(modes), count), planes%circumferential(size(modes), count))
      do j = 1, count
         associate (p => m*(j - 1))
            planes%meridional(:, j) = merge(cosine_of_fraction(p, intervals), &
               sine_of_fraction(p, intervals), modes%family == family_symmetric)
            planes%circumferential(:, j) = merge(sine_of_fraction(p, intervals), &
               -cosine_of_fraction(p, intervals), modes%family == family_symmetric)
         end associate
      end do
      allocate (planes%meridional_back(count, size(modes)))
      allocate (planes%circumferential_back(count, size(modes)))
      do k = 1, size(modes)
         do j = 1, count
            weight = merge(2.0_wp, 1.0_wp, half)/intervals
            if (half .and. (j == 1 .or. j == count)) weight = 0.5_wp*weight
            if (m(k) == 0 .or. m(k) == intervals) weight = 0.5_wp*weight
            planes%meridional_back(j, k) = weight*planes%meridional(k, j)
            planes%circumferential_back(j, k) = weight*planes%circumferential(k, j)
         end do
      end do
      call place_all(n, half, intervals, planes)
      if (are_worth_it(size(modes), count, intervals)) &
         planes%circle = new_circle_sums(m, (modes%family == family_symmetric), intervals, count)
   end function new_planes

   !> Intervals between planes from 0 to pi of that part of the circle which is enough
   pure integer function part_intervals(n, harmonics) result(intervals)
      !> Number of planes from 0 to pi
      integer, intent(in) :: n
      !> Harmonics of the modes
      integer, intent(in) :: harmonics(:)

      integer :: m(size(harmonics)), folds

      intervals = n - 1
      m = harmonics
      folds = 1
      call fold(harmonics, intervals, m, folds)
   end function part_intervals

   !> Fold the circle where all repeats: harmonics and intervals of one part
   pure subroutine fold(harmonics, intervals, m, folds)
      !> Harmonics of the modes
      integer, intent(in) :: harmonics(:)
      !> Intervals between planes from 0 to pi, of the circle and of a part
      integer, intent(inout) :: intervals
      !> Harmonics of a part
      integer, intent(inout) :: m(:)
      !> How often all repeats, as in `planes_type`
      integer, intent(inout) :: folds

      integer :: g, k

      g = 0
      do k = 1, size(harmonics)
         g = greatest_divisor(g, harmonics(k))
      end do
      if (g == 0) then
         intervals = 1
         folds = 0
      else if (g > 1 .and. mod(intervals, g) == 0) then
         intervals = intervals/g
         m = harmonics/g
         folds = g
      end if
   end subroutine fold

   !> Find for all planes those that are like them
   pure subroutine place_all(n, half, intervals, planes)
      !> Number of planes from 0 to pi
      integer, intent(in) :: n
      !> Whether they go to pi only, all modes being symmetric
      logical, intent(in) :: half
      !> Intervals from 0 to pi of a part
      integer, intent(in) :: intervals
      !> The planes
      type(planes_type), intent(inout) :: planes

      integer :: j, count

      count = merge(n, 2*(n - 1), half)
      allocate (planes%sign(count), source=1)
      planes%place = [(1 + modulo(j - 1, 2*intervals), j=1, count)]
      if (.not. half) return
      do j = 1, count
         if (planes%place(j) <= intervals + 1) cycle
         planes%place(j) = 2*intervals + 2 - planes%place(j)  ! symmetric about pi/g
         planes%sign(j) = -1
      end do
   end subroutine place_all

   !> Joint quantities on all planes, from those on the planes of one part
   pure function on_all(planes, values) result(all)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Values, shape (components, points, planes)
      real(wp), intent(in) :: values(:, :, :)
      !> The same on all planes
      real(wp) :: all(size(values, 1), size(values, 2), size(planes%place))

      integer :: i, j

      do j = 1, size(planes%place)
         all(:, :, j) = values(:, :, planes%place(j))
         do i = 1, size(values, 1)
            if (planes%odd(i)) all(i, :, j) = planes%sign(j)*all(i, :, j)
         end do
      end do
   end function on_all

   !> Weights of the planes of one part in an integral round the whole circle: trapezium rule
   pure function plane_weights(planes) result(weight)
      !> The planes, made by `new_planes`
      type(planes_type), intent(in) :: planes
      !> One a plane; their sum is 2 pi
      real(wp) :: weight(size(planes%angle))

      associate (n => size(weight))
         weight = 2.0_wp*pi/n
         if (size(planes%place) > planes%n) return
         weight = 2.0_wp*pi/(n - 1)  ! from 0 to pi of a part, which stands for the other half
         weight([1, n]) = 0.5_wp*weight([1, n])
      end associate
   end function plane_weights

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
      planes%odd = joint_components
      allocate (planes%meridional(size(modes), size(angles)))
      allocate (planes%circumferential(size(modes), size(angles)))
      do j = 1, size(angles)
         planes%meridional(:, j) = meridional(modes, angles(j))
         planes%circumferential(:, j) = circumferential(modes, angles(j))
      end do
   end function new_view

   !> Sum of the modes of joint quantities on every plane
   function synthesize(planes, amplitude) result(total)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Amplitudes, shape (components, points, modes)
      real(wp), intent(in) :: amplitude(:, :, :)
      !> Sums, shape (components, points, planes)
      real(wp) :: total(size(amplitude, 1), size(amplitude, 2), size(planes%angle))

      real(wp) :: by_component(size(total, 2), size(total, 1), size(total, 3))
      real(wp) :: summands(size(amplitude, 2), size(amplitude, 1), size(amplitude, 3))

      call turn(amplitude, summands)
      call sum_modes(planes, size(total, 2), size(total, 2), summands, by_component)
      call turn(by_component, total)
   end function synthesize

   !> Amplitudes of joint quantities known on the planes
   function analyse(planes, total) result(amplitude)
      !> The planes, made by `new_planes`
      type(planes_type), intent(in) :: planes
      !> Values, shape (components, points, planes)
      real(wp), intent(in) :: total(:, :, :)
      !> Amplitudes, shape (components, points, modes)
      real(wp) :: amplitude(size(total, 1), size(total, 2), size(planes%meridional, 1))

      real(wp) :: by_component(size(amplitude, 2), size(amplitude, 1), size(amplitude, 3))
      real(wp) :: values(size(total, 2), size(total, 1), size(total, 3))

      call turn(total, values)
      call find_modes(planes, size(total, 2), size(total, 2), values, by_component)
      call turn(by_component, amplitude)
   end function analyse

   !> What components of one mode with amplitudes of one are on the planes
   pure function mode_on_planes(planes, mode) result(factor)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Place of the mode
      integer, intent(in) :: mode
      !> Shape (components, planes)
      real(wp) :: factor(size(planes%odd), size(planes%angle))

      factor = by_component(planes%odd, planes%meridional(mode, :), planes%circumferential(mode, :))
   end function mode_on_planes

   !> Shares of the values on the planes in the amplitudes of one mode
   pure function mode_from_planes(planes, mode) result(factor)
      !> The planes, made by `new_planes`
      type(planes_type), intent(in) :: planes
      !> Place of the mode
      integer, intent(in) :: mode
      !> Shape (components, planes)
      real(wp) :: factor(size(planes%odd), size(planes%angle))

      factor = by_component(planes%odd, planes%meridional_back(:, mode), &
                            planes%circumferential_back(:, mode))
   end function mode_from_planes

   !> Factors of components that are even or odd
   pure function by_component(is_odd, even, odd) result(factor)
      !> Whether a component is odd in a symmetric mode
      logical, intent(in) :: is_odd(:)
      !> Factors, shape (planes)
      real(wp), intent(in) :: even(:), odd(:)
      !> Shape (components, planes)
      real(wp) :: factor(size(is_odd), size(even))

      integer :: i

      do i = 1, size(is_odd)
         factor(i, :) = merge(odd, even, is_odd(i))
      end do
   end function by_component

   !> Values with their first two places changed, one of which is that of the components
   pure subroutine turn(values, turned)
      !> Shape (m, n, any)
      real(wp), intent(in) :: values(:, :, :)
      !> Shape (n, m, any)
      real(wp), intent(out) :: turned(:, :, :)

      integer :: i, k

      do k = 1, size(values, 3)
         if (size(values, 1) == 3) then  ! most often: a fixed number is moved at once
            do i = 1, size(values, 2)
               turned(i, 1, k) = values(1, i, k)
               turned(i, 2, k) = values(2, i, k)
               turned(i, 3, k) = values(3, i, k)
            end do
         else if (size(values, 2) == 3) then
            do i = 1, size(values, 1)
               turned(1, i, k) = values(i, 1, k)
               turned(2, i, k) = values(i, 2, k)
               turned(3, i, k) = values(i, 3, k)
            end do
         else
            turned(:, :, k) = transpose(values(:, :, k))
         end if
      end do
   end subroutine turn

   !> Sums of the modes on every plane, of values that lie together component by component
   subroutine sum_modes(planes, n, lead, amplitude, total)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Number of points, and of those that amplitudes are there for
      integer, intent(in) :: n, lead
      !> Amplitudes, shape (points, components, modes)
      real(wp), intent(in) :: amplitude(lead, size(planes%odd), *)
      !> Sums, shape (points, components, planes)
      real(wp), intent(inout) :: total(n, size(planes%odd), *)

      if (allocated(planes%circle)) then
         call sum_round(planes, n, lead, amplitude, total)
      else
         call multiply(planes%odd, n, lead, amplitude, planes%meridional, planes%circumferential, n, total)
      end if
   end subroutine sum_modes

   !> Amplitudes of values that are known on the planes and lie together component by component
   subroutine find_modes(planes, n, lead, total, amplitude)
      !> The planes, made by `new_planes`
      type(planes_type), intent(in) :: planes
      !> Number of points, and of those that amplitudes are there for
      integer, intent(in) :: n, lead
      !> Values, shape (points, components, planes)
      real(wp), intent(in) :: total(n, size(planes%odd), *)
      !> Amplitudes, shape (points, components, modes)
      real(wp), intent(inout) :: amplitude(lead, size(planes%odd), *)

      if (allocated(planes%circle)) then
         call find_round(planes, n, lead, total, amplitude)
      else
         call multiply(planes%odd, n, n, total, planes%meridional_back, planes%circumferential_back, lead, amplitude)
      end if
   end subroutine find_modes

   !> Sums on every plane by few operations
   subroutine sum_round(planes, n, lead, amplitude, total)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Number of points, and of those that amplitudes are there for
      integer, intent(in) :: n, lead
      !> Amplitudes, shape (points, components, modes)
      real(wp), intent(in) :: amplitude(lead, size(planes%odd), *)
      !> Sums, shape (points, components, planes)
      real(wp), intent(inout) :: total(n, size(planes%odd), *)

      real(sp), allocatable :: room(:)
      integer :: first, i

      !$omp parallel private(room) if (is_worth_threads(planes, n))
      call room_on_circle(planes%circle, 1, room)
      !$omp do collapse(2) schedule(static, 1)
      do first = 1, n, points_at_a_time
         do i = 1, size(planes%odd)
            call sum_on_circle(planes%circle, planes%odd(i), min(points_at_a_time, n - first + 1), lead*size(planes%odd), &
                               amplitude(first, i, 1), n*size(planes%odd), total(first, i, 1), room)
         end do
      end do
      !$omp end do
      !$omp end parallel
   end subroutine sum_round

   !> Whether sums of so many points are worth threads: not within a region of one thread, in which each would be a new one
   logical function is_worth_threads(planes, n) result(worth)
      !> The planes
      type(planes_type), intent(in) :: planes
      !> Number of points
      integer, intent(in) :: n

      worth = omp_get_level() == 0 .and. real(n, wp)*size(planes%odd)*size(planes%angle) >= worth_threads
   end function is_worth_threads

   !> Amplitudes by few operations
   subroutine find_round(planes, n, lead, total, amplitude)
      !> The planes, made by `new_planes`
      type(planes_type), intent(in) :: planes
      !> Number of points, and of those that amplitudes are there for
      integer, intent(in) :: n, lead
      !> Values, shape (points, components, planes)
      real(wp), intent(in) :: total(n, size(planes%odd), *)
      !> Amplitudes, shape (points, components, modes)
      real(wp), intent(inout) :: amplitude(lead, size(planes%odd), *)

      real(sp), allocatable :: room(:)
      integer :: first, i

      !$omp parallel private(room) if (is_worth_threads(planes, n))
      call room_on_circle(planes%circle, 1, room)
      !$omp do collapse(2) schedule(static, 1)
      do first = 1, n, points_at_a_time
         do i = 1, size(planes%odd)
            call find_on_circle(planes%circle, planes%odd(i), min(points_at_a_time, n - first + 1), n*size(planes%odd), &
                                total(first, i, 1), lead*size(planes%odd), amplitude(first, i, 1), room)
         end do
      end do
      !$omp end do
      !$omp end parallel
   end subroutine find_round

   !> Products of each component with the matrix of those that are even or odd
   subroutine multiply(is_odd, n, lead, values, even, odd, lead_product, product)
      !> Whether a component is odd in a symmetric mode
      logical, intent(in) :: is_odd(:)
      !> Number of points, and of those that values are there for
      integer, intent(in) :: n, lead
      !> Shape (points, components, k)
      real(wp), intent(in) :: values(lead, size(is_odd), *)
      !> Shape (k, m)
      real(wp), intent(in), contiguous :: even(:, :), odd(:, :)
      !> Number of points that products are there for
      integer, intent(in) :: lead_product
      !> Shape (points, components, m)
      real(wp), intent(inout) :: product(lead_product, size(is_odd), *)

      integer :: i

      if (n == 0) return
      do i = 1, size(is_odd)
         if (is_odd(i)) then
            call one(odd)
         else
            call one(even)
         end if
      end do

   contains

      !> Product of component i
      subroutine one(factor)
         !> Its matrix
         real(wp), intent(in), contiguous :: factor(:, :)

         call dgemm('N', 'N', n, size(factor, 2), size(factor, 1), 1.0_wp, values(1, i, 1), lead*size(is_odd), &
            factor, size(factor, 1), 0.0_wp, product(1, i, 1), lead_product*size(is_odd))
      end subroutine one

   end subroutine multiply

end module axijoint_joints_planes
