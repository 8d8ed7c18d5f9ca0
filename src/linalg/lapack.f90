!> The LAPACK routines in use, with sizes taken from the arrays
module axijoint_linalg_lapack
   use, intrinsic :: iso_c_binding, only : c_int
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: band_cholesky, band_cholesky_solve, symmetric_eigen, use_one_blas_thread, norm_step, product_rate

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
      !> One step of Higham's estimate of a 1-norm
      subroutine dlacn2(n, v, x, isgn, est, kase, isave)
         import :: wp
         integer, intent(in) :: n
         real(wp), intent(inout) :: v(*), x(*), est
         integer, intent(inout) :: isgn(*), kase, isave(3)
      end subroutine dlacn2
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

   !> Solve with the factor of `band_cholesky`
   subroutine band_cholesky_solve(band, b)
      !> The factor
      real(wp), intent(in), contiguous :: band(:, :)
      !> Right-hand sides, then solutions, shape (n, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      integer :: info

      if (size(b) == 0) return
      call dpbtrs('L', size(band, 2), size(band, 1) - 1, size(b, 2), band, size(band, 1), &
                  b, size(b, 1), info)
   end subroutine band_cholesky_solve

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

   !> One step of the estimate of the 1-norm of an operator: the caller applies
   !> the operator to `x` and comes back until `kase` is zero (Higham, ACM Trans.
   !> Math. Software 14, 1988)
   subroutine norm_step(v, x, signs, estimate, kase, save)
      !> Work space and vector, shape (n)
      real(wp), intent(inout), contiguous :: v(:), x(:)
      !> Work space, shape (n)
      integer, intent(inout), contiguous :: signs(:)
      !> The estimate so far
      real(wp), intent(inout) :: estimate
      !> Zero at the first call; zero when done
      integer, intent(inout) :: kase
      !> Work space
      integer, intent(inout) :: save(3)

      call dlacn2(size(x), v, x, signs, estimate, kase, save)
   end subroutine norm_step

   !> Rate of large matrix products of one thread, measured: the best of some runs
   function product_rate() result(rate)
      !> Floating-point operations a second
      real(wp) :: rate

      integer, parameter :: n = 1000, runs = 4
      real(wp), allocatable :: a(:, :), b(:, :), c(:, :)
      integer(i8) :: start, finish, ticks
      integer :: k

      call use_one_blas_thread()
      allocate (a(n, n), b(n, n), source=1.0_wp)
      allocate (c(n, n), source=0.0_wp)
      rate = 0.0_wp
      do k = 1, runs
         call system_clock(start, ticks)
         call dgemm('N', 'N', n, n, n, 1.0_wp, a, n, b, n, 0.0_wp, c, n)
         call system_clock(finish)
         rate = max(rate, 2.0_wp*real(n, wp)**3*real(ticks, wp)/real(max(1_i8, finish - start), wp))
      end do
   end function product_rate

   !> Leave the threads to the harmonics: a routine that shares its work among
   !> threads would give other sums with other numbers of threads
   subroutine use_one_blas_thread()
      call openblas_set_num_threads(1_c_int)
   end subroutine use_one_blas_thread

end module axijoint_linalg_lapack
