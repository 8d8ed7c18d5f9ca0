!> The shape of the elements: Jacobian and mid-side nodes
module axijoint_deck_check_elements
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, place_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_element_kind, only : element_kind
   use axijoint_fe_reference, only : reference_type, new_reference
   use axijoint_fe_shape, only : shape_element, n_corners, natural_positions
   implicit none
   private
   public :: check_elements

   !> Least sine of the angle between the lines of the natural coordinates
   real(wp), parameter :: least_sine = 1.0e-6_wp
   !> Points where the Jacobian is looked at: the corners and the integration points
   integer, parameter :: most_points = 4 + max_element_points
   !> Range of the middle node along its side
   real(wp), parameter :: middle_from = 0.25_wp, middle_to = 0.75_wp

   !> Derivatives of the shape functions where the Jacobian is looked at
   type :: sample_type
      !> Number of points, the first of which are the corners
      integer :: n = 0
      !> Shape functions, shape (9, points)
      real(wp) :: shape(9, most_points) = 0.0_wp
      !> Their derivatives along two lines, shape (2, 9, points): the sides at a
      !> corner, the natural coordinates elsewhere
      real(wp) :: derivative(2, 9, most_points) = 0.0_wp
   end type sample_type

contains

   !> Check all elements whose nodes are known
   subroutine check_elements(draft, diagnostics)
      !> The mesh, kinds of elements chosen; elements at fault are marked
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(sample_type), allocatable :: samples(:), centreless(:)
      type(diagnostics_type) :: found
      integer :: element, n, k

      samples = new_sample(new_reference(draft%kinds))
      centreless = new_sample(new_reference(element_kind(8, draft%kinds%order)))
      do element = 1, draft%n_elements
         n = draft%element_size(element)
         if (any(draft%element_nodes(:n, element) == 0)) cycle
         if (.not. all(draft%node_good(draft%element_nodes(:n, element)))) cycle
         k = draft%element_kind(element)
         call check_shape(samples(k), centreless(k), draft, element, n, found)
         if (found%n_errors == 0) cycle
         draft%element_good(element) = .false.
         if (corners_come_first(draft, element, n)) then
            call report_corners_first(draft, element, n, diagnostics)
            draft%elements_complete = .false.  ! its neighbours would be reported for its sides
         else
            call check_shape(samples(k), centreless(k), draft, element, n, diagnostics)
         end if
         found = diagnostics_type()
      end do
   end subroutine check_elements

   !> Check the shape of an element
   subroutine check_shape(sample, centreless, draft, element, n, diagnostics)
      !> Points where to look, and those of an element of nine nodes without its centre
      type(sample_type), intent(in) :: sample, centreless
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of nodes
      integer, intent(in) :: element, n
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: errors_before

      errors_before = diagnostics%n_errors
      if (n > 4) call check_middles(draft, element, n_corners(n), diagnostics)
      if (diagnostics%n_errors > errors_before) return
      if (n == 9) then
         if (only_centre_is_off(sample, centreless, &
            draft%position(:, draft%element_nodes(:9, element)))) then
            call report_centre(draft, element, diagnostics)
            return
         end if
      end if
      call check_jacobian(sample, draft, element, n, diagnostics)
   end subroutine check_shape

   !> Corners and integration points of a kind of element
   elemental function new_sample(reference) result(sample)
      !> The element in natural coordinates
      type(reference_type), intent(in) :: reference
      !> The points
      type(sample_type) :: sample

      real(wp) :: corner(2, reference%n_nodes), sides(2, 2)
      integer :: i

      associate (n => reference%n_nodes, c => n_corners(reference%n_nodes))
         corner = natural_positions(n)
         do i = 1, c
            call shape_element(n, corner(1, i), corner(2, i), sample%shape(:n, i), &
                               sample%derivative(:, :n, i))
            sides(1, :) = corner(:, mod(i, c) + 1) - corner(:, i)
            sides(2, :) = corner(:, mod(i + c - 2, c) + 1) - corner(:, i)
            sample%derivative(:, :n, i) = matmul(sides, sample%derivative(:, :n, i))
         end do
         sample%n = c + reference%n_points
         sample%shape(:, c + 1:sample%n) = reference%shape(:, :reference%n_points)
         sample%derivative(:, :, c + 1:sample%n) = reference%derivative(:, :, :reference%n_points)
      end associate
   end function new_sample

   !> Check that the Jacobian is positive
   subroutine check_jacobian(sample, draft, element, n, diagnostics)
      !> Points where to look
      type(sample_type), intent(in) :: sample
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of nodes
      integer, intent(in) :: element, n
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: x(2, 9), sine(most_points)
      integer :: i

      x(:, :n) = draft%position(:, draft%element_nodes(:n, element))
      sine = sines(sample, x(:, :n))
      if (all(sine > least_sine)) then
         if (.not. corner_area(x(:, :n_corners(n))) > 0.0_wp) call add_error(diagnostics, &
            draft%element_card(element), 0, 0, 'the corners of element '// &
            to_text(draft%element_label(element))//' enclose no area: only its bent sides do', &
            allowed='corners counterclockwise in the r-z plane, sides that do not cross', &
            mend='check the order of the nodes')
         return
      end if
      i = minloc(sine, 1)
      associate (c => n_corners(n))
         if (any(sine(:c) <= least_sine)) i = minloc(sine(:c), 1)
      end associate
      call report_jacobian(draft, element, n, sine(:sample%n), i, &
                           matmul(x(:, :n), sample%shape(:n, i)), diagnostics)
   end subroutine check_jacobian

   !> Sines of the angles between the lines of the natural coordinates
   pure function sines(sample, x) result(sine)
      !> Points where to look
      type(sample_type), intent(in) :: sample
      !> The nodes of the element, shape (2, nodes)
      real(wp), intent(in) :: x(:, :)
      !> The sines; 1 beyond the number of points
      real(wp) :: sine(most_points)

      real(wp) :: a(2), b(2), lengths(2)
      integer :: i, k

      sine = 1.0_wp
      do i = 1, sample%n
         a = 0.0_wp
         b = 0.0_wp
         do k = 1, size(x, 2)
            a = a + sample%derivative(1, k, i)*x(:, k)
            b = b + sample%derivative(2, k, i)*x(:, k)
         end do
         lengths = [hypot(a(1), a(2)), hypot(b(1), b(2))]
         sine(i) = 0.0_wp
         if (all(lengths > 0.0_wp)) sine(i) = (a(1)/lengths(1))*(b(2)/lengths(2)) - (a(2)/lengths(1))*(b(1)/lengths(2))
      end do
   end function sines

   !> Whether an element of nine nodes would be sound with its centre node left out
   pure logical function only_centre_is_off(sample, centreless, x)
      !> Points where to look with and without the centre node
      type(sample_type), intent(in) :: sample, centreless
      !> Its nodes
      real(wp), intent(in) :: x(2, 9)

      only_centre_is_off = any(sines(sample, x) <= least_sine) .and. &
                           all(sines(centreless, x(:, :8)) > least_sine)
   end function only_centre_is_off

   !> Report a centre node that is too far from the centre
   subroutine report_centre(draft, element, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element
      integer, intent(in) :: element
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: centre(2)

      associate (nodes => draft%element_nodes(:, element))
         centre = 0.5_wp*sum(draft%position(:, nodes(5:8)), 2) - &
            0.25_wp*sum(draft%position(:, nodes(:4)), 2)
         call add_error(diagnostics, draft%element_card(element), 0, 0, &
                        'centre node '//to_text(draft%node_label(nodes(9)))//' of element '// &
                        to_text(draft%element_label(element))// &
                        ' is too far from the centre: the '// &
                        'Jacobian is not positive at a Gauss point', &
                        found=place_text(draft%position(:, nodes(9))), &
                        mend='move it to '//place_text(centre)// &
                        ', or remove its card: it is then made there')
      end associate
   end subroutine report_centre

   !> Whether an element of 6, 8 or 9 nodes has its middle nodes in the middles of its sides if
   !> the card is read as all corners, then all middle nodes
   pure logical function corners_come_first(draft, element, n)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of nodes
      integer, intent(in) :: element, n

      real(wp) :: x(2, 8), side(2), offset(2)
      integer :: i

      corners_come_first = .false.
      if (n <= 4) return
      associate (c => n_corners(n))
         x(:, :2*c) = draft%position(:, draft%element_nodes(perimeter(n), element))
         do i = 1, c
            side = x(:, mod(i, c) + 1) - x(:, i)
            offset = x(:, c + i) - (x(:, i) + 0.5_wp*side)
            if (norm2(offset) > (middle_to - 0.5_wp)*norm2(side)) return
         end do
      end associate
      corners_come_first = .true.
   end function corners_come_first

   !> Report an element whose card has the corners first
   subroutine report_corners_first(draft, element, n, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of nodes
      integer, intent(in) :: element, n
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: on_card(:)

      on_card = draft%node_label(draft%element_nodes(perimeter(n), element))
      on_card = on_card(perimeter(n))  ! now corners and middles by turns
      if (n == 9) on_card = [on_card, draft%node_label(draft%element_nodes(9, element))]
      call add_error(diagnostics, draft%element_card(element), 0, 0, &
                     'element '//to_text(draft%element_label(element))// &
                     ' is given by its corners, then its mid-side nodes', &
                     allowed='corner, mid-side node, corner, ... counterclockwise round the '// &
                     'perimeter', &
                     mend='write '//numbers_text(on_card))
   end subroutine report_corners_first

   !> Numbers separated by blanks
   pure function numbers_text(numbers) result(text)
      !> The numbers
      integer, intent(in) :: numbers(:)
      !> The text
      character(len=:), allocatable :: text

      integer :: i

      text = ''
      do i = 1, size(numbers)
         text = text//' '//to_text(numbers(i))
      end do
      text = text(2:)
   end function numbers_text

   !> Area of the polygon of the corners, positive if they run counterclockwise
   pure real(wp) function corner_area(corners) result(area)
      !> r and z of each, shape (2, corners)
      real(wp), intent(in) :: corners(:, :)

      integer :: i

      area = 0.0_wp
      do i = 2, size(corners, 2) - 1
         associate (a => corners(:, i) - corners(:, 1), b => corners(:, i + 1) - corners(:, 1))
            area = area + 0.5_wp*(a(1)*b(2) - b(1)*a(2))
         end associate
      end do
   end function corner_area

   !> Report an element whose Jacobian is not positive
   subroutine report_jacobian(draft, element, n, sine, worst, place, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of nodes
      integer, intent(in) :: element, n
      !> Sines of the angles at the points, corners first
      real(wp), intent(in) :: sine(:)
      !> Worst point
      integer, intent(in) :: worst
      !> Its place
      real(wp), intent(in) :: place(2)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: name

      name = 'element '//to_text(draft%element_label(element))
      if (all(sine < -least_sine)) then
         call add_error(diagnostics, draft%element_card(element), 0, 0, &
                        'the nodes of '//name//' run clockwise: its Jacobian is negative', &
                        allowed='nodes counterclockwise in the r-z plane, beginning at a corner', &
                        mend='reverse the order: '//reversed_nodes(draft, element, n))
      else if (worst <= n_corners(n)) then
         call add_error(diagnostics, draft%element_card(element), 0, 0, &
                        'the Jacobian of '//name//' is '// &
                        trim(merge('negative', 'zero    ', sine(worst) < -least_sine))// &
                        ' at corner '//to_text(worst)//', node '// &
                        to_text(draft%node_label(draft%element_nodes(worst, element))), &
                        found=place_text(place), &
                        allowed='angles between 0 and 180 degrees at all corners, sides that '// &
                        'do not cross', &
                        mend='move the node, or check the order of the nodes')
      else
         call add_error(diagnostics, draft%element_card(element), 0, 0, &
                        'the Jacobian of '//name//' is not positive at a Gauss point', &
                        found=place_text(place), &
                        mend='move the mid-side nodes towards the middles of straight sides')
      end if
   end subroutine report_jacobian

   !> Nodes of an element in the opposite sense, as the card gives them
   pure function reversed_nodes(draft, element, n) result(text)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of nodes
      integer, intent(in) :: element, n
      !> Their numbers
      character(len=:), allocatable :: text

      integer, allocatable :: order(:)

      order = perimeter(n)
      order = [order(1), order(size(order):2:-1)]
      if (n == 9) order = [order, 9]
      text = numbers_text(draft%node_label(draft%element_nodes(order, element)))
   end function reversed_nodes

   !> Place in the model's order of the nodes as they run round the perimeter
   pure function perimeter(n) result(places)
      !> Number of nodes of the element
      integer, intent(in) :: n
      !> The places, without the centre
      integer, allocatable :: places(:)

      integer :: i

      associate (c => n_corners(n))
         if (n <= 4) places = [(i, i=1, c)]
         if (n > 4) places = [(i, c + i, i=1, c)]
      end associate
   end function perimeter

   !> Check that middle nodes are in the middle half of their sides
   subroutine check_middles(draft, element, c, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of corners
      integer, intent(in) :: element, c
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: side(2), middle(2), fraction
      integer :: i

      associate (nodes => draft%element_nodes(:, element))
         do i = 1, c
            side = draft%position(:, nodes(mod(i, c) + 1)) - draft%position(:, nodes(i))
            middle = draft%position(:, nodes(c + i)) - draft%position(:, nodes(i))
            if (.not. norm2(side) > 0.0_wp) cycle
            fraction = dot_product(middle/norm2(side), side/norm2(side))
            if (fraction >= middle_from .and. fraction <= middle_to) cycle
            call add_error(diagnostics, draft%element_card(element), 0, 0, &
                           'node '//to_text(draft%node_label(nodes(c + i)))//' of element '// &
                           to_text(draft%element_label(element))// &
                           ' is not near the middle of its side '// &
                           to_text(draft%node_label(nodes(i)))//'-'// &
                           to_text(draft%node_label(nodes(mod(i, c) + 1))), &
                           found='at '//to_text(fraction)//' of the side, '// &
                           place_text(draft%position(:, nodes(c + i))), &
                           allowed='between 0.25 and 0.75 of the side')
         end do
      end associate
   end subroutine check_middles

end module axijoint_deck_check_elements
