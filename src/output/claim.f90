!> Who may write the files of a name: locks, and what runs that died left there
module axijoint_output_claim
   use axijoint_base_error, only : error_type, fatal_error, exit_io
   use axijoint_base_lock, only : lock_type, take_lock, release_lock
   use axijoint_base_process, only : host_name, runs_here
   use axijoint_base_system, only : process_id, path_kind, path_link, same_file, unlink_path
   use axijoint_base_text, only : to_text, count_of
   use axijoint_base_whole_file, only : names_in
   use axijoint_deck_text_source, only : source_type
   use axijoint_job_combination, only : combination_label
   use axijoint_job_job, only : job_type, job_name, deck_name, result_name
   use axijoint_output_file_names, only : endings, lock_ending, journal_ending, state_ending, &
      table_ending
   use axijoint_output_file_pending, only : join_path
   use axijoint_output_file_set, only : finish_set
   implicit none
   private
   public :: claim_type, claim_output, claim_names, release_output, spare_sources

   !> Ending of files that are not complete
   character(len=*), parameter :: temporary_ending = '.tmp'

   !> The names of a job, which no other run may write meanwhile
   type :: claim_type
      private
      !> The name of the job, and those of its combinations if they are others
      type(lock_type), allocatable :: locks(:)
      !> Files of the folder whose names begin with that of the job and a point, as they were then, each followed by a line feed
      character(len=:), allocatable, public :: beside
   contains
      !> Whether they are held
      procedure :: held
   end type claim_type

