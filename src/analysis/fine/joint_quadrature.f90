!> What the rule of the joints leaves where the law has a kink within a joint, as at the edge of
!> an open part: stresses by the law between the points against those at the points
module axijoint_analysis_fine_joint_quadrature
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : joint_point_type, new_joint_point, lower_node
   use axijoint_element_joint_law, only : admit
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : lagrange
   use axijoint_joints_field, only : joint_field_type, trial_of
   use axijoint_joints_planes, only : planes_type, analyse
   use axijoint_model_joint_points, only : model_joint_point_type, joint_rule, law_at
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: missed_stress

   !> Pieces that a joint is cut into, and Gauss points of each: the kink is found to a piece
   integer, parameter :: n_pieces = 32, n_gauss = 2
   !> Largest deviation from a straight or parabolic course that is rounding, over the stress
   real(wp), parameter :: smooth = 1.0e-9_wp

   !> One joint on one plane
   type :: course_type
      !> Number of points of the rule
      integer :: n = 0
      !> Natural coordinates of the points, trial stresses there, stresses there
      real(wp) :: x(3) = 0.0_wp, trial(3, 3) = 0.0_wp, stress(3, 3) = 0.0_wp
      !> Place of the first point
      integer :: first = 0
      !> r and z of one side, shape (2, nodes of the side)
      real(wp) :: side(2, 3) = 0.0_wp
      !> Geometry at the points
      type(joint_point_type) :: points(3)
   end type course_type

