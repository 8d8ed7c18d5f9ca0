!> Factors whose rows can be entered anywhere
module axijoint_solver_trailing
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : refine_order
   use axijoint_linalg_symmetric_half, only : symmetric_half_type, put_entry
   use axijoint_solver_type, only : factor_type, new_block, new_flexibility
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
      procedure :: flexibility
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

   !> E^T K^-1 E of loads E by solutions. By symmetry the entries from the diagonal on are enough, and these take the factor
   !> from the first equation of the load on.
   subroutine flexibility(self, equation, factor, room, matrix, error)
      !> The factor
      class(trailing_factor_type), intent(in) :: self
      !> The two equations that each load acts on, and what acts there, shape (2, loads)
      integer, intent(in) :: equation(:, :)
      real(wp), intent(in) :: factor(:, :)
      !> Memory that one after the other may take
      type(symmetric_half_type), intent(inout) :: room
      !> One row a load
      type(symmetric_half_type), allocatable, intent(out) :: matrix
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: b(:, :)
      integer, dimension(size(equation, 2)) :: order, lower
      integer :: i, j, k, l, last, first, n

      associate (unused => room)
      end associate
      n = size(equation, 2)
      allocate (matrix)
      call new_flexibility(matrix, n, error)
      if (allocated(error)) return
      lower = minval(equation, 1)
      order = [(i, i=1, n)]
      call refine_order(order, lower)
      do k = 1, n, block_size
         last = min(k + block_size - 1, n)
         first = lower(order(k))
         call new_block(b, self%n - first + 1, last - k + 1, error)
         if (allocated(error)) return
         do j = k, last
            do i = 1, 2
               associate (x => b(equation(i, order(j)) - first + 1, j - k + 1))
                  x = x + factor(i, order(j))
               end associate
            end do
         end do
         call self%solve_trailing(first, b)
         do l = k, n
            do j = k, min(l, last)
               call put_entry(matrix, order(l), order(j), sum(factor(:, order(l))*b(equation(:, order(l)) - first + 1, j - k + 1)))
            end do
         end do
      end do
   end subroutine flexibility

end module axijoint_solver_trailing
