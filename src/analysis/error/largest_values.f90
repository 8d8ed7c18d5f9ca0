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
   !> What rounding may take from a bound
   real(wp), parameter :: rounding = 1.0e-12_wp

contains

   !> Largest displacement vector at any node and angle. The modes of a node together cannot give more
   !> than the sum of their amplitudes, by which most nodes need not be looked at
   pure real(wp) function largest_vector(modes, amplitude) result(largest)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: amplitude(:, :, :)

      real(wp) :: most(size(amplitude, 2))
      real(wp), allocatable :: total(:, :), factor(:, :, :)
      integer :: j, k, n, n_angles, node

      largest = 0.0_wp
      if (size(most) == 0 .or. size(modes) == 0) return
      n = min(4*(maxval(modes%harmonic) + 1), most_angles)
      n_angles = n
      if (all(modes%family == modes(1)%family)) n_angles = n/2 + 1  ! the other half mirrors this one
      allocate (factor(3, n_angles, size(modes)))
      do j = 1, n_angles
         factor(1, j, :) = meridional(modes, 2.0_wp*pi*(j - 1)/n)
         factor(2, j, :) = factor(1, j, :)
         factor(3, j, :) = circumferential(modes, 2.0_wp*pi*(j - 1)/n)
      end do
      total = abs(amplitude(:, :, 1))
      do k = 2, size(modes)
         total = total + abs(amplitude(:, :, k))
      end do
      most = (1.0_wp + rounding)*sum(total**2, 1)
      largest = there(maxloc(most, 1))
      do node = 1, size(most)
         if (most(node) > largest) largest = max(largest, there(node))
      end do
      largest = sqrt(largest)

   contains

      !> Square of the largest vector at a node
      pure real(wp) function there(node)
         !> The node
         integer, intent(in) :: node

         real(wp) :: vector(3)
         integer :: j, k

         there = 0.0_wp
         do j = 1, n_angles
            vector = 0.0_wp
            do k = 1, size(modes)
               vector = vector + factor(:, j, k)*amplitude(:, node, k)
            end do
            there = max(there, sum(vector**2))
         end do
      end function there

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
