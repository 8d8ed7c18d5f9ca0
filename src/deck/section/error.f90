!> ERROR: the error that a job may have, and what a deck is read with when it is refined for it
module axijoint_deck_section_error
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_section_blocks, only : keyword_blocks, field_size, field_n1, field_n2
   use axijoint_deck_section_control, only : keyword_control, field_harmonic, field_planes, &
      field_method
   use axijoint_deck_section_groups, only : keyword_groups
   use axijoint_deck_section_increments, only : keyword_increments, field_tolerance
   use axijoint_deck_section_cuts, only : keyword_cuts
   use axijoint_deck_section_points, only : keyword_points
   use axijoint_deck_section_sections, only : keyword_sections
   use axijoint_deck_text_entry, only : integer_of, real_of, card_fault, field_fault
   use axijoint_deck_text_field, only : integer_field, real_field, word_field, described
   use axijoint_deck_text_sections, only : sections_type, table_of
   use axijoint_deck_text_table, only : table_type
   use axijoint_model_model, only : method_newton
   use axijoint_model_request, only : refinement_type, goal_names, goal_displacement, goal_points, goal_cuts, goal_sections, &
      division_names, division_graded
   implicit none
   private
   public :: error_section, refine_sections, asks_for_strips

   !> The keyword
   character(len=*), parameter :: keyword_error = 'ERROR'
   !> Fields
   integer, parameter :: field_target = 1, field_quantity = 2, field_rounds = 3, field_unknowns = 4, &
      field_division = 5

contains

   !> ERROR
   function error_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_error
      section%purpose = 'the job is solved again, refined, until its error is below a target'
      section%once = .true.
      section%stage = stage_requests
      section%read => read_goal
      section%fields = &
         [described(real_field('the target', 1, above=0.0_wp, to=100.0_wp), 'target [%]', &
                    limits='0 < … ≤ 100'), &
          described(word_field('the quantity', 11, 20, goal_names, goal_displacement), &
                    'of what: JOINTS (joint stress), DISPL (displacements), ENERGY (stresses '// &
                    'in the energy norm), POINTS (displacements at points of POINTS), CUTS (resultants on CUTS), SECTIONS '// &
                    '(stresses along SECTIONS)'), &
          integer_field('the most rounds', 21, 25, 1, 99, default=8), &
          described(integer_field('the most unknowns', 26, 35, 1, 1000000000, default=1000000), &
                    'most unknowns in all: no round is begun that could have more'), &
          described(word_field('the division of BLOCKS', 36, 45, division_names, division_graded), &
                    'elements of BLOCKS: GRADED (more of them where the error is), UNIFORM '// &
                    '(all divided alike)')]
   end function error_section

   !> Read the error that the job may have
   subroutine read_goal(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(table_type), pointer :: points, cuts, sections

      deck%model%error_goal%mesh_too = can_refine_mesh(deck%sections)
      deck%model%error_goal%remesh = can_remake_mesh(deck%sections)
      deck%model%error_goal%geometry = ''
      if (allocated(deck%source%geometry)) deck%model%error_goal%geometry = deck%source%geometry
      card = cards_of(deck, keyword_error)
      if (card%table%n == 0) return
      if (card%table%n > 1) then
         card%entry = 2
         call card_fault(card, 'a second card of ERROR', allowed='one card')
      end if
      card%entry = 1
      associate (goal => deck%model%error_goal)
         goal%wanted = .true.
         goal%target = 0.01_wp*real_of(card, field_target)
         goal%quantity = integer_of(card, field_quantity)
         goal%most_rounds = integer_of(card, field_rounds)
         goal%most_unknowns = integer_of(card, field_unknowns)
         goal%division = integer_of(card, field_division)
         points => table_of(deck%sections, keyword_points)
         if (goal%quantity == goal_points .and. points%n == 0) call field_fault(card, field_quantity, &
            'no point has a name', allowed='another quantity, or points in the section POINTS')
         cuts => table_of(deck%sections, keyword_cuts)
         if (goal%quantity == goal_cuts .and. cuts%n == 0) call field_fault(card, field_quantity, &
            'there is no cut', allowed='another quantity, or cuts in the section CUTS')
         sections => table_of(deck%sections, keyword_sections)
         if (goal%quantity == goal_sections .and. sections%n == 0) call field_fault(card, field_quantity, &
            'there is no line', allowed='another quantity, or lines in the section SECTIONS')
      end associate
   end subroutine read_goal

   !> Put a refinement into the cards of a deck
   subroutine refine_sections(refinement, sections)
      !> The refinement
      type(refinement_type), intent(in) :: refinement
      !> The deck
      type(sections_type), intent(inout), target :: sections

      type(table_type), pointer :: blocks, control, increments

      blocks => table_of(sections, keyword_blocks)
      control => table_of(sections, keyword_control)
      increments => table_of(sections, keyword_increments)
      associate (n => blocks%values(field_n1:field_n2, :blocks%n), &
                 size => blocks%values(field_size, :blocks%n))
         if (.not. allocated(refinement%strips)) n = max(1.0_wp, anint(refinement%mesh*n))
         if (refinement%quadratic) where (nint(size) == 4) size = 8.0_wp
      end associate
      if (control%n == 0) return
      if (refinement%harmonic > 0) control%values(field_harmonic, 1) = refinement%harmonic
      if (refinement%planes > 0) control%values(field_planes, 1) = refinement%planes
      if (refinement%newton) control%values(field_method, 1) = method_newton
      associate (tolerance => increments%values(field_tolerance, :increments%n))
         tolerance = refinement%tolerance*tolerance
      end associate
   end subroutine refine_sections

   !> Whether the mesh may be refined by dividing the strips of its blocks anew
   logical function asks_for_strips(sections)
      !> The deck
      type(sections_type), intent(in), target :: sections

      type(table_type), pointer :: goal

      goal => table_of(sections, keyword_error)
      asks_for_strips = .false.
      if (goal%n > 0) asks_for_strips = can_refine_mesh(sections) .and. &
         nint(goal%values(field_division, 1)) == division_graded
   end function asks_for_strips

   !> Whether more elements make the same job: the mesh is of BLOCKS alone, and no card
   !> calls nodes by their numbers, which change
   logical function can_refine_mesh(sections)
      !> The deck
      type(sections_type), intent(in), target :: sections

      type(table_type), pointer :: blocks, groups

      blocks => table_of(sections, keyword_blocks)
      groups => table_of(sections, keyword_groups)
      can_refine_mesh = .not. names_nodes(sections)
      can_refine_mesh = can_refine_mesh .and. blocks%n > 0 .and. groups%n == 0
   end function can_refine_mesh

   !> Whether another mesh of the same groups makes the same job: the mesh is of a mesh file alone
   logical function can_remake_mesh(sections)
      !> The deck
      type(sections_type), intent(in), target :: sections

      type(table_type), pointer :: blocks, groups

      blocks => table_of(sections, keyword_blocks)
      groups => table_of(sections, keyword_groups)
      can_remake_mesh = .not. names_nodes(sections)
      can_remake_mesh = can_remake_mesh .and. blocks%n == 0 .and. groups%n > 0
   end function can_remake_mesh

   !> Whether some card calls nodes by their numbers
   logical function names_nodes(sections)
      !> The deck
      type(sections_type), intent(in), target :: sections

      integer :: k

      names_nodes = .false.
      do k = 1, size(sections%tables)
         associate (table => sections%tables(k))
            if (table%n > 0) names_nodes = names_nodes .or. any(table%fields%refers_to == 'node')
         end associate
      end do
   end function names_nodes

end module axijoint_deck_section_error
