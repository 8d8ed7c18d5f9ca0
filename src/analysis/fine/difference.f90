!> The difference between the solution on the fine mesh and that on the coarse one, found without a
!> factor of the fine matrix: what blocks of the fine mesh see of the forces that the coarse
!> solution leaves, and what follows from that on the coarse mesh, whose factor is at hand, in steps
!> that each go as far as the energy falls
module axijoint_analysis_fine_difference
   use axijoint_analysis_fine_conditions, only : conditions_type, hold, take_reactions, held_part
   use axijoint_analysis_fine_level, only : most_fine, fine_level_type, fine_load_type
   use axijoint_analysis_fine_mesh, only : prolong, restrict
   use axijoint_analysis_fine_smoother, only : factor_blocks, solve_blocks
   use axijoint_assembly_equations, only : equations_type, solve_mode
   use axijoint_assembly_force, only : joint_force, joint_jump
   use axijoint_assembly_loading, only : add_external, still_force
   use axijoint_assembly_product_stiffness, only : stiffness_product
   use axijoint_assembly_support, only : add_support_force
   use axijoint_base_kinds, only : wp, i8
   use axijoint_linalg_lapack, only : daxpy, ddot
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_nodes
   implicit none
   private
   public :: difference_type, room_type, most_steps, new_difference, find_difference, share_difference

   !> Steps at most of a mode, turns at most, and the part of nodes and jumps of joints that is left to the blocks alone
   !> after a step. `scripts/bench estimates` shows what that does to the estimates
   integer, parameter :: most_steps = 8, most_turns = 16
   real(wp), parameter :: settled = 0.2_wp
   !> The first step, and the blocks alone in it, go so far at least where the coarse mesh moves the fine one as it does
   !> itself, and what it leaves is seen by the blocks. It does not with elements whose volume is that of their middle, nor in
   !> nearly incompressible bodies: there what was told after steps of 0.52 to 0.6 was 1.8 to 5 times too small (rings and
   !> plates of 4-node B-bar elements), and the one or the other went backwards to 0.43 (these, 8- and 9-node reduced).
   real(wp), parameter :: usual = 0.65_wp
   !> A first step shorter than this goes astray, where soft bodies lie beside nearly incompressible ones (the soft piers, layers
   !> and rings of `scripts/bench estimates`): more steps of both together came to a tenth of the difference or less
   real(wp), parameter :: no_guide = 1.0_wp/3.0_wp

   !> The difference
   type :: difference_type
      !> At the nodes of the coarse mesh, amplitudes, shape (3, nodes, modes)
      real(wp), allocatable :: displacement(:, :, :)
      !> Of the jumps at its joint points, amplitudes, shape (3, points, modes)
      real(wp), allocatable :: jump(:, :, :)
      !> Energy of the whole of it, shape (modes)
      real(wp), allocatable :: energy(:)
      !> Forces of what holds it, supports and springs, shared by the nodes of the coarse mesh, of as many of the first modes as
      !> are asked for, shape (3, nodes, these)
      real(wp), allocatable :: holding(:, :, :)
      !> At fine nodes near lines (`near_lines` of the level), shape (3, those nodes, modes)
      real(wp), allocatable :: near_lines(:, :, :)
      !> Whether what was found is made of numbers, shape (modes)
      logical, allocatable :: known(:)
      !> Time of all threads [second], and share of the time of the solution that went into
      !> factorizations
      real(wp) :: seconds = 0.0_wp, factor_share = 0.0_wp
   end type difference_type

   !> Memory that finding the differences of one system after the other takes. Fresh memory is cleared when
   !> it is first touched: where each system had its own, two thirds of the page faults of a linear job
   !> of sixteen were of it
   type :: room_type
      private
      !> Factors of the blocks
      real(wp), allocatable :: factor(:)
      !> Forces that are left, loads and displacements, shape (3, fine nodes)
      real(wp), allocatable :: force(:, :), external(:, :), u(:, :)
      !> Ways down and the forces that they take, shape (3, fine nodes, steps)
      real(wp), allocatable :: way(:, :, :), pull(:, :, :)
   end type room_type

