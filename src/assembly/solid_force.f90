!> Stresses of the solids and the nodal forces that they and their mass give
module axijoint_assembly_solid_force
   use axijoint_base_kinds, only : wp
   use axijoint_element_dilatation, only : dilatation_type, formulated_points, strain_shape
   use axijoint_element_solid_point, only : solid_point_type, solid_points
   use axijoint_element_solid_stress, only : solid_strip_type, most_elements, put_element, &
      strip_stresses, add_strip_forces
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : mode_type, same_mode, family_symmetric
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_model_load, only : body_load_type, initial_stress_type, stress_before
   use axijoint_model_material, only : elasticity, thermal_strain
   use axijoint_model_mesh, only : mesh_type, n_elements, max_element_nodes, &
      element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: initial_state_type, solid_force, add_mass_force

   !> Nodal forces of one mode or of several
   interface solid_force
      module procedure force_of_mode, force_of_modes
   end interface solid_force

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
   subroutine force_of_mode(model, initial, k, mode, displacement, force, stress)
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

      real(wp), allocatable :: forces(:, :, :), stresses(:, :, :)

      allocate (forces(3, size(force, 2), 1))
      if (present(stress)) then
         allocate (stresses(6, size(stress, 2), 1))
         call force_of_modes(model, initial, k, [mode], reshape(displacement, shape(forces)), &
            forces, stresses)
         stress = stresses(:, :, 1)
      else
         call force_of_modes(model, initial, k, [mode], reshape(displacement, shape(forces)), &
            forces)
      end if
      force = forces(:, :, 1)
   end subroutine force_of_mode

   !> The same of several modes, one after the other in the order of all: what elements need of
   !> shapes is found once for them
   subroutine force_of_modes(model, initial, place, modes, displacement, force, stress, counts, shares)
      !> The job
      type(model_type), intent(in) :: model
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> The modes, and the place of the first
      integer, intent(in) :: place
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Forces on components, shape (3, nodes, modes)
      real(wp), intent(out) :: force(:, :, :)
      !> Stress amplitudes at the Gauss points, shape (6, points, modes)
      real(wp), intent(out), optional :: stress(:, :, :)
      !> Elements that alone count, without their stresses; all if absent
      logical, intent(in), optional :: counts(:)
      !> Share of each of these in the forces, shape (3, max_element_nodes, elements, modes)
      real(wp), intent(inout), optional :: shares(:, :, :, :)

      type(reference_type), allocatable :: references(:)
      type(solid_strip_type) :: strip
      type(solid_point_type) :: points(max_element_points, most_elements)
      type(dilatation_type) :: dilatations(most_elements)
      real(wp), dimension(most_elements, 6, max_element_points) :: now, in_situ
      real(wp), dimension(most_elements, 3, max_element_nodes) :: local, balance
      real(wp) :: d(6, 6), share(3)
      integer :: before, behind, e, first, i, k, last, node
      logical :: averaged, stressed

      references = element_references(model%mesh)
      stressed = .false.
      if (allocated(initial%in_situ)) stressed = size(initial%in_situ) > 0
      force = 0.0_wp
      local = 0.0_wp
      behind = 0
      last = 0
      do while (last < n_elements(model%mesh))
         first = last + 1
         last = end_of_strip(model%mesh, first, counts)
         before = behind
         behind = before + (last - first + 1)*references(model%mesh%element_kind(first))%n_points
         if (present(counts)) then
            if (.not. counts(first)) cycle
         end if
         call fill_strip(model%mesh, references(model%mesh%element_kind(first)), first, last, strip, &
            points, dilatations)
         d = elasticity(model%materials(model%mesh%element_material(first)))
         do k = 1, size(modes)
            do i = 1, strip%n
               do e = first, last
                  local(e - first + 1, :, i) = displacement(:, model%mesh%element_nodes(i, e), k)
               end do
            end do
            call strip_stresses(strip, d, modes(k)%harmonic, local, now)
            call add_free_stress(model, initial, place + k - 1, points(:strip%n_points, :), dilatations, first, last, &
               before, d, now)
            balance = 0.0_wp
            call add_strip_forces(strip, modes(k)%harmonic, now, balance)
            if (stressed .and. same_mode(modes(k), mode_type(0, family_symmetric))) then
               call find_in_situ_stress(model, initial%in_situ, points, first, last, strip%n_points, in_situ)
               ! equilibrium in situ knows of no means
               averaged = strip%averaged
               strip%averaged = .false.
               call add_strip_forces(strip, modes(k)%harmonic, in_situ, balance)
               strip%averaged = averaged
               now(:, :, :strip%n_points) = now(:, :, :strip%n_points) &
                  + in_situ(:, :, :strip%n_points)
            end if
            do e = 1, last - first + 1
               do i = 1, strip%n
                  node = model%mesh%element_nodes(i, first + e - 1)
                  share = circle_integral(modes(k)%harmonic)*balance(e, :, i)
                  force(:, node, k) = force(:, node, k) + share
                  if (present(shares)) shares(:, i, first + e - 1, k) = share
               end do
               if (.not. present(stress)) cycle
               do i = 1, strip%n_points
                  stress(:, before + (e - 1)*strip%n_points + i, k) = now(e, :, i)
               end do
            end do
         end do
      end do
   end subroutine force_of_modes

   !> Last of the elements from one on that are like it, and not too many
   pure integer function end_of_strip(mesh, first, counts) result(last)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The first
      integer, intent(in) :: first
      !> Elements that count; all if absent
      logical, intent(in), optional :: counts(:)

      last = first
      do while (last < min(first + most_elements - 1, n_elements(mesh)))
         if (mesh%element_kind(last + 1) /= mesh%element_kind(first)) exit
         if (mesh%element_material(last + 1) /= mesh%element_material(first)) exit
         if (mesh%element_body(last + 1) /= mesh%element_body(first)) exit
         if (present(counts)) then
            if (counts(last + 1) .neqv. counts(first)) exit
         end if
         last = last + 1
      end do
   end function end_of_strip

   !> Put elements into a strip
   pure subroutine fill_strip(mesh, reference, first, last, strip, points, dilatations)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Their kind
      type(reference_type), intent(in) :: reference
      !> First and last
      integer, intent(in) :: first, last
      !> The strip
      type(solid_strip_type), intent(inout) :: strip
      !> Points of each element, shape (max_element_points, most_elements), and means over it
      type(solid_point_type), intent(inout) :: points(:, :)
      type(dilatation_type), intent(inout) :: dilatations(:)

      integer :: e, place

      do e = first, last
         place = e - first + 1
         call formulated_points(mesh%coordinates(:, mesh%element_nodes(:reference%n_nodes, e)), &
            reference, points(:reference%n_points, place), dilatations(place))
         call put_element(points(:reference%n_points, place), reference%n_nodes, dilatations(place), place, strip)
      end do
   end subroutine fill_strip

   !> Add the stress of a strip in one mode that temperatures and plastic strain give without strain
   pure subroutine add_free_stress(model, initial, k, points, dilatations, first, last, before, d, stress)
      !> The job
      type(model_type), intent(in) :: model
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> Place of the mode
      integer, intent(in) :: k
      !> Points of each element, shape (points, most_elements), and means over it
      type(solid_point_type), intent(in) :: points(:, :)
      type(dilatation_type), intent(in) :: dilatations(:)
      !> First and last element, and points of all elements before them
      integer, intent(in) :: first, last, before
      !> Elasticity matrix
      real(wp), intent(in) :: d(6, 6)
      !> Stress of the strains; takes that besides
      real(wp), intent(inout) :: stress(most_elements, 6, max_element_points)

      integer :: e, i, n

      if (.not. (allocated(initial%temperature) .or. allocated(initial%taken))) return
      n = size(points, 1)
      do e = 1, last - first + 1
         do i = 1, n
            if (allocated(initial%temperature)) stress(e, :, i) = stress(e, :, i) &
               + thermal_stress(model, initial, k, first + e - 1, strain_shape(dilatations(e), points(i, e)), d)
            if (allocated(initial%taken)) &
               stress(e, :, i) = stress(e, :, i) - initial%taken(:, before + (e - 1)*n + i, k)
         end do
      end do
   end subroutine add_free_stress

   !> In-situ stress of a strip: r, z, theta, rz; in the mode of the axis alone
   pure subroutine find_in_situ_stress(model, states, points, first, last, n, stress)
      !> The job
      type(model_type), intent(in) :: model
      !> In-situ stresses
      type(initial_stress_type), intent(in) :: states(:)
      !> Points of each element, shape (max_element_points, most_elements)
      type(solid_point_type), intent(in) :: points(:, :)
      !> First and last element, and points of each
      integer, intent(in) :: first, last, n
      !> The stress
      real(wp), intent(out) :: stress(most_elements, 6, max_element_points)

      integer :: e, i

      stress = 0.0_wp
      do e = 1, last - first + 1
         do i = 1, n
            stress(e, :4, i) = stress_before(states, model%mesh%element_body(first + e - 1), &
               model%mesh%element_material(first + e - 1), points(i, e)%position(2))
         end do
      end do
   end subroutine find_in_situ_stress

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
