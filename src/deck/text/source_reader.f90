!> From files to cards: INCLUDE and GMSH cards are followed, END cards are sought
module axijoint_deck_text_source_reader
   use axijoint_base_text, only : upper, nearest_word
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_file_bytes, only : read_bytes, line_end, next_line, control_byte
   use axijoint_deck_text_include_path, only : locate_path, path_fault, nesting_fault, folder
   use axijoint_deck_text_section, only : section_type, section_named, names_of, first_words, &
      form_title, &
      form_include, form_file, form_end, keyword_last, keyword_length
   use axijoint_deck_text_source, only : source_type, add_file, add_card, card_content, card_text, &
      card_title, card_data, card_keyword, form_of, tab
   use axijoint_deck_text_strange_byte, only : report_strange_byte
   implicit none
   private
   public :: read_source

contains

   !> Read a deck and all that it includes
   subroutine read_source(path, sections, source, diagnostics)
      !> The deck
      character(len=*), intent(in) :: path
      !> Sections that it may have
      type(section_type), intent(in) :: sections(:)
      !> Its cards
      type(source_type), intent(inout) :: source
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      source%sections = sections
      call splice_file(source, path, 0, 0, 0, 0, 0, diagnostics)
   end subroutine read_source

   !> Read a file and add its cards
   recursive subroutine splice_file(source, path, parent, depth, card, first, last, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The file
      character(len=*), intent(in) :: path
      !> File that includes it, and how deep that is
      integer, intent(in) :: parent, depth
      !> INCLUDE card and columns of the path there; 0 for the deck
      integer, intent(in) :: card, first, last
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: bytes, failure
      integer :: file

      call read_bytes(path, bytes, failure)
      if (len(failure) > 0) then
         source%complete = .false.
         if (card > 0) failure = 'the included file '//path//': '//failure
         if (card == 0) call add_file(source, path, bytes, parent)
         call add_error(diagnostics, card, first, last, failure)
         return
      end if
      call add_file(source, path, bytes, parent)
      file = source%n_files
      if (control_byte(source%files(file)%bytes) > 0) then
         call report_binary(source, file, diagnostics)
      else
         call splice_lines(source, file, depth, diagnostics)
      end if
   end subroutine splice_file

   !> Report a file that is not text; the line at fault is its only card
   subroutine report_binary(source, file, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The file
      integer, intent(in) :: file
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=2) :: code
      integer :: first, last, line, place

      source%complete = .false.
      associate (bytes => source%files(file)%bytes)
         place = control_byte(bytes)
         write (code, '(z2.2)') iachar(bytes(place:place))
         first = 1
         line = 1
         last = line_end(bytes, first)
         do while (last < place)
            first = next_line(bytes, last)
            last = line_end(bytes, first)
            line = line + 1
         end do
      end associate
      ! A binary file may have no line ends: show the bytes before the fault only.
      first = max(first, place - 70)
      call add_card(source, file, line, first, place)
      call add_error(diagnostics, source%n_cards, place - first + 1, place - first + 1, &
                     'the file is not a text: it contains control characters', &
                     found='the byte '//code//' (hexadecimal)', &
                     mend='save the deck as plain text (ASCII or UTF-8)')
   end subroutine report_binary

   !> Add the cards of a file
   recursive subroutine splice_lines(source, file, depth, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The file, and how deep it is
      integer, intent(in) :: file, depth
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: first, last, line, card, last_card
      logical :: title_next, ended, complained

      title_next = .false.
      ended = .false.
      complained = .false.
      last_card = source%n_cards + 1
      first = 1
      line = 0
      do while (first <= len(source%files(file)%bytes))
         line = line + 1
         last = line_end(source%files(file)%bytes, first)
         call add_card(source, file, line, first, last)
         first = next_line(source%files(file)%bytes, last)
         card = source%n_cards
         if (title_next .and. looks_like_keyword(source%sections, card_text(source, card))) then
            title_next = .false.
            call report_keyword_as_title(source, card, diagnostics)
         end if
         if (title_next) then
            source%cards(card)%kind = card_title
            title_next = .false.
            last_card = card
         else if (len(card_content(source, card)) == 0) then
            cycle
         else if (ended) then
            if (.not. complained) call report_card_after_end(source, card, diagnostics)
            complained = .true.
         else
            call classify(source, card, diagnostics)
            last_card = card
            title_next = form_of(source, card) == form_title
            ended = form_of(source, card) == form_end
            if (form_of(source, card) == form_include) then
               call include_file(source, card, depth, diagnostics)
            else if (form_of(source, card) == form_file .and. source%mesh_card == 0) then
               call attach_mesh(source, card, diagnostics)
            end if
         end if
      end do
      if (ended) return
      source%complete = .false.
      call report_no_end(source, last_card, diagnostics)
   end subroutine splice_lines

   !> Whether a card has a keyword from column 1, and at most a number of entries behind it
   pure logical function looks_like_keyword(sections, text)
      !> Sections that the deck may have
      type(section_type), intent(in) :: sections(:)
      !> The card
      character(len=*), intent(in) :: text

      character(len=keyword_length) :: word
      integer :: behind

      word = text
      behind = scan(text, ' !'//tab)
      if (behind > 0 .and. behind <= keyword_length) word(behind:) = ''
      looks_like_keyword = section_named(sections, upper(word)) > 0
      if (behind == 0) behind = len(text) + 1
      looks_like_keyword = looks_like_keyword .and. &
                           verify(text(min(behind, keyword_last + 1):), ' 0123456789'//tab) == 0
   end function looks_like_keyword

   !> Report a keyword where the title should be; the card is read as the keyword
   subroutine report_keyword_as_title(source, card, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card after TITLE
      integer, intent(in) :: card
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      call add_error(diagnostics, card, 1, len_trim(card_text(source, card)), &
                     'the card after TITLE is the title, but it looks like a keyword', &
                     found=card_text(source, card), &
                     mend='write the title, or a blank card, between TITLE and this card')
   end subroutine report_keyword_as_title

   !> A card with contents: its kind and, on a keyword card, its section
   subroutine classify(source, card, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The card
      integer, intent(in) :: card
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: content, word
      integer :: first, keyword

      content = card_content(source, card)
      first = max(1, first_letter(content))
      word = content(first:min(len(content), first + keyword_length - 1))
      word = word(:scan(word//' ', ' ,'//tab) - 1)
      keyword = section_named(source%sections, upper(word))
      source%cards(card)%kind = card_data
      if (keyword == 0 .and. .not. is_letter(content(1:1))) return
      if (is_worded_card(source%sections, content, word)) return
      source%cards(card)%kind = card_keyword
      source%cards(card)%keyword = keyword
      if (keyword == 0) then
         call report_keyword(source, card, word, diagnostics)
      else if (verify(content(:first - 1), ' '//tab) > 0) then
         call report_strange_byte(diagnostics, card, content, .true.)
      else if (first > 1) then
         call add_error(diagnostics, card, first, first + len(word) - 1, &
                        'the keyword does not begin in column 1', found=word)
      end if
   end subroutine classify

   !> Whether a card with a letter in column 1 is no keyword card but an entry that begins with a
   !> word: one of the words that such entries begin with (JOINT), and two values more. A misspelt
   !> keyword (JOINTS) is followed by its number of entries only
   pure logical function is_worded_card(sections, content, word)
      !> Sections that the deck may have
      type(section_type), intent(in) :: sections(:)
      !> The card without its comment, and its first word
      character(len=*), intent(in) :: content, word

      integer :: first

      is_worded_card = any(first_words(sections) == upper(word))
      if (.not. is_worded_card) return
      first = len(word) + verify(content(len(word) + 1:)//'.', ' ,'//tab)
      first = first - 1 + scan(content(min(first, len(content)):)//' ', ' ,'//tab)
      is_worded_card = verify(content(min(first, len(content) + 1):), ' ,'//tab) > 0
   end function is_worded_card

   !> Place of the first byte that is ASCII and no blank: a byte order mark or a blank that
   !> is not ASCII does not hide a keyword. 0 if there is none
   pure integer function first_letter(content) result(first)
      !> The card without its comment
      character(len=*), intent(in) :: content

      do first = 1, len(content)
         if (content(first:first) /= ' ' .and. content(first:first) /= tab &
             .and. iachar(content(first:first)) < 128) return
      end do
      first = 0
   end function first_letter

   !> Whether a character is an ASCII letter
   pure logical function is_letter(character)
      !> The character
      character(len=1), intent(in) :: character
      is_letter = upper(character) >= 'A' .and. upper(character) <= 'Z'
   end function is_letter

   !> Report an unknown keyword and go on as if the likeliest had been written
   subroutine report_keyword(source, card, word, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The card
      integer, intent(in) :: card
      !> The unknown word
      character(len=*), intent(in) :: word
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: meant, i
      character(len=:), allocatable :: names, mend

      meant = nearest_word(word, names_of(source%sections))
      names = trim(source%sections(1)%name)
      do i = 2, size(source%sections)
         names = names//' '//trim(source%sections(i)%name)
      end do
      source%cards(card)%keyword = meant
      mend = 'write one of these keywords from column 1'
      if (meant > 0) mend = 'did you mean '//trim(source%sections(meant)%name)//'?'
      if (meant == 0) source%complete = .false.
      call add_error(diagnostics, card, 1, len(word), 'this keyword is unknown', &
                     found=word, allowed=names, mend=mend)
   end subroutine report_keyword

   !> Report the first card after END
   subroutine report_card_after_end(source, card, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      call add_error(diagnostics, card, 1, len(card_content(source, card)), &
                     'there is a card after END', allowed='blank cards and comments', &
                     mend='move END behind this card, or make it a comment by a ! in column 1')
   end subroutine report_card_after_end

   !> Report a file without END
   subroutine report_no_end(source, card, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Last card of the file
      integer, intent(in) :: card
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: text

      text = 'the file ends without END'
      if (source%cards(card)%kind == card_title) text = text//' (the last card is the title)'
      call add_error(diagnostics, card, 0, 0, text, &
                     mend='if the file was cut off, restore it; otherwise add a card END')
   end subroutine report_no_end

   !> Follow an INCLUDE card
   recursive subroutine include_file(source, card, depth, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The card
      integer, intent(in) :: card
      !> Depth of its file
      integer, intent(in) :: depth
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: path, fault
      integer :: first, last

      call find_path(source, card, path, first, last, fault)
      if (len(fault) == 0) fault = nesting_fault(source, source%cards(card)%file, path, depth)
      if (len(fault) == 0) then
         call splice_file(source, path, source%cards(card)%file, depth + 1, card, first, last, &
                          diagnostics)
      else
         call report_path(source, card, first, last, fault, diagnostics)
      end if
   end subroutine include_file

   !> Keep the file that a GMSH card names; it has no cards
   subroutine attach_mesh(source, card, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The card
      integer, intent(in) :: card
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: path, fault, bytes
      integer :: first, last

      source%mesh_card = card
      call find_path(source, card, path, first, last, fault)
      if (len(fault) > 0) then
         call report_path(source, card, first, last, fault, diagnostics)
         return
      end if
      call read_bytes(path, bytes, fault)
      if (len(fault) > 0) then
         source%complete = .false.
         call add_error(diagnostics, card, first, last, 'the mesh file '//path//': '//fault)
         return
      end if
      call add_file(source, path, bytes, source%cards(card)%file)
      source%mesh_file = source%n_files
   end subroutine attach_mesh

   !> The path on an INCLUDE or a GMSH card, from the folder of its file
   subroutine find_path(source, card, path, first, last, fault)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card
      !> The path
      character(len=:), allocatable, intent(out) :: path
      !> Its columns
      integer, intent(out) :: first, last
      !> What is wrong with it; empty if nothing is
      character(len=:), allocatable, intent(out) :: fault

      character(len=:), allocatable :: content

      content = card_content(source, card)
      call locate_path(content, first, last, fault)
      path = content(first:last)
      if (len(fault) == 0) &
         fault = path_fault(trim(source%sections(source%cards(card)%keyword)%name), path)
      if (len(fault) > 0) return
      if (index(path, './') == 1) path = path(3:)
      path = folder(source%files(source%cards(card)%file)%path)//path
   end subroutine find_path

   !> Report a path that cannot be followed
   subroutine report_path(source, card, first, last, fault, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The card, and columns of the path
      integer, intent(in) :: card, first, last
      !> What is wrong
      character(len=*), intent(in) :: fault
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: content

      content = card_content(source, card)
      source%complete = .false.
      call add_error(diagnostics, card, first, max(first, last), fault, found=content(first:last), &
                     allowed='a path from column 11, below the folder of the including file')
   end subroutine report_path

end module axijoint_deck_text_source_reader
