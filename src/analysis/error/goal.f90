!> Refinement of a job until its error budget is below a target
module axijoint_analysis_error_goal
   use axijoint_analysis_core_results, only : error_share_type, results_type, &
      source_discretization, source_harmonics, &
      source_planes, source_iteration, source_solver
   use axijoint_analysis_error_finer_mesh, only : refine_mesh, size_mesh, least
   use axijoint_base_kinds, only : wp
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, method_newton
   use axijoint_model_modes, only : used_modes, greatest_divisor
   use axijoint_model_request, only : error_goal_type, refinement_type, goal_joints, &
      goal_displacement, goal_energy, goal_points, goal_cuts, goal_sections
   implicit none
   private
   public :: goal_error, unknown_source, refine_further, room_for, mesh_misses

   !> How one source of error is brought down
   type :: rule_type
      !> Its estimates are multiplied by this before they count: about the most that true errors
      !> were, of nine in ten scenes
      real(wp) :: safety = 1.0_wp
      !> Part of the target that is left to it
      real(wp) :: part = 0.0_wp
      !> The error falls at least with this power of the number of elements along a side, of
      !> harmonics, of intervals between planes, of the inverse of the tolerance
      real(wp) :: order = 1.0_wp
   end type rule_type

   !> A round that cannot have so many times the unknowns is not begun
   real(wp), parameter :: least_growth = 1.2_wp
   !> Most that harmonics or planes are multiplied by in a round
   real(wp), parameter :: most_numbers = 5.0_wp
   !> M is multiplied by this where it tells nothing of the harmonics above it: M = 4 has two octaves
   real(wp), parameter :: telling = 4.0_wp
   !> A source that is brought down is to fall to this part of what is left to it: a round more
   !> costs more
   real(wp), parameter :: aim = 0.8_wp

