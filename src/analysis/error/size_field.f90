!> Sizes that elements should have so that the error falls as wished with the fewest of them, for
!> meshes that a generator makes anew. With C the part of the error that an element leaves, falling with
!> the power 2p of its size for degree p, the least number of elements for a given error divides its
!> sides by n ~ C**(1/(2p + 2))
module axijoint_analysis_error_size_field
   use axijoint_analysis_error_grading, only : grading_type
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: wanted_sizes

   !> Errors below this part of the largest count as this part: rounding says nothing
   real(wp), parameter :: negligible = 1.0e-12_wp

contains

   !> Sizes of elements wanted at the nodes: the geometric mean of what the elements there ask for
   pure subroutine wanted_sizes(coordinates, element_nodes, n_corners, error, wish, sizes, finer)
      !> r and z of the nodes, shape (2, nodes)
      real(wp), intent(in) :: coordinates(:, :)
      !> Nodes of the elements, corners first, shape (any, elements), and the number of corners
      integer, intent(in) :: element_nodes(:, :), n_corners(:)
      !> The part of the error that each element leaves; it need not be scaled
      real(wp), intent(in) :: error(:)
      !> What is wished for
      type(grading_type), intent(in) :: wish
      !> Length of a side at each node [length]; zero at nodes that are no corners
      real(wp), intent(out) :: sizes(:)
      !> How many times as many elements along a side there will be, on the average
      real(wp), intent(out) :: finer

      real(wp) :: weight(size(error)), pieces(size(error))
      integer :: asked(size(sizes)), e

      weight = max(error, negligible*maxval(error), tiny(1.0_wp)**0.5_wp) &
         **(1.0_wp/(2*wish%degree + 2))
      weight = weight/maxval(weight)
      pieces = divided(largest_factor())
      finer = sqrt(sum(pieces**2)/size(pieces))
      sizes = 0.0_wp
      asked = 0
      do e = 1, size(error)
         associate (corners => element_nodes(:n_corners(e), e))
            sizes(corners) = sizes(corners) &
               + log(max(wish%shortest, side_of(coordinates(:, corners))/pieces(e)))
            asked(corners) = asked(corners) + 1
         end associate
      end do
      where (asked > 0) sizes = exp(sizes/max(1, asked))

   contains

      !> Largest factor on the weights with which too much error remains and there is room for the
      !> elements
      pure real(wp) function largest_factor() result(low)
         integer, parameter :: most_halvings = 60
         real(wp) :: high, middle
         integer :: i

         low = 1.0e-6_wp
         high = 1.0e12_wp
         do i = 1, most_halvings
            middle = sqrt(low*high)
            if (is_too_coarse(divided(middle)) .and. sum(divided(middle)**2) <= wish%most_cells) then
               low = middle
            else
               high = middle
            end if
         end do
      end function largest_factor

      !> Pieces that sides of elements are divided into
      pure function divided(factor)
         !> Factor on their weights
         real(wp), intent(in) :: factor
         !> Shape (elements)
         real(wp) :: divided(size(weight))

         divided = min(wish%most, max(wish%fewest, factor*weight))
      end function divided

      !> Whether more error is left than may remain
      pure logical function is_too_coarse(pieces)
         !> Pieces of the sides
         real(wp), intent(in) :: pieces(:)

         is_too_coarse = sum(error*pieces**(-wish%order)) > wish%remains*sum(error)
      end function is_too_coarse

   end subroutine wanted_sizes

   !> Side of the square, or of the triangle of equal sides, that has the area of an element
   pure real(wp) function side_of(corners) result(side)
      !> r and z of its corners, in order, shape (2, 3 or 4)
      real(wp), intent(in) :: corners(:, :)

      real(wp), parameter :: triangle = 4.0_wp/3.0_wp**0.5_wp
      real(wp) :: area
      integer :: i, next

      area = 0.0_wp
      do i = 1, size(corners, 2)
         next = 1 + mod(i, size(corners, 2))
         area = area + 0.5_wp*(corners(1, i)*corners(2, next) - corners(1, next)*corners(2, i))
      end do
      side = sqrt(abs(area))
      if (size(corners, 2) == 3) side = sqrt(triangle*abs(area))
   end function side_of

end module axijoint_analysis_error_size_field
