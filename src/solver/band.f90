!> Band Cholesky solver by LAPACK
module axijoint_solver_band
   use axijoint_base_error, only : error_type, memory_error
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : let_fail
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_linalg_band_solve, only : band_cholesky_solve
   use axijoint_linalg_lapack, only : band_cholesky
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_order_orders, only : least_bandwidth
   use axijoint_solver_entry, only : solver_entry_type, cost_type
   use axijoint_solver_trailing, only : trailing_factor_type
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type, judge_pivots
   implicit none
   private
   public :: band_solver_type, band_entry

   !> Plan: the half-bandwidth of the order that the matrix comes in
   type, extends(solver_type) :: band_solver_type
      !> Sub-diagonals
      integer :: half_bandwidth = 0
   contains
      procedure :: analyse
      procedure :: factorize
   end type band_solver_type

   !> Lower triangular band factor
   type, extends(trailing_factor_type) :: band_factor_type
      !> L(i, j) in band(1 + i - j, j)
      real(wp), allocatable :: band(:, :)
   contains
      procedure :: solve_trailing
   end type band_factor_type

contains

   !> LAPACK band Cholesky on a reverse Cuthill-McKee order
   pure function band_entry() result(entry)
      !> The solver
      type(solver_entry_type) :: entry

      entry%name = 'BAND'
      entry%new_plan => new_plan
      entry%order => least_bandwidth
      entry%order_name = 'reverse Cuthill-McKee'
      entry%cost = cost_type(share=0.83_wp, kept_entry=5.7e-9_wp, passing_entry=3.0e-9_wp, &
         equation=3.0e-7_wp)
   end function band_entry

   !> An empty plan
   subroutine new_plan(plan)
      !> The plan
      class(solver_type), allocatable, intent(out) :: plan

      allocate (band_solver_type :: plan)
   end subroutine new_plan

   !> Find the half-bandwidth
   subroutine analyse(self, pattern, error)
      !> The plan
      class(band_solver_type), intent(inout) :: self
      !> Pattern of the lower triangle
      type(symmetric_matrix_type), intent(in) :: pattern
      !> Never set: analysis needs no memory
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      self%n = pattern%n
      self%half_bandwidth = 0
      do i = 1, pattern%n  ! the first entry of a row is the farthest from the diagonal
         self%half_bandwidth = max(self%half_bandwidth, i - pattern%column(pattern%row_start(i)))
      end do
      self%factor_entries = int(self%half_bandwidth + 1, i8)*self%n
      self%factor_bytes = self%factor_entries*(storage_size(1.0_wp)/8)
      self%operations = real(self%n, wp)*self%half_bandwidth*(self%half_bandwidth + 3)
   end subroutine analyse

   !> Copy the matrix into a band and factor it
   subroutine factorize(self, pattern, value, factor, pivots, error, passing)
      !> The plan
      class(band_solver_type), intent(in) :: self
      !> The pattern analysed
      type(symmetric_matrix_type), intent(in) :: pattern
      !> Values of the matrix
      real(wp), intent(in), contiguous :: value(:)
      !> Its factor; one of this plan that is given is overwritten
      class(factor_type), allocatable, intent(inout) :: factor
      !> Pivots
      type(pivot_report_type), intent(out) :: pivots
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error
      !> Whether other factors will follow in the memory of this one
      logical, intent(in), optional :: passing

      type(band_factor_type), allocatable :: new
      real(wp) :: diagonal(self%n)
      integer(i8) :: k
      integer :: i, stat

      allocate (new)
      new%n = self%n
      stat = 0
      if (allocated(factor)) call take_memory(factor, new)
      if (.not. allocated(new%band)) then
         call let_fail(.true.)
         allocate (new%band(self%half_bandwidth + 1, self%n), stat=stat)
         call let_fail(.false.)
         if (present(passing) .and. stat == 0) then
            if (passing) call use_large_pages(new%band)
         end if
      end if
      if (stat /= 0) then
         call memory_error(error, 'a band factor needs', self%factor_bytes, 'bytes')
         return
      end if
      new%band = 0.0_wp
      do i = 1, self%n
         do k = pattern%row_start(i), pattern%row_start(i + 1) - 1
            new%band(1 + i - pattern%column(k), pattern%column(k)) = value(k)
         end do
      end do
      diagonal = new%band(1, :)
      call band_cholesky(new%band, pivots%equation)
      if (pivots%equation == 0) call judge_pivots(diagonal, new%band(1, :), pivots)
      call move_alloc(new, factor)
   end subroutine factorize

   !> Take the memory of a factor that is no longer needed
   subroutine take_memory(old, new)
      !> The factor, of the same plan; deallocated
      class(factor_type), allocatable, intent(inout) :: old
      !> Takes its array
      type(band_factor_type), intent(inout) :: new

      select type (old)
      type is (band_factor_type)
         call move_alloc(old%band, new%band)
      end select
      deallocate (old)
   end subroutine take_memory

   !> Solve with the rows and columns of the factor from one on
   subroutine solve_trailing(self, first, b)
      !> The factor
      class(band_factor_type), intent(in) :: self
      !> First row and column
      integer, intent(in) :: first
      !> Right-hand sides, then solutions, shape (n - first + 1, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      call band_cholesky_solve(self%band(:, first:), b)
   end subroutine solve_trailing

end module axijoint_solver_band
