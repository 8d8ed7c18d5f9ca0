!> Discs on a held one, condensed to the joints between them: what the modules of the joint
!> iterations are tested on
module axijoint_test_discs
   use axijoint_analysis_core_structure, only : structure_type, build_structure
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_timer, only : timer_type
   use axijoint_element_joint_law, only : joint_law_type, law_paper, slip_resultant
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_history, only : new_state
   use axijoint_joints_loads, only : put_loads
   use axijoint_joints_newton, only : newton_view
   use axijoint_joints_scene, only : scene_type, new_scene_of => new_scene
   use axijoint_model_load, only : combination_type
   use axijoint_model_material, only : joint_material_type, rule_gauss
   use axijoint_model_model, only : model_type, method_newton
   use axijoint_test_scenes, only : new_scene, add_block, add_interface, add_edge_traction
   implicit none
   private
   public :: discs_type, discs_on_ground, add_load, condense, load_by, weight, push

   !> Height of each disc
   real(wp), parameter, public :: height = 0.2_wp
   !> Modulus of the discs: next to it, a joint of unit stiffness is soft
   real(wp), parameter, public :: young = 1.0e6_wp

   !> Discs, condensed, and what is asked of them
   type, extends(structure_type) :: discs_type
      !> The job
      type(model_type) :: model
      !> Laws, planes and loads
      type(scene_type) :: scene
   end type discs_type

contains

   !> Discs of radius 1, the lowest held at its bottom; the joints have unit stiffness
   function discs_on_ground(n_discs, n_elements, friction, gap) result(model)
      !> Discs upon the held one, and elements along the radius
      integer, intent(in) :: n_discs, n_elements
      !> Tangent of the friction angle, and gap before loading
      real(wp), intent(in) :: friction, gap
      !> The model, without loads
      type(model_type) :: model

      integer :: k

      model = new_scene(young, 0.0_wp, 2)
      model%method = method_newton
      model%n_planes = 9
      model%joint_materials = [joint_material_type(1, rule_gauss, joint_law_type(kind=law_paper, &
         stiffness=[1.0_wp, 1.0_wp, 1.0_wp], friction=friction, slip=slip_resultant, gap=gap))]
      do k = 0, n_discs
         call add_block(model, 4, n_elements, 1, disc)
         associate (x => model%mesh%coordinates)
            x(2, size(x, 2)/(k + 1)*k + 1:) = x(2, size(x, 2)/(k + 1)*k + 1:) + (k - 1)*height
         end associate
         if (k > 0) &
            call add_interface(model, k, k + 1, [0.0_wp, (k - 1)*height], [1.0_wp, (k - 1)*height])
      end do
      where (spread(model%mesh%coordinates(2, :), 1, 3) < -0.99_wp*height) model%fixed = .true.
   end function discs_on_ground

   !> A disc on z = 0
   function disc(x, y) result(place)
      !> Point of the unit square
      real(wp), intent(in) :: x, y
      !> r and z
      real(wp) :: place(2)

      place = [x, y*height]
   end function disc

   !> Put a load on the top, multiplied by a factor
   subroutine add_load(model, harmonic, factor, traction)
      !> The model
      type(model_type), intent(inout) :: model
      !> Harmonic, and the factor
      integer, intent(in) :: harmonic
      real(wp), intent(in) :: factor
      !> The load
      interface
         function traction(position)
            import :: wp
            !> r and z
            real(wp), intent(in) :: position(2)
            !> Amplitudes t_r, t_z, t_theta
            real(wp) :: traction(3)
         end function traction
      end interface

      real(wp) :: top
      integer :: first, k

      first = size(model%edge_loads) + 1
      top = maxval(model%mesh%coordinates(2, :))
      call add_edge_traction(model, harmonic, [0.0_wp, top], [1.0_wp, top], traction)
      do k = first, size(model%edge_loads)
         model%edge_loads(k)%traction = factor*model%edge_loads(k)%traction
      end do
   end subroutine add_load

   !> Pressure one, of harmonic 0
   function weight(position) result(traction)
      !> r and z
      real(wp), intent(in) :: position(2)
      !> Amplitudes
      real(wp) :: traction(3)

      traction = [0.0_wp, -1.0_wp, 0.0_wp] + 0.0_wp*position(1)
   end function weight

   !> Lateral force pi, of harmonic 1
   function push(position) result(traction)
      !> r and z
      real(wp), intent(in) :: position(2)
      !> Amplitudes
      real(wp) :: traction(3)

      traction = [1.0_wp, 0.0_wp, -1.0_wp] + 0.0_wp*position(1)
   end function push

   !> Condense the structure to its joints
   subroutine condense(model, structure, field)
      !> The model
      type(model_type), intent(in) :: model
      !> The structure
      type(discs_type), intent(out) :: structure
      !> Joints without stress
      type(joint_field_type), intent(out) :: field

      type(timer_type) :: timer
      type(progress_type) :: progress
      type(error_type), allocatable :: error

      call build_structure(model, structure%structure_type, timer, progress, error)
      if (allocated(error)) error stop 'a test scene cannot be condensed'
      structure%model = model
      structure%scene = new_scene_of(model, structure%condensed)
      field = new_state(structure%condensed, structure%scene)
      field%view_limit = newton_view
   end subroutine condense

   !> Load it by a multiple of the loads
   subroutine load_by(structure, factor)
      !> The structure, condensed
      type(discs_type), intent(inout) :: structure
      !> The factor
      real(wp), intent(in) :: factor

      type(loading_type) :: loading

      call new_loading(structure%model, structure%joint_points, structure%support_points, &
         structure%modes, structure%equations%unit_loads, &
                       combination_type(label=1, factor=[factor]), loading)
      call put_loads(structure%equations, structure%condensed, loading, structure%scene%loads)
   end subroutine load_by

end module axijoint_test_discs
