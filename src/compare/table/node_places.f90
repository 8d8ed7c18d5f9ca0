!> Coordinates for tables that give node numbers alone
module axijoint_compare_table_node_places
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_compare_table_cell, only : cell_type, cell_number
   use axijoint_compare_table_table, only : listing_type, table_type, find_column, append_columns, &
      kind_label, kind_coordinate
   implicit none
   private
   public :: place_nodes

contains

   !> Give r and z of the table `nodes` to each table that has a label `node` and no coordinates
   subroutine place_nodes(listing)
      !> All tables of a file
      type(listing_type), intent(inout) :: listing

      type(number_map_type) :: rows
      integer :: nodes, label, k, row, place(2)

      do nodes = 1, listing%n_tables
         if (listing%tables(nodes)%name == 'nodes') exit
      end do
      if (nodes > listing%n_tables) return
      associate (table => listing%tables(nodes))
         label = find_column(table, 'node', kind_label)
         place = [find_column(table, 'r', kind_coordinate), &
            find_column(table, 'z', kind_coordinate)]
         if (label == 0 .or. any(place == 0)) return
         do row = 1, table%n_rows
            if (table%cells(label, row)%state == cell_number &
               .and. table%cells(label, row)%value > 0.5) &
               call insert_number(rows, nint(table%cells(label, row)%value), row)
         end do
      end associate
      do k = 1, listing%n_tables
         if (k /= nodes) call place_rows(listing%tables(k), listing%tables(nodes), rows, place)
      end do
   end subroutine place_nodes

   !> Give coordinates to the rows of a table
   subroutine place_rows(table, nodes, rows, place)
      !> The table
      type(table_type), intent(inout) :: table
      !> Table of nodes
      type(table_type), intent(in) :: nodes
      !> Its row for each node
      type(number_map_type), intent(in) :: rows
      !> Its columns of r and z
      integer, intent(in) :: place(2)

      type(cell_type), allocatable :: cells(:, :)
      integer :: label, row, found

      label = find_column(table, 'node', kind_label)
      if (label == 0 .or. find_column(table, 'r', kind_coordinate) > 0) return
      allocate (cells(2, table%n_rows))
      do row = 1, table%n_rows
         if (table%cells(label, row)%state /= cell_number) cycle
         found = find_number(rows, nint(table%cells(label, row)%value))
         if (found > 0) cells(:, row) = nodes%cells(place, found)
      end do
      call append_columns(table, nodes%columns(place), cells)
   end subroutine place_rows

end module axijoint_compare_table_node_places
