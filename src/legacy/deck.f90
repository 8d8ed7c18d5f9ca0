!> An old deck as it stands: the axisymmetric plasticity program of Owen and Hinton, Finite Elements
!> in Plasticity (Pineridge Press, 1980)
module axijoint_legacy_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_places, only : clear_rounding
   use axijoint_deck_text_source, only : card_text
   use axijoint_legacy_cards, only : cards_type, next_card, integer_at, real_at, complain, warn
   use axijoint_legacy_layout, only : card_control, card_element, card_node, card_restraint, &
      card_material, card_property, card_loads, card_point, card_gravity, card_edges, card_edge, &
      card_pressure, card_increment
   implicit none
   private
   public :: old_deck_type, old_edge_type, old_increment_type, read_old_deck
   public :: tresca, mises, mohr, drucker

   !> Criteria, NCRIT
   integer, parameter :: tresca = 1, mises = 2, mohr = 3, drucker = 4
   !> Most of anything, that a wrong count does not ask for all memory
   integer, parameter :: most = 10000000

   !> Loaded edge
   type :: old_edge_type
      !> Element, and nodes: two, or three with the middle one second; counterclockwise
      integer :: element = 0, nodes(3) = 0, n_nodes = 0
      !> Normal stress, pressure positive, and tangential stress towards the last node, at each
      real(wp) :: normal(3) = 0.0_wp, tangential(3) = 0.0_wp
      !> Its card
      integer :: card = 0
   end type old_edge_type

   !> Increment of load
   type :: old_increment_type
      !> FACTO, and TOLER in per cent
      real(wp) :: factor = 0.0_wp, tolerance = 0.0_wp
      !> MITER, and NOUTP of the first iteration and the last
      integer :: iterations = 0, output(2) = 0
   end type old_increment_type

   !> The deck
   type :: old_deck_type
      !> Titles of the job and of its load
      character(len=:), allocatable :: title, load_title
      !> Numbers on the control card
      integer :: n_nodes = 0, n_elements = 0, n_restraints = 0, kind = 0, n_element_nodes = 0, &
         n_materials = 0, n_gauss = 0, algorithm = 0, criterion = 0, n_increments = 0, &
         n_stresses = 0
      !> Elements: number, material, nodes; shape (elements), (nodes, elements)
      integer, allocatable :: element(:), material(:), nodes(:, :), element_card(:)
      !> Coordinates r, z, shape (2, nodes), those of middles completed; the card that gives them, 0 if
      !> none does
      real(wp), allocatable :: position(:, :)
      integer, allocatable :: node_card(:)
      !> Restraints: node, whether u and v are held, their values
      integer, allocatable :: held_node(:), held_card(:)
      logical, allocatable :: held(:, :)
      real(wp), allocatable :: held_value(:, :)
      !> Materials: E, nu, thickness, density, yield stress or cohesion, hardening, friction angle;
      !> shape (7, materials)
      real(wp), allocatable :: property(:, :)
      !> Forces on nodes, F_r and F_z on the whole circle, shape (2, nodes)
      real(wp), allocatable :: force(:, :)
      !> Acceleration along z
      real(wp) :: gravity = 0.0_wp
      !> Loaded edges, increments
      type(old_edge_type), allocatable :: edges(:)
      type(old_increment_type), allocatable :: increments(:)
   end type old_deck_type

