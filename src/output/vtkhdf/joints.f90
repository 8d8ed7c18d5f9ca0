!> The joints as surfaces, with their stresses and states: NAME.joints.vtkhdf
!>
!> Where joints can open or slip, the law is checked on planes theta; its stresses and
!> states are known there alone. So a cell of the surface belongs to one point of a
!> joint and to one plane, and shows what was found there: it reaches half-way to the
!> neighbours. Between them it is divided at the planes of the swept bodies. Joints of a
!> linear job have what the harmonics give in the middle of each sector.
module axijoint_output_vtkhdf_joints
   use axijoint_analysis_core_increment_fields, only : field_of_state
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : circle_type, new_circle, total_displacement
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_element_joint_law, only : xi, eta, theta
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_model, only : model_type
   use axijoint_output_file_hdf5, only : hdf5_file_type, kind_real, kind_long
   use axijoint_output_file_hdf5_series, only : hdf5_series_type
   use axijoint_output_file_run, only : run_type
   use axijoint_output_vtkhdf_grid, only : write_frame, write_steps, write_cell_labels, &
      point_group, cell_group
   use axijoint_output_vtkhdf_joint_surface, only : surface_type, make_surface
   use axijoint_output_vtkhdf_swept_mesh, only : swept_mesh_type, n_points, n_cells
   use axijoint_output_vtkhdf_swept_section, only : cartesian_vector
   implicit none
   private
   public :: surfaces_type, begin_surfaces, put_surfaces, end_surfaces

   !> Names of the fields of the cells
   character(len=*), parameter :: scalars(8) = &
      [character(len=9) :: 'd_xi', 'd_eta', 'd_theta', 'gap', &
      'slip', 'tau_xi', 'sigma', 'tau_theta']
   !> Names of the fields of the points: displacements of sides 1-2 and 4-3
   character(len=*), parameter :: vectors(2) = &
      [character(len=21) :: 'displacement', 'displacement_opposite']

   !> The file under way
   type :: surfaces_type
      !> Whether there is one
      logical :: wanted = .false.
      type(hdf5_file_type) :: file
      !> What is in it
      type(swept_mesh_type) :: mesh
      type(surface_type), private :: surface
      !> The datasets of the fields: of the points, and of the cells
      type(hdf5_series_type), private :: vector(size(vectors))
      type(hdf5_series_type), private :: scalar(size(scalars)), state
   end type surfaces_type

