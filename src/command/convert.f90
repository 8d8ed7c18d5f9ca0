!> `axijoint convert`: a deck of an older program, written anew
module axijoint_command_convert
   use, intrinsic :: iso_fortran_env, only : output_unit, error_unit
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_deck
   use axijoint_command_line, only : command_type
   use axijoint_command_run, only : print_error
   use axijoint_deck_text_diagnostics, only : render
   use axijoint_deck_text_file_bytes, only : read_bytes
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_translate, only : translate_deck
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: convert_old

contains

   !> Convert a deck
   subroutine convert_old(command, exit_code)
      !> The old deck, the new one, formats
      type(command_type), intent(in) :: command
      !> 0; 2 if the old deck has errors; 5 if the new one cannot be written
      integer, intent(out) :: exit_code

      type(error_type), allocatable :: error
      type(cards_type) :: cards
      type(text_file_type) :: file
      character(len=:), allocatable :: bytes, failure, text, messages

      exit_code = exit_ok
      associate (old => command%decks(1)%text, new => command%decks(2)%text)
         call read_bytes(old, bytes, failure)
         if (len(failure) > 0) then
            call fatal_error(error, exit_deck, old//': error: '//failure)
         else
            call translate_deck(old, bytes, command%options%legacy, cards, text)
            messages = render(cards%diagnostics, cards%source)
            if (cards%diagnostics%n_errors > 0) then
               call fatal_error(error, exit_deck, messages)
            else
               if (len(messages) > 0) write (error_unit, '(a)') messages
               call write_new(new, text, file, error)
            end if
         end if
         if (allocated(error)) then
            call print_error('', error)
            exit_code = error%code
         else
            write (output_unit, '(a)') new//': written; axijoint run '//new//' solves it'
         end if
      end associate
   end subroutine convert_old

   !> Write the new deck: it is there when it is complete
   subroutine write_new(path, text, file, error)
      !> Its path, and what it says
      character(len=*), intent(in) :: path, text
      !> The file
      type(text_file_type), intent(inout) :: file
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      call file%open(path, error)
      if (allocated(error)) return
      call file%put(text(:len(text) - 1))
      call file%finish(error)
      if (.not. allocated(error)) call file%commit(error)
      if (allocated(error)) call file%abandon()
   end subroutine write_new

end module axijoint_command_convert
