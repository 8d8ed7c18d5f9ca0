!> Sections, cuts and resultants of axijoint's HDF5 result file
module axijoint_compare_read_hdf5_lines
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_compare_read_hdf5_arrays, only : result_file_type
   use axijoint_compare_read_hdf5_cells, only : array_type, array, at, number, word_cell, &
      new_column, &
      columns_of, coordinates
   use axijoint_compare_table_cell, only : cell_type
   use axijoint_compare_table_table, only : listing_type, words_type, column_type, open_table, &
      add_row, kind_label, &
      kind_key, kind_coordinate, kind_angle, kind_displacement, kind_stress, kind_force, kind_moment
   implicit none
   private
   public :: read_sections, read_cuts, read_resultants, displacement_names, stress_names, &
      resultant_names, cut_names, resultant_kinds

   !> Names of columns
   character(len=*), parameter :: displacement_names(3) = ['u', 'v', 'w'], &
      stress_names(6) = [character(len=11) :: 'sigma_r', 'sigma_z', 'sigma_theta', 'tau_rz', &
                         'tau_rtheta', 'tau_ztheta'], &
      resultant_names(6) = [character(len=10) :: 'axial', 'lateral', 'moment', 'torque', &
                            'lateral_90', 'moment_90'], &
      cut_names(6) = [character(len=9) :: 'axial', 'shear', 'moment', 'torque', 'shear_90', &
      'moment_90'], &
      resultant_texts(6) = [character(len=32) :: 'axial force (along z)', &
                            'lateral force (along theta = 0)', 'moment (lifts theta = 0)', &
                            'torque (about z)', 'lateral force (along theta = 90)', &
                            'moment (lifts theta = 90)']
   !> Quantities of the six resultants
   integer, parameter :: resultant_kinds(6) = [kind_force, kind_force, kind_moment, kind_moment, &
                                               kind_force, kind_moment]

   !> Sections are looked for under the numbers up to this one
   integer, parameter :: most_sections = 999

contains

   !> Displacements and stresses on sections. The bodies are not in the file, the materials are
   subroutine read_sections(file, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(array_type) :: body, material, label
      real(wp), allocatable :: owners(:, :)
      character(len=:), allocatable :: group
      integer :: section

      if (.not. file%has('/sections')) return
      body = array(file, '/mesh/element_body')
      material = array(file, '/mesh/element_material')
      label = array(file, '/materials/label')
      if (len(file%failure) > 0) return
      allocate (owners(2, size(body%value)))
      owners(1, :) = body%value
      owners(2, :) = label%value(nint(material%value))
      do section = 1, most_sections
         group = '/sections/'//to_text(section)
         if (.not. file%has(group)) cycle
         call add_section(file, listing, 'displacements on sections', to_text(section), &
                          group, '/displacement', &
                          columns_of(displacement_names, kind_displacement), owners)
         call add_section(file, listing, 'stresses on sections', to_text(section), &
                          group, '/stress', columns_of(stress_names, kind_stress), owners)
      end do
   end subroutine read_sections

   !> One array of a section
   subroutine add_section(file, listing, title, section, group, name, components, owners)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the table, number of the section, its group, name of the dataset
      character(len=*), intent(in) :: title, section, group, name
      !> Columns of the components
      type(column_type), intent(in) :: components(:)
      !> Body and number of the material of each element, shape (2, elements)
      real(wp), intent(in) :: owners(:, :)

      type(array_type) :: angle, point, element, position, values
      integer :: table, i, j, k

      angle = array(file, group//'/angles')
      point = array(file, group//'/point')
      element = array(file, group//'/element')
      position = array(file, group//'/position')
      values = array(file, group//name)
      if (len(file%failure) > 0) return
      call open_table(listing, title, 'section = '//section, [new_column('theta', kind_angle), &
                      new_column('point', kind_label), coordinates(), &
                      new_column('body', kind_key), &
                      new_column('material', kind_key), components], table)
      do j = 1, size(angle%value)
         do i = 1, size(point%value)
            call add_row(listing%tables(table), &
               [number(at(angle, j)/degree), number(at(point, i)), &
                         number([(at(position, k, i), k=1, 2)]), &
                         number(owners(:, nint(at(element, i)))), &
                         number([(at(values, k, i, j), k=1, size(components))])], 0)
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

      type(array_type) :: applied, reacted, family
      integer :: table, i, n

      applied = array(file, '/resultants/applied')
      reacted = array(file, '/resultants/reacted')
      family = array(file, '/modes/family')
      call read_face_reactions(file, reacted%value, words, listing)
      if (len(file%failure) > 0) return
      call open_table(listing, 'equilibrium', '', [new_column('resultant', kind_key), &
                      new_column('applied', kind_force), new_column('reacted', kind_force), &
                      new_column('sum', kind_force)], table)
      n = merge(4, 6, all(nint(family%value) == 1))  ! as in the listing; 1 is symmetric
      do i = 1, n
         call add_row(listing%tables(table), [word_cell(words, resultant_texts(i)), &
                      number(at(applied, i)), number(at(reacted, i)), &
                      number(at(applied, i) + at(reacted, i))], 0)
      end do
   end subroutine read_resultants

   !> Reactions of faces; none where nodes alone are held
   subroutine read_face_reactions(file, together, words, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Resultants of all reactions
      real(wp), intent(in) :: together(:)
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(array_type) :: face, values
      real(wp), allocatable :: others(:)
      integer :: table, i, k

      if (.not. file%has('/supports')) return
      face = array(file, '/supports/face')
      values = array(file, '/supports/reacted')
      if (len(file%failure) > 0) return
      call open_table(listing, 'reactions of faces', '', [new_column('face', kind_key), &
                      (new_column(trim(resultant_names(k)), resultant_kinds(k)), k=1, 6)], table)
      others = together
      do i = 1, size(face%value)
         others = others - [(at(values, k, i), k=1, 6)]
         call add_row(listing%tables(table), [number(at(face, i)), &
                      number([(at(values, k, i), k=1, 6)])], 0)
      end do
      call add_row(listing%tables(table), [word_cell(words, 'other nodes'), number(others)], 0)
      call add_row(listing%tables(table), [word_cell(words, 'together'), number(together)], 0)
   end subroutine read_face_reactions

end module axijoint_compare_read_hdf5_lines
