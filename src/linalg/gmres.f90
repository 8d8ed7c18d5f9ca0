!> Generalized minimal residuals (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7,
!> 1986) for an operator known by its products
module axijoint_linalg_gmres
   use axijoint_base_kinds, only : wp
   use axijoint_linalg_lapack, only : ddot, dgemv
   implicit none
   private
   public :: operator_type, gmres

   !> Vectors of the basis that another is made orthogonal to together: as many as stay at hand between the two products
   integer, parameter :: together = 16

   !> Vectors of a basis that lie side by side, shape (size, `together`)
   type :: block_type
      real(wp), allocatable :: vectors(:, :)
   end type block_type

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

      type(block_type) :: basis(most/together + 1)
      real(wp) :: v(size(b))  ! the next vector
      real(wp), allocatable :: h(:, :)  ! the small triangle
      real(wp) :: cosine(most), sine(most), g(most + 1), size_b, t
      integer :: j, i

      x = 0.0_wp
      n_products = 0
      reduction = 0.0_wp
      size_b = norm2(b)
      if (.not. size_b > 0.0_wp) return
      g = 0.0_wp
      g(1) = size_b
      allocate (h(most + 1, most))
      v = b/size_b
      do j = 1, most
         associate (part => basis((j - 1)/together + 1), place => mod(j - 1, together) + 1)
            if (place == 1) allocate (part%vectors(size(b), together))
            part%vectors(:, place) = v
            call a%apply(part%vectors(:, place), v)
         end associate
         n_products = j
         call orthogonalize(basis, j, v, h(:j + 1, j))
         associate (column => h(:j + 1, j))
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
         g(j) = g(j)/h(j, j)
         g(:j - 1) = g(:j - 1) - g(j)*h(:j - 1, j)
      end do
      do j = 1, n_products, together
         call dgemv('N', size(x), min(together, n_products - j + 1), 1.0_wp, basis((j - 1)/together + 1)%vectors, size(x), &
            g(j), 1, 1.0_wp, x, 1)
      end do
   end subroutine gmres

   !> Make a vector orthogonal to a basis, a few vectors of it after others, and of length one. What rounding leaves of them
   !> does the solution no harm (Paige, Rozloznik and Strakos, SIAM J. Matrix Anal. Appl. 28, 2006) unless the operator
   !> is next to singular: so once is enough where that leaves enough of the vector, else it is done twice
   subroutine orthogonalize(basis, n_vectors, v, h)
      !> The basis, and how many vectors it has
      type(block_type), intent(in) :: basis(:)
      integer, intent(in) :: n_vectors
      !> The vector
      real(wp), intent(inout), contiguous :: v(:)
      !> Its components along the basis, and its length
      real(wp), intent(out), contiguous :: h(:)

      !> The square of what is left, over that before, that is enough
      real(wp), parameter :: enough = 0.1_wp
      real(wp) :: before, left, parts(together)
      integer :: first, k, n, pass, width

      n = size(v)
      h = 0.0_wp
      before = ddot(n, v, 1, v, 1)
      do pass = 1, 2
         do k = 1, (n_vectors - 1)/together + 1
            first = (k - 1)*together + 1
            width = min(together, n_vectors - first + 1)
            call dgemv('T', n, width, 1.0_wp, basis(k)%vectors, n, v, 1, 0.0_wp, parts, 1)
            call dgemv('N', n, width, -1.0_wp, basis(k)%vectors, n, parts, 1, 1.0_wp, v, 1)
            h(first:first + width - 1) = h(first:first + width - 1) + parts(:width)
         end do
         left = ddot(n, v, 1, v, 1)
         if (left > enough*before) exit
      end do
      h(size(h)) = sqrt(left)
      if (left > 0.0_wp) v = v/h(size(h))
   end subroutine orthogonalize

end module axijoint_linalg_gmres
