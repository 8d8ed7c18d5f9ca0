!> What is asked of the condensed structure – laws, planes, loads – and the stress that an iterate
!> leaves without equilibrium then
module axijoint_joints_scene
   use axijoint_assembly_force, only : joint_jump
   use axijoint_base_kinds, only : wp, i8
   use axijoint_element_joint_law, only : joint_law_type, eta
   use axijoint_fe_mode, only : mode_type, same_mode, family_symmetric
   use axijoint_joints_condensed, only : condensed_type, flexibility_type, rank_of
   use axijoint_joints_field, only : joint_field_type, admit_jump
   use axijoint_joints_loads, only : joint_loads_type, new_joint_loads
   use axijoint_joints_pairs, only : pairs_type, forces_on_pairs, jumps_at_points
   use axijoint_joints_planes, only : planes_type, new_planes, synthesize, analyse
   use axijoint_linalg_lapack, only : invert
   use axijoint_linalg_symmetric_half, only : half_product, half_sparse_product
   use axijoint_model_joint_points, only : law_at
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: scene_type, given_work_type, new_scene, find_jumps, jumps, tell_jumps, jumps_of_mode, &
      own_flexibility, evaluate, views, mismatch_of, elastic_stress, rounded_stress
   public :: motion_of, multiples_of_motions, stand_where_they_are

   !> Stiffness k h/E of joints that a state is judged by
   real(wp), parameter :: judged_view = 1.0e2_wp
   !> Joint points from which on products of the harmonics are worth threads
   integer, parameter :: worth_points = 64

   !> A load whose work is given in place of its size: its size takes away what excess stress adds to
   !> that work, so jumps follow from F - d d^T/a in place of the flexibility F, with the jumps d that
   !> a unit of it makes in elastic joints, and its work a on the displacements of these
   type :: given_work_type
      !> The jumps d, amplitudes, and the same times what makes them forces, shape (3, points, modes)
      real(wp), allocatable :: jump(:, :, :), weighted(:, :, :)
      !> The work a
      real(wp) :: compliance = 0.0_wp
      !> Work of a unit on the floating motions
      real(wp), allocatable :: work(:)
   end type given_work_type

   !> What is asked of a condensed structure. It is small beside that: who asks something else makes
   !> a copy
   type :: scene_type
      !> Law of each point
      type(joint_law_type), allocatable :: laws(:)
      !> Modes, the system of equations whose flexibility each takes, and the factor on it; those of
      !> the structure first
      type(mode_type), allocatable :: modes(:)
      integer, allocatable :: system(:)
      real(wp), allocatable :: scale(:)
      !> Planes of the joint checks
      type(planes_type) :: planes
      !> The loads
      type(joint_loads_type) :: loads
      !> The load whose work is given; its components are not allocated if there is none
      type(given_work_type) :: given
   end type scene_type

