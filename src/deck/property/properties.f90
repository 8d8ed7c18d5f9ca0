!> Materials of the solids and laws of the joints, by the numbers that cards give them
module axijoint_deck_property_properties
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_entry, only : entry_type, is_given, integer_of, lack_fault, first_card
   use axijoint_deck_text_labels, only : repeated_label
   use axijoint_model_material, only : solid_material_type, joint_material_type
   implicit none
   private
   public :: properties_type, new_properties, add_material, add_law, find_material, find_law

   !> Materials and laws with their numbers
   type :: properties_type
      !> Materials of the solids
      type(solid_material_type), allocatable :: materials(:)
      !> Laws of the joints
      type(joint_material_type), allocatable :: laws(:)
      !> Card of each material and law
      integer, allocatable :: material_card(:), law_card(:)
      !> Materials and laws by number
      type(number_map_type) :: material_of, law_of
      !> False if a card is so wrong that its number is not known
      logical :: materials_complete = .true., laws_complete = .true.
   end type properties_type

contains

   !> No materials and laws
   pure function new_properties() result(properties)
      !> Without any
      type(properties_type) :: properties

      allocate (properties%materials(0), properties%laws(0), properties%material_card(0), &
                properties%law_card(0))
   end function new_properties

   !> Add a material, and report its number if another has it
   subroutine add_material(card, field, material, properties)
      !> The card, and the field of the number
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> The material
      type(solid_material_type), intent(in) :: material
      !> Materials and laws
      type(properties_type), intent(inout) :: properties

      properties%materials = [properties%materials, material]
      call add_number(card, field, 'material', properties%material_card, properties%material_of, &
                      properties%materials_complete)
   end subroutine add_material

   !> Add a law, and report its number if another has it
   subroutine add_law(card, field, law, properties)
      !> The card, and the field of the number
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> The law
      type(joint_material_type), intent(in) :: law
      !> Materials and laws
      type(properties_type), intent(inout) :: properties

      properties%laws = [properties%laws, law]
      call add_number(card, field, 'law', properties%law_card, properties%law_of, &
                      properties%laws_complete)
   end subroutine add_law

   !> Note the number of a thing, and report it if it is there already
   subroutine add_number(card, field, noun, cards, index_of, complete)
      !> The card, and the field of the number
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> What has the number
      character(len=*), intent(in) :: noun
      !> Cards of the things so far; this one is added
      integer, allocatable, intent(inout) :: cards(:)
      !> Things by number
      type(number_map_type), intent(inout) :: index_of
      !> Made false if the number is not known
      logical, intent(inout) :: complete

      integer :: known

      cards = [cards, first_card(card)]
      if (.not. is_given(card, field)) then
         complete = .false.
         return
      end if
      known = find_number(index_of, integer_of(card, field))
      if (known > 0) then
         call repeated_label(card, field, noun, cards(known))
      else
         call insert_number(index_of, integer_of(card, field), size(cards))
      end if
   end subroutine add_number

   !> Find the material that a field names, or report it
   subroutine find_material(card, field, properties, material)
      !> The card that refers to it, and the field
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> Materials and laws
      type(properties_type), intent(in) :: properties
      !> Its index; 0 if there is none
      integer, intent(out) :: material

      call find_property(card, field, 'material', properties%material_of, &
                         properties%materials_complete, material)
   end subroutine find_material

   !> Find the law that a field names, or report it
   subroutine find_law(card, field, properties, law)
      !> The card that refers to it, and the field
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> Materials and laws
      type(properties_type), intent(in) :: properties
      !> Its index; 0 if there is none
      integer, intent(out) :: law

      call find_property(card, field, 'law', properties%law_of, properties%laws_complete, law)
   end subroutine find_law

   !> Find the thing that a field names, or report it
   subroutine find_property(card, field, noun, index_of, complete, index)
      !> The card that refers to it, and the field
      class(entry_type), intent(in) :: card
      integer, intent(in) :: field
      !> What is sought
      character(len=*), intent(in) :: noun
      !> Things by number
      type(number_map_type), intent(in) :: index_of
      !> Whether all are known
      logical, intent(in) :: complete
      !> Its index; 0 if there is none
      integer, intent(out) :: index

      index = 0
      if (.not. is_given(card, field)) return
      index = find_number(index_of, integer_of(card, field))
      if (index > 0 .or. .not. complete) return
      call lack_fault(card, field, noun//' '//to_text(integer_of(card, field))//' is not defined')
   end subroutine find_property

end module axijoint_deck_property_properties
