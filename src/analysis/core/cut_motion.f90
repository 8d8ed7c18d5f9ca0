!> How the section of a body moves at a cut z = const
module axijoint_analysis_core_cut_motion
   use axijoint_analysis_core_results, only : axial, lateral, moment, torque, lateral_90, &
      moment_90, n_resultants
   use axijoint_base_kinds, only : wp
   use axijoint_element_solid_point, only : solid_point_type, solid_points
   use axijoint_fe_mode, only : mode_type, is_torsion, family_symmetric
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_model_mesh, only : mesh_type, n_elements, element_references
   use axijoint_model_request, only : cut_type
   implicit none
   private
   public :: cut_motion

contains

   !> The rigid motion that comes nearest, by least squares over the volume of the elements that
   !> the cut passes through, to the displacements there: along z, along theta = 0 and 90 degrees
   !> at the cut, rotations with the signs of the moments, rotation about z
   function cut_motion(mesh, cut, modes, displacement) result(motion)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The cut
      type(cut_type), intent(in) :: cut
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Displacements [length] and rotations [radian], in the order of the resultants
      real(wp) :: motion(n_resultants)

      type(solid_point_type) :: points(max_element_points)
      type(reference_type), allocatable :: references(:)
      real(wp) :: matrix(2, 2, size(modes)), right(2, size(modes)), basis(3, 2), u(3)
      integer :: element, i, k, n

      references = element_references(mesh)
      matrix = 0.0_wp
      right = 0.0_wp
      do element = 1, n_elements(mesh)
         if (cut%body > 0 .and. mesh%element_body(element) /= cut%body) cycle
         n = mesh%element_size(element)
         associate (nodes => mesh%element_nodes(:n, element), &
                    reference => references(mesh%element_kind(element)))
            associate (z => mesh%coordinates(2, nodes))
               if (minval(z) > cut%z .or. maxval(z) < cut%z) cycle
            end associate
            call solid_points(mesh%coordinates(:, nodes), reference, points(:reference%n_points))
            do k = 1, size(modes)
               if (modes(k)%harmonic > 1) cycle
               do i = 1, reference%n_points
                  basis = rigid_basis(modes(k), points(i)%position - [0.0_wp, cut%z])
                  u = matmul(displacement(:, nodes, k), points(i)%shape(:n))
                  matrix(:, :, k) = matrix(:, :, k) &
                     + points(i)%weight*matmul(transpose(basis), basis)
                  right(:, k) = right(:, k) + points(i)%weight*matmul(u, basis)
               end do
            end do
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

   !> Amplitudes u, v, w of the rigid motions of a mode at a point
   pure function rigid_basis(mode, place) result(basis)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> r, and z above the cut
      real(wp), intent(in) :: place(2)
      !> Of harmonic 0 the first alone; of harmonic 1 a unit displacement and a unit rotation
      real(wp) :: basis(3, 2)

      basis = 0.0_wp
      if (is_torsion(mode)) then
         basis(3, 1) = -place(1)
      else if (mode%harmonic == 0) then
         basis(2, 1) = 1.0_wp
      else
         basis(:, 1) = [1.0_wp, 0.0_wp, -1.0_wp]
         basis(:, 2) = [-place(2), place(1), place(2)]
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
