!> The joints as surfaces, with their stresses and states: NAME.joints.vtkhdf
!>
!> Where joints can open or slip, the law is checked on planes theta; its stresses and
!> states are known there alone. So a cell of the surface belongs to one point of a
!> joint and to one plane, and shows what was found there: it reaches half-way to the
!> neighbours. Between them it is divided at the planes of the swept bodies. Joints of a
!> linear job have what the harmonics give in the middle of each sector.
module axijoint_output_vtkhdf_joints
   use axijoint_analysis_increment_fields, only : solve_increment, view_joints
   use axijoint_analysis_results, only : results_type
   use axijoint_analysis_structure, only : structure_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8, pi
   use axijoint_element_joint, only : lower_node, upper_node
   use axijoint_element_joint_law, only : xi, eta, theta
   use axijoint_fe_mode, only : family_symmetric
   use axijoint_fe_shape, only : shape_line
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_planes, only : planes_type, new_view
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_joint_points, only : joint_rule
   use axijoint_model_model, only : model_type
   use axijoint_output_hdf5_file, only : hdf5_file_type, kind_real, kind_long
   use axijoint_output_hdf5_series, only : hdf5_series_type
   use axijoint_output_run, only : run_type
   use axijoint_output_swept_mesh, only : swept_mesh_type, new_swept_mesh, add_facet, n_points, n_cells
   use axijoint_output_totals, only : circle_type, new_circle, total_displacement
   use axijoint_output_vtkhdf, only : sweep_planes, is_circle, write_frame, write_steps, &
      write_cell_labels, point_group, cell_group
   implicit none
   private
   public :: write_joint_surfaces

   !> Names of the fields of the cells
   character(len=*), parameter :: scalars(8) = [character(len=9) :: 'd_xi', 'd_eta', 'd_theta', 'gap', &
      'slip', 'tau_xi', 'sigma', 'tau_theta']
   !> Names of the fields of the points: displacements of sides 1-2 and 4-3
   character(len=*), parameter :: vectors(2) = [character(len=21) :: 'displacement', 'displacement_opposite']
   !> Lines closer than this share of a sector are one
   real(wp), parameter :: same_line = 1.0e-6_wp

   !> Points along the joints and planes of the sectors
   type :: surface_type
      !> Pairs of nodes of each point, on sides 1-2 and 4-3, shape (3, 2, points), and
      !> their shape functions, shape (3, points); zeros beyond
      integer, allocatable :: nodes(:, :, :)
      real(wp), allocatable :: shape(:, :)
      !> Plane of each sector, 0 if the job is linear, and 1 or -1 if it is its mirror image
      integer, allocatable :: plane(:), sign(:)
      !> Angle in the middle of each sector [radian]
      real(wp), allocatable :: middle(:)
   end type surface_type

