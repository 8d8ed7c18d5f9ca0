!> Where an assertion stands, and what failed in the test that is running
module axijoint_test_failures
   implicit none
   private
   public :: source_location, record_failure, any_failures, take_failures

   !> Place of an assertion in a test file
   type :: source_location
      !> Path of the test file
      character(len=:), allocatable :: file
      !> Line in it, from one
      integer :: line = 0
   end type source_location

   ! The one variable with a life of its own: an assertion inside a helper procedure
   ! must end the test too, and a test procedure has no arguments to carry the news.
   character(len=:), allocatable, save :: recorded

contains

   !> Keep a failure for the report; the caller returns right after
   subroutine record_failure(text, message, location)
      !> What was expected and found, one or several lines
      character(len=*), intent(in) :: text
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location
      character(len=:), allocatable :: report
      character(len=12) :: line

      report = ''
      if (present(location)) then
         write (line, '(i0)') location%line
         report = location%file//':'//trim(line)//': '
      end if
      report = report//text
      if (present(message)) report = report//new_line('a')//'  message:  '//message
      if (allocated(recorded)) report = recorded//new_line('a')//report
      recorded = report
   end subroutine record_failure

   !> Did an assertion fail since the last `take_failures`?
   function any_failures() result(failed)
      !> True if so
      logical :: failed

      failed = allocated(recorded)
   end function any_failures

   !> Hand over the failures and forget them
   subroutine take_failures(text)
      !> The report, empty if nothing failed
      character(len=:), allocatable, intent(out) :: text

      text = ''
      if (.not. allocated(recorded)) return
      call move_alloc(recorded, text)
   end subroutine take_failures

end module axijoint_test_failures
