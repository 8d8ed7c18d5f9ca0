!> RESTRAINTS: fixed displacements of nodes
module axijoint_deck_section_restraints
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_holds, only : code, hold
   use axijoint_deck_job_load_fields, only : harmonic_range
   use axijoint_deck_mesh_node_range, only : find_nodes
   use axijoint_deck_text_common_fields, only : node, last_node, step, name_node
   implicit none
   private
   public :: restraints_section

   !> The keyword
   character(len=*), parameter :: keyword_restraints = 'RESTRAINTS'

contains

   !> RESTRAINTS
   function restraints_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_restraints
      section%purpose = 'fixed displacements of nodes'
      section%stage = stage_loads
      section%read => read_restraints
      section%fields = [node(name_node, 1), code(6), last_node(11), step(16), harmonic_range(21)]
   end function restraints_section

   !> Hold the nodes; what is held so far is held by default: no card says in which harmonics
   subroutine read_restraints(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer, allocatable :: nodes(:)

      associate (model => deck%model)
         allocate (model%fixed(3, deck%draft%n_nodes), &
                   model%held_by_default(3, deck%draft%n_nodes), source=.false.)
         allocate (model%restraints(0))
         card = cards_of(deck, keyword_restraints)
         do while (next_card(card))
            call find_nodes(card, deck%draft, nodes)
            call hold(card, nodes)
         end do
         model%held_by_default = model%fixed
      end associate
   end subroutine read_restraints

end module axijoint_deck_section_restraints
