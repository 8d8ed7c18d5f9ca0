!> The fields of an increment: of the last as it was found, of those before it found again
module axijoint_analysis_core_increment_fields
   use axijoint_analysis_core_cuts, only : cut_resultants
   use axijoint_analysis_core_cut_motion, only : cut_motion
   use axijoint_analysis_core_face_reactions, only : face_reactions
   use axijoint_analysis_core_joint_peaks, only : find_joint_peaks
   use axijoint_analysis_core_joint_resultants, only : joint_resultants
   use axijoint_analysis_core_joint_work, only : joint_energy
   use axijoint_analysis_core_nodal_stress, only : smooth_stress
   use axijoint_analysis_core_plastic_fields, only : plastic_fields
   use axijoint_analysis_core_recovery, only : recover
   use axijoint_analysis_core_fields, only : fields_type, n_resultants
   use axijoint_analysis_core_solution, only : solve_states, solved_state_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_force, only : joint_jump, elastic_joint_stress
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_reference, only : reference_type
   use axijoint_joints_field, only : joint_field_type, new_joint_field, set_initial_stress
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_planes, only : planes_type, new_view, synthesize
   use axijoint_joints_residual, only : load_norm
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_mesh, only : n_nodes, element_references
   use axijoint_model_model, only : model_type
   use axijoint_plastic_record, only : on_all_points
   implicit none
   private
   public :: elastic_field, field_of_state, recover_fields, move_bodies
   public :: solve_increments, is_found, recover_state, solve_increment
   public :: load_plastic_strain, stress_plastic_strain

