!> Decimal digits of reals, correctly rounded: those of the compiler's library, many times faster.
!>
!> A real is m 2**e with an integer m of 53 bits. With 10**k = g 2**s, g of 63 bits, the digits are
!> the integer part of the product m g, of 116 bits at most, behind a shift; what is shifted out
!> says how to round. Powers 10**0 to 10**26 are exact, and with them ties are; others err by less
!> than two units of g, and a number whose rest is that near to a half is left to the library
!> (the idea is that of F. Loitsch, PLDI 2010, and of U. Adams' Ryu, OOPSLA 2019).
module axijoint_base_digits
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: find_digits, put_digits, most_digits

   !> Most digits: the integer that holds them stays below 2**57
   integer, parameter :: most_digits = 17

   !> Integers of 128 bits
   integer, parameter :: wide = selected_int_kind(38)
   !> Bits of the fraction of a real behind its first, and its exponent when that integer is 1
   integer, parameter :: fraction_bits = 52, exponent_of_one = 1075
   !> Step between the powers of ten of `coarse`
   integer, parameter :: step = 27
   !> Index of the first of them
   integer, parameter :: lowest = -12
   !> 5**b, b = 0 to 26, exact
   integer(i8), parameter :: five(0:step - 1) = [ &
      1_i8, 5_i8, 25_i8, 125_i8, 625_i8, 3125_i8, 15625_i8, 78125_i8, 390625_i8, 1953125_i8, &
      9765625_i8, 48828125_i8, 244140625_i8, 1220703125_i8, 6103515625_i8, 30517578125_i8, &
      152587890625_i8, 762939453125_i8, 3814697265625_i8, 19073486328125_i8, &
      95367431640625_i8, 476837158203125_i8, 2384185791015625_i8, 11920928955078125_i8, &
      59604644775390625_i8, 298023223876953125_i8, 1490116119384765625_i8]
   !> 10**(27 j), j = -12 to 12, rounded to 63 bits: times 2**coarse_exponent(j)
   integer(i8), parameter :: coarse(lowest:-lowest) = [ &
      7467325133404183285_i8, 6032057205060440849_i8, 4872657005699999540_i8, &
      7872201966280717348_i8, 6359114106063703798_i8, 5136851466355833503_i8, &
      8299031137761985917_i8, 6703903964971298550_i8, 5415370496329716523_i8, &
      8749002899132047697_i8, 7067388259113537318_i8, 5708990770823839524_i8, &
      4611686018427387904_i8, 7450580596923828125_i8, 6018531076210112041_i8, &
      4861730685829016959_i8, 7854549544476362485_i8, 6344854593289123058_i8, &
      5125332723668738367_i8, 8280421605278095169_i8, 6688871304346933105_i8, &
      5403227209783266925_i8, 8729384361624432232_i8, 7051540530721990532_i8, &
      5696189077778435541_i8]
   !> Powers of ten
   integer(i8), parameter :: ten(0:most_digits) = [ &
      1_i8, 10_i8, 100_i8, 1000_i8, 10000_i8, 100000_i8, 1000000_i8, 10000000_i8, 100000000_i8, &
      1000000000_i8, 10000000000_i8, 100000000000_i8, 1000000000000_i8, 10000000000000_i8, &
      100000000000000_i8, 1000000000000000_i8, 10000000000000000_i8, 100000000000000000_i8]
   !> An inexact product errs by less than 2**54; twice that is in doubt
   integer(wide), parameter :: doubt = shiftl(1_wide, 55)
   !> The two digits of 0 to 99
   character(len=2), parameter :: pairs(0:99) = [ &
      '00', '01', '02', '03', '04', '05', '06', '07', '08', '09', &
      '10', '11', '12', '13', '14', '15', '16', '17', '18', '19', &
      '20', '21', '22', '23', '24', '25', '26', '27', '28', '29', &
      '30', '31', '32', '33', '34', '35', '36', '37', '38', '39', &
      '40', '41', '42', '43', '44', '45', '46', '47', '48', '49', &
      '50', '51', '52', '53', '54', '55', '56', '57', '58', '59', &
      '60', '61', '62', '63', '64', '65', '66', '67', '68', '69', &
      '70', '71', '72', '73', '74', '75', '76', '77', '78', '79', &
      '80', '81', '82', '83', '84', '85', '86', '87', '88', '89', &
      '90', '91', '92', '93', '94', '95', '96', '97', '98', '99']

contains

   !> Significant digits of a real, rounded to the nearest, ties to even
   pure subroutine find_digits(value, n, digits, exponent, sure)
      !> The number, finite and not zero; its sign does not count
      real(wp), intent(in) :: value
      !> Number of digits, from 1 to `most_digits`
      integer, intent(in) :: n
      !> The digits, 10**(n-1) to 10**n - 1
      integer(i8), intent(out) :: digits
      !> Power of ten of the first digit
      integer, intent(out) :: exponent
      !> False if the number is so near to the middle between two decimals that these may be wrong
      logical, intent(out) :: sure

      integer(i8) :: mantissa
      integer :: power, low

      mantissa = iand(transfer(abs(value), 0_i8), shiftl(1_i8, fraction_bits) - 1_i8)
      power = int(shiftr(transfer(abs(value), 0_i8), fraction_bits))
      if (power > 0) then
         mantissa = mantissa + shiftl(1_i8, fraction_bits)
      else
         low = leadz(mantissa) - (63 - fraction_bits)  ! a denormalized number
         mantissa = shiftl(mantissa, low)
         power = 1 - low
      end if
      power = power - exponent_of_one
      ! log10(m 2**e) is at least (e + 52 + f) log10(2) with m = (1 + f) 2**52: the exponent, or
      ! seldom one less
      exponent = int(shifta((int(power + fraction_bits, i8)*1024_i8 &
                             + iand(shiftr(mantissa, 42), 1023_i8))*78913_i8 - 268435_i8, 28))
      call round_product(mantissa, power, n - 1 - exponent, digits, sure)
      if (digits > ten(n)) then
         exponent = exponent + 1
         call round_product(mantissa, power, n - 1 - exponent, digits, sure)
      end if
      if (digits == ten(n)) then
         digits = ten(n - 1)
         exponent = exponent + 1
      end if
   end subroutine find_digits

   !> mantissa 2**power 10**k, rounded to an integer
   pure subroutine round_product(mantissa, power, k, digits, sure)
      !> Integer of 53 bits, and its power of two
      integer(i8), intent(in) :: mantissa
      integer, intent(in) :: power
      !> Power of ten
      integer, intent(in) :: k
      !> The integer
      integer(i8), intent(out) :: digits
      !> Whether it is right
      logical, intent(out) :: sure

      integer(wide) :: product, rest, half
      integer :: j, b, shift, bits

      j = (k - lowest*step)/step + lowest
      b = k - j*step
      if (j == 0) then
         product = int(mantissa, wide)*five(b)
         shift = -(power + k)
      else
         product = int(coarse(j), wide)*five(b)
         bits = 65 - leadz(product)  ! beyond 63
         product = mantissa*shiftr(product, bits)
         shift = -(power + b + bits + coarse_exponent(j))
      end if
      sure = .true.
      if (shift <= 0) then
         digits = int(shiftl(product, -shift), i8)
         return
      end if
      digits = int(shiftr(product, shift), i8)
      rest = product - shiftl(int(digits, wide), shift)
      half = shiftl(1_wide, shift - 1)
      if (j /= 0) sure = abs(rest - half) > doubt
      if (rest > half .or. (rest == half .and. btest(digits, 0))) digits = digits + 1
   end subroutine round_product

   !> floor(27 j log2(10)) - 62: the power of two that `coarse` is multiplied by
   pure integer function coarse_exponent(j)
      !> Its index
      integer, intent(in) :: j

      coarse_exponent = shifta(step*j*1741647, 19) - 62
   end function coarse_exponent

   !> Digits of an integer, with zeros in front
   pure subroutine put_digits(number, text)
      !> The integer, not negative
      integer(i8), intent(in) :: number
      !> The digits
      character(len=*), intent(out) :: text

      integer(i8) :: rest
      integer :: i, few, next

      rest = number
      i = len(text)
      do while (rest > huge(few))
         text(i - 1:i) = pairs(mod(rest, 100_i8))
         rest = rest/100_i8
         i = i - 2
      end do
      few = int(rest)  ! divided several times faster
      do i = i, 2, -2
         next = few/100
         text(i - 1:i) = pairs(few - 100*next)
         few = next
      end do
      if (mod(len(text), 2) == 1) text(1:1) = achar(iachar('0') + mod(few, 10))
   end subroutine put_digits

end module axijoint_base_digits
