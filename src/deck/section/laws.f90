!> LAWS: joint laws
module axijoint_deck_section_laws
   use axijoint_base_kinds, only : wp, degree
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_properties
   use axijoint_deck_property_properties, only : add_law
   use axijoint_deck_text_common_fields, only : number
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, reals_of, is_good, &
      field_fault
   use axijoint_deck_text_field, only : real_field, word_field, described
   use axijoint_element_joint_law, only : law_elastic, law_paper, law_names
   use axijoint_model_material, only : joint_material_type, rule_names, rule_centroid, rule_gauss, &
      rule_lobatto
   implicit none
   private
   public :: laws_section

   !> The keyword
   character(len=*), parameter :: keyword_laws = 'LAWS'
   !> Fields
   integer, parameter :: field_label = 1, field_stiffness = 2, field_cohesion = 5, &
      field_angle = 6, &
      field_kind = 7, field_rule = 8
   !> What the words for kinds and rules mean
   integer, parameter :: kind_of_word(2) = [law_paper, law_elastic]
   integer, parameter :: rule_of_word(3) = [rule_centroid, rule_gauss, rule_lobatto], word_gauss = 2

contains

   !> LAWS
   function laws_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_laws
      section%purpose = 'joint laws: relative displacements to stresses'
      section%numbered = .true.
      section%stage = stage_properties
      section%read => read_laws
      section%fields = &
         [number('the law', 1), &
          described(real_field('k_xi', 6, from=0.0_wp, symbol='k_xi'), 'k_ξ [stress/length]'), &
          described(real_field('k_eta', 16, above=0.0_wp, symbol='k_eta'), 'k_η [stress/length]'), &
          described(real_field('k_theta', 26, from=0.0_wp, symbol='k_theta'), &
          'k_θ [stress/length]'), &
          described(real_field('the cohesion', 36, from=0.0_wp, default=0.0_wp, symbol='C'), &
                    'cohesion C [stress]', limits='≥ 0; blank if ELASTIC'), &
          described(real_field('the friction angle', 46, from=0.0_wp, below=90.0_wp, &
                               default=0.0_wp, symbol='phi'), &
                    'friction angle φ [degree]', limits='0 ≤ φ < 90; blank if ELASTIC'), &
          described(word_field('the kind of law', 56, 65, law_names(kind_of_word), 1), &
                    'PAPER: opens in tension, slips at C − σ tan φ; ELASTIC: neither'), &
          described(word_field('the rule', 66, 75, rule_names, word_gauss), &
                    'rule: GAUSS, LOBATTO (points at the nodes), CENTROID (one point; 4-node '// &
                    'joints only)')]
   end function laws_section

   !> Add the laws
   subroutine read_laws(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(joint_material_type) :: law

      card = cards_of(deck, keyword_laws)
      do while (next_card(card))
         law%label = integer_of(card, field_label)
         law%law%stiffness = reals_of(card, field_stiffness, 3)
         law%law%cohesion = real_of(card, field_cohesion)
         law%law%friction = tan(degree*real_of(card, field_angle))
         law%law%kind = kind_of_word(integer_of(card, field_kind))
         law%rule = rule_of_word(integer_of(card, field_rule))
         call add_law(card, field_label, law, deck%properties)
         if (is_good(card) .and. law%law%kind == law_elastic) call check_elastic(card)
      end do
   end subroutine read_laws

   !> Check that an elastic law has no strength
   subroutine check_elastic(card)
      !> The card
      type(card_type), intent(in) :: card

      integer :: field

      do field = field_cohesion, field_angle
         if (.not. is_given(card, field)) cycle
         call field_fault(card, field, 'an elastic joint has no '// &
                          trim(card%table%fields(field)%name(5:)), &
                          allowed='blank', &
                          mend='leave the field blank, or write PAPER instead of ELASTIC')
      end do
   end subroutine check_elastic

end module axijoint_deck_section_laws
