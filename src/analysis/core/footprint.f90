!> Memory that a job takes besides its equations
module axijoint_analysis_core_footprint
   use omp_lib, only : omp_get_max_threads
   use axijoint_analysis_fine_block_groups, only : least_same
   use axijoint_analysis_fine_walls, only : walls_type, find_walls, is_slender
   use axijoint_assembly_block_parts, only : block_size
   use axijoint_assembly_repeated_elements, only : shapes_type, find_shapes, number_alike
   use axijoint_base_kinds, only : wp, i8
   use axijoint_element_blocks, only : n_blocks
   use axijoint_element_yield_law, only : yield_none
   use axijoint_fe_element_kind, only : is_reduced
   use axijoint_fe_mode, only : mode_type, family_antisymmetric
   use axijoint_fe_reference, only : reference_type
   use axijoint_fe_shape, only : n_corners
   use axijoint_fe_subdivision, only : n_children
   use axijoint_joints_circle_sums, only : are_worth_it
   use axijoint_joints_history, only : most_turns
   use axijoint_joints_newton_system, only : most_products
   use axijoint_joints_pairs, only : pairs_type, new_pairs
   use axijoint_linalg_symmetric_half, only : half_numbers
   use axijoint_joints_planes, only : planes_type, part_intervals
   use axijoint_model_joint_points, only : model_joint_point_type, stiffest_whole
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, element_references
   use axijoint_model_model, only : model_type, is_shown, n_shown, shows_stress, bodies_yield, can_yield, can_yield_at
   use axijoint_model_modes, only : used_modes
   use axijoint_plastic_field, only : body_planes
   implicit none
   private
   public :: footprint_type, data_footprint, fine_nodes, blocks_of, program_bytes, held_numbers, waiting_numbers

   !> What program and libraries without any data take beyond their start once they are used, with what the last of
   !> the heap's large pages is too large [byte]; measured
   integer(i8), parameter :: program_bytes = 9500000_i8
   !> Bytes of a real
   integer(i8), parameter :: real_bytes = storage_size(1.0_wp)/8
   !> Numbers of a joint point on a plane: jumps, stresses, states, slip, slopes, and copies; those of them that stay, as measured
   integer(i8), parameter :: plane_numbers = 91, state_numbers = 46
   !> Matrices between modes and planes: of components that are even and odd, forth and back
   integer(i8), parameter :: plane_matrices = 4
   !> Planes round the whole circle take so many halves of those of half of it, as measured
   integer(i8), parameter :: around = 5
   !> Planes on which the estimates of errors find joints again, times so many
   integer(i8), parameter :: more_planes = 4
   !> Numbers of a joint point on a plane that are kept of a state where loads turned: jumps, stresses, slip, states
   integer(i8), parameter :: station_numbers = 12
   !> Vectors that the linear solutions of Newton's method touch: with usual joints, and with those whose laws are stiffer than the
   !> structure has them, which may need all that there are
   integer(i8), parameter :: newton_vectors = 100
   !> Copies of what is kept of earlier increments: itself and as bytes, which stay, and two of these while they are written
   integer(i8), parameter :: staying_states = 2, written_states = 4
   !> Bytes of a node in the mesh, its elements, graph, orders and equations, as measured
   integer(i8), parameter :: mesh_bytes = 520
   !> Bytes of a node of the fine mesh besides its stiffness, as measured
   integer(i8), parameter :: fine_mesh_bytes = 190

   !> Amplitudes at the points of bodies that yield: elastic stress, before, excess, carried,
   !> in-situ stress, and copies; vectors of unknowns that a step starts from, that the mix of ten
   !> iterates works with, and that limited-memory BFGS with twenty steps does, by which errors are
   !> estimated where there is a potential
   integer(i8), parameter :: amplitude_arrays = 7, held_vectors = 10, mixed_vectors = 36, &
      learned_vectors = 67

   !> Numbers of fields of earlier increments that are held until they are shown, at most; threads, and joint points, up to which
   !> iterations gain less by sharing products than by leaving the other threads to find these
   integer(i8), parameter :: most_held = 16000000
   integer, parameter :: few_threads = 4, few_points = 300
   !> Numbers that a load leaves while a flexibility is formed, for each node of a line across the mesh
   integer(i8), parameter :: of_lines = 6
   !> Numbers of states that one thread has found and another goes to with more harmonics, at most, and those of a state for each jump
   integer(i8), parameter :: most_waiting = 4000000, of_jump = 7

   !> Bytes
   type :: footprint_type
      !> Mesh and what is numbered on it, with forces under a factor of one, which stand once the equations are planned
      integer(i8) :: mesh = 0
      !> Loads and displacements, which stand while the equations are solved
      integer(i8) :: loads = 0
      !> Reactions and stresses, which come after
      integer(i8) :: stresses = 0
      !> Flexibilities and state of the joints that can yield; what a thread takes to form a flexibility; and what iterations, and
      !> estimates of errors after them, take beside the state
      integer(i8) :: joints = 0, joint_work = 0, joint_states = 0
      !> State of the bodies that yield, with what is kept of earlier increments; what their
      !> iterations take
      integer(i8) :: bodies = 0, body_work = 0
      !> The mesh of elements half as large, for estimates of errors, and what a thread takes for
      !> one
      integer(i8) :: fine = 0, fine_work = 0
   contains
      !> What comes after planning and stays, what a thread takes while the equations are solved, and what
      !> comes once they are
      procedure :: staying, of_a_thread, later
   end type footprint_type

