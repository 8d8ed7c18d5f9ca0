!> Materials of the solids and laws of the joints
module axijoint_deck_properties
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_diagnostics, only : diagnostics_type
   use axijoint_deck_source, only : source_type, card_position
   use axijoint_deck_table, only : table_type, integer_value, field_error
   use axijoint_element_joint_law, only : law_elastic, law_paper
   use axijoint_model_material, only : solid_material_type, joint_material_type, rule_centroid, &
      rule_gauss, rule_lobatto
   implicit none
   private
   public :: properties_type, read_properties, find_property

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

   !> Read MATERIALS and LAWS
   subroutine read_properties(source, materials, laws, properties, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> MATERIALS and LAWS
      type(table_type), intent(in) :: materials, laws
      !> What they say
      type(properties_type), intent(out) :: properties
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry

      call number_entries(source, materials, 'material', properties%material_of, &
                          properties%materials_complete, diagnostics)
      call number_entries(source, laws, 'law', properties%law_of, properties%laws_complete, diagnostics)
      allocate (properties%materials(materials%n), properties%laws(laws%n))
      do entry = 1, materials%n
         properties%materials(entry) = solid_material_type( &
            label=integer_value(materials, 1, entry), young=materials%values(2, entry), &
            poisson=materials%values(3, entry))
      end do
      do entry = 1, laws%n
         if (laws%good(entry)) call check_law(source, laws, entry, diagnostics)
         call read_law(laws, entry, properties%laws(entry))
      end do
   end subroutine read_properties

   !> Note the number of each entry, its first field, and report repeated ones
   subroutine number_entries(source, table, noun, index_of, complete, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> What its entries are
      character(len=*), intent(in) :: noun
      !> Entries by number
      type(number_map_type), intent(inout) :: index_of
      !> Made false if a number is not known
      logical, intent(inout) :: complete
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, label, known

      do entry = 1, table%n
         if (.not. table%given(1, entry)) then
            complete = .false.
            cycle
         end if
         label = integer_value(table, 1, entry)
         known = find_number(index_of, label)
         if (known > 0) then
            call field_error(diagnostics, source, table, entry, 1, &
                             noun//' '//to_text(label)//' is given twice, first on '// &
                             card_position(source, table%cards(1, known), table%cards(1, entry)))
         else
            call insert_number(index_of, label, entry)
         end if
      end do
   end subroutine number_entries

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

end module axijoint_deck_properties
