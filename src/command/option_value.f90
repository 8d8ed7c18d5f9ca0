!> Values of options of the command line: an option is none
module axijoint_command_option_value
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_command_manual, only : option_type, takes_folder, takes_file
   implicit none
   private
   public :: is_option, refuse_option

contains

   !> Whether a word is an option of a command
   pure logical function is_option(options, word)
      !> Options of the command, but for those that ask for help
      type(option_type), intent(in) :: options(:)
      !> The word
      character(len=*), intent(in) :: word

      is_option = any(options%name == word) .or. any(word == [character(len=6) :: '-h', '--help'])
   end function is_option

   !> Error for an option that stands in the place of a value
   subroutine refuse_option(option, word, error)
      !> The option that needs the value
      type(option_type), intent(in) :: option
      !> What follows it
      character(len=*), intent(in) :: word
      !> The error
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: mend

      mend = ''
      if (any(option%takes == [takes_folder, takes_file])) &
         mend = new_line('a')//'mend: a '//trim(merge('folder', 'file  ', option%takes == takes_folder))// &
         ' of this name is ./'//word
      call fatal_error(error, exit_deck, 'option '//trim(option%name)//' needs '//trim(option%value)//", found '"//word// &
         "', which is an option itself"//mend)
   end subroutine refuse_option

end module axijoint_command_option_value
