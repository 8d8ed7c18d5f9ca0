!> How an HDF5 file is laid out, so that its bytes are under checksums and small arrays cost little:
!>
!> - the format of HDF5 1.10, whose headers of groups and datasets carry checksums over attributes and links as well;
!> - an array of few bytes stands in the header of its dataset, under that checksum;
!> - any other is cut into chunks with checksums, found by an index with checksums; a text of more than 64 KiB cannot
!>   be cut, and has none.
!>
!> A file of this format that is not closed cannot be opened: it must get its name when it is complete.
module axijoint_output_file_hdf5_storage
   use axijoint_base_system, only : last_error
   use axijoint_output_file_hdf5_chunks, only : chunk_extent, small_array
   use hdf5, only : hid_t, hsize_t, size_t, h5pcreate_f, h5pclose_f, h5p_file_access_f, h5p_file_create_f, &
      h5p_group_create_f, h5p_dataset_create_f, h5pset_libver_bounds_f, h5f_libver_v110_f, &
      h5pset_link_phase_change_f, h5pset_attr_phase_change_f, h5pset_obj_track_times_f, &
      h5pset_est_link_info_f, h5pset_layout_f, h5d_compact_f, h5pset_chunk_f, h5pset_fletcher32_f, h5tget_size_f
   implicit none
   private
   public :: hdf5_failure_type, hdf5_storage_type, no_handle

   !> A handle that is not open
   integer(hid_t), parameter :: no_handle = -1_hid_t
   !> Bytes of a text, which cannot be cut into chunks, in a header at most; the format allows 64 KiB
   integer(hsize_t), parameter :: small_text = 65000_hsize_t
   !> Links and attributes of one object that stand in its header; more of them get an index
   integer, parameter :: most_in_header = 1000
   !> Links of a group that its header is made for, and bytes of their names: more of them continue elsewhere
   integer, parameter :: expected_links = 12, expected_name = 14

   !> The first failure of a file; nothing is done after it
   type :: hdf5_failure_type
      !> Whether something failed
      logical :: failed = .false.
      !> What was written or done
      character(len=:), allocatable :: what
      !> The system's error, zero if there was none
      integer :: errno = 0
   contains
      !> Look at a status
      procedure :: check
   end type hdf5_failure_type

   !> Properties that all objects of a file share: made once, as each costs as much as an array
   type :: hdf5_storage_type
      !> Of the file, once it is made and when it is opened
      integer(hid_t) :: creation = no_handle, access = no_handle
      !> Of a group
      integer(hid_t) :: group = no_handle
      !> Of an array that stands in its header
      integer(hid_t) :: small = no_handle
   contains
      !> Make the properties
      procedure :: open => open_storage
      !> Close them
      procedure :: close => close_storage
      !> Properties of one dataset
      procedure :: properties => properties_of
      !> Close what `properties` gave
      procedure :: release
   end type hdf5_storage_type

