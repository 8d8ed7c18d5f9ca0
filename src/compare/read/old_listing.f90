!> Tables of a listing of the axisymmetric plasticity program of Owen and Hinton, and of its ports:
!> recognised by headings, whatever stands between
module axijoint_compare_read_old_listing
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_compare_read_old_lines, only : line_kind, plain_line, row_values, number_behind, &
      row_fault_type, line_blank, line_page, line_text, line_row, line_increment, line_element, &
      line_counts, line_no_table, line_nodes, line_elements, line_displacements, line_reactions, &
      line_stresses, line_plane
   use axijoint_compare_read_old_points, only : place_points, settle_angles
   use axijoint_compare_table_cell, only : cell_type, cell_number
   use axijoint_compare_table_table, only : listing_type, column_type, open_table, add_row, &
      kind_label, kind_coordinate, kind_displacement, kind_force, kind_stress, kind_other
   use axijoint_deck_text_file_bytes, only : line_end, next_line
   use axijoint_deck_text_source, only : printable
   implicit none
   private
   public :: looks_like_old_listing, read_old_listing, state_name

   !> Tables by the kind of their heading
   integer, parameter :: first_table = line_nodes, last_table = line_stresses
   !> Names that they have in other files
   character(len=*), parameter :: names(first_table:last_table) = [character(len=33) :: 'nodes', &
      'elements', 'displacement amplitudes', 'reactions', 'stress amplitudes at Gauss points']
   !> Widths of their fields: I5,2F10.3 after a column; I5,I9,6X,9I5; I10,2E14.6; the same;
   !> I5,2X,6E14.6,F8.3,E14.6
   integer, parameter :: widths(11, first_table:last_table) = reshape([ &
      6, 10, 10, 10, 0, 0, 0, 0, 0, 0, 0, 6, 9, 11, 5, 5, 5, 5, 5, 5, 5, 5, &
      10, 14, 14, 0, 0, 0, 0, 0, 0, 0, 0, 10, 14, 14, 0, 0, 0, 0, 0, 0, 0, 0, &
      5, 16, 14, 14, 14, 14, 14, 8, 14, 0, 0], [11, 5])
   !> Fewest values, and most
   integer, parameter :: least(first_table:last_table) = [3, 6, 3, 3, 9]
   integer, parameter :: most(first_table:last_table) = [4, 11, 3, 3, 9]

   !> Where the reader is
   type :: state_type
      !> Kind of the table that is open, and its place; 0 if none is
      integer :: kind = 0, table = 0
      !> Increment, element
      integer :: increment = 1, element = 0
      !> Gauss points in each direction; 0 if that is not known
      integer :: n_gauss = 0
      !> Whether a heading was the last that was read
      logical :: fresh = .false.
   end type state_type

