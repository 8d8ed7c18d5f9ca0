!> Forces of edge loads and joints in one harmonic, on displacement components
module axijoint_assembly_force
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : jump_at, force_at
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_line
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : edge_load_type
   implicit none
   private
   public :: add_edge_load, joint_force, joint_jump, elastic_joint_stress

contains

   !> Add the work-equivalent forces of a traction on an edge:
   !> c_m times the integral of N t r ds
   pure subroutine add_edge_load(load, factor, coordinates, force)
      !> The load
      type(edge_load_type), intent(in) :: load
      !> Factor on it
      real(wp), intent(in) :: factor
      !> r and z of all nodes
      real(wp), intent(in) :: coordinates(:, :)
      !> Forces, shape (3, nodes)
      real(wp), intent(inout) :: force(:, :)

      real(wp) :: x(3), w(3), shape(3), derivative(3), weight, traction(3)
      integer :: n, k, i

      n = count(load%nodes > 0)
      call gauss_rule(3, x, w)  ! exact for N (2) t (2) r (1): degree 5 on a straight edge
      associate (corners => coordinates(:, load%nodes(:n)))
         do k = 1, 3
            call shape_line(n, x(k), shape(:n), derivative(:n))
            weight = factor*w(k)*circle_integral(load%mode%harmonic) &
               *dot_product(corners(1, :), shape(:n))*norm2(matmul(corners, derivative(:n)))
            traction = matmul(load%traction(:, :n), shape(:n))
            do i = 1, n
               force(:, load%nodes(i)) = force(:, load%nodes(i)) + weight*shape(i)*traction
            end do
         end do
      end associate
   end subroutine add_edge_load

   !> Relative displacement amplitudes xi, eta, theta at all joint points (Eq. 8)
   pure function joint_jump(points, displacement) result(jump)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Displacement amplitudes of one harmonic, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Jumps, shape (3, points)
      real(wp) :: jump(3, size(points))

      integer :: k

      do k = 1, size(points)
         associate (nodes => points(k)%nodes(:2*points(k)%n_pairs))
            jump(:, k) = jump_at(points(k)%joint_point_type, displacement(:, nodes))
         end associate
      end do
   end function joint_jump

   !> Joint stress of relative displacements in the elastic structure (Eq. 9)
   pure function elastic_joint_stress(points, jump) result(stress)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Relative displacements xi, eta, theta, shape (3, points)
      real(wp), intent(in) :: jump(:, :)
      !> Stresses, same shape
      real(wp) :: stress(3, size(points))

      integer :: k

      do k = 1, size(points)
         stress(:, k) = points(k)%base*jump(:, k)
      end do
   end function elastic_joint_stress

   !> Generalized nodal forces that balance joint stress amplitudes of one
   !> harmonic: c_m times the integral of N*^T P r ds
   pure function joint_force(points, harmonic, stress, n_nodes) result(force)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Amplitudes of tau_xi, sigma, tau_theta, shape (3, points)
      real(wp), intent(in) :: stress(:, :)
      !> Number of nodes
      integer, intent(in) :: n_nodes
      !> Forces, shape (3, nodes)
      real(wp) :: force(3, n_nodes)

      real(wp) :: at_nodes(3, 6)
      integer :: k, n

      force = 0.0_wp
      do k = 1, size(points)
         n = 2*points(k)%n_pairs
         at_nodes = force_at(points(k)%joint_point_type, circle_integral(harmonic) &
            *points(k)%weight*stress(:, k))
         associate (nodes => points(k)%nodes(:n))
            force(:, nodes) = force(:, nodes) + at_nodes(:, :n)
         end associate
      end do
   end function joint_force

end module axijoint_assembly_force
