!> Displacements that are given: MOVEDNODES, MOVEDFACES
module axijoint_deck_load_moves
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : refine_order
   use axijoint_base_text, only : to_text
   use axijoint_deck_load_card, only : load_card_type, is_given, integer_of, real_of, reals_of, &
      field_named, field_fault, is_sound, find_any_face, find_row
   use axijoint_deck_load_lists, only : load_lists_type, move_type, add_move
   use axijoint_deck_load_modes, only : share_type, truncation_list_type, read_shares, check_components
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_mesh_face_geometry, only : linear_along
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_layout, only : section_moved_nodes
   use axijoint_deck_text_load_fields, only : name_harmonic, name_family, name_held
   use axijoint_deck_text_source, only : source_type, card_position
   use axijoint_fe_mode, only : mode_type, same_mode, is_torsion, mode_name
   use axijoint_model_model, only : model_type, held_at
   use axijoint_model_restraint, only : restraint_type, hold_in
   implicit none
   private
   public :: read_moved_nodes, read_moved_face, take_moves

   !> First components: of nodes and of the first point of a face, of its last point
   integer, parameter :: field_first = 3, field_last = 6
   !> Names of the components
   character(len=1), parameter :: component_name(3) = ['u', 'v', 'w']
   !> Two displacements are the same if they differ by less than this part
   real(wp), parameter :: same_value = 1.0e-12_wp

