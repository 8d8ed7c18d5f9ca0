!> Loads while they are being read
module axijoint_deck_load_lists
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : lexical_order
   use axijoint_deck_load_shares, only : share_type, truncation_list_type
   use axijoint_deck_mesh_draft, only : edge_type
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_model_load, only : edge_load_type, ring_load_type, body_load_type, &
      thermal_load_type, prescribed_type, initial_stress_type, edge_support_type, left_out_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: load_lists_type, move_type, new_load_lists, take_loads
   public :: add_tractions, add_ring_load, add_body_load, add_temperatures, add_move, &
      add_initial_stress, &
      add_edge_support

   !> Rounding of a sum over the sizes of what is summed
   real(wp), parameter :: rounding = 1.0e-13_wp
   !> The same of angles as they are written in decks, where no harmonic in use is concerned
   real(wp), parameter :: little = 1.0e-4_wp

   !> A given displacement, and what its card says of it
   type, extends(prescribed_type) :: move_type
      !> The card
      integer :: card = 0
      !> Whether the component is held in the mode of the card only
      logical :: only = .false.
      !> Whether it is a card of nodes, not of a face
      logical :: of_nodes = .false.
   end type move_type

   !> Loads; the arrays of `n_` may be longer than these counts
   type :: load_lists_type
      !> Nodes of the mesh
      integer :: n_nodes = 0
      !> Tractions on edges
      type(edge_load_type), allocatable :: edge_loads(:)
      integer :: n_edge_loads = 0
      !> Loads on nodal circles
      type(ring_load_type), allocatable :: ring_loads(:)
      integer :: n_ring_loads = 0
      !> Forces on masses
      type(body_load_type), allocatable :: body_loads(:)
      !> Temperatures, one entry for each case, mode and body
      type(thermal_load_type), allocatable :: thermal_loads(:)
      !> Displacements that are given, zeros too
      type(move_type), allocatable :: moves(:)
      integer :: n_moves = 0
      !> In-situ stresses
      type(initial_stress_type), allocatable :: initial_stresses(:)
      !> Springs to the ground
      type(edge_support_type), allocatable :: edge_supports(:)
      !> What the harmonics leave of the loads
      type(truncation_list_type) :: truncations
   end type load_lists_type