contains

   !> Whether a text is such a listing
   pure logical function looks_like_old_listing(bytes)
      !> The text
      character(len=*), intent(in) :: bytes

      integer :: first, last

      looks_like_old_listing = .false.
      first = 1
      do while (first <= len(bytes))
         last = line_end(bytes, first)
         select case (line_kind(bytes(first:last)))
         case (line_displacements, line_reactions, line_stresses, line_plane)
            looks_like_old_listing = .true.
            return
         end select
         first = next_line(bytes, last)
      end do
   end function looks_like_old_listing

   !> Read it
   subroutine read_old_listing(path, bytes, listing, error)
      !> Path, and what the file says
      character(len=*), intent(in) :: path, bytes
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> A line that cannot be read
      type(error_type), allocatable, intent(out) :: error

      type(state_type) :: state
      type(row_fault_type) :: fault
      character(len=:), allocatable :: text
      integer :: first, last, line
      logical :: new_page

      listing%old_layout = .true.
      allocate (listing%increments(0))
      listing%description = 'listing of Owen and Hinton''s program'
      first = 1
      line = 0
      do while (first <= len(bytes))
         line = line + 1
         last = line_end(bytes, first)
         call plain_line(bytes(first:last), text, new_page)
         call read_line(line, text, new_page, state, listing, fault)
         if (allocated(fault%text)) then
            call fatal_error(error, exit_deck, fault_text(path, line, bytes(first:last), fault))
            return
         end if
         first = next_line(bytes, last)
      end do
      if (size(listing%increments) == 0) listing%increments = [state%increment]
      call place_points(listing, state%n_gauss)
      call settle_angles(listing)
   end subroutine read_old_listing

   !> One line
   subroutine read_line(line, text, new_page, state, listing, fault)
      !> Its number, and what it says
      integer, intent(in) :: line
      character(len=*), intent(in) :: text
      !> Whether a page begins with it
      logical, intent(in) :: new_page
      !> Where the reader is
      type(state_type), intent(inout) :: state
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> What is wrong
      type(row_fault_type), intent(out) :: fault

      integer :: kind

      kind = line_kind(text)
      if (new_page .and. any(kind == [line_text, line_row])) return  ! what is on top of every page
      select case (kind)
      case (line_blank, line_page)
      case (line_increment)
         state%increment = number_behind(text, 'INCREMENT NUMBER')
         state%kind = 0
         listing%increments = [listing%increments, state%increment]
         if (state%increment < 1) fault = row_fault_type(1, len(text), &
            'this is no number of an increment')
      case (line_element)
         state%element = number_behind(text, 'ELEMENT NO.')
         if (state%element < 1) fault = row_fault_type(1, len(text), &
            'this is no number of an element')
      case (line_counts)
         if (number_behind(text, 'NGAUS') > 0) state%n_gauss = number_behind(text, 'NGAUS')
      case (line_plane)
         fault = row_fault_type(1, len(text), 'this is a listing of plane stress or strain: '// &
            'axisymmetric ones are compared')
      case (first_table:last_table)
         call open_one(kind, state, listing)
      case (line_row)
         if (state%kind > 0) call read_row(line, text, state, listing, fault)
      case (line_no_table)
         state%kind = 0
      case default
         ! heads of pages and rules leave a table open
         if (index(text, 'PAGE') == 0 .and. verify(text, ' -=*_') > 0 .and. .not. state%fresh) &
            state%kind = 0
      end select
   end subroutine read_line

   !> Open a table, or go on with it
   subroutine open_one(kind, state, listing)
      !> Kind of its heading
      integer, intent(in) :: kind
      !> Where the reader is
      type(state_type), intent(inout) :: state
      !> The tables
      type(listing_type), intent(inout) :: listing

      character(len=:), allocatable :: parameters

      state%kind = kind
      state%fresh = .true.
      parameters = ''
      if (kind >= line_displacements) parameters = state_name(state%increment)
      call open_table(listing, trim(names(kind)), parameters, columns_of(kind), state%table)
      listing%tables(state%table)%left_out = any(kind == [line_nodes, line_elements])
   end subroutine open_one

   !> What tables of an increment are called: a state of harmonic 0
   pure function state_name(increment) result(text)
      !> The increment
      integer, intent(in) :: increment
      !> Its parameters
      character(len=:), allocatable :: text

      text = 'increment = '//to_text(increment)//', m = 0, family = symmetric'
   end function state_name

   !> Columns of a table
   pure function columns_of(kind) result(columns)
      !> Kind of its heading
      integer, intent(in) :: kind
      !> The columns
      type(column_type), allocatable :: columns(:)

      integer :: k

      select case (kind)
      case (line_nodes)
         columns = [column('node', kind_label), column('r', kind_coordinate), &
            column('z', kind_coordinate)]
      case (line_elements)
         columns = [column('element', kind_label), column('material', kind_other), &
            (column('node '//to_text(k), kind_other), k=1, 9)]
      case (line_displacements)
         columns = [column('node', kind_label), column('u', kind_displacement), &
            column('v', kind_displacement)]
      case (line_reactions)
         columns = [column('node', kind_label), column('R_u', kind_force), &
            column('R_v', kind_force)]
      case default
         columns = [column('element', kind_label), column('point', kind_label), &
            column('sigma_r', kind_stress), column('sigma_z', kind_stress), &
            column('tau_rz', kind_stress), column('sigma_theta', kind_stress), &
            column('largest', kind_stress), column('smallest', kind_stress), &
            column('angle', kind_other), column('plastic', kind_other)]
      end select
   end function columns_of

   !> A column
   pure type(column_type) function column(name, kind)
      !> Name
      character(len=*), intent(in) :: name
      !> One of the `kind_` parameters
      integer, intent(in) :: kind

      column%name = name
      column%kind = kind
   end function column

   !> A row of the open table
   subroutine read_row(line, text, state, listing, fault)
      !> Its line, and what it says
      integer, intent(in) :: line
      character(len=*), intent(in) :: text
      !> Where the reader is
      type(state_type), intent(inout) :: state
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> What is wrong
      type(row_fault_type), intent(out) :: fault

      type(cell_type) :: values(11)
      type(cell_type), allocatable :: cells(:)

      associate (kind => state%kind, table => listing%tables(state%table))
         call row_values(text, widths(:most(kind), kind), least(kind), values(:most(kind)), fault)
         if (allocated(fault%text)) return
         values(1)%unit = 0.0_wp
         cells = values(:size(table%columns))
         if (kind == line_stresses) &
            cells = [cell_type(real(state%element, wp), 0.0_wp, cell_number), &
            values(:size(table%columns) - 1)]
         if (state%fresh) then
            ! the first row again: results of a later iteration, which replace those before
            if (is_first(table%cells, table%n_rows, cells, merge(2, 1, kind == line_stresses))) &
               table%n_rows = 0
            state%fresh = .false.
         end if
         call add_row(table, cells, line)
      end associate
   end subroutine read_row

   !> Whether a row has the numbers of the first row of a table
   pure logical function is_first(table, n_rows, cells, n)
      !> Rows of the table, and how many there are
      type(cell_type), intent(in) :: table(:, :)
      integer, intent(in) :: n_rows
      !> The row
      type(cell_type), intent(in) :: cells(:)
      !> How many numbers it has
      integer, intent(in) :: n

      is_first = n_rows > 0
      if (is_first) is_first = all(nint(table(:n, 1)%value) == nint(cells(:n)%value))
   end function is_first

   !> Message for a line that cannot be read
   function fault_text(path, line, text, fault) result(message)
      !> Path, and number of the line
      character(len=*), intent(in) :: path
      integer, intent(in) :: line
      !> The line
      character(len=*), intent(in) :: text
      !> What is wrong
      type(row_fault_type), intent(in) :: fault
      !> The message
      character(len=:), allocatable :: message

      character, parameter :: nl = new_line('a')
      character(len=:), allocatable :: margin

      margin = repeat(' ', max(0, 5 - len(to_text(line))))//to_text(line)
      message = path//':'//to_text(line)//':'//to_text(fault%first)//'-'// &
         to_text(max(fault%first, fault%last))//': error: '//fault%text//nl//margin//' | '// &
         printable(text)//nl//repeat(' ', len(margin))//' |'//repeat(' ', fault%first)// &
         repeat('^', max(1, fault%last - fault%first + 1))//nl// &
         '  allowed: listings of Owen and Hinton''s axisymmetric program; others by '// &
         '--format-a or --format-b'
   end function fault_text

end module axijoint_compare_read_old_listing
