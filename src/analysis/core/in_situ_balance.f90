!> In-situ stress against weight, supports and joints (doc/theory.md). In a body that has the stress
!> sigma(z) before anything moves, three things must hold: gamma is the weight of every material;
!> tractions do not jump where materials meet; on the outside every traction is taken by a support,
!> a joint as its law allows, or a load
module axijoint_analysis_core_in_situ_balance
   use axijoint_analysis_core_in_situ, only : in_situ_type, in_situ_part_type, misfit_type, &
      larger_misfit
   use axijoint_analysis_core_in_situ_boundaries, only : add_boundaries
   use axijoint_assembly_force, only : add_edge_load, joint_force
   use axijoint_assembly_unit_loads, only : in_situ_joint_stress
   use axijoint_assembly_rigid_motion, only : solid_parts
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : memory_type, admit_stress, trial_stress, eta
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : n_corners, shape_line
   use axijoint_joints_load_steps, only : loads_of_increments
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_joint_points, only : model_joint_point_type, new_joint_points
   use axijoint_model_load, only : combination_type, initial_stress_type, covers, is_stressed, &
      scaled_stresses, stress_before
   use axijoint_model_material, only : rule_gauss
   use axijoint_model_mesh, only : edge_nodes, n_elements, n_nodes
   use axijoint_model_model, only : model_type, bodies_yield, can_yield, held_components, on_axis
   use axijoint_model_neighbours, only : neighbours_type, new_neighbours, element_at_edge
   implicit none
   private
   public :: in_situ_balance

   !> The mode of in-situ stress: symmetric of harmonic 0
   type(mode_type), parameter :: mode = mode_type()
   !> A stress below this part of the largest of its direction, or along a direction below this part
   !> of the largest of the part, is not what others are measured by: at the surface it is zero
   real(wp), parameter :: small = 0.1_wp

   !> What the states of a combination have in common
   type :: ground_type
      !> Part of each node
      integer, allocatable :: part(:)
      !> Points of the joints, at which tractions are integrated as on the edges
      type(model_joint_point_type), allocatable :: joint_points(:)
      !> Whether u and v of a node can move, shape (2, nodes)
      logical, allocatable :: free(:, :)
      !> Part, body and material of the elements, each three once: bonded bodies are one part. Shape (3, any); whether a
      !> node of them can move along z
      integer, allocatable :: kinds(:, :)
      logical, allocatable :: moves(:)
      !> Elements by their nodes
      type(neighbours_type) :: neighbours
   end type ground_type

   !> Tractions on the outside, as nodal forces, shape (2, nodes) each: along r and along z
   type :: outside_type
      !> Those of in-situ stress that joints do not take
      real(wp), allocatable :: force(:, :)
      !> Area of the outside around the node, seen along the direction
      real(wp), allocatable :: area(:, :)
      !> The same times the cosine of the angle between the normal and the direction
      real(wp), allocatable :: facing(:, :)
      !> The same times the size of the stress there
      real(wp), allocatable :: stress(:, :)
   end type outside_type

