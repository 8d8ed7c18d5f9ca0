!> Two files, table by table
module axijoint_compare_compare
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : count_of, to_text
   use axijoint_compare_judge, only : table_result_type, judge_tables, largest_values
   use axijoint_compare_match, only : match_type, match_rows
   use axijoint_compare_report, only : print_table, print_only
   use axijoint_compare_table_cell, only : cell_number
   use axijoint_compare_table_numbering, only : numbering_type
   use axijoint_compare_table_table, only : listing_type, table_type, words_type, find_column, &
      kind_angle, kind_word, kind_displacement, kind_names
   use axijoint_compare_tolerances, only : tolerances_type, is_skipped
   implicit none
   private
   public :: compare_listings

   !> What was compared, and what was found
   type :: verdict_type
      !> Tables and values that were compared
      integer :: n_tables = 0, n_values = 0
      !> Tables that differ; values that differ, or cannot be compared
      integer :: n_bad_tables = 0, n_bad = 0, n_unknown = 0
      !> Tables, columns and rows that are in one file only
      integer :: n_tables_only = 0, n_columns_only = 0, n_rows_only = 0
      !> Tables among these of a harmonic that the other file lacks though it has others
      integer :: n_harmonics_only = 0
   end type verdict_type

contains

   !> Compare two files and report on it
   subroutine compare_listings(unit, a, b, words, tolerances, same)
      !> Where the report goes
      integer, intent(in) :: unit
      !> The files
      type(listing_type), intent(in) :: a, b
      !> Words of both
      type(words_type), intent(in) :: words
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Whether they are the same
      logical, intent(out) :: same

      type(numbering_type), allocatable :: numberings(:)
      type(verdict_type) :: verdict
      real(wp) :: scales(size(kind_names))
      integer :: k, other

      allocate (numberings(0))
      scales = min(largest_values(a), largest_values(b))
      write (unit, '(a)') 'A  '//a%path//': '//a%description, 'B  '//b%path//': '//b%description
      if (allocated(a%note)) write (unit, '(a)') 'A  '//a%note
      if (allocated(b%note)) write (unit, '(a)') 'B  '//b%note
      do k = 1, a%n_tables
         if (a%tables(k)%left_out .or. is_skipped(tolerances, a%tables(k)%name)) cycle
         other = find_table(b, a%tables(k))
         if (other > 0) then
            call compare_tables(unit, a%tables(k), b%tables(other), words, scales, tolerances, &
                                numberings, verdict)
         else
            call note_only(unit, 'A', a%tables(k), b, verdict)
         end if
      end do
      do k = 1, b%n_tables
         if (b%tables(k)%left_out .or. is_skipped(tolerances, b%tables(k)%name)) cycle
         if (find_table(a, b%tables(k)) > 0) cycle
         call note_only(unit, 'B', b%tables(k), a, verdict)
      end do
      call print_passed_over(unit, a, b)
      call print_verdict(unit, verdict, tolerances, same)
   end subroutine compare_listings

   !> Name what both files have and was not compared
   subroutine print_passed_over(unit, a, b)
      !> Where the report goes
      integer, intent(in) :: unit
      !> The files
      type(listing_type), intent(in) :: a, b

      integer :: k

      if (.not. (allocated(a%passed_over) .and. allocated(b%passed_over))) return
      write (unit, '()')
      do k = 1, size(a%passed_over)
         if (any(b%passed_over == a%passed_over(k))) write (unit, '(a)') &
            'in both files, and not compared: '//trim(a%passed_over(k))
      end do
   end subroutine print_passed_over

   !> Note a table that one file lacks. A harmonic is not passed over: what it adds to the state is
   !> not there
   subroutine note_only(unit, file, table, other, verdict)
      !> Where the report goes
      integer, intent(in) :: unit
      !> A or B: who has it
      character(len=*), intent(in) :: file
      !> The table
      type(table_type), intent(in) :: table
      !> The file that lacks it
      type(listing_type), intent(in) :: other
      !> What was found so far
      type(verdict_type), intent(inout) :: verdict

      integer :: k
      logical :: harmonic

      call print_only(unit, file, table)
      if (table%kept) return
      verdict%n_tables_only = verdict%n_tables_only + 1
      if (index(table%parameters, 'm = ') == 0 .or. .not. any_value(table)) return
      harmonic = .false.
      do k = 1, other%n_tables
         harmonic = harmonic .or. (other%tables(k)%name == table%name .and. &
            beside_harmonic(other%tables(k)%parameters) == beside_harmonic(table%parameters))
      end do
      if (harmonic) verdict%n_harmonics_only = verdict%n_harmonics_only + 1
   end subroutine note_only

   !> Parameters without harmonic and family
   pure function beside_harmonic(parameters) result(text)
      !> Such as "increment = 1, m = 0, family = symmetric"
      character(len=*), intent(in) :: parameters
      !> Such as "increment = 1, "
      character(len=:), allocatable :: text

      text = parameters
      if (index(text, 'm = ') > 0) text = text(:index(text, 'm = ') - 1)
   end function beside_harmonic

   !> Whether any value of a table is not zero
   pure logical function any_value(table)
      !> The table
      type(table_type), intent(in) :: table

      integer :: k

      any_value = .false.
      do k = 1, size(table%columns)
         if (table%columns(k)%kind < kind_displacement) cycle
         any_value = any_value .or. any(abs(table%cells(k, :table%n_rows)%value) > 0.0_wp .or. &
            table%cells(k, :table%n_rows)%state /= cell_number)
      end do
   end function any_value

   !> Index of the table of the same name and parameters; 0 if there is none
   pure integer function find_table(listing, table) result(found)
      !> The file
      type(listing_type), intent(in) :: listing
      !> The table
      type(table_type), intent(in) :: table

      do found = 1, listing%n_tables
         if (listing%tables(found)%name == table%name &
             .and. listing%tables(found)%parameters == table%parameters) return
      end do
      found = 0
   end function find_table

   !> Compare two tables
   subroutine compare_tables(unit, a, b, words, scales, tolerances, numberings, verdict)
      !> Where the report goes
      integer, intent(in) :: unit
      !> The tables
      type(table_type), intent(in) :: a, b
      !> Words of both files
      type(words_type), intent(in) :: words
      !> Largest values of the files by kind
      real(wp), intent(in) :: scales(:)
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Numbers of nodes and so on in both files
      type(numbering_type), allocatable, intent(inout) :: numberings(:)
      !> What was found so far
      type(verdict_type), intent(inout) :: verdict

      type(match_type) :: match
      type(table_result_type) :: result
      integer :: n_bad

      call match_rows(a, b, tolerances%coordinates, numberings, match)
      call judge_tables(a, b, match, scales, tolerances, result)
      call print_table(unit, a, b, match, result, words)
      call count_columns_only(unit, 'A', a, b, tolerances, verdict)
      call count_columns_only(unit, 'B', b, a, tolerances, verdict)
      n_bad = sum(result%columns%n_different)
      verdict%n_tables = verdict%n_tables + 1
      verdict%n_values = verdict%n_values + sum(result%columns%n)
      verdict%n_bad = verdict%n_bad + n_bad
      verdict%n_unknown = verdict%n_unknown + sum(result%columns%n_unknown)
      verdict%n_rows_only = verdict%n_rows_only + result%n_only_a + result%n_only_b
      if (n_bad > 0) verdict%n_bad_tables = verdict%n_bad_tables + 1
   end subroutine compare_tables

   !> Say which columns only one of the tables has
   subroutine count_columns_only(unit, file, table, other, tolerances, verdict)
      !> Where the report goes
      integer, intent(in) :: unit
      !> A or B
      character(len=*), intent(in) :: file
      !> The tables
      type(table_type), intent(in) :: table, other
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> What was found so far
      type(verdict_type), intent(inout) :: verdict

      integer :: k

      do k = 1, size(table%columns)
         associate (column => table%columns(k))
            if (column%kind < kind_word .and. column%kind /= kind_angle) cycle
            if (find_column(other, column%name, column%kind) > 0) cycle
            if (is_skipped(tolerances, column%name) .or. &
                is_skipped(tolerances, trim(kind_names(column%kind)))) cycle
            write (unit, '(2x, a)') 'column '//column%name//' ('//trim(kind_names(column%kind))// &
               ') only in '//file
            verdict%n_columns_only = verdict%n_columns_only + 1
         end associate
      end do
   end subroutine count_columns_only

   !> The last lines of the report
   subroutine print_verdict(unit, verdict, tolerances, same)
      !> Where the report goes
      integer, intent(in) :: unit
      !> What was found
      type(verdict_type), intent(in) :: verdict
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Whether the files are the same
      logical, intent(out) :: same

      character(len=:), allocatable :: text
      integer :: k

      same = verdict%n_bad == 0 .and. verdict%n_values > 0 &
         .and. (verdict%n_tables_only == 0 .or. tolerances%missing_tables) &
         .and. verdict%n_harmonics_only == 0 .and. (verdict%n_columns_only == 0 .or. tolerances%missing_columns) &
         .and. (verdict%n_rows_only == 0 .or. tolerances%missing_rows)
      write (unit, '(/a)') 'tolerances: relative '//to_text(tolerances%relative)//', absolute '// &
         to_text(tolerances%absolute)//', '//to_text(tolerances%of_table)// &
         ' of the largest in the '// &
         'table, '//to_text(tolerances%of_file)//' of the largest in the file'
      do k = 1, size(tolerances%special)
         associate (special => tolerances%special(k))
            write (unit, '(12x, a)') special%name//': relative '//to_text(special%relative)// &
               ', absolute '//to_text(special%absolute)
         end associate
      end do
      do k = 1, size(tolerances%skipped)
         write (unit, '(a)') 'not compared, as asked: '//tolerances%skipped(k)%text
      end do
      text = merge('SAME     ', 'DIFFERENT', same)
      text = trim(text)//': '//count_of(verdict%n_tables, 'table')//', '// &
             count_of(verdict%n_values, 'value')//' compared; '//to_text(verdict%n_bad)//' differ'
      if (verdict%n_bad > 0) text = text//' in '//count_of(verdict%n_bad_tables, 'table')
      if (verdict%n_unknown > 0) &
         text = text//'; '//to_text(verdict%n_unknown)//' cannot be compared'
      if (verdict%n_tables_only > 0) text = text//'; '//count_of(verdict%n_tables_only, 'table')// &
         ' in one file only'
      if (verdict%n_harmonics_only > 0) text = text//', '//to_text(verdict%n_harmonics_only)// &
         ' of them of harmonics, which --allow-missing does not pass over'
      if (verdict%n_columns_only > 0) &
         text = text//'; '//count_of(verdict%n_columns_only, 'column')// &
         ' in one file only'
      if (verdict%n_rows_only > 0) text = text//'; '//count_of(verdict%n_rows_only, 'row')// &
         ' in one file only'
      write (unit, '(a)') text
   end subroutine print_verdict

end module axijoint_compare_compare
