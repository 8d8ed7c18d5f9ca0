!> The discretization error of a run: energy norm, displacements, joint stresses
module axijoint_analysis_error_discretization
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_named_points, only : largest_error_at_points
   use axijoint_analysis_core_fields, only : peak_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest, largest_vector, of_component
   use axijoint_analysis_core_watched_lines, only : largest_on_lines, amplitude_on_lines
   use axijoint_analysis_core_watched_stress, only : watched_values
   use axijoint_analysis_error_cut_errors, only : n_kinds, sizes_on_cuts
   use axijoint_analysis_error_largest_stress, only : largest_elastic_stress
   use axijoint_analysis_error_rounding, only : is_slight, rounding_energy, rounding_stress
   use axijoint_analysis_error_solid_error, only : solid_errors
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type, away_from_infinite, error_over_difference
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_support, only : support_point_type, add_support_force
   use axijoint_base_kinds, only : wp, pi
   use axijoint_fe_mode, only : mode_type, mode_integral
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_residual, only : ratio
   use axijoint_model_model, only : model_type, can_yield_at
   implicit none
   private
   public :: estimate_discretization

   !> Part of the largest stress that joints that yield had in any increment, all over their area: forces below it are rests of
   !> larger ones, and known no better than those
   real(wp), parameter :: little = 1.0e-4_wp

