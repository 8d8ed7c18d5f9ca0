!> SHA-256 of a text (FIPS 180-4)
module axijoint_base_sha256
   use, intrinsic :: iso_fortran_env, only : int32, int64
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: sha256

   !> Bytes of a block, rounds on it
   integer, parameter :: block_bytes = 64, rounds = 64

contains

   !> The hash in hexadecimal digits
   pure function sha256(text) result(hash)
      !> The text
      character(len=*), intent(in) :: text
      !> 64 digits
      character(len=64) :: hash

      integer(int32) :: state(8), key(rounds)
      character(len=block_bytes) :: block
      character(len=2*block_bytes) :: tail
      integer(int64) :: blocks, i
      integer :: k, n, used

      call constants(state, key)
      blocks = len(text, int64)/block_bytes
      do i = 1, blocks
         block = text(block_bytes*(i - 1) + 1:block_bytes*i)
         call mix(block, key, state)
      end do
      used = int(len(text, int64) - block_bytes*blocks)
      n = merge(1, 2, used < block_bytes - 8)
      tail = repeat(achar(0), len(tail))
      tail(:used) = text(block_bytes*blocks + 1:)
      tail(used + 1:used + 1) = char(128)
      do k = 0, 7  ! length in bits, the highest byte first
         tail(block_bytes*n - k:block_bytes*n - k) = &
            char(int(ibits(8_int64*len(text, int64), 8*k, 8)))
      end do
      do i = 1, n
         block = tail(block_bytes*(i - 1) + 1:block_bytes*i)
         call mix(block, key, state)
      end do
      write (hash, '(8z8.8)') state
      call to_lower(hash)
   end function sha256

   !> First 32 bits of the fractional parts of the square roots of the first 8 primes, and of the
   !> cube roots of the first 64
   pure subroutine constants(state, key)
      !> First state
      integer(int32), intent(out) :: state(8)
      !> Constants of the rounds
      integer(int32), intent(out) :: key(rounds)

      integer :: candidate, n

      candidate = 1
      n = 0
      do while (n < rounds)
         candidate = candidate + 1
         if (.not. is_prime(candidate)) cycle
         n = n + 1
         if (n <= size(state)) state(n) = root_fraction(candidate, 2)
         key(n) = root_fraction(candidate, 3)
      end do
   end subroutine constants

   !> Whether a number has no divisor
   pure logical function is_prime(number)
      !> The number
      integer, intent(in) :: number

      integer :: i

      is_prime = .true.
      i = 2
      do while (is_prime .and. i*i <= number)
         is_prime = mod(number, i) /= 0
         i = i + 1
      end do
   end function is_prime

   !> 32 bits of the fraction of a root
   pure integer(int32) function root_fraction(number, degree) result(bits)
      !> The number, and 2 or 3
      integer, intent(in) :: number, degree

      real(wp) :: root

      root = real(number, wp)**(1.0_wp/degree)
      bits = low_word(int((root - aint(root))*2.0_wp**32, int64))
   end function root_fraction

   !> Work a block into the state
   pure subroutine mix(block, key, state)
      !> 64 bytes
      character(len=block_bytes), intent(in) :: block
      !> Constants of the rounds
      integer(int32), intent(in) :: key(rounds)
      !> The state
      integer(int32), intent(inout) :: state(8)

      integer(int32) :: w(rounds), a, b, c, d, e, f, g, h, first, second
      integer :: i, k

      do i = 1, 16
         k = 4*i - 3
         w(i) = ior(ior(shiftl(ichar(block(k:k)), 24), shiftl(ichar(block(k + 1:k + 1)), 16)), &
                    ior(shiftl(ichar(block(k + 2:k + 2)), 8), ichar(block(k + 3:k + 3))))
      end do
      do i = 17, rounds
         first = ieor(ieor(ishftc(w(i - 15), -7), ishftc(w(i - 15), -18)), shiftr(w(i - 15), 3))
         second = ieor(ieor(ishftc(w(i - 2), -17), ishftc(w(i - 2), -19)), shiftr(w(i - 2), 10))
         w(i) = plus(plus(w(i - 16), first), plus(w(i - 7), second))
      end do
      a = state(1)
      b = state(2)
      c = state(3)
      d = state(4)
      e = state(5)
      f = state(6)
      g = state(7)
      h = state(8)
      do i = 1, rounds
         first = plus(plus(plus(h, ieor(ieor(ishftc(e, -6), ishftc(e, -11)), ishftc(e, -25))), &
                           ieor(iand(e, f), iand(not(e), g))), plus(key(i), w(i)))
         second = plus(ieor(ieor(ishftc(a, -2), ishftc(a, -13)), ishftc(a, -22)), &
                       ieor(ieor(iand(a, b), iand(a, c)), iand(b, c)))
         h = g
         g = f
         f = e
         e = plus(d, first)
         d = c
         c = b
         b = a
         a = plus(first, second)
      end do
      state = [plus(state(1), a), plus(state(2), b), plus(state(3), c), plus(state(4), d), &
               plus(state(5), e), plus(state(6), f), plus(state(7), g), plus(state(8), h)]
   end subroutine mix

   !> Sum modulo 2^32
   elemental integer(int32) function plus(a, b) result(total)
      !> The terms
      integer(int32), intent(in) :: a, b

      total = low_word(int(a, int64) + int(b, int64))
   end function plus

   !> The lowest 32 bits
   pure integer(int32) function low_word(long) result(word)
      !> A number
      integer(int64), intent(in) :: long

      word = int(shifta(shiftl(long, 32), 32), int32)  ! with its highest bit as sign
   end function low_word

   !> Small letters
   pure subroutine to_lower(text)
      !> Digits
      character(len=*), intent(inout) :: text

      integer :: i

      do i = 1, len(text)
         if (text(i:i) >= 'A' .and. text(i:i) <= 'F') text(i:i) = achar(iachar(text(i:i)) + 32)
      end do
   end subroutine to_lower

end module axijoint_base_sha256
