!> Stiffness of one solid element of a job, in blocks of two nodes
module axijoint_assembly_element_stiffness
   use axijoint_base_kinds, only : wp
   use axijoint_element_blocks, only : n_blocks
   use axijoint_element_dilatation, only : dilatation_type, formulated_points
   use axijoint_element_solid, only : solid_blocks, stiffness_kernel_type, new_stiffness_kernel
   use axijoint_element_solid_point, only : solid_point_type
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_model_material, only : elasticity
   use axijoint_model_mesh, only : max_element_nodes, element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: integrands_type, new_integrands, element_blocks, max_unknowns, max_blocks

   !> Unknowns of the largest element, and its blocks of two nodes
   integer, parameter :: max_unknowns = 3*max_element_nodes
   integer, parameter :: max_blocks = max_element_nodes*(max_element_nodes + 1)/2

   !> What the integrals over elements have in common
   type :: integrands_type
      !> Kinds of elements with their points
      type(reference_type), allocatable :: references(:)
      !> Kernels of the materials
      type(stiffness_kernel_type), allocatable :: kernels(:)
   end type integrands_type

contains

   !> Kinds of elements and kernels of a job
   function new_integrands(model) result(integrands)
      !> The job
      type(model_type), intent(in) :: model
      !> They
      type(integrands_type) :: integrands

      integer :: k

      integrands%references = element_references(model%mesh)
      allocate (integrands%kernels(size(model%materials)))
      do k = 1, size(model%materials)
         integrands%kernels(k) = new_stiffness_kernel(elasticity(model%materials(k)))
      end do
   end function new_integrands

   !> Integrate the blocks of one element
   subroutine element_blocks(model, integrands, element, blocks)
      !> The job
      type(model_type), intent(in) :: model
      !> Its kinds of elements and kernels
      type(integrands_type), intent(in) :: integrands
      !> Element
      integer, intent(in) :: element
      !> The blocks, the first of which are in use
      real(wp), intent(inout) :: blocks(2, 3, 3, max_blocks)

      type(solid_point_type) :: points(max_element_points)
      type(dilatation_type) :: dilatation
      integer :: n, n_points

      associate (reference => integrands%references(model%mesh%element_kind(element)), &
                 kernel => integrands%kernels(model%mesh%element_material(element)))
         n = reference%n_nodes
         n_points = reference%n_points
         call formulated_points(model%mesh%coordinates(:, model%mesh%element_nodes(:n, element)), &
            reference, &
                                points(:n_points), dilatation)
         call solid_blocks(points(:n_points), n, kernel, blocks(:, :, :, :n_blocks(n)), dilatation)
      end associate
   end subroutine element_blocks

end module axijoint_assembly_element_stiffness
