!> Contact and ties of Abaqus and CalculiX: pairs of surfaces whose sides lie on each other, node on node, become joints, or share
!> their nodes
module axijoint_legacy_abaqus_contact
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_legacy_abaqus_lines, only : line_type, is_data, parameter_of, has_parameter, field_text, real_of
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, find_surface, side_nodes, tie, number_at, root_of
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : set_type, open_set, find_set
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_laws, part_law_details, part_joints
   use axijoint_legacy_words, only : put, exact, integers
   implicit none
   private
   public :: contact_type, open_interaction, read_friction, read_behavior, read_pairs, read_ties, put_contact, find_bodies

   !> Distances of nodes of two sides, in lengths of the side: in contact at one place; tied at one place, as those are that Abaqus
   !> moves there; apart by a gap
   real(wp), parameter :: same = 1.0e-6_wp, moved_there = 1.0e-3_wp, apart = 0.1_wp
   !> Stiffness k h/E of contact that has none of its own: what presses the sides moves them into each other by a hundredth of what
   !> it shortens an element as long
   real(wp), parameter :: hard = 100.0_wp

   !> How two surfaces act on each other
   type :: interaction_type
      !> Coefficient of friction; stiffness, zero of hard contact
      real(wp) :: friction = 0.0_wp, stiffness = 0.0_wp
   end type interaction_type

   !> Two surfaces in contact
   type :: pair_type
      !> Surfaces and interaction (indices; 0: no friction), and the card that says so
      integer :: surfaces(2) = 0, interaction = 0, card = 0
   end type pair_type

   !> What is read
   type :: contact_type
      !> Interactions: names, what they are, the one that was named last
      type(set_type), allocatable :: names(:)
      type(interaction_type), allocatable :: interactions(:)
      integer :: last = 0
      !> Pairs in contact
      type(pair_type), allocatable :: pairs(:)
   end type contact_type

