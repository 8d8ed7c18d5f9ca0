!> The files of a study: NAME.study.csv with a line a row, NAME.study.h5 with all increments of all
!> rows, both complete under their names
module axijoint_study_files
   use, intrinsic :: ieee_arithmetic, only : ieee_value, ieee_quiet_nan
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, lower
   use axijoint_base_version, only : program_name, program_version
   use axijoint_deck_text_source, only : source_type
   use axijoint_output_file_echo, only : deck_text
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_text, only : text_file_type
   use axijoint_study_quantities, only : name_length
   use axijoint_study_rows, only : row_type
   use axijoint_study_statistics, only : statistics_type, new_statistics, statistic_names
   use axijoint_study_table, only : study_table_type, value_text, values_on_cards
   use axijoint_study_undertaking, only : undertaking_type, commit_pair
   implicit none
   private
   public :: write_study, quoted

contains

   !> Write the files
   subroutine write_study(undertaking, deck, table, names, rows, statistics, error)
      !> What is under way: where the files go
      type(undertaking_type), intent(in) :: undertaking
      !> The deck
      type(source_type), intent(in) :: deck
      !> The table
      type(study_table_type), intent(in) :: table
      !> Names of the quantities
      character(len=name_length), intent(in) :: names(:)
      !> What came of the rows, by number
      type(row_type), intent(in) :: rows(:)
      !> Statistics of the quantities
      type(statistics_type), intent(in) :: statistics
      !> A file could not be written
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: csv
      type(hdf5_file_type) :: arrays
      logical :: halfway

      call csv%open(undertaking%stem//'.csv', error)
      if (allocated(error)) return
      call write_csv(csv, table, names, rows)
      call csv%finish(error)
      if (.not. allocated(error)) call arrays%create(undertaking%stem//'.h5', error)
      if (.not. allocated(error)) then
         call write_arrays(arrays, deck, table, names, rows, statistics)
         call arrays%finish(error)
      end if
      halfway = .false.
      if (.not. allocated(error)) call commit_pair(undertaking, halfway, error)
      if (halfway) return
      call arrays%abandon()
      call csv%abandon()
   end subroutine write_study

   !> A line a row: number, what varies, exit code, time, quantities of the last increment, message
   subroutine write_csv(file, table, names, rows)
      !> The file
      type(text_file_type), intent(inout) :: file
      !> The table
      type(study_table_type), intent(in) :: table
      !> Names of the quantities
      character(len=name_length), intent(in) :: names(:)
      !> The rows
      type(row_type), intent(in) :: rows(:)

      character(len=:), allocatable :: line
      character(len=24) :: digits
      integer :: i, k, n

      line = 'row'
      do i = 1, size(table%columns)
         line = line//','//trim(table%columns(i)%name)
      end do
      line = line//',exit_code,seconds'
      do i = 1, size(names)
         line = line//','//quoted(trim(names(i)))
      end do
      call file%put(line//',message')
      do k = 1, size(rows)
         if (rows(k)%number == 0) cycle
         line = to_text(k)
         do i = 1, size(table%columns)
            line = line//','//value_text(table, i, k)
         end do
         write (digits, '(f0.6)') rows(k)%seconds
         if (digits(1:1) == '.') digits = '0'//digits(:23)
         line = line//','//to_text(rows(k)%code)//','//trim(digits)
         n = size(rows(k)%values, 2)
         do i = 1, size(names)
            line = line//','
            if (n == 0) cycle
            write (digits, '(es24.16e3)') rows(k)%values(i, n)
            line = line//trim(adjustl(digits))
         end do
         call file%put(line//','//quoted(rows(k)%message))
      end do
   end subroutine write_csv

   !> A text as a cell of a CSV file, on one line: many readers take a line for a row
   pure function quoted(text) result(cell)
      !> The text
      character(len=*), intent(in) :: text
      !> The cell
      character(len=:), allocatable :: cell

      character(len=:), allocatable :: line
      integer :: k

      line = on_one_line(text)
      if (scan(line, ',"') == 0) then
         cell = line
         return
      end if
      cell = '"'
      do k = 1, len(line)
         if (line(k:k) == '"') cell = cell//'"'
         cell = cell//line(k:k)
      end do
      cell = cell//'"'
   end function quoted

   !> Lines side by side, without the blanks at their ends
   pure function on_one_line(text) result(line)
      !> The lines
      character(len=*), intent(in) :: text
      !> Divided by ` / `
      character(len=:), allocatable :: line

      integer :: first, last

      line = ''
      first = 1
      do while (first <= len(text))
         last = first + index(text(first:)//new_line('a'), new_line('a')) - 2
         if (len_trim(text(first:last)) > 0) then
            if (len(line) > 0) line = line//' / '
            line = line//trim(adjustl(text(first:last)))
         end if
         first = last + 2
      end do
   end function on_one_line

   !> All increments of all rows
   subroutine write_arrays(file, deck, table, names, rows, statistics)
      !> The file
      type(hdf5_file_type), intent(inout) :: file
      !> The deck
      type(source_type), intent(in) :: deck
      !> The table
      type(study_table_type), intent(in) :: table
      !> Names of the quantities
      character(len=name_length), intent(in) :: names(:)
      !> The rows
      type(row_type), intent(in) :: rows(:)
      !> Statistics
      type(statistics_type), intent(in) :: statistics

      real(wp), allocatable :: values(:, :, :)
      integer :: k, most

      most = 0
      do k = 1, size(rows)
         most = max(most, size(rows(k)%values, 2))
      end do
      allocate (values(size(names), most, size(rows)), source=missing())
      do k = 1, size(rows)
         associate (n => size(rows(k)%values, 2))
            if (n > 0) values(:, :n, k) = rows(k)%values
         end associate
      end do
      call file%attribute('/', 'program', program_name)
      call file%attribute('/', 'version', program_version)
      call file%attribute('/', 'columns', joined((table%columns%name)))
      call file%attribute('/', 'quantities', joined(names))
      call file%write('/deck', deck_text(deck), 'Cards as read, included files in place')
      call file%write('/table', deck_text(table%source), 'Table as read')
      call file%write('/varied', merge(values_on_cards(table), missing(), table%given), &
         'What varies, nan where the value of the deck stays, words by their place among those '// &
         'allowed; (column, row)')
      call file%write('/exit_code', (rows%code), 'Exit code of the job of each row; (row)')
      call file%write('/seconds', (rows%seconds), 'Time; (row) [second]')
      call file%write('/increments', [(size(rows(k)%values, 2), k=1, size(rows))], &
         'Increments of each row; (row)')
      call file%write('/values', values, &
         'Quantities, nan beyond the increments of a row; (quantity, increment, row)')
      call file%group('/statistics')
      call file%attribute('/statistics', 'statistics', joined(statistic_names))
      call file%write('/statistics/values', statistics%values, &
         'Of the quantities at the end of rows with exit code 0; (statistic, quantity)')
   end subroutine write_arrays

   !> What stands where there is no value: not a number
   pure real(wp) function missing()
      missing = ieee_value(1.0_wp, ieee_quiet_nan)
   end function missing

   !> Texts, one a line
   pure function joined(texts) result(text)
      !> The texts
      character(len=*), intent(in) :: texts(:)
      !> The lines
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(texts)
         if (k > 1) text = text//new_line('a')
         text = text//trim(texts(k))
      end do
   end function joined

end module axijoint_study_files
