!> Loads on the whole of the solids: GRAVITY, ROTATION, TEMPERATURES, NODETEMPS, INSITU
module axijoint_deck_load_mass_loads
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_load_card, only : load_card_type, is_given, integer_of, real_of, field_fault, &
      field_doubt, is_sound, find_row, check_body
   use axijoint_deck_load_lists, only : load_lists_type, add_temperatures
   use axijoint_deck_load_modes, only : share_type, read_shares, directed_shares, check_torsion, &
      needs_harmonic
   use axijoint_fe_mode, only : mode_type, family_symmetric
   use axijoint_model_load, only : body_load_type, initial_stress_type, covers, is_stressed, any_material
   implicit none
   private
   public :: read_gravity, read_rotation, read_temperature, read_node_temperature, read_in_situ

   !> Fields of GRAVITY
   integer, parameter :: gravity_z = 1, gravity_lateral = 2, gravity_direction = 3
   !> Fields of TEMPERATURES: constant and growth along r and z; field of NODETEMPS
   integer, parameter :: temperature_0 = 3, temperature_r = 4, temperature_z = 5, temperature_node = 5
   !> Fields of INSITU
   integer, parameter :: in_situ_level = 2, in_situ_gamma = 3, in_situ_ratio = 4, in_situ_stress = 5, &
      in_situ_material = 6, in_situ_balance = 7
   !> Word of the last field: out of balance on purpose
   integer, parameter :: balance_meant = 2
   !> K0 of ground: from loose ground under much friction, 1 - sin(phi), to ground that bore far more before
   real(wp), parameter :: least_ratio = 0.1_wp, largest_ratio = 5.0_wp

