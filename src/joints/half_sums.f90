!> Sums of many harmonics on many planes at equal angles, by halves: cos(m (pi - theta)) is
!> (-1)^m cos(m theta), so even and odd harmonics need the planes from 0 to pi/2 alone, and the even
!> ones on these are harmonics m/2 on planes from 0 to pi. A third of the products of the whole
!> matrix is left, and next to all of it are products of matrices (a Fourier transform has fewer, but
!> takes longer at hundreds of planes). Sines go the same way, and backwards the values are folded
module axijoint_joints_half_sums
   use axijoint_base_kinds, only : wp
   use axijoint_linalg_lapack, only : dgemm
   implicit none
   private
   public :: half_sums_type, new_half_sums, sum_halves, find_halves, worth_halves

   !> Modes times planes from which on halves are worth their folding: at first, and of the rest
   integer, parameter :: worth_beginning = 2000, worth_going_on = 500

   !> Modes that are taken together
   type :: part_type
      !> Their places
      integer, allocatable :: modes(:)
      !> Planes that they are taken on are 0 to this one
      integer :: last = 0
      !> Their values there, shape (modes, planes), and what goes back, shape (planes, modes)
      real(wp), allocatable :: forth(:, :), back(:, :)
   end type part_type

   !> Sums of cosines or of sines on planes from 0 to pi
   type :: half_sums_type
      private
      !> Number of intervals between the planes
      integer :: intervals = 0
      !> Odd harmonics of all planes, of half of them ..., and at last the rest
      type(part_type), allocatable :: parts(:)
      !> What an even harmonic is multiplied by at pi - theta: 1 (cosines) or -1 (sines)
      real(wp) :: mirrored = 1.0_wp
      !> Weight of the planes 0 and pi beside that of the others
      real(wp) :: ends = 1.0_wp
   end type half_sums_type

contains

   !> Whether there is enough to sum
   pure logical function worth_halves(n_modes, n_planes)
      !> Numbers of modes and of planes
      integer, intent(in) :: n_modes, n_planes

      worth_halves = n_modes*n_planes >= worth_beginning
   end function worth_halves

   !> Plan sums of some modes
   pure function new_half_sums(modes, harmonics, sines, ends, forth, back) result(sums)
      !> Places of the modes, and the harmonics of all modes
      integer, intent(in) :: modes(:), harmonics(:)
      !> Whether they are sines
      logical, intent(in) :: sines
      !> Weight of the planes 0 and pi in what goes back, beside that of the others
      real(wp), intent(in) :: ends
      !> Values of all modes on the planes from 0 to pi, shape (modes, planes), and what goes back,
      !> shape (planes, modes)
      real(wp), intent(in) :: forth(:, :), back(:, :)
      !> The plan
      type(half_sums_type) :: sums

      integer :: halvings(size(modes)), n, l

      sums%intervals = size(forth, 2) - 1
      sums%mirrored = merge(-1.0_wp, 1.0_wp, sines)
      sums%ends = ends
      halvings = 0  ! of each harmonic
      n = 0
      do while (mod(sums%intervals, 2**(n + 1)) == 0 .and. &
                count(halvings == n)*(sums%intervals/2**n + 1) >= worth_going_on)
         n = n + 1
         where (halvings == n - 1 .and. mod(harmonics(modes), 2**n) == 0) halvings = n
      end do
      allocate (sums%parts(n + 1))
      do l = 0, n
         associate (part => sums%parts(l + 1), chosen => pack(modes, halvings == l))
            part%modes = chosen
            part%last = sums%intervals/2**min(n, l + 1)
            part%forth = forth(chosen, :part%last + 1)
            part%back = back(:part%last + 1, chosen)
            part%back(1, :) = part%back(1, :)/ends
            if (part%last == sums%intervals) part%back(part%last + 1, :) = &
               part%back(part%last + 1, :)/ends
         end associate
      end do
   end function new_half_sums

   !> Sums of the modes on the planes
   subroutine sum_halves(sums, amplitude, total)
      !> The plan
      type(half_sums_type), intent(in) :: sums
      !> Amplitudes, shape (points, all modes)
      real(wp), intent(in), contiguous :: amplitude(:, :)
      !> Sums on planes 0 to pi, shape (points, planes)
      real(wp), intent(out), contiguous :: total(:, 0:)

      real(wp), allocatable :: odd(:, :), chosen(:, :)
      integer :: j, l, n

      n = size(sums%parts)
      chosen = amplitude(:, sums%parts(n)%modes)
      call multiply(chosen, sums%parts(n)%forth, total(:, 0:sums%parts(n)%last))
      allocate (odd(size(total, 1), 0:sums%intervals/2))
      do l = n - 1, 1, -1
         associate (half => sums%parts(l)%last)
            chosen = amplitude(:, sums%parts(l)%modes)
            call multiply(chosen, sums%parts(l)%forth, odd(:, 0:half))
            do j = 0, half
               if (j < half) total(:, 2*half - j) = sums%mirrored*(total(:, j) - odd(:, j))
               total(:, j) = total(:, j) + odd(:, j)
            end do
         end associate
      end do
   end subroutine sum_halves

   !> Amplitudes of the modes from values on the planes
   subroutine find_halves(sums, total, amplitude)
      !> The plan
      type(half_sums_type), intent(in) :: sums
      !> Values on planes 0 to pi, shape (points, planes); lost on return
      real(wp), intent(inout), contiguous :: total(:, 0:)
      !> Amplitudes, shape (points, all modes); those of the modes are set
      real(wp), intent(inout), contiguous :: amplitude(:, :)

      real(wp), allocatable :: odd(:, :), found(:, :)
      integer :: j, l, n

      n = size(sums%parts)
      total(:, 0) = sums%ends*total(:, 0)  ! the middle of all planes is an end of half of them
      total(:, sums%intervals) = sums%ends*total(:, sums%intervals)
      allocate (odd(size(total, 1), 0:sums%intervals/2))
      do l = 1, n
         associate (part => sums%parts(l))
            allocate (found(size(total, 1), size(part%modes)))
            if (l == n) then
               call multiply(total(:, 0:part%last), part%back, found)
            else
               odd(:, part%last) = total(:, part%last)
               do j = 0, part%last - 1
                  odd(:, j) = total(:, j) - sums%mirrored*total(:, 2*part%last - j)
                  total(:, j) = total(:, j) + sums%mirrored*total(:, 2*part%last - j)
               end do
               call multiply(odd(:, 0:part%last), part%back, found)
            end if
            amplitude(:, part%modes) = found
            deallocate (found)
         end associate
      end do
   end subroutine find_halves

   !> Product of matrices
   subroutine multiply(a, b, product)
      !> Factors, shape (m, k) and (k, n)
      real(wp), intent(in), contiguous :: a(:, :), b(:, :)
      !> Shape (m, n)
      real(wp), intent(out), contiguous :: product(:, :)

      if (size(product) == 0) return
      product = 0.0_wp
      if (size(b, 1) == 0) return
      call dgemm('N', 'N', size(a, 1), size(b, 2), size(b, 1), 1.0_wp, a, size(a, 1), b, &
         size(b, 1), 0.0_wp, product, size(a, 1))
   end subroutine multiply

end module axijoint_joints_half_sums
