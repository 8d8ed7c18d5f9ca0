!> A directory for the files of a test, what they hold, and a disk that is full
module axijoint_test_scratch
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_long, c_null_char
   use axijoint_base_system, only : process_id, unlink_path
   use axijoint_base_text, only : to_text
   implicit none
   private
   public :: make_scratch, remove_scratch, make_directory, make_link, write_file, file_bytes
   public :: file_exists, limit_file_size, lift_file_size_limit

   !> Limit of the size of files, for setrlimit (Linux)
   integer(c_int), parameter :: limit_of_file_size = 1_c_int

   !> Soft and hard limit, as setrlimit takes them on 64-bit systems
   type, bind(c) :: limit_type
      !> Bytes
      integer(c_long) :: soft, hard
   end type limit_type

   interface
      function c_mkdir(path, mode) bind(c, name='mkdir')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
         integer(c_int) :: c_mkdir
      end function c_mkdir

      function c_rmdir(path) bind(c, name='rmdir')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int) :: c_rmdir
      end function c_rmdir

      function c_symlink(target, path) bind(c, name='symlink')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: target(*), path(*)
         integer(c_int) :: c_symlink
      end function c_symlink

      function c_getrlimit(resource, limit) bind(c, name='getrlimit')
         import :: c_int, limit_type
         integer(c_int), value :: resource
         type(limit_type), intent(out) :: limit
         integer(c_int) :: c_getrlimit
      end function c_getrlimit

      function c_setrlimit(resource, limit) bind(c, name='setrlimit')
         import :: c_int, limit_type
         integer(c_int), value :: resource
         type(limit_type), intent(in) :: limit
         integer(c_int) :: c_setrlimit
      end function c_setrlimit
   end interface

contains

   !> Make an empty directory
   function make_scratch() result(directory)
      !> Its path
      character(len=:), allocatable :: directory

      character(len=256) :: parent
      integer :: status

      call get_environment_variable('TMPDIR', parent, status=status)
      if (status /= 0) parent = '/tmp'
      directory = trim(parent)//'/axijoint_test_'//to_text(process_id())
      call make_directory(directory)
   end function make_scratch

   !> Make a directory
   subroutine make_directory(path)
      !> Its path
      character(len=*), intent(in) :: path

      if (c_mkdir(path//c_null_char, int(o'700', c_int)) /= 0_c_int) error stop 'mkdir failed'
   end subroutine make_directory

   !> Make a symbolic link
   subroutine make_link(target, path)
      !> Where it leads, and its path
      character(len=*), intent(in) :: target, path

      if (c_symlink(target//c_null_char, path//c_null_char) /= 0_c_int) error stop 'symlink failed'
   end subroutine make_link

   !> Remove a directory with the files named; anything else in it is an error,
   !> as a test left it behind
   subroutine remove_scratch(directory, files, empty)
      !> The directory
      character(len=*), intent(in) :: directory
      !> Names of files that may be in it
      character(len=*), intent(in) :: files(:)
      !> Whether nothing else was in it
      logical, intent(out) :: empty

      integer :: i, errno

      do i = 1, size(files)
         call unlink_path(directory//'/'//trim(files(i)), errno)
      end do
      empty = c_rmdir(directory//c_null_char) == 0_c_int
   end subroutine remove_scratch

   !> Write a small file
   subroutine write_file(path, text)
      !> Its path
      character(len=*), intent(in) :: path
      !> Its bytes
      character(len=*), intent(in) :: text

      integer :: unit

      open (newunit=unit, file=path, access='stream', form='unformatted', status='replace')
      write (unit) text
      close (unit)
   end subroutine write_file

   !> All bytes of a file
   function file_bytes(path) result(bytes)
      !> Its path
      character(len=*), intent(in) :: path
      !> The bytes
      character(len=:), allocatable :: bytes

      integer :: unit, length

      open (newunit=unit, file=path, access='stream', form='unformatted', status='old', &
         action='read')
      inquire (unit=unit, size=length)
      allocate (character(len=length) :: bytes)
      read (unit) bytes
      close (unit)
   end function file_bytes

   !> Whether a file is there
   logical function file_exists(path)
      !> Its path
      character(len=*), intent(in) :: path

      inquire (file=path, exist=file_exists)
   end function file_exists

   !> Let writing fail beyond a size, as it does on a full disk
   subroutine limit_file_size(bytes)
      !> Largest size of a file
      integer, intent(in) :: bytes

      type(limit_type) :: limit

      if (c_getrlimit(limit_of_file_size, limit) /= 0_c_int) error stop 'getrlimit failed'
      limit%soft = int(bytes, c_long)
      if (c_setrlimit(limit_of_file_size, limit) /= 0_c_int) error stop 'setrlimit failed'
   end subroutine limit_file_size

   !> Let files grow again
   subroutine lift_file_size_limit()
      type(limit_type) :: limit

      if (c_getrlimit(limit_of_file_size, limit) /= 0_c_int) error stop 'getrlimit failed'
      limit%soft = limit%hard
      if (c_setrlimit(limit_of_file_size, limit) /= 0_c_int) error stop 'setrlimit failed'
   end subroutine lift_file_size_limit

end module axijoint_test_scratch
