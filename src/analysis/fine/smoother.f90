!> Factors of blocks of nodes of the fine mesh: what a cheap part of the error can be found with, while the
!> coarse mesh finds the rest
module axijoint_analysis_fine_smoother
   use axijoint_analysis_fine_conditions, only : conditions_type
   use axijoint_assembly_block_parts, only : harmonic_factors, evaluate
   use axijoint_assembly_product_stiffness, only : product_stiffness_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_base_ranges, only : range_end
   use axijoint_base_sort, only : refine_order
   use axijoint_linalg_band_cholesky, only : factor_band, solve_band, n_lanes, factor_bands, solve_bands
   use axijoint_linalg_lapack, only : dpbtrf
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: smoother_type, new_smoother, factor_blocks, solve_blocks

   !> Half-bandwidth from which on a block is worth a call of LAPACK: of a thin wall
   integer, parameter :: wide = 40

   !> Most shares that threads take, and groups of a share at least
   integer, parameter :: most_shares = 16, least_share = 64

   !> Blocks of nodes that follow each other. Blocks of one shape are factored and solved some at once
   type :: smoother_type
      !> First node of each block, shape (blocks + 1), and how far apart neighbours in it are
      integer, allocatable :: first(:), width(:)
      !> Blocks of one shape, `n_lanes` of them a group, and the blocks that are left; groups and blocks in
      !> the order of their first nodes. Shapes (n_lanes, groups) and (left)
      integer, allocatable :: groups(:, :), left(:)
      !> Where the factors of each group begin, then those of each block that is left, and their end
      integer(i8), allocatable :: start(:)
      !> Congruent elements that have nodes of a block, from first_element(block) on
      integer, allocatable :: first_element(:), element(:)
   end type smoother_type

