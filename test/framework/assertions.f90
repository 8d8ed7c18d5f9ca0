!> The assertions of the unit tests, with the arguments and the meaning that pFUnit gives them
!!
!! A failed assertion leaves a report in `axijoint_test_failures`; the converter puts a return
!! after each assertion of a test. Comparisons never subtract or order a NaN, since the checked
!! build traps on it: a NaN fails each comparison.
module axijoint_test_assertions
   use axijoint_base_kinds, only : wp, i8
   use axijoint_test_failures, only : source_location, record_failure, any_failures
   use axijoint_test_order, only : assert_less_than, assert_less_than_or_equal, &
      assert_greater_than, assert_greater_than_or_equal
   use axijoint_test_values, only : flat, to_text, index_text, trimmed, conformable
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_is_finite
   implicit none
   private
   public :: source_location, any_failures
   public :: assert_true, assert_false, assert_fail, assert_equal, assert_relatively_equal
   public :: assert_is_nan, assert_is_finite
   public :: assert_less_than, assert_less_than_or_equal
   public :: assert_greater_than, assert_greater_than_or_equal

   !> Equality; reals within an absolute tolerance (zero if absent), texts but for outer blanks
   interface assert_equal
      module procedure :: equal_real, equal_integer, equal_long, equal_mixed
      module procedure :: equal_logical, equal_text
   end interface assert_equal

   ! Ends a line of a report
   character(len=*), parameter :: next = new_line('a')

