!> Everything that a run computes and the output reports
module axijoint_analysis_core_results
   use axijoint_analysis_core_discretization_error, only : discretization_error_type
   use axijoint_analysis_core_fields, only : fields_type, peak_type
   use axijoint_analysis_core_in_situ, only : in_situ_type
   use axijoint_analysis_core_yield_errors, only : yield_errors_type
   use axijoint_analysis_fine_singular_places, only : singular_place_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_residual, only : residual_record_type
   use axijoint_joints_states, only : increment_state_type
   use axijoint_solver_entry, only : solver_entry_type
   implicit none
   private
   public :: results_type, mode_solve_type, ordering_type, remark_type, error_share_type, round_type, stiffer_type
   public :: source_discretization, source_harmonics, source_planes, source_iteration, &
      source_solver, source_sum, &
             source_names

   !> How well the equations of one mode were solved
   type :: mode_solve_type
      !> Harmonic and family
      type(mode_type) :: mode
      !> Number of equations
      integer :: n_equations = 0
      !> Entries of the factor (fill and all)
      integer(i8) :: factor_entries = 0
      !> Smallest ratio of a pivot to the diagonal entry it started from
      real(wp) :: smallest_pivot = 0.0_wp
      !> Backward error max |b - K u| / (|K| |u| + |b|), after one step of iterative refinement if
      !> that was needed
      real(wp) :: backward_error = 0.0_wp
      !> Largest correction by that step; without it a bound of what rounding leaves [length]
      real(wp) :: correction = 0.0_wp
      !> Estimate of the condition number |K| |K^-1| in the 1-norm (a lower bound,
      !> seldom more than three times too small)
      real(wp) :: condition = 0.0_wp
   end type mode_solve_type

   !> How wide an order of the nodes is
   type :: ordering_type
      !> Name of the order
      character(len=22) :: name = ''
      !> Half-bandwidth and profile of the graph of the nodes
      integer :: bandwidth = 0
      integer(i8) :: profile = 0
      !> Entries of the factor on the graph of the nodes
      integer(i8) :: fill = 0
   end type ordering_type

   !> A sentence about the results
   type :: remark_type
      !> The sentence
      character(len=:), allocatable :: text
      !> Whether it says why the results are no equilibrium, and whether the lines for the screen have what it says
      !> without it
      logical :: says_why = .false., said_elsewhere = .false.
   end type remark_type

   !> Sources of errors, in the order of the budget, and their sum
   integer, parameter :: source_discretization = 1, source_harmonics = 2, source_planes = 3, &
      source_iteration = 4, &
      source_solver = 5, source_sum = 6
   !> Their names
   character(len=14), parameter :: source_names(6) = [character(len=14) :: &
      'discretization', 'harmonics', 'planes', 'iteration', 'solver', 'sum']

   !> What one approximation leaves of the error, estimated. Relative values; negative
   !> if not known
   type :: error_share_type
      !> The approximation: one of the `source_` parameters
      integer :: source = 0
      !> Of the stresses, in the energy norm
      real(wp) :: energy = -1.0_wp
      !> Of the displacements
      real(wp) :: displacement = -1.0_wp
      !> Of the joint stress, over the largest
      real(wp) :: joint_stress = -1.0_wp
      !> Of the displacements at points with names, over the largest of these
      real(wp) :: points = -1.0_wp
      !> The same of each by itself [length], shape (points)
      real(wp), allocatable :: at_points(:)
      !> Of the resultants on cuts, over the largest of their kind
      real(wp) :: cuts = -1.0_wp
      !> The same of each by itself: axial force, lateral force, moment, torque, shape (4, cuts) [force, force length]
      real(wp), allocatable :: on_cuts(:, :)
      !> Of the stresses along lines, over the largest on any
      real(wp) :: sections = -1.0_wp
      !> The same of each by itself [stress], shape (lines)
      real(wp), allocatable :: on_lines(:)
      !> Of a load given as a function of theta: root mean square that is left out
      real(wp) :: load = -1.0_wp
      !> Time that the estimate took [second]
      real(wp) :: seconds = 0.0_wp
      !> What would halve it
      character(len=:), allocatable :: remedy
   end type error_share_type

   !> A round of a job that is refined until its error is below a target
   type :: round_type
      !> Elements of BLOCKS along each side, times so many
      real(wp) :: mesh = 1.0_wp
      !> Most nodes of an element; M; planes; unknowns in all
      integer :: nodes = 0, harmonic = 0, planes = 0, n_unknowns = 0
      !> Estimate of the error that the target is about; negative if not known
      real(wp) :: error = -1.0_wp
      !> What happened to the round, if it brought no results
      character(len=:), allocatable :: failure
      !> Time of the round [second]
      real(wp) :: seconds = 0.0_wp
   end type round_type

   !> What would change if the joints of some laws, soft or stiff out of proportion to the bodies,
   !> were ten times as stiff
   type :: stiffer_type
      !> The laws (indices), all on one side of what is sensible
      integer, allocatable :: laws(:)
      !> Whether the changes below were found
      logical :: known = .false.
      !> Changes of the largest displacement and of the largest joint stress, over these
      real(wp) :: displacement = 0.0_wp, joint_stress = 0.0_wp
      !> Largest changes of any displacement and of any joint stress, over the largest
      real(wp) :: displacement_anywhere = 0.0_wp, joint_stress_anywhere = 0.0_wp
   end type stiffer_type

   !> Results of a run. Amplitudes belong to a mode: u, v ~ cos(m theta),
   !> w ~ sin(m theta) in the symmetric family, ~ sin and -cos in the other.
   !> Results of a run: the fields at its end, and what is about the run
   type, extends(fields_type) :: results_type
      !> Whether every increment reached its tolerance
      logical :: converged = .false.
      !> Whether joint stress was accumulated over the iterations, as in the paper
      logical :: accumulated = .false.
      !> Largest difference of joint stress, over the largest, to the paper's loop at 3 %
      !> (to Newton's method, if the paper's loop was used); negative if not known
      real(wp) :: other_loop = -1.0_wp
      !> The mechanism that ended the job, in words; allocated if there was one
      character(len=:), allocatable :: mechanism
      !> Whether iterations ran away where no mechanism was found: the results are of the last equilibrium then, too
      logical :: strayed = .false.
      !> Sum of the load factors of the last step in equilibrium, where joints open or slip: an increment
      !> that failed may have been reached in part
      real(wp) :: reached = 0.0_wp
      !> Number of the load combination; 0 if there is one only
      integer :: combination = 0
      !> Solver that was used
      type(solver_entry_type) :: solver
      !> Orders of the nodes side by side
      type(ordering_type), allocatable :: orderings(:)
      !> One entry for each mode
      type(mode_solve_type), allocatable :: solves(:)
      !> Displacements of the step that found no equilibrium, counted from the last that did, shape
      !> (3, nodes, modes) [length], and its load factor; not allocated if none failed
      real(wp), allocatable :: failing(:, :, :)
      real(wp) :: tried = 0.0_wp
      !> States at the ends of the increments, the last one being that of these results
      type(increment_state_type), allocatable :: states(:)
      !> Fields at the ends of increments before the last, as far as they were found beside the iterations: those whose
      !> displacements are allocated. These are without rigid motions of floating parts, and what hangs on them is not there;
      !> shape (increments), or not allocated
      type(fields_type), allocatable :: earlier(:)
      !> Convergence path; empty for a linear job
      type(iteration_type), allocatable :: path(:)
      !> Motions that nothing resists and no load acts on, in words
      character(len=80), allocatable :: idle(:)
      !> Whether the parts stand along each of them where they stood when the last step began, shape (any)
      logical, allocatable :: stands(:)
      !> What the iterations left out of balance step by step, and a node of each part of the
      !> structure that it is measured on; empty for a linear job
      type(residual_record_type), allocatable :: residuals(:)
      integer, allocatable :: residual_part_node(:)
      !> Whether loads balance each other before anything moves, and joints hold: displacements are
      !> rounding
      logical :: at_rest = .false.
      !> Whether joints hold, or slipped back, that slipped in earlier increments: what the estimates tell is of the last one alone
      logical :: keeps_slip = .false.
      !> Whether what the mesh left of their slip then is among the errors, and whether what planes and harmonics left is, too: then
      !> the first is so only where parts slide as a whole or more than half of a load is gone
      logical :: follows_slip = .false., follows_all_slip = .false.
      !> Whether slip turns aside within an increment: estimates know nothing of the way there
      logical :: turns_slip = .false.
      !> Whether some bonds broke and others hold: which of them hangs on their order, of which estimates of joint stress know nothing
      logical :: torn = .false.
      !> Whether some points softened and others did not: estimates know nothing of the order that they do it in
      logical :: soft_in_part = .false.
      !> Whether elements lock, as finer ones do: estimates see little of what that leaves
      logical :: locks = .false.
      !> Whether there are walls of so many elements across that estimates see their bending in part, or with so long ones at their
      !> edges that these see nothing of how they bend there
      logical :: bends_unseen = .false., edges_unseen = .false.
      !> Whether there are such walls with elements at their edges that see a part of how stress changes there
      logical :: stress_in_part = .false.
      !> Error of displacements or joint stresses that the iterations leave, where it is more than
      !> the tolerance claims; zero if it is not
      real(wp) :: unsettled = 0.0_wp
      !> Forces of the joint stress that belongs to the bodies' relative displacements but not to
      !> those that the laws saw, over the loads: rounding of very stiff joints
      real(wp) :: mismatch = 0.0_wp
      !> What rounding in the solver leaves of displacements over the largest, if it is more than is claimed; else zero
      real(wp) :: uncertain = 0.0_wp
      !> Tolerance on the residual-force ratio
      real(wp) :: tolerance = 0.0_wp
      !> Bytes that this process sent and received: in the iterations on the joints, and in all;
      !> zero if it is alone
      integer(i8) :: exchanged(2) = 0
      !> Time that the increments of joints took, part of the phase of joints [second]
      real(wp) :: increment_seconds = 0.0_wp
      !> How far in-situ stress is out of balance with weight, supports and joints
      type(in_situ_type) :: in_situ
      !> Errors that iteration, planes and harmonics leave in joints that yield
      type(error_share_type) :: joint_errors(3)
      !> What the approximations leave of the error, side by side
      type(error_share_type), allocatable :: budget(:)
      !> Largest displacement of each point with a name, shape (points) [length]
      real(wp), allocatable :: point_size(:)
      !> The same of bodies that yield; allocated if there are any
      type(yield_errors_type), allocatable :: yield_errors
      !> What the mesh leaves of the error
      type(discretization_error_type) :: discretization
      !> Where stresses are infinite
      type(singular_place_type), allocatable :: singular(:)
      !> Largest pressure at the edges of joints, beyond their last points, and its node
      type(peak_type) :: edge_pressure
      !> Whether the stress of joint points is judged, which are not near to one of these; shape (joint points), or not allocated
      logical, allocatable :: judged(:)
      !> Rounds of refinement; allocated if the job has a target
      type(round_type), allocatable :: rounds(:)
      !> That and why they did not meet the target, in words; not allocated if they met it
      character(len=:), allocatable :: missed
      !> What stiffer joints would change: of soft laws, of stiff laws; none if all are sensible
      type(stiffer_type), allocatable :: stiffer(:)
      !> What was not modelled because it is zero or like something else
      type(remark_type), allocatable :: left_out(:)
      !> What the user should know about the results
      type(remark_type), allocatable :: remarks(:)
   contains
      !> Whether there are errors in any case that estimates do not see
      procedure :: hides_errors
   end type results_type

contains

   !> Whether there are errors of displacements and joint stress in any case that estimates do not see
   pure logical function hides_errors(self)
      !> Results
      class(results_type), intent(in) :: self

      hides_errors = self%keeps_slip .or. self%turns_slip .or. self%soft_in_part .or. self%locks &
         .or. self%bends_unseen .or. self%edges_unseen
   end function hides_errors

end module axijoint_analysis_core_results
