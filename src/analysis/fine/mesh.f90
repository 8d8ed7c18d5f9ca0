!> A mesh with every element cut into four and every joint into two, and how the displacements of
!> the coarse mesh look on it
module axijoint_analysis_fine_mesh
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : n_corners, shape_line
   use axijoint_fe_subdivision, only : subdivision_type, new_subdivision, n_children
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, n_joints, max_element_nodes
   implicit none
   private
   public :: fine_mesh_type, parents_type, new_fine_mesh, ordered, find_edge, n_on, half_edges, &
      edge_shape
   public :: prolong, restrict

   !> An edge of the coarse mesh, as the first element that has it runs along it
   type :: edge_type
      !> First and last node, and the one in the middle or 0
      integer :: nodes(3) = 0
      !> Elements that have it, the second of which may be 0
      integer :: elements(2) = 0
      !> New nodes: in the middle, or at one and three quarters
      integer :: new(2) = 0
   end type edge_type

   !> Nodes of the coarse mesh that each fine node follows
   type :: parents_type
      !> Those of a node are listed from start(node) to start(node + 1) - 1
      integer, allocatable :: start(:), node(:)
      !> Their weights
      real(wp), allocatable :: weight(:)
   end type parents_type

   !> The fine mesh. Its first nodes are those of the coarse mesh; element k becomes the elements
   !> 4 k - 3 to 4 k, joint k the joints 2 k - 1 and 2 k
   type :: fine_mesh_type
      !> Nodes, elements, joints
      type(mesh_type) :: mesh
      !> Edges of the coarse mesh
      type(edge_type), allocatable :: edges(:)
      !> Edges of each coarse element, shape (4, elements)
      integer, allocatable :: element_edges(:, :)
      !> First of the new nodes inside each coarse element, shape (elements + 1)
      integer, allocatable :: inside(:)
      !> What the fine nodes follow
      type(parents_type) :: parents
      !> Edges by the lesser of their end nodes: the first, and the next after each
      integer, allocatable, private :: first_edge(:), next_edge(:)
   end type fine_mesh_type

