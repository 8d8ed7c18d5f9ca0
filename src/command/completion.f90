!> Completion of command lines in bash, and in zsh by its emulation
module axijoint_command_completion
   use axijoint_base_text, only : lower
   use axijoint_base_version, only : program_name
   use axijoint_command_manual, only : topic_type, option_type, names_of_topics, &
      names_of_options, takes_folder, takes_file, takes_word
   implicit none
   private
   public :: completion

   !> Line end
   character(len=*), parameter :: nl = new_line('a')

contains

   !> What a shell reads
   pure function completion(shell, topics, cards) result(text)
      !> `bash` or `zsh`
      character(len=*), intent(in) :: shell
      !> The commands
      type(topic_type), intent(in) :: topics(:)
      !> Names of the cards
      character(len=*), intent(in) :: cards(:)
      !> The lines
      character(len=:), allocatable :: text

      integer :: k, i

      text = '# Made by `'//program_name//' help --completion '//shell//'`'//nl
      if (shell == 'zsh') text = text//'autoload -U +X bashcompinit && bashcompinit'//nl
      text = text//'_axijoint() {'//nl// &
         '   local IFS=$'' \t\n'' word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]}'//nl// &
         '   local words before=${COMP_WORDS[COMP_CWORD - 1]}'//nl// &
         '   COMPREPLY=()'//nl// &
         '   if [[ $1 == *run ]]; then'//nl// &
         '      command=run'//nl// &
         '   elif [[ $COMP_CWORD -eq 1 ]]; then'//nl// &
         '      '//reply_words(trim(row(names_of_topics(topics)))//' --version --help')//nl// &
         '      return'//nl// &
         '   fi'//nl// &
         '   case "$command $before" in'//nl
      do k = 1, size(topics)
         do i = 1, size(topics(k)%options)
            if (topics(k)%options(i)%value == '') cycle
            text = text//'      "'//trim(topics(k)%name)//' '//trim(topics(k)%options(i)%name)// &
                   '") '//reply_value(topics(k)%options(i))//'return ;;'//nl
         end do
      end do
      text = text//'      "help card") '//reply_words(row(cards)//lower(row(cards)))// &
             '; return ;;'// &
         nl//'   esac'//nl//'   case "$command" in'//nl
      do k = 1, size(topics)
         text = text//'      '//trim(topics(k)%name)//') words="'// &
                trim(row(names_of_options(topics(k))))//'" ;;'//nl
      end do
      text = text//'      *) return ;;'//nl//'   esac'//nl// &
         '   if [[ $command == help ]]; then'//nl// &
         '      '//reply_words('card $words '//trim(row(names_of_topics(topics))))//nl// &
         '   elif [[ $word == -* ]]; then'//nl// &
         '      '//reply_words('$words')//nl// &
         '   else'//nl// &
         '      IFS=$''\n'''//nl// &
         '      '//reply_paths('f')//nl// &
         '   fi'//nl//'}'//nl// &
         'complete -o filenames -F _axijoint '//program_name//' scripts/run ./scripts/run'
   end function completion

   !> Words with a blank behind each
   pure function row(words) result(text)
      !> The words
      character(len=*), intent(in) :: words(:)
      !> The text
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(words)
         text = text//trim(words(k))//' '
      end do
   end function row

   !> Reply with those words that begin as the user's
   pure function reply_words(words) result(text)
      !> The words
      character(len=*), intent(in) :: words
      !> The command of the shell
      character(len=:), allocatable :: text

      text = 'COMPREPLY=($(compgen -W "'//trim(words)//'" -- "$word"))'
   end function reply_words

   !> Reply with paths that begin as the user's word
   pure function reply_paths(kind) result(text)
      !> `f` for any, `d` for folders
      character(len=1), intent(in) :: kind
      !> The command of the shell
      character(len=:), allocatable :: text

      text = 'COMPREPLY=($(compgen -'//kind//' -- "$word"))'
   end function reply_paths

   !> Reply with what the value of an option may be; nothing if it may be anything
   pure function reply_value(option) result(text)
      !> The option
      type(option_type), intent(in) :: option
      !> The command of the shell
      character(len=:), allocatable :: text

      select case (option%takes)
      case (takes_word)
         text = reply_words(option%words)//'; '
      case (takes_folder)
         text = 'IFS=$''\n''; '//reply_paths('d')//'; '
      case (takes_file)
         text = 'IFS=$''\n''; '//reply_paths('f')//'; '
      case default
         text = ''
      end select
   end function reply_value

end module axijoint_command_completion
