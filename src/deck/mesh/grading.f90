!> Points between points, equally far apart or graded
module axijoint_deck_mesh_grading
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: graded_fraction, between

contains

   !> Where the i-th of n intervals ends, on [0, 1]: intervals in geometric
   !> progression with a given ratio of the last to the first
   pure real(wp) function graded_fraction(i, n, ratio) result(fraction)
      !> Interval, 0 to n, and number of intervals
      integer, intent(in) :: i, n
      !> Last to first interval
      real(wp), intent(in) :: ratio

      real(wp) :: half

      fraction = real(i, wp)/real(n, wp)
      if (n == 1 .or. i == 0 .or. i == n) return
      half = 0.5_wp*log(ratio)/real(n - 1, wp)  ! half the logarithm of the ratio of neighbours
      if (abs(half) > 0.0_wp) then
         ! (q**i - 1)/(q**n - 1), written so that q near 1 loses no digits
         fraction = exp(real(i - n, wp)*half)*sinh(real(i, wp)*half)/sinh(real(n, wp)*half)
      end if
   end function graded_fraction

   !> Point between two points; exact at both, and exact in a coordinate that both share
   pure elemental real(wp) function between(a, b, fraction)
      !> The points
      real(wp), intent(in) :: a, b
      !> 0 at a, 1 at b
      real(wp), intent(in) :: fraction

      if (fraction < 0.5_wp) then
         between = a + fraction*(b - a)
      else
         between = b - (1.0_wp - fraction)*(b - a)
      end if
   end function between

end module axijoint_deck_mesh_grading
