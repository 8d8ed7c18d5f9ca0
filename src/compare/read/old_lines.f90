!> Lines of a listing of Owen and Hinton's program: what a line is, and the values on a row
module axijoint_compare_read_old_lines
   use axijoint_base_text, only : upper
   use axijoint_compare_read_pattern, only : next_word
   use axijoint_compare_table_cell, only : cell_type, read_cell, number_length, cell_number, &
      cell_overflow, cell_strange, cell_blank
   implicit none
   private
   public :: line_kind, plain_line, row_values, number_behind, row_fault_type
   public :: line_blank, line_page, line_text, line_row, line_increment, line_element, line_counts, &
      line_no_table, line_nodes, line_elements, line_displacements, line_reactions, line_stresses, &
      line_plane

   !> Nothing; for the printer alone; words that mean nothing here; values
   integer, parameter :: line_blank = 0, line_page = 1, line_text = 2, line_row = 3
   !> The number of an increment, or of the element whose points follow; counts of the control card
   integer, parameter :: line_increment = 4, line_element = 5, line_counts = 6
   !> Headings of tables: one that is not read, nodes, elements, displacements, reactions, stresses;
   !> results of a plane body
   integer, parameter :: line_no_table = 7, line_nodes = 8, line_elements = 9, &
      line_displacements = 10, line_reactions = 11, line_stresses = 12, line_plane = 13

   !> A row that is none
   type :: row_fault_type
      !> Columns
      integer :: first = 0, last = 0
      !> What is wrong; not allocated if nothing is
      character(len=:), allocatable :: text
   end type row_fault_type

contains

   !> A line without what is for the printer. Pages begin at 1 or a form feed in the first column; a
   !> line that is printed upon the one above it repeats it
   pure subroutine plain_line(line, text, new_page)
      !> The line
      character(len=*), intent(in) :: line
      !> The rest, columns as they were
      character(len=:), allocatable, intent(out) :: text
      !> Whether a page begins
      logical, intent(out) :: new_page

      character(len=1), parameter :: form_feed = achar(12)

      text = line
      new_page = index(line, form_feed) == 1
      if (new_page) text = line(2:)//' '
      if (len(text) == 0) return
      if (scan(text(1:1), '01+-') == 0) return
      if (len(text) > 1) then
         ! a number begins here, not a line for the printer
         if (scan(text(2:2), '0123456789.') > 0) return
      end if
      new_page = new_page .or. text(1:1) == '1'
      if (text(1:1) == '+') text = ''
      if (len(text) > 0) text(1:1) = ' '
   end subroutine plain_line

   !> What a line is
   pure integer function line_kind(text) result(kind)
      !> The line, without what is for the printer
      character(len=*), intent(in) :: text

      character(len=len(text)) :: words
      integer :: first, last

      words = upper(text)
      call next_word(text, 1, first, last)
      if (first == 0) then
         kind = line_blank
      else if (index(words, 'R-DISP') > 0) then
         kind = line_displacements
      else if (index(words, 'R-REAC') > 0) then
         kind = line_reactions
      else if (index(words, 'RR-STRESS') > 0) then
         kind = line_stresses
      else if (index(words, 'X-DISP') > 0 .or. index(words, 'XX-STRESS') > 0) then
         kind = line_plane
      else if (index(words, 'INCREMENT NUMBER') > 0) then
         kind = line_increment
      else if (index(words, 'ELEMENT NO') > 0) then
         kind = line_element
      else if (index(words, 'NODE NUMBERS') > 0) then
         kind = line_elements
      else if (index(words, 'NNODE =') > 0 .or. index(words, 'NGAUS =') > 0) then
         kind = line_counts
      else if (index(words, 'G.P.') > 0 .or. index(words, 'PROPERTIES') > 0 .or. &
               index(words, 'CODE') > 0) then
         kind = line_no_table
      else if (words(first:last) == 'NODE') then
         kind = line_nodes
         if (index(words, ' X ') == 0 .and. index(words, ' R ') == 0) kind = line_no_table
      else if (scan(text(first:first), '0123456789*.+-') > 0 .and. &
               verify(text(first:last), '-') > 0 .and. index(words, 'PAGE') == 0) then
         kind = line_row
      else
         kind = line_text
      end if
   end function line_kind

   !> Integer behind a text; 0 if there is none
   pure integer function number_behind(text, before) result(number)
      !> The line
      character(len=*), intent(in) :: text
      !> The text, in capital letters
      character(len=*), intent(in) :: before

      type(cell_type) :: cell
      integer :: place, first, last

      number = 0
      place = index(upper(text), before)
      if (place == 0) return
      place = place + len(before)
      call next_word(text, place, first, last)
      if (first == 0) return
      if (text(first:first) == '=') then  ! with or without a blank behind
         call next_word(text, first + 1, first, last)
         if (first == 0) return
      end if
      cell = read_cell(text(first:last))
      if (cell%state == cell_number) number = nint(cell%value)
   end function number_behind

   !> Values on a row. Numbers side by side are told apart by their signs; where asterisks stand, by
   !> the columns of the program's formats
   pure subroutine row_values(row, widths, least, cells, fault)
      !> The row
      character(len=*), intent(in) :: row
      !> Widths of the fields, as many as there may be values
      integer, intent(in) :: widths(:)
      !> Fewest values
      integer, intent(in) :: least
      !> The values; those that are not there are blank
      type(cell_type), intent(out) :: cells(:)
      !> What is wrong
      type(row_fault_type), intent(out) :: fault

      character(len=len(row)) :: text
      integer :: k, n, next, first, last

      text = with_signs(row)
      cells%state = cell_blank
      next = 1
      last = 0
      do k = 1, size(widths)
         if (index(text, '*') > 0) then
            first = min(last + 1, len(text) + 1)
            last = min(first + widths(k) - 1, len(text))
            if (verify(text(first:last), ' ') == 0) exit
         else
            call next_word(text, next, first, last)
            if (first == 0) exit
            n = number_length(text(first:last))
            if (n > 0 .and. n < last - first + 1) then
               if (scan(text(first + n:first + n), '+-') == 1) last = first + n - 1
            end if
            next = last + 1
         end if
         cells(k) = read_cell(text(first:last))
         if (cells(k)%state == cell_strange) then
            fault = row_fault_type(first, last, 'this is no number')
            return
         end if
      end do
      if (k - 1 < least) fault = row_fault_type(len_trim(text) + 1, len_trim(text) + 1, &
         'the line has too few values')
      if (index(text, '*') == 0) then
         call next_word(text, next, first, last)
      else
         first = sum(widths) + 1
         if (len_trim(text) < first) first = 0
      end if
      if (k > size(widths) .and. first > 0) &
         fault = row_fault_type(first, len_trim(text), 'the line has too many values')
      if (.not. any(cells(1)%state == [cell_number, cell_overflow])) &
         fault = row_fault_type(1, len_trim(text), 'the line has no number of a node or point')
   end subroutine row_values

   !> A row with + for a blank where exponents have one for their sign
   pure function with_signs(row) result(text)
      !> The row
      character(len=*), intent(in) :: row
      !> The same with +
      character(len=len(row)) :: text

      character(len=*), parameter :: digits = '0123456789', letters = 'eEdDqQ'
      integer :: k

      text = row
      do k = 2, len(row) - 2
         if (scan(row(k:k), letters) > 0 .and. scan(row(k - 1:k - 1), digits//'.') > 0 .and. &
             row(k + 1:k + 1) == ' ' .and. scan(row(k + 2:k + 2), digits) > 0) text(k + 1:k + 1) = '+'
      end do
   end function with_signs

end module axijoint_compare_read_old_lines
