!> A load step of bodies that yield as methods see it: what is out of balance, how the elastic
!> structure answers it, and the load factor if a displacement is given instead of the load
module axijoint_plastic_problem
   use axijoint_assembly_equations, only : equations_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_joints_planes, only : planes_type
   use axijoint_plastic_bodies, only : bodies_type
   use axijoint_plastic_elastic, only : elastic_response, pushed_modes, ring_norm, to_nodes
   use axijoint_plastic_field, only : body_field_type, body_load_type
   use axijoint_plastic_joint_side, only : joint_side_type, begin_joint_step, balance_joints, &
      steer_joints, add_units, joint_tangent_force
   use axijoint_plastic_residual, only : evaluate, elastic_force
   implicit none
   private
   public :: slight, problem_type, steering_type, iterate_type, put_load, steer, look, turn, give_way, go_to_displacement, &
      note_pushed, is_balanced

   !> Increments are repeated so often at most, for the start of the next
   real(wp), parameter :: most_repeated = 10.0_wp

   !> Residuals this small beside the forces of the bodies are rounding
   real(wp), parameter :: resolution = 1.0e-11_wp

   !> The same of a part beside the loads on it, which bodies that do not yield may bear; and forces of a step, or in it of a
   !> part, so small beside those of all are no measure
   real(wp), parameter :: resolution_of_loads = 1.0e-13_wp, of_no_account = 1.0e-12_wp

   !> Where a displacement is given, forces below this part of those that it would take if all held are no measure of what
   !> is out of balance: the load that it needs may be none, as in a gap
   real(wp), parameter :: slight = 1.0e-3_wp

   !> Load control by the displacement that is work-conjugate to the load: where that is given, the
   !> load factor is found, beyond the limit load, too
   type :: steering_type
      !> Load of a factor of one, and the response of the elastic structure to it; not allocated if
      !> the load is given
      real(wp), allocatable :: load(:), response(:)
      !> Load factor
      real(wp) :: factor = 0.0_wp
   end type steering_type

   !> The problem
   type :: problem_type
      !> Equations of all modes
      type(equations_type), pointer :: equations => null()
      !> Bodies and planes
      type(bodies_type), pointer :: bodies => null()
      type(planes_type) :: planes
      !> Loads without that of the steering
      type(body_load_type) :: load
      !> What gives the load
      type(steering_type) :: steering
      !> Joints that open and slip, if there are any
      type(joint_side_type), allocatable :: joints
      !> Norm of the loads that are given, of those that balance each other, too
      real(wp) :: load_norm = 0.0_wp
      !> Norm of the forces that the step would add if the bodies held; and part by part
      real(wp) :: pushed = 0.0_wp
      real(wp), allocatable :: pushed_parts(:)
      !> Part of each node, counted among those that can yield, zero of the others; not allocated where all nodes are of one part
      integer, allocatable :: part(:)
      !> Norm of the largest loads so far, which no residual is held against more; none if zero
      real(wp) :: peak = 0.0_wp
      !> Whether stresses have a potential, so that tangents are symmetric: plastic strain is normal
      !> to all criteria, and no joint slips or opens
      logical :: has_potential = .true.
      !> Elastic solutions of all modes so far
      integer :: solutions = 0
   end type problem_type

   !> What an iterate leaves out of balance
   type :: iterate_type
      !> Forces on the unknowns r, and the response K^-1 r of the elastic structure, both without
      !> what the load factor balances
      real(wp), allocatable :: residual(:), response(:)
      !> sqrt(r K^-1 r), and the norm of r over that of the forces of the step: what it adds to
      !> those of the bodies, or, where these yield, what it would add if they held, up to all. Of the whole, or of the part
      !> in which it is most: a small load does not hide behind a large one
      real(wp) :: energy = 0.0_wp, ratio = 0.0_wp
      !> The same where residuals that are rounding do not count
      real(wp) :: beyond_rounding = 0.0_wp
      !> That norm of forces of the whole
      real(wp) :: scale = 0.0_wp
   end type iterate_type

