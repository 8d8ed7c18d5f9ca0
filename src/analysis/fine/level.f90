!> The job on the fine mesh, as far as estimates of errors need it: stiffness and blocks, no factor
module axijoint_analysis_fine_level
   use axijoint_analysis_fine_block_groups, only : block_groups_type, new_blocks_in_order, group_blocks
   use axijoint_analysis_fine_blocks, only : new_blocks, graph_of_blocks, order_by_blocks
   use axijoint_analysis_fine_conditions, only : conditions_type, new_conditions
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, parents_type, new_fine_mesh, ordered
   use axijoint_analysis_fine_model, only : new_fine_model
   use axijoint_analysis_fine_walls, only : walls_type, find_walls
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_loading, only : loading_type, new_initial_state
   use axijoint_assembly_product_stiffness, only : product_stiffness_type, new_product_stiffness, is_formed, n_numbers, &
      form_product_stiffness, tell_product_stiffness
   use axijoint_assembly_solid_force, only : initial_state_type
   use axijoint_assembly_support, only : support_point_type, new_support_points
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_team, only : team_type
   use axijoint_element_joint, only : new_joint_point, lower_node
   use axijoint_fe_mode, only : mode_type
   use axijoint_fe_shape, only : lagrange
   use axijoint_fe_subdivision, only : n_children
   use axijoint_linalg_lapack, only : dpbtrf, dpbtrs
   use axijoint_model_joint_points, only : model_joint_point_type, new_joint_points, joint_rule, stiffest_sliding
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements
   use axijoint_model_model, only : model_type
   use axijoint_order_graph, only : graph_type
   implicit none
   private
   public :: most_fine
   public :: fine_level_type, fine_load_type, lay_out_level, is_laid_out, bytes_to_come, form_stiffness, form_by_one, &
      take_conditions, take_fine_model, new_fine_load
   public :: share_stiffness

   !> Points of the halves of a joint at most
   integer, parameter :: most_fine = 6

   !> The fine level
   type :: fine_level_type
      !> The job on the fine mesh
      type(model_type) :: model
      !> The fine mesh and what its nodes follow
      type(fine_mesh_type) :: mesh
      !> Points of its joints and springs
      type(model_joint_point_type), allocatable :: joint_points(:)
      type(support_point_type), allocatable :: support_points(:)
      !> The same joint points in the joints of the coarse mesh, and the joint points of the coarse
      !> mesh in the fine joints, with their weights
      type(model_joint_point_type), allocatable :: on_coarse(:), coarse_points(:)
      !> What a joint of the coarse mesh has at each of its points of the jumps at the points of the fine joints: the polynomial
      !> through these that is nearest to them, so that where a joint slides or opens as a whole, which changes its stress by as
      !> much along it all, that does the same work on the motions of the coarse mesh. First fine point, zero where a joint is
      !> too stiff to move, shape (points); factors of it and those that follow, shape (most_fine, points)
      integer, allocatable :: first_fine(:)
      real(wp), allocatable :: of_fine(:, :)
      !> Stiffness; all that follows is in the order of its rows
      type(product_stiffness_type) :: stiffness
      !> The rank that has formed it, if the others are still to be told
      integer, allocatable :: formed_by
      !> What the nodes follow
      type(parents_type) :: parents
      !> Which components are free in each class of modes
      type(conditions_type), allocatable :: conditions(:)
      !> Whether there are walls whose bending it sees in part, or at whose edges it sees none
      logical :: bends_unseen = .false., edges_unseen = .false.
      !> Whether elements there see a part of how stress changes
      logical :: stress_in_part = .false.
      !> Blocks of nodes
      type(block_groups_type) :: blocks
      !> Fine nodes of elements whose stresses count in results along lines
      integer, allocatable :: near_lines(:)
      !> Time that all this took, over the threads that worked at once [second]
      real(wp) :: seconds = 0.0_wp
   end type fine_level_type

   !> Loads of a combination, as far as the fine level needs them beforehand
   type :: fine_load_type
      !> Factor of each load case
      real(wp), allocatable :: case_factor(:)
      !> Stress of the solids without strain
      type(initial_state_type) :: initial
   end type fine_load_type

