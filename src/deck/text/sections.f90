!> The cards of a deck sorted into sections and read into tables
module axijoint_deck_text_sections
   use axijoint_base_text, only : to_text, count_of, upper
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_deck_text_entry_reader, only : read_entries
   use axijoint_deck_text_field, only : field_type
   use axijoint_deck_text_section, only : cards_per_entry, keyword_fields, &
      form_entries, form_include, form_file, keyword_length, card_width
   use axijoint_deck_text_source, only : source_type, card_text, card_content, card_position, &
      card_title, card_data, card_keyword, form_of, keep_utf8, tab
   use axijoint_deck_text_table, only : table_type, new_table, read_entry, entry_error, &
      field_error, integer_value
   implicit none
   private
   public :: sections_type, read_sections, table_of

   !> What the cards of a deck say, before anything is made of it
   type :: sections_type
      !> Keyword and entries of each section of the source
      character(len=keyword_length), allocatable :: names(:)
      type(table_type), allocatable :: tables(:)
      !> The entries of a section that the source cannot have: none
      type(table_type) :: none
      !> Title
      character(len=:), allocatable :: title
      !> Keyword cards that no entries follow and that do not announce none
      integer, allocatable :: empty(:)
      !> False if cards are lacking or belong nowhere, so that references
      !> between cards cannot be judged
      logical :: complete = .true.
   end type sections_type

   !> An entry without fields
   type(field_type), target, save :: no_fields(0)

