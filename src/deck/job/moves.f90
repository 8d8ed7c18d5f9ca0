!> Displacements that are given
module axijoint_deck_job_moves
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : refine_order
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type
   use axijoint_deck_job_deck, only : deck_type
   use axijoint_deck_job_load_fields, only : name_harmonic, name_family, name_held
   use axijoint_deck_load_lists, only : load_lists_type, move_type, add_move
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_text_common_fields, only : name_node
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_entry, only : integer_of, field_named, field_fault, is_good, is_sound, &
      first_card
   use axijoint_deck_text_source, only : source_type, card_position
   use axijoint_fe_mode, only : mode_type, same_mode, is_torsion, mode_name
   use axijoint_model_model, only : model_type, held_at
   use axijoint_model_restraint, only : restraint_type, hold_in
   implicit none
   private
   public :: check_given, move_node, take_moves, component_name

   !> Names of the components
   character(len=1), parameter :: component_name(3) = ['u', 'v', 'w']
   !> Two displacements are the same if they differ by less than this part
   real(wp), parameter :: same_value = 1.0e-12_wp

contains

   !> Report a card without displacements
   subroutine check_given(card, first, given)
      !> The card
      type(card_type), intent(in) :: card
      !> Field of the first component, and which components are given
      integer, intent(in) :: first
      logical, intent(in) :: given(3)

      if (any(given) .or. .not. is_good(card)) return
      call field_fault(card, first, 'the card gives no displacement', &
                       allowed='u, v, w: one at least; 0 holds it')
   end subroutine check_given

   !> Note the displacements of a node. At the pole r = 0, harmonic 0 has v only and 1 has
   !> u = -w, a lateral displacement, which is counted with u; no other harmonic has any
   subroutine move_node(card, first, node, given, values)
      !> The card
      type(card_type), intent(in) :: card
      !> Field of the first component; the node
      integer, intent(in) :: first, node
      !> Which components are given
      logical, intent(in) :: given(3)
      !> Their amplitudes
      real(wp), intent(in) :: values(3)

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
         if (.not. card%deck%draft%position(1, node) > 0.0_wp) then
            if (abs(value) > 0.0_wp .and. .not. moves_at_pole(mode, component)) then
               if (is_sound(card)) call report_pole(card, first, node, component, mode)
               cycle
            end if
            if (mode%harmonic == 1 .and. component == 3) then
               i = 1
               value = -value
            end if
         end if
         call add_move(card%deck%loads, &
              move_type(mode, card%case, node, i, value, card=first_card(card), &
                        only=only, of_nodes=field_named(card, name_node) > 0))
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
   subroutine report_pole(card, first, node, component, mode)
      !> The card
      type(card_type), intent(in) :: card
      !> Field of the first component; the node and its component
      integer, intent(in) :: first, node, component
      !> The mode
      type(mode_type), intent(in) :: mode

      call field_fault(card, first - 1 + component, &
                       'node '//to_text(card%deck%draft%node_label(node))// &
                       ' is on the axis and has no '// &
                       component_name(component)//' in harmonic '//mode_name(mode), &
                       allowed='on the axis v in harmonic 0, and u = -w in harmonic 1')
   end subroutine report_pole

   !> Move the displacements into the model, which holds their components in all modes, or in
   !> their own only. Those that contradict each other or a restraint are reported
   subroutine take_moves(deck)
      !> The deck, whose model has the restraints
      type(deck_type), intent(inout), target :: deck

      integer, allocatable :: order(:), told(:, :)
      logical, allocatable :: kept(:)
      integer :: i, k

      associate (moves => deck%loads%moves(:deck%loads%n_moves), draft => deck%draft, &
                 diagnostics => deck%diagnostics)
         kept = abs(moves%value) > 0.0_wp
         call check_restraints(draft, deck%loads, deck%model, diagnostics)
         order = order_of(moves)
         allocate (told(2, 0))
         do k = 2, size(order)
            if (.not. same_component(moves(order(k)), moves(order(k - 1)))) cycle
            kept(order(k)) = .false.
            call check_same(deck%source, draft, moves(order(k)), moves(order(k - 1)), told, diagnostics)
         end do
         do i = 1, size(moves)
            call hold_component(moves(i), deck%model)
         end do
         deck%model%prescribed = pack((moves%prescribed_type), kept)
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
         .and. (model%held_by_default(move%component, &
         move%node) .or. .not. model%fixed(move%component, move%node))
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
                           allowed='0, or a component that no RESTRAINTS or FIXEDFACES card '// &
                           'fixes', &
                           mend='a component that is moved is held in all other harmonics anyway')
         end associate
      end do
   end subroutine check_restraints

   !> Report two different displacements of one component, once two cards
   subroutine check_same(source, draft, b, a, told, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The displacement, and one of the same component that is given before
      type(move_type), intent(in) :: b, a
      !> Cards that were reported to contradict each other, shape (2, pairs)
      integer, allocatable, intent(inout) :: told(:, :)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      if (abs(a%value - b%value) <= same_value*max(abs(a%value), abs(b%value))) return
      if (any(told(1, :) == a%card .and. told(2, :) == b%card)) return
      told = reshape([told, a%card, b%card], [2, size(told, 2) + 1])
      call add_error(diagnostics, b%card, 0, 0, &
                     'node '//to_text(draft%node_label(b%node))//' is moved along '// &
                     component_name(b%component)//' in harmonic '//mode_name(b%mode)// &
                     ' by two different amounts', &
                     found=component_name(b%component)//' = '//to_text(b%value)//', and '// &
                     to_text(a%value)//' by '//card_position(source, a%card, b%card), &
                     allowed='one amount in a load case')
   end subroutine check_same

end module axijoint_deck_job_moves
