!> An element cut into four of its own kind, each half as long in every natural direction
module axijoint_fe_subdivision
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : n_corners, natural_positions, shape_element
   implicit none
   private
   public :: subdivision_type, new_subdivision, n_children

   !> Elements that one becomes
   integer, parameter :: n_children = 4
   !> Most places of nodes of all children together
   integer, parameter :: max_places = 25

   !> One kind of element, cut
   type :: subdivision_type
      !> New nodes on a side: in its middle, or at its quarters if it has a node in the middle
      integer :: n_on_side = 0
      !> Places of nodes: those of the element, then the new ones of its sides in the sense of the
      !> element, then from `first_inside` on those inside
      integer :: n_places = 0, first_inside = 0
      !> Place of each node of the children, shape (nodes, children). Their natural directions are
      !> those of the element, or both turned round
      integer :: child(9, n_children) = 0
      !> Shape functions of the element at the places, shape (nodes, places)
      real(wp) :: shape(9, max_places) = 0.0_wp
   end type subdivision_type

contains

   !> Cut a kind of element
   pure function new_subdivision(n) result(cut)
      !> Number of nodes: 3, 4, 6, 8 or 9
      integer, intent(in) :: n
      !> The element, cut
      type(subdivision_type) :: cut

      real(wp) :: place(2, max_places), own(2, n), derivative(2, 9)
      integer :: side, k, c

      own = natural_positions(n)
      place(:, :n) = own
      cut%n_places = n
      cut%n_on_side = merge(1, 2, n <= 4)
      do side = 1, n_corners(n)
         associate (from => own(:, side), to => own(:, mod(side, n_corners(n)) + 1))
            do k = 1, cut%n_on_side
               cut%n_places = cut%n_places + 1
               place(:, cut%n_places) = from + (to - from)*(2*k - 1)/(2.0_wp*cut%n_on_side)
            end do
         end associate
      end do
      cut%first_inside = cut%n_places + 1
      do c = 1, n_children
         do k = 1, n
            call find_place(in_child(own, c, own(:, k)), place, cut%n_places, cut%child(k, c))
         end do
      end do
      do k = 1, cut%n_places
         call shape_element(n, place(1, k), place(2, k), cut%shape(:n, k), derivative(:, :n))
      end do
   end function new_subdivision

   !> Natural coordinates in the element from those in a child. A triangle has a child at each
   !> corner and one between them, turned round
   pure function in_child(own, c, x) result(position)
      !> Natural coordinates of the element's nodes
      real(wp), intent(in) :: own(:, :)
      !> The child
      integer, intent(in) :: c
      !> Natural coordinates in it
      real(wp), intent(in) :: x(2)
      !> Those in the element
      real(wp) :: position(2)

      if (c <= n_corners(size(own, 2))) then
         position = 0.5_wp*(own(:, c) + x)
      else
         position = 0.5_wp*(1.0_wp - x)
      end if
   end function in_child

   !> Find a place among those there are, or add it
   pure subroutine find_place(position, place, n_places, found)
      !> Its natural coordinates
      real(wp), intent(in) :: position(2)
      !> The places, and how many they are
      real(wp), intent(inout) :: place(:, :)
      integer, intent(inout) :: n_places
      !> Its number
      integer, intent(out) :: found

      do found = 1, n_places  ! coordinates are multiples of 1/4: exact
         if (maxval(abs(place(:, found) - position)) < 0.1_wp) return
      end do
      n_places = found
      place(:, found) = position
   end subroutine find_place

end module axijoint_fe_subdivision
