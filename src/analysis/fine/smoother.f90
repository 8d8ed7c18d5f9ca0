!> Factors of blocks of nodes of the fine mesh: what a cheap part of the error can be found with, while the
!> coarse mesh finds the rest
module axijoint_analysis_fine_smoother
   use axijoint_analysis_fine_block_groups, only : block_groups_type, n_nodes_of
   use axijoint_analysis_fine_conditions, only : conditions_type
   use axijoint_assembly_block_parts, only : harmonic_factors
   use axijoint_assembly_envelope_fill, only : fill_envelope, all_free, tied_state
   use axijoint_assembly_product_stiffness, only : product_stiffness_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_base_ranges, only : range_end
   use axijoint_linalg_node_envelope, only : n_lanes, factor_envelope, factor_envelopes, solve_envelope, &
      solve_envelopes, solve_with_one
   implicit none
   private
   public :: factor_blocks, solve_blocks

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

      integer, allocatable :: state(:)
      logical :: singular(most_shares)
      integer :: k, n

      associate (n => blocks%start(size(blocks%start)) - 1)
         if (.not. allocated(factor)) then
            allocate (factor(n))
            call use_large_pages(factor)
         end if
      end associate
      allocate (state(size(conditions%tied)), source=all_free)
      do k = 1, size(conditions%held)
         associate (node => conditions%held(k))
            state(node) = sum([1, 2, 4], conditions%free(:, node)) + merge(tied_state, 0, conditions%tied(node))
         end associate
      end do
      n = n_shares(blocks)
      singular = .false.
      do k = 1, n
         !$omp task default(shared) firstprivate(k) if (n > 1)
         call factor_share(blocks, stiffness, harmonic_factors(harmonic), state, k, n, factor, singular(k))
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
   subroutine factor_share(blocks, stiffness, factors, state, share, n, factor, failed)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> Factors of its parts in the harmonic
      real(wp), intent(in) :: factors(3)
      !> What is said of each node
      integer, intent(in) :: state(:)
      !> The share, and how many there are
      integer, intent(in) :: share, n
      !> The factors
      real(wp), intent(inout) :: factor(*)
      !> Whether one of them is singular
      logical, intent(inout) :: failed

      integer :: u

      associate (n_kinds => size(blocks%first_same) - 1, n_groups => size(blocks%groups, 2), n_left => size(blocks%left))
         do u = 1 + range_end(n_kinds, share - 1, n), range_end(n_kinds, share, n)
            call factor_some(u, [blocks%same(1, blocks%first_same(u))])
         end do
         do u = n_kinds + 1 + range_end(n_groups, share - 1, n), n_kinds + range_end(n_groups, share, n)
            call factor_some(u, blocks%groups(:, u - n_kinds))
         end do
         do u = n_kinds + n_groups + 1 + range_end(n_left, share - 1, n), n_kinds + n_groups + range_end(n_left, share, n)
            call factor_some(u, [blocks%left(u - n_kinds - n_groups)])
         end do
      end associate

   contains

      !> Factor one block, or some at once
      subroutine factor_some(u, some)
         !> Place of their envelope, and they
         integer, intent(in) :: u, some(:)

         logical :: singular
         integer :: l

         associate (below => blocks%below(blocks%envelope(u):blocks%envelope(u + 1) - 1), start => blocks%start(u))
            factor(start:blocks%start(u + 1) - 1) = 0.0_wp
            do l = 1, size(some)
               associate (b => some(l))
                  call fill_envelope(stiffness, factors, state, blocks%first(b), blocks%first(b + 1) - 1, &
                     blocks%element(blocks%first_element(b):blocks%first_element(b + 1) - 1), below, size(some), l, factor(start))
               end associate
            end do
            if (size(some) == 1) then
               call factor_envelope(size(below), below, factor(start), singular)
            else
               call factor_envelopes(size(below), below, factor(start), singular)
            end if
         end associate
         failed = failed .or. singular
      end subroutine factor_some

   end subroutine factor_share

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
      integer :: g, u

      allocate (side(n_lanes, 3*longest_group(blocks)))
      associate (n_kinds => size(blocks%first_same) - 1, n_groups => size(blocks%groups, 2), n_left => size(blocks%left))
         do u = 1 + range_end(n_kinds, share - 1, n), range_end(n_kinds, share, n)
            associate (below => blocks%below(blocks%envelope(u):blocks%envelope(u + 1) - 1))
               do g = blocks%first_same(u), blocks%first_same(u + 1) - 1
                  call take_lanes(blocks%same(:, g), size(below))
                  call solve_with_one(size(below), below, factor(blocks%start(u)), side)
                  call give_lanes(blocks%same(:, g))
               end do
            end associate
         end do
         do u = n_kinds + 1 + range_end(n_groups, share - 1, n), n_kinds + range_end(n_groups, share, n)
            associate (below => blocks%below(blocks%envelope(u):blocks%envelope(u + 1) - 1), group => blocks%groups(:, u - n_kinds))
               call take_lanes(group, size(below))
               call solve_envelopes(size(below), below, factor(blocks%start(u)), side)
               call give_lanes(group)
            end associate
         end do
         do u = n_kinds + n_groups + 1 + range_end(n_left, share - 1, n), n_kinds + n_groups + range_end(n_left, share, n)
            associate (below => blocks%below(blocks%envelope(u):blocks%envelope(u + 1) - 1))
               call solve_envelope(size(below), below, factor(blocks%start(u)), &
                  x(1, blocks%first(blocks%left(u - n_kinds - n_groups))))
            end associate
         end do
      end associate

   contains

      !> Put forces of some blocks beside each other; none on nodes that others have more
      subroutine take_lanes(group, longest)
         !> The blocks, and nodes of the longest
         integer, intent(in) :: group(n_lanes), longest

         integer :: l, n

         do l = 1, n_lanes
            n = n_nodes_of(blocks, group(l))
            call take_lane(n, x(1, blocks%first(group(l))), l, side)
            side(l, 3*n + 1:3*longest) = 0.0_wp
         end do
      end subroutine take_lanes

      !> Take displacements of some blocks
      subroutine give_lanes(group)
         !> The blocks
         integer, intent(in) :: group(n_lanes)

         integer :: l

         do l = 1, n_lanes
            call give_lane(n_nodes_of(blocks, group(l)), side, l, x(1, blocks%first(group(l))))
         end do
      end subroutine give_lanes

   end subroutine solve_share

   !> Nodes of the longest blocks that are in a group
   pure integer function longest_group(blocks)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks

      integer :: u

      associate (n => size(blocks%first_same) - 1 + size(blocks%groups, 2))
         longest_group = maxval([0, (blocks%envelope(u + 1) - blocks%envelope(u), u=1, n)])
      end associate
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
