!> How much memory a process may still take, and a message before it takes more
module axijoint_base_memory
   use axijoint_base_error, only : error_type, fatal_error, exit_memory
   use axijoint_base_kinds, only : i8
   use axijoint_base_text, only : to_text
   use axijoint_base_whole_file, only : read_first_bytes
   implicit none
   private
   public :: require_memory, available_memory, free_memory, resident_bytes, give_back_memory, no_limit

   interface
      !> Give memory that was freed back to the system, for other processes; system_shim.c
      subroutine give_back_memory() bind(c, name='axijoint_give_back_memory')
      end subroutine give_back_memory
   end interface

   !> The user gave no limit
   integer(i8), parameter :: no_limit = huge(1_i8)
   !> No limit is known
   integer(i8), parameter :: unknown = huge(1_i8)
   !> From here on a limit of the system is none: its first version of groups gives a number for that, too
   integer(i8), parameter :: no_bound = 2_i8**60
   !> Bytes that must stay free for what libraries and threads take besides; the buffers of the BLAS
   !> are taken before (linalg/blas_buffers.f90)
   integer(i8), parameter :: head_room = 64*2_i8**20
   !> What numbers are made of
   character(len=*), parameter :: digits = '0123456789'
   !> Bytes of the system's files that are looked at: what is asked for stands in the first two thousand or so
   integer, parameter :: enough = 16384
   character(len=1), parameter :: nl = new_line('a')

