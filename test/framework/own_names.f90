!> The assertions under names that pFUnit does not have
!!
!! For the test of the assertions themselves: it asserts with pFUnit's or the project's ones, and
!! must name those under test without hiding the others.
module axijoint_test_own_names
   use axijoint_test_assertions, only : own_true => assert_true, own_false => assert_false, &
      own_fail => assert_fail, own_equal => assert_equal, own_finite => assert_is_finite, &
      own_relatively_equal => assert_relatively_equal, own_nan => assert_is_nan, &
      own_less => assert_less_than, own_at_most => assert_less_than_or_equal, &
      own_greater => assert_greater_than, own_at_least => assert_greater_than_or_equal, &
      own_location => source_location
   implicit none
   private
   public :: own_true, own_false, own_fail, own_equal, own_finite, own_relatively_equal, own_nan
   public :: own_less, own_at_most, own_greater, own_at_least, own_location

end module axijoint_test_own_names
