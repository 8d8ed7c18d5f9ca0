!> Largest pressure and largest shear stress of joints
module axijoint_analysis_core_joint_peaks
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_analysis_core_fields, only : fields_type, peak_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest, measure, of_pressure, of_shear
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   implicit none
   private
   public :: find_joint_peaks

contains

   !> Find both: on the planes of joints that open or slip, which have no other stresses; where there are none, stresses
   !> are sums of harmonics, whose largest does not hang on where anybody looks
   subroutine find_joint_peaks(structure, field, results)
      !> The structure
      type(structure_type), intent(in) :: structure
      !> State of all joints
      type(joint_field_type), intent(in) :: field
      !> Results with displacements and stresses of joints; takes the peaks
      class(fields_type), intent(inout) :: results

      real(wp), allocatable :: stress(:, :, :)
      integer :: k

      if (size(structure%joint_points) == 0) return
      if (size(structure%yielding) > 0) then
         results%pressure = largest_on_planes(results, of_pressure)
         results%shear = largest_on_planes(results, of_shear)
         return
      end if
      allocate (stress(3, size(structure%joint_points), size(results%modes)))
      do k = 1, size(results%modes)
         stress(:, :, k) = stress_amplitude(structure%joint_points, results%modes(k), results%displacement(:, :, k), field, k)
      end do
      results%pressure = largest(results%modes, stress, of_pressure)
      results%shear = largest(results%modes, stress, of_shear)
   end subroutine find_joint_peaks

   !> The largest on the planes
   pure function largest_on_planes(results, what) result(peak)
      !> Results
      class(fields_type), intent(in) :: results
      !> One of the `of_` parameters
      integer, intent(in) :: what
      !> Value, joint point, angle
      type(peak_type) :: peak

      real(wp) :: value
      integer :: point, plane

      do plane = 1, size(results%joint_stress, 3)
         do point = 1, size(results%joint_stress, 2)
            value = measure(what, results%joint_stress(:, point, plane))
            if (.not. ieee_is_finite(value)) cycle
            if (value > peak%value .or. peak%place == 0) peak = peak_type(value, point, results%plane_angles(plane))
         end do
      end do
   end function largest_on_planes

end module axijoint_analysis_core_joint_peaks
