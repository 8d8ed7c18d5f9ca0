!> The bodies swept through theta, with displacements and stresses: NAME.vtkhdf
module axijoint_output_vtkhdf_bodies
   use axijoint_analysis_core_increment_fields, only : solve_increment
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_model_model, only : model_type
   use axijoint_output_file_hdf5, only : hdf5_file_type, kind_real, kind_long
   use axijoint_output_file_hdf5_series, only : hdf5_series_type
   use axijoint_output_file_run, only : run_type
   use axijoint_output_file_totals, only : new_circle
   use axijoint_output_vtkhdf_grid, only : write_frame, write_steps, write_cell_labels, point_group
   use axijoint_output_vtkhdf_swept_mesh, only : swept_mesh_type, n_points
   use axijoint_output_vtkhdf_swept_section, only : section_type, plane_type, make_section, &
      plane_fields, &
      scalars
   implicit none
   private
   public :: write_bodies

contains

   !> Write the file
   subroutine write_bodies(file, run, model, structure, results, mesh, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> Results at the end
      type(results_type), intent(in) :: results
      !> What was written
      type(swept_mesh_type), intent(out) :: mesh
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(section_type) :: section

      call make_section(model, results, section, mesh)
      call write_frame(file, run, model, results, mesh)
      associate (owner => mesh%owner(:mesh%n_cells))
         call write_cell_labels(file, mesh, "body", model%mesh%element_body(owner), "Body")
         call write_cell_labels(file, mesh, "material", &
            (model%materials(model%mesh%element_material(owner))%label), "Material")
         call write_cell_labels(file, mesh, "element", model%mesh%element_label(owner), "Element")
      end associate
      call write_node_labels(file, model, section, mesh)
      call write_fields(file, model, structure, results, section, mesh, error)
      call write_steps(file, mesh, results%states, &
         [character(len=12) :: 'displacement', 'stress', scalars], &
                       [character(len=1) ::], ['node'], &
                       [character(len=8) :: 'body', 'material', 'element'])
   end subroutine write_bodies

   !> Numbers of the nodes
   subroutine write_node_labels(file, model, section, mesh)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> The points
      type(section_type), intent(in) :: section
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh

      type(hdf5_series_type) :: series
      integer(i8) :: label(0:size(model%mesh%node_label))
      integer :: j

      label(0) = 0
      label(1:) = model%mesh%node_label
      call file%begin(series, point_group//"node", kind_long, [n_points(mesh)], &
                      "Node, 0 at the centre of an element of 8 nodes; (point)")
      call file%append(series, (label(pack(section%node, mesh%axis))))
      do j = 1, size(mesh%angle)
         call file%append(series, (label(pack(section%node, .not. mesh%axis))))
      end do
      call file%end(series)
   end subroutine write_node_labels

   !> Displacements and stresses, step by step, plane by plane
   subroutine write_fields(file, model, structure, results, section, mesh, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The points
      type(section_type), intent(in) :: section
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(hdf5_series_type) :: displacement, stress, scalar(size(scalars))
      type(results_type) :: earlier
      integer :: i, k

      associate (n => size(results%states)*n_points(mesh))
         call file%begin(displacement, point_group//"displacement", kind_real, [3_i8, n], &
                         "x, y, z; (3, point) [length]")
         call file%begin(stress, point_group//"stress", kind_real, [6_i8, n], &
                         "xx, yy, zz, xy, yz, xz; (6, point) [stress]")
         do k = 1, size(scalars)
            call file%begin(scalar(k), point_group//trim(scalars(k)), kind_real, [n], &
                            "Of displacement or stress; (point) [length or stress]")
         end do
      end associate
      do i = 1, size(results%states) - 1
         call solve_increment(model, structure, results%states(i), results, earlier, error)
         if (allocated(error)) exit
         call put_step(earlier)
      end do
      if (.not. allocated(error)) call put_step(results)
      call file%end(displacement)
      call file%end(stress)
      do k = 1, size(scalars)
         call file%end(scalar(k))
      end do

   contains

      !> One step: points on the axis, then those of each plane
      subroutine put_step(now)
         !> Results of the step
         type(results_type), intent(in) :: now

         integer :: j

         call put_plane(plane_fields(section, now, new_circle(now%modes, mesh%angle(1))), mesh%axis)
         do j = 1, size(mesh%angle)
            call put_plane(plane_fields(section, now, new_circle(now%modes, mesh%angle(j))), &
                           .not. mesh%axis)
         end do
      end subroutine put_step

      !> Some points of a plane
      subroutine put_plane(plane, some)
         !> The fields
         type(plane_type), intent(in) :: plane
         !> Which points
         logical, intent(in) :: some(:)

         integer, allocatable :: points(:)
         integer :: n

         points = pack([(n, n=1, size(some))], some)
         call file%append(displacement, (plane%displacement(:, points)))
         call file%append(stress, (plane%stress(:, points)))
         do n = 1, size(scalars)
            call file%append(scalar(n), (plane%scalar(points, n)))
         end do
      end subroutine put_plane

   end subroutine write_fields

end module axijoint_output_vtkhdf_bodies
