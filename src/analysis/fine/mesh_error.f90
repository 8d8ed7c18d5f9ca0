!> What the mesh leaves of the error of displacements and of joint stress: by the difference to the
!> solution on a mesh of elements half as large
module axijoint_analysis_fine_mesh_error
   use axijoint_analysis_fine_difference, only : difference_type
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: mesh_error_type, new_mesh_error

   !> The error over the difference to a mesh of elements half as large: 4/3 where the error falls
   !> with the square of their size, 16/15 with the fourth power, 1.9 with the power 1.1 of
   !> displacements by a re-entrant corner. And the difference is found to 5 to 20 %
   real(wp), parameter, public :: error_over_difference = 1.6_wp

   !> Factor on that of joint stress judged away from where it is infinite: there it converges
   !> faster
   real(wp), parameter, public :: away_from_infinite = 0.75_wp

   !> Errors left by the mesh
   type :: mesh_error_type
      !> Whether it was found: a factor that is not kept may lack the memory to be formed again, and a difference may be no number
      logical :: known = .true.
      !> Of displacements of the nodes, amplitudes, shape (3, nodes, modes); zero where it is not
      !> known
      real(wp), allocatable :: displacement(:, :, :)
      !> Of the jumps at all joint points, their stress fixed, amplitudes, shape (3, points, modes)
      real(wp), allocatable :: jump(:, :, :)
      !> Forces on nodes besides those of jumps: of supports and springs, and of the excess stress of joints, which finer ones
      !> integrate otherwise. Of as many of the first modes as are asked for, shape (3, nodes, these); not allocated if not known
      real(wp), allocatable :: acting(:, :, :)
      !> Difference to the solution on a mesh of elements half as large at its nodes near lines, shape (3, those nodes, modes)
      real(wp), allocatable :: near_lines(:, :, :)
      !> Of the stresses along lines, at the nodes of their elements, amplitudes, shape (6, values, modes); not allocated if not known
      real(wp), allocatable :: on_lines(:, :, :)
      !> Of the resultants on cuts, shape (n_resultants, cuts); not allocated if not known
      real(wp), allocatable :: on_cuts(:, :)
      !> Whether that is known of a cut, shape (cuts)
      logical, allocatable :: known_on_cuts(:)
      !> Energy of the error, the stress of joints that yield fixed, shape (modes)
      real(wp), allocatable :: energy(:)
      !> Largest error of a stress of joints that can yield; negative if not known [stress]
      real(wp) :: joint_stress = -1.0_wp
      !> Whether what the mesh left in earlier increments of slip that lasts is among them
      logical :: follows_slip = .false.
      !> Time [second]
      real(wp) :: seconds = 0.0_wp
   end type mesh_error_type

contains

   !> The errors from the difference
   subroutine new_mesh_error(difference, error)
      !> The difference
      type(difference_type), intent(in) :: difference
      !> The errors
      type(mesh_error_type), intent(out) :: error

      error%displacement = error_over_difference*difference%displacement
      error%jump = error_over_difference*difference%jump
      error%acting = error_over_difference*difference%holding
      error%near_lines = difference%near_lines
      error%energy = error_over_difference*difference%energy  ! falls as displacements do at corners
      error%seconds = difference%seconds
      error%known = all(difference%known)
      if (error%known) return
      error%displacement = 0.0_wp
      error%jump = 0.0_wp
      deallocate (error%acting, error%near_lines)
      error%energy = 0.0_wp
   end subroutine new_mesh_error

end module axijoint_analysis_fine_mesh_error
