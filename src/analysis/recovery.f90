!> Stresses, reactions and equilibrium from the displacements
module axijoint_analysis_recovery
   use axijoint_analysis_results, only : results_type, axial, lateral, moment, torque
   use axijoint_assembly_equations, only : equations_type, on_equations, worth_threads
   use axijoint_assembly_force, only : joint_force, joint_jump
   use axijoint_assembly_mechanism, only : solid_parts
   use axijoint_base_kinds, only : wp
   use axijoint_element_solid, only : solid_point_type, solid_points, solid_stress, &
                                      add_solid_force, isotropic_elasticity
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_joints_field, only : joint_field_type, elastic_stress
   use axijoint_joints_residual, only : ratio, load_norm
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_elements, n_nodes, max_element_nodes
   use axijoint_model_model, only : model_type, gauss_order, on_axis
   implicit none
   private
   public :: recover

contains

   !> Fill stresses, reactions, the residual ratio and the equilibrium error.
   !> All forces come from the stresses, point by point, not from the assembled
   !> matrices, so that the ratio judges the whole path from mesh to solution.
   subroutine recover(model, points, equations, load, factor, largest_factor, field, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Equations of the harmonics solved
      type(equations_type), intent(in) :: equations
      !> Loads for a factor of one, shape (3, nodes, harmonics)
      real(wp), intent(in) :: load(:, :, :)
      !> Load factor at the end, and the largest of the run: errors are measured
      !> by the largest load, which does not vanish with unloading
      real(wp), intent(in) :: factor, largest_factor
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Results; displacements are there already
      type(results_type), intent(inout) :: results

      real(wp), dimension(size(equations%harmonics)) :: unbalanced, scale
      real(wp), dimension(4, size(equations%harmonics)) :: resultant, reacted
      real(wp), allocatable :: unbalance(:, :, :)
      real(wp), allocatable :: internal(:, :), force(:, :)  ! threads have small stacks
      real(wp) :: largest_load(4)
      integer, allocatable :: part(:)
      integer :: k

      call new_points(model, results)
      call solid_parts(model%mesh, part)
      allocate (unbalance(4, maxval(part), size(equations%harmonics)))
      allocate (results%reaction, mold=results%displacement)
      !$omp parallel do schedule(dynamic) private(internal, force) if (worth_threads(equations))
      do k = 1, size(equations%harmonics)
         associate (m => equations%harmonics(k), reaction => results%reaction(:, :, k))
            force = factor*load(:, :, k)
            internal = force  ! for its shape
            call solid_fields(model, m, results%displacement(:, :, k), results%stress(:, :, k), &
                              internal)
            internal = internal + joint_force(points, m, admitted(k), size(internal, 2))
            unbalanced(k) = sum(on_equations(equations, k, force - internal)**2)/circle_integral(m)
            reaction = merge(internal - force, 0.0_wp, held(model, m))
            resultant(:, k) = rigid_resultants(model, m, load(:, :, k))
            reacted(:, k) = rigid_resultants(model, m, reaction)
            unbalance(:, :, k) = part_resultants(model, m, part, force - internal + reaction)
            scale(k) = largest_factor*sum(abs(load(:, :, k)))
         end associate
      end do
      !$omp end parallel do
      results%applied = factor*sum(resultant, 2)
      largest_load = largest_factor*sum(resultant, 2)
      results%reacted = sum(reacted, 2)
      results%part_unbalance = sum(unbalance, 3)
      results%part_node = [(findloc(part, k, 1), k=1, maxval(part))]
      results%residual_ratio = ratio(sqrt(sum(unbalanced)), &
                                     largest_factor*load_norm(equations, load))
      results%equilibrium_error = imbalance(model, largest_load, sum(scale), &
                                            reshape(results%applied + results%reacted, [4, 1]))
      results%part_error = imbalance(model, largest_load, sum(scale), results%part_unbalance)

   contains

      !> Joint stress amplitudes k d - e of one harmonic
      function admitted(k) result(stress)
         !> Place of the harmonic
         integer, intent(in) :: k
         !> The amplitudes, shape (3, joint points)
         real(wp) :: stress(3, size(points))

         real(wp), dimension(3, size(points), 1) :: jump

         jump(:, :, 1) = joint_jump(points, results%displacement(:, :, k))
         jump = elastic_stress(model, points, jump)
         stress = jump(:, :, 1) - field%excess(:, :, k)
      end function admitted

   end subroutine recover

   !> Place the Gauss points of all elements
   subroutine new_points(model, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Results that take elements and positions of the points
      type(results_type), intent(inout) :: results

      type(solid_point_type) :: points(9)
      integer :: element, n, last

      associate (mesh => model%mesh)
         n = 0
         do element = 1, n_elements(mesh)
            n = n + gauss_order(model, mesh%element_size(element))**2
         end do
         allocate (results%point_element(n), results%point_position(2, n))
         allocate (results%stress(6, n, size(results%harmonics)))
         last = 0
         do element = 1, n_elements(mesh)
            n = gauss_order(model, mesh%element_size(element))
            call solid_points(mesh%coordinates(:, &
                                          mesh%element_nodes(:mesh%element_size(element), element)), &
                              n, points(:n**2))
            do n = 1, n**2
               last = last + 1
               results%point_element(last) = element
               results%point_position(:, last) = points(n)%position
            end do
         end do
      end associate
   end subroutine new_points

   !> Stress amplitudes of one harmonic and the nodal forces that balance them
   subroutine solid_fields(model, harmonic, displacement, stress, force)
      !> The job
      type(model_type), intent(in) :: model
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Stress amplitudes at the Gauss points, shape (6, points)
      real(wp), intent(out) :: stress(:, :)
      !> Forces on components, shape (3, nodes)
      real(wp), intent(out) :: force(:, :)

      type(solid_point_type) :: points(9)
      real(wp) :: d(6, 6)
      real(wp), dimension(3, max_element_nodes) :: local, element_force
      integer :: element, n, n_gauss, k, last

      force = 0.0_wp
      last = 0
      do element = 1, n_elements(model%mesh)
         n = model%mesh%element_size(element)
         n_gauss = gauss_order(model, n)
         associate (nodes => model%mesh%element_nodes(:n, element), &
                    material => model%materials(model%mesh%element_material(element)))
            d = isotropic_elasticity(material%young, material%poisson)
            call solid_points(model%mesh%coordinates(:, nodes), n_gauss, points(:n_gauss**2))
            local(:, :n) = displacement(:, nodes)
            element_force = 0.0_wp
            do k = 1, n_gauss**2
               last = last + 1
               stress(:, last) = solid_stress(points(k), n, d, harmonic, local)
               call add_solid_force(points(k), n, harmonic, stress(:, last), element_force)
            end do
            force(:, nodes) = force(:, nodes) + circle_integral(harmonic)*element_force(:, :n)
         end associate
      end do
   end subroutine solid_fields

   !> Components that supports hold. On the axis the pole conditions hold the
   !> rest: only v in harmonic 0, and u and w together in harmonic 1, are left
   pure function held(model, harmonic)
      !> The job
      type(model_type), intent(in) :: model
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Shape (3, nodes)
      logical :: held(3, size(model%mesh%node_label))

      logical :: pole(size(model%mesh%node_label))

      held = model%fixed
      pole = on_axis(model%mesh)
      if (harmonic == 1) then
         held(1, :) = held(1, :) .or. pole .and. held(3, :)
         held(3, :) = held(3, :) .or. pole .and. held(1, :)
         held(2, :) = held(2, :) .and. .not. pole
      else
         held(1, :) = held(1, :) .and. .not. pole
         held(3, :) = held(3, :) .and. .not. pole
         if (harmonic > 1) held(2, :) = held(2, :) .and. .not. pole
      end if
   end function held

   !> Resultants of nodal forces of one harmonic: their work on unit rigid motions
   pure function rigid_resultants(model, harmonic, force) result(resultant)
      !> The job
      type(model_type), intent(in) :: model
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Generalized forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Axial and lateral force, moment, torque
      real(wp) :: resultant(4)

      resultant = 0.0_wp
      associate (r => model%mesh%coordinates(1, :), z => model%mesh%coordinates(2, :))
         select case (harmonic)
         case (0)
            resultant(axial) = sum(force(2, :))
         case (1)
            resultant(lateral) = sum(force(1, :) - force(3, :))
            resultant(moment) = sum(r*force(2, :) - z*(force(1, :) - force(3, :)))
         end select
      end associate
   end function rigid_resultants

   !> Resultants of nodal forces of one harmonic on each part
   pure function part_resultants(model, harmonic, part, force) result(resultant)
      !> The job
      type(model_type), intent(in) :: model
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Part of each node
      integer, intent(in) :: part(:)
      !> Generalized forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Axial and lateral force, moment, torque, shape (4, parts)
      real(wp) :: resultant(4, maxval(part))

      integer :: k

      resultant = 0.0_wp
      if (harmonic > 1) return  ! no resultants
      do k = 1, size(resultant, 2)
         resultant(:, k) = rigid_resultants(model, harmonic, &
                                            merge(force, 0.0_wp, spread(part == k, 1, 3)))
      end do
   end function part_resultants

   !> Largest resultant out of balance: forces over the largest resultant force
   !> of the loads, moments over the largest moment. Where the loads have no
   !> resultant, the sum of their sizes stands for it.
   pure function imbalance(model, applied, scale, unbalance) result(error)
      !> The job
      type(model_type), intent(in) :: model
      !> Resultants of the loads
      real(wp), intent(in) :: applied(4)
      !> Sum of the absolute generalized forces applied
      real(wp), intent(in) :: scale
      !> Resultants out of balance, shape (4, any)
      real(wp), intent(in) :: unbalance(:, :)
      !> The error
      real(wp) :: error

      !> Resultants below this share of the forces are taken for zero
      real(wp), parameter :: no_resultant = 1.0e-6_wp
      real(wp) :: force, turning

      force = maxval(abs(applied([axial, lateral])))
      if (force <= no_resultant*scale) force = scale
      turning = max(maxval(abs(applied([moment, torque]))), &
                    force*maxval(abs(model%mesh%coordinates)))
      error = max(ratio(maxval(abs(unbalance([axial, lateral], :))), force), &
                  ratio(maxval(abs(unbalance([moment, torque], :))), turning))
   end function imbalance

end module axijoint_analysis_recovery
