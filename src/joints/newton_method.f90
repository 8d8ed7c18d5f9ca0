!> Newton's method for the joints of a load step, and what it tries where a plain iteration does not
!> get there: stages of stiffness, cohesion that fades, damped steps
module axijoint_joints_newton_method
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_base_stop, only : stop_wished
   use axijoint_element_joint_law, only : loses_at_opening
   use axijoint_joints_approach, only : approach
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, break_bonds, n_fading
   use axijoint_joints_mechanism, only : find_mechanism, drives_on
   use axijoint_joints_method, only : method_type, control_type, verdict_type
   use axijoint_joints_newton, only : newton_type, see, linearize, newton_step, step_bounds_type, &
      newton_view, bold, most_damping
   use axijoint_joints_passes, only : pass_on
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_residual, only : strictest_type, strictest, residual_norm
   use axijoint_joints_scene, only : scene_type, evaluate, find_jumps
   use axijoint_joints_watch, only : watch_type, new_watch, note, end_watch, runaway
   implicit none
   private
   public :: newton_method_type, stiff

   !> Joints much stiffer than the bodies tear like a zip, in many passes: their bonds are broken in
   !> looser states, which comes closer to the order in which a growing load breaks them. k h/E of
   !> stiff and of very stiff joints, and how loose the states are
   real(wp), parameter :: stiff = 5.0_wp, loose_pass = 0.3_wp, very_stiff = 100.0_wp, &
      loosest_pass = 1.0_wp
   !> Joints much stiffer than the bodies: the laws see a share of their stiffness
   !> first, this many times more whenever the residual ratio has fallen so far
   real(wp), parameter :: stage_factor = 10.0_wp, stage_tolerance = 0.1_wp
   !> Tolerance of the linear solution far from equilibrium, and with joints that are as good as rigid: between, it falls like the
   !> root of their flexibility, for then much of what a solution leaves is soft motions that a state hangs on. The ratio from which
   !> on equilibrium is near, the least tolerance there, and the part of the step's tolerance that is left to it
   real(wp), parameter :: loose = 1.0e-2_wp, closest = 1.0e-4_wp, near = 1.0e-2_wp, strict = 1.0e-9_wp, part = 0.1_wp
   !> Part of the ratio that a step leaves at most if states hardly change any more; while they do, a closer solution than this times
   !> the square of what the last step left is of no use to the next iterate (the second choice of Eisenstat and Walker, SIAM J.
   !> Sci. Comput. 17, 1996)
   real(wp), parameter :: settled = 0.1_wp, forcing = 0.1_wp
   !> Where a law that jumps has no state, cohesion fades with opening: first over tensions as large
   !> as it, then over a part of that whenever there is equilibrium, in small steps where these get no
   !> farther, and last. It may be wider where iterations do not get there, but not more
   real(wp), parameter :: first_fading = 1.0_wp, fading_factor = 0.1_wp, &
      small_fading_factor = 0.5_wp, last_fading = 1.0e-4_wp, &
      widest_fading = 1.01e-2_wp  ! 1 * 0.1 * 0.1 is above 0.01
   !> Rounding of the forces of the excess stress
   real(wp), parameter :: rounding = 1.0e2_wp*epsilon(1.0_wp)
   !> A step without a better residual for so many iterations has stalled
   integer, parameter :: patience = 25
   !> How many times as much may be missing after a step where the residual no longer falls: more
   !> would go round in circles
   real(wp), parameter :: careful = 1.0_wp
   !> Change of the jumps by the first steps, in displacements with elastic joints: of several
   !> states the near one is found. It grows as steps want more
   real(wp), parameter :: first_radius = 3.0_wp
   !> Steps along a motion that nothing resists until steps are damped
   integer, parameter :: enough_astray = 2

   !> What to try where the iterations ran away or stalled: nothing more, the whole stiffness at once,
   !> cohesion that fades, smaller steps of that, as much of it as there was equilibrium for, damped
   !> steps, and these in stages of stiffness
   enum, bind(c)
      enumerator :: give_up, whole_stiffness, fading_cohesion, slower_fading, wider_fading, damped_steps, damped_stages
   end enum

   !> The method
   type, extends(method_type) :: newton_method_type
   contains
      procedure :: balance
   end type newton_method_type

   !> An iteration on its way
   type :: course_type
      !> What any iteration remembers
      type(watch_type) :: watch
      !> Laws about the iterate
      type(newton_type) :: newton
      !> Excess stress that is not transferred
      real(wp), allocatable :: residual(:, :, :)
      !> Jumps of the state that the load step begins with, shape (3, points, planes)
      real(wp), allocatable :: begun(:, :, :)
      !> The state at the start, the last without equilibrium that a load drives on, or else that ran away, and the last in
      !> equilibrium in which cohesion fades
      type(joint_field_type), allocatable :: start, astray, fading
      !> Whether a load drives it on
      logical :: driven = .false.
      !> What bounds the steps
      type(step_bounds_type) :: bounds
      !> Whether the laws see a part of the stiffness first, whether damped steps were tried, whether they
      !> may be in stages, too, and whether the last step was not made
      logical :: in_stages = .false., damped = .false., may_damp_stages = .false., ran = .false.
      !> Share of the stiffness that the law of each point sees first in stages
      real(wp), allocatable :: share(:)
      !> Whether cohesion that fades was tried, and whether it is not to fade faster
      logical :: faded = .false., wide = .false.
      !> What the fading is multiplied by whenever there is equilibrium, and how far down
      real(wp) :: faster = fading_factor, least_fading = last_fading
   end type course_type

