!> LAWDETAILS: further properties of joint laws
module axijoint_deck_section_law_details
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_properties
   use axijoint_deck_property_properties, only : find_law
   use axijoint_deck_text_common_fields, only : number
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, field_fault, &
      card_fault, first_card
   use axijoint_deck_text_field, only : field_type, real_field, word_field, described
   use axijoint_deck_text_source, only : card_position
   use axijoint_element_joint_law, only : joint_law_type, law_elastic, slip_components, &
      slip_names, opening_names
   implicit none
   private
   public :: law_details_section

   !> The keyword
   character(len=*), parameter :: keyword_law_details = 'LAWDETAILS'
   !> Fields
   integer, parameter :: field_law = 1, field_slip = 2, field_opening = 3, field_cohesion = 4, &
      field_angle = 5, field_dilation = 6, field_gap = 7, field_stress = 8

contains

   !> LAWDETAILS
   function law_details_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_law_details
      section%purpose = 'slip by resultant, bonds, residual strength, dilation, gap, initial '// &
         'stress of a law'
      section%numbered = .true.
      section%stage = stage_properties
      section%read => read_law_details
      section%fields = [number('the law', 1), kind_fields(), strength_fields()]
      section%fields(field_law)%limits = 'of LAWS'
   end function law_details_section

   !> Fields of the kinds of slip and opening
   pure function kind_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      fields = [described(word_field('the kind of slip', 6, 15, slip_names, 1), &
                          'slip: COMPONENTS (τ_ξ and τ_θ are each cut to C − σ tan φ, as in '// &
                          'the paper), '// &
                          'RESULTANT (their resultant is)'), &
                described(word_field('the kind of opening', 16, 25, opening_names, 1), &
                          'opening: REVERSIBLE (a point that closes has its cohesion as '// &
                          'before, as in the '// &
                          'paper), BOND (holds tension until it breaks for good; then C = 0)')]
   end function kind_fields

   !> Fields of the other details
   pure function strength_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      fields = [described(real_field('the residual cohesion', 26, from=0.0_wp, default=0.0_wp, &
         symbol='C'), &
                          'residual cohesion, once a point has slipped [stress]', blank='C', &
                          limits='0 … C'), &
                described(real_field('the residual friction angle', 36, from=0.0_wp, &
                below=90.0_wp, &
                                     default=0.0_wp, symbol='phi'), &
                          'residual friction angle [degree]', blank='φ', limits='0 … φ'), &
                described(real_field('the angle of dilation', 46, from=0.0_wp, below=90.0_wp, &
                default=0.0_wp, &
                                     symbol='psi'), &
                          'angle of dilation ψ [degree]: slip s opens the joint by s tan ψ, '// &
                          'either way; a '// &
                          'joint that stands open by less presses', &
                          limits='0 … φ; only with RESULTANT'), &
                described(real_field('the gap', 56, from=0.0_wp, default=0.0_wp, symbol='gap'), &
                          'gap before loading [length]'), &
                described(real_field('the initial normal stress', 66, to=0.0_wp, default=0.0_wp, &
                symbol='sigma'), &
                          'initial normal stress, in equilibrium with what is not modelled '// &
                          '[stress]', &
                          limits='≤ 0; not with a gap')]
   end function strength_fields

   !> Read the details into the laws
   subroutine read_law_details(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: law, first(size(deck%properties%laws))

      first = 0
      card = cards_of(deck, keyword_law_details)
      do while (next_card(card))
         call find_law(card, field_law, deck%properties, law)
         if (law == 0) cycle
         if (first(law) > 0) then
            call field_fault(card, field_law, 'the details of law '// &
                             to_text(deck%properties%laws(law)%label)// &
                             ' are given twice, first on '// &
                             card_position(deck%source, first(law), first_card(card)))
            cycle
         end if
         first(law) = first_card(card)
         if (.not. is_good(card)) cycle
         call take_details(card, deck%properties%laws(law)%law)
         call check_details(card, deck%properties%laws(law)%law)
      end do
   end subroutine read_law_details

   !> The details of one law
   pure subroutine take_details(card, law)
      !> The card
      type(card_type), intent(in) :: card
      !> The law
      type(joint_law_type), intent(inout) :: law

      law%slip = integer_of(card, field_slip)
      law%opening = integer_of(card, field_opening)
      law%softens = is_given(card, field_cohesion) .or. is_given(card, field_angle)
      law%residual_cohesion = law%cohesion
      law%residual_friction = law%friction
      if (is_given(card, field_cohesion)) law%residual_cohesion = real_of(card, field_cohesion)
      if (is_given(card, field_angle)) &
         law%residual_friction = tan(degree*real_of(card, field_angle))
      law%dilation = tan(degree*real_of(card, field_dilation))
      law%gap = real_of(card, field_gap)
      law%initial_stress = real_of(card, field_stress)
   end subroutine take_details

   !> Check that the details fit each other and the law
   subroutine check_details(card, law)
      !> The card
      type(card_type), intent(in) :: card
      !> The law
      type(joint_law_type), intent(in) :: law

      if (law%kind == law_elastic) then
         call card_fault(card, 'an elastic joint has no details of opening and slip', &
                          mend='delete the card, or write PAPER instead of ELASTIC in LAWS')
         return
      end if
      if (law%residual_cohesion > law%cohesion) then
         call field_fault(card, field_cohesion, &
                          'the residual cohesion exceeds the cohesion '//to_text(law%cohesion), &
                          allowed='at most the cohesion of LAWS')
      end if
      if (law%residual_friction > law%friction) then
         call field_fault(card, field_angle, &
                          'the residual friction angle exceeds the friction angle', &
                          allowed='at most the angle of LAWS')
      end if
      if (law%dilation > 0.0_wp .and. law%slip == slip_components) then
         call field_fault(card, field_dilation, &
                          'dilation needs a slip of one direction', allowed='0 with COMPONENTS', &
                          mend='write RESULTANT in columns 6-15')
      end if
      if (law%dilation > law%friction) then
         call field_fault(card, field_dilation, &
                          'the angle of dilation exceeds the friction angle', &
                          allowed='at most the friction angle: more would give energy')
      end if
      if (law%gap > 0.0_wp .and. law%initial_stress < 0.0_wp) then
         call field_fault(card, field_stress, &
                          'a joint that stands open carries no stress', allowed='0 with a gap', &
                          mend='leave the gap or the initial stress blank')
      end if
   end subroutine check_details

end module axijoint_deck_section_law_details
