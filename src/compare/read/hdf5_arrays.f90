!> Arrays of a result file that is read
module axijoint_compare_read_hdf5_arrays
   use, intrinsic :: iso_c_binding, only : c_loc, c_int, c_ptr
   use axijoint_base_kinds, only : wp
   use axijoint_base_last_words, only : note_reading
   use hdf5, only : hid_t, hsize_t, size_t, h5open_f, h5close_f, h5eset_auto_f, h5fopen_f, &
      h5fclose_f, &
      h5f_acc_rdonly_f, h5lexists_f, h5dopen_f, h5dclose_f, h5dread_f, h5dget_space_f, h5sclose_f, &
      h5sget_simple_extent_ndims_f, h5sget_simple_extent_dims_f, h5t_native_double, &
      h5aopen_by_name_f, h5oopen_f, h5oclose_f, &
      h5aread_f, h5aclose_f, h5aget_type_f, h5tget_size_f, h5tclose_f
   implicit none
   private
   public :: result_file_type

   !> A handle that is not open
   integer(hid_t), parameter :: no_handle = -1_hid_t

   !> What is said of what is there and cannot be read
   character(len=*), parameter :: damaged = ' cannot be read: the file is damaged'

   !> A result file; after a failure nothing is read
   type :: result_file_type
      private
      !> Handle
      integer(hid_t) :: file = no_handle
      !> Path
      character(len=:), allocatable :: path
      !> What could not be read first; empty if all is well
      character(len=:), allocatable, public :: failure
   contains
      !> Open
      procedure :: open => open_file
      !> Close
      procedure :: close => close_file
      !> Whether there is a dataset or group
      procedure :: has
      !> How many values a dataset has
      procedure :: values => count_values
      !> Read a dataset of reals or integers
      procedure :: read => read_array
      !> Read an attribute of the file that is a text
      procedure :: text => read_text
   end type result_file_type

   interface
      !> The library's own interface lacks this one in Fortran
      function c_dont_atexit() bind(c, name="H5dont_atexit")
         import :: c_int
         integer(c_int) :: c_dont_atexit
      end function c_dont_atexit
   end interface

