!> Judges what the cards alone do not tell of bodies that yield: whether they bear their in-situ
!> stress
module axijoint_job_yield_messages
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_element_solid_point, only : solid_point_type, solid_points
   use axijoint_element_yield_law, only : law_at, yield_none, criterion_names
   use axijoint_element_yield_stress, only : admit_solid
   use axijoint_fe_quadrature, only : max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_joints_load_steps, only : loads_of_increments
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_load, only : initial_stress_type, scaled_stresses, stress_before
   use axijoint_model_mesh, only : n_elements, element_references
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: judge_in_situ_yield

   !> Share of the stress beyond which it is beyond yield
   real(wp), parameter :: beyond = 1.0e-6_wp
   !> Elements that are named
   integer, parameter :: most_named = 5

contains

   !> Report in-situ stress beyond yield, of the first increment and combination that has it
   subroutine judge_in_situ_yield(model, diagnostics)
      !> The job
      type(model_type), intent(in) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(increment_state_type), allocatable :: states(:)
      integer :: k, i
      logical :: found

      do k = 1, size(model%combinations)
         states = loads_of_increments(model, model%combinations(k))
         do i = 1, size(states)
            call judge_state(model, scaled_stresses(model%initial_stresses, &
               states(i)%case_factor), diagnostics, found)
            if (found) return
         end do
      end do
   end subroutine judge_in_situ_yield

   !> Report the elements whose in-situ stress is beyond yield
   subroutine judge_state(model, in_situ, diagnostics, found)
      !> The job
      type(model_type), intent(in) :: model
      !> In-situ stresses, factors of the load cases in them
      type(initial_stress_type), intent(in) :: in_situ(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Whether there are any
      logical, intent(out) :: found

      type(reference_type), allocatable :: references(:)
      type(solid_point_type) :: points(max_element_points)
      character(len=:), allocatable :: names, first
      integer :: element, i, n

      references = element_references(model%mesh)
      names = ''
      n = 0
      associate (mesh => model%mesh)
         do element = 1, n_elements(mesh)
            associate (material => mesh%element_material(element), &
                       reference => references(mesh%element_kind(element)))
               if (model%materials(material)%yield%criterion == yield_none) cycle
               call solid_points(mesh%coordinates(:, mesh%element_nodes(:reference%n_nodes, &
                  element)), reference, points(:reference%n_points))
               do i = 1, reference%n_points
                  if (.not. passes(points(i)%position)) cycle
                  n = n + 1
                  if (n == 1) first = text_of(points(i)%position)
                  if (n <= most_named) names = names//', '//to_text(mesh%element_label(element))
                  exit
               end do
            end associate
         end do
      end associate
      found = n > 0
      if (.not. found) return
      if (n > most_named) names = names//', ...'
      call add_error(diagnostics, in_situ(1)%card, 0, 0, 'in-situ stress is beyond yield in '// &
         to_text(n)//' elements: '//names(3:), found=first, &
         mend='other K0 or sigma_zs, or more strength; cohesion near the surface')

   contains

      !> Whether the in-situ stress at a point of the element is beyond yield
      logical function passes(position)
         !> r and z
         real(wp), intent(in) :: position(2)

         real(wp) :: stress(6), admitted(6), tangent(6, 6), growth

         stress = 0.0_wp
         stress(:4) = stress_at(position)
         associate (law => model%materials(model%mesh%element_material(element))%yield)
            call admit_solid(law_at(law, position(2)), 0.0_wp, stress, admitted, tangent, growth)
         end associate
         passes = maxval(abs(stress - admitted)) > beyond*maxval(abs(stress))
      end function passes

      !> In-situ stress at a point of the element
      function stress_at(position) result(stress)
         !> r and z
         real(wp), intent(in) :: position(2)
         !> sigma_r, sigma_z, sigma_theta, tau_rz
         real(wp) :: stress(4)

         stress = stress_before(in_situ, model%mesh%element_body(element), &
                                model%mesh%element_material(element), position(2))
      end function stress_at

      !> A point in words
      function text_of(position) result(text)
         !> r and z
         real(wp), intent(in) :: position(2)
         !> Such as "MOHR at z = -0.5: sigma_z = -5, sigma_r = -20"
         character(len=:), allocatable :: text

         real(wp) :: stress(4)

         stress = stress_at(position)
         associate (law => model%materials(model%mesh%element_material(element))%yield)
            text = trim(criterion_names(law%criterion))//' at r = '//to_text(position(1))// &
               ', z = '//to_text(position(2))//': sigma_z = '//to_text(stress(2))// &
               ', sigma_r = '//to_text(stress(1))
         end associate
      end function text_of

   end subroutine judge_state

end module axijoint_job_yield_messages
