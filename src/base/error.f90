!> The one error type: an exit code and a message for a person
module axijoint_base_error
   use axijoint_base_kinds, only : i8
   use axijoint_base_text, only : put_integer
   implicit none
   private
   public :: error_type, fatal_error, memory_error
   public :: exit_ok, exit_deck, exit_not_converged, exit_singular
   public :: exit_io, exit_memory, exit_in_use, exit_state, exit_internal, exit_stopped

   !> Success
   integer, parameter :: exit_ok = 0
   !> Wrong deck or wrong command line
   integer, parameter :: exit_deck = 2
   !> The iteration ended without equilibrium; results are labelled so
   integer, parameter :: exit_not_converged = 3
   !> Singular stiffness or a mechanism
   integer, parameter :: exit_singular = 4
   !> A file could not be read or written
   integer, parameter :: exit_io = 5
   !> Out of memory
   integer, parameter :: exit_memory = 6
   !> Another run uses the name of the results
   integer, parameter :: exit_in_use = 7
   !> A state file that cannot be gone on from
   integer, parameter :: exit_state = 8
   !> A state that the program should never reach
   integer, parameter :: exit_internal = 70
   !> Asked to end before it was done; it can be gone on with
   integer, parameter :: exit_stopped = 75

   !> An error on its way to the caller
   type :: error_type
      !> Exit code of the program, one of the `exit_` parameters
      integer :: code = exit_internal
      !> Cause and remedy; may have several lines
      character(len=:), allocatable :: message
   end type error_type

contains

   !> Make an error; the caller returns right after
   subroutine fatal_error(error, code, message)
      !> The new error
      type(error_type), allocatable, intent(out) :: error
      !> Exit code
      integer, intent(in) :: code
      !> Cause and remedy
      character(len=*), intent(in) :: message

      allocate (error)
      error%code = code
      error%message = message
   end subroutine fatal_error

   !> Make an error of memory that was asked for in vain, in several threads perhaps
   subroutine memory_error(error, what, number, of)
      !> The new error
      type(error_type), allocatable, intent(out) :: error
      !> What it was for
      character(len=*), intent(in) :: what
      !> How much, and what of; nothing more is said if one is absent
      integer(i8), intent(in), optional :: number
      character(len=*), intent(in), optional :: of

      character(len=:), allocatable :: much

      much = ''
      if (present(number) .and. present(of)) then
         call put_integer(number, much)
         much = ' '//much//' '//of
      end if
      call fatal_error(error, exit_memory, 'out of memory: '//what//much//new_line('a')// &
         'mend: more memory or a larger limit; fewer threads (--threads), another solver '// &
         '(axijoint estimate --solver NAME), fewer harmonics or a coarser mesh')
   end subroutine memory_error

end module axijoint_base_error