contains

   !> Keep the first failure, with the system's error if there is one
   subroutine check(self, status, what)
      !> What failed first
      class(hdf5_failure_type), intent(inout) :: self
      !> Status that a call returned; negative for a failure
      integer, intent(in) :: status
      !> What was written or done
      character(len=*), intent(in) :: what

      if (status >= 0 .or. self%failed) return
      self%failed = .true.
      self%what = what
      self%errno = last_error()
   end subroutine check

   !> Make the properties. Times of objects are not kept: the file says once when it was written
   subroutine open_storage(self, failure)
      !> The properties
      class(hdf5_storage_type), intent(out) :: self
      !> What failed first
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      call make(h5p_file_access_f, self%access, failure)
      call make(h5p_file_create_f, self%creation, failure)
      call make(h5p_group_create_f, self%group, failure)
      call make(h5p_dataset_create_f, self%small, failure)
      if (failure%failed) return
      call h5pset_libver_bounds_f(self%access, h5f_libver_v110_f, h5f_libver_v110_f, status)
      call failure%check(status, 'the format')
      call gather_links(self%creation, failure)
      call gather_links(self%group, failure)
      call h5pset_obj_track_times_f(self%group, .false., status)
      call failure%check(status, 'properties')
      call gather_attributes(self%small, failure)
      call h5pset_layout_f(self%small, h5d_compact_f, status)
      call failure%check(status, 'properties')
   end subroutine open_storage

   !> Make properties of a class
   subroutine make(class, properties, failure)
      !> Handle of the class
      integer(hid_t), intent(in) :: class
      !> The properties
      integer(hid_t), intent(out) :: properties
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      properties = no_handle
      if (failure%failed) return
      call h5pcreate_f(class, properties, status)
      call failure%check(status, 'properties')
   end subroutine make

   !> Links and attributes of a group stand in its header
   subroutine gather_links(properties, failure)
      !> Properties of the group
      integer(hid_t), intent(in) :: properties
      !> What failed first
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      call h5pset_link_phase_change_f(properties, most_in_header, 0, status)
      call failure%check(status, 'properties')
      call h5pset_est_link_info_f(properties, expected_links, expected_name, status)
      call failure%check(status, 'properties')
      call h5pset_attr_phase_change_f(properties, most_in_header, 0, status)
      call failure%check(status, 'properties')
   end subroutine gather_links

   !> Attributes of a dataset stand in its header, and no time
   subroutine gather_attributes(properties, failure)
      !> Properties of the dataset
      integer(hid_t), intent(in) :: properties
      !> What failed first
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      call h5pset_attr_phase_change_f(properties, most_in_header, 0, status)
      call failure%check(status, 'properties')
      call h5pset_obj_track_times_f(properties, .false., status)
      call failure%check(status, 'properties')
   end subroutine gather_attributes

   !> Close the properties
   subroutine close_storage(self, failure)
      !> The properties
      class(hdf5_storage_type), intent(inout) :: self
      !> What failed first; handles are closed after a failure too
      type(hdf5_failure_type), intent(inout) :: failure

      call close_properties(self%access, failure)
      call close_properties(self%creation, failure)
      call close_properties(self%group, failure)
      call close_properties(self%small, failure)
   end subroutine close_storage

   !> Close properties if they are open
   subroutine close_properties(properties, failure)
      !> Their handle
      integer(hid_t), intent(inout) :: properties
      !> What failed first
      type(hdf5_failure_type), intent(inout) :: failure

      integer :: status

      if (properties < 0) return
      call h5pclose_f(properties, status)
      call failure%check(status, 'properties')
      properties = no_handle
   end subroutine close_properties

   !> Properties of a dataset: few bytes stand in the header, more in chunks with checksums. Nothing is
   !> compressed: of numbers with all their digits a quarter to a half goes, at a rate below that of
   !> the disk, so that most of the seconds of writing would go there
   subroutine properties_of(self, name, type, extent, properties, failure)
      !> Properties of the file
      class(hdf5_storage_type), intent(in) :: self
      !> Dataset, for the message
      character(len=*), intent(in) :: name
      !> Type of its values
      integer(hid_t), intent(in) :: type
      !> Extents of the array
      integer(hsize_t), intent(in) :: extent(:)
      !> Its properties
      integer(hid_t), intent(out) :: properties
      !> What failed first; nothing is done after a failure
      type(hdf5_failure_type), intent(inout) :: failure

      integer(size_t) :: bytes
      integer :: status

      properties = no_handle
      if (failure%failed) return
      call h5tget_size_f(type, bytes, status)
      call failure%check(status, name)
      if (product(extent)*int(bytes, hsize_t) <= merge(small_text, small_array, size(extent) == 0)) then
         properties = self%small
         return
      end if
      call make(h5p_dataset_create_f, properties, failure)
      if (failure%failed) return
      call gather_attributes(properties, failure)
      if (size(extent) == 0) return  ! a long text: there is nothing to cut
      call h5pset_chunk_f(properties, size(extent), chunk_extent(extent), status)
      call failure%check(status, name)
      call h5pset_fletcher32_f(properties, status)
      call failure%check(status, name)
   end subroutine properties_of

   !> Close the properties of one dataset, unless all share them
   subroutine release(self, properties, failure)
      !> Properties of the file
      class(hdf5_storage_type), intent(in) :: self
      !> Properties of the dataset
      integer(hid_t), intent(inout) :: properties
      !> What failed first; the handle is closed after a failure too
      type(hdf5_failure_type), intent(inout) :: failure

      if (properties /= self%small) call close_properties(properties, failure)
   end subroutine release

end module axijoint_output_file_hdf5_storage