contains

   !> Read it; of use only if there are no errors among the messages
   subroutine read_old_deck(cards, deck)
      !> Its cards
      type(cards_type), intent(inout) :: cards
      !> What they say
      type(old_deck_type), intent(out) :: deck

      deck%title = text_of(cards, 'the title')
      call read_control(cards, deck)
      if (cards%diagnostics%n_errors > 0) return  ! nothing that follows can be told apart
      call read_elements(cards, deck)
      call read_nodes(cards, deck)
      if (cards%diagnostics%n_errors == 0) call complete_nodes(deck)
      call read_restraints(cards, deck)
      call read_materials(cards, deck)
      deck%load_title = text_of(cards, 'the title of the load')
      call read_loads(cards, deck)
      call read_increments(cards, deck)
      if (cards%ended) return
      do while (cards%at < cards%source%n_cards)
         call next_card(cards, 0, '')
         if (len_trim(card_text(cards%source, cards%at)) == 0) cycle
         call complain(cards, 0, 0, 'a card after the last increment', 'nothing: NINCS counts '// &
            'the increments')
         exit
      end do
   end subroutine read_old_deck

   !> A card of text
   function text_of(cards, what) result(text)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> What it is
      character(len=*), intent(in) :: what
      !> The text
      character(len=:), allocatable :: text

      call next_card(cards, 0, what)
      text = ''
      if (.not. cards%ended) text = trim(card_text(cards%source, cards%at))
   end function text_of

   !> The control card
   subroutine read_control(cards, deck)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      call next_card(cards, card_control, 'the control card')
      deck%n_nodes = integer_at(cards, 1, 'NPOIN')
      deck%n_elements = integer_at(cards, 2, 'NELEM')
      deck%n_restraints = integer_at(cards, 3, 'NVFIX')
      deck%kind = integer_at(cards, 4, 'NTYPE')
      deck%n_element_nodes = integer_at(cards, 5, 'NNODE')
      deck%n_materials = integer_at(cards, 6, 'NMATS')
      deck%n_gauss = integer_at(cards, 7, 'NGAUS')
      deck%algorithm = integer_at(cards, 8, 'NALGO')
      deck%criterion = integer_at(cards, 9, 'NCRIT')
      deck%n_increments = integer_at(cards, 10, 'NINCS')
      deck%n_stresses = integer_at(cards, 11, 'NSTRE')
      if (cards%ended) return
      if (any(deck%kind == [1, 2])) then
         call complain(cards, 4, 0, 'NTYPE is '//trim(merge('plane stress', 'plane strain', &
            deck%kind == 1))//': axijoint solves axisymmetric bodies', '3, axisymmetric')
         return
      end if
      call demand(deck%n_nodes > 0 .and. deck%n_nodes <= most, 1, 1, 'NPOIN is not positive', &
         'the number of nodes')
      call demand(deck%n_elements > 0 .and. deck%n_elements <= most, 2, 0, &
         'NELEM is not positive', 'the number of elements')
      if (deck%n_elements > 0 .and. deck%n_elements <= most) &
         call demand(deck%n_nodes <= deck%n_elements*max(4, min(9, deck%n_element_nodes)), 1, 2, &
         'more nodes than the elements can have', 'NPOIN up to NELEM times NNODE')
      call demand(deck%n_restraints >= 1 .and. deck%n_restraints <= max(1, deck%n_nodes), 3, 3, &
         'NVFIX is out of range', '1 to NPOIN')
      call demand(deck%n_increments >= 1 .and. deck%n_increments <= most, 10, 4, &
         'NINCS is less than 1', 'the number of increments')
      call demand(deck%kind == 3, 4, 5, 'NTYPE is none that there is', '3, axisymmetric')
      call demand(any(deck%n_element_nodes == [4, 8, 9]), 5, 6, 'NNODE is out of range', &
         '4, 8 or 9')
      call demand(deck%n_materials >= 1 .and. deck%n_materials <= max(1, deck%n_elements), 6, 8, &
         'NMATS is out of range', '1 to NELEM')
      call demand(deck%criterion >= tresca .and. deck%criterion <= drucker, 9, 9, &
         'NCRIT is out of range', '1 Tresca, 2 von Mises, 3 Mohr-Coulomb, 4 Drucker-Prager')
      call demand(any(deck%n_gauss == [2, 3]), 7, 10, 'NGAUS is out of range', '2 or 3')
      call demand(deck%algorithm >= 1 .and. deck%algorithm <= 4, 8, 11, 'NALGO is out of range', &
         '1 initial stiffness, 2 tangential stiffness, 3 and 4 mixtures')
      call demand(deck%n_stresses == 4, 11, 12, 'NSTRE is not that of axisymmetric bodies', '4')

   contains

      !> See that a value is allowed
      subroutine demand(good, place, number, text, allowed)
         !> Whether it is
         logical, intent(in) :: good
         !> Its place, and number of the error
         integer, intent(in) :: place, number
         !> What is wrong otherwise, and what is allowed
         character(len=*), intent(in) :: text, allowed

         if (.not. good) call complain(cards, place, number, text, allowed)
      end subroutine demand

   end subroutine read_control

   !> The elements
   subroutine read_elements(cards, deck)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      integer :: k, i, n

      n = deck%n_elements
      allocate (deck%element(n), deck%material(n), deck%element_card(n), source=0)
      allocate (deck%nodes(deck%n_element_nodes, n), source=0)
      do k = 1, n
         call next_card(cards, card_element, 'element '//to_text(k)//' of '//to_text(n))
         if (cards%ended) return
         deck%element_card(k) = cards%at
         deck%element(k) = integer_at(cards, 1, 'NUMEL')
         deck%material(k) = integer_at(cards, 2, 'MATNO')
         do i = 1, deck%n_element_nodes
            deck%nodes(i, k) = integer_at(cards, 2 + i, 'LNODS')
         end do
         if (deck%material(k) < 1 .or. deck%material(k) > deck%n_materials) &
            call complain(cards, 2, 14, 'MATNO is out of range', '1 to '//to_text(deck%n_materials))
         do i = 1, deck%n_element_nodes
            associate (node => deck%nodes(i, k))
               if (node == 0) then
                  call complain(cards, 2 + i, 15, 'node 0', '1 to '//to_text(deck%n_nodes))
               else if (node < 0 .or. node > deck%n_nodes) then
                  call complain(cards, 2 + i, 16, 'a node out of range', &
                     '1 to '//to_text(deck%n_nodes))
               else if (any(deck%nodes(:i - 1, k) == node)) then
                  call complain(cards, 2 + i, 17, 'a node that the element has already')
               end if
            end associate
         end do
      end do
   end subroutine read_elements

   !> The nodes: the list ends at the last one
   subroutine read_nodes(cards, deck)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      real(wp) :: position(2)
      integer :: node

      allocate (deck%position(2, deck%n_nodes), source=0.0_wp)
      allocate (deck%node_card(deck%n_nodes), source=0)
      do
         call next_card(cards, card_node, 'a node (the list ends at node '// &
            to_text(deck%n_nodes)//')')
         if (cards%ended) return
         node = integer_at(cards, 1, 'IPOIN')
         position(1) = real_at(cards, 2, 'r')
         position(2) = real_at(cards, 3, 'z')
         if (node < 1 .or. node > deck%n_nodes) then
            call complain(cards, 1, 0, 'a node out of range', '1 to '//to_text(deck%n_nodes)// &
               ', the last of which ends the list')
            if (cards%diagnostics%n_errors > 100) return
            cycle
         end if
         if (deck%node_card(node) > 0) call warn(cards, 1, 'node '//to_text(node)// &
            ' is given again: the last card counts')
         deck%node_card(node) = cards%at
         deck%position(:, node) = position
         if (node == deck%n_nodes) exit
      end do
      call clear_rounding(deck%position)
   end subroutine read_nodes

   !> Put mid-side nodes without a card in the middle of their sides, centre nodes in that of the
   !> corners
   subroutine complete_nodes(deck)
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      integer :: k, i

      if (deck%n_element_nodes == 4) return
      do k = 1, deck%n_elements
         associate (nodes => deck%nodes(:, k), place => deck%position)
            do i = 2, 8, 2
               if (deck%node_card(nodes(i)) == 0) place(:, nodes(i)) = &
                  0.5_wp*(place(:, nodes(i - 1)) + place(:, nodes(modulo(i, 8) + 1)))
            end do
            if (size(nodes) == 8) cycle
            if (deck%node_card(nodes(9)) == 0) place(:, nodes(9)) = &
               0.25_wp*(place(:, nodes(1)) + place(:, nodes(3)) + place(:, nodes(5)) + &
               place(:, nodes(7)))
         end associate
      end do
   end subroutine complete_nodes

   !> The restraints
   subroutine read_restraints(cards, deck)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      integer :: k, n, code

      n = deck%n_restraints
      allocate (deck%held_node(n), deck%held_card(n), source=0)
      allocate (deck%held(2, n), source=.false.)
      allocate (deck%held_value(2, n), source=0.0_wp)
      do k = 1, n
         call next_card(cards, card_restraint, 'restraint '//to_text(k)//' of '//to_text(n))
         if (cards%ended) return
         deck%held_card(k) = cards%at
         deck%held_node(k) = integer_at(cards, 1, 'NOFIX')
         code = integer_at(cards, 2, 'IFPRE')
         deck%held(:, k) = [any(code == [10, 11]), any(code == [1, 11])]
         deck%held_value(1, k) = real_at(cards, 3, 'PRESC of u')
         deck%held_value(2, k) = real_at(cards, 4, 'PRESC of v')
         if (deck%held_node(k) < 1 .or. deck%held_node(k) > deck%n_nodes) then
            call complain(cards, 1, 22, 'NOFIX is out of range', '1 to '//to_text(deck%n_nodes))
         else if (any(deck%held_node(:k - 1) == deck%held_node(k))) then
            call complain(cards, 1, 24, 'the node is restrained already')
         end if
         if (.not. any(deck%held(:, k))) call complain(cards, 2, 23, &
            'no component is restrained', '10 holds u, 1 holds v, 11 both')
      end do
   end subroutine read_restraints

   !> The materials
   subroutine read_materials(cards, deck)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      character(len=*), parameter :: names(7) = [character(len=22) :: 'E', 'nu', 'thickness', &
         'density', 'yield stress, cohesion', 'hardening', 'friction angle']
      logical :: given(deck%n_materials)
      integer :: k, i, material

      allocate (deck%property(7, deck%n_materials), source=0.0_wp)
      given = .false.
      do k = 1, deck%n_materials
         call next_card(cards, card_material, 'material '//to_text(k)//' of '// &
            to_text(deck%n_materials))
         if (cards%ended) return
         material = integer_at(cards, 1, 'NUMAT')
         if (material < 1 .or. material > deck%n_materials) then
            call complain(cards, 1, 0, 'NUMAT is out of range', '1 to '// &
               to_text(deck%n_materials))
            material = k
         else if (given(material)) then
            call complain(cards, 1, 0, 'the material is given already')
         end if
         given(material) = .true.
         call next_card(cards, card_property, 'the properties of material '//to_text(material))
         do i = 1, 7
            deck%property(i, material) = real_at(cards, i, trim(names(i)))
         end do
      end do
   end subroutine read_materials

   !> The loads
   subroutine read_loads(cards, deck)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      integer :: has(3), node
      real(wp) :: angle

      call next_card(cards, card_loads, 'the card with IPLOD, IGRAV, IEDGE')
      has(1) = integer_at(cards, 1, 'IPLOD')
      has(2) = integer_at(cards, 2, 'IGRAV')
      has(3) = integer_at(cards, 3, 'IEDGE')
      allocate (deck%force(2, deck%n_nodes), source=0.0_wp)
      allocate (deck%edges(0))
      do while (has(1) /= 0)
         call next_card(cards, card_point, 'a loaded node (the list ends at node '// &
            to_text(deck%n_nodes)//')')
         if (cards%ended) return
         node = integer_at(cards, 1, 'LODPT')
         if (node < 1 .or. node > deck%n_nodes) then
            call complain(cards, 1, 0, 'LODPT is out of range', '1 to '//to_text(deck%n_nodes))
            if (node > deck%n_nodes) exit
            if (cards%diagnostics%n_errors > 100) return
            cycle
         end if
         if (any(abs(deck%force(:, node)) > 0.0_wp)) &
            call complain(cards, 1, 0, 'the node is loaded already', 'one card a node')
         deck%force(1, node) = real_at(cards, 2, 'F_r')
         deck%force(2, node) = real_at(cards, 3, 'F_z')
         if (cards%diagnostics%n_errors == 0 .and. abs(deck%force(1, node)) > 0.0_wp .and. &
             .not. deck%position(1, node) > 0.0_wp) call warn(cards, 2, &
             'F_r on the axis, where nothing moves along r, does nothing and is left out')
         if (node == deck%n_nodes) exit
      end do
      if (has(2) /= 0) then
         call next_card(cards, card_gravity, 'the card of gravity')
         angle = real_at(cards, 1, 'THETA')
         deck%gravity = -real_at(cards, 2, 'GRAVY')
         if (abs(abs(angle) - 180.0_wp) <= 0.0_wp) deck%gravity = -deck%gravity
         if (abs(angle) > 0.0_wp .and. abs(abs(angle) - 180.0_wp) > 0.0_wp) &
            call complain(cards, 1, 0, 'gravity of an axisymmetric body acts along its axis', &
            '0: against z; 180: along z')
      end if
      if (has(3) /= 0) call read_edges(cards, deck)
   end subroutine read_loads

   !> Loaded edges
   subroutine read_edges(cards, deck)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      integer :: k, i, n

      call next_card(cards, card_edges, 'the number of loaded edges')
      n = integer_at(cards, 1, 'NEDGE')
      if (n < 1 .or. n > most) then
         call complain(cards, 1, 0, 'NEDGE is not positive', 'the number of loaded edges')
         return
      end if
      deallocate (deck%edges)
      allocate (deck%edges(n))
      do k = 1, n
         call next_card(cards, card_edge, 'loaded edge '//to_text(k)//' of '//to_text(n))
         if (cards%ended) return
         associate (edge => deck%edges(k))
            edge%card = cards%at
            edge%n_nodes = merge(2, 3, deck%n_element_nodes == 4)
            edge%element = integer_at(cards, 1, 'NEASS')
            do i = 1, edge%n_nodes
               edge%nodes(i) = integer_at(cards, 1 + i, 'NOPRS')
            end do
            i = findloc(deck%element, edge%element, 1)
            if (i == 0) then
               call complain(cards, 1, 0, 'there is no such element')
            else if (.not. is_side(deck%nodes(:, i), edge%nodes(:edge%n_nodes))) then
               call complain(cards, 2, 0, 'these nodes are no side of element '// &
                  to_text(edge%element), 'nodes of a side, one after the other, counterclockwise')
            end if
            call next_card(cards, card_pressure, 'the pressures of edge '//to_text(k))
            do i = 1, edge%n_nodes
               edge%normal(i) = real_at(cards, 2*i - 1, 'the normal pressure')
               edge%tangential(i) = real_at(cards, 2*i, 'the tangential load')
            end do
         end associate
      end do
   end subroutine read_edges

   !> Whether nodes follow each other along a side of an element
   pure logical function is_side(element, nodes)
      !> Nodes of the element, round its perimeter
      integer, intent(in) :: element(:)
      !> Nodes of the edge
      integer, intent(in) :: nodes(:)

      integer :: first, i, n

      n = min(8, size(element))
      is_side = .false.
      first = findloc(element(:n), nodes(1), 1)
      if (first == 0 .or. (n == 8 .and. modulo(first, 2) == 0)) return
      is_side = all([(element(modulo(first + i - 2, n) + 1) == nodes(i), i=1, size(nodes))])
   end function is_side

   !> The increments
   subroutine read_increments(cards, deck)
      !> The cards
      type(cards_type), intent(inout) :: cards
      !> The deck
      type(old_deck_type), intent(inout) :: deck

      integer :: k, n

      n = deck%n_increments
      allocate (deck%increments(n))
      do k = 1, n
         call next_card(cards, card_increment, 'increment '//to_text(k)//' of '//to_text(n))
         if (cards%ended) return
         associate (increment => deck%increments(k))
            increment%factor = real_at(cards, 1, 'FACTO')
            increment%tolerance = real_at(cards, 2, 'TOLER')
            increment%iterations = integer_at(cards, 3, 'MITER')
            increment%output(1) = integer_at(cards, 4, 'NOUTP')
            increment%output(2) = integer_at(cards, 5, 'NOUTP')
            if (.not. increment%tolerance > 0.0_wp .or. increment%tolerance >= 100.0_wp) &
               call complain(cards, 2, 0, 'TOLER is out of range', 'above 0, below 100 per cent')
            if (increment%iterations < 1) &
               call complain(cards, 3, 0, 'MITER is less than 1', 'the most iterations')
         end associate
      end do
   end subroutine read_increments

end module axijoint_legacy_deck
