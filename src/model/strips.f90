!> Strips of the blocks that a mesh is made of. A row or column of elements goes on through all
!> blocks that have sides in common, and across joints; a strip holds the rows between two corners
!> or ends of faces. Where a strip is divided anew, it is divided alike in all blocks, so that no
!> node hangs
module axijoint_model_strips
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: strip_type, band_type, side_type, block_grid_type, grid_type
   public :: n_intervals, side_ends, side_intervals, n_cells

   !> A strip
   type :: strip_type
      !> Ends of its intervals, from 0 to 1, ascending
      real(wp), allocatable :: ends(:)
      !> r and z of both ends on one of the lines across it, shape (2, 2)
      real(wp) :: line(2, 2) = 0.0_wp
   end type strip_type

   !> Part of a side of a block that lies in a strip
   type :: band_type
      !> The strip (index), and whether the block counts it backwards
      integer :: strip = 0
      logical :: backwards = .false.
      !> Where it begins and ends on the block's side, 0 to 1
      real(wp) :: first = 0.0_wp, last = 1.0_wp
   end type band_type

   !> The bands of one side of a block, one after another from 0 to 1
   type :: side_type
      type(band_type), allocatable :: bands(:)
   end type side_type

   !> A block: sides 1-2 and 2-3, and elements of a cell of its grid
   type :: block_grid_type
      type(side_type) :: sides(2)
      integer :: per_cell = 1
   end type block_grid_type

   !> All blocks, in the order of their elements: cells along side 1-2 first
   type :: grid_type
      type(strip_type), allocatable :: strips(:)
      type(block_grid_type), allocatable :: blocks(:)
   end type grid_type

contains

   !> Number of intervals of a strip
   elemental integer function n_intervals(strip)
      !> The strip
      type(strip_type), intent(in) :: strip

      n_intervals = size(strip%ends) - 1
   end function n_intervals

   !> Ends of the elements along a side of a block, from 0 to 1
   pure function side_ends(side, strips) result(ends)
      !> The side
      type(side_type), intent(in) :: side
      !> The strips as they are divided
      type(strip_type), intent(in) :: strips(:)
      !> Shape (0:elements)
      real(wp), allocatable :: ends(:)

      integer :: k, i, n

      allocate (ends(0:sum(n_intervals(strips(side%bands%strip)))))
      ends(0) = 0.0_wp
      n = 0
      do k = 1, size(side%bands)
         associate (band => side%bands(k), own => strips(side%bands(k)%strip)%ends)
            do i = 2, size(own)
               n = n + 1
               ends(n) = band%first + (band%last - band%first)*merge( &
                  1.0_wp - own(size(own) + 1 - i), own(i), band%backwards)
            end do
            ends(n) = band%last
         end associate
      end do
   end function side_ends

   !> Strip and interval that each element along a side of a block lies in
   pure function side_intervals(side, strips) result(intervals)
      !> The side
      type(side_type), intent(in) :: side
      !> The strips as they are divided
      type(strip_type), intent(in) :: strips(:)
      !> Indices, shape (2, elements)
      integer, allocatable :: intervals(:, :)

      integer :: k, i, n, m

      allocate (intervals(2, sum(n_intervals(strips(side%bands%strip)))))
      n = 0
      do k = 1, size(side%bands)
         associate (band => side%bands(k))
            m = n_intervals(strips(band%strip))
            do i = 1, m
               n = n + 1
               intervals(:, n) = [band%strip, merge(m + 1 - i, i, band%backwards)]
            end do
         end associate
      end do
   end function side_intervals

   !> Number of cells of all blocks if strips have so many intervals
   pure real(wp) function n_cells(grid, n)
      !> The blocks
      type(grid_type), intent(in) :: grid
      !> Intervals of each strip
      integer, intent(in) :: n(:)

      integer :: k

      n_cells = 0.0_wp
      do k = 1, size(grid%blocks)
         associate (sides => grid%blocks(k)%sides)
            n_cells = n_cells + real(sum(n(sides(1)%bands%strip)), wp) &
                      *sum(n(sides(2)%bands%strip))
         end associate
      end do
   end function n_cells

end module axijoint_model_strips
