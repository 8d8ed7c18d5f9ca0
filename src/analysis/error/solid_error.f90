!> Error of the stresses of solids: recovered stresses against those of the elements
module axijoint_analysis_error_solid_error
   use axijoint_analysis_error_patch_recovery, only : sampling_type, new_sampling, patches_type, &
                                                new_patches, patch_work_type, find_patch, fit_patch, add_rings
   use axijoint_assembly_equations, only : equations_type, own_modes, worth_threads
   use axijoint_assembly_solid_force, only : initial_state_type, solid_force
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_ranges, only : range_end
   use axijoint_element_solid_point, only : solid_point_type, solid_points
   use axijoint_fe_element_kind, only : is_reduced, full_order
   use axijoint_fe_mode, only : mode_integral
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_linalg_lapack, only : cholesky, inverse_from_cholesky, dgemm
   use axijoint_model_material, only : elasticity
   use axijoint_model_mesh, only : n_elements, element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: solid_errors

   !> What the elements need, the same for all modes
   type :: fields_type
      !> The elements with the integration points of the stresses
      type(reference_type), allocatable :: references(:)
      !> Samples of each kind of element, and of the mesh
      type(sampling_type), allocatable :: samplings(:)
      type(patches_type) :: patches
      !> Point before the first of each element, shape (elements)
      integer, allocatable :: before(:)
      !> Stress amplitudes at the points of the full rule, shape (6, points, modes); allocated if
      !> there are elements with the reduced rule
      real(wp), allocatable :: stress(:, :, :)
      !> Stress amplitudes at the samples, shape (6, modes, samples)
      real(wp), allocatable :: sampled(:, :, :)
      !> D^-1 of each material, shape (6, 6, materials)
      real(wp), allocatable :: compliance(:, :, :)
   end type fields_type

