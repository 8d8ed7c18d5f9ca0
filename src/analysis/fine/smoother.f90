!> Factors of blocks of nodes of the fine mesh: what a cheap part of the error can be found with, while the
!> coarse mesh finds the rest
module axijoint_analysis_fine_smoother
   use axijoint_analysis_fine_block_groups, only : block_groups_type, n_nodes_of, factor_size
   use axijoint_analysis_fine_conditions, only : conditions_type
   use axijoint_assembly_block_parts, only : harmonic_factors, evaluate
   use axijoint_assembly_product_stiffness, only : product_stiffness_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_base_ranges, only : range_end
   use axijoint_linalg_band_cholesky, only : factor_band, solve_band, n_lanes, factor_bands, solve_bands, solve_with_one
   use axijoint_linalg_lapack, only : dpbtrf
   implicit none
   private
   public :: factor_blocks, solve_blocks

   !> Half-bandwidth from which on a block is worth a call of LAPACK: of a thin wall
   integer, parameter :: wide = 40

   !> Most shares that threads take, and groups of a share at least
   integer, parameter :: most_shares = 16, least_share = 64

contains

   !> Factor the blocks of a harmonic
   subroutine factor_blocks(blocks, stiffness, harmonic, conditions, factor, failed)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Components that are free
      type(conditions_type), intent(in) :: conditions
      !> The factors
      real(wp), allocatable, intent(inout) :: factor(:)
      !> Whether one of them is singular
      logical, intent(out) :: failed

      logical, allocatable :: plain(:)
      logical :: singular(most_shares)
      integer :: k, n

      associate (n => blocks%start(size(blocks%start)) - 1)
         if (.not. allocated(factor)) then
            allocate (factor(n))
            call use_large_pages(factor)
         end if
      end associate
      plain = all(conditions%free, 1) .and. .not. conditions%tied
      n = n_shares(blocks)
      singular = .false.
      do k = 1, n
         !$omp task default(shared) firstprivate(k) if (n > 1)
         call factor_share(blocks, stiffness, harmonic_factors(harmonic), conditions, plain, k, n, factor, singular(k))
         !$omp end task
      end do
      !$omp taskwait
      failed = any(singular)
   end subroutine factor_blocks

   !> Shares of the blocks that threads take which have nothing else to do
   pure integer function n_shares(blocks)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks

      n_shares = max(1, min(most_shares, (size(blocks%same, 2) + size(blocks%groups, 2) + size(blocks%left))/least_share))
   end function n_shares

   !> Factor one share of kinds, of groups and of blocks that are left
   subroutine factor_share(blocks, stiffness, factors, conditions, plain, share, n, factor, failed)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> Factors of its parts in the harmonic
      real(wp), intent(in) :: factors(3)
      !> Components that are free, and whether nodes are free in all
      type(conditions_type), intent(in) :: conditions
      logical, intent(in) :: plain(:)
      !> The share, and how many there are
      integer, intent(in) :: share, n
      !> The factors
      real(wp), intent(inout) :: factor(*)
      !> Whether one of them is singular
      logical, intent(inout) :: failed

      logical :: singular
      integer :: k, l

      associate (n_kinds => size(blocks%first_same) - 1, n_groups => size(blocks%groups, 2), n_left => size(blocks%left))
         do k = 1 + range_end(n_kinds, share - 1, n), range_end(n_kinds, share, n)
            call factor_one(blocks%same(1, blocks%first_same(k)), factor(blocks%start(k)))
         end do
         do k = 1 + range_end(n_groups, share - 1, n), range_end(n_groups, share, n)
            associate (start => blocks%start(n_kinds + k), group => blocks%groups(:, k))
               associate (nodes => n_nodes_of(blocks, group(1)), width => 3*blocks%width(group(1)) + 2)
                  factor(start:blocks%start(n_kinds + k + 1) - 1) = 0.0_wp
                  do l = 1, n_lanes
                     call fill_block(blocks, stiffness, factors, conditions, plain, group(l), nodes, width, n_lanes, l, &
                        factor(start))
                  end do
                  call factor_bands(3*nodes, width, factor(start), singular)
               end associate
            end associate
            failed = failed .or. singular
         end do
         do k = 1 + range_end(n_left, share - 1, n), range_end(n_left, share, n)
            call factor_one(blocks%left(k), factor(blocks%start(n_kinds + n_groups + k)))
         end do
      end associate

   contains

      !> Factor a block by itself
      subroutine factor_one(b, factor)
         !> The block
         integer, intent(in) :: b
         !> Its factor
         real(wp), intent(inout) :: factor(*)

         integer :: info

         associate (nodes => n_nodes_of(blocks, b), width => 3*blocks%width(b) + 2)
            factor(:factor_size(blocks, b)) = 0.0_wp
            call fill_block(blocks, stiffness, factors, conditions, plain, b, nodes, width, 1, 1, factor)
            if (width >= wide) then
               call dpbtrf('L', 3*nodes, width, factor, width + 1, info)
            else
               call factor_band(3*nodes, width, factor, info)
            end if
         end associate
         failed = failed .or. info > 0
      end subroutine factor_one

   end subroutine factor_share

   !> Add a block to a band matrix of zeros; what is held has an equation of its own
   subroutine fill_block(blocks, stiffness, factors, conditions, plain, b, n, width, lanes, lane, a)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> Factors of its parts in the harmonic
      real(wp), intent(in) :: factors(3)
      !> Components that are free, and whether nodes are free in all
      type(conditions_type), intent(in) :: conditions
      logical, intent(in) :: plain(:)
      !> The block, its nodes, half-bandwidth
      integer, intent(in) :: b, n, width
      !> Matrices that lie number beside number, and which of them is filled
      integer, intent(in) :: lanes, lane
      !> Lower triangles
      real(wp), intent(inout) :: a(lanes, 0:width, 3*n)

      real(wp) :: block(3, 3)
      integer(i8) :: l, p
      integer :: i, j, k, first, last

      first = blocks%first(b)
      last = first + n - 1
      associate (rest => stiffness%blocks)
         do i = first, last
            do l = rest%start(i, 2), rest%start(i + 1, 2) - 1
               call evaluate(factors, rest%parts(:, l), block)
               call add(i, rest%column(l))
            end do
         end do
      end associate
      associate (congruent => stiffness%congruent)
         do k = blocks%first_element(b), blocks%first_element(b + 1) - 1
            associate (rows => congruent%row(:congruent%n_nodes(blocks%element(k)), blocks%element(k)))
               p = congruent%start(blocks%element(k)) - 1
               do j = 1, size(rows)
                  if (rows(j) >= first .and. rows(j) <= last) then
                     do i = j, size(rows)
                        if (rows(i) < first .or. rows(i) > last) cycle
                        call evaluate(factors, congruent%parts(:, p + i - j + 1), block)
                        if (rows(i) < rows(j)) block = transpose(block)
                        call add(max(rows(i), rows(j)), min(rows(i), rows(j)))
                     end do
                  end if
                  p = p + size(rows) - j + 1
               end do
            end associate
         end do
      end associate
      do i = first, last
         do k = 1, 3
            if (.not. conditions%free(k, i)) a(lane, 0, 3*(i - first) + k) = 1.0_wp
         end do
      end do

   contains

      !> Add what two nodes have of each other
      subroutine add(i, j)
         !> Row and column
         integer, intent(in) :: i, j

         integer :: row, column

         if (plain(i) .and. plain(j) .and. i /= j) then
            do column = 1, 3
               do row = 1, 3
                  associate (entry => a(lane, 3*(i - j) + row - column, 3*(j - first) + column))
                     entry = entry + block(column, row)
                  end associate
               end do
            end do
            return
         end if
         if (conditions%tied(j)) block(1, :) = block(1, :) - block(3, :)
         if (conditions%tied(i)) block(:, 1) = block(:, 1) - block(:, 3)
         do row = 1, 3
            do column = 1, merge(row, 3, i == j)
               if (.not. (conditions%free(row, i) .and. conditions%free(column, j))) cycle
               associate (entry => a(lane, 3*(i - j) + row - column, 3*(j - first) + column))
                  entry = entry + block(column, row)
               end associate
            end do
         end do
      end subroutine add

   end subroutine fill_block

   !> Solve for every block
   subroutine solve_blocks(blocks, factor, x)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> Their factors
      real(wp), intent(in) :: factor(*)
      !> Forces, then displacements, shape (3, nodes)
      real(wp), intent(inout) :: x(3, *)

      integer :: k, n

      n = n_shares(blocks)
      do k = 1, n
         !$omp task default(shared) firstprivate(k) if (n > 1)
         call solve_share(blocks, factor, k, n, x)
         !$omp end task
      end do
      !$omp taskwait
   end subroutine solve_blocks

   !> Solve for one share of kinds, of groups and of blocks that are left
   subroutine solve_share(blocks, factor, share, n, x)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> Their factors
      real(wp), intent(in) :: factor(*)
      !> The share, and how many there are
      integer, intent(in) :: share, n
      !> Forces, then displacements, shape (3, nodes)
      real(wp), intent(inout) :: x(3, *)

      real(wp), allocatable :: side(:, :)
      integer :: g, k, l

      allocate (side(n_lanes, 3*longest_group(blocks)))
      associate (n_kinds => size(blocks%first_same) - 1, n_groups => size(blocks%groups, 2), n_left => size(blocks%left))
         do k = 1 + range_end(n_kinds, share - 1, n), range_end(n_kinds, share, n)
            do g = blocks%first_same(k), blocks%first_same(k + 1) - 1
               call take_lanes(blocks%same(:, g))
               associate (one => blocks%same(1, g))
                  call solve_with_one(3*n_nodes_of(blocks, one), 3*blocks%width(one) + 2, factor(blocks%start(k)), side)
               end associate
               call give_lanes(blocks%same(:, g))
            end do
         end do
         do g = 1 + range_end(n_groups, share - 1, n), range_end(n_groups, share, n)
            call take_lanes(blocks%groups(:, g))
            associate (one => blocks%groups(1, g))
               call solve_bands(3*n_nodes_of(blocks, one), 3*blocks%width(one) + 2, factor(blocks%start(n_kinds + g)), side)
            end associate
            call give_lanes(blocks%groups(:, g))
         end do
         do k = 1 + range_end(n_left, share - 1, n), range_end(n_left, share, n)
            associate (b => blocks%left(k))
               call solve_band(3*n_nodes_of(blocks, b), 3*blocks%width(b) + 2, factor(blocks%start(n_kinds + n_groups + k)), &
                  x(1, blocks%first(b)))
            end associate
         end do
      end associate

   contains

      !> Put forces of some blocks beside each other
      subroutine take_lanes(group)
         !> The blocks
         integer, intent(in) :: group(n_lanes)

         do l = 1, n_lanes
            call take_lane(n_nodes_of(blocks, group(1)), x(1, blocks%first(group(l))), l, side)
         end do
      end subroutine take_lanes

      !> Take displacements of some blocks
      subroutine give_lanes(group)
         !> The blocks
         integer, intent(in) :: group(n_lanes)

         do l = 1, n_lanes
            call give_lane(n_nodes_of(blocks, group(1)), side, l, x(1, blocks%first(group(l))))
         end do
      end subroutine give_lanes

   end subroutine solve_share

   !> Nodes of the longest blocks that are in a group
   pure integer function longest_group(blocks)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks

      integer :: g

      longest_group = maxval([0, (n_nodes_of(blocks, blocks%groups(1, g)), g=1, size(blocks%groups, 2)), &
         (n_nodes_of(blocks, blocks%same(1, g)), g=1, size(blocks%same, 2))])
   end function longest_group

   !> Put forces of one block beside those of others
   pure subroutine take_lane(n, x, lane, side)
      !> Nodes
      integer, intent(in) :: n
      !> The forces
      real(wp), intent(in) :: x(3*n)
      !> Which of the blocks
      integer, intent(in) :: lane
      !> Takes the forces
      real(wp), intent(inout) :: side(n_lanes, 3*n)

      side(lane, :) = x
   end subroutine take_lane

   !> Take displacements of one block from those of others
   pure subroutine give_lane(n, side, lane, x)
      !> Nodes
      integer, intent(in) :: n
      !> Displacements of all
      real(wp), intent(in) :: side(n_lanes, 3*n)
      !> Which of the blocks
      integer, intent(in) :: lane
      !> Takes its displacements
      real(wp), intent(inout) :: x(3*n)

      x = side(lane, :)
   end subroutine give_lane

end module axijoint_analysis_fine_smoother
