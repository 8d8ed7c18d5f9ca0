!> Flexibilities of the pairs of nodes of points whose laws change with their jumps, as Newton's linear system reads them: products
!> with these are most of what it does, and few digits are enough for most of them. Where they are more than the processor keeps at
!> hand they are gathered in single precision, half of each, as they are symmetric. From one solution to the next much the same
!> points move: what was gathered is kept while it serves
module axijoint_joints_gathered_flexibility
   use axijoint_base_kinds, only : wp, sp, i8
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_pairs, only : pairs_type, choose
   use axijoint_joints_plane_product, only : plane_product_type
   use axijoint_linalg_lapack, only : complete
   use axijoint_linalg_symmetric_half, only : symmetric_half_type, before_column, entry
   use axijoint_linalg_symmetric_single, only : symmetric_single_type, make_room, put_column
   implicit none
   private
   public :: gathered_type, gathering_type, gather_moving, is_worth_threads

   !> Numbers of flexibilities that a processor keeps at hand
   real(wp), parameter :: at_hand = 1.0e5_wp
   !> Numbers of flexibilities from which on threads are worth their start
   real(wp), parameter :: worth_threads = 4.0e5_wp
   !> What is gathered serves fewer points if it is of so many times as many at most
   real(wp), parameter :: still_serves = 1.25_wp

   !> Flexibility of the pairs of nodes of the points that move
   type :: gathered_type
      !> As that of all pairs, or in single precision; neither on ranks that do not have it
      real(wp), allocatable :: double(:, :)
      type(symmetric_single_type), allocatable :: single
      !> What single precision counts in
      real(wp) :: unit = 0.0_wp
   end type gathered_type

   !> Flexibilities of some points, which serve while no others move
   type :: gathering_type
      !> The points; not allocated if nothing is gathered yet
      integer, allocatable :: points(:)
      !> Their pairs of nodes
      type(pairs_type) :: pairs
      !> Whether all digits are, and whether they are to be from now on
      logical :: double = .false., all_digits = .false.
      !> One a system
      type(gathered_type), allocatable :: flexibilities(:)
      !> Weights of the points over the largest, and that
      real(wp), allocatable :: weight(:)
      real(wp) :: largest = 0.0_wp
      !> What slopes make of jumps, and its memory, where not all digits are
      type(plane_product_type) :: product
   end type gathering_type

