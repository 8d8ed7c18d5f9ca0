!> The physical lines of a deck and of the files that it includes
module axijoint_deck_text_source
   use axijoint_base_text, only : utf8_length
   use axijoint_deck_text_section, only : section_type
   implicit none
   private
   public :: source_type, add_file, add_card
   public :: card_text, card_content, card_file, card_line, card_position, form_of, printable, keep_utf8, tab
   public :: card_title, card_data, card_keyword, card_ignored

   !> Blank card, comment card, or a card that was already found at fault
   integer, parameter :: card_ignored = 0
   !> The card after TITLE
   integer, parameter :: card_title = 1
   !> Data card of the open section
   integer, parameter :: card_data = 2
   !> Card with a letter in column 1
   integer, parameter :: card_keyword = 3

   !> The tabulator
   character(len=1), parameter :: tab = achar(9)

   !> A file; one that is included twice is there twice
   type :: source_file_type
      !> Path as the program opens it
      character(len=:), allocatable :: path
      !> All its bytes
      character(len=:), allocatable :: bytes
      !> File that includes it; 0 for the deck
      integer :: parent = 0
   end type source_file_type

   !> One physical line
   type :: card_type
      !> Index of its file, and its line there
      integer :: file = 0, line = 0
      !> Its first and last byte in the file, without the line's end
      integer :: first = 1, last = 0
      !> One of the `card_` parameters
      integer :: kind = card_ignored
      !> Section that a keyword card opens, among those of the source; 0 if unknown
      integer :: keyword = 0
   end type card_type

   !> A deck with its included files spliced in; every physical line is kept
   type :: source_type
      !> Sections that it may have: those of the list itself, for they are large
      type(section_type), pointer :: sections(:) => null()
      !> Number of cards in `cards`
      integer :: n_cards = 0
      !> The cards in the order in which they are read, at least n_cards
      type(card_type), allocatable :: cards(:)
      !> Number of files in `files`
      integer :: n_files = 0
      !> The files, the deck first, at least n_files
      type(source_file_type), allocatable :: files(:)
      !> False if cards are lacking: a file without END, an include that
      !> could not be read, an unknown section
      logical :: complete = .true.
      !> Card of the Gmsh mesh, and index of its file; 0 without one
      integer :: mesh_card = 0, mesh_file = 0
      !> The geometry that it is made of by Gmsh, if the card names that; the mesh that is read in
      !> place of it
      character(len=:), allocatable :: geometry, other_mesh
   end type source_type

