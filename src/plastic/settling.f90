!> A value followed on the way to equilibrium, until it changes little beside what is asked of it
module axijoint_plastic_settling
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: settling_type, note, is_settled

   !> Values of the last third of the way, so many at least, tell whether it is settled
   integer, parameter :: least_told = 4
   !> How well it is to be known: as a share of the difference that is asked for, and beside its
   !> size, below which nothing is asked for
   real(wp), parameter :: well = 0.1_wp, fine = 5.0e-4_wp

   !> The value on its way
   type :: settling_type
      !> What it is compared with: its difference to that is asked for; itself if none is given
      real(wp), allocatable :: reference
      !> Size of the value; that of the last if zero
      real(wp) :: size = 0.0_wp
      !> The values so far, at equal distances
      real(wp), allocatable :: values(:)
   end type settling_type

contains

   !> Note a value
   pure subroutine note(settling, value)
      !> The values so far
      type(settling_type), intent(inout) :: settling
      !> The next
      real(wp), intent(in) :: value

      if (.not. allocated(settling%values)) allocate (settling%values(0))
      settling%values = [settling%values, value]
   end subroutine note

   !> Whether the values of the last third of the way lie close together
   pure logical function is_settled(settling, times)
      !> The values
      type(settling_type), intent(in) :: settling
      !> How many times what is close
      real(wp), intent(in) :: times

      real(wp) :: close

      is_settled = .false.
      associate (n => size(settling%values))
         if (n < 2*least_told - 1) return
         associate (last => settling%values(n), told => settling%values(min((2*n)/3, n - least_told) + 1:))
            close = fine*max(abs(last), settling%size)
            if (allocated(settling%reference)) &
               close = max(close, well*abs(last - settling%reference))
            is_settled = maxval(told) - minval(told) <= times*close
         end associate
      end associate
   end function is_settled

end module axijoint_plastic_settling
