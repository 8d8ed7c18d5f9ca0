!> `axijoint convert`: a deck of an older program, written anew
module axijoint_command_convert
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_deck, exit_io
   use axijoint_base_progress, only : tell_below
   use axijoint_base_system, only : path_kind, path_absent, same_file
   use axijoint_base_text, only : to_text
   use axijoint_command_line, only : command_type
   use axijoint_command_run, only : print_error
   use axijoint_deck_reader, only : read_deck
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_deck_text_file_bytes, only : read_bytes
   use axijoint_deck_text_source, only : source_type
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_translate, only : translate_deck
   use axijoint_model_model, only : model_type
   use axijoint_output_file_pending, only : check_name
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: convert_old

   !> What elsewhere stands for what goes in or out without a name
   character(len=*), parameter :: standard_output = '-'

contains

   !> Convert a deck
   subroutine convert_old(command, exit_code)
      !> The old deck, the new one, formats
      type(command_type), intent(in) :: command
      !> 0; 2 if the old deck has errors, or what is made of it has; 5 if the name of the new one is
      !> taken, or it cannot be written
      integer, intent(out) :: exit_code

      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      integer :: n_left

      exit_code = exit_ok
      associate (old => command%decks(1)%text, new => command%decks(2)%text)
         call check_new(old, new, error)
         if (.not. allocated(error)) call translate(old, command, text, n_left, error)
         if (.not. allocated(error)) call write_new(new, text, error)
         if (.not. allocated(error)) call check_written(new, text, error)
         if (allocated(error)) then
            call print_error('', error)
            exit_code = error%code
         else
            write (output_unit, '(a)') new//': written; '//end_of(n_left)//'axijoint run '//new//' solves it'
         end if
      end associate
   end subroutine convert_old

   !> Words on what the new deck does without
   pure function end_of(n_left) result(words)
      !> How many things are not translated
      integer, intent(in) :: n_left
      !> The words
      character(len=:), allocatable :: words

      words = ''
      if (n_left == 1) words = '1 thing of the old deck is not in it, see the warning; '
      if (n_left > 1) words = to_text(n_left)//' things of the old deck are not in it, see the warnings; '
   end function end_of

   !> Nothing is overwritten, least of all the old deck
   subroutine check_new(old, new, error)
      !> Paths of the decks
      character(len=*), intent(in) :: old, new
      !> The name of the new one is taken
      type(error_type), allocatable, intent(out) :: error

      if (new == standard_output) then
         call fatal_error(error, exit_io, new//' is no name of a new deck'//new_line('a')// &
            'mend: a name, such as new.dat; the deck goes into a file')
         return
      end if
      if (same_file(old, new)) then
         call fatal_error(error, exit_io, new//' is the old deck itself'//new_line('a')// &
            'mend: another name for the new deck')
         return
      end if
      call check_name(new, 'choose another name for the new deck', error)
      if (allocated(error)) return
      if (path_kind(new) == path_absent) return
      call fatal_error(error, exit_io, new//' is there already'//new_line('a')// &
         'mend: remove it, or choose another name for the new deck')
   end subroutine check_new

   !> Read the old deck and write it anew in memory; what it means here is told
   subroutine translate(old, command, text, n_left, error)
      !> Path of the old deck
      character(len=*), intent(in) :: old
      !> Formats
      type(command_type), intent(in) :: command
      !> The new deck
      character(len=:), allocatable, intent(out) :: text
      !> How many things of the old deck are not translated
      integer, intent(out) :: n_left
      !> Errors of the old deck
      type(error_type), allocatable, intent(out) :: error

      type(cards_type) :: cards
      character(len=:), allocatable :: bytes, failure, messages

      n_left = 0
      call read_bytes(old, bytes, failure)
      if (len(failure) > 0) then
         call fatal_error(error, exit_deck, old//': error: '//failure)
         return
      end if
      call translate_deck(old, bytes, command%options%legacy, cards, text, n_left)
      messages = render(cards%diagnostics, cards%source)
      if (cards%diagnostics%n_errors > 0) then
         call fatal_error(error, exit_deck, messages)
      else if (len(messages) > 0) then
         call tell_below(messages)
      end if
   end subroutine translate

   !> Write the new deck: it is there when it is complete
   subroutine write_new(path, text, error)
      !> Its path, and what it says
      character(len=*), intent(in) :: path, text
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: file

      call file%open(path, error)
      if (allocated(error)) return
      call file%put(text(:len(text) - 1))
      call file%finish(error)
      if (.not. allocated(error)) call file%commit(error)
      if (allocated(error)) call file%abandon()
   end subroutine write_new

   !> What can be translated card by card need not be a job here, such as a pressure inside a body: the
   !> new deck is read, and what is wrong with it is told. It stays, as it may be mended by hand
   subroutine check_written(path, text, error)
      !> Its path, and what it says
      character(len=*), intent(in) :: path, text
      !> It has errors
      type(error_type), allocatable, intent(out) :: error

      type(source_type) :: source
      type(model_type) :: model
      type(diagnostics_type) :: diagnostics

      call read_deck(path, source, model, diagnostics, bytes=text)
      if (diagnostics%n_errors > 0) call fatal_error(error, exit_deck, path// &
         ': written, but it has errors; mend the old deck, or this one'//new_line('a')// &
         render(diagnostics, source))
   end subroutine check_written

end module axijoint_command_convert
