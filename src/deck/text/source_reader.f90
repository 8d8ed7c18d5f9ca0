!> From files to cards: INCLUDE and GMSH cards are followed, END cards are sought
module axijoint_deck_text_source_reader
   use axijoint_base_text, only : upper
   use axijoint_deck_text_card_kind, only : classify, seek_hidden_heading, report_heading
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_file_bytes, only : read_bytes, line_end, next_line, control_byte
   use axijoint_deck_text_include_path, only : locate_path, path_fault, nesting_fault, folder
   use axijoint_deck_text_section, only : section_type, section_named, form_title, form_include, &
      form_file, form_end, keyword_last, keyword_length
   use axijoint_deck_text_source, only : source_type, add_file, add_card, card_content, card_text, &
      card_title, card_data, form_of, tab
   implicit none
   private
   public :: read_source

contains

   !> Read a deck and all that it includes
   subroutine read_source(path, sections, source, diagnostics, bytes, mesh)
      !> The deck
      character(len=*), intent(in) :: path
      !> Sections that it may have, which live as long as the source
      type(section_type), intent(in), target :: sections(:)
      !> Its cards
      type(source_type), intent(inout) :: source
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> What the deck says, if it is not to be read from its file
      character(len=*), intent(in), optional :: bytes
      !> File of the mesh, in place of that of the GMSH card
      character(len=*), intent(in), optional :: mesh

      character(len=:), allocatable :: text

      source%sections => sections
      if (present(mesh)) source%other_mesh = mesh
      if (.not. present(bytes)) then
         call splice_file(source, path, 0, 0, 0, 0, 0, diagnostics)
         return
      end if
      text = bytes
      call add_file(source, path, text, 0)
      call splice_bytes(source, 1, 0, diagnostics)
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
      file = source%n_files  ! further files follow
      call splice_bytes(source, file, depth, diagnostics)
   end subroutine splice_file

   !> Add the cards of a file that was read
   recursive subroutine splice_bytes(source, file, depth, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The file, and how deep it is
      integer, intent(in) :: file, depth
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      if (control_byte(source%files(file)%bytes) > 0) then
         call report_binary(source, file, diagnostics)
      else
         call splice_lines(source, file, depth, diagnostics)
      end if
   end subroutine splice_bytes

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

      integer :: first, last, line, card, last_card, hidden
      logical :: title_next, ended, complained

      title_next = .false.
      ended = .false.
      complained = .false.
      last_card = source%n_cards + 1
      first = 1
      line = 0
      hidden = 0
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
            call seek_hidden_heading(source, card, hidden)
         else if (ended) then
            if (.not. complained) call report_card_after_end(source, card, diagnostics)
            complained = .true.
         else
            call classify(source, card, diagnostics)
            if (hidden > 0 .and. source%cards(card)%kind == card_data) &
               call report_heading(source, hidden, diagnostics)
            hidden = 0
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

   !> Keep the file that a GMSH card names, or the mesh of the geometry that it names; it has no
   !> cards
   subroutine attach_mesh(source, card, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The card
      integer, intent(in) :: card
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: path, fault, bytes
      integer :: first, last, dot

      source%mesh_card = card
      call find_path(source, card, path, first, last, fault)
      if (len(fault) > 0) then
         call report_path(source, card, first, last, fault, diagnostics)
         return
      end if
      dot = index(path, '.', back=.true.)
      if (dot > 0) then
         if (path(dot:) == '.geo') then
            source%geometry = path
            path = path(:dot)//'msh'
         end if
      end if
      if (allocated(source%other_mesh)) path = source%other_mesh
      call read_bytes(path, bytes, fault)
      if (len(fault) > 0) then
         source%complete = .false.
         fault = 'the mesh file '//path//': '//fault
         if (allocated(source%geometry)) then
            call add_error(diagnostics, card, first, last, fault, mend='make it by gmsh -2 '// &
                           "'"//source%geometry//"'")
         else
            call add_error(diagnostics, card, first, last, fault)
         end if
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
