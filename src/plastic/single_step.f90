!> All loads of a state put on at once, and equilibrium approached from given displacements on until
!> the load, or the displacement, is known well enough: what another mesh, other harmonics or planes
!> change of a state is seen so, without its history
module axijoint_plastic_single_step
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_assembly_solid_force, only : solid_force
   use axijoint_assembly_support, only : support_point_type
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_base_stop, only : stop_wished
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : set_initial_stress
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_history, only : history_type
   use axijoint_joints_residual, only : load_norm
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type
   use axijoint_plastic_bodies, only : bodies_type, new_bodies
   use axijoint_plastic_elastic, only : from_nodes, to_nodes, to_vector, pushed_modes
   use axijoint_plastic_field, only : body_field_type, body_load_type, new_body_field
   use axijoint_plastic_joint_side, only : begin_joint_step
   use axijoint_plastic_methods, only : quasi_newton_step, remembered_steps
   use axijoint_plastic_mixing, only : mixing_type, new_mixing, mix
   use axijoint_plastic_posed, only : pose, take_load
   use axijoint_plastic_problem, only : problem_type, iterate_type, steer, look, note_pushed
   use axijoint_plastic_quasi_newton, only : curvature_type, new_curvature
   use axijoint_plastic_record, only : on_all_points
   use axijoint_plastic_residual, only : evaluate
   use axijoint_plastic_settling, only : settling_type, note, is_settled
   implicit none
   private
   public :: single_load_type, single_state_type, single_step

   !> Loads
   type :: single_load_type
      !> Factor of each load case
      real(wp), allocatable :: given(:)
      !> Factors in loads that go with a load factor, which is found such that these loads do the
      !> same work as on the displacements to begin with; not allocated if there are none
      real(wp), allocatable :: steered(:)
      !> Load factor to begin with
      real(wp) :: factor = 0.0_wp
      !> Factors that the last increment adds, where it moves components that are held: what holds these is asked for, by its
      !> work on what is added to their displacements. Not allocated else
      real(wp), allocatable :: moved(:)
   end type single_load_type

   !> The state
   type :: single_state_type
      !> Whether the value is known well enough
      logical :: found = .false.
      !> Load factor; or work of what holds components on what the last increment adds to the displacements
      !> that are given there [force length]; or, if loads are given, largest component of what changed of the
      !> displacement amplitudes [length]
      real(wp) :: value = 0.0_wp
      !> Displacement amplitudes, held ones too, shape (3, nodes, modes) [length]
      real(wp), allocatable :: displacement(:, :, :)
      !> Elastic solutions
      integer :: solutions = 0
   end type single_state_type

   !> The value is looked at after so many steps
   integer, parameter :: stride = 5
   !> Most elastic solutions, and how much less well the value may be known after these
   integer, parameter :: most = 150
   real(wp), parameter :: hardly = 5.0_wp
   !> Residual ratio that is equilibrium, and one that is far from any where there is no potential
   real(wp), parameter :: balanced = 1.0e-6_wp, far = 0.3_wp
   !> Residual ratio of joints, and most of their iterations
   real(wp), parameter :: joint_tolerance = 1.0e-5_wp
   integer, parameter :: joint_iterations = 1500
   !> Iterates that the mix remembers
   integer, parameter :: depth = 10

   !> The way there: limited-memory BFGS where there is a potential, else Anderson's mix
   type :: way_type
      !> What the last iterate leaves out of balance
      type(iterate_type) :: iterate
      !> What the method remembers
      type(curvature_type) :: curvature
      type(mixing_type) :: mixing
      logical :: downhill = .false.
   end type way_type

