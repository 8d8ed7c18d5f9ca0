!> Errors of a job whose joints yield in relative numbers: what they are measured by
module axijoint_analysis_error_joint_shares
   use omp_lib, only : omp_get_wtime
   use axijoint_analysis_core_named_points, only : at_points, largest_error_at_points
   use axijoint_analysis_core_results, only : results_type, error_share_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_analysis_error_largest_stress, only : largest_elastic_stress
   use axijoint_analysis_error_rounding, only : rounding_stress
   use axijoint_assembly_force, only : joint_jump
   use axijoint_base_kinds, only : wp
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_change, only : joint_change_type
   use axijoint_joints_residual, only : ratio
   use axijoint_joints_scene, only : elastic_stress
   use axijoint_model_request, only : point_type
   implicit none
   private
   public :: take_share, nothing_is_left, has_moved, unloaded, displacement_scale, elastic_points, yielding_scale, held_share, &
      least_changes

   !> Displacements below this part of those with elastic joints are rounding: all loads were taken
   !> away
   real(wp), parameter :: none = 1.0e-9_wp
   !> Part of them that errors are measured by where no load is left, and how many times its tolerance a state claims
   real(wp), parameter :: slight = 1.0e-2_wp, claimed = 10.0_wp
   !> Errors of joint stress are measured by no less than this part of what joints would carry if they held, and this part of
   !> the largest stress anywhere: where contact is by a few points, those that are judged may carry nothing
   real(wp), parameter :: small = 1.0e-6_wp, of_largest = 0.1_wp

