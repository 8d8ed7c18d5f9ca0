!> RINGLOADS: forces on nodal circles, per length
module axijoint_deck_section_ring_loads
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_node
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : harmonic_field => harmonic, family, shape_number, &
      name_harmonic, name_shape
   use axijoint_deck_job_modes, only : read_shares, check_components
   use axijoint_deck_load_lists, only : add_ring_load
   use axijoint_deck_load_shares, only : share_type
   use axijoint_deck_text_common_fields, only : node_field => node, components, name_node
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, reals_of, is_good, &
      is_sound, field_fault, field_named
   use axijoint_deck_text_field, only : described
   use axijoint_fe_mode, only : mode_integral
   use axijoint_model_load, only : ring_load_type
   implicit none
   private
   public :: ring_loads_section

   !> The keyword
   character(len=*), parameter :: keyword_ring_loads = 'RINGLOADS'
   !> Fields: the node, three amplitudes
   integer, parameter :: field_node = 1, field_first = 3

contains

   !> RINGLOADS
   function ring_loads_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_ring_loads
      section%purpose = 'forces on nodal circles, per length'
      section%is_load = .true.
      section%stage = stage_loads
      section%read => read_ring_loads
      section%fields = &
         [node_field(name_node, 1), harmonic_field(6), &
          described(components('q', '', 11), &
          'q_r q_z q_θ: amplitudes of the force per length of the nodal '// &
                    'circle [force/length]', limits='one at least must be given'), &
          family(41), described(shape_number(46), 'shape', limits='of SHAPES; not on the axis')]
   end function ring_loads_section

   !> Add the forces
   subroutine read_ring_loads(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_ring_loads)
      do while (next_card(card))
         call read_ring_load(card)
      end do
   end subroutine read_ring_loads

   !> A force per length of a nodal circle
   subroutine read_ring_load(card)
      !> A card of RINGLOADS
      type(card_type), intent(in) :: card

      type(share_type), allocatable :: shares(:)
      integer :: node, k

      if (.not. any([(is_given(card, field_first + k), k=0, 2)]) .and. is_good(card)) then
         call field_fault(card, field_first, 'the card gives no load', &
                          allowed='at least one amplitude; blank ones are 0')
      end if
      call check_components(card, 'load', field_first, 3)
      call find_node(card, field_node, node)
      if (node > 0) call check_axis(card, node)
      call read_shares(card, shares)
      if (node == 0 .or. .not. is_sound(card)) return
      do k = 1, size(shares)
         associate (r => card%deck%draft%position(1, node), &
                    q => shares(k)%factor*reals_of(card, field_first, 3))
            if (size(shares) > 1 .and. .not. any(abs(q) > 0.0_wp)) cycle
            ! On the axis the circle is a point: the force itself is given. The work of a
            ! lateral force on the amplitudes u and w = -u of a translation is counted with u.
            call add_ring_load(card%deck%loads, ring_load_type(shares(k)%mode, card%case, node, &
               merge(mode_integral(shares(k)%mode)*r, 1.0_wp, r > 0.0_wp)*q))
         end associate
      end do
   end subroutine read_ring_load

   !> Check that a load on the axis is a force that a point can have
   subroutine check_axis(card, node)
      !> A card of RINGLOADS
      type(card_type), intent(in) :: card
      !> The node
      integer, intent(in) :: node

      integer :: harmonic, component

      if (card%deck%draft%position(1, node) > 0.0_wp) return
      if (is_given(card, field_named(card, name_shape))) then
         call field_fault(card, field_named(card, name_shape), &
                          'a node on the axis has no load with a shape', &
                          allowed='harmonic 0 or 1', mend='give the force by a POINTLOADS card')
      end if
      if (.not. is_given(card, field_named(card, name_harmonic))) return
      harmonic = integer_of(card, field_named(card, name_harmonic))
      if (harmonic > 1) then
         call field_fault(card, field_named(card, name_harmonic), &
                          'a node on the axis has no load in harmonic '//to_text(harmonic), &
                          allowed='0 (axial force in q_z) or 1 (lateral force in q_r)')
         return
      end if
      do component = 1, 3
         if (component == merge(2, 1, harmonic == 0)) cycle
         if (.not. abs(real_of(card, field_first - 1 + component)) > 0.0_wp) cycle
         if (harmonic == 0 .and. component == 3 .and. .not. is_sound(card)) cycle  ! said already
         call field_fault(card, field_first - 1 + component, &
                          'a node on the axis has no such load in harmonic '//to_text(harmonic), &
                          allowed='harmonic 0: q_z, the axial force; harmonic 1: q_r, the '// &
                          'lateral force')
      end do
   end subroutine check_axis

end module axijoint_deck_section_ring_loads
