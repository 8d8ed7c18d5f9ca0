!> What two result files have of their increments, of motions of cuts and of bodies that yield. A
!> listing shows none of it, so it counts between HDF5 files alone
module axijoint_compare_read_hdf5_history
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_compare_read_hdf5_arrays, only : result_file_type
   use axijoint_compare_read_hdf5_cells, only : array_type, array, at, number, word_cell, new_column, &
      columns_of, coordinates
   use axijoint_compare_read_hdf5_increments, only : mode_name_type, read_modes, add_nodal
   use axijoint_compare_read_hdf5_lines, only : resultant_names, cut_names, resultant_kinds, &
      displacement_names, stress_names
   use axijoint_compare_table_table, only : listing_type, words_type, column_type, open_table, add_row, &
      drop_empty_tables, kind_label, kind_key, kind_angle, kind_word, kind_displacement, kind_stress, &
      kind_force, kind_other
   implicit none
   private
   public :: add_history

   !> Values of a dataset, above which it is named and not compared: a table takes twenty times its room
   real(wp), parameter :: most_values = 3.0e6_wp
   !> Datasets that are not compared: what they show follows from others, or is no result that is
   !> settled
   character(len=*), parameter :: passed_over(7) = [character(len=27) :: '/history/joint_amplitude', &
      '/history/nodal_stress', '/history/sections', '/yield/active', '/yield/failing_displacement', &
      '/yield/stress', '/yield/stress_point']

