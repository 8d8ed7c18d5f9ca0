!> Tables of axijoint's HDF5 result file, by the names that they have in the listing
module axijoint_compare_read_hdf5_reader
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_compare_read_hdf5_arrays, only : result_file_type
   use axijoint_compare_read_hdf5_cells, only : array_type, array, at, number, word_cell, &
      new_column, &
      columns_of, coordinates
   use axijoint_compare_read_hdf5_lines, only : read_sections, read_cuts, read_resultants, &
      displacement_names, stress_names
   use axijoint_compare_table_cell, only : cell_type, cell_blank
   use axijoint_compare_table_table, only : listing_type, words_type, column_type, open_table, &
      drop_empty_tables, add_row, &
      kind_label, kind_key, kind_angle, kind_word, kind_displacement, kind_jump, kind_stress, &
      kind_force
   implicit none
   private
   public :: read_result_file, hdf5_signature

   !> First bytes of an HDF5 file
   character(len=*), parameter :: hdf5_signature = &
      char(137)//'HDF'//achar(13)//achar(10)//achar(26)//achar(10)

   !> Names of columns
   character(len=*), parameter :: reaction_names(3) = ['R_u', 'R_v', 'R_w'], &
      joint_names(6) = [character(len=9) :: 'tau_xi', 'sigma', 'tau_theta', 'd_xi', 'd_eta', &
      'd_theta'], &
      family_names(2) = [character(len=13) :: 'symmetric', 'antisymmetric'], &
      state_names(0:2) = [character(len=5) :: 'stick', 'slip', 'open']

