!> From a deck to a model
module axijoint_deck_reader
   use axijoint_deck_check_axis, only : check_slivers, check_holes
   use axijoint_deck_check_elements, only : check_elements
   use axijoint_deck_check_joints, only : check_joints, check_joint_edges
   use axijoint_deck_check_locking, only : warn_of_locking
   use axijoint_deck_check_mesh, only : snap_to_axis, check_used, check_coincident, check_near, &
      check_hanging, check_touching
   use axijoint_deck_check_overlap, only : check_overlap
   use axijoint_deck_check_unused, only : warn_of_unused
   use axijoint_deck_gmsh_faces, only : number_group_faces, lay_group_faces
   use axijoint_deck_gmsh_groups, only : read_groups
   use axijoint_deck_gmsh_import, only : gmsh_import_type, read_mesh_file
   use axijoint_deck_gmsh_joints, only : lay_group_joints
   use axijoint_deck_gmsh_solids, only : draft_gmsh
   use axijoint_deck_load_loads, only : read_loads, check_properties
   use axijoint_deck_mesh_arrange, only : sort_nodes_and_elements, sort_joints
   use axijoint_deck_mesh_draft, only : draft_type, new_draft, corners_known
   use axijoint_deck_mesh_edges, only : edge_table_type, new_edge_table, check_edges
   use axijoint_deck_mesh_elements, only : draft_elements
   use axijoint_deck_mesh_faces, only : number_faces, lay_faces
   use axijoint_deck_mesh_generate_blocks, only : draft_blocks
   use axijoint_deck_mesh_generate_lines, only : draft_nodes, draft_lines
   use axijoint_deck_mesh_interfaces, only : refer_interfaces, lay_interfaces
   use axijoint_deck_mesh_joints, only : draft_joints
   use axijoint_deck_mesh_kinds, only : choose_kinds
   use axijoint_deck_mesh_places, only : group_places, new_point_tree, point_tree_type, same_place
   use axijoint_deck_property_law_details, only : read_law_details
   use axijoint_deck_property_properties, only : properties_type, read_properties
   use axijoint_deck_request_control, only : read_control, check_planes
   use axijoint_deck_request_refinement, only : refine_sections, read_error_goal, can_refine_mesh
   use axijoint_deck_request_requests, only : read_lines, read_cuts, place_lines, place_cuts, &
      gather_supported_faces
   use axijoint_deck_request_sweep, only : read_sweep
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_layout, only : section_law_details, section_control, section_nodes, section_lines, section_elements, &
      section_blocks, section_groups, section_materials, section_laws, section_joints, section_faces, &
      section_chains, section_interfaces, section_increments, section_output, section_orthotropic, &
      section_sections, section_cuts, section_sweep, section_fixed_faces, section_moved_faces, section_springs, section_error
   use axijoint_deck_text_sections, only : sections_type, read_sections
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_source_reader, only : read_source
   use axijoint_fe_element_kind, only : kind_choice_type
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : refinement_type
   implicit none
   private
   public :: read_deck

