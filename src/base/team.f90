!> Processes that work on one job: each has harmonics, elements of its own, and all know the whole of
!> what they find. The team of this module is a process by itself, for which nothing of this costs
!> anything; one of many processes extends it (folder mpi/).
!>
!> All ranks of a team go through the same calls in the same order: what decides about a call must
!> be the same everywhere. Nothing is added up on the way between them. Who needs a sum gathers its
!> terms and adds them in their order, so that results are the same with any number of ranks.
module axijoint_base_team
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: team_type, take_team, equal_shares

   !> A process by itself
   type :: team_type
      !> Number of this process, from 0, and how many there are
      integer :: rank = 0, size = 1
      !> How many of them share the memory of this machine
      integer :: sharers = 1
   contains
      !> Give every rank the entries that each rank has found
      procedure :: gather
      !> Give every rank the entries that one has found
      procedure :: broadcast
      !> Give every rank the text of rank 0
      procedure :: tell
      !> Agree on an error that ranks may have met by themselves
      procedure :: agree
      !> Whether something is so on all ranks
      procedure :: all_of
      !> Let a wish of one rank that the program ends be one of all
      procedure :: share_wish
      !> Bytes that this rank has sent and received so far
      procedure :: exchanged
      !> Teams of the ranks that name the same group
      procedure :: split
   end type team_type

contains

   !> A team, or this process alone if there is none
   subroutine take_team(given, team)
      !> The team
      class(team_type), allocatable, intent(in) :: given
      !> A copy of it
      class(team_type), allocatable, intent(out) :: team

      if (allocated(given)) then
         allocate (team, source=given)
      else
         allocate (team_type :: team)
      end if
   end subroutine take_team

   !> Cut entries into one range a rank, of costs as equal as may be
   pure function equal_shares(cost, n_ranks) result(last)
      !> Cost of each entry
      real(wp), intent(in) :: cost(:)
      !> Number of ranks
      integer, intent(in) :: n_ranks
      !> Last entry of each rank, from 0 for what is before the first, shape (0:n_ranks)
      integer :: last(0:n_ranks)

      real(wp) :: before, whole
      integer :: k, rank

      last = 0
      rank = 1
      before = 0.0_wp
      whole = sum(cost)
      do k = 1, size(cost)
         ! an entry belongs to the rank in whose share its middle lies
         do while (rank < n_ranks .and. before + 0.5_wp*cost(k) > rank*whole/n_ranks)
            rank = rank + 1
            last(rank) = last(rank - 1)
         end do
         last(rank) = k
         before = before + cost(k)
      end do
      last(rank:) = size(cost)
   end function equal_shares

   !> Give every rank the entries that each rank has found
   subroutine gather(self, values, n, last)
      !> The team
      class(team_type), intent(in) :: self
      !> Entries, all of one size, one after the other; those of this rank are there
      integer(i8), intent(in) :: n
      real(wp), intent(inout) :: values(n)
      !> Last entry of each rank, shape (0:ranks)
      integer, intent(in) :: last(0:)

      associate (unused => self, also => values, and => last)
      end associate
   end subroutine gather

   !> Give every rank the entries that one has found
   subroutine broadcast(self, values, n, rank)
      !> The team
      class(team_type), intent(in) :: self
      !> The values
      integer(i8), intent(in) :: n
      real(wp), intent(inout) :: values(n)
      !> The rank that has them
      integer, intent(in) :: rank

      associate (unused => self, also => values, and => rank)
      end associate
   end subroutine broadcast

   !> Give every rank the text of rank 0
   subroutine tell(self, text)
      !> The team
      class(team_type), intent(in) :: self
      !> The text
      character(len=:), allocatable, intent(inout) :: text

      associate (unused => self, also => text)
      end associate
   end subroutine tell

   !> Agree on an error: that of the first rank that has one. A wish that the program ends is shared
   subroutine agree(self, error)
      !> The team
      class(team_type), intent(in) :: self
      !> Error of this rank; then of all
      type(error_type), allocatable, intent(inout) :: error

      associate (unused => self, also => error)
      end associate
   end subroutine agree

   !> Whether something is so on all ranks
   logical function all_of(self, flag)
      !> The team
      class(team_type), intent(in) :: self
      !> Whether it is on this
      logical, intent(in) :: flag

      associate (unused => self)
      end associate
      all_of = flag
   end function all_of

   !> Let a wish of one rank that the program ends be one of all
   subroutine share_wish(self)
      !> The team
      class(team_type), intent(in) :: self

      associate (unused => self)
      end associate
   end subroutine share_wish

   !> Bytes that this rank has sent and received so far
   integer(i8) function exchanged(self)
      !> The team
      class(team_type), intent(in) :: self

      associate (unused => self)
      end associate
      exchanged = 0
   end function exchanged

   !> Teams of the ranks that name the same group
   subroutine split(self, group, part)
      !> The team
      class(team_type), intent(in) :: self
      !> Number of the group, from 0
      integer, intent(in) :: group
      !> The team of this rank
      class(team_type), allocatable, intent(out) :: part

      associate (unused => self, also => group)
      end associate
      allocate (team_type :: part)
   end subroutine split

end module axijoint_base_team
