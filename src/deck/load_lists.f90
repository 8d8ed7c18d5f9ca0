!> Loads while they are being read
module axijoint_deck_load_lists
   use axijoint_base_kinds, only : wp
   use axijoint_deck_draft, only : edge_type
   use axijoint_deck_load_modes, only : share_type
   use axijoint_model_load, only : edge_load_type, ring_load_type, truncation_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: load_lists_type, new_load_lists, add_tractions, add_ring_load, take_loads

   !> Loads; the arrays of `n_` may be longer than these counts
   type :: load_lists_type
      !> Tractions on edges
      type(edge_load_type), allocatable :: edge_loads(:)
      integer :: n_edge_loads = 0
      !> Loads on nodal circles
      type(ring_load_type), allocatable :: ring_loads(:)
      integer :: n_ring_loads = 0
      !> What the harmonics leave of the loads
      type(truncation_type), allocatable :: truncations(:)
   end type load_lists_type

contains

   !> Lists without loads
   pure function new_load_lists() result(lists)
      !> The lists
      type(load_lists_type) :: lists

      allocate (lists%edge_loads(64), lists%ring_loads(64), lists%truncations(0))
   end function new_load_lists

   !> Add tractions on the edges of a face, in each mode its share
   pure subroutine add_tractions(lists, case, edges, traction, shares)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> Load case
      integer, intent(in) :: case
      !> Edges of the face
      type(edge_type), intent(in) :: edges(:)
      !> t_r, t_z, t_theta at the nodes of each edge, shape (3, 3, edges) [stress]
      real(wp), intent(in) :: traction(:, :, :)
      !> What each mode takes
      type(share_type), intent(in) :: shares(:)

      type(edge_load_type) :: load
      integer :: i, k

      do k = 1, size(shares)
         do i = 1, size(edges)
            load = edge_load_type(shares(k)%mode, case, edges(i)%nodes, &
                                  spread(shares(k)%factor, 2, 3)*traction(:, :, i))
            if (size(shares) > 1 .and. .not. any(abs(load%traction) > 0.0_wp)) cycle
            call add_edge_load(lists, load)
         end do
      end do
   end subroutine add_tractions

   !> Add a traction on one edge
   pure subroutine add_edge_load(lists, load)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> The load
      type(edge_load_type), intent(in) :: load

      type(edge_load_type), allocatable :: larger(:)

      if (lists%n_edge_loads == size(lists%edge_loads)) then
         allocate (larger(2*lists%n_edge_loads))
         larger(:lists%n_edge_loads) = lists%edge_loads
         call move_alloc(larger, lists%edge_loads)
      end if
      lists%n_edge_loads = lists%n_edge_loads + 1
      lists%edge_loads(lists%n_edge_loads) = load
   end subroutine add_edge_load

   !> Add a load on a nodal circle
   pure subroutine add_ring_load(lists, load)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> The load
      type(ring_load_type), intent(in) :: load

      type(ring_load_type), allocatable :: larger(:)

      if (lists%n_ring_loads == size(lists%ring_loads)) then
         allocate (larger(2*lists%n_ring_loads))
         larger(:lists%n_ring_loads) = lists%ring_loads
         call move_alloc(larger, lists%ring_loads)
      end if
      lists%n_ring_loads = lists%n_ring_loads + 1
      lists%ring_loads(lists%n_ring_loads) = load
   end subroutine add_ring_load

   !> Move the loads into the model
   pure subroutine take_loads(lists, model)
      !> The lists; empty on return
      type(load_lists_type), intent(inout) :: lists
      !> The job
      type(model_type), intent(inout) :: model

      model%edge_loads = lists%edge_loads(:lists%n_edge_loads)
      model%ring_loads = lists%ring_loads(:lists%n_ring_loads)
      call move_alloc(lists%truncations, model%truncations)
   end subroutine take_loads

end module axijoint_deck_load_lists
