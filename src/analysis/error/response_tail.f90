!> What harmonics above M would add to the response to loads that are functions of theta, from the
!> course of the harmonics up to M
module axijoint_analysis_error_response_tail
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: response_tail

   !> The sums over the octaves of harmonics fall at least by this factor, about 1/sqrt(2): that of
   !> amplitudes that fall with m^(-3/2), between a load that jumps and the response to it
   real(wp), parameter :: slowest = 0.7_wp

contains

   !> Sum of the amplitudes above M: the sums over (M, 2M], (2M, 4M] ... are taken to fall on by the
   !> factor from (M/4, M/2] to (M/2, M]. Negative if it is not known, as up to M = 1: harmonics 0 and 1, which move parts as
   !> rigid, tell nothing of those above
   pure real(wp) function response_tail(harmonic, amplitude) result(tail)
      !> Harmonic of each mode, and its amplitude, shape (modes)
      integer, intent(in) :: harmonic(:)
      real(wp), intent(in) :: amplitude(:)

      real(wp) :: upper, lower, factor
      integer :: m

      tail = -1.0_wp
      m = maxval(harmonic)
      if (m <= 1) return
      upper = sum(amplitude, mask=harmonic > m/2)
      lower = sum(amplitude, mask=harmonic > m/4 .and. harmonic <= m/2)
      factor = slowest
      if (upper < slowest*lower) factor = upper/lower
      tail = upper*factor/(1.0_wp - factor)
   end function response_tail

end module axijoint_analysis_error_response_tail
