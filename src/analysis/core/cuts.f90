!> Resultants of the stresses on cuts z = const
module axijoint_analysis_core_cuts
   use axijoint_analysis_core_cut_loads, only : plane_type, edge_load_excess, spring_excess, &
      joint_excess, mass_excess, resultants_above
   use axijoint_analysis_core_fields, only : fields_type, n_resultants
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_solid_force, only : solid_force
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_elements, n_nodes
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : cut_type
   implicit none
   private
   public :: cut_resultants

   !> Nodes this near to a cut, over the extent of the mesh, are on it
   real(wp), parameter :: on_cut = 1.0e-9_wp

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
      !> Joints and springs
      type(structure_type), intent(in) :: structure
      !> Loads at the end
      type(loading_type), intent(in) :: loading
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Results; displacements are there already
      class(fields_type), intent(inout) :: results

      type(plane_type), allocatable :: planes(:)
      real(wp), allocatable :: force(:, :, :), shares(:, :, :, :), stress(:, :)
      logical, allocatable :: crossed(:)
      integer :: k, c

      allocate (results%cut_resultants(n_resultants, size(model%cuts)), source=0.0_wp)
      if (size(model%cuts) == 0) return
      allocate (force(3, n_nodes(model%mesh), 1))
      allocate (shares(3, max_element_nodes, n_elements(model%mesh), 1))
      allocate (crossed(n_elements(model%mesh)), source=.false.)
      allocate (planes(size(model%cuts)))
      do c = 1, size(planes)
         planes(c) = new_plane(model, model%cuts(c))
         crossed(planes(c)%crossed) = .true.
      end do
      do k = 1, size(results%modes)
         if (results%modes(k)%harmonic > 1) cycle  ! no resultants
         associate (mode => results%modes(k), displacement => results%displacement(:, :, k), &
                    case_factor => loading%case_factor)
            stress = stress_amplitude(structure%joint_points, mode, displacement, field, k)
            call solid_force(model, loading%initial, k, [mode], results%displacement(:, :, k:k), force, &
               counts=crossed, shares=shares)
            do c = 1, size(planes)
               associate (plane => planes(c), total => results%cut_resultants(:, c))
                  total = total + crossed_resultants(model%mesh, plane, mode, shares(:, :, :, 1)) &
                     - edge_load_excess(model, plane, mode, case_factor) &
                     - spring_excess(model, plane, mode, displacement) &
                     - joint_excess(model, plane, mode, stress) &
                     - mass_excess(model, plane, mode, case_factor)
               end associate
            end do
         end associate
      end do
   end subroutine cut_resultants

   !> Resultants of the forces of the elements that a cut passes through, on their nodes above it
   pure function crossed_resultants(mesh, plane, mode, shares) result(total)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The cut
      type(plane_type), intent(in) :: plane
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
               total = total + resultants_above(plane, mode, mesh%element_nodes(:n, element), shares(:, :n, element))
            end associate
         end associate
      end do
   end function crossed_resultants

   !> Nodes above and below a cut. A node on the cut is below it: loads there act
   !> below; but at the top of what is cut they act above
   pure function new_plane(model, cut) result(plane)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(cut_type), intent(in) :: cut
      !> The nodes
      type(plane_type) :: plane

      logical, allocatable :: crossed(:)
      real(wp) :: tolerance
      integer :: element

      allocate (plane%cut(n_nodes(model%mesh)), source=.false.)
      do element = 1, n_elements(model%mesh)
         if (cut%body > 0 .and. model%mesh%element_body(element) /= cut%body) cycle
         plane%cut(model%mesh%element_nodes(:model%mesh%element_size(element), element)) = .true.
      end do
      associate (x => model%mesh%coordinates)
         tolerance = on_cut*maxval(maxval(x, 2) - minval(x, 2))
         plane%position = x
         plane%position(2, :) = x(2, :) - cut%z
      end associate
      plane%above = plane%position(2, :) > tolerance
      if (.not. any(plane%above .and. plane%cut)) plane%above = plane%position(2, :) >= -tolerance
      allocate (crossed(n_elements(model%mesh)), source=.false.)
      do element = 1, size(crossed)
         if (cut%body > 0 .and. model%mesh%element_body(element) /= cut%body) cycle
         associate (above => plane%above(model%mesh%element_nodes(:model%mesh%element_size(element), element)))
            crossed(element) = any(above) .and. .not. all(above)
         end associate
      end do
      plane%crossed = pack([(element, element=1, size(crossed))], crossed)
   end function new_plane

end module axijoint_analysis_core_cuts
