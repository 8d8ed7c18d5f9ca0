!> How much a run writes
module axijoint_estimate_volume
   use axijoint_base_kinds, only : wp
   use axijoint_deck_text_source, only : source_type
   use axijoint_estimate_terms, only : n_terms, files, lines, array_bytes, swept_values
   use axijoint_estimate_work, only : n_points
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type, can_yield
   use axijoint_model_request, only : is_kept, keep_displacement, keep_joints, keep_stress, &
      rows_expected, print_deck, print_nodes, print_elements, print_joints, print_states, &
      print_amplitude, print_reactions, print_totals, print_nodal, print_stresses
   use axijoint_output_vtkhdf_grid, only : sweep_planes
   implicit none
   private
   public :: volume_work, volume_bytes, swept_numbers

   !> Bytes of a real, of a line of the listing, of what a results file has whatever the job, and of
   !> the summary
   real(wp), parameter :: real_bytes = 8.0_wp, line_bytes = 95.0_wp, least_arrays = 4.0e5_wp, &
      summary_bytes = 6.0e3_wp
   !> Numbers of a point of swept bodies: displacement, stress; bytes of one, which comes once more
   !> with its component, and principal stresses; its share of points and cells, which come once
   real(wp), parameter :: numbers_a_point = 9.0_wp, swept_bytes = 19.0_wp, mesh_bytes = 17.0_wp

contains

   !> Work of writing the files of one combination
   function volume_work(model, source, modes, points) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> Cards of the deck, which the listing repeats
      type(source_type), intent(in) :: source
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Counts of all terms
      real(wp) :: work(n_terms)

      work = 0.0_wp
      work(files) = 1.0_wp
      work(lines) = listing_lines(model, source, size(modes), n_planes(model, modes)*size(points))
      work(array_bytes) = least_arrays + real_bytes*array_numbers(model, size(modes), &
         n_planes(model, modes)*size(points))
      work(swept_values) = swept_numbers(model, modes)*size(model%increments)
   end function volume_work

   !> Bytes on the disk
   pure real(wp) function volume_bytes(work, n_increments) result(bytes)
      !> Counts of all terms
      real(wp), intent(in) :: work(n_terms)
      !> Increments of a run
      integer, intent(in) :: n_increments

      bytes = line_bytes*work(lines) + work(array_bytes) + summary_bytes*work(files) &
         + (swept_bytes + mesh_bytes/n_increments)*work(swept_values)
   end function volume_bytes

   !> Planes or angles at which joints are shown
   pure integer function n_planes(model, modes)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)

      n_planes = size(model%output_angles)
      if (.not. can_yield(model)) return
      n_planes = model%n_planes
      if (any(modes%family /= modes(1)%family)) n_planes = 2*(model%n_planes - 1)
   end function n_planes

   !> Lines of the listing
   pure real(wp) function listing_lines(model, source, n_modes, n_places) result(n)
      !> The job
      type(model_type), intent(in) :: model
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> Modes; joint points times planes
      integer, intent(in) :: n_modes, n_places

      real(wp) :: nodes
      integer :: k

      associate (mesh => model%mesh, angles => size(model%output_angles))
         nodes = n_nodes(mesh)
         n = rows(print_deck, real(source%n_cards, wp)) + rows(print_nodes, nodes) &
            + rows(print_elements, real(n_elements(mesh), wp)) &
            + rows(print_joints, real(n_joints(mesh), wp)) + rows(print_states, real(n_places, wp)) &
            + n_modes*(rows(print_amplitude, nodes) &
                       + rows(print_reactions, real(count(any(model%fixed, 1)), wp))) &
            + angles*(rows(print_totals, nodes) + rows(print_nodal, nodes) &
                      + rows(print_stresses, n_points(model)))
      end associate
      do k = 1, size(model%lines)
         n = n + size(model%lines(k)%points)*size(model%lines(k)%angles)
      end do

   contains

      !> Rows of a table that are listed
      pure real(wp) function rows(what, n)
         !> The table, one of the `print_` parameters
         integer, intent(in) :: what
         !> Its rows
         real(wp), intent(in) :: n

         rows = rows_expected(model%print, what, n)
      end function rows

   end function listing_lines

   !> Numbers in the results file
   pure real(wp) function array_numbers(model, n_modes, n_places) result(n)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes; joint points times planes
      integer, intent(in) :: n_modes, n_places

      real(wp) :: nodal, joint, stress
      integer :: i, last

      nodal = 3.0_wp*n_nodes(model%mesh)*n_modes
      stress = 6.0_wp*n_points(model)*n_modes
      joint = 7.0_wp*n_places
      last = size(model%increments)
      n = 4.0_wp*nodal + stress + joint
      do i = 1, merge(last, 0, last > 1)
         if (is_kept(model%keep(keep_displacement), i, last)) n = n + 2.0_wp*nodal
         if (is_kept(model%keep(keep_joints), i, last)) n = n + joint
         if (is_kept(model%keep(keep_stress), i, last)) n = n + stress + 2.0_wp*nodal  ! smoothed, too
      end do
   end function array_numbers

   !> Numbers of the bodies swept round the axis, after an increment
   pure real(wp) function swept_numbers(model, modes) result(n)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)

      n = 0.0_wp
      if (.not. model%sweep%wanted) return
      n = numbers_a_point*real(n_nodes(model%mesh) + count(model%mesh%element_size == 8), wp) &
         *size(sweep_planes(model%sweep, modes))
   end function swept_numbers

end module axijoint_estimate_volume
