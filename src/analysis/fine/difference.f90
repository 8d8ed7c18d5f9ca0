!> The difference between the solution on the fine mesh and that on the coarse one, found without a
!> factor of the fine matrix: what blocks of the fine mesh see of the forces that the coarse
!> solution leaves, and what follows from that on the coarse mesh, whose factor is at hand, in steps
!> that each go as far as the energy falls
module axijoint_analysis_fine_difference
   use axijoint_analysis_fine_conditions, only : hold, take_reactions
   use axijoint_analysis_fine_level, only : fine_level_type, fine_load_type
   use axijoint_analysis_fine_mesh, only : prolong, restrict
   use axijoint_analysis_fine_smoother, only : factor_blocks, solve_blocks
   use axijoint_assembly_equations, only : equations_type, solve_mode
   use axijoint_assembly_force, only : joint_force, joint_jump
   use axijoint_assembly_loading, only : add_external, still_force
   use axijoint_assembly_node_blocks, only : block_product
   use axijoint_base_kinds, only : wp, i8
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_nodes
   implicit none
   private
   public :: difference_type, new_difference, find_difference, share_difference

   !> Steps: of 38 meshes of elements of all kinds, uniform, graded, distorted and slender, the
   !> second came to 0.80 to 1.03 of the largest difference of a node, the first to 0.6 to 0.95.
   !> Where nodes are much better than what is between them, as in smooth fields, it takes more:
   !> until a step changes nodes and jumps of joints by less than this part
   integer, parameter :: least_steps = 2, most_steps = 8
   real(wp), parameter :: settled = 0.4_wp

   !> The difference
   type :: difference_type
      !> At the nodes of the coarse mesh, amplitudes, shape (3, nodes, modes)
      real(wp), allocatable :: displacement(:, :, :)
      !> Of the jumps at its joint points, amplitudes, shape (3, points, modes)
      real(wp), allocatable :: jump(:, :, :)
      !> Time of all threads [second], and share of the time of the solution that went into
      !> factorizations
      real(wp) :: seconds = 0.0_wp, factor_share = 0.0_wp
   end type difference_type

