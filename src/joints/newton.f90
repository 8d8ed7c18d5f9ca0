!> Semi-smooth Newton iteration for the joint stress of all modes together, on
!> the condensed structure.
!>
!> The unknowns are the amplitudes e of the excess stress and the stress P on the
!> planes. They are the solution if P is what the law admits of P + gamma (t - P),
!> with the elastic stress t = k d of the jumps d, and e the amplitudes of t - P.
!> The solution is the same for every gamma in (0, 1], the way to it is not: a
!> point that slips and comes back by a small jump must stick before it slips
!> the other way, but a stiff joint makes much stress of a small jump. So
!> gamma k is about the stiffness of the bodies (the parameter of an augmented
!> Lagrangian: Alart and Curnier, Comput. Methods Appl. Mech. Eng. 92, 1991).
module axijoint_joints_newton
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : admit
   use axijoint_joints_field, only : joint_field_type, trial_of
   use axijoint_joints_planes, only : planes_type, synthesize, analyse
   use axijoint_joints_response, only : response_type, jumps
   use axijoint_joints_scene, only : scene_type, evaluate
   use axijoint_linalg_gmres, only : operator_type, gmres
   implicit none
   private
   public :: newton_type, new_newton, newton_step, correction, at_points

   !> Most products of a linear solution
   integer, parameter :: most_products = 400
   !> gamma k, in stiffnesses of the bodies
   real(wp), parameter :: augmentation = 10.0_wp
   !> Values on the planes from which on threads are worth their start
   integer, parameter :: worth_threads = 5000
   !> Shortest part of a step
   real(wp), parameter :: shortest = 1.0_wp/8.0_wp

   !> Laws of all points, linear about an iterate: P changes by `by_jump` times the
   !> change of the jumps, and by `rest`
   type :: newton_type
      !> Derivatives of P and of the excess stress k d - P by the jumps, shape
      !> (3, 3, points, planes)
      real(wp), allocatable :: by_jump(:, :, :, :), slope(:, :, :, :)
      !> Change of P at the same jumps, shape (3, points, planes)
      real(wp), allocatable :: rest(:, :, :)
      !> Amplitudes of k d - P - `rest` that are not transferred, shape (3, points, modes)
      real(wp), allocatable :: residual(:, :, :)
      !> Size of what is missing to the solution, in P and in e
      real(wp) :: merit = huge(1.0_wp)
   end type newton_type

   !> I - A E' S F: derivative of the excess stress that is not yet transferred,
   !> with the synthesis S, the slopes E' of the laws and the analysis A
   type, extends(operator_type) :: derivative_type
      !> Flexibilities, planes, slopes on the planes, shape (3, 3, points, planes)
      type(response_type), pointer :: response => null()
      type(planes_type), pointer :: planes => null()
      real(wp), pointer :: slope(:, :, :, :) => null()
   contains
      !> Product with amplitudes of excess stress
      procedure :: apply
   end type derivative_type

