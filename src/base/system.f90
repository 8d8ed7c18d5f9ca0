!> The operating system: paths, memory, process, terminal
module axijoint_base_system
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_long, c_null_char, c_size_t
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: path_kind, target_kind, is_directory, same_file, rename_path, unlink_path, sync_path, start_sync
   public :: peak_memory_mb, forget_peak_memory, process_id, error_output_is_terminal
   public :: return_freed_memory, keep_freed_memory, ignore_file_size_signal, last_error, set_last_error, error_text
   public :: make_directories, read_standard_input, append_to_file
   public :: path_absent, path_file, path_directory, path_link, path_other

   !> Nothing has this name
   integer, parameter :: path_absent = 0
   !> Regular file
   integer, parameter :: path_file = 1
   !> Directory
   integer, parameter :: path_directory = 2
   !> Symbolic link, whatever it leads to
   integer, parameter :: path_link = 3
   !> Device, pipe or socket
   integer, parameter :: path_other = 4

   !> File descriptor of the standard error output
   integer(c_int), parameter :: standard_error = 2_c_int
   !> Longest text of a system error
   integer, parameter :: max_error_text = 256

   interface
      !> What a path is; system_shim.c
      function c_path_kind(path) bind(c, name="axijoint_path_kind")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int) :: c_path_kind
      end function c_path_kind

      !> What a path leads to; system_shim.c
      function c_target_kind(path) bind(c, name="axijoint_target_kind")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int) :: c_target_kind
      end function c_target_kind

      !> Whether two paths lead to one file; system_shim.c
      function c_same_file(first, second) bind(c, name="axijoint_same_file")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: first(*), second(*)
         integer(c_int) :: c_same_file
      end function c_same_file

      !> Bring a file or directory to the disk; system_shim.c
      function c_sync_path(path) bind(c, name="axijoint_sync_path")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int) :: c_sync_path
      end function c_sync_path

      !> Let a file go to the disk without waiting; system_shim.c
      subroutine c_start_sync(path) bind(c, name="axijoint_start_sync")
         import :: c_char
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_start_sync

      !> POSIX rename
      function c_rename(from, to) bind(c, name="rename")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: from(*), to(*)
         integer(c_int) :: c_rename
      end function c_rename

      !> POSIX mkdir
      function c_mkdir(path, mode) bind(c, name="mkdir")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
         integer(c_int) :: c_mkdir
      end function c_mkdir

      !> POSIX read; the result has the width of a size
      function c_read(descriptor, buffer, count) bind(c, name="read")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(out) :: buffer(*)
         integer(c_size_t), value :: count
         integer(c_size_t) :: c_read
      end function c_read

      !> Append to a file; system_shim.c
      function c_append(path, bytes, size, durable) bind(c, name="axijoint_append")
         import :: c_char, c_int, c_size_t
         character(kind=c_char), intent(in) :: path(*), bytes(*)
         integer(c_size_t), value :: size
         integer(c_int), value :: durable
         integer(c_int) :: c_append
      end function c_append

      !> POSIX unlink
      function c_unlink(path) bind(c, name="unlink")
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int) :: c_unlink
      end function c_unlink

      !> Largest resident memory; system_shim.c
      function c_peak_memory() bind(c, name="axijoint_peak_memory")
         import :: c_long
         integer(c_long) :: c_peak_memory
      end function c_peak_memory

      !> Count that memory anew; system_shim.c
      subroutine forget_peak_memory() bind(c, name="axijoint_forget_peak_memory")
      end subroutine forget_peak_memory

      !> POSIX getpid
      function c_getpid() bind(c, name="getpid")
         import :: c_int
         integer(c_int) :: c_getpid
      end function c_getpid

      !> POSIX isatty
      function c_isatty(descriptor) bind(c, name="isatty")
         import :: c_int
         integer(c_int), value :: descriptor
         integer(c_int) :: c_isatty
      end function c_isatty

      !> Have memory back from the heap; system_shim.c
      subroutine c_return_freed_memory() bind(c, name="axijoint_return_freed_memory")
      end subroutine c_return_freed_memory

      !> Keep what is freed; system_shim.c
      subroutine c_keep_freed_memory(mebibytes) bind(c, name="axijoint_keep_freed_memory")
         import :: c_int
         integer(c_int), value :: mebibytes
      end subroutine c_keep_freed_memory

      !> Ignore SIGXFSZ; system_shim.c
      subroutine c_ignore_file_size_signal() bind(c, name="axijoint_ignore_file_size_signal")
      end subroutine c_ignore_file_size_signal

      !> Value of errno; system_shim.c
      function c_get_errno() bind(c, name="axijoint_get_errno")
         import :: c_int
         integer(c_int) :: c_get_errno
      end function c_get_errno

      !> Set errno; system_shim.c
      subroutine c_set_errno(error) bind(c, name="axijoint_set_errno")
         import :: c_int
         integer(c_int), value :: error
      end subroutine c_set_errno

      !> Words for an errno value; system_shim.c
      subroutine c_error_text(error, text, size) bind(c, name="axijoint_error_text")
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: error
         character(kind=c_char), intent(out) :: text(*)
         integer(c_size_t), value :: size
      end subroutine c_error_text
   end interface

