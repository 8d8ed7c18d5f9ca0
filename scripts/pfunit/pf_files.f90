!> Files and texts for the converter of test files
module pf_files
   use, intrinsic :: iso_fortran_env, only : error_unit, iostat_end
   implicit none
   private
   public :: lf, read_line, write_if_changed, base_name, lower_case, text_of, stop_with

   !> Ends a line
   character(len=*), parameter :: lf = new_line('a')

contains

   !> Write a file, unless it holds that text already
   subroutine write_if_changed(file, text)
      !> Path
      character(len=*), intent(in) :: file
      !> Content
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: old
      integer :: unit, status, bytes

      open (newunit=unit, file=file, status='old', access='stream', action='read', iostat=status)
      if (status == 0) then
         inquire (unit=unit, size=bytes)
         allocate (character(len=max(bytes, 0)) :: old)
         read (unit, iostat=status) old
         close (unit)
         if (status == 0 .and. len(old) == len(text) .and. old == text) return
      end if
      open (newunit=unit, file=file, status='replace', access='stream', action='write', &
         iostat=status)
      if (status == 0) write (unit, iostat=status) text
      if (status /= 0) call stop_with(file//': cannot be written')
      close (unit)
   end subroutine write_if_changed

   !> Read a line of any length, without carriage return
   subroutine read_line(unit, line, last)
      !> Open unit
      integer, intent(in) :: unit
      !> The line
      character(len=:), allocatable, intent(out) :: line
      !> The end of the file was met
      logical, intent(out) :: last
      character(len=512) :: part
      integer :: length, status

      line = ''
      do
         read (unit, '(a)', advance='no', size=length, iostat=status) part
         line = line//part(:length)
         if (status /= 0) exit
      end do
      last = status == iostat_end
      if (len(line) == 0) return
      if (line(len(line):) == achar(13)) line = line(:len(line) - 1)
   end subroutine read_line

   !> A path without its directory and extension
   pure function base_name(path) result(name)
      !> The path
      character(len=*), intent(in) :: path
      !> The name
      character(len=:), allocatable :: name
      integer :: dot

      name = path(index(path, '/', back=.true.) + 1:)
      dot = index(name, '.', back=.true.)
      if (dot > 1) name = name(:dot - 1)
   end function base_name

   !> A text in lower case
   pure function lower_case(text) result(lower)
      !> Any text
      character(len=*), intent(in) :: text
      !> The same in lower case
      character(len=len(text)) :: lower
      integer :: k

      lower = text
      do k = 1, len(text)
         if (text(k:k) >= 'A' .and. text(k:k) <= 'Z') lower(k:k) = achar(iachar(text(k:k)) + 32)
      end do
   end function lower_case

   !> An integer as text
   function text_of(value) result(text)
      !> Any integer
      integer, intent(in) :: value
      !> Its text
      character(len=:), allocatable :: text
      character(len=12) :: buffer

      write (buffer, '(i0)') value
      text = trim(buffer)
   end function text_of

   !> Report an error and stop
   subroutine stop_with(text)
      !> What is wrong
      character(len=*), intent(in) :: text

      write (error_unit, '(a)') text
      stop 2, quiet=.true.
   end subroutine stop_with

end module pf_files