contains

   !> Take the names of a job, bring to its end what a run that died began to rename, and remove
   !> what it did not complete
   subroutine claim_output(job, claim, notes, error)
      !> The job
      type(job_type), intent(in) :: job
      !> Its names
      type(claim_type), intent(out) :: claim
      !> What was found and done, a line each
      character(len=:), allocatable, intent(out) :: notes
      !> Another run has one of them, or something cannot be written
      type(error_type), allocatable, intent(out) :: error

      call claim_names(job%options%directory, names_of(job), 'run '//deck_name(job%deck), claim, &
         notes, error)
   end subroutine claim_output

   !> Take names in a directory
   subroutine claim_names(directory, names, purpose, claim, notes, error)
      !> The directory, which is there
      character(len=*), intent(in) :: directory
      !> Names of files without their endings
      character(len=*), intent(in) :: names(:)
      !> What they are taken for, a line that others are told
      character(len=*), intent(in) :: purpose
      !> The names
      type(claim_type), intent(out) :: claim
      !> What was found and done, a line each
      character(len=:), allocatable, intent(out) :: notes
      !> Another process has one of them, or something cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, temporary
      integer :: k, removed
      logical :: finished

      notes = ''
      removed = 0
      allocate (claim%locks(size(names)))
      do k = 1, size(names)
         name = trim(names(k))
         call take_lock(join_path(directory, name//lock_ending), purpose, claim%locks(k), error)
         if (allocated(error)) exit
         if (claim%locks(k)%inherited) call add('the lock of a run that did not end was '// &
            'taken over: '//join_path(directory, name//lock_ending))
         call finish_set(directory, name//journal_ending, finished, error)
         if (allocated(error)) exit
         if (finished) call add('the files of an earlier run that died while it gave them '// &
            'their names have them now: '//join_path(directory, name)//'.*')
      end do
      if (.not. allocated(error)) then
         ! folders of many results take long to read, and those of other machines longer: once is enough for names that go on from the
         ! first, as those of combinations do
         claim%beside = names_in(join_path(directory, '.'), trim(names(1))//'.', '')
         temporary = temporary_among(claim%beside, trim(names(1)))
         do k = 1, size(names)
            name = trim(names(k))
            if (index(name//'.', trim(names(1))//'.') == 1) then
               call remove_leftovers(directory, name, temporary, removed)
            else
               call remove_leftovers(directory, name, names_in(join_path(directory, '.'), name//'.', temporary_ending), removed)
            end if
         end do
      end if
      if (removed > 0) call add(count_of(removed, 'file')//' that earlier runs did not '// &
         'complete '//trim(merge('was ', 'were', removed == 1))//' removed')
      if (allocated(error)) call release_output(claim)

   contains

      !> Add a line to the notes
      subroutine add(line)
         !> The line
         character(len=*), intent(in) :: line

         if (len(notes) > 0) notes = notes//new_line('a')
         notes = notes//'axijoint: '//line
      end subroutine add

   end subroutine claim_names

   !> Whether the names are held
   pure logical function held(self)
      !> The names
      class(claim_type), intent(in) :: self

      held = allocated(self%locks)
   end function held

   !> Give the names back
   subroutine release_output(claim)
      !> Names of a job, or none
      type(claim_type), intent(inout) :: claim

      integer :: k

      if (.not. allocated(claim%locks)) return
      do k = size(claim%locks), 1, -1
         call release_lock(claim%locks(k))
      end do
      deallocate (claim%locks)
   end subroutine release_output

   !> The name of a job, and those of its results if they are others
   function names_of(job) result(names)
      !> The job
      type(job_type), intent(in) :: job
      !> The names
      character(len=:), allocatable :: names(:)

      integer :: k, n

      n = size(job%model%combinations)
      if (n == 1) then
         allocate (character(len=len(job_name(job%deck))) :: names(1))
         names(1) = job_name(job%deck)
         return
      end if
      allocate (character(len=len(job_name(job%deck)) + 12) :: names(n + 1))
      names(1) = job_name(job%deck)
      do k = 1, n
         names(k + 1) = result_name(job, combination_label(job, k))
      end do
   end function names_of

   !> Refuse a name under which a file of the deck would be replaced, or removed as what an earlier run
   !> left
   subroutine spare_sources(directory, name, written, source, what, error)
      !> Directory of the files
      character(len=*), intent(in) :: directory
      !> Their name
      character(len=*), intent(in) :: name
      !> Endings of those that are written or removed
      character(len=*), intent(in) :: written(:)
      !> The deck, with the files that it includes
      type(source_type), intent(in) :: source
      !> What that is, such as "the deck"
      character(len=*), intent(in) :: what
      !> The file in danger
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: names, path
      logical :: lost
      integer :: k, ending, first, last

      do k = 1, source%n_files
         path = source%files(k)%path
         lost = .false.
         do ending = 1, size(written)
            if (same_file(join_path(directory, name//trim(written(ending))), path)) lost = .true.
         end do
         if (path_kind(path) == path_link) then  ! to any of them
            names = names_in(join_path(directory, '.'), name//'.', temporary_ending)
         else
            names = path(index(path, '/', back=.true.) + 1:)//new_line('a')
         end if
         first = 1
         do while (first <= len(names))
            last = first + index(names(first:), new_line('a')) - 2
            if (may_be_leftover(names(first:last), name)) then
               if (is_leftover(names(first + len(name):last))) then
                  if (same_file(join_path(directory, names(first:last)), path)) lost = .true.
               end if
            end if
            first = last + 2
         end do
         if (.not. lost) cycle
         call fatal_error(error, exit_io, 'the run would overwrite or remove '//source%files(k)%path// &
            ', a file of '//what//new_line('a')//'mend: another name for that file or the deck, or another directory with -o')
         return
      end do
   end subroutine spare_sources

   !> Those of some files, each followed by a line feed, that may be temporary ones of a job
   function temporary_among(names, name) result(temporary)
      !> The files
      character(len=*), intent(in) :: names
      !> Name of the job
      character(len=*), intent(in) :: name
      !> Those, each followed by a line feed
      character(len=:), allocatable :: temporary

      integer :: first, last

      temporary = ''
      first = 1
      do while (first <= len(names))
         last = first + index(names(first:), new_line('a')) - 2
         if (may_be_leftover(names(first:last), name)) temporary = temporary//names(first:last + 1)
         first = last + 2
      end do
   end function temporary_among

   !> Remove the temporary files of a name, which nobody else may write now. Those of a
   !> process that runs are left alone all the same: somebody may have removed its lock
   subroutine remove_leftovers(directory, name, names, removed)
      !> Directory of the files
      character(len=*), intent(in) :: directory
      !> The name
      character(len=*), intent(in) :: name
      !> Files there, each followed by a line feed
      character(len=*), intent(in) :: names
      !> Counts them
      integer, intent(inout) :: removed

      integer :: first, last, errno

      first = 1
      do while (first <= len(names))
         last = first + index(names(first:), new_line('a')) - 2
         if (may_be_leftover(names(first:last), name)) then
            if (is_leftover(names(first + len(name):last))) then
               call unlink_path(join_path(directory, names(first:last)), errno)
               if (errno == 0) removed = removed + 1
            end if
         end if
         first = last + 2
      end do
   end subroutine remove_leftovers

   !> Whether a file has such a name as those of a job that are not complete
   pure logical function may_be_leftover(file, name)
      !> The file, without its folder
      character(len=*), intent(in) :: file
      !> Name of the job
      character(len=*), intent(in) :: name

      may_be_leftover = index(file, name//'.') == 1 .and. len(file) >= len(name//'.'//temporary_ending)
      if (may_be_leftover) may_be_leftover = file(len(file) - len(temporary_ending) + 1:) == temporary_ending
   end function may_be_leftover

   !> Whether a temporary file is of a process that has ended
   logical function is_leftover(rest)
      !> What follows the name of the job: ending, host, process
      character(len=*), intent(in) :: rest

      integer :: dot, last, process, stat
      logical :: ours

      ours = index(rest, state_ending//'.') == 1 .or. index(rest, journal_ending//'.') == 1 &
         .or. index(rest, lock_ending//'.') == 1
      ours = ours .or. index(rest, table_ending//'.') == 1
      do dot = 1, size(endings)
         ours = ours .or. index(rest, trim(endings(dot))//'.') == 1
      end do
      is_leftover = .false.
      if (.not. ours) return
      last = len(rest) - len(temporary_ending)
      dot = index(rest(:last), '.', back=.true.)
      ! what stands for a dead owner of the lock while it is taken over; nobody needs it any more
      is_leftover = index(rest, lock_ending) == 1 .and. index(rest(dot:last), '-') > 0
      if (is_leftover) return
      read (rest(dot + 1:last), *, iostat=stat) process
      if (stat /= 0) return
      if (index(rest(:dot), '.'//host_name()//'.') > 0) then
         is_leftover = process == process_id()  ! the number was given anew
         if (.not. is_leftover) is_leftover = .not. runs_here(process)
      else  ! of another host, that may just be asking for the lock
         is_leftover = index(rest, lock_ending) /= 1
      end if
   end function is_leftover

end module axijoint_output_claim
