!> Panels of a supernodal factor: their numbers (`panel_factor.c`); elimination of unknowns by them, and the way back
!> (`panel_solve.c`)
module axijoint_solver_panel
   use, intrinsic :: iso_c_binding, only : c_double, c_int32_t, c_int64_t
   implicit none
   private
   public :: beyond, most_at_once, rows_at_once, panel_load, panel_take, panel_triangle, panel_below, panel_forward, &
      panel_backward

   !> Numbers behind a panel and behind the right-hand side at its rows that vectors may reach
   integer, parameter :: beyond = 8
   !> Rows that any processor takes at once at most
   integer(c_int32_t), parameter :: most_at_once = 8

   interface
      !> Rows that are taken at once: as many as the processor can, and OpenBLAS is not asked to do otherwise
      pure integer(c_int32_t) function rows_at_once(most) bind(c, name='axijoint_rows_at_once')
         import :: c_int32_t
         !> So many at most
         integer(c_int32_t), value :: most
      end function rows_at_once

      !> Put some rows of the matrix into a panel
      pure subroutine panel_load(low, high, height, width, start, row, which, value, place, panel) &
         bind(c, name='axijoint_panel_load')
         import :: c_int32_t, c_int64_t, c_double
         !> Rows of the panel before the first, and up to which, all of them, and columns
         integer(c_int32_t), value :: low, high, height, width
         !> First entry of each column in the lists, counted from zero, shape (width + 1)
         integer(c_int64_t), intent(in) :: start(*)
         !> Row of each entry of the matrix, and place of its value
         integer(c_int32_t), intent(in) :: row(*), which(*)
         !> Values of the matrix
         real(c_double), intent(in) :: value(*)
         !> Place in the panel of each row of the matrix
         integer(c_int32_t), intent(in) :: place(*)
         !> The panel
         real(c_double), intent(inout) :: panel(*)
      end subroutine panel_load

      !> Subtract from a panel what one before it leaves: the product of the rows of that one with the first of them
      pure subroutine panel_take(at_once, low, high, columns, rank, lead, before, target, height, panel) &
         bind(c, name='axijoint_panel_take')
         import :: c_int32_t, c_double
         !> Rows to take at once; rows before the first, and up to which; the first rows, which are columns of the panel
         integer(c_int32_t), value :: at_once, low, high, columns
         !> Columns of the panel before, and its rows
         integer(c_int32_t), value :: rank, lead
         !> The panel before, from the first of these rows on
         real(c_double), intent(in) :: before(*)
         !> Rows of the panel where they go, counted from zero, ascending; shape (high)
         integer(c_int32_t), intent(in) :: target(*)
         !> Rows of the panel
         integer(c_int32_t), value :: height
         !> The panel; above its diagonal there may be any numbers afterwards
         real(c_double), intent(inout) :: panel(*)
      end subroutine panel_take

      !> Cholesky factor of some columns of the triangle of a panel, from those before them
      integer(c_int32_t) function panel_triangle(at_once, first, last, lead, panel, over) result(failed) &
         bind(c, name='axijoint_panel_triangle')
         import :: c_int32_t, c_double
         !> Rows to take at once, columns that are factored, columns that then are, and rows of the panel
         integer(c_int32_t), value :: at_once, first, last, lead
         !> The panel
         real(c_double), intent(inout) :: panel(*)
         !> One over the diagonal, shape (last)
         real(c_double), intent(inout) :: over(*)
      end function panel_triangle

      !> The same columns of some rows below the triangle
      pure subroutine panel_below(at_once, rows, first, last, lead, panel, over, below) &
         bind(c, name='axijoint_panel_below')
         import :: c_int32_t, c_double
         !> Rows to take at once, rows, columns that are done, columns that then are, and rows of the panel
         integer(c_int32_t), value :: at_once, rows, first, last, lead
         !> The panel, whose triangle is factored so far
         real(c_double), intent(in) :: panel(*)
         !> One over its diagonal, shape (last)
         real(c_double), intent(in) :: over(*)
         !> The panel from the first of the rows on
         real(c_double), intent(inout) :: below(*)
      end subroutine panel_below

      !> Eliminate the unknowns of a panel
      pure subroutine panel_forward(at_once, height, width, panel, t) bind(c, name='axijoint_panel_forward')
         import :: c_int32_t, c_double
         !> Rows to take at once, rows and columns
         integer(c_int32_t), value :: at_once, height, width
         !> The panel, shape (height, width), its first rows a lower triangle; `beyond` numbers of any value behind it
         real(c_double), intent(in) :: panel(*)
         !> Right-hand side at its rows; takes the unknowns, and what they leave below; shape (height + beyond)
         real(c_double), intent(inout) :: t(*)
      end subroutine panel_forward

      !> Find the unknowns of a panel
      pure subroutine panel_backward(at_once, height, width, panel, t) bind(c, name='axijoint_panel_backward')
         import :: c_int32_t, c_double
         !> Rows to take at once, rows and columns
         integer(c_int32_t), value :: at_once, height, width
         !> The panel as above; what is behind it are numbers
         real(c_double), intent(in) :: panel(*)
         !> What is left to its unknowns, and the unknowns of the rows below; takes its own; shape (height + beyond)
         real(c_double), intent(inout) :: t(*)
      end subroutine panel_backward
   end interface

end module axijoint_solver_panel
