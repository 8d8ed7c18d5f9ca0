!> The bodies swept through theta, with displacements and stresses: NAME.vtkhdf
module axijoint_output_vtkhdf_bodies
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_totals, only : new_circle
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : i8
   use axijoint_model_model, only : model_type
   use axijoint_output_file_hdf5, only : hdf5_file_type, kind_real, kind_long
   use axijoint_output_file_hdf5_series, only : hdf5_series_type
   use axijoint_output_file_run, only : run_type
   use axijoint_output_vtkhdf_grid, only : write_frame, write_steps, write_cell_labels, point_group
   use axijoint_output_vtkhdf_swept_mesh, only : swept_mesh_type, n_points
   use axijoint_output_vtkhdf_swept_section, only : section_type, plane_type, make_section, &
      plane_fields, &
      scalars
   implicit none
   private
   public :: bodies_type, begin_bodies, put_bodies, end_bodies

   !> The file under way
   type :: bodies_type
      !> Whether there is one
      logical :: wanted = .false.
      type(hdf5_file_type) :: file
      !> What is in it
      type(swept_mesh_type) :: mesh
      type(section_type), private :: section
      !> The datasets of the fields
      type(hdf5_series_type), private :: displacement, stress, scalar(size(scalars))
   end type bodies_type

contains

   !> Begin the file: the mesh, and room for the fields of all steps
   subroutine begin_bodies(path, run, model, results, bodies, error)
      !> Final path of the file
      character(len=*), intent(in) :: path
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The file under way
      type(bodies_type), intent(inout) :: bodies
      !> It cannot be created
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      call bodies%file%create(path, error)
      if (allocated(error)) return
      bodies%wanted = .true.
      call make_section(model, results, bodies%section, bodies%mesh)
      associate (file => bodies%file, mesh => bodies%mesh)
         call write_frame(file, run, model, results, mesh)
         associate (owner => mesh%owner(:mesh%n_cells))
            call write_cell_labels(file, mesh, "body", model%mesh%element_body(owner), "Body")
            call write_cell_labels(file, mesh, "material", &
               (model%materials(model%mesh%element_material(owner))%label), "Material")
            call write_cell_labels(file, mesh, "element", model%mesh%element_label(owner), &
               "Element")
         end associate
         call write_node_labels(file, model, bodies%section, mesh)
         associate (n => size(results%states)*n_points(mesh))
            call file%begin(bodies%displacement, point_group//"displacement", kind_real, &
                            [3_i8, n], "x, y, z; (3, point) [length]")
            call file%begin(bodies%stress, point_group//"stress", kind_real, [6_i8, n], &
                            "xx, yy, zz, xy, yz, xz; (6, point) [stress]")
            do k = 1, size(scalars)
               call file%begin(bodies%scalar(k), point_group//trim(scalars(k)), kind_real, [n], &
                               "Of displacement or stress; (point) [length or stress]")
            end do
         end associate
      end associate
   end subroutine begin_bodies

   !> One step, if the file is wanted: points on the axis, then those of each plane
   subroutine put_bodies(bodies, now)
      !> The file under way
      type(bodies_type), intent(inout) :: bodies
      !> Fields of the step
      class(fields_type), intent(in) :: now

      integer :: j

      if (.not. bodies%wanted) return
      associate (mesh => bodies%mesh, section => bodies%section)
         call put_plane(plane_fields(section, now, new_circle(now%modes, mesh%angle(1))), mesh%axis)
         do j = 1, size(mesh%angle)
            call put_plane(plane_fields(section, now, new_circle(now%modes, mesh%angle(j))), &
                           .not. mesh%axis)
         end do
      end associate

   contains

      !> Some points of a plane
      subroutine put_plane(plane, some)
         !> The fields
         type(plane_type), intent(in) :: plane
         !> Which points
         logical, intent(in) :: some(:)

         integer, allocatable :: points(:)
         integer :: n

         points = pack([(n, n=1, size(some))], some)
         call bodies%file%append(bodies%displacement, (plane%displacement(:, points)))
         call bodies%file%append(bodies%stress, (plane%stress(:, points)))
         do n = 1, size(scalars)
            call bodies%file%append(bodies%scalar(n), (plane%scalar(points, n)))
         end do
      end subroutine put_plane

   end subroutine put_bodies

   !> End the file, if it is wanted
   subroutine end_bodies(bodies, results, error)
      !> The file under way
      type(bodies_type), intent(inout) :: bodies
      !> Results at the end
      type(results_type), intent(in) :: results
      !> Something is not on the disk
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      if (.not. bodies%wanted) return
      call bodies%file%end(bodies%displacement)
      call bodies%file%end(bodies%stress)
      do k = 1, size(scalars)
         call bodies%file%end(bodies%scalar(k))
      end do
      call write_steps(bodies%file, bodies%mesh, results%states, &
         [character(len=12) :: 'displacement', 'stress', scalars], &
         [character(len=1) ::], ['node'], [character(len=8) :: 'body', 'material', 'element'])
      call bodies%file%finish(error)
   end subroutine end_bodies

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

end module axijoint_output_vtkhdf_bodies
