!> Sums of many harmonics on many planes at equal angles round the circle, and back, by n log n operations
module axijoint_joints_circle_sums
   use, intrinsic :: iso_c_binding, only : c_double, c_float, c_int, c_int32_t, c_loc, c_long, c_ptr
   use axijoint_base_kinds, only : wp, sp, i8
   use axijoint_fe_fourier, only : cosine_of_fraction, sine_of_fraction
   implicit none
   private
   public :: circle_sums_type, new_circle_sums, are_worth_it, sum_on_circle, find_on_circle, multiply_on_circle, room_on_circle

   !> Modes times planes from which on fewer operations are worth their order, and harmonics times intervals that are summed
   !> directly
   integer, parameter :: worth_beginning = 1700, direct_at_most = 300
   !> Numbers of single precision in a vector of the widest processors
   integer, parameter :: room_unit = 16

   !> Sums as C is told of them
   type, bind(c) :: circle_type
      !> Intervals from 0 to pi, planes, the highest harmonic, and the halving of the planes at which sums are direct
      integer(c_int32_t) :: intervals = 0, planes = 0, top = 0, direct = 0
      !> Places of the modes, as in `circle_sums_type`
      type(c_ptr) :: mode
   end type circle_type

   !> Sums on planes round the circle, or from 0 to pi
   type :: circle_sums_type
      private
      !> As above
      integer :: intervals = 0, planes = 0, top = 0, direct = 0
      !> Place of the mode of each harmonic and family from 0 on, -1 if there is none, shape (0:top, families)
      integer(c_int32_t), allocatable :: mode(:, :)
      !> Cosines on the planes; cosines and sines of the harmonics left on the planes left by the halvings at which sums are
      !> direct, in double and in single precision
      real(wp), allocatable :: table(:)
      real(sp), allocatable :: single(:)
      !> Vectors of memory that sums of a component take
      integer :: room = 0
   end type circle_sums_type

   interface
      !> Sums of a component of points
      subroutine c_sums(most, circle, tables, back, odd, points, amplitude_step, amplitude, total_step, total, room) &
         bind(c, name="axijoint_circle_sums")
         import :: c_double, c_float, c_int, c_long, circle_type
         integer(c_int), value :: most, back, odd, points
         type(circle_type), intent(in) :: circle
         real(c_double), intent(in) :: tables(*)
         integer(c_long), value :: amplitude_step, total_step
         real(c_double) :: amplitude(*), total(*)
         real(c_float), intent(inout) :: room(*)
      end subroutine c_sums

      !> Excess stress of the points that are taken together
      subroutine c_product(most, circle, tables, lead, slope, jump, excess, room) bind(c, name="axijoint_circle_product")
         import :: c_float, c_int, c_long, circle_type
         integer(c_int), value :: most
         type(circle_type), intent(in) :: circle
         real(c_float), intent(in) :: tables(*), slope(*), jump(*)
         integer(c_long), value :: lead
         real(c_float), intent(inout) :: excess(*), room(*)
      end subroutine c_product
   end interface

