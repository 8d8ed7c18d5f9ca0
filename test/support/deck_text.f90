!> Decks written as text in a test
module axijoint_test_deck_text
   use axijoint_base_system, only : process_id
   use axijoint_base_text, only : to_text
   use axijoint_deck_reader, only : read_deck
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_deck_text_source, only : source_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: read_cards, messages_of, says, solid_cards, line

   !> End of a card
   character(len=1), parameter :: line = new_line('a')
   !> Cards that a deck needs besides its mesh: M = 2 and material 1
   character(len=*), parameter :: solid_cards = &
      'CONTROL'//line//'    2'//line//'MATERIALS'//line//'    1     100.0       0.3'//line

contains

   !> Read a deck
   subroutine read_cards(cards, model, diagnostics, messages)
      !> Its cards with their ends
      character(len=*), intent(in) :: cards
      !> The job
      type(model_type), intent(out) :: model
      !> Errors and warnings
      type(diagnostics_type), intent(out) :: diagnostics
      !> Their text, without the folder of the deck
      character(len=:), allocatable, intent(out) :: messages

      character(len=:), allocatable :: path
      type(source_type) :: source
      integer :: unit, place

      path = scratch_path()
      open (newunit=unit, file=path, access='stream', form='unformatted', status='replace', &
            action='write')
      write (unit) cards
      close (unit)
      call read_deck(path, source, model, diagnostics)
      open (newunit=unit, file=path)
      close (unit, status='delete')
      messages = render(diagnostics, source)
      do
         place = index(messages, path)
         if (place == 0) exit
         messages = messages(:place - 1)//'deck'//messages(place + len(path):)
      end do
   end subroutine read_cards

   !> Messages about a deck; the deck is named `deck`
   function messages_of(cards) result(messages)
      !> Its cards with their ends
      character(len=*), intent(in) :: cards
      !> Errors and warnings
      character(len=:), allocatable :: messages

      type(model_type) :: model
      type(diagnostics_type) :: diagnostics

      call read_cards(cards, model, diagnostics, messages)
   end function messages_of

   !> Whether the messages about a deck contain a text
   logical function says(cards, text)
      !> The deck's cards with their ends
      character(len=*), intent(in) :: cards
      !> The text
      character(len=*), intent(in) :: text

      says = index(messages_of(cards), text) > 0
   end function says

   !> Path of a file that no other test uses
   function scratch_path() result(path)
      !> The path
      character(len=:), allocatable :: path

      character(len=256) :: folder

      call get_environment_variable('TMPDIR', folder)
      if (len_trim(folder) == 0) folder = '/tmp'
      path = trim(folder)//'/axijoint_test_'//to_text(process_id())//'.dat'
   end function scratch_path

end module axijoint_test_deck_text
