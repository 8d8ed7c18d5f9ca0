!> CONTROL: harmonics, planes, rules, solver, method
module axijoint_deck_section_control
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_job
   use axijoint_deck_text_common_fields, only : largest_division, largest_harmonic
   use axijoint_deck_text_entry, only : is_given, integer_of, field_fault
   use axijoint_deck_text_field, only : integer_field, word_field, described
   use axijoint_fe_element_kind, only : kind_choice_type, formulation_names
   use axijoint_model_model, only : bodies_yield, can_yield, method_names, &
      body_method_names
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_registry, only : known_solvers, solver_words
   implicit none
   private
   public :: control_section, check_planes
   public :: keyword_control, field_harmonic, field_planes, field_method, field_body_method, &
      field_body_planes

   !> The keyword
   character(len=*), parameter :: keyword_control = 'CONTROL'
   !> Fields
   integer, parameter :: field_harmonic = 1, field_planes = 2, field_linear = 3, &
      field_quadratic = 4, &
      field_solver = 5, field_formulation = 6, field_method = 7, field_body_method = 8, &
      field_body_planes = 9

contains

   !> CONTROL
   function control_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_control
      section%purpose = 'harmonics, planes, rules of integration, solver, methods'
      section%once = .true.
      section%required = .true.
      section%stage = stage_job
      section%read => read_control
      section%fields = &
         [integer_field('the highest harmonic M', 1, 5, 0, largest_harmonic), &
          described(integer_field('the number of planes', 6, 10, 2, largest_division, default=0), &
                    'planes θ from 0 to π on which the joint law is checked', &
                    blank='4M+1, at least 2', &
                    limits='2 … 100000; at least M+1 if a joint can open or slip'), &
          described(integer_field('the number of Gauss points (linear)', 11, 15, 2, 3, default=2), &
                    'Gauss points per direction of 4-node elements; 3-node triangles: 2 for '// &
                    'three points, '// &
                    '3 for seven'), &
          described(integer_field('the number of Gauss points (quadratic)', 16, 20, 2, 3, &
          default=3), &
                    'the same of 8- and 9-node elements and 6-node triangles'), &
          word_field('the solver', 21, 30, solver_words(known_solvers()), 1), &
          described(word_field('the formulation of 4-node elements', 31, 40, formulation_names, &
          1), &
                    '4-node elements'), &
          described(word_field('the method', 41, 50, method_names, 1), &
                    'method for joints that open or slip'), &
          described(word_field('the method for bodies', 51, 60, body_method_names, 1), &
                    'method for bodies that yield'), &
          described(integer_field('the number of planes for bodies', 61, 65, 2, largest_division, &
                                  default=0), &
                    'planes θ from 0 to π on which the criteria of these are checked', &
                    blank='2M+1, at least 5', limits='2 … 100000; at least M+1')]
   end function control_section

   !> Take the control data into the job, as far as they are valid
   subroutine read_control(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(solver_entry_type), allocatable :: solvers(:)
      type(card_type) :: card
      integer :: word

      card = cards_of(deck, keyword_control)
      card%entry = 1
      associate (model => deck%model)
         if (card%table%n > 0) then
            model%max_harmonic = integer_of(card, field_harmonic)
            model%n_planes = integer_of(card, field_planes)
            deck%choice = kind_choice_type(integer_of(card, field_linear), &
               integer_of(card, field_quadratic), &
                                           integer_of(card, field_formulation))
            solvers = known_solvers()
            word = integer_of(card, field_solver)  ! the first one leaves the choice to the program
            if (word > 1) model%solver = solvers(word - 1)
            model%method = integer_of(card, field_method)
            model%body_method = integer_of(card, field_body_method)
            model%n_body_planes = integer_of(card, field_body_planes)
            if (is_given(card, field_harmonic)) deck%highest = model%max_harmonic
         end if
         if (model%n_planes == 0) model%n_planes = max(2, 4*model%max_harmonic + 1)
      end associate
   end subroutine read_control

   !> Check that there are planes enough for joints that can open or slip
   subroutine check_planes(deck)
      !> The deck with its model
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      associate (model => deck%model)
         if (.not. can_yield(model) .or. model%n_planes > model%max_harmonic) return
         card = cards_of(deck, keyword_control)
         card%entry = 1
         call field_fault(card, field_planes, &
                          'there are too few planes for harmonics up to '// &
                          to_text(model%max_harmonic), &
                          allowed='at least M + 1 = '//to_text(model%max_harmonic + 1)// &
                             ' planes where joints can open or slip', &
                          mend='leave the field blank: the default is 4 M + 1')
      end associate
   end subroutine check_planes

end module axijoint_deck_section_control
