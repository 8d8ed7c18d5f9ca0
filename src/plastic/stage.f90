!> What the increments of bodies that yield act on, and what they append to
module axijoint_plastic_stage
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_factors, only : report_failure
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_joints_field, only : set_initial_stress
   use axijoint_joints_history, only : history_type
   use axijoint_joints_load_steps, only : step_type
   use axijoint_joints_residual, only : load_norm
   use axijoint_joints_stage, only : stage_type
   use axijoint_plastic_bodies, only : bodies_type
   use axijoint_plastic_elastic, only : to_vector
   use axijoint_plastic_field, only : body_field_type, body_load_type, new_body_field
   use axijoint_plastic_methods, only : body_verdict_type
   use axijoint_plastic_posed, only : pose, take_load
   use axijoint_plastic_problem, only : slight, problem_type, steering_type, put_load, steer, &
      go_to_displacement
   implicit none
   private
   public :: body_stage_type, body_history_type, begin_history, put, steer_to, put_found

   !> What the increments came to, beside what bodies and joints have in common
   type :: body_history_type
      !> State of the bodies: at the last equilibrium, if there was one
      type(body_field_type) :: field
      !> How the last step ended
      type(body_verdict_type) :: verdict
      !> What the step that failed changed of the displacements, shape (3, nodes, modes); its load
      !> factor. Not allocated if none did
      real(wp), allocatable :: failing(:, :, :)
      real(wp) :: tried = 0.0_wp
      !> Its largest displacement over that of elastic bodies
      real(wp) :: growth = 0.0_wp
      !> Iterations and elastic solutions of the increment at work
      integer :: counts(2) = 0
   end type body_history_type

   !> What the increments act on
   type, abstract, extends(stage_type) :: body_stage_type
      !> Bodies and joints, as methods see them
      type(problem_type) :: problem
      !> What the increments came to
      type(body_history_type) :: bodies
   end type body_stage_type

contains

   !> Nothing has happened yet
   subroutine begin_history(stage, bodies, history)
      !> What the increments act on
      class(body_stage_type), intent(inout) :: stage
      !> The bodies
      type(bodies_type), intent(in), target :: bodies
      !> What bodies and joints have in common, and the joints
      type(history_type), intent(out) :: history

      call pose(stage%model, stage%equations, stage%condensed, bodies, stage%problem, history)
      stage%bodies%field = new_body_field(stage%equations, bodies, stage%problem%planes)
   end subroutine begin_history

   !> Put loads on
   subroutine put(stage, step, history)
      !> What the increments act on
      class(body_stage_type), intent(inout) :: stage
      !> Loads
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(inout) :: history

      type(body_load_type) :: load

      associate (problem => stage%problem)
         call stage%put_on_nodes(step%case_factor, history%loading)
         call note_peak(stage, history)
         problem%peak = history%peak_norm
         problem%load_norm = history%load_norm
         call take_load(stage%model, problem, history%loading, load)
         call put_load(problem, load, history%loading%external, stage%bodies%field)
         call report_failure(stage%equations, stage%model, history%failure)
         if (.not. allocated(problem%joints)) return
         call set_initial_stress(stage%model, stage%condensed%points, step%case_factor, &
            problem%joints%field)
      end associate
   end subroutine put

   !> Let the displacement of a step be given instead of its loads: where the work of those that the
   !> increment would add for elastic bodies goes on to its share
   subroutine steer_to(stage, step, history)
      !> What the increments act on
      class(body_stage_type), intent(inout) :: stage
      !> The step
      type(step_type), intent(in) :: step
      !> The history
      type(history_type), intent(inout) :: history

      type(loading_type) :: loading
      real(wp), allocatable :: load(:)

      stage%problem%steering = steering_type()  ! that of a try before
      call put(stage, history%at, history)
      if (allocated(history%failure)) return
      call stage%put_on_nodes(step%steered, loading)
      load = to_vector(stage%equations, loading%right)
      if (.not. any(abs(load) > 0.0_wp)) return  ! a case without forces
      associate (problem => stage%problem)
         call steer(problem, load)
         associate (own => problem%steering%response, begun => stage%bodies%field%begun, &
                    factor => stage%model%increments(history%increment)%factor)
            call go_to_displacement(problem, dot_product(load, begun) &
               + factor*(step%share - history%at%share)*dot_product(load, own), stage%bodies%field)
         end associate
      end associate
   end subroutine steer_to

   !> Put the loads on that the given displacement was found to need
   subroutine put_found(stage, step, history)
      !> What the increments act on
      class(body_stage_type), intent(inout) :: stage
      !> The step; takes the loads
      type(step_type), intent(inout) :: step
      !> The history
      type(history_type), intent(inout) :: history

      type(body_load_type) :: load

      associate (problem => stage%problem, found => stage%problem%steering%factor)
         step%case_factor = history%at%case_factor + found*step%steered
         ! the path was written with the factor of the card, which is that of the displacement
         where (history%path%increment == history%increment .and. abs(history%path%load_factor - step%load_factor) <= 0.0_wp) &
            history%path%load_factor = history%at%load_factor + found
         step%load_factor = history%at%load_factor + found
         associate (share => step%share - history%at%share, given => stage%model%increments(history%increment)%factor)
            ! the displacement may need next to no load: residuals are held against what it would need if all held
            call stage%put_on_nodes(slight*share*given*step%steered, history%loading)
         end associate
         call note_peak(stage, history)
         call stage%put_on_nodes(step%case_factor, history%loading)
         call note_peak(stage, history)
         call take_load(stage%model, problem, history%loading, load)
         problem%load = load
         problem%steering = steering_type()
      end associate
   end subroutine put_found

   !> Note the largest loads
   subroutine note_peak(stage, history)
      !> What the increments act on
      class(body_stage_type), intent(in) :: stage
      !> The history, its loads on the nodes
      type(history_type), intent(inout) :: history

      history%load_norm = load_norm(stage%equations, history%loading)
      if (history%load_norm < history%peak_norm) return
      history%peak_norm = history%load_norm
      history%peak = history%loading
   end subroutine note_peak

end module axijoint_plastic_stage
