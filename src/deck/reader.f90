!> From a deck to a model
module axijoint_deck_reader
   use axijoint_deck_check_axis, only : check_slivers, check_holes
   use axijoint_deck_check_effects, only : warn_of_lacking_properties
   use axijoint_deck_check_elements, only : check_elements
   use axijoint_deck_check_joints, only : check_joints, check_joint_edges
   use axijoint_deck_check_locking, only : warn_of_locking
   use axijoint_deck_check_mesh, only : snap_to_axis, check_used, put_bodies_together, check_coincident, &
      check_near, check_hanging, check_touching
   use axijoint_deck_check_overlap, only : check_overlap
   use axijoint_deck_check_unused, only : warn_of_unused
   use axijoint_deck_gmsh_faces, only : number_group_faces, lay_group_faces
   use axijoint_deck_gmsh_joints, only : lay_group_joints
   use axijoint_deck_gmsh_solids, only : draft_gmsh
   use axijoint_deck_job_card, only : cards_of
   use axijoint_deck_job_deck, only : deck_type, reader_type, stage_job, stage_properties, &
      stage_elements, stage_blocks, stage_faces, stage_joints, stage_loads, stage_requests
   use axijoint_deck_job_moves, only : take_moves
   use axijoint_deck_job_supports, only : gather_supported_faces
   use axijoint_deck_load_lists, only : new_load_lists, take_loads
   use axijoint_deck_mesh_arrange, only : sort_nodes_and_elements, sort_joints
   use axijoint_deck_mesh_bonds, only : merge_bonded, check_bonded_joints
   use axijoint_deck_mesh_draft, only : draft_type, new_draft, corners_known
   use axijoint_deck_mesh_edges, only : edge_table_type, new_edge_table, check_edges
   use axijoint_deck_mesh_places, only : group_places, new_point_tree, point_tree_type, same_place
   use axijoint_deck_property_properties, only : properties_type, new_properties
   use axijoint_deck_registry, only : all_sections, all_readers
   use axijoint_deck_section_case, only : warn_of_lacking_loads
   use axijoint_deck_section_chains, only : lay_chains
   use axijoint_deck_section_combine, only : keyword_combine
   use axijoint_deck_section_control, only : check_planes
   use axijoint_deck_section_cuts, only : place_cuts
   use axijoint_deck_section_points, only : place_points
   use axijoint_deck_section_error, only : refine_sections, asks_for_strips
   use axijoint_deck_section_faces, only : lay_faces
   use axijoint_deck_section_groups, only : keyword_groups
   use axijoint_deck_section_harmonics, only : warn_of_left_out
   use axijoint_deck_section_increments, only : refer_increments, warn_of_idle_cases, &
      check_control
   use axijoint_deck_section_interfaces, only : lay_interfaces
   use axijoint_deck_section_joints, only : keyword_joints
   use axijoint_deck_section_sections, only : place_lines
   use axijoint_deck_section_yield, only : check_yielding
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_sections, only : sections_type, read_sections, table_of
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_source_reader, only : read_source
   use axijoint_deck_text_table, only : table_type
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : refinement_type
   use axijoint_model_turning, only : hold_turning
   implicit none
   private
   public :: read_deck, open_deck, make_model, kept_mesh_type

   !> What a deck says of its mesh, made: for decks that say the same of it
   type :: kept_mesh_type
      !> Nodes, elements, faces, joints
      type(draft_type), allocatable :: draft
      !> Edges of the elements, and number of each node's place
      type(edge_table_type) :: edges
      integer, allocatable :: group(:)
   end type kept_mesh_type

