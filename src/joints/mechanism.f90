!> Mechanisms: rigid motions that joints as they stick, slip and stand open do not resist. What they
!> do not resist is none only if no load acts on it, at any size of the load
module axijoint_joints_mechanism
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : admit
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_joints_field, only : joint_field_type, seen_by_law
   use axijoint_joints_planes, only : synthesize, analyse
   use axijoint_joints_scene, only : scene_type, views
   use axijoint_linalg_lapack, only : symmetric_eigen
   implicit none
   private
   public :: mechanism_type, find_mechanism

   !> A motion is not resisted if the resistance to it is less than this share of that of sticking joints
   real(wp), parameter :: no_resistance = 1.0e-7_wp
   !> A force on a motion is rounding below this share of the loads that add to it, and this share of what joint
   !> stresses, of all harmonics together, may leave in it
   real(wp), parameter :: rounding = 1.0e-13_wp, leftover = 1.0e-15_wp

   !> Motions that nothing resists, in shares of the floating motions of a scene
   type :: mechanism_type
      !> Whether a load acts on one
      logical :: loaded = .false.
      !> The motion under the load, shape (floating motions)
      real(wp), allocatable :: motion(:)
      !> Motions that no load acts on, one column each, shape (floating motions, any)
      real(wp), allocatable :: idle(:, :)
   end type mechanism_type

contains

   !> Find the motions that a state does not resist
   subroutine find_mechanism(scene, field, mechanism)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> The mechanism
      type(mechanism_type), intent(out) :: mechanism

      real(wp), dimension(size(scene%floating), size(scene%floating)) :: resistance, elastic, to_unit, square
      real(wp), dimension(size(scene%floating)) :: eigenvalue, force, least, direction
      integer :: k, n, info

      n = size(scene%floating)
      allocate (mechanism%motion(n), mechanism%idle(n, 0))
      mechanism%motion = 0.0_wp
      if (n == 0) return
      call resist(scene, field, resistance, elastic)
      call act(scene, field, force, least)
      call symmetric_eigen(elastic, eigenvalue, info)
      do k = 1, n
         to_unit(:, k) = elastic(:, k)/sqrt(eigenvalue(k))
      end do
      resistance = matmul(transpose(to_unit), matmul(resistance, to_unit))
      square = matmul(transpose(resistance), resistance)
      call symmetric_eigen(square, eigenvalue, info)
      do k = 1, n
         if (eigenvalue(k) > no_resistance**2) exit
         direction = matmul(to_unit, square(:, k))
         if (abs(dot_product(direction, force)) > dot_product(abs(direction), least)) then
            mechanism%loaded = .true.
            mechanism%motion = mechanism%motion + dot_product(direction, force)*direction
         else
            mechanism%idle = reshape([mechanism%idle, direction], [n, size(mechanism%idle, 2) + 1])
         end if
      end do
   end subroutine find_mechanism

   !> Work of the joints on each motion when another grows, by the derivatives of their laws and if they
   !> all stick; stiffnesses are those of the structure
   subroutine resist(scene, field, resistance, elastic)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> The works, shape (motions, motions)
      real(wp), intent(out) :: resistance(:, :), elastic(:, :)

      real(wp), allocatable :: tangent(:, :, :, :), amplitude(:, :, :), stress(:, :, :)
      integer :: j, k, z

      allocate (tangent(3, 3, size(scene%points), size(field%jump, 3)))
      call linearize(scene, field, tangent)
      allocate (amplitude, mold=field%excess)
      do z = 1, size(scene%floating)
         amplitude = 0.0_wp
         do k = 1, size(scene%points)
            amplitude(:, k, scene%floating(z)%mode) = scene%points(k)%base*scene%floating(z)%jump(:, k)
         end do
         elastic(:, z) = works(scene, amplitude)
         stress = synthesize(scene%planes, amplitude)
         do j = 1, size(stress, 3)
            do k = 1, size(stress, 2)
               stress(:, k, j) = matmul(tangent(:, :, k, j), stress(:, k, j))
            end do
         end do
         resistance(:, z) = works(scene, analyse(scene%planes, stress))
      end do
   end subroutine resist

   !> Derivatives of the stress admitted by the trial stress
   subroutine linearize(scene, field, tangent)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> The derivatives, shape (3, 3, points, planes)
      real(wp), intent(out) :: tangent(:, :, :, :)

      real(wp) :: view(size(scene%points)), admitted(3)
      integer :: j, k

      view = views(scene, field%share)
      do j = 1, size(tangent, 4)
         do k = 1, size(tangent, 3)
            call admit(scene%model%joint_materials(scene%points(k)%material)%law, field%memory(k, j), &
                       seen_by_law(scene%model, scene%points, k, j, view(k), field), admitted, tangent(:, :, k, j))
         end do
      end do
   end subroutine linearize

   !> Force that acts on each motion and is not balanced by joints, and what of it may be rounding
   subroutine act(scene, field, force, least)
      !> The scene, with the work of its loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> Both, shape (motions)
      real(wp), intent(out) :: force(:), least(:)

      real(wp), allocatable :: largest(:, :, :)
      integer :: m

      allocate (largest, mold=field%excess)
      do m = 1, size(largest, 3)
         largest(:, :, m) = max(scene%loads%stress, maxval(abs(field%stress), 3))
      end do
      force = scene%loads%work - works(scene, analyse(scene%planes, field%stress))
      least = rounding*scene%loads%size + leftover*works(scene, largest, sizes=.true.)
   end subroutine act

   !> Work of joint stress on unit motions, or that of its sizes
   function works(scene, stress, sizes) result(work)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> Amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> Whether all terms are taken as positive; false if absent
      logical, intent(in), optional :: sizes
      !> Shape (motions)
      real(wp) :: work(size(scene%floating))

      real(wp) :: jump(3)
      integer :: k, z

      work = 0.0_wp
      do z = 1, size(work)
         associate (motion => scene%floating(z))
            do k = 1, size(scene%points)
               jump = motion%jump(:, k)
               if (present(sizes)) jump = abs(jump)
               work(z) = work(z) + scene%points(k)%weight*dot_product(jump, stress(:, k, motion%mode))
            end do
            work(z) = circle_integral(scene%equations%modes(motion%mode)%harmonic)*work(z)
         end associate
      end do
   end function works

end module axijoint_joints_mechanism
