!> Files that are read and written whole, second names, and the names in a folder
module axijoint_base_whole_file
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_int64_t, c_null_char
   use axijoint_base_kinds, only : i8
   implicit none
   private
   public :: write_new_file, read_whole_file, first_bytes, read_first_bytes, file_size, link_path, names_in
   public :: knows_no_links, is_there, is_not_there, is_too_long

   interface
      !> Make a file of some bytes; whole_file_shim.c
      function c_write_new(path, bytes, count, lasting) bind(c, name='axijoint_write_new')
         import :: c_char, c_int, c_int64_t
         character(kind=c_char), intent(in) :: path(*), bytes(*)
         integer(c_int64_t), value :: count
         integer(c_int), value :: lasting
         integer(c_int) :: c_write_new
      end function c_write_new

      !> Bytes of a file; whole_file_shim.c
      function c_file_size(path) bind(c, name='axijoint_file_size')
         import :: c_char, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int64_t) :: c_file_size
      end function c_file_size

      !> Read the first bytes; whole_file_shim.c
      function c_read_file(path, bytes, most) bind(c, name='axijoint_read_file')
         import :: c_char, c_int64_t
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: bytes(*)
         integer(c_int64_t), value :: most
         integer(c_int64_t) :: c_read_file
      end function c_read_file

      !> Give a file a second name; whole_file_shim.c
      function c_link(from, to) bind(c, name='axijoint_link')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: from(*), to(*)
         integer(c_int) :: c_link
      end function c_link

      !> What a cause means; whole_file_shim.c
      function c_knows_no_links(cause) bind(c, name='axijoint_knows_no_links')
         import :: c_int
         integer(c_int), value :: cause
         integer(c_int) :: c_knows_no_links
      end function c_knows_no_links
      function c_is_there(cause) bind(c, name='axijoint_is_there')
         import :: c_int
         integer(c_int), value :: cause
         integer(c_int) :: c_is_there
      end function c_is_there
      function c_is_not_there(cause) bind(c, name='axijoint_is_not_there')
         import :: c_int
         integer(c_int), value :: cause
         integer(c_int) :: c_is_not_there
      end function c_is_not_there
      function c_is_too_long(cause) bind(c, name='axijoint_is_too_long')
         import :: c_int
         integer(c_int), value :: cause
         integer(c_int) :: c_is_too_long
      end function c_is_too_long

      !> Names in a folder; whole_file_shim.c
      function c_names_in(folder, first, last, names, room) bind(c, name='axijoint_names_in')
         import :: c_char, c_int64_t
         character(kind=c_char), intent(in) :: folder(*), first(*), last(*)
         character(kind=c_char), intent(inout) :: names(*)
         integer(c_int64_t), value :: room
         integer(c_int64_t) :: c_names_in
      end function c_names_in
   end interface

contains

   !> Make a file that is not there and bring it to the disk. Nothing stays of one that fails
   subroutine write_new_file(path, bytes, errno, lasting)
      !> The file
      character(len=*), intent(in) :: path
      !> What it holds
      character(len=*), intent(in) :: bytes
      !> Zero, or the system's error
      integer, intent(out) :: errno
      !> Whether to wait until it is on the disk; true if absent
      logical, intent(in), optional :: lasting

      integer(c_int) :: waits

      waits = 1_c_int
      if (present(lasting)) waits = merge(1_c_int, 0_c_int, lasting)
      errno = int(c_write_new(path//c_null_char, bytes, len(bytes, c_int64_t), waits))
   end subroutine write_new_file

   !> Bytes of a regular file; negative if there is none
   integer(i8) function file_size(path)
      !> The file
      character(len=*), intent(in) :: path

      file_size = c_file_size(path//c_null_char)
   end function file_size

   !> All bytes of a file
   subroutine read_whole_file(path, bytes, errno)
      !> The file
      character(len=*), intent(in) :: path
      !> What it holds; empty if it cannot be read
      character(len=:), allocatable, intent(out) :: bytes
      !> Zero, or the system's error
      integer, intent(out) :: errno

      integer(i8) :: size

      errno = 0
      size = file_size(path)
      if (size >= 0) then
         allocate (character(len=size) :: bytes)
         size = c_read_file(path//c_null_char, bytes, size)
      end if
      if (size < 0) then
         errno = int(-size)
         bytes = ''
      else if (size < len(bytes, i8)) then
         bytes = bytes(:size)
      end if
   end subroutine read_whole_file

   !> First bytes of a file, whatever its size is said to be: the system's own files have none
   function first_bytes(path, most) result(bytes)
      !> The file
      character(len=*), intent(in) :: path
      !> Bytes at most
      integer, intent(in) :: most
      !> What it holds; empty if it cannot be read
      character(len=:), allocatable :: bytes

      call read_first_bytes(path, most, bytes)
   end function first_bytes

   !> The same as a subroutine, for threads
   subroutine read_first_bytes(path, most, bytes)
      !> The file
      character(len=*), intent(in) :: path
      !> Bytes at most
      integer, intent(in) :: most
      !> What it holds; empty if it cannot be read
      character(len=:), allocatable, intent(out) :: bytes

      character(len=most) :: room

      bytes = room(:max(0_i8, c_read_file(path//c_null_char, room, int(most, i8))))
   end subroutine read_first_bytes

   !> Give a file a second name that must be free
   subroutine link_path(from, to, errno)
      !> The file, and the name
      character(len=*), intent(in) :: from, to
      !> Zero, or the system's error
      integer, intent(out) :: errno

      errno = int(c_link(from//c_null_char, to//c_null_char))
   end subroutine link_path

   !> Whether an error of `link_path` is that the file system knows no second names
   logical function knows_no_links(errno)
      !> The error
      integer, intent(in) :: errno

      knows_no_links = c_knows_no_links(int(errno, c_int)) /= 0
   end function knows_no_links

   !> Whether an error is that the name is taken
   logical function is_there(errno)
      !> The error
      integer, intent(in) :: errno

      is_there = c_is_there(int(errno, c_int)) /= 0
   end function is_there

   !> Whether an error is that there is no such name
   logical function is_not_there(errno)
      !> The error
      integer, intent(in) :: errno

      is_not_there = c_is_not_there(int(errno, c_int)) /= 0
   end function is_not_there

   !> Whether an error is that a name, or a path, is longer than the system allows
   logical function is_too_long(errno)
      !> The error
      integer, intent(in) :: errno

      is_too_long = c_is_too_long(int(errno, c_int)) /= 0
   end function is_too_long

   !> Names in a folder that begin and end with some letters, each followed by a line feed; none if
   !> it cannot be read
   function names_in(folder, first, last) result(names)
      !> The folder
      character(len=*), intent(in) :: folder
      !> The letters
      character(len=*), intent(in) :: first, last
      !> The names
      character(len=:), allocatable :: names

      !> Letters that there is room for at first, so that a folder is read once as a rule
      integer, parameter :: usual = 4096
      integer(i8) :: used

      allocate (character(len=usual) :: names)
      do  ! some may have come meanwhile
         used = c_names_in(folder//c_null_char, first//c_null_char, last//c_null_char, names, &
            len(names, i8))
         if (used <= len(names, i8)) exit
         deallocate (names)
         allocate (character(len=used) :: names)
      end do
      names = names(:max(0_i8, used))
   end function names_in

end module axijoint_base_whole_file
