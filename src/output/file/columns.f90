!> Reals in the columns of a table
module axijoint_output_file_columns
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_digits, only : find_digits, put_digits
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: columns, put_columns, known_column

   !> Characters of a real besides its decimals: blank, sign, first digit,
   !> point, E, sign and two digits of the exponent
   integer, parameter :: frame = 8
   !> Smallest and largest magnitudes whose exponent has two digits after
   !> rounding
   real(wp), parameter :: smallest_short = 1.0e-99_wp, largest_short = 9.99e+99_wp

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

      call put_columns(values, width, text)
   end function columns

   !> The same where there is room for it: tables are long, and this is several times faster than
   !> the compiler's library
   pure subroutine put_columns(values, width, text)
      !> The numbers
      real(wp), intent(in) :: values(:)
      !> Columns of each number, from 11 to 24; width - 8 decimals
      integer, intent(in) :: width
      !> size(values)*width characters
      character(len=*), intent(out) :: text

      integer :: i, longer, first, last
      logical :: done

      longer = 0
      if (.not. all(is_short(values))) longer = 1
      do i = 1, size(values)
         first = (i - 1)*width + 1
         last = i*width
         call put_real(values(i), width - frame - longer, 2 + longer, text(first:last), done)
         if (.not. done) write (text(first:last), real_format(width, longer)) values(i)
      end do
   end subroutine put_columns

   !> A value in its columns, or a dash if it is not known
   pure function known_column(value, width) result(text)
      !> The value, negative if not known
      real(wp), intent(in) :: value
      !> Characters of the column
      integer, intent(in) :: width
      !> The text
      character(len=width) :: text

      text = repeat(" ", width - 1)//"-"
      if (value >= 0.0_wp) text = columns([value], width)
   end function known_column

   !> Write a real
   pure subroutine put_real(value, decimals, places, text, done)
      !> The number
      real(wp), intent(in) :: value
      !> Digits after the point
      integer, intent(in) :: decimals
      !> Digits of the exponent
      integer, intent(in) :: places
      !> 6 + decimals + places characters
      character(len=*), intent(out) :: text
      !> False if the number is left to the library: not finite, or so near the middle of two
      !> decimals that it takes more digits than these to tell
      logical, intent(out) :: done

      integer(i8) :: digits
      integer :: power

      power = 0
      digits = 0_i8
      done = ieee_is_finite(value)
      if (.not. done) return
      if (abs(value) > 0.0_wp) call find_digits(value, decimals + 1, digits, power, done)
      if (.not. done) return
      text(1:2) = merge(' -', '  ', value < 0.0_wp)
      call put_digits(digits, text(4:decimals + 4))
      text(3:4) = text(4:4)//'.'
      text(decimals + 5:decimals + 6) = merge('E-', 'E+', power < 0)
      call put_digits(int(abs(power), i8), text(decimals + 7:decimals + 6 + places))
   end subroutine put_real

   !> Whether two digits hold the exponent of a number; true for NaN and
   !> infinity, which have none
   elemental logical function is_short(value)
      !> The number
      real(wp), intent(in) :: value

      is_short = .true.
      if (.not. ieee_is_finite(value) .or. .not. abs(value) > 0.0_wp) return
      is_short = abs(value) >= smallest_short .and. abs(value) <= largest_short
   end function is_short

   !> Format of a real for the compiler's library
   pure function real_format(width, longer) result(text)
      !> Columns of the number
      integer, intent(in) :: width
      !> Digits of the exponent beyond two
      integer, intent(in) :: longer
      !> Such as (es14.6e2)
      character(len=11) :: text

      write (text, '("(es", i2, ".", i2, "e", i1, ")")') width, width - frame - longer, 2 + longer
   end function real_format

end module axijoint_output_file_columns
