!> Loads of an old deck: on faces where that is the same, else on nodes
module axijoint_legacy_loads
   use axijoint_base_kinds, only : wp, pi
   use axijoint_base_text, only : to_text
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_line
   use axijoint_legacy_deck, only : old_deck_type, old_edge_type
   use axijoint_legacy_words, only : text_type, put, integers, exact
   implicit none
   private
   public :: put_edges, put_forces

   !> Part of a side's length that a mid-side node may be off its middle
   real(wp), parameter :: straight = 1.0e-6_wp

contains

   !> Loads on edges that cards of faces can say: a face each
   subroutine put_edges(deck, new)
      !> The old deck
      type(old_deck_type), intent(in) :: deck
      !> The new one
      type(text_type), intent(inout) :: new

      real(wp) :: direction(2)
      logical :: plain(size(deck%edges)), pressed(size(deck%edges)), pulled(size(deck%edges))
      integer :: k, n

      do k = 1, size(plain)
         plain(k) = is_plain(deck, deck%edges(k))
         pressed(k) = plain(k) .and. any(abs(deck%edges(k)%normal) > 0.0_wp)
         pulled(k) = plain(k) .and. any(abs(deck%edges(k)%tangential) > 0.0_wp)
      end do
      if (any(plain)) call put(new, 'CHAINS')
      do k = 1, size(plain)
         associate (edge => deck%edges(k))
            if (plain(k)) call put(new, to_text(k)//integers(edge%nodes([1, edge%n_nodes])))
         end associate
      end do
      if (any(pressed)) call put(new, 'PRESSURES')
      do k = 1, size(plain)
         associate (edge => deck%edges(k))
            n = edge%n_nodes
            if (pressed(k)) call put(new, to_text(k)//', 0, '//exact(edge%normal(1))//', '// &
               exact(edge%normal(n)))
         end associate
      end do
      if (any(pulled)) call put(new, 'TRACTIONS')
      do k = 1, size(plain)
         if (.not. pulled(k)) cycle
         associate (edge => deck%edges(k))
            n = edge%n_nodes
            direction = deck%position(:, edge%nodes(n)) - deck%position(:, edge%nodes(1))
            direction = direction/norm2(direction)
            call put(new, to_text(k)//', 0, '//exact(edge%tangential(1)*direction(1))//', '// &
               exact(edge%tangential(1)*direction(2))//', , '// &
               exact(edge%tangential(n)*direction(1))//', '// &
               exact(edge%tangential(n)*direction(2)))
         end associate
      end do
   end subroutine put_edges

   !> Forces of the loads on an edge on its nodes, of the whole circle, by the old program's rule of
   !> NGAUS points: normals and loads at the points
   subroutine add_edge(deck, edge, force)
      !> The deck
      type(old_deck_type), intent(in) :: deck
      !> The edge
      type(old_edge_type), intent(in) :: edge
      !> Forces along r and z, shape (2, nodes)
      real(wp), intent(inout) :: force(:, :)

      real(wp) :: x(3), w(3), shape(3), derivative(3), along(2), weight, normal, tangential
      integer :: k, i

      associate (n => edge%n_nodes)
         ! the middle node stands second on the card, last among shape functions
         associate (order => merge([1, 2, 3], [1, 3, 2], n == 2), corners => deck%position)
            call gauss_rule(deck%n_gauss, x, w)
            do k = 1, deck%n_gauss
               call shape_line(n, x(k), shape(:n), derivative(:n))
               associate (nodes => edge%nodes(order(:n)))
                  along = matmul(corners(:, nodes), derivative(:n))
                  weight = 2.0_wp*pi*w(k)*dot_product(corners(1, nodes), shape(:n))
                  normal = dot_product(edge%normal(order(:n)), shape(:n))
                  tangential = dot_product(edge%tangential(order(:n)), shape(:n))
                  do i = 1, n
                     force(:, nodes(i)) = force(:, nodes(i)) + weight*shape(i)* &
                        [tangential*along(1) - normal*along(2), &
                         normal*along(1) + tangential*along(2)]
                  end do
               end associate
            end do
         end associate
      end associate
   end subroutine add_edge

   !> Forces on nodes, of the whole circle there, of a length of it here, with those of edges that
   !> cards of faces cannot say
   subroutine put_forces(deck, new)
      !> The old deck
      type(old_deck_type), intent(in) :: deck
      !> The new one
      type(text_type), intent(inout) :: new

      real(wp), allocatable :: force(:, :)
      real(wp) :: length
      logical :: edges
      integer :: k

      force = deck%force
      edges = .false.
      do k = 1, size(deck%edges)
         if (is_plain(deck, deck%edges(k))) cycle
         call add_edge(deck, deck%edges(k), force)
         edges = .true.
      end do
      if (.not. any(abs(force) > 0.0_wp)) return
      call put(new, 'RINGLOADS')
      call put(new, '! forces of the whole circle, divided by its length')
      if (edges) call put(new, '! with those that the old rule of '//to_text(deck%n_gauss)// &
         ' points makes of loads on edges that are curved, or not linear')
      do k = 1, deck%n_nodes
         if (.not. any(abs(force(:, k)) > 0.0_wp)) cycle
         length = 2.0_wp*pi*deck%position(1, k)
         if (length > 0.0_wp) then
            call put(new, to_text(k)//', 0, '//exact(force(1, k)/length)//', '// &
               exact(force(2, k)/length))
         else if (abs(force(2, k)) > 0.0_wp) then
            call put(new, to_text(k)//', 0, , '//exact(force(2, k)))
         end if
      end do
   end subroutine put_forces

   !> Whether cards of loads on faces say what the old program makes of an edge: its rule, of NGAUS
   !> points, is exact of straight edges and loads that are even, or linear on elements of four nodes
   !> or with three points
   pure logical function is_plain(deck, edge)
      !> The deck
      type(old_deck_type), intent(in) :: deck
      !> The edge
      type(old_edge_type), intent(in) :: edge

      logical :: even

      is_plain = edge%n_nodes == 2
      if (is_plain) return
      even = abs(edge%normal(1) - edge%normal(3)) <= 0.0_wp .and. &
         abs(edge%tangential(1) - edge%tangential(3)) <= 0.0_wp
      is_plain = is_straight(deck, edge) .and. is_mean(edge%normal) .and. is_mean(edge%tangential) &
         .and. (even .or. deck%n_gauss == 3)
   end function is_plain

   !> Whether the middle of three values is the mean of the others
   pure logical function is_mean(values)
      !> The values
      real(wp), intent(in) :: values(3)

      is_mean = abs(values(2) - 0.5_wp*(values(1) + values(3))) <= 1.0e-9_wp*maxval(abs(values))
   end function is_mean

   !> Whether a side is straight, its middle node in its middle
   pure logical function is_straight(deck, edge)
      !> The deck
      type(old_deck_type), intent(in) :: deck
      !> The side
      type(old_edge_type), intent(in) :: edge

      is_straight = .true.
      if (edge%n_nodes == 2) return
      associate (a => deck%position(:, edge%nodes(1)), m => deck%position(:, edge%nodes(2)), &
                 b => deck%position(:, edge%nodes(3)))
         is_straight = norm2(m - 0.5_wp*(a + b)) <= straight*norm2(b - a)
      end associate
   end function is_straight

end module axijoint_legacy_loads
