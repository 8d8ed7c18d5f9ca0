!> What may stand in a field of a card
module axijoint_deck_text_field
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   implicit none
   private
   public :: field_type, integer_field, with_symbol, real_field, word_field, code_field, text_field, described
   public :: allowed_text, in_range
   public :: kind_integer, kind_real, kind_word, kind_code, kind_text
   public :: largest_number, largest_real, smallest_real

   !> Integer
   integer, parameter :: kind_integer = 1
   !> Real
   integer, parameter :: kind_real = 2
   !> One of some words; its value is the word's place among them
   integer, parameter :: kind_word = 3
   !> Three digits 0 or 1; its value is the digits read as a binary number
   integer, parameter :: kind_code = 4

   !> Any text; it has no value
   integer, parameter :: kind_text = 5

   !> Largest number of a node, an element, a material ...
   integer, parameter :: largest_number = 999999999
   !> Reals of larger or, unless 0, smaller magnitude are refused: powers and
   !> quotients of them would leave the range of the machine
   real(wp), parameter :: largest_real = 1.0e30_wp, smallest_real = 1.0e-30_wp

   !> Columns of a field for a real
   integer, parameter :: real_width = 10

   !> Most words to choose from, and letters of the longest
   integer, parameter :: most_words = 40, word_length = 12

   !> One field of the cards of a section
   type :: field_type
      !> Name in messages
      character(len=40) :: name = ''
      !> What it means, with its unit, for those who write cards; the name without its article if
      !> blank
      character(len=240) :: meaning = ''
      !> What a blank field means, and what is allowed, for them, too; told by the values if blank
      character(len=80) :: blank = ''
      character(len=100) :: limits = ''
      !> Whether it is told of together with the field before it
      logical :: joined = .false.
      !> What it is the number of, as far as others need to know: node, face, shape
      character(len=8) :: refers_to = ''
      !> Card of an entry that has the field, if an entry has several
      integer :: card = 1
      !> First and last column on a fixed card
      integer :: first = 0, last = 0
      !> One of the `kind_` parameters
      integer :: kind = kind_integer
      !> Whether the field must not be blank
      logical :: required = .true.
      !> Value of a blank field
      real(wp) :: default = 0.0_wp
      !> Range of values
      real(wp) :: low = 0.0_wp, high = 0.0_wp
      !> Whether the ends of the range are outside
      logical :: above_low = .false., below_high = .false.
      !> Words to choose from
      character(len=word_length) :: words(most_words) = ''
      !> Symbol of a real in the text of its range
      character(len=12) :: symbol = 'x'
   end type field_type

   !> Fields with what those who write cards are told of them
   interface described
      module procedure described_field
      module procedure described_row
   end interface described

