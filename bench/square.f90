!> Square meshes of the benchmarks
module axijoint_bench_square
   use axijoint_base_kinds, only : wp
   use axijoint_fe_element_kind, only : kind_choice_type
   use axijoint_model_blank, only : new_model
   use axijoint_model_material, only : solid_material_type
   use axijoint_model_mesh, only : set_kinds
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: square

contains

   !> Square of 9-node elements, r = 1..2, z = 0..1, its bottom held
   function square(n_side, max_harmonic) result(model)
      !> Nodes along a side, odd
      integer, intent(in) :: n_side
      !> Highest harmonic
      integer, intent(in) :: max_harmonic
      !> The model
      type(model_type) :: model

      integer, parameter :: di(9) = [0, 2, 2, 0, 1, 2, 1, 0, 1], dj(9) = [0, 0, 2, 2, 0, 1, 2, 1, 1]
      integer :: i, j, k, n_nodes, n_elements

      n_nodes = n_side**2
      n_elements = ((n_side - 1)/2)**2
      model = new_model('square', max_harmonic)
      model%materials = [solid_material_type(label=1, young=1.0_wp, poisson=0.3_wp)]
      associate (mesh => model%mesh)
         mesh%node_label = [(i, i=1, n_nodes)]
         mesh%element_label = [(i, i=1, n_elements)]
         mesh%element_material = spread(1, 1, n_elements)
         mesh%element_body = spread(1, 1, n_elements)
         mesh%element_size = spread(9, 1, n_elements)
         call set_kinds(mesh, kind_choice_type())
         deallocate (mesh%coordinates, mesh%element_nodes)
         allocate (mesh%coordinates(2, n_nodes), mesh%element_nodes(9, n_elements))
         do j = 0, n_side - 1
            do i = 0, n_side - 1
               mesh%coordinates(:, 1 + i + j*n_side) = [1.0_wp, 0.0_wp] &
                  + real([i, j], wp)/(n_side - 1)
            end do
         end do
         k = 0
         do j = 0, n_side - 3, 2
            do i = 0, n_side - 3, 2
               k = k + 1
               mesh%element_nodes(:, k) = 1 + i + di + (j + dj)*n_side
            end do
         end do
         model%fixed = spread(mesh%coordinates(2, :) <= 0.0_wp, 1, 3)
      end associate
   end function square

end module axijoint_bench_square
