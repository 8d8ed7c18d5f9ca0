!> Bodies that yield are brought to equilibrium in a load step: by Newton's method, by Anderson's
!> mix, by the initial-stress loop; only the factors of the elastic structure are used
module axijoint_plastic_methods
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_base_stop, only : stop_wished
   use axijoint_plastic_direction, only : newton_direction
   use axijoint_plastic_field, only : body_field_type
   use axijoint_plastic_mixing, only : mixing_type, new_mixing, mix
   use axijoint_plastic_problem, only : problem_type, iterate_type, look
   implicit none
   private
   public :: body_control_type, body_verdict_type, balance_bodies
   public :: method_newton, method_mix, method_loop

   !> Newton's method, and Anderson's mix where it gets no further
   integer, parameter :: method_newton = 1
   !> Anderson's mix
   integer, parameter :: method_mix = 2
   !> The loop as it is
   integer, parameter :: method_loop = 3

   !> Steps of the Krylov method in a step of Newton's, and the share of the residual left
   integer, parameter :: most_inner = 40
   real(wp), parameter :: forcing = 0.1_wp
   !> Iterates that the mix remembers, and steps that it takes in Newton's place
   integer, parameter :: depth = 10, substitute = 20
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
      !> One of the `method_` parameters
      integer :: method = method_mix
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
      !> Whether joints found no equilibrium on the way
      logical :: joints_failed = .false.
      !> Ratio of the residual forces
      real(wp) :: ratio = 0.0_wp
      !> Iterates, and elastic solutions of all modes
      integer :: iterations = 0, solutions = 0
      !> Share of the points that planes were needed for
      real(wp) :: on_planes = 0.0_wp
   end type body_verdict_type

contains

   !> Bring a load step to equilibrium
   subroutine balance_bodies(problem, control, field, verdict)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> When to end
      type(body_control_type), intent(in) :: control
      !> State: where to start, then in equilibrium
      type(body_field_type), intent(inout) :: field
      !> How it ended
      type(body_verdict_type), intent(out) :: verdict

      type(iterate_type) :: iterate
      real(wp) :: before, largest, best
      integer :: begun, best_at

      begun = problem%solutions
      largest = runaway*max(maxval(abs(field%unknowns)), maxval(abs(field%begun)), tiny(1.0_wp))
      best = huge(1.0_wp)
      best_at = begun
      call look(problem, field, iterate)
      do
         if (ended()) exit
         select case (control%method)
         case (method_newton)  ! its tangent knows no joints
            if (allocated(problem%joints)) then
               call mix_steps(depth, huge(1))
               cycle
            end if
            before = iterate%energy
            call newton_step(problem, field, iterate)
            verdict%iterations = verdict%iterations + 1
            if (iterate%energy > enough*before) call mix_steps(depth, substitute)
         case (method_mix)
            call mix_steps(depth, huge(1))
            if (ended()) exit
            if (.not. allocated(problem%joints)) call newton_step(problem, field, iterate)
         case default
            call mix_steps(0, huge(1))
         end select
      end do
      verdict%ratio = iterate%ratio
      field%scale = iterate%scale
      verdict%solutions = problem%solutions - begun
      verdict%on_planes = real(size(field%on), wp)/max(1, size(field%marked))

   contains

      !> Whether there is equilibrium, or no more to try
      logical function ended()
         if (allocated(problem%joints)) &
            verdict%joints_failed = .not. problem%joints%verdict%converged
         verdict%converged = .not. verdict%joints_failed &
            .and. (iterate%ratio <= control%tolerance .or. iterate%at_rounding)
         verdict%ran_away = maxval(abs(field%unknowns)) > largest
         if (iterate%ratio < halved*best) then
            best = iterate%ratio
            best_at = problem%solutions
         end if
         verdict%stalled = problem%solutions > best_at + patience .and. .not. verdict%converged
         ended = stop_wished()  ! nobody uses what was reached
         ended = ended .or. verdict%converged .or. verdict%ran_away .or. verdict%stalled &
            .or. verdict%joints_failed .or. .not. ieee_is_finite(iterate%ratio) &
            .or. problem%solutions - begun >= control%most
      end function ended

      !> Some steps of the mix
      subroutine mix_steps(remembered, most)
         !> Iterates remembered, and steps at most
         integer, intent(in) :: remembered, most

         type(mixing_type) :: memory
         real(wp) :: least
         integer :: k, least_at

         memory = new_mixing(size(field%unknowns), remembered)
         least = huge(1.0_wp)
         do k = 1, most
            if (ended()) exit
            if (iterate%ratio < halved*least) then
               least = iterate%ratio
               least_at = problem%solutions
            end if
            if (problem%solutions > least_at + restless .and. remembered > 0) exit
            call mix(memory, field%unknowns, iterate%residual, iterate%response)
            call look(problem, field, iterate)
            verdict%iterations = verdict%iterations + 1
         end do
      end subroutine mix_steps

   end subroutine balance_bodies

   !> A step of Newton's method, cut until the residual is smaller or, where there is a potential,
   !> most of the way down is behind; none if no cut helps
   subroutine newton_step(problem, field, iterate)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state
      type(body_field_type), intent(inout) :: field
      !> What it leaves out of balance
      type(iterate_type), intent(inout) :: iterate

      real(wp), allocatable :: start(:), direction(:)
      real(wp) :: length, down, still, energy
      integer :: cut
      logical :: moved

      allocate (direction, mold=field%unknowns)
      call newton_direction(problem, field, iterate, forcing, most_inner, direction)
      start = field%unknowns
      energy = iterate%energy
      down = dot_product(iterate%residual, direction)
      length = 1.0_wp
      do cut = 0, most_cuts
         field%unknowns = start + length*direction
         call look(problem, field, iterate)
         moved = iterate%energy < (1.0_wp - 0.1_wp*length)*energy
         still = dot_product(iterate%residual, direction)
         if (problem%associated_flow) moved = moved .or. abs(still) <= 0.5_wp*down
         if (moved) return
         if (still < 0.0_wp) then  ! beyond the lowest place on the way
            length = length*min(0.7_wp, max(0.1_wp, down/(down - still)))
         else
            length = 0.5_wp*length
         end if
      end do
      field%unknowns = start
      call look(problem, field, iterate)
   end subroutine newton_step

end module axijoint_plastic_methods
