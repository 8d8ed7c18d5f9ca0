!> The paper's joint element at one point (Eq. 8 to 14)
module axijoint_element_joint
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : shape_line
   implicit none
   private
   public :: joint_point_type, new_joint_point, jump_matrix, jump_at, force_at, joint_stiffness

   !> Number of the node on the 1-2 side, and opposite on the 4-3 side, of the
   !> first, last and middle pair of nodes (Fig. 2)
   integer, parameter, public :: lower_node(3) = [1, 2, 5], upper_node(3) = [4, 3, 6]

   !> What the integrals over a joint need at one point
   type :: joint_point_type
      !> r and z
      real(wp) :: position(2) = 0.0_wp
      !> Weight of the point times the length per natural coordinate times r
      real(wp) :: weight = 0.0_wp
      !> Number of pairs of nodes: 2 or 3
      integer :: n_pairs = 0
      !> Shape functions of the pairs
      real(wp) :: shape(3) = 0.0_wp
      !> Cosine and sine of the angle alpha from r to xi (Fig. 2)
      real(wp) :: cosine = 0.0_wp, sine = 0.0_wp
   end type joint_point_type

contains

   !> Geometry of a joint at a natural coordinate
   pure function new_joint_point(side, x, w) result(point)
      !> r and z of the nodes of side 1-2: first, last and, for six nodes,
      !> middle; shape (2, 2 | 3)
      real(wp), intent(in) :: side(:, :)
      !> Natural coordinate in [-1, 1] and weight of the rule
      real(wp), intent(in) :: x, w
      !> The point
      type(joint_point_type) :: point

      real(wp) :: derivative(3), tangent(2), length
      integer :: n

      n = size(side, 2)
      point%n_pairs = n
      call shape_line(n, x, point%shape(:n), derivative(:n))
      point%position = matmul(side, point%shape(:n))
      tangent = matmul(side, derivative(:n))
      length = norm2(tangent)
      point%cosine = tangent(1)/length
      point%sine = tangent(2)/length
      point%weight = w*length*point%position(1)
   end function new_joint_point

   !> Matrix N* T that takes nodal displacements to the relative displacement
   !> xi, eta, theta of side 4-3 against side 1-2 (Eq. 8 and 14)
   pure subroutine jump_matrix(point, n)
      !> Where
      type(joint_point_type), intent(in) :: point
      !> The matrix for u1, v1, w1, u2, ..., shape (3, 12 | 18)
      real(wp), intent(out) :: n(:, :)

      real(wp) :: rotation(3, 3)
      integer :: pair, lower, upper

      rotation = reshape([point%cosine, -point%sine, 0.0_wp, &
                          point%sine, point%cosine, 0.0_wp, &
                          0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      n = 0.0_wp
      do pair = 1, point%n_pairs
         lower = 3*lower_node(pair)
         upper = 3*upper_node(pair)
         n(:, lower - 2:lower) = -point%shape(pair)*rotation
         n(:, upper - 2:upper) = point%shape(pair)*rotation
      end do
   end subroutine jump_matrix

   !> Its product with nodal displacements
   pure function jump_at(point, displacement) result(jump)
      !> Where
      type(joint_point_type), intent(in) :: point
      !> Amplitudes u, v, w of the nodes, shape (3, 4 | 6)
      real(wp), intent(in) :: displacement(:, :)
      !> Relative displacement xi, eta, theta
      real(wp) :: jump(3)

      real(wp) :: d(3)
      integer :: pair

      d = 0.0_wp
      do pair = 1, point%n_pairs
         d = d + point%shape(pair)*(displacement(:, upper_node(pair)) &
                                    - displacement(:, lower_node(pair)))
      end do
      jump = [point%cosine*d(1) + point%sine*d(2), point%cosine*d(2) - point%sine*d(1), d(3)]
   end function jump_at

   !> Product of its transpose with a stress: forces on the nodes of which it is the stress a unit area
   pure function force_at(point, stress) result(force)
      !> Where
      type(joint_point_type), intent(in) :: point
      !> tau_xi, sigma, tau_theta
      real(wp), intent(in) :: stress(3)
      !> Forces on u, v, w, the first 4 or 6 columns in use
      real(wp) :: force(3, 6)

      real(wp) :: t(3)
      integer :: pair

      t = [point%cosine*stress(1) - point%sine*stress(2), &
           point%sine*stress(1) + point%cosine*stress(2), stress(3)]
      do pair = 1, point%n_pairs
         force(:, lower_node(pair)) = -point%shape(pair)*t
         force(:, upper_node(pair)) = point%shape(pair)*t
      end do
   end function force_at

   !> Contribution of a point to the joint's stiffness, to be multiplied by c_m;
   !> the same for every harmonic (Eq. 12)
   pure subroutine joint_stiffness(point, stiffness, k)
      !> Where
      type(joint_point_type), intent(in) :: point
      !> Stiffness per unit area along xi, eta, theta
      real(wp), intent(in) :: stiffness(3)
      !> weight N^T k N, shape (12, 12) or (18, 18)
      real(wp), intent(out) :: k(:, :)

      real(wp), dimension(3, size(k, 1)) :: n, kn
      integer :: i

      call jump_matrix(point, n)
      do i = 1, 3
         kn(i, :) = point%weight*stiffness(i)*n(i, :)
      end do
      k = matmul(transpose(n), kn)
   end subroutine joint_stiffness

end module axijoint_element_joint
