!> Reals in the columns of a table
module axijoint_output_file_columns
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: columns

   !> Characters of a real besides its decimals: blank, sign, first digit,
   !> point, E, sign and two digits of the exponent
   integer, parameter :: frame = 8
   !> Smallest and largest magnitudes whose exponent has two digits after
   !> rounding
   real(wp), parameter :: smallest_short = 1.0e-99_wp, largest_short = 9.99e+99_wp
   !> Most decimals of the fast way: the scaled number stays below 1e10
   integer, parameter :: most_decimals = 9
   !> Highest power of ten that a real holds exactly
   integer, parameter :: exact_power = 22
   !> The powers
   real(wp), parameter :: powers(0:exact_power) = [1.0e0_wp, 1.0e1_wp, 1.0e2_wp, 1.0e3_wp, &
      1.0e4_wp, 1.0e5_wp, 1.0e6_wp, 1.0e7_wp, 1.0e8_wp, 1.0e9_wp, 1.0e10_wp, 1.0e11_wp, &
      1.0e12_wp, 1.0e13_wp, 1.0e14_wp, 1.0e15_wp, 1.0e16_wp, 1.0e17_wp, 1.0e18_wp, 1.0e19_wp, &
      1.0e20_wp, 1.0e21_wp, 1.0e22_wp]
   !> Smallest and largest magnitudes of the fast way: their scale is exact
   real(wp), parameter :: smallest_fast = 1.0e-12_wp, largest_fast = 1.0e22_wp
   !> A scaled number nearer to a half than this is left to the compiler's
   !> library; the scaling's own error is below 2e-6
   real(wp), parameter :: doubt = 1.0e-4_wp

contains

   !> Reals of one line of a table, each right-justified in `width` columns.
   !> Numbers with a three-digit exponent keep the letter E and the width: the
   !> whole group of the line then shows one decimal less. A negative zero is
   !> shown as zero.
   pure function columns(values, width) result(text)
      !> The numbers
      real(wp), intent(in) :: values(:)
      !> Columns of each number, from 11 to 24; width - 8 decimals
      integer, intent(in) :: width
      !> size(values)*width characters
      character(len=size(values)*width) :: text

      logical :: done
      integer :: i

      done = width - frame <= most_decimals
      do i = 1, size(values)
         if (done) call write_fast(values(i), width - frame, text((i - 1)*width + 1:i*width), done)
      end do
      if (done) return
      if (all(is_short(values))) then
         write (text, short_format(width)) values + 0.0_wp
      else
         write (text, long_format(width)) values + 0.0_wp
      end if
   end function columns

   !> Write a common real several times faster than the compiler's library,
   !> with the same digits. Tables of stresses are long.
   pure subroutine write_fast(value, decimals, text, done)
      !> The number
      real(wp), intent(in) :: value
      !> Digits after the point, at most `most_decimals`
      integer, intent(in) :: decimals
      !> decimals + `frame` characters
      character(len=*), intent(out) :: text
      !> False if the number is left to the library: not finite, very large
      !> or small, or so near the middle of two decimals that the scaling
      !> might mislead
      logical, intent(out) :: done

      real(wp) :: scaled
      integer(i8) :: digits
      integer :: power

      text = ""
      power = 0
      digits = 0_i8
      done = ieee_is_finite(value)
      if (.not. done) return
      if (abs(value) > 0.0_wp) then
         done = abs(value) > smallest_fast &
            .and. abs(value) < largest_fast
         if (.not. done) return
         power = floor(log10(abs(value)))
         scaled = scale_by_ten(abs(value), decimals - power)
         done = abs(scaled - aint(scaled) - 0.5_wp) > doubt
         digits = nint(scaled, i8)
         ! Next to a power of ten the logarithm may round to the wrong side
         done = done .and. digits >= int(powers(decimals), i8) &
            .and. digits < int(powers(decimals + 1), i8)
         if (.not. done) return
      end if
      if (value < 0.0_wp) text(2:2) = "-"
      call put_digits(digits, text(4:decimals + 4))
      text(3:3) = text(4:4)
      text(4:4) = "."
      text(decimals + 5:decimals + 6) = merge("E-", "E+", power < 0)
      call put_digits(int(abs(power), i8), text(decimals + 7:decimals + 8))
   end subroutine write_fast

   !> A number times a power of ten, rounded once
   pure real(wp) function scale_by_ten(value, power)
      !> The number
      real(wp), intent(in) :: value
      !> Exponent, of magnitude at most `exact_power`
      integer, intent(in) :: power

      if (power >= 0) then
         scale_by_ten = value*powers(power)
      else
         scale_by_ten = value/powers(-power)
      end if
   end function scale_by_ten

   !> Digits of an integer, with zeros in front
   pure subroutine put_digits(number, text)
      !> The integer, not negative
      integer(i8), intent(in) :: number
      !> The digits
      character(len=*), intent(out) :: text

      integer(i8) :: rest
      integer :: i

      rest = number
      do i = len(text), 1, -1
         text(i:i) = achar(iachar("0") + int(mod(rest, 10_i8)))
         rest = rest/10_i8
      end do
   end subroutine put_digits

   !> Whether two digits hold the exponent of a number; true for NaN and
   !> infinity, which have none
   elemental logical function is_short(value)
      !> The number
      real(wp), intent(in) :: value

      is_short = .true.
      if (.not. ieee_is_finite(value) .or. .not. abs(value) > 0.0_wp) return
      is_short = abs(value) >= smallest_short .and. abs(value) <= largest_short
   end function is_short

   !> Format of reals with a two-digit exponent
   pure function short_format(width) result(text)
      !> Columns of each number
      integer, intent(in) :: width
      !> Such as (*(es14.6e2))
      character(len=14) :: text

      write (text, '("(*(es", i2, ".", i2, "e2))")') width, width - frame
   end function short_format

   !> Format of reals with a three-digit exponent
   pure function long_format(width) result(text)
      !> Columns of each number
      integer, intent(in) :: width
      !> Such as (*(es14.5e3))
      character(len=14) :: text

      write (text, '("(*(es", i2, ".", i2, "e3))")') width, width - frame - 1
   end function long_format

end module axijoint_output_file_columns
