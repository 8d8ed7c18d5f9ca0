!> Further properties of joint laws: LAWDETAILS
module axijoint_deck_property_law_details
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_deck_property_properties, only : properties_type, find_property
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type, card_position
   use axijoint_deck_text_table, only : table_type, integer_value, field_error, entry_error
   use axijoint_element_joint_law, only : joint_law_type, law_elastic, slip_components
   implicit none
   private
   public :: read_law_details

   !> Fields of LAWDETAILS
   integer, parameter :: field_law = 1, field_slip = 2, field_opening = 3, field_cohesion = 4, &
      field_angle = 5, field_dilation = 6, field_gap = 7, field_stress = 8

contains

   !> Read LAWDETAILS into the laws
   subroutine read_law_details(source, table, properties, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> LAWDETAILS
      type(table_type), intent(in) :: table
      !> Materials and laws
      type(properties_type), intent(inout) :: properties
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, law, first(size(properties%laws))

      first = 0
      do entry = 1, table%n
         call find_property(source, table, entry, field_law, properties%law_of, properties%laws_complete, &
                            'law', law, diagnostics)
         if (law == 0) cycle
         if (first(law) > 0) then
            call field_error(diagnostics, source, table, entry, field_law, 'the details of law '// &
                             to_text(properties%laws(law)%label)//' are given twice, first on '// &
                             card_position(source, table%cards(1, first(law)), table%cards(1, entry)))
            cycle
         end if
         first(law) = entry
         if (.not. table%good(entry)) cycle
         call take_details(table, entry, properties%laws(law)%law)
         call check_details(source, table, entry, properties%laws(law)%law, diagnostics)
      end do
   end subroutine read_law_details

   !> The details of one law
   pure subroutine take_details(table, entry, law)
      !> LAWDETAILS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The law
      type(joint_law_type), intent(inout) :: law

      law%slip = integer_value(table, field_slip, entry)
      law%opening = integer_value(table, field_opening, entry)
      law%softens = any(table%given(field_cohesion:field_angle, entry))
      law%residual_cohesion = law%cohesion
      law%residual_friction = law%friction
      if (table%given(field_cohesion, entry)) law%residual_cohesion = table%values(field_cohesion, entry)
      if (table%given(field_angle, entry)) law%residual_friction = tan(degree*table%values(field_angle, entry))
      law%dilation = tan(degree*table%values(field_dilation, entry))
      law%gap = table%values(field_gap, entry)
      law%initial_stress = table%values(field_stress, entry)
   end subroutine take_details

   !> Check that the details fit each other and the law
   subroutine check_details(source, table, entry, law, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> LAWDETAILS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The law
      type(joint_law_type), intent(in) :: law
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      if (law%kind == law_elastic) then
         call entry_error(diagnostics, table, entry, 'an elastic joint has no details of opening and slip', &
                          mend='delete the card, or write PAPER instead of ELASTIC in LAWS')
         return
      end if
      if (law%residual_cohesion > law%cohesion) then
         call field_error(diagnostics, source, table, entry, field_cohesion, &
                          'the residual cohesion exceeds the cohesion '//to_text(law%cohesion), &
                          allowed='at most the cohesion of LAWS')
      end if
      if (law%residual_friction > law%friction) then
         call field_error(diagnostics, source, table, entry, field_angle, &
                          'the residual friction angle exceeds the friction angle', &
                          allowed='at most the angle of LAWS')
      end if
      if (law%dilation > 0.0_wp .and. law%slip == slip_components) then
         call field_error(diagnostics, source, table, entry, field_dilation, &
                          'dilation needs a slip of one direction', allowed='0 with COMPONENTS', &
                          mend='write RESULTANT in columns 6-15')
      end if
      if (law%dilation > law%friction) then
         call field_error(diagnostics, source, table, entry, field_dilation, &
                          'the angle of dilation exceeds the friction angle', &
                          allowed='at most the friction angle: more would give energy')
      end if
      if (law%gap > 0.0_wp .and. law%initial_stress < 0.0_wp) then
         call field_error(diagnostics, source, table, entry, field_stress, &
                          'a joint that stands open carries no stress', allowed='0 with a gap', &
                          mend='leave the gap or the initial stress blank')
      end if
   end subroutine check_details

end module axijoint_deck_property_law_details
