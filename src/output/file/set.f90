!> Several files that get their final names as one. A journal lists them before the first does; from
!> then on a run that dies is brought to its end by the next (`finish_set`), and a name that cannot
!> be given brings back all earlier files. Without the journal the files in place are of one run.
!>
!> Waiting for a disk takes longer than all else that small jobs do. Every file has to be on it before it gets its
!> name; the journal and the names only where files of an earlier run are replaced, which a power cut could leave
!> beside those of this one.
module axijoint_output_file_set
   use axijoint_base_error, only : error_type, fatal_error, exit_io
   use axijoint_base_system, only : path_kind, path_absent, rename_path, unlink_path
   use axijoint_base_whole_file, only : link_path, knows_no_links, is_not_there, &
      read_whole_file, write_new_file
   use axijoint_output_file_pending, only : temporary_path, backup_path, io_error, join_path, &
      sync_file, sync_names, publish, discard
   implicit none
   private
   public :: commit_set, finish_set

   !> First and last line of a journal, and what stands between the names of a file
   character(len=*), parameter :: first_line = 'axijoint commit 1', last_line = 'end'
   character(len=1), parameter :: nl = new_line('a'), between = achar(9)

contains

   !> Give complete files their final names: all of them, or none
   subroutine commit_set(directory, journal, names, halfway, error)
      !> Directory of the files
      character(len=*), intent(in) :: directory
      !> Name of the journal
      character(len=*), intent(in) :: journal
      !> Final names of the files, each complete under its temporary name
      character(len=*), intent(in) :: names(:)
      !> Whether neither all could be given nor the earlier ones be brought back: the files are
      !> needed as they are, for the next run
      logical, intent(out) :: halfway
      !> A file is not on the disk, or a name could not be given
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: path
      integer :: errno, k, n
      logical :: replaces

      halfway = .false.
      replaces = any([(path_kind(join_path(directory, trim(names(k)))) /= path_absent, k=1, size(names))])
      call write_journal(directory, journal, names, error)
      if (allocated(error)) return
      ! the journal with the rest: the first file takes what the disk has to note of the others, too
      do k = 1, size(names)
         if (.not. allocated(error)) call sync_file(join_path(directory, trim(names(k))), error)
      end do
      path = join_path(directory, journal)
      if (.not. allocated(error)) call publish(path, error, lasting=replaces)
      if (allocated(error)) then
         call discard(path)
         return
      end if
      if (replaces) call sync_names(directory)
      do k = 1, size(names)
         path = join_path(directory, trim(names(k)))
         call set_aside(path, errno)
         if (errno == 0) call rename_path(temporary_path(path), path, errno)
         if (errno /= 0) exit
      end do
      if (errno /= 0) then
         n = k
         call io_error(error, 'give its final name to', path, errno)
         do k = n, 1, -1
            call bring_back(join_path(directory, trim(names(k))), k < n, errno)
            if (errno /= 0) exit
         end do
         halfway = errno /= 0
         if (halfway) then
            error%message = error%message//'; files of two runs stand there until the next run '// &
               'of this name mends that: '//join_path(directory, journal)
            return
         end if
      end if
      if (replaces) call sync_names(directory)
      call unlink_path(join_path(directory, journal), errno)
      if (.not. replaces) return
      do k = 1, size(names)
         call unlink_path(backup_path(join_path(directory, trim(names(k)))), errno)
      end do
   end subroutine commit_set

   !> Give the names that a run which died could not give any more
   subroutine finish_set(directory, journal, finished, error)
      !> Directory of the files
      character(len=*), intent(in) :: directory
      !> Name of the journal
      character(len=*), intent(in) :: journal
      !> Whether there was something to finish
      logical, intent(out) :: finished
      !> A name could not be given
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: path, text, temporary, final
      integer :: errno, first, last, tab

      path = join_path(directory, journal)
      finished = .false.
      if (path_kind(path) == path_absent) return
      call read_whole_file(path, text, errno)
      if (errno == 0 .and. len(text) == 0) then  ! a power cut took what was not waited for: nothing was replaced
         call unlink_path(path, errno)
         return
      end if
      if (index(text, first_line//nl) /= 1 .or. index(text, nl//last_line//nl) == 0) then
         call fatal_error(error, exit_io, path//' does not say which files were about to get '// &
            'their names'//nl// &
            'mend: remove it; then look whether the results there are of one run')
         return
      end if
      first = len(first_line) + 2
      do
         last = first + index(text(first:), nl) - 2
         if (text(first:last) == last_line) exit
         tab = first + index(text(first:last), between) - 1
         temporary = join_path(directory, text(first:tab - 1))
         final = join_path(directory, text(tab + 1:last))
         if (path_kind(temporary) /= path_absent) then  ! else it had its name already
            call rename_path(temporary, final, errno)
            if (errno /= 0) then
               call io_error(error, 'give its final name to', final, errno)
               return
            end if
            finished = .true.
         end if
         first = last + 2
      end do
      call sync_names(directory)
      call unlink_path(path, errno)
   end subroutine finish_set

   !> List the files, under a temporary name still
   subroutine write_journal(directory, journal, names, error)
      !> Directory of the files
      character(len=*), intent(in) :: directory
      !> Name of the journal
      character(len=*), intent(in) :: journal
      !> Final names
      character(len=*), intent(in) :: names(:)
      !> It could not be written
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: path, text
      integer :: errno, k

      text = first_line//nl
      do k = 1, size(names)
         text = text//temporary_path(trim(names(k)))//between//trim(names(k))//nl
      end do
      text = text//last_line//nl
      path = join_path(directory, journal)
      call discard(path)
      call write_new_file(temporary_path(path), text, errno, lasting=.false.)
      if (errno == 0) return
      call discard(path)
      call io_error(error, 'write', path, errno)
   end subroutine write_journal

   !> Keep an earlier file under another name until all is done; where files cannot have two names
   !> the place is empty for a moment
   subroutine set_aside(path, errno)
      !> Its final name
      character(len=*), intent(in) :: path
      !> Zero, or the system's error
      integer, intent(out) :: errno

      call unlink_path(backup_path(path), errno)
      call link_path(path, backup_path(path), errno)
      if (knows_no_links(errno)) call rename_path(path, backup_path(path), errno)
      if (is_not_there(errno)) errno = 0
   end subroutine set_aside

   !> Bring an earlier file back. The new one gets its temporary name again first: if the run dies
   !> in between, the journal still gives it its final one
   subroutine bring_back(path, placed, errno)
      !> Its final name
      character(len=*), intent(in) :: path
      !> Whether the new file stands there
      logical, intent(in) :: placed
      !> Zero, or the system's error
      integer, intent(out) :: errno

      logical :: earlier

      errno = 0
      earlier = path_kind(backup_path(path)) /= path_absent
      if (placed) then
         call link_path(path, temporary_path(path), errno)
         if (knows_no_links(errno)) call rename_path(path, temporary_path(path), errno)
         if (errno /= 0) return
      end if
      if (earlier) then
         call rename_path(backup_path(path), path, errno)
      else if (placed) then
         call unlink_path(path, errno)
         if (is_not_there(errno)) errno = 0
      end if
   end subroutine bring_back

end module axijoint_output_file_set