contains

   !> What a path is, without following a link; the negative errno if the
   !> path cannot be looked at
   integer function path_kind(path)
      !> The path
      character(len=*), intent(in) :: path
      path_kind = int(c_path_kind(path//c_null_char))
   end function path_kind

   !> What a path leads to, links followed; the negative errno if that cannot be looked at
   integer function target_kind(path)
      !> The path
      character(len=*), intent(in) :: path
      target_kind = int(c_target_kind(path//c_null_char))
   end function target_kind

   !> Whether a path leads to a directory, links followed
   logical function is_directory(path)
      !> The path
      character(len=*), intent(in) :: path
      is_directory = target_kind(path) == path_directory
   end function is_directory

   !> Whether two paths lead to one file, links followed
   logical function same_file(first, second)
      !> The paths
      character(len=*), intent(in) :: first, second
      same_file = c_same_file(first//c_null_char, second//c_null_char) == 1_c_int
   end function same_file

   !> Give a file another name in one step, replacing a file of that name
   subroutine rename_path(from, to, errno)
      !> Old and new path, on one file system
      character(len=*), intent(in) :: from, to
      !> Zero, or the system's error
      integer, intent(out) :: errno

      errno = 0
      if (c_rename(from//c_null_char, to//c_null_char) /= 0_c_int) errno = last_error()
   end subroutine rename_path

   !> Make a directory and those above it that are not there
   subroutine make_directories(path, errno)
      !> The directory
      character(len=*), intent(in) :: path
      !> Zero, or the system's error
      integer, intent(out) :: errno

      integer(c_int), parameter :: all_may = 511_c_int  ! less what the user's mask says
      integer :: last

      errno = 0
      do last = 1, len(path)
         if (last < len(path)) then
            if (path(last + 1:last + 1) /= "/") cycle
         end if
         if (is_directory(path(:last))) cycle
         ! another process may be first
         if (c_mkdir(path(:last)//c_null_char, all_may) /= 0_c_int) errno = last_error()
         if (is_directory(path(:last))) errno = 0
         if (errno /= 0) return
      end do
   end subroutine make_directories

   !> All that comes from the standard input
   subroutine read_standard_input(bytes, errno)
      !> The bytes
      character(len=:), allocatable, intent(out) :: bytes
      !> Zero, or the system's error
      integer, intent(out) :: errno

      integer, parameter :: block = 65536
      character(kind=c_char) :: buffer(block)
      character(len=:), allocatable :: larger
      integer :: i, n, used

      errno = 0
      used = 0
      allocate (character(len=block) :: bytes)
      do
         n = int(c_read(0_c_int, buffer, int(block, c_size_t)))
         if (n < 0) errno = last_error()
         if (n <= 0) exit
         if (used + n > len(bytes)) then
            allocate (character(len=2*len(bytes)) :: larger)
            larger(:used) = bytes(:used)
            call move_alloc(larger, bytes)
         end if
         do i = 1, n
            bytes(used + i:used + i) = buffer(i)
         end do
         used = used + n
      end do
      bytes = bytes(:used)
   end subroutine read_standard_input

   !> Append to a file, which is made if it is not there
   subroutine append_to_file(path, bytes, durable, errno)
      !> The file
      character(len=*), intent(in) :: path
      !> The bytes
      character(len=*), intent(in) :: bytes
      !> Whether they are to be on the disk then
      logical, intent(in) :: durable
      !> Zero, or the system's error
      integer, intent(out) :: errno

      call ignore_file_size_signal()
      errno = int(c_append(path//c_null_char, bytes, int(len(bytes), c_size_t), &
                           merge(1_c_int, 0_c_int, durable)))
   end subroutine append_to_file

   !> Remove a file
   subroutine unlink_path(path, errno)
      !> The file
      character(len=*), intent(in) :: path
      !> Zero, or the system's error
      integer, intent(out) :: errno

      errno = 0
      if (c_unlink(path//c_null_char) /= 0_c_int) errno = last_error()
   end subroutine unlink_path

   !> Wait until a file's bytes, or a directory's entries, are on the disk
   subroutine sync_path(path, errno)
      !> File or directory
      character(len=*), intent(in) :: path
      !> Zero, or the system's error
      integer, intent(out) :: errno

      errno = int(c_sync_path(path//c_null_char))
   end subroutine sync_path

   !> Let a file's bytes go to the disk without waiting for them, so that `sync_path` waits less
   subroutine start_sync(path)
      !> The file
      character(len=*), intent(in) :: path

      call c_start_sync(path//c_null_char)
   end subroutine start_sync

   !> Largest memory that the process held so far [megabyte of 2**20 bytes];
   !> negative if the system does not tell
   real(wp) function peak_memory_mb()
      integer(c_long) :: kilobytes

      kilobytes = c_peak_memory()
      peak_memory_mb = -1.0_wp
      if (kilobytes >= 0_c_long) peak_memory_mb = real(kilobytes, wp)/1024.0_wp
   end function peak_memory_mb

   !> Number of this process
   integer function process_id()
      process_id = int(c_getpid())
   end function process_id

   !> Whether the standard error output goes to a terminal
   logical function error_output_is_terminal()
      integer :: length

      error_output_is_terminal = c_isatty(standard_error) == 1_c_int
      call get_environment_variable('AXIJOINT_PROGRESS', length=length)
      if (length > 0) error_output_is_terminal = .false.  ! of several processes, which show none
   end function error_output_is_terminal

   !> From now on give large arrays back to the system as soon as they are freed
   subroutine return_freed_memory()
      call c_return_freed_memory()
   end subroutine return_freed_memory

   !> From now on keep what is freed, for arrays of the same size that follow
   subroutine keep_freed_memory(mebibytes)
      !> How much of it at most [MiB]
      integer, intent(in) :: mebibytes

      call c_keep_freed_memory(int(mebibytes, c_int))
   end subroutine keep_freed_memory

   !> Let a write beyond the limit on file sizes fail instead of ending the
   !> process by a signal
   subroutine ignore_file_size_signal()
      call c_ignore_file_size_signal()
   end subroutine ignore_file_size_signal

   !> The system's error number as the last failed call left it
   integer function last_error()
      last_error = int(c_get_errno())
   end function last_error

   !> Set the error number, to zero before a call whose own error is unclear
   subroutine set_last_error(errno)
      !> New value
      integer, intent(in) :: errno
      call c_set_errno(int(errno, c_int))
   end subroutine set_last_error

   !> The system's words for an error number
   function error_text(errno) result(text)
      !> Error number
      integer, intent(in) :: errno
      !> Words, such as "No space left on device"
      character(len=:), allocatable :: text

      character(kind=c_char) :: buffer(max_error_text)
      integer :: i

      call c_error_text(int(errno, c_int), buffer, int(max_error_text, c_size_t))
      text = ""
      do i = 1, max_error_text
         if (buffer(i) == c_null_char) exit
         text = text//buffer(i)
      end do
   end function error_text

end module axijoint_base_system
