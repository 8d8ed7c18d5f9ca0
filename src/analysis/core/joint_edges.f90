!> Pressure of joints at their edges, to which no integration point reaches but those of Lobatto's rule
module axijoint_analysis_core_joint_edges
   use axijoint_analysis_core_fields, only : fields_type, peak_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest, measure, of_pressure
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_joints
   implicit none
   private
   public :: pressure_at_edges

   !> An edge of joints: its node at side 1-2, the two points next to it, and what their stresses count at it
   type :: edge_type
      integer :: node = 0, points(2) = 0
      real(wp) :: weight(2) = 0.0_wp
   end type edge_type

contains

   !> Largest pressure at the edges of joints, by a straight line through the two points next to each: where and when joints open or
   !> slip on their planes, where there are none anywhere round the circle
   function pressure_at_edges(mesh, structure, field, fields) result(peak)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The structure
      type(structure_type), intent(in) :: structure
      !> State of all joints
      type(joint_field_type), intent(in) :: field
      !> Displacements, and stresses of joints
      class(fields_type), intent(in) :: fields
      !> Value, node and angle; no value if there is no edge
      type(peak_type) :: peak

      type(edge_type), allocatable :: edges(:)
      real(wp), allocatable :: stress(:, :, :), at_points(:, :)
      real(wp) :: value
      integer :: e, j, k

      edges = edges_of_joints(mesh, structure%joint_points)
      if (size(edges) == 0) return
      if (size(structure%yielding) > 0) then
         do j = 1, size(fields%joint_stress, 3)
            do e = 1, size(edges)
               associate (points => edges(e)%points)
                  value = measure(of_pressure, matmul(fields%joint_stress(:, points, j), edges(e)%weight))
               end associate
               if (value > peak%value) peak = peak_type(value, edges(e)%node, fields%plane_angles(j))
            end do
         end do
         return
      end if
      allocate (stress(3, size(edges), size(fields%modes)))
      do k = 1, size(fields%modes)
         at_points = stress_amplitude(structure%joint_points, fields%modes(k), fields%displacement(:, :, k), field, k)
         do e = 1, size(edges)
            stress(:, e, k) = matmul(at_points(:, edges(e)%points), edges(e)%weight)
         end do
      end do
      peak = largest(fields%modes, stress, of_pressure)
      if (peak%place > 0) peak%place = edges(peak%place)%node
   end function pressure_at_edges

   !> Ends of joints that no other joint goes on from, and that no point stands at
   pure function edges_of_joints(mesh, points) result(edges)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Points of all joints, joint by joint
      type(model_joint_point_type), intent(in) :: points(:)
      !> The edges
      type(edge_type), allocatable :: edges(:)

      integer :: n_at(n_nodes(mesh)), joint, side, first, last

      n_at = 0
      do joint = 1, n_joints(mesh)
         associate (ends => mesh%joint_nodes(:2, joint))
            n_at(ends) = n_at(ends) + 1
         end associate
      end do
      allocate (edges(0))
      last = 0
      do while (last < size(points))
         first = last + 1
         joint = points(first)%joint
         do while (last < size(points))
            if (points(last + 1)%joint /= joint) exit
            last = last + 1
         end do
         if (last == first) cycle  ! one point tells nothing of what is beside it
         do side = 1, 2
            associate (node => mesh%joint_nodes(side, joint))
               if (n_at(node) == 1 .and. mesh%coordinates(1, node) > 0.0_wp) &
                  call add_edge(node, merge([first, first + 1], [last, last - 1], side == 1))
            end associate
         end do
      end do

   contains

      !> Add an edge, unless there is a point at it
      pure subroutine add_edge(node, next_to_it)
         !> Its node, and the points next to it
         integer, intent(in) :: node, next_to_it(2)

         real(wp), parameter :: rounding = 1.0e-9_wp
         real(wp) :: beyond, between

         beyond = norm2(mesh%coordinates(:, node) - points(next_to_it(1))%position)
         between = norm2(points(next_to_it(1))%position - points(next_to_it(2))%position)
         if (beyond <= rounding*between) return
         edges = [edges, edge_type(node, next_to_it, [1.0_wp + beyond/between, -beyond/between])]
      end subroutine add_edge

   end function edges_of_joints

end module axijoint_analysis_core_joint_edges
