!> Locks: a file that says which process uses a name. It is made by giving a complete file a second
!> name, which only one of several processes can do, also on a file system that hosts share, and a
!> lock that a process of this host left behind is taken over, by one of several that try.
module axijoint_base_lock
   use, intrinsic :: iso_c_binding, only : c_int
   use axijoint_base_error, only : error_type, fatal_error, exit_io, exit_in_use
   use axijoint_base_last_words, only : note_lock, forget_lock
   use axijoint_base_process, only : process_type, this_process, is_dead, &
      same_process, same_machine
   use axijoint_base_system, only : error_text, rename_path, unlink_path
   use axijoint_base_text, only : to_text
   use axijoint_base_whole_file, only : write_new_file, read_whole_file, link_path, &
      knows_no_links, is_there
   implicit none
   private
   public :: lock_type, take_lock, release_lock

   !> First and last line of a lock file
   character(len=*), parameter :: first_line = 'axijoint lock 1', last_line = 'end'
   !> Times that a lock is asked for which others take, give back or leave behind meanwhile, and
   !> time between them [millisecond]
   integer, parameter :: most_tries = 50
   integer(c_int), parameter :: pause_between = 20_c_int

   !> Who holds a lock, as its file says
   type :: owner_type
      !> Process that holds it
      type(process_type) :: process
      !> Date, and what the process does
      character(len=:), allocatable :: since, purpose
      !> Batch job of a cluster, and how often it was started again; empty outside of one
      character(len=:), allocatable :: batch, restart
   end type owner_type

   !> A lock
   type :: lock_type
      private
      !> Its file
      character(len=:), allocatable :: path
      !> Whether it is held
      logical, public :: held = .false.
      !> Whether it was left behind by a process that ended
      logical, public :: inherited = .false.
   end type lock_type

   interface
      !> Do nothing for some milliseconds; process_shim.c
      subroutine c_pause(milliseconds) bind(c, name='axijoint_pause')
         import :: c_int
         integer(c_int), value :: milliseconds
      end subroutine c_pause
   end interface

