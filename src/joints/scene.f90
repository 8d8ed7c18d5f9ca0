!> What the joint iterations of all methods share: the condensed structure, and
!> the stress that an iterate leaves without equilibrium
module axijoint_joints_scene
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_force, only : joint_jump
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, same_mode, family_symmetric
   use axijoint_joints_field, only : joint_field_type, admit_jump, admit_trial
   use axijoint_joints_floating, only : floating_motion_type, floating_loads_type
   use axijoint_joints_planes, only : planes_type, synthesize, analyse
   use axijoint_joints_residual, only : measure_type
   use axijoint_joints_response, only : response_type, jumps
   use axijoint_linalg_lapack, only : invert
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type, method_newton, method_transfer
   implicit none
   private
   public :: scene_type, evaluate, views, mismatch_of, elastic_stress, motion_of, share_of_motions, &
             stand_where_they_are

   !> Stiffness k h/E of joints that Newton's method lets the laws see at a time, and that a state is judged by
   real(wp), parameter :: newton_view = 10.0_wp, judged_view = 1.0e2_wp

   !> All that an iteration needs to know and does not change
   type :: scene_type
      !> The job
      type(model_type), pointer :: model => null()
      !> Joint points that can yield
      type(model_joint_point_type), allocatable :: points(:)
      !> Equations of all modes, factored
      type(equations_type), pointer :: equations => null()
      !> Flexibilities, and jumps from the loads
      type(response_type) :: response
      !> Planes of the joint checks
      type(planes_type) :: planes
      !> Rigid motions that only these joints resist
      type(floating_motion_type), allocatable :: floating(:)
      !> Loads on these motions
      type(floating_loads_type) :: loads
      !> What residual forces are measured by
      type(measure_type) :: measure
      !> How joints are brought to equilibrium, one of the `method_` parameters
      integer :: method = method_newton
      !> Stiffness of the joints in proportion to the bodies, k h/E
      real(wp) :: proportion = 0.0_wp
      !> Share of the joint stiffness that the laws see first
      real(wp) :: first_share = 1.0_wp
   end type scene_type

