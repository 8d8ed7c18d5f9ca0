!> Stresses of the solids and the nodal forces that they and their mass give
module axijoint_assembly_solid_force
   use axijoint_base_kinds, only : wp
   use axijoint_element_dilatation, only : dilatation_type, formulated_points, strain_shape
   use axijoint_element_solid, only : solid_stress, add_solid_force
   use axijoint_element_solid_point, only : solid_point_type, solid_points
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : mode_type, same_mode, family_symmetric
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_model_load, only : body_load_type, initial_stress_type, stress_before
   use axijoint_model_material, only : elasticity, thermal_strain
   use axijoint_model_mesh, only : n_elements, max_element_nodes, element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: initial_state_type, solid_force, add_mass_force

   !> What stresses the solids without strain
   type :: initial_state_type
      !> Whether there is anything of it
      logical :: present = .false.
      !> Temperature at the nodes of each element, shape (max_element_nodes, elements, modes); not
      !> allocated if none. Bodies that share nodes may have temperatures of their own
      real(wp), allocatable :: temperature(:, :, :)
      !> In-situ stresses, factors of the load cases in them
      type(initial_stress_type), allocatable :: in_situ(:)
      !> Elastic stress that plastic strain takes, amplitudes at the Gauss points of all elements,
      !> shape (6, points, modes); not allocated if none
      real(wp), allocatable :: taken(:, :, :)
   end type initial_state_type

contains

   !> Nodal forces that balance the stresses of one mode, and the stresses
   subroutine solid_force(model, initial, k, mode, displacement, force, stress, body)
      !> The job
      type(model_type), intent(in) :: model
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> The mode, and its place
      integer, intent(in) :: k
      type(mode_type), intent(in) :: mode
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Forces on components, shape (3, nodes)
      real(wp), intent(out) :: force(:, :)
      !> Stress amplitudes at the Gauss points, shape (6, points)
      real(wp), intent(out), optional :: stress(:, :)
      !> Body whose elements alone count, without their stresses; all if absent or 0
      integer, intent(in), optional :: body

      type(solid_point_type) :: points(max_element_points)
      type(reference_type), allocatable :: references(:)
      type(dilatation_type) :: dilatation
      real(wp) :: d(6, 6), now(6), in_situ(6)
      real(wp), dimension(3, max_element_nodes) :: local, element_force
      integer :: element, n, n_points, i, last

      references = element_references(model%mesh)
      force = 0.0_wp
      last = 0
      do element = 1, n_elements(model%mesh)
         if (present(body)) then
            if (all(body /= [0, model%mesh%element_body(element)])) cycle
         end if
         n = model%mesh%element_size(element)
         associate (reference => references(model%mesh%element_kind(element)), &
                    nodes => model%mesh%element_nodes(:n, element), &
                    material => model%materials(model%mesh%element_material(element)))
            d = elasticity(material)
            n_points = reference%n_points
            call formulated_points(model%mesh%coordinates(:, nodes), reference, points(:n_points), &
               dilatation)
            local(:, :n) = displacement(:, nodes)
            element_force = 0.0_wp
            do i = 1, n_points
               now = solid_stress(points(i), n, d, mode%harmonic, local, dilatation)
               if (initial%present) then
                  now = now + thermal_stress(model, initial, k, element, &
                     strain_shape(dilatation, points(i)), d)
                  if (allocated(initial%taken)) now = now - initial%taken(:, last + i, k)
               end if
               call add_solid_force(points(i), n, mode%harmonic, now, element_force, dilatation)
               if (initial%present) then  ! equilibrium in situ knows of no means
                  in_situ = in_situ_stress(model, initial, mode, element, points(i))
                  call add_solid_force(points(i), n, mode%harmonic, in_situ, element_force)
                  now = now + in_situ
               end if
               if (present(stress)) stress(:, last + i) = now
            end do
            last = last + n_points
            force(:, nodes) = force(:, nodes) + circle_integral(mode%harmonic)*element_force(:, :n)
         end associate
      end do
   end subroutine solid_force

   !> Stress at a point that temperature gives without strain: - D alpha T
   pure function thermal_stress(model, initial, k, element, shape, d) result(stress)
      !> The job
      type(model_type), intent(in) :: model
      !> Temperatures
      type(initial_state_type), intent(in) :: initial
      !> Place of the mode, and the element
      integer, intent(in) :: k, element
      !> Shape functions at the point that go with its strain
      real(wp), intent(in) :: shape(:)
      !> Elasticity matrix
      real(wp), intent(in) :: d(6, 6)
      !> Amplitudes of r, z, theta, rz, r-theta, z-theta
      real(wp) :: stress(6)

      integer :: n

      stress = 0.0_wp
      if (.not. allocated(initial%temperature)) return
      n = model%mesh%element_size(element)
      associate (material => model%materials(model%mesh%element_material(element)))
         stress = -dot_product(shape(:n), initial%temperature(:n, element, k)) &
            *matmul(d, thermal_strain(material))
      end associate
   end function thermal_stress

   !> In-situ stress at a point
   pure function in_situ_stress(model, initial, mode, element, point) result(stress)
      !> The job
      type(model_type), intent(in) :: model
      !> In-situ stresses
      type(initial_state_type), intent(in) :: initial
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The element
      integer, intent(in) :: element
      !> The point
      type(solid_point_type), intent(in) :: point
      !> Amplitudes of r, z, theta, rz, r-theta, z-theta
      real(wp) :: stress(6)

      stress = 0.0_wp
      if (.not. same_mode(mode, mode_type(0, family_symmetric))) return
      stress(:4) = stress_before(initial%in_situ, model%mesh%element_body(element), &
                                 model%mesh%element_material(element), point%position(2))
   end function in_situ_stress

   !> Add the nodal forces of an acceleration of all masses
   subroutine add_mass_force(model, load, factor, force)
      !> The job
      type(model_type), intent(in) :: model
      !> The acceleration, and the factor on it
      type(body_load_type), intent(in) :: load
      real(wp), intent(in) :: factor
      !> Forces on components, shape (3, nodes)
      real(wp), intent(inout) :: force(:, :)

      type(solid_point_type) :: points(max_element_points)
      type(reference_type), allocatable :: references(:)
      real(wp) :: acceleration(3), weight
      integer :: element, n, n_points, i, j

      references = element_references(model%mesh)
      do element = 1, n_elements(model%mesh)
         n = model%mesh%element_size(element)
         associate (reference => references(model%mesh%element_kind(element)), &
                    nodes => model%mesh%element_nodes(:n, element), &
                    density => model%materials(model%mesh%element_material(element))%density)
            n_points = reference%n_points
            call solid_points(model%mesh%coordinates(:, nodes), reference, points(:n_points))
            do i = 1, n_points
               acceleration = load%acceleration
               acceleration(1) = acceleration(1) + load%spin_squared*points(i)%position(1)
               weight = factor*circle_integral(load%mode%harmonic)*density*points(i)%weight
               do j = 1, n
                  force(:, nodes(j)) = force(:, nodes(j)) + weight*points(i)%shape(j)*acceleration
               end do
            end do
         end associate
      end do
   end subroutine add_mass_force

end module axijoint_assembly_solid_force
