!> Swept bodies and joints as VTKHDF files of the kind UnstructuredGrid (doc/results.md):
!> what is common to both. A file of one step is of version 1.0 of the format, one of
!> several of version 2.0; the mesh is the same in all steps and is there once.
module axijoint_output_vtkhdf_grid
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp, i8, pi
   use axijoint_base_version, only : program_name, program_version
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : sweep_type
   use axijoint_output_file_hdf5, only : hdf5_file_type, kind_real, kind_long, kind_byte
   use axijoint_output_file_hdf5_series, only : hdf5_series_type
   use axijoint_output_file_run, only : run_type, status_name
   use axijoint_output_vtkhdf_swept_mesh, only : swept_mesh_type, n_points, n_cells, n_members, &
      point_number, point_positions, cell_sizes
   implicit none
   private
   public :: sweep_planes, is_circle, write_frame, write_steps, write_cell_labels
   public :: point_group, cell_group

   !> Groups of the fields
   character(len=*), parameter :: point_group = "/VTKHDF/PointData/", &
      cell_group = "/VTKHDF/CellData/"
   !> Sectors that a wave of the highest harmonic gets: linear between them, a cosine
   !> is then wrong by 2 % of its amplitude at most
   integer, parameter :: sectors_per_wave = 16
   !> Sectors of the circle at least
   integer, parameter :: fewest_sectors = 36
   !> A range that lacks less than this of the circle is a circle
   real(wp), parameter :: same_angle = 1.0e-9_wp

