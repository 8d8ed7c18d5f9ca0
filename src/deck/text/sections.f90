!> The cards of a deck sorted into sections and read into tables
module axijoint_deck_text_sections
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_deck_text_layout, only : n_sections, section_names, section_fields, keyword_fields, &
      cards_per_entry, section_title, section_control, section_include, section_end, section_orthotropic, &
      section_gmsh, section_sweep, card_width
   use axijoint_deck_text_source, only : source_type, card_text, card_content, card_position, card_title, &
      card_data, card_keyword, tab
   use axijoint_deck_text_table, only : table_type, new_table, read_entry, entry_error, field_error, &
      integer_value
   implicit none
   private
   public :: sections_type, read_sections

   !> What the cards of a deck say, before anything is made of it
   type :: sections_type
      !> Entries of each section
      type(table_type) :: tables(n_sections)
      !> Title
      character(len=:), allocatable :: title
      !> Keyword cards that no entries follow and that do not announce none
      integer, allocatable :: empty(:)
      !> False if cards are lacking or belong nowhere, so that references
      !> between cards cannot be judged
      logical :: complete = .true.
   end type sections_type

contains

   !> Sort and read all cards
   subroutine read_sections(source, sections, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Its sections
      type(sections_type), intent(inout) :: sections
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: owner(:), entries(:)
      integer :: section, card, n_cards(0:n_sections)

      sections%complete = source%complete
      call find_owners(source, owner, sections%complete, diagnostics)
      call check_repeated(source, diagnostics)
      call read_title(source, sections%title, diagnostics)
      n_cards = 0
      do card = 1, source%n_cards
         if (owner(card) == 0) cycle
         section = source%cards(owner(card))%keyword
         n_cards(section) = n_cards(section) + 1
      end do
      do section = 1, n_sections
         sections%tables(section) = new_table(section_fields(section), &
                                              n_cards(section)/cards_per_entry(section))
      end do
      allocate (entries(source%n_cards), source=0)
      call read_entries(source, owner, sections, entries, diagnostics)
      call read_keywords(source, entries, sections, diagnostics)
      call check_control(source, sections%tables(section_control), diagnostics)
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
         if (open_section(file) == unset) open_section(file) = open_section(source%files(file)%parent)
         if (source%cards(card)%kind == card_keyword) then
            if (all(source%cards(card)%keyword /= [section_include, section_gmsh])) open_section(file) = card
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
      if (takes_data) takes_data = all(source%cards(card)%keyword /= [0, section_title, section_end])
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
                     mend='a keyword, written from column 1, opens a section; comments begin with !')
   end subroutine report_homeless

   !> Report a second TITLE, CONTROL or GMSH
   subroutine check_repeated(source, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: card, seen(n_sections)

      seen = 0
      do card = 1, source%n_cards
         if (source%cards(card)%kind /= card_keyword) cycle
         associate (section => source%cards(card)%keyword)
            if (all(section /= [section_title, section_control, section_gmsh, section_sweep])) cycle
            if (seen(section) > 0) then
               call add_error(diagnostics, card, 1, len_trim(section_names(section)), &
                              trim(section_names(section))//' is there twice, first on '// &
                              card_position(source, seen(section), card))
            else
               seen(section) = card
            end if
         end associate
      end do
   end subroutine check_repeated

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

   !> Replace tabs by blanks, and bytes that do not form UTF-8 by question marks
   pure subroutine keep_utf8(text, valid)
      !> The text
      character(len=*), intent(inout) :: text
      !> Whether it was UTF-8
      logical, intent(out) :: valid

      integer :: i, k, n

      valid = .true.
      i = 1
      do while (i <= len(text))
         if (text(i:i) == tab) text(i:i) = ' '
         select case (iachar(text(i:i)))
         case (:127)
            n = 1
         case (194:223)
            n = 2
         case (224:239)
            n = 3
         case (240:244)
            n = 4
         case default
            n = 0
         end select
         if (i + n - 1 > len(text)) n = 0
         do k = i + 1, i + n - 1
            if (iand(iachar(text(k:k)), 192) /= 128) n = 0
         end do
         if (n == 0) then
            valid = .false.
            text(i:i) = '?'
         end if
         i = i + max(n, 1)
      end do
   end subroutine keep_utf8

   !> Read all data cards, in the order of the deck
   subroutine read_entries(source, owner, sections, entries, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Keyword card of each data card
      integer, intent(in) :: owner(:)
      !> The sections
      type(sections_type), intent(inout) :: sections
      !> Number of entries that follow each keyword card, 0 before
      integer, intent(inout) :: entries(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: first_card(:)
      integer :: card

      allocate (first_card(size(owner)), source=0)
      do card = 1, source%n_cards
         if (owner(card) == 0) cycle
         associate (section => source%cards(owner(card))%keyword, first => first_card(owner(card)))
            if (cards_per_entry(section) == 1) then
               call read_entry(sections%tables(section), source, [card], diagnostics)
            else if (first == 0) then
               first = card
               cycle
            else
               call read_entry(sections%tables(section), source, [first, card], diagnostics)
               first = 0
            end if
            entries(owner(card)) = entries(owner(card)) + 1
         end associate
      end do
      do card = 1, source%n_cards
         if (first_card(card) == 0) cycle
         sections%complete = .false.
         if (.not. source%complete) cycle
         if (source%cards(card)%keyword == section_orthotropic) then
            call add_error(diagnostics, first_card(card), 0, 0, &
                           'the second card of the material is lacking', &
                           allowed='two cards: E, angle, density; then nu and G')
         else
            call add_error(diagnostics, first_card(card), 0, 0, &
                           'the second card of the block is lacking', &
                           allowed='two cards: numbers and divisions; then the corners')
         end if
      end do
   end subroutine read_entries

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
      integer :: card

      allocate (sections%empty(0))
      do card = 1, source%n_cards
         if (source%cards(card)%kind /= card_keyword) cycle
         associate (section => source%cards(card)%keyword)
            if (any(section == [0, section_include, section_gmsh])) cycle
            if (.not. starts_with_letter(source, card)) cycle  ! reported already
            table = new_table(keyword_fields(section), 1)
            call read_entry(table, source, [card], diagnostics)
            if (size(table%fields) == 1) cycle  ! TITLE, END
            if (.not. table%given(2, 1)) then
               if (entries(card) == 0 .and. section /= section_sweep) sections%empty = [sections%empty, card]
               cycle
            end if
            if (integer_value(table, 2, 1) == entries(card) .or. .not. sections%complete) cycle
            call field_error(diagnostics, source, table, 1, 2, &
                             trim(section_names(section))//' announces '// &
                             count_of(integer_value(table, 2, 1), 'entry')//' but has '// &
                             to_text(entries(card)), &
                             mend='correct the number, or leave it out')
         end associate
      end do
   end subroutine read_keywords

   !> Whether the first column of a keyword card is the keyword's, not a blank or a byte
   !> that is not ASCII
   pure logical function starts_with_letter(source, card)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card

      character(len=:), allocatable :: content

      content = card_content(source, card)
      starts_with_letter = scan(content, ' '//tab) /= 1 .and. iachar(content(1:1)) < 128
   end function starts_with_letter

   !> Check that there is one CONTROL card
   subroutine check_control(source, control, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: control
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: card

      if (control%n > 1) then
         call entry_error(diagnostics, control, 2, 'CONTROL has one data card only', &
                          mend='a fixed card may have comments, but no second line')
      else if (control%n == 0 .and. source%complete) then
         card = findloc(source%cards(:source%n_cards)%keyword, section_control, 1)
         if (card > 0) then
            call add_error(diagnostics, card, 0, 0, 'the data card of CONTROL is missing', &
                           mend='below CONTROL, give the highest harmonic M in columns 1 to 5')
            return
         end if
         call add_error(diagnostics, 0, 0, 0, 'the deck has no CONTROL card', &
                        mend='add CONTROL and, below it, the highest harmonic M in columns 1 to 5')
      end if
   end subroutine check_control

end module axijoint_deck_text_sections
