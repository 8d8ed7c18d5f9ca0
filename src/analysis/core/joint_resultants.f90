!> Resultants of the stress of each joint
module axijoint_analysis_core_joint_resultants
   use axijoint_analysis_core_fields, only : n_resultants
   use axijoint_analysis_core_rigid, only : rigid_resultants
   use axijoint_assembly_force, only : joint_force
   use axijoint_element_joint, only : lower_node
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : mesh_type
   implicit none
   private
   public :: joint_resultants, joint_height

contains

   !> Forces and moments that the body at side 4-3 of each joint exerts on the body at side 1-2,
   !> moments about r = 0 at the middle of the joint's height. Forces of nodes: they are those
   !> that the bodies are in equilibrium with
   function joint_resultants(mesh, points, modes, displacement, field) result(resultant)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes without rigid motions of floating parts, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Resultants, shape (n_resultants, joints)
      real(wp) :: resultant(n_resultants, size(mesh%joint_label))

      real(wp), allocatable :: stress(:, :)
      type(model_joint_point_type), allocatable :: own(:)
      real(wp) :: force(3, 6), place(2, 3)
      integer :: first, i, j, k, last, n

      resultant = 0.0_wp
      do k = 1, size(modes)
         if (modes(k)%harmonic > 1) cycle  ! no resultants
         stress = stress_amplitude(points, modes(k), displacement(:, :, k), field, k)
         last = 0
         do while (last < size(points))  ! points stand joint by joint
            first = last + 1
            j = points(first)%joint
            last = first
            do while (last < size(points))
               if (points(last + 1)%joint /= j) exit
               last = last + 1
            end do
            own = points(first:last)
            n = own(1)%n_pairs
            do i = 1, size(own)
               own(i)%nodes = [1, 2, 3, 4, 5, 6]
            end do
            force = joint_force(own, modes(k)%harmonic, stress(:, first:last), 6)
            place(:, :n) = mesh%coordinates(:, mesh%joint_nodes(lower_node(:n), j))
            place(2, :n) = place(2, :n) - joint_height(mesh, j)
            resultant(:, j) = resultant(:, j) &
               - rigid_resultants(place(:, :n), modes(k), force(:, lower_node(:n)))
         end do
      end do
   end function joint_resultants

   !> Middle of the height of a joint [length]
   pure real(wp) function joint_height(mesh, joint) result(z)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The joint (index)
      integer, intent(in) :: joint

      z = 0.5_wp*sum(mesh%coordinates(2, mesh%joint_nodes(lower_node(:2), joint)))
   end function joint_height

end module axijoint_analysis_core_joint_resultants