contains

   !> Whether there is enough to sum, on planes that can be halved twice
   pure logical function are_worth_it(n_modes, n_planes, intervals)
      !> Numbers of modes and of planes, and intervals from 0 to pi
      integer, intent(in) :: n_modes, n_planes, intervals

      are_worth_it = int(n_modes, i8)*n_planes >= worth_beginning .and. mod(intervals, 4) == 0
   end function are_worth_it

   !> Plan sums
   pure function new_circle_sums(harmonic, symmetric, intervals, planes) result(sums)
      !> Harmonic of each mode, which no other of its family has, and whether it is symmetric
      integer, intent(in) :: harmonic(:)
      logical, intent(in) :: symmetric(:)
      !> Intervals from 0 to pi, and planes: to pi, or round the circle
      integer, intent(in) :: intervals, planes
      !> The plan
      type(circle_sums_type) :: sums

      integer :: j, k, m, n, top, halvings

      sums%intervals = intervals
      sums%planes = planes
      sums%top = maxval(harmonic)
      allocate (sums%mode(0:sums%top, 2), source=-1_c_int32_t)
      do k = 1, size(harmonic)
         sums%mode(harmonic(k), merge(1, 2, symmetric(k))) = k - 1
      end do
      do while (mod(intervals, 2**(sums%direct + 2)) == 0 .and. &
                (highest(sums, sums%direct) + 1)*(intervals/2**sums%direct + 1) > direct_at_most)
         sums%direct = sums%direct + 1
      end do
      sums%table = [(cosine_of_fraction(j, intervals), j=0, intervals)]
      do halvings = sums%direct, sums%direct + 1
         n = intervals/2**halvings
         top = highest(sums, halvings)
         sums%table = [sums%table, ((cosine_of_fraction(m*j, max(1, n)), j=0, n), m=0, top), &
                       ((sine_of_fraction(m*j, max(1, n)), j=0, n), m=0, top)]
      end do
      sums%single = real(sums%table, sp)
      sums%room = planes + sums%top + 1 + intervals + 1 + room_of(sums, 0, sums%top)
   end function new_circle_sums

   !> No less than the highest harmonic that so many halvings leave, nor more than the planes there tell
   pure integer function highest(sums, halvings)
      !> The plan
      type(circle_sums_type), intent(in) :: sums
      !> Halvings of the planes
      integer, intent(in) :: halvings

      highest = min(sums%intervals/2**halvings, sums%top/2**halvings + merge(1, 0, halvings > 0))
   end function highest

   !> Vectors that sums take on planes that so many halvings have left
   pure recursive integer function room_of(sums, halvings, top) result(room)
      !> The plan
      type(circle_sums_type), intent(in) :: sums
      !> The halvings, and the highest harmonic
      integer, intent(in) :: halvings, top

      room = 0
      if (halvings >= sums%direct) return
      associate (few => (top + 1)/4, quarter => sums%intervals/2**(halvings + 2))
         room = max(top/2 + 1 + room_of(sums, halvings + 1, top/2), &
                    2*(few + 1) + 2*(quarter + 1) + room_of(sums, halvings + 2, few))
      end associate
   end function room_of

   !> Memory that sums, or products, take
   subroutine room_on_circle(sums, components, room)
      !> The plan
      type(circle_sums_type), intent(in) :: sums
      !> Components that are on the planes at once
      integer, intent(in) :: components
      !> The memory, with what it takes to begin at a multiple of its unit
      real(sp), allocatable, intent(out) :: room(:)

      allocate (room(room_unit*(sums%room + (components - 1)*sums%planes + 1)))
   end subroutine room_on_circle

   !> A component of points on all planes
   subroutine sum_on_circle(sums, odd, n, lead, amplitude, lead_total, total, room, at_once)
      !> The plan
      type(circle_sums_type), intent(in), target :: sums
      !> Whether the component is odd in theta in a symmetric mode
      logical, intent(in) :: odd
      !> Number of points, and what amplitudes of modes and values on planes are apart
      integer, intent(in) :: n, lead, lead_total
      !> Amplitudes, shape (lead, modes), and the values, shape (lead_total, planes)
      real(wp), intent(in) :: amplitude(*)
      real(wp), intent(inout) :: total(*)
      !> Memory for one component
      real(sp), intent(inout), contiguous :: room(:)
      !> Doubles that are taken at once at most; as many as the processor takes if absent
      integer, intent(in), optional :: at_once

      call c_sums(most_of(at_once), circle_of(sums), sums%table, 0, merge(1, 0, odd), n, int(lead, c_long), amplitude, &
                  int(lead_total, c_long), total, room(first_aligned(room):))
   end subroutine sum_on_circle

   !> Amplitudes of a component of points from its values on all planes
   subroutine find_on_circle(sums, odd, n, lead_total, total, lead, amplitude, room, at_once)
      !> The plan
      type(circle_sums_type), intent(in), target :: sums
      !> Whether the component is odd in theta in a symmetric mode
      logical, intent(in) :: odd
      !> Number of points, and what values on planes and amplitudes of modes are apart
      integer, intent(in) :: n, lead_total, lead
      !> The values, shape (lead_total, planes), and amplitudes, shape (lead, modes)
      real(wp), intent(in) :: total(*)
      real(wp), intent(inout) :: amplitude(*)
      !> Memory for one component
      real(sp), intent(inout), contiguous :: room(:)
      !> Doubles that are taken at once at most; as many as the processor takes if absent
      integer, intent(in), optional :: at_once

      call c_sums(most_of(at_once), circle_of(sums), sums%table, 1, merge(1, 0, odd), n, int(lead, c_long), amplitude, &
                  int(lead_total, c_long), total, room(first_aligned(room):))
   end subroutine find_on_circle

   !> Numbers that are taken at once at most
   pure integer function most_of(at_once) result(most)
      !> As in `sum_on_circle`
      integer, intent(in), optional :: at_once

      most = room_unit
      if (present(at_once)) most = at_once
   end function most_of

   !> Excess stress that slopes on the planes make of jumps, of the points that are taken together
   subroutine multiply_on_circle(sums, lead, slope, jump, excess, room, at_once)
      !> The plan
      type(circle_sums_type), intent(in), target :: sums
      !> Points that arrays have
      integer, intent(in) :: lead
      !> From the first of these points on: slopes, shape (lead, 3, 3, planes), jumps and excess stress, shape (lead, 3, modes)
      real(sp), intent(in) :: slope(*), jump(*)
      real(sp), intent(inout) :: excess(*)
      !> Memory for three components
      real(sp), intent(inout), contiguous :: room(:)
      !> Doubles that are taken at once at most; as many as the processor takes if absent
      integer, intent(in), optional :: at_once

      call c_product(most_of(at_once), circle_of(sums), sums%single, int(lead, c_long), slope, jump, excess, &
                     room(first_aligned(room):))
   end subroutine multiply_on_circle

   !> The plan in C
   type(circle_type) function circle_of(sums) result(circle)
      !> The plan
      type(circle_sums_type), intent(in), target :: sums

      circle = circle_type(sums%intervals, sums%planes, sums%top, sums%direct, c_loc(sums%mode))
   end function circle_of

   !> First place that is a multiple of the size of a vector
   integer function first_aligned(room) result(first)
      !> Memory
      real(sp), intent(in), target :: room(:)

      integer(c_long) :: place

      place = transfer(c_loc(room(1)), place)
      first = 1 + int(modulo(-place/4, int(room_unit, c_long)))
   end function first_aligned

end module axijoint_joints_circle_sums
