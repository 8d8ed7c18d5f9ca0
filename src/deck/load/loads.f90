!> Restraints and loads
module axijoint_deck_load_loads
   use axijoint_base_kinds, only : wp
   use axijoint_deck_load_card, only : load_card_type, open_section, next_card
   use axijoint_deck_load_cases, only : cases_type, read_cases, case_of_card, warn_of_empty_cases, refer_increments, &
      read_combinations, warn_of_idle_cases
   use axijoint_deck_load_face_loads, only : read_traction, read_pressure, read_resultant
   use axijoint_deck_load_harmonics, only : read_harmonics
   use axijoint_deck_load_lists, only : load_lists_type, new_load_lists, take_loads
   use axijoint_deck_load_mass_loads, only : read_gravity, read_rotation, read_temperature, &
      read_node_temperature, read_in_situ
   use axijoint_deck_load_moves, only : read_moved_nodes, read_moved_face, take_moves
   use axijoint_deck_load_node_loads, only : read_ring_load, read_point_load
   use axijoint_deck_load_restraints, only : read_restraints
   use axijoint_deck_load_shapes, only : read_shapes
   use axijoint_deck_load_supports, only : read_springs
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_property_properties, only : properties_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_warning
   use axijoint_deck_text_layout, only : section_increments, section_control, section_harmonics, section_shapes, &
      section_restraints, section_fixed_faces, section_tractions, section_pressures, &
      section_resultants, section_ring_loads, section_point_loads, section_gravity, section_rotation, &
      section_temperatures, section_node_temps, section_moved_nodes, section_moved_faces, &
      section_springs, section_in_situ, section_case, section_combine
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: read_loads, check_properties

   !> Sections of loads
   integer, parameter :: load_sections(12) = [section_tractions, section_pressures, &
      section_resultants, section_ring_loads, section_point_loads, section_gravity, section_rotation, &
      section_temperatures, section_node_temps, section_moved_nodes, section_moved_faces, &
      section_in_situ]

