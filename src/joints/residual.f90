!> Residual forces of the whole structure and their norm (Eq. 17)
module axijoint_joints_residual
   use axijoint_assembly_equations, only : equations_type, on_equations
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: residual_norm, load_norm, ratio

contains

   !> Norm of the residual forces r = N*^T e of joint stress that is neither
   !> admitted nor transferred yet: the ring forces on all equations, squared and
   !> integrated round the circle, which is the sum over m of |r_m|^2 / c_m for
   !> generalized forces r_m (Psi^r of Eq. 17)
   function residual_norm(equations, points, excess) result(norm)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Amplitudes of that stress, shape (3, points, modes)
      real(wp), intent(in) :: excess(:, :, :)
      !> The norm
      real(wp) :: norm

      real(wp) :: squared(size(equations%modes))
      integer :: k, n_nodes

      n_nodes = size(equations%classes(1)%dofs%equation, 2)
      do k = 1, size(equations%modes)
         associate (m => equations%modes(k)%harmonic)
            squared(k) = sum(on_equations(equations, k, joint_force(points, m, excess(:, :, k), n_nodes))**2) &
               /circle_integral(m)
         end associate
      end do
      norm = sqrt(sum(squared))
   end function residual_norm

   !> Norm of the loads (Psi_f of Eq. 17): of the external forces, and of those
   !> that held displacements and initial stresses give, which may balance them
   function load_norm(equations, loading) result(norm)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The loads
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
   elemental function ratio(part, whole)
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
