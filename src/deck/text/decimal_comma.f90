!> Commas that were meant as decimal points, where commas separate values
module axijoint_deck_text_decimal_comma
   use axijoint_base_kinds, only : wp
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_deck_text_field, only : field_type, kind_real
   use axijoint_deck_text_source, only : tab
   use axijoint_deck_text_token, only : read_real, token_good
   implicit none
   private
   public :: has_decimal_comma, report_decimal_comma, may_be_one_number, warn_of_decimal_comma

   !> What separates the values of a card with decimal commas
   character(len=*), parameter :: blanks = ' '//tab
   !> Digits
   character(len=*), parameter :: digits = '0123456789'

contains

   !> Whether a card cannot be divided at its commas, but has as many values as it may have
   !> if they are separated by blanks and each comma between digits is a decimal comma
   pure logical function has_decimal_comma(content, fields)
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Fields that it may have
      type(field_type), intent(in) :: fields(:)

      integer :: first, last, n_values, n_commas
      logical :: blank_inside, plain

      has_decimal_comma = .false.
      n_values = 0
      n_commas = 0
      blank_inside = .false.
      last = 0
      do
         call next_value(content, first, last, plain)
         if (first > len(content)) exit
         if (n_values > 0) blank_inside = blank_inside .or. .not. after_comma(content, first)
         n_values = n_values + 1
         if (plain) cycle
         n_commas = n_commas + 1
         if (decimal_place(content(first:last)) == 0) return
      end do
      if (n_commas == 0) return
      if (n_values < count(fields%required) .or. n_values > size(fields)) return
      has_decimal_comma = blank_inside .or. count_commas(content) >= size(fields)
      if (n_values == 1) has_decimal_comma = .false.  ! two values is as likely
   end function has_decimal_comma

   !> Whether a card is digits, a comma and digits without a blank, two values as it stands, which may have been meant as one
   !> number: the card may have a real and nothing else
   pure logical function may_be_one_number(content, fields)
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Fields that it may have
      type(field_type), intent(in) :: fields(:)

      may_be_one_number = .false.
      if (fields(1)%kind /= kind_real .or. size(fields) == 1 .or. any(fields(2:)%required)) return
      may_be_one_number = decimal_place(trim(adjustl(content))) > 0
   end function may_be_one_number

   !> Warn of a card that may have been meant as one number
   subroutine warn_of_decimal_comma(diagnostics, card, content)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content

      integer :: first, last, comma

      first = verify(content, blanks)
      last = len_trim(content)
      comma = index(content, ',')
      call add_warning(diagnostics, card, first, last, &
         'a comma separates values, so these are two; they look like one number with a decimal comma', &
         found=content(first:last), mend='one number has a decimal point: '//content(first:comma - 1)//'.'// &
         content(comma + 1:last)//'; two have a blank behind the comma: '//content(first:comma)//' '// &
         content(comma + 1:last))
   end subroutine warn_of_decimal_comma

   !> Report the first decimal comma of a card
   subroutine report_decimal_comma(diagnostics, card, content)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> The card
      integer, intent(in) :: card
      !> The card without its comment; it has a decimal comma
      character(len=*), intent(in) :: content

      integer :: first, last, comma
      logical :: plain

      last = 0
      plain = .true.
      do while (plain)
         call next_value(content, first, last, plain)
      end do
      comma = first - 1 + decimal_place(content(first:last))
      call add_error(diagnostics, card, first, last, &
                     'a comma separates two values, but this one looks like a decimal comma', &
                     found=content(first:last), &
                     mend='write a decimal point: '//content(first:comma - 1)//'.'// &
                     content(comma + 1:last))
   end subroutine report_decimal_comma

   !> Next value of a card if blanks separate the values; a comma at its end is no part of it
   pure subroutine next_value(content, first, last, plain)
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> First column of the value; beyond the card if there is no more
      integer, intent(out) :: first
      !> Last column of the value before, on return that of this one
      integer, intent(inout) :: last
      !> Whether it has no comma inside
      logical, intent(out) :: plain

      first = last + verify(content(last + 1:)//'.', blanks//',')
      last = first - 2 + scan(content(first:)//' ', blanks)
      plain = .true.
      if (first > len(content)) return
      if (content(last:last) == ',') last = last - 1
      plain = index(content(first:last), ',') == 0
   end subroutine next_value

   !> Place of the comma of a number with one decimal comma, digits on both sides of it;
   !> 0 if the text is none
   pure integer function decimal_place(value) result(comma)
      !> The text
      character(len=*), intent(in) :: value

      real(wp) :: number
      integer :: fault

      comma = index(value, ',')
      if (comma <= 1 .or. comma == len(value)) then
         comma = 0
      else if (scan(value(comma - 1:comma - 1), digits) == 0 .or. &
               scan(value(comma + 1:comma + 1), digits) == 0) then
         comma = 0
      else
         call read_real(value(:comma - 1)//'.'//value(comma + 1:), number, fault)
         if (fault /= token_good) comma = 0
      end if
   end function decimal_place

   !> Whether there is a comma between a value and the one before it
   pure logical function after_comma(content, first)
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> First column of the value, which is not the card's first value
      integer, intent(in) :: first

      integer :: last

      last = verify(content(:first - 1), blanks, back=.true.)
      after_comma = content(last:last) == ','
   end function after_comma

   !> Number of commas before the last value
   pure integer function count_commas(content) result(n)
      !> The card without its comment
      character(len=*), intent(in) :: content

      integer :: i

      n = count([(content(i:i) == ',', i=1, verify(content, blanks//',', back=.true.))])
   end function count_commas

end module axijoint_deck_text_decimal_comma
