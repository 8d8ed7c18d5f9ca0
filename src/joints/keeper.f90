!> Who keeps what a history has come to, so that it can be gone on with after the program has ended
module axijoint_joints_keeper
   use axijoint_base_error, only : error_type
   use axijoint_joints_history, only : history_type
   implicit none
   private
   public :: keeper_type

   !> A keeper; this one keeps nothing
   type :: keeper_type
   contains
      !> Bring a history to where it was kept, if it was
      procedure :: restore
      !> A step came to equilibrium; the increment is done if nothing lies ahead
      procedure :: keep
   end type keeper_type

contains

   !> Bring a history to where it was kept
   subroutine restore(self, history, restored, error)
      !> The keeper
      class(keeper_type), intent(inout) :: self
      !> The history, new; its loads are found from the factors of their load cases
      type(history_type), intent(inout) :: history
      !> Whether there was something to restore
      logical, intent(out) :: restored
      !> What was kept is of another structure
      type(error_type), allocatable, intent(out) :: error

      associate (unused => self, same => history)
      end associate
      restored = .false.
   end subroutine restore

   !> A step came to equilibrium
   subroutine keep(self, history)
      !> The keeper
      class(keeper_type), intent(inout) :: self
      !> The history
      type(history_type), intent(in) :: history

      associate (unused => self, same => history)
      end associate
   end subroutine keep

end module axijoint_joints_keeper
