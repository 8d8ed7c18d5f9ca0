!> A file that is compared with a listing of Owen and Hinton's program: only what such a listing has
!> counts, but no harmonic and no increment is passed over
module axijoint_compare_old_layout
   use axijoint_base_text, only : to_text
   use axijoint_compare_table_cell, only : cell_type, cell_number
   use axijoint_compare_table_table, only : listing_type, table_type, column_type, open_table, &
      add_row, find_column, kind_angle, kind_displacement, kind_force, kind_label, &
      kind_coordinate, kind_stress, kind_skip
   implicit none
   private
   public :: fit_old_layout

   !> What the parameters of axisymmetric states end with
   character(len=*), parameter :: plain = 'm = 0, family = symmetric'

contains

   !> Fit a file to an old listing
   subroutine fit_old_layout(listing, old)
      !> The file
      type(listing_type), intent(inout) :: listing
      !> The old listing
      type(listing_type), intent(inout) :: old

      integer :: k

      if (.not. old%old_layout) return
      call forget_axis(old)
      if (listing%old_layout) return
      old%note = old%note//'; effective plastic strain is not compared: only listings of this '// &
         'kind have it'
      if (listing%aligned) then
         do k = 1, listing%n_tables
            if (.not. listing%tables(k)%left_out) call leave_unshown(listing%tables(k), old)
         end do
      else
         call take_last(listing, old)
      end if
      call skip_column(old, 'plastic')
   end subroutine fit_old_layout

   !> On the axis R_u works on nothing: the old program prints one, axijoint has none
   subroutine forget_axis(old)
      !> The old listing
      type(listing_type), intent(inout) :: old

      integer :: k, reaction, place, row

      old%note = 'R_u on the axis is not compared: it works on nothing'
      do k = 1, old%n_tables
         reaction = find_column(old%tables(k), 'R_u', kind_force)
         place = find_column(old%tables(k), 'r', kind_coordinate)
         if (reaction == 0 .or. place == 0) cycle
         associate (table => old%tables(k))
            do row = 1, table%n_rows
               if (table%cells(place, row)%state == cell_number .and. &
                   .not. abs(table%cells(place, row)%value) > 0.0) &
                  table%cells(reaction, row) = cell_type(state=cell_number)
            end do
         end associate
      end do
   end subroutine forget_axis

   !> Leave out what the old listing does not show of an increment that it names
   subroutine leave_unshown(table, old)
      !> Table of the file
      type(table_type), intent(inout) :: table
      !> The old listing
      type(listing_type), intent(in) :: old

      integer :: k

      if (index(table%parameters, plain) == 0) return
      if (find_state(old, table%name, table%parameters) > 0) return
      do k = 1, size(old%increments)
         if (index(table%parameters, 'increment = '//to_text(old%increments(k))//',') == 1) &
            table%left_out = .true.
      end do
   end subroutine leave_unshown

   !> Of axijoint's listing, which has the last increment alone: what the old listing has of it
   subroutine take_last(listing, old)
      !> axijoint's listing
      type(listing_type), intent(inout) :: listing
      !> The old listing
      type(listing_type), intent(inout) :: old

      character(len=:), allocatable :: state
      integer :: k, n

      state = 'increment = '//to_text(maxval(old%increments))//', '//plain
      n = listing%n_tables
      do k = 1, n
         associate (table => listing%tables(k))
            table%left_out = index(table%parameters, 'm = ') == 0 .or. &
               index(table%parameters, plain) > 0
         end associate
         call take_table('displacement amplitudes', 'displacement amplitudes', &
            [character(len=11) :: 'u', 'v'], kind_displacement)
         call take_table('reactions', 'reactions', [character(len=11) :: 'R_u', 'R_v'], kind_force)
         call take_table('stresses at Gauss points', 'stress amplitudes at Gauss points', &
            [character(len=11) :: 'sigma_r', 'sigma_z', 'tau_rz', 'sigma_theta'], kind_stress)
      end do
      old%note = 'what the other listing has not is not compared: increments before the last, '// &
         'effective plastic strain, R_u on the axis, largest and smallest stresses and angles'
      do k = 1, old%n_tables
         if (index(old%tables(k)%parameters, state) == 0) old%tables(k)%left_out = .true.
      end do
      call skip_column(old, 'largest')
      call skip_column(old, 'smallest')
      call skip_column(old, 'angle')

   contains

      !> Take a table of the listing
      subroutine take_table(name, old_name, values, kind)
         !> Its name here and there
         character(len=*), intent(in) :: name, old_name
         !> Columns of values, and their quantity
         character(len=*), intent(in) :: values(:)
         integer, intent(in) :: kind

         if (listing%tables(k)%name /= name) return
         if (len(listing%tables(k)%parameters) > 0 .and. listing%tables(k)%parameters /= plain) &
            return
         call copy_table(listing, k, old_name, state, values, kind)
      end subroutine take_table

   end subroutine take_last

   !> Copy labels, places and some values of a table, of its first angle alone if it has angles
   subroutine copy_table(listing, from, name, parameters, values, kind)
      !> The listing
      type(listing_type), intent(inout) :: listing
      !> The table
      integer, intent(in) :: from
      !> Name and parameters of the copy
      character(len=*), intent(in) :: name, parameters
      !> Columns of values, and their quantity
      character(len=*), intent(in) :: values(:)
      integer, intent(in) :: kind

      type(column_type), allocatable :: columns(:)
      type(cell_type), allocatable :: cells(:, :)
      integer, allocatable :: kept(:), lines(:)
      integer :: k, table, angle

      associate (source => listing%tables(from))
         kept = pack([(k, k=1, size(source%columns))], source%columns%kind == kind_label .or. &
            source%columns%kind == kind_coordinate)
         do k = 1, size(values)
            kept = [kept, find_column(source, trim(values(k)), kind)]
         end do
         columns = source%columns(kept)
         cells = source%cells(:, :source%n_rows)
         lines = source%line(:source%n_rows)
         angle = find_column(source, 'theta', kind_angle)
      end associate
      call open_table(listing, name, parameters, columns, table)
      do k = 1, size(lines)
         if (angle > 0) then
            if (abs(cells(angle, k)%value - cells(angle, 1)%value) > 0.0) cycle
         end if
         call add_row(listing%tables(table), cells(kept, k), lines(k))
      end do
   end subroutine copy_table

   !> Do not compare a column of the tables of results
   subroutine skip_column(listing, name)
      !> The listing
      type(listing_type), intent(inout) :: listing
      !> Its name
      character(len=*), intent(in) :: name

      integer :: k, i

      do k = 1, listing%n_tables
         do i = 1, size(listing%tables(k)%columns)
            if (listing%tables(k)%columns(i)%name == name) &
               listing%tables(k)%columns(i)%kind = kind_skip
         end do
      end do
   end subroutine skip_column

   !> Index of a table by name and parameters; 0 if there is none
   pure integer function find_state(listing, name, parameters) result(found)
      !> The file
      type(listing_type), intent(in) :: listing
      !> Name and parameters
      character(len=*), intent(in) :: name, parameters

      do found = listing%n_tables, 1, -1
         if (listing%tables(found)%name == name .and. &
             listing%tables(found)%parameters == parameters) return
      end do
   end function find_state

end module axijoint_compare_old_layout
