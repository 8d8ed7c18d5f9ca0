!> Factors whose rows can be entered anywhere
module axijoint_solver_trailing
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : refine_order
   use axijoint_solver_type, only : factor_type, new_block
   implicit none
   private
   public :: trailing_factor_type

   !> Right-hand sides solved at once
   integer, parameter :: block_size = 64

   !> Factor that stores its rows in their order. For loads from row `first` on,
   !> the solution from that row on needs the factor from there on only.
   type, abstract, extends(factor_type) :: trailing_factor_type
   contains
      !> Solve from a row on
      procedure(solve_trailing_interface), deferred :: solve_trailing
      procedure :: solve
      procedure :: inverse_block
   end type trailing_factor_type

   abstract interface
      !> Solve with the rows and columns of the factor from one on
      subroutine solve_trailing_interface(self, first, b)
         import :: trailing_factor_type, wp
         !> The factor
         class(trailing_factor_type), intent(in) :: self
         !> First row and column
         integer, intent(in) :: first
         !> Right-hand sides, then solutions, shape (n - first + 1, any)
         real(wp), intent(inout), contiguous :: b(:, :)
      end subroutine solve_trailing_interface
   end interface

contains

   !> Solve for a block of right-hand sides
   subroutine solve(self, b)
      !> The factor
      class(trailing_factor_type), intent(in) :: self
      !> Right-hand sides, then solutions, shape (n, any)
      real(wp), intent(inout), contiguous :: b(:, :)

      call self%solve_trailing(1, b)
   end subroutine solve

   !> The inverse restricted to a set, by unit loads. By symmetry the entries from
   !> the diagonal on are enough, and these take the factor from there on.
   subroutine inverse_block(self, set, inverse, error)
      !> The factor
      class(trailing_factor_type), intent(in) :: self
      !> Equations, each once, in any order
      integer, intent(in) :: set(:)
      !> inverse(i, j) is the inverse's entry at set(i), set(j)
      real(wp), allocatable, intent(out) :: inverse(:, :)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: b(:, :)
      integer :: order(size(set)), i, j, k, l, last, first

      call new_block(inverse, size(set), size(set), error)
      if (allocated(error)) return
      order = [(i, i=1, size(set))]
      call refine_order(order, set)
      do k = 1, size(set), block_size
         last = min(k + block_size - 1, size(set))
         first = set(order(k))
         call new_block(b, self%n - first + 1, last - k + 1, error)
         if (allocated(error)) return
         do j = k, last
            b(set(order(j)) - first + 1, j - k + 1) = 1.0_wp
         end do
         call self%solve_trailing(first, b)
         do j = k, last
            do l = j, size(set)
               inverse(order(l), order(j)) = b(set(order(l)) - first + 1, j - k + 1)
            end do
         end do
         do l = k, size(set)  ! rows of some columns, which the cache holds
            do j = k, min(l, last)
               inverse(order(j), order(l)) = inverse(order(l), order(j))
            end do
         end do
      end do
   end subroutine inverse_block

end module axijoint_solver_trailing
