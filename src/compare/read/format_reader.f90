!> Cards of a format description to a format
module axijoint_compare_read_format_reader
   use axijoint_base_text, only : upper, did_you_mean, to_text
   use axijoint_compare_read_column_card, only : read_column
   use axijoint_compare_read_format, only : format_type, table_format_type, column_format_type, &
      pattern_type, end_blank, end_next, end_heading, end_text
   use axijoint_compare_read_format_checks, only : check_format
   use axijoint_compare_read_pattern, only : next_word
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_file_bytes, only : line_end, next_line
   use axijoint_deck_text_source, only : source_type, add_file, add_card, card_content
   use axijoint_deck_text_token, only : read_integer, token_good
   implicit none
   private
   public :: read_format

   !> Words that a card may begin with
   character(len=*), parameter :: card_names(11) = [character(len=8) :: 'FORMAT', 'FIRST', 'LAST', &
      'IGNORE', 'LINE', 'CARRIAGE', 'TABLE', 'HEADING', 'SKIP', 'ENDS', 'COLUMN']
   !> Cards that belong to a table
   character(len=*), parameter :: table_cards(4) = [character(len=8) :: 'HEADING', 'SKIP', 'ENDS', &
      'COLUMN']
   !> What an ENDS card may say
   character(len=*), parameter :: endings(4) = &
      [character(len=8) :: 'BLANK', 'NEXT', 'HEADING', 'AT']

