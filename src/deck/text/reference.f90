!> What cards look like, told to those who write them: an index of sections, the fields of each, as
!> plain text and as the tables of the manual
module axijoint_deck_text_reference
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_field, only : field_type, kind_integer, kind_real, kind_word, kind_code, &
      kind_text, largest_number, largest_real
   use axijoint_deck_text_section, only : section_type, cards_per_entry, ordinal, cardinal, &
      form_entries, form_end
   implicit none
   private
   public :: index_text, index_table, section_text, section_table, meaning, default, allowed

   !> End of a line; a dash and an ellipsis between numbers; a minus
   character(len=1), parameter :: nl = new_line('a')
   character(len=*), parameter :: dash = '–', to = ' … ', minus = '−'
   !> Letters of a line of plain text
   integer, parameter :: line_length = 80

contains

   !> All sections, a line each
   pure function index_text(sections) result(text)
      !> The sections
      type(section_type), intent(in) :: sections(:)
      !> The lines
      character(len=:), allocatable :: text

      integer :: k

      text = 'The cards of a deck; axijoint help card NAME tells the fields of one:'//nl
      do k = 1, size(sections)
         text = text//nl//'  '//sections(k)%name//'  '//trim(sections(k)%purpose)
      end do
   end function index_text

   !> The same as a table
   pure function index_table(sections) result(text)
      !> The sections
      type(section_type), intent(in) :: sections(:)
      !> The lines
      character(len=:), allocatable :: text

      integer :: k

      text = '| card | what it is for | how often |'//nl//'|---|---|---|'
      do k = 1, size(sections)
         text = text//nl//'| '//trim(sections(k)%name)//' | '//trim(sections(k)%purpose)//' | '// &
                how_often(sections(k))//' |'
      end do
   end function index_table

   !> How often a section is there, and of how many cards
   pure function how_often(section) result(text)
      !> The section
      type(section_type), intent(in) :: section
      !> In words
      character(len=:), allocatable :: text

      text = 'any number'
      if (section%once) text = 'once at most'
      if (section%required) text = 'once, required'
      if (section%form == form_end) text = 'once a file, required'
      if (cards_per_entry(section) > 1) text = text//'; '//cardinal(cards_per_entry(section))// &
         ' cards an entry'
   end function how_often

   !> A section and its fields as plain text
   pure function section_text(section) result(text)
      !> The section
      type(section_type), intent(in) :: section
      !> The lines
      character(len=:), allocatable :: text

      character(len=:), allocatable :: notes
      integer :: i, last, indent

      text = wrapped(trim(section%name)//': '//trim(section%purpose)//' ('//how_often(section)// &
         ')', 2)
      if (section%form == form_entries) text = text//nl
      indent = 0
      do i = 1, size(section%fields)
         indent = max(indent, 4 + letters_of(columns(section, i, last_joined(section%fields, i))))
      end do
      last = 0
      do while (last < size(section%fields))
         i = last + 1
         last = last_joined(section%fields, i)
         associate (row => section%fields(i:last))
            text = text//nl//padded('  '//columns(section, i, last), indent)// &
               wrapped(meaning(row(1)), indent)
            notes = ''
            if (len(default(row(1))) > 0) notes = 'if blank: '//default(row(1))
            if (len(notes) > 0 .and. len(allowed(row(1))) > 0) notes = notes//'; '
            if (len(allowed(row(1))) > 0) notes = notes//'allowed: '//allowed(row(1))
            if (len(notes) > 0) text = text//nl//repeat(' ', indent)//wrapped(notes, indent)
         end associate
      end do
      if (section%form == form_entries) text = text//nl//nl// &
         'A: text, F: real, I: integer. On a card with commas the fields stand in the same'//nl// &
         'order. More: doc/deck.md'
   end function section_text

   !> The fields of a section as a table; empty if it has none
   pure function section_table(section) result(text)
      !> The section
      type(section_type), intent(in) :: section
      !> The lines
      character(len=:), allocatable :: text

      integer :: i, last

      text = ''
      if (size(section%fields) == 0) return
      text = '| '//trim(section%name)//', columns | field | default | allowed |'//nl// &
         '|---|---|---|---|'
      last = 0
      do while (last < size(section%fields))
         i = last + 1
         last = last_joined(section%fields, i)
         associate (first => section%fields(i))
            text = text//nl//'|'//cell(columns(section, i, last))//cell(meaning(first))// &
               cell(default(first))// &
                   cell(allowed(first))
         end associate
      end do
   end function section_table

   !> A cell of a table
   pure function cell(content) result(text)
      !> What stands in it
      character(len=*), intent(in) :: content
      !> The cell with the bar behind it
      character(len=:), allocatable :: text

      text = ' '//content//' |'
      if (len(content) == 0) text = ' |'
   end function cell

   !> Last of the fields that are told of together
   pure integer function last_joined(fields, first) result(last)
      !> Fields of the section
      type(field_type), intent(in) :: fields(:)
      !> The first of them
      integer, intent(in) :: first

      do last = first, size(fields) - 1
         if (.not. fields(last + 1)%joined) return
      end do
      last = size(fields)
   end function last_joined

   !> Columns and format of fields that are told of together: "11–40 3F10"
   pure function columns(section, first, last) result(text)
      !> The section
      type(section_type), intent(in) :: section
      !> The first and the last of the fields
      integer, intent(in) :: first, last
      !> In words
      character(len=:), allocatable :: text

      character(len=1), parameter :: letters(kind_integer:kind_text) = ['I', 'F', 'A', 'A', 'A']
      integer :: width

      associate (row => section%fields(first:last))
         width = row(1)%last - row(1)%first + 1
         text = to_text(row(1)%first)//dash//to_text(row(size(row))%last)
         if (size(row) == 1) then
            text = text//' '//letters(row(1)%kind)
         else if (all(row%kind == row(1)%kind)) then
            text = text//' '//to_text(size(row))//letters(row(1)%kind)//to_text(width)
         end if
         if (cards_per_entry(section) == 1) return
         if (first > 1) then
            if (section%fields(first - 1)%card == row(1)%card) return
         end if
         text = ordinal(row(1)%card)//', '//text
      end associate
   end function columns

   !> What a field means
   pure function meaning(field) result(text)
      !> The field
      type(field_type), intent(in) :: field
      !> In words
      character(len=:), allocatable :: text

      text = trim(field%meaning)
      if (len(text) > 0) return
      text = trim(field%name)
      if (index(text, 'the ') == 1) text = text(5:)
   end function meaning

   !> What a blank field means; empty if it must not be blank
   pure function default(field) result(text)
      !> The field
      type(field_type), intent(in) :: field
      !> In words
      character(len=:), allocatable :: text

      text = trim(field%blank)
      if (len(text) > 0 .or. field%required) return
      select case (field%kind)
      case (kind_integer)
         text = to_text(nint(field%default))
      case (kind_real)
         text = number_text(field%default)
      case (kind_word)
         text = trim(field%words(nint(field%default)))
      end select
   end function default

   !> What may stand in a field
   pure function allowed(field) result(text)
      !> The field
      type(field_type), intent(in) :: field
      !> In words; empty if anything may that its format lets
      character(len=:), allocatable :: text

      integer :: k

      text = trim(field%limits)
      if (len(text) > 0) return
      select case (field%kind)
      case (kind_integer)
         if (nint(field%high) == largest_number) return
         text = to_text(nint(field%low))//to//to_text(nint(field%high))
         if (nint(field%high - field%low) == 1) text = to_text(nint(field%low))//', '// &
            to_text(nint(field%high))
      case (kind_real)
         text = range_of(field)
      case (kind_word)
         text = trim(field%words(1))
         do k = 2, count(field%words /= '')
            text = text//', '//trim(field%words(k))
         end do
      case (kind_code)
         text = '001'//to//'111'
      end select
   end function allowed

   !> Range of a real field; empty if it has no ends
   pure function range_of(field) result(text)
      !> The field
      type(field_type), intent(in) :: field
      !> In words
      character(len=:), allocatable :: text

      character(len=:), allocatable :: low, high
      logical :: has_low, has_high

      low = number_text(field%low)
      high = number_text(field%high)
      has_low = field%low > -largest_real
      has_high = field%high < largest_real
      text = ''
      if (has_low .and. has_high .and. .not. (field%above_low .or. field%below_high)) then
         text = low//to//high
      else if (has_low .and. has_high) then
         text = low//' '//less(field%above_low)//to//less(field%below_high)//' '//high
      else if (has_low) then
         text = '≥ '//low
         if (field%above_low) text = '> '//low
      else if (has_high) then
         text = less(field%below_high)//' '//high
      end if
   end function range_of

   !> The sign of what is less
   pure function less(strictly) result(text)
      !> Whether it must not be equal
      logical, intent(in) :: strictly
      !> The sign
      character(len=:), allocatable :: text

      text = '≤'
      if (strictly) text = '<'
   end function less

   !> A number with a proper minus
   pure function number_text(value) result(text)
      !> The number
      real(wp), intent(in) :: value
      !> In words
      character(len=:), allocatable :: text

      text = to_text(abs(value))
      if (value < 0.0_wp) text = minus//text
   end function number_text

   !> A text with blanks behind it up to a width
   pure function padded(text, width)
      !> The text
      character(len=*), intent(in) :: text
      !> Letters, not bytes
      integer, intent(in) :: width
      !> With at least one blank behind it
      character(len=:), allocatable :: padded

      padded = text//repeat(' ', max(1, width - letters_of(text)))
   end function padded

   !> A text in lines
   pure function wrapped(text, margin) result(lines)
      !> The text
      character(len=*), intent(in) :: text
      !> Blanks before all lines but the first
      integer, intent(in) :: margin
      !> The lines
      character(len=:), allocatable :: lines

      character(len=:), allocatable :: word
      integer :: from, to_byte, used

      lines = ''
      used = margin
      from = 1
      do while (from <= len(text))
         to_byte = from - 2 + index(text(from:)//' ', ' ')
         word = text(from:to_byte)
         if (used > margin .and. used + 1 + letters_of(word) > line_length) then
            lines = lines//nl//repeat(' ', margin)
            used = margin
         else if (used > margin) then
            lines = lines//' '
            used = used + 1
         end if
         lines = lines//word
         used = used + letters_of(word)
         from = to_byte + 2
      end do
   end function wrapped

   !> Number of letters of a text in UTF-8: bytes that do not continue one
   pure integer function letters_of(text)
      !> The text
      character(len=*), intent(in) :: text

      integer :: i

      letters_of = count([(iand(iachar(text(i:i)), 192) /= 128, i=1, len(text))])
   end function letters_of

end module axijoint_deck_text_reference
