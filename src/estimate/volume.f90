!> How much a run writes
module axijoint_estimate_volume
   use axijoint_base_kinds, only : wp
   use axijoint_deck_text_source, only : source_type
   use axijoint_estimate_arrays, only : results_bytes
   use axijoint_estimate_pictures, only : picture_bytes
   use axijoint_estimate_tables, only : table_rows_type, new_table_rows, listing_size
   use axijoint_estimate_terms, only : n_terms, files, lines, array_bytes, swept_values, cut_states, line_values
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, n_shown, bodies_yield
   use axijoint_output_vtkhdf_grid, only : sweep_planes
   implicit none
   private
   public :: add_volume, swept_numbers

   !> Bytes of the summary that each job has, of each mode and of each increment, of one of bodies that yield
   real(wp), parameter :: summary_bytes = 3.5e3_wp, mode_bytes = 150.0_wp, increment_bytes = 610.0_wp, yield_bytes = 190.0_wp
   !> Numbers of a point of swept bodies: displacement, stress
   real(wp), parameter :: numbers_a_point = 9.0_wp

contains

   !> Add the work of writing the files of one combination, and their bytes
   subroutine add_volume(model, source, modes, points, iterations, judged, work, bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> Cards of the deck, which listing and results repeat
      type(source_type), intent(in) :: source
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Its iterations
      real(wp), intent(in) :: iterations
      !> Whether errors are estimated
      logical, intent(in) :: judged
      !> Counts of all terms
      real(wp), intent(inout) :: work(n_terms)
      !> On the disk
      real(wp), intent(inout) :: bytes

      type(table_rows_type) :: rows
      real(wp) :: listing(2), arrays

      rows = new_table_rows(model, modes, points, iterations, judged)
      listing = listing_size(model, source, modes, rows)
      arrays = results_bytes(model, source, modes, rows)
      work(files) = work(files) + 1.0_wp
      work(lines) = work(lines) + listing(1)
      work(array_bytes) = work(array_bytes) + arrays
      associate (increments => size(model%increments), followed => n_shown(model) + 1)
         work(swept_values) = work(swept_values) + swept_numbers(model, modes)*increments
         work(cut_states) = work(cut_states) + real(size(model%cuts), wp)*followed
         work(line_values) = work(line_values) + line_points(model)*size(modes)*followed
         bytes = bytes + listing(2) + arrays + picture_bytes(model, modes, rows) + summary_bytes + mode_bytes*size(modes) &
            + increments*(increment_bytes + merge(yield_bytes, 0.0_wp, bodies_yield(model)))
      end associate
   end subroutine add_volume

   !> Points of all sections, at all angles of each
   pure real(wp) function line_points(model) result(n)
      !> The job
      type(model_type), intent(in) :: model

      integer :: k

      n = 0.0_wp
      do k = 1, size(model%lines)
         n = n + size(model%lines(k)%points)*real(size(model%lines(k)%angles), wp)
      end do
   end function line_points

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
