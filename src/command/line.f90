!> Command line: words to a configuration
module axijoint_command_line
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : i8
   use axijoint_base_text, only : upper, lower
   use axijoint_base_version, only : program_name, program_version
   use axijoint_command_card_help, only : card_help, card_usage
   use axijoint_command_compare_help, only : compare_help
   use axijoint_command_unknown_word, only : unknown
   use axijoint_job_job, only : options_type
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_registry, only : find_solver, solver_words
   implicit none
   private
   public :: command_type, word_type, read_command, help_text
   public :: command_run, command_check, command_estimate, command_compare, command_help, &
      command_help_card

   !> Solve decks
   integer, parameter :: command_run = 1
   !> Read and check decks
   integer, parameter :: command_check = 2
   !> Say what decks would cost
   integer, parameter :: command_estimate = 3
   !> Compare two listings or result files
   integer, parameter :: command_compare = 4
   !> Print help
   integer, parameter :: command_help = 5
   !> Print the version
   integer, parameter :: command_version = 6
   !> Print help on cards
   integer, parameter :: command_help_card = 7

   !> Names of the commands, by number
   character(len=*), parameter :: command_names(5) = [character(len=8) :: 'run', 'check', &
      'estimate', 'compare', 'help']

   !> Options of `run` that take a value; `estimate` has the last two
   character(len=*), parameter :: value_options(4) = &
      ['-o       ', '--solver ', '--threads', '--memory ']
   character(len=*), parameter :: estimate_options(2) = value_options(3:)

   !> A word of any length
   type :: word_type
      !> The word
      character(len=:), allocatable :: text
   end type word_type

   !> What the user asked for
   type :: command_type
      !> One of the `command_` parameters
      integer :: command = command_help
      !> Decks to run or check; of `compare`, all words that follow it
      type(word_type), allocatable :: decks(:)
      !> Solvers that can be asked for
      type(solver_entry_type), allocatable :: solvers(:)
      !> Directory for results, solver, memory, sweep
      type(options_type) :: options
      !> Threads asked for; 0: as the environment says
      integer :: threads = 0
      !> Command that help was asked for; empty for all
      character(len=:), allocatable :: topic
      !> Help on cards, where it was asked for
      character(len=:), allocatable :: card_help
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
      integer :: k

      allocate (words(command_argument_count()), command%decks(0))
      command%solvers = solvers
      do k = 1, size(words)
         words(k)%text = argument(k)
      end do
      command%options%directory = '.'
      command%topic = ''
      if (size(words) == 0) return

      select case (words(1)%text)
      case ('run')
         command%command = command_run
      case ('check')
         command%command = command_check
      case ('estimate')
         command%command = command_estimate
      case ('compare')
         call read_compare_words(words(2:), command)
         return
      case ('help', '--help', '-h')
         call read_help_words(words(2:), command, error)
         return
      case ('--version')
         command%command = command_version
         return
      case default
         call unknown('command', words(1)%text, [character(len=9) :: command_names, '--version'], &
                      error)
         return
      end select
      call read_arguments(words(2:), command, error)
   end subroutine read_command

   !> Words of `help`: a command, or `card` and what follows it
   subroutine read_help_words(words, command, error)
      !> Words after the command
      type(word_type), intent(in) :: words(:)
      !> What the user asked for
      type(command_type), intent(inout) :: command
      !> Unknown command or card
      type(error_type), allocatable, intent(out) :: error

      character(len=80) :: names(max(0, size(words) - 1))
      integer :: k

      if (size(words) == 0) return
      command%topic = words(1)%text
      if (command%topic == 'card') then
         command%command = command_help_card
         do k = 2, size(words)
            names(k - 1) = words(k)%text
         end do
         call card_help(names, command%card_help, error)
      else if (.not. any(command_names == command%topic)) then
         call unknown('command', command%topic, [character(len=8) :: command_names, 'card'], error)
      end if
   end subroutine read_help_words

   !> Words of `compare`, which reads them itself, unless help is asked for
   subroutine read_compare_words(words, command)
      !> Words after the command
      type(word_type), intent(in) :: words(:)
      !> What the user asked for
      type(command_type), intent(inout) :: command

      integer :: k

      command%command = command_compare
      command%decks = words
      do k = 1, size(words)
         if (words(k)%text /= '-h' .and. words(k)%text /= '--help') cycle
         command%command = command_help
         command%topic = 'compare'
      end do
   end subroutine read_compare_words

   !> Decks and options of `run`, `check` and `estimate`
   subroutine read_arguments(words, command, error)
      !> Words after the command
      type(word_type), intent(in) :: words(:)
      !> What the user asked for
      type(command_type), intent(inout) :: command
      !> Unknown option, missing deck or directory
      type(error_type), allocatable, intent(out) :: error

      logical :: only_decks
      integer :: k

      only_decks = .false.
      k = 0
      do while (k < size(words))
         k = k + 1
         associate (word => words(k)%text)
            if (only_decks .or. index(word, '-') /= 1 .or. len(word) == 1) then
               command%decks = [command%decks, words(k)]
            else if (word == '--') then
               only_decks = .true.
            else if ((any(word == value_options) .and. command%command == command_run) .or. &
                     (any(word == estimate_options) .and. command%command == command_estimate)) then
               if (k == size(words)) then
                  call fatal_error(error, exit_deck, 'option '//word//' needs a '// &
                                   trim(merge('directory', 'value    ', word == '-o'))// &
                                   ": see 'axijoint help "//trim(command_names(command%command))// &
                                   "'")
                  return
               end if
               k = k + 1
               call read_option(word, words(k)%text, command, error)
               if (allocated(error)) return
            else if (word == '--vtk' .and. command%command == command_run) then
               command%options%swept = .true.
            else if (word == '-h' .or. word == '--help') then
               command%topic = trim(command_names(command%command))
               command%command = command_help
               return
            else if (command%command == command_run) then
               call unknown('option', word, [character(len=9) :: value_options, '--vtk', &
                  '--help'], error)
               return
            else if (command%command == command_estimate) then
               call unknown('option', word, [character(len=9) :: estimate_options, '--help'], error)
               return
            else
               call unknown('option', word, ['--help'], error)
               return
            end if
         end associate
      end do
      if (size(command%decks) == 0) then
         call fatal_error(error, exit_deck, 'no deck given; use: '//program_name//' '// &
                          trim(command_names(command%command))//' DECK...')
      end if
   end subroutine read_arguments

   !> Value of an option
   subroutine read_option(option, value, command, error)
      !> The option, one of `value_options`
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
      case ('--solver')
         call find_solver(command%solvers, upper(value), command%options%solver, &
            command%options%solver_given)
         if (.not. command%options%solver_given) &
            call unknown('solver', value, lower_all(solver_words(command%solvers)), error)
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

   !> Words as in: one, two or three
   pure function alternatives(words) result(text)
      !> The words, two or more
      character(len=*), intent(in) :: words(:)
      !> The text
      character(len=:), allocatable :: text

      integer :: k

      text = trim(words(1))
      do k = 2, size(words) - 1
         text = text//', '//trim(words(k))
      end do
      text = text//' or '//trim(words(size(words)))
   end function alternatives

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

   !> Help on a command, or on all
   function help_text(topic, solvers) result(text)
      !> Name of a command; empty for all
      character(len=*), intent(in) :: topic
      !> Solvers that there are
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Lines of help
      character(len=:), allocatable :: text

      character, parameter :: nl = new_line('a')

      select case (topic)
      case ('run')
         text = 'usage: axijoint run DECK... [-o DIR] [--solver NAME] [--threads N]'//nl// &
            '                            [--memory MIB] [--vtk]'//nl// &
            nl// &
            'Solves each deck and writes NAME.lis (listing), NAME.json (summary) and NAME.h5'// &
            nl// &
            '(results), NAME being the name of the deck without its ending.'//nl// &
            nl// &
            '  -o DIR         directory for the results (default: the current one)'//nl// &
            '  --solver NAME  '//alternatives(lower_all(solver_words(solvers)))// &
            ' (default: as the deck says)'//nl// &
            '  --threads N    harmonics at once (default: OMP_NUM_THREADS, or all processors)'// &
            nl// &
            '  --memory MIB   memory that the process may take: fewer factors at once then '// &
            '(default:'//nl// &
            '                 what the machine, its control group and limits leave)'//nl// &
            '  --vtk          NAME.vtkhdf for ParaView, too (whole circle; SWEEP of the deck '// &
            'says more)'//nl// &
            '  --             everything that follows is a deck'//nl// &
            nl// &
            'Exit codes: 0 ok; 2 deck or usage; 3 not converged; 4 singular or mechanism;'//nl// &
            '5 input or output; 6 memory; 70 internal. Of several decks, the largest.'
      case ('check')
         text = 'usage: axijoint check DECK...'//nl// &
            nl// &
            'Reads and checks each deck, prints all its errors and what it describes, and'//nl// &
            'solves nothing. Exit codes: 0 ok; 2 deck or usage.'
      case ('estimate')
         text = 'usage: axijoint estimate DECK... [--threads N] [--memory MIB]'//nl// &
            nl// &
            'Says for each solver what a run of each deck would need: unknowns, entries of the'// &
            nl// &
            'factors, operations, memory and time, with the threads and in the memory that the '// &
            'run'//nl// &
            'would have. Nothing is solved.'
      case ('compare')
         text = compare_help
      case ('help')
         text = 'usage: axijoint help [COMMAND]'//nl//nl//card_usage
      case default
         text = program_name//' '//program_version//': Fourier finite element analysis of '// &
            'axisymmetric bodies with joints'//nl// &
            nl// &
            'usage: axijoint COMMAND'//nl// &
            nl// &
            '  run DECK... [OPTIONS]  solve decks'//nl// &
            '  check DECK...          read and check decks only'//nl// &
            '  estimate DECK...       say what decks would cost'//nl// &
            '  compare A B [OPTIONS]  compare two listings or result files'//nl// &
            '  help [COMMAND]         help on a command'//nl// &
            '  help card [NAME]       the cards of a deck, or the fields of one'//nl// &
            '  --version              version'
      end select
   end function help_text

end module axijoint_command_line