contains

   !> Energies of the error of stress and of the stress itself, element by element; each rank looks
   !> at a range of elements
   subroutine solid_errors(model, equations, initial, displacement, stress, error, energy)
      !> The job
      type(model_type), intent(in) :: model
      !> Its equations, for modes and ranks
      type(equations_type), intent(in) :: equations
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Stress amplitudes at the integration points, shape (6, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> Energies, shape (modes, elements)
      real(wp), allocatable, intent(out) :: error(:, :), energy(:, :)

      type(fields_type) :: fields
      type(patch_work_type), allocatable :: work  ! threads have small stacks
      integer :: element, rank
      integer, allocatable :: last(:)

      associate (n_modes => size(equations%modes), n => n_elements(model%mesh))
         allocate (error(n_modes, n), energy(n_modes, n))
         last = [(range_end(n, rank, equations%team%size), rank=0, equations%team%size)]
      end associate
      rank = equations%team%rank
      call new_fields(model, equations, initial, displacement, stress, &
         [last(rank + 1) + 1, last(rank + 2)], fields)
      !$omp parallel private(work) if (worth_threads(equations))
      allocate (work)
      !$omp do schedule(dynamic, 16)
      do element = last(rank + 1) + 1, last(rank + 2)
         if (allocated(fields%stress)) then
            call element_error(model, fields, fields%stress, element, work, error(:, element), &
               energy(:, element))
         else
            call element_error(model, fields, stress, element, work, error(:, element), &
               energy(:, element))
         end if
         error(:, element) = mode_integral(equations%modes)*error(:, element)
         energy(:, element) = mode_integral(equations%modes)*energy(:, element)
      end do
      !$omp end do
      !$omp end parallel
      call equations%team%gather(error, size(error, kind=i8), last)
      call equations%team%gather(energy, size(energy, kind=i8), last)
   end subroutine solid_errors

   !> Stresses at the integration points and at the samples
   subroutine new_fields(model, equations, initial, displacement, stress, own, fields)
      !> The job
      type(model_type), intent(in) :: model
      !> Its equations, for modes and ranks
      type(equations_type), intent(in) :: equations
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Stress amplitudes at the integration points, shape (6, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> First and last element that is looked at: the samples of all in their patches are taken
      integer, intent(in) :: own(2)
      !> Takes them
      type(fields_type), intent(out) :: fields

      logical, allocatable :: in_patches(:)
      integer :: element, k, n_points

      if (any(is_reduced(model%mesh%kinds))) then
         call full_stress(model, equations, initial, displacement, fields)
      else
         fields%references = element_references(model%mesh)
      end if
      fields%samplings = new_sampling(fields%references)
      call new_patches(model%mesh, fields%samplings, fields%patches)
      allocate (fields%before(n_elements(model%mesh)))
      n_points = 0
      do element = 1, n_elements(model%mesh)
         fields%before(element) = n_points
         n_points = n_points + fields%references(model%mesh%element_kind(element))%n_points
      end do
      allocate (fields%sampled(6, size(equations%modes), size(fields%patches%position, 2)))
      allocate (in_patches(n_elements(model%mesh)), source=.false.)
      in_patches(own(1):own(2)) = .true.
      call add_rings(model%mesh, fields%patches, in_patches)
      !$omp parallel do if (worth_threads(equations))
      do element = 1, n_elements(model%mesh)
         if (.not. in_patches(element)) cycle
         if (allocated(fields%stress)) then
            call take_samples(model, fields, fields%stress, element)
         else
            call take_samples(model, fields, stress, element)
         end if
      end do
      !$omp end parallel do
      allocate (fields%compliance(6, 6, size(model%materials)))
      do k = 1, size(model%materials)
         fields%compliance(:, :, k) = inverse_elasticity(elasticity(model%materials(k)))
      end do
   end subroutine new_fields

   !> Stresses at the points of the full rule: at those of the reduced one the stresses of quadratic
   !> elements are best, and the error would seem small
   subroutine full_stress(model, equations, initial, displacement, fields)
      !> The job
      type(model_type), intent(in) :: model
      !> Its equations, for modes and ranks
      type(equations_type), intent(in) :: equations
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Takes elements and stresses
      type(fields_type), intent(inout) :: fields

      type(model_type), allocatable :: full
      real(wp), allocatable :: force(:, :)
      integer :: k, n, own(2)

      allocate (full, source=model)
      where (is_reduced(full%mesh%kinds)) full%mesh%kinds%order = full_order
      fields%references = element_references(full%mesh)
      n = sum(fields%references(model%mesh%element_kind)%n_points)
      allocate (fields%stress(6, n, size(equations%modes)))
      own = own_modes(equations)
      !$omp parallel do schedule(dynamic) private(force) if (worth_threads(equations))
      do k = own(1), own(2)
         allocate (force, mold=displacement(:, :, k))
         call solid_force(full, initial, k, equations%modes(k), displacement(:, :, k), force, &
            fields%stress(:, :, k))
         deallocate (force)
      end do
      !$omp end parallel do
      call equations%team%gather(fields%stress, size(fields%stress, kind=i8), equations%last_mode)
   end subroutine full_stress

   !> Stresses at the samples of an element
   pure subroutine take_samples(model, fields, stress, element)
      !> The job
      type(model_type), intent(in) :: model
      !> Takes the stresses of the samples
      type(fields_type), intent(inout) :: fields
      !> Stress amplitudes at the points, shape (6, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> The element
      integer, intent(in) :: element

      real(wp) :: sample(6)
      integer :: s, i, k

      associate (n => model%mesh%element_kind(element), first => fields%patches%before(element), &
                 before => fields%before(element))
         do s = 1, fields%samplings(n)%n
            do k = 1, size(stress, 3)
               sample = 0.0_wp
               do i = 1, fields%references(n)%n_points
                  sample = sample + fields%samplings(n)%matrix(s, i)*stress(:, before + i, k)
               end do
               fields%sampled(:, k, first + s) = sample
            end do
         end do
      end associate
   end subroutine take_samples

   !> Energies of one element, but for the factor c_m
   subroutine element_error(model, fields, stress, element, work, error, energy)
      !> The job
      type(model_type), intent(in) :: model
      !> Samples, and what belongs to them
      type(fields_type), intent(in) :: fields
      !> Stress amplitudes at the points, shape (6, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> The element
      integer, intent(in) :: element
      !> Room for the patch
      type(patch_work_type), intent(inout) :: work
      !> Energy of the error and of the stress, shape (modes)
      real(wp), intent(out) :: error(:), energy(:)

      type(solid_point_type) :: points(max_element_points)
      real(wp), allocatable :: sampled(:, :, :), recovered(:, :, :)
      real(wp) :: position(2, max_element_points), own(6)
      integer :: n, kind, i, s, k

      n = model%mesh%element_size(element)
      kind = model%mesh%element_kind(element)
      error = 0.0_wp
      energy = 0.0_wp
      associate (reference => fields%references(kind), sampling => fields%samplings(kind), &
                 compliance => fields%compliance(:, :, model%mesh%element_material(element)))
         call solid_points(model%mesh%coordinates(:, model%mesh%element_nodes(:n, element)), &
                           reference, points(:reference%n_points))
         do i = 1, reference%n_points
            position(:, i) = points(i)%position
         end do
         call find_patch(model%mesh, fields%patches, sampling%least_elements, element, work)
         call fit_patch(model%mesh, fields%patches, sampling%degree, element, &
                        position(:, :reference%n_points), work)
         allocate (sampled(6, size(error), work%n_samples), recovered(6, size(error), reference%n_points))
         do s = 1, work%n_samples
            sampled(:, :, s) = fields%sampled(:, :, work%samples(s))
         end do
         associate (matrix => work%fits(work%fit)%matrix)
            call dgemm('N', 'T', 6*size(error), size(matrix, 1), work%n_samples, 1.0_wp, sampled, 6*size(error), &
               matrix, size(matrix, 1), 0.0_wp, recovered, 6*size(error))
         end associate
         do i = 1, reference%n_points
            associate (point => fields%before(element) + i, weight => 0.5_wp*points(i)%weight)
               do k = 1, size(error)
                  own = stress(:, point, k)
                  error(k) = error(k) + weight*square(compliance, recovered(:, k, i) - own)
                  energy(k) = energy(k) + weight*square(compliance, own)
               end do
            end associate
         end do
      end associate
   end subroutine element_error

   !> x^T A x
   pure real(wp) function square(a, x)
      !> A, symmetric
      real(wp), intent(in) :: a(6, 6)
      !> x
      real(wp), intent(in) :: x(6)

      square = dot_product(x, matmul(a, x))
   end function square

   !> Inverse of an elasticity matrix
   function inverse_elasticity(d) result(inverse)
      !> The matrix
      real(wp), intent(in) :: d(6, 6)
      !> Its inverse
      real(wp) :: inverse(6, 6)

      integer :: info

      inverse = d
      call cholesky(inverse, info)  ! positive definite: the deck's constants are checked
      call inverse_from_cholesky(inverse)
   end function inverse_elasticity

end module axijoint_analysis_error_solid_error
