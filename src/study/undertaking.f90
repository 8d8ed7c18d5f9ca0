!> A study or an envelope under way: the name of its files, which nobody else may write meanwhile,
!> and files that get that name as one
module axijoint_study_undertaking
   use axijoint_base_error, only : error_type, exit_stopped
   use axijoint_base_stop, only : heed_file
   use axijoint_base_system, only : make_directories, unlink_path
   use axijoint_deck_text_source, only : source_type
   use axijoint_output_claim, only : claim_type, claim_names, release_output, spare_sources
   use axijoint_output_file_names, only : endings, file_arrays, journal_ending, table_ending, rows_ending, &
      stop_ending, put_aside
   use axijoint_output_file_pending, only : join_path, io_error, check_name
   use axijoint_output_file_set, only : commit_set
   use axijoint_output_state, only : remove_stop_file
   implicit none
   private
   public :: undertaking_type, begin_undertaking, end_undertaking, commit_pair

   !> What is under way
   type :: undertaking_type
      !> Directory and name of its files, and both together
      character(len=:), allocatable :: directory, name, stem
      !> The name is taken
      type(claim_type) :: claim
      !> The file that ends it: of a part its own, else one part would take it away from the others
      character(len=:), allocatable :: stop_file
   end type undertaking_type

contains

   !> Take a name, and heed its STOP file from now on
   subroutine begin_undertaking(directory, name, claimed, purpose, deck, undertaking, notes, error, table)
      !> Directory, made if it is not there
      character(len=*), intent(in) :: directory
      !> Name of the files without ending
      character(len=*), intent(in) :: name
      !> Names that are taken: that name, of a part of a study another, to gather parts all of them;
      !> the first with the ending STOP is the file
      character(len=*), intent(in) :: claimed(:)
      !> What it is, a line that others are told
      character(len=*), intent(in) :: purpose
      !> The deck, whose files stay
      type(source_type), intent(in) :: deck
      !> What is under way
      type(undertaking_type), intent(out) :: undertaking
      !> What was found and done, a line each; may be empty
      character(len=:), allocatable, intent(out) :: notes
      !> Another process has the name, what has it is no file, or something cannot be written
      type(error_type), allocatable, intent(out) :: error
      !> The table of a study, which stays, too
      type(source_type), intent(in), optional :: table

      integer :: errno
      logical :: removed

      notes = ''
      undertaking%directory = directory
      undertaking%name = name
      undertaking%stem = join_path(directory, name)
      undertaking%stop_file = join_path(directory, trim(claimed(1)))//stop_ending
      call make_directories(directory, errno)
      if (errno /= 0) then
         call io_error(error, 'make', directory, errno)
         return
      end if
      call check_names(undertaking, error)
      if (.not. allocated(error)) call check_place(join_path(directory, trim(claimed(1)))//rows_ending, error)
      if (.not. allocated(error)) call spare(undertaking, claimed, deck, 'the deck', error)
      if (.not. allocated(error) .and. present(table)) call spare(undertaking, claimed, table, 'the table', error)
      if (allocated(error)) return
      call claim_names(directory, claimed, purpose, undertaking%claim, notes, error)
      if (allocated(error)) return
      call remove_stop_file(undertaking%stop_file, removed, error)  ! of an earlier one
      if (allocated(error)) return
      call heed_file(undertaking%stop_file)
   end subroutine begin_undertaking

   !> Refuse to write over the files of the deck or the table, or to remove them
   subroutine spare(undertaking, claimed, source, what, error)
      !> What is under way
      type(undertaking_type), intent(in) :: undertaking
      !> Names that are to be taken
      character(len=*), intent(in) :: claimed(:)
      !> The deck, or the table
      type(source_type), intent(in) :: source
      !> Which of them
      character(len=*), intent(in) :: what
      !> The file in danger
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      call spare_sources(undertaking%directory, undertaking%name, [character(len=16) :: table_ending, &
         endings(file_arrays)], source, what, error)
      do k = 1, size(claimed)
         if (allocated(error)) return
         call spare_sources(undertaking%directory, trim(claimed(k)), [character(len=16) :: rows_ending, &
            rows_ending//put_aside, stop_ending], source, what, error)
      end do
   end subroutine spare

   !> What the table and the HDF5 file replace is a regular file, or nothing
   subroutine check_names(undertaking, error)
      !> What is under way
      type(undertaking_type), intent(in) :: undertaking
      !> A name is taken
      type(error_type), allocatable, intent(out) :: error

      call check_place(undertaking%stem//table_ending, error)
      if (.not. allocated(error)) call check_place(undertaking%stem//trim(endings(file_arrays)), error)
   end subroutine check_names

   !> The same for one file
   subroutine check_place(path, error)
      !> Its path
      character(len=*), intent(in) :: path
      !> The name is taken
      type(error_type), allocatable, intent(out) :: error

      call check_name(path, 'move it away, or choose another directory with -o', error)
   end subroutine check_place

   !> Give the name back; an end before its time says how to go on
   subroutine end_undertaking(undertaking, error)
      !> What was under way
      type(undertaking_type), intent(inout) :: undertaking
      !> How it ended, if not well
      type(error_type), allocatable, intent(inout) :: error

      integer :: errno

      call release_output(undertaking%claim)
      call heed_file('')
      if (.not. allocated(error)) return
      if (error%code /= exit_stopped) return
      call unlink_path(undertaking%stop_file, errno)
      error%message = error%message//new_line('a')//'what is done stands in '// &
         undertaking%stem//'*.rows; the same command goes on from there'
   end subroutine end_undertaking

   !> Give the table and the HDF5 file their names as one
   subroutine commit_pair(undertaking, halfway, error)
      !> What is under way; both are complete under their temporary names
      type(undertaking_type), intent(in) :: undertaking
      !> Whether the files must stay for the next run
      logical, intent(out) :: halfway
      !> A name is taken, or could not be given
      type(error_type), allocatable, intent(out) :: error

      character(len=len(undertaking%name) + len(table_ending)) :: names(2)

      names(1) = undertaking%name//trim(endings(file_arrays))
      names(2) = undertaking%name//table_ending
      halfway = .false.
      call check_names(undertaking, error)
      if (allocated(error)) return
      call commit_set(undertaking%directory, undertaking%name//journal_ending, names, halfway, &
         error)
   end subroutine commit_pair

end module axijoint_study_undertaking
