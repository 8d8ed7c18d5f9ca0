!> Levels of neighbourhood, and the two ends of a graph
module axijoint_order_levels
   use axijoint_order_graph, only : graph_type, degree
   implicit none
   private
   public :: breadth_first, find_ends

contains

   !> Distance of the nodes of a component from one of them
   subroutine breadth_first(graph, root, level, list, n_list)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Node to start from
      integer, intent(in) :: root
      !> Distance of each node; negative on entry for the nodes of the component
      integer, intent(inout) :: level(:)
      !> Nodes of the component by distance, the first n_list
      integer, intent(inout) :: list(:)
      !> Number of nodes of the component
      integer, intent(out) :: n_list

      integer :: head, node, k

      n_list = 1
      list(1) = root
      level(root) = 0
      head = 1
      do while (head <= n_list)
         node = list(head)
         do k = graph%start(node), graph%start(node + 1) - 1
            associate (next => graph%neighbour(k))
               if (level(next) >= 0) cycle
               level(next) = level(node) + 1
               n_list = n_list + 1
               list(n_list) = next
            end associate
         end do
         head = head + 1
      end do
   end subroutine breadth_first

   !> Two nodes at the ends of a long path through a component: go on to a node
   !> of least degree in the last level as long as that adds levels (George and
   !> Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981)
   subroutine find_ends(graph, seed, level, list, start, finish)
      !> Graph of the nodes
      type(graph_type), intent(in) :: graph
      !> Any node of the component
      integer, intent(in) :: seed
      !> Negative for the nodes of the component, on entry and on return
      integer, intent(inout) :: level(:)
      !> Room for as many nodes as the graph has: one may have many components
      integer, intent(inout) :: list(:)
      !> The ends
      integer, intent(out) :: start, finish

      integer :: depth, next_depth, next

      start = seed
      call last_level(start, depth, finish)
      do
         call last_level(finish, next_depth, next)
         if (next_depth <= depth) exit
         start = finish
         depth = next_depth
         finish = next
      end do

   contains

      !> Depth of the levels from a root, and a node of least degree in the last
      subroutine last_level(root, depth_found, farthest)
         !> Node to start from
         integer, intent(in) :: root
         !> Number of the last level
         integer, intent(out) :: depth_found
         !> The node
         integer, intent(out) :: farthest

         integer :: n_list, k

         call breadth_first(graph, root, level, list, n_list)
         farthest = list(n_list)
         depth_found = level(farthest)
         do k = n_list - 1, 1, -1
            if (level(list(k)) < depth_found) exit
            if (degree(graph, list(k)) < degree(graph, farthest)) farthest = list(k)
         end do
         level(list(:n_list)) = -1
      end subroutine last_level

   end subroutine find_ends

end module axijoint_order_levels
