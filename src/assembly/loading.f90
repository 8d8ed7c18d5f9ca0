!> Loads of one combination of load cases, mode by mode
module axijoint_assembly_loading
   use axijoint_assembly_force, only : add_edge_load, joint_force, joint_jump, elastic_joint_stress
   use axijoint_assembly_solid_force, only : initial_state_type, solid_force, add_mass_force
   use axijoint_assembly_support, only : support_point_type, add_support_force
   use axijoint_assembly_unit_loads, only : unit_loads_type, in_situ_force, in_situ_joint_stress
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : ascending_order
   use axijoint_fe_mode, only : mode_type, same_mode, family_symmetric
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_load, only : combination_type, scaled_stresses
   use axijoint_model_mesh, only : n_nodes, n_elements, max_element_nodes
   use axijoint_model_model, only : model_type, on_axis
   implicit none
   private
   public :: loading_type, new_loading, add_external, new_initial_state, still_force

   !> Sums of forces, of temperatures and of given displacements below this part of what is summed are rounding
   real(wp), parameter :: rounded = 32.0_wp*epsilon(1.0_wp)

   !> Loads
   type :: loading_type
      !> Factor of each load case
      real(wp), allocatable :: case_factor(:)
      !> External forces on components, shape (3, nodes, modes)
      real(wp), allocatable :: external(:, :, :)
      !> Displacements of components that are held, same shape; not allocated
      !> if all are held at zero
      real(wp), allocatable :: held(:, :, :)
      !> Stress of the solids without strain
      type(initial_state_type) :: initial
      !> Forces that the unknowns answer to, same shape: external forces less what
      !> held displacements and initial stresses already balance
      real(wp), allocatable :: right(:, :, :)
   end type loading_type