contains

   !> Read a result file
   subroutine read_result_file(path, words, listing, error)
      !> Path
      character(len=*), intent(in) :: path
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> It cannot be read, or is of another program
      type(error_type), allocatable, intent(out) :: error

      type(result_file_type) :: file
      character(len=:), allocatable :: program

      call file%open(path)
      call file%text('program', program)
      if (len(file%failure) == 0 .and. program /= 'axijoint') then
         file%failure = 'this HDF5 file is none of axijoint'
      end if
      call read_status(file, words, listing)
      call read_nodes(file, words, listing)
      call read_amplitudes(file, listing)
      call read_joints(file, words, listing)
      call read_sections(file, listing)
      call read_cuts(file, words, listing)
      call read_resultants(file, words, listing)
      call drop_empty_tables(listing)
      if (len(file%failure) > 0) then
         call fatal_error(error, exit_deck, path//': error: '//file%failure)
      end if
      call file%close()
   end subroutine read_result_file

   !> How the run ended
   subroutine read_status(file, words, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing

      character(len=:), allocatable :: status
      integer :: table

      call file%text('status', status)
      call open_table(listing, 'status', '', [new_column('status', kind_word)], table)
      call add_row(listing%tables(table), [word_cell(words, status)], 0)
   end subroutine read_status

   !> Nodes and what is fixed
   subroutine read_nodes(file, words, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(array_type) :: label, place, fixed
      type(cell_type) :: fixed_cell
      character(len=3) :: text
      integer :: table, i, k

      label = array(file, '/mesh/node_label')
      place = array(file, '/mesh/coordinates')
      fixed = array(file, '/mesh/fixed')
      if (len(file%failure) > 0) return
      call open_table(listing, 'nodes', '', [new_column('node', kind_label), coordinates(), &
                                             new_column('fixed', kind_word)], table)
      do i = 1, label%extent(1)
         do k = 1, 3
            text(k:k) = merge('1', '0', at(fixed, k, i) > 0.5_wp)
         end do
         fixed_cell = cell_type(state=cell_blank)
         if (text /= '000') fixed_cell = word_cell(words, text)
         call add_row(listing%tables(table), [number(at(label, i)), number(at(place, 1, i)), &
                                              number(at(place, 2, i)), fixed_cell], 0)
      end do
   end subroutine read_nodes

   !> Amplitudes of displacements, reactions and stresses
   subroutine read_amplitudes(file, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(array_type) :: label, place, element, owner, position, node, material, name
      integer :: i

      label = array(file, '/mesh/node_label')
      place = array(file, '/mesh/coordinates')
      element = array(file, '/mesh/element_label')
      owner = array(file, '/stress/element')
      position = array(file, '/stress/position')
      node = array(file, '/stress/nodal_node')
      material = array(file, '/stress/nodal_material')
      name = array(file, '/materials/label')
      if (len(file%failure) > 0) return
      call add_modes(file, listing, 'displacement amplitudes', '/displacement', &
                     columns_of(displacement_names, kind_displacement), &
                     [new_column('node', kind_label)], label%value, place%value)
      call add_modes(file, listing, 'reactions', '/reaction', &
         columns_of(reaction_names, kind_force), &
                     [new_column('node', kind_label)], label%value, place%value)
      call add_modes(file, listing, 'stress amplitudes at Gauss points', '/stress/amplitude', &
                     columns_of(stress_names, kind_stress), [new_column('element', kind_label)], &
                     element%value(nint(owner%value)), position%value)
      call add_modes(file, listing, 'stress amplitudes at nodes', '/stress/nodal', &
                     columns_of(stress_names, kind_stress), &
                     [new_column('node', kind_label), new_column('material', kind_key)], &
                     [(label%value(nint(node%value(i))), name%value(nint(material%value(i))), &
                       i=1, size(node%value))], &
                     [(at(place, 1, nint(node%value(i))), at(place, 2, nint(node%value(i))), &
                       i=1, size(node%value))])
   end subroutine read_amplitudes

   !> One array of amplitudes: a table for each mode. Reactions of nodes that nothing holds
   !> are left out, as in the listing
   subroutine add_modes(file, listing, title, name, components, label_columns, labels, places)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the tables, and of the dataset
      character(len=*), intent(in) :: title, name
      !> Columns of the components
      type(column_type), intent(in) :: components(:)
      !> Columns before the coordinates
      type(column_type), intent(in) :: label_columns(:)
      !> Their values, row by row, and r and z of the rows
      real(wp), intent(in) :: labels(:), places(:)

      type(array_type) :: values, harmonic, family, fixed
      integer :: mode, row, table, n, k

      harmonic = array(file, '/modes/harmonic')
      family = array(file, '/modes/family')
      fixed = array(file, '/mesh/fixed')
      values = array(file, name)
      if (len(file%failure) > 0) return
      n = size(label_columns)
      do mode = 1, values%extent(3)
         call open_table(listing, title, 'm = '//to_text(at(harmonic, mode))//', family = '// &
                         trim(family_names(nint(at(family, mode)))), &
                         [label_columns, coordinates(), components], table)
         do row = 1, values%extent(2)
            if (name == '/reaction') then
               if (.not. any([(at(fixed, k, row) > 0.5_wp .or. &
                               abs(at(values, k, row, mode)) > 0.0_wp, k=1, 3)])) cycle
            end if
            call add_row(listing%tables(table), [number(labels(n*(row - 1) + 1:n*row)), &
                         number(places(2*row - 1:2*row)), &
                         number([(at(values, k, row, mode), k=1, size(components))])], 0)
         end do
      end do
   end subroutine add_modes

   !> Stresses, jumps and states of the joints on the planes
   subroutine read_joints(file, words, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(array_type) :: label, joint, position, plane, stress, jump, state
      integer :: table, i, j, k

      label = array(file, '/mesh/joint_label')
      joint = array(file, '/joints/joint')
      position = array(file, '/joints/position')
      plane = array(file, '/joints/planes')
      stress = array(file, '/joints/stress')
      jump = array(file, '/joints/jump')
      state = array(file, '/joints/state')
      if (len(file%failure) > 0 .or. size(joint%value) == 0) return
      call open_table(listing, 'joints', '', [new_column('joint', kind_label), coordinates(), &
                      new_column('theta', kind_angle), &
                      (new_column(trim(joint_names(k)), merge(kind_stress, kind_jump, k < 4)), &
                      k=1, 6), &
                      new_column('state', kind_word)], table)
      do i = 1, size(joint%value)
         do j = 1, size(plane%value)
            call add_row(listing%tables(table), [number(at(label, nint(at(joint, i)))), &
                         number([(at(position, k, i), k=1, 2)]), number(at(plane, j)/degree), &
                         number([(at(stress, k, i, j), k=1, 3), (at(jump, k, i, j), k=1, 3)]), &
                         word_cell(words, state_names(min(2, max(0, nint(at(state, i, j))))))], 0)
         end do
      end do
   end subroutine read_joints

end module axijoint_compare_read_hdf5_reader
