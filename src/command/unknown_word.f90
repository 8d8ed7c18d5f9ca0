!> Words of the command line that are not known
module axijoint_command_unknown_word
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_text, only : did_you_mean
   implicit none
   private
   public :: unknown

contains

   !> Error for a word that is not known: the likeliest one, and all that are
   subroutine unknown(what, word, known, error, mend)
      !> Kind of word
      character(len=*), intent(in) :: what
      !> The word
      character(len=*), intent(in) :: word
      !> Words of that kind
      character(len=*), intent(in) :: known(:)
      !> The error
      type(error_type), allocatable, intent(out) :: error
      !> How to mend it, if more is known than that
      character(len=*), intent(in), optional :: mend

      character(len=:), allocatable :: message, question
      integer :: k

      message = "unknown "//what//" '"//word//"'"
      question = did_you_mean(word, known)
      if (len(question) > 0) message = message//'; '//question
      message = message//new_line('a')//'known:'
      do k = 1, size(known)
         message = message//' '//trim(known(k))
      end do
      if (present(mend)) message = message//new_line('a')//'mend: '//mend
      call fatal_error(error, exit_deck, message)
   end subroutine unknown

end module axijoint_command_unknown_word
