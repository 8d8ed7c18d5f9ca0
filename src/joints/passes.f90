!> What follows a state that is balanced: bonds that break and points that soften, in passes, then
!> the end
module axijoint_joints_passes
   use axijoint_base_kinds, only : wp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, break_bonds, soften
   use axijoint_joints_mechanism, only : mechanism_type, find_mechanism, stand_still
   use axijoint_joints_method, only : method_type, verdict_type
   use axijoint_joints_residual, only : strictest_type, strictest
   use axijoint_joints_scene, only : scene_type, evaluate, views
   implicit none
   private
   public :: pass_on, keep_standing

   !> Bonds are broken and points softened, one pass after the other, in states at
   !> least this well balanced. The last pass reaches the tolerance asked for
   real(wp), parameter :: pass_tolerance = 1.0e-4_wp

contains

   !> In a state that is balanced well enough, see what is next: bonds to break and points to
   !> soften, or the end
   subroutine pass_on(method, condensed, scene, tolerance, field, residual, verdict, again)
      !> The method
      class(method_type), intent(in) :: method
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Tolerance on the residual ratio
      real(wp), intent(in) :: tolerance
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress that is not transferred
      real(wp), intent(inout) :: residual(:, :, :)
      !> Takes `converged`, the passes, and a mechanism
      type(verdict_type), intent(inout) :: verdict
      !> Whether laws changed, so that the iterations begin again
      logical, intent(out) :: again

      integer :: n_broken, n_softened

      again = .false.
      if (verdict%residual%ratio > max(tolerance, pass_tolerance)) return
      call break_bonds(scene%laws, field, n_broken)
      call soften(scene%laws, field, n_softened)
      again = n_broken + n_softened > 0
      if (again) then
         verdict%n_passes = verdict%n_passes + 1
      else if (verdict%residual%ratio <= tolerance) then
         call conclude(method, condensed, scene, tolerance, field, residual, verdict)
      end if
   end subroutine pass_on

   !> See whether a state within the tolerance is one: by what the laws say if they see the jumps,
   !> not parts of them, and if no load acts on a motion that nothing resists
   subroutine conclude(method, condensed, scene, tolerance, field, residual, verdict)
      !> The method
      class(method_type), intent(in) :: method
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
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
      type(scene_type) :: seen

      if (any(views(condensed, scene, field) < 1.0_wp)) then
         call method%evaluate(condensed, scene, field, residual, judged=.true.)
         found = strictest(condensed%measure, scene%loads%reference, residual, &
            paper=method%accumulates)
         verdict%converged = found%ratio <= tolerance
         if (.not. verdict%converged) then
            call method%evaluate(condensed, scene, field, residual)
            return
         end if
         verdict%residual = found
      end if
      seen = scene
      if (method%accumulates) seen%laws%gap = 0.0_wp  ! this loop knows none
      call find_mechanism(condensed, seen, field, .false., verdict%mechanism)
      verdict%converged = .not. verdict%mechanism%loaded
   end subroutine conclude

   !> Where a step in equilibrium leaves motions that it does not push, no load acts on and nothing resists is of no
   !> meaning: the parts stand as when it began, if that is equilibrium, too
   subroutine keep_standing(method, condensed, scene, tolerance, begun, change, mechanism, field)
      !> The method
      class(method_type), intent(in) :: method
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Tolerance on the residual ratio
      real(wp), intent(in) :: tolerance
      !> Jumps when the step began, shape (3, points, planes)
      real(wp), intent(in) :: begun(:, :, :)
      !> What its loads would add to the stress of joints that hold, amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: change(:, :, :)
      !> Motions that no load acts on and nothing resists; takes along which of them the parts stand there
      type(mechanism_type), intent(inout) :: mechanism
      !> State of the joints in equilibrium
      type(joint_field_type), intent(inout) :: field

      type(strictest_type) :: found
      type(joint_field_type), allocatable :: standing
      real(wp), allocatable :: residual(:, :, :)
      logical, allocatable :: stands(:)

      if (.not. allocated(mechanism%idle)) return
      if (size(mechanism%idle, 2) == 0) return
      allocate (standing, source=field)
      allocate (residual, mold=field%excess)
      allocate (stands, mold=mechanism%stands)
      call stand_still(condensed, scene, mechanism, begun, change, standing, stands)
      call method%evaluate(condensed, scene, standing, residual, judged=.true.)
      found = strictest(condensed%measure, scene%loads%reference, residual, paper=method%accumulates)
      if (.not. found%ratio <= tolerance) return
      field = standing
      mechanism%stands = stands
   end subroutine keep_standing

end module axijoint_joints_passes
