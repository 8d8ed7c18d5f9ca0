!> Command line of `axijoint compare`
module axijoint_command_compare_line
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_command_line, only : word_type
   use axijoint_command_manual, only : option_type, compare_options
   use axijoint_command_option_value, only : is_option, refuse_option
   use axijoint_command_unknown_word, only : unknown
   use axijoint_compare_tolerances, only : tolerances_type, special_type, name_type
   use axijoint_deck_text_token, only : read_real, read_integer, token_good
   implicit none
   private
   public :: compare_type, read_compare

   !> What is to be compared
   type :: compare_type
      !> The two files, and the descriptions of their formats, empty for none
      type(word_type) :: path(2), format(2)
      !> Tolerances
      type(tolerances_type) :: tolerances
      !> Whether only the built-in format is printed
      logical :: print_format = .false.
   end type compare_type

contains

   !> Read the words after `compare`
   subroutine read_compare(words, compare, error)
      !> The words
      type(word_type), intent(in) :: words(:)
      !> What is to be compared
      type(compare_type), intent(out) :: compare
      !> Wrong options, or not two files
      type(error_type), allocatable, intent(out) :: error

      type(option_type), allocatable :: options(:)
      integer :: k, n, option

      options = compare_options()
      allocate (compare%tolerances%special(0), compare%tolerances%skipped(0))
      compare%format(1)%text = ''
      compare%format(2)%text = ''
      k = 0
      n = 0
      do while (k < size(words))
         k = k + 1
         if (index(words(k)%text, '-') /= 1) then
            n = n + 1
            if (n <= 2) compare%path(n)%text = words(k)%text
            cycle
         end if
         option = findloc(options%name == words(k)%text, .true., 1)
         if (option == 0) then
            call unknown('option', words(k)%text, [character(len=16) :: options%name, '--help'], &
                         error)
         else if (options(option)%value == '') then
            call set_plain(words(k)%text, compare)
         else if (k == size(words)) then
            call fatal_error(error, exit_deck, 'option '//words(k)%text//' needs '// &
               trim(options(option)%value)//": see 'axijoint help compare'")
         else if (is_option(options, words(k + 1)%text)) then
            call refuse_option(options(option), words(k + 1)%text, error)
         else
            k = k + 1
            call set_value(words(k - 1)%text, words(k)%text, compare, error)
         end if
         if (allocated(error)) return
      end do
      if (n /= 2 .and. .not. compare%print_format) call fatal_error(error, exit_deck, &
         'two files are compared; use: axijoint compare A B [OPTIONS]')
   end subroutine read_compare

   !> An option without a value
   subroutine set_plain(option, compare)
      !> The option
      character(len=*), intent(in) :: option
      !> What is to be compared
      type(compare_type), intent(inout) :: compare

      select case (option)
      case ('--exact-digits')
         compare%tolerances%rounded = .false.
      case ('--allow-unknown')
         compare%tolerances%unknown = .true.
      case default
         compare%print_format = .true.
      end select
   end subroutine set_plain

   !> An option with a value
   subroutine set_value(option, value, compare, error)
      !> The option and its value
      character(len=*), intent(in) :: option, value
      !> What is to be compared
      type(compare_type), intent(inout) :: compare
      !> A value that is not allowed
      type(error_type), allocatable, intent(out) :: error

      integer :: fault

      associate (tolerances => compare%tolerances)
         select case (option)
         case ('--relative')
            call read_tolerance(option, value, tolerances%relative, error)
         case ('--absolute')
            call read_tolerance(option, value, tolerances%absolute, error)
         case ('--of-table')
            call read_tolerance(option, value, tolerances%of_table, error)
         case ('--of-file')
            call read_tolerance(option, value, tolerances%of_file, error)
         case ('--coordinates')
            call read_tolerance(option, value, tolerances%coordinates, error)
         case ('--tolerance')
            call add_special(value, tolerances, error)
         case ('--allow-missing')
            call allow_missing(value, tolerances, error)
         case ('--skip')
            tolerances%skipped = [tolerances%skipped, name_type(value)]
         case ('--format-a')
            compare%format(1)%text = value
         case ('--format-b')
            compare%format(2)%text = value
         case default
            call read_integer(value, tolerances%n_worst, fault)
            if (fault /= token_good .or. tolerances%n_worst < 0) &
               call fatal_error(error, exit_deck, &
               "option --worst: found '"//value//"', allowed is a number from 0")
         end select
      end associate
   end subroutine set_value

   !> A tolerance
   subroutine read_tolerance(option, text, value, error)
      !> The option and its value
      character(len=*), intent(in) :: option, text
      !> The tolerance
      real(wp), intent(out) :: value
      !> It is no number from 0
      type(error_type), allocatable, intent(out) :: error

      integer :: fault

      value = 0.0_wp
      fault = token_good + 1
      if (len(text) > 0) call read_real(text, value, fault)
      if (fault == token_good .and. value >= 0.0_wp) return
      call fatal_error(error, exit_deck, 'option '//option//": found '"//text// &
                       "', allowed is a number from 0, such as 1E-6")
   end subroutine read_tolerance

   !> NAME=RELATIVE or NAME=RELATIVE,ABSOLUTE
   subroutine add_special(text, tolerances, error)
      !> The value of the option
      character(len=*), intent(in) :: text
      !> Tolerances
      type(tolerances_type), intent(inout) :: tolerances
      !> It is not of that form
      type(error_type), allocatable, intent(out) :: error

      type(special_type) :: special
      integer :: equals, comma

      equals = index(text, '=')
      if (equals < 2) then
         call fatal_error(error, exit_deck, "option --tolerance: found '"//text// &
            "', allowed is "// &
            'NAME=RELATIVE or NAME=RELATIVE,ABSOLUTE, NAME being a quantity or a column')
         return
      end if
      special%name = text(:equals - 1)
      comma = index(text(equals + 1:)//',', ',') + equals
      call read_tolerance('--tolerance', text(equals + 1:comma - 1), special%relative, error)
      if (allocated(error)) return
      if (comma < len(text)) then
         call read_tolerance('--tolerance', text(comma + 1:), special%absolute, error)
      end if
      tolerances%special = [tolerances%special, special]
   end subroutine add_special

   !> What may be in one file only
   subroutine allow_missing(text, tolerances, error)
      !> The value of the option
      character(len=*), intent(in) :: text
      !> Tolerances
      type(tolerances_type), intent(inout) :: tolerances
      !> It is none of the things that may
      type(error_type), allocatable, intent(out) :: error

      select case (text)
      case ('tables')
         tolerances%missing_tables = .true.
      case ('columns')
         tolerances%missing_columns = .true.
      case ('rows')
         tolerances%missing_rows = .true.
      case ('all')
         tolerances%missing_tables = .true.
         tolerances%missing_columns = .true.
         tolerances%missing_rows = .true.
      case default
         call fatal_error(error, exit_deck, "option --allow-missing: found '"//text// &
                          "', allowed are tables, columns, rows, all")
      end select
   end subroutine allow_missing

end module axijoint_command_compare_line