contains

   !> Memory of loads, results and joints
   function data_footprint(model, n_modes, n_systems, joint_points, estimated) result(footprint)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes, and matrices
      integer, intent(in) :: n_modes, n_systems
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: joint_points(:)
      !> Whether errors are estimated by the fine level
      logical, intent(in) :: estimated
      !> The bytes
      type(footprint_type) :: footprint

      type(reference_type), allocatable :: references(:)
      integer(i8) :: nodes
      type(shapes_type) :: shapes
      integer, allocatable :: alike(:)

      references = element_references(model%mesh)
      nodes = n_nodes(model%mesh)
      footprint%mesh = mesh_bytes*nodes + 3*nodes*real_bytes*unit_loads(model)
      ! displacements, two kinds of loads twice, errors of nodes
      footprint%loads = 21*nodes*n_modes*real_bytes
      if (estimated) then
         call find_shapes(model%mesh, shapes)
         alike = number_alike(shapes)
         footprint%fine = fine_bytes(model%mesh, alike)
         footprint%fine_work = fine_work_bytes(model%mesh, alike)
      end if
      footprint%stresses = 9*nodes + 6*sum(int(references(model%mesh%element_kind)%n_points, i8)) &
         + 6*nodes &  ! smoothed to nodes
         + 6*sum(merge(1_i8, 4_i8, model%mesh%element_size <= 4))  ! at samples
      if (any(is_reduced(model%mesh%kinds))) then  ! by the full rule
         footprint%stresses = footprint%stresses + 6*9*count(model%mesh%element_size > 4, kind=i8)
      end if
      footprint%stresses = footprint%stresses*n_modes*real_bytes
      if (size(model%increments) > 1) footprint%stresses = 2*footprint%stresses + footprint%loads
      associate (yields => can_yield_at(model, joint_points%material))
         if (any(yields)) call add_joints(model, n_modes, n_systems, pack(joint_points, yields), estimated, footprint)
      end associate
      if (bodies_yield(model)) call add_bodies(model, references, used_modes(model), footprint)
   end function data_footprint

   !> Add the memory of joints that can yield: flexibilities, the state and what is kept of earlier ones, which stay; then what
   !> iterations take, or the estimates of errors after these
   subroutine add_joints(model, n_modes, n_systems, points, estimated, footprint)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes, and matrices
      integer, intent(in) :: n_modes, n_systems
      !> Points of joints that can yield
      type(model_joint_point_type), intent(in) :: points(:)
      !> Whether errors are estimated
      logical, intent(in) :: estimated
      !> The bytes
      type(footprint_type), intent(inout) :: footprint

      type(mode_type), allocatable :: modes(:)
      integer(i8) :: planes, kept_planes, nodes, n_points, n, vectors, kept, iterations, estimates
      logical :: both, stiff, alone

      alone = omp_get_max_threads() == 1
      n_points = size(points)
      nodes = n_nodes(model%mesh)
      modes = used_modes(model)
      both = any(modes%family == family_antisymmetric)
      planes = model%n_planes
      if (both) planes = around*(planes - 1)/2
      kept_planes = model%n_planes
      if (both) kept_planes = 2*(kept_planes - 1)
      stiff = any(points%proportion > stiffest_whole)
      n = 3*n_pairs(points)
      ! halves of flexibilities, and these as Newton's linear system reads them, in single precision; with stiff joints all of them
      footprint%joints = n_systems*(half_numbers(int(n)) + n**2*merge(4, 1, stiff)/4) &
         + state_numbers*n_points*max(planes, int(n_modes, i8))
      ! in another order, and what unit loads leave on some lines of nodes across the mesh
      footprint%joint_work = real_bytes*(half_numbers(int(n)) + of_lines*n*nint(sqrt(real(nodes, wp)), i8))
      iterations = (plane_numbers - state_numbers)*n_points*max(planes, int(n_modes, i8))
      estimates = 0
      if (estimated) then
         estimates = iterations
         if (maxval(model%harmonics) > 0) estimates = estimates + plane_numbers*n_points*max(more_planes*planes, int(n_modes, i8))
      end if
      vectors = 3*n_points*n_modes
      footprint%joints = footprint%joints + vectors*min(merge(int(most_products, i8), newton_vectors, stiff), vectors)
      if (size(model%increments) > 1) then
         associate (earlier => size(model%increments, kind=i8) - 1)
            kept = earlier*n_points*(7*kept_planes + 6*n_modes)
            footprint%joints = footprint%joints + staying_states*kept + acting_cases(model)*(vectors + 3*nodes)
            iterations = iterations + (written_states - staying_states)*kept
            ! with loads and forces of those that are looked for
            associate (numbers => held_numbers(model, n_modes, size(points)))
               if (numbers > 0) footprint%joints = footprint%joints + numbers + 24*nodes*n_modes
            end associate
            ! loads twice, displacements and what half the elements change of them, where loads turned; joints there, and those that
            ! answer the mesh while others do planes and harmonics
            if (estimated) then
               estimates = estimates + 12*nodes*n_modes*min(most_turns, size(model%increments) - 1) &
                  + n_points*kept_planes*(plane_numbers + station_numbers*min(most_turns + 1_i8, earlier))
               if (.not. alone) estimates = estimates + waiting_numbers(3*n_points*kept_planes, int(earlier))
            end if
         end associate
      else if (estimated .and. .not. alone) then
         estimates = estimates + plane_numbers*n_points*kept_planes
      end if
      footprint%joints = real_bytes*footprint%joints + plane_matrix_bytes(model, modes)
      footprint%joint_states = real_bytes*max(iterations, estimates)
   end subroutine add_joints

   !> Pairs of nodes of some joint points
   integer(i8) function n_pairs(points)
      !> The points
      type(model_joint_point_type), intent(in) :: points(:)

      type(pairs_type) :: pairs

      pairs = new_pairs(points)
      n_pairs = size(pairs%nodes, 2)
   end function n_pairs

   !> Numbers of the fields of earlier increments that are held until they are shown, for they are found beside the iterations; none
   !> if these share products with all threads, or if they are too many
   integer(i8) function held_numbers(model, n_modes, n_points) result(numbers)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes, and joint points that can yield
      integer, intent(in) :: n_modes, n_points

      type(reference_type), allocatable :: references(:)
      integer(i8) :: nodes
      integer :: i, n_threads

      numbers = 0
      n_threads = omp_get_max_threads()
      if (model%error_goal%wanted .or. n_points > few_points .or. n_threads == 1 .or. n_threads > few_threads) return
      nodes = n_nodes(model%mesh)
      ! displacements, reactions, what acts and what is taken; jumps, stresses and states of joints
      numbers = n_shown(model)*(12*nodes*n_modes + 7*int(n_points, i8)*model%n_planes)
      associate (n => count([(is_shown(model, i, size(model%increments)) .and. shows_stress(model, i, size(model%increments)), &
                              i=1, size(model%increments) - 1)]))
         if (n > 0) then
            references = element_references(model%mesh)
            numbers = numbers + n*6*n_modes*(sum(int(references(model%mesh%element_kind)%n_points, i8)) + nodes)
         end if
      end associate
      if (numbers > most_held) numbers = 0
   end function held_numbers

   !> Numbers of the states on the way of the loads that wait for a thread that goes behind with more harmonics, if all do; none if
   !> they are too many: then none waits
   pure integer(i8) function waiting_numbers(n_jumps, n_states) result(numbers)
      !> Jumps on all planes
      integer(i8), intent(in) :: n_jumps
      !> States on the way
      integer, intent(in) :: n_states

      numbers = of_jump*n_jumps*n_states
      if (numbers > most_waiting) numbers = 0
   end function waiting_numbers

   !> Matrices between modes and planes: those of the job, and where it has more than harmonic 0, those of the estimates of
   !> errors with more planes, and with as many modes again; in single precision the largest of those that Newton's method
   !> multiplies with, unless they are so many that sums need none
   pure integer(i8) function plane_matrix_bytes(model, modes) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> Its modes
      type(mode_type), intent(in) :: modes(:)

      integer(i8) :: numbers, largest, single

      numbers = size(modes)*int(model%n_planes, i8)
      if (any(modes%family == family_antisymmetric)) numbers = 2*numbers
      largest = numbers
      if (maxval(model%harmonics) > 0) then
         largest = 2*more_planes*numbers
         numbers = numbers + more_planes*numbers + largest
      end if
      single = merge(0_i8, largest/2, are_worth_it(size(modes), model%n_planes, &
         part_intervals(model%n_planes, (modes%harmonic))))
      bytes = plane_matrices*real_bytes*(numbers + single)
   end function plane_matrix_bytes

   !> Number of load cases whose answers are kept, each of one mode as a rule: where fewer act than there are increments
   pure integer function acting_cases(model)
      !> The job
      type(model_type), intent(in) :: model

      integer :: k

      acting_cases = 0
      do k = 1, size(model%combinations)
         acting_cases = max(acting_cases, count(abs(model%combinations(k)%factor) > 0.0_wp))
      end do
      if (acting_cases >= size(model%increments)) acting_cases = 0
   end function acting_cases

   !> Loads whose forces are found once: on masses, and cases with in-situ stress
   pure integer function unit_loads(model)
      !> The job
      type(model_type), intent(in) :: model

      integer :: k

      unit_loads = size(model%body_loads)
      do k = 1, size(model%initial_stresses)
         associate (cases => model%initial_stresses%case)
            if (.not. any(cases(:k - 1) == cases(k))) unit_loads = unit_loads + 1
         end associate
      end do
   end function unit_loads

   !> Add the memory of bodies that yield. The finer mesh of their estimated errors is not counted: it is
   !> left out where it does not fit
   pure subroutine add_bodies(model, references, modes, footprint)
      !> The job
      type(model_type), intent(in) :: model
      !> Of the kinds of elements
      type(reference_type), intent(in) :: references(:)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> The bytes
      type(footprint_type), intent(inout) :: footprint

      type(planes_type) :: on
      integer(i8) :: points, planes, n_modes, vector, earlier, vectors

      associate (mesh => model%mesh)
         points = sum(int(references(mesh%element_kind)%n_points, i8), &
                      model%materials(mesh%element_material)%yield%criterion /= yield_none)
      end associate
      on = body_planes(modes, model%n_body_planes)
      planes = size(on%angle)
      n_modes = size(modes)
      vector = 3*n_nodes(model%mesh)*n_modes
      associate (laws => model%materials%yield)
         vectors = merge(mixed_vectors, learned_vectors, &
                         can_yield(model) .or. any(abs(laws%friction - laws%dilation) > 0.0_wp))
      end associate
      earlier = size(model%increments) - 1
      footprint%bodies = real_bytes*(8*points*planes + amplitude_arrays*6*points*n_modes &
                                     + held_vectors*vector)
      ! stress taken, hardening, dissipation and two amplitudes of each increment, of the points that have yielded,
      ! which may be all; when one is appended they are there twice
      footprint%bodies = footprint%bodies + 2*real_bytes*earlier*points*(8*planes + 12*n_modes)
      footprint%body_work = real_bytes*(19*points*planes + 2*6*points*n_modes + vectors*vector)
   end subroutine add_bodies

   !> Memory of the fine level: the nodes that it has, with the blocks of stiffness that these have on and below the
   !> diagonal, or, where children of the elements are congruent, those of each of their shapes
   pure integer(i8) function fine_bytes(mesh, alike) result(bytes)
      !> The coarse mesh
      type(mesh_type), intent(in) :: mesh
      !> Number of elements that are like each
      integer, intent(in) :: alike(:)

      !> Bytes of a block, and of an element that is congruent to others: its rows, twice, and where blocks of nodes list it
      integer(i8), parameter :: block_bytes = block_size*real_bytes + 4, element_bytes = 160
      integer :: element
      real(wp) :: numbers, blocks
      logical :: pairs

      numbers = 0.0_wp
      do element = 1, n_elements(mesh)
         pairs = has_congruent_children(mesh, element)
         associate (n => mesh%element_size(element))
            blocks = fine_nodes(n)*blocks_of(n)*block_bytes
            if (alike(element) > 1 .or. pairs) blocks = n_children*element_bytes &
               + n_blocks(n)*block_bytes*merge(n_children/2, n_children, pairs)/real(alike(element), wp)
            numbers = numbers + blocks + fine_nodes(n)*fine_mesh_bytes
         end associate
      end do
      bytes = nint(numbers, i8)
   end function fine_bytes

   !> Whether two children of an element lie above the two others and have their shapes: of a parallelogram along the axis
   pure logical function has_congruent_children(mesh, element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Element
      integer, intent(in) :: element

      real(wp) :: rounding

      has_congruent_children = n_corners(mesh%element_size(element)) == 4
      if (.not. has_congruent_children) return
      associate (x => mesh%coordinates(:, mesh%element_nodes(:4, element)))
         rounding = sqrt(epsilon(1.0_wp))*maxval(abs(x))
         has_congruent_children = all(abs(x(:, 1) - x(:, 2) + x(:, 3) - x(:, 4)) <= rounding) &
            .and. min(abs(x(1, 1) - x(1, 2)), abs(x(1, 2) - x(1, 3))) <= rounding
      end associate
   end function has_congruent_children

   !> What a thread works with on the fine level: factors of blocks of nodes, and vectors of all nodes
   integer(i8) function fine_work_bytes(mesh, alike) result(bytes)
      !> The coarse mesh
      type(mesh_type), intent(in) :: mesh
      !> Number of elements that are like each: their blocks have a factor together if they are some
      integer, intent(in) :: alike(:)

      !> Numbers of the factors for a fine node, of elements of 3 to 9 nodes: where each side and each
      !> inside is a block, and where slender elements make lines; as counted in squares of them
      real(wp), parameter :: compact(3:9) = [9.0_wp, 9.0_wp, 0.0_wp, 20.0_wp, 0.0_wp, 25.0_wp, &
         38.0_wp], slender(3:9) = [13.0_wp, 13.0_wp, 0.0_wp, 65.0_wp, 0.0_wp, 47.0_wp, 65.0_wp]
      !> Where they are thin walls: fine nodes that a row of fine elements adds, for each element across and besides, and how
      !> many times so many nodes a column of the factor reaches, as measured on long tubes
      real(wp), parameter :: row_nodes(3:9) = [2.0_wp, 2.0_wp, 0.0_wp, 8.0_wp, 0.0_wp, 6.0_wp, 8.0_wp], &
         more_nodes(3:9) = [1.0_wp, 1.0_wp, 0.0_wp, 2.0_wp, 0.0_wp, 2.0_wp, 2.0_wp], reached_rows = 1.4_wp
      !> Vectors of three components: two a step, of which two to four are made, others, and memory
      !> between them that nobody uses; as measured
      real(wp), parameter :: vectors = 14.4_wp
      type(walls_type) :: walls
      real(wp) :: numbers, of_blocks
      integer :: element

      walls = find_walls(mesh)
      numbers = 0.0_wp
      do element = 1, n_elements(mesh)
         associate (n => mesh%element_size(element))
            of_blocks = merge(slender(n), compact(n), is_slender(mesh, element))
            if (alike(element) >= least_same) of_blocks = of_blocks/alike(element)
            associate (across => walls%across(element))
               if (across > 0.0_wp) of_blocks = 9*(1.0_wp + reached_rows*(more_nodes(n) + across*row_nodes(n)))
            end associate
            numbers = numbers + fine_nodes(n)*(3.0_wp*vectors + of_blocks)
         end associate
      end do
      bytes = nint(real_bytes*numbers, i8)
   end function fine_work_bytes

   !> Fine nodes of an element among many
   elemental real(wp) function fine_nodes(n_nodes)
      !> Nodes of the element
      integer, intent(in) :: n_nodes

      !> Of elements of 3 to 9 nodes: four times those of a coarse one
      real(wp), parameter :: number(3:9) = [2.0_wp, 4.0_wp, 0.0_wp, 8.0_wp, 0.0_wp, 12.0_wp, &
         16.0_wp]

      fine_nodes = number(n_nodes)
   end function fine_nodes

   !> Neighbours of a node that come before it, and itself, on average
   elemental real(wp) function blocks_of(n_nodes)
      !> Nodes of the elements
      integer, intent(in) :: n_nodes

      real(wp), parameter :: number(3:9) = [4.0_wp, 5.0_wp, 0.0_wp, 6.25_wp, 0.0_wp, 8.3_wp, 8.5_wp]

      blocks_of = number(n_nodes)
   end function blocks_of

   !> What comes after planning and stays, at least until the equations are solved
   elemental integer(i8) function staying(self)
      !> The bytes
      class(footprint_type), intent(in) :: self

      staying = program_bytes + self%loads + self%joints + self%joint_states + self%bodies + self%fine
   end function staying

   !> What a thread takes while the equations are solved, besides factors
   elemental integer(i8) function of_a_thread(self)
      !> The bytes
      class(footprint_type), intent(in) :: self

      of_a_thread = max(self%joint_work, self%fine_work)
   end function of_a_thread

   !> What comes once the equations are solved
   elemental integer(i8) function later(self)
      !> The bytes
      class(footprint_type), intent(in) :: self

      later = max(self%stresses, self%body_work)
   end function later

end module axijoint_analysis_core_footprint
