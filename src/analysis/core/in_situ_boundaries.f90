!> Common boundaries of materials of one body, or of bonded ones: in-situ stresses on both sides must have
!> the same traction there
module axijoint_analysis_core_in_situ_boundaries
   use axijoint_analysis_core_in_situ, only : in_situ_boundary_type, alike
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_load, only : initial_stress_type, covers, stress_before
   use axijoint_model_mesh, only : edge_nodes, n_elements
   use axijoint_model_model, only : model_type
   use axijoint_model_neighbours, only : neighbours_type, element_at_edge
   implicit none
   private
   public :: add_boundaries, place_of

contains

   !> Add the boundaries of one state, or what is worse on those that are known
   subroutine add_boundaries(model, neighbours, stresses, increment, boundaries)
      !> The job
      type(model_type), intent(in) :: model
      !> Elements by their nodes
      type(neighbours_type), intent(in) :: neighbours
      !> In-situ stresses, factors of the load cases in them
      type(initial_stress_type), intent(in) :: stresses(:)
      !> Increment at whose end they act
      integer, intent(in) :: increment
      !> The boundaries
      type(in_situ_boundary_type), allocatable, intent(inout) :: boundaries(:)

      type(in_situ_boundary_type) :: now
      integer, allocatable :: nodes(:)
      integer :: element, side, other, k

      associate (mesh => model%mesh)
         do element = 1, n_elements(mesh)
            if (.not. any(covers(stresses, mesh%element_body(element), &
               mesh%element_material(element)))) cycle
            do side = 1, n_corners(mesh%element_size(element))
               nodes = edge_nodes(mesh, element, side)
               other = element_at_edge(mesh, neighbours, nodes(1), nodes(2), element)
               if (other == 0) cycle
               if (mesh%element_material(other) == mesh%element_material(element) .and. &
                   mesh%element_body(other) == mesh%element_body(element)) cycle
               now = boundary_at(model, stresses, nodes, element, other)
               now%increment = increment
               k = place_of(now, boundaries)
               if (k == 0) then
                  boundaries = [boundaries, now]
               else
                  call unite(boundaries(k), now)
               end if
            end do
         end do
      end associate
   end subroutine add_boundaries

   !> One edge of a boundary. Stresses are linear along it, so its ends tell the largest jump
   pure function boundary_at(model, stresses, nodes, element, other) result(boundary)
      !> The job
      type(model_type), intent(in) :: model
      !> In-situ stresses
      type(initial_stress_type), intent(in) :: stresses(:)
      !> Nodes of the edge, and the elements on both sides
      integer, intent(in) :: nodes(:), element, other
      !> What is found
      type(in_situ_boundary_type) :: boundary

      real(wp) :: normal(2), here(2), there(2), jump
      integer :: k, first

      associate (mesh => model%mesh, body => model%mesh%element_body([element, other]), &
                 materials => model%mesh%element_material([element, other]))
         boundary%bodies = body
         boundary%materials = materials
         if (body(1) > body(2) .or. (body(1) == body(2) .and. materials(1) > materials(2))) then
            boundary%bodies = body(2:1:-1)
            boundary%materials = materials(2:1:-1)
         end if
         first = findloc(covers(stresses, body(1), materials(1)) &
            .or. covers(stresses, body(2), materials(2)), .true., 1)
         boundary%card = stresses(first)%card
         boundary%meant = any(stresses%meant .and. &
                              (covers(stresses, body(1), materials(1)) &
                              .or. covers(stresses, body(2), materials(2))))
         normal = mesh%coordinates(:, nodes(2)) - mesh%coordinates(:, nodes(1))
         normal = [normal(2), -normal(1)]/norm2(normal)
         do k = 1, 2
            associate (position => mesh%coordinates(:, nodes(k)))
               here = traction(stress_before(stresses, body(1), materials(1), position(2)), normal)
               there = traction(stress_before(stresses, body(2), materials(2), position(2)), normal)
               boundary%traction = max(boundary%traction, norm2(here), norm2(there))
               jump = norm2(here - there)
               if (k > 1 .and. .not. jump > (1.0_wp + alike)*boundary%jump) cycle
               boundary%jump = jump
               boundary%position = position
            end associate
         end do
      end associate
   end function boundary_at

   !> Traction along r and z of a stress
   pure function traction(stress, normal)
      !> sigma_r, sigma_z, sigma_theta, tau_rz
      real(wp), intent(in) :: stress(4)
      !> Normal of the surface
      real(wp), intent(in) :: normal(2)
      !> The traction
      real(wp) :: traction(2)

      traction = [stress(1)*normal(1) + stress(4)*normal(2), stress(4)*normal(1) + &
         stress(2)*normal(2)]
   end function traction

   !> Place of a boundary of the same bodies and materials; 0 if there is none
   pure integer function place_of(boundary, boundaries) result(place)
      !> The boundary
      type(in_situ_boundary_type), intent(in) :: boundary
      !> Those that are known
      type(in_situ_boundary_type), intent(in) :: boundaries(:)

      do place = size(boundaries), 1, -1
         if (all(boundaries(place)%bodies == boundary%bodies) .and. &
             all(boundaries(place)%materials == boundary%materials)) return
      end do
   end function place_of

   !> Add an edge to a boundary
   pure subroutine unite(boundary, edge)
      !> The boundary
      type(in_situ_boundary_type), intent(inout) :: boundary
      !> The edge
      type(in_situ_boundary_type), intent(in) :: edge

      boundary%traction = max(boundary%traction, edge%traction)
      if (.not. edge%jump > (1.0_wp + alike)*boundary%jump) return
      boundary%jump = edge%jump
      boundary%position = edge%position
      boundary%increment = edge%increment
   end subroutine unite

end module axijoint_analysis_core_in_situ_boundaries
