!> Multifrontal sparse solver by MUMPS, sequential. Its licence is CeCILL-C. One thread may use it at a time
module axijoint_mumps_solver
   use, intrinsic :: iso_c_binding, only : c_ptr, c_null_ptr, c_associated, c_int32_t, c_int64_t, c_double
   use axijoint_base_error, only : error_type, fatal_error, exit_memory, exit_internal
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_text, only : to_text
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_order_orders, only : least_fill
   use axijoint_solver_entry, only : solver_entry_type, cost_type
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type, judge_pivots
   implicit none
   private
   public :: mumps_entry

   !> Codes of MUMPS for memory that cannot be had
   integer(c_int32_t), parameter :: no_memory(4) = [-5, -7, -13, -19]
   !> Share of the diagonal that is added to a singular matrix to find its freest unknown
   real(wp), parameter :: small_share = 1.0e-9_wp

   !> Plan: what an analysis of the pattern tells
   type, extends(solver_type) :: mumps_solver_type
   contains
      procedure :: analyse
      procedure :: factorize
   end type mumps_solver_type

   !> An instance of MUMPS with its factor
   type, extends(factor_type) :: mumps_factor_type
      !> Handle of the instance
      type(c_ptr), private :: handle = c_null_ptr
   contains
      procedure :: solve
      final :: free_factor
   end type mumps_factor_type

   interface
      !> Instance of MUMPS for a pattern; of use only if the code is zero
      function mumps_new(n, start, column, entries, operations, bytes, code) result(handle) &
         bind(c, name='axijoint_mumps_new')
         import :: c_ptr, c_int32_t, c_int64_t, c_double
         integer(c_int64_t), value :: n
         integer(c_int64_t), intent(in) :: start(*)
         integer(c_int32_t), intent(in) :: column(*)
         real(c_double), intent(out) :: entries, operations
         integer(c_int64_t), intent(out) :: bytes
         integer(c_int32_t), intent(out) :: code
         type(c_ptr) :: handle
      end function mumps_new
      !> Factor of a matrix with a share added to its diagonal, and its smallest pivot
      function mumps_factorize(handle, value, shift, smallest) result(code) &
         bind(c, name='axijoint_mumps_factorize')
         import :: c_ptr, c_int32_t, c_double
         type(c_ptr), value :: handle
         real(c_double), intent(in) :: value(*)
         real(c_double), value :: shift
         real(c_double), intent(out) :: smallest
         integer(c_int32_t) :: code
      end function mumps_factorize
      !> Solve in place
      function mumps_solve(handle, n_rhs, b) result(code) bind(c, name='axijoint_mumps_solve')
         import :: c_ptr, c_int32_t, c_int64_t, c_double
         type(c_ptr), value :: handle
         integer(c_int64_t), value :: n_rhs
         real(c_double), intent(inout) :: b(*)
         integer(c_int32_t) :: code
      end function mumps_solve
      !> End an instance
      subroutine mumps_free(handle) bind(c, name='axijoint_mumps_free')
         import :: c_ptr
         type(c_ptr), value :: handle
      end subroutine mumps_free
   end interface

