!> State of the joint points on all planes
module axijoint_joints_field
   use axijoint_assembly_force, only : elastic_joint_stress, joint_jump
   use axijoint_assembly_unit_loads, only : in_situ_joint_stress
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : joint_law_type, memory_type, trial_stress, admit, renew, &
      state_of, loses_at_opening, &
                                          state_stick, state_slip, state_open, opening_bond, eta
   use axijoint_fe_mode, only : mode_type, same_mode, family_symmetric
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: joint_field_type, new_joint_field, admit_jump, admit_trial, judge_states
   public :: set_initial_stress, is_homogeneous, scale_field, trial_of, seen_by_law, stress_amplitude
   public :: commit_field, break_bonds, soften, mend, count_state, n_across_gaps, n_fading

   !> Share of the largest joint stress, or jump, below which a value is rounding
   real(wp), parameter :: noise = 1.0e-9_wp

   !> Joint points on planes
   type :: joint_field_type
      !> Relative displacement xi, eta, theta, shape (3, points, planes)
      real(wp), allocatable :: jump(:, :, :)
      !> Stress tau_xi, sigma, tau_theta, shape (3, points, planes)
      real(wp), allocatable :: stress(:, :, :)
      !> Stick, slip or open, shape (points, planes)
      integer, allocatable :: state(:, :)
      !> Slip and bonds, from the last increment in equilibrium and from what broke
      !> since, shape (points, planes)
      type(memory_type), allocatable :: memory(:, :)
      !> Stress before loading: initial stress of the law and in-situ stress of the
      !> bodies, and the latter alone, shape (3, points)
      real(wp), allocatable :: initial(:, :), in_situ(:, :)
      !> Share of the joint stiffness that the law of each point sees: less than one on the way to
      !> the state of stiff joints, shape (points)
      real(wp), allocatable :: share(:)
      !> Stiffness k h/E of joints that the laws see at most at a time
      real(wp) :: view_limit = huge(1.0_wp)
      !> Tension over which the cohesion of an opening point fades, as a share of it: none where there
      !> is a state without
      real(wp) :: fading = 0.0_wp
      !> Amplitudes of the stress k d - P that was not admitted and has been
      !> transferred to the structure, and of that which has not yet been, shape
      !> (3, points, modes)
      real(wp), allocatable :: excess(:, :, :), pending(:, :, :)
      !> Where the parts stand from which displacements and excess stress count: multiples of the
      !> floating motions, and their jumps, shape (3, points, planes)
      real(wp), allocatable :: offset(:), moved(:, :, :)
      !> Stress that the laws start from, the same that they admit in the end, shape
      !> (3, points, planes)
      real(wp), allocatable :: carried(:, :, :)
   end type joint_field_type

