!> The linear system of a Newton step: amplitudes e of excess stress with (I - A E' S F) e = r,
!> with the synthesis S, the slopes E' of the laws on the planes, the analysis A and the
!> flexibilities F.
!>
!> A point whose laws are elastic on all planes takes its r at once, for its row is that of I. What
!> remains is a system of the points that slip, open or close, often a few of many, which GMRES
!> solves. Its arrays lie component by component, so that all products are those of matrices. Where few
!> digits are gathered (`gathered_flexibility`), products are in single precision, and what a solution leaves
!> is found with all digits, and solved for again
module axijoint_joints_newton_system
   use omp_lib, only : omp_get_level, omp_get_num_threads, omp_get_thread_num
   use axijoint_base_kinds, only : wp, sp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_gathered_flexibility, only : gathered_type, gathering_type, gather_moving, is_worth_threads
   use axijoint_joints_pairs, only : forces_on_pairs, jumps_at_points
   use axijoint_joints_plane_product, only : put_slopes, multiply_group, n_groups, points_together
   use axijoint_joints_planes, only : sum_modes, find_modes
   use axijoint_joints_point_blocks, only : point_blocks_type, new_point_blocks, precondition
   use axijoint_joints_scene, only : scene_type, jumps, tell_jumps
   use axijoint_linalg_gmres, only : operator_type, gmres
   use axijoint_linalg_lapack, only : matrix_vector
   use axijoint_linalg_symmetric_single, only : symmetric_product
   implicit none
   private
   public :: linear_type, gathering_type, solve, most_products

   !> Most products of a solution, and the loosest tolerance
   integer, parameter :: most_products = 400
   real(wp), parameter :: loosest = 0.1_wp
   !> A slope below this share of the stiffness is rounding
   real(wp), parameter :: rounding = 1.0e-12_wp
   !> What a solution in single precision may leave at best, how much less each must leave than the
   !> one before, and most of them
   real(wp), parameter :: single_tolerance = 1.0e-4_wp, worth_more = 0.5_wp
   integer, parameter :: most_solutions = 6
   !> Points whose sums over modes and planes are found at a time, whatever the number of threads
   integer, parameter :: points_at_a_time = 32

   !> What is solved
   type :: linear_type
      !> Derivatives of the excess stress by the jumps, shape (3, 3, points, planes)
      real(wp), allocatable :: slope(:, :, :, :)
      !> Share of the slopes that the system has: what it lacks of one is springs that damp the step
      real(wp) :: kept = 1.0_wp
      !> Right side: amplitudes that are not transferred, shape (3, points, modes)
      real(wp), allocatable :: residual(:, :, :)
      !> Stress that is rounding
      real(wp) :: rounding = 0.0_wp
      !> Points whose laws are stiffer than their joints in the structure
      logical, allocatable :: stiff(:)
   end type linear_type

   !> Memory that products take
   type :: room_type
      !> Jumps, shape (points, 3, modes)
      real(wp), allocatable :: jump(:, :, :)
      !> Forces on the pairs of nodes, shape (pairs, 3, modes), and the two parts of products with flexibilities that displacements
      !> of these are sums of, shape (3 pairs, parts, modes)
      real(wp), allocatable :: force(:, :, :), parts(:, :, :)
      !> The same in single precision
      real(sp), allocatable :: force_by_few_digits(:, :, :), parts_by_few_digits(:, :, :)
   end type room_type

   !> I - A E' S F of the points that move
   type, extends(operator_type) :: derivative_type
      !> The structure, modes and planes
      type(condensed_type), pointer :: condensed => null()
      type(scene_type), pointer :: scene => null()
      !> Their flexibilities
      type(gathering_type), pointer :: gathering => null()
      !> Their slopes times the share that acts, shape (points, 3, 3, planes)
      real(wp), allocatable :: slope(:, :, :, :)
      !> What a solution may leave at best
      real(wp) :: least_left = 0.0_wp
      !> Their jumps under a unit of the load whose work is given, and the same times what makes them
      !> shares of that work, shape (points, 3, modes); not allocated without
      real(wp), allocatable :: given_jump(:, :, :), given_share(:, :, :)
      !> Inverses of what points do to themselves, where laws are stiff
      type(point_blocks_type), allocatable :: blocks
      !> In single precision: the largest slope, and what flexibilities in their units are multiplied by so that they give
      !> jumps times that, shape (modes)
      real(wp) :: largest = 0.0_wp
      real(wp), allocatable :: scale(:)
      !> Memory of its products
      type(room_type), pointer :: room => null()
   contains
      !> Product with amplitudes of excess stress
      procedure :: apply
   end type derivative_type

contains

   !> Solve for the change of the excess stress, with all digits if few do not do
   recursive subroutine solve(condensed, scene, linear, tolerance, change, jump, gathering)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Slopes and right side
      type(linear_type), intent(in) :: linear
      !> What may be left of the right side
      real(wp), intent(in) :: tolerance
      !> The change, and amplitudes of the jumps that it makes, shape (3, points, modes)
      real(wp), allocatable, intent(out) :: change(:, :, :), jump(:, :, :)
      !> Flexibilities that were gathered for the last solution, then for this one
      type(gathering_type), intent(inout), target :: gathering

      type(derivative_type) :: derivative
      type(room_type), target :: room
      real(wp), allocatable :: right(:, :, :), left(:, :, :), x(:)
      integer, allocatable :: points(:)
      logical :: moves(size(linear%slope, 3))
      real(wp) :: whole, before, reached, reduction
      integer :: k, n, n_products

      moves = moving(condensed, linear%slope)
      call gather_moving(condensed, linear%stiff, moves, gathering)
      derivative%gathering => gathering
      points = pack([(k, k=1, size(moves))], moves)
      change = linear%residual
      do k = 1, size(moves)  ! what is left of points that hold is often nothing
         if (moves(k)) change(:, k, :) = 0.0_wp
         if (all(abs(change(:, k, :)) <= linear%rounding)) change(:, k, :) = 0.0_wp
      end do
      jump = change
      if (any(abs(change) > 0.0_wp)) jump = jumps(condensed, scene, change, free=.false.)
      if (size(points) == 0) return
      call new_derivative(condensed, scene, linear, points, derivative)
      call make_room(gathering%double, size(points), size(gathering%pairs%nodes, 2), size(scene%system), room)
      derivative%room => room
      right = by_component(linear%residual, points)
      if (allocated(derivative%blocks)) call precondition(derivative%blocks, right)
      whole = hypot(norm2(change), norm2(right))
      allocate (x(size(right)))
      before = huge(before)
      do n = 1, most_solutions
         left = remainder(derivative, linear, points, change, jump)
         reached = norm2(left)
         if (reached <= tolerance*whole .or. reached > worth_more*before) exit
         before = reached
         call gmres(derivative, reshape(left, [size(x)]), min(loosest, max(tolerance*whole/reached, &
            derivative%least_left)), min(most_products, size(x)), x, n_products, reduction)
         call add(reshape(x, shape(left)), points, change)
         jump = jumps(condensed, scene, change, free=.false.)
      end do
      if (gathering%double .or. reached <= loosest*whole) return
      gathering%all_digits = .true.
      call solve(condensed, scene, linear, tolerance, change, jump, gathering)
   end subroutine solve

   !> Memory for products
   subroutine make_room(double, n, n_pairs, n_modes, room)
      !> Whether these are in double precision
      logical, intent(in) :: double
      !> Points that move, their pairs of nodes, and modes
      integer, intent(in) :: n, n_pairs, n_modes
      !> The memory
      type(room_type), intent(out) :: room

      allocate (room%jump(n, 3, n_modes))
      if (double) then
         allocate (room%force(n_pairs, 3, n_modes))
         allocate (room%parts(3*n_pairs, 2, n_modes), source=0.0_wp)  ! those of other ranks stay
      else
         allocate (room%force_by_few_digits(n_pairs, 3, n_modes))
         allocate (room%parts_by_few_digits(3*n_pairs, 2, n_modes), source=0.0_sp)
      end if
   end subroutine make_room

   !> Points whose excess stress changes with the jumps, on any plane
   pure function moving(condensed, slope) result(moves)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Slopes, shape (3, 3, points, planes)
      real(wp), intent(in) :: slope(:, :, :, :)
      !> Shape (points)
      logical :: moves(size(slope, 3))

      real(wp) :: least(size(slope, 3))
      integer :: j, k

      least = [(rounding*maxval(condensed%points(k)%base), k=1, size(least))]
      moves = .false.
      do j = 1, size(slope, 4)
         do k = 1, size(moves)
            if (.not. moves(k)) moves(k) = maxval(abs(slope(:, :, k, j))) > least(k)
         end do
      end do
   end function moving

   !> What the points that move do to each other
   subroutine new_derivative(condensed, scene, linear, points, derivative)
      !> The condensed structure
      type(condensed_type), intent(in), target :: condensed
      !> Modes and planes
      type(scene_type), intent(in), target :: scene
      !> Slopes
      type(linear_type), intent(in) :: linear
      !> The points
      integer, intent(in) :: points(:)
      !> The derivative; flexibilities are gathered already
      type(derivative_type), intent(inout) :: derivative

      integer :: j, k

      derivative%condensed => condensed
      derivative%scene => scene
      if (allocated(scene%given%jump)) then
         derivative%given_jump = by_component(scene%given%jump, points)
         derivative%given_share = by_component(scene%given%weighted, points)/scene%given%compliance
      end if
      allocate (derivative%slope(size(points), 3, 3, size(linear%slope, 4)))
      do j = 1, size(linear%slope, 4)
         do k = 1, size(points)
            derivative%slope(k, :, :, j) = linear%kept*linear%slope(:, :, points(k), j)
         end do
      end do
      if (any(linear%stiff(points))) then
         allocate (derivative%blocks)
         call new_point_blocks(condensed, scene, linear%slope, linear%kept, points, linear%stiff, &
            derivative%blocks)
      end if
      if (derivative%gathering%double) return
      derivative%least_left = single_tolerance
      call put_slopes(derivative%gathering%product, scene%planes, derivative%slope, derivative%largest)
      associate (gathering => derivative%gathering)
         derivative%scale = derivative%largest*gathering%largest*gathering%flexibilities(scene%system)%unit*scene%scale
      end associate
   end subroutine new_derivative

   !> What a change leaves of the right side of the points that move
   function remainder(derivative, linear, points, change, jump) result(left)
      !> The derivative
      type(derivative_type), intent(in) :: derivative
      !> The right side
      type(linear_type), intent(in) :: linear
      !> The points
      integer, intent(in) :: points(:)
      !> The change, and the jumps that it makes, shape (3, all points, modes)
      real(wp), intent(in) :: change(:, :, :), jump(:, :, :)
      !> Shape (points, 3, modes)
      real(wp), allocatable :: left(:, :, :)

      real(wp), allocatable :: excess(:, :, :)

      left = by_component(linear%residual - change, points)
      allocate (excess, mold=left)
      call find_excess(derivative, size(points), by_component(jump, points), excess)
      left = left + excess
      if (allocated(derivative%blocks)) call precondition(derivative%blocks, left)
   end function remainder

   !> Values of some points, component by component
   pure function by_component(values, points) result(chosen)
      !> Shape (3, all points, modes)
      real(wp), intent(in) :: values(:, :, :)
      !> The points
      integer, intent(in) :: points(:)
      !> Shape (points, 3, modes)
      real(wp) :: chosen(size(points), 3, size(values, 3))

      integer :: i, k

      do k = 1, size(values, 3)
         do i = 1, 3
            chosen(:, i, k) = values(i, points, k)
         end do
      end do
   end function by_component

   !> Add a solution to the change
   subroutine add(solution, points, change)
      !> Shape (points, 3, modes)
      real(wp), intent(in) :: solution(:, :, :)
      !> The points
      integer, intent(in) :: points(:)
      !> Shape (3, all points, modes)
      real(wp), intent(inout) :: change(:, :, :)

      integer :: i

      do i = 1, 3
         change(i, points, :) = change(i, points, :) + solution(:, i, :)
      end do
   end subroutine add

   !> A E' S: excess stress that the laws make of jumps
   subroutine find_excess(self, n, jump, excess)
      !> The operator
      type(derivative_type), intent(in) :: self
      !> Number of points
      integer, intent(in) :: n
      !> Amplitudes of jumps and excess stress, shape (points, 3, modes)
      real(wp), intent(in) :: jump(n, 3, *)
      real(wp), intent(inout) :: excess(n, 3, *)

      integer :: k

      !$omp parallel do schedule(static) if (omp_get_level() == 0 .and. is_worth_threads(self%gathering))
      do k = 1, n_parts(n)
         call find_part(self, k, n, jump, excess)
      end do
      !$omp end parallel do
   end subroutine find_excess

   !> Parts in which the excess stress of points is found
   pure integer function n_parts(n)
      !> Number of points
      integer, intent(in) :: n

      n_parts = (n + points_at_a_time - 1)/points_at_a_time
   end function n_parts

   !> Last point of a part
   pure integer function last_of(part, n)
      !> The part, and the number of all points
      integer, intent(in) :: part, n

      last_of = part*n/n_parts(n)
   end function last_of

   !> Excess stress of a part of the points
   subroutine find_part(self, part, n, jump, excess)
      !> The operator
      type(derivative_type), intent(in) :: self
      !> The part, and the number of all points
      integer, intent(in) :: part, n
      !> Amplitudes of jumps and excess stress, shape (points, 3, modes)
      real(wp), intent(in) :: jump(n, 3, *)
      real(wp), intent(inout) :: excess(n, 3, *)

      real(wp), allocatable :: on_planes(:, :, :), stress(:, :, :)
      integer :: j, first, last

      first = last_of(part - 1, n) + 1
      last = last_of(part, n)
      allocate (on_planes(last - first + 1, 3, size(self%slope, 4)), stress(last - first + 1, 3, size(self%slope, 4)))
      call sum_modes(self%scene%planes, last - first + 1, n, jump(first, 1, 1), on_planes)
      do j = 1, size(stress, 3)
         call multiply(last - first + 1, n, self%slope(first, 1, 1, j), on_planes(:, :, j), stress(:, :, j))
      end do
      call find_modes(self%scene%planes, last - first + 1, n, stress, excess(first, 1, 1))
   end subroutine find_part

   !> Products of the slopes of points with their jumps on a plane
   pure subroutine multiply(n, lead, slope, jump, stress)
      !> Number of points, and of those that slopes are there for
      integer, intent(in) :: n, lead
      !> Slopes
      real(wp), intent(in) :: slope(lead, 3, *)
      !> Jumps, and the stresses that they make
      real(wp), intent(in) :: jump(n, 3)
      real(wp), intent(out) :: stress(n, 3)

      integer :: i

      do i = 1, 3
         stress(:, i) = slope(:n, i, 1)*jump(:, 1) + slope(:n, i, 2)*jump(:, 2) + slope(:n, i, 3)*jump(:, 3)
      end do
   end subroutine multiply

   !> Product with amplitudes of excess stress
   subroutine apply(self, x, y)
      !> The operator
      class(derivative_type), intent(in) :: self
      !> Amplitudes, points x 3 x modes
      real(wp), intent(in), contiguous :: x(:)
      !> The product
      real(wp), intent(out), contiguous :: y(:)

      if (self%gathering%double) then
         call act(self, size(self%slope, 1), size(self%scene%system), x, y)
      else
         call act_by_few_digits(self, size(self%slope, 1), size(self%scene%system), x, y)
      end if
   end subroutine apply

   !> The same by points, components and modes
   subroutine act(self, n, n_modes, x, y)
      !> The operator
      class(derivative_type), intent(in) :: self
      !> Numbers of points and modes
      integer, intent(in) :: n, n_modes
      !> Amplitudes of excess stress, and the product
      real(wp), intent(in) :: x(n, 3, n_modes)
      real(wp), intent(inout) :: y(n, 3, n_modes)

      if (is_worth_threads(self%gathering)) then
         !$omp parallel
         call act_in_part(self, omp_get_thread_num(), omp_get_num_threads(), n, n_modes, x, y)
         !$omp end parallel
      else  ! a region of one thread costs as much as the shortest products
         call act_in_part(self, 0, 1, n, n_modes, x, y)
      end if
      if (allocated(self%blocks)) call precondition(self%blocks, y)
   end subroutine act

   !> The part of one thread. Flexibilities are halved among threads, whatever the number of these
   subroutine act_in_part(self, thread, n_threads, n, n_modes, x, y)
      !> The operator
      class(derivative_type), intent(in) :: self
      !> The thread, from 0, and how many there are
      integer, intent(in) :: thread, n_threads
      !> Numbers of points and modes
      integer, intent(in) :: n, n_modes
      !> Amplitudes of excess stress, and the product
      real(wp), intent(in) :: x(n, 3, n_modes)
      real(wp), intent(inout) :: y(n, 3, n_modes)

      integer :: first, half, k, last, part

      associate (jump => self%room%jump, force => self%room%force, parts => self%room%parts, gathering => self%gathering, &
                 scene => self%scene)
         do k = 1 + thread, n_modes, n_threads
            call forces_on_pairs(gathering%pairs, n, gathering%weight, x(:, :, k), force(:, :, k))
         end do
         call wait_for_all(n_threads)
         do half = 1 + thread, 2*n_modes, n_threads
            k = (half + 1)/2
            part = half - 2*(k - 1)
            call flex(gathering%flexibilities(scene%system(k)), size(parts, 1), part, force(:, :, k), parts(:, part, k))
         end do
         call wait_for_all(n_threads)
         do k = 1 + thread, n_modes, n_threads
            call jumps_at_points(gathering%pairs, scene%scale(k)*gathering%largest &
               *reshape(parts(:, 1, k) + parts(:, 2, k), [size(force, 1), 3]), n, jump(:, :, k))
         end do
         call wait_for_all(n_threads)
         if (self%condensed%shared .or. allocated(self%given_jump)) then
            if (thread == 0) call complete_jumps(self, x, jump)
            call wait_for_all(n_threads)
         end if
         do k = 1 + thread, n_parts(n), n_threads
            call find_part(self, k, n, jump, y)
            first = last_of(k - 1, n) + 1
            last = last_of(k, n)
            y(first:last, :, :) = x(first:last, :, :) - y(first:last, :, :)
         end do
      end associate
   end subroutine act_in_part

   !> The same in single precision
   subroutine act_by_few_digits(self, n, n_modes, x, y)
      !> The operator
      class(derivative_type), intent(in) :: self
      !> Numbers of points and modes
      integer, intent(in) :: n, n_modes
      !> Amplitudes of excess stress, and the product
      real(wp), intent(in) :: x(n, 3, n_modes)
      real(wp), intent(inout) :: y(n, 3, n_modes)

      if (is_worth_threads(self%gathering)) then
         !$omp parallel
         call act_in_part_by_few_digits(self, omp_get_thread_num(), omp_get_num_threads(), n, n_modes, x, y)
         !$omp end parallel
      else
         call act_in_part_by_few_digits(self, 0, 1, n, n_modes, x, y)
      end if
   end subroutine act_by_few_digits

   !> The part of one thread
   subroutine act_in_part_by_few_digits(self, thread, n_threads, n, n_modes, x, y)
      !> The operator
      class(derivative_type), intent(in) :: self
      !> The thread, from 0, and how many there are
      integer, intent(in) :: thread, n_threads
      !> Numbers of points and modes
      integer, intent(in) :: n, n_modes
      !> Amplitudes of excess stress, and the product
      real(wp), intent(in) :: x(n, 3, n_modes)
      real(wp), intent(inout) :: y(n, 3, n_modes)

      real(wp) :: on_pairs(size(self%gathering%pairs%nodes, 2), 3), at_points(n, 3)
      integer :: first, half, k, last, part

      associate (force => self%room%force_by_few_digits, parts => self%room%parts_by_few_digits, gathering => self%gathering, &
                 jump => self%gathering%product%jump, excess => self%gathering%product%excess)
         do k = 1 + thread, n_modes, n_threads
            call forces_on_pairs(gathering%pairs, n, gathering%weight, x(:, :, k), on_pairs)
            force(:, :, k) = real(on_pairs, sp)
         end do
         call wait_for_all(n_threads)
         do half = 1 + thread, 2*n_modes, n_threads
            k = (half + 1)/2
            part = half - 2*(k - 1)
            associate (flexibility => gathering%flexibilities(self%scene%system(k)))
               if (allocated(flexibility%single)) call symmetric_product(flexibility%single, &
                  reshape(force(:, :, k), [size(parts, 1)]), parts(:, part, k), part=part)
            end associate
         end do
         call wait_for_all(n_threads)
         do k = 1 + thread, n_modes, n_threads
            on_pairs = self%scale(k)*reshape(real(parts(:, 1, k), wp) + parts(:, 2, k), shape(on_pairs))
            call jumps_at_points(gathering%pairs, on_pairs, n, at_points)
            jump(:n, :, k) = real(at_points, sp)
         end do
         call wait_for_all(n_threads)
         if (self%condensed%shared .or. allocated(self%given_jump)) then
            if (thread == 0) then
               self%room%jump = real(jump(:n, :, :), wp)/self%largest
               call complete_jumps(self, x, self%room%jump)
               jump(:n, :, :) = real(self%largest*self%room%jump, sp)
            end if
            call wait_for_all(n_threads)
         end if
         do k = 1 + thread, n_groups(n), n_threads
            first = (k - 1)*points_together + 1
            last = min(n, k*points_together)
            call multiply_group(gathering%product, k)
            y(first:last, :, :) = x(first:last, :, :) - excess(first:last, :, :)
         end do
      end associate
   end subroutine act_in_part_by_few_digits

   !> Wait for all threads that share a product
   subroutine wait_for_all(n_threads)
      !> How many there are
      integer, intent(in) :: n_threads

      if (n_threads == 1) return
      !$omp barrier
   end subroutine wait_for_all

   !> What other ranks know of jumps, and the load whose work is given
   subroutine complete_jumps(self, x, jump)
      !> The operator
      class(derivative_type), intent(in) :: self
      !> Amplitudes of excess stress, and the jumps that flexibilities make of it, shape (points, 3, modes)
      real(wp), intent(in) :: x(:, :, :)
      real(wp), intent(inout), contiguous :: jump(:, :, :)

      if (self%condensed%shared) call tell_jumps(self%condensed, self%scene, jump)
      if (allocated(self%given_jump)) jump = jump - sum(self%given_share*x)*self%given_jump
   end subroutine complete_jumps

   !> One of two parts of the product of a flexibility, if it is there
   subroutine flex(flexibility, n, part, force, moved)
      !> The flexibility
      type(gathered_type), intent(in) :: flexibility
      !> Its size
      integer, intent(in) :: n
      !> Which part, 1 or 2
      integer, intent(in) :: part
      !> Amplitudes of forces on the pairs and of their displacements
      real(wp), intent(in) :: force(n)
      real(wp), intent(inout) :: moved(n)

      if (.not. allocated(flexibility%double)) return
      associate (first => 1 + (part - 1)*(n/2), last => merge(n/2, n, part == 1))
         call matrix_vector(flexibility%double(:, first:last), force(first:last), moved)
      end associate
   end subroutine flex

end module axijoint_joints_newton_system
