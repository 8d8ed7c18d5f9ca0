!> How the section of a body moves at a cut z = const
module axijoint_analysis_core_cut_motion
   use axijoint_analysis_core_fields, only : axial, lateral, moment, torque, lateral_90, moment_90, n_resultants
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, is_torsion, family_symmetric
   use axijoint_fe_shape, only : shape_element
   use axijoint_model_locate, only : locate_points, element_reach
   use axijoint_model_mesh, only : mesh_type, max_element_nodes
   use axijoint_model_request, only : cut_type, line_type
   implicit none
   private
   public :: cut_sections, cut_motion

   !> Points over the width of a section
   integer, parameter :: n_section = 33

contains

   !> Points of the sections at all cuts
   function cut_sections(mesh, cuts) result(sections)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The cuts
      type(cut_type), intent(in) :: cuts(:)
      !> One line a cut
      type(line_type), allocatable :: sections(:)

      real(wp), allocatable :: reach(:, :)
      integer :: c, k

      allocate (sections(size(cuts)))
      if (size(cuts) == 0) return
      reach = element_reach(mesh)
      do c = 1, size(cuts)
         call find_section(mesh, cuts(c), pack([(k, k=1, size(reach, 2))], &
            reach(1, :) <= cuts(c)%z .and. cuts(c)%z <= reach(2, :)), sections(c))
      end do
   end function cut_sections

   !> The rigid motion that comes nearest, by least squares over points on the section, to the
   !> displacements there: along z, along theta = 0 and 90 degrees at the cut, rotations with the
   !> signs of the moments, rotation about z
   function cut_motion(mesh, cut, section, modes, displacement) result(motion)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The cut, and the points of its section
      type(cut_type), intent(in) :: cut
      type(line_type), intent(in) :: section
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Displacements [length] and rotations [radian], in the order of the resultants
      real(wp) :: motion(n_resultants)

      real(wp) :: shape(max_element_nodes), derivative(2, max_element_nodes)
      real(wp) :: matrix(2, 2, size(modes)), right(2, size(modes)), basis(3, 2), u(3)
      integer :: i, j, k, n

      matrix = 0.0_wp
      right = 0.0_wp
      do i = 1, size(section%points)
         associate (point => section%points(i))
            if (cut%body > 0 .and. mesh%element_body(point%element) /= cut%body) cycle
            n = mesh%element_size(point%element)
            call shape_element(n, point%natural(1), point%natural(2), shape(:n), derivative(:, :n))
            associate (nodes => mesh%element_nodes(:n, point%element))
               do k = 1, size(modes)
                  if (modes(k)%harmonic > 1) cycle
                  basis = rigid_basis(modes(k), point%position(1))
                  u = 0.0_wp
                  do j = 1, n
                     u = u + displacement(:, nodes(j), k)*shape(j)
                  end do
                  matrix(:, :, k) = matrix(:, :, k) &
                     + point%position(1)*matmul(transpose(basis), basis)
                  right(:, k) = right(:, k) + point%position(1)*matmul(u, basis)
               end do
            end associate
         end associate
      end do
      motion = 0.0_wp
      do k = 1, size(modes)
         if (modes(k)%harmonic > 1 .or. .not. matrix(1, 1, k) > 0.0_wp) cycle
         associate (share => solved(matrix(:, :, k), right(:, k)))
            if (modes(k)%harmonic == 0) then
               motion(merge(torque, axial, is_torsion(modes(k)))) = share(1)
            else if (modes(k)%family == family_symmetric) then
               motion([lateral, moment]) = share
            else
               motion([lateral_90, moment_90]) = share
            end if
         end associate
      end do
   end function cut_motion

   !> Points on the cut, at equal distances
   subroutine find_section(mesh, cut, elements, line)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The cut
      type(cut_type), intent(in) :: cut
      !> Elements that it can pass through, ascending
      integer, intent(in) :: elements(:)
      !> The points that lie in elements
      type(line_type), intent(out) :: line

      real(wp) :: low, high
      integer :: k

      low = huge(low)
      high = 0.0_wp
      do k = 1, size(elements)
         associate (element => elements(k))
            if (cut%body > 0 .and. mesh%element_body(element) /= cut%body) cycle
            associate (x => mesh%coordinates(:, mesh%element_nodes(:mesh%element_size(element), element)))
               if (minval(x(2, :)) > cut%z .or. maxval(x(2, :)) < cut%z) cycle
               low = min(low, minval(x(1, :)))
               high = max(high, maxval(x(1, :)))
            end associate
         end associate
      end do
      line%n_points = n_section
      line%first = [min(low, high), cut%z]
      line%last = [high, cut%z]
      call locate_points(mesh, line, elements)
   end subroutine find_section

   !> Amplitudes u, v, w of the rigid motions of a mode at the height of the cut
   pure function rigid_basis(mode, r) result(basis)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Radius
      real(wp), intent(in) :: r
      !> Of harmonic 0 the first alone; of harmonic 1 a unit displacement and a unit rotation
      real(wp) :: basis(3, 2)

      basis = 0.0_wp
      if (is_torsion(mode)) then
         basis(3, 1) = -r
      else if (mode%harmonic == 0) then
         basis(2, 1) = 1.0_wp
      else
         basis(:, 1) = [1.0_wp, 0.0_wp, -1.0_wp]
         basis(2, 2) = r
      end if
   end function rigid_basis

   !> Solution of two equations, or of the first alone
   pure function solved(matrix, right) result(x)
      !> Symmetric matrix
      real(wp), intent(in) :: matrix(2, 2)
      !> Right-hand sides
      real(wp), intent(in) :: right(2)
      !> The solution
      real(wp) :: x(2)

      real(wp) :: determinant

      x = [right(1)/matrix(1, 1), 0.0_wp]
      determinant = matrix(1, 1)*matrix(2, 2) - matrix(1, 2)**2
      if (.not. determinant > 0.0_wp) return
      x(1) = (matrix(2, 2)*right(1) - matrix(1, 2)*right(2))/determinant
      x(2) = (matrix(1, 1)*right(2) - matrix(1, 2)*right(1))/determinant
   end function solved

end module axijoint_analysis_core_cut_motion
