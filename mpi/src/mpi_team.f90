!> A team of MPI processes
module axijoint_mpi_team
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_ptr, c_f_pointer
   use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_stop, only : own_wish, agree_wish
   use axijoint_base_team, only : team_type
   use axijoint_mpi_trial, only : trial_numbers
   use mpi_f08
   implicit none
   private
   public :: mpi_team_type, begin_mpi, end_mpi

   !> Bytes of a real
   integer(i8), parameter :: real_bytes = storage_size(1.0_wp)/8
   !> Longest message; counts of MPI are integers of four bytes
   integer(i8), parameter :: longest = 2_i8**30
   !> Length of the name of a processor's kernels
   integer, parameter :: name_length = 32

   !> The team
   type, extends(team_type) :: mpi_team_type
      private
      !> Its communicator
      type(MPI_Comm) :: communicator
      !> Bytes that this rank has sent and received; copies of a team share them
      integer(i8), pointer :: bytes => null()
   contains
      procedure :: gather
      procedure :: broadcast
      procedure :: tell
      procedure :: agree
      procedure :: all_of
      procedure :: share_wish
      procedure :: exchanged
      procedure :: split
   end type mpi_team_type

   interface
      !> Name of the processor that OpenBLAS has kernels for
      type(c_ptr) function openblas_get_corename() bind(c)
         import :: c_ptr
      end function openblas_get_corename
      !> Do nothing for some milliseconds; process_shim.c
      subroutine c_pause(milliseconds) bind(c, name='axijoint_pause')
         import :: c_int
         integer(c_int), value :: milliseconds
      end subroutine c_pause
   end interface

