!> Iterations of one load step to equilibrium at the joints, on the condensed
!> structure: the paper's loop, the same on total jumps, Anderson, Newton
module axijoint_joints_balance
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : opening_bond
   use axijoint_joints_approach, only : approach
   use axijoint_joints_anderson, only : anderson_type, new_anderson, anderson_step
   use axijoint_joints_field, only : joint_field_type, iteration_type, judge_states, break_bonds, soften, count_state
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, settle, balance_motions
   use axijoint_joints_newton, only : newton_type, new_newton, newton_step
   use axijoint_joints_residual, only : strictest_type, strictest, residual_norm
   use axijoint_joints_scene, only : scene_type, evaluate, views
   use axijoint_model_model, only : method_newton, method_total, method_anderson, method_transfer
   implicit none
   private
   public :: verdict_type, balance_step

   !> Iterates that Anderson's mix remembers
   integer, parameter :: depth = 10
   !> Bonds are broken and points softened, one pass after the other, in states at
   !> least this well balanced. The last pass reaches the tolerance asked for
   real(wp), parameter :: pass_tolerance = 1.0e-4_wp
   !> Joints much stiffer than the bodies tear like a zip, in many passes: their bonds are broken in looser
   !> states, which comes closer to the order in which a growing load breaks them. k h/E of stiff and of
   !> very stiff joints, and how loose the states are
   real(wp), parameter :: stiff = 5.0_wp, loose_pass = 0.3_wp, very_stiff = 100.0_wp, loosest_pass = 1.0_wp
   !> Joints much stiffer than the bodies: the laws see a share of their stiffness
   !> first, this many times more whenever the residual ratio has fallen so far
   real(wp), parameter :: stage_factor = 10.0_wp, stage_tolerance = 0.1_wp
   !> Weak springs in place of joints that do not resist a motion under load: their first share of the joints'
   !> stiffness, what it falls by whenever the ratio has fallen to `stage_tolerance`, and the last
   real(wp), parameter :: first_leak = 1.0e-2_wp, leak_factor = 1.0e-2_wp, last_leak = 1.0e-8_wp
   !> Tolerance of Newton's linear solution far from equilibrium, with very stiff joints, the ratio from which on it
   !> is near, the least tolerance there, and the part of the step's tolerance that is left to it
   real(wp), parameter :: loose = 1.0e-3_wp, closer = 1.0e-4_wp, near = 1.0e-2_wp, strict = 1.0e-9_wp, part = 0.01_wp
   !> Rounding of the forces of the excess stress
   real(wp), parameter :: rounding = 1.0e2_wp*epsilon(1.0_wp)
   !> A step without a better residual for so many iterations has stalled
   integer, parameter :: patience = 25
   !> How many times as much may be missing after a step of Newton's: more helps on the way, but goes round in circles
   !> where the residual no longer falls
   real(wp), parameter :: bold = 2.0_wp, careful = 1.0_wp
   !> Change of the jumps by the first steps, in displacements with elastic joints: of several states the near one is
   !> found. It grows as steps want more
   real(wp), parameter :: first_radius = 3.0_wp
   !> The loop on total jumps no longer balances rigid motions after so many sweeps without a better residual
   integer, parameter :: most_moves = 25
   !> Iterations in which a point that changes its state counts as restless
   integer, parameter :: recent = 12
   !> Jumps so many times larger than the displacements with elastic joints are no
   !> state: a Newton step to them is not made. (The jumps of an elastic joint are no measure: they
   !> vanish if it is stiff.)
   real(wp), parameter :: runaway = 1.0e5_wp

   !> How a load step ended
   type :: verdict_type
      !> Whether it reached equilibrium
      logical :: converged = .false.
      !> Whether the residual stopped falling, whether it is down to rounding then,
      !> and whether the jumps ran away
      logical :: stalled = .false., at_rounding = .false., ran_away = .false.
      !> Rigid motions that the joints do not resist at the end
      type(mechanism_type) :: mechanism
      !> Points times planes that changed their state among the last iterations,
      !> shape (points, planes); allocated if stalled
      logical, allocatable :: restless(:, :)
      !> Passes in which bonds broke or points softened
      integer :: n_passes = 0
      !> The largest ratio of residual forces at the end
      type(strictest_type) :: residual
   end type verdict_type

   !> What is remembered from iterate to iterate
   type :: watch_type
      !> Jumps beyond which there is no state
      real(wp) :: largest = 0.0_wp
      !> Change of the jumps beyond which Newton's steps are shortened
      real(wp) :: radius = 0.0_wp
      !> Best residual ratio, and its iteration
      real(wp) :: best = huge(1.0_wp)
      integer :: best_at = 0
      !> Whether the last residual was the best, and whether steps are long whatever it does
      logical :: falls = .true., far = .false.
      !> Whether the loop on total jumps balances rigid motions by themselves
      logical :: moves = .true.
      !> Whether a step of Newton's was not made, whether weak springs were tried, and steps made with those of now
      logical :: ran = .false., leaked = .false.
      integer :: n_steps = 0
      type(anderson_type) :: memory
      !> Jumps of the state that the load step begins with, shape (3, points, planes)
      real(wp), allocatable :: begun(:, :, :)
      !> States of the last iterate, and the iteration that changed them last, shape
      !> (points, planes)
      integer, allocatable :: before(:, :), changed(:, :)
   end type watch_type