contains

   !> Add a file
   subroutine add_file(source, path, bytes, parent)
      !> The deck
      type(source_type), intent(inout) :: source
      !> Path
      character(len=*), intent(in) :: path
      !> Its bytes; unallocated on return
      character(len=:), allocatable, intent(inout) :: bytes
      !> File that includes it; 0 for the deck
      integer, intent(in) :: parent

      type(source_file_type), allocatable :: larger(:)
      integer :: i

      if (.not. allocated(source%files)) allocate (source%files(4))
      if (source%n_files == size(source%files)) then
         allocate (larger(2*source%n_files))
         do i = 1, source%n_files
            call move_alloc(source%files(i)%path, larger(i)%path)
            call move_alloc(source%files(i)%bytes, larger(i)%bytes)
            larger(i)%parent = source%files(i)%parent
         end do
         call move_alloc(larger, source%files)
      end if
      source%n_files = source%n_files + 1
      associate (file => source%files(source%n_files))
         file%path = path
         call move_alloc(bytes, file%bytes)
         file%parent = parent
      end associate
   end subroutine add_file

   !> Add a line of a file as the next card
   subroutine add_card(source, file, line, first, last)
      !> The deck
      type(source_type), intent(inout) :: source
      !> File and line number
      integer, intent(in) :: file, line
      !> First and last byte in the file
      integer, intent(in) :: first, last

      type(card_type), allocatable :: larger(:)

      if (.not. allocated(source%cards)) allocate (source%cards(128))
      if (source%n_cards == size(source%cards)) then
         allocate (larger(2*source%n_cards))
         larger(:source%n_cards) = source%cards
         call move_alloc(larger, source%cards)
      end if
      source%n_cards = source%n_cards + 1
      source%cards(source%n_cards) = card_type(file, line, first, last)
   end subroutine add_card

   !> A card as it stands in its file
   pure function card_text(source, card) result(text)
      !> The deck
      type(source_type), intent(in) :: source
      !> Index of the card
      integer, intent(in) :: card
      !> Its bytes
      character(len=:), allocatable :: text

      associate (c => source%cards(card))
         text = source%files(c%file)%bytes(c%first:c%last)
      end associate
   end function card_text

   !> A card without its comment and the blanks at its end
   pure function card_content(source, card) result(text)
      !> The deck
      type(source_type), intent(in) :: source
      !> Index of the card; not the title
      integer, intent(in) :: card
      !> Its bytes up to the last that means anything
      character(len=:), allocatable :: text

      integer :: comment

      text = card_text(source, card)
      if (len(text) > 0) then
         if (text(1:1) == '$') text = ''
      end if
      comment = index(text, '!')
      if (comment > 0) text = text(:comment - 1)
      text = text(:verify(text, ' '//tab, back=.true.))
   end function card_content

   !> Form of the section that a card opens; 0 if it opens none that is known
   pure integer function form_of(source, card) result(form)
      !> The deck
      type(source_type), intent(in) :: source
      !> Index of the card
      integer, intent(in) :: card

      form = 0
      associate (section => source%cards(card)%keyword)
         if (section > 0) form = source%sections(section)%form
      end associate
   end function form_of

   !> Path of the file that a card stands in
   pure function card_file(source, card) result(path)
      !> The deck
      type(source_type), intent(in) :: source
      !> Index of the card
      integer, intent(in) :: card
      !> Path
      character(len=:), allocatable :: path

      path = source%files(source%cards(card)%file)%path
   end function card_file

   !> Line number of a card in its file
   pure integer function card_line(source, card) result(line)
      !> The deck
      type(source_type), intent(in) :: source
      !> Index of the card
      integer, intent(in) :: card

      line = source%cards(card)%line
   end function card_line

   !> Where a card stands, to be named in the message about another: "line 7",
   !> with the file if it is not the same
   pure function card_position(source, card, seen_from) result(text)
      !> The deck
      type(source_type), intent(in) :: source
      !> Index of the card
      integer, intent(in) :: card
      !> Index of the card that the message is about
      integer, intent(in) :: seen_from
      !> Position
      character(len=:), allocatable :: text

      character(len=12) :: line

      write (line, '(i0)') card_line(source, card)
      text = 'line '//trim(line)
      if (source%cards(card)%file /= source%cards(seen_from)%file) then
         text = text//' of '//card_file(source, card)
      end if
   end function card_position

   !> Text with one printing ASCII character for each byte
   pure function printable(text)
      !> Any bytes
      character(len=*), intent(in) :: text
      !> Tabs as blanks, other bytes that do not print as question marks
      character(len=len(text)) :: printable

      integer :: i, code

      do i = 1, len(text)
         code = iachar(text(i:i))
         printable(i:i) = merge(text(i:i), '?', code >= 32 .and. code < 127)
         if (text(i:i) == tab) printable(i:i) = ' '
      end do
   end function printable

   !> Replace bytes that do not form UTF-8 by question marks
   pure subroutine keep_utf8(text, valid)
      !> The text
      character(len=*), intent(inout) :: text
      !> Whether it was UTF-8
      logical, intent(out) :: valid

      integer :: i, n

      valid = .true.
      i = 1
      do while (i <= len(text))
         n = utf8_length(text(i:))
         if (n == 0) then
            valid = .false.
            text(i:i) = '?'
         end if
         i = i + max(n, 1)
      end do
   end subroutine keep_utf8

end module axijoint_deck_text_source
