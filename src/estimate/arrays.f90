!> Bytes of the results file, group by group, as `output/hdf5` writes them
module axijoint_estimate_arrays
   use axijoint_analysis_core_fields, only : n_resultants
   use axijoint_base_kinds, only : wp, i8
   use axijoint_deck_text_source, only : source_type
   use axijoint_estimate_tables, only : table_rows_type, deck_bytes
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_planes, only : planes_type
   use axijoint_model_mesh, only : n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type, bodies_yield
   use axijoint_model_request, only : is_kept, keep_series, keep_displacement, keep_joints, keep_stress
   use axijoint_output_file_hdf5_chunks, only : stored_bytes
   use axijoint_plastic_field, only : body_planes
   implicit none
   private
   public :: results_bytes, series_bytes, n_kept

   !> Bytes of a real, an integer, a small integer
   integer, parameter :: real = 8, whole = 4, byte = 1
   !> What headers of the groups and datasets take that each file has, and those of a job of several increments, of a section,
   !> which has groups in both places [byte]; as measured
   real(wp), parameter :: least_bytes = 5.2e4_wp, history_bytes = 1.0e4_wp, section_bytes = 5.0e3_wp

contains

   !> Bytes of the results file of one combination
   function results_bytes(model, source, modes, rows) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)
      !> How long its tables are
      type(table_rows_type), intent(in) :: rows
      !> The bytes
      real(wp) :: bytes

      bytes = least_bytes + deck_bytes(source) + mesh_bytes(model) + load_bytes(model) &
         + solution_bytes(model, size(modes), rows) + section_groups_bytes(model, rows)
      if (bodies_yield(model)) bytes = bytes + yield_bytes(model, modes, rows)
      if (size(model%increments) > 1) bytes = bytes + history_bytes + kept_bytes(model, size(modes), rows)
      bytes = bytes + series_bytes(model, size(modes))
   end function results_bytes

   !> Nodes, elements, joints, and restraints of some modes
   pure real(wp) function mesh_bytes(model) result(bytes)
      !> The job
      type(model_type), intent(in) :: model

      integer :: k

      associate (nodes => n_nodes(model%mesh), elements => n_elements(model%mesh), joints => n_joints(model%mesh))
         bytes = array(real, [2, nodes]) + array(whole, [nodes]) + array(whole, [3, nodes]) &
            + 4.0_wp*array(whole, [elements]) + array(whole, [size(model%mesh%element_nodes, 1), elements]) &
            + 4.0_wp*array(whole, [joints]) + array(whole, [size(model%mesh%joint_nodes, 1), joints])
         k = 0
         if (allocated(model%restraints)) k = size(model%restraints)
         bytes = bytes + array(whole, [3, nodes, k])
      end associate
   end function mesh_bytes

   !> Loads and springs
   pure real(wp) function load_bytes(model) result(bytes)
      !> The job
      type(model_type), intent(in) :: model

      associate (edges => size(model%edge_loads), rings => size(model%ring_loads), masses => size(model%body_loads), &
                 moved => size(model%prescribed), springs => size(model%edge_supports))
         bytes = 3.0_wp*array(whole, [edges]) + array(whole, [3, edges]) + array(real, [3, 3, edges]) &
            + 4.0_wp*array(whole, [rings]) + array(real, [3, rings]) &
            + 3.0_wp*array(whole, [masses]) + array(real, [4, masses]) &
            + 5.0_wp*array(whole, [moved]) + array(real, [moved]) &
            + array(whole, [3, springs]) + array(real, [3, springs])
      end associate
   end function load_bytes

   !> Displacements, reactions, stresses and joints at the end; the path there
   pure real(wp) function solution_bytes(model, n_modes, rows) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> Number of modes
      integer, intent(in) :: n_modes
      !> How long its tables are
      type(table_rows_type), intent(in) :: rows

      bytes = 2.0_wp*array(real, [3, n_nodes(model%mesh), n_modes]) &
         + array(whole, [rows%points]) + array(real, [2, rows%points]) + array(real, [6, rows%points, n_modes]) &
         + 2.0_wp*array(whole, [rows%values]) + array(real, [6, rows%values, n_modes]) &
         + array(whole, [rows%joint_points]) + array(real, [2, rows%joint_points]) &
         + 2.0_wp*array(real, [3, rows%joint_points, rows%planes]) + array(whole, [rows%joint_points, rows%planes]) &
         + 2.0_wp*array(real, [rows%iterations]) + 4.0_wp*array(whole, [rows%iterations])
      if (rows%judged) bytes = bytes + array(real, [n_elements(model%mesh)])
   end function solution_bytes

   !> Sections, cuts and supported faces
   pure real(wp) function section_groups_bytes(model, rows) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> How long its tables are
      type(table_rows_type), intent(in) :: rows

      integer :: k

      bytes = 0.0_wp
      do k = 1, size(model%lines)
         associate (n => size(model%lines(k)%points), angles => size(model%lines(k)%angles))
            bytes = bytes + section_bytes + 2.0_wp*array(whole, [n]) + array(real, [2, n]) &
               + array(real, [3, n, angles]) + array(real, [6, n, angles])
         end associate
      end do
      associate (cuts => size(model%cuts), faces => size(model%supported_faces))
         bytes = bytes + 2.0_wp*array(whole, [cuts]) + array(real, [cuts]) + 2.0_wp*array(real, [n_resultants, cuts]) &
            + merge(array(real, [4, cuts, 5]) + array(real, [5]), 0.0_wp, cuts > 0) &
            + array(whole, [faces]) + array(real, [n_resultants, faces])
      end associate
      if (rows%joint_points > 0) bytes = bytes + array(whole, [size(model%interfaces)])
   end function section_groups_bytes

   !> Bodies that yield
   function yield_bytes(model, modes, rows) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> How long its tables are
      type(table_rows_type), intent(in) :: rows
      !> The bytes
      real(wp) :: bytes

      type(planes_type) :: planes

      planes = body_planes(modes, model%n_body_planes)
      associate (n => rows%points, own => rows%own_points, round => size(planes%angle))
         bytes = array(real, [6, n, size(modes)]) + 3.0_wp*array(real, [n, round]) + array(whole, [n, round]) &
            + array(real, [n]) + array(whole, [own]) + array(real, [6, own, round])
      end associate
   end function yield_bytes

   !> Fields of increments, those of the last among them
   pure real(wp) function kept_bytes(model, n_modes, rows) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> Number of modes
      integer, intent(in) :: n_modes
      !> How long its tables are
      type(table_rows_type), intent(in) :: rows

      integer :: k, kept

      kept = n_kept(model, keep_displacement)
      bytes = 2.0_wp*array(real, [3, n_nodes(model%mesh), n_modes, kept])
      kept = n_kept(model, keep_joints)
      bytes = bytes + array(real, [3, rows%joint_points, n_modes, kept]) &
         + array(real, [3, rows%joint_points, rows%planes, kept]) + array(byte, [rows%joint_points, rows%planes, kept])
      kept = n_kept(model, keep_stress)
      if (kept > 1) bytes = bytes + array(real, [6, rows%points, n_modes, kept]) + array(real, [6, rows%values, n_modes, kept])
      kept = n_kept(model, keep_series)
      do k = 1, size(model%lines)
         associate (n => size(model%lines(k)%points), angles => size(model%lines(k)%angles))
            bytes = bytes + array(real, [3, n, angles, kept]) + array(real, [6, n, angles, kept])
         end associate
      end do
   end function kept_bytes

   !> What is followed from increment to increment, and the increments themselves
   pure real(wp) function series_bytes(model, n_modes) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> Number of modes
      integer, intent(in) :: n_modes

      integer :: kept

      kept = n_kept(model, keep_series)
      bytes = 5.0_wp*array(whole, [kept]) + 8.0_wp*array(real, [kept]) + array(real, [size(model%load_cases), kept]) &
         + 2.0_wp*array(real, [n_resultants, kept]) &
         + 2.0_wp*array(real, [n_resultants, size(model%cuts), kept]) &
         + array(real, [n_resultants, n_joints(model%mesh), kept]) &
         + array(real, [n_resultants, size(model%supported_faces), kept]) &
         + array(real, [3, size(model%points), n_modes, kept]) &
         + 2.0_wp*array(real, [size(model%increments)]) + array(whole, [size(model%increments)])
   end function series_bytes

   !> Increments of which something is kept
   pure integer function n_kept(model, what)
      !> The job
      type(model_type), intent(in) :: model
      !> One of the `keep_` parameters
      integer, intent(in) :: what

      integer :: i

      associate (last => size(model%increments))
         n_kept = count(is_kept(model%keep(what), [(i, i=1, last)], last))
      end associate
   end function n_kept

   !> Bytes of an array in the file
   pure real(wp) function array(bytes, extent)
      !> Bytes of a value
      integer, intent(in) :: bytes
      !> Extents of the array
      integer, intent(in) :: extent(:)

      array = stored_bytes(bytes, int(extent, i8))
   end function array

end module axijoint_estimate_arrays