contains

   !> Estimate the discretization error
   subroutine estimate_discretization(model, structure, loading, field, yielding_stress, elastic_displacement, &
      mesh_error, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints and springs
      type(structure_type), intent(in) :: structure
      !> The loads
      type(loading_type), intent(in) :: loading
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Stress that errors of joints that yield are measured by; zero if none can
      real(wp), intent(in) :: yielding_stress
      !> Displacement that errors are measured by at least; zero if no joints yield
      real(wp), intent(in) :: elastic_displacement
      !> Errors of the displacements of nodes, and of joints that yield
      type(mesh_error_type), intent(in) :: mesh_error
      !> Results, stresses and all; takes the estimate
      type(results_type), intent(inout) :: results

      real(wp), allocatable :: error(:, :), energy(:, :), in_joints(:), carried(:), total(:, :, :)
      real(wp) :: start
      integer :: k

      start = omp_get_wtime()
      call solid_errors(model, structure%equations, loading%initial, results%displacement, &
         results%stress, error, energy)
      call note_joints(structure, field, yielding_stress, results, in_joints, carried)
      associate (estimate => results%discretization)
         if (mesh_error%known) call raise_to_difference(mesh_error%energy, error)
         associate (moved => maxval(abs(results%displacement)), left => sum(error, 2))
            if (is_slight(model, moved, minval(left, left > 0.0_wp))) call take_rounding_away( &
               rounding_energy(model, structure, loading%initial, moved), sum(energy, 2) + in_joints, error)
         end associate
         estimate%error_energy = sum(error, 2)
         estimate%energy = sum(energy, 2) + in_joints + [(spring_energy(structure%support_points, results%modes(k), &
            results%displacement(:, :, k)), k=1, size(results%modes))]
         estimate%mode_relative = sqrt(ratio(estimate%error_energy, estimate%energy))
         estimate%relative = sqrt(ratio(sum(estimate%error_energy), sum(estimate%energy)))
         estimate%element = ratio(sum(error, 1), sum(estimate%energy))
         total = results%displacement
         if (size(field%offset) > 0) &
            call add_motions(structure%condensed%floating, field%offset, total)
         estimate%largest_displacement = largest_vector(results%modes, total)
         estimate%displacement = -1.0_wp
         allocate (estimate%at_points(size(model%points)), source=-1.0_wp)
         allocate (estimate%on_cuts(n_kinds, size(model%cuts)), source=-1.0_wp)
         call note_lines(structure, results)
         estimate%joint_stress = -1.0_wp
         if (mesh_error%known) then
            estimate%displacement = ratio(largest_vector(results%modes, mesh_error%displacement), &
                                          max(estimate%largest_displacement, elastic_displacement))
            estimate%at_points = largest_error_at_points(model%points, results%modes, mesh_error%displacement)
            if (allocated(mesh_error%on_cuts)) where (spread(mesh_error%known_on_cuts, 1, n_kinds)) &
               estimate%on_cuts = sizes_on_cuts(mesh_error%on_cuts)
            if (allocated(mesh_error%on_lines)) &
               estimate%on_lines = largest_on_lines(structure%watched, results%modes, mesh_error%on_lines)
            if (results%at_rest) estimate%displacement = 0.0_wp
            estimate%joint_stress = joint_stress_error()
         end if
         estimate%seconds = structure%fine%seconds + mesh_error%seconds + omp_get_wtime() - start
      end associate

   contains

      !> Error of joint stresses, relative; negative if there are no joints or if it is not known
      real(wp) function joint_stress_error() result(error)
         real(wp) :: largest
         integer, allocatable :: elastic(:)

         error = -1.0_wp
         if (size(structure%joint_points) == 0) return
         largest = mesh_error%joint_stress
         if (size(structure%yielding) > 0 .and. largest < 0.0_wp) return
         elastic = pack([(k, k=1, size(structure%joint_points))], &
                        structure%judged .and. .not. can_yield_at(model, &
                        structure%joint_points%material))
         largest = max(0.0_wp, largest, largest_elastic_stress( &
            structure%joint_points(elastic), results%modes, mesh_error%jump(:, elastic, :)))
         associate (rounding => rounding_stress(structure%joint_points, results%discretization%largest_displacement, &
                                                size(results%displacement, 2)))
            if (all(carried <= rounding .or. .not. structure%judged) .and. largest <= maxval(rounding, structure%judged)) &
               largest = 0.0_wp
         end associate
         if (.not. all(structure%judged)) largest = away_from_infinite*largest
         error = ratio(largest, results%discretization%joint_scale)
      end function joint_stress_error

   end subroutine estimate_discretization

   !> Stresses along lines, which their errors are parts of
   subroutine note_lines(structure, results)
      !> What is watched
      type(structure_type), intent(in) :: structure
      !> Results with stresses at nodes; takes those along lines
      type(results_type), intent(inout) :: results

      real(wp), allocatable :: values(:, :, :)
      integer :: k

      if (.not. allocated(structure%watched)) return
      associate (estimate => results%discretization, watched => structure%watched)
         values = watched_values(watched%coarse, results%nodal)
         estimate%line_stress = largest_on_lines(watched, results%modes, values)
         estimate%line_amplitude = amplitude_on_lines(watched, values)
         estimate%line_points = reshape([(size(watched%lines(k)%values, 2), watched%lines(k)%n_points, k=1, size(watched%lines))], &
            [2, size(watched%lines)])
         allocate (estimate%on_lines(size(watched%lines)), source=-1.0_wp)
      end associate
   end subroutine note_lines

   !> Where patches see less than the difference to the fine mesh has, which is no more than the error has (Galerkin's solutions
   !> on nested meshes), let the errors of the elements come to what that tells in all: polynomials on patches take for smooth
   !> what grows towards a corner. Where in the mesh the error is, patches tell
   pure subroutine raise_to_difference(energy, error)
      !> Energy of the error by that of the difference, shape (modes)
      real(wp), intent(in) :: energy(:)
      !> Energy of the errors, shape (modes, elements)
      real(wp), intent(inout) :: error(:, :)

      integer :: k

      do k = 1, size(energy)
         associate (seen => sum(error(k, :)))
            if (seen > 0.0_wp .and. seen < energy(k)/error_over_difference) error(k, :) = energy(k)/seen*error(k, :)
         end associate
      end do
   end subroutine raise_to_difference

   !> Modes whose stresses are rounding have no errors of these
   pure subroutine take_rounding_away(rounding, energy, error)
      !> Energy that rounding may have, and that of the stresses, shape (modes)
      real(wp), intent(in) :: rounding(:), energy(:)
      !> Energy of the errors, shape (modes, elements)
      real(wp), intent(inout) :: error(:, :)

      integer :: k

      do k = 1, size(rounding)
         if (max(sum(error(k, :)), energy(k)) <= rounding(k)) error(k, :) = 0.0_wp
      end do
   end subroutine take_rounding_away

   !> Joints in each mode: energy and largest stress, and the stress that errors are measured by
   subroutine note_joints(structure, field, yielding_stress, results, energy, carried)
      !> Joints
      type(structure_type), intent(in) :: structure
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Stress that errors of joints that yield are measured by
      real(wp), intent(in) :: yielding_stress
      !> Results with stresses of joints; takes the stresses
      type(results_type), intent(inout) :: results
      !> Energy, shape (modes), and no less than the largest stress of each point, shape (points)
      real(wp), allocatable, intent(out) :: energy(:), carried(:)

      real(wp), allocatable :: stress(:, :, :)
      type(peak_type) :: peak
      integer :: i, k

      allocate (energy(size(results%modes)), source=0.0_wp)
      associate (estimate => results%discretization, points => structure%joint_points)
         estimate%joint_amplitude = energy
         allocate (carried(size(points)), source=0.0_wp)
         if (size(points) == 0) return
         allocate (stress(3, size(points), size(results%modes)))
         do k = 1, size(results%modes)
            stress(:, :, k) = stress_amplitude(points, results%modes(k), results%displacement(:, :, k), field, k)
            do i = 1, size(points)
               energy(k) = energy(k) + 0.5_wp*points(i)%weight*energy_density(stress(:, i, k), points(i)%stiffness)
               carried(i) = carried(i) + maxval(abs(stress(:, i, k)))
            end do
            energy(k) = mode_integral(results%modes(k))*energy(k)
            estimate%joint_amplitude(k) = max(0.0_wp, maxval(maxval(abs(stress(:, :, k)), 1), mask=structure%judged))
         end do
         if (size(structure%yielding) > 0) then
            estimate%least_force = little*yielding_stress*2.0_wp*pi*sum(points(structure%yielding)%weight)
            estimate%joint_scale = max(yielding_stress, &
               maxval(maxval(maxval(abs(results%joint_stress), 3), 1), mask=structure%judged))
         else
            peak = largest(results%modes, stress(:, pack([(i, i=1, size(points))], structure%judged), :), of_component)
            estimate%joint_scale = max(yielding_stress, peak%value)
         end if
      end associate
   end subroutine note_joints

   !> Energy of the springs in one mode
   pure real(wp) function spring_energy(supports, mode, displacement) result(energy)
      !> Points of the springs
      type(support_point_type), intent(in) :: supports(:)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)

      real(wp), allocatable :: force(:, :)

      allocate (force, mold=displacement)
      force = 0.0_wp
      call add_support_force(supports, mode%harmonic, displacement, force)
      energy = 0.5_wp*sum(force*displacement)
   end function spring_energy

   !> Twice the energy of a joint per area; a direction without stiffness has none
   pure real(wp) function energy_density(stress, stiffness) result(density)
      !> tau_xi, sigma, tau_theta
      real(wp), intent(in) :: stress(3)
      !> k_xi, k_eta, k_theta
      real(wp), intent(in) :: stiffness(3)

      integer :: i

      density = 0.0_wp
      do i = 1, 3
         if (stiffness(i) > 0.0_wp) density = density + stress(i)**2/stiffness(i)
      end do
   end function energy_density

end module axijoint_analysis_error_discretization