contains

   !> State of all joints, as if none yielded
   subroutine elastic_field(model, structure, planes, case_factor, displacement, field)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> Planes
      type(planes_type), intent(in) :: planes
      !> Factors of the load cases, for the in-situ stress
      real(wp), intent(in) :: case_factor(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(out) :: field

      real(wp), allocatable :: jump(:, :, :)
      integer :: j, k

      associate (points => structure%joint_points)
         field = new_joint_field(size(points), size(planes%angle), size(displacement, 3), 0)
         call set_initial_stress(model, points, case_factor, field)
         allocate (jump(3, size(points), size(displacement, 3)))
         do k = 1, size(displacement, 3)
            jump(:, :, k) = joint_jump(points, displacement(:, :, k))
         end do
         field%jump = synthesize(planes, jump)
         do j = 1, size(planes%angle)
            field%stress(:, :, j) = elastic_joint_stress(points, field%jump(:, :, j)) + &
               field%initial
         end do
      end associate
   end subroutine elastic_field

   !> State of all joints at the end of an increment: that of the joint law where joints can yield,
   !> on its planes, else any
   subroutine field_of_state(model, structure, state, angles, displacement, field)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> What was kept of the increment
      type(increment_state_type), intent(in) :: state
      !> Angles of the planes [radian]: any if no joint can yield, else not looked at
      real(wp), intent(in) :: angles(:)
      !> Displacement amplitudes without rigid motions of floating parts, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> State of all joints
      type(joint_field_type), intent(out) :: field

      if (size(structure%yielding) == 0) then
         call elastic_field(model, structure, new_view(angles, structure%modes), &
            state%case_factor, displacement, field)
         return
      end if
      call elastic_field(model, structure, structure%planes, state%case_factor, displacement, field)
      associate (yield => structure%yielding)
         field%jump(:, yield, :) = state%jump
         field%stress(:, yield, :) = state%stress
         field%state(yield, :) = state%state
         field%excess(:, yield, :) = state%excess + state%pending
         field%offset = state%offset
      end associate
   end subroutine field_of_state

   !> All that follows from displacements and joints
   subroutine recover_fields(model, structure, loading, peak, field, results, smoothed)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Loads, and the largest on the way, by which errors are measured
      type(loading_type), intent(in) :: loading, peak
      !> State of all joints
      type(joint_field_type), intent(in) :: field
      !> Results; displacements, without rigid motions of floating parts, are there already
      class(fields_type), intent(inout) :: results
      !> Whether stresses are smoothed to the nodes; true if absent
      logical, intent(in), optional :: smoothed

      logical :: smooth

      smooth = .true.
      if (present(smoothed)) smooth = smoothed
      call take_joint_results(structure%joint_points, field, results)
      call find_joint_peaks(structure, field, results)
      call recover(model, structure, loading, peak, field, results)
      if (smooth) call smooth_stress(model, structure%equations, results)
      call cut_resultants(model, structure, loading, field, results)
      results%face_reactions = face_reactions(model, results)
      results%joint_resultants = joint_resultants(model%mesh, structure%joint_points, &
         structure%modes, results%displacement, field)
   end subroutine recover_fields

   !> Put bodies that joints alone hold where they have gone to, and see how joints and sections
   !> moved
   subroutine move_bodies(model, structure, state, results)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> The state
      type(increment_state_type), intent(in) :: state
      !> Results with displacements
      class(fields_type), intent(inout) :: results

      integer :: c, k

      results%joint_energy = joint_energy(model, structure, state, results%displacement)
      if (allocated(state%offset)) then
         if (size(state%offset) > 0) &
            call add_motions(structure%condensed%floating, state%offset, results%displacement)
      end if
      allocate (results%joint_amplitude(3, size(structure%joint_points), size(structure%modes)))
      do k = 1, size(structure%modes)
         results%joint_amplitude(:, :, k) = joint_jump(structure%joint_points, &
            results%displacement(:, :, k))
      end do
      allocate (results%cut_motion(n_resultants, size(model%cuts)))
      do c = 1, size(model%cuts)
         results%cut_motion(:, c) = cut_motion(model%mesh, model%cuts(c), structure%sections(c), &
            results%modes, results%displacement)
      end do
   end subroutine move_bodies

   !> Find the fields of an increment again
   subroutine solve_increment(model, structure, place, states, angles, fields, error, smoothed)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure; its factors are made again where they are not kept
      type(structure_type), intent(inout) :: structure
      !> Place of the increment among what was kept of all
      integer, intent(in) :: place
      !> What was kept of all
      type(increment_state_type), intent(in) :: states(:)
      !> Planes of the joint results [radian]
      real(wp), intent(in) :: angles(:)
      !> The fields of the increment
      type(fields_type), intent(out) :: fields
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Whether stresses are smoothed to the nodes; true if absent
      logical, intent(in), optional :: smoothed

      type(solved_state_type) :: solved(1)

      call solve_increments(model, structure, states, [place], solved, error)
      if (allocated(error)) return
      call recover_state(model, structure, states(place), angles, solved(1), fields, smoothed)
      call move_bodies(model, structure, states(place), fields)
   end subroutine solve_increment

   !> Find the displacements of increments again: one solution a mode and increment, unless they were found already
   subroutine solve_increments(model, structure, states, places, solved, error, earlier)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure; its factors are made again where they are not kept
      type(structure_type), intent(inout) :: structure
      !> What was kept of all
      type(increment_state_type), intent(in) :: states(:)
      !> Places of the increments among them; maybe none
      integer, intent(in) :: places(:)
      !> The displacements, as many as there are places
      type(solved_state_type), intent(out) :: solved(:)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Fields of those that were found already, by number of the increment
      type(fields_type), intent(in), optional :: earlier(:)

      logical :: found(size(places))
      integer :: first, i, last

      do i = 1, size(places)
         associate (state => states(places(i)))
            found(i) = is_found(state%increment, earlier)
            call load_plastic_strain(model, structure, state, solved(i)%loading)
            if (found(i)) then
               solved(i)%displacement = earlier(state%increment)%displacement
               cycle
            end if
            allocate (solved(i)%displacement(3, n_nodes(model%mesh), size(structure%modes)))
            ! where no joint yields there is no excess stress
            if (allocated(state%excess)) solved(i)%excess = state%excess
         end associate
      end do
      last = 0
      do while (last < size(places))
         first = last + 1
         last = first
         do while (last < size(places))
            if (found(last + 1) .neqv. found(first)) exit
            last = last + 1
         end do
         if (.not. found(first)) call solve_states(structure, model, solved(first:last), error)
         if (allocated(error)) return
      end do
   end subroutine solve_increments

   !> Whether the fields of an increment were found already
   pure logical function is_found(increment, earlier)
      !> The increment
      integer, intent(in) :: increment
      !> Fields by number of the increment
      type(fields_type), intent(in), optional :: earlier(:)

      is_found = .false.
      if (.not. present(earlier)) return
      if (increment <= size(earlier)) is_found = allocated(earlier(increment)%displacement)
   end function is_found

   !> Find the fields of an increment from its displacements, without rigid motions of floating parts (`move_bodies`)
   subroutine recover_state(model, structure, state, angles, solved, fields, smoothed)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> What was kept of the increment
      type(increment_state_type), intent(in) :: state
      !> Planes of the joint results [radian]
      real(wp), intent(in) :: angles(:)
      !> The displacements; taken into the fields
      type(solved_state_type), intent(inout) :: solved
      !> The fields
      type(fields_type), intent(out) :: fields
      !> Whether stresses are smoothed to the nodes; true if absent
      logical, intent(in), optional :: smoothed

      type(loading_type) :: loads
      type(joint_field_type) :: field

      fields%modes = structure%modes
      fields%plane_angles = angles
      call move_alloc(solved%displacement, fields%displacement)
      call field_of_state(model, structure, state, angles, fields%displacement, field)
      if (allocated(state%bodies%place)) then
         call stress_plastic_strain(model, state, solved%loading)
         ! what errors are held against
         call new_loading(model, structure%joint_points, structure%support_points, structure%modes, &
                          structure%equations%unit_loads, &
                          combination_type(0, state%peak_factor), loads)
         call recover_fields(model, structure, solved%loading, loads, field, fields, smoothed)
      else
         call recover_fields(model, structure, solved%loading, solved%loading, field, fields, smoothed)
      end if
      fields%plastic = plastic_fields(model, fields%modes, fields%stress, state%bodies)
   end subroutine recover_state

   !> Loads of a state, with the stress of the plastic strain that its displacements follow from
   subroutine load_plastic_strain(model, structure, state, loading)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> The state
      type(increment_state_type), intent(in) :: state
      !> The loads
      type(loading_type), intent(out) :: loading

      real(wp), allocatable :: taken(:, :, :)

      if (allocated(state%bodies%place)) taken = on_all_points(state%bodies%place, &
         state%bodies%carried, n_points(model))
      call new_loading(model, structure%joint_points, structure%support_points, structure%modes, &
                       structure%equations%unit_loads, combination_type(0, state%case_factor), loading, taken)
   end subroutine load_plastic_strain

   !> Put the plastic strain of the state itself in the place of that which displacements follow
   !> from: what the two differ by is left out of balance
   subroutine stress_plastic_strain(model, state, loading)
      !> The job
      type(model_type), intent(in) :: model
      !> The state
      type(increment_state_type), intent(in) :: state
      !> The loads
      type(loading_type), intent(inout) :: loading

      if (allocated(state%bodies%place)) loading%initial%taken = &
         on_all_points(state%bodies%place, state%bodies%amplitude, n_points(model))
   end subroutine stress_plastic_strain

   !> Number of the Gauss points of all elements
   pure integer function n_points(model)
      !> The job
      type(model_type), intent(in) :: model

      type(reference_type), allocatable :: references(:)

      references = element_references(model%mesh)
      n_points = sum(references(model%mesh%element_kind)%n_points)
   end function n_points

   !> Joint points and their state into the results
   subroutine take_joint_results(points, field, results)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Their state
      type(joint_field_type), intent(in) :: field
      !> The results
      class(fields_type), intent(inout) :: results

      integer :: k

      results%joint_point_joint = points%joint
      allocate (results%joint_point_position(2, size(points)))
      do k = 1, size(points)
         results%joint_point_position(:, k) = points(k)%position
      end do
      results%joint_jump = field%jump
      results%joint_stress = field%stress
      results%joint_state = field%state
   end subroutine take_joint_results

end module axijoint_analysis_core_increment_fields