contains

   !> Each condition holds
   subroutine assert_true(condition, message, location)
      !> Scalar or vector
      logical, intent(in) :: condition(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      if (all(flat(condition))) return
      call record_failure('expected true, found false', message, location)
   end subroutine assert_true

   !> No condition holds
   subroutine assert_false(condition, message, location)
      !> Scalar or vector
      logical, intent(in) :: condition(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      if (.not. any(flat(condition))) return
      call record_failure('expected false, found true', message, location)
   end subroutine assert_false

   !> The test must not come here
   subroutine assert_fail(message, location)
      !> The test's own words
      character(len=*), intent(in) :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call record_failure('failed', message, location)
   end subroutine assert_fail

   !> Equal reals
   subroutine equal_real(expected, actual, tolerance, message, location)
      !> What is expected: the shape of `actual`, or a scalar
      real(wp), intent(in) :: expected(..)
      !> What was found
      real(wp), intent(in) :: actual(..)
      !> Largest absolute difference
      real(wp), intent(in), optional :: tolerance
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location
      real(wp), allocatable :: want(:), got(:)
      real(wp) :: limit, wanted
      integer :: i

      limit = 0.0_wp
      if (present(tolerance)) limit = tolerance
      if (shapes_differ(shape(expected), shape(actual), message, location)) return
      want = flat(expected)
      got = flat(actual)
      do i = 1, size(got)
         wanted = want(min(i, size(want)))
         if (within(wanted, got(i), limit)) cycle
         call record_failure('values differ'//index_text(i, shape(actual))//next &
            //'  expected: '//to_text(wanted)//' +- '//to_text(limit)//next &
            //'  found:    '//to_text(got(i)), message, location)
         return
      end do
   end subroutine equal_real

   !> Reals equal relative to what is expected, which must not be zero
   subroutine assert_relatively_equal(expected, actual, tolerance, message, location)
      !> What is expected: the shape of `actual`, or a scalar
      real(wp), intent(in) :: expected(..)
      !> What was found
      real(wp), intent(in) :: actual(..)
      !> Largest difference divided by the size of what is expected
      real(wp), intent(in) :: tolerance
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location
      real(wp), allocatable :: want(:), got(:)
      real(wp) :: wanted
      integer :: i

      if (shapes_differ(shape(expected), shape(actual), message, location)) return
      want = flat(expected)
      got = flat(actual)
      do i = 1, size(got)
         wanted = want(min(i, size(want)))
         if (relatively_within(wanted, got(i), tolerance)) cycle
         call record_failure('values differ'//index_text(i, shape(actual))//next &
            //'  expected: '//to_text(wanted)//' (1 +- '//to_text(tolerance)//')'//next &
            //'  found:    '//to_text(got(i)), message, location)
         return
      end do
   end subroutine assert_relatively_equal

   !> Equal integers
   subroutine equal_integer(expected, actual, message, location)
      !> What is expected: the shape of `actual`, or a scalar
      integer, intent(in) :: expected(..)
      !> What was found
      integer, intent(in) :: actual(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      if (shapes_differ(shape(expected), shape(actual), message, location)) return
      call compare_integers(flat(expected), flat(actual), shape(actual), message, location)
   end subroutine equal_integer

   !> Equal long integers
   subroutine equal_long(expected, actual, message, location)
      !> What is expected: the shape of `actual`, or a scalar
      integer(i8), intent(in) :: expected(..)
      !> What was found
      integer(i8), intent(in) :: actual(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      if (shapes_differ(shape(expected), shape(actual), message, location)) return
      call compare_integers(flat(expected), flat(actual), shape(actual), message, location)
   end subroutine equal_long

   !> A long integer that equals a default one
   subroutine equal_mixed(expected, actual, message, location)
      !> What is expected: the shape of `actual`, or a scalar
      integer, intent(in) :: expected(..)
      !> What was found
      integer(i8), intent(in) :: actual(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      if (shapes_differ(shape(expected), shape(actual), message, location)) return
      call compare_integers(flat(expected), flat(actual), shape(actual), message, location)
   end subroutine equal_mixed

   !> Equal truth values
   subroutine equal_logical(expected, actual, message, location)
      !> What is expected: the shape of `actual`, or a scalar
      logical, intent(in) :: expected(..)
      !> What was found
      logical, intent(in) :: actual(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      if (shapes_differ(shape(expected), shape(actual), message, location)) return
      call compare_integers(merge(1_i8, 0_i8, flat(expected)), merge(1_i8, 0_i8, flat(actual)), &
         shape(actual), message, location, names=['false', 'true '])
   end subroutine equal_logical

   !> Equal texts, the blanks and tabs at both ends left out
   subroutine equal_text(expected, actual, message, location)
      !> What is expected
      character(len=*), intent(in) :: expected
      !> What was found
      character(len=*), intent(in) :: actual
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      ! Fortran's == pads with blanks; both ends are trimmed, so equal texts have equal lengths
      if (trimmed(expected) == trimmed(actual) &
         .and. len(trimmed(expected)) == len(trimmed(actual))) return
      call record_failure('texts differ'//next//'  expected: "'//trimmed(expected)//'"'//next &
         //'  found:    "'//trimmed(actual)//'"', message, location)
   end subroutine equal_text

   !> The value is not a number
   subroutine assert_is_nan(value, message, location)
      !> Any real
      real(wp), intent(in) :: value
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      if (ieee_is_nan(value)) return
      call record_failure('expected NaN, found '//to_text(value), message, location)
   end subroutine assert_is_nan

   !> The value is neither infinite nor NaN
   subroutine assert_is_finite(value, message, location)
      !> Any real
      real(wp), intent(in) :: value
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      if (ieee_is_finite(value)) return
      call record_failure('expected a finite value, found '//to_text(value), message, location)
   end subroutine assert_is_finite

   !> Record the first of the values that differs, if any
   subroutine compare_integers(want, got, extents, message, location, names)
      !> What is expected, one value or as many as found
      integer(i8), intent(in) :: want(:)
      !> What was found
      integer(i8), intent(in) :: got(:)
      !> Shape of the array that was flattened
      integer, intent(in) :: extents(:)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location
      !> Names to show for the values 0 and 1
      character(len=*), intent(in), optional :: names(0:)
      character(len=:), allocatable :: want_text, got_text
      integer(i8) :: wanted
      integer :: i

      do i = 1, size(got)
         wanted = want(min(i, size(want)))
         if (wanted == got(i)) cycle
         want_text = to_text(wanted)
         got_text = to_text(got(i))
         if (present(names)) then
            want_text = trim(names(wanted))
            got_text = trim(names(got(i)))
         end if
         call record_failure('values differ'//index_text(i, extents)//next//'  expected: ' &
            //want_text//next//'  found:    '//got_text, message, location)
         return
      end do
   end subroutine compare_integers

   !> Record a failure if two arrays cannot be compared value by value
   function shapes_differ(expected, actual, message, location) result(differ)
      !> Shape of what is expected
      integer, intent(in) :: expected(:)
      !> Shape of what was found
      integer, intent(in) :: actual(:)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location
      !> True if so
      logical :: differ

      differ = .not. conformable(expected, actual)
      if (.not. differ) return
      call record_failure('shapes differ'//next//'  expected: '//shape_text(expected)//next &
         //'  found:    '//shape_text(actual), message, location)
   end function shapes_differ

   !> A shape as text
   function shape_text(extents) result(text)
      !> The shape
      integer, intent(in) :: extents(:)
      !> Its text, `[2,3]`
      character(len=:), allocatable :: text
      integer :: i

      text = '['
      do i = 1, size(extents)
         if (i > 1) text = text//','
         text = text//to_text(extents(i))
      end do
      text = text//']'
   end function shape_text

   !> Is the difference of two values at most the limit? Never for a NaN.
   pure function within(expected, actual, limit) result(close)
      !> One value
      real(wp), intent(in) :: expected
      !> The other
      real(wp), intent(in) :: actual
      !> Largest difference
      real(wp), intent(in) :: limit
      !> True if so
      logical :: close
      real(wp) :: factor

      close = .false.
      if (ieee_is_nan(expected) .or. ieee_is_nan(actual) .or. ieee_is_nan(limit)) return
      if (.not. (ieee_is_finite(expected) .and. ieee_is_finite(actual))) then
         close = expected >= actual .and. expected <= actual
         return
      end if
      ! The difference of two huge values of opposite sign would overflow
      factor = merge(0.25_wp, 1.0_wp, max(abs(expected), abs(actual)) > 0.25_wp*huge(limit))
      close = abs(factor*actual - factor*expected) <= factor*limit
   end function within

   !> Is the difference of two values at most a fraction of what is expected?
   pure function relatively_within(expected, actual, limit) result(close)
      !> What is expected; zero, infinite or NaN is never close
      real(wp), intent(in) :: expected
      !> What was found
      real(wp), intent(in) :: actual
      !> Largest difference divided by the size of what is expected
      real(wp), intent(in) :: limit
      !> True if so
      logical :: close

      close = .false.
      if (.not. ieee_is_finite(expected)) return
      if (.not. abs(expected) > 0.0_wp) return
      close = within(expected, actual, limit*abs(expected))
   end function relatively_within

end module axijoint_test_assertions
