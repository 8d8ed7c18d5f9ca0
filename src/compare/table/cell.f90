!> One value of a table: a number as some program printed it, or what stands in its place
module axijoint_compare_table_cell
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : lower
   use axijoint_deck_text_token, only : read_real, token_good, token_too_large, token_too_small
   implicit none
   private
   public :: cell_type, read_cell, number_length
   public :: cell_number, cell_blank, cell_overflow, cell_not_a_number, cell_infinite, cell_word, &
      cell_strange

   !> A number
   integer, parameter :: cell_number = 0
   !> Nothing is printed
   integer, parameter :: cell_blank = 1
   !> Asterisks: the number did not fit, or is too large for a real of 64 bits
   integer, parameter :: cell_overflow = 2
   !> NaN
   integer, parameter :: cell_not_a_number = 3
   !> Infinity; the value is its sign
   integer, parameter :: cell_infinite = 4
   !> A word; the value is its index in a list of words
   integer, parameter :: cell_word = 5
   !> No number
   integer, parameter :: cell_strange = 6

   !> A value
   type :: cell_type
      !> The number; 0 where there is none
      real(wp) :: value = 0.0_wp
      !> One unit of the last digit printed; 0 if the number is exact
      real(wp) :: unit = 0.0_wp
      !> One of the `cell_` parameters
      integer :: state = cell_blank
   end type cell_type

   !> Digits
   character(len=*), parameter :: digits = '0123456789'
   !> Letters before an exponent
   character(len=*), parameter :: exponent_letters = 'eEdDqQ'
   !> Largest exponent of a unit that is kept: beyond, powers of ten leave the reals
   integer, parameter :: largest_exponent = 300

contains

   !> A number as Fortran programs print it: exponents after E, D, Q or after their sign alone,
   !> a blank for the sign of an exponent, asterisks, NaN, infinities
   pure function read_cell(text) result(cell)
      !> The text
      character(len=*), intent(in) :: text
      !> The value
      type(cell_type) :: cell

      character(len=:), allocatable :: token
      integer :: fault, i

      token = trim(adjustl(text))
      if (len(token) == 0) return
      do i = 1, len(token) - 1
         if (scan(token(i:i), exponent_letters) == 0) cycle
         token(i:i) = 'E'
         if (token(i + 1:i + 1) == ' ') token(i + 1:i + 1) = '+'
      end do
      call read_real(token, cell%value, fault)
      select case (fault)
      case (token_good)
         cell%state = cell_number
         cell%unit = last_unit(token)
         if (cell%value < 0.0_wp .or. cell%value > 0.0_wp) return
         ! 0.00E+00 is an exact zero, 0.00 is not: only the first shows all magnitudes
         if (scan(token, 'E') > 0) cell%unit = 0.0_wp
      case (token_too_small)
         cell%state = cell_number
      case (token_too_large)
         cell%state = cell_overflow
      case default
         call read_special(lower(token), cell)
      end select
   end function read_cell

   !> Asterisks, NaN, infinities in the spellings of several run-time libraries
   pure subroutine read_special(token, cell)
      !> The text in small letters
      character(len=*), intent(in) :: token
      !> The value
      type(cell_type), intent(inout) :: cell

      character(len=:), allocatable :: name

      cell%value = 0.0_wp
      cell%state = cell_strange
      name = token
      if (scan(token(1:1), '+-') == 1) name = token(2:)
      if (len(name) == 0) return
      if (verify(name, '*') == 0) then
         cell%state = cell_overflow
      else if (index(name, 'nan') == 1 .or. index(name, '1.#qnan') == 1 &
               .or. index(name, '1.#ind') == 1) then
         cell%state = cell_not_a_number
      else if (name == 'inf' .or. name == 'infinity' .or. index(name, '1.#inf') == 1) then
         cell%state = cell_infinite
         cell%value = merge(-1.0_wp, 1.0_wp, token(1:1) == '-')
      end if
   end subroutine read_special

   !> One unit of the last digit of a number; 0 for integers
   pure real(wp) function last_unit(token) result(unit)
      !> The number
      character(len=*), intent(in) :: token

      integer :: point, last, decimals, exponent, status

      unit = 0.0_wp
      point = index(token, '.')
      last = verify(token(2:), digits//'.')  ! the mantissa ends here
      if (last == 0) last = len(token)
      if (point == 0 .and. last == len(token)) return
      decimals = 0
      if (point > 0) decimals = last - point
      exponent = 0
      if (last < len(token)) then
         read (token(last + merge(2, 1, token(last + 1:last + 1) == 'E'):), *, &
            iostat=status) exponent
         if (status /= 0) return
      end if
      exponent = exponent - decimals
      if (abs(exponent) <= largest_exponent) unit = 10.0_wp**exponent
   end function last_unit

   !> Characters of the number that a text begins with. Numbers side by side without a blank are
   !> told apart by signs, asterisks and points: 0.12-101 is one number, 0.12-101.5 are two
   pure integer function number_length(text) result(n)
      !> The text, without blanks
      character(len=*), intent(in) :: text

      integer :: k
      logical :: point

      if (len(text) == 0) then
         n = 0
         return
      end if
      if (text(1:1) == '*') then
         n = run_of(text, '*')
         return
      end if
      n = 0
      if (scan(text(1:1), '+-') == 1) n = 1
      k = run_of(text(n + 1:), digits)
      n = n + k
      point = index(text(n + 1:), '.') == 1
      if (point) n = n + 1 + run_of(text(n + 2:), digits)
      if (n == len(text) .or. k + n == 0) return
      k = n + 1
      if (scan(text(k:k), exponent_letters) == 1) k = k + 1
      if (k == n + 1 .and. .not. point) return
      if (k > len(text)) return
      if (scan(text(k:k), '+-') == 1) k = k + 1
      k = k - 1
      if (k == n) return
      if (run_of(text(k + 1:), digits) == 0) return
      k = k + run_of(text(k + 1:), digits)
      if (scan(text(n + 1:n + 1), '+-') == 1 .and. k < len(text)) then
         if (text(k + 1:k + 1) == '.') return  ! the sign begins a second number
      end if
      n = k
   end function number_length

   !> Characters of a set that a text begins with
   pure integer function run_of(text, set) result(n)
      !> The text
      character(len=*), intent(in) :: text
      !> The set
      character(len=*), intent(in) :: set

      n = verify(text, set) - 1
      if (n < 0) n = len(text)
   end function run_of

end module axijoint_compare_table_cell
