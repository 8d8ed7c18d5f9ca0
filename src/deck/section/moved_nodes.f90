!> MOVEDNODES: given displacements of nodes
module axijoint_deck_section_moved_nodes
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_row
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : sole_harmonic, sole_family, held_in, displacements
   use axijoint_deck_job_modes, only : read_shares, check_components
   use axijoint_deck_job_moves, only : check_given, move_node
   use axijoint_deck_load_shares, only : share_type
   use axijoint_deck_text_common_fields, only : node, last_node, step, name_node
   use axijoint_deck_text_entry, only : is_given, reals_of, is_sound
   use axijoint_deck_text_field, only : described
   implicit none
   private
   public :: moved_nodes_section

   !> The keyword
   character(len=*), parameter :: keyword_moved_nodes = 'MOVEDNODES'
   !> First component
   integer, parameter :: field_first = 3

contains

   !> MOVEDNODES
   function moved_nodes_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_moved_nodes
      section%purpose = 'given displacements of nodes'
      section%is_load = .true.
      section%stage = stage_loads
      section%read => read_moved_nodes
      section%fields = &
         [node(name_node, 1), sole_harmonic(6), &
          described(displacements('', 11), 'u v w: amplitudes [length]', &
                    blank='not held by this card', &
                    limits='one at least must be given'), &
          sole_family(41), last_node(46), step(51), held_in(56)]
   end function moved_nodes_section

   !> Note the displacements
   subroutine read_moved_nodes(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_moved_nodes)
      do while (next_card(card))
         call read_row(card)
      end do
   end subroutine read_moved_nodes

   !> Displacements of a row of nodes
   subroutine read_row(card)
      !> A card of MOVEDNODES
      type(card_type), intent(in) :: card

      type(share_type), allocatable :: shares(:)
      integer, allocatable :: nodes(:)
      logical :: given(3)
      integer :: i

      given = [(is_given(card, field_first + i), i=0, 2)]
      call check_given(card, field_first, given)
      call check_components(card, 'displacement', field_first, 3)
      call read_shares(card, shares)
      call find_row(card, nodes)
      if (.not. is_sound(card)) return
      do i = 1, size(nodes)
         call move_node(card, field_first, nodes(i), given, reals_of(card, field_first, 3))
      end do
   end subroutine read_row

end module axijoint_deck_section_moved_nodes
