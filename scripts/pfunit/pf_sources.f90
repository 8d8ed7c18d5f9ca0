!> The sources that the converter of test files writes: suites and drivers
module pf_sources
   use pf_files, only : lf, text_of
   implicit none
   private
   public :: suite_type, suite_module, own_driver, pfunit_driver

   !> What is known about the test file so far
   type :: suite_type
      !> Path of the file
      character(len=:), allocatable :: file
      !> Its name without directory and extension, also that of the module
      character(len=:), allocatable :: name
      !> The module, converted
      character(len=:), allocatable :: text
      !> Calls that run the tests
      character(len=:), allocatable :: calls
      !> Use statements for the tests
      character(len=:), allocatable :: uses
      !> Number of tests
      integer :: tests = 0
      !> Procedure to run before each test
      character(len=:), allocatable :: before
      !> Procedure to run after each test
      character(len=:), allocatable :: after
      !> Directive that waits for its subroutine: test, before, after or empty
      character(len=:), allocatable :: pending
      !> The waiting test is disabled
      logical :: disabled = .false.
      !> The name of the module was right
      logical :: has_module = .false.
      !> The last statement goes on in the next line
      logical :: continued = .false.
   end type suite_type

contains

   !> The module that runs the tests of a suite
   function suite_module(suite) result(text)
      !> The suite
      type(suite_type), intent(in) :: suite
      !> Its source
      character(len=:), allocatable :: text
      character(len=:), allocatable :: uses, fixtures, calls
      integer :: k

      uses = suite%uses
      fixtures = ''
      if (len(suite%before) > 0) then
         uses = uses//'   use '//suite%name//', only : set_up => '//suite%before//lf
         fixtures = ', set_up=set_up'
      end if
      if (len(suite%after) > 0) then
         uses = uses//'   use '//suite%name//', only : tear_down => '//suite%after//lf
         fixtures = fixtures//', tear_down=tear_down'
      end if
      calls = suite%calls
      do
         k = index(calls, '#')
         if (k == 0) exit
         calls = calls(:k - 1)//fixtures//calls(k + 1:)
      end do
      text = lf//'module '//suite%name//'_suite'//lf//'   use axijoint_test_runner, only : test_run'//lf &
         //uses//'   implicit none'//lf//'   private'//lf//'   public :: run_suite'//lf//lf &
         //'contains'//lf//lf//'   subroutine run_suite(run)'//lf &
         //'      type(test_run), intent(inout) :: run'//lf//lf//calls &
         //'   end subroutine run_suite'//lf//lf//'end module '//suite%name//'_suite'//lf
   end function suite_module

   !> The driver that runs one suite by the project's own runner
   function own_driver(suites) result(text)
      !> All suites
      type(suite_type), intent(in) :: suites(:)
      !> Its source
      character(len=:), allocatable :: text
      integer :: k

      text = 'program unit_tests'//lf//'   use axijoint_test_runner, only : test_run'//lf
      do k = 1, size(suites)
         text = text//'   use '//suites(k)%name//'_suite, only : run_'//text_of(k) &
            //' => run_suite'//lf
      end do
      text = text//'   implicit none'//lf//'   type(test_run) :: run'//lf//lf &
         //'   call run%open()'//lf//'   select case (run%suite)'//lf
      do k = 1, size(suites)
         text = text//'   case ('''//suites(k)%name//''')'//lf &
            //'      call run_'//text_of(k)//'(run)'//lf
      end do
      text = text//'   case default'//lf//'      call run%unknown()'//lf//'   end select'//lf &
         //'   call run%close()'//lf//'end program unit_tests'//lf
   end function own_driver

   !> The driver that runs one suite by pFUnit; its records are one line of counts and `end`
   function pfunit_driver(suites) result(text)
      !> All suites
      type(suite_type), intent(in) :: suites(:)
      !> Its source
      character(len=:), allocatable :: text
      integer :: k

      text = 'program unit_tests'//lf &
         //'   use, intrinsic :: iso_fortran_env, only : output_unit'//lf &
         //'   use funit, only : TestSuite, TestRunner, TestResult, SerialContext, &'//lf &
         //'      ResultPrinter'//lf
      do k = 1, size(suites)
         text = text//'   use '//suites(k)%name//', only :'//lf
      end do
      text = text//'   implicit none'//lf//'   type(TestSuite) :: suite'//lf &
         //'   type(TestRunner) :: runner'//lf//'   type(TestResult) :: results'//lf &
         //'   character(len=4096) :: name, records'//lf//'   integer :: unit, failed'//lf &
         //'   interface'//lf
      do k = 1, size(suites)
         text = text//'      function '//suites(k)%name//'_suite() result(suite)'//lf &
            //'         use funit, only : TestSuite'//lf//'         type(TestSuite) :: suite'//lf &
            //'      end function '//suites(k)%name//'_suite'//lf
      end do
      text = text//'   end interface'//lf//lf//'   call get_command_argument(1, name)'//lf &
         //'   call get_command_argument(3, records)'//lf//'   select case (name)'//lf
      do k = 1, size(suites)
         text = text//'   case ('''//suites(k)%name//''')'//lf &
            //'      suite = '//suites(k)%name//'_suite()'//lf
      end do
      text = text//'   case default'//lf//'      error stop ''no such test module'''//lf &
         //'   end select'//lf &
         //'   runner = TestRunner(ResultPrinter(output_unit))'//lf &
         //'   results = runner%run(suite, SerialContext())'//lf &
         //'   failed = results%failureCount() + results%errorCount()'//lf &
         //'   open (newunit=unit, file=trim(records), status=''replace'', action=''write'')'//lf &
         //'   write (unit, ''(a,3(1x,i0))'') ''counts'', &'//lf &
         //'      results%runCount() - failed, failed, results%disableCount()'//lf &
         //'   write (unit, ''(a)'') ''end'''//lf &
         //'   close (unit)'//lf//'end program unit_tests'//lf
   end function pfunit_driver

end module pf_sources
