!> ORTHOTROPIC: solids with three moduli
module axijoint_deck_section_orthotropic
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_properties
   use axijoint_deck_property_properties, only : add_material
   use axijoint_deck_text_common_fields, only : number
   use axijoint_deck_text_entry, only : integer_of, real_of, reals_of, is_good, field_fault
   use axijoint_deck_text_field, only : field_type, real_field, described
   use axijoint_element_elasticity, only : stable_ratios
   use axijoint_model_material, only : solid_material_type
   implicit none
   private
   public :: orthotropic_section

   !> The keyword
   character(len=*), parameter :: keyword_orthotropic = 'ORTHOTROPIC'
   !> Fields: three moduli from E_1 on, two expansions; three ratios from nu_12 on, three shear
   !> moduli from G_12 on
   integer, parameter :: field_label = 1, field_moduli = 2, field_direction = 5, &
      field_density = 6, &
      field_expansions = 7, field_ratios = 9, field_shears = 12, field_expansion_3 = 15

contains

   !> ORTHOTROPIC
   function orthotropic_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_orthotropic
      section%purpose = 'solids with three moduli, along 1 and 2 in the r-z plane and along θ'
      section%numbered = .true.
      section%entry = 'material'
      section%cards(:2) = [character(len=40) :: 'E, angle, density', 'nu and G']
      section%stage = stage_properties
      section%read => read_orthotropic
      section%fields = [first_card_fields(), second_card_fields()]
   end function orthotropic_section

   !> Fields of the first card
   pure function first_card_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      integer :: i

      fields = [number('the material', 1), &
                described([(real_field('E_'//to_text(i), 10*i - 4, above=0.0_wp, symbol='E'), &
                            i=1, 3)], &
                          'E_1 E_2 E_3 [stress]'), &
                described(real_field('the angle of direction 1', 36, from=-360.0_wp, to=360.0_wp, &
                                     default=0.0_wp, symbol='angle'), &
                          'angle from r to direction 1, counterclockwise [degree]'), &
                described(real_field('the density', 46, from=0.0_wp, default=0.0_wp, &
                symbol='density'), &
                          'density [mass/volume]'), &
                described([(real_field('expansion '//to_text(i), 10*i + 46, default=0.0_wp), i=1, &
                2)], &
                          'thermal expansion along 1 and 2 [1/temperature]')]
   end function first_card_fields

   !> Fields of the second card
   pure function second_card_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      character(len=2), parameter :: pairs(3) = ['12', '23', '13']
      integer :: i

      fields = [described([(real_field('nu_'//pairs(i), 10*i - 9), i=1, 3)], 'ν_12 ν_23 ν_13', &
                          limits='the elasticity must be positive definite'), &
                described([(real_field('G_'//pairs(i), 10*i + 21, above=0.0_wp, symbol='G'), i=1, &
                3)], &
                          'G_12 G_23 G_13 [stress]'), &
                described(real_field('expansion 3', 61, default=0.0_wp), &
                          'thermal expansion along 3 [1/temperature]')]
      fields%card = 2
   end function second_card_fields

   !> Add the materials, behind those of MATERIALS
   subroutine read_orthotropic(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(solid_material_type) :: material

      card = cards_of(deck, keyword_orthotropic)
      do while (next_card(card))
         material = solid_material_type()
         material%label = integer_of(card, field_label)
         material%orthotropic = .true.
         material%moduli = reals_of(card, field_moduli, 3)
         material%angle = degree*real_of(card, field_direction)
         material%density = real_of(card, field_density)
         material%ratios = reals_of(card, field_ratios, 3)
         material%shears = reals_of(card, field_shears, 3)
         material%expansion = [reals_of(card, field_expansions, 2), &
            real_of(card, field_expansion_3)]
         call add_material(card, field_label, material, deck%properties)
         if (is_good(card)) call check_elasticity(card, material)
      end do
   end subroutine read_orthotropic

   !> Check that an orthotropic solid has a positive definite elasticity
   subroutine check_elasticity(card, material)
      !> The card
      type(card_type), intent(in) :: card
      !> Its material
      type(solid_material_type), intent(in) :: material

      real(wp) :: bound(3)
      integer :: i

      if (stable_ratios(material%moduli, material%ratios)) return
      bound = sqrt(material%moduli([1, 2, 1])/material%moduli([2, 3, 3]))
      i = findloc(abs(material%ratios) >= bound, .true., 1)
      if (i > 0) then
         call field_fault(card, field_ratios + i - 1, &
                          'the elasticity is not positive definite: this ratio is too large', &
                          allowed='magnitudes of nu_ij below sqrt(E_i/E_j) = '//to_text(bound(i)), &
                          mend='nu_ij is the contraction along j under stress along i: '// &
                          'nu_ij/E_i = ' &
                             //'nu_ji/E_j')
      else
         call field_fault(card, field_ratios, &
                          'the elasticity is not positive definite: the ratios do not go '// &
                          'together', &
                          allowed='1 - a^2 - b^2 - c^2 - 2 a b c > 0 with nu_12 sqrt(E_2/E_1), ' &
                             //'nu_23 sqrt(E_3/E_2), nu_13 sqrt(E_3/E_1)', &
                          mend='lessen the ratios; equal ones and moduli need nu < 0.5')
      end if
   end subroutine check_elasticity

end module axijoint_deck_section_orthotropic
