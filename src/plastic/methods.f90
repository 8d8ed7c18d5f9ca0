!> Bodies that yield are brought to equilibrium in a load step: by Anderson's mix, by
!> Newton's method, by limited-memory BFGS, by the initial-stress loop; only the factors of the elastic structure are used
module axijoint_plastic_methods
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_base_stop, only : stop_wished
   use axijoint_joints_field, only : joint_field_type
   use axijoint_model_model, only : body_anderson, body_newton, body_lbfgs, body_transfer
   use axijoint_plastic_direction, only : newton_direction
   use axijoint_plastic_elastic, only : ring_norm
   use axijoint_plastic_field, only : body_field_type
   use axijoint_plastic_joint_side, only : linearize_joints
   use axijoint_plastic_mixing, only : mixing_type, new_mixing, mix
   use axijoint_plastic_problem, only : problem_type, iterate_type, look, is_balanced
   use axijoint_plastic_quasi_newton, only : curvature_type, new_curvature, quasi_newton_direction
   use axijoint_plastic_residual, only : evaluate, linearize, excess_force
   implicit none
   private
   public :: body_control_type, body_verdict_type, balance_bodies, quasi_newton_step

   !> Steps of the Krylov method in a step of Newton's, and the share of the residual left
   integer, parameter :: most_inner = 40
   real(wp), parameter :: forcing = 0.1_wp
   !> Iterates that the mix remembers, and steps that it takes in Newton's place
   integer, parameter :: depth = 10, substitute = 20
   !> Steps that limited-memory BFGS remembers
   integer, parameter, public :: remembered_steps = 20
   !> Share of the residual, in energy, that a step of Newton's may leave; the mix takes over if it
   !> leaves more
   real(wp), parameter :: enough = 0.5_wp
   !> Displacements so many times larger than those of the elastic bodies are no state
   real(wp), parameter :: runaway = 1.0e4_wp
   !> The residual has stopped falling if so many elastic solutions do not halve it
   integer, parameter :: patience = 400
   real(wp), parameter :: halved = 0.5_wp
   !> The mix begins anew, after a step of Newton's, if so many do not
   integer, parameter :: restless = 60
   !> Cuts of a step
   integer, parameter :: most_cuts = 5

   !> When the iterations end
   type :: body_control_type
      !> One of the `body_` parameters of the model
      integer :: method = body_anderson
      !> Tolerance on the ratio of residual forces to those of the increment
      real(wp) :: tolerance = 1.0e-6_wp
      !> Most elastic solutions of all modes
      integer :: most = 1000
   end type body_control_type

   !> How they ended
   type :: body_verdict_type
      !> Whether the step is in equilibrium, and whether displacements ran away instead: there is no
      !> equilibrium under this load
      logical :: converged = .false., ran_away = .false.
      !> Whether the residual stopped falling: a smaller step may help
      logical :: stalled = .false.
      !> Whether joints found no equilibrium on the way, and whether that was for want of iterations
      logical :: joints_failed = .false., exhausted = .false.
      !> Ratio of the residual forces
      real(wp) :: ratio = 0.0_wp
      !> Iterates, and elastic solutions of all modes
      integer :: iterations = 0, solutions = 0
      !> Share of the points that planes were needed for
      real(wp) :: on_planes = 0.0_wp
   end type body_verdict_type

   !> The way to equilibrium
   type :: course_type
      !> When it ends
      type(body_control_type) :: control
      !> What the last iterate leaves out of balance
      type(iterate_type) :: iterate
      !> How it ended
      type(body_verdict_type) :: verdict
      !> Elastic solutions before it, the displacement that counts as running away, the least
      !> residual so far, and at how many solutions it was
      integer :: begun = 0
      real(wp) :: largest = 0.0_wp, best = huge(1.0_wp)
      integer :: best_at = 0
      !> Ratios of the residual forces, one an iterate
      real(wp), allocatable :: ratios(:)
   end type course_type

