!> HDF5 file that notices when it cannot be written: every status of the
!> library is checked, every handle is closed on every path
module axijoint_output_file_hdf5
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t, c_loc, c_size_t
   use, intrinsic :: iso_fortran_env, only : int8
   use axijoint_base_error, only : error_type, fatal_error, exit_io
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_system, only : ignore_file_size_signal, set_last_error, start_sync
   use axijoint_output_file_hdf5_data, only : write_array, write_string, write_attribute, &
      write_string_attribute
   use axijoint_output_file_hdf5_series, only : hdf5_series_type, open_series, append_piece, &
      piece_length, close_series
   use axijoint_output_file_hdf5_storage, only : hdf5_failure_type, hdf5_storage_type, no_handle
   use axijoint_output_file_pending, only : temporary_path, discard, io_error
   use hdf5, only : hid_t, hsize_t, h5f_obj_all_f, h5f_obj_file_f, h5open_f, h5close_f, &
      h5eset_auto_f, h5fcreate_f, &
      h5fopen_f, h5fflush_f, h5fclose_f, h5f_acc_excl_f, h5f_acc_rdonly_f, &
      h5f_scope_global_f, h5gcreate_f, h5gclose_f, h5t_native_double, h5t_native_integer, &
      h5t_ieee_f64le, h5t_std_i32le, h5t_std_i64le, h5t_std_u8le, h5kind_to_type, h5_integer_kind
   implicit none
   private
   public :: hdf5_file_type, start_library, kind_real, kind_long, kind_byte

   !> Kinds of the values of a dataset that is written piece by piece
   integer, parameter :: kind_real = 1, kind_long = 2, kind_byte = 3

   !> File under way. `create`, any number of groups, datasets and
   !> attributes, `finish`, a final name (`pending.f90`) or `abandon`; after a failure
   !> everything but `abandon` does nothing.
   type :: hdf5_file_type
      private
      !> Handle of the file
      integer(hid_t) :: file = no_handle
      !> How it is laid out
      type(hdf5_storage_type) :: storage
      !> Whether the library was started
      logical :: started = .false.
      !> Final path
      character(len=:), allocatable :: path
      !> What failed first
      type(hdf5_failure_type) :: failure
      !> Whether the temporary file is there
      logical :: present = .false.
   contains
      !> Create under a temporary name
      procedure :: create
      !> Let another thread write
      procedure, nopass :: mute
      !> Make a group
      procedure :: group
      !> Write an array or a text as a dataset
      generic :: write => write_reals, write_integers, write_longs, write_text
      procedure, private :: write_reals, write_integers, write_longs, write_text
      !> Attach a number or a text to a group or dataset
      generic :: attribute => text_attribute, integer_attribute, integers_attribute, real_attribute
      procedure, private :: text_attribute, integer_attribute, integers_attribute, real_attribute
      !> Attach a text of ASCII characters, marked as such: some readers insist
      procedure :: ascii_attribute
      !> Make a dataset that is written piece by piece, write the next piece, close it
      procedure :: begin
      generic :: append => append_reals, append_longs, append_bytes
      procedure, private :: append_reals, append_longs, append_bytes
      procedure :: end
      !> Let what is written so far go to the disk meanwhile
      procedure :: to_disk
      !> Hand all to the system, close, open again as a check; it goes to the disk meanwhile
      procedure :: finish
      !> Bytes of the finished file
      procedure :: size => size_of_file
      !> Remove what was written
      procedure :: abandon
   end type hdf5_file_type

   interface
      !> The library's own interface lacks this one in Fortran
      function c_dont_atexit() bind(c, name="H5dont_atexit")
         import :: c_int
         integer(c_int) :: c_dont_atexit
      end function c_dont_atexit

      !> Number of open objects of some kinds; the library's own interface in Fortran takes its data
      !> types off it, whatever the kinds
      function c_open_objects(file, kinds) bind(c, name="H5Fget_obj_count")
         import :: c_int, c_int64_t, c_size_t
         integer(c_int64_t), value :: file
         integer(c_int), value :: kinds
         integer(c_size_t) :: c_open_objects
      end function c_open_objects
   end interface

