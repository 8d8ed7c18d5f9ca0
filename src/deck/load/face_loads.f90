!> Loads on faces: TRACTIONS, PRESSURES, RESULTANTS
module axijoint_deck_load_face_loads
   use axijoint_base_kinds, only : wp, pi
   use axijoint_deck_load_card, only : load_card_type, is_given, integer_of, real_of, reals_of, &
      field_fault, is_sound, find_loaded_face
   use axijoint_deck_load_lists, only : load_lists_type, add_tractions
   use axijoint_deck_load_modes, only : share_type, read_shares, directed_shares, check_components, &
      check_torsion, needs_harmonic
   use axijoint_deck_mesh_face_geometry, only : linear_along, inward_normals, moment_of_radius
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric
   implicit none
   private
   public :: read_traction, read_pressure, read_resultant

   !> Fields of TRACTIONS and PRESSURES: values at both ends of the face
   integer, parameter :: traction_first = 3, traction_last = 6, pressure_first = 3, pressure_last = 4
   !> Fields of RESULTANTS
   integer, parameter :: field_kind = 2, field_value = 3, field_direction = 4
   !> Places of its words LATERAL, MOMENT, AXIAL and TORQUE
   integer, parameter :: kind_lateral = 1, kind_moment = 2, kind_axial = 3, kind_torque = 4

contains

   !> Tractions that vary linearly with the arc length between the ends of a face
   subroutine read_traction(card, lists)
      !> A card of TRACTIONS
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(share_type), allocatable :: shares(:)
      real(wp) :: last(3)
      integer :: face, i

      if (card%table%good(card%entry) .and. &
          .not. any([(is_given(card, traction_first + i), i=0, 5)])) then
         call field_fault(card, traction_first, 'the card gives no load', &
                          allowed='at least one amplitude; blank ones are 0')
      end if
      call check_components(card, 'load', traction_first, 6)
      call find_loaded_face(card, face)
      call read_shares(card, shares, lists%truncations)
      if (face == 0 .or. .not. is_sound(card)) return
      last = merge(reals_of(card, traction_last), reals_of(card, traction_first), &
                   [(is_given(card, traction_last + i), i=0, 2)])
      associate (edges => card%draft%faces(face)%edges)
         call add_tractions(lists, card%case, edges, &
                            linear_along(card%draft, edges, reals_of(card, traction_first), last), shares)
      end associate
   end subroutine read_traction

   !> Pressure that varies linearly with the arc length, along the normals at the nodes
   subroutine read_pressure(card, lists)
      !> A card of PRESSURES
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(share_type), allocatable :: shares(:)
      real(wp), allocatable :: pressure(:, :, :), normal(:, :, :), traction(:, :, :)
      real(wp) :: last
      integer :: face

      call check_torsion(card, 'pressure')
      call find_loaded_face(card, face)
      call read_shares(card, shares, lists%truncations)
      if (face == 0 .or. .not. is_sound(card)) return
      last = real_of(card, merge(pressure_last, pressure_first, is_given(card, pressure_last)))
      associate (edges => card%draft%faces(face)%edges)
         allocate (traction(3, 3, size(edges)), source=0.0_wp)
         pressure = linear_along(card%draft, edges, [real_of(card, pressure_first)], [last])
         normal = inward_normals(card%draft, edges)
         traction(1, :, :) = pressure(1, :, :)*normal(1, :, :)
         traction(2, :, :) = pressure(1, :, :)*normal(2, :, :)
         call add_tractions(lists, card%case, edges, traction, shares)
      end associate
   end subroutine read_pressure

   !> Tractions with a given resultant: for a lateral force H t_r = H/A, t_theta = -H/A
   !> in harmonic 1; for a moment M t_z = M r/I there; for an axial force N t_z = N/A; for
   !> a torque T t_theta = T r/(2 I), whose amplitude is the negative of it
   subroutine read_resultant(card, lists)
      !> A card of RESULTANTS
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      character(len=15), parameter :: name(4) = [character(len=15) :: 'a lateral force', 'a moment', &
                                                                      'an axial force', 'a torque']
      type(share_type), allocatable :: shares(:)
      real(wp), allocatable :: traction(:, :, :)
      integer :: face, i, k
      real(wp) :: mean

      call find_loaded_face(card, face)
      if (is_given(card, field_kind)) then
         associate (kind => integer_of(card, field_kind))
            call needs_harmonic(card, merge(1, 0, kind <= kind_moment), trim(name(kind)))
            if (kind > kind_moment .and. is_given(card, field_direction)) then
               call field_fault(card, field_direction, trim(name(kind))//' has no direction', allowed='blank')
            end if
         end associate
      end if
      if (face == 0 .or. .not. is_sound(card)) return
      associate (kind => integer_of(card, field_kind), edges => card%draft%faces(face)%edges)
         mean = real_of(card, field_value) &
                /moment_of_radius(card%draft, edges, merge(3, 1, kind == kind_moment .or. kind == kind_torque))
         allocate (traction(3, 3, size(edges)), source=0.0_wp)
         do i = 1, size(edges)
            do k = 1, count(edges(i)%nodes > 0)
               traction(:, k, i) = mean*resultant_traction(kind, card%draft%position(1, edges(i)%nodes(k)))
            end do
         end do
         if (kind <= kind_moment) shares = directed_shares(real_of(card, field_direction))
         if (kind == kind_axial) shares = [share_type(mode_type(0, family_symmetric))]
         if (kind == kind_torque) shares = [share_type(mode_type(0, family_antisymmetric))]
         call add_tractions(lists, card%case, edges, traction, shares)
      end associate
   end subroutine read_resultant

   !> Amplitudes of the traction of a resultant, for a value of 1 and an integral of r ds or
   !> r**3 ds of 1
   pure function resultant_traction(kind, r) result(traction)
      !> One of the `kind_` parameters
      integer, intent(in) :: kind
      !> Distance from the axis
      real(wp), intent(in) :: r
      !> Along r, z and theta
      real(wp) :: traction(3)

      select case (kind)
      case (kind_lateral)
         traction = [1.0_wp, 0.0_wp, -1.0_wp]/(2.0_wp*pi)
      case (kind_moment)
         traction = [0.0_wp, r, 0.0_wp]/pi
      case (kind_axial)
         traction = [0.0_wp, 1.0_wp, 0.0_wp]/(2.0_wp*pi)
      case default
         traction = [0.0_wp, 0.0_wp, -r]/(2.0_wp*pi)  ! w ~ -cos 0: u_theta is -w
      end select
   end function resultant_traction

end module axijoint_deck_load_face_loads