contains

   !> Begin. Rank 0 alone speaks: what the others would say is the same
   subroutine begin_mpi(team)
      !> All processes
      type(mpi_team_type), intent(out) :: team

      integer :: provided

      call MPI_Init_thread(MPI_THREAD_FUNNELED, provided)
      call new_team(MPI_COMM_WORLD, team)
      allocate (team%bytes, source=0_i8)
      call demand_same_bits(team)
      if (team%rank > 0) then
         open (unit=output_unit, file='/dev/null', action='write')
         open (unit=error_unit, file='/dev/null', action='write')
      end if
   end subroutine begin_mpi

   !> End all processes with one exit code
   subroutine end_mpi(team, exit_code)
      !> All processes
      type(mpi_team_type), intent(in) :: team
      !> Exit code of rank 0, then zero on the others: the launcher would tell of each that has one
      integer, intent(inout) :: exit_code

      flush (output_unit)
      flush (error_unit)
      if (team%rank > 0) exit_code = 0
      call MPI_Finalize()
   end subroutine end_mpi

   !> The team of a communicator
   subroutine new_team(communicator, team)
      !> The communicator
      type(MPI_Comm), intent(in) :: communicator
      !> The team, its bytes not counted yet
      type(mpi_team_type), intent(out) :: team

      type(MPI_Comm) :: machine

      team%communicator = communicator
      call MPI_Comm_rank(communicator, team%rank)
      call MPI_Comm_size(communicator, team%size)
      call MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, machine)
      call MPI_Comm_size(machine, team%sharers)
      call MPI_Comm_free(machine)
   end subroutine new_team

   !> Numbers that all ranks compute must be the same bit for bit, or they would not decide alike. Libraries have other
   !> kernels for other processors
   subroutine demand_same_bits(team)
      !> All processes
      type(mpi_team_type), intent(in) :: team

      character(len=name_length) :: here, there
      real(wp), allocatable :: own(:), of_first(:)
      logical :: differs, one_differs

      here = kernels()
      there = here
      call trial_numbers(own)
      of_first = own
      call MPI_Bcast(there, name_length, MPI_CHARACTER, 0, team%communicator)
      call MPI_Bcast(of_first, size(of_first), MPI_DOUBLE_PRECISION, 0, team%communicator)
      differs = any(transfer(own, 0_i8, size(own)) /= transfer(of_first, 0_i8, size(of_first)))
      call MPI_Allreduce(differs, one_differs, 1, MPI_LOGICAL, MPI_LOR, team%communicator)
      if (.not. one_differs) return
      if (.not. differs) call MPI_Barrier(team%communicator)  ! the end comes from another
      write (error_unit, '(a, i0, a)') 'axijoint: rank ', team%rank, ' computes other last digits than rank 0: its '// &
         'processor is another (kernels of OpenBLAS: '//trim(here)//', on rank 0 '//trim(there)//')'//new_line('a')// &
         'mend: take machines of one kind; OPENBLAS_CORETYPE=HASWELL for all ranks may make them alike'
      call MPI_Abort(team%communicator, 2)
   end subroutine demand_same_bits

   !> Name of the processor that OpenBLAS has kernels for
   function kernels() result(name)
      !> The name
      character(len=name_length) :: name

      character(kind=c_char), pointer :: letters(:)
      integer :: i

      call c_f_pointer(openblas_get_corename(), letters, [name_length])
      name = ''
      do i = 1, name_length
         if (letters(i) == achar(0)) exit
         name(i:i) = letters(i)
      end do
   end function kernels

   !> Give every rank the entries that each rank has found
   subroutine gather(self, values, n, last)
      !> The team
      class(mpi_team_type), intent(in) :: self
      !> Entries, all of one size, one after the other; those of this rank are there
      integer(i8), intent(in) :: n
      real(wp), intent(inout) :: values(n)
      !> Last entry of each rank, shape (0:ranks)
      integer, intent(in) :: last(0:)

      type(MPI_Datatype) :: entry
      integer :: counts(self%size), before(self%size)

      if (n == 0) return
      before = last(:self%size - 1)
      counts = last(1:) - before
      call MPI_Type_contiguous(int(n/last(self%size)), MPI_DOUBLE_PRECISION, entry)
      call MPI_Type_commit(entry)
      call MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values, counts, before, entry, &
                          self%communicator)
      call MPI_Type_free(entry)
      ! what others have comes in, what this rank has goes out once to each of them
      associate (size_of_entry => real_bytes*(n/last(self%size)), own => counts(self%rank + 1))
         call count_bytes(self, size_of_entry*(last(self%size) - own + own*(self%size - 1)))
      end associate
   end subroutine gather

   !> Give every rank the entries that one has found
   subroutine broadcast(self, values, n, rank)
      !> The team
      class(mpi_team_type), intent(in) :: self
      !> The values
      integer(i8), intent(in) :: n
      real(wp), intent(inout) :: values(n)
      !> The rank that has them
      integer, intent(in) :: rank

      integer(i8) :: first, last

      do first = 1, n, longest
         last = min(n, first + longest - 1)
         call MPI_Bcast(values(first:last), int(last - first + 1), MPI_DOUBLE_PRECISION, rank, &
                        self%communicator)
      end do
      call count_bytes(self, real_bytes*n*merge(self%size - 1, 1, rank == self%rank))
   end subroutine broadcast

   !> Give every rank the text of rank 0
   subroutine tell(self, text)
      !> The team
      class(mpi_team_type), intent(in) :: self
      !> The text
      character(len=:), allocatable, intent(inout) :: text

      call tell_from(self, 0, text)
   end subroutine tell

   !> Give every rank the text of one
   subroutine tell_from(self, rank, text)
      !> The team
      class(mpi_team_type), intent(in) :: self
      !> The rank
      integer, intent(in) :: rank
      !> The text
      character(len=:), allocatable, intent(inout) :: text

      character(len=:), allocatable :: buffer
      integer :: length

      length = 0
      if (self%rank == rank) length = len(text)
      call MPI_Bcast(length, 1, MPI_INTEGER, rank, self%communicator)
      allocate (character(len=length) :: buffer)
      if (self%rank == rank) buffer = text
      call MPI_Bcast(buffer, length, MPI_CHARACTER, rank, self%communicator)
      text = buffer
      call count_bytes(self, int(length, i8)*merge(self%size - 1, 1, rank == self%rank))
   end subroutine tell_from

   !> Agree on an error: that of the first rank that has one. A wish that the program ends is shared
   subroutine agree(self, error)
      !> The team
      class(mpi_team_type), intent(in) :: self
      !> Error of this rank; then of all
      type(error_type), allocatable, intent(inout) :: error

      integer :: first, code
      character(len=:), allocatable :: message

      call wait_for_all(self)
      call share_wish(self)
      first = merge(self%rank, self%size, allocated(error))
      call MPI_Allreduce(MPI_IN_PLACE, first, 1, MPI_INTEGER, MPI_MIN, self%communicator)
      if (first == self%size) return
      code = 0
      message = ''
      if (first == self%rank) then
         code = error%code
         message = error%message
      end if
      call MPI_Bcast(code, 1, MPI_INTEGER, first, self%communicator)
      call tell_from(self, first, message)
      if (.not. allocated(error)) allocate (error)
      error%code = code
      error%message = message
   end subroutine agree

   !> Wait until all ranks have come here; where that takes long, without a processor, which others may have a use for
   subroutine wait_for_all(self)
      !> The team
      class(mpi_team_type), intent(in) :: self

      !> Long [second]: a pause is a fiftieth of it
      real(wp), parameter :: long = 0.05_wp
      type(MPI_Request) :: request
      logical :: here
      real(wp) :: start

      call MPI_Ibarrier(self%communicator, request)
      start = MPI_Wtime()
      do
         call MPI_Test(request, here, MPI_STATUS_IGNORE)
         if (here) exit
         if (MPI_Wtime() - start > long) call c_pause(1)
      end do
   end subroutine wait_for_all

   !> Whether something is so on all ranks
   logical function all_of(self, flag)
      !> The team
      class(mpi_team_type), intent(in) :: self
      !> Whether it is on this
      logical, intent(in) :: flag

      call MPI_Allreduce(flag, all_of, 1, MPI_LOGICAL, MPI_LAND, self%communicator)
   end function all_of

   !> Let a wish of one rank that the program ends be one of all
   subroutine share_wish(self)
      !> The team
      class(mpi_team_type), intent(in) :: self

      integer :: wish

      wish = own_wish()
      call MPI_Allreduce(MPI_IN_PLACE, wish, 1, MPI_INTEGER, MPI_MAX, self%communicator)
      call agree_wish(wish)
   end subroutine share_wish

   !> Bytes that this rank has sent and received so far
   integer(i8) function exchanged(self)
      !> The team
      class(mpi_team_type), intent(in) :: self

      exchanged = self%bytes
   end function exchanged

   !> Teams of the ranks that name the same group
   subroutine split(self, group, part)
      !> The team
      class(mpi_team_type), intent(in) :: self
      !> Number of the group, from 0
      integer, intent(in) :: group
      !> The team of this rank
      class(team_type), allocatable, intent(out) :: part

      type(mpi_team_type) :: found
      type(MPI_Comm) :: communicator

      call MPI_Comm_split(self%communicator, group, self%rank, communicator)
      call new_team(communicator, found)
      found%bytes => self%bytes
      found%sharers = self%sharers
      allocate (part, source=found)
   end subroutine split

   !> Count bytes
   subroutine count_bytes(self, bytes)
      !> The team
      class(mpi_team_type), intent(in) :: self
      !> Bytes sent and received
      integer(i8), intent(in) :: bytes

      self%bytes = self%bytes + bytes
   end subroutine count_bytes

end module axijoint_mpi_team
