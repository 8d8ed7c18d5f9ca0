!> Rows of a study that are done, in the file of a study under way: a line a row, with a checksum,
!> so that a study that was ended at any moment goes on where it was
module axijoint_study_journal
   use axijoint_base_error, only : error_type, fatal_error, exit_io
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_sha256, only : sha256
   use axijoint_base_system, only : append_to_file, path_kind, path_absent, path_file, rename_path, target_kind, unlink_path
   use axijoint_base_text, only : to_text
   use axijoint_base_whole_file, only : first_bytes
   use axijoint_deck_text_file_bytes, only : read_bytes, line_end, next_line
   use axijoint_output_file_names, only : aside => put_aside
   use axijoint_output_file_pending, only : io_error
   use axijoint_study_rows, only : row_type
   implicit none
   private
   public :: journal_type, open_journal, read_journal, append_row, close_journal

   !> Letters of a checksum
   integer, parameter :: sum_length = 16
   !> What a journal begins with
   character(len=*), parameter :: opening = 'axijoint study, rows that are done; of '

   !> Rows are brought to the disk, where they outlive a machine that fails, with the first that is done so much later
   !> than the last that was, or than the start [second]; a program that is killed loses none
   integer(i8), parameter :: most_apart = 5

   !> A journal
   type :: journal_type
      private
      !> The file
      character(len=:), allocatable :: path
      !> Clock when it was last brought to the disk
      integer(i8) :: synced = 0
   end type journal_type

   !> Ending of a journal while it changes places with one that was put aside
   character(len=*), parameter :: meanwhile = '.meanwhile'