contains

   !> Add tables to a file that is compared with another result file
   subroutine add_history(listing, other, words, error)
      !> The file
      type(listing_type), intent(inout) :: listing
      !> What it is compared with
      type(listing_type), intent(in) :: other
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> It cannot be read
      type(error_type), allocatable, intent(out) :: error

      type(result_file_type) :: file
      integer :: k

      if (.not. (listing%aligned .and. other%aligned)) return
      call file%open(listing%path)
      if (file%has('/history/increment')) then
         call add_increments_table(file, listing)
         call add_resultants_of_increments(file, listing)
         call add_points(file, listing)
         call add_kept(file, words, listing)
      end if
      if (file%has('/cuts')) call add_things(file, listing, 'motion of cuts', '/cuts/motion', 'cut', &
         '/cuts/label', motion_columns(), .false.)
      if (file%has('/yield')) call add_yield(file, listing)
      do k = 1, size(passed_over)
         if (file%has(trim(passed_over(k)))) call pass_over(listing, trim(passed_over(k)))
      end do
      call drop_empty_tables(listing)
      if (len(file%failure) > 0) &
         call fatal_error(error, exit_deck, listing%path//': error: '//file%failure)
      call file%close()
   end subroutine add_history

   !> Whether a dataset can be compared; it is named if it is too large
   logical function can_compare(file, listing, name)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Takes the name
      type(listing_type), intent(inout) :: listing
      !> Absolute path in the file
      character(len=*), intent(in) :: name

      can_compare = .false.
      if (.not. file%has(name)) return
      can_compare = file%values(name) <= most_values
      if (.not. can_compare) call pass_over(listing, name)
   end function can_compare

   !> Note that a dataset is not compared
   subroutine pass_over(listing, name)
      !> The file
      type(listing_type), intent(inout) :: listing
      !> Absolute path in it
      character(len=*), intent(in) :: name

      if (.not. allocated(listing%passed_over)) allocate (listing%passed_over(0))
      listing%passed_over = [character(len=len(listing%passed_over)) :: listing%passed_over, name]
   end subroutine pass_over

   !> Loads, work, largest values by increment. Iterations and residuals say how a result was found
   subroutine add_increments_table(file, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing

      call add_series(file, listing, 'increments', '/history', [new_column('load_factor', kind_other), &
         new_column('equilibrium', kind_other), new_column('n_slip', kind_other), &
         new_column('n_open', kind_other), new_column('largest_displacement', kind_displacement), &
         new_column('largest_pressure', kind_stress), new_column('largest_shear', kind_stress)])
      ! in a table of their own, as what is as good as zero is so beside the largest of the table
      call add_series(file, listing, 'work of increments', '/history', [new_column('work', kind_other), &
         new_column('energy', kind_other), new_column('dissipated', kind_other)])
   end subroutine add_increments_table

   !> A table of numbers by increment: a column for each dataset of its name that is there
   subroutine add_series(file, listing, title, group, columns)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the table, and group of the datasets
      character(len=*), intent(in) :: title, group
      !> The columns
      type(column_type), intent(in) :: columns(:)

      type(array_type) :: increment, values(size(columns))
      logical :: there(size(columns))
      integer :: table, i, k

      if (.not. file%has(group//'/increment')) return
      increment = array(file, group//'/increment')
      do k = 1, size(columns)
         there(k) = file%has(group//'/'//columns(k)%name)
         if (there(k)) values(k) = array(file, group//'/'//columns(k)%name)
      end do
      if (len(file%failure) > 0 .or. .not. any(there)) return
      call open_table(listing, title, '', [new_column('increment', kind_key), pack(columns, there)], &
         table)
      do i = 1, size(increment%value)
         call add_row(listing%tables(table), number([at(increment, i), &
            pack([(value_of(k, i), k=1, size(columns))], there)]), 0)
      end do

   contains

      !> A value; 0 of a dataset that is not there
      real(wp) function value_of(k, i)
         !> Column, increment
         integer, intent(in) :: k, i

         value_of = 0.0_wp
         if (there(k)) value_of = at(values(k), i)
      end function value_of

   end subroutine add_series

   !> Resultants of loads, reactions, cuts, joints and faces by increment
   subroutine add_resultants_of_increments(file, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing

      type(column_type) :: columns(6), cuts(6)
      integer :: k

      columns = [(new_column(trim(resultant_names(k)), resultant_kinds(k)), k=1, 6)]
      cuts = [(new_column(trim(cut_names(k)), resultant_kinds(k)), k=1, 6)]
      call add_things(file, listing, 'loads of increments', '/history/applied', '', '', columns, .true.)
      call add_things(file, listing, 'reactions of increments', '/history/reacted', '', '', columns, &
         .true.)
      if (file%has('/cuts')) then
         call add_things(file, listing, 'cuts of increments', '/history/cuts', 'cut', '/cuts/label', &
            cuts, .true.)
         call add_things(file, listing, 'motion of cuts of increments', '/history/cut_motion', 'cut', &
            '/cuts/label', motion_columns(), .true.)
      end if
      call add_joint_resultants(file, listing, columns)
      if (file%has('/supports')) call add_things(file, listing, 'reactions of faces of increments', &
         '/history/supports', 'face', '/supports/face', columns, .true.)
   end subroutine add_resultants_of_increments

   !> Resultants of joints by increment, at the middle of each joint, as joints may be numbered in
   !> another way
   subroutine add_joint_resultants(file, listing, columns)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Columns of the resultants
      type(column_type), intent(in) :: columns(:)

      type(array_type) :: label, owner, place, increment, values
      integer, allocatable :: points(:)
      real(wp), allocatable :: middle(:, :)
      integer :: table, i, j, k

      if (.not. can_compare(file, listing, '/history/joint_resultants')) return
      label = array(file, '/mesh/joint_label')
      owner = array(file, '/joints/joint')
      place = array(file, '/joints/position')
      increment = array(file, '/history/increment')
      values = array(file, '/history/joint_resultants')
      if (len(file%failure) > 0) return
      allocate (middle(2, size(label%value)), source=0.0_wp)
      allocate (points(size(label%value)), source=0)
      do k = 1, size(owner%value)
         j = nint(at(owner, k))
         if (j < 1 .or. j > size(points)) cycle
         points(j) = points(j) + 1
         middle(:, j) = middle(:, j) + [at(place, 1, k), at(place, 2, k)]
      end do
      call open_table(listing, 'joint resultants of increments', '', [new_column('increment', kind_key), &
         new_column('joint', kind_label), coordinates(), columns], table)
      do i = 1, size(increment%value)
         do j = 1, size(label%value)
            call add_row(listing%tables(table), number([at(increment, i), at(label, j), &
               middle(:, j)/max(1, points(j)), (at(values, k, j, i), k=1, size(columns))]), 0)
         end do
      end do
   end subroutine add_joint_resultants

   !> Columns of the motion of a section: displacements, and rotations with the signs of the moments
   function motion_columns() result(columns)
      !> The columns
      type(column_type) :: columns(6)

      integer, parameter :: kinds(6) = [kind_displacement, kind_displacement, kind_other, kind_other, &
         kind_displacement, kind_other]
      character(len=*), parameter :: names(6) = [character(len=8) :: 'axial', 'shear', 'tilt', &
         'twist', 'shear_90', 'tilt_90']
      integer :: k

      columns = [(new_column(trim(names(k)), kinds(k)), k=1, 6)]
   end function motion_columns

   !> A table of six values for each of some things, at the end or by increment
   subroutine add_things(file, listing, title, name, thing, labels, columns, by_increment)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the table, and dataset
      character(len=*), intent(in) :: title, name
      !> What the values are of, and dataset of its numbers; empty if they are of all together
      character(len=*), intent(in) :: thing, labels
      !> Columns of the values
      type(column_type), intent(in) :: columns(:)
      !> Whether the last extent of the dataset is over increments
      logical, intent(in) :: by_increment

      type(array_type) :: label, increment, values
      type(column_type), allocatable :: keys(:)
      integer :: table, i, j, k

      if (.not. can_compare(file, listing, name)) return
      values = array(file, name)
      label%value = [0.0_wp]
      increment%value = [0.0_wp]
      allocate (keys(0))
      if (by_increment) then
         increment = array(file, '/history/increment')
         keys = [new_column('increment', kind_key)]
      end if
      if (len(thing) > 0) then
         label = array(file, labels)
         keys = [keys, new_column(thing, kind_key)]
      end if
      if (len(file%failure) > 0) return
      if (len(thing) == 0) values%extent = [values%extent(1), 1, values%extent(2), 1]
      call open_table(listing, title, '', [keys, columns], table)
      do i = 1, size(increment%value)
         do j = 1, size(label%value)
            call add_row(listing%tables(table), [ &
               number(pack([increment%value(i), label%value(j)], [by_increment, len(thing) > 0])), &
               number([(at(values, k, j, i), k=1, size(columns))])], 0)
         end do
      end do
   end subroutine add_things

   !> Displacements of named points by increment
   subroutine add_points(file, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing

      character(len=*), parameter :: name = '/history/points/displacement'
      type(array_type) :: label, increment, values
      type(mode_name_type), allocatable :: modes(:)
      integer :: table, mode, i, j, k

      if (.not. file%has('/history/points')) return
      if (.not. can_compare(file, listing, name)) return
      label = array(file, '/history/points/label')
      increment = array(file, '/history/increment')
      values = array(file, name)
      call read_modes(file, modes)
      if (len(file%failure) > 0) return
      do mode = 1, size(modes)
         call open_table(listing, 'displacement amplitudes of points', modes(mode)%text, &
            [new_column('increment', kind_key), new_column('point', kind_key), &
             columns_of(displacement_names, kind_displacement)], table)
         do i = 1, size(increment%value)
            do j = 1, size(label%value)
               call add_row(listing%tables(table), number([at(increment, i), at(label, j), &
                  (at(values, k, j, mode, i), k=1, 3)]), 0)
            end do
         end do
      end do
   end subroutine add_points

   !> Fields of the increments of which they are kept. What is kept is as a job wishes: of increments
   !> that one file alone keeps nothing can be said
   subroutine add_kept(file, words, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing

      integer :: first

      first = listing%n_tables + 1
      if (can_compare(file, listing, '/history/displacement')) then
         call add_nodal(file, listing, 'displacement amplitudes', 'displacement', '/displacement', &
            columns_of(displacement_names, kind_displacement))
         call add_nodal(file, listing, 'reactions', 'reaction', '/reaction', &
            columns_of([character(len=3) :: 'R_u', 'R_v', 'R_w'], kind_force))
      end if
      if (can_compare(file, listing, '/history/stress')) call add_point_modes(file, listing, &
         'stress amplitudes at Gauss points', '/history/stress', '/history/stress_increment', kind_stress)
      if (can_compare(file, listing, '/history/joint_stress')) call add_joints(file, words, listing)
      listing%tables(first:listing%n_tables)%kept = .true.
   end subroutine add_kept

   !> Six amplitudes at the Gauss points, by mode, and by increment if these have a dataset
   subroutine add_point_modes(file, listing, title, name, increments, kind)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the tables; datasets of the values and of their increments, empty if there are none
      character(len=*), intent(in) :: title, name, increments
      !> Quantity of the values
      integer, intent(in) :: kind

      type(array_type) :: label, owner, place, increment, values
      type(mode_name_type), allocatable :: modes(:)
      character(len=:), allocatable :: parameters
      integer :: table, i, mode, point, k

      label = array(file, '/mesh/element_label')
      owner = array(file, '/stress/element')
      place = array(file, '/stress/position')
      values = array(file, name)
      increment%value = [0.0_wp]
      if (len(increments) > 0) increment = array(file, increments)
      call read_modes(file, modes)
      if (len(file%failure) > 0) return
      do i = 1, size(increment%value)
         do mode = 1, size(modes)
            parameters = modes(mode)%text
            if (len(increments) > 0) parameters = 'increment = '//to_text(nint(at(increment, i)))// &
               ', '//parameters
            call open_table(listing, title, parameters, [new_column('element', kind_label), &
               coordinates(), columns_of(stress_names, kind)], table)
            do point = 1, size(owner%value)
               call add_row(listing%tables(table), number([at(label, nint(at(owner, point))), &
                  at(place, 1, point), at(place, 2, point), &
                  (at(values, k, point, mode, i), k=1, size(stress_names))]), 0)
            end do
         end do
      end do
   end subroutine add_point_modes

   !> Stresses and states of joints by increment
   subroutine add_joints(file, words, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The tables
      type(listing_type), intent(inout) :: listing

      character(len=*), parameter :: state_names(0:2) = [character(len=5) :: 'stick', 'slip', 'open']
      type(array_type) :: label, joint, place, plane, increment, stress, state
      integer :: table, i, j, n, k

      label = array(file, '/mesh/joint_label')
      joint = array(file, '/joints/joint')
      place = array(file, '/joints/position')
      plane = array(file, '/joints/planes')
      increment = array(file, '/history/joint_increment')
      stress = array(file, '/history/joint_stress')
      state = array(file, '/history/joint_state')
      if (len(file%failure) > 0) return
      do n = 1, size(increment%value)
         call open_table(listing, 'joints', 'increment = '//to_text(nint(at(increment, n))), &
            [new_column('joint', kind_label), coordinates(), new_column('theta', kind_angle), &
             columns_of([character(len=9) :: 'tau_xi', 'sigma', 'tau_theta'], kind_stress), &
             new_column('state', kind_word)], table)
         do i = 1, size(joint%value)
            do j = 1, size(plane%value)
               call add_row(listing%tables(table), [number([at(label, nint(at(joint, i))), &
                  at(place, 1, i), at(place, 2, i), at(plane, j)/degree, &
                  (at(stress, k, i, j, n), k=1, 3)]), &
                  word_cell(words, state_names(min(2, max(0, nint(at(state, i, j, n))))))], 0)
            end do
         end do
      end do
   end subroutine add_joints

   !> Plastic strain and what it leaves of the strength, of bodies that yield
   subroutine add_yield(file, listing)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing

      call add_series(file, listing, 'yielding of increments', '/yield', &
         [new_column('load_factor', kind_other), new_column('n_yielded', kind_other)])
      call add_series(file, listing, 'plastic work of increments', '/yield', &
         [new_column('dissipated', kind_other)])
      if (can_compare(file, listing, '/yield/plastic_strain')) call add_point_modes(file, listing, &
         'plastic strain amplitudes', '/yield/plastic_strain', '', kind_other)
      ! a table each: beside the largest of its own values each has its rounding
      call add_on_planes(file, listing, 'equivalent')
      call add_on_planes(file, listing, 'margin')
      call add_on_planes(file, listing, 'dissipation')
   end subroutine add_yield

   !> A table of values at the Gauss points on the planes
   subroutine add_on_planes(file, listing, name)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> The tables
      type(listing_type), intent(inout) :: listing
      !> Name of the dataset and of its column
      character(len=*), intent(in) :: name

      type(array_type) :: label, owner, place, plane, values
      integer :: table, i, j

      if (.not. can_compare(file, listing, '/yield/'//name)) return
      label = array(file, '/mesh/element_label')
      owner = array(file, '/stress/element')
      place = array(file, '/stress/position')
      plane = array(file, '/yield/planes')
      values = array(file, '/yield/'//name)
      if (len(file%failure) > 0) return
      call open_table(listing, 'yielding, '//name, '', [new_column('element', kind_label), &
         coordinates(), new_column('theta', kind_angle), new_column(name, kind_other)], table)
      do i = 1, size(owner%value)
         do j = 1, size(plane%value)
            call add_row(listing%tables(table), number([at(label, nint(at(owner, i))), &
               at(place, 1, i), at(place, 2, i), at(plane, j)/degree, at(values, i, j)]), 0)
         end do
      end do
   end subroutine add_on_planes

end module axijoint_compare_read_hdf5_history
