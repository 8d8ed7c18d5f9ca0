!> MATERIALS: isotropic solids
module axijoint_deck_section_materials
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_properties
   use axijoint_deck_property_properties, only : add_material
   use axijoint_deck_text_common_fields, only : number
   use axijoint_deck_text_entry, only : integer_of, real_of
   use axijoint_deck_text_field, only : real_field, described
   use axijoint_model_material, only : solid_material_type
   implicit none
   private
   public :: materials_section

   !> The keyword
   character(len=*), parameter :: keyword_materials = 'MATERIALS'
   !> Fields
   integer, parameter :: field_label = 1, field_young = 2, field_poisson = 3, field_density = 4, &
      field_expansion = 5

contains

   !> MATERIALS
   function materials_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_materials
      section%purpose = 'isotropic solids'
      section%numbered = .true.
      section%stage = stage_properties
      section%read => read_materials
      section%fields = &
         [number('the material', 1), &
          described(real_field('Young''s modulus', 6, above=0.0_wp, symbol='E'), &
                    'Young''s modulus E [stress]'), &
          described(real_field('Poisson''s ratio', 16, from=0.0_wp, below=0.5_wp, symbol='nu'), &
                    'Poisson''s ratio ν', &
                    limits='0 ≤ ν < 0.5 (negative ratios are not accepted)'), &
          described(real_field('the density', 26, from=0.0_wp, default=0.0_wp, symbol='density'), &
                    'density [mass/volume]'), &
          described(real_field('the thermal expansion', 36, default=0.0_wp), &
                    'thermal expansion [1/temperature]')]
   end function materials_section

   !> Add the materials
   subroutine read_materials(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(solid_material_type) :: material

      card = cards_of(deck, keyword_materials)
      do while (next_card(card))
         material%label = integer_of(card, field_label)
         material%young = real_of(card, field_young)
         material%poisson = real_of(card, field_poisson)
         material%density = real_of(card, field_density)
         material%expansion = real_of(card, field_expansion)
         call add_material(card, field_label, material, deck%properties)
      end do
   end subroutine read_materials

end module axijoint_deck_section_materials