contains

   !> Begin the file: the mesh, and room for the fields of all steps
   subroutine begin_surfaces(path, run, model, structure, results, surfaces, error)
      !> Final path of the file
      character(len=*), intent(in) :: path
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, assembled
      type(structure_type), intent(in) :: structure
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The file under way
      type(surfaces_type), intent(inout) :: surfaces
      !> It cannot be created
      type(error_type), allocatable, intent(out) :: error

      call surfaces%file%create(path, error)
      if (allocated(error)) return
      surfaces%wanted = .true.
      call make_surface(model, structure, results, surfaces%surface, surfaces%mesh)
      associate (file => surfaces%file, mesh => surfaces%mesh)
         call write_frame(file, run, model, results, mesh)
         associate (points => structure%joint_points(mesh%owner(:mesh%n_cells)))
            call write_cell_labels(file, mesh, "joint", model%mesh%joint_label(points%joint), &
               "Joint")
            call write_cell_labels(file, mesh, "law", &
               (model%joint_materials(points%material)%label), "Law")
            call write_cell_labels(file, mesh, "joint_point", mesh%owner(:mesh%n_cells), &
                                   "Joint point, as in the results file")
         end associate
         call write_planes(file, surfaces%surface, mesh)
      end associate
      call begin_series(size(results%states), surfaces)
   end subroutine begin_surfaces

   !> One step, if the file is wanted
   subroutine put_surfaces(surfaces, model, structure, state, now)
      !> The file under way
      type(surfaces_type), intent(inout) :: surfaces
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> State of the step
      type(increment_state_type), intent(in) :: state
      !> Fields of the step
      class(fields_type), intent(in) :: now

      type(joint_field_type) :: field

      if (.not. surfaces%wanted) return
      if (size(structure%yielding) > 0) then
         field%jump = now%joint_jump
         field%stress = now%joint_stress
         field%state = now%joint_state
      else
         call field_of_state(model, structure, state, surfaces%surface%middle, now%displacement, &
            field)
      end if
      call put_displacements(now, surfaces)
      call put_joints(model, structure, field, surfaces)
   end subroutine put_surfaces

   !> End the file, if it is wanted
   subroutine end_surfaces(surfaces, results, error)
      !> The file under way
      type(surfaces_type), intent(inout) :: surfaces
      !> Results at the end
      type(results_type), intent(in) :: results
      !> Something is not on the disk
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      if (.not. surfaces%wanted) return
      do k = 1, size(vectors)
         call surfaces%file%end(surfaces%vector(k))
      end do
      do k = 1, size(scalars)
         call surfaces%file%end(surfaces%scalar(k))
      end do
      call surfaces%file%end(surfaces%state)
      call write_steps(surfaces%file, surfaces%mesh, results%states, vectors, &
         [character(len=9) :: scalars, 'state'], [character(len=1) ::], &
         [character(len=11) :: 'joint', 'law', 'joint_point', 'plane', 'mirrored'])
      call surfaces%file%finish(error)
   end subroutine end_surfaces

   !> Planes of the cells, the same in all steps
   subroutine write_planes(file, surface, mesh)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The planes
      type(surface_type), intent(in) :: surface
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh

      type(hdf5_series_type) :: plane, mirrored
      integer :: j

      call file%begin(plane, cell_group//"plane", kind_long, [n_cells(mesh)], &
                      "Plane of the joint law, as in the results file; 0 if the job is linear; "// &
                      "(cell)")
      call file%begin(mirrored, cell_group//"mirrored", kind_long, [n_cells(mesh)], &
                      "1 if what is shown is the mirror image of the plane; (cell)")
      do j = 1, mesh%n_sectors
         call file%append(plane, spread(int(surface%plane(j), i8), 1, mesh%n_cells))
         call file%append(mirrored, spread(merge(1_i8, 0_i8, surface%sign(j) < 0), 1, mesh%n_cells))
      end do
      call file%end(plane)
      call file%end(mirrored)
   end subroutine write_planes

   !> Make the datasets of the fields
   subroutine begin_series(n_steps, surfaces)
      !> Number of steps
      integer, intent(in) :: n_steps
      !> The file under way
      type(surfaces_type), intent(inout) :: surfaces

      integer :: k

      associate (file => surfaces%file, mesh => surfaces%mesh)
         do k = 1, size(vectors)
            call file%begin(surfaces%vector(k), point_group//trim(vectors(k)), kind_real, &
                            [3_i8, n_steps*n_points(mesh)], "x, y, z; (3, point) [length]")
         end do
         do k = 1, size(scalars)
            call file%begin(surfaces%scalar(k), cell_group//trim(scalars(k)), kind_real, &
                            [n_steps*n_cells(mesh)], &
                            "Of relative displacement or stress; (cell) [length or stress]")
         end do
         call file%begin(surfaces%state, cell_group//"state", kind_long, [n_steps*n_cells(mesh)], &
                         "0 stick, 1 slip, 2 open; (cell)")
      end associate
   end subroutine begin_series

   !> Displacements of both sides in a step: points on the axis, then those of each plane
   subroutine put_displacements(now, surfaces)
      !> Fields of the step
      class(fields_type), intent(in) :: now
      !> The file under way
      type(surfaces_type), intent(inout) :: surfaces

      integer :: j, side

      associate (surface => surfaces%surface, mesh => surfaces%mesh)
         do side = 1, 2
            call surfaces%file%append(surfaces%vector(side), &
               moved(now, surface, side, mesh%angle(1), mesh%axis))
            do j = 1, size(mesh%angle)
               call surfaces%file%append(surfaces%vector(side), &
                  moved(now, surface, side, mesh%angle(j), .not. mesh%axis))
            end do
         end do
      end associate
   end subroutine put_displacements

   !> Cartesian displacements of some points of a plane
   pure function moved(now, surface, side, angle, some) result(x)
      !> Results of the step
      class(fields_type), intent(in) :: now
      !> The points
      type(surface_type), intent(in) :: surface
      !> 1 for side 1-2, 2 for side 4-3
      integer, intent(in) :: side
      !> Angle [radian]
      real(wp), intent(in) :: angle
      !> Which points
      logical, intent(in) :: some(:)
      !> x, y, z
      real(wp) :: x(3, count(some))

      type(circle_type) :: circle
      real(wp) :: u(3)
      integer :: k, pair, n

      circle = new_circle(now%modes, angle)
      n = 0
      do k = 1, size(some)
         if (.not. some(k)) cycle
         u = 0.0_wp
         do pair = 1, 3
            u = u + surface%shape(pair, k) &
               *total_displacement(now%displacement(:, surface%nodes(pair, side, k), :), circle)
         end do
         n = n + 1
         x(:, n) = cartesian_vector(u, angle)
      end do
   end function moved

   !> Relative displacements, stresses and states of a step, sector by sector
   subroutine put_joints(model, structure, field, surfaces)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for the joint points
      type(structure_type), intent(in) :: structure
      !> State of the joints on the planes
      type(joint_field_type), intent(in) :: field
      !> The file under way
      type(surfaces_type), intent(inout) :: surfaces

      real(wp), dimension(surfaces%mesh%n_cells, size(scalars)) :: values
      real(wp) :: gap(surfaces%mesh%n_cells), mirror
      integer :: j, k, plane

      associate (mesh => surfaces%mesh, surface => surfaces%surface, &
                 owner => surfaces%mesh%owner(:surfaces%mesh%n_cells))
         gap = model%joint_materials(structure%joint_points(owner)%material)%law%gap
         do j = 1, mesh%n_sectors
            plane = merge(j, surface%plane(j), size(structure%yielding) == 0)
            mirror = real(surface%sign(j), wp)
            values(:, 1) = field%jump(xi, owner, plane)
            values(:, 2) = field%jump(eta, owner, plane)
            values(:, 3) = mirror*field%jump(theta, owner, plane)
            values(:, 4) = max(0.0_wp, values(:, 2) + gap)
            values(:, 5) = hypot(values(:, 1), values(:, 3))
            values(:, 6) = field%stress(xi, owner, plane)
            values(:, 7) = field%stress(eta, owner, plane)
            values(:, 8) = mirror*field%stress(theta, owner, plane)
            do k = 1, size(scalars)
               call surfaces%file%append(surfaces%scalar(k), values(:, k))
            end do
            call surfaces%file%append(surfaces%state, int(field%state(owner, plane), i8))
         end do
      end associate
   end subroutine put_joints

end module axijoint_output_vtkhdf_joints
