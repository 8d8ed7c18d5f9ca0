!> The history of a job's joints: what the increments append to, and what results are read from
module axijoint_joints_history
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_element_joint_law, only : memory_type
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, new_joint_field
   use axijoint_joints_load_steps, only : step_type
   use axijoint_joints_mechanism, only : drives_on
   use axijoint_joints_method, only : method_type, control_type, verdict_type
   use axijoint_joints_methods, only : new_method
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_planes, only : on_all
   use axijoint_joints_residual, only : residual_record_type, ratios_of
   use axijoint_joints_scene, only : scene_type, new_scene, stand_where_they_are
   use axijoint_joints_states, only : increment_state_type, append_state
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: history_type, target_type, new_history, new_state, state_of, keep_state, &
      note_failure, forget_failure, note_residual, most_turns, turning_places

   !> Turns of the loads that errors are followed through at most
   integer, parameter :: most_turns = 4

   !> Loads that are to be reached
   type :: target_type
      !> The loads
      type(step_type) :: step
      !> Halvings that are left on the way there
      integer :: halvings = 0
      !> Whether it is no more than a help on the way: passed over if it finds no equilibrium
      logical :: helps = .false.
   end type target_type

   !> What the increments came to
   type :: history_type
      !> The increment at work, or the last one if nothing lies ahead; loads of the last step in
      !> equilibrium; what is to be reached before the increment is done, the next one last
      integer :: increment = 0
      type(step_type) :: at
      type(target_type), allocatable :: ahead(:)
      !> How joints are brought to equilibrium, and when the last step ended
      class(method_type), allocatable :: method
      type(control_type) :: control
      !> Laws, planes, and the loads at the end
      type(scene_type) :: scene
      !> State of the joints that can yield: the last
      type(joint_field_type) :: field
      !> How the last step ended; whether iterations ran away in it though no load drives anything on there, so that the state
      !> is that before it; and whether Newton's method finds a state then
      type(verdict_type) :: verdict
      logical :: strayed = .false., newton_finds = .false.
      !> Whether the step at work is tried in all ways, and whether no smaller one follows
      logical :: thorough = .true., smallest = .false.
      !> Load steps in equilibrium in which cohesion fades over an opening, for the law has no state
      !> without that
      integer :: n_faded = 0
      !> Loads at the end: of the step that failed, or of the last in equilibrium
      !> if joints ran away beyond it
      type(loading_type) :: loading
      !> The largest loads on the way, by their norm (Psi_f), that norm, and that of the loads at
      !> the end
      type(loading_type) :: peak
      real(wp) :: peak_norm = 0.0_wp, load_norm = 0.0_wp
      !> Joint stress that the last loads in equilibrium would give if all joints held, amplitudes,
      !> shape
      !> (3, points, modes)
      real(wp), allocatable :: balanced(:, :, :)
      !> The motion that nothing resists, in multiples of the floating motions; allocated if the joints came to a mechanism
      real(wp), allocatable :: motion(:)
      !> The share of the increment that was to be behind then
      real(wp) :: failed_share = 0.0_wp
      !> Sum of the load factors of the last step in equilibrium
      real(wp) :: reached = 0.0_wp
      !> Largest displacement that the loads of a step would give if all joints held
      real(wp) :: largest_elastic = 0.0_wp
      !> Bytes that this process sent and received in the iterations, where several share the work
      integer(i8) :: exchanged = 0
      !> Time that the increments took [second]
      real(wp) :: seconds = 0.0_wp
      !> Largest joint stress at the end of a step, of each point: what errors are measured by, for
      !> joints that were unloaded have none at the end
      real(wp), allocatable :: largest_stress(:)
      !> States at the ends of increments, as they were reached
      type(increment_state_type), allocatable :: states(:)
      !> What the points remembered in the last step, before its slip was added, shape
      !> (points, planes)
      type(memory_type), allocatable :: memory(:, :)
      !> What they remembered at its beginning, before bonds broke and points softened in it
      type(memory_type), allocatable :: start(:, :)
      !> Convergence path
      type(iteration_type), allocatable :: path(:)
      !> What the iterations left out of balance, one entry a step in equilibrium, and the last if
      !> it failed
      type(residual_record_type), allocatable :: residuals(:)
      !> Whether the last of them is of a step in equilibrium
      logical :: noted = .true.
      !> Bodies that yield beside the joints, as bytes: only their own driver knows more
      character(len=:), allocatable :: beside
      !> What ended the increments before their time: too little memory
      type(error_type), allocatable :: failure
   end type history_type