contains

   !> Put loads on. As far as they go on like those of the last increment, so does the state; under
   !> the rest it moves as the elastic structure does
   subroutine put_load(problem, load, external, field)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The loads
      type(body_load_type), intent(in) :: load
      !> External forces on components, shape (3, nodes, modes)
      real(wp), intent(in) :: external(:, :, :)
      !> The state
      type(body_field_type), intent(inout) :: field

      real(wp), dimension(size(field%unknowns)) :: change, response
      real(wp) :: share

      change = load%right - field%right
      call note_pushed(problem, change, 1.0_wp)
      share = going_on(dot_product(change, field%pushed), dot_product(field%pushed, field%pushed))
      call elastic_response(problem%equations, change - share*field%pushed, response)
      problem%solutions = problem%solutions + 1
      field%unknowns = field%begun + share*field%moved + response
      problem%load = load
      if (allocated(problem%joints)) call begin_joint_step(problem%joints, &
         pushed_modes(problem%equations, change), external)
   end subroutine put_load

   !> How much of the last increment a new one repeats; nothing if it turns back
   pure real(wp) function going_on(work, last)
      !> Product of what is new with the last, and of the last with itself
      real(wp), intent(in) :: work, last

      going_on = 0.0_wp
      if (last > 0.0_wp) going_on = min(max(0.0_wp, work/last), most_repeated)
   end function going_on

   !> Let the work-conjugate displacement of a load be given
   subroutine steer(problem, load)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> Load of a factor of one, on the unknowns
      real(wp), intent(in) :: load(:)

      problem%steering%load = load
      allocate (problem%steering%response, mold=load)
      call elastic_response(problem%equations, load, problem%steering%response)
      problem%solutions = problem%solutions + 1
   end subroutine steer

   !> Let the load of a factor of one do a given work: the start of a step. The state goes on as in
   !> the last increment, or as the elastic structure would
   subroutine go_to_displacement(problem, work, field)
      !> The problem, steered
      type(problem_type), intent(inout) :: problem
      !> Load of a factor of one times displacement
      real(wp), intent(in) :: work
      !> The state
      type(body_field_type), intent(inout) :: field

      real(wp) :: step

      associate (steering => problem%steering)
         step = work - dot_product(steering%load, field%begun)
         call note_pushed(problem, steering%load, abs(step)/dot_product(steering%load, steering%response))
         field%unknowns = field%begun + going_on(step*dot_product(steering%load, field%moved), &
            dot_product(steering%load, field%moved)**2)*field%moved
         if (allocated(problem%joints)) call steer_joints(problem%joints, problem%equations, &
            steering%load, steering%response, &
            step/dot_product(steering%load, steering%response))
         step = (work - dot_product(steering%load, field%unknowns)) &
            /dot_product(steering%load, steering%response)
         field%unknowns = field%unknowns + step*steering%response
         steering%factor = steering%factor + step
      end associate
   end subroutine go_to_displacement

   !> Look at an iterate
   subroutine look(problem, field, iterate)
      !> The problem; its load factor follows the iterate
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> What it leaves out of balance
      type(iterate_type), intent(inout) :: iterate

      real(wp) :: change

      if (.not. allocated(iterate%residual)) &
         allocate (iterate%residual, iterate%response, mold=field%unknowns)
      call evaluate(problem%equations, problem%bodies, problem%planes, problem%load, field, &
                    iterate%residual)
      if (allocated(problem%steering%load)) iterate%residual = &
         iterate%residual + problem%steering%factor*problem%steering%load
      call turn(problem, iterate%residual, iterate%response, change)
      problem%steering%factor = problem%steering%factor + change
      if (allocated(problem%joints)) call add_joints(problem, field, iterate)
      iterate%energy = sqrt(max(0.0_wp, dot_product(iterate%residual, iterate%response)))
      call measure(problem, field, iterate%residual, iterate%ratio, iterate%beyond_rounding, iterate%scale)
   end subroutine look

   !> Note the norms of forces that a step would add if the bodies held
   subroutine note_pushed(problem, force, factor, more)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> Forces on the unknowns, and what they are multiplied by
      real(wp), intent(in) :: force(:), factor
      !> Whether they come to those noted before; false if absent
      logical, intent(in), optional :: more

      real(wp), allocatable :: of_parts(:)
      logical :: adds

      adds = .false.
      if (present(more)) adds = more
      problem%pushed = factor*ring_norm(problem%equations, force) + merge(problem%pushed, 0.0_wp, adds)
      if (.not. allocated(problem%part)) return
      of_parts = factor*norms_of_parts(problem, on_components(problem, force))
      if (adds) of_parts = of_parts + problem%pushed_parts
      call move_alloc(of_parts, problem%pushed_parts)
   end subroutine note_pushed

   !> Whether forces are as little out of balance as a tolerance says, or rounding
   logical function is_balanced(problem, field, residual, tolerance)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> The state, evaluated
      type(body_field_type), intent(in) :: field
      !> Forces on the unknowns, and the tolerance on their ratio to those of the step
      real(wp), intent(in) :: residual(:), tolerance

      real(wp) :: ratio, beyond_rounding, scale

      call measure(problem, field, residual, ratio, beyond_rounding, scale)
      is_balanced = beyond_rounding <= tolerance
   end function is_balanced

   !> Hold residual forces against those of the step, of the whole and part by part
   subroutine measure(problem, field, residual, ratio, beyond_rounding, scale)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> The state, evaluated
      type(body_field_type), intent(in) :: field
      !> Forces on the unknowns
      real(wp), intent(in) :: residual(:)
      !> The largest ratio; the same where residuals that are rounding do not count; and what that of the whole is held against
      real(wp), intent(out) :: ratio, beyond_rounding, scale

      real(wp), allocatable :: left(:), acting(:), whole(:), forces(:)
      real(wp) :: loads, most, worst

      loads = ring_norm(problem%equations, found_load(problem))
      most = max(whole_force(problem, field), loads)
      ratio = ring_norm(problem%equations, residual)
      scale = forces_of_step(problem, force_norm(problem%equations, field%force - field%force_before), &
         whole_force(problem, field), problem%pushed, loads, field%scale)
      if (scale <= of_no_account*most) scale = most
      beyond_rounding = ratio/max(scale, tiny(1.0_wp))
      ! what is no number, or infinite, is no rounding
      if (ratio <= resolution*most .and. most <= huge(1.0_wp)) beyond_rounding = 0.0_wp
      ratio = ratio/max(scale, tiny(1.0_wp))
      if (.not. allocated(problem%part)) return
      left = norms_of_parts(problem, on_components(problem, residual))
      acting = norms_of_parts(problem, on_components(problem, found_load(problem)))
      whole = norms_of_parts(problem, field%force)
      forces = forces_of_step(problem, norms_of_parts(problem, field%force - field%force_before), whole, &
         problem%pushed_parts, loads, 0.0_wp)
      worst = maxval([0.0_wp, pack(left/max(forces, tiny(1.0_wp)), forces > of_no_account*most &
         .and. left > max(resolution*whole, resolution_of_loads*acting))])
      if (worst > ratio) ratio = worst
      if (worst > beyond_rounding) beyond_rounding = worst
   end subroutine measure

   !> Norm of the forces of a step, which residuals are held against
   pure elemental real(wp) function forces_of_step(problem, change, whole, pushed, loads, before) result(forces)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> Norms of what the step adds to the forces of the bodies, of all these, and of what it would add if they held
      real(wp), intent(in) :: change, whole, pushed
      !> Norm of the loads with the load factor, and what a step without loads is held against
      real(wp), intent(in) :: loads, before

      real(wp) :: largest

      forces = max(change, min(pushed, whole))
      if (.not. problem%pushed > 0.0_wp) forces = max(forces, before)
      largest = problem%peak
      if (allocated(problem%steering%load)) largest = max(largest, loads)
      if (largest > 0.0_wp) forces = min(forces, largest)
      if (allocated(problem%steering%load)) forces = max(forces, slight*problem%pushed)
   end function forces_of_step

   !> Forces on components from those on the unknowns
   function on_components(problem, force) result(components)
      !> The problem, with parts
      type(problem_type), intent(in) :: problem
      !> The forces
      real(wp), intent(in) :: force(:)
      !> Shape (3, nodes, modes)
      real(wp), allocatable :: components(:, :, :)

      integer :: k

      allocate (components(3, size(problem%part), size(problem%equations%modes)))
      do k = 1, size(components, 3)
         components(:, :, k) = to_nodes(problem%equations, force, k)
      end do
   end function on_components

   !> Norms of forces, part by part
   pure function norms_of_parts(problem, force) result(norms)
      !> The problem, with parts
      type(problem_type), intent(in) :: problem
      !> Shape (3, nodes, modes)
      real(wp), intent(in) :: force(:, :, :)
      !> One a part that can yield
      real(wp), allocatable :: norms(:)

      integer :: k, node

      allocate (norms(maxval(problem%part)), source=0.0_wp)
      do k = 1, size(force, 3)
         do node = 1, size(problem%part)
            associate (p => problem%part(node))
               if (p > 0) norms(p) = norms(p) + sum(force(:, node, k)**2)/circle_integral(problem%equations%modes(k)%harmonic)
            end associate
         end do
      end do
      norms = sqrt(norms)
   end function norms_of_parts

   !> Loads on the unknowns, with the load factor that was found so far if they are steered
   pure function found_load(problem) result(load)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> The loads
      real(wp), allocatable :: load(:)

      load = problem%load%right
      if (allocated(problem%steering%load)) load = load + problem%steering%factor*problem%steering%load
   end function found_load

   !> Norm of the forces of the bodies
   pure real(wp) function whole_force(problem, field)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> The state, evaluated
      type(body_field_type), intent(in) :: field

      whole_force = force_norm(problem%equations, field%force)
   end function whole_force

   !> Norm of forces on all components
   pure real(wp) function force_norm(equations, force)
      !> The equations, for the modes
      type(equations_type), intent(in) :: equations
      !> Shape (3, nodes, modes)
      real(wp), intent(in) :: force(:, :, :)

      integer :: k

      force_norm = 0.0_wp
      do k = 1, size(force, 3)
         force_norm = force_norm + sum(force(:, :, k)**2) &
            /circle_integral(equations%modes(k)%harmonic)
      end do
      force_norm = sqrt(force_norm)
   end function force_norm

   !> Let joints give way to what is out of balance: they are in equilibrium where the response
   !> goes. The residual is then what the bodies have of it, elastic forces of the response
   subroutine add_joints(problem, field, iterate)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(in) :: field
      !> The iterate
      type(iterate_type), intent(inout) :: iterate

      real(wp), dimension(size(field%unknowns)) :: force, response
      real(wp) :: change, norm

      norm = max(problem%load_norm, problem%peak)
      if (allocated(problem%steering%load)) norm = max(norm, ring_norm(problem%equations, found_load(problem)))
      call balance_joints(problem%joints, problem%equations, field%unknowns + iterate%response, &
                          problem%load%held, norm, force)
      call turn(problem, force, response, change)
      problem%steering%factor = problem%steering%factor + change
      call add_units(problem%joints, change)
      iterate%response = iterate%response + response
      iterate%residual = elastic_force(problem%equations, problem%bodies, iterate%response)
   end subroutine add_joints

   !> Forces by which joints, linearized, answer forces: these and those together act on the elastic
   !> structure
   subroutine give_way(problem, force)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> Forces on the unknowns; takes those of the joints
      real(wp), intent(inout) :: force(:)

      real(wp), dimension(size(force)) :: response, answer
      real(wp) :: unused

      if (.not. allocated(problem%joints)) return
      call turn(problem, force, response, unused)
      call joint_tangent_force(problem%joints, problem%equations, response, answer)
      force = force + answer
   end subroutine give_way

   !> Response of the elastic structure to forces. If a displacement is given, it does no work with
   !> the steering load: the forces are changed by as much of that load
   subroutine turn(problem, force, response, change)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> Forces on the unknowns
      real(wp), intent(inout) :: force(:)
      !> The response
      real(wp), intent(out) :: response(:)
      !> Change of the load factor that is in the forces then
      real(wp), intent(out) :: change

      call elastic_response(problem%equations, force, response)
      problem%solutions = problem%solutions + 1
      change = 0.0_wp
      if (.not. allocated(problem%steering%load)) return
      associate (load => problem%steering%load, own => problem%steering%response)
         change = -dot_product(load, response)/dot_product(load, own)
         force = force + change*load
         response = response + change*own
      end associate
   end subroutine turn

end module axijoint_plastic_problem
