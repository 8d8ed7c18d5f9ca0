!> PRINT: how much of long tables the listing shows
module axijoint_deck_section_print
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, check_body
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_text_common_fields, only : body
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, field_fault
   use axijoint_deck_text_field, only : integer_field, real_field, word_field, described, &
      largest_number
   use axijoint_model_request, only : print_type, print_names, print_deck, print_loads, &
      print_path, print_orders, rows_names, rows_every, rows_upto, rows_none, usual_rows
   implicit none
   private
   public :: print_section

   !> The keyword
   character(len=*), parameter :: keyword_print = 'PRINT'
   !> Fields: table, rows, n, body, and the first of four of a window
   integer, parameter :: field_what = 1, field_which = 2, field_n = 3, field_body = 4, &
      field_window = 5

contains

   !> PRINT
   function print_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_print
      section%purpose = 'how much of long tables the listing shows; without it tables '// &
         'of up to 1000 rows, but not ORDERS'
      section%stage = stage_requests
      section%read => read_print
      section%fields = &
         [described(word_field('the table', 1, 10, print_names), &
                    'table: DECK; COORDS, INCIDENCE, JOINTNODES of the mesh; LOADS; PATH of '// &
                    'iterations; AMPLITUDE, TOTALS of displacements; STRESSES at Gauss points; '// &
                    'NODAL ones; STATES of joints; REACTIONS; ORDERS of the nodes, side by side; '// &
                    'all TABLES'), &
          described(word_field('the rows', 11, 20, rows_names), &
                    'its rows', &
                    limits='ALL, EVERY n-th, UPTO n: all if they are so many at most, NONE'), &
          described(integer_field('the number', 21, 30, 1, largest_number, default=usual_rows), &
                    'n of EVERY and UPTO'), &
          described(body(31), 'of which body', blank='any'), &
          described([real_field('the least r', 36, default=0.0_wp, symbol='r'), &
                     real_field('the least z', 46, default=0.0_wp, symbol='z'), &
                     real_field('the largest r', 56, default=0.0_wp, symbol='r'), &
                     real_field('the largest z', 66, default=0.0_wp, symbol='z')], &
                    'least r, least z, largest r, largest z of a rectangle: of places in it', &
                    blank='anywhere', limits='all four, or none')]
   end function print_section

   !> Read what is wanted
   subroutine read_print(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(print_type) :: wanted
      integer :: n

      card = cards_of(deck, keyword_print)
      n = 0
      allocate (deck%model%print(card%table%n))
      do while (next_card(card))
         if (.not. is_good(card)) cycle
         wanted = print_type(integer_of(card, field_what), integer_of(card, field_which), &
            integer_of(card, field_n))
         call read_number(card, wanted)
         if (is_given(card, field_body)) then
            call check_body(card, field_body)
            wanted%body = integer_of(card, field_body)
         end if
         call read_window(card, wanted)
         call check_place(card, wanted)
         n = n + 1
         deck%model%print(n) = wanted
      end do
      deck%model%print = deck%model%print(:n)
   end subroutine read_print

   !> Judge the number of rows
   subroutine read_number(card, wanted)
      !> The card
      type(card_type), intent(in) :: card
      !> What it says
      type(print_type), intent(in) :: wanted

      logical :: takes

      takes = wanted%which == rows_every .or. wanted%which == rows_upto
      if (is_given(card, field_n) .and. .not. takes) &
         call field_fault(card, field_n, trim(rows_names(wanted%which))//' takes no number', &
                          mend='leave the field blank, or say EVERY or UPTO')
      if (wanted%which == rows_every .and. .not. is_given(card, field_n)) &
         call field_fault(card, field_n, 'EVERY needs a number', allowed='n: every n-th row')
   end subroutine read_number

   !> Read the rectangle
   subroutine read_window(card, wanted)
      !> The card
      type(card_type), intent(in) :: card
      !> Takes it
      type(print_type), intent(inout) :: wanted

      integer :: i, n_given

      n_given = count([(is_given(card, field_window + i), i=0, 3)])
      if (n_given == 0) return
      if (n_given < 4) then
         do i = 0, 3
            if (is_given(card, field_window + i)) cycle
            call field_fault(card, field_window + i, 'a rectangle has four ends', &
                             allowed='all four of least r, least z, largest r, largest z, or none')
            return
         end do
      end if
      wanted%least = [real_of(card, field_window), real_of(card, field_window + 1)]
      wanted%largest = [real_of(card, field_window + 2), real_of(card, field_window + 3)]
      do i = 1, 2
         if (wanted%largest(i) >= wanted%least(i)) cycle
         call field_fault(card, field_window + 1 + i, 'the largest '//merge('r', 'z', i == 1)// &
                          ' is below the least', allowed=to_text(wanted%least(i))//' or more')
      end do
   end subroutine read_window

   !> Judge whether the rows of a table have places, and whether it matters where they are
   subroutine check_place(card, wanted)
      !> The card
      type(card_type), intent(in) :: card
      !> What it says
      type(print_type), intent(in) :: wanted

      integer :: field

      do field = field_body, field_window + 3
         if (.not. is_given(card, field)) cycle
         if (any(wanted%what == [print_deck, print_loads, print_path, print_orders])) then
            call field_fault(card, field, 'rows of '//trim(print_names(wanted%what))// &
                             ' have no place', mend='leave the field blank')
            return
         else if (wanted%which == rows_none) then
            call field_fault(card, field, 'NONE takes no place', &
                             mend='leave the field blank; cards of one table add up')
            return
         end if
      end do
   end subroutine check_place

end module axijoint_deck_section_print