contains

   !> Stress at the points that does the work which the rule misses, amplitudes, shape (3, points,
   !> modes). Nothing for the rule of one point
   function missed_stress(model, points, planes, field) result(amplitude)
      !> The job, for its laws, and points of its joints, joint by joint
      type(model_type), intent(in) :: model
      type(model_joint_point_type), intent(in) :: points(:)
      !> Planes
      type(planes_type), intent(in) :: planes
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The amplitudes
      real(wp), allocatable :: amplitude(:, :, :)

      type(course_type) :: course
      real(wp), allocatable :: missed(:, :, :)
      integer :: starts(size(points)), first, i, j, n

      allocate (missed, mold=field%stress)
      missed = 0.0_wp
      first = 1
      n = 0
      do while (first <= size(points))
         n = n + 1
         starts(n) = first
         call place_course(model, points, first, course)
         first = first + course%n
      end do
      !$omp parallel do schedule(dynamic, 4) private(course, first, j)
      do i = 1, n
         first = starts(i)
         call place_course(model, points, first, course)
         if (course%n /= points(first)%n_pairs) cycle
         do j = 1, size(missed, 3)
            call take_stresses(model, points, field, j, course)
            if (.not. is_smooth(model, points, field, j, course)) then
               missed(:, first:first + course%n - 1, j) = &
                  missed_by_rule(model, points, field, j, course)
            end if
         end do
      end do
      !$omp end parallel do
      amplitude = analyse(planes, missed)
   end function missed_stress

   !> The joint that begins with a point
   subroutine place_course(model, points, first, course)
      !> The job, for its laws, and points of its joints, joint by joint
      type(model_type), intent(in) :: model
      type(model_joint_point_type), intent(in) :: points(:)
      !> Its first point
      integer, intent(in) :: first
      !> Takes the geometry
      type(course_type), intent(out) :: course

      real(wp) :: w(3)

      associate (point => points(first))
         course%first = first
         call joint_rule(model%joint_materials(point%material)%rule, point%n_pairs, course%n, &
            course%x, w)
         course%side(:, :point%n_pairs) = model%mesh%coordinates(:, &
            point%nodes(lower_node(:point%n_pairs)))
         course%points(:course%n) = points(first:first + course%n - 1)%joint_point_type
      end associate
   end subroutine place_course

   !> Trial stresses of a joint on a plane, and what the law admits of them
   subroutine take_stresses(model, points, field, plane, course)
      !> The job, for its laws, and points of its joints, joint by joint
      type(model_type), intent(in) :: model
      type(model_joint_point_type), intent(in) :: points(:)
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The plane
      integer, intent(in) :: plane
      !> The joint
      type(course_type), intent(inout) :: course

      integer :: i, k

      do i = 1, course%n
         k = course%first + i - 1
         course%trial(:, i) = trial_of(law_at(points(k), model%joint_materials(points(k)%material)), k, plane, &
            field%jump(:, k, plane), field)
         course%stress(:, i) = law_stress(model, points, field, plane, course, course%x(i))
      end do
   end subroutine take_stresses

   !> Stress that the law admits between the points, by the memory of the nearest one
   function law_stress(model, points, field, plane, course, x) result(stress)
      !> The job, for its laws, and points of its joints, joint by joint
      type(model_type), intent(in) :: model
      type(model_joint_point_type), intent(in) :: points(:)
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The plane
      integer, intent(in) :: plane
      !> The joint, its trial stresses there
      type(course_type), intent(in) :: course
      !> Natural coordinate
      real(wp), intent(in) :: x
      !> tau_xi, sigma, tau_theta
      real(wp) :: stress(3)

      real(wp) :: tangent(3, 3), shape(course%n), trial(3)
      integer :: i, k

      k = course%first - 1 + minloc(abs(course%x(:course%n) - x), 1)
      shape = lagrange(course%x(:course%n), x)
      trial = 0.0_wp
      do i = 1, course%n
         trial = trial + course%trial(:, i)*shape(i)
      end do
      call admit(law_at(points(k), model%joint_materials(points(k)%material)), field%memory(k, plane), trial, stress, tangent)
   end function law_stress

   !> Whether the stresses at the ends and in the middle lie on the course of those at the points
   logical function is_smooth(model, points, field, plane, course)
      !> The job, for its laws, and points of its joints, joint by joint
      type(model_type), intent(in) :: model
      type(model_joint_point_type), intent(in) :: points(:)
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The plane
      integer, intent(in) :: plane
      !> The joint
      type(course_type), intent(in) :: course

      real(wp) :: stress(3)
      integer :: i

      is_smooth = .true.
      do i = -1, 1
         stress = law_stress(model, points, field, plane, course, real(i, wp)) &
            - matmul(course%stress(:, :course%n), lagrange(course%x(:course%n), real(i, wp)))
         is_smooth = is_smooth .and. maxval(abs(stress)) <= smooth*maxval(abs(course%trial(:, &
            :course%n)))
      end do
   end function is_smooth

   !> Stresses at the points whose work is that of the stresses between the points, less what the
   !> rule makes of them
   function missed_by_rule(model, points, field, plane, course) result(missed)
      !> The job, for its laws, and points of its joints, joint by joint
      type(model_type), intent(in) :: model
      type(model_joint_point_type), intent(in) :: points(:)
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The plane
      integer, intent(in) :: plane
      !> The joint
      type(course_type), intent(in) :: course
      !> Stresses, shape (3, points)
      real(wp) :: missed(3, course%n)

      type(joint_point_type) :: point
      real(wp) :: work(3, course%n), t(n_gauss), w(n_gauss), x, stress(3), matrix(course%n, course%n)
      integer :: piece, i, j, node

      call gauss_rule(n_gauss, t, w)
      work = 0.0_wp
      do piece = 1, n_pieces
         do i = 1, n_gauss
            x = -1.0_wp + (2.0_wp*piece - 1.0_wp + t(i))/n_pieces
            point = new_joint_point(course%side(:, :course%n), x, w(i)/n_pieces)
            stress = law_stress(model, points, field, plane, course, x)
            do j = 1, course%n
               work(:, j) = work(:, j) + point%weight*stress*point%shape(j)
            end do
         end do
      end do
      do i = 1, course%n
         associate (at => course%points(i))
            matrix(:, i) = at%weight*at%shape(:course%n)
            do j = 1, course%n
               work(:, j) = work(:, j) - at%weight*course%stress(:, i)*at%shape(j)
            end do
         end associate
      end do
      ! what a point on the axis has no weight for: its stress does no work, whatever it is
      do i = 1, course%n
         associate (at => course%points(i))
            if (at%weight > epsilon(1.0_wp)*maxval(course%points(:course%n)%weight)) cycle
            node = maxloc(abs(at%shape(:course%n)), 1)
            matrix(node, :) = 0.0_wp
            matrix(node, i) = 1.0_wp
            work(:, node) = 0.0_wp
         end associate
      end do
      missed = solved(matrix, work)
   end function missed_by_rule

   !> x with sum over i of matrix(a, i) x(:, i) = right(:, a), by elimination with row exchanges:
   !> a function may vanish at a point
   pure function solved(matrix, right) result(x)
      !> The matrix, shape (n, n)
      real(wp), intent(in) :: matrix(:, :)
      !> Right sides, shape (3, n)
      real(wp), intent(in) :: right(:, :)
      !> The solution, shape (3, n)
      real(wp) :: x(size(right, 1), size(right, 2))

      real(wp) :: a(size(matrix, 1), size(matrix, 2))
      integer :: i, j, p

      a = matrix
      x = right
      do i = 1, size(a, 1)
         p = i - 1 + maxloc(abs(a(i:, i)), 1)
         a([i, p], :) = a([p, i], :)
         x(:, [i, p]) = x(:, [p, i])
         do j = 1, size(a, 1)
            if (j == i) cycle
            x(:, j) = x(:, j) - a(j, i)/a(i, i)*x(:, i)
            a(j, :) = a(j, :) - a(j, i)/a(i, i)*a(i, :)
         end do
      end do
      do i = 1, size(a, 1)
         x(:, i) = x(:, i)/a(i, i)
      end do
   end function solved

end module axijoint_analysis_fine_joint_quadrature
