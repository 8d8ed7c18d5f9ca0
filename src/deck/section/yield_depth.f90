!> YIELDDEPTH: strength that grows with depth
module axijoint_deck_section_yield_depth
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_properties
   use axijoint_deck_property_properties, only : find_material
   use axijoint_deck_text_common_fields, only : number
   use axijoint_deck_text_entry, only : real_of, is_good, field_fault, first_card
   use axijoint_deck_text_field, only : real_field, described
   use axijoint_deck_text_source, only : card_position
   use axijoint_element_yield_law, only : yield_none
   implicit none
   private
   public :: yield_depth_section

   !> The keyword
   character(len=*), parameter :: keyword_yield_depth = 'YIELDDEPTH'
   !> Fields
   integer, parameter :: field_material = 1, field_gradient = 2, field_level = 3

contains

   !> YIELDDEPTH
   function yield_depth_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_yield_depth
      section%purpose = 'strength of solids that yield, growing with depth'
      section%numbered = .true.
      section%stage = stage_properties
      section%read => read_yield_depth
      section%fields = [number('the material', 1), &
         described(real_field('the gradient', 6, above=0.0_wp, symbol='gradient'), &
                   'what the strength of YIELD gains by a unit of depth below z_s '// &
                   '[stress/length]'), &
         described(real_field('z_s', 16), 'z_s [length]; above it the strength is that of YIELD', &
                   limits='any')]
      section%fields(field_material)%limits = 'of YIELD'
   end function yield_depth_section

   !> Let the strength of materials grow with depth
   subroutine read_yield_depth(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      character(len=:), allocatable :: label
      integer :: material, first(size(deck%properties%materials))

      first = 0
      card = cards_of(deck, keyword_yield_depth)
      do while (next_card(card))
         call find_material(card, field_material, deck%properties, material)
         if (material == 0) cycle
         label = to_text(deck%properties%materials(material)%label)
         associate (law => deck%properties%materials(material)%yield)
            if (first(material) > 0) then
               call field_fault(card, field_material, 'the strength of material '//label// &
                                ' with depth is given twice, first on '// &
                                card_position(deck%source, first(material), first_card(card)))
               cycle
            end if
            first(material) = first_card(card)
            if (.not. is_good(card)) cycle
            if (law%criterion == yield_none) then
               if (deck%diagnostics%n_errors == 0) call field_fault(card, field_material, &
                  'material '//label//' does not yield', allowed='a material of YIELD')
               cycle
            end if
            law%gradient = real_of(card, field_gradient)
            law%level = real_of(card, field_level)
         end associate
      end do
   end subroutine read_yield_depth

end module axijoint_deck_section_yield_depth
