!> Samples of random values, the same on every machine: a generator, and distributions by their
!> inverse
module axijoint_study_draw
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: generator_type, new_generator, next_uniform, latin_hypercube, quantile
   public :: distribution_names, distribution_uniform, distribution_normal, &
      distribution_lognormal, distribution_weibull, distribution_truncated, n_parameters

   !> Distributions: uniform between two ends; normal and lognormal by mean and standard deviation
   !> of the value; Weibull by shape, scale and least value; normal between two ends
   integer, parameter :: distribution_uniform = 1, distribution_normal = 2, &
      distribution_lognormal = 3, distribution_weibull = 4, distribution_truncated = 5
   !> Their names in a table, and how many numbers follow each
   character(len=12), parameter :: distribution_names(5) = [character(len=12) :: &
      'UNIFORM', 'NORMAL', 'LOGNORMAL', 'WEIBULL', 'TRUNCATED']
   integer, parameter :: n_parameters(5) = [2, 2, 2, 3, 4]

   !> A stream of random numbers (SplitMix64: Steele, Lea and Flood, OOPSLA 2014)
   type :: generator_type
      private
      !> Its state
      integer(i8) :: state = 0
   end type generator_type

contains

   !> A stream of its own for each seed and place
   pure function new_generator(seed, place) result(generator)
      !> The user's number, and the place of what is drawn
      integer, intent(in) :: seed, place
      !> The stream
      type(generator_type) :: generator

      integer(i8) :: ignored

      generator%state = ieor(int(seed, i8), ishft(int(place, i8), 32))
      call next_bits(generator, ignored)
      generator%state = ignored
   end function new_generator

   !> The next 64 bits
   pure subroutine next_bits(generator, bits)
      !> The stream
      type(generator_type), intent(inout) :: generator
      !> The bits
      integer(i8), intent(out) :: bits

      integer(i8), parameter :: golden = int(z'9E3779B97F4A7C15', i8)
      integer(i8), parameter :: first = int(z'BF58476D1CE4E5B9', i8), &
         second = int(z'94D049BB133111EB', i8)

      generator%state = sum64(generator%state, golden)
      bits = generator%state
      bits = product64(ieor(bits, ishft(bits, -30)), first)
      bits = product64(ieor(bits, ishft(bits, -27)), second)
      bits = ieor(bits, ishft(bits, -31))
   end subroutine next_bits

   !> Sum modulo 2^64: the language leaves an overflow undefined
   pure integer(i8) function sum64(a, b) result(total)
      !> The numbers
      integer(i8), intent(in) :: a, b

      integer(i8) :: low, high

      low = low32(a) + low32(b)
      high = ishft(a, -32) + ishft(b, -32) + ishft(low, -32)
      total = ior(ishft(low32(high), 32), low32(low))
   end function sum64

   !> Product modulo 2^64
   pure integer(i8) function product64(a, b) result(total)
      !> The numbers
      integer(i8), intent(in) :: a, b

      integer(i8) :: part(4), piece(4), column, carry
      integer :: i, k

      do i = 1, 4
         part(i) = iand(ishft(a, -16*(i - 1)), 65535_i8)
         piece(i) = iand(ishft(b, -16*(i - 1)), 65535_i8)
      end do
      total = 0
      carry = 0
      do k = 1, 4
         column = carry
         do i = 1, k
            column = column + part(i)*piece(k + 1 - i)
         end do
         total = ior(total, ishft(iand(column, 65535_i8), 16*(k - 1)))
         carry = ishft(column, -16)
      end do
   end function product64

   !> The lower half of 64 bits
   pure integer(i8) function low32(bits)
      !> The bits
      integer(i8), intent(in) :: bits

      low32 = iand(bits, int(z'FFFFFFFF', i8))
   end function low32

   !> The next number between 0 and 1, neither of them
   subroutine next_uniform(generator, value)
      !> The stream
      type(generator_type), intent(inout) :: generator
      !> The number
      real(wp), intent(out) :: value

      integer(i8) :: bits

      call next_bits(generator, bits)
      value = (real(ishft(bits, -11), wp) + 0.5_wp)*2.0_wp**(-53)
   end subroutine next_uniform

   !> One number of each of n equal parts of (0, 1), in random order (McKay, Beckman and Conover,
   !> Technometrics 21, 1979)
   subroutine latin_hypercube(generator, values)
      !> The stream
      type(generator_type), intent(inout) :: generator
      !> The numbers
      real(wp), intent(out) :: values(:)

      real(wp) :: share, kept
      integer :: i, j

      do i = 1, size(values)
         call next_uniform(generator, share)
         values(i) = (i - 1 + share)/size(values)
      end do
      do i = size(values), 2, -1
         call next_uniform(generator, share)
         j = min(i, 1 + int(share*i))
         kept = values(i)
         values(i) = values(j)
         values(j) = kept
      end do
   end subroutine latin_hypercube

   !> The value that a share of a distribution lies below
   pure real(wp) function quantile(distribution, parameters, share) result(value)
      !> One of the `distribution_` parameters
      integer, intent(in) :: distribution
      !> Its numbers
      real(wp), intent(in) :: parameters(:)
      !> > 0 and < 1
      real(wp), intent(in) :: share

      real(wp) :: spread, low, high

      select case (distribution)
      case (distribution_uniform)
         value = parameters(1) + share*(parameters(2) - parameters(1))
      case (distribution_normal)
         value = parameters(1) + parameters(2)*normal_quantile(share)
      case (distribution_lognormal)
         spread = sqrt(log(1.0_wp + (parameters(2)/parameters(1))**2))
         value = parameters(1)*exp(spread*normal_quantile(share) - 0.5_wp*spread**2)
      case (distribution_weibull)
         value = parameters(3) + parameters(2)*(-log(1.0_wp - share))**(1.0_wp/parameters(1))
      case default
         low = normal_share((parameters(3) - parameters(1))/parameters(2))
         high = normal_share((parameters(4) - parameters(1))/parameters(2))
         value = parameters(1) + parameters(2)*normal_quantile(low + share*(high - low))
         value = min(max(value, parameters(3)), parameters(4))
      end select
   end function quantile

   !> Share of the standard normal distribution below a value
   pure real(wp) function normal_share(value) result(share)
      !> The value
      real(wp), intent(in) :: value

      share = 0.5_wp*erfc(-value/sqrt(2.0_wp))
   end function normal_share

   !> The value that a share of the standard normal distribution lies below: by Newton's steps from
   !> the logistic distribution, halved where they would leave the sure interval
   pure real(wp) function normal_quantile(share) result(value)
      !> > 0 and < 1
      real(wp), intent(in) :: share

      integer, parameter :: most_steps = 200
      real(wp), parameter :: widest = 40.0_wp
      real(wp) :: low, high, error, slope
      integer :: i

      low = -widest
      high = widest
      value = log(share/(1.0_wp - share))/1.702_wp
      do i = 1, most_steps
         error = normal_share(value) - share
         if (error > 0.0_wp) high = min(high, value)
         if (error < 0.0_wp) low = max(low, value)
         slope = exp(-0.5_wp*value**2)/sqrt(8.0_wp*atan(1.0_wp))
         if (abs(error) <= 4.0_wp*epsilon(1.0_wp)*share) exit
         value = value - error/max(slope, tiny(1.0_wp))
         if (.not. (value > low .and. value < high)) value = 0.5_wp*(low + high)
         if (high - low <= 4.0_wp*epsilon(1.0_wp)*max(abs(low), abs(high))) exit
      end do
   end function normal_quantile

end module axijoint_study_draw
