!> Bodies that nothing holds, found before any equation is solved
module axijoint_assembly_mechanism
   use axijoint_assembly_support, only : support_point_type, support_matrix
   use axijoint_base_error, only : error_type, fatal_error, exit_singular
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_element_joint, only : jump_matrix
   use axijoint_fe_mode, only : mode_type, is_torsion
   use axijoint_linalg_lapack, only : symmetric_eigen
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : mesh_type, n_elements, n_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: check_mechanism, solid_parts

   !> A rigid motion is free if supports and joints resist it by less than
   !> this share of the stiffest motion; each restraint counts as one
   real(wp), parameter :: free_limit = 1.0e-13_wp

   !> Rigid motions of a part in harmonic 1: sideways and tilting; in harmonic 0
   !> only the first is in use: along z, or about z in torsion
   integer, parameter :: max_motions = 2

contains

   !> Report the rigid motions that neither supports nor joints resist. Joints
   !> count wherever their stiffness is not zero, as if they stick.
   subroutine check_mechanism(model, points, supports, modes, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Points of all springs
      type(support_point_type), intent(in) :: supports(:)
      !> Modes to be solved; only those of harmonics 0 and 1 have rigid motions
      type(mode_type), intent(in) :: modes(:)
      !> The free motions in words
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: part(:)
      character(len=:), allocatable :: message
      integer :: k, last

      call solid_parts(model%mesh, part)
      message = ''
      last = -1
      do k = 1, size(modes)
         if (modes(k)%harmonic > 1) exit
         if (modes(k)%harmonic == 1 .and. last == 1) cycle  ! both families move alike
         last = modes(k)%harmonic
         message = message//free_motions(model, points, supports, part, modes(k))
      end do
      if (len(message) == 0) return
      call fatal_error(error, exit_singular, 'the structure can move without resistance:'// &
                       message//new_line('a')//'mend: add a restraint, or a joint with '// &
                       'stiffness in that direction')
   end subroutine check_mechanism

   !> Number the parts of the mesh that solid elements hold together
   subroutine solid_parts(mesh, part)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Part of each node, from 1; a node of no element is a part of its own
      integer, allocatable, intent(out) :: part(:)

      integer :: element, k, node, root(n_nodes(mesh)), count

      root = [(node, node = 1, n_nodes(mesh))]
      do element = 1, n_elements(mesh)
         associate (nodes => mesh%element_nodes(:mesh%element_size(element), element))
            do k = 2, size(nodes)
               root(find(nodes(k))) = find(nodes(1))
            end do
         end associate
      end do
      allocate (part(n_nodes(mesh)), source=0)
      count = 0
      do node = 1, n_nodes(mesh)
         associate (top => find(node))
            if (part(top) == 0) then
               count = count + 1
               part(top) = count
            end if
            part(node) = part(top)
         end associate
      end do

   contains

      !> Root of a node; halves the path on its way
      integer function find(start)
         !> Node
         integer, intent(in) :: start

         find = start
         do while (root(find) /= find)
            root(find) = root(root(find))
            find = root(find)
         end do
      end function find

   end subroutine solid_parts

   !> The free rigid motions of one mode, a line each; empty if none
   function free_motions(model, points, supports, part, mode) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: points(:)
      type(support_point_type), intent(in) :: supports(:)
      !> Part of each node
      integer, intent(in) :: part(:)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> The lines
      character(len=:), allocatable :: text

      real(wp), allocatable :: resistance(:, :), eigenvalue(:)
      real(wp) :: frame(2)
      integer :: n, info, k, place

      n = maxval(part)*max_motions
      allocate (resistance(n, n), source=0.0_wp)
      allocate (eigenvalue(n))
      associate (x => model%mesh%coordinates)
         frame(1) = 0.5_wp*(minval(x(2, :)) + maxval(x(2, :)))
         frame(2) = max(maxval(x(1, :)), maxval(x(2, :)) - minval(x(2, :)))
      end associate
      call add_supports(model, part, frame, mode, resistance)
      call add_joints(model, points, part, frame, mode, resistance)
      call add_springs(model, supports, part, frame, mode, resistance)
      if (mode%harmonic == 0) then  ! the second motion is not in use: hold it
         do k = 2, n, max_motions
            resistance(k, k) = 1.0_wp
         end do
      end if
      call symmetric_eigen(resistance, eigenvalue, info)
      text = ''
      do k = 1, n
         if (eigenvalue(k) > free_limit*maxval(eigenvalue)) exit
         place = maxloc(abs(resistance(:, k)), 1)
         text = text//new_line('a')//'  the part with node '// &
            to_text(model%mesh%node_label(findloc(part, (place - 1)/max_motions + 1, 1)))// &
            trim(motion_name(mode, place))
      end do
   end function free_motions

   !> A rigid motion in words
   pure function motion_name(mode, place) result(name)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> Place of the motion in the resistance matrix
      integer, intent(in) :: place
      !> Words
      character(len=40) :: name

      if (is_torsion(mode)) then
         name = ' is free to turn about z (torsion)'
      else if (mode%harmonic == 0) then
         name = ' is free to move along z (harmonic 0)'
      else if (mod(place, max_motions) == 1) then
         name = ' is free to move sideways (harmonic 1)'
      else
         name = ' is free to tilt (harmonic 1)'
      end if
   end function motion_name

   !> Displacement components of a node in the rigid motions of its part
   pure function rigid_motion(model, frame, mode, node) result(motion)
      !> The job
      type(model_type), intent(in) :: model
      !> Height z that motions tilt about, and the length that heights and radii
      !> are measured in
      real(wp), intent(in) :: frame(2)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> Node
      integer, intent(in) :: node
      !> u, v, w in each motion, shape (3, max_motions); lengths are made
      !> dimensionless with the extent of the mesh
      real(wp) :: motion(3, max_motions)

      motion = 0.0_wp
      if (is_torsion(mode)) then
         motion(3, 1) = model%mesh%coordinates(1, node)/frame(2)
      else if (mode%harmonic == 0) then
         motion(2, 1) = 1.0_wp
      else
         associate (x => (model%mesh%coordinates(:, node) - [0.0_wp, frame(1)])/frame(2))
            motion(:, 1) = [1.0_wp, 0.0_wp, -1.0_wp]
            motion(:, 2) = [-x(2), x(1), x(2)]
         end associate
      end if
   end function rigid_motion

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
      integer :: node, i, first

      do node = 1, n_nodes(model%mesh)
         if (.not. any(model%fixed(:, node))) cycle
         motion = rigid_motion(model, frame, mode, node)
         first = max_motions*(part(node) - 1)
         do i = 1, 3
            if (.not. model%fixed(i, node)) cycle
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
         jump = 0.0_wp
         do i = 1, n  ! nodes of side 1-2 move with one part, of side 4-3 with the other
            associate (node => points(k)%nodes(i), &
                       column => merge(0, max_motions, any(i == [1, 2, 5])))
               jump(:, column + 1:column + max_motions) &
                  = jump(:, column + 1:column + max_motions) &
                  + matmul(matrix(:, 3*i - 2:3*i), rigid_motion(model, frame, mode, node))
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
                                      rigid_motion(model, frame, mode, point%nodes(i)))
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

end module axijoint_assembly_mechanism
