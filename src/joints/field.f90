!> State of all joint points on all planes
module axijoint_joints_field
   use axijoint_assembly_force, only : elastic_joint_stress
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : admit_stress, state_of, state_stick, state_slip, &
                                          state_open, eta
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: joint_field_type, iteration_type, new_joint_field, admit, judge_states
   public :: elastic_stress, count_state, n_across_gaps

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
      !> Amplitudes of the stress k d - P that was not admitted and has been
      !> transferred to the structure, shape (3, points, modes)
      real(wp), allocatable :: excess(:, :, :)
   end type joint_field_type

   !> One line of the convergence path (Fig. 17 of the paper)
   type :: iteration_type
      !> Load increment
      integer :: increment = 0
      !> Iteration within the increment, the elastic solution being 1
      integer :: iteration = 0
      !> Sum of the load factors so far
      real(wp) :: load_factor = 0.0_wp
      !> Norm of the residual forces over the norm of the applied (Eq. 17)
      real(wp) :: ratio = 0.0_wp
      !> Points times planes that slip, and that are open
      integer :: n_slip = 0, n_open = 0
   end type iteration_type

contains

   !> Joint without stress
   pure function new_joint_field(n_points, n_planes, n_modes) result(field)
      !> Numbers of points, planes and modes
      integer, intent(in) :: n_points, n_planes, n_modes
      !> The field
      type(joint_field_type) :: field

      allocate (field%jump(3, n_points, n_planes), source=0.0_wp)
      allocate (field%stress(3, n_points, n_planes), source=0.0_wp)
      allocate (field%excess(3, n_points, n_modes), source=0.0_wp)
      allocate (field%state(n_points, n_planes), source=state_stick)
   end function new_joint_field

   !> Elastic joint stress of relative displacements (Eq. 9)
   pure function elastic_stress(model, points, jump) result(stress)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Relative displacements, shape (3, points, any)
      real(wp), intent(in) :: jump(:, :, :)
      !> Stresses, same shape
      real(wp) :: stress(3, size(jump, 2), size(jump, 3))

      integer :: j

      do j = 1, size(jump, 3)
         stress(:, :, j) = elastic_joint_stress(model, points, jump(:, :, j))
      end do
   end function elastic_stress

   !> Let the laws admit a trial stress
   pure subroutine admit(model, points, trial, field)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Trial stress, shape (3, points, planes)
      real(wp), intent(in) :: trial(:, :, :)
      !> Field that takes the stresses
      type(joint_field_type), intent(inout) :: field

      integer :: j, k

      do j = 1, size(trial, 3)
         do k = 1, size(points)
            field%stress(:, k, j) = admit_stress( &
               model%joint_materials(points(k)%material)%law, trial(:, k, j))
         end do
      end do
   end subroutine admit

   !> States from stresses and jumps, not from the last trial stress: once the
   !> loop has converged, that differs from the admitted by rounding only
   pure subroutine judge_states(model, points, field)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Field that takes the states
      type(joint_field_type), intent(inout) :: field

      real(wp) :: small
      integer :: j, k

      small = noise*maxval([0.0_wp, abs(field%stress)])
      do j = 1, size(field%state, 2)
         do k = 1, size(points)
            associate (law => model%joint_materials(points(k)%material)%law)
               field%state(k, j) = state_of(law, field%stress(:, k, j), field%jump(:, k, j), small)
            end associate
         end do
      end do
   end subroutine judge_states

   !> Points times planes that carry pressure across an open gap, and the widest
   !> of these gaps: the accumulated stress of step 3 may leave some
   pure subroutine n_across_gaps(field, n, widest)
      !> The field
      type(joint_field_type), intent(in) :: field
      !> The number
      integer, intent(out) :: n
      !> The gap
      real(wp), intent(out) :: widest

      logical :: across(size(field%state, 1), size(field%state, 2))

      associate (gap => field%jump(eta, :, :), stress => field%stress(eta, :, :))
         across = gap > 1.0e-3_wp*maxval([0.0_wp, abs(gap)]) &
            .and. stress < -1.0e-3_wp*maxval([0.0_wp, abs(stress)])
         n = count(across)
         widest = maxval([0.0_wp, pack(gap, across)])
      end associate
   end subroutine n_across_gaps

   !> Number of points times planes that slip and that are open
   pure subroutine count_state(field, n_slip, n_open)
      !> The field
      type(joint_field_type), intent(in) :: field
      !> The numbers
      integer, intent(out) :: n_slip, n_open

      n_slip = count(field%state == state_slip)
      n_open = count(field%state == state_open)
   end subroutine count_state

end module axijoint_joints_field
