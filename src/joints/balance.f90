!> Iterations of one load step to equilibrium at the joints, on the condensed
!> structure: the paper's loop, the same on total jumps, Anderson, Newton
module axijoint_joints_balance
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : opening_bond
   use axijoint_joints_anderson, only : anderson_type, new_anderson, anderson_step
   use axijoint_joints_field, only : joint_field_type, iteration_type, judge_states, break_bonds, soften, count_state
   use axijoint_joints_newton, only : newton_type, new_newton, newton_step
   use axijoint_joints_residual, only : residual_norm, ratio
   use axijoint_joints_scene, only : scene_type, evaluate
   use axijoint_model_model, only : method_newton, method_total, method_anderson
   implicit none
   private
   public :: verdict_type, balance_step

   !> Iterates that Anderson's mix remembers
   integer, parameter :: depth = 10
   !> Bonds are broken and points softened, one pass after the other, in states at
   !> least this well balanced. The last pass reaches the tolerance asked for
   real(wp), parameter :: pass_tolerance = 1.0e-4_wp
   !> Joints much stiffer than the bodies (k h/E beyond `stiff`) tear like a zip, in
   !> many passes: their bonds are broken in looser states, which comes closer to
   !> the order in which a growing load breaks them
   real(wp), parameter :: stiff = 5.0_wp, loose_pass = 0.3_wp
   !> Joints much stiffer than the bodies: the laws see a share of their stiffness
   !> first, this many times more whenever the residual ratio has fallen so far
   real(wp), parameter :: stage_factor = 10.0_wp, stage_tolerance = 0.1_wp
   !> Tolerance of Newton's linear solution far from equilibrium, the ratio from which on it
   !> is near, the least tolerance there, and the part of the step's tolerance that is left to it
   real(wp), parameter :: loose = 1.0e-3_wp, near = 1.0e-2_wp, strict = 1.0e-9_wp, part = 0.01_wp
   !> If Newton's step runs away, so many steps of Anderson's mix go before the next
   integer, parameter :: detour = 8
   !> Rounding of the forces of the excess stress
   real(wp), parameter :: rounding = 1.0e2_wp*epsilon(1.0_wp)
   !> A step without a better residual for so many iterations has stalled
   integer, parameter :: patience = 25
   !> Iterations in which a point that changes its state counts as restless
   integer, parameter :: recent = 12
   !> Jumps so many times larger than the displacements with elastic joints are no
   !> state: a Newton step to them is none, and shows a mechanism if no other step
   !> helps. (The jumps of an elastic joint are no measure: they vanish if it is stiff.)
   real(wp), parameter :: runaway = 1.0e5_wp

   !> How a load step ended
   type :: verdict_type
      !> Whether it reached equilibrium
      logical :: converged = .false.
      !> Whether the residual stopped falling, whether it is down to rounding then,
      !> and whether the jumps ran away
      logical :: stalled = .false., at_rounding = .false., ran_away = .false.
      !> Points times planes that changed their state among the last iterations,
      !> shape (points, planes); allocated if stalled
      logical, allocatable :: restless(:, :)
      !> Passes in which bonds broke or points softened
      integer :: n_passes = 0
   end type verdict_type

   !> What is remembered from iterate to iterate
   type :: watch_type
      !> Jumps beyond which there is no state
      real(wp) :: largest = 0.0_wp
      !> Best residual ratio, its iteration, and that of the last Newton step that
      !> ran away
      real(wp) :: best = huge(1.0_wp)
      integer :: best_at = 0, ran_at = -1
      !> Steps of Anderson's mix that are left before the next of Newton's
      integer :: mixes = 0
      type(anderson_type) :: memory
      !> States of the last iterate, and the iteration that changed them last, shape
      !> (points, planes)
      integer, allocatable :: before(:, :), changed(:, :)
   end type watch_type

