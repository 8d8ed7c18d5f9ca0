!> Assertions on the order of two values or arrays
module axijoint_test_order
   use axijoint_base_kinds, only : wp, i8
   use axijoint_test_failures, only : source_location, record_failure
   use axijoint_test_values, only : flat, to_text, index_text, conformable
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan
   implicit none
   private
   public :: assert_less_than, assert_less_than_or_equal
   public :: assert_greater_than, assert_greater_than_or_equal

   !> The left value is smaller than the right one, for each pair
   interface assert_less_than
      module procedure :: less_than_real, less_than_integer
   end interface assert_less_than

   !> The left value is at most the right one, for each pair
   interface assert_less_than_or_equal
      module procedure :: less_than_or_equal_real, less_than_or_equal_integer
   end interface assert_less_than_or_equal

   !> The left value is larger than the right one, for each pair
   interface assert_greater_than
      module procedure :: greater_than_real, greater_than_integer
   end interface assert_greater_than

   !> The left value is at least the right one, for each pair
   interface assert_greater_than_or_equal
      module procedure :: greater_than_or_equal_real, greater_than_or_equal_integer
   end interface assert_greater_than_or_equal

contains

   !> Left < right, real
   subroutine less_than_real(left, right, message, location)
      !> The shape of `right`, or a scalar
      real(wp), intent(in) :: left(..)
      !> Scalar or array
      real(wp), intent(in) :: right(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call check_reals('<', flat(left), flat(right), shape(left), shape(right), message, &
         location)
   end subroutine less_than_real

   !> Left < right, integer
   subroutine less_than_integer(left, right, message, location)
      !> The shape of `right`, or a scalar
      integer, intent(in) :: left(..)
      !> Scalar or array
      integer, intent(in) :: right(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call check_integers('<', flat(left), flat(right), shape(left), shape(right), message, &
         location)
   end subroutine less_than_integer

   !> Left <= right, real
   subroutine less_than_or_equal_real(left, right, message, location)
      !> The shape of `right`, or a scalar
      real(wp), intent(in) :: left(..)
      !> Scalar or array
      real(wp), intent(in) :: right(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call check_reals('<=', flat(left), flat(right), shape(left), shape(right), message, &
         location)
   end subroutine less_than_or_equal_real

   !> Left <= right, integer
   subroutine less_than_or_equal_integer(left, right, message, location)
      !> The shape of `right`, or a scalar
      integer, intent(in) :: left(..)
      !> Scalar or array
      integer, intent(in) :: right(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call check_integers('<=', flat(left), flat(right), shape(left), shape(right), message, &
         location)
   end subroutine less_than_or_equal_integer

   !> Left > right, real
   subroutine greater_than_real(left, right, message, location)
      !> The shape of `right`, or a scalar
      real(wp), intent(in) :: left(..)
      !> Scalar or array
      real(wp), intent(in) :: right(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call check_reals('>', flat(left), flat(right), shape(left), shape(right), message, &
         location)
   end subroutine greater_than_real

   !> Left > right, integer
   subroutine greater_than_integer(left, right, message, location)
      !> The shape of `right`, or a scalar
      integer, intent(in) :: left(..)
      !> Scalar or array
      integer, intent(in) :: right(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call check_integers('>', flat(left), flat(right), shape(left), shape(right), message, &
         location)
   end subroutine greater_than_integer

   !> Left >= right, real
   subroutine greater_than_or_equal_real(left, right, message, location)
      !> The shape of `right`, or a scalar
      real(wp), intent(in) :: left(..)
      !> Scalar or array
      real(wp), intent(in) :: right(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call check_reals('>=', flat(left), flat(right), shape(left), shape(right), message, &
         location)
   end subroutine greater_than_or_equal_real

   !> Left >= right, integer
   subroutine greater_than_or_equal_integer(left, right, message, location)
      !> The shape of `right`, or a scalar
      integer, intent(in) :: left(..)
      !> Scalar or array
      integer, intent(in) :: right(..)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call check_integers('>=', flat(left), flat(right), shape(left), shape(right), message, &
         location)
   end subroutine greater_than_or_equal_integer

   !> Record the first pair of reals that is not in order, if any; a NaN never is
   subroutine check_reals(relation, left, right, left_shape, right_shape, message, location)
      !> One of < <= > >=
      character(len=*), intent(in) :: relation
      !> Left values, one or as many as there are right ones
      real(wp), intent(in) :: left(:)
      !> Right values
      real(wp), intent(in) :: right(:)
      !> Shape of the left array
      integer, intent(in) :: left_shape(:)
      !> Shape of the right array
      integer, intent(in) :: right_shape(:)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location
      real(wp) :: a
      logical :: ordered
      integer :: i

      if (shapes_differ(left_shape, right_shape, message, location)) return
      do i = 1, size(right)
         a = left(min(i, size(left)))
         ordered = .false.
         if (.not. (ieee_is_nan(a) .or. ieee_is_nan(right(i)))) then
            ordered = holds(relation, a < right(i), a > right(i))
         end if
         if (ordered) cycle
         call report(relation, to_text(a), to_text(right(i)), index_text(i, right_shape), &
            message, location)
         return
      end do
   end subroutine check_reals

   !> Record the first pair of integers that is not in order, if any
   subroutine check_integers(relation, left, right, left_shape, right_shape, message, location)
      !> One of < <= > >=
      character(len=*), intent(in) :: relation
      !> Left values, one or as many as there are right ones
      integer(i8), intent(in) :: left(:)
      !> Right values
      integer(i8), intent(in) :: right(:)
      !> Shape of the left array
      integer, intent(in) :: left_shape(:)
      !> Shape of the right array
      integer, intent(in) :: right_shape(:)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location
      integer(i8) :: a
      integer :: i

      if (shapes_differ(left_shape, right_shape, message, location)) return
      do i = 1, size(right)
         a = left(min(i, size(left)))
         if (holds(relation, a < right(i), a > right(i))) cycle
         call report(relation, to_text(a), to_text(right(i)), index_text(i, right_shape), &
            message, location)
         return
      end do
   end subroutine check_integers

   !> Does a relation hold between two numbers?
   pure function holds(relation, below, above) result(in_order)
      !> One of < <= > >=
      character(len=*), intent(in) :: relation
      !> The left number is below the right one
      logical, intent(in) :: below
      !> The left number is above the right one
      logical, intent(in) :: above
      !> True if so
      logical :: in_order

      select case (relation)
      case ('<')
         in_order = below
      case ('<=')
         in_order = .not. above
      case ('>')
         in_order = above
      case ('>=')
         in_order = .not. below
      case default
         in_order = .false.
      end select
   end function holds

   !> Record a failure if two arrays cannot be compared value by value
   function shapes_differ(left_shape, right_shape, message, location) result(differ)
      !> Shape of the left array
      integer, intent(in) :: left_shape(:)
      !> Shape of the right array
      integer, intent(in) :: right_shape(:)
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location
      !> True if so
      logical :: differ

      differ = .not. conformable(left_shape, right_shape)
      if (differ) call record_failure('the two arrays differ in shape', message, location)
   end function shapes_differ

   !> Record a pair that is not in order
   subroutine report(relation, left, right, place, message, location)
      !> The relation that was expected
      character(len=*), intent(in) :: relation
      !> Left value
      character(len=*), intent(in) :: left
      !> Right value
      character(len=*), intent(in) :: right
      !> Subscripts of the pair
      character(len=*), intent(in) :: place
      !> The test's own words
      character(len=*), intent(in), optional :: message
      !> Where the assertion stands
      type(source_location), intent(in), optional :: location

      call record_failure('values out of order'//place//new_line('a')//'  expected: left ' &
         //relation//' right'//new_line('a')//'  found:    '//left//' and '//right, &
         message, location)
   end subroutine report

end module axijoint_test_order