contains

   !> Excess stress that is not yet transferred, from the jumps that loads and
   !> transferred stress give
   subroutine evaluate(scene, field, residual, judged)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> State of the joints; jumps and stresses follow its excess stress
      type(joint_field_type), intent(inout) :: field
      !> The amplitudes, shape (3, points, modes)
      real(wp), intent(out) :: residual(:, :, :)
      !> Whether the laws see the jumps as a state is judged; false if absent
      logical, intent(in), optional :: judged

      real(wp), allocatable :: total(:, :, :), excess(:, :, :)
      real(wp) :: view(size(scene%points))

      total = synthesize(scene%planes, jumps(scene%response, field%excess, free=.true.))
      if (any(abs(field%offset) > 0.0_wp)) then
         field%moved = synthesize(scene%planes, motion_of(scene, field%offset))
         total = total + field%moved
      end if
      if (scene%method == method_transfer) then
         call accumulate(scene, total, field, residual)
      else
         excess = total  ! for its shape
         view = views(scene, field%share)
         if (present(judged)) view = min(1.0_wp, judged_view/max(tiny(1.0_wp), scene%points%proportion))
         call admit_jump(scene%model, scene%points, total, view, field, excess)
         residual = (1.0_wp - field%leak)*analyse(scene%planes, excess) - field%excess
      end if
   end subroutine evaluate

   !> How much of a jump the law of each point sees: joints that are much stiffer than the bodies would
   !> make large stresses of the jumps on the way
   pure function views(scene, share) result(view)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Share of the joint stiffness that the laws see
      real(wp), intent(in) :: share
      !> > 0 and <= 1, shape (points)
      real(wp) :: view(size(scene%points))

      integer :: k

      do k = 1, size(view)
         associate (point => scene%points(k))
            view(k) = min(1.0_wp, maxval(point%base)/max(tiny(1.0_wp), share*maxval(stiffness_of(scene, k))))
            if (scene%method == method_newton) then
               view(k) = min(view(k), newton_view/max(tiny(1.0_wp), share*point%proportion))
            end if
         end associate
      end do
   end function views

   !> Stiffness of the law of a point
   pure function stiffness_of(scene, k) result(stiffness)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> The point
      integer, intent(in) :: k
      !> Along xi, eta, theta
      real(wp) :: stiffness(3)

      stiffness = scene%model%joint_materials(scene%points(k)%material)%law%stiffness
   end function stiffness_of

   !> Relative displacements of the bodies, less those that the laws saw: rounding of the
   !> condensed structure. It grows with k h/E, because the structure is condensed with its joints
   !> closed
   function mismatch_of(scene, field, displacement) result(jump)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Displacement amplitudes of the bodies, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Amplitudes, shape (3, points, modes)
      real(wp) :: jump(3, size(scene%points), size(displacement, 3))

      integer :: k

      jump = -jumps(scene%response, field%excess, free=.true.)
      do k = 1, size(displacement, 3)
         jump(:, :, k) = jump(:, :, k) + joint_jump(scene%points, displacement(:, :, k))
      end do
   end function mismatch_of

   !> Jumps of the floating motions
   pure function motion_of(scene, share) result(jump)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> Share of each motion
      real(wp), intent(in) :: share(:)
      !> Amplitudes, shape (3, points, modes)
      real(wp) :: jump(3, size(scene%points), size(scene%response%free, 3))

      integer :: z

      jump = 0.0_wp
      do z = 1, size(scene%floating)
         associate (floating => scene%floating(z))
            jump(:, :, floating%mode) = jump(:, :, floating%mode) + share(z)*floating%jump
         end associate
      end do
   end function motion_of

   !> Let displacements count from where the parts stand: with the rigid motions taken away, small strains of
   !> stiff bodies on soft joints are not lost to rounding. The state does not change
   subroutine stand_where_they_are(scene, field)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(inout) :: field

      real(wp) :: motion(3, size(scene%points), size(scene%equations%modes)), share(size(scene%floating))
      integer :: k, z

      if (size(scene%floating) == 0) return
      share = share_of_motions(scene, jumps(scene%response, field%excess, free=.true.))
      motion = motion_of(scene, share)
      do k = 1, size(scene%points)
         do z = 1, 3
            field%excess(z, k, :) = field%excess(z, k, :) - scene%points(k)%base(z)*motion(z, k, :)
         end do
      end do
      field%offset = field%offset + share
   end subroutine stand_where_they_are

   !> Share of the floating motions in jumps: what is left of these does no work on them in elastic joints
   function share_of_motions(scene, jump) result(share)
      !> The scene
      type(scene_type), intent(in) :: scene
      !> Amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: jump(:, :, :)
      !> Share of each motion; zero if joints do not tell them apart
      real(wp) :: share(size(scene%floating))

      real(wp) :: matrix(size(share), size(share)), unit(size(share))
      integer :: info, z

      share = 0.0_wp
      if (size(share) == 0) return
      do z = 1, size(share)
         unit = 0.0_wp
         unit(z) = 1.0_wp
         matrix(:, z) = works_of(motion_of(scene, unit))
      end do
      call invert(matrix, info)
      if (info == 0) share = matmul(matrix, works_of(jump))

   contains

      !> Work of elastic joints on the motions
      function works_of(jump) result(work)
         !> Amplitudes of their jumps, shape (3, points, modes)
         real(wp), intent(in) :: jump(:, :, :)
         !> Shape (motions)
         real(wp) :: work(size(scene%floating))

         integer :: i, p

         work = 0.0_wp
         do i = 1, size(work)
            associate (floating => scene%floating(i))
               do p = 1, size(scene%points)
                  work(i) = work(i) + scene%points(p)%weight &
                     *sum(floating%jump(:, p)*scene%points(p)%base*jump(:, p, floating%mode))
               end do
            end associate
         end do
      end function works_of

   end function share_of_motions

   !> Joint stress of the loads if all joints held, with the stress before loading
   function elastic_stress(scene, field) result(stress)
      !> What does not change; the loads are in its response
      type(scene_type), intent(in) :: scene
      !> State of the joints, for the stress before loading
      type(joint_field_type), intent(in) :: field
      !> Amplitudes, shape (3, points, modes)
      real(wp), allocatable :: stress(:, :, :)

      integer :: k, p

      allocate (stress, mold=scene%response%free)
      do k = 1, size(stress, 3)
         do p = 1, size(stress, 2)
            stress(:, p, k) = scene%points(p)%base*scene%response%free(:, p, k)
         end do
      end do
      do k = 1, size(scene%equations%modes)
         if (same_mode(scene%equations%modes(k), mode_type(0, family_symmetric))) then
            stress(:, :, k) = stress(:, :, k) + field%initial
         end if
      end do
   end function elastic_stress

   !> Steps 2 to 4 of the paper: the stress is accumulated over the iterations,
   !> and what the law cuts off goes to the next residual
   subroutine accumulate(scene, total, field, residual)
      !> What does not change
      type(scene_type), intent(in) :: scene
      !> Jumps on the planes
      real(wp), intent(in) :: total(:, :, :)
      !> State of the joints
      type(joint_field_type), intent(inout) :: field
      !> What was cut off, amplitudes
      real(wp), intent(out) :: residual(:, :, :)

      real(wp), allocatable :: trial(:, :, :)
      integer :: k

      trial = field%stress
      do k = 1, size(scene%points)
         associate (law => scene%model%joint_materials(scene%points(k)%material)%law)
            trial(:, k, :) = trial(:, k, :) + spread(law%stiffness, 2, size(total, 3)) &
               *(total(:, k, :) - field%jump(:, k, :))
         end associate
      end do
      field%jump = total
      call admit_trial(scene%model, scene%points, trial, field)
      residual = analyse(scene%planes, trial - field%stress)
   end subroutine accumulate

end module axijoint_joints_scene
