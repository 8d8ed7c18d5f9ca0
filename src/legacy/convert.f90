!> From an old deck to one of axijoint that gives the same answer
module axijoint_legacy_convert
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text, upper
   use axijoint_deck_registry, only : all_sections
   use axijoint_deck_text_diagnostics, only : add_error
   use axijoint_deck_text_file_bytes, only : line_end, next_line
   use axijoint_deck_text_section, only : names_of, keyword_length
   use axijoint_deck_text_source, only : card_text
   use axijoint_legacy_cards, only : cards_type, open_cards, warn
   use axijoint_legacy_check, only : check_old_deck
   use axijoint_legacy_deck, only : old_deck_type, read_old_deck, tresca, mises, mohr, drucker
   use axijoint_legacy_layout, only : dialect_type
   use axijoint_legacy_loads, only : put_edges, put_forces
   use axijoint_legacy_title, only : put_title
   use axijoint_legacy_words, only : text_type, put, list, integers, exact
   implicit none
   private
   public :: convert_deck, looks_old, may_be_old, is_own

   !> Tolerance that residual forces have here, whatever TOLER asks for above it
   real(wp), parameter :: tolerance = 1.0e-6_wp

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
      if (is_own(cards)) then
         call add_error(cards%diagnostics, 0, 0, 0, 'this is a deck of axijoint already', &
            mend='axijoint run DECK solves it as it is')
         return
      end if
      call read_old_deck(cards, deck)
      if (cards%diagnostics%n_errors == 0) call check_old_deck(deck, cards)
      if (cards%diagnostics%n_errors == 0) call write_deck(path, deck, cards, text)
   end subroutine convert_deck

   !> Whether a deck is one of axijoint: more of its cards begin with keywords than the two titles of
   !> an old deck may
   logical function is_own(cards)
      !> Its cards
      type(cards_type), intent(in) :: cards

      integer, parameter :: n_titles = 2
      character(len=keyword_length), allocatable :: keywords(:)
      character(len=:), allocatable :: text
      integer :: card, n

      keywords = names_of(all_sections())
      n = 0
      do card = 1, cards%source%n_cards
         text = upper(card_text(cards%source, card))
         if (any(keywords == text(:scan(text//' ', ' ,') - 1))) n = n + 1
      end do
      is_own = n > n_titles
   end function is_own

   !> Whether a text can be an old deck, be it with errors: most words of its second line, and four at least, are whole numbers
   pure logical function may_be_old(bytes)
      !> What it says
      character(len=*), intent(in) :: bytes

      character(len=:), allocatable :: line
      integer :: first, last, blank, n_words, n_whole

      first = next_line(bytes, line_end(bytes, 1))
      last = line_end(bytes, first)
      line = ''
      if (last >= first) line = trim(adjustl(bytes(first:min(last, first + 200))))
      n_words = 0
      n_whole = 0
      do while (len(line) > 0)
         blank = scan(line//' ', ' '//achar(9))
         n_words = n_words + 1
         if (verify(line(:blank - 1), '+-0123456789') == 0) n_whole = n_whole + 1
         line = trim(adjustl(line(min(blank, len(line)) + 1:)))
      end do
      may_be_old = n_whole >= 4 .and. 2*n_whole > n_words
   end function may_be_old

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
      integer, allocatable :: centre(:)
      integer :: k

      cards%at = 2
      call warn(cards, 0, 'NALGO '//to_text(deck%algorithm)//' ('// &
         trim(algorithms(deck%algorithm))//'): solved by Newton''s method on the elastic '// &
         'stiffness, whatever NALGO says')
      call put_title(deck%title, 1, cards, new)
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
      if (any(deck%node_card == 0)) call put(new, '! mid-side nodes that are not here are made')
      allocate (centre(0))
      if (deck%n_element_nodes == 9) centre = deck%nodes(9, :)
      do k = 1, deck%n_nodes
         if (deck%node_card(k) > 0 .or. any(centre == k)) &
            call put(new, list(deck%position(:, k), k))
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

end module axijoint_legacy_convert