contains

   !> Iterate a load step to equilibrium
   recursive subroutine balance_step(scene, tolerance, most, now, field, path, verdict, warm)
      !> What does not change, but for a while the method; residuals are held against the reference of its measure
      type(scene_type), intent(inout) :: scene
      !> Tolerance on the residual ratio, and most iterations
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
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
      !> The state at the start, and the last that ran away
      type(joint_field_type), allocatable :: start, astray
      !> The state when weak springs were taken away, and how strong they were
      type(joint_field_type), allocatable :: held
      real(wp) :: springs, leak
      type(watch_type) :: watch
      type(newton_type) :: newton
      real(wp), allocatable :: residual(:, :, :), begun(:, :, :)
      logical :: again, soft, moved
      integer :: k

      allocate (residual, mold=field%excess)
      allocate (steps(0))
      springs = 0.0_wp
      soft = scene%method == method_newton
      if (present(warm)) soft = soft .and. .not. warm
      soft = soft .and. scene%first_share < 1.0_wp
      if (scene%proportion > stiff .and. any(scene%method == [method_total, method_anderson])) then
         call break_as_newton(scene, tolerance, most, field)
      end if
      if (soft) field%share = scene%first_share
      begun = field%jump
      call look_again(scene, 1.0_wp, field, residual, newton)
      if (scene%method /= method_transfer) call approach(scene, .true., begun, field, residual, moved)
      start = field
      watch = new_watch(scene, field)
      call move_alloc(begun, watch%begun)
      if (scene%method == method_newton) then
         newton = new_newton(scene, field, 1.0_wp)
         call find_mechanism(scene, field, .false., verdict%mechanism)
         if (verdict%mechanism%loaded) call hold_weakly()
      end if
      do k = 1, most
         call append(steps, k, now)
         verdict%residual = strictest(scene%measure, residual, paper=scene%method == method_transfer)
         steps(k)%iteration = now%iteration + k
         steps(k)%ratio = verdict%residual%ratio
         call judge_states(scene%model, scene%points, field)
         call count_state(field, scene%planes%place, steps(k)%n_slip, steps(k)%n_open)
         call look(scene, k, steps(k)%ratio, field, watch, verdict)
         if (verdict%ran_away .or. verdict%stalled) then
            if (verdict%ran_away) astray = field
            if (.not. (soft .or. may_go_far() .or. may_hold_weakly() .or. may_weaken())) exit
            if (may_weaken()) then  ! taken away too early
               springs = max(last_leak, leak_factor*springs)
               field = held
               call begin_again(leak=springs)
               cycle
            end if
            field = start
            if (soft) then
               soft = .false.
               call begin_again(leak=0.0_wp)
            else if (may_go_far()) then
               watch%far = .true.
               call begin_again(leak=0.0_wp)
            else
               call hold_weakly()
            end if
            cycle
         end if
         leak = field%leak
         call go_on(scene, tolerance, field, residual, watch, verdict, again)
         if (leak > 0.0_wp .and. .not. field%leak > 0.0_wp) then
            springs = leak
            held = field
         end if
         if (verdict%converged) exit
         if (verdict%mechanism%loaded) then
            if (.not. may_hold_weakly()) exit
            call hold_weakly()
            cycle
         end if
         if (k == most) exit
         if (again) call look_again(scene, steps(k)%ratio, field, residual, newton)
         call take_step(scene, tolerance, steps(k)%ratio, field, residual, newton, watch)
      end do
      if (verdict%stalled .and. allocated(astray)) then
         verdict%ran_away = .true.
         field = astray
         call evaluate(scene, field, residual)
      end if
      field%pending = residual
      field%leak = 0.0_wp
      k = min(k, most)
      path = [path, steps(:k)]
      if (verdict%converged) return
      verdict%restless = watch%changed > k - recent
      if (.not. verdict%stalled) return
      verdict%at_rounding = watch%best <= rounding*(residual_norm(scene%measure, field%excess) &
                                                    /residual_norm(scene%measure, residual))*steps(k)%ratio

   contains

      !> Whether long steps may still help, or show that there is no state
      logical function may_go_far() result(may)
         may = scene%method == method_newton .and. verdict%stalled .and. .not. (watch%far .or. watch%leaked) .and. k < most
      end function may_go_far

      !> Whether weaker springs may do where none do not
      logical function may_weaken() result(may)
         may = .not. soft .and. field%leak <= 0.0_wp .and. springs > last_leak .and. k < most
      end function may_weaken

      !> Whether weak springs may still help
      logical function may_hold_weakly() result(may)
         may = scene%method == method_newton .and. size(scene%floating) > 0 .and. .not. watch%leaked .and. k < most
      end function may_hold_weakly

      !> Go on with weak springs
      subroutine hold_weakly()
         watch%leaked = .true.
         watch%far = .false.
         watch%radius = huge(1.0_wp)  ! the springs hold
         call begin_again(first_leak)
      end subroutine hold_weakly

      !> Go on from the field as if the iterations began
      subroutine begin_again(leak)
         !> Weak springs, as a share of the joints' stiffness
         real(wp), intent(in) :: leak

         verdict%ran_away = .false.
         verdict%stalled = .false.
         verdict%mechanism%loaded = .false.
         watch%best = huge(1.0_wp)
         watch%n_steps = 0
         field%leak = leak
         call look_again(scene, 1.0_wp, field, residual, newton)
      end subroutine begin_again

   end subroutine balance_step

   !> Break the bonds that Newton's iteration breaks. In loosely balanced states the order
   !> of breaking belongs to the iterates; so all methods on total jumps take it from
   !> Newton's, and end in the same state.
   recursive subroutine break_as_newton(scene, tolerance, most, field)
      !> What does not change, but for a while the method
      type(scene_type), intent(inout) :: scene
      !> Tolerance on the residual ratio, and most iterations
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
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
      call balance_step(scene, tolerance, most, iteration_type(), torn, path, verdict)
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
      watch%radius = first_radius*watch%largest/runaway
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
      verdict%ran_away = watch%ran .or. .not. ieee_is_finite(ratio)
      watch%ran = .false.
      if (verdict%ran_away) return
      verdict%ran_away = maxval(abs(field%jump)) > watch%largest .and. .not. field%leak > 0.0_wp
      if (ratio < 0.9_wp*watch%best) then
         watch%best = ratio
         watch%best_at = k
      end if
      watch%falls = watch%best_at == k
      watch%moves = watch%moves .and. k <= watch%best_at + most_moves
      verdict%stalled = scene%method == method_newton .and. k > watch%best_at + patience
   end subroutine look

   !> In a state that is balanced well enough, see what is next: weaker springs, more of the joints'
   !> stiffness, the next bonds to break, or the end
   subroutine go_on(scene, tolerance, field, residual, watch, verdict, again)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Tolerance on the residual ratio
      real(wp), intent(in) :: tolerance
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress that is not transferred
      real(wp), intent(inout) :: residual(:, :, :)
      !> The watch; begins again if the task changed
      type(watch_type), intent(inout) :: watch
      !> Takes `converged`, the passes, and a mechanism
      type(verdict_type), intent(inout) :: verdict
      !> Whether the task changed
      logical, intent(out) :: again

      integer :: n_broken, n_softened
      real(wp) :: ratio

      ratio = verdict%residual%ratio
      again = .false.
      if (field%leak > 0.0_wp) then
         again = ratio <= stage_tolerance .and. watch%n_steps > 0
         if (again) call weaken(scene, field, verdict)
      else if (field%share < 1.0_wp) then
         again = verdict%residual%whole <= stage_tolerance
         if (again) call stiffen(scene, field, residual)
      else
         if (scene%method == method_newton .and. scene%proportion > stiff &
             .and. ratio <= merge(loosest_pass, loose_pass, scene%proportion > very_stiff)) then
            call break_bonds(scene%model, scene%points, field, n_broken)
            again = n_broken > 0
         end if
         if (.not. again .and. ratio <= max(tolerance, pass_tolerance)) then
            call break_bonds(scene%model, scene%points, field, n_broken)
            call soften(scene%model, scene%points, field, n_softened)
            again = n_broken + n_softened > 0
            if (.not. again .and. ratio <= tolerance) call conclude(scene, tolerance, field, residual, verdict)
         end if
         if (again) verdict%n_passes = verdict%n_passes + 1
      end if
      if (.not. again) return
      watch%best = huge(1.0_wp)
      watch%n_steps = 0
      watch%memory = new_anderson(size(field%excess), depth)
   end subroutine go_on

   !> Let the laws see more of the joints' stiffness, as much as leaves the state about in balance
   subroutine stiffen(scene, field, residual)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress that is not transferred
      real(wp), intent(inout) :: residual(:, :, :)

      type(strictest_type) :: found

      do while (field%share < 1.0_wp)
         field%share = min(1.0_wp, stage_factor*field%share)
         call evaluate(scene, field, residual)
         found = strictest(scene%measure, residual, paper=.false.)
         if (found%whole > stage_tolerance) exit
      end do
   end subroutine stiffen

   !> Take the springs away where joints resist all motions under load by now, else weaken them. What they alone still
   !> hold when they are weakest is a mechanism
   subroutine weaken(scene, field, verdict)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Takes a mechanism
      type(verdict_type), intent(inout) :: verdict

      call find_mechanism(scene, field, .false., verdict%mechanism)
      if (verdict%mechanism%loaded .and. field%leak > last_leak) then
         verdict%mechanism%loaded = .false.
         field%leak = max(last_leak, leak_factor*field%leak)
      else
         field%leak = 0.0_wp
      end if
   end subroutine weaken

   !> See whether a state within the tolerance is one: by what the laws say if they see the jumps, not parts of them,
   !> and if no load acts on a motion that nothing resists
   subroutine conclude(scene, tolerance, field, residual, verdict)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Tolerance on the residual ratio
      real(wp), intent(in) :: tolerance
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress that is not transferred
      real(wp), intent(inout) :: residual(:, :, :)
      !> Takes `converged` and the mechanism
      type(verdict_type), intent(inout) :: verdict

      type(strictest_type) :: found
      type(joint_field_type), allocatable :: settled

      if (any(views(scene, field%share) < 1.0_wp)) then
         call evaluate(scene, field, residual, judged=.true.)
         found = strictest(scene%measure, residual, paper=scene%method == method_transfer)
         verdict%converged = found%ratio <= tolerance
         if (.not. verdict%converged) then
            call evaluate(scene, field, residual)
            return
         end if
         verdict%residual = found
      end if
      call find_mechanism(scene, field, .false., verdict%mechanism)
      verdict%converged = .not. verdict%mechanism%loaded
      if (.not. verdict%converged .or. size(verdict%mechanism%idle, 2) == 0) return
      allocate (settled, source=field)
      call settle(scene, verdict%mechanism, settled)
      call evaluate(scene, settled, residual, judged=.true.)
      found = strictest(scene%measure, residual, paper=scene%method == method_transfer)
      if (found%ratio <= tolerance) field = settled
      call evaluate(scene, field, residual, judged=.true.)
   end subroutine conclude

   !> One step of the method
   subroutine take_step(scene, tolerance, ratio, field, residual, newton, watch)
      !> What does not change
      type(scene_type), intent(in) :: scene
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
      real(wp) :: accuracy, largest
      logical :: made, moved

      watch%n_steps = watch%n_steps + 1
      if (scene%method == method_newton) then
         accuracy = merge(closer, loose, scene%proportion > very_stiff)
         ! near to equilibrium, so exactly that one step can reach the tolerance
         if (ratio < near) accuracy = min(accuracy, max(strict, part*tolerance/max(tiny(ratio), ratio)))
         if (.not. field%leak > 0.0_wp) then
            call approach(scene, .true., watch%begun, field, residual, moved)
            if (moved) newton = new_newton(scene, field, ratio)
         end if
         if (field%leak > 0.0_wp) accuracy = max(strict, min(accuracy, 0.1_wp*field%leak))
         largest = watch%largest
         if (field%leak > 0.0_wp) largest = largest/field%leak
         if (watch%far) watch%radius = largest
         call newton_step(scene, ratio, accuracy, largest, newton, field, residual, made, &
                          more=merge(bold, careful, watch%falls .or. watch%far), radius=watch%radius)
         if (.not. made .and. .not. field%leak > 0.0_wp) then  ! what slips may stop farther on
            call approach(scene, .false., watch%begun, field, residual, made)
            if (made) newton = new_newton(scene, field, ratio)
         end if
         watch%ran = .not. made
         return
      end if
      field%carried = field%stress
      if (scene%method == method_anderson) then
         x = reshape(field%excess, [size(field%excess)])
         call anderson_step(watch%memory, x, reshape(residual, [size(x)]))
         field%excess = reshape(x, shape(field%excess))
      else
         field%excess = field%excess + residual
         if (scene%method == method_total) then
            call evaluate(scene, field, residual)
            call approach(scene, .true., watch%begun, field, residual, moved)
            ! motions and excess stress may go on against each other without end: then the loop goes on alone
            if (watch%moves) call balance_motions(scene, field)
         end if
      end if
      call look_again(scene, ratio, field, residual, newton)
   end subroutine take_step

   !> What an iterate leaves without equilibrium, and the laws about it for Newton's
   !> method
   subroutine look_again(scene, ratio, field, residual, newton)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Residual ratio of the iterate before
      real(wp), intent(in) :: ratio
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress not transferred
      real(wp), intent(out) :: residual(:, :, :)
      !> Laws about the state
      type(newton_type), intent(inout) :: newton

      call evaluate(scene, field, residual)
      if (scene%method == method_newton) newton = new_newton(scene, field, ratio)
   end subroutine look_again

end module axijoint_joints_balance
