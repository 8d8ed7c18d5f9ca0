!> Points at the same place, and points near a point
module axijoint_deck_mesh_places
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : ascending_order, refine_order
   implicit none
   private
   public :: group_places, extent_of, clear_rounding, point_tree_type, new_point_tree, points_near

   !> Distance of points at the same place, in extents of the model
   real(wp), parameter, public :: same_place = 1.0e-9_wp
   !> Coordinates that are rounding of 0, in the same measure
   real(wp), parameter, public :: axis_tolerance = 1.0e-12_wp
   !> Points of a part that is not halved
   integer, parameter :: few = 8

   !> Points in the plane, halved again and again across the longer side of what is left: in turn
   !> across r and z, points of a narrow strip would lie on both sides of most cuts
   type :: point_tree_type
      private
      !> The points, shape (2, points)
      real(wp), allocatable :: position(:, :)
      !> Their indices: the middle one of each part divides it, down to parts of few points
      integer, allocatable :: order(:)
      !> Axis across which the part with the middle point here is halved, 1 for r and 2 for z
      integer, allocatable :: axis(:)
   end type point_tree_type

contains

   !> Larger side of the rectangle around points; 0 if there are none
   pure real(wp) function extent_of(position) result(extent)
      !> r and z, shape (2, points)
      real(wp), intent(in) :: position(:, :)

      extent = 0.0_wp
      if (size(position, 2) == 0) return
      extent = max(maxval(position(1, :)) - minval(position(1, :)), &
                   maxval(position(2, :)) - minval(position(2, :)))
   end function extent_of

   !> Make 0 of coordinates that are rounding of it
   pure subroutine clear_rounding(position)
      !> r and z, shape (2, points)
      real(wp), intent(inout) :: position(:, :)

      real(wp) :: least

      least = axis_tolerance*extent_of(position)
      where (abs(position) <= least) position = 0.0_wp
   end subroutine clear_rounding

   !> Number points so that those at the same place, and no others, have the
   !> same number
   pure function group_places(position, tolerance) result(group)
      !> r and z, shape (2, points)
      real(wp), intent(in) :: position(:, :)
      !> Largest distance along r and along z of points at the same place
      real(wp), intent(in) :: tolerance
      !> Number of each point's place, from 1 on
      integer, allocatable :: group(:)

      integer, allocatable :: column(:), row(:), order(:)
      integer :: i, n

      n = size(position, 2)
      column = lines_along(position(1, :), tolerance)
      row = lines_along(position(2, :), tolerance)
      order = [(i, i=1, n)]
      call refine_order(order, row)
      call refine_order(order, column)
      allocate (group(n), source=1)
      do i = 2, n
         associate (a => order(i - 1), b => order(i))
            group(b) = group(a)
            if (column(a) /= column(b) .or. row(a) /= row(b)) group(b) = group(a) + 1
         end associate
      end do
   end function group_places

   !> Number coordinates so that equal ones have the same number
   pure function lines_along(coordinate, tolerance) result(line)
      !> The coordinates
      real(wp), intent(in) :: coordinate(:)
      !> Largest difference of neighbours that count as equal
      real(wp), intent(in) :: tolerance
      !> Numbers, from 1 on
      integer, allocatable :: line(:)

      integer, allocatable :: order(:)
      integer :: i

      order = ascending_order(coordinate)
      allocate (line(size(coordinate)), source=1)
      do i = 2, size(order)
         line(order(i)) = line(order(i - 1))
         if (coordinate(order(i)) - coordinate(order(i - 1)) > tolerance) then
            line(order(i)) = line(order(i)) + 1
         end if
      end do
   end function lines_along

   !> Arrange points for questions about their neighbourhood
   pure function new_point_tree(position) result(tree)
      !> r and z, shape (2, points)
      real(wp), intent(in) :: position(:, :)
      !> The tree
      type(point_tree_type) :: tree

      integer :: i

      tree%position = position
      tree%order = [(i, i=1, size(position, 2))]
      allocate (tree%axis(size(tree%order)), source=1)
      call halve(tree%position, tree%order, tree%axis)
   end function new_point_tree

   !> Put the middle point along the axis on which the points extend most in the middle,
   !> smaller coordinates before and larger behind it, and go on with both parts
   pure recursive subroutine halve(position, order, axis)
      !> r and z
      real(wp), intent(in) :: position(:, :)
      !> Indices of the points
      integer, intent(inout) :: order(:)
      !> Axis of each part, at the place of its middle point
      integer, intent(inout) :: axis(:)

      real(wp) :: extent(2)
      integer :: middle, i

      if (size(order) <= few) return
      middle = (size(order) + 1)/2
      do i = 1, 2
         extent(i) = maxval(position(i, order)) - minval(position(i, order))
      end do
      axis(middle) = maxloc(extent, 1)
      call select_middle(position(axis(middle), :), order, middle)
      call halve(position, order(:middle - 1), axis(:middle - 1))
      call halve(position, order(middle + 1:), axis(middle + 1:))
   end subroutine halve

   !> Arrange indices so that the one in the middle is where sorting would put
   !> it, smaller values before and larger behind it (Hoare's selection)
   pure subroutine select_middle(value, order, middle)
      !> The values
      real(wp), intent(in) :: value(:)
      !> Indices
      integer, intent(inout) :: order(:)
      !> Place that matters
      integer, intent(in) :: middle

      real(wp) :: pivot
      integer :: first, last, i, j, kept

      first = 1
      last = size(order)
      do while (first < last)
         pivot = value(order(middle))
         i = first
         j = last
         do while (i <= j)
            do while (value(order(i)) < pivot)
               i = i + 1
            end do
            do while (value(order(j)) > pivot)
               j = j - 1
            end do
            if (i > j) exit
            kept = order(i)
            order(i) = order(j)
            order(j) = kept
            i = i + 1
            j = j - 1
         end do
         if (j < middle) first = i
         if (i > middle) last = j
      end do
   end subroutine select_middle

   !> Points within a distance of a place
   pure subroutine points_near(tree, place, distance, found, n_found)
      !> The points
      type(point_tree_type), intent(in) :: tree
      !> r and z
      real(wp), intent(in) :: place(2)
      !> Largest distance
      real(wp), intent(in) :: distance
      !> Indices of the points, as many as there is room for
      integer, intent(inout) :: found(:)
      !> How many there are in `found`
      integer, intent(out) :: n_found

      n_found = 0
      call collect(tree%position, tree%order, tree%axis, place, distance, found, n_found)
   end subroutine points_near

   !> Collect points of a part of the tree within a distance
   pure recursive subroutine collect(position, order, axis, place, distance, found, n_found)
      !> r and z
      real(wp), intent(in) :: position(:, :)
      !> Indices of the part
      integer, intent(in) :: order(:)
      !> Axis of each part
      integer, intent(in) :: axis(:)
      !> r and z of the place
      real(wp), intent(in) :: place(2)
      !> Largest distance
      real(wp), intent(in) :: distance
      !> Indices found
      integer, intent(inout) :: found(:)
      !> How many
      integer, intent(inout) :: n_found

      integer :: middle, k
      real(wp) :: offset(2)

      if (n_found == size(found)) return
      if (size(order) <= few) then
         do k = 1, size(order)
            call collect_one(order(k), place - position(:, order(k)), distance, found, n_found)
         end do
         return
      end if
      middle = (size(order) + 1)/2
      offset = place - position(:, order(middle))
      call collect_one(order(middle), offset, distance, found, n_found)
      if (offset(axis(middle)) <= distance) then
         call collect(position, order(:middle - 1), axis(:middle - 1), place, distance, found, &
            n_found)
      end if
      if (offset(axis(middle)) >= -distance) then
         call collect(position, order(middle + 1:), axis(middle + 1:), place, distance, found, &
            n_found)
      end if
   end subroutine collect

   !> Collect a point if it is within a distance and there is room
   pure subroutine collect_one(point, offset, distance, found, n_found)
      !> Its index
      integer, intent(in) :: point
      !> Way from it to the place
      real(wp), intent(in) :: offset(2)
      !> Largest distance
      real(wp), intent(in) :: distance
      !> Indices found
      integer, intent(inout) :: found(:)
      !> How many
      integer, intent(inout) :: n_found

      if (.not. all(abs(offset) <= distance) .or. n_found == size(found)) return
      if (.not. norm2(offset) <= distance) return
      n_found = n_found + 1
      found(n_found) = point
   end subroutine collect_one

end module axijoint_deck_mesh_places
