!> How far a job has come, in a file that a later run goes on from: the histories of the
!> combinations that are not written yet, which of them are, and the rounds of a job with an error
!> target
module axijoint_job_checkpoint
   use axijoint_base_error, only : error_type, fatal_error, exit_state
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_progress, only : tell_below
   use axijoint_base_state_file, only : state_mark_type, write_state_file
   use axijoint_base_stream, only : writer_type, reader_type, new_reader
   use axijoint_base_system, only : path_kind, path_absent
   use axijoint_base_text, only : to_text
   use axijoint_joints_history, only : history_type
   use axijoint_joints_history_record, only : write_history, read_history
   use axijoint_joints_keeper, only : keeper_type
   implicit none
   private
   public :: checkpoint_type, whenever_cheap

   !> Interval for: as often as that costs no more than the share below of the time of the run
   real(wp), parameter :: whenever_cheap = -1.0_wp
   real(wp), parameter :: cheap_share = 0.01_wp
   !> Time that writing takes before it was measured, and that making bytes does [second]
   real(wp), parameter :: expected_time = 0.02_wp, expected_noting = 0.01_wp

   !> How far one combination is
   type :: part_type
      !> Its history, as bytes; empty if nothing is done
      character(len=:), allocatable :: history
      !> Whether its results are written, with which exit code, and what tells them from others
      logical :: done = .false.
      integer :: exit_code = 0
      character(len=:), allocatable :: digest
   end type part_type

   !> How far a job is. By default nothing is kept
   type, extends(keeper_type) :: checkpoint_type
      !> The file, what it is of, and the least time between two writings [second]. Without a name
      !> nothing is kept: another process does that
      character(len=:), allocatable :: path
      type(state_mark_type) :: mark
      real(wp) :: interval = whenever_cheap
      !> The combination at work, and its increment in words
      integer :: at = 1
      character(len=:), allocatable :: place
      !> Increments of a combination
      integer :: n_increments = 1
      !> The round of refinement, as bytes; empty for none
      character(len=:), allocatable :: round
      !> One entry a combination
      type(part_type), allocatable :: parts(:)
      !> Whether there is something that the file does not hold; whether it was written by this run,
      !> or is what this run goes on from
      logical :: pending = .false., there = .false.
      !> Why the file could not be written; not allocated if it could
      character(len=:), allocatable :: failure
      !> Whether that was told: once is enough
      logical, private :: told = .false.
      !> When it was written last [tick], and how long that took [second]
      integer(i8), private :: last = 0
      real(wp), private :: cost = expected_time
      !> When a history was made bytes of last [tick], and how long that took [second]
      integer(i8), private :: noted = 0
      real(wp), private :: noting = expected_noting
   contains
      procedure :: restore
      procedure :: keep
      !> Begin to keep the state of a job in a file
      procedure :: begin
      !> A round of refinement begins
      procedure :: begin_round
      !> The results of a combination are written
      procedure :: note_done
      !> Write what is pending
      procedure :: flush
      !> What a file holds
      procedure :: tell_bytes
      !> Take over what a file holds
      procedure :: take
      procedure, private :: now_and_then
   end type checkpoint_type

