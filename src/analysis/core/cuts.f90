!> Resultants of the stresses on cuts z = const
module axijoint_analysis_core_cuts
   use axijoint_analysis_core_cut_loads, only : edge_load_excess, spring_excess, joint_excess, mass_excess, resultants_above
   use axijoint_analysis_core_cut_planes, only : plane_type, from_cut
   use axijoint_analysis_core_fields, only : fields_type, n_resultants
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_solid_force, only : initial_state_type, solid_force
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_elements, n_joints, n_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: cut_resultants, n_with_resultants, with_resultants, resultants_of_stress, displaced_excess

contains

   !> Fill the resultants on all cuts: the work of the stresses on a motion that is
   !> rigid above the cut and zero below, with the elements' own functions between,
   !> that is, the resultant of the stresses' nodal forces above the cut, of the elements
   !> that it passes through: others move without strain. It balances the nodal loads above.
   !> Where a load is spread over an element that the cut passes through, what nodal forces
   !> count too much or too little of it is taken off. So the cut balances the loads above it,
   !> wherever it is.
   subroutine cut_resultants(model, structure, loading, field, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints, springs and cuts
      type(structure_type), intent(in) :: structure
      !> Loads at the end
      type(loading_type), intent(in) :: loading
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Results; displacements are there already
      class(fields_type), intent(inout) :: results

      type(mode_type), allocatable :: modes(:)
      real(wp), allocatable :: stress(:, :, :)
      integer, allocatable :: places(:)
      integer :: c, k, m

      allocate (results%cut_resultants(n_resultants, size(model%cuts)), source=0.0_wp)
      if (size(model%cuts) == 0) return
      places = with_resultants(results%modes)
      modes = results%modes(places)
      allocate (stress(3, size(structure%joint_points), size(places)))
      do m = 1, size(places)
         associate (k => places(m))
            stress(:, :, m) = stress_amplitude(structure%joint_points, modes(m), results%displacement(:, :, k), field, k)
         end associate
      end do
      results%cut_resultants = resultants_of_stress(model, structure, loading%initial, places, modes, &
         results%displacement(:, :, places), stress)
      do c = 1, size(structure%cuts)
         do k = 1, size(modes)
            results%cut_resultants(:, c) = results%cut_resultants(:, c) &
               - edge_load_excess(model, structure%cuts(c), modes(k), loading%case_factor) &
               - mass_excess(model, structure%cuts(c), modes(k), loading%case_factor)
         end do
      end do
   end subroutine cut_resultants

   !> How many modes have resultants on cuts; they come before all others. None without cuts
   pure integer function n_with_resultants(structure) result(n)
      !> The structure
      type(structure_type), intent(in) :: structure

      n = 0
      if (size(structure%cuts) > 0) n = size(with_resultants(structure%modes))
   end function n_with_resultants

   !> Places of the modes whose stresses have resultants
   pure function with_resultants(modes) result(places)
      !> All modes
      type(mode_type), intent(in) :: modes(:)
      !> The places
      integer, allocatable :: places(:)

      integer :: k

      places = pack([(k, k=1, size(modes))], modes%harmonic <= 1)
   end function with_resultants

   !> Resultants on all cuts without what loads on elements there have to do with them
   function resultants_of_stress(model, structure, initial, places, modes, displacement, stress) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints, springs and cuts
      type(structure_type), intent(in) :: structure
      !> Stress of the solids without strain
      type(initial_state_type), intent(in) :: initial
      !> Places of the modes that count among all, and these
      integer, intent(in) :: places(:)
      type(mode_type), intent(in) :: modes(:)
      !> Displacements and stress of joints in these modes, amplitudes, shape (3, nodes, modes), (3, points, modes)
      real(wp), intent(in) :: displacement(:, :, :), stress(:, :, :)
      !> The resultants, shape (n_resultants, cuts)
      real(wp) :: total(n_resultants, size(structure%cuts))

      real(wp), allocatable :: force(:, :, :), shares(:, :, :, :)
      logical, allocatable :: crossed(:)
      integer :: c, m

      allocate (force(3, n_nodes(model%mesh), 1))
      allocate (shares(3, max_element_nodes, n_elements(model%mesh), 1))
      allocate (crossed(n_elements(model%mesh)), source=.false.)
      do c = 1, size(structure%cuts)
         crossed(structure%cuts(c)%crossed) = .true.
      end do
      total = -displaced_excess(model, structure, modes, displacement, stress)
      do m = 1, size(modes)
         call solid_force(model, initial, places(m), modes(m:m), displacement(:, :, m:m), force, counts=crossed, shares=shares)
         do c = 1, size(structure%cuts)
            total(:, c) = total(:, c) + crossed_resultants(model%mesh, structure%cuts(c), modes(m), shares(:, :, :, 1))
         end do
      end do
   end function resultants_of_stress

   !> What nodal forces of springs and joints above cuts count too much, in all modes together: shapes and directions are those
   !> of all
   function displaced_excess(model, structure, modes, displacement, stress) result(excess)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints, springs and cuts
      type(structure_type), intent(in) :: structure
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacements and stress of joints, amplitudes, shape (3, nodes, modes), (3, points, modes)
      real(wp), intent(in) :: displacement(:, :, :), stress(:, :, :)
      !> Resultants, shape (n_resultants, cuts)
      real(wp) :: excess(n_resultants, size(structure%cuts))

      integer :: first(n_joints(model%mesh))
      integer :: c, i

      do i = size(structure%joint_points), 1, -1
         first(structure%joint_points(i)%joint) = i
      end do
      do c = 1, size(structure%cuts)
         associate (plane => structure%cuts(c)%plane_type)
            excess(:, c) = sum(spring_excess(model, plane, modes, displacement), 2) &
               + sum(joint_excess(model, plane, modes, first, stress), 2)
         end associate
      end do
   end function displaced_excess

   !> Resultants of the forces of the elements that a cut passes through, on their nodes above it
   pure function crossed_resultants(mesh, plane, mode, shares) result(total)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The cut
      class(plane_type), intent(in) :: plane
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Share of each element in the nodal forces, shape (3, max_element_nodes, elements)
      real(wp), intent(in) :: shares(:, :, :)
      !> The resultants
      real(wp) :: total(n_resultants)

      integer :: k

      total = 0.0_wp
      do k = 1, size(plane%crossed)
         associate (element => plane%crossed(k))
            associate (n => mesh%element_size(element))
               total = total + resultants_above(plane, mode, from_cut(plane, mesh, mesh%element_nodes(:n, element)), &
                  shares(:, :n, element))
            end associate
         end associate
      end do
   end function crossed_resultants

end module axijoint_analysis_core_cuts
