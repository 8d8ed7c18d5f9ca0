!> Which row of one table is which of another
module axijoint_compare_match
   use axijoint_base_kinds, only : wp
   use axijoint_compare_keys, only : key_type, keys_type, row_keys, chosen_keys, candidates
   use axijoint_compare_table_cell, only : cell_type, cell_number
   use axijoint_compare_table_numbering, only : numbering_type, learn, same_numbers, known_partner
   use axijoint_compare_table_table, only : table_type, find_column, kind_label, kind_coordinate, &
      kind_word
   implicit none
   private
   public :: match_type, match_rows

   !> Rows that belong together
   type :: match_type
      !> Row of the second table for each of the first; 0 if it has none
      integer, allocatable :: partner(:)
      !> Row of the first table for each of the second; 0 if it has none
      integer, allocatable :: partner_of_b(:)
      !> Names of the columns by which rows were matched; empty: by their order
      character(len=:), allocatable :: keys
      !> Pairs that were chosen because they differ least
      integer :: n_least = 0
   end type match_type

   !> Cost of a pair whose numbers agree, of one whose numbers are known to belong to others, and of
   !> one that is taken
   real(wp), parameter :: certain = -1.0_wp, foreign = 1.0e3_wp, taken = 1.0e300_wp

contains

   !> Match the rows of two tables
   subroutine match_rows(a, b, tolerance, numberings, match)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> Distance of places that are the same, of the largest coordinate
      real(wp), intent(in) :: tolerance
      !> Numbers of nodes and so on in both files, completed
      type(numbering_type), allocatable, intent(inout) :: numberings(:)
      !> The pairs
      type(match_type), intent(out) :: match

      type(key_type), allocatable :: keys(:)
      type(keys_type) :: keys_a, keys_b
      real(wp) :: distance
      integer :: k

      allocate (match%partner(a%n_rows), match%partner_of_b(b%n_rows), source=0)
      keys = chosen_keys(a, b)
      match%keys = ''
      if (size(keys) == 0) then
         do k = 1, min(a%n_rows, b%n_rows)
            match%partner(k) = k
            match%partner_of_b(k) = k
         end do
         return
      end if
      do k = 1, size(keys)
         if (k > 1) match%keys = match%keys//', '
         match%keys = match%keys//a%columns(keys(k)%a)%name
      end do
      distance = tolerance*extent(a)
      call row_keys(a, (keys%a), distance, keys_a)
      call row_keys(b, (keys%b), distance, keys_b)
      call match_unique(a, b, keys_a, keys_b, numberings, match)
      call match_groups(a, b, keys_a, keys_b, numberings, match)
   end subroutine match_rows

   !> Largest coordinate of a table
   pure real(wp) function extent(table)
      !> The table
      type(table_type), intent(in) :: table

      integer :: k

      extent = 0.0_wp
      do k = 1, size(table%columns)
         if (table%columns(k)%kind /= kind_coordinate) cycle
         extent = max(extent, maxval([0.0_wp, abs(table%cells(k, :table%n_rows)%value)]))
      end do
   end function extent

   !> Pairs of rows that agree with each other and with no other row
   subroutine match_unique(a, b, keys_a, keys_b, numberings, match)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> Their keys
      type(keys_type), intent(in) :: keys_a, keys_b
      !> Numbers in both files
      type(numbering_type), allocatable, intent(inout) :: numberings(:)
      !> The pairs
      type(match_type), intent(inout) :: match

      integer, allocatable :: rows(:), back(:)
      integer :: i, n, row, n_back

      allocate (rows(16), back(16), source=0)
      do i = 1, size(keys_a%order)
         row = keys_a%order(i)
         call candidates(keys_b, keys_a%value(:, row), keys_a%slack(:, row), rows, n)
         if (n /= 1) cycle
         call candidates(keys_a, keys_b%value(:, rows(1)), keys_b%slack(:, rows(1)), back, n_back)
         if (n_back == 1) call join(a, b, row, rows(1), numberings, match)
      end do
   end subroutine match_unique

   !> Rows that share their keys with others, such as the nodes on both sides of a joint: by their
   !> numbers if these are known to correspond, otherwise those together that differ least
   subroutine match_groups(a, b, keys_a, keys_b, numberings, match)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> Their keys
      type(keys_type), intent(in) :: keys_a, keys_b
      !> Numbers in both files
      type(numbering_type), allocatable, intent(inout) :: numberings(:)
      !> The pairs
      type(match_type), intent(inout) :: match

      integer, allocatable :: rows_a(:), rows_b(:), free_a(:), free_b(:)
      integer :: i, row, n

      allocate (rows_a(16), rows_b(16), source=0)
      do i = 1, size(keys_a%order)
         row = keys_a%order(i)
         if (match%partner(row) > 0) cycle
         call candidates(keys_b, keys_a%value(:, row), keys_a%slack(:, row), rows_b, n)
         free_b = pack(rows_b(:n), match%partner_of_b(rows_b(:n)) == 0)
         if (size(free_b) == 0) cycle
         call candidates(keys_a, keys_b%value(:, free_b(1)), keys_b%slack(:, free_b(1)), rows_a, n)
         free_a = pack(rows_a(:n), match%partner(rows_a(:n)) == 0)
         call match_group(a, b, free_a, free_b, numberings, match)
      end do
   end subroutine match_groups

   !> Pairs among rows that share their keys, the best first
   subroutine match_group(a, b, rows_a, rows_b, numberings, match)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> The rows
      integer, intent(in) :: rows_a(:), rows_b(:)
      !> Numbers in both files
      type(numbering_type), allocatable, intent(inout) :: numberings(:)
      !> The pairs
      type(match_type), intent(inout) :: match

      real(wp), allocatable :: cost(:, :)
      integer :: i, j, k, best(2)
      logical :: sure

      sure = .true.
      allocate (cost(size(rows_a), size(rows_b)))
      do j = 1, size(rows_b)
         do i = 1, size(rows_a)
            cost(i, j) = pair_cost(a, b, rows_a(i), rows_b(j), numberings)
         end do
      end do
      do k = 1, min(size(rows_a), size(rows_b))
         best = minloc(cost)
         i = best(1)
         j = best(2)
         if (cost(i, j) > certain .and. size(cost) > 1) match%n_least = match%n_least + 1
         ! where other pairs are as good, the numbers of all rows of the group remain unknown
         if (cost(i, j) > certain) sure = sure .and. second(cost, i, j) > cost(i, j)
         call join(a, b, rows_a(i), rows_b(j), numberings, match, sure)
         cost(i, :) = taken
         cost(:, j) = taken
      end do
   end subroutine match_group

   !> Least cost of another pair for either row of a pair
   pure real(wp) function second(cost, i, j)
      !> Costs of all pairs
      real(wp), intent(in) :: cost(:, :)
      !> The pair
      integer, intent(in) :: i, j

      integer :: k

      second = minval([(cost(k, j), k=1, i - 1), (cost(k, j), k=i + 1, size(cost, 1)), &
                       (cost(i, k), k=1, j - 1), (cost(i, k), k=j + 1, size(cost, 2)), taken])
   end function second

   !> How badly two rows go together: by their numbers if these are known, otherwise the sum of
   !> differences of their values, each over the larger one
   pure real(wp) function pair_cost(a, b, row_a, row_b, numberings) result(cost)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> The rows
      integer, intent(in) :: row_a, row_b
      !> Numbers in both files
      type(numbering_type), intent(in) :: numberings(:)

      integer :: k, other, partner
      logical :: agree

      cost = 0.0_wp
      agree = any(a%columns%kind == kind_label)
      do k = 1, size(a%columns)
         other = find_column(b, a%columns(k)%name, a%columns(k)%kind)
         if (other == 0) cycle
         associate (cell_a => a%cells(k, row_a), cell_b => b%cells(other, row_b), &
                    name => a%columns(k)%name)
            if (a%columns(k)%kind == kind_label) then
               partner = partner_of(numberings, name, cell_a)
               agree = agree .and. partner > 0 .and. partner == number_of(cell_b)
               if (partner > 0 .and. partner /= number_of(cell_b) &
                   .and. .not. same_numbers(numberings, name)) cost = cost + foreign
            else if (a%columns(k)%kind >= kind_word) then
               cost = cost + distance(cell_a, cell_b)
            end if
         end associate
      end do
      if (agree) cost = certain
   end function pair_cost

   !> Difference of two values over the larger one; 1 if they are of different kinds
   pure real(wp) function distance(a, b)
      !> The values
      type(cell_type), intent(in) :: a, b

      distance = 1.0_wp
      if (a%state /= b%state) return
      distance = abs(a%value - b%value)
      if (distance > 0.0_wp) distance = distance/max(abs(a%value), abs(b%value))
   end function distance

   !> Number of a label; 0 if it is none
   pure integer function number_of(cell)
      !> The label
      type(cell_type), intent(in) :: cell

      number_of = 0
      if (cell%state == cell_number) number_of = nint(cell%value)
   end function number_of

   !> Number that a thing of the first file has in the second; 0 if it is not known
   pure integer function partner_of(numberings, name, cell) result(partner)
      !> Numbers in both files
      type(numbering_type), intent(in) :: numberings(:)
      !> Kind of thing
      character(len=*), intent(in) :: name
      !> Its label
      type(cell_type), intent(in) :: cell

      partner = number_of(cell)
      if (.not. same_numbers(numberings, name)) partner = known_partner(numberings, name, partner)
   end function partner_of

   !> Two rows belong together
   subroutine join(a, b, row_a, row_b, numberings, match, sure)
      !> The tables
      type(table_type), intent(in) :: a, b
      !> The rows
      integer, intent(in) :: row_a, row_b
      !> Numbers in both files, completed
      type(numbering_type), allocatable, intent(inout) :: numberings(:)
      !> The pairs
      type(match_type), intent(inout) :: match
      !> False if the rows could as well belong to others
      logical, intent(in), optional :: sure

      integer :: k, other

      match%partner(row_a) = row_b
      match%partner_of_b(row_b) = row_a
      if (present(sure)) then
         if (.not. sure) return
      end if
      do k = 1, size(a%columns)
         if (a%columns(k)%kind /= kind_label) cycle
         other = find_column(b, a%columns(k)%name, kind_label)
         if (other == 0) cycle
         if (a%cells(k, row_a)%state /= cell_number &
            .or. b%cells(other, row_b)%state /= cell_number) cycle
         if (a%columns(k)%name == 'point') cycle
         call learn(numberings, a%columns(k)%name, nint(a%cells(k, row_a)%value), &
                    nint(b%cells(other, row_b)%value))
      end do
   end subroutine join

end module axijoint_compare_match
