!> Small models built in memory, for tests against exact solutions
module axijoint_test_scenes
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : joint_law_type, law_elastic
   use axijoint_fe_element_kind, only : kind_choice_type
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_blank, only : new_model
   use axijoint_model_build, only : add_material, add_law, add_body => add_block, &
      join_bodies => add_interface, &
      add_traction, node_at, place_function, traction_function
   use axijoint_model_load, only : increment_type
   use axijoint_model_material, only : solid_material_type, joint_material_type
   use axijoint_model_model, only : model_type, method_transfer
   implicit none
   private
   public :: new_scene, add_block, add_interface, add_edge_traction, set_elastic, node_at

contains

   !> Empty model with one material and one elastic joint material
   function new_scene(young, poisson, max_harmonic) result(model)
      !> Elastic constants
      real(wp), intent(in) :: young, poisson
      !> Highest harmonic
      integer, intent(in) :: max_harmonic
      !> The model
      type(model_type) :: model

      model = new_model('scene', max_harmonic)
      call add_material(model, solid_material_type(young=young, poisson=poisson))
      call add_law(model, joint_law_type())
      model%n_planes = 4*max_harmonic + 2
      model%method = method_transfer
      model%increments = [increment_type()]
   end function new_scene

   !> Add a grid of elements of the first material whose corners are the image of a grid on the unit
   !> square
   subroutine add_block(model, n_nodes, n1, n2, place, choice)
      !> The model
      type(model_type), intent(inout) :: model
      !> Nodes of an element: 3, 4, 6, 8 or 9
      integer, intent(in) :: n_nodes
      !> Cells in each direction
      integer, intent(in) :: n1, n2
      !> Image of a point of the unit square: r and z
      procedure(place_function) :: place
      !> Rules and formulation, if not the usual ones
      type(kind_choice_type), intent(in), optional :: choice

      call add_body(model, 1, n_nodes, [n1, n2], place, choice)
   end subroutine add_block

   !> Stiffness and rule of the elastic joint material
   subroutine set_elastic(model, stiffness, rule)
      !> The model
      type(model_type), intent(inout) :: model
      !> Stiffness per unit area along xi, eta, theta
      real(wp), intent(in) :: stiffness(3)
      !> Integration rule
      integer, intent(in) :: rule

      model%joint_materials(1) = joint_material_type(1, rule, &
         joint_law_type(law_elastic, stiffness))
   end subroutine set_elastic

   !> Join the edges of two bodies along a straight line: side 1-2 on the lower
   !> body, side 4-3 on the upper
   subroutine add_interface(model, lower_body, upper_body, from, to)
      !> The model
      type(model_type), intent(inout) :: model
      !> Bodies on sides 1-2 and 4-3
      integer, intent(in) :: lower_body, upper_body
      !> Ends of the line
      real(wp), intent(in) :: from(2), to(2)

      type(error_type), allocatable :: error

      call join_bodies(model, 1, [lower_body, upper_body], from, to, error)
      if (allocated(error)) error stop 'the scene has no such interface'
   end subroutine add_interface

   !> Put a traction on all outer edges along a straight line
   subroutine add_edge_traction(model, harmonic, from, to, traction)
      !> The model
      type(model_type), intent(inout) :: model
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> Ends of the line
      real(wp), intent(in) :: from(2), to(2)
      !> Amplitudes t_r, t_z, t_theta at r and z
      procedure(traction_function) :: traction

      type(error_type), allocatable :: error

      call add_traction(model, mode_type(harmonic), from, to, traction, error)
      if (allocated(error)) error stop 'the scene has no such edge'
   end subroutine add_edge_traction

end module axijoint_test_scenes