contains

   !> Bring a load step to equilibrium
   subroutine balance_bodies(problem, control, field, verdict, ratios)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> When to end
      type(body_control_type), intent(in) :: control
      !> State: where to start, then in equilibrium
      type(body_field_type), intent(inout) :: field
      !> How it ended
      type(body_verdict_type), intent(out) :: verdict
      !> Ratios of the residual forces on the way
      real(wp), allocatable, intent(out), optional :: ratios(:)

      type(course_type) :: course

      course%control = control
      course%begun = problem%solutions
      course%best_at = problem%solutions
      course%largest = runaway*max(maxval(abs(field%unknowns)), maxval(abs(field%begun)), &
         tiny(1.0_wp))
      allocate (course%ratios(0))
      call look(problem, field, course%iterate)
      do
         if (ended(problem, field, course)) exit
         select case (control%method)
         case (body_transfer)
            call mix_steps(problem, field, course, 0, huge(1))
         case (body_newton)
            call newton_and_mix(problem, field, course)
         case (body_lbfgs)
            call quasi_newton_steps(problem, field, course)
         case (body_anderson)
            call mix_steps(problem, field, course, depth, huge(1))
            if (ended(problem, field, course)) exit
            call newton_and_mix(problem, field, course)
         end select
      end do
      verdict = course%verdict
      verdict%ratio = course%iterate%ratio
      verdict%solutions = problem%solutions - course%begun
      verdict%on_planes = real(size(field%on), wp)/max(1, size(field%marked))
      field%scale = course%iterate%scale
      if (present(ratios)) call move_alloc(course%ratios, ratios)
   end subroutine balance_bodies

   !> Whether there is equilibrium, or no more to try
   logical function ended(problem, field, course)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> The way so far
      type(course_type), intent(inout) :: course

      ended = course%verdict%converged
      if (ended) return
      associate (verdict => course%verdict, iterate => course%iterate, control => course%control)
         if (size(course%ratios) <= verdict%iterations) &
            course%ratios = [course%ratios, iterate%ratio]
         if (allocated(problem%joints)) &
            verdict%joints_failed = .not. (problem%joints%verdict%converged .or. problem%joints%verdict%at_rounding)
         verdict%converged = .not. verdict%joints_failed &
            .and. iterate%beyond_rounding <= control%tolerance
         if (verdict%converged) call settle(problem, control%tolerance, field, iterate, &
                                            verdict%converged)
         verdict%ran_away = maxval(abs(field%unknowns)) > course%largest
         if (iterate%ratio < halved*course%best) then
            course%best = iterate%ratio
            course%best_at = problem%solutions
         end if
         verdict%stalled = problem%solutions > course%best_at + patience &
            .and. .not. verdict%converged
         ended = stop_wished()  ! nobody uses what was reached
         ended = ended .or. verdict%converged .or. verdict%ran_away .or. verdict%stalled &
            .or. verdict%joints_failed .or. .not. ieee_is_finite(iterate%ratio) &
            .or. problem%solutions - course%begun >= control%most
         if (verdict%joints_failed) then
            associate (joints => problem%joints%verdict)
               verdict%exhausted = .not. (joints%ran_away .or. joints%stalled .or. joints%at_rounding .or. joints%mechanism%loaded)
            end associate
         end if
      end associate
   end function ended

   !> Let the bodies go where their last excess takes them: displacements follow from that excess,
   !> stresses from the displacements. It is equilibrium if the excess there is about the same
   subroutine settle(problem, tolerance, field, iterate, settled)
      !> The problem
      type(problem_type), intent(in) :: problem
      !> Tolerance on the residual forces
      real(wp), intent(in) :: tolerance
      !> The state
      type(body_field_type), intent(inout) :: field
      !> The iterate, in equilibrium
      type(iterate_type), intent(in) :: iterate
      !> Whether it is equilibrium; else the state is as before
      logical, intent(out) :: settled

      real(wp), allocatable :: residual(:), start(:), carried(:, :, :)

      start = field%unknowns
      carried = field%amplitude
      allocate (residual, mold=start)
      field%unknowns = start + iterate%response
      call evaluate(problem%equations, problem%bodies, problem%planes, problem%load, field, residual)
      residual = excess_force(problem%equations, problem%bodies, field%amplitude - carried)
      settled = is_balanced(problem, field, residual, tolerance)
      if (settled) then
         field%carried = carried
         return
      end if
      field%unknowns = start
      call evaluate(problem%equations, problem%bodies, problem%planes, problem%load, field, residual)
   end subroutine settle

   !> A step of Newton's method, then some of the mix if it leaves much
   subroutine newton_and_mix(problem, field, course)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> The way so far
      type(course_type), intent(inout) :: course

      real(wp) :: before

      before = course%iterate%energy
      call newton_step(problem, field, course%iterate)
      course%verdict%iterations = course%verdict%iterations + 1
      if (course%iterate%energy > enough*before) &
         call mix_steps(problem, field, course, depth, substitute)
   end subroutine newton_and_mix

   !> Some steps of the mix
   subroutine mix_steps(problem, field, course, remembered, most)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> The way so far
      type(course_type), intent(inout) :: course
      !> Iterates remembered, and steps at most
      integer, intent(in) :: remembered, most

      type(mixing_type) :: memory
      real(wp) :: least
      integer :: k, least_at

      memory = new_mixing(size(field%unknowns), remembered)
      least = huge(1.0_wp)
      least_at = problem%solutions
      associate (iterate => course%iterate)
         do k = 1, most
            if (ended(problem, field, course)) exit
            if (iterate%ratio < halved*least) then
               least = iterate%ratio
               least_at = problem%solutions
            end if
            if (problem%solutions > least_at + restless .and. remembered > 0) exit
            call mix(memory, field%unknowns, iterate%residual, iterate%response)
            call look(problem, field, iterate)
            course%verdict%iterations = course%verdict%iterations + 1
         end do
      end associate
   end subroutine mix_steps

   !> Steps of limited-memory BFGS
   subroutine quasi_newton_steps(problem, field, course)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> The way so far
      type(course_type), intent(inout) :: course

      type(curvature_type) :: memory

      memory = new_curvature(size(field%unknowns), remembered_steps)
      do
         if (ended(problem, field, course)) return
         call quasi_newton_step(problem, field, course%iterate, memory)
         course%verdict%iterations = course%verdict%iterations + 1
      end do
   end subroutine quasi_newton_steps

   !> A step of limited-memory BFGS
   subroutine quasi_newton_step(problem, field, iterate, memory)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> What it leaves out of balance
      type(iterate_type), intent(inout) :: iterate
      !> What the last steps showed of the tangent
      type(curvature_type), intent(inout) :: memory

      real(wp), allocatable :: direction(:)
      logical :: moved

      allocate (direction, mold=field%unknowns)
      call quasi_newton_direction(memory, field%unknowns, iterate%residual, iterate%response, &
         direction)
      call go_down(problem, field, iterate, direction, moved)
      if (moved) return
      ! no step that helps: forget what was learned, go where the elastic structure would
      memory = new_curvature(size(direction), remembered_steps)
      field%unknowns = field%unknowns + iterate%response
      call look(problem, field, iterate)
   end subroutine quasi_newton_step

   !> A step of Newton's method
   subroutine newton_step(problem, field, iterate)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> What it leaves out of balance
      type(iterate_type), intent(inout) :: iterate

      real(wp), allocatable :: direction(:)
      logical :: moved

      allocate (direction, mold=field%unknowns)
      call linearize(problem%bodies, problem%planes, field)
      if (allocated(problem%joints)) call linearize_joints(problem%joints)
      call newton_direction(problem, field, iterate, forcing, most_inner, direction)
      call go_down(problem, field, iterate, direction, moved)
   end subroutine newton_step

   !> A step along a direction, cut until the residual is smaller or, where there is a potential,
   !> most of the way down is behind; none if no cut helps
   subroutine go_down(problem, field, iterate, direction, moved)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> What it leaves out of balance
      type(iterate_type), intent(inout) :: iterate
      !> The direction
      real(wp), intent(in) :: direction(:)
      !> Whether a step was made
      logical, intent(out) :: moved

      type(joint_field_type) :: joints
      real(wp), allocatable :: start(:)
      real(wp) :: length, down, still, energy
      integer :: cut

      start = field%unknowns
      if (allocated(problem%joints)) joints = problem%joints%field
      energy = iterate%energy
      down = dot_product(iterate%residual, direction)
      length = 1.0_wp
      do cut = 0, most_cuts
         field%unknowns = start + length*direction
         call look(problem, field, iterate)
         moved = iterate%energy < (1.0_wp - 0.1_wp*length)*energy
         if (allocated(problem%joints)) then
            if (.not. problem%joints%verdict%converged) then
               moved = .false.
               problem%joints%field = joints
               length = 0.5_wp*length
               cycle
            end if
         end if
         still = dot_product(iterate%residual, direction)
         ! down a potential a step may be short, but not end far beyond the lowest place
         if (problem%has_potential) moved = moved .or. still >= -0.5_wp*down
         if (moved) return
         if (still < 0.0_wp) then  ! beyond the lowest place on the way
            length = length*min(0.7_wp, max(0.1_wp, down/(down - still)))
         else
            length = 0.5_wp*length
         end if
      end do
      field%unknowns = start
      call look(problem, field, iterate)
   end subroutine go_down

end module axijoint_plastic_methods
