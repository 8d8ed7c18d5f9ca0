!> Bytes of the files of swept bodies and joints, as `output/vtkhdf` writes them
module axijoint_estimate_pictures
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_nodal_stress, only : number_values
   use axijoint_base_kinds, only : wp, i8, pi
   use axijoint_estimate_tables, only : table_rows_type
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_mesh, only : n_joints
   use axijoint_model_model, only : model_type, can_yield
   use axijoint_output_file_hdf5_chunks, only : stored_bytes
   use axijoint_output_vtkhdf_grid, only : sweep_planes, is_circle
   use axijoint_output_vtkhdf_swept_mesh, only : swept_mesh_type, n_points, n_cells, n_members
   use axijoint_output_vtkhdf_swept_section, only : section_type, make_section, scalars
   implicit none
   private
   public :: picture_bytes

   !> Bytes of a real or long integer, of a small one
   integer, parameter :: long = 8, byte = 1
   !> What the headers of a file take, and of one with several steps [byte]; as measured
   real(wp), parameter :: least_bytes = 8.8e3_wp, step_bytes = 1.0e4_wp
   !> Angles that differ by less are one [radian]
   real(wp), parameter :: same_angle = 1.0e-9_wp
   !> Scalars of joints: relative displacements and stresses, and the state
   real(wp), parameter :: joint_scalars = 9.0_wp

contains

   !> Bytes of both files of one combination
   real(wp) function picture_bytes(model, modes, rows) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)
      !> How long its tables are
      type(table_rows_type), intent(in) :: rows

      bytes = 0.0_wp
      if (.not. model%sweep%wanted) return
      bytes = body_bytes(model, modes)
      if (n_joints(model%mesh) > 0) bytes = bytes + joint_bytes(model, modes, rows)
   end function picture_bytes

   !> Swept bodies
   real(wp) function body_bytes(model, modes) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), intent(in) :: modes(:)

      type(fields_type) :: fields
      type(section_type) :: section
      type(swept_mesh_type) :: mesh

      fields%modes = modes
      call number_values(model%mesh, fields%nodal)
      call make_section(model, fields, section, mesh)
      associate (points => n_points(mesh), steps => size(model%increments, kind=i8))
         ! with bodies, materials, elements and nodes; and at each step vectors, tensors and their components
         bytes = frame_bytes(points, n_cells(mesh), n_members(mesh), size(model%increments)) &
            + 3.0_wp*stored_bytes(long, [n_cells(mesh)]) + stored_bytes(long, [points]) &
            + stored_bytes(long, [3_i8, steps*points]) + stored_bytes(long, [6_i8, steps*points]) &
            + size(scalars)*stored_bytes(long, [steps*points])
      end associate
   end function body_bytes

   !> Swept joints: each of their points has a part of its own
   real(wp) function joint_bytes(model, modes, rows) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> How long its tables are
      type(table_rows_type), intent(in) :: rows

      integer(i8) :: lines, points, cells, steps

      lines = n_lines(model, modes)
      points = lines*(rows%joint_points + n_joints(model%mesh))
      cells = lines*rows%joint_points
      if (.not. is_circle(model%sweep)) cells = (lines - 1)*rows%joint_points
      steps = size(model%increments)
      ! with joints, laws, their points, planes and mirror images; and at each step displacements of both sides
      bytes = frame_bytes(points, cells, 4*cells, size(model%increments)) + 5.0_wp*stored_bytes(long, [cells]) &
         + 2.0_wp*stored_bytes(long, [3_i8, steps*points]) + joint_scalars*stored_bytes(long, [steps*cells])
   end function joint_bytes

   !> Points and cells, which come once, and headers
   pure real(wp) function frame_bytes(points, cells, members, n_steps) result(bytes)
      !> Numbers of points, of cells and of points of all cells
      integer(i8), intent(in) :: points, cells, members
      !> Steps
      integer, intent(in) :: n_steps

      bytes = least_bytes + merge(step_bytes, 0.0_wp, n_steps > 1) + stored_bytes(long, [3_i8, points]) &
         + stored_bytes(long, [members]) + stored_bytes(long, [cells + 1]) + stored_bytes(byte, [cells])
   end function frame_bytes

   !> Planes between sectors of joints: those of the bodies, and those half-way between the planes of the joint law
   pure integer function n_lines(model, modes)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), intent(in) :: modes(:)

      real(wp), allocatable :: lines(:)
      real(wp) :: half_way
      integer :: k

      lines = sweep_planes(model%sweep, modes)
      n_lines = size(lines)
      if (.not. can_yield(model)) return
      associate (n => model%n_planes - 1)
         do k = -2*n, 4*n
            half_way = pi*(k + 0.5_wp)/n
            if (half_way <= model%sweep%from .or. half_way >= model%sweep%to) cycle
            if (all(abs(lines - half_way) > same_angle)) n_lines = n_lines + 1
         end do
      end associate
   end function n_lines

end module axijoint_estimate_pictures
