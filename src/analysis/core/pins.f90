!> Nodes that are held as by pins and carry load in harmonics in which pins should not
module axijoint_analysis_core_pins
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_dofs, only : component_name
   use axijoint_assembly_force, only : joint_force
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, percent_text
   use axijoint_fe_shape, only : n_corners
   use axijoint_joints_field, only : joint_field_type, stress_amplitude
   use axijoint_model_mesh, only : n_nodes, n_elements, edge_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: pin_text, pins_of

   !> A pin carries load if its reaction is more than this part of the largest nodal force in the
   !> harmonic. So a small harmonic is not hidden behind the weight
   real(wp), parameter :: carries = 1.0e-3_wp
   !> Harmonics whose forces are below this part of the largest of all are rounding
   real(wp), parameter :: rounding = 1.0e-9_wp

contains

   !> What pins carry in harmonics 2 and above, in words; empty if nothing. A body that is held
   !> against rigid motion needs no pins there: they hinder it to change its round shape
   function pin_text(model, structure, loading, field, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> Loads at the end
      type(loading_type), intent(in) :: loading
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> Results, with reactions
      type(results_type), intent(in) :: results
      !> The words
      character(len=:), allocatable :: text

      logical, allocatable :: pins(:, :)
      real(wp) :: scale(size(results%modes)), reaction(size(results%modes))
      integer :: k, place(2)

      text = ''
      if (.not. any(results%modes%harmonic > 1)) return
      pins = pins_of(model)
      if (.not. any(pins)) return
      do k = 1, size(results%modes)
         scale(k) = max(maxval(abs(loading%right(:, :, k))), &
            maxval(abs(results%reaction(:, :, k))), &
                        maxval(abs(joint_forces(k))))
         reaction(k) = maxval(abs(results%reaction(:, :, k)), mask=pins)
      end do
      where (results%modes%harmonic < 2 .or. scale <= rounding*maxval(scale) &
         .or. reaction <= carries*scale) reaction = 0.0_wp
      if (.not. any(reaction > 0.0_wp)) return
      k = maxloc(reaction, 1)
      place = maxloc(abs(results%reaction(:, :, k)), mask=pins)
      text = 'node restraints carry load in harmonics above 1: at node '// &
             to_text(model%mesh%node_label(place(2)))//' ('//component_name(place(1))(1:1)// &
             ', m = '// &
             to_text(results%modes(k)%harmonic)//') '// &
             percent_text(reaction(k)/maxval(abs(results%reaction)))// &
             ' of the largest reaction; pins take harmonics 0 to 1'

   contains

      !> Nodal forces of the joints in one mode
      function joint_forces(k) result(force)
         !> Place of the mode
         integer, intent(in) :: k
         !> Forces on components, shape (3, nodes)
         real(wp), allocatable :: force(:, :)

         force = joint_force(structure%joint_points, results%modes(k)%harmonic, &
                             stress_amplitude(structure%joint_points, results%modes(k), &
                                              results%displacement(:, :, k), field, k), &
                                              n_nodes(model%mesh))
      end function joint_forces

   end function pin_text

   !> Components of nodes that cards of nodes hold in every harmonic because nothing else was said,
   !> without those on edges of elements that are held as a whole: these support a face
   pure function pins_of(model) result(pins)
      !> The job
      type(model_type), intent(in) :: model
      !> Whether u, v, w is held by a pin, shape (3, nodes)
      logical :: pins(3, n_nodes(model%mesh))

      integer, allocatable :: nodes(:)
      integer :: element, side, i

      pins = .false.
      if (.not. allocated(model%held_by_default)) return
      pins = model%held_by_default
      if (.not. any(pins)) return
      do element = 1, n_elements(model%mesh)
         do side = 1, n_corners(model%mesh%element_size(element))
            nodes = edge_nodes(model%mesh, element, side)
            do i = 1, 3
               if (all(model%fixed(i, nodes))) pins(i, nodes) = .false.
            end do
         end do
      end do
   end function pins_of

end module axijoint_analysis_core_pins
