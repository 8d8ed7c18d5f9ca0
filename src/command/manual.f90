!> What the commands of the program are and which options they take: the command line is read by
!> this table, and help, manual page and completion are made from it
module axijoint_command_manual
   use axijoint_base_text, only : lower
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_registry, only : solver_words
   implicit none
   private
   public :: option_type, topic_type, all_topics, compare_options, topic_named, option_named, &
      names_of_topics, names_of_options
   public :: takes_folder, takes_file, takes_word, takes_anything

   !> What the value of an option is: one of some words, a path, anything
   integer, parameter :: takes_anything = 0, takes_folder = 1, takes_file = 2, takes_word = 3

   !> An option
   type :: option_type
      !> Name, with its dashes
      character(len=16) :: name = ''
      !> Name of its value; blank if it takes none
      character(len=12) :: value = ''
      !> What it does
      character(len=200) :: meaning = ''
      !> What its value is, and the words, separated by blanks, if it is one of some
      integer :: takes = takes_anything
      character(len=80) :: words = ''
      !> Whether the command cannot do without it
      logical :: required = .false.
   end type option_type

   !> A command
   type :: topic_type
      !> Name
      character(len=12) :: name = ''
      !> What it is given beside options
      character(len=20) :: arguments = ''
      !> What it does, in a few words
      character(len=60) :: purpose = ''
      !> What it does, at length
      character(len=600) :: description = ''
      !> Options
      type(option_type), allocatable :: options(:)
      !> Exit codes; blank if they are the usual ones
      character(len=300) :: exit_codes = ''
   end type topic_type

