!> Blocks of nodes of the fine mesh that are factored and solved some at once: those of one shape, and those that are the same
module axijoint_analysis_fine_block_groups
   use axijoint_analysis_fine_conditions, only : conditions_type
   use axijoint_assembly_product_stiffness, only : product_stiffness_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_sort, only : ascending_order, refine_order
   use axijoint_linalg_node_envelope, only : n_lanes, panel_size
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: block_groups_type, new_blocks_in_order, group_blocks, n_nodes_of, least_same

   !> Blocks of a kind from which on they have a factor together
   integer, parameter :: least_same = 4
   !> Numbers of factors in a group of blocks of alike shape, over those of the blocks, at most: eight at once take from half the time
   !> of eight one by one (small blocks) to as much
   real(wp), parameter :: most_padding = 1.2_wp
   !> Places of the table in which kinds are looked up, for every block, and what brings them to different places
   integer, parameter :: places_of_block = 4
   integer(i8), parameter :: scatter = 1000003, modulus = 2147483647

   !> Blocks of nodes that follow each other
   type :: block_groups_type
      !> First node of each block, shape (blocks + 1), and the last node of the block that the columns of each node reach in its
      !> factor: no column ends before one in front of it. Shape (nodes)
      integer, allocatable :: first(:), reach(:)
      !> Congruent elements that have nodes of a block, from first_element(block) on
      integer, allocatable :: first_element(:), element(:)
      !> Kind of each block: blocks of one have the same stiffness
      integer, allocatable :: kind(:)
      !> Blocks of one kind, `n_lanes` of them a group, the last of them again where there are fewer, groups of one kind one after the
      !> other; first group of each kind, and their end. Shapes (n_lanes, groups) and (kinds + 1)
      integer, allocatable :: same(:, :), first_same(:)
      !> The others of alike shapes, `n_lanes` of them a group, and the blocks that are left; groups and blocks in
      !> the order of their first nodes. Shapes (n_lanes, groups) and (left)
      integer, allocatable :: groups(:, :), left(:)
      !> Envelopes of the factors of each kind, then of each group, then of each block that is left: how many nodes behind each
      !> its columns reach; where each begins, and their end
      integer, allocatable :: below(:), envelope(:)
      !> Where the factors of these begin, and their end
      integer(i8), allocatable :: start(:)
   end type block_groups_type

