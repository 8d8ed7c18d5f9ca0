!> Estimate of what the mesh leaves of the error
module axijoint_analysis_core_discretization_error
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: discretization_error_type

   !> Estimate of the discretization error. The energy norm is that of stresses, of the whole
   !> circle: its square is twice the energy, 1/2 integral of stress^T D^-1 stress
   type :: discretization_error_type
      !> Energy of the error in each mode, shape (modes) [force length]
      real(wp), allocatable :: error_energy(:)
      !> Energy of the solution in each mode: solids, joints and springs, shape (modes)
      real(wp), allocatable :: energy(:)
      !> Error over solution of each mode in the energy norm, shape (modes)
      real(wp), allocatable :: mode_relative(:)
      !> The same of all modes together
      real(wp) :: relative = 0.0_wp
      !> Part of each element in the square of `relative`, shape (elements): the energy of its
      !> error in all modes over that of the whole solution
      real(wp), allocatable :: element(:)
      !> Largest displacement of a node [length]
      real(wp) :: largest_displacement = 0.0_wp
      !> Largest error of a displacement over the largest displacement
      real(wp) :: displacement = 0.0_wp
      !> Largest error of the displacement of each point with a name, shape (points) [length]; negative if not known
      real(wp), allocatable :: at_points(:)
      !> Error of the axial force, lateral force, moment and torque on each cut, shape (4, cuts) [force, force length]; negative if
      !> not known
      real(wp), allocatable :: on_cuts(:, :)
      !> Least force that their errors are measured by: a small part of what joints that yield carried at most [force]
      real(wp) :: least_force = 0.0_wp
      !> Error of the stresses along each line, shape (lines) [stress]; negative if not known
      real(wp), allocatable :: on_lines(:)
      !> Largest stress along each line, shape (lines), and largest amplitudes of each stress in each mode, shape (modes, 6, lines)
      !> [stress]; negative and zero where no point is judged
      real(wp), allocatable :: line_stress(:), line_amplitude(:, :, :)
      !> Points of each line whose stress is judged, which are not in an element where it is infinite, and all in elements, shape
      !> (2, lines)
      integer, allocatable :: line_points(:, :)
      !> Largest error of a joint stress over the largest joint stress; negative without joints
      real(wp) :: joint_stress = -1.0_wp
      !> Largest joint stress of each mode, shape (modes), and what errors of joint stress are measured by, where it is
      !> judged [stress]; zero without joints
      real(wp), allocatable :: joint_amplitude(:)
      real(wp) :: joint_scale = 0.0_wp
      !> Time that the estimate took [second]
      real(wp) :: seconds = 0.0_wp
   end type discretization_error_type

end module axijoint_analysis_core_discretization_error