contains

   !> An integer field
   pure function integer_field(name, first, last, low, high, default) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> Columns
      integer, intent(in) :: first, last
      !> Range
      integer, intent(in) :: low, high
      !> Value of a blank field; without it the field is required
      integer, intent(in), optional :: default
      !> The field
      type(field_type) :: field

      field%name = name
      field%first = first
      field%last = last
      field%kind = kind_integer
      field%low = real(low, wp)
      field%high = real(high, wp)
      field%required = .not. present(default)
      if (present(default)) field%default = real(default, wp)
   end function integer_field

   !> A field with a symbol
   pure function with_symbol(field, symbol) result(named)
      !> The field
      type(field_type), intent(in) :: field
      !> Its symbol
      character(len=*), intent(in) :: symbol
      !> The same with it
      type(field_type) :: named

      named = field
      named%symbol = symbol
   end function with_symbol

   !> A real field, of 10 columns
   pure function real_field(name, first, from, above, to, below, default, symbol) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> Lower end of the range: allowed (from) or not (above)
      real(wp), intent(in), optional :: from, above
      !> Upper end of the range: allowed (to) or not (below)
      real(wp), intent(in), optional :: to, below
      !> Value of a blank field; without it the field is required
      real(wp), intent(in), optional :: default
      !> Symbol in the text of the range
      character(len=*), intent(in), optional :: symbol
      !> The field
      type(field_type) :: field

      field%name = name
      field%first = first
      field%last = first + real_width - 1
      field%kind = kind_real
      field%low = -largest_real
      field%high = largest_real
      if (present(from)) field%low = from
      if (present(above)) field%low = above
      if (present(to)) field%high = to
      if (present(below)) field%high = below
      field%above_low = present(above)
      field%below_high = present(below)
      if (present(symbol)) field%symbol = symbol
      field%required = .not. present(default)
      if (present(default)) field%default = default
   end function real_field

   !> A field for one of some words
   pure function word_field(name, first, last, words, default) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> Columns
      integer, intent(in) :: first, last
      !> The words, `most_words` at most; more would be a fault of the program
      character(len=*), intent(in) :: words(:)
      !> Place of the word that a blank field means; without it the field is required
      integer, intent(in), optional :: default
      !> The field
      type(field_type) :: field

      field%name = name
      field%first = first
      field%last = last
      field%kind = kind_word
      if (size(words) > most_words .or. any(len_trim(words) > word_length)) &
         error stop 'word_field: more or longer words than a field holds'
      field%words(:size(words)) = words
      field%required = .not. present(default)
      if (present(default)) field%default = real(default, wp)
   end function word_field

   !> A field for a code of three digits
   pure function code_field(name, first, last) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> Columns
      integer, intent(in) :: first, last
      !> The field
      type(field_type) :: field

      field%name = name
      field%first = first
      field%last = last
      field%kind = kind_code
   end function code_field

   !> A field for any text
   pure function text_field(name, first, last) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> Columns
      integer, intent(in) :: first, last
      !> The field
      type(field_type) :: field

      field%name = name
      field%first = first
      field%last = last
      field%kind = kind_text
   end function text_field

   !> A field with what those who write cards are told of it
   pure function described_field(field, meaning, blank, limits) result(new)
      !> The field
      type(field_type), intent(in) :: field
      !> What it means, with its unit
      character(len=*), intent(in) :: meaning
      !> What a blank one means; what is allowed
      character(len=*), intent(in), optional :: blank, limits
      !> The same with these
      type(field_type) :: new

      new = field
      call put(meaning, new%meaning)
      if (present(blank)) call put(blank, new%blank)
      if (present(limits)) call put(limits, new%limits)
   end function described_field

   !> Put a text where it has room
   pure subroutine put(text, room)
      !> The text
      character(len=*), intent(in) :: text
      !> Takes it
      character(len=*), intent(out) :: room

      if (len(text) > len(room)) error stop 'described: a text longer than a field holds'
      room = text
   end subroutine put

   !> Fields one after another that are told of together
   pure function described_row(fields, meaning, blank, limits) result(new)
      !> The fields
      type(field_type), intent(in) :: fields(:)
      !> What they mean, with their unit
      character(len=*), intent(in) :: meaning
      !> What a blank one means; what is allowed
      character(len=*), intent(in), optional :: blank, limits
      !> The same with these
      type(field_type) :: new(size(fields))

      new = fields
      new(1) = described_field(fields(1), meaning, blank, limits)
      new(2:)%joined = .true.
   end function described_row

   !> Whether a value is in a field's range
   pure logical function in_range(field, value)
      !> The field
      type(field_type), intent(in) :: field
      !> The value
      real(wp), intent(in) :: value

      in_range = value >= field%low .and. value <= field%high
      if (field%above_low) in_range = in_range .and. value > field%low
      if (field%below_high) in_range = in_range .and. value < field%high
   end function in_range

   !> What may stand in a field, for messages
   pure function allowed_text(field) result(text)
      !> The field
      type(field_type), intent(in) :: field
      !> The text
      character(len=:), allocatable :: text

      integer :: i

      select case (field%kind)
      case (kind_integer)
         text = 'an integer, '//to_text(nint(field%low))//' to '//to_text(nint(field%high))
      case (kind_real)
         text = range_text(field)
      case (kind_word)
         text = trim(field%words(1))
         do i = 2, count(field%words /= '')
            text = text//merge(', ', '  ', i < count(field%words /= ''))
            if (i == count(field%words /= '')) text = trim(text)//' or '
            text = text//trim(field%words(i))
         end do
      case (kind_text)
         text = 'a text'
      case default
         text = 'three digits 0 (free) or 1 (fixed) for u, v and w, such as 110'
      end select
      if (.not. field%required) text = text//'; may be blank'
   end function allowed_text

   !> Range of a real field as an inequality, such as 0 <= nu < 0.5
   pure function range_text(field) result(text)
      !> The field
      type(field_type), intent(in) :: field
      !> The text
      character(len=:), allocatable :: text

      logical :: has_low, has_high

      has_low = field%low > -largest_real
      has_high = field%high < largest_real
      text = trim(field%symbol)
      if (has_low .and. has_high) then
         text = to_text(field%low)//' '//trim(merge('< ', '<=', field%above_low))//' '//text
      else if (has_low) then
         text = text//' '//trim(merge('> ', '>=', field%above_low))//' '//to_text(field%low)
      else if (.not. has_high) then
         text = 'any number'
      end if
      if (has_high) then
         text = text//' '//trim(merge('< ', '<=', field%below_high))//' '//to_text(field%high)
      end if
   end function range_text

end module axijoint_deck_text_field
