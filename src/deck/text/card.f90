!> A card divided into its fields
module axijoint_deck_text_card
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_decimal_comma, only : has_decimal_comma, report_decimal_comma, may_be_one_number, &
      warn_of_decimal_comma
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, count_again
   use axijoint_deck_text_field, only : field_type, kind_text
   use axijoint_deck_text_foreign, only : comment_mark, trailing_comment
   use axijoint_deck_text_section, only : card_width, free_width
   use axijoint_deck_text_source, only : source_type, card_content, tab
   use axijoint_deck_text_strange_byte, only : has_strange_byte, report_strange_byte
   implicit none
   private
   public :: slot_type, divide_card

   !> Where the value of a field stands on a card
   type :: slot_type
      !> Columns to point at: the field of a fixed card, the value of a free one
      integer :: first = 0, last = 0
      !> Columns of the value; from > to if it is blank
      integer :: from = 1, to = 0
      !> Whether the value can be read; not if it runs across columns
      logical :: whole = .true.
   end type slot_type

contains

   !> Find the values of the fields of a card, and report what belongs to none
   subroutine divide_card(source, card, fields, slots, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The card
      integer, intent(in) :: card
      !> Fields that it may have, by columns
      type(field_type), intent(in) :: fields(:)
      !> Place of each field, same shape
      type(slot_type), intent(out) :: slots(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: content
      logical :: free, cut
      integer :: width

      content = card_content(source, card)
      call cut_comment(card, content, fields, diagnostics)
      free = index(content, ',') > 0
      if (has_strange_byte(content, free)) then
         slots = slot_type(1, len(content), 1, 0, .false.)
         call report_strange_byte(diagnostics, card, content, free)
         return
      end if
      width = merge(free_width, card_width, free)
      cut = len(content) > width
      if (cut) then
         call add_error(diagnostics, card, width + 1, len(content), &
                        'there is text beyond column '//to_text(width), &
                        found=trim(adjustl(content(width + 1:))), &
                        mend='shorten the card; a comment begins with !')
         content = content(:len_trim(content(:width)))
      end if
      if (has_decimal_comma(content, fields)) then
         slots = slot_type(1, len(content), 1, 0, .false.)
         call report_decimal_comma(diagnostics, card, content)
      else if (fields(1)%kind == kind_text .and. .not. free) then
         call divide_keyword(card, content, fields, slots, diagnostics)
      else if (free) then
         if (may_be_one_number(content, fields)) call warn_of_decimal_comma(diagnostics, card, content)
         call divide_free(card, content, fields, slots, diagnostics)
      else
         call divide_fixed(card, content, fields, slots, diagnostics)
      end if
      ! what would be there stands in the text that was cut off, in part or as a whole
      if (cut .and. free) where (slots%last >= len(content)) slots%whole = .false.
   end subroutine divide_card

   !> Report a comment of another program behind the values, and cut it off. A text may hold
   !> its mark
   subroutine cut_comment(card, content, fields, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=:), allocatable, intent(inout) :: content
      !> Fields
      type(field_type), intent(in) :: fields(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=*), parameter :: comment_fault = 'a comment begins with !, not with '
      character(len=:), allocatable :: mark
      integer :: first
      logical :: told

      first = trailing_comment(content)
      if (first == 0 .or. any(fields%kind == kind_text)) return
      mark = comment_mark(content(first:))
      call count_again(diagnostics, comment_fault//mark, told)
      if (.not. told) call add_error(diagnostics, card, first, len(content), &
                     comment_fault//mark, found=content(first:), &
                     mend='write ! in its place')
      content = content(:len_trim(content(:first - 1)))
   end subroutine cut_comment

   !> Divide a card at its commas
   subroutine divide_free(card, content, fields, slots, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Fields
      type(field_type), intent(in) :: fields(:)
      !> Place of each field
      type(slot_type), intent(out) :: slots(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: field, first, last, from, to

      slots%first = len(content) + 1
      slots%last = len(content) + 1
      field = 0
      first = 1
      do while (first <= len(content) + 1)
         field = field + 1
         last = first - 2 + index(content(first:)//',', ',')
         from = first - 1 + verify(content(first:last)//'.', ' '//tab)
         to = first - 1 + verify(content(first:last), ' '//tab, back=.true.)
         if (field <= size(fields)) then
            slots(field) = slot_type(first, max(first, last), from, to)
            if (to >= from) slots(field) = one_value(card, content, fields(field), &
                                                     slot_type(from, to, from, to), diagnostics)
         else if (to >= from) then
            call add_error(diagnostics, card, from, len(content), 'the card has too many values', &
                           found=content(from:), &
                           allowed=to_text(size(fields))//' values, separated by commas', &
                           mend='decimals are written with a point; comments begin with !')
            return
         end if
         first = last + 2
      end do
   end subroutine divide_free

   !> A value without blanks inside, or marked and reported; a text may have blanks
   function one_value(card, content, field, slot, diagnostics) result(checked)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> The field
      type(field_type), intent(in) :: field
      !> Its place
      type(slot_type), intent(in) :: slot
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> The place, not whole if there are blanks inside
      type(slot_type) :: checked

      checked = slot
      if (field%kind == kind_text .or. scan(content(slot%from:slot%to), ' '//tab) == 0) return
      checked%whole = .false.
      call add_error(diagnostics, card, slot%first, slot%last, &
                     trim(field%name)//' has a blank inside', &
                     found=content(slot%from:slot%to), allowed='one value without blanks')
   end function one_value

   !> Divide a fixed keyword card: the keyword, and the number of entries in its columns.
   !> Anything else is reported as one text
   subroutine divide_keyword(card, content, fields, slots, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment, the keyword from column 1
      character(len=*), intent(in) :: content
      !> The keyword and, where entries are counted, their number
      type(field_type), intent(in) :: fields(:)
      !> Place of each field
      type(slot_type), intent(out) :: slots(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: mend
      integer :: first, last

      slots%first = fields%first
      slots%last = fields%last
      mend = 'nothing follows this keyword on its card; comments begin with !'
      last = scan(content//' ', ' ') - 1
      slots(1)%to = last
      first = last + verify(content(last + 1:)//'.', ' ')
      if (size(fields) > 1) then
         associate (count_field => fields(2), slot => slots(2))
            mend = 'the number of entries goes in columns '//to_text(count_field%first)//' to '// &
                   to_text(count_field%last)//'; comments begin with !'
            last = first - 2 + scan(content(first:)//' ', ' ')
            if (first >= count_field%first .and. last <= count_field%last .and. &
                scan(content(first:min(first, len(content))), '+-.0123456789') == 1) then
               slot%from = first
               slot%to = last
               first = last + verify(content(last + 1:)//'.', ' ')
            end if
         end associate
      end if
      if (first <= len(content)) then
         call add_error(diagnostics, card, first, len(content), &
            'there is text behind the keyword', &
                        found=content(first:), mend=mend)
      end if
   end subroutine divide_keyword

   !> Divide a card by its columns
   subroutine divide_fixed(card, content, fields, slots, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Fields, side by side
      type(field_type), intent(in) :: fields(:)
      !> Place of each field
      type(slot_type), intent(out) :: slots(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, first, last

      do i = 1, size(fields)
         slots(i)%first = fields(i)%first
         slots(i)%last = fields(i)%last
      end do
      first = 1
      do while (first <= len(content))
         first = first - 1 + verify(content(first:)//'.', ' ')
         if (first > len(content)) exit
         if (first > fields(size(fields))%last) then
            call add_error(diagnostics, card, first, len(content), &
               'there is text behind the last field', &
                           found=content(first:), &
                           mend='a comment begins with !; see the columns of this section')
            exit
         end if
         last = first - 2 + scan(content(first:)//' ', ' ')
         call place_run(card, content, fields, first, last, slots, diagnostics)
         first = last + 1
      end do
      do i = 1, size(fields)
         if (slots(i)%to < slots(i)%from .or. .not. slots(i)%whole) cycle
         slots(i) = one_value(card, content, fields(i), slots(i), diagnostics)
      end do
   end subroutine divide_fixed

   !> Give characters without a blank between them to the field that they are in
   subroutine place_run(card, content, fields, first, last, slots, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Fields, side by side
      type(field_type), intent(in) :: fields(:)
      !> Columns of the characters, the first of which is in a field
      integer, intent(in) :: first, last
      !> Place of each field
      type(slot_type), intent(inout) :: slots(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, k

      i = count(fields%last < first) + 1  ! field of the first character
      k = count(fields%first <= last)     ! field of the last character
      if (i < k .or. last > fields(size(fields))%last) then
         slots(i:k)%whole = .false.
         call report_crossing(card, content(first:last), fields(i:k), first, last, &
                              i == 1 .and. trim(adjustl(content)) == content(first:last), diagnostics)
      else
         if (slots(i)%to < slots(i)%from) slots(i)%from = first
         slots(i)%to = last
      end if
   end subroutine place_run

   !> Report a value that runs across the end of a field
   subroutine report_crossing(card, value, fields, first, last, alone, diagnostics)
      !> The card
      integer, intent(in) :: card
      !> The value
      character(len=*), intent(in) :: value
      !> Fields that it touches
      type(field_type), intent(in) :: fields(:)
      !> Its columns
      integer, intent(in) :: first, last
      !> Whether it begins in the first field and no other value is on the card
      logical, intent(in) :: alone
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: columns, mend
      integer :: i

      mend = 'keep a blank between the values, or separate them by commas'
      if (alone) mend = 'if it is one value, write a comma behind it: then it may have as many digits as it takes'
      if (index(value, '**') > 0) then
         mend = 'the program that wrote the asterisks had too few columns: put the number in'
      end if
      columns = ''
      do i = 1, size(fields)
         if (i > 1) columns = columns//'; '
         columns = columns//trim(fields(i)%name)//' in columns '//to_text(fields(i)%first)//' to ' &
                   //to_text(fields(i)%last)
      end do
      call add_error(diagnostics, card, first, last, 'the value runs across the end of a field', &
                     found=value, allowed=columns, mend=mend)
   end subroutine report_crossing

end module axijoint_deck_text_card
