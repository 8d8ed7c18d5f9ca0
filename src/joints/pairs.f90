!> Pairs of opposite nodes of the joints. The jumps of joint points are interpolated between those of the pairs (Eq. 8 and
!> 14), which neighbouring joints share, so that they are fewer than the points: what the structure answers is found for them
module axijoint_joints_pairs
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : lower_node, upper_node
   use axijoint_linalg_symmetric_half, only : symmetric_half_type, entry
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: pairs_type, new_pairs, choose, forces_on_pairs, jumps_at_points, flexibility_of_point

   !> The pairs, and what joint points take of them
   type :: pairs_type
      !> Nodes at side 1-2 and at side 4-3, shape (2, pairs)
      integer, allocatable :: nodes(:, :)
      !> Pairs of each point, and its shape functions there, shape (3, points); zero for what a joint of two does not have
      integer, allocatable :: of_point(:, :)
      real(wp), allocatable :: shape(:, :)
      !> Cosine and sine of the angle from r to xi, shape (points)
      real(wp), allocatable :: cosine(:), sine(:)
      !> First entry of each pair, shape (pairs + 1); point and its shape function of each entry
      integer, allocatable, private :: first(:), point(:)
      real(wp), allocatable, private :: factor(:)
   end type pairs_type

contains

   !> Pairs of some joint points, numbered as they come
   pure function new_pairs(points) result(pairs)
      !> The points
      type(model_joint_point_type), intent(in) :: points(:)
      !> The pairs
      type(pairs_type) :: pairs

      integer, allocatable :: last_of(:), before(:), nodes(:, :)
      integer :: a, k, n, pair, n_nodes

      n_nodes = 0
      do k = 1, size(points)
         n_nodes = max(n_nodes, maxval(points(k)%nodes(:2*points(k)%n_pairs)))
      end do
      ! pairs of the same first node: the last of them, and that before each
      allocate (last_of(n_nodes), source=0)
      allocate (before(3*size(points)), nodes(2, 3*size(points)))
      allocate (pairs%of_point(3, size(points)), source=1)
      allocate (pairs%shape(3, size(points)), source=0.0_wp)
      n = 0
      do k = 1, size(points)
         do a = 1, points(k)%n_pairs
            associate (lower => points(k)%nodes(lower_node(a)), upper => points(k)%nodes(upper_node(a)))
               pair = last_of(lower)
               do while (pair > 0)
                  if (nodes(2, pair) == upper) exit
                  pair = before(pair)
               end do
               if (pair == 0) then
                  n = n + 1
                  pair = n
                  nodes(:, n) = [lower, upper]
                  before(n) = last_of(lower)
                  last_of(lower) = n
               end if
            end associate
            pairs%of_point(a, k) = pair
            pairs%shape(a, k) = points(k)%shape(a)
         end do
      end do
      pairs%nodes = nodes(:, :n)
      pairs%cosine = points%cosine
      pairs%sine = points%sine
      call find_entries(pairs)
   end function new_pairs

   !> Pairs of some of the points
   pure subroutine choose(pairs, points, chosen, place)
      !> The pairs
      type(pairs_type), intent(in) :: pairs
      !> The points, ascending
      integer, intent(in) :: points(:)
      !> Their pairs, in the same order, and the places of these among all
      type(pairs_type), intent(out) :: chosen
      integer, allocatable, intent(out) :: place(:)

      integer :: number(size(pairs%nodes, 2))
      integer :: a, k, i

      number = 0
      do k = 1, size(points)
         do a = 1, 3
            if (abs(pairs%shape(a, points(k))) > 0.0_wp) number(pairs%of_point(a, points(k))) = 1
         end do
      end do
      place = pack([(i, i=1, size(number))], number > 0)
      number = 1  ! of what is multiplied by zero
      number(place) = [(i, i=1, size(place))]
      chosen%nodes = pairs%nodes(:, place)
      allocate (chosen%of_point(3, size(points)))
      do k = 1, size(points)
         chosen%of_point(:, k) = number(pairs%of_point(:, points(k)))
      end do
      chosen%shape = pairs%shape(:, points)
      chosen%cosine = pairs%cosine(points)
      chosen%sine = pairs%sine(points)
      call find_entries(chosen)
   end subroutine choose

   !> What each pair takes of the points
   pure subroutine find_entries(pairs)
      !> The pairs
      type(pairs_type), intent(inout) :: pairs

      integer :: a, k, l, next(size(pairs%nodes, 2))

      allocate (pairs%first(size(next) + 1), source=0)
      do k = 1, size(pairs%shape, 2)
         do a = 1, 3
            if (abs(pairs%shape(a, k)) > 0.0_wp) pairs%first(pairs%of_point(a, k) + 1) = pairs%first(pairs%of_point(a, k) + 1) + 1
         end do
      end do
      pairs%first(1) = 1
      do l = 2, size(pairs%first)
         pairs%first(l) = pairs%first(l) + pairs%first(l - 1)
      end do
      next = pairs%first(:size(next))
      allocate (pairs%point(pairs%first(size(pairs%first)) - 1), pairs%factor(pairs%first(size(pairs%first)) - 1))
      do k = 1, size(pairs%shape, 2)
         do a = 1, 3
            if (.not. abs(pairs%shape(a, k)) > 0.0_wp) cycle
            associate (place => next(pairs%of_point(a, k)))
               pairs%point(place) = k
               pairs%factor(place) = pairs%shape(a, k)
               place = place + 1
            end associate
         end do
      end do
   end subroutine find_entries

   !> Forces on the pairs that do the work of stress on the jumps: the transpose of what `jumps_at_points` does
   pure subroutine forces_on_pairs(pairs, n, weight, stress, force)
      !> The pairs
      type(pairs_type), intent(in) :: pairs
      !> Number of points
      integer, intent(in) :: n
      !> Weights of the points, and stress along xi, eta, theta
      real(wp), intent(in) :: weight(n), stress(n, 3)
      !> Forces along r, z, theta on side 4-3, against which side 1-2 takes as much, shape (pairs, 3)
      real(wp), intent(out) :: force(:, :)

      real(wp) :: along(n, 3), sums(3)
      integer :: k, l

      along(:, 1) = weight*(pairs%cosine*stress(:, 1) - pairs%sine*stress(:, 2))
      along(:, 2) = weight*(pairs%sine*stress(:, 1) + pairs%cosine*stress(:, 2))
      along(:, 3) = weight*stress(:, 3)
      do k = 1, size(force, 1)
         sums = 0.0_wp
         do l = pairs%first(k), pairs%first(k + 1) - 1
            sums(1) = sums(1) + pairs%factor(l)*along(pairs%point(l), 1)
            sums(2) = sums(2) + pairs%factor(l)*along(pairs%point(l), 2)
            sums(3) = sums(3) + pairs%factor(l)*along(pairs%point(l), 3)
         end do
         force(k, 1) = sums(1)
         force(k, 2) = sums(2)
         force(k, 3) = sums(3)
      end do
   end subroutine forces_on_pairs

   !> Jumps of the points from those of the pairs
   pure subroutine jumps_at_points(pairs, moved, n, jump)
      !> The pairs
      type(pairs_type), intent(in) :: pairs
      !> Displacements of side 4-3 against side 1-2 along r, z, theta, shape (pairs, 3)
      real(wp), intent(in) :: moved(:, :)
      !> Number of points
      integer, intent(in) :: n
      !> Along xi, eta, theta
      real(wp), intent(out) :: jump(n, 3)

      real(wp) :: along(n, 3)
      integer :: k

      do k = 1, n
         associate (a => pairs%of_point(1, k), b => pairs%of_point(2, k), c => pairs%of_point(3, k), shape => pairs%shape(:, k))
            along(k, 1) = shape(1)*moved(a, 1) + shape(2)*moved(b, 1) + shape(3)*moved(c, 1)
            along(k, 2) = shape(1)*moved(a, 2) + shape(2)*moved(b, 2) + shape(3)*moved(c, 2)
            along(k, 3) = shape(1)*moved(a, 3) + shape(2)*moved(b, 3) + shape(3)*moved(c, 3)
         end associate
      end do
      jump(:, 1) = pairs%cosine*along(:, 1) + pairs%sine*along(:, 2)
      jump(:, 2) = pairs%cosine*along(:, 2) - pairs%sine*along(:, 1)
      jump(:, 3) = along(:, 3)
   end subroutine jumps_at_points

   !> Jumps of a point from unit stress at it times a unit of its weight
   pure function flexibility_of_point(pairs, matrix, k) result(flexibility)
      !> The pairs
      type(pairs_type), intent(in) :: pairs
      !> Their flexibility, for all pairs of component 1, 2, 3
      type(symmetric_half_type), intent(in) :: matrix
      !> The point
      integer, intent(in) :: k
      !> The jumps, one column a component of stress
      real(wp) :: flexibility(3, 3)

      real(wp) :: rotation(3, 3)
      integer :: a, b, i, j

      flexibility = 0.0_wp
      do b = 1, 3
         do a = 1, 3
            associate (row => pairs%of_point(a, k), column => pairs%of_point(b, k), n => size(pairs%nodes, 2))
               flexibility = flexibility + pairs%shape(a, k)*pairs%shape(b, k)*reshape( &
                             [((entry(matrix, row + i*n, column + j*n), i=0, 2), j=0, 2)], [3, 3])
            end associate
         end do
      end do
      rotation = reshape([pairs%cosine(k), -pairs%sine(k), 0.0_wp, pairs%sine(k), pairs%cosine(k), 0.0_wp, &
                          0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      flexibility = matmul(rotation, matmul(flexibility, transpose(rotation)))
   end function flexibility_of_point

end module axijoint_joints_pairs
