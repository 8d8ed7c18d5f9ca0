!> Command line: words to a configuration
module axijoint_command_line
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_system, only : path_kind, path_file
   use axijoint_base_text, only : upper, lower
   use axijoint_base_version, only : program_name, program_version
   use axijoint_command_card_help, only : card_help, names_of_cards
   use axijoint_command_completion, only : completion
   use axijoint_command_help, only : overview, help_on
   use axijoint_command_man_page, only : man_page
   use axijoint_command_manual, only : topic_type, all_topics, topic_named, option_named, &
      names_of_topics, names_of_options
   use axijoint_command_option_value, only : is_option, refuse_option
   use axijoint_command_unknown_word, only : unknown
   use axijoint_deck_text_token, only : read_integer, read_real, token_good
   use axijoint_job_checkpoint, only : whenever_cheap
   use axijoint_job_job, only : options_type
   use axijoint_legacy_layout, only : dialect_type, read_dialect
   use axijoint_study_parts, only : part_type
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_registry, only : find_solver, solver_words
   implicit none
   private
   public :: command_type, word_type, read_command

   !> A word of any length
   type :: word_type
      !> The word
      character(len=:), allocatable :: text
   end type word_type

   !> What the user asked for
   type :: command_type
      !> Name of the command; `print` if there is only a text to be printed
      character(len=:), allocatable :: name
      !> Decks to run or check; of `compare`, all words that follow it
      type(word_type), allocatable :: decks(:)
      !> All words after the command; those of them that are options and their values
      type(word_type), allocatable :: words(:), settings(:)
      !> Solvers that can be asked for
      type(solver_entry_type), allocatable :: solvers(:)
      !> Directory for results, solver, memory, sweep
      type(options_type) :: options
      !> Threads asked for; 0: as the environment says
      integer :: threads = 0
      !> Least time between two states that are kept [second], or `whenever_cheap`
      real(wp) :: interval = whenever_cheap
      !> Whether to go on from the state that an earlier run left
      logical :: resume = .false.
      !> Whether nothing but errors and warnings is to be told; whether a log is to say what is done
      logical :: quiet = .false., verbose = .false.
      !> Of a study: whether errors are estimated; the part to solve; processes that solve it, 0 for
      !> as many as pay; of decks to run 0 for one
      logical :: estimates = .false.
      type(part_type) :: part
      integer :: n_processes = 0
      !> Of an estimate: iterations of an increment, 0 for what is usual; whether lines of a job
      !> script are wanted, or all counts; the table of a study
      integer :: iterations = 0
      logical :: job_lines = .false., counts = .false.
      character(len=:), allocatable :: table
      !> File of the formats of an old deck
      character(len=:), allocatable :: formats
      !> Of an envelope: load cases as given, number of directions, part of a capacity that is left
      !> open
      character(len=:), allocatable :: cases
      integer :: n_directions = 24
      real(wp) :: tolerance = 0.01_wp
      !> Help or version, where these were asked for
      character(len=:), allocatable :: text
   end type command_type

