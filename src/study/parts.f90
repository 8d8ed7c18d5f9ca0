!> Parts of a study, which processes solve each by itself, and their journals
module axijoint_study_parts
   use axijoint_base_error, only : error_type, exit_memory
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_system, only : unlink_path
   use axijoint_base_text, only : to_text
   use axijoint_base_whole_file, only : names_in
   use axijoint_output_claim, only : claim_type, claim_names, release_output
   use axijoint_output_file_names, only : rows_ending
   use axijoint_output_file_pending, only : join_path
   use axijoint_study_journal, only : read_journal
   use axijoint_study_rows, only : row_type
   implicit none
   private
   public :: part_type, whole, part_name, journal_path, first_row, last_row, gather_parts, &
      remove_parts, processes_that_pay

   !> A process that is started takes so long [second], and threads make a structure at most so many
   !> times as fast
   real(wp), parameter :: start_seconds = 0.1_wp, most_by_threads = 4.0_wp

   !> A part: its number and how many there are
   type :: part_type
      !> 0 for the whole, gathered from `n` parts if there are any
      integer :: number = 0, n = 0
   end type part_type

   !> All rows, by one process
   type(part_type), parameter :: whole = part_type(0, 0)

contains

   !> Processes that rows are worth: one for each thread, if what rows would spare is more than the
   !> structures that each process forms for itself; else 1. Threads make little of a row, and much
   !> of a structure
   pure integer function processes_that_pay(row, structure, n_rows, n_threads) result(n)
      !> Time of a row, and of the first row with its structure [second]
      real(wp), intent(in) :: row, structure
      !> Rows that are not done, threads
      integer, intent(in) :: n_rows, n_threads

      n = max(1, min(n_threads, n_rows))
      if (n_rows*row*(1.0_wp - 1.0_wp/n) <= start_seconds + min(real(n, wp), most_by_threads) &
          *structure) n = 1
   end function processes_that_pay

   !> Name of the files of a part, without ending
   pure function part_name(name, part) result(text)
      !> Name of the study, or path of its files without ending
      character(len=*), intent(in) :: name
      !> The part
      type(part_type), intent(in) :: part
      !> The name
      character(len=:), allocatable :: text

      text = name
      if (part%number > 0) text = name//'.'//to_text(part%number)//'of'//to_text(part%n)
   end function part_name

   !> Path of its journal
   pure function journal_path(stem, part) result(path)
      !> Path of the study's files without ending
      character(len=*), intent(in) :: stem
      !> The part
      type(part_type), intent(in) :: part
      !> The path
      character(len=:), allocatable :: path

      path = part_name(stem, part)//rows_ending
   end function journal_path

   !> Place of its first row in the order of the rows
   pure integer function first_row(part, n_rows)
      !> The part
      type(part_type), intent(in) :: part
      !> Rows of the study
      integer, intent(in) :: n_rows

      first_row = 1
      if (part%number > 1) first_row = last_row(part_type(part%number - 1, part%n), n_rows) + 1
   end function first_row

   !> Place of its last row
   pure integer function last_row(part, n_rows)
      !> The part
      type(part_type), intent(in) :: part
      !> Rows of the study
      integer, intent(in) :: n_rows

      last_row = n_rows
      if (part%number > 0) last_row = int(int(n_rows, i8)*part%number/part%n)
   end function last_row

   !> Take the rows that parts have done, however many there are. Those that a part found no memory
   !> for are not done: who gathers them may have more, as he shares it with none by then
   subroutine gather_parts(directory, name, key, n_quantities, rows, n_others, n_beside)
      !> Directory and name of the study's files, and what tells it from others
      character(len=*), intent(in) :: directory, name, key
      !> Quantities of a row
      integer, intent(in) :: n_quantities
      !> Rows by number; takes those that are done
      type(row_type), intent(inout) :: rows(:)
      !> Parts that hold rows of another study
      integer, intent(out) :: n_others
      !> Number of parts whose rows are left to them; none if absent
      integer, intent(in), optional :: n_beside

      character(len=:), allocatable :: names, left
      logical :: there, ours, torn, before(size(rows))
      integer :: first, last, k

      names = names_in(directory, name//'.', rows_ending)
      left = new_line('a')  ! no name has it
      if (present(n_beside)) left = 'of'//to_text(n_beside)//rows_ending
      before = rows%number > 0
      n_others = 0
      first = 1
      do while (first < len(names))
         last = first + index(names(first:), new_line('a')) - 2
         if (index(names(first:last), left) > 0) then
            first = last + 2
            cycle
         end if
         call read_journal(join_path(directory, names(first:last)), key, n_quantities, rows, there, &
            ours, torn)
         if (there .and. .not. ours) n_others = n_others + 1
         do k = 1, size(rows)
            if (rows(k)%code == exit_memory .and. .not. before(k)) rows(k) = row_type()
         end do
         first = last + 2
      end do
   end subroutine gather_parts

   !> Remove the journals of parts, and the locks of those that died: their rows stand in the files of the study. Those of
   !> another study stay, and those that others write now
   subroutine remove_parts(directory, name, key, n_quantities, n_own)
      !> As for `gather_parts`
      character(len=*), intent(in) :: directory, name, key
      integer, intent(in) :: n_quantities
      !> Number of parts whose names this process has
      integer, intent(in) :: n_own

      type(row_type) :: none(0)
      type(claim_type) :: claim
      type(error_type), allocatable :: in_use
      character(len=:), allocatable :: names, part, path, notes
      logical :: there, ours, torn
      integer :: first, last, errno

      names = names_in(directory, name//'.', rows_ending)
      first = 1
      do while (first < len(names))
         last = first + index(names(first:), new_line('a')) - 2
         path = join_path(directory, names(first:last))
         part = names(first:last - len(rows_ending))
         first = last + 2
         call read_journal(path, key, n_quantities, none, there, ours, torn)
         if (.not. ours) cycle
         if (index(part//rows_ending, 'of'//to_text(n_own)//rows_ending) == 0) then
            call claim_names(directory, [part], 'study', claim, notes, in_use)
            if (allocated(in_use)) cycle
         end if
         call unlink_path(path, errno)
         call release_output(claim)
      end do
   end subroutine remove_parts

end module axijoint_study_parts
