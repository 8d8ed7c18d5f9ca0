!> Tables of a listing or of a result file, as they are compared
module axijoint_compare_table_table
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : lower
   use axijoint_compare_table_cell, only : cell_type
   implicit none
   private
   public :: column_type, table_type, listing_type, words_type
   public :: open_table, drop_empty_tables, add_row, find_column, word_index, table_title, &
      append_columns
   public :: kind_names, kind_label, kind_key, kind_coordinate, kind_angle, kind_parameter, &
      kind_skip, kind_word, kind_displacement, kind_jump, kind_stress, kind_force, kind_moment, &
      kind_other

   !> Number of a node, element, joint or point, which differs between programs
   integer, parameter :: kind_label = 1
   !> Number or word that means the same in every program
   integer, parameter :: kind_key = 2
   !> r or z
   integer, parameter :: kind_coordinate = 3
   !> theta in degrees
   integer, parameter :: kind_angle = 4
   !> Number or word that parts a table into several, such as the harmonic
   integer, parameter :: kind_parameter = 5
   !> Not read
   integer, parameter :: kind_skip = 6
   !> Word that is compared
   integer, parameter :: kind_word = 7
   !> Numbers that are compared, by their quantity
   integer, parameter :: kind_displacement = 8, kind_jump = 9, kind_stress = 10, kind_force = 11, &
      kind_moment = 12, kind_other = 13
   !> Names of the kinds
   character(len=*), parameter :: kind_names(13) = [character(len=12) :: 'label', 'key', &
      'coordinate', 'angle', 'parameter', 'skip', 'word', 'displacement', 'jump', 'stress', &
      'force', 'moment', 'other']

   !> Words of both files, so that equal words have equal indices
   type :: words_type
      !> The words
      character(len=32), allocatable :: word(:)
   end type words_type

   !> A column
   type :: column_type
      !> Name
      character(len=:), allocatable :: name
      !> One of the `kind_` parameters
      integer :: kind = kind_other
   end type column_type

   !> A table
   type :: table_type
      !> Name
      character(len=:), allocatable :: name
      !> Its parameters: "m = 1, family = symmetric"; empty without
      character(len=:), allocatable :: parameters
      !> Columns
      type(column_type), allocatable :: columns(:)
      !> Whether other tables stand for it
      logical :: left_out = .false.
      !> Whether a file has it as its job wished so: it is passed over where the other has none
      logical :: kept = .false.
      !> Number of rows
      integer :: n_rows = 0
      !> Values, at least (columns, n_rows)
      type(cell_type), allocatable :: cells(:, :)
      !> Line of each row in its file; 0 in files without lines
      integer, allocatable :: line(:)
   end type table_type

   !> All tables of a file
   type :: listing_type
      !> Path
      character(len=:), allocatable :: path
      !> What kind of file it is
      character(len=:), allocatable :: description
      !> Whether all tables of amplitudes have the same rows in the same order
      logical :: aligned = .false.
      !> Whether it is a listing in the layout of Owen and Hinton's program: its tables of results have
      !> increments among their parameters
      logical :: old_layout = .false.
      !> Increments that it names, if so
      integer, allocatable :: increments(:)
      !> What the report says of it beside its tables; not allocated if nothing
      character(len=:), allocatable :: note
      !> What it has and is not compared; not allocated if nothing
      character(len=64), allocatable :: passed_over(:)
      !> Number of tables
      integer :: n_tables = 0
      !> The tables, at least n_tables
      type(table_type), allocatable :: tables(:)
   end type listing_type