contains

   !> Find the state
   subroutine single_step(model, equations, condensed, joint_points, supports, loads, start, &
      state, reference)
      !> The job; its planes of bodies are taken
      type(model_type), intent(in) :: model
      !> Equations of all modes, assembled
      type(equations_type), intent(inout), target :: equations
      !> The condensed structure; empty if no joint can yield
      type(condensed_type), intent(in), target :: condensed
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: supports(:)
      !> The loads
      type(single_load_type), intent(in) :: loads
      !> Displacements to begin with, shape (3, nodes, modes)
      real(wp), intent(in) :: start(:, :, :)
      !> The state
      type(single_state_type), intent(out) :: state
      !> Value whose difference to that of the state is asked for; the value itself if absent
      real(wp), intent(in), optional :: reference

      type(bodies_type), target :: bodies
      type(problem_type) :: problem
      type(body_field_type) :: field
      type(settling_type) :: settling
      type(body_load_type) :: load
      type(loading_type) :: loading, direction
      type(history_type) :: history
      real(wp), allocatable :: added(:, :, :)
      type(way_type) :: way
      logical :: ended
      integer :: k

      call new_bodies(model, (model%materials%yield), bodies)
      call pose(model, equations, condensed, bodies, problem, history)
      field = new_body_field(equations, bodies, problem%planes)
      call new_loading(model, joint_points, supports, equations%modes, equations%unit_loads, &
         combination_type(0, loads%given), loading)
      call take_load(model, problem, loading, load)
      call note_in_situ(problem, load, field)
      problem%load = load
      problem%load_norm = load_norm(equations, loading)
      call note_pushed(problem, load%right, 1.0_wp)
      field%unknowns = from_nodes(equations, start)
      field%begun = field%unknowns
      if (allocated(loads%steered)) then
         call new_loading(model, joint_points, supports, equations%modes, equations%unit_loads, &
            combination_type(0, loads%steered), direction)
         call steer(problem, to_vector(equations, direction%right))
         problem%steering%factor = loads%factor
         call note_pushed(problem, problem%steering%load, abs(loads%factor), more=.true.)
      end if
      if (allocated(loads%moved)) then
         call new_loading(model, joint_points, supports, equations%modes, equations%unit_loads, &
            combination_type(0, loads%moved), direction)
         added = direction%held
      end if
      if (allocated(problem%joints)) then
         call begin_joint_step(problem%joints, pushed_modes(equations, load%right), loading%external)
         call set_initial_stress(model, condensed%points, loads%given, problem%joints%field)
         problem%joints%control%tolerance = joint_tolerance
         problem%joints%control%most = joint_iterations
      end if
      if (present(reference)) settling%reference = reference
      call begin_way(problem, field, way)
      allocate (state%displacement, mold=field%force)
      do
         call take_displacement(problem, field%unknowns, load, state%displacement)
         call find_value(model, problem, field, loads, loading, added, way%iterate, state)
         ! what is left moves the parts that joints alone hold, however little it is, and their rigid motions may be apart
         if (allocated(problem%joints)) then
            call take_displacement(problem, field%unknowns + way%iterate%response, load, state%displacement)
            call add_motions(problem%joints%condensed%floating, problem%joints%field%offset, state%displacement)
         end if
         if (.not. (allocated(loads%steered) .or. allocated(loads%moved))) &
            settling%size = maxval(abs(field%unknowns))
         call note(settling, state%value)
         call judge(problem, settling, way, state%found, ended)
         if (ended) exit
         do k = 1, stride
            call step(problem, field, way)
         end do
      end do
      state%solutions = problem%solutions
   end subroutine single_step

   !> Look where the way begins
   subroutine begin_way(problem, field, way)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> The way
      type(way_type), intent(out) :: way

      way%downhill = problem%has_potential .and. .not. allocated(problem%joints)
      if (way%downhill) then
         way%curvature = new_curvature(size(field%unknowns), remembered_steps)
      else
         way%mixing = new_mixing(size(field%unknowns), depth)
      end if
      call look(problem, field, way%iterate)
   end subroutine begin_way

   !> A step
   subroutine step(problem, field, way)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> The way so far
      type(way_type), intent(inout) :: way

      if (way%downhill) then
         call quasi_newton_step(problem, field, way%iterate, way%curvature)
      else
         call mix(way%mixing, field%unknowns, way%iterate%residual, way%iterate%response)
         call look(problem, field, way%iterate)
      end if
   end subroutine step

   !> Whether the value is found, and whether no more is to be tried. Down a potential a value that
   !> stands still is near its end however large the residual is; else it may have got stuck
   subroutine judge(problem, settling, way, found, ended)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> Values so far
      type(settling_type), intent(in) :: settling
      !> The way so far
      type(way_type), intent(in) :: way
      !> What is said
      logical, intent(out) :: found, ended

      logical :: fails, near

      associate (iterate => way%iterate)
         fails = stop_wished() .or. .not. ieee_is_finite(iterate%ratio)
         if (allocated(problem%joints)) fails = fails .or. .not. problem%joints%verdict%converged
         near = way%downhill .or. iterate%ratio <= far
         found = iterate%beyond_rounding <= balanced &
            .or. (near .and. is_settled(settling, 1.0_wp))
      end associate
      ended = fails .or. found .or. problem%solutions > most
      if (ended) found = found .or. (near .and. is_settled(settling, hardly))
      found = found .and. .not. fails
   end subroutine judge

   !> Displacement amplitudes of unknowns
   subroutine take_displacement(problem, unknowns, load, displacement)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> The unknowns
      real(wp), intent(in) :: unknowns(:)
      !> The loads, with displacements that are given
      type(body_load_type), intent(in) :: load
      !> Shape (3, nodes, modes)
      real(wp), intent(out) :: displacement(:, :, :)

      integer :: k

      do k = 1, size(displacement, 3)
         displacement(:, :, k) = to_nodes(problem%equations, unknowns, k)
      end do
      if (allocated(load%held)) displacement = displacement + load%held
   end subroutine take_displacement

   !> The value, by virtual work on the displacements themselves, or on the part of them that the last increment added if all
   !> grow in proportion: its error is then of second order in theirs. It is known long before the residual is small
   subroutine find_value(model, problem, field, loads, loading, added, iterate, state)
      !> The job
      type(model_type), intent(in) :: model
      !> The problem
      type(problem_type), intent(in) :: problem
      !> The state
      type(body_field_type), intent(in) :: field
      !> The loads, what is asked for, and on the nodes
      type(single_load_type), intent(in) :: loads
      type(loading_type), intent(inout) :: loading
      !> What the last increment adds to displacements that are given, shape (3, nodes, modes); not allocated if nothing
      real(wp), allocatable, intent(in) :: added(:, :, :)
      !> What the state leaves out of balance
      type(iterate_type), intent(in) :: iterate
      !> The state, with displacements; takes the value
      type(single_state_type), intent(inout) :: state

      real(wp) :: left

      left = dot_product(iterate%residual, field%unknowns)
      if (allocated(problem%steering%load)) then
         state%value = problem%steering%factor &
            - left/dot_product(problem%steering%load, field%unknowns)
      else if (allocated(loads%moved)) then
         state%value = held_work(model, problem, field, loading, added, state%displacement) &
            - left*sum(added*loading%held)/max(sum(loading%held**2), tiny(left))
      else
         state%value = maxval(abs(field%unknowns - field%begun))
      end if
   end subroutine find_value

   !> Note the forces of the stress in situ: residuals are held against what is more than these
   subroutine note_in_situ(problem, load, field)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> Its loads
      type(body_load_type), intent(in) :: load
      !> The state, new
      type(body_field_type), intent(inout) :: field

      type(body_load_type) :: still
      real(wp) :: unused(size(field%unknowns))

      still = load
      if (allocated(still%held)) deallocate (still%held)
      call evaluate(problem%equations, problem%bodies, problem%planes, still, field, unused)
      field%force_before = field%force
   end subroutine note_in_situ

   !> Work of what holds components on what the last increment adds to the displacements that are given there
   real(wp) function held_work(model, problem, field, loading, added, displacement) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> The problem, for modes and bodies
      type(problem_type), intent(in) :: problem
      !> The state
      type(body_field_type), intent(in) :: field
      !> The loads, with displacements that are given
      type(loading_type), intent(inout) :: loading
      !> What is added to these, and displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: added(:, :, :), displacement(:, :, :)

      real(wp), allocatable :: force(:, :)
      integer :: k

      work = 0.0_wp
      allocate (force(3, size(displacement, 2)))
      loading%initial%present = .true.
      associate (bodies => problem%bodies, modes => problem%equations%modes)
         loading%initial%taken = on_all_points(bodies%place, field%amplitude, bodies%n_all)
         do k = 1, size(modes)
            if (.not. any(abs(added(:, :, k)) > 0.0_wp)) cycle
            call solid_force(model, loading%initial, k, modes(k), displacement(:, :, k), force)
            work = work + sum((force - loading%external(:, :, k))*added(:, :, k))
         end do
      end associate
   end function held_work

end module axijoint_plastic_single_step
