!> All loads of a state put on at once, and equilibrium sought from given displacements on: what
!> another mesh, other harmonics or planes change of a state is seen so, without its history
module axijoint_plastic_single_step
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_assembly_solid_force, only : solid_force
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : set_initial_stress
   use axijoint_joints_history, only : history_type
   use axijoint_joints_residual, only : load_norm
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type
   use axijoint_plastic_bodies, only : bodies_type, new_bodies
   use axijoint_plastic_elastic, only : from_nodes, to_nodes, to_vector, pushed_modes, &
      ring_norm
   use axijoint_plastic_field, only : body_field_type, body_load_type, new_body_field
   use axijoint_plastic_joint_side, only : begin_joint_step
   use axijoint_plastic_methods, only : body_control_type, body_verdict_type, balance_bodies
   use axijoint_plastic_posed, only : pose, take_load
   use axijoint_plastic_problem, only : problem_type, steer
   use axijoint_plastic_record, only : on_all_points
   use axijoint_plastic_residual, only : evaluate
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
   end type single_load_type

   !> The state
   type :: single_state_type
      !> Whether there is equilibrium
      logical :: balanced = .false.
      !> Ratio of the residual forces
      real(wp) :: ratio = huge(1.0_wp)
      !> Load factor
      real(wp) :: factor = 0.0_wp
      !> Work of what holds components on the displacements that are given there; zero if there are
      !> none [force length]
      real(wp) :: held_work = 0.0_wp
      !> Displacement amplitudes, held ones too, shape (3, nodes, modes) [length]
      real(wp), allocatable :: displacement(:, :, :)
      !> Elastic solutions
      integer :: solutions = 0
   end type single_state_type

contains

   !> Find the state
   subroutine single_step(model, equations, condensed, joint_points, supports, loads, control, &
      start, state)
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
      !> When the iterations end
      type(body_control_type), intent(in) :: control
      !> Displacements to begin with, shape (3, nodes, modes)
      real(wp), intent(in) :: start(:, :, :)
      !> The state
      type(single_state_type), intent(out) :: state

      type(bodies_type), target :: bodies
      type(problem_type) :: problem
      type(body_field_type) :: field
      type(body_verdict_type) :: verdict
      type(body_load_type) :: load
      type(loading_type) :: loading, direction
      type(history_type) :: history
      integer :: k

      call new_bodies(model, (model%materials%yield), bodies)
      call pose(model, equations, condensed, bodies, problem, history)
      field = new_body_field(equations, bodies, problem%planes)
      call new_loading(model, joint_points, supports, equations%modes, &
         combination_type(0, loads%given), loading)
      call take_load(model, problem, loading, load)
      call note_in_situ(problem, load, field)
      problem%load = load
      problem%load_norm = load_norm(equations, loading)
      problem%pushed = ring_norm(equations, load%right)
      field%unknowns = from_nodes(equations, start)
      if (allocated(loads%steered)) then
         call new_loading(model, joint_points, supports, equations%modes, &
            combination_type(0, loads%steered), direction)
         call steer(problem, to_vector(equations, direction%right))
         problem%steering%factor = loads%factor
         problem%pushed = problem%pushed &
            + abs(loads%factor)*ring_norm(equations, problem%steering%load)
      end if
      if (allocated(problem%joints)) then
         call begin_joint_step(problem%joints, pushed_modes(equations, load%right), loading%external)
         call set_initial_stress(model, condensed%points, loads%given, problem%joints%field)
         problem%joints%control%tolerance = 1.0e-2_wp*control%tolerance
         problem%joints%control%most = control%most
      end if
      call balance_bodies(problem, control, field, verdict)
      state%balanced = verdict%converged
      state%ratio = verdict%ratio
      state%solutions = problem%solutions
      state%factor = problem%steering%factor
      allocate (state%displacement, mold=start)
      do k = 1, size(start, 3)
         state%displacement(:, :, k) = to_nodes(equations, field%unknowns, k)
         if (allocated(load%held)) state%displacement(:, :, k) = state%displacement(:, :, k) &
            + load%held(:, :, k)
      end do
      if (allocated(load%held)) call find_held_work(model, equations, bodies, field, &
         loading, state)
   end subroutine single_step

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

   !> Work of what holds components
   subroutine find_held_work(model, equations, bodies, field, loading, state)
      !> The job
      type(model_type), intent(in) :: model
      !> Equations, for the modes
      type(equations_type), intent(in) :: equations
      !> The bodies, and their state
      type(bodies_type), intent(in) :: bodies
      type(body_field_type), intent(in) :: field
      !> The loads, with displacements that are given
      type(loading_type), intent(inout) :: loading
      !> The state, with displacements; takes the work
      type(single_state_type), intent(inout) :: state

      real(wp), allocatable :: force(:, :)
      integer :: k

      allocate (force(3, size(state%displacement, 2)))
      loading%initial%present = .true.
      loading%initial%taken = on_all_points(bodies%place, field%amplitude, bodies%n_all)
      do k = 1, size(state%displacement, 3)
         if (.not. any(abs(loading%held(:, :, k)) > 0.0_wp)) cycle
         call solid_force(model, loading%initial, k, equations%modes(k), state%displacement(:, :, k), &
            force)
         state%held_work = state%held_work &
            + sum((force - loading%external(:, :, k))*loading%held(:, :, k))
      end do
   end subroutine find_held_work

end module axijoint_plastic_single_step
