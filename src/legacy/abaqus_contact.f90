!> Contact and ties of Abaqus and CalculiX: pairs of surfaces whose sides lie on each other, node on node, become joints, or share
!> their nodes
module axijoint_legacy_abaqus_contact
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_legacy_abaqus_lines, only : line_type, is_data, parameter_of, has_parameter, real_of, fault_of
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, find_surface, tie, find_inside, root_of, most_sides
   use axijoint_legacy_abaqus_sides, only : match_type, match_sides, nodes_of, length_of, depth_of
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
   !> Stiffness of contact that has none of its own, k h/E with the least h of elements, along the contact or across: what presses
   !> the sides moves them into each other by a hundredth of what it shortens an element there
   real(wp), parameter :: hard = 100.0_wp

   !> How two surfaces act on each other
   type :: interaction_type
      !> Coefficient of friction; stiffness, zero of hard contact
      real(wp) :: friction = 0.0_wp, stiffness = 0.0_wp
   end type interaction_type

   !> Two surfaces in contact
   type :: pair_type
      !> Surfaces (indices), and the line that says so
      integer :: surfaces(2) = 0
      type(line_type) :: line
      !> Name of the interaction
      character(len=:), allocatable :: interaction
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

      type(pair_type) :: pair

      if (.not. allocated(contact%pairs)) allocate (contact%pairs(0))
      pair%interaction = parameter_of(keyword, 'INTERACTION')
      do while (is_data(cards, at, pair%line))
         pair%surfaces = [find_surface(cards, pair%line, 1, mesh), find_surface(cards, pair%line, 2, mesh)]
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
      type(match_type), allocatable :: matches(:)
      integer, allocatable :: nodes(:, :)
      integer :: surfaces(2), k, i

      do while (is_data(cards, at, line))
         surfaces = [find_surface(cards, line, 1, mesh), find_surface(cards, line, 2, mesh)]
         if (any(surfaces == 0)) cycle
         call match_sides(mesh, surfaces, moved_there, matches)
         call tell_unmatched(cards, line%card, '*TIE', mesh, surfaces, size(matches), sketch)
         do k = 1, size(matches)
            nodes = nodes_of(mesh, matches(k))
            do i = 1, size(nodes, 1)
               call tie(mesh, nodes(i, 1), nodes(i, 2))
            end do
         end do
      end do
      call find_inside(mesh)
   end subroutine read_ties

   !> Say how many sides have no partner
   subroutine tell_unmatched(cards, card, what, mesh, surfaces, n_matched, sketch)
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
      !> Sides of the first that lie on one of the second
      integer, intent(in) :: n_matched
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      type(match_type), allocatable :: beside(:)
      real(wp) :: gap
      integer :: n

      n = mesh%surfaces(surfaces(1))%elements%n
      if (n_matched == n) return
      if (n_matched > 0) then
         call add_warning(cards%diagnostics, card, 0, 0, what//': '//to_text(n - n_matched)//' of the '//to_text(n)// &
            ' sides of the first surface lie on none of the second, node on node, and are left free')
         return
      end if
      call match_sides(mesh, surfaces, apart, beside, gap)
      if (size(beside) > 0) then
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

      type(match_type), allocatable :: matches(:)
      integer, allocatable :: body(:)
      logical :: has_joint(most_sides, mesh%n_elements)
      integer :: k, i, n_joints, interaction

      if (.not. allocated(contact%pairs)) return
      call find_bodies(mesh, body)
      has_joint = .false.
      n_joints = 0
      do k = 1, size(contact%pairs)
         associate (pair => contact%pairs(k))
            interaction = find_set(contact%names, pair%interaction)
            if (interaction == 0) then
               call fault_of(cards, pair%line, 0, 'there is no interaction of the name "'//pair%interaction//'"', &
                  'INTERACTION=, a name of *SURFACE INTERACTION')
               cycle
            end if
            call match_sides(mesh, pair%surfaces, same, matches)
            call tell_unmatched(cards, pair%line%card, '*CONTACT PAIR', mesh, pair%surfaces, size(matches), sketch)
            if (any([(body(matches(i)%element(1)) == body(matches(i)%element(2)), i=1, size(matches))])) then
               call leave_out(sketch, pair%line%card, '*CONTACT PAIR of parts that nodes or ties connect elsewhere: here '// &
                  'they are one body, which has no joint in itself')
               cycle
            end if
            mesh%surfaces(pair%surfaces)%in_contact = .true.
            ! of two pairs of the same surfaces, or a side that a surface has twice, one is enough
            matches = pack(matches, [(.not. (has_joint(matches(i)%side(1), matches(i)%element(1)) &
                                             .or. has_joint(matches(i)%side(2), matches(i)%element(2))), i=1, size(matches))])
            if (size(matches) == 0) cycle
            call put_law(mesh, contact%interactions(interaction), k, matches, young, sketch)
            call put(sketch%parts(part_joints), '! '//mesh%surfaces(pair%surfaces(1))%name//' on '// &
               mesh%surfaces(pair%surfaces(2))%name)
            do i = 1, size(matches)
               if (has_joint(matches(i)%side(1), matches(i)%element(1))) cycle
               has_joint(matches(i)%side(1), matches(i)%element(1)) = .true.
               has_joint(matches(i)%side(2), matches(i)%element(2)) = .true.
               n_joints = n_joints + 1
               call put_joint(n_joints, k, nodes_of(mesh, matches(i)), mesh, sketch)
            end do
         end associate
      end do
   end subroutine put_contact

   !> Card of a joint. A side runs with its element on its left: backwards it has the other body there
   subroutine put_joint(number, law, nodes, mesh, sketch)
      !> Its number, and that of its law
      integer, intent(in) :: number, law
      !> Nodes of both sides (indices), shape (nodes, 2)
      integer, intent(in) :: nodes(:, :)
      !> The mesh; nodes of the first side are put exactly where those of the second are
      type(abaqus_type), intent(inout) :: mesh
      !> Takes the card
      type(sketch_type), intent(inout) :: sketch

      integer :: i

      do i = 1, size(nodes, 1)
         mesh%position(:, nodes(i, 1)) = mesh%position(:, nodes(i, 2))
      end do
      associate (a => nodes(:, 1), b => nodes(:, 2))
         call put(sketch%parts(part_joints), to_text(number)//', '//to_text(law)//integers(mesh%node([a(2), a(1), b(1), b(2), &
            a(3:), b(3:)])))
      end associate
   end subroutine put_joint

   !> Law of a pair
   subroutine put_law(mesh, interaction, number, matches, young, sketch)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> How its surfaces act on each other
      type(interaction_type), intent(in) :: interaction
      !> The number of the law
      integer, intent(in) :: number
      !> Sides that lie on each other
      type(match_type), intent(in) :: matches(:)
      !> Modulus of elasticity of each material
      real(wp), intent(in) :: young(:)
      !> Takes the cards
      type(sketch_type), intent(inout) :: sketch

      real(wp) :: least, softest, k
      character(len=:), allocatable :: words
      integer :: i, s

      least = huge(1.0_wp)
      softest = huge(1.0_wp)
      do i = 1, size(matches)
         do s = 1, 2
            associate (element => matches(i)%element(s), side => matches(i)%side(s))
               least = min(least, length_of(mesh, element, side), depth_of(mesh, element, side))
               if (mesh%material(element) > 0) softest = min(softest, young(mesh%material(element)))
            end associate
         end do
      end do
      k = interaction%stiffness
      words = 'of *SURFACE BEHAVIOR'
      if (.not. k > 0.0_wp) then
         k = hard*softest/least
         words = 'of hard contact: '//to_text(nint(hard))//' E over the least extent of an element there'
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