contains

   !> Read a format description
   subroutine read_format(path, bytes, source, format, diagnostics)
      !> Path, for messages
      character(len=*), intent(in) :: path
      !> Its bytes; unallocated on return
      character(len=:), allocatable, intent(inout) :: bytes
      !> Its cards
      type(source_type), intent(out) :: source
      !> The format; of use only if there are no errors
      type(format_type), intent(out) :: format
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: table_card(:)
      integer :: card

      call split_cards(path, bytes, source)
      allocate (format%ignored(0), format%lines(0), format%tables(0), table_card(0))
      format%name = ''
      format%first = ''
      format%last = ''
      do card = 1, source%n_cards
         call read_card(source, card, format, table_card, diagnostics)
      end do
      call check_format(source, format, table_card, diagnostics)
   end subroutine read_format

   !> Divide a file into cards
   subroutine split_cards(path, bytes, source)
      !> Path
      character(len=*), intent(in) :: path
      !> Its bytes; unallocated on return
      character(len=:), allocatable, intent(inout) :: bytes
      !> Its cards
      type(source_type), intent(out) :: source

      integer :: first, last, line

      call add_file(source, path, bytes, 0)
      associate (text => source%files(1)%bytes)
         first = 1
         line = 0
         do while (first <= len(text))
            line = line + 1
            last = line_end(text, first)
            call add_card(source, 1, line, first, last)
            first = next_line(text, last)
         end do
      end associate
   end subroutine split_cards

   !> One card
   subroutine read_card(source, card, format, table_card, diagnostics)
      !> Cards
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card
      !> The format
      type(format_type), intent(inout) :: format
      !> Card of each table
      integer, allocatable, intent(inout) :: table_card(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: content, name, rest
      integer :: first, last, n

      content = card_content(source, card)
      call next_word(content, 1, first, last)
      if (first == 0) return
      name = upper(content(first:last))
      rest = trim(adjustl(content(last + 1:)))
      n = size(format%tables)
      if (.not. any(card_names == name)) then
         call report_unknown(card, first, last, content(first:last), diagnostics)
      else if (any(table_cards == name) .and. n == 0) then
         call add_error(diagnostics, card, first, last, 'there is no TABLE card above', &
            found=name, mend='a card TABLE NAME begins each table')
      else if (len(rest) == 0 .and. name /= 'CARRIAGE') then
         call add_error(diagnostics, card, first, last, 'nothing follows '//name, &
            mend='see doc/compare.md')
      else if (name == 'TABLE') then
         call add_table(format, rest)
         table_card = [table_card, card]
      else if (any(table_cards == name)) then
         call read_table_card(source, card, name, rest, last, format%tables(n), diagnostics)
      else
         call read_format_card(card, name, rest, first, len(content), format, diagnostics)
      end if
   end subroutine read_card

   !> A card that belongs to no table
   subroutine read_format_card(card, name, rest, first, last, format, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> Its first word, and what follows
      character(len=*), intent(in) :: name, rest
      !> Columns of the card
      integer, intent(in) :: first, last
      !> The format
      type(format_type), intent(inout) :: format
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      select case (name)
      case ('FORMAT')
         format%name = rest
      case ('FIRST')
         format%first = rest
      case ('LAST')
         format%last = rest
      case ('IGNORE')
         format%ignored = [format%ignored, pattern_type(rest)]
      case ('LINE')
         format%lines = [format%lines, pattern_type(rest)]
      case default
         format%carriage = .true.
         if (len(rest) > 0) call add_error(diagnostics, card, first, last, &
            'CARRIAGE stands alone on its card', found=rest)
      end select
   end subroutine read_format_card

   !> A card of a table
   subroutine read_table_card(source, card, name, rest, last, table, diagnostics)
      !> Cards
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card
      !> Its first word, and what follows
      character(len=*), intent(in) :: name, rest
      !> Last column of the first word
      integer, intent(in) :: last
      !> The table
      type(table_format_type), intent(inout) :: table
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(column_format_type) :: column
      character(len=:), allocatable :: content
      logical :: good
      integer :: fault

      content = card_content(source, card)
      select case (name)
      case ('HEADING')
         table%heading = rest
      case ('SKIP')
         call read_integer(rest, table%skip, fault)
         if (fault /= token_good .or. table%skip < 0) then
            call add_error(diagnostics, card, last + 1, len(content), &
               'SKIP needs a number of lines', found=rest, allowed='an integer from 0')
            table%skip = 0
         end if
      case ('ENDS')
         call read_ending(card, rest, last + 1, len(content), table, diagnostics)
      case default
         call read_column(card, content, last + 1, column, good, diagnostics)
         if (good) call add_column(table, column)
      end select
   end subroutine read_table_card

   !> How a table ends
   subroutine read_ending(card, rest, first, last, table, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> What the card says
      character(len=*), intent(in) :: rest
      !> Its columns
      integer, intent(in) :: first, last
      !> The table
      type(table_format_type), intent(inout) :: table
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, parameter :: codes(4) = [end_blank, end_next, end_heading, end_text]
      integer :: from, to, k

      call next_word(rest, 1, from, to)
      k = findloc(endings == upper(rest(from:to)), .true., 1)
      if (k == 0 .or. (k < 4 .and. to < len(rest)) .or. (k == 4 .and. to == len(rest))) then
         call add_error(diagnostics, card, first, last, 'ENDS needs to say what ends the rows', &
            found=rest, allowed='BLANK (a blank line), NEXT (another heading), HEADING (the '// &
            'heading is the only row) or AT TEXT (a line with this text)')
         return
      end if
      table%ending = codes(k)
      if (k == 4) table%ending_text = trim(adjustl(rest(to + 1:)))
   end subroutine read_ending

   !> Report a word that no card begins with
   subroutine report_unknown(card, first, last, word, diagnostics)
      !> The card and the columns of the word
      integer, intent(in) :: card, first, last
      !> The word
      character(len=*), intent(in) :: word
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: allowed
      integer :: k

      allowed = ''
      do k = 1, size(card_names)
         allowed = allowed//' '//trim(card_names(k))
      end do
      call add_error(diagnostics, card, first, last, 'no card of a format begins so', found=word, &
         allowed=allowed(2:), mend=did_you_mean(word, card_names))
   end subroutine report_unknown

   !> Add a table without columns
   subroutine add_table(format, name)
      !> The format
      type(format_type), intent(inout) :: format
      !> Name of the table
      character(len=*), intent(in) :: name

      type(table_format_type), allocatable :: larger(:)
      integer :: n

      n = size(format%tables)
      allocate (larger(n + 1))
      larger(:n) = format%tables
      larger(n + 1)%name = name
      larger(n + 1)%heading = ''
      larger(n + 1)%ending_text = ''
      allocate (larger(n + 1)%columns(0))
      call move_alloc(larger, format%tables)
   end subroutine add_table

   !> Add a column
   subroutine add_column(table, column)
      !> The table
      type(table_format_type), intent(inout) :: table
      !> The column
      type(column_format_type), intent(in) :: column

      type(column_format_type), allocatable :: larger(:)
      integer :: n

      n = size(table%columns)
      allocate (larger(n + 1))
      larger(:n) = table%columns
      larger(n + 1) = column
      call move_alloc(larger, table%columns)
   end subroutine add_column

end module axijoint_compare_read_format_reader
