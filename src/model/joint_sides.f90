!> The bodies on both sides of joints: their elements, and how these resist a joint
module axijoint_model_joint_sides
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_material, only : solid_material_type
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: elements_beside, moduli_beside, least_modulus

contains

   !> Elements that have the edges of joints, at side 1-2 and at side 4-3; 0 where there is none
   pure function elements_beside(mesh) result(elements)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Shape (2, joints)
      integer :: elements(2, size(mesh%joint_label))

      integer :: ends(2, 2*size(mesh%joint_label)), first(n_nodes(mesh)), next(2*size(mesh%joint_label))
      integer :: element, i, joint, n

      elements = 0
      if (n_joints(mesh) == 0) return
      ! sides by one of their ends
      first = 0
      do joint = 1, n_joints(mesh)
         ends(:, 2*joint - 1) = mesh%joint_nodes([1, 2], joint)
         ends(:, 2*joint) = mesh%joint_nodes([4, 3], joint)
      end do
      do i = 1, size(next)
         next(i) = first(ends(1, i))
         first(ends(1, i)) = i
      end do
      do element = 1, n_elements(mesh)
         n = n_corners(mesh%element_size(element))
         associate (corners => mesh%element_nodes(:n, element))
            do i = 1, n
               call take(corners(i), corners(1 + mod(i, n)), element)
               call take(corners(1 + mod(i, n)), corners(i), element)
            end do
         end associate
      end do

   contains

      !> Let an element be that of the sides which have an edge
      pure subroutine take(a, b, element)
         !> The ends of the edge, and the element
         integer, intent(in) :: a, b, element

         integer :: side

         side = first(a)
         do while (side > 0)
            if (ends(2, side) == b) elements(2 - mod(side, 2), (side + 1)/2) = element
            side = next(side)
         end do
      end subroutine take

   end function elements_beside

   !> Moduli of the softer of the bodies on both sides of each joint: along xi, eta, theta; the largest number where there are none
   pure function moduli_beside(model, elements) result(modulus)
      !> The job
      type(model_type), intent(in) :: model
      !> Elements on both sides, shape (2, joints)
      integer, intent(in) :: elements(:, :)
      !> Shape (3, joints) [stress]
      real(wp) :: modulus(3, size(elements, 2))

      real(wp) :: along(2)
      integer :: joint, side

      modulus = huge(1.0_wp)
      do joint = 1, size(elements, 2)
         associate (mesh => model%mesh)
            along = mesh%coordinates(:, mesh%joint_nodes(2, joint)) - mesh%coordinates(:, mesh%joint_nodes(1, joint))
         end associate
         along = along/norm2(along)
         do side = 1, 2
            if (elements(side, joint) == 0) cycle
            associate (material => model%materials(model%mesh%element_material(elements(side, joint))))
               modulus(:, joint) = min(modulus(:, joint), moduli_at(material, along))
            end associate
         end do
      end do
   end function moduli_beside

   !> Moduli by which a solid resists a joint at its surface along xi, eta, theta: E, or of an orthotropic one that along the normal
   !> and twice the shear moduli. How soft it is along other directions, as a slotted ring round the circle, is of its shape
   pure function moduli_at(material, along) result(modulus)
      !> The solid
      type(solid_material_type), intent(in) :: material
      !> Direction of the joint in the r-z plane, a unit vector
      real(wp), intent(in) :: along(2)
      !> The moduli [stress]
      real(wp) :: modulus(3)

      real(wp) :: c, s

      modulus = material%young
      if (.not. material%orthotropic) return
      ! the normal, in directions 1 and 2
      c = -along(2)*cos(material%angle) + along(1)*sin(material%angle)
      s = along(2)*sin(material%angle) + along(1)*cos(material%angle)
      associate (e => material%moduli, g12 => material%shears(1), g23 => material%shears(2), g13 => material%shears(3), &
                 nu12 => material%ratios(1))
         modulus(1) = 2.0_wp/(4.0_wp*(c*s)**2*(1.0_wp/e(1) + 1.0_wp/e(2) + 2.0_wp*nu12/e(1)) + (c**2 - s**2)**2/g12)
         modulus(2) = 1.0_wp/(c**4/e(1) + (1.0_wp/g12 - 2.0_wp*nu12/e(1))*(c*s)**2 + s**4/e(2))
         modulus(3) = 2.0_wp/(c**2/g13 + s**2/g23)
      end associate
   end function moduli_at

   !> Least modulus of all elements in the r-z plane; the largest number if there are none
   pure real(wp) function least_modulus(model) result(least)
      !> The job
      type(model_type), intent(in) :: model

      integer :: element

      least = huge(1.0_wp)
      do element = 1, n_elements(model%mesh)
         associate (material => model%materials(model%mesh%element_material(element)))
            if (material%orthotropic) then
               least = min(least, minval(material%moduli(:2)))
            else
               least = min(least, material%young)
            end if
         end associate
      end do
   end function least_modulus

end module axijoint_model_joint_sides