contains

   !> Lists without loads
   pure function new_load_lists(n_nodes) result(lists)
      !> Number of nodes of the mesh
      integer, intent(in) :: n_nodes
      !> The lists
      type(load_lists_type) :: lists

      lists%n_nodes = n_nodes
      allocate (lists%edge_loads(64), lists%ring_loads(64), lists%moves(64))
      allocate (lists%body_loads(0), lists%thermal_loads(0), lists%initial_stresses(0))
      allocate (lists%edge_supports(0))
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

   !> Add a force on masses
   pure subroutine add_body_load(lists, load)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> The load
      type(body_load_type), intent(in) :: load

      lists%body_loads = [lists%body_loads, load]
   end subroutine add_body_load

   !> Add an in-situ stress
   pure subroutine add_initial_stress(lists, stress)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> The stress
      type(initial_stress_type), intent(in) :: stress

      lists%initial_stresses = [lists%initial_stresses, stress]
   end subroutine add_initial_stress

   !> Add a spring to the ground
   pure subroutine add_edge_support(lists, support)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> The spring
      type(edge_support_type), intent(in) :: support

      lists%edge_supports = [lists%edge_supports, support]
   end subroutine add_edge_support

   !> Add a temperature in each mode: it goes with cos in the symmetric and with sin in the
   !> antisymmetric family
   pure subroutine add_temperatures(lists, case, shares, body, nodes, temperature)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> Load case
      integer, intent(in) :: case
      !> What each mode takes
      type(share_type), intent(in) :: shares(:)
      !> Body; 0 for all
      integer, intent(in) :: body
      !> Nodes, and their temperatures
      integer, intent(in) :: nodes(:)
      real(wp), intent(in) :: temperature(:)

      integer :: k

      do k = 1, size(shares)
         associate (factor => shares(k)%factor(1))
            if (.not. abs(factor) > 0.0_wp) cycle
            call add_temperature(lists, case, shares(k)%mode, body, nodes, factor*temperature)
         end associate
      end do
   end subroutine add_temperatures

   !> Add temperatures to those of the same case, mode and body
   pure subroutine add_temperature(lists, case, mode, body, nodes, temperature)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> Load case
      integer, intent(in) :: case
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Body; 0 for all
      integer, intent(in) :: body
      !> Nodes, and their temperatures
      integer, intent(in) :: nodes(:)
      real(wp), intent(in) :: temperature(:)

      integer :: k

      do k = size(lists%thermal_loads), 1, -1
         associate (other => lists%thermal_loads(k))
            if (other%case == case .and. other%body == body .and. same_mode(other%mode, mode)) exit
         end associate
      end do
      if (k == 0) then
         call add_temperature_field(lists, case, mode, body)
         k = size(lists%thermal_loads)
      end if
      associate (all_nodes => lists%thermal_loads(k)%temperature)
         all_nodes(nodes) = all_nodes(nodes) + temperature
      end associate
   end subroutine add_temperature

   !> Add a temperature of zero. The others are moved, not copied: each has a value a node
   pure subroutine add_temperature_field(lists, case, mode, body)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> Load case
      integer, intent(in) :: case
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Body; 0 for all
      integer, intent(in) :: body

      type(thermal_load_type), allocatable :: larger(:)
      integer :: k, n

      n = size(lists%thermal_loads)
      allocate (larger(n + 1))
      do k = 1, n
         larger(k)%mode = lists%thermal_loads(k)%mode
         larger(k)%case = lists%thermal_loads(k)%case
         larger(k)%body = lists%thermal_loads(k)%body
         call move_alloc(lists%thermal_loads(k)%temperature, larger(k)%temperature)
      end do
      larger(n + 1)%mode = mode
      larger(n + 1)%case = case
      larger(n + 1)%body = body
      allocate (larger(n + 1)%temperature(lists%n_nodes), source=0.0_wp)
      call move_alloc(larger, lists%thermal_loads)
   end subroutine add_temperature_field

   !> Add a given displacement
   pure subroutine add_move(lists, move)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> The displacement; may be zero
      type(move_type), intent(in) :: move

      type(move_type), allocatable :: larger(:)

      if (lists%n_moves == size(lists%moves)) then
         allocate (larger(2*lists%n_moves))
         larger(:lists%n_moves) = lists%moves
         call move_alloc(larger, lists%moves)
      end if
      lists%n_moves = lists%n_moves + 1
      lists%moves(lists%n_moves) = move
   end subroutine add_move

   !> Move the loads into the model, but those of harmonics that are not in use, which are noted; displacements are left to their
   !> check
   pure subroutine take_loads(lists, model)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> The job, with its harmonics
      type(model_type), intent(inout) :: model

      logical, allocatable :: edge_acts(:), ring_acts(:)
      integer :: k

      allocate (model%left_out(0))
      associate (edges => lists%edge_loads(:lists%n_edge_loads), rings => lists%ring_loads(:lists%n_ring_loads))
         allocate (edge_acts(size(edges)), ring_acts(size(rings)), source=.true.)
         if (lists%truncations%n > 1) then
            edge_acts = .not. cancel_each_other([(to_nothing(model, edges(k)%mode), k=1, size(edges))], &
               reshape([(edges(k)%case, edges(k)%mode%harmonic, edges(k)%mode%family, edges(k)%nodes(:2), k=1, size(edges))], &
               [5, size(edges)]), reshape([(edges(k)%traction, k=1, size(edges))], [9, size(edges)]))
            ring_acts = .not. cancel_each_other([(to_nothing(model, rings(k)%mode), k=1, size(rings))], &
               reshape([(rings(k)%case, rings(k)%mode%harmonic, rings(k)%mode%family, rings(k)%node, k=1, size(rings))], &
               [4, size(rings)]), reshape([(rings(k)%force, k=1, size(rings))], [3, size(rings)]))
         end if
         do k = 1, size(edges)
            if (is_used(model, edges(k)%mode)) cycle
            if (edge_acts(k) .and. any(abs(edges(k)%traction) > 0.0_wp)) call note(model, edges(k)%mode, edges(k)%case)
            edge_acts(k) = .false.
         end do
         do k = 1, size(rings)
            if (is_used(model, rings(k)%mode)) cycle
            if (ring_acts(k) .and. any(abs(rings(k)%force) > 0.0_wp)) call note(model, rings(k)%mode, rings(k)%case)
            ring_acts(k) = .false.
         end do
         model%edge_loads = pack(edges, edge_acts)
         model%ring_loads = pack(rings, ring_acts)
      end associate
      call take_temperatures(lists, model)
      call move_alloc(lists%body_loads, model%body_loads)
      call move_alloc(lists%initial_stresses, model%initial_stresses)
      call move_alloc(lists%edge_supports, model%edge_supports)
      allocate (model%truncations(lists%truncations%n))
      if (lists%truncations%n > 0) model%truncations = lists%truncations%entries(:lists%truncations%n)
   end subroutine take_loads

   !> Move the temperatures into the model, but those of harmonics that are not in use
   pure subroutine take_temperatures(lists, model)
      !> The lists
      type(load_lists_type), intent(inout) :: lists
      !> The job, with its harmonics
      type(model_type), intent(inout) :: model

      real(wp), allocatable :: largest(:)
      integer :: k, n

      largest = [(maxval(abs(lists%thermal_loads(k)%temperature)), k=1, size(lists%thermal_loads))]
      n = count([(is_used(model, lists%thermal_loads(k)%mode), k=1, size(lists%thermal_loads))])
      if (n == size(lists%thermal_loads)) then
         call move_alloc(lists%thermal_loads, model%thermal_loads)
         return
      end if
      if (allocated(model%thermal_loads)) deallocate (model%thermal_loads)
      allocate (model%thermal_loads(n))
      n = 0
      do k = 1, size(lists%thermal_loads)
         associate (load => lists%thermal_loads(k))
            if (is_used(model, load%mode)) then
               n = n + 1
               model%thermal_loads(n)%mode = load%mode
               model%thermal_loads(n)%case = load%case
               model%thermal_loads(n)%body = load%body
               call move_alloc(load%temperature, model%thermal_loads(n)%temperature)
            else if (largest(k) > little*maxval(largest, mask=lists%thermal_loads%case == load%case)) then
               call note(model, load%mode, load%case)
            end if
         end associate
      end do
   end subroutine take_temperatures

   !> What a sum of loads may leave to be nothing, over their sizes: rounding where it would act, little where it does not
   pure real(wp) function to_nothing(model, mode)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode

      to_nothing = merge(rounding, little, is_used(model, mode))
   end function to_nothing

   !> Whether the harmonic of a mode is in use
   pure logical function is_used(model, mode)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode

      is_used = .true.
      if (size(model%harmonics) <= model%max_harmonic) is_used = any(model%harmonics == mode%harmonic)
   end function is_used

   !> Note a harmonic in which loads have a part, though it is not in use
   pure subroutine note(model, mode, case)
      !> The job
      type(model_type), intent(inout) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Load case
      integer, intent(in) :: case

      if (any(model%left_out%harmonic == mode%harmonic .and. model%left_out%case == case)) return
      model%left_out = [model%left_out, left_out_type(mode%harmonic, case)]
   end subroutine note

   !> Which loads of the same place and mode come to nothing but rounding together, as equal ones at equal angles in most harmonics:
   !> what is left of them would need restraints of its own
   pure function cancel_each_other(left, keys, values) result(cancel)
      !> What a sum may leave to be nothing, over the sizes of what is summed, shape (loads)
      real(wp), intent(in) :: left(:)
      !> Case, mode and place of each load, shape (keys, loads), and its components, shape (components, loads)
      integer, intent(in) :: keys(:, :)
      real(wp), intent(in) :: values(:, :)
      !> Which do, shape (loads)
      logical :: cancel(size(keys, 2))

      integer :: order(size(keys, 2)), first, last

      order = lexical_order(real(keys, wp))
      cancel = .false.
      first = 1
      do while (first <= size(order))
         last = first
         do while (last < size(order))
            if (any(keys(:, order(last + 1)) /= keys(:, order(first)))) exit
            last = last + 1
         end do
         associate (these => values(:, order(first:last)))
            cancel(order(first:last)) = last > first .and. all(abs(sum(these, 2)) <= left(order(first))*sum(abs(these), 2))
         end associate
         first = last + 1
      end do
   end function cancel_each_other

end module axijoint_deck_load_lists
