!> The methods by their names, one entry each
module axijoint_joints_methods
   use axijoint_joints_method, only : method_type
   use axijoint_joints_newton_method, only : newton_method_type
   use axijoint_joints_total, only : total_type
   use axijoint_joints_transfer, only : new_transfer
   use axijoint_model_model, only : method_newton, method_total, method_anderson, method_transfer
   implicit none
   private
   public :: new_method, other_loop, second_opinion, is_newton

   !> Sweeps that Anderson's mix remembers
   integer, parameter :: depth = 10

contains

   !> The method of a name
   function new_method(name) result(method)
      !> One of the `method_` parameters
      integer, intent(in) :: name
      !> The method
      class(method_type), allocatable :: method

      select case (name)
      case (method_newton)
         allocate (method, source=newton_method_type())
      case (method_total)
         allocate (method, source=total_type())
      case (method_anderson)
         allocate (method, source=total_type(depth=depth))
      case (method_transfer)
         allocate (method, source=new_transfer())
      end select
   end function new_method

   !> The method of the other kind that results are compared with: the paper's loop for those on
   !> total jumps, and Newton's for the paper's
   function other_loop(method) result(other)
      !> A method
      class(method_type), intent(in) :: method
      !> The other
      class(method_type), allocatable :: other

      other = new_method(merge(method_newton, method_transfer, method%accumulates))
   end function other_loop

   !> The method to ask where one runs away: Newton's may where there is a state, and sweeps over stiff joints often
   !> do, and it is no mechanism if the other finds one; not allocated if there is none to ask
   subroutine second_opinion(method, second)
      !> A method
      class(method_type), intent(in) :: method
      !> Another
      class(method_type), allocatable, intent(out) :: second

      select type (method)
      type is (newton_method_type)
         allocate (second, source=new_method(method_anderson))
      type is (total_type)
         allocate (second, source=new_method(method_newton))
      end select
   end subroutine second_opinion

   !> Whether a method is Newton's
   pure logical function is_newton(method)
      !> A method
      class(method_type), intent(in) :: method

      select type (method)
      type is (newton_method_type)
         is_newton = .true.
      class default
         is_newton = .false.
      end select
   end function is_newton

end module axijoint_joints_methods
