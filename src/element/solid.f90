!> Quadrilateral and triangular rings: stiffness of one harmonic
module axijoint_element_solid
   use axijoint_base_kinds, only : wp
   use axijoint_element_blocks, only : n_blocks, pack_blocks
   use axijoint_element_dilatation, only : dilatation_type, average_volume
   use axijoint_element_solid_point, only : solid_point_type, strain_matrices
   use axijoint_linalg_lapack, only : dgemm
   implicit none
   private
   public :: solid_blocks
   public :: stiffness_kernel_type, new_stiffness_kernel

   !> Elasticity between displacement gradients: the strain of a node's
   !> displacement (u, v, w) is the sum over k of g_k (E_k + m F_k) (u, v, w),
   !> with the gradient g = (dN/dr, dN/dz, N/r) and constant E_k, F_k (Eq. 4; F_k
   !> is zero but for k = 3). So the stiffness between two nodes is a sum of
   !> E_k^T D E_l times the integral of g_k g_l
   type :: stiffness_kernel_type
      private
      !> What is free of m, E_k^T D E_l, and linear in m, E_k^T D F + ..., for each of
      !> the nine pairs (k, l). Each of the nine components, by rows, is of one kind
      real(wp) :: first(9, 9) = 0.0_wp
      !> What is quadratic in m, F^T D F, for the pair (3, 3)
      real(wp) :: second(9) = 0.0_wp
      !> Elasticity matrix D
      real(wp) :: d(6, 6) = 0.0_wp
   end type stiffness_kernel_type

contains

   !> Kernel of a material
   pure function new_stiffness_kernel(d) result(kernel)
      !> Elasticity matrix
      real(wp), intent(in) :: d(6, 6)
      !> The kernel
      type(stiffness_kernel_type) :: kernel

      type(solid_point_type) :: point
      real(wp) :: e(6, 3, 3), f(6, 3, 3), b0(6, 3), b1(6, 3)
      integer :: k, l, q

      point%position = 1.0_wp
      do k = 1, 3  ! the strain matrices of a node whose gradient is the k-th unit vector
         point%gradient(:, 1) = merge(1.0_wp, 0.0_wp, [1, 2] == k)
         point%shape(1) = merge(1.0_wp, 0.0_wp, k == 3)
         call strain_matrices(point, 1, b0, b1)
         e(:, :, k) = b0
         f(:, :, k) = b1
      end do
      do l = 1, 3
         do k = 1, 3
            q = k + 3*(l - 1)
            kernel%first(:, q) = block_of(e(:, :, k), e(:, :, l)) &
               + block_of(e(:, :, k), f(:, :, l)) + block_of(f(:, :, k), e(:, :, l))
         end do
      end do
      kernel%second = block_of(f(:, :, 3), f(:, :, 3))
      kernel%d = d

   contains

      !> x^T D y as nine components
      pure function block_of(x, y) result(components)
         !> Strains of three displacements
         real(wp), intent(in) :: x(6, 3), y(6, 3)
         !> The components, by rows
         real(wp) :: components(9)

         components = reshape(matmul(transpose(y), matmul(transpose(d), x)), [9])
      end function block_of

   end function new_stiffness_kernel

   !> The parts of the stiffness of an element, free of the harmonic: K_m = c_m (A + m S + m^2 C), c_0 = 2 pi, c_m = pi (Eq. 5), in
   !> blocks of two nodes
   subroutine solid_blocks(points, n, kernel, blocks, dilatation)
      !> Integration points of the element
      type(solid_point_type), intent(in) :: points(:)
      !> Number of nodes
      integer, intent(in) :: n
      !> Kernel of its material
      type(stiffness_kernel_type), intent(in) :: kernel
      !> The blocks, shape (2, 3, 3, blocks)
      real(wp), intent(out), contiguous :: blocks(:, :, :, :)
      !> Means over the element, if it takes the volumetric strain as its mean
      type(dilatation_type), intent(in) :: dilatation

      real(wp), allocatable :: parts(:, :, :)

      if (dilatation%averaged) then
         allocate (parts(3*n, 3*n, 3))
         call averaged_stiffness(points, n, kernel, dilatation, parts(:, :, 1), parts(:, :, 2), &
                                 parts(:, :, 3))
         call pack_blocks(n, parts(:, :, 1), parts(:, :, 2), parts(:, :, 3), blocks)
      else
         call gradient_blocks(points, n, kernel, blocks)
      end if
   end subroutine solid_blocks

   !> Blocks from the integrals of the products of gradients
   subroutine gradient_blocks(points, n, kernel, blocks)
      !> Integration points of the element
      type(solid_point_type), intent(in) :: points(:)
      !> Number of nodes
      integer, intent(in) :: n
      !> Kernel of its material
      type(stiffness_kernel_type), intent(in) :: kernel
      !> The blocks, shape (2, 9, blocks)
      real(wp), intent(out) :: blocks(2, 9, n_blocks(n))

      real(wp) :: gradient(3*n, size(points)), weighted(3*n, size(points)), integral(3*n, 3*n)
      real(wp), dimension(9, n_blocks(n)) :: moment, first
      integer :: i, j, k, p

      do k = 1, size(points)
         do i = 1, n
            gradient(3*i - 2:3*i - 1, k) = points(k)%gradient(:, i)
            gradient(3*i, k) = points(k)%shape(i)/points(k)%position(1)
         end do
         weighted(:, k) = points(k)%weight*gradient(:, k)
      end do
      call dgemm('N', 'T', 3*n, 3*n, size(points), 1.0_wp, gradient, 3*n, weighted, 3*n, 0.0_wp, &
                 integral, 3*n)
      p = 0
      do j = 1, n
         do i = j, n
            p = p + 1
            moment(1:3, p) = integral(3*i - 2:3*i, 3*j - 2)
            moment(4:6, p) = integral(3*i - 2:3*i, 3*j - 1)
            moment(7:9, p) = integral(3*i - 2:3*i, 3*j)
         end do
      end do
      call dgemm('N', 'N', 9, size(moment, 2), 9, 1.0_wp, kernel%first, 9, moment, 9, 0.0_wp, &
         first, 9)
      do p = 1, size(moment, 2)
         blocks(1, :, p) = first(:, p)
         blocks(2, :, p) = kernel%second*moment(9, p)
      end do
   end subroutine gradient_blocks

   !> The parts of an element that takes the volumetric strain as its mean
   pure subroutine averaged_stiffness(points, n, kernel, dilatation, a, s, c)
      !> Integration points of the element
      type(solid_point_type), intent(in) :: points(:)
      !> Number of nodes
      integer, intent(in) :: n
      !> Kernel of its material
      type(stiffness_kernel_type), intent(in) :: kernel
      !> Means over the element
      type(dilatation_type), intent(in) :: dilatation
      !> The parts, shape (3n, 3n)
      real(wp), intent(out) :: a(:, :), s(:, :), c(:, :)

      real(wp), dimension(6, 3*n) :: b0, b1, weighted
      integer :: k

      a = 0.0_wp
      s = 0.0_wp
      c = 0.0_wp
      do k = 1, size(points)
         call strain_matrices(points(k), n, b0, b1)
         call average_volume(dilatation, n, b0, b1)
         weighted = points(k)%weight*matmul(kernel%d, b0)
         a = a + matmul(transpose(b0), weighted)
         s = s + matmul(transpose(b1), weighted)
         weighted = points(k)%weight*matmul(kernel%d, b1)
         c = c + matmul(transpose(b1), weighted)
      end do
      s = s + transpose(s)
   end subroutine averaged_stiffness

end module axijoint_element_solid
