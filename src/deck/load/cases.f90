!> Load cases and their combinations: CASE, COMBINE
module axijoint_deck_load_cases
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_warning
   use axijoint_deck_text_labels, only : repeated_label
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, text_value, field_error, entry_error
   use axijoint_model_load, only : load_case_type, combination_type, increment_type
   implicit none
   private
   public :: cases_type, read_cases, case_of_card, warn_of_empty_cases, read_combinations, &
      refer_increments, warn_of_idle_cases

   !> Fields of CASE; first pair of COMBINE
   integer, parameter :: field_label = 1, field_name = 2, field_pair = 2

   !> Load cases
   type :: cases_type
      !> The cases
      type(load_case_type), allocatable :: cases(:)
      !> Cards of CASE, in the order of the deck, and the case of each
      integer, allocatable :: cards(:), case_of(:)
      !> Cases by number
      type(number_map_type) :: index_of
      !> False if a card is so wrong that its number is not known
      logical :: complete = .true.
   end type cases_type

contains

   !> Read CASE. Loads above the first card, or without any, are of case 1
   subroutine read_cases(source, table, first_load, cases, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> CASE
      type(table_type), intent(in) :: table
      !> First card of all loads; a large number if there is none
      integer, intent(in) :: first_load
      !> The cases
      type(cases_type), intent(out) :: cases
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, label, known

      allocate (cases%cases(0))
      allocate (cases%case_of(table%n), source=1)
      cases%cards = table%cards(1, :table%n)
      known = 0
      if (table%n > 0) known = cases%cards(1)
      if (table%n == 0 .or. first_load < known) call add_case(cases, 1, '')
      do entry = 1, table%n
         if (.not. table%given(field_label, entry)) then
            cases%complete = .false.
            cycle
         end if
         label = integer_value(table, field_label, entry)
         known = findloc(nint(table%values(field_label, :entry - 1)), label, 1)
         if (known > 0) then
            call repeated_label(source, table, entry, field_label, 'load case', table%cards(1, known), &
                                diagnostics, allowed='a number of its own for each load case')
         end if
         if (find_number(cases%index_of, label) == 0) call add_case(cases, label, '')
         cases%case_of(entry) = find_number(cases%index_of, label)
         if (table%given(field_name, entry)) then
            cases%cases(cases%case_of(entry))%name = text_value(source, table, entry, field_name)
         end if
      end do
      if (size(cases%cases) == 0) call add_case(cases, 1, '')
   end subroutine read_cases

   !> Add a load case
   subroutine add_case(cases, label, name)
      !> The cases
      type(cases_type), intent(inout) :: cases
      !> Number and name
      integer, intent(in) :: label
      character(len=*), intent(in) :: name

      cases%cases = [cases%cases, load_case_type(label, name)]
      call insert_number(cases%index_of, label, size(cases%cases))
   end subroutine add_case

   !> Load case that a card belongs to: that of the last CASE card before it
   pure integer function case_of_card(cases, card) result(case)
      !> The cases
      type(cases_type), intent(in) :: cases
      !> The card
      integer, intent(in) :: card

      case = count(cases%cards < card)
      if (case > 0) then
         case = cases%case_of(case)
      else
         case = 1
      end if
   end function case_of_card

   !> Warn of load cases without loads
   subroutine warn_of_empty_cases(cases, table, loaded, diagnostics)
      !> The cases
      type(cases_type), intent(in) :: cases
      !> CASE
      type(table_type), intent(in) :: table
      !> Whether a case has loads, shape (cases)
      logical, intent(in) :: loaded(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry

      do entry = 1, table%n
         if (loaded(cases%case_of(entry)) .or. .not. table%good(entry)) cycle
         call add_warning(diagnostics, table%cards(1, entry), 0, 0, &
                          'load case '//to_text(integer_value(table, field_label, entry))//' has no loads', &
                          mend='loads belong to the CASE card above them; their keyword is repeated below it')
      end do
   end subroutine warn_of_empty_cases

   !> Read COMBINE. Without it every load case is a combination of its own
   subroutine read_combinations(source, table, cases, combinations, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> COMBINE
      type(table_type), intent(in) :: table
      !> Load cases
      type(cases_type), intent(in) :: cases
      !> The combinations, at least one
      type(combination_type), allocatable, intent(out) :: combinations(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(number_map_type) :: index_of
      logical, allocatable :: taken(:, :)
      real(wp), allocatable :: factor(:)
      integer :: entry, errors_before, i, n

      errors_before = diagnostics%n_errors
      n = size(cases%cases)
      allocate (combinations(0))
      allocate (factor(n), source=0.0_wp)
      if (table%n == 0) then
         do i = 1, n
            factor = 0.0_wp
            factor(i) = 1.0_wp
            combinations = [combinations, combination_type(cases%cases(i)%label, factor)]
         end do
         return
      end if
      allocate (taken(n, table%n), source=.false.)
      do entry = 1, table%n
         if (.not. table%given(field_label, entry)) cycle
         i = find_number(index_of, integer_value(table, field_label, entry))
         if (i == 0) then
            combinations = [combinations, combination_type(integer_value(table, field_label, entry), factor)]
            i = size(combinations)
            call insert_number(index_of, combinations(i)%label, i)
         end if
         call read_pairs(source, table, entry, cases, taken(:, i), combinations(i)%factor, diagnostics)
      end do
      if (diagnostics%n_errors > errors_before .or. .not. all(table%good(:table%n))) return
      call warn_of_unused_cases(cases, any(taken, 2), diagnostics)
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
   subroutine read_pairs(source, table, entry, cases, taken, factor, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> COMBINE
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Load cases
      type(cases_type), intent(in) :: cases
      !> Whether the combination has a case already
      logical, intent(inout) :: taken(:)
      !> Its factors
      real(wp), intent(inout) :: factor(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: field, case

      if (table%good(entry) .and. .not. any(table%given(field_pair:, entry))) then
         call entry_error(diagnostics, table, entry, 'the combination has no load case', &
                          allowed='up to five pairs: load case, factor')
      end if
      do field = field_pair, size(table%fields), 2
         if (.not. table%good(entry) .or. .not. any(table%given(field:field + 1, entry))) cycle
         if (.not. all(table%given(field:field + 1, entry))) then
            call field_error(diagnostics, source, table, entry, &
                             merge(field + 1, field, table%given(field, entry)), &
                             'a pair of the combination is not complete', allowed='pairs load case, factor')
            cycle
         end if
         case = find_number(cases%index_of, integer_value(table, field, entry))
         if (case == 0) then
            if (.not. cases%complete) cycle
            call field_error(diagnostics, source, table, entry, field, &
                             'load case '//to_text(integer_value(table, field, entry))//' is not defined', &
                             allowed='a case of a CASE card; 1 for loads above the first CASE')
         else if (taken(case)) then
            call field_error(diagnostics, source, table, entry, field, &
                             'the combination has load case '//to_text(integer_value(table, field, entry)) &
                             //' twice', allowed='each load case once')
         else
            taken(case) = .true.
            factor(case) = table%values(field + 1, entry)
         end if
      end do
   end subroutine read_pairs

   !> Find the load cases that INCREMENTS refer to
   subroutine refer_increments(source, table, cases, increments, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> INCREMENTS
      type(table_type), intent(in) :: table
      !> Load cases
      type(cases_type), intent(in) :: cases
      !> The increments
      type(increment_type), intent(inout) :: increments(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, parameter :: field_case = 4
      integer :: entry

      do entry = 1, table%n
         if (.not. table%given(field_case, entry)) cycle
         increments(entry)%case = find_number(cases%index_of, integer_value(table, field_case, entry))
         if (increments(entry)%case > 0 .or. .not. cases%complete) cycle
         call field_error(diagnostics, source, table, entry, field_case, &
                          'load case '//to_text(integer_value(table, field_case, entry))//' is not defined', &
                          allowed='a case of a CASE card; 1 for loads above the first CASE; blank for all')
      end do
   end subroutine refer_increments

   !> Warn of increments that name load cases which no combination puts together, and of load cases
   !> that no increment applies: their loads never act
   subroutine warn_of_idle_cases(table, combined, cases, increments, combinations, diagnostics)
      !> INCREMENTS
      type(table_type), intent(in) :: table
      !> Whether COMBINE is there
      logical, intent(in) :: combined
      !> Load cases
      type(cases_type), intent(in) :: cases
      !> The increments
      type(increment_type), intent(in) :: increments(:)
      !> The combinations
      type(combination_type), intent(in) :: combinations(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: case, k

      if (size(cases%cases) == 1 .or. .not. any(increments%case > 0)) return
      if (.not. combined) then
         call add_warning(diagnostics, table%cards(1, findloc(increments%case > 0, .true., 1)), 0, 0, &
                          'INCREMENTS names load cases, and no COMBINE puts them together: each is a job '// &
                          'without the others', mend='add COMBINE with all load cases of the history')
         return
      end if
      do case = 1, size(cases%cases)
         if (any(increments%case == case .or. increments%case == 0)) cycle
         if (.not. any([(abs(combinations(k)%factor(case)) > 0.0_wp, k=1, size(combinations))])) cycle
         call add_warning(diagnostics, table%cards(1, 1), 0, 0, &
                          'load case '//to_text(cases%cases(case)%label)//' is in no increment: its loads never act', &
                          mend='give it an increment, or leave its number blank on a card: then the factor is of all')
      end do
   end subroutine warn_of_idle_cases

end module axijoint_deck_load_cases
