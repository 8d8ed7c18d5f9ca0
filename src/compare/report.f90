!> What the comparison found, as lines for people
module axijoint_compare_report
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, count_of
   use axijoint_compare_judge, only : table_result_type, column_result_type
   use axijoint_compare_match, only : match_type
   use axijoint_compare_table_cell, only : cell_type, cell_number, cell_blank, cell_overflow, &
      cell_not_a_number, cell_infinite
   use axijoint_compare_table_table, only : table_type, words_type, kind_names, table_title, &
      kind_word, &
      find_column
   implicit none
   private
   public :: print_table, print_only

   !> Name, quantity, values, different, worst absolute and relative difference
   character(len=*), parameter :: format_column = '(4x, a14, a14, i9, i11, 2es14.2)'
   !> A value
   character(len=*), parameter :: format_value = '(es0.9e2)'

contains

   !> A table that both files have
   subroutine print_table(unit, a, b, match, result, words)
      !> Unit
      integer, intent(in) :: unit
      !> The tables
      type(table_type), intent(in) :: a, b
      !> Which row is which
      type(match_type), intent(in) :: match
      !> Differences
      type(table_result_type), intent(in) :: result
      !> Words of both files
      type(words_type), intent(in) :: words

      character(len=14) :: name
      integer :: k

      write (unit, '(/a)') table_title(a)
      write (unit, '(2x, a)') count_of(count(match%partner > 0), 'row')//' matched by '// &
         keys_text(match)
      if (match%n_least > 0) write (unit, '(2x, a)') count_of(match%n_least, 'row')// &
         ' with the place of others: those are together that differ least'
      call print_rows_only(unit, 'A', a, match%partner, words)
      call print_rows_only(unit, 'B', b, match%partner_of_b, words)
      if (size(result%columns) == 0) return
      write (unit, '(4x, a)') 'column        quantity         values  different      '// &
         'absolute      relative'
      do k = 1, size(result%columns)
         associate (column => result%columns(k))
            name = a%columns(column%a)%name
            write (unit, format_column) name, kind_names(a%columns(column%a)%kind)//'  ', &
               column%n, &
               column%n_different, column%absolute, column%relative
         end associate
      end do
      call print_worst_columns(unit, a, b, result, words)
      do k = 1, size(result%worst)
         associate (worst => result%worst(k), column => result%columns(result%worst(k)%column))
            call print_pair(unit, 'differs:', a, b, column, [worst%row_a, worst%row_b], words)
         end associate
      end do
   end subroutine print_table

   !> How rows were matched
   pure function keys_text(match) result(text)
      !> Which row is which
      type(match_type), intent(in) :: match
      !> The words
      character(len=:), allocatable :: text

      text = match%keys
      if (len(text) == 0) text = 'their order'
   end function keys_text

   !> Places of the worst differences, and what cannot be compared
   subroutine print_worst_columns(unit, a, b, result, words)
      !> Unit
      integer, intent(in) :: unit
      !> The tables
      type(table_type), intent(in) :: a, b
      !> Differences
      type(table_result_type), intent(in) :: result
      !> Words of both files
      type(words_type), intent(in) :: words

      integer :: k

      k = maxloc(result%columns%absolute, 1)
      if (result%columns(k)%absolute > 0.0_wp) call print_pair(unit, 'worst absolute:', a, b, &
         result%columns(k), result%columns(k)%absolute_at, words)
      k = maxloc(result%columns%relative, 1)
      if (result%columns(k)%relative > 0.0_wp) call print_pair(unit, 'worst relative:', a, b, &
         result%columns(k), result%columns(k)%relative_at, words)
      if (sum(result%columns%n_unknown) > 0) write (unit, '(2x, a)') &
         count_of(sum(result%columns%n_unknown), 'value')// &
         ' cannot be compared: NaN, infinite or asterisks'
      if (sum(result%columns%n_rounded) > 0) write (unit, '(2x, a)') &
         count_of(sum(result%columns%n_rounded), 'value')// &
         ' agree to the digits printed, not to the tolerance'
   end subroutine print_worst_columns

   !> Two values and where they stand
   subroutine print_pair(unit, what, a, b, column, rows, words)
      !> Unit
      integer, intent(in) :: unit
      !> What is said of them
      character(len=*), intent(in) :: what
      !> The tables
      type(table_type), intent(in) :: a, b
      !> The column
      type(column_result_type), intent(in) :: column
      !> Rows of both tables
      integer, intent(in) :: rows(2)
      !> Words of both files
      type(words_type), intent(in) :: words

      write (unit, '(2x, a)') what//' '//a%columns(column%a)%name//' at '// &
         row_place(a, rows(1), words)// &
         ': A '//value_text(a%cells(column%a, rows(1)), words)//line_text(a%line(rows(1)))// &
         ', B '//value_text(b%cells(column%b, rows(2)), words)//line_text(b%line(rows(2)))
   end subroutine print_pair

   !> Rows that are in one file only
   subroutine print_rows_only(unit, file, table, partner, words)
      !> Unit
      integer, intent(in) :: unit
      !> A or B
      character(len=*), intent(in) :: file
      !> The table
      type(table_type), intent(in) :: table
      !> Row of the other table; 0 if there is none
      integer, intent(in) :: partner(:)
      !> Words of both files
      type(words_type), intent(in) :: words

      integer :: first

      if (all(partner > 0)) return
      first = findloc(partner == 0, .true., 1)
      write (unit, '(2x, a)') count_of(count(partner == 0), 'row')//' only in '//file// &
         '; the first at '// &
         row_place(table, first, words)//line_text(table%line(first))
   end subroutine print_rows_only

   !> A table that is in one file only
   subroutine print_only(unit, file, table)
      !> Unit
      integer, intent(in) :: unit
      !> A or B
      character(len=*), intent(in) :: file
      !> The table
      type(table_type), intent(in) :: table

      write (unit, '(/a)') table_title(table)
      write (unit, '(2x, a)') 'only in '//file//': '//count_of(table%n_rows, 'row')// &
         line_text(table%line(1))
   end subroutine print_only

   !> Numbers and place of a row
   function row_place(table, row, words) result(text)
      !> The table
      type(table_type), intent(in) :: table
      !> The row
      integer, intent(in) :: row
      !> Words of both files
      type(words_type), intent(in) :: words
      !> "node 5, r = 0.5, z = 1"
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(table%columns)
         if (table%columns(k)%kind >= kind_word) cycle
         if (len(text) > 0) text = text//', '
         associate (cell => table%cells(k, row))
            text = text//table%columns(k)%name//' '
            if (cell%state == cell_number) then
               text = text//to_text(cell%value)
            else
               text = text//value_text(cell, words)
            end if
         end associate
      end do
      if (len(text) == 0) text = 'row '//to_text(row)
   end function row_place

   !> A value
   function value_text(cell, words) result(text)
      !> The value
      type(cell_type), intent(in) :: cell
      !> Words of both files
      type(words_type), intent(in) :: words
      !> The text
      character(len=:), allocatable :: text

      character(len=24) :: buffer

      select case (cell%state)
      case (cell_number)
         write (buffer, format_value) cell%value
         text = trim(adjustl(buffer))
      case (cell_blank)
         text = '(blank)'
      case (cell_overflow)
         text = '****'
      case (cell_not_a_number)
         text = 'NaN'
      case (cell_infinite)
         text = trim(merge('-Infinity', 'Infinity ', cell%value < 0.0_wp))
      case default
         text = trim(words%word(nint(cell%value)))
      end select
   end function value_text

   !> Line of a row
   pure function line_text(line) result(text)
      !> Number of the line; 0 if the file has none
      integer, intent(in) :: line
      !> " (line 7)", or nothing
      character(len=:), allocatable :: text

      text = ''
      if (line > 0) text = ' (line '//to_text(line)//')'
   end function line_text

end module axijoint_compare_report
