!> The table of a study: columns name what varies in a deck, lines give values. A line with lists,
!> ranges or distributions stands for many rows
module axijoint_study_table
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : count_of, to_text, upper, did_you_mean
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_field, only : field_type, integer_field, word_field, kind_text, &
      kind_word, kind_code, kind_integer, largest_number
   use axijoint_deck_text_file_bytes, only : read_bytes, line_end, next_line
   use axijoint_deck_text_section, only : names_of, section_named, form_entries
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_source, only : source_type, add_file, add_card, card_text
   use axijoint_deck_text_table, only : table_type
   use axijoint_deck_text_token, only : read_integer, token_good
   use axijoint_study_cell, only : cell_type, read_cell
   use axijoint_study_draw, only : generator_type, new_generator, next_uniform, latin_hypercube, &
      quantile
   implicit none
   private
   public :: study_table_type, read_study_table, change_entries, value_text, values_on_cards

   !> Most rows of a study
   integer, parameter :: most_rows = 10000000
   !> Columns that are no field of a card: rows that a line is drawn as, where the random numbers
   !> begin, how they are drawn
   character(len=8), parameter :: own_names(3) = [character(len=8) :: 'SAMPLES', 'SEED', 'SAMPLER']
   integer, parameter :: own_samples = 1, own_seed = 2, own_sampler = 3
   !> How values are drawn
   character(len=8), parameter :: samplers(2) = [character(len=8) :: 'LHS', 'MC']
   integer, parameter :: sampler_lhs = 1

   !> A column
   type :: column_type
      !> What its head says, in capitals
      character(len=80) :: name = ''
      !> Section (place among those of the deck), entry and field that vary; section 0: one of
      !> `own_names`, by its place in `field`
      integer :: section = 0, entry = 0, field = 0
      !> What may stand in the column
      type(field_type) :: kind
   end type column_type

   !> The table
   type :: study_table_type
      !> Its lines as cards, for messages
      type(source_type) :: source
      !> Columns that name fields of cards
      type(column_type), allocatable :: columns(:)
      !> Value of each row, and whether there is one, shape (columns, rows)
      real(wp), allocatable :: values(:, :)
      logical, allocatable :: given(:, :)
      !> Line of the table (card of the source) that each row is from
      integer, allocatable :: line(:)
   end type study_table_type

   !> A cell's place on its line, first and last byte
   type :: place_type
      integer :: first = 1, last = 0
   end type place_type