contains

   !> Read harmonics, restraints and loads
   subroutine read_loads(source, sections, properties, draft, model, diagnostics)
      !> The deck
      type(source_type), intent(in), target :: source
      !> Its sections
      type(sections_type), intent(in), target :: sections
      !> Materials
      type(properties_type), intent(in) :: properties
      !> The mesh
      type(draft_type), intent(in), target :: draft
      !> The job
      type(model_type), intent(inout) :: model
      !> Messages
      type(diagnostics_type), intent(inout), target :: diagnostics

      type(load_card_type) :: card
      type(load_lists_type) :: lists
      integer :: k

      card%source => source
      card%sections => sections
      card%draft => draft
      card%material_of = properties%material_of
      card%diagnostics => diagnostics
      associate (tables => sections%tables)
         if (tables(section_control)%n > 0) then
            if (tables(section_control)%given(1, 1)) card%highest = model%max_harmonic
         end if
         call read_harmonics(source, tables(section_harmonics), card%highest, card%harmonics, diagnostics)
         call read_shapes(source, tables(section_shapes), card%shapes, diagnostics)
         call read_restraints(source, tables(section_restraints), tables(section_fixed_faces), draft, &
                              card%highest, model, diagnostics)
         call read_cases(source, tables(section_case), first_load(tables(load_sections)), card%cases, &
                         diagnostics)
         lists = new_load_lists(draft%n_nodes)
         do k = 1, size(load_sections)
            call read_section(card, load_sections(k), lists)
         end do
         call read_section(card, section_springs, lists)
         call read_combinations(source, tables(section_combine), card%cases, model%combinations, diagnostics)
         call refer_increments(source, tables(section_increments), card%cases, model%increments, diagnostics)
         if (diagnostics%n_errors == 0) then
            call warn_of_idle_cases(tables(section_increments), tables(section_combine)%n > 0, card%cases, &
                                    model%increments, model%combinations, diagnostics)
         end if
         call check_loaded(tables(load_sections), tables(section_case), card%cases, diagnostics)
      end associate
      model%harmonics = card%harmonics
      model%load_cases = card%cases%cases
      call take_moves(source, draft, lists, model, diagnostics)
      call take_loads(lists, model)
   end subroutine read_loads

   !> First card of any load; a large number if there is none
   pure integer function first_load(tables)
      !> Sections of loads
      type(table_type), intent(in) :: tables(:)

      integer :: k

      first_load = huge(first_load)
      do k = 1, size(tables)
         first_load = min(first_load, minval(tables(k)%cards(1, :tables(k)%n)))
      end do
   end function first_load

   !> Warn of a deck and of load cases without loads
   subroutine check_loaded(tables, case_table, cases, diagnostics)
      !> Sections of loads
      type(table_type), intent(in) :: tables(:)
      !> CASE
      type(table_type), intent(in) :: case_table
      !> Load cases
      type(cases_type), intent(in) :: cases
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      logical, allocatable :: loaded(:)
      integer :: k, entry

      if (sum(tables%n) == 0) then
         call add_warning(diagnostics, 0, 0, 0, 'the deck has no loads: all results will be zero')
         return
      end if
      allocate (loaded(size(cases%cases)), source=.false.)
      do k = 1, size(tables)
         do entry = 1, tables(k)%n
            loaded(case_of_card(cases, tables(k)%cards(1, entry))) = .true.
         end do
      end do
      call warn_of_empty_cases(cases, case_table, loaded, diagnostics)
   end subroutine check_loaded

   !> Read the cards of a section
   subroutine read_section(card, section, lists)
      !> The deck around them
      type(load_card_type), intent(inout) :: card
      !> The section
      integer, intent(in) :: section
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      call open_section(card, section)
      do while (next_card(card))
         call read_load(card, lists)
      end do
   end subroutine read_section

   !> Read one card of a load
   subroutine read_load(card, lists)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The loads
      type(load_lists_type), intent(inout) :: lists

      select case (card%section)
      case (section_tractions)
         call read_traction(card, lists)
      case (section_pressures)
         call read_pressure(card, lists)
      case (section_resultants)
         call read_resultant(card, lists)
      case (section_ring_loads)
         call read_ring_load(card, lists)
      case (section_point_loads)
         call read_point_load(card, lists)
      case (section_gravity)
         call read_gravity(card, lists)
      case (section_rotation)
         call read_rotation(card, lists)
      case (section_temperatures)
         call read_temperature(card, lists)
      case (section_node_temps)
         call read_node_temperature(card, lists)
      case (section_moved_nodes)
         call read_moved_nodes(card, lists)
      case (section_moved_faces)
         call read_moved_face(card, lists)
      case (section_in_situ)
         call read_in_situ(card, lists)
      case (section_springs)
         call read_springs(card, lists)
      end select
   end subroutine read_load

   !> Warn of loads that act on nothing, as no material has the property that they need
   subroutine check_properties(sections, model, diagnostics)
      !> Sections of the deck
      type(sections_type), intent(in) :: sections
      !> The job
      type(model_type), intent(in) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      logical :: heavy, expands
      integer :: i

      associate (used => model%materials(model%mesh%element_material))
         heavy = any(used%density > 0.0_wp)
         expands = any([(any(abs(used(i)%expansion) > 0.0_wp), i=1, size(used))])
      end associate
      call warn([section_gravity, section_rotation], heavy, 'no element has a density')
      call warn([section_temperatures, section_node_temps], expands, 'no element has a thermal expansion')

   contains

      !> Warn on the first card of some sections
      subroutine warn(of_sections, has_effect, reason)
         !> The sections
         integer, intent(in) :: of_sections(:)
         !> Whether their loads have an effect
         logical, intent(in) :: has_effect
         !> Why they have none
         character(len=*), intent(in) :: reason

         integer :: k

         if (has_effect) return
         do k = 1, size(of_sections)
            associate (table => sections%tables(of_sections(k)))
               if (table%n > 0) call add_warning(diagnostics, table%cards(1, 1), 0, 0, &
                  'the load has no effect: '//reason, mend='give it on the MATERIALS card')
            end associate
         end do
      end subroutine warn

   end subroutine check_properties

end module axijoint_deck_load_loads
