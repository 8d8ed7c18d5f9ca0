!> Kinds of numbers and the constants of the circle
module axijoint_base_kinds
   use, intrinsic :: iso_fortran_env, only : real32, real64, int64
   implicit none
   private
   public :: wp, sp, i8, pi, degree

   !> Working precision of all reals
   integer, parameter :: wp = real64
   !> Single precision, where few digits are enough and memory is read most of the time
   integer, parameter :: sp = real32
   !> Long integers: counts of operations, bytes, positions in files
   integer, parameter :: i8 = int64
   !> Ratio of a circle's circumference to its diameter
   real(wp), parameter :: pi = 3.14159265358979323846264338327950288_wp
   !> One degree in radians
   real(wp), parameter :: degree = pi/180.0_wp

end module axijoint_base_kinds
