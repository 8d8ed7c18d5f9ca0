!> Where the elements of blocks should be: strips are divided anew so that the error falls as wished
!> with the fewest elements. With C_i the part of the error that interval i of a strip leaves, falling
!> with the power 2p of the size of elements of degree p, and c the elements across the strip, the
!> least sum of c n_i for a given sum of C_i n_i**(-2p) has n_i ~ (C_i/c)**(1/(2p + 1))
module axijoint_analysis_error_grading
   use axijoint_base_kinds, only : wp
   use axijoint_model_strips, only : strip_type, grid_type, n_intervals, side_intervals, n_cells
   implicit none
   private
   public :: grading_type, divide_strips, divide_interval

   !> What is wished for
   type :: grading_type
      !> Part of the error that may remain
      real(wp) :: remains = 1.0_wp
      !> Power of the size of elements that the error is expected to fall with
      real(wp) :: order = 1.0_wp
      !> Degree of the elements that the error is of
      integer :: degree = 1
      !> Least and most pieces of an interval, on the average over its part of the strip
      real(wp) :: fewest = 1.0_wp, most = 1.0_wp
      !> Shortest interval, on the line across each strip that is known [length]
      real(wp) :: shortest = 0.0_wp
      !> Most cells of all blocks
      real(wp) :: most_cells = huge(1.0_wp)
   end type grading_type

   !> Values for the intervals of a strip
   type :: values_type
      real(wp), allocatable :: of(:)
   end type values_type

   !> Errors below this part of the largest count as this part: rounding says nothing
   real(wp), parameter :: negligible = 1.0e-12_wp
   !> Least power of the distance that the number of elements per length follows at the end of a
   !> strip: that of elements of degree 2 where u ~ r**0.75. With that of the tip of a crack, -0.8,
   !> the first of two pieces would be 1/31 of the second, not 1/9
   real(wp), parameter :: steepest = -0.7_wp