contains

   !> Read a deck with all that it includes. The model is valid only if there are
   !> no errors among the messages
   subroutine read_deck(path, source, model, diagnostics, refinement, bytes)
      !> The deck
      character(len=*), intent(in) :: path
      !> Its cards, for the echo and the messages
      type(source_type), intent(out), target :: source
      !> The job
      type(model_type), intent(out), target :: model
      !> Errors and warnings
      type(diagnostics_type), intent(out), target :: diagnostics
      !> Refinement of what the deck says; none if absent
      type(refinement_type), intent(in), optional :: refinement
      !> What the deck says, if it is not to be read from its file
      character(len=*), intent(in), optional :: bytes

      type(sections_type) :: sections

      if (present(refinement)) then
         call open_deck(path, source, sections, diagnostics, bytes, refinement%mesh_file)
      else
         call open_deck(path, source, sections, diagnostics, bytes)
      end if
      if (source%n_cards == 0) return
      if (.not. sections%complete) return
      if (present(refinement)) call refine_sections(refinement, sections)
      call make_model(source, sections, model, diagnostics, refinement=refinement)
   end subroutine read_deck

   !> Read the cards of a deck with all that it includes, and nothing more
   subroutine open_deck(path, source, sections, diagnostics, bytes, mesh)
      !> The deck
      character(len=*), intent(in) :: path
      !> Its cards, for the echo and the messages
      type(source_type), intent(out) :: source
      !> What they say, section by section; of use if it is complete
      type(sections_type), intent(out) :: sections
      !> Errors and warnings
      type(diagnostics_type), intent(inout) :: diagnostics
      !> What the deck says, if it is not to be read from its file
      character(len=*), intent(in), optional :: bytes
      !> File of the mesh, in place of that of the GMSH card; none if not allocated
      character(len=:), allocatable, intent(in), optional :: mesh

      sections%complete = .false.
      if (is_another(mesh)) then
         call read_source(path, all_sections(), source, diagnostics, bytes, mesh)
      else
         call read_source(path, all_sections(), source, diagnostics, bytes)
      end if
      if (source%n_cards > 0) call read_sections(source, sections, diagnostics)
   end subroutine open_deck

   !> Whether a file is named
   pure logical function is_another(file)
      !> Its path
      character(len=:), allocatable, intent(in), optional :: file

      is_another = .false.
      if (present(file)) is_another = allocated(file)
   end function is_another

   !> From the entries of the sections to a model, valid only if there are no errors among the
   !> messages
   subroutine make_model(source, entries, model, diagnostics, kept, refinement)
      !> The cards
      type(source_type), intent(in), target :: source
      !> What they say
      type(sections_type), intent(in) :: entries
      !> The job
      type(model_type), intent(out), target :: model
      !> Errors and warnings
      type(diagnostics_type), intent(inout), target :: diagnostics
      !> The mesh: taken if it is there, which is right if all cards say the same of it; else kept
      type(kept_mesh_type), intent(inout), optional :: kept
      !> How the strips of blocks are divided, if not as the entries say
      type(refinement_type), intent(in), optional :: refinement

      type(deck_type), target :: deck
      type(reader_type), pointer :: readers(:)

      readers => all_readers()
      deck%sections = entries
      deck%source => source
      deck%model => model
      deck%diagnostics => diagnostics
      deck%properties = new_properties()
      deck%draft = new_draft()
      deck%strips_wanted = asks_for_strips(entries)
      if (present(refinement)) then
         if (allocated(refinement%strips)) deck%strips = refinement%strips
      end if

      call read_stage(deck, readers, stage_job)
      call read_stage(deck, readers, stage_properties)
      call make_mesh(deck, readers, kept)
      call make_loads(deck, readers)
      call read_stage(deck, readers, stage_requests)
      call place_requests(deck)
      if (diagnostics%n_errors > 0) return
      call take_model(deck%draft, deck%properties, model)
      call warn_of_lacking_properties(deck)
      call warn_of_locking(deck%properties, model, diagnostics)
      call warn_of_unused(deck)
      call check_planes(deck)
      call check_yielding(deck)
      call check_control(deck)
      call hold_turning(model)
   end subroutine make_model

   !> Make nodes, elements, faces and joints, or take those that are kept
   subroutine make_mesh(deck, readers, kept)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> Readers of all sections
      type(reader_type), intent(in) :: readers(:)
      !> The mesh, if it is to be taken or kept
      type(kept_mesh_type), intent(inout), optional :: kept

      if (present(kept)) then
         if (allocated(kept%draft)) then
            deck%draft = kept%draft
            deck%edges = kept%edges
            if (allocated(kept%group)) deck%group = kept%group
            return
         end if
      end if
      call make_solids(deck, readers)
      call make_faces_and_joints(deck, readers)
      if (.not. present(kept) .or. deck%diagnostics%n_errors > 0) return
      kept%draft = deck%draft
      kept%edges = deck%edges
      if (allocated(deck%group)) kept%group = deck%group
   end subroutine make_mesh

   !> Read the sections of a stage, in the order of the registry
   subroutine read_stage(deck, readers, stage)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> Readers of all sections
      type(reader_type), intent(in) :: readers(:)
      !> One of the `stage_` parameters
      integer, intent(in) :: stage

      integer :: k

      do k = 1, size(readers)
         if (readers(k)%stage == stage .and. associated(readers(k)%read)) call readers(k)%read(deck)
      end do
   end subroutine read_stage

   !> Make nodes and elements, and check their shape
   subroutine make_solids(deck, readers)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> Readers of all sections
      type(reader_type), intent(in) :: readers(:)

      call read_stage(deck, readers, stage_elements)
      associate (draft => deck%draft, diagnostics => deck%diagnostics)
         call draft_gmsh(cards_of(deck, keyword_groups), deck%source, deck%import, draft, &
            diagnostics)
         call sort_nodes_and_elements(draft)
         call read_stage(deck, readers, stage_blocks)
         call snap_to_axis(draft, diagnostics)
         call check_elements(draft, diagnostics)
         if (draft%n_elements == 0 .and. draft%elements_complete) then
            call add_error(diagnostics, 0, 0, 0, 'the deck has no elements', &
                           mend='give ELEMENTS with NODES, or BLOCKS, or a mesh file by GMSH')
         else
            call check_used(draft, diagnostics)
         end if
      end associate
   end subroutine make_solids

   !> Make faces and joints. What depends on neighbours is judged only if no card
   !> of the mesh is lost: else every gap would be reported again
   subroutine make_faces_and_joints(deck, readers)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> Readers of all sections
      type(reader_type), intent(in) :: readers(:)

      logical :: tiles

      call read_stage(deck, readers, stage_faces)
      call number_group_faces(cards_of(deck, keyword_groups), deck%import, deck%draft)
      call read_stage(deck, readers, stage_joints)
      call find_neighbours(deck, tiles)
      if (.not. allocated(deck%group)) then
         deck%draft%faces%good = .false.
         return
      end if
      associate (draft => deck%draft, edges => deck%edges, group => deck%group, &
                 diagnostics => deck%diagnostics)
         call lay_faces(deck)
         call lay_chains(deck)
         call lay_group_faces(cards_of(deck, keyword_groups), deck%import, edges, draft)
         call check_joints(cards_of(deck, keyword_joints), deck%properties%laws, group, edges, &
            draft)
         call lay_interfaces(deck)
         call lay_group_joints(cards_of(deck, keyword_groups), deck%import, deck%properties, &
                               group, edges, draft)
         call check_joint_edges(edges, draft, diagnostics)
         if (tiles) call check_overlap(draft, edges, diagnostics)
         call check_bonded_joints(draft, diagnostics)
         call bond(deck)
         if (diagnostics%n_errors == 0) then
            ! Bonding has replaced the places, which `group` still stands for
            call check_touching(draft, deck%group, diagnostics)
            call check_slivers(draft, diagnostics)
            call check_holes(draft, diagnostics)
         end if
         call sort_joints(draft)
      end associate
   end subroutine make_faces_and_joints

   !> Merge the nodes of bonded interfaces, and check that the elements still fit
   subroutine bond(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      if (.not. allocated(deck%draft%bonded_to) .or. deck%diagnostics%n_errors > 0) return
      call merge_bonded(deck%draft, deck%group)
      deck%edges = new_edge_table(deck%draft)
      call check_edges(deck%draft, deck%edges, deck%diagnostics)
   end subroutine bond

   !> Find which nodes are at one place and which edges are shared, and check that the elements of a
   !> body fit each other
   subroutine find_neighbours(deck, tiles)
      !> The deck; its places stay unknown if the mesh is not sound
      type(deck_type), intent(inout), target :: deck
      !> Whether the elements of each body fit
      logical, intent(out) :: tiles

      type(point_tree_type) :: tree
      integer, allocatable :: group(:)
      integer :: errors_before

      tiles = .false.
      associate (draft => deck%draft, edges => deck%edges, diagnostics => deck%diagnostics)
         if (.not. (draft%nodes_complete .and. draft%elements_complete &
             .and. all(draft%node_good(:draft%n_nodes)))) return
         if (.not. corners_known(draft)) return
         edges = new_edge_table(draft)
         errors_before = diagnostics%n_errors
         call check_edges(draft, edges, diagnostics)
         if (diagnostics%n_errors > errors_before) return
         call put_bodies_together(draft, edges, diagnostics)
         group = group_places(draft%position(:, :draft%n_nodes), same_place*draft%extent)
         tree = new_point_tree(draft%position(:, :draft%n_nodes))
         call check_coincident(draft, group, diagnostics)
         call check_near(draft, group, edges, tree, diagnostics)
         call check_hanging(draft, group, edges, tree, diagnostics)
         tiles = diagnostics%n_errors == errors_before
         call move_alloc(group, deck%group)
      end associate
   end subroutine find_neighbours

   !> Read harmonics, supports and loads, and make the loads of the job
   subroutine make_loads(deck, readers)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> Readers of all sections
      type(reader_type), intent(in) :: readers(:)

      type(table_type), pointer :: combinations

      deck%loads = new_load_lists(deck%draft%n_nodes)
      call read_stage(deck, readers, stage_loads)
      call refer_increments(deck)
      if (deck%diagnostics%n_errors == 0) then
         combinations => table_of(deck%sections, keyword_combine)
         call warn_of_idle_cases(deck, combinations%n > 0)
      end if
      call warn_of_lacking_loads(deck)
      call take_moves(deck)
      call take_loads(deck%loads, deck%model)
      call warn_of_left_out(deck)
   end subroutine make_loads

   !> Find the places where results are wanted, if all elements are sound
   subroutine place_requests(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      associate (draft => deck%draft, model => deck%model)
         model%supported_faces = gather_supported_faces(deck)
         if (size(model%lines) + size(model%cuts) + size(model%points) == 0) return
         if (draft%n_elements == 0 .or. .not. (draft%nodes_complete .and. draft%elements_complete &
             .and. all(draft%element_good(:draft%n_elements)))) return
         call take_mesh(draft, model)
         call place_lines(deck, model%mesh)
         call place_cuts(deck, model%mesh)
         call place_points(deck, model%mesh)
      end associate
   end subroutine place_requests

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
         model%mesh%shared_label = draft%bonded_labels
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
         model%mesh%joint_interface = draft%joint_interface(:k)
         model%interfaces = draft%interfaces
      end associate
   end subroutine take_mesh

end module axijoint_deck_reader
