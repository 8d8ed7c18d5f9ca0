!> Places of the Gauss points of a listing of Owen and Hinton's program, from its nodes and elements;
!> how sure its angles are
module axijoint_compare_read_old_points
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_compare_table_cell, only : cell_type, cell_number
   use axijoint_compare_table_table, only : listing_type, table_type, column_type, append_columns, &
      find_column, kind_coordinate, kind_stress, kind_other
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_element
   implicit none
   private
   public :: place_points, settle_angles

   !> Places of the nodes on the cards, round the perimeter, among corners, then middles, then centre
   integer, parameter :: ring(9) = [1, 3, 5, 7, 2, 4, 6, 8, 9]
   !> Stresses below this share of the largest are rounding
   real(wp), parameter :: noise = 1.0e-9_wp

contains

   !> Give places to all Gauss points, if nodes and elements are in the file. Points run along eta
   !> first: the number of a point is (i - 1) n + j of xi_i and eta_j
   subroutine place_points(listing, n_given)
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Points in each direction; 0 if that is not known
      integer, intent(in) :: n_given

      type(number_map_type) :: node_rows, element_rows
      type(column_type) :: columns(2)
      type(cell_type), allocatable :: places(:, :)
      integer :: nodes, elements, k, row, n

      nodes = table_named('nodes')
      elements = table_named('elements')
      if (nodes == 0 .or. elements == 0) return
      call number_rows(listing%tables(nodes), node_rows)
      call number_rows(listing%tables(elements), element_rows)
      columns(1)%name = 'r'
      columns(2)%name = 'z'
      columns%kind = kind_coordinate
      do k = 1, listing%n_tables
         if (find_column(listing%tables(k), 'sigma_r', kind_stress) == 0) cycle
         associate (table => listing%tables(k))
            allocate (places(2, table%n_rows))
            n = n_given
            if (n == 0) n = nint(sqrt(maxval([1.0_wp, table%cells(2, :table%n_rows)%value])))
            do row = 1, table%n_rows
               call place_point(listing%tables(nodes), node_rows, listing%tables(elements), &
                  find_number(element_rows, nint(table%cells(1, row)%value)), n, &
                  nint(table%cells(2, row)%value), places(:, row))
            end do
            call append_columns(table, columns, places)
            deallocate (places)
         end associate
      end do

   contains

      !> Index of a table; 0 if there is none
      integer function table_named(name) result(found)
         !> Its name
         character(len=*), intent(in) :: name

         do found = listing%n_tables, 1, -1
            if (listing%tables(found)%name == name) return
         end do
      end function table_named

   end subroutine place_points

   !> Rows by their numbers
   subroutine number_rows(table, rows)
      !> The table
      type(table_type), intent(in) :: table
      !> Row of each number
      type(number_map_type), intent(inout) :: rows

      integer :: row

      do row = 1, table%n_rows
         if (table%cells(1, row)%state == cell_number .and. table%cells(1, row)%value > 0.5_wp) &
            call insert_number(rows, nint(table%cells(1, row)%value), row)
      end do
   end subroutine number_rows

   !> Place of a Gauss point; blank if its element or a node of it is not there
   subroutine place_point(nodes, node_rows, elements, element, n, point, place)
      !> Tables, and rows of nodes by number
      type(table_type), intent(in) :: nodes, elements
      type(number_map_type), intent(in) :: node_rows
      !> Row of the element, 0 if it has none; points in each direction; number of the point
      integer, intent(in) :: element, n, point
      !> r and z
      type(cell_type), intent(out) :: place(2)

      real(wp) :: x(3), w(3), shape(9), derivative(2, 9)
      integer :: n_nodes, rows(9), i, k

      if (element == 0 .or. n < 2 .or. n > 3 .or. point < 1 .or. point > n*n) return
      n_nodes = count(elements%cells(3:11, element)%state == cell_number)
      if (all(n_nodes /= [4, 8, 9])) return
      do i = 1, n_nodes
         k = i
         if (n_nodes > 4) k = ring(i)
         rows(i) = find_number(node_rows, nint(elements%cells(2 + k, element)%value))
      end do
      if (any(rows(:n_nodes) == 0)) return
      call gauss_rule(n, x, w)
      call shape_element(n_nodes, x((point - 1)/n + 1), x(mod(point - 1, n) + 1), shape(:n_nodes), &
         derivative(:, :n_nodes))
      do i = 1, 2
         associate (at => nodes%cells(1 + i, rows(:n_nodes)))
            place(i) = cell_type(dot_product(shape(:n_nodes), at%value), &
               dot_product(abs(shape(:n_nodes)), at%unit), cell_number)
         end associate
      end do
   end subroutine place_point

   !> Say how sure angles are: where the stresses that they come from are as good as equal, rounding
   !> turns them. -45 degrees are 45
   subroutine settle_angles(listing)
      !> The tables
      type(listing_type), intent(inout) :: listing

      real(wp) :: half, radius, sure, largest
      integer :: k, row, first, angle

      do k = 1, listing%n_tables
         associate (table => listing%tables(k))
            first = find_column(table, 'sigma_r', kind_stress)
            angle = find_column(table, 'angle', kind_other)
            if (first == 0 .or. angle == 0) cycle
            largest = maxval([0.0_wp, abs(table%cells(first:first + 3, :table%n_rows)%value)])
            do row = 1, table%n_rows
               associate (stress => table%cells(first:first + 3, row), cell => table%cells(angle, &
                          row))
                  if (any(stress(:3)%state /= cell_number) .or. cell%state /= cell_number) cycle
                  half = 0.5_wp*(stress(1)%value - stress(2)%value)
                  radius = hypot(half, stress(3)%value)
                  sure = maxval(stress(:3)%unit) + 2.0_wp*noise*largest
                  if (radius > sure) then
                     ! one unit more than half of each: what is given to the rounding of both files
                     cell%unit = cell%unit + sure/radius/degree
                     if (cell%value < cell%unit - 45.0_wp) cell%value = cell%value + 90.0_wp
                  else
                     cell%unit = 180.0_wp
                  end if
               end associate
            end do
         end associate
      end do
   end subroutine settle_angles

end module axijoint_compare_read_old_points
