!> What iteration, planes and harmonics leave of the error of joints, estimated by
!> one linear step each on the condensed structure: with the residual that is
!> left, with the residual on more planes, with the excess stress above M
module axijoint_joints_joint_errors
   use omp_lib, only : omp_get_wtime
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric
   use axijoint_joints_field, only : joint_field_type, admit_jump
   use axijoint_joints_newton, only : newton_type, new_newton, correction, at_points
   use axijoint_joints_planes, only : planes_type, new_planes, synthesize, analyse
   use axijoint_joints_response, only : jumps
   use axijoint_joints_scene, only : scene_type, evaluate, views
   use axijoint_linalg_lapack, only : matrix_vector
   use axijoint_model_model, only : method_newton
   implicit none
   private
   public :: joint_error_type, joint_errors_type, measure_type, estimate_joint_errors, change_of_displacement

   !> Tolerance of the linear solutions: of an error one digit is enough
   real(wp), parameter :: tolerance = 0.1_wp

   !> An error of the joints
   type :: joint_error_type
      !> Of the joint stress, over the largest of all increments; negative if it is not known
      real(wp) :: stress = -1.0_wp
      !> Of displacements: root mean square of the jumps, over the largest displacement, or of the work of
      !> the loads, over that, whichever is more
      real(wp) :: displacement = -1.0_wp
      !> Time that the estimate took [second]
      real(wp) :: seconds = 0.0_wp
   end type joint_error_type

   !> What errors are measured by
   type :: measure_type
      !> Work of the loads [force x length]
      real(wp) :: work = 0.0_wp
      !> Largest displacement [length]
      real(wp) :: displacement = 0.0_wp
      !> Largest joint stress, of all increments [stress]
      real(wp) :: stress = 0.0_wp
   end type measure_type

   !> The errors by what leaves them
   type :: joint_errors_type
      type(joint_error_type) :: iteration, planes, harmonics
   end type joint_errors_type

