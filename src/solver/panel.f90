!> Elimination of the unknowns of a panel of a supernodal factor, and the way back (`panel_kernels.c`)
module axijoint_solver_panel
   use, intrinsic :: iso_c_binding, only : c_double, c_int32_t
   implicit none
   private
   public :: beyond, most_at_once, rows_at_once, panel_forward, panel_backward

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
