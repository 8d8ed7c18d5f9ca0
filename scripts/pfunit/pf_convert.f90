!> Turns test files (.pf) into Fortran for the project's own test runner, and writes the driver
!!
!! Usage: `pf_convert own|pfunit DIRECTORY FILE.pf...`. With `own`, each FILE.pf becomes
!! DIRECTORY/FILE.f90: the module with its assertions expanded, and a module `FILE_suite` that
!! runs its tests. With `pfunit`, the files are only checked; pFUnit's own preprocessor converts
!! them. Both write the driver DIRECTORY/unit_tests.f90. A file whose content would not change
!! is left alone, so that nothing is compiled again. Errors go to stderr as FILE:LINE: text and
!! end the program with exit code 2.
program pf_convert
   use pf_files, only : lf, read_line, write_if_changed, base_name, lower_case, text_of, stop_with
   use pf_sources, only : suite_type, suite_module, own_driver, pfunit_driver
   implicit none

   ! pFUnit's assertions and their counterparts here
   character(len=*), parameter :: assertions(2, 11) = reshape([character(len=28) :: &
      'asserttrue', 'assert_true', 'assertfalse', 'assert_false', 'assertfail', 'assert_fail', &
      'assertequal', 'assert_equal', 'assertrelativelyequal', 'assert_relatively_equal', &
      'assertlessthan', 'assert_less_than', &
      'assertlessthanorequal', 'assert_less_than_or_equal', &
      'assertgreaterthan', 'assert_greater_than', &
      'assertgreaterthanorequal', 'assert_greater_than_or_equal', &
      'assertisnan', 'assert_is_nan', 'assertisfinite', 'assert_is_finite'], [2, 11])

   character(len=:), allocatable :: mode, directory
   type(suite_type), allocatable :: suites(:)
   integer :: i, j

   if (command_argument_count() < 3) &
      call stop_with('usage: pf_convert own|pfunit DIRECTORY FILE.pf...')
   mode = argument(1)
   if (mode /= 'own' .and. mode /= 'pfunit') call stop_with('pf_convert: no such mode: '//mode)
   directory = argument(2)
   allocate (suites(command_argument_count() - 2))
   do i = 1, size(suites)
      suites(i)%file = argument(i + 2)
      call convert(suites(i))
      if (any([(suites(j)%name == suites(i)%name, j=1, i - 1)])) &
         call stop_with(suites(i)%file//': two test files have this name')
      if (mode == 'own') then
         call write_if_changed(directory//'/'//suites(i)%name//'.f90', &
            suites(i)%text//suite_module(suites(i)))
      end if
   end do
   if (mode == 'own') then
      call write_if_changed(directory//'/unit_tests.f90', own_driver(suites))
   else
      call write_if_changed(directory//'/unit_tests.f90', pfunit_driver(suites))
   end if

contains

   !> Convert one file
   subroutine convert(suite)
      !> The suite; its file is given
      type(suite_type), intent(inout) :: suite
      character(len=:), allocatable :: line
      integer :: unit, status, number
      logical :: last

      suite%name = base_name(suite%file)
      suite%text = '! Made from '//suite%file//lf//'# 1 "'//suite%file//'"'//lf
      suite%calls = ''
      suite%uses = ''
      suite%before = ''
      suite%after = ''
      suite%pending = ''
      open (newunit=unit, file=suite%file, status='old', action='read', iostat=status)
      if (status /= 0) call stop_with(suite%file//': cannot be read')
      number = 0
      do
         call read_line(unit, line, last)
         if (last .and. len(line) == 0) exit
         number = number + 1
         call convert_line(suite, line, number)
      end do
      close (unit)
      if (len(suite%pending) > 0) &
         call complain(suite, number, '@'//suite%pending//' without a subroutine')
      if (.not. suite%has_module) &
         call complain(suite, number, 'module '//suite%name//' is missing')
      if (suite%tests == 0) call complain(suite, number, 'no @test in this file')
   end subroutine convert

   !> Convert one line
   subroutine convert_line(suite, line, number)
      !> The suite
      type(suite_type), intent(inout) :: suite
      !> The line
      character(len=*), intent(in) :: line
      !> Its number, from one
      integer, intent(in) :: number
      character(len=:), allocatable :: statement, lower

      statement = trim(adjustl(line))
      lower = lower_case(statement)
      if (len(statement) == 0 .or. index(statement, '!') == 1) then
         suite%text = suite%text//line//lf
         return
      end if
      if (statement(1:1) == '@') then
         if (suite%continued) call complain(suite, number, statement//' stands inside a statement')
         call convert_directive(suite, line, number)
         return
      end if
      suite%continued = statement(len(statement):) == '&'
      if (len(suite%pending) > 0) then
         call take_procedure(suite, statement, number)
      else if (index(lower, 'module ') == 1 .and. index(lower, 'module procedure') /= 1) then
         if (lower(8:) /= lower_case(suite%name)) &
            call complain(suite, number, 'the module must be named '//suite%name//' like the file')
         suite%has_module = .true.
      else if (lower == 'use funit' .or. lower == 'use pfunit') then
         suite%text = suite%text//'   use axijoint_test_assertions'//lf
         return
      else if (index(lower, 'use funit') == 1) then
         call complain(suite, number, 'write `use funit` alone: assertions expand to names of it')
      end if
      suite%text = suite%text//line//lf
   end subroutine convert_line

   !> Convert a line that starts with @
   subroutine convert_directive(suite, line, number)
      !> The suite
      type(suite_type), intent(inout) :: suite
      !> The line
      character(len=*), intent(in) :: line
      !> Its number, from one
      integer, intent(in) :: number
      character(len=:), allocatable :: directive

      directive = lower_case(trim(adjustl(line)))
      select case (directive)
      case ('@test', '@before', '@after')
         if (len(suite%pending) > 0) &
            call complain(suite, number, '@'//suite%pending//' still waits for its subroutine')
         suite%pending = directive(2:)
         suite%disabled = .false.
         suite%text = suite%text//'!'//line//lf
      case ('@disable')
         if (suite%pending /= 'test') call complain(suite, number, '@disable goes after @test')
         suite%disabled = .true.
         suite%text = suite%text//'!'//line//lf
      case default
         call convert_assertion(suite, line, number)
      end select
   end subroutine convert_directive

   !> Expand an assertion to a call that is followed by a return if it failed
   subroutine convert_assertion(suite, line, number)
      !> The suite
      type(suite_type), intent(inout) :: suite
      !> The line
      character(len=*), intent(in) :: line
      !> Its number, from one
      integer, intent(in) :: number
      character(len=:), allocatable :: statement, arguments
      integer :: parenthesis, k

      if (len(suite%pending) > 0) &
         call complain(suite, number, '@'//suite%pending//' still waits for its subroutine')
      statement = trim(adjustl(line))
      parenthesis = index(statement, '(')
      if (parenthesis == 0) call complain(suite, number, 'unknown directive '//statement)
      k = findloc(assertions(1, :), lower_case(trim(statement(2:parenthesis - 1))), dim=1)
      if (k == 0) call complain(suite, number, 'unknown directive '//statement(:parenthesis - 1))
      if (statement(len(statement):) /= ')') call complain(suite, number, &
         'an assertion stands on one line and ends with its parenthesis')
      arguments = trim(adjustl(statement(parenthesis + 1:len(statement) - 1)))
      if (len(arguments) == 0) call complain(suite, number, 'the assertion has no arguments')
      suite%text = suite%text//'      call '//trim(assertions(2, k))//'( &'//lf &
         //'# '//text_of(number)//' "'//suite%file//'"'//lf//arguments//', &'//lf &
         //'         location=source_location('''//suite%file//''', '//text_of(number)//'))'//lf &
         //'      if (any_failures()) return'//lf &
         //'# '//text_of(number + 1)//' "'//suite%file//'"'//lf
   end subroutine convert_assertion

   !> Take the subroutine that a directive waits for
   subroutine take_procedure(suite, statement, number)
      !> The suite
      type(suite_type), intent(inout) :: suite
      !> The statement after the directive
      character(len=*), intent(in) :: statement
      !> Its line number, from one
      integer, intent(in) :: number
      character(len=:), allocatable :: name, rest
      integer :: length

      if (index(lower_case(statement), 'subroutine ') /= 1) &
         call complain(suite, number, '@'//suite%pending//' must stand before its subroutine')
      rest = trim(adjustl(statement(12:)))
      length = verify(lower_case(rest)//' ', 'abcdefghijklmnopqrstuvwxyz0123456789_') - 1
      name = rest(:length)
      rest = trim(adjustl(rest(length + 1:)))
      if (rest /= '' .and. rest /= '()') &
         call complain(suite, number, name//' must have no arguments')
      select case (suite%pending)
      case ('before')
         suite%before = name
      case ('after')
         suite%after = name
      case ('test')
         call add_test(suite, name)
      end select
      suite%pending = ''
   end subroutine take_procedure

   !> Note a test
   subroutine add_test(suite, name)
      !> The suite
      type(suite_type), intent(inout) :: suite
      !> Name of the test's procedure
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: number

      suite%tests = suite%tests + 1
      number = text_of(suite%tests)
      if (suite%disabled) then
         suite%calls = suite%calls//'      call run%disabled('''//name//''')'//lf
         return
      end if
      suite%uses = suite%uses//'   use '//suite%name//', only : test_'//number//' => '//name//lf
      ! The fixtures may come after the tests: their arguments are filled in at the end
      suite%calls = suite%calls//'      call run%test('''//name//''', test_'//number//'#)'//lf
   end subroutine add_test

   !> An argument of the program
   function argument(position) result(text)
      !> Its place, from one
      integer, intent(in) :: position
      !> Its text
      character(len=:), allocatable :: text
      integer :: length

      call get_command_argument(position, length=length)
      allocate (character(len=length) :: text)
      call get_command_argument(position, text)
   end function argument

   !> Report an error in a test file and stop
   subroutine complain(suite, number, text)
      !> The suite
      type(suite_type), intent(in) :: suite
      !> Line number, from one
      integer, intent(in) :: number
      !> What is wrong
      character(len=*), intent(in) :: text

      call stop_with(suite%file//':'//text_of(number)//': '//text)
   end subroutine complain

end program pf_convert