contains

   !> The scene of a job, not loaded
   function new_scene(model, condensed) result(scene)
      !> The job
      type(model_type), intent(in) :: model
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The scene
      type(scene_type) :: scene

      integer :: k

      scene%laws = law_at(condensed%points, model%joint_materials(condensed%points%material))
      do k = 1, size(scene%laws)
         associate (law => scene%laws(k))
            law%edge = max(1.0_wp, condensed%points(k)%proportion*law%stiffness(eta) &
               /max(tiny(1.0_wp), maxval(law%stiffness)))
         end associate
      end do
      scene%modes = condensed%modes
      scene%system = condensed%system
      allocate (scene%scale(size(scene%modes)), source=1.0_wp)
      scene%planes = new_planes(model%n_planes, scene%modes)
      scene%loads = new_joint_loads(condensed)
   end function new_scene

   !> Jumps d_m = d0_m + F_m e_m from loads and excess stress, or from the latter alone. Each rank
   !> multiplies with the flexibilities that it has
   function jumps(condensed, scene, excess, free) result(jump)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Modes and loads
      type(scene_type), intent(in) :: scene
      !> Amplitudes of the excess stress, shape (components, points, modes)
      real(wp), intent(in), contiguous :: excess(:, :, :)
      !> Whether the loads act, too
      logical, intent(in) :: free
      !> Amplitudes of the jumps, same shape
      real(wp) :: jump(size(excess, 1), size(excess, 2), size(excess, 3))

      real(wp) :: weight(size(condensed%points))
      integer :: k

      weight = condensed%points%weight
      !$omp parallel do schedule(static, 1) if (size(excess, 2) >= worth_points)
      do k = 1, size(excess, 3)
         associate (flexibility => condensed%flexibilities(scene%system(k)))
            if (.not. allocated(flexibility%matrix)) cycle
            jump(:, :, k) = scene%scale(k)*flexed(flexibility, condensed%pairs, weight, excess(:, :, k))
         end associate
      end do
      !$omp end parallel do
      if (condensed%shared) call tell_jumps(condensed, scene, jump)
      if (allocated(scene%given%jump)) jump = jump - work_share(scene%given, excess)*scene%given%jump
      if (free) jump = jump + scene%loads%free
   end function jumps

   !> Work that the load of given work does where excess stress moves it, in units of that it does on
   !> its own displacements: by as much the load becomes less
   pure real(wp) function work_share(given, excess) result(share)
      !> The load
      type(given_work_type), intent(in) :: given
      !> Amplitudes of the excess stress, shape (3, points, modes)
      real(wp), intent(in) :: excess(:, :, :)

      share = sum(given%weighted*excess)/given%compliance
   end function work_share

   !> Let all ranks know the jumps that each has found with its flexibilities
   subroutine tell_jumps(condensed, scene, jump)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Modes
      type(scene_type), intent(in) :: scene
      !> Amplitudes, the last place of which is the mode
      real(wp), intent(inout), contiguous :: jump(:, :, :)

      associate (n => size(condensed%modes))
         call condensed%team%gather(jump, size(jump(:, :, :n), kind=i8), condensed%last_mode)
         ! all that follow take the flexibility of one system
         if (size(jump, 3) > n) call condensed%team%broadcast(jump(:, :, n + 1:), &
            size(jump(:, :, n + 1:), kind=i8), rank_of(condensed, scene%system(n + 1)))
      end associate
   end subroutine tell_jumps

   !> Product of a flexibility and excess stress. Where most is zero only the columns of the rest are read, else half of
   !> the matrix
   function flexed(flexibility, pairs, weight, excess) result(jump)
      !> The flexibility
      type(flexibility_type), intent(in) :: flexibility
      !> Pairs of nodes
      type(pairs_type), intent(in) :: pairs
      !> Weights of the points
      real(wp), intent(in) :: weight(:)
      !> Amplitudes, shape (components, points)
      real(wp), intent(in) :: excess(:, :)
      !> Amplitudes of the jumps, same shape
      real(wp) :: jump(size(excess, 1), size(excess, 2))

      real(wp), dimension(size(pairs%nodes, 2), size(excess, 1)) :: force, moved
      real(wp) :: at_points(size(excess, 2), size(excess, 1))

      at_points = transpose(excess)
      call forces_on_pairs(pairs, size(excess, 2), weight, at_points, force)
      if (2*count(abs(force) > 0.0_wp) > size(force)) then
         call half_product(flexibility%matrix, force, moved)
      else
         call half_sparse_product(flexibility%matrix, force, moved)
      end if
      call jumps_at_points(pairs, moved, size(excess, 2), at_points)
      jump = transpose(at_points)
   end function flexed

   !> Jumps of one mode from excess stress
   function jumps_of_mode(condensed, scene, mode, excess) result(jump)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Modes
      type(scene_type), intent(in) :: scene
      !> Place of the mode
      integer, intent(in) :: mode
      !> Amplitudes of the excess stress, shape (components, points)
      real(wp), intent(in), contiguous :: excess(:, :)
      !> Amplitudes of the jumps, same shape
      real(wp) :: jump(size(excess, 1), size(excess, 2))

      real(wp) :: weight(size(condensed%points))

      weight = condensed%points%weight
      associate (flexibility => condensed%flexibilities(scene%system(mode)))
         if (allocated(flexibility%matrix)) jump = flexed(flexibility, condensed%pairs, weight, excess)
      end associate
      if (condensed%shared) call condensed%team%broadcast(jump, size(jump, kind=i8), &
         rank_of(condensed, scene%system(mode)))
   end function jumps_of_mode

   !> Jumps of a point from unit amplitudes of its own excess stress
   pure function own_flexibility(condensed, scene, mode, k) result(flexibility)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Modes
      type(scene_type), intent(in) :: scene
      !> Place of the mode, and the point
      integer, intent(in) :: mode, k
      !> The jumps, one column a component of stress
      real(wp) :: flexibility(3, 3)

      flexibility = condensed%own(:, :, k, scene%system(mode))
   end function own_flexibility

   !> Jumps that loads and transferred stress give
   subroutine find_jumps(condensed, scene, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints; jumps follow its excess stress
      type(joint_field_type), intent(inout) :: field

      field%jump = synthesize(scene%planes, jumps(condensed, scene, field%excess, free=.true.))
      if (any(abs(field%offset) > 0.0_wp)) then
         field%moved = synthesize(scene%planes, motion_of(condensed, scene, field%offset))
         field%jump = field%jump + field%moved
      end if
   end subroutine find_jumps

   !> Excess stress that is not yet transferred, from the jumps that loads and
   !> transferred stress give
   subroutine evaluate(condensed, scene, field, residual, judged)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints; jumps and stresses follow its excess stress
      type(joint_field_type), intent(inout) :: field
      !> The amplitudes, shape (3, points, modes)
      real(wp), intent(out) :: residual(:, :, :)
      !> Whether the laws see the jumps as a state is judged; false if absent
      logical, intent(in), optional :: judged

      real(wp), allocatable :: excess(:, :, :)
      real(wp) :: view(size(condensed%points))
      integer :: k

      call find_jumps(condensed, scene, field)
      view = views(condensed, scene, field)
      if (present(judged)) &
         view = min(1.0_wp, judged_view/max(tiny(1.0_wp), condensed%points%proportion))
      allocate (excess, mold=field%jump)
      call admit_jump(scene%laws, reshape([(condensed%points(k)%base, k=1, size(view))], &
         [3, size(view)]), view, field, excess)
      residual = analyse(scene%planes, excess) - field%excess
   end subroutine evaluate

   !> How much of a jump the law of each point sees: joints that are much stiffer than the bodies
   !> would make large stresses of the jumps on the way
   pure function views(condensed, scene, field) result(view)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws
      type(scene_type), intent(in) :: scene
      !> Share and limit of the stiffness that the laws see
      type(joint_field_type), intent(in) :: field
      !> > 0 and <= 1, shape (points)
      real(wp) :: view(size(condensed%points))

      integer :: k

      do k = 1, size(view)
         associate (point => condensed%points(k), share => field%share(k))
            view(k) = min(1.0_wp, maxval(point%base)/max(tiny(1.0_wp), &
               share*maxval(scene%laws(k)%stiffness)))
            if (share*point%proportion > field%view_limit) &
               view(k) = min(view(k), field%view_limit/(share*point%proportion))
         end associate
      end do
   end function views

   !> Relative displacements of the bodies, less those that the laws saw: rounding of the
   !> condensed structure. It grows with k h/E, because the structure is condensed with its joints
   !> closed
   function mismatch_of(condensed, scene, field, displacement) result(jump)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Displacement amplitudes of the bodies, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Amplitudes, shape (3, points, modes)
      real(wp) :: jump(3, size(condensed%points), size(displacement, 3))

      integer :: k

      jump = -jumps(condensed, scene, field%excess, free=.true.)
      do k = 1, size(displacement, 3)
         jump(:, :, k) = jump(:, :, k) + joint_jump(condensed%points, displacement(:, :, k))
      end do
   end function mismatch_of

   !> Jumps of the floating motions
   pure function motion_of(condensed, scene, multiple) result(jump)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Share of each motion
      real(wp), intent(in) :: multiple(:)
      !> Amplitudes, shape (3, points, modes)
      real(wp) :: jump(3, size(condensed%points), size(scene%loads%free, 3))

      integer :: z

      jump = 0.0_wp
      do z = 1, size(condensed%floating)
         associate (floating => condensed%floating(z))
            jump(:, :, floating%mode) = jump(:, :, floating%mode) + multiple(z)*floating%jump
         end associate
      end do
   end function motion_of

   !> Let displacements count from where the parts stand: with the rigid motions taken away, small
   !> strains of stiff bodies on soft joints are not lost to rounding. The state does not change
   subroutine stand_where_they_are(condensed, scene, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(inout) :: field

      real(wp) :: motion(3, size(condensed%points), size(scene%modes)), &
         multiple(size(condensed%floating))
      integer :: k, z

      if (size(condensed%floating) == 0) return
      multiple = multiples_of_motions(condensed, scene, &
         jumps(condensed, scene, field%excess, free=.true.))
      motion = motion_of(condensed, scene, multiple)
      do k = 1, size(condensed%points)
         do z = 1, 3
            field%excess(z, k, :) = field%excess(z, k, :) - &
               condensed%points(k)%base(z)*motion(z, k, :)
         end do
      end do
      field%offset = field%offset + multiple
   end subroutine stand_where_they_are

   !> Multiples of the floating motions in jumps: what is left of these does no work on them in
   !> elastic joints
   function multiples_of_motions(condensed, scene, jump) result(multiple)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: jump(:, :, :)
      !> Multiple of each motion; zero if joints do not tell them apart
      real(wp) :: multiple(size(condensed%floating))

      real(wp) :: matrix(size(multiple), size(multiple)), unit(size(multiple))
      integer :: info, z

      multiple = 0.0_wp
      if (size(multiple) == 0) return
      do z = 1, size(multiple)
         unit = 0.0_wp
         unit(z) = 1.0_wp
         matrix(:, z) = works_of(motion_of(condensed, scene, unit))
      end do
      call invert(matrix, info)
      if (info == 0) multiple = matmul(matrix, works_of(jump))

   contains

      !> Work of elastic joints on the motions
      function works_of(jump) result(work)
         !> Amplitudes of their jumps, shape (3, points, modes)
         real(wp), intent(in) :: jump(:, :, :)
         !> Shape (motions)
         real(wp) :: work(size(condensed%floating))

         integer :: i, p

         work = 0.0_wp
         do i = 1, size(work)
            associate (floating => condensed%floating(i))
               do p = 1, size(condensed%points)
                  work(i) = work(i) + condensed%points(p)%weight &
                     *sum(floating%jump(:, p)*condensed%points(p)%base*jump(:, p, floating%mode))
               end do
            end associate
         end do
      end function works_of

   end function multiples_of_motions

   !> Joint stress of the loads if all joints held, with the stress before loading
   function elastic_stress(condensed, scene, field) result(stress)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> State of the joints, for the stress before loading
      type(joint_field_type), intent(in) :: field
      !> Amplitudes, shape (3, points, modes)
      real(wp), allocatable :: stress(:, :, :)

      integer :: k, p

      allocate (stress, mold=scene%loads%free)
      do k = 1, size(stress, 3)
         do p = 1, size(stress, 2)
            stress(:, p, k) = condensed%points(p)%base*scene%loads%free(:, p, k)
         end do
      end do
      do k = 1, size(scene%modes)
         if (same_mode(scene%modes(k), mode_type(0, family_symmetric))) then
            stress(:, :, k) = stress(:, :, k) + field%initial
         end if
      end do
   end function elastic_stress

   !> Joint stress that rounding of the displacements makes, if all joints hold: where all moves together, jumps are differences
   !> of numbers that are next to the same
   function rounded_stress(condensed, scene) result(stress)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Amplitudes, shape (3, points, modes)
      real(wp), allocatable :: stress(:, :, :)

      !> What solutions and differences leave, over the displacements
      real(wp), parameter :: rounding = 128.0_wp*epsilon(1.0_wp)
      integer :: k, p

      allocate (stress, mold=scene%loads%free)
      do k = 1, size(stress, 3)
         do p = 1, size(stress, 2)
            stress(:, p, k) = rounding*condensed%points(p)%base*scene%loads%largest(k)
         end do
      end do
   end function rounded_stress

end module axijoint_joints_scene