contains

   !> Iterate a load step to equilibrium
   recursive subroutine balance_step(scene, tolerance, most, norm, now, field, path, verdict, warm)
      !> What does not change, but for a while the method
      type(scene_type), intent(inout) :: scene
      !> Tolerance on the residual ratio, and most iterations
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
      !> Norm of the largest load so far (Psi_f)
      real(wp), intent(in) :: norm
      !> Increment, iterations made in it so far, load factor
      type(iteration_type), intent(in) :: now
      !> State of the joints: of the last step, then of this one
      type(joint_field_type), intent(inout) :: field
      !> Convergence path, to be continued
      type(iteration_type), allocatable, intent(inout) :: path(:)
      !> How it ended
      type(verdict_type), intent(out) :: verdict
      !> Whether the field is about in equilibrium already, so that the laws see the whole
      !> stiffness at once; false if absent
      logical, intent(in), optional :: warm

      type(iteration_type), allocatable :: steps(:)
      type(watch_type) :: watch
      type(newton_type) :: newton
      real(wp), allocatable :: residual(:, :, :)
      real(wp) :: transferred
      logical :: again, soft
      integer :: k

      allocate (residual, mold=field%excess)
      allocate (steps(0))
      soft = scene%method == method_newton
      if (present(warm)) soft = soft .and. .not. warm
      if (soft) field%share = scene%first_share
      if (scene%proportion > stiff .and. any(scene%method == [method_total, method_anderson])) then
         call break_as_newton(scene, tolerance, most, norm, field)
      end if
      watch = new_watch(scene, field)
      call look_again(scene, field, residual, newton)
      do k = 1, most
         call append(steps, k, now)
         steps(k)%iteration = now%iteration + k
         steps(k)%ratio = ratio(residual_norm(scene%equations, scene%points, residual), norm)
         call judge_states(scene%model, scene%points, field)
         call count_state(field, scene%planes%place, steps(k)%n_slip, steps(k)%n_open)
         call look(scene, k, steps(k)%ratio, field, watch, verdict)
         if (verdict%ran_away) exit
         call go_on(scene, tolerance, steps(k)%ratio, field, watch, verdict, again)
         if (verdict%converged) exit
         if (again) then
            call look_again(scene, field, residual, newton)
            cycle
         end if
         if (verdict%stalled .or. k == most) exit
         call take_step(scene, k, tolerance, steps(k)%ratio, field, residual, newton, watch)
      end do
      field%pending = residual
      k = min(k, most)
      path = [path, steps(:k)]
      if (verdict%converged) return
      verdict%restless = watch%changed > k - recent
      if (.not. verdict%stalled) return
      transferred = residual_norm(scene%equations, scene%points, field%excess)
      verdict%at_rounding = watch%best <= rounding*ratio(transferred, norm)
   end subroutine balance_step

   !> Break the bonds that Newton's iteration breaks. In loosely balanced states the order
   !> of breaking belongs to the iterates; so all methods on total jumps take it from
   !> Newton's, and end in the same state.
   recursive subroutine break_as_newton(scene, tolerance, most, norm, field)
      !> What does not change, but for a while the method
      type(scene_type), intent(inout) :: scene
      !> Tolerance on the residual ratio, and most iterations
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
      !> Norm of the largest load so far
      real(wp), intent(in) :: norm
      !> State of the joints; its bonds break
      type(joint_field_type), intent(inout) :: field

      type(joint_field_type), allocatable :: torn
      type(iteration_type), allocatable :: path(:)
      type(verdict_type) :: verdict
      integer :: k, method

      if (all([(scene%model%joint_materials(scene%points(k)%material)%law%opening /= opening_bond, &
                k=1, size(scene%points))])) return
      allocate (torn)
      allocate (path(0))
      torn = field
      method = scene%method
      scene%method = method_newton
      call balance_step(scene, tolerance, most, norm, iteration_type(), torn, path, verdict)
      scene%method = method
      if (verdict%converged) field%memory%broken = torn%memory%broken
   end subroutine break_as_newton

   !> Room for one more line of a path, which grows by doubling
   subroutine append(steps, k, step)
      !> The path
      type(iteration_type), allocatable, intent(inout) :: steps(:)
      !> Place of the line
      integer, intent(in) :: k
      !> The line
      type(iteration_type), intent(in) :: step

      type(iteration_type), allocatable :: longer(:)

      if (k > size(steps)) then
         allocate (longer(2*k))
         longer(:k - 1) = steps(:k - 1)
         call move_alloc(longer, steps)
      end if
      steps(k) = step
   end subroutine append

   !> Nothing seen yet
   function new_watch(scene, field) result(watch)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The watch
      type(watch_type) :: watch

      watch%memory = new_anderson(size(field%excess), depth)
      watch%largest = runaway*maxval([tiny(1.0_wp), scene%response%largest, abs(scene%response%free), &
                                      abs(field%jump)])
      watch%before = field%state
      watch%changed = 0*field%state
   end function new_watch

   !> Take note of an iterate: what changed, whether it ran away, whether it stalls
   subroutine look(scene, k, ratio, field, watch, verdict)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Iteration, and its residual ratio
      integer, intent(in) :: k
      real(wp), intent(in) :: ratio
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The watch
      type(watch_type), intent(inout) :: watch
      !> Takes `ran_away` and `stalled`
      type(verdict_type), intent(inout) :: verdict

      where (field%state /= watch%before) watch%changed = k
      watch%before = field%state
      verdict%ran_away = .not. ieee_is_finite(ratio)
      if (verdict%ran_away) return
      verdict%ran_away = maxval(abs(field%jump)) > watch%largest
      if (ratio < 0.9_wp*watch%best) then
         watch%best = ratio
         watch%best_at = k
      end if
      verdict%stalled = scene%method == method_newton .and. k > watch%best_at + patience
      if (verdict%stalled) verdict%ran_away = watch%ran_at >= watch%best_at
   end subroutine look

   !> In a state that is balanced well enough, see what is next: more of the joints'
   !> stiffness, the next bonds to break, or the end
   subroutine go_on(scene, tolerance, ratio, field, watch, verdict, again)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Tolerance on the residual ratio, and the ratio
      real(wp), intent(in) :: tolerance, ratio
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> The watch; begins again if the task changed
      type(watch_type), intent(inout) :: watch
      !> Takes `converged` and the passes
      type(verdict_type), intent(inout) :: verdict
      !> Whether the task changed
      logical, intent(out) :: again

      integer :: n_broken, n_softened

      again = field%share < 1.0_wp .and. ratio <= stage_tolerance
      if (again) then
         field%share = min(1.0_wp, stage_factor*field%share)
      else if (field%share >= 1.0_wp) then
         if (scene%method == method_newton .and. scene%proportion > stiff .and. ratio <= loose_pass) then
            call break_bonds(scene%model, scene%points, field, n_broken)
            again = n_broken > 0
         end if
         if (.not. again .and. ratio <= max(tolerance, pass_tolerance)) then
            call break_bonds(scene%model, scene%points, field, n_broken)
            call soften(scene%model, scene%points, field, n_softened)
            again = n_broken + n_softened > 0
            verdict%converged = .not. again .and. ratio <= tolerance
         end if
         if (again) verdict%n_passes = verdict%n_passes + 1
      end if
      if (.not. again) return
      watch%best = huge(1.0_wp)
      watch%memory = new_anderson(size(field%excess), depth)
   end subroutine go_on

   !> One step of the method; where Newton's runs away, some of Anderson's mix
   subroutine take_step(scene, k, tolerance, ratio, field, residual, newton, watch)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Iteration
      integer, intent(in) :: k
      !> Tolerance on the residual ratio, and the ratio
      real(wp), intent(in) :: tolerance, ratio
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress not transferred; of the new state on return
      real(wp), intent(inout), contiguous :: residual(:, :, :)
      !> Laws about the state, for Newton's method
      type(newton_type), intent(inout) :: newton
      !> The watch
      type(watch_type), intent(inout) :: watch

      real(wp), allocatable :: x(:)
      real(wp) :: accuracy
      logical :: made, ran

      if (scene%method == method_newton .and. watch%mixes == 0) then
         ! near to equilibrium, so exactly that one step can reach the tolerance
         accuracy = merge(min(loose, max(strict, part*tolerance/max(tiny(ratio), ratio))), loose, ratio < near)
         call newton_step(scene, accuracy, watch%largest, newton, field, residual, &
                          made, ran)
         if (ran) watch%ran_at = k
         if (made) return
         watch%mixes = detour
         watch%memory = new_anderson(size(field%excess), depth)
      end if
      if (scene%method == method_newton .or. scene%method == method_anderson) then
         watch%mixes = watch%mixes - 1
         x = reshape(field%excess, [size(field%excess)])
         call anderson_step(watch%memory, x, reshape(residual, [size(x)]))
         field%excess = reshape(x, shape(field%excess))
      else
         field%excess = field%excess + residual
      end if
      call look_again(scene, field, residual, newton)
   end subroutine take_step

   !> What an iterate leaves without equilibrium, and the laws about it for Newton's
   !> method
   subroutine look_again(scene, field, residual, newton)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress not transferred
      real(wp), intent(out) :: residual(:, :, :)
      !> Laws about the state
      type(newton_type), intent(inout) :: newton

      call evaluate(scene, field, residual)
      if (scene%method == method_newton) newton = new_newton(scene, field)
   end subroutine look_again

end module axijoint_joints_balance
