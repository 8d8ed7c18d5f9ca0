!> Lengths, normals and moments of faces
module axijoint_deck_mesh_face_geometry
   use axijoint_base_kinds, only : wp
   use axijoint_deck_mesh_draft, only : draft_type, edge_type
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_line
   implicit none
   private
   public :: linear_along, inward_normals, moment_of_radius

   !> Natural coordinates of the nodes of an edge: first, last, middle
   real(wp), parameter :: node_place(3) = [-1.0_wp, 1.0_wp, 0.0_wp]

contains

   !> Values at the nodes of a face that vary linearly with the length along it
   pure function linear_along(draft, edges, first, last) result(values)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the face
      type(edge_type), intent(in) :: edges(:)
      !> Values at the ends of the face
      real(wp), intent(in) :: first(:), last(:)
      !> Values at the nodes, shape (size(first), 3, edges); 0 without a middle node
      real(wp) :: values(size(first), 3, size(edges))

      real(wp) :: total, from, place
      integer :: i, k

      total = 0.0_wp
      do i = 1, size(edges)
         total = total + arc_length(draft, edges(i), 1.0_wp)
      end do
      values = 0.0_wp
      from = 0.0_wp
      do i = 1, size(edges)
         do k = 1, count(edges(i)%nodes > 0)
            place = (from + arc_length(draft, edges(i), node_place(k)))/total
            values(:, k, i) = first + place*(last - first)
         end do
         from = from + arc_length(draft, edges(i), 1.0_wp)
      end do
   end function linear_along

   !> Length of an edge from its first node to a natural coordinate
   pure real(wp) function arc_length(draft, edge, to) result(length)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The edge
      type(edge_type), intent(in) :: edge
      !> Natural coordinate, -1 to 1
      real(wp), intent(in) :: to

      real(wp) :: x(3), w(3), shape(3), derivative(3)
      integer :: k, n

      n = count(edge%nodes > 0)
      call gauss_rule(3, x, w)
      length = 0.0_wp
      do k = 1, 3
         call shape_line(n, 0.5_wp*(1.0_wp + to)*(1.0_wp + x(k)) - 1.0_wp, shape(:n), &
            derivative(:n))
         length = length + 0.5_wp*(1.0_wp + to)*w(k) &
                  *norm2(matmul(draft%position(:, edge%nodes(:n)), derivative(:n)))
      end do
   end function arc_length

   !> Unit normals at the nodes of a face, into the body; on a curved edge each node
   !> has its own
   pure function inward_normals(draft, edges) result(normals)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the face
      type(edge_type), intent(in) :: edges(:)
      !> r and z components, shape (2, 3, edges); 0 without a middle node
      real(wp) :: normals(2, 3, size(edges))

      real(wp) :: shape(3), derivative(3), tangent(2)
      integer :: i, k, n

      normals = 0.0_wp
      do i = 1, size(edges)
         n = count(edges(i)%nodes > 0)
         do k = 1, n
            call shape_line(n, node_place(k), shape(:n), derivative(:n))
            tangent = matmul(draft%position(:, edges(i)%nodes(:n)), derivative(:n))
            normals(:, k, i) = merge(1.0_wp, -1.0_wp, edges(i)%body_on_left) &
                               *[-tangent(2), tangent(1)]/norm2(tangent)
         end do
      end do
   end function inward_normals

   !> Integral of r**power ds over a face, by the rule that integrates tractions
   pure real(wp) function moment_of_radius(draft, edges, power) result(moment)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the face
      type(edge_type), intent(in) :: edges(:)
      !> Power of r
      integer, intent(in) :: power

      real(wp) :: x(3), w(3), shape(3), derivative(3)
      integer :: i, k, n

      call gauss_rule(3, x, w)
      moment = 0.0_wp
      do i = 1, size(edges)
         n = count(edges(i)%nodes > 0)
         associate (corners => draft%position(:, edges(i)%nodes(:n)))
            do k = 1, 3
               call shape_line(n, x(k), shape(:n), derivative(:n))
               moment = moment + w(k)*norm2(matmul(corners, derivative(:n))) &
                        *dot_product(corners(1, :), shape(:n))**power
            end do
         end associate
      end do
   end function moment_of_radius

end module axijoint_deck_mesh_face_geometry
