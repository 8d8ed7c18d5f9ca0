!> What iterations of joints that yield have to do
module axijoint_estimate_joint_work
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_kinds, only : wp
   use axijoint_estimate_terms, only : n_terms, laws, sums, flexibility
   use axijoint_joints_half_sums, only : worth_halves
   use axijoint_joints_planes, only : planes_type, new_planes
   use axijoint_model_joint_proportion, only : proportion_type, joint_proportions, side_of, &
      side_sensible
   use axijoint_model_model, only : model_type, can_yield_at, method_newton
   implicit none
   private
   public :: joint_work, n_yielding

   !> What an iteration of a loop costs beside one of Newton's method, which multiplies with the
   !> flexibilities again and again
   real(wp), parameter :: loop_share = 0.1_wp
   !> Iterations that the estimates of errors take: to settle; on more planes, then with more
   !> harmonics, too; after the corrections by the finer mesh; the paper's loop beside it; where
   !> joints are out of proportion, with others
   real(wp), parameter :: to_settle = 2.0_wp, on_planes = 2.0_wp, after_mesh = 3.0_wp, &
      other_loop = 2.0_wp, of_stiffer = 10.0_wp
   !> Their linear solutions need few digits: products of one of these iterations, over those of an
   !> iteration of an increment
   real(wp), parameter :: rough = 0.4_wp
   !> What is left of the products of sums that are found by halves
   real(wp), parameter :: by_halves = 0.35_wp
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
      type(proportion_type), allocatable :: proportions(:)
      real(wp) :: again, jumps
      integer :: k

      work = 0.0_wp
      jumps = 3.0_wp*n_yielding(model, structure)
      planes = new_planes(model%n_planes, structure%modes)
      call iterate(iterations*merge(1.0_wp, loop_share, model%method == method_newton), 1.0_wp, &
         size(planes%angle), size(structure%modes))
      if (.not. estimates) return
      again = to_settle + after_mesh
      if (size(model%increments) == 1) again = again + other_loop
      proportions = joint_proportions(model)
      again = again + of_stiffer*count([(side_of(model%joint_materials(k)%law, proportions(k)) &
                                         /= side_sensible, k=1, size(proportions))])
      call iterate(again, rough, size(planes%angle), size(structure%modes))
      if (planes%folds == 0) return
      call iterate(on_planes, rough, more_planes*size(planes%angle), size(structure%modes))
      call iterate(on_planes, rough, more_planes*size(planes%angle), 2*size(structure%modes))

   contains

      !> Add iterations on some planes with some modes
      subroutine iterate(n, share, n_planes, n_modes)
         !> Iterations, and how many products each makes beside what is usual
         real(wp), intent(in) :: n, share
         !> Planes, modes
         integer, intent(in) :: n_planes, n_modes

         work(laws) = work(laws) + n*jumps*n_planes
         work(sums) = work(sums) + merge(by_halves, 1.0_wp, worth_halves(n_modes, n_planes)) &
            *share*n*jumps*n_planes*n_modes
         work(flexibility) = work(flexibility) + share*n*jumps**2*n_modes
      end subroutine iterate

   end function joint_work

   !> Joint points that can yield
   pure integer function n_yielding(model, structure)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure

      n_yielding = count(can_yield_at(model, structure%joint_points%material))
   end function n_yielding

end module axijoint_estimate_joint_work
