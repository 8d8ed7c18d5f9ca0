!> Solution of a system with a supernodal Cholesky factor, for one or a few right-hand sides
!>
!> Most supernodes of a plane mesh are small, and calls of the BLAS for them cost more than what they
!> compute: panels have loops of our own. A panel serves all right-hand sides while it is
!> in the cache, and each of them takes the same operations as if it were alone: not a bit of it depends
!> on the others.
module axijoint_solver_supernodal_solve
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_double, c_int32_t, c_int64_t
   use axijoint_base_kinds, only : wp, i8
   use axijoint_solver_panel, only : beyond, most_at_once, rows_at_once, panel_forward, panel_backward
   use axijoint_solver_supernodal, only : supernodal_structure_type
   implicit none
   private
   public :: supernodal_solve

contains

   !> Solve L L^T x = b in the order of the factor
   subroutine supernodal_solve(structure, l, n_sides, x, work) bind(c, name='axijoint_supernodal_solve')
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> The factor, panel by panel, and `beyond` numbers behind it
      real(c_double), intent(in) :: l(0:*)
      !> Right-hand sides
      integer(c_int64_t), value :: n_sides
      !> Right-hand sides, then solutions
      real(c_double), intent(inout) :: x(0:structure%n - 1, n_sides)
      !> As many numbers as the longest panel has rows, and `beyond`
      real(c_double), intent(inout) :: work(0:*)

      integer(c_int64_t), pointer, contiguous :: column(:), first_row(:), first_number(:), row(:)
      integer(c_int32_t) :: at_once
      integer(i8) :: n, s, k

      at_once = rows_at_once(most_at_once)
      n = structure%n_supernodes
      call c_f_pointer(structure%column, column, [n + 1])
      call c_f_pointer(structure%first_row, first_row, [n + 1])
      call c_f_pointer(structure%first_number, first_number, [n + 1])
      call c_f_pointer(structure%row, row, [first_row(n + 1)])
      do s = 1, n
         do k = 1, n_sides
            ! Loads on few nodes, as those of joints, touch few panels up to the root; NaN is not skipped
            if (all(abs(x(column(s):column(s + 1) - 1, k)) <= 0.0_wp)) cycle
            call forward(at_once, int(first_row(s + 1) - first_row(s)), int(column(s + 1) - column(s)), &
               l(first_number(s)), row(first_row(s) + 1:first_row(s + 1)), x(:, k), work)
         end do
      end do
      do s = n, 1, -1
         do k = 1, n_sides
            call backward(at_once, int(first_row(s + 1) - first_row(s)), int(column(s + 1) - column(s)), &
               l(first_number(s)), row(first_row(s) + 1:first_row(s + 1)), x(:, k), work)
         end do
      end do
   end subroutine supernodal_solve

   !> Eliminate the unknowns of a panel
   subroutine forward(at_once, height, width, panel, row, x, t)
      !> Rows taken at once, rows and columns
      integer(c_int32_t), intent(in) :: at_once, height, width
      !> The panel, its first rows a lower triangle
      real(c_double), intent(in) :: panel(height, width)
      !> Its rows, counted from zero
      integer(c_int64_t), intent(in) :: row(height)
      !> The unknowns
      real(c_double), intent(inout) :: x(0:*)
      !> Those of its rows
      real(c_double), intent(inout) :: t(height + beyond)

      integer :: k

      t(:width) = x(row(1):row(1) + width - 1)
      t(width + 1:) = 0.0_wp
      call panel_forward(at_once, height, width, panel, t)
      x(row(1):row(1) + width - 1) = t(:width)
      do k = width + 1, height
         x(row(k)) = x(row(k)) + t(k)
      end do
   end subroutine forward

   !> Find the unknowns of a panel
   subroutine backward(at_once, height, width, panel, row, x, t)
      !> Rows taken at once, rows and columns
      integer(c_int32_t), intent(in) :: at_once, height, width
      !> The panel, its first rows a lower triangle
      real(c_double), intent(in) :: panel(height, width)
      !> Its rows, counted from zero
      integer(c_int64_t), intent(in) :: row(height)
      !> The unknowns
      real(c_double), intent(inout) :: x(0:*)
      !> Those of its rows
      real(c_double), intent(inout) :: t(height + beyond)

      integer :: k

      t(:width) = x(row(1):row(1) + width - 1)
      do k = width + 1, height
         t(k) = x(row(k))
      end do
      call panel_backward(at_once, height, width, panel, t)
      x(row(1):row(1) + width - 1) = t(:width)
   end subroutine backward

end module axijoint_solver_supernodal_solve
