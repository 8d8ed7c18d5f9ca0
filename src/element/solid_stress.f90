!> Stresses of quadrilateral and triangular rings, and the nodal forces that balance them: at a point,
!> and at all points of a strip of elements
!>
!> Displacements enter by the gradients a,r, a,z and a/r of the amplitudes a = u, v, w: sums over the
!> nodes with dN/dr, dN/dz and N/r. Stresses work on gradients as forces on displacements.
module axijoint_element_solid_stress
   use axijoint_base_kinds, only : wp
   use axijoint_element_dilatation, only : dilatation_type
   use axijoint_element_solid_point, only : solid_point_type
   use axijoint_fe_quadrature, only : max_element_points
   implicit none
   private
   public :: solid_stress, add_solid_force
   public :: solid_strip_type, most_elements, put_element, strip_stresses, add_strip_forces

   !> Elements that are worked on at once: loops over them have the width of the processor
   integer, parameter :: most_elements = 16

   !> Some elements of the same kind; places that are not taken are zero
   type :: solid_strip_type
      !> Nodes, and points
      integer :: n = 0, n_points = 0
      !> Whether volumetric strains are means over the element; their slopes follow those of the points
      logical :: averaged = .false.
      !> dN/dr, dN/dz, N/r: shape (elements, 3, nodes, points)
      real(wp) :: slope(most_elements, 3, 9, max_element_points + 1) = 0.0_wp
      !> Weights of the points, shape (elements, points)
      real(wp) :: weight(most_elements, max_element_points) = 0.0_wp
   end type solid_strip_type