contains

   !> Open a journal, with the rows that stand in it if it is of the same study. One of another
   !> study is put aside, and a new one begun, or that of this study taken back which was put aside before
   subroutine open_journal(path, key, n_quantities, journal, rows, put_aside, error)
      !> The file
      character(len=*), intent(in) :: path
      !> What tells one study from another
      character(len=*), intent(in) :: key
      !> Quantities of a row
      integer, intent(in) :: n_quantities
      !> The journal
      type(journal_type), intent(out) :: journal
      !> Rows by number; takes those that are done
      type(row_type), intent(inout) :: rows(:)
      !> Where the journal of another study is now; empty if there was none
      character(len=:), allocatable, intent(out) :: put_aside
      !> The file cannot be written, or is no journal
      type(error_type), allocatable, intent(out) :: error

      logical :: there, ours, torn, aside_there, aside_ours
      integer :: errno

      journal%path = path
      put_aside = ''
      errno = 0
      call bring_home(path)
      call read_journal(path, key, n_quantities, rows, there, ours, torn)
      if (.not. ours) then
         if (there) then
            call check_journal(path, error)
            if (.not. allocated(error)) call check_journal(path//aside, error)
            if (.not. allocated(error)) call check_journal(path//meanwhile, error)
            if (allocated(error)) return
            put_aside = path//aside
         end if
         call read_journal(path//aside, key, n_quantities, rows, aside_there, aside_ours, torn)
         if (aside_ours) then
            call exchange(path, path//aside, there, errno)
         else
            if (there) call rename_path(path, path//aside, errno)
            if (errno == 0) call append_to_file(path, opening//sha256(key)//new_line('a'), .true., errno)
         end if
      end if
      if (errno == 0 .and. torn) call append_to_file(path, new_line('a'), .true., errno)
      call system_clock(journal%synced)
      if (errno /= 0) call io_error(error, 'write', path, errno)
   end subroutine open_journal

   !> Let a journal and one that was put aside change places
   subroutine exchange(path, other, there, errno)
      !> The journal, and the one that was put aside
      character(len=*), intent(in) :: path, other
      !> Whether the first is there
      logical, intent(in) :: there
      !> Zero, or the system's error
      integer, intent(out) :: errno

      errno = 0
      if (there) call rename_path(path, path//meanwhile, errno)
      if (errno == 0) call rename_path(other, path, errno)
      if (errno == 0 .and. there) call rename_path(path//meanwhile, other, errno)
   end subroutine exchange

   !> A process may have died while journals changed places: what has no place takes that which is free
   subroutine bring_home(path)
      !> The journal
      character(len=*), intent(in) :: path

      integer :: ignored

      if (target_kind(path//meanwhile) /= path_file) return
      if (index(opening, first_bytes(path//meanwhile, len(opening))) /= 1) return  ! somebody else's
      if (path_kind(path) == path_absent) then
         call rename_path(path//meanwhile, path, ignored)
      else if (path_kind(path//aside) == path_absent) then
         call rename_path(path//meanwhile, path//aside, ignored)
      end if
   end subroutine bring_home

   !> What is renamed, and what is replaced then, is a journal, if only the beginning of one: its writer
   !> may have died. Other files are somebody else's
   subroutine check_journal(path, error)
      !> The file
      character(len=*), intent(in) :: path
      !> It is something else
      type(error_type), allocatable, intent(out) :: error

      if (path_kind(path) == path_absent) return
      if (target_kind(path) == path_file) then
         if (index(opening, first_bytes(path, len(opening))) == 1) return
      end if
      call fatal_error(error, exit_io, path//' does not hold rows that are done, and rows of this name would '// &
         'replace it'//new_line('a')//'mend: move it away, or choose another directory with -o')
   end subroutine check_journal

   !> Read a journal that this process does not write
   subroutine read_journal(path, key, n_quantities, rows, there, ours, torn)
      !> The file
      character(len=*), intent(in) :: path
      !> What tells one study from another
      character(len=*), intent(in) :: key
      !> Quantities of a row
      integer, intent(in) :: n_quantities
      !> Rows by number; takes those that are done and not there yet
      type(row_type), intent(inout) :: rows(:)
      !> Whether there is such a file, and whether it is of this study; whether its last line is not
      !> whole
      logical, intent(out) :: there, ours, torn

      character(len=:), allocatable :: bytes, failure
      type(row_type) :: row
      integer :: first, last

      ours = .false.
      torn = .false.
      there = path_kind(path) /= path_absent
      if (.not. there) return
      call read_bytes(path, bytes, failure)
      last = line_end(bytes, 1)
      ours = bytes(:last) == opening//sha256(key)
      if (.not. ours) return
      torn = bytes(len(bytes):) /= new_line('a')
      first = next_line(bytes, last)
      do while (first <= len(bytes))
         last = line_end(bytes, first)
         call read_row(bytes(first:last), n_quantities, row)
         if (row%number >= 1 .and. row%number <= size(rows)) then
            if (rows(row%number)%number == 0) rows(row%number) = row
         end if
         first = next_line(bytes, last)
      end do
   end subroutine read_journal

   !> Append a row
   subroutine append_row(journal, row, error)
      !> The journal
      type(journal_type), intent(inout) :: journal
      !> The row
      type(row_type), intent(in) :: row
      !> The file cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: line
      character(len=24) :: digits
      integer(i8) :: now, rate
      logical :: durable
      integer :: i, k, errno

      line = to_text(row%number)//','//to_text(row%code)//','//to_text(size(row%values, 2))
      write (digits, '(es24.16e3)') row%seconds
      line = line//','//trim(adjustl(digits))
      do k = 1, size(row%values, 2)
         do i = 1, size(row%values, 1)
            write (digits, '(es24.16e3)') row%values(i, k)
            line = line//','//trim(adjustl(digits))
         end do
      end do
      line = line//','//on_a_line(row%message)
      line = checksum(line)//','//line//new_line('a')
      call system_clock(now, rate)
      durable = now - journal%synced > most_apart*rate
      if (durable) journal%synced = now
      call append_to_file(journal%path, line, durable, errno)
      if (errno /= 0) call io_error(error, 'write', journal%path, errno)
   end subroutine append_row

   !> Remove the journal: its rows stand in the files of the study
   subroutine close_journal(journal)
      !> The journal
      type(journal_type), intent(in) :: journal

      integer :: errno

      call unlink_path(journal%path, errno)
   end subroutine close_journal

   !> Read a line; the number of a row that is not whole is 0
   subroutine read_row(line, n_quantities, row)
      !> The line
      character(len=*), intent(in) :: line
      !> Quantities of a row
      integer, intent(in) :: n_quantities
      !> The row
      type(row_type), intent(out) :: row

      integer :: n, i, k, first, last, status(4)

      if (len(line) <= sum_length + 1) return
      if (line(:sum_length) /= checksum(line(sum_length + 2:))) return
      first = sum_length + 2
      status = 0
      n = 0
      do i = 1, 4
         last = index(line(first:), ',') + first - 2
         if (i == 1) read (line(first:last), *, iostat=status(i)) row%number
         if (i == 2) read (line(first:last), *, iostat=status(i)) row%code
         if (i == 3) read (line(first:last), *, iostat=status(i)) n
         if (i == 4) read (line(first:last), *, iostat=status(i)) row%seconds
         first = last + 2
      end do
      allocate (row%values(merge(n_quantities, 0, n > 0), n))
      do k = 1, n
         do i = 1, n_quantities
            last = index(line(first:), ',') + first - 2
            if (last < first) status(1) = 1
            if (any(status /= 0)) exit
            read (line(first:last), *, iostat=status(1)) row%values(i, k)
            first = last + 2
         end do
      end do
      row%message = in_lines(line(first:))
      if (any(status /= 0)) row%number = 0
   end subroutine read_row

   !> Checksum of a line
   pure function checksum(line) result(sum)
      !> The line
      character(len=*), intent(in) :: line
      !> The checksum
      character(len=sum_length) :: sum

      character(len=:), allocatable :: hash

      hash = sha256(line)
      sum = hash(:sum_length)
   end function checksum

   !> A text of several lines on one
   pure function on_a_line(text) result(line)
      !> The text
      character(len=*), intent(in) :: text
      !> The line: ends of lines are \n, and each \ stands twice there
      character(len=:), allocatable :: line

      integer :: k

      line = ''
      do k = 1, len(text)
         if (text(k:k) == new_line('a')) then
            line = line//'\n'
         else if (text(k:k) == '\') then
            line = line//'\\'
         else
            line = line//text(k:k)
         end if
      end do
   end function on_a_line

   !> The text again
   pure function in_lines(line) result(text)
      !> The line
      character(len=*), intent(in) :: line
      !> The text
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      k = 1
      do while (k <= len(line))
         if (line(k:k) == '\' .and. k < len(line)) then
            k = k + 1
            if (line(k:k) == 'n') text = text//new_line('a')
            if (line(k:k) == '\') text = text//'\'
         else
            text = text//line(k:k)
         end if
         k = k + 1
      end do
   end function in_lines

end module axijoint_study_journal
