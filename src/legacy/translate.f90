!> From a deck of any older or other program to one of axijoint: which program it is of shows in what
!> it says
module axijoint_legacy_translate
   use axijoint_legacy_abaqus, only : read_abaqus, looks_like_abaqus
   use axijoint_legacy_cards, only : cards_type, open_cards
   use axijoint_deck_text_diagnostics, only : add_error
   use axijoint_legacy_convert, only : convert_deck, may_be_old, is_own
   use axijoint_legacy_layout, only : dialect_type
   use axijoint_legacy_nastran, only : read_nastran, looks_like_nastran
   use axijoint_legacy_sketch, only : sketch_type, tell_left, write_sketch
   implicit none
   private
   public :: translate_deck

contains

   !> Read a deck and write it anew
   subroutine translate_deck(path, bytes, dialect, cards, text, n_left)
      !> The deck, for messages, and what it says
      character(len=*), intent(in) :: path, bytes
      !> Where values stand, if it is one of Owen and Hinton's program
      type(dialect_type), intent(in) :: dialect
      !> Its cards, with errors and warnings
      type(cards_type), intent(out) :: cards
      !> The new deck; of use only if there are no errors among the messages
      character(len=:), allocatable, intent(out) :: text
      !> How many things of the old deck are not translated
      integer, intent(out) :: n_left

      type(sketch_type) :: sketch

      n_left = 0
      call open_cards(path, bytes, dialect, cards)
      if (looks_like_nastran(bytes)) then
         call read_nastran(cards, sketch)
      else if (looks_like_abaqus(bytes)) then
         call read_abaqus(cards, sketch)
      else if (is_own(cards) .or. may_be_old(bytes)) then
         call convert_deck(path, bytes, dialect, cards, text)
         return
      else
         call add_error(cards%diagnostics, 0, 0, 0, 'this is no deck of a program that is known', &
            allowed='decks of NASTRAN with BEGIN BULK and AXIC or RINGAX; input files of Abaqus and CalculiX; decks of the '// &
            'plasticity program of Owen and Hinton, whose second line is NPOIN NELEM NVFIX NTYPE ..., whole numbers')
      end if
      text = ''
      n_left = sketch%n_left
      call tell_left(sketch, cards)
      if (cards%diagnostics%n_errors == 0) call write_sketch(path, sketch, cards, text)
   end subroutine translate_deck

end module axijoint_legacy_translate