contains

   !> Nothing has happened yet
   subroutine new_history(model, condensed, history)
      !> The job
      type(model_type), intent(in) :: model
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The history
      type(history_type), intent(out) :: history

      history%method = new_method(model%method)
      history%scene = new_scene(model, condensed)
      history%field = new_state(condensed, history%scene)
      allocate (history%path(0), history%states(0), history%residuals(0), history%ahead(0))
      allocate (history%largest_stress(size(condensed%points)), source=0.0_wp)
      allocate (history%balanced, source=history%field%excess)  ! zero
      history%beside = ''
   end subroutine new_history

   !> Joints without stress
   pure function new_state(condensed, scene) result(field)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Planes
      type(scene_type), intent(in) :: scene
      !> The state
      type(joint_field_type) :: field

      field = new_joint_field(size(condensed%points), size(scene%planes%angle), size(scene%modes), &
                              size(condensed%floating))
   end function new_state

   !> The state that the joints are in
   pure function state_of(history, field, increment, load_factor, case_factor) result(state)
      !> The history, for its planes
      type(history_type), intent(in) :: history
      !> Joints that can yield
      type(joint_field_type), intent(in) :: field
      !> Increment
      integer, intent(in) :: increment
      !> Sum of the load factors, and factor of each load case
      real(wp), intent(in) :: load_factor, case_factor(:)
      !> The state
      type(increment_state_type) :: state

      state%increment = increment
      state%load_factor = load_factor
      state%case_factor = case_factor
      state%peak_factor = case_factor
      if (allocated(history%peak%case_factor)) state%peak_factor = history%peak%case_factor
      associate (planes => history%scene%planes)
         state%jump = on_all(planes, field%jump)
         state%stress = on_all(planes, field%stress)
         state%initial = field%initial
         state%state = field%state(:, planes%place)
         state%excess = field%excess
         state%pending = field%pending
         state%offset = field%offset
      end associate
   end function state_of

   !> Append the state at the end of an increment in equilibrium
   subroutine keep_state(condensed, increment, load_factor, case_factor, history)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Increment
      integer, intent(in) :: increment
      !> Sum of the load factors, and factor of each load case
      real(wp), intent(in) :: load_factor, case_factor(:)
      !> The history
      type(history_type), intent(inout) :: history

      type(joint_field_type) :: field

      field = history%field
      call stand_where_they_are(condensed, history%scene, field)
      call append_state(history%states, state_of(history, field, increment, load_factor, case_factor))
   end subroutine keep_state

   !> Note which motion nothing resists, or a load drives on where joints ran away
   subroutine note_failure(condensed, step, history)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The last step
      type(step_type), intent(in) :: step
      !> The history, that step not in equilibrium
      type(history_type), intent(inout) :: history

      real(wp), allocatable :: motion(:)
      logical :: driven

      driven = .false.
      if (history%verdict%ran_away) call drives_on(condensed, history%scene, history%field, driven, motion)
      if (.not. (driven .or. history%verdict%mechanism%loaded)) return
      call forget_failure(history)
      history%failed_share = step%share
      if (driven) call move_alloc(motion, history%motion)
      if (history%verdict%mechanism%loaded) history%motion = history%verdict%mechanism%motion
   end subroutine note_failure

   !> Smaller steps got there
   subroutine forget_failure(history)
      !> The history
      type(history_type), intent(inout) :: history

      if (allocated(history%motion)) deallocate (history%motion)
   end subroutine forget_failure

   !> Note what a step left out of balance; one that failed is forgotten at the next
   subroutine note_residual(condensed, increment, load_factor, history)
      !> What residuals are measured by
      type(condensed_type), intent(in) :: condensed
      !> Increment, and sum of the load factors
      integer, intent(in) :: increment
      real(wp), intent(in) :: load_factor
      !> Takes the entry
      type(history_type), intent(inout) :: history

      type(residual_record_type) :: record

      record = ratios_of(condensed%measure, history%scene%loads%reference, history%field%pending)
      record%increment = increment
      record%load_factor = load_factor
      if (size(history%residuals) > 0 .and. .not. history%noted) then
         history%residuals = history%residuals(:size(history%residuals) - 1)
      end if
      history%residuals = [history%residuals, record]
      history%noted = history%verdict%converged
   end subroutine note_residual

   !> Places of the states after which loads turn. Loads that are held turn nothing
   pure function turning_places(history) result(places)
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> The places
      integer, allocatable :: places(:)

      !> Loads turn where the cosine of the angle between their changes is less; changes up to this part of them are none
      real(wp), parameter :: straight = 1.0_wp - 1.0e-6_wp, rounding = 1.0e-12_wp
      real(wp), allocatable :: before(:), after(:)
      integer :: k

      allocate (places(0))
      before = 0.0_wp*history%loading%case_factor
      associate (states => history%states)
         do k = 1, size(states)
            after = states(k)%case_factor
            if (k > 1) after = after - states(k - 1)%case_factor
            if (norm2(after) > rounding*norm2(states(k)%case_factor)) before = after
            after = history%loading%case_factor - states(k)%case_factor
            if (k < size(states)) after = states(k + 1)%case_factor - states(k)%case_factor
            if (.not. norm2(after) > rounding*norm2(states(k)%case_factor)) cycle
            if (dot_product(before, after) < straight*norm2(before)*norm2(after)) places = [places, k]
         end do
      end associate
   end function turning_places

end module axijoint_joints_history