contains

   !> Displacements of a row of nodes
   subroutine read_moved_nodes(card, lists)
      !> A card of MOVEDNODES
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      integer, allocatable :: nodes(:)
      logical :: given(3)
      integer :: i

      given = [(is_given(card, field_first + i), i=0, 2)]
      call check_given(card, given)
      call check_components(card, 'displacement', field_first, 3)
      call check_mode(card)
      call find_row(card, nodes)
      if (.not. is_sound(card)) return
      do i = 1, size(nodes)
         call move_node(card, nodes(i), given, reals_of(card, field_first), lists)
      end do
   end subroutine read_moved_nodes

   !> Displacements that vary linearly with the arc length along a face
   subroutine read_moved_face(card, lists)
      !> A card of MOVEDFACES
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      real(wp), allocatable :: values(:, :, :)
      real(wp) :: last(3)
      logical :: given(3), given_last(3)
      integer :: face, i, k

      given = [(is_given(card, field_first + i), i=0, 2)]
      given_last = [(is_given(card, field_last + i), i=0, 2)]
      do i = 1, 3
         if (given(i) .or. .not. given_last(i) .or. .not. card%table%good(card%entry)) cycle
         call field_fault(card, field_first - 1 + i, component_name(i)//' at the first point is blank', &
                          allowed='values at both points, or at the first alone')
      end do
      call check_given(card, given .or. given_last)
      call check_components(card, 'displacement', field_first, 6)
      call check_mode(card)
      call find_any_face(card, face)
      if (face == 0 .or. .not. is_sound(card)) return
      last = merge(reals_of(card, field_last), reals_of(card, field_first), given_last)
      associate (edges => card%draft%faces(face)%edges)
         values = linear_along(card%draft, edges, reals_of(card, field_first), last)
         do i = 1, size(edges)
            do k = 1, count(edges(i)%nodes > 0)
               call move_node(card, edges(i)%nodes(k), given, values(:, k, i), lists)
            end do
         end do
      end associate
   end subroutine read_moved_face

   !> Report a card without displacements
   subroutine check_given(card, given)
      !> The card
      type(load_card_type), intent(in) :: card
      !> Which components are given
      logical, intent(in) :: given(3)

      if (any(given) .or. .not. card%table%good(card%entry)) return
      call field_fault(card, field_first, 'the card gives no displacement', &
                       allowed='u, v, w: one at least; 0 holds it')
   end subroutine check_given

   !> Check the harmonic of a card
   subroutine check_mode(card)
      !> The card
      type(load_card_type), intent(in) :: card

      type(share_type), allocatable :: shares(:)
      type(truncation_list_type) :: none

      call read_shares(card, shares, none)
   end subroutine check_mode

   !> Note the displacements of a node. At the pole r = 0, harmonic 0 has v only and 1 has
   !> u = -w, a lateral displacement, which is counted with u; no other harmonic has any
   subroutine move_node(card, node, given, values, lists)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The node
      integer, intent(in) :: node
      !> Which components are given
      logical, intent(in) :: given(3)
      !> Their amplitudes
      real(wp), intent(in) :: values(3)
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(mode_type) :: mode
      real(wp) :: value
      integer :: component, i
      logical :: only

      only = integer_of(card, field_named(card, name_held)) > 1
      mode = mode_type(integer_of(card, field_named(card, name_harmonic)), &
                       integer_of(card, field_named(card, name_family)))
      do component = 1, 3
         if (.not. given(component)) cycle
         i = component
         value = values(component)
         if (.not. card%draft%position(1, node) > 0.0_wp) then
            if (abs(value) > 0.0_wp .and. .not. moves_at_pole(mode, component)) then
               if (is_sound(card)) call report_pole(card, node, component, mode)
               cycle
            end if
            if (mode%harmonic == 1 .and. component == 3) then
               i = 1
               value = -value
            end if
         end if
         call add_move(lists, move_type(mode, card%case, node, i, value, card=card%table%cards(1, card%entry), &
                                        only=only, of_nodes=card%section == section_moved_nodes))
      end do
   end subroutine move_node

   !> Whether a component at r = 0 can differ from zero in a mode
   pure logical function moves_at_pole(mode, component)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> 1 u, 2 v, 3 w
      integer, intent(in) :: component

      select case (mode%harmonic)
      case (0)
         moves_at_pole = component == 2 .and. .not. is_torsion(mode)
      case (1)
         moves_at_pole = component /= 2
      case default
         moves_at_pole = .false.
      end select
   end function moves_at_pole

   !> Report a displacement that a node on the axis cannot have
   subroutine report_pole(card, node, component, mode)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The node and its component
      integer, intent(in) :: node, component
      !> The mode
      type(mode_type), intent(in) :: mode

      call field_fault(card, field_first - 1 + component, &
                       'node '//to_text(card%draft%node_label(node))//' is on the axis and has no '// &
                       component_name(component)//' in harmonic '//mode_name(mode), &
                       allowed='on the axis v in harmonic 0, and u = -w in harmonic 1')
   end subroutine report_pole

   !> Move the displacements into the model, which holds their components in all modes, or in
   !> their own only. Those that contradict each other or a restraint are reported
   subroutine take_moves(source, draft, lists, model, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The loads
      type(load_lists_type), intent(in) :: lists
      !> The job, with the restraints
      type(model_type), intent(inout) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: order(:)
      logical, allocatable :: kept(:)
      integer :: i, k

      associate (moves => lists%moves(:lists%n_moves))
         kept = abs(moves%value) > 0.0_wp
         call check_restraints(draft, lists, model, diagnostics)
         order = order_of(moves)
         do k = 2, size(order)
            if (.not. same_component(moves(order(k)), moves(order(k - 1)))) cycle
            kept(order(k)) = .false.
            call check_same(source, draft, lists, order(k), order(k - 1), diagnostics)
         end do
         do i = 1, size(moves)
            call hold_component(moves(i), model)
         end do
         model%prescribed = pack((moves%prescribed_type), kept)
      end associate
   end subroutine take_moves

   !> Hold the component of a given displacement
   subroutine hold_component(move, model)
      !> The displacement
      type(move_type), intent(in) :: move
      !> The job
      type(model_type), intent(inout) :: model

      integer :: k

      if (move%only) then
         call hold_in(model%restraints, &
                      restraint_type(move%mode%harmonic, move%mode%harmonic, move%mode%family), &
                      size(model%fixed, 2), [move%node], [(k == move%component, k=1, 3)])
         return
      end if
      model%held_by_default(move%component, move%node) = move%of_nodes &
         .and. (model%held_by_default(move%component, move%node) .or. .not. model%fixed(move%component, move%node))
      model%fixed(move%component, move%node) = .true.
   end subroutine hold_component

   !> Displacements by node, component, case and mode; else as they were given
   pure function order_of(moves) result(order)
      !> The displacements
      type(move_type), intent(in) :: moves(:)
      !> Indices
      integer, allocatable :: order(:)

      integer :: i

      order = [(i, i=1, size(moves))]
      call refine_order(order, (moves%mode%family))
      call refine_order(order, (moves%mode%harmonic))
      call refine_order(order, (moves%case))
      call refine_order(order, (moves%component))
      call refine_order(order, (moves%node))
   end function order_of

   !> Whether two displacements are of the same component, mode and case
   pure logical function same_component(a, b)
      !> The displacements
      type(move_type), intent(in) :: a, b

      same_component = a%node == b%node .and. a%component == b%component .and. a%case == b%case &
                       .and. same_mode(a%mode, b%mode)
   end function same_component

   !> Report displacements of components that are fixed, once a card
   subroutine check_restraints(draft, lists, model, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The loads
      type(load_lists_type), intent(in) :: lists
      !> The job, which has what RESTRAINTS and FIXEDFACES hold
      type(model_type), intent(in) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, reported
      logical :: fixed(3), held

      reported = 0
      do i = 1, lists%n_moves
         associate (move => lists%moves(i))
            fixed = held_at(model, move%mode, move%node)
            held = fixed(move%component)
            if (.not. draft%position(1, move%node) > 0.0_wp .and. move%component == 1) &
               held = any(fixed([1, 3]))  ! w follows u there
            if (.not. held .or. .not. abs(move%value) > 0.0_wp .or. move%card == reported) cycle
            reported = move%card
            call add_error(diagnostics, reported, 0, 0, &
                           'node '//to_text(draft%node_label(move%node))//' is moved along '// &
                           component_name(move%component)//' and fixed there', &
                           found=component_name(move%component)//' = '//to_text(move%value), &
                           allowed='0, or a component that no RESTRAINTS or FIXEDFACES card fixes', &
                           mend='a component that is moved is held in all other harmonics anyway')
         end associate
      end do
   end subroutine check_restraints

   !> Report two different displacements of one component
   subroutine check_same(source, draft, lists, i, earlier, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The loads
      type(load_lists_type), intent(in) :: lists
      !> The displacement, and one of the same component that is given before
      integer, intent(in) :: i, earlier
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      associate (a => lists%moves(earlier), b => lists%moves(i))
         if (abs(a%value - b%value) <= same_value*max(abs(a%value), abs(b%value))) return
         call add_error(diagnostics, b%card, 0, 0, &
                        'node '//to_text(draft%node_label(b%node))//' is moved along '// &
                        component_name(b%component)//' in harmonic '//mode_name(b%mode)// &
                        ' by two different amounts', &
                        found=component_name(b%component)//' = '//to_text(b%value)//', and '// &
                        to_text(a%value)//' by '//card_position(source, a%card, b%card), &
                        allowed='one amount in a load case')
      end associate
   end subroutine check_same

end module axijoint_deck_load_moves
