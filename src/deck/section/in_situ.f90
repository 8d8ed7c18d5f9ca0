!> INSITU: stress before all loads
module axijoint_deck_section_in_situ
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, check_body
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : any_body
   use axijoint_deck_job_modes, only : needs_harmonic
   use axijoint_deck_load_lists, only : add_initial_stress
   use axijoint_deck_text_common_fields, only : last_number
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_sound, &
      field_fault, lack_fault, &
      field_doubt, first_card
   use axijoint_deck_text_field, only : real_field, word_field, described
   use axijoint_model_load, only : initial_stress_type, covers, is_stressed, any_material
   implicit none
   private
   public :: in_situ_section

   !> The keyword
   character(len=*), parameter :: keyword_in_situ = 'INSITU'
   !> Fields
   integer, parameter :: field_body = 1, field_level = 2, field_gamma = 3, field_ratio = 4, &
      field_stress = 5, &
      field_material = 6, field_balance = 7
   !> Words of the last field; the second: out of balance on purpose
   character(len=5), parameter :: balances(2) = [character(len=5) :: 'CHECK', 'MEANT']
   integer, parameter :: balance_meant = 2
   !> K0 of ground: from loose ground under much friction, 1 - sin(phi), to ground that bore far
   !> more before
   real(wp), parameter :: least_ratio = 0.1_wp, largest_ratio = 5.0_wp

contains

   !> INSITU
   function in_situ_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_in_situ
      section%purpose = 'stress before all loads, σ_z = σ_zs + γ (z − z_s), σ_r = σ_θ = K0 σ_z'
      section%is_load = .true.
      section%stage = stage_loads
      section%read => read_in_situ
      section%fields = &
         [described(any_body(1), 'body', blank='all', &
                    limits='1 … 9999; one card an element and load case'), &
          described(real_field('z_s', 6), 'z_s [length]', limits='any'), &
          described(real_field('gamma', 16), 'γ [stress/length]', limits='any'), &
          real_field('K0', 26, from=0.0_wp, symbol='K0'), &
          described(real_field('sigma_z at z_s', 36, default=0.0_wp), 'σ_zs [stress]', &
          limits='any'), &
          described(last_number('the material', 46), &
                    'material: of the body''s elements of this material alone', &
                    blank='all', limits='of MATERIALS or ORTHOTROPIC'), &
          described(word_field('the balance', 51, 60, balances, 1), &
                    'CHECK, or MEANT: out of balance on purpose')]
   end function in_situ_section

   !> Add the stresses
   subroutine read_in_situ(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_in_situ)
      do while (next_card(card))
         call read_stress(card)
      end do
   end subroutine read_in_situ

   !> In-situ stress: sigma_z = sigma_zs + gamma (z - z_s), sigma_r = sigma_theta = K0 sigma_z
   subroutine read_stress(card)
      !> A card of INSITU
      type(card_type), intent(in) :: card

      type(initial_stress_type) :: new
      real(wp) :: ratio(4)

      call check_body(card, field_body)
      call needs_harmonic(card, 0, 'in-situ stress')
      new%case = card%case
      new%card = first_card(card)
      new%meant = integer_of(card, field_balance) == balance_meant
      if (is_given(card, field_body)) new%body = integer_of(card, field_body)
      call find_layer(card, new%material)
      if (is_sound(card)) call check_covered(card, new)
      if (.not. is_sound(card)) return
      ratio = [real_of(card, field_ratio), 1.0_wp, real_of(card, field_ratio), 0.0_wp]
      associate (gamma => real_of(card, field_gamma), z_s => real_of(card, field_level))
         new%stress = (real_of(card, field_stress) - gamma*z_s)*ratio
         new%gradient = gamma*ratio
      end associate
      call add_initial_stress(card%deck%loads, new)
      if (new%meant .or. .not. is_stressed(new)) return
      if (ratio(1) >= least_ratio .and. ratio(1) <= largest_ratio) return
      call field_doubt(card, field_ratio, 'K0 = '//to_text(ratio(1))// &
                       ' is not that of ground: about '// &
                       to_text(least_ratio)//' to '//to_text(largest_ratio), &
                       mend='correct K0, or write MEANT in columns 51-60: then nothing of the '// &
                       'card is doubted')
   end subroutine read_stress

   !> Find the material of an in-situ stress, or report it
   subroutine find_layer(card, material)
      !> A card of INSITU
      type(card_type), intent(in) :: card
      !> The material (index); `any_material` if the card names none
      integer, intent(out) :: material

      material = any_material
      if (.not. is_given(card, field_material)) return
      material = find_number(card%deck%properties%material_of, integer_of(card, field_material))
      if (material == 0) call lack_fault(card, field_material, &
                                         'material '//to_text(integer_of(card, field_material))// &
                                         ' is not defined', &
                                         allowed='a material of MATERIALS or ORTHOTROPIC')
   end subroutine find_layer

   !> Check that an in-situ stress is one of some elements, and that these have no other in its load
   !> case
   subroutine check_covered(card, new)
      !> A card of INSITU
      type(card_type), intent(in) :: card
      !> The in-situ stress
      type(initial_stress_type), intent(in) :: new

      logical, allocatable :: covered(:)
      integer :: k

      if (.not. card%deck%draft%elements_complete) return
      associate (body => card%deck%draft%element_body(:card%deck%draft%n_elements), &
                 material => card%deck%draft%element_material(:card%deck%draft%n_elements))
         covered = covers(new, body, material)
         if (.not. any(covered)) call field_fault(card, field_material, &
            'no element of the body has material '// &
                                                  to_text(integer_of(card, field_material)), &
                                                  allowed='a material of its elements')
         do k = 1, size(card%deck%loads%initial_stresses)
            associate (known => card%deck%loads%initial_stresses(k))
               if (known%case /= new%case .or. .not. any(covered &
                  .and. covers(known, body, material))) cycle
            end associate
            call field_fault(card, field_body, 'the body has an in-situ stress already', &
                             allowed='one INSITU card for an element in a load case; blank '// &
                             'means all bodies, all materials')
            return
         end do
      end associate
   end subroutine check_covered

end module axijoint_deck_section_in_situ
