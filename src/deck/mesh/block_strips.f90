!> Which rows and columns of elements of blocks go on in others
module axijoint_deck_mesh_block_strips
   use axijoint_base_kinds, only : wp
   use axijoint_deck_mesh_generate_blocks, only : block_type, point_of_block
   use axijoint_deck_mesh_places, only : group_places, extent_of, same_place
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_strips, only : grid_type, strip_type, n_intervals
   implicit none
   private
   public :: find_strips

   !> Divisions of a strip by two blocks that differ by less, as parts of the strip, are the same
   real(wp), parameter :: same_division = 1.0e-6_wp

   !> The grid lines of one direction of a block: places of their ends on both sides, and whether
   !> strips end there
   type :: lines_type
      integer, allocatable :: place(:, :)
      logical, allocatable :: ends(:)
   end type lines_type

   !> A band while the strips are sought
   type :: segment_type
      !> Block, direction, first and last grid line
      integer :: block = 0, direction = 0, first = 0, last = 0
      !> Places of its ends on both sides, shape (2 ends, 2 sides)
      integer :: place(2, 2) = 0
      !> Its strip, and whether it runs against it
      integer :: strip = 0
      logical :: backwards = .false.
   end type segment_type

contains

   !> Find the strips of blocks. There are none if blocks that meet are not divided alike
   subroutine find_strips(blocks, marks, grid)
      !> The blocks
      type(block_type), intent(in) :: blocks(:)
      !> Places where nodes must stay, shape (2, any)
      real(wp), intent(in) :: marks(:, :)
      !> The strips; not allocated if there are none
      type(grid_type), allocatable, intent(out) :: grid

      type(lines_type), allocatable :: lines(:, :)
      type(segment_type), allocatable :: segments(:)

      if (size(blocks) == 0) return
      call find_lines(blocks, marks, lines)
      call find_segments(lines, segments)
      call unite_segments(segments)
      allocate (grid)
      call take_strips(blocks, segments, grid)
      if (.not. divided_alike(blocks, segments, grid)) deallocate (grid)
   end subroutine find_strips

   !> Find the grid lines of the blocks, and those where strips end: at corners of blocks, at the
   !> marks, and where such a line goes on in the next block
   subroutine find_lines(blocks, marks, lines)
      !> The blocks
      type(block_type), intent(in) :: blocks(:)
      !> Places where nodes must stay
      real(wp), intent(in) :: marks(:, :)
      !> Shape (2 directions, blocks)
      type(lines_type), allocatable, intent(out) :: lines(:, :)

      integer, allocatable :: place(:)
      logical, allocatable :: ending(:)
      integer :: k, d, n

      place = places_of(blocks, marks)
      allocate (ending(maxval(place)), source=.false.)
      n = size(marks, 2)
      ending(place(:n)) = .true.
      allocate (lines(2, size(blocks)))
      do k = 1, size(blocks)
         do d = 1, 2
            associate (m => blocks(k)%n(d) + 1, own => lines(d, k))
               own%place = reshape(place(n + 1:n + 2*m), [m, 2])
               allocate (own%ends(m), source=.false.)
               ending(own%place([1, m], 1)) = .true.
               ending(own%place([1, m], 2)) = .true.
               n = n + 2*m
            end associate
         end do
      end do
      call end_strips(ending, lines)
   end subroutine find_lines

   !> Number the places of the marks, then of the ends of the grid lines: block by block, along side
   !> 1-2 first, on its first side, then on the opposite one
   function places_of(blocks, marks) result(place)
      !> The blocks
      type(block_type), intent(in) :: blocks(:)
      !> r and z of the marks
      real(wp), intent(in) :: marks(:, :)
      !> Their numbers: the same for what lies at one place
      integer, allocatable :: place(:)

      real(wp), allocatable :: position(:, :)
      integer :: k, d, i, side, n

      n = size(marks, 2)
      allocate (position(2, n + sum([(2*(sum(blocks(k)%n) + 2), k=1, size(blocks))])))
      position(:, :n) = marks
      do k = 1, size(blocks)
         do d = 1, 2
            do side = 0, 1
               do i = 0, blocks(k)%n(d)
                  n = n + 1
                  position(:, n) = point_of_block(blocks(k), on_side(d, i, side*blocks(k)%n(3 - d)))
               end do
            end do
         end do
      end do
      place = group_places(position, same_place*extent_of(position))
   end function places_of

   !> A place on the grid of half elements
   pure function on_side(direction, along, across) result(place)
      !> Direction 1 or 2
      integer, intent(in) :: direction
      !> Elements along it, and along the other
      integer, intent(in) :: along, across
      !> Half elements along sides 1-2 and 2-3
      integer :: place(2)

      place(direction) = 2*along
      place(3 - direction) = 2*across
   end function on_side

   !> Let strips end at all lines that begin or end at places where others do
   pure subroutine end_strips(ending, lines)
      !> Whether lines at a place end strips
      logical, intent(inout) :: ending(:)
      !> The lines
      type(lines_type), intent(inout) :: lines(:, :)

      integer :: k, d, i
      logical :: moved

      moved = .true.
      do while (moved)
         moved = .false.
         do k = 1, size(lines, 2)
            do d = 1, 2
               associate (own => lines(d, k))
                  do i = 1, size(own%ends)
                     if (own%ends(i) .or. .not. any(ending(own%place(i, :)))) cycle
                     own%ends(i) = .true.
                     ending(own%place(i, :)) = .true.
                     moved = .true.
                  end do
               end associate
            end do
         end do
      end do
   end subroutine end_strips

   !> Parts of the blocks between lines where strips end, block by block, along side 1-2 first
   subroutine find_segments(lines, segments)
      !> Shape (2 directions, blocks)
      type(lines_type), intent(in) :: lines(:, :)
      !> The parts
      type(segment_type), allocatable, intent(out) :: segments(:)

      integer :: k, d, i, n, last

      n = 0
      do k = 1, size(lines, 2)
         n = n + count(lines(1, k)%ends) + count(lines(2, k)%ends) - 2
      end do
      allocate (segments(n))
      n = 0
      do k = 1, size(lines, 2)
         do d = 1, 2
            last = 1
            do i = 2, size(lines(d, k)%ends)
               if (.not. lines(d, k)%ends(i)) cycle
               n = n + 1
               segments(n) = segment_type(k, d, last - 1, i - 1, lines(d, k)%place([last, i], :))
               last = i
            end do
         end do
      end do
   end subroutine find_segments

   !> Number the strips: parts with a side in common are of one strip
   pure subroutine unite_segments(segments)
      !> The parts; take their strips
      type(segment_type), intent(inout) :: segments(:)

      integer, allocatable :: waiting(:)
      integer :: first, n_waiting, n_strips, i, k, way

      allocate (waiting(size(segments)))
      n_strips = 0
      do first = 1, size(segments)
         if (segments(first)%strip > 0) cycle
         n_strips = n_strips + 1
         segments(first)%strip = n_strips
         waiting(1) = first
         n_waiting = 1
         do while (n_waiting > 0)
            i = waiting(n_waiting)
            n_waiting = n_waiting - 1
            do k = 1, size(segments)
               if (segments(k)%strip > 0) cycle
               way = way_of(segments(i)%place, segments(k)%place)
               if (way == 0) cycle
               segments(k)%strip = n_strips
               segments(k)%backwards = segments(i)%backwards .neqv. way < 0
               n_waiting = n_waiting + 1
               waiting(n_waiting) = k
            end do
         end do
      end do
   end subroutine unite_segments

   !> Whether two parts have a side in common: 1 if they run the same way, -1 if not, 0 if they
   !> have none
   pure integer function way_of(a, b) result(way)
      !> Places of the ends of both, shape (2 ends, 2 sides)
      integer, intent(in) :: a(2, 2), b(2, 2)

      integer :: i, j

      way = 0
      do i = 1, 2
         do j = 1, 2
            if (all(a(:, i) == b(:, j))) way = 1
            if (all(a(:, i) == b([2, 1], j))) way = -1
         end do
      end do
   end function way_of

   !> The strips, divided as the first block in each
   subroutine take_strips(blocks, segments, grid)
      !> The blocks
      type(block_type), intent(in) :: blocks(:)
      !> Their parts
      type(segment_type), intent(in) :: segments(:)
      !> Takes strips and blocks
      type(grid_type), intent(inout) :: grid

      integer :: i, k, d
      integer, allocatable :: own(:)

      allocate (grid%strips(maxval(segments%strip)), grid%blocks(size(blocks)))
      do k = 1, size(blocks)
         grid%blocks(k)%per_cell = merge(1, 2, n_corners(blocks(k)%size) == 4)
         do d = 1, 2
            own = pack([(i, i=1, size(segments))], segments%block == k .and. &
                       segments%direction == d)
            allocate (grid%blocks(k)%sides(d)%bands(size(own)))
            associate (bands => grid%blocks(k)%sides(d)%bands)
               bands%strip = segments(own)%strip
               bands%backwards = segments(own)%backwards
               bands%first = blocks(k)%ends(segments(own)%first, d)
               bands%last = blocks(k)%ends(segments(own)%last, d)
            end associate
         end do
      end do
      do i = size(segments), 1, -1
         if (segments(i)%backwards) cycle
         associate (segment => segments(i), strip => grid%strips(segments(i)%strip))
            strip%ends = parts_of(blocks(segment%block), segment)
            d = segment%direction
            strip%line(:, 1) = point_of_block(blocks(segment%block), on_side(d, segment%first, 0))
            strip%line(:, 2) = point_of_block(blocks(segment%block), on_side(d, segment%last, 0))
         end associate
      end do
   end subroutine take_strips

   !> Where a block divides its part of a strip, 0 to 1 from the strip's beginning on
   pure function parts_of(block, segment) result(parts)
      !> The block
      type(block_type), intent(in) :: block
      !> The part
      type(segment_type), intent(in) :: segment
      !> Shape (intervals + 1)
      real(wp), allocatable :: parts(:)

      integer :: n

      associate (ends => block%ends(segment%first:segment%last, segment%direction))
         n = size(ends)
         parts = (ends - ends(1))/(ends(n) - ends(1))
         parts(n) = 1.0_wp
         if (segment%backwards) parts = 1.0_wp - parts(n:1:-1)
      end associate
   end function parts_of

   !> Whether all blocks divide the strips alike
   pure logical function divided_alike(blocks, segments, grid) result(alike)
      !> The blocks
      type(block_type), intent(in) :: blocks(:)
      !> Their parts
      type(segment_type), intent(in) :: segments(:)
      !> The strips
      type(grid_type), intent(in) :: grid

      real(wp), allocatable :: parts(:)
      integer :: i

      alike = .true.
      do i = 1, size(segments)
         associate (strip => grid%strips(segments(i)%strip))
            parts = parts_of(blocks(segments(i)%block), segments(i))
            if (size(parts) /= n_intervals(strip) + 1) then
               alike = .false.
            else if (any(abs(parts - strip%ends) > same_division)) then
               alike = .false.
            end if
         end associate
      end do
   end function divided_alike

end module axijoint_deck_mesh_block_strips
