!> The stress that yielding joints do not admit, at the joint points of the fine mesh, under the
!> displacements of the coarse one
module axijoint_analysis_fine_joints
   use axijoint_analysis_fine_joint_quadrature, only : missed_stress
   use axijoint_analysis_fine_level, only : fine_level_type
   use axijoint_assembly_force, only : joint_jump
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : joint_law_type, memory_type
   use axijoint_fe_shape, only : lagrange
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, new_joint_field, set_initial_stress, &
      admit_jump
   use axijoint_joints_planes, only : synthesize, analyse
   use axijoint_joints_scene, only : scene_type
   use axijoint_model_joint_points, only : model_joint_point_type, joint_rule, law_at, stiffness_ratio
   use axijoint_model_model, only : model_type, can_yield_at
   implicit none
   private
   public :: fine_excess

   !> Joints so much stiffer than the bodies (k h/E) follow the bodies too closely for their jumps
   !> to tell the stress between their points: there the stress is interpolated instead
   real(wp), parameter :: stiff = 30.0_wp

contains

   !> Excess stress of the joints that can yield, amplitudes, shape (3, fine points, modes), with
   !> what the rule of the fine joints misses of it
   subroutine fine_excess(condensed, scene, level, field, displacement, case_factor, points, excess)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Planes
      type(scene_type), intent(in) :: scene
      !> The fine level
      type(fine_level_type), intent(in), target :: level
      !> State of these joints
      type(joint_field_type), intent(in) :: field
      !> Displacement amplitudes of the coarse mesh, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Factors of the load cases
      real(wp), intent(in) :: case_factor(:)
      !> Takes the fine joint points that can yield
      type(model_joint_point_type), allocatable, intent(out) :: points(:)
      !> Takes the stress
      real(wp), allocatable, intent(out) :: excess(:, :, :)

      type(joint_field_type) :: fine_field
      type(joint_law_type), allocatable :: laws(:)
      real(wp), allocatable :: jump(:, :, :), moved(:, :, :), left(:, :, :), base(:, :)
      integer, allocatable :: yielding(:)
      integer :: k

      yielding = pack([(k, k=1, size(level%joint_points))], &
         can_yield_at(level%model, level%joint_points%material))
      points = level%joint_points(yielding)
      allocate (jump(3, size(points), size(displacement, 3)))
      do k = 1, size(displacement, 3)
         jump(:, :, k) = joint_jump(level%on_coarse(yielding), displacement(:, :, k))
      end do
      jump = synthesize(scene%planes, jump)
      fine_field = new_joint_field(size(points), size(jump, 3), size(displacement, 3), &
         size(condensed%floating))
      moved = moved_by(condensed, scene, level%on_coarse(yielding), field%offset)
      fine_field%moved = moved
      call set_initial_stress(level%model, points, case_factor, fine_field)
      call spread_memory(level%model, condensed%points, field%memory, fine_field%memory)
      left = jump  ! for its shape
      laws = law_at(points, level%model%joint_materials(points%material))
      base = reshape([(points(k)%base, k=1, size(points))], [3, size(points)])
      fine_field%jump = jump + moved
      call admit_jump(laws, base, [(1.0_wp, k=1, size(points))], fine_field, left)
      if (stiffness_ratio(condensed%points) > stiff) then
         call spread_stress(level%model, condensed%points, field%stress, fine_field%stress)
         do k = 1, size(points)
            left(:, k, :) = spread(points(k)%base, 2, size(jump, 3))*jump(:, k, :) - &
               fine_field%stress(:, k, :) &
               + spread(fine_field%initial(:, k), 2, size(jump, 3))
         end do
         excess = analyse(scene%planes, left)
      else
         excess = analyse(scene%planes, left) - &
            missed_stress(level%model, points, scene%planes, fine_field)
      end if
   end subroutine fine_excess

   !> Jumps where the parts stand from which displacements count, shape (3, points, planes)
   function moved_by(condensed, scene, points, offset) result(jump)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Points in the joints of the coarse mesh
      type(model_joint_point_type), intent(in) :: points(:)
      !> Shares of the motions
      real(wp), intent(in) :: offset(:)
      !> The jumps
      real(wp), allocatable :: jump(:, :, :)

      real(wp) :: amplitude(3, size(points), size(scene%modes))
      integer :: z

      amplitude = 0.0_wp
      do z = 1, size(condensed%floating)
         associate (motion => condensed%floating(z), &
            of_mode => amplitude(:, :, condensed%floating(z)%mode))
            of_mode = of_mode + offset(z)*joint_jump(points, motion%displacement)
         end associate
      end do
      jump = synthesize(scene%planes, amplitude)
   end function moved_by

   !> Stress at the fine points by the polynomial through that of the points of the coarse joint
   pure subroutine spread_stress(model, points, stress, fine_stress)
      !> The job, for the rules of its joints
      type(model_type), intent(in) :: model
      !> Points of the coarse joints, joint by joint
      type(model_joint_point_type), intent(in) :: points(:)
      !> Their stress, shape (3, points, planes)
      real(wp), intent(in) :: stress(:, :, :)
      !> Stress at the fine points, shape (3, 2 points, planes)
      real(wp), intent(out) :: fine_stress(:, :, :)

      real(wp) :: x(3), w(3), value(3)
      integer :: first, n, half, i, k

      fine_stress = 0.0_wp
      first = 1
      do while (first <= size(points))
         associate (point => points(first))
            call joint_rule(model%joint_materials(point%material)%rule, point%n_pairs, n, x, w)
         end associate
         do half = 1, 2
            do i = 1, n
               value(:n) = lagrange(x(:n), 0.5_wp*x(i) + half - 1.5_wp)
               do k = 1, n
                  associate (to => fine_stress(:, 2*(first - 1) + n*(half - 1) + i, :))
                     to = to + value(k)*stress(:, first - 1 + k, :)
                  end associate
               end do
            end do
         end do
         first = first + n
      end do
   end subroutine spread_stress

   !> Memory of the fine points: slip by the polynomial through that of the points of the coarse
   !> joint, bonds and softening as at the nearest
   pure subroutine spread_memory(model, points, memory, fine_memory)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of the coarse joints, joint by joint
      type(model_joint_point_type), intent(in) :: points(:)
      !> Their memory, shape (points, planes)
      type(memory_type), intent(in) :: memory(:, :)
      !> Memory of the fine points, shape (2 points, planes)
      type(memory_type), intent(inout) :: fine_memory(:, :)

      real(wp) :: x(3), w(3), at, value(3)
      integer :: first, n, half, i, j, k, to

      first = 1
      do while (first <= size(points))
         call joint_rule(model%joint_materials(points(first)%material)%rule, &
            points(first)%n_pairs, n, x, w)
         do half = 1, 2
            do i = 1, n
               to = 2*(first - 1) + n*(half - 1) + i
               at = 0.5_wp*x(i) + half - 1.5_wp
               value(:n) = lagrange(x(:n), at)
               fine_memory(to, :) = memory(first - 1 + minloc(abs(x(:n) - at), 1), :)
               do j = 1, size(memory, 2)
                  fine_memory(to, j)%slip = 0.0_wp
                  do k = 1, n
                     fine_memory(to, j)%slip = fine_memory(to, j)%slip + &
                        value(k)*memory(first - 1 + k, j)%slip
                  end do
               end do
            end do
         end do
         first = first + n
      end do
   end subroutine spread_memory

end module axijoint_analysis_fine_joints
