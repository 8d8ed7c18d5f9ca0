!> Stresses smoothed to some nodes, of displacements that are known near them: those along the lines of a deck, on its mesh and on
!> that of elements half as large
module axijoint_analysis_core_watched_stress
   use axijoint_analysis_core_fields, only : nodal_stress_type
   use axijoint_analysis_core_nodal_stress, only : stress_at_node, area
   use axijoint_assembly_solid_force, only : initial_state_type, solid_force
   use axijoint_base_kinds, only : wp
   use axijoint_fe_extrapolation, only : extrapolation_matrix
   use axijoint_fe_mode, only : mode_type
   use axijoint_fe_reference, only : reference_type
   use axijoint_model_mesh, only : mesh_type, n_elements, n_nodes, max_element_nodes, element_references
   use axijoint_model_model, only : model_type, on_axis
   implicit none
   private
   public :: watch_type, new_watch, watched_stress, watched_values

   !> Where stresses are watched
   type :: watch_type
      !> Node and material of each value
      integer, allocatable :: node(:), material(:)
      !> Elements that have one, and points of all elements before each of these
      integer, allocatable :: element(:), before(:)
      !> Value of each of their nodes, 0 without one, and their share in it, shape (max_element_nodes, those elements)
      integer, allocatable :: value_of(:, :)
      real(wp), allocatable :: share(:, :)
   end type watch_type

contains

   !> Watch values of a mesh: they are averages over the elements of one material about a node
   function new_watch(mesh, node, material) result(watch)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Node and material of each value
      integer, intent(in) :: node(:), material(:)
      !> The watch
      type(watch_type) :: watch

      type(reference_type), allocatable :: references(:)
      integer :: first(n_nodes(mesh)), next(size(node)), value(max_element_nodes), before(n_elements(mesh))
      real(wp) :: total(size(node))
      integer :: e, i, v, n_before

      watch%node = node
      watch%material = material
      first = 0
      do v = 1, size(node)  ! those of a node one after the other
         next(v) = first(node(v))
         first(node(v)) = v
      end do
      references = element_references(mesh)
      n_before = 0
      do e = 1, n_elements(mesh)
         before(e) = n_before
         n_before = n_before + references(mesh%element_kind(e))%n_points
      end do
      watch%element = pack([(e, e=1, n_elements(mesh))], [(maxval(values_of(e)) > 0, e=1, n_elements(mesh))])
      watch%before = before(watch%element)
      allocate (watch%value_of(max_element_nodes, size(watch%element)))
      allocate (watch%share(max_element_nodes, size(watch%element)), source=0.0_wp)
      total = 0.0_wp
      do i = 1, size(watch%element)
         value = values_of(watch%element(i))
         watch%value_of(:, i) = value
         where (value > 0) watch%share(:, i) = 1.0_wp/area(mesh, watch%element(i))
         do v = 1, max_element_nodes
            if (value(v) > 0) total(value(v)) = total(value(v)) + watch%share(v, i)
         end do
      end do
      do i = 1, size(watch%element)
         do v = 1, max_element_nodes
            if (watch%value_of(v, i) > 0) watch%share(v, i) = watch%share(v, i)/total(watch%value_of(v, i))
         end do
      end do

   contains

      !> Values of the nodes of an element
      pure function values_of(e) result(values)
         !> The element
         integer, intent(in) :: e
         !> 0 without one
         integer :: values(max_element_nodes)

         integer :: i

         values = 0
         do i = 1, mesh%element_size(e)
            values(i) = first(mesh%element_nodes(i, e))
            do while (values(i) > 0)
               if (material(values(i)) == mesh%element_material(e)) exit
               values(i) = next(values(i))
            end do
         end do
      end function values_of

   end function new_watch

   !> The values that displacements have in one mode
   function watched_stress(model, watch, initial, k, mode, displacement) result(values)
      !> The job
      type(model_type), intent(in) :: model
      !> What is watched of its mesh
      type(watch_type), intent(in) :: watch
      !> Stress without strain
      type(initial_state_type), intent(in) :: initial
      !> Place of the mode, and the mode
      integer, intent(in) :: k
      type(mode_type), intent(in) :: mode
      !> Amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Amplitudes, shape (6, values)
      real(wp) :: values(6, size(watch%node))

      type(reference_type), allocatable :: references(:)
      real(wp), allocatable :: stress(:, :, :), force(:, :, :), matrix(:, :)
      logical :: counts(n_elements(model%mesh)), pole(n_nodes(model%mesh))
      integer :: i, e, n

      values = 0.0_wp
      if (size(watch%element) == 0) return
      counts = .false.
      counts(watch%element) = .true.
      references = element_references(model%mesh)
      allocate (stress(6, sum(references(model%mesh%element_kind)%n_points), 1))
      allocate (force(3, size(displacement, 2), 1))
      call solid_force(model, initial, k, [mode], reshape(displacement, shape(force)), force, stress, counts)
      pole = on_axis(model%mesh)
      do e = 1, size(watch%element)
         associate (reference => references(model%mesh%element_kind(watch%element(e))), &
                    nodes => model%mesh%element_nodes(:, watch%element(e)), before => watch%before(e))
            n = reference%n_points
            matrix = extrapolation_matrix(reference%n_nodes, reference%position(:, :n), reference%weight(:n))
            do i = 1, reference%n_nodes
               associate (v => watch%value_of(i, e))
                  if (v > 0) values(:, v) = values(:, v) + watch%share(i, e)*stress_at_node(matrix(i, :), &
                     stress(:, before + 1:before + n, 1), mode%harmonic, pole(nodes(i)))
               end associate
            end do
         end associate
      end do
   end function watched_stress

   !> The same of stresses that are smoothed to all nodes
   pure function watched_values(watch, nodal) result(values)
      !> What is watched
      type(watch_type), intent(in) :: watch
      !> Stresses of the same mesh
      type(nodal_stress_type), intent(in) :: nodal
      !> Amplitudes, shape (6, values, modes)
      real(wp), allocatable :: values(:, :, :)

      integer :: e, i

      allocate (values(6, size(watch%node), size(nodal%amplitude, 3)))
      do e = 1, size(watch%element)
         do i = 1, max_element_nodes
            if (watch%value_of(i, e) == 0) cycle
            values(:, watch%value_of(i, e), :) = nodal%amplitude(:, nodal%value_of(i, watch%element(e)), :)
         end do
      end do
   end function watched_values

end module axijoint_analysis_core_watched_stress