contains

   !> Index of a word, a new one if need be; letter case does not count
   subroutine word_index(words, text, found)
      !> The words
      type(words_type), intent(inout) :: words
      !> The word
      character(len=*), intent(in) :: text
      !> Its index
      integer, intent(out) :: found

      character(len=32) :: small

      small = lower(text)
      if (.not. allocated(words%word)) allocate (words%word(0))
      do found = 1, size(words%word)
         if (words%word(found) == small) return
      end do
      words%word = [character(len=len(small)) :: words%word, small]
   end subroutine word_index

   !> Index of a table, a new one if there is none of its name and parameters
   subroutine open_table(listing, name, parameters, columns, found)
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name and parameters
      character(len=*), intent(in) :: name, parameters
      !> Columns of a new table
      type(column_type), intent(in) :: columns(:)
      !> Index of the table
      integer, intent(out) :: found

      type(table_type), allocatable :: larger(:)
      integer :: i

      do found = listing%n_tables, 1, -1
         if (listing%tables(found)%name == name &
             .and. listing%tables(found)%parameters == parameters) return
      end do
      if (.not. allocated(listing%tables)) allocate (listing%tables(16))
      if (listing%n_tables == size(listing%tables)) then
         allocate (larger(2*listing%n_tables))
         do i = 1, listing%n_tables
            call move_table(listing%tables(i), larger(i))
         end do
         call move_alloc(larger, listing%tables)
      end if
      listing%n_tables = listing%n_tables + 1
      found = listing%n_tables
      associate (table => listing%tables(found))
         table%name = name
         table%parameters = parameters
         allocate (table%columns(size(columns)))
         table%columns = columns
         allocate (table%cells(size(columns), 32), table%line(32))
      end associate
   end subroutine open_table

   !> Move a table without copying its values
   subroutine move_table(from, to)
      !> Table that is left empty
      type(table_type), intent(inout) :: from
      !> Table that takes its contents
      type(table_type), intent(inout) :: to

      call move_alloc(from%name, to%name)
      call move_alloc(from%parameters, to%parameters)
      call move_alloc(from%columns, to%columns)
      call move_alloc(from%cells, to%cells)
      call move_alloc(from%line, to%line)
      to%left_out = from%left_out
      to%kept = from%kept
      to%n_rows = from%n_rows
      from%left_out = .false.
      from%kept = .false.
      from%n_rows = 0
   end subroutine move_table

   !> Forget the tables without rows: a listing shows nothing of them
   subroutine drop_empty_tables(listing)
      !> The tables
      type(listing_type), intent(inout) :: listing

      integer :: i, n

      n = 0
      do i = 1, listing%n_tables
         if (listing%tables(i)%n_rows == 0) cycle
         n = n + 1
         if (n < i) call move_table(listing%tables(i), listing%tables(n))
      end do
      listing%n_tables = n
   end subroutine drop_empty_tables

   !> Add a row
   subroutine add_row(table, cells, line)
      !> The table
      type(table_type), intent(inout) :: table
      !> Values by column
      type(cell_type), intent(in) :: cells(:)
      !> Line in the file
      integer, intent(in) :: line

      type(cell_type), allocatable :: larger(:, :)
      integer, allocatable :: lines(:)
      integer :: n

      n = table%n_rows
      if (n == size(table%line)) then
         allocate (larger(size(cells), 2*n), lines(2*n))
         larger(:, :n) = table%cells
         lines(:n) = table%line
         call move_alloc(larger, table%cells)
         call move_alloc(lines, table%line)
      end if
      table%n_rows = n + 1
      table%cells(:, n + 1) = cells
      table%line(n + 1) = line
   end subroutine add_row

   !> Add columns on the right
   subroutine append_columns(table, columns, cells)
      !> The table
      type(table_type), intent(inout) :: table
      !> The new columns
      type(column_type), intent(in) :: columns(:)
      !> Their values, shape (columns, rows)
      type(cell_type), intent(in) :: cells(:, :)

      type(cell_type), allocatable :: wider(:, :)
      type(column_type), allocatable :: all(:)
      integer :: n

      n = size(table%columns)
      allocate (wider(n + size(columns), size(table%line)), all(n + size(columns)))
      all(:n) = table%columns
      all(n + 1:) = columns
      wider(:n, :table%n_rows) = table%cells(:, :table%n_rows)
      wider(n + 1:, :table%n_rows) = cells
      call move_alloc(wider, table%cells)
      call move_alloc(all, table%columns)
   end subroutine append_columns

   !> Index of a column by its name and kind; 0 if there is none
   pure integer function find_column(table, name, kind) result(found)
      !> The table
      type(table_type), intent(in) :: table
      !> Name
      character(len=*), intent(in) :: name
      !> One of the `kind_` parameters
      integer, intent(in) :: kind

      do found = 1, size(table%columns)
         if (table%columns(found)%kind == kind .and. table%columns(found)%name == name) return
      end do
      found = 0
   end function find_column

   !> Name and parameters
   pure function table_title(table) result(title)
      !> The table
      type(table_type), intent(in) :: table
      !> The text
      character(len=:), allocatable :: title

      title = table%name
      if (len(table%parameters) > 0) title = title//', '//table%parameters
   end function table_title

end module axijoint_compare_table_table
