!> POINTLOADS: forces at points of nodal circles
module axijoint_deck_section_point_loads
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_node
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads, looked_at
   use axijoint_deck_load_lists, only : add_ring_load
   use axijoint_deck_load_shares, only : add_truncation
   use axijoint_deck_text_common_fields, only : node_field => node, angle_field => angle, &
      components, name_node
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, reals_of, is_good, &
      is_sound, field_fault
   use axijoint_deck_text_field, only : described
   use axijoint_fe_fourier, only : cosine_of_degrees, sine_of_degrees
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric
   use axijoint_model_load, only : ring_load_type
   implicit none
   private
   public :: point_loads_section

   !> The keyword
   character(len=*), parameter :: keyword_point_loads = 'POINTLOADS'
   !> Fields: the node, theta, three components
   integer, parameter :: field_node = 1, field_angle = 2, field_first = 3

contains

   !> POINTLOADS
   function point_loads_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_point_loads
      section%purpose = 'forces at points of nodal circles, in all harmonics'
      section%is_load = .true.
      section%stage = stage_loads
      section%read => read_point_loads
      section%fields = &
         [node_field(name_node, 1), described(angle_field('theta', 6), 'θ [degree]'), &
          described(components('F', '', 16), 'F_r F_z F_θ [force]', &
                    limits='one at least must be given')]
      section%fields(field_angle)%required = .true.
   end function point_loads_section

   !> Add the forces
   subroutine read_point_loads(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_point_loads)
      do while (next_card(card))
         call read_point_load(card)
      end do
   end subroutine read_point_loads

   !> A force at one point of a nodal circle, in all harmonics: those that are not in use are left out together
   subroutine read_point_load(card)
      !> A card of POINTLOADS
      type(card_type), intent(in) :: card

      type(ring_load_type), allocatable :: loads(:)
      real(wp) :: left_out
      integer :: node, k

      if (.not. any([(is_given(card, field_first + k), k=0, 2)]) .and. is_good(card)) then
         call field_fault(card, field_first, 'the card gives no load', &
                          allowed='at least one component; blank ones are 0')
      end if
      call find_node(card, field_node, node)
      if (node == 0 .or. .not. is_sound(card)) return
      associate (angle => real_of(card, field_angle), force => reals_of(card, field_first, 3))
         if (card%deck%draft%position(1, node) > 0.0_wp) then
            loads = circle_loads(looked_at(card%deck), angle, force)
            left_out = 1.0_wp  ! no series of finite length has a part of a concentrated force
         else
            loads = axis_loads(angle, force)
            left_out = share_of_axis(loads, card%deck%harmonics)
         end if
      end associate
      call add_truncation(card%deck%loads%truncations, 'POINTLOADS, node '// &
                          to_text(integer_of(card, field_node))// &
                          ', theta = '//to_text(real_of(card, field_angle)), left_out, card%case)
      do k = 1, size(loads)
         if (loads(k)%mode%harmonic > card%deck%highest) cycle
         if (.not. any(abs(loads(k)%force) > 0.0_wp)) cycle
         loads(k)%node = node
         loads(k)%case = card%case
         call add_ring_load(card%deck%loads, loads(k))
      end do
   end subroutine read_point_load

   !> Modes of a concentrated force: its work on their unit amplitudes
   pure function circle_loads(harmonics, angle, force) result(loads)
      !> Harmonics
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

end module axijoint_deck_section_point_loads
