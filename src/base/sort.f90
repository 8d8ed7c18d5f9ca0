!> Orders of reals and of small integers; short lists
module axijoint_base_sort
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: ascending_order, lexical_order, refine_order, sort_short

contains

   !> Order in which reals ascend; equal ones stay as they are (merge sort)
   pure function ascending_order(keys) result(order)
      !> The reals
      real(wp), intent(in) :: keys(:)
      !> Indices of the reals from the smallest to the largest
      integer, allocatable :: order(:)

      integer, allocatable :: merged(:)
      integer :: width, first, middle, last, i, n

      n = size(keys)
      order = [(i, i=1, n)]
      allocate (merged(n))
      width = 1
      do while (width < n)
         do first = 1, n, 2*width
            middle = min(first + width - 1, n)
            last = min(first + 2*width - 1, n)
            call merge_runs(keys, order(first:middle), order(middle + 1:last), merged(first:last))
         end do
         order = merged
         width = 2*width
      end do
   end function ascending_order

   !> Order in which things ascend by their first keys, where these are equal by their second, and so
   !> on; equal things stay as they are
   pure function lexical_order(keys) result(order)
      !> The keys, shape (keys, things)
      real(wp), intent(in) :: keys(:, :)
      !> Indices of the things
      integer, allocatable :: order(:)

      integer :: k

      order = [(k, k=1, size(keys, 2))]
      do k = size(keys, 1), 1, -1
         order = order(ascending_order(keys(k, order)))
      end do
   end function lexical_order

   !> Merge two ascending runs
   pure subroutine merge_runs(keys, left, right, merged)
      !> The reals
      real(wp), intent(in) :: keys(:)
      !> Indices in ascending order of their reals
      integer, intent(in) :: left(:), right(:)
      !> All indices in ascending order
      integer, intent(out) :: merged(:)

      integer :: i, j, k
      logical :: take_left

      i = 1
      j = 1
      do k = 1, size(merged)
         take_left = j > size(right)
         if (.not. take_left .and. i <= size(left)) take_left = keys(left(i)) <= keys(right(j))
         if (take_left) then
            merged(k) = left(i)
            i = i + 1
         else
            merged(k) = right(j)
            j = j + 1
         end if
      end do
   end subroutine merge_runs

   !> Arrange an order by integers from 0 to n; entries with equal integers keep
   !> their order, so that the last call is the first criterion (counting sort)
   pure subroutine refine_order(order, keys)
      !> Indices of the integers
      integer, intent(inout) :: order(:)
      !> The integers, none negative
      integer, intent(in) :: keys(:)

      integer, allocatable :: place(:), arranged(:)
      integer :: i

      allocate (place(0:maxval([0, keys]) + 1), source=0)
      do i = 1, size(order)
         place(keys(order(i)) + 1) = place(keys(order(i)) + 1) + 1
      end do
      place(0) = 1
      do i = 1, ubound(place, 1)
         place(i) = place(i) + place(i - 1)
      end do
      allocate (arranged(size(order)))
      do i = 1, size(order)
         arranged(place(keys(order(i)))) = order(i)
         place(keys(order(i))) = place(keys(order(i))) + 1
      end do
      order = arranged
   end subroutine refine_order

   !> Sort a short list by insertion; equals keep their order
   pure subroutine sort_short(list, keys)
      !> The list, ascending on return
      integer, intent(inout) :: list(:)
      !> What is compared: the list holds indices of these. Without them, its own values
      integer, intent(in), optional :: keys(:)

      integer :: i, j, entry

      do i = 2, size(list)
         entry = list(i)
         j = i - 1
         do while (j >= 1)
            if (present(keys)) then
               if (keys(list(j)) <= keys(entry)) exit
            else
               if (list(j) <= entry) exit
            end if
            list(j + 1) = list(j)
            j = j - 1
         end do
         list(j + 1) = entry
      end do
   end subroutine sort_short

end module axijoint_base_sort
