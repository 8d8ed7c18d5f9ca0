!> What rounding makes of stresses that should be none: bodies that expand or move freely have strains that are small differences
!> of large numbers, and what is left of these is no error of any approximation
module axijoint_analysis_error_rounding
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_solid_force, only : initial_state_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_solid_point, only : solid_point_type, solid_points
   use axijoint_fe_mode, only : mode_integral
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_material, only : elasticity, thermal_strain
   use axijoint_model_mesh, only : n_elements, element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: is_slight, rounding_energy, rounding_stress

   !> Differences of displacements below this part of the largest are rounding, and what the solution of the equations adds to
   !> that by each node
   real(wp), parameter :: rounded = 256.0_wp*epsilon(1.0_wp), rounded_by_node = 8.0_wp*epsilon(1.0_wp)

contains

   !> Whether an energy is so little that rounding might have left it, beside that of strains which make the displacement
   !> all over a body as large as the mesh: to be looked at first, as it takes no integral
   pure logical function is_slight(model, displacement, energy)
      !> The job
      type(model_type), intent(in) :: model
      !> Largest displacement
      real(wp), intent(in) :: displacement
      !> The energy
      real(wp), intent(in) :: energy

      !> Part of it, far above rounding where elements are no less than a millionth of the mesh
      real(wp), parameter :: slight = 1.0e-10_wp
      real(wp) :: extent, stiffest
      integer :: k

      associate (x => model%mesh%coordinates)
         extent = max(maxval(x(1, :)), maxval(x(2, :)) - minval(x(2, :)))
      end associate
      stiffest = maxval([(maxval(abs(elasticity(model%materials(k)))), k=1, size(model%materials))])
      is_slight = energy <= slight*stiffest*extent*displacement**2
   end function is_slight

   !> Energy in each mode of what rounding may leave of the stresses of solids, by their own displacements and by forces of joints
   function rounding_energy(model, structure, initial, displacement) result(energy)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes and joints
      type(structure_type), intent(in) :: structure
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> Largest displacement
      real(wp), intent(in) :: displacement
      !> Energy, shape (modes)
      real(wp) :: energy(size(structure%modes))

      type(reference_type), allocatable :: references(:)
      type(solid_point_type) :: points(max_element_points)
      real(wp) :: d(6, 6)
      integer :: element, k

      energy = 0.0_wp
      references = element_references(model%mesh)
      do element = 1, n_elements(model%mesh)
         associate (reference => references(model%mesh%element_kind(element)), &
                    material => model%materials(model%mesh%element_material(element)), &
                    x => model%mesh%coordinates(:, model%mesh%element_nodes(:model%mesh%element_size(element), element)))
            call solid_points(x, reference, points(:reference%n_points))
            d = elasticity(material)
            associate (stiffness => sum(abs(d(:3, :3)))*sum(points(:reference%n_points)%weight), &
                       expansion => maxval(abs(thermal_strain(material))), moved => displacement/least_distance(x))
               do k = 1, size(energy)
                  energy(k) = energy(k) + 0.5_wp*stiffness*(moved + expansion*hottest(initial, element, k))**2
               end do
            end associate
         end associate
      end do
      associate (joints => structure%joint_points)
         energy = energy + 0.5_wp*displacement**2*sum(joints%weight*[(maxval(joints(k)%stiffness), k=1, size(joints))] &
                                                      *max(1.0_wp, joints%proportion))
      end associate
      energy = rounded**2*mode_integral(structure%modes)*energy
   end function rounding_energy

   !> Largest temperature of an element in a mode, without its sign
   pure real(wp) function hottest(initial, element, mode) result(temperature)
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> The element, and the place of the mode
      integer, intent(in) :: element, mode

      temperature = 0.0_wp
      if (allocated(initial%temperature)) temperature = maxval(abs(initial%temperature(:, element, mode)))
   end function hottest

   !> Least distance of some points
   pure real(wp) function least_distance(x) result(distance)
      !> Coordinates, shape (2, points)
      real(wp), intent(in) :: x(:, :)

      integer :: i, j

      distance = huge(1.0_wp)
      do i = 2, size(x, 2)
         do j = 1, i - 1
            distance = min(distance, norm2(x(:, i) - x(:, j)))
         end do
      end do
   end function least_distance

   !> What rounding of displacements may make of the stress of a joint: of the numbers themselves, whatever the stiffness, and of
   !> the equations, whose solution is the farther off the more nodes there are, and to which stiff joints are rigid
   elemental real(wp) function rounding_stress(point, displacement, n_nodes) result(stress)
      !> The joint point
      type(model_joint_point_type), intent(in) :: point
      !> Largest displacement
      real(wp), intent(in) :: displacement
      !> Number of nodes
      integer, intent(in) :: n_nodes

      stress = displacement*maxval(point%stiffness)*(rounded + rounded_by_node*n_nodes/max(1.0_wp, point%proportion))
   end function rounding_stress

end module axijoint_analysis_error_rounding
