!> Errors and warnings about a deck, each with the card and columns it is about
module axijoint_deck_text_diagnostics
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_text_source, only : source_type, card_text, card_file, card_line, printable
   implicit none
   private
   public :: diagnostics_type, add_error, count_again, add_warning, render, warning_texts

   !> One message
   type :: message_type
      !> Whether it is a warning only
      logical :: is_warning = .false.
      !> Index of the card; 0 for the deck as a whole
      integer :: card = 0
      !> Columns of the value; 0 for the whole card
      integer :: first = 0, last = 0
      !> What is wrong
      character(len=:), allocatable :: text
      !> What was found, what is allowed, how to mend it; empty if not said
      character(len=:), allocatable :: found, allowed, mend
      !> Further cards with the same error, which is told once
      integer :: n_more = 0
   end type message_type

   !> All messages about a deck
   type :: diagnostics_type
      !> Number of errors, told or not; a model is valid only if there is none
      integer :: n_errors = 0
      !> Errors among them that are told with another
      integer, private :: n_repeated = 0
      !> Number of warnings
      integer :: n_warnings = 0
      !> The first errors and warnings that were found
      type(message_type), allocatable, private :: messages(:)
      !> Number of `messages` in use
      integer, private :: n_messages = 0
   end type diagnostics_type

   !> Errors that are kept; the rest is counted. Errors are not found in the order
   !> of the deck, so more are kept than shown
   integer, parameter :: max_kept_errors = 2000
   !> Warnings that are kept
   integer, parameter :: max_kept_warnings = 100
   !> Errors that are shown in full
   integer, parameter :: max_shown_errors = 100
   !> Digits of a line number in front of a card
   integer, parameter :: line_width = 5

