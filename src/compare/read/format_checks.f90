!> What a format description must have as a whole
module axijoint_compare_read_format_checks
   use axijoint_compare_read_format, only : format_type, table_format_type, place_free, &
      place_fixed, &
      end_heading, place_heading
   use axijoint_compare_table_table, only : kind_coordinate
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_source, only : source_type
   implicit none
   private
   public :: check_format

contains

   !> Check a format that was read
   subroutine check_format(source, format, table_card, diagnostics)
      !> Cards
      type(source_type), intent(in) :: source
      !> The format
      type(format_type), intent(in) :: format
      !> Card of each table
      integer, intent(in) :: table_card(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: k

      if (diagnostics%n_errors > 0) return
      if (size(format%tables) == 0) then
         call add_error(diagnostics, min(1, source%n_cards), 0, 0, &
            'the format describes no table', &
            mend='a table is described by the cards TABLE, HEADING, COLUMN; see doc/compare.md')
      end if
      do k = 1, size(format%tables)
         call check_table(format%tables(k), table_card(k), diagnostics)
      end do
   end subroutine check_format

   !> Check a table
   subroutine check_table(table, card, diagnostics)
      !> The table
      type(table_format_type), intent(in) :: table
      !> Its TABLE card
      integer, intent(in) :: card
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: k

      if (len(table%heading) == 0) call add_error(diagnostics, card, 0, 0, &
         'the table has no HEADING card', &
         mend='add HEADING and the words that its heading begins with')
      if (size(table%columns) == 0) then
         call add_error(diagnostics, card, 0, 0, 'the table has no COLUMN card', &
            mend='add a COLUMN card for each column')
         return
      end if
      if (any(table%columns%place == place_free) .and. any(table%columns%place == place_fixed)) then
         call add_error(diagnostics, card, 0, 0, 'the table has fixed and free columns', &
            mend='give columns FIRST-LAST to all columns or to none')
      end if
      if (table%ending == end_heading .and. any(table%columns%place < place_heading)) then
         call add_error(diagnostics, card, 0, 0, 'a table without rows has columns in rows', &
            mend='its columns are read from the heading: add the word heading')
      end if
      do k = 1, size(table%columns)
         associate (column => table%columns(k))
            if (column%kind == kind_coordinate .and. column%name /= 'r' &
               .and. column%name /= 'z') then
               call add_error(diagnostics, card, 0, 0, 'a coordinate has the name '//column%name, &
                  allowed='r z')
            end if
            if (count_name(table, column%name) > 1) then
               call add_error(diagnostics, card, 0, 0, 'two columns have the name '//column%name, &
                  mend='columns that are not compared have the kind skip, and names of their own')
            end if
         end associate
      end do
   end subroutine check_table

   !> How many columns have a name
   pure integer function count_name(table, name)
      !> The table
      type(table_format_type), intent(in) :: table
      !> The name
      character(len=*), intent(in) :: name

      integer :: k

      count_name = 0
      do k = 1, size(table%columns)
         if (table%columns(k)%name == name) count_name = count_name + 1
      end do
   end function count_name

end module axijoint_compare_read_format_checks
