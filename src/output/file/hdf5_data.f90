!> Datasets and attributes of an open HDF5 file: every status of the library
!> is checked, every handle is closed on every path
module axijoint_output_file_hdf5_data
   use, intrinsic :: iso_c_binding, only : c_ptr, c_loc, c_char
   use axijoint_base_system, only : set_last_error
   use axijoint_output_file_hdf5_storage, only : hdf5_failure_type, hdf5_storage_type, no_handle
   use hdf5, only : hid_t, hsize_t, size_t, h5screate_simple_f, h5screate_f, &
      h5sclose_f, h5s_scalar_f, h5dcreate_f, h5dwrite_f, h5dclose_f, h5acreate_f, h5awrite_f, &
      h5aclose_f, h5oopen_f, h5oclose_f, h5tcopy_f, h5tset_size_f, h5tset_cset_f, &
      h5tset_strpad_f, h5tclose_f, h5t_cset_utf8_f, h5t_cset_ascii_f, h5t_str_nullpad_f, h5t_c_s1
   implicit none
   private
   public :: write_array, write_string, write_attribute, write_string_attribute
   public :: make_space, describe, close_handles

contains

   !> Write an array with checksums, and what it is
   subroutine write_array(file, storage, name, file_type, memory_type, extent, values, description, failure)
      !> Handle of the file
      integer(hid_t), intent(in) :: file
      !> How it is laid out
      type(hdf5_storage_type), intent(in) :: storage
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> Type of the values in the file and in memory
      integer(hid_t), intent(in) :: file_type, memory_type
      !> Extents of the array
      integer(hsize_t), intent(in) :: extent(:)
      !> The first value
      type(c_ptr), intent(in) :: values
      !> Meaning, order of indices in Fortran, unit
      character(len=*), intent(in) :: description
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer(hid_t) :: space, properties, dataset
      integer :: status

      if (failure%failed) return
      space = no_handle; properties = no_handle; dataset = no_handle
      call set_last_error(0)
      call make_space(name, extent, space, failure)
      call storage%properties(name, file_type, extent, properties, failure)
      if (.not. failure%failed) then
         call h5dcreate_f(file, name, file_type, space, dataset, status, properties)
         call failure%check(status, name)
      end if
      if (.not. failure%failed .and. product(extent) > 0_hsize_t) then
         call h5dwrite_f(dataset, memory_type, values, status)
         call failure%check(status, name)
      end if
      call describe(dataset, name, description, failure)
      call close_handles(name, failure, dataset=dataset, space=space)
      call storage%release(properties, failure)
   end subroutine write_array

   !> Write a text as a scalar dataset of fixed length, UTF-8, and what it is
   subroutine write_string(file, storage, name, text, description, failure)
      !> Handle of the file
      integer(hid_t), intent(in) :: file
      !> How it is laid out
      type(hdf5_storage_type), intent(in) :: storage
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> The text, and its meaning
      character(len=*), intent(in) :: text, description
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      character(len=:, kind=c_char), allocatable, target :: copy
      integer(hid_t) :: space, type, properties, dataset
      integer :: status

      if (failure%failed) return
      space = no_handle; properties = no_handle; dataset = no_handle
      copy = not_empty(text)
      call set_last_error(0)
      call h5screate_f(h5s_scalar_f, space, status)
      call failure%check(status, name)
      call make_text_type(len(copy), .false., type, name, failure)
      call storage%properties(name, type, [integer(hsize_t) ::], properties, failure)
      if (.not. failure%failed) then
         call h5dcreate_f(file, name, type, space, dataset, status, properties)
         call failure%check(status, name)
      end if
      if (.not. failure%failed) then
         call h5dwrite_f(dataset, type, c_loc(copy), status)
         call failure%check(status, name)
      end if
      call describe(dataset, name, description, failure)
      call close_handles(name, failure, dataset=dataset, type=type, space=space)
      call storage%release(properties, failure)
   end subroutine write_string

   !> Say what a dataset is that is open
   subroutine describe(dataset, name, description, failure)
      !> Handle of the dataset
      integer(hid_t), intent(in) :: dataset
      !> Its absolute path, for the message, and what it is
      character(len=*), intent(in) :: name, description
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      call attach_text(dataset, name, 'description', description, .false., failure)
   end subroutine describe

   !> Attach a text to a group or dataset, fixed length
   subroutine write_string_attribute(file, object, name, text, ascii, failure)
      !> Handle of the file
      integer(hid_t), intent(in) :: file
      !> Absolute path of the group or dataset, and name of the attribute
      character(len=*), intent(in) :: object, name
      !> The text
      character(len=*), intent(in) :: text
      !> Whether to mark it as ASCII, else as UTF-8
      logical, intent(in) :: ascii
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer(hid_t) :: owner

      call open_object(file, object, owner, failure)
      call attach_text(owner, object, name, text, ascii, failure)
      call close_object(object, owner, failure)
   end subroutine write_string_attribute

   !> Attach a text to an open object
   subroutine attach_text(owner, object, name, text, ascii, failure)
      !> Handle of the object
      integer(hid_t), intent(in) :: owner
      !> Its absolute path, for the message, and name of the attribute
      character(len=*), intent(in) :: object, name
      !> The text
      character(len=*), intent(in) :: text
      !> Whether to mark it as ASCII, else as UTF-8
      logical, intent(in) :: ascii
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      character(len=:, kind=c_char), allocatable, target :: copy
      integer(hid_t) :: type

      if (failure%failed) return
      copy = not_empty(text)
      call set_last_error(0)
      call make_text_type(len(copy), ascii, type, object, failure)
      call attach(owner, object, name, type, type, c_loc(copy), failure)
      call close_handles(object, failure, type=type)
   end subroutine attach_text

   !> Make the space of an array
   subroutine make_space(name, extent, space, failure)
      !> Dataset, for the message
      character(len=*), intent(in) :: name
      !> Extents of the array
      integer(hsize_t), intent(in) :: extent(:)
      !> The space
      integer(hid_t), intent(out) :: space
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      space = no_handle
      if (failure%failed) return
      call h5screate_simple_f(size(extent), extent, space, status)
      call failure%check(status, name)
   end subroutine make_space

   !> Make the type of a text of fixed length
   subroutine make_text_type(length, ascii, type, name, failure)
      !> Bytes
      integer, intent(in) :: length
      !> Whether to mark it as ASCII, else as UTF-8
      logical, intent(in) :: ascii
      !> The type
      integer(hid_t), intent(out) :: type
      !> Object, for the message
      character(len=*), intent(in) :: name
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      type = no_handle
      if (failure%failed) return
      call h5tcopy_f(h5t_c_s1, type, status)
      call failure%check(status, name)
      if (failure%failed) return
      call h5tset_size_f(type, int(length, size_t), status)
      call failure%check(status, name)
      call h5tset_cset_f(type, merge(h5t_cset_ascii_f, h5t_cset_utf8_f, ascii), status)
      call failure%check(status, name)
      call h5tset_strpad_f(type, h5t_str_nullpad_f, status)
      call failure%check(status, name)
   end subroutine make_text_type

   !> Attach a scalar, or a vector, to a group or dataset
   subroutine write_attribute(file, object, name, file_type, memory_type, value, failure, length)
      !> Handle of the file
      integer(hid_t), intent(in) :: file
      !> Absolute path of the group or dataset, and name of the attribute
      character(len=*), intent(in) :: object, name
      !> Type of the value in the file and in memory
      integer(hid_t), intent(in) :: file_type, memory_type
      !> The value
      type(c_ptr), intent(in) :: value
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure
      !> Length of a vector
      integer(hsize_t), intent(in), optional :: length

      integer(hid_t) :: owner

      call open_object(file, object, owner, failure)
      call attach(owner, object, name, file_type, memory_type, value, failure, length)
      call close_object(object, owner, failure)
   end subroutine write_attribute

   !> Attach a scalar, or a vector, to an open object
   subroutine attach(owner, object, name, file_type, memory_type, value, failure, length)
      !> Handle of the object
      integer(hid_t), intent(in) :: owner
      !> Its absolute path, for the message, and name of the attribute
      character(len=*), intent(in) :: object, name
      !> Type of the value in the file and in memory
      integer(hid_t), intent(in) :: file_type, memory_type
      !> The value
      type(c_ptr), intent(in) :: value
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure
      !> Length of a vector
      integer(hsize_t), intent(in), optional :: length

      integer(hid_t) :: space, attribute
      integer :: status

      if (failure%failed) return
      space = no_handle; attribute = no_handle
      call set_last_error(0)
      if (present(length)) then
         call h5screate_simple_f(1, [length], space, status)
      else
         call h5screate_f(h5s_scalar_f, space, status)
      end if
      call failure%check(status, object)
      if (.not. failure%failed) then
         call h5acreate_f(owner, name, file_type, space, attribute, status)
         call failure%check(status, object)
      end if
      if (.not. failure%failed) then
         call h5awrite_f(attribute, memory_type, value, status)
         call failure%check(status, object)
      end if
      if (attribute >= 0) then
         call h5aclose_f(attribute, status)
         call failure%check(status, object)
      end if
      call close_handles(object, failure, space=space)
   end subroutine attach

   !> Open a group or dataset
   subroutine open_object(file, object, owner, failure)
      !> Handle of the file
      integer(hid_t), intent(in) :: file
      !> Absolute path of the group or dataset
      character(len=*), intent(in) :: object
      !> Its handle; `no_handle` after a failure
      integer(hid_t), intent(out) :: owner
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      owner = no_handle
      if (failure%failed) return
      call set_last_error(0)
      call h5oopen_f(file, object, owner, status)
      call failure%check(status, object)
   end subroutine open_object

   !> Close a group or dataset
   subroutine close_object(object, owner, failure)
      !> Its absolute path, for the message
      character(len=*), intent(in) :: object
      !> Its handle; `no_handle` if not open
      integer(hid_t), intent(in) :: owner
      !> What failed first; the handle is closed after a failure too
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      if (owner < 0) return
      call h5oclose_f(owner, status)
      call failure%check(status, object)
   end subroutine close_object

   !> Close the handles that are open
   subroutine close_handles(name, failure, dataset, space, type)
      !> Object, for the message
      character(len=*), intent(in) :: name
      !> What failed first; handles are closed after a failure too
      type(hdf5_failure_type), intent(inout) :: failure
      !> Handles, `no_handle` if not open
      integer(hid_t), intent(in), optional :: dataset, space, type

      integer :: status

      status = 0
      if (is_open(dataset)) call h5dclose_f(dataset, status)
      call failure%check(status, name)
      if (is_open(space)) call h5sclose_f(space, status)
      call failure%check(status, name)
      if (is_open(type)) call h5tclose_f(type, status)
      call failure%check(status, name)
   end subroutine close_handles

   !> Whether a handle was given and is open
   pure logical function is_open(handle)
      !> The handle
      integer(hid_t), intent(in), optional :: handle

      is_open = .false.
      if (present(handle)) is_open = handle >= 0
   end function is_open

   !> A text that takes at least one byte, as the library demands
   pure function not_empty(text) result(copy)
      !> Any text
      character(len=*), intent(in) :: text
      !> The text, or a blank
      character(len=:, kind=c_char), allocatable :: copy

      copy = text
      if (len(text) == 0) copy = " "
   end function not_empty

end module axijoint_output_file_hdf5_data
