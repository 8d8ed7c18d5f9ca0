!> Residual forces of the whole structure and their norm (Eq. 17)
module axijoint_joints_residual
   use axijoint_assembly_equations, only : equations_type, elastic_force, on_equations, worth_threads
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: residual_norm, load_norm, ratio

contains

   !> Norm of the residual forces r = f - K u + N*^T e, with e the joint stress
   !> k d - P not admitted: the ring forces on all equations, squared and
   !> integrated round the circle, which is the sum over m of |r_m|^2 / c_m for
   !> generalized forces r_m (Psi^r of Eq. 17)
   function residual_norm(equations, points, applied, displacement, excess) result(norm)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Applied forces on components, shape (3, nodes, modes)
      real(wp), intent(in) :: applied(:, :, :)
      !> Displacement amplitudes, same shape
      real(wp), intent(in) :: displacement(:, :, :)
      !> Amplitudes of the joint stress not admitted, shape (3, points, modes)
      real(wp), intent(in) :: excess(:, :, :)
      !> The norm
      real(wp) :: norm

      real(wp) :: squared(size(equations%modes))
      integer :: k

      !$omp parallel do schedule(dynamic) if (worth_threads(equations))
      do k = 1, size(equations%modes)
         associate (m => equations%modes(k)%harmonic)
            squared(k) = sum((on_equations(equations, k, applied(:, :, k) &
                                      + joint_force(points, m, excess(:, :, k), size(applied, 2))) &
                              - elastic_force(equations, k, displacement(:, :, k)))**2) &
               /circle_integral(m)
         end associate
      end do
      !$omp end parallel do
      norm = sqrt(sum(squared))
   end function residual_norm

   !> Norm of the loads (Psi_f of Eq. 17): of the external forces, and of those
   !> that held displacements and initial stresses give, which may balance them
   function load_norm(equations, loading) result(norm)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Loads for a factor of one
      type(loading_type), intent(in) :: loading
      !> The norm
      real(wp) :: norm

      real(wp) :: squared(size(equations%modes))
      integer :: k

      do k = 1, size(equations%modes)
         associate (external => loading%external(:, :, k), right => loading%right(:, :, k))
            squared(k) = (sum(on_equations(equations, k, external)**2) &
                          + sum(on_equations(equations, k, right - external)**2)) &
               /circle_integral(equations%modes(k)%harmonic)
         end associate
      end do
      norm = sqrt(sum(squared))
   end function load_norm

   !> Quotient of two sizes; zero over zero is zero
   pure function ratio(part, whole)
      !> Sizes, not negative
      real(wp), intent(in) :: part, whole
      !> part/whole; the largest number if only the whole is zero
      real(wp) :: ratio

      if (whole > 0.0_wp) then
         ratio = part/whole
      else
         ratio = merge(huge(1.0_wp), 0.0_wp, part > 0.0_wp)
      end if
   end function ratio

end module axijoint_joints_residual
