!> Elements in natural coordinates: integration points, and the shape functions there
module axijoint_fe_reference
   use axijoint_base_kinds, only : wp
   use axijoint_fe_element_kind, only : element_kind_type
   use axijoint_fe_quadrature, only : square_rule, triangle_rule, max_element_points
   use axijoint_fe_shape, only : shape_element, n_corners
   implicit none
   private
   public :: reference_type, new_reference

   !> One kind of element with its integration points
   type :: reference_type
      !> Number of nodes: 3, 4, 6, 8 or 9
      integer :: n_nodes = 0
      !> Number of integration points
      integer :: n_points = 0
      !> One of the formulations
      integer :: formulation = 0
      !> Natural coordinates of the points, the first n_points of which are in use
      real(wp) :: position(2, max_element_points) = 0.0_wp
      !> Their weights
      real(wp) :: weight(max_element_points) = 0.0_wp
      !> Shape functions there, shape (nodes, points)
      real(wp) :: shape(9, max_element_points) = 0.0_wp
      !> Their derivatives by the natural coordinates, shape (2, nodes, points)
      real(wp) :: derivative(2, 9, max_element_points) = 0.0_wp
   end type reference_type

contains

   !> An element with its integration points
   elemental function new_reference(kind) result(reference)
      !> Its kind
      type(element_kind_type), intent(in) :: kind
      !> The element
      type(reference_type) :: reference

      integer :: k

      reference%n_nodes = kind%n_nodes
      reference%formulation = kind%formulation
      associate (n_nodes => kind%n_nodes, order => kind%order, &
                 n => reference%n_points, x => reference%position, w => reference%weight)
         if (n_corners(n_nodes) == 3) then
            call triangle_rule(order, n, x, w)
         else
            call square_rule(order, n, x, w)
         end if
         do k = 1, n
            call shape_element(n_nodes, x(1, k), x(2, k), reference%shape(:n_nodes, k), &
                               reference%derivative(:, :n_nodes, k))
         end do
      end associate
   end function new_reference

end module axijoint_fe_reference