contains

   !> Read a deck with all that it includes. The model is valid only if there are
   !> no errors among the messages
   subroutine read_deck(path, source, model, diagnostics, refinement)
      !> The deck
      character(len=*), intent(in) :: path
      !> Its cards, for the echo and the messages
      type(source_type), intent(out) :: source
      !> The job
      type(model_type), intent(out) :: model
      !> Errors and warnings
      type(diagnostics_type), intent(out) :: diagnostics
      !> Refinement of what the deck says; none if absent
      type(refinement_type), intent(in), optional :: refinement

      type(sections_type) :: sections
      type(properties_type) :: properties
      type(draft_type) :: draft
      type(gmsh_import_type) :: import
      type(kind_choice_type) :: choice

      call read_source(path, source, diagnostics)
      if (source%n_cards == 0) return
      call read_sections(source, sections, diagnostics)
      if (.not. sections%complete) return
      if (present(refinement)) call refine_sections(refinement, sections)
      associate (tables => sections%tables)
         model%title = sections%title
         call read_control(tables(section_control), tables(section_increments), &
                           tables(section_output), model, choice)
         call read_properties(source, tables(section_materials), tables(section_orthotropic), &
                              tables(section_laws), properties, diagnostics)
         call read_law_details(source, tables(section_law_details), properties, diagnostics)
         call read_mesh_file(source, import, diagnostics)
         call read_groups(source, tables(section_groups), properties, import, diagnostics)
         call make_solids(source, sections, properties, choice, import, draft, diagnostics)
         call number_faces(source, tables(section_faces), tables(section_chains), draft, diagnostics)
         call number_group_faces(source, tables(section_groups), import, draft, diagnostics)
         call make_joints_and_faces(source, sections, properties, import, draft, diagnostics)
         call read_loads(source, sections, properties, draft, model, diagnostics)
         call read_requests(source, sections, draft, model, diagnostics)
         call read_sweep(source, tables(section_sweep), model%sweep, diagnostics)
         call read_error_goal(tables(section_error), model%error_goal, diagnostics)
         model%error_goal%mesh_too = can_refine_mesh(sections)
         if (diagnostics%n_errors > 0) return
         call take_model(draft, properties, model)
         call check_properties(sections, model, diagnostics)
         call warn_of_locking(sections, model, diagnostics)
         call warn_of_unused(source, sections, draft, model%mesh, diagnostics)
         call check_planes(source, tables(section_control), model, diagnostics)
      end associate
   end subroutine read_deck

   !> Make nodes and elements, and check their shape
   subroutine make_solids(source, sections, properties, choice, import, draft, diagnostics)
      !> The deck; lines of the mesh file at fault become cards
      type(source_type), intent(inout) :: source
      !> Its sections
      type(sections_type), intent(in) :: sections
      !> Materials and laws
      type(properties_type), intent(in) :: properties
      !> Rules and formulation of the elements
      type(kind_choice_type), intent(in) :: choice
      !> The mesh of the mesh file
      type(gmsh_import_type), intent(inout) :: import
      !> The mesh
      type(draft_type), intent(out) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      associate (tables => sections%tables)
         draft = new_draft(tables(section_nodes)%n, tables(section_elements)%n, tables(section_joints)%n)
         call draft_nodes(source, tables(section_nodes), draft, diagnostics)
         call draft_lines(source, tables(section_lines), draft, diagnostics)
         call draft_elements(source, tables(section_elements), properties, draft, diagnostics)
         call draft_gmsh(source, tables(section_groups), import, draft, diagnostics)
         call sort_nodes_and_elements(draft)
         call draft_blocks(source, tables(section_blocks), properties, draft, diagnostics)
      end associate
      call snap_to_axis(draft, diagnostics)
      call choose_kinds(choice, draft)
      call check_elements(draft, diagnostics)
      if (draft%n_elements == 0 .and. draft%elements_complete) then
         call add_error(diagnostics, 0, 0, 0, 'the deck has no elements', &
                        mend='give ELEMENTS with NODES, or BLOCKS, or a mesh file by GMSH')
      else
         call check_used(draft, diagnostics)
      end if
   end subroutine make_solids

   !> Make joints and faces. What depends on neighbours is judged only if no card
   !> of the mesh is lost: else every gap would be reported again
   subroutine make_joints_and_faces(source, sections, properties, import, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Its sections
      type(sections_type), intent(in) :: sections
      !> Materials and laws
      type(properties_type), intent(in) :: properties
      !> The mesh of the mesh file
      type(gmsh_import_type), intent(in) :: import
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(edge_table_type) :: edges
      type(point_tree_type) :: tree
      integer, allocatable :: group(:), reference(:, :)
      integer :: errors_before
      logical :: sound, tiles

      associate (tables => sections%tables)
         call draft_joints(source, tables(section_joints), properties, draft, diagnostics)
         call refer_interfaces(source, tables(section_interfaces), properties, draft, reference, diagnostics)
         sound = draft%nodes_complete .and. draft%elements_complete &
                 .and. all(draft%node_good(:draft%n_nodes)) &
                 .and. corners_known(draft)
         if (.not. sound) then
            draft%faces%good = .false.
            return
         end if
         group = group_places(draft%position(:, :draft%n_nodes), same_place*draft%extent)
         edges = new_edge_table(draft)
         tree = new_point_tree(draft%position(:, :draft%n_nodes))
         errors_before = diagnostics%n_errors
         call check_edges(draft, edges, diagnostics)
         if (diagnostics%n_errors > errors_before) then
            draft%faces%good = .false.
            return
         end if
         call check_coincident(draft, group, diagnostics)
         call check_near(draft, group, edges, tree, diagnostics)
         call check_hanging(draft, group, edges, tree, diagnostics)
         tiles = diagnostics%n_errors == errors_before
         call lay_faces(source, tables(section_faces), tables(section_chains), edges, draft, diagnostics)
         call lay_group_faces(source, tables(section_groups), import, edges, draft, diagnostics)
         call check_joints(source, tables(section_joints), properties%laws, group, edges, draft, &
                           diagnostics)
         call lay_interfaces(source, tables(section_interfaces), reference, properties, group, draft, &
                             diagnostics)
         call lay_group_joints(source, tables(section_groups), import, properties, group, edges, draft, &
                               diagnostics)
         call check_joint_edges(edges, draft, diagnostics)
         if (tiles) call check_overlap(draft, edges, diagnostics)
         if (diagnostics%n_errors == 0) then
            call check_touching(draft, group, diagnostics)
            call check_slivers(draft, diagnostics)
            call check_holes(draft, diagnostics)
         end if
         call sort_joints(draft)
      end associate
   end subroutine make_joints_and_faces

   !> Read where results are wanted. Places are looked for if all elements are sound
   subroutine read_requests(source, sections, draft, model, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Its sections
      type(sections_type), intent(in) :: sections
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The job
      type(model_type), intent(inout) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      associate (lines => sections%tables(section_sections), cuts => sections%tables(section_cuts))
         call read_lines(source, lines, model%output_angles, model%lines, diagnostics)
         call read_cuts(source, cuts, model%cuts, diagnostics)
         model%supported_faces = gather_supported_faces(draft, &
            sections%tables([section_fixed_faces, section_moved_faces, section_springs]))
         if (lines%n + cuts%n == 0) return
         if (draft%n_elements == 0 .or. .not. (draft%nodes_complete .and. draft%elements_complete &
             .and. all(draft%element_good(:draft%n_elements)))) return
         call take_mesh(draft, model)
         call place_lines(lines, model%mesh, model%lines, diagnostics)
         call place_cuts(source, cuts, model%mesh, model%cuts, diagnostics)
      end associate
   end subroutine read_requests

   !> Move the finished mesh, materials and laws into the model
   subroutine take_model(draft, properties, model)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Materials and laws
      type(properties_type), intent(in) :: properties
      !> The job
      type(model_type), intent(inout) :: model

      model%materials = properties%materials
      model%joint_materials = properties%laws
      call take_mesh(draft, model)
   end subroutine take_model

   !> Move the finished mesh into the model
   subroutine take_mesh(draft, model)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The job
      type(model_type), intent(inout) :: model

      associate (n => draft%n_nodes, m => draft%n_elements, k => draft%n_joints)
         model%mesh%coordinates = draft%position(:, :n)
         model%mesh%node_label = draft%node_label(:n)
         model%mesh%element_label = draft%element_label(:m)
         model%mesh%element_material = draft%element_material(:m)
         model%mesh%element_body = draft%element_body(:m)
         model%mesh%element_size = draft%element_size(:m)
         model%mesh%element_kind = draft%element_kind
         model%mesh%kinds = draft%kinds
         model%mesh%element_nodes = draft%element_nodes(:, :m)
         model%mesh%joint_label = draft%joint_label(:k)
         model%mesh%joint_material = draft%joint_law(:k)
         model%mesh%joint_size = draft%joint_size(:k)
         model%mesh%joint_nodes = draft%joint_nodes(:, :k)
      end associate
   end subroutine take_mesh

end module axijoint_deck_reader
