!> One line of a table, by its format, to values
module axijoint_compare_read_row_reader
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, lower
   use axijoint_compare_read_format, only : table_format_type, column_format_type, place_free, &
      place_fixed, place_heading, blank_missing, blank_zero, blank_above
   use axijoint_compare_read_pattern, only : captures_type, find_capture, next_word
   use axijoint_compare_table_cell, only : cell_type, read_cell, number_length, cell_number, &
      cell_blank, &
      cell_word, cell_strange
   use axijoint_compare_table_table, only : words_type, word_index, kind_label, kind_key, &
      kind_parameter, kind_word, kind_skip
   implicit none
   private
   public :: row_fault_type, read_row, parameters_of

   !> What is wrong with a row
   type :: row_fault_type
      !> Column in the format; 0: nothing is wrong
      integer :: column = 0
      !> Columns of the line
      integer :: first = 0, last = 0
      !> What is wrong
      character(len=:), allocatable :: text
   end type row_fault_type

contains

   !> Values of a row
   subroutine read_row(format, line, captures, above, words, cells, fault)
      !> The table
      type(table_format_type), intent(in) :: format
      !> The line
      character(len=*), intent(in) :: line
      !> Parameters of the heading
      type(captures_type), intent(in) :: captures
      !> The row above; blank at the beginning
      type(cell_type), intent(in) :: above(:)
      !> All words
      type(words_type), intent(inout) :: words
      !> The values, by column
      type(cell_type), intent(out) :: cells(:)
      !> What is wrong
      type(row_fault_type), intent(out) :: fault

      integer :: k, next, first, last

      next = 1
      do k = 1, size(format%columns)
         associate (column => format%columns(k))
            if (column%place == place_free .or. column%place == place_fixed) then
               call find_field(column, line, next, first, last)
               if (cut_in_two(column, line, last)) call set_fault(fault, k, first, last, &
                  'a number runs across the end of these columns')
               call read_text(column, line(max(1, first):last), words, cells(k))
            else
               call read_text(column, outside_text(column, captures), words, cells(k))
            end if
            if (cells(k)%state == cell_blank .and. column%blank == blank_above) cells(k) = above(k)
            if (cells(k)%state == cell_strange) then
               call set_fault(fault, k, first, last, 'this is no number')
            else if (cells(k)%state == cell_blank .and. column%place == place_free &
                     .and. column%blank == blank_missing .and. column%kind /= kind_word) then
               call set_fault(fault, k, len(line) + 1, len(line) + 1, 'the line has too few values')
            end if
         end associate
         if (fault%column > 0) return
      end do
      if (all(format%columns%place /= place_free)) return
      call next_word(line, next, first, last)
      if (first > 0) call set_fault(fault, size(format%columns), first, len_trim(line), &
         'the line has too many values')
   end subroutine read_row

   !> Columns of a field on a line
   subroutine find_field(column, line, next, first, last)
      !> The column
      type(column_format_type), intent(in) :: column
      !> The line
      character(len=*), intent(in) :: line
      !> Where a free field may begin; behind it on return
      integer, intent(inout) :: next
      !> The field; 0, -1 if it is blank
      integer, intent(out) :: first, last

      integer :: n

      if (column%place == place_fixed) then
         first = min(column%first, len(line) + 1)
         last = min(column%last, len(line))
         return
      end if
      call next_word(line, next, first, last)
      if (first == 0) then
         last = -1
         return
      end if
      if (column%kind /= kind_word) then
         n = number_length(line(first:last))
         if (n > 0 .and. n < last - first + 1) then
            ! numbers that touch: what follows must look like another number
            if (scan(line(first + n:first + n), '+-*') == 1 .or. line(first:first) == '*') &
               last = first + n - 1
         end if
      end if
      next = last + 1
   end subroutine find_field

   !> Whether fixed columns end within a number: wrong columns would cut numbers without notice.
   !> Numbers may touch, if both have a point; so may a label and a number that begins with 0.
   pure logical function cut_in_two(column, line, last)
      !> The column
      type(column_format_type), intent(in) :: column
      !> The line
      character(len=*), intent(in) :: line
      !> Last column of the field
      integer, intent(in) :: last

      character(len=*), parameter :: digits = '0123456789', inside = digits//'.'
      integer :: first, behind

      cut_in_two = .false.
      if (column%place /= place_fixed .or. last < column%last .or. last >= len(line)) return
      if (scan(line(last:last), inside) == 0 .or. scan(line(last + 1:last + 1), inside) == 0) return
      first = column%first
      behind = verify(line(last + 1:)//' ', digits)
      cut_in_two = .true.
      if (line(last + behind:min(last + behind, len(line))) /= '.') return
      if (any(column%kind == [kind_label, kind_key])) then
         cut_in_two = verify(trim(adjustl(line(first:last))), digits) > 0
         if (line(last + 1:last + 1) /= '0' .and. line(last + 1:last + 1) /= '.') &
            cut_in_two = verify(line(first:last), digits) > 0
      else
         cut_in_two = index(line(first:last), '.') == 0
      end if
   end function cut_in_two

   !> Value of a text
   subroutine read_text(column, text, words, cell)
      !> The column
      type(column_format_type), intent(in) :: column
      !> The text
      character(len=*), intent(in) :: text
      !> All words
      type(words_type), intent(inout) :: words
      !> The value
      type(cell_type), intent(out) :: cell

      integer :: word

      cell = cell_type()
      if (column%kind == kind_skip) then
         cell%state = cell_number
         return
      end if
      if (column%kind /= kind_word) cell = read_cell(text)
      if (column%kind == kind_word .or. (cell%state == cell_strange .and. &
         any(column%kind == [kind_label, kind_key, kind_parameter]))) then
         if (len_trim(text) == 0) return
         call word_index(words, meaning(column, trim(adjustl(text))), word)
         cell = cell_type(real(word, wp), 0.0_wp, cell_word)
      else if (cell%state == cell_blank .and. column%blank == blank_zero) then
         cell%state = cell_number
      else if (any(column%kind == [kind_label, kind_key, kind_parameter])) then
         cell%unit = 0.0_wp
      end if
      if (cell%state == cell_number) then
         cell%value = cell%value*column%factor
         cell%unit = cell%unit*abs(column%factor)
      end if
   end subroutine read_text

   !> Word that a printed word means
   pure function meaning(column, text) result(word)
      !> The column
      type(column_format_type), intent(in) :: column
      !> The printed word
      character(len=*), intent(in) :: text
      !> Its meaning
      character(len=:), allocatable :: word

      integer :: k

      word = text
      do k = 1, size(column%translations)
         if (lower(text) == lower(column%translations(k)%from)) word = column%translations(k)%to
      end do
   end function meaning

   !> Text of a column that is not in the rows
   pure function outside_text(column, captures) result(text)
      !> The column
      type(column_format_type), intent(in) :: column
      !> Parameters of the heading
      type(captures_type), intent(in) :: captures
      !> The text; blank if there is none
      character(len=:), allocatable :: text

      integer :: k

      text = column%constant
      if (column%place /= place_heading) return
      k = find_capture(captures, column%name)
      text = ''
      if (k > 0) text = trim(captures%text(k))
   end function outside_text

   !> Parameters of a row, and the factors of harmonic 0 where it is that
   subroutine parameters_of(format, words, cells, text)
      !> The table
      type(table_format_type), intent(in) :: format
      !> All words
      type(words_type), intent(in) :: words
      !> Values by column
      type(cell_type), intent(inout) :: cells(:)
      !> "m = 0, family = symmetric"
      character(len=:), allocatable, intent(out) :: text

      integer :: k, i
      real(wp) :: ratio

      text = ''
      do k = 1, size(cells)
         associate (column => format%columns(k), cell => cells(k))
            if (column%kind /= kind_parameter) cycle
            if (len(text) > 0) text = text//', '
            text = text//column%name//' = '
            if (cell%state == cell_word) then
               text = text//trim(words%word(nint(cell%value)))
            else
               text = text//to_text(cell%value)
            end if
            if (column%name /= 'm' .or. cell%state /= cell_number .or. nint(cell%value) /= 0) cycle
            do i = 1, size(cells)
               ratio = format%columns(i)%factor_m0/format%columns(i)%factor
               cells(i)%value = cells(i)%value*ratio
               cells(i)%unit = cells(i)%unit*abs(ratio)
            end do
         end associate
      end do
   end subroutine parameters_of

   !> Keep the first fault
   pure subroutine set_fault(fault, column, first, last, text)
      !> The fault
      type(row_fault_type), intent(inout) :: fault
      !> Column in the format
      integer, intent(in) :: column
      !> Columns of the line
      integer, intent(in) :: first, last
      !> What is wrong
      character(len=*), intent(in) :: text

      if (fault%column > 0) return
      fault%column = column
      fault%first = first
      fault%last = last
      fault%text = text
   end subroutine set_fault

end module axijoint_compare_read_row_reader
