!> Edges of the mesh file that two bodies share: joints must lie there
module axijoint_deck_gmsh_shared
   use axijoint_base_sort, only : refine_order
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_gmsh_import, only : gmsh_import_type, use_joint
   use axijoint_deck_mesh_draft, only : place_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_table, only : table_type, entry_error
   use axijoint_fe_shape, only : n_corners
   use axijoint_gmsh_mesh, only : nodes_of_type, dimension_of_type
   implicit none
   private
   public :: check_shared

   !> Edges whose ends belong to several bodies
   type :: shared_edges_type
      !> Number of them
      integer :: n = 0
      !> Lesser and larger node of the file, and BODY card (place among the uses) of the element;
      !> 0 for a line of a JOINT
      integer, allocatable :: nodes(:, :), use(:)
   end type shared_edges_type

contains

   !> Report bodies that share edges without joints
   subroutine check_shared(table, import, use_of, diagnostics)
      !> GROUPS
      type(table_type), intent(in) :: table
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> BODY card of each element; 0 for none
      integer, intent(in) :: use_of(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(shared_edges_type) :: edges
      integer, allocatable :: order(:), pairs(:, :)
      integer :: i, k, first

      if (import%n_copies == 0) return
      call collect(import, use_of, edges)
      order = [(i, i=1, edges%n)]
      call refine_order(order, edges%use(:edges%n))
      call refine_order(order, edges%nodes(2, :edges%n))
      call refine_order(order, edges%nodes(1, :edges%n))
      allocate (pairs(4, 0))
      first = 1
      do i = 2, edges%n
         if (any(edges%nodes(:, order(i)) /= edges%nodes(:, order(first)))) first = i
         ! The line of a joint comes first among equal edges.
         if (i == first .or. edges%use(order(first)) == 0) cycle
         call count_pair(import, edges%use(order([i - 1, i])), edges%nodes(1, order(i)), pairs)
      end do
      do k = 1, size(pairs, 2)
         associate (a => import%uses(pairs(1, k)), b => import%uses(pairs(2, k)))
            call entry_error(diagnostics, table, b%entry, &
                             'bodies '//to_text(min(a%number, b%number))//' and '// &
                             to_text(max(a%number, b%number))//' share '// &
                             count_of(pairs(3, k), 'edge')// &
                             ' of the mesh file where no joint lies', &
                             found='one at '//place_text(import%mesh%position(:2, pairs(4, k))), &
                             allowed='bodies that share nodes only along the curves of a JOINT', &
                             mend='name the curve on a JOINT card, or give both groups one body')
         end associate
      end do
   end subroutine check_shared

   !> Collect edges of elements and lines of joints between nodes of several bodies
   subroutine collect(import, use_of, edges)
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> BODY card of each element; 0 for none
      integer, intent(in) :: use_of(:)
      !> The edges
      type(shared_edges_type), intent(out) :: edges

      logical, allocatable :: joint_set(:)
      integer :: element, side, n, use, set

      associate (mesh => import%mesh)
         allocate (edges%nodes(2, 64), edges%use(64), source=0)
         allocate (joint_set(0:size(mesh%sets)), source=.false.)
         do use = 1, size(import%uses)
            if (import%uses(use)%kind /= use_joint) cycle
            do set = 1, size(mesh%sets)
               if (any(abs(mesh%sets(set)%groups) == import%uses(use)%group)) &
                  joint_set(set) = .true.
            end do
         end do
         do element = 1, mesh%n_elements
            associate (nodes => mesh%element_nodes(:, element))
               if (dimension_of_type(mesh%element_type(element)) == 1) then
                  if (joint_set(mesh%element_set(element))) call add(nodes(1:2), 0)
               else if (use_of(element) > 0) then
                  n = n_corners(nodes_of_type(mesh%element_type(element)))
                  do side = 1, n
                     call add([nodes(side), nodes(mod(side, n) + 1)], use_of(element))
                  end do
               end if
            end associate
         end do
      end associate

   contains

      !> Add an edge if both its ends belong to several bodies
      subroutine add(nodes, use)
         !> Its ends, and the BODY card or 0
         integer, intent(in) :: nodes(2), use

         integer :: room

         if (any(import%first_copy(nodes) == 0)) return
         room = size(edges%use)
         if (edges%n == room) then
            edges%nodes = reshape(edges%nodes, [2, 2*room], pad=[0])
            edges%use = reshape(edges%use, [2*room], pad=[0])
         end if
         edges%n = edges%n + 1
         edges%nodes(:, edges%n) = [minval(nodes), maxval(nodes)]
         edges%use(edges%n) = use
      end subroutine add
   end subroutine collect

   !> Count an edge of two bodies
   pure subroutine count_pair(import, uses, node, pairs)
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> BODY cards of the elements on both sides, ascending
      integer, intent(in) :: uses(2)
      !> A node of the edge
      integer, intent(in) :: node
      !> BODY cards, number of edges, first node; shape (4, pairs)
      integer, allocatable, intent(inout) :: pairs(:, :)

      integer :: k

      if (import%uses(uses(1))%number == import%uses(uses(2))%number) return
      do k = 1, size(pairs, 2)
         if (all(pairs(:2, k) == uses)) exit
      end do
      if (k > size(pairs, 2)) pairs = reshape([pairs, uses, 0, node], [4, k])
      pairs(3, k) = pairs(3, k) + 1
   end subroutine count_pair

end module axijoint_deck_gmsh_shared
