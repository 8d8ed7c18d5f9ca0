!> Lines and polygons of the meridional plane swept through sectors of theta: points
!> on planes theta = const, and linear cells of VTK between them
module axijoint_output_vtkhdf_swept_mesh
   use, intrinsic :: iso_fortran_env, only : int8
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: swept_mesh_type, new_swept_mesh, add_solid, add_facet
   public :: n_points, n_cells, n_members, point_number, point_positions, cell_sizes

   !> Cells of VTK
   integer, parameter :: triangle = 5, quadrilateral = 9, tetrahedron = 10, hexahedron = 12, &
      wedge = 13, pyramid = 14

   !> A mesh, and how one sector of it is built. Points on the axis are there once,
   !> and come first; those off the axis follow plane by plane. The last plane of a
   !> whole circle is its first.
   type :: swept_mesh_type
      !> Angles of the planes [radian]
      real(wp), allocatable :: angle(:)
      !> Number of sectors
      integer :: n_sectors = 0
      !> r and z of the points of the meridional plane, shape (2, points)
      real(wp), allocatable :: position(:, :)
      !> Which of them are on the axis
      logical, allocatable :: axis(:)
      !> Their places among those on, or those off the axis
      integer, allocatable :: place(:)
      !> Numbers of points on and off the axis
      integer :: n_axis = 0, n_off = 0
      !> Number of cells of a sector
      integer :: n_cells = 0
      !> Kind of each cell of a sector
      integer(int8), allocatable :: kind(:)
      !> What it was made of: an element or a joint point
      integer, allocatable :: owner(:)
      !> Its last place in the list of points
      integer, allocatable :: last(:)
      !> Points of the cells: points of the meridional plane, and 0 on the first
      !> plane of the sector, 1 on its second
      integer, allocatable :: member(:), side(:)
   end type swept_mesh_type

