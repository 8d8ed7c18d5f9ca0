!> Where the values of a card stand, by a Fortran format; the formats of one dialect of old decks
module axijoint_legacy_layout
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_text, only : lower, to_text
   use axijoint_deck_text_file_bytes, only : read_bytes, line_end, next_line
   implicit none
   private
   public :: place_type, dialect_type, places_of, read_dialect, n_cards

   !> Value of a card
   type :: place_type
      !> Its columns
      integer :: first = 0, last = 0
      !> Decimals that a real without a point is taken to have; negative for an integer
      integer :: decimals = -1
   end type place_type

   !> Cards of an old deck
   integer, parameter, public :: card_control = 1, card_element = 2, card_node = 3, &
      card_restraint = 4, card_material = 5, card_property = 6, card_loads = 7, card_point = 8, &
      card_gravity = 9, card_edges = 10, card_edge = 11, card_pressure = 12, card_increment = 13
   !> Their number
   integer, parameter :: n_cards = 13
   !> What they are called in a file of formats
   character(len=*), parameter, public :: card_names(n_cards) = [character(len=9) :: 'control', &
      'element', 'node', 'restraint', 'material', 'property', 'loads', 'point', 'gravity', &
      'edges', 'edge', 'pressure', 'increment']
   !> Formats of the plasticity program of Owen and Hinton, Finite Elements in Plasticity, 1980
   character(len=*), parameter :: book(n_cards) = [character(len=24) :: '11I5', '11I5', &
      'I5,6F10.5', '1X,I4,5X,I5,5X,5F10.6', 'I5', '8F10.5', '3I5', 'I5,2F10.3', '2F10.3', 'I5', &
      '4I5', '6F10.3', '2F10.5,3I5']

   !> Values that their formats have at least
   integer, parameter :: least(n_cards) = [11, 6, 3, 4, 1, 7, 3, 3, 2, 1, 3, 4, 5]
   !> What numbers of a format consist of
   character(len=*), parameter :: digits = '0123456789'

   !> Formats of a dialect
   type :: dialect_type
      !> One a card
      character(len=80) :: formats(n_cards) = [character(len=80) :: book]
   end type dialect_type

contains

   !> Places of the values that a format describes: nX, nIw, nFw.d, with commas between; E, D and G are read as F is
   pure subroutine places_of(format, places, fault)
      !> The format, in parentheses or not
      character(len=*), intent(in) :: format
      !> The places
      type(place_type), allocatable, intent(out) :: places(:)
      !> The descriptor that is none of these; empty if all are
      character(len=:), allocatable, intent(out) :: fault

      character(len=:), allocatable :: rest, word
      integer :: comma, column, count, width, decimals, i
      character :: kind
      logical :: good

      allocate (places(0))
      fault = ''
      rest = lower(trim(adjustl(format)))
      if (index(rest, '(') == 1 .and. index(rest, ')') == len(rest)) rest = rest(2:len(rest) - 1)
      rest = rest//','
      column = 0
      do while (len(rest) > 0)
         comma = index(rest, ',')
         word = trim(adjustl(rest(:comma - 1)))
         rest = rest(comma + 1:)
         call read_descriptor(word, count, kind, width, decimals, good)
         if (.not. good) then
            fault = word//' '
            return
         end if
         if (kind == 'x') then
            column = column + count
            cycle
         end if
         do i = 1, count
            places = [places, place_type(column + 1, column + width, decimals)]
            column = column + width
         end do
      end do
   end subroutine places_of

   !> A descriptor of a format
   pure subroutine read_descriptor(word, count, kind, width, decimals, good)
      !> It
      character(len=*), intent(in) :: word
      !> How often it is repeated
      integer, intent(out) :: count
      !> x, i or f
      character, intent(out) :: kind
      !> Columns, and decimals of a real; negative for an integer
      integer, intent(out) :: width, decimals
      !> Whether it is one
      logical, intent(out) :: good

      integer :: at, point

      count = 1
      width = 0
      decimals = -1
      kind = ' '
      at = verify(word, digits)
      good = at > 0
      if (.not. good) return
      if (at > 1) count = number(word(:at - 1))
      kind = word(at:at)
      select case (kind)
      case ('x')
         good = count > 0 .and. at == len(word)
      case ('i')
         width = number(word(at + 1:))
         good = count > 0 .and. width > 0
      case ('f', 'e', 'd', 'g')
         kind = 'f'
         point = index(word, '.')
         good = point > 0
         if (.not. good) return
         width = number(word(at + 1:point - 1))
         decimals = number(word(point + 1:))
         good = count > 0 .and. width > 0 .and. decimals >= 0
      case default
         good = .false.
      end select
   end subroutine read_descriptor

   !> A number of up to three digits; negative if it is none
   pure integer function number(word)
      !> Its digits
      character(len=*), intent(in) :: word

      integer :: k

      number = -1
      if (len(word) == 0 .or. len(word) > 3 .or. verify(word, digits) /= 0) return
      number = 0
      do k = 1, len(word)
         number = 10*number + index(digits, word(k:k)) - 1
      end do
   end function number

   !> Read a file of formats: lines such as `element  1X,I5,I9,6X,8I5`; cards that it does not name
   !> are as in the book, lines that begin with ! are comments
   subroutine read_dialect(path, dialect, error)
      !> The file
      character(len=*), intent(in) :: path
      !> The dialect
      type(dialect_type), intent(out) :: dialect
      !> A file or a line that cannot be read
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: bytes, failure, line, fault
      type(place_type), allocatable :: places(:)
      integer :: first, last, blank, card, row

      call read_bytes(path, bytes, failure)
      if (len(failure) > 0) then
         call fatal_error(error, exit_deck, 'the file of formats '//path//': '//failure)
         return
      end if
      first = 1
      row = 0
      do while (first <= len(bytes))
         last = line_end(bytes, first)
         line = trim(adjustl(bytes(first:last)))
         first = next_line(bytes, last)
         row = row + 1
         if (len(line) == 0 .or. index(line, '!') == 1) cycle
         blank = index(line//' ', ' ')
         card = findloc(card_names == lower(line(:blank - 1)), .true., 1)
         fault = ''
         if (card > 0) call places_of(line(blank:), places, fault)
         if (card == 0 .or. len(fault) > 0) then
            call fatal_error(error, exit_deck, path//':'//to_text(row)// &
               ': a card and its format are expected'//new_line('a')//'  found:   '//line// &
               new_line('a')//'  allowed: control, element, node, restraint, material, '// &
               'property, loads, point, gravity, edges, edge, pressure, increment; then nX, nIw, '// &
               'nFw.d with commas')
            return
         end if
         if (size(places) < least(card)) then
            call fatal_error(error, exit_deck, path//':'//to_text(row)//': this format has fewer values than the card'// &
               new_line('a')//'  found:   '//line//', of '//to_text(size(places))// &
               new_line('a')//'  allowed: '//to_text(least(card))//' values or more, as '//trim(book(card)))
            return
         end if
         dialect%formats(card) = line(blank:)
      end do
   end subroutine read_dialect

end module axijoint_legacy_layout
