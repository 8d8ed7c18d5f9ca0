!> `axijoint compare`: two listings or result files, column by column
module axijoint_command_compare
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_error, only : error_type, exit_ok, exit_deck
   use axijoint_base_progress, only : tell_below
   use axijoint_command_compare_line, only : compare_type, read_compare
   use axijoint_command_line, only : word_type
   use axijoint_command_run, only : print_error
   use axijoint_command_unknown_word, only : unknown
   use axijoint_compare_compare, only : compare_listings
   use axijoint_compare_names, only : add_tables, add_columns, name_length
   use axijoint_compare_old_layout, only : fit_old_layout
   use axijoint_compare_read_hdf5_history, only : add_history
   use axijoint_compare_read_hdf5_increments, only : add_increments
   use axijoint_compare_read_own_format, only : own_format_text
   use axijoint_compare_read_reader, only : read_file
   use axijoint_compare_table_table, only : listing_type, words_type, kind_names, kind_word
   use axijoint_compare_table_totals, only : add_totals
   use axijoint_compare_tolerances, only : tolerances_type
   implicit none
   private
   public :: compare_files

   !> Exit code of files that differ; in this command alone 1 has a meaning
   integer, parameter :: exit_different = 1

contains

   !> Compare two files
   subroutine compare_files(words, exit_code)
      !> Words of the command line after `compare`
      type(word_type), intent(in) :: words(:)
      !> 0 same, 1 different, 2 a file that cannot be read, a name that is in neither, or wrong usage
      integer, intent(out) :: exit_code

      type(compare_type) :: compare
      type(listing_type) :: listings(2)
      type(words_type) :: dictionary
      type(error_type), allocatable :: error
      logical :: same
      integer :: k

      exit_code = exit_deck
      call read_compare(words, compare, error)
      if (allocated(error)) then
         call print_error('', error)
         return
      end if
      if (compare%print_format) then
         write (output_unit, '(a)', advance='no') own_format_text()
         exit_code = exit_ok
         return
      end if
      do k = 1, 2
         call read_file(compare%path(k)%text, compare%format(k)%text, dictionary, listings(k), &
            error)
         if (allocated(error)) then
            call tell_below(error%message)
            return
         end if
      end do
      do k = 1, 2
         call add_increments(listings(k), listings(3 - k), error)
         if (allocated(error)) then
            call tell_below(error%message)
            return
         end if
         call add_history(listings(k), listings(3 - k), dictionary, error)
         if (allocated(error)) then
            call tell_below(error%message)
            return
         end if
         call fit_old_layout(listings(k), listings(3 - k))
         call add_totals(listings(k), listings(3 - k))
      end do
      call check_names(compare%tolerances, listings, error)
      if (allocated(error)) then
         call print_error('', error)
         return
      end if
      call compare_listings(output_unit, listings(1), listings(2), dictionary, compare%tolerances, &
         same)
      exit_code = merge(exit_ok, exit_different, same)
   end subroutine compare_files

   !> What the options name must be a quantity, or in one of the files
   subroutine check_names(tolerances, listings, error)
      !> What they name
      type(tolerances_type), intent(in) :: tolerances
      !> The files
      type(listing_type), intent(in) :: listings(:)
      !> The first name that is neither
      type(error_type), allocatable, intent(out) :: error

      character(len=name_length), allocatable :: known(:)
      integer :: k

      known = [character(len=name_length) :: kind_names(kind_word:)]
      do k = 1, size(listings)
         call add_columns(listings(k), known)
      end do
      do k = 1, size(tolerances%special)
         if (any(known == tolerances%special(k)%name)) cycle
         call unknown('quantity or column', tolerances%special(k)%name, known, error)
         return
      end do
      do k = 1, size(listings)
         call add_tables(listings(k), known)
      end do
      do k = 1, size(tolerances%skipped)
         if (any(known == tolerances%skipped(k)%text)) cycle
         call unknown('quantity, column or table', tolerances%skipped(k)%text, known, error)
         return
      end do
   end subroutine check_names

end module axijoint_command_compare