contains

   !> Create a file under its temporary name
   subroutine create(self, path, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Final path
      character(len=*), intent(in) :: path
      !> The file cannot be created
      type(error_type), allocatable, intent(out) :: error

      integer :: status

      call ignore_file_size_signal()
      self%path = path
      self%failure = hdf5_failure_type()
      call discard(path)
      call start_library(self%started)
      if (.not. self%started) then
         call fatal_error(error, exit_io, "cannot write "//path// &
            ": the HDF5 library does not start"//new_line("a")//"mend: check its installation")
         return
      end if
      call self%mute()
      call set_last_error(0)
      call self%storage%open(self%failure)
      status = -1
      if (.not. self%failure%failed) call h5fcreate_f(temporary_path(path), h5f_acc_excl_f, &
         self%file, status, self%storage%creation, self%storage%access)
      call self%failure%check(status, "creating the file")
      self%present = status >= 0
      if (self%present) return
      self%file = no_handle
      call discard(path)  ! a file without its first bytes may be there
      call io_error(error, "open", path, self%failure%errno)
   end subroutine create

   !> Start the library, unless it has been: that takes as long as reading a small deck, beside which a thread can do it
   subroutine start_library(started)
      !> Whether it works
      logical, intent(out) :: started

      integer :: status

      ! The library's clean-up at the end of the program crashes when a file
      ! could not be closed on a full disk; this module closes all by itself.
      status = int(c_dont_atexit())
      call h5open_f(status)
      started = status >= 0
   end subroutine start_library

   !> The library prints nothing of failures in this thread, which are told in other words; each thread has a say of its own
   subroutine mute()
      integer :: status

      call h5eset_auto_f(0, status)
   end subroutine mute

   !> Make a group
   subroutine group(self, name)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path in the file
      character(len=*), intent(in) :: name

      integer(hid_t) :: handle
      integer :: status

      if (self%failure%failed) return
      handle = no_handle
      call set_last_error(0)
      call h5gcreate_f(self%file, name, handle, status, gcpl_id=self%storage%group)
      call self%failure%check(status, name)
      if (handle >= 0) call h5gclose_f(handle, status)
      call self%failure%check(status, name)
   end subroutine group

   !> Write reals of any rank
   subroutine write_reals(self, name, values, description)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> The values
      real(wp), intent(in), target, contiguous :: values(..)
      !> Meaning, order of indices in Fortran, unit
      character(len=*), intent(in) :: description

      call write_array(self%file, self%storage, name, h5t_ieee_f64le, h5t_native_double, &
         extent_of(shape(values, kind=hsize_t)), c_loc(values), description, &
         self%failure)
   end subroutine write_reals

   !> Write integers of any rank
   subroutine write_integers(self, name, values, description)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> The values
      integer, intent(in), target, contiguous :: values(..)
      !> Meaning, order of indices in Fortran
      character(len=*), intent(in) :: description

      call write_array(self%file, self%storage, name, h5t_std_i32le, h5t_native_integer, &
         extent_of(shape(values, kind=hsize_t)), c_loc(values), description, &
         self%failure)
   end subroutine write_integers

   !> Write long integers of any rank
   subroutine write_longs(self, name, values, description)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> The values
      integer(i8), intent(in), target, contiguous :: values(..)
      !> Meaning, order of indices in Fortran
      character(len=*), intent(in) :: description

      call write_array(self%file, self%storage, name, h5t_std_i64le, h5kind_to_type(i8, h5_integer_kind), &
         extent_of(shape(values, kind=hsize_t)), c_loc(values), description, &
         self%failure)
   end subroutine write_longs

   !> Make a dataset that is written piece by piece along its last dimension
   subroutine begin(self, series, name, kind, extent, description)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> The dataset
      type(hdf5_series_type), intent(out) :: series
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> One of the `kind_` parameters
      integer, intent(in) :: kind
      !> Extents of the whole
      integer(i8), intent(in) :: extent(:)
      !> Meaning, order of indices in Fortran, unit
      character(len=*), intent(in) :: description

      integer(hid_t) :: types(3)

      types(kind_real) = h5t_ieee_f64le
      types(kind_long) = h5t_std_i64le
      types(kind_byte) = h5t_std_u8le
      call open_series(series, self%file, self%storage, name, types(kind), int(extent, hsize_t), &
         description, self%failure)
   end subroutine begin

   !> Write the next piece of reals: values of whole leading indices, of one last index if they
   !> have one index less
   subroutine append_reals(self, series, values)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> The dataset
      type(hdf5_series_type), intent(inout) :: series
      !> Its next values
      real(wp), intent(in), target, contiguous :: values(..)

      call append_piece(series, h5t_native_double, &
         piece_length(series, shape(values, kind=hsize_t)), c_loc(values), self%failure)
   end subroutine append_reals

   !> Write the next piece of long integers
   subroutine append_longs(self, series, values)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> The dataset
      type(hdf5_series_type), intent(inout) :: series
      !> Its next values
      integer(i8), intent(in), target, contiguous :: values(:)

      call append_piece(series, h5kind_to_type(i8, h5_integer_kind), size(values, kind=hsize_t), &
         c_loc(values), self%failure)
   end subroutine append_longs

   !> Write the next piece of small integers, 0 to 127
   subroutine append_bytes(self, series, values)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> The dataset
      type(hdf5_series_type), intent(inout) :: series
      !> Its next values
      integer(int8), intent(in), target, contiguous :: values(..)

      call append_piece(series, h5kind_to_type(int8, h5_integer_kind), &
         piece_length(series, shape(values, kind=hsize_t)), c_loc(values), self%failure)
   end subroutine append_bytes

   !> Close a dataset that was written piece by piece
   subroutine end(self, series)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> The dataset
      type(hdf5_series_type), intent(inout) :: series

      call close_series(series, self%failure)
   end subroutine end

   !> Write a text as a scalar dataset of fixed length, UTF-8
   subroutine write_text(self, name, text, description)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> The text
      character(len=*), intent(in) :: text
      !> Meaning
      character(len=*), intent(in) :: description

      call write_string(self%file, self%storage, name, text, description, self%failure)
   end subroutine write_text

   !> Attach a text to a group or dataset
   subroutine text_attribute(self, object, name, text)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path of the group or dataset
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The text
      character(len=*), intent(in) :: text

      call write_string_attribute(self%file, object, name, text, .false., self%failure)
   end subroutine text_attribute

   !> Attach a text of ASCII characters
   subroutine ascii_attribute(self, object, name, text)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path of the group or dataset
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The text
      character(len=*), intent(in) :: text

      call write_string_attribute(self%file, object, name, text, .true., self%failure)
   end subroutine ascii_attribute

   !> Attach an integer to a group or dataset
   subroutine integer_attribute(self, object, name, value)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path of the group or dataset
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The number
      integer, intent(in), target :: value

      call write_attribute(self%file, object, name, h5t_std_i32le, h5t_native_integer, &
         c_loc(value), self%failure)
   end subroutine integer_attribute

   !> Attach a vector of integers to a group or dataset
   subroutine integers_attribute(self, object, name, values)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path of the group or dataset
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The numbers
      integer, intent(in), target, contiguous :: values(:)

      call write_attribute(self%file, object, name, h5t_std_i32le, h5t_native_integer, &
         c_loc(values), self%failure, size(values, kind=hsize_t))
   end subroutine integers_attribute

   !> Attach a real to a group or dataset
   subroutine real_attribute(self, object, name, value)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Absolute path of the group or dataset
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The number
      real(wp), intent(in), target :: value

      call write_attribute(self%file, object, name, h5t_ieee_f64le, h5t_native_double, &
         c_loc(value), self%failure)
   end subroutine real_attribute

   !> Let what the system was handed go to the disk, so that little is left to wait for in the end
   subroutine to_disk(self)
      !> The file
      class(hdf5_file_type), intent(in) :: self

      if (.not. self%failure%failed) call start_sync(temporary_path(self%path))
   end subroutine to_disk

   !> Extents of an array. Some compilers give an empty array of assumed rank
   !> the extent -1.
   pure function extent_of(shape) result(extent)
      !> Shape as the compiler gives it
      integer(hsize_t), intent(in) :: shape(:)
      !> The shape, not negative
      integer(hsize_t) :: extent(size(shape))

      extent = max(shape, 0_hsize_t)
   end function extent_of

   !> Hand all to the system and close; then open once more, so that what gets
   !> the final name is known to be an HDF5 file. Who gives it its name waits until
   !> it is on the disk (`publish`, `commit_set`)
   subroutine finish(self, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: self
      !> Something could not be written
      type(error_type), allocatable, intent(out) :: error

      integer :: status

      call set_last_error(0)
      if (.not. self%failure%failed) then
         call h5fflush_f(self%file, h5f_scope_global_f, status)
         call self%failure%check(status, "flushing the file")
      end if
      call close_file(self)
      if (.not. self%failure%failed) then
         call start_sync(temporary_path(self%path))
         call open_again(self)
      end if
      call close_library(self)
      if (.not. self%failure%failed) return
      call io_error(error, "write", self%path, self%failure%errno)
      error%message = error%message//new_line("a")//"(HDF5 failed at "//self%failure%what//")"
   end subroutine finish

   !> Bytes of the finished file, before it gets its final name
   integer(i8) function size_of_file(self) result(bytes)
      !> The file, finished without error
      class(hdf5_file_type), intent(in) :: self

      inquire (file=temporary_path(self%path), size=bytes)
   end function size_of_file

   !> Close and remove what was written; an earlier file stands
   subroutine abandon(self)
      !> The file, in any state
      class(hdf5_file_type), intent(inout) :: self

      if (self%file >= 0) call close_file(self)
      call close_library(self)
      if (self%present) call discard(self%path)
      self%present = .false.
   end subroutine abandon

   !> Open the closed file and close it again
   subroutine open_again(self)
      !> The file
      class(hdf5_file_type), intent(inout) :: self

      integer(hid_t) :: file
      integer :: status

      file = no_handle
      call set_last_error(0)
      call h5fopen_f(temporary_path(self%path), h5f_acc_rdonly_f, file, status)
      call self%failure%check(status, "opening the complete file again")
      if (self%failure%failed) return
      call h5fclose_f(file, status)
      call self%failure%check(status, "closing the complete file again")
   end subroutine open_again

   !> Close the file; a failure counts
   subroutine close_file(self)
      !> The file
      class(hdf5_file_type), intent(inout) :: self

      integer :: status

      if (self%file < 0) return
      call h5fclose_f(self%file, status)
      call self%failure%check(status, "closing the file")
      self%file = no_handle
   end subroutine close_file

   !> End the library's work, unless other files are open still: it would close them, too
   subroutine close_library(self)
      !> The file
      class(hdf5_file_type), intent(inout) :: self

      integer :: status

      if (.not. self%started) return
      self%started = .false.
      call self%storage%close(self%failure)
      if (c_open_objects(int(h5f_obj_all_f, c_int64_t), int(h5f_obj_file_f, c_int)) > 0) return
      call h5close_f(status)
      call self%failure%check(status, "ending the library")
   end subroutine close_library

end module axijoint_output_file_hdf5
