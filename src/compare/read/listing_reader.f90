!> Tables of a listing, by its format
module axijoint_compare_read_listing_reader
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_text, only : to_text
   use axijoint_compare_read_format, only : format_type, table_format_type, pattern_type, &
      end_blank, &
      end_heading, end_text
   use axijoint_compare_read_pattern, only : captures_type, match_pattern
   use axijoint_compare_read_row_reader, only : row_fault_type, read_row, parameters_of
   use axijoint_compare_table_cell, only : cell_type
   use axijoint_compare_table_table, only : listing_type, words_type, column_type, open_table, &
      add_row, &
      kind_parameter, kind_skip
   use axijoint_deck_text_file_bytes, only : line_end, next_line
   use axijoint_deck_text_source, only : printable
   implicit none
   private
   public :: read_listing

   !> Where the reader is
   type :: state_type
      !> Table that is open; 0 between tables
      integer :: table = 0
      !> Table that was open last; 0 before the first
      integer :: last_table = 0
      !> Lines still to skip
      integer :: skip = 0
      !> Line of the heading
      integer :: heading_line = 0
      !> Rows read since the heading
      integer :: n_rows = 0
      !> Parameters of lines, and of the heading with them
      type(captures_type) :: of_lines, captures
      !> The row above
      type(cell_type), allocatable :: above(:)
      !> Whether the first and the last line were seen
      logical :: first_seen = .false., last_seen = .false.
   end type state_type

