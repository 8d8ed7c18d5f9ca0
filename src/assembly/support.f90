!> Springs between edges and the ground (Winkler foundation)
module axijoint_assembly_support
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : joint_point_type, new_joint_point, jump_matrix, lower_node
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: support_point_type, new_support_points, support_matrix, support_stiffness, &
      add_support_force

   !> Point of an edge that springs hold: a joint whose other side is the ground
   type, extends(joint_point_type) :: support_point_type
      !> Nodes of the edge, the first n_pairs of which are in use
      integer :: nodes(3) = 0
      !> Stiffness along the edge, normal to it, along theta [stress/length]
      real(wp) :: stiffness(3) = 0.0_wp
   end type support_point_type

contains

   !> Gauss points of all edges on springs
   pure function new_support_points(model) result(points)
      !> The job
      type(model_type), intent(in) :: model
      !> The points
      type(support_point_type), allocatable :: points(:)

      real(wp) :: x(3), w(3)
      integer :: k, i, n, count

      allocate (points(3*size(model%edge_supports)))
      count = 0
      do k = 1, size(model%edge_supports)
         associate (support => model%edge_supports(k))
            n = merge(3, 2, support%nodes(3) > 0)
            call gauss_rule(n, x, w)
            do i = 1, n
               count = count + 1
               points(count)%joint_point_type = new_joint_point( &
                  model%mesh%coordinates(:, support%nodes(:n)), x(i), w(i))
               points(count)%nodes = support%nodes
               points(count)%stiffness = support%stiffness([2, 1, 3])
            end do
         end associate
      end do
      points = points(:count)
   end function new_support_points

   !> Displacement along the edge, normal to it and along theta, from nodal u, v, w
   pure subroutine support_matrix(point, matrix)
      !> Where
      type(support_point_type), intent(in) :: point
      !> For u1, v1, w1, u2, ..., shape (3, 6 | 9)
      real(wp), intent(out) :: matrix(:, :)

      real(wp) :: jump(3, 18)
      integer :: i

      call jump_matrix(point%joint_point_type, jump(:, :6*point%n_pairs))
      do i = 1, point%n_pairs  ! the ground does not move
         associate (first => 3*lower_node(i) - 2)
            matrix(:, 3*i - 2:3*i) = -jump(:, first:first + 2)
         end associate
      end do
   end subroutine support_matrix

   !> Contribution of a point to the stiffness, to be multiplied by c_m
   pure subroutine support_stiffness(point, k)
      !> Where
      type(support_point_type), intent(in) :: point
      !> weight N^T k N, shape (6, 6) or (9, 9)
      real(wp), intent(out) :: k(:, :)

      real(wp), dimension(3, size(k, 1)) :: n, kn
      integer :: i

      call support_matrix(point, n)
      do i = 1, 3
         kn(i, :) = point%weight*point%stiffness(i)*n(i, :)
      end do
      k = matmul(transpose(n), kn)
   end subroutine support_stiffness

   !> Add the nodal forces that hold the springs of all points in one harmonic
   pure subroutine add_support_force(points, harmonic, displacement, force)
      !> The points
      type(support_point_type), intent(in) :: points(:)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Forces on components, same shape
      real(wp), intent(inout) :: force(:, :)

      real(wp) :: matrix(9, 9)
      integer :: k, n

      do k = 1, size(points)
         n = points(k)%n_pairs
         call support_stiffness(points(k), matrix(:3*n, :3*n))
         associate (nodes => points(k)%nodes(:n))
            force(:, nodes) = force(:, nodes) + circle_integral(harmonic) &
               *reshape(matmul(matrix(:3*n, :3*n), reshape(displacement(:, nodes), [3*n])), [3, n])
         end associate
      end do
   end subroutine add_support_force

end module axijoint_assembly_support
