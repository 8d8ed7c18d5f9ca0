!> Help on the cards of a deck: an index, or the fields of one
module axijoint_command_card_help
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_text, only : upper
   use axijoint_command_card_list, only : cards_json
   use axijoint_command_unknown_word, only : unknown
   use axijoint_deck_registry, only : all_sections
   use axijoint_deck_text_reference, only : index_text, index_table, section_text, section_table
   use axijoint_deck_text_section, only : section_type, section_named, names_of, &
      keyword_length
   implicit none
   private
   public :: card_help, names_of_cards

   !> The options for tables as they stand in the manual, and for a list that programs read
   character(len=*), parameter :: markdown_option = '--markdown', json_option = '--json'

contains

   !> What `axijoint help card` prints
   subroutine card_help(names, text, error)
      !> Words after `card`: the name of a card, the option
      character(len=*), intent(in) :: names(:)
      !> Lines of help
      character(len=:), allocatable, intent(out) :: text
      !> Unknown card or option
      type(error_type), allocatable, intent(out) :: error

      type(section_type), pointer :: sections(:)
      character(len=:), allocatable :: name
      logical :: markdown, json
      integer :: k

      text = ''
      name = ''
      markdown = .false.
      json = .false.
      do k = 1, size(names)
         if (names(k) == markdown_option) then
            markdown = .true.
         else if (names(k) == json_option) then
            json = .true.
         else if (index(names(k), '-') == 1) then
            call unknown('option', trim(names(k)), &
               [character(len=10) :: markdown_option, json_option], error)
            return
         else if (len(name) > 0) then
            call fatal_error(error, exit_deck, &
               'help on one card at a time; use: axijoint help card NAME')
            return
         else
            name = upper(trim(names(k)))
         end if
      end do
      sections => all_sections()
      if (len(name) == 0) then
         text = index_text(sections)
         if (markdown) text = index_table(sections)
         if (json) text = cards_json(sections)
         return
      end if
      k = section_named(sections, name)
      if (k == 0) then
         call unknown('card', name, names_of(sections), error)
         return
      end if
      text = section_text(sections(k))
      if (markdown) text = section_table(sections(k))
      if (json) text = cards_json(sections(k:k))
   end subroutine card_help

   !> Names of all cards
   function names_of_cards() result(names)
      !> The names
      character(len=keyword_length), allocatable :: names(:)

      names = names_of(all_sections())
   end function names_of_cards

end module axijoint_command_card_help