contains

   !> Cut the mesh of a job, and find the pattern of its stiffness and the blocks; nothing is integrated yet
   subroutine lay_out_level(model, level)
      !> The job
      type(model_type), intent(in) :: model
      !> The fine level; what is free in the classes of modes is for `take_conditions`
      type(fine_level_type), intent(out) :: level

      type(walls_type) :: walls
      type(graph_type) :: graph
      integer, allocatable :: block(:), order(:)

      call new_fine_mesh(model%mesh, level%mesh)
      call new_fine_model(model, level%mesh, level%model)
      level%joint_points = new_joint_points(level%model)
      level%support_points = new_support_points(level%model)
      call place_joint_points(model, level)
      level%near_lines = nodes_near_lines(model, level%model%mesh)
      walls = find_walls(model%mesh)
      level%bends_unseen = walls%bends_unseen
      level%edges_unseen = walls%edges_unseen
      level%stress_in_part = walls%stress_in_part
      block = new_blocks(model%mesh, level%mesh, walls%across > 0.0_wp)
      graph = graph_of_blocks(level%model%mesh, block)
      call order_by_blocks(model%mesh, level%mesh, graph, block, order)
      call new_product_stiffness(level%model%mesh, level%support_points, order, block, level%stiffness)
      level%parents = ordered(level%mesh%parents, order)
      call new_blocks_in_order(level%stiffness, graph, block, order, level%blocks)
   end subroutine lay_out_level

   !> Fine nodes of the elements that share a node with those that the points of lines lie in: stresses are averaged at nodes
   pure function nodes_near_lines(model, fine) result(nodes)
      !> The job
      type(model_type), intent(in) :: model
      !> The fine mesh
      type(mesh_type), intent(in) :: fine
      !> Ascending
      integer, allocatable :: nodes(:)

      logical :: crossed(n_nodes(model%mesh)), near(n_nodes(fine))
      integer :: e, k, p

      crossed = .false.
      do k = 1, size(model%lines)
         do p = 1, size(model%lines(k)%points)
            e = model%lines(k)%points(p)%element
            crossed(model%mesh%element_nodes(:model%mesh%element_size(e), e)) = .true.
         end do
      end do
      near = .false.
      if (any(crossed)) then
         do e = 1, n_elements(fine)
            associate (parent => (e - 1)/n_children + 1)
               if (any(crossed(model%mesh%element_nodes(:model%mesh%element_size(parent), parent)))) &
                  near(fine%element_nodes(:fine%element_size(e), e)) = .true.
            end associate
         end do
      end if
      nodes = pack([(k, k=1, size(near))], near)
   end function nodes_near_lines

   !> Whether the fine level is laid out
   pure logical function is_laid_out(level)
      !> The fine level
      type(fine_level_type), intent(in) :: level

      is_laid_out = allocated(level%stiffness%place)
   end function is_laid_out

   !> Bytes that its stiffness will take, once it is laid out; none if it is there
   pure integer(i8) function bytes_to_come(level)
      !> The fine level
      type(fine_level_type), intent(in) :: level

      bytes_to_come = 0
      if (.not. is_formed(level%stiffness)) bytes_to_come = storage_size(1.0_wp)/8*n_numbers(level%stiffness)
   end function bytes_to_come

   !> Integrate the stiffness
   subroutine form_stiffness(level)
      !> The fine level
      type(fine_level_type), intent(inout) :: level

      call form_product_stiffness(level%model, level%joint_points, level%support_points, level%stiffness)
   end subroutine form_stiffness

   !> Let one rank integrate the stiffness, for `share_stiffness` to tell the others
   subroutine form_by_one(team, level, rank)
      !> Ranks that work on the job
      class(team_type), intent(in) :: team
      !> The fine level
      type(fine_level_type), intent(inout) :: level
      !> The one
      integer, intent(in) :: rank

      level%formed_by = rank
      if (.not. is_told(level, team)) call form_stiffness(level)
   end subroutine form_by_one

   !> Whether this rank will be told the stiffness
   pure logical function is_told(level, team)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> The ranks
      class(team_type), intent(in) :: team

      is_told = .false.
      if (allocated(level%formed_by)) is_told = level%formed_by /= team%rank
   end function is_told

   !> Let all ranks have the stiffness; nothing where they have
   subroutine share_stiffness(level, team, error)
      !> The fine level
      type(fine_level_type), intent(inout) :: level
      !> The ranks
      class(team_type), intent(in) :: team
      !> An error that a rank has met since they agreed last
      type(error_type), allocatable, intent(inout) :: error

      if (.not. allocated(level%formed_by)) return
      call team%agree(error)
      if (allocated(error)) return
      call tell_product_stiffness(team, level%formed_by, level%stiffness)
      deallocate (level%formed_by)
   end subroutine share_stiffness

   !> Find what is free in each class of modes, and with that the blocks that have one factor together
   subroutine take_conditions(equations, level)
      !> The equations, for the classes of modes
      type(equations_type), intent(in) :: equations
      !> The fine level
      type(fine_level_type), intent(inout) :: level

      integer :: k

      allocate (level%conditions(size(equations%classes)))
      do k = 1, size(level%conditions)
         associate (first => equations%systems(findloc(equations%systems%class, k, 1))%modes(1))
            call new_conditions(level%mesh, equations%classes(k)%dofs, equations%modes(first), &
               level%stiffness%place, &
                                level%conditions(k))
         end associate
      end do
      call group_blocks(level%conditions, level%blocks)
   end subroutine take_conditions

   !> Take loads and laws of another job with the same mesh
   subroutine take_fine_model(model, level)
      !> The job
      type(model_type), intent(in) :: model
      !> The fine level
      type(fine_level_type), intent(inout) :: level

      call new_fine_model(model, level%mesh, level%model)
      level%near_lines = nodes_near_lines(model, level%model%mesh)
   end subroutine take_fine_model

   !> Loads of a combination on the fine mesh
   function new_fine_load(level, modes, loading) result(load)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Modes in use
      type(mode_type), intent(in) :: modes(:)
      !> The loads on the coarse mesh
      type(loading_type), intent(in) :: loading
      !> Those on the fine mesh
      type(fine_load_type) :: load

      load%case_factor = loading%case_factor
      call new_initial_state(level%model, modes, loading%case_factor, load%initial)
   end function new_fine_load

   !> Place the points of fine joints in coarse ones, and the other way round
   subroutine place_joint_points(model, level)
      !> The job
      type(model_type), intent(in) :: model
      !> Takes the points
      type(fine_level_type), intent(inout) :: level

      type(model_joint_point_type) :: before
      real(wp) :: x(3), w(3), weight(most_fine)
      integer :: joint, half, k, n, n_fine, n_coarse

      level%coarse_points = new_joint_points(model)
      level%on_coarse = level%joint_points
      allocate (level%first_fine(size(level%coarse_points)), source=0)
      allocate (level%of_fine(most_fine, size(level%coarse_points)), source=0.0_wp)
      n_fine = 0
      n_coarse = 0
      do joint = 1, size(model%mesh%joint_label)
         call joint_rule(model%joint_materials(model%mesh%joint_material(joint))%rule, &
            model%mesh%joint_size(joint)/2, &
                         n, x, w)
         do k = 1, n
            n_coarse = n_coarse + 1
            half = merge(1, 2, x(k) <= 0.0_wp)
            associate (point => level%coarse_points(n_coarse))
               before = point
               point = in_joint(level%model%mesh, 2*joint - 2 + half, 2.0_wp*x(k) + 3.0_wp - &
                  2.0_wp*half)
               point%weight = before%weight
               point%base = before%base
               point%stiffness = before%stiffness
            end associate
         end do
         if (before%proportion <= stiffest_sliding) level%first_fine(n_coarse - n + 1:n_coarse) = n_fine + 1
         weight(:2*n) = level%joint_points(n_fine + 1:n_fine + 2*n)%weight
         level%of_fine(:2*n, n_coarse - n + 1:n_coarse) = nearest_polynomial(x(:n), weight(:2*n))
         do half = 1, 2
            do k = 1, n
               n_fine = n_fine + 1
               level%on_coarse(n_fine) = in_joint(model%mesh, joint, 0.5_wp*x(k) + half - 1.5_wp)
               ! that of the joint's points, whatever their length
               level%joint_points(n_fine)%base = before%base
               level%joint_points(n_fine)%stiffness = before%stiffness
               level%joint_points(n_fine)%proportion = before%proportion
            end do
         end do
      end do
   end subroutine place_joint_points

   !> Values at the points of a joint of the polynomial through them that is nearest to values at those of its halves
   function nearest_polynomial(x, weight) result(factors)
      !> Points of the joint, on [-1, 1]
      real(wp), intent(in) :: x(:)
      !> Weights of those of its halves, one half after the other
      real(wp), intent(in) :: weight(:)
      !> Factors of the values, shape (points of the halves, points of the joint)
      real(wp) :: factors(size(weight), size(x))

      real(wp), dimension(size(x), size(weight)) :: value, right
      real(wp) :: matrix(size(x), size(x)), below(0:size(x) - 1, size(x))
      integer :: i, half, n, info

      n = size(x)
      do half = 1, 2
         do i = 1, n
            value(:, n*(half - 1) + i) = lagrange(x, 0.5_wp*x(i) + half - 1.5_wp)
         end do
      end do
      right = value*spread(weight, 1, n)
      matrix = matmul(right, transpose(value))
      below = 0.0_wp
      do i = 1, n
         below(:n - i, i) = matrix(i:, i)
      end do
      call dpbtrf('L', n, n - 1, below, n, info)
      call dpbtrs('L', n, n - 1, 2*n, below, n, right, n, info)
      factors = transpose(right)
   end function nearest_polynomial

   !> A point of a joint
   pure function in_joint(mesh, joint, x) result(point)
      !> Its mesh
      type(mesh_type), intent(in) :: mesh
      !> The joint
      integer, intent(in) :: joint
      !> Natural coordinate
      real(wp), intent(in) :: x
      !> The point, without weight
      type(model_joint_point_type) :: point

      associate (nodes => mesh%joint_nodes(:, joint), n => mesh%joint_size(joint)/2)
         point%joint_point_type = new_joint_point(mesh%coordinates(:, nodes(lower_node(:n))), x, &
            0.0_wp)
         point%joint = joint
         point%material = mesh%joint_material(joint)
         point%nodes = nodes
      end associate
   end function in_joint

end module axijoint_analysis_fine_level
