!> Generalized minimal residuals (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7,
!> 1986) for an operator known by its products
module axijoint_linalg_gmres
   use axijoint_base_kinds, only : wp
   use axijoint_linalg_lapack, only : matrix_vector, transposed_vector
   implicit none
   private
   public :: operator_type, gmres

   !> A linear operator
   type, abstract :: operator_type
   contains
      !> Its product with a vector
      procedure(apply_interface), deferred :: apply
   end type operator_type

   abstract interface
      !> Product with a vector
      subroutine apply_interface(self, x, y)
         import :: operator_type, wp
         !> The operator
         class(operator_type), intent(in) :: self
         !> The vector
         real(wp), intent(in), contiguous :: x(:)
         !> The product
         real(wp), intent(out), contiguous :: y(:)
      end subroutine apply_interface
   end interface

contains

   !> Solve a x = b from x = 0 until |b - a x| <= tolerance |b|, without restart
   subroutine gmres(a, b, tolerance, most, x, n_products, reduction)
      !> The operator
      class(operator_type), intent(in) :: a
      !> Right-hand side
      real(wp), intent(in), contiguous :: b(:)
      !> Tolerance
      real(wp), intent(in) :: tolerance
      !> Most products
      integer, intent(in) :: most
      !> The solution, or the best found
      real(wp), intent(out), contiguous :: x(:)
      !> Products that were made
      integer, intent(out) :: n_products
      !> |b - a x| / |b| reached
      real(wp), intent(out) :: reduction

      real(wp), allocatable :: basis(:, :), h(:, :)
      real(wp) :: cosine(most), sine(most), g(most + 1), size_b, t
      integer :: j, i

      x = 0.0_wp
      n_products = 0
      reduction = 0.0_wp
      size_b = norm2(b)
      if (.not. size_b > 0.0_wp) return
      allocate (basis(size(b), most + 1), h(most + 1, most))  ! as far as they are used they are set
      g = 0.0_wp
      g(1) = size_b
      basis(:, 1) = b/size_b
      do j = 1, most
         call a%apply(basis(:, j), basis(:, j + 1))
         n_products = j
         call orthogonalize(basis(:, :j), basis(:, j + 1), h(:j + 1, j))
         do i = 1, j - 1  ! the rotations so far
            t = cosine(i)*h(i, j) + sine(i)*h(i + 1, j)
            h(i + 1, j) = cosine(i)*h(i + 1, j) - sine(i)*h(i, j)
            h(i, j) = t
         end do
         t = hypot(h(j, j), h(j + 1, j))
         if (.not. t > tiny(t)) then  ! the operator is singular on this space
            n_products = j - 1
            exit
         end if
         cosine(j) = h(j, j)/t
         sine(j) = h(j + 1, j)/t
         h(j, j) = t
         g(j + 1) = -sine(j)*g(j)
         g(j) = cosine(j)*g(j)
         reduction = abs(g(j + 1))/size_b
         if (reduction <= tolerance) exit
      end do
      do j = n_products, 1, -1  ! back-substitution
         g(j) = (g(j) - dot_product(h(j, j + 1:n_products), g(j + 1:n_products)))/h(j, j)
      end do
      if (n_products > 0) call matrix_vector(basis(:, :n_products), g, x)
   end subroutine gmres

   !> Make a vector orthogonal to a basis, and of length one. Once is enough where that leaves most of
   !> it, twice always (Daniel, Gragg, Kaufman and Stewart, Math. Comp. 30, 1976)
   subroutine orthogonalize(basis, v, h)
      !> The basis
      real(wp), intent(in), contiguous :: basis(:, :)
      !> The vector
      real(wp), intent(inout), contiguous :: v(:)
      !> Its components along the basis, and its length
      real(wp), intent(out) :: h(:)

      !> The square of what is left, over that before, that is most of it
      real(wp), parameter :: most = 0.5_wp
      real(wp) :: part(size(basis, 2)), along(size(v)), before, left
      integer :: pass

      h(:) = 0.0_wp
      before = dot_product(v, v)
      do pass = 1, 2
         call transposed_vector(basis, v, part)
         call matrix_vector(basis, part, along)
         v = v - along
         h(:size(part)) = h(:size(part)) + part
         left = dot_product(v, v)
         if (left > most*before) exit
      end do
      h(size(h)) = sqrt(left)
      if (h(size(h)) > 0.0_wp) v = v/h(size(h))
   end subroutine orthogonalize

end module axijoint_linalg_gmres
