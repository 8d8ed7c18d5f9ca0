!> A listing or a result file to tables
module axijoint_compare_read_reader
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_text, only : to_text
   use axijoint_compare_read_format, only : format_type
   use axijoint_compare_read_format_reader, only : read_format
   use axijoint_compare_read_hdf5_reader, only : read_result_file, hdf5_signature
   use axijoint_compare_read_listing_reader, only : read_listing
   use axijoint_compare_read_old_listing, only : looks_like_old_listing, read_old_listing
   use axijoint_compare_read_own_format, only : own_format_text, own_format_name
   use axijoint_compare_table_node_places, only : place_nodes
   use axijoint_compare_table_table, only : listing_type, words_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_deck_text_file_bytes, only : read_bytes
   use axijoint_deck_text_source, only : source_type
   implicit none
   private
   public :: read_file

contains

   !> Read a file
   subroutine read_file(path, format_path, words, listing, error)
      !> Path
      character(len=*), intent(in) :: path
      !> Description of its format; empty: axijoint's own listing, or its HDF5 file
      character(len=*), intent(in) :: format_path
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(out) :: listing
      !> It cannot be read
      type(error_type), allocatable, intent(out) :: error

      type(format_type) :: format
      character(len=:), allocatable :: bytes, failure

      listing%path = path
      call read_bytes(path, bytes, failure)
      if (len(failure) > 0) then
         call fatal_error(error, exit_deck, path//': error: '//failure)
      else if (index(bytes, hdf5_signature) == 1) then
         if (len(format_path) > 0) then
            call fatal_error(error, exit_deck, path// &
               ': error: this is an HDF5 file, which needs no '// &
               'format'//new_line('a')//'  mend:    leave out the format '//format_path)
         else
            deallocate (bytes)
            listing%description = 'HDF5 file of axijoint'
            listing%aligned = .true.
            call read_result_file(path, words, listing, error)
         end if
      else
         call check_text(path, bytes, error)
         if (allocated(error)) return
         if (len(format_path) == 0 .and. looks_like_old_listing(bytes)) then
            call read_old_listing(path, bytes, listing, error)
         else
            call open_format(format_path, format, error)
            if (allocated(error)) return
            listing%description = format%name
            call read_listing(path, bytes, format, words, listing, error)
         end if
      end if
      if (.not. allocated(error)) call place_nodes(listing)
   end subroutine read_file

   !> Read a format, or take the built-in one
   subroutine open_format(path, format, error)
      !> Path; empty for the built-in one
      character(len=*), intent(in) :: path
      !> The format
      type(format_type), intent(out) :: format
      !> It cannot be read, or has errors
      type(error_type), allocatable, intent(out) :: error

      type(source_type) :: source
      type(diagnostics_type) :: diagnostics
      character(len=:), allocatable :: bytes, failure

      if (len(path) > 0) then
         call read_bytes(path, bytes, failure)
         if (len(failure) > 0) then
            call fatal_error(error, exit_deck, path//': error: '//failure)
            return
         end if
         call read_format(path, bytes, source, format, diagnostics)
         if (len(format%name) == 0) format%name = 'listing by the format '//path
      else
         bytes = own_format_text()
         call read_format(own_format_name, bytes, source, format, diagnostics)
      end if
      if (diagnostics%n_errors > 0) call fatal_error(error, exit_deck, render(diagnostics, source))
   end subroutine open_format

   !> Refuse a file with bytes that no printer takes
   subroutine check_text(path, bytes, error)
      !> Path
      character(len=*), intent(in) :: path
      !> The file
      character(len=*), intent(in) :: bytes
      !> It is no text
      type(error_type), allocatable, intent(out) :: error

      ! backspace, tab, ends of line, form feed, the end of file of some systems, escape
      integer, parameter :: printer_codes(8) = [8, 9, 10, 11, 12, 13, 26, 27]
      integer :: k, code

      do k = 1, len(bytes)
         code = iachar(bytes(k:k))
         if (code >= 32 .and. code /= 127) cycle
         if (any(printer_codes == code)) cycle
         call fatal_error(error, exit_deck, path//': error: this is no text: byte '//to_text(k)// &
            ' has the code '//to_text(code)//new_line('a')// &
            '  allowed: listings, and HDF5 files of axijoint')
         return
      end do
   end subroutine check_text

end module axijoint_compare_read_reader
