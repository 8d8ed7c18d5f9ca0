!> A cell of a study's table: a value, a list, a range, a distribution, or nothing
module axijoint_study_cell
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, upper
   use axijoint_deck_text_field, only : field_type, allowed_text, in_range, kind_real, &
      kind_integer
   use axijoint_deck_text_table, only : read_value
   use axijoint_deck_text_token, only : read_integer, read_real, token_good
   use axijoint_study_draw, only : distribution_names, distribution_uniform, &
      distribution_truncated, distribution_lognormal, distribution_weibull, n_parameters
   implicit none
   private
   public :: cell_type, read_cell

   !> Most values of a range
   integer, parameter :: most_values = 1000000
   !> How far the last value of a range may be beyond its end, in steps
   real(wp), parameter :: slack = 1.0e-9_wp

   !> A cell
   type :: cell_type
      !> Its values: none if it is blank, and the deck's value stays
      real(wp), allocatable :: values(:)
      !> One of the `distribution_` parameters, 0 if it has values; its numbers
      integer :: distribution = 0
      real(wp) :: parameters(maxval(n_parameters)) = 0.0_wp
      !> What is wrong with it, and how to mend it; empty if nothing is
      character(len=:), allocatable :: fault, allowed, mend
   end type cell_type

contains

   !> Read a cell
   subroutine read_cell(field, text, cell)
      !> The field of the card that its values are for
      type(field_type), intent(in) :: field
      !> What stands in it, without blanks at its ends
      character(len=*), intent(in) :: text
      !> The cell
      type(cell_type), intent(out) :: cell

      integer :: first, last, kind

      allocate (cell%values(0))
      cell%fault = ''
      cell%allowed = allowed_text(field)
      cell%mend = ''
      if (len(text) == 0) return
      kind = findloc(distribution_names, upper(first_word(text)), 1)
      if (kind > 0) then
         call read_distribution(field, text(len(first_word(text)) + 1:), kind, cell)
         return
      end if
      first = 1
      do while (first <= len(text) + 1 .and. len(cell%fault) == 0)
         last = index(text(first:)//';', ';') + first - 2
         call read_part(field, trim(adjustl(text(first:last))), cell)
         first = last + 2
      end do
   end subroutine read_cell

   !> Read a value or a range
   subroutine read_part(field, text, cell)
      !> The field
      type(field_type), intent(in) :: field
      !> The text
      character(len=*), intent(in) :: text
      !> Takes the values
      type(cell_type), intent(inout) :: cell

      real(wp) :: value

      if (scan(text, ':') > 0 .and. any(field%kind == [kind_real, kind_integer])) then
         call read_range(field, text, cell)
         return
      else if (len(text) == 0) then
         cell%fault = 'a value of the list is blank'
         return
      end if
      deallocate (cell%fault, cell%mend)
      call read_value(field, text, value, cell%fault, cell%mend)
      if (len(cell%fault) > 0) then
         cell%fault = trim(field%name)//' '//cell%fault
      else
         cell%values = [cell%values, value]
      end if
   end subroutine read_part

   !> Read `first : last : step` or `first : last / number of values`
   subroutine read_range(field, text, cell)
      !> The field
      type(field_type), intent(in) :: field
      !> The text
      character(len=*), intent(in) :: text
      !> Takes the values
      type(cell_type), intent(inout) :: cell

      character(len=*), parameter :: forms = &
         'a range is FIRST : LAST : STEP, or FIRST : LAST / '// &
         'NUMBER OF VALUES'
      real(wp) :: first, last, step
      integer :: colon, mark, n, i, code(3)

      colon = index(text, ':')
      mark = scan(text(colon + 1:), ':/') + colon
      code = token_good + 1
      n = 0
      call read_real(squeezed(text(:colon - 1)), first, code(1))
      if (mark > colon) then
         call read_real(squeezed(text(colon + 1:mark - 1)), last, code(2))
         if (text(mark:mark) == ':') then
            call read_real(squeezed(text(mark + 1:)), step, code(3))
         else
            call read_integer(squeezed(text(mark + 1:)), n, code(3))
         end if
      end if
      if (any(code /= token_good)) then
         cell%fault = 'the range is not complete, or not of numbers'
         cell%allowed = forms
         return
      end if
      if (text(mark:mark) == ':') then
         if (.not. (last - first)*step > 0.0_wp) then
            cell%fault = 'the step does not lead from the first value to the last'
            cell%allowed = forms
            return
         end if
         if ((last - first)/step < most_values) n = int((last - first)/step + slack) + 1
      else
         step = 0.0_wp
         if (n > 1) step = (last - first)/(n - 1)
      end if
      if (n < 1 .or. n > most_values) then
         cell%fault = 'a range has from 1 to '//to_text(most_values)//' values'
         cell%allowed = forms
         return
      end if
      associate (values => [(first + (i - 1)*step, i=1, n)])
         if (.not. (in_range(field, minval(values)) .and. in_range(field, maxval(values)))) then
            cell%fault = trim(field%name)//' leaves its range'
         else if (field%kind == kind_integer .and. any(abs(values - anint(values)) > 0.0_wp)) then
            cell%fault = trim(field%name)//' is an integer'
         else
            cell%values = [cell%values, values]
         end if
      end associate
   end subroutine read_range

   !> Read the numbers of a distribution
   subroutine read_distribution(field, text, kind, cell)
      !> The field
      type(field_type), intent(in) :: field
      !> What follows the name
      character(len=*), intent(in) :: text
      !> The distribution
      integer, intent(in) :: kind
      !> Takes the numbers
      type(cell_type), intent(inout) :: cell

      character(len=:), allocatable :: rest, word
      integer :: n, code

      cell%allowed = 'UNIFORM low high; NORMAL mean deviation; LOGNORMAL mean deviation; '// &
         'WEIBULL shape scale least; TRUNCATED mean deviation low high'
      if (field%kind /= kind_real) then
         cell%fault = trim(field%name)//' is no real: it cannot be drawn'
         return
      end if
      rest = trim(adjustl(text))
      n = 0
      do while (len(rest) > 0)
         word = first_word(rest)
         rest = trim(adjustl(rest(len(word) + 1:)))
         n = n + 1
         if (n > n_parameters(kind)) exit
         call read_real(word, cell%parameters(n), code)
         if (code /= token_good) cell%fault = word//' is not a number'
      end do
      if (len(cell%fault) > 0) return
      associate (p => cell%parameters)
         if (n /= n_parameters(kind)) then
            cell%fault = trim(distribution_names(kind))//' takes '// &
               to_text(n_parameters(kind))//' numbers'
         else if (kind == distribution_uniform .and. .not. p(2) > p(1) .or. &
                  kind == distribution_truncated .and. .not. p(4) > p(3)) then
            cell%fault = 'the upper end is not above the lower'
         else if (kind /= distribution_uniform .and. .not. p(2) > 0.0_wp) then
            cell%fault = 'the deviation, or scale, is not above zero'
         else if (any(kind == [distribution_lognormal, distribution_weibull]) &
                  .and. .not. p(1) > 0.0_wp) then
            cell%fault = 'the mean, or shape, is not above zero'
         else
            cell%distribution = kind
         end if
      end associate
   end subroutine read_distribution

   !> The first word of a text
   pure function first_word(text) result(word)
      !> The text; begins with no blank
      character(len=*), intent(in) :: text
      !> The word
      character(len=:), allocatable :: word

      word = text(:index(text//' ', ' ') - 1)
   end function first_word

   !> A text without the blanks at its ends; not empty, so that it can be judged
   pure function squeezed(text) result(word)
      !> The text
      character(len=*), intent(in) :: text
      !> The word
      character(len=:), allocatable :: word

      word = trim(adjustl(text))
      if (len(word) == 0) word = '?'
   end function squeezed

end module axijoint_study_cell
