!> The job on the fine mesh as a job of its own: with restraints and displacements that are given
module axijoint_analysis_fine_whole_model
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, new_fine_mesh, n_on
   use axijoint_analysis_fine_model, only : new_fine_model
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_load, only : prescribed_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, held_at
   implicit none
   private
   public :: new_whole_model

contains

   !> Cut every element of a job into four, every joint into two
   subroutine new_whole_model(model, fine, finer)
      !> The job
      type(model_type), intent(in) :: model
      !> The fine mesh
      type(fine_mesh_type), intent(out) :: fine
      !> The job on it
      type(model_type), intent(out) :: finer

      type(model_type) :: parts
      integer :: k

      call new_fine_mesh(model%mesh, fine)
      call new_fine_model(model, fine, parts)
      finer = model
      finer%mesh = parts%mesh
      finer%ring_loads = parts%ring_loads
      finer%edge_loads = parts%edge_loads
      finer%edge_supports = parts%edge_supports
      finer%thermal_loads = parts%thermal_loads
      finer%fixed = on_fine(fine, model%fixed)
      if (allocated(model%held_by_default)) finer%held_by_default = &
         on_fine(fine, model%held_by_default)
      if (.not. allocated(model%restraints)) allocate (finer%restraints(0))
      do k = 1, size(finer%restraints)
         finer%restraints(k)%held = on_fine(fine, model%restraints(k)%held)
      end do
      finer%prescribed = moved_on_fine(fine, model%prescribed, finer)
   end subroutine new_whole_model

   !> Components that are held on the fine mesh: of a new node on an edge, if all nodes of the edge
   !> are; not by the two ends of an edge inside a body, as in one that is one element thick between
   !> two faces
   pure function on_fine(fine, held)
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Whether components are held on the coarse mesh, shape (3, nodes)
      logical, intent(in) :: held(:, :)
      !> The same on the fine one
      logical, allocatable :: on_fine(:, :)

      integer :: k, i

      allocate (on_fine(3, n_nodes(fine%mesh)), source=.false.)
      on_fine(:, :size(held, 2)) = held
      do k = 1, size(fine%edges)
         associate (edge => fine%edges(k), nodes => fine%edges(k)%nodes(:n_on(fine%edges(k))))
            if (n_on(edge) == 2 .and. edge%elements(2) > 0) cycle
            do i = 1, n_on(edge) - 1
               on_fine(:, edge%new(i)) = all(held(:, nodes), 2)
            end do
         end associate
      end do
   end function on_fine

   !> Displacements that are given on the fine mesh: at a new node that is held, by those that it
   !> follows
   function moved_on_fine(fine, coarse, finer) result(moved)
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> The displacements on the coarse one
      type(prescribed_type), intent(in) :: coarse(:)
      !> The job on it, for the components that are held
      type(model_type), intent(in) :: finer
      !> The displacements; those of a component add up
      type(prescribed_type), allocatable :: moved(:)

      type(prescribed_type), allocatable :: more(:)
      integer :: first(n_nodes(fine%mesh)), next(size(coarse))
      integer :: node, k, p, n, pass

      first = 0
      do p = size(coarse), 1, -1  ! of each node the first, and the next after each
         next(p) = first(coarse(p)%node)
         first(coarse(p)%node) = p
      end do
      allocate (more(0))
      do pass = 1, 2  ! count, then fill
         n = 0
         do node = 1, n_nodes(fine%mesh)
            if (fine%parents%start(node + 1) == fine%parents%start(node) + 1) cycle  ! a coarse one
            do k = fine%parents%start(node), fine%parents%start(node + 1) - 1
               p = first(fine%parents%node(k))
               do while (p > 0)
                  if (is_held(finer, coarse(p)%mode, node, coarse(p)%component)) then
                     n = n + 1
                     if (pass == 2) then
                        more(n) = coarse(p)
                        more(n)%node = node
                        more(n)%value = fine%parents%weight(k)*coarse(p)%value
                     end if
                  end if
                  p = next(p)
               end do
            end do
         end do
         if (pass == 1) then
            deallocate (more)
            allocate (more(n))
         end if
      end do
      moved = [coarse, more]
   end function moved_on_fine

   !> Whether a component of a node is held in a mode
   pure logical function is_held(model, mode, node, component)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Node and component
      integer, intent(in) :: node, component

      logical :: held(3)

      held = held_at(model, mode, node)
      is_held = held(component)
   end function is_held

end module axijoint_analysis_fine_whole_model
