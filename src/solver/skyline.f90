!> Skyline (active row) Cholesky solver, the solver of the tradition
module axijoint_solver_skyline
   use axijoint_base_error, only : error_type, memory_error
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : let_fail
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_order_orders, only : least_profile
   use axijoint_solver_entry, only : solver_entry_type, cost_type
   use axijoint_solver_trailing, only : trailing_factor_type
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type, judge_pivots
   implicit none
   private
   public :: skyline_solver_type, skyline_entry

   !> Plan: the skyline of the order that the matrix comes in
   type, extends(solver_type) :: skyline_solver_type
      !> First column of each row that is not zero
      integer, allocatable :: first(:)
      !> Place of each row's diagonal in the skyline
      integer(i8), allocatable :: diagonal(:)
   contains
      procedure :: analyse
      procedure :: factorize
   end type skyline_solver_type

   !> Lower triangular factor, row by row from the first column to the diagonal
   type, extends(trailing_factor_type) :: skyline_factor_type
      !> First column of each row
      integer, allocatable :: first(:)
      !> Place of each row's diagonal in `entry`
      integer(i8), allocatable :: diagonal(:)
      !> Entries of the rows
      real(wp), allocatable :: entry(:)
   contains
      procedure :: solve_trailing
   end type skyline_factor_type

contains

   !> Skyline Cholesky on Sloan's order, or reverse Cuthill-McKee if smaller
   pure function skyline_entry() result(entry)
      !> The solver
      type(solver_entry_type) :: entry

      entry%name = 'SKYLINE'
      entry%new_plan => new_plan
      entry%order => least_profile
      entry%order_name = 'Sloan or Cuthill-McKee'
      entry%cost = cost_type(share=0.14_wp, equation=3.0e-7_wp)
   end function skyline_entry

   !> An empty plan
   subroutine new_plan(plan)
      !> The plan
      class(solver_type), allocatable, intent(out) :: plan

      allocate (skyline_solver_type :: plan)
   end subroutine new_plan

   !> Find the skyline
   subroutine analyse(self, pattern, error)
      !> The plan
      class(skyline_solver_type), intent(inout) :: self
      !> Pattern of the lower triangle
      type(symmetric_matrix_type), intent(in) :: pattern
      !> Never set: analysis needs no memory to speak of
      type(error_type), allocatable, intent(out) :: error

      integer(i8) :: width
      integer :: i

      self%n = pattern%n
      self%first = pattern%column(pattern%row_start(:pattern%n))
      if (allocated(self%diagonal)) deallocate (self%diagonal)
      allocate (self%diagonal(pattern%n))
      self%factor_entries = 0
      self%operations = 0.0_wp
      do i = 1, pattern%n
         width = i - self%first(i) + 1
         self%factor_entries = self%factor_entries + width
         self%diagonal(i) = self%factor_entries
         self%operations = self%operations + real(width, wp)**2
      end do
      self%factor_bytes = self%factor_entries*(storage_size(1.0_wp)/8)
   end subroutine analyse

   !> Copy the matrix into the skyline and factor it row by row:
   !> l_ij = (a_ij - sum_k l_ik l_jk)/l_jj
   subroutine factorize(self, pattern, value, factor, pivots, error, passing)
      !> The plan
      class(skyline_solver_type), intent(in) :: self
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

      type(skyline_factor_type), allocatable :: new
      integer(i8) :: k
      integer :: i, stat

      allocate (new)
      stat = 0
      if (allocated(factor)) call take_memory(factor, new)
      if (.not. allocated(new%entry)) then
         call let_fail(.true.)
         allocate (new%entry(self%factor_entries), stat=stat)
         call let_fail(.false.)
         if (present(passing) .and. stat == 0) then
            if (passing) call use_large_pages(new%entry)
         end if
      end if
      if (stat /= 0) then
         call memory_error(error, 'a skyline factor needs', self%factor_bytes, 'bytes')
         return
      end if
      new%n = self%n
      new%first = self%first
      new%diagonal = self%diagonal
      new%entry = 0.0_wp
      do i = 1, self%n
         do k = pattern%row_start(i), pattern%row_start(i + 1) - 1
            new%entry(self%diagonal(i) - i + pattern%column(k)) = value(k)
         end do
      end do
      do i = 1, self%n
         call factor_row(new, i, pivots%equation)
         if (pivots%equation > 0) exit
      end do
      if (pivots%equation == 0) then
         call judge_pivots(value(pattern%row_start(2:) - 1), new%entry(new%diagonal), pivots)
      end if
      call move_alloc(new, factor)
   end subroutine factorize

   !> Take the memory of a factor that is no longer needed
   subroutine take_memory(old, new)
      !> The factor, of the same plan; deallocated
      class(factor_type), allocatable, intent(inout) :: old
      !> Takes its array
      type(skyline_factor_type), intent(inout) :: new

      select type (old)
      type is (skyline_factor_type)
         call move_alloc(old%entry, new%entry)
      end select
      deallocate (old)
   end subroutine take_memory

   !> Factor one row; the rows before are done
   pure subroutine factor_row(factor, i, failed)
      !> The factor
      type(skyline_factor_type), intent(inout) :: factor
      !> The row
      integer, intent(in) :: i
      !> The row if its pivot is not positive
      integer, intent(inout) :: failed

      integer(i8) :: row, other
      integer :: j, from

      associate (l => factor%entry)
         row = factor%diagonal(i) - i
         do j = factor%first(i), i - 1
            other = factor%diagonal(j) - j
            from = max(factor%first(i), factor%first(j))
            l(row + j) = (l(row + j) - dot_product(l(row + from:row + j - 1), &
                                                   l(other + from:other + j - 1)))/l(other + j)
         end do
         l(row + i) = l(row + i) - sum(l(row + factor%first(i):row + i - 1)**2)
         if (.not. l(row + i) > 0.0_wp) then
            failed = i
         else
            l(row + i) = sqrt(l(row + i))
         end if
      end associate
   end subroutine factor_row

   !> Solve with the rows and columns of the factor from one on
   subroutine solve_trailing(self, first, b)
      !> The factor
      class(skyline_factor_type), intent(in) :: self
      !> First row and column
      integer, intent(in) :: first
      !> Right-hand sides, then solutions, shape (n - first + 1, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      integer(i8) :: row
      integer :: i, k, from, above

      above = first - 1  ! rows that `b` leaves out
      do i = first, self%n
         row = self%diagonal(i) - i
         from = max(self%first(i), first)
         do k = 1, size(b, 2)
            b(i - above, k) = (b(i - above, k) - dot_product(self%entry(row + from:row + i - 1), &
                                                             b(from - above:i - 1 - above, k))) &
               /self%entry(row + i)
         end do
      end do
      do i = self%n, first, -1
         row = self%diagonal(i) - i
         from = max(self%first(i), first)
         do k = 1, size(b, 2)
            b(i - above, k) = b(i - above, k)/self%entry(row + i)
            b(from - above:i - 1 - above, k) = b(from - above:i - 1 - above, k) &
               - b(i - above, k)*self%entry(row + from:row + i - 1)
         end do
      end do
   end subroutine solve_trailing

end module axijoint_solver_skyline
