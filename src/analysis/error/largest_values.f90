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

contains

   !> Largest displacement vector at any node and angle
   pure real(wp) function largest_vector(modes, amplitude) result(largest)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: amplitude(:, :, :)

      real(wp), allocatable :: total(:, :)
      real(wp) :: angle
      integer :: j, k, n

      allocate (total(3, size(amplitude, 2)))
      n = min(4*(maxval(modes%harmonic) + 1), most_angles)
      largest = 0.0_wp
      do j = 0, n - 1
         angle = 2.0_wp*pi*j/n
         total = 0.0_wp
         do k = 1, size(modes)
            total(:2, :) = total(:2, :) + meridional(modes(k), angle)*amplitude(:2, :, k)
            total(3, :) = total(3, :) + circumferential(modes(k), angle)*amplitude(3, :, k)
         end do
         largest = max(largest, maxval(sum(total**2, 1)))
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