contains

   !> Whether a range is the whole circle
   pure logical function is_circle(sweep)
      !> The range
      type(sweep_type), intent(in) :: sweep

      is_circle = sweep%to - sweep%from > 2.0_wp*pi - same_angle
   end function is_circle

   !> Angles of the planes; without the last one of a whole circle
   pure function sweep_planes(sweep, modes) result(angle)
      !> The range
      type(sweep_type), intent(in) :: sweep
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Angles [radian]
      real(wp), allocatable :: angle(:)

      real(wp) :: width
      integer :: n, j

      width = sweep%to - sweep%from
      n = sweep%n_sectors
      if (n == 0) n = ceiling(max(fewest_sectors, sectors_per_wave*maxval(modes%harmonic)) &
                              *width/(2.0_wp*pi) - same_angle)
      angle = [(sweep%from + width*(real(j, wp)/real(n, wp)), j=0, &
         merge(n - 1, n, is_circle(sweep)))]
   end function sweep_planes

   !> Tags of the run, points and cells
   subroutine write_frame(file, run, model, results, mesh)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh

      call file%attribute("/", "program", program_name)
      call file%attribute("/", "version", program_version)
      call file%attribute("/", "deck", run%deck)
      call file%attribute("/", "title", model%title)
      call file%attribute("/", "date", run%date)
      call file%attribute("/", "run", run%stamp)
      call file%attribute("/", "status", status_name(results))
      call file%attribute("/", "combination", results%combination)
      call file%group("/VTKHDF")
      call file%attribute("/VTKHDF", "Version", merge([1, 0], [2, 0], size(results%states) == 1))
      call file%ascii_attribute("/VTKHDF", "Type", "UnstructuredGrid")
      call file%write("/VTKHDF/NumberOfPoints", [n_points(mesh)], "Number of points")
      call file%write("/VTKHDF/NumberOfCells", [n_cells(mesh)], "Number of cells")
      call file%write("/VTKHDF/NumberOfConnectivityIds", [n_members(mesh)], "Points of all cells")
      call write_points(file, mesh)
      call write_cells(file, mesh)
      call file%group(point_group(:len(point_group) - 1))
      call file%group(cell_group(:len(cell_group) - 1))
   end subroutine write_frame

   !> Positions of the points
   subroutine write_points(file, mesh)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh

      type(hdf5_series_type) :: points
      integer :: j

      call file%begin(points, "/VTKHDF/Points", kind_real, [3_i8, n_points(mesh)], &
                      "x = r cos(theta), y = r sin(theta), z; (3, point) [length]")
      call file%append(points, point_positions(mesh, mesh%angle(1), .true.))
      do j = 1, size(mesh%angle)
         call file%append(points, point_positions(mesh, mesh%angle(j), .false.))
      end do
      call file%end(points)
   end subroutine write_points

   !> Points and kinds of the cells, sector by sector
   subroutine write_cells(file, mesh)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh

      type(hdf5_series_type) :: members, offsets, kinds
      integer(i8), allocatable :: last(:)
      integer :: sector, k

      call file%begin(members, "/VTKHDF/Connectivity", kind_long, [n_members(mesh)], &
                      "Points of the cells, from 0")
      call file%begin(offsets, "/VTKHDF/Offsets", kind_long, [n_cells(mesh) + 1], &
                      "Place of the first point of each cell, and the end")
      call file%begin(kinds, "/VTKHDF/Types", kind_byte, [n_cells(mesh)], &
         "Kinds of cells of VTK; (cell)")
      last = cell_sizes(mesh)
      do k = 2, size(last)
         last(k) = last(k) + last(k - 1)
      end do
      call file%append(offsets, [0_i8])
      do sector = 1, mesh%n_sectors
         call file%append(members, point_number(mesh, sector))
         call file%append(offsets, last)
         last = last + mesh%last(mesh%n_cells)
         call file%append(kinds, mesh%kind(:mesh%n_cells))
      end do
      call file%end(members)
      call file%end(offsets)
      call file%end(kinds)
   end subroutine write_cells

   !> A number of each cell that is the same in all sectors
   subroutine write_cell_labels(file, mesh, name, labels, description)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> Name of the field
      character(len=*), intent(in) :: name
      !> Number of each cell of a sector
      integer, intent(in) :: labels(:)
      !> Its meaning
      character(len=*), intent(in) :: description

      type(hdf5_series_type) :: series
      integer :: sector

      call file%begin(series, cell_group//name, kind_long, [n_cells(mesh)], description//"; (cell)")
      do sector = 1, mesh%n_sectors
         call file%append(series, int(labels, i8))
      end do
      call file%end(series)
   end subroutine write_cell_labels

   !> Where the values of each step begin; nothing in a file of one step
   subroutine write_steps(file, mesh, states, point_fields, cell_fields, labels_points, &
      labels_cells)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> One an increment
      type(increment_state_type), intent(in) :: states(:)
      !> Fields of points and of cells that have values for each step
      character(len=*), intent(in) :: point_fields(:), cell_fields(:)
      !> Fields of points and of cells that are the same in all steps
      character(len=*), intent(in) :: labels_points(:), labels_cells(:)

      character(len=*), parameter :: steps = "/VTKHDF/Steps"
      integer(i8) :: none(size(states)), step(size(states))
      integer :: i

      if (size(states) == 1) return
      none = 0
      step = [(int(i - 1, i8), i=1, size(states))]
      call file%group(steps)
      call file%attribute(steps, "NSteps", size(states))
      call file%write(steps//"/Values", real(states%increment, wp), "Increment; (step)")
      call file%write(steps//"/NumberOfParts", none + 1, "Parts; (step)")
      call file%write(steps//"/PartOffsets", none, "First part; (step)")
      call file%write(steps//"/PointOffsets", none, "First point; (step)")
      call file%write(steps//"/CellOffsets", reshape(none, [1, size(none)]), &
         "First cell; (1, step)")
      call file%write(steps//"/ConnectivityIdOffsets", reshape(none, [1, size(none)]), &
                      "First point of the first cell; (1, step)")
      call file%group(steps//"/PointDataOffsets")
      call put_offsets("Point", point_fields, step*n_points(mesh))
      call put_offsets("Point", labels_points, none)
      call file%group(steps//"/CellDataOffsets")
      call put_offsets("Cell", cell_fields, step*n_cells(mesh))
      call put_offsets("Cell", labels_cells, none)
      call file%group("/VTKHDF/FieldData")
      call file%write("/VTKHDF/FieldData/load_factor", (states%load_factor), &
                      "Sum of the load factors; (step)")
      call file%group(steps//"/FieldDataOffsets")
      call put_offsets("Field", ["load_factor"], step)

   contains

      !> Offsets of some fields
      subroutine put_offsets(kind, fields, offsets)
         !> Point, Cell or Field
         character(len=*), intent(in) :: kind
         !> Names
         character(len=*), intent(in) :: fields(:)
         !> First value of each step
         integer(i8), intent(in) :: offsets(:)

         integer :: k

         do k = 1, size(fields)
            call file%write(steps//"/"//kind//"DataOffsets/"//trim(fields(k)), (offsets), &
                            "First value of each step")
         end do
      end subroutine put_offsets

   end subroutine write_steps

end module axijoint_output_vtkhdf_grid
