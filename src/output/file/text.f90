!> Text file that notices when it cannot be written. Fortran's own WRITE,
!> FLUSH and CLOSE report success on a full disk, so lines go through the C
!> library, and no file gets its name before it is on the disk.
module axijoint_output_file_text
   use, intrinsic :: iso_c_binding, only : c_ptr, c_null_ptr, c_null_char, c_char, c_int, &
      c_size_t, c_associated
   use axijoint_base_error, only : error_type
   use axijoint_base_system, only : ignore_file_size_signal, last_error
   use axijoint_output_file_pending, only : temporary_path, publish, discard, io_error
   implicit none
   private
   public :: text_file_type

   !> Characters gathered before they go to the C library
   integer, parameter :: buffer_size = 65536

   !> File under way. `open`, any number of `put`, `finish`, then `commit` or
   !> `abandon`; after a failure everything but `abandon` does nothing.
   type :: text_file_type
      private
      !> Stream of the C library
      type(c_ptr) :: stream = c_null_ptr
      !> Final path
      character(len=:), allocatable :: path
      !> Error of the first call that failed; zero while all is well
      integer :: errno = 0
      !> Whether the temporary file is there
      logical :: present = .false.
      !> Characters not yet handed on, and their number
      character(len=:), allocatable :: buffer
      integer :: used = 0
   contains
      !> Open under a temporary name
      procedure :: open => open_text_file
      !> Write a line
      procedure :: put
      !> Hand all lines to the system and close; they go to the disk meanwhile
      procedure :: finish
      !> Give the file its final name
      procedure :: commit
      !> Remove what was written
      procedure :: abandon
   end type text_file_type

   interface
      !> C standard library
      function c_fopen(path, mode) bind(c, name="fopen")
         import :: c_char, c_ptr
         character(kind=c_char), intent(in) :: path(*), mode(*)
         type(c_ptr) :: c_fopen
      end function c_fopen

      !> C standard library
      function c_fwrite(text, size, count, stream) bind(c, name="fwrite")
         import :: c_char, c_ptr, c_size_t
         character(kind=c_char), intent(in) :: text(*)
         integer(c_size_t), value :: size, count
         type(c_ptr), value :: stream
         integer(c_size_t) :: c_fwrite
      end function c_fwrite

      !> C standard library
      function c_fclose(stream) bind(c, name="fclose")
         import :: c_ptr, c_int
         type(c_ptr), value :: stream
         integer(c_int) :: c_fclose
      end function c_fclose

      !> Flush a stream and let its file go to the disk; system_shim.c
      function c_flush_stream(stream) bind(c, name="axijoint_flush_stream")
         import :: c_ptr, c_int
         type(c_ptr), value :: stream
         integer(c_int) :: c_flush_stream
      end function c_flush_stream
   end interface

contains

   !> Open a file under its temporary name. The name must be free: a link or
   !> file that somebody put there is not followed.
   subroutine open_text_file(self, path, error)
      !> The file
      class(text_file_type), intent(inout) :: self
      !> Final path
      character(len=*), intent(in) :: path
      !> The file cannot be opened
      type(error_type), allocatable, intent(out) :: error

      call ignore_file_size_signal()
      self%path = path
      self%errno = 0
      self%used = 0
      if (.not. allocated(self%buffer)) allocate (character(len=buffer_size) :: self%buffer)
      call discard(path)
      self%stream = c_fopen(temporary_path(path)//c_null_char, "wx"//c_null_char)
      self%present = c_associated(self%stream)
      if (self%present) return
      self%errno = last_error()
      call io_error(error, "open", path, self%errno)
   end subroutine open_text_file

   !> Write a line. Trailing blanks are cut. A failure shows in `finish`.
   subroutine put(self, line)
      !> The file
      class(text_file_type), intent(inout) :: self
      !> The line, without its end
      character(len=*), intent(in) :: line

      integer :: length

      length = len_trim(line)
      if (self%used + length + 1 > buffer_size) call hand_on(self)
      if (length + 1 > buffer_size) then
         call write_text(self, line(:length)//new_line("a"))
         return
      end if
      self%buffer(self%used + 1:self%used + length) = line(:length)
      self%buffer(self%used + length + 1:self%used + length + 1) = new_line("a")
      self%used = self%used + length + 1
   end subroutine put

   !> Hand all lines to the system and close the file. Who gives it its name waits until they are
   !> on the disk (`publish`, `commit_set`): what is done before need not wait for that
   subroutine finish(self, error)
      !> The file
      class(text_file_type), intent(inout) :: self
      !> Some line could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: errno

      call hand_on(self)
      if (c_associated(self%stream)) then
         errno = int(c_flush_stream(self%stream))
         if (self%errno == 0) self%errno = errno
         call close_stream(self)
      end if
      if (self%errno /= 0) call io_error(error, "write", self%path, self%errno)
   end subroutine finish

   !> Give the finished file its final name, replacing an earlier file
   subroutine commit(self, error)
      !> The file, finished without error
      class(text_file_type), intent(inout) :: self
      !> A line is not on the disk, or the rename failed; the earlier file stands
      type(error_type), allocatable, intent(out) :: error

      if (self%errno /= 0 .or. .not. self%present) return
      call publish(self%path, error)
      if (.not. allocated(error)) self%present = .false.
   end subroutine commit

   !> Close and remove what was written; an earlier file stands
   subroutine abandon(self)
      !> The file, in any state
      class(text_file_type), intent(inout) :: self

      self%used = 0
      if (c_associated(self%stream)) call close_stream(self)
      if (self%present) call discard(self%path)
      self%present = .false.
   end subroutine abandon

   !> Hand the gathered characters to the C library
   subroutine hand_on(self)
      !> The file
      class(text_file_type), intent(inout) :: self

      if (self%used > 0) call write_text(self, self%buffer(:self%used))
      self%used = 0
   end subroutine hand_on

   !> Write characters, unless something failed before
   subroutine write_text(self, text)
      !> The file
      class(text_file_type), intent(inout) :: self
      !> The characters
      character(len=*), intent(in) :: text

      integer(c_size_t) :: length

      if (self%errno /= 0 .or. .not. c_associated(self%stream)) return
      length = len(text, kind=c_size_t)
      if (c_fwrite(text, 1_c_size_t, length, self%stream) /= length) self%errno = last_error()
   end subroutine write_text

   !> Close the stream; a failure counts
   subroutine close_stream(self)
      !> The file
      class(text_file_type), intent(inout) :: self

      if (c_fclose(self%stream) /= 0_c_int .and. self%errno == 0) self%errno = last_error()
      self%stream = c_null_ptr
   end subroutine close_stream

end module axijoint_output_file_text
