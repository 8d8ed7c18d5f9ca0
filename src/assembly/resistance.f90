!> What supports, joints and springs resist of the rigid motions of parts
module axijoint_assembly_resistance
   use axijoint_assembly_rigid_motion, only : max_motions, rigid_motion
   use axijoint_assembly_support, only : support_point_type, support_matrix
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : jump_matrix
   use axijoint_fe_mode, only : mode_type
   use axijoint_linalg_lapack, only : symmetric_eigen
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, held_components
   implicit none
   private
   public :: free_motions

   !> A rigid motion is free if supports and joints resist it by less than
   !> this share of the stiffest motion; each restraint counts as one
   real(wp), parameter :: free_limit = 1.0e-13_wp

contains

   !> Rigid motions of one mode that nothing resists
   subroutine free_motions(model, points, supports, part, frame, mode, free)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of the joints that count, wherever their stiffness is not zero, as if they stick
      type(model_joint_point_type), intent(in) :: points(:)
      !> Points of all springs
      type(support_point_type), intent(in) :: supports(:)
      !> Part of each node
      integer, intent(in) :: part(:)
      !> Frame of the rigid motions
      real(wp), intent(in) :: frame(2)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> One column a free motion: multiples of the motions of all parts, shape
      !> (max_motions parts, free motions)
      real(wp), allocatable, intent(out) :: free(:, :)

      real(wp), allocatable :: resistance(:, :), eigenvalue(:)
      integer :: n, info, k

      n = maxval(part)*max_motions
      allocate (resistance(n, n), source=0.0_wp)
      allocate (eigenvalue(n))
      call add_supports(model, part, frame, mode, resistance)
      call add_joints(model, points, part, frame, mode, resistance)
      call add_springs(model, supports, part, frame, mode, resistance)
      if (mode%harmonic == 0) then  ! the second motion is not in use: hold it
         do k = 2, n, max_motions
            resistance(k, k) = 1.0_wp
         end do
      end if
      call symmetric_eigen(resistance, eigenvalue, info)
      free = resistance(:, :count(.not. eigenvalue > free_limit*maxval(eigenvalue)))
   end subroutine free_motions

   !> Add what the supports resist
   subroutine add_supports(model, part, frame, mode, resistance)
      !> The job
      type(model_type), intent(in) :: model
      !> Part of each node
      integer, intent(in) :: part(:)
      !> Frame of the rigid motions
      real(wp), intent(in) :: frame(2)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> Resistance matrix
      real(wp), intent(inout) :: resistance(:, :)

      real(wp) :: motion(3, max_motions)
      logical, allocatable :: held(:, :)
      integer :: node, i, first

      held = held_components(model, mode)
      do node = 1, n_nodes(model%mesh)
         if (.not. any(held(:, node))) cycle
         motion = rigid_motion(model%mesh, frame, mode, node)
         first = max_motions*(part(node) - 1)
         do i = 1, 3
            if (.not. held(i, node)) cycle
            if (.not. any(abs(motion(i, :)) > 0.0_wp)) cycle
            call add_row(motion(i, :), [first + 1, first + 2], resistance)
         end do
      end do
   end subroutine add_supports


   !> Add what the joints resist
   subroutine add_joints(model, points, part, frame, mode, resistance)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Part of each node
      integer, intent(in) :: part(:)
      !> Frame of the rigid motions
      real(wp), intent(in) :: frame(2)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> Resistance matrix
      real(wp), intent(inout) :: resistance(:, :)

      real(wp) :: matrix(3, 18), jump(3, 2*max_motions)
      integer :: k, i, n, lower, upper

      do k = 1, size(points)
         n = 2*points(k)%n_pairs
         call jump_matrix(points(k)%joint_point_type, matrix(:, :3*n))
         lower = part(points(k)%nodes(1))
         upper = part(points(k)%nodes(3))
         if (lower == upper) cycle  ! a slit: both sides move together
         jump = 0.0_wp
         do i = 1, n  ! nodes of side 1-2 move with one part, of side 4-3 with the other
            associate (node => points(k)%nodes(i), &
                       column => merge(0, max_motions, any(i == [1, 2, 5])))
               jump(:, column + 1:column + max_motions) &
                  = jump(:, column + 1:column + max_motions) &
                  + matmul(matrix(:, 3*i - 2:3*i), rigid_motion(model%mesh, frame, mode, node))
            end associate
         end do
         do i = 1, 3
            if (.not. model%joint_materials(points(k)%material)%law%stiffness(i) > 0.0_wp) cycle
            call add_row(jump(i, :), [max_motions*(lower - 1) + 1, max_motions*lower, &
                                      max_motions*(upper - 1) + 1, max_motions*upper], resistance)
         end do
      end do
   end subroutine add_joints


   !> Add what the springs resist
   subroutine add_springs(model, supports, part, frame, mode, resistance)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all springs
      type(support_point_type), intent(in) :: supports(:)
      !> Part of each node
      integer, intent(in) :: part(:)
      !> Frame of the rigid motions
      real(wp), intent(in) :: frame(2)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> Resistance matrix
      real(wp), intent(inout) :: resistance(:, :)

      real(wp) :: matrix(3, 9), moved(3, max_motions)
      integer :: k, i, first

      do k = 1, size(supports)
         associate (point => supports(k))
            call support_matrix(point, matrix(:, :3*point%n_pairs))
            moved = 0.0_wp
            do i = 1, point%n_pairs
               moved = moved + matmul(matrix(:, 3*i - 2:3*i), &
                                      rigid_motion(model%mesh, frame, mode, point%nodes(i)))
            end do
            first = max_motions*(part(point%nodes(1)) - 1)
            do i = 1, 3
               if (.not. point%stiffness(i) > 0.0_wp) cycle
               call add_row(moved(i, :), [first + 1, first + 2], resistance)
            end do
         end associate
      end do
   end subroutine add_springs


   !> Add the square of one constraint
   pure subroutine add_row(row, place, resistance)
      !> Coefficients of the constraint
      real(wp), intent(in) :: row(:)
      !> Their places
      integer, intent(in) :: place(:)
      !> Resistance matrix
      real(wp), intent(inout) :: resistance(:, :)

      integer :: i, j

      do j = 1, size(row)
         do i = 1, size(row)
            resistance(place(i), place(j)) = resistance(place(i), place(j)) + row(i)*row(j)
         end do
      end do
   end subroutine add_row


end module axijoint_assembly_resistance