contains

   !> An error in relative numbers
   subroutine take_share(structure, history, results, largest, change, effect, share, points)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Results with displacements
      type(results_type), intent(in) :: results
      !> Largest displacement
      real(wp), intent(in) :: largest
      !> The change of the joints
      type(joint_change_type), intent(in) :: change
      !> Displacements that it makes but for rigid motions of floating parts, shape (3, nodes, modes)
      real(wp), intent(in) :: effect(:, :, :)
      !> Takes stress, displacement and time
      type(error_share_type), intent(inout) :: share
      !> Points with names; none if absent
      type(point_type), intent(in), optional :: points(:)

      real(wp), allocatable :: displacement(:, :, :)
      real(wp) :: start, stress, scale, least

      start = omp_get_wtime()
      share%seconds = change%seconds
      if (.not. change%known) return
      displacement = effect
      call add_motions(structure%condensed%floating, change%offset, displacement)
      stress = elastic_change(structure, displacement)
      scale = stress_scale(structure, history, results%displacement)
      least = minval(rounding_stress(structure%joint_points(elastic_points(structure)), history%largest_elastic, &
                                     size(displacement, 2)))
      if (max(stress, scale) <= least) stress = 0.0_wp  ! of all joints, the softest too
      share%joint_stress = ratio(max(change%stress, stress), scale)
      share%displacement = ratio(largest_vector(results%modes, displacement) + change%beyond, &
                                 displacement_scale(history, largest))
      if (present(points)) share%at_points = largest_error_at_points(points, results%modes, displacement) + &
         change%beyond*part_of_jumps(points, structure, results)
      share%seconds = share%seconds + omp_get_wtime() - start
   end subroutine take_share

   !> Displacements of points over the largest jumps of joints, in harmonics above M: no more than in those above M/2, since
   !> higher ones reach less far; none where a point is held, or on the axis, which harmonics above 1 do not move
   function part_of_jumps(points, structure, results) result(part)
      !> Points with names
      type(point_type), intent(in) :: points(:)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Results with displacements
      type(results_type), intent(in) :: results
      !> Shape (points); 1 where no harmonic tells
      real(wp) :: part(size(points))

      real(wp) :: moved(3, size(points), size(results%modes)), jump
      integer :: k, p

      jump = 0.0_wp
      part = 0.0_wp
      moved = at_points(points, results%displacement)
      do k = 1, size(results%modes)
         associate (m => results%modes(k)%harmonic)
            if (m <= 1 .or. 2*m <= maxval(results%modes%harmonic)) cycle  ! bodies move without strain up to 1
         end associate
         jump = max(jump, maxval(norm2(joint_jump(structure%joint_points, results%displacement(:, :, k)), 1)))
         part = max(part, [(norm2(moved(:, p, k)), p=1, size(points))])
      end do
      part = min(1.0_wp, ratio(part, jump))
      if (.not. jump > 0.0_wp) part = 1.0_wp
      if (maxval(results%modes%harmonic) > 0) where (points%position(1) <= 0.0_wp) part = 0.0_wp
      where ([(maxval(abs(moved(:, p, :))) <= 0.0_wp, p=1, size(points))]) part = 0.0_wp
   end function part_of_jumps

   !> Whether displacements and stress of joints were taken away, with all loads as far as the tolerance
   !> goes. Then bodies that joints alone held may stand anywhere, and there is nothing that an error is a
   !> part of
   logical function nothing_is_left(structure, history, results) result(none_left)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Results with displacements
      type(results_type), intent(in) :: results

      real(wp) :: little
      integer :: j

      little = none
      if (unloaded(history)) little = max(none, claimed*results%tolerance)
      none_left = maxval(abs(results%displacement)) <= little*history%largest_elastic
      if (none_left) none_left = maxval([(maxval(abs(history%field%stress(:, :, j) - history%field%initial)), &
         j=1, size(history%field%stress, 3))]) <= little*yielding_scale(structure, history)
   end function nothing_is_left

   !> Whether bodies that joints alone hold stand elsewhere than at first. That is as wrong as the mesh was under the loads
   !> that moved them
   logical function has_moved(structure, history)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history

      real(wp), allocatable :: motion(:, :, :)

      allocate (motion(3, size(history%loading%right, 2), size(structure%modes)), source=0.0_wp)
      call add_motions(structure%condensed%floating, history%field%offset, motion)
      has_moved = maxval(abs(motion)) > none*history%largest_elastic
   end function has_moved

   !> Whether all loads were taken away
   pure logical function unloaded(history)
      !> What the increments came to
      type(history_type), intent(in) :: history

      unloaded = history%load_norm <= none*history%peak_norm
   end function unloaded

   !> Displacement that errors are measured by: where no load is left, at least a small part of what the largest loads would
   !> give if all joints held
   pure real(wp) function displacement_scale(history, largest) result(scale)
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Largest displacement
      real(wp), intent(in) :: largest

      scale = max(largest, merge(slight, none, unloaded(history))*history%largest_elastic)
   end function displacement_scale

   !> Changes of the stress of joints that yield up to which they are none: rounding, and all where stress is not judged
   pure function least_changes(structure, history) result(least)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Stress, shape (points)
      real(wp) :: least(size(structure%yielding))

      least = rounding_stress(structure%joint_points(structure%yielding), history%largest_elastic, size(history%loading%right, 2))
      where (.not. structure%judged(structure%yielding)) least = huge(1.0_wp)
   end function least_changes

   !> Largest stress of elastic joints that displacements give, where it is judged
   function elastic_change(structure, displacement) result(largest)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The stress
      real(wp) :: largest

      real(wp), allocatable :: jump(:, :, :)
      integer :: k

      associate (points => structure%joint_points(elastic_points(structure)))
         allocate (jump(3, size(points), size(displacement, 3)))
         do k = 1, size(displacement, 3)
            jump(:, :, k) = joint_jump(points, displacement(:, :, k))
         end do
         largest = largest_elastic_stress(points, structure%modes, jump)
      end associate
   end function elastic_change

   !> Points of elastic joints whose stress is judged
   pure function elastic_points(structure) result(places)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Places among all joint points
      integer, allocatable :: places(:)

      logical :: elastic(size(structure%joint_points))
      integer :: k

      elastic = structure%judged
      elastic(structure%yielding) = .false.
      places = pack([(k, k=1, size(elastic))], elastic)
   end function elastic_points

   !> Largest joint stress that is judged: of joints that yield in all increments, of others at the
   !> end
   function stress_scale(structure, history, displacement) result(scale)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The stress
      real(wp) :: scale

      scale = max(yielding_scale(structure, history), &
                  elastic_change(structure, displacement))
   end function stress_scale

   !> Largest stress of joints that yield, where it is judged, in all increments; at least a part of the largest anywhere, and a
   !> small part of what they would carry if they held: what loads press on joints that are about to close may be rounding
   function yielding_scale(structure, history) result(scale)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The stress
      real(wp) :: scale

      scale = maxval([0.0_wp, pack(history%largest_stress, structure%judged(structure%yielding)), &
                      of_largest*history%largest_stress, small*held_stress(structure, history)])
   end function yielding_scale

   !> Largest stress that joints would carry if they held, where it is judged
   function held_stress(structure, history) result(stress)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The stress: amplitudes of all modes together
      real(wp) :: stress

      associate (amplitude => elastic_stress(structure%condensed, history%scene, history%field))
         stress = maxval([0.0_wp, pack(maxval(sum(abs(amplitude), 3), 1), &
                                       structure%judged(structure%yielding))])
      end associate
   end function held_stress

   !> The same over the stress that errors are measured by: large where loads hardly close the joints
   function held_share(structure, history) result(share)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The share
      real(wp) :: share

      share = ratio(held_stress(structure, history), yielding_scale(structure, history))
   end function held_share

end module axijoint_analysis_error_joint_shares
