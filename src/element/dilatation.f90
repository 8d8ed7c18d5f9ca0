!> What elements of a formulation take for the volumetric strain: its mean over the element, with
!> the weights r dA (B-bar, Hughes, Int. J. Numer. Meth. Eng. 15, 1980)
module axijoint_element_dilatation
   use axijoint_base_kinds, only : wp
   use axijoint_element_solid_point, only : solid_point_type, solid_points
   use axijoint_fe_element_kind, only : formulation_bbar
   use axijoint_fe_reference, only : reference_type
   implicit none
   private
   public :: dilatation_type, formulated_points, average_volume, strain_shape

   !> Means over an element: what is linear in the harmonic stays so, as the mean of B0 + m B1 is
   !> the sum of the means
   type :: dilatation_type
      !> Whether the element takes them
      logical :: averaged = .false.
      !> Means of dN/dr, dN/dz, N/r of each node
      real(wp) :: gradient(3, 9) = 0.0_wp
      !> Mean shape functions: a mean strain goes with the mean temperature
      real(wp) :: shape(9) = 0.0_wp
   end type dilatation_type

contains

   !> Integration points of an element, and what its formulation takes for the volumetric strain
   !> there
   pure subroutine formulated_points(coordinates, reference, points, dilatation)
      !> r and z of the nodes, shape (2, nodes)
      real(wp), intent(in) :: coordinates(:, :)
      !> The element in natural coordinates
      type(reference_type), intent(in) :: reference
      !> The points, shape (reference%n_points)
      type(solid_point_type), intent(out) :: points(:)
      !> The means; none if the formulation takes none
      type(dilatation_type), intent(inout) :: dilatation

      call solid_points(coordinates, reference, points)
      dilatation%averaged = reference%formulation == formulation_bbar
      if (dilatation%averaged) call take_means(points, dilatation)
   end subroutine formulated_points

   !> Means over an element
   pure subroutine take_means(points, dilatation)
      !> Integration points of the element
      type(solid_point_type), intent(in) :: points(:)
      !> The means
      type(dilatation_type), intent(inout) :: dilatation

      real(wp) :: weight
      integer :: k

      dilatation%gradient = 0.0_wp
      dilatation%shape = 0.0_wp
      do k = 1, size(points)
         associate (p => points(k))
            weight = p%weight/sum(points%weight)
            dilatation%gradient(1:2, :) = dilatation%gradient(1:2, :) + weight*p%gradient
            dilatation%gradient(3, :) = dilatation%gradient(3, :) + weight*p%shape/p%position(1)
            dilatation%shape = dilatation%shape + weight*p%shape
         end associate
      end do
   end subroutine take_means

   !> Replace the volumetric part of strain matrices by its mean
   pure subroutine average_volume(dilatation, n, b0, b1)
      !> Means over the element
      type(dilatation_type), intent(in) :: dilatation
      !> Number of nodes
      integer, intent(in) :: n
      !> The strain matrices, shape (6, 3n)
      real(wp), intent(inout) :: b0(:, :), b1(:, :)

      real(wp), dimension(3*n) :: change0, change1
      integer :: i

      change0 = -sum(b0(1:3, :), 1)
      change1 = -sum(b1(1:3, :), 1)
      do i = 1, n
         associate (mean => dilatation%gradient(:, i))
            change0(3*i - 2:3*i - 1) = change0(3*i - 2:3*i - 1) + [mean(1) + mean(3), mean(2)]
            change1(3*i) = change1(3*i) + mean(3)
         end associate
      end do
      do i = 1, 3
         b0(i, :) = b0(i, :) + change0/3.0_wp
         b1(i, :) = b1(i, :) + change1/3.0_wp
      end do
   end subroutine average_volume

   !> Shape functions that go with the strain at a point: a mean strain goes with the mean
   !> temperature
   pure function strain_shape(dilatation, point) result(shape)
      !> Means over the element
      type(dilatation_type), intent(in) :: dilatation
      !> Where
      type(solid_point_type), intent(in) :: point
      !> One a node
      real(wp) :: shape(size(point%shape))

      shape = point%shape
      if (dilatation%averaged) shape = dilatation%shape
   end function strain_shape

end module axijoint_element_dilatation
