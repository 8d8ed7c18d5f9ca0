!> Stresses, reactions and equilibrium from the displacements
module axijoint_analysis_core_recovery
   use omp_lib, only : omp_get_max_threads
   use axijoint_analysis_core_fields, only : fields_type, axial, lateral, moment, torque, lateral_90, moment_90, n_resultants
   use axijoint_analysis_core_rigid, only : rigid_resultants
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_equations, only : equations_type, on_equations, worth_threads, own_modes
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_rigid_motion, only : solid_parts
   use axijoint_assembly_solid_force, only : solid_force
   use axijoint_assembly_support, only : add_support_force
   use axijoint_base_kinds, only : wp, i8
   use axijoint_fe_mode, only : mode_type, same_mode, mode_integral, is_torsion, family_symmetric
   use axijoint_fe_reference, only : reference_type
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   use axijoint_joints_residual, only : ratio, load_norm
   use axijoint_model_mesh, only : n_elements, n_nodes, element_references
   use axijoint_model_model, only : model_type, held_components, on_axis
   implicit none
   private
   public :: recover

contains

   !> Fill stresses, reactions, the residual ratio and the equilibrium error.
   !> All forces come from the stresses, point by point, not from the assembled
   !> matrices, so that the ratio judges the whole path from mesh to solution.
   subroutine recover(model, structure, loading, peak, field, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints, springs, equations
      type(structure_type), intent(in) :: structure
      !> Loads at the end, and the largest of the run: errors are measured by the
      !> largest, which do not vanish with unloading
      type(loading_type), intent(in) :: loading, peak
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Results; displacements are there already
      class(fields_type), intent(inout) :: results

      real(wp), dimension(size(results%modes)) :: unbalanced, scale
      real(wp), dimension(n_resultants, size(results%modes)) :: applied, resultant, reacted
      real(wp), allocatable :: unbalance(:, :, :)
      integer, allocatable :: part(:)
      integer :: k, own(2)

      call new_points(model, results)
      call solid_parts(model%mesh, part)
      own = own_modes(structure%equations)
      allocate (unbalance(n_resultants, maxval(part), size(results%modes)))
      allocate (results%reaction, results%acting, results%taken, mold=results%displacement)
      call find_solid_forces(model, structure, loading, results)
      !$omp parallel do schedule(dynamic) if (worth_threads(structure%equations))
      do k = own(1), own(2)
         call balance(results%modes(k), k)
      end do
      !$omp end parallel do
      call share_fields(structure%equations, results)
      call share(structure%equations, unbalanced, size(unbalanced, kind=i8))
      call share(structure%equations, scale, size(scale, kind=i8))
      call share(structure%equations, applied, size(applied, kind=i8))
      call share(structure%equations, resultant, size(resultant, kind=i8))
      call share(structure%equations, reacted, size(reacted, kind=i8))
      call share(structure%equations, unbalance, size(unbalance, kind=i8))
      results%applied = sum(applied, 2)
      results%reacted = sum(reacted, 2)
      results%part_unbalance = sum(unbalance, 3)
      results%part_node = [(findloc(part, k, 1), k=1, maxval(part))]
      results%residual_ratio = ratio(sqrt(sum(unbalanced)), &
                                     load_norm(structure%equations, peak))
      associate (largest => sum(resultant, 2), &
                 whole => reshape(results%applied + results%reacted, [n_resultants, 1]))
         results%equilibrium_error = imbalance(model, largest, sum(scale), whole)
         results%part_error = imbalance(model, largest, sum(scale), results%part_unbalance)
      end associate

   contains

      !> Reactions of one mode, what is left of its loads, and what these are measured by
      subroutine balance(mode, k)
         !> The mode, and its place
         type(mode_type), intent(in) :: mode
         integer, intent(in) :: k

         ! threads' stacks are small
         real(wp), allocatable :: left(:, :), joints(:, :), spring(:, :)
         logical, allocatable :: is_held(:, :)
         integer :: i, node

         spring = spring_force(structure, mode, results%displacement(:, :, k))
         joints = joint_force(structure%joint_points, mode%harmonic, &
            stress_amplitude(structure%joint_points, mode, results%displacement(:, :, k), field, k), size(spring, 2))
         is_held = held(model, mode)
         allocate (left(3, size(spring, 2)))
         do node = 1, size(left, 2)
            do i = 1, 3
               results%taken(i, node, k) = results%taken(i, node, k) + spring(i, node)
               left(i, node) = loading%external(i, node, k) - results%taken(i, node, k) - joints(i, node)
               results%reaction(i, node, k) = merge(-left(i, node), 0.0_wp, is_held(i, node))
               results%acting(i, node, k) = loading%external(i, node, k) + results%reaction(i, node, k)
            end do
         end do
         unbalanced(k) = sum(on_equations(structure%equations, k, left)**2)/mode_integral(mode)
         scale(k) = 0.0_wp  ! displacements and temperatures load without external forces
         do node = 1, size(left, 2)
            do i = 1, 3
               left(i, node) = left(i, node) + results%reaction(i, node, k)
               results%reaction(i, node, k) = results%reaction(i, node, k) - spring(i, node)
               scale(k) = scale(k) + abs(peak%external(i, node, k)) &
                  + abs(peak%right(i, node, k) - peak%external(i, node, k))
            end do
         end do
         associate (x => model%mesh%coordinates)
            applied(:, k) = rigid_resultants(x, mode, loading%external(:, :, k))
            resultant(:, k) = rigid_resultants(x, mode, peak%external(:, :, k))
            reacted(:, k) = rigid_resultants(x, mode, results%reaction(:, :, k))
         end associate
         unbalance(:, :, k) = part_resultants(model, mode, part, left)
      end subroutine balance

   end subroutine recover

   !> Nodal forces that hold the springs in one mode
   function spring_force(structure, mode, displacement) result(force)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Forces on components, same shape
      real(wp), allocatable :: force(:, :)

      allocate (force, mold=displacement)
      force = 0.0_wp
      call add_support_force(structure%support_points, mode%harmonic, displacement, force)
   end function spring_force

   !> Stresses of the solids, and the nodal forces that balance them
   subroutine find_solid_forces(model, structure, loading, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Equations, for the modes of this rank
      type(structure_type), intent(in) :: structure
      !> Loads, for the stress without strain
      type(loading_type), intent(in) :: loading
      !> Results with displacements; take the stresses, and the forces in what solids and springs take
      class(fields_type), intent(inout) :: results

      integer :: k, last, own(2), width

      own = own_modes(structure%equations)
      ! something to do for each thread; a rank may have no modes
      width = 1 + max(0, own(2) - own(1))/omp_get_max_threads()
      !$omp parallel do schedule(dynamic) private(last) if (worth_threads(structure%equations))
      do k = own(1), own(2), width
         last = min(k + width - 1, own(2))
         call solid_force(model, loading%initial, k, results%modes(k:last), &
            results%displacement(:, :, k:last), results%taken(:, :, k:last), &
            results%stress(:, :, k:last))
      end do
      !$omp end parallel do
   end subroutine find_solid_forces

   !> Let all ranks know the fields that were found mode by mode
   subroutine share_fields(equations, results)
      !> The equations, for the modes of each rank
      type(equations_type), intent(in) :: equations
      !> The fields
      class(fields_type), intent(inout) :: results

      call share(equations, results%reaction, size(results%reaction, kind=i8))
      call share(equations, results%acting, size(results%acting, kind=i8))
      call share(equations, results%taken, size(results%taken, kind=i8))
      call share(equations, results%stress, size(results%stress, kind=i8))
   end subroutine share_fields

   !> Let all ranks know what was found mode by mode
   subroutine share(equations, values, n)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Values of the modes, one mode after the other
      integer(i8), intent(in) :: n
      real(wp), intent(inout) :: values(n)

      call equations%team%gather(values, n, equations%last_mode)
   end subroutine share

   !> Place the Gauss points of all elements
   subroutine new_points(model, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Results that take elements and positions of the points
      class(fields_type), intent(inout) :: results

      type(reference_type), allocatable :: references(:)
      integer :: element, n, last

      associate (mesh => model%mesh)
         references = element_references(model%mesh)
         n = sum(references(mesh%element_kind)%n_points)
         allocate (results%point_element(n), results%point_position(2, n))
         allocate (results%stress(6, n, size(results%modes)))
         last = 0
         do element = 1, n_elements(mesh)
            associate (reference => references(mesh%element_kind(element)))
               n = reference%n_points
               results%point_element(last + 1:last + n) = element
               results%point_position(:, last + 1:last + n) = matmul(mesh%coordinates(:, &
                  mesh%element_nodes(:reference%n_nodes, element)), &
                  reference%shape(:reference%n_nodes, :n))
               last = last + n
            end associate
         end do
      end associate
   end subroutine new_points

   !> Components that supports hold. On the axis the pole conditions hold the
   !> rest: only v in harmonic 0, and u and w together in harmonic 1, are left
   pure function held(model, mode)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Shape (3, nodes)
      logical :: held(3, size(model%mesh%node_label))

      logical :: pole(size(model%mesh%node_label))

      held = held_components(model, mode)
      if (is_torsion(mode)) then
         held(1:2, :) = .false.
      else if (mode%harmonic == 0) then
         held(3, :) = .false.
      end if
      pole = on_axis(model%mesh)
      if (mode%harmonic == 1) then
         held(1, :) = held(1, :) .or. pole .and. held(3, :)
         held(3, :) = held(3, :) .or. pole .and. held(1, :)
         held(2, :) = held(2, :) .and. .not. pole
      else
         held(1, :) = held(1, :) .and. .not. pole
         held(3, :) = held(3, :) .and. .not. pole
         if (mode%harmonic > 1) held(2, :) = held(2, :) .and. .not. pole
      end if
   end function held

   !> Resultants of nodal forces of one mode on each part
   pure function part_resultants(model, mode, part, force) result(resultant)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Part of each node
      integer, intent(in) :: part(:)
      !> Generalized forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> The resultants, shape (n_resultants, parts)
      real(wp) :: resultant(n_resultants, maxval(part))

      integer, allocatable :: nodes(:)
      integer :: i, k

      resultant = 0.0_wp
      if (mode%harmonic > 1) return  ! no resultants
      do k = 1, size(resultant, 2)
         nodes = pack([(i, i=1, size(part))], part == k)
         resultant(:, k) = rigid_resultants(model%mesh%coordinates(:, nodes), mode, force(:, nodes))
      end do
   end function part_resultants

   !> Largest resultant out of balance: forces over the largest resultant force
   !> of the loads, moments over the largest moment. Where the loads have no
   !> resultant, the sum of their sizes stands for it.
   pure function imbalance(model, applied, scale, unbalance) result(error)
      !> The job
      type(model_type), intent(in) :: model
      !> Resultants of the loads
      real(wp), intent(in) :: applied(n_resultants)
      !> Sum of the absolute generalized forces applied
      real(wp), intent(in) :: scale
      !> Resultants out of balance, shape (n_resultants, any)
      real(wp), intent(in) :: unbalance(:, :)
      !> The error
      real(wp) :: error

      !> Resultants below this share of the forces are taken for zero
      real(wp), parameter :: no_resultant = 1.0e-6_wp
      real(wp) :: force, turning

      force = maxval(abs(applied([axial, lateral, lateral_90])))
      if (force <= no_resultant*scale) force = scale
      turning = max(maxval(abs(applied([moment, torque, moment_90]))), &
                    force*maxval(abs(model%mesh%coordinates)))
      error = max(ratio(maxval(abs(unbalance([axial, lateral, lateral_90], :))), force), &
                  ratio(maxval(abs(unbalance([moment, torque, moment_90], :))), turning))
   end function imbalance

end module axijoint_analysis_core_recovery