contains

   !> Make sure that memory is there before it is allocated: a system that
   !> promises more than it has would kill the process later without a word
   subroutine require_memory(bytes, purpose, limit, error, sharers, found)
      !> Bytes needed, without the head-room of the libraries
      integer(i8), intent(in) :: bytes
      !> What for
      character(len=*), intent(in) :: purpose
      !> Bytes that the user lets the process take in all
      integer(i8), intent(in) :: limit
      !> Too little memory, with the bytes
      type(error_type), allocatable, intent(out) :: error
      !> Processes that share the machine for the same work; 1 if absent
      integer, intent(in), optional :: sharers
      !> What `free_memory` has just found; it looks if absent
      integer(i8), intent(in), optional :: found

      character(len=:), allocatable :: share, fewer

      if (present(found)) then
         if (bytes <= found) return
      else if (bytes <= free_memory(limit, sharers)) then
         return
      end if
      if (bytes > left_of(limit)) then
         call fatal_error(error, exit_memory, 'out of memory: '//purpose//' need '// &
                          in_mebibytes(bytes)//', the limit given leaves '// &
                          in_mebibytes(left_of(limit))//new_line('a')// &
                          'mend: a larger limit, or a coarser mesh')
         return
      end if
      share = ''
      fewer = ''
      if (present(sharers)) then
         if (sharers > 1) then
            share = ' to each of '//to_text(sharers)//' processes of this machine'
            fewer = 'fewer processes on a machine, '
         end if
      end if
      call fatal_error(error, exit_memory, 'out of memory: '//purpose//' need '// &
                       in_mebibytes(bytes + head_room)//', available are '// &
                       in_mebibytes(available_memory(sharers))//share//new_line('a')// &
                       'mend: '//fewer//'a coarser mesh, fewer harmonics, or a larger memory limit')
   end subroutine require_memory

   !> Bytes that data of this process may still take, by what is found and what the user allows
   function free_memory(limit, sharers) result(bytes)
      !> Bytes that the user lets the process take in all
      integer(i8), intent(in) :: limit
      !> Processes that share the machine for the same work; 1 if absent
      integer, intent(in), optional :: sharers
      !> Bytes
      integer(i8) :: bytes

      bytes = min(available_memory(sharers) - head_room, left_of(limit))
   end function free_memory

   !> Bytes that a limit on the whole process leaves
   function left_of(limit) result(bytes)
      !> The limit
      integer(i8), intent(in) :: limit
      !> Bytes
      integer(i8) :: bytes

      bytes = limit
      if (limit /= no_limit) bytes = max(limit - resident_bytes(), 0_i8)
   end function left_of

   !> Bytes that this process has in memory
   function resident_bytes() result(bytes)
      !> Bytes; zero if nothing is known
      integer(i8) :: bytes

      bytes = scaled(number_after('/proc/self/status', 'VmRSS:'), 1024_i8)
      if (bytes == unknown) bytes = 0
   end function resident_bytes

   !> Bytes that this process may still take: the least of what the machine has
   !> free, what its control group leaves and what its address space leaves
   function available_memory(sharers) result(bytes)
      !> Processes that share the first two for the same work; 1 if absent
      integer, intent(in), optional :: sharers
      !> Bytes; very large if nothing is known
      integer(i8) :: bytes

      integer(i8) :: limit, used

      bytes = scaled(number_after('/proc/meminfo', 'MemAvailable:'), 1024_i8)
      bytes = min(bytes, left_of_groups('0::', '/sys/fs/cgroup', 'memory.max', 'memory.current', &
                                 'inactive_file'), &
                  left_of_groups(':memory:', '/sys/fs/cgroup/memory', 'memory.limit_in_bytes', &
                                 'memory.usage_in_bytes', 'total_inactive_file'))
      if (present(sharers)) bytes = bytes/sharers
      limit = number_after('/proc/self/limits', 'Max address space')
      used = scaled(number_after('/proc/self/status', 'VmSize:'), 1024_i8)
      if (limit /= unknown .and. used /= unknown) bytes = min(bytes, max(limit - used, 0_i8))
   end function available_memory

   !> Bytes that the control groups of this process leave: the one it is in, and those around it
   function left_of_groups(label, root, limit_file, used_file, unused) result(bytes)
      !> What stands before its group in /proc/self/cgroup: of the second version, or of the first
      character(len=*), intent(in) :: label
      !> Where groups are, names of the files that tell a limit and what is used of it, and what a
      !> line of memory.stat calls contents of files, which the system gives up for other use
      character(len=*), intent(in) :: root, limit_file, used_file, unused
      !> Bytes
      integer(i8) :: bytes

      character(len=:), allocatable :: group
      integer(i8) :: limit, used, files

      bytes = unknown
      call read_after('/proc/self/cgroup', label, group)
      do
         limit = number_after(root//group//'/'//limit_file, '')
         if (limit < no_bound) then  ! what is used is told slowly
            used = number_after(root//group//'/'//used_file, '')
            files = number_after(root//group//'/memory.stat', unused//' ')
            if (files == unknown) files = 0
            if (used /= unknown) bytes = min(bytes, max(limit - max(used - files, 0_i8), 0_i8))
         end if
         if (len(group) == 0) exit
         group = group(:index(group, '/', back=.true.) - 1)
      end do
   end function left_of_groups

   ! Subroutines, as threads look at the same time: gfortran keeps the length of a function's text in one place for all

   !> What follows a label in the first line of a file that has it, without slashes at its end
   subroutine read_after(path, label, text)
      !> The file
      character(len=*), intent(in) :: path
      !> The label
      character(len=*), intent(in) :: label
      !> The rest of the line; empty if there is none
      character(len=:), allocatable, intent(out) :: text

      integer :: place

      call read_first_bytes(path, enough, text)
      place = index(text, label)
      if (place == 0) text = ''
      if (place == 0) return
      text = text(place + len(label):)
      text = trim(text(:index(text//nl, nl) - 1))
      text = text(:verify(text, '/', back=.true.))
   end subroutine read_after

   !> First number after a label at the beginning of a line of a file
   function number_after(path, label) result(number)
      !> The file
      character(len=*), intent(in) :: path
      !> The label; may be empty
      character(len=*), intent(in) :: label
      !> The number; `unknown` if the file, the label or a number is not there
      integer(i8) :: number

      character(len=:), allocatable :: text
      integer :: place, first, last, stat

      number = unknown
      call read_first_bytes(path, enough, text)
      text = nl//text
      place = index(text, nl//label)
      if (place == 0) return
      text = text(place + len(nl//label):)
      text = text(:index(text//nl, nl) - 1)
      first = scan(text, digits)
      if (first == 0) return  ! a word: no limit
      last = first + verify(text(first:)//nl, digits) - 2
      read (text(first:last), *, iostat=stat) number
      if (stat /= 0) number = unknown
   end function number_after

   !> Product; unknown stays unknown
   pure integer(i8) function scaled(number, factor)
      !> Factors
      integer(i8), intent(in) :: number, factor

      scaled = merge(unknown, factor*min(number, unknown/factor), number == unknown)
   end function scaled

   !> Bytes in words
   function in_mebibytes(bytes) result(text)
      !> Bytes
      integer(i8), intent(in) :: bytes
      !> Mebibytes with the unit, and bytes
      character(len=:), allocatable :: text

      text = to_text(bytes/2**20)//' MiB ('//to_text(bytes)//' bytes)'
   end function in_mebibytes

end module axijoint_base_memory