contains

   !> *SURFACE INTERACTION: what follows is of it
   subroutine open_interaction(line, contact)
      !> The keyword
      type(line_type), intent(in) :: line
      !> Takes it
      type(contact_type), intent(inout) :: contact

      type(interaction_type), allocatable :: more(:)

      if (.not. allocated(contact%interactions)) allocate (contact%interactions(0))
      call open_set(contact%names, parameter_of(line, 'NAME'), line%card, contact%last)
      if (contact%last <= size(contact%interactions)) return
      allocate (more(contact%last))
      more(:contact%last - 1) = contact%interactions
      call move_alloc(more, contact%interactions)
   end subroutine open_interaction

   !> *FRICTION: its coefficient
   subroutine read_friction(cards, keyword, at, contact, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> Takes it
      type(contact_type), intent(inout) :: contact
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: line
      integer :: n

      n = 0
      do while (is_data(cards, at, line))
         n = n + 1
         if (n == 1 .and. contact%last > 0) contact%interactions(contact%last)%friction = real_of(cards, line, 1)
         if (n > 1 .or. contact%last == 0) call leave_out(sketch, line%card, '*FRICTION beyond its first line')
      end do
      if (n == 0 .or. has_parameter(keyword, 'ROUGH')) call leave_out(sketch, keyword%card, '*FRICTION without a coefficient')
   end subroutine read_friction

   !> *SURFACE BEHAVIOR: hard contact, or the slope of a linear one
   subroutine read_behavior(cards, keyword, at, contact, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> Takes it
      type(contact_type), intent(inout) :: contact
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: line
      character(len=:), allocatable :: kind
      integer :: n

      kind = parameter_of(keyword, 'PRESSURE-OVERCLOSURE')
      n = 0
      do while (is_data(cards, at, line))
         n = n + 1
         if (kind == 'LINEAR' .and. n == 1 .and. contact%last > 0) &
            contact%interactions(contact%last)%stiffness = real_of(cards, line, 1)
      end do
      if (all(kind /= [character(len=6) :: '', 'HARD', 'LINEAR'])) call leave_out(sketch, keyword%card, &
         '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE='//kind//': the contact is taken as hard')
   end subroutine read_behavior

   !> *CONTACT PAIR: two surfaces a line
   subroutine read_pairs(cards, keyword, at, mesh, contact)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Takes them
      type(contact_type), intent(inout) :: contact

      type(line_type) :: line
      type(pair_type) :: pair

      if (.not. allocated(contact%pairs)) allocate (contact%pairs(0))
      do while (is_data(cards, at, line))
         pair%surfaces = [find_surface(cards, line, 1, mesh), find_surface(cards, line, 2, mesh)]
         pair%interaction = find_set(contact%names, parameter_of(keyword, 'INTERACTION'))
         pair%card = line%card
         if (all(pair%surfaces > 0)) contact%pairs = [contact%pairs, pair]
      end do
   end subroutine read_pairs

   !> *TIE: the nodes of two surfaces a line become one
   subroutine read_ties(cards, at, mesh, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The card of the keyword; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: line
      integer, allocatable :: sides(:, :)
      integer :: surfaces(2), k, i

      do while (is_data(cards, at, line))
         surfaces = [find_surface(cards, line, 1, mesh), find_surface(cards, line, 2, mesh)]
         if (any(surfaces == 0)) cycle
         call match_sides(mesh, surfaces, moved_there, sides)
         call tell_unmatched(cards, line%card, '*TIE', mesh, surfaces, sides, sketch)
         do k = 1, size(sides, 2)
            do i = 1, 3
               if (sides(i, k) > 0) call tie(mesh, find_number(mesh%node_map, sides(i, k)), &
                  find_number(mesh%node_map, sides(3 + i, k)))
            end do
         end do
         if (size(sides, 2) == mesh%surfaces(surfaces(1))%elements%n) mesh%surfaces(surfaces)%joined = .true.
      end do
   end subroutine read_ties

   !> Sides of one surface and those of another that lie on them
   subroutine match_sides(mesh, surfaces, distance, sides, farthest)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The surfaces
      integer, intent(in) :: surfaces(2)
      !> Distance of nodes at one place, in lengths of the side
      real(wp), intent(in) :: distance
      !> Numbers of nodes, shape (6, sides): two corners of a side of the first surface in the order of its element and the node
      !> between them, 0 if there is none, then those of the second at their places
      integer, allocatable, intent(out) :: sides(:, :)
      !> Largest distance of their nodes
      real(wp), intent(out), optional :: farthest

      integer, allocatable :: first(:), second(:)
      integer :: i, j, k, six(6)

      allocate (sides(6, 0))
      if (present(farthest)) farthest = 0.0_wp
      associate (a => mesh%surfaces(surfaces(1)), b => mesh%surfaces(surfaces(2)))
         do i = 1, a%elements%n
            first = side_nodes(mesh, a%elements%value(i), a%sides%value(i))
            do k = 1, b%elements%n
               second = side_nodes(mesh, b%elements%value(k), b%sides%value(k))
               if (size(second) /= size(first)) cycle
               if (.not. near(first(1), second(1))) second(:2) = second([2, 1])
               if (.not. all([(near(first(j), second(j)), j=1, size(first))])) cycle
               if (present(farthest)) farthest = max(farthest, maxval([(distance_of(mesh, first(j), second(j)), j=1, size(first))]))
               six = 0
               six(:size(first)) = first
               six(4:3 + size(second)) = second
               sides = reshape([sides, six], [6, size(sides, 2) + 1])
               exit
            end do
         end do
      end associate

   contains

      !> Whether two nodes are at one place
      logical function near(p, q)
         !> Their numbers
         integer, intent(in) :: p, q

         near = distance_of(mesh, p, q) <= distance*distance_of(mesh, first(1), first(2))
      end function near

   end subroutine match_sides

   !> Distance of two nodes
   pure real(wp) function distance_of(mesh, p, q) result(distance)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Their numbers
      integer, intent(in) :: p, q

      distance = norm2(mesh%position(:, find_number(mesh%node_map, p)) - mesh%position(:, find_number(mesh%node_map, q)))
   end function distance_of

   !> Say how many sides have no partner
   subroutine tell_unmatched(cards, card, what, mesh, surfaces, sides, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The card of the pair
      integer, intent(in) :: card
      !> The keyword
      character(len=*), intent(in) :: what
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The surfaces
      integer, intent(in) :: surfaces(2)
      !> Sides that lie on each other
      integer, intent(in) :: sides(:, :)
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      integer, allocatable :: beside(:, :)
      real(wp) :: gap
      integer :: n

      n = mesh%surfaces(surfaces(1))%elements%n
      if (size(sides, 2) == n) return
      if (size(sides, 2) > 0) then
         call add_warning(cards%diagnostics, card, 0, 0, what//': '//to_text(n - size(sides, 2))//' of the '//to_text(n)// &
            ' sides of the first surface lie on none of the second, node on node, and are left free')
         return
      end if
      call match_sides(mesh, surfaces, apart, beside, gap)
      if (size(beside, 2) > 0) then
         call leave_out(sketch, card, what//' of surfaces that stand apart by up to '//to_text(gap)//': put the nodes of both '// &
            'at one place, and the gap on a card of LAWDETAILS')
      else
         call leave_out(sketch, card, what//' of surfaces none of whose sides lie on each other, node on node: '// &
            'mesh both sides alike')
      end if
   end subroutine tell_unmatched

   !> Laws and joints of the pairs in contact
   subroutine put_contact(cards, mesh, contact, young, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The mesh; nodes in contact are put at one place
      type(abaqus_type), intent(inout) :: mesh
      !> What is in contact
      type(contact_type), intent(in) :: contact
      !> Modulus of elasticity of each material
      real(wp), intent(in) :: young(:)
      !> Takes the cards
      type(sketch_type), intent(inout) :: sketch

      integer, allocatable :: sides(:, :)
      integer :: k, i, n_joints

      if (.not. allocated(contact%pairs)) return
      n_joints = 0
      do k = 1, size(contact%pairs)
         associate (pair => contact%pairs(k))
            call match_sides(mesh, pair%surfaces, same, sides)
            call tell_unmatched(cards, pair%card, '*CONTACT PAIR', mesh, pair%surfaces, sides, sketch)
            if (size(sides, 2) == 0) cycle
            call put_on_each_other(sides, mesh)
            mesh%surfaces(pair%surfaces)%joined = .true.
            call put_law(mesh, contact, pair, k, sides, young, sketch)
            call put(sketch%parts(part_joints), '! '//mesh%surfaces(pair%surfaces(1))%name//' on '// &
               mesh%surfaces(pair%surfaces(2))%name)
            do i = 1, size(sides, 2)
               n_joints = n_joints + 1
               ! a side runs with its element on its left: backwards it has the other body there
               associate (a => sides(:3, i), b => sides(4:, i))
                  call put(sketch%parts(part_joints), to_text(n_joints)//', '//to_text(k)//integers([a(2), a(1), b(1), b(2), &
                     pack([a(3), b(3)], [a(3), b(3)] > 0)]))
               end associate
            end do
         end associate
      end do
   end subroutine put_contact

   !> Put the nodes of the first sides exactly where those of the second are
   subroutine put_on_each_other(sides, mesh)
      !> Numbers of nodes of the sides
      integer, intent(in) :: sides(:, :)
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh

      integer :: k, i

      do k = 1, size(sides, 2)
         do i = 1, 3
            if (sides(i, k) > 0) mesh%position(:, find_number(mesh%node_map, sides(i, k))) = &
               mesh%position(:, find_number(mesh%node_map, sides(3 + i, k)))
         end do
      end do
   end subroutine put_on_each_other

   !> Law of a pair
   subroutine put_law(mesh, contact, pair, number, sides, young, sketch)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> What is in contact
      type(contact_type), intent(in) :: contact
      !> The pair and the number of its law
      type(pair_type), intent(in) :: pair
      integer, intent(in) :: number
      !> Its sides
      integer, intent(in) :: sides(:, :)
      !> Modulus of elasticity of each material
      real(wp), intent(in) :: young(:)
      !> Takes the card
      type(sketch_type), intent(inout) :: sketch

      type(interaction_type) :: interaction
      real(wp) :: longest, softest, k
      character(len=:), allocatable :: words
      integer :: i, s, element

      longest = 0.0_wp
      do i = 1, size(sides, 2)
         longest = max(longest, norm2(mesh%position(:, find_number(mesh%node_map, sides(1, i))) &
                                      - mesh%position(:, find_number(mesh%node_map, sides(2, i)))))
      end do
      softest = huge(1.0_wp)
      do s = 1, 2
         associate (elements => mesh%surfaces(pair%surfaces(s))%elements)
            do i = 1, elements%n
               element = elements%value(i)
               if (mesh%material(element) > 0) softest = min(softest, young(mesh%material(element)))
            end do
         end associate
      end do
      if (pair%interaction > 0) interaction = contact%interactions(pair%interaction)
      k = interaction%stiffness
      words = 'of *SURFACE BEHAVIOR'
      if (.not. k > 0.0_wp) then
         k = hard*softest/longest
         words = 'of hard contact: '//to_text(nint(hard))//' E over the longest side'
      end if
      call put(sketch%parts(part_laws), '! stiffness '//words)
      call put(sketch%parts(part_laws), to_text(number)//', '//exact(k)//', '//exact(k)//', '//exact(k)//', 0, '// &
         exact(atan(interaction%friction)/degree))
      if (interaction%friction > 0.0_wp) call put(sketch%parts(part_law_details), to_text(number)//', RESULTANT')
   end subroutine put_law

   !> Bodies: elements that share nodes
   subroutine find_bodies(mesh, body)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Body of each element, from 1 in the order of their first elements
      integer, allocatable, intent(out) :: body(:)

      integer :: chief(mesh%n_nodes), number(mesh%n_nodes), k, i, n

      chief = [(root_of(mesh, k), k=1, mesh%n_nodes)]
      do k = 1, mesh%n_elements
         do i = 2, mesh%size(k)
            chief(chief_of(node(i, k))) = chief_of(node(1, k))
         end do
      end do
      allocate (body(mesh%n_elements))
      number = 0
      n = 0
      do k = 1, mesh%n_elements
         associate (its => number(chief_of(node(1, k))))
            if (its == 0) then
               n = n + 1
               its = n
            end if
            body(k) = its
         end associate
      end do

   contains

      !> Node of an element
      integer function node(i, k)
         !> Its place there, and the element
         integer, intent(in) :: i, k

         node = find_number(mesh%node_map, mesh%nodes(i, k))
      end function node

      !> Node that stands for the body of a node
      integer function chief_of(node) result(found)
         !> The node
         integer, intent(in) :: node

         integer :: next, walker

         found = node
         do while (chief(found) /= found)
            found = chief(found)
         end do
         walker = node
         do while (chief(walker) /= found)  ! the next who asks has a shorter way
            next = chief(walker)
            chief(walker) = found
            walker = next
         end do
      end function chief_of

   end subroutine find_bodies

end module axijoint_legacy_abaqus_contact
