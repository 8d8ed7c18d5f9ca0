!> Columns by which the rows of two tables are matched
module axijoint_compare_keys
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : ascending_order
   use axijoint_compare_table_cell, only : cell_number, cell_word
   use axijoint_compare_table_table, only : table_type, find_column, kind_label, kind_key, &
      kind_coordinate, kind_angle
   implicit none
   private
   public :: key_type, keys_type, row_keys, chosen_keys, candidates

   !> A column by which rows are matched
   type :: key_type
      !> Its index in both tables
      integer :: a = 0, b = 0
   end type key_type

   !> Keys of all rows of a table
   type :: keys_type
      !> Values, shape (keys, rows)
      real(wp), allocatable :: value(:, :)
      !> Half of the interval that a value stands for, same shape
      real(wp), allocatable :: slack(:, :)
      !> Rows in ascending order of the first key; those without a key are left out
      integer, allocatable :: order(:)
      !> The first keys in that order
      real(wp), allocatable :: sorted(:)
      !> Largest slack of the first key
      real(wp) :: widest = 0.0_wp
   end type keys_type

   !> Angles nearer than this are the same [degrees]
   real(wp), parameter :: angle_slack = 1.0e-6_wp
   !> Part of the unit of the last digit that a printed coordinate or angle may be off by: half of it, and rounding
   real(wp), parameter :: half_digit = 0.51_wp
   !> Words as keys lie apart from all numbers
   real(wp), parameter :: word_offset = -1.0e9_wp

contains

   !> Columns by which rows are matched: r and z where both tables have them, otherwise the labels;
   !> in both cases theta and what means the same everywhere
   function chosen_keys(a, b) result(keys)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> The columns
      type(key_type), allocatable :: keys(:)

      logical :: by_place
      integer :: k, other, best

      by_place = all([find_column(a, 'r', kind_coordinate), find_column(a, 'z', kind_coordinate), &
                      find_column(b, 'r', kind_coordinate), &
                      find_column(b, 'z', kind_coordinate)] > 0)
      allocate (keys(0))
      do k = 1, size(a%columns)
         associate (column => a%columns(k))
            select case (column%kind)
            case (kind_coordinate, kind_angle, kind_key)
            case (kind_label)
               if (by_place) cycle
            case default
               cycle
            end select
            other = find_column(b, column%name, column%kind)
            if (other > 0) keys = [keys, key_type(k, other)]
         end associate
      end do
      if (size(keys) < 2) return
      ! the key with most values comes first: rows are searched by it
      best = maxloc([(n_values(a, keys(k)%a), k=1, size(keys))], 1)
      keys([1, best]) = keys([best, 1])
   end function chosen_keys

   !> How many different values a column has
   integer function n_values(table, column)
      !> The table
      type(table_type), intent(in) :: table
      !> The column
      integer, intent(in) :: column

      real(wp), allocatable :: values(:)
      integer :: k

      values = table%cells(column, :table%n_rows)%value
      values = values(ascending_order(values))
      n_values = min(1, size(values)) + count([(values(k) > values(k - 1), k=2, size(values))])
   end function n_values

   !> Keys of all rows
   subroutine row_keys(table, columns, tolerance, keys)
      !> The table
      type(table_type), intent(in) :: table
      !> Its columns
      integer, intent(in) :: columns(:)
      !> Distance of places that are the same
      real(wp), intent(in) :: tolerance
      !> The keys
      type(keys_type), intent(out) :: keys

      logical, allocatable :: known(:)
      integer :: row, k

      allocate (keys%value(size(columns), table%n_rows), keys%slack(size(columns), table%n_rows))
      allocate (known(table%n_rows))
      do row = 1, table%n_rows
         do k = 1, size(columns)
            associate (cell => table%cells(columns(k), row), value => keys%value(k, row), &
                       slack => keys%slack(k, row))
               value = cell%value
               slack = 0.25_wp
               if (cell%state == cell_word) value = word_offset - cell%value
               if (table%columns(columns(k))%kind == kind_coordinate) then
                  slack = half_digit*cell%unit + tolerance
               else if (table%columns(columns(k))%kind == kind_angle) then
                  slack = half_digit*cell%unit + angle_slack
                  value = modulo(value, 360.0_wp)
                  if (360.0_wp - value <= slack) value = 0.0_wp
               end if
            end associate
         end do
         known(row) = all(table%cells(columns, row)%state == cell_number &
                          .or. table%cells(columns, row)%state == cell_word)
      end do
      keys%order = ascending_order(keys%value(1, :))
      keys%order = pack(keys%order, known(keys%order))
      keys%sorted = keys%value(1, keys%order)
      keys%widest = maxval([0.0_wp, keys%slack(1, :)])
   end subroutine row_keys

   !> Rows whose keys agree with those of a row
   pure subroutine candidates(keys, value, slack, rows, n)
      !> Keys of the table that is searched
      type(keys_type), intent(in) :: keys
      !> Keys of the row, and their slack
      real(wp), intent(in) :: value(:), slack(:)
      !> The rows
      integer, allocatable, intent(inout) :: rows(:)
      !> How many
      integer, intent(out) :: n

      integer :: low, high, middle, row

      n = 0
      low = 1
      high = size(keys%sorted) + 1
      do while (low < high)
         middle = (low + high)/2
         if (keys%sorted(middle) < value(1) - slack(1) - keys%widest) then
            low = middle + 1
         else
            high = middle
         end if
      end do
      do middle = low, size(keys%sorted)
         if (keys%sorted(middle) > value(1) + slack(1) + keys%widest) exit
         row = keys%order(middle)
         if (any(abs(keys%value(:, row) - value) > keys%slack(:, row) + slack)) cycle
         n = n + 1
         if (n > size(rows)) rows = [rows, rows]
         rows(n) = row
      end do
   end subroutine candidates

end module axijoint_compare_keys
