!> Mechanisms: rigid motions that joints as they stick, slip and stand open do not resist. What they
!> do not resist is none only if no load acts on it, at any size of the load
module axijoint_joints_mechanism
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : admit, eta
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, seen_by_law
   use axijoint_joints_planes, only : analyse, mode_on_planes, mode_from_planes
   use axijoint_joints_scene, only : scene_type, views, motion_of, jumps, evaluate
   use axijoint_linalg_lapack, only : symmetric_eigen, singular_values
   implicit none
   private
   public :: mechanism_type, find_mechanism, drives_on, hold_nothing, settle, idle_part, stand_still, balance_motions, total_jumps

   !> A motion is not resisted if the resistance to it is less than this share of that of sticking
   !> joints
   real(wp), parameter :: no_resistance = 1.0e-7_wp
   !> A force on a motion is rounding below this share of the loads that add to it, and this share
   !> of what joint stresses, of all harmonics together, may leave in it
   real(wp), parameter :: rounding = 1.0e-13_wp, leftover = 1.0e-15_wp
   !> Values on the planes from which on threads are worth their start
   integer, parameter :: worth_threads = 5000
   !> Of so many points one is looked at first where all that touch stick: if these resist so many
   !> times as much as nothing, all do, as each adds to it
   integer, parameter :: one_of = 8
   real(wp), parameter :: surely = 1.0e3_wp
   !> A motion that loads push by less than this part of what they push another by, both of unit elastic work, has that
   !> from a little of the other in it
   real(wp), parameter :: slight = 1.0e-3_wp
   !> Jumps that a motion which ran away goes on by, over those that it came to
   real(wp), parameter :: farther = 1.0e2_wp

   !> Motions that nothing resists, in multiples of the floating motions of a scene
   type :: mechanism_type
      !> Whether a load acts on one
      logical :: loaded = .false.
      !> The motion under the load, shape (floating motions)
      real(wp), allocatable :: motion(:)
      !> Motions that no load acts on, one column each, of unit elastic work, shape (floating
      !> motions, any)
      real(wp), allocatable :: idle(:, :)
      !> Whether the parts stand along each of these where they stood when the step began, shape (any)
      logical, allocatable :: stands(:)
   end type mechanism_type