contains

   !> Estimate the errors of a state in equilibrium on total jumps
   subroutine estimate_joint_errors(scene, field, memory, measure, errors)
      !> What does not change; the loads are in its response
      type(scene_type), intent(inout) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> What its points remembered in its increment, shape (points, planes)
      type(memory_type), intent(in) :: memory(:, :)
      !> What the errors are measured by
      type(measure_type), intent(in) :: measure
      !> The errors
      type(joint_errors_type), intent(out) :: errors

      type(joint_field_type), allocatable :: state
      type(planes_type) :: planes
      type(newton_type) :: newton
      integer :: n, step, method

      method = scene%method
      scene%method = method_newton
      n = scene%model%n_planes - 1
      allocate (state)
      state = on_planes(field, memory, 1, size(field%jump, 3))
      call linearize(scene, state, newton)
      call iteration_error(scene, newton, measure, errors%iteration)
      planes = scene%planes
      step = max(2, (4*maxval(scene%equations%modes%harmonic) + n - 1)/n)  ! for products of harmonics up to 2 M
      scene%planes = new_planes(step*n + 1, scene%equations%modes, whole=planes%folds == 1)
      state = on_planes(field, memory, step, size(scene%planes%angle))
      call planes_error(scene, state, newton, measure, errors%planes)
      call harmonics_error(scene, state, newton, step*n + 1, measure, errors%harmonics)
      scene%planes = planes
      scene%method = method
   end subroutine estimate_joint_errors

   !> A state with so many times more planes. A new plane remembers what the plane
   !> before it does
   pure function on_planes(field, memory, step, count) result(state)
      !> The state
      type(joint_field_type), intent(in) :: field
      !> What its points remembered, shape (points, planes)
      type(memory_type), intent(in) :: memory(:, :)
      !> How many times, and the number of planes then
      integer, intent(in) :: step, count
      !> The state there; its jumps and stresses are those of the plane before
      type(joint_field_type) :: state

      integer :: j, place(count)

      place = [((j - 1)/step + 1, j=1, count)]
      state = field
      state%memory = memory(:, place)
      state%jump = field%jump(:, :, place)
      state%stress = field%stress(:, :, place)
      state%carried = state%stress
      state%moved = field%moved(:, :, place)
      state%state = field%state(:, place)
      state%share = 1.0_wp
   end function on_planes

   !> Linearize the laws about a state
   subroutine linearize(scene, state, newton)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> The state; takes jumps and stresses on the planes of the scene
      type(joint_field_type), intent(inout) :: state
      !> The laws about it
      type(newton_type), intent(out) :: newton

      real(wp), allocatable :: residual(:, :, :)

      allocate (residual, mold=state%excess)
      call evaluate(scene, state, residual)
      state%carried = state%stress
      newton = new_newton(scene, state)
   end subroutine linearize

   !> Error by the residual that the iteration left
   subroutine iteration_error(scene, newton, measure, error)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> The laws about the state
      type(newton_type), intent(in) :: newton
      !> What the error is measured by
      type(measure_type), intent(in) :: measure
      !> The error
      type(joint_error_type), intent(out) :: error

      real(wp) :: clock

      clock = omp_get_wtime()
      call effect(scene, newton, measure, error)
      error%seconds = omp_get_wtime() - clock
   end subroutine iteration_error

   !> Error by too few planes: by the residual on more of them
   subroutine planes_error(scene, state, newton, measure, error)
      !> What does not change; its planes are more than those of the state
      type(scene_type), intent(in) :: scene
      !> The state; takes jumps and stresses on these planes
      type(joint_field_type), intent(inout) :: state
      !> Takes the laws about it
      type(newton_type), intent(out) :: newton
      !> What the error is measured by
      type(measure_type), intent(in) :: measure
      !> The error
      type(joint_error_type), intent(out) :: error

      real(wp) :: clock

      clock = omp_get_wtime()
      call linearize(scene, state, newton)
      call effect(scene, newton, measure, error)
      error%seconds = omp_get_wtime() - clock
   end subroutine planes_error

   !> Error by the harmonics above M: the excess stress has some, up to 2 M are looked
   !> at. They give jumps of their own, and those change the lower harmonics.
   subroutine harmonics_error(scene, state, newton, n_planes, measure, error)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> The state, and the laws about it, on many planes
      type(joint_field_type), intent(in) :: state
      type(newton_type), intent(inout) :: newton
      !> Planes from 0 to pi
      integer, intent(in) :: n_planes
      !> What the error is measured by
      type(measure_type), intent(in) :: measure
      !> The error
      type(joint_error_type), intent(out) :: error

      type(mode_type), allocatable :: modes(:)
      type(planes_type) :: planes
      type(joint_field_type), allocatable :: other
      real(wp), allocatable :: excess(:, :, :), more(:, :, :), high(:, :, :)
      real(wp) :: clock

      clock = omp_get_wtime()
      modes = modes_above(scene%equations%modes)
      if (size(modes) == 0) then  ! nothing repeats round the circle: harmonic 0 alone
         error = joint_error_type(0.0_wp, 0.0_wp, 0.0_wp)
         return
      end if
      planes = planes_above(scene, modes, n_planes)
      allocate (other)
      other = state
      excess = state%jump  ! for its shape
      more = state%jump
      call admit_jump(scene%model, scene%points, state%jump, views(scene, 1.0_wp), other, excess)
      high = synthesize(planes, jumps_above(scene, modes, analyse(planes, excess)))
      call admit_jump(scene%model, scene%points, state%jump + high, views(scene, 1.0_wp), other, more)
      newton%rest = at_points(newton%by_jump, high)
      ! what k times these jumps gives belongs to their own harmonics
      newton%residual = analyse(scene%planes, more - excess)
      call effect(scene, newton, measure, error, high)
      error%seconds = omp_get_wtime() - clock
   end subroutine harmonics_error

   !> The planes of the scene for the modes above M
   pure function planes_above(scene, modes, n_planes) result(planes)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Modes above M
      type(mode_type), intent(in) :: modes(:)
      !> Planes from 0 to pi
      integer, intent(in) :: n_planes
      !> The planes, for these modes alone
      type(planes_type) :: planes

      associate (below => scene%equations%modes)
         planes = new_planes(n_planes, [below, modes], whole=scene%planes%folds == 1)
         planes%meridional = planes%meridional(size(below) + 1:, :)
         planes%circumferential = planes%circumferential(size(below) + 1:, :)
         planes%meridional_back = planes%meridional_back(:, size(below) + 1:)
         planes%circumferential_back = planes%circumferential_back(:, size(below) + 1:)
      end associate
   end function planes_above

   !> Modes that follow those of a job, up to 2 M
   pure function modes_above(modes) result(above)
      !> Modes of the job
      type(mode_type), intent(in) :: modes(:)
      !> The next, at most as many
      type(mode_type), allocatable :: above(:)

      integer :: step, last, m, family

      allocate (above(0))
      last = maxval(modes%harmonic)
      if (last == 0) return
      step = minval(modes%harmonic, mask=modes%harmonic > 0)
      do m = last + step, 2*last, step
         do family = family_symmetric, family_antisymmetric
            if (any(modes%family == family .and. modes%harmonic > 0)) above = [above, mode_type(m, family)]
         end do
      end do
   end function modes_above

   !> Jumps that excess stress gives in harmonics whose flexibility was not computed:
   !> that of the highest harmonic, in the share that is left if the stiffness of the
   !> bodies grows like m. Its mean share phi of 1/k is k/(k + K) with that stiffness K.
   function jumps_above(scene, modes, excess) result(jump)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes of the excess stress, shape (3, points, modes)
      real(wp), intent(in), contiguous :: excess(:, :, :)
      !> Amplitudes of the jumps, same shape
      real(wp) :: jump(3, size(excess, 2), size(excess, 3))

      real(wp) :: share, growth
      integer :: i, k, last, n

      last = maxloc(scene%equations%modes%harmonic, 1)
      associate (matrix => scene%response%flexibilities(scene%response%system(last))%matrix)
         share = 0.0_wp
         n = 0
         do k = 1, size(scene%points)
            associate (base => scene%points(k)%base)
               do i = 1, 3
                  if (.not. base(i) > 0.0_wp) cycle
                  share = share + matrix(3*(k - 1) + i, 3*(k - 1) + i)*base(i)
                  n = n + 1
               end do
            end associate
         end do
         share = min(1.0_wp, max(epsilon(1.0_wp), share/max(1, n)))
         do k = 1, size(modes)
            growth = real(modes(k)%harmonic, wp)/scene%equations%modes(last)%harmonic
            call matrix_vector(matrix, excess(:, :, k), jump(:, :, k))
            jump(:, :, k) = jump(:, :, k)/(share + growth*(1.0_wp - share))
         end do
      end associate
   end function jumps_above

   !> Change of joint stress and of displacements if the laws were linear
   subroutine effect(scene, newton, measure, error, high)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> The laws about the state, with the residual that changes it
      type(newton_type), intent(in) :: newton
      !> What the error is measured by
      type(measure_type), intent(in) :: measure
      !> Takes stress and displacement
      type(joint_error_type), intent(out) :: error
      !> Jumps in harmonics above M, shape (3, points, planes); none if absent
      real(wp), intent(in), optional :: high(:, :, :)

      real(wp), allocatable :: change(:, :, :), stress(:, :, :)

      change = correction(scene, newton, tolerance)
      stress = newton%rest + at_points(newton%by_jump, &
         synthesize(scene%planes, jumps(scene%response, change, free=.false.)))
      error%stress = maxval(abs(stress))/max(tiny(1.0_wp), measure%stress)
      error%displacement = change_of_displacement(scene, change, high, measure)
   end subroutine effect

   !> Change of displacements when the excess stress changes: of the jumps; and of the
   !> work of the loads, by reciprocity that of the change on the jumps that they give
   function change_of_displacement(scene, change, high, measure) result(changed)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Change of the excess stress, shape (3, points, modes)
      real(wp), intent(in), contiguous :: change(:, :, :)
      !> Change of the jumps in harmonics above M, shape (3, points, planes); none if absent
      real(wp), intent(in), optional :: high(:, :, :)
      !> What it is measured by
      type(measure_type), intent(in) :: measure
      !> The larger of both, relative
      real(wp) :: changed

      real(wp), allocatable :: jump(:, :, :)
      real(wp) :: work
      integer :: k, p

      jump = synthesize(scene%planes, jumps(scene%response, change, free=.false.))
      if (present(high)) jump = jump + high
      work = 0.0_wp
      do k = 1, size(change, 3)
         do p = 1, size(change, 2)
            work = work + scene%points(p)%weight*circle_integral(scene%equations%modes(k)%harmonic) &
               *dot_product(change(:, p, k), scene%response%free(:, p, k))
         end do
      end do
      changed = 0.0_wp
      do p = 1, size(jump, 2)
         changed = changed + scene%points(p)%weight*sum(jump(:, p, :)**2)
      end do
      changed = sqrt(changed/(sum(scene%points%weight)*size(jump, 3)))
      changed = max(changed/max(tiny(1.0_wp), measure%displacement), &
                    abs(work)/max(tiny(1.0_wp), abs(measure%work)))
   end function change_of_displacement

end module axijoint_joints_joint_errors
