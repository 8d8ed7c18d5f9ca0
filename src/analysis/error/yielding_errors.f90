!> What the approximations leave of the error of a job whose joints yield: the iteration, planes,
!> harmonics and the mesh, each by a state found again without it
module axijoint_analysis_error_yielding_errors
   use omp_lib, only : omp_get_max_threads, omp_get_wtime
   use axijoint_analysis_core_results, only : results_type, error_share_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_analysis_error_excess_bound, only : bound_excess_effect
   use axijoint_analysis_error_excess_effect, only : add_excess_effect
   use axijoint_analysis_error_largest_stress, only : largest_elastic_stress
   use axijoint_analysis_fine_difference, only : difference_type, new_difference, &
      room_type, find_difference, share_difference
   use axijoint_analysis_fine_joints, only : fine_excess
   use axijoint_analysis_fine_level, only : fine_level_type, fine_load_type, new_fine_load
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type, new_mesh_error
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, &
      release_factor
   use axijoint_assembly_force, only : joint_jump
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type
   use axijoint_joints_joint_errors, only : joint_change_type, joint_changes_type, &
      find_joint_changes, change_between, &
                                           largest_change
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, settle
   use axijoint_joints_residual, only : ratio
   use axijoint_joints_scene, only : scene_type, elastic_stress
   use axijoint_joints_settle, only : settle_wholly, find_again
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: estimate_yielding_errors, iteration_error, held_share, yielding_scale

   !> Displacements below this part of those with elastic joints are rounding: all loads were taken
   !> away
   real(wp), parameter :: none = 1.0e-9_wp
   !> Part of them that errors are measured by where no load is left, and how many times its tolerance a state claims
   real(wp), parameter :: slight = 1.0e-2_wp, claimed = 10.0_wp
   !> Errors of joint stress are measured by no less than this part of what joints would carry if they held, and this part of
   !> the largest stress anywhere: where contact is by a few points, those that are judged may carry nothing
   real(wp), parameter :: small = 1.0e-6_wp, of_largest = 0.1_wp

