!> What a card is: a keyword card, a data card, or what another program would read as one
module axijoint_deck_text_card_kind
   use axijoint_base_text, only : upper, nearest_word
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, count_again
   use axijoint_deck_text_foreign, only : comment_mark, heading_mark, heading_word
   use axijoint_deck_text_section, only : section_type, section_named, names_of, first_words, &
      keyword_length, form_include, form_file
   use axijoint_deck_text_source, only : source_type, card_content, card_text, card_data, &
      card_keyword, card_ignored, form_of, tab
   use axijoint_deck_text_strange_byte, only : report_strange_byte
   implicit none
   private
   public :: classify, seek_hidden_heading, report_heading

contains

   !> Note a comment card that may be meant as a heading: $ and a keyword. It is meant so if
   !> data follow, with no data among the comments between
   pure subroutine seek_hidden_heading(source, card, hidden)
      !> The deck
      type(source_type), intent(in) :: source
      !> A card without contents
      integer, intent(in) :: card
      !> The last such card; 0 if there is none that data may follow
      integer, intent(inout) :: hidden

      character(len=:), allocatable :: text
      integer :: first

      text = card_text(source, card)
      if (verify(text, ' '//tab) == 0) return
      if (text(1:1) == '$' .and. heading_mark(source%sections, text) == '$') then
         hidden = card
      else
         first = verify(text, '!$ '//tab)
         if (first > 0) then
            if (scan(text(first:first), '+-.0123456789') == 1) hidden = 0
         end if
      end if
   end subroutine seek_hidden_heading

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
      if (len(heading_mark(source%sections, content)) > 0) then
         call report_heading(source, card, diagnostics)
         return
      else if (len(comment_mark(content)) > 0) then
         call report_comment(source, card, comment_mark(content), diagnostics)
         return
      end if
      first = max(1, first_letter(content))
      word = content(first:min(len(content), first + keyword_length - 1))
      word = word(:scan(word//' ', ' ,'//tab) - 1)
      keyword = section_named(source%sections, upper(word))
      source%cards(card)%kind = card_data
      if (keyword == 0 .and. .not. is_letter(content(1:1))) return
      if (is_worded_card(source%sections, content, word)) return
      if (lacks_blank(source, card, content, word)) then
         call add_error(diagnostics, card, 1, len(word), &
                        trim(merge('this keyword is unknown        ', 'text stands behind this keyword', keyword == 0)), &
                        found=word, mend='put a blank before '//word//', which begins an entry of '// &
                        trim(source%sections(open_section(source, card))%name))
         return
      end if
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
   !> word: one of the words that such entries begin with (JOINT), or nearly, and two values more. A
   !> misspelt keyword (JOINS) is followed by its number of entries only
   pure logical function is_worded_card(sections, content, word)
      !> Sections that the deck may have
      type(section_type), intent(in) :: sections(:)
      !> The card without its comment, and its first word
      character(len=*), intent(in) :: content, word

      integer :: first

      is_worded_card = any(first_words(sections) == upper(word))
      if (section_named(sections, upper(word)) == 0) &
         is_worded_card = nearest_word(word, first_words(sections)) > 0
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

   !> Report a comment of another program
   subroutine report_comment(source, card, mark, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The card
      integer, intent(in) :: card
      !> What makes it a comment
      character(len=*), intent(in) :: mark
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=*), parameter :: fault = 'a comment begins with !, not with '
      integer :: first
      logical :: told

      source%cards(card)%kind = card_ignored
      first = verify(card_text(source, card), ' '//tab)
      call count_again(diagnostics, fault//mark, told)
      if (.not. told) call add_error(diagnostics, card, first, first + len(mark) - 1, &
                     fault//mark, found=mark, &
                     mend='write ! in its place')
   end subroutine report_comment

   !> Report a heading as another program has it and go on as if it had been written rightly
   subroutine report_heading(source, card, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The card
      integer, intent(in) :: card
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: text, fault, allowed, mend
      integer :: meant, last

      text = card_text(source, card)
      last = scan(text//' ', ' ,'//tab) - 1
      meant = nearest_word(heading_word(text), names_of(source%sections))
      source%cards(card)%kind = card_keyword
      source%cards(card)%keyword = meant
      if (meant == 0) then
         source%complete = .false.
         allowed = all_names(source%sections)
         mend = 'write one of these keywords from column 1'
      else
         allowed = ''
         mend = 'write '//trim(source%sections(meant)%name)//' from column 1'
      end if
      fault = 'a keyword is written without '//heading_mark(source%sections, text)
      if (text(1:1) == '$') then
         fault = '$ makes this card a comment, but data follow'
         mend = mend//'; if it is a comment, put a blank behind $'
      end if
      call add_error(diagnostics, card, 1, last, fault, found=text(:last), &
                     allowed=allowed, mend=mend)
   end subroutine report_heading

   !> Whether a card lacks no more than a blank before it: a word that entries of the open section begin with, and a second one
   pure logical function lacks_blank(source, card, content, word)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card
      !> It without its comment, and its first word
      character(len=*), intent(in) :: content, word

      integer :: open

      open = open_section(source, card)
      lacks_blank = is_letter(content(1:1)) .and. any(first_words(source%sections(max(1, open):open)) == upper(word))
      if (lacks_blank) lacks_blank = verify(content(len(word) + 1:), ' ,0123456789'//tab) > 0
   end function lacks_blank

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

      character(len=:), allocatable :: mend
      integer :: meant

      meant = nearest_word(word, names_of(source%sections))
      source%cards(card)%keyword = meant
      mend = 'write one of these keywords from column 1'
      if (meant > 0) mend = 'did you mean '//trim(source%sections(meant)%name)//'?'
      if (meant == 0) source%complete = .false.
      call add_error(diagnostics, card, 1, len(word), 'this keyword is unknown', &
                     found=word, allowed=all_names(source%sections), mend=mend)
   end subroutine report_keyword

   !> Section that a card would belong to if it were no keyword card; 0 if there is none
   pure integer function open_section(source, card) result(section)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card

      integer :: k

      section = 0
      do k = card - 1, 1, -1
         if (source%cards(k)%kind /= card_keyword) cycle
         if (any(form_of(source, k) == [form_include, form_file])) cycle
         section = source%cards(k)%keyword
         return
      end do
   end function open_section

   !> All keywords as a text
   pure function all_names(sections) result(text)
      !> Sections that the deck may have
      type(section_type), intent(in) :: sections(:)
      !> The text
      character(len=:), allocatable :: text

      integer :: i

      text = trim(sections(1)%name)
      do i = 2, size(sections)
         text = text//' '//trim(sections(i)%name)
      end do
   end function all_names

end module axijoint_deck_text_card_kind
