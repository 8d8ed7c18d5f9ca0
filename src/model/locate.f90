!> Which elements the points of a line lie in
module axijoint_model_locate
   use axijoint_base_kinds, only : wp
   use axijoint_fe_inverse_map, only : find_natural
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_mesh, only : mesh_type, n_elements
   use axijoint_model_request, only : line_type, line_point_type
   implicit none
   private
   public :: locate_points, locate_beside, line_position, element_reach

   !> Share of an element's extent by which its box is widened: for rounding, and
   !> for curved sides, which may leave the box of their nodes; and by which a node may be off the middle of a straight side
   real(wp), parameter :: straight_margin = 1.0e-5_wp, curved_margin = 0.25_wp, off_middle = 1.0e-6_wp

   !> Distance from a side, in lengths of its chord, or of the depth of its element if that is less, up to which a point outside is
   !> meant to lie on it: an outline that curves is met by sides of elements but for its share of their sagitta
   real(wp), parameter :: beside = 0.02_wp

contains

   !> r and z of a point of a line
   pure function line_position(line, number) result(position)
      !> The line
      type(line_type), intent(in) :: line
      !> The point, from 1
      integer, intent(in) :: number
      !> r and z
      real(wp) :: position(2)

      position = (real(line%n_points - number, wp)*line%first + real(number - 1, wp)*line%last) &
                 /real(line%n_points - 1, wp)
   end function line_position

   !> Heights between which points of each element are looked for
   pure function element_reach(mesh) result(reach)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Least and largest z, shape (2, elements)
      real(wp) :: reach(2, n_elements(mesh))

      real(wp) :: low(2), high(2)
      integer :: element

      do element = 1, n_elements(mesh)
         call find_box(mesh, element, low, high)
         reach(:, element) = [low(2), high(2)]
      end do
   end function element_reach

   !> Fill the points of a line that lie in elements
   subroutine locate_points(mesh, line, elements)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The line
      type(line_type), intent(inout) :: line
      !> Elements that alone can have some of them, ascending; all if absent
      integer, intent(in), optional :: elements(:)

      type(line_point_type), allocatable :: hits(:)
      type(line_point_type) :: hit
      integer, allocatable :: first(:), next(:)
      integer :: element, number, from, to, count, k, n
      logical :: inside

      allocate (hits(2*line%n_points), next(2*line%n_points))
      allocate (first(line%n_points), source=0)
      count = 0
      n = n_elements(mesh)
      if (present(elements)) n = size(elements)
      do k = 1, n
         element = k
         if (present(elements)) element = elements(k)
         call points_near(mesh, element, line, from, to)
         do number = from, to
            hit%number = number
            hit%position = line_position(line, number)
            hit%element = element
            associate (nodes => mesh%element_nodes(:mesh%element_size(element), element))
               call find_natural(mesh%coordinates(:, nodes), hit%position, hit%natural, inside)
            end associate
            if (inside) call keep(hit)
         end do
      end do
      call sort_hits(mesh, hits, first, next, count, line%points)

   contains

      !> Keep a point unless it is known in the same body and material
      subroutine keep(hit)
         !> The point
         type(line_point_type), intent(in) :: hit

         integer :: k

         k = first(hit%number)
         do while (k > 0)
            if (same_solid(mesh, hits(k)%element, hit%element)) return
            k = next(k)
         end do
         if (count == size(hits)) then
            hits = [hits, hits]
            next = [next, next]
         end if
         count = count + 1
         hits(count) = hit
         next(count) = first(hit%number)
         first(hit%number) = count
      end subroutine keep

   end subroutine locate_points

   !> Put a point that lies just outside the mesh on the nearest side of an element
   subroutine locate_beside(mesh, position, body, hit, found)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> r and z
      real(wp), intent(in) :: position(2)
      !> Body whose elements count; 0: of all
      integer, intent(in) :: body
      !> Takes where it is put; its number along a line is left
      type(line_point_type), intent(inout) :: hit
      !> Whether a side is near enough
      logical, intent(out) :: found

      real(wp) :: extent, nearest, distance, place(2), natural(2)
      integer :: element, side, n
      logical :: inside

      found = .false.
      nearest = huge(1.0_wp)
      do element = 1, n_elements(mesh)
         if (body > 0 .and. mesh%element_body(element) /= body) cycle
         n = mesh%element_size(element)
         associate (x => mesh%coordinates(:, mesh%element_nodes(:n, element)))
            extent = maxval(maxval(x, 2) - minval(x, 2))
            if (any(position < minval(x, 2) - curved_margin*extent .or. position > maxval(x, 2) + curved_margin*extent)) cycle
            do side = 1, n_corners(n)
               call nearest_on_side(x, side, position, place)
               distance = norm2(position - place)
               if (distance >= nearest .or. distance > beside*least_extent(x, side)) cycle
               call find_natural(x, place, natural, inside)
               if (.not. inside) cycle
               nearest = distance
               hit%position = place
               hit%element = element
               hit%natural = natural
               found = .true.
            end do
         end associate
      end do
   end subroutine locate_beside

   !> Length of a side, or of what its element has behind it if that is less
   pure real(wp) function least_extent(x, side) result(extent)
      !> r and z of the nodes of the element, shape (2, nodes)
      real(wp), intent(in) :: x(:, :)
      !> The side
      integer, intent(in) :: side

      real(wp) :: along(2)
      integer :: k, n

      n = n_corners(size(x, 2))
      along = x(:, mod(side, n) + 1) - x(:, side)
      extent = norm2(along)
      if (.not. extent > 0.0_wp) return
      extent = min(extent, maxval([(abs(along(1)*(x(2, k) - x(2, side)) - along(2)*(x(1, k) - x(1, side))), k=1, n)])/extent)
   end function least_extent

   !> The point of a side that is nearest to a point: by steps along the side, then by projection on its tangent
   pure subroutine nearest_on_side(x, side, position, place)
      !> r and z of the nodes of the element, shape (2, nodes)
      real(wp), intent(in) :: x(:, :)
      !> The side
      integer, intent(in) :: side
      !> The point
      real(wp), intent(in) :: position(2)
      !> r and z on the side
      real(wp), intent(out) :: place(2)

      integer, parameter :: n_steps = 16, n_projections = 8
      real(wp) :: mean(2), half(2), bend(2), slope(2), t, nearest
      integer :: k, n

      n = n_corners(size(x, 2))
      associate (a => x(:, side), b => x(:, mod(side, n) + 1))
         mean = 0.5_wp*(a + b)
         half = 0.5_wp*(b - a)
         bend = 0.0_wp
         if (size(x, 2) > n) then  ! a parabola through three nodes
            bend = mean - x(:, n + side)
            mean = x(:, n + side)
         end if
      end associate
      t = 0.0_wp
      nearest = huge(1.0_wp)
      do k = 0, n_steps
         associate (trial => 2.0_wp*real(k, wp)/n_steps - 1.0_wp)
            if (norm2(at(trial) - position) >= nearest) cycle
            nearest = norm2(at(trial) - position)
            t = trial
         end associate
      end do
      do k = 1, n_projections
         slope = half + 2.0_wp*t*bend
         t = max(-1.0_wp, min(1.0_wp, t + dot_product(position - at(t), slope)/max(tiny(1.0_wp), dot_product(slope, slope))))
      end do
      place = at(t)

   contains

      !> r and z of a point of the side
      pure function at(t) result(point)
         !> From -1 to 1
         real(wp), intent(in) :: t
         real(wp) :: point(2)

         point = mean + t*half + t**2*bend
      end function at

   end subroutine nearest_on_side

   !> Points of a line in the box around an element
   pure subroutine points_near(mesh, element, line, from, to)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> The line
      type(line_type), intent(in) :: line
      !> First and last; none if the last is less than the first
      integer, intent(out) :: from, to

      real(wp) :: low(2), high(2), t(2), span(2)
      integer :: axis

      call find_box(mesh, element, low, high)
      t = [0.0_wp, 1.0_wp]
      from = 1
      to = 0
      do axis = 1, 2
         associate (start => line%first(axis), run => line%last(axis) - line%first(axis))
            if (abs(run) > 0.0_wp) then
               span = ([low(axis), high(axis)] - start)/run
               t = [max(t(1), minval(span)), min(t(2), maxval(span))]
            else if (start < low(axis) .or. start > high(axis)) then
               return
            end if
         end associate
      end do
      if (t(1) > t(2)) return
      from = ceiling(t(1)*(line%n_points - 1)) + 1
      to = floor(t(2)*(line%n_points - 1)) + 1
   end subroutine points_near

   !> Box around an element that no point of it is outside of
   pure subroutine find_box(mesh, element, low, high)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> Least and largest r and z
      real(wp), intent(out) :: low(2), high(2)

      real(wp) :: span
      integer :: n

      n = mesh%element_size(element)
      associate (x => mesh%coordinates(:, mesh%element_nodes(:n, element)))
         low = minval(x, 2)
         high = maxval(x, 2)
         span = maxval(high - low)*merge(straight_margin, curved_margin, is_straight(x, off_middle*maxval(high - low)))
      end associate
      low = low - span
      high = high + span
   end subroutine find_box

   !> Whether the sides of an element are straight, their nodes in the middle: then it is no larger than its corners say
   pure logical function is_straight(x, rounding)
      !> r and z of its nodes, shape (2, nodes)
      real(wp), intent(in) :: x(:, :)
      !> How far a node may be off [length]
      real(wp), intent(in) :: rounding

      integer :: side, n

      n = n_corners(size(x, 2))
      is_straight = .true.
      do side = 1, min(n, size(x, 2) - n)
         is_straight = is_straight .and. all(abs(2.0_wp*x(:, n + side) - x(:, side) - x(:, mod(side, n) + 1)) <= 2.0_wp*rounding)
      end do
      if (size(x, 2) == 9) is_straight = is_straight .and. all(abs(4.0_wp*x(:, 9) - sum(x(:, :4), 2)) <= 4.0_wp*rounding)
   end function is_straight

   !> Whether two elements are of the same body and material
   pure logical function same_solid(mesh, a, b)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The elements
      integer, intent(in) :: a, b

      same_solid = mesh%element_body(a) == mesh%element_body(b) &
         .and. mesh%element_material(a) == mesh%element_material(b)
   end function same_solid

   !> The points one after another. Where solids meet, the one that the line comes
   !> from stands first
   pure subroutine sort_hits(mesh, hits, first, next, count, points)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The points in any order, the first of each number, and the next ones of it
      type(line_point_type), intent(in) :: hits(:)
      integer, intent(in) :: first(:), next(:)
      !> Number of them
      integer, intent(in) :: count
      !> The points
      type(line_point_type), allocatable, intent(out) :: points(:)

      integer :: number, begin, last, k

      allocate (points(count))
      last = 0
      do number = 1, size(first)
         begin = last + 1
         k = first(number)
         do while (k > 0)
            last = last + 1
            points(last) = hits(k)
            k = next(k)
         end do
         if (begin == 1) cycle
         do k = begin + 1, last
            if (same_solid(mesh, points(k)%element, points(begin - 1)%element)) then
               points([begin, k]) = points([k, begin])
            end if
         end do
      end do
   end subroutine sort_hits

end module axijoint_model_locate