contains

   !> Look at the states in which the in-situ stress of a combination comes to act. Jobs whose joints
   !> or bodies can yield depend on the order, so that weight and in-situ stress must come together; of
   !> others the sum at the end counts
   function in_situ_balance(model, combination) result(findings)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> What is out of balance
      type(in_situ_type) :: findings

      type(ground_type) :: ground
      type(increment_state_type), allocatable :: states(:)
      type(initial_stress_type), allocatable :: stresses(:)
      integer :: i

      allocate (findings%parts(0), findings%boundaries(0))
      states = states_to_check(model, combination)
      if (size(states) == 0) return
      ground = new_ground(model)
      findings%parts = new_parts(model, ground, states)
      do i = 1, size(states)
         stresses = scaled_stresses(model%initial_stresses, states(i)%case_factor)
         call compare_weights(model, ground, stresses, states(i), findings%parts)
         call compare_outside(model, ground, stresses, states(i), findings%parts)
         call add_boundaries(model, ground%neighbours, stresses, states(i)%increment, &
            findings%boundaries)
      end do
      findings%parts = pack(findings%parts, findings%parts%has_stress &
         .or. findings%parts%pressed > 0.0_wp)
   end function in_situ_balance

   !> Ends of the increments up to the last one that changes the in-situ stress; the end alone if
   !> nothing can yield; none if no in-situ stress acts
   function states_to_check(model, combination) result(states)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The states
      type(increment_state_type), allocatable :: states(:)

      type(increment_state_type), allocatable :: all_states(:)
      real(wp), allocatable :: before(:), now(:)
      integer :: i, last

      all_states = loads_of_increments(model, combination)
      last = 0
      allocate (before(size(model%initial_stresses)), source=0.0_wp)
      do i = 1, size(all_states)
         now = all_states(i)%case_factor(model%initial_stresses%case)
         if (any(abs(now - before) > 0.0_wp)) last = i
         before = now
      end do
      states = all_states(:last)
      if (last > 0 .and. .not. (can_yield(model) .or. bodies_yield(model))) states = all_states(size(all_states):)
   end function states_to_check

   !> Parts, joints and free unknowns
   function new_ground(model) result(ground)
      !> The job
      type(model_type), intent(in) :: model
      !> What all states have in common
      type(ground_type) :: ground

      integer :: element, k

      call solid_parts(model%mesh, ground%part)
      ground%joint_points = new_joint_points(model, rule_gauss)
      ground%neighbours = new_neighbours(model%mesh)
      ground%free = .not. held_components(model, mode)
      ground%free = ground%free(:2, :)
      ground%free(1, :) = ground%free(1, :) .and. .not. on_axis(model%mesh)
      allocate (ground%kinds(3, 0), ground%moves(0))
      do element = 1, n_elements(model%mesh)
         associate (nodes => model%mesh%element_nodes(:model%mesh%element_size(element), element), &
                    body => model%mesh%element_body(element), material => model%mesh%element_material(element))
            do k = size(ground%kinds, 2), 1, -1
               if (all(ground%kinds(:, k) == [ground%part(nodes(1)), body, material])) exit
            end do
            if (k == 0) then
               ground%kinds = reshape([ground%kinds, ground%part(nodes(1)), body, material], [3, size(ground%kinds, 2) + 1])
               ground%moves = [ground%moves, .false.]
               k = size(ground%moves)
            end if
            ground%moves(k) = ground%moves(k) .or. any(ground%free(2, nodes))
         end associate
      end do
   end function new_ground

   !> All parts, with the cards that give their in-situ stress in the states to be looked at
   function new_parts(model, ground, states) result(parts)
      !> The job
      type(model_type), intent(in) :: model
      !> Parts and materials
      type(ground_type), intent(in) :: ground
      !> The states
      type(increment_state_type), intent(in) :: states(:)
      !> The parts, nothing found yet
      type(in_situ_part_type), allocatable :: parts(:)

      logical :: acts
      integer :: p, k, i, element

      allocate (parts(maxval(ground%part)))
      parts%node = [(findloc(ground%part, p, 1), p=1, size(parts))]
      do element = 1, n_elements(model%mesh)
         parts(ground%part(model%mesh%element_nodes(1, element)))%body = &
            model%mesh%element_body(element)
      end do
      do p = 1, size(parts)
         do k = 1, size(model%initial_stresses)
            associate (stress => model%initial_stresses(k))
               if (.not. any(ground%kinds(1, :) == p .and. covers(stress, ground%kinds(2, :), ground%kinds(3, :)))) cycle
               if (stress%meant) parts(p)%meant = .true.
               if (parts(p)%card == 0) parts(p)%card = stress%card
               acts = any([(abs(states(i)%case_factor(stress%case)) > 0.0_wp, i=1, size(states))])
               if (acts .and. is_stressed(stress)) parts(p)%has_stress = .true.
            end associate
         end do
      end do
   end function new_parts

   !> Weight of each material against the growth of its sigma_z with z
   subroutine compare_weights(model, ground, stresses, state, parts)
      !> The job
      type(model_type), intent(in) :: model
      !> Parts and materials
      type(ground_type), intent(in) :: ground
      !> In-situ stresses in the state
      type(initial_stress_type), intent(in) :: stresses(:)
      !> The state
      type(increment_state_type), intent(in) :: state
      !> The parts; take what is found
      type(in_situ_part_type), intent(inout) :: parts(:)

      real(wp) :: gravity, gamma, weight, share
      integer :: k, m

      gravity = 0.0_wp
      do m = 1, size(model%body_loads)
         associate (load => model%body_loads(m))
            if (same_mode(load%mode, mode)) &
               gravity = gravity + state%case_factor(load%case)*load%acceleration(2)
         end associate
      end do
      do k = 1, size(ground%moves)
         associate (part => parts(ground%kinds(1, k)), body => ground%kinds(2, k), material => ground%kinds(3, k))
            if (.not. (part%has_stress .and. ground%moves(k))) cycle
            gamma = sum(stresses%gradient(2), covers(stresses, body, material))
            weight = -gravity*model%materials(material)%density
            share = 0.0_wp
            if (max(abs(gamma), abs(weight)) > 0.0_wp) &
               share = abs(gamma - weight)/max(abs(gamma), abs(weight))
            if (.not. share > part%weight_share) cycle
            part%weight_share = share
            part%body = body
            part%material = material
            part%gamma = gamma
            part%weight = weight
            part%weight_increment = state%increment
         end associate
      end do
   end subroutine compare_weights

   !> Tractions on the outside against what supports, joints and loads take
   subroutine compare_outside(model, ground, stresses, state, parts)
      !> The job
      type(model_type), intent(in) :: model
      !> Parts and materials
      type(ground_type), intent(in) :: ground
      !> In-situ stresses in the state
      type(initial_stress_type), intent(in) :: stresses(:)
      !> The state
      type(increment_state_type), intent(in) :: state
      !> The parts; take what is found
      type(in_situ_part_type), intent(inout) :: parts(:)

      type(outside_type) :: outside
      type(misfit_type) :: misfit
      real(wp), allocatable :: load(:, :), reference(:, :)
      real(wp) :: traction(3, size(ground%joint_points))
      integer :: node, i

      call integrate_edges(model, ground, stresses, outside)
      traction = taken_by_joints(model, ground%joint_points, state%case_factor)
      associate (force => joint_force(ground%joint_points, mode%harmonic, traction, &
         n_nodes(model%mesh)))
         outside%force = outside%force - force(:2, :)
      end associate
      load = surface_loads(model, state%case_factor)
      where (abs(outside%force + load) < abs(outside%force)) outside%force = outside%force + load
      reference = largest_stresses(model, ground, stresses, size(parts))
      call note_pressure(ground, traction, parts)
      do node = 1, n_nodes(model%mesh)
         associate (part => parts(ground%part(node)), largest => reference(:, ground%part(node)))
            part%largest = max(part%largest, maxval(largest))
            if (.not. part%has_stress) cycle
            do i = 1, 2
               if (.not. (ground%free(i, node) .and. outside%facing(i, node) > 0.0_wp)) cycle
               misfit = misfit_type(0.0_wp, outside%force(i, node)/face_area(outside, i, node), &
                  node, i, state%increment)
               misfit%share = share_of(misfit%traction, max(largest(i), small*maxval(largest)))
               part%on_whole = larger_misfit(part%on_whole, misfit)
               misfit%share = share_of(misfit%traction, &
                  max(outside%stress(i, node)/outside%area(i, node), &
                                                            small*max(largest(i), &
                                                            small*maxval(largest))))
               part%on_place = larger_misfit(part%on_place, misfit)
            end do
         end associate
      end do
   end subroutine compare_outside

   !> A share; 0 of nothing
   pure real(wp) function share_of(value, whole) result(share)
      !> Part and whole
      real(wp), intent(in) :: value, whole

      share = 0.0_wp
      if (whole > 0.0_wp) share = abs(value)/whole
   end function share_of

   !> Area of the faces around a node on which a direction has tractions: all of a single face, however
   !> inclined it is; of several, those that face the direction count. The area seen along a direction
   !> would do for forces that are as small as it is, but along a face both are rounding
   pure real(wp) function face_area(outside, direction, node) result(area)
      !> Tractions on the outside
      type(outside_type), intent(in) :: outside
      !> 1 along r, 2 along z; some of the outside faces it
      integer, intent(in) :: direction
      !> The node
      integer, intent(in) :: node

      associate (seen => outside%area(direction, node))
         area = seen*(seen/outside%facing(direction, node))
      end associate
   end function face_area

   !> Forces of in-situ stress on the outer edges: c_0 times the integral of -N sigma n r ds
   subroutine integrate_edges(model, ground, stresses, outside)
      !> The job
      type(model_type), intent(in) :: model
      !> Neighbours of the elements
      type(ground_type), intent(in) :: ground
      !> In-situ stresses
      type(initial_stress_type), intent(in) :: stresses(:)
      !> Forces, areas, stresses
      type(outside_type), intent(out) :: outside

      real(wp) :: x(3), w(3), shape(3), derivative(3), position(2), along(2), normal(2), &
         stress(4), weight
      integer, allocatable :: nodes(:)
      integer :: element, side, k, i, n

      allocate (outside%force(2, n_nodes(model%mesh)), source=0.0_wp)
      outside%area = outside%force
      outside%facing = outside%force
      outside%stress = outside%force
      do element = 1, n_elements(model%mesh)
         do side = 1, n_corners(model%mesh%element_size(element))
            nodes = edge_nodes(model%mesh, element, side)
            if (element_at_edge(model%mesh, ground%neighbours, nodes(1), nodes(2), element) > 0) &
               cycle
            n = size(nodes)
            call gauss_rule(n, x, w)
            do k = 1, n
               call shape_line(n, x(k), shape(:n), derivative(:n))
               position = matmul(model%mesh%coordinates(:, nodes), shape(:n))
               along = matmul(model%mesh%coordinates(:, nodes), derivative(:n))
               ! outwards, times the length: corners run counterclockwise
               normal = [along(2), -along(1)]
               stress = stress_before(stresses, model%mesh%element_body(element), &
                                      model%mesh%element_material(element), position(2))
               do i = 1, n
                  weight = circle_integral(mode%harmonic)*w(k)*position(1)
                  associate (node => nodes(i))
                     outside%force(:, node) = outside%force(:, node) - weight*shape(i) &
                        *[stress(1)*normal(1) + stress(4)*normal(2), stress(4)*normal(1) + &
                        stress(2)*normal(2)]
                     outside%area(:, node) = outside%area(:, node) + weight*abs(shape(i)*normal)
                     outside%facing(:, node) = outside%facing(:, node) &
                        + weight*abs(shape(i))*normal**2/norm2(normal)
                     outside%stress(:, node) = outside%stress(:, node) &
                        + weight*abs(shape(i)*normal)*abs(stress(1:2))
                  end associate
               end do
            end do
         end do
      end do
   end subroutine integrate_edges

   !> Traction of in-situ stress that joints take over before anything moves, as far as their laws
   !> allow; without the initial stress of a law, which acts on the law alone
   pure function taken_by_joints(model, points, factor) result(traction)
      !> The job
      type(model_type), intent(in) :: model
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Factor of each load case
      real(wp), intent(in) :: factor(:)
      !> tau_xi, sigma, tau_theta, shape (3, points)
      real(wp) :: traction(3, size(points))

      real(wp), parameter :: still(3) = 0.0_wp
      integer :: k

      traction = in_situ_joint_stress(model, points, factor)
      do k = 1, size(points)
         associate (law => model%joint_materials(points(k)%material)%law)
            traction(:, k) = admit_stress(law, &
               traction(:, k) + trial_stress(law, memory_type(), still))
            traction(eta, k) = traction(eta, k) - law%initial_stress
         end associate
      end do
   end function taken_by_joints

   !> Nodal forces of tractions, pressures and ring loads
   pure function surface_loads(model, factor) result(load)
      !> The job
      type(model_type), intent(in) :: model
      !> Factor of each load case
      real(wp), intent(in) :: factor(:)
      !> Forces along r and z, shape (2, nodes)
      real(wp) :: load(2, size(model%mesh%node_label))

      real(wp), allocatable :: force(:, :)
      integer :: k

      allocate (force(3, size(load, 2)), source=0.0_wp)
      do k = 1, size(model%edge_loads)
         if (.not. same_mode(model%edge_loads(k)%mode, mode)) cycle
         call add_edge_load(model%edge_loads(k), factor(model%edge_loads(k)%case), &
            model%mesh%coordinates, force)
      end do
      do k = 1, size(model%ring_loads)
         associate (ring => model%ring_loads(k))
            if (same_mode(ring%mode, mode)) &
               force(:, ring%node) = force(:, ring%node) + factor(ring%case)*ring%force
         end associate
      end do
      load = force(:2, :)
   end function surface_loads

   !> Largest sigma_r and sigma_z of each part
   pure function largest_stresses(model, ground, stresses, n_parts) result(largest)
      !> The job
      type(model_type), intent(in) :: model
      !> Parts
      type(ground_type), intent(in) :: ground
      !> In-situ stresses
      type(initial_stress_type), intent(in) :: stresses(:)
      !> Number of parts
      integer, intent(in) :: n_parts
      !> The stresses, shape (2, parts)
      real(wp) :: largest(2, n_parts)

      real(wp) :: stress(4)
      integer :: element, k

      largest = 0.0_wp
      do element = 1, n_elements(model%mesh)
         do k = 1, n_corners(model%mesh%element_size(element))
            associate (node => model%mesh%element_nodes(k, element))
               stress = stress_before(stresses, model%mesh%element_body(element), &
                                      model%mesh%element_material(element), &
                                      model%mesh%coordinates(2, node))
               associate (of_part => largest(:, ground%part(node)))
                  of_part = max(of_part, abs(stress(1:2)))
               end associate
            end associate
         end do
      end do
   end function largest_stresses

   !> Note with how much joints press the parts that have no in-situ stress of their own
   pure subroutine note_pressure(ground, traction, parts)
      !> Parts, joint points
      type(ground_type), intent(in) :: ground
      !> Stress of the joints, shape (3, points)
      real(wp), intent(in) :: traction(:, :)
      !> The parts
      type(in_situ_part_type), intent(inout) :: parts(:)

      integer :: k, side

      do k = 1, size(ground%joint_points)
         do side = 1, 3, 2  ! nodes 1 and 3 lie on opposite sides
            associate (part => parts(ground%part(ground%joint_points(k)%nodes(side))))
               if (.not. part%has_stress) &
                  part%pressed = max(part%pressed, maxval(abs(traction(:, k))))
            end associate
         end do
      end do
   end subroutine note_pressure

end module axijoint_analysis_core_in_situ_balance
