!> NODETEMPS: temperatures of nodes
module axijoint_deck_section_node_temps
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_row
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : harmonic, family, shape_number
   use axijoint_deck_job_modes, only : read_shares, check_torsion
   use axijoint_deck_load_lists, only : add_temperatures
   use axijoint_deck_load_shares, only : share_type
   use axijoint_deck_text_common_fields, only : node, last_node, step, name_node
   use axijoint_deck_text_entry, only : real_of, is_sound
   use axijoint_deck_text_field, only : real_field, described
   use axijoint_deck_text_section, only : needs_expansion
   implicit none
   private
   public :: node_temps_section

   !> The keyword
   character(len=*), parameter :: keyword_node_temps = 'NODETEMPS'
   !> Field of the temperature
   integer, parameter :: field_value = 5

contains

   !> NODETEMPS
   function node_temps_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_node_temps
      section%purpose = 'changes of temperature of nodes'
      section%is_load = .true.
      section%needs = needs_expansion
      section%stage = stage_loads
      section%read => read_node_temps
      section%fields = &
         [node(name_node, 1), last_node(6), step(11), harmonic(16), &
          described(real_field('T', 21), 'T', limits='any'), family(31), shape_number(36)]
   end function node_temps_section

   !> Add the temperatures
   subroutine read_node_temps(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_node_temps)
      do while (next_card(card))
         call read_row(card)
      end do
   end subroutine read_node_temps

   !> Temperature of a row of nodes
   subroutine read_row(card)
      !> A card of NODETEMPS
      type(card_type), intent(in) :: card

      type(share_type), allocatable :: shares(:)
      integer, allocatable :: nodes(:)
      integer :: k

      call check_torsion(card, 'temperature')
      call find_row(card, nodes)
      call read_shares(card, shares)
      if (size(nodes) == 0 .or. .not. is_sound(card)) return
      call add_temperatures(card%deck%loads, card%case, shares, 0, nodes, &
                            [(real_of(card, field_value), k=1, size(nodes))])
   end subroutine read_row

end module axijoint_deck_section_node_temps