contains

   !> No difference
   subroutine new_difference(n_nodes, n_points, n_near, n_modes, n_holding, difference)
      !> Nodes, joint points, fine nodes near lines, modes
      integer, intent(in) :: n_nodes, n_points, n_near, n_modes
      !> Of how many of the first modes forces of what holds it are asked for
      integer, intent(in) :: n_holding
      !> The difference
      type(difference_type), intent(out) :: difference

      allocate (difference%displacement(3, n_nodes, n_modes), source=0.0_wp)
      allocate (difference%jump(3, n_points, n_modes), source=0.0_wp)
      allocate (difference%holding(3, n_nodes, n_holding), source=0.0_wp)
      allocate (difference%near_lines(3, n_near, n_modes), source=0.0_wp)
      allocate (difference%energy(n_modes), source=0.0_wp)
      allocate (difference%known(n_modes), source=.true.)
   end subroutine new_difference

   !> Let all ranks know the differences of all modes
   subroutine share_difference(equations, difference)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The difference; those of the modes of this rank are found
      type(difference_type), intent(inout) :: difference

      associate (displacement => difference%displacement, jump => difference%jump)
         call equations%team%gather(displacement, size(displacement, kind=i8), equations%last_mode)
         call equations%team%gather(jump, size(jump, kind=i8), equations%last_mode)
         associate (holding => difference%holding)
            call equations%team%gather(holding, size(holding, kind=i8), min(equations%last_mode, size(holding, 3)))
         end associate
         associate (near => difference%near_lines)
            call equations%team%gather(near, size(near, kind=i8), equations%last_mode)
         end associate
         call equations%team%gather(difference%energy, size(difference%energy, kind=i8), equations%last_mode)
      end associate
      difference%known = equations%team%all_of(all(difference%known))
   end subroutine share_difference

   !> Find the difference of the modes of one system
   subroutine find_difference(level, equations, s, load, displacement, points, excess, room, difference, steps, again)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Equations of the coarse mesh; the factor of the system is there
      type(equations_type), intent(in) :: equations
      !> The system
      integer, intent(in) :: s
      !> The loads
      type(fine_load_type), intent(in) :: load
      !> Displacements on the coarse mesh, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Fine joint points with excess stress, and its amplitudes, shape (3, points, modes)
      type(model_joint_point_type), intent(in) :: points(:)
      real(wp), intent(in) :: excess(:, :, :)
      !> Memory of this thread for this level
      type(room_type), intent(inout) :: room
      !> Takes the difference
      type(difference_type), intent(inout) :: difference
      !> Steps at most of each mode; as many as it takes if absent
      integer, intent(in), optional :: steps(:)
      !> Whether the memory has the factors of the blocks of this system; false if absent
      logical, intent(in), optional :: again

      logical :: failed, formed
      integer :: i, k

      call make_room(n_nodes(level%model%mesh), room)
      formed = .false.
      if (present(again)) formed = again
      failed = .false.
      associate (system => equations%systems(s))
         if (.not. formed) call factor_blocks(level%blocks, level%stiffness, system%harmonic, &
            level%conditions(system%class), room%factor, failed)
         if (failed) then
            difference%known(system%modes) = .false.
            return
         end if
         do i = 1, size(system%modes)
            k = system%modes(i)
            call left_force(level, equations, k, load, displacement(:, :, k), points, &
               excess(:, :, k), room)
            if (present(steps)) then
               call descend(level, equations, k, steps(k), allocated(load%initial%temperature), room, difference)
            else
               call descend(level, equations, k, most_steps, allocated(load%initial%temperature), room, difference)
            end if
            difference%known(k) = difference%known(k) .and. are_numbers(difference%displacement(:, :, k)) .and. &
               are_numbers(difference%jump(:, :, k))
         end do
      end associate
   end subroutine find_difference

   !> Allocate what a thread needs, once
   subroutine make_room(n, room)
      !> Nodes of the fine mesh
      integer, intent(in) :: n
      !> The memory
      type(room_type), intent(inout) :: room

      if (allocated(room%force)) return
      allocate (room%force(3, n), room%external(3, n), room%u(3, n))
      allocate (room%way(3, n, most_steps), room%pull(3, n, most_steps))
   end subroutine make_room

   !> Forces that a coarse solution leaves on the fine mesh
   subroutine left_force(level, equations, k, load, displacement, points, excess, room)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> The equations, for the modes
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> The loads
      type(fine_load_type), intent(in) :: load
      !> The solution, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Fine joint points with excess stress, and its amplitudes, shape (3, points)
      type(model_joint_point_type), intent(in) :: points(:)
      real(wp), intent(in) :: excess(:, :)
      !> Takes the forces
      type(room_type), intent(inout) :: room

      integer :: node

      associate (force => room%force, external => room%external, u => room%u)
         external = 0.0_wp
         if (size(points) > 0) external = joint_force(points, equations%modes(k)%harmonic, excess, &
            size(external, 2))
         call add_external(level%model, equations%modes(k), load%case_factor, external)
         if (load%initial%present) then
            u = 0.0_wp
            external = external - still_force(level%model, level%joint_points, level%support_points, &
               load%initial, k, equations%modes(k), u, load%case_factor)
         end if
         call prolong(level%parents, displacement, u)
         call stiffness_product(level%stiffness, equations%modes(k)%harmonic, u, force)
         do node = 1, size(external, 2)
            associate (f => force(:, level%stiffness%place(node)))
               f = external(:, node) - f
            end associate
         end do
         call take_reactions(level%conditions(equations%systems(equations%system(k))%class), force)
      end associate
   end subroutine left_force

   !> Displacements under forces: steps that blocks and the coarse mesh make together, as many as it takes
   !> until what the blocks would add to them is small. That is added without a product for how far to go:
   !> as far as the blocks alone would have gone in the step before. Where the coarse mesh is no good guide, until
   !> a step is small; where it is none, blocks and coarse mesh go by turns
   subroutine descend(level, equations, k, steps, heated, room, difference)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Equations of the coarse mesh, factored
      type(equations_type), intent(in) :: equations
      !> Place of the mode, and steps at most where the coarse mesh is a guide
      integer, intent(in) :: k, steps
      !> Whether strain comes from heat: what that leaves is soon found, and hides how far the rest is from it
      logical, intent(in) :: heated
      !> Factors of the blocks; forces, then what is left of them
      type(room_type), intent(inout) :: room
      !> Takes the difference
      type(difference_type), intent(inout) :: difference

      real(wp), allocatable :: jump(:, :)
      real(wp) :: energy(most_steps), of_blocks, length
      integer :: step
      logical :: guided, small, astray

      astray = .false.
      guided = .true.
      associate (force => room%force, way => room%way, conditions => level%conditions(equations%systems(equations%system(k))%class))
         do step = 1, most_steps
            way(:, :, step) = force
            call solve_blocks(level%blocks, room%factor, way(:, :, step))
            call hold(conditions, way(:, :, step))
            if (step > 1 .and. guided) then
               room%u = way(:, :, step)
               call keep_apart(way(:, :, :step - 1), room%pull(:, :, :step - 1), energy(:step - 1), room%u)
               call see_change(level, of_blocks, room%u, size(difference%displacement, 2), room%external, jump)
               if (step > steps .or. is_small(room%external, jump, difference, k)) then
                  call add_change(level, room%external, jump, 0.5_wp*of_blocks*work(room%u, force), k, difference)
                  if (k <= size(difference%holding, 3)) call add_springs(level, equations%modes(k)%harmonic, of_blocks, room%u, &
                     difference%holding(:, :, k))
                  exit
               end if
            end if
            call look_down(level, equations, k, force, room%u, way(:, :, step), of_blocks)
            call find_length(level, equations%modes(k)%harmonic, step, room, energy, length)
            if (.not. energy(step) > 0.0_wp) then
               ! nothing is left, or what is left is not known
               difference%known(k) = energy(step) <= 0.0_wp
               exit
            end if
            if (step == 1) then
               astray = .not. length >= no_guide
               if (astray) exit
               guided = length >= usual .and. of_blocks >= usual .and. .not. heated
            end if
            call go(level, equations, k, length, energy(step), step, room, difference, small)
            if (small .and. .not. guided) exit
         end do
      end associate
      if (astray) call descend_by_turns(level, equations, k, steps > 1, room, difference)
   end subroutine descend

   !> The same where the coarse mesh moves the fine one otherwise than that does itself: blocks and coarse mesh by turns,
   !> each as far as the energy falls, until neither adds much
   subroutine descend_by_turns(level, equations, k, counts, room, difference)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Equations of the coarse mesh, factored
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Whether the mode has so much of the forces that nothing is known if it is not
      logical, intent(in) :: counts
      !> Factors of the blocks; forces, then what is left of them
      type(room_type), intent(inout) :: room
      !> Takes the difference
      type(difference_type), intent(inout) :: difference

      real(wp) :: energy(most_turns), length
      integer :: turn, n
      logical :: small, was_small

      if (size(room%way, 3) < most_turns) then
         n = size(room%force, 2)
         deallocate (room%way, room%pull)
         allocate (room%way(3, n, most_turns), room%pull(3, n, most_turns))
      end if
      was_small = .false.
      associate (d => room%way, conditions => level%conditions(equations%systems(equations%system(k))%class))
         do turn = 1, most_turns
            d(:, :, turn) = room%force
            if (mod(turn, 2) == 1) then
               call solve_blocks(level%blocks, room%factor, d(:, :, turn))
            else
               call follow_coarse_mesh(level, equations, k, d(:, :, turn))
            end if
            call hold(conditions, d(:, :, turn))
            call find_length(level, equations%modes(k)%harmonic, turn, room, energy, length)
            if (.not. energy(turn) > 0.0_wp) then
               difference%known(k) = energy(turn) <= 0.0_wp
               return
            end if
            call go(level, equations, k, length, energy(turn), turn, room, difference, small)
            if (small .and. was_small) return
            was_small = small
         end do
      end associate
      if (counts) difference%known(k) = .false.  ! more would follow
   end subroutine descend_by_turns

   !> Make a way orthogonal to those before it, and find how far the energy falls along it
   subroutine find_length(level, harmonic, i, room, energy, length)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Harmonic m, and the way
      integer, intent(in) :: harmonic, i
      !> Forces that are left, and ways; takes the forces that the way takes
      type(room_type), intent(inout) :: room
      !> Work of each way; takes that of this one
      real(wp), intent(inout) :: energy(:)
      !> How far; 0 if the work is not positive
      real(wp), intent(out) :: length

      length = 0.0_wp
      associate (d => room%way(:, :, i), kd => room%pull(:, :, i))
         call keep_apart(room%way(:, :, :i - 1), room%pull(:, :, :i - 1), energy(:i - 1), d)
         call stiffness_product(level%stiffness, harmonic, d, kd)
         energy(i) = work(d, kd)
         if (energy(i) > 0.0_wp) length = work(d, room%force)/energy(i)
      end associate
   end subroutine find_length

   !> Go so far along a way
   subroutine go(level, equations, k, length, energy, i, room, difference, small)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> The equations, for the modes
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> How far, the work of the way, and the way
      real(wp), intent(in) :: length, energy
      integer, intent(in) :: i
      !> Ways and the forces that they take; takes what is left of the forces
      type(room_type), intent(inout) :: room
      !> Takes the change
      type(difference_type), intent(inout) :: difference
      !> Whether it is small
      logical, intent(out) :: small

      real(wp), allocatable :: jump(:, :)

      call see_change(level, length, room%way(:, :, i), size(difference%displacement, 2), room%external, jump)
      small = is_small(room%external, jump, difference, k)
      call add_change(level, room%external, jump, 0.5_wp*length**2*energy, k, difference)
      call daxpy(size(room%force), -length, room%pull(:, :, i), 1, room%force, 1)
      associate (conditions => level%conditions(equations%systems(equations%system(k))%class))
         call take_reactions(conditions, room%force)
         if (k > size(difference%holding, 3)) return
         call add_reactions(level, conditions, length, room%pull(:, :, i), difference%holding(:, :, k))
         call add_springs(level, equations%modes(k)%harmonic, length, room%way(:, :, i), difference%holding(:, :, k))
      end associate
   end subroutine go

   !> Add what a way does to the reactions of supports: the work of its forces on motions of the nodes of the coarse mesh that are
   !> held. Forces on fine nodes that are held are not all of it: nodes between these and the first free ones of the coarse mesh are
   !> free on the fine mesh alone, and forces on them came to what the coarse reactions are off by. Without them a tube held at both
   !> ends was told 30 to 100 times its error
   subroutine add_reactions(level, conditions, length, pull, reaction)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> What is held
      type(conditions_type), intent(in) :: conditions
      !> How far, and the forces that the way takes, shape (3, fine nodes)
      real(wp), intent(in) :: length, pull(:, :)
      !> The reactions, shape (3, nodes)
      real(wp), intent(inout) :: reaction(:, :)

      real(wp) :: coarse(3, size(reaction, 2))
      integer :: node

      call restrict(level%parents, pull, coarse)
      do node = 1, size(coarse, 2)
         reaction(:, node) = reaction(:, node) + length*held_part(conditions, level%stiffness%place(node), coarse(:, node))
      end do
   end subroutine add_reactions

   !> Add what springs push back with
   subroutine add_springs(level, harmonic, length, d, force)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> How far, and the way, shape (3, fine nodes)
      real(wp), intent(in) :: length, d(:, :)
      !> The forces, shape (3, nodes)
      real(wp), intent(inout) :: force(:, :)

      real(wp), allocatable :: pushed(:, :), by_place(:, :)
      real(wp) :: coarse(3, size(force, 2))

      if (size(level%support_points) == 0) return
      allocate (pushed, mold=d)
      allocate (by_place, mold=d)
      pushed = 0.0_wp
      call add_support_force(level%support_points, harmonic, length*d(:, level%stiffness%place), pushed)
      by_place(:, level%stiffness%place) = pushed
      call restrict(level%parents, by_place, coarse)
      force = force - coarse
   end subroutine add_springs

   !> Whether none is infinite or not a number
   pure logical function are_numbers(values)
      !> Amplitudes
      real(wp), intent(in) :: values(:, :)

      are_numbers = all(abs(values) <= huge(1.0_wp))
   end function are_numbers

   !> Work of forces on displacements, in an order of the sum that is always the same
   pure real(wp) function work(displacement, force)
      !> The displacements, and the forces, shape (3, fine nodes)
      real(wp), intent(in), contiguous :: displacement(:, :), force(:, :)

      work = ddot(size(force), displacement, 1, force, 1)
   end function work

   !> Take from a way what goes along those before it
   pure subroutine keep_apart(ways, pulls, energy, d)
      !> Ways and the forces that they take, shape (3, fine nodes, any), and the work of these on the first of the ways
      real(wp), intent(in), contiguous :: ways(:, :, :), pulls(:, :, :)
      real(wp), intent(in) :: energy(:)
      !> The way
      real(wp), intent(inout), contiguous :: d(:, :)

      integer :: i

      do i = 1, size(energy)
         call daxpy(size(d), -work(d, pulls(:, :, i))/energy(i), ways(:, :, i), 1, d, 1)
      end do
   end subroutine keep_apart

   !> What going so far does to the nodes and joint points of the coarse mesh, and to fine nodes near lines
   pure subroutine see_change(level, length, d, n, change, jump)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> How far, and the way, shape (3, fine nodes)
      real(wp), intent(in) :: length, d(:, :)
      !> Nodes of the coarse mesh
      integer, intent(in) :: n
      !> Takes displacements by number of the node, shape (3, fine nodes): of the nodes of the coarse mesh, of joints and near lines
      real(wp), intent(inout) :: change(:, :)
      !> Takes jumps, shape (3, points)
      real(wp), allocatable, intent(out) :: jump(:, :)

      real(wp) :: fine(3, size(level%joint_points))
      integer :: k, m

      change(:, :n) = length*d(:, level%stiffness%place(:n))
      change(:, level%near_lines) = length*d(:, level%stiffness%place(level%near_lines))
      do k = 1, size(level%joint_points)
         associate (nodes => level%joint_points(k)%nodes(:2*level%joint_points(k)%n_pairs))
            change(:, nodes) = length*d(:, level%stiffness%place(nodes))
         end associate
      end do
      jump = joint_jump(level%coarse_points, change)
      fine = joint_jump(level%joint_points, change)
      do k = 1, size(jump, 2)
         if (level%first_fine(k) == 0) cycle  ! too stiff to move
         m = min(most_fine, size(fine, 2) - level%first_fine(k) + 1)  ! beyond those of the joint factors are zero
         jump(:, k) = matmul(fine(:, level%first_fine(k):level%first_fine(k) + m - 1), level%of_fine(:m, k))
      end do
   end subroutine see_change

   !> Whether a change of a mode is small beside what it comes to
   pure logical function is_small(change, jump, difference, k)
      !> The change at the nodes, those of the coarse mesh first, and of the jumps, shape (3, any)
      real(wp), intent(in) :: change(:, :), jump(:, :)
      !> What is changed, and the place of the mode
      type(difference_type), intent(in) :: difference
      integer, intent(in) :: k

      associate (u => difference%displacement(:, :, k), d => difference%jump(:, :, k))
         is_small = is_part(change(:, :size(u, 2)), u)
         if (is_small) is_small = is_part(jump, d)
      end associate
   end function is_small

   !> Whether a change is no more than a part of what it comes to
   pure logical function is_part(change, before)
      !> The change, and what is changed
      real(wp), intent(in) :: change(:, :), before(:, :)

      is_part = maxval(abs(change)) <= settled*maxval(abs(before + change))
   end function is_part

   !> Add a change of a mode
   pure subroutine add_change(level, change, jump, energy, k, difference)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> The change at the nodes, those of the coarse mesh first, and of the jumps, shape (3, any)
      real(wp), intent(in) :: change(:, :), jump(:, :)
      !> Its energy
      real(wp), intent(in) :: energy
      !> Place of the mode
      integer, intent(in) :: k
      !> Takes it
      type(difference_type), intent(inout) :: difference

      associate (u => difference%displacement(:, :, k))
         u = u + change(:, :size(u, 2))
      end associate
      difference%jump(:, :, k) = difference%jump(:, :, k) + jump
      difference%near_lines(:, :, k) = difference%near_lines(:, :, k) + change(:, level%near_lines)
      difference%energy(k) = difference%energy(k) + energy
   end subroutine add_change

   !> A way down: what the blocks make of forces, and what the coarse mesh does then
   subroutine look_down(level, equations, k, force, rest, d, of_blocks)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Equations of the coarse mesh, factored
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Forces, shape (3, fine nodes)
      real(wp), intent(in), contiguous :: force(:, :)
      !> Room for forces and displacements, same shape
      real(wp), intent(inout), contiguous :: rest(:, :)
      !> Displacements of the blocks, then with those of the coarse mesh, same shape
      real(wp), intent(inout), contiguous :: d(:, :)
      !> How far the blocks alone would go
      real(wp), intent(out) :: of_blocks

      associate (conditions => level%conditions(equations%systems(equations%system(k))%class))
         call stiffness_product(level%stiffness, equations%modes(k)%harmonic, d, rest)
         of_blocks = work(d, rest)
         if (of_blocks > 0.0_wp) of_blocks = work(d, force)/of_blocks
         rest = force - rest
         call take_reactions(conditions, rest)
         call follow_coarse_mesh(level, equations, k, rest)
         d = d + rest
         call hold(conditions, d)
      end associate
   end subroutine look_down

   !> What the coarse mesh does under forces on the fine one
   subroutine follow_coarse_mesh(level, equations, k, vectors)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Equations of the coarse mesh, factored
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Forces, then displacements, shape (3, fine nodes)
      real(wp), intent(inout), contiguous :: vectors(:, :)

      real(wp), allocatable :: coarse(:, :), displacement(:, :)

      allocate (coarse(3, size(equations%classes(1)%dofs%equation, 2)))
      allocate (displacement, mold=coarse)
      call restrict(level%parents, vectors, coarse)
      call solve_mode(equations, k, coarse, displacement)
      call prolong(level%parents, displacement, vectors)
   end subroutine follow_coarse_mesh

end module axijoint_analysis_fine_difference