contains

   !> Write the file
   subroutine write_joint_surfaces(file, run, model, structure, results, mesh, error)
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

      type(surface_type) :: surface

      call make_surface(model, structure, results, surface, mesh)
      call write_frame(file, run, model, results, mesh)
      associate (points => structure%joint_points(mesh%owner(:mesh%n_cells)))
         call write_cell_labels(file, mesh, "joint", model%mesh%joint_label(points%joint), "Joint")
         call write_cell_labels(file, mesh, "law", (model%joint_materials(points%material)%label), "Law")
         call write_cell_labels(file, mesh, "joint_point", mesh%owner(:mesh%n_cells), &
                                "Joint point, as in the results file")
      end associate
      call write_planes(file, surface, mesh)
      if (.not. allocated(error)) call write_point_fields(file, model, structure, results, surface, mesh, error)
      if (.not. allocated(error)) call write_cell_fields(file, model, structure, results, surface, mesh, error)
      call write_steps(file, mesh, results%states, vectors, [character(len=9) :: scalars, 'state'], &
                       [character(len=1) ::], &
                       [character(len=11) :: 'joint', 'law', 'joint_point', 'plane', 'mirrored'])
   end subroutine write_joint_surfaces

   !> Divide the joints along xi so that each of their points has a part of its own, and
   !> the range of theta so that each sector belongs to one plane
   pure subroutine make_surface(model, structure, results, surface, mesh)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for the joint points and planes
      type(structure_type), intent(in) :: structure
      !> Results at the end, for their modes
      type(results_type), intent(in) :: results
      !> The points and planes
      type(surface_type), intent(out) :: surface
      !> The mesh
      type(swept_mesh_type), intent(out) :: mesh

      real(wp), allocatable :: angle(:), position(:, :)
      real(wp) :: ends(4)
      integer :: joint, n_pairs, n, k, point, owner, most

      angle = sector_lines(model, structure, results)
      most = 3*size(model%mesh%joint_label)
      allocate (surface%nodes(3, 2, most + most/3), surface%shape(3, most + most/3))
      allocate (position(2, most + most/3))
      point = 0
      do joint = 1, size(model%mesh%joint_label)
         call joint_ends(model, joint, n_pairs, n, ends)
         do k = 1, n + 1
            point = point + 1
            call place_point(model, joint, n_pairs, ends(k), surface, point, position(:, point))
         end do
      end do
      mesh = new_swept_mesh(angle, is_circle(model%sweep), position(:, :point), &
                            .not. position(1, :point) > 0.0_wp, most)
      point = 0
      owner = 0
      do joint = 1, size(model%mesh%joint_label)
         call joint_ends(model, joint, n_pairs, n, ends)
         do k = 1, n
            owner = owner + 1
            call add_facet(mesh, owner, point + k, point + k + 1)
         end do
         point = point + n + 1
      end do
      call assign_planes(structure, results, angle, is_circle(model%sweep), surface)
   end subroutine make_surface

   !> Natural coordinates of the ends of the parts of a joint: as long as the weights of
   !> its points
   pure subroutine joint_ends(model, joint, n_pairs, n, ends)
      !> The job
      type(model_type), intent(in) :: model
      !> The joint
      integer, intent(in) :: joint
      !> Pairs of nodes, and points
      integer, intent(out) :: n_pairs, n
      !> The coordinates, the first n + 1
      real(wp), intent(out) :: ends(4)

      real(wp) :: x(3), w(3)
      integer :: k

      n_pairs = model%mesh%joint_size(joint)/2
      call joint_rule(model%joint_materials(model%mesh%joint_material(joint))%rule, n_pairs, n, x, w)
      ends(1) = -1.0_wp
      do k = 1, n - 1
         ends(k + 1) = ends(k) + w(k)
      end do
      ends(n + 1) = 1.0_wp
   end subroutine joint_ends

   !> Place a point on a joint
   pure subroutine place_point(model, joint, n_pairs, x, surface, point, position)
      !> The job
      type(model_type), intent(in) :: model
      !> The joint, and its pairs of nodes
      integer, intent(in) :: joint, n_pairs
      !> Natural coordinate
      real(wp), intent(in) :: x
      !> Takes nodes and shape functions
      type(surface_type), intent(inout) :: surface
      !> The point
      integer, intent(in) :: point
      !> r and z
      real(wp), intent(out) :: position(2)

      real(wp) :: derivative(3)

      surface%nodes(:, :, point) = 1
      surface%shape(:, point) = 0.0_wp
      associate (nodes => model%mesh%joint_nodes(:, joint))
         surface%nodes(:n_pairs, 1, point) = nodes(lower_node(:n_pairs))
         surface%nodes(:n_pairs, 2, point) = nodes(upper_node(:n_pairs))
      end associate
      call shape_line(n_pairs, x, surface%shape(:n_pairs, point), derivative(:n_pairs))
      position = matmul(model%mesh%coordinates(:, surface%nodes(:n_pairs, 1, point)), &
                        surface%shape(:n_pairs, point))
   end subroutine place_point

   !> Planes between the sectors: those of the swept bodies, and those half-way between
   !> the planes of the joint law
   pure function sector_lines(model, structure, results) result(angle)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for the planes
      type(structure_type), intent(in) :: structure
      !> Results at the end, for their modes
      type(results_type), intent(in) :: results
      !> Angles, ascending; without the last one of a whole circle [radian]
      real(wp), allocatable :: angle(:)

      real(wp), allocatable :: all(:)
      real(wp) :: step, line
      integer :: k, j

      angle = sweep_planes(model%sweep, results%modes)
      if (size(structure%yielding) == 0) return
      step = structure%scene%planes%angle(2) - structure%scene%planes%angle(1)
      all = angle
      do k = ceiling(model%sweep%from/step - 0.5_wp), floor(model%sweep%to/step - 0.5_wp)
         line = (k + 0.5_wp)*step
         if (any(abs(all - line) < same_line*step)) cycle
         if (model%sweep%to - line < same_line*step) cycle
         if (line < all(1)) cycle
         j = count(all < line)
         all = [all(:j), line, all(j + 1:)]
      end do
      angle = all
   end function sector_lines

   !> Find the plane of the joint law that each sector belongs to
   pure subroutine assign_planes(structure, results, angle, closed, surface)
      !> The structure, for the planes
      type(structure_type), intent(in) :: structure
      !> Results at the end, for their modes
      type(results_type), intent(in) :: results
      !> Planes between the sectors [radian]
      real(wp), intent(in) :: angle(:)
      !> Whether they make a whole circle
      logical, intent(in) :: closed
      !> Takes planes and middles
      type(surface_type), intent(inout) :: surface

      real(wp) :: step
      integer :: j, n, round

      n = size(angle)
      surface%middle = 0.5_wp*(angle(:n - 1) + angle(2:))
      if (closed) surface%middle = [surface%middle, 0.5_wp*(angle(n) + angle(1)) + pi]
      allocate (surface%plane(size(surface%middle)), source=0)
      allocate (surface%sign(size(surface%middle)), source=1)
      if (size(structure%yielding) == 0) return
      associate (planes => structure%scene%planes%angle)
         step = planes(2) - planes(1)
         round = nint(2.0_wp*pi/step)
         do j = 1, size(surface%middle)
            surface%plane(j) = modulo(nint(surface%middle(j)/step), round) + 1
            if (surface%plane(j) <= size(planes)) cycle
            surface%plane(j) = round + 2 - surface%plane(j)  ! symmetric: planes to pi alone
            surface%sign(j) = -1
         end do
      end associate
      if (any(results%modes%family /= family_symmetric)) surface%sign = 1
   end subroutine assign_planes

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
                      "Plane of the joint law, as in the results file; 0 if the job is linear; (cell)")
      call file%begin(mirrored, cell_group//"mirrored", kind_long, [n_cells(mesh)], &
                      "1 if what is shown is the mirror image of the plane; (cell)")
      do j = 1, mesh%n_sectors
         call file%append(plane, spread(int(surface%plane(j), i8), 1, mesh%n_cells))
         call file%append(mirrored, spread(merge(1_i8, 0_i8, surface%sign(j) < 0), 1, mesh%n_cells))
      end do
      call file%end(plane)
      call file%end(mirrored)
   end subroutine write_planes

   !> Displacements of both sides, step by step
   subroutine write_point_fields(file, model, structure, results, surface, mesh, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The points
      type(surface_type), intent(in) :: surface
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(hdf5_series_type) :: series(2)
      type(results_type) :: earlier
      integer :: i, side

      do side = 1, 2
         call file%begin(series(side), point_group//trim(vectors(side)), kind_real, &
                         [3_i8, size(results%states)*n_points(mesh)], "x, y, z; (3, point) [length]")
      end do
      do i = 1, size(results%states) - 1
         call solve_increment(model, structure, results%states(i), results, earlier, error)
         if (allocated(error)) exit
         call put_step(earlier)
      end do
      if (.not. allocated(error)) call put_step(results)
      do side = 1, 2
         call file%end(series(side))
      end do

   contains

      !> One step: points on the axis, then those of each plane
      subroutine put_step(now)
         !> Results of the step
         type(results_type), intent(in) :: now

         integer :: j, side

         do side = 1, 2
            call file%append(series(side), moved(now, side, mesh%angle(1), mesh%axis))
            do j = 1, size(mesh%angle)
               call file%append(series(side), moved(now, side, mesh%angle(j), .not. mesh%axis))
            end do
         end do
      end subroutine put_step

      !> Cartesian displacements of some points of a plane
      function moved(now, side, angle, some) result(x)
         !> Results of the step
         type(results_type), intent(in) :: now
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
            x(:, n) = [u(1)*cos(angle) - u(3)*sin(angle), u(1)*sin(angle) + u(3)*cos(angle), u(2)]
         end do
      end function moved

   end subroutine write_point_fields

   !> Relative displacements, stresses and states, step by step
   subroutine write_cell_fields(file, model, structure, results, surface, mesh, error)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, assembled
      type(structure_type), intent(inout) :: structure
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The planes
      type(surface_type), intent(in) :: surface
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(hdf5_series_type) :: scalar(size(scalars)), state
      type(results_type) :: earlier
      type(planes_type) :: planes
      real(wp) :: gap(mesh%n_cells)
      integer :: i, k

      associate (n => size(results%states)*n_cells(mesh))
         do k = 1, size(scalars)
            call file%begin(scalar(k), cell_group//trim(scalars(k)), kind_real, [n], &
                            "Of relative displacement or stress; (cell) [length or stress]")
         end do
         call file%begin(state, cell_group//"state", kind_long, [n], "0 stick, 1 slip, 2 open; (cell)")
      end associate
      gap = model%joint_materials(structure%joint_points(mesh%owner(:mesh%n_cells))%material)%law%gap
      planes = structure%scene%planes
      if (size(structure%yielding) == 0) planes = new_view(surface%middle, results%modes)
      do i = 1, size(results%states) - 1
         call solve_increment(model, structure, results%states(i), results, earlier, error)
         if (allocated(error)) exit
         call put_step(field_of(results%states(i), earlier))
      end do
      if (.not. allocated(error)) call put_step(last_field())
      do k = 1, size(scalars)
         call file%end(scalar(k))
      end do
      call file%end(state)

   contains

      !> State of the joints at the end of an increment
      function field_of(kept, now) result(field)
         !> What was kept of it
         type(increment_state_type), intent(in) :: kept
         !> Its results
         type(results_type), intent(in) :: now
         !> The state
         type(joint_field_type) :: field

         call view_joints(model, structure, kept, planes, now%displacement, field)
      end function field_of

      !> State of the joints at the end of the run
      function last_field() result(field)
         !> The state
         type(joint_field_type) :: field

         if (size(structure%yielding) > 0) then
            field%jump = results%joint_jump
            field%stress = results%joint_stress
            field%state = results%joint_state
         else
            field = field_of(results%states(size(results%states)), results)
         end if
      end function last_field

      !> One step, sector by sector
      subroutine put_step(field)
         !> State of the joints on the planes
         type(joint_field_type), intent(in) :: field

         real(wp) :: jump(3, mesh%n_cells), stress(3, mesh%n_cells), mirror
         integer :: j, plane

         associate (owner => mesh%owner(:mesh%n_cells))
            do j = 1, mesh%n_sectors
               plane = merge(j, surface%plane(j), size(structure%yielding) == 0)
               mirror = real(surface%sign(j), wp)
               jump = field%jump(:, owner, plane)
               stress = field%stress(:, owner, plane)
               call file%append(scalar(1), (jump(xi, :)))
               call file%append(scalar(2), (jump(eta, :)))
               call file%append(scalar(3), mirror*jump(theta, :))
               call file%append(scalar(4), max(0.0_wp, jump(eta, :) + gap))
               call file%append(scalar(5), norm2(jump([xi, theta], :), 1))
               call file%append(scalar(6), (stress(xi, :)))
               call file%append(scalar(7), (stress(eta, :)))
               call file%append(scalar(8), mirror*stress(theta, :))
               call file%append(state, int(field%state(owner, plane), i8))
            end do
         end associate
      end subroutine put_step

   end subroutine write_cell_fields

end module axijoint_output_vtkhdf_joints