contains

   !> Open a file
   subroutine open_file(self, path)
      !> The file
      class(result_file_type), intent(inout) :: self
      !> Path
      character(len=*), intent(in) :: path

      integer :: status

      self%failure = ''
      self%path = path
      call note_reading(path)
      status = int(c_dont_atexit())
      call h5open_f(status)
      call h5eset_auto_f(0, status)
      call h5fopen_f(path, h5f_acc_rdonly_f, self%file, status)
      if (status < 0) self%failure = 'the file cannot be opened: it is damaged or cut off'
      call note_reading('')
   end subroutine open_file

   !> Close the file
   subroutine close_file(self)
      !> The file
      class(result_file_type), intent(inout) :: self

      integer :: status

      call note_reading(self%path)
      if (self%file >= 0) call h5fclose_f(self%file, status)
      self%file = no_handle
      call h5close_f(status)
      call note_reading('')
   end subroutine close_file

   !> Whether there is a dataset or group. One whose name is there and that cannot be opened is damaged
   logical function has(self, name)
      !> The file
      class(result_file_type), intent(inout) :: self
      !> Absolute path in the file; a group of it may lack as well
      character(len=*), intent(in) :: name

      integer(hid_t) :: object
      integer :: status, last

      has = .false.
      if (len(self%failure) > 0) return
      call note_reading(self%path)
      last = 1
      do while (last < len(name))
         ! from group to group, for a name in a group that lacks is an error
         last = index(name(last + 1:)//'/', '/') + last - 1
         call h5lexists_f(self%file, name(:last), has, status)
         if (status >= 0 .and. .not. has) exit
         if (status >= 0) call h5oopen_f(self%file, name(:last), object, status)
         if (status < 0) then
            has = .false.
            self%failure = name(:last)//damaged
            exit
         end if
         call h5oclose_f(object, status)
         last = last + 1
      end do
      call note_reading('')
   end function has

   !> How many values a dataset has; 0 if it cannot be read
   real(wp) function count_values(self, name) result(n)
      !> The file
      class(result_file_type), intent(in) :: self
      !> Absolute path in the file
      character(len=*), intent(in) :: name

      integer(hid_t) :: dataset, space
      integer(hsize_t) :: extents(32), largest(32)
      integer :: status, rank

      n = 0.0_wp
      if (len(self%failure) > 0) return
      call note_reading(self%path)
      call h5dopen_f(self%file, name, dataset, status)
      if (status >= 0) then
         call h5dget_space_f(dataset, space, status)
         call h5sget_simple_extent_ndims_f(space, rank, status)
         if (status >= 0 .and. rank >= 1 .and. rank <= size(extents)) then
            call h5sget_simple_extent_dims_f(space, extents(:rank), largest(:rank), status)
            n = product(real(extents(:rank), wp))
         end if
         call h5sclose_f(space, status)
         call h5dclose_f(dataset, status)
      end if
      call note_reading('')
   end function count_values

   !> Read a dataset
   subroutine read_array(self, name, values, extent)
      !> The file
      class(result_file_type), intent(inout) :: self
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> All values, the first index fastest
      real(wp), allocatable, intent(out), target :: values(:)
      !> Extents, 1 beyond the rank
      integer, intent(out) :: extent(4)

      type(c_ptr) :: memory
      integer(hid_t) :: dataset, space
      integer(hsize_t) :: extents(4), largest(4)
      integer :: status, rank
      logical :: there

      extent = 0
      allocate (values(0))
      if (len(self%failure) > 0) return
      call note_reading(self%path)
      call h5dopen_f(self%file, name, dataset, status)
      if (status < 0) then
         call note_reading('')
         there = self%has(name)
         if (.not. there .and. len(self%failure) == 0) self%failure = 'the file has no '//name
         if (len(self%failure) == 0) self%failure = name//damaged
         return
      end if
      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_ndims_f(space, rank, status)
      if (status >= 0 .and. rank >= 1 .and. rank <= 4) then
         extents = 1
         call h5sget_simple_extent_dims_f(space, extents(:rank), largest(:rank), status)
         extent = int(extents)
         deallocate (values)
         allocate (values(product(extent)), source=0.0_wp)
         if (size(values) > 0) then
            memory = c_loc(values)
            call h5dread_f(dataset, h5t_native_double, memory, status)
         end if
      else
         status = -1
      end if
      if (status < 0) self%failure = name//damaged
      call h5sclose_f(space, status)
      call h5dclose_f(dataset, status)
      call note_reading('')
   end subroutine read_array

   !> Read an attribute of the file that is a text
   subroutine read_text(self, name, text)
      !> The file
      class(result_file_type), intent(inout) :: self
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> The text; empty if there is none
      character(len=:), allocatable, intent(out) :: text

      character(len=256), target :: buffer
      type(c_ptr) :: memory
      integer(hid_t) :: attribute, type
      integer(size_t) :: length
      integer :: status

      text = ''
      if (len(self%failure) > 0) return
      call note_reading(self%path)
      call h5aopen_by_name_f(self%file, '/', name, attribute, status)
      if (status < 0) then
         call note_reading('')
         return
      end if
      buffer = ''
      call h5aget_type_f(attribute, type, status)
      call h5tget_size_f(type, length, status)
      memory = c_loc(buffer)
      if (length <= len(buffer)) call h5aread_f(attribute, type, memory, status)
      text = trim(buffer)
      if (scan(text, achar(0)) > 0) text = text(:scan(text, achar(0)) - 1)
      call h5tclose_f(type, status)
      call h5aclose_f(attribute, status)
      call note_reading('')
   end subroutine read_text

end module axijoint_compare_read_hdf5_arrays
