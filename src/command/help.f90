!> Help in the terminal: on all commands, or on one
module axijoint_command_help
   use axijoint_base_version, only : program_name, program_version
   use axijoint_command_manual, only : topic_type, option_type
   implicit none
   private
   public :: overview, help_on

   !> Line end, and the last column of a line
   character(len=*), parameter :: nl = new_line('a')
   integer, parameter :: width = 88

contains

   !> What commands there are
   pure function overview(topics) result(text)
      !> The commands
      type(topic_type), intent(in) :: topics(:)
      !> Lines of help
      character(len=:), allocatable :: text

      character(len=28) :: usage
      integer :: k

      text = program_name//' '//program_version//': Fourier finite element analysis of '// &
             'axisymmetric bodies with joints'//nl//nl//'usage: '//program_name//' COMMAND'//nl
      do k = 1, size(topics)
         usage = trim(topics(k)%name)//' '//topics(k)%arguments
         if (topics(k)%name /= 'help') usage = trim(usage)//' [OPTIONS]'
         text = text//nl//'  '//usage//' '//trim(topics(k)%purpose)
      end do
      usage = 'help card [NAME]'
      text = text//nl//'  '//usage//' the cards of a deck, or the fields of one'
      usage = '--version'
      text = text//nl//'  '//usage//' version'
   end function overview

   !> Help on a command
   pure function help_on(topic) result(text)
      !> The command
      type(topic_type), intent(in) :: topic
      !> Lines of help
      character(len=:), allocatable :: text

      character(len=:), allocatable :: option
      integer :: k, column

      column = maxval([(len(option_text(topic%options(k))), k=1, size(topic%options))]) + 4
      text = usage_of(topic)//nl//nl//filled(trim(topic%description), 0, 0)//nl
      do k = 1, size(topic%options)
         option = option_text(topic%options(k))
         text = text//nl//'  '//option//repeat(' ', column - 2 - len(option))// &
                filled(trim(topic%options(k)%meaning), column, column)
      end do
      if (len_trim(topic%exit_codes) > 0) &
         text = text//nl//nl//filled('Exit codes: '//trim(topic%exit_codes), 0, 0)
   end function help_on

   !> How a command is written
   pure function usage_of(topic) result(text)
      !> The command
      type(topic_type), intent(in) :: topic
      !> A line or more
      character(len=:), allocatable :: text

      character(len=:), allocatable :: option
      integer :: k, indent

      text = 'usage: '//program_name//' '//trim(topic%name)//' '
      indent = len(text)
      text = text//trim(topic%arguments)
      do k = 1, size(topic%options)
         if (topic%options(k)%name == '--') cycle
         option = ' ['//option_text(topic%options(k))//']'
         if (topic%options(k)%required) option = ' '//option_text(topic%options(k))
         if (len(text) - index(nl//text, nl, back=.true.) + 1 + len(option) > width) &
            text = text//nl//repeat(' ', indent - 1)
         text = text//option
      end do
   end function usage_of

   !> An option and the name of its value
   pure function option_text(option) result(text)
      !> The option
      type(option_type), intent(in) :: option
      !> The text
      character(len=:), allocatable :: text

      text = trim(trim(option%name)//' '//option%value)
   end function option_text

   !> A paragraph in lines
   pure function filled(paragraph, column, indent) result(text)
      !> The paragraph
      character(len=*), intent(in) :: paragraph
      !> Columns that its first line begins behind, and blanks before the others
      integer, intent(in) :: column, indent
      !> The lines
      character(len=:), allocatable :: text

      integer :: first, last, used

      text = ''
      used = column
      first = 1
      do while (first <= len(paragraph))
         last = first - 2 + index(paragraph(first:)//' ', ' ')
         if (used + 1 + last - first + 1 > width) then
            text = text//nl//repeat(' ', indent)
            used = indent
         else if (first > 1) then
            text = text//' '
            used = used + 1
         end if
         text = text//paragraph(first:last)
         used = used + last - first + 1
         first = last + 2
      end do
   end function filled

end module axijoint_command_help