contains

   !> Gravity along z, and lateral gravity: a_r = g cos(theta - theta0), a_theta = -g sin(..)
   subroutine read_gravity(card, lists)
      !> A card of GRAVITY
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(share_type) :: shares(2)
      logical :: along_z, lateral
      integer :: k

      along_z = abs(real_of(card, gravity_z)) > 0.0_wp
      lateral = abs(real_of(card, gravity_lateral)) > 0.0_wp
      if (.not. (along_z .or. lateral) .and. card%table%good(card%entry)) then
         call field_fault(card, gravity_z, 'the card gives no load', allowed='g_z, lateral g, or both')
      end if
      if (along_z) call needs_harmonic(card, 0, 'gravity along z')
      if (lateral) call needs_harmonic(card, 1, 'lateral gravity')
      if (.not. is_sound(card)) return
      if (along_z) lists%body_loads = [lists%body_loads, body_load_type(mode_type(0, family_symmetric), &
         card%case, [0.0_wp, real_of(card, gravity_z), 0.0_wp])]
      shares = directed_shares(real_of(card, gravity_direction))
      do k = 1, 2
         associate (g => shares(k)%factor*real_of(card, gravity_lateral))
            if (.not. any(abs(g) > 0.0_wp)) cycle
            lists%body_loads = [lists%body_loads, body_load_type(shares(k)%mode, card%case, &
                                                                 [g(1), 0.0_wp, -g(3)])]
         end associate
      end do
   end subroutine read_gravity

   !> Rotation about the axis
   subroutine read_rotation(card, lists)
      !> A card of ROTATION
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      call needs_harmonic(card, 0, 'rotation')
      if (any(lists%body_loads%case == card%case .and. lists%body_loads%spin_squared > 0.0_wp)) then
         call field_fault(card, 1, 'the load case has a rotation already', &
                          allowed='one angular velocity in a load case', &
                          mend='centrifugal forces go with its square: they do not add up')
      end if
      if (.not. is_sound(card)) return
      lists%body_loads = [lists%body_loads, body_load_type(mode_type(0, family_symmetric), card%case, &
                                                           spin_squared=real_of(card, 1)**2)]
   end subroutine read_rotation

   !> Temperature that is linear in r and z
   subroutine read_temperature(card, lists)
      !> A card of TEMPERATURES
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(share_type), allocatable :: shares(:)
      integer :: k, field

      if (card%table%good(card%entry) .and. &
          .not. any([(is_given(card, field), field=temperature_0, temperature_z)])) then
         call field_fault(card, temperature_0, 'the card gives no temperature', &
                          allowed='T0, dT/dr, dT/dz: one at least')
      end if
      call check_body(card)
      call check_torsion(card, 'temperature')
      call read_shares(card, shares, lists%truncations)
      if (.not. is_sound(card)) return
      associate (x => card%draft%position(:, :card%draft%n_nodes))
         call add_shares(card, shares, integer_of(card, 1), [(k, k=1, card%draft%n_nodes)], &
                         real_of(card, temperature_0) + real_of(card, temperature_r)*x(1, :) &
                         + real_of(card, temperature_z)*x(2, :), lists)
      end associate
   end subroutine read_temperature

   !> Temperature of a row of nodes
   subroutine read_node_temperature(card, lists)
      !> A card of NODETEMPS
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(share_type), allocatable :: shares(:)
      integer, allocatable :: nodes(:)
      integer :: k

      call check_torsion(card, 'temperature')
      call find_row(card, nodes)
      call read_shares(card, shares, lists%truncations)
      if (size(nodes) == 0 .or. .not. is_sound(card)) return
      call add_shares(card, shares, 0, nodes, [(real_of(card, temperature_node), k=1, size(nodes))], lists)
   end subroutine read_node_temperature

   !> Add a temperature in each mode: it goes with cos in the symmetric and with sin in
   !> the antisymmetric family
   subroutine add_shares(card, shares, body, nodes, temperature, lists)
      !> The card
      type(load_card_type), intent(in) :: card
      !> What each mode takes
      type(share_type), intent(in) :: shares(:)
      !> Body; 0 for all
      integer, intent(in) :: body
      !> Nodes, and their temperatures
      integer, intent(in) :: nodes(:)
      real(wp), intent(in) :: temperature(:)
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      integer :: k

      do k = 1, size(shares)
         associate (factor => shares(k)%factor(1))
            if (.not. abs(factor) > 0.0_wp) cycle
            call add_temperatures(lists, card%case, shares(k)%mode, body, nodes, factor*temperature)
         end associate
      end do
   end subroutine add_shares

   !> In-situ stress: sigma_z = sigma_zs + gamma (z - z_s), sigma_r = sigma_theta = K0 sigma_z
   subroutine read_in_situ(card, lists)
      !> A card of INSITU
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      type(initial_stress_type) :: new
      real(wp) :: ratio(4)

      call check_body(card)
      call needs_harmonic(card, 0, 'in-situ stress')
      new%case = card%case
      new%card = card%table%cards(1, card%entry)
      new%meant = integer_of(card, in_situ_balance) == balance_meant
      if (is_given(card, 1)) new%body = integer_of(card, 1)
      call find_material(card, new%material)
      if (is_sound(card)) call check_covered(card, lists, new)
      if (.not. is_sound(card)) return
      ratio = [real_of(card, in_situ_ratio), 1.0_wp, real_of(card, in_situ_ratio), 0.0_wp]
      associate (gamma => real_of(card, in_situ_gamma), z_s => real_of(card, in_situ_level))
         new%stress = (real_of(card, in_situ_stress) - gamma*z_s)*ratio
         new%gradient = gamma*ratio
      end associate
      lists%initial_stresses = [lists%initial_stresses, new]
      if (new%meant .or. .not. is_stressed(new)) return
      if (ratio(1) >= least_ratio .and. ratio(1) <= largest_ratio) return
      call field_doubt(card, in_situ_ratio, 'K0 = '//to_text(ratio(1))//' is not that of ground: about '// &
                       to_text(least_ratio)//' to '//to_text(largest_ratio), &
                       mend='correct K0, or write MEANT in columns 51-60: then nothing of the card is doubted')
   end subroutine read_in_situ

   !> Find the material of an in-situ stress, or report it
   subroutine find_material(card, material)
      !> A card of INSITU
      type(load_card_type), intent(in) :: card
      !> The material (index); `any_material` if the card names none
      integer, intent(out) :: material

      material = any_material
      if (.not. is_given(card, in_situ_material)) return
      material = find_number(card%material_of, integer_of(card, in_situ_material))
      if (material == 0) call field_fault(card, in_situ_material, &
                                          'material '//to_text(integer_of(card, in_situ_material))//' is not defined', &
                                          allowed='a material of MATERIALS or ORTHOTROPIC')
   end subroutine find_material

   !> Check that an in-situ stress is one of some elements, and that these have no other in its load case
   subroutine check_covered(card, lists, new)
      !> A card of INSITU
      type(load_card_type), intent(in) :: card
      !> The loads before it
      type(load_lists_type), intent(in) :: lists
      !> The in-situ stress
      type(initial_stress_type), intent(in) :: new

      logical, allocatable :: covered(:)
      integer :: k

      if (.not. card%draft%elements_complete) return
      associate (body => card%draft%element_body(:card%draft%n_elements), &
                 material => card%draft%element_material(:card%draft%n_elements))
         covered = covers(new, body, material)
         if (.not. any(covered)) call field_fault(card, in_situ_material, 'no element of the body has material '// &
                                                  to_text(integer_of(card, in_situ_material)), &
                                                  allowed='a material of its elements')
         do k = 1, size(lists%initial_stresses)
            associate (known => lists%initial_stresses(k))
               if (known%case /= new%case .or. .not. any(covered .and. covers(known, body, material))) cycle
            end associate
            call field_fault(card, 1, 'the body has an in-situ stress already', &
                             allowed='one INSITU card for an element in a load case; blank means all bodies, all materials')
            return
         end do
      end associate
   end subroutine check_covered

end module axijoint_deck_load_mass_loads
