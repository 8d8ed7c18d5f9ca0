!> Semi-smooth Newton iteration for the joint stress of all modes together, on
!> the condensed structure
module axijoint_joints_newton
   use axijoint_base_kinds, only : wp
   use axijoint_joints_planes, only : planes_type, synthesize, analyse
   use axijoint_joints_response, only : response_type, jumps
   use axijoint_linalg_gmres, only : operator_type, gmres
   implicit none
   private
   public :: newton_step

   !> Most products of a linear solution
   integer, parameter :: most_products = 400

   !> I - A E' S F: derivative of the excess stress that is not yet transferred,
   !> with the synthesis S, the slopes E' of the laws and the analysis A
   type, extends(operator_type) :: derivative_type
      !> Flexibilities, planes, slopes on the planes, shape (3, 3, points, planes)
      type(response_type), pointer :: response => null()
      type(planes_type), pointer :: planes => null()
      real(wp), pointer :: slope(:, :, :, :) => null()
   contains
      !> Product with amplitudes of excess stress
      procedure :: apply
   end type derivative_type

contains

   !> Product with amplitudes of excess stress
   subroutine apply(self, x, y)
      !> The operator
      class(derivative_type), intent(in) :: self
      !> Amplitudes, 3 x points x modes
      real(wp), intent(in), contiguous :: x(:)
      !> The product
      real(wp), intent(out), contiguous :: y(:)

      real(wp), allocatable :: excess(:, :, :), total(:, :, :)
      integer :: j, k

      excess = reshape(x, [3, size(self%slope, 3), size(x)/(3*size(self%slope, 3))])
      total = synthesize(self%planes, jumps(self%response, excess, free=.false.))
      do j = 1, size(total, 3)
         do k = 1, size(total, 2)
            total(:, k, j) = matmul(self%slope(:, :, k, j), total(:, k, j))
         end do
      end do
      excess = excess - analyse(self%planes, total)
      y = reshape(excess, [size(y)])
   end subroutine apply

   !> Change of the excess stress that would balance the residual were the laws
   !> linear
   subroutine newton_step(response, planes, slope, residual, tolerance, change, n_products, reduction)
      !> Flexibilities
      type(response_type), intent(in), target :: response
      !> Planes
      type(planes_type), intent(in), target :: planes
      !> Slopes of the laws
      real(wp), intent(in), target, contiguous :: slope(:, :, :, :)
      !> Excess stress not transferred, shape (3, points, modes)
      real(wp), intent(in) :: residual(:, :, :)
      !> Tolerance of the linear solution
      real(wp), intent(in) :: tolerance
      !> The change, same shape
      real(wp), intent(out) :: change(:, :, :)
      !> Products that it took
      integer, intent(out) :: n_products
      !> How far the linear residual came down
      real(wp), intent(out) :: reduction

      type(derivative_type) :: derivative
      real(wp) :: x(size(residual)), b(size(residual))

      derivative%response => response
      derivative%planes => planes
      derivative%slope => slope
      b = reshape(residual, [size(b)])
      call gmres(derivative, b, tolerance, min(most_products, size(b)), x, n_products, reduction)
      change = reshape(x, shape(change))
   end subroutine newton_step

end module axijoint_joints_newton
