!> What a section of a deck is: its keyword, its cards and their fields. The sections
!> themselves stand in `deck/section`, a file each; this folder reads any list of them
module axijoint_deck_text_section
   use axijoint_deck_text_field, only : field_type, integer_field, text_field, largest_number, &
      kind_word
   implicit none
   private
   public :: section_type, cards_per_entry, keyword_fields, first_words, section_named, names_of, &
      ordinal, &
      cardinal
   public :: form_entries, form_title, form_end, form_include, form_file
   public :: needs_nothing, needs_density, needs_expansion

   !> Last column of a card, and the last one of a keyword before the number of entries.
   !> A longer keyword leaves less room for that number
   integer, parameter, public :: card_width = 80, keyword_last = 10
   !> Last column of a card with commas: reals of all their digits have room there
   integer, parameter, public :: free_width = 400
   !> Letters of the longest keyword
   integer, parameter, public :: keyword_length = 12
   !> Most cards of an entry
   integer, parameter, public :: most_cards = 9

   !> What follows a keyword: entries of one card or more
   integer, parameter :: form_entries = 1
   !> One card of any text
   integer, parameter :: form_title = 2
   !> Nothing: the file ends
   integer, parameter :: form_end = 3
   !> On the keyword's card, the path of a file with further cards
   integer, parameter :: form_include = 4
   !> On the keyword's card, the path of a file of another kind, which is kept
   integer, parameter :: form_file = 5

   !> Property of the materials without which the loads of a section have no effect
   character(len=*), parameter :: needs_nothing = '', needs_density = 'density', &
      needs_expansion = 'thermal expansion'

   !> A section
   type :: section_type
      !> The keyword
      character(len=keyword_length) :: name = ''
      !> What it is for, in a line
      character(len=100) :: purpose = ''
      !> Fields of an entry, by cards and columns; none if it has no entries
      type(field_type), allocatable :: fields(:)
      !> What an entry is, and what each of its cards holds, if it has more than one; for messages
      character(len=16) :: entry = 'entry'
      character(len=40) :: cards(most_cards) = ''
      !> One of the `form_` parameters
      integer :: form = form_entries
      !> Whether the section is there once at most, with one entry; whether it must be there
      logical :: once = .false., required = .false.
      !> Whether the first field is the entry's own number, by which others may call it
      logical :: numbered = .false.
      !> Whether the keyword without entries means something, too
      logical :: alone = .false.
      !> Whether its entries are loads, which belong to a load case
      logical :: is_load = .false.
      !> One of the `needs_` parameters
      character(len=len(needs_expansion)) :: needs = needs_nothing
      !> Whether it holds the faces that it names, so that they have reactions
      logical :: is_support = .false.
   end type section_type

contains

   !> Number of cards that make an entry of a section
   pure integer function cards_per_entry(section)
      !> The section
      type(section_type), intent(in) :: section

      cards_per_entry = max(1, maxval(section%fields%card))
   end function cards_per_entry

   !> Fields of a keyword card: the keyword and the number of entries
   pure function keyword_fields(section) result(fields)
      !> The section
      type(section_type), intent(in) :: section
      !> The fields; a section without entries has none to count
      type(field_type), allocatable :: fields(:)

      fields = [text_field('the keyword', 1, keyword_last), &
                integer_field('the number of entries', keyword_last + 1, keyword_last + 5, &
                              0, largest_number, default=0)]
      if (section%form /= form_entries) fields = fields(:1)
   end function keyword_fields

   !> Words that the first field of a card may hold: such a card is no keyword card though it
   !> begins with a letter
   pure function first_words(sections) result(words)
      !> The sections
      type(section_type), intent(in) :: sections(:)
      !> The words
      character(len=keyword_length), allocatable :: words(:)

      integer :: k

      allocate (words(0))
      do k = 1, size(sections)
         if (size(sections(k)%fields) == 0) cycle
         associate (field => sections(k)%fields(1))
            if (field%kind /= kind_word) cycle
            words = [character(len=keyword_length) :: words, pack(field%words, field%words /= '')]
         end associate
      end do
   end function first_words

   !> Keywords of sections
   pure function names_of(sections) result(names)
      !> The sections
      type(section_type), intent(in) :: sections(:)
      !> The keywords
      character(len=keyword_length) :: names(size(sections))

      integer :: k

      do k = 1, size(sections)
         names(k) = sections(k)%name
      end do
   end function names_of

   !> Place of a section among others; 0 if it is not there
   pure integer function section_named(sections, name)
      !> The sections
      type(section_type), intent(in) :: sections(:)
      !> The keyword
      character(len=*), intent(in) :: name

      do section_named = size(sections), 1, -1
         if (sections(section_named)%name == name) return
      end do
   end function section_named

   !> "second", "third": the place of a card in an entry
   pure function ordinal(n) result(word)
      !> The place, up to `most_cards`
      integer, intent(in) :: n
      !> The word
      character(len=:), allocatable :: word

      character(len=7), parameter :: words(most_cards) = [character(len=7) :: 'first', 'second', &
         'third', &
         'fourth', 'fifth', 'sixth', 'seventh', 'eighth', 'ninth']

      word = trim(words(n))
   end function ordinal

   !> "two", "three": a number of cards
   pure function cardinal(n) result(word)
      !> The number, up to `most_cards`
      integer, intent(in) :: n
      !> The word
      character(len=:), allocatable :: word

      character(len=5), parameter :: words(most_cards) = [character(len=5) :: 'one', 'two', &
         'three', 'four', &
         'five', 'six', 'seven', 'eight', 'nine']

      word = trim(words(n))
   end function cardinal

end module axijoint_deck_text_section
