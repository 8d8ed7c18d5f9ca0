!> Structures whose bodies yield, ready to be loaded
module axijoint_test_yielding
   use axijoint_assembly_equations, only : equations_type, plan_equations, assemble_equations
   use axijoint_assembly_factors, only : plan_factors, factorize_equations
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_assembly_pattern, only : node_graph
   use axijoint_assembly_support, only : new_support_points
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_element_yield_law, only : yield_law_type
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_condensed, only : condensed_type, new_condensed
   use axijoint_joints_field, only : set_initial_stress
   use axijoint_joints_history, only : history_type, new_history
   use axijoint_joints_method, only : control_type
   use axijoint_joints_methods, only : new_method
   use axijoint_joints_residual, only : load_norm
   use axijoint_model_joint_points, only : new_joint_points
   use axijoint_model_load, only : combination_type
   use axijoint_model_model, only : model_type, can_yield, method_newton
   use axijoint_plastic_bodies, only : bodies_type, new_bodies
   use axijoint_plastic_elastic, only : to_vector
   use axijoint_plastic_field, only : body_field_type, body_load_type, body_planes, &
      new_body_field, no_body_load, commit
   use axijoint_plastic_joint_side, only : commit_joints
   use axijoint_plastic_problem, only : problem_type, put_load
   implicit none
   private
   public :: yielding_type, new_yielding, unit_load, load_by, keep, steady

   !> What a test holds
   type :: yielding_type
      type(equations_type), allocatable :: equations
      type(bodies_type) :: bodies
      type(condensed_type) :: condensed
      type(problem_type) :: problem
      type(body_field_type) :: field
      type(loading_type) :: loading
   end type yielding_type

contains

   !> Assemble and factor
   subroutine new_yielding(model, laws, modes, yielding, n_planes)
      !> The job
      type(model_type), intent(in) :: model
      !> Law of each material
      type(yield_law_type), intent(in) :: laws(:)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> The structure
      type(yielding_type), intent(out), target :: yielding
      !> Planes, if not the usual number
      integer, intent(in), optional :: n_planes

      type(error_type), allocatable :: error

      call plan_equations(yielding%equations, model, modes, node_graph(model%mesh), error)
      if (allocated(error)) error stop 'no plan'
      call plan_factors(yielding%equations, .true., 0_i8, 0_i8, 0_i8, model%memory_limit, error)
      if (allocated(error)) error stop 'no memory'
      call assemble_equations(yielding%equations, model, new_joint_points(model), &
                              new_support_points(model))
      call factorize_equations(yielding%equations, model, error)
      if (allocated(error)) error stop 'singular'
      call new_bodies(model, laws, yielding%bodies)
      call new_loading(model, new_joint_points(model), new_support_points(model), modes, &
                       yielding%equations%unit_loads, combination_type(1, [1.0_wp]), yielding%loading)
      yielding%problem%equations => yielding%equations
      yielding%problem%bodies => yielding%bodies
      yielding%problem%planes = body_planes(modes, n_planes)
      yielding%problem%load = no_body_load(yielding%equations, yielding%bodies)
      yielding%problem%has_potential = all(abs(laws%friction - laws%dilation) <= 0.0_wp)
      if (can_yield(model)) call add_joints(model, yielding)
      yielding%field = new_body_field(yielding%equations, yielding%bodies, yielding%problem%planes)
   end subroutine new_yielding

   !> Joints that open and slip
   subroutine add_joints(model, yielding)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(yielding_type), intent(inout), target :: yielding

      type(error_type), allocatable :: error
      type(history_type) :: history

      call new_condensed(model, new_joint_points(model), new_support_points(model), &
                         yielding%equations, yielding%condensed, error)
      if (allocated(error)) error stop 'not condensed'
      call new_history(model, yielding%condensed, history)
      allocate (yielding%problem%joints)
      associate (side => yielding%problem%joints)
         side%condensed => yielding%condensed
         side%scene = history%scene
         side%method = new_method(method_newton)
         side%control = control_type(1.0e-9_wp, 200)
         side%field = history%field
         call set_initial_stress(model, yielding%condensed%points, [1.0_wp], side%field)
         side%before = side%field
      end associate
   end subroutine add_joints

   !> Keep the state
   subroutine keep(yielding)
      !> The structure, in equilibrium
      type(yielding_type), intent(inout) :: yielding

      call commit(yielding%bodies, yielding%problem%planes, yielding%problem%load, yielding%field)
      if (allocated(yielding%problem%joints)) &
         call commit_joints(yielding%problem%joints)
   end subroutine keep

   !> The load of the deck, on the unknowns
   function unit_load(yielding) result(load)
      !> The structure
      type(yielding_type), intent(in) :: yielding
      !> The load
      real(wp), allocatable :: load(:)

      load = to_vector(yielding%equations, yielding%loading%right)
   end function unit_load

   !> Put a share of the load of the deck on
   subroutine load_by(yielding, factor)
      !> The structure
      type(yielding_type), intent(inout) :: yielding
      !> The share
      real(wp), intent(in) :: factor

      type(body_load_type) :: load

      real(wp), allocatable :: external(:, :, :)

      external = factor*yielding%loading%external
      load = yielding%problem%load
      load%right = factor*unit_load(yielding)
      if (allocated(yielding%loading%held)) load%held = factor*yielding%loading%held
      yielding%problem%load_norm = abs(factor)*load_norm(yielding%equations, yielding%loading)
      call put_load(yielding%problem, load, external, yielding%field)
   end subroutine load_by

   !> A law with the elastic constants of a material
   pure function steady(criterion, young, poisson, strength) result(law)
      !> Criterion, elastic constants, strength
      integer, intent(in) :: criterion
      real(wp), intent(in) :: young, poisson, strength
      !> The law
      type(yield_law_type) :: law

      law%criterion = criterion
      law%shear = 0.5_wp*young/(1.0_wp + poisson)
      law%bulk = young/(3.0_wp*(1.0_wp - 2.0_wp*poisson))
      law%strength = strength
   end function steady

end module axijoint_test_yielding
