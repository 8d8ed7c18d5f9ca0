!> Data cards to entries. Cards that are lacking, and keywords, are told by what the cards behind
!> the gap look like, so that one card left out is one error
module axijoint_deck_text_entry_reader
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_field, only : field_type, kind_text, kind_word
   use axijoint_deck_text_section, only : section_type, cards_per_entry, ordinal, cardinal, &
      form_entries, most_cards
   use axijoint_deck_text_source, only : source_type, card_keyword
   use axijoint_deck_text_table, only : table_type, read_entry, card_faults
   implicit none
   private
   public :: read_entries

   !> The entry that is being read below a keyword card
   type :: begun_type
      !> Its cards so far, and their number
      integer :: cards(most_cards) = 0
      integer :: n = 0
      !> Whether the cards that follow belong to another section, whose keyword is lacking
      logical :: left = .false.
      !> How often it was asked whether a keyword is lacking
      integer :: asked = 0
   end type begun_type

   !> Below a keyword it is asked so often at most whether another is lacking: each time all cards
   !> that follow may be looked at
   integer, parameter :: most_asked = 8

contains

   !> Read all data cards, in the order of the deck
   subroutine read_entries(source, owner, tables, entries, complete, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Keyword card of each data card
      integer, intent(in) :: owner(:)
      !> Entries of each section
      type(table_type), intent(inout) :: tables(:)
      !> Number of entries that follow each keyword card, 0 before
      integer, intent(inout) :: entries(:)
      !> Made false if a card or a keyword is lacking
      logical, intent(inout) :: complete
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(begun_type), allocatable :: begun(:)
      logical :: out_of_place, good
      integer :: card, n_errors

      allocate (begun(size(owner)))
      do card = 1, source%n_cards
         if (owner(card) == 0) cycle
         associate (keyword => owner(card), entry => begun(owner(card)), &
                    section => source%sections(source%cards(owner(card))%keyword), &
                    table => tables(source%cards(owner(card))%keyword))
            if (entry%left) cycle
            good = .false.
            if (entry%n + 1 == cards_per_entry(section)) &
               call try_entry(table, source, [entry%cards(:entry%n), card], good)
            if (.not. good) then
               n_errors = diagnostics%n_errors
               call judge_place(source, owner, card, section, entries(keyword), entry, &
                                out_of_place, diagnostics)
               if (diagnostics%n_errors > n_errors) complete = .false.
               if (out_of_place) cycle
               entry%n = entry%n + 1
               entry%cards(entry%n) = card
               if (entry%n < cards_per_entry(section)) cycle
               call read_entry(table, source, entry%cards(:entry%n), diagnostics)
            end if
            entry%n = 0
            entries(keyword) = entries(keyword) + 1
         end associate
      end do
      do card = 1, source%n_cards
         if (begun(card)%n == 0) cycle
         complete = .false.
         if (source%complete) call report_lacking( &
            source%sections(source%cards(card)%keyword), begun(card)%cards(1), begun(card)%n + 1, &
            diagnostics)
      end do
   end subroutine read_entries

   !> Read an entry if nothing is wrong with it, nor doubtful
   subroutine try_entry(table, source, cards, good)
      !> The section
      type(table_type), intent(inout) :: table
      !> The deck
      type(source_type), intent(in) :: source
      !> The entry's cards
      integer, intent(in) :: cards(:)
      !> Whether it was read; if not, the section is as it was
      logical, intent(out) :: good

      type(diagnostics_type) :: faults

      call read_entry(table, source, cards, faults)
      good = faults%n_errors + faults%n_warnings == 0
      if (.not. good) table%n = table%n - 1
   end subroutine try_entry

   !> Whether a card stands where it belongs. If it looks like another card of the entry, a card is
   !> lacking; if all that follow look like those of a section that the deck has not, a keyword is
   subroutine judge_place(source, owner, card, section, n_entries, begun, out_of_place, diagnostics)
      !> The deck, and the keyword card of each data card
      type(source_type), intent(in) :: source
      integer, intent(in) :: owner(:)
      !> The card
      integer, intent(in) :: card
      !> Its section, and how many entries it has so far below this keyword
      type(section_type), intent(in) :: section
      integer, intent(in) :: n_entries
      !> The entry that was begun; given up if its next card is lacking
      type(begun_type), intent(inout) :: begun
      !> Whether the card is no part of the entry
      logical, intent(out) :: out_of_place
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: keywords

      out_of_place = .false.
      if (fits(source, card, section, begun%n + 1)) return
      if (begun%n > 0) then
         if (.not. fits(source, card, section, 1)) return
         call report_lacking(section, begun%cards(1), begun%n + 1, diagnostics)
         begun%n = 0
         return
      end if
      if (cards_per_entry(section) > 1) then
         out_of_place = fits(source, card, section, 2)
         if (out_of_place) out_of_place = .not. has_slips(source, owner, card, section)
         if (out_of_place) call report_lacking(section, card, 1, diagnostics)
         if (out_of_place) return
      end if
      if (n_entries == 0 .or. begun%asked == most_asked) return
      begun%asked = begun%asked + 1
      keywords = lacking_keywords(source, owner, card, section)
      begun%left = len(keywords) > 0
      out_of_place = begun%left
      if (begun%left) call add_error(diagnostics, card, 0, 0, 'a keyword is lacking above this '// &
         'card, which does not fit '//trim(section%name), mend='the cards would fit '//keywords)
   end subroutine judge_place

   !> Whether a card that could be the second of an entry is its first with few faults: if so, the card
   !> behind it is the second. The values of a free card often fit both
   logical function has_slips(source, owner, card, section)
      !> The deck, and the keyword card of each data card
      type(source_type), intent(in) :: source
      integer, intent(in) :: owner(:)
      !> The card
      integer, intent(in) :: card
      !> Its section
      type(section_type), intent(in) :: section

      !> Were it the second, two cards would be lacking: its own first, and that of the card behind it
      integer, parameter :: most_slips = 2
      integer :: next

      has_slips = .false.
      next = card + findloc(owner(card + 1:), owner(card), 1)
      if (next == card) return
      if (fits(source, next, section, 1)) return
      if (.not. fits(source, next, section, 2)) return
      has_slips = card_faults(source, card, section%fields, 1) <= most_slips
   end function has_slips

   !> Whether a card can be read as one of an entry without a fault
   logical function fits(source, card, section, k)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card
      !> The section
      type(section_type), intent(in) :: section
      !> Which of the entry's cards
      integer, intent(in) :: k

      fits = card_faults(source, card, section%fields, k) == 0
   end function fits

   !> Keywords that the deck has not, and of which the cards from one on could be entries, where
   !> none of them could be one of their own section; one slip in one card does not make this so
   function lacking_keywords(source, owner, card, own) result(keywords)
      !> The deck, and the keyword card of each data card
      type(source_type), intent(in) :: source
      integer, intent(in) :: owner(:)
      !> The first of the cards
      integer, intent(in) :: card
      !> Their section
      type(section_type), intent(in) :: own
      !> The first keywords that would do; empty if there is none, or if no keyword is lacking
      character(len=:), allocatable :: keywords

      integer, parameter :: fewest_faults = 2, most_told = 3
      integer, allocatable :: cards(:)
      integer :: i, k, n_told, faults

      keywords = ''
      cards = pack([(i, i=card, size(owner))], owner(card:) == owner(card))
      faults = 0
      do i = 1, size(cards)
         if (any([(fits(source, cards(i), own, k), k=1, cards_per_entry(own))])) return
         faults = faults + card_faults(source, cards(i), own%fields, 1)
      end do
      if (faults < fewest_faults) return
      n_told = 0
      do i = 1, size(source%sections)
         if (n_told == most_told) exit
         if (.not. could_hold(source, cards, i)) cycle
         n_told = n_told + 1
         if (n_told > 1) keywords = keywords//' or '
         keywords = keywords//trim(source%sections(i)%name)
      end do
   end function lacking_keywords

   !> Whether cards are entries of a section that the deck has not
   logical function could_hold(source, cards, section)
      !> The deck
      type(source_type), intent(in) :: source
      !> The cards
      integer, intent(in) :: cards(:)
      !> The section, among those that the deck may have
      integer, intent(in) :: section

      type(field_type), allocatable :: fields(:)
      integer :: i, n

      could_hold = .false.
      associate (other => source%sections(section), deck => source%cards(:source%n_cards))
         if (other%form /= form_entries) return
         if (any(deck%kind == card_keyword .and. deck%keyword == section)) return
         n = cards_per_entry(other)
         if (mod(size(cards), n) /= 0 .or. (other%once .and. size(cards) > n)) return
         fields = other%fields
         ! a field for any text takes what is not meant for it
         if (all(fields%kind /= kind_word)) fields = pack(fields, fields%kind /= kind_text)
         if (size(fields) == 0) return
         do i = 1, size(cards)
            if (card_faults(source, cards(i), fields, mod(i - 1, n) + 1) > 0) return
         end do
      end associate
      could_hold = .true.
   end function could_hold

   !> Report a card of an entry that is lacking
   subroutine report_lacking(section, card, k, diagnostics)
      !> The section
      type(section_type), intent(in) :: section
      !> The first card of the entry that is there, and which card is lacking
      integer, intent(in) :: card, k
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: allowed
      integer :: i

      allowed = cardinal(cards_per_entry(section))//' cards: '//trim(section%cards(1))
      do i = 2, cards_per_entry(section)
         allowed = allowed//'; then '//trim(section%cards(i))
      end do
      call add_error(diagnostics, card, 0, 0, 'the '//ordinal(k)//' card of the '// &
                     trim(section%entry)//' is lacking', allowed=allowed)
   end subroutine report_lacking

end module axijoint_deck_text_entry_reader
