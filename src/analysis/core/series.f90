!> What is followed from increment to increment: one entry for each
module axijoint_analysis_core_series
   use axijoint_analysis_core_joint_work, only : in_situ_shift, sliding_work
   use axijoint_analysis_core_named_points, only : at_points
   use axijoint_analysis_core_plastic_fields, only : plastic_fields_type, plastic_work
   use axijoint_analysis_core_fields, only : fields_type, n_resultants
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest_vector
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_unit_loads, only : in_situ_force, in_situ_joint_stress
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : state_slip, state_open
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: series_type, new_series, append_increment

   !> The series; the last index is the increment
   type :: series_type
      !> Entries that are filled
      integer :: n = 0
      !> Increment, iterations in it
      integer, allocatable :: increment(:), iterations(:)
      !> Whether it is in equilibrium, 1 or 0
      integer, allocatable :: equilibrium(:)
      !> Sum of the load factors, factor of each load case, shape (cases, increments)
      real(wp), allocatable :: load_factor(:), case_factor(:, :)
      !> Forces out of balance at its end over the loads (Eq. 17); of a linear job from the stresses
      real(wp), allocatable :: residual(:)
      !> Largest displacement vector; largest pressure and shear stress of a joint
      real(wp), allocatable :: displacement(:), pressure(:), shear(:)
      !> Points times planes that slip, and that are open
      integer, allocatable :: n_slip(:), n_open(:)
      !> Work of loads and given displacements; elastic energy; work dissipated by sliding and by
      !> plastic strain [force length]
      real(wp), allocatable :: work(:), energy(:), dissipated(:)
      !> Resultants of loads and reactions, shape (n_resultants, increments)
      real(wp), allocatable :: applied(:, :), reacted(:, :)
      !> Resultants and motions at cuts, shape (n_resultants, cuts, increments)
      real(wp), allocatable :: cuts(:, :, :), cut_motion(:, :, :)
      !> Resultants of each joint, shape (n_resultants, joints, increments)
      real(wp), allocatable :: joints(:, :, :)
      !> Reactions of supported faces, shape (n_resultants, faces, increments)
      real(wp), allocatable :: faces(:, :, :)
      !> Displacements of named points, shape (3, points, modes, increments)
      real(wp), allocatable :: points(:, :, :, :)
      !> Of the last entry: displacements, what acts on them, what solids and springs take of it,
      !> shape (3, nodes, modes); state; energy of solids and springs [force length]
      real(wp), allocatable, private :: before(:, :, :), acting(:, :, :), taken(:, :, :)
      type(increment_state_type), private :: state
      type(plastic_fields_type), private :: plastic
      real(wp), private :: stored = 0.0_wp
   end type series_type

