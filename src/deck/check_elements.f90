!> The shape of the elements: Jacobian and mid-side nodes
module axijoint_deck_check_elements
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_draft, only : draft_type, place_text
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_quadrilateral
   implicit none
   private
   public :: check_elements

   !> Least sine of the angle between the lines of the natural coordinates
   real(wp), parameter :: least_sine = 1.0e-6_wp
   !> Points where the Jacobian is looked at: four corners and up to nine Gauss points
   integer, parameter :: n_corners = 4, most_points = n_corners + 9
   !> Range of the middle node along its side
   real(wp), parameter :: middle_from = 0.25_wp, middle_to = 0.75_wp
   !> Place in the model's order of the nodes as they run round the perimeter
   integer, parameter :: perimeter_linear(4) = [1, 2, 3, 4], perimeter_quadratic(8) = [1, 5, 2, 6, 3, 7, 4, 8]

   !> Derivatives of the shape functions where the Jacobian is looked at
   type :: sample_type
      !> Number of points
      integer :: n = 0
      !> Shape functions, shape (9, points)
      real(wp) :: shape(9, most_points) = 0.0_wp
      !> Their derivatives, shape (2, 9, points)
      real(wp) :: derivative(2, 9, most_points) = 0.0_wp
   end type sample_type

contains

   !> Check all elements whose nodes are known
   subroutine check_elements(gauss_linear, gauss_quadratic, draft, diagnostics)
      !> Gauss points per direction of 4-node elements, and of the others
      integer, intent(in) :: gauss_linear, gauss_quadratic
      !> The mesh; elements at fault are marked
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(sample_type) :: samples(4:9)
      type(diagnostics_type) :: found
      integer :: element, n

      samples(4) = new_sample(4, gauss_linear)
      samples(8) = new_sample(8, gauss_quadratic)
      samples(9) = new_sample(9, gauss_quadratic)
      do element = 1, draft%n_elements
         n = draft%element_size(element)
         if (any(draft%element_nodes(:n, element) == 0)) cycle
         if (.not. all(draft%node_good(draft%element_nodes(:n, element)))) cycle
         call check_shape(samples, draft, element, n, found)
         if (found%n_errors == 0) cycle
         draft%element_good(element) = .false.
         if (corners_come_first(draft, element, n)) then
            call report_corners_first(draft, element, n, diagnostics)
            draft%elements_complete = .false.  ! its neighbours would be reported for its sides
         else
            call check_shape(samples, draft, element, n, diagnostics)
         end if
         found = diagnostics_type()
      end do
   end subroutine check_elements

   !> Check the shape of an element
   subroutine check_shape(samples, draft, element, n, diagnostics)
      !> Points where to look, for elements of 4, 8 and 9 nodes
      type(sample_type), intent(in) :: samples(4:)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of nodes
      integer, intent(in) :: element, n
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: errors_before

      errors_before = diagnostics%n_errors
      if (n > 4) call check_middles(draft, element, diagnostics)
      if (diagnostics%n_errors > errors_before) return
      if (n == 9) then
         if (only_centre_is_off(samples, draft%position(:, draft%element_nodes(:9, element)))) then
            call report_centre(draft, element, diagnostics)
            return
         end if
      end if
      call check_jacobian(samples(n), draft, element, n, diagnostics)
   end subroutine check_shape

   !> Corners and Gauss points of an element with n nodes
   pure function new_sample(n, gauss) result(sample)
      !> Nodes of the element
      integer, intent(in) :: n
      !> Gauss points per direction
      integer, intent(in) :: gauss
      !> The points
      type(sample_type) :: sample

      real(wp), parameter :: corner(2, 4) = reshape([-1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, &
                                                      1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp], [2, 4])
      real(wp) :: x(3), w(3), point(2)
      integer :: i

      call gauss_rule(gauss, x, w)
      sample%n = n_corners + gauss**2
      do i = 1, sample%n
         if (i <= n_corners) then
            point = corner(:, i)
         else
            point = [x(mod(i - n_corners - 1, gauss) + 1), x((i - n_corners - 1)/gauss + 1)]
         end if
         call shape_quadrilateral(n, point(1), point(2), sample%shape(:n, i), sample%derivative(:, :n, i))
      end do
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
      if (all(sine > least_sine)) return
      i = minloc(sine, 1)
      if (any(sine(:n_corners) <= least_sine)) i = minloc(sine(:n_corners), 1)
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

      real(wp) :: jacobian(2, 2)
      integer :: i

      sine = 1.0_wp
      do i = 1, sample%n
         jacobian = matmul(x, transpose(sample%derivative(:, :size(x, 2), i)))
         associate (a => jacobian(:, 1), b => jacobian(:, 2))
            if (norm2(a) > 0.0_wp .and. norm2(b) > 0.0_wp) then
               sine(i) = (a(1)/norm2(a))*(b(2)/norm2(b)) - (a(2)/norm2(a))*(b(1)/norm2(b))
            else
               sine(i) = 0.0_wp
            end if
         end associate
      end do
   end function sines

   !> Whether an element of nine nodes would be sound with its centre node left out
   pure logical function only_centre_is_off(samples, x)
      !> Points where to look, for elements of 4, 8 and 9 nodes
      type(sample_type), intent(in) :: samples(4:)
      !> Its nodes
      real(wp), intent(in) :: x(2, 9)

      only_centre_is_off = any(sines(samples(9), x) <= least_sine) .and. &
                           all(sines(samples(8), x(:, :8)) > least_sine)
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
         centre = 0.5_wp*sum(draft%position(:, nodes(5:8)), 2) - 0.25_wp*sum(draft%position(:, nodes(:4)), 2)
         call add_error(diagnostics, draft%element_card(element), 0, 0, &
                        'centre node '//to_text(draft%node_label(nodes(9)))//' of element '// &
                        to_text(draft%element_label(element))//' is too far from the centre: the '// &
                        'Jacobian is not positive at a Gauss point', &
                        found=place_text(draft%position(:, nodes(9))), &
                        mend='move it to '//place_text(centre)//', or remove its card: it is then made there')
      end associate
   end subroutine report_centre

   !> Whether an element of 8 or 9 nodes has its middle nodes in the middles of its sides if
   !> the card is read as four corners, then four middle nodes
   pure logical function corners_come_first(draft, element, n)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element, and its number of nodes
      integer, intent(in) :: element, n

      real(wp) :: x(2, 8), side(2), offset(2)
      integer :: i

      corners_come_first = .false.
      if (n == 4) return
      x = draft%position(:, draft%element_nodes(perimeter_quadratic, element))
      do i = 1, 4
         side = x(:, mod(i, 4) + 1) - x(:, i)
         offset = x(:, 4 + i) - (x(:, i) + 0.5_wp*side)
         if (norm2(offset) > (middle_to - 0.5_wp)*norm2(side)) return
      end do
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

      on_card = draft%node_label(draft%element_nodes(perimeter_quadratic, element))
      on_card = on_card(perimeter_quadratic)  ! now corners and middles by turns
      if (n == 9) on_card = [on_card, draft%node_label(draft%element_nodes(9, element))]
      call add_error(diagnostics, draft%element_card(element), 0, 0, &
                     'element '//to_text(draft%element_label(element))// &
                     ' is given by its corners, then its mid-side nodes', &
                     allowed='corner, mid-side node, corner, ... counterclockwise round the perimeter', &
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
      else if (worst <= n_corners) then
         call add_error(diagnostics, draft%element_card(element), 0, 0, &
                        'the Jacobian of '//name//' is '// &
                        trim(merge('negative', 'zero    ', sine(worst) < -least_sine))// &
                        ' at corner '//to_text(worst)//', node '// &
                        to_text(draft%node_label(draft%element_nodes(worst, element))), &
                        found=place_text(place), &
                        allowed='angles between 0 and 180 degrees at all corners, sides that do not cross', &
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

      if (n == 4) order = perimeter_linear
      if (n > 4) order = perimeter_quadratic
      order = [order(1), order(size(order):2:-1)]
      if (n == 9) order = [order, 9]
      text = numbers_text(draft%node_label(draft%element_nodes(order, element)))
   end function reversed_nodes

   !> Check that middle nodes are in the middle half of their sides
   subroutine check_middles(draft, element, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element
      integer, intent(in) :: element
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: side(2), middle(2), fraction
      integer :: i

      associate (nodes => draft%element_nodes(:, element))
         do i = 1, 4
            side = draft%position(:, nodes(mod(i, 4) + 1)) - draft%position(:, nodes(i))
            middle = draft%position(:, nodes(4 + i)) - draft%position(:, nodes(i))
            if (.not. norm2(side) > 0.0_wp) cycle
            fraction = dot_product(middle/norm2(side), side/norm2(side))
            if (fraction >= middle_from .and. fraction <= middle_to) cycle
            call add_error(diagnostics, draft%element_card(element), 0, 0, &
                           'node '//to_text(draft%node_label(nodes(4 + i)))//' of element '// &
                           to_text(draft%element_label(element))//' is not near the middle of its side '// &
                           to_text(draft%node_label(nodes(i)))//'-'// &
                           to_text(draft%node_label(nodes(mod(i, 4) + 1))), &
                           found='at '//to_text(fraction)//' of the side, '// &
                           place_text(draft%position(:, nodes(4 + i))), &
                           allowed='between 0.25 and 0.75 of the side')
         end do
      end associate
   end subroutine check_middles

end module axijoint_deck_check_elements