contains

   !> Sort and read all cards
   subroutine read_sections(source, sections, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Its sections
      type(sections_type), intent(out) :: sections
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: owner(:), entries(:)
      integer, allocatable :: n_cards(:)
      integer :: section, card

      allocate (n_cards(0:size(source%sections)), source=0)
      allocate (sections%tables(size(source%sections)))
      sections%names = source%sections%name
      sections%none = new_table(no_fields, 0)
      sections%complete = source%complete
      call find_owners(source, owner, sections%complete, diagnostics)
      call check_repeated(source, diagnostics)
      call read_title(source, sections%title, diagnostics)
      call check_comments(source, diagnostics)
      do card = 1, source%n_cards
         if (owner(card) == 0) cycle
         section = source%cards(owner(card))%keyword
         n_cards(section) = n_cards(section) + 1
      end do
      do section = 1, size(source%sections)
         associate (kind => source%sections(section))
            sections%tables(section) = new_table(kind%fields, &
               n_cards(section)/cards_per_entry(kind))
         end associate
      end do
      allocate (entries(source%n_cards), source=0)
      call read_entries(source, owner, sections%tables, entries, sections%complete, diagnostics)
      call read_keywords(source, entries, sections, diagnostics)
      do section = 1, size(source%sections)
         if (source%sections(section)%required) &
            call check_there(source, section, sections, diagnostics)
      end do
   end subroutine read_sections

   !> The keyword card that each data card belongs to. A file begins in the section
   !> that is open where it is included, and leaves that section open
   subroutine find_owners(source, owner, complete, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Keyword card of each card; 0 if it is no data card or belongs nowhere
      integer, allocatable, intent(out) :: owner(:)
      !> Made false if a card belongs nowhere
      logical, intent(inout) :: complete
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, parameter :: unset = -1
      integer, allocatable :: open_section(:)
      integer :: card, file, reported

      allocate (owner(source%n_cards), source=0)
      allocate (open_section(0:source%n_files), source=unset)
      open_section(0) = 0
      reported = unset
      do card = 1, source%n_cards
         file = source%cards(card)%file
         if (open_section(file) == unset) &
            open_section(file) = open_section(source%files(file)%parent)
         if (source%cards(card)%kind == card_keyword) then
            if (all(form_of(source, card) /= [form_include, form_file])) open_section(file) = card
         else if (source%cards(card)%kind == card_data) then
            if (takes_data(source, open_section(file))) then
               owner(card) = open_section(file)
            else if (open_section(file) /= reported) then
               reported = open_section(file)
               call report_homeless(source, card, reported, complete, diagnostics)
            end if
         end if
      end do
   end subroutine find_owners

   !> Whether a keyword card opens a section of data cards
   pure logical function takes_data(source, card)
      !> The deck
      type(source_type), intent(in) :: source
      !> The keyword card; 0 for none
      integer, intent(in) :: card

      takes_data = card > 0
      if (takes_data) takes_data = form_of(source, card) == form_entries
   end function takes_data

   !> Report a data card that belongs to no section
   subroutine report_homeless(source, card, keyword_card, complete, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The data card
      integer, intent(in) :: card
      !> The keyword card before it; 0 for none
      integer, intent(in) :: keyword_card
      !> Made false: the cards are lost
      logical, intent(inout) :: complete
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: text

      complete = .false.
      text = 'this data card comes before the first keyword'
      if (keyword_card > 0) then
         if (source%cards(keyword_card)%keyword == 0) return  ! reported with its keyword
         text = 'this data card follows the title, which is one card only'
      end if
      call add_error(diagnostics, card, 1, len(card_content(source, card)), text, &
                     mend='a keyword, written from column 1, opens a section; comments begin '// &
                     'with !')
   end subroutine report_homeless

   !> Report the second keyword of a section that is there once
   subroutine check_repeated(source, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: name
      integer, allocatable :: seen(:)
      integer :: card

      allocate (seen(size(source%sections)), source=0)
      do card = 1, source%n_cards
         if (source%cards(card)%kind /= card_keyword) cycle
         associate (section => source%cards(card)%keyword)
            if (section == 0) cycle
            if (.not. source%sections(section)%once) cycle
            if (seen(section) > 0) then
               name = trim(source%sections(section)%name)
               call add_error(diagnostics, card, 1, len(name), name// &
                  ' is there twice, first on '// &
                              card_position(source, seen(section), card))
            else
               seen(section) = card
            end if
         end associate
      end do
   end subroutine check_repeated

   !> Warn of the first card with a comment that is not UTF-8; what else is not on a card is an error
   subroutine check_comments(source, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: text
      integer :: card
      logical :: valid

      if (.not. source%complete) return
      do card = 1, source%n_cards
         if (source%cards(card)%kind == card_title) cycle
         text = card_text(source, card)
         text = text(len(card_content(source, card)) + 1:)
         call keep_utf8(text, valid)
         if (valid) cycle
         call add_warning(diagnostics, card, 0, 0, 'a comment is not valid UTF-8', &
            mend='what is not UTF-8 is shown as ?; save the deck as UTF-8')
         return
      end do
   end subroutine check_comments

   !> Read the title card: UTF-8 is kept, what is not UTF-8 becomes question marks
   subroutine read_title(source, title, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The title; empty if the deck has none
      character(len=:), allocatable, intent(out) :: title
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: card, i
      logical :: valid

      title = ''
      card = findloc(source%cards(:source%n_cards)%kind, card_title, 1)
      if (card == 0) return
      title = trim(card_text(source, card))
      do i = 1, len(title)
         if (title(i:i) == tab) title(i:i) = ' '
      end do
      call keep_utf8(title, valid)
      if (.not. valid) then
         call add_warning(diagnostics, card, 0, 0, 'the title is not valid UTF-8', &
                          mend='what is not UTF-8 is shown as ?; save the deck as UTF-8')
      end if
      ! Bytes that begin with the bits 10 continue a character.
      if (count([(iand(iachar(title(i:i)), 192) /= 128, i=1, len(title))]) > card_width) then
         call add_error(diagnostics, card, card_width + 1, len(title), &
                        'the title runs past column 80', found=title(card_width + 1:))
      end if
   end subroutine read_title

   !> Read the keyword cards and check the numbers of entries given there
   subroutine read_keywords(source, entries, sections, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Number of entries that follow each keyword card
      integer, intent(in) :: entries(:)
      !> The sections, whether they are complete; takes those without entries
      type(sections_type), intent(inout) :: sections
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(table_type) :: table
      type(field_type), allocatable, target :: fields(:)
      integer :: card

      allocate (sections%empty(0))
      do card = 1, source%n_cards
         if (source%cards(card)%kind /= card_keyword) cycle
         associate (section => source%cards(card)%keyword)
            if (any(form_of(source, card) == [0, form_include, form_file])) cycle
            if (.not. starts_with_letter(source, card)) cycle  ! reported already
            fields = keyword_fields(source%sections(section))
            table = new_table(fields, 1)
            call read_entry(table, source, [card], diagnostics)
            if (source%sections(section)%form /= form_entries) cycle
            if (.not. table%given(2, 1)) then
               if (entries(card) == 0 .and. .not. source%sections(section)%alone) &
                  sections%empty = [sections%empty, card]
               cycle
            end if
            if (integer_value(table, 2, 1) == entries(card) .or. .not. sections%complete) cycle
            call field_error(diagnostics, source, table, 1, 2, &
                             trim(source%sections(section)%name)//' announces '// &
                             count_of(integer_value(table, 2, 1), 'entry')//' but has '// &
                             to_text(entries(card)), &
                             mend='correct the number, or leave it out')
         end associate
      end do
   end subroutine read_keywords

   !> Whether the first column of a keyword card is the keyword's, not a blank, a byte that is not
   !> ASCII, or a mark of another program
   pure logical function starts_with_letter(source, card)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card

      character(len=:), allocatable :: content

      content = card_content(source, card)
      starts_with_letter = .false.
      if (len(content) > 0) &
         starts_with_letter = upper(content(1:1)) >= 'A' .and. upper(content(1:1)) <= 'Z'
   end function starts_with_letter

   !> Check that a section which must be there has one entry
   subroutine check_there(source, section, sections, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      integer, intent(in) :: section
      !> Entries of all sections
      type(sections_type), intent(in) :: sections
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: name, first_field
      integer :: card

      name = trim(source%sections(section)%name)
      associate (field => source%sections(section)%fields(1), table => sections%tables(section))
         first_field = trim(field%name)//' in columns '//to_text(field%first)//' to '// &
            to_text(field%last)
         if (table%n > 1) then
            call entry_error(diagnostics, table, 2, name//' has one data card only', &
                             mend='a fixed card may have comments, but no second line')
         else if (table%n == 0 .and. source%complete) then
            card = findloc(source%cards(:source%n_cards)%keyword, section, 1)
            if (card > 0) then
               call add_error(diagnostics, card, 0, 0, 'the data card of '//name//' is missing', &
                              mend='below '//name//', give '//first_field)
            else
               call add_error(diagnostics, 0, 0, 0, 'the deck has no '//name//' card', &
                              mend='add '//name//' and, below it, '//first_field)
            end if
         end if
      end associate
   end subroutine check_there

   !> Entries of a section; none if the source cannot have it
   function table_of(sections, name) result(table)
      !> The sections
      type(sections_type), intent(in), target :: sections
      !> The keyword
      character(len=*), intent(in) :: name
      !> The entries
      type(table_type), pointer :: table

      integer :: k

      table => sections%none
      do k = 1, size(sections%names)
         if (sections%names(k) == name) table => sections%tables(k)
      end do
   end function table_of

end module axijoint_deck_text_sections
