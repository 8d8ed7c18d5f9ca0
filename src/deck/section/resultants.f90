!> RESULTANTS: tractions on faces with a given resultant
module axijoint_deck_section_resultants
   use axijoint_base_kinds, only : wp, pi
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_loaded_face
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_modes, only : needs_harmonic
   use axijoint_deck_load_lists, only : add_tractions
   use axijoint_deck_load_shares, only : share_type, directed_shares
   use axijoint_deck_mesh_face_geometry, only : moment_of_radius
   use axijoint_deck_text_common_fields, only : face_field => face, angle
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_sound, field_fault
   use axijoint_deck_text_field, only : real_field, word_field, described
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric
   implicit none
   private
   public :: resultants_section

   !> The keyword
   character(len=*), parameter :: keyword_resultants = 'RESULTANTS'
   !> Fields
   integer, parameter :: field_face = 1, field_kind = 2, field_value = 3, field_direction = 4
   !> Words of the kind, and their places
   character(len=7), parameter :: kinds(4) = [character(len=7) :: 'LATERAL', 'MOMENT', 'AXIAL', &
      'TORQUE']
   integer, parameter :: kind_lateral = 1, kind_moment = 2, kind_axial = 3, kind_torque = 4

contains

   !> RESULTANTS
   function resultants_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_resultants
      section%purpose = 'tractions on faces with a given resultant'
      section%is_load = .true.
      section%stage = stage_loads
      section%read => read_resultants
      section%fields = &
         [face_field(1), described(word_field('the kind of resultant', 6, 15, kinds), 'kind'), &
          described(real_field('the value', 16), &
                    'value [force], [force × length] of MOMENT and TORQUE', &
                    limits='any'), &
          described(angle('theta0', 26), 'direction θ0 [degree] of LATERAL and MOMENT')]
   end function resultants_section

   !> Add the tractions
   subroutine read_resultants(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_resultants)
      do while (next_card(card))
         call read_resultant(card)
      end do
   end subroutine read_resultants

   !> Tractions with a given resultant: for a lateral force H t_r = H/A, t_theta = -H/A
   !> in harmonic 1; for a moment M t_z = M r/I there; for an axial force N t_z = N/A; for
   !> a torque T t_theta = T r/(2 I), whose amplitude is the negative of it
   subroutine read_resultant(card)
      !> A card of RESULTANTS
      type(card_type), intent(in) :: card

      character(len=15), parameter :: name(4) = &
         [character(len=15) :: 'a lateral force', 'a moment', &
                                                                      'an axial force', 'a torque']
      type(share_type), allocatable :: shares(:)
      real(wp), allocatable :: traction(:, :, :)
      integer :: face, i, k
      real(wp) :: mean

      call find_loaded_face(card, field_face, face)
      if (is_given(card, field_kind)) then
         associate (kind => integer_of(card, field_kind))
            call needs_harmonic(card, merge(1, 0, kind <= kind_moment), trim(name(kind)))
            if (kind > kind_moment .and. is_given(card, field_direction)) then
               call field_fault(card, field_direction, trim(name(kind))//' has no direction', &
                                allowed='blank')
            end if
         end associate
      end if
      if (face == 0 .or. .not. is_sound(card)) return
      associate (kind => integer_of(card, field_kind), edges => card%deck%draft%faces(face)%edges)
         mean = real_of(card, field_value) &
                /moment_of_radius(card%deck%draft, edges, &
                                  merge(3, 1, kind == kind_moment .or. kind == kind_torque))
         allocate (traction(3, 3, size(edges)), source=0.0_wp)
         do i = 1, size(edges)
            do k = 1, count(edges(i)%nodes > 0)
               traction(:, k, i) = mean*resultant_traction(kind, &
                  card%deck%draft%position(1, edges(i)%nodes(k)))
            end do
         end do
         if (kind <= kind_moment) shares = directed_shares(real_of(card, field_direction))
         if (kind == kind_axial) shares = [share_type(mode_type(0, family_symmetric))]
         if (kind == kind_torque) shares = [share_type(mode_type(0, family_antisymmetric))]
         call add_tractions(card%deck%loads, card%case, edges, traction, shares)
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

end module axijoint_deck_section_resultants
