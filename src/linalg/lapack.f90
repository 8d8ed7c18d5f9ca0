!> The LAPACK routines in use, with sizes taken from the arrays
module axijoint_linalg_lapack
   use, intrinsic :: iso_c_binding, only : c_int
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: band_cholesky, dpbtrf, dpbtrs, dtrsm, dgemm, dgemv, dsyrk, dpotrf, ddot, daxpy
   public :: cholesky, inverse_from_cholesky, symmetric_eigen, &
      use_one_blas_thread
   public :: product_rate
   public :: matrix_vector, complete, dsymv
   public :: least_squares, invert, singular_values

   interface
      !> Cholesky factorization of a positive definite band matrix
      subroutine dpbtrf(uplo, n, kd, ab, ldab, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, kd, ldab
         real(wp), intent(inout) :: ab(ldab, *)
         integer, intent(out) :: info
      end subroutine dpbtrf
      !> Solution with the factor of `dpbtrf`
      subroutine dpbtrs(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, kd, nrhs, ldab, ldb
         real(wp), intent(in) :: ab(ldab, *)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dpbtrs
      !> Solution with a triangular matrix: op(a) x = alpha b
      subroutine dtrsm(side, uplo, transa, diag, m, n, alpha, a, lda, b, ldb)
         import :: wp
         character, intent(in) :: side, uplo, transa, diag
         integer, intent(in) :: m, n, lda, ldb
         real(wp), intent(in) :: alpha, a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)
      end subroutine dtrsm
      !> Cholesky factorization of a positive definite matrix
      subroutine dpotrf(uplo, n, a, lda, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotrf
      !> Inverse from the factor of `dpotrf`
      subroutine dpotri(uplo, n, a, lda, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotri
      !> Eigenvalues and vectors of a symmetric matrix by divide and conquer
      subroutine dsyevd(jobz, uplo, n, a, lda, w, work, lwork, iwork, liwork, info)
         import :: wp
         character, intent(in) :: jobz, uplo
         integer, intent(in) :: n, lda, lwork, liwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: w(*), work(*)
         integer, intent(out) :: iwork(*), info
      end subroutine dsyevd
      !> c = alpha a b + beta c
      subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
         import :: wp
         character, intent(in) :: transa, transb
         integer, intent(in) :: m, n, k, lda, ldb, ldc
         real(wp), intent(in) :: alpha, beta, a(lda, *), b(ldb, *)
         real(wp), intent(inout) :: c(ldc, *)
      end subroutine dgemm
      !> c = alpha a a^T + beta c, one triangle of it
      subroutine dsyrk(uplo, trans, n, k, alpha, a, lda, beta, c, ldc)
         import :: wp
         character, intent(in) :: uplo, trans
         integer, intent(in) :: n, k, lda, ldc
         real(wp), intent(in) :: alpha, beta, a(lda, *)
         real(wp), intent(inout) :: c(ldc, *)
      end subroutine dsyrk
      !> y = alpha op(a) x + beta y
      subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: wp
         character, intent(in) :: trans
         integer, intent(in) :: m, n, lda, incx, incy
         real(wp), intent(in) :: alpha, beta, a(lda, *), x(*)
         real(wp), intent(inout) :: y(*)
      end subroutine dgemv
      !> x^T y
      pure real(wp) function ddot(n, x, incx, y, incy)
         import :: wp
         integer, intent(in) :: n, incx, incy
         real(wp), intent(in) :: x(*), y(*)
      end function ddot
      !> y := alpha x + y
      pure subroutine daxpy(n, alpha, x, incx, y, incy)
         import :: wp
         integer, intent(in) :: n, incx, incy
         real(wp), intent(in) :: alpha, x(*)
         real(wp), intent(inout) :: y(*)
      end subroutine daxpy
      !> y = alpha a x + beta y with a symmetric matrix
      subroutine dsymv(uplo, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda, incx, incy
         real(wp), intent(in) :: alpha, beta, a(lda, *), x(*)
         real(wp), intent(inout) :: y(*)
      end subroutine dsymv
      !> Least squares with a rank-revealing factorization
      subroutine dgelsy(m, n, nrhs, a, lda, b, ldb, jpvt, rcond, rank, work, lwork, info)
         import :: wp
         integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(inout) :: jpvt(*)
         real(wp), intent(in) :: rcond
         real(wp), intent(out) :: work(*)
         integer, intent(out) :: rank, info
      end subroutine dgelsy
      !> LU factorization with partial pivoting
      subroutine dgetrf(m, n, a, lda, ipiv, info)
         import :: wp
         integer, intent(in) :: m, n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*)
         integer, intent(out) :: info
      end subroutine dgetrf

      !> Singular value decomposition of a general matrix
      subroutine dgesvd(jobu, jobvt, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, info)
         import :: wp
         character, intent(in) :: jobu, jobvt
         integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: s(*), u(ldu, *), vt(ldvt, *), work(*)
         integer, intent(out) :: info
      end subroutine dgesvd

      !> Inverse by the factors of dgetrf
      subroutine dgetri(n, a, lda, ipiv, work, lwork, info)
         import :: wp
         integer, intent(in) :: n, lda, lwork
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(in) :: ipiv(*)
         real(wp), intent(out) :: work(*)
         integer, intent(out) :: info
      end subroutine dgetri

      !> Threads inside each routine of OpenBLAS
      subroutine openblas_set_num_threads(n) bind(c, name='openblas_set_num_threads')
         import :: c_int
         integer(c_int), value :: n
      end subroutine openblas_set_num_threads
   end interface

contains

   !> Cholesky factor of a band matrix in place
   subroutine band_cholesky(band, info)
      !> Lower band: band(1 + i - j, j) = a(i, j), shape (1 + half-bandwidth, n);
      !> the factor on return
      real(wp), intent(inout), contiguous :: band(:, :)
      !> Zero, or the order of the first minor that is not positive definite
      integer, intent(out) :: info

      call dpbtrf('L', size(band, 2), size(band, 1) - 1, band, size(band, 1), info)
   end subroutine band_cholesky

   !> Cholesky factor of a dense matrix in place
   subroutine cholesky(a, info)
      !> The matrix, only its lower triangle in use; the factor on return
      real(wp), intent(inout), contiguous :: a(:, :)
      !> Zero, or the order of the first minor that is not positive definite
      integer, intent(out) :: info

      call dpotrf('L', size(a, 2), a, max(1, size(a, 1)), info)
   end subroutine cholesky

   !> The whole symmetric inverse from a Cholesky factor, in place
   subroutine inverse_from_cholesky(a)
      !> The factor in the lower triangle, its diagonal without zeros; the inverse
      !> of its matrix on return
      real(wp), intent(inout), contiguous :: a(:, :)

      integer :: info, i

      call dpotri('L', size(a, 2), a, max(1, size(a, 1)), info)
      do i = 2, size(a, 2)
         a(:i - 1, i) = a(i, :i - 1)
      end do
   end subroutine inverse_from_cholesky

   !> Eigenvalues, ascending, and eigenvectors of a symmetric matrix
   subroutine symmetric_eigen(a, eigenvalue, info)
      !> The matrix; its eigenvectors by columns on return
      real(wp), intent(inout), contiguous :: a(:, :)
      !> The eigenvalues
      real(wp), intent(out), contiguous :: eigenvalue(:)
      !> Zero if they were found
      integer, intent(out) :: info

      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: n

      n = size(a, 1)
      allocate (work(1 + 6*n + 2*n**2), iwork(3 + 5*n))
      call dsyevd('V', 'L', n, a, n, eigenvalue, work, size(work), iwork, size(iwork), info)
   end subroutine symmetric_eigen

   !> Product of a matrix and a vector
   subroutine matrix_vector(a, x, y)
      !> The matrix, shape (m, n)
      real(wp), intent(in), contiguous :: a(:, :)
      !> The vector, n values in any shape
      real(wp), intent(in) :: x(*)
      !> The product, m values in any shape
      real(wp), intent(inout) :: y(*)

      call dgemv('N', size(a, 1), size(a, 2), 1.0_wp, a, max(1, size(a, 1)), x, 1, 0.0_wp, y, 1)
   end subroutine matrix_vector

   !> The lower triangle of a symmetric matrix, tile by tile, which the cache holds
   subroutine complete(matrix)
      !> The matrix, its upper triangle there
      real(wp), intent(inout) :: matrix(:, :)

      integer, parameter :: side = 64
      integer :: first, row, i, j

      do first = 1, size(matrix, 2), side
         do row = first, size(matrix, 1), side
            do j = first, min(first + side - 1, size(matrix, 2))
               do i = max(row, j + 1), min(row + side - 1, size(matrix, 1))
                  matrix(i, j) = matrix(j, i)
               end do
            end do
         end do
      end do
   end subroutine complete

   !> Singular values of a square matrix, descending, and its right singular vectors, one row each
   subroutine singular_values(a, values, rows)
      !> The matrix; lost on return
      real(wp), intent(inout), contiguous :: a(:, :)
      !> The values
      real(wp), intent(out) :: values(:)
      !> The vectors, shape of a
      real(wp), intent(out), contiguous :: rows(:, :)

      real(wp) :: none(1, 1), work(8*size(a, 1) + 64)
      integer :: info

      call dgesvd('N', 'A', size(a, 1), size(a, 1), a, size(a, 1), values, none, 1, rows, &
         size(a, 1), work, size(work), info)
   end subroutine singular_values

   !> Inverse of a matrix
   subroutine invert(a, info)
      !> The matrix, then its inverse
      real(wp), intent(inout), contiguous :: a(:, :)
      !> 0, or the place of a pivot that is zero
      integer, intent(out) :: info

      real(wp) :: work(32*size(a, 1))
      integer :: pivots(size(a, 1))

      info = 0
      if (size(a) == 0) return
      call dgetrf(size(a, 1), size(a, 1), a, size(a, 1), pivots, info)
      if (info /= 0) return
      call dgetri(size(a, 1), a, size(a, 1), pivots, work, size(work), info)
   end subroutine invert

   !> The x of least norm that makes |a x - b| least; columns of a that depend on
   !> others to twelve digits do not count
   subroutine least_squares(a, b, x)
      !> The matrix, shape (m, n), m >= n; lost on return
      real(wp), intent(inout), contiguous :: a(:, :)
      !> The right-hand side, shape (m)
      real(wp), intent(in) :: b(:)
      !> The solution, shape (n)
      real(wp), intent(out) :: x(:)

      real(wp), allocatable :: right(:, :), work(:)
      integer :: pivots(size(x)), rank, info, m, n

      m = size(a, 1)
      n = size(a, 2)
      right = reshape(b, [m, 1])
      pivots = 0
      allocate (work(64*(n + 1)))
      call dgelsy(m, n, 1, a, m, right, m, pivots, 1.0e-12_wp, rank, work, size(work), info)
      x = right(:n, 1)
   end subroutine least_squares

   !> Rate of large matrix products of one thread, measured: the best of some runs
   function product_rate() result(rate)
      !> Floating-point operations a second
      real(wp) :: rate

      integer, parameter :: n = 500, runs = 6
      real(wp), allocatable :: a(:, :), b(:, :), c(:, :)
      real(wp) :: start, finish
      integer :: k

      call use_one_blas_thread()
      allocate (a(n, n), b(n, n), source=1.0_wp)
      allocate (c(n, n), source=0.0_wp)
      rate = 0.0_wp
      do k = 1, runs
         call cpu_time(start)  ! one thread: other jobs do not count
         call dgemm('N', 'N', n, n, n, 1.0_wp, a, n, b, n, 0.0_wp, c, n)
         call cpu_time(finish)
         if (finish > start) rate = max(rate, 2.0_wp*real(n, wp)**3/(finish - start))
      end do
   end function product_rate

   !> Leave the threads to the harmonics: a routine that shares its work among
   !> threads would give other sums with other numbers of threads
   subroutine use_one_blas_thread()
      call openblas_set_num_threads(1_c_int)
   end subroutine use_one_blas_thread

end module axijoint_linalg_lapack
