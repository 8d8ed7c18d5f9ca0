!> The joints with harmonics above those of the job, whose flexibilities are told by the ones that were computed
module axijoint_joints_more_harmonics
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_planes, only : new_planes
   use axijoint_joints_scene, only : scene_type, jumps_of_mode
   implicit none
   private
   public :: add_harmonics

   !> Powers of the harmonic that the stiffness of bodies may grow
   !> like, and that which is told by harmonic 1, in which bodies move without strain
   real(wp), parameter :: least_power = 0.5_wp, most_power = 3.0_wp, rigid_power = 2.0_wp

contains

   !> The scene with harmonics up to 2 M
   subroutine add_harmonics(condensed, scene, field, extended, with_more)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The scene
      type(scene_type), intent(in) :: scene
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The scene with more harmonics
      type(scene_type), intent(out) :: extended
      !> The same state, nothing yet in these harmonics; not allocated if there are none
      type(joint_field_type), allocatable, intent(out) :: with_more

      type(mode_type), allocatable :: above(:)
      integer :: n, last

      above = modes_above(scene%modes)
      if (size(above) == 0) return
      n = size(scene%modes)
      last = maxloc(scene%modes%harmonic, 1)
      extended = scene
      extended%modes = [scene%modes, above]
      extended%system = [scene%system, spread(scene%system(last), 1, size(above))]
      extended%scale = shares_above(condensed, scene, extended%modes, last, field)
      extended%planes = new_planes(scene%planes%n, extended%modes, whole=scene%planes%folds == 1)
      deallocate (extended%loads%free)
      allocate (extended%loads%free(3, size(condensed%points), n + size(above)), source=0.0_wp)
      extended%loads%free(:, :, :n) = scene%loads%free
      if (allocated(scene%loads%reference%forces)) then  ! nothing loads the modes above
         associate (forces => scene%loads%reference%forces)
            extended%loads%reference%forces = reshape([forces, spread(maxval(forces, 2), 2, size(above))], &
               [size(forces, 1), n + size(above)])
         end associate
      end if
      allocate (with_more, source=field)
      with_more%excess = 0.0_wp*extended%loads%free
      with_more%excess(:, :, :n) = field%excess
      with_more%pending = 0.0_wp*with_more%excess
   end subroutine add_harmonics

   !> Modes that follow those of a job, up to 2 M, and to three times the lowest: friction answers a harmonic in that first
   pure function modes_above(modes) result(above)
      !> Modes of the job
      type(mode_type), intent(in) :: modes(:)
      !> The next: as many, but for two that follow one
      type(mode_type), allocatable :: above(:)

      integer :: step, last, m, family

      allocate (above(0))
      last = maxval(modes%harmonic)
      if (last == 0) return
      step = minval(modes%harmonic, mask=modes%harmonic > 0)
      do m = last + step, max(2*last, 3*step), step
         do family = family_symmetric, family_antisymmetric
            if (any(modes%family == family .and. modes%harmonic > 0)) &
               above = [above, mode_type(m, family)]
         end do
      end do
   end function modes_above

   !> Flexibilities of harmonics that were not computed, over that of the highest. A joint of the
   !> stiffness k before bodies of the stiffness K takes up the share k/(k + K) of a stress; K of
   !> the bodies grows like a power of m, which the two highest harmonics tell
   function shares_above(condensed, scene, modes, last, field) result(scale)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The modes, those of the scene first
      type(mode_type), intent(in) :: modes(:)
      !> The highest of the scene
      integer, intent(in) :: last
      !> State of the joints, for the excess stress that is looked at
      type(joint_field_type), intent(in) :: field
      !> The factors, 1 for those of the scene
      real(wp), allocatable :: scale(:)

      real(wp) :: stiffness(2), power
      integer :: k, m(2)

      m(2) = modes(last)%harmonic
      stiffness(2) = body_stiffness(condensed, scene, last, field%excess(:, :, last))
      power = 1.0_wp
      m(1) = maxval([0, scene%modes%harmonic], mask=[0, scene%modes%harmonic] < m(2))
      if (m(1) > 0) then
         stiffness(1) = body_stiffness(condensed, scene, findloc(scene%modes%harmonic, m(1), 1), field%excess(:, :, last))
         power = log(stiffness(2)/stiffness(1))/log(real(m(2), wp)/m(1))
         power = min(merge(rigid_power, most_power, m(1) == 1), max(least_power, power))
      end if
      allocate (scale(size(modes)), source=1.0_wp)
      do k = size(scene%modes) + 1, size(modes)
         scale(k) = (1.0_wp + stiffness(2))/(1.0_wp + &
            stiffness(2)*(real(modes(k)%harmonic, wp)/m(2))**power)
      end do
   end function shares_above

   !> Stiffness of the bodies over that of the joints, for a distribution of excess stress
   function body_stiffness(condensed, scene, place, excess) result(stiffness)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Place of the mode
      integer, intent(in) :: place
      !> The stress, shape (3, points)
      real(wp), intent(in), contiguous :: excess(:, :)
      !> The ratio
      real(wp) :: stiffness

      real(wp) :: jump(3, size(excess, 2)), work(2)
      integer :: k

      jump = jumps_of_mode(condensed, scene, place, excess)
      work = tiny(1.0_wp)
      do k = 1, size(excess, 2)
         associate (point => condensed%points(k))
            work = work + point%weight*[sum(excess(:, k)**2), &
               sum(excess(:, k)*point%base*jump(:, k))]
         end associate
      end do
      stiffness = max(epsilon(1.0_wp), work(1)/work(2) - 1.0_wp)
   end function body_stiffness

end module axijoint_joints_more_harmonics
