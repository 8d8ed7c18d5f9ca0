!> The path of an iteration to equilibrium
module axijoint_joints_path
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: iteration_type, append

   !> One line of the convergence path (Fig. 17 of the paper)
   type :: iteration_type
      !> Load increment
      integer :: increment = 0
      !> Iteration within the increment, the elastic solution being 1
      integer :: iteration = 0
      !> Sum of the load factors so far
      real(wp) :: load_factor = 0.0_wp
      !> Norm of the residual forces over the norm of the applied (Eq. 17)
      real(wp) :: ratio = 0.0_wp
      !> Points times planes that slip, and that are open
      integer :: n_slip = 0, n_open = 0
   end type iteration_type

contains

   !> Room for one more line of a path, which grows by doubling
   pure subroutine append(steps, k, step)
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

end module axijoint_joints_path
