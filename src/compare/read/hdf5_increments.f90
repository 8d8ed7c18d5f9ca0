!> States of all increments of axijoint's HDF5 result file, as a listing of Owen and Hinton's program
!> has them
module axijoint_compare_read_hdf5_increments
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_compare_read_hdf5_arrays, only : result_file_type
   use axijoint_compare_read_hdf5_cells, only : array_type, array, at, number, new_column, &
      columns_of, coordinates
   use axijoint_compare_table_table, only : listing_type, column_type, open_table, add_row, &
      kind_label, kind_displacement, kind_force, kind_stress, kind_other
   use axijoint_element_principal, only : plane_principal
   implicit none
   private
   public :: add_increments, mode_name_type, read_modes, add_nodal

   !> Names of components: the meridional ones, then those of theta
   character(len=*), parameter :: displacement_names(3) = ['u', 'v', 'w'], &
      reaction_names(3) = ['R_u', 'R_v', 'R_w'], &
      stress_names(6) = [character(len=11) :: 'sigma_r', 'sigma_z', 'sigma_theta', 'tau_rz', &
                         'tau_rtheta', 'tau_ztheta']

   !> What tables of a mode are called
   type :: mode_name_type
      !> Such as "m = 0, family = symmetric"
      character(len=:), allocatable :: text
      !> Whether it is that of axisymmetric states
      logical :: plain = .false.
   end type mode_name_type

