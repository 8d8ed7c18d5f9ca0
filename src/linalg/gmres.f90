!> Generalized minimal residuals (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7,
!> 1986) for an operator known by its products
module axijoint_linalg_gmres
   use axijoint_base_kinds, only : wp
   use axijoint_linalg_lapack, only : daxpy, ddot
   implicit none
   private
   public :: operator_type, gmres

   !> A linear operator
   type, abstract :: operator_type
   contains
      !> Its product with a vector
      procedure(apply_interface), deferred :: apply
   end type operator_type

   !> A vector of the basis, or a column of the small triangle
   type :: vector_type
      real(wp), allocatable :: values(:)
   end type vector_type

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

      type(vector_type) :: basis(most + 1), h(most)
      real(wp) :: cosine(most), sine(most), g(most + 1), size_b, t
      integer :: j, i

      x = 0.0_wp
      n_products = 0
      reduction = 0.0_wp
      size_b = norm2(b)
      if (.not. size_b > 0.0_wp) return
      g = 0.0_wp
      g(1) = size_b
      basis(1)%values = b/size_b
      do j = 1, most
         allocate (basis(j + 1)%values(size(b)), h(j)%values(j + 1))
         call a%apply(basis(j)%values, basis(j + 1)%values)
         n_products = j
         call orthogonalize(basis(:j), basis(j + 1)%values, h(j)%values)
         associate (column => h(j)%values)
            do i = 1, j - 1  ! the rotations so far
               t = cosine(i)*column(i) + sine(i)*column(i + 1)
               column(i + 1) = cosine(i)*column(i + 1) - sine(i)*column(i)
               column(i) = t
            end do
            t = hypot(column(j), column(j + 1))
            if (.not. t > tiny(t)) then  ! the operator is singular on this space
               n_products = j - 1
               exit
            end if
            cosine(j) = column(j)/t
            sine(j) = column(j + 1)/t
            column(j) = t
         end associate
         g(j + 1) = -sine(j)*g(j)
         g(j) = cosine(j)*g(j)
         reduction = abs(g(j + 1))/size_b
         if (reduction <= tolerance) exit
      end do
      do j = n_products, 1, -1  ! back-substitution
         g(j) = g(j)/h(j)%values(j)
         g(:j - 1) = g(:j - 1) - g(j)*h(j)%values(:j - 1)
         call daxpy(size(x), g(j), basis(j)%values, 1, x, 1)
      end do
   end subroutine gmres

   !> Make a vector orthogonal to a basis, one vector after the other, and of length one. What rounding leaves of them
   !> does the solution no harm (Paige, Rozloznik and Strakos, SIAM J. Matrix Anal. Appl. 28, 2006) unless the operator
   !> is next to singular: so once is enough where that leaves enough of the vector, else it is done twice
   subroutine orthogonalize(basis, v, h)
      !> The basis
      type(vector_type), intent(in) :: basis(:)
      !> The vector
      real(wp), intent(inout), contiguous :: v(:)
      !> Its components along the basis, and its length
      real(wp), intent(out) :: h(:)

      !> The square of what is left, over that before, that is enough
      real(wp), parameter :: enough = 0.1_wp
      real(wp) :: before, left, part
      integer :: i, pass

      h(:) = 0.0_wp
      before = ddot(size(v), v, 1, v, 1)
      do pass = 1, 2
         do i = 1, size(basis)
            part = ddot(size(v), basis(i)%values, 1, v, 1)
            call daxpy(size(v), -part, basis(i)%values, 1, v, 1)
            h(i) = h(i) + part
         end do
         left = ddot(size(v), v, 1, v, 1)
         if (left > enough*before) exit
      end do
      h(size(h)) = sqrt(left)
      if (left > 0.0_wp) v = v/h(size(h))
   end subroutine orthogonalize

end module axijoint_linalg_gmres
