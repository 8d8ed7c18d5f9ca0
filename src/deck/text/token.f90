!> Numbers written as text, judged before they are converted
module axijoint_deck_text_token
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : upper
   implicit none
   private
   public :: read_integer, read_real
   public :: token_good, token_strange, token_is_real, token_too_large, token_too_small, &
      token_not_finite, token_asterisks

   !> The text is a number, and the machine can hold it
   integer, parameter :: token_good = 0
   !> The text is no number
   integer, parameter :: token_strange = 1
   !> The text is a real where an integer is wanted
   integer, parameter :: token_is_real = 2
   !> The number's magnitude is too large
   integer, parameter :: token_too_large = 3
   !> The number is not zero but too near to it
   integer, parameter :: token_too_small = 4
   !> Not a number, or infinity
   integer, parameter :: token_not_finite = 5
   !> Asterisks, as a Fortran program writes a number wider than its field
   integer, parameter :: token_asterisks = 6

   !> Digits
   character(len=*), parameter :: digits = '0123456789'
   !> Decimal exponents E of 0.ddd x 10**E that every such number keeps within
   !> the range of a real of 64 bits
   integer, parameter :: lowest_exponent = -306, highest_exponent = 308
   !> Larger than any exponent that matters, so that exponents can be added
   integer, parameter :: endless = 100000

contains

   !> An integer: a sign and digits
   pure subroutine read_integer(token, value, fault)
      !> The text, without blanks
      character(len=*), intent(in) :: token
      !> The integer; 0 if there is a fault
      integer, intent(out) :: value
      !> One of the `token_` parameters
      integer, intent(out) :: fault

      character(len=:), allocatable :: number
      real(wp) :: as_real

      value = 0
      number = token
      if (scan(token(1:1), '+-') == 1) number = token(2:)
      if (len(number) == 0 .or. verify(number, digits) /= 0) then
         call read_real(token, as_real, fault)
         if (any(fault == [token_good, token_too_large, token_too_small])) fault = token_is_real
         return
      end if
      number = number(max(1, verify(number//'1', '0')):)
      fault = token_too_large
      if (len(number) > range(value) + 1) return
      if (len(number) == range(value) + 1 .and. number > '2147483647') return
      fault = token_good
      value = digits_value(number)
      if (token(1:1) == '-') value = -value
   end subroutine read_integer

   !> Value of digits that are known to fit into an integer; 0 for no digits
   pure integer function digits_value(number) result(value)
      !> The digits
      character(len=*), intent(in) :: number

      integer :: i

      value = 0
      do i = 1, len(number)
         ! in this order 2147483647 is in range
         value = 10*value + (iachar(number(i:i)) - iachar('0'))
      end do
   end function digits_value

   !> An exponent of at most three digits as text
   pure function exponent_text(exponent) result(text)
      !> The exponent
      integer, intent(in) :: exponent
      !> Sign and three digits
      character(len=4) :: text

      text(1:1) = merge('-', '+', exponent < 0)
      text(2:2) = digit_text(abs(exponent)/100)
      text(3:3) = digit_text(mod(abs(exponent)/10, 10))
      text(4:4) = digit_text(mod(abs(exponent), 10))
   end function exponent_text

   !> One digit as text
   pure character(len=1) function digit_text(digit)
      !> 0 to 9
      integer, intent(in) :: digit
      digit_text = digits(digit + 1:digit + 1)
   end function digit_text

   !> A real: a sign, digits with or without a point, an exponent after E, D or
   !> after its sign alone. No decimals are implied
   pure subroutine read_real(token, value, fault)
      !> The text, without blanks
      character(len=*), intent(in) :: token
      !> The real; 0 if there is a fault
      real(wp), intent(out) :: value
      !> One of the `token_` parameters
      integer, intent(out) :: fault

      character(len=:), allocatable :: mantissa
      character(len=len(token) + 16) :: normal
      integer :: exponent, status

      value = 0.0_wp
      call split_real(token, mantissa, exponent, fault)
      if (fault /= token_good) return
      if (len(mantissa) == 0) return  ! nothing but zeros
      if (exponent > highest_exponent) fault = token_too_large
      if (exponent < lowest_exponent) fault = token_too_small
      if (fault /= token_good) return
      normal = '0.'//mantissa//'E'//exponent_text(exponent)
      read (normal, *, iostat=status) value
      if (status /= 0) fault = token_strange
      if (token(1:1) == '-') value = -value
   end subroutine read_real

   !> A real as 0.mantissa x 10**exponent
   pure subroutine split_real(token, mantissa, exponent, fault)
      !> The text
      character(len=*), intent(in) :: token
      !> Digits after the point, the first of which is not 0; empty for zero
      character(len=:), allocatable, intent(out) :: mantissa
      !> Power of ten, cut to what matters
      integer, intent(out) :: exponent
      !> One of the `token_` parameters
      integer, intent(out) :: fault

      character(len=:), allocatable :: number, whole, decimals
      integer :: mark, point

      exponent = 0
      mantissa = ''
      fault = strange_fault(token)
      number = token
      if (scan(token(1:1), '+-') == 1) number = token(2:)
      mark = verify(number//'E', digits//'.')
      if (mark <= len(number)) then
         ! `1-2` is more likely a slip than 1E-2; `1.0-2` is the old way to write it
         if (scan(number(mark:mark), '+-') == 1 .and. index(number(:mark - 1), '.') == 0) return
         call read_exponent(number(mark:), exponent)
         if (exponent > 2*endless) return
         number = number(:mark - 1)
      end if
      point = index(number//'.', '.')
      whole = number(:point - 1)
      decimals = number(min(point, len(number)) + 1:)
      if (verify(decimals, digits) /= 0 .or. len(whole) + len(decimals) == 0) return
      fault = token_good
      mantissa = whole//decimals
      exponent = exponent + len(whole) - (verify(mantissa//'1', '0') - 1)
      mantissa = mantissa(verify(mantissa//'1', '0'):)
   end subroutine split_real

   !> The exponent of a real: E or D, a sign, digits; the letter or the sign
   !> may be left out
   pure subroutine read_exponent(text, exponent)
      !> The text
      character(len=*), intent(in) :: text
      !> The exponent, cut to what matters; more than twice `endless` if
      !> the text is none
      integer, intent(out) :: exponent

      character(len=:), allocatable :: number
      logical :: negative

      exponent = 3*endless
      number = text
      if (scan(text(1:1), 'EDed') == 1) number = text(2:)
      if (len(number) == 0) return
      negative = number(1:1) == '-'
      if (scan(number(1:1), '+-') == 1) then
         number = number(2:)
      else if (len(number) == len(text)) then
         return
      end if
      if (len(number) == 0 .or. verify(number, digits) /= 0) return
      number = number(verify(number//'1', '0'):)
      if (len(number) > 5) number = '99999'
      exponent = digits_value(number)
      if (negative) exponent = -exponent
   end subroutine read_exponent

   !> Why a text that is no number looks as it does
   pure integer function strange_fault(token) result(fault)
      !> The text
      character(len=*), intent(in) :: token

      character(len=len(token)) :: word

      fault = token_strange
      if (verify(token, '*') == 0) fault = token_asterisks
      word = upper(token)
      if (scan(word(1:1), '+-') == 1) word = word(2:)
      if (word == 'NAN' .or. word == 'INF' .or. word == 'INFINITY') fault = token_not_finite
      if (index(word, 'NAN(') == 1) fault = token_not_finite
   end function strange_fault

end module axijoint_deck_text_token