contains

   !> Iterate a load step to equilibrium
   subroutine balance(self, condensed, scene, control, field, path, verdict)
      !> The method
      class(newton_method_type), intent(in) :: self
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> When to end
      type(control_type), intent(in) :: control
      !> State of the joints: of the last step, then of this one
      type(joint_field_type), intent(inout) :: field
      !> Convergence path, to be continued
      type(iteration_type), allocatable, intent(inout) :: path(:)
      !> How it ended
      type(verdict_type), intent(out) :: verdict

      type(course_type) :: course
      logical :: again
      integer :: next

      call begin(condensed, scene, control, field, course, verdict)
      do while (course%watch%k < control%most)
         call note(course%watch, condensed, scene, control%now, self%accumulates, course%residual, &
            field, verdict)
         call condensed%team%share_wish()
         if (stop_wished()) exit  ! nobody uses what was reached
         if (course%watch%k == control%trial .and. verdict%residual%whole > control%hope) exit
         verdict%ran_away = verdict%ran_away .or. course%ran
         verdict%stalled = ieee_is_finite(verdict%residual%ratio) .and. .not. course%ran &
            .and. course%watch%k > course%watch%best_at + patience
         course%ran = .false.
         associate (may_go_on => course%watch%k < control%most)
            if (verdict%ran_away .or. verdict%stalled) then
               call note_astray(condensed, scene, verdict%ran_away, field, course)
               next = next_attempt(control%damps, course, verdict%stalled, any(loses_at_opening(scene%laws)), &
                  may_go_on)
               if (next == give_up) exit
               call try(next, condensed, scene, field, course, verdict)
               cycle
            end if
            call go_on(self, condensed, scene, control%tolerance, field, course, verdict, again)
            if (verdict%converged) exit
            if (verdict%mechanism%loaded) then
               if (course%damped .or. .not. may_go_on) exit
               call try(damped_steps, condensed, scene, field, course, verdict)
               cycle
            end if
            if (.not. may_go_on) exit
         end associate
         if (again) call look_again(condensed, scene, verdict%residual%ratio, field, course)
         call take_step(condensed, scene, control%tolerance, verdict%residual%ratio, field, course)
      end do
      if (.not. verdict%converged) call end_astray(condensed, scene, field, course, verdict)
      if (verdict%converged .and. n_fading(scene%laws, field) == 0) field%fading = 0.0_wp
      call end_watch(course%watch, course%residual, field, path, verdict)
      if (verdict%converged .or. verdict%ran_away .or. .not. verdict%stalled) return
      if (course%watch%best <= control%tolerance) return  ! it was not rounding that it failed for
      verdict%at_rounding = course%watch%best*residual_norm(condensed%measure, course%residual) &
         <= rounding*residual_norm(condensed%measure, field%excess)*course%watch%steps(course%watch%k)%ratio
   end subroutine balance

   !> From the state of the last step to the first iterate
   subroutine begin(condensed, scene, control, field, course, verdict)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The tolerance, and whether the state is about in equilibrium already
      type(control_type), intent(in) :: control
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> The iteration
      type(course_type), intent(out) :: course
      !> Takes a mechanism
      type(verdict_type), intent(inout) :: verdict

      logical :: moved

      allocate (course%residual, mold=field%excess)
      course%begun = field%jump
      course%share = share_seen_first(condensed, scene)
      course%in_stages = .not. control%warm .and. any(course%share < 1.0_wp)
      if (course%in_stages) course%in_stages = .not. is_admitted(condensed, scene, control%tolerance, field, course%residual)
      course%may_damp_stages = course%in_stages
      if (course%in_stages) field%share = course%share
      if (.not. control%warm) field%fading = 0.0_wp
      ! states that go on from each other fade alike
      if (field%fading > 0.0_wp) course%least_fading = max(last_fading, field%fading)
      field%view_limit = newton_view
      call look_again(condensed, scene, 1.0_wp, field, course)
      call approach(condensed, scene, .true., course%begun, field, course%residual, moved)
      course%start = field
      course%watch = new_watch(condensed, scene, field, course%residual)
      course%bounds%radius = first_radius*course%watch%largest/runaway
      if (moved) call linearize(condensed, scene, 1.0_wp, field, course%newton)
      call find_mechanism(condensed, scene, field, .false., verdict%mechanism)
      if (verdict%mechanism%loaded) call try(damped_steps, condensed, scene, field, course, verdict)
   end subroutine begin

   !> Whether the laws admit the stress of all points as it is, so that there is nothing to find
   logical function is_admitted(condensed, scene, tolerance, field, residual) result(admitted)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Tolerance on the residual ratio
      real(wp), intent(in) :: tolerance
      !> State of the joints; jumps and stresses follow its excess stress
      type(joint_field_type), intent(inout) :: field
      !> Takes the excess stress that is not transferred
      real(wp), intent(inout) :: residual(:, :, :)

      type(strictest_type) :: found

      call evaluate(condensed, scene, field, residual, judged=.true.)
      found = strictest(condensed%measure, scene%loads%reference, residual, paper=.false.)
      admitted = found%ratio <= tolerance
   end function is_admitted

   !> Share of the joint stiffness to begin with: what is about the stiffness of the bodies, no less of
   !> joints that are no stiffer. Cohesion, or a stress before loading, makes yield depend on the size
   !> of the stress, not on its direction alone; then the share would mislead.
   pure function share_seen_first(condensed, scene) result(share)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws
      type(scene_type), intent(in) :: scene
      !> Shape (points)
      real(wp) :: share(size(scene%laws))

      !> Power of ten of k h/E that needs no help
      integer, parameter :: easy = 0
      real(wp) :: of_stiffest

      share = 1.0_wp
      if (any(scene%laws%cohesion > 0.0_wp) .or. any(abs(scene%laws%initial_stress) > 0.0_wp)) return
      of_stiffest = 10.0_wp**min(0, easy - floor(log10(max(tiny(1.0_wp), condensed%proportion))))
      if (of_stiffest < 1.0_wp) share = min(1.0_wp, of_stiffest*condensed%proportion &
         /max(tiny(1.0_wp), condensed%points%proportion))
   end function share_seen_first

   !> Whether laws see a part of their stiffness
   pure logical function sees_part(field)
      !> State of the joints
      type(joint_field_type), intent(in) :: field

      sees_part = any(field%share < 1.0_wp)
   end function sees_part

   !> Note where an attempt ended without equilibrium. What laws do that see a part of their stiffness is no sign of what
   !> they do in the end; and where some steps go far astray, others may show what the load does
   subroutine note_astray(condensed, scene, ran_away, field, course)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Whether it ran away
      logical, intent(in) :: ran_away
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The iteration
      type(course_type), intent(inout) :: course

      real(wp), allocatable :: motion(:)
      logical :: driven

      if (sees_part(field)) return
      call drives_on(condensed, scene, field, driven, motion)
      if (.not. (driven .or. ran_away .and. .not. course%driven)) return
      course%astray = field
      course%driven = driven
   end subroutine note_astray

   !> End without equilibrium: in the state that went astray, if there is one, and with the whole stiffness
   subroutine end_astray(condensed, scene, field, course, verdict)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> The iteration
      type(course_type), intent(inout) :: course
      !> How it ended
      type(verdict_type), intent(inout) :: verdict

      if ((verdict%stalled .or. verdict%ran_away) .and. allocated(course%astray)) then
         verdict%ran_away = .true.
         field = course%astray
      else if (sees_part(field)) then
         field%share = 1.0_wp
      else
         return
      end if
      call evaluate(condensed, scene, field, course%residual)
   end subroutine end_astray

   !> What to try next
   pure integer function next_attempt(damps, course, stalled, may_fade, may_go_on) result(next)
      !> Whether steps may be damped
      logical, intent(in) :: damps
      !> The iteration
      type(course_type), intent(in) :: course
      !> Whether the iterations stalled, whether there is cohesion to fade, and whether iterations are
      !> left
      logical, intent(in) :: stalled, may_fade, may_go_on

      next = give_up
      if (course%in_stages) then
         next = whole_stiffness
      else if (.not. may_go_on) then
         return
      else if (stalled .and. may_fade .and. .not. course%faded) then
         next = fading_cohesion
      else if (fades_too_widely(course)) then
         next = slower_fading
      else if (holds_faded(course)) then
         next = wider_fading
      else if (damps .and. .not. course%damped) then
         next = damped_steps
      else if (damps .and. course%may_damp_stages) then
         next = damped_stages
      end if
   end function next_attempt

   !> Whether there is a state in which cohesion fades over little enough
   pure logical function holds_faded(course) result(holds)
      !> The iteration
      type(course_type), intent(in) :: course

      holds = .false.
      if (allocated(course%fading)) &
         holds = course%fading%fading <= widest_fading .and. .not. course%wide
   end function holds_faded

   !> Whether there is a state in which cohesion fades, but over too much, and smaller steps were not
   !> tried
   pure logical function fades_too_widely(course) result(widely)
      !> The iteration
      type(course_type), intent(in) :: course

      widely = .false.
      if (allocated(course%fading)) widely = course%fading%fading > widest_fading &
         .and. course%faster < small_fading_factor
   end function fades_too_widely

   !> Begin again otherwise
   subroutine try(attempt, condensed, scene, field, course, verdict)
      !> What to try
      integer, intent(in) :: attempt
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> The iteration
      type(course_type), intent(inout) :: course
      !> Forgets how the last attempt ended
      type(verdict_type), intent(inout) :: verdict

      select case (attempt)
      case (whole_stiffness)
         course%in_stages = .false.
         course%damped = .false.
         course%start%share = 1.0_wp
         field = course%start
         call begin_again(condensed, scene, field, course, verdict)
      case (damped_steps, damped_stages)
         course%damped = .true.
         field = course%start
         if (attempt == damped_stages) field%share = course%share
         if (sees_part(field)) course%may_damp_stages = .false.
         call begin_again(condensed, scene, field, course, verdict)
         course%bounds%damps_all = .true.
         course%bounds%damping = most_damping(condensed)
      case (fading_cohesion)
         course%faded = .true.
         field = course%start
         field%fading = first_fading
         call begin_again(condensed, scene, field, course, verdict)
      case (slower_fading)
         course%faster = small_fading_factor
         field = course%fading
         field%fading = course%faster*field%fading
         call begin_again(condensed, scene, field, course, verdict)
      case (wider_fading)
         course%wide = .true.
         field = course%fading
         call begin_again(condensed, scene, field, course, verdict)
      end select
   end subroutine try

   !> Go on from the field as if the iterations began
   subroutine begin_again(condensed, scene, field, course, verdict)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> The iteration
      type(course_type), intent(inout) :: course
      !> Forgets how the last attempt ended
      type(verdict_type), intent(inout) :: verdict

      verdict%ran_away = .false.
      verdict%stalled = .false.
      verdict%mechanism%loaded = .false.
      course%watch%best = huge(1.0_wp)
      course%bounds%damping = 0.0_wp
      course%bounds%damps_all = .false.
      course%bounds%n_astray = 0
      call look_again(condensed, scene, 1.0_wp, field, course)
   end subroutine begin_again

   !> In a state that is balanced well enough, see what is next: more of the joints' stiffness, the
   !> next bonds to break, or the end
   subroutine go_on(self, condensed, scene, tolerance, field, course, verdict, again)
      !> The method
      class(newton_method_type), intent(in) :: self
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Tolerance on the residual ratio
      real(wp), intent(in) :: tolerance
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> The iteration
      type(course_type), intent(inout) :: course
      !> Takes `converged`, the passes, and a mechanism
      type(verdict_type), intent(inout) :: verdict
      !> Whether the task changed
      logical, intent(out) :: again

      integer :: n_broken

      again = .false.
      associate (found => verdict%residual)
         if (sees_part(field)) then
            again = found%whole <= stage_tolerance
            if (again) call stiffen(condensed, scene, field, course%residual)
         else if (field%fading > course%least_fading .and. .not. course%wide) then
            again = found%ratio <= tolerance
            if (again) course%fading = field
            if (again) field%fading = max(course%least_fading, course%faster*field%fading)
         else
            if (condensed%proportion > stiff &
                .and. found%ratio <= merge(loosest_pass, loose_pass, &
                condensed%proportion > very_stiff)) then
               call break_bonds(scene%laws, field, n_broken)
               again = n_broken > 0
               if (again) verdict%n_passes = verdict%n_passes + 1
            end if
            if (.not. again) &
               call pass_on(self, condensed, scene, tolerance, field, course%residual, verdict, &
               again)
         end if
      end associate
      if (.not. again) return
      course%watch%best = huge(1.0_wp)
   end subroutine go_on

   !> Let the laws see more of the joints' stiffness, as much as leaves the state about in balance
   subroutine stiffen(condensed, scene, field, residual)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress that is not transferred
      real(wp), intent(inout) :: residual(:, :, :)

      type(strictest_type) :: found

      do while (sees_part(field))
         field%share = min(1.0_wp, stage_factor*field%share)
         call evaluate(condensed, scene, field, residual)
         found = strictest(condensed%measure, scene%loads%reference, residual, paper=.false.)
         if (found%whole > stage_tolerance) exit
      end do
   end subroutine stiffen

   !> One step
   subroutine take_step(condensed, scene, tolerance, ratio, field, course)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Tolerance on the residual ratio, and the ratio
      real(wp), intent(in) :: tolerance, ratio
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> The iteration
      type(course_type), intent(inout) :: course

      real(wp) :: exact, left
      logical :: made, moved, falls, changes

      falls = course%watch%best_at == course%watch%k
      associate (bounds => course%bounds)
         changes = ratio > settled*bounds%far .and. bounds%far > 0.0_wp
         left = 0.0_wp
         if (changes) left = ratio/bounds%far
         bounds%far = ratio
         bounds%tolerance = max(closest, loose*sqrt(very_stiff/max(very_stiff, condensed%proportion)))
         if (ratio < near) then  ! so exactly that one step can reach the tolerance, unless states still change
            exact = max(strict, part*tolerance/max(tiny(ratio), ratio))
            bounds%tolerance = min(bounds%tolerance, max(exact, forcing*left**2))
         end if
         bounds%largest = course%watch%largest
         call approach(condensed, scene, .true., course%begun, field, course%residual, moved)
         if (moved) call linearize(condensed, scene, ratio, field, course%newton)
         bounds%more = merge(bold, careful, falls)
         call newton_step(condensed, scene, bounds, course%newton, field, course%residual, made)
      end associate
      if (.not. made) then  ! what slips may stop farther on
         call approach(condensed, scene, .false., course%begun, field, course%residual, made)
         if (made) call linearize(condensed, scene, ratio, field, course%newton)
      end if
      course%ran = .not. made .or. course%bounds%n_astray >= enough_astray .and. .not. course%damped
   end subroutine take_step

   !> What an iterate leaves without equilibrium, and the laws about it
   subroutine look_again(condensed, scene, ratio, field, course)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Residual ratio of the iterate before
      real(wp), intent(in) :: ratio
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> The iteration
      type(course_type), intent(inout) :: course

      call find_jumps(condensed, scene, field)
      call see(condensed, scene, ratio, field, course%residual, course%newton)
   end subroutine look_again

end module axijoint_joints_newton_method