contains

   !> Divide the strips anew
   subroutine divide_strips(grid, error, wish, strips)
      !> The blocks as they are divided
      type(grid_type), intent(in) :: grid
      !> The part of the error that each element leaves; it need not be scaled, shape (elements)
      real(wp), intent(in) :: error(:)
      !> What is wished for
      type(grading_type), intent(in) :: wish
      !> The strips, divided anew
      type(strip_type), allocatable, intent(out) :: strips(:)

      type(values_type), allocatable :: share(:), pieces(:)
      real(wp) :: factor
      integer :: k

      call share_error(grid, error, share)
      call weigh(grid, wish%degree, share, pieces)
      factor = min(largest_factor(of_room=.false.), largest_factor(of_room=.true.))
      allocate (strips(size(grid%strips)))
      do k = 1, size(strips)
         strips(k)%line = grid%strips(k)%line
         associate (line => grid%strips(k)%line)
            call divide_strip(grid%strips(k)%ends, bounded(factor, k), &
                              wish%shortest/norm2(line(:, 2) - line(:, 1)), strips(k)%ends)
         end associate
      end do

   contains

      !> Largest factor on the weights with which too much error remains, or with which there is room
      !> for the cells
      real(wp) function largest_factor(of_room) result(low)
         !> Which of the two
         logical, intent(in) :: of_room

         integer, parameter :: most_halvings = 60
         real(wp) :: high, middle
         logical :: holds
         integer :: i

         low = 1.0e-6_wp
         high = 1.0e6_wp
         do i = 1, most_halvings
            middle = sqrt(low*high)
            if (of_room) then
               holds = has_room(middle)
            else
               holds = is_too_coarse(middle)
            end if
            if (holds) then
               low = middle
            else
               high = middle
            end if
         end do
      end function largest_factor

      !> Pieces of the intervals of a strip
      function bounded(factor, k)
         !> Factor on their weights
         real(wp), intent(in) :: factor
         !> The strip
         integer, intent(in) :: k
         !> Shape (intervals)
         real(wp), allocatable :: bounded(:)

         bounded = min(wish%most, max(wish%fewest, factor*pieces(k)%of))
      end function bounded

      !> Whether more error is left than may remain
      logical function is_too_coarse(factor)
         !> Factor on the weights
         real(wp), intent(in) :: factor

         real(wp) :: left, total
         integer :: k

         left = 0.0_wp
         total = 0.0_wp
         do k = 1, size(pieces)
            left = left + sum(share(k)%of*bounded(factor, k)**(-wish%order))
            total = total + sum(share(k)%of)
         end do
         is_too_coarse = left > wish%remains*total
      end function is_too_coarse

      !> Whether there are no more cells than there may be
      logical function has_room(factor)
         !> Factor on the weights
         real(wp), intent(in) :: factor

         integer :: n(size(pieces)), k

         do k = 1, size(pieces)
            n(k) = n_pieces(bounded(factor, k))
         end do
         has_room = n_cells(grid, n) <= wish%most_cells
      end function has_room

   end subroutine divide_strips

   !> Number of intervals of a strip
   pure integer function n_pieces(pieces)
      !> Pieces of its present intervals
      real(wp), intent(in) :: pieces(:)

      n_pieces = max(1, nint(sum(pieces)))
   end function n_pieces

   !> The error of the elements in each interval of the strips
   pure subroutine share_error(grid, error, share)
      !> The blocks
      type(grid_type), intent(in) :: grid
      !> Of each element
      real(wp), intent(in) :: error(:)
      !> Of each interval
      type(values_type), allocatable, intent(out) :: share(:)

      integer, allocatable :: first(:, :), second(:, :)
      real(wp) :: own
      integer :: k, i, j, n

      allocate (share(size(grid%strips)))
      do k = 1, size(share)
         allocate (share(k)%of(n_intervals(grid%strips(k))), source=0.0_wp)
      end do
      n = 0
      do k = 1, size(grid%blocks)
         associate (block => grid%blocks(k))
            first = side_intervals(block%sides(1), grid%strips)
            second = side_intervals(block%sides(2), grid%strips)
            do j = 1, size(second, 2)
               do i = 1, size(first, 2)
                  own = sum(error(n + 1:n + block%per_cell))
                  n = n + block%per_cell
                  associate (across => share(first(1, i))%of(first(2, i)), &
                             along => share(second(1, j))%of(second(2, j)))
                     across = across + own
                     along = along + own
                  end associate
               end do
            end do
         end associate
      end do
   end subroutine share_error

   !> Pieces of all intervals, but for a factor
   pure subroutine weigh(grid, degree, share, pieces)
      !> The blocks
      type(grid_type), intent(in) :: grid
      !> Degree of the elements
      integer, intent(in) :: degree
      !> Errors of the intervals
      type(values_type), intent(in) :: share(:)
      !> The pieces
      type(values_type), allocatable, intent(out) :: pieces(:)

      real(wp) :: across(size(share)), least
      integer :: k

      across = cells_across(grid)
      least = 0.0_wp
      do k = 1, size(share)
         least = max(least, negligible*maxval(share(k)%of))
      end do
      least = max(least, tiny(1.0_wp))
      allocate (pieces(size(share)))
      do k = 1, size(share)
         pieces(k)%of = (max(least, share(k)%of)/across(k))**(1.0_wp/(2*degree + 1))
      end do
   end subroutine weigh

   !> Cells in each interval of the strips
   pure function cells_across(grid) result(cells)
      !> The blocks
      type(grid_type), intent(in) :: grid
      !> Shape (strips)
      real(wp) :: cells(size(grid%strips))

      integer, allocatable :: own(:), other(:)
      integer :: k, d, i

      cells = 0.0_wp
      do k = 1, size(grid%blocks)
         do d = 1, 2
            own = grid%blocks(k)%sides(d)%bands%strip
            other = grid%blocks(k)%sides(3 - d)%bands%strip
            do i = 1, size(own)
               cells(own(i)) = cells(own(i)) + sum(n_intervals(grid%strips(other)))
            end do
         end do
      end do
   end function cells_across

   !> Divide one strip: each interval gets so many pieces, and within it the number of elements per
   !> length changes as from its neighbours on
   pure subroutine divide_strip(ends, pieces, shortest, divided)
      !> Ends of its intervals, 0 to 1
      real(wp), intent(in) :: ends(:)
      !> Pieces of each
      real(wp), intent(in) :: pieces(:)
      !> Shortest interval, over the length of the strip
      real(wp), intent(in) :: shortest
      !> Ends of the new ones
      real(wp), allocatable, intent(out) :: divided(:)

      real(wp) :: before, wanted, total, next
      integer :: i, k, n

      n = n_pieces(pieces)
      total = sum(pieces)
      divided = [0.0_wp]
      k = 1
      before = 0.0_wp  ! pieces of the intervals before the k-th
      do i = 1, n - 1
         wanted = total*i/n
         do while (before + pieces(k) < wanted .and. k < size(pieces))
            before = before + pieces(k)
            k = k + 1
         end do
         next = ends(k) + (ends(k + 1) - ends(k))*divide_interval( &
            ends, pieces, k, min(1.0_wp, (wanted - before)/pieces(k)))
         if (next - divided(size(divided)) < shortest .or. 1.0_wp - next < shortest) cycle
         divided = [divided, next]
      end do
      divided = [divided, 1.0_wp]
   end subroutine divide_strip

   !> Where in an interval a part of its pieces ends. At the ends of the strip their density is a
   !> power of the distance from there, through the densities of the first two intervals; between,
   !> its logarithm is linear
   pure real(wp) function divide_interval(ends, pieces, k, part) result(place)
      !> Ends of the intervals
      real(wp), intent(in) :: ends(:)
      !> Pieces of each
      real(wp), intent(in) :: pieces(:)
      !> The interval
      integer, intent(in) :: k
      !> Part of its pieces, 0 to 1
      real(wp), intent(in) :: part

      real(wp) :: middle(size(pieces)), density(size(pieces)), power, slope
      integer :: n

      n = size(pieces)
      place = part
      if (n == 1) return
      middle = 0.5_wp*(ends(2:) + ends(:n))
      density = log(pieces/(ends(2:) - ends(:n)))
      if (k == 1) then
         power = (density(2) - density(1))/log(middle(2)/middle(1))
         place = part**(1.0_wp/(1.0_wp + min(0.0_wp, max(steepest, power))))
      else if (k == n) then
         power = (density(n - 1) - density(n))/log((1.0_wp - middle(n - 1))/(1.0_wp - middle(n)))
         place = 1.0_wp - (1.0_wp - part)**(1.0_wp/(1.0_wp + min(0.0_wp, max(steepest, power))))
      else
         slope = (density(k + 1) - density(k - 1))/(middle(k + 1) - middle(k - 1)) &
                 *(ends(k + 1) - ends(k))
         if (abs(slope) > 1.0e-6_wp) place = log(1.0_wp + part*(exp(slope) - 1.0_wp))/slope
      end if
   end function divide_interval

end module axijoint_analysis_error_grading