contains

   !> No difference
   subroutine new_difference(n_nodes, n_points, n_modes, difference)
      !> Nodes, joint points, modes
      integer, intent(in) :: n_nodes, n_points, n_modes
      !> The difference
      type(difference_type), intent(out) :: difference

      allocate (difference%displacement(3, n_nodes, n_modes), source=0.0_wp)
      allocate (difference%jump(3, n_points, n_modes), source=0.0_wp)
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
      end associate
   end subroutine share_difference

   !> Find the difference of the modes of one system
   subroutine find_difference(level, equations, s, load, displacement, points, excess, difference)
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
      !> Takes the difference
      type(difference_type), intent(inout) :: difference

      real(wp), allocatable :: force(:, :), factor(:)
      logical :: failed
      integer :: i, k

      associate (system => equations%systems(s))
         call factor_blocks(level%smoother, level%stiffness, system%harmonic, &
            level%conditions(system%class), factor, &
                            failed)
         if (failed) return
         do i = 1, size(system%modes)
            k = system%modes(i)
            call left_force(level, equations, k, load, displacement(:, :, k), points, &
               excess(:, :, k), force)
            call descend(level, equations, k, factor, force, difference)
         end do
      end associate
   end subroutine find_difference

   !> Forces that a coarse solution leaves on the fine mesh
   subroutine left_force(level, equations, k, load, displacement, points, excess, force)
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
      !> The forces, shape (3, fine nodes)
      real(wp), allocatable, intent(out) :: force(:, :)

      real(wp), allocatable :: external(:, :), u(:, :), internal(:, :)

      allocate (external(3, n_nodes(level%model%mesh)), u(3, n_nodes(level%model%mesh)))
      external = joint_force(points, equations%modes(k)%harmonic, excess, size(external, 2))
      call add_external(level%model, equations%modes(k), load%case_factor, external)
      if (load%initial%present) then
         u = 0.0_wp
         external = external - still_force(level%model, level%joint_points, level%support_points, &
            load%initial, k, &
                                           equations%modes(k), u, load%case_factor)
      end if
      allocate (force, internal, mold=u)
      call prolong(level%parents, displacement, u)
      call block_product(level%stiffness, equations%modes(k)%harmonic, u, internal)
      force(:, level%stiffness%place) = external
      force = force - internal
      call take_reactions(level%conditions(equations%systems(equations%system(k))%class), force)
   end subroutine left_force

   !> Displacements under forces, in a few steps
   subroutine descend(level, equations, k, factor, force, difference)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Equations of the coarse mesh, factored
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Factors of the blocks
      real(wp), intent(in) :: factor(:)
      !> Forces, then what is left of them, shape (3, fine nodes)
      real(wp), intent(inout) :: force(:, :)
      !> Takes the difference
      type(difference_type), intent(inout) :: difference

      real(wp), allocatable :: way(:, :, :), pull(:, :, :), change(:, :), jump(:, :)
      real(wp) :: length
      integer :: step, i

      allocate (way(3, size(force, 2), most_steps), pull(3, size(force, 2), most_steps))
      associate (harmonic => equations%modes(k)%harmonic, place => level%stiffness%place, &
                 conditions => level%conditions(equations%systems(equations%system(k))%class), &
                 displacement => difference%displacement(:, :, k), &
                 jumps => difference%jump(:, :, k))
         do step = 1, most_steps
            associate (d => way(:, :, step), kd => pull(:, :, step))
               call look_down(level, equations, k, factor, force, d)
               do i = 1, step - 1
                  d = d - sum(pull(:, :, i)*d)*way(:, :, i)
               end do
               call block_product(level%stiffness, harmonic, d, kd)
               length = sum(d*kd)
               if (.not. length > 0.0_wp) exit
               d = d/sqrt(length)
               kd = kd/sqrt(length)
               length = sum(d*force)
               change = length*d(:, place)
               jump = joint_jump(level%coarse_points, change)
               displacement = displacement + change(:, :size(displacement, 2))
               jumps = jumps + jump
               force = force - length*kd
               call take_reactions(conditions, force)
               if (step >= least_steps .and. is_small(change(:, :size(displacement, 2)), &
                  displacement) &
                   .and. is_small(jump, jumps)) exit
            end associate
         end do
      end associate
   end subroutine descend

   !> Whether a change is small
   pure logical function is_small(change, whole)
      !> The change, and what was changed
      real(wp), intent(in) :: change(:, :), whole(:, :)

      is_small = maxval(abs(change)) <= settled*maxval(abs(whole))
   end function is_small

   !> A way down: what the blocks make of forces, and what the coarse mesh does then
   subroutine look_down(level, equations, k, factor, force, d)
      !> The fine level
      type(fine_level_type), intent(in) :: level
      !> Equations of the coarse mesh, factored
      type(equations_type), intent(in) :: equations
      !> Place of the mode
      integer, intent(in) :: k
      !> Factors of the blocks
      real(wp), intent(in) :: factor(:)
      !> Forces, shape (3, fine nodes)
      real(wp), intent(in) :: force(:, :)
      !> Displacements, same shape
      real(wp), intent(out), contiguous :: d(:, :)

      real(wp), allocatable :: rest(:, :), coarse(:, :), displacement(:, :)

      associate (conditions => level%conditions(equations%systems(equations%system(k))%class))
         d = force
         call solve_blocks(level%smoother, factor, d)
         call hold(conditions, d)
         allocate (rest, mold=force)
         call block_product(level%stiffness, equations%modes(k)%harmonic, d, rest)
         rest = force - rest
         call take_reactions(conditions, rest)
         allocate (coarse(3, size(equations%classes(1)%dofs%equation, 2)))
         allocate (displacement, mold=coarse)
         call restrict(level%parents, rest, coarse)
         call solve_mode(equations, k, coarse, displacement)
         call prolong(level%parents, displacement, rest)
         d = d + rest
         call hold(conditions, d)
      end associate
   end subroutine look_down

end module axijoint_analysis_fine_difference
