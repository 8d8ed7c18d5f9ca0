!> Differences of two tables
module axijoint_compare_judge
   use axijoint_base_kinds, only : wp
   use axijoint_compare_match, only : match_type
   use axijoint_compare_table_cell, only : cell_type, cell_number, cell_blank, cell_word, &
      cell_overflow
   use axijoint_compare_table_table, only : table_type, listing_type, find_column, kind_names, &
      kind_word
   use axijoint_compare_tolerances, only : tolerances_type, allowed_difference, floor_difference, &
      is_skipped
   implicit none
   private
   public :: column_result_type, table_result_type, judge_tables, largest_values

   !> Two values that differ
   type :: difference_type
      !> Index in the columns of the result
      integer :: column = 0
      !> Rows of both tables
      integer :: row_a = 0, row_b = 0
      !> Difference over what is allowed; the largest real if the values cannot be compared
      real(wp) :: excess = 0.0_wp
   end type difference_type

   !> What was found in a column
   type :: column_result_type
      !> Its index in both tables
      integer :: a = 0, b = 0
      !> Values that were compared, that differ too much, that cannot be compared
      integer :: n = 0, n_different = 0, n_unknown = 0
      !> Values that differ by more than the tolerances and by less than their last digits show
      integer :: n_rounded = 0
      !> Largest difference, and largest difference over the larger value where that is above all
      !> absolute tolerances
      real(wp) :: absolute = 0.0_wp, relative = 0.0_wp
      !> Rows in which they are
      integer :: absolute_at(2) = 0, relative_at(2) = 0
   end type column_result_type

   !> What was found in a table
   type :: table_result_type
      !> Columns that both tables have
      type(column_result_type), allocatable :: columns(:)
      !> The worst differences, the worst first
      type(difference_type), allocatable :: worst(:)
      !> Rows that have no partner
      integer :: n_only_a = 0, n_only_b = 0
   end type table_result_type

