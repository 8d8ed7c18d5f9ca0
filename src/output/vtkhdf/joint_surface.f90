!> Where the joints are shown: points along them, and sectors of theta that each belong to
!> one plane of the joint law
module axijoint_output_vtkhdf_joint_surface
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_kinds, only : wp, pi
   use axijoint_element_joint, only : lower_node, upper_node
   use axijoint_fe_mode, only : family_symmetric
   use axijoint_fe_shape, only : shape_line
   use axijoint_model_joint_points, only : joint_rule
   use axijoint_model_model, only : model_type
   use axijoint_output_vtkhdf_grid, only : sweep_planes, is_circle
   use axijoint_output_vtkhdf_swept_mesh, only : swept_mesh_type, new_swept_mesh, add_facet
   implicit none
   private
   public :: surface_type, make_surface

   !> Lines closer than this share of a sector are one
   real(wp), parameter :: same_line = 1.0e-6_wp

   !> Points along the joints and planes of the sectors
   type :: surface_type
      !> Pairs of nodes of each point, on sides 1-2 and 4-3, shape (3, 2, points), and
      !> their shape functions, shape (3, points); zeros beyond
      integer, allocatable :: nodes(:, :, :)
      real(wp), allocatable :: shape(:, :)
      !> Plane of each sector, 0 if the job is linear, and 1 or -1 if it is its mirror image
      integer, allocatable :: plane(:), sign(:)
      !> Angle in the middle of each sector [radian]
      real(wp), allocatable :: middle(:)
   end type surface_type

