!> The largest stress of elastic joints
module axijoint_analysis_error_largest_stress
   use axijoint_analysis_core_fields, only : peak_type
   use axijoint_analysis_core_totals, only : largest, of_component
   use axijoint_assembly_force, only : elastic_joint_stress
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: largest_elastic_stress

contains

   !> Largest stress that jumps make in elastic joints, anywhere round the circle
   function largest_elastic_stress(points, modes, jump) result(stress)
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes of the jumps, shape (3, points, modes)
      real(wp), intent(in) :: jump(:, :, :)
      !> The stress
      real(wp) :: stress

      type(peak_type) :: peak
      real(wp), allocatable :: amplitude(:, :, :)
      integer :: k

      allocate (amplitude, mold=jump)
      do k = 1, size(modes)
         amplitude(:, :, k) = elastic_joint_stress(points, jump(:, :, k))
      end do
      peak = largest(modes, amplitude, of_component)
      stress = max(0.0_wp, peak%value)
   end function largest_elastic_stress

end module axijoint_analysis_error_largest_stress