contains

   !> Begin to keep the state of a job in a file
   subroutine begin(self, path, mark, interval, n_combinations, n_increments)
      !> The state
      class(checkpoint_type), intent(inout) :: self
      !> The file; empty to keep nothing
      character(len=*), intent(in) :: path
      !> What it is of
      type(state_mark_type), intent(in) :: mark
      !> Least time between two writings [second], or `whenever_cheap`
      real(wp), intent(in) :: interval
      !> Number of combinations, and of increments of each
      integer, intent(in) :: n_combinations, n_increments

      integer :: k

      self%path = path
      self%mark = mark
      self%interval = interval
      self%n_increments = n_increments
      self%round = ''
      self%place = ''
      if (allocated(self%parts)) deallocate (self%parts)
      allocate (self%parts(n_combinations))
      do k = 1, n_combinations
         self%parts(k)%history = ''
         self%parts(k)%digest = ''
      end do
      call system_clock(self%last)
      self%noted = self%last
   end subroutine begin

   !> Bring a history to where it was kept
   subroutine restore(self, history, restored, error)
      !> The state
      class(checkpoint_type), intent(inout) :: self
      !> The history, new
      type(history_type), intent(inout) :: history
      !> Whether there was something to restore
      logical, intent(out) :: restored
      !> It is of another structure
      type(error_type), allocatable, intent(out) :: error

      type(reader_type) :: reader

      restored = .false.
      if (.not. allocated(self%parts)) return
      if (len(self%parts(self%at)%history) == 0) return
      reader = new_reader(self%parts(self%at)%history)
      call read_history(reader, history)
      restored = .not. reader%failed
      if (.not. restored) call fatal_error(error, exit_state, self%path//' is of another '// &
         'structure than this deck describes'//new_line('a')//'mend: run without --resume')
   end subroutine restore

   !> A step came to equilibrium. Where that share of the time would not do for noting every step,
   !> some are left out, those of the first second at least, unless all are asked for
   subroutine keep(self, history)
      !> The state
      class(checkpoint_type), intent(inout) :: self
      !> The history
      type(history_type), intent(in) :: history

      type(writer_type) :: writer
      integer(i8) :: now, rate

      if (.not. allocated(self%parts)) return
      if (len(self%path) == 0) return
      call system_clock(now, rate)
      if (abs(self%interval) > 0.0_wp .and. real(now - self%noted, wp) < &
          self%noting/cheap_share*real(rate, wp)) return
      associate (part => self%parts(self%at))
         ! one increment more than before, as a rule
         call writer%reserve(len(part%history, i8) + 2*len(part%history, i8)/max(1, history%increment - 1))
         part%history = ''
         call write_history(history, writer)
         call writer%give(part%history)
      end associate
      call system_clock(self%noted)
      self%noting = real(self%noted - now, wp)/real(rate, wp)
      self%place = 'increment '//to_text(history%increment)//' of '//to_text(self%n_increments)
      if (size(history%ahead) > 0) self%place = 'a part of '//self%place
      if (size(self%parts) > 1) self%place = self%place//', combination '//to_text(self%at)// &
         ' of '//to_text(size(self%parts))
      call self%now_and_then()
   end subroutine keep

   !> A round of refinement begins
   subroutine begin_round(self, round)
      !> The state
      class(checkpoint_type), intent(inout) :: self
      !> What the round starts from, as bytes
      character(len=*), intent(in) :: round

      integer :: k

      if (.not. allocated(self%parts)) return
      if (self%round == round .and. len(self%round) == len(round)) return  ! gone on from
      self%round = round
      self%place = 'a round of refinement'
      do k = 1, size(self%parts)
         self%parts(k)%history = ''
      end do
      call self%now_and_then()
   end subroutine begin_round

   !> The results of a combination are written
   subroutine note_done(self, exit_code, digest)
      !> The state
      class(checkpoint_type), intent(inout) :: self
      !> How it ended
      integer, intent(in) :: exit_code
      !> What tells its results from others
      character(len=*), intent(in) :: digest

      if (.not. allocated(self%parts)) return
      associate (part => self%parts(self%at))
         part%history = ''
         part%done = .true.
         part%exit_code = exit_code
         part%digest = digest
      end associate
      self%place = 'combination '//to_text(self%at)//' of '//to_text(size(self%parts))
      if (.not. all(self%parts%done)) call self%now_and_then()
   end subroutine note_done

   !> Write the file, if it is time to
   subroutine now_and_then(self)
      !> The state
      class(checkpoint_type), intent(inout) :: self

      integer(i8) :: now, rate
      real(wp) :: least

      if (len(self%path) == 0) return
      self%pending = .true.
      least = self%interval
      if (self%interval < 0.0_wp) least = self%cost/cheap_share
      call system_clock(now, rate)
      if (real(now - self%last, wp) >= least*real(rate, wp)) call self%flush()
   end subroutine now_and_then

   !> Write what is pending. A failure does not end the run: the state before stands. The first is told
   subroutine flush(self)
      !> The state
      class(checkpoint_type), intent(inout) :: self

      integer(i8) :: before, rate
      character(len=:), allocatable :: body

      if (.not. self%pending) return
      call system_clock(before)
      self%mark%place = self%place
      call self%tell_bytes(body)
      call write_state_file(self%path, self%mark, body, self%failure)
      self%pending = .false.
      if (.not. allocated(self%failure)) then
         self%there = .true.
      else if (.not. self%told) then
         self%told = .true.
         if (path_kind(self%path) == path_absent) self%there = .false.
         call tell_below('axijoint: warning: the state '//self%path//' cannot be written: '//self%failure// &
            '; the run goes on, but if it is stopped or dies, --resume '//trim(merge( &
            'goes on from what was kept before', 'begins anew                      ', self%there)))
      end if
      call system_clock(self%last, rate)
      self%cost = real(self%last - before, wp)/real(rate, wp)
   end subroutine flush

   !> What a file holds
   subroutine tell_bytes(self, bytes)
      !> The state
      class(checkpoint_type), intent(in) :: self
      !> The bytes
      character(len=:), allocatable, intent(out) :: bytes

      !> Bytes of a part besides its history and its digest: more than numbers and lengths take
      integer(i8), parameter :: few = 128
      type(writer_type) :: writer
      integer(i8) :: n
      integer :: k

      n = few + len(self%round, i8)
      do k = 1, size(self%parts)
         n = n + few + len(self%parts(k)%history, i8) + len(self%parts(k)%digest, i8)
      end do
      call writer%reserve(n)
      call writer%put(self%round)
      call writer%put(size(self%parts))
      do k = 1, size(self%parts)
         call writer%put(self%parts(k)%history)
         call writer%put(self%parts(k)%done)
         call writer%put(self%parts(k)%exit_code)
         call writer%put(self%parts(k)%digest)
      end do
      call writer%give(bytes)
   end subroutine tell_bytes

   !> Take over what a file holds
   subroutine take(self, bytes, place, taken)
      !> The state, begun
      class(checkpoint_type), intent(inout) :: self
      !> What the file holds, and how far that is in words
      character(len=*), intent(in) :: bytes, place
      !> Whether it is of such a job
      logical, intent(out) :: taken

      type(reader_type) :: reader
      integer :: k, n

      reader = new_reader(bytes)
      call reader%get(self%round)
      call reader%get(n)
      taken = .not. reader%failed .and. n == size(self%parts)
      if (.not. taken) return
      do k = 1, n
         call reader%get(self%parts(k)%history)
         call reader%get(self%parts(k)%done)
         call reader%get(self%parts(k)%exit_code)
         call reader%get(self%parts(k)%digest)
      end do
      taken = reader%at_end()
      self%place = place
      self%there = .true.
   end subroutine take

end module axijoint_job_checkpoint
