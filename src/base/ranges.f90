!> A whole cut into equal ranges, one a thread
module axijoint_base_ranges
   use axijoint_base_kinds, only : i8
   implicit none
   private
   public :: range_end

contains

   !> Last entry of the k-th of some ranges of n entries; that of range 0 is 0
   pure integer function range_end(n, k, n_ranges)
      !> Number of entries, number of the range, number of ranges
      integer, intent(in) :: n, k, n_ranges

      range_end = int(int(n, i8)*k/n_ranges)
   end function range_end

end module axijoint_base_ranges
