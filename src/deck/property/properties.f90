!> Materials of the solids and laws of the joints
module axijoint_deck_property_properties
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_labels, only : repeated_label
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error
   use axijoint_element_elasticity, only : stable_ratios
   use axijoint_element_joint_law, only : law_elastic, law_paper
   use axijoint_model_material, only : solid_material_type, joint_material_type, rule_centroid, &
      rule_gauss, rule_lobatto
   implicit none
   private
   public :: properties_type, read_properties, find_property

   !> Fields of ORTHOTROPIC: E_1, then E_2, E_3; angle, then density and two
   !> expansions; nu_12, then two more; G_12, then two more and an expansion
   integer, parameter :: field_moduli = 2, field_direction = 5, field_ratios = 9, field_shears = 12
   !> Fields of LAWS
   integer, parameter :: field_stiffness = 2, field_cohesion = 5, field_angle = 6, field_kind = 7, &
      field_rule = 8
   !> Meaning of the words of LAWS, in the order of the fields' words
   integer, parameter :: kind_of_word(2) = [law_paper, law_elastic]
   integer, parameter :: rule_of_word(3) = [rule_centroid, rule_gauss, rule_lobatto]

   !> Materials and laws with their numbers
   type :: properties_type
      !> Materials of the solids
      type(solid_material_type), allocatable :: materials(:)
      !> Laws of the joints
      type(joint_material_type), allocatable :: laws(:)
      !> Materials and laws by number
      type(number_map_type) :: material_of, law_of
      !> False if a card is so wrong that its number is not known
      logical :: materials_complete = .true., laws_complete = .true.
   end type properties_type

