!> Joints that open and slip beside bodies that yield. For given plastic strain of the bodies they
!> are brought to equilibrium on the condensed structure, by the method of the job, so the bodies
!> see a structure whose joints are always in equilibrium
module axijoint_plastic_joint_side
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_force, only : joint_force, joint_jump
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_field, only : joint_field_type, commit_field, mend
   use axijoint_joints_floating, only : add_motions
   use axijoint_joints_loads, only : put_work
   use axijoint_joints_method, only : method_type, control_type, verdict_type
   use axijoint_joints_newton, only : newton_type, linearize, at_points
   use axijoint_joints_newton_system, only : linear_type, gathering_type, solve
   use axijoint_joints_passes, only : keep_standing
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_planes, only : synthesize, analyse
   use axijoint_joints_residual, only : set_reference
   use axijoint_joints_scene, only : scene_type, given_work_type, elastic_stress, rounded_stress
   use axijoint_plastic_elastic, only : to_vector, to_nodes, from_nodes, elastic_response
   implicit none
   private
   public :: joint_side_type, begin_joint_step, steer_joints, balance_joints, linearize_joints, &
      joint_tangent_force, add_units, commit_joints, find_joint_motion

   !> What the linear solution of the joints leaves of its right side
   real(wp), parameter :: linear_tolerance = 1.0e-4_wp
   !> Share of the largest stress that is rounding there
   real(wp), parameter :: rounding = 1.0e-14_wp

   !> The joints
   type :: joint_side_type
      !> The condensed structure; none if no joint can yield
      type(condensed_type), pointer :: condensed => null()
      !> Laws, planes, loads
      type(scene_type) :: scene
      !> How they are brought to equilibrium, and when that ends
      class(method_type), allocatable :: method
      type(control_type) :: control
      !> Their state, and as it was at the last increment in equilibrium
      type(joint_field_type) :: field, before
      !> Amplitudes of the stress that the joints would carry if they held, at that increment, shape
      !> (3, points, modes)
      real(wp), allocatable :: balanced(:, :, :)
      !> How the last equilibrium was reached
      type(verdict_type) :: verdict
      !> Their laws about that equilibrium
      type(newton_type) :: tangent
      !> Whether residuals have their reference in this step, and modes that it loads: what plastic
      !> strain changes in others is no measure of forces there
      logical :: begun = .false.
      logical, allocatable :: pushed(:)
      !> What the step would add to the stress of joints that hold, if it is not what the loads add:
      !> where work is given in place of a load, shape (3, points, modes)
      real(wp), allocatable :: added(:, :, :)
   end type joint_side_type