contains

   !> Compare the matched rows of two tables
   subroutine judge_tables(a, b, match, scales, tolerances, result)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> Which row is which
      type(match_type), intent(in) :: match
      !> Largest values of the files by kind
      real(wp), intent(in) :: scales(:)
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Differences
      type(table_result_type), intent(out) :: result

      real(wp) :: table_scales(size(scales))
      integer :: k, other

      allocate (result%columns(0), result%worst(0))
      result%n_only_a = count(match%partner == 0)
      result%n_only_b = count(match%partner_of_b == 0)
      table_scales = min(table_scale(a), table_scale(b))
      do k = 1, size(a%columns)
         if (a%columns(k)%kind < kind_word) cycle
         other = find_column(b, a%columns(k)%name, a%columns(k)%kind)
         if (other == 0 .or. is_skipped(tolerances, a%columns(k)%name) .or. &
             is_skipped(tolerances, trim(kind_names(a%columns(k)%kind)))) cycle
         result%columns = [result%columns, column_result_type(a=k, b=other)]
         call judge_column(a, b, match, table_scales(a%columns(k)%kind), &
                           scales(a%columns(k)%kind), tolerances, result)
      end do
   end subroutine judge_tables

   !> Compare the last column of a result
   subroutine judge_column(a, b, match, table_scale, file_scale, tolerances, result)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> Which row is which
      type(match_type), intent(in) :: match
      !> Largest values of the quantity in the table and in the files
      real(wp), intent(in) :: table_scale, file_scale
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Differences
      type(table_result_type), intent(inout) :: result

      real(wp) :: floor, excess
      integer :: row, special, n

      n = size(result%columns)
      associate (column => result%columns(n))
         special = special_of(tolerances, a%columns(column%a)%name, &
                              trim(kind_names(a%columns(column%a)%kind)))
         floor = floor_difference(tolerances, special, table_scale, file_scale)
         do row = 1, a%n_rows
            if (match%partner(row) == 0) cycle
            call judge_cells(a%cells(column%a, row), b%cells(column%b, match%partner(row)), floor, &
                             special, tolerances, [row, match%partner(row)], column, excess)
            if (excess > 1.0_wp) call keep_worst(result%worst, difference_type(n, row, &
               match%partner(row), excess), tolerances%n_worst)
         end do
      end associate
   end subroutine judge_column

   !> Compare two values
   subroutine judge_cells(a, b, floor, special, tolerances, rows, column, excess)
      !> The values
      type(cell_type), intent(in) :: a, b
      !> Difference that is allowed whatever the values
      real(wp), intent(in) :: floor
      !> Index of a special tolerance; 0 if there is none
      integer, intent(in) :: special
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Rows of the values
      integer, intent(in) :: rows(2)
      !> What was found so far
      type(column_result_type), intent(inout) :: column
      !> Difference over what is allowed, above 1 if it is too large
      real(wp), intent(out) :: excess

      logical :: alike, overflowed

      excess = 0.0_wp
      column%n = column%n + 1
      if (a%state == cell_number .and. b%state == cell_number) then
         call judge_numbers(a, b, floor, special, tolerances, rows, column, excess)
         if (excess > 1.0_wp) column%n_different = column%n_different + 1
         return
      end if
      alike = a%state == b%state
      if (alike .and. a%state == cell_blank) return
      if (alike .and. a%state == cell_word) then
         if (nint(a%value) == nint(b%value)) return
      else if (alike .or. a%state == cell_overflow .or. b%state == cell_overflow) then
         ! NaN on both sides, asterisks on one: nobody knows whether these are the same
         overflowed = a%state == cell_overflow .or. b%state == cell_overflow
         column%n_unknown = column%n_unknown + 1
         if (tolerances%unknown .and. (overflowed .or. nint(a%value) == nint(b%value))) return
      end if
      column%n_different = column%n_different + 1
      excess = huge(excess)
   end subroutine judge_cells

   !> Compare two numbers
   subroutine judge_numbers(a, b, floor, special, tolerances, rows, column, excess)
      !> The values
      type(cell_type), intent(in) :: a, b
      !> Difference that is allowed whatever the values
      real(wp), intent(in) :: floor
      !> Index of a special tolerance; 0 if there is none
      integer, intent(in) :: special
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Rows of the values
      integer, intent(in) :: rows(2)
      !> What was found so far
      type(column_result_type), intent(inout) :: column
      !> Difference over what is allowed
      real(wp), intent(out) :: excess

      type(cell_type) :: exact_a, exact_b
      real(wp) :: difference, allowed

      excess = 0.0_wp
      difference = abs(a%value - b%value)
      if (.not. difference > 0.0_wp) return
      if (difference > column%absolute) then
         column%absolute = difference
         column%absolute_at = rows
      end if
      if (difference > floor) then
         if (difference/max(abs(a%value), abs(b%value)) > column%relative) then
            column%relative = difference/max(abs(a%value), abs(b%value))
            column%relative_at = rows
         end if
      end if
      allowed = allowed_difference(tolerances, special, floor, a, b)
      if (difference <= allowed) then
         exact_a = cell_type(a%value, 0.0_wp, a%state)
         exact_b = cell_type(b%value, 0.0_wp, b%state)
         if (difference > allowed_difference(tolerances, special, floor, exact_a, exact_b)) &
            column%n_rounded = column%n_rounded + 1
         return
      end if
      excess = 2.0_wp
      if (allowed > difference*1.0e-200_wp) excess = difference/allowed
   end subroutine judge_numbers

   !> Keep a difference if it is among the worst
   subroutine keep_worst(worst, difference, n_kept)
      !> The worst, the worst first
      type(difference_type), allocatable, intent(inout) :: worst(:)
      !> The new one
      type(difference_type), intent(in) :: difference
      !> How many are kept
      integer, intent(in) :: n_kept

      integer :: place

      place = count(worst%excess >= difference%excess) + 1
      if (place > n_kept) return
      worst = [worst(:place - 1), difference, worst(place:min(size(worst), n_kept - 1))]
   end subroutine keep_worst

   !> Index of the tolerance of a column: its own, or that of its quantity; 0 if there is none
   pure integer function special_of(tolerances, name, quantity) result(special)
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Name of the column and of its quantity
      character(len=*), intent(in) :: name, quantity

      integer :: k

      special = 0
      do k = 1, size(tolerances%special)
         if (tolerances%special(k)%name == quantity .and. special == 0) special = k
      end do
      do k = 1, size(tolerances%special)
         if (tolerances%special(k)%name == name) special = k
      end do
   end function special_of

   !> Largest values of a file by kind
   pure function largest_values(listing) result(largest)
      !> The file
      type(listing_type), intent(in) :: listing
      !> The values
      real(wp) :: largest(size(kind_names))

      integer :: k

      largest = 0.0_wp
      do k = 1, listing%n_tables
         largest = max(largest, table_scale(listing%tables(k)))
      end do
   end function largest_values

   !> Largest values of a table by kind
   pure function table_scale(table) result(largest)
      !> The table
      type(table_type), intent(in) :: table
      !> The values
      real(wp) :: largest(size(kind_names))

      integer :: k, row

      largest = 0.0_wp
      do k = 1, size(table%columns)
         associate (scale => largest(table%columns(k)%kind))
            do row = 1, table%n_rows
               if (table%cells(k, row)%state == cell_number) &
                  scale = max(scale, abs(table%cells(k, row)%value))
            end do
         end associate
      end do
   end function table_scale

end module axijoint_compare_judge
