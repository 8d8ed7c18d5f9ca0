!> Stiffness of all harmonics that is multiplied and never factored: element by element where elements are congruent, in
!> blocks of two nodes where they are not, and of joints and springs
module axijoint_assembly_product_stiffness
   use omp_lib, only : omp_get_max_threads, omp_get_num_threads, omp_in_parallel
   use axijoint_assembly_block_parts, only : block_size
   use axijoint_assembly_congruent_elements, only : congruent_type, new_congruent, reserve_parts, integrate_shapes, add_products
   use axijoint_assembly_node_blocks, only : node_blocks_type, new_node_blocks, clear_blocks, assemble_rows, block_product
   use axijoint_assembly_repeated_elements, only : shapes_type, find_shapes, number_alike
   use axijoint_assembly_stiffness, only : least_elements
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_ranges, only : range_end
   use axijoint_base_team, only : team_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements
   use axijoint_model_model, only : model_type
   use axijoint_order_graph, only : graph_type, new_graph
   implicit none
   private
   public :: product_stiffness_type, new_product_stiffness, is_formed, n_numbers, form_product_stiffness, tell_product_stiffness, &
      stiffness_product

   !> The stiffness
   type :: product_stiffness_type
      !> Row of each node
      integer, allocatable :: place(:)
      !> Elements that are congruent to others
      type(congruent_type) :: congruent
      !> The other elements, and the blocks of these, of joints and springs
      integer, allocatable :: single(:)
      type(node_blocks_type) :: blocks
   end type product_stiffness_type

contains

   !> Order of the rows, and who is where
   subroutine new_product_stiffness(mesh, support_points, order, cluster, stiffness)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Points of all springs
      type(support_point_type), intent(in) :: support_points(:)
      !> order(k) is the node of row k
      integer, intent(in) :: order(:)
      !> Cluster of each node; nodes of one follow each other in the order
      integer, intent(in) :: cluster(:)
      !> The stiffness, without numbers
      type(product_stiffness_type), intent(out) :: stiffness

      type(shapes_type) :: shapes
      logical :: congruent(n_elements(mesh))
      integer :: k

      allocate (stiffness%place(size(order)))
      stiffness%place(order) = [(k, k=1, size(order))]
      call find_shapes(mesh, shapes)
      congruent = number_alike(shapes) > 1
      call new_congruent(mesh, shapes, congruent, stiffness%place, stiffness%congruent)
      stiffness%single = pack([(k, k=1, size(congruent))], .not. congruent)
      call new_node_blocks(stiffness%blocks, graph_of_singles(mesh, stiffness%single, support_points), order, &
         stiffness%place, cluster)
   end subroutine new_product_stiffness

   !> Graph of nodes that share an element which is like no other, a joint or a spring
   function graph_of_singles(mesh, single, support_points) result(graph)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The elements
      integer, intent(in) :: single(:)
      !> Points of all springs
      type(support_point_type), intent(in) :: support_points(:)
      !> The graph
      type(graph_type) :: graph

      integer :: start(1 + size(single) + size(mesh%joint_size) + size(support_points)), k, n
      integer, allocatable :: member(:)

      allocate (member(sum(mesh%element_size(single)) + sum(mesh%joint_size) + sum(support_points%n_pairs)))
      start(1) = 1
      n = 1
      do k = 1, size(single)
         call add_clique(mesh%element_nodes(:mesh%element_size(single(k)), single(k)))
      end do
      do k = 1, size(mesh%joint_size)
         call add_clique(mesh%joint_nodes(:mesh%joint_size(k), k))
      end do
      do k = 1, size(support_points)
         call add_clique(support_points(k)%nodes(:support_points(k)%n_pairs))
      end do
      call new_graph(graph, n_nodes(mesh), start, member)

   contains

      !> Add nodes that are all coupled
      subroutine add_clique(nodes)
         !> The nodes
         integer, intent(in) :: nodes(:)

         member(start(n):start(n) + size(nodes) - 1) = nodes
         start(n + 1) = start(n) + size(nodes)
         n = n + 1
      end subroutine add_clique

   end function graph_of_singles

   !> Whether its numbers are there
   pure logical function is_formed(stiffness)
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness

      is_formed = allocated(stiffness%blocks%parts)
   end function is_formed

   !> Numbers that it has once it is formed
   pure integer(i8) function n_numbers(stiffness)
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness

      associate (before_shape => stiffness%congruent%before_shape)
         n_numbers = block_size*(size(stiffness%blocks%column, kind=i8) + before_shape(size(before_shape)))
      end associate
   end function n_numbers

   !> Integrate all elements, joints and springs. Threads take shapes and rows of their own, so that no sum depends on
   !> their number
   subroutine form_product_stiffness(model, joint_points, support_points, stiffness)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: support_points(:)
      !> The stiffness
      type(product_stiffness_type), intent(inout) :: stiffness

      integer :: n_shares

      call clear_blocks(stiffness%blocks)
      call reserve_parts(stiffness%congruent)
      n_shares = 1
      if (n_elements(model%mesh) > least_elements) &
         n_shares = merge(omp_get_num_threads(), omp_get_max_threads(), omp_in_parallel())
      if (omp_in_parallel()) then  ! others of the team may have nothing else to do
         call share()
         return
      end if
      !$omp parallel if (n_shares > 1)
      !$omp single
      call share()
      !$omp end single
      !$omp end parallel

   contains

      !> Form all of it, in shares
      subroutine share()
         integer :: k

         do k = 1, n_shares
            !$omp task default(shared) firstprivate(k) if (n_shares > 1)
            associate (n => size(stiffness%place), m => size(stiffness%congruent%sample))
               call assemble_rows(stiffness%blocks, stiffness%place, model, stiffness%single, joint_points, support_points, &
                  1 + range_end(n, k - 1, n_shares), range_end(n, k, n_shares))
               call integrate_shapes(model, 1 + range_end(m, k - 1, n_shares), range_end(m, k, n_shares), stiffness%congruent)
            end associate
            !$omp end task
         end do
         !$omp taskwait
      end subroutine share

   end subroutine form_product_stiffness

   !> Let all ranks know the numbers that one has found
   subroutine tell_product_stiffness(team, rank, stiffness)
      !> The ranks
      class(team_type), intent(in) :: team
      !> The one
      integer, intent(in) :: rank
      !> The stiffness
      type(product_stiffness_type), intent(inout) :: stiffness

      if (.not. is_formed(stiffness)) then
         call clear_blocks(stiffness%blocks)
         call reserve_parts(stiffness%congruent)
      end if
      call team%broadcast(stiffness%blocks%parts, size(stiffness%blocks%parts, kind=i8), rank)
      call team%broadcast(stiffness%congruent%parts, size(stiffness%congruent%parts, kind=i8), rank)
   end subroutine tell_product_stiffness

   !> y = K_m x, in the order of the rows; threads share it that have nothing else to do
   subroutine stiffness_product(stiffness, harmonic, x, y, at_once)
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> x, shape (3, nodes)
      real(wp), intent(in), contiguous :: x(:, :)
      !> y, same shape
      real(wp), intent(out), contiguous :: y(:, :)
      !> Numbers that are taken at once at most; as many as the processor takes if absent
      integer, intent(in), optional :: at_once

      integer :: most

      most = huge(most)
      if (present(at_once)) most = at_once
      call block_product(stiffness%blocks, harmonic, x, y, most)
      call add_products(stiffness%congruent, harmonic, x, y, most)
   end subroutine stiffness_product

end module axijoint_assembly_product_stiffness