contains

   !> Find the motions that a state does not resist
   subroutine find_mechanism(condensed, scene, field, sticking, mechanism)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> Whether points with any friction or cohesion count as sticking where they touch
      logical, intent(in) :: sticking
      !> The mechanism
      type(mechanism_type), intent(out) :: mechanism

      real(wp), dimension(size(condensed%floating), size(condensed%floating)) :: resistance, &
         to_unit, rows
      real(wp), dimension(size(condensed%floating)) :: value, force, least, direction
      real(wp) :: work, mixed
      integer :: k, n

      n = size(condensed%floating)
      allocate (mechanism%motion(n), mechanism%idle(n, 0), mechanism%stands(0))
      mechanism%motion = 0.0_wp
      if (n == 0) return
      if (sticking .and. each_adds(scene, field)) then
         call unit_resistance(condensed, scene, field, sticking, one_of, resistance, to_unit, &
            value, rows)
         if (value(n) > surely*no_resistance) return
      end if
      call unit_resistance(condensed, scene, field, sticking, 1, resistance, to_unit, value, rows)
      call act(condensed, scene, field, force, least)
      ! rounding mixes motions that are resisted little into those that are not
      mixed = rounding*norm2(matmul(force, to_unit))/max(no_resistance, &
         minval(value, mask=value > no_resistance))
      do k = n, 1, -1
         if (value(k) > no_resistance) exit
         direction = matmul(to_unit, rows(k, :))
         work = dot_product(direction, force)
         ! what iterations leave out of balance is no load
         if (min(abs(work), abs(dot_product(direction, &
            scene%loads%work))) > dot_product(abs(direction), least) + mixed) then
            mechanism%loaded = .true.
            mechanism%motion = mechanism%motion + work*direction
         else
            mechanism%idle = reshape([mechanism%idle, direction], [n, size(mechanism%idle, 2) + 1])
            mechanism%stands = [mechanism%stands, .false.]
         end if
      end do
   end subroutine find_mechanism

   !> Whether a load drives parts on from a state without equilibrium: joints do not resist a motion there, and still do not
   !> where it has gone far on, so that all that slips does so along it, and what it closes has closed. For iterations run
   !> away where there is equilibrium, too: along a motion that the joints of an iterate do not resist, though others
   !> would, or that no load acts on
   subroutine drives_on(condensed, scene, field, driven, motion)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> Whether it does
      logical, intent(out) :: driven
      !> The motion, in multiples of the floating motions; allocated if it does
      real(wp), allocatable, intent(out) :: motion(:)

      type(joint_field_type), allocatable :: there
      type(mechanism_type) :: mechanism, beyond
      real(wp), allocatable :: residual(:, :, :)

      driven = .false.
      if (size(condensed%floating) == 0 .or. .not. all(ieee_is_finite(field%excess))) return
      allocate (there, source=field)
      allocate (residual, mold=field%excess)
      ! laws as they are in the end
      there%share = 1.0_wp
      there%fading = 0.0_wp
      call evaluate(condensed, scene, there, residual)
      call find_mechanism(condensed, scene, there, .false., mechanism)
      if (.not. mechanism%loaded) return
      there%offset = there%offset + farther*maxval([abs(there%jump), scene%loads%largest]) &
         /maxval(abs(motion_of(condensed, scene, mechanism%motion)))*mechanism%motion
      call evaluate(condensed, scene, there, residual)
      call find_mechanism(condensed, scene, there, .false., beyond)
      driven = beyond%loaded .and. dot_product(beyond%motion, mechanism%motion) > 0.0_wp
      if (driven) motion = mechanism%motion
   end subroutine drives_on

   !> The mechanism of joints that touch but carry nothing: they resist no motion
   subroutine hold_nothing(condensed, scene, field, mechanism)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> The mechanism
      type(mechanism_type), intent(out) :: mechanism

      real(wp), dimension(size(condensed%floating), size(condensed%floating)) :: resistance, rows
      real(wp) :: value(size(condensed%floating))
      integer :: n

      n = size(condensed%floating)
      allocate (mechanism%motion(n), source=0.0_wp)
      allocate (mechanism%idle(n, n), mechanism%stands(n))
      mechanism%stands = .false.
      if (n == 0) return
      call unit_resistance(condensed, scene, field, .false., size(condensed%points), resistance, mechanism%idle, value, rows)
   end subroutine hold_nothing

   !> Whether points that stick where they touch resist or do nothing, so that one more never takes
   !> resistance away: not where dilation couples pressure to slip, nor where cohesion fades
   pure logical function each_adds(scene, field)
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field

      each_adds = all(scene%laws%friction > 0.0_wp .or. scene%laws%cohesion > 0.0_wp) .and. &
         .not. any(scene%laws%dilation > 0.0_wp) .and. .not. field%fading > 0.0_wp
   end function each_adds

   !> Move the parts until the joints, as they stick, slip and stand open, balance the loads on
   !> them: what takes the loops many sweeps where little resists a motion
   subroutine balance_motions(condensed, scene, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state; the stresses are those before
      type(joint_field_type), intent(inout) :: field

      real(wp), dimension(size(condensed%floating), size(condensed%floating)) :: resistance, &
         to_unit, rows
      real(wp), dimension(size(condensed%floating)) :: value, force, least, direction
      integer :: k

      if (size(condensed%floating) == 0) return
      call unit_resistance(condensed, scene, field, .false., 1, resistance, to_unit, value, rows)
      call act(condensed, scene, field, force, least)
      force = matmul(force, to_unit)
      do k = 1, size(value)
         if (value(k) <= no_resistance) exit
         direction = rows(k, :)
         field%offset = field%offset &
            + dot_product(matmul(resistance, direction), force)/value(k)**2*matmul(to_unit, &
            direction)
      end do
   end subroutine balance_motions

   !> Take motions away that no load acts on and nothing resists: where a state leaves them is of no
   !> meaning, so the joints' mean is zero
   subroutine settle(condensed, scene, mechanism, field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Such motions
      type(mechanism_type), intent(in) :: mechanism
      !> The state; the stresses are those before
      type(joint_field_type), intent(inout) :: field

      if (size(mechanism%idle, 2) == 0) return
      field%offset = field%offset - idle_part(condensed, scene, mechanism, total_jumps(condensed, scene, field))
   end subroutine settle

   !> What jumps have of motions that no load acts on and nothing resists, in multiples of the floating motions
   function idle_part(condensed, scene, mechanism, jump) result(multiple)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Such motions
      type(mechanism_type), intent(in) :: mechanism
      !> Amplitudes of the jumps, shape (3, points, modes)
      real(wp), intent(in) :: jump(:, :, :)
      !> Shape (floating motions)
      real(wp), allocatable :: multiple(:)

      multiple = matmul(mechanism%idle, matmul(elastic_works(condensed, scene, jump), mechanism%idle))
   end function idle_part

   !> Let the parts stand where they stood when a load step began, along motions that no load acts on, nothing resists and
   !> the step does not push. Those that it pushes stay where it left them
   subroutine stand_still(condensed, scene, mechanism, begun, change, field, stands)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Motions that no load acts on and nothing resists
      type(mechanism_type), intent(in) :: mechanism
      !> Jumps when the step began, shape (3, points, planes)
      real(wp), intent(in) :: begun(:, :, :)
      !> What the loads of the step would add to the stress of joints that hold, amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: change(:, :, :)
      !> The state; the stresses are those before
      type(joint_field_type), intent(inout) :: field
      !> Whether they stand there along each motion
      logical, intent(out) :: stands(:)

      real(wp), dimension(size(condensed%floating)) :: work, push, unit, own
      real(wp) :: least
      integer :: k

      work = elastic_works(condensed, scene, total_jumps(condensed, scene, field) - analyse(scene%planes, begun))
      push = works(condensed, scene, change)
      least = 0.0_wp
      do k = 1, size(push)
         unit = 0.0_wp
         unit(k) = 1.0_wp
         own = elastic_works(condensed, scene, motion_of(condensed, scene, unit))
         least = max(least, slight*abs(push(k))/sqrt(own(k)))
      end do
      do k = 1, size(mechanism%idle, 2)
         associate (direction => mechanism%idle(:, k))
            stands(k) = .not. abs(dot_product(direction, push)) > least
            if (.not. stands(k)) cycle
            field%offset = field%offset - dot_product(direction, work)*direction
         end associate
      end do
   end subroutine stand_still

   !> Jumps of a state, amplitudes, shape (3, points, modes)
   function total_jumps(condensed, scene, field) result(jump)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> The jumps
      real(wp), allocatable :: jump(:, :, :)

      jump = jumps(condensed, scene, field%excess, free=.true.) + motion_of(condensed, scene, field%offset)
   end function total_jumps

   !> Work of elastic joints on unit motions
   function elastic_works(condensed, scene, jump) result(work)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Amplitudes of their jumps, shape (3, points, modes)
      real(wp), intent(in) :: jump(:, :, :)
      !> Shape (motions)
      real(wp) :: work(size(condensed%floating))

      real(wp), allocatable :: stress(:, :, :)
      integer :: i, k

      allocate (stress, mold=jump)
      do k = 1, size(stress, 2)
         do i = 1, 3
            stress(i, k, :) = condensed%points(k)%base(i)*jump(i, k, :)
         end do
      end do
      work = works(condensed, scene, stress)
   end function elastic_works

   !> What joints resist of motions that sticking joints all resist by one
   subroutine unit_resistance(condensed, scene, field, sticking, step, resistance, to_unit, value, &
      rows)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> Whether points with any friction or cohesion count as sticking where they touch
      logical, intent(in) :: sticking
      !> Of so many points one resists
      integer, intent(in) :: step
      !> The resistance; one column a motion in multiples of the floating motions
      real(wp), intent(out), contiguous :: resistance(:, :), to_unit(:, :)
      !> Singular values of the resistance, descending, and its right singular vectors, one row each
      real(wp), intent(out), contiguous :: value(:), rows(:, :)

      real(wp) :: elastic(size(value), size(value)), eigenvalue(size(value)), &
         lost(size(value), size(value)), held(size(value))
      integer :: info, k

      call resist(condensed, scene, field, sticking, step, resistance, elastic)
      call symmetric_eigen(elastic, eigenvalue, info)
      do k = 1, size(value)
         to_unit(:, k) = elastic(:, k)/sqrt(eigenvalue(k))
      end do
      resistance = matmul(transpose(to_unit), matmul(resistance, to_unit))
      if (allocated(scene%given%jump)) then  ! its work is held
         held = matmul(scene%given%work, to_unit)
         if (any(abs(held) > 0.0_wp)) resistance = resistance &
            + spread(held, 2, size(held))*spread(held, 1, size(held))/sum(held**2)
      end if
      lost = resistance
      call singular_values(lost, value, rows)
   end subroutine unit_resistance

   !> Work of the joints on each motion when another grows, by the derivatives of their laws and if
   !> they all stick; stiffnesses are those of the structure
   subroutine resist(condensed, scene, field, sticking, step, resistance, elastic)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> Whether points that touch count as sticking
      logical, intent(in) :: sticking
      !> Of so many points one is looked at; if they stick, all count
      integer, intent(in) :: step
      !> The works, shape (motions, motions)
      real(wp), intent(out) :: resistance(:, :), elastic(:, :)

      real(wp), dimension(3, size(field%jump, 3), size(condensed%floating)) :: made, share
      real(wp) :: view(size(condensed%points)), base(3)
      real(wp) :: tangent(3, 3, size(field%jump, 3)), stress(3, size(field%jump, 3))
      real(wp), allocatable :: of_point(:, :, :)
      integer :: j, k, y, z

      view = views(condensed, scene, field)
      resistance = 0.0_wp
      elastic = 0.0_wp
      associate (motions => condensed%floating, points => condensed%points)
         do z = 1, size(motions)
            made(:, :, z) = mode_on_planes(scene%planes, motions(z)%mode)
            share(:, :, z) = circle_integral(scene%modes(motions(z)%mode)%harmonic) &
               *mode_from_planes(scene%planes, motions(z)%mode)
         end do
         allocate (of_point(size(motions), size(motions), size(points)))
         !$omp parallel do private(tangent, stress, base, j, y, z) if &
         !$omp (size(field%jump) >= step*worth_threads)
         do k = 1, size(points), step  ! what cancels round the circle does so point by point
            do j = 1, size(tangent, 3)
               tangent(:, :, j) = tangent_of(k, j)
            end do
            do z = 1, size(motions)
               base = points(k)%base*motions(z)%jump(:, k)
               do j = 1, size(tangent, 3)
                  stress(:, j) = matmul(tangent(:, :, j), base*made(:, j, z))
               end do
               do y = 1, size(motions)
                  of_point(y, z, k) = dot_product(points(k)%weight*motions(y)%jump(:, k), &
                     sum(share(:, :, y)*stress, 2))
               end do
            end do
         end do
         !$omp end parallel do
         do k = 1, size(points), step
            resistance = resistance + of_point(:, :, k)
         end do
         do z = 1, size(motions)
            do y = 1, size(motions)
               if (motions(y)%mode /= motions(z)%mode) cycle
               do k = 1, size(points)
                  elastic(y, z) = elastic(y, z) + points(k)%weight &
                     *dot_product(motions(y)%jump(:, k), points(k)%base*motions(z)%jump(:, k))
               end do
               elastic(y, z) = circle_integral(scene%modes(motions(z)%mode)%harmonic)*elastic(y, z)
            end do
         end do
      end associate

   contains

      !> Derivatives of the stress admitted by the trial stress, of a point on a plane
      function tangent_of(k, j) result(tangent)
         !> Point and plane
         integer, intent(in) :: k, j
         !> The derivatives
         real(wp) :: tangent(3, 3)

         real(wp), parameter :: identity(9) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, &
            0.0_wp, 0.0_wp, 1.0_wp]
         real(wp) :: admitted(3)

         associate (law => scene%laws(k))
            call admit(law, field%memory(k, j), seen_by_law(law, k, j, view(k), field), admitted, &
               tangent, view(k)*field%fading)
            if (.not. sticking .or. .not. tangent(eta, eta) > 0.0_wp) return
            if (law%friction > 0.0_wp .or. law%cohesion > 0.0_wp) tangent = reshape(identity, [3, 3])
         end associate
      end function tangent_of

   end subroutine resist

   !> Force that acts on each motion and is not balanced by joints, and what of it may be rounding
   subroutine act(condensed, scene, field, force, least)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type), intent(in) :: field
      !> Both, shape (motions)
      real(wp), intent(out) :: force(:), least(:)

      real(wp), allocatable :: largest(:, :, :)

      largest = spread(max(scene%loads%stress, maxval(abs(field%stress), 3)), 3, &
         size(field%excess, 3))
      force = scene%loads%work - works(condensed, scene, analyse(scene%planes, field%stress))
      least = rounding*scene%loads%size + leftover*works(condensed, scene, largest, sizes=.true.)
   end subroutine act

   !> Work of joint stress on unit motions, or that of its sizes
   function works(condensed, scene, stress, sizes) result(work)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Laws, planes and loads
      type(scene_type), intent(in) :: scene
      !> Amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> Whether all terms are taken as positive; false if absent
      logical, intent(in), optional :: sizes
      !> Shape (motions)
      real(wp) :: work(size(condensed%floating))

      real(wp) :: jump(3)
      integer :: k, z

      work = 0.0_wp
      do z = 1, size(work)
         associate (motion => condensed%floating(z))
            do k = 1, size(condensed%points)
               jump = motion%jump(:, k)
               if (present(sizes)) jump = abs(jump)
               work(z) = work(z) + condensed%points(k)%weight*dot_product(jump, &
                  stress(:, k, motion%mode))
            end do
            work(z) = circle_integral(scene%modes(motion%mode)%harmonic)*work(z)
         end associate
      end do
   end function works

end module axijoint_joints_mechanism