contains

   !> Estimate all errors. The paper's loop is another approximation: its errors are the difference
   !> to equilibrium on total jumps, if that was found, and the errors of that
   subroutine estimate_yielding_errors(structure, history, other, results, mesh_error)
      !> The structure, condensed
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> That of Newton's method where the paper's loop was used
      type(joint_field_type), allocatable, intent(in) :: other
      !> Results with displacements; take the errors
      type(results_type), intent(inout) :: results
      !> Takes those of the mesh
      type(mesh_error_type), intent(out) :: mesh_error

      type(joint_field_type), allocatable :: balanced
      type(joint_changes_type) :: changes
      type(joint_change_type) :: iteration(1)
      real(wp), allocatable :: displacement(:, :, :), of_iteration(:, :, :, :), others(:, :, :, :)
      real(wp) :: start, largest
      logical :: judged

      start = omp_get_wtime()
      judged = results%converged
      if (judged) judged = .not. nothing_is_left(structure, history, results)
      associate (condensed => structure%condensed, scene => history%scene, field => history%field)
         if (.not. judged) then
            call mesh_error_of_held(structure, history, field, results%displacement, mesh_error)
            if (results%converged) mesh_error%known = mesh_error%known .and. .not. has_moved(structure, history)
            return
         else if (.not. history%method%accumulates) then
            allocate (balanced, source=field)
            balanced%memory = history%memory
         else if (allocated(other)) then
            allocate (balanced, source=other)
         else
            call mesh_error_of_held(structure, history, field, results%displacement, mesh_error)
            return
         end if
         call settle_wholly(condensed, scene, balanced)
         displacement = results%displacement
         call add_motions(condensed%floating, field%offset, displacement)
         largest = largest_vector(results%modes, displacement)
         iteration(1) = change_between(scene, field, balanced, structure%judged(structure%yielding))
         call find_effects(structure, size(displacement, 2), iteration, of_iteration)
         changes%iteration = iteration(1)
         changes%iteration%seconds = omp_get_wtime() - start
         displacement = results%displacement + of_iteration(:, :, :, 1)
         call find_other_changes(structure, history, balanced, displacement, changes, others, mesh_error)
         call take_share(structure, history, results, largest, changes%iteration, of_iteration(:, :, :, 1), &
            results%joint_errors(1))
         call take_share(structure, history, results, largest, changes%planes, others(:, :, :, 1), &
            results%joint_errors(2))
         call take_share(structure, history, results, largest, changes%harmonics, others(:, :, :, 2), &
            results%joint_errors(3))
         ! what slip has left is as wrong as the mesh was under the loads that are gone
         if (unloaded(history)) mesh_error%known = .false.
      end associate
   end subroutine estimate_yielding_errors

   !> What planes, harmonics and the mesh leave. They know nothing of each other: where threads have little to do in
   !> each, they are found at once
   subroutine find_other_changes(structure, history, balanced, displacement, changes, effect, mesh_error)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of the joints, balanced
      type(joint_field_type), intent(in) :: balanced
      !> Displacement amplitudes of that state, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Takes the changes by planes and harmonics
      type(joint_changes_type), intent(inout) :: changes
      !> What they do to the displacements, shape (3, nodes, modes, 2)
      real(wp), allocatable, intent(out) :: effect(:, :, :, :)
      !> Takes what the mesh leaves
      type(mesh_error_type), intent(out) :: mesh_error

      real(wp) :: seconds, share

      seconds = omp_get_wtime()
      if (is_small(structure%equations)) then
         !$omp parallel sections num_threads(2)
         !$omp section
         call see_mesh()
         !$omp section
         call see_joints()
         !$omp end parallel sections
      else  ! not in a region of one thread, in which other regions would begin with new threads
         call see_mesh()
         call see_joints()
      end if
      seconds = omp_get_wtime() - seconds
      share = seconds/max(tiny(1.0_wp), mesh_error%seconds + changes%planes%seconds + changes%harmonics%seconds)
      mesh_error%seconds = share*mesh_error%seconds
      changes%planes%seconds = share*changes%planes%seconds
      changes%harmonics%seconds = share*changes%harmonics%seconds

   contains

      !> What the mesh leaves
      subroutine see_mesh()
         call mesh_error_of_balanced(structure, history, balanced, displacement, mesh_error)
      end subroutine see_mesh

      !> What planes and harmonics leave
      subroutine see_joints()
         type(joint_change_type) :: both(2)

         call find_joint_changes(structure%condensed, history%scene, balanced, history%start, &
                                 structure%judged(structure%yielding), changes)
         both = [changes%planes, changes%harmonics]
         call find_effects(structure, size(displacement, 2), both, effect)
         changes%planes = both(1)
         changes%harmonics = both(2)
      end subroutine see_joints

   end subroutine find_other_changes

   !> Whether threads have so little to do in a loop over the systems, all factors being kept by this process alone, that
   !> they had better see to different things
   logical function is_small(equations)
      !> The equations
      type(equations_type), intent(in) :: equations

      !> Equations of all systems at most
      integer, parameter :: few = 10000

      is_small = omp_get_max_threads() > 1 .and. equations%solver%concurrent .and. equations%team%size == 1 &
         .and. equations%n_kept == size(equations%systems)
      if (is_small) is_small = sum(equations%classes(equations%systems%class)%dofs%n_equations) <= few
   end function is_small

   !> What changes of the joints do to the displacements, each without rigid motions of floating parts
   subroutine find_effects(structure, n_nodes, changes, effect)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> Nodes
      integer, intent(in) :: n_nodes
      !> The changes; those whose effect is not found are not known, and each took its part of the time
      type(joint_change_type), intent(inout) :: changes(:)
      !> Amplitudes, shape (3, nodes, modes, changes)
      real(wp), allocatable, intent(out) :: effect(:, :, :, :)

      real(wp), allocatable :: excess(:, :, :, :)
      real(wp) :: start
      integer :: k
      logical :: found

      start = omp_get_wtime()
      allocate (excess(3, size(structure%condensed%points), size(structure%modes), size(changes)), source=0.0_wp)
      do k = 1, size(changes)
         if (changes(k)%known) excess(:, :, :, k) = changes(k)%excess
      end do
      allocate (effect(3, n_nodes, size(structure%modes), size(changes)), source=0.0_wp)
      call add_excess_effect(structure%equations, structure%condensed%points, excess, effect, found)
      do k = 1, size(changes)
         changes(k)%known = changes(k)%known .and. found
         changes(k)%seconds = changes(k)%seconds + (omp_get_wtime() - start)/size(changes)
      end do
   end subroutine find_effects

   !> What the iteration left, by the state in which the joints are wholly balanced: a bound where
   !> that is within what is wanted
   subroutine iteration_error(structure, history, results, wanted, share)
      !> The structure, condensed
      type(structure_type), intent(inout) :: structure
      !> What the increments came to by a method on total jumps
      type(history_type), intent(in) :: history
      !> Results with displacements
      type(results_type), intent(in) :: results
      !> Displacement and joint stress that the error need not be below
      type(error_share_type), intent(in) :: wanted
      !> The error
      type(error_share_type), intent(out) :: share

      type(joint_field_type), allocatable :: balanced, found
      type(joint_change_type) :: change
      type(mechanism_type) :: mechanism
      real(wp), allocatable :: displacement(:, :, :)
      real(wp) :: largest

      associate (condensed => structure%condensed, scene => history%scene, field => history%field)
         if (nothing_is_left(structure, history, results)) return
         allocate (balanced, source=field)
         balanced%memory = history%memory
         call settle_wholly(condensed, scene, balanced)
         found = field
         call find_mechanism(condensed, scene, field, .false., mechanism)
         if (size(mechanism%idle, 2) > 0) then  ! where these leave a state is of no meaning
            call settle(condensed, scene, mechanism, found)
            call settle(condensed, scene, mechanism, balanced)
         end if
         change = change_between(scene, found, balanced, structure%judged(structure%yielding))
         displacement = results%displacement
         call add_motions(condensed%floating, field%offset, displacement)
         largest = largest_vector(results%modes, displacement)
         if (change%known .and. .not. condensed%shared) then
            call bound_share(structure, history, largest, change, share)
            ! each rank has a bound by the factors that it has
            if (condensed%team%all_of(share%displacement <= wanted%displacement .and. &
                                      share%joint_stress <= wanted%joint_stress)) return
         end if
         if (.not. change%known) return
         displacement = 0.0_wp
         call add_excess_effect(structure%equations, condensed%points, change%excess, displacement, change%known)
         call take_share(structure, history, results, largest, change, displacement, share)
      end associate
   end subroutine iteration_error

   !> A bound of an error in relative numbers, found without a solution
   subroutine bound_share(structure, history, largest, change, share)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Largest displacement
      real(wp), intent(in) :: largest
      !> The change of the joints
      type(joint_change_type), intent(in) :: change
      !> Takes stress and displacement
      type(error_share_type), intent(out) :: share

      real(wp) :: displacement, stress
      integer :: k

      call bound_excess_effect(structure, history%scene, change%excess, elastic_points(structure), &
         displacement, stress)
      do k = 1, size(change%offset)
         displacement = displacement + abs(change%offset(k)) &
            *sqrt(3.0_wp)*maxval(abs(structure%condensed%floating(k)%displacement))
         stress = merge(huge(1.0_wp), stress, abs(change%offset(k)) > 0.0_wp)
      end do
      share%displacement = ratio(displacement + change%beyond, &
         displacement_scale(history, largest))
      share%joint_stress = ratio(max(change%stress, stress), &
         yielding_scale(structure, history))
   end subroutine bound_share

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

   !> An error in relative numbers
   subroutine take_share(structure, history, results, largest, change, effect, share)
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

      real(wp), allocatable :: displacement(:, :, :)
      real(wp) :: start

      start = omp_get_wtime()
      share%seconds = change%seconds
      if (.not. change%known) return
      displacement = effect
      call add_motions(structure%condensed%floating, change%offset, displacement)
      share%joint_stress = ratio(max(change%stress, elastic_change(structure, displacement)), &
                                 stress_scale(structure, history, results%displacement))
      share%displacement = ratio(largest_vector(results%modes, displacement) + change%beyond, &
                                 displacement_scale(history, largest))
      share%seconds = share%seconds + omp_get_wtime() - start
   end subroutine take_share

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
         largest = largest_elastic_stress(points, structure%planes, jump)
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

   !> Errors of the mesh while the stress of the joints is what it is
   subroutine mesh_error_of_held(structure, history, field, displacement, error)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The errors
      type(mesh_error_type), intent(out) :: error

      real(wp) :: start

      start = omp_get_wtime()
      call all_differences(structure, history, structure%fine%coarse_points(structure%yielding), &
         field%excess, &
                           displacement, error)
      error%seconds = omp_get_wtime() - start
   end subroutine mesh_error_of_held

   !> Errors of the mesh: while the stress of the joints is held, as the law gives it along the fine
   !> joints, then the answer of the joints
   subroutine mesh_error_of_balanced(structure, history, balanced, displacement, error)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> State of the joints, balanced
      type(joint_field_type), intent(in) :: balanced
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The errors
      type(mesh_error_type), intent(out) :: error

      type(model_joint_point_type), allocatable :: points(:)
      type(joint_field_type), allocatable :: after, settled
      type(mechanism_type) :: mechanism
      type(scene_type) :: corrected
      real(wp), allocatable :: excess(:, :, :), before(:, :, :)
      real(wp) :: start
      integer :: k
      logical :: found

      start = omp_get_wtime()
      associate (condensed => structure%condensed, scene => history%scene)
         call fine_excess(condensed, scene, structure%fine, balanced, displacement, &
            history%loading%case_factor, points, excess)
         call all_differences(structure, history, points, excess, displacement, error)
         allocate (after, source=balanced)
         corrected = scene
         corrected%loads%free = scene%loads%free + error%jump(:, structure%yielding, :)
         call find_again(condensed, corrected, history%start, after, found)
         if (found) then
            error%joint_stress = largest_change(scene, balanced, after, 1, &
               structure%judged(structure%yielding))
            before = error%displacement
            call add_excess_effect(structure%equations, condensed%points, &
               after%excess - balanced%excess, &
                                   error%displacement, found)
            error%known = error%known .and. found
            allocate (settled, source=balanced)
            call find_mechanism(condensed, scene, balanced, .false., mechanism)
            call settle(condensed, scene, mechanism, settled)
            call settle(condensed, corrected, mechanism, after)
            call add_motions(condensed%floating, after%offset - settled%offset, error%displacement)
            do k = 1, size(before, 3)
               error%jump(:, :, k) = error%jump(:, :, k) &
                  + joint_jump(structure%joint_points, error%displacement(:, :, k) - &
                  before(:, :, k))
            end do
         end if
      end associate
      error%seconds = omp_get_wtime() - start
   end subroutine mesh_error_of_balanced

   !> Errors of all modes while the stress of the joints is held
   subroutine all_differences(structure, history, points, excess, displacement, error)
      !> The structure
      type(structure_type), intent(inout) :: structure
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Joint points with excess stress, and its amplitudes, shape (3, points, modes)
      type(model_joint_point_type), intent(in) :: points(:)
      real(wp), intent(in) :: excess(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Takes the errors
      type(mesh_error_type), intent(out) :: error

      type(workspace_type), allocatable :: spaces(:)
      type(room_type), allocatable :: rooms(:)
      type(difference_type) :: difference
      type(fine_load_type) :: load
      logical :: weak(size(structure%modes))
      integer :: s

      call new_difference(size(displacement, 2), size(structure%joint_points), &
         size(displacement, 3), difference)
      load = new_fine_load(structure%fine, structure%modes, history%loading)
      weak = is_weak(history, excess)
      associate (equations => structure%equations)
         call new_workspaces(equations, spaces)
         allocate (rooms(size(spaces)))
         !$omp parallel do schedule(dynamic) num_threads(size(spaces))
         do s = equations%first, equations%last
            if (all(weak(equations%systems(s)%modes))) cycle
            call hold_factor(equations, s, spaces(own()))
            if (.not. equations%systems(s)%failed) then
               call find_difference(structure%fine, equations, s, load, displacement, points, &
                  excess, rooms(own()), difference)
            end if
            call release_factor(equations, s, spaces(own()))
         end do
         !$omp end parallel do
         call share_difference(equations, difference)
         call new_mesh_error(difference, error)
         error%known = equations%team%all_of(.not. any(equations%systems%failed))
      end associate
   end subroutine all_differences

   !> Whether nothing acts in a mode but little excess stress. Its part in the error is as small:
   !> all such harmonics together had 5 % of the jumps' errors in a pile of M = 8
   pure function is_weak(history, excess)
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Excess stress, amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: excess(:, :, :)
      !> Shape (modes)
      logical :: is_weak(size(excess, 3))

      !> Part of the largest excess stress that is little
      real(wp), parameter :: little = 0.05_wp
      integer :: k

      do k = 1, size(is_weak)
         is_weak(k) = maxval(abs(excess(:, :, k))) <= little*maxval(abs(excess)) &
            .and. .not. any(abs(history%loading%right(:, :, k)) > 0.0_wp)
      end do
   end function is_weak

end module axijoint_analysis_error_yielding_errors
