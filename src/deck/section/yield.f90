!> YIELD: solids that yield
module axijoint_deck_section_yield
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_properties
   use axijoint_deck_property_properties, only : find_material
   use axijoint_deck_section_control, only : keyword_control, field_harmonic, field_method, &
      field_body_method, field_body_planes
   use axijoint_deck_text_common_fields, only : number
   use axijoint_deck_text_diagnostics, only : add_error
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, field_fault, field_doubt, &
      first_card
   use axijoint_deck_text_field, only : field_type, real_field, word_field, described
   use axijoint_deck_text_source, only : card_position
   use axijoint_element_yield_law, only : yield_law_type, yield_tresca, yield_mises, &
      criterion_names
   use axijoint_model_material, only : solid_material_type
   use axijoint_model_model, only : model_type, bodies_yield, can_yield, method_transfer, &
      body_lbfgs
   implicit none
   private
   public :: yield_section, check_yielding

   !> The keyword
   character(len=*), parameter :: keyword_yield = 'YIELD'
   !> Fields
   integer, parameter :: field_material = 1, field_criterion = 2, field_strength = 3, &
      field_friction = 4, field_dilation = 5, field_hardening = 6, field_tension = 7

contains

   !> YIELD
   function yield_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_yield
      section%purpose = 'solids that yield: criterion, strength, friction, dilation, hardening'
      section%numbered = .true.
      section%stage = stage_properties
      section%read => read_yield
      section%fields = [number('the material', 1), strength_fields(), flow_fields()]
      section%fields(field_material)%limits = 'of MATERIALS'
   end function yield_section

   !> Fields of criterion and strength
   pure function strength_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      fields = [described(word_field('the criterion', 6, 15, criterion_names(yield_tresca:)), &
                          'criterion: TRESCA, MISES; MOHR (Mohr and Coulomb), DRUCKER (Drucker '// &
                          'and Prager, the cone through MOHR in triaxial compression)'), &
                described(real_field('the strength', 16, from=0.0_wp, symbol='strength'), &
                          'strength [stress]: of TRESCA and MISES the uniaxial yield stress '// &
                          '(2 s_u and √3 s_u for an undrained shear strength s_u), of MOHR and '// &
                          'DRUCKER the cohesion c', limits='≥ 0; > 0 without friction'), &
                described(real_field('the friction angle', 26, from=0.0_wp, below=90.0_wp, &
                                     default=0.0_wp, symbol='phi'), &
                          'friction angle φ of MOHR and DRUCKER [degree]', limits='0 ≤ φ < 90')]
   end function strength_fields

   !> Fields of what happens at yield
   pure function flow_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      fields = [described(real_field('the angle of dilation', 36, from=0.0_wp, below=90.0_wp, &
                                     default=0.0_wp, symbol='psi'), &
                          'angle of dilation ψ of MOHR and DRUCKER [degree]', &
                          limits='0 ≤ ψ ≤ φ'), &
                described(real_field('the hardening', 46, from=0.0_wp, default=0.0_wp, &
                                     symbol="H'"), &
                          "hardening H' [stress]: what the strength gains by a uniaxial plastic strain of one, TRESCA and "// &
                          "MISES; of MOHR the cohesion gains 2 cos φ/(1 − sin ψ) H' by one in axial compression", &
                          limits="H' ≥ 0"), &
                described(real_field('the tension', 56, from=0.0_wp, default=0.0_wp, &
                                     symbol='tension'), &
                          'tension that is borne at most [stress]: of TRESCA and MOHR the '// &
                          'largest principal stress, of MISES and DRUCKER the mean stress', &
                          blank='what the criterion allows', &
                          limits='≥ 0; below the apex of MOHR and DRUCKER')]
   end function flow_fields

   !> Let materials yield
   subroutine read_yield(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: material, first(size(deck%properties%materials))

      first = 0
      card = cards_of(deck, keyword_yield)
      do while (next_card(card))
         call find_material(card, field_material, deck%properties, material)
         if (material == 0) cycle
         if (first(material) > 0) then
            call field_fault(card, field_material, 'how material '// &
                             to_text(deck%properties%materials(material)%label)// &
                             ' yields is given twice, first on '// &
                             card_position(deck%source, first(material), first_card(card)))
            cycle
         end if
         first(material) = first_card(card)
         if (deck%properties%materials(material)%orthotropic) then
            call field_fault(card, field_material, 'orthotropic materials do not yield', &
                             allowed='a material of MATERIALS')
            cycle
         end if
         if (.not. is_good(card)) cycle
         call take_law(card, deck%properties%materials(material))
         call check_law(card, deck%properties%materials(material)%yield)
      end do
   end subroutine read_yield

   !> The constants of a material that yields
   pure subroutine take_law(card, material)
      !> The card
      type(card_type), intent(in) :: card
      !> The material
      type(solid_material_type), intent(inout) :: material

      associate (law => material%yield)
         law%criterion = integer_of(card, field_criterion)
         law%shear = 0.5_wp*material%young/(1.0_wp + material%poisson)
         law%bulk = material%young/(3.0_wp*(1.0_wp - 2.0_wp*material%poisson))
         law%strength = real_of(card, field_strength)
         law%friction = degree*real_of(card, field_friction)
         law%dilation = degree*real_of(card, field_dilation)
         law%hardening = real_of(card, field_hardening)
         if (is_given(card, field_tension)) law%tension = real_of(card, field_tension)
      end associate
   end subroutine take_law

   !> Check that the constants fit each other and the criterion
   subroutine check_law(card, law)
      !> The card
      type(card_type), intent(in) :: card
      !> The constants
      type(yield_law_type), intent(in) :: law

      character(len=:), allocatable :: name

      name = trim(criterion_names(law%criterion))
      if (any(law%criterion == [yield_tresca, yield_mises])) then
         if (law%friction > 0.0_wp) call field_fault(card, field_friction, &
            'a friction angle means nothing to '//name, allowed='blank, or 0', &
            mend='write MOHR or DRUCKER for a solid with friction')
         if (law%dilation > 0.0_wp) call field_fault(card, field_dilation, &
            'an angle of dilation means nothing to '//name, allowed='blank, or 0')
      else if (law%dilation > law%friction) then
         call field_fault(card, field_dilation, 'the angle of dilation is larger than that of '// &
            'friction: the solid would make work', &
            allowed='0 to phi = '//to_text(law%friction/degree))
      end if
      if (law%strength > 0.0_wp) then
         call check_tension(card, law)
      else if (.not. law%friction > 0.0_wp) then
         call field_fault(card, field_strength, 'a solid without friction and without strength '// &
            'bears nothing', allowed='> 0')
      else if (is_given(card, field_tension)) then
         call field_fault(card, field_tension, 'a solid without cohesion bears no tension', &
            allowed='blank: the apex of the criterion is at a stress of 0')
      end if
   end subroutine check_law

   !> Check that nothing is asked for that bodies that yield do not go with
   subroutine check_yielding(deck)
      !> The deck with its model
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      associate (model => deck%model)
         card = cards_of(deck, keyword_control)
         card%entry = 1
         if (.not. bodies_yield(model)) then
            call check_unused(card)
            return
         end if
         call check_method(card, model)
         if (model%method == method_transfer .and. can_yield(model)) call field_fault(card, &
            field_method, 'the loop of TRANSFER accumulates joint stress, which does not go '// &
            'with bodies that yield', allowed='NEWTON, ANDERSON or TOTAL')
         if (size(model%harmonics) <= model%max_harmonic) call field_fault(card, field_harmonic, &
            'bodies that yield couple all harmonics: HARMONICS may leave none out', &
            mend='no section HARMONICS; loads that repeat round the circle leave harmonics out '// &
            'by themselves')
         if (model%error_goal%wanted) call add_error(deck%diagnostics, 0, 0, 0, &
            'no rounds of refinement are made for bodies that yield, whose errors are told alone', &
            mend='no section ERROR; raise what the error budget of the listing names')
      end associate
   end subroutine check_yielding

   !> Check that nothing is said of bodies that yield where none can
   subroutine check_unused(card)
      !> CONTROL
      type(card_type), intent(in) :: card

      integer :: field

      do field = field_body_method, field_body_planes
         if (is_given(card, field)) call field_fault(card, field, 'no material yields', &
            allowed='blank', mend='a section YIELD, or leave the field blank')
      end do
   end subroutine check_unused

   !> Check that the method goes with the laws and the joints, and that planes see all harmonics
   subroutine check_method(card, model)
      !> CONTROL
      type(card_type), intent(in) :: card
      !> The job
      type(model_type), intent(in) :: model

      character(len=*), parameter :: others = 'ANDERSON, NEWTON or TRANSFER'
      logical :: associated_flow

      if (model%body_method == body_lbfgs .and. can_yield(model)) then
         call field_fault(card, field_body_method, 'LBFGS needs a potential, which joints '// &
            'that open or slip do not have', allowed=others)
      else if (model%body_method == body_lbfgs) then
         associate (laws => model%materials%yield)
            associated_flow = all(abs(laws%friction - laws%dilation) <= 0.0_wp)
         end associate
         if (.not. associated_flow) call field_fault(card, field_body_method, &
            'LBFGS needs a potential, which there is only if psi = phi in all materials', &
            allowed=others)
      end if
      if (model%n_body_planes == 0) return
      associate (m => model%max_harmonic)
         if (model%n_body_planes <= m) then
            call field_fault(card, field_body_planes, 'there are too few planes for harmonics up '// &
               'to '//to_text(m), allowed='at least M + 1 = '//to_text(m + 1)//' planes', &
               mend='leave the field blank: the default is 2 M + 1')
         else if (model%n_body_planes <= 2*m) then
            call field_doubt(card, field_body_planes, 'fewer than 2 M + 1 planes take '// &
               'harmonics up to '//to_text(m)//' for others than they are', &
               mend='leave the field blank: then there are enough for those that arise')
         end if
      end associate
   end subroutine check_method

   !> Check that a tension cut-off cuts anything off
   subroutine check_tension(card, law)
      !> The card
      type(card_type), intent(in) :: card
      !> The constants
      type(yield_law_type), intent(in) :: law

      real(wp) :: apex

      if (.not. is_given(card, field_tension) .or. .not. law%friction > 0.0_wp) return
      apex = law%strength/tan(law%friction)
      if (law%tension < apex) return
      call field_fault(card, field_tension, 'the tension is not below that of the apex, '// &
         'c cot(phi) = '//to_text(apex)//': it cuts nothing off', &
         allowed='blank, or less than the apex')
   end subroutine check_tension

end module axijoint_deck_section_yield