contains

   !> Cut a mesh
   subroutine new_fine_mesh(coarse, fine)
      !> The mesh
      type(mesh_type), intent(in) :: coarse
      !> The fine one
      type(fine_mesh_type), intent(out) :: fine

      type(subdivision_type) :: cuts(3:9)
      integer :: n, element

      do n = 3, 9
         if (any(coarse%element_size == n)) cuts(n) = new_subdivision(n)
      end do
      call find_edges(coarse, fine)
      n = n_nodes(coarse)
      call number_edge_nodes(fine, n)
      allocate (fine%inside(n_elements(coarse) + 1))
      do element = 1, n_elements(coarse)
         fine%inside(element) = n + 1
         associate (cut => cuts(coarse%element_size(element)))
            n = n + cut%n_places - cut%first_inside + 1
         end associate
      end do
      fine%inside(element) = n + 1
      call find_parents(coarse, cuts, n, fine)
      call place_nodes(coarse, n, fine)
      call cut_elements(coarse, cuts, fine)
      call cut_joints(coarse, fine)
   end subroutine new_fine_mesh

   !> Edges of all elements, each once
   pure subroutine find_edges(coarse, fine)
      !> The mesh
      type(mesh_type), intent(in) :: coarse
      !> Takes the edges
      type(fine_mesh_type), intent(inout) :: fine

      type(edge_type), allocatable :: edges(:)
      integer :: element, side, n, a, b, k

      allocate (edges(sum(n_corners(coarse%element_size))))
      allocate (fine%next_edge(size(edges)), source=0)
      allocate (fine%first_edge(n_nodes(coarse)), source=0)
      allocate (fine%element_edges(4, n_elements(coarse)), source=0)
      n = 0
      do element = 1, n_elements(coarse)
         associate (nodes => coarse%element_nodes(:, element), &
            corners => n_corners(coarse%element_size(element)))
            do side = 1, corners
               a = nodes(side)
               b = nodes(mod(side, corners) + 1)
               k = fine%first_edge(min(a, b))
               do while (k > 0)
                  if (all(edges(k)%nodes(:2) == [b, a]) .or. all(edges(k)%nodes(:2) == [a, b])) exit
                  k = fine%next_edge(k)
               end do
               if (k == 0) then
                  n = n + 1
                  k = n
                  edges(k)%nodes = [a, b, 0]
                  if (coarse%element_size(element) > 4) edges(k)%nodes(3) = nodes(corners + side)
                  edges(k)%elements(1) = element
                  fine%next_edge(k) = fine%first_edge(min(a, b))
                  fine%first_edge(min(a, b)) = k
               else
                  edges(k)%elements(2) = element
               end if
               fine%element_edges(side, element) = k
            end do
         end associate
      end do
      fine%edges = edges(:n)
   end subroutine find_edges

   !> Number the new nodes of the edges
   pure subroutine number_edge_nodes(fine, n)
      !> Takes the numbers
      type(fine_mesh_type), intent(inout) :: fine
      !> Nodes so far
      integer, intent(inout) :: n

      integer :: k, i

      do k = 1, size(fine%edges)
         do i = 1, n_on(fine%edges(k)) - 1
            n = n + 1
            fine%edges(k)%new(i) = n
         end do
      end do
   end subroutine number_edge_nodes

   !> Number of nodes of an edge: 2 or 3
   pure integer function n_on(edge)
      !> The edge
      type(edge_type), intent(in) :: edge

      n_on = merge(3, 2, edge%nodes(3) > 0)
   end function n_on

   !> Shape functions of an edge of n nodes at its new nodes, shape (n, n - 1)
   pure function edge_shape(n) result(shape)
      !> Nodes of the edge: 2 or 3
      integer, intent(in) :: n
      !> The values
      real(wp) :: shape(n, n - 1)

      real(wp) :: derivative(3)
      integer :: i

      do i = 1, n - 1
         call shape_line(n, i - 0.5_wp*n, shape(:, i), derivative(:n))
      end do
   end function edge_shape

   !> What each fine node follows
   subroutine find_parents(coarse, cuts, n, fine)
      !> The mesh
      type(mesh_type), intent(in) :: coarse
      !> Kinds of elements, cut
      type(subdivision_type), intent(in) :: cuts(3:)
      !> Number of fine nodes
      integer, intent(in) :: n
      !> Takes the parents
      type(fine_mesh_type), intent(inout) :: fine

      integer :: node, k, i, last

      associate (parents => fine%parents)
         allocate (parents%start(n + 1), parents%node(max_element_nodes*n), &
            parents%weight(max_element_nodes*n))
      end associate
      last = 0
      do node = 1, n_nodes(coarse)
         call follow(node, [node], [1.0_wp])
      end do
      do k = 1, size(fine%edges)
         associate (edge => fine%edges(k), shape => edge_shape(n_on(fine%edges(k))))
            do i = 1, size(shape, 2)
               call follow(edge%new(i), edge%nodes(:size(shape, 1)), shape(:, i))
            end do
         end associate
      end do
      do k = 1, n_elements(coarse)
         associate (size_of => coarse%element_size(k), &
            first => cuts(coarse%element_size(k))%first_inside)
            do node = fine%inside(k), fine%inside(k + 1) - 1
               call follow(node, coarse%element_nodes(:size_of, k), &
                           cuts(size_of)%shape(:size_of, first + node - fine%inside(k)))
            end do
         end associate
      end do
      fine%parents%start(n + 1) = last + 1
      fine%parents%node = fine%parents%node(:last)
      fine%parents%weight = fine%parents%weight(:last)

   contains

      !> Note the parents of a node
      subroutine follow(node, parents, weights)
         !> The node; they come in their order
         integer, intent(in) :: node
         !> Its parents and their weights
         integer, intent(in) :: parents(:)
         real(wp), intent(in) :: weights(:)

         fine%parents%start(node) = last + 1
         fine%parents%node(last + 1:last + size(parents)) = parents
         fine%parents%weight(last + 1:last + size(parents)) = weights
         last = last + size(parents)
      end subroutine follow

   end subroutine find_parents

   !> Coordinates and labels of the fine nodes; sides stay as curved as they are
   pure subroutine place_nodes(coarse, n, fine)
      !> The mesh
      type(mesh_type), intent(in) :: coarse
      !> Number of fine nodes
      integer, intent(in) :: n
      !> Takes the coordinates
      type(fine_mesh_type), intent(inout) :: fine

      real(wp), allocatable :: coordinates(:, :)
      integer :: k

      allocate (coordinates(2, n))
      call prolong(fine%parents, coarse%coordinates, coordinates)
      call move_alloc(coordinates, fine%mesh%coordinates)
      fine%mesh%node_label = [(k, k=1, n)]
   end subroutine place_nodes

   !> The children of all elements
   pure subroutine cut_elements(coarse, cuts, fine)
      !> The mesh
      type(mesh_type), intent(in) :: coarse
      !> Kinds of elements, cut
      type(subdivision_type), intent(in) :: cuts(3:)
      !> Takes the elements
      type(fine_mesh_type), intent(inout) :: fine

      integer :: at(25), k, c, side, n, m

      associate (mesh => fine%mesh)
         mesh%element_size = children_of(coarse%element_size)
         mesh%element_kind = children_of(coarse%element_kind)
         mesh%kinds = coarse%kinds
         mesh%element_material = children_of(coarse%element_material)
         mesh%element_body = children_of(coarse%element_body)
         mesh%element_label = children_of(coarse%element_label)
         allocate (mesh%element_nodes(max_element_nodes, n_children*n_elements(coarse)), source=0)
         do k = 1, n_elements(coarse)
            n = coarse%element_size(k)
            associate (cut => cuts(n), nodes => coarse%element_nodes(:, k))
               at(:n) = nodes(:n)
               m = n
               do side = 1, n_corners(n)
                  associate (edge => fine%edges(fine%element_edges(side, k)))
                     at(m + 1:m + cut%n_on_side) = &
                        in_sense(edge%new(:cut%n_on_side), edge%nodes(1) /= nodes(side))
                  end associate
                  m = m + cut%n_on_side
               end do
               at(m + 1:cut%n_places) = [(fine%inside(k) + c, c=0, cut%n_places - m - 1)]
               do c = 1, n_children
                  mesh%element_nodes(:n, n_children*(k - 1) + c) = at(cut%child(:n, c))
               end do
            end associate
         end do
      end associate
   end subroutine cut_elements

   !> A property of all children from that of the elements
   pure function children_of(values) result(all)
      !> One an element
      integer, intent(in) :: values(:)
      !> One a child
      integer :: all(n_children*size(values))

      all = reshape(spread(values, 1, n_children), [n_children*size(values)])
   end function children_of

   !> Nodes in their order, or in the opposite one
   pure function in_sense(nodes, backwards)
      !> The nodes
      integer, intent(in) :: nodes(:)
      !> Whether to turn them round
      logical, intent(in) :: backwards
      !> In the order wanted
      integer :: in_sense(size(nodes))

      in_sense = nodes
      if (backwards) in_sense = nodes(size(nodes):1:-1)
   end function in_sense

   !> The edge between two nodes
   pure integer function find_edge(fine, a, b) result(edge)
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> The nodes
      integer, intent(in) :: a, b

      edge = fine%first_edge(min(a, b))
      do while (maxval(fine%edges(edge)%nodes(:2)) /= max(a, b))
         edge = fine%next_edge(edge)
      end do
   end function find_edge

   !> First, last and middle node (or 0) of the two halves of an edge from a to b, shape (3, 2)
   pure function half_edges(fine, a, b) result(halves)
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Ends of the edge
      integer, intent(in) :: a, b
      !> Nodes of the halves
      integer :: halves(3, 2)

      associate (edge => fine%edges(find_edge(fine, a, b)))
         if (edge%nodes(3) == 0) then
            halves = reshape([a, edge%new(1), 0, edge%new(1), b, 0], [3, 2])
         else
            associate (new => in_sense(edge%new, edge%nodes(1) /= a), middle => edge%nodes(3))
               halves = reshape([a, middle, new(1), middle, b, new(2)], [3, 2])
            end associate
         end if
      end associate
   end function half_edges

   !> The halves of all joints
   pure subroutine cut_joints(coarse, fine)
      !> The mesh
      type(mesh_type), intent(in) :: coarse
      !> Takes the joints
      type(fine_mesh_type), intent(inout) :: fine

      integer :: lower(3, 2), upper(3, 2), k, c

      associate (mesh => fine%mesh, n => n_joints(coarse))
         allocate (mesh%joint_label(2*n), mesh%joint_material(2*n), mesh%joint_size(2*n), &
            mesh%joint_nodes(6, 2*n), mesh%joint_interface(2*n))
         do k = 1, n
            associate (nodes => coarse%joint_nodes(:, k))
               lower = half_edges(fine, nodes(1), nodes(2))
               upper = half_edges(fine, nodes(4), nodes(3))
            end associate
            do c = 1, 2
               mesh%joint_label(2*k - 2 + c) = coarse%joint_label(k)
               mesh%joint_material(2*k - 2 + c) = coarse%joint_material(k)
               mesh%joint_interface(2*k - 2 + c) = coarse%joint_interface(k)
               mesh%joint_size(2*k - 2 + c) = coarse%joint_size(k)
               mesh%joint_nodes(:, 2*k - 2 + c) = &
                  [lower(1, c), lower(2, c), upper(2, c), upper(1, c), &
                                                   lower(3, c), upper(3, c)]
            end do
         end do
      end associate
   end subroutine cut_joints

   !> The parents of nodes in another order
   pure function ordered(parents, order) result(other)
      !> Parents of all nodes
      type(parents_type), intent(in) :: parents
      !> order(k) is the k-th node
      integer, intent(in) :: order(:)
      !> The parents of the k-th node at k
      type(parents_type) :: other

      integer :: k, n, last

      allocate (other%start(size(order) + 1))
      allocate (other%node, mold=parents%node)
      allocate (other%weight, mold=parents%weight)
      last = 0
      do k = 1, size(order)
         other%start(k) = last + 1
         associate (from => parents%start(order(k)))
            n = parents%start(order(k) + 1) - from
            other%node(last + 1:last + n) = parents%node(from:from + n - 1)
            other%weight(last + 1:last + n) = parents%weight(from:from + n - 1)
         end associate
         last = last + n
      end do
      other%start(k) = last + 1
   end function ordered

   !> Values at all fine nodes from those at the coarse ones
   pure subroutine prolong(parents, coarse_values, values)
      !> What the fine nodes follow
      type(parents_type), intent(in) :: parents
      !> Values at the coarse nodes, shape (any, nodes)
      real(wp), intent(in) :: coarse_values(:, :)
      !> Values at the fine nodes, shape (any, nodes)
      real(wp), intent(out) :: values(:, :)

      integer :: node, k

      if (size(values, 1) == 3) then
         call prolong_vectors(parents, coarse_values, values)
         return
      end if
      values = 0.0_wp
      do node = 1, size(values, 2)
         do k = parents%start(node), parents%start(node + 1) - 1
            values(:, node) = values(:, node) + parents%weight(k)*coarse_values(:, parents%node(k))
         end do
      end do
   end subroutine prolong

   !> The same for vectors, which it is most often asked for: a fixed number of components is added at once
   pure subroutine prolong_vectors(parents, coarse_values, values)
      !> What the fine nodes follow
      type(parents_type), intent(in) :: parents
      !> Vectors at the coarse nodes, shape (3, nodes)
      real(wp), intent(in) :: coarse_values(:, :)
      !> Vectors at the fine nodes, shape (3, nodes)
      real(wp), intent(out) :: values(:, :)

      real(wp) :: total(3)
      integer :: node, k

      do node = 1, size(parents%start) - 1
         total = 0.0_wp
         do k = parents%start(node), parents%start(node + 1) - 1
            total = total + parents%weight(k)*coarse_values(:3, parents%node(k))
         end do
         values(:3, node) = total
      end do
   end subroutine prolong_vectors

   !> Forces at the coarse nodes that do the same work as those at the fine ones
   pure subroutine restrict(parents, forces, coarse_forces)
      !> What the fine nodes follow
      type(parents_type), intent(in) :: parents
      !> Forces at the fine nodes, shape (3, nodes)
      real(wp), intent(in) :: forces(:, :)
      !> Forces at the coarse nodes, shape (3, nodes)
      real(wp), intent(out) :: coarse_forces(:, :)

      real(wp) :: force(3)
      integer :: node, k

      coarse_forces = 0.0_wp
      do node = 1, size(forces, 2)
         force = forces(:3, node)
         do k = parents%start(node), parents%start(node + 1) - 1
            associate (parent => parents%node(k))
               coarse_forces(:3, parent) = coarse_forces(:3, parent) + parents%weight(k)*force
            end associate
         end do
      end do
   end subroutine restrict

end module axijoint_analysis_fine_mesh
