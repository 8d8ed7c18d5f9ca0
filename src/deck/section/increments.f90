!> INCREMENTS: steps of the load, their tolerance, the load cases that they apply
module axijoint_deck_section_increments
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_job
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, field_fault, lack_fault
   use axijoint_deck_text_field, only : integer_field, real_field, word_field, described, &
      largest_number
   use axijoint_model_load, only : increment_type
   use axijoint_model_model, only : bodies_yield, can_yield, method_newton
   implicit none
   private
   public :: increments_section, refer_increments, warn_of_idle_cases, check_control
   public :: keyword_increments, field_tolerance

   !> The keyword
   character(len=*), parameter :: keyword_increments = 'INCREMENTS'
   !> Fields
   integer, parameter :: field_factor = 1, field_tolerance = 2, field_iterations = 3, field_case = 4, &
      field_control = 5
   !> What an increment gives
   character(len=12), parameter :: control_names(2) = [character(len=12) :: 'LOAD', 'DISPLACEMENT']
   integer, parameter :: control_displacement = 2
   !> Most iterations of an increment unless the deck gives another number
   integer, parameter :: default_iterations = 500

contains

   !> INCREMENTS
   function increments_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_increments
      section%purpose = 'steps of the load, one card each; without the section one step of factor 1'
      section%stage = stage_job
      section%read => read_increments
      section%fields = &
         [described(real_field('the load factor', 1), &
                    'factor on all loads, added to those of earlier increments', limits='any'), &
          described(real_field('the tolerance', 11, above=0.0_wp, below=1.0_wp, default=1.0e-6_wp, &
                               symbol='tolerance'), &
                    'tolerance ε on residual forces: of the whole over the applied, and of '// &
                    'each part in each '// &
                    'harmonic over what its joints would carry; the largest counts', &
                    limits='0 < ε < 1'), &
          described(integer_field('the most iterations', 21, 25, 1, largest_number, &
                                  default=default_iterations), &
                    'most iterations', limits='≥ 1'), &
          described(integer_field('the load case', 26, 30, 1, largest_number, default=0), &
                    'load case that the factor belongs to', blank='all', limits='of CASE, or 1'), &
          described(word_field('what is given', 31, 42, control_names, 1), &
                    'whether the factor is given, or the displacement that it would give elastic '// &
                    'bodies')]
   end function increments_section

   !> Take the increments into the job
   subroutine read_increments(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_increments)
      allocate (deck%model%increments(max(1, card%table%n)))
      deck%model%increments(1)%max_iterations = default_iterations
      do while (next_card(card))
         associate (increment => deck%model%increments(card%entry))
            increment%factor = real_of(card, field_factor)
            increment%tolerance = real_of(card, field_tolerance)
            increment%max_iterations = integer_of(card, field_iterations)
            increment%steered = integer_of(card, field_control) == control_displacement
         end associate
      end do
   end subroutine read_increments

   !> Find the load cases that the increments refer to
   subroutine refer_increments(deck)
      !> The deck with its load cases
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_increments)
      do while (next_card(card))
         if (.not. is_given(card, field_case)) cycle
         associate (case => deck%model%increments(card%entry)%case)
            case = find_number(deck%cases%index_of, integer_of(card, field_case))
            if (case > 0 .or. .not. deck%cases%complete) cycle
         end associate
         call lack_fault(card, field_case, &
                         'load case '//to_text(integer_of(card, field_case))//' is not defined', &
                         allowed='a case of a CASE card; 1 for loads above the first CASE; '// &
                         'blank for all')
      end do
   end subroutine refer_increments

   !> Check that increments whose displacement is given are of forces on bodies that yield
   subroutine check_control(deck)
      !> The deck with its model
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: k

      card = cards_of(deck, keyword_increments)
      do while (next_card(card))
         associate (model => deck%model, increment => deck%model%increments(card%entry))
            if (.not. increment%steered) cycle
            if (.not. bodies_yield(model)) then
               call field_fault(card, field_control, 'no material yields: the load factor is found '// &
                  'only where one does', allowed='LOAD, or blank')
            else if (can_yield(model) .and. model%method /= method_newton) then
               call field_fault(card, field_control, 'the load factor is found by the method NEWTON '// &
                  'of the joints alone', allowed='LOAD, or blank', mend='leave columns 41-50 of '// &
                  'CONTROL blank; MOVEDFACES gives displacements, beyond the limit load, too')
            else if (any([(applies(model%prescribed(k)%case), k=1, size(model%prescribed)), &
                           (applies(model%thermal_loads(k)%case), k=1, size(model%thermal_loads)), &
                           (applies(model%initial_stresses(k)%case), k=1, &
                            size(model%initial_stresses))])) then
               call field_fault(card, field_control, 'the load of an increment whose displacement '// &
                  'is given consists of forces; here there are given displacements, temperatures '// &
                  'or in-situ stress, too', allowed='LOAD, or blank', &
                  mend='a CASE for the forces, named in columns 26-30, and COMBINE')
            end if
         end associate
      end do

   contains

      !> Whether a load case is in the increment
      pure logical function applies(case)
         !> The case
         integer, intent(in) :: case

         associate (wanted => deck%model%increments(card%entry)%case)
            applies = wanted == 0 .or. case == wanted
         end associate
      end function applies

   end subroutine check_control

   !> Warn of increments that name load cases which no combination puts together, and of load cases
   !> that no increment applies: their loads never act
   subroutine warn_of_idle_cases(deck, combined)
      !> The deck with its load cases and combinations
      type(deck_type), intent(inout), target :: deck
      !> Whether COMBINE is there
      logical, intent(in) :: combined

      type(card_type) :: card
      integer :: case, k

      card = cards_of(deck, keyword_increments)
      associate (cases => deck%cases%cases, increments => deck%model%increments, &
                 combinations => deck%model%combinations, cards => card%table%cards)
         if (size(cases) == 1 .or. .not. any(increments%case > 0)) return
         if (.not. combined) then
            call add_warning(deck%diagnostics, cards(1, findloc(increments%case > 0, .true., 1)), &
                             0, 0, &
                             'INCREMENTS names load cases, and no COMBINE puts them together: '// &
                             'each is a job '// &
                             'without the others', &
                             mend='add COMBINE with all load cases of the history')
            return
         end if
         do case = 1, size(cases)
            if (any(increments%case == case .or. increments%case == 0)) cycle
            if (.not. any([(abs(combinations(k)%factor(case)) > 0.0_wp, k=1, &
                            size(combinations))])) cycle
            call add_warning(deck%diagnostics, cards(1, 1), 0, 0, &
                             'load case '//to_text(cases(case)%label)// &
                             ' is in no increment: its loads never act', &
                             mend='give it an increment, or leave its number blank on a card: '// &
                             'then the factor '// &
                                'is of all')
         end do
      end associate
   end subroutine warn_of_idle_cases

end module axijoint_deck_section_increments
