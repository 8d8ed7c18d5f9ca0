!> Errors of the resultants on cuts. They are as wrong as what acts on the part beyond the cut: joints, springs and
!> supports; loads are known
module axijoint_analysis_error_cut_errors
   use axijoint_analysis_core_cut_loads, only : resultants_above
   use axijoint_analysis_core_cut_planes, only : plane_type, of_body, from_cut, is_above
   use axijoint_analysis_core_cuts, only : with_resultants, resultants_of_stress, displaced_excess
   use axijoint_analysis_core_fields, only : n_resultants, axial, lateral, moment, torque, lateral_90, moment_90
   use axijoint_analysis_core_rigid, only : rigid_resultants
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_fine_conditions, only : held_part
   use axijoint_analysis_fine_level, only : fine_load_type, new_fine_load
   use axijoint_analysis_fine_mesh, only : prolong, restrict
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type, error_over_difference
   use axijoint_assembly_force, only : joint_jump, joint_force, elastic_joint_stress
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_solid_force, only : initial_state_type, solid_force
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : lower_node, upper_node
   use axijoint_fe_element_kind, only : formulation_bbar, is_reduced
   use axijoint_fe_mode, only : mode_type, is_torsion
   use axijoint_joints_joint_change, only : joint_change_type
   use axijoint_model_material, only : elasticity
   use axijoint_model_mesh, only : mesh_type, n_elements, n_joints, n_nodes
   use axijoint_model_model, only : model_type, held_components
   implicit none
   private
   public :: n_kinds, kind_force, kind_lateral, kind_moment, kind_torque, kind_names
   public :: sizes_on_cuts, change_on_cuts, find_held_on_cuts, relative_on_cuts

   !> Kinds of resultants: axial force, lateral force and moment in any direction, torque
   integer, parameter :: n_kinds = 4, kind_force = 1, kind_lateral = 2, kind_moment = 3, kind_torque = 4
   !> Their names in summaries
   character(len=13), parameter :: kind_names(n_kinds) = [character(len=13) :: 'axial_force', 'lateral_force', 'moment', 'torque']
   !> Errors are measured by no less than this part of the largest force, or of a moment that it would have across the bodies: a
   !> force that is next to nothing on all cuts is no measure
   real(wp), parameter :: slight = 0.01_wp
   !> Stiffness k h over that of the body from which on springs are stiff: at 1.2 a cut at their end was told 15 times its error, at
   !> 0.3 cuts through them as well as others
   real(wp), parameter :: stiff_springs = 0.5_wp

