!> Anderson acceleration of a fixed-point iteration (J. ACM 12, 1965)
module axijoint_joints_anderson
   use axijoint_base_kinds, only : wp
   use axijoint_linalg_lapack, only : least_squares
   implicit none
   private
   public :: anderson_type, new_anderson, anderson_step

   !> The last iterates and their residuals
   type :: anderson_type
      private
      !> Differences of iterates and of residuals, the latest first
      real(wp), allocatable :: dx(:, :), dr(:, :)
      !> Last iterate and residual
      real(wp), allocatable :: x(:), r(:)
      !> Differences in use
      integer :: n = 0
   end type anderson_type

contains

   !> Without memory
   pure function new_anderson(size, depth) result(memory)
      !> Number of unknowns, and iterates to remember
      integer, intent(in) :: size, depth
      !> The memory
      type(anderson_type) :: memory

      allocate (memory%dx(size, depth), memory%dr(size, depth))
   end function new_anderson

   !> From an iterate x with the residual r = g(x) - x to the next: the mix of the
   !> last iterates whose residual is least, and that residual added
   subroutine anderson_step(memory, x, r)
      !> The memory
      type(anderson_type), intent(inout) :: memory
      !> Iterate, then the next
      real(wp), intent(inout) :: x(:)
      !> Its residual
      real(wp), intent(in) :: r(:)

      real(wp), allocatable :: a(:, :), next(:), weight(:)
      integer :: n

      if (allocated(memory%x)) then
         memory%n = min(memory%n + 1, size(memory%dx, 2), size(x))
         n = memory%n
         memory%dx(:, 2:n) = memory%dx(:, :n - 1)
         memory%dr(:, 2:n) = memory%dr(:, :n - 1)
         memory%dx(:, 1) = x - memory%x
         memory%dr(:, 1) = r - memory%r
      end if
      memory%x = x
      memory%r = r
      next = x + r
      n = memory%n
      if (n > 0) then
         a = memory%dr(:, :n)
         allocate (weight(n))
         call least_squares(a, r, weight)
         next = next - matmul(memory%dx(:, :n) + memory%dr(:, :n), weight)
      end if
      x = next
   end subroutine anderson_step

end module axijoint_joints_anderson
