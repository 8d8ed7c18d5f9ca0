!> The problem that a job with bodies that yield poses, and its loads as methods see them
module axijoint_plastic_posed
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_rigid_motion, only : solid_parts
   use axijoint_assembly_solid_force, only : solid_force
   use axijoint_base_kinds, only : wp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : new_joint_field
   use axijoint_joints_history, only : history_type, new_history
   use axijoint_joints_methods, only : new_method
   use axijoint_model_mesh, only : mesh_type
   use axijoint_model_model, only : model_type
   use axijoint_plastic_bodies, only : bodies_type
   use axijoint_plastic_elastic, only : to_vector
   use axijoint_plastic_field, only : body_load_type, body_planes, no_body_load
   use axijoint_plastic_problem, only : problem_type
   implicit none
   private
   public :: pose, take_load

contains

   !> Bodies, planes and joints of a job, without loads
   subroutine pose(model, equations, condensed, bodies, problem, history)
      !> The job
      type(model_type), intent(in) :: model
      !> Equations of all modes, assembled
      type(equations_type), intent(in), target :: equations
      !> The condensed structure; empty if no joint can yield
      type(condensed_type), intent(in), target :: condensed
      !> The bodies
      type(bodies_type), intent(in), target :: bodies
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> What bodies and joints have in common, and the joints, before all
      type(history_type), intent(out) :: history

      problem%equations => equations
      problem%bodies => bodies
      problem%planes = body_planes(equations%modes, model%n_body_planes)
      problem%load = no_body_load(equations, bodies)
      call find_parts(model%mesh, bodies, problem%part)
      problem%has_potential = size(condensed%points) == 0 &
         .and. all(abs(bodies%laws%friction - bodies%laws%dilation) <= 0.0_wp)
      if (size(condensed%points) > 0) then
         call new_history(model, condensed, history)
         allocate (problem%joints)
         problem%joints%condensed => condensed
         problem%joints%scene = history%scene
         problem%joints%method = new_method(model%method)
         problem%joints%before = history%field
         problem%joints%field = history%field
      else
         history%field = new_joint_field(0, 1, size(equations%modes), 0)
         history%method = new_method(model%method)
         history%beside = ''
         allocate (history%path(0), history%states(0), history%residuals(0), &
            history%ahead(0), history%largest_stress(0))
      end if
   end subroutine pose

   !> Part of each node, counted among those that can yield
   subroutine find_parts(mesh, bodies, part)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> Zero where nothing can yield; not allocated where all nodes are of one part
      integer, allocatable, intent(out) :: part(:)

      integer, allocatable :: solid(:), number(:)
      integer :: k, n

      call solid_parts(mesh, solid)
      if (maxval(solid) < 2) return
      allocate (number(maxval(solid)), source=0)
      n = 0
      do k = 1, size(bodies%elements)
         associate (of_body => number(solid(bodies%elements(k)%nodes(1))))
            if (of_body > 0) cycle
            n = n + 1
            of_body = n
         end associate
      end do
      part = number(solid)
   end subroutine find_parts

   !> Loads on the nodes as methods see them
   subroutine take_load(model, problem, loading, load)
      !> The job
      type(model_type), intent(in) :: model
      !> The problem
      type(problem_type), intent(in) :: problem
      !> Loads on the nodes
      type(loading_type), intent(in) :: loading
      !> The same for the bodies
      type(body_load_type), intent(out) :: load

      integer :: k

      associate (equations => problem%equations, bodies => problem%bodies)
         load%right = to_vector(equations, loading%right)
         if (allocated(loading%held)) load%held = loading%held
         allocate (load%initial(6, size(bodies%laws), size(equations%modes)))
         do k = 1, size(equations%modes)
            load%initial(:, :, k) = stress_without_strain(model, problem, loading, k)
         end do
      end associate
   end subroutine take_load

   !> Stress amplitudes of one mode that the bodies have without strain: in-situ stress and
   !> temperature
   function stress_without_strain(model, problem, loading, k) result(stress)
      !> The job
      type(model_type), intent(in) :: model
      !> The problem
      type(problem_type), intent(in) :: problem
      !> The loads
      type(loading_type), intent(in) :: loading
      !> Place of the mode
      integer, intent(in) :: k
      !> Shape (6, points of the bodies)
      real(wp), allocatable :: stress(:, :)

      real(wp), allocatable :: everywhere(:, :), force(:, :), still(:, :)

      associate (bodies => problem%bodies)
         if (.not. loading%initial%present) then
            allocate (stress(6, size(bodies%laws)), source=0.0_wp)
            return
         end if
         allocate (still(3, size(loading%external, 2)), source=0.0_wp)
         allocate (force, mold=still)
         allocate (everywhere(6, bodies%n_all))
         call solid_force(model, loading%initial, k, problem%equations%modes(k), still, force, &
            everywhere)
         stress = everywhere(:, bodies%place)
      end associate
   end function stress_without_strain

end module axijoint_plastic_posed
