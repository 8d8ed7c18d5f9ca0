!> Factors by MUMPS against those by the band solver: solutions, flexibilities, pivots
program factors
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_linalg_symmetric_half, only : symmetric_half_type
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type
   use axijoint_mumps_solver, only : mumps_entry
   use axijoint_solver_band, only : band_entry
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_type, only : solver_type, factor_type, pivot_report_type
   implicit none

   !> Masses of the chain, and what solutions may differ by, relative
   integer, parameter :: n = 300
   real(wp), parameter :: close = 1.0e-10_wp
   integer :: passed, failed

   passed = 0
   failed = 0
   call compare(1.0_wp, 'a chain')
   call compare(1.0e-6_wp, 'a soft chain')
   call expect(failing(0.0_wp) > 0, 'a free chain is singular')
   call expect(failing(-10.0_wp) > 0, 'a negative pivot is found')
   write (output_unit, '(i0, a, i0, a)') passed, ' passed, ', failed, ' failed'
   if (failed > 0) stop 1, quiet=.true.

contains

   !> Chain of springs of stiffness 1 with a second one across two masses, held by a spring at its first mass
   function chain(ground) result(matrix)
      !> Stiffness of that spring
      real(wp), intent(in) :: ground
      !> The matrix
      type(symmetric_matrix_type) :: matrix

      integer :: i, j, k

      matrix%n = n
      allocate (matrix%row_start(n + 1), matrix%column(3*n), matrix%value(3*n))
      k = 0
      do i = 1, n
         matrix%row_start(i) = k + 1
         do j = max(1, i - 2), i
            k = k + 1
            matrix%column(k) = j
            matrix%value(k) = -1.0_wp
            if (i == j) matrix%value(k) = min(i - 1, 2) + min(n - i, 2)
         end do
      end do
      matrix%row_start(n + 1) = k + 1
      matrix%value(1) = matrix%value(1) + ground
      matrix%column = matrix%column(:k)
      matrix%value = matrix%value(:k)
   end function chain

   !> Factor a matrix twice, the second time in used memory
   subroutine factor_with(entry, matrix, factor, pivots)
      !> The solver
      type(solver_entry_type), intent(in) :: entry
      !> The matrix
      type(symmetric_matrix_type), intent(in) :: matrix
      !> Its factor
      class(factor_type), allocatable, intent(out) :: factor
      !> Pivots
      type(pivot_report_type), intent(out) :: pivots

      class(solver_type), allocatable :: plan
      type(error_type), allocatable :: error

      call entry%new_plan(plan)
      call plan%analyse(matrix, error)
      if (.not. allocated(error)) call plan%factorize(matrix, 3.0_wp*matrix%value, factor, pivots, error)
      if (.not. allocated(error)) call plan%factorize(matrix, matrix%value, factor, pivots, error)
      call expect(.not. allocated(error), 'factorization by '//entry%name)
   end subroutine factor_with

   !> Compare both solvers on a chain
   subroutine compare(ground, name)
      !> Stiffness of the spring at its first mass
      real(wp), intent(in) :: ground
      !> What it is
      character(len=*), intent(in) :: name

      integer, parameter :: pairs(2, 4) = reshape([290, 290, 3, 4, 111, 112, 112, 7], [2, 4])
      real(wp), parameter :: factors(2, 4) = reshape([1.0_wp, 0.0_wp, -1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp, 2.0_wp, 1.0_wp], [2, 4])
      class(factor_type), allocatable :: one, other
      type(pivot_report_type) :: pivots(2)
      type(error_type), allocatable :: error
      real(wp) :: x(n, 3), y(n, 3)
      type(symmetric_half_type) :: room
      type(symmetric_half_type), allocatable :: a, b
      integer :: i

      call factor_with(band_entry(), chain(ground), one, pivots(1))
      call factor_with(mumps_entry(), chain(ground), other, pivots(2))
      x = reshape([(sin(2.0_wp*i), i=1, 3*n)], [n, 3])
      y = x
      call one%solve(x)
      call other%solve(y)
      call expect(maxval(abs(x - y)) <= close*maxval(abs(x))/ground, name//': solutions')
      call one%flexibility(pairs, factors, room, a, error)
      call other%flexibility(pairs, factors, room, b, error)
      call expect(maxval(abs(a%values - b%values)) <= close*maxval(abs(a%values))/ground, name//': flexibilities')
      call expect(all(pivots%equation == 0), name//': no pivot fails')
      ! MUMPS orders the unknowns of a front itself, so the pivots are not the same numbers
      call expect(abs(log(pivots(1)%smallest/pivots(2)%smallest)) < log(2.0_wp), name//': smallest pivot')
   end subroutine compare

   !> Equation of a pivot that fails
   integer function failing(ground)
      !> Stiffness of the spring at the first mass
      real(wp), intent(in) :: ground

      class(factor_type), allocatable :: factor
      type(pivot_report_type) :: pivots

      call factor_with(mumps_entry(), chain(ground), factor, pivots)
      failing = pivots%equation
   end function failing

   !> Count a fact
   subroutine expect(fact, name)
      !> Whether it is one
      logical, intent(in) :: fact
      !> What it is
      character(len=*), intent(in) :: name

      passed = passed + merge(1, 0, fact)
      failed = failed + merge(0, 1, fact)
      if (.not. fact) write (output_unit, '(a)') 'FAILED: '//name
   end subroutine expect

end program factors
