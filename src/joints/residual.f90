!> Residual forces of the whole structure and their norm (Eq. 17)
module axijoint_joints_residual
   use axijoint_assembly_equations, only : equations_type, elastic_force, on_equations, worth_threads
   use axijoint_assembly_force, only : joint_force
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: unbalanced_ratio, residual_squared, force_squared

contains

   !> Square of the norm of the residual forces of one harmonic,
   !> r = f - K u + N*^T e with e the joint stress k d - P not admitted
   function residual_squared(equations, k, points, applied, displacement, excess) result(squared)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the harmonic
      integer, intent(in) :: k
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Applied forces on components, shape (3, nodes)
      real(wp), intent(in) :: applied(:, :)
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Amplitudes of the joint stress not admitted, shape (3, points)
      real(wp), intent(in) :: excess(:, :)
      !> The square
      real(wp) :: squared

      associate (m => equations%harmonics(k))
         squared = sum((on_equations(equations, k, &
                                applied + joint_force(points, m, excess, size(applied, 2))) &
                        - elastic_force(equations, k, displacement))**2)/circle_integral(m)
      end associate
   end function residual_squared

   !> Square of the norm of applied forces of one harmonic
   function force_squared(equations, k, applied) result(squared)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the harmonic
      integer, intent(in) :: k
      !> Applied forces on components, shape (3, nodes)
      real(wp), intent(in) :: applied(:, :)
      !> The square
      real(wp) :: squared

      squared = sum(on_equations(equations, k, applied)**2)/circle_integral(equations%harmonics(k))
   end function force_squared

   !> Norm of the residual forces over the norm of the applied forces (Eq. 17).
   !> The norm is that of the ring forces on all equations, squared and
   !> integrated round the circle: the sum over m of |f_m|^2 / c_m for
   !> generalized forces f_m. Not a number if a residual is not finite.
   function unbalanced_ratio(equations, points, applied, displacement, excess) result(ratio)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Applied forces, shape (3, nodes, harmonics)
      real(wp), intent(in) :: applied(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, harmonics)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Joint stress not admitted, shape (3, points, harmonics)
      real(wp), intent(in) :: excess(:, :, :)
      !> The ratio; zero when neither loads nor residual forces act
      real(wp) :: ratio

      real(wp), dimension(size(equations%harmonics)) :: residual, load
      integer :: k

      !$omp parallel do schedule(dynamic) if (worth_threads(equations))
      do k = 1, size(equations%harmonics)
         residual(k) = residual_squared(equations, k, points, applied(:, :, k), &
                                        displacement(:, :, k), excess(:, :, k))
         load(k) = force_squared(equations, k, applied(:, :, k))
      end do
      !$omp end parallel do
      ratio = 0.0_wp
      if (sum(load) > 0.0_wp) then
         ratio = sqrt(sum(residual)/sum(load))
      else if (sum(residual) > 0.0_wp) then
         ratio = huge(1.0_wp)
      end if
   end function unbalanced_ratio

end module axijoint_joints_residual
