!> The COLUMN card of a format description
module axijoint_compare_read_column_card
   use axijoint_base_text, only : lower, did_you_mean, to_text
   use axijoint_compare_read_factor, only : read_factor
   use axijoint_compare_read_format, only : column_format_type, translation_type, place_free, &
      place_fixed, place_heading, place_constant, blank_missing, blank_zero, blank_above
   use axijoint_compare_read_pattern, only : next_word
   use axijoint_compare_table_table, only : kind_names
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_token, only : read_integer, token_good
   implicit none
   private
   public :: read_column

   !> Options of a column
   character(len=*), parameter :: option_names(4) = [character(len=9) :: 'factor', 'factor_m0', &
      'blank', 'word']
   !> What a blank field may mean
   character(len=*), parameter :: blank_names(3) = [character(len=7) :: 'missing', 'zero', 'above']

contains

   !> Read a COLUMN card: name, kind, then place and options
   subroutine read_column(card, content, start, column, good, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Where the name may begin
      integer, intent(in) :: start
      !> The column
      type(column_format_type), intent(out) :: column
      !> Whether all is right
      logical, intent(out) :: good
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: first, last, errors

      errors = diagnostics%n_errors
      allocate (column%translations(0))
      column%constant = ''
      call next_word(content, start, first, last)
      column%name = content(first:last)
      call next_word(content, last + 1, first, last)
      if (first == 0) then
         call add_error(diagnostics, card, start, len(content), 'the column has no kind', &
            found=column%name, allowed=list_of(kind_names))
         last = len(content)
      else
         column%kind = findloc(kind_names == lower(content(first:last)), .true., 1)
         if (column%kind == 0) call report(card, first, last, content, 'the kind of the column '// &
            'is not known', kind_names, diagnostics)
      end if
      do
         call next_word(content, last + 1, first, last)
         if (first == 0) exit
         call read_word(card, content, first, last, column, diagnostics)
      end do
      good = diagnostics%n_errors == errors
   end subroutine read_column

   !> Place or option
   subroutine read_word(card, content, first, last, column, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Columns of the word
      integer, intent(in) :: first, last
      !> The column
      type(column_format_type), intent(inout) :: column
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: equals

      associate (word => content(first:last))
         equals = index(word, '=')
         if (lower(word) == 'heading') then
            column%place = place_heading
         else if (equals == 1 .and. len(word) > 1) then
            column%place = place_constant
            column%constant = word(2:)
         else if (equals > 1 .and. equals < len(word)) then
            call read_option(card, content, first, last, equals, column, diagnostics)
         else
            call read_place(card, content, first, last, column, diagnostics)
         end if
      end associate
   end subroutine read_word

   !> Fixed columns, FIRST-LAST
   subroutine read_place(card, content, first, last, column, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Columns of the word
      integer, intent(in) :: first, last
      !> The column
      type(column_format_type), intent(inout) :: column
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: dash, faults(2)
      logical :: good

      dash = index(content(first:last), '-')
      good = dash > 1 .and. dash < last - first + 1
      if (good) then
         call read_integer(content(first:first + dash - 2), column%first, faults(1))
         call read_integer(content(first + dash:last), column%last, faults(2))
         good = all(faults == token_good) .and. column%first >= 1 .and. column%last >= column%first
      end if
      column%place = place_fixed
      if (good) return
      call add_error(diagnostics, card, first, last, 'this is neither a place nor an option', &
         found=content(first:last), allowed='columns such as 11-22 (the first not beyond the '// &
         'last), '// &
         'heading, =VALUE, or an option: factor= factor_m0= blank= word=')
   end subroutine read_place

   !> An option
   subroutine read_option(card, content, first, last, equals, column, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Columns of the option, and place of the sign = in it
      integer, intent(in) :: first, last, equals
      !> The column
      type(column_format_type), intent(inout) :: column
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, parameter :: blanks(3) = [blank_missing, blank_zero, blank_above]
      logical :: good
      integer :: k

      associate (value => content(first + equals:last))
         good = .true.
         select case (lower(content(first:first + equals - 2)))
         case ('factor')
            call read_factor(value, column%factor, good)
            column%factor_m0 = column%factor
         case ('factor_m0')
            call read_factor(value, column%factor_m0, good)
         case ('blank')
            k = findloc(blank_names == lower(value), .true., 1)
            if (k > 0) column%blank = blanks(k)
            if (k == 0) call report(card, first + equals, last, content, &
               'what a blank field means is not known', blank_names, diagnostics)
         case ('word')
            k = index(value, ':')
            if (k > 1 .and. k < len(value)) then
               column%translations = [column%translations, &
                                      translation_type(value(:k - 1), value(k + 1:))]
            else
               call add_error(diagnostics, card, first + equals, last, 'two words are needed', &
                  found=value, allowed='word=PRINTED:MEANT')
            end if
         case default
            call report(card, first, first + equals - 2, content, 'the option is not known', &
               option_names, diagnostics)
         end select
         if (.not. good) call add_error(diagnostics, card, first + equals, last, &
            'this is no factor', found=value, &
            allowed='numbers other than 0 and pi with * and /, '// &
            'such as -1, 1E-3, 1/pi, 1/(2*pi)', mend='write it without blanks')
      end associate
   end subroutine read_option

   !> Report a word that is none of a list
   subroutine report(card, first, last, content, text, known, diagnostics)
      !> The card and the columns of the word
      integer, intent(in) :: card, first, last
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> What is wrong
      character(len=*), intent(in) :: text
      !> Words that are right
      character(len=*), intent(in) :: known(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      call add_error(diagnostics, card, first, last, text, found=content(first:last), &
         allowed=list_of(known), mend=did_you_mean(content(first:last), known))
   end subroutine report

   !> Words in a row
   pure function list_of(words) result(text)
      !> The words
      character(len=*), intent(in) :: words(:)
      !> The row
      character(len=:), allocatable :: text

      integer :: k

      text = trim(words(1))
      do k = 2, size(words)
         text = text//' '//trim(words(k))
      end do
   end function list_of

end module axijoint_compare_read_column_card