contains

   !> Product with amplitudes of excess stress
   subroutine apply(self, x, y)
      !> The operator
      class(derivative_type), intent(in) :: self
      !> Amplitudes, 3 x points x modes
      real(wp), intent(in), contiguous :: x(:)
      !> The product
      real(wp), intent(out), contiguous :: y(:)

      real(wp), allocatable :: excess(:, :, :)

      excess = reshape(x, [3, size(self%slope, 3), size(x)/(3*size(self%slope, 3))])
      excess = excess - analyse(self%planes, at_points(self%slope, &
         synthesize(self%planes, jumps(self%response, excess, free=.false.))))
      y = reshape(excess, [size(y)])
   end subroutine apply

   !> Products of the matrices of all points and planes with their vectors
   pure function at_points(matrix, vector) result(product)
      !> Matrices, shape (3, 3, points, planes), and vectors, shape (3, points, planes)
      real(wp), intent(in) :: matrix(:, :, :, :), vector(:, :, :)
      !> Products, same shape
      real(wp) :: product(3, size(vector, 2), size(vector, 3))

      integer :: j, k

      do j = 1, size(vector, 3)
         do k = 1, size(vector, 2)
            product(:, k, j) = matmul(matrix(:, :, k, j), vector(:, k, j))
         end do
      end do
   end function at_points

   !> Linearize the laws at the jumps of an iterate
   function new_newton(scene, field) result(newton)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> The iterate, its jumps evaluated
      type(joint_field_type), intent(in) :: field
      !> The laws about it
      type(newton_type) :: newton

      real(wp) :: gamma, trial(3), admitted(3), tangent(3, 3), inverse(3, 3), identity(3, 3)
      real(wp), allocatable :: excess(:, :, :), missing(:, :, :)
      integer :: i, j, k

      gamma = min(1.0_wp, augmentation/max(tiny(1.0_wp), field%share*scene%proportion))
      identity = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      allocate (newton%by_jump(3, 3, size(field%jump, 2), size(field%jump, 3)))
      allocate (newton%slope, mold=newton%by_jump)
      allocate (newton%rest, excess, missing, mold=field%jump)
      !$omp parallel do private(i, k, trial, admitted, tangent, inverse) if (size(field%jump) >= worth_threads)
      do j = 1, size(field%jump, 3)
         do k = 1, size(field%jump, 2)
            associate (law => scene%model%joint_materials(scene%points(k)%material)%law, &
                       stress => field%carried(:, k, j))
               trial = trial_of(scene%model, scene%points, k, j, field%jump(:, k, j), field)
               call admit(law, field%memory(k, j), stress + gamma*(trial - stress), admitted, tangent)
               inverse = inverse_of(identity - (1.0_wp - gamma)*tangent)
               missing(:, k, j) = admitted - stress
               newton%rest(:, k, j) = matmul(inverse, missing(:, k, j))
               tangent = gamma*field%share*matmul(inverse, tangent)
               do i = 1, 3
                  newton%by_jump(:, i, k, j) = tangent(:, i)*law%stiffness(i)
                  newton%slope(:, i, k, j) = -newton%by_jump(:, i, k, j)
                  newton%slope(i, i, k, j) = newton%slope(i, i, k, j) + law%stiffness(i)
               end do
               excess(:, k, j) = law%stiffness*field%jump(:, k, j) + field%initial(:, k) - stress
            end associate
         end do
      end do
      !$omp end parallel do
      newton%residual = analyse(scene%planes, excess) - field%excess
      newton%merit = merit_of(scene, newton%residual, missing)
      newton%residual = newton%residual - analyse(scene%planes, newton%rest)
   end function new_newton

   !> Inverse of a matrix, by its adjugate
   pure function inverse_of(matrix) result(inverse)
      !> The matrix
      real(wp), intent(in) :: matrix(3, 3)
      !> Its inverse
      real(wp) :: inverse(3, 3)

      associate (a => matrix)
         inverse(1, :) = cross(a(:, 2), a(:, 3))
         inverse(2, :) = cross(a(:, 3), a(:, 1))
         inverse(3, :) = cross(a(:, 1), a(:, 2))
         inverse = inverse/dot_product(a(:, 1), inverse(1, :))
      end associate

   contains

      !> Vector product
      pure function cross(a, b) result(c)
         !> Factors
         real(wp), intent(in) :: a(3), b(3)
         !> The product
         real(wp) :: c(3)

         c = a([2, 3, 1])*b([3, 1, 2]) - a([3, 1, 2])*b([2, 3, 1])
      end function cross

   end function inverse_of

   !> Size of what is missing, by the areas of the points
   pure real(wp) function merit_of(scene, residual, missing) result(merit)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> In e: amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: residual(:, :, :)
      !> In P: shape (3, points, planes)
      real(wp), intent(in) :: missing(:, :, :)

      integer :: k

      merit = 0.0_wp
      do k = 1, size(scene%points)
         merit = merit + scene%points(k)%weight*(sum(residual(:, k, :)**2) &
                                                 + sum(missing(:, k, :)**2)/size(missing, 3))
      end do
   end function merit_of

   !> Change of the excess stress that would balance the residual were the laws linear
   function correction(scene, newton, tolerance) result(change)
      !> What does not change
      type(scene_type), intent(in), target :: scene
      !> Laws about the iterate, and its residual
      type(newton_type), intent(in), target :: newton
      !> Tolerance of the linear solution
      real(wp), intent(in) :: tolerance
      !> The change, shape (3, points, modes)
      real(wp), allocatable :: change(:, :, :)

      type(derivative_type) :: derivative
      real(wp), allocatable :: x(:)
      real(wp) :: reduction
      integer :: n_products

      derivative%response => scene%response
      derivative%planes => scene%planes
      derivative%slope => newton%slope
      x = reshape(newton%residual, [size(newton%residual)])
      call gmres(derivative, reshape(newton%residual, [size(x)]), tolerance, min(most_products, size(x)), x, &
                 n_products, reduction)
      change = reshape(x, shape(newton%residual))
   end function correction

   !> One step, shortened until what is missing falls, but not below a part of it:
   !> the shortest is made even if it does not help. A step to jumps that are no
   !> state is not made.
   subroutine newton_step(scene, tolerance, largest, newton, field, residual, made, ran)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Tolerance of the linear solution
      real(wp), intent(in) :: tolerance
      !> Jumps beyond which there is no state
      real(wp), intent(in) :: largest
      !> Laws about the iterate; about the new one on return
      type(newton_type), intent(inout) :: newton
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> Excess stress not transferred
      real(wp), intent(inout) :: residual(:, :, :)
      !> Whether a step was made, and whether the whole step ran away
      logical, intent(out) :: made, ran

      real(wp), allocatable :: start(:, :, :), carried(:, :, :), change(:, :, :), change_carried(:, :, :)
      real(wp) :: length, before

      change = correction(scene, newton, tolerance)
      change_carried = newton%rest + at_points(newton%by_jump, &
         synthesize(scene%planes, jumps(scene%response, change, free=.false.)))
      start = field%excess
      carried = field%carried
      before = newton%merit
      length = 1.0_wp
      ran = .false.
      do
         field%excess = start + length*change
         field%carried = carried + length*change_carried
         call evaluate(scene, field, residual)
         newton = new_newton(scene, field)
         made = maxval(abs(field%jump)) <= largest
         if (.not. made) ran = .true.
         if (made .and. newton%merit < before .or. length <= shortest) exit
         length = 0.5_wp*length
      end do
      if (made) return
      field%excess = start
      field%carried = carried
      call evaluate(scene, field, residual)
      newton = new_newton(scene, field)
   end subroutine newton_step

end module axijoint_joints_newton
