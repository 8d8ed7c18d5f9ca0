!> Runs the tests of one suite and keeps records of it
!!
!! A suite runs in a process of its own, so that a crash costs one test. The process is told
!! `SUITE FIRST RECORDS`: the suite, the number of the first test to run (from one) and a file
!! that gets a line before each test (`begin NUMBER NAME`), one after it (`passed`, `failed` or
!! `disabled`) and a last line `end`. Whoever reads it sees from a missing `end` that the process
!! died, and in which test. Without FIRST and RECORDS all tests run and nothing is recorded.
module axijoint_test_runner
   use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
   use axijoint_test_failures, only : any_failures, take_failures
   implicit none
   private
   public :: test_run, test_procedure

   ! A unit that `newunit` never gives
   integer, parameter :: no_unit = -1

   abstract interface
      !> A test or what goes before and after it
      subroutine test_procedure()
      end subroutine test_procedure
   end interface

   !> One run of one suite
   type :: test_run
      !> Name of the suite
      character(len=:), allocatable :: suite
      !> Number of the first test to run
      integer :: first = 1
      !> Number of the test at hand
      integer :: number = 0
      !> Tests that failed
      integer :: failed = 0
      !> Unit of the records
      integer :: records = no_unit
   contains
      !> Read the arguments of the process and open the records
      procedure :: open => open_run
      !> Run one test
      procedure :: test => run_test
      !> Pass over a test that is disabled
      procedure :: disabled => skip_test
      !> The suite asked for does not exist
      procedure :: unknown => unknown_suite
      !> End the run
      procedure :: close => close_run
      procedure, private :: record
   end type test_run

contains

   !> Read the arguments of the process and open the records
   subroutine open_run(self)
      !> The run
      class(test_run), intent(inout) :: self
      character(len=4096) :: argument
      integer :: status

      call get_command_argument(1, argument)
      self%suite = trim(argument)
      if (command_argument_count() < 3) return
      call get_command_argument(2, argument)
      read (argument, *, iostat=status) self%first
      if (status /= 0) error stop 'usage: SUITE [FIRST RECORDS]'
      call get_command_argument(3, argument)
      open (newunit=self%records, file=trim(argument), status='replace', action='write')
   end subroutine open_run

   !> Run one test
   subroutine run_test(self, name, test, set_up, tear_down)
      !> The run
      class(test_run), intent(inout) :: self
      !> Name of the test
      character(len=*), intent(in) :: name
      !> The test
      procedure(test_procedure) :: test
      !> Runs before it
      procedure(test_procedure), optional :: set_up
      !> Runs after it, even if the test failed
      procedure(test_procedure), optional :: tear_down
      character(len=:), allocatable :: report

      self%number = self%number + 1
      if (self%number < self%first) return
      call self%record('begin', name)
      if (present(set_up)) call set_up()
      if (.not. any_failures()) call test()
      if (present(tear_down)) call tear_down()
      call take_failures(report)
      if (len(report) > 0) then
         self%failed = self%failed + 1
         write (output_unit, '(a)') 'FAILED '//self%suite//' '//name, report
         flush (output_unit)
         call self%record('failed', name)
      else
         call self%record('passed', name)
      end if
   end subroutine run_test

   !> Pass over a test that is disabled
   subroutine skip_test(self, name)
      !> The run
      class(test_run), intent(inout) :: self
      !> Name of the test
      character(len=*), intent(in) :: name

      self%number = self%number + 1
      if (self%number < self%first) return
      call self%record('disabled', name)
   end subroutine skip_test

   !> The suite asked for does not exist
   subroutine unknown_suite(self)
      !> The run
      class(test_run), intent(in) :: self

      write (error_unit, '(a)') 'no such test module: "'//self%suite//'"'
      stop 2, quiet=.true.
   end subroutine unknown_suite

   !> End the run; the exit status tells whether a test failed
   subroutine close_run(self)
      !> The run
      class(test_run), intent(inout) :: self

      call self%record('end', self%suite)
      if (self%records /= no_unit) close (self%records)
      if (self%failed > 0) stop 1, quiet=.true.
   end subroutine close_run

   !> Write a record, at once: the process may die in the next moment
   subroutine record(self, event, name)
      !> The run
      class(test_run), intent(in) :: self
      !> begin, passed, failed, disabled or end
      character(len=*), intent(in) :: event
      !> Name of the test
      character(len=*), intent(in) :: name

      if (self%records == no_unit) return
      write (self%records, '(a,1x,i0,1x,a)') event, self%number, name
      flush (self%records)
   end subroutine record

end module axijoint_test_runner
