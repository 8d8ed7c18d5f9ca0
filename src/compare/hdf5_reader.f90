!> Tables of axijoint's HDF5 result file, by the names that they have in the listing
module axijoint_compare_hdf5_reader
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_compare_cell, only : cell_type, cell_number, cell_word, cell_blank, &
      cell_not_a_number, cell_infinite
   use axijoint_compare_hdf5_arrays, only : result_file_type
   use axijoint_compare_table, only : listing_type, words_type, column_type, open_table, add_row, &
      word_index, kind_label, kind_key, kind_coordinate, kind_angle, kind_word, kind_displacement, &
      kind_jump, kind_stress, kind_force, kind_moment
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_is_finite, ieee_is_negative
   implicit none
   private
   public :: read_result_file, hdf5_signature

   !> First bytes of an HDF5 file
   character(len=*), parameter :: hdf5_signature = &
      char(137)//'HDF'//achar(13)//achar(10)//achar(26)//achar(10)

   !> Names of columns
   character(len=*), parameter :: displacement_names(3) = ['u', 'v', 'w'], &
      reaction_names(3) = ['R_u', 'R_v', 'R_w'], &
      stress_names(6) = [character(len=11) :: 'sigma_r', 'sigma_z', 'sigma_theta', 'tau_rz', &
                         'tau_rtheta', 'tau_ztheta'], &
      joint_names(6) = [character(len=9) :: 'tau_xi', 'sigma', 'tau_theta', 'd_xi', 'd_eta', 'd_theta'], &
      resultant_names(6) = [character(len=10) :: 'axial', 'lateral', 'moment', 'torque', &
                            'lateral_90', 'moment_90'], &
      cut_names(6) = [character(len=9) :: 'axial', 'shear', 'moment', 'torque', 'shear_90', 'moment_90'], &
      resultant_texts(6) = [character(len=32) :: 'axial force (along z)', &
                            'lateral force (along theta = 0)', 'moment (lifts theta = 0)', &
                            'torque (about z)', 'lateral force (along theta = 90)', &
                            'moment (lifts theta = 90)'], &
      family_names(2) = [character(len=13) :: 'symmetric', 'antisymmetric'], &
      state_names(0:2) = [character(len=5) :: 'stick', 'slip', 'open']
   !> Quantities of the six resultants
   integer, parameter :: resultant_kinds(6) = [kind_force, kind_force, kind_moment, kind_moment, &
                                               kind_force, kind_moment]

   !> Sections are looked for under the numbers up to this one
   integer, parameter :: most_sections = 999

   !> An array of the file
   type :: array_type
      !> Values, the first index fastest
      real(wp), allocatable :: value(:)
      !> Extents, 1 beyond the rank
      integer :: extent(3) = 0
   end type array_type

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
      call add_modes(file, listing, 'displacement amplitudes', '/displacement', displacement_names, &
                     kind_displacement, [new_column('node', kind_label)], label%value, place%value)
      call add_modes(file, listing, 'reactions', '/reaction', reaction_names, kind_force, &
                     [new_column('node', kind_label)], label%value, place%value)
      call add_modes(file, listing, 'stress amplitudes at Gauss points', '/stress/amplitude', &
                     stress_names, kind_stress, [new_column('element', kind_label)], &
                     element%value(nint(owner%value)), position%value)
      call add_modes(file, listing, 'stress amplitudes at nodes', '/stress/nodal', stress_names, &
                     kind_stress, [new_column('node', kind_label), new_column('material', kind_key)], &
                     [(label%value(nint(node%value(i))), name%value(nint(material%value(i))), &
                       i=1, size(node%value))], &
                     [(at(place, 1, nint(node%value(i))), at(place, 2, nint(node%value(i))), &
                       i=1, size(node%value))])
   end subroutine read_amplitudes

   !> One array of amplitudes: a table for each mode. Reactions of nodes that nothing holds
   !> are left out, as in the listing
   subroutine add_modes(file, listing, title, name, value_names, kind, label_columns, labels, places)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the tables, and of the dataset
      character(len=*), intent(in) :: title, name
      !> Names of the components, and their quantity
      character(len=*), intent(in) :: value_names(:)
      integer, intent(in) :: kind
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
                         trim(family_names(nint(at(family, mode)))), [label_columns, coordinates(), &
                         (new_column(trim(value_names(k)), kind), k=1, size(value_names))], table)
         do row = 1, values%extent(2)
            if (name == '/reaction') then
               if (.not. any([(at(fixed, k, row) > 0.5_wp .or. &
                               abs(at(values, k, row, mode)) > 0.0_wp, k=1, 3)])) cycle
            end if
            call add_row(listing%tables(table), [number(labels(n*(row - 1) + 1:n*row)), &
                         number(places(2*row - 1:2*row)), &
                         number([(at(values, k, row, mode), k=1, size(value_names))])], 0)
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
                      (new_column(trim(joint_names(k)), merge(kind_stress, kind_jump, k < 4)), k=1, 6), &
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

   !> Displacements and stresses on sections. The bodies are not in the file, the materials are
   subroutine read_sections(file, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(array_type) :: body, material, label
      character(len=:), allocatable :: group
      integer :: section

      if (.not. file%has('/sections')) return
      body = array(file, '/mesh/element_body')
      material = array(file, '/mesh/element_material')
      label = array(file, '/materials/label')
      if (len(file%failure) > 0) return
      do section = 1, most_sections
         group = '/sections/'//to_text(section)
         if (.not. file%has(group)) cycle
         call add_section(file, listing, 'displacements on sections', to_text(section), &
                          group, '/displacement', displacement_names, kind_displacement, body%value, &
                          label%value(nint(material%value)))
         call add_section(file, listing, 'stresses on sections', to_text(section), &
                          group, '/stress', stress_names, kind_stress, body%value, &
                          label%value(nint(material%value)))
      end do
   end subroutine read_sections

   !> One array of a section
   subroutine add_section(file, listing, title, section, group, name, value_names, kind, body, material)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the table, number of the section, its group, name of the dataset
      character(len=*), intent(in) :: title, section, group, name
      !> Names of the components, and their quantity
      character(len=*), intent(in) :: value_names(:)
      integer, intent(in) :: kind
      !> Body and number of the material of each element
      real(wp), intent(in) :: body(:), material(:)

      type(array_type) :: angle, point, element, position, values
      integer :: table, i, j, k

      angle = array(file, group//'/angles')
      point = array(file, group//'/point')
      element = array(file, group//'/element')
      position = array(file, group//'/position')
      values = array(file, group//name)
      if (len(file%failure) > 0) return
      call open_table(listing, title, 'section = '//section, [new_column('theta', kind_angle), &
                      new_column('point', kind_label), coordinates(), new_column('body', kind_key), &
                      new_column('material', kind_key), &
                      (new_column(trim(value_names(k)), kind), k=1, size(value_names))], table)
      do j = 1, size(angle%value)
         do i = 1, size(point%value)
            call add_row(listing%tables(table), [number(at(angle, j)/degree), number(at(point, i)), &
                         number([(at(position, k, i), k=1, 2)]), number(body(nint(at(element, i)))), &
                         number(material(nint(at(element, i)))), &
                         number([(at(values, k, i, j), k=1, size(value_names))])], 0)
         end do
      end do
   end subroutine add_section

   !> Resultants on cuts
   subroutine read_cuts(file, words, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(array_type) :: label, z, body, values
      type(cell_type) :: body_cell
      integer :: table, i, k

      if (.not. file%has('/cuts')) return
      label = array(file, '/cuts/label')
      z = array(file, '/cuts/z')
      body = array(file, '/cuts/body')
      values = array(file, '/cuts/resultants')
      if (len(file%failure) > 0) return
      call open_table(listing, 'cuts', '', [new_column('cut', kind_key), &
                      new_column('z', kind_coordinate), new_column('body', kind_key), &
                      (new_column(trim(cut_names(k)), resultant_kinds(k)), k=1, 6)], table)
      do i = 1, size(label%value)
         body_cell = number(at(body, i))
         if (at(body, i) < 0.5_wp) body_cell = word_cell(words, 'all')
         call add_row(listing%tables(table), [number(at(label, i)), number(at(z, i)), body_cell, &
                      number([(at(values, k, i), k=1, 6)])], 0)
      end do
   end subroutine read_cuts

   !> Reactions of faces, and equilibrium
   subroutine read_resultants(file, words, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(array_type) :: face, values, applied, reacted
      real(wp), allocatable :: others(:)
      integer :: table, i, k, n

      applied = array(file, '/resultants/applied')
      reacted = array(file, '/resultants/reacted')
      face = array(file, '/supports/face')
      values = array(file, '/supports/reacted')
      if (len(file%failure) > 0) return
      call open_table(listing, 'reactions of faces', '', [new_column('face', kind_key), &
                      (new_column(trim(resultant_names(k)), resultant_kinds(k)), k=1, 6)], table)
      others = reacted%value
      do i = 1, size(face%value)
         others = others - [(at(values, k, i), k=1, 6)]
         call add_row(listing%tables(table), [number(at(face, i)), &
                      number([(at(values, k, i), k=1, 6)])], 0)
      end do
      call add_row(listing%tables(table), [word_cell(words, 'other nodes'), number(others)], 0)
      call add_row(listing%tables(table), [word_cell(words, 'together'), number(reacted%value)], 0)
      call open_table(listing, 'equilibrium', '', [new_column('resultant', kind_key), &
                      new_column('applied', kind_force), new_column('reacted', kind_force), &
                      new_column('sum', kind_force)], table)
      n = 4
      if (any(abs([applied%value(5:6), reacted%value(5:6)]) > 0.0_wp)) n = 6
      do i = 1, n
         call add_row(listing%tables(table), [word_cell(words, resultant_texts(i)), &
                      number(at(applied, i)), number(at(reacted, i)), &
                      number(at(applied, i) + at(reacted, i))], 0)
      end do
   end subroutine read_resultants

   !> Read an array
   function array(file, name)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> The array
      type(array_type) :: array

      call file%read(name, array%value, array%extent)
   end function array

   !> One value of an array
   pure real(wp) function at(array, i, j, k)
      !> The array
      type(array_type), intent(in) :: array
      !> Indices; those that are absent are 1
      integer, intent(in) :: i
      integer, intent(in), optional :: j, k

      integer :: place

      place = i
      if (present(j)) place = place + array%extent(1)*(j - 1)
      if (present(k)) place = place + array%extent(1)*array%extent(2)*(k - 1)
      at = array%value(place)
   end function at

   !> A number as a value
   elemental type(cell_type) function number(value) result(cell)
      !> The number
      real(wp), intent(in) :: value

      cell = cell_type(0.0_wp, 0.0_wp, cell_number)
      if (ieee_is_nan(value)) then
         cell%state = cell_not_a_number
      else if (.not. ieee_is_finite(value)) then
         cell%state = cell_infinite
         cell%value = merge(-1.0_wp, 1.0_wp, ieee_is_negative(value))
      else
         cell%value = value
      end if
   end function number

   !> A word as a value
   function word_cell(words, text) result(cell)
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The word
      character(len=*), intent(in) :: text
      !> The value
      type(cell_type) :: cell

      integer :: word

      call word_index(words, text, word)
      cell = cell_type(real(word, wp), 0.0_wp, cell_word)
   end function word_cell

   !> A column
   pure function new_column(name, kind) result(column)
      !> Name
      character(len=*), intent(in) :: name
      !> One of the `kind_` parameters
      integer, intent(in) :: kind
      !> The column
      type(column_type) :: column

      column%name = name
      column%kind = kind
   end function new_column

   !> Columns r and z
   pure function coordinates() result(columns)
      !> The columns
      type(column_type) :: columns(2)

      columns(1) = new_column('r', kind_coordinate)
      columns(2) = new_column('z', kind_coordinate)
   end function coordinates

end module axijoint_compare_hdf5_reader
