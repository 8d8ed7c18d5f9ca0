!> What is judged of an old deck when all of it was read: nodes that are alike or used by nothing
module axijoint_legacy_check
   use axijoint_base_kinds, only : wp
   use axijoint_base_sort, only : lexical_order
   use axijoint_base_text, only : to_text
   use axijoint_legacy_cards, only : cards_type, complain
   use axijoint_legacy_deck, only : old_deck_type
   implicit none
   private
   public :: check_old_deck

contains

   !> Check it
   subroutine check_old_deck(deck, cards)
      !> The deck, read without errors
      type(old_deck_type), intent(in) :: deck
      !> Its cards; take messages
      type(cards_type), intent(inout) :: cards

      logical :: used(deck%n_nodes), corner(deck%n_nodes)
      integer :: k, i

      used = .false.
      corner = deck%n_element_nodes == 4
      do k = 1, deck%n_elements
         used(deck%nodes(:, k)) = .true.
         if (deck%n_element_nodes > 4) corner(deck%nodes([1, 3, 5, 7], k)) = .true.
      end do
      do i = 1, deck%n_nodes
         if (used(i)) then
            if (corner(i) .and. deck%node_card(i) == 0) call complain(cards, 0, 0, &
               'corner node '//to_text(i)//' of an element has no coordinates', card=cards%at)
         else if (any(deck%held_node == i)) then
            call complain(cards, 0, 20, 'node '//to_text(i)//' is restrained, and no element has '// &
               'it', card=deck%held_card(findloc(deck%held_node, i, 1)))
         else if (deck%node_card(i) > 0) then
            call complain(cards, 0, 19, 'node '//to_text(i)//' has coordinates, and no element has '// &
               'it', card=deck%node_card(i))
         else
            call complain(cards, 0, 18, 'no element has node '//to_text(i), card=cards%at)
         end if
      end do
      call check_alike(deck, cards)
   end subroutine check_old_deck

   !> Two nodes at one place
   subroutine check_alike(deck, cards)
      !> The deck
      type(old_deck_type), intent(in) :: deck
      !> Its cards; take messages
      type(cards_type), intent(inout) :: cards

      integer, allocatable :: order(:)
      integer :: k

      order = pack([(k, k=1, deck%n_nodes)], deck%node_card > 0)
      order = order(lexical_order(deck%position(:, order)))
      do k = 2, size(order)
         if (any(abs(deck%position(:, order(k)) - deck%position(:, order(k - 1))) > 0.0_wp)) cycle
         call complain(cards, 0, 13, 'nodes '//to_text(min(order(k), order(k - 1)))//' and '// &
            to_text(max(order(k), order(k - 1)))//' have the same coordinates', &
            card=deck%node_card(max(order(k), order(k - 1))))
      end do
   end subroutine check_alike

end module axijoint_legacy_check