contains

   !> Loads of a combination
   subroutine new_loading(model, joint_points, supports, modes, unit_loads, combination, loading, taken)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: joint_points(:)
      !> Points of all springs
      type(support_point_type), intent(in) :: supports(:)
      !> Modes in use
      type(mode_type), intent(in) :: modes(:)
      !> Forces of masses and of in-situ stress under a factor of one
      type(unit_loads_type), intent(in) :: unit_loads
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The loads
      type(loading_type), intent(out) :: loading
      !> Elastic stress that plastic strain takes, shape (6, points, modes); none if not allocated
      real(wp), intent(in), allocatable, optional :: taken(:, :, :)

      real(wp), allocatable :: still(:, :)
      integer :: k

      associate (n => n_nodes(model%mesh))
         allocate (loading%external(3, n, size(modes)), source=0.0_wp)
         allocate (still(3, n), source=0.0_wp)
      end associate
      loading%case_factor = combination%factor
      do k = 1, size(modes)
         call add_external(model, modes(k), combination%factor, loading%external(:, :, k), unit_loads)
      end do
      if (size(model%prescribed) > 0) then
         allocate (loading%held, mold=loading%external)
         do k = 1, size(modes)
            loading%held(:, :, k) = prescribed_displacement(model, modes(k), combination%factor)
         end do
      end if
      call new_initial_state(model, modes, combination%factor, loading%initial)
      if (present(taken)) call take_plastic_strain(taken, loading%initial)
      loading%right = loading%external
      if (.not. allocated(loading%held) .and. .not. loading%initial%present) return
      do k = 1, size(modes)
         if (allocated(loading%held)) still = loading%held(:, :, k)
         if (any(abs(still) > 0.0_wp) .or. is_free_in_mode(loading%initial, k)) then
            loading%right(:, :, k) = loading%right(:, :, k) - still_force(model, joint_points, supports, &
               loading%initial, k, modes(k), still, combination%factor)
         else if (is_axis(modes(k))) then
            loading%right(:, :, k) = loading%right(:, :, k) - in_situ_force(unit_loads, combination%factor)
         end if
      end do
   end subroutine new_loading

   !> Whether temperatures or plastic strain stress the solids in a mode
   pure logical function is_free_in_mode(state, k) result(is_in_mode)
      !> What stresses the solids
      type(initial_state_type), intent(in) :: state
      !> Place of the mode
      integer, intent(in) :: k

      is_in_mode = .false.
      if (allocated(state%temperature)) is_in_mode = any(abs(state%temperature(:, :, k)) > 0.0_wp)
      if (allocated(state%taken)) is_in_mode = is_in_mode .or. any(abs(state%taken(:, :, k)) > 0.0_wp)
   end function is_free_in_mode

   !> Whether a mode is that of the axis, which alone has in-situ stress
   pure logical function is_axis(mode)
      !> The mode
      type(mode_type), intent(in) :: mode

      is_axis = same_mode(mode, mode_type(0, family_symmetric))
   end function is_axis

   !> Let plastic strain stress the solids
   pure subroutine take_plastic_strain(taken, state)
      !> Elastic stress that it takes, shape (6, points, modes); none if not allocated
      real(wp), intent(in), allocatable :: taken(:, :, :)
      !> What stresses the solids
      type(initial_state_type), intent(inout) :: state

      if (.not. allocated(taken)) return
      state%taken = taken
      state%present = .true.
   end subroutine take_plastic_strain

   !> Nodal forces of solids, joints and springs in one mode while the unknowns are zero: of held
   !> displacements and of initial stresses
   function still_force(model, joint_points, supports, initial, k, mode, still, &
      factor) result(force)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints, and of all springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: supports(:)
      !> Stress of the solids without strain
      type(initial_state_type), intent(in) :: initial
      !> Place of the mode, and the mode
      integer, intent(in) :: k
      type(mode_type), intent(in) :: mode
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: still(:, :)
      !> Factors of the load cases
      real(wp), intent(in) :: factor(:)
      !> Forces on components, same shape
      real(wp), allocatable :: force(:, :)

      real(wp), allocatable :: stress(:, :)

      allocate (force, mold=still)
      call solid_force(model, initial, k, mode, still, force)
      stress = elastic_joint_stress(joint_points, joint_jump(joint_points, still))
      if (is_axis(mode)) then
         stress = stress + in_situ_joint_stress(model, joint_points, factor)
      end if
      force = force + joint_force(joint_points, mode%harmonic, stress, size(still, 2))
      call add_support_force(supports, mode%harmonic, still, force)
   end function still_force

   !> Add the external forces of one mode: on edges, nodal circles and masses. Of loads that take each other away, also of several
   !> cases, nothing is left: what rounding leaves of them would move bodies that nothing else loads
   subroutine add_external(model, mode, factor, force, unit_loads)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Factors of the load cases
      real(wp), intent(in) :: factor(:)
      !> Forces on components, shape (3, nodes)
      real(wp), intent(inout) :: force(:, :)
      !> Forces of masses under a factor of one, if they are known
      type(unit_loads_type), intent(in), optional :: unit_loads

      real(wp), allocatable :: masses(:, :)
      integer :: k

      call add_nodal_loads(model, mode, factor, force)
      do k = 1, size(model%body_loads)
         associate (load => model%body_loads(k))
            if (.not. same_mode(load%mode, mode)) cycle
            if (present(unit_loads)) then
               masses = factor(load%case)*unit_loads%mass(:, :, k)
            else
               if (.not. allocated(masses)) allocate (masses, mold=force)
               masses = 0.0_wp
               call add_mass_force(model, load, factor(load%case), masses)
            end if
            masses = force + masses
            where (abs(masses) <= rounded*abs(force)) masses = 0.0_wp
            force = masses
         end associate
      end do
   end subroutine add_external

   !> The same of loads on edges and nodal circles, which touch few of the nodes
   subroutine add_nodal_loads(model, mode, factor, force)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Factors of the load cases
      real(wp), intent(in) :: factor(:)
      !> Forces on components, shape (3, nodes)
      real(wp), intent(inout) :: force(:, :)

      integer, allocatable :: nodes(:)
      !> Sizes of the forces on these, shape (3, nodes that are touched)
      real(wp), allocatable :: sizes(:, :)
      real(wp) :: before(3, 3)
      integer :: i, k, n

      nodes = touched(model, mode)
      sizes = abs(force(:, nodes))
      do k = 1, size(model%edge_loads)
         associate (load => model%edge_loads(k))
            if (.not. same_mode(load%mode, mode)) cycle
            n = count(load%nodes > 0)
            before(:, :n) = force(:, load%nodes(:n))
            call add_edge_load(load, factor(load%case), model%mesh%coordinates, force)
            do i = 1, n
               call add_size(load%nodes(i), force(:, load%nodes(i)) - before(:, i))
            end do
         end associate
      end do
      do k = 1, size(model%ring_loads)
         associate (load => model%ring_loads(k))
            if (.not. same_mode(load%mode, mode)) cycle
            force(:, load%node) = force(:, load%node) + factor(load%case)*load%force
            call add_size(load%node, factor(load%case)*load%force)
         end associate
      end do
      do i = 1, size(nodes)
         where (abs(force(:, nodes(i))) <= rounded*sizes(:, i)) force(:, nodes(i)) = 0.0_wp
      end do

   contains

      !> Add the size of a force
      subroutine add_size(node, added)
         !> The node, and the force
         integer, intent(in) :: node
         real(wp), intent(in) :: added(3)

         integer :: first, last, middle

         first = 1
         last = size(nodes)
         do while (first < last)
            middle = (first + last)/2
            if (nodes(middle) < node) then
               first = middle + 1
            else
               last = middle
            end if
         end do
         sizes(:, first) = sizes(:, first) + abs(added)
      end subroutine add_size

   end subroutine add_nodal_loads

   !> Nodes that loads on edges and nodal circles touch in one mode, ascending
   pure function touched(model, mode) result(nodes)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The nodes, each once
      integer, allocatable :: nodes(:)

      integer, allocatable :: all(:)
      integer :: i, k, n

      allocate (all(3*size(model%edge_loads) + size(model%ring_loads)))
      n = 0
      do k = 1, size(model%edge_loads)
         associate (load => model%edge_loads(k))
            if (.not. same_mode(load%mode, mode)) cycle
            do i = 1, count(load%nodes > 0)
               n = n + 1
               all(n) = load%nodes(i)
            end do
         end associate
      end do
      do k = 1, size(model%ring_loads)
         if (.not. same_mode(model%ring_loads(k)%mode, mode)) cycle
         n = n + 1
         all(n) = model%ring_loads(k)%node
      end do
      all = all(ascending_order(real(all(:n), wp)))
      nodes = pack(all, [(i == 1 .or. all(max(1, i - 1)) /= all(i), i=1, n)])
   end function touched

   !> Displacements of held components in one mode. At the pole a lateral
   !> displacement is u = -w in harmonic 1, and higher harmonics have none
   pure function prescribed_displacement(model, mode, factor) result(displacement)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Factors of the load cases
      real(wp), intent(in) :: factor(:)
      !> Amplitudes u, v, w, shape (3, nodes)
      real(wp) :: displacement(3, size(model%mesh%node_label))

      real(wp), allocatable :: sizes(:, :)
      integer :: k, node

      displacement = 0.0_wp
      allocate (sizes, source=displacement)
      do k = 1, size(model%prescribed)
         associate (move => model%prescribed(k))
            if (.not. same_mode(move%mode, mode)) cycle
            displacement(move%component, move%node) = displacement(move%component, move%node) &
               + factor(move%case)*move%value
            sizes(move%component, move%node) = sizes(move%component, move%node) + abs(factor(move%case)*move%value)
         end associate
      end do
      where (abs(displacement) <= rounded*sizes) displacement = 0.0_wp
      associate (pole => on_axis(model%mesh))
         do node = 1, size(pole)
            if (.not. pole(node)) cycle
            associate (u => displacement(:, node))
               select case (mode%harmonic)
               case (0)
                  u = [0.0_wp, u(2), 0.0_wp]
               case (1)
                  if (abs(u(1)) > 0.0_wp) then
                     u = [u(1), 0.0_wp, -u(1)]
                  else
                     u = [-u(3), 0.0_wp, u(3)]
                  end if
               case default
                  u = 0.0_wp
               end select
            end associate
         end do
      end associate
   end function prescribed_displacement

   !> Temperatures and in-situ stresses of a combination
   subroutine new_initial_state(model, modes, factor, state)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes in use
      type(mode_type), intent(in) :: modes(:)
      !> Factors of the load cases
      real(wp), intent(in) :: factor(:)
      !> The state
      type(initial_state_type), intent(out) :: state

      real(wp), allocatable :: sizes(:, :)
      integer :: k, j, element

      state%in_situ = scaled_stresses(model%initial_stresses, factor)
      state%present = size(state%in_situ) > 0 .or. size(model%thermal_loads) > 0
      if (size(model%thermal_loads) == 0) return
      associate (mesh => model%mesh)
         allocate (state%temperature(max_element_nodes, n_elements(mesh), size(modes)), &
            source=0.0_wp)
         allocate (sizes(max_element_nodes, n_elements(mesh)))
      end associate
      do j = 1, size(modes)
         sizes = 0.0_wp
         do k = 1, size(model%thermal_loads)
            associate (load => model%thermal_loads(k))
               if (.not. same_mode(load%mode, modes(j))) cycle
               do element = 1, n_elements(model%mesh)
                  if (all(load%body /= [0, model%mesh%element_body(element)])) cycle
                  associate (n => model%mesh%element_size(element), &
                             own => state%temperature(:, element, j))
                     own(:n) = own(:n) + factor(load%case) &
                        *load%temperature(model%mesh%element_nodes(:n, element))
                     sizes(:n, element) = sizes(:n, element) + abs(factor(load%case) &
                        *load%temperature(model%mesh%element_nodes(:n, element)))
                  end associate
               end do
            end associate
         end do
         where (abs(state%temperature(:, :, j)) <= rounded*sizes) state%temperature(:, :, j) = 0.0_wp
      end do
   end subroutine new_initial_state

end module axijoint_assembly_loading
