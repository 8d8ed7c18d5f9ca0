!> Decimal numbers as digits and a power of ten
module axijoint_gmsh_decimal
   use axijoint_base_kinds, only : i8
   implicit none
   private
   public :: divide_real

   !> Larger than any exponent that matters
   integer, parameter :: endless = 100000

contains

   !> Divide a real into an integer and a power of ten
   pure subroutine divide_real(token, mantissa, digits, exponent, good)
      !> The text
      character(len=*), intent(in) :: token
      !> Its digits as an integer without the point, the first 18 of them
      integer(i8), intent(out) :: mantissa
      !> Number of digits from the first that is not 0
      integer, intent(out) :: digits
      !> Power of ten behind the last digit
      integer, intent(out) :: exponent
      !> Whether the text is a number
      logical, intent(out) :: good

      integer :: i, code, first, power, n_seen
      logical :: point

      mantissa = 0
      digits = 0
      exponent = 0
      n_seen = 0
      point = .false.
      first = 1
      if (scan(token(1:1), '+-') == 1) first = 2
      do i = first, len(token)
         code = iachar(token(i:i)) - iachar('0')
         if (code >= 0 .and. code <= 9) then
            n_seen = n_seen + 1
            if (mantissa > 0 .or. code > 0) digits = digits + 1
            if (digits <= 18) mantissa = 10*mantissa + code
            if (point) exponent = exponent - 1
         else if (token(i:i) == '.' .and. .not. point) then
            point = .true.
         else
            exit
         end if
      end do
      good = n_seen > 0
      if (.not. good .or. i > len(token)) return
      good = scan(token(i:i), 'eEdD') == 1
      if (.not. good) return
      call read_exponent(token(i + 1:), power, good)
      exponent = exponent + power
   end subroutine divide_real

   !> Read the exponent of a real
   pure subroutine read_exponent(text, power, good)
      !> What follows the letter
      character(len=*), intent(in) :: text
      !> The exponent, not beyond `endless`
      integer, intent(out) :: power
      !> Whether it is one
      logical, intent(out) :: good

      integer :: i, first

      power = 0
      first = 1
      if (len(text) > 0) then
         if (scan(text(1:1), '+-') == 1) first = 2
      end if
      good = first <= len(text) .and. verify(text(first:), '0123456789') == 0
      if (.not. good) return
      do i = first, len(text)
         power = min(endless, 10*power + iachar(text(i:i)) - iachar('0'))
      end do
      if (text(1:1) == '-') power = -power
   end subroutine read_exponent

end module axijoint_gmsh_decimal