contains

   !> Room for all increments of a run
   function new_series(model, results, n) result(series)
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end
      type(results_type), intent(in) :: results
      !> Increments that are followed
      integer, intent(in) :: n
      !> The series
      type(series_type) :: series

      allocate (series%increment(n), series%iterations(n), series%equilibrium(n), &
                series%n_slip(n), series%n_open(n), source=0)
      allocate (series%load_factor(n), source=0.0_wp)
      allocate (series%residual(n), series%displacement(n), series%pressure(n), series%shear(n), &
                series%work(n), series%energy(n), series%dissipated(n), source=0.0_wp)
      allocate (series%case_factor(size(model%load_cases), n))
      allocate (series%applied(n_resultants, n), series%reacted(n_resultants, n))
      allocate (series%cuts(n_resultants, size(model%cuts), n))
      allocate (series%cut_motion, mold=series%cuts)
      allocate (series%joints(n_resultants, size(model%mesh%joint_label), n))
      allocate (series%faces(n_resultants, size(model%supported_faces), n))
      allocate (series%points(3, size(model%points), size(results%modes), n))
      allocate (series%before, series%acting, series%taken, mold=results%displacement)
      series%before = 0.0_wp
      series%acting = 0.0_wp
      series%taken = 0.0_wp
   end function new_series

   !> Add the next increment
   subroutine append_increment(model, structure, final, place, now, series)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Results at the end, with the path and the states of all increments
      type(results_type), intent(in) :: final
      !> Place of the increment among the states
      integer, intent(in) :: place
      !> Fields of the increment
      class(fields_type), intent(in) :: now
      !> The series
      type(series_type), intent(inout) :: series

      real(wp) :: plastic, before(2)
      integer :: i

      i = series%n + 1
      series%n = i
      associate (state => final%states(place))
         series%increment(i) = state%increment
         series%load_factor(i) = state%load_factor
         series%case_factor(:, i) = state%case_factor
         series%iterations(i) = count(final%path%increment == state%increment)
         series%equilibrium(i) = merge(1, 0, place < size(final%states) .or. final%converged)
         series%residual(i) = residual_of(final, state, now%residual_ratio)
         series%displacement(i) = largest_vector(final%modes, now%displacement)
         series%pressure(i) = max(0.0_wp, now%pressure%value)
         series%shear(i) = max(0.0_wp, now%shear%value)
         series%n_slip(i) = count(now%joint_state == state_slip)
         series%n_open(i) = count(now%joint_state == state_open)
         series%applied(:, i) = now%applied
         series%reacted(:, i) = now%reacted
         series%cuts(:, :, i) = now%cut_resultants
         series%cut_motion(:, :, i) = now%cut_motion
         series%joints(:, :, i) = now%joint_resultants
         series%faces(:, :, i) = now%face_reactions
         series%points(:, :, :, i) = at_points(model%points, now%displacement)
         plastic = plastic_work(series%plastic, now%plastic)
         before = in_situ_work(model, structure, series, state%case_factor, now)
         series%work(i) = before(1) + mean_work(series%acting, now%acting, series%before, now%displacement)
         series%stored = series%stored + before(2) - plastic - in_situ_shift(model, structure, series%state, state, series%before) &
            + mean_work(series%taken, now%taken, series%before, now%displacement)
         series%energy(i) = series%stored + now%joint_energy
         series%dissipated(i) = sliding_work(model, structure, series%state, state) &
            + plastic
         if (i > 1) then
            series%work(i) = series%work(i) + series%work(i - 1)
            series%dissipated(i) = series%dissipated(i) + series%dissipated(i - 1)
         end if
         if (i == size(series%increment)) return  ! nothing follows
         series%before = now%displacement
         series%acting = now%acting
         series%taken = now%taken
         series%plastic = now%plastic
         series%state = state
      end associate
   end subroutine append_increment

   !> Work of forces from one state to another, by their mean
   pure real(wp) function mean_work(force_before, force, before, displacement) result(work)
      !> Forces and displacements of both states, shape (3, nodes, modes)
      real(wp), intent(in), dimension(:, :, :) :: force_before, force, before, displacement

      integer :: i, k, node

      work = 0.0_wp
      do k = 1, size(force, 3)
         do node = 1, size(force, 2)
            do i = 1, 3
               work = work + (force_before(i, node, k) + force(i, node, k)) &
                  *(displacement(i, node, k) - before(i, node, k))
            end do
         end do
      end do
      work = 0.5_wp*work
   end function mean_work

   !> What the means of both ends lack where stress in situ is new, which is there before anything moves: work of the loads that
   !> balance it, and what solids take of that
   function in_situ_work(model, structure, series, case_factor, now) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Increments so far
      type(series_type), intent(in) :: series
      !> Factors of the load cases
      real(wp), intent(in) :: case_factor(:)
      !> Fields of the increment
      class(fields_type), intent(in) :: now
      !> Both [force length]
      real(wp) :: work(2)

      type(mode_type), parameter :: axis = mode_type()
      real(wp) :: gained(size(case_factor)), force(3, size(now%displacement, 2))
      integer :: k

      work = 0.0_wp
      if (size(model%initial_stresses) == 0) return
      gained = case_factor
      if (allocated(series%state%case_factor)) gained = gained - series%state%case_factor
      if (.not. any(abs(gained) > 0.0_wp)) return
      do k = 1, size(now%modes)
         if (.not. same_mode(now%modes(k), axis)) cycle
         associate (moved => now%displacement(:, :, k) - series%before(:, :, k), points => structure%joint_points)
            force = in_situ_force(structure%equations%unit_loads, gained)
            work(1) = 0.5_wp*sum(force*moved)
            force = force - joint_force(points, axis%harmonic, in_situ_joint_stress(model, points, gained), size(force, 2))
            work(2) = 0.5_wp*sum(force*moved)
         end associate
      end do
   end function in_situ_work

   !> Residual of a state, if joints were iterated on: that of the load step that ended there, which another may have
   !> followed that found no equilibrium
   pure real(wp) function residual_of(final, state, whole) result(residual)
      !> Results at the end
      type(results_type), intent(in) :: final
      !> The state
      type(increment_state_type), intent(in) :: state
      !> Residual found from the stresses
      real(wp), intent(in) :: whole

      real(wp), parameter :: rounding = 1.0e-12_wp  ! two load factors are halves of an increment to the sixth power apart
      integer :: k

      residual = whole
      do k = 1, size(final%residuals)
         associate (record => final%residuals(k))
            if (record%increment == state%increment .and. &
                abs(record%load_factor - state%load_factor) <= rounding*abs(state%load_factor)) residual = record%whole
         end associate
      end do
   end function residual_of

end module axijoint_analysis_core_series