contains

   !> All commands
   function all_topics(solvers) result(topics)
      !> Solvers that can be asked for
      type(solver_entry_type), intent(in) :: solvers(:)
      !> The commands, in the order of the help
      type(topic_type), allocatable :: topics(:)

      type(option_type) :: threads, memory, quiet, legacy, formats

      threads = option_type('--threads', 'N', &
         'harmonics at once (default: OMP_NUM_THREADS, or all processors)')
      memory = option_type('--memory', 'MIB', 'memory that the process may take: fewer factors '// &
         'at once then (default: what the machine, its control group and limits leave)')
      quiet = option_type('--quiet', '', 'nothing but errors and warnings')
      legacy = option_type('--legacy', 'PROGRAM', 'the deck is one of an older program: '// &
         'owen-hinton (axisymmetric plasticity, 1980)', takes_word, 'owen-hinton')
      formats = option_type('--format', 'FILE', 'formats of its cards, where they are not those '// &
         'of the book: lines with a card and its format', takes_file)
      allocate (topics(8))
      topics(1) = topic_type('run', 'DECK...', 'solve decks', &
         'Solves each deck and writes NAME.lis (listing), NAME.json (summary) and NAME.h5 '// &
         '(results), NAME being the name of the deck without its ending. The deck - is read '// &
         'from the standard input; its results are called stdin, and paths in it begin at the '// &
         'current directory.', &
         [option_type('-o', 'DIR', 'directory for the results, made with those above it if it '// &
                      'is not there (default: the current one)', takes_folder), &
          option_type('--solver', 'NAME', alternatives(solvers)//' (default: as the deck says)', &
                      takes_word, joined(solvers)), &
          threads, memory, &
          option_type('--processes', 'N', 'decks by N processes of this machine, one each, which share threads and memory '// &
                      '(default: one after the other)'), &
          legacy, formats, &
          option_type('--listing', 'PROGRAM', 'NAME.owen-hinton.lis, too: the listing as that '// &
                      'program prints it (harmonic 0, no joints)', takes_word, 'owen-hinton'), &
          option_type('--vtk', '', 'NAME.vtkhdf for ParaView, too (whole circle; SWEEP of the '// &
                      'deck says more)'), &
          option_type('--no-estimates', '', 'no estimates of errors: faster, where many cases are alike and one was judged'), &
          option_type('--resume', '', 'go on from NAME.state, which a run that was stopped or '// &
                      'died left beside its results; a deck whose results are complete is left'), &
          option_type('--checkpoint', 'MINUTES', 'keep NAME.state up to date every so many '// &
                      'minutes; 0: after each load step (default: as often as takes 1 % of the '// &
                      'time)'), &
          quiet, &
          option_type('--verbose', '', 'lines on the standard error output that say what is '// &
                      'being done, for logs: at each stage, and then at most one a minute'), &
          option_type('--', '', 'everything that follows is a deck')], &
         '0 ok; 2 deck or usage; 3 not converged; 4 singular or mechanism; 5 input or output; '// &
         '6 memory; 7 another run writes these results; 8 a state that cannot be gone on from; '// &
         '70 internal; 75 stopped, --resume goes on. Of several decks, the largest; 75 if one was stopped.')
      topics(2) = topic_type('check', 'DECK...', 'read and check decks only', &
         'Reads and checks each deck, prints all its errors and what it describes, and solves '// &
         'nothing. The deck - is read from the standard input.', &
         [quiet, legacy, formats], '0 ok; 2 deck or usage.')
      topics(3) = estimate_topic(solvers, threads, memory)
      topics(4) = study_topic(solvers, threads, memory, quiet)
      topics(5) = envelope_topic(solvers, threads, memory, quiet)
      topics(6) = topic_type('compare', 'A B', 'compare two listings or result files', &
         'Compares two listings, two HDF5 result files, or one of each, table by table and '// &
         'column by column. Rows are matched by their places (r, z, theta), whatever the '// &
         'numbers of the nodes. Values are the same if they differ by no more than the largest '// &
         'of the tolerances, and the rounding of the digits printed. Listings of Owen and '// &
         'Hinton''s program are known by their headings.', compare_options(), &
         '0 same; 1 different; 2 a file that cannot be read, or usage.')
      topics(7) = topic_type('convert', 'OLD NEW', 'write a deck of another program anew', &
         'Reads OLD and writes NEW, a deck with comments, which must not be there before: from a '// &
         'deck of the axisymmetric plasticity program of Owen and Hinton one that gives the same results as run --legacy '// &
         'owen-hinton OLD; from a deck of NASTRAN for solids of revolution in harmonics (AXIC), or '// &
         'an input file of Abaqus or CalculiX with CAX elements, what can be said. What is '// &
         'understood in another way or not translated is told line by line.', [formats], &
         '0 ok; 2 deck or usage; 5 input or output.')
      topics(8) = topic_type('help', '[COMMAND]', 'help on a command', &
         'Without COMMAND, what commands there are. `help card` prints an index of all cards '// &
         'of a deck, `help card NAME` the fields of one.', &
         [option_type('--markdown', '', 'of cards: as they stand in doc/deck.md'), &
          option_type('--json', '', 'of cards: with kinds and ranges, for programs'), &
          option_type('--man', '', 'the manual page, as source for man'), &
          option_type('--completion', 'SHELL', 'what completes command lines in bash or zsh', &
                      takes_word, 'bash zsh')])
   end function all_topics

   !> `estimate`
   function estimate_topic(solvers, threads, memory) result(topic)
      !> Solvers that can be asked for
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Options that several commands have
      type(option_type), intent(in) :: threads, memory
      !> The command
      type(topic_type) :: topic

      topic = topic_type('estimate', 'DECK...', 'say what decks would cost', &
         'Says what a run of each deck would take on this machine: seconds by phase and what '// &
         'takes most of each, memory, files; or, with --study, what a study would. The deck is '// &
         'read and its equations are planned, as by a run with the same options; nothing is '// &
         'solved. How many iterations joints take is not known before: what is assumed is '// &
         'printed. The deck - is read from the standard input.', &
         [option_type('--study', 'TABLE', 'of the study of this table and the deck (default: '// &
                      'NAME.dat beside it)', takes_file), &
          option_type('--estimates', '', 'of a study with estimates of errors'), &
          option_type('--no-estimates', '', 'of runs without estimates of errors'), &
          option_type('--part', 'K/N', 'of a part of a study'), &
          option_type('--iterations', 'N', 'iterations an increment (default: what is usual)'), &
          option_type('--slurm', '', '#SBATCH lines for a job script instead: three times the '// &
                      'time and 5 minutes, 1.2 times the memory and 256 MB, for the largest of '// &
                      'the decks'), &
          option_type('--solver', 'NAME', alternatives(solvers)//' (default: as the deck says)', &
                      takes_word, joined(solvers)), &
          threads, memory, &
          option_type('--vtk', '', 'of a run with NAME.vtkhdf'), &
          option_type('--counts', '', 'what is counted, and seconds of one, for programs')])
   end function estimate_topic

   !> `study`
   function study_topic(solvers, threads, memory, quiet) result(topic)
      !> Solvers that can be asked for
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Options that several commands have
      type(option_type), intent(in) :: threads, memory, quiet
      !> The command
      type(topic_type) :: topic

      topic = topic_type('study', 'TABLE [DECK]', 'solve many states of a deck', &
         'Solves the deck (NAME.dat beside TABLE unless it is given) for each row of a table, '// &
         'and writes NAME.study.csv, a line a row, and NAME.study.h5, with all increments. '// &
         'The head of the table names what varies: `LAWS 1 PHI, RESULTANTS 2 VALUE`. Cells '// &
         'hold '// &
         'values, lists (1; 2; 5), ranges (0:40:2 or 0:40/21) and distributions (NORMAL 30 2); '// &
         'a line stands for all their combinations. Rows of one structure share its '// &
         'condensation. A study that was ended goes on where it was.', &
         [option_type('-o', 'DIR', 'directory for the results', takes_folder), &
          option_type('--solver', 'NAME', alternatives(solvers)//' (default: as the deck says)', &
                      takes_word, joined(solvers)), &
          threads, memory, &
          option_type('--estimates', '', 'estimates of errors of each row, too: slower'), &
          option_type('--processes', 'N', 'rows by N processes of this machine, which share '// &
                      'threads and memory (default: as many as threads, where rows are worth it)'), &
          option_type('--part', 'K/N', 'only part K of N; `--part 0/N` gathers the parts, '// &
          'solves '// &
                      'what they lack and writes the files'), &
          quiet, &
          option_type('--verbose', '', 'lines on the standard error output that say what is '// &
                      'being done, for logs')], &
         'The largest of the rows'', as of run.')
   end function study_topic

   !> `envelope`
   function envelope_topic(solvers, threads, memory, quiet) result(topic)
      !> Solvers that can be asked for
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Options that several commands have
      type(option_type), intent(in) :: threads, memory, quiet
      !> The command
      type(topic_type) :: topic

      topic = topic_type('envelope', 'DECK', 'find what loads joints can carry, by direction', &
         'Finds the largest factor that equilibrium is found for in directions of the space of '// &
         'some load cases, and the mechanism beyond it. Increments of other load cases come '// &
         'first (a card of INCREMENTS with the number of a case), with the factors of COMBINE; '// &
         'then the load of a direction grows, as the cards of its cases give it. Writes '// &
         'NAME.envelope.csv, a line a direction, and NAME.envelope.h5. A search that was ended '// &
         'goes on where it was.', &
         [option_type('--cases', 'LIST', 'load cases, divided by commas; 1+ with positive '// &
                      'factors alone', required=.true.), &
          option_type('--directions', 'N', 'directions (default: 24)'), &
          option_type('--tolerance', 'T', 'part of a capacity that may be left open (default: '// &
                      '0.01)'), &
          option_type('-o', 'DIR', 'directory for the results', takes_folder), &
          option_type('--solver', 'NAME', alternatives(solvers)//' (default: as the deck says)', &
                      takes_word, joined(solvers)), &
          threads, memory, quiet, &
          option_type('--verbose', '', 'lines on the standard error output that say what is '// &
                      'being done, for logs')], &
         '0 if every direction ends in a mechanism or in none up to very large factors; 3 if '// &
         'an iteration found no equilibrium; else as of run, 4 if the increments that come first '// &
         'end in a mechanism.')
   end function envelope_topic

   !> Options of `compare`
   pure function compare_options() result(options)
      !> The options
      type(option_type) :: options(14)

      options = [ &
         option_type('--relative', 'T', 'of the larger of the two values (default: 1E-6)'), &
         option_type('--absolute', 'T', 'in the unit of the value (default: 0)'), &
         option_type('--of-table', 'T', 'of the largest of the quantity in the table '// &
                     '(default: 1E-9)'), &
         option_type('--of-file', 'T', 'of the largest of the quantity in the file '// &
                     '(default: 1E-12)'), &
         option_type('--tolerance', 'NAME=R[,A]', 'relative and absolute, of a quantity or a '// &
                     'column'), &
         option_type('--coordinates', 'T', 'distance of the same place, of the extent '// &
                     '(default: 1E-9)'), &
         option_type('--exact-digits', '', 'printed numbers are exact, not rounded'), &
         option_type('--allow-missing', 'WHAT', 'tables, columns, rows or all may be in one '// &
                     'file only', takes_word, 'tables columns rows all'), &
         option_type('--allow-unknown', '', 'NaN on both sides or asterisks are no difference'), &
         option_type('--skip', 'NAME', 'table, column or quantity that is not compared'), &
         option_type('--worst', 'N', 'differences shown for each table (default: 5)'), &
         option_type('--format-a', 'FILE', 'description of the format of A', takes_file), &
         option_type('--format-b', 'FILE', 'description of the format of B', takes_file), &
         option_type('--print-format', '', 'print the description of axijoint''s own listing')]
   end function compare_options

   !> Names of the solvers as in: one, two or three
   function alternatives(solvers) result(text)
      !> The solvers
      type(solver_entry_type), intent(in) :: solvers(:)
      !> The text
      character(len=:), allocatable :: text

      integer :: k

      associate (words => solver_words(solvers))
         text = trim(words(1))
         do k = 2, size(words) - 1
            text = text//', '//trim(words(k))
         end do
         if (size(words) > 1) text = text//' or '//trim(words(size(words)))
      end associate
      text = lower(text)
   end function alternatives

   !> Names of the solvers with a blank between them
   function joined(solvers) result(text)
      !> The solvers
      type(solver_entry_type), intent(in) :: solvers(:)
      !> The text
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      associate (words => solver_words(solvers))
         do k = 1, size(words)
            text = text//' '//lower(trim(words(k)))
         end do
      end associate
      text = text(2:)
   end function joined

   !> Place of a command; 0 if there is none of the name
   pure integer function topic_named(topics, name) result(k)
      !> The commands
      type(topic_type), intent(in) :: topics(:)
      !> The name
      character(len=*), intent(in) :: name

      do k = size(topics), 1, -1
         if (topics(k)%name == name) return
      end do
   end function topic_named

   !> Place of an option of a command; 0 if it has none of the name
   pure integer function option_named(topic, name) result(k)
      !> The command
      type(topic_type), intent(in) :: topic
      !> The name
      character(len=*), intent(in) :: name

      do k = size(topic%options), 1, -1
         if (topic%options(k)%name == name) return
      end do
   end function option_named

   !> Names of the commands
   pure function names_of_topics(topics) result(names)
      !> The commands
      type(topic_type), intent(in) :: topics(:)
      !> Their names
      character(len=12) :: names(size(topics))

      integer :: k

      do k = 1, size(topics)
         names(k) = topics(k)%name
      end do
   end function names_of_topics

   !> Names of the options of a command, and of help on it
   pure function names_of_options(topic) result(names)
      !> The command
      type(topic_type), intent(in) :: topic
      !> The names
      character(len=16) :: names(size(topic%options) + 1)

      integer :: k

      do k = 1, size(topic%options)
         names(k) = topic%options(k)%name
      end do
      names(size(names)) = '--help'
   end function names_of_options

end module axijoint_command_manual