contains

   !> Read MATERIALS, ORTHOTROPIC and LAWS
   subroutine read_properties(source, materials, orthotropic, laws, properties, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> MATERIALS, ORTHOTROPIC and LAWS
      type(table_type), intent(in) :: materials, orthotropic, laws
      !> What they say
      type(properties_type), intent(out) :: properties
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: cards(:)
      integer :: entry

      allocate (cards(0))
      call number_entries(source, materials, 'material', cards, properties%material_of, &
                          properties%materials_complete, diagnostics)
      call number_entries(source, orthotropic, 'material', cards, properties%material_of, &
                          properties%materials_complete, diagnostics)
      deallocate (cards)
      allocate (cards(0))
      call number_entries(source, laws, 'law', cards, properties%law_of, properties%laws_complete, &
                          diagnostics)
      properties%materials = [(isotropic_material(materials, entry), entry=1, materials%n), &
                              (orthotropic_material(orthotropic, entry), entry=1, orthotropic%n)]
      do entry = 1, orthotropic%n
         if (orthotropic%good(entry)) call check_orthotropic(source, orthotropic, entry, diagnostics)
      end do
      allocate (properties%laws(laws%n))
      do entry = 1, laws%n
         if (laws%good(entry)) call check_law(source, laws, entry, diagnostics)
         call read_law(laws, entry, properties%laws(entry))
      end do
   end subroutine read_properties

   !> Note the number of each entry, its first field, and report repeated ones
   subroutine number_entries(source, table, noun, cards, index_of, complete, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> What its entries are
      character(len=*), intent(in) :: noun
      !> Card of each entry numbered so far; those of the section are added
      integer, allocatable, intent(inout) :: cards(:)
      !> Entries by number
      type(number_map_type), intent(inout) :: index_of
      !> Made false if a number is not known
      logical, intent(inout) :: complete
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, label, known, n_before

      n_before = size(cards)
      cards = [cards, table%cards(1, :table%n)]
      do entry = 1, table%n
         if (.not. table%given(1, entry)) then
            complete = .false.
            cycle
         end if
         label = integer_value(table, 1, entry)
         known = find_number(index_of, label)
         if (known > 0) then
            call repeated_label(source, table, entry, 1, noun, cards(known), diagnostics)
         else
            call insert_number(index_of, label, n_before + entry)
         end if
      end do
   end subroutine number_entries

   !> A material of MATERIALS
   pure function isotropic_material(table, entry) result(material)
      !> MATERIALS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The material
      type(solid_material_type) :: material

      material%label = integer_value(table, 1, entry)
      material%young = table%values(2, entry)
      material%poisson = table%values(3, entry)
      material%density = table%values(4, entry)
      material%expansion = table%values(5, entry)
   end function isotropic_material

   !> A material of ORTHOTROPIC
   pure function orthotropic_material(table, entry) result(material)
      !> ORTHOTROPIC
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The material
      type(solid_material_type) :: material

      material%label = integer_value(table, 1, entry)
      material%orthotropic = .true.
      material%moduli = table%values(field_moduli:field_moduli + 2, entry)
      material%angle = degree*table%values(field_direction, entry)
      material%density = table%values(field_direction + 1, entry)
      material%ratios = table%values(field_ratios:field_ratios + 2, entry)
      material%shears = table%values(field_shears:field_shears + 2, entry)
      material%expansion = table%values([field_direction + 2, field_direction + 3, &
                                         field_shears + 3], entry)
   end function orthotropic_material

   !> Check that an orthotropic solid has a positive definite elasticity
   subroutine check_orthotropic(source, table, entry, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> ORTHOTROPIC
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(solid_material_type) :: material
      real(wp) :: bound(3)
      integer :: i

      material = orthotropic_material(table, entry)
      if (stable_ratios(material%moduli, material%ratios)) return
      bound = sqrt(material%moduli([1, 2, 1])/material%moduli([2, 3, 3]))
      i = findloc(abs(material%ratios) >= bound, .true., 1)
      if (i > 0) then
         call field_error(diagnostics, source, table, entry, field_ratios + i - 1, &
                          'the elasticity is not positive definite: this ratio is too large', &
                          allowed='magnitudes of nu_ij below sqrt(E_i/E_j) = '//to_text(bound(i)), &
                          mend='nu_ij is the contraction along j under stress along i: nu_ij/E_i = ' &
                             //'nu_ji/E_j')
      else
         call field_error(diagnostics, source, table, entry, field_ratios, &
                          'the elasticity is not positive definite: the ratios do not go together', &
                          allowed='1 - a^2 - b^2 - c^2 - 2 a b c > 0 with nu_12 sqrt(E_2/E_1), ' &
                             //'nu_23 sqrt(E_3/E_2), nu_13 sqrt(E_3/E_1)', &
                          mend='lessen the ratios; equal ones and moduli need nu < 0.5')
      end if
   end subroutine check_orthotropic

   !> A law as the model has it
   subroutine read_law(table, entry, law)
      !> LAWS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The law
      type(joint_material_type), intent(out) :: law

      law%label = integer_value(table, 1, entry)
      law%law%stiffness = table%values(field_stiffness:field_stiffness + 2, entry)
      law%law%cohesion = table%values(field_cohesion, entry)
      law%law%friction = tan(degree*table%values(field_angle, entry))
      law%law%kind = kind_of_word(integer_value(table, field_kind, entry))
      law%rule = rule_of_word(integer_value(table, field_rule, entry))
   end subroutine read_law

   !> Check that an elastic law has no strength
   subroutine check_law(source, table, entry, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> LAWS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: field

      if (kind_of_word(integer_value(table, field_kind, entry)) /= law_elastic) return
      do field = field_cohesion, field_angle
         if (.not. table%given(field, entry)) cycle
         call field_error(diagnostics, source, table, entry, field, &
                          'an elastic joint has no '//trim(table%fields(field)%name(5:)), allowed='blank', &
                          mend='leave the field blank, or write PAPER instead of ELASTIC')
      end do
   end subroutine check_law

   !> Find the material or law that a field names, or report it
   subroutine find_property(source, table, entry, field, index_of, complete, noun, index, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section that refers to it
      type(table_type), intent(in) :: table
      !> Entry and field
      integer, intent(in) :: entry, field
      !> Things by number
      type(number_map_type), intent(in) :: index_of
      !> Whether all are known
      logical, intent(in) :: complete
      !> What is sought
      character(len=*), intent(in) :: noun
      !> Its index; 0 if there is none
      integer, intent(out) :: index
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      index = 0
      if (.not. table%given(field, entry)) return
      index = find_number(index_of, integer_value(table, field, entry))
      if (index > 0 .or. .not. complete) return
      call field_error(diagnostics, source, table, entry, field, &
                       noun//' '//to_text(integer_value(table, field, entry))//' is not defined')
   end subroutine find_property

end module axijoint_deck_property_properties