contains

   !> Read the command line of the process
   subroutine read_command(command, solvers, error)
      !> What the user asked for
      type(command_type), intent(out) :: command
      !> Solvers that there are
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Unknown command or option, missing deck
      type(error_type), allocatable, intent(out) :: error

      type(word_type), allocatable :: words(:)
      type(topic_type), allocatable :: topics(:)
      character(len=12), allocatable :: known(:)
      integer :: k

      topics = all_topics(solvers)
      allocate (words(command_argument_count()), command%decks(0))
      command%solvers = solvers
      do k = 1, size(words)
         words(k)%text = argument(k)
      end do
      command%options%directory = '.'
      command%name = 'print'
      command%text = ''
      if (size(words) == 0) command%text = overview(topics)
      if (size(words) == 0) return

      select case (words(1)%text)
      case ('run', 'check', 'estimate', 'study', 'envelope', 'convert')
         call read_arguments(words(2:), topics(topic_named(topics, words(1)%text)), command, error)
      case ('compare')
         call read_compare_words(words(2:), topics, command)
      case ('help', '--help', '-h')
         command%text = overview(topics)
         call read_help_words(words(2:), topics, command, error)
      case ('--version')
         command%text = program_name//' '//program_version
      case default
         known = [character(len=12) :: names_of_topics(topics), '--version']
         if (path_kind(words(1)%text) == path_file) then
            call unknown('command', words(1)%text, known, error, mend='axijoint run '//words(1)%text//' runs this file')
         else
            call unknown('command', words(1)%text, known, error)
         end if
      end select
   end subroutine read_command

   !> Words of `help`: a command, `card` and what follows it, or an option
   subroutine read_help_words(words, topics, command, error)
      !> Words after the command
      type(word_type), intent(in) :: words(:)
      !> All commands
      type(topic_type), intent(in) :: topics(:)
      !> What the user asked for
      type(command_type), intent(inout) :: command
      !> Unknown command or card
      type(error_type), allocatable, intent(out) :: error

      character(len=80) :: names(max(0, size(words) - 1))
      integer :: k

      if (size(words) == 0) return
      do k = 2, size(words)
         names(k - 1) = words(k)%text
      end do
      select case (words(1)%text)
      case ('card')
         call card_help(names, command%text, error)
      case ('--man')
         command%text = man_page(topics)
      case ('--completion')
         if (.not. any([character(len=4) :: 'bash', 'zsh'] == join(names))) then
            call unknown('shell', join(names), [character(len=4) :: 'bash', 'zsh'], error)
         else
            command%text = completion(join(names), topics, names_of_cards())
         end if
      case default
         k = topic_named(topics, words(1)%text)
         if (k > 0) then
            command%text = help_on(topics(k))
         else
            call unknown('command', words(1)%text, [character(len=12) :: names_of_topics(topics), &
                         'card', '--man', '--completion'], error)
         end if
      end select
   end subroutine read_help_words

   !> Words with a blank between them
   pure function join(words) result(text)
      !> The words
      character(len=*), intent(in) :: words(:)
      !> The text
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(words)
         text = trim(text//' '//words(k))
      end do
      text = trim(adjustl(text))
   end function join

   !> Words of `compare`, which reads them itself, unless help is asked for
   subroutine read_compare_words(words, topics, command)
      !> Words after the command
      type(word_type), intent(in) :: words(:)
      !> All commands
      type(topic_type), intent(in) :: topics(:)
      !> What the user asked for
      type(command_type), intent(inout) :: command

      integer :: k

      command%name = 'compare'
      command%decks = words
      do k = 1, size(words)
         if (words(k)%text /= '-h' .and. words(k)%text /= '--help') cycle
         command%name = 'print'
         command%text = help_on(topics(topic_named(topics, 'compare')))
      end do
   end subroutine read_compare_words

   !> Decks and options of `run`, `check` and `estimate`
   subroutine read_arguments(words, topic, command, error)
      !> Words after the command
      type(word_type), intent(in) :: words(:)
      !> The command
      type(topic_type), intent(in) :: topic
      !> What the user asked for
      type(command_type), intent(inout) :: command
      !> Unknown option, missing deck or directory
      type(error_type), allocatable, intent(out) :: error

      logical :: only_decks
      integer :: k, option

      command%name = trim(topic%name)
      command%words = words
      allocate (command%settings(0))
      only_decks = .false.
      k = 0
      do while (k < size(words))
         k = k + 1
         associate (word => words(k)%text)
            option = option_named(topic, word)
            if (only_decks .or. index(word, '-') /= 1 .or. len(word) == 1) then
               command%decks = [command%decks, words(k)]
            else if (word == '--') then
               only_decks = .true.
            else if (word == '-h' .or. word == '--help') then
               command%name = 'print'
               command%text = help_on(topic)
               return
            else if (option == 0) then
               call unknown('option', word, names_of_options(topic), error)
            else if (topic%options(option)%value == '') then
               call set_option(word, command)
               command%settings = [command%settings, words(k)]
            else if (k == size(words)) then
               call fatal_error(error, exit_deck, 'option '//word//' needs '// &
                  trim(topic%options(option)%value)//": see 'axijoint help "//command%name//"'")
            else if (is_option(topic%options, words(k + 1)%text)) then
               call refuse_option(topic%options(option), words(k + 1)%text, error)
            else
               k = k + 1
               call read_option(word, words(k)%text, command, error)
               command%settings = [command%settings, words(k - 1:k)]
            end if
            if (allocated(error)) return
         end associate
      end do
      if (command%name == 'convert' .and. .not. allocated(command%options%legacy)) &
         command%options%legacy = dialect_type()
      if (allocated(command%formats)) then
         if (allocated(command%options%legacy)) then
            call read_dialect(command%formats, command%options%legacy, error)
            if (allocated(error)) return
         else
            call fatal_error(error, exit_deck, 'option --format goes with --legacy owen-hinton')
         end if
      end if
      if (command%name == 'convert' .and. size(command%decks) /= 2) &
         call fatal_error(error, exit_deck, 'an old deck and the name of the new one are needed; '// &
         'use: '//program_name//' convert OLD NEW')
      if (allocated(error)) return
      if (command%quiet .and. command%verbose) call fatal_error(error, exit_deck, &
         'only one of --quiet and --verbose can be had')
      if (allocated(command%table)) then
         if (size(command%decks) > 1) call fatal_error(error, exit_deck, &
            'a study has one table and one deck; use: '//program_name// &
            ' estimate [DECK] --study TABLE')
         if (.not. command%options%estimated) call fatal_error(error, exit_deck, &
            'rows of a study have no estimates of errors without --estimates: --no-estimates is of runs')
         return
      end if
      if (command%name == 'estimate' .and. (command%estimates .or. command%part%n > 0)) &
         call fatal_error(error, exit_deck, 'options --estimates and --part go with --study TABLE')
      if (size(command%decks) == 0) call fatal_error(error, exit_deck, &
         'no '//trim(merge('table', 'deck ', command%name == 'study'))//' given; use: '// &
         program_name//' '//command%name//' '//trim(topic%arguments))
      if (command%name == 'envelope' .and. size(command%decks) > 1) call fatal_error(error, &
         exit_deck, 'an envelope has one deck; use: '//program_name//' envelope DECK --cases 1,2')
      if (command%name == 'envelope' .and. .not. allocated(command%cases)) call fatal_error(error, &
         exit_deck, 'an envelope needs --cases: the load cases whose factors span it, such as '// &
         '--cases 1,2, or 1+,2 if the first acts with positive factors alone')
      if (command%n_processes > 1 .and. command%part%n > 0) call fatal_error(error, exit_deck, &
         'only one of --processes and --part can be had')
      if (command%name == 'study' .and. size(command%decks) > 2) &
         call fatal_error(error, exit_deck, &
         'a study has one table and one deck; use: '//program_name//' study TABLE [DECK]')
      if (command%name == 'study' .and. size(command%decks) == 2) then
         associate (first => command%decks(1)%text, second => command%decks(2)%text)
            if (is_of(first, '.dat') .and. is_of(second, '.csv')) call fatal_error(error, exit_deck, &
               'the table comes first, then the deck; use: '//program_name//' study '//second//' '//first)
         end associate
      end if
   end subroutine read_arguments

   !> Whether a file has an ending
   pure logical function is_of(path, ending)
      !> Its path, and the ending
      character(len=*), intent(in) :: path, ending

      is_of = index(path, ending, back=.true.) == len(path) - len(ending) + 1 .and. len(path) > len(ending)
   end function is_of

   !> Set an option without a value
   subroutine set_option(option, command)
      !> The option
      character(len=*), intent(in) :: option
      !> What the user asked for
      type(command_type), intent(inout) :: command

      select case (option)
      case ('--vtk')
         command%options%swept = .true.
      case ('--no-estimates')
         command%options%estimated = .false.
      case ('--estimates')
         command%estimates = .true.
      case ('--slurm')
         command%job_lines = .true.
      case ('--counts')
         command%counts = .true.
      case ('--resume')
         command%resume = .true.
      case ('--quiet')
         command%quiet = .true.
      case default
         command%verbose = .true.
      end select
   end subroutine set_option

   !> Value of an option
   subroutine read_option(option, value, command, error)
      !> The option
      character(len=*), intent(in) :: option
      !> Its value
      character(len=*), intent(in) :: value
      !> What the user asked for
      type(command_type), intent(inout) :: command
      !> Value that is not allowed
      type(error_type), allocatable, intent(out) :: error

      integer :: stat

      select case (option)
      case ('-o')
         command%options%directory = value
         if (len_trim(value) == 0) &  ! such as of a variable of a script that was never set
            call fatal_error(error, exit_deck, 'option -o has an empty value')
      case ('--solver')
         call find_solver(command%solvers, upper(value), command%options%solver, &
            command%options%solver_given)
         if (.not. command%options%solver_given) &
            call unknown('solver', value, lower_all(solver_words(command%solvers)), error)
      case ('--legacy')
         if (lower(value) == 'owen-hinton') then
            command%options%legacy = dialect_type()
         else
            call unknown('program', value, [character(len=11) :: 'owen-hinton'], error)
         end if
      case ('--format')
         command%formats = value
      case ('--listing')
         command%options%old_listing = lower(value) == 'owen-hinton'
         if (.not. command%options%old_listing) &
            call unknown('listing', value, [character(len=11) :: 'owen-hinton'], error)
      case ('--cases')
         command%cases = value
      case ('--study')
         command%table = value
      case ('--iterations')
         call read_number(option, value, command%iterations, error)
      case ('--processes')
         call read_number(option, value, command%n_processes, error)
      case ('--directions')
         call read_number(option, value, command%n_directions, error)
      case ('--tolerance')
         call read_real(value, command%tolerance, stat)
         if (stat == token_good .and. command%tolerance > 0.0_wp &
             .and. command%tolerance < 1.0_wp) return
         call fatal_error(error, exit_deck, "option --tolerance: found '"//value// &
                          "', allowed is a number between 0 and 1")
      case ('--part')
         call read_part(value, command, error)
      case ('--checkpoint')
         call read_interval(value, command%interval, error)
      case ('--memory')
         call read_memory(value, command%options%memory_limit, error)
      case default
         stat = 1
         if (verify(value, '0123456789') == 0 .and. len(value) <= 4) then
            read (value, *, iostat=stat) command%threads
         end if
         if (stat == 0 .and. command%threads > 0) return
         call fatal_error(error, exit_deck, "option --threads: found '"//value// &
                          "', allowed is a number from 1 to 9999")
      end select
   end subroutine read_option

   !> A number from 1 on
   subroutine read_number(option, value, number, error)
      !> The option, and its value
      character(len=*), intent(in) :: option, value
      !> The number
      integer, intent(inout) :: number
      !> Value that is not allowed
      type(error_type), allocatable, intent(out) :: error

      integer :: found, stat

      call read_integer(value, found, stat)
      if (stat == token_good .and. found > 0) then
         number = found
      else
         call fatal_error(error, exit_deck, 'option '//option//": found '"//value// &
                          "', allowed is a number from 1 on")
      end if
   end subroutine read_number

   !> A part of a study
   subroutine read_part(value, command, error)
      !> K/N
      character(len=*), intent(in) :: value
      !> What the user asked for
      type(command_type), intent(inout) :: command
      !> Value that is not allowed
      type(error_type), allocatable, intent(out) :: error

      integer :: slash, stat

      stat = 1
      slash = index(value, '/')
      if (slash > 1 .and. len(value) <= 13) then
         if (verify(value(:slash - 1)//value(slash + 1:), '0123456789') == 0) then
            read (value(:slash - 1), *, iostat=stat) command%part%number
            if (stat == 0) read (value(slash + 1:), *, iostat=stat) command%part%n
         end if
      end if
      if (stat == 0 .and. command%part%n > 0 .and. command%part%number <= command%part%n) return
      call fatal_error(error, exit_deck, "option --part: found '"//value// &
                       "', allowed is K/N with K from 0 to N")
   end subroutine read_part

   !> A time between two states
   subroutine read_interval(value, seconds, error)
      !> Number of minutes
      character(len=*), intent(in) :: value
      !> The time
      real(wp), intent(inout) :: seconds
      !> Value that is not allowed
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: minutes
      integer :: stat

      stat = 1
      if (verify(value, '0123456789.') == 0 .and. len(value) > 0 .and. len(value) <= 9) then
         read (value, *, iostat=stat) minutes
      end if
      if (stat == 0) then
         seconds = 60.0_wp*minutes
      else
         call fatal_error(error, exit_deck, "option --checkpoint: found '"//value// &
                          "', allowed is a number of minutes from 0")
      end if
   end subroutine read_interval

   !> A limit on memory
   subroutine read_memory(value, bytes, error)
      !> Number of MiB
      character(len=*), intent(in) :: value
      !> The limit
      integer(i8), intent(inout) :: bytes
      !> Value that is not allowed
      type(error_type), allocatable, intent(out) :: error

      integer(i8), parameter :: mebibyte = 2_i8**20
      integer(i8) :: number
      integer :: stat

      stat = 1
      number = 0
      if (verify(value, '0123456789') == 0 .and. len(value) > 0 .and. len(value) <= 9) then
         read (value, *, iostat=stat) number
      end if
      if (stat == 0 .and. number > 0) then
         bytes = number*mebibyte
      else
         call fatal_error(error, exit_deck, "option --memory: found '"//value// &
                          "', allowed is a number of MiB from 1 to 999999999")
      end if
   end subroutine read_memory

   !> Words in small letters
   pure function lower_all(words) result(small)
      !> The words
      character(len=*), intent(in) :: words(:)
      !> The same in small letters
      character(len=len(words)) :: small(size(words))

      integer :: k

      do k = 1, size(words)
         small(k) = lower(words(k))
      end do
   end function lower_all

   !> A word of the command line
   function argument(k) result(text)
      !> Its number
      integer, intent(in) :: k
      !> The word
      character(len=:), allocatable :: text

      integer :: length

      call get_command_argument(k, length=length)
      allocate (character(len=length) :: text)
      call get_command_argument(k, text)
   end function argument

end module axijoint_command_line
