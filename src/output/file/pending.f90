!> Files that appear under their final name only when they are complete: a
!> temporary name in the same directory, then one rename
module axijoint_output_file_pending
   use axijoint_base_error, only : error_type, fatal_error, exit_io
   use axijoint_base_process, only : host_name
   use axijoint_base_system, only : process_id, path_kind, path_absent, path_file, path_directory, path_link, &
      rename_path, sync_path, unlink_path, error_text
   use axijoint_base_text, only : to_text
   use axijoint_base_whole_file, only : is_too_long
   implicit none
   private
   public :: temporary_path, backup_path, publish, discard, sync_file, sync_names, join_path, io_error, check_name

contains

   !> Name under which a file is written until it is complete. It holds the host and the
   !> number of the process, so two runs never write the same file.
   function temporary_path(path) result(temporary)
      !> Final path
      character(len=*), intent(in) :: path
      !> Path in the same directory
      character(len=:), allocatable :: temporary

      temporary = path//"."//host_name()//"."//to_text(process_id())//".tmp"
   end function temporary_path

   !> Name under which an earlier file is kept while others are put in the place of it and its like
   function backup_path(path) result(backup)
      !> Final path
      character(len=*), intent(in) :: path
      !> Path in the same directory
      character(len=:), allocatable :: backup

      backup = path//".earlier."//host_name()//"."//to_text(process_id())//".tmp"
   end function backup_path

   !> Wait until a complete file is on the disk, under its temporary name
   subroutine sync_file(path, error)
      !> Final path
      character(len=*), intent(in) :: path
      !> Some of it is not on the disk
      type(error_type), allocatable, intent(out) :: error

      integer :: errno

      call sync_path(temporary_path(path), errno)
      if (errno /= 0) call io_error(error, "write", path, errno)
   end subroutine sync_file

   !> Give the complete file its final name when it is on the disk, replacing an earlier file
   subroutine publish(path, error, lasting)
      !> Final path
      character(len=*), intent(in) :: path
      !> It is not on the disk, or the rename failed; the earlier file stands
      type(error_type), allocatable, intent(out) :: error
      !> Whether to wait for the disk; true if absent
      logical, intent(in), optional :: lasting

      integer :: errno
      logical :: waits

      waits = .true.
      if (present(lasting)) waits = lasting
      if (waits) call sync_file(path, error)
      if (allocated(error)) return
      call rename_path(temporary_path(path), path, errno)
      if (errno /= 0) call io_error(error, "give its final name to", path, errno)
   end subroutine publish

   !> Remove the temporary file if there is one
   subroutine discard(path)
      !> Final path
      character(len=*), intent(in) :: path

      integer :: errno

      call unlink_path(temporary_path(path), errno)
   end subroutine discard

   !> Bring the names in a directory to the disk. The files stand complete
   !> without it; that their names survive a power cut is worth an attempt, but
   !> not every file system allows it, so a failure is passed over.
   subroutine sync_names(directory)
      !> The directory; empty for the current one
      character(len=*), intent(in) :: directory

      integer :: errno

      call sync_path(join_path(directory, "."), errno)
   end subroutine sync_names

   !> Path of a file in a directory
   pure function join_path(directory, name) result(path)
      !> Directory; empty for the current one
      character(len=*), intent(in) :: directory
      !> Name of the file
      character(len=*), intent(in) :: name
      !> Path of the file
      character(len=:), allocatable :: path

      integer :: length

      length = len(directory)
      if (length == 0) then
         path = name
      else if (directory(length:length) == "/") then
         path = directory(:length)//name
      else
         path = directory(:length)//"/"//name
      end if
   end function join_path

   !> A final name is free or of a regular file: a link might lead anywhere, and a directory or a
   !> device cannot be replaced
   subroutine check_name(path, mend, error)
      !> The path
      character(len=*), intent(in) :: path
      !> What to do if it is taken
      character(len=*), intent(in) :: mend
      !> The name is taken
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: found
      integer :: kind

      kind = path_kind(path)
      if (kind == path_absent .or. kind == path_file) return
      found = "is neither a file nor free"
      if (kind == path_link) found = "is a symbolic link"
      if (kind == path_directory) found = "is a directory"
      if (kind < 0) found = "cannot be reached: "//error_text(-kind)
      if (is_too_long(-kind)) then
         call io_error(error, "write", path, -kind)
         return
      end if
      call fatal_error(error, exit_io, path//" "//found//new_line("a")//"mend: "//mend)
   end subroutine check_name

   !> Make the error of a file that could not be written
   subroutine io_error(error, action, path, errno)
      !> The new error
      type(error_type), allocatable, intent(out) :: error
      !> What failed, such as "write"
      character(len=*), intent(in) :: action
      !> Final path of the file
      character(len=*), intent(in) :: path
      !> The system's error, zero if it is not known
      integer, intent(in) :: errno

      character(len=:), allocatable :: cause, mend

      cause = "the system gives no cause"
      if (errno /= 0) cause = error_text(errno)
      mend = "make room and allow writing there, or choose another directory (of run, study and envelope by -o); "// &
         "an earlier file of this name is left as it was"
      if (is_too_long(errno)) mend = "a shorter name, or a shorter path: endings are added to it"
      call fatal_error(error, exit_io, "cannot "//action//" "//path//": "//cause//new_line("a")// &
         "mend: "//mend)
   end subroutine io_error

end module axijoint_output_file_pending