contains

   !> Stress amplitudes of one harmonic at a point: d B_m u
   pure function solid_stress(point, n, d, harmonic, displacement, dilatation) result(stress)
      !> Where
      type(solid_point_type), intent(in) :: point
      !> Number of nodes
      integer, intent(in) :: n
      !> Elasticity matrix
      real(wp), intent(in) :: d(6, 6)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Amplitudes u, v, w of the nodes, shape (3, n)
      real(wp), intent(in) :: displacement(:, :)
      !> Means over the element, if it takes the volumetric strain as its mean
      type(dilatation_type), intent(in), optional :: dilatation
      !> Amplitudes of r, z, theta, rz, r-theta, z-theta
      real(wp) :: stress(6)

      real(wp) :: gradient(3, 3), mean(3, 3)
      integer :: i

      gradient = 0.0_wp
      do i = 1, n
         gradient(:, 1) = gradient(:, 1) + point%gradient(1, i)*displacement(:, i)
         gradient(:, 2) = gradient(:, 2) + point%gradient(2, i)*displacement(:, i)
         gradient(:, 3) = gradient(:, 3) + point%shape(i)*displacement(:, i)
      end do
      gradient(:, 3) = gradient(:, 3)/point%position(1)
      if (present(dilatation)) then
         if (dilatation%averaged) then
            mean = matmul(displacement(:, :n), transpose(dilatation%gradient(:, :n)))
            stress = stress_of_gradient(d, harmonic, gradient(:, 1), gradient(:, 2), &
               gradient(:, 3), volume_change(harmonic, mean(:, 1), mean(:, 2), mean(:, 3)))
            return
         end if
      end if
      stress = stress_of_gradient(d, harmonic, gradient(:, 1), gradient(:, 2), gradient(:, 3))
   end function solid_stress

   !> Stress amplitudes of one harmonic from the gradients, by the strains B_m u (Eq. 4)
   pure function stress_of_gradient(d, harmonic, along_r, along_z, over_r, volume) result(stress)
      !> Elasticity matrix
      real(wp), intent(in) :: d(6, 6)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Gradients a,r, a,z, a/r of the amplitudes a = u, v, w
      real(wp), intent(in) :: along_r(3), along_z(3), over_r(3)
      !> Volumetric strain, if the element takes another than that of the gradients
      real(wp), intent(in), optional :: volume
      !> Amplitudes of r, z, theta, rz, r-theta, z-theta
      real(wp) :: stress(6)

      real(wp) :: strain(6)
      integer :: i

      strain = [along_r(1), along_z(2), over_r(1) + harmonic*over_r(3), along_z(1) + along_r(2), &
                along_r(3) - over_r(3) - harmonic*over_r(1), along_z(3) - harmonic*over_r(2)]
      if (present(volume)) strain(1:3) = strain(1:3) + (volume - sum(strain(1:3)))/3.0_wp
      stress = d(:, 1)*strain(1)
      do i = 2, 6
         stress = stress + d(:, i)*strain(i)
      end do
   end function stress_of_gradient

   !> Volumetric strain of gradients of one harmonic
   pure real(wp) function volume_change(harmonic, along_r, along_z, over_r)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Gradients a,r, a,z, a/r of the amplitudes a = u, v, w
      real(wp), intent(in) :: along_r(3), along_z(3), over_r(3)

      volume_change = along_r(1) + along_z(2) + over_r(1) + harmonic*over_r(3)
   end function volume_change

   !> Add the nodal forces that balance a stress of one harmonic at a point,
   !> but for the factor c_m: weight B_m^T stress
   pure subroutine add_solid_force(point, n, harmonic, stress, force, dilatation)
      !> Where
      type(solid_point_type), intent(in) :: point
      !> Number of nodes
      integer, intent(in) :: n
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Stress amplitudes
      real(wp), intent(in) :: stress(6)
      !> Generalized nodal forces on u, v, w, shape (3, n)
      real(wp), intent(inout) :: force(:, :)
      !> Means over the element, if it takes the volumetric strain as its mean
      type(dilatation_type), intent(in), optional :: dilatation

      real(wp) :: on_gradient(3, 3), on_mean(3, 3)
      integer :: i

      on_gradient = 0.0_wp
      if (present(dilatation)) then
         if (dilatation%averaged) then
            on_mean = 0.0_wp
            call add_stress_on_gradient(harmonic, &
               point%weight*(stress - mean_stress(stress)), &
               on_gradient(:, 1), on_gradient(:, 2), on_gradient(:, 3))
            call add_stress_on_gradient(harmonic, point%weight*mean_stress(stress), &
               on_mean(:, 1), on_mean(:, 2), on_mean(:, 3))
            on_gradient(:, 3) = on_gradient(:, 3)/point%position(1)
            do i = 1, n
               force(:, i) = force(:, i) + matmul(on_mean, dilatation%gradient(:, i)) &
                  + matmul(on_gradient, [point%gradient(:, i), point%shape(i)])
            end do
            return
         end if
      end if
      call add_stress_on_gradient(harmonic, point%weight*stress, on_gradient(:, 1), &
         on_gradient(:, 2), on_gradient(:, 3))
      on_gradient(:, 3) = on_gradient(:, 3)/point%position(1)
      do i = 1, n
         force(:, i) = force(:, i) + point%gradient(1, i)*on_gradient(:, 1) &
            + point%gradient(2, i)*on_gradient(:, 2) + point%shape(i)*on_gradient(:, 3)
      end do
   end subroutine add_solid_force

   !> The part of a stress that works on a change of volume
   pure function mean_stress(stress) result(part)
      !> Stress amplitudes
      real(wp), intent(in) :: stress(6)
      !> Their mean normal stress
      real(wp) :: part(6)

      part = 0.0_wp
      part(1:3) = sum(stress(1:3))/3.0_wp
   end function mean_stress

   !> Add what a stress of one harmonic does on the gradients
   pure subroutine add_stress_on_gradient(harmonic, stress, along_r, along_z, over_r)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Stress amplitudes times the weight of the point
      real(wp), intent(in) :: stress(6)
      !> Take what works on a,r, a,z, a/r of the amplitudes a = u, v, w
      real(wp), intent(inout) :: along_r(3), along_z(3), over_r(3)

      associate (s => stress)
         along_r = along_r + [s(1), s(4), s(5)]
         along_z = along_z + [s(4), s(2), s(6)]
         over_r = over_r + [s(3) - harmonic*s(5), -harmonic*s(6), harmonic*s(3) - s(5)]
      end associate
   end subroutine add_stress_on_gradient

   !> Put an element into a strip
   pure subroutine put_element(points, n, dilatation, place, strip)
      !> Its integration points
      type(solid_point_type), intent(in) :: points(:)
      !> Number of nodes
      integer, intent(in) :: n
      !> Means over the element, if it takes the volumetric strain as its mean
      type(dilatation_type), intent(in) :: dilatation
      !> Its place in the strip
      integer, intent(in) :: place
      !> The strip: elements of the same kind
      type(solid_strip_type), intent(inout) :: strip

      integer :: i, p

      strip%n = n
      strip%n_points = size(points)
      strip%averaged = dilatation%averaged
      do p = 1, size(points)
         strip%weight(place, p) = points(p)%weight
         do i = 1, n
            strip%slope(place, 1, i, p) = points(p)%gradient(1, i)
            strip%slope(place, 2, i, p) = points(p)%gradient(2, i)
            strip%slope(place, 3, i, p) = points(p)%shape(i)/points(p)%position(1)
         end do
      end do
      if (.not. dilatation%averaged) return
      do i = 1, n
         strip%slope(place, :, i, size(points) + 1) = dilatation%gradient(:, i)
      end do
   end subroutine put_element

   !> Stress amplitudes of one harmonic at the points of a strip
   pure subroutine strip_stresses(strip, d, harmonic, displacement, stress)
      !> The strip
      type(solid_strip_type), intent(in) :: strip
      !> Elasticity matrix
      real(wp), intent(in) :: d(6, 6)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Amplitudes u, v, w of the nodes of each element
      real(wp), intent(in) :: displacement(most_elements, 3, 9)
      !> Amplitudes of r, z, theta, rz, r-theta, z-theta
      real(wp), intent(inout) :: stress(most_elements, 6, max_element_points)

      real(wp) :: g(most_elements, 3, 3), strain(most_elements, 6), volume(most_elements)
      integer :: i, j, p

      if (strip%averaged) then
         call find_gradients(strip, strip%n_points + 1, displacement, g)
         volume = g(:, 1, 1) + g(:, 2, 2) + g(:, 1, 3) + harmonic*g(:, 3, 3)
      end if
      do p = 1, strip%n_points
         call find_gradients(strip, p, displacement, g)
         strain(:, 1) = g(:, 1, 1)
         strain(:, 2) = g(:, 2, 2)
         strain(:, 3) = g(:, 1, 3) + harmonic*g(:, 3, 3)
         strain(:, 4) = g(:, 1, 2) + g(:, 2, 1)
         strain(:, 5) = g(:, 3, 1) - g(:, 3, 3) - harmonic*g(:, 1, 3)
         strain(:, 6) = g(:, 3, 2) - harmonic*g(:, 2, 3)
         if (strip%averaged) then
            g(:, 1, 1) = (volume - strain(:, 1) - strain(:, 2) - strain(:, 3))/3.0_wp
            do i = 1, 3
               strain(:, i) = strain(:, i) + g(:, 1, 1)
            end do
         end if
         do i = 1, 6
            stress(:, i, p) = d(i, i)*strain(:, i)
            do j = 1, 6
               if (j == i .or. .not. abs(d(i, j)) > 0.0_wp) cycle
               stress(:, i, p) = stress(:, i, p) + d(i, j)*strain(:, j)
            end do
         end do
      end do
   end subroutine strip_stresses

   !> Add the nodal forces that balance stresses of one harmonic at the points of a strip, but for the
   !> factor c_m
   pure subroutine add_strip_forces(strip, harmonic, stress, force)
      !> The strip
      type(solid_strip_type), intent(in) :: strip
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Stress amplitudes
      real(wp), intent(in) :: stress(most_elements, 6, max_element_points)
      !> Generalized forces on u, v, w of the nodes of each element
      real(wp), intent(inout) :: force(most_elements, 3, 9)

      real(wp) :: now(most_elements, 6), mean(most_elements, 6), pressure(most_elements)
      integer :: i, p

      mean = 0.0_wp
      do p = 1, strip%n_points
         do i = 1, 6
            now(:, i) = strip%weight(:, p)*stress(:, i, p)
         end do
         if (strip%averaged) then  ! the mean stress works on the mean volumetric strain
            pressure = (now(:, 1) + now(:, 2) + now(:, 3))/3.0_wp
            do i = 1, 3
               now(:, i) = now(:, i) - pressure
               mean(:, i) = mean(:, i) + pressure
            end do
         end if
         call add_forces(strip, p, harmonic, now, force)
      end do
      if (strip%averaged) call add_forces(strip, strip%n_points + 1, harmonic, mean, force)
   end subroutine add_strip_forces

   !> Gradients at a point of each element of a strip
   pure subroutine find_gradients(strip, p, displacement, gradient)
      !> The strip
      type(solid_strip_type), intent(in) :: strip
      !> The point
      integer, intent(in) :: p
      !> Amplitudes u, v, w of the nodes of each element
      real(wp), intent(in) :: displacement(most_elements, 3, 9)
      !> Columns a,r, a,z, a/r of the amplitudes
      real(wp), intent(out) :: gradient(most_elements, 3, 3)

      integer :: c, i, k, q

      gradient = 0.0_wp
      do i = 1, strip%n
         do q = 1, 3
            do c = 1, 3
               do k = 1, most_elements
                  gradient(k, c, q) = gradient(k, c, q) &
                     + strip%slope(k, q, i, p)*displacement(k, c, i)
               end do
            end do
         end do
      end do
   end subroutine find_gradients

   !> Add the nodal forces of stresses at a point of each element of a strip
   pure subroutine add_forces(strip, p, harmonic, stress, force)
      !> The strip
      type(solid_strip_type), intent(in) :: strip
      !> The point, and harmonic m
      integer, intent(in) :: p, harmonic
      !> Stress amplitudes times the weights
      real(wp), intent(in) :: stress(most_elements, 6)
      !> Generalized forces on u, v, w of the nodes of each element
      real(wp), intent(inout) :: force(most_elements, 3, 9)

      real(wp) :: over_r(most_elements, 3)
      integer :: i, k

      over_r(:, 1) = stress(:, 3) - harmonic*stress(:, 5)
      over_r(:, 2) = -harmonic*stress(:, 6)
      over_r(:, 3) = harmonic*stress(:, 3) - stress(:, 5)
      do i = 1, strip%n
         do k = 1, most_elements
            force(k, 1, i) = force(k, 1, i) + strip%slope(k, 1, i, p)*stress(k, 1) &
               + strip%slope(k, 2, i, p)*stress(k, 4) + strip%slope(k, 3, i, p)*over_r(k, 1)
            force(k, 2, i) = force(k, 2, i) + strip%slope(k, 1, i, p)*stress(k, 4) &
               + strip%slope(k, 2, i, p)*stress(k, 2) + strip%slope(k, 3, i, p)*over_r(k, 2)
            force(k, 3, i) = force(k, 3, i) + strip%slope(k, 1, i, p)*stress(k, 5) &
               + strip%slope(k, 2, i, p)*stress(k, 6) + strip%slope(k, 3, i, p)*over_r(k, 3)
         end do
      end do
   end subroutine add_forces

end module axijoint_element_solid_stress
