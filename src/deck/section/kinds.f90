!> KINDS: rule and formulation of some elements
module axijoint_deck_section_kinds
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, check_body
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_blocks
   use axijoint_deck_job_load_fields, only : any_body
   use axijoint_deck_property_properties, only : find_material
   use axijoint_deck_text_common_fields, only : last_number
   use axijoint_deck_text_entry, only : is_given, integer_of, is_sound, field_fault, card_fault, &
      first_card
   use axijoint_deck_text_field, only : integer_field, word_field, described
   use axijoint_deck_text_source, only : card_position
   use axijoint_fe_element_kind, only : element_kind_type, kind_choice_type, chosen_kind, &
      find_kind, &
      formulations, formulation_names
   implicit none
   private
   public :: kinds_section

   !> The keyword
   character(len=*), parameter :: keyword_kinds = 'KINDS'
   !> Fields
   integer, parameter :: field_body = 1, field_material = 2, field_points = 3, field_formulation = 4

contains

   !> KINDS
   function kinds_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_kinds
      section%purpose = 'rule and formulation of elements that differ from CONTROL'
      section%stage = stage_blocks  ! after BLOCKS: all elements are there
      section%read => choose_kinds
      section%fields = &
         [described(any_body(1), 'body', blank='all', limits='1 … 9999; one card an element'), &
          described(last_number('the material', 6), &
          'material: of the body''s elements of this material alone', &
                    blank='all', limits='of MATERIALS or ORTHOTROPIC'), &
          described(integer_field('the number of Gauss points', 11, 15, 2, 3, default=0), &
                    'Gauss points per direction, as in CONTROL', blank='CONTROL''s'), &
          described(word_field('the formulation', 16, 25, formulation_names, 1), &
                    'formulation, as in CONTROL', blank='CONTROL''s')]
   end function kinds_section

   !> Choose the kinds of all elements: those of CONTROL but where a card says another
   subroutine choose_kinds(deck)
      !> The deck; all elements are there
      type(deck_type), intent(inout), target :: deck

      type(kind_choice_type), allocatable :: choice(:)
      type(card_type) :: card
      integer, allocatable :: of(:)
      integer :: element

      choice = [deck%choice]
      allocate (of(deck%draft%n_elements), source=1)
      card = cards_of(deck, keyword_kinds)
      do while (next_card(card))
         call read_choice(card, choice, of)
      end do
      associate (draft => deck%draft)
         draft%kinds = [element_kind_type ::]
         draft%element_kind = of
         do element = 1, size(of)
            call find_kind(draft%kinds, chosen_kind(choice(of(element)), &
               draft%element_size(element)), &
                           draft%element_kind(element))
         end do
      end associate
   end subroutine choose_kinds

   !> Read a card, and let its elements have its choice
   subroutine read_choice(card, choice, of)
      !> A card of KINDS
      type(card_type), intent(in) :: card
      !> The choices: CONTROL's first, then one an earlier card; takes the card's
      type(kind_choice_type), allocatable, intent(inout) :: choice(:)
      !> Choice of each element
      integer, intent(inout) :: of(:)

      type(kind_choice_type) :: new
      logical :: covered(size(of))
      integer :: material

      material = 0
      call check_body(card, field_body)
      if (is_given(card, field_material)) &
         call find_material(card, field_material, card%deck%properties, material)
      new = choice(1)
      if (is_given(card, field_points)) new%order_linear = integer_of(card, field_points)
      if (is_given(card, field_points)) new%order_quadratic = integer_of(card, field_points)
      if (is_given(card, field_formulation)) new%formulation = integer_of(card, field_formulation)
      choice = [choice, new]
      if (.not. is_sound(card)) return
      if (.not. (is_given(card, field_points) .or. is_given(card, field_formulation))) then
         call card_fault(card, 'the card names neither Gauss points nor a formulation', &
                         mend='write one of them, or delete the card: CONTROL says what '// &
                         'elements are')
         return
      end if
      associate (draft => card%deck%draft, n => size(of))
         covered = .true.
         if (is_given(card, field_body)) &
            covered = draft%element_body(:n) == integer_of(card, field_body)
         if (material > 0) covered = covered .and. draft%element_material(:n) == material
         if (draft%elements_complete) call check_covered(card, covered, of)
      end associate
      where (covered) of = size(choice)
   end subroutine read_choice

   !> Check that a card is for some elements, that these have no other, and that its formulation is
   !> theirs
   subroutine check_covered(card, covered, of)
      !> A card of KINDS
      type(card_type), intent(in) :: card
      !> Its elements
      logical, intent(in) :: covered(:)
      !> Choice of each element by the cards before
      integer, intent(in) :: of(:)

      integer :: element

      if (.not. any(covered)) then
         call card_fault(card, 'no element is of this body and material', &
                         mend='correct the number of the body or of the material')
         return
      end if
      element = findloc(covered .and. of > 1, .true., 1)
      if (element > 0) then
         call card_fault(card, 'element '//to_text(card%deck%draft%element_label(element))// &
            ' has a kind already', &
                         found='card '//to_text(of(element) - 1)//' of KINDS is for it, too', &
                         allowed='one card an element')
      end if
      if (.not. is_given(card, field_formulation)) return
      associate (formulation => formulations(integer_of(card, field_formulation)), &
                 sizes => card%deck%draft%element_size(:size(of)))
         if (any(covered .and. formulation%offered(sizes))) return
         call field_fault(card, field_formulation, trim(formulation%name)// &
            ' is not for elements of '// &
                          to_text(sizes(findloc(covered, .true., 1)))//' nodes', &
                          mend='make the elements others, or leave the field blank')
      end associate
   end subroutine check_covered

end module axijoint_deck_section_kinds
