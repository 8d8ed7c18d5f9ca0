!> What iterations of joints that yield have to do
module axijoint_estimate_joint_work
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_kinds, only : wp
   use axijoint_estimate_terms, only : n_terms, laws, sums, flexibility
   use axijoint_joints_circle_sums, only : are_worth_it
   use axijoint_joints_pairs, only : pairs_type, new_pairs
   use axijoint_joints_planes, only : planes_type, new_planes
   use axijoint_model_joint_proportion, only : proportion_type, joint_proportions, side_of, &
      side_sensible, stiffest
   use axijoint_model_model, only : model_type, can_yield_at, method_newton
   implicit none
   private
   public :: joint_work, n_yielding

   !> Products with the flexibilities of an iteration of a loop
   real(wp), parameter :: loop_products = 1.0_wp
   !> Iterations that the estimates of errors take: to settle; on more planes, then with more
   !> harmonics, too; after the corrections by the finer mesh; the paper's loop beside it; where
   !> joints are out of proportion, with others
   real(wp), parameter :: to_settle = 2.0_wp, on_planes = 2.0_wp, after_mesh = 3.0_wp, &
      other_loop = 2.0_wp, of_stiffer = 10.0_wp
   !> Their linear solutions need few digits: products of one of these iterations, over those of an
   !> iteration of an increment
   real(wp), parameter :: rough = 0.4_wp
   !> Products of an iteration, which grow with the stiffness of joints, k h/E, beside that of bodies: coefficient, power, fewest, most
   real(wp), parameter :: of_products = 8.0_wp, power = 0.3_wp, fewest_products = 2.0_wp, most_products = 150.0_wp
   !> What sums by few operations take a plane, in modes of products for each halving of the planes
   real(wp), parameter :: of_halving = 3.0_wp
   !> Planes for these, times so many
   integer, parameter :: more_planes = 4

contains

   !> Work of the joints' iterations, and of what the estimates of errors iterate
   function joint_work(model, structure, iterations, estimates) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> Iterations of all increments
      real(wp), intent(in) :: iterations
      !> Whether errors are estimated
      logical, intent(in) :: estimates
      !> Counts of all terms
      real(wp) :: work(n_terms)

      type(planes_type) :: planes
      type(pairs_type) :: pairs
      type(proportion_type), allocatable :: proportions(:)
      real(wp) :: again, jumps, n_products
      integer :: intervals, k
      logical :: half

      work = 0.0_wp
      n_products = min(most_products, max(fewest_products, of_products*stiffest(model)**power))
      jumps = 3.0_wp*n_yielding(model, structure)
      pairs = new_pairs(pack(structure%joint_points, can_yield_at(model, structure%joint_points%material)))
      planes = new_planes(model%n_planes, structure%modes)
      half = size(planes%place) <= planes%n
      intervals = merge(size(planes%angle) - 1, size(planes%angle)/2, half)
      call iterate(iterations, merge(1.0_wp, loop_products/n_products, model%method == method_newton), intervals, &
         size(structure%modes))
      if (.not. estimates) return
      again = to_settle + after_mesh
      if (size(model%increments) == 1) again = again + other_loop
      proportions = joint_proportions(model)
      again = again + of_stiffer*count([(side_of(model%joint_materials(k)%law, proportions(k)) &
                                         /= side_sensible, k=1, size(proportions))])
      call iterate(again, rough, intervals, size(structure%modes))
      if (planes%folds == 0) return
      call iterate(on_planes, rough, more_planes*intervals, size(structure%modes))
      call iterate(on_planes, rough, more_planes*intervals, 2*size(structure%modes))
      if (takes_back(model)) call iterate(iterations, rough, intervals, 2*size(structure%modes))

   contains

      !> Add iterations on some planes with some modes: laws, products of Newton's linear solutions, and vectors that these are made
      !> orthogonal to
      subroutine iterate(n, share, intervals, n_modes)
         !> Iterations, and part of its products that each makes
         real(wp), intent(in) :: n, share
         !> Intervals between planes from 0 to pi, and modes
         integer, intent(in) :: intervals, n_modes

         integer :: n_planes

         n_planes = merge(intervals + 1, 2*intervals, half)
         work(laws) = work(laws) + n*jumps*n_planes
         work(sums) = work(sums) + share*n*n_products*jumps*n_planes*modes_of_sums(n_planes, n_modes, intervals)
         work(flexibility) = work(flexibility) + share*n*n_products*n_modes*((3.0_wp*size(pairs%nodes, 2))**2 &
            + share*n_products*jumps)
      end subroutine iterate

   end function joint_work

   !> Whether loads are taken back on the way: then what slip keeps of harmonics is followed through all increments
   pure logical function takes_back(model)
      !> The job
      type(model_type), intent(in) :: model

      takes_back = any(model%increments%factor < 0.0_wp) .and. any(model%increments%factor > 0.0_wp)
   end function takes_back

   !> Modes that take as long by products as sums do
   pure real(wp) function modes_of_sums(n_planes, n_modes, intervals) result(n)
      !> Planes, modes, and intervals from 0 to pi
      integer, intent(in) :: n_planes, n_modes, intervals

      n = n_modes
      if (are_worth_it(n_modes, n_planes, intervals)) n = of_halving*log(real(n_planes, wp))/log(2.0_wp)
   end function modes_of_sums

   !> Joint points that can yield
   pure integer function n_yielding(model, structure)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure

      n_yielding = count(can_yield_at(model, structure%joint_points%material))
   end function n_yielding

end module axijoint_estimate_joint_work
