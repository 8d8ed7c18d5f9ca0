!> The deck as it was read, in the listing and in the results file
module axijoint_output_file_echo
   use axijoint_deck_text_source, only : source_type, card_text, card_file, card_line, keep_utf8
   use axijoint_output_file_headings, only : write_heading, write_lines
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_echo, deck_text, deck_path

   !> Line number before a card
   character(len=*), parameter :: format_line = '(i7, " |")'

contains

   !> Cards with their line numbers, question marks for what is not UTF-8; a change of file is marked
   subroutine write_echo(file, source, listed)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> Which of them
      logical, intent(in) :: listed(:)

      character(len=:), allocatable :: text
      character(len=9) :: margin
      integer :: card, last_file
      logical :: valid

      call write_heading(file, "DECK")
      last_file = 0
      do card = 1, source%n_cards
         if (.not. listed(card)) cycle
         if (source%cards(card)%file /= last_file) then
            call write_lines(file, "  file: ", card_file(source, card))
            last_file = source%cards(card)%file
         end if
         write (margin, format_line) card_line(source, card)
         text = card_text(source, card)
         call keep_utf8(text, valid)
         call write_lines(file, margin, text)
      end do
   end subroutine write_echo

   !> All cards as lines, included files in place, question marks for what is not UTF-8
   pure function deck_text(source) result(text)
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> The lines
      character(len=:), allocatable :: text

      integer :: card, used, length
      logical :: valid

      associate (cards => source%cards(:source%n_cards))
         length = sum(max(0, cards%last - cards%first + 1) + 1)
      end associate
      allocate (character(len=length) :: text)
      used = 0
      do card = 1, source%n_cards
         associate (line => card_text(source, card)//new_line("a"))
            text(used + 1:used + len(line)) = line
            used = used + len(line)
         end associate
      end do
      call keep_utf8(text, valid)
   end function deck_text

   !> Path of the deck itself
   pure function deck_path(source) result(path)
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> The path as the user gave it
      character(len=:), allocatable :: path

      path = ""
      if (source%n_files > 0) path = source%files(1)%path
   end function deck_path

end module axijoint_output_file_echo