contains

   !> Gather the flexibilities of the points that move, if what is gathered does not serve. If it is
   !> of more points, these count as moving: they take what they are asked for and change nothing
   subroutine gather_moving(condensed, stiff, moves, gathering)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Points whose laws are stiffer than their joints in the structure: these take all digits
      logical, intent(in) :: stiff(:)
      !> Points that move; then those that are gathered
      logical, intent(inout) :: moves(:)
      !> What is gathered
      type(gathering_type), intent(inout) :: gathering

      type(pairs_type) :: pairs
      integer, allocatable :: place(:)
      logical :: double
      integer :: k, s

      if (.not. any(moves)) return
      call choose(condensed%pairs, pack([(k, k=1, size(moves))], moves), pairs, place)
      double = gathering%all_digits .or. any(stiff .and. moves) .or. n_numbers(size(condensed%flexibilities), pairs) <= at_hand
      if (serves(gathering, moves, double)) then
         moves = .false.
         moves(gathering%points) = .true.
         return
      end if
      gathering%double = double
      gathering%points = pack([(k, k=1, size(moves))], moves)
      gathering%pairs = pairs
      gathering%weight = condensed%points(gathering%points)%weight
      gathering%largest = max(tiny(1.0_wp), maxval(gathering%weight))
      gathering%weight = gathering%weight/gathering%largest
      if (.not. allocated(gathering%flexibilities)) allocate (gathering%flexibilities(size(condensed%flexibilities)))
      !$omp parallel do schedule(static, 1) if (is_worth_threads(gathering))
      do s = 1, size(condensed%flexibilities)
         if (.not. allocated(condensed%flexibilities(s)%matrix)) cycle
         associate (whole => condensed%flexibilities(s)%matrix, n => size(condensed%pairs%nodes, 2))
            if (double) then
               if (allocated(gathering%flexibilities(s)%single)) deallocate (gathering%flexibilities(s)%single)
               call gather_double(whole, [place, n + place, 2*n + place], gathering%flexibilities(s)%double)
            else
               if (allocated(gathering%flexibilities(s)%double)) deallocate (gathering%flexibilities(s)%double)
               call gather_single(whole, [place, n + place, 2*n + place], gathering%flexibilities(s))
            end if
         end associate
      end do
      !$omp end parallel do
   end subroutine gather_moving

   !> Whether what is gathered serves
   pure logical function serves(gathering, moves, double)
      !> What is gathered
      type(gathering_type), intent(in) :: gathering
      !> Points that move
      logical, intent(in) :: moves(:)
      !> Whether all digits are wanted
      logical, intent(in) :: double

      serves = .false.
      if (.not. allocated(gathering%points)) return
      serves = (gathering%double .eqv. double) .and. &
         count(moves(gathering%points)) == count(moves) .and. &
         size(gathering%points) <= still_serves*count(moves)
   end function serves

   !> Whether threads are worth their start for products with what is gathered
   pure logical function is_worth_threads(gathering)
      !> What is gathered
      type(gathering_type), intent(in) :: gathering

      is_worth_threads = n_numbers(size(gathering%flexibilities), gathering%pairs) > worth_threads
   end function is_worth_threads

   !> Numbers of flexibilities
   pure real(wp) function n_numbers(n, pairs)
      !> How many of them
      integer, intent(in) :: n
      !> The pairs of nodes that they are of
      type(pairs_type), intent(in) :: pairs

      n_numbers = 9.0_wp*n*real(size(pairs%nodes, 2), wp)**2
   end function n_numbers

   !> Gather the flexibility of some pairs
   subroutine gather_double(whole, place, double)
      !> Flexibility of all pairs
      type(symmetric_half_type), intent(in) :: whole
      !> Places of these in it, ascending
      integer, intent(in) :: place(:)
      !> Their flexibility, all of it
      real(wp), allocatable, intent(inout) :: double(:, :)

      integer :: j

      if (allocated(double)) then
         if (size(double, 1) /= size(place)) deallocate (double)
      end if
      if (.not. allocated(double)) allocate (double(size(place), size(place)))
      do j = 1, size(place)
         double(:j, j) = whole%values(before_column(whole%n, place(j)) + place(:j))
      end do
      call complete(double)
   end subroutine gather_double

   !> Gather the flexibility of some pairs in single precision
   subroutine gather_single(whole, place, gathered)
      !> Flexibility of all pairs
      type(symmetric_half_type), intent(in) :: whole
      !> Places of these in it, ascending
      integer, intent(in) :: place(:)
      !> Their flexibility
      type(gathered_type), intent(inout) :: gathered

      real(wp) :: scale
      real(sp) :: column(size(place))
      logical :: starts(size(place))
      integer, allocatable :: first(:), last(:), shift(:)
      integer(i8) :: before
      integer :: i, j, k

      gathered%unit = tiny(1.0_wp)
      do j = 1, size(place)
         gathered%unit = max(gathered%unit, abs(entry(whole, place(j), place(j))))
      end do
      gathered%unit = 2.0_wp**exponent(gathered%unit)  ! in a range that single precision has
      scale = 1.0_wp/gathered%unit
      starts = .true.
      starts(2:) = place(2:) /= place(:size(place) - 1) + 1
      first = pack([(i, i=1, size(place))], starts)
      last = [first(2:) - 1, size(place)]
      shift = place(first) - first
      if (.not. allocated(gathered%single)) allocate (gathered%single)
      call make_room(gathered%single, size(place))
      do j = 1, size(place)
         before = before_column(whole%n, place(j))
         do k = 1, size(first)  ! neighbours are copied together
            if (first(k) > j) exit
            do i = first(k), min(last(k), j)
               column(i) = real(scale*whole%values(before + i + shift(k)), sp)
            end do
         end do
         call put_column(gathered%single, j, column(:j))
      end do
   end subroutine gather_single

end module axijoint_joints_gathered_flexibility
