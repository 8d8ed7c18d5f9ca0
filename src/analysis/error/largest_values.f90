!> The largest displacement of a field, and the largest stress of elastic joints
module axijoint_analysis_error_largest_values
   use axijoint_assembly_force, only : elastic_joint_stress
   use axijoint_base_kinds, only : wp, pi
   use axijoint_fe_mode, only : mode_type, meridional, circumferential
   use axijoint_joints_planes, only : planes_type, synthesize
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: largest_vector, largest_elastic_stress

   !> Most angles at which it is looked for
   integer, parameter :: most_angles = 64
   !> Nodes that are looked at together: a fast memory has room for them
   integer, parameter :: portion = 256

contains

   !> Largest displacement vector at any node and angle
   pure real(wp) function largest_vector(modes, amplitude) result(largest)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: amplitude(:, :, :)

      real(wp) :: total(3, portion), angle
      integer :: first, last, j, k, n, n_angles

      n = min(4*(maxval(modes%harmonic) + 1), most_angles)
      n_angles = n
      if (all(modes%family == modes(1)%family)) n_angles = n/2 + 1  ! the other half mirrors this one
      largest = 0.0_wp
      do first = 1, size(amplitude, 2), portion
         last = min(first + portion - 1, size(amplitude, 2))
         associate (there => total(:, :last - first + 1))
            do j = 0, n_angles - 1
               angle = 2.0_wp*pi*j/n
               there = 0.0_wp
               do k = 1, size(modes)
                  there(:2, :) = there(:2, :) + meridional(modes(k), angle) &
                     *amplitude(:2, first:last, k)
                  there(3, :) = there(3, :) + circumferential(modes(k), angle) &
                     *amplitude(3, first:last, k)
               end do
               largest = max(largest, maxval(sum(there**2, 1)))
            end do
         end associate
      end do
      largest = sqrt(largest)
   end function largest_vector

   !> Largest stress that jumps make in elastic joints
   function largest_elastic_stress(points, planes, jump) result(largest)
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Planes
      type(planes_type), intent(in) :: planes
      !> Amplitudes of the jumps, shape (3, points, modes)
      real(wp), intent(in) :: jump(:, :, :)
      !> The stress
      real(wp) :: largest

      real(wp), allocatable :: total(:, :, :)
      integer :: j

      total = synthesize(planes, jump)
      largest = 0.0_wp
      do j = 1, size(total, 3)
         largest = max(largest, maxval(abs(elastic_joint_stress(points, total(:, :, j)))))
      end do
   end function largest_elastic_stress

end module axijoint_analysis_error_largest_values
