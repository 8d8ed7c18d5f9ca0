!> Blocks of nodes of the fine mesh that are factored and solved some at once: those of one shape, and those that are the same
module axijoint_analysis_fine_block_groups
   use axijoint_analysis_fine_conditions, only : conditions_type
   use axijoint_assembly_product_stiffness, only : product_stiffness_type
   use axijoint_base_kinds, only : i8
   use axijoint_base_sort, only : refine_order
   use axijoint_linalg_band_cholesky, only : n_lanes
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: block_groups_type, new_blocks_in_order, group_blocks, n_nodes_of, factor_size, least_same

   !> Blocks of a kind from which on they have a factor together
   integer, parameter :: least_same = 4
   !> Places of the table in which kinds are looked up, for every block, and what brings them to different places
   integer, parameter :: places_of_block = 4
   integer(i8), parameter :: scatter = 1000003, modulus = 2147483647

   !> Blocks of nodes that follow each other
   type :: block_groups_type
      !> First node of each block, shape (blocks + 1), and how far apart neighbours in it are
      integer, allocatable :: first(:), width(:)
      !> Congruent elements that have nodes of a block, from first_element(block) on
      integer, allocatable :: first_element(:), element(:)
      !> Kind of each block: blocks of one have the same stiffness
      integer, allocatable :: kind(:)
      !> Blocks of one kind, `n_lanes` of them a group, the last of them again where there are fewer, groups of one kind one after the
      !> other; first group of each kind, and their end. Shapes (n_lanes, groups) and (kinds + 1)
      integer, allocatable :: same(:, :), first_same(:)
      !> The others of one shape, `n_lanes` of them a group, and the blocks that are left; groups and blocks in
      !> the order of their first nodes. Shapes (n_lanes, groups) and (left)
      integer, allocatable :: groups(:, :), left(:)
      !> Where the factors of each kind begin, then those of each group, then of each block that is left, and their end
      integer(i8), allocatable :: start(:)
   end type block_groups_type

