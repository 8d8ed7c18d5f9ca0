!> Sums of all harmonics, for files that hold amplitudes and are compared with listings of totals
module axijoint_compare_table_totals
   use axijoint_base_kinds, only : wp, degree
   use axijoint_compare_table_cell, only : cell_type, cell_number
   use axijoint_compare_table_table, only : listing_type, table_type, column_type, open_table, &
      add_row, &
      find_column, kind_angle, kind_displacement, kind_stress
   implicit none
   private
   public :: add_totals

   !> Tables of amplitudes, and those of totals
   character(len=*), parameter :: amplitude_names(3) = [character(len=33) :: &
      'displacement amplitudes', 'stress amplitudes at Gauss points', &
      'stress amplitudes at nodes'], &
      total_names(3) = [character(len=24) :: 'total displacements', 'stresses at Gauss points', &
      'stresses at nodes']
   !> Components that go with w
   character(len=*), parameter :: circumferential(3) = [character(len=10) :: 'w', 'tau_rtheta', &
      'tau_ztheta']
   !> Multiple of the rounding of an angle below which its sine or cosine is zero
   real(wp), parameter :: rounding = 8.0_wp*epsilon(1.0_wp)

contains

   !> Add to an HDF5 file tables of totals at the angles at which another file has them, where this
   !> file has none. Amplitudes of stresses that the other file lacks are then left out: its totals
   !> stand for them
   subroutine add_totals(listing, other)
      !> The file
      type(listing_type), intent(inout) :: listing
      !> The file that it is compared with
      type(listing_type), intent(in) :: other

      integer :: kind, wanted, k

      if (.not. listing%aligned) return
      do kind = 1, size(total_names)
         wanted = table_of(other, total_names(kind))
         if (wanted == 0 .or. table_of(listing, total_names(kind)) > 0) cycle
         if (table_of(listing, amplitude_names(kind)) == 0) cycle
         call add_table(listing, trim(amplitude_names(kind)), trim(total_names(kind)), &
                        angles_of(other%tables(wanted)))
         if (table_of(other, amplitude_names(kind)) > 0) cycle
         do k = 1, listing%n_tables
            if (listing%tables(k)%name == amplitude_names(kind)) listing%tables(k)%left_out = .true.
         end do
      end do
   end subroutine add_totals

   !> Index of a table by its name; 0 if there is none
   pure integer function table_of(listing, name) result(found)
      !> The file
      type(listing_type), intent(in) :: listing
      !> Name
      character(len=*), intent(in) :: name

      do found = 1, listing%n_tables
         if (listing%tables(found)%name == name) return
      end do
      found = 0
   end function table_of

   !> Angles of a table
   pure function angles_of(table) result(angles)
      !> The table
      type(table_type), intent(in) :: table
      !> The angles [degrees]
      real(wp), allocatable :: angles(:)

      integer :: column, row

      allocate (angles(0))
      column = find_column(table, 'theta', kind_angle)
      if (column == 0) return
      do row = 1, table%n_rows
         if (any(abs(angles - table%cells(column, row)%value) <= 0.0_wp)) cycle
         angles = [angles, table%cells(column, row)%value]
      end do
   end function angles_of

   !> Add a table of totals
   subroutine add_table(listing, amplitudes, totals, angles)
      !> The file
      type(listing_type), intent(inout) :: listing
      !> Names of the tables of amplitudes and of the new one
      character(len=*), intent(in) :: amplitudes, totals
      !> The angles [degrees]
      real(wp), intent(in) :: angles(:)

      type(column_type), allocatable :: columns(:)
      type(cell_type), allocatable :: cells(:, :)
      type(cell_type) :: angle
      integer :: table, first, k, i, row

      first = table_of(listing, amplitudes)
      allocate (columns(size(listing%tables(first)%columns) + 1))
      columns(1)%name = 'theta'
      columns(1)%kind = kind_angle
      columns(2:) = listing%tables(first)%columns
      call open_table(listing, totals, '', columns, table)
      do i = 1, size(angles)
         cells = listing%tables(first)%cells(:, :listing%tables(first)%n_rows)
         where (spread(is_value(columns(2:)), 2, size(cells, 2))) cells%value = 0.0_wp
         do k = 1, listing%n_tables
            if (listing%tables(k)%name == amplitudes) &
               call add_mode(listing%tables(k), angles(i)*degree, cells)
         end do
         angle = cell_type(angles(i), 0.0_wp, cell_number)
         do row = 1, size(cells, 2)
            call add_row(listing%tables(table), [angle, cells(:, row)], 0)
         end do
      end do
   end subroutine add_table

   !> Columns that are summed
   elemental logical function is_value(column)
      !> The column
      type(column_type), intent(in) :: column

      is_value = column%kind == kind_displacement .or. column%kind == kind_stress
   end function is_value

   !> Add what one mode contributes to the totals
   subroutine add_mode(table, angle, cells)
      !> Amplitudes; parameters "m = 1, family = symmetric"
      type(table_type), intent(in) :: table
      !> Angle [radian]
      real(wp), intent(in) :: angle
      !> The totals
      type(cell_type), intent(inout) :: cells(:, :)

      real(wp) :: meridional, lateral
      integer :: m, k, row

      read (table%parameters(5:index(table%parameters, ',') - 1), *) m
      if (index(table%parameters, 'antisymmetric') == 0) then
         meridional = cos(m*angle)
         lateral = sin(m*angle)
      else
         meridional = sin(m*angle)
         lateral = -cos(m*angle)
      end if
      if (abs(meridional) < (m + 1)*rounding) meridional = 0.0_wp
      if (abs(lateral) < (m + 1)*rounding) lateral = 0.0_wp
      do k = 1, size(table%columns)
         if (.not. is_value(table%columns(k))) cycle
         do row = 1, size(cells, 2)
            cells(k, row)%value = cells(k, row)%value + table%cells(k, row)%value &
               *merge(lateral, meridional, any(circumferential == table%columns(k)%name))
            if (table%cells(k, row)%state /= cell_number) &
               cells(k, row)%state = table%cells(k, row)%state
         end do
      end do
   end subroutine add_mode

end module axijoint_compare_table_totals
