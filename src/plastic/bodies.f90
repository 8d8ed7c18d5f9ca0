!> Bodies that yield, as their integration points see them; nothing changes them during an analysis
module axijoint_plastic_bodies
   use axijoint_base_kinds, only : wp
   use axijoint_element_dilatation, only : dilatation_type, formulated_points
   use axijoint_element_solid_stress, only : solid_stress, add_solid_force
   use axijoint_element_solid_point, only : solid_point_type
   use axijoint_element_yield_law, only : yield_law_type, law_at, yield_none
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_reference, only : reference_type
   use axijoint_model_material, only : elasticity
   use axijoint_model_mesh, only : n_elements, element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: bodies_type, new_bodies, elastic_stress, add_stress_force

   !> An element that yields
   type :: body_element_type
      !> Its nodes
      integer, allocatable :: nodes(:)
      !> Its integration points, and the number of points of the elements before it
      type(solid_point_type), allocatable :: points(:)
      integer :: before = 0
      !> What it takes for the volumetric strain
      type(dilatation_type) :: dilatation
      !> Elasticity matrix
      real(wp) :: elasticity(6, 6) = 0.0_wp
   end type body_element_type

   !> The bodies
   type :: bodies_type
      !> Elements that yield
      type(body_element_type), allocatable :: elements(:)
      !> Law of each of their points
      type(yield_law_type), allocatable :: laws(:)
      !> Weight of each in an integral over the meridional plane, r included
      real(wp), allocatable :: weight(:)
      !> Place of each among the points of all elements
      integer, allocatable :: place(:)
      !> Number of all of these
      integer :: n_all = 0
   end type bodies_type

contains

   !> Gather the elements that yield
   subroutine new_bodies(model, laws, bodies)
      !> The job
      type(model_type), intent(in) :: model
      !> Law of each material
      type(yield_law_type), intent(in) :: laws(:)
      !> The bodies
      type(bodies_type), intent(out) :: bodies

      type(reference_type), allocatable :: references(:)
      integer :: e, i, n, before

      references = element_references(model%mesh)
      associate (mesh => model%mesh)
         associate (yields => laws(mesh%element_material)%criterion /= yield_none)
            allocate (bodies%elements(count(yields)))
            n = sum(references(mesh%element_kind)%n_points, yields)
            allocate (bodies%laws(n), bodies%weight(n), bodies%place(n))
            n = 0
            before = 0
            do e = 1, n_elements(mesh)
               associate (reference => references(mesh%element_kind(e)))
                  if (yields(e)) then
                     n = n + 1
                     call new_element(model, e, reference, bodies%elements(n))
                     bodies%elements(n)%before = 0
                     if (n > 1) bodies%elements(n)%before = bodies%elements(n - 1)%before &
                        + size(bodies%elements(n - 1)%points)
                     associate (element => bodies%elements(n))
                        do i = 1, reference%n_points
                           associate (p => element%before + i, point => element%points(i))
                              bodies%laws(p) = law_at(laws(mesh%element_material(e)), &
                                                      point%position(2))
                              bodies%weight(p) = point%weight
                              bodies%place(p) = before + i
                           end associate
                        end do
                     end associate
                  end if
                  before = before + reference%n_points
               end associate
            end do
            bodies%n_all = before
         end associate
      end associate
   end subroutine new_bodies

   !> An element
   subroutine new_element(model, number, reference, element)
      !> The job
      type(model_type), intent(in) :: model
      !> Its place in the mesh
      integer, intent(in) :: number
      !> It in natural coordinates
      type(reference_type), intent(in) :: reference
      !> The element
      type(body_element_type), intent(out) :: element

      element%nodes = model%mesh%element_nodes(:reference%n_nodes, number)
      allocate (element%points(reference%n_points))
      call formulated_points(model%mesh%coordinates(:, element%nodes), reference, element%points, &
                             element%dilatation)
      element%elasticity = elasticity(model%materials(model%mesh%element_material(number)))
   end subroutine new_element

   !> Stress amplitudes of one harmonic if the bodies were elastic
   pure subroutine elastic_stress(bodies, harmonic, displacement, wanted, stress)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Points whose stress is wanted, shape (points)
      logical, intent(in) :: wanted(:)
      !> r, z, theta, rz, r-theta, z-theta, shape (6, points); zero where it is not wanted
      real(wp), intent(out) :: stress(:, :)

      real(wp) :: local(3, 9)
      integer :: e, i

      stress = 0.0_wp
      do e = 1, size(bodies%elements)
         associate (element => bodies%elements(e))
            associate (n => size(element%nodes), before => element%before)
               if (.not. any(wanted(before + 1:before + size(element%points)))) cycle
               local(:, :n) = displacement(:, element%nodes)
               do i = 1, size(element%points)
                  if (.not. wanted(before + i)) cycle
                  stress(:, before + i) = solid_stress(element%points(i), n, element%elasticity, &
                     harmonic, local, element%dilatation)
               end do
            end associate
         end associate
      end do
   end subroutine elastic_stress

   !> Add the nodal forces that balance stresses of one harmonic: c_m B_m^T times stress
   pure subroutine add_stress_force(bodies, harmonic, stress, present, force)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Stress amplitudes, shape (6, points)
      real(wp), intent(in) :: stress(:, :)
      !> Points that have any, shape (points)
      logical, intent(in) :: present(:)
      !> Forces on components, shape (3, nodes)
      real(wp), intent(inout) :: force(:, :)

      real(wp) :: local(3, 9)
      integer :: e, i

      do e = 1, size(bodies%elements)
         associate (element => bodies%elements(e))
            associate (n => size(element%nodes), before => element%before)
               if (.not. any(present(before + 1:before + size(element%points)))) cycle
               local = 0.0_wp
               do i = 1, size(element%points)
                  if (.not. present(before + i)) cycle
                  call add_solid_force(element%points(i), n, harmonic, stress(:, before + i), &
                     local, element%dilatation)
               end do
               force(:, element%nodes) = force(:, element%nodes) &
                  + circle_integral(harmonic)*local(:, :n)
            end associate
         end associate
      end do
   end subroutine add_stress_force

end module axijoint_plastic_bodies