contains

   !> Take a lock
   subroutine take_lock(path, purpose, lock, error)
      !> Its file
      character(len=*), intent(in) :: path
      !> What it is for, a line that others are told
      character(len=*), intent(in) :: purpose
      !> The lock
      type(lock_type), intent(out) :: lock
      !> Another process holds it, or the file cannot be made
      type(error_type), allocatable, intent(out) :: error

      type(owner_type) :: own
      character(len=:), allocatable :: beside
      integer :: errno

      own = new_owner(purpose)
      lock%path = path
      beside = path//'.'//own%process%host//'.'//to_text(own%process%id)//'.tmp'
      call note_lock(beside, own%process%host, own%process%id)
      call note_lock(path, own%process%host, own%process%id)
      call unlink_path(beside, errno)
      call write_new_file(beside, text_of(own), errno, lasting=.false.)
      if (errno == 0) then
         call claim(path, beside, own, lock%inherited, error)
         call unlink_path(beside, errno)
      else
         call cannot_make(path, errno, error)
      end if
      call forget_lock(beside)
      lock%held = .not. allocated(error)
      if (.not. lock%held) call forget_lock(path)
   end subroutine take_lock

   !> Give a lock back
   subroutine release_lock(lock)
      !> The lock, held or not
      type(lock_type), intent(inout) :: lock

      type(owner_type) :: owner
      integer :: errno
      logical :: there

      if (.not. lock%held) return
      lock%held = .false.
      call read_owner(lock%path, owner, there)
      ! somebody may have removed it by hand, and another process taken it since
      if (there) there = same_process(owner%process, this_process())
      if (there) call unlink_path(lock%path, errno)
      call forget_lock(lock%path)
   end subroutine release_lock

   !> Give a file its second name, that of the lock. Of those that find a dead process there, the
   !> one that takes the lock which is named after it puts its own in the place: while that is held
   !> the place does not change, for nobody else may and the owner is no more. The dead may
   !> have held such a lock itself.
   recursive subroutine claim(path, beside, own, inherited, error)
      !> The lock, and a file that is like it
      character(len=*), intent(in) :: path, beside
      !> Who wants it
      type(owner_type), intent(in) :: own
      !> Whether it was of a dead process
      logical, intent(out) :: inherited
      !> Another process holds it, or it cannot be made
      type(error_type), allocatable, intent(out) :: error

      type(owner_type) :: owner
      logical :: known
      integer :: errno, k

      inherited = .false.
      do k = 1, most_tries
         call link_path(beside, path, errno)
         if (knows_no_links(errno)) call write_new_file(path, text_of(own), errno, lasting=.false.)
         if (errno == 0) return
         if (.not. is_there(errno)) exit
         call read_owner(path, owner, known)
         if (known) then
            if (.not. has_ended(owner, own)) exit
            call inherit(path, beside, owner, own, inherited, error)
            if (inherited .or. allocated(error)) return
         end if
         call c_pause(pause_between)  ! one that is being made or given back
      end do
      if (is_there(errno)) then
         call refuse(path, owner, known, own, error)
      else
         call cannot_make(path, errno, error)
      end if
   end subroutine claim

   !> Put a lock in the place of one whose owner has ended
   recursive subroutine inherit(path, beside, owner, own, inherited, error)
      !> The lock, and a file that is like it
      character(len=*), intent(in) :: path, beside
      !> Who had it, and who wants it
      type(owner_type), intent(in) :: owner, own
      !> Whether it was done; not if another was faster
      logical, intent(out) :: inherited
      !> It cannot be made
      type(error_type), allocatable, intent(out) :: error

      type(owner_type) :: now
      character(len=:), allocatable :: guard, next
      logical :: known, unused
      integer :: errno

      inherited = .false.
      guard = path//'.'//to_text(owner%process%id)//'-'//to_text(owner%process%start)//'.tmp'
      call claim(guard, beside, own, unused, error)
      if (allocated(error)) then
         if (error%code == exit_in_use) deallocate (error)  ! another one is at it
         return
      end if
      call read_owner(path, now, known)
      if (known) known = same_process(now%process, owner%process)
      if (known) then
         next = path//'.next.'//own%process%host//'.'//to_text(own%process%id)//'.tmp'
         call write_new_file(next, text_of(own), errno, lasting=.false.)
         if (errno == 0) call rename_path(next, path, errno)
         inherited = errno == 0
         if (.not. inherited) call cannot_make(path, errno, error)
      end if
      call unlink_path(guard, errno)
   end subroutine inherit

   !> Whether who held a lock is no more. A batch system starts a job again only when its earlier
   !> processes have ended, wherever they were
   logical function has_ended(owner, own)
      !> Who held it, and who wants it
      type(owner_type), intent(in) :: owner, own

      has_ended = is_dead(owner%process) .or. &
         (len(own%batch) > 0 .and. own%batch == owner%batch .and. own%restart /= owner%restart)
   end function has_ended

   !> This process as the owner of a lock
   function new_owner(purpose) result(owner)
      !> What it is for
      character(len=*), intent(in) :: purpose
      !> The owner
      type(owner_type) :: owner

      character(len=8) :: day
      character(len=10) :: clock
      character(len=5) :: zone

      call date_and_time(day, clock, zone)
      owner%process = this_process()
      owner%since = day(:4)//'-'//day(5:6)//'-'//day(7:)//' '//clock(:2)//':'//clock(3:4)//':'// &
         clock(5:6)//' '//zone
      owner%purpose = purpose
      owner%batch = environment('SLURM_JOB_ID')
      owner%restart = environment('SLURM_RESTART_COUNT')
   end function new_owner

   !> Value of a variable of the environment
   function environment(name) result(value)
      !> The variable
      character(len=*), intent(in) :: name
      !> Its value; empty if it is not set
      character(len=:), allocatable :: value

      integer :: length, status

      call get_environment_variable(name, length=length, status=status)
      allocate (character(len=merge(length, 0, status == 0)) :: value)
      if (len(value) > 0) call get_environment_variable(name, value)
   end function environment

   !> A lock file
   function text_of(owner) result(text)
      !> Who holds it
      type(owner_type), intent(in) :: owner
      !> Its lines
      character(len=:), allocatable :: text

      character(len=1), parameter :: nl = new_line('a')

      associate (process => owner%process)
         text = first_line//nl//'host '//process%host//nl//'installation '//process%installation &
            //nl//'boot '//process%boot//nl//'space '//process%space//nl//'process '// &
            to_text(process%id)//nl//'start '//to_text(process%start)//nl//'since '// &
            owner%since//nl//'batch '//owner%batch//nl//'restart '//owner%restart//nl// &
            'purpose '//owner%purpose//nl//last_line//nl
      end associate
   end function text_of

   !> Read who holds a lock
   subroutine read_owner(path, owner, known)
      !> Its file
      character(len=*), intent(in) :: path
      !> Who holds it
      type(owner_type), intent(out) :: owner
      !> Whether a whole lock is there
      logical, intent(out) :: known

      character(len=:), allocatable :: text, number
      integer :: errno, stat

      call read_whole_file(path, text, errno)
      known = index(text, first_line//new_line('a')) == 1 .and. &
         index(text, new_line('a')//last_line//new_line('a')) > 0
      if (.not. known) return
      owner%process%host = value_of('host')
      owner%process%installation = value_of('installation')
      owner%process%boot = value_of('boot')
      owner%process%space = value_of('space')
      owner%since = value_of('since')
      owner%purpose = value_of('purpose')
      owner%batch = value_of('batch')
      owner%restart = value_of('restart')
      number = value_of('process')
      read (number, *, iostat=stat) owner%process%id
      number = value_of('start')
      if (stat == 0) read (number, *, iostat=stat) owner%process%start
      known = stat == 0

   contains

      !> What follows the first word of a line
      function value_of(name) result(value)
         !> The word
         character(len=*), intent(in) :: name
         !> What follows
         character(len=:), allocatable :: value

         integer :: first

         value = ''
         first = index(text, new_line('a')//name//' ')
         if (first == 0) return
         value = text(first + len(name) + 2:)
         value = value(:index(value, new_line('a')) - 1)
      end function value_of

   end subroutine read_owner

   !> The error of a name that another process uses
   subroutine refuse(path, owner, known, own, error)
      !> The lock
      character(len=*), intent(in) :: path
      !> Who holds it, if that is known
      type(owner_type), intent(in) :: owner
      logical, intent(in) :: known
      !> Who wants it
      type(owner_type), intent(in) :: own
      !> The error
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: wait = new_line('a')// &
         'mend: wait until it ends, or choose another directory with -o'

      if (.not. known) then
         call fatal_error(error, exit_in_use, 'another run uses this name, but its lock '//path// &
            ' does not say which'//new_line('a')//'mend: remove '//path//' if no run is under way')
      else if (same_machine(owner%process, own%process)) then
         call fatal_error(error, exit_in_use, 'another run uses this name: process '// &
            to_text(owner%process%id)//' on this host, '//owner%process%host//', since '// &
            owner%since//' ('//owner%purpose//')'//wait//together())
      else
         call fatal_error(error, exit_in_use, 'another run uses this name: process '// &
            to_text(owner%process%id)//' on another host, '//owner%process%host//', since '// &
            owner%since//' ('//owner%purpose//'); whether it still runs cannot be seen from '// &
            own%process%host//wait//'; if it is no more, remove '//path)
      end if
   end subroutine refuse

   !> What to do if both were started as one: a program that knows nothing of MPI runs the same deck in each process
   function together() result(text)
      !> The end of a message; empty if this process was started alone
      character(len=:), allocatable :: text

      character(len=*), parameter :: counts(3) = [character(len=20) :: 'OMPI_COMM_WORLD_SIZE', 'PMI_SIZE', 'SLURM_STEP_NUM_TASKS']
      character(len=:), allocatable :: n
      integer :: k

      text = ''
      do k = 1, size(counts)
         n = environment(trim(counts(k)))
         if (len(n) == 0 .or. n == '1' .or. verify(n, '0123456789') > 0) cycle
         text = '; if that is one of the '//n//' processes that this one was started with, take the program built for MPI, '// &
                'or start one'
         return
      end do
   end function together

   !> The error of a lock that cannot be made
   subroutine cannot_make(path, errno, error)
      !> The lock
      character(len=*), intent(in) :: path
      !> The system's error
      integer, intent(in) :: errno
      !> The error
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, exit_io, 'cannot make the lock '//path//': '//error_text(errno)// &
         new_line('a')//'mend: make room and allow writing there, or choose another directory '// &
         'with -o')
   end subroutine cannot_make

end module axijoint_base_lock
