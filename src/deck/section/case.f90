!> CASE: load cases
module axijoint_deck_section_case
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_load_cases, only : add_case, case_of_card
   use axijoint_deck_text_common_fields, only : number
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_entry, only : is_given, integer_of, text_of, is_good, first_card
   use axijoint_deck_text_field, only : text_field, described
   use axijoint_deck_text_labels, only : repeated_label
   implicit none
   private
   public :: case_section, warn_of_lacking_loads

   !> The keyword
   character(len=*), parameter :: keyword_case = 'CASE'
   !> Fields
   integer, parameter :: field_label = 1, field_name = 2

contains

   !> CASE
   function case_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_case
      section%purpose = 'begins a load case: the loads below it, up to the next CASE, belong to it'
      section%numbered = .true.
      section%stage = stage_loads
      section%read => read_cases
      section%fields = [described(number('the load case', 1), 'load case', &
         limits='each number once'), &
                        described(text_field('the name of the load case', 6, 80), &
                                  'name, without commas', &
                                  limits='blanks inside are allowed')]
      section%fields(field_name)%required = .false.
   end function case_section

   !> Note the load cases. Loads above the first card, or without any, are of case 1
   subroutine read_cases(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: label, known

      card = cards_of(deck, keyword_case)
      associate (cases => deck%cases, table => card%table)
         allocate (cases%cases(0))
         allocate (cases%case_of(table%n), source=1)
         cases%cards = table%cards(1, :table%n)
         if (table%n == 0) then
            call add_case(cases, 1, '')
         else if (first_load(deck) < cases%cards(1)) then
            call add_case(cases, 1, '')
         end if
         do while (next_card(card))
            if (.not. is_given(card, field_label)) then
               cases%complete = .false.
               cycle
            end if
            label = integer_of(card, field_label)
            known = findloc(nint(table%values(field_label, :card%entry - 1)), label, 1)
            if (known > 0) then
               call repeated_label(card, field_label, 'load case', table%cards(1, known), &
                                   allowed='a number of its own for each load case')
            end if
            if (find_number(cases%index_of, label) == 0) call add_case(cases, label, '')
            cases%case_of(card%entry) = find_number(cases%index_of, label)
            if (.not. is_given(card, field_name)) cycle
            cases%cases(cases%case_of(card%entry))%name = text_of(card, field_name)
         end do
         if (size(cases%cases) == 0) call add_case(cases, 1, '')
         deck%model%load_cases = cases%cases
      end associate
   end subroutine read_cases

   !> First card of any load; a large number if there is none
   pure integer function first_load(deck)
      !> The deck
      type(deck_type), intent(in) :: deck

      integer :: k

      first_load = huge(first_load)
      do k = 1, size(deck%sections%tables)
         if (.not. deck%source%sections(k)%is_load) cycle
         associate (table => deck%sections%tables(k))
            first_load = min(first_load, minval(table%cards(1, :table%n)))
         end associate
      end do
   end function first_load

   !> Warn of a deck and of load cases without loads
   subroutine warn_of_lacking_loads(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      logical, allocatable :: loaded(:)
      integer :: k, entry

      allocate (loaded(size(deck%cases%cases)), source=.false.)
      do k = 1, size(deck%sections%tables)
         if (.not. deck%source%sections(k)%is_load) cycle
         associate (table => deck%sections%tables(k))
            do entry = 1, table%n
               loaded(case_of_card(deck%cases, table%cards(1, entry))) = .true.
            end do
         end associate
      end do
      if (.not. any(loaded)) then
         call add_warning(deck%diagnostics, 0, 0, 0, &
            'the deck has no loads: all results will be zero')
         return
      end if
      card = cards_of(deck, keyword_case)
      do while (next_card(card))
         if (loaded(deck%cases%case_of(card%entry)) .or. .not. is_good(card)) cycle
         call add_warning(deck%diagnostics, first_card(card), 0, 0, &
                          'load case '//to_text(integer_of(card, field_label))//' has no loads', &
                          mend='loads belong to the CASE card above them; their keyword is '// &
                          'repeated below it')
      end do
   end subroutine warn_of_lacking_loads

end module axijoint_deck_section_case