contains

   !> Where blocks begin, how far their columns reach, and which have the same stiffness
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

      integer :: k, l, b, last

      associate (begins => [.true., block(order(2:)) /= block(order(:size(order) - 1))])
         blocks%first = [pack([(k, k=1, size(order))], begins), size(order) + 1]
      end associate
      allocate (blocks%reach(size(order)))
      do b = 1, size(blocks%first) - 1
         last = 0
         do k = blocks%first(b), blocks%first(b + 1) - 1
            last = max(last, k)
            do l = graph%start(order(k)), graph%start(order(k) + 1) - 1
               last = max(last, stiffness%place(graph%neighbour(l)))
            end do
            blocks%reach(k) = last
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

      integer :: block(size(stiffness%place)), next(size(blocks%first) - 1), pass, b, i, k

      do b = 1, size(next)
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

      allocate (blocks%kind(size(blocks%first) - 1), last(places_of_block*(size(blocks%first) - 1)))
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
         same = n_nodes_of(blocks, a) == n_nodes_of(blocks, b) &
            .and. n == blocks%first_element(b + 1) - blocks%first_element(b)
         if (same) same = .not. (has_rest(stiffness, blocks, a) .or. has_rest(stiffness, blocks, b))
         shift = blocks%first(b) - blocks%first(a)
         if (same) same = all(blocks%reach(blocks%first(b):blocks%first(b + 1) - 1) &
            == blocks%reach(blocks%first(a):blocks%first(a + 1) - 1) + shift)
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

   !> Put blocks that are the same, and others of alike shapes, into groups, and see what room their factors take
   pure subroutine group_blocks(conditions, blocks)
      !> Conditions of all classes of modes
      type(conditions_type), intent(in) :: conditions(:)
      !> The blocks; takes the groups
      type(block_groups_type), intent(inout) :: blocks

      logical :: grouped(size(blocks%kind))
      integer, allocatable :: some(:)
      integer :: n_kinds, n_groups, n, u

      call group_the_same(conditions, blocks, grouped)
      call group_alike(blocks, grouped)
      n_kinds = size(blocks%first_same) - 1
      n_groups = size(blocks%groups, 2)
      n = n_kinds + n_groups + size(blocks%left)
      if (allocated(blocks%start)) deallocate (blocks%below, blocks%envelope, blocks%start)
      allocate (blocks%envelope(n + 1), blocks%start(n + 1))
      allocate (blocks%below(size(blocks%reach)))  ! envelopes of groups are no longer than their blocks together
      blocks%envelope(1) = 1
      blocks%start(1) = 1
      do u = 1, n
         if (u <= n_kinds) then
            some = blocks%same(:1, blocks%first_same(u))
         else if (u <= n_kinds + n_groups) then
            some = blocks%groups(:, u - n_kinds)
         else
            some = blocks%left(u - n_kinds - n_groups:u - n_kinds - n_groups)
         end if
         associate (below => envelope_of(blocks, some))
            blocks%envelope(u + 1) = blocks%envelope(u) + size(below)
            blocks%below(blocks%envelope(u):blocks%envelope(u + 1) - 1) = below
            blocks%start(u + 1) = blocks%start(u) + size(some)*sum(panel_size(below))
         end associate
      end do
      blocks%below = blocks%below(:blocks%envelope(n + 1) - 1)
   end subroutine group_blocks

   !> Envelope that holds those of some blocks: how many nodes behind each its columns reach
   pure function envelope_of(blocks, some) result(below)
      !> The blocks, and some of them
      type(block_groups_type), intent(in) :: blocks
      integer, intent(in) :: some(:)
      !> Shape (nodes of the longest)
      integer, allocatable :: below(:)

      integer :: k, l, last

      allocate (below(maxval(n_nodes_of(blocks, some))))
      last = 0
      do k = 1, size(below)
         last = max(last, k)
         do l = 1, size(some)
            associate (first => blocks%first(some(l)))
               if (k <= n_nodes_of(blocks, some(l))) last = max(last, blocks%reach(first + k - 1) - first + 1)
            end associate
         end do
         below(k) = last - k
      end do
   end function envelope_of

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

   !> Put the other blocks into groups of alike shapes, whose factors together are not much larger than theirs one by one
   pure subroutine group_alike(blocks, grouped)
      !> The blocks; takes the groups
      type(block_groups_type), intent(inout) :: blocks
      !> Which blocks are in one
      logical, intent(inout) :: grouped(:)

      integer, allocatable :: by_shape(:), groups(:, :), order(:)
      integer(i8) :: own(size(grouped))
      integer :: b, k, n

      by_shape = pack([(b, b=1, size(grouped))], .not. grouped)
      own = 0
      do k = 1, size(by_shape)
         own(by_shape(k)) = size_of(by_shape(k:k))
      end do
      by_shape = by_shape(ascending_order(real(own(by_shape), wp)))
      call refine_order(by_shape, blocks%first(2:) - blocks%first(:size(grouped)))
      allocate (groups(n_lanes, size(by_shape)/n_lanes))
      n = 0
      k = 1
      do while (k + n_lanes - 1 <= size(by_shape))
         associate (some => by_shape(k:k + n_lanes - 1))
            if (n_lanes*size_of(some) <= most_padding*sum(own(some))) then
               n = n + 1
               groups(:, n) = some
               grouped(some) = .true.
               k = k + n_lanes
            else
               k = k + 1
            end if
         end associate
      end do
      order = [(k, k=1, n)]
      call refine_order(order, minval(groups(:, :n), 1))
      blocks%groups = groups(:, order)
      blocks%left = pack([(b, b=1, size(grouped))], .not. grouped)

   contains

      !> Pairs of nodes in the envelope of some blocks
      pure integer(i8) function size_of(some)
         !> The blocks
         integer, intent(in) :: some(:)

         associate (below => envelope_of(blocks, some))
            size_of = size(below, kind=i8) + sum(int(below, i8))
         end associate
      end function size_of

   end subroutine group_alike

   !> Nodes of a block
   elemental integer function n_nodes_of(blocks, b)
      !> The blocks
      type(block_groups_type), intent(in) :: blocks
      !> The block
      integer, intent(in) :: b

      n_nodes_of = blocks%first(b + 1) - blocks%first(b)
   end function n_nodes_of

end module axijoint_analysis_fine_block_groups