contains

   !> Where blocks begin, and how wide they are
   subroutine new_smoother(smoother, stiffness, graph, block, order)
      !> The blocks
      type(smoother_type), intent(out) :: smoother
      !> The stiffness, laid out
      type(product_stiffness_type), intent(in) :: stiffness
      !> Graph of the nodes of the blocks
      type(graph_type), intent(in) :: graph
      !> Block of each node
      integer, intent(in) :: block(:)
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)

      integer :: k, l, b

      associate (begins => [.true., block(order(2:)) /= block(order(:size(order) - 1))])
         smoother%first = [pack([(k, k=1, size(order))], begins), size(order) + 1]
      end associate
      allocate (smoother%width(size(smoother%first) - 1), source=0)
      do b = 1, size(smoother%width)
         do k = smoother%first(b), smoother%first(b + 1) - 1
            do l = graph%start(order(k)), graph%start(order(k) + 1) - 1
               smoother%width(b) = max(smoother%width(b), k - stiffness%place(graph%neighbour(l)))
            end do
         end do
      end do
      call group_blocks(smoother)
      call list_elements(stiffness, smoother)
      associate (n => size(smoother%groups, 2), m => size(smoother%left))
         allocate (smoother%start(n + m + 1))
         smoother%start(1) = 1
         do k = 1, n
            smoother%start(k + 1) = smoother%start(k) + n_lanes*factor_size(smoother, smoother%groups(1, k))
         end do
         do k = 1, m
            smoother%start(n + k + 1) = smoother%start(n + k) + factor_size(smoother, smoother%left(k))
         end do
      end associate
   end subroutine new_smoother

   !> List the congruent elements of each block
   pure subroutine list_elements(stiffness, smoother)
      !> The stiffness, laid out
      type(product_stiffness_type), intent(in) :: stiffness
      !> The blocks; takes the lists
      type(smoother_type), intent(inout) :: smoother

      integer :: block(size(stiffness%place)), next(size(smoother%width)), pass, b, i, k

      do b = 1, size(smoother%width)
         block(smoother%first(b):smoother%first(b + 1) - 1) = b
      end do
      next = 0
      do pass = 1, 2  ! count the elements, then list them
         do k = 1, size(stiffness%congruent%n_nodes)
            associate (blocks => block(stiffness%congruent%row(:stiffness%congruent%n_nodes(k), k)))
               do i = 1, size(blocks)
                  if (any(blocks(:i - 1) == blocks(i))) cycle
                  if (pass == 2) smoother%element(next(blocks(i))) = k
                  next(blocks(i)) = next(blocks(i)) + 1
               end do
            end associate
         end do
         if (pass == 2) exit
         allocate (smoother%first_element(size(next) + 1), smoother%element(sum(next)))
         smoother%first_element(1) = 1
         do b = 1, size(next)
            smoother%first_element(b + 1) = smoother%first_element(b) + next(b)
         end do
         next = smoother%first_element(:size(next))
      end do
   end subroutine list_elements

   !> Numbers of the factor of a block
   pure integer(i8) function factor_size(smoother, b)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
      !> The block
      integer, intent(in) :: b

      factor_size = 9_i8*(smoother%width(b) + 1)*n_nodes_of(smoother, b)
   end function factor_size

   !> Nodes of a block
   pure integer function n_nodes_of(smoother, b)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
      !> The block
      integer, intent(in) :: b

      n_nodes_of = smoother%first(b + 1) - smoother%first(b)
   end function n_nodes_of

   !> Put blocks of one shape into groups
   pure subroutine group_blocks(smoother)
      !> The blocks; takes the groups
      type(smoother_type), intent(inout) :: smoother

      integer, allocatable :: by_shape(:), groups(:, :), order(:)
      logical, allocatable :: grouped(:)
      integer :: b, k, n

      associate (width => smoother%width)
         n = size(width)
         by_shape = [(b, b=1, n)]
         call refine_order(by_shape, smoother%first(2:) - smoother%first(:n))
         call refine_order(by_shape, width)
         allocate (groups(n_lanes, n/n_lanes), grouped(n))
         grouped = .false.
         n = 0
         k = 1
         do while (k + n_lanes - 1 <= size(width))
            associate (a => by_shape(k), z => by_shape(k + n_lanes - 1))
               if (width(a) == width(z) .and. n_nodes_of(smoother, a) == n_nodes_of(smoother, z)) then
                  n = n + 1
                  groups(:, n) = by_shape(k:k + n_lanes - 1)
                  grouped(groups(:, n)) = .true.
                  k = k + n_lanes
               else
                  k = k + 1
               end if
            end associate
         end do
         order = [(k, k=1, n)]
         call refine_order(order, groups(1, :n))
         smoother%groups = groups(:, order)
         smoother%left = pack([(b, b=1, size(width))], .not. grouped)
      end associate
   end subroutine group_blocks

   !> Factor the blocks of a harmonic
   subroutine factor_blocks(smoother, stiffness, harmonic, conditions, factor, failed)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
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

      associate (n => smoother%start(size(smoother%start)) - 1)
         if (.not. allocated(factor)) then
            allocate (factor(n))
            call use_large_pages(factor)
         end if
      end associate
      plain = all(conditions%free, 1) .and. .not. conditions%tied
      n = n_shares(smoother)
      singular = .false.
      do k = 1, n
         !$omp task default(shared) firstprivate(k) if (n > 1)
         call factor_share(smoother, stiffness, harmonic_factors(harmonic), conditions, plain, k, n, factor, singular(k))
         !$omp end task
      end do
      !$omp taskwait
      failed = any(singular)
   end subroutine factor_blocks

   !> Shares of the blocks that threads take which have nothing else to do
   pure integer function n_shares(smoother)
      !> The blocks
      type(smoother_type), intent(in) :: smoother

      n_shares = max(1, min(most_shares, (size(smoother%groups, 2) + size(smoother%left))/least_share))
   end function n_shares

   !> Factor one share of groups and of blocks that are left
   subroutine factor_share(smoother, stiffness, factors, conditions, plain, share, n, factor, failed)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
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
      integer :: g, k, info

      do g = 1 + range_end(size(smoother%groups, 2), share - 1, n), range_end(size(smoother%groups, 2), share, n)
         associate (start => smoother%start(g), one => smoother%groups(1, g))
            associate (nodes => n_nodes_of(smoother, one), width => 3*smoother%width(one) + 2)
               factor(start:smoother%start(g + 1) - 1) = 0.0_wp
               do k = 1, n_lanes
                  call fill_block(smoother, stiffness, factors, conditions, plain, smoother%groups(k, g), nodes, width, &
                     n_lanes, k, factor(start))
               end do
               call factor_bands(3*nodes, width, factor(start), singular)
            end associate
         end associate
         failed = failed .or. singular
      end do
      do k = 1 + range_end(size(smoother%left), share - 1, n), range_end(size(smoother%left), share, n)
         associate (start => smoother%start(size(smoother%groups, 2) + k), b => smoother%left(k))
            associate (nodes => n_nodes_of(smoother, b), width => 3*smoother%width(b) + 2)
               factor(start:start + factor_size(smoother, b) - 1) = 0.0_wp
               call fill_block(smoother, stiffness, factors, conditions, plain, b, nodes, width, 1, 1, factor(start))
               if (width >= wide) then
                  call dpbtrf('L', 3*nodes, width, factor(start), width + 1, info)
               else
                  call factor_band(3*nodes, width, factor(start), info)
               end if
            end associate
         end associate
         failed = failed .or. info > 0
      end do
   end subroutine factor_share

   !> Add a block to a band matrix of zeros; what is held has an equation of its own
   subroutine fill_block(smoother, stiffness, factors, conditions, plain, b, n, width, lanes, lane, a)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
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

      first = smoother%first(b)
      last = first + n - 1
      associate (blocks => stiffness%blocks)
         do i = first, last
            do l = blocks%start(i, 2), blocks%start(i + 1, 2) - 1
               call evaluate(factors, blocks%parts(:, l), block)
               call add(i, blocks%column(l))
            end do
         end do
      end associate
      associate (congruent => stiffness%congruent)
         do k = smoother%first_element(b), smoother%first_element(b + 1) - 1
            associate (rows => congruent%row(:congruent%n_nodes(smoother%element(k)), smoother%element(k)))
               p = congruent%start(smoother%element(k)) - 1
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
   subroutine solve_blocks(smoother, factor, x)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
      !> Their factors
      real(wp), intent(in) :: factor(*)
      !> Forces, then displacements, shape (3, nodes)
      real(wp), intent(inout) :: x(3, *)

      integer :: k, n

      n = n_shares(smoother)
      do k = 1, n
         !$omp task default(shared) firstprivate(k) if (n > 1)
         call solve_share(smoother, factor, k, n, x)
         !$omp end task
      end do
      !$omp taskwait
   end subroutine solve_blocks

   !> Solve for one share of groups and of blocks that are left
   subroutine solve_share(smoother, factor, share, n, x)
      !> The blocks
      type(smoother_type), intent(in) :: smoother
      !> Their factors
      real(wp), intent(in) :: factor(*)
      !> The share, and how many there are
      integer, intent(in) :: share, n
      !> Forces, then displacements, shape (3, nodes)
      real(wp), intent(inout) :: x(3, *)

      real(wp), allocatable :: side(:, :)
      integer :: g, k

      allocate (side(n_lanes, 3*longest_group(smoother)))
      do g = 1 + range_end(size(smoother%groups, 2), share - 1, n), range_end(size(smoother%groups, 2), share, n)
         associate (blocks => smoother%groups(:, g))
            associate (nodes => n_nodes_of(smoother, blocks(1)))
               do k = 1, n_lanes
                  call take_lane(nodes, x(1, smoother%first(blocks(k))), k, side)
               end do
               call solve_bands(3*nodes, 3*smoother%width(blocks(1)) + 2, factor(smoother%start(g)), side)
               do k = 1, n_lanes
                  call give_lane(nodes, side, k, x(1, smoother%first(blocks(k))))
               end do
            end associate
         end associate
      end do
      do k = 1 + range_end(size(smoother%left), share - 1, n), range_end(size(smoother%left), share, n)
         associate (b => smoother%left(k))
            call solve_band(3*n_nodes_of(smoother, b), 3*smoother%width(b) + 2, &
               factor(smoother%start(size(smoother%groups, 2) + k)), x(1, smoother%first(b)))
         end associate
      end do
   end subroutine solve_share

   !> Nodes of the longest blocks that are in a group
   pure integer function longest_group(smoother)
      !> The blocks
      type(smoother_type), intent(in) :: smoother

      integer :: g

      longest_group = maxval([0, (n_nodes_of(smoother, smoother%groups(1, g)), g=1, size(smoother%groups, 2))])
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