contains

   !> Read a table. It is of use only if there are no errors among the messages
   subroutine read_study_table(path, deck, entries, table, diagnostics)
      !> The file
      character(len=*), intent(in) :: path
      !> The deck, for its sections
      type(source_type), intent(in) :: deck
      !> What its cards say
      type(sections_type), intent(in) :: entries
      !> The table
      type(study_table_type), intent(out) :: table
      !> Errors
      type(diagnostics_type), intent(inout) :: diagnostics

      type(column_type), allocatable :: columns(:)
      integer, allocatable :: lines(:)

      allocate (table%columns(0), table%line(0))
      call read_lines(path, table%source, lines, diagnostics)
      if (diagnostics%n_errors > 0) return
      if (size(lines) < 2) then
         call add_error(diagnostics, 0, 0, 0, 'the table has no rows', &
            mend='the first line names what varies, e.g. `LAWS 1 PHI, RESULTANTS 2 VALUE`; '// &
            'every further line gives values, divided by commas')
         return
      end if
      call read_head(table%source, lines(1), deck, entries, columns, diagnostics)
      if (diagnostics%n_errors > 0) return
      table%columns = pack(columns, columns%section > 0)
      call read_rows(table%source, lines(2:), columns, table, diagnostics)
   end subroutine read_study_table

   !> Read the lines of the file; those with something on them count
   subroutine read_lines(path, source, lines, diagnostics)
      !> The file
      character(len=*), intent(in) :: path
      !> Its lines as cards
      type(source_type), intent(out) :: source
      !> Cards that are neither blank nor comments
      integer, allocatable, intent(out) :: lines(:)
      !> Errors
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: bytes, failure, text
      integer :: first, last, line, k

      call read_bytes(path, bytes, failure)
      call add_file(source, path, bytes, 0)
      allocate (lines(0))
      if (len(failure) > 0) then
         call add_error(diagnostics, 0, 0, 0, failure)
         return
      end if
      associate (all => source%files(1)%bytes)
         first = 1
         line = 0
         do while (first <= len(all))
            last = line_end(all, first)
            line = line + 1
            call add_card(source, 1, line, first, last)
            first = next_line(all, last)
         end do
      end associate
      do k = 1, source%n_cards
         text = adjustl(card_text(source, k))
         if (len_trim(text) == 0) cycle
         if (text(1:1) /= '!') lines = [lines, k]
      end do
   end subroutine read_lines

   !> Divide a line at its commas
   pure function places_of(text) result(places)
      !> The line
      character(len=*), intent(in) :: text
      !> The cells, without blanks and tabs at their ends, or quotes about all of them
      type(place_type), allocatable :: places(:)

      character(len=*), parameter :: blanks = ' '//achar(9)
      integer :: k, first, last, n

      n = count([(text(k:k) == ',', k=1, len(text))]) + 1
      allocate (places(n))
      first = 1
      do k = 1, n
         last = index(text(first:)//',', ',') + first - 2
         associate (from => places(k)%first, to => places(k)%last)
            from = first + verify(text(first:last)//'.', blanks) - 1
            to = first + verify(text(first:last), blanks, back=.true.) - 1
            if (to > from) then
               if (text(from:from) == '"' .and. text(to:to) == '"') then
                  from = from + 1
                  to = to - 1
               end if
            end if
         end associate
         if (places(k)%first > last) places(k) = place_type(first, first - 1)
         first = last + 2
      end do
   end function places_of

   !> Read the head of the table
   subroutine read_head(source, line, deck, entries, columns, diagnostics)
      !> The table
      type(source_type), intent(in) :: source
      !> Its first line
      integer, intent(in) :: line
      !> The deck
      type(source_type), intent(in) :: deck
      !> What its cards say
      type(sections_type), intent(in) :: entries
      !> The columns
      type(column_type), allocatable, intent(out) :: columns(:)
      !> Errors
      type(diagnostics_type), intent(inout) :: diagnostics

      type(place_type), allocatable :: places(:)
      character(len=:), allocatable :: text
      integer :: k

      text = card_text(source, line)
      places = places_of(text)
      allocate (columns(size(places)))
      do k = 1, size(places)
         associate (first => places(k)%first, last => places(k)%last)
            call read_name(line, first, last, upper(text(first:last)), deck, entries, columns(k), &
               diagnostics)
            if (any(same_field(columns(:k - 1), columns(k)))) &
               call add_error(diagnostics, line, first, last, 'this column is there before')
         end associate
      end do
   end subroutine read_head

   !> Whether two columns are of one field, whatever they call it
   elemental logical function same_field(one, other)
      !> The columns
      type(column_type), intent(in) :: one, other

      same_field = one%field > 0 .and. one%section == other%section .and. one%entry == other%entry &
         .and. one%field == other%field
   end function same_field

   !> Read the name of a column: `SECTION NUMBER FIELD`, the number left out where a section has one
   !> entry, or one of `own_names`
   subroutine read_name(line, first, last, name, deck, entries, column, diagnostics)
      !> Line and place of the name
      integer, intent(in) :: line, first, last
      !> The name in capitals
      character(len=*), intent(in) :: name
      !> The deck
      type(source_type), intent(in) :: deck
      !> What its cards say
      type(sections_type), intent(in) :: entries
      !> The column
      type(column_type), intent(out) :: column
      !> Errors
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: section, rest
      logical, allocatable :: fits(:)

      column%name = name
      column%field = findloc(own_names, name, 1)
      if (column%field > 0) then
         column%kind = integer_field('the number of '//name, 1, 5, 1, largest_number)
         if (column%field == own_sampler) column%kind = word_field('the sampler', 1, 5, samplers, 1)
         return
      end if
      section = name(:index(name//' ', ' ') - 1)
      rest = trim(adjustl(name(len(section) + 1:)))
      column%section = section_with_entries(deck, section)
      if (column%section == 0) then
         call add_error(diagnostics, line, first, max(last, first), &
            'the column names no section of a deck', found=section, &
            allowed='SECTION NUMBER FIELD, e.g. LAWS 1 PHI; or SAMPLES, SEED, SAMPLER', &
            mend=did_you_mean(section, [character(len=12) :: &
            names_of(pack(deck%sections, deck%sections%form == form_entries)), own_names]))
         return
      end if
      associate (kind => deck%sections(column%section), table => entries%tables(column%section))
         call take_entry(kind%numbered, table, rest, column%entry)
         fits = fields_of(kind%fields, rest)
         if (count(fits) == 1) column%field = findloc(fits, .true., 1)
         if (column%entry == 0) then
            call add_error(diagnostics, line, first, last, 'the deck has no such card of '// &
               section, found=name, allowed=choice_of_entries(section, kind%numbered, table))
         else if (count(fits) > 1) then
            call add_error(diagnostics, line, first, last, 'several fields of '//section// &
               ' have this name', found=rest, allowed=names_of_fields(pack(kind%fields, fits)))
         else if (column%field == 0) then
            call add_error(diagnostics, line, first, last, 'no field of '//section// &
               ' has this name', found=rest, allowed=names_of_fields(kind%fields))
         else
            column%kind = kind%fields(column%field)
            if (column%kind%kind == kind_text) &
               call add_error(diagnostics, line, first, last, 'a text cannot vary', found=rest)
         end if
      end associate
   end subroutine read_name

   !> Place of a section of a name; 0 if it is unknown or has no entries
   pure integer function section_with_entries(deck, name) result(section)
      !> The deck
      type(source_type), intent(in) :: deck
      !> The keyword
      character(len=*), intent(in) :: name

      section = section_named(deck%sections, name)
      if (section == 0) return
      if (deck%sections(section)%form /= form_entries) section = 0
   end function section_with_entries

   !> Take the number of an entry from what follows the section: the entry's own number where it has
   !> one, else its place
   pure subroutine take_entry(numbered, table, rest, entry)
      !> Whether entries have numbers of their own
      logical, intent(in) :: numbered
      !> The entries
      type(table_type), intent(in) :: table
      !> What follows the section; what follows the number on return
      character(len=:), allocatable, intent(inout) :: rest
      !> Place of the entry; 0 if there is none of the number
      integer, intent(out) :: entry

      character(len=:), allocatable :: word
      integer :: number, code

      word = rest(:index(rest//' ', ' ') - 1)
      code = token_good + 1
      if (len(word) > 0) call read_integer(word, number, code)
      entry = 0
      if (code /= token_good) then
         if (table%n == 1) entry = 1
         return
      end if
      rest = trim(adjustl(rest(len(word) + 1:)))
      if (numbered) then
         entry = findloc(nint(table%values(1, :table%n)), number, 1)
      else if (number >= 1 .and. number <= table%n) then
         entry = number
      end if
   end subroutine take_entry

   !> Numbers of entries that may be called, for messages
   pure function choice_of_entries(section, numbered, table) result(text)
      !> The keyword
      character(len=*), intent(in) :: section
      !> Whether entries have numbers of their own
      logical, intent(in) :: numbered
      !> The entries
      type(table_type), intent(in) :: table
      !> In words
      character(len=:), allocatable :: text

      integer, parameter :: most_named = 12
      integer :: i

      if (table%n == 0) then
         text = 'a section that the deck has'
      else if (.not. numbered) then
         text = section//' 1 to '//to_text(table%n)//', by their order'
      else
         text = section
         do i = 1, min(table%n, most_named)
            if (i > 1) text = text//','
            text = text//' '//to_text(nint(table%values(1, i)))
         end do
         if (table%n > most_named) text = text//', ...'
      end if
   end function choice_of_entries

   !> Fields that a column may mean: those of the name, else of the symbol, else with the words in
   !> their names. Where the names of all of these begin with that of one, it is this one: `planes`
   !> is the number of planes, not the number of planes for bodies
   pure function fields_of(fields, name) result(fits)
      !> Fields of the section
      type(field_type), intent(in) :: fields(:)
      !> What the column says, in capitals
      character(len=*), intent(in) :: name
      !> Whether it may mean each
      logical :: fits(size(fields))

      integer :: k

      fits = .false.
      if (len(name) == 0) return
      do k = 1, size(fields)
         fits(k) = name == upper(short_name(fields(k))) .or. name == upper(trim(fields(k)%name))
      end do
      if (any(fits)) return
      do k = 1, size(fields)
         fits(k) = name == upper(trim(fields(k)%symbol)) .and. fields(k)%symbol /= 'x'
      end do
      if (any(fits)) return
      do k = 1, size(fields)
         fits(k) = index(' '//upper(trim(fields(k)%name))//' ', ' '//name//' ') > 0
      end do
      do k = 1, size(fields)
         if (.not. fits(k) .or. any(fits .and. index(fields%name, trim(fields(k)%name)) /= 1)) cycle
         fits = .false.
         fits(k) = .true.
      end do
   end function fields_of

   !> Name of a field without its article
   pure function short_name(field) result(name)
      !> The field
      type(field_type), intent(in) :: field
      !> The name
      character(len=:), allocatable :: name

      name = trim(field%name)
      if (index(name, 'the ') == 1) name = name(5:)
   end function short_name

   !> Names of fields, for messages
   pure function names_of_fields(fields) result(text)
      !> The fields
      type(field_type), intent(in) :: fields(:)
      !> In words
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(fields)
         if (fields(k)%kind == kind_text) cycle
         if (len(text) > 0) text = text//', '
         text = text//short_name(fields(k))
         if (fields(k)%symbol /= 'x' .and. fields(k)%symbol /= short_name(fields(k))) &
            text = text//' ('//trim(fields(k)%symbol)//')'
      end do
   end function names_of_fields

   !> Read the lines with values, and make the rows that they stand for
   subroutine read_rows(source, lines, columns, table, diagnostics)
      !> The table
      type(source_type), intent(in) :: source
      !> Its lines
      integer, intent(in) :: lines(:)
      !> All columns
      type(column_type), intent(in) :: columns(:)
      !> Takes the rows
      type(study_table_type), intent(inout) :: table
      !> Errors
      type(diagnostics_type), intent(inout) :: diagnostics

      type(cell_type), allocatable :: cells(:)
      integer, allocatable :: n_rows(:)
      integer :: k, round, done, errors_before

      errors_before = diagnostics%n_errors
      allocate (n_rows(size(lines)), source=0)
      ! first how many there are, so that there is room for them
      do round = 1, 2
         done = 0
         do k = 1, size(lines)
            if (round == 1) then
               call read_line(source, lines(k), columns, cells, n_rows(k), diagnostics)
            else
               call read_line(source, lines(k), columns, cells)
               call fill_rows(columns, cells, n_rows(k), done, lines(k), table, diagnostics)
            end if
            done = done + n_rows(k)
            if (done > most_rows) then
               call add_error(diagnostics, lines(k), 0, 0, 'the table has more than '// &
                  to_text(most_rows)//' rows')
               return
            end if
         end do
         if (diagnostics%n_errors > errors_before) return
         if (round == 2) return
         allocate (table%values(size(table%columns), done), source=0.0_wp)
         allocate (table%given(size(table%columns), done), source=.false.)
         deallocate (table%line)
         allocate (table%line(done), source=0)
      end do
   end subroutine read_rows

   !> Read a line
   subroutine read_line(source, line, columns, cells, n_rows, diagnostics)
      !> The table
      type(source_type), intent(in) :: source
      !> The line
      integer, intent(in) :: line
      !> All columns
      type(column_type), intent(in) :: columns(:)
      !> The cells
      type(cell_type), allocatable, intent(out) :: cells(:)
      !> Rows that it stands for
      integer, intent(out), optional :: n_rows
      !> Errors; not told if absent
      type(diagnostics_type), intent(inout), optional :: diagnostics

      type(place_type), allocatable :: places(:)
      character(len=:), allocatable :: text
      real(wp) :: rows
      logical :: faulty(size(columns))
      integer :: k

      text = card_text(source, line)
      places = places_of(text)
      faulty = .false.
      allocate (cells(size(columns)))
      if (present(diagnostics) .and. size(places) /= size(columns)) then
         call add_error(diagnostics, line, 1, len(text), 'the line has '// &
            count_of(size(places), 'cell')//', the head of the table '//to_text(size(columns)), &
            mend='divide cells by commas; an empty cell keeps the deck''s value')
         if (present(n_rows)) n_rows = 0
         return
      end if
      rows = 1.0_wp
      do k = 1, size(columns)
         associate (first => places(k)%first, last => places(k)%last, cell => cells(k))
            call read_cell(columns(k)%kind, text(first:last), cell)
            if (present(diagnostics) .and. len(cell%fault) == 0 .and. columns(k)%section == 0 &
                .and. (size(cell%values) > 1 .or. cell%distribution > 0)) &
               cell%fault = trim(columns(k)%name)//' is one value'
            faulty(k) = len(cell%fault) > 0
            if (present(diagnostics) .and. faulty(k)) &
               call add_error(diagnostics, line, first, max(first, last), cell%fault, &
                  found=text(first:last), allowed=cell%allowed, mend=cell%mend)
            if (columns(k)%section > 0) rows = rows*max(1, size(cell%values))
         end associate
      end do
      ! a cell with a fault may be meant as the number, or as the distribution: its fault is told alone
      if (any(cells%distribution > 0)) then
         rows = rows*own_value(columns, cells, own_samples, 0)
         if (present(diagnostics) .and. own_value(columns, cells, own_samples, 0) == 0 .and. &
             .not. any(faulty .and. columns%section == 0)) &
            call add_error(diagnostics, line, 1, len(text), &
            'nothing says how many rows are drawn', &
               mend='add a column SAMPLES with the number')
      else if (present(diagnostics) .and. own_value(columns, cells, own_samples, 0) > 0 .and. &
               .not. any(faulty .and. columns%section > 0)) then
         call add_error(diagnostics, line, 1, len(text), 'nothing is drawn of which SAMPLES could say how much', &
            mend='leave SAMPLES blank on this line, or give a distribution, such as NORMAL 30 2')
      end if
      if (present(n_rows)) n_rows = int(min(rows, real(most_rows + 1, wp)))
   end subroutine read_line

   !> Value of one of the columns that are no fields
   pure integer function own_value(columns, cells, own, default) result(value)
      !> All columns
      type(column_type), intent(in) :: columns(:)
      !> Their cells
      type(cell_type), intent(in) :: cells(:)
      !> One of the `own_` parameters
      integer, intent(in) :: own
      !> Value if there is none
      integer, intent(in) :: default

      integer :: k

      value = default
      do k = 1, size(columns)
         if (columns(k)%section > 0 .or. columns(k)%field /= own) cycle
         if (size(cells(k)%values) > 0) value = nint(cells(k)%values(1))
      end do
   end function own_value

   !> Make the rows of a line: all combinations of its lists, the last column changing fastest, each
   !> with all that is drawn
   subroutine fill_rows(columns, cells, n_rows, done, line, table, diagnostics)
      !> All columns
      type(column_type), intent(in) :: columns(:)
      !> Cells of the line
      type(cell_type), intent(in) :: cells(:)
      !> Rows to make, rows there are
      integer, intent(in) :: n_rows, done
      !> The line
      integer, intent(in) :: line
      !> Takes the rows
      type(study_table_type), intent(inout) :: table
      !> Errors: a value drawn that the card does not take
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp), allocatable :: drawn(:)
      integer :: column, k, i, n, each, samples

      samples = 1
      if (any(cells%distribution > 0)) samples = own_value(columns, cells, own_samples, 1)
      table%line(done + 1:done + n_rows) = line
      each = n_rows
      column = 0
      do k = 1, size(columns)
         if (columns(k)%section == 0) cycle
         column = column + 1
         if (cells(k)%distribution > 0) then
            call draw(columns(k), cells(k), &
               own_value(columns, cells, own_sampler, sampler_lhs) == sampler_lhs, &
               new_generator(own_value(columns, cells, own_seed, 1), column), drawn)
            do i = 1, n_rows
               table%values(column, done + i) = drawn(mod(i - 1, samples) + 1)
            end do
         else if (size(cells(k)%values) > 0) then
            n = size(cells(k)%values)
            each = each/n
            do i = 1, n_rows
               table%values(column, done + i) = cells(k)%values(mod((i - 1)/each, n) + 1)
            end do
         else
            cycle
         end if
         table%given(column, done + 1:done + n_rows) = .true.
      end do

   contains

      !> Draw the values of a column
      subroutine draw(column, cell, stratified, stream, values)
         !> The column, its cell
         type(column_type), intent(in) :: column
         type(cell_type), intent(in) :: cell
         !> Whether one is drawn of each of as many equal parts
         logical, intent(in) :: stratified
         !> The random numbers
         type(generator_type), intent(in) :: stream
         !> The values
         real(wp), allocatable, intent(out) :: values(:)

         type(generator_type) :: generator
         integer :: i

         generator = stream
         allocate (values(samples))
         if (stratified) then
            call latin_hypercube(generator, values)
         else
            do i = 1, samples
               call next_uniform(generator, values(i))
            end do
         end if
         do i = 1, samples
            values(i) = quantile(cell%distribution, cell%parameters, values(i))
         end do
         if (any(values < column%kind%low .or. values > column%kind%high)) &
            call add_error(diagnostics, line, 0, 0, trim(column%name)// &
            ': a value is drawn that '// &
               'the card does not take', found=to_text(minval(values))//' to '// &
               to_text(maxval(values)), allowed=cell%allowed, &
               mend='TRUNCATED mean deviation low high stays between two ends')
      end subroutine draw

   end subroutine fill_rows

   !> Let the cards say what a row says
   subroutine change_entries(table, row, entries)
      !> The table
      type(study_table_type), intent(in) :: table
      !> The row
      integer, intent(in) :: row
      !> What the cards of the deck say
      type(sections_type), intent(inout) :: entries

      integer :: k

      do k = 1, size(table%columns)
         if (.not. table%given(k, row)) cycle
         associate (column => table%columns(k))
            entries%tables(column%section)%values(column%field, column%entry) = &
               table%values(k, row)
            entries%tables(column%section)%given(column%field, column%entry) = .true.
         end associate
      end do
   end subroutine change_entries

   !> A value of a row as it would stand on a card; empty if the deck's stays
   function value_text(table, column, row) result(text)
      !> The table
      type(study_table_type), intent(in) :: table
      !> Column and row
      integer, intent(in) :: column, row
      !> The text
      character(len=:), allocatable :: text

      character(len=24) :: digits

      text = ''
      if (.not. table%given(column, row)) return
      associate (value => table%values(column, row), kind => table%columns(column)%kind)
         if (kind%kind == kind_word) then
            text = trim(kind%words(nint(value)))
         else if (kind%kind == kind_code) then
            write (digits, '(b3.3)') nint(value)
            text = trim(adjustl(digits))
         else if (kind%kind == kind_integer) then
            text = to_text(nint(value))
         else
            write (digits, '(es24.16e3)') value
            text = trim(adjustl(digits))
         end if
      end associate
   end function value_text

   !> All values as they would stand on cards, words by their place among those allowed
   pure function values_on_cards(table) result(values)
      !> The table
      type(study_table_type), intent(in) :: table
      !> Shape (columns, rows)
      real(wp) :: values(size(table%values, 1), size(table%values, 2))

      integer :: k

      values = table%values
      do k = 1, size(table%columns)
         if (table%columns(k)%kind%kind == kind_code) values(k, :) = digits_of(nint(values(k, :)))
      end do
   end function values_on_cards

   !> The number of three digits 0 or 1 that a code is written as
   elemental real(wp) function digits_of(code)
      !> The code
      integer, intent(in) :: code

      digits_of = 100.0_wp*ibits(code, 2, 1) + 10.0_wp*ibits(code, 1, 1) + ibits(code, 0, 1)
   end function digits_of

end module axijoint_study_table
