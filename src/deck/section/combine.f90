!> COMBINE: combinations of load cases
module axijoint_deck_section_combine
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_load_cases, only : cases_type
   use axijoint_deck_text_common_fields, only : number, last_number
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_warning
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, &
      field_fault, lack_fault, &
      card_fault
   use axijoint_deck_text_field, only : real_field, described
   use axijoint_model_load, only : combination_type
   implicit none
   private
   public :: combine_section, keyword_combine

   !> The keyword
   character(len=*), parameter :: keyword_combine = 'COMBINE'
   !> Fields: number, then pairs of load case and factor
   integer, parameter :: field_label = 1, field_pair = 2, n_pairs = 5

contains

   !> COMBINE
   function combine_section() result(section)
      !> The section
      type(read_section_type) :: section

      integer :: i

      section%name = keyword_combine
      section%purpose = 'combinations of load cases; without the section each is one of its own'
      section%stage = stage_loads
      section%read => read_combinations
      section%fields = [described(number('the combination', 1), &
                                  'combination; further cards with the same number go on with it')]
      do i = 1, n_pairs
         section%fields = [section%fields, last_number('load case '//to_text(i), 15*i - 9), &
                           real_field('factor '//to_text(i), 15*i - 4, default=0.0_wp)]
      end do
      section%fields(field_pair:) = described(section%fields(field_pair:), &
         'five pairs, one at least: load case I5, factor F10', blank='none', &
         limits='each case once')
   end function combine_section

   !> Make the combinations. Without cards every load case is one of its own
   subroutine read_combinations(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(number_map_type) :: index_of
      logical, allocatable :: taken(:, :)
      real(wp), allocatable :: factor(:)
      integer :: errors_before, i, n

      card = cards_of(deck, keyword_combine)
      errors_before = deck%diagnostics%n_errors
      associate (cases => deck%cases, model => deck%model)
         n = size(cases%cases)
         allocate (model%combinations(0))
         allocate (factor(n), source=0.0_wp)
         if (card%table%n == 0) then
            do i = 1, n
               factor = 0.0_wp
               factor(i) = 1.0_wp
               model%combinations = [model%combinations, &
                  combination_type(cases%cases(i)%label, factor)]
            end do
            return
         end if
         allocate (taken(n, card%table%n), source=.false.)
         do while (next_card(card))
            if (.not. is_given(card, field_label)) cycle
            i = find_number(index_of, integer_of(card, field_label))
            if (i == 0) then
               model%combinations = [model%combinations, &
                  combination_type(integer_of(card, field_label), factor)]
               i = size(model%combinations)
               call insert_number(index_of, model%combinations(i)%label, i)
            end if
            call read_pairs(card, cases, taken(:, i), model%combinations(i)%factor)
         end do
         if (deck%diagnostics%n_errors > errors_before &
            .or. .not. all(card%table%good(:card%table%n))) return
         call warn_of_unused_cases(cases, any(taken, 2), deck%diagnostics)
      end associate
   end subroutine read_combinations

   !> Warn of load cases that are in no combination: nothing is computed of their loads
   subroutine warn_of_unused_cases(cases, used, diagnostics)
      !> The cases
      type(cases_type), intent(in) :: cases
      !> Whether a case is in a combination, shape (cases)
      logical, intent(in) :: used(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: case, place, card

      do case = 1, size(cases%cases)
         if (used(case)) cycle
         place = findloc(cases%case_of, case, 1)
         card = 0
         if (place > 0) card = cases%cards(place)
         call add_warning(diagnostics, card, 0, 0, &
                          'load case '//to_text(cases%cases(case)%label)//' is in no combination', &
                          mend='add it to a combination of COMBINE, or remove it')
      end do
   end subroutine warn_of_unused_cases

   !> Read the load cases and factors of one card
   subroutine read_pairs(card, cases, taken, factor)
      !> The card
      type(card_type), intent(in) :: card
      !> Load cases
      type(cases_type), intent(in) :: cases
      !> Whether the combination has a case already
      logical, intent(inout) :: taken(:)
      !> Its factors
      real(wp), intent(inout) :: factor(:)

      integer :: field, case

      if (is_good(card) .and. .not. any(card%table%given(field_pair:, card%entry))) then
         call card_fault(card, 'the combination has no load case', &
                          allowed='up to five pairs: load case, factor')
      end if
      do field = field_pair, size(card%table%fields), 2
         if (.not. is_good(card) .or. .not. any(card%table%given(field:field + 1, card%entry))) &
            cycle
         if (.not. all(card%table%given(field:field + 1, card%entry))) then
            call field_fault(card, &
                             merge(field + 1, field, is_given(card, field)), &
                             'a pair of the combination is not complete', &
                             allowed='pairs load case, factor')
            cycle
         end if
         case = find_number(cases%index_of, integer_of(card, field))
         if (case == 0) then
            if (.not. cases%complete) cycle
            call lack_fault(card, field, &
                            'load case '//to_text(integer_of(card, field))//' is not defined', &
                            allowed='a case of a CASE card; 1 for loads above the first CASE')
         else if (taken(case)) then
            call field_fault(card, field, &
                             'the combination has load case '//to_text(integer_of(card, field)) &
                             //' twice', allowed='each load case once')
         else
            taken(case) = .true.
            factor(case) = real_of(card, field + 1)
         end if
      end do
   end subroutine read_pairs

end module axijoint_deck_section_combine
