!> ERROR, and what a deck is read with when it is refined for it
module axijoint_deck_request_refinement
   use axijoint_base_kinds, only : wp
   use axijoint_deck_mesh_blocks, only : field_size, field_n1, field_n2
   use axijoint_deck_request_control, only : field_harmonic, field_planes, field_method
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_layout, only : section_control, section_blocks, section_error, section_elements, &
      section_groups, section_increments, section_restraints, section_ring_loads, section_point_loads, &
      section_node_temps, section_moved_nodes, section_chains, section_joints, section_nodes, section_lines
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_table, only : table_type, integer_value, entry_error
   use axijoint_model_model, only : method_newton
   use axijoint_model_request, only : error_goal_type, refinement_type
   implicit none
   private
   public :: refine_sections, read_error_goal, can_refine_mesh

   !> Fields of ERROR
   integer, parameter :: field_target = 1, field_quantity = 2, field_rounds = 3, field_unknowns = 4

contains

   !> Put a refinement into the cards of a deck
   pure subroutine refine_sections(refinement, sections)
      !> The refinement
      type(refinement_type), intent(in) :: refinement
      !> The deck
      type(sections_type), intent(inout) :: sections

      associate (blocks => sections%tables(section_blocks), control => sections%tables(section_control), &
                 increments => sections%tables(section_increments))
         associate (n => blocks%values(field_n1:field_n2, :blocks%n), size => blocks%values(field_size, :blocks%n))
            n = max(1.0_wp, anint(refinement%mesh*n))
            if (refinement%quadratic) where (nint(size) == 4) size = 8.0_wp
         end associate
         if (control%n == 0) return
         if (refinement%harmonic > 0) control%values(field_harmonic, 1) = refinement%harmonic
         if (refinement%planes > 0) control%values(field_planes, 1) = refinement%planes
         if (refinement%newton) control%values(field_method, 1) = method_newton
         increments%values(2, :increments%n) = refinement%tolerance*increments%values(2, :increments%n)
      end associate
   end subroutine refine_sections

   !> Whether more elements make the same job: the mesh is of BLOCKS alone, and no card
   !> calls nodes by their numbers, which change
   pure logical function can_refine_mesh(sections)
      !> The deck
      type(sections_type), intent(in) :: sections

      integer, parameter :: by_number(10) = [section_nodes, section_lines, section_elements, section_joints, &
         section_chains, section_restraints, section_ring_loads, section_point_loads, section_node_temps, &
         section_moved_nodes]

      can_refine_mesh = sections%tables(section_blocks)%n > 0 .and. sections%tables(section_groups)%n == 0 &
         .and. all(sections%tables(by_number)%n == 0)
   end function can_refine_mesh

   !> Read ERROR
   subroutine read_error_goal(table, goal, diagnostics)
      !> ERROR
      type(table_type), intent(in) :: table
      !> The error that the job may have
      type(error_goal_type), intent(out) :: goal
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      if (table%n == 0) return
      if (table%n > 1) call entry_error(diagnostics, table, 2, 'a second card of ERROR', allowed='one card')
      goal%wanted = .true.
      goal%target = 0.01_wp*table%values(field_target, 1)
      goal%quantity = integer_value(table, field_quantity, 1)
      goal%most_rounds = integer_value(table, field_rounds, 1)
      goal%most_unknowns = integer_value(table, field_unknowns, 1)
   end subroutine read_error_goal

end module axijoint_deck_request_refinement
