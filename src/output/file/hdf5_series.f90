!> Datasets of an open HDF5 file that are written piece by piece along their last
!> dimension, so that they need not be in memory as a whole
module axijoint_output_file_hdf5_series
   use, intrinsic :: iso_c_binding, only : c_ptr
   use axijoint_base_system, only : set_last_error
   use axijoint_output_file_hdf5_data, only : make_space, describe, close_handles
   use axijoint_output_file_hdf5_storage, only : hdf5_failure_type, hdf5_storage_type, no_handle
   use hdf5, only : hid_t, hsize_t, h5dcreate_f, h5dwrite_f, h5dget_space_f, h5s_select_set_f, &
      h5sselect_hyperslab_f
   implicit none
   private
   public :: hdf5_series_type, open_series, append_piece, piece_length, close_series

   !> A dataset under way
   type :: hdf5_series_type
      private
      !> Absolute path in the file
      character(len=:), allocatable :: name
      !> Handle of the dataset
      integer(hid_t) :: dataset = no_handle
      !> Extents of the whole
      integer(hsize_t), allocatable :: extent(:)
      !> Extent along the last dimension that has been written
      integer(hsize_t) :: filled = 0
   end type hdf5_series_type

contains

   !> Make the dataset, without values
   subroutine open_series(series, file, storage, name, file_type, extent, description, failure)
      !> The dataset
      type(hdf5_series_type), intent(out) :: series
      !> Handle of the file
      integer(hid_t), intent(in) :: file
      !> How it is laid out
      type(hdf5_storage_type), intent(in) :: storage
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> Type of the values in the file
      integer(hid_t), intent(in) :: file_type
      !> Extents of the whole
      integer(hsize_t), intent(in) :: extent(:)
      !> Meaning, order of indices in Fortran, unit
      character(len=*), intent(in) :: description
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer(hid_t) :: space, properties
      integer :: status

      series%name = name
      series%extent = extent
      if (failure%failed) return
      call set_last_error(0)
      call make_space(name, extent, space, failure)
      call storage%properties(name, file_type, extent, properties, failure)
      if (.not. failure%failed) then
         call h5dcreate_f(file, name, file_type, space, series%dataset, status, properties)
         call failure%check(status, name)
      end if
      call describe(series%dataset, name, description, failure)
      call close_handles(name, failure, space=space)
      call storage%release(properties, failure)
   end subroutine open_series

   !> Write the next piece
   subroutine append_piece(series, memory_type, length, values, failure)
      !> The dataset
      type(hdf5_series_type), intent(inout) :: series
      !> Type of the values in memory
      integer(hid_t), intent(in) :: memory_type
      !> Extent of the piece along the last dimension
      integer(hsize_t), intent(in) :: length
      !> The first value
      type(c_ptr), intent(in) :: values
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer(hid_t) :: in_file, in_memory
      integer(hsize_t), dimension(size(series%extent)) :: start, extent
      integer :: status

      if (failure%failed .or. length == 0) return
      in_file = no_handle
      extent = series%extent
      extent(size(extent)) = length
      start = 0
      start(size(start)) = series%filled
      call set_last_error(0)
      call make_space(series%name, extent, in_memory, failure)
      if (.not. failure%failed) then
         call h5dget_space_f(series%dataset, in_file, status)
         call failure%check(status, series%name)
      end if
      if (.not. failure%failed) then
         call h5sselect_hyperslab_f(in_file, h5s_select_set_f, start, extent, status)
         call failure%check(status, series%name)
      end if
      if (.not. failure%failed) then
         call h5dwrite_f(series%dataset, memory_type, values, status, in_memory, in_file)
         call failure%check(status, series%name)
      end if
      series%filled = series%filled + length
      call close_handles(series%name, failure, space=in_memory)
      call close_handles(series%name, failure, space=in_file)
   end subroutine append_piece

   !> Extent of a piece along the last dimension: one, if it lacks this dimension; zero, if there
   !> is nothing in it
   pure integer(hsize_t) function piece_length(series, shape) result(length)
      !> The dataset
      type(hdf5_series_type), intent(in) :: series
      !> Extents of the piece as the compiler gives them
      integer(hsize_t), intent(in) :: shape(:)

      length = 1
      if (size(shape) == size(series%extent)) length = max(shape(size(shape)), 0_hsize_t)
      if (any(shape == 0)) length = 0
   end function piece_length

   !> Close the dataset. That it is full is for the caller to see to
   subroutine close_series(series, failure)
      !> The dataset
      type(hdf5_series_type), intent(inout) :: series
      !> What failed first; the handle is closed after a failure too
      type(hdf5_failure_type), intent(inout) :: failure

      call close_handles(series%name, failure, dataset=series%dataset)
      series%dataset = no_handle
   end subroutine close_series

end module axijoint_output_file_hdf5_series
