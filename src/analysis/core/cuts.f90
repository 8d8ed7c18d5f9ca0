!> Resultants of the stresses on cuts z = const
module axijoint_analysis_core_cuts
   use axijoint_analysis_core_cut_loads, only : edge_load_excess, spring_excess, joint_excess, mass_excess, resultants_above
   use axijoint_analysis_core_cut_planes, only : plane_type, from_cut
   use axijoint_analysis_core_fields, only : fields_type, n_resultants
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_solid_force, only : solid_force
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_elements, n_joints, n_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: cut_resultants

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

      real(wp), allocatable :: force(:, :, :), shares(:, :, :, :), springs(:, :, :), joints(:, :, :)
      logical, allocatable :: crossed(:)
      integer, allocatable :: places(:)
      integer :: c, k, m

      allocate (results%cut_resultants(n_resultants, size(model%cuts)), source=0.0_wp)
      if (size(model%cuts) == 0) return
      allocate (force(3, n_nodes(model%mesh), 1))
      allocate (shares(3, max_element_nodes, n_elements(model%mesh), 1))
      allocate (crossed(n_elements(model%mesh)), source=.false.)
      do c = 1, size(structure%cuts)
         crossed(structure%cuts(c)%crossed) = .true.
      end do
      places = pack([(k, k=1, size(results%modes))], results%modes%harmonic <= 1)  ! others have no resultants
      call displaced_excess(model, structure, places, field, results, springs, joints)
      do m = 1, size(places)
         k = places(m)
         associate (mode => results%modes(k), case_factor => loading%case_factor)
            call solid_force(model, loading%initial, k, [mode], results%displacement(:, :, k:k), force, &
               counts=crossed, shares=shares)
            do c = 1, size(structure%cuts)
               associate (plane => structure%cuts(c), total => results%cut_resultants(:, c))
                  total = total + crossed_resultants(model%mesh, plane, mode, shares(:, :, :, 1)) &
                     - edge_load_excess(model, plane, mode, case_factor) &
                     - springs(:, m, c) - joints(:, m, c) &
                     - mass_excess(model, plane, mode, case_factor)
               end associate
            end do
         end associate
      end do
   end subroutine cut_resultants

   !> What nodal forces of springs and joints count too much, in all modes at once: shapes and directions are those of all
   subroutine displaced_excess(model, structure, places, field, results, springs, joints)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints, springs and cuts
      type(structure_type), intent(in) :: structure
      !> Places of the modes that count
      integer, intent(in) :: places(:)
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Results with displacements
      class(fields_type), intent(in) :: results
      !> Resultants, shape (n_resultants, these modes, cuts)
      real(wp), allocatable, intent(out) :: springs(:, :, :), joints(:, :, :)

      type(mode_type) :: modes(size(places))
      real(wp), allocatable :: stress(:, :, :), displacement(:, :, :)
      integer :: first(n_joints(model%mesh))
      integer :: c, i, m

      modes = results%modes(places)
      displacement = results%displacement(:, :, places)
      allocate (stress(3, size(structure%joint_points), size(places)))
      do m = 1, size(places)
         stress(:, :, m) = stress_amplitude(structure%joint_points, modes(m), displacement(:, :, m), field, places(m))
      end do
      do i = size(structure%joint_points), 1, -1
         first(structure%joint_points(i)%joint) = i
      end do
      allocate (springs(n_resultants, size(places), size(structure%cuts)))
      allocate (joints, mold=springs)
      do c = 1, size(structure%cuts)
         associate (plane => structure%cuts(c)%plane_type)
            springs(:, :, c) = spring_excess(model, plane, modes, displacement)
            joints(:, :, c) = joint_excess(model, plane, modes, first, stress)
         end associate
      end do
   end subroutine displaced_excess

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