contains

   !> Begin a step from the last increment in equilibrium
   subroutine begin_joint_step(side, pushed, external)
      !> The joints
      type(joint_side_type), intent(inout) :: side
      !> Modes that the step loads
      logical, intent(in) :: pushed(:)
      !> External forces on components, shape (3, nodes, modes)
      real(wp), intent(in) :: external(:, :, :)

      type(gathering_type) :: nothing

      side%tangent%gathering = nothing  ! a step has the same bits wherever a run goes on from
      side%field = side%before
      side%field%fading = 0.0_wp
      side%begun = .false.
      side%pushed = pushed
      if (allocated(side%added)) deallocate (side%added)
      side%scene%given = given_work_type()
      call put_work(side%condensed%floating, external, side%scene%loads)
   end subroutine begin_joint_step

   !> Let the work of a load be given in place of its size
   subroutine steer_joints(side, equations, load, response, step)
      !> The joints, at the begin of a step
      type(joint_side_type), intent(inout) :: side
      !> The equations
      type(equations_type), intent(in) :: equations
      !> A unit of the load on the unknowns, and the response of the elastic structure
      real(wp), intent(in) :: load(:), response(:)
      !> How many units the step would add if all were elastic
      real(wp), intent(in) :: step

      type(given_work_type) :: given
      real(wp), allocatable :: motion(:, :, :)
      integer :: k, p

      associate (condensed => side%condensed)
         allocate (given%jump, mold=side%field%excess)
         do k = 1, size(equations%modes)
            given%jump(:, :, k) = joint_jump(condensed%points, to_nodes(equations, response, k))
         end do
         given%weighted = given%jump
         side%added = given%jump
         do k = 1, size(equations%modes)
            do p = 1, size(condensed%points)
               given%weighted(:, p, k) = circle_integral(equations%modes(k)%harmonic) &
                  *condensed%points(p)%weight*given%jump(:, p, k)
               side%added(:, p, k) = step*condensed%points(p)%base*given%jump(:, p, k)
            end do
         end do
         given%compliance = dot_product(load, response)
         allocate (given%work(size(condensed%floating)))
         do k = 1, size(given%work)
            associate (floating => condensed%floating(k))
               allocate (motion(3, size(floating%displacement, 2), size(equations%modes)), &
                  source=0.0_wp)
               motion(:, :, floating%mode) = floating%displacement
               given%work(k) = dot_product(load, from_nodes(equations, motion))
               deallocate (motion)
            end associate
         end do
      end associate
      side%scene%given = given
   end subroutine steer_joints

   !> Take note that more of the load acts whose work is given
   subroutine add_units(side, units)
      !> The joints
      type(joint_side_type), intent(inout) :: side
      !> How much more of it
      real(wp), intent(in) :: units

      if (allocated(side%scene%given%jump)) &
         side%scene%loads%free = side%scene%loads%free + units*side%scene%given%jump
   end subroutine add_units

   !> Equilibrium of the joints, and the forces of the stress that they do not admit
   subroutine balance_joints(side, equations, free, held, norm, force)
      !> The joints
      type(joint_side_type), intent(inout) :: side
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Unknowns of the elastic structure under all else
      real(wp), intent(in) :: free(:)
      !> Displacements of held components, shape (3, nodes, modes), if there are any
      real(wp), intent(in), allocatable :: held(:, :, :)
      !> Norm of the loads
      real(wp), intent(in) :: norm
      !> The forces on the unknowns
      real(wp), intent(out) :: force(:)

      type(iteration_type), allocatable :: path(:)
      real(wp), allocatable :: displacement(:, :), change(:, :, :)
      integer :: k

      do k = 1, size(equations%modes)
         displacement = to_nodes(equations, free, k)
         if (allocated(held)) displacement = displacement + held(:, :, k)
         side%scene%loads%free(:, :, k) = joint_jump(side%condensed%points, displacement)
         side%scene%loads%largest(k) = maxval(abs(displacement))
      end do
      if (.not. side%begun) then
         if (.not. allocated(side%balanced)) &
            allocate (side%balanced, source=0.0_wp*side%scene%loads%free)
         if (allocated(side%added)) then
            change = side%added
         else
            change = elastic_stress(side%condensed, side%scene, side%field) - side%balanced
            do k = 1, size(side%pushed)
               if (.not. side%pushed(k)) change(:, :, k) = 0.0_wp
            end do
         end if
         call set_reference(side%condensed%measure, norm, change, side%balanced, &
            rounded_stress(side%condensed, side%scene), side%control%tolerance, side%scene%loads%reference)
         side%begun = .true.
      end if
      allocate (path(0))
      call mend(side%before%memory, side%field%memory)  ! bonds break in equilibrium, not on the way
      ! where cohesion fades over an opening it goes on to in this step, so that states follow each
      ! other without a jump
      side%control%warm = side%field%fading > 0.0_wp
      call side%method%balance(side%condensed, side%scene, side%control, side%field, path, &
         side%verdict)
      if (side%verdict%converged) then
         change = elastic_stress(side%condensed, side%scene, side%field) - side%balanced
         call keep_standing(side%method, side%condensed, side%scene, side%control%tolerance, side%before%jump, change, &
            side%verdict%mechanism, side%field)
      end if
      force = force_of(side, equations, side%field%excess, size(displacement, 2))
   end subroutine balance_joints

   !> Forces on the unknowns that excess stress gives
   function force_of(side, equations, excess, n_nodes) result(force)
      !> The joints
      type(joint_side_type), intent(in) :: side
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Amplitudes, shape (3, points, modes)
      real(wp), intent(in) :: excess(:, :, :)
      !> Number of nodes
      integer, intent(in) :: n_nodes
      !> The forces
      real(wp), allocatable :: force(:)

      real(wp), allocatable :: nodal(:, :, :)
      integer :: k

      allocate (nodal(3, n_nodes, size(equations%modes)))
      do k = 1, size(equations%modes)
         nodal(:, :, k) = joint_force(side%condensed%points, equations%modes(k)%harmonic, &
                                      excess(:, :, k), n_nodes)
      end do
      force = to_vector(equations, nodal)
   end function force_of

   !> Motion to which joints did not come to equilibrium: that which nothing resists, if a load acts on one, or where they
   !> ran away to
   subroutine find_joint_motion(side, equations, displacement)
      !> The joints
      type(joint_side_type), intent(in) :: side
      !> The equations, assembled
      type(equations_type), intent(inout) :: equations
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(inout) :: displacement(:, :, :)

      real(wp), allocatable :: force(:), response(:)
      integer :: k

      if (side%verdict%mechanism%loaded) then
         displacement = 0.0_wp
         call add_motions(side%condensed%floating, side%verdict%mechanism%motion, displacement)
         return
      end if
      force = force_of(side, equations, side%field%excess - side%before%excess, size(displacement, 2))
      allocate (response, mold=force)
      call elastic_response(equations, force, response)
      do k = 1, size(displacement, 3)
         displacement(:, :, k) = to_nodes(equations, response, k)
      end do
      call add_motions(side%condensed%floating, side%field%offset - side%before%offset, displacement)
   end subroutine find_joint_motion

   !> Find the laws about the last equilibrium: only Newton's method asks for them
   subroutine linearize_joints(side)
      !> The joints
      type(joint_side_type), intent(inout) :: side

      call linearize(side%condensed, side%scene, 0.0_wp, side%field, side%tangent)
   end subroutine linearize_joints

   !> Forces on the unknowns by which joints answer small displacements of the elastic structure:
   !> those of the excess stress e = A E' S (D v + F e)
   subroutine joint_tangent_force(side, equations, displacement, force)
      !> The joints, linearized; flexibilities that were gathered once serve again
      type(joint_side_type), intent(inout) :: side
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Unknowns v
      real(wp), intent(in) :: displacement(:)
      !> The forces
      real(wp), intent(out) :: force(:)

      type(linear_type) :: linear
      real(wp), allocatable :: nodal(:, :), change(:, :, :), jump(:, :, :)
      integer :: k

      allocate (jump, mold=side%field%excess)
      do k = 1, size(equations%modes)
         nodal = to_nodes(equations, displacement, k)
         jump(:, :, k) = joint_jump(side%condensed%points, nodal)
      end do
      linear = side%tangent%linear_type
      linear%residual = analyse(side%scene%planes, at_points(linear%slope, &
         synthesize(side%scene%planes, jump)))
      linear%rounding = rounding*maxval(abs(linear%residual))
      call solve(side%condensed, side%scene, linear, linear_tolerance, change, jump, side%tangent%gathering)
      force = force_of(side, equations, change, size(nodal, 2))
   end subroutine joint_tangent_force

   !> Keep the slip of an increment in equilibrium
   subroutine commit_joints(side)
      !> The joints
      type(joint_side_type), intent(inout) :: side

      side%balanced = elastic_stress(side%condensed, side%scene, side%field)
      if (.not. side%method%accumulates) call commit_field(side%scene%laws, side%field)
      side%before = side%field
   end subroutine commit_joints

end module axijoint_plastic_joint_side
