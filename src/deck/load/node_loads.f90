!> Loads on nodes: RINGLOADS, POINTLOADS
module axijoint_deck_load_node_loads
   use axijoint_base_kinds, only : wp, pi
   use axijoint_base_text, only : to_text
   use axijoint_deck_load_card, only : load_card_type, is_given, integer_of, real_of, reals_of, &
      field_fault, card_fault, is_sound, find_node, field_named
   use axijoint_deck_load_lists, only : load_lists_type, add_ring_load
   use axijoint_deck_load_modes, only : share_type, read_shares, check_components, add_truncation
   use axijoint_deck_text_load_fields, only : name_harmonic, name_shape
   use axijoint_fe_fourier, only : cosine_of_degrees, sine_of_degrees
   use axijoint_fe_mode, only : mode_type, mode_integral, family_symmetric, family_antisymmetric
   use axijoint_model_load, only : ring_load_type
   implicit none
   private
   public :: read_ring_load, read_point_load

   !> First amplitude of RINGLOADS; angle and first component of POINTLOADS
   integer, parameter :: ring_first = 3, point_angle = 2, point_first = 3

contains

   !> A force per length of a nodal circle
   subroutine read_ring_load(card, lists)
      !> A card of RINGLOADS
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(share_type), allocatable :: shares(:)
      integer :: node, k

      if (.not. any([(is_given(card, ring_first + k), k=0, 2)]) .and. card%table%good(card%entry)) then
         call field_fault(card, ring_first, 'the card gives no load', &
                          allowed='at least one amplitude; blank ones are 0')
      end if
      call check_components(card, 'load', ring_first, 3)
      call find_node(card, node)
      if (node > 0) call check_axis(card, node)
      call read_shares(card, shares, lists%truncations)
      if (node == 0 .or. .not. is_sound(card)) return
      do k = 1, size(shares)
         associate (r => card%draft%position(1, node), q => shares(k)%factor*reals_of(card, ring_first))
            if (size(shares) > 1 .and. .not. any(abs(q) > 0.0_wp)) cycle
            ! On the axis the circle is a point: the force itself is given. The work of a
            ! lateral force on the amplitudes u and w = -u of a translation is counted with u.
            call add_ring_load(lists, ring_load_type(shares(k)%mode, card%case, node, &
               merge(mode_integral(shares(k)%mode)*r, 1.0_wp, r > 0.0_wp)*q))
         end associate
      end do
   end subroutine read_ring_load

   !> Check that a load on the axis is a force that a point can have
   subroutine check_axis(card, node)
      !> A card of RINGLOADS
      type(load_card_type), intent(in) :: card
      !> The node
      integer, intent(in) :: node

      integer :: harmonic, component

      if (card%draft%position(1, node) > 0.0_wp) return
      if (is_given(card, field_named(card, name_shape))) then
         call field_fault(card, field_named(card, name_shape), 'a node on the axis has no load with a shape', &
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
         if (.not. abs(real_of(card, ring_first - 1 + component)) > 0.0_wp) cycle
         if (harmonic == 0 .and. component == 3 .and. .not. is_sound(card)) cycle  ! said already
         call field_fault(card, ring_first - 1 + component, &
                          'a node on the axis has no such load in harmonic '//to_text(harmonic), &
                          allowed='harmonic 0: q_z, the axial force; harmonic 1: q_r, the lateral force')
      end do
   end subroutine check_axis

   !> A force at one point of a nodal circle, in all harmonics that are in use
   subroutine read_point_load(card, lists)
      !> A card of POINTLOADS
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(ring_load_type), allocatable :: loads(:)
      real(wp) :: left_out
      integer :: node, k

      if (.not. any([(is_given(card, point_first + k), k=0, 2)]) .and. card%table%good(card%entry)) then
         call field_fault(card, point_first, 'the card gives no load', &
                          allowed='at least one component; blank ones are 0')
      end if
      call find_node(card, node)
      if (node == 0 .or. .not. is_sound(card)) return
      associate (angle => real_of(card, point_angle), force => reals_of(card, point_first))
         if (card%draft%position(1, node) > 0.0_wp) then
            loads = circle_loads(card%harmonics, angle, force)
            left_out = 1.0_wp  ! no series of finite length has a part of a concentrated force
         else
            loads = axis_loads(angle, force)
            left_out = share_of_axis(loads, card%harmonics)
         end if
      end associate
      call add_truncation(lists%truncations, 'POINTLOADS, node '//to_text(integer_of(card, 1))// &
                          ', theta = '//to_text(real_of(card, point_angle)), left_out, card%case)
      do k = 1, size(loads)
         if (.not. any(card%harmonics == loads(k)%mode%harmonic)) cycle
         if (.not. any(abs(loads(k)%force) > 0.0_wp)) cycle
         loads(k)%node = node
         loads(k)%case = card%case
         call add_ring_load(lists, loads(k))
      end do
   end subroutine read_point_load

   !> Modes of a concentrated force: its work on their unit amplitudes
   pure function circle_loads(harmonics, angle, force) result(loads)
      !> Harmonics in use
      integer, intent(in) :: harmonics(:)
      !> theta [degree]
      real(wp), intent(in) :: angle
      !> F_r, F_z, F_theta
      real(wp), intent(in) :: force(3)
      !> One load for each mode; the node is left open
      type(ring_load_type) :: loads(2*size(harmonics))

      real(wp) :: cosine, sine
      integer :: i

      do i = 1, size(harmonics)
         cosine = cosine_of_degrees(harmonics(i)*angle)
         sine = sine_of_degrees(harmonics(i)*angle)
         loads(2*i - 1)%mode = mode_type(harmonics(i), family_symmetric)
         loads(2*i - 1)%force = force*[cosine, cosine, sine]
         loads(2*i)%mode = mode_type(harmonics(i), family_antisymmetric)
         loads(2*i)%force = force*[sine, sine, -cosine]
      end do
   end function circle_loads

   !> Modes of a force on the axis: axial in harmonic 0, the lateral components along
   !> theta = 0 and 90 in harmonic 1, counted with u
   pure function axis_loads(angle, force) result(loads)
      !> Angle at which F_r and F_theta are directed [degree]
      real(wp), intent(in) :: angle
      !> F_r, F_z, F_theta
      real(wp), intent(in) :: force(3)
      !> The loads; the node is left open
      type(ring_load_type) :: loads(3)

      real(wp) :: cosine, sine

      cosine = cosine_of_degrees(angle)
      sine = sine_of_degrees(angle)
      loads%mode = [mode_type(0, family_symmetric), mode_type(1, family_symmetric), &
                    mode_type(1, family_antisymmetric)]
      loads(1)%force = [0.0_wp, force(2), 0.0_wp]
      loads(2)%force = [force(1)*cosine - force(3)*sine, 0.0_wp, 0.0_wp]
      loads(3)%force = [force(1)*sine + force(3)*cosine, 0.0_wp, 0.0_wp]
   end function axis_loads

   !> What the harmonics leave of a force on the axis, over the force
   pure real(wp) function share_of_axis(loads, harmonics) result(share)
      !> The loads of the three components
      type(ring_load_type), intent(in) :: loads(3)
      !> Harmonics in use
      integer, intent(in) :: harmonics(:)

      real(wp) :: size_of(3)
      logical :: lost(3)
      integer :: i

      do i = 1, 3
         size_of(i) = norm2(loads(i)%force)
         lost(i) = .not. any(harmonics == loads(i)%mode%harmonic)
      end do
      share = 0.0_wp
      if (any(size_of > 0.0_wp)) share = norm2(merge(size_of, 0.0_wp, lost))/norm2(size_of)
   end function share_of_axis

end module axijoint_deck_load_node_loads