contains

   !> A mesh without cells
   pure function new_swept_mesh(angle, closed, position, axis, most_cells) result(mesh)
      !> Angles of all planes, ascending; of a whole circle without the last [radian]
      real(wp), intent(in) :: angle(:)
      !> Whether they make a whole circle
      logical, intent(in) :: closed
      !> r and z of the points, shape (2, points)
      real(wp), intent(in) :: position(:, :)
      !> Which of them are on the axis
      logical, intent(in) :: axis(:)
      !> Room for so many cells of a sector
      integer, intent(in) :: most_cells
      !> The mesh
      type(swept_mesh_type) :: mesh

      integer :: k, next(2)

      mesh%angle = angle
      mesh%n_sectors = merge(size(angle), size(angle) - 1, closed)
      mesh%position = position
      mesh%axis = axis
      mesh%n_axis = count(axis)
      mesh%n_off = size(axis) - mesh%n_axis
      allocate (mesh%place(size(axis)))
      next = 0
      do k = 1, size(axis)
         associate (kind => merge(1, 2, axis(k)))
            next(kind) = next(kind) + 1
            mesh%place(k) = next(kind)
         end associate
      end do
      allocate (mesh%kind(most_cells), mesh%owner(most_cells), mesh%last(0:most_cells))
      allocate (mesh%member(8*most_cells), mesh%side(8*most_cells))
      mesh%last(0) = 0
   end function new_swept_mesh

   !> Sweep a convex polygon: a wedge or a hexahedron; at the axis, where its points
   !> stay in place, what is left of it: tetrahedra, pyramids, wedges. The first triangle
   !> of a wedge is seen counterclockwise from outside, as VTK's manual has it (its
   !> releases since 9.6 measure the volume of such a wedge as negative).
   pure subroutine add_solid(mesh, owner, polygon)
      !> The mesh
      type(swept_mesh_type), intent(inout) :: mesh
      !> What the polygon is part of
      integer, intent(in) :: owner
      !> Three or four points, counterclockwise in the r-z plane
      integer, intent(in) :: polygon(:)

      integer :: p(size(polygon)), n, first

      n = size(polygon)
      first = 1  ! the axis is followed from here
      do while (first < n .and. .not. (mesh%axis(polygon(first)) &
                .and. .not. mesh%axis(polygon(modulo(first - 2, n) + 1))))
         first = first + 1
      end do
      p = cshift(polygon, first - 1)
      select case (count(mesh%axis(p)))
      case (0)
         if (n == 3) then
            call add_cell(mesh, owner, wedge, [p, p], [0, 0, 0, 1, 1, 1])
         else
            call add_cell(mesh, owner, hexahedron, [p, p], [1, 1, 1, 1, 0, 0, 0, 0])
         end if
      case (1)
         call add_pyramid(mesh, owner, p(1:3))
         if (n == 4) call add_pyramid(mesh, owner, p([1, 3, 4]))
      case default
         if (n == 3) then
            call add_cell(mesh, owner, tetrahedron, [p(2), p(3), p(3), p(1)], [0, 0, 1, 0])
         else
            call add_cell(mesh, owner, wedge, [p(2), p(3), p(3), p(1), p(4), p(4)], &
               [0, 1, 0, 0, 1, 0])
         end if
      end select
   end subroutine add_solid

   !> Sweep a triangle whose first point alone is on the axis
   pure subroutine add_pyramid(mesh, owner, p)
      !> The mesh
      type(swept_mesh_type), intent(inout) :: mesh
      !> What the triangle is part of
      integer, intent(in) :: owner
      !> Its points, counterclockwise
      integer, intent(in) :: p(3)

      call add_cell(mesh, owner, pyramid, p([2, 3, 3, 2, 1]), [0, 0, 1, 1, 0])
   end subroutine add_pyramid

   !> Sweep a straight line; its normal points to the left of the line in the r-z plane
   pure subroutine add_facet(mesh, owner, a, b)
      !> The mesh
      type(swept_mesh_type), intent(inout) :: mesh
      !> What the line is part of
      integer, intent(in) :: owner
      !> Its ends
      integer, intent(in) :: a, b

      if (mesh%axis(a)) then
         call add_cell(mesh, owner, triangle, [a, b, b], [0, 0, 1])
      else if (mesh%axis(b)) then
         call add_cell(mesh, owner, triangle, [a, b, a], [0, 0, 1])
      else
         call add_cell(mesh, owner, quadrilateral, [a, b, b, a], [0, 0, 1, 1])
      end if
   end subroutine add_facet

   !> Add a cell to the sector
   pure subroutine add_cell(mesh, owner, kind, member, side)
      !> The mesh
      type(swept_mesh_type), intent(inout) :: mesh
      !> What it is part of
      integer, intent(in) :: owner
      !> Kind of cell
      integer, intent(in) :: kind
      !> Points of the meridional plane, and planes of the sector
      integer, intent(in) :: member(:), side(:)

      integer :: before

      before = mesh%last(mesh%n_cells)
      mesh%n_cells = mesh%n_cells + 1
      mesh%kind(mesh%n_cells) = int(kind, int8)
      mesh%owner(mesh%n_cells) = owner
      mesh%last(mesh%n_cells) = before + size(member)
      mesh%member(before + 1:before + size(member)) = member
      mesh%side(before + 1:before + size(member)) = side
   end subroutine add_cell

   !> Number of points
   pure integer(i8) function n_points(mesh)
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      n_points = mesh%n_axis + size(mesh%angle, kind=i8)*mesh%n_off
   end function n_points

   !> Number of cells
   pure integer(i8) function n_cells(mesh)
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      n_cells = int(mesh%n_sectors, i8)*mesh%n_cells
   end function n_cells

   !> Number of points of all cells, each as often as it is used
   pure integer(i8) function n_members(mesh)
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      n_members = int(mesh%n_sectors, i8)*mesh%last(mesh%n_cells)
   end function n_members

   !> Numbers, from zero, of the points of the cells of a sector
   pure function point_number(mesh, sector) result(number)
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> The sector
      integer, intent(in) :: sector
      !> The numbers, cell after cell
      integer(i8) :: number(mesh%last(mesh%n_cells))

      integer :: i, plane

      do i = 1, size(number)
         associate (point => mesh%member(i))
            number(i) = mesh%place(point) - 1
            if (mesh%axis(point)) cycle
            plane = modulo(sector - 1 + mesh%side(i), size(mesh%angle))
            number(i) = number(i) + mesh%n_axis + int(plane, i8)*mesh%n_off
         end associate
      end do
   end function point_number

   !> Numbers of points of the cells of a sector
   pure function cell_sizes(mesh) result(sizes)
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> The numbers
      integer(i8) :: sizes(mesh%n_cells)

      sizes = mesh%last(1:mesh%n_cells) - mesh%last(0:mesh%n_cells - 1)
   end function cell_sizes

   !> Cartesian positions of the points of one plane that are on, or off, the axis
   pure function point_positions(mesh, angle, on) result(x)
      !> The mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> Angle [radian]
      real(wp), intent(in) :: angle
      !> Which points
      logical, intent(in) :: on
      !> x, y, z
      real(wp) :: x(3, merge(mesh%n_axis, mesh%n_off, on))

      integer :: k

      do k = 1, size(mesh%axis)
         if (mesh%axis(k) .neqv. on) cycle
         associate (r => mesh%position(1, k), place => mesh%place(k))
            x(:, place) = [r*cos(angle), r*sin(angle), mesh%position(2, k)]
         end associate
      end do
   end function point_positions

end module axijoint_output_vtkhdf_swept_mesh
