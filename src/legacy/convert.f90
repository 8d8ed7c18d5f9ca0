!> From an old deck to one of axijoint that gives the same answer
module axijoint_legacy_convert
   use axijoint_base_kinds, only : wp, pi, degree
   use axijoint_base_text, only : to_text
   use axijoint_legacy_cards, only : cards_type, open_cards, warn, complain
   use axijoint_legacy_check, only : check_old_deck
   use axijoint_legacy_deck, only : old_deck_type, old_edge_type, read_old_deck, tresca, mises, &
      mohr, drucker
   use axijoint_legacy_layout, only : dialect_type
   implicit none
   private
   public :: convert_deck, looks_old

   !> Tolerance that residual forces have here, whatever TOLER asks for above it
   real(wp), parameter :: tolerance = 1.0e-6_wp
   !> Part of a side's length that a mid-side node may be off its middle
   real(wp), parameter :: straight = 1.0e-6_wp

   !> Text that grows
   type :: text_type
      !> Its letters, and how many are used
      character(len=:), allocatable :: letters
      integer :: used = 0
   end type text_type

contains

   !> Read an old deck and write it anew
   subroutine convert_deck(path, bytes, dialect, cards, text)
      !> The deck, for messages, and what it says
      character(len=*), intent(in) :: path, bytes
      !> Where its values stand
      type(dialect_type), intent(in) :: dialect
      !> Its cards, with errors and warnings
      type(cards_type), intent(out) :: cards
      !> The new deck; of use only if there are no errors among the messages
      character(len=:), allocatable, intent(out) :: text

      type(old_deck_type) :: deck

      text = ''
      call open_cards(path, bytes, dialect, cards)
      call read_old_deck(cards, deck)
      if (cards%diagnostics%n_errors == 0) call check_old_deck(deck, cards)
      if (cards%diagnostics%n_errors == 0) call check_edges(deck, cards)
      if (cards%diagnostics%n_errors == 0) call write_deck(path, deck, cards, text)
   end subroutine convert_deck

   !> Whether a text may be an old deck: its second line is eleven integers
   pure logical function looks_old(bytes)
      !> What it says
      character(len=*), intent(in) :: bytes

      integer :: first, last, values(11), status

      looks_old = .false.
      first = index(bytes, new_line('a')) + 1
      if (first == 1) return
      last = first + index(bytes(first:), new_line('a')) - 2
      if (last < first .or. last > first + 200) return
      if (verify(bytes(first:last), ' +-0123456789'//achar(13)) > 0) return
      if (scan(bytes(first:last), '0123456789') == 0) return
      read (bytes(first:min(last, first + 54)), '(11i5)', iostat=status) values
      looks_old = status == 0 .and. any(values(4) == [1, 2, 3]) .and. any(values(5) == [4, 8, 9])
   end function looks_old

   !> See that edges are loaded in a way that cards can say: linear along the edge, and tangential
   !> loads on straight edges
   subroutine check_edges(deck, cards)
      !> The old deck
      type(old_deck_type), intent(in) :: deck
      !> Its cards; take messages
      type(cards_type), intent(inout) :: cards

      integer :: k

      do k = 1, size(deck%edges)
         associate (edge => deck%edges(k))
            if (edge%n_nodes == 2) cycle
            if (.not. (is_mean(edge%normal) .and. is_mean(edge%tangential))) &
               call complain(cards, 0, 0, 'the load of this edge is not linear along it', &
               'at the middle node the mean of the others', card=edge%card + 1)
            if (any(abs(edge%tangential) > 0.0_wp) .and. .not. is_straight(deck, edge)) &
               call complain(cards, 0, 0, 'a tangential load on a bent edge', &
               'straight edges', card=edge%card + 1)
         end associate
      end do
   end subroutine check_edges

   !> Whether the middle of three values is the mean of the others
   pure logical function is_mean(values)
      !> The values
      real(wp), intent(in) :: values(3)

      is_mean = abs(values(2) - 0.5_wp*(values(1) + values(3))) <= 1.0e-9_wp*maxval(abs(values))
   end function is_mean

   !> Whether a side is straight, its middle node in its middle
   pure logical function is_straight(deck, edge)
      !> The deck
      type(old_deck_type), intent(in) :: deck
      !> The side
      type(old_edge_type), intent(in) :: edge

      is_straight = .true.
      if (edge%n_nodes == 2) return
      if (deck%node_card(edge%nodes(2)) == 0) return
      associate (a => deck%position(:, edge%nodes(1)), m => deck%position(:, edge%nodes(2)), &
                 b => deck%position(:, edge%nodes(3)))
         is_straight = norm2(m - 0.5_wp*(a + b)) <= straight*norm2(b - a)
      end associate
   end function is_straight

   !> The new deck
   subroutine write_deck(path, deck, cards, text)
      !> Path of the old deck
      character(len=*), intent(in) :: path
      !> What it says
      type(old_deck_type), intent(in) :: deck
      !> Its cards; take warnings about what is understood in another way
      type(cards_type), intent(inout) :: cards
      !> The new deck
      character(len=:), allocatable, intent(out) :: text

      character(len=18), parameter :: algorithms(4) = [character(len=18) :: 'initial stiffness', &
         'tangential', 'mixture', 'mixture']
      character(len=7), parameter :: criteria(4) = [character(len=7) :: 'TRESCA', 'MISES', &
         'MOHR', 'DRUCKER']
      type(text_type) :: new
      integer :: k

      cards%at = 2
      call warn(cards, 0, 'NALGO '//to_text(deck%algorithm)//' ('// &
         trim(algorithms(deck%algorithm))//'): solved by Newton''s method on the elastic '// &
         'stiffness, whatever NALGO says')
      call put(new, 'TITLE')
      call put(new, trim(deck%title))
      call put(new, '! from '//path//', load: '//trim(deck%load_title))
      call put(new, '! loads, restraints and increments of an axisymmetric job: harmonic 0 alone')
      call put(new, 'CONTROL')
      call put(new, '0, , '//to_text(deck%n_gauss)//', '//to_text(deck%n_gauss))
      call put(new, 'MATERIALS')
      do k = 1, deck%n_materials
         call put(new, list([deck%property([1, 2, 4], k)], k))
      end do
      call put(new, '! E and nu as before; the density is that of GRAVITY')
      call put(new, 'YIELD')
      do k = 1, deck%n_materials
         call put(new, yield_card(deck, k, trim(criteria(deck%criterion))))
      end do
      call put(new, 'NODES')
      if (any(deck%node_card == 0)) call put(new, '! mid-side and centre nodes that are not here '// &
         'are made')
      do k = 1, deck%n_nodes
         if (deck%node_card(k) > 0) call put(new, list(deck%position(:, k), k))
      end do
      call put(new, 'ELEMENTS')
      do k = 1, deck%n_elements
         call put(new, to_text(deck%element(k))//', '//to_text(deck%material(k))//', 1'// &
            integers(deck%nodes(:, k)))
      end do
      call put_restraints(deck, new)
      call put_edges(deck, new)
      call put_forces(deck, new)
      if (abs(deck%gravity) > 0.0_wp) then
         call put(new, 'GRAVITY')
         call put(new, exact(deck%gravity))
      end if
      call put(new, 'INCREMENTS')
      call put(new, '! TOLER is per cent there; residual forces are held to 1E-6 here, or to less')
      do k = 1, deck%n_increments
         associate (increment => deck%increments(k))
            call put(new, exact(increment%factor)//', '//exact(min(tolerance, 0.01_wp* &
               increment%tolerance))//', '//to_text(max(500, increment%iterations)))
         end associate
      end do
      call put_outputs(deck, new)
      call put(new, 'END')
      text = new%letters(:new%used)
   end subroutine write_deck

   !> What the old program prints of increments: NOUTP of their last iterations. Stresses that it
   !> prints are kept in the results file
   subroutine put_outputs(deck, new)
      !> The old deck
      type(old_deck_type), intent(in) :: deck
      !> The new one
      type(text_type), intent(inout) :: new

      integer, parameter :: stresses = 3
      integer :: amount(deck%n_increments), k

      amount = min(stresses, max(0, [(deck%increments(k)%output(2), k=1, size(amount))]))
      call put(new, 'OLDLISTING')
      call put(new, '! NOUTP of the last iterations: what --listing owen-hinton shows')
      do k = 1, size(amount)
         call put(new, to_text(amount(k))//', '//to_text(k))
      end do
      if (.not. any(amount(:size(amount) - 1) == stresses)) return
      call put(new, 'KEEP')
      if (all(amount == stresses)) then
         call put(new, ' STRESSES, ALL')
      else
         do k = 1, size(amount)
            if (amount(k) == stresses) call put(new, ' STRESSES, ONLY, '//to_text(k))
         end do
      end if
   end subroutine put_outputs

   !> Card of YIELD. Where hardening adds to the uniaxial yield stress of TRESCA and MISES, it adds to
   !> c cos(phi) of MOHR and to 6 c cos(phi)/(sqrt(3) (3 - sin(phi))) of DRUCKER there
   function yield_card(deck, k, criterion) result(card)
      !> The old deck
      type(old_deck_type), intent(in) :: deck
      !> Material
      integer, intent(in) :: k
      !> Name of the criterion
      character(len=*), intent(in) :: criterion
      !> The card
      character(len=:), allocatable :: card

      real(wp) :: hardening

      associate (strength => deck%property(5, k), angle => deck%property(7, k))
         hardening = deck%property(6, k)
         card = to_text(k)//', '//criterion//', '//exact(strength)
         if (any(deck%criterion == [tresca, mises])) then
            card = card//', , , '//exact(hardening)
            return
         end if
         if (deck%criterion == mohr) hardening = hardening/cos(angle*degree)
         if (deck%criterion == drucker) hardening = hardening*sqrt(3.0_wp)* &
            (3.0_wp - sin(angle*degree))/(6.0_wp*cos(angle*degree))
         ! flow is associated there
         card = card//', '//exact(angle)//', '//exact(angle)//', '//exact(hardening)
      end associate
   end function yield_card

   !> Restraints: those of value zero, and given displacements
   subroutine put_restraints(deck, new)
      !> The old deck
      type(old_deck_type), intent(in) :: deck
      !> The new one
      type(text_type), intent(inout) :: new

      logical :: moved(deck%n_restraints)
      character(len=3) :: code
      integer :: k

      moved = any(deck%held .and. abs(deck%held_value) > 0.0_wp, 1)
      if (.not. all(moved)) call put(new, 'RESTRAINTS')
      do k = 1, size(moved)
         if (moved(k)) cycle
         code = merge('1', '0', deck%held(1, k))//merge('1', '0', deck%held(2, k))//'0'
         call put(new, to_text(deck%held_node(k))//', '//code)
      end do
      if (any(moved)) call put(new, 'MOVEDNODES')
      do k = 1, size(moved)
         if (.not. moved(k)) cycle
         call put(new, to_text(deck%held_node(k))//', 0, '//value(1)//', '//value(2))
      end do

   contains

      !> Displacement that is given; blank if none is. On the axis there is no u
      function value(i)
         !> Component
         integer, intent(in) :: i
         !> Its digits
         character(len=:), allocatable :: value

         value = ''
         if (i == 1 .and. .not. deck%position(1, deck%held_node(k)) > 0.0_wp) return
         if (deck%held(i, k)) value = exact(deck%held_value(i, k))
      end function value

   end subroutine put_restraints

   !> Loads on edges: a face each
   subroutine put_edges(deck, new)
      !> The old deck
      type(old_deck_type), intent(in) :: deck
      !> The new one
      type(text_type), intent(inout) :: new

      real(wp) :: direction(2)
      integer :: k, n

      if (size(deck%edges) == 0) return
      call put(new, 'CHAINS')
      do k = 1, size(deck%edges)
         associate (edge => deck%edges(k))
            call put(new, to_text(k)//integers(edge%nodes([1, edge%n_nodes])))
         end associate
      end do
      if (any([(any(abs(deck%edges(k)%normal) > 0.0_wp), k=1, size(deck%edges))])) then
         call put(new, 'PRESSURES')
         do k = 1, size(deck%edges)
            associate (edge => deck%edges(k))
               n = edge%n_nodes
               if (any(abs(edge%normal) > 0.0_wp)) call put(new, to_text(k)//', 0, '// &
                  exact(edge%normal(1))//', '//exact(edge%normal(n)))
            end associate
         end do
      end if
      if (.not. any([(any(abs(deck%edges(k)%tangential) > 0.0_wp), k=1, size(deck%edges))])) return
      call put(new, 'TRACTIONS')
      do k = 1, size(deck%edges)
         associate (edge => deck%edges(k))
            if (.not. any(abs(edge%tangential) > 0.0_wp)) cycle
            n = edge%n_nodes
            direction = deck%position(:, edge%nodes(n)) - deck%position(:, edge%nodes(1))
            direction = direction/norm2(direction)
            call put(new, to_text(k)//', 0, '//exact(edge%tangential(1)*direction(1))//', '// &
               exact(edge%tangential(1)*direction(2))//', , '// &
               exact(edge%tangential(n)*direction(1))//', '// &
               exact(edge%tangential(n)*direction(2)))
         end associate
      end do
   end subroutine put_edges

   !> Forces on nodes, of the whole circle there, of a length of it here
   subroutine put_forces(deck, new)
      !> The old deck
      type(old_deck_type), intent(in) :: deck
      !> The new one
      type(text_type), intent(inout) :: new

      real(wp) :: length
      integer :: k

      if (.not. any(abs(deck%force) > 0.0_wp)) return
      call put(new, 'RINGLOADS')
      call put(new, '! forces of the whole circle, divided by its length')
      do k = 1, deck%n_nodes
         if (.not. any(abs(deck%force(:, k)) > 0.0_wp)) cycle
         length = 2.0_wp*pi*deck%position(1, k)
         if (length > 0.0_wp) then
            call put(new, to_text(k)//', 0, '//exact(deck%force(1, k)/length)//', '// &
               exact(deck%force(2, k)/length))
         else
            call put(new, to_text(k)//', 0, , '//exact(deck%force(2, k)))
         end if
      end do
   end subroutine put_forces

   !> A number of a thing, and its values, with commas
   function list(values, number) result(text)
      !> The values
      real(wp), intent(in) :: values(:)
      !> The number
      integer, intent(in) :: number
      !> The words
      character(len=:), allocatable :: text

      integer :: k

      text = to_text(number)
      do k = 1, size(values)
         text = text//', '//exact(values(k))
      end do
   end function list

   !> Integers, each after a comma
   function integers(values) result(text)
      !> The values
      integer, intent(in) :: values(:)
      !> The words
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(values)
         text = text//', '//to_text(values(k))
      end do
   end function integers

   !> As few digits of a number as are read as the same number
   function exact(value) result(text)
      !> The number
      real(wp), intent(in) :: value
      !> Its digits
      character(len=:), allocatable :: text

      character(len=32) :: form, digits
      real(wp) :: again
      integer :: n, status

      do n = 1, 17
         write (form, '(a, i0, a)') '(es32.', n, 'e3)'
         write (digits, form) value
         read (digits, *, iostat=status) again
         if (status == 0 .and. .not. abs(again - value) > 0.0_wp) exit
      end do
      text = trim(adjustl(digits))
      n = index(text, 'E+000')
      if (n > 0) text = text(:n - 1)
   end function exact

   !> Add a line
   subroutine put(text, line)
      !> The text
      type(text_type), intent(inout) :: text
      !> The line
      character(len=*), intent(in) :: line

      character(len=:), allocatable :: larger

      if (.not. allocated(text%letters)) allocate (character(len=65536) :: text%letters)
      do while (text%used + len(line) + 1 > len(text%letters))
         allocate (character(len=2*len(text%letters)) :: larger)
         larger(:text%used) = text%letters(:text%used)
         call move_alloc(larger, text%letters)
      end do
      text%letters(text%used + 1:text%used + len(line) + 1) = line//new_line('a')
      text%used = text%used + len(line) + 1
   end subroutine put

end module axijoint_legacy_convert