contains

   !> The error that a target is compared with, on the safe side: the sum of the shares of the
   !> quantity that the goal is about, each times its factor; negative if a share that there must be
   !> is not known
   pure real(wp) function goal_error(model, results) result(error)
      !> The job, and its goal
      type(model_type), intent(in) :: model
      !> Its results
      type(results_type), intent(in) :: results

      integer :: i

      error = -1.0_wp
      associate (budget => results%budget, goal => model%error_goal)
         do i = 1, size(budget)
            if (budget(i)%source == source_discretization &
               .and. share_of(budget(i), goal) < 0.0_wp) return
            if (budget(i)%load >= 1.0_wp) return  ! what a concentrated load does has no limit
         end do
         error = sum([(safety_of(budget(i), goal)*max(0.0_wp, share_of(budget(i), goal)), i=1, &
            size(budget))])
      end associate
   end function goal_error

   !> A source whose share of the quantity that the goal is about is not known; 0 if all are. The solver has none of
   !> joint stress
   pure integer function unknown_source(model, results) result(source)
      !> The job, and its goal
      type(model_type), intent(in) :: model
      !> Its results
      type(results_type), intent(in) :: results

      integer :: i

      source = 0
      if (.not. allocated(results%budget)) return
      do i = 1, size(results%budget)
         associate (share => results%budget(i))
            if (share%source == source_solver) cycle
            if (share_of(share, model%error_goal) >= 0.0_wp .and. .not. sees_part(share, model%error_goal, results)) cycle
            source = share%source
            return
         end associate
      end do
   end function unknown_source

   !> Whether errors of the mesh are known in part: what joints slipped before, the way of their slip, the order in which bonds
   !> break and points soften is as wrong as it was, elements lock, or joints had no answer to them, and what that would move is
   !> lacking in those of displacements
   pure logical function sees_part(share, goal, results)
      !> The share
      type(error_share_type), intent(in) :: share
      !> The goal
      type(error_goal_type), intent(in) :: goal
      !> Results with a budget
      type(results_type), intent(in) :: results

      sees_part = .false.
      if (share%source /= source_discretization) return
      sees_part = results%hides_errors() .or. (results%torn .and. goal%quantity == goal_joints) .or. &
         (results%stress_in_part .and. goal%quantity == goal_sections) .or. &
         (share%joint_stress < 0.0_wp .and. any(results%budget%joint_stress >= 0.0_wp))
   end function sees_part

   !> Factor on a share
   pure real(wp) function safety_of(share, goal)
      !> The share
      type(error_share_type), intent(in) :: share
      !> The goal
      type(error_goal_type), intent(in) :: goal

      type(rule_type) :: rule

      rule = rule_of(share%source, goal%quantity)
      safety_of = rule%safety
   end function safety_of

   !> A share of the quantity that the goal is about; negative if not known
   pure real(wp) function share_of(share, goal)
      !> The share
      type(error_share_type), intent(in) :: share
      !> The goal
      type(error_goal_type), intent(in) :: goal

      select case (goal%quantity)
      case (goal_joints)
         share_of = share%joint_stress
      case (goal_energy)
         share_of = merge(share%energy, share%displacement, share%energy >= 0.0_wp)
      case (goal_points)
         share_of = share%points
      case (goal_cuts)
         share_of = share%cuts
      case (goal_sections)
         share_of = share%sections
      case default
         share_of = share%displacement
      end select
   end function share_of

   !> How a source is brought down
   pure type(rule_type) function rule_of(source, quantity) result(rule)
      !> One of the `source_` parameters
      integer, intent(in) :: source
      !> What is asked for, one of the `goal_` parameters
      integer, intent(in) :: quantity

      ! orders of meshes at corners that make stresses infinite
      real(wp), parameter :: order(6) = [1.0_wp, 1.5_wp, 0.75_wp, 1.5_wp, 1.0_wp, 1.5_wp]  ! as `goal_names`

      select case (source)
      case (source_discretization)
         rule = rule_type(safety=1.4_wp, part=0.5_wp, order=order(quantity))
      case (source_harmonics)
         rule = rule_type(safety=1.3_wp, part=0.25_wp, order=1.5_wp)
      case (source_planes)
         rule = rule_type(safety=1.2_wp, part=0.2_wp, order=1.25_wp)
      case (source_iteration)
         rule = rule_type(safety=1.1_wp, part=0.05_wp, order=1.0_wp)
      case default
         rule = rule_type()
      end select
   end function rule_of

   !> Raise what leaves more than its part of the target
   subroutine refine_further(model, budget, element_error, room_for_all, refinement, changed)
      !> The job as it was solved, and its goal
      type(model_type), intent(in) :: model
      !> What its approximations leave
      type(error_share_type), intent(in) :: budget(:)
      !> Energy of the error of each element; empty if not known
      real(wp), intent(in) :: element_error(:)
      !> The unknowns may become so many times as many
      real(wp), intent(in) :: room_for_all
      !> How it was refined; further on return, with sizes of elements where the mesh is to be made
      !> anew
      type(refinement_type), intent(inout) :: refinement
      !> Whether anything else could be raised
      logical, intent(out) :: changed

      type(rule_type) :: rule
      real(wp) :: excess, room, need, mesh_order, factor
      integer :: i

      changed = .false.
      if (room_for_all < least_growth) return
      if (.not. (model%error_goal%mesh_too .or. model%error_goal%remesh) .and. mesh_misses(model, budget)) return
      room = room_for_all
      need = 0.0_wp
      mesh_order = 1.0_wp
      do i = 1, size(budget)
         if (budget(i)%source == source_iteration .and. share_of(budget(i), model%error_goal) < 0.0_wp .and. &
             model%method /= method_newton) then
            refinement%newton = .true.  ! which leaves what can be told
            changed = .true.
            cycle
         end if
         if (budget(i)%source == source_harmonics .and. budget(i)%load > 0.0_wp .and. &
             share_of(budget(i), model%error_goal) < 0.0_wp) then
            call raise_harmonics(model, min(telling, room), refinement, changed)
            cycle
         end if
         rule = rule_of(budget(i)%source, model%error_goal%quantity)
         if (.not. rule%part > 0.0_wp) cycle  ! nothing can be done about it
         excess = rule%safety*share_of(budget(i), model%error_goal)/(rule%part*model%error_goal%target)
         if (.not. excess > aim) cycle
         excess = excess/aim
         select case (budget(i)%source)
         case (source_discretization)
            need = excess
            mesh_order = rule%order
         case (source_harmonics)
            factor = excess**(1.0_wp/rule%order)
            ! where there is no room for both, harmonics leave half of it to the mesh, and at least
            ! what it can use
            if (need > 0.0_wp .and. (model%error_goal%mesh_too .or. model%error_goal%remesh) &
                .and. factor*least**2 > room .and. room > least**2 .and. model%max_harmonic > 0) then
               factor = aint(model%max_harmonic*min(factor, sqrt(room), room/least**2))/model%max_harmonic
               if (.not. factor > 1.0_wp) cycle
            end if
            factor = min(factor, room)
            call raise_harmonics(model, factor, refinement, changed)
         case (source_planes)
            refinement%planes = 1 + ceiling((model%n_planes - 1)*min(most_numbers, &
               excess**(1.0_wp/rule%order)))
            changed = .true.
         case (source_iteration)
            refinement%newton = .true.
            refinement%tolerance = refinement%tolerance/excess
            changed = .true.
         end select
      end do
      if (refinement%harmonic > 0) &
         refinement%planes = max(refinement%planes, model%n_planes, 2*refinement%harmonic + 1)
      if (refinement%harmonic > 0) room = room*(model%max_harmonic + 1)/(refinement%harmonic + 1)
      if (need > 0.0_wp .and. model%error_goal%mesh_too) &
         call refine_mesh(model, element_error, need, mesh_order, room, refinement, changed)
      if (need > 0.0_wp .and. model%error_goal%remesh) &
         call size_mesh(model, element_error, need, mesh_order, room, refinement)
      changed = changed .and. room >= 1.0_wp
   end subroutine refine_further

   !> Whether the mesh alone leaves more than the target: where it stays as it is, nothing else is worth raising
   pure logical function mesh_misses(model, budget)
      !> The job as it was solved, and its goal
      type(model_type), intent(in) :: model
      !> What its approximations leave
      type(error_share_type), intent(in) :: budget(:)

      integer :: i

      mesh_misses = .false.
      do i = 1, size(budget)
         if (budget(i)%source == source_discretization) mesh_misses = &
            safety_of(budget(i), model%error_goal)*share_of(budget(i), model%error_goal) > model%error_goal%target
      end do
   end function mesh_misses

   !> How many times the unknowns that a job has, or may have, its goal allows
   pure real(wp) function room_for(model)
      !> The job
      type(model_type), intent(in) :: model

      room_for = model%error_goal%most_unknowns &
         /(3.0_wp*n_nodes(model%mesh)*size(used_modes(model)))
   end function room_for

   !> Raise M, by waves that the loads let through
   pure subroutine raise_harmonics(model, factor, refinement, changed)
      !> The job as it was solved
      type(model_type), intent(in) :: model
      !> M is to be multiplied by this
      real(wp), intent(in) :: factor
      !> How it was refined
      type(refinement_type), intent(inout) :: refinement
      !> Becomes true if M was raised
      logical, intent(inout) :: changed

      integer :: step, k

      if (size(model%harmonics) <= model%max_harmonic) return  ! HARMONICS lists them
      step = 0
      associate (modes => used_modes(model))
         do k = 1, size(modes)
            step = greatest_divisor(step, modes(k)%harmonic)
         end do
      end associate
      step = max(1, step)
      refinement%harmonic = step*max(model%max_harmonic/step + 1, &
                                     ceiling(real(model%max_harmonic, wp)/step*min(most_numbers, &
                                     factor)))
      changed = .true.
   end subroutine raise_harmonics

end module axijoint_analysis_error_goal
