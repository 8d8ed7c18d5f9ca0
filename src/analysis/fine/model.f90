!> The job on the fine mesh: the same loads and restraints on all that the cut edges have
module axijoint_analysis_fine_model
   use axijoint_analysis_fine_line_loads, only : spread_line_loads
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, half_edges, edge_shape, prolong
   use axijoint_base_kinds, only : wp
   use axijoint_model_load, only : edge_load_type, edge_support_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: new_fine_model

contains

   !> Put a job on a fine mesh. Restraints and given displacements are those of the coarse mesh: the
   !> fine model has none
   subroutine new_fine_model(model, fine, finer)
      !> The job
      type(model_type), intent(in) :: model
      !> The fine mesh of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> The job on it
      type(model_type), intent(out) :: finer

      type(edge_load_type), allocatable :: tractions(:)
      integer :: k

      finer%mesh = fine%mesh
      finer%materials = model%materials
      finer%joint_materials = model%joint_materials
      call spread_line_loads(model, fine, tractions, finer%ring_loads)
      tractions = [model%edge_loads, tractions]
      finer%edge_loads = [(halves_of_load(tractions(k), fine), k=1, size(tractions))]
      finer%edge_supports = [(halves_of_support(model%edge_supports(k), fine), k=1, &
         size(model%edge_supports))]
      finer%body_loads = model%body_loads
      finer%initial_stresses = model%initial_stresses
      finer%thermal_loads = model%thermal_loads
      do k = 1, size(finer%thermal_loads)
         finer%thermal_loads(k)%temperature = at_fine_nodes(fine, &
            model%thermal_loads(k)%temperature)
      end do
   end subroutine new_fine_model

   !> The halves of a load on an edge
   pure function halves_of_load(load, fine) result(halves)
      !> The load
      type(edge_load_type), intent(in) :: load
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Its halves
      type(edge_load_type) :: halves(2)

      integer :: n, c

      halves = load
      n = count(load%nodes > 0)
      associate (nodes => half_edges(fine, load%nodes(1), load%nodes(2)), &
                 new => matmul(load%traction(:, :n), edge_shape(n)))
         do c = 1, 2
            halves(c)%nodes = nodes(:, c)
            halves(c)%traction(:, 3 - c) = new(:, 1)
            if (n == 3) halves(c)%traction(:, 3 - c) = load%traction(:, 3)
            if (n == 3) halves(c)%traction(:, 3) = new(:, c)
         end do
      end associate
   end function halves_of_load

   !> The halves of springs on an edge
   function halves_of_support(support, fine) result(halves)
      !> The springs
      type(edge_support_type), intent(in) :: support
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Their halves
      type(edge_support_type) :: halves(2)

      halves = support
      associate (nodes => half_edges(fine, support%nodes(1), support%nodes(2)))
         halves(1)%nodes = nodes(:, 1)
         halves(2)%nodes = nodes(:, 2)
      end associate
   end function halves_of_support

   !> Values at the fine nodes
   pure function at_fine_nodes(fine, values)
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Values at the coarse nodes
      real(wp), intent(in) :: values(:)
      !> Values at all
      real(wp), allocatable :: at_fine_nodes(:)

      real(wp) :: found(1, n_nodes(fine%mesh))

      call prolong(fine%parents, reshape(values, [1, size(values)]), found)
      at_fine_nodes = found(1, :)
   end function at_fine_nodes

end module axijoint_analysis_fine_model