contains

   !> Add tables of all increments, which stand for all others, if the file is compared with an old
   !> listing
   subroutine add_increments(listing, other, error)
      !> The file
      type(listing_type), intent(inout) :: listing
      !> What it is compared with
      type(listing_type), intent(in) :: other
      !> It cannot be read
      type(error_type), allocatable, intent(out) :: error

      type(result_file_type) :: file

      if (.not. (listing%aligned .and. other%old_layout)) return
      listing%tables(:listing%n_tables)%left_out = .true.
      call file%open(listing%path)
      call add_nodal(file, listing, 'displacement amplitudes', 'displacement', '/displacement', &
         columns_of(displacement_names, kind_displacement))
      call add_nodal(file, listing, 'reactions', 'reaction', '/reaction', &
         columns_of(reaction_names, kind_force))
      call add_stresses(file, listing)
      if (len(file%failure) > 0) &
         call fatal_error(error, exit_deck, listing%path//': error: '//file%failure)
      call file%close()
   end subroutine add_increments

   !> Values of increments, and which these are: of the history, or if nothing is kept there those of
   !> the end
   subroutine read_states(file, name, kept, final, values, increments)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Dataset of the history, of the increments in it, of the end
      character(len=*), intent(in) :: name, kept, final
      !> The values, the last extent over increments
      type(array_type), intent(out) :: values
      !> The increments
      integer, allocatable, intent(out) :: increments(:)

      type(array_type) :: number_of

      if (file%has('/history/'//name)) then
         values = array(file, '/history/'//name)
         number_of = array(file, '/history/'//kept)
         increments = nint(number_of%value)
      else
         values = array(file, final)
         number_of = array(file, '/history/increment')
         increments = [nint(maxval([0.0_wp, number_of%value]))]
      end if
   end subroutine read_states

   !> What the tables of the modes are called, and which of them is that of axisymmetric states
   subroutine read_modes(file, modes)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The modes
      type(mode_name_type), allocatable, intent(out) :: modes(:)

      character(len=13), parameter :: families(2) = [character(len=13) :: 'symmetric', &
         'antisymmetric']
      type(array_type) :: harmonic, family
      integer :: k

      harmonic = array(file, '/modes/harmonic')
      family = array(file, '/modes/family')
      allocate (modes(size(harmonic%value)))
      do k = 1, size(modes)
         modes(k)%text = 'm = '//to_text(nint(at(harmonic, k)))//', family = '// &
            trim(families(min(2, max(1, nint(at(family, k))))))
         modes(k)%plain = nint(at(harmonic, k)) == 0 .and. nint(at(family, k)) == 1
      end do
   end subroutine read_modes

   !> Displacements or reactions; of axisymmetric states without those along theta. Reactions of
   !> nodes that nothing holds are left out
   subroutine add_nodal(file, listing, title, name, final, components)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the tables; dataset in the history, and at the end
      character(len=*), intent(in) :: title, name, final
      !> Columns of the components
      type(column_type), intent(in) :: components(:)

      type(array_type) :: label, place, fixed, values
      type(mode_name_type), allocatable :: modes(:)
      integer, allocatable :: increments(:)
      integer :: i, k, mode, node, table, n

      label = array(file, '/mesh/node_label')
      place = array(file, '/mesh/coordinates')
      fixed = array(file, '/mesh/fixed')
      call read_modes(file, modes)
      call read_states(file, name, 'displacement_increment', final, values, increments)
      if (len(file%failure) > 0) return
      do i = 1, size(increments)
         do mode = 1, size(modes)
            n = merge(2, 3, modes(mode)%plain)
            call open_table(listing, title, 'increment = '//to_text(increments(i))//', '// &
               modes(mode)%text, [new_column('node', kind_label), coordinates(), components(:n)], &
               table)
            do node = 1, values%extent(2)
               if (final == '/reaction') then
                  if (.not. any([(at(fixed, k, node) > 0.5_wp .or. &
                                  abs(at(values, k, node, mode, i)) > 0.0_wp, k=1, n)])) cycle
               end if
               call add_row(listing%tables(table), [number(at(label, node)), &
                  number(at(place, 1, node)), number(at(place, 2, node)), &
                  number([(at(values, k, node, mode, i), k=1, n)])], 0)
            end do
         end do
      end do
   end subroutine add_nodal

   !> Stresses at Gauss points; of axisymmetric states those that an old listing has
   subroutine add_stresses(file, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing

      character(len=*), parameter :: title = 'stress amplitudes at Gauss points'
      type(array_type) :: label, owner, place, values
      type(mode_name_type), allocatable :: modes(:)
      integer, allocatable :: increments(:), numbers(:)
      real(wp) :: stress(6)
      integer :: i, k, mode, point, table

      label = array(file, '/mesh/element_label')
      owner = array(file, '/stress/element')
      place = array(file, '/stress/position')
      call read_modes(file, modes)
      call read_states(file, 'stress', 'stress_increment', '/stress/amplitude', values, increments)
      if (len(file%failure) > 0) return
      numbers = old_numbers(nint(owner%value))
      do i = 1, size(increments)
         do mode = 1, size(modes)
            call open_table(listing, title, 'increment = '//to_text(increments(i))//', '// &
               modes(mode)%text, stress_columns(modes(mode)%plain), table)
            do point = 1, size(numbers)
               stress = [(at(values, k, point, mode, i), k=1, 6)]
               if (modes(mode)%plain) then
                  call add_row(listing%tables(table), number([at(label, nint(at(owner, point))), &
                     real(numbers(point), wp), at(place, 1, point), at(place, 2, point), &
                     stress([1, 2, 4, 3]), plane_principal(stress([1, 2, 4]))]), 0)
               else
                  call add_row(listing%tables(table), number([at(label, nint(at(owner, point))), &
                     real(numbers(point), wp), at(place, 1, point), at(place, 2, point), stress]), 0)
               end if
            end do
         end do
      end do
   end subroutine add_stresses

   !> Columns of a table of stresses
   pure function stress_columns(plain) result(columns)
      !> Whether states are axisymmetric
      logical, intent(in) :: plain
      !> The columns
      type(column_type), allocatable :: columns(:)

      columns = [new_column('element', kind_label), new_column('point', kind_label), coordinates()]
      if (plain) then
         columns = [columns, columns_of([character(len=11) :: 'sigma_r', 'sigma_z', 'tau_rz', &
            'sigma_theta', 'largest', 'smallest'], kind_stress), new_column('angle', kind_other)]
      else
         columns = [columns, columns_of(stress_names, kind_stress)]
      end if
   end function stress_columns

   !> Numbers that the Gauss points of quadrilaterals have in an old listing, where they run along
   !> eta first
   pure function old_numbers(owner) result(numbers)
      !> Element of each point, ascending
      integer, intent(in) :: owner(:)
      !> The numbers
      integer :: numbers(size(owner))

      integer :: first, n, k, order

      first = 1
      do while (first <= size(owner))
         n = 1
         do while (first + n <= size(owner))
            if (owner(first + n) /= owner(first)) exit
            n = n + 1
         end do
         order = max(1, nint(sqrt(real(n, wp))))
         numbers(first:first + n - 1) = [(mod(k, order)*order + k/order + 1, k=0, n - 1)]
         first = first + n
      end do
   end function old_numbers

end module axijoint_compare_read_hdf5_increments
