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

   !> Formats of a dialect
   type :: dialect_type
      !> One a card
      character(len=80) :: formats(n_cards) = [character(len=80) :: book]
   end type dialect_type

contains

   !> Places of the values that a format describes: nX, nIw, nFw.d, with commas between
   pure subroutine places_of(format, places, fault)
      !> The format, without parentheses
      character(len=*), intent(in) :: format
      !> The places
      type(place_type), allocatable, intent(out) :: places(:)
      !> The descriptor that is none of these; empty if all are
      character(len=:), allocatable, intent(out) :: fault

      character(len=:), allocatable :: rest, word
      integer :: comma, column, kind, count, width, decimals, point, i

      allocate (places(0))
      fault = ''
      rest = lower(trim(adjustl(format)))//','
      column = 0
      do while (len(rest) > 0)
         comma = index(rest, ',')
         word = trim(adjustl(rest(:comma - 1)))
         rest = rest(comma + 1:)
         kind = scan(word, 'xif')
         if (kind == 0) then
            fault = word//' '
            return
         end if
         count = max(1, number(word(:kind - 1)))
         if (word(kind:kind) == 'x') then
            column = column + count
            cycle
         end if
         point = index(word//'.', '.')
         width = number(word(kind + 1:point - 1))
         decimals = -1
         if (word(kind:kind) == 'f') decimals = max(0, number(word(min(point, len(word)) + 1:)))
         if (width < 1) then
            fault = word
            return
         end if
         do i = 1, count
            places = [places, place_type(column + 1, column + width, decimals)]
            column = column + width
         end do
      end do

   contains

      !> A number; zero if there is none
      pure integer function number(digits)
         !> Its digits
         character(len=*), intent(in) :: digits

         integer :: k

         number = 0
         if (verify(digits, '0123456789') /= 0 .or. len(digits) > 4) return
         do k = 1, len(digits)
            number = 10*number + iachar(digits(k:k)) - iachar('0')
         end do
      end function number

   end subroutine places_of

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
      integer :: first, last, blank, card, number

      call read_bytes(path, bytes, failure)
      if (len(failure) > 0) then
         call fatal_error(error, exit_deck, 'the file of formats '//path//': '//failure)
         return
      end if
      first = 1
      number = 0
      do while (first <= len(bytes))
         last = line_end(bytes, first)
         line = trim(adjustl(bytes(first:last)))
         first = next_line(bytes, last)
         number = number + 1
         if (len(line) == 0 .or. index(line, '!') == 1) cycle
         blank = index(line//' ', ' ')
         card = findloc(card_names == lower(line(:blank - 1)), .true., 1)
         fault = ''
         if (card > 0) call places_of(line(blank:), places, fault)
         if (card == 0 .or. len(fault) > 0) then
            call fatal_error(error, exit_deck, path//':'//to_text(number)// &
               ': a card and its format are expected'//new_line('a')//'  found:   '//line// &
               new_line('a')//'  allowed: control, element, node, restraint, material, '// &
               'property, loads, point, gravity, edges, edge, pressure, increment; then nX, nIw, '// &
               'nFw.d with commas')
            return
         end if
         dialect%formats(card) = line(blank:)
      end do
   end subroutine read_dialect

end module axijoint_legacy_layout