contains

   !> Read all tables of a listing
   subroutine read_listing(path, bytes, format, words, listing, error)
      !> Path
      character(len=*), intent(in) :: path
      !> The file
      character(len=*), intent(in) :: bytes
      !> Its format
      type(format_type), intent(in) :: format
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> It is not of this format, or not whole
      type(error_type), allocatable, intent(out) :: error

      type(state_type) :: state
      integer :: first, last, line

      state%first_seen = len(format%first) == 0
      first = 1
      line = 0
      do while (first <= len(bytes))
         line = line + 1
         last = line_end(bytes, first)
         call read_line(path, line, unprinted(bytes(first:last), format%carriage), format, words, &
            state, listing, error)
         if (allocated(error)) return
         first = next_line(bytes, last)
      end do
      call check_whole(path, format, state, listing, error)
   end subroutine read_listing

   !> A line without what is for the printer: form feeds, and the first character if it is a
   !> carriage control
   pure function unprinted(line, carriage) result(text)
      !> The line
      character(len=*), intent(in) :: line
      !> Whether the first character is for the printer
      logical, intent(in) :: carriage
      !> The rest
      character(len=:), allocatable :: text

      character(len=1), parameter :: form_feed = achar(12)
      integer :: k

      text = line
      if (carriage .and. len(text) > 0) text(1:1) = ' '
      do k = 1, len(text)
         if (text(k:k) == form_feed) text(k:k) = ' '
      end do
      if (index(line, form_feed) == 1) text = text(2:)
   end function unprinted

   !> One line
   subroutine read_line(path, line, text, format, words, state, listing, error)
      !> Path and number of the line
      character(len=*), intent(in) :: path
      integer, intent(in) :: line
      !> The line
      character(len=*), intent(in) :: text
      !> The format
      type(format_type), intent(in) :: format
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> Where the reader is
      type(state_type), intent(inout) :: state
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> A row that cannot be read
      type(error_type), allocatable, intent(out) :: error

      logical :: found
      integer :: k

      if (.not. state%first_seen) state%first_seen = matches(text, format%first)
      if (len(format%last) > 0) then
         if (matches(text, format%last)) then
            state%last_seen = .true.
            state%table = 0
            return
         end if
      end if
      do k = 1, size(format%lines)
         call match_pattern(text, format%lines(k)%text, state%of_lines, found)
         if (found) return
      end do
      call open_heading(line, text, format, state, found)
      if (found) then
         if (format%tables(state%table)%ending /= end_heading) return
      else if (state%table == 0 .or. state%skip > 0 .or. any_matches(text, format%ignored)) then
         state%skip = max(0, state%skip - 1)
         return
      else if (ends(text, format%tables(state%table), state%n_rows)) then
         state%table = 0
         return
      else if (len_trim(text) == 0) then
         return
      end if
      call read_table_row(path, line, text, format, words, state, listing, error)
      if (format%tables(state%table)%ending == end_heading) state%table = 0
   end subroutine read_line

   !> Whether a line is a heading; if so, its table is open
   subroutine open_heading(line, text, format, state, found)
      !> Number of the line
      integer, intent(in) :: line
      !> The line
      character(len=*), intent(in) :: text
      !> The format
      type(format_type), intent(in) :: format
      !> Where the reader is
      type(state_type), intent(inout) :: state
      !> Whether it is
      logical, intent(out) :: found

      type(captures_type) :: captures
      integer :: k

      found = .false.
      if (len_trim(text) == 0) return
      do k = 1, size(format%tables)
         captures = state%of_lines
         call match_pattern(text, format%tables(k)%heading, captures, found)
         if (.not. found) cycle
         if (k /= state%last_table) then  ! otherwise a page begins within the table
            if (allocated(state%above)) deallocate (state%above)
            allocate (state%above(size(format%tables(k)%columns)))
         end if
         state%table = k
         state%last_table = k
         state%skip = format%tables(k)%skip
         state%captures = captures
         state%heading_line = line
         state%n_rows = 0
         return
      end do
   end subroutine open_heading

   !> Whether a line ends the open table
   pure logical function ends(text, table, n_rows)
      !> The line
      character(len=*), intent(in) :: text
      !> The table
      type(table_format_type), intent(in) :: table
      !> Rows that it has
      integer, intent(in) :: n_rows

      ends = .false.
      if (table%ending == end_blank) ends = len_trim(text) == 0 .and. n_rows > 0
      if (table%ending == end_text) ends = matches(text, table%ending_text)
   end function ends

   !> One row of the open table
   subroutine read_table_row(path, line, text, format, words, state, listing, error)
      !> Path and number of the line
      character(len=*), intent(in) :: path
      integer, intent(in) :: line
      !> The line
      character(len=*), intent(in) :: text
      !> The format
      type(format_type), intent(in) :: format
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> Where the reader is
      type(state_type), intent(inout) :: state
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> A row that cannot be read
      type(error_type), allocatable, intent(out) :: error

      type(cell_type), allocatable :: cells(:)
      type(row_fault_type) :: fault
      character(len=:), allocatable :: parameters
      integer, allocatable :: kept(:)
      integer :: table, k

      associate (description => format%tables(state%table))
         allocate (cells(size(description%columns)))
         call read_row(description, text, state%captures, state%above, words, cells, fault)
         if (fault%column > 0) then
            call row_error(path, line, text, description, state%heading_line, fault, error)
            return
         end if
         state%above = cells
         state%n_rows = state%n_rows + 1
         call parameters_of(description, words, cells, parameters)
         kept = pack([(k, k=1, size(cells))], description%columns%kind /= kind_parameter &
                     .and. description%columns%kind /= kind_skip)
         call open_table(listing, description%name, parameters, columns_of(description, kept), &
            table)
         call add_row(listing%tables(table), cells(kept), line)
      end associate
   end subroutine read_table_row

   !> Columns of a table
   pure function columns_of(description, kept) result(columns)
      !> The table
      type(table_format_type), intent(in) :: description
      !> Columns that are kept
      integer, intent(in) :: kept(:)
      !> The columns
      type(column_type), allocatable :: columns(:)

      integer :: k

      allocate (columns(size(kept)))
      do k = 1, size(kept)
         columns(k)%name = description%columns(kept(k))%name
         columns(k)%kind = description%columns(kept(k))%kind
      end do
   end function columns_of

   !> Error for a row that is not as its format says
   subroutine row_error(path, line, text, description, heading_line, fault, error)
      !> Path and number of the line
      character(len=*), intent(in) :: path
      integer, intent(in) :: line
      !> The line
      character(len=*), intent(in) :: text
      !> The table
      type(table_format_type), intent(in) :: description
      !> Line of the heading
      integer, intent(in) :: heading_line
      !> What is wrong
      type(row_fault_type), intent(in) :: fault
      !> The error
      type(error_type), allocatable, intent(out) :: error

      character, parameter :: nl = new_line('a')
      character(len=:), allocatable :: margin

      margin = repeat(' ', max(0, 5 - len(to_text(line))))//to_text(line)
      call fatal_error(error, exit_deck, path//':'//to_text(line)//':'//to_text(fault%first)// &
         '-'// &
         to_text(max(fault%first, fault%last))//': error: '//fault%text//nl// &
         margin//' | '//printable(text)//nl// &
         repeat(' ', len(margin))//' |'//repeat(' ', max(1, fault%first))// &
         repeat('^', max(1, fault%last - fault%first + 1))//nl// &
         '  allowed: a row of the table '//description%name//' (heading in line '// &
         to_text(heading_line)//'): column '//description%columns(fault%column)%name//nl// &
         '  mend:    the file is damaged, or its format needs an IGNORE card, ENDS, or other '// &
         'columns')
   end subroutine row_error

   !> Error for a file that is of another format, or cut off
   subroutine check_whole(path, format, state, listing, error)
      !> Path
      character(len=*), intent(in) :: path
      !> The format
      type(format_type), intent(in) :: format
      !> Where the reader is
      type(state_type), intent(in) :: state
      !> The tables
      type(listing_type), intent(in) :: listing
      !> The error
      type(error_type), allocatable, intent(out) :: error

      character, parameter :: nl = new_line('a')

      if (.not. state%first_seen) then
         call fatal_error(error, exit_deck, path//': error: this is no '//format%name// &
            ': no line '// &
            "begins with '"//format%first//"'"//nl//'  mend:    give the format of the listing '// &
            'by --format-a or --format-b')
      else if (listing%n_tables == 0) then
         call fatal_error(error, exit_deck, path// &
            ': error: none of the tables of the format is in '// &
            'the file: '//format%name//nl//'  mend:    look at the HEADING cards of the format')
      else if (len(format%last) > 0 .and. .not. state%last_seen) then
         call fatal_error(error, exit_deck, path// &
            ': error: the file is cut off: no line begins '// &
            "with '"//format%last//"'"//nl//'  mend:    run the job again, or copy the file again')
      end if
   end subroutine check_whole

   !> Whether a line begins with a text
   pure logical function matches(text, pattern)
      !> The line
      character(len=*), intent(in) :: text
      !> The pattern
      character(len=*), intent(in) :: pattern

      type(captures_type) :: captures

      call match_pattern(text, pattern, captures, matches)
   end function matches

   !> Whether a line begins with one of several texts
   pure logical function any_matches(text, patterns)
      !> The line
      character(len=*), intent(in) :: text
      !> The patterns
      type(pattern_type), intent(in) :: patterns(:)

      integer :: k

      any_matches = .false.
      do k = 1, size(patterns)
         if (.not. any_matches) any_matches = matches(text, patterns(k)%text)
      end do
   end function any_matches

end module axijoint_compare_read_listing_reader
