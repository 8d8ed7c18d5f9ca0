!> Sides of elements of Abaqus and CalculiX: which of two surfaces lie on each other, node on node, how long and deep they are
module axijoint_legacy_abaqus_sides
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_deck_mesh_places, only : point_tree_type, new_point_tree, points_near
   use axijoint_fe_shape, only : n_corners
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, side_nodes, n_side_nodes, number_at
   implicit none
   private
   public :: match_type, match_sides, nodes_of, length_of, depth_of

   !> Candidates for a side to lie on
   integer, parameter :: most_near = 16

   !> Two sides that lie on each other
   type :: match_type
      !> Elements (indices) and sides of the first and of the second surface
      integer :: element(2) = 0, side(2) = 0
      !> Whether the second side runs as the first one does
      logical :: alike = .false.
   end type match_type

contains

   !> Sides of one surface and those of another that lie on them
   subroutine match_sides(mesh, surfaces, distance, matches, farthest)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The surfaces
      integer, intent(in) :: surfaces(2)
      !> Distance of nodes at one place, in lengths of the side
      real(wp), intent(in) :: distance
      !> Takes the pairs of sides
      type(match_type), allocatable, intent(out) :: matches(:)
      !> Largest distance of their nodes
      real(wp), intent(out), optional :: farthest

      type(point_tree_type) :: tree
      type(match_type) :: match
      real(wp) :: length, gap
      integer :: i, k, n, n_near, near(most_near)

      associate (a => mesh%surfaces(surfaces(1)), b => mesh%surfaces(surfaces(2)))
         allocate (matches(a%elements%n))
         n = 0
         if (present(farthest)) farthest = 0.0_wp
         tree = new_point_tree(reshape([(middle(b%elements%value(k), b%sides%value(k)), k=1, b%elements%n)], [2, b%elements%n]))
         do i = 1, a%elements%n
            match%element(1) = a%elements%value(i)
            match%side(1) = a%sides%value(i)
            length = length_of(mesh, match%element(1), match%side(1))
            call points_near(tree, middle(match%element(1), match%side(1)), distance*length, near, n_near)
            do k = 1, n_near
               match%element(2) = b%elements%value(near(k))
               match%side(2) = b%sides%value(near(k))
               call compare(mesh, match, gap)
               if (gap > distance*length) cycle
               n = n + 1
               matches(n) = match
               if (present(farthest)) farthest = max(farthest, gap)
               exit
            end do
         end do
      end associate
      matches = matches(:n)

   contains

      !> Middle between the corners of a side
      function middle(element, side)
         !> They
         integer, intent(in) :: element, side
         real(wp) :: middle(2)

         integer, allocatable :: nodes(:)

         nodes = indices_of(mesh, element, side)
         middle = 0.5_wp*(mesh%position(:, nodes(1)) + mesh%position(:, nodes(2)))
      end function middle

   end subroutine match_sides

   !> How far nodes of two sides are from each other; as good as infinite if one has more than the other
   subroutine compare(mesh, match, gap)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The sides; takes whether they run alike
      type(match_type), intent(inout) :: match
      !> Largest distance of two of their nodes
      real(wp), intent(out) :: gap

      integer, allocatable :: first(:), second(:), nodes(:, :)
      integer :: i

      gap = huge(1.0_wp)
      first = indices_of(mesh, match%element(1), match%side(1))
      second = indices_of(mesh, match%element(2), match%side(2))
      if (size(first) /= size(second)) return
      match%alike = distance_of(first(1), second(1)) < distance_of(first(1), second(2))
      nodes = nodes_of(mesh, match)
      gap = maxval([(distance_of(nodes(i, 1), nodes(i, 2)), i=1, size(first))])

   contains

      !> Distance of two nodes
      pure real(wp) function distance_of(p, q)
         !> Their indices
         integer, intent(in) :: p, q

         distance_of = norm2(mesh%position(:, p) - mesh%position(:, q))
      end function distance_of

   end subroutine compare

   !> Nodes of a side (indices): two corners in the order of the element, and the node between them of quadratic elements
   function indices_of(mesh, element, side) result(nodes)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Element (index) and side
      integer, intent(in) :: element, side
      !> Their indices
      integer, allocatable :: nodes(:)

      integer :: i

      nodes = side_nodes(mesh, element, side)
      do i = 1, size(nodes)
         nodes(i) = find_number(mesh%node_map, nodes(i))
      end do
   end function indices_of

   !> Nodes of two sides that lie on each other, in the order of the first one
   function nodes_of(mesh, match) result(nodes)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The sides
      type(match_type), intent(in) :: match
      !> Indices, shape (nodes, 2)
      integer, allocatable :: nodes(:, :)

      allocate (nodes(n_side_nodes(mesh, match%element(1)), 2))
      nodes(:, 1) = indices_of(mesh, match%element(1), match%side(1))
      nodes(:, 2) = indices_of(mesh, match%element(2), match%side(2))
      if (.not. match%alike) nodes(:2, 2) = nodes([2, 1], 2)
   end function nodes_of

   !> Length of a side, between its corners
   real(wp) function length_of(mesh, element, side) result(length)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Element (index) and side
      integer, intent(in) :: element, side

      integer, allocatable :: nodes(:)

      nodes = indices_of(mesh, element, side)
      length = norm2(mesh%position(:, nodes(2)) - mesh%position(:, nodes(1)))
   end function length_of

   !> What an element has behind a side: the largest distance of a corner from it
   real(wp) function depth_of(mesh, element, side) result(depth)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Element (index) and side
      integer, intent(in) :: element, side

      real(wp) :: along(2), to(2)
      integer, allocatable :: nodes(:)
      integer :: i

      nodes = indices_of(mesh, element, side)
      along = mesh%position(:, nodes(2)) - mesh%position(:, nodes(1))
      depth = 0.0_wp
      do i = 1, n_corners(mesh%size(element))
         to = mesh%position(:, find_number(mesh%node_map, number_at(mesh, mesh%nodes(i, element)))) - mesh%position(:, nodes(1))
         depth = max(depth, abs(along(1)*to(2) - along(2)*to(1))/norm2(along))
      end do
   end function depth_of

end module axijoint_legacy_abaqus_sides