contains

   !> Sizes of resultants, whatever their direction
   pure function sizes_on_cuts(resultants) result(sizes)
      !> Shape (n_resultants, cuts)
      real(wp), intent(in) :: resultants(:, :)
      !> Shape (n_kinds, cuts)
      real(wp) :: sizes(n_kinds, size(resultants, 2))

      sizes(kind_force, :) = abs(resultants(axial, :))
      sizes(kind_lateral, :) = hypot(resultants(lateral, :), resultants(lateral_90, :))
      sizes(kind_moment, :) = hypot(resultants(moment, :), resultants(moment_90, :))
      sizes(kind_torque, :) = abs(resultants(torque, :))
   end function sizes_on_cuts

   !> Largest error of any kind over the largest resultant of the kind, of the cuts of which it is known; negative if of none
   pure real(wp) function relative_on_cuts(errors, sizes, extent, least_force) result(relative)
      !> Errors and resultants, shape (n_kinds, cuts); errors negative if not known
      real(wp), intent(in) :: errors(:, :), sizes(:, :)
      !> Extent of the bodies [length], and the least force that errors are measured by [force]
      real(wp), intent(in) :: extent, least_force

      real(wp), dimension(n_kinds) :: arm, least

      relative = -1.0_wp
      if (size(sizes, 2) == 0) return
      if (all(errors(1, :) < 0.0_wp)) return
      arm = 1.0_wp
      arm([kind_moment, kind_torque]) = extent
      least = max(least_force, slight*maxval(maxval(sizes, 2)/arm))*arm
      if (maxval(least) > 0.0_wp) then
         relative = maxval(maxval(errors, 2)/max(least, maxval(sizes, 2)))
      else if (.not. any(errors > 0.0_wp)) then
         relative = 0.0_wp  ! nothing acts, and nothing is off
      end if
   end function relative_on_cuts

   !> What a change of the joints does to the resultants, with the displacements that follow from it
   function change_on_cuts(model, structure, change, effect) result(on_cuts)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints, springs and cuts
      type(structure_type), intent(in) :: structure
      !> The change of the joints that can yield
      type(joint_change_type), intent(in) :: change
      !> Displacements but for rigid motions of floating parts, amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: effect(:, :, :)
      !> Shape (n_resultants, cuts)
      real(wp) :: on_cuts(n_resultants, size(structure%cuts))

      type(initial_state_type) :: none
      real(wp), allocatable :: stress(:, :, :)
      integer, allocatable :: places(:)
      integer :: m

      places = with_resultants(structure%modes)
      allocate (stress(3, size(structure%joint_points), size(places)))
      do m = 1, size(places)
         stress(:, :, m) = elastic_joint_stress(structure%joint_points, joint_jump(structure%joint_points, effect(:, :, places(m))))
         stress(:, structure%yielding, m) = stress(:, structure%yielding, m) - change%excess(:, :, places(m))
      end do
      on_cuts = resultants_of_stress(model, structure, none, places, structure%modes(places), effect(:, :, places), stress)
   end function change_on_cuts

   !> Find what the mesh leaves of the resultants while the excess stress of the joints is held: by what acts on the part above a
   !> cut, or on that below it if less acts there, so that what is found in part alone has as little to say as may be. Nothing is
   !> known if what is cut shares nodes with what is not, nor of a cut through a support, whose reactions are those of nodes, or
   !> through stiff springs
   subroutine find_held_on_cuts(model, structure, loading, displacement, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints, springs and cuts
      type(structure_type), intent(in) :: structure
      !> The loads
      type(loading_type), intent(in) :: loading
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The errors while it is held; takes those of the resultants
      type(mesh_error_type), intent(inout) :: error

      real(wp), allocatable :: stress(:, :, :), force(:, :, :), acting(:, :, :)
      integer, allocatable :: places(:)
      type(fine_load_type) :: fine
      logical :: cut(n_nodes(model%mesh)), shares, nested
      logical, allocatable :: held(:)
      integer :: c, m

      if (size(structure%cuts) == 0 .or. .not. allocated(error%acting)) return
      places = with_resultants(structure%modes)
      nested = are_nested(model)
      if (.not. nested) fine = new_fine_load(structure%fine, structure%modes, loading)
      allocate (stress(3, size(structure%joint_points), size(places)))
      allocate (force(3, size(cut), size(places)))
      do m = 1, size(places)
         associate (k => places(m), harmonic => structure%modes(places(m))%harmonic)
            stress(:, :, m) = elastic_joint_stress(structure%joint_points, error%jump(:, :, k))
            force(:, :, m) = error%acting(:, :, k) - joint_force(structure%joint_points, harmonic, stress(:, :, m), size(cut))
            if (.not. nested) force(:, :, m) = force(:, :, m) - error_over_difference*stiffer_reactions(model, structure, &
               loading%initial, fine%initial, k, displacement(:, :, k))
         end associate
      end do
      error%on_cuts = -displaced_excess(model, structure, structure%modes(places), error%displacement(:, :, places), stress)
      allocate (error%known_on_cuts(size(structure%cuts)))
      held = reacting(model, structure, places)
      do c = 1, size(structure%cuts)
         associate (body => model%cuts(c)%body)
            if (body /= model%cuts(max(1, c - 1))%body .or. c == 1) then
               cut = of_body(model%mesh, body)
               shares = body > 0
               if (shares) shares = shares_nodes(model%mesh, cut, body)
               acting = force
               if (body == 0) call join_sides(model%mesh, acting)
            end if
         end associate
         error%on_cuts(:, c) = error%on_cuts(:, c) + acting_beyond(c)
         error%known_on_cuts(c) = .not. (shares .or. cuts_support(model%mesh, structure%cuts(c), held) &
            .or. cuts_stiff_springs(model, structure%cuts(c)))
      end do

   contains

      !> Resultants of what acts above a cut, by the side on which less acts
      function acting_beyond(c) result(resultants)
         !> The cut
         integer, intent(in) :: c
         !> The resultants
         real(wp) :: resultants(n_resultants)

         integer, allocatable :: nodes(:)
         real(wp), allocatable :: position(:, :)
         logical, allocatable :: above(:)
         real(wp) :: whole(n_resultants), amount(2)
         integer :: k

         nodes = pack([(k, k=1, size(cut))], cut)
         position = from_cut(structure%cuts(c), model%mesh, nodes)
         above = is_above(structure%cuts(c), position(2, :))
         resultants = 0.0_wp
         whole = 0.0_wp
         amount = 0.0_wp
         do k = 1, size(places)
            associate (mode => structure%modes(places(k)), on_nodes => acting(:, nodes, k))
               resultants = resultants + resultants_above(structure%cuts(c), mode, position, on_nodes)
               whole = whole + rigid_resultants(position, mode, on_nodes)
               associate (size_of => pushing(mode, position(1, :), on_nodes))
                  amount = amount + [sum(size_of, mask=above), sum(size_of, mask=.not. above)]
               end associate
            end associate
         end do
         if (amount(2) < amount(1)) resultants = resultants - whole
      end function acting_beyond

   end subroutine find_held_on_cuts

   !> Sizes of forces as far as they have resultants: those round a circle that balance each other, as where the axis holds it, have none
   pure function pushing(mode, r, force) result(sizes)
      !> The mode, of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> Radius of each node
      real(wp), intent(in) :: r(:)
      !> Forces on nodes, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Shape (nodes)
      real(wp) :: sizes(size(force, 2))

      if (mode%harmonic > 0) then
         sizes = hypot(merge(force(2, :), 0.0_wp, r > 0.0_wp), force(1, :) - force(3, :))
      else
         sizes = hypot(force(2, :), force(3, :))
      end if
   end function pushing

   !> Put forces on both sides of joints together where all bodies are cut: there joints act on nothing beyond the cut, and what they
   !> put on nodes is not to say on which side of it less acts
   pure subroutine join_sides(mesh, force)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Forces on nodes, shape (3, nodes, any)
      real(wp), intent(inout) :: force(:, :, :)

      integer :: i, j

      do j = 1, n_joints(mesh)
         do i = 1, mesh%joint_size(j)/2
            associate (one => mesh%joint_nodes(lower_node(i), j), other => mesh%joint_nodes(upper_node(i), j))
               if (one == other) cycle
               force(:, one, :) = force(:, one, :) + force(:, other, :)
               force(:, other, :) = 0.0_wp
            end associate
         end do
      end do
   end subroutine join_sides

   !> Whether halves of elements together do the work that they do whole, where they move alike
   pure logical function are_nested(model)
      !> The job
      type(model_type), intent(in) :: model

      are_nested = .not. any(is_reduced(model%mesh%kinds) .or. model%mesh%kinds%formulation == formulation_bbar)
   end function are_nested

   !> Reactions that elements have more of than their halves would have, moved alike: elements of a reduced rule or a mean volumetric
   !> strain are softer than these. Without them tubes of such elements, held at both ends, were told 20 to 50 times their errors
   function stiffer_reactions(model, structure, initial, of_fine, k, displacement) result(reaction)
      !> The job
      type(model_type), intent(in) :: model
      !> Its modes, and the fine mesh
      type(structure_type), intent(in) :: structure
      !> What stresses the solids without strain, and the same on the fine mesh
      type(initial_state_type), intent(in) :: initial, of_fine
      !> Place of the mode
      integer, intent(in) :: k
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Shape (3, nodes)
      real(wp) :: reaction(3, size(displacement, 2))

      real(wp), allocatable :: moved(:, :), by_node(:, :), force(:, :)
      real(wp) :: of_halves(3, size(displacement, 2))
      integer :: node

      associate (level => structure%fine, mode => structure%modes(k), equations => structure%equations)
         allocate (moved(3, n_nodes(level%model%mesh)))
         allocate (by_node, force, mold=moved)
         call prolong(level%parents, displacement, moved)
         by_node = moved(:, level%stiffness%place)
         call solid_force(level%model, of_fine, k, mode, by_node, force)
         moved(:, level%stiffness%place) = force
         call restrict(level%parents, moved, of_halves)
         call solid_force(model, initial, k, mode, displacement, reaction)
         associate (conditions => level%conditions(equations%systems(equations%system(k))%class))
            do node = 1, size(reaction, 2)
               reaction(:, node) = held_part(conditions, level%stiffness%place(node), reaction(:, node) - of_halves(:, node))
            end do
         end associate
      end associate
   end function stiffer_reactions

   !> Nodes whose reactions have resultants
   pure function reacting(model, structure, places) result(reacts)
      !> The job
      type(model_type), intent(in) :: model
      !> Its modes
      type(structure_type), intent(in) :: structure
      !> Places of the modes that have resultants
      integer, intent(in) :: places(:)
      !> Shape (nodes)
      logical :: reacts(n_nodes(model%mesh))

      integer :: m

      reacts = .false.
      do m = 1, size(places)
         associate (mode => structure%modes(places(m)), held => held_components(model, structure%modes(places(m))))
            if (mode%harmonic > 0) then
               reacts = reacts .or. any(held, 1)
            else
               reacts = reacts .or. held(merge(3, 2, is_torsion(mode)), :)
            end if
         end associate
      end do
   end function reacting

   !> Whether elements that a cut passes through are held above and below it
   pure logical function cuts_support(mesh, plane, held)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The cut
      class(plane_type), intent(in) :: plane
      !> Nodes that are held
      logical, intent(in) :: held(:)

      logical :: sides(2)
      integer :: i, k

      sides = .false.
      do k = 1, size(plane%crossed)
         associate (nodes => mesh%element_nodes(:mesh%element_size(plane%crossed(k)), plane%crossed(k)))
            do i = 1, size(nodes)
               if (held(nodes(i))) sides(merge(1, 2, is_above(plane, mesh%coordinates(2, nodes(i)) - plane%z))) = .true.
            end do
         end associate
      end do
      cuts_support = all(sides)
   end function cuts_support

   !> Whether a cut passes through springs that are stiff beside the body: what these push with changes along an element more than
   !> the errors of its nodes tell
   pure logical function cuts_stiff_springs(model, plane) result(cuts)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      class(plane_type), intent(in) :: plane

      real(wp) :: d(6, 6), most
      integer :: i, k, s

      cuts = .false.
      do s = 1, size(plane%springs)
         associate (support => model%edge_supports(plane%springs(s)), mesh => model%mesh)
            associate (length => norm2(mesh%coordinates(:, support%nodes(2)) - mesh%coordinates(:, support%nodes(1))))
               do k = 1, size(plane%crossed)
                  associate (element => plane%crossed(k))
                     if (.not. any(mesh%element_nodes(:, element) == support%nodes(1))) cycle
                     if (.not. any(mesh%element_nodes(:, element) == support%nodes(2))) cycle
                     d = elasticity(model%materials(mesh%element_material(element)))
                     most = maxval([(d(i, i), i=1, 3)])
                     cuts = cuts .or. maxval(support%stiffness)*length > stiff_springs*most
                  end associate
               end do
            end associate
         end associate
      end do
   end function cuts_stiff_springs

   !> Whether elements of other bodies hang on nodes of a body
   pure logical function shares_nodes(mesh, cut, body) result(shares)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Whether a node is of the body
      logical, intent(in) :: cut(:)
      !> The body
      integer, intent(in) :: body

      integer :: e

      shares = .false.
      do e = 1, n_elements(mesh)
         if (mesh%element_body(e) == body) cycle
         shares = shares .or. any(cut(mesh%element_nodes(:mesh%element_size(e), e)))
      end do
   end function shares_nodes

end module axijoint_analysis_error_cut_errors
