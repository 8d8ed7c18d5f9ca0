!> Which elements lie at a node, and which on the other side of an edge
module axijoint_model_neighbours
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements
   implicit none
   private
   public :: neighbours_type, new_neighbours, element_at_edge

   !> Elements by their corner nodes
   type :: neighbours_type
      private
      !> Elements with the corner i are listed from start(i) to start(i + 1) - 1
      integer, allocatable :: start(:), list(:)
   end type neighbours_type

contains

   !> List the elements at each node
   pure function new_neighbours(mesh) result(neighbours)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The lists
      type(neighbours_type) :: neighbours

      integer, allocatable :: next(:)
      integer :: element, k, node

      allocate (neighbours%start(n_nodes(mesh) + 1), source=0)
      associate (start => neighbours%start)
         do element = 1, n_elements(mesh)
            do k = 1, n_corners(mesh%element_size(element))
               node = mesh%element_nodes(k, element)
               start(node + 1) = start(node + 1) + 1
            end do
         end do
         start(1) = 1
         do node = 1, n_nodes(mesh)
            start(node + 1) = start(node + 1) + start(node)
         end do
         next = start
         allocate (neighbours%list(start(size(start)) - 1))
      end associate
      do element = 1, n_elements(mesh)
         do k = 1, n_corners(mesh%element_size(element))
            node = mesh%element_nodes(k, element)
            neighbours%list(next(node)) = element
            next(node) = next(node) + 1
         end do
      end do
   end function new_neighbours

   !> An element that has the edge between two corner nodes; 0 if there is none but the one
   !> that is left out
   pure integer function element_at_edge(mesh, neighbours, a, b, but) result(element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Its elements by nodes
      type(neighbours_type), intent(in) :: neighbours
      !> The nodes
      integer, intent(in) :: a, b
      !> Element to leave out
      integer, intent(in), optional :: but

      integer :: k, left_out

      left_out = 0
      if (present(but)) left_out = but
      do k = neighbours%start(a), neighbours%start(a + 1) - 1
         element = neighbours%list(k)
         if (element == left_out) cycle
         if (any(mesh%element_nodes(:n_corners(mesh%element_size(element)), element) == b)) return
      end do
      element = 0
   end function element_at_edge

end module axijoint_model_neighbours