contains

   !> Where blocks begin, how wide they are, and which have the same stiffness
   subroutine new_blocks_in_order(stiffness, graph, block, order, blocks)
      !> The stiffness, laid out
      type(product_stiffness_type), intent(in) :: stiffness
      !> Graph of the nodes of the blocks
      type(graph_type), intent(in) :: graph
      !> Block of each node
      integer, intent(in) :: block(:)
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)
      !> The blocks; how they are grouped is for `group_blocks`
      type(block_groups_type), intent(out) :: blocks

      integer :: k, l, b

      associate (begins => [.true., block(order(2:)) /= block(order(:size(order) - 1))])
         blocks%first = [pack([(k, k=1, size(order))], begins), size(order) + 1]
      end associate
      allocate (blocks%width(size(blocks%first) - 1), source=0)
      do b = 1, size(blocks%width)
         do k = blocks%first(b), blocks%first(b + 1) - 1
            do l = graph%start(order(k)), graph%start(order(k) + 1) - 1
               blocks%width(b) = max(blocks%width(b), k - stiffness%place(graph%neighbour(l)))
            end do
         end do
      end do
      call list_elements(stiffness, blocks)
      call find_kinds(stiffness, blocks)
   end subroutine new_blocks_in_order

   !> List the congruent elements of each block
   pure subroutine list_elements(stiffness, blocks)
      !> The stiffness, laid out
      type(product_stiffness_type), intent(in) :: stiffness
      !> The blocks; takes the lists
      type(block_groups_type), intent(inout) :: blocks

      integer :: block(size(stiffness%place)), next(size(blocks%width)), pass, b, i, k

      do b = 1, size(blocks%width)
         block(blocks%first(b):blocks%first(b + 1) - 1) = b
      end do
      next = 0
      do pass = 1, 2  ! count the elements, then list them
         do k = 1, size(stiffness%congruent%n_nodes)
            associate (touched => block(stiffness%congruent%row(:stiffness%congruent%n_nodes(k), k)))
               do i = 1, size(touched)
                  if (any(touched(:i - 1) == touched(i))) cycle
                  if (pass == 2) blocks%element(next(touched(i))) = k
                  next(touched(i)) = next(touched(i)) + 1
               end do
            end associate
         end do
         if (pass == 2) exit
         allocate (blocks%first_element(size(next) + 1), blocks%element(sum(next)))
         blocks%first_element(1) = 1
         do b = 1, size(next)
            blocks%first_element(b + 1) = blocks%first_element(b) + next(b)
         end do
         next = blocks%first_element(:size(next))
      end do
   end subroutine list_elements

   !> See which blocks have the same stiffness: nodes of congruent elements, and of nothing else, in the same places of both
   pure subroutine find_kinds(stiffness, blocks)
      !> The stiffness, laid out
      type(product_stiffness_type), intent(in) :: stiffness
      !> The blocks; takes their kinds
      type(block_groups_type), intent(inout) :: blocks

      integer, allocatable :: last(:)
      integer :: b, n, place
      logical :: known

      allocate (blocks%kind(size(blocks%width)), last(places_of_block*size(blocks%width)))
      last = 0
      n = 0
      do b = 1, size(blocks%kind)
         place = 1 + int(modulo(trace(stiffness, blocks, b), size(last, kind=i8)))
         known = last(place) > 0
         if (known) known = are_the_same(stiffness, blocks, b, last(place))
         if (known) then
            blocks%kind(b) = blocks%kind(last(place))
         else
            n = n + 1
            blocks%kind(b) = n
            last(place) = b
         end if
      end do
   end subroutine find_kinds

   !> Number that blocks of one kind share, and others do not as a rule
   pure integer(i8) function trace(stiffness, blocks, b)
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> The blocks, and one of them
      type(block_groups_type), intent(in) :: blocks
      integer, intent(in) :: b

      integer(i8) :: places
      integer :: i, k, place

      trace = n_nodes_of(blocks, b)
      do k = blocks%first_element(b), blocks%first_element(b + 1) - 1
         associate (element => blocks%element(k))
            places = stiffness%congruent%start(element)
            do i = 1, stiffness%congruent%n_nodes(element)
               place = stiffness%congruent%row(i, element) - blocks%first(b)
               if (place >= 0 .and. place < n_nodes_of(blocks, b)) places = 7*places + 9*place + i
            end do
            trace = modulo(scatter*trace + places, modulus)
         end associate
      end do
   end function trace

   !> Whether two blocks have the same stiffness
   pure logical function are_the_same(stiffness, blocks, a, b) result(same)
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> The blocks, and two of them
      type(block_groups_type), intent(in) :: blocks
      integer, intent(in) :: a, b

      integer :: i, k, shift, rows(2)

      associate (elements => stiffness%congruent, n => blocks%first_element(a + 1) - blocks%first_element(a))
         same = n_nodes_of(blocks, a) == n_nodes_of(blocks, b) .and. blocks%width(a) == blocks%width(b) &
            .and. n == blocks%first_element(b + 1) - blocks%first_element(b)
         if (same) same = .not. (has_rest(stiffness, blocks, a) .or. has_rest(stiffness, blocks, b))
         shift = blocks%first(b) - blocks%first(a)
         do k = 0, n - 1
            if (.not. same) return
            associate (one => blocks%element(blocks%first_element(a) + k), other => blocks%element(blocks%first_element(b) + k))
               same = elements%start(one) == elements%start(other)
               do i = 1, merge(elements%n_nodes(one), 0, same)
                  rows = [elements%row(i, one), elements%row(i, other) - shift]
                  where (rows < blocks%first(a) .or. rows >= blocks%first(a + 1)) rows = 0  ! of other blocks
                  same = same .and. rows(1) == rows(2)
               end do
            end associate
         end do
      end associate
   end function are_the_same

   !> Whether a block has stiffness of more than congruent elements
   pure logical function has_rest(stiffness, blocks, b)
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> The blocks, and one of them
      type(block_groups_type), intent(in) :: blocks
      integer, intent(in) :: b

      associate (start => stiffness%blocks%start(:, 2))
         has_rest = start(blocks%first(b + 1)) > start(blocks%first(b))
      end associate
   end function has_rest

   !> Put blocks that are the same, and others of one shape, into groups
   pure subroutine group_blocks(conditions, blocks)
      !> Conditions of all classes of modes
      type(conditions_type), intent(in) :: conditions(:)
      !> The blocks; takes the groups
      type(block_groups_type), intent(inout) :: blocks

      logical :: grouped(size(blocks%kind))
      integer(i8), allocatable :: sizes(:)
      integer :: k

      call group_the_same(conditions, blocks, grouped)
      call group_by_shape(blocks, grouped)
      associate (first_same => blocks%first_same(:size(blocks%first_same) - 1))
         sizes = [(factor_size(blocks, blocks%same(1, first_same(k))), k=1, size(first_same)), &
            (n_lanes*factor_size(blocks, blocks%groups(1, k)), k=1, size(blocks%groups, 2)), &
            (factor_size(blocks, blocks%left(k)), k=1, size(blocks%left))]
      end associate
      allocate (blocks%start(size(sizes) + 1))
      blocks%start(1) = 1
      do k = 1, size(sizes)
         blocks%start(k + 1) = blocks%start(k) + sizes(k)
      end do
   end subroutine group_blocks

   !> Put blocks that are the same, none of whose nodes is held or tied, into groups
   pure subroutine group_the_same(conditions, blocks, grouped)
      !> Conditions of all classes of modes
      type(conditions_type), intent(in) :: conditions(:)
      !> The blocks; takes the groups
      type(block_groups_type), intent(inout) :: blocks
      !> Which blocks are in one
      logical, intent(out) :: grouped(:)

      integer :: members(size(grouped))
      integer, allocatable :: order(:), same(:, :), first_same(:)
      integer :: b, k, l, n, last

      call find_free(conditions, blocks, grouped)
      members = 0
      do b = 1, size(grouped)
         if (grouped(b)) members(blocks%kind(b)) = members(blocks%kind(b)) + 1
      end do
      grouped = grouped .and. members(blocks%kind) >= least_same
      order = pack([(b, b=1, size(grouped))], grouped)
      call refine_order(order, blocks%kind)
      allocate (same(n_lanes, size(order)), first_same(size(order) + 1))
      n = 0
      l = 0
      last = 0
      do while (last < size(order))
         n = n + 1
         first_same(n) = l + 1
         k = last + 1
         last = last + members(blocks%kind(order(k)))
         do while (k <= last)
            l = l + 1
            same(:, l) = order([(min(k + b, last), b=0, n_lanes - 1)])
            k = k + n_lanes
         end do
      end do
      blocks%same = same(:, :l)
      blocks%first_same = [first_same(:n), l + 1]
   end subroutine group_the_same

   !> Find blocks none of whose nodes is held or tied
   pure subroutine find_free(conditions, blocks, free)
      !> Conditions of all classes of modes
      type(conditions_type), intent(in) :: conditions(:)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> Whether none is
      logical, intent(out) :: free(:)

      logical :: bound(blocks%first(size(blocks%first)) - 1)
      integer :: b, k

      bound = .false.
      do k = 1, size(conditions)
         bound(conditions(k)%bound) = .true.
      end do
      do b = 1, size(free)
         free(b) = .not. any(bound(blocks%first(b):blocks%first(b + 1) - 1))
      end do
   end subroutine find_free

   !> Put the other blocks of one shape into groups
   pure subroutine group_by_shape(blocks, grouped)
      !> The blocks; takes the groups
      type(block_groups_type), intent(inout) :: blocks
      !> Which blocks are in one
      logical, intent(inout) :: grouped(:)

      integer, allocatable :: by_shape(:), groups(:, :), order(:)
      integer :: b, k, n

      associate (width => blocks%width)
         n = size(width)
         by_shape = pack([(b, b=1, n)], .not. grouped)
         call refine_order(by_shape, blocks%first(2:) - blocks%first(:n))
         call refine_order(by_shape, width)
         allocate (groups(n_lanes, size(by_shape)/n_lanes))
         n = 0
         k = 1
         do while (k + n_lanes - 1 <= size(by_shape))
            associate (a => by_shape(k), z => by_shape(k + n_lanes - 1))
               if (width(a) == width(z) .and. n_nodes_of(blocks, a) == n_nodes_of(blocks, z)) then
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
         blocks%groups = groups(:, order)
         blocks%left = pack([(b, b=1, size(width))], .not. grouped)
      end associate
   end subroutine group_by_shape

   !> Numbers of the factor of a block
   pure integer(i8) function factor_size(blocks, b)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> The block
      integer, intent(in) :: b

      factor_size = 9_i8*(blocks%width(b) + 1)*n_nodes_of(blocks, b)
   end function factor_size

   !> Nodes of a block
   pure integer function n_nodes_of(blocks, b)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> The block
      integer, intent(in) :: b

      n_nodes_of = blocks%first(b + 1) - blocks%first(b)
   end function n_nodes_of

end module axijoint_analysis_fine_block_groups