contains

   !> Record an error
   subroutine add_error(diagnostics, card, first, last, text, found, allowed, mend)
      !> The messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Index of the card; 0 for the deck as a whole
      integer, intent(in) :: card
      !> Columns of the value; 0, 0 for the whole card
      integer, intent(in) :: first, last
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What was found, what is allowed, how to mend it
      character(len=*), intent(in), optional :: found, allowed, mend

      type(message_type) :: message

      diagnostics%n_errors = diagnostics%n_errors + 1
      if (diagnostics%n_errors > max_kept_errors) return
      call new_message(message, card, first, last, text, found, allowed, mend)
      call add_message(diagnostics, message)
   end subroutine add_error

   !> Count an error that one slip may cause on many cards, if it is not the first: the first alone
   !> is told, with the number of others
   subroutine count_again(diagnostics, text, told)
      !> The messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> What is wrong
      character(len=*), intent(in) :: text
      !> Whether it has been told
      logical, intent(out) :: told

      integer :: i

      told = .false.
      do i = 1, diagnostics%n_messages
         told = diagnostics%messages(i)%text == text
         if (told) exit
      end do
      if (.not. told) return
      diagnostics%messages(i)%n_more = diagnostics%messages(i)%n_more + 1
      diagnostics%n_repeated = diagnostics%n_repeated + 1
      diagnostics%n_errors = diagnostics%n_errors + 1
   end subroutine count_again

   !> Record a warning
   subroutine add_warning(diagnostics, card, first, last, text, found, mend)
      !> The messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Index of the card; 0 for the deck as a whole
      integer, intent(in) :: card
      !> Columns of the value; 0, 0 for the whole card
      integer, intent(in) :: first, last
      !> What is doubtful
      character(len=*), intent(in) :: text
      !> What was found, how to mend it
      character(len=*), intent(in), optional :: found, mend

      type(message_type) :: message

      diagnostics%n_warnings = diagnostics%n_warnings + 1
      if (diagnostics%n_warnings > max_kept_warnings) return
      call new_message(message, card, first, last, text, found, mend=mend)
      message%is_warning = .true.
      call add_message(diagnostics, message)
   end subroutine add_warning

   !> Make an error; texts that are absent become empty
   pure subroutine new_message(message, card, first, last, text, found, allowed, mend)
      !> The error
      type(message_type), intent(out) :: message
      !> Index of the card and columns
      integer, intent(in) :: card, first, last
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What was found, what is allowed, how to mend it
      character(len=*), intent(in), optional :: found, allowed, mend

      message%card = card
      message%first = first
      message%last = last
      message%text = text
      message%found = ''
      message%allowed = ''
      message%mend = ''
      if (present(found)) message%found = found
      if (present(allowed)) message%allowed = allowed
      if (present(mend)) message%mend = mend
   end subroutine new_message

   !> Keep a message
   subroutine add_message(diagnostics, message)
      !> The messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> The new one
      type(message_type), intent(in) :: message

      type(message_type), allocatable :: larger(:)
      integer :: n

      n = diagnostics%n_messages
      if (.not. allocated(diagnostics%messages)) allocate (diagnostics%messages(8))
      if (n == size(diagnostics%messages)) then
         allocate (larger(2*n))
         larger(:n) = diagnostics%messages
         call move_alloc(larger, diagnostics%messages)
      end if
      diagnostics%messages(n + 1) = message
      diagnostics%n_messages = n + 1
   end subroutine add_message

   !> All messages as lines, in the order of the cards that they are about, and
   !> a last line that counts them; nothing if there are none
   function render(diagnostics, source) result(lines)
      !> The messages
      type(diagnostics_type), intent(in) :: diagnostics
      !> The deck
      type(source_type), intent(in) :: source
      !> Lines, separated by line feeds
      character(len=:), allocatable :: lines

      integer, allocatable :: order(:)
      integer :: i, n_shown, n_told

      lines = ''
      n_told = diagnostics%n_errors - diagnostics%n_repeated
      n_shown = 0
      call deck_order(diagnostics, order)
      do i = 1, size(order)
         associate (message => diagnostics%messages(order(i)))
            if (.not. message%is_warning) n_shown = n_shown + 1
            if (message%is_warning .or. n_shown <= max_shown_errors) then
               lines = lines//message_lines(message, source)
            end if
         end associate
      end do
      if (n_told > max_shown_errors) then
         lines = lines//'... and '//count_of(n_told - max_shown_errors, 'error')// &
                 ' more that '//trim(merge('is ', 'are', n_told == max_shown_errors + 1)) &
                 //' not shown'//new_line('a')
      end if
      if (size(order) > 0) lines = lines//count_of(n_told, 'error')//', '// &
                                   count_of(diagnostics%n_warnings, 'warning')
   end function render

   !> Warnings alone, one line each, in the order of their cards
   function warning_texts(diagnostics, source) result(texts)
      !> The messages
      type(diagnostics_type), intent(in) :: diagnostics
      !> The deck
      type(source_type), intent(in) :: source
      !> One warning each, padded by blanks
      character(len=:), allocatable :: texts(:)

      integer, allocatable :: order(:)
      integer :: i, n, length

      call deck_order(diagnostics, order)
      order = pack(order, [(diagnostics%messages(order(i))%is_warning, i=1, size(order))])
      length = 0
      do i = 1, size(order)
         length = max(length, len(headline(diagnostics%messages(order(i)), source)))
      end do
      n = size(order)
      allocate (character(len=length) :: texts(n))
      do i = 1, n
         texts(i) = headline(diagnostics%messages(order(i)), source)
      end do
   end function warning_texts

   !> Indices of the messages by card, then column, then as they were found
   pure subroutine deck_order(diagnostics, order)
      !> The messages
      type(diagnostics_type), intent(in) :: diagnostics
      !> Indices
      integer, allocatable, intent(out) :: order(:)

      integer :: i, j, moved

      allocate (order(diagnostics%n_messages))
      order = [(i, i=1, diagnostics%n_messages)]
      do i = 2, size(order)
         moved = order(i)
         do j = i - 1, 1, -1
            if (.not. comes_before(diagnostics%messages(moved), &
                                   diagnostics%messages(order(j)))) exit
            order(j + 1) = order(j)
         end do
         order(j + 1) = moved
      end do
   end subroutine deck_order

   !> Whether a message belongs before another
   pure logical function comes_before(a, b)
      !> The messages
      type(message_type), intent(in) :: a, b

      comes_before = a%card < b%card .or. (a%card == b%card .and. a%first < b%first)
   end function comes_before

   !> First line of a message: position, kind and text
   pure function headline(message, source) result(line)
      !> The message
      type(message_type), intent(in) :: message
      !> The deck
      type(source_type), intent(in) :: source
      !> The line
      character(len=:), allocatable :: line

      line = ''
      if (message%card > 0) then
         line = card_file(source, message%card)//':'//to_text(card_line(source, message%card))//':'
      else if (source%n_files > 0) then
         line = source%files(1)%path//':'
      end if
      if (message%first > 0) then
         line = line//to_text(message%first)
         if (message%last > message%first) line = line//'-'//to_text(message%last)
         line = line//':'
      end if
      if (len(line) > 0) line = line//' '
      line = line//trim(merge('warning:', 'error:  ', message%is_warning))//' '//message%text
      if (message%n_more > 0) line = line//' (on '//count_of(message%n_more, 'more card')//', too)'
   end function headline

   !> All lines of a message, each with its line feed
   pure function message_lines(message, source) result(lines)
      !> The message
      type(message_type), intent(in) :: message
      !> The deck
      type(source_type), intent(in) :: source
      !> The lines
      character(len=:), allocatable :: lines

      character(len=:), allocatable :: number

      lines = headline(message, source)//new_line('a')
      if (message%card > 0) then
         number = to_text(card_line(source, message%card))
         number = repeat(' ', max(0, line_width - len(number)))//number
         lines = lines//number//' | '//trim(printable(card_text(source, message%card)))// &
            new_line('a')
         if (message%first > 0) then
            lines = lines//repeat(' ', len(number))//' |'//repeat(' ', message%first)// &
                    repeat('^', message%last - message%first + 1)//new_line('a')
         end if
      end if
      lines = lines//labelled('found:  ', message%found)//labelled('allowed:', message%allowed) &
              //labelled('mend:   ', message%mend)
   end function message_lines

   !> A line with a label; nothing if there is nothing to say
   pure function labelled(label, text) result(line)
      !> Label
      character(len=*), intent(in) :: label
      !> What follows it
      character(len=*), intent(in) :: text
      !> The line with its line feed
      character(len=:), allocatable :: line

      line = ''
      if (len_trim(text) > 0) line = '  '//label//' '//trim(printable(text))//new_line('a')
   end function labelled

end module axijoint_deck_text_diagnostics
