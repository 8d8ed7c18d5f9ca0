!> The largest stress of elastic joints
module axijoint_analysis_error_largest_stress
   use axijoint_assembly_force, only : elastic_joint_stress
   use axijoint_base_kinds, only : wp
   use axijoint_joints_planes, only : planes_type, synthesize
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: largest_elastic_stress

contains

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

end module axijoint_analysis_error_largest_stress