contains

   !> Divide the joints along xi so that each of their points has a part of its own, and
   !> the range of theta so that each sector belongs to one plane
   pure subroutine make_surface(model, structure, results, surface, mesh)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for the joint points and planes
      type(structure_type), intent(in) :: structure
      !> Results at the end, for their modes
      type(results_type), intent(in) :: results
      !> The points and planes
      type(surface_type), intent(out) :: surface
      !> The mesh
      type(swept_mesh_type), intent(out) :: mesh

      real(wp), allocatable :: angle(:), position(:, :)
      real(wp) :: ends(4)
      integer :: joint, n_pairs, n, k, point, owner, most

      angle = sector_lines(model, structure, results)
      most = 3*size(model%mesh%joint_label)
      allocate (surface%nodes(3, 2, most + most/3), surface%shape(3, most + most/3))
      allocate (position(2, most + most/3))
      point = 0
      do joint = 1, size(model%mesh%joint_label)
         call joint_ends(model, joint, n_pairs, n, ends)
         do k = 1, n + 1
            point = point + 1
            call place_point(model, joint, n_pairs, ends(k), surface, point, position(:, point))
         end do
      end do
      mesh = new_swept_mesh(angle, is_circle(model%sweep), position(:, :point), &
                            .not. position(1, :point) > 0.0_wp, most)
      point = 0
      owner = 0
      do joint = 1, size(model%mesh%joint_label)
         call joint_ends(model, joint, n_pairs, n, ends)
         do k = 1, n
            owner = owner + 1
            call add_facet(mesh, owner, point + k, point + k + 1)
         end do
         point = point + n + 1
      end do
      call assign_planes(structure, results, angle, is_circle(model%sweep), surface)
   end subroutine make_surface

   !> Natural coordinates of the ends of the parts of a joint: as long as the weights of
   !> its points
   pure subroutine joint_ends(model, joint, n_pairs, n, ends)
      !> The job
      type(model_type), intent(in) :: model
      !> The joint
      integer, intent(in) :: joint
      !> Pairs of nodes, and points
      integer, intent(out) :: n_pairs, n
      !> The coordinates, the first n + 1
      real(wp), intent(out) :: ends(4)

      real(wp) :: x(3), w(3)
      integer :: k

      n_pairs = model%mesh%joint_size(joint)/2
      call joint_rule(model%joint_materials(model%mesh%joint_material(joint))%rule, n_pairs, n, x, &
         w)
      ends(1) = -1.0_wp
      do k = 1, n - 1
         ends(k + 1) = ends(k) + w(k)
      end do
      ends(n + 1) = 1.0_wp
   end subroutine joint_ends

   !> Place a point on a joint
   pure subroutine place_point(model, joint, n_pairs, x, surface, point, position)
      !> The job
      type(model_type), intent(in) :: model
      !> The joint, and its pairs of nodes
      integer, intent(in) :: joint, n_pairs
      !> Natural coordinate
      real(wp), intent(in) :: x
      !> Takes nodes and shape functions
      type(surface_type), intent(inout) :: surface
      !> The point
      integer, intent(in) :: point
      !> r and z
      real(wp), intent(out) :: position(2)

      real(wp) :: derivative(3)

      surface%nodes(:, :, point) = 1
      surface%shape(:, point) = 0.0_wp
      associate (nodes => model%mesh%joint_nodes(:, joint))
         surface%nodes(:n_pairs, 1, point) = nodes(lower_node(:n_pairs))
         surface%nodes(:n_pairs, 2, point) = nodes(upper_node(:n_pairs))
      end associate
      call shape_line(n_pairs, x, surface%shape(:n_pairs, point), derivative(:n_pairs))
      position = matmul(model%mesh%coordinates(:, surface%nodes(:n_pairs, 1, point)), &
                        surface%shape(:n_pairs, point))
   end subroutine place_point

   !> Planes between the sectors: those of the swept bodies, and those half-way between
   !> the planes of the joint law
   pure function sector_lines(model, structure, results) result(angle)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for the planes
      type(structure_type), intent(in) :: structure
      !> Results at the end, for their modes
      type(results_type), intent(in) :: results
      !> Angles, ascending; without the last one of a whole circle [radian]
      real(wp), allocatable :: angle(:)

      real(wp), allocatable :: all(:)
      real(wp) :: step, line
      integer :: k, j

      angle = sweep_planes(model%sweep, results%modes)
      if (size(structure%yielding) == 0) return
      step = structure%planes%angle(2) - structure%planes%angle(1)
      all = angle
      do k = ceiling(model%sweep%from/step - 0.5_wp), floor(model%sweep%to/step - 0.5_wp)
         line = (k + 0.5_wp)*step
         if (any(abs(all - line) < same_line*step)) cycle
         if (model%sweep%to - line < same_line*step) cycle
         if (line < all(1)) cycle
         j = count(all < line)
         all = [all(:j), line, all(j + 1:)]
      end do
      angle = all
   end function sector_lines

   !> Find the plane of the joint law that each sector belongs to
   pure subroutine assign_planes(structure, results, angle, closed, surface)
      !> The structure, for the planes
      type(structure_type), intent(in) :: structure
      !> Results at the end, for their modes
      type(results_type), intent(in) :: results
      !> Planes between the sectors [radian]
      real(wp), intent(in) :: angle(:)
      !> Whether they make a whole circle
      logical, intent(in) :: closed
      !> Takes planes and middles
      type(surface_type), intent(inout) :: surface

      real(wp) :: step
      integer :: j, n, round

      n = size(angle)
      surface%middle = 0.5_wp*(angle(:n - 1) + angle(2:))
      if (closed) surface%middle = [surface%middle, 0.5_wp*(angle(n) + angle(1)) + pi]
      allocate (surface%plane(size(surface%middle)), source=0)
      allocate (surface%sign(size(surface%middle)), source=1)
      if (size(structure%yielding) == 0) return
      associate (planes => structure%planes%angle)
         step = planes(2) - planes(1)
         round = nint(2.0_wp*pi/step)
         do j = 1, size(surface%middle)
            surface%plane(j) = modulo(nint(surface%middle(j)/step), round) + 1
            if (surface%plane(j) <= size(planes)) cycle
            surface%plane(j) = round + 2 - surface%plane(j)  ! symmetric: planes to pi alone
            surface%sign(j) = -1
         end do
      end associate
      if (any(results%modes%family /= family_symmetric)) surface%sign = 1
   end subroutine assign_planes

end module axijoint_output_vtkhdf_joint_surface