contains

   !> MUMPS on a nested dissection order
   pure function mumps_entry() result(entry)
      !> The solver
      type(solver_entry_type) :: entry

      entry%name = 'MUMPS'
      entry%new_plan => new_plan
      entry%order => least_fill
      entry%order_name = 'nested dissection (METIS)'
      ! rough, after what MUMPS took as a peer (doc/benchmarks.md); AUTO does not go by it
      entry%cost = cost_type(share=0.5_wp, kept_entry=9.0e-9_wp, passing_entry=9.0e-9_wp, equation=2.0e-6_wp)
      entry%concurrent = .false.
      entry%note = 'MUMPS has the licence CeCILL-C and takes one thread: one harmonic after the other'
   end function mumps_entry

   !> An empty plan
   subroutine new_plan(plan)
      !> The plan
      class(solver_type), allocatable, intent(out) :: plan

      allocate (mumps_solver_type :: plan)
   end subroutine new_plan

   !> Analyse a pattern, for what it costs; every factor has an instance of its own
   subroutine analyse(self, pattern, error)
      !> The plan
      class(mumps_solver_type), intent(inout) :: self
      !> Pattern of the lower triangle
      type(symmetric_matrix_type), intent(in) :: pattern
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(c_ptr) :: handle
      real(c_double) :: entries
      integer(c_int32_t) :: code

      self%n = pattern%n
      if (self%n == 0) return  ! MUMPS refuses such a matrix
      handle = mumps_new(int(pattern%n, c_int64_t), pattern%row_start, pattern%column, entries, &
                         self%operations, self%factor_bytes, code)
      self%factor_entries = int(entries, i8)
      call mumps_free(handle)
      call report(code, error)
   end subroutine analyse

   !> Factor a matrix
   subroutine factorize(self, pattern, value, factor, pivots, error, passing)
      !> The plan
      class(mumps_solver_type), intent(in) :: self
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
      !> Not used: MUMPS takes its memory itself
      logical, intent(in), optional :: passing

      type(mumps_factor_type), allocatable :: new
      real(c_double) :: entries, operations, smallest
      integer(c_int64_t) :: bytes
      integer(c_int32_t) :: code

      allocate (new)
      new%n = self%n
      if (allocated(factor)) call take_instance(factor, new)
      code = 0
      if (self%n > 0 .and. .not. c_associated(new%handle)) then
         new%handle = mumps_new(int(self%n, c_int64_t), pattern%row_start, pattern%column, entries, operations, &
                                bytes, code)
      end if
      if (code == 0 .and. self%n > 0) then
         code = mumps_factorize(new%handle, value, 0.0_c_double, smallest)
         call judge_pivots([1.0_wp], [sqrt(max(0.0_wp, smallest))], pivots)
         if (code == 0 .and. pivots%equation > 0) call find_freest(new, value, pivots%equation, code)
      end if
      call report(code, error)
      if (.not. allocated(error)) call move_alloc(new, factor)
   end subroutine factorize

   !> Take the instance of a factor that is no longer needed
   subroutine take_instance(old, new)
      !> The factor, of the same plan; deallocated
      class(factor_type), allocatable, intent(inout) :: old
      !> Takes its handle
      type(mumps_factor_type), intent(inout) :: new

      select type (old)
      type is (mumps_factor_type)
         new%handle = old%handle
         old%handle = c_null_ptr
      end select
      deallocate (old)
   end subroutine take_instance

   !> Find the unknown that moves most where a matrix is singular: MUMPS does not tell where a pivot failed.
   !> The factor is of no use after that
   subroutine find_freest(factor, value, equation, code)
      !> The factor
      type(mumps_factor_type), intent(inout) :: factor
      !> Values of the matrix
      real(wp), intent(in), contiguous :: value(:)
      !> The equation
      integer, intent(inout) :: equation
      !> Code of MUMPS
      integer(c_int32_t), intent(out) :: code

      real(wp) :: load(factor%n, 1), smallest
      integer :: i

      code = mumps_factorize(factor%handle, value, small_share, smallest)
      if (code /= 0) return
      load(:, 1) = [(1.0_wp + 0.5_wp*sin(real(i, wp)), i=1, factor%n)]
      call factor%solve(load)
      equation = maxloc(abs(load(:, 1)), 1)
   end subroutine find_freest

   !> Solve for a block of right-hand sides
   subroutine solve(self, b)
      !> The factor
      class(mumps_factor_type), intent(in) :: self
      !> Right-hand sides, then solutions, shape (n, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      if (size(b) == 0) return
      if (mumps_solve(self%handle, size(b, 2, c_int64_t), b) /= 0) error stop 'out of memory: solution by MUMPS'
   end subroutine solve

   !> A code of MUMPS in words
   subroutine report(code, error)
      !> Zero if all is well
      integer(c_int32_t), intent(in) :: code
      !> The error
      type(error_type), allocatable, intent(out) :: error

      if (code == 0) return
      if (any(code == no_memory)) then
         call fatal_error(error, exit_memory, 'out of memory: a factor by MUMPS')
      else
         call fatal_error(error, exit_internal, 'MUMPS ended with code '//to_text(int(code)))
      end if
   end subroutine report

   !> End the instance
   subroutine free_factor(self)
      !> The factor
      type(mumps_factor_type), intent(inout) :: self

      call mumps_free(self%handle)
      self%handle = c_null_ptr
   end subroutine free_factor

end module axijoint_mumps_solver
