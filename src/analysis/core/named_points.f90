!> Displacements at the points of the deck that have names
module axijoint_analysis_core_named_points
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_request, only : point_type
   implicit none
   private
   public :: at_points, largest_at_points, largest_error_at_points

contains

   !> Displacement amplitudes at the points
   pure function at_points(points, displacement) result(value)
      !> The points
      type(point_type), intent(in) :: points(:)
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Shape (3, points, modes)
      real(wp) :: value(3, size(points), size(displacement, 3))

      integer :: k, p

      do k = 1, size(displacement, 3)
         do p = 1, size(points)
            value(:, p, k) = matmul(displacement(:, points(p)%nodes, k), points(p)%shape)
         end do
      end do
   end function at_points

   !> Largest displacement vector of each point at any angle
   pure function largest_at_points(points, modes, displacement) result(largest)
      !> The points
      type(point_type), intent(in) :: points(:)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Shape (points) [length]
      real(wp) :: largest(size(points))

      real(wp) :: value(3, size(points), size(modes))
      integer :: p

      value = at_points(points, displacement)
      do p = 1, size(points)
         largest(p) = largest_vector(modes, value(:, p:p, :))
      end do
   end function largest_at_points

   !> The same of errors that are known at nodes: between nodes the largest at those that a point lies between, for errors of
   !> other signs there would take each other away
   pure function largest_error_at_points(points, modes, error) result(largest)
      !> The points
      type(point_type), intent(in) :: points(:)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: error(:, :, :)
      !> Shape (points) [length]
      real(wp) :: largest(size(points))

      !> A shape function that is no more is rounding
      real(wp), parameter :: none = 1.0e-9_wp
      integer :: p

      do p = 1, size(points)
         associate (about => pack(points(p)%nodes, abs(points(p)%shape) > none))
            largest(p) = largest_vector(modes, error(:, about, :))
         end associate
      end do
   end function largest_error_at_points

end module axijoint_analysis_core_named_points