contains

   !> Joint without stress
   pure function new_joint_field(n_points, n_planes, n_modes, n_floating) result(field)
      !> Numbers of points, planes, modes, and floating motions
      integer, intent(in) :: n_points, n_planes, n_modes, n_floating
      !> The field
      type(joint_field_type) :: field

      allocate (field%jump(3, n_points, n_planes), source=0.0_wp)
      allocate (field%stress(3, n_points, n_planes), field%carried(3, n_points, n_planes), &
         source=0.0_wp)
      allocate (field%offset(n_floating), field%moved(3, n_points, n_planes), source=0.0_wp)
      allocate (field%excess(3, n_points, n_modes), field%pending(3, n_points, n_modes), &
         source=0.0_wp)
      allocate (field%initial(3, n_points), field%in_situ(3, n_points), source=0.0_wp)
      allocate (field%share(n_points), source=1.0_wp)
      allocate (field%state(n_points, n_planes), source=state_stick)
      allocate (field%memory(n_points, n_planes))
   end function new_joint_field

   !> Give the joints their stress before loading
   pure subroutine set_initial_stress(model, points, case_factor, field)
      !> The job
      type(model_type), intent(in) :: model
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Factors of the load cases, for the in-situ stress
      real(wp), intent(in) :: case_factor(:)
      !> State of the joints; stresses change by what is new
      type(joint_field_type), intent(inout) :: field

      real(wp) :: initial(3, size(points))
      integer :: j, k

      field%in_situ = in_situ_joint_stress(model, points, case_factor)
      initial = field%in_situ
      do k = 1, size(points)
         associate (law => model%joint_materials(points(k)%material)%law)
            initial(eta, k) = initial(eta, k) + law%initial_stress
         end associate
      end do
      do j = 1, size(field%stress, 3)
         field%stress(:, :, j) = field%stress(:, :, j) + initial - field%initial
         field%carried(:, :, j) = field%carried(:, :, j) + initial - field%initial
      end do
      field%initial = initial
   end subroutine set_initial_stress

   !> Let the laws admit the stress of total jumps. Gives what they do not admit. Where the view is
   !> less than 1, P = law(P + view (t - P)) stands for P = law(t): the same in the end, but a stiff
   !> joint makes no large stress of a small jump on the way
   pure subroutine admit_jump(laws, base, view, field, excess)
      !> Laws of the points, and stiffness that the structure has there, shape (3, points)
      type(joint_law_type), intent(in) :: laws(:)
      real(wp), intent(in) :: base(:, :)
      !> The view of each point, > 0 and <= 1
      real(wp), intent(in) :: view(:)
      !> Field with its jumps; takes the stresses
      type(joint_field_type), intent(inout) :: field
      !> Stress of the elastic structure + initial stress - P on the planes, shape (3, points,
      !> planes)
      real(wp), intent(out) :: excess(:, :, :)

      real(wp) :: trial(3), tangent(3, 3)
      integer :: j, k

      do j = 1, size(excess, 3)
         do k = 1, size(laws)
            trial = seen_by_law(laws(k), k, j, view(k), field)
            call admit(laws(k), field%memory(k, j), trial, field%stress(:, k, j), tangent, &
               view(k)*field%fading)
            excess(:, k, j) = base(:, k)*(field%jump(:, k, j) - field%moved(:, k, j)) + &
               field%initial(:, k) &
               - field%stress(:, k, j)
         end do
      end do
   end subroutine admit_jump

   !> Trial stress of a point on a plane
   pure function trial_of(law, k, j, jump, field) result(trial)
      !> Law of the point
      type(joint_law_type), intent(in) :: law
      !> Point and plane
      integer, intent(in) :: k, j
      !> Relative displacement there
      real(wp), intent(in) :: jump(3)
      !> The field, for its memory and initial stress
      type(joint_field_type), intent(in) :: field
      !> tau_xi, sigma, tau_theta
      real(wp) :: trial(3)

      trial = trial_stress(law, field%memory(k, j), jump)
      trial(eta) = trial(eta) - law%initial_stress  ! part of the field's
      trial = field%share(k)*trial + field%initial(:, k)
   end function trial_of

   !> Trial stress of a point on a plane as far as its law sees the jump
   pure function seen_by_law(law, k, j, view, field) result(trial)
      !> Law of the point
      type(joint_law_type), intent(in) :: law
      !> Point and plane
      integer, intent(in) :: k, j
      !> How much of the way from the stress carried to that of the jump, > 0 and <= 1
      real(wp), intent(in) :: view
      !> The field
      type(joint_field_type), intent(in) :: field
      !> tau_xi, sigma, tau_theta
      real(wp) :: trial(3)

      trial = trial_of(law, k, j, field%jump(:, k, j), field)
      if (view < 1.0_wp) trial = field%carried(:, k, j) + view*(trial - field%carried(:, k, j))
   end function seen_by_law

   !> Let the laws admit a trial stress (the paper's accumulated stress)
   pure subroutine admit_trial(laws, trial, field)
      !> Laws of the points
      type(joint_law_type), intent(in) :: laws(:)
      !> Trial stress, shape (3, points, planes)
      real(wp), intent(in) :: trial(:, :, :)
      !> Field that takes the stresses
      type(joint_field_type), intent(inout) :: field

      real(wp) :: tangent(3, 3)
      integer :: j, k

      do j = 1, size(trial, 3)
         do k = 1, size(laws)
            call admit(laws(k), field%memory(k, j), &
                       trial(:, k, j), field%stress(:, k, j), tangent)
         end do
      end do
   end subroutine admit_trial

   !> States from stresses and jumps, not from the last trial stress: once the
   !> loop has converged, that differs from the admitted by rounding only
   pure subroutine judge_states(laws, field)
      !> Laws of the points
      type(joint_law_type), intent(in) :: laws(:)
      !> Field that takes the states
      type(joint_field_type), intent(inout) :: field

      real(wp) :: small
      integer :: j, k

      small = noise*maxval([0.0_wp, abs(field%stress)])
      do j = 1, size(field%state, 2)
         do k = 1, size(laws)
            field%state(k, j) = state_of(laws(k), field%stress(:, k, j), field%jump(:, k, j), &
               small, &
                                         field%memory(k, j))
            if (fades(laws(k), k, j, field)) field%state(k, j) = state_slip
         end do
      end do
   end subroutine judge_states

   !> Whether a point has a part of its cohesion left, as it opens over a tension at which that fades
   pure logical function fades(law, k, j, field)
      !> Law of the point
      type(joint_law_type), intent(in) :: law
      !> Point and plane
      integer, intent(in) :: k, j
      !> The field
      type(joint_field_type), intent(in) :: field

      real(wp) :: trial(3)

      fades = .false.
      if (.not. field%fading > 0.0_wp .or. .not. loses_at_opening(law)) return
      trial = trial_of(law, k, j, field%jump(:, k, j), field)
      fades = trial(eta) > 0.0_wp .and. trial(eta) < field%fading*law%edge*law%cohesion .and. &
         .not. field%memory(k, j)%broken
   end function fades

   !> Points times planes that do
   pure integer function n_fading(laws, field) result(n)
      !> Laws of the points
      type(joint_law_type), intent(in) :: laws(:)
      !> The field
      type(joint_field_type), intent(in) :: field

      integer :: j, k

      n = 0
      do j = 1, size(field%state, 2)
         n = n + count([(fades(laws(k), k, j, field), k=1, size(laws))])
      end do
   end function n_fading

   !> Break the bonds that are in tension
   pure subroutine break_bonds(laws, field, n)
      !> Laws of the points
      type(joint_law_type), intent(in) :: laws(:)
      !> Field, states judged
      type(joint_field_type), intent(inout) :: field
      !> Number of points times planes that changed
      integer, intent(out) :: n

      real(wp) :: small
      integer :: j, k

      n = 0
      small = noise*maxval([0.0_wp, abs(field%stress)])
      do j = 1, size(field%state, 2)
         do k = 1, size(laws)
            associate (past => field%memory(k, j))
               if (laws(k)%opening /= opening_bond .or. past%broken) cycle
               if (.not. field%stress(eta, k, j) > small) cycle
               past%broken = .true.
               n = n + 1
            end associate
         end do
      end do
   end subroutine break_bonds

   !> Soften the points that slip
   pure subroutine soften(laws, field, n)
      !> Laws of the points
      type(joint_law_type), intent(in) :: laws(:)
      !> Field, states judged
      type(joint_field_type), intent(inout) :: field
      !> Number of points times planes that changed
      integer, intent(out) :: n

      integer :: j, k

      n = 0
      do j = 1, size(field%state, 2)
         do k = 1, size(laws)
            associate (past => field%memory(k, j))
               if (.not. laws(k)%softens .or. past%softened) cycle
               if (field%state(k, j) /= state_slip) cycle
               past%softened = .true.
               n = n + 1
            end associate
         end do
      end do
   end subroutine soften

   !> Keep the slip of an increment in equilibrium
   pure subroutine commit_field(laws, field)
      !> Laws of the points
      type(joint_law_type), intent(in) :: laws(:)
      !> Field in equilibrium
      type(joint_field_type), intent(inout) :: field

      integer :: j, k

      do j = 1, size(field%state, 2)
         do k = 1, size(laws)
            call renew(laws(k), &
                       trial_of(laws(k), k, j, field%jump(:, k, j), field), &
                       field%stress(:, k, j), field%memory(k, j))
         end do
      end do
   end subroutine commit_field

   !> Begin a load step again: what broke or softened since has not. Where points that stood open have landed they stay:
   !> the iterate that follows starts there
   elemental subroutine mend(start, memory)
      !> What a point remembered at the beginning
      type(memory_type), intent(in) :: start
      !> What it remembers
      type(memory_type), intent(inout) :: memory

      memory%broken = start%broken
      memory%softened = start%softened
   end subroutine mend

   !> Whether joint stresses and displacements are in proportion to the load that acts first: no law has a stress or
   !> a width of its own, and no stress was there before
   pure logical function is_homogeneous(laws, field)
      !> Laws of the points
      type(joint_law_type), intent(in) :: laws(:)
      !> Their state
      type(joint_field_type), intent(in) :: field

      is_homogeneous = .not. any(laws%cohesion > 0.0_wp .or. laws%gap > 0.0_wp .or. laws%residual_cohesion > 0.0_wp) .and. &
         .not. any(abs(field%initial) > 0.0_wp)
   end function is_homogeneous

   !> The state under so many times the load, where all is in proportion to it
   pure subroutine scale_field(factor, field)
      !> So many times
      real(wp), intent(in) :: factor
      !> The state
      type(joint_field_type), intent(inout) :: field

      integer :: i

      field%jump = factor*field%jump
      field%stress = factor*field%stress
      field%carried = factor*field%carried
      field%moved = factor*field%moved
      field%offset = factor*field%offset
      field%excess = factor*field%excess
      field%pending = factor*field%pending
      do i = 1, 3
         field%memory%slip(i) = factor*field%memory%slip(i)
      end do
   end subroutine scale_field

   !> Amplitudes of the joint stress that acts on the bodies: k d and in-situ stress,
   !> less what was not admitted
   pure function stress_amplitude(points, mode, displacement, field, k) result(stress)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> State of all joints
      type(joint_field_type), intent(in) :: field
      !> Place of the mode
      integer, intent(in) :: k
      !> tau_xi, sigma, tau_theta, shape (3, points)
      real(wp) :: stress(3, size(points))

      stress = elastic_joint_stress(points, joint_jump(points, displacement)) &
         - field%excess(:, :, k)
      if (same_mode(mode, mode_type(0, family_symmetric))) stress = stress + field%in_situ
   end function stress_amplitude

   !> Points times planes that carry pressure across an open gap, and the widest
   !> of these gaps: the accumulated stress of step 3 may leave some
   pure subroutine n_across_gaps(laws, field, n, widest)
      !> Laws of the points
      type(joint_law_type), intent(in) :: laws(:)
      !> The field
      type(joint_field_type), intent(in) :: field
      !> The number
      integer, intent(out) :: n
      !> The gap
      real(wp), intent(out) :: widest

      logical :: across(size(field%state, 1), size(field%state, 2))
      real(wp) :: gap(size(field%state, 1), size(field%state, 2))
      integer :: k

      do k = 1, size(laws)  ! what is pressed before loading opens later
         gap(k, :) = field%jump(eta, k, :) &
            + field%initial(eta, k)/laws(k)%stiffness(eta)
      end do
      associate (stress => field%stress(eta, :, :))
         across = gap > 1.0e-3_wp*maxval([0.0_wp, abs(gap)]) &
            .and. stress < -1.0e-3_wp*maxval([0.0_wp, abs(stress)])
         n = count(across)
         widest = maxval([0.0_wp, pack(gap, across)])
      end associate
   end subroutine n_across_gaps

   !> Number of points times planes that slip and that are open
   pure subroutine count_state(field, place, n_slip, n_open)
      !> The field
      type(joint_field_type), intent(in) :: field
      !> For all planes, the plane of the field that is like it
      integer, intent(in) :: place(:)
      !> The numbers
      integer, intent(out) :: n_slip, n_open

      n_slip = count(field%state(:, place) == state_slip)
      n_open = count(field%state(:, place) == state_open)
   end subroutine count_state

end module axijoint_joints_field
