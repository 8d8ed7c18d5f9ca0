!> Forces of masses and of in-situ stress under a factor of one: found once, for every loading of a history
!> takes shares of them
module axijoint_assembly_unit_loads
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_solid_force, only : initial_state_type, solid_force, add_mass_force
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, family_symmetric
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : initial_stress_type, covers, is_stressed, scaled_stresses, stress_before
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: unit_loads_type, new_unit_loads, in_situ_force, in_situ_joint_stress

   !> Forces under a factor of one
   type :: unit_loads_type
      !> Of each load on masses, on components, shape (3, nodes, loads)
      real(wp), allocatable :: mass(:, :, :)
      !> Load cases with in-situ stress, and the nodal forces that balance it in solids and joints, in the harmonic
      !> of the axis, shape (3, nodes, such cases)
      integer, allocatable :: case(:)
      real(wp), allocatable :: in_situ(:, :, :)
   end type unit_loads_type

contains

   !> Forces of all masses and in-situ stresses of a job
   subroutine new_unit_loads(model, joint_points, unit_loads)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: joint_points(:)
      !> The forces
      type(unit_loads_type), intent(out) :: unit_loads

      type(mode_type), parameter :: axis = mode_type(0, family_symmetric)
      type(initial_state_type) :: state
      real(wp), allocatable :: factor(:), nothing(:, :)
      integer :: k, n_cases

      associate (n => n_nodes(model%mesh), states => model%initial_stresses)
         allocate (unit_loads%mass(3, n, size(model%body_loads)), source=0.0_wp)
         do k = 1, size(model%body_loads)
            call add_mass_force(model, model%body_loads(k), 1.0_wp, unit_loads%mass(:, :, k))
         end do
         n_cases = 0
         if (size(states) > 0) n_cases = maxval(states%case)
         unit_loads%case = pack([(k, k=1, n_cases)], [(any(states%case == k), k=1, n_cases)])
         allocate (unit_loads%in_situ(3, n, size(unit_loads%case)), nothing(3, n))
         nothing = 0.0_wp
         allocate (factor(n_cases))
         do k = 1, size(unit_loads%case)
            factor = 0.0_wp
            factor(unit_loads%case(k)) = 1.0_wp
            state%in_situ = scaled_stresses(pack(states, states%case == unit_loads%case(k)), factor)
            call solid_force(model, state, 1, axis, nothing, unit_loads%in_situ(:, :, k))
            unit_loads%in_situ(:, :, k) = unit_loads%in_situ(:, :, k) + joint_force(joint_points, axis%harmonic, &
               in_situ_joint_stress(model, joint_points, factor), n)
         end do
      end associate
   end subroutine new_unit_loads

   !> Nodal forces that balance the in-situ stress of solids and joints, in the harmonic of the axis
   pure function in_situ_force(unit_loads, factor) result(force)
      !> Forces under a factor of one
      type(unit_loads_type), intent(in) :: unit_loads
      !> Factors of the load cases
      real(wp), intent(in) :: factor(:)
      !> Forces on components, shape (3, nodes)
      real(wp) :: force(3, size(unit_loads%in_situ, 2))

      integer :: k

      force = 0.0_wp
      do k = 1, size(unit_loads%case)
         force = force + factor(unit_loads%case(k))*unit_loads%in_situ(:, :, k)
      end do
   end function in_situ_force

   !> In-situ stress of the bodies on the planes of their joints, of the mean of
   !> both sides where both have one: a card that says zero is no stress
   pure function in_situ_joint_stress(model, points, factor) result(stress)
      !> The job
      type(model_type), intent(in) :: model
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Factors of the load cases
      real(wp), intent(in) :: factor(:)
      !> tau_xi, sigma, tau_theta, shape (3, points)
      real(wp) :: stress(3, size(points))

      type(initial_stress_type), allocatable :: states(:)
      real(wp) :: sum_of(4)
      integer :: k, side, n_sides

      stress = 0.0_wp
      if (size(model%initial_stresses) == 0) return
      states = scaled_stresses(model%initial_stresses, factor)
      do k = 1, size(points)
         n_sides = 0
         sum_of = 0.0_wp
         do side = 1, 2
            associate (body => model%mesh%element_body(points(k)%elements(side)), &
                       material => model%mesh%element_material(points(k)%elements(side)))
               if (any(covers(states, body, material) .and. is_stressed(model%initial_stresses))) &
                  n_sides = n_sides + 1
               sum_of = sum_of + stress_before(states, body, material, points(k)%position(2))
            end associate
         end do
         if (n_sides == 0) cycle
         associate (s => sum_of/n_sides, c => points(k)%cosine, d => points(k)%sine)
            stress(1, k) = c*d*(s(2) - s(1)) + (c**2 - d**2)*s(4)
            stress(2, k) = d**2*s(1) + c**2*s(2) - 2.0_wp*c*d*s(4)
         end associate
      end do
   end function in_situ_joint_stress

end module axijoint_assembly_unit_loads
